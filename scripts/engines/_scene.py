"""Reading `scene/1` and writing `trajectory/1`; shared by the adapters, standard library only."""

import math

from _protocol import Unsupported

GROUND = "ground"


def solid_inertia(body):
    """Principal moments [kg m²] about the centre of mass: as given, else those of the solid.

    Sphere: 2/5 m r² (1, 1, 1).  Box with half extents a, b, c: m/3 (b²+c², a²+c², a²+b²).
    """
    if "inertia" in body:
        return list(body["inertia"])
    mass = body["mass"]
    if "sphere" in body:
        return [0.4 * mass * body["sphere"]["radius"] ** 2] * 3
    a, b, c = body["box"]["half_extents"]
    return [mass / 3 * (b * b + c * c), mass / 3 * (a * a + c * c), mass / 3 * (a * a + b * b)]


def initial_state(body):
    """(position, orientation [w,x,y,z], linear velocity, angular velocity), defaults filled in."""
    return (body["position"], body.get("orientation", [1.0, 0.0, 0.0, 0.0]),
            body.get("linear_velocity", [0.0] * 3), body.get("angular_velocity", [0.0] * 3))


def pair_friction(scene, a, b):
    """Coulomb's coefficient of the pair, an override in `material.pairs` first."""
    for pair in scene["material"].get("pairs", []):
        if sorted(pair["bodies"]) == sorted([a, b]) and "friction" in pair:
            return pair["friction"]
    return scene["material"]["friction"]


def engine_options(engine, defaults, scene, request):
    """Effective options: defaults, then the scene's `engines.<engine>`, then the request's."""
    declared = scene.get("engines", {}).get(engine, {})
    restitutions = [scene["material"].get("restitution", 0)]
    restitutions += [p.get("restitution", 0) for p in scene["material"].get("pairs", [])]
    if any(restitutions) and not declared:
        raise Unsupported(f"{engine} has no coefficient of restitution; declare the contact "
                          f"parameters to use instead in the scene's engines.{engine}")
    options = dict(defaults)
    for source in (declared, request.get("options", {})):
        unknown = sorted(set(source) - set(defaults))
        if unknown:
            raise ValueError(f"unknown {engine} option {unknown[0]!r}; known: {sorted(defaults)}")
        options.update(source)
    return options


def step_count(scene, time_step):
    """Number of steps n with n h = duration; an error when h does not divide the duration."""
    steps = round(scene["duration"] / time_step)
    if not math.isclose(steps * time_step, scene["duration"], rel_tol=1e-9):
        raise ValueError(f"time_step {time_step} does not divide the duration {scene['duration']}")
    return steps


class Recorder:
    """Collects a `trajectory/1`: states at every `sample_every`-th step, and between two samples
    the contact impulses of each pair of bodies, summed over (t_{k-1}, t_k].

    The points of a pair are added up; the normal of the pair is the mean of the points' normals
    weighted by their normal impulses.  Pairs without impulse are left out.
    """

    def __init__(self, scene, engine, time_step, sample_every):
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
            total, direction = self.pending.setdefault((a, b), ([0.0] * 3, [0.0] * 3))
            for i in range(3):
                total[i] += impulse[i]
                direction[i] += weight * normal[i]

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
        for (a, b), (total, direction) in sorted(self.pending.items()):
            length = math.hypot(*direction)
            if length > 0:
                self.trajectory["contacts"].append(
                    {"sample": index, "bodies": [a, b],
                     "normal": [float(x / length) for x in direction],
                     "impulse": [float(x) for x in total]})
        self.pending = {}
