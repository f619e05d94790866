"""What MuJoCo itself says and does: defaults, what can be chosen, and small experiments.

`stated` holds names, integers and settings, which must not change; `computed` holds numbers that
rounding may move.  Every experiment starts cold (no warm start) at a state given here.
"""

import re
from pathlib import Path

import mujoco
import numpy as np

SLIDING_STEP = 100
ITERATES = 8
COLD = int(mujoco.mjtDisableBit.mjDSBL_WARMSTART)

BALL = ('<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom size="0.1" mass="1"/></body>'
        '</worldbody></mujoco>')
# A box of 1 kg, one corner in the ground, that turns about a horizontal axis.
CORNER = ('<mujoco><option jacobian="dense" cone="elliptic"/><worldbody>'
          '<geom type="plane" size="0 0 1"/><body><freejoint/>'
          '<geom type="box" size="0.1 0.1 0.1" mass="1"/></body></worldbody></mujoco>')
MOTOR = ('<mujoco><option timestep="0.01" integrator="{}" gravity="0 0 0"/><worldbody><body>'
         '<joint name="j" type="slide" damping="{}"/><geom size="0.1" mass="1"/></body></worldbody>'
         '<actuator><velocity joint="j" kv="{}"/></actuator></mujoco>')
TOP = ('<mujoco><option timestep="0.01" integrator="{}" gravity="0 0 0"/><worldbody><body>'
       '{}<inertial pos="0 0 0" mass="1" diaginertia="0.02 0.03 0.04"/></body></worldbody></mujoco>')


SPINNING = ('<mujoco><option jacobian="dense" cone="{}"/><worldbody>'
            '<geom name="g" type="plane" size="0 0 1"/><body><freejoint/>'
            '<geom name="b" size="0.1" mass="1"/></body></worldbody><contact>'
            '<pair geom1="g" geom2="b" condim="{}" friction="0.5 0.5 0.02 0.001 0.001"/>'
            '</contact></mujoco>')


def _members(enumeration, prefix):
    return {name.removeprefix(prefix): int(value)
            for name, value in enumeration.__members__.items() if name.startswith(prefix)}


def sources():
    """Names of C sources that the compiler left in the library."""
    library = next(Path(mujoco.__file__).parent.glob("libmujoco*"))
    names = re.findall(rb"/engine/(engine_[a-z0-9_]+\.c)\b", library.read_bytes())
    return sorted({name.decode() for name in names})


def stated():
    """Defaults of an empty model, and the names of what can be chosen."""
    model = mujoco.MjModel.from_xml_string(BALL)
    option = model.opt
    integers = ("integrator", "solver", "cone", "iterations", "ls_iterations", "noslip_iterations",
                "disableflags", "enableflags")
    numbers = ("timestep", "tolerance", "ls_tolerance", "impratio")
    return {
        "integrators": _members(mujoco.mjtIntegrator, "mjINT_"),
        "solvers": _members(mujoco.mjtSolver, "mjSOL_"),
        "cones": _members(mujoco.mjtCone, "mjCONE_"),
        "jacobians": _members(mujoco.mjtJacobian, "mjJAC_"),
        "defaults": {**{key: int(getattr(option, key)) for key in integers},
                     **{key: float(getattr(option, key)) for key in numbers},
                     "solref": model.geom_solref[0].tolist(),
                     "solimp": model.geom_solimp[0].tolist()},
        "sources": sources(),
        "inverse_functions": sorted(name for name in dir(mujoco) if name.startswith("mj_inverse")),
    }


def _at(start, scene, time_step, options, step):
    """Model and data after `step` steps, without warm start from there on."""
    model, data = start(scene, time_step, options)
    for _ in range(step):
        mujoco.mj_step(model, data)
    model.opt.disableflags |= COLD
    return model, data


def iterates(start, scene, options, time_step=2e-3):
    """qacc after 1, 2, … iterations of CG with an exact line search, from qacc_smooth."""
    rows = {}
    for cone in ("elliptic", "pyramidal"):
        model, data = _at(start, scene, time_step, {**options, "solver": "CG", "cone": cone},
                          SLIDING_STEP)
        model.opt.ls_tolerance, model.opt.ls_iterations, model.opt.tolerance = 1e-14, 100, 0.0
        rows[cone] = []
        for k in range(1, ITERATES + 1):
            model.opt.iterations = k
            mujoco.mj_forward(model, data)
            rows[cone].append(data.qacc.tolist())
    return rows


def solvers(start, scene, options, time_step=2e-3):
    """|qacc − qacc of dense Newton| of every solver, cone and Jacobian, run to the end."""
    table = {}
    for cone in ("elliptic", "pyramidal"):
        model, data = _at(start, scene, time_step, {**options, "cone": cone}, SLIDING_STEP)
        model.opt.tolerance, model.opt.iterations = 0.0, 20000
        model.opt.ls_tolerance, model.opt.ls_iterations = 1e-14, 100
        best = None
        for solver in ("NEWTON", "CG", "PGS"):
            for jacobian in ("DENSE", "SPARSE"):
                model.opt.solver = int(getattr(mujoco.mjtSolver, f"mjSOL_{solver}"))
                model.opt.jacobian = int(getattr(mujoco.mjtJacobian, f"mjJAC_{jacobian}"))
                mujoco.mj_forward(model, data)
                best = data.qacc.copy() if best is None else best
                table[f"{cone} {solver} {jacobian}"] = float(np.abs(data.qacc - best).max())
    return table


def turning_corner():
    """J̇v of a contact of a turning box, by differences, and what of it efc_b holds."""
    model = mujoco.MjModel.from_xml_string(CORNER)
    data = mujoco.MjData(model)
    data.qpos[2], data.qpos[3:] = 0.1, [np.cos(0.2), np.sin(0.2), 0.0, 0.0]
    data.qpos[2] = 0.1 * (np.cos(0.4) + np.sin(0.4)) - 1e-3
    data.qvel[:] = [0.3, 0.0, 0.0, 5.0, 0.0, 0.0]

    def rows(seconds):
        other = mujoco.MjData(model)
        other.qpos[:] = data.qpos
        mujoco.mj_integratePos(model, other.qpos, data.qvel, seconds)
        mujoco.mj_forward(model, other)
        return other.efc_J.reshape(-1, model.nv)[:3].copy(), other.contact.pos[0].copy()

    mujoco.mj_forward(model, data)
    smooth = data.efc_J.reshape(-1, model.nv) @ data.qacc_smooth
    tiny = 1e-6
    (ahead, _), (behind, _), (_, point) = rows(tiny), rows(-tiny), rows(0.0)
    return {
        "jacobian_rate_times_velocity": ((ahead - behind) / (2 * tiny) @ data.qvel).tolist(),
        "efc_b_minus_smooth_plus_reference": (data.efc_b - smooth + data.efc_aref)[:3].tolist(),
        "lever": (point - data.qpos[:3]).tolist(), "spin": data.qvel[3:].tolist(),
    }


def time_steps(start, scene, options):
    """|a(h) − a(h/2)| of one state under the integrators Euler and discrete, h = 2 ms."""
    result = {}
    for name in ("EULER", "DISCRETE"):
        model, data = _at(start, scene, 2e-3, {**options, "cone": "elliptic"}, SLIDING_STEP)
        model.opt.tolerance = 0.0
        model.opt.integrator = int(getattr(mujoco.mjtIntegrator, f"mjINT_{name}"))
        found = []
        for h in (2e-3, 1e-3):
            model.opt.timestep = h
            mujoco.mj_forward(model, data)
            found.append(data.qacc.copy())
        result[name] = float(np.abs(found[0] - found[1]).max())
    return result


def damped():
    """v after one step from v = 1 with a damper, or a motor with the same slope, of 1000 N·s/m."""
    result = {}
    for integrator in ("Euler", "implicitfast", "implicit", "RK4"):
        for name, (damping, slope) in {"damper": (1000, 0), "motor": (0, 1000)}.items():
            model = mujoco.MjModel.from_xml_string(MOTOR.format(integrator, damping, slope))
            data = mujoco.MjData(model)
            data.qvel[0] = 1.0
            mujoco.mj_step(model, data)
            result[f"{integrator} {name}"] = float(data.qvel[0])
    return result


def turning_top():
    """Kinetic energy over its start after 100 steps of a free body without torque."""
    result = {}
    ball = '<joint type="ball"/>'
    for joint, name in (('<freejoint/>', "free"), (ball, "ball")):
        for integrator in ("Euler", "implicitfast", "implicit", "RK4"):
            model = mujoco.MjModel.from_xml_string(TOP.format(integrator, joint))
            data = mujoco.MjData(model)
            spin = data.qvel[-3:]
            spin[:] = [3.0, 4.0, 1.0]
            inertia = np.array([0.02, 0.03, 0.04])
            before = float(inertia @ spin**2)
            for _ in range(100):
                mujoco.mj_step(model, data)
            result[f"{integrator} {name}"] = float(inertia @ data.qvel[-3:]**2) / before
    return result


def one_contact():
    """One step of a ball of 1 kg, 1 mm deep, with 1, 3, 4 and 6 contact directions, both cones."""
    steps = {}
    for dimension in (1, 3, 4, 6):
        for cone in ("elliptic", "pyramidal"):
            model = mujoco.MjModel.from_xml_string(SPINNING.format(cone, dimension))
            data = mujoco.MjData(model)
            data.qpos[2] = 0.1 - 1e-3
            data.qvel[:] = [0.5, 0.2, -0.1, 3.0, -2.0, 5.0]
            model.opt.tolerance, model.opt.ls_tolerance = 1e-14, 1e-12
            mujoco.mj_forward(model, data)
            mass = np.zeros((model.nv, model.nv))
            mujoco.mj_fullM(model, data, mass)
            steps[f"{cone} {dimension}"] = {
                "friction": data.contact.friction[0].tolist(), "gap": float(data.contact.dist[0]),
                "mass": np.diag(mass).tolist(), "jacobian": data.efc_J.tolist(),
                **{key: getattr(data, key).tolist() for key in
                   ("qacc_smooth", "qacc", "efc_vel", "efc_R", "efc_aref", "efc_force")}}
    return steps


def inverse(start, scene, options, time_step=2e-3):
    """mj_inverse at a sliding block: the force that another acceleration than the free one asks for.

    `discrete` reads the same numbers as (v⁺ − v)/h of the integrator implicitfast.
    """
    table = {}
    for cone in ("elliptic", "pyramidal"):
        for name, friction in (("3", {}), ("6", {"torsional": 0.02, "rolling": 0.001})):
            model, data = _at(start, scene, time_step, {
                **options, **friction, "cone": cone, "integrator": "implicitfast",
                "tolerance": 1e-20}, SLIDING_STEP)
            mujoco.mj_forward(model, data)
            data.qacc += [0.3, -0.2, -3.0, 1.0, -2.0, 0.5]
            mujoco.mj_inverse(model, data)
            forces, local = [], np.zeros(6)  # on the block, in the world: force, then torque
            for contact in range(data.ncon):
                mujoco.mj_contactForce(model, data, contact, local)
                frame = data.contact.frame[contact].reshape(3, 3)
                forces.append([*(frame.T @ local[:3]).tolist(), *(frame.T @ local[3:]).tolist()])
            found = table[f"{cone} {name}"] = {
                **{key: getattr(data, key).tolist() for key in
                   ("qpos", "qvel", "qacc", "qfrc_inverse")}, "forces": forces}
            model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_INVDISCRETE)
            mujoco.mj_inverse(model, data)
            found["discrete"] = data.qfrc_inverse.tolist()
    return table


def facts(start, scene, options):
    """All of it; `scene` is the block that slides on the incline."""
    return {"stated": stated(),
            "computed": {
                "cg_iterates": iterates(start, scene, options),
                "distance_from_newton": solvers(start, scene, options),
                "turning_corner": turning_corner(),
                "acceleration_change_when_h_halves": time_steps(start, scene, options),
                "velocity_after_a_step": damped(),
                "energy_of_a_top": turning_top(),
                "one_contact": one_contact(),
                "inverse": inverse(start, scene, options),
            }}
