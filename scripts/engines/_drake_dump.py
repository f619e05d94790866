"""One Drake SAP step, rebuilt outside Drake as `contact-problem/1` and `solution/1`.

SAP's dual problem has the associated law K ∋ r ⟂ u + shift + R r ∈ K* with, for every contact i,

    w   = ‖J_i diag(M)⁻¹ J_iᵀ‖_F / 3,          J_i the contact's own three rows,
    R_n = max(w / (4π²), 1 / (h k (h + τ))),    R_t = 1e-3 w,    shift_n = φ / (h + τ),

k the stiffness of the pair [N/m], τ its relaxation time [s], φ < 0 the signed distance.  Only the
diagonal of M enters w, so w depends on the axes M is written in: for a block that is tilted, the
creep of a stick tells diag(M)⁻¹ from M⁻¹ (2.4099 from 2.4610 1/kg), a slide does not.

Drake's Python interface shows none of these; the rebuilt problem is solved here and its answer
compared with the contact forces Drake reports.  Both differences are stored in `checks`: that of
the law's velocity y = W r + free_velocity + shift + R r, and that of the impulse, which may be
larger by 1 / λ_min(W + R): impulses that cancel inside a sticking block meet only R_t.
"""

import numpy as np
from pydrake.multibody.tree import JacobianWrtVariable

NEAR_RIGID_SCALE = 4 * np.pi ** 2
SIGMA = 1e-3
DIFFERENCE_LIMIT = 1e-5  # relative; ten times SAP's own relative tolerance


def matrix(values):
    """The JSON form of a matrix."""
    values = np.asarray(values, dtype=float)
    return {"shape": list(values.shape), "rows": values.tolist()}


def frame_of(normal):
    """Rows (n, t₁, t₂), right-handed; t₁ from the coordinate axis least aligned with n."""
    axis = np.zeros(3)
    axis[np.argmin(np.abs(normal))] = 1.0
    first = np.cross(normal, axis)
    first /= np.linalg.norm(first)
    return np.array([normal, first, np.cross(normal, first)])


def project(impulse, friction):
    """Projection of each row (n, t₁, t₂) on its cone ‖r_t‖ ≤ μ r_n."""
    normal, tangent = impulse[:, 0], np.linalg.norm(impulse[:, 1:], axis=1)
    on_surface = np.maximum((normal + friction * tangent) / (1 + friction ** 2), 0.0)
    result = np.zeros_like(impulse)
    result[:, 0] = on_surface
    safe = np.where(tangent > 0, tangent, 1.0)
    result[:, 1:] = impulse[:, 1:] * (friction * on_surface / safe)[:, None]
    inside = tangent <= friction * normal
    result[inside] = impulse[inside]
    return result


def solve(operator, offset, friction, sweeps=200_000):
    """min ½ rᵀ A r + bᵀ r over the cones: accelerated projected gradient with restart."""
    step = 1.0 / np.linalg.eigvalsh(operator)[-1]
    answer = point = np.zeros_like(offset)
    momentum = 1.0
    for _ in range(sweeps):
        gradient = operator @ point + offset
        new = project((point - step * gradient).reshape(-1, 3), friction).ravel()
        change = np.abs(new - point).max()
        if gradient @ (new - answer) > 0:
            momentum = 1.0
        following = (1 + np.sqrt(1 + 4 * momentum ** 2)) / 2
        point = new + (momentum - 1) / following * (new - answer)
        answer, momentum = new, following
        if change <= 1e-16 * max(np.abs(new).max(), 1e-300):
            break
    return answer


def _jacobian(model, link, point):
    """Translational velocity Jacobian of the body's material point now at `point` (world)."""
    local = model.plant.EvalBodyPoseInWorld(model.context, link).inverse() @ point
    world = model.plant.world_frame()
    return model.plant.CalcJacobianTranslationalVelocity(
        model.context, JacobianWrtVariable.kV, link.body_frame(), local, world, world)


def dump_of(model, step, version):
    """The dump/1 of the step Drake is about to make."""
    plant, context, h, options = model.plant, model.context, model.time_step, model.options
    stiffness, tau = options["stiffness"], options["relaxation_time"]
    mu = model.scene["material"]["friction"]
    infos = model.contacts()
    if not infos:
        raise ValueError(f"no contact in step {step}")
    mass = plant.CalcMassMatrix(context)
    velocity = plant.GetVelocities(context).copy()
    applied = plant.CalcGravityGeneralizedForces(context) - plant.CalcBiasTerm(context)
    free = velocity + h * np.linalg.solve(mass, applied)
    jacobian, gaps, impulse, contacts = [], [], [], []
    for info in infos:
        a, b = plant.get_body(info.bodyA_index()), plant.get_body(info.bodyB_index())
        point, pair = info.contact_point(), info.point_pair()
        normal, force = pair.nhat_BA_W, -info.contact_force()
        if model.name_of(info.bodyA_index()) == "ground":  # the ground is always the second
            a, b, normal, force = b, a, -normal, -force
        frame = frame_of(normal)
        jacobian.append(frame @ (_jacobian(model, a, point) - _jacobian(model, b, point)))
        gaps.append(-pair.depth)
        impulse.append(h * (frame @ force))
        contacts.append({"bodies": [a.name(), model.name_of(b.index())], "phi": -pair.depth,
                         "pos": point.tolist(), "frame": matrix(frame), "force": force.tolist()})
    count = len(infos)
    jacobian, impulse, gaps = np.concatenate(jacobian), np.concatenate(impulse), np.array(gaps)
    delassus = jacobian @ np.linalg.solve(mass, jacobian.T)
    blocks = [jacobian[3 * i:3 * i + 3] for i in range(count)]
    weights = np.array([np.linalg.norm(block / np.diag(mass) @ block.T) / 3 for block in blocks])
    normal_compliance = np.maximum(weights / NEAR_RIGID_SCALE, 1 / (h * stiffness * (h + tau)))
    compliance = np.column_stack([normal_compliance, SIGMA * weights, SIGMA * weights]).ravel()
    shift = np.column_stack([gaps / (h + tau), np.zeros(count), np.zeros(count)]).ravel()
    free_velocity = jacobian @ free

    operator, offset = delassus + np.diag(compliance), free_velocity + shift
    rebuilt = solve(operator, offset, np.full(count, mu))
    model.advance()
    next_velocity = plant.GetVelocities(context).copy()
    contact_velocity = jacobian @ next_velocity
    scale = np.abs(impulse).max()
    momentum = mass @ (next_velocity - velocity) - h * applied - jacobian.T @ impulse
    checks = {
        "law_velocity_relative_difference": float(
            np.abs(operator @ (rebuilt - impulse)).max() / np.abs(offset).max()),
        "impulse_relative_difference": float(np.abs(rebuilt - impulse).max() / scale),
        "smallest_eigenvalue": float(np.linalg.eigvalsh(operator)[0]),
        "velocity_minus_delassus_impulse_minus_free_velocity": float(
            np.abs(contact_velocity - delassus @ impulse - free_velocity).max()),
        "momentum_residual": float(np.abs(momentum).max()),
    }
    if max(checks["law_velocity_relative_difference"],
           checks["impulse_relative_difference"]) > DIFFERENCE_LIMIT:
        raise RuntimeError(f"the rebuilt SAP problem does not explain Drake's answer: {checks}")
    name = f"drake step {step}"
    problem = {
        "schema": "contact-problem/1", "name": name, "dimension": 3, "law": "associated",
        "friction": [mu] * count, "free_velocity": free_velocity.tolist(),
        "shift": shift.tolist(), "mass": matrix(mass), "jacobian": matrix(jacobian),
        "compliance": {"coordinates": "contact", "diagonal": compliance.tolist()},
        "provenance": {"engine": "drake", "version": version, "step": step, "time_step": h,
                       "options": options},
    }
    answer = {"schema": "solution/1", "problem": name, "impulse": impulse.tolist(),
              "velocity": contact_velocity.tolist(), "solver": "drake sap"}
    native = {
        "M": matrix(mass), "J": matrix(jacobian), "v": velocity.tolist(),
        "v_free": free.tolist(), "v_next": next_velocity.tolist(),
        "generalized_force": applied.tolist(), "phi": gaps.tolist(), "w": weights.tolist(),
        "R_n": normal_compliance.tolist(), "R_t": (SIGMA * weights).tolist(),
        "stiffness": stiffness, "relaxation_time": tau, "contacts": contacts,
        "rebuilt_impulse": rebuilt.tolist(),
        "time": step * h, "time_step": h,
    }
    return {"schema": "dump/1", "problem": problem, "answer": answer, "native": native,
            "checks": checks}
