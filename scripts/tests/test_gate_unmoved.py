"""The gate's families `fixed`, `conveyor` and `round` on the example engines: planted mistakes fail at every step, correct engines pass."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MOREAU = os.environ.get("MOREAU")
FOLDER = Path(__file__).resolve().parents[2] / "examples" / "engines"
STEPS = ["1/30", "1/240"]
MUTANTS = {
    "belt-at-rest-for-contacts": {"conveyor/box", "conveyor/sphere"},
    "belt-is-pushed": {"conveyor/box", "conveyor/sphere"},
    "belt-friction-along-x-only": {"conveyor/box"},
    "static-has-mass": {"fixed/bounce"},
    "round-inertia-of-sphere": {"round/struck", "round/cylinder-incline"},
}
CORRECT = (["--theta", "1", "--error-reduction", "0.2"], ["--precision", "single", "--activation", "speculative", "--point", "second"],
           ["--cone", "pyramid", "--substeps", "2"])


def judged(script, *arguments, fixed="fixed/bounce"):
    """The gate's report on an example engine with these arguments."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.json"
        subprocess.run([MOREAU, "gate", "--steps", ",".join(STEPS), "--only", "conveyor/", "--only", fixed, "--only", "round/", "--jobs", "2",
                        "--out", str(file), "--", sys.executable, str(FOLDER / script), *arguments],
                       capture_output=True, text=True, check=False)
        return {check["check"]: check for check in json.loads(file.read_text(encoding="utf-8"))["checks"]}


@unittest.skipUnless(MOREAU, "set MOREAU to the program")
class Unmoved(unittest.TestCase):
    def test_correct_engines_pass(self):
        for number, arguments in enumerate(CORRECT):
            for name, check in judged("gauss_seidel.py", *arguments, fixed="fixed/bounce" if number else "fixed/").items():
                self.assertIn(check["verdict"], ("pass", "difference"), (arguments, name, check))

    def test_every_mistake_fails_at_every_step(self):
        for mutant, catching in MUTANTS.items():
            checks = judged("gauss_seidel.py", "--mutant", mutant)
            for name in catching:
                self.assertEqual((checks[name]["verdict"], len(checks[name].get("fails_at", []))), ("fail", len(STEPS)), (mutant, name))

    def test_an_engine_that_declares_no_such_bodies_is_not_asked(self):
        for name, check in judged("pyramid_lemke.py").items():
            self.assertEqual(check["verdict"], "unsupported", (name, check))
            self.assertIn("does not declare", check["reason"])


if __name__ == "__main__":
    unittest.main()
