"""All solutions of a small problem in the plane or without friction, in fractions: every pattern of states is solved.

    open   r = 0 ,  y_n ≥ 0          stick   y = 0 ,  |r_t| ≤ μ r_n          slides ±   y_n = 0 ,  r_t = ∓μ r_n ,  ±y_t ≥ 0

W = H M⁻¹ Hᵀ and u_free + shift are those of the file, number by number, without rounding.  Of a pattern whose equations are regular the
one candidate is tested.  Where they are singular and solvable, the candidates are r + N z: if W N = 0 they have one velocity, which is
what counts; the polyhedron of the z that keep the signs is then tested for a point by eliminating one unknown after the other.
"""

from dataclasses import dataclass
from fractions import Fraction
from itertools import product

MOST_PATTERNS = 1024  # of 4ⁿ in the plane, 2ⁿ without friction
MOST_INEQUALITIES = 4000  # of an elimination


@dataclass
class Answers:
    """What the patterns showed: the different velocities u, each with an impulse, and the patterns that were not decided."""

    velocities: list
    impulses: list
    undecided: int
    patterns: int


def _matrix(data):
    rows, columns = data["shape"]
    matrix = [[Fraction(0)] * columns for _ in range(rows)]
    for i, j, value in zip(*(data["triplets"][key] for key in ("row", "column", "value"))):
        matrix[i][j] = Fraction(value)
    return matrix


def operator(document):
    """W and q = u_free + shift in fractions; the mass is diagonal."""
    mass, jacobian = _matrix(document["mass"]), _matrix(document["jacobian"])
    size = len(mass)
    if any(mass[i][j] for i in range(size) for j in range(size) if i != j):
        raise ValueError("the mass is not diagonal")
    scaled = [[h / mass[k][k] for k, h in enumerate(row)] for row in jacobian]
    w = [[sum(a * b for a, b in zip(one, other) if a and b) for other in jacobian] for one in scaled]
    shift = document.get("shift") or [0] * len(jacobian)
    return w, [Fraction(u) + Fraction(s) for u, s in zip(document["free_velocity"], shift)]


def _reduce(equations, unknowns):
    """Reduced row echelon form of [A | b] in place; the pivots' columns, or None if it has no solution."""
    pivots, row = [], 0
    for column in range(unknowns):
        place = next((i for i in range(row, len(equations)) if equations[i][column]), None)
        if place is None:
            continue
        equations[row], equations[place] = equations[place], equations[row]
        first = equations[row][column]
        equations[row] = [x / first for x in equations[row]]
        for i in range(len(equations)):
            if i != row and equations[i][column]:
                factor = equations[i][column]
                equations[i] = [x - factor * y for x, y in zip(equations[i], equations[row])]
        pivots.append(column)
        row += 1
    return None if any(equation[unknowns] for equation in equations[row:]) else pivots


def _has_point(inequalities, unknowns, strict=()):
    """Whether a z has a·z + b ≥ 0 for all (a, b), > 0 for the strict ones, by eliminating unknowns; None where they become too many."""
    inequalities = [(*i, False) for i in inequalities] + [(*i, True) for i in strict]
    for column in range(unknowns):
        positive = [i for i in inequalities if i[column] > 0]
        negative = [i for i in inequalities if i[column] < 0]
        inequalities = [i for i in inequalities if not i[column]]
        if len(positive) * len(negative) + len(inequalities) > MOST_INEQUALITIES:
            return None
        for p in positive:
            for n in negative:
                sums = (x / p[column] - y / n[column] for x, y in zip(p[:-1], n[:-1]))
                inequalities.append((*sums, p[-1] or n[-1]))
        inequalities = list(dict.fromkeys(inequalities))
    return all(i[unknowns] > 0 if i[-1] else i[unknowns] >= 0 for i in inequalities)


def all_solutions(document):
    """The `Answers` of a problem, or None where it is not one of these, or too large."""
    rows, law, friction = document["dimension"], document["law"], document["friction"]
    plane = rows == 2 and law == "coulomb"
    if not (plane or law == "frictionless") or "compliance" in document or "triplets" not in document.get("mass", {}):
        return None
    if (4 if plane else 2) ** len(friction) > MOST_PATTERNS:
        return None
    w, q = operator(document)
    states = ("open", "stick", "plus", "minus") if plane else ("open", "normal")
    choices = [("open", "normal") if plane and not mu else states for mu in friction]
    answers, later = Answers([], [], 0, 0), []
    for pattern in product(*choices):
        answers.patterns += 1
        _try(pattern, rows, w, q, [Fraction(mu) for mu in friction], answers, later)
    answers.undecided += sum(not _is_one_of(answers.velocities, *family) for family in later)
    return answers


def _is_one_of(known, velocity, inequalities, unknowns):
    """Whether a family of velocities, over the polyhedron of its z, is one of the known points and nothing else."""
    def leaves(point):
        for row, number in zip(velocity, point):
            for sign in (1, -1):
                beyond = (*(sign * x for x in row[:-1]), sign * (row[-1] - number))
                if _has_point(inequalities, unknowns, [beyond]) is not False:
                    return True
        return False
    return any(not leaves(point) for point in known)


def _try(pattern, rows, w, q, friction, answers, later):
    """Solves one pattern and adds its velocity where it has a solution."""
    size = len(q)
    directions, equations, signs = [], [], []  # unknowns are amounts of impulse along directions
    for k, state in enumerate(pattern):
        n, t, mu = rows * k, rows * k + 1, friction[k]
        if state == "stick":
            directions += [{n: Fraction(1)}, {t: Fraction(1)}]
            equations += [n, t]
        elif state == "normal":
            directions.append({n: Fraction(1)})
            equations.append(n)
        elif state in ("plus", "minus"):
            directions.append({n: Fraction(1), t: -mu if state == "plus" else mu})
            equations.append(n)
        else:
            signs.append(("y", n, 1))
        if state in ("plus", "minus"):
            signs.append(("y", t, 1 if state == "plus" else -1))
    unknowns = len(directions)
    moved = [[sum(w[i][j] * x for j, x in direction.items()) for direction in directions] for i in range(size)]
    system = [[*moved[i], -q[i]] for i in equations]
    pivots = _reduce(system, unknowns)
    if pivots is None:
        return
    free = [column for column in range(unknowns) if column not in pivots]
    amounts = [[Fraction(0)] * (len(free) + 1) for _ in range(unknowns)]  # each unknown as a·z + b
    for place, column in enumerate(free):
        amounts[column][place] = Fraction(1)
    for row, column in enumerate(pivots):
        amounts[column] = [-system[row][other] for other in free] + [system[row][unknowns]]
    impulse = [[sum(direction.get(i, 0) * amount[c] for direction, amount in zip(directions, amounts)) for c in range(len(free) + 1)]
               for i in range(size)]
    velocity = [[sum(moved[i][j] * amounts[j][c] for j in range(unknowns)) for c in range(len(free) + 1)] for i in range(size)]
    for i in range(size):
        velocity[i][-1] += q[i]
    inequalities = []
    for k, state in enumerate(pattern):
        n, t, mu = rows * k, rows * k + 1, friction[k]
        if state == "stick":
            inequalities += [tuple(mu * a + s * b for a, b in zip(impulse[n], impulse[t])) for s in (1, -1)]
        elif state != "open":
            inequalities.append(tuple(impulse[n]))
    inequalities += [tuple(sign * x for x in velocity[i]) for _, i, sign in signs]
    found = _has_point(inequalities, len(free))
    if not found:
        answers.undecided += found is None
        return
    point = tuple(row[-1] for row in velocity)
    if any(x for row in velocity for x in row[:-1]):
        later.append((velocity, inequalities, len(free)))
        return
    if point not in answers.velocities:
        answers.velocities.append(point)
        answers.impulses.append(tuple(row[-1] for row in impulse) if not free else None)
