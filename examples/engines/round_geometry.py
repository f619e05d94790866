"""Where capsules and cylinders touch a plane and spheres; capsules also each other. For the engine with Gauss–Seidel sweeps.

    capsule     the points within r of the segment x ± l a              a: the body's z axis
    cylinder    |a·(y − x)| ≤ l ,  |y − x − a a·(y − x)| ≤ r

    Each function gives points (normal from b to a, point on a, point on b, gap, name), gap = n·(point on a − point on b).
"""
import math

from engines_common import AXES, dot, minus, norm, plus, scaled, times, transposed

# A cylinder whose axis is this near to a plane's normal [rad] stands on points of its rim, one that leans more on its lowest point.
STANDING = 1.0 / 16.0
# Two segments whose directions differ by less than this [rad] have no pair of nearest inner points of their own.
PARALLEL = 1e-6


def ends(body):
    """The middles of both ends."""
    axis = transposed(body.rotation)[2]
    return [plus(body.x, side * body.half_height, axis) for side in (-1.0, 1.0)]


def over_plane(normal, offset, points):
    """(name, point on the body) as contact points."""
    found = []
    for name, point in points:
        gap = dot(normal, point) - offset
        found.append((normal, point, plus(point, -gap, normal), gap, name))
    return found


def capsule_on_plane(body, normal, offset):
    """Both ends, as spheres."""
    return over_plane(normal, offset, [(side, plus(end, -body.radius, normal)) for side, end in enumerate(ends(body))])


def cylinder_on_plane(body, normal, offset):
    """The lowest point of each rim; of one that stands, four points of each rim that turn with it."""
    x, y, axis = transposed(body.rotation)
    across = plus(normal, -dot(normal, axis), axis)
    points = []
    for side, middle in enumerate(ends(body)):
        if norm(across) > PARALLEL:
            points.append((("lowest", side), plus(middle, -body.radius / norm(across), across)))
        if norm(across) < STANDING:
            around = (x, y, scaled(-1.0, x), scaled(-1.0, y))
            points += [(("rim", side, k), plus(middle, body.radius, out)) for k, out in enumerate(around)]
    return over_plane(normal, offset, points)


def nearest_on_segment(body, point):
    """Of the axis of a capsule."""
    axis = transposed(body.rotation)[2]
    along = dot(axis, minus(point, body.x))
    return plus(body.x, max(-body.half_height, min(body.half_height, along)), axis), abs(along) < body.half_height


def between_centres(centre_a, radius_a, centre_b, radius_b, name):
    line = minus(centre_a, centre_b)
    distance = norm(line)
    n = scaled(1.0 / distance, line) if distance > 0.0 else AXES[2]
    return n, plus(centre_a, -radius_a, n), plus(centre_b, radius_b, n), distance - radius_a - radius_b, name


def sphere_on_capsule(ball, capsule):
    middle, _ = nearest_on_segment(capsule, ball.x)
    return [between_centres(ball.x, ball.radius, middle, capsule.radius, "sphere")]


def sphere_on_cylinder(ball, cylinder):
    """The nearest point of the cylinder; from inside, that of the nearest face or side."""
    rotation, r, half = cylinder.rotation, cylinder.radius, cylinder.half_height
    x, y, z = times(transposed(rotation), minus(ball.x, cylinder.x))
    out = math.hypot(x, y)
    outward = (x / out, y / out, 0.0) if out > 0.0 else AXES[0]
    inner = min(1.0, r / out) if out > 0.0 else 1.0
    near = (x * inner, y * inner, max(-half, min(half, z)))
    line = minus((x, y, z), near)
    distance = norm(line)
    if distance > 0.0:
        n = scaled(1.0 / distance, line)
    elif r - out < half - abs(z):
        n, near, distance = outward, (r * outward[0], r * outward[1], z), out - r
    else:
        n, near, distance = (0.0, 0.0, 1.0 if z >= 0.0 else -1.0), (x, y, math.copysign(half, z)), abs(z) - half
    n, near = times(rotation, n), plus(cylinder.x, 1.0, times(rotation, near))
    return [(n, plus(ball.x, -ball.radius, n), near, distance - ball.radius, "sphere")]


def capsules(a, b):
    """The ends of each with the other, and the inner points where the axes pass each other."""
    found = []
    for side, end in enumerate(ends(a)):
        found.append(between_centres(end, a.radius, nearest_on_segment(b, end)[0], b.radius, ("end of a", side)))
    for side, end in enumerate(ends(b)):
        middle, inner = nearest_on_segment(a, end)
        if inner:  # otherwise an end of a has it
            found.append(between_centres(middle, a.radius, end, b.radius, ("end of b", side)))
    u, w = transposed(a.rotation)[2], transposed(b.rotation)[2]
    line, uw = minus(a.x, b.x), dot(u, w)
    sine = 1.0 - uw * uw
    if sine > PARALLEL ** 2:
        s = (uw * dot(w, line) - dot(u, line)) / sine
        t = (dot(w, line) - uw * dot(u, line)) / sine
        if abs(s) < a.half_height and abs(t) < b.half_height:
            found.append(between_centres(plus(a.x, s, u), a.radius, plus(b.x, t, w), b.radius, "axes"))
    return found
