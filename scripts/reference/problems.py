"""The contact problems that a solver's stored answers belong to, as `contact-problem/1` objects.

    u = W r + u_free,   W = H M⁻¹ Hᵀ,   y = u + R r,   (r, y) in the law, contact by contact (n, t₁, t₂)

Every problem is a step of h = 1/128 s, given by mass and Jacobian.  Numbers are short binary
fractions wherever nothing else is said, so that every reader forms the same problem.
"""

import copy

STEP = 1 / 128
GRAVITY = 9.8125
BOX = (0.125, 0.125, 0.0625)  # half extents, m


def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _rows(arm, normal=(0, 0, 1), tangents=((1, 0, 0), (0, 1, 0))):
    """H of one contact at `arm` from the centre of mass of one body: rows n, t₁, t₂."""
    return [[*map(float, axis), *_cross(arm, axis)] for axis in (normal, *tangents)]


def _diagonal(entries):
    return [[float(entry) if i == j else 0.0 for j in range(len(entries))]
            for i, entry in enumerate(entries)]


def _problem(name, law, friction, mass, jacobian, velocity, compliance=None):
    """The problem of bodies that would move on with `velocity`."""
    free = [sum(h * v for h, v in zip(row, velocity)) for row in jacobian]
    document = {"schema": "contact-problem/1", "name": name, "dimension": 3, "law": law,
                "friction": friction, "free_velocity": free,
                "mass": {"shape": [len(mass)] * 2, "rows": mass},
                "jacobian": {"shape": [len(jacobian), len(mass)], "rows": jacobian}}
    if compliance is not None:
        document["compliance"] = {"coordinates": "contact", "diagonal": [compliance] * len(free)}
    return document


def _box(name, friction, compliance=None, spin=0.0):
    """A box of 1 kg on its four corners on a 3-4-5 slope, after h of gravity: it turns with `spin`."""
    a, b, c = BOX
    inertia = [(b * b + c * c) / 3, (a * a + c * c) / 3, (a * a + b * b) / 3]
    corners = [[sx * a, sy * b, -c] for sx, sy in ((1, 1), (1, -1), (-1, 1), (-1, -1))]
    jacobian = [row for corner in corners for row in _rows(corner)]
    pull = STEP * GRAVITY
    velocity = [0.6 * pull + (0.25 if friction < 0.75 else 0.0), 0.0, -0.8 * pull, 0.0, 0.0, spin]
    return _problem(name, "coulomb", [friction] * 4, _diagonal([1.0] * 3 + inertia), jacobian, velocity, compliance)


def _ball(name, friction):
    """A solid ball of 1 kg and 1/8 m that lands while it spins backwards: one contact."""
    inertia = 0.4 / 64
    velocity = [1.0, 0.0, -0.5, 0.0, -16.0, 4.0]
    return _problem(name, "coulomb", [friction], _diagonal([1.0] * 3 + [inertia] * 3),
                    _rows([0.0, 0.0, -0.125]), velocity)


def _tower(name, upper):
    """A ball of 1 kg below one of `upper` kg: floor contact, contact between them, both slide."""
    inertia, radius = 0.4 / 64, 0.125
    lower = _rows([0.0, 0.0, -radius])
    below, above = _rows([0.0, 0.0, radius]), _rows([0.0, 0.0, -radius])
    jacobian = [row + [0.0] * 6 for row in lower]
    jacobian += [[-x for x in one] + other for one, other in zip(below, above)]
    velocity = [0.5, 0.0, -0.25, 0.0, 0.0, 0.0, -0.25, 0.125, -0.5, 0.0, 2.0, 0.0]
    masses = [1.0] * 3 + [inertia] * 3 + [upper] * 3 + [upper * inertia] * 3
    return _problem(name, "coulomb", [0.25, 0.5], _diagonal(masses), jacobian, velocity)


def _scattered(name, seed, friction, compliance=None):
    """Three contacts with directions and arms in sixteenths, out of a linear congruence, on two bodies."""
    state = seed

    def draw():
        nonlocal state
        state = (1103515245 * state + 12345) % 2 ** 31
        return (state >> 16) % 33 / 16 - 1

    jacobian = [[draw() for _ in range(12)] for _ in range(9)]
    for k in range(3):  # one velocity that opens every contact: the problem has a solution
        for j in range(3):
            jacobian[3 * k + j][0] = 1.0 if j == 0 else 0.0
    velocity = [-1.0] + [draw() for _ in range(11)]
    masses = [1.0 + (k % 4) for k in range(12)]
    return _problem(name, "coulomb", [friction] * 3, _diagonal(masses), jacobian, velocity, compliance)


def all_problems():
    """name → problem: every scene under Coulomb's law, most of them also under the associated law."""
    coulomb = [_box("box-stick", 1.0), _box("box-slide", 0.5),
               _box("box-soft", 0.5, compliance=0.0625), _ball("ball-roll", 1.0),
               _ball("ball-slide", 0.125), _tower("tower", 1.0), _tower("tower-heavy", 64.0),
               _scattered("scattered", 1, 0.5), _scattered("scattered-soft", 2, 1.0, 0.125)]
    problems = {problem["name"]: problem for problem in coulomb}
    # under Coulomb's law the box that turns has several answers with different velocities
    spinning = _box("box-spin", 0.25, spin=2.0)
    for problem in (*coulomb[:3], coulomb[4], coulomb[5], coulomb[7], spinning):
        relaxed = copy.deepcopy(problem)
        relaxed["name"], relaxed["law"] = f"{problem['name']}-associated", "associated"
        problems[relaxed["name"]] = relaxed
    return problems
