"""DART behind the engine protocol: `python scripts/engines/dart.py` reads requests on stdin.

A step takes the free velocities v + h M⁻¹ f and the contacts of the state q at depth d ≥ 0, and
solves for impulses with 0 ≤ r_n, friction |r_t| ≤ μ r_n along two directions or ‖r_t‖ ≤ μ r_n,

    u⁺_n + c W_nn r_n = max(e |u_n|, min(ERP d / h, correction speed)),

u_n belonging to the free velocity; without the restitution term while e |u_n| is below the rebound
threshold; c is a softening (CFM).  Piles may be pushed out faster than the correction speed.
Then q⁺ = q ⊕ h v⁺.  The contacts read after the step carry the forces of that step.
"""

from importlib.metadata import version

import dartpy
import numpy as np

from _protocol import Unsupported, serve
from _scene import (GROUND, initial_state, kind_of, multiplied_values, pair_values,
                    prescribed_state, record, require_declared, shape_of, smallest_values,
                    solid_inertia)
from _settings import contact_model, in_force, options_of

VERSION = version("dartpy")
DETECTORS = {"fcl": dartpy.simulation.FCL, "bullet": dartpy.simulation.BULLET,
             "ode": dartpy.simulation.ODE}
NEGLECTED = 1e-3  # DART takes restitution and friction up to here for none
PARAMETERS = {
    "rebound_threshold": (0.1, "m/s"), "correction_speed": (1e-3, "m/s"),
    "error_reduction": (0.01, "1"), "force_mixing": (1e-5, "1"),  # ERP and CFM
    "tolerance": (1e-5, "m/s"),  # of nsgs and fbf
}
OPTIONS = {
    "solver": ("dantzig", "nsgs", "fbf"), "collision_detector": tuple(DETECTORS),
    "iterations": 100,  # of nsgs and fbf
    "split_impulse": False,
}
FIXED = ("rebound_threshold", "correction_speed", "error_reduction", "force_mixing")


CONE_SOLVERS = {"nsgs": (dartpy.constraint.NsgsFrictionSolver, "maxSweeps"),
                "fbf": (dartpy.constraint.FbfFrictionSolver, "maxOuterIterations")}


def describe(request):
    """Name, version and contact model under the request's options."""
    values = in_force("dart", PARAMETERS, OPTIONS, request, FIXED)
    cone = values["solver"] in CONE_SOLVERS
    return {
        "name": "dart", "version": VERSION, "precision": "double",
        "contact_model": contact_model("rigid", "coulomb", PARAMETERS, values),
        "restitution": True, "friction": "cone" if cone else "pyramid",
        "reports_contacts": True, "levels": ["simulate"],
        # FCL in DART knows no capsule: it makes a sphere of 0.1 m instead, and says so
        "shapes": ["sphere", "box", "cylinder"]
                  + (["capsule"] if values["collision_detector"] != "fcl" else []),
        "bodies": ["free", "static", "prescribed"], "options": options_of(OPTIONS, values),
    }


def _cone_solver(values):
    kind, iterations = CONE_SOLVERS[values["solver"]]
    options = kind.Options()
    options.tolerance = values["tolerance"]
    setattr(options, iterations, values["iterations"])
    return kind(options)


def _shape_of(body):
    kind = shape_of(body)
    if kind == "sphere":
        return dartpy.dynamics.SphereShape(body["sphere"]["radius"])
    if kind == "box":
        return dartpy.dynamics.BoxShape(2 * np.array(body["box"]["half_extents"]))
    make = {"capsule": dartpy.dynamics.CapsuleShape, "cylinder": dartpy.dynamics.CylinderShape}
    return make[kind](body[kind]["radius"], 2 * body[kind]["half_height"])


def _place(joint, state):
    position, orientation, linear, angular = state
    pose = dartpy.math.Isometry3()
    pose.set_translation(position)
    pose.set_quaternion(dartpy.math.Quaternion(*orientation))
    joint.setPositions(dartpy.dynamics.FreeJoint.convertToPositions(pose))
    joint.setAngularVelocity(angular)
    joint.setLinearVelocity(linear)


class World:
    """One simulation; see `_scene.record`."""

    def __init__(self, scene, time_step, values):
        for key in ("friction", "restitution"):
            if any(0 < value <= NEGLECTED for value in pair_values(scene, key).values()):
                raise Unsupported(f"DART neglects {key} up to {NEGLECTED}")
        self.friction = smallest_values(scene, "friction")
        self.restitution = multiplied_values(scene, "restitution")
        self.time_step = time_step
        self.world = dartpy.simulation.World()
        self.world.setTimeStep(time_step)
        self.world.setGravity(scene["gravity"])
        sleep = self.world.getDeactivationOptions()
        sleep.mEnabled = False
        self.world.setDeactivationOptions(sleep)
        self.world.setCollisionDetector(DETECTORS[values["collision_detector"]])
        solver = self.world.getConstraintSolver()
        if values["solver"] != "dantzig":  # the default, which cannot be made in Python
            solver.setBoxedLcpSolver(_cone_solver(values))
        solver.setSplitImpulseEnabled(values["split_impulse"])
        self.prescribed, self.steps = [], 0
        self.bodies = [self._body(body) for body in scene["bodies"]]
        self._prescribe()
        if scene.get("ground") is not None:
            skeleton = dartpy.dynamics.Skeleton(GROUND)
            _, ground = skeleton.createWeldJointAndBodyNodePair()
            self._shape(ground, dartpy.dynamics.PlaneShape(
                np.array(scene["ground"]["normal"]), scene["ground"]["offset"]), GROUND)
            skeleton.setMobile(False)
            self.world.addSkeleton(skeleton)

    def _shape(self, node, shape, name):
        frame = node.createShapeNode(shape)
        frame.createCollisionAspect()
        frame.createDynamicsAspect()
        frame.getDynamicsAspect().setFrictionCoeff(self.friction[name])
        frame.getDynamicsAspect().setRestitutionCoeff(self.restitution[name])

    def _body(self, body):
        skeleton = dartpy.dynamics.Skeleton(body["name"])
        joint, node = skeleton.createFreeJointAndBodyNodePair()
        node.setName(body["name"])
        self._shape(node, _shape_of(body), body["name"])
        kind = kind_of(body)
        if kind == "free":
            node.setInertia(dartpy.dynamics.Inertia(body["mass"], np.zeros(3),
                                                    np.diag(solid_inertia(body))))
        else:
            joint.setActuatorType(dartpy.dynamics.ActuatorType.VELOCITY)
            skeleton.setMobile(kind == "prescribed")
        _place(joint, initial_state(body))
        self.world.addSkeleton(skeleton)
        if kind == "prescribed":
            self.prescribed.append((joint, body))
        return node

    def _prescribe(self):
        """Give the bodies with prescribed velocities their place and command their velocity."""
        for joint, body in self.prescribed:
            _place(joint, prescribed_state(body, self.steps * self.time_step))
            joint.setCommands(joint.getVelocities())

    def states(self):
        """(x, q, v, w) of every body."""
        for node in self.bodies:
            pose = node.getWorldTransform()
            yield (pose.translation(), pose.quaternion().wxyz(), node.getLinearVelocity(),
                   node.getAngularVelocity())

    def step(self):
        """One step and its contacts."""
        self.world.step()
        self.steps += 1
        self._prescribe()
        for contact in self.world.getLastCollisionResult().getContacts():
            a, b = (x.getShapeFrame().asShapeNode().getBodyNodePtr().getSkeleton().getName()
                    for x in (contact.collisionObject1, contact.collisionObject2))
            yield a, b, contact.normal, self.time_step * contact.force


def simulate(request):
    """{scene, time_step, sample_every, options} → trajectory/1."""
    require_declared(describe(request), request["scene"])
    values = in_force("dart", PARAMETERS, OPTIONS, request, FIXED)
    engine = {"name": "dart", "version": VERSION, "options": values}
    return record(request, engine, World(request["scene"], request["time_step"], values))


if __name__ == "__main__":
    serve({"describe": describe, "simulate": simulate})
