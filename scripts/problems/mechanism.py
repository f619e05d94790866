"""One step's contact problem of rigid bodies, as a `contact-problem/1` object.

    u = W r + u_free ,   W = H M⁻¹ Hᵀ ,   u_free = H v_free          rows (n), (n, t) or (n, t₁, t₂) per contact

A body in space moves with (v_x, v_y, v_z, ω_x, ω_y, ω_z), in the plane with (v_x, v_y, ω), a point with (v_x, v_y). The normal of a
contact points from `other` to `body`; without `other` the contact is with the ground.  Numbers are short binary fractions or decimals
of a few places, so that every reader forms the same problem.
"""

from math import sqrt

STEP = 1 / 128  # s
GRAVITY = 9.8125  # m/s²
PLACES = 6  # decimals of directions and arms that are no short fractions


def cross(a, b):
    """a × b."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    """a · b."""
    return sum(x * y for x, y in zip(a, b))


def rounded(vector):
    """The vector with a few decimals."""
    return [round(x, PLACES) + 0.0 for x in vector]


def unit(vector):
    """The vector over its length."""
    length = sqrt(dot(vector, vector))
    return [x / length for x in vector]


def tangents(normal):
    """Two directions that complete a normal, away from the axis it is nearest to."""
    axis = [0.0, 0.0, 0.0]
    axis[min(range(3), key=lambda k: abs(normal[k]))] = 1.0
    first = unit(cross(axis, normal))
    return first, cross(normal, first)


class Draw:
    """Numbers out of a linear congruence: the same on every machine."""

    def __init__(self, seed):
        self.state = seed

    def whole(self, most):
        """A number of 0 … most."""
        self.state = (1103515245 * self.state + 12345) % 2 ** 31
        return (self.state >> 12) % (most + 1)

    def fraction(self):
        """A number of 1024ths from −1 to 1."""
        return self.whole(2048) / 1024 - 1


class Mechanism:
    """Bodies and their contacts."""

    def __init__(self, dimension):
        self.dimension = dimension
        self.masses, self.velocity, self.sizes = [], [], []
        self.contacts = []

    def body(self, masses, velocity):
        """A body of these diagonal masses that would move on with this velocity without contact; its number."""
        self.masses.append([float(m) for m in masses])
        self.velocity.append([float(v) for v in velocity])
        return len(self.masses) - 1

    def contact(self, body, other, rows, friction, shift=None):
        """A contact by its rows (`rows[i]` is a pair: of the body, of the other one or None)."""
        self.contacts.append((body, other, rows, friction, shift or [0.0] * self.dimension))

    def problem(self, name, law="coulomb", directions=None):
        """The document of the problem."""
        starts = [0]
        for masses in self.masses:
            starts.append(starts[-1] + len(masses))
        row, column, value, free, shift = [], [], [], [], []
        for body, other, rows, _, added in self.contacts:
            for own, others in rows:
                sides = sorted([(body, own)] + ([] if other is None else [(other, others)]))
                speed = 0.0
                for number, entries in sides:
                    for k, entry in enumerate(entries):
                        if entry:
                            row.append(len(free))
                            column.append(starts[number] + k)
                            value.append(entry)
                            speed += entry * self.velocity[number][k]
                free.append(speed)
            shift += added
        size = starts[-1]
        masses = [mass for body in self.masses for mass in body]
        document = {"schema": "contact-problem/1", "name": name, "dimension": self.dimension, "law": law}
        if directions is not None:
            document["directions"] = directions
        document["friction"] = [contact[3] for contact in self.contacts]
        document["free_velocity"] = free
        if any(shift):
            document["shift"] = shift
        document["mass"] = {"shape": [size, size],
                            "triplets": {"row": list(range(size)), "column": list(range(size)), "value": masses}}
        document["jacobian"] = {"shape": [len(free), size], "triplets": {"row": row, "column": column, "value": value}}
        document["bodies"] = [[body, other] for body, other, *_ in self.contacts]
        return document


class Space(Mechanism):
    """Rigid bodies in space."""

    def __init__(self):
        super().__init__(3)

    def touch(self, body, other, arm, other_arm, normal, friction, shift=0.0, frame=None):
        """A contact at `arm` from the centre of the body and `other_arm` from that of the other one."""
        axes = (normal, *(frame or tangents(normal)))
        rows = [(rounded([*axis, *cross(arm, axis)]),
                 None if other is None else rounded([-x for x in (*axis, *cross(other_arm, axis))])) for axis in axes]
        self.contact(body, other, rows, friction, [shift, 0.0, 0.0])

    def ball(self, radius, mass, velocity):
        """A solid ball."""
        return self.body([mass] * 3 + [0.4 * mass * radius * radius] * 3, velocity)

    def box(self, half, mass, velocity):
        """A solid box of these half extents."""
        a, b, c = half
        third = mass / 3
        return self.body([mass] * 3 + [third * (b * b + c * c), third * (a * a + c * c), third * (a * a + b * b)], velocity)


class Plane(Mechanism):
    """Rigid bodies in the plane."""

    def __init__(self):
        super().__init__(2)

    def touch(self, body, other, arm, other_arm, normal, friction, shift=0.0):
        """A contact at `arm` from the centre of the body and `other_arm` from that of the other one; t is the normal turned by −90°."""
        axes = (normal, [normal[1], -normal[0]])
        rows = [(rounded([*axis, arm[0] * axis[1] - arm[1] * axis[0]]),
                 None if other is None else rounded([-axis[0], -axis[1], other_arm[1] * axis[0] - other_arm[0] * axis[1]]))
                for axis in axes]
        self.contact(body, other, rows, friction, [shift, 0.0])

    def box(self, half, mass, velocity):
        """A solid rectangle of these half extents."""
        return self.body([mass, mass, mass / 3 * (half[0] * half[0] + half[1] * half[1])], velocity)

    def disk(self, radius, mass, velocity):
        """A solid disk."""
        return self.body([mass, mass, 0.5 * mass * radius * radius], velocity)


class Points(Mechanism):
    """Points that move in the plane, with (v_x, v_y), or on a line."""

    def touch(self, body, normal, friction, shift=0.0, other=None):
        """A contact along this normal; in the plane t is the normal turned by −90°."""
        axes = [normal] if self.dimension == 1 else [normal, [normal[1], -normal[0]]]
        rows = [(list(axis), None if other is None else [-x for x in axis]) for axis in axes]
        self.contact(body, other, rows, friction, [shift] + [0.0] * (self.dimension - 1))


def falling(vertical=-1.0, size=6):
    """v_free of a body at rest after a step of gravity; in the plane y is up."""
    velocity = [0.0] * size
    velocity[2 if size == 6 else 1] = vertical * STEP * GRAVITY
    return velocity
