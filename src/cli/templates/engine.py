#!/usr/bin/env python3
"""An engine for `moreau gate`: one ball over a plane, without friction. It gets verdicts as it stands.

    moreau protocol-check -- python3 engine.py      what is wrong with the adapter
    moreau gate --quick -- python3 engine.py        every check; what it cannot do is `unsupported`

Put your engine where YOURS is written. Python's standard library is enough. The messages, moreau-engine/1, are
one JSON object a line; docs/protocol.md of moreau specifies them, `moreau schema request` and `reply` too.

    x_m = x + h/2 v,    v+ = v + h g + p n,    x+ = x_m + h/2 v+,

where p is the least impulse over the mass, p >= 0, with n.v+ >= -e n.v; it acts if the ball touches at x_m.
"""
import json
import sys


class Unsupported(Exception):
    """Raise it for whatever your engine does not have, with the reason. It never counts against the engine."""


# YOURS: who the engine is, and the contact law that it documents. The gate predicts from it what is to be expected.
DESCRIPTION = {
    "name": "my-engine", "version": "0.1.0", "precision": "double",
    "contact_model": {"kind": "rigid", "law": "coulomb"},
    "restitution": True, "friction": "none", "reports_contacts": True,
    "levels": ["simulate"], "shapes": ["sphere"], "options": {},
}


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def plus(a, s, b):
    return [x + s * y for x, y in zip(a, b)]


class World:
    """YOURS: the scene in your engine."""

    def __init__(self, scene, h):
        bodies, material = scene["bodies"], scene["material"]
        if len(bodies) > 1 or "sphere" not in bodies[0] or any(bodies[0].get("angular_velocity", [])):
            raise Unsupported("one ball that does not turn is all there is")
        if material["friction"] > 0 or material.get("pairs"):
            raise Unsupported("there is no friction, and no values of pairs")
        self.h, self.gravity, self.ground, self.ball = h, scene["gravity"], scene.get("ground"), bodies[0]
        self.x, self.v = self.ball["position"], self.ball.get("linear_velocity", [0.0, 0.0, 0.0])
        self.restitution = material.get("restitution", 0.0)

    def step(self):
        """One time step; the impulse [N s] of the ground on the ball, as a vector."""
        h, before, p = self.h, self.v, 0.0
        n, offset = (self.ground["normal"], self.ground["offset"]) if self.ground else ([0.0, 0.0, 1.0], None)
        self.x, self.v = plus(self.x, h / 2, before), plus(before, h, self.gravity)
        if offset is not None and dot(n, self.x) - offset <= self.ball["sphere"]["radius"]:
            p = max(0.0, -dot(n, self.v) - self.restitution * dot(n, before))
        self.v = plus(self.v, p, n)
        self.x = plus(self.x, h / 2, self.v)
        return [self.ball["mass"] * p * component for component in n]

    def state(self):
        """Of every body in the order of the scene: position, orientation [w, x, y, z], velocity, angular velocity."""
        return [(self.x, self.ball.get("orientation", [1.0, 0.0, 0.0, 0.0]), self.v, [0.0, 0.0, 0.0])]


def describe(request):
    if request.get("options"):
        raise ValueError("this engine has no options")
    return DESCRIPTION


def simulate(request):
    """The trajectory/1 of a scene: a sample every `sample_every` steps, impulses summed over the time between samples."""
    describe(request)
    scene, h, every = request["scene"], request["time_step"], request["sample_every"]
    world, steps = World(scene, h), round(scene["duration"] / h)
    if abs(steps * h - scene["duration"]) > 1e-9 * scene["duration"]:
        raise ValueError(f"the time step {h} does not divide the duration {scene['duration']}")
    tracks = [{"name": body["name"], "position": [], "orientation": [], "linear_velocity": [], "angular_velocity": []}
              for body in scene["bodies"]]
    times, contacts, impulse = [], [], [0.0, 0.0, 0.0]
    for step in range(steps + 1):
        impulse = plus(impulse, 1.0, world.step()) if step > 0 else impulse
        if step % every == 0:
            if any(impulse):
                contacts.append({"sample": len(times), "bodies": [scene["bodies"][0]["name"], "ground"],
                                 "normal": scene["ground"]["normal"], "impulse": impulse})
            impulse = [0.0, 0.0, 0.0]
            times.append(step * h)
            for track, values in zip(tracks, world.state()):
                for key, value in zip(list(track)[1:], values):
                    track[key].append(value)
    return {"schema": "trajectory/1", "scene": scene, "time_step": h, "times": times, "bodies": tracks,
            "contacts": contacts, "engine": {"name": DESCRIPTION["name"], "version": DESCRIPTION["version"]}}


HANDLERS = {"describe": describe, "simulate": simulate, "bye": lambda request: {}}


def refuse(token):
    raise ValueError(f"{token} is no number of JSON")


def answer(line):
    """What was asked, and the reply. Nothing below needs to be changed."""
    number = None
    try:
        request = json.loads(line, parse_constant=refuse)
        if not isinstance(request, dict):
            raise ValueError("a request is an object")
        number = request.get("id")
        if request.get("protocol") != "moreau-engine/1":
            raise ValueError("this adapter speaks moreau-engine/1")
        kind = request.get("request")
        if kind not in HANDLERS:
            raise Unsupported(f"there is no request {kind!r}")
        return kind, json.dumps({"id": number, "result": HANDLERS[kind](request)}, allow_nan=False)
    except Unsupported as reason:
        return "", json.dumps({"id": number, "unsupported": str(reason)})
    except Exception as problem:
        return "", json.dumps({"id": number, "error": f"{type(problem).__name__}: {problem}"})


if __name__ == "__main__":
    replies, sys.stdout = sys.stdout, sys.stderr  # what anything prints is no reply
    for line in sys.stdin:
        kind, reply = answer(line)
        print(reply, file=replies, flush=True)
        if kind == "bye":
            break
