"""Piles of spheres and of capsules, and disks in the plane."""

from math import sqrt

from problems.mechanism import Draw, Plane, Space, dot, falling, rounded, unit
from problems.posed import Posed


def _distance(one, other):
    """By a square root alone, which rounds in one way on every machine."""
    between = [x - y for x, y in zip(one, other)]
    return sqrt(dot(between, between))


def _ball_contact(world, a, b, centres, radii, friction, bodies):
    between = [x - y for x, y in zip(centres[a], centres[b])]
    normal = rounded(unit(between))
    world.touch(bodies[a], bodies[b], [-radii[a] * n for n in normal], [radii[b] * n for n in normal], normal, friction)


def _pile(centres, radii, planes, friction, masses=None, speeds=None, near=1e-7):
    """Spheres with their contacts among each other and with planes n·x = offset, where they touch."""
    world = Space()
    bodies = []
    for k, radius in enumerate(radii):
        speed = falling()
        if speeds:
            speed = [a + b for a, b in zip(speed, speeds(k))]
        bodies.append(world.ball(radius, masses(k) if masses else 8 * radius ** 3, speed))
    for a, centre in enumerate(centres):
        for normal, offset in planes:
            if abs(dot(normal, centre) - offset - radii[a]) <= near:
                world.touch(bodies[a], None, [-radii[a] * n for n in normal], None, normal, friction)
        for b in range(a):
            reach = radii[a] + radii[b]
            if abs(centre[0] - centres[b][0]) <= reach + near and abs(_distance(centre, centres[b]) - reach) <= near:
                _ball_contact(world, a, b, centres, radii, friction, bodies)
    return world


FLOOR = [([0.0, 0.0, 1.0], 0.0)]


def crate(width):
    """The floor and four walls of a crate."""
    return FLOOR + [([1.0, 0.0, 0.0], 0.0), ([-1.0, 0.0, 0.0], -width), ([0.0, 1.0, 0.0], 0.0), ([0.0, -1.0, 0.0], -width)]


def _pyramid(layers):
    """Centres of spheres of radius 1/2 that lie in the hollows of the layer below."""
    return [[x + level / 2, y + level / 2, 0.5 + level * sqrt(0.5)]
            for level in range(layers) for x in range(layers - level) for y in range(layers - level)]


def _shake(seed, size):
    draw = Draw(seed)
    numbers = {}

    def speeds(k):
        if k not in numbers:
            numbers[k] = [size * draw.fraction() for _ in range(6)]
        return numbers[k]
    return speeds


def _pyramids():
    for layers in (2, 3, 5, 8):
        centres = _pyramid(layers)
        for name, friction, speeds in [("rest", 0.5, None), ("shaken", 0.25, _shake(layers, 0.5))]:
            world = _pile(centres, [0.5] * len(centres), FLOOR, friction, speeds=speeds)
            yield Posed("spheres", f"a pyramid of {len(centres)} spheres, {'at rest' if name == 'rest' else 'each with a velocity of its own'}",
                        world.problem(f"pyramid-{len(centres)}-{name}"))
    centres = _pyramid(3)
    for law, directions in [("associated", None), ("frictionless", None), ("polyhedral-coulomb", 4), ("polyhedral-associated", 4)]:
        world = _pile(centres, [0.5] * len(centres), FLOOR, 0.25, speeds=_shake(3, 0.5))
        yield Posed("spheres", f"the shaken pyramid of 14 spheres under the law {law}", world.problem(f"pyramid-14-{law}", law, directions))
    for friction in (0, 1, 2):
        world = _pile(centres, [0.5] * len(centres), FLOOR, friction, speeds=_shake(3, 0.5))
        yield Posed("spheres", f"the shaken pyramid of 14 spheres, μ = {friction}", world.problem(f"pyramid-14-mu-{friction}"))
    for exponent in (3, 6):
        for name, heavy in [("top", len(centres) - 1), ("bottom", 4)]:
            world = _pile(centres, [0.5] * len(centres), FLOOR, 0.5,
                          masses=lambda k, h=heavy, e=exponent: 10.0 ** e if k == h else 1.0)
            yield Posed("mass-ratio", f"a pyramid of 14 spheres, the one at the {name} 1e{exponent} times as heavy",
                        world.problem(f"pyramid-14-{name}-1e{exponent}"))


def _convex():
    """Pyramids of spheres of very different masses under laws of convex programs."""
    centres = _pyramid(3)
    for law in ("associated", "frictionless"):
        for exponent in (0, 3, 6):
            world = _pile(centres, [0.5] * len(centres), FLOOR, 0.5, masses=lambda k, e=exponent: 10.0 ** e if k == len(centres) - 1 else 1.0)
            yield Posed("convex", f"a pyramid of 14 spheres at rest, the top one 1e{exponent} times as heavy, under the law {law}",
                        world.problem(f"pyramid-14-rest-1e{exponent}-{law}", law))


def _crates():
    for width in (2, 4, 6):
        centres = [[x + 0.5, y + 0.5, z + 0.5] for z in range(width) for x in range(width) for y in range(width)]
        world = _pile(centres, [0.5] * len(centres), crate(width), 0.5, speeds=_shake(width, 0.125))
        yield Posed("jammed", f"{len(centres)} spheres that fill a crate, shaken", world.problem(f"crate-{len(centres)}"))


def _hard():
    """Pyramids and piles of spheres of very different masses, heaps of capsules: few solvers end."""
    for layers, exponent, law in [(4, 6, "coulomb"), (4, 6, "associated"), (5, 6, "associated"), (5, 0, "associated")]:
        centres = _pyramid(layers)
        world = _pile(centres, [0.5] * len(centres), FLOOR, 0.5, masses=lambda k, e=exponent, n=len(centres): 10.0 ** e if k == n - 1 else 1.0)
        yield Posed("hard", f"a pyramid of {len(centres)} spheres at rest, the top one 1e{exponent} times as heavy, under the law {law}",
                    world.problem(f"pyramid-{len(centres)}-top-1e{exponent}-{law}", law))
    centres, radii = deposit(60, 4, 60)
    world = _pile(centres, radii, crate(4), 0.3, masses=lambda k: 1.0, speeds=_shake(60, 0.25))
    yield Posed("hard", "60 spheres of one mass dropped into a crate, each with a velocity of its own, under the associated law",
                world.problem("pile-60-1e0-associated", "associated"))
    for side, layers, friction, size in [(3, 3, 0.5, 0.0), (6, 6, 0.3, 0.25), (4, 6, 0.5, 0.125)]:
        world = _logs(side, layers, friction, side + 1, size)
        yield Posed("hard", f"{side * layers} capsules in {layers} crossed layers, μ = {friction}, under the associated law",
                    world.problem(f"heap-{len(world.contacts)}-associated", "associated"))


def _determinant(a, b, c):
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


def _touching(radius, supports, start):
    """The centre of a sphere that touches three spheres (centre, radius) or planes (normal, offset), by Newton's method; or None."""
    x = list(start)
    for _ in range(12):
        rows, rests = [], []
        for kind, place, size in supports:
            if kind == "plane":
                rows.append(place)
                rests.append(dot(place, x) - size - radius)
            else:
                between = [p - q for p, q in zip(x, place)]
                length = sqrt(dot(between, between)) or 1.0
                rows.append([b / length for b in between])
                rests.append(length - size - radius)
        if max(map(abs, rests)) < 1e-13:
            return x
        whole = _determinant(*rows)
        if abs(whole) < 1e-6:
            return None
        columns = list(zip(*rows))
        for k in range(3):
            changed = [list(column) for column in columns]
            changed[k] = rests
            x[k] -= _determinant(*changed) / whole
    return None


def deposit(count, width, seed):
    """Spheres of radii 0.4 to 0.6 dropped one after the other into a crate: each lies on three supports, at the lowest place that a
    random column offers."""
    draw, centres, radii, walls = Draw(seed), [], [], crate(width)
    while len(centres) < count:
        radius = 0.4 + draw.whole(64) / 320
        best = None
        for _ in range(3):
            x, y = (radius + (width - 2 * radius) * (draw.fraction() + 1) / 2 for _ in range(2))
            nearby = sorted((k for k in range(len(centres)) if (centres[k][0] - x) ** 2 + (centres[k][1] - y) ** 2 < 1.44),
                            key=lambda k: -centres[k][2])[:7]
            top = max((centres[k][2] for k in nearby), default=0.0) + 1.0
            supports = [("ball", centres[k], radii[k]) for k in nearby]
            supports += [("plane", normal, offset) for normal, offset in walls if abs(dot(normal, [x, y, top]) - offset) < 1.2 or normal[2]]
            for i in range(len(supports)):
                for j in range(i):
                    for k in range(j):
                        place = _touching(radius, (supports[i], supports[j], supports[k]), [x, y, top])
                        if place and (best is None or place[2] < best[2]) and _is_free(place, radius, centres, radii, walls) \
                                and _is_held(place, (supports[i], supports[j], supports[k])):
                            best = place
            if best is None and not nearby:
                best = [x, y, radius]
        if best is not None:
            centres.append([round(c, 12) for c in best])
            radii.append(radius)
    return centres, radii


def _is_free(place, radius, centres, radii, walls):
    return all(dot(normal, place) - offset > radius - 1e-9 for normal, offset in walls) and \
        all(sum((p - q) ** 2 for p, q in zip(place, other)) > (radius + size - 1e-9) ** 2 for other, size in zip(centres, radii))


def _is_held(place, supports):
    """Whether the three normals can carry a weight."""
    normals = [s[1] if s[0] == "plane" else unit([p - q for p, q in zip(place, s[1])]) for s in supports]
    whole = _determinant(*zip(*normals))
    if abs(whole) < 1e-3:
        return False
    for k in range(3):
        columns = [list(n) for n in normals]
        columns[k] = [0.0, 0.0, 1.0]
        if _determinant(*zip(*columns)) / whole < 0:
            return False
    return True


def _deposits():
    for count, width, friction, shake in [(10, 3, 0.5, 0), (30, 3, 0.3, 0.25), (60, 4, 0.5, 0), (100, 4, 0.3, 0.25), (250, 6, 0.5, 0.25)]:
        centres, radii = deposit(count, width, count)
        speeds = _shake(count, shake) if shake else None
        world = _pile(centres, radii, crate(width), friction, speeds=speeds)
        how = "each with a velocity of its own" if shake else "at rest"
        yield Posed("spheres", f"{count} spheres of 0.4 to 0.6 m dropped into a crate, {how}, μ = {friction}", world.problem(f"pile-{count}"))
        if count in (30, 100):
            yield Posed("spheres", f"the pile of {count} spheres under the associated law", world.problem(f"pile-{count}-associated", "associated"))


def large():
    """The problem that is too large to be stored."""
    centres, radii = deposit(700, 8, 700)
    world = _pile(centres, radii, crate(8), 0.4, speeds=_shake(700, 0.25))
    yield Posed("spheres", "700 spheres of 0.4 to 0.6 m dropped into a crate, each with a velocity of its own, μ = 0.4", world.problem("pile-700"))


def _logs(side, layers, friction, seed, size):
    """Capsules in layers, those of a layer beside each other and across those of the layer below."""
    world, half, below = Space(), side * 0.5, []
    speeds = _shake(seed, size)
    for level in range(layers):
        row = []
        along = [1.0, 0.0, 0.0] if level % 2 else [0.0, 1.0, 0.0]
        across = [along[1], along[0], 0.0]
        for k in range(side):
            place = k - (side - 1) / 2
            third = 0.25 * 0.5 + half * half / 3
            inertia = [0.125 if axis else third for axis in along[:2]] + [third]
            speed = [a + b for a, b in zip(falling(), speeds(len(world.masses)))]
            body = world.body([1, 1, 1, *inertia], speed)
            if row:
                for end in (-0.75, 0.75):
                    arm = [end * half * a - 0.5 * c for a, c in zip(along, across)]
                    other = [end * half * a + 0.5 * c for a, c in zip(along, across)]
                    world.touch(body, row[-1][1], arm, other, across, friction)
            if not below:
                for end in (-0.75, 0.75):
                    world.touch(body, None, [end * half * along[0], end * half * along[1], -0.5], None, [0.0, 0.0, 1.0], friction)
            for other_place, under in below:
                arm = [other_place * along[0], other_place * along[1], -0.5]
                other_arm = [place * across[0], place * across[1], 0.5]
                world.touch(body, under, arm, other_arm, [0.0, 0.0, 1.0], friction)
            row.append((place, body))
        below = row
    return world


def _capsules():
    for side, layers, friction, size in [(3, 3, 0.5, 0), (5, 8, 0.5, 0.125), (6, 6, 0.3, 0.25), (7, 5, 0.8, 0.125)]:
        world = _logs(side, layers, friction, side, size)
        yield Posed("capsules", f"{side * layers} capsules in {layers} crossed layers, μ = {friction}",
                    world.problem(f"capsules-{len(world.contacts)}"))
    world = _logs(5, 8, 0.5, 5, 0.125)
    yield Posed("capsules", "the heap of 40 capsules under the associated law", world.problem(f"capsules-{len(world.contacts)}-associated", "associated"))
    # a chain of capsules that lies on the floor, each on two points, and pushes the next at two points of its end
    for count in (10, 75):
        world, before = Space(), None
        for k in range(count):
            body = world.body([1, 1, 1, 0.125, 0.375, 0.375], [0.25 - k / count, 0.125 * (k % 2), falling()[2], 0, 0, 0])
            if before is not None:
                world.touch(body, before, [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0], 0.5)
            for end in (-0.5, 0.5):
                world.touch(body, None, [end, 0.0, -0.5], None, [0.0, 0.0, 1.0], 0.5)
            before = body
        yield Posed("capsules", f"a chain of {count} capsules on the floor that runs together", world.problem(f"chain-{len(world.contacts)}"))


def _disks():
    for layers, friction in [(3, 0.5), (6, 0.3), (12, 0.5)]:
        world = Plane()
        rows = []
        for level in range(layers):
            row = []
            for k in range(layers - level):
                body = world.disk(0.5, 1, [0.0625 * (k % 3 - 1), falling(size=3)[1], 0.0])
                if row:
                    world.touch(body, row[-1], [-0.5, 0.0], [0.5, 0.0], [1.0, 0.0], friction)
                if level == 0:
                    world.touch(body, None, [0.0, -0.5], None, [0.0, 1.0], friction)
                else:
                    for under, side in ((rows[-1][k], 0.5), (rows[-1][k + 1], -0.5)):
                        normal = rounded([side, sqrt(0.75)])
                        world.touch(body, under, [-0.5 * n for n in normal], [0.5 * n for n in normal], normal, friction)
                row.append(body)
            rows.append(row)
        yield Posed("plane", f"a triangle of {len(world.masses)} disks, μ = {friction}", world.problem(f"disks-{len(world.masses)}"))


def all_problems():
    """The problems, in order."""
    for family in (_pyramids, _convex, _crates, _deposits, _capsules, _disks, _hard):
        yield from family()
