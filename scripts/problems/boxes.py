"""Boxes: resting and sliding, towers, brick walls, arches, in the plane and in space."""

from problems.mechanism import Draw, Plane, Space, falling, unit
from problems.posed import Posed

BRICK = (0.25, 0.125, 0.125)  # half extents, m


def _corners(half):
    return [[sx * half[0], sy * half[1]] for sx in (-1.0, 1.0) for sy in (-1.0, 1.0)]


def _box_on_floor(name, velocity, friction, about, points=None, law="coulomb", directions=None):
    world = Space()
    half = (0.125, 0.125, 0.0625)
    body = world.box(half, 1, velocity)
    for x, y in points or _corners(half):
        world.touch(body, None, [x, y, -half[2]], None, [0.0, 0.0, 1.0], friction, frame=([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
    return Posed("boxes", about, world.problem(name, law, directions))


def _on_floor():
    fall = falling()[2]
    yield _box_on_floor("box-rest", [0, 0, fall, 0, 0, 0], 0.5, "a box at rest on its four corners")
    yield _box_on_floor("box-slide", [0.25, 0.125, fall, 0, 0, 0], 0.25, "a box that slides on its four corners")
    yield _box_on_floor("box-spin", [0, 0, fall, 0, 0, 2], 0.25, "a box that turns about the normal on its four corners")
    yield _box_on_floor("box-tilt", [0.5, 0, fall, 1, 2, 0], 0.5, "a box that lands turning")
    yield _box_on_floor("box-rough", [1, 0.5, -0.5, 0.5, -1, 3], 2, "a box that lands turning, μ = 2")
    yield _box_on_floor("box-smooth", [1, 0.5, -0.5, 0.5, -1, 3], 0, "a box that lands turning, μ = 0")
    yield _box_on_floor("box-associated", [0, 0, fall, 0, 0, 2], 0.25, "the turning box under the associated law", law="associated")
    yield _box_on_floor("box-frictionless", [0.5, 0, fall, 1, 2, 0], 0.5, "the landing box without friction", law="frictionless")
    yield _box_on_floor("box-square", [0.25, 0.125, fall, 0, 0, 1], 0.25, "the sliding box with a square cone",
                        law="polyhedral-coulomb", directions=4)
    yield _box_on_floor("box-octagon", [0.25, 0.125, fall, 0, 0, 1], 0.25, "the sliding box with an octagon",
                        law="polyhedral-coulomb", directions=8)
    yield _box_on_floor("box-octagon-associated", [0.25, 0.125, fall, 0, 0, 1], 0.25, "the sliding box with an octagon, associated",
                        law="polyhedral-associated", directions=8)
    grid = [[x / 32, y / 32] for x in range(-4, 5, 2) for y in range(-4, 5, 2)]
    yield _box_on_floor("box-25-points", [0.25, 0.125, fall, 0, 0, 1], 0.25, "a box on 25 points, 19 more than it needs", grid)
    fine = [[x / 72, y / 72] for x in range(-9, 10, 2) for y in range(-9, 10, 2)]
    yield _box_on_floor("box-100-points", [0, 0, fall, 0.5, 0, 1], 0.5, "a box on 100 points", fine)


def _planar():
    for points in (2, 3, 10, 60):
        for name, friction, velocity in [("rest", 0.5, [0, falling(size=3)[1], 0]), ("lands", 0.25, [1, -0.5, 0.5])]:
            world = Plane()
            body = world.box((1, 0.25), 1, velocity)
            for k in range(points):
                world.touch(body, None, [2 * k / (points - 1) - 1, -0.25], None, [0.0, 1.0], friction)
            yield Posed("plane", f"a beam on {points} points that {'rests' if name == 'rest' else 'lands sliding and turning'}",
                        world.problem(f"beam-{points}-{name}"))
    for boxes, friction, slide in [(2, 0.5, 0), (3, 0.25, 0.5), (5, 0.5, 0.25), (10, 0.5, 0), (30, 0.75, 0.125)]:
        yield Posed("plane", f"a tower of {boxes} planar boxes" + (" that is pushed" if slide else ""),
                    _planar_tower(boxes, friction, slide).problem(f"tower-plane-{boxes}"))
    world = _planar_tower(3, 0.25, 0.5)
    yield Posed("plane", "the pushed tower of 3 planar boxes under the associated law", world.problem("tower-plane-3-associated", "associated"))
    for walls, friction in [("slot", 0.5), ("slot-rough", 1.5)]:
        world = Plane()
        body = world.box((0.5, 0.5), 1, [0.25, -0.5, 0.125])
        for side in (1.0, -1.0):
            for height in (0.5, -0.5):
                world.touch(body, None, [-0.5 * side, height], None, [side, 0.0], friction)
        for x in (-0.5, 0.5):
            world.touch(body, None, [x, -0.5], None, [0.0, 1.0], friction)
        yield Posed("jammed", f"a planar box in a slot as wide as itself, μ = {friction}", world.problem(walls))


def _planar_tower(boxes, friction, slide):
    world = Plane()
    below = None
    for k in range(boxes):
        body = world.box((0.5, 0.25), 1, [slide * (k + 1) / boxes, falling(size=3)[1], 0])
        for x in (-0.5, 0.5):
            world.touch(body, below, [x, -0.25], [x, 0.25], [0.0, 1.0], friction)
        below = body
    return world


def _tower(levels, friction, masses=None, speeds=None, points=None):
    world, below, half = Space(), None, (0.5, 0.5, 0.25)
    for k in range(levels):
        mass = masses(k) if masses else 1.0
        speed = speeds(k) if speeds else falling()
        body = world.box(half, mass, speed)
        for x, y in points or _corners(half):
            world.touch(body, below, [x, y, -0.25], [x, y, 0.25], [0.0, 0.0, 1.0], friction, frame=([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
        below = body
    return world


def _towers():
    six = [[x, y] for x in (-0.5, 0.0, 0.5) for y in (-0.5, 0.5)]
    for levels in (2, 5, 10, 20, 50):
        yield Posed("towers", f"a tower of {levels} boxes on four corners each", _tower(levels, 0.5).problem(f"tower-{levels}"))
    yield Posed("towers", "a tower of 95 boxes on six points each, three more than each needs", _tower(95, 0.5, points=six).problem("tower-570"))

    def pushed(k):
        return [0.125 * (k + 1), 0.0625 * k, falling()[2], 0, 0, 0.25 * (k % 3)]

    for levels in (3, 10):
        yield Posed("towers", f"a tower of {levels} boxes that slides and turns, each box differently",
                    _tower(levels, 0.25, speeds=pushed).problem(f"tower-{levels}-pushed"))
        yield Posed("towers", f"the sliding tower of {levels} boxes under the associated law",
                    _tower(levels, 0.25, speeds=pushed).problem(f"tower-{levels}-associated", "associated"))
    for exponent in (3, 6):
        ratio = 10 ** exponent
        yield Posed("mass-ratio", f"four boxes, each upper one heavier, 1 to 1e{exponent}",
                    _tower(4, 0.5, lambda k, x=exponent: float(10 ** (x * k // 3))).problem(f"tower-heavy-above-1e{exponent}"))
        yield Posed("mass-ratio", f"four boxes, each upper one lighter, 1e{exponent} to 1, pushed",
                    _tower(4, 0.5, lambda k, x=exponent: float(10 ** (x * (3 - k) // 3)), pushed).problem(f"tower-light-above-1e{exponent}"))
        yield Posed("mass-ratio", f"ten boxes, light and heavy in turn, ratio 1e{exponent}",
                    _tower(10, 0.5, lambda k, x=ratio: 1.0 if k % 2 else float(x)).problem(f"tower-alternating-1e{exponent}"))


def _convex():
    """Towers and arches under laws of convex programs: one velocity, by a theorem, and slow for most solvers."""
    for law in ("associated", "frictionless"):
        for levels in (5, 8, 15):
            yield Posed("convex", f"the tower of {levels} boxes at rest under the law {law}", _tower(levels, 0.5).problem(f"tower-{levels}-rest-{law}", law))
        for exponent in (3, 6):
            ratio = 10.0 ** exponent
            yield Posed("convex", f"four boxes, each upper one heavier, 1 to 1e{exponent}, under the law {law}",
                        _tower(4, 0.5, lambda k, x=exponent: float(10 ** (x * k // 3))).problem(f"tower-heavy-above-1e{exponent}-{law}", law))
            yield Posed("convex", f"six boxes, light and heavy in turn, ratio 1e{exponent}, under the law {law}",
                        _tower(6, 0.5, lambda k, x=ratio: 1.0 if k % 2 else x).problem(f"tower-alternating-6-1e{exponent}-{law}", law))
    for boxes in (5, 10, 20):
        for law in ("associated", "frictionless"):
            yield Posed("convex", f"a tower of {boxes} planar boxes at rest under the law {law}",
                        _planar_tower(boxes, 0.5, 0).problem(f"tower-plane-{boxes}-rest-{law}", law))


def _hard():
    """Tall towers and towers of very different masses, at rest and pushed: few solvers end."""
    def alternating(exponent):
        return lambda k: 1.0 if k % 2 else 10.0 ** exponent

    def drift(k):
        return [0.0625 * (k % 3), 0.03125 * k, falling()[2], 0, 0, 0.125 * (k % 2)]

    for levels in (30, 40):
        yield Posed("hard", f"a tower of {levels} boxes at rest under the associated law", _tower(levels, 0.5).problem(f"tower-{levels}-rest-associated", "associated"))
    for levels, exponent, law in [(12, 6, "associated"), (20, 4, "coulomb"), (20, 4, "associated")]:
        yield Posed("hard", f"{levels} boxes, light and heavy in turn, ratio 1e{exponent}, that drift, under the law {law}",
                    _tower(levels, 0.3, alternating(exponent), drift).problem(f"tower-alternating-{levels}-1e{exponent}-drift-{law}", law))
    for levels, exponent in [(8, 6), (12, 6)]:
        for law in ("coulomb", "associated"):
            yield Posed("hard", f"{levels} boxes, each upper one heavier, 1 to 1e{exponent}, under the law {law}",
                        _tower(levels, 0.5, lambda k, n=levels, x=exponent: 10.0 ** (x * k // (n - 1))).problem(f"tower-heavy-above-{levels}-1e{exponent}-{law}", law))


def _wall(width, height, friction, push=0.0):
    """Bricks in running bond: each rests on four corners of what it shares with the one or two bricks below."""
    world, below = Space(), []
    a, b, c = BRICK
    for level in range(height):
        starts = [2 * a * k + (a if level % 2 else 0.0) for k in range(width - level % 2)]
        row = []
        for k, x in enumerate(starts):
            speed = falling()
            if push:
                speed[1] = push * (level + 1) / height * (1 if k % 2 else -0.5)
            body = world.box(BRICK, 1, speed)
            row.append((x, body))
            supports = [(None, x - a, x + a)] if level == 0 else \
                [(under, max(x, z) - a, min(x, z) + a) for z, under in below if abs(x - z) < 2 * a]
            for under, left, right in supports:
                centre = 0.0 if under is None else next(z for z, other in below if other == under)
                for px in (left, right):
                    for py in (-b, b):
                        world.touch(body, under, [px - x, py, -c], [px - centre, py, c], [0.0, 0.0, 1.0], friction,
                                    frame=([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
        below = row
    return world


def _walls():
    for width, height in [(3, 3), (5, 5), (8, 10), (12, 20)]:
        yield Posed("walls", f"a wall of bricks at rest, {width} wide and {height} high", _wall(width, height, 0.5).problem(f"wall-{width}x{height}"))
    for width, height in [(3, 3), (5, 5), (8, 10)]:
        yield Posed("walls", f"a wall of bricks, {width} wide and {height} high, pushed out of its plane",
                    _wall(width, height, 0.25, 1.0).problem(f"wall-{width}x{height}-pushed"))
    yield Posed("walls", "the pushed wall of 3 by 3 bricks under the associated law",
                _wall(3, 3, 0.25, 1.0).problem("wall-3x3-associated", "associated"))
    yield Posed("walls", "the pushed wall of 5 by 5 bricks under the associated law",
                _wall(5, 5, 0.25, 1.0).problem("wall-5x5-associated", "associated"))
    yield Posed("walls", "the pushed wall of 8 by 10 bricks under the associated law",
                _wall(8, 10, 0.25, 1.0).problem("wall-8x10-associated", "associated"))


def _uneven(seed, contacts, friction, slow, two):
    """A box that slides over points which are all but in a plane, all but facing up: heights and slopes of 1/4096."""
    draw, world, uneven = Draw(seed), Space(), 1 / 4096

    def speed():
        return [slow * draw.fraction(), slow * draw.fraction(), slow * draw.fraction() - 0.125] + [slow * draw.fraction() for _ in range(3)]

    body = world.box((0.5 + draw.whole(64) / 128, 0.5 + draw.whole(64) / 128, 0.5), 1 + draw.whole(15), speed())
    other = world.box((1.0, 1.0, 0.5), 1 + draw.whole(15), [slow * draw.fraction() for _ in range(6)]) if two else None
    for _ in range(contacts):
        x, y, height = draw.fraction(), draw.fraction(), uneven * draw.fraction()
        slope = [[0.0, 0.0], [uneven, 0.0], [0.0, uneven * draw.fraction()]][draw.whole(2)]
        world.touch(body, other, [x, y, height - 0.5], [x - 0.25, y - 0.125, height + 0.5] if two else None, unit([*slope, 1.0]), friction)
    return world


def _slides():
    """Which of the points press decides about a hundred millionth of the speed: methods that go by residuals do not tell."""
    for seed, contacts in [(408, 7), (9031, 8), (2885, 9), (2193, 10), (7063, 11), (3851, 12)]:
        friction, slow, two = (0.125, 0.25, 0.5)[seed // 9 % 3], (1 / 128, 1 / 32, 1 / 8)[seed // 27 % 3], seed // 81 % 2 == 1
        about = f"a box that slides on {contacts} points of {'another box' if two else 'the ground'} which are all but in a plane"
        yield Posed("uneven", about, _uneven(seed, contacts, friction, slow, two).problem(f"uneven-{contacts}"))


def _landed(seed, plates, friction, points):
    """Plates that have landed on each other slightly turned, each on points drawn in its lower side: the load wanders between them."""
    draw, world, below, thickness = Draw(seed), Space(), None, 1 / 32
    for _ in range(plates):
        mass = 1 + draw.whole(3)
        body = world.box((0.25, 0.25, thickness), mass, [v + draw.fraction() / 8 for v in falling()])
        slope = unit([draw.fraction() / 16, draw.fraction() / 16, 1.0])
        for _ in range(points):
            x, y = draw.fraction() / 4, draw.fraction() / 4
            world.touch(body, below, [x, y, -thickness], None if below is None else [x + 1 / 32, y - 1 / 64, thickness], slope, friction)
        below = body
    return world


def _wandering():
    """Which of a plate's points carries is told after a hundred thousand sweeps or steps, each of which hardly changes anything."""
    for seed, plates, friction, points in [(22, 5, 0.5, 4), (26, 5, 0.25, 4), (28, 8, 0.5, 4), (3, 4, 0.8, 6), (30, 8, 0.5, 4)]:
        about = f"{plates} plates that have landed on each other, {points} points each, μ = {friction}"
        yield Posed("landed", about, _landed(seed, plates, friction, points).problem(f"landed-{plates}-{seed}"))


def _directions(stones):
    """Unit vectors of the joints of an arch over about half a circle, from right to left."""
    m = 0.7854 * 2 / (2 * stones)
    c, s = (1 - m * m) / (1 + m * m), 2 * m / (1 + m * m)
    x, y, found = 1.0, 0.0, []
    for _ in range(2 * stones + 1):
        found.append((x, y))
        x, y = c * x - s * y, s * x + c * y
    return found[::2], found[1::2]


def _arches():
    for stones, friction, depth in [(3, 0.75, 0), (7, 0.75, 0), (15, 0.75, 0), (31, 1.0, 0), (7, 0.75, 1), (21, 0.75, 1)]:
        world = Space() if depth else Plane()
        joints, middles = _directions(stones)
        bodies = []
        for x, y in middles:
            if depth:
                bodies.append(world.body([1, 1, 1, 0.0625, 0.0625, 0.0625], falling()))
            else:
                bodies.append(world.body([1, 1, 0.0625], falling(size=3)))
        for k, (x, y) in enumerate(joints):
            # the stone after the joint is pushed onwards, in the sense of growing angle; the last joint is with the ground, turned round
            body, other, sense = (bodies[k], bodies[k - 1] if k else None, 1.0) if k < stones else (bodies[-1], None, -1.0)
            for radius in (0.875, 1.125):
                own = middles[k if k < stones else -1]
                arm = [radius * x - own[0], radius * y - own[1]]
                under = middles[k - 1]
                other_arm = [radius * x - under[0], radius * y - under[1]]
                if depth:
                    for z in (-0.25, 0.25):
                        world.touch(body, other, [arm[0], z, arm[1]], [other_arm[0], z, other_arm[1]], [-sense * y, 0.0, sense * x], friction)
                else:
                    world.touch(body, other, arm, other_arm, [-sense * y, sense * x], friction)
        name = f"arch-{'space' if depth else 'plane'}-{stones}"
        yield Posed("arches", f"an arch of {stones} stones, {'four' if depth else 'two'} points a joint, μ = {friction}", world.problem(name))


def _tables():
    draw = Draw(5)
    for legs in (3, 8, 40):
        world = Space()
        body = world.box((1, 1, 0.125), 1, [0.0625, 0, falling()[2], 0, 0, 0.125])
        for _ in range(legs):
            world.touch(body, None, [draw.fraction(), draw.fraction(), -1.0], None, [0.0, 0.0, 1.0], 0.5,
                        frame=([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
        yield Posed("redundant", f"a table on {legs} legs, drawn at random", world.problem(f"table-{legs}"))


def all_problems():
    """The problems, in order."""
    for family in (_on_floor, _planar, _towers, _convex, _walls, _arches, _tables, _hard, _slides, _wandering):
        yield from family()


def large():
    """Walls that are too large to be stored."""
    for name, push in [("wall-36x36", 0.0), ("wall-36x36-pushed", 1.0)]:
        about = "a wall of bricks, 36 wide and 36 high, " + ("pushed out of its plane" if push else "at rest")
        yield Posed("walls", about, _wall(36, 36, 0.25 if push else 0.5, push).problem(name))
