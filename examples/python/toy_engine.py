"""A toy engine as a class: one ball over a plane, without friction, by Moreau's midpoint rule.

    x_m = x + ½ h v,    v⁺ = v + h g + p n,    x⁺ = x_m + ½ h v⁺,

where p is the least impulse ≥ 0 with n·v⁺ ≥ −e n·v, acting if the ball touches at x_m.
"""
import os

import numpy as np

from moreau_contact import Unsupported

# a planted mistake: e acts twice
BUG = os.environ.get("TOY_BUG") == "1"


class Toy:
    """Answers the questions of the gate: docs/protocol.md has every field."""

    def describe(self, options):
        self._without(options)
        return {"name": "toy", "version": "1", "precision": "double", "restitution": True, "friction": "none",
                "reports_contacts": False, "levels": ["simulate"], "contact_model": {"kind": "rigid", "law": "coulomb"}}

    def simulate(self, scene, time_step, sample_every, options):
        self._without(options)
        ball, material = scene["bodies"][0], scene["material"]
        if len(scene["bodies"]) > 1 or "sphere" not in ball or any(ball.get("angular_velocity", [])):
            raise Unsupported("the toy has one ball, which does not turn")
        if material["friction"] > 0 or material.get("pairs"):
            raise Unsupported("the toy has no friction and no values for pairs")
        e, h, ground = material.get("restitution", 0.0) ** (2 if BUG else 1), time_step, scene.get("ground")
        x, v = np.array(ball["position"], float), np.array(ball.get("linear_velocity", [0, 0, 0]), float)
        positions, velocities = [x], [v]
        for step in range(1, round(scene["duration"] / h) + 1):
            x, before, v = x + h / 2 * v, v, v + h * np.array(scene["gravity"])
            if ground is not None:
                n = np.array(ground["normal"])
                if n @ x - ground["offset"] <= ball["sphere"]["radius"]:
                    v = v + max(0.0, -n @ v - e * (n @ before)) * n
            x = x + h / 2 * v
            if step % sample_every == 0:
                positions.append(x)
                velocities.append(v)
        count = len(positions)
        track = {"name": ball["name"], "position": positions, "linear_velocity": velocities,
                 "orientation": [ball.get("orientation", [1, 0, 0, 0])] * count, "angular_velocity": np.zeros((count, 3))}
        return {"schema": "trajectory/1", "scene": scene, "time_step": h, "engine": {"name": "toy", "version": "1"},
                "times": np.arange(count) * sample_every * h, "bodies": [track]}

    def _without(self, options):
        if options:
            raise ValueError("the toy has no options")
