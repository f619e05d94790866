"""What the gate says of friction, pair values, drilling and sleep between bodies: correct members pass, mistakes fail at every step."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "engines"
MOREAU = os.environ.get("MOREAU")
STEPS = "1/30,1/240"

# a check that must catch a mistake, at both steps
CAUGHT = {
    "pair-friction-at-most-1": "pair/any-direction",
    "fast-slip-half-friction": "pair/any-direction",
    "heavier-first-rougher": "pair/any-direction",
    "spheres-smooth-under-gravity": "pair/any-direction",
    "ball-on-turned-box-smooth": "pair/any-direction",
    "pair-friction-half-along-one-tangent": "pair/any-direction",
    "pyramid-between-boxes": "pair/any-direction",
    "friction-of-boxes-at-their-centres": "pair/any-direction",
    "drilling-stopped-between-bodies": "pair/any-direction",
    "edges-without-friction": "pair/crossed-bars",
    "boxes-never-stick": "pair/held",
    "asleep-for-good": "pair/woken",
    "box-on-ground-friction-at-most-1": "pair/material-pairs",
    "own-values-of-boxes-ignored": "pair/material-pairs",
    "own-values-of-ball-and-box-ignored": "pair/material-pairs",
    "own-values-on-the-ground-ignored": "pair/material-pairs",
    "pairs-naming-the-ground-second-ignored": "pair/material-pairs",
}
CHECKS = sorted(set(CAUGHT.values()))
# none of these may fail; a difference is as declared
CORRECT = [["gauss_seidel.py"], ["gauss_seidel.py", "--theta", "1", "--precision", "single", "--cone", "pyramid"]]


def verdicts(command, checks):
    """{check: its outcome} of the gate."""
    only = [word for check in checks for word in ("--only", check)]
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        subprocess.run([MOREAU, "gate", "--steps", STEPS, *only, "--out", str(report), "--", sys.executable,
                        str(FOLDER / command[0]), *command[1:]], capture_output=True, check=False)
        return {check["check"]: check for check in json.loads(report.read_text(encoding="utf-8"))["checks"]}


@unittest.skipUnless(MOREAU, "set MOREAU to the program")
class Values(unittest.TestCase):
    def test_every_mistake_is_caught_at_every_step(self):
        for mutant, check in CAUGHT.items():
            with self.subTest(mutant=mutant, check=check):
                found = verdicts(["gauss_seidel.py", "--mutant", mutant], [check])[check]
                self.assertEqual([step["verdict"] for step in found["steps"]], ["fail", "fail"])

    def test_correct_engines_pass(self):
        for command in CORRECT:
            with self.subTest(command=command):
                found = {name: check["verdict"] for name, check in verdicts(command, CHECKS).items()}
                self.assertEqual(set(found), set(CHECKS))
                self.assertLessEqual(set(found.values()), {"pass", "difference"}, found)


if __name__ == "__main__":
    unittest.main()
