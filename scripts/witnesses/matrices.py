"""Matrices of fractions: products, elimination, rank, determinants, definiteness. Lists of rows; nothing but the standard library."""

import re
from fractions import Fraction
from itertools import combinations

FRACTION = re.compile(r"-?[0-9]+(/[1-9][0-9]*)?")


def fraction(text: object) -> Fraction:
    """A fraction from its text, nothing else."""
    if not isinstance(text, str) or not FRACTION.fullmatch(text):
        raise ValueError(f"{text!r} is no fraction")
    return Fraction(text)


def vector(texts: list) -> list:
    """Fractions from texts."""
    if not isinstance(texts, list):
        raise ValueError(f"{texts!r} is no list")
    return [fraction(text) for text in texts]


def matrix(rows: list) -> list:
    """Rows of fractions, all of one length, from rows of texts."""
    if not isinstance(rows, list):
        raise ValueError(f"{rows!r} is no list")
    made = [vector(row) for row in rows]
    if len({len(row) for row in made}) > 1:
        raise ValueError("the rows have different lengths")
    return made


def square(rows: list) -> list:
    """The same, with as many rows as columns."""
    made = matrix(rows)
    if made and len(made[0]) != len(made):
        raise ValueError(f"a matrix of {len(made)} rows and {len(made[0])} columns is not square")
    return made


def dot(one: list, other: list) -> Fraction:
    """Σ xᵢyᵢ."""
    if len(one) != len(other):
        raise ValueError(f"vectors of {len(one)} and {len(other)} entries")
    return sum((a * b for a, b in zip(one, other)), Fraction(0))


def times(rows: list, x: list) -> list:
    """A x."""
    return [dot(row, x) for row in rows]


def plus(one: list, other: list) -> list:
    """x + y."""
    if len(one) != len(other):
        raise ValueError(f"vectors of {len(one)} and {len(other)} entries")
    return [a + b for a, b in zip(one, other)]


def transposed(rows: list) -> list:
    """Aᵀ."""
    return [list(column) for column in zip(*rows)]


def symmetric(rows: list) -> list:
    """A + Aᵀ."""
    return [plus(row, column) for row, column in zip(rows, transposed(rows))]


def principal(rows: list, chosen: tuple) -> list:
    """The rows and columns with these indices."""
    return [[rows[i][j] for j in chosen] for i in chosen]


def echelon(rows: list) -> tuple[list, list, Fraction]:
    """Row echelon form, its pivot columns, and the product of the pivots with the sign of the exchanges."""
    rows, pivots, product = [list(row) for row in rows], [], Fraction(1)
    width = len(rows[0]) if rows else 0
    for column in range(width):
        top = len(pivots)
        found = next((i for i in range(top, len(rows)) if rows[i][column] != 0), None)
        if found is None:
            continue
        if found != top:
            rows[top], rows[found] = rows[found], rows[top]
            product = -product
        product *= rows[top][column]
        for i in range(top + 1, len(rows)):
            if rows[i][column] != 0:
                factor = rows[i][column] / rows[top][column]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[top])]
        pivots.append(column)
    return rows, pivots, product


def rank(rows: list) -> int:
    """The rank."""
    return len(echelon(rows)[1])


def determinant(rows: list) -> Fraction:
    """The determinant of a square matrix."""
    _, pivots, product = echelon(rows)
    return product if len(pivots) == len(rows) else Fraction(0)


def solution(rows: list, right: list) -> list | None:
    """The x with A x = b of a square matrix; None if A is singular."""
    size = len(rows)
    reduced, pivots, _ = echelon([list(row) + [b] for row, b in zip(rows, right)])
    if pivots[:size] != list(range(size)):
        return None
    x = [Fraction(0)] * size
    for i in reversed(range(size)):
        x[i] = (reduced[i][size] - sum((reduced[i][j] * x[j] for j in range(i + 1, size)), Fraction(0))) / reduced[i][i]
    return x


def kernel(rows: list) -> list:
    """A basis of {x : A x = 0}."""
    width = len(rows[0])
    reduced, pivots, _ = echelon(rows)
    basis = []
    for free in (j for j in range(width) if j not in pivots):
        x = [Fraction(0)] * width
        x[free] = Fraction(1)
        for i, column in reversed(list(enumerate(pivots))):
            x[column] = -sum((reduced[i][j] * x[j] for j in range(column + 1, width)), Fraction(0)) / reduced[i][column]
        basis.append(x)
    return basis


def is_semidefinite(rows: list) -> bool:
    """Whether xᵀA x ≥ 0 for all x: symmetric elimination with positive pivots, and zeros where none is left."""
    rest = symmetric(rows)
    while rest:
        pivot = next((i for i in range(len(rest)) if rest[i][i] != 0), None)
        if pivot is None:
            return all(entry == 0 for row in rest for entry in row)
        if rest[pivot][pivot] < 0:
            return False
        others = [i for i in range(len(rest)) if i != pivot]
        rest = [[rest[i][j] - rest[i][pivot] * rest[pivot][j] / rest[pivot][pivot] for j in others] for i in others]
    return True


def subsets(size: int):
    """All nonempty sets of indices, small ones first."""
    return (chosen for count in range(1, size + 1) for chosen in combinations(range(size), count))


def is_copositive(rows: list) -> bool:
    """Whether xᵀA x ≥ 0 for all x ≥ 0.

    Hadeler: a symmetric matrix all of whose smaller principal submatrices are copositive is not copositive itself exactly if its determinant is negative and no entry of its adjugate is.
    """
    doubled = symmetric(rows)
    return not any(_is_first_negative(principal(doubled, chosen)) for chosen in subsets(len(rows)))


def _is_first_negative(rows: list) -> bool:
    if determinant(rows) >= 0:
        return False
    size = len(rows)
    adjugate = ((-1) ** (i + j) * determinant([[rows[k][m] for m in range(size) if m != i] for k in range(size) if k != j]) for i in range(size) for j in range(size))
    return all(entry >= 0 for entry in adjugate)
