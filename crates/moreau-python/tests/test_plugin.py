"""The pytest plugin on the example project: it passes, and its planted mistake fails as it should."""
import shutil

import moreau_contact as mc
import pytest
from conftest import PROJECT

BALL = len(mc.checks("ball/"))


@pytest.fixture
def project(pytester, monkeypatch):
    """A copy of examples/python, in a process of its own."""
    for name in ("toy_engine.py", "conftest.py", "test_physics.py"):
        shutil.copy(PROJECT / name, pytester.path / name)
    monkeypatch.delenv("TOY_BUG", raising=False)
    return lambda *words: pytester.runpytest_subprocess("-p", "no:cacheprovider", *words)


def test_one_test_per_check_and_step_with_markers_by_family(project):
    result = project("--moreau-only", "ball/", "--moreau-only", "flight/projectile", "--moreau-steps", "1/60,1/240", "-v")
    result.assert_outcomes(passed=2 * BALL + 2)
    result.stdout.fnmatch_lines(["*flight/projectile@1/240* PASSED*", "*ball/restitution@1/60* PASSED*"])
    project("--moreau-only", "ball/", "--moreau-only", "flight/projectile", "--moreau-steps", "1/60", "-m", "moreau_flight").assert_outcomes(
        passed=1, deselected=BALL)


def test_a_mistake_fails_with_what_was_expected_measured_derived_and_drawn(project, monkeypatch, pytester):
    monkeypatch.setenv("TOY_BUG", "1")
    result = project("--moreau-only", "ball/restitution", "--moreau-steps", "1/240", "--junit-xml", "out.xml")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*(ball/restitution at h = 1/240 s: fail)*", "*✗ *measured*expected*", "*derivation: *", "*plot: *.svg*"])
    pictures = list((pytester.path / "moreau-plots").glob("*.svg"))
    assert len(pictures) == 1 and pictures[0].read_text().startswith("<svg")
    assert "ball/restitution@1/240" in (pytester.path / "out.xml").read_text()


@pytest.mark.parametrize("way", [(), ("--moreau-isolate",)])
def test_a_mistake_that_the_probes_see_is_named_beside_every_failure_that_it_explains(project, monkeypatch, way):
    monkeypatch.setenv("TOY_BUG", "1")
    # with it pytest's short summary has whole messages, which the plugin makes one line
    monkeypatch.setenv("CI", "true")
    result = project("--moreau-only", "ball/restitution", "--moreau-steps", "1/60,1/240", *way)
    result.assert_outcomes(failed=2)
    assert sum(line.startswith("FAILED ") for line in result.outlines) == 2
    assert sum(line.startswith("derivation: ") for line in result.outlines) == 2
    named = [line for line in result.outlines if line.startswith("adapter, simulate/restitution: ") and "; use the scene's pair value" in line]
    assert len(named) == 2, result.outlines


def test_an_adapter_is_not_blamed_for_what_no_probe_sees(project, pytester):
    pytester.path.joinpath("conftest.py").write_text(
        "import pytest\nfrom toy_engine import Toy\n"
        "class Windy(Toy):\n    def simulate(self, *question):\n        motion = super().simulate(*question)\n"
        "        (track,) = motion['bodies']\n"
        # the flights of the probes are shorter than half a second
        "        track['linear_velocity'][-1] = track['linear_velocity'][-1] * [1.1 if question[0]['duration'] > 0.5 else 1, 1, 1]\n        return motion\n"
        "@pytest.fixture(scope='session')\ndef moreau_engine():\n    return Windy\n")
    result = project("--moreau-only", "flight/projectile", "--moreau-steps", "1/60,1/240")
    result.assert_outcomes(failed=2)
    assert not any(line.startswith("adapter, ") for line in result.outlines), result.outlines


def test_what_the_engine_cannot_express_is_skipped(project):
    project("--moreau-only", "incline/stick", "--moreau-steps", "1/60").assert_outcomes(skipped=2)


def test_a_baseline_is_saved_and_a_regression_fails(project, monkeypatch):
    words = ("--moreau-only", "ball/", "--moreau-steps", "1/60,1/240")
    project(*words, "--moreau-save-baseline", "baseline.toml").assert_outcomes(passed=2 * BALL)
    project(*words, "--moreau-baseline", "baseline.toml").assert_outcomes(passed=2 * BALL)
    monkeypatch.setenv("TOY_BUG", "1")
    result = project(*words, "--moreau-baseline", "baseline.toml", "-k", "ball/restitution")
    result.stdout.fnmatch_lines(["*(ball/restitution at h = 1/60 s: worse than the baseline)*"])
    assert result.ret == 1


def test_a_project_without_an_engine_is_told_what_to_do(project, pytester):
    (pytester.path / "conftest.py").unlink()
    result = project("--moreau-only", "ball/restitution", "--moreau-steps", "1/60")
    result.stdout.fnmatch_lines(["*define a fixture `moreau_engine`*"])
    assert result.ret == 1


@pytest.mark.parametrize(
    ("words", "told"),
    [(["--moreau-only", "bal/"], "*no check contains `bal/`*"), (["--moreau-steps", "1/0"], "*`steps`: has '1/0'*"),
     (["--moreau-baseline", "absent.toml"], "*absent.toml*")],
)
def test_what_is_wrong_with_the_options_is_told_before_anything_is_measured(project, words, told):
    result = project(*words)
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines([told])


def test_a_hanging_engine_is_ended_by_the_time_limit(project, pytester):
    pytester.path.joinpath("conftest.py").write_text(
        "import pytest, time\nfrom toy_engine import Toy\n"
        "class Hanging(Toy):\n    def simulate(self, *_):\n        time.sleep(1000)\n"
        "@pytest.fixture(scope='session')\ndef moreau_engine():\n    return Hanging\n")
    result = project("--moreau-only", "ball/restitution", "--moreau-steps", "1/60", "--moreau-isolate", "--moreau-time-limit", "8")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*no reply within 8*"])
