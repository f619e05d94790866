"""The gate on engines that are Python classes: in this process, in a child, and as a command."""
import json
import os
import signal
import subprocess
import sys
import threading
import time

import moreau_contact as mc
import numpy as np
import pytest
import toy_engine
from conftest import CHECKOUT, PROJECT
from toy_engine import Toy

DESCRIPTION = {"name": "tester", "version": "1", "precision": "double", "restitution": True, "friction": "none", "reports_contacts": False,
               "levels": ["project"], "contact_model": {"kind": "rigid", "law": "coulomb"}}


class Projector:
    """Projections on friction cones."""

    def describe(self, options):
        return DESCRIPTION

    def project(self, friction, points, options):
        return [self.nearest(friction, np.array(point)) for point in points]

    def nearest(self, mu, point):
        n, t = point[0], np.linalg.norm(point[1:])
        if n >= 0 and t <= mu * n:
            return point
        if mu * t <= -n:
            return 0 * point
        normal = (n + mu * t) / (1 + mu * mu)
        return np.concatenate([[normal], mu * normal * point[1:] / t])


class Sleeper(Projector):
    def project(self, friction, points, options):
        while True:
            time.sleep(0.01)


class Raiser(Projector):
    def project(self, friction, points, options):
        raise ZeroDivisionError("planted")


class Crasher(Projector):
    def project(self, friction, points, options):
        os._exit(7)


def test_a_right_engine_passes_and_a_mistake_fails(monkeypatch):
    assert mc.gate(Projector, only="projection/")
    report = mc.gate(Toy, only="ball/restitution", steps=["1/240"])
    assert report and report.counts["pass"] == 1 and "ball/restitution" in str(report)
    monkeypatch.setattr(toy_engine, "BUG", True)
    broken = mc.gate(Toy, only="ball/restitution", steps=["1/240"])
    assert not broken and broken.counts["fail"] == 1


def test_the_report_is_that_of_the_command(command, tmp_path):
    command("gate", "--only", "ball/", "--steps", "1/60", "--out", "theirs.json", "--", "python3", CHECKOUT / "examples" / "toy_engine.py")
    theirs = json.loads((tmp_path / "theirs.json").read_text())
    ours = json.loads(mc.gate(Toy, only="ball/", steps=["1/60"]).to_json())
    assert ours["checks"] == theirs["checks"]


def test_exceptions_are_the_engines_answers():
    report = mc.gate(Raiser, only="projection/regions")
    (check,) = report.checks
    assert check["verdict"] == "errored" and "ZeroDivisionError: planted at test_gate.py:" in check["reason"]
    with pytest.raises(mc.InvalidInput, match="list of words"):
        mc.gate("python3 engine.py")
    with pytest.raises(mc.EngineError, match="describe"):
        mc.gate(object, only="projection/regions")
    report = mc.gate(Projector, only="ball/restitution")
    assert not report and report.counts["unsupported"] == 1, "where nothing is answered, nothing passed"


def test_a_child_is_held_to_its_limits_and_may_crash():
    report = mc.gate(Sleeper, only="projection/regions", isolate=True, time_limit=8.0)
    assert "no reply within 8" in report.checks[0]["reason"] and report.counts["errored"] == 1
    assert mc.gate(Crasher, only="projection/regions", isolate=True).counts["errored"] == 1
    assert mc.gate(Projector, only="projection/", isolate=True, jobs=2)
    assert mc.gate(Toy, only="ball/restitution", steps=["1/240"], isolate=True)


def test_a_class_that_no_child_can_import_is_refused():
    class Inner(Projector):
        pass

    with pytest.raises(mc.InvalidInput, match="top of a file"):
        mc.gate(Inner, only="projection/", isolate=True)


def test_a_script_that_gates_while_it_is_imported_is_told_and_starts_no_chain_of_children(tmp_path):
    script = tmp_path / "script.py"
    text = "import moreau_contact as mc\nfrom toy_engine import Toy\nclass Mine(Toy): pass\nprint('begun')\n{}"
    call = "print(mc.gate(Mine, only='ball/restitution', steps=['1/60'], isolate=True))\n"
    run = lambda: subprocess.run([sys.executable, script], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(PROJECT)}, timeout=60)  # noqa: E731
    script.write_text(text.format(call))
    assert "__main__" in run().stderr
    script.write_text(text.format("if __name__ == '__main__':\n    " + call))
    done = run()
    assert done.returncode == 0 and "1 pass" in done.stdout, done.stderr


def test_an_engine_is_served_and_its_adapter_checked(command, monkeypatch, tmp_path):
    told = mc.protocol_check(Toy)
    assert told and told.sound and "describe" in str(told), told.text
    monkeypatch.setenv("TOY_BUG", "1")
    told = mc.protocol_check(Toy)
    assert not told and not told.sound and "restitution 0.5 was asked for" in told.text
    monkeypatch.delenv("TOY_BUG")
    (tmp_path / "served.py").write_text("import moreau_contact as mc\nfrom toy_engine import Toy\nmc.serve(Toy)\n")
    os.environ["PYTHONPATH"] = str(PROJECT)
    try:
        assert "1 pass" in command("gate", "--only", "ball/restitution", "--steps", "1/60", "--", sys.executable, "served.py")
    finally:
        del os.environ["PYTHONPATH"]


def test_finished_checks_are_heard():
    heard = []
    mc.gate(Projector, only="projection/", progress=lambda name, verdict, seconds: heard.append((name, verdict, seconds >= 0)))
    assert heard == [(check["check"], "pass", True) for check in mc.checks("projection/")]


@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("isolate", [False, True])
def test_ctrl_c_ends_the_run(isolate):
    threading.Timer(3.0, os.kill, (os.getpid(), signal.SIGINT)).start()
    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        mc.gate(Sleeper, only="projection/", isolate=isolate)
    assert time.perf_counter() - begin < 45, "a reply may take 60 s"


def test_a_class_that_its_file_does_not_have_is_not_judged_by_another():
    broken = type("Projector", (Projector,), {"project": lambda self, friction, points, options: points, "__module__": __name__})
    assert not mc.gate(broken, only="projection/")
    with pytest.raises(mc.InvalidInput, match="another class"):
        mc.gate(broken, only="projection/", isolate=True)
    with pytest.raises(mc.InvalidInput, match="no class"):
        mc.gate(Projector(), only="projection/", isolate=True)


@pytest.mark.parametrize(
    "arguments",
    [{"only": "bal/"}, {"skip": "bal/"}, {"only": "ball/", "skip": "ball/"}, {"steps": []}, {"steps": ["1/0"]}, {"steps": [-1.0]},
     {"steps": [0.01, "1/100"]}, {"steps": "slow"}, {"jobs": 0}, {"repeats": 0}, {"time_limit": 0.0}, {"time_limit": float("nan")}],
)
def test_what_is_not_allowed_is_told(arguments):
    with pytest.raises(mc.InvalidInput) as caught:
        mc.gate(Projector, **arguments)
    assert caught.value.field in arguments


def test_baselines_are_written_compared_and_joined(tmp_path, monkeypatch):
    file = tmp_path / "baseline.toml"
    parts = [mc.gate(Toy, only="ball/restitution", steps=[step]) for step in ("1/240", "1/60")]
    whole = mc.gate(Toy, only="ball/restitution", steps=["1/60", "1/240"])
    assert mc.Report.joined(parts).checks == whole.checks
    mc.Report.joined(parts).write(baseline=file, json=tmp_path / "a.json", html=tmp_path / "a.html", junit=tmp_path / "a.xml")
    assert mc.gate(Toy, only="ball/restitution", steps=["1/60", "1/240"], baseline=file)
    assert parts[0].compare(file) and parts[0].compare(file).changes == []
    monkeypatch.setattr(toy_engine, "BUG", True)
    worse = mc.gate(Toy, only="ball/restitution", steps=["1/60"], baseline=file)
    assert not worse and worse.changes[0]["kind"] == "regression"
    with pytest.raises(mc.MoreauError, match="one engine"):
        mc.Report.joined([whole, mc.gate(Projector, only="projection/regions")])
