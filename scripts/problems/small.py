"""Problems of one to a few contacts with answers by hand: single contacts, rods of Painlevé, wedges, walls that close."""

from problems.mechanism import Plane, Points, Space, falling
from problems.posed import Posed


def _point(name, velocity, friction, about, impulse, law="coulomb", directions=None):
    """A point of 1 kg at one contact, W = 1: the law alone."""
    rows = len(velocity)
    world = Points(rows)
    body = world.body([1.0] * rows, velocity)
    axes = [[float(i == j) for j in range(rows)] for i in range(rows)]
    world.contact(body, None, [(axis, None) for axis in axes], friction)
    return Posed("single", about, world.problem(name, law, directions), closed=impulse,
                 closed_by="W = 1: the normal impulse is what stops the approach, friction is the rest of the velocity or μ times it")


def _singles():
    half = 0.5
    plane = [
        ("rest", [-1, 0], [1, 0], "arrives and does not slip"),
        ("stick", [-1, 0.25], [1, -0.25], "arrives and sticks"),
        ("slide", [-1, 2], [1, -0.5], "arrives and slides on"),
        ("edge", [-1, 0.5], [1, -0.5], "comes to rest with the impulse on the edge of the cone: stick and slide at once"),
        ("grazing", [0, 2], [0, 0], "slips along without approaching: neither open nor pressed"),
        ("apex", [0, 0], [0, 0], "neither moves nor is pressed: the apex of the cone"),
        ("open", [1, 2], [0, 0], "separates"),
    ]
    for name, velocity, impulse, about in plane:
        yield _point(f"single-{name}", velocity, half, f"a point of 1 kg {about}, μ = 1/2", impulse)
    space = [
        ("slide-3-4-5", [-1, 3, 4], half, [1, -0.3, -0.4], "slides along (3, 4)"),
        ("stick-3-4-5", [-10, 3, 4], half, [10, -3, -4], "comes to rest with the impulse on the edge of the cone"),
        ("smooth", [-1, 3, 4], 0, [1, 0, 0], "slides without friction under Coulomb's law, μ = 0"),
        ("rough", [-1, 3, 4], 2, [1, -1.2, -1.6], "slides with μ = 2"),
        ("apex-space", [0, 0, 0], 2, [0, 0, 0], "does nothing, μ = 2"),
        ("grazing-space", [0, 3, -4], half, [0, 0, 0], "slips along without approaching"),
    ]
    for name, velocity, friction, impulse, about in space:
        yield _point(f"single-{name}", velocity, friction, f"a point of 1 kg in space {about}", impulse)
    yield _point("single-normal", [-3], 0, "a point of 1 kg arrives on a line", [3], law="frictionless")
    yield _point("single-associated", [-1, 2], half, "a point of 1 kg slides and is lifted by the associated law, μ = 1/2",
                 [1.6, -0.8], law="associated")
    yield _point("single-associated-open", [1, 2], half, "the associated law, at the edge of the dual cone: no impulse",
                 [0, 0], law="associated")
    yield _point("single-square", [-1, 3, 0], half, "a point of 1 kg slides along a direction of a square cone", [1, -0.5, 0],
                 law="polyhedral-coulomb", directions=4)
    yield _point("single-octagon", [-1, 3, 4], half, "a point of 1 kg slides between two directions of an octagon", [],
                 law="polyhedral-coulomb", directions=8)
    yield _point("single-square-associated", [-1, 2, 0], half, "the associated law of a square cone", [1.6, -0.8, 0],
                 law="polyhedral-associated", directions=4)


def _ball(name, velocity, friction, impulse, about):
    world = Space()
    body = world.ball(0.125, 1, velocity)
    world.touch(body, None, [0, 0, -0.125], None, [0, 0, 1], friction, frame=([1, 0, 0], [0, 1, 0]))
    return Posed("single", about, world.problem(name), closed=impulse,
                 closed_by="W = diag(1, 7/2, 7/2)/kg of a solid ball: no coupling of normal and tangent")


def _balls():
    yield _ball("ball-roll", [0.875, 0, -2, 0, 0, 0], 0.5, [2, -0.25, 0], "a ball lands, and friction makes it roll")
    yield _ball("ball-slide", [3, 4, -0.5, 0, 0, 0], 0.25, [0.5, -0.075, -0.1], "a ball lands and slides on along (3, 4)")
    yield _ball("ball-backspin", [1, 0, -0.5, 0, -16, 0], 0.125, [0.5, -0.0625, 0], "a ball lands with backspin and slides")


def _rod(world, friction, velocity):
    """A rod of 1 kg and length 2 m whose lower end, at (−3/5, −4/5) from its middle, touches the ground."""
    body = world.body([1, 1, 1 / 3], velocity)
    world.touch(body, None, [-0.6, -0.8], None, [0.0, 1.0], friction)


def _painleve():
    cases = [
        ("regular", 0.5, [-2, -1, 0], "arrives while it slides, μ = 1/2: W_nn > μ |W_nt|"),
        ("arrives", 2, [-2, -1, 0], "arrives while it slides, μ = 2 > W_nn/|W_nt|"),
        ("leaves", 2, [-2, 0.125, 0], "separates, μ = 2: it may as well be hit, Painlevé's several solutions"),
        ("grazing", 2, [-2, 0, 0], "neither approaches nor separates, μ = 2"),
        ("other-way", 2, [2, -1, 0], "arrives while it is pulled, μ = 2"),
        ("limit", 13 / 9, [-2, -1, 0], "arrives, and W_nn is μ |W_nt| up to rounding"),
    ]
    for name, friction, velocity, about in cases:
        world = Plane()
        _rod(world, friction, velocity)
        yield Posed("painleve", f"a rod at 53° on the ground {about}", world.problem(f"painleve-{name}"))
    world = Plane()
    for velocity in ([-2, 0.125, 0], [-4, 0.25, 0]):
        _rod(world, 2, velocity)
    yield Posed("painleve", "two rods that separate, each with several solutions, μ = 2", world.problem("painleve-two"))


def _wedges():
    for name, friction, shift, velocity, reason in [
        ("open", 0.7, -1, [0, 0], ""),
        ("jammed", 0.75, -1, [0, 0], "at μ = 3/4 friction takes back all that the normal impulses give, and both gaps are negative"),
        ("pressed", 0.75, 0, [0, -1], ""),
        ("pressed-smooth", 0, 0, [0.25, -1], ""),
        ("pressed-rough", 2, 0, [0.25, -1], ""),
    ]:
        world = Points(2)
        body = world.body([1, 1], velocity)
        for side in (1.0, -1.0):
            world.touch(body, [side, 0.75], friction, float(shift))
        about = f"a point in a wedge of slope 4/3, μ = {friction}" + (", which it is deep in" if shift else ", pressed down")
        yield Posed("jammed", about, world.problem(f"wedge-{name}"), no_solution=reason)


def _impossible():
    for rows, law in [(1, "frictionless"), (2, "coulomb")]:
        world = Points(rows)
        body = world.body([1] * rows, [0] * rows)
        for side in (1.0, -1.0):
            world.touch(body, [side] if rows == 1 else [0.0, side], 0 if rows == 1 else 0.5, -1.0)
        yield Posed("no-solution", "a point between two walls that both overlap it: infeasible, z = (1, 1) on the normals is a witness",
                    world.problem(f"walls-overlapping-{'line' if rows == 1 else 'plane'}", law),
                    no_solution="the two normal velocities add up to −2 m/s whatever the impulses are, and both should be ≥ 0")
    for name, velocity, shift, about in [
        ("deep", 0, -1, "overlaps by a step"),
        ("restitution", -1, -0.5, "arrives and shall bounce by Newton's law on the normal alone"),
    ]:
        world = Points(2)
        body = world.body([1], [velocity])
        world.contact(body, None, [([0.5], None), ([1.0], None)], 1, [float(shift), 0.0])
        yield Posed("no-solution", f"a slide on a rail oblique to its contact {about}, μ = 1: feasible, and no impulse solves it",
                    world.problem(f"rail-{name}"),
                    no_solution="to separate, friction must point against the motion, and takes back more than the normal impulse gives")
    world = Points(2)
    body = world.body([1], [-1])
    world.contact(body, None, [([0.5], None), ([1.0], None)], 1)
    yield Posed("jammed", "the same rail without overlap or restitution: sticking solves it", world.problem("rail-stuck"))


def _ladders():
    for name, friction, push in [("stands", 0.75, 0), ("slips", 0.25, 0), ("pushed", 0.5, 2), ("rough", 2, 0)]:
        world = Plane()
        body = world.body([1, 1, 1 / 3], [push, falling(size=3)[1], 0])
        world.touch(body, None, [-0.6, -0.8], None, [0.0, 1.0], friction)
        world.touch(body, None, [0.6, 0.8], None, [-1.0, 0.0], friction)
        yield Posed("plane", f"a ladder against a wall, μ = {friction}" + (", pushed towards it" if push else ""),
                    world.problem(f"ladder-{name}"))


def all_problems():
    """The problems, in order."""
    for family in (_singles, _balls, _painleve, _wedges, _impossible, _ladders):
        yield from family()
