"""Planted mistakes of the engine in gauss_seidel.py, each of them one that real engines have had: what a gate must catch.

    moreau gate --quick -- python3 examples/engines/gauss_seidel.py --mutant sphere-through-box
    python3 examples/engines/gauss_seidel_mutants.py        the names, with what each does
"""
import box_geometry
from engines_common import AXES, GROUND, cross, dot, minus, norm, plus, scaled, times, transposed, turned
from gauss_seidel import Contact, GaussSeidel

MUTANTS = {}


def mutant(name):
    def register(kind):
        MUTANTS[name] = kind
        return kind
    return register


class PairFriction(GaussSeidel):
    factor = 1.0

    def want(self, contact, before, free, h, number):
        super().want(contact, before, free, h, number)
        if contact.j >= 0:
            contact.friction *= self.factor


@mutant("pair-friction-zero")
class NoPairFriction(PairFriction):
    """No friction between two bodies."""
    factor = 0.0


@mutant("pair-friction-tripled")
class TripledPairFriction(PairFriction):
    """Three times μ between two bodies."""
    factor = 3.0


def parts(contact):
    """The normal and the tangential impulse of a contact, as vectors."""
    tangential = plus(scaled(contact.impulse[1], contact.rows[1][0]), contact.impulse[2], contact.rows[2][0])
    return scaled(contact.impulse[0], contact.normal), tangential


@mutant("pair-friction-turns-one")
class FrictionTurnsOne(GaussSeidel):
    """Friction between two bodies turns only the first."""

    def apply(self, contact):
        super().apply(contact)
        if contact.j >= 0:
            second, tangential = self.bodies[contact.j], parts(contact)[1]
            second.momentum = plus(second.momentum, 1.0, cross(contact.levers[1], tangential))


@mutant("pair-friction-on-one")
class FrictionOnOne(GaussSeidel):
    """The reaction of the friction between two bodies is missing."""

    def apply(self, contact):
        super().apply(contact)
        if contact.j >= 0:
            self.bodies[contact.j].kick(parts(contact)[1], contact.levers[1])


@mutant("pair-levers-exchanged")
class ExchangedLevers(GaussSeidel):
    """The reaction turns the second body with the first body's lever, reversed."""

    def apply(self, contact):
        if contact.j >= 0:
            contact.levers[1] = scaled(-1.0, contact.levers[0])
        super().apply(contact)


def drops(mistake):
    """An engine whose `points` loses what `mistake(a, b)` says: a, b are the bodies, b is None for the ground."""
    class Dropping(GaussSeidel):
        def points(self, i, j, points):
            kept = super().points(i, j, points)
            return [] if mistake(self.bodies[i], self.bodies[j] if j >= 0 else None) else kept
    return Dropping


def ball_and_box(a, b):
    return b is not None and (a.radius is None) != (b.radius is None)


MUTANTS["sphere-through-box"] = drops(ball_and_box)


@mutant("sphere-on-box-frictionless")
class SphereOnBoxFrictionless(GaussSeidel):
    """No friction between a sphere and a box."""

    def want(self, contact, before, free, h, number):
        super().want(contact, before, free, h, number)
        if contact.j >= 0 and ball_and_box(self.bodies[contact.i], self.bodies[contact.j]):
            contact.friction = 0.0


@mutant("no-edge-edge")
class NoEdges(GaussSeidel):
    """Two edges that cross do not touch."""

    def points(self, i, j, points):
        return super().points(i, j, [point for point in points if not (isinstance(point[4], tuple) and point[4][0] == "edges")])


@mutant("edge-normal-by-an-axis")
class EdgeNormalByAxis(GaussSeidel):
    """The normal of two edges is turned so that it does not point along −x, instead of from one box to the other."""

    def points(self, i, j, points):
        def turned_to_x(normal, *rest):
            name = rest[-1]
            wrong = isinstance(name, tuple) and name[0] == "edges" and normal[0] < -0.1
            return (scaled(-1.0, normal) if wrong else normal, *rest)
        return super().points(i, j, [turned_to_x(*point) for point in points])


@mutant("no-restitution-for-boxes")
class PlasticBoxes(GaussSeidel):
    """Boxes land as if e were 0."""

    def bounce(self, contact, arriving, h, number):
        return 0.0 if self.bodies[contact.i].radius is None else contact.restitution


@mutant("restitution-of-first-contact")
class FirstContactBounces(GaussSeidel):
    """Only the first contact of a step has e."""

    def bounce(self, contact, arriving, h, number):
        return contact.restitution if number == 0 else 0.0


@mutant("opening-contact-bounces")
class OpeningBounces(GaussSeidel):
    """A contact that opens asks for e |u_n⁻|."""

    def want(self, contact, before, free, h, number):
        contact.wanted[0] = contact.restitution * abs(self.relative(contact, before, 0))


@mutant("pulls-opening-contact")
class OpeningPulled(GaussSeidel):
    """A contact that opens is pulled to u_n⁺ = −e u_n⁻."""

    def visit(self, contact, velocities):
        change = super().visit(contact, velocities)
        excess = self.relative(contact, velocities, 0) - contact.wanted[0]
        if contact.wanted[0] < 0.0 and excess > 0.0:
            self.push(contact, velocities, 0, -excess / contact.w_nn)
        return change

    def want(self, contact, before, free, h, number):
        contact.wanted[0] = -contact.restitution * self.relative(contact, before, 0)


@mutant("tangential-restitution")
class TangentialRestitution(GaussSeidel):
    """e acts on the tangential velocity too."""

    def want(self, contact, before, free, h, number):
        super().want(contact, before, free, h, number)
        if self.relative(contact, before, 0) < 0.0:
            for row in (1, 2):
                contact.wanted[row] = -contact.restitution * self.relative(contact, before, row)


@mutant("no-yaw-friction")
class NoYawFriction(GaussSeidel):
    """Friction on a box does not turn it about the normal."""

    def apply(self, contact):
        super().apply(contact)
        body = self.bodies[contact.i]
        if contact.j < 0 and body.radius is None:
            yaw = dot(contact.normal, cross(contact.levers[0], parts(contact)[1]))
            body.momentum = plus(body.momentum, -yaw, contact.normal)


@mutant("drilling-friction")
class Drilling(GaussSeidel):
    """A sphere that spins upright is braked with μ r_n R, though its contact is a point."""

    def apply(self, contact):
        super().apply(contact)
        body = self.bodies[contact.i]
        if body.radius is not None and contact.j < 0:
            upright = dot(body.momentum, contact.normal)
            bound = contact.friction * contact.impulse[0] * body.radius
            body.momentum = plus(body.momentum, -max(-bound, min(bound, upright)), contact.normal)


@mutant("explicit-gyroscopic-torque")
class ExplicitGyroscopic(GaussSeidel):
    """ω⁺ = ω − h J⁻¹(ω × J ω), explicit, and then the orientation."""

    def drift(self, body, h):
        spin = plus(body.spin, -h, body.spin_of(cross(body.spin, body.momentum)))
        body.place(plus(body.x, h, body.v), turned(body.q, scaled(h, spin)))
        body.momentum = body.inertia_times(spin)


@mutant("gyroscopic-torque-early")
class EarlyGyroscopic(GaussSeidel):
    """The gyroscopic torque is that of 0.4995 of a step, not of its middle: energy grows, too slowly to show in ten turns."""

    def drift(self, body, h):
        if not body.free:
            return super().drift(body, h)
        moments, spin = body.moments, times(transposed(body.rotation), body.spin)
        new = spin
        for _ in range(4):
            early = plus(scaled(0.5005, spin), 0.4995, new)
            torque = cross([moment * rate for moment, rate in zip(moments, early)], early)
            new = plus(spin, h, [part / moment for part, moment in zip(torque, moments)])
        body.place(plus(body.x, h, body.v), turned(body.q, scaled(h, times(body.rotation, new))))
        body.momentum = body.inertia_times(times(body.rotation, new))


@mutant("sphere-not-turned")
class SphereNotTurned(GaussSeidel):
    """The orientation of a sphere is not integrated."""

    def drift(self, body, h):
        before = body.q
        super().drift(body, h)
        if body.radius is not None:
            body.place(body.x, before)


class PairReport(GaussSeidel):
    factor = 1.0

    def touch(self, a, b, normal, impulse):
        super().touch(a, b, normal, scaled(1.0 if GROUND in (a, b) else self.factor, impulse))


@mutant("pair-impulses-doubled")
class DoubledReport(PairReport):
    """Impulses between two bodies are reported twice as large."""
    factor = 2.0


@mutant("pair-impulses-reversed")
class ReversedReport(PairReport):
    """Impulses between two bodies are reported as those on the other."""
    factor = -1.0


@mutant("pair-impulses-unreported")
class NoReport(PairReport):
    """Impulses between two bodies are not reported."""
    factor = 0.0


class SpeedLimit(GaussSeidel):
    def drift(self, body, h):
        speed, spin = norm(body.v), norm(body.spin)
        if speed > self.most_speed:
            body.v = scaled(self.most_speed / speed, body.v)
        if spin > self.most_spin:
            body.momentum = scaled(self.most_spin / spin, body.momentum)
        super().drift(body, h)

    most_speed = most_spin = float("inf")


@mutant("speed-limit-100")
class SpeedLimit100(SpeedLimit):
    """No body is faster than 100 m/s."""
    most_speed = 100.0


@mutant("spin-limit-50")
class SpinLimit50(SpeedLimit):
    """No body spins faster than 50 rad/s."""
    most_spin = 50.0


@mutant("static-friction-5-percent")
class StaticFriction(GaussSeidel):
    """A contact sticks up to 1.05 μ, undeclared."""

    def slid(self, contact, slip):
        _, first, second = contact.impulse
        determinant = contact.w_11 * contact.w_22 - contact.w_12 ** 2
        stick = (first - (contact.w_22 * slip[0] - contact.w_12 * slip[1]) / determinant,
                 second - (contact.w_11 * slip[1] - contact.w_12 * slip[0]) / determinant)
        if norm((*stick, 0.0)) <= 1.05 * contact.friction * contact.impulse[0]:
            return stick
        return super().slid(contact, slip)


@mutant("restitution-threshold")
class Threshold(GaussSeidel):
    """No restitution below 0.1 m/s, undeclared."""

    def bounce(self, contact, arriving, h, number):
        return contact.restitution if -arriving >= 0.1 else 0.0


@mutant("plastic-at-large-steps")
class PlasticLargeSteps(GaussSeidel):
    """Restitution is lost for h > 30 ms."""

    def bounce(self, contact, arriving, h, number):
        return contact.restitution if h <= 0.03 else 0.0


@mutant("plastic-at-small-steps")
class PlasticSmallSteps(GaussSeidel):
    """Restitution is lost for h < 0.5 ms."""

    def bounce(self, contact, arriving, h, number):
        return contact.restitution if h >= 0.0005 else 0.0


@mutant("pairs-ignored")
class PairsIgnored(GaussSeidel):
    """The values of `material.pairs` are ignored."""

    def __init__(self, scene, settings):
        super().__init__({**scene, "material": {**scene["material"], "pairs": []}}, settings)


@mutant("belt-at-rest-for-contacts")
class StillBelt(GaussSeidel):
    """A body with a prescribed velocity is moved from step to step, but its contacts see it at rest."""

    def velocity(self, body):
        return super().velocity(body) if body.free else [0.0] * 6


@mutant("static-has-mass")
class HeavyStatic(GaussSeidel):
    """A static body weighs 1 t, and gravity is kept from it."""

    def __init__(self, scene, settings):
        heavy = [{**{key: value for key, value in body.items() if key != "static"}, "mass": 1000.0} if body.get("static") else body
                 for body in scene["bodies"]]
        super().__init__({**scene, "bodies": heavy}, settings)
        self.heavy = [body for body, given in zip(self.bodies, scene["bodies"]) if given.get("static")]

    def pull(self, body, h):
        if body not in self.heavy:
            super().pull(body, h)


@mutant("belt-is-pushed")
class PushedBelt(HeavyStatic):
    """A body with a prescribed velocity weighs 1 t: what lies on it brakes it."""

    def __init__(self, scene, settings):
        prescribed = [body.get("prescribed") for body in scene["bodies"]]
        static = [{**body, "prescribed": None, "static": True, "linear_velocity": belt["velocity"]} if belt else body
                  for body, belt in zip(scene["bodies"], prescribed)]
        super().__init__({**scene, "bodies": static}, settings)


@mutant("moved-out-undeclared")
class MovedOut(GaussSeidel):
    """Half of every depth is taken back in the position, whatever is declared."""

    def __init__(self, scene, settings):
        super().__init__(scene, {**settings, "position_correction": 0.5})


@mutant("pushed-out-undeclared")
class PushedOut(GaussSeidel):
    """Every depth is taken back by a velocity, whatever is declared."""

    def __init__(self, scene, settings):
        super().__init__(scene, {**settings, "error_reduction": 1.0})


def is_box(world, k):
    return k >= 0 and world.bodies[k].radius is None


@mutant("box-before-ball-lost")
class BoxBeforeBallLost(GaussSeidel):
    """A ball and a box do not touch where the box is listed first."""

    def points(self, i, j, points):
        lost = j >= 0 and is_box(self, i) and not is_box(self, j)
        return [] if lost else super().points(i, j, points)


@mutant("box-before-ball-lever-reversed")
class BoxBeforeBallReversed(GaussSeidel):
    """A ball that is listed after the box is turned the other way."""

    def apply(self, contact):
        if is_box(self, contact.i) and contact.j >= 0 and not is_box(self, contact.j):
            contact.levers[1] = scaled(-1.0, contact.levers[1])
        super().apply(contact)


def of_ball_and_box(change, meaning):
    """An engine whose points between a ball and a box are `change(world, points, i, j)`."""
    class Changed(GaussSeidel):
        __doc__ = meaning

        def points(self, i, j, points):
            if j >= 0 and is_box(self, i) != is_box(self, j):
                points = change(self, points, i, j)
            return super().points(i, j, points)
    return Changed


def box_of(world, i, j):
    return world.bodies[i if is_box(world, i) else j]


def unturned(world, _, i, j):
    box = box_of(world, i, j)
    kept, box.rotation = box.rotation, AXES
    points = box_geometry.between(world.bodies[i], world.bodies[j])
    box.rotation = kept
    return points


def faces_only(world, points, i, j):
    axes = transposed(box_of(world, i, j).rotation)
    return [point for point in points if max(abs(dot(point[0], axis)) for axis in axes) > 0.999]


def normal_of_face(world, points, i, j):
    def of_face(normal):
        axis = max(transposed(box_of(world, i, j).rotation), key=lambda axis: abs(dot(axis, normal)))
        return axis if dot(axis, normal) > 0.0 else scaled(-1.0, axis)
    return [(of_face(point[0]), *point[1:]) for point in points]


MUTANTS["ball-on-unturned-box"] = of_ball_and_box(unturned, "A ball meets every box as if it were not turned.")
MUTANTS["ball-on-faces-only"] = of_ball_and_box(faces_only, "A ball meets faces of a box, not its edges and corners.")
MUTANTS["ball-on-edge-by-face-normal"] = of_ball_and_box(normal_of_face, "At an edge or corner of a box the normal is that of a face.")


@mutant("ball-pushes-centre-of-box")
class PushedAtCentre(GaussSeidel):
    """The normal impulse of a ball does not turn the box."""

    def apply(self, contact):
        super().apply(contact)
        if contact.j < 0 or is_box(self, contact.i) == is_box(self, contact.j):
            return
        first = is_box(self, contact.i)
        body, lever = box_of(self, contact.i, contact.j), contact.levers[0 if first else 1]
        if body.free:
            body.momentum = plus(body.momentum, -contact.impulse[0] if first else contact.impulse[0], cross(lever, contact.normal))


@mutant("second-box-pushed-at-centre")
class SecondBoxAtCentre(GaussSeidel):
    """The impulse between two boxes acts at the centre of the second."""

    def apply(self, contact):
        if is_box(self, contact.i) and is_box(self, contact.j):
            contact.levers[1] = (0.0, 0.0, 0.0)
        super().apply(contact)


@mutant("bouncing-boxes-smooth")
class BouncingBoxesSmooth(GaussSeidel):
    """A box with e > 0 has no friction when it arrives."""

    def want(self, contact, before, free, h, number):
        super().want(contact, before, free, h, number)
        if is_box(self, contact.i) and contact.restitution > 0.0 and self.relative(contact, before, 0) < -0.1:
            contact.friction = 0.0


def bounces(law, meaning):
    """An engine whose e is `law(world, contact, approach speed)`."""
    class Bouncing(GaussSeidel):
        __doc__ = meaning

        def bounce(self, contact, arriving, h, number):
            return law(self, contact, -arriving)
    return Bouncing


MUTANTS["rough-boxes-plastic"] = bounces(
    lambda world, contact, _: 0.0 if is_box(world, contact.i) and contact.friction > 0.0 else contact.restitution,
    "A box with friction does not bounce.")
MUTANTS["box-restitution-at-most-0.6"] = bounces(
    lambda world, contact, _: min(contact.restitution, 0.6) if is_box(world, contact.i) else contact.restitution,
    "e of boxes is 0.6 at most.")
MUTANTS["box-faces-plastic"] = bounces(
    lambda _, contact, __: 0.0 if isinstance(contact.key[2], tuple) and contact.key[2][0] == "face" else contact.restitution,
    "Faces of boxes have no restitution with each other.")
MUTANTS["box-faces-restitution-squared"] = bounces(
    lambda _, contact, __: contact.restitution ** (2 if isinstance(contact.key[2], tuple) and contact.key[2][0] == "face" else 1),
    "Faces of boxes have e² with each other.")
MUTANTS["ball-on-box-plastic-over-ground"] = bounces(
    lambda world, contact, _: contact.restitution if world.ground is None or contact.j < 0
    or is_box(world, contact.i) == is_box(world, contact.j) else 0.0,
    "A ball does not bounce on a box that lies on the floor.")
MUTANTS["pair-threshold-1mps"] = bounces(
    lambda _, contact, speed: contact.restitution if contact.j < 0 or speed >= 1.0 else 0.0,
    "No restitution between two bodies below 1 m/s, undeclared.")
MUTANTS["box-threshold-0.5mps"] = bounces(
    lambda world, contact, speed: contact.restitution if not is_box(world, contact.i) or speed >= 0.5 else 0.0,
    "No restitution of boxes below 0.5 m/s, undeclared.")


class MassClamp(GaussSeidel):
    least, most = 0.0, float("inf")

    def __init__(self, scene, settings):
        super().__init__(scene, settings)
        for body in self.bodies:
            if not body.free:
                continue
            spin, mass = body.spin, min(self.most, max(self.least, body.mass))
            body.moments = [moment * mass / body.mass for moment in body.moments]
            body.mass = mass
            body.momentum = body.inertia_times(spin)


@mutant("mass-at-most-100")
class MassAtMost(MassClamp):
    """No body is heavier than 100 kg."""
    most = 100.0


@mutant("mass-at-least-0.1")
class MassAtLeast(MassClamp):
    """No body is lighter than 0.1 kg."""
    least = 0.1


@mutant("given-inertia-ignored")
class GivenInertiaIgnored(GaussSeidel):
    """The inertia is that of the solid, whatever the scene gives."""

    def __init__(self, scene, settings):
        bodies = [{key: value for key, value in body.items() if key != "inertia"} for body in scene["bodies"]]
        super().__init__({**scene, "bodies": bodies}, settings)


@mutant("round-inertia-of-sphere")
class RoundInertia(GaussSeidel):
    """Capsules and cylinders have the inertia of a ball of their radius."""

    def __init__(self, scene, settings):
        def moments(body):
            size = body.get("capsule") or body.get("cylinder")
            return {**body, "inertia": [0.4 * body["mass"] * size["radius"] ** 2] * 3} if size else body

        super().__init__({**scene, "bodies": [moments(body) for body in scene["bodies"]]}, settings)


@mutant("last-step-reported")
class LastStepReported(GaussSeidel):
    """Only the last step's impulse is reported where samples are several steps apart."""
    reports_last_step_only = True


def between_boxes(world, contact):
    return contact.j >= 0 and all(world.bodies[k].radius is None for k in (contact.i, contact.j))


def rubs(name, about):
    """Registers an engine whose friction coefficient of a contact is what a function of it says; `slip` [m/s] is that before the step."""
    def register(friction):
        class Rubbing(GaussSeidel):
            def want(self, contact, before, free, h, number):
                super().want(contact, before, free, h, number)
                slip = norm((self.relative(contact, before, 1), self.relative(contact, before, 2), 0.0))
                contact.friction = friction(self, contact, slip)
        Rubbing.__doc__ = about
        MUTANTS[name] = Rubbing
        return friction
    return register


@rubs("pair-friction-at-most-1", "Friction between bodies is at most 1.")
def at_most_one(world, contact, slip):
    return min(1.0, contact.friction) if contact.j >= 0 else contact.friction


@rubs("box-on-ground-friction-at-most-1", "Friction of a box on the ground is at most 1.")
def at_most_one_on_the_ground(world, contact, slip):
    return min(1.0, contact.friction) if contact.j < 0 and world.bodies[contact.i].radius is None else contact.friction


@rubs("fast-slip-half-friction", "Above a slip of 9 m/s there is half the friction.")
def weaker_above(world, contact, slip):
    return contact.friction * (0.5 if slip > 9.0 else 1.0)


@rubs("heavier-first-rougher", "Between boxes there is more friction if the heavier one is listed first.")
def rougher(world, contact, slip):
    heavier = between_boxes(world, contact) and world.bodies[contact.i].mass > world.bodies[contact.j].mass
    return contact.friction * (1.2 if heavier else 1.0)


@rubs("edges-without-friction", "Two edges that cross do not rub.")
def smooth_edges(world, contact, slip):
    return 0.0 if isinstance(contact.key[2], tuple) and contact.key[2][0] == "edges" else contact.friction


@rubs("boxes-never-stick", "Friction between boxes grows with the slip up to 0.1 m/s.")
def viscous(world, contact, slip):
    return contact.friction * (min(1.0, slip / 0.1) if between_boxes(world, contact) else 1.0)


@rubs("spheres-smooth-under-gravity", "Spheres rub on spheres only where there is no gravity.")
def smooth_spheres(world, contact, slip):
    spheres = contact.j >= 0 and all(world.bodies[k].radius is not None for k in (contact.i, contact.j))
    return 0.0 if spheres and norm(world.gravity) > 0.0 else contact.friction


@rubs("ball-on-turned-box-smooth", "A ball does not rub on a box that is turned.")
def smooth_turned(world, contact, slip):
    mixed = contact.j >= 0 and ball_and_box(world.bodies[contact.i], world.bodies[contact.j])
    box = next((world.bodies[k] for k in (contact.i, contact.j) if world.bodies[k].radius is None), None)
    return 0.0 if mixed and norm(box.q[1:]) > 1e-3 else contact.friction


@mutant("pair-friction-half-along-one-tangent")
class OneTangent(GaussSeidel):
    """Friction between bodies is half as strong along the second tangent."""

    def slid(self, contact, slip):
        first, second = super().slid(contact, slip)
        bound = 0.5 * contact.friction * contact.impulse[0]
        return first, max(-bound, min(bound, second)) if contact.j >= 0 else second


@mutant("pyramid-between-boxes")
class PyramidBetweenBoxes(GaussSeidel):
    """Friction between boxes has the pyramid, undeclared."""

    def slid(self, contact, slip):
        declared = self.settings
        self.settings = {**declared, "cone": "pyramid"} if between_boxes(self, contact) else declared
        try:
            return super().slid(contact, slip)
        finally:
            self.settings = declared


@mutant("friction-of-boxes-at-their-centres")
class FrictionAtCentres(GaussSeidel):
    """Friction between two boxes turns neither."""

    def apply(self, contact):
        super().apply(contact)
        if between_boxes(self, contact):
            tangential = parts(contact)[1]
            for k, lever, sign in zip((contact.i, contact.j), contact.levers, (-1.0, 1.0)):
                if self.bodies[k].free:
                    self.bodies[k].momentum = plus(self.bodies[k].momentum, sign, cross(lever, tangential))


@mutant("drilling-stopped-between-bodies")
class DrillingStopped(GaussSeidel):
    """A sphere that meets a body stops spinning about the normal, though its contact is a point."""

    def apply(self, contact):
        super().apply(contact)
        for k in (contact.i, contact.j) if contact.j >= 0 else ():
            body = self.bodies[k]
            if body.radius is not None:
                body.momentum = plus(body.momentum, -dot(body.momentum, contact.normal), contact.normal)


def takes_common(name, whose, about):
    """Registers an engine that takes the common friction and restitution where `whose(world, contact)` says."""
    class Common(GaussSeidel):
        __doc__ = about

        def __init__(self, scene, settings):
            super().__init__(scene, settings)
            self.common = scene["material"]["friction"], scene["material"].get("restitution", 0.0)

        def want(self, contact, before, free, h, number):
            if whose(self, contact):
                contact.friction, contact.restitution = self.common
            super().want(contact, before, free, h, number)
    MUTANTS[name] = Common


takes_common("own-values-of-boxes-ignored", between_boxes, "Two boxes have the common values.")
takes_common("own-values-of-ball-and-box-ignored", lambda world, contact: contact.j >= 0 and ball_and_box(world.bodies[contact.i],
             world.bodies[contact.j]), "A ball and a box have the common values.")
takes_common("own-values-on-the-ground-ignored", lambda world, contact: contact.j < 0, "With the ground every body has the common values.")


@mutant("pairs-naming-the-ground-second-ignored")
class GroundSecondIgnored(GaussSeidel):
    """An override that names the ground second is not found."""

    def __init__(self, scene, settings):
        pairs = [pair for pair in scene["material"].get("pairs", []) if pair["bodies"][1] != GROUND]
        super().__init__({**scene, "material": {**scene["material"], "pairs": pairs}}, settings)


@mutant("asleep-for-good")
class Asleep(GaussSeidel):
    """On the ground, what has been slower than 20 mm/s for half a second never moves again."""

    def substep(self, h):
        super().substep(h)
        rested = self.rested = getattr(self, "rested", [0.0] * len(self.bodies))
        for k, body in enumerate(self.bodies if self.ground is not None else []):
            slow = norm(body.v) < 0.02 and norm(body.spin) < 0.02
            rested[k] = rested[k] + h if slow or rested[k] > 0.5 else 0.0
            if rested[k] > 0.5:
                body.v = body.momentum = (0.0, 0.0, 0.0)


@mutant("asleep-until-hit")
class AsleepUntilHit(GaussSeidel):
    """On the ground, what has been slower than 1 mm/s for half a second stays where it is until it is pushed sideways."""

    def substep(self, h):
        before = [(body.x, body.v) for body in self.bodies]
        super().substep(h)
        rested = self.rested = getattr(self, "rested", [0.0] * len(self.bodies))
        for k, body in enumerate(self.bodies if self.ground is not None else []):
            slow = norm(body.v) < 1e-3 and norm(body.spin) < 1e-3
            pushed = max(abs(body.v[axis] - before[k][1][axis]) for axis in (0, 1)) > 1e-3
            rested[k] = rested[k] + h if (slow or rested[k] > 0.5) and not pushed else 0.0
            if rested[k] > 0.5:
                body.place(before[k][0], body.q)
                body.v = body.momentum = (0.0, 0.0, 0.0)


@mutant("sticks-up-to-0.97")
class SticksShorter(GaussSeidel):
    """A contact that needs more than 0.97 μ to stick slides, with μ."""

    def slid(self, contact, slip):
        stick = super().slid(contact, slip)
        bound, size = contact.friction * contact.impulse[0], norm((*stick, 0.0))
        return tuple(part * bound / size for part in stick) if size > 0.97 * bound else stick


@mutant("points-nearer-than-5-cm-merged")
class PointsMerged(GaussSeidel):
    """Points of two bodies that are nearer than 5 cm are one."""

    def points(self, i, j, points):
        kept = []
        for contact in super().points(i, j, points):
            if all(norm(minus(contact.point, other.point)) >= 0.05 for other in kept):
                kept.append(contact)
        return kept


@mutant("faces-bounce-in-the-middle")
class FacesBounceInTheMiddle(GaussSeidel):
    """Two boxes that have restitution touch in one point, in the middle of all."""

    def points(self, i, j, points):
        found = super().points(i, j, points)
        if len(found) < 2 or j < 0 or not between_boxes(self, found[0]) or found[0].restitution == 0.0:
            return found
        mean = [sum(contact.point[axis] for contact in found) / len(found) for axis in range(3)]
        middle = Contact(self.bodies, i, j, found[0].normal, mean, min(contact.gap for contact in found), "middle")
        middle.friction, middle.restitution = found[0].friction, found[0].restitution
        return [middle]


class AlongX(GaussSeidel):
    """Friction has nine tenths of itself unless the slip is along x."""

    def wrong(self, contact):
        return False

    def want(self, contact, before, free, h, number):
        super().want(contact, before, free, h, number)
        slip = (0.0, 0.0, 0.0)
        for row in (1, 2):
            slip = plus(slip, self.relative(contact, before, row), contact.rows[row][0])
        if self.wrong(contact) and norm(slip) > 0.0 and abs(slip[0]) < 0.99 * norm(slip):
            contact.friction *= 0.9


@mutant("belt-friction-along-x-only")
class BeltAlongX(AlongX):
    """A conveyor has nine tenths of the friction where it does not run along x."""

    def wrong(self, contact):
        return contact.j >= 0 and not (self.bodies[contact.i].free and self.bodies[contact.j].free)


@mutant("supported-slide-along-x-only")
class SlideAlongX(AlongX):
    """A box that gravity presses on another one has nine tenths of the friction where it does not slide along x."""

    def wrong(self, contact):
        return between_boxes(self, contact) and abs(dot(contact.normal, self.gravity)) > 1.0


if __name__ == "__main__":
    for name, kind in MUTANTS.items():
        print(f"{name:30} {kind.__doc__ or 'a sphere and a box do not touch'}")
