"""Polyhedra {y ≥ 0 : C y = q} in fractions: a vertex by the simplex method with Bland's rule, and whether there is more than that point."""

from fractions import Fraction


class Tableau:
    """Rows of C y = q solved for a basis; the last entry of a row is its right side."""

    def __init__(self, rows: list, basis: list):
        self.rows, self.basis = rows, basis

    def pivot(self, row: int, column: int) -> None:
        """Column enters the basis in this row."""
        by = self.rows[row][column]
        self.rows[row] = [entry / by for entry in self.rows[row]]
        for i, other in enumerate(self.rows):
            if i != row and other[column] != 0:
                factor = other[column]
                self.rows[i] = [a - factor * b for a, b in zip(other, self.rows[row])]
        self.basis[row] = column

    def values(self, size: int) -> list:
        """The basic solution."""
        y = [Fraction(0)] * size
        for row, column in zip(self.rows, self.basis):
            if column < size:
                y[column] = row[-1]
        return y

    def improve(self, gains: list) -> bool | None:
        """One step of the simplex method for max Σ gains·y: True if a step was taken, False at the maximum, None if there is none."""
        price = [gains[column] for column in self.basis]
        for column in range(len(gains)):
            if gains[column] - sum((p * row[column] for p, row in zip(price, self.rows)), Fraction(0)) > 0:
                limits = [(row[-1] / row[column], self.basis[i], i) for i, row in enumerate(self.rows) if row[column] > 0]
                if not limits:
                    return None
                self.pivot(min(limits)[2], column)
                return True
        return False


def vertex(rows: list, right: list) -> Tableau | None:
    """A basic solution of C y = q, y ≥ 0; None if there is no solution."""
    height, width = len(rows), len(rows[0]) if rows else 0
    signed = [([-a for a in row], -b) if b < 0 else (list(row), b) for row, b in zip(rows, right)]
    unit = [[Fraction(int(i == j)) for j in range(height)] for i in range(height)]
    tableau = Tableau([row + unit[i] + [b] for i, (row, b) in enumerate(signed)], [width + i for i in range(height)])
    gains = [Fraction(0)] * width + [Fraction(-1)] * height
    while tableau.improve(gains):
        pass
    if any(row[-1] != 0 for row, column in zip(tableau.rows, tableau.basis) if column >= width):
        return None
    for i in range(height):
        column = next((j for j in range(width) if tableau.rows[i][j] != 0), None)
        if tableau.basis[i] >= width and column is not None:
            tableau.pivot(i, column)
    kept = [(row, column) for row, column in zip(tableau.rows, tableau.basis) if column < width]
    return Tableau([row[:width] + row[-1:] for row, _ in kept], [column for _, column in kept])


def is_more_than(tableau: Tableau, size: int) -> bool:
    """Whether the polyhedron of this basic solution has another point: then an entry that is 0 here is positive there."""
    gains = [Fraction(int(value == 0)) for value in tableau.values(size)]
    while True:
        step = tableau.improve(gains)
        if step is None or any(gain > 0 and value > 0 for gain, value in zip(gains, tableau.values(size))):
            return True
        if step is False:
            return False
