#!/usr/bin/env python3
"""A toy engine for the gate: one ball over a plane, without friction, by Moreau's midpoint rule.

    x_m = x + ½ h v,    v⁺ = v + h g + p n,    x⁺ = x_m + ½ h v⁺,

where p is the least impulse ≥ 0 with n·v⁺ ≥ −e n·v, acting if the ball touches at x_m.

    moreau gate --quick -- python3 examples/toy_engine.py          no check fails
    moreau gate --quick -- python3 examples/toy_engine.py --bug    e acts twice: ball/… fails
"""
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "scripts" / "engines"))
from _protocol import Unsupported, serve  # noqa: E402

BUG = "--bug" in sys.argv


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def plus(a, s, b):
    return [x + s * y for x, y in zip(a, b)]


def no_options(request):
    if request.get("options"):
        raise ValueError("the toy has no options")


def describe(request):
    no_options(request)
    return {"name": "toy", "version": "1", "precision": "double", "restitution": True,
            "friction": "none", "reports_contacts": False, "levels": ["simulate"],
            "contact_model": {"kind": "rigid", "law": "coulomb"}}


def simulate(request):
    no_options(request)
    scene, h, ball = request["scene"], request["time_step"], request["scene"]["bodies"][0]
    if len(scene["bodies"]) > 1 or "sphere" not in ball or any(ball.get("angular_velocity", [])):
        raise Unsupported("the toy has one ball, which does not turn")
    if scene["material"]["friction"] > 0 or scene["material"].get("pairs"):
        raise Unsupported("the toy has no friction and no values for pairs")
    e = scene["material"].get("restitution", 0.0) ** (2 if BUG else 1)
    x, v = ball["position"], ball.get("linear_velocity", [0.0, 0.0, 0.0])
    samples = [(x, v)]
    for step in range(1, round(scene["duration"] / h) + 1):
        x, before, v = plus(x, h / 2, v), v, plus(v, h, scene["gravity"])
        if (plane := scene.get("ground")) is not None:
            n = plane["normal"]
            if dot(n, x) - plane["offset"] <= ball["sphere"]["radius"]:
                v = plus(v, max(0.0, -dot(n, v) - e * dot(n, before)), n)
        x = plus(x, h / 2, v)
        if step % request["sample_every"] == 0:
            samples.append((x, v))
    return {"schema": "trajectory/1", "scene": scene, "time_step": h,
            "engine": {"name": "toy", "version": "1"},
            "times": [k * request["sample_every"] * h for k in range(len(samples))],
            "bodies": [{"name": ball["name"], "position": [x for x, _ in samples],
                        "orientation": [ball.get("orientation", [1.0, 0.0, 0.0, 0.0])] * len(samples),
                        "linear_velocity": [v for _, v in samples],
                        "angular_velocity": [[0.0, 0.0, 0.0]] * len(samples)}]}


if __name__ == "__main__":
    serve({"describe": describe, "simulate": simulate})
