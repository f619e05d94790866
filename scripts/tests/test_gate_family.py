"""Correct engines that the gate once failed: members of examples/engines/family.json pass the checks that raised a false alarm, and a
mistake of the same kind still fails.

MOREAU=path of the program; without it these tests are skipped.
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "engines"
FAMILY = {one["name"]: one["command"] for one in json.loads((FOLDER / "family.json").read_text(encoding="utf-8"))["engines"]}
MOREAU = os.environ.get("MOREAU")

# Member, checks that failed it although it is correct, and why it differs.
ALARMS = [
    ("default", ["tumbling/bouncing"], "a contact that opens and is pressed asks for u ≥ 0, not for −e u"),
    ("point-middle", ["rolling/"], "the lever R − δ/2"),
    ("point-second", ["rolling/"], "the lever R − δ"),
    ("damping", ["impact/", "ball/energy", "incline/slide", "rolling/", "isotropy/deceleration", "contact/momentum", "rocking/",
                 "tumbling/momentum"], "declared damping"),
    ("error-reduction", ["incline/stick-threshold", "rocking/impact"], "declared error reduction"),
    ("threshold", ["ball/penetration", "ball/zeno"], "a declared restitution threshold"),
    ("damping-strong", ["tumbling/rough", "limits/stick"], "declared damping of a rate that shows"),
    ("error-reduction-large", ["ball/energy", "ball/restitution", "rest/drift", "rest/jitter", "metamorphic/body-order", "incline/stick"],
     "declared error reduction that opens contacts"),
    ("error-reduction-large", ["contact/increment", "pair/held"], "declared error reduction that opens contacts"),
    ("spring", ["pair/oblique-spheres"], "a spring that lasts turns its normal"),
    ("position-correction", ["ball/energy", "energy/passive", "rocking/impact", "tumbling/passive", "tumbling/bouncing", "tumbling/rough"],
     "a declared correction of the position"),
    ("pyramid-second", ["contact/dissipation"], "a pyramid whose impulses act below the surface"),
    ("error-reduction", ["spin/flat-box", "conveyor/box", "pair/plank-on-plank"], "declared error reduction that opens contacts"),
    ("position-correction", ["spin/flat-box", "conveyor/box", "pair/plank-on-plank"], "a declared correction that opens contacts"),
    ("pyramid", ["conveyor/box", "pair/plank-on-plank"], "a pyramid, of which a part of μ acts"),
    ("single", ["conveyor/box", "pair/plank-on-plank"], "corners that rounding lets touch in different steps"),
    ("spring-damper", ["pair/plank-on-plank", "pair/rough-corner"], "planks and corners that yield"),
    ("spring-damper-soft", ["pair/faces"], "one corner of each face in the other"),
    ("spring-damper-soft", ["incline/stick-threshold", "limits/stick"], "a spring along the slope that is loaded first"),
    ("spring", ["rolling/five-sevenths", "contact/dissipation", "spin/flat-box", "pair/ball-on-box"], "springs that swing for ever"),
    ("pyramid-lemke-8", ["limits/fast"], "a solver that is asked about bodies which cannot meet"),
    ("spring-damper", ["ball/effective-restitution", "ball/penetration", "impact/plastic", "flight/projectile"], "a declared spring"),
]
# What must still fail: the engine, and a check that catches it.
MISTAKES = [
    (["gauss_seidel.py", "--mutant", "pulls-opening-contact"], "ball/energy"),
    (["gauss_seidel.py", "--mutant", "no-yaw-friction"], "tumbling/passive"),
    (["gauss_seidel.py", "--mutant", "moved-out-undeclared"], "energy/passive"),
    (["gauss_seidel.py", "--mutant", "moved-out-undeclared", "--position-correction", "0.1", "--theta", "1"], "ball/energy"),
    (["gauss_seidel.py", "--mutant", "pushed-out-undeclared", "--theta", "1"], "incline/stick"),
    (["gauss_seidel.py", "--mutant", "pushed-out-undeclared", "--theta", "1", "--error-reduction", "0.2"], "ball/restitution"),
]


def verdicts(command, checks):
    """Verdict by check, at 1/60 s and 1/240 s."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "report.json"
        only = [word for check in checks for word in ("--only", check)]
        run = subprocess.run([MOREAU, "gate", "--steps", "1/60,1/240", *only, "--out", out, "--", sys.executable, *command],
                             cwd=FOLDER, capture_output=True, text=True, timeout=300)
        if not out.exists():
            raise AssertionError(f"{command}: {run.stderr}")
        report = json.loads(out.read_text(encoding="utf-8"))
        return {one["check"]: one["verdict"] for one in report["checks"]}, run.stdout


@unittest.skipUnless(MOREAU, "needs MOREAU, the path of the program")
class Family(unittest.TestCase):
    def test_correct_engines_pass_what_once_failed_them(self):
        for member, checks, why in ALARMS:
            with self.subTest(member=member, why=why):
                found, told = verdicts(FAMILY[member], checks)
                self.assertTrue(found)
                self.assertTrue(set(found.values()) <= {"pass", "difference", "unsupported"}, told)
                self.assertNotEqual(set(found.values()), {"unsupported"}, told)

    def test_mistakes_of_their_kind_still_fail(self):
        for command, check in MISTAKES:
            with self.subTest(command=command):
                found, told = verdicts(command, [check])
                self.assertEqual(found[check], "fail", told)


if __name__ == "__main__":
    unittest.main()
