"""The exceptions of this package; every message says what is wrong and what cures it."""


class MoreauError(Exception):
    """Any error of this package."""


class InvalidInput(MoreauError, ValueError):
    """An argument or a field of a file that is not allowed.

    Attributes: `field`, its name; `problem`, what is wrong; `cure`, what would be accepted.
    """

    def __init__(self, message: str, field: str = "", problem: str = "", cure: str = "") -> None:
        super().__init__(message)
        self.field, self.problem, self.cure = field, problem, cure


class FileError(MoreauError, OSError):
    """A file that cannot be read or written; nothing is left half-written."""


class Unsupported(MoreauError):
    """What was asked is not possible. An engine raises it to say that it cannot express a question."""


class SolverError(MoreauError):
    """A solver that refuses a problem or ends without an answer.

    Attributes: `solver`, its name; `status`, one of refused, breakdown, ray, limit, infeasible.
    """

    def __init__(self, message: str, solver: str = "", status: str = "") -> None:
        super().__init__(message)
        self.solver, self.status = solver, status


class Rejected(SolverError):
    """An answer that the certificate rejects.

    Attributes: `solution`, the answer (a Solution, or the Motion of a simulation) with its certificate.
    """

    def __init__(self, message: str, solver: str, solution: object) -> None:
        super().__init__(message, solver, "rejected")
        self.solution = solution


class EngineError(MoreauError):
    """An engine that could not be run: it does not describe itself."""
