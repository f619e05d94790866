"""One MuJoCo step as `contact-problem/1` and `solution/1`.

MuJoCo works with accelerations and forces, the problem with velocities and impulses.  With
r = h f, u = J v⁺ and the law's argument y = u + shift + R r,

    free_velocity = J (v + h a_smooth),   shift = −J v − h a_ref,
    free_velocity + shift = h (J a_smooth − a_ref) = h efc_b,

so y = h (A f + R f + efc_b): the same cone condition, multiplied by h.  Pyramid rows come as
(n + μ t₁, n − μ t₁, n + μ t₂, n − μ t₂); the problem's edges go around the circle, +t₁, +t₂,
−t₁, −t₂.
"""

import mujoco
import numpy as np

EDGE_ORDER = [0, 2, 1, 3]


def matrix(values):
    """The JSON form of a matrix."""
    values = np.asarray(values, dtype=float)
    return {"shape": list(values.shape), "rows": values.tolist()}


def contact_rows(edges, friction):
    """Contact components (n, t₁, t₂) of a linear map given on the four edges n ± μ t."""
    normal = edges.mean(axis=0)
    return np.array([normal, (edges[0] - edges[1]) / (2 * friction),
                     (edges[2] - edges[3]) / (2 * friction)])


def contact_impulse(edges, friction):
    """Σ_j f_j (n ± μ t_j): the impulse in (n, t₁, t₂) of four edge impulses."""
    return np.array([edges.sum(), friction * (edges[0] - edges[1]),
                     friction * (edges[2] - edges[3])])


def _check(name, error, scale):
    """Record a consistency error; fail when it is more than accumulated rounding."""
    if error > 1e-12 * max(scale, 1.0):
        raise RuntimeError(f"{name}: error {error:.3e} at scale {scale:.3e}")
    return float(error)


def dump_of(model, data, step, options):
    """The dump/1 of the step MuJoCo is about to make (call `mj_forward` before)."""
    h, nv, nefc = model.opt.timestep, model.nv, data.nefc
    if data.ncon == 0:
        raise ValueError(f"no contact in step {step}")
    if any(c.dim != 3 for c in data.contact):
        raise ValueError("only contacts with friction are dumped")
    pyramidal = options["cone"] == "pyramidal"
    mass = np.zeros((nv, nv))
    mujoco.mj_fullM(model, data, mass)
    rows = data.efc_J.reshape(nefc, nv)
    shift_rows = -rows @ data.qvel - h * data.efc_aref
    friction = [float(c.friction[0]) for c in data.contact]
    jacobian, shift, impulse, beta = [], [], [], []
    for i, contact in enumerate(data.contact):
        first = contact.efc_address
        block = slice(first, first + (4 if pyramidal else 3))
        force = h * data.efc_force[block]
        if pyramidal:
            jacobian.append(contact_rows(rows[block], friction[i]))
            shift.append(contact_rows(shift_rows[block], friction[i]))
            impulse.append(contact_impulse(force, friction[i]))
            beta.append(force[EDGE_ORDER])
        else:
            jacobian.append(rows[block])
            shift.append(shift_rows[block])
            impulse.append(force)
    jacobian, shift = np.concatenate(jacobian), np.concatenate(shift)
    impulse = np.concatenate(impulse)
    free_velocity = jacobian @ (data.qvel + h * data.qacc_smooth)
    velocity = jacobian @ (data.qvel + h * data.qacc)
    delassus = jacobian @ np.linalg.solve(mass, jacobian.T)
    compliance = data.efc_R[:nefc].copy()
    if pyramidal:
        compliance = compliance.reshape(-1, 4)[:, EDGE_ORDER].ravel()

    scale = np.abs(h * data.efc_b).max()
    target = h * data.efc_b
    if pyramidal:
        target = np.concatenate([contact_rows(target[c.efc_address:c.efc_address + 4], mu)
                                 for c, mu in zip(data.contact, friction)])
    checks = {
        "free_velocity_plus_shift_minus_h_efc_b": _check(
            "h efc_b", np.abs(free_velocity + shift - target).max(), scale),
        # Not rounding: Newton and CG iterate on accelerations and derive the forces, so this is
        # h J M⁻¹ times the gradient they stopped at.
        "velocity_minus_delassus_impulse_minus_free_velocity": float(
            np.abs(velocity - delassus @ impulse - free_velocity).max()),
    }
    name = f"mujoco step {step}"
    problem = {
        "schema": "contact-problem/1", "name": name, "dimension": 3,
        "law": "polyhedral-associated" if pyramidal else "associated",
        **({"directions": 4} if pyramidal else {}),
        "friction": friction, "free_velocity": free_velocity.tolist(), "shift": shift.tolist(),
        "mass": matrix(mass), "jacobian": matrix(jacobian),
        "compliance": {"coordinates": "edge" if pyramidal else "contact",
                       "diagonal": compliance.tolist()},
        "provenance": {"engine": "mujoco", "version": mujoco.__version__, "step": step,
                       "time_step": h, "options": options},
    }
    iterations = int(data.solver_niter[:max(data.nisland, 1)].max())
    answer = {
        "schema": "solution/1", "problem": name, "impulse": impulse.tolist(),
        "velocity": velocity.tolist(),
        **({"beta": np.concatenate(beta).tolist()} if pyramidal else {}),
        "solver": f"mujoco {options['solver']}", "iterations": iterations,
    }
    native = {
        "M": matrix(mass), "efc_J": matrix(rows), "qpos": data.qpos.tolist(),
        "qvel": data.qvel.tolist(), "qacc": data.qacc.tolist(),
        "qacc_smooth": data.qacc_smooth.tolist(),
        **{f"efc_{key}": getattr(data, f"efc_{key}").tolist()
           for key in ("R", "D", "aref", "b", "force", "pos", "vel", "diagA")},
        "efc_KBIP": matrix(data.efc_KBIP.reshape(nefc, 4)),
        "contacts": [{
            "bodies": [model.geom(c.geom2).name, model.geom(c.geom1).name],
            "dist": float(c.dist), "mu": mu, "pos": c.pos.tolist(),
            "frame": matrix(c.frame.reshape(3, 3)), "efc_address": int(c.efc_address),
        } for c, mu in zip(data.contact, friction)],
        "solver": options["solver"], "cone": options["cone"], "iterations": iterations,
        "iteration_limit": options["iterations"], "tolerance": options["tolerance"],
        "islands": int(data.nisland), "time": float(data.time), "time_step": h,
    }
    return {"schema": "dump/1", "problem": problem, "answer": answer, "native": native,
            "checks": checks}
