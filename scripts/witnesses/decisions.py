"""One function per kind of witness: raises Wrong, with what is wrong, unless the witness shows what it says."""

from fractions import Fraction

from .matrices import (determinant, dot, fraction, is_copositive, is_semidefinite, kernel, matrix, plus, principal, rank, solution, square, subsets,
                       symmetric, times, transposed, vector)
from .polyhedra import is_more_than, vertex


class Wrong(Exception):
    """A witness does not show what it says."""


def demand(holds: bool, what: str) -> None:
    """Raises unless it holds."""
    if not holds:
        raise Wrong(what)


def answers(one: dict, *known: str) -> str:
    """The answer, one of those there are."""
    demand(one["answer"] in known, f"there is no answer {one['answer']!r}")
    return one["answer"]


def linear_system(one: dict) -> None:
    """A x = b with a nonsingular A, or a singular A."""
    rows, right = square(one["matrix"]), vector(one["right_side"])
    demand(len(right) == len(rows), "b has another size")
    if one["x"] == "singular":
        demand(rank(rows) < len(rows), "the matrix is nonsingular")
        return
    demand(len(vector(one["x"])) == len(rows) and times(rows, vector(one["x"])) == right, "A x is not b")
    demand(rank(rows) == len(rows), "the matrix is singular")


def matrix_rank(one: dict) -> None:
    """The rank of a matrix."""
    rows = matrix(one["matrix"])
    demand([rank(rows) if rows and rows[0] else 0] == one["rank"], "the rank is another one")


def complementary(rows: list, q: list, z: list) -> None:
    """0 ≤ z ⟂ M z + q ≥ 0."""
    w = plus(times(rows, z), q)
    demand(all(entry >= 0 for entry in z), "z has a negative entry")
    demand(all(entry >= 0 for entry in w), "M z + q has a negative entry")
    demand(dot(z, w) == 0, "zᵀ(M z + q) is not 0")


def lcp_solution(one: dict) -> None:
    """A solution of a linear complementarity problem."""
    complementary(square(one["matrix"]), vector(one["vector"]), vector(one["z"]))


def lcp_ray(one: dict) -> None:
    """A secondary ray of Lemke's path: 0 ≤ z(t) ⟂ M z(t) + q + d z₀(t) ≥ 0 for all t ≥ 0, z₀ > 0."""
    rows, q, d = square(one["matrix"]), vector(one["vector"]), vector(one["covering"])
    point, direction = vector(one["point"]), vector(one["direction"])
    artificial, growth = vector(one["artificial"])
    demand(artificial > 0 and growth >= 0, "the artificial variable is not positive along the ray")
    demand(any(entry != 0 for entry in direction) or growth != 0, "the ray does not move")
    start = plus(plus(times(rows, point), q), [artificial * entry for entry in d])
    change = plus(times(rows, direction), [growth * entry for entry in d])
    for name, entries in (("z", point), ("its direction", direction), ("w", start), ("its change", change)):
        demand(all(entry >= 0 for entry in entries), f"{name} has a negative entry")
    # a quadratic in t that vanishes: all three coefficients
    demand(dot(point, start) == dot(direction, change) == 0, "z and w are not complementary along the ray")
    demand(dot(point, change) + dot(direction, start) == 0, "z and w are not complementary along the ray")


def all_solutions(one: dict) -> None:
    """All solutions of a small problem: a point of every complementary cone that has one, and a family where it has more than a point."""
    rows, q = square(one["matrix"]), vector(one["vector"])
    points, starts, directions = (matrix(one[name]) for name in ("points", "family_points", "family_directions"))
    for z in points:
        complementary(rows, q, z)
    demand(len({tuple(z) for z in points}) == len(points), "a solution is listed twice")
    demand(len(starts) == len(directions), "a family has no start, or no direction")
    families = list(zip(starts, directions))
    for start, direction in families:
        demand(start in points and any(entry != 0 for entry in direction), "a family starts nowhere or does not move")
        _family(rows, q, start, direction)
    for chosen in [(), *subsets(len(q))]:
        values = solution(principal(rows, chosen), [-q[i] for i in chosen]) if chosen else []
        if values is None:
            _singular(rows, q, chosen, points, families)
            continue
        z = [Fraction(0)] * len(q)
        for i, value in zip(chosen, values):
            z[i] = value
        if all(entry >= 0 for entry in z) and all(entry >= 0 for entry in plus(times(rows, z), q)):
            demand(z in points, f"the solution {[str(entry) for entry in z]} is missing")


def _singular(rows: list, q: list, chosen: tuple, points: list, families: list) -> None:
    """The cone of a singular basis: w − M z = q with z zero outside of it and w zero inside."""
    size = len(q)
    column = {j: [-row[j] for row in rows] if j in chosen else [Fraction(int(i == j)) for i in range(size)] for j in range(size)}
    found = vertex([[column[j][i] for j in range(size)] for i in range(size)], q)
    if found is None:
        return

    def within(z: list, w: list) -> bool:
        return all((w if j in chosen else z)[j] == 0 for j in range(size))

    demand(any(within(z, plus(times(rows, z), q)) for z in points), f"the cone {list(chosen)} has a solution, and none of it is listed")
    if is_more_than(found, size):
        listed = any(within(z, plus(times(rows, z), q)) and within(change, times(rows, change)) for z, change in families)
        demand(listed, f"the cone {list(chosen)} has more solutions than one, and no family of it is listed")


def _family(rows: list, q: list, start: list, direction: list) -> None:
    """start + t direction solves the problem for small t ≥ 0: decided at the largest t that changes no sign, halved."""
    ends = [-a / b for a, b in zip(start, direction) if b < 0]
    slack, change = plus(times(rows, start), q), times(rows, direction)
    ends += [-a / b for a, b in zip(slack, change) if b < 0]
    demand(all(end > 0 for end in ends), "a family leaves the solutions at once")
    t = min(ends, default=Fraction(2)) / 2
    complementary(rows, q, plus(start, [t * entry for entry in direction]))


def copositive(one: dict) -> None:
    """Copositive, or an x ≥ 0 with xᵀM x < 0."""
    rows = square(one["matrix"])
    if answers(one, "holds", "fails") == "holds":
        demand(is_copositive(rows), "the matrix is not copositive")
        return
    x = vector(one["x"])
    demand(all(entry >= 0 for entry in x) and dot(x, times(rows, x)) < 0, "x is no counterexample")


def copositive_plus(one: dict) -> None:
    """Copositive-plus, or an x ≥ 0 that shows that it is not."""
    rows = square(one["matrix"])
    if answers(one, "holds", "negative", "zero") == "holds":
        demand(is_copositive(rows), "the matrix is not copositive")
        demand(is_semidefinite(rows) or _zeros_lie_in_the_kernel(rows), "a zero of the form does not lie in the kernel of M + Mᵀ")
        return
    x = vector(one["x"])
    value = dot(x, times(rows, x))
    demand(all(entry >= 0 for entry in x), "x has a negative entry")
    if one["answer"] == "negative":
        demand(value < 0, "xᵀM x is not negative")
    else:
        demand(value == 0 and any(entry != 0 for entry in times(symmetric(rows), x)), "x does not show it")


def _zeros_lie_in_the_kernel(rows: list) -> bool:
    """For a copositive matrix: positive zeros of the form on a support lie in the kernel of that principal submatrix; each support has at most one direction."""
    doubled = symmetric(rows)
    for chosen in subsets(len(rows)):
        basis = kernel(principal(doubled, chosen))
        demand(len(basis) <= 1, "a support with more than one direction: this script cannot decide it")
        for x in basis:
            if all(entry > 0 for entry in x) or all(entry < 0 for entry in x):
                whole = [Fraction(0)] * len(rows)
                for i, entry in zip(chosen, x):
                    whole[i] = abs(entry)
                if any(entry != 0 for entry in times(doubled, whole)):
                    return False
    return True


def definiteness(one: dict) -> None:
    """Definite, semidefinite with a kernel and a rank, or indefinite with an x."""
    rows = square(one["matrix"])
    doubled = symmetric(rows)
    if answers(one, "definite", "semidefinite", "indefinite") == "indefinite":
        x = vector(one["x"])
        demand(dot(x, times(rows, x)) < 0, "xᵀA x is not negative")
        return
    demand(is_semidefinite(rows), "the matrix is indefinite")
    if one["answer"] == "definite":
        demand(rank(doubled) == len(rows) if rows else True, "the matrix is singular")
        return
    x = vector(one["kernel"])
    demand(any(entry != 0 for entry in x) and all(entry == 0 for entry in times(doubled, x)), "x is not in the kernel")
    demand([rank(doubled)] == one["rank"], "the rank is another one")


def p_matrix(one: dict) -> None:
    """All principal minors are positive, or one that is not."""
    rows = square(one["matrix"])
    if answers(one, "holds", "fails") == "holds":
        demand(all(determinant(principal(rows, chosen)) > 0 for chosen in subsets(len(rows))), "a principal minor is not positive")
        return
    demand(tuple(one["indices"]) in list(subsets(len(rows))), "these are no rows of a principal minor")
    value = determinant(principal(rows, tuple(one["indices"])))
    demand(value == fraction(one["value"]) and value <= 0, "the minor is another one")


def nonnegative_solution(one: dict) -> None:
    """x ≥ 0 with A x = b, or Farkas's y with Aᵀy ≤ 0 and bᵀy > 0."""
    rows, right, x = matrix(one["matrix"]), vector(one["right_side"]), vector(one["vector"])
    demand(bool(rows) and len(right) == len(rows), "b has another size")
    if answers(one, "point", "farkas") == "point":
        demand(all(entry >= 0 for entry in x) and times(rows, x) == right, "x is no solution")
    else:
        demand(all(entry <= 0 for entry in times(transposed(rows), x)) and dot(right, x) > 0, "y proves nothing")


def response(one: dict) -> None:
    """u = u_free + W r."""
    after = plus(vector(one["velocity"]), times(matrix(one["delassus"]), vector(one["impulse"])))
    demand(after == vector(one["after"]), "the velocities are not u_free + W r")


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


DECISIONS = {
    "linear-system": linear_system,
    "rank": matrix_rank,
    "lcp-solution": lcp_solution,
    "lcp-ray": lcp_ray,
    "all-solutions": all_solutions,
    "copositive": copositive,
    "copositive-plus": copositive_plus,
    "definiteness": definiteness,
    "p-matrix": p_matrix,
    "nonnegative-solution": nonnegative_solution,
    "response": response,
    "ball-step": ball_step,
}
