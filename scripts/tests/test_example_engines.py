"""The example engines against closed forms, and every planted mistake against the engine it is planted in; without the program."""

import itertools
import json
import math
import random
import subprocess
import sys
import unittest
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "engines"
sys.path.insert(0, str(FOLDER))

import engines_common as common  # noqa: E402
import gauss_seidel  # noqa: E402
import gauss_seidel_mutants  # noqa: E402
import pyramid_lemke  # noqa: E402
import spring_damper  # noqa: E402
from engines_common import cross, dot, minus, norm, plus, scaled  # noqa: E402

FAMILY = json.loads((FOLDER / "family.json").read_text(encoding="utf-8"))["engines"]
FLOOR = {"normal": [0, 0, 1], "offset": 0}
HOLD = {"sphere": {"radius": 0.1}}


def body(name, shape, position, mass=1.0, **state):
    return {"name": name, **shape, "mass": mass, "position": position, **state}


def scene(bodies, friction=0.0, restitution=0.0, gravity=0.0, ground=None, pairs=()):
    return {"schema": "scene/1", "name": "test", "gravity": [0, 0, -gravity], "ground": ground, "duration": 1.0, "bodies": bodies,
            "material": {"friction": friction, "restitution": restitution, "pairs": list(pairs)}}


def moved(kind, what, h, steps, **settings):
    """The world after some steps, and every reported (a, b, normal, impulse)."""
    defaults = {gauss_seidel.GaussSeidel: gauss_seidel.DEFAULTS, spring_damper.SpringDamper: spring_damper.DEFAULTS,
                pyramid_lemke.Lemke: pyramid_lemke.DEFAULTS}
    base = next(values for engine, values in defaults.items() if issubclass(kind, engine))
    world, reports = kind(what, {**base, **settings}), []
    for step in range(1, steps + 1):
        world.touched = []
        world.step(h)
        reports += [(step, *contact) for contact in world.touched]
    return world, reports


def momenta(bodies):
    linear = angular = (0.0, 0.0, 0.0)
    for one in bodies:
        linear = plus(linear, one.mass, one.v)
        angular = plus(plus(angular, 1.0, one.momentum), one.mass, cross(one.x, one.v))
    return linear, angular


def oblique(friction, restitution=0.5):
    """Two solid spheres of 1 and 3 kg that touch and approach with u_n = −2 m/s and u_t = (1.5, −1) m/s."""
    first = body("a", HOLD, [0.2, 0, 0], linear_velocity=[-2, 1.5, -1])
    return scene([first, body("b", HOLD, [0, 0, 0], mass=3.0)], friction, restitution)


def box(half):
    return {"box": {"half_extents": half}}


def unmoved(name, **state):
    """A slab below the plane z = 0 that has no mass of its own."""
    return {"name": name, **box([5.0, 5.0, 0.5]), "position": [0, 0, -0.5], **state}


def quaternion(axis, angle):
    return [math.cos(angle / 2), *scaled(math.sin(angle / 2), axis)]


def crossed_bars(restitution):
    """Two bars on edge, their long axes x and y: the lower edge of the upper one meets the upper edge of the lower one."""
    quarter = math.pi / 4
    upper = body("upper", box([1, 0.1, 0.1]), [0.3, 0.2, 0.2 * math.sqrt(2) - 1e-9], orientation=quaternion((1, 0, 0), quarter),
                 linear_velocity=[0, 0, -1])
    lower = body("lower", box([0.1, 1, 0.1]), [0, 0, 0], mass=2.0, orientation=quaternion((0, 1, 0), quarter))
    return scene([upper, lower], 0.0, restitution)


class GaussSeidel(unittest.TestCase):
    def test_spheres_meet_obliquely_as_the_closed_form_says(self):
        for friction in (0.1, 2.0):
            before = gauss_seidel.GaussSeidel(oblique(friction), gauss_seidel.DEFAULTS)
            world, reports = moved(gauss_seidel.GaussSeidel, oblique(friction), 1e-9, 1)
            effective, slip = 0.75, math.hypot(1.5, 1.0)
            normal = 1.5 * 2.0 * effective
            tangential = min(friction * normal, 2.0 / 7.0 * effective * slip)
            impulse = reports[0][4]
            self.assertAlmostEqual(impulse[0], normal, places=6)
            self.assertAlmostEqual(math.hypot(impulse[1], impulse[2]), tangential, places=6)
            spin = tangential * 0.1 / (0.4 * 0.01)
            self.assertAlmostEqual(norm(world.bodies[0].spin), spin, places=5)
            self.assertAlmostEqual(norm(world.bodies[1].spin), spin / 3.0, places=5)
            for old, new in zip(momenta(before.bodies), momenta(world.bodies)):
                self.assertLess(norm(minus(new, old)), 1e-12)

    def test_crossed_bars_bounce_with_the_inverse_mass_at_their_edges(self):
        for e in (0.0, 0.5):
            _, reports = moved(gauss_seidel.GaussSeidel, crossed_bars(e), 1e-6, 1)
            # levers (−0.3, 0, ·) and (0, 0.2, ·) from the centres to the point (0, 0.2, ·), n = z; moments of the bars by hand
            (m, j), (mass, k) = (1.0, (1 + 0.01) / 3), (2.0, 2 * (1 + 0.01) / 3)
            inverse = 1 / m + 0.09 / j + 1 / mass + 0.04 / k
            self.assertEqual(len(reports), 1)
            self.assertAlmostEqual(reports[0][4][2], (1 + e) / inverse, places=6)

    def test_a_box_spun_flat_stops_when_the_moment_of_friction_says(self):
        half, spin, friction = (0.1, 0.2, 0.05), 5.0, 0.3
        what = scene([body("box", box(half), [0, 0, 0.05 - 1e-9], angular_velocity=[0, 0, spin])], friction, 0.0, 9.81, FLOOR)
        moment = (0.01 + 0.04) / 3
        time = moment * spin / (friction * 9.81 * math.hypot(half[0], half[1]))
        h = time / 200.5
        self.assertGreater(moved(gauss_seidel.GaussSeidel, what, h, 198)[0].bodies[0].spin[2], 0.0)
        self.assertAlmostEqual(moved(gauss_seidel.GaussSeidel, what, h, 202)[0].bodies[0].spin[2], 0.0, places=9)

    def test_a_free_box_keeps_its_angular_momentum_and_its_energy_to_second_order(self):
        what = scene([body("box", box([0.1, 0.2, 0.3]), [0, 0, 0], angular_velocity=[0.1, 5, 0.1])])
        change = []
        for steps in (100, 200):
            world, _ = moved(gauss_seidel.GaussSeidel, what, 2.0 / steps, steps)
            start = gauss_seidel.GaussSeidel(what, gauss_seidel.DEFAULTS).bodies[0]
            self.assertLess(norm(minus(world.bodies[0].momentum, start.momentum)), 1e-15)
            change.append(abs(dot(world.bodies[0].spin, world.bodies[0].momentum) - dot(start.spin, start.momentum)))
        self.assertLess(change[1], 0.3 * change[0])

    def test_edges_that_cross_and_faces_give_the_gap_of_the_motion(self):
        from box_geometry import between
        shift = 0.01
        bars = [common.Body(one) for one in crossed_bars(0.0)["bodies"]]
        bars[0].x = plus(bars[0].x, shift + 1e-9, (0.0, 0.0, 1.0))
        (normal, _, _, gap, _), = between(*bars)
        self.assertAlmostEqual(gap, shift, places=9)
        self.assertAlmostEqual(abs(normal[2]), 1.0, places=12)


class SpringDamper(unittest.TestCase):
    def test_an_undamped_ball_returns_with_its_speed_after_half_a_period(self):
        k, speed = 1e4, 0.5
        what = scene([body("ball", HOLD, [0, 0, 0.1], linear_velocity=[0, 0, -speed])], ground=FLOOR)
        tau = math.pi / math.sqrt(k) / 2000
        world, reports = moved(spring_damper.SpringDamper, what, tau, 2020, stiffness=k, damping=0.0, substep=1.0)
        self.assertAlmostEqual(world.bodies[0].v[2], speed, delta=2e-3 * speed)
        self.assertAlmostEqual(len(reports), 2000, delta=3)
        self.assertAlmostEqual(max(report[4][2] for report in reports) / tau, speed * math.sqrt(k), delta=1e-2)

    def test_a_damped_ball_returns_with_the_part_of_its_speed_that_the_law_gives(self):
        # δ'' = −k δ/m − c δ'/m until k δ + c δ' = 0:  e = exp(−β/ω (π − atan2(2βω, ω² − β²))),  β = c/2m,  ω² = k/m − β²
        k, c, speed = 1e5, 300.0, 2.0
        beta = c / 2
        omega = math.sqrt(k - beta * beta)
        expected = math.exp(-beta / omega * (math.pi - math.atan2(2 * beta * omega, omega * omega - beta * beta)))
        what = scene([body("ball", HOLD, [0, 0, 0.1], linear_velocity=[0, 0, -speed])], ground=FLOOR)
        for tau, allowed in ((2e-4, 0.02), (1e-5, 0.001)):
            world, _ = moved(spring_damper.SpringDamper, what, 0.02, 1, stiffness=k, damping=c, substep=tau)
            self.assertAlmostEqual(world.bodies[0].v[2] / speed, expected, delta=allowed)

    def test_it_keeps_both_momenta_when_spheres_and_boxes_meet(self):
        for what in (oblique(0.5, 0.0), crossed_bars(0.0)):
            before = spring_damper.SpringDamper(what, spring_damper.DEFAULTS)
            world, reports = moved(spring_damper.SpringDamper, what, 1e-3, 20)
            self.assertTrue(reports)
            for old, new in zip(momenta(before.bodies), momenta(world.bodies)):
                self.assertLess(norm(minus(new, old)), 1e-12)

    def test_friction_holds_without_creep_and_lets_go_beyond_the_cone(self):
        for factor, slides in ((0.98, False), (1.02, True)):
            angle = math.atan(0.5 * factor)
            normal = (math.sin(angle), 0.0, math.cos(angle))
            depth = 9.81 * math.cos(angle) / 4e5
            what = scene([body("box", box([0.1, 0.1, 0.05]), scaled(0.05 - depth, normal), orientation=quaternion((0, 1, 0), angle))],
                         0.5, 0.0, 9.81, {"normal": normal, "offset": 0})
            world, _ = moved(spring_damper.SpringDamper, what, 1e-2, 100)
            along = dot(world.bodies[0].v, (math.cos(angle), 0.0, -math.sin(angle)))
            expected = 9.81 * (math.sin(angle) - 0.5 * math.cos(angle)) if slides else 0.0
            self.assertAlmostEqual(along, expected, delta=0.02 if slides else 1e-6)


class Lemke(unittest.TestCase):
    def test_random_problems_are_solved(self):
        pick = random.Random(1)
        for size in itertools.chain.from_iterable([range(1, 9)] * 10):
            rows = [[pick.gauss(0, 1) for _ in range(size)] for _ in range(size)]
            a = [[dot_of(p, q) + (0.1 if i == j else 0.0) for j, q in enumerate(rows)] for i, p in enumerate(rows)]
            b = [pick.gauss(0, 1) for _ in range(size)]
            z = pyramid_lemke.lemke(a, b)
            w = [dot_of(row, z) + c for row, c in zip(a, b)]
            self.assertGreaterEqual(min(z), 0.0)
            self.assertGreater(min(w), -1e-9)
            self.assertLess(max(abs(x * y) for x, y in zip(w, z)), 1e-8)

    def test_a_box_slides_along_a_direction_of_the_pyramid_with_mu_g(self):
        what = scene([body("box", box([0.1, 0.1, 0.05]), [0, 0, 0.05], linear_velocity=[2, 0, 0])], 0.3, 0.0, 9.81, FLOOR)
        world, reports = moved(pyramid_lemke.Lemke, what, 1e-2, 20)
        self.assertAlmostEqual(world.bodies[0].v[0], 2 - 0.3 * 9.81 * 0.2, places=6)
        self.assertAlmostEqual(sum(report[4][2] for report in reports), 9.81 * 0.2, places=6)

    def test_it_refuses_what_it_cannot(self):
        two = scene([body("a", box([0.1] * 3), [0, 0, 0]), body("b", box([0.1] * 3), [1, 0, 0])])
        for what in (two, oblique(0.1, 0.5)):
            with self.assertRaises(pyramid_lemke.Unsupported):
                pyramid_lemke.Lemke(what, pyramid_lemke.DEFAULTS)


def dot_of(p, q):
    return sum(x * y for x, y in zip(p, q))


def ball_over_box(**state):
    plate = body("plate", box([0.5, 0.5, 0.1]), [0, 0, 0.1], mass=5.0)
    return [body("ball", HOLD, [0, 0, 0.3 - 1e-9], **state), plate]


def landing(turn):
    return body("box", box([0.1, 0.15, 0.2]), [0, 0, 0.2 if not turn else 0.28], orientation=quaternion((0.6, 0.8, 0), turn),
                linear_velocity=[0.3, 0, -1])


def on_a_box(velocity):
    """A heavy box on the floor with a box and a ball on it, and a box beside it, all moved but the first, which is turned."""
    base = body("base", box([0.5, 0.5, 0.1]), [0, 0, 0.1 - 1e-9], mass=50.0, orientation=quaternion((0, 0, 1), 0.3))
    upper = body("upper", box([0.1, 0.1, 0.05]), [0.2, 0, 0.25 - 2e-9], linear_velocity=velocity)
    ball = body("ball", HOLD, [-0.2, 0, 0.3 - 2e-9], linear_velocity=velocity)
    return [base, upper, ball, body("beside", box([0.1, 0.1, 0.05]), [3, 0, 0.05 - 1e-9], linear_velocity=velocity)]


OWN_PAIRS = [{"bodies": ["base", other], "friction": 1.2, "restitution": 0.0} for other in ("upper", "ball")]
def ball_at_box(place, outward, box_first=True, **of_box):
    """A ball that flies at a place of a box, and reaches it in the first step; both have friction and bounce."""
    start = plus(place, 0.1 - 1e-9, outward)
    ball = body("ball", HOLD, start, mass=0.01, linear_velocity=scaled(-1.0, outward), angular_velocity=[0, 3, 5])
    block = body("box", box([0.3, 0.4, 0.5]), [0, 0, 0], mass=400.0, **of_box)
    return scene([block, ball] if box_first else [ball, block], 0.2, 0.9)


def turned_away(place, outward, turn):
    """The same on a box that is turned."""
    matrix = common.matrix_of(quaternion(*turn))
    return ball_at_box(common.times(matrix, place), common.times(matrix, outward), orientation=quaternion(*turn))


def bars_across_x():
    """The crossed bars with x for −z: the upper one flies along x and is pushed back."""
    matrix, what = common.matrix_of(quaternion((0, 1, 0), -math.pi / 2)), crossed_bars(0.5)
    for one in what["bodies"]:
        one["position"] = common.times(matrix, one["position"])
        one["linear_velocity"] = common.times(matrix, one.get("linear_velocity", (0, 0, 0)))
        one["orientation"] = common.turned(one["orientation"], (0, -math.pi / 2, 0))
    return what


def faces(speed):
    """A box flies at another one, face on face."""
    flying = body("flying", box([0.2, 0.1, 0.1]), [-0.4 + 1e-9, 0.05, 0], linear_velocity=[speed, 0.1, 0])
    return scene([flying, body("box", box([0.2, 0.3, 0.3]), [0, 0, 0], inertia=[0.1, 0.1, 0.1])], 0.2, 0.9)


SPINNING_BALL = body("ball", HOLD, [0, 0, 0.1], linear_velocity=[0.5, 0, -1], angular_velocity=[0, 20, 10])
SPUN_FLAT = body("box", box([0.1, 0.2, 0.05]), [0, 0, 0.05 - 1e-9], angular_velocity=[0, 0, 5])
JUST_TOO_STEEP = {"normal": [math.sin(math.atan(0.51)), 0, math.cos(math.atan(0.51))], "offset": 0}
OTHER_PAIR = {"bodies": ["ball", "ground"], "friction": 0.1, "restitution": 0.2}
#: name → (scene, h, steps): one motion in which each mistake acts
WITNESSES = {
    "oblique": (oblique(0.1), 1e-3, 3),
    "ball on box": (scene(ball_over_box(linear_velocity=[1, 0, 0]), 0.5, 0.0, 9.81, FLOOR), 1e-3, 50),
    "crossed bars": (crossed_bars(0.5), 1e-3, 3),
    "box lands": (scene([landing(0.0)], 0.0, 0.5, 9.81, FLOOR), 1e-3, 200),
    "box lands tilted": (scene([landing(0.4)], 0.3, 0.5, 9.81, FLOOR), 1e-3, 600),
    "opening": (scene([body("ball", HOLD, [0, 0, 0.09], linear_velocity=[0, 0, 0.1])], 0.0, 0.5, 0.0, FLOOR), 1e-3, 3),
    "bouncing spin": (scene([SPINNING_BALL], 0.3, 0.5, 9.81, FLOOR), 1e-3, 50),
    "box spun flat": (scene([SPUN_FLAT], 0.3, 0.0, 9.81, FLOOR), 1e-3, 50),
    "tumbling": (scene([body("box", box([0.1, 0.2, 0.3]), [0, 0, 0], angular_velocity=[0.1, 5, 0.1])]), 1e-2, 100),
    "fast": (scene([body("ball", HOLD, [0, 0, 0], linear_velocity=[150, 0, 0], angular_velocity=[0, 0, 200])]), 1e-2, 3),
    "just too steep": (scene([body("box", box([0.1, 0.1, 0.02]), scaled(0.02 - 1e-9, JUST_TOO_STEEP["normal"]),
                                   orientation=quaternion((0, 1, 0), math.atan(0.51)))], 0.5, 0.0, 9.81, JUST_TOO_STEEP), 1e-2, 20),
    "slow impact": (scene([body("ball", HOLD, [0, 0, 0.1 + 1e-5], linear_velocity=[0, 0, -0.05])], 0.0, 0.5, 0.0, FLOOR), 1e-3, 5),
    "large step": (scene([body("ball", HOLD, [0, 0, 0.1], linear_velocity=[0, 0, -1])], 0.0, 0.5, 0.0, FLOOR), 1 / 30, 3),
    "small step": (scene([body("ball", HOLD, [0, 0, 0.1], linear_velocity=[0, 0, -1])], 0.0, 0.5, 0.0, FLOOR), 1e-4, 3),
    "cylinder falls": (scene([body("drum", {"cylinder": {"radius": 0.1, "half_height": 0.2}}, [0, 0, 0.21], orientation=[0.8, 0.6, 0, 0])],
                              0.3, 0.5, 9.81, FLOOR), 1e-3, 130),
    "on a belt": (scene([body("box", box([0.2, 0.2, 0.1]), [0, 0, 0.1]),
                         unmoved("belt", prescribed={"velocity": [1, 0, 0]})], 0.3, 0.0, 9.81), 1e-2, 5),
    "on a static box": (scene([body("ball", HOLD, [0, 0, 0.1], linear_velocity=[0, 0, -1]), unmoved("floor", static=True)],
                               0.3, 0.5), 1e-2, 3),
    "ball beside a box's centre": (ball_at_box((0.3, 0.1, 0.2), (1, 0, 0)), 1e-3, 3),
    "ball at a box's edge": (ball_at_box((0.3, 0.4, 0.2), (0.8, 0.6, 0)), 1e-3, 3),
    "ball at a turned box": (turned_away((0.3, 0.1, 0.2), (1, 0, 0), ((0.6, 0.8, 0), 0.7)), 1e-3, 3),
    "ball at a box over the floor": ({**ball_at_box((0.3, 0.1, 0.2), (1, 0, 0)), "ground": {**FLOOR, "offset": -0.5}}, 1e-3, 3),
    "faces": (faces(1.0), 1e-3, 3),
    "bars across x": (bars_across_x(), 1e-3, 3),
    "slow faces": (faces(0.3), 1e-3, 3),
    "pairs": (scene([SPINNING_BALL], 0.3, 0.5, 9.81, FLOOR, [OTHER_PAIR]), 1e-3, 5),
    "rough": (scene(on_a_box([8, 6, 0]), 1.5, 0.0, 9.81, FLOOR, OWN_PAIRS), 1e-3, 3),
    "slow slip": (scene(on_a_box([0.02, 0, 0]), 0.5, 0.0, 9.81, FLOOR), 1e-3, 3),
    "rough bars": ({**crossed_bars(0.5), "material": {"friction": 0.3, "restitution": 0.5}}, 1e-3, 3),
    "falling spheres": ({**oblique(0.1), "gravity": [0, 0, -9.81]}, 1e-3, 3),
    "on a belt across x": (scene([body("box", box([0.2, 0.2, 0.1]), [0, 0, 0.1]),
                                  unmoved("belt", prescribed={"velocity": [0.6, 0.8, 0]})], 0.3, 0.0, 9.81), 1e-2, 5),
    "small cube": (scene([body("cube", box([0.02, 0.02, 0.02]), [0, 0, 0.02 - 1e-9])], 0.3, 0.0, 9.81, FLOOR), 1e-3, 20),
    "just held": (scene([body("ball", HOLD, scaled(0.1 - 1e-9, JUST_TOO_STEEP["normal"]), inertia=[1, 1, 1])],
                        0.515, 0.0, 9.81, JUST_TOO_STEEP), 1e-3, 10),
    "left behind": (scene([body("ball", HOLD, [0, 0, 0.1]), {"name": "belt", "box": {"half_extents": [0.6, 0.5, 0.5]},
                           "position": [0, 0, -0.5], "prescribed": {"velocity": [1, 0, 0]}}], 0.0, 0.0, 9.81, {**FLOOR, "offset": -5}), 1e-2, 80),
    "visited": (scene([body("visitor", HOLD, [-0.8, 0, 0.1], linear_velocity=[1, 0, 0]), body("resting", HOLD, [0, 0, 0.1])],
                      0.0, 0.0, 9.81, FLOOR), 1e-2, 80),
}


def seen(kind, what, h, steps):
    world, reports = moved(kind, what, h, steps)
    states = [(one.x, one.q, one.v, one.momentum) for one in world.bodies]
    return states, [] if world.reports_last_step_only else reports


class Mutants(unittest.TestCase):
    def test_every_planted_mistake_changes_a_motion_or_a_report_in_which_it_acts(self):
        right = {name: seen(gauss_seidel.GaussSeidel, *witness) for name, witness in WITNESSES.items()}
        for name, kind in gauss_seidel_mutants.MUTANTS.items():
            with self.subTest(name):
                self.assertTrue(any(seen(kind, *WITNESSES[witness]) != right[witness] for witness in WITNESSES))


class Family(unittest.TestCase):
    def test_there_are_twenty_of_at_least_three_programs_with_different_names(self):
        self.assertGreaterEqual(len(FAMILY), 20)
        self.assertEqual(len({member["name"] for member in FAMILY}), len(FAMILY))
        self.assertGreaterEqual(len({member["command"][0] for member in FAMILY}), 3)

    def test_every_member_describes_itself_and_lands_a_ball(self):
        what = scene([body("ball", HOLD, [0, 0, 0.11], linear_velocity=[0, 0, -1])], 0.3, 0.0, 9.81, FLOOR)
        what["duration"] = 0.2
        lines = [{"request": "describe"}, {"request": "simulate", "scene": what, "time_step": 0.01, "sample_every": 5}]
        text = "".join(json.dumps({"protocol": "moreau-engine/1", "id": k, **line}) + "\n" for k, line in enumerate(lines))
        for member in FAMILY:
            with self.subTest(member["name"]):
                command = [sys.executable, *member["command"]]
                done = subprocess.run(command, cwd=FOLDER, input=text, capture_output=True, text=True, check=True)
                described, simulated = (json.loads(line)["result"] for line in done.stdout.splitlines())
                self.assertEqual(len(simulated["times"]), 5)
                self.assertIn(described["contact_model"]["kind"], ("rigid", "compliant"))
                # a spring without a damper throws the ball back: v²/2g = 51 mm above the 10 mm of the start
                returned = described["contact_model"]["parameters"].get("damping", {}).get("value") == 0.0
                self.assertLess(abs(simulated["bodies"][0]["position"][-1][2] - 0.1), 0.062 if returned else 0.021)


if __name__ == "__main__":
    unittest.main()
