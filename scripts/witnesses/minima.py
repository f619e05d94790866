"""Minima of convex quadratics over polyhedral cones, by their conditions of optimality and the derivatives of these."""

from fractions import Fraction

from .judgement import demand, only
from .matrices import dot, is_semidefinite, matrix, plus, rank, solution, square, times, transposed, vector


def cone_minimum(one: dict) -> None:
    """x minimises ½xᵀA x + b·x over {x : G x ≥ 0}: A x + b = Gᵀλ, 0 ≤ λ ⟂ G x ≥ 0. With slopes, x′ is how x moves with A′ and b′ to one side."""
    moving = "x_slope" in one
    only(one, "matrix", "vector", "rows", "x", *(("matrix_slope", "vector_slope", "x_slope") if moving else ()))
    a, b, rows, x = square(one["matrix"]), vector(one["vector"]), matrix(one["rows"]), vector(one["x"])
    demand(len(a) == len(b) == len(x) > 0 and all(len(row) == len(x) for row in rows), "A, b, G or x has another size")
    demand(a == transposed(a) and is_semidefinite(a) and rank(a) == len(a), "A is not symmetric and definite, so that there may be another minimum")
    demand(rank(rows) == len(rows), "the rows of G depend on each other")
    room, push = times(rows, x), multipliers(rows, plus(times(a, x), b))
    demand(all(entry >= 0 for entry in room), "x is not in the cone")
    demand(all(entry >= 0 for entry in push) and dot(room, push) == 0, "x does not meet the conditions of a minimum")
    if moving:
        a_slope, b_slope, x_slope = square(one["matrix_slope"]), vector(one["vector_slope"]), vector(one["x_slope"])
        demand(len(a_slope) == len(b_slope) == len(x_slope) == len(x) and a_slope == transposed(a_slope), "a slope has another size")
        change = plus(plus(times(a_slope, x), times(a, x_slope)), b_slope)
        moves(room, push, times(rows, x_slope), multipliers(rows, change))


def multipliers(rows: list, gradient: list) -> list:
    """The λ with Gᵀλ = y, for rows that are independent: from G Gᵀλ = G y."""
    if not rows:
        demand(all(entry == 0 for entry in gradient), "the gradient does not vanish")
        return []
    found = solution([[dot(row, other) for other in rows] for row in rows], times(rows, gradient))
    demand(found is not None and times(transposed(rows), found) == gradient, "the gradient is no combination of the rows of G")
    return found


def moves(room: list, push: list, room_slope: list, push_slope: list) -> None:
    """Row by row: what is positive leaves the other zero, to first order; where both are zero, their slopes are complementary."""
    for s, p, s_slope, p_slope in zip(room, push, room_slope, push_slope):
        if s > 0:
            right = p_slope == 0
        elif p > 0:
            right = s_slope == 0
        else:
            right = min(s_slope, p_slope) == Fraction(0)
        demand(right, "x′ does not meet the derivatives of the conditions")
