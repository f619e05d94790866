"""Contact points of a scene as relations of Siconos, which asks for gap, point and normal at q."""

import math

import numpy as np
import siconos.kernel as kernel

import _contact_points as contact
from _protocol import Unsupported
from _scene import GROUND, shape_of

APART = 1e30
"""Gap of a place for a contact point that the pair does not have at present: no step closes it."""

MARGIN_STEPS, MARGIN_SHARE = 4.0, 0.1
"""A pair becomes known to Siconos when it could touch within so many steps, or is closer than this
share of its size; Siconos looks γ steps ahead."""


POINTS = {
    ("sphere",): (contact.sphere_ground, 1),
    ("box",): (contact.box_ground, contact.MOST_POINTS),
    ("capsule",): (contact.capsule_ground, 2),
    ("cylinder",): (contact.cylinder_ground, contact.MOST_POINTS),
    ("sphere", "sphere"): (contact.sphere_sphere, 1),
    ("sphere", "box"): (contact.sphere_box, 1),
    ("sphere", "capsule"): (contact.sphere_capsule, 1),
    ("sphere", "cylinder"): (contact.sphere_cylinder, 1),
    ("capsule", "capsule"): (contact.capsule_capsule, 2),
    ("box", "box"): (contact.box_box, contact.MOST_POINTS),
}
"""The function for each pair of shapes, or shape and ground, and the most points it gives."""


class Pair:
    """Two shapes, or a shape and the ground as `b`, and their contact points at a configuration."""

    def __init__(self, scene, a, b):
        bodies = {body["name"]: body for body in scene["bodies"]}
        if b != GROUND and shape_of(bodies[a]) != "sphere" == shape_of(bodies[b]):
            a, b = b, a
        self.a, self.b = a, b
        touching = [bodies[name] for name in (a, b) if name != GROUND]
        self.shapes = [_size(body) for body in touching]
        self.ground = scene.get("ground")
        kinds = tuple(shape_of(body) for body in touching)
        if kinds not in POINTS:
            raise Unsupported(f"no contact points are worked out for {' and '.join(kinds)}")
        self.points_of, self.slots = POINTS[kinds]
        self.radii = [_reach(body) for body in touching]
        self.last, self.points = None, []

    def could_touch(self, states, time_step):
        """Whether the bodies, with states (q, twist), come close enough to be looked at."""
        speed = sum(math.hypot(*twist[:3]) + radius * math.hypot(*twist[3:])
                    for (_, twist), radius in zip(states, self.radii))
        margin = MARGIN_STEPS * time_step * speed + MARGIN_SHARE * min(self.radii)
        if len(states) == 2:
            centres = [q[:3] for q, _ in states]
            if math.dist(*centres) > sum(self.radii) + margin:
                return False
        points = self.at([c for q, _ in states for c in q])
        return any(gap < margin for gap, _, _ in points)

    def at(self, q):
        """The contact points at q = (x, quaternion) of one or two bodies."""
        if q != self.last:
            placed = [(shape, q[7 * i:7 * i + 3], contact.rotation(q[7 * i + 3:7 * i + 7]))
                      for i, shape in enumerate(self.shapes)]
            if len(placed) == 1:
                placed.append((self.ground["normal"], self.ground["offset"]))
            self.last, self.points = q, self.points_of(*placed)
        return self.points


def _size(body):
    kind = shape_of(body)
    if kind == "sphere":
        return body["sphere"]["radius"]
    if kind == "box":
        return list(body["box"]["half_extents"])
    return body[kind]["radius"], body[kind]["half_height"]


def _reach(body):
    """The greatest distance of a point of the body from its middle [m]."""
    size = _size(body)
    if "capsule" in body:
        return sum(size)
    return size if "sphere" in body else math.hypot(*size)


class Touch(kernel.NewtonEuler3DR):
    """One contact point of a pair, or the place for one."""

    def __init__(self, pair, slot):
        super().__init__()
        self.pair, self.slot, self.interaction = pair, slot, None

    def computeh(self, _time, q, y):
        """Gap and contact frame at q; Siconos asks for them."""
        place = q.tolist()
        points = self.pair.at(place)
        gap, point, normal = (points[self.slot] if self.slot < len(points)
                              else (APART, place[:3], [1.0, 0.0, 0.0]))
        # the vectors are written in place: Siconos ends when they are exchanged
        self.pc1()[:] = point
        self.pc2()[:] = contact.along(point, -gap, normal)
        self.nc()[:] = normal
        y[0], y[1], y[2] = gap, 0.0, 0.0

    def impulse(self):
        """[(a, b, normal, impulse on a in the world frame)] of the step just made, or nothing."""
        r = self.interaction.lambda_(1)
        if not any(r):
            return []
        frame = self.jachqT()[:, :3]
        return [(self.pair.a, self.pair.b, list(frame[0]), list(frame.T @ r))]


class OrthonormalTouch(Touch):
    """The same, with tangents that are orthogonal to the normal and to each other.

    Those of Siconos 4.4.0 are not when z is the largest component of the normal and the other two
    differ: t₁ = (0, −n_z, n_x) stands there in place of (0, −n_z, n_y).  Siconos 4.5.0 mends it.
    """

    def __init__(self, pair, slot):
        super().__init__(pair, slot)
        self.normal, self.turn = None, None

    def computeJachqT(self, interaction, q):
        """The Jacobian of Siconos, turned from its frame into an orthonormal one."""
        super().computeJachqT(interaction, q)
        jacobian = self.jachqT()
        if self.normal != jacobian[0, :3].tolist():
            self.normal, self.turn = jacobian[0, :3].tolist(), _mend(jacobian[:, :3])
        jacobian[:] = self.turn @ jacobian


def _mend(frame):
    """The matrix that takes Siconos's frame (n, t₁, t₂) to the nearest orthonormal one with the same n.

    t₁ is 26° or more from n, and t₂ is orthogonal to both: the frame changes as little as n does
    between two steps, so that the impulses the solver starts from stay good.
    """
    normal, first, second = frame
    first = first - (first @ normal) * normal
    mended = np.array([normal, first / np.linalg.norm(first), second / np.linalg.norm(second)])
    return mended @ np.linalg.inv(frame)
