"""Contact points of spheres, boxes, capsules, cylinders and a half-space, exact for the shapes;
standard library only.

For engines that are told where bodies touch.  A body is (shape, position x, rotation R), R a list
of rows that takes body to world coordinates, the shape a radius, three half extents, or radius and
half height (r, l) of a capsule or cylinder along the body's z axis.  Every function returns contact points (gap, point, normal): the gap is negative when bodies overlap, the
normal leads from the second body to the first, the point lies on one of the two.

Boxes: of the fifteen axes that can separate two boxes the one with the largest separation is the
normal.  If it belongs to a face, the points are the corners of the opposite face cut to that face's
prism; if it belongs to two edges, the point is where they are closest.

A cylinder on the ground: on the rim of each end the lowest point and those a quarter, a half and
three quarters of a turn further, so that it lies on two and stands on four.
"""

import math

MOST_POINTS = 8
"""A quadrilateral cut by four planes has at most eight corners, a box has eight corners."""

PREFERENCE = 1e-9
"""Share of the size by which an edge must beat a face, and corners may lie outside when cut.

It only decides between descriptions of the same contact whose gaps differ by as much.
"""


def rotation(quaternion):
    """Rows of the rotation matrix of a unit quaternion [w, x, y, z]."""
    w, x, y, z = quaternion
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def dot(a, b):
    """a · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    """a × b."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def along(a, factor, b):
    """a + factor · b."""
    return [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]]


def _column(matrix, k):
    return [matrix[0][k], matrix[1][k], matrix[2][k]]


def sphere_ground(sphere, ground):
    """One point; the ground is (unit normal n, offset c) of the half-space n·x ≥ c."""
    (radius, x, _), (normal, offset) = sphere, ground
    return [(dot(normal, x) - offset - radius, along(x, -radius, normal), normal)]


def box_ground(box, ground):
    """The eight corners."""
    (half, x, turn), (normal, offset) = box, ground
    points = []
    for signs in ((i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)):
        local = [s * h for s, h in zip(signs, half)]
        corner = [x[i] + dot(turn[i], local) for i in range(3)]
        points.append((dot(normal, corner) - offset, corner, normal))
    return points


def capsule_ground(capsule, ground):
    """One point below the middle of each half ball."""
    return [sphere_ground(ball, ground)[0] for ball in _half_balls(capsule)]


def _half_balls(capsule):
    (radius, half_height), x, turn = capsule
    axis = _column(turn, 2)
    return [(radius, along(x, sign * half_height, axis), turn) for sign in (-1.0, 1.0)]


def cylinder_ground(cylinder, ground):
    """Four points on the rim of each end, the lowest of it among them."""
    ((radius, half_height), x, turn), (normal, offset) = cylinder, ground
    axis = _column(turn, 2)
    across = along(normal, -dot(normal, axis), axis)
    length = math.hypot(*across)
    # upright to rounding every point of the rim is as low: one that turns with the body stays
    down = [-c / length for c in across] if length > PREFERENCE else _column(turn, 0)
    aside, points = cross(axis, down), []
    for sign in (-1.0, 1.0):
        centre = along(x, sign * half_height, axis)
        for share, other in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)):
            point = along(along(centre, share * radius, down), other * radius, aside)
            points.append((dot(normal, point) - offset, point, normal))
    return points


def sphere_capsule(sphere, capsule):
    """One point, on the line from the centre to the nearest point of the capsule's axis."""
    (radius, x, turn), ((other_radius, half_height), y, other_turn) = sphere, capsule
    axis = _column(other_turn, 2)
    place = min(max(dot(axis, along(x, -1.0, y)), -half_height), half_height)
    return sphere_sphere((radius, x, turn), (other_radius, along(y, place, axis), other_turn))


def capsule_capsule(one, other):
    """The point where the axes are next to each other; two, the ends of the overlap, of parallels."""
    ((radius, half), x, turn), ((other_radius, other_half), y, other_turn) = one, other
    u, v, between = _column(turn, 2), _column(other_turn, 2), along(y, -1.0, x)
    cosine, ahead, behind = dot(u, v), dot(between, u), dot(between, v)
    squared_sine = 1.0 - cosine * cosine

    def touch(place):
        """Sphere against the second capsule, at a place on the first one's axis."""
        ball = (radius, along(x, place, u), turn)
        return sphere_capsule(ball, other)[0]

    if squared_sine <= PREFERENCE:
        low = max(-half, ahead - other_half)
        high = min(half, ahead + other_half)
        return [touch(low), touch(high)] if low < high else [touch(min(max(ahead, -half), half))]
    place = min(max((ahead - cosine * behind) / squared_sine, -half), half)
    beside = min(max(place * cosine - behind, -other_half), other_half)
    return [touch(min(max(ahead + beside * cosine, -half), half))]


def sphere_cylinder(sphere, cylinder):
    """One point, opposite the point of the cylinder that is closest to the centre."""
    (radius, x, _), ((rim, half_height), y, turn) = sphere, cylinder
    away, axis = along(x, -1.0, y), _column(turn, 2)
    height = dot(axis, away)
    aside = along(away, -height, axis)
    distance_aside = math.hypot(*aside)
    outward = ([c / distance_aside for c in aside] if distance_aside > 0 else _column(turn, 0))
    up = axis if height >= 0 else [-c for c in axis]
    beyond, beside = abs(height) - half_height, distance_aside - rim
    if beyond <= 0 or beside <= 0:  # opposite an end or the side; from inside the nearer of them
        gap, normal = (beyond, up) if beyond > beside else (beside, outward)
    else:
        gap = math.hypot(beyond, beside)
        normal = [(beyond * u + beside * o) / gap for u, o in zip(up, outward)]
    return [(gap - radius, along(x, -radius, normal), normal)]


def sphere_sphere(one, other):
    """One point on the line of centres; concentric spheres touch along x."""
    (radius, x, _), (other_radius, y, _) = one, other
    away = along(x, -1.0, y)
    distance = math.hypot(*away)
    normal = [c / distance for c in away] if distance > 0 else [1.0, 0.0, 0.0]
    return [(distance - radius - other_radius, along(x, -radius, normal), normal)]


def sphere_box(sphere, box):
    """One point, opposite the point of the box that is closest to the centre."""
    (radius, x, _), (half, y, turn) = sphere, box
    away = along(x, -1.0, y)
    local = [dot(_column(turn, k), away) for k in range(3)]
    outside = [c - min(max(c, -h), h) for c, h in zip(local, half)]
    distance = math.hypot(*outside)
    if distance > 0:
        local_normal = [c / distance for c in outside]
    else:  # the centre is inside: out through the nearest face
        axis = max(range(3), key=lambda k: abs(local[k]) - half[k])
        distance = abs(local[axis]) - half[axis]
        local_normal = [math.copysign(1.0, local[k]) if k == axis else 0.0 for k in range(3)]
    normal = [dot(turn[i], local_normal) for i in range(3)]
    return [(distance - radius, along(x, -radius, normal), normal)]


def box_box(one, other):
    """Up to eight points of two boxes, along the axis with the largest separation."""
    (half, x, turn), (other_half, y, other_turn) = one, other
    away = along(x, -1.0, y)
    size = max(*half, *other_half)

    def separation(axis):
        reach = _reach(half, turn, axis) + _reach(other_half, other_turn, axis)
        return abs(dot(away, axis)) - reach

    faces = [(separation(_column(matrix, k)), -owner, -k) for owner, matrix
             in enumerate((turn, other_turn)) for k in range(3)]
    best = max((s + (PREFERENCE * size if owner == 0 else 0.0), owner, k) for s, owner, k in faces)
    edges = []
    for i in range(3):
        for j in range(3):
            axis = cross(_column(turn, i), _column(other_turn, j))
            length = math.hypot(*axis)
            if length > PREFERENCE:
                axis = [c / length for c in axis]
                edges.append((separation(axis), -i, -j, axis))
    if edges and max(edges)[0] > best[0] + 2 * PREFERENCE * size:
        gap, i, j, axis = max(edges)
        normal = axis if dot(away, axis) > 0 else [-c for c in axis]
        return _edge_edge(one, other, -i, -j, normal, gap)
    if best[1] == 0:
        return [(gap, point, [-c for c in normal]) for gap, point, normal
                in _face(one, other, -best[2], PREFERENCE * size)]
    return _face(other, one, -best[2], PREFERENCE * size)


def _reach(half, turn, axis):
    return sum(h * abs(dot(_column(turn, k), axis)) for k, h in enumerate(half))


def _face(reference, incident, axis, slack):
    """Corners of `incident` over the face of `reference` along its `axis` that looks at it."""
    (half, x, turn), (other_half, y, other_turn) = reference, incident
    normal = _column(turn, axis)
    if dot(normal, along(y, -1.0, x)) < 0:
        normal = [-c for c in normal]
    polygon = _opposite_face(other_half, y, other_turn, normal)
    for k in range(3):
        for sign in (-1.0, 1.0) if k != axis else ():
            side = [sign * c for c in _column(turn, k)]
            polygon = _cut(polygon, side, dot(side, x) + half[k] + slack)
    offset = dot(normal, x) + half[axis]
    return [(dot(normal, corner) - offset, corner, normal) for corner in polygon]


def _opposite_face(half, x, turn, normal):
    """Corners, in order, of the face that looks against `normal`."""
    k = max(range(3), key=lambda k: abs(dot(_column(turn, k), normal)))
    sign = -1.0 if dot(_column(turn, k), normal) > 0 else 1.0
    centre = along(x, sign * half[k], _column(turn, k))
    i, j = (k + 1) % 3, (k + 2) % 3
    return [along(along(centre, s * half[i], _column(turn, i)), t * half[j], _column(turn, j))
            for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


def _cut(polygon, side, offset):
    """The part of a convex polygon with side · x ≤ offset."""
    result = []
    for index, corner in enumerate(polygon):
        previous = polygon[index - 1]
        here, before = dot(side, corner) - offset, dot(side, previous) - offset
        if (here > 0) != (before > 0):
            share = before / (before - here)
            result.append(along(previous, share, along(corner, -1.0, previous)))
        if here <= 0:
            result.append(corner)
    return result


def _edge_edge(one, other, i, j, normal, gap):
    """The point of the first box's edge along axis i nearest to the second's along axis j."""
    (half, x, turn), (other_half, y, other_turn) = one, other
    start, end = list(x), list(y)
    for k in range(3):
        if k != i:
            direction = _column(turn, k)
            start = along(start, -math.copysign(half[k], dot(direction, normal)), direction)
        if k != j:
            direction = _column(other_turn, k)
            end = along(end, math.copysign(other_half[k], dot(direction, normal)), direction)
    u, v = _column(turn, i), _column(other_turn, j)
    between, cosine = along(end, -1.0, start), dot(u, v)
    share = (dot(between, u) - cosine * dot(between, v)) / (1.0 - cosine * cosine)
    return [(gap, along(start, share, u), normal)]
