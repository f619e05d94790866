"""Scenes through schemes, held against closed forms and the command."""
import json

import moreau_contact as mc
import numpy as np
import pytest


def test_free_flight_is_a_parabola():
    scene = {"schema": "scene/1", "name": "flight", "description": "a ball in the air", "gravity": [0, 0, -10], "duration": 1.0,
             "material": {"friction": 0.0, "restitution": 0.0},
             "bodies": [{"name": "ball", "mass": 1.0, "sphere": {"radius": 0.1}, "position": [0, 0, 5], "linear_velocity": [2, 0, 0]}]}
    motion = mc.simulate(scene, step=0.125)
    ball, t = motion.body("ball"), motion.times
    assert t.shape == (9,) and ball["position"].shape == (9, 3) and ball["orientation"].shape == (9, 4)
    # θ = ½ integrates constant acceleration exactly
    np.testing.assert_allclose(ball["position"], np.stack([2 * t, 0 * t, 5 - 5 * t**2], axis=1), atol=1e-12)
    assert motion.contacts["sample"].size == 0 and motion.rejected == 0


def test_the_calls_of_the_documentation_are_right():
    motion = mc.simulate("incline-slide", scheme="stewart-trinkle", step=1 / 240)
    assert motion.body("block")["position"].shape == (len(motion.times), 3)


def test_the_motion_is_that_of_the_command(command, tmp_path):
    command("simulate", "--scene", "incline-slide", "--step", "0.01", "--theta", "1", "--out", "theirs.json")
    motion = mc.simulate("incline-slide", step=0.01, theta=1)
    theirs, ours = json.loads((tmp_path / "theirs.json").read_text()), json.loads(motion.to_json())
    assert ours["bodies"] == theirs["bodies"] and ours["contacts"] == theirs["contacts"]
    assert motion.contacts["impulse"].shape == (len(ours["contacts"]), 3)
    motion.write(tmp_path / "ours.json")
    assert json.loads((tmp_path / "ours.json").read_text()) == ours


def test_a_motion_that_ends_at_another_time_says_so():
    motion = mc.simulate("incline-slide", step=0.3, duration=1.0)
    assert motion.times[-1] == pytest.approx(0.9) and "the motion ends after 0.9 s" in motion.note
    assert mc.simulate("incline-slide", step=0.25, duration=1.0).note is None


def test_a_linkage_has_coordinates_and_no_bodies():
    name = next(scene for scene in mc.scenes() if "pendulum" in scene or "rod" in scene or "linkage" in scene)
    motion = mc.simulate(name, step=0.01, duration=0.1)
    assert len(motion.times) == len(motion.q) == len(motion.v) == 11
    if not motion.bodies:
        with pytest.raises(mc.InvalidInput):
            motion.to_json()


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ({"scene": "bouncing-bal"}, "bouncing-ball"),
        ({"scene": 7}, "scene"),
        ({"scheme": "magic"}, "moreau-jean"),
        ({"step": 0.0}, "step"),
        ({"step": float("nan")}, "step"),
        ({"theta": 2.0}, "theta"), ({"thet": 1.0}, "did you mean `theta`"),
        ({"thta": 1.0}, "thta"),
        ({"spectral_radius": 0.5}, "spectral_radius"),
        ({"tolerance": 2.0}, "tolerance"),
    ],
)
def test_what_is_not_allowed_is_told(arguments, word):
    with pytest.raises(mc.MoreauError, match=word):
        mc.simulate(**({"scene": "bouncing-ball"} | arguments))


def test_a_motion_with_rejected_steps_is_raised_and_kept():
    with pytest.raises(mc.Rejected) as caught:
        mc.simulate("box-stack", solver="pgs", step=0.01, duration=0.5, tolerance=1e-15)
    assert caught.value.solution.rejected > 0
    assert mc.simulate("box-stack", solver="pgs", step=0.01, duration=0.5, tolerance=1e-15, accept_rejected=True).rejected > 0
