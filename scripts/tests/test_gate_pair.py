"""What the family `pair` of the gate says of the example engines: correct members pass, mistakes between two bodies fail."""

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

# the checks that must catch a mistake, at both steps
CAUGHT = {
    "pair-friction-zero": {"oblique-spheres", "ball-on-box", "plank-on-plank"},
    "pair-friction-tripled": {"oblique-spheres", "ball-on-box", "plank-on-plank"},
    "pair-friction-turns-one": {"oblique-spheres", "ball-on-box"},
    "pair-friction-on-one": {"oblique-spheres", "ball-on-box"},
    "pair-levers-exchanged": {"oblique-spheres", "crossed-bars", "ball-on-box"},
    "sphere-through-box": {"ball-on-box"},
    "sphere-on-box-frictionless": {"ball-on-box"},
    "no-edge-edge": {"crossed-bars"},
    "pairs-ignored": {"material-pairs"},
    "restitution-of-first-contact": {"material-pairs"},
    "tangential-restitution": {"oblique-spheres", "ball-on-box"},
    "box-before-ball-lost": {"central", "off-centre", "ball-on-box"},
    "box-before-ball-lever-reversed": {"ball-on-box"},
    "ball-on-unturned-box": {"off-centre"},
    "ball-on-faces-only": {"off-centre"},
    "ball-on-edge-by-face-normal": {"off-centre"},
    "ball-on-turned-box-smooth": {"ball-on-box"},
    "ball-pushes-centre-of-box": {"off-centre"},
    "second-box-pushed-at-centre": {"rough-corner"},
    "bouncing-boxes-smooth": {"rough-corner"},
    "rough-boxes-plastic": {"rough-corner"},
    "box-restitution-at-most-0.6": {"central"},
    "box-faces-plastic": {"central"},
    "box-faces-restitution-squared": {"central"},
    "ball-on-box-plastic-over-ground": {"central"},
    "pair-threshold-1mps": {"central"},
    "box-threshold-0.5mps": {"central"},
    "mass-at-most-100": {"central"},
    "mass-at-least-0.1": {"central"},
    "given-inertia-ignored": {"off-centre"},
    "edge-normal-by-an-axis": {"crossed-bars"},
    "faces-bounce-in-the-middle": {"faces"},
    "asleep-until-hit": {"support-leaves"},
    "supported-slide-along-x-only": {"plank-on-plank"},
}
# none of these may fail; a difference is as declared
CORRECT = [["gauss_seidel.py"], ["gauss_seidel.py", "--activation", "speculative", "--theta", "1"],
           ["gauss_seidel.py", "--cone", "pyramid", "--point", "second"], ["gauss_seidel.py", "--precision", "single"],
           ["pyramid_lemke.py"]]


def verdicts(command, only="pair/"):
    """{check: (verdict, steps that fail)} of the gate."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        subprocess.run([MOREAU, "gate", "--steps", STEPS, "--only", only, "--out", str(report), "--", sys.executable,
                        str(FOLDER / command[0]), *command[1:]], capture_output=True, check=False)
        checks = json.loads(report.read_text(encoding="utf-8"))["checks"]
    return {check["check"].removeprefix("pair/"): check for check in checks}


@unittest.skipUnless(MOREAU, "set MOREAU to the program")
class Pair(unittest.TestCase):
    def test_every_mistake_between_two_bodies_is_caught_at_every_step(self):
        for mutant, expected in CAUGHT.items():
            for name in sorted(expected):
                with self.subTest(mutant=mutant, check=name):
                    found = verdicts(["gauss_seidel.py", "--mutant", mutant], f"pair/{name}")[name]
                    self.assertEqual([step["verdict"] for step in found["steps"]], ["fail", "fail"])

    def test_correct_engines_pass(self):
        for command in CORRECT:
            with self.subTest(command=command):
                found = {name: check["verdict"] for name, check in verdicts(command).items()}
                self.assertLessEqual(set(found.values()), {"pass", "difference", "unsupported"}, found)
                self.assertIn(found["oblique-spheres"], {"pass", "difference"})


if __name__ == "__main__":
    unittest.main()
