"""SAPIEN (PhysX 5) behind the engine protocol: `python scripts/engines/sapien.py` reads stdin.

One step of PhysX takes the contacts of the state at t_k up to the sum of two shapes' contact
offsets, solves them iteratively with friction on the cone ‖r_t‖ ≤ μ r_n of each contact patch,

    u⁺_n = e |u_n| for approach speeds above the restitution threshold,   u⁺_n ≥ 0 otherwise,

and moves the bodies.  All of it in single precision, on the CPU, without a renderer.

The impulses that SAPIEN reports lack friction: PhysX keeps that per patch, and SAPIEN does not
pass it on.  So no contacts are reported.
"""

import sys

# This file has the name of the package it needs: look for the package without our own folder.
_here = sys.path.pop(0)
import sapien  # noqa: E402
import sapien.physx as physx  # noqa: E402
sys.path.insert(0, _here)

import math  # noqa: E402

from _protocol import serve  # noqa: E402
from _scene import (common_value, initial_state, kind_of, prescribed_state,  # noqa: E402
                    record, require_declared, shape_of, solid_inertia)
from _settings import contact_model, in_force, options_of  # noqa: E402

X_TO_Z = [math.sqrt(0.5), 0.0, -math.sqrt(0.5), 0.0]  # turns PhysX's axis of capsules to ours
LARGEST_ANGULAR_SPEED = 1e16  # rad/s; PhysX clamps at 100 unless told otherwise
PARAMETERS = {
    "restitution_threshold": (2.0, "m/s"),  # bounce threshold
    "contact_margin": (0.0, "m"),  # the sum of two shapes' rest offsets
    "contact_offset": (0.01, "m"),  # of one shape
    "max_depenetration_velocity": (1e32, "m/s"),
    # PhysX scales its fixed lengths with it, among them the separation up to which a contact has
    # friction (0.04 of it) and the distance at which friction anchors are told apart (0.025 of it).
    "tolerance_length": (0.1, "m"),
    "tolerance_speed": (0.2, "m/s"),
}
OPTIONS = {
    "tgs": True, "pcm": True, "friction_every_iteration": True, "enhanced_determinism": False,
    "position_iterations": 10, "velocity_iterations": 1,
}


def _in_force(request):
    values = in_force("sapien", PARAMETERS, OPTIONS, request)
    for name in PARAMETERS:
        if values[name] < 0:
            raise ValueError(f"{name} must not be negative, not {values[name]}")
    for name, least in (("position_iterations", 1), ("velocity_iterations", 0)):
        if not least <= values[name] <= 255:
            raise ValueError(f"{name} must be from {least} to 255, not {values[name]}")
    for name in ("tolerance_length", "tolerance_speed"):
        if not values[name] > 0:
            raise ValueError(f"{name} must be positive, not {values[name]}")
    if 2 * values["contact_offset"] <= values["contact_margin"]:
        raise ValueError("contact_offset must be more than half of contact_margin")
    return values


def describe(request):
    """Name, version and contact model under the request's options."""
    values = _in_force(request)
    return {
        "name": "sapien", "version": sapien.__version__, "precision": "single",
        "contact_model": contact_model("rigid", "coulomb", PARAMETERS, values),
        "restitution": True, "friction": "cone", "reports_contacts": False,
        "levels": ["simulate"], "shapes": ["sphere", "box", "capsule"],
        "bodies": ["free", "static", "prescribed"], "options": options_of(OPTIONS, values),
    }


def _plane_orientation(normal):
    """Quaternion [w, x, y, z] of the shortest rotation that takes (1, 0, 0) to the unit normal."""
    x, y, z = normal
    length = math.hypot(1.0 + x, z, y)
    return [(1.0 + x) / length, 0.0, -z / length, y / length] if length > 1e-12 else [0, 0, 0, 1]


class World:
    """One simulation; see `_scene.record`."""

    def __init__(self, scene, time_step, values):
        friction = common_value(scene, "friction")
        # There is one engine at a time, made anew when nothing holds the last one.
        self.engine = physx.PhysxEngine(values["tolerance_length"], values["tolerance_speed"])
        self.material = physx.PhysxMaterial(friction, friction, common_value(scene, "restitution"))
        self.values = values
        physx.set_scene_config(
            gravity=scene["gravity"], bounce_threshold=values["restitution_threshold"],
            enable_pcm=values["pcm"], enable_tgs=values["tgs"], enable_ccd=False,
            enable_enhanced_determinism=values["enhanced_determinism"],
            enable_friction_every_iteration=values["friction_every_iteration"], cpu_workers=0)
        self.system = physx.PhysxCpuSystem()
        self.system.timestep = time_step
        self.scene = sapien.Scene([self.system])
        self.time_step, self.steps, self.prescribed = time_step, 0, []
        self.scene_bodies = scene["bodies"]
        self.bodies = [self._body(body) for body in scene["bodies"]]
        if scene.get("ground") is not None:
            normal, offset = scene["ground"]["normal"], scene["ground"]["offset"]
            plane = physx.PhysxRigidStaticComponent()
            self._shape(plane, physx.PhysxCollisionShapePlane(self.material))
            self._add(plane, [offset * n for n in normal], _plane_orientation(normal))

    def _add(self, component, position, orientation):
        entity = sapien.Entity()
        entity.add_component(component)
        entity.set_pose(sapien.Pose(position, orientation))
        self.scene.add_entity(entity)

    def _shape(self, component, shape):
        shape.contact_offset = self.values["contact_offset"]
        shape.rest_offset = self.values["contact_margin"] / 2
        component.attach(shape)

    def _body(self, body):
        kind = kind_of(body)
        component = (physx.PhysxRigidStaticComponent() if kind == "static"
                     else physx.PhysxRigidDynamicComponent())
        self._shape(component, self._shape_of(body))
        position, orientation, linear, angular = initial_state(body)
        if kind == "static":
            self._add(component, position, orientation)
            return None
        self._configure(component)
        if kind == "free":
            component.cmass_local_pose = sapien.Pose()
            component.mass, component.inertia = body["mass"], solid_inertia(body)
        else:
            component.kinematic = True
            self.prescribed.append((component, body))
        self._add(component, position, orientation)
        if kind == "free":
            component.linear_velocity, component.angular_velocity = linear, angular
        return component

    def _shape_of(self, body):
        kind = shape_of(body)
        if kind == "sphere":
            return physx.PhysxCollisionShapeSphere(body["sphere"]["radius"], self.material)
        if kind == "box":
            return physx.PhysxCollisionShapeBox(body["box"]["half_extents"], self.material)
        size = body["capsule"]
        shape = physx.PhysxCollisionShapeCapsule(size["radius"], size["half_height"],
                                                 self.material)
        shape.local_pose = sapien.Pose([0.0] * 3, X_TO_Z)
        return shape

    def _configure(self, component):
        component.linear_damping = component.angular_damping = 0.0
        component.sleep_threshold = 0.0
        component.max_angular_velocity = LARGEST_ANGULAR_SPEED
        component.max_depenetration_velocity = self.values["max_depenetration_velocity"]
        component.solver_position_iterations = self.values["position_iterations"]
        component.solver_velocity_iterations = self.values["velocity_iterations"]

    def states(self):
        """(x, q, v, w) of every body."""
        for component, body in zip(self.bodies, self.scene_bodies):
            # PhysX gives a kinematic body its velocity with its first step
            if component is None or (self.steps == 0 and kind_of(body) == "prescribed"):
                yield initial_state(body)
                continue
            pose = component.entity_pose
            orientation = [float(x) for x in pose.q]
            length = math.hypot(*orientation)
            yield (pose.p, [x / length for x in orientation],
                   component.linear_velocity, component.angular_velocity)

    def step(self):
        """One step; no contacts, see above."""
        self.steps += 1
        for component, body in self.prescribed:
            position, orientation, _, _ = prescribed_state(body, self.steps * self.time_step)
            component.kinematic_target = sapien.Pose(position, orientation)
        self.system.step()
        return []


def simulate(request):
    """{scene, time_step, sample_every, options} → trajectory/1."""
    require_declared(describe(request), request["scene"])
    values = _in_force(request)
    world = World(request["scene"], request["time_step"], values)
    engine = {"name": "sapien", "version": sapien.__version__, "options": values}
    return record(request, engine, world)


if __name__ == "__main__":
    serve({"describe": describe, "simulate": simulate})
