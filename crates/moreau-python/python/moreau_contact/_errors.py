"""The exceptions of this package; every message says what is wrong and what cures it."""
from __future__ import annotations

import sys
import warnings
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from . import _native


class MoreauError(Exception):
    """Any error of this package."""


class InvalidInput(MoreauError, ValueError):
    """An argument or a field of a file that is not allowed.

    Attributes: `field`, its name; `problem`, what is wrong; `cure`, what would be accepted.
    """

    def __init__(self, message: str, field: str = "", problem: str = "", cure: str = "") -> None:
        super().__init__(message)
        self.field, self.problem, self.cure = field, problem, cure

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        return type(self), (str(self), self.field, self.problem, self.cure)


class UnusualOperator(UserWarning):
    """A warning: W is not symmetric, or drives a contact against itself. It is taken as it stands, and answers are judged with it."""


class FileError(MoreauError, OSError):
    """A file that cannot be read or written; nothing is left half-written.

    Attributes, as of any OSError: `errno`, None where the system gave no number; `filename`.
    """

    def __init__(self, message: str, errno: int | None = None, filename: str | None = None) -> None:
        super().__init__(message)
        self.errno, self.filename = errno, filename

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        return type(self), (str(self), self.errno, self.filename)


class Unsupported(MoreauError):
    """What was asked is not possible. An engine raises it to say that it cannot express a question."""


class SolverError(MoreauError):
    """A solver that refuses a problem or ends without an answer.

    Attributes: `solver`, its name; `status`, one of refused, breakdown, ray, limit, infeasible.
    """

    def __init__(self, message: str, solver: str = "", status: str = "") -> None:
        super().__init__(message)
        self.solver, self.status = solver, status

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        return type(self), (str(self), self.solver, self.status)


class Rejected(SolverError):
    """An answer that the certificate rejects.

    Attributes: `solution`, the answer (a Solution, or the Motion of a simulation) with its certificate.
    """

    def __init__(self, message: str, solver: str = "", solution: object = None) -> None:
        super().__init__(message, solver, "rejected")
        self.solution = solution

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        solution = self.solution if hasattr(self.solution, "certificate") else None  # a motion stays where it is
        return type(self), (str(self), self.solver, solution)


class EngineError(MoreauError):
    """An engine that could not be run: it does not describe itself."""


def solution_again(text: str, problem: _native.Problem, tolerance: float) -> _native.Solution:
    """A solution that was copied or sent to another process, certified again."""
    from . import _native  # it imports this module

    return _native.Solution.from_json(text, problem, tolerance=tolerance)


def warn_of(text: str) -> None:
    """Warns of an unusual operator, at the line of the caller outside of this package."""
    depth, frame = 2, sys._getframe(1)
    while frame.f_back is not None and str(frame.f_globals.get("__name__")).partition(".")[0] == __package__:
        depth, frame = depth + 1, frame.f_back
    warnings.warn(text, UnusualOperator, stacklevel=depth)
