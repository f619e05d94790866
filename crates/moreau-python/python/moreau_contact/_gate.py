"""The gate: a simulator through every check, in this process or in a child."""
from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from . import _engine, _native
from ._errors import InvalidInput

_registry = json.loads(_native.checks())
#: The time steps of the quick sweep [s].
QUICK: tuple[float, ...] = tuple(_registry["quick"])
#: The time steps of the whole sweep [s].
SWEEP: tuple[float, ...] = tuple(_registry["sweep"])


def checks(only: str | Sequence[str] = (), skip: str | Sequence[str] = ()) -> list[dict[str, Any]]:
    """The checks whose names contain a word of `only` and none of `skip`: name, family, question, derivation, source, …

    >>> [check["check"] for check in checks("projection/")]
    ['projection/regions', 'projection/boundaries', 'projection/optimality']
    """
    wanted, unwanted = _words(only), _words(skip)
    for name, words in (("only", wanted), ("skip", unwanted)):
        for word in words:
            if not any(word in check["check"] for check in _registry["checks"]):
                cure = "`moreau_contact.checks()` has every check"
                raise InvalidInput(f"`{name}`: no check contains `{word}`; {cure}", name, f"no check contains `{word}`", cure)
    return [
        check for check in _registry["checks"]
        if (not wanted or any(word in check["check"] for word in wanted)) and not any(word in check["check"] for word in unwanted)
    ]


def gate(
    engine: Any,
    *,
    only: str | Sequence[str] = (),
    skip: str | Sequence[str] = (),
    steps: str | float | Sequence[float | str] = "quick",
    options: Mapping[str, Any] | None = None,
    baseline: str | os.PathLike[str] | None = None,
    isolate: bool = False,
    jobs: int = 1,
    repeats: int = 1,
    time_limit: float = 60.0,
    start_limit: float | None = None,
    progress: Callable[[str, str, float], object] | None = None,
) -> _native.Report:
    """Runs checks on an engine.

    Parameters
    ----------
    engine : a class (or a function that makes an object) with `describe(options)` and what it can of
        `simulate(scene, time_step, sample_every, options)`, `solve(problem, options)` and `project(friction, points, options)`:
        dicts as in docs/protocol.md. Or the command of a program that speaks moreau-engine/1, a list of words.
    only, skip : words that names of checks contain, such as "ball/".
    steps : "quick" (three time steps), "full" (nine), or time steps [s], also as "1/240".
    options : options for the engine.
    baseline : a file of `Report.write(baseline=…)`; then what became worse counts, and not what is bad.
    isolate : run the class in a child under time limits. In this process an engine that hangs cannot be stopped, and one that
        crashes takes Python with it; Ctrl-C reaches an engine that runs Python code, and code of C when it returns.
    jobs : engines at once; more than one is of use for commands and isolated classes.
    repeats : how often all is measured; 3 give a baseline its spread.
    time_limit, start_limit : seconds for a reply, and for the first, of a command or an isolated class.

    progress : called after each check with its name, verdict and seconds; on a terminal a bar is shown as well. All checks
        of the quick sweep are hundreds of motions in steps of down to 1 ms: an engine in pure Python takes minutes.

    Returns
    -------
    A Report, true where nothing is bad. `print` shows the table; `checks` has every number.
    """
    names = [check["check"] for check in checks(only, skip)]
    if not names:
        raise InvalidInput("`only`: selects no check together with `skip`", "only", "selects no check", "leave one of the two out")
    if isinstance(engine, str):
        cure = "give a class, or the command as a list of words"
        raise InvalidInput(f"`engine`: is a text; {cure}", "engine", "is a text", cure)
    if _engine.is_child:
        cure = "put the call under `if __name__ == \"__main__\":`"
        raise InvalidInput(f"`engine`: this process serves a class, and its file calls the gate while it is imported; {cure}", "engine",
                           "its file calls the gate while it is imported", cure)
    command: list[str] = []
    if isinstance(engine, (list, tuple)):
        command, engine = [os.fspath(word) for word in engine], None
    elif isolate:
        command, engine = _engine.command(engine), None
    for name, number in (("jobs", jobs), ("repeats", repeats)):
        if number < 1:
            raise InvalidInput(f"`{name}`: is {number}; use a whole number from 1", name, f"is {number}", "use a whole number from 1")
    wanted = sweep(steps)
    check_baseline(baseline, wanted)
    report = _native.gate(
        engine, command, names, wanted, _engine.text_of(_options(options)), jobs, repeats, time_limit,
        time_limit if start_limit is None else start_limit, True, progress,
    )
    return report if baseline is None else report.compare(baseline)


def sweep(steps: str | float | Sequence[float | str]) -> list[float]:
    """The time steps [s] that are meant."""
    if isinstance(steps, str) and steps in ("quick", "full"):
        return list(QUICK if steps == "quick" else SWEEP)
    given = steps.split(",") if isinstance(steps, str) else [steps] if isinstance(steps, (int, float)) else list(steps)
    found = [seconds(step) for step in given]
    if not found or len(set(found)) < len(found):
        problem = "is empty" if not found else "names a time step twice"
        raise InvalidInput(f"`steps`: {problem}; name each time step once", "steps", problem, "name each time step once")
    return found


def check_baseline(file: str | os.PathLike[str] | None, steps: Sequence[float]) -> None:
    """Refuses a baseline that cannot be read or lacks a time step, before anything is asked of an engine."""
    if file is None:
        return
    stored = _native.baseline_steps(file)
    missing = [step for step in steps if step not in stored]
    if missing:
        cure = f"it has {stored}; ask for these, or make a new one"
        raise InvalidInput(f"`baseline`: {file} has no time step {missing}; {cure}", "baseline", f"has no time step {missing}", cure)


class ProtocolCheck(NamedTuple):
    """What `moreau protocol-check` says of an engine; it is true where all is well."""

    sound: bool
    text: str

    def __bool__(self) -> bool:
        return self.sound

    def __str__(self) -> str:
        return self.text


def protocol_check(engine: Any, *, time_limit: float = 60.0) -> ProtocolCheck:
    """What `moreau protocol-check` says of an engine, a class at the top of a file or a command: `sound` and the `text`; print it.

    The class runs in a child. Whether it reports what the protocol means is asked here; whether it simulates well, by `gate`.
    """
    command = [os.fspath(word) for word in engine] if isinstance(engine, (list, tuple)) else _engine.command(engine)
    text, _, sound = _native.protocol_check(command, time_limit)
    return ProtocolCheck(sound, text)


def _options(options: Mapping[str, Any] | None) -> dict[str, Any]:
    if options is not None and not isinstance(options, Mapping):
        raise InvalidInput("`options`: is no mapping; give a dict", "options", "is no mapping", "give a dict")
    return dict(options or {})


def seconds(step: float | str) -> float:
    """A number of seconds, also as a fraction."""
    try:
        number = float(step) if not isinstance(step, str) or "/" not in step else _quotient(step)
    except (TypeError, ValueError, ZeroDivisionError):
        number = -1.0
    if not 0.0 < number < float("inf"):
        cure = "use \"quick\", \"full\", or positive seconds such as 0.001 or \"1/240\""
        raise InvalidInput(f"`steps`: has {step!r}; {cure}", "steps", f"has {step!r}", cure)
    return number


def _quotient(text: str) -> float:
    over, under = text.split("/")
    return float(Fraction(over.strip()) / Fraction(under.strip()))


def _words(given: str | Sequence[str]) -> list[str]:
    return [given] if isinstance(given, str) else list(given)


def gate_one(
    engine: Any, name: str, steps: Sequence[float], options: Mapping[str, Any], repeats: int, limit: float | None, probes: bool
) -> _native.Report:
    """One check, what the pytest plugin measures test by test, before it the probes of the adapter if they are wanted; in a child
    where there is a limit."""
    command: list[str] = []
    if limit is not None:
        command, engine = _engine.command(engine), None
    return _native.gate(engine, command, [name], list(steps), _engine.text_of(_options(options)), 1, repeats, limit or 60.0, limit or 60.0, probes)
