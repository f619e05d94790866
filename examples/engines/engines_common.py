"""What the example engines share: vectors, rotations, bodies, settings and the talk with the gate. No contact physics.

    vectors are tuples (x, y, z),  quaternions (w, x, y, z) turn body to world,  angular velocities are in the world frame
    L = R J Rᵀ ω         a free body keeps its angular momentum L and turns with ω = R J⁻¹ Rᵀ L
"""
import math
import struct
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "scripts" / "engines"))
from _protocol import serve  # noqa: E402
from _scene import (GROUND, Recorder, initial_state, kind_of, pair_values, require_declared,  # noqa: E402
                    shape_of, solid_inertia, step_count)

AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def plus(a, s, b):
    """a + s b."""
    return (a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2])


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scaled(s, a):
    return (s * a[0], s * a[1], s * a[2])


def norm(a):
    return math.sqrt(dot(a, a))


def times(matrix, a):
    """Matrix (three rows) times vector."""
    return (dot(matrix[0], a), dot(matrix[1], a), dot(matrix[2], a))


def transposed(matrix):
    return tuple(zip(*matrix))


def tangents(n):
    """Two unit vectors that make a right-handed frame with the unit vector n; for n = z they are x and y."""
    start = AXES[0] if abs(n[0]) < 0.9 else AXES[1]
    first = plus(start, -dot(start, n), n)
    first = scaled(1.0 / norm(first), first)
    return first, cross(n, first)


def matrix_of(q):
    """The rotation matrix of a unit quaternion."""
    w, x, y, z = q
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))


def turned(q, rotation):
    """The quaternion q turned by a rotation vector [rad] of the world frame."""
    angle = norm(rotation)
    s = math.sin(0.5 * angle) / angle if angle > 1e-12 else 0.5
    w, (x, y, z) = math.cos(0.5 * angle), scaled(s, rotation)
    a, b, c, d = q
    product = (w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c,
               w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a)
    length = math.sqrt(sum(part * part for part in product))
    return tuple(part / length for part in product)


class Body:
    """A body with its state: place x, orientation q, velocity v, angular momentum L about the centre.

    A body that is not free, static or with a prescribed velocity, has 1/m = 0 and J⁻¹ = 0, and keeps v and ω.
    """

    def __init__(self, body):
        self.name, self.free = body["name"], kind_of(body) == "free"
        self.mass, self.moments = (body["mass"], solid_inertia(body)) if self.free else (math.inf, [math.inf] * 3)
        self.shape = shape_of(body)
        size = body[self.shape]
        self.radius, self.half_height = size.get("radius"), size.get("half_height")
        self.half = tuple(size["half_extents"]) if self.shape == "box" else None
        self.x, self.q, self.v, spin = (tuple(part) for part in initial_state(body))
        self.rotation = matrix_of(self.q)
        self.kept_spin = spin
        self.momentum = self.inertia_times(spin) if self.free else None

    def _turned_diagonal(self, diagonal, a):
        rows = self.rotation
        inner = times(transposed(rows), a)
        return times(rows, (diagonal[0] * inner[0], diagonal[1] * inner[1], diagonal[2] * inner[2]))

    def inertia_times(self, spin):
        """R J Rᵀ ω [kg m²/s]."""
        return self._turned_diagonal(self.moments, spin)

    def spin_of(self, momentum):
        """R J⁻¹ Rᵀ L [rad/s]."""
        return self._turned_diagonal([1.0 / moment for moment in self.moments], momentum)

    @property
    def spin(self):
        return self.spin_of(self.momentum) if self.free else self.kept_spin

    def place(self, x, q):
        self.x, self.q, self.rotation = x, q, matrix_of(q)

    def drift(self, h):
        """Move for h [s] without forces: x by h v, q with L kept, by the midpoint rule."""
        x, start = plus(self.x, h, self.v), self.q
        spin = self.spin
        if any(spin):
            for _ in range(3):  # ω at the half-turned orientation; each pass gains an order
                self.place(x, turned(start, scaled(0.5 * h, spin)))
                spin = self.spin
        self.place(x, turned(start, scaled(h, spin)) if any(spin) else start)

    def kick(self, impulse, lever):
        """An impulse [N s] at a lever [m] from the centre."""
        if not self.free:
            return
        self.v = plus(self.v, 1.0 / self.mass, impulse)
        self.momentum = plus(self.momentum, 1.0, cross(lever, impulse))

    def corners(self):
        """The eight corners of a box in the world."""
        a, b, c = self.half
        signs = [(i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
        return [plus(self.x, 1.0, times(self.rotation, (i * a, j * b, k * c))) for i, j, k in signs]

    def state(self):
        return self.x, self.q, self.v, self.spin

    def rounded(self):
        """Keep no more of the state than single precision holds."""
        if not self.free:
            self.place(single(self.x), single(self.q))
            return
        spin = single(self.spin)
        self.v = single(self.v)
        self.place(single(self.x), single(self.q))
        self.momentum = self.inertia_times(spin)


def single(numbers):
    """Every number rounded to 24 bits."""
    return struct.unpack(f"{len(numbers)}f", struct.pack(f"{len(numbers)}f", *numbers))


class World:
    """The bodies of a scene and the values of its pairs; an engine adds `step(h)`, which calls `touch` for what acted."""

    # A planted mistake sets this; the protocol wants the sum of all steps between two samples.
    reports_last_step_only = False

    def __init__(self, scene, settings):
        self.settings, self.gravity = settings, tuple(scene["gravity"])
        self.bodies = [Body(body) for body in scene["bodies"]]
        self.ground = scene.get("ground")
        self.friction, self.restitution = pair_values(scene, "friction"), pair_values(scene, "restitution")
        self.touched = []

    def value(self, table, a, b):
        """The value of a pair of names in `friction` or `restitution`."""
        return table[(a, b)] if (a, b) in table else table[(b, a)]

    def touch(self, a, b, normal, impulse):
        """Report: `normal` from b to a, `impulse` [N s] on a; the names of two bodies, or of one and `GROUND`."""
        self.touched.append((a, b, normal, impulse))


def settings_of(arguments, defaults):
    """Defaults, overridden by `--name value` on the command line; a text for a text, a number for a number."""
    settings = dict(defaults)
    words = iter(arguments)
    for word in words:
        name = word.removeprefix("--").replace("-", "_")
        if name not in settings:
            sys.exit(f"{word} is not a setting of this engine; it has {', '.join('--' + name for name in settings)}")
        settings[name] = type(defaults[name])(next(words, None))
    return settings


def overridden(settings, request):
    """The settings of one request; a name that is not one of them is an error."""
    options = request.get("options") or {}
    for name in options:
        if name not in settings:
            raise ValueError(f"this engine has no option {name!r}; it has {sorted(settings)}")
    return {**settings, **options}


def run(describe, world, settings):
    """Answer the gate: `describe(settings)` gives the description, `world(scene, settings)` the bodies in motion."""

    def described(request):
        return describe(overridden(settings, request))

    def simulate(request):
        chosen = overridden(settings, request)
        description, scene, h = describe(chosen), request["scene"], request["time_step"]
        require_declared(description, scene)
        name = {"name": description["name"], "version": description["version"], "options": description["options"]}
        record = Recorder(scene, name, h, request["sample_every"])
        moving = world(scene, chosen)
        record.sample(0, [body.state() for body in moving.bodies])
        for step in range(1, step_count(scene, h) + 1):
            moving.touched = []
            moving.step(h)
            if record.due(step) or not moving.reports_last_step_only:
                for contact in moving.touched:
                    record.contact(*contact)
            if record.due(step):
                record.sample(step, [body.state() for body in moving.bodies])
        return record.trajectory

    serve({"describe": described, "simulate": simulate})
