"""The scenes of the reference files, as `scene/1` objects.

Bodies start 1 µm above what carries them, not in touch with it: a gap of exactly zero would be
decided by rounding, and the first step with it.
"""

import math

START_GAP = 1e-6
INCLINE = math.radians(20.0)
LEVEL = {"normal": [0.0, 0.0, 1.0], "offset": 0.0}
TILTED = {"normal": [math.sin(INCLINE), 0.0, math.cos(INCLINE)], "offset": 0.0}


def _scene(name, description, ground, bodies, friction, duration, engines, restitution=0.0):
    return {
        "schema": "scene/1", "name": name, "description": description,
        "gravity": [0.0, 0.0, -9.81], "ground": ground, "bodies": bodies,
        "material": {"friction": friction, "restitution": restitution},
        "duration": duration, "engines": engines,
    }


def _ball(gap):
    return {"name": "ball", "sphere": {"radius": 0.1}, "mass": 1.0,
            "position": [0.0, 0.0, 0.1 + gap], "orientation": [1.0, 0.0, 0.0, 0.0],
            "linear_velocity": [0.0] * 3, "angular_velocity": [0.0] * 3}


def _box(name, half_extents, position, orientation=(1.0, 0.0, 0.0, 0.0)):
    return {"name": name, "box": {"half_extents": half_extents}, "mass": 1.0,
            "position": position, "orientation": list(orientation),
            "linear_velocity": [0.0] * 3, "angular_velocity": [0.0] * 3}


def _kicked(body, speed):
    """The body sliding at 30 degrees to the x axis."""
    angle = math.pi / 6
    return {**body, "linear_velocity": [speed * math.cos(angle), speed * math.sin(angle), 0.0]}


def _block_on_incline(name, description, friction):
    half_height = 0.05
    position = [x * (half_height + START_GAP) for x in TILTED["normal"]]
    tilt = (math.cos(INCLINE / 2), 0.0, math.sin(INCLINE / 2), 0.0)
    block = _box("block", [0.1, 0.1, half_height], position, tilt)
    drake = {"stiffness": 2e3, "dissipation": 10.0, "relaxation_time": 0.005,
             "stiction_tolerance": 1e-4}
    return _scene(name, description, TILTED, [block], friction, 1.0, {"drake": drake})


def _moving(body, position, linear, angular, orientation=(1.0, 0.0, 0.0, 0.0)):
    return {**body, "position": position, "orientation": list(orientation),
            "linear_velocity": linear, "angular_velocity": angular}


def _landing_boxes():
    """The five boxes 0.2 mm apart, each sliding over the one below it."""
    return [{**box, "position": [0.0, 0.0, box["position"][2] + 2e-4 * (i + 1)],
             "linear_velocity": [0.02 * (-1) ** i, 0.01 * i, -0.1]}
            for i, box in enumerate(_five_boxes())]


def _five_boxes():
    """Each box 5 mm narrower on every side than the one below.

    With equal boxes the corners of one lie on the edges of the next, and rounding decides how
    many contact points there are.
    """
    half_height = 0.1
    return [_box(f"box{i + 1}", [0.1 - 0.005 * i, 0.1 - 0.005 * i, half_height],
                 [0.0, 0.0, (2 * i + 1) * half_height + (i + 1) * START_GAP]) for i in range(5)]


def _turning(body, linear, angular):
    return {**body, "linear_velocity": linear, "angular_velocity": angular}


def all_scenes():
    """name → scene."""
    scenes = [
        _scene("ball_drop", "A 1 kg sphere falls 1 m onto the ground.", LEVEL, [_ball(1.0)],
               0.5, 2.0,
               {"drake": {"stiffness": 1e5, "dissipation": 0.324, "relaxation_time": 0.002}}),
        _scene("ball_drop_elastic",
               "A 1 kg sphere falls 1 m onto a spring of 10 kN/m without damping.", LEVEL,
               [_ball(1.0)], 0.5, 2.0,
               {"mujoco": {"solref": [-1e4, 0.0]},
                "drake": {"stiffness": 1e4, "dissipation": 0.0, "relaxation_time": 0.0}},
               restitution=1.0),
        _scene("ball_rest", "A 1 kg sphere settles on the ground: one contact.", LEVEL,
               [_ball(START_GAP)], 0.5, 1.0,
               {"drake": {"stiffness": 1e5, "dissipation": 50.0, "relaxation_time": 0.005}}),
        _scene("ball_sunk", "A 1 kg sphere starts 1 cm deep in the ground.", LEVEL, [_ball(-0.01)],
               0.5, 0.4, {}),
        _scene("ball_deep", "A 1 kg sphere starts 6 cm deep in the ground.", LEVEL,
               [_ball(-0.06)], 0.5, 0.4, {}),
        _scene("ball_bounce", "A 1 kg sphere falls 0.2 m and rebounds with e = 0.5.", LEVEL,
               [_ball(0.2)], 0.5, 0.8, {}, restitution=0.5),
        _block_on_incline("block_stick", "A 1 kg block on a 20 degree incline; 0.5 > tan 20: "
                          "it must not move.", 0.5),
        _block_on_incline("block_slide", "A 1 kg block on a 20 degree incline; 0.3 < tan 20: "
                          "it slides with g (sin - 0.3 cos) = 0.58970 m/s2.", 0.3),
        _scene("block_oblique", "A 1 kg block slides on the level at 30 degrees to the x axis, "
               "0.5 m/s.", LEVEL, [_kicked(_box("block", [0.1, 0.1, 0.05],
                                                [0.0, 0.0, 0.05 + START_GAP]), 0.5)],
               0.1, 0.4, {}),
        _scene("ball_oblique", "A 1 kg sphere starts to slide on the level at 30 degrees to the x "
               "axis, 1 m/s.", LEVEL, [_kicked(_ball(START_GAP), 1.0)], 0.3, 0.4, {}),
        _scene("block_landing", "A 1 kg block, 0.1 mm deep, turns about all its axes as it lands: a "
               "corner is pressed and then lifted by the others.", LEVEL,
               [{**_box("block", [0.1, 0.1, 0.05], [0.0, 0.0, 0.0499]),
                 "linear_velocity": [-0.17, -0.28, 0.12],
                 "angular_velocity": [1.9, 2.8, 0.68]}], 0.5, 0.1, {}),
        _scene("five_box_stack", "Five 1 kg boxes, each a little narrower, stand on each other.", LEVEL,
               _five_boxes(), 0.5, 1.0,
               {"drake": {"stiffness": 1e5, "dissipation": 20.0, "relaxation_time": 0.005}}),
        _scene("box_tumble", "A 1 kg box of three different sides tumbles, falls and lands.", LEVEL,
               [_turning(_box("box", [0.1, 0.06, 0.03], [0.0, 0.0, 0.5]), [0.2, 0.1, 0.5],
                         [5.0, 8.0, 2.0])], 0.5, 1.0, {}),
        _scene("ball_spin", "A 1 kg sphere on the ground spins about the normal at 15 rad/s.", LEVEL,
               [_turning(_ball(START_GAP), [0.0] * 3, [0.0, 0.0, 15.0])], 0.5, 1.0, {}),
        _scene("ball_roll", "A 1 kg sphere rolls on the ground at 0.5 m/s.", LEVEL,
               [_turning(_ball(START_GAP), [0.5, 0.0, 0.0], [0.0, 5.0, 0.0])], 0.5, 1.0, {}),
        _scene("ball_impact", "A 1 kg sphere hits the ground obliquely and with spin.", LEVEL,
               [_moving(_ball(0.0), [0.0, 0.0, 0.101], [2.0, 0.5, -4.0], [0.0, -10.0, 5.0])],
               0.5, 0.04,
               {"drake": {"stiffness": 1e5, "dissipation": 0.324, "relaxation_time": 0.002}}),
        _scene("block_impact", "A 1 kg block hits the ground with a corner and lands on others.",
               LEVEL, [_moving(_box("block", [0.1, 0.1, 0.05], []), [0.0, 0.0, 0.116],
                               [1.0, 0.5, -2.0], [3.0, 5.0, -2.0], (0.96, 0.168, 0.224, 0.0))],
               0.5, 0.12,
               {"drake": {"stiffness": 2e4, "dissipation": 1.0, "relaxation_time": 0.005}}),
        _scene("stack_landing", "Five 1 kg boxes land on each other, each sliding over the next.",
               LEVEL, _landing_boxes(), 0.5, 0.06,
               {"drake": {"stiffness": 1e5, "dissipation": 20.0, "relaxation_time": 0.005}}),
    ]
    return {scene["name"]: scene for scene in scenes}
