"""A contact problem as arrays: from `contact-problem/1` with numpy, and kept in one `.npz`.

    u = W r + u_free,   y = u + s + R r;   the arrays hold W + R and q = u_free + s
"""

import json

import numpy as np

LAWS = ("frictionless", "coulomb", "associated")


def read(path):
    """{operator, free, friction, dimension, law} of a file; ValueError where peers have no such problem."""
    document = json.loads(path.read_text(encoding="utf-8"))
    law, dimension = document["law"], document["dimension"]
    if law not in LAWS:
        raise ValueError(f"the law {law} is not compared")
    free = np.array(document["free_velocity"], dtype=float)
    arrays = {"free": free, "friction": np.array(document["friction"], dtype=float),
              "dimension": dimension, "law": law}
    if document.get("shift") is not None:
        free += document["shift"]
    if document.get("delassus") is not None:
        arrays["operator"] = matrix(document["delassus"])
    else:
        mass, jacobian = matrix(document["mass"]), matrix(document["jacobian"])
        arrays.update(mass=mass, jacobian=jacobian,
                      operator=jacobian @ np.linalg.solve(mass, jacobian.T))
    compliance = document.get("compliance")
    if compliance is not None:
        if compliance["coordinates"] != "contact":
            raise ValueError("a compliance on edges is not compared")
        arrays["operator"] = arrays["operator"] + np.diag(compliance["diagonal"])
    return arrays


def matrix(given):
    """A matrix given by `rows`, `triplets` or `blocks`."""
    if "rows" in given:
        return np.array(given["rows"], dtype=float).reshape(given["shape"])
    dense = np.zeros(given["shape"])
    if "triplets" in given:
        triplets = given["triplets"]
        np.add.at(dense, (triplets["row"], triplets["column"]), triplets["value"])
        return dense
    if "blocks" in given:
        blocks = given["blocks"]
        count = len(blocks["row"])
        d = round((len(blocks["value"]) / count) ** 0.5) if count else 1
        places = np.array([blocks["row"], blocks["column"]])
        parts = dense.reshape(len(dense) // d, d, -1, d)
        parts[places[0], :, places[1], :] = np.array(blocks["value"]).reshape(count, d, d)
        return dense
    raise ValueError(f"a matrix with the fields {sorted(given)} is not read")


def asymmetry(operator):
    """max |W − Wᵀ| / max |W|."""
    size = np.abs(operator).max(initial=0.0)
    return float(np.abs(operator - operator.T).max() / size) if size else 0.0


def natural_map(operator, free, friction, dimension, law, impulse):
    """‖r − P_K(r − ŷ)‖ / ‖q‖ with ρ = 1 kg, y = W r + q and, for Coulomb's law, ŷ = y + μ‖y_t‖ n."""
    impulse = np.asarray(impulse, dtype=float)
    if impulse.shape != free.shape or not np.isfinite(impulse).all():
        return float("inf")
    r = impulse.reshape(-1, dimension)
    y = (operator @ impulse + free).reshape(-1, dimension)
    mu = np.zeros(len(r)) if law == "frictionless" else friction
    if law == "coulomb":
        y = y.copy()
        y[:, 0] += mu * np.linalg.norm(y[:, 1:], axis=1)
    error = np.linalg.norm(r - projected(r - y, mu))
    size = np.linalg.norm(free)
    return float(error / size) if size else float(error)


def projected(points, mu):
    """The nearest points of the cones ‖t‖ ≤ μ n."""
    n, t = points[:, 0], np.linalg.norm(points[:, 1:], axis=1)
    inside, polar = (t <= mu * n) & (n >= 0.0), mu * t <= -n
    normal = np.where(inside, n, np.where(polar, 0.0, (n + mu * t) / (1.0 + mu * mu)))
    shrunk = np.divide(mu * normal, t, out=np.ones_like(t), where=t > 0.0)
    share = np.where(inside, 1.0, shrunk)
    return np.column_stack([normal, points[:, 1:] * share[:, None]])
