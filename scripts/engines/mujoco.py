"""MuJoCo behind the engine protocol: `python scripts/engines/mujoco.py` reads requests on stdin.

Every step solves, with A = J M⁻¹ Jᵀ, the reference acceleration a_ref and the softness R,

    f = argmin ½ fᵀ (A + R) f + fᵀ (J a_smooth − a_ref)   over the friction cones,
    v⁺ = v + h (a_smooth + M⁻¹ Jᵀ f),    q⁺ = q ⊕ h v⁺.

Contacts are evaluated at the state before the step, so the impulse h f of the step from t_k to
t_{k+1} belongs to (t_k, t_{k+1}] and is recorded with the sample that ends it.  After a step of
RK4 only the last of its four sets of contacts is left, which is no impulse of the step: none is
reported.

A body with a prescribed velocity is a mocap body, which MuJoCo takes for one that stands still. Its
velocity w at a contact is added where MuJoCo makes the reference of the velocity before the step,

    a_ref = −b (J v + w) − k r,

between the two halves of a step, `mj_step1` and `mj_step2`.  RK4 has no such halves.

Torsional and rolling friction [m] are options that only a request can give; the first makes four
contact directions of three, the second six.
"""

import sys

# This file has the name of the package it needs: look for the package without our own folder.
_here = sys.path.pop(0)
import mujoco  # noqa: E402
import numpy as np  # noqa: E402
sys.path.insert(0, _here)

import _mujoco_dump  # noqa: E402
import _mujoco_facts  # noqa: E402
import _mujoco_geometry  # noqa: E402
import _mujoco_prescribed  # noqa: E402
from _protocol import Unsupported, serve  # noqa: E402
from _scene import (GROUND, initial_state, kind_of, pair_friction,  # noqa: E402
                    prescribed_state, record, require_declared, rotation_to_normal, shape_of,
                    solid_inertia)
from _settings import (contact_model, in_force, options_of,  # noqa: E402
                       require_declared_restitution)

PARAMETERS = {
    "solref": ([0.02, 1.0], ["s", "1"]),
    "solimp": ([0.9, 0.95, 0.001, 0.5, 2.0], ["1", "1", "m", "1", "1"]),
    "impratio": (1.0, "1"),
    "tolerance": (1e-8, "m^2/s^4"),  # ends the iterations: cost gained, over the mean inertia
}
OPTIONS = {
    "solver": ("Newton", "CG", "PGS"), "cone": ("pyramidal", "elliptic"),
    "integrator": ("Euler", "implicitfast", "implicit", "RK4"),
    "iterations": 100, "ls_iterations": 50, "ls_tolerance": 0.01,
    "noslip_iterations": 0,
}
ROTATIONAL = ("torsional", "rolling")


def _in_force(request):
    given = request.get("options") or {}
    rotational = {name: 0.0 for name in ROTATIONAL if name in given}
    values = in_force("mujoco", PARAMETERS, OPTIONS | rotational, request)
    lengths = [values.get(name, 0.0) for name in ROTATIONAL]
    if min(lengths) < 0 or lengths[1] > 0 >= lengths[0]:
        raise ValueError("torsional and rolling friction are lengths, and rolling needs torsional")
    return values


def describe(request):
    """Name, version and contact model under the request's options."""
    values = _in_force(request)
    model = contact_model("compliant", "mujoco", PARAMETERS, values)
    if values["solref"][0] < 0:  # (−stiffness, −damping) per unit of effective mass
        model["parameters"]["solref"]["unit"] = ["1/s^2", "1/s"]
    return {
        "name": "mujoco", "version": mujoco.__version__, "precision": "double",
        "contact_model": model, "restitution": False,
        "friction": "cone" if values["cone"] == "elliptic" else "pyramid",
        "reports_contacts": values["integrator"] != "RK4", "levels": ["simulate", "dump"],
        "shapes": ["sphere", "box", "capsule", "cylinder"],
        "bodies": ["free", "static"] + (["prescribed"] if values["integrator"] != "RK4" else []),
        "options": options_of(OPTIONS, values),
    }


def _settings(request):
    require_declared_restitution("mujoco", request["scene"])
    return _in_force(request)


def _numbers(values):
    return " ".join(repr(float(x)) for x in values)


def _pair(scene, a, b, options):
    friction = pair_friction(scene, a, b)
    torsional, rolling = (options.get(name, 0.0) for name in ROTATIONAL)
    dimension = (6 if rolling > 0 else 4 if torsional > 0 else 3) if friction > 0 else 1
    return (f'<pair geom1="{a}" geom2="{b}" condim="{dimension}" '
            f'friction="{_numbers([friction, friction, torsional, rolling, rolling])}" '
            f'solref="{_numbers(options["solref"])}" solimp="{_numbers(options["solimp"])}"/>')


def model_of(scene, time_step, options):
    """The MuJoCo model: free bodies with explicit contact pairs, so nothing is mixed by rules."""
    if scene.get("ground") is not None and scene["ground"]["normal"][2] < -0.999:
        raise Unsupported("a ground plane that faces straight down")
    world, pairs, names = [], [], []  # names with whether a body moves
    if scene.get("ground") is not None:
        normal = np.array(scene["ground"]["normal"])
        world.append(f'<geom name="{GROUND}" type="plane" size="0 0 1" contype="0" '
                     f'conaffinity="0" pos="{_numbers(scene["ground"]["offset"] * normal)}" '
                     f'quat="{_numbers(rotation_to_normal(normal))}"/>')
        names.append((GROUND, False))
    for body in scene["bodies"]:
        position, orientation, _, _ = initial_state(body)
        kind = shape_of(body)
        size = body[kind].get("half_extents") or [
            body[kind][length] for length in ("radius", "half_height") if length in body[kind]]
        shape = f'type="{kind}" size="{_numbers(size)}"'
        moves = kind_of(body) == "free"
        inertial = (f'<freejoint/><inertial pos="0 0 0" mass="{body["mass"]!r}" '
                    f'diaginertia="{_numbers(solid_inertia(body))}"/>') if moves else ""
        mocap = ' mocap="true"' if kind_of(body) == "prescribed" else ""
        world.append(
            f'<body name="{body["name"]}"{mocap} pos="{_numbers(position)}" '
            f'quat="{_numbers(orientation)}">{inertial}'
            f'<geom name="{body["name"]}" {shape} contype="0" conaffinity="0"/></body>')
        pairs += [_pair(scene, body["name"], other, options) for other, also_moves in names
                  if moves or also_moves]
        names.append((body["name"], moves))
    keys = ("solver", "cone", "integrator", "iterations", "tolerance", "ls_iterations",
            "ls_tolerance", "noslip_iterations", "impratio")
    settings = " ".join(f'{key}="{options[key]}"' for key in keys)
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{time_step!r}" jacobian="dense" '
        f'gravity="{_numbers(scene["gravity"])}" {settings}/>'
        f'<worldbody>{"".join(world)}</worldbody><contact>{"".join(pairs)}</contact></mujoco>')


def _free(scene):
    return [body for body in scene["bodies"] if kind_of(body) == "free"]


def _rotation(quaternion):
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, np.asarray(quaternion, dtype=float))
    return matrix.reshape(3, 3)


def start(scene, time_step, options):
    """Model and data at t = 0; free-joint angular velocities are kept in the body frame."""
    model = model_of(scene, time_step, options)
    data = mujoco.MjData(model)
    for i, body in enumerate(_free(scene)):
        position, orientation, linear, angular = initial_state(body)
        data.qpos[7 * i:7 * i + 7] = [*position, *orientation]
        data.qvel[6 * i:6 * i + 3] = linear
        data.qvel[6 * i + 3:6 * i + 6] = _rotation(orientation).T @ np.array(angular)
    return model, data


class World:
    """One simulation; see `_scene.record`."""

    def __init__(self, scene, time_step, options):
        self.model, self.data = start(scene, time_step, options)
        free = iter(range(len(_free(scene))))
        self.places = [next(free) if kind_of(body) == "free" else body
                       for body in scene["bodies"]]
        self.prescribed = {body["name"]: body for body in scene["bodies"]
                           if kind_of(body) == "prescribed"}
        self.steps = 0

    def states(self):
        """(x, q, v, w) of every body."""
        for i in self.places:
            if not isinstance(i, int):
                yield prescribed_state(i, self.time())
                continue
            q, v = self.data.qpos[7 * i:7 * i + 7], self.data.qvel[6 * i:6 * i + 6]
            yield q[:3], q[3:], v[:3], _rotation(q[3:]) @ v[3:]

    def time(self):
        """Where the steps have come to [s]."""
        return self.steps * self.model.opt.timestep

    def _advance(self):
        if self.prescribed:
            for name, body in self.prescribed.items():
                place = self.model.body(name).mocapid[0]
                self.data.mocap_pos[place], self.data.mocap_quat[place] = (
                    prescribed_state(body, self.time())[:2])
            mujoco.mj_step1(self.model, self.data)
            _mujoco_prescribed.add_velocities(self.model, self.data, self.prescribed)
            mujoco.mj_step2(self.model, self.data)
        else:
            mujoco.mj_step(self.model, self.data)
        self.steps += 1

    def step(self):
        """One step and its contacts with the impulses h f; f acts on the second geom."""
        self._advance()
        if self.model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4:
            return
        force, names = np.zeros(6), self.model.geom
        for i, contact in enumerate(self.data.contact):
            mujoco.mj_contactForce(self.model, self.data, i, force)
            frame = contact.frame.reshape(3, 3)
            yield (names(contact.geom2).name, names(contact.geom1).name, frame[0],
                   self.model.opt.timestep * (frame.T @ force[:3]))


def simulate(request):
    """{scene, time_step, sample_every, options} → trajectory/1."""
    require_declared(describe(request), request["scene"])
    options = _settings(request)
    world = World(request["scene"], request["time_step"], options)
    engine = {"name": "mujoco", "version": mujoco.__version__, "options": options}
    trajectory = record(request, engine, world)
    if any(warning.number for warning in world.data.warning):
        raise RuntimeError("MuJoCo reported a warning: the simulation is not trustworthy")
    return trajectory


def dump(request):
    """{scene, time_step, step, options} → dump/1 of the step from t = step·h to (step+1)·h."""
    scene, time_step = request["scene"], request["time_step"]
    options = _settings(request)
    if options["integrator"] != "Euler" or options["noslip_iterations"]:
        raise Unsupported("a step problem is one convex problem only for Euler without noslip")
    if any(kind_of(body) == "prescribed" for body in scene["bodies"]):
        raise Unsupported("the step problem is rebuilt for bodies at rest and free ones only")
    model, data = start(scene, time_step, options)
    for _ in range(request["step"]):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    return _mujoco_dump.dump_of(model, data, request["step"], options)


def geometry(request):
    """{scene, time_step, steps, options} → contact-geometry/1: where every step finds contacts."""
    options = _settings(request)
    model, data = start(request["scene"], request["time_step"], options)
    engine = {"name": "mujoco", "version": mujoco.__version__, "options": options}
    return _mujoco_geometry.geometry_of(model, data, request, engine)


def facts(request):
    """{scene} → defaults, choices and small experiments; a request of our own scripts alone."""
    options = _in_force({"options": {}, "scene": request["scene"]})
    return _mujoco_facts.facts(start, request["scene"], options)


if __name__ == "__main__":
    serve({"describe": describe, "simulate": simulate, "dump": dump, "geometry": geometry,
           "facts": facts})
