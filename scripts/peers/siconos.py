"""Siconos's numerical solvers; `/usr/bin/python3 siconos.py`, for the Debian package needs the system's own Python.

Storages: `dense` is W as a matrix, `block` is W as Siconos's sparse blocks, read from its own text.
"""

import os
import sys
import tempfile

_here = sys.path.pop(0)  # this file has the name of the package it needs
import numpy as np  # noqa: E402
import siconos.numerics as numerics  # noqa: E402
sys.path.insert(0, _here)

from worker import serve  # noqa: E402

ITERATIONS = 1_000_000  # the parent's limit of time ends a solve before
SPATIAL = {  # name: (solver, its local solver, storages)
    "NSGS": ("NSGS", None, ("dense", "block")),
    "NSGS-projection": ("NSGS", "ONECONTACT_ProjectionOnConeWithLocalIteration", ("block",)),
    "NSN_AC": ("NSN_AC", None, ("dense", "block")),
    "NSN_FB": ("NSN_FB", None, ("dense",)),
    "ADMM": ("ADMM", None, ("block",)),
    "PROX": ("PROX", None, ("dense",)),
    "ACLMFP": ("ACLMFP", None, ("dense",)),
}
COMPLEMENTARITY = ("LEMKE", "PGS", "NEWTONMIN", "ENUM", "LATIN")
MOST_ENUMERATED = 12  # unknowns: 2ⁿ cases
PLANAR = {"NSGS": ("NSGS", None, ("dense", "block")), "CPG": ("CPG", None, ("dense",)),
          "LEMKE": ("LEMKE", None, ("dense",))}


def load(path):
    """The settings for the problem of this file."""
    given = np.load(path)
    dimension, law = int(given["dimension"]), str(given["law"])
    if dimension == 1:
        return {name: _complementarity(name, given["operator"], given["free"]) for name in COMPLEMENTARITY
                if name != "ENUM" or len(given["free"]) <= MOST_ENUMERATED}
    if law == "associated":
        return {}
    data = (dimension, given["operator"], given["free"],
            given["friction"] if law == "coulomb" else np.zeros_like(given["friction"]))
    made, settings = {}, {}
    for name, (solver, local, storages) in (SPATIAL if dimension == 3 else PLANAR).items():
        for storage in storages:
            settings[f"{name}/{storage}"] = _preparation(dimension, solver, local, data, storage, made)
    return settings


def _complementarity(name, operator, free):
    problem = numerics.LCP(operator, free)

    def prepare(tolerance):
        options = numerics.SolverOptions(getattr(numerics, f"SICONOS_LCP_{name}"))
        options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = ITERATIONS
        options.dparam[numerics.SICONOS_DPARAM_TOL] = tolerance
        impulse, velocity = np.zeros(len(free)), np.zeros(len(free))

        def solve():
            failed = numerics.linearComplementarity_driver(problem, impulse, velocity, options)
            return (impulse, options.iparam[numerics.SICONOS_IPARAM_ITER_DONE],
                    f"information {failed}" if failed else "")
        return solve
    return prepare


def _preparation(dimension, solver, local, data, storage, made):
    def prepare(tolerance):
        if storage not in made:
            made[storage] = _problem(*data, storage)
        problem = made[storage]
        number = getattr(numerics, f"SICONOS_FRICTION_{dimension}D_{solver}")
        options = numerics.SolverOptions(number)
        options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = ITERATIONS
        options.dparam[numerics.SICONOS_DPARAM_TOL] = tolerance
        if local is not None:
            numerics.solver_options_update_internal(
                options, 0, getattr(numerics, f"SICONOS_FRICTION_{dimension}D_{local}"))
        impulse, velocity = np.zeros(len(data[2])), np.zeros(len(data[2]))
        driver = numerics.fc3d_driver if dimension == 3 else numerics.fc2d_driver

        def solve():
            failed = driver(problem, impulse, velocity, options)
            return (impulse, options.iparam[numerics.SICONOS_IPARAM_ITER_DONE],
                    f"information {failed}" if failed else "")
        return solve
    return prepare


def _problem(dimension, operator, free, friction, storage):
    if storage == "dense":
        return numerics.FrictionContactProblem(dimension, len(friction), operator, free, friction)
    with tempfile.NamedTemporaryFile("w", suffix=".dat", delete=False) as file:
        file.write(block_text(dimension, operator, free, friction))
    try:
        return numerics.frictionContact_new_from_filename(file.name)
    finally:
        os.unlink(file.name)


def block_text(dimension, operator, free, friction):
    """Siconos's own text of a problem with W as sparse blocks, every number to its last digit."""
    n = len(friction)
    parts = operator.reshape(n, dimension, n, dimension).transpose(0, 2, 1, 3)
    kept = np.argwhere((parts != 0.0).any(axis=(2, 3)) | np.eye(n, dtype=bool))
    sizes = " ".join(str(dimension * (k + 1)) for k in range(n))
    starts = np.searchsorted(kept[:, 0], np.arange(n + 1))
    lines = [f"{dimension}\n{n}\n1\n{dimension * n}\n{dimension * n}", str(len(kept)), f"{n}\n{n}",
             sizes, sizes, str(n + 1), str(len(kept)),
             " ".join(map(str, starts)), " ".join(map(str, kept[:, 1]))]
    for number, (row, column) in enumerate(kept):
        lines.append(str(number))
        lines += [repr(float(value)) for value in parts[row, column].T.ravel()]
    lines += [repr(float(value)) for value in free]
    lines += [repr(float(value)) for value in friction]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    serve(load)
