"""Bullet behind the engine protocol: `python scripts/engines/bullet.py` reads requests on stdin.

PyBullet's step takes the velocities v + h M⁻¹ f and the contacts of the state q at distances d,
and iterates impulses on the cones ‖r_t‖ ≤ μ r_n until, for every contact with r_n > 0,

    u⁺_n = e |u_n| − (d + slop) / h             while d + slop > 0,
    u⁺_n = e |u_n| − ERP (d + slop) / h         afterwards,       e = 0 below the speed threshold,

then q⁺ = q ⊕ h v⁺; u_n holds the velocities after the forces, v + h M⁻¹ f.  A contact point
begins at a distance of the breaking threshold times the size of the smaller body, up to the
processing threshold, so one may act before it closes.  The points read after the step carry the
impulses of that step.

The ground is Bullet's plane, against which a box gets one new contact point per step, or a box
as in PyBullet's own plane.urdf, against which it gets all of them; see `ground_shape`.
"""

import math
from importlib.metadata import version

import pybullet

from _protocol import Unsupported, serve
from _scene import (GROUND, initial_state, kind_of, multiplied_values, pair_values,
                    prescribed_state, record, require_declared, rotation_to_normal, shape_of,
                    solid_inertia)
from _settings import contact_model, in_force, options_of

VERSION = version("pybullet")
LARGEST_FRICTION = 10.0  # Bullet clamps the product of the two bodies' values
LARGEST_SPEED = 1e10  # of bodies, m/s and rad/s; Bullet's default clamps at 100
PARAMETERS = {
    "penetration_allowance": (1e-5, "m"),  # slop
    "contact_margin": (0.0, "m"),  # the collision margin lies inside the shapes
    "restitution_threshold": (0.2, "m/s"),
    "breaking_threshold": (0.02, "1"),  # of the smaller body: where a contact point begins and ends
    "error_reduction": (0.08, "1"),  # contact ERP
    "processing_threshold": (0.02, "m"),  # distance up to which a contact point counts
    "collision_margin": (1e-3, "m"),  # radius of rounded box edges where GJK is used
    "residual_threshold": (1e-7, "m^2/s^2"),  # stops the iterations
    "ground_extent": (50.0, "m"),  # half the width of the ground box
}
FIXED = ("contact_margin",)
OPTIONS = {
    "cone_friction": True, "iterations": 50, "ground_shape": ("plane", "box"),
    "friction_erp": 0.2, "global_cfm": 0.0,
    "maximal_coordinates": False, "rigid_ground": False, "split_impulse": True, "warm_starting_factor": 0.1,
}

ROUND = {"capsule": pybullet.GEOM_CAPSULE, "cylinder": pybullet.GEOM_CYLINDER}


def describe(request):
    """Name, version and contact model under the request's options."""
    values = in_force("bullet", PARAMETERS, OPTIONS, request, FIXED)
    cone = values["cone_friction"] and not values["maximal_coordinates"]
    return {
        "name": "bullet", "version": VERSION, "precision": "double",
        "contact_model": contact_model("rigid", "coulomb", PARAMETERS, values),
        "restitution": True, "friction": "cone" if cone else "pyramid",
        "reports_contacts": True, "levels": ["simulate"],
        # contacts of rigid bodies take one without mass for one at rest
        "bodies": ["free", "static"] + ([] if values["maximal_coordinates"] else ["prescribed"]),
        "shapes": ["sphere", "box", "capsule", "cylinder"],
        "options": options_of(OPTIONS, values),
    }


class World:
    """One simulation; see `_scene.record`."""

    def __init__(self, scene, time_step, values):
        if max(pair_values(scene, "friction").values(), default=0.0) > LARGEST_FRICTION:
            raise Unsupported(f"Bullet clamps friction at {LARGEST_FRICTION}")
        self.friction = multiplied_values(scene, "friction")
        self.restitution = multiplied_values(scene, "restitution")
        self.time_step, self.values, self.names = time_step, values, {}
        self.bullet = pybullet.connect(pybullet.DIRECT)
        self._configure(scene["gravity"])
        self.ground = scene.get("ground")
        if self.ground is not None:
            self._make_ground(scene["bodies"][0]["position"])
        self.bodies = [self._body(body) for body in scene["bodies"]]
        self.prescribed = [(handle, body) for handle, body in zip(self.bodies, scene["bodies"])
                           if kind_of(body) == "prescribed"]
        self.steps = 0
        self._prescribe()

    def _call(self, name, *arguments, **named):
        return getattr(pybullet, name)(*arguments, **named, physicsClientId=self.bullet)

    def _configure(self, gravity):
        values = self.values
        self._call("setGravity", *gravity)
        self._call("setPhysicsEngineParameter", fixedTimeStep=self.time_step, numSubSteps=0,
                   numSolverIterations=values["iterations"],
                   enableConeFriction=values["cone_friction"],
                   contactERP=values["error_reduction"], frictionERP=values["friction_erp"],
                   globalCFM=values["global_cfm"], useSplitImpulse=values["split_impulse"],
                   warmStartingFactor=values["warm_starting_factor"],
                   contactSlop=values["penetration_allowance"],
                   contactBreakingThreshold=values["breaking_threshold"],
                   restitutionVelocityThreshold=values["restitution_threshold"],
                   solverResidualThreshold=values["residual_threshold"],
                   deterministicOverlappingPairs=1)

    def _make_ground(self, above):
        """The ground below the point `above`, in the middle of its box."""
        normal, offset = self.ground["normal"], self.ground["offset"]
        height = sum(n * x for n, x in zip(normal, above)) - offset
        self.origin = [x - height * n for n, x in zip(normal, above)]
        w, x, y, z = rotation_to_normal(normal)
        extent, depth = self.values["ground_extent"], 0.0
        if self.values["ground_shape"] == "box":
            depth = extent / 10
            shape = self._call("createCollisionShape", pybullet.GEOM_BOX,
                               halfExtents=[extent, extent, depth])
        else:
            shape = self._call("createCollisionShape", pybullet.GEOM_PLANE, planeNormal=[0, 0, 1])
        self._material(self._call(
            "createMultiBody", 0, shape, baseOrientation=[x, y, z, w],
            useMaximalCoordinates=self.values["rigid_ground"],
            basePosition=[o - depth * n for o, n in zip(self.origin, normal)]), GROUND,
            collisionMargin=self.values["collision_margin"])

    def _material(self, handle, name, **more):
        self.names[handle] = name
        self._call("changeDynamics", handle, -1, lateralFriction=self.friction[name],
                   restitution=self.restitution[name], spinningFriction=0.0, rollingFriction=0.0,
                   linearDamping=0.0, angularDamping=0.0,
                   contactProcessingThreshold=self.values["processing_threshold"], **more)

    def _body(self, body):
        position, (w, x, y, z), linear, angular = initial_state(body)
        kind = shape_of(body)
        if kind == "sphere":
            shape = self._call("createCollisionShape", pybullet.GEOM_SPHERE,
                               radius=body["sphere"]["radius"])
        elif kind in ("capsule", "cylinder"):
            shape = self._call("createCollisionShape", ROUND[kind], radius=body[kind]["radius"],
                               height=2 * body[kind]["half_height"])
        else:
            shape = self._call("createCollisionShape", pybullet.GEOM_BOX,
                               halfExtents=body["box"]["half_extents"])
        moves = kind_of(body) == "free"
        handle = self._call("createMultiBody", body["mass"] if moves else 0, shape, basePosition=position,
                            baseOrientation=[x, y, z, w],
                            useMaximalCoordinates=self.values["maximal_coordinates"])
        if not moves:
            self._material(handle, body["name"],
                           collisionMargin=self.values["collision_margin"])
            return handle
        self._material(handle, body["name"], mass=body["mass"],
                       localInertiaDiagonal=solid_inertia(body),
                       collisionMargin=self.values["collision_margin"],
                       maxJointVelocity=LARGEST_SPEED,
                       activationState=pybullet.ACTIVATION_STATE_DISABLE_SLEEPING)
        self._call("resetBaseVelocity", handle, linear, angular)
        return handle

    def states(self):
        """(x, q, v, w) of every body."""
        for handle in self.bodies:
            position, (x, y, z, w) = self._call("getBasePositionAndOrientation", handle)
            self._check_on_ground(position)
            yield position, (w, x, y, z), *self._call("getBaseVelocity", handle)

    def _prescribe(self):
        """Put the bodies with prescribed velocities where they are now; Bullet keeps them there."""
        for handle, body in self.prescribed:
            position, (w, x, y, z), linear, angular = prescribed_state(
                body, self.steps * self.time_step)
            self._call("resetBasePositionAndOrientation", handle, position, [x, y, z, w])
            self._call("resetBaseVelocity", handle, linear, angular)

    def points(self):
        """One step and its contact points in the order in which it took them: the bodies a and b,
        the points on them, the normal from b to a, the distance, the impulse on a."""
        self._call("stepSimulation")
        self.steps += 1
        self._prescribe()
        for point in self._call("getContactPoints"):
            (_, a, b, _, _, on_a, on_b, normal, distance,
             force, along1, tangent1, along2, tangent2) = point
            if distance > self.values["processing_threshold"]:
                continue  # it keeps the impulse of an earlier step
            yield self.names[a], self.names[b], on_a, on_b, normal, distance, [
                self.time_step * (force * n + along1 * s + along2 * t)
                for n, s, t in zip(normal, tangent1, tangent2)]

    def step(self):
        """One step and its contacts."""
        for a, b, _, _, normal, _, impulse in self.points():
            yield a, b, normal, impulse

    def _check_on_ground(self, position):
        if self.ground is None or self.values["ground_shape"] == "plane":
            return
        if math.dist(position, self.origin) > self.values["ground_extent"]:
            raise Unsupported("a body leaves the ground box; use ground_shape plane")

    def close(self):
        """Free the simulation."""
        self._call("disconnect")


def simulate(request):
    """{scene, time_step, sample_every, options} → trajectory/1."""
    require_declared(describe(request), request["scene"])
    values = in_force("bullet", PARAMETERS, OPTIONS, request, FIXED)
    world = World(request["scene"], request["time_step"], values)
    try:
        engine = {"name": "bullet", "version": VERSION, "options": values}
        return record(request, engine, world)
    finally:
        world.close()


def _point(a, on_a, on_b, normal, distance, impulse):
    """A contact point seen from the body that is not the ground."""
    if a != GROUND:
        return {"position": list(on_a), "normal": list(normal), "distance": distance,
                "impulse": impulse}
    return {"position": list(on_b), "normal": [-x for x in normal], "distance": distance,
            "impulse": [-x for x in impulse]}


def steps(request):
    """{scene, time_step, steps, options} → bullet-steps/1: the states of a single body at the start
    and after every step, and the contact points of every step."""
    scene = request["scene"]
    if len(scene["bodies"]) != 1:
        raise Unsupported("bullet-steps/1 holds a single body")
    values = in_force("bullet", PARAMETERS, OPTIONS, request, FIXED)
    world = World(scene, request["time_step"], values)
    body = {"position": [], "orientation": [], "linear_velocity": [], "angular_velocity": []}
    points = []

    def store():
        for key, value in zip(body, next(world.states())):
            body[key].append(list(value))

    try:
        store()
        for _ in range(request["steps"]):
            made = [_point(a, on_a, on_b, normal, distance, impulse) for
                    a, _, on_a, on_b, normal, distance, impulse in world.points()]
            points.append({key: [one[key] for one in made] for key in
                           ("position", "normal", "distance", "impulse")})
            store()
    finally:
        world.close()
    return {"schema": "bullet-steps/1", "scene": scene, "time_step": request["time_step"],
            "engine": {"name": "bullet", "version": VERSION, "options": values},
            "bodies": body, "native": {"points": points}}


if __name__ == "__main__":
    serve({"describe": describe, "simulate": simulate, "steps": steps})
