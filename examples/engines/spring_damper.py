#!/usr/bin/env python3
"""A compliant engine: a spring and a damper at every point of contact, and a spring that slides along the surface for friction.

    f_n = max(0, k δ − c u_n) ,    f_t = −k ξ − c u_t ,  ξ' = u_t ,  but ‖f_t‖ ≤ μ f_n: beyond that ξ is set so that it slides
    v⁺ = v + τ (g + M⁻¹ Hᵀ f) ,    x⁺ = x + τ v⁺    with substeps τ ≤ `substep`, whatever the step

    A point touches at a depth δ. Spheres touch along the line of centres, a box by its corners, by the corners of the other box, and by
    edges that pass through the other box. Friction sticks without creep, because ξ remembers where the point was.

    moreau gate --quick -- python3 examples/engines/spring_damper.py --stiffness 1e5 --damping 300
"""
import math
import sys

from engines_common import GROUND, World, cross, dot, minus, norm, plus, run, scaled, settings_of, times, transposed
from _protocol import Unsupported

DEFAULTS = {
    "stiffness": 1e5,     # k [N/m] of one point
    "damping": 300.0,     # c [N s/m] of one point
    "substep": 2e-4,      # [s] the longest
}
EDGES = [(corner, corner | 1 << axis) for corner in range(8) for axis in range(3) if not corner & 1 << axis]


def describe(settings):
    return {"name": "spring-damper", "version": "1", "precision": "double", "restitution": False, "friction": "cone",
            "reports_contacts": True, "levels": ["simulate"], "options": {},
            "contact_model": {"kind": "compliant", "law": "spring-damper", "parameters": {
                "stiffness": {"value": settings["stiffness"], "unit": "N/m"},
                "damping": {"value": settings["damping"], "unit": "N*s/m"},
                "substep": {"value": settings["substep"], "unit": "s"}}}}


class SpringDamper(World):
    """The bodies in motion; `stretched` holds ξ of every point that touches, by the names of what touches."""

    def __init__(self, scene, settings):
        super().__init__(scene, settings)
        if any(self.restitution.values()):
            raise Unsupported("a spring and a damper: the restitution follows from the mass and cannot be chosen")
        self.stretched = {}

    def step(self, h):
        count = math.ceil(h / self.settings["substep"])
        for _ in range(count):
            self.substep(h / count)

    def substep(self, tau):
        kept = {}
        kicks = []
        for i, j, normal, point, depth, name in self.points():
            a, b = self.bodies[i], self.bodies[j] if j is not None else None
            u = plus(a.v, 1.0, cross(a.spin, minus(point, a.x)))
            if b is not None:
                u = minus(u, plus(b.v, 1.0, cross(b.spin, minus(point, b.x))))
            other = GROUND if b is None else b.name
            force, kept[i, j, name] = self.force(normal, depth, u, self.stretched.get((i, j, name), (0.0, 0.0, 0.0)),
                                                 self.value(self.friction, a.name, other), tau)
            kicks.append((a, b, point, scaled(tau, force)))
            self.touch(a.name, other, normal, scaled(tau, force))
        self.stretched = kept
        for a, b, point, impulse in kicks:
            a.kick(impulse, minus(point, a.x))
            if b is not None:
                b.kick(scaled(-1.0, impulse), minus(point, b.x))
        for body in self.bodies:
            body.v = plus(body.v, tau, self.gravity)
            body.drift(tau)

    def force(self, normal, depth, u, stretch, friction, tau):
        """The force on the first body and the new ξ."""
        k, c = self.settings["stiffness"], self.settings["damping"]
        opening = dot(u, normal)
        pressed = max(0.0, k * depth - c * opening)
        slip = plus(u, -opening, normal)
        stretch = plus(stretch, -dot(stretch, normal), normal)  # along the surface as it is now
        stretch = plus(stretch, tau, slip)
        held = plus(scaled(-k, stretch), -c, slip)
        size, bound = norm(held), friction * pressed
        if size > bound:
            held = scaled(bound / size, held)
            stretch = scaled(-1.0 / k, plus(held, c, slip)) if bound > 0.0 else (0.0, 0.0, 0.0)
        return plus(scaled(pressed, normal), 1.0, held), stretch

    def points(self):
        """(i, j or None, normal on i, point, depth > 0, name)."""
        found = []
        for i, a in enumerate(self.bodies):
            if self.ground is not None:
                found += [(i, None, *point) for point in on_plane(a, tuple(self.ground["normal"]), self.ground["offset"])]
            for j in range(i + 1, len(self.bodies)):
                b = self.bodies[j]
                if norm(minus(a.x, b.x)) < reach(a) + reach(b):
                    found += [(i, j, *point) for point in touching(a, b)]
        return found


def reach(body):
    return body.radius if body.half is None else norm(body.half)


def on_plane(body, normal, offset):
    points = [("ball", plus(body.x, -body.radius, normal))] if body.half is None else enumerate(body.corners())
    depths = [(name, point, offset - dot(normal, point)) for name, point in points]
    return [(normal, plus(point, 0.5 * depth, normal), depth, name) for name, point, depth in depths if depth > 0.0]


def touching(a, b):
    """Points of two bodies; normals push a."""
    if a.half is None and b.half is None:
        line = minus(a.x, b.x)
        normal = scaled(1.0 / norm(line), line)
        depth = a.radius + b.radius - norm(line)
        return [(normal, plus(b.x, b.radius - 0.5 * depth, normal), depth, "balls")] if depth > 0.0 else []
    if b.half is None:
        return reversed_points(touching(b, a))
    if a.half is None:
        return ball_in(a, b)
    return corners_in(a, b, "corner") + reversed_points(corners_in(b, a, "other")) + edges_through(a, b)


def reversed_points(points):
    return [(scaled(-1.0, normal), *rest) for normal, *rest in points]


def nearest_face(local, half):
    """(axis, sign, depth) of the face of a box nearest to a point inside."""
    axis = min(range(3), key=lambda k: half[k] - abs(local[k]))
    return axis, math.copysign(1.0, local[axis]), half[axis] - abs(local[axis])


def ball_in(ball, box):
    local = times(transposed(box.rotation), minus(ball.x, box.x))
    surface = tuple(max(-h, min(h, x)) for x, h in zip(local, box.half))
    out = minus(local, surface)
    if any(out):
        depth, direction = ball.radius - norm(out), scaled(1.0 / norm(out), out)
    else:
        axis, sign, inside = nearest_face(local, box.half)
        depth, direction = ball.radius + inside, tuple(sign if k == axis else 0.0 for k in range(3))
    normal = times(box.rotation, direction)
    return [(normal, plus(ball.x, 0.5 * depth - ball.radius, normal), depth, "ball")] if depth > 0.0 else []


def corners_in(a, b, name):
    """Corners of a inside b."""
    found, into = [], transposed(b.rotation)
    for number, corner in enumerate(a.corners()):
        local = times(into, minus(corner, b.x))
        if all(abs(x) < h for x, h in zip(local, b.half)):
            axis, sign, depth = nearest_face(local, b.half)
            normal = scaled(sign, into[axis])
            found.append((normal, plus(corner, 0.5 * depth, normal), depth, (name, number)))
    return found


def edges_through(a, b):
    """Edges of a that pass through b, in by one face and out by a neighbouring one: they press on the edge between these."""
    found, axes = [], transposed(b.rotation)
    local = [times(axes, minus(corner, b.x)) for corner in a.corners()]
    for number, (start, end) in enumerate(EDGES):
        p, way = local[start], minus(local[end], local[start])
        first, last, faces = 0.0, 1.0, [None, None]
        for k in range(3):
            if abs(way[k]) < 1e-12:
                first = first if abs(p[k]) < b.half[k] else 2.0
                continue
            side = math.copysign(1.0, way[k])
            near, far = (-side * b.half[k] - p[k]) / way[k], (side * b.half[k] - p[k]) / way[k]
            if near > first:
                first, faces[0] = near, (k, -side)
            if far < last:
                last, faces[1] = far, (k, side)
        if first >= last or None in faces or faces[0][0] == faces[1][0]:
            continue
        (k, s), (m, t) = faces
        free = 3 - k - m
        across = tuple(1.0 if axis == free else 0.0 for axis in range(3))
        direction = cross(way, across)
        direction = scaled(1.0 / norm(direction), direction)
        outward = tuple(s if axis == k else t if axis == m else 0.0 for axis in range(3))
        if dot(direction, outward) < 0.0:
            direction = scaled(-1.0, direction)
        edge = tuple(s * b.half[k] if axis == k else t * b.half[m] if axis == m else 0.0 for axis in range(3))
        depth = dot(direction, minus(edge, p))
        middle = plus(p, 0.5 * (first + last), way)
        point = plus(b.x, 1.0, times(b.rotation, plus(middle, 0.5 * depth, direction)))
        found.append((times(b.rotation, direction), point, depth, ("edge", number, k, s, m, t)))
    return found


if __name__ == "__main__":
    chosen = settings_of(sys.argv[1:], DEFAULTS)
    run(describe, SpringDamper, chosen)
