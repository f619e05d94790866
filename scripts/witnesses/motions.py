"""Steps and flights: a ball above a floor, methods on a polynomial motion, the times of impacts."""

from fractions import Fraction
from math import factorial

from .judgement import count, demand, only
from .matrices import fraction, matrix, vector

SHIFTS = {
    "moreau-jean A": lambda e, q, v, h, free: e * v if q <= 0 else None,
    "moreau-jean B": lambda e, q, v, h, free: e * v if q + h * v / 2 <= 0 else None,
    "moreau-jean D": lambda e, q, v, h, free: e * v if q + h * free <= 0 else None,
    "generalised-alpha": lambda e, q, v, h, free: e * v if q + h * (v + free) / 2 <= 0 else None,
    "stewart-trinkle": lambda e, q, v, h, free: q / h,
    "schatzman-paoli": lambda e, q, v, h, free: (1 + e) * q / h - e * v,
}


def ball_step(one: dict) -> None:
    """A step of a ball above a floor: m (v⁺ − v) = −m g h + r, 0 ≤ r ⟂ v⁺ + s ≥ 0, q⁺ = q + h (θ v⁺ + (1 − θ) v)."""
    mass, gravity, restitution, q, v, theta, h = vector(one["data"])
    impulse, position, velocity = vector(one["answer"])
    demand(mass > 0 and h > 0, "the mass and the step are not positive")
    free = v - gravity * h
    shift = SHIFTS[one["scheme"]](restitution, q, v, h, free)
    demand(velocity == free + impulse / mass, "v⁺ is not v − g h + r/m")
    demand(position == q + h * (theta * velocity + (1 - theta) * v), "q⁺ is another one")
    if shift is None:
        demand(impulse == 0, "an impulse without contact")
    else:
        demand(impulse >= 0 and velocity + shift >= 0 and impulse * (velocity + shift) == 0, "r and v⁺ + s are not complementary")


def impact_time(one: dict) -> None:
    """t_k/t₁ of a dropped ball, 1 + 2(e + … + e^{k−1}): by the sum of the geometric series, (1 − e) t_k/t₁ = 1 + e − 2eᵏ."""
    only(one, "restitution", "impact", "value")
    e, k, time = fraction(one["restitution"]), count(one, "impact", 1, 100_000), fraction(one["value"])
    demand(e >= 0, "the restitution is negative")
    found = Fraction(2 * k - 1) if e == 1 else (1 + e - 2 * e**k) / (1 - e)
    demand(time == found, "the impact comes at another time")


def motion_step(one: dict) -> None:
    """What a method makes of states (q, v) in a step h of q̇ = v, v̇ = Σ c qᵃ vᵇ, by what defines the method."""
    only(one, "method", "terms", "step", "before", "after")
    h, terms = fraction(one["step"]), [term(row) for row in matrix(one["terms"])]
    before, after = matrix(one["before"]), matrix(one["after"])
    demand(len(before) == len(after) > 0 and all(len(state) == 2 for state in before + after), "a state is no pair, or has none after it")
    demand(h != 0 and one["method"] in METHODS, "there is no step, or no such method")
    for now, then in zip(before, after):
        METHODS[one["method"]](terms, h, *now, *then)


def term(row: list) -> tuple[Fraction, int, int]:
    """A coefficient and two powers."""
    demand(len(row) == 3 and all(power.denominator == 1 and 0 <= power <= 9 for power in row[1:]), "a term is no coefficient with two powers")
    return row[0], int(row[1]), int(row[2])


def acceleration(terms: list, q: Fraction, v: Fraction) -> Fraction:
    """a(q, v)."""
    return sum((c * q**a * v**b for c, a, b in terms), Fraction(0))


def affine(terms: list) -> tuple[Fraction, Fraction, Fraction]:
    """The coefficients of 1, q and v, if there is no other term."""
    parts = {(0, 0): Fraction(0), (1, 0): Fraction(0), (0, 1): Fraction(0)}
    for c, a, b in terms:
        demand((a, b) in parts, "the acceleration is not affine: this script cannot decide it")
        parts[a, b] += c
    return parts[0, 0], parts[1, 0], parts[0, 1]


def explicit_euler(terms: list, h: Fraction, q: Fraction, v: Fraction, q1: Fraction, v1: Fraction) -> None:
    """Difference quotients are the old velocity and acceleration."""
    demand((q1 - q) / h == v and (v1 - v) / h == acceleration(terms, q, v), "it is no step of explicit Euler")


def semi_implicit_euler(terms: list, h: Fraction, q: Fraction, v: Fraction, q1: Fraction, v1: Fraction) -> None:
    """Difference quotients are the new velocity and the old acceleration."""
    demand((q1 - q) / h == v1 and (v1 - v) / h == acceleration(terms, q, v), "it is no step of semi-implicit Euler")


def verlet(terms: list, h: Fraction, q: Fraction, v: Fraction, q1: Fraction, v1: Fraction) -> None:
    """The position by Taylor, the velocity by the trapezoidal rule."""
    demand(all(b == 0 for _, _, b in terms), "the acceleration depends on the velocity")
    old, new = acceleration(terms, q, v), acceleration(terms, q1, v1)
    demand(q1 == q + h * v + h * h * old / 2 and v1 == v + h * (old + new) / 2, "it is no step of Verlet")


def runge_kutta(terms: list, h: Fraction, q: Fraction, v: Fraction, q1: Fraction, v1: Fraction) -> None:
    """Of an affine motion, the conditions of order four leave Taylor's polynomial of degree four and nothing else."""
    constant, of_place, of_speed = affine(terms)
    derivatives = [(v, constant + of_place * q + of_speed * v)]
    for _ in range(3):
        speed, rate = derivatives[-1]
        derivatives.append((rate, of_place * speed + of_speed * rate))
    taylor = [start + sum(h**k / factorial(k) * each[i] for k, each in enumerate(derivatives, 1)) for i, start in enumerate((q, v))]
    demand([q1, v1] == taylor, "it is no step of the Runge-Kutta method of order four")


def flight(terms: list, h: Fraction, q: Fraction, v: Fraction, q1: Fraction, v1: Fraction) -> None:
    """Constant acceleration for a time h: by the change of the velocity, and by the energy."""
    a, of_place, of_speed = affine(terms)
    demand(a != 0 and of_place == of_speed == 0, "the acceleration is not constant, or zero")
    demand(v1 - v == a * h and v1**2 - v**2 == 2 * a * (q1 - q), "it is no free flight")


METHODS = {
    "explicit-euler": explicit_euler,
    "semi-implicit-euler": semi_implicit_euler,
    "verlet": verlet,
    "runge-kutta-4": runge_kutta,
    "flight": flight,
}
