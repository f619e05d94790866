"""MuJoCo behind the engine protocol: `python scripts/engines/mujoco.py` reads requests on stdin.

Every step solves, with A = J M⁻¹ Jᵀ, the reference acceleration a_ref and the softness R,

    f = argmin ½ fᵀ (A + R) f + fᵀ (J a_smooth − a_ref)   over the friction cones,
    v⁺ = v + h (a_smooth + M⁻¹ Jᵀ f),    q⁺ = q ⊕ h v⁺.

Contacts are evaluated at the state before the step, so the impulse h f of the step from t_k to
t_{k+1} belongs to (t_k, t_{k+1}] and is recorded with the sample that ends it.
"""

import sys

# This file has the name of the package it needs: look for the package without our own folder.
_here = sys.path.pop(0)
import mujoco  # noqa: E402
import numpy as np  # noqa: E402
sys.path.insert(0, _here)

import _mujoco_dump  # noqa: E402
from _protocol import Unsupported, serve  # noqa: E402
from _scene import (GROUND, Recorder, engine_options, initial_state, pair_friction,  # noqa: E402
                    solid_inertia, step_count)

DEFAULTS = {
    "solver": "Newton", "cone": "pyramidal", "integrator": "Euler",
    "iterations": 100, "tolerance": 1e-8, "ls_iterations": 50, "ls_tolerance": 0.01,
    "noslip_iterations": 0, "impratio": 1.0,
    "solref": [0.02, 1.0], "solimp": [0.9, 0.95, 0.001, 0.5, 2.0],
}


def describe(_request):
    """Name, version and contact model."""
    return {
        "name": "mujoco", "version": mujoco.__version__,
        "contact_model": {"kind": "compliant", "parameters": DEFAULTS},
        "restitution": False, "friction": ["cone", "pyramid"],
        "levels": ["simulate", "dump"],
    }


def _numbers(values):
    return " ".join(repr(float(x)) for x in values)


def _plane_orientation(normal):
    """Quaternion [w,x,y,z] of the shortest rotation that takes (0,0,1) to the unit normal."""
    x, y, z = normal
    q = np.array([1.0 + z, -y, x, 0.0])
    return q / np.linalg.norm(q) if np.linalg.norm(q) > 1e-12 else np.array([0.0, 1.0, 0.0, 0.0])


def _pair(scene, a, b, options):
    friction = pair_friction(scene, a, b)
    dimension = 3 if friction > 0 else 1
    return (f'<pair geom1="{a}" geom2="{b}" condim="{dimension}" '
            f'friction="{friction!r} {friction!r} 0 0 0" '
            f'solref="{_numbers(options["solref"])}" solimp="{_numbers(options["solimp"])}"/>')


def model_of(scene, time_step, options):
    """The MuJoCo model: free bodies with explicit contact pairs, so nothing is mixed by rules."""
    if scene.get("ground") is not None and scene["ground"]["normal"][2] < -0.999:
        raise Unsupported("a ground plane that faces straight down")
    world, pairs, names = [], [], []
    if scene.get("ground") is not None:
        normal = np.array(scene["ground"]["normal"])
        world.append(f'<geom name="{GROUND}" type="plane" size="0 0 1" contype="0" '
                     f'conaffinity="0" pos="{_numbers(scene["ground"]["offset"] * normal)}" '
                     f'quat="{_numbers(_plane_orientation(normal))}"/>')
        names.append(GROUND)
    for body in scene["bodies"]:
        position, orientation, _, _ = initial_state(body)
        if "sphere" in body:
            shape = f'type="sphere" size="{body["sphere"]["radius"]!r}"'
        else:
            shape = f'type="box" size="{_numbers(body["box"]["half_extents"])}"'
        world.append(
            f'<body name="{body["name"]}" pos="{_numbers(position)}" '
            f'quat="{_numbers(orientation)}"><freejoint/>'
            f'<inertial pos="0 0 0" mass="{body["mass"]!r}" '
            f'diaginertia="{_numbers(solid_inertia(body))}"/>'
            f'<geom name="{body["name"]}" {shape} contype="0" conaffinity="0"/></body>')
        pairs += [_pair(scene, body["name"], other, options) for other in names]
        names.append(body["name"])
    keys = ("solver", "cone", "integrator", "iterations", "tolerance", "ls_iterations",
            "ls_tolerance", "noslip_iterations", "impratio")
    settings = " ".join(f'{key}="{options[key]}"' for key in keys)
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{time_step!r}" jacobian="dense" '
        f'gravity="{_numbers(scene["gravity"])}" {settings}/>'
        f'<worldbody>{"".join(world)}</worldbody><contact>{"".join(pairs)}</contact></mujoco>')


def _rotation(quaternion):
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, np.asarray(quaternion, dtype=float))
    return matrix.reshape(3, 3)


def start(scene, time_step, options):
    """Model and data at t = 0; free-joint angular velocities are kept in the body frame."""
    model = model_of(scene, time_step, options)
    data = mujoco.MjData(model)
    for i, body in enumerate(scene["bodies"]):
        position, orientation, linear, angular = initial_state(body)
        data.qpos[7 * i:7 * i + 7] = [*position, *orientation]
        data.qvel[6 * i:6 * i + 3] = linear
        data.qvel[6 * i + 3:6 * i + 6] = _rotation(orientation).T @ np.array(angular)
    return model, data


def _states(scene, data):
    for i in range(len(scene["bodies"])):
        q, v = data.qpos[7 * i:7 * i + 7], data.qvel[6 * i:6 * i + 6]
        yield q[:3], q[3:], v[:3], _rotation(q[3:]) @ v[3:]


def _record_contacts(model, data, recorder):
    """Pass on the impulses h f of the step just made; MuJoCo's force acts on the second geom."""
    force = np.zeros(6)
    for i in range(data.ncon):
        contact = data.contact[i]
        mujoco.mj_contactForce(model, data, i, force)
        frame = contact.frame.reshape(3, 3)
        recorder.contact(model.geom(contact.geom2).name, model.geom(contact.geom1).name,
                         frame[0], model.opt.timestep * (frame.T @ force[:3]))


def simulate(request):
    """{scene, time_step, sample_every, options} → trajectory/1."""
    scene, time_step = request["scene"], request["time_step"]
    options = engine_options("mujoco", DEFAULTS, scene, request)
    model, data = start(scene, time_step, options)
    engine = {"name": "mujoco", "version": mujoco.__version__, "options": options}
    recorder = Recorder(scene, engine, time_step, request["sample_every"])
    recorder.sample(0, _states(scene, data))
    for step in range(1, step_count(scene, time_step) + 1):
        mujoco.mj_step(model, data)
        _record_contacts(model, data, recorder)
        if recorder.due(step):
            recorder.sample(step, _states(scene, data))
    if any(warning.number for warning in data.warning):
        raise RuntimeError("MuJoCo reported a warning: the simulation is not trustworthy")
    return recorder.trajectory


def dump(request):
    """{scene, time_step, step, options} → dump/1 of the step from t = step·h to (step+1)·h."""
    scene, time_step = request["scene"], request["time_step"]
    options = engine_options("mujoco", DEFAULTS, scene, request)
    if options["integrator"] != "Euler" or options["noslip_iterations"]:
        raise Unsupported("a step problem is one convex problem only for Euler without noslip")
    model, data = start(scene, time_step, options)
    for _ in range(request["step"]):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    return _mujoco_dump.dump_of(model, data, request["step"], options)


if __name__ == "__main__":
    serve({"describe": describe, "simulate": simulate, "dump": dump})
