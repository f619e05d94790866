#!/usr/bin/env python3
"""Print, from the stored files alone, the numbers quoted in references/README.md (Markdown).

Needs the standard library only and runs no engine.
"""

import math
import sys
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS))

from reference.documents import read  # noqa: E402
from reference.plan import STEPS, Job, all_jobs  # noqa: E402

REFERENCES = SCRIPTS.parent / "references"
GRAVITY = 9.81
DOWNHILL = (math.cos(math.radians(20)), 0.0, -math.sin(math.radians(20)))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def gaps(document, half_height):
    """Height of a body's lowest face or point over the ground plane, per sample."""
    ground = document["scene"]["ground"]
    return [dot(x, ground["normal"]) - ground["offset"] - half_height
            for x in document["bodies"][0]["position"]]


def rest_depth(document):
    return -gaps(document, 0.1)[-1]


def creep(document):
    """Mean downhill velocity over the last half of the motion."""
    velocity = [dot(v, DOWNHILL) for v in document["bodies"][0]["linear_velocity"]]
    half = velocity[len(velocity) // 2:]
    return sum(half) / len(half)


def restitution(document):
    """√(energy after / before) of the first impact, from the ballistic energy in flight.

    The energy per mass v²/2 + g z above the touching height is taken at the first sample and at
    the highest sample after the first contact; 0 when the ball does not leave again.
    """
    z = gaps(document, 0.1)
    v = [velocity[2] for velocity in document["bodies"][0]["linear_velocity"]]
    first = next(i for i in range(1, len(v)) if v[i] > v[i - 1])
    apex = first
    while apex + 1 < len(z) and (v[apex] <= 0 or v[apex + 1] > 0):
        apex += 1
    after = 0.5 * v[apex] ** 2 + GRAVITY * z[apex]
    return math.sqrt(max(after, 0.0) / (GRAVITY * z[0]))


def rebound_speed(document):
    """Largest upward velocity in the samples, divided by the impact speed √(2 g H)."""
    fall = gaps(document, 0.1)[0]
    return (max(v[2] for v in document["bodies"][0]["linear_velocity"])
            / math.sqrt(2 * GRAVITY * fall))


def mujoco_rest_depth(softness):
    """Root of k d(r)² r = softness (1 − d(r)) g for the default solref and solimp.

    softness is 1 for one elliptic contact of a free sphere (R = (1−d)/(d m)) and
    2μ²(1+μ²)/4 for a pyramid, whose four edges share the weight.
    """
    stiffness = 1 / (0.95 * 0.02) ** 2

    def excess(r):
        d = 0.9 + 0.05 * 2 * (r / 1e-3) ** 2  # r ≤ width/2, power 2
        return stiffness * d * d * r - softness * (1 - d) * GRAVITY

    low, high = 0.0, 5e-4
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (low, middle) if excess(middle) > 0 else (middle, high)
    return low


def acceleration(document):
    """2 s / t² of the block at the end."""
    positions, end = document["bodies"][0]["position"], document["times"][-1]
    return 2 * (dot(positions[-1], DOWNHILL) - dot(positions[0], DOWNHILL)) / end ** 2


def largest_gap(document):
    return max(gaps(document, 0.05))


def stack_sink(document):
    """How far the top box stands below its place in a rigid stack."""
    return 0.9 - document["bodies"][-1]["position"][-1][2]


def stack_drift(document):
    """Largest horizontal displacement of a box at the end."""
    return max(math.hypot(*body["position"][-1][:2]) for body in document["bodies"])


MEASURES = (
    ("ball_rest", "rest depth [m]", rest_depth, "{:.8e}"),
    ("ball_drop", "effective restitution by energy above the ground, first impact", restitution,
     "{:.4f}"),
    ("ball_drop", "largest rebound velocity / impact velocity", rebound_speed, "{:.4f}"),
    ("ball_drop", "deepest sample [m]", lambda d: -min(gaps(d, 0.1)), "{:.4e}"),
    ("ball_drop", "depth at 2 s [m]", rest_depth, "{:.6e}"),
    ("ball_drop_elastic", "effective restitution of the first impact", restitution, "{:.4f}"),
    ("block_stick", "creep [m/s]", creep, "{:.5e}"),
    ("block_slide", "acceleration 2 s/t² [m/s²]; Coulomb 0.58970", acceleration, "{:.5f}"),
    ("block_slide", "largest gap [m]", largest_gap, "{:.3e}"),
    ("five_box_stack", "sink of the top box [m]", stack_sink, "{:.6e}"),
    ("five_box_stack", "horizontal drift [m]", stack_drift, "{:.1e}"),
)


def runs():
    """The jobs that are motions or steps of one."""
    return [job for job in all_jobs() if isinstance(job, Job)]


def motions():
    """{(scene, engine, config): {h: document}}."""
    result = {}
    for job in runs():
        document = read(REFERENCES / job.path)
        if document["schema"] == "trajectory/1":
            key = (job.scene, job.engine, job.config)
            result.setdefault(key, {})[job.time_step] = document
    return result


def print_motions():
    documents = motions()
    for scene, title, measure, form in MEASURES:
        print(f"\n**{scene}: {title}**\n")
        print("| engine, configuration | " + " | ".join(f"h = {h:g}" for h in STEPS) + " |")
        print("|---|" + "---|" * len(STEPS))
        for (name, engine, config), by_step in documents.items():
            if name == scene:
                cells = [form.format(measure(by_step[h])) if h in by_step else "–" for h in STEPS]
                print(f"| {engine} {config} | " + " | ".join(cells) + " |")


def print_stick_dumps():
    """Creep predicted by the compliance in the dumps: v = m g sin α / (b Σ 1/R_t), MuJoCo."""
    print("\n**creep of MuJoCo's elliptic block from its own R_t and b**\n")
    for job in runs():
        if job.is_dump and job.scene == "block_stick" and job.config == "newton-elliptic":
            native = read(REFERENCES / job.path)["native"]
            tangential = native["efc_R"][1::3]
            damping = native["efc_KBIP"]["rows"][0][1]
            force = GRAVITY * math.sin(math.radians(20))
            print(f"- {job.path}: b = {damping:.6f}, Σ1/R_t = {sum(1 / r for r in tangential):.6f}"
                  f", v = {force / (damping * sum(1 / r for r in tangential)):.6e}")


def print_drake_creep():
    """Regularised friction carries tan α when μ f(s) = tan α at the speed v = s v_s.

    similar, lagged: f = s/√(1+s²); tamsi: f = s(2−s).
    """
    load, tolerance = math.tan(math.radians(20)) / 0.5, 1e-4
    print("\n**creep of Drake's regularised models in closed form**\n")
    print(f"- similar, lagged: {tolerance * load / math.sqrt(1 - load * load):.5e} m/s")
    print(f"- tamsi: {tolerance * (1 - math.sqrt(1 - load)):.5e} m/s")


def print_drake_dumps():
    print("\n**Drake SAP: closed forms and the rebuilt step**\n")
    print("| dump | w [1/kg] | σ h m g sin α / Σ 1/w [m/s] | Δ law velocity | Δ impulse | λ_min |"
          "\n|---|---|---|---|---|---|")
    for job in runs():
        if job.is_dump and job.engine == "drake":
            document = read(REFERENCES / job.path)
            native, checks = document["native"], document["checks"]
            force = GRAVITY * math.sin(math.radians(20))
            predicted = (1e-3 * job.time_step * force / sum(1 / w for w in native["w"])
                         if job.scene == "block_stick" else None)
            print(f"| {job.path.split('/')[1]} | "
                  f"{', '.join(sorted({format(w, '.6f') for w in native['w']}))} | "
                  f"{'–' if predicted is None else format(predicted, '.5e')} | "
                  f"{checks['law_velocity_relative_difference']:.1e} | "
                  f"{checks['impulse_relative_difference']:.1e} | "
                  f"{checks['smallest_eigenvalue']:.3e} |")


def print_drake_gap():
    """Contact gap and (h+τ)(μ|v_t| − (R_n + μ²R_t) r_n) of the sliding block, per dump."""
    print("\n**Drake SAP: sliding gap [m] of each contact against the closed form**\n")
    for job in runs():
        if job.is_dump and job.engine == "drake" and job.scene == "block_slide":
            document = read(REFERENCES / job.path)
            native, answer = document["native"], document["answer"]
            mu = document["problem"]["friction"][0]
            factor = native["time_step"] + native["relaxation_time"]
            for i, phi in enumerate(native["phi"]):
                speed = math.hypot(*answer["velocity"][3 * i + 1:3 * i + 3])
                impulse = answer["impulse"][3 * i]
                softness = native["R_n"][i] + mu * mu * native["R_t"][i]
                steady = factor * (mu * speed - softness * impulse)
                print(f"- {job.path.split('/')[1]} contact {i}: φ = {phi:.6e}, closed form "
                      f"{steady:.6e}, minus (h+τ) u_n {steady - factor * answer['velocity'][3 * i]:.6e}")


def print_mujoco_dumps():
    """How well each stored answer solves its own problem, without a solver.

    gap = h |f·(A f + R f + b)| is zero at a solution; shown relative to h |f·b|.
    """
    print("\n**MuJoCo dumps: iterations and |f·((A+R) f + b)| / |f·b|**\n")
    print("| dump | contacts | iterations | complementarity |\n|---|---|---|---|")
    for job in runs():
        if job.is_dump and job.engine == "mujoco":
            document = read(REFERENCES / job.path)
            native, force = document["native"], document["native"]["efc_force"]
            rows, mass = native["efc_J"]["rows"], native["M"]["rows"]
            generalized = [sum(row[j] * f for row, f in zip(rows, force))
                           for j in range(len(mass))]
            diagonal = all(mass[i][j] == 0 for i in range(len(mass))
                           for j in range(len(mass)) if i != j)
            assert diagonal, "spheres and boxes have diagonal mass matrices"
            response = [g / mass[j][j] for j, g in enumerate(generalized)]
            total = sum(f * (dot(row, response) + r * f + b) for f, row, r, b in
                        zip(force, rows, native["efc_R"], native["efc_b"]))
            print(f"| {job.path.split('/')[1]} | {len(native['contacts'])} | "
                  f"{native['iterations']} | {abs(total) / abs(dot(force, native['efc_b'])):.1e} |")


if __name__ == "__main__":
    print_motions()
    print("\n**MuJoCo rest depth in closed form**\n")
    print(f"- one elliptic contact: {mujoco_rest_depth(1.0):.8e} m")
    print(f"- one pyramid, μ = 0.5: {mujoco_rest_depth(0.5 * 1.25 * 0.25):.8e} m")
    print_stick_dumps()
    print_drake_creep()
    print_drake_dumps()
    print_drake_gap()
    print_mujoco_dumps()
