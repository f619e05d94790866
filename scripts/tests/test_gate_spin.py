"""The families spin and limits of the gate, and contact/pairs: mutants of the example engine fail at every step, correct members pass.

Needs the environment variable MOREAU, the path of the program.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "examples" / "engines"
STEPS = ("1/30", "1/60", "1/240")
#: mutant → the check that must fail at every step
CAUGHT = {
    "sphere-not-turned": "spin/free-sphere",
    "drilling-friction": "spin/drilling",
    "no-yaw-friction": "spin/flat-box",
    "explicit-gyroscopic-torque": "spin/gyroscopic",
    "speed-limit-100": "limits/fast",
    "spin-limit-50": "limits/fast",
    "static-friction-5-percent": "limits/stick",
    "sticks-up-to-0.97": "limits/stick",
    "points-nearer-than-5-cm-merged": "limits/small",
    "last-step-reported": "contact/pairs",
    "pair-impulses-doubled": "contact/pairs",
    "pair-impulses-reversed": "contact/pairs",
    "pair-impulses-unreported": "contact/pairs",
}
#: mutant → the check that fails at this step of the whole sweep and at none of STEPS
CAUGHT_LATE = {"gyroscopic-torque-early": ("spin/gyroscopic", "0.003")}
MEMBERS = (
    ["gauss_seidel.py", "--point", "middle", "--order", "reversed"],
    ["gauss_seidel.py", "--theta", "1", "--activation", "speculative"],
    ["gauss_seidel.py", "--precision", "single", "--substeps", "2"],
)


def report(engine, checks, steps):
    """The gate's report on an engine."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "report.json"
        only = [word for check in checks for word in ("--only", check)]
        command = [os.environ["MOREAU"], "gate", "--steps", ",".join(steps), *only, "--out", str(path), "--", sys.executable, *engine]
        subprocess.run(command, cwd=FOLDER, check=False, capture_output=True)
        return json.loads(path.read_text(encoding="utf-8"))


@unittest.skipUnless("MOREAU" in os.environ, "MOREAU is not set")
class SpinAndLimits(unittest.TestCase):
    def test_every_mutant_fails_at_every_step(self):
        for mutant, check in CAUGHT.items():
            with self.subTest(mutant):
                outcome, = report(["gauss_seidel.py", "--mutant", mutant], [check], STEPS)["checks"]
                self.assertEqual([step["verdict"] for step in outcome["steps"]], ["fail"] * len(STEPS))

    def test_a_mutant_that_grows_slowly_fails_over_a_thousand_turns_only_and_a_correct_member_does_not(self):
        for mutant, (check, late) in CAUGHT_LATE.items():
            with self.subTest(mutant):
                outcome, = report(["gauss_seidel.py", "--mutant", mutant], [check], (*STEPS, late))["checks"]
                self.assertEqual([step["verdict"] for step in outcome["steps"]], ["pass"] * len(STEPS) + ["fail"])
                outcome, = report(["gauss_seidel.py"], [check], (late,))["checks"]
                self.assertEqual(outcome["verdict"], "pass", outcome)

    def test_correct_members_pass(self):
        for member in MEMBERS:
            with self.subTest(member):
                for outcome in report(member, ["spin/", "limits/", "contact/pairs"], STEPS[:2])["checks"]:
                    self.assertEqual(outcome["verdict"], "pass", outcome)


if __name__ == "__main__":
    unittest.main()
