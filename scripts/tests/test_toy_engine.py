"""The toy engine bounces as Newton's impact law says, and its planted bug is caught by name."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOY = ROOT / "examples" / "toy_engine.py"
MOREAU = os.environ.get("MOREAU")

H = 1 / 240
SCENE = {"schema": "scene/1", "name": "ball", "gravity": [0, 0, -9.81],
         "ground": {"normal": [0, 0, 1], "offset": 0}, "duration": 240 * H,
         "bodies": [{"name": "ball", "sphere": {"radius": 0.1}, "mass": 1,
                     "position": [0, 0, 2.1]}],
         "material": {"friction": 0, "restitution": 0.5}}


def impact(*arguments):
    """Velocities before and after the first impact, as the toy answers."""
    request = {"protocol": "moreau-engine/1", "id": 1, "request": "simulate", "scene": SCENE,
               "time_step": H, "sample_every": 1}
    done = subprocess.run([sys.executable, str(TOY), *arguments], capture_output=True,
                          input=json.dumps(request).encode() + b"\n", check=True)
    velocities = [v[2] for v in json.loads(done.stdout)["result"]["bodies"][0]["linear_velocity"]]
    k = next(k for k, v in enumerate(velocities) if v > 0)
    return velocities[k - 1], velocities[k]


def verdicts(*arguments):
    """{check: verdict} of `moreau gate --quick` on the checks of the ball."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        subprocess.run([MOREAU, "gate", "--quick", "--only", "ball/", "--out", str(report), "--",
                        sys.executable, str(TOY), *arguments], capture_output=True, check=False)
        checks = json.loads(report.read_text(encoding="utf-8"))["checks"]
    return {check["check"]: check["verdict"] for check in checks}


class Toy(unittest.TestCase):
    def test_it_rebounds_with_e_times_its_velocity(self):
        before, after = impact()
        self.assertAlmostEqual(after, -0.5 * before, places=12)

    def test_its_planted_bug_applies_e_twice(self):
        before, after = impact("--bug")
        self.assertAlmostEqual(after, -0.25 * before, places=12)

    @unittest.skipUnless(MOREAU, "set MOREAU to the program")
    def test_the_gate_passes_the_toy_and_names_what_its_bug_breaks(self):
        self.assertEqual(set(verdicts().values()), {"pass"})
        caught = {check for check, verdict in verdicts("--bug").items() if verdict == "fail"}
        self.assertLessEqual({"ball/restitution", "ball/energy", "ball/zeno"}, caught)


if __name__ == "__main__":
    unittest.main()
