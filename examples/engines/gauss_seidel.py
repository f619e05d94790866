#!/usr/bin/env python3
"""A rigid engine: Moreau's law at the level of velocities, solved by projected Gauss–Seidel sweeps, contact by contact.

    x_θ = x + (1−θ) h v ,    contacts at x_θ ,    v⁺ = v + h g + M⁻¹ Hᵀ r ,    x⁺ = x_θ + θ h v⁺
    0 ≤ r_n ⟂ u_n⁺ + e min(u_n⁻, 0) ≥ 0 ,    r_t = P(r_t − ρ u_t⁺) ,  P on the disc ‖r_t‖ ≤ μ r_n
    spheres, boxes, capsules, cylinders, a plane, static bodies and conveyors;  friction and restitution of every pair
    the state of rotation is the angular momentum

    moreau gate --quick -- python3 examples/engines/gauss_seidel.py
    moreau gate --quick -- python3 examples/engines/gauss_seidel.py --theta 1 --activation speculative --order shuffled
    moreau gate --quick -- python3 examples/engines/gauss_seidel.py --mutant sphere-through-box
"""
import math
import random
import sys

import box_geometry
from engines_common import GROUND, World, cross, dot, minus, plus, run, scaled, settings_of, tangents, turned

DEFAULTS = {
    "theta": 0.5,            # part of a step's way that is made after the contacts were found: ½ Moreau's midpoint, 1 symplectic Euler
    "activation": "gap",     # a contact acts if: gap, gap ≤ 0; predicted, gap + θ h u_n⁻ ≤ 0; speculative, gap < margin and u_n⁺ < −gap/h
    "margin": 0.02,          # [m] of the speculative rule
    "point": "first",        # where a contact's impulse acts: first, on the first body's surface; middle; second, as on the floor
    "cone": "cone",          # cone, or pyramid: |r_t1|, |r_t2| ≤ μ r_n along two fixed directions
    "order": "forward",      # of the contacts in a sweep: forward, reversed, shuffled
    "seed": 1,               # of the shuffle
    "substeps": 1,           # steps of h/n in each step of h
    "precision": "double",   # single: the state keeps 24 bits
    "accuracy": 1e-8,        # a sweep that changes no impulse by more than this part of the largest is the last
    "sweeps": 5000,          # most sweeps of a step; a box of 1 kg under one of 1000 kg needs some thousands
    "opening": "stop",       # a contact that was opening and is pressed: stop, u_n⁺ ≥ 0; newton, u_n⁺ ≥ −e u_n⁻ < 0
    "restitution_threshold": 0.0,  # [m/s] approach speed below which e is 0
    "error_reduction": 0.0,  # part of a depth that a step takes back by a velocity that the bodies keep
    "position_correction": 0.0,  # part of a depth that a step takes back by moving the bodies; their velocities stay
    "linear_damping": 0.0,   # [1/s]
    "angular_damping": 0.0,  # [1/s]
}
# What has a unit is declared as a parameter of the contact model: the gate asks the same question in other units, too.
UNITS = {"margin": "m", "restitution_threshold": "m/s", "error_reduction": "1", "position_correction": "1",
         "linear_damping": "1/s", "angular_damping": "1/s"}


def describe(settings):
    declared = {name: {"value": settings[name], "unit": unit} for name, unit in UNITS.items() if settings[name]}
    options = {name: value for name, value in settings.items() if name not in UNITS}
    return {"name": "gauss-seidel", "version": "1", "precision": settings["precision"], "restitution": True,
            "friction": settings["cone"], "reports_contacts": True, "levels": ["simulate"], "options": options,
            "bodies": ["free", "static", "prescribed"], "shapes": ["sphere", "box", "capsule", "cylinder"],
            "contact_model": {"kind": "rigid", "law": "coulomb", "parameters": declared}}


class Contact:
    """A point where two bodies touch, or one and the ground (j < 0); rows of H as (direction, lever × direction, J⁻¹ of that) per body."""

    def __init__(self, bodies, i, j, normal, point, gap, name):
        self.i, self.j, self.normal, self.point, self.gap, self.key = i, j, normal, point, gap, (i, j, name)
        self.levers = [minus(point, bodies[k].x) for k in (i, j) if k >= 0]
        self.rows = []
        for direction in (normal, *tangents(normal)):
            arms = [cross(lever, direction) for lever in self.levers]
            turns = [bodies[k].spin_of(arm) for k, arm in zip((i, j), arms)]
            self.rows.append((direction, arms, turns))
        inverse = [1.0 / bodies[k].mass for k in (i, j) if k >= 0]

        def delassus(p, q):
            turning = sum(dot(arm, turn) for arm, turn in zip(self.rows[p][1], self.rows[q][2]))
            return turning + (sum(inverse) if p == q else 0.0)

        self.w_nn, self.w_11, self.w_22, self.w_12 = delassus(0, 0), delassus(1, 1), delassus(2, 2), delassus(1, 2)
        self.step_t = 1.0 / (0.5 * (self.w_11 + self.w_22) + math.hypot(0.5 * (self.w_11 - self.w_22), self.w_12))
        self.impulse = [0.0, 0.0, 0.0]
        self.friction = self.restitution = 0.0
        self.wanted = [0.0, 0.0, 0.0]


class GaussSeidel(World):
    """The bodies in motion."""

    def __init__(self, scene, settings):
        super().__init__(scene, settings)
        self.last, self.random = {}, random.Random(settings["seed"])

    def step(self, h):
        count = int(self.settings["substeps"])
        for _ in range(count):
            self.substep(h / count)

    def substep(self, h):
        theta = self.settings["theta"]
        for body in self.bodies:
            self.drift(body, (1.0 - theta) * h)
        before = [self.velocity(body) for body in self.bodies]
        for body in self.bodies:
            self.pull(body, h)
        free = [self.velocity(body) for body in self.bodies]
        contacts = [contact for contact in self.found() if self.acts(contact, before, h)]
        for number, contact in enumerate(contacts):
            self.want(contact, before, free, h, number)
        self.solve(contacts, free)
        for contact in contacts:
            self.apply(contact)
        for body in self.bodies:
            self.drift(body, theta * h)
            if self.settings["precision"] == "single":
                body.rounded()
        if self.settings["position_correction"]:
            self.correct()

    def correct(self):
        """Move the bodies out of a part of every depth, contact by contact, each by what its normal impulse would move."""
        for contact in self.found():
            depth = -contact.gap
            if depth > 0.0:
                push = self.settings["position_correction"] * depth / contact.w_nn
                for body, arm, sign in ((contact.i, 0, push), (contact.j, 1, -push)):
                    if body >= 0:
                        moved = self.bodies[body]
                        turn = scaled(sign, contact.rows[0][2][arm])
                        moved.place(plus(moved.x, sign / moved.mass, contact.normal), turned(moved.q, turn))

    def drift(self, body, h):
        body.drift(h)

    def pull(self, body, h):
        """Gravity and declared damping."""
        if not body.free:
            return
        body.v = plus(scaled(1.0 - h * self.settings["linear_damping"], body.v), h, self.gravity)
        body.momentum = scaled(1.0 - h * self.settings["angular_damping"], body.momentum)

    def velocity(self, body):
        return [*body.v, *body.spin]

    def found(self):
        """Every point whose bodies are near enough to be asked about."""
        found = []
        for i, body in enumerate(self.bodies):
            if self.ground is not None and body.free:
                found += self.points(i, -1, box_geometry.with_plane(body, tuple(self.ground["normal"]), self.ground["offset"]))
            for j in (j for j in range(i + 1, len(self.bodies)) if body.free or self.bodies[j].free):
                found += self.points(i, j, box_geometry.between(body, self.bodies[j]))
        return found

    def points(self, i, j, points):
        place = {"first": 0.0, "middle": 0.5, "second": 1.0}[self.settings["point"]]
        contacts = []
        for normal, on_a, on_b, gap, name in points:
            if gap <= self.reach():
                contact = Contact(self.bodies, i, j, normal, plus(on_a, place, minus(on_b, on_a)), gap, name)
                pair = self.names(contact)
                contact.friction, contact.restitution = self.value(self.friction, *pair), self.value(self.restitution, *pair)
                contacts.append(contact)
        return contacts

    def reach(self):
        """Gap [m] beyond which no activation rule looks."""
        rule = self.settings["activation"]
        return {"gap": 0.0, "predicted": math.inf, "speculative": self.settings["margin"]}[rule]

    def names(self, contact):
        return self.bodies[contact.i].name, self.bodies[contact.j].name if contact.j >= 0 else GROUND

    def relative(self, contact, velocities, row):
        """u of one row: of the first body less that of the second."""
        direction, arms, _ = contact.rows[row]
        a = velocities[contact.i]
        u = dot(direction, a) + dot(arms[0], a[3:])
        if contact.j >= 0:
            b = velocities[contact.j]
            u -= dot(direction, b) + dot(arms[1], b[3:])
        return u

    def acts(self, contact, before, h):
        if self.settings["activation"] == "predicted":
            return contact.gap + self.settings["theta"] * h * min(0.0, self.relative(contact, before, 0)) <= 0.0
        return True

    def want(self, contact, before, free, h, number):
        """The normal velocity that the contact asks for at least."""
        arriving = self.relative(contact, before, 0)
        e = self.bounce(contact, arriving, h, number)
        wanted = -e * (min(arriving, 0.0) if self.settings["opening"] == "stop" else arriving)
        if contact.gap > 0.0 and self.settings["activation"] == "speculative":
            hits = contact.gap + h * self.relative(contact, free, 0) < 0.0
            wanted = wanted if hits and wanted > 0.0 else -contact.gap / h
        if contact.gap < 0.0 < self.settings["error_reduction"]:
            wanted = max(wanted, self.settings["error_reduction"] * -contact.gap / h)
        contact.wanted[0] = wanted

    def bounce(self, contact, arriving, h, number):
        """e of an impact with this approach speed."""
        return contact.restitution if abs(arriving) >= self.settings["restitution_threshold"] else 0.0

    def solve(self, contacts, velocities):
        """Sweeps over the contacts, from the impulses of the step before where a contact goes on."""
        for contact in contacts:
            old = self.last.get(contact.key, (0.0, 0.0, 0.0))
            for row in range(3):
                self.push(contact, velocities, row, old[row])
        order = contacts[::-1] if self.settings["order"] == "reversed" else list(contacts)
        for _ in range(int(self.settings["sweeps"])):
            if self.settings["order"] == "shuffled":
                self.random.shuffle(order)
            change = max((self.visit(contact, velocities) for contact in order), default=0.0)
            if change <= self.settings["accuracy"] * max((contact.impulse[0] for contact in contacts), default=0.0):
                break
        self.last = {contact.key: tuple(contact.impulse) for contact in contacts}

    def push(self, contact, velocities, row, impulse):
        """Add an impulse to one row and to the velocities of both bodies."""
        direction, _, turns = contact.rows[row]
        contact.impulse[row] += impulse
        for body, turn, sign in ((contact.i, 0, impulse), (contact.j, 1, -impulse)):
            if body >= 0:
                velocity, s, turning = velocities[body], sign / self.bodies[body].mass, turns[turn]
                velocity[0] += s * direction[0]
                velocity[1] += s * direction[1]
                velocity[2] += s * direction[2]
                velocity[3] += sign * turning[0]
                velocity[4] += sign * turning[1]
                velocity[5] += sign * turning[2]

    def visit(self, contact, velocities):
        """One contact's own problem: normal, then friction; gives back the largest change of an impulse."""
        r = contact.impulse
        normal = max(0.0, r[0] - (self.relative(contact, velocities, 0) - contact.wanted[0]) / contact.w_nn)
        change = abs(normal - r[0])
        self.push(contact, velocities, 0, normal - r[0])
        if contact.friction > 0.0:
            new = self.slid(contact, [self.relative(contact, velocities, row) - contact.wanted[row] for row in (1, 2)])
            for row in (1, 2):
                change = max(change, abs(new[row - 1] - r[row]))
                self.push(contact, velocities, row, new[row - 1] - r[row])
        return change

    def slid(self, contact, slip):
        """Friction: what stops the slip if the cone holds it, otherwise the projection on the cone."""
        _, first, second = contact.impulse
        determinant = contact.w_11 * contact.w_22 - contact.w_12 ** 2
        stick = (first - (contact.w_22 * slip[0] - contact.w_12 * slip[1]) / determinant,
                 second - (contact.w_11 * slip[1] - contact.w_12 * slip[0]) / determinant)
        bound = contact.friction * contact.impulse[0]
        trial = (first - contact.step_t * slip[0], second - contact.step_t * slip[1])
        if self.settings["cone"] == "pyramid":
            inside = max(abs(stick[0]), abs(stick[1])) <= bound
            return stick if inside else tuple(max(-bound, min(bound, part)) for part in trial)
        if math.hypot(*stick) <= bound:
            return stick
        size = math.hypot(*trial)
        return trial if size <= bound else (trial[0] * bound / size, trial[1] * bound / size)

    def apply(self, contact):
        """Kick the bodies, equal and opposite at one point, and report it."""
        impulse = (0.0, 0.0, 0.0)
        for row in range(3):
            impulse = plus(impulse, contact.impulse[row], contact.rows[row][0])
        self.bodies[contact.i].kick(impulse, contact.levers[0])
        if contact.j >= 0:
            self.bodies[contact.j].kick(scaled(-1.0, impulse), contact.levers[1])
        self.touch(*self.names(contact), contact.normal, impulse)


def main(arguments):
    world = GaussSeidel
    if "--mutant" in arguments:
        from gauss_seidel_mutants import MUTANTS
        at = arguments.index("--mutant")
        world = MUTANTS[arguments[at + 1]]
        arguments = arguments[:at] + arguments[at + 2:]
    run(describe, world, settings_of(arguments, DEFAULTS))


if __name__ == "__main__":
    main(sys.argv[1:])
