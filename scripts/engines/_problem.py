"""Reading `contact-problem/1` and writing `solution/1`; for the adapters, standard library only.

    u = W r + u_free,   y = u + s + R r,   (r, y) in the contact law,   W = H M⁻¹ Hᵀ

A solver that knows neither shift nor compliance is given W + R and q = u_free + s: its velocity is
then y, and the solution reports u = W r + u_free from its impulses.  Matrices are lists of rows.
"""

import math
from dataclasses import dataclass

LAWS = ("frictionless", "coulomb", "associated", "polyhedral-coulomb", "polyhedral-associated")
_FIELDS = {"schema", "name", "dimension", "law", "directions", "friction", "free_velocity", "shift",
           "delassus", "mass", "jacobian", "compliance", "provenance"}


@dataclass
class Problem:
    """One step's contact problem, contacts ordered (n), (n, t₁) or (n, t₁, t₂)."""

    name: str
    dimension: int
    law: str
    directions: object  # an integer for the polyhedral laws, else None
    friction: list
    free_velocity: list
    shift: list
    delassus: list
    compliance: object  # the diagonal of R in contact coordinates, or None
    edge_compliance: object  # its diagonal in the coordinates of the cone's edges, or None

    @property
    def rows(self):
        """dimension · contacts."""
        return len(self.free_velocity)

    def stiff_operator(self):
        """W + R, the operator from impulses to law velocities."""
        operator = [list(row) for row in self.delassus]
        for i, softness in enumerate(self.compliance or []):
            operator[i][i] += softness
        return operator

    def law_free_velocity(self):
        """q = u_free + s, the law velocity without impulses."""
        return [u + s for u, s in zip(self.free_velocity, self.shift)]

    def velocity(self, impulse):
        """u = W r + u_free."""
        return [math.fsum([w * r for w, r in zip(row, impulse)] + [free])
                for row, free in zip(self.delassus, self.free_velocity)]

    def solution(self, impulse, solver, iterations):
        """`solution/1` of these impulses."""
        impulse = [float(r) for r in impulse]
        return {"schema": "solution/1", "problem": self.name, "impulse": impulse,
                "velocity": self.velocity(impulse), "solver": solver,
                "iterations": int(iterations)}


def read(document):
    """The `Problem` of a decoded `contact-problem/1`; ValueError names the field it cannot be."""
    if not isinstance(document, dict) or document.get("schema") != "contact-problem/1":
        raise ValueError("schema: a contact-problem/1 is needed")
    unknown = sorted(set(document) - _FIELDS)
    if unknown:
        raise ValueError(f"{unknown[0]}: unknown field")
    dimension, law = document["dimension"], document["law"]
    if dimension not in (1, 2, 3):
        raise ValueError(f"dimension: is {dimension!r}, not 1, 2 or 3")
    if law not in LAWS:
        raise ValueError(f"law: is {law!r}, not one of {', '.join(LAWS)}")
    if law.startswith("polyhedral") != (document.get("directions") is not None):
        raise ValueError("directions: belong to the polyhedral laws, and only to them")
    friction = _numbers(document, "friction", None, 0.0)
    if dimension == 1 and any(friction):
        raise ValueError("friction: is positive although the contacts have no tangential row")
    rows = dimension * len(friction)
    shift = [0.0] * rows if document.get("shift") is None else _numbers(document, "shift", rows)
    contact, edge = _compliance(document.get("compliance"), rows)
    return Problem(document["name"], dimension, law, document.get("directions"), friction,
                   _numbers(document, "free_velocity", rows), shift, _operator(document, rows),
                   contact, edge)


def _number(value, field):
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise ValueError(f"{field}: holds {value!r}, not a finite number")
    return float(value)


def _numbers(document, field, size, least=None):
    values = document[field]
    if not isinstance(values, list):
        raise ValueError(f"{field}: is not a list")
    if size is not None and len(values) != size:
        raise ValueError(f"{field}: has size {len(values)}, these contacts need {size}")
    values = [_number(value, field) for value in values]
    if least is not None and any(value < least for value in values):
        raise ValueError(f"{field}: holds a number below {least}")
    return values


def _compliance(given, rows):
    if given is None:
        return None, None
    if given["coordinates"] == "contact":
        return _numbers(given, "diagonal", rows, 0.0), None
    if given["coordinates"] == "edge":
        return None, _numbers(given, "diagonal", None, 0.0)
    raise ValueError(f"compliance.coordinates: is {given['coordinates']!r}")


def _operator(document, rows):
    given = {field for field in ("delassus", "mass", "jacobian") if document.get(field) is not None}
    if given == {"delassus"}:
        return _matrix(document["delassus"], "delassus", [rows, rows])
    if given != {"mass", "jacobian"}:
        raise ValueError("delassus: must be given alone, or mass together with jacobian")
    size = document["mass"]["shape"][0]
    mass = _matrix(document["mass"], "mass", [size, size])
    return delassus(mass, _matrix(document["jacobian"], "jacobian", [rows, size]))


def _matrix(document, field, shape):
    """A matrix given as `rows`, or as `triplets` counted from 0 with every place at most once."""
    if document["shape"] != shape:
        raise ValueError(f"{field}: has shape {document['shape']}, {shape} fits these contacts")
    if ("rows" in document) == ("triplets" in document):
        raise ValueError(f"{field}: has both or none of rows and triplets")
    if "rows" in document:
        if len(document["rows"]) != shape[0] or any(len(r) != shape[1] for r in document["rows"]):
            raise ValueError(f"{field}.rows: do not have the shape {shape}")
        return [[_number(value, field) for value in row] for row in document["rows"]]
    triplets = document["triplets"]
    if not len(triplets["row"]) == len(triplets["column"]) == len(triplets["value"]):
        raise ValueError(f"{field}.triplets: differ in number")
    matrix, seen = [[0.0] * shape[1] for _ in range(shape[0])], set()
    for i, j, value in zip(triplets["row"], triplets["column"], triplets["value"]):
        if not (0 <= i < shape[0] and 0 <= j < shape[1]) or (i, j) in seen:
            raise ValueError(f"{field}.triplets: ({i}, {j}) lies outside or occurs twice")
        seen.add((i, j))
        matrix[i][j] = _number(value, field)
    return matrix


def delassus(mass, jacobian):
    """W = H M⁻¹ Hᵀ = Yᵀ Y with M = L Lᵀ and L Y = Hᵀ; symmetric by construction."""
    size, factor = len(mass), [[0.0] * len(mass) for _ in mass]
    for i in range(size):
        for j in range(i + 1):
            if mass[i][j] != mass[j][i]:
                raise ValueError("mass: is not symmetric")
            rest = mass[i][j] - math.fsum(a * b for a, b in zip(factor[i][:j], factor[j][:j]))
            if i == j and not rest > 0:
                raise ValueError("mass: is not positive definite")
            factor[i][j] = math.sqrt(rest) if i == j else rest / factor[j][j]
    halves = []
    for row in jacobian:
        half = []
        for i in range(size):
            half.append((row[i] - math.fsum(a * b for a, b in zip(factor[i], half))) / factor[i][i])
        halves.append(half)
    operator = [[0.0] * len(halves) for _ in halves]
    for i, one in enumerate(halves):
        for j in range(i + 1):
            operator[i][j] = operator[j][i] = math.fsum(a * b for a, b in zip(one, halves[j]))
    return operator
