"""Steps of engines as contact problems: what MuJoCo and Drake dumped, and steps of Siconos and Bullet posed again from stored states."""

from pathlib import Path

from problems.mechanism import Points, Space, dot
from problems.posed import Posed
from reference import documents

REFERENCES = Path(__file__).resolve().parents[2] / "references"
MUJOCO = [
    ("ball_rest__newton-elliptic-converged__h0.001__step900", "ball at rest, round cone"),
    ("ball_rest__newton-pyramidal-converged__h0.001__step900", "ball at rest, pyramid"),
    ("block_slide__newton-elliptic-converged__h0.002__step100", "sliding block, round cone"),
    ("block_slide__newton-pyramidal-converged__h0.002__step100", "sliding block, pyramid"),
    ("block_stick__newton-elliptic-converged__h0.002__step20", "block that comes to rest, round cone"),
    ("block_stick__newton-pyramidal-converged__h0.002__step20", "block that comes to rest, pyramid"),
    ("block_stick__newton-elliptic-converged__h0.002__step400", "block at rest on a slope, round cone"),
    ("block_stick__newton-pyramidal-converged__h0.002__step400", "block at rest on a slope, pyramid"),
    ("five_box_stack__newton-elliptic-converged__h0.002__step8", "stack of five boxes, round cone"),
    ("five_box_stack__newton-pyramidal-converged__h0.002__step8", "stack of five boxes, pyramid"),
]
DRAKE = [
    ("ball_rest__sap__h0.001__step20", "ball that settles"),
    ("ball_rest__sap__h0.001__step900", "ball at rest"),
    ("block_slide__sap__h0.001__step300", "sliding block"),
    ("block_slide__sap__h0.002__step150", "sliding block, longer step"),
    ("block_stick__sap__h0.001__step20", "block that comes to rest"),
    ("block_stick__sap__h0.001__step900", "block at rest on a slope"),
    ("block_stick__sap__h0.01__step90", "block at rest on a slope, ten times the step"),
]
SICONOS = [("ball__moreau-jean__h0.01", "bouncing ball"), ("cradle__moreau-jean__h0.01", "Newton's cradle"),
           ("chain__moreau-jean__h0.01", "three balls in a row"), ("block_slide__moreau-jean__h0.01", "planar block that slides"),
           ("block_stick__moreau-jean__h0.01", "planar block that sticks"), ("puck_slide__moreau-jean__h0.01", "puck that slides"),
           ("puck_stick__moreau-jean__h0.01", "puck that sticks")]
BULLET = [("block_oblique__pyramid__h0.005", 20, "block that slides obliquely"), ("block_landing__box__h0.01", None, "block that lands turning"),
          ("ball_oblique__pyramid__h0.01", 3, "ball that slides"), ("block_slide__box-default__h0.01", 30, "block that slides down a slope"),
          ("block_stick__rigid-warm__h0.01", 10, "block that sticks on a slope")]


def _dump(engine, stem, about):
    path = f"{engine}/{stem}.dump.json"
    dump = documents.read(REFERENCES / path)
    version = dump["provenance"]["version"]
    words = stem.split("__")
    kind = "-pyramid" if "pyramidal" in stem else ""
    step = words[2] if engine == "drake" else ""
    document = dict(dump["problem"])
    document["name"] = "-".join(filter(None, [engine, words[0].replace("_", "-"), step, words[-1] + kind]))
    document["provenance"] = {"dump": f"references/{path}"}
    names = {"mujoco": "MuJoCo", "drake": "Drake"}
    return Posed("steps", f"a step of {names[engine]}: {about}", document, closed=dump["answer"]["impulse"],
                 closed_by=f"{names[engine]} {version}", engine=True, solution=dump["answer"])


def _siconos(stem, about):
    """The first step with an impulse: M v⁺ = M v + h F + Hᵀ r, and Newton's restitution on the normal."""
    path = f"siconos/{stem}.json"
    run = documents.read(REFERENCES / path)
    system, h = run["system"], run["time_step"]
    number = next(k for k, impulse in enumerate(run["impulses"]) if any(impulse))
    before, impulse = run["velocities"][number], run["impulses"][number]
    masses = system.get("masses") or [system["mass"]]
    if system["kind"] == "chain":
        world = Points(1)
        bodies = [world.body([m], [v]) for m, v in zip(masses, before)]
        pushed = [k for k, r in enumerate(impulse) if r]
        for k in pushed:
            world.touch(bodies[k + 1], [1.0], 0, system["restitution"] * (before[k + 1] - before[k]), other=bodies[k])
        impulse = [impulse[k] for k in pushed]
    else:
        # the last coordinate is normal to the ground, and gravity along it pulls down
        rows = len(before)
        gravity = system["gravity"] if isinstance(system["gravity"], list) else [system["gravity"]]
        gravity = gravity[:-1] + [-gravity[-1]]
        world, normal = Points(rows), rows - 1
        body = world.body(masses * rows, [v + h * g for v, g in zip(before, gravity)])
        order = [normal, *range(normal)]
        axes = [([float(k == axis) for k in range(rows)], None) for axis in order]
        world.contact(body, None, axes, system.get("friction", 0), [system["restitution"] * before[normal]] + [0.0] * (rows - 1))
    document = world.problem(f"siconos-{stem.split('__')[0].replace('_', '-')}", "coulomb" if world.dimension > 1 else "frictionless")
    document["provenance"] = {"run": f"references/{path}", "step": number}
    return Posed("steps", f"a step of Siconos: {about}", document, closed=impulse,
                 closed_by=f"Siconos {run['provenance']['version']}", engine=True)


def _turned(orientation, vector):
    """A world vector in the axes of a body of this orientation (w, x, y, z)."""
    w, x, y, z = orientation
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
            [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
            [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]]
    return [dot(row, vector) for row in rows]


class _Bullet(Space):
    """Bodies whose angular velocity is taken in their own axes, in which their inertia is diagonal."""

    def __init__(self, orientation):
        super().__init__()
        self.orientation = orientation

    def contact(self, body, other, rows, friction, shift=None):
        """The same contact with its arms in the axes of the body."""
        turned = [([*own[:3], *(round(x, 12) for x in _turned(self.orientation, own[3:]))], None) for own, _ in rows]
        super().contact(body, other, turned, friction, shift)


def _bullet(stem, step, about):
    path = f"bullet/{stem}.steps.json"
    run = documents.read(REFERENCES / path)
    scene, points, h = run["scene"], run["native"]["points"], run["time_step"]
    number = step if step is not None else next(k for k, p in enumerate(points) if len(p["position"]) > 1)
    states, shape = run["bodies"], scene["bodies"][0]
    orientation = states["orientation"][number]
    speed = [v + h * g for v, g in zip(states["linear_velocity"][number], scene["gravity"])]
    speed += _turned(orientation, states["angular_velocity"][number])
    world = _Bullet(orientation)
    if "sphere" in shape:
        body = world.ball(shape["sphere"]["radius"], shape["mass"], speed)
    else:
        body = world.box(shape["box"]["half_extents"], shape["mass"], speed)
    for place, normal in zip(points[number]["position"], points[number]["normal"]):
        arm = [p - c for p, c in zip(place, states["position"][number])]
        world.touch(body, None, arm, None, normal, scene["material"]["friction"])
    name, shape_of_run = stem.split("__")[:2]
    document = world.problem(f"bullet-{name.replace('_', '-')}")
    document["provenance"] = {"run": f"references/{path}", "step": number}
    return Posed("steps", f"a step of Bullet, its contact points under Coulomb's law: {about}", document)


def all_problems():
    """The problems, in order."""
    for stem, about in MUJOCO:
        yield _dump("mujoco", stem, about)
    for stem, about in DRAKE:
        yield _dump("drake", stem, about)
    for stem, about in SICONOS:
        yield _siconos(stem, about)
    for stem, step, about in BULLET:
        yield _bullet(stem, step, about)
