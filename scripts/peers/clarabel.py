"""Clarabel on the convex problem; in the environment of scripts/requirements-clarabel.txt.

    impulses     min ½ rᵀW r + qᵀr                 over (μ r_n, r_t) in second-order cones
    velocities   min ½ wᵀM w   over (u_n, μ u_t) in second-order cones, u = H w + q,  r the multipliers

Coulomb's law is not convex: where nothing slips, the convex problem has the same solution, and the
parent's natural map, which is Coulomb's, tells where.  It reads one half of W: the parent gives a symmetric one.
"""

import sys

_here = sys.path.pop(0)  # this file has the name of the package it needs
import clarabel  # noqa: E402
import numpy as np  # noqa: E402
from scipy import sparse  # noqa: E402
sys.path.insert(0, _here)

from worker import serve  # noqa: E402


def load(path):
    """The settings for the problem of this file."""
    given = np.load(path)
    rows, law = int(given["dimension"]), str(given["law"])
    friction = np.zeros_like(given["friction"]) if law == "frictionless" else given["friction"]
    made = {"impulses": _impulses(given, rows, friction)}
    if "mass" in given:
        made["velocities"] = _velocities(given, rows, friction)
    return made


def _impulses(given, rows, friction):
    quadratic = sparse.csc_matrix(np.triu(given["operator"]))
    diagonal, cones = [], []
    for mu in friction:
        if rows == 1 or mu == 0.0:
            cones.append(clarabel.NonnegativeConeT(1))
            cones += [clarabel.ZeroConeT(rows - 1)] if rows > 1 else []
            diagonal += [-1.0] * rows
        else:
            cones.append(clarabel.SecondOrderConeT(rows))
            diagonal += [-mu] + [-1.0] * (rows - 1)
    constraint = sparse.csc_matrix(sparse.diags(diagonal))
    return _preparation(quadratic, given["free"], constraint, np.zeros(len(diagonal)), cones,
                        lambda answer: answer.x)


def _velocities(given, rows, friction):
    scale, kept, cones = [], [], []
    for contact, mu in enumerate(friction):
        first = contact * rows
        if rows == 1 or mu == 0.0:
            cones.append(clarabel.NonnegativeConeT(1))
            kept.append(first)
            scale.append(1.0)
        else:
            cones.append(clarabel.SecondOrderConeT(rows))
            kept += range(first, first + rows)
            scale += [1.0] + [mu] * (rows - 1)
    scale = np.array(scale)
    constraint = sparse.csc_matrix(-scale[:, None] * given["jacobian"][kept])

    def impulse(answer):
        whole = np.zeros(len(given["free"]))
        whole[kept] = scale * np.array(answer.z)
        return whole
    quadratic = sparse.csc_matrix(np.triu(given["mass"]))
    return _preparation(quadratic, np.zeros(quadratic.shape[0]), constraint,
                        scale * given["free"][kept], cones, impulse)


def _preparation(quadratic, linear, constraint, bound, cones, impulse):
    def prepare(tolerance):
        settings = clarabel.DefaultSettings()
        settings.verbose = False
        settings.max_threads = 1
        settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = tolerance

        def solve():
            answer = clarabel.DefaultSolver(quadratic, linear, constraint, bound, cones,
                                            settings).solve()
            status = str(answer.status)
            return impulse(answer), answer.iterations, "" if status == "Solved" else status
        return solve
    return prepare


if __name__ == "__main__":
    serve(load)
