"""The engine printed in the README works as it is printed."""

import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MOREAU = os.environ.get("MOREAU")


def printed_engine():
    """The Python block of the README that serves requests."""
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    return next(block for block in blocks if "serve(" in block)


def ask(requests):
    """The replies of the printed engine, run from the folder of the project."""
    lines = [json.dumps({"protocol": "moreau-engine/1", "id": k, **request})
             for k, request in enumerate(requests)]
    run = subprocess.run([sys.executable, "-c", printed_engine()], input="\n".join(lines) + "\n",
                         cwd=ROOT, capture_output=True, text=True, timeout=60, check=True)
    return [json.loads(line) for line in run.stdout.splitlines()]


class ReadmeEngine(unittest.TestCase):
    scene = {"schema": "scene/1", "name": "fall", "gravity": [0, 0, -10],
             "bodies": [{"name": "ball", "sphere": {"radius": 0.1}, "mass": 1,
                         "position": [0, 0, 1], "linear_velocity": [1, 0, 0]}],
             "material": {"friction": 0}, "duration": 0.5}

    def simulate(self, **changes):
        return {"request": "simulate", "scene": {**self.scene, **changes},
                "time_step": 0.25, "sample_every": 1}

    def test_it_describes_itself_falls_and_says_what_it_cannot_do(self):
        ground = {"normal": [0, 0, 1], "offset": 0}
        described, fallen, refused, _ = ask([{"request": "describe"}, self.simulate(),
                                             self.simulate(ground=ground), {"request": "bye"}])
        self.assertEqual(described["result"]["name"], "free-fall")
        ball = fallen["result"]["bodies"][0]
        self.assertEqual(ball["linear_velocity"][-1], [1, 0, -5])
        self.assertEqual(ball["position"][-1], [0.5, 0, 1 - 10 * 0.25 ** 2 * (1 + 2)])
        self.assertIn("free flight", refused["unsupported"])

    @unittest.skipUnless(MOREAU, "set MOREAU to the program")
    def test_protocol_check_finds_nothing_wrong_with_it(self):
        run = subprocess.run([MOREAU, "protocol-check", "--", sys.executable, "-c",
                              printed_engine()], cwd=ROOT, capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn(" 0 problems", run.stdout)


if __name__ == "__main__":
    unittest.main()
