"""The gate's family `bounce` on the example engines: planted mistakes of restitution fail where they act, correct engines pass."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MOREAU = os.environ.get("MOREAU")
FOLDER = Path(__file__).resolve().parents[2] / "examples" / "engines"
STEPS = "1/30,1/240"
# what catches a mistake at both of these steps; bounce/every-step goes through its own
MUTANTS = {
    "no-restitution-for-boxes": {"bounce/flat-box", "bounce/corner"},
    "restitution-of-first-contact": {"bounce/flat-box"},
    "opening-contact-bounces": {"bounce/separating"},
    "pulls-opening-contact": {"bounce/separating"},
    "tangential-restitution": {"bounce/spinning-ball"},
    "restitution-threshold": {"bounce/slow"},
    "plastic-at-small-steps": {"bounce/every-step"},
    "plastic-at-large-steps": {"bounce/every-step"},
}
CORRECT = (["--theta", "1"], ["--precision", "single", "--activation", "speculative", "--point", "second"],
           ["--cone", "pyramid", "--substeps", "2", "--linear-damping", "0.1", "--restitution-threshold", "0.2"])


def judged(*arguments):
    """The gate's report on the example engine with these arguments."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.json"
        subprocess.run([MOREAU, "gate", "--steps", STEPS, "--only", "bounce/", "--jobs", "2", "--out", str(file), "--",
                        sys.executable, str(FOLDER / "gauss_seidel.py"), *arguments], capture_output=True, text=True, check=False)
        return json.loads(file.read_text(encoding="utf-8"))["checks"]


@unittest.skipUnless(MOREAU, "set MOREAU to the program")
class Bounce(unittest.TestCase):
    def test_correct_engines_pass(self):
        for arguments in CORRECT:
            for check in judged(*arguments):
                # what damping does before an impact and what the impact does is not told apart there
                is_asked = check["check"] != "bounce/turning-bar" or "--linear-damping" not in arguments
                right = ("pass", "difference") if is_asked else ("unsupported",)
                self.assertIn(check["verdict"], right, (arguments, check))

    def test_every_mistake_fails_at_every_step_at_which_it_acts(self):
        for mutant, catching in MUTANTS.items():
            failing = {check["check"]: check.get("fails_at", []) for check in judged("--mutant", mutant) if check["verdict"] == "fail"}
            self.assertLessEqual(catching, set(failing), mutant)
            for check in catching - {"bounce/every-step"}:
                self.assertEqual(len(failing[check]), 2, (mutant, check))


if __name__ == "__main__":
    unittest.main()
