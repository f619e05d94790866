"""Sets and measures: points beside a set of polynomial inequalities, what a function rises on Cantor's set."""

from bisect import bisect_left, bisect_right
from fractions import Fraction

from .judgement import count, demand, only
from .matrices import fraction, matrix, vector


def cantor_rises(one: dict) -> None:
    """What a function rises on the intervals of a level of Cantor's set, of all but the largest rise and of that one. Cantor's: by counting finer intervals."""
    only(one, "function", "level", "rises")
    level, told = count(one, "level", 0, 12), vector(one["rises"])
    demand(one["function"] in ("cantor", "uniform", "jump"), f"there is no function {one['function']!r}")
    starts, fine = cantor_starts(level), cantor_starts(level + 2)
    # in units of 3⁻ⁿ and of 3⁻ⁿ⁻²
    rises = {
        "cantor": lambda: [Fraction(bisect_right(fine, 9 * start + 8) - bisect_left(fine, 9 * start), len(fine)) for start in starts],
        "uniform": lambda: [Fraction(1, 3**level)] * len(starts),
        "jump": lambda: [Fraction(int(start + 1 == 3**level)) for start in starts],
    }[one["function"]]()
    demand(told == [sum(rises) - max(rises), max(rises)], "the function rises by something else")


def cantor_starts(level: int) -> list[int]:
    """Where the intervals of a level start, in units of 3⁻ⁿ: the numbers whose digits to the base 3 are 0 and 2."""
    starts = [0]
    for place in range(level):
        starts += [start + 2 * 3**place for start in starts]
    return starts


def point_beside(one: dict) -> None:
    """A point of {φᵢ ≥ 0} within a reach of a centre, in the maximum norm; or none: then the φᵢ, or some of them together, are negative all over that square."""
    only(one, "terms", "centre", "reach", "point")
    centre, reach, rows = vector(one["centre"]), fraction(one["reach"]), matrix(one["terms"])
    demand(len(centre) == 2 and reach > 0 and bool(rows) and all(len(row) == 4 for row in rows), "the centre, the reach or a term is none")
    demand(all(power.denominator == 1 and 0 <= power <= 9 for row in rows for power in row[2:]), "a power is none")
    places = sorted({row[0] for row in rows})
    demand(places == list(range(len(places))) and len(places) <= 8, "the constraints are not numbered from 0")
    if one["point"] != "none":
        point = vector(one["point"])
        demand(len(point) == 2 and all(abs(a - b) <= reach for a, b in zip(point, centre)), "the point is out of reach")
        values = [sum((c * point[0] ** int(a) * point[1] ** int(b) for place, c, a, b in rows if place == each), Fraction(0)) for each in places]
        demand(all(value >= 0 for value in values), "the point is not in the set")
        return
    square = [(entry - reach, entry + reach) for entry in centre]
    chosen = ([place for place in places if number >> int(place) & 1] for number in range(1, 2 ** len(places)))
    demand(any(most(together(rows, some), square) < 0 for some in chosen), "that there is no point so near is not shown")


def together(rows: list, places: list) -> dict:
    """The sum of some constraints: coefficients by powers."""
    sums: dict = {}
    for place, c, a, b in rows:
        if place in places:
            sums[int(a), int(b)] = sums.get((int(a), int(b)), Fraction(0)) + c
    return sums


def most(terms: dict, square: list) -> Fraction:
    """A bound from above of a polynomial on a square, term by term."""
    bound = Fraction(0)
    for (a, b), c in terms.items():
        first, second = power_range(*square[0], a), power_range(*square[1], b)
        bound += max(c * x * y for x in first for y in second)
    return bound


def power_range(low: Fraction, high: Fraction, power: int) -> tuple[Fraction, Fraction]:
    """The least and the largest value of a power on an interval."""
    ends = low**power, high**power
    least = Fraction(0) if power > 0 and power % 2 == 0 and low < 0 < high else min(ends)
    return least, max(ends)
