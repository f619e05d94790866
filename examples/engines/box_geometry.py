"""Where spheres, boxes and a plane touch: separating axes and clipping. For the engine with Gauss–Seidel sweeps; the others have their own.

    Each function gives points (normal from b to a, point on a, point on b, gap, name), gap = n·(point on a − point on b).
"""
import round_geometry
from _protocol import Unsupported
from engines_common import AXES, cross, dot, minus, norm, plus, scaled, times, transposed

# Two edges whose cross product is shorter than this are parallel: a face normal separates as well.
PARALLEL = 1e-6
# An edge pair must separate by this much [m] more than any face to be chosen: faces carry four points, an edge pair one.
EDGE_BIAS = 1e-7


def with_plane(a, normal, offset):
    """Points of a body over the plane n·x = c."""
    if a.shape == "capsule":
        return round_geometry.capsule_on_plane(a, normal, offset)
    if a.shape == "cylinder":
        return round_geometry.cylinder_on_plane(a, normal, offset)
    if a.shape == "sphere":
        points = [("sphere", plus(a.x, -a.radius, normal))]
    else:
        points = list(enumerate(a.corners()))
    found = []
    for name, point in points:
        gap = dot(normal, point) - offset
        found.append((normal, point, plus(point, -gap, normal), gap, name))
    return found


def between(a, b):
    """Points of two bodies."""
    if (a.shape, b.shape) in PAIRS:
        return PAIRS[a.shape, b.shape](a, b)
    if (b.shape, a.shape) in PAIRS:
        return [(scaled(-1.0, n), on_b, on_a, gap, name) for n, on_a, on_b, gap, name in PAIRS[b.shape, a.shape](b, a)]
    raise Unsupported(f"this engine has no contact of a {a.shape} with a {b.shape}")


def spheres(a, b):
    line = minus(a.x, b.x)
    distance = norm(line)
    n = scaled(1.0 / distance, line) if distance > 0.0 else AXES[2]
    return [(n, plus(a.x, -a.radius, n), plus(b.x, b.radius, n), distance - a.radius - b.radius, "spheres")]


def sphere_on_box(ball, box):
    """The nearest point of the box; from inside, the nearest face."""
    local = times(transposed(box.rotation), minus(ball.x, box.x))
    nearest = tuple(max(-h, min(h, x)) for x, h in zip(local, box.half))
    outside = minus(local, nearest)
    distance = norm(outside)
    if distance > 0.0:
        n = scaled(1.0 / distance, outside)
    else:
        k = min(range(3), key=lambda axis: box.half[axis] - abs(local[axis]))
        n = scaled(1.0 if local[k] >= 0.0 else -1.0, AXES[k])
        distance = abs(local[k]) - box.half[k]
        nearest = plus(local, -distance, n)
    n = times(box.rotation, n)
    return [(n, plus(ball.x, -ball.radius, n), plus(box.x, 1.0, times(box.rotation, nearest)), distance - ball.radius, "sphere")]


def boxes(a, b):
    """The axis that separates most, then the points of that face or that pair of edges."""
    between_centres = minus(a.x, b.x)
    axes_a, axes_b = transposed(a.rotation), transposed(b.rotation)

    def separation(axis):
        reach = sum(h * abs(dot(axis, e)) for h, e in zip(a.half, axes_a)) + sum(h * abs(dot(axis, e)) for h, e in zip(b.half, axes_b))
        return abs(dot(between_centres, axis)) - reach

    faces = [(separation(axis), 0, k, axis) for k, axis in enumerate(axes_a)]
    faces += [(separation(axis), 1, k, axis) for k, axis in enumerate(axes_b)]
    best = max(faces, key=lambda face: face[0])
    edges = []
    for i, first in enumerate(axes_a):
        for j, second in enumerate(axes_b):
            axis = cross(first, second)
            if norm(axis) > PARALLEL:
                axis = scaled(1.0 / norm(axis), axis)
                edges.append((separation(axis), i, j, axis))
    edge = max(edges, default=(-float("inf"),), key=lambda pair: pair[0])
    chosen = edge if edge[0] > best[0] + EDGE_BIAS else best
    n = chosen[3] if dot(chosen[3], between_centres) >= 0.0 else scaled(-1.0, chosen[3])
    if chosen is edge:
        return edge_on_edge(a, b, n, chosen[1], chosen[2])
    return face_points(a, b, n, chosen[1] == 0, chosen[2])


def edge_on_edge(a, b, n, i, j):
    """The nearest points of the edge of a that lies farthest along −n, parallel to its axis i, and of b's along n, parallel to j."""
    def middle(body, direction, along):
        axes = transposed(body.rotation)
        point = body.x
        for k in range(3):
            if k != along:
                point = plus(point, body.half[k] if dot(axes[k], direction) > 0.0 else -body.half[k], axes[k])
        return point, axes[along]

    (p, u), (q, w) = middle(a, scaled(-1.0, n), i), middle(b, n, j)
    line, uw = minus(p, q), dot(u, w)
    s = (uw * dot(w, line) - dot(u, line)) / (1.0 - uw * uw)
    on_a = plus(p, s, u)
    on_b = plus(q, dot(w, minus(on_a, q)), w)
    return [(n, on_a, on_b, dot(n, minus(on_a, on_b)), ("edges", i, j))]


def face_points(a, b, n, of_a, k):
    """The corners of the other box's face, clipped by the sides of face k of a (`of_a`) or b."""
    reference, other = (a, b) if of_a else (b, a)
    outward = scaled(-1.0, n) if of_a else n
    axes, other_axes = transposed(reference.rotation), transposed(other.rotation)
    facing = max(range(3), key=lambda axis: abs(dot(other_axes[axis], outward)))
    side = -1.0 if dot(other_axes[facing], outward) > 0.0 else 1.0
    centre = plus(other.x, side * other.half[facing], other_axes[facing])
    u, w = [axis for axis in range(3) if axis != facing]
    polygon = []
    for s, t in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        polygon.append(plus(plus(centre, s * other.half[u], other_axes[u]), t * other.half[w], other_axes[w]))
    for axis in range(3):
        if axis != k:
            for sign in (1.0, -1.0):
                inward = scaled(-sign, axes[axis])
                polygon = clipped(polygon, inward, dot(inward, reference.x) - reference.half[axis])
    level = dot(outward, reference.x) + reference.half[k]
    points = []
    for name, point in enumerate(polygon):
        gap = dot(outward, point) - level
        foot = plus(point, -gap, outward)
        points.append((n, *((foot, point) if of_a else (point, foot)), gap, ("face", of_a, k, name)))
    return points


def clipped(polygon, inward, bound):
    """The part of a polygon with inward·x ≥ bound."""
    kept = []
    for here, there in zip(polygon, polygon[1:] + polygon[:1]):
        before, after = dot(inward, here) - bound, dot(inward, there) - bound
        if before >= 0.0:
            kept.append(here)
        if before * after < 0.0:
            kept.append(plus(here, before / (before - after), minus(there, here)))
    return kept


PAIRS = {("sphere", "sphere"): spheres, ("sphere", "box"): sphere_on_box, ("box", "box"): boxes,
         ("sphere", "capsule"): round_geometry.sphere_on_capsule, ("sphere", "cylinder"): round_geometry.sphere_on_cylinder,
         ("capsule", "capsule"): round_geometry.capsules}
