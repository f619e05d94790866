"""The engines printed in the README and in the gate's manual work as they are printed."""

import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MOREAU = os.environ.get("MOREAU")
PAGES = ["README.md", "docs/gate.md"]


def printed_blocks():
    """The Python blocks of the pages; each is a whole engine."""
    texts = [(ROOT / page).read_text(encoding="utf-8") for page in PAGES]
    return [block for text in texts for block in re.findall(r"```python\n(.*?)```", text, re.DOTALL)]


def ask(engine, requests):
    """The replies of a printed engine, run from the folder of the project."""
    lines = [json.dumps({"protocol": "moreau-engine/1", "id": k, **request})
             for k, request in enumerate(requests)]
    run = subprocess.run([sys.executable, "-c", engine], input="\n".join(lines) + "\n",
                         cwd=ROOT, capture_output=True, text=True, timeout=60, check=True)
    return [json.loads(line) for line in run.stdout.splitlines()]


class PrintedEngines(unittest.TestCase):
    scene = {"schema": "scene/1", "name": "fall", "gravity": [0, 0, -10],
             "bodies": [{"name": "ball", "sphere": {"radius": 0.1}, "mass": 1,
                         "position": [0, 0, 1], "linear_velocity": [1, 0, 0]}],
             "material": {"friction": 0}, "duration": 0.5}

    def simulate(self, **changes):
        return {"request": "simulate", "scene": {**self.scene, **changes},
                "time_step": 0.25, "sample_every": 1}

    def test_there_is_one_and_nothing_else_in_python(self):
        blocks = printed_blocks()
        self.assertEqual([True], ["serve(" in block for block in blocks])

    def test_it_describes_itself_falls_and_says_what_it_cannot_do(self):
        ground = {"normal": [0, 0, 1], "offset": 0}
        requests = [{"request": "describe"}, self.simulate(),
                    self.simulate(ground=ground), {"request": "bye"}]
        for engine in printed_blocks():
            described, fallen, refused, _ = ask(engine, requests)
            self.assertEqual(described["result"]["name"], "free-fall")
            ball = fallen["result"]["bodies"][0]
            self.assertEqual(ball["linear_velocity"][-1], [1, 0, -5])
            self.assertEqual(ball["position"][-1], [0.5, 0, 1 - 10 * 0.25 ** 2 * (1 + 2)])
            self.assertIn("free flight", refused["unsupported"])

    @unittest.skipUnless(MOREAU, "set MOREAU to the program")
    def test_protocol_check_finds_nothing_wrong_with_it(self):
        for engine in printed_blocks():
            run = subprocess.run([MOREAU, "protocol-check", "--", sys.executable, "-c", engine],
                                 cwd=ROOT, capture_output=True, text=True)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            self.assertIn(" 0 problems", run.stdout)


if __name__ == "__main__":
    unittest.main()
