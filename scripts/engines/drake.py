"""Drake behind the engine protocol: `python scripts/engines/drake.py` reads requests on stdin.

A discrete `MultibodyPlant` with point contact makes steps q⁺ = q + h N v⁺, where v⁺ solves

    M (v⁺ − v) = h τ + Jᵀ r(v⁺)

and the approximation (`sap`, `similar`, `lagged`, `tamsi`) is the model of the impulse r.
Boxes touch through spheres at their eight corners, because a box–box pair has one point only; in
a step in which no corner of two boxes is half as deep as they overlap, they touch through that
point, too: their edges cross.
Capsules touch the ground through the balls at their two ends, for the same reason.
A static body is welded to the world.  A prescribed velocity is nothing that Drake has: a joint that
is locked has the velocity 0, and a very heavy body takes part in the momentum that ends iterations.
The contact results of the state at t_k are those of the step from t_k to t_{k+1}.
"""

import itertools
import sys
from importlib.metadata import version

import numpy as np

_here = sys.path.pop(0)  # not to look for the engine's own modules in this folder
from pydrake.geometry import (AddContactMaterial, Box, Capsule,  # noqa: E402
                              CollisionFilterDeclaration, Cylinder, GeometrySet, HalfSpace,
                              ProximityProperties, Sphere)
from pydrake.math import RigidTransform  # noqa: E402
from pydrake.common.eigen_geometry import Quaternion  # noqa: E402
from pydrake.multibody.math import SpatialVelocity  # noqa: E402
from pydrake.multibody.plant import (AddMultibodyPlantSceneGraph, CoulombFriction,  # noqa: E402
                                     DiscreteContactApproximation)
from pydrake.multibody.tree import RotationalInertia, SpatialInertia  # noqa: E402
from pydrake.systems.framework import DiagramBuilder  # noqa: E402
sys.path.insert(0, _here)

import _drake_dump  # noqa: E402
import _drake_facts  # noqa: E402
from _contact_points import box_box  # noqa: E402
from _protocol import Unsupported, serve  # noqa: E402
from _scene import (GROUND, initial_state, kind_of, record, require_declared,  # noqa: E402
                    shape_of, solid_inertia)
from _settings import (contact_model, in_force, options_of,  # noqa: E402
                       require_declared_restitution)

VERSION = version("drake")

APPROXIMATIONS = {
    "sap": DiscreteContactApproximation.kSap, "similar": DiscreteContactApproximation.kSimilar,
    "lagged": DiscreteContactApproximation.kLagged, "tamsi": DiscreteContactApproximation.kTamsi,
}
PARAMETERS = {
    "stiffness": (1e5, "N/m"),  # of the pair
    "dissipation": (0.0, "s/m"),  # Hunt–Crossley; every approximation but sap
    "relaxation_time": (0.0, "s"),  # of the pair; sap only
    "stiction_tolerance": (1e-3, "m/s"),  # every approximation but sap
    "corner_radius": (5e-3, "m"),
}
OPTIONS = {"approximation": ("lagged", "sap", "similar", "tamsi")}


def describe(request):
    """Name, version and contact model under the request's options."""
    values = in_force("drake", PARAMETERS, OPTIONS, request)
    law = "drake-sap" if values["approximation"] == "sap" else "drake-regularised"
    return {
        "name": "drake", "version": VERSION, "precision": "double",
        "contact_model": contact_model("compliant", law, PARAMETERS, values),
        "restitution": False, "friction": "cone", "reports_contacts": True,
        "levels": ["simulate", "dump"], "shapes": ["sphere", "box", "capsule", "cylinder"],
        "bodies": ["free", "static"], "options": options_of(OPTIONS, values),
    }


def _settings(request):
    require_declared_restitution("drake", request["scene"])
    return in_force("drake", PARAMETERS, OPTIONS, request)


# A pair of kinds that meet, each with exact contact points; every other pair does not meet, or the
# scene is refused.
TOUCHING = [{"ground", "sphere"}, {"ground", "corner"}, {"ground", "end"}, {"ground", "cylinder"},
            {"box", "corner"}, {"box", "sphere"}, {"corner", "sphere"}, {"sphere"},
            {"sphere", "capsule"}, {"sphere", "cylinder"}, {"capsule"},
            {"box"}]  # but see `_let_boxes_meet`
UNKNOWN = [{"box", "capsule"}, {"box", "cylinder"}, {"capsule", "cylinder"}, {"cylinder"}]


def _pose(body):
    position, orientation, _, _ = initial_state(body)
    quaternion = np.array(orientation) / np.linalg.norm(orientation)
    return RigidTransform(Quaternion(quaternion), position)


def _inertia(body):
    """Of the body; a static one has none, and is given that of a kilogram, which nothing feels."""
    if kind_of(body) == "static":
        return SpatialInertia.MakeFromCentralInertia(1.0, [0, 0, 0], RotationalInertia(1, 1, 1))
    return SpatialInertia.MakeFromCentralInertia(body["mass"], [0, 0, 0],
                                                 RotationalInertia(*solid_inertia(body)))


def _shapes(body, corner_radius):
    """(kind, shape, position, name) of the geometries that a body is made of."""
    kind = shape_of(body)
    size = body[kind]
    if kind == "sphere":
        yield "sphere", Sphere(size["radius"]), [0, 0, 0], "sphere"
    elif kind == "box":
        half = np.array(size["half_extents"])
        yield "box", Box(*(2 * half)), [0, 0, 0], "box"
        for k, signs in enumerate(itertools.product((-1, 1), repeat=3)):
            yield "corner", Sphere(corner_radius), signs * (half - corner_radius), f"corner{k}"
    elif kind == "cylinder":
        yield "cylinder", Cylinder(size["radius"], 2 * size["half_height"]), [0, 0, 0], "cylinder"
    else:
        yield "capsule", Capsule(size["radius"], 2 * size["half_height"]), [0, 0, 0], "capsule"
        for k, sign in enumerate((-1, 1)):
            yield "end", Sphere(size["radius"]), [0, 0, sign * size["half_height"]], f"end{k}"


class Model:
    """A diagram with its plant, and one context that `advance` steps."""

    def __init__(self, scene, time_step, options):
        if any("friction" in pair for pair in scene["material"].get("pairs", [])):
            raise Unsupported("Drake mixes friction from the two bodies, not per pair")
        builder = DiagramBuilder()
        self.plant, self.graph = AddMultibodyPlantSceneGraph(builder, time_step)
        self.plant.SetUseSampledOutputPorts(False)  # contact results of the current state
        self.plant.set_discrete_contact_approximation(APPROXIMATIONS[options["approximation"]])
        self.plant.mutable_gravity_field().set_gravity_vector(np.array(scene["gravity"]))
        self.scene, self.time_step, self.options = scene, time_step, options
        self._register()
        self.plant.Finalize()
        self.plant.set_stiction_tolerance(options["stiction_tolerance"])
        self.diagram = builder.Build()
        self.root = self.diagram.CreateDefaultContext()
        self.context = self.plant.GetMyMutableContextFromRoot(self.root)
        self.next_state = self.diagram.AllocateDiscreteVariables()
        self._set_initial_state()
        self.steps, self.parted = 0, set()

    def _material(self):
        """Properties of one geometry: two in series have the pair's stiffness and damping."""
        properties, mu = ProximityProperties(), self.scene["material"]["friction"]
        AddContactMaterial(dissipation=self.options["dissipation"],
                           point_stiffness=2 * self.options["stiffness"],
                           friction=CoulombFriction(mu, mu), properties=properties)
        properties.AddProperty("material", "relaxation_time", self.options["relaxation_time"] / 2)
        return properties

    def _register(self):
        geometries = {kind: [] for kind in ("ground", "sphere", "box", "corner", "capsule", "end",
                                            "cylinder")}
        self.bodies = []
        if self.scene.get("ground") is not None:
            normal = np.array(self.scene["ground"]["normal"])
            pose = HalfSpace.MakePose(normal, self.scene["ground"]["offset"] * normal)
            geometries["ground"].append(self.plant.RegisterCollisionGeometry(
                self.plant.world_body(), pose, HalfSpace(), GROUND, self._material()))
        for body in self.scene["bodies"]:
            link = self.plant.AddRigidBody(body["name"], _inertia(body))
            self.bodies.append(link)
            if kind_of(body) == "static":
                self.plant.WeldFrames(self.plant.world_frame(), link.body_frame(), _pose(body))
            for kind, shape, position, name in _shapes(body, self.options["corner_radius"]):
                geometries[kind].append(self.plant.RegisterCollisionGeometry(
                    link, RigidTransform(np.array(position)), shape, name, self._material()))
        self.boxes = geometries["box"]
        self._filter(geometries)

    def _filter(self, geometries):
        """Lets the kinds of TOUCHING meet, and no others."""
        manager = self.graph.collision_filter_manager()
        kinds = [kind for kind in geometries if geometries[kind]]
        for i, one in enumerate(kinds):
            for other in kinds[i:]:
                alone = one == other and len(geometries[one]) == 1
                if alone or {one, other} in TOUCHING:
                    continue
                if {one, other} in UNKNOWN:
                    raise Unsupported(f"no exact contact points of {one} and {other}")
                sets = GeometrySet(geometries[one]), GeometrySet(geometries[other])
                manager.Apply(CollisionFilterDeclaration().ExcludeWithin(sets[0]) if one == other
                              else CollisionFilterDeclaration().ExcludeBetween(*sets))

    def _set_initial_state(self):
        for body, link in zip(self.scene["bodies"], self.bodies):
            if kind_of(body) == "static":
                continue
            _, _, linear, angular = initial_state(body)
            self.plant.SetFreeBodyPose(self.context, link, _pose(body))
            self.plant.SetFreeBodySpatialVelocity(
                self.context, link, SpatialVelocity(w=np.array(angular, dtype=float),
                                                    v=np.array(linear, dtype=float)))

    def states(self):
        """(x, q, v, w) of every body."""
        for link in self.bodies:
            pose = self.plant.EvalBodyPoseInWorld(self.context, link)
            velocity = self.plant.EvalBodySpatialVelocityInWorld(self.context, link)
            yield (pose.translation(), pose.rotation().ToQuaternion().wxyz(),
                   velocity.translational(), velocity.rotational())

    def _let_boxes_meet(self):
        """Lets those pairs of boxes meet whose overlap their corners do not see, and no others.

        The deepest corner of boxes that lie on each other is as deep as they overlap.  Where edges
        cross, no corner is in the other box, or one that is less deep: then the corners of the pair
        have less than half of the overlap.
        """
        if len(self.boxes) < 2:
            return
        context = self.graph.GetMyMutableContextFromRoot(self.root)
        query = self.graph.get_query_output_port().Eval(context)
        box_of = {query.inspector().GetFrameId(box): box for box in self.boxes}
        deepest = {}
        for pair in query.ComputePointPairPenetration():
            if {pair.id_A, pair.id_B} <= set(self.boxes):
                continue
            frames = [query.inspector().GetFrameId(name) for name in (pair.id_A, pair.id_B)]
            if all(frame in box_of for frame in frames):
                boxes = tuple(sorted((box_of[frame] for frame in frames), key=self.boxes.index))
                deepest[boxes] = max(deepest.get(boxes, 0.0), pair.depth)
        parted = {boxes for boxes, depth in deepest.items()
                  if 2 * depth >= self._overlap(query, boxes)}
        manager = self.graph.collision_filter_manager(context)
        for boxes in sorted(parted - self.parted, key=self._place):
            manager.Apply(CollisionFilterDeclaration().ExcludeWithin(GeometrySet(list(boxes))))
        for boxes in sorted(self.parted - parted, key=self._place):
            manager.Apply(CollisionFilterDeclaration().AllowWithin(GeometrySet(list(boxes))))
        self.parted = parted

    def _place(self, boxes):
        return [self.boxes.index(box) for box in boxes]

    @staticmethod
    def _overlap(query, boxes):
        """How far two boxes are in each other, along the axis that parts them best [m]."""
        placed = []
        for box in boxes:
            pose = query.GetPoseInWorld(box)
            half = [size / 2 for size in query.inspector().GetShape(box).size()]
            placed.append((half, pose.translation().tolist(), pose.rotation().matrix().tolist()))
        return max((-gap for gap, _, _ in box_box(*placed)), default=0.0)

    def contacts(self):
        """The point contacts of the step that starts at the current state."""
        results = self.plant.get_contact_results_output_port().Eval(self.context)
        return [results.point_pair_contact_info(i)
                for i in range(results.num_point_pair_contacts())]

    def name_of(self, index):
        """The scene's name of a body."""
        body = self.plant.get_body(index)
        return GROUND if body.index() == self.plant.world_body().index() else body.name()

    def step(self):
        """One step and its contacts; see `_scene.record`."""
        self._let_boxes_meet()
        for info in self.contacts():
            # The force is reported on B; the impulse on A has the other sign.
            yield (self.name_of(info.bodyA_index()), self.name_of(info.bodyB_index()),
                   info.point_pair().nhat_BA_W, -self.time_step * info.contact_force())
        self.advance()

    def advance(self):
        """One step without looking at its contacts."""
        self.diagram.CalcForcedDiscreteVariableUpdate(self.root, self.next_state)
        self.root.get_mutable_discrete_state().SetFrom(self.next_state)
        self.steps += 1
        self.root.SetTime(self.steps * self.time_step)


def simulate(request):
    """{scene, time_step, sample_every, options} → trajectory/1."""
    require_declared(describe(request), request["scene"])
    options = _settings(request)
    engine = {"name": "drake", "version": VERSION, "options": options}
    return record(request, engine, Model(request["scene"], request["time_step"], options))


def dump(request):
    """{scene, time_step, step, options} → dump/1 of the step from t = step·h to (step+1)·h."""
    scene = request["scene"]
    options = _settings(request)
    if options["approximation"] != "sap":
        raise Unsupported("only sap has a step problem with a fixed cone and compliance")
    if len(scene["bodies"]) != 1:
        raise Unsupported("the step problem is rebuilt for a single body only")
    model = Model(scene, request["time_step"], options)
    for _ in range(request["step"]):
        model.advance()
    return _drake_dump.dump_of(model, request["step"], VERSION)


def facts(_request):
    """{} → names, defaults and sentences; a request of our own scripts alone."""
    return {"stated": _drake_facts.stated()}


if __name__ == "__main__":
    serve({"describe": describe, "simulate": simulate, "dump": dump, "facts": facts})
