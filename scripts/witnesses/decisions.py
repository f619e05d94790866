"""One function per kind of witness: raises Wrong, with what is wrong, unless the witness shows what it says."""

from fractions import Fraction

from .judgement import answers, count, demand, enumerable
from .matrices import (determinant, dot, fraction, is_copositive, is_semidefinite, kernel, matrix, plus, principal, rank, solution, square, subsets,
                       symmetric, times, transposed, vector)
from .minima import cone_minimum
from .motions import ball_step, impact_time, motion_step
from .polyhedra import is_more_than, vertex
from .sets import cantor_rises, point_beside


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
    demand(repr([rank(rows) if rows and rows[0] else 0]) == repr(one["rank"]), "the rank is another one")


def complementary(rows: list, q: list, z: list) -> None:
    """0 ≤ z ⟂ M z + q ≥ 0."""
    w = plus(times(rows, z), q)
    demand(all(entry >= 0 for entry in z), "z has a negative entry")
    demand(all(entry >= 0 for entry in w), "M z + q has a negative entry")
    demand(dot(z, w) == 0, "zᵀ(M z + q) is not 0")


def lcp_solution(one: dict) -> None:
    """A solution of a linear complementarity problem."""
    rows = square(one["matrix"])
    demand(bool(rows), "the matrix is empty")
    complementary(rows, vector(one["vector"]), vector(one["z"]))


def lcp_ray(one: dict) -> None:
    """A secondary ray of Lemke's path: 0 ≤ z(t) ⟂ M z(t) + q + d z₀(t) ≥ 0 for all t ≥ 0, z₀ > 0."""
    rows, q, d = square(one["matrix"]), vector(one["vector"]), vector(one["covering"])
    point, direction = vector(one["point"]), vector(one["direction"])
    artificial, growth = vector(one["artificial"])
    demand(artificial > 0 and growth >= 0, "the artificial variable is not positive along the ray")
    demand(len(d) == len(rows) > 0 and all(entry > 0 for entry in d), "the covering vector is not positive")
    demand(any(entry != 0 for entry in direction), "z does not move along the ray: every problem has this one")
    start = plus(plus(times(rows, point), q), [artificial * entry for entry in d])
    change = plus(times(rows, direction), [growth * entry for entry in d])
    for name, entries in (("z", point), ("its direction", direction), ("w", start), ("its change", change)):
        demand(all(entry >= 0 for entry in entries), f"{name} has a negative entry")
    # a quadratic in t that vanishes: all three coefficients
    demand(dot(point, start) == dot(direction, change) == 0, "z and w are not complementary along the ray")
    demand(dot(point, change) + dot(direction, start) == 0, "z and w are not complementary along the ray")


def all_solutions(one: dict) -> None:
    """All solutions of a small problem: a point of every complementary cone that has one, and a family where it has more than a point."""
    rows, q = enumerable(square(one["matrix"])), vector(one["vector"])
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
    rows = enumerable(square(one["matrix"]))
    if answers(one, "holds", "fails") == "holds":
        demand(is_copositive(rows), "the matrix is not copositive")
        return
    x = vector(one["x"])
    demand(all(entry >= 0 for entry in x) and dot(x, times(rows, x)) < 0, "x is no counterexample")


def copositive_plus(one: dict) -> None:
    """Copositive-plus, or an x ≥ 0 that shows that it is not."""
    rows = enumerable(square(one["matrix"]))
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
    demand(bool(rows), "the matrix is empty")
    doubled = symmetric(rows)
    if answers(one, "definite", "semidefinite", "indefinite") == "indefinite":
        x = vector(one["x"])
        demand(dot(x, times(rows, x)) < 0, "xᵀA x is not negative")
        return
    demand(is_semidefinite(rows), "the matrix is indefinite")
    if one["answer"] == "definite":
        demand(rank(doubled) == len(rows), "the matrix is singular")
        return
    x = vector(one["kernel"])
    demand(any(entry != 0 for entry in x) and all(entry == 0 for entry in times(doubled, x)), "x is not in the kernel")
    demand(rank(doubled) == count(one, "rank", 0, len(rows)), "the rank is another one")


def p_matrix(one: dict) -> None:
    """All principal minors are positive, or one that is not."""
    rows = enumerable(square(one["matrix"]))
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


def powers(one: dict) -> None:
    """What becomes of the powers of a 2×2 matrix, by its eigenvalues."""
    (a, b), (c, d) = square(one["matrix"])
    trace, discriminant = a + d, (a - d) ** 2 + 4 * b * c
    if discriminant < 0:
        # a conjugate pair, |λ|² = det
        size = a * d - b * c
        found = "decay" if size < 1 else "bounded" if size == 1 else "grow-exponentially"
    else:
        # |λ| ≤ |T|/2 + √disc/2, and 1 against it: 2 − |T| against √disc
        room = 2 - abs(trace)
        if room > 0 and room**2 > discriminant:
            found = "decay"
        elif room < 0 or room**2 < discriminant:
            found = "grow-exponentially"
        else:
            double = discriminant == 0 and (b != 0 or c != 0)
            found = "grow-linearly" if double else "bounded"
    demand(answers(one, "decay", "bounded", "grow-linearly", "grow-exponentially") == found, f"the powers: {found}")


def determinant_of(one: dict) -> None:
    """The determinant of a matrix."""
    demand(determinant(square(one["matrix"])) == fraction(one["value"]), "the determinant is another one")


def symplectic_defect(one: dict) -> None:
    """DᵀJD − J for the form J = (0 M; −M 0): entry (i, j) is J(D eᵢ, D eⱼ) − J(eᵢ, eⱼ)."""
    rows, mass, told = square(one["map"]), square(one["mass"]), square(one["defect"])
    size = len(mass)
    demand(size > 0 and len(rows) == len(told) == 2 * size, "the map has another size")
    demand(mass == transposed(mass) and rank(mass) == size, "the mass is not symmetric and regular")

    def form(x: list, y: list) -> Fraction:
        return dot(x[:size], times(mass, y[size:])) - dot(x[size:], times(transposed(mass), y[:size]))

    units = [[Fraction(int(i == j)) for i in range(2 * size)] for j in range(2 * size)]
    for i, column in enumerate(transposed(rows)):
        for j, other in enumerate(transposed(rows)):
            demand(form(column, other) - form(units[i], units[j]) == told[i][j], f"entry {i}, {j} is another one")


def quadratic_form(one: dict) -> None:
    """xᵀA x, entry by entry."""
    rows, x = square(one["matrix"]), vector(one["vector"])
    demand(len(x) == len(rows), "x has another size")
    value = sum((entry * x[i] * x[j] for i, row in enumerate(rows) for j, entry in enumerate(row)), Fraction(0))
    demand(value == fraction(one["value"]), "xᵀA x is another number")


def normal_cone(one: dict) -> None:
    """g ∈ N_T(v) of T = {w : a·w ≥ 0}, or of all: −λ a with λ ≥ 0 where a·v = 0, only 0 where a·v > 0, nothing outside of T."""
    a, v, g = (vector(one[name]) for name in ("gradient", "velocity", "member"))
    demand(any(entry != 0 for entry in a) and len(a) == len(v) == len(g), "the gradient is zero, or a vector has another size")
    demand(one["constraint"] in ("closed", "open"), f"there is no constraint {one['constraint']!r}")
    rate = dot(a, v)
    if one["constraint"] == "open" or rate > 0:
        found = all(entry == 0 for entry in g)
    else:
        share = -dot(a, g) / dot(a, a)
        found = rate == 0 and share >= 0 and g == [-share * entry for entry in a]
    demand((answers(one, "holds", "fails") == "holds") == found, "g is a member" if found else "g is no member")


def impact_inclusion(one: dict) -> None:
    """All v⁺ with 0 ≤ r ⟂ a v⁺ + b v⁻ ≥ 0, r = m (v⁺ − v⁻): those with r = 0 and those with a v⁺ + b v⁻ = 0."""
    mass, after, weight, before = vector(one["data"])
    demand(mass > 0 and (after != 0 or weight * before != 0), "the inclusion is degenerate")
    candidates = {before} | ({-weight * before / after} if after != 0 else set())
    right = {v for v in candidates if mass * (v - before) >= 0 <= after * v + weight * before and mass * (v - before) * (after * v + weight * before) == 0}
    told = vector(one["solutions"])
    demand(len(told) == len(set(told)) and set(told) == right, f"the solutions are {sorted(map(str, right))}")


def coulomb(one: dict) -> None:
    """Signorini and Coulomb for u and r = (n, t): the friction opposes the slip, |r_t| = μ r_n while there is one; by squares."""
    mu, u, r = fraction(one["friction"]), vector(one["velocity"]), vector(one["impulse"])
    demand(mu >= 0 and len(u) == len(r) in (2, 3), "μ is negative, or u and r have another size")
    slip, force = u[1:], r[1:]
    bound, squared = mu * r[0], dot(force, force)
    if any(entry != 0 for entry in slip):
        aligned = squared * dot(slip, slip) == dot(slip, force) ** 2 and dot(slip, force) <= 0
        friction = aligned and squared == bound**2
    else:
        friction = squared <= bound**2
    found = u[0] >= 0 and r[0] >= 0 and u[0] * r[0] == 0 and friction
    demand((answers(one, "holds", "fails") == "holds") == found, "the law holds" if found else "the law does not hold")


def impedance(one: dict) -> None:
    """MuJoCo's impedance at a violation, from its documented curve."""
    low, high = Fraction(1, 10_000), Fraction(9999, 10_000)
    start, end, width, middle, violation = vector(one["data"])
    power = count(one, "power", 1, 100)
    start, end, middle = (min(max(x, low), high) for x in (start, end, middle))
    if width <= 0:
        found = (start + end) / 2
    else:
        x = min(max(violation / width, Fraction(0)), Fraction(1))
        rising = x <= middle
        y = x * (x / middle) ** (power - 1) if rising else 1 - (1 - x) * ((1 - x) / (1 - middle)) ** (power - 1)
        found = start * (1 - y) + end * y
    demand(found == fraction(one["value"]), f"the impedance is {found}")


def delassus(one: dict) -> None:
    """W = H M⁻¹ Hᵀ for a nonsingular M: column by column, from M x = (a row of H)."""
    mass, rows, told = square(one["mass"]), matrix(one["jacobian"]), square(one["delassus"])
    demand(len(told) == len(rows) and mass == transposed(mass), "W has another size, or the mass is not symmetric")
    for row, entries in zip(rows, transposed(told)):
        answer = solution(mass, row)
        demand(answer is not None, "the mass is singular")
        demand(times(rows, answer) == entries, "a column of W is another one")


def stewart_trinkle(one: dict) -> None:
    """The LCP of Stewart and Trinkle from W, u_free, μ and the friction directions, entry by entry: unknowns λ, β, σ."""
    w, velocity, friction, directions = square(one["delassus"]), vector(one["velocity"]), vector(one["friction"]), matrix(one["directions"])
    demand(bool(friction), "there is no contact")
    contacts, count = len(friction), len(directions)
    rows = len(w) // contacts
    demand(rows in (2, 3) and rows * contacts == len(w) == len(velocity), "there are not two or three rows per contact")
    demand(all(mu >= 0 for mu in friction) and count > 0 and all(len(direction) == rows - 1 for direction in directions), "μ or a direction is none")
    # the impulse of each unknown, and the contact of each slip speed
    unit = [{rows * contact: Fraction(1)} for contact in range(contacts)]
    unit += [{rows * contact + 1 + k: direction[k] for k in range(rows - 1)} for contact in range(contacts) for direction in directions]
    of = list(range(contacts)) + [contact for contact in range(contacts) for _ in directions]
    size = len(unit) + contacts
    expected = [[Fraction(0)] * size for _ in range(size)]
    for i, left in enumerate(unit):
        for j, right in enumerate(unit):
            expected[i][j] = sum((a * b * w[p][q] for p, a in left.items() for q, b in right.items()), Fraction(0))
    for contact in range(contacts):
        sigma = len(unit) + contact
        expected[sigma][contact] = friction[contact]
        for k in range(contacts, len(unit)):
            if of[k] == contact:
                expected[k][sigma], expected[sigma][k] = Fraction(1), Fraction(-1)
    demand(square(one["matrix"]) == expected, "the matrix is another one")
    free = [sum((a * velocity[p] for p, a in left.items()), Fraction(0)) for left in unit]
    demand(vector(one["vector"]) == free + [Fraction(0)] * contacts, "the vector is another one")


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
    "powers": powers,
    "determinant": determinant_of,
    "symplectic-defect": symplectic_defect,
    "quadratic-form": quadratic_form,
    "normal-cone": normal_cone,
    "impact-inclusion": impact_inclusion,
    "coulomb": coulomb,
    "impedance": impedance,
    "delassus": delassus,
    "stewart-trinkle": stewart_trinkle,
    "cone-minimum": cone_minimum,
    "motion-step": motion_step,
    "impact-time": impact_time,
    "cantor-rises": cantor_rises,
    "point-beside": point_beside,
}
