#!/usr/bin/env python3
"""A rigid engine of Stewart and Trinkle's kind: gaps at the end of the step, a pyramid of friction, and Lemke's pivots.

    0 ≤ r_n ⟂ gap/h + u_n⁺ ≥ 0 ,    0 ≤ β ⟂ λ + Dᵀu⁺ ≥ 0 ,    0 ≤ λ ⟂ μ r_n − Σ β ≥ 0
    v⁺ = v + h g + M⁻¹ Hᵀ (r_n, D β) ,    x⁺ = x + h v⁺ ,    D: `directions` unit vectors around the normal

    As one linear complementarity problem  w = A z + b ,  0 ≤ w ⟂ z ≥ 0 .  Spheres and one box over a plane; e = 0; the tableau is dense,
    so that more than `MOST` points at once are refused.

    moreau gate --quick -- python3 examples/engines/pyramid_lemke.py --directions 4
"""
import math
import sys

from engines_common import GROUND, World, cross, dot, minus, norm, plus, run, scaled, settings_of, tangents, times, transposed
from _protocol import Unsupported

DEFAULTS = {"directions": 4}
MOST = 12
# An entry of the tableau below this part of the largest is rounding, not a pivot.
PIVOT = 1e-11
# Parts of the largest right side by which each is shifted, by different amounts, until the pivots end: equal ratios, which the four corners
# of a box bring with them, cannot be told apart in rounded numbers.
SHIFTS = (0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7)


def describe(settings):
    return {"name": "pyramid-lemke", "version": "1", "precision": "double", "restitution": False, "friction": "pyramid",
            "reports_contacts": True, "levels": ["simulate"], "options": {},
            "contact_model": {"kind": "rigid", "law": "stewart-trinkle",
                              "parameters": {"directions": {"value": settings["directions"], "unit": "1"}}}}


class Lemke(World):
    """The bodies in motion."""

    def __init__(self, scene, settings):
        super().__init__(scene, settings)
        if any(self.restitution.values()):
            raise Unsupported("gaps at the end of the step: this scheme has no restitution")
        if sum(body.half is not None for body in self.bodies) > 1:
            raise Unsupported("this engine has no contact between two boxes")

    def step(self, h):
        for body in self.bodies:
            body.v = plus(body.v, h, self.gravity)
        points = self.points(h)
        if len(points) > MOST:
            raise Unsupported(f"{len(points)} points of contact at once: the dense tableau has room for {MOST}")
        if points:
            self.answer(points, h)
        for body in self.bodies:
            body.drift(h)

    def points(self, h):
        """(a, b or None, normal on a, point, gap) of what can touch within the step."""
        found = []
        for i, a in enumerate(self.bodies):
            if self.ground is not None:
                n = tuple(self.ground["normal"])
                for lowest in ([plus(a.x, -a.radius, n)] if a.half is None else a.corners()):
                    gap = dot(n, lowest) - self.ground["offset"]
                    found.append((a, None, n, lowest, gap))
            for b in self.bodies[i + 1:]:
                found.append(self.ball_and(a, b) if a.half is None else self.turned_round(self.ball_and(b, a)))
        return [point for point in found if point[4] < h * self.nearing(point)]

    @staticmethod
    def turned_round(point):
        a, b, n, place, gap = point
        return b, a, scaled(-1.0, n), place, gap

    @staticmethod
    def ball_and(ball, other):
        inside = (0.0, 0.0, 0.0)
        if other.half is not None:
            local = times(transposed(other.rotation), minus(ball.x, other.x))
            inside = tuple(max(-h, min(h, x)) for x, h in zip(local, other.half))
        near = plus(other.x, 1.0, times(other.rotation, inside))
        line = minus(ball.x, near)
        n = scaled(1.0 / norm(line), line)
        size = other.radius if other.half is None else 0.0
        return ball, other, n, plus(near, size, n), norm(line) - ball.radius - size

    @staticmethod
    def nearing(point):
        """A bound [m/s] on the speed at which the two can come nearer."""
        def speed(body):
            return norm(body.v) + norm(body.spin) * (body.radius if body.half is None else norm(body.half))
        return sum(speed(body) for body in point[:2] if body is not None)

    def answer(self, points, h):
        """Solve for the impulses, kick the bodies and report."""
        count = int(self.settings["directions"])
        rows = []  # (point, direction): all normals, then the pyramid's directions point by point
        for point in points:
            rows.append((point, point[2]))
        for point in points:
            first, second = tangents(point[2])
            for k in range(count):
                angle = 2.0 * math.pi * k / count
                rows.append((point, plus(scaled(math.cos(angle), first), math.sin(angle), second)))
        m, n = len(points), len(rows)
        turns = [[(body.spin_of(cross(minus(point[3], body.x), direction)) if body is not None else None) for body in point[:2]]
                 for point, direction in rows]
        size = n + m
        a = [[0.0] * size for _ in range(size)]
        b = [0.0] * size
        for r, (point, direction) in enumerate(rows):
            b[r] = self.speed(point, direction) + (point[4] / h if r < m else 0.0)
            for s in range(r, n):
                a[r][s] = a[s][r] = self.delassus(point, direction, rows[s], turns[s])
        for k, point in enumerate(points):
            other = GROUND if point[1] is None else point[1].name
            a[n + k][k] = self.value(self.friction, point[0].name, other)
            for d in range(count):
                r = m + k * count + d
                a[r][n + k], a[n + k][r] = 1.0, -1.0
        z = solved(a, b)
        for k, point in enumerate(points):
            impulse = scaled(z[k], point[2])
            for r in range(m + k * count, m + (k + 1) * count):
                impulse = plus(impulse, z[r], rows[r][1])
            first, second, n_, place, _ = point
            first.kick(impulse, minus(place, first.x))
            if second is not None:
                second.kick(scaled(-1.0, impulse), minus(place, second.x))
            self.touch(first.name, GROUND if second is None else second.name, n_, impulse)

    @staticmethod
    def speed(point, direction):
        def of(body):
            return dot(direction, plus(body.v, 1.0, cross(body.spin, minus(point[3], body.x)))) if body is not None else 0.0
        return of(point[0]) - of(point[1])

    @staticmethod
    def delassus(point, direction, row, turns):
        """How much a unit impulse in `row` changes the relative speed of `point` in `direction`."""
        other, along = row
        total = 0.0
        for body, sign in ((point[0], 1.0), (point[1], -1.0)):
            for acted, turn, side in ((other[0], turns[0], 1.0), (other[1], turns[1], -1.0)):
                if body is not None and body is acted:
                    arm = cross(minus(point[3], body.x), direction)
                    total += sign * side * (dot(direction, along) / body.mass + dot(arm, turn))
        return total


def solved(a, b):
    """Lemke's answer to the problem, or to the nearest shifted one that his method solves."""
    size = max(map(abs, b))
    for shift in SHIFTS:
        try:
            return lemke(a, [x + shift * size * (1.0 + math.sqrt(2 + k) % 1.0) for k, x in enumerate(b)])
        except ArithmeticError as problem:
            last = problem
    raise last


def lemke(a, b):
    """z ≥ 0 with w = A z + b ≥ 0 and w·z = 0, by Lemke's pivots with the lexicographic rule; an error if they end on a ray."""
    n = len(b)
    if min(b) >= 0.0:
        return [0.0] * n
    # columns: w (n), z (n), the covering variable, the right side
    tableau = [[1.0 if i == j else 0.0 for j in range(n)] + [-x for x in a[i]] + [-1.0, b[i]] for i in range(n)]
    basis = list(range(n))
    cover, right = 2 * n, 2 * n + 1
    entering, leaving = cover, min(range(n), key=lambda i: (b[i], -i))
    for _ in range(50 * n + 50):
        pivot(tableau, leaving, entering)
        gone, basis[leaving] = basis[leaving], entering
        if gone == cover:
            z = [0.0] * n
            for i, variable in enumerate(basis):
                if n <= variable < cover:
                    z[variable - n] = max(0.0, tableau[i][right])
            return z
        entering = gone + n if gone < n else gone - n
        scale = max(abs(row[entering]) for row in tableau)
        able = [i for i in range(n) if tableau[i][entering] > PIVOT * max(1.0, scale)]
        if not able:
            raise ArithmeticError("Lemke's method ended on a ray")
        leaving = least(tableau, able, entering, n, right, basis, cover)
    raise ArithmeticError("Lemke's method did not end")


def least(tableau, able, entering, n, right, basis, cover):
    """The row with the least ratio; among equal ones that of the covering variable, then the lexicographically least."""
    ratios = {i: tableau[i][right] / tableau[i][entering] for i in able}
    low = min(ratios.values())
    tied = [i for i in able if ratios[i] <= low + 1e-13 * max(1.0, abs(low))]
    for i in tied:
        if basis[i] == cover:
            return i
    for column in range(n):
        if len(tied) == 1:
            break
        ratios = {i: tableau[i][column] / tableau[i][entering] for i in tied}
        low = min(ratios.values())
        tied = [i for i in tied if ratios[i] <= low + 1e-13 * max(1.0, abs(low))]
    return tied[0]


def pivot(tableau, row, column):
    """Make the column a unit vector with its one in the row."""
    divisor = tableau[row][column]
    head = tableau[row] = [x / divisor for x in tableau[row]]
    for i, other in enumerate(tableau):
        if i != row and other[column] != 0.0:
            factor = other[column]
            tableau[i] = [x - factor * y for x, y in zip(other, head)]


if __name__ == "__main__":
    run(describe, Lemke, settings_of(sys.argv[1:], DEFAULTS))
