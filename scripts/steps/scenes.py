"""Scenes scene/1 of the measurement of steps: tumbling boxes, thrown piles, and a heavy box on a light one."""

import json
import math
import random

HALF = 0.1  # half extents of both boxes of heavy on light [m]


def scene(name, bodies, duration, friction, restitution):
    """A scene/1 over the floor z = 0, so that energies are measured from the floor."""
    return {"schema": "scene/1", "name": name, "gravity": [0, 0, -9.81], "bodies": bodies,
            "ground": {"normal": [0, 0, 1], "offset": 0}, "duration": duration,
            "material": {"friction": friction, "restitution": restitution}}


def direction(dice, dimension):
    """A uniform unit vector."""
    vector = [dice.gauss(0, 1) for _ in range(dimension)]
    length = math.sqrt(sum(x * x for x in vector))
    return [x / length for x in vector]


def tumbling_box(seed):
    """One thrown box of 1 kg; the seed alone decides everything."""
    dice = random.Random(f"tumbling box {seed}")
    extents = [dice.uniform(0.05, 0.2) for _ in range(3)]
    spin, speed = dice.uniform(0, 10), dice.uniform(0, 2)
    body = {"name": "box", "mass": 1.0, "box": {"half_extents": extents},
            "position": [0, 0, math.hypot(*extents) + dice.uniform(0, 0.5)],
            "orientation": direction(dice, 4),
            "linear_velocity": [speed * x for x in direction(dice, 3)],
            "angular_velocity": [spin * x for x in direction(dice, 3)]}
    return scene(f"box-{seed}", [body], 1.5, dice.uniform(0, 1), dice.choice((0.2, 0.4, 0.6, 0.8)))


def thrown_pile(seed):
    """Five or eight turning boxes or plates that fall on each other; the seed alone decides everything."""
    dice = random.Random(f"thrown pile {seed}")
    plates, bodies = dice.random() < 0.5, []
    for k in range(dice.choice((5, 8))):
        extents = [0.2, 0.2, 0.03] if plates else [dice.uniform(0.05, 0.2) for _ in range(3)]
        bodies.append({"name": f"body {k}", "mass": dice.choice((1.0, dice.uniform(0.2, 5))), "box": {"half_extents": extents},
                       "position": [dice.uniform(-0.05, 0.05), dice.uniform(-0.05, 0.05), 0.3 + 0.3 * k],
                       "angular_velocity": [dice.uniform(-3, 3) for _ in range(3)]})
    return scene(f"pile-{seed}", bodies, 1.5, dice.choice((0.2, 0.5, 0.8, 1.2)), dice.choice((0.0, 0.2, 0.5)))


def heavy_on_light(ratio, lands):
    """A box of `ratio` kg on one of 1 kg; landing, it falls 20 mm, turned and beside the centre."""
    aside, gap, angle = (0.02, 0.02, 0.3) if lands else (0.0, 0.0, 0.0)
    box = {"half_extents": [HALF] * 3}
    light = {"name": "light", "mass": 1.0, "box": box, "position": [0, 0, HALF]}
    heavy = {"name": "heavy", "mass": ratio, "box": box, "position": [aside, 0, 3 * HALF + gap],
             "orientation": [math.cos(angle / 2), 0, 0, math.sin(angle / 2)]}
    return scene(f"heavy-{'lands' if lands else 'rests'}-{ratio:.0e}", [light, heavy], 0.5, 0.5, 0.0)


def write_scenes(folder, scenes):
    files = {key: folder / f"{one['name']}.json" for key, one in scenes.items()}
    for key, file in files.items():
        file.write_text(json.dumps(scenes[key]))
    return files
