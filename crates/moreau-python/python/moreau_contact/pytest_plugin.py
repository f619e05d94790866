"""pytest: an engine behind a fixture, one test per check and time step.

    # conftest.py
    @pytest.fixture(scope="session")
    def moreau_engine():
        return MyEngine

    # test_physics.py
    def test_physics(moreau_check):
        moreau_check()

Before the first one the probes of `moreau protocol-check` look at what the engine reports; tests that fail and that a probe may explain
say so.

`pytest --moreau-only ball/ --moreau-steps 1/60,1/240` chooses; `-m moreau_ball` chooses by family; `--moreau-baseline FILE`
holds every measurement against a stored run, which `--moreau-save-baseline FILE` makes. What the engine cannot express is skipped.
"""
from __future__ import annotations

import re
from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

import pytest

from . import _gate, _native
from ._errors import MoreauError

_FRACTIONS = {1.0 / under: f"1/{under}" for under in range(2, 1001)}


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise ValueError("use a whole number from 1")
    return int(text)


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("moreau", "contact simulators through the checks of moreau")
    group.addoption("--moreau-steps", metavar="STEPS", default="quick",
                    help="time steps [s]: quick (default), full, or a list such as 1/60,1/240,0.001")
    group.addoption("--moreau-only", metavar="WORD", action="append", default=[], help="only checks whose names contain the word; again for more")
    group.addoption("--moreau-skip", metavar="WORD", action="append", default=[], help="no checks whose names contain the word; again for more")
    group.addoption("--moreau-baseline", metavar="FILE", type=Path, help="what became worse than this stored run fails, and not what is bad")
    group.addoption("--moreau-save-baseline", metavar="FILE", type=Path, help="store what was measured; known issues of the file are not kept")
    group.addoption("--moreau-repeats", metavar="N", type=_count, default=None,
                    help="how often each check is measured; 3 with --moreau-save-baseline, else 1")
    group.addoption("--moreau-plots", metavar="FOLDER", type=Path, default=Path("moreau-plots"),
                    help="where pictures of motions that fail are drawn (moreau-plots)")
    group.addoption("--moreau-isolate", action="store_true", help="run the engine's class in a child under a time limit")
    group.addoption("--moreau-time-limit", metavar="SECONDS", type=float, default=60.0, help="of a reply of an isolated engine (60)")


def pytest_configure(config: pytest.Config) -> None:
    for family in sorted({check["family"] for check in _gate.checks()}):
        config.addinivalue_line("markers", f"moreau_{_word(family)}: checks {family}/… of a contact simulator")
    config.stash[_PARTS] = []
    config.stash[_PROBED] = None
    if config.getoption("moreau_save_baseline") and (hasattr(config, "workerinput") or getattr(config.option, "numprocesses", None)):
        raise pytest.UsageError("--moreau-save-baseline: the workers of pytest-xdist would store a part each; leave out -n")
    try:
        steps = _gate.sweep(_steps(config))
        _gate.checks(config.getoption("moreau_only"), config.getoption("moreau_skip"))
        _gate.check_baseline(config.getoption("moreau_baseline"), steps)
    except MoreauError as error:
        raise pytest.UsageError(str(error)) from error


_PARTS: pytest.StashKey[list[_native.Report]] = pytest.StashKey()
#: The report before which the adapter was probed.
_PROBED: pytest.StashKey[_native.Report | None] = pytest.StashKey()


@pytest.fixture(scope="session")
def moreau_engine() -> Any:
    """Give the class of your engine by a fixture of this name."""
    pytest.fail("no engine: define a fixture `moreau_engine` that returns its class, in conftest.py", pytrace=False)


@pytest.fixture(scope="session")
def moreau_options() -> dict[str, Any]:
    """Options for every question to the engine; none by default."""
    return {}


@pytest.fixture
def moreau_check(request: pytest.FixtureRequest, moreau_engine: Any, moreau_options: dict[str, Any]) -> Callable[[], None]:
    """Measures one check at one time step, and fails the test where it is bad."""
    check, step = request.param

    def measure() -> None:
        config = request.config
        report = _measured(config, moreau_engine, check, step, moreau_options)
        config.stash[_PARTS].append(report)
        outcome = report.checks[0]
        request.node.user_properties.append(("moreau_verdict", outcome["verdict"]))
        if (baseline := config.getoption("moreau_baseline")) is not None:
            changes = report.compare(baseline).changes or []
            worse = [change["what"] for change in changes if change["kind"] == "regression" and change["check"] == outcome["check"]]
            if worse:
                pytest.fail(_told(config, request.node.name, check, step, report, worse), pytrace=False)
        elif outcome["verdict"] in ("fail", "errored"):
            pytest.fail(_told(config, request.node.name, check, step, report, []), pytrace=False)
        if outcome["verdict"] == "unsupported":
            pytest.skip(outcome.get("reason", "the engine cannot express the question"))

    return measure


def _measured(config: pytest.Config, engine: Any, check: dict[str, Any], step: float | None, options: dict[str, Any]) -> _native.Report:
    repeats = config.getoption("moreau_repeats") or (3 if config.getoption("moreau_save_baseline") else 1)
    steps = [step] if step is not None else _gate.sweep(_steps(config))
    limit = config.getoption("moreau_time_limit") if config.getoption("moreau_isolate") else None
    probed = config.stash[_PROBED]
    report = _gate.gate_one(engine, check["check"], steps, options, repeats, limit, probed is None)
    if probed is None:
        config.stash[_PROBED] = probed = report
    return report.with_adapter_of(probed)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "moreau_check" not in metafunc.fixturenames:
        return
    config = metafunc.config
    steps = _gate.sweep(_steps(config))
    cases = []
    for check in _gate.checks(config.getoption("moreau_only"), config.getoption("moreau_skip")):
        mark = getattr(pytest.mark, f"moreau_{_word(check['family'])}")
        for step in steps if check["each_time_step"] else [None]:
            at = "" if step is None else f"@{_FRACTIONS.get(step, repr(step))}"
            cases.append(pytest.param((check, step), id=f"{check['check']}{at}", marks=mark))
    metafunc.parametrize("moreau_check", cases, indirect=True)


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, Any, None]:
    """The short summary and the message in JUnit's file have the first line; where the variable CI is set, pytest would repeat all."""
    report = (yield).get_result()
    crash = getattr(report.longrepr, "reprcrash", None)
    if report.failed and crash is not None and any(name == "moreau_verdict" for name, _ in item.user_properties):
        crash.message = crash.message.splitlines()[0]


def pytest_sessionfinish(session: pytest.Session) -> None:
    file, parts = session.config.getoption("moreau_save_baseline"), session.config.stash[_PARTS]
    if file is None or not parts:
        return
    try:
        _native.Report.joined(parts).write(baseline=file)
    except MoreauError as error:
        session.exitstatus = pytest.ExitCode.USAGE_ERROR
        reporter = session.config.pluginmanager.get_plugin("terminalreporter")
        if reporter is not None:
            reporter.write_line(f"--moreau-save-baseline: nothing is stored: {error}", red=True)


def _steps(config: pytest.Config) -> Any:
    given = config.getoption("moreau_steps")
    return given if given in ("quick", "full") else given.split(",")


def _word(family: str) -> str:
    return re.sub(r"\W", "_", family)


def _told(config: pytest.Config, name: str, check: dict[str, Any], step: float | None, report: _native.Report, worse: list[str]) -> str:
    """What was expected and measured, why, and where the picture is."""
    outcome = report.checks[0]
    measurements = sorted((one for at in outcome["steps"] for one in at["measurements"]), key=_holds)
    at = "" if step is None else f" at h = {_FRACTIONS.get(step, repr(step))} s"
    # the first line is what pytest's summary shows
    headline = worse[0] if worse else outcome.get("reason") or _short(measurements)
    lines = [f"{headline} ({check['check']}{at}: {'worse than the baseline' if worse else outcome['verdict']})"]
    lines += [f"also: {what}" for what in worse[1:]]
    lines += [f"question: {check['question']}"]
    for measured in measurements:
        unit = "" if measured["unit"] == "1" else f" {measured['unit']}"
        mark = " " if _holds(measured) else "✗"
        lines.append(f"{mark} {measured['quantity']}: measured {measured['value']:.6g}{unit}, expected {_expected(measured, unit)}")
    lines += [f"adapter, {probe['probe']}: {probe['why']}; {probe['cure']}" for probe in report.explaining(check["check"])]
    lines.append(f"derivation: {check['derivation']}")
    picture = report.motion_svg()
    if picture is not None:
        file = config.getoption("moreau_plots") / (re.sub(r"[^\w.-]+", "_", name).strip("_") + ".svg")
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(picture, encoding="utf-8")
            lines.append(f"plot: {file}")
        except OSError as error:
            lines.append(f"plot: could not be written: {error}")
    return "\n".join(lines)


def _short(measurements: list[dict[str, Any]]) -> str:
    """The first measurement that fails, in a few words."""
    if not measurements:
        return "nothing was measured"
    first = measurements[0]
    expected = first.get("model") or first["ideal"]
    return f"{first['quantity']}: {first['value']:.3g}, not {expected['value']:.3g}"


def _expected(measured: dict[str, Any], unit: str) -> str:
    words = {"equal": "", "at-most": "at most ", "at-least": "at least "}

    def of(expected: dict[str, Any]) -> str:
        return f"{words[expected['relation']]}{expected['value']:.6g} ± {expected['tolerance']:.2g}{unit} ({expected['why']})"

    declared = measured.get("model")
    return of(measured["ideal"]) + (f"; by the declared law {of(declared)}" if declared else "")


def _holds(measured: dict[str, Any]) -> bool:
    """Whether the value is as the declared law says, or without one as the ideal does."""
    expected = measured.get("model") or measured["ideal"]
    off = measured["value"] - expected["value"]
    miss = {"equal": abs(off), "at-most": off, "at-least": -off}[expected["relation"]]
    return bool(miss <= expected["tolerance"])
