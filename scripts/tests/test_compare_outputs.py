"""`compare_outputs.py` lets numbers move within their bound and nothing else."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "compare_outputs.py"
NAMES = ["verify-json", "systems-json", "gate-moreau-jean", "gate-stewart-trinkle", "gate-anitescu", "scoreboard-json", "defects-json"]
DOCUMENT = {"claims": [{"id": "S1.x", "verdict": "true", "findings": [{"name": "f", "measured": 1.0, "bound": 1e-3}]}], "free": 2.0}


def compared(change) -> subprocess.CompletedProcess:
    """The comparison of a document with a changed one."""
    with tempfile.TemporaryDirectory() as folder:
        for side in ("old", "new"):
            (pathlib.Path(folder) / side).mkdir()
            document = json.loads(json.dumps(DOCUMENT))
            code = change(document) if side == "new" else None
            for name in NAMES:
                text = json.dumps(document) + f"\nexit code {code or 0}\n"
                (pathlib.Path(folder) / side / f"{name}.txt").write_text(text)
        command = [sys.executable, str(SCRIPT), f"{folder}/old", f"{folder}/new"]
        return subprocess.run(command, capture_output=True, text=True, check=False)


def finding(document):
    """The one finding of the document."""
    return document["claims"][0]["findings"][0]


class CompareOutputs(unittest.TestCase):
    """Both sides of every rule."""

    def test_the_same_and_numbers_within_their_bound_pass(self):
        """Nothing changed; a number by half its bound; a number without bound by 5e-10 of itself."""
        self.assertEqual(compared(lambda document: None).returncode, 0)
        self.assertEqual(compared(lambda document: finding(document).update(measured=1.0005)).returncode, 0)
        self.assertEqual(compared(lambda document: document.update(free=2.000000001)).returncode, 0)

    def test_numbers_beyond_their_bound_fail(self):
        """A number by twice its bound; one without bound by 1e-8 of itself; a bound that was loosened."""
        for change in (
            lambda document: finding(document).update(measured=1.002),
            lambda document: document.update(free=2.00000002),
            lambda document: finding(document).update(bound=1.1e-3),
        ):
            self.assertEqual(compared(change).returncode, 1)

    def test_anything_else_fails(self):
        """A verdict, a key more, an entry less, another exit code."""
        for change in (
            lambda document: document["claims"][0].update(verdict="false"),
            lambda document: finding(document).update(extra=1),
            lambda document: document["claims"].clear(),
            lambda document: 1,
        ):
            run = compared(change)
            self.assertEqual(run.returncode, 1, run.stdout)
            self.assertIn("DIFFERENT", run.stdout)

    def test_a_missing_file_is_named(self):
        """Nothing is compared silently."""
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run([sys.executable, str(SCRIPT), folder, folder], capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 2)
            self.assertIn("verify-json.txt", run.stderr)


if __name__ == "__main__":
    unittest.main()
