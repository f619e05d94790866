"""Reading `scene/1` and writing `trajectory/1`; shared by the adapters, standard library only."""

import math

from _protocol import Unsupported

GROUND = "ground"
# What an engine declares if its description does not say: see `shapes` and `bodies` there.
BASIC_SHAPES = ["sphere", "box"]
FREE_BODIES = ["free"]
FIELDS = {"name", "mass", "inertia", "position", "orientation", "linear_velocity",
          "angular_velocity", "static", "prescribed"}


def shape_of(body):
    """The name of a body's shape, which is the field that is none of the others."""
    shapes = sorted(set(body) - FIELDS)
    return shapes[0] if len(shapes) == 1 else f"none or several: {shapes}"


def kind_of(body):
    """Whether a body is `free`, `static`, or has a `prescribed` velocity."""
    if body.get("static"):
        return "static"
    return "prescribed" if body.get("prescribed") is not None else "free"


def require_declared(description, scene):
    """Refuse a scene with a shape or a kind of body that the description does not declare."""
    shapes = description.get("shapes", BASIC_SHAPES)
    kinds = description.get("bodies", FREE_BODIES)
    for body in scene["bodies"]:
        for what, found, known in (("a shape", shape_of(body), shapes),
                                   ("a body that is", kind_of(body), kinds)):
            if found not in known:
                raise Unsupported(f"{description['name']} has no such thing as {what} {found!r} "
                                  f"(body {body['name']!r}); it has {', '.join(known)}")


def solid_inertia(body):
    """Principal moments [kg m²] about the centre of mass: as given, else those of the solid.

    Sphere: 2/5 m r² (1, 1, 1).  Box with half extents a, b, c: m/3 (b²+c², a²+c², a²+b²).
    Cylinder of the height 2l: m (r²/4 + l²/3, the same, r²/2).  Capsule: a cylinder and two half
    balls of the same density, each with its centre of mass 3r/8 beyond its end of the cylinder.
    """
    if "inertia" in body:
        return list(body["inertia"])
    mass = body["mass"]
    if "sphere" in body:
        return [0.4 * mass * body["sphere"]["radius"] ** 2] * 3
    if "cylinder" in body or "capsule" in body:
        size = body.get("cylinder") or body["capsule"]
        r, l = size["radius"], size["half_height"]
        balls = 0.0 if "cylinder" in body else mass * 2 * r / (3 * l + 2 * r)
        middle = mass - balls
        across = (middle * (r * r / 4 + l * l / 3)
                  + balls * (0.4 * r * r + l * l + 0.75 * l * r))
        return [across, across, 0.5 * middle * r * r + 0.4 * balls * r * r]
    a, b, c = body["box"]["half_extents"]
    return [mass / 3 * (b * b + c * c), mass / 3 * (a * a + c * c), mass / 3 * (a * a + b * b)]


def initial_state(body):
    """(position, orientation [w,x,y,z], linear velocity, angular velocity), defaults filled in."""
    prescribed = body.get("prescribed") or {}
    return (body["position"], body.get("orientation", [1.0, 0.0, 0.0, 0.0]),
            prescribed.get("velocity", body.get("linear_velocity", [0.0] * 3)),
            prescribed.get("angular_velocity", body.get("angular_velocity", [0.0] * 3)))


def prescribed_state(body, time):
    """The state at `time` of a body that is static or has prescribed velocities V and ω.

    x(t) = x₀ + V t,   q(t) = (cos ½‖ω‖t, sin ½‖ω‖t ω/‖ω‖) ∘ q₀.
    """
    position, orientation, linear, angular = initial_state(body)
    moved = [x + v * time for x, v in zip(position, linear)]
    rate = math.hypot(*angular)
    if rate == 0:
        return moved, list(orientation), list(linear), list(angular)
    half = 0.5 * rate * time
    turn = [math.cos(half), *(math.sin(half) / rate * x for x in angular)]
    return moved, quaternion_product(turn, orientation), list(linear), list(angular)


def quaternion_product(a, b):
    """a ∘ b of quaternions [w, x, y, z]: first b turns, then a."""
    (w, x, y, z), (s, i, j, k) = a, b
    return [w * s - x * i - y * j - z * k, w * i + x * s + y * k - z * j,
            w * j - x * k + y * s + z * i, w * k + x * j - y * i + z * s]


def rotation_to_normal(normal):
    """Quaternion [w, x, y, z] of the shortest rotation that takes (0, 0, 1) to the unit normal."""
    x, y, z = normal
    q = [1.0 + z, -y, x, 0.0]
    length = math.sqrt(sum(component * component for component in q))
    return [component / length for component in q] if length > 1e-12 else [0.0, 1.0, 0.0, 0.0]


def pair_friction(scene, a, b):
    """Coulomb's coefficient of the pair, an override in `material.pairs` first."""
    for pair in scene["material"].get("pairs", []):
        if sorted(pair["bodies"]) == sorted([a, b]) and "friction" in pair:
            return pair["friction"]
    return scene["material"]["friction"]


def pair_values(scene, key):
    """{(a, b): value} of `friction` or `restitution` for every pair that can touch, a before b."""
    names = [GROUND] if scene.get("ground") is not None else []
    names += [body["name"] for body in scene["bodies"]]
    material = scene["material"]
    values = {(a, b): material.get(key, 0.0) for i, a in enumerate(names) for b in names[i + 1:]}
    for pair in material.get("pairs", []):
        if pair.get(key) is not None:
            a, b = sorted(pair["bodies"], key=names.index)
            values[a, b] = pair[key]
    return values


def multiplied_values(scene, key):
    """One value per body for an engine that multiplies them: f_a f_b = c for every pair (a, b).

    A single pair has the factors (1, c).  Pairs with the same c have f = √c, to one rounding.
    Other scenes are refused.
    """
    pairs = pair_values(scene, key)
    different = sorted(set(pairs.values()))
    if len(different) > 1:
        raise Unsupported(f"the engine multiplies the {key} of two bodies, and the scene's pairs "
                          f"have different values: {different}")
    factors = {name: math.sqrt(different[0]) for pair in pairs for name in pair}
    if len(pairs) == 1:
        (first, second), = pairs
        factors = {first: 1.0, second: different[0]}
    return factors or {body["name"]: 0.0 for body in scene["bodies"]}


def smallest_values(scene, key):
    """One value per body for an engine that takes the smaller: min(f_a, f_b) = c of every pair.

    f_a = max c over the pairs of a: every solution is at least as large, so if this one is not
    a solution there is none.
    """
    pairs = pair_values(scene, key)
    values = {name: max(c for pair, c in pairs.items() if name in pair)
              for pair in pairs for name in pair}
    for (a, b), c in pairs.items():
        if min(values[a], values[b]) != c:
            raise Unsupported(f"the engine takes the smaller {key} of two bodies, and no values "
                              f"of {a} and {b} give {c}")
    return values or {body["name"]: 0.0 for body in scene["bodies"]}


def common_value(scene, key):
    """The one value of all pairs, for an engine whose mixing rule keeps equal values as they are."""
    different = sorted(set(pair_values(scene, key).values()))
    if len(different) > 1:
        raise Unsupported(f"the engine mixes the {key} of two bodies, and the scene's pairs have "
                          f"different values: {different}")
    return different[0] if different else 0.0


def step_count(scene, time_step):
    """Number of steps n with n h = duration; an error when h does not divide the duration."""
    if not time_step > 0:
        raise ValueError(f"time_step must be positive, not {time_step}")
    steps = round(scene["duration"] / time_step)
    if not math.isclose(steps * time_step, scene["duration"], rel_tol=1e-9):
        raise ValueError(f"time_step {time_step} does not divide the duration {scene['duration']}")
    return steps


class Recorder:
    """Collects a `trajectory/1`: states at every `sample_every`-th step, and between two samples
    the contact impulses of each pair of bodies, summed over (t_{k-1}, t_k].

    The points of a pair are added up; the normal of the pair is the mean of the points' normals
    weighted by their normal impulses, or the plain mean where these are zero (a lagged law has
    friction in the step after the last normal impulse).  Pairs without impulse are left out.
    """

    def __init__(self, scene, engine, time_step, sample_every):
        if not isinstance(sample_every, int) or sample_every < 1:
            raise ValueError(f"sample_every must be a whole number from 1, not {sample_every!r}")
        self.time_step, self.sample_every = time_step, sample_every
        self.pending = {}
        self.trajectory = {
            "schema": "trajectory/1", "scene": scene, "engine": engine, "time_step": time_step,
            "times": [],
            "bodies": [{"name": body["name"], "position": [], "orientation": [],
                        "linear_velocity": [], "angular_velocity": []} for body in scene["bodies"]],
            "contacts": [],
        }

    def contact(self, a, b, normal, impulse):
        """Add one point: `normal` from b to a, `impulse` [N s] on a; the ground becomes b."""
        if a == GROUND or (b != GROUND and a > b):
            a, b, normal, impulse = b, a, [-x for x in normal], [-x for x in impulse]
        weight = sum(n * p for n, p in zip(normal, impulse))
        if any(impulse):
            zeros = [0.0] * 3
            total, direction, plain = self.pending.setdefault((a, b), (zeros[:], zeros[:], zeros[:]))
            for i in range(3):
                total[i] += impulse[i]
                direction[i] += weight * normal[i]
                plain[i] += normal[i]

    def due(self, step):
        """Whether the state after `step` steps is a sample."""
        return step % self.sample_every == 0

    def sample(self, step, states):
        """Store the state after `step` steps: one (x, q, v, w) per body, in scene order."""
        index = len(self.trajectory["times"])
        self.trajectory["times"].append(step * self.time_step)
        for record, state in zip(self.trajectory["bodies"], states):
            for key, value in zip(("position", "orientation", "linear_velocity",
                                   "angular_velocity"), state):
                record[key].append([float(x) for x in value])
        for (a, b), (total, direction, plain) in sorted(self.pending.items()):
            direction = direction if any(direction) else plain
            length = math.hypot(*direction)
            if length > 0:
                self.trajectory["contacts"].append(
                    {"sample": index, "bodies": [a, b],
                     "normal": [float(x / length) for x in direction],
                     "impulse": [float(x) for x in total]})
        self.pending = {}


def record(request, engine, world):
    """The trajectory/1 of a `simulate` request, made by `world`.

    `world.states()` gives (x, q, v, w) of every body in scene order; `world.step()` makes one
    step and returns its contact points as (a, b, normal, impulse), see `Recorder.contact`.
    """
    scene, time_step = request["scene"], request["time_step"]
    recorder = Recorder(scene, engine, time_step, request["sample_every"])
    recorder.sample(0, world.states())
    for step in range(1, step_count(scene, time_step) + 1):
        for point in world.step():
            recorder.contact(*point)
        if recorder.due(step):
            recorder.sample(step, world.states())
    return recorder.trajectory
