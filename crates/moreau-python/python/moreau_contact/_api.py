"""Solving, certifying, simulating, and the claims: the functions of the package, with their documentation."""
from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _native
from ._errors import InvalidInput
from ._gate import seconds

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

solvers = _native.solvers
scenes = _native.scenes


def solve(
    W: Any,
    u_free: ArrayLike | None = None,
    mu: ArrayLike | float | None = None,
    *,
    law: str | None = None,
    directions: int | None = None,
    shift: ArrayLike | None = None,
    solver: str = "auto",
    tolerance: float | None = None,
    iterations: int | None = None,
    warm_start: ArrayLike | _native.Solution | None = None,
    accept_rejected: bool = False,
) -> _native.Solution:
    """Solves a contact problem and certifies the answer.

    u = W r + u_free, and (r, u + shift) obeys the law at every contact.

    Parameters
    ----------
    W : a Problem, alone; or the Delassus operator [1/kg], rows × rows, an array or of scipy.sparse; or the tuple (M, H) of
        the mass matrix [kg], nv × nv, and the contact Jacobian, rows × nv.
    u_free : contact velocities without contact impulses, H v_free [m/s], one per row: normal, tangent₁, tangent₂ of the
        first contact, then of the second.
    mu : coefficients of friction, one number (contacts of 3 rows) or one per contact.
    law : "coulomb" (where it is absent), "associated", "frictionless", "polyhedral-coulomb" or "polyhedral-associated".
    directions : friction directions of a polyhedral law, 2 in the plane.
    shift : added to u in the law [m/s], one per row.
    solver : one of `solvers()`.
    tolerance : the largest relative residual that is accepted, 1e-8 if absent; where it is given, iterations stop at half of it.
    iterations : most sweeps, steps or pivots; the solver's own number if absent.
    warm_start : impulses [N·s] to begin with, one per row, or a Solution: contact by contact where its problem and this one have keys, zero
        for a contact that it does not know; by position elsewhere.
    accept_rejected : return an answer that the certificate rejects, and do not raise.

    Returns
    -------
    A Solution: `impulse` [N·s], `velocity` [m/s], `certificate`.

    Raises
    ------
    InvalidInput names the argument; SolverError where there is no answer, with `status` "infeasible" where it is proved that
    there is none; Rejected, with the answer as `solution`, where the certificate rejects it.

    >>> import numpy as np
    >>> block = solve(np.eye(2), [-1.0, 2.0], [0.5])   # 1 kg arrives at 1 m/s and slides at 2 m/s
    >>> block.impulse
    array([ 1. , -0.5])
    >>> bool(block.certificate)
    True
    """
    return _native.solve(
        W, u_free, mu, law=law, directions=directions, shift=shift, solver=solver, tolerance=tolerance, iterations=iterations,
        warm_start=warm_start, accept_rejected=accept_rejected,
    )


def certify(
    problem: _native.Problem,
    impulse: ArrayLike | _native.Solution,
    *,
    tolerance: float | None = None,
    velocity: ArrayLike | None = None,
) -> _native.Certificate:
    """Certifies an answer of any origin from its impulses alone.

    Parameters
    ----------
    problem : the Problem.
    impulse : r [N·s], one per row, or a Solution.
    tolerance : the largest residual that is accepted, relative to the scale of its contact; 1e-8 if absent. A solver in single
        precision cannot do better than 1e-6 or 1e-5: say so.
    velocity : your u [m/s], one per row, if it is to be compared with W r + u_free.

    Returns
    -------
    A Certificate, true where the answer is a solution; print it, or read `residuals` and, contact by contact, `contacts`.

    >>> import numpy as np
    >>> block = Problem(np.eye(2), [-1.0, 2.0], [0.5])
    >>> bool(certify(block, [1.0, -0.5])), bool(certify(block, [1.0, -0.4]))
    (True, False)
    """
    if not isinstance(problem, _native.Problem):
        cure = "give a Problem: Problem(W, u_free, mu), or Problem.read(file)"
        raise InvalidInput(f"`problem`: is a {type(problem).__name__}; {cure}", "problem", f"is a {type(problem).__name__}", cure)
    return _native.certify(problem, impulse, tolerance=tolerance, velocity=velocity)


def simulate(
    scene: str | os.PathLike[str] | Mapping[str, Any],
    *,
    scheme: str = "moreau-jean",
    step: float | str = 0.001,
    duration: float | None = None,
    solver: str = "auto",
    tolerance: float | None = None,
    accept_rejected: bool = False,
    **options: Any,
) -> _native.Motion:
    """Simulates a scene with a time-stepping scheme, and certifies every step.

    Parameters
    ----------
    scene : one of `scenes()`, a file scene/1, or its content as a dict.
    scheme : the scheme by its name on the command line (`moreau simulate --list`).
    step : h [s], also as "1/240".
    duration : [s]; the scene's own if absent.
    solver : the solver of the contact problems, one of `solvers()`.
    tolerance : the largest relative residual of a step that is accepted; 1e-8 if absent.
    accept_rejected : return a motion of which the certificate rejects steps, and do not raise.
    options : those of the scheme, such as theta=1.0, activation="D", restitution=0.5; `moreau simulate --help` has all.

    Returns
    -------
    A Motion: `times` [s], `q`, `v`, `body(name)`, `contacts`, `residuals`.

    >>> motion = simulate("bouncing-ball", step=0.01)
    >>> bool(abs(motion.body("ball")["linear_velocity"][-1]).max() < 1e-9)   # at rest after infinitely many bounces
    True
    """
    if isinstance(scene, Mapping):
        scene = dict(scene)
    words: list[str] = []
    for name, value in options.items():
        if not re.fullmatch("[a-z][a-z_]*", name) or name == "help":
            cure = "`moreau simulate --help` has the options of every scheme"
            raise InvalidInput(f"`{name}`: is no option of a scheme; {cure}", name, "is no option of a scheme", cure)
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is not False and value is not None:
            words += [option, str(value)]
    return _native.simulate(scene, scheme, step if isinstance(step, (int, float)) else seconds(step), duration, solver, tolerance, accept_rejected, words)


def claims(search: str | Sequence[str] | None = None) -> list[dict[str, Any]]:
    """The claims of the chapter as they are recorded: id, section, title, statement, verdict, kind, evidence, correct_statement, …

    Parameters
    ----------
    search : words that id, title, statement, correction and sources together must all have, in any case.

    >>> [claim["verdict"] for claim in claims("copositive-plus") if claim["id"] == "S4.copos-plus"]
    ['FALSE AS STATED']
    """
    words = search if isinstance(search, str) else " ".join(search or [])
    found: list[dict[str, Any]] = json.loads(_native.claims(words))
    return found


def verify(ids: str | Sequence[str | Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Judges claims now: ids or groups, such as "S4.copos-plus" or "S4", or records of `claims()`.

    Each record has `verdict`, what is known of the sentence; `status`, "supported" where the evidence just computed supports that
    verdict, also where the verdict is that the sentence is false; `findings` and `controls`.

    >>> verify("S4.copos-plus")[0]["status"]
    'supported'
    """
    names = [ids] if isinstance(ids, str) else [one["id"] if isinstance(one, Mapping) else one for one in ids]
    if not names:
        raise InvalidInput("`ids`: is empty; give at least one id or group", "ids", "is empty", "give at least one id or group")
    judged: list[dict[str, Any]] = json.loads(_native.verify(names))
    return judged


Problem = _native.Problem
