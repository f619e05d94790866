"""Every member of examples/engines/family.json is a correct engine: all checks, at one time step each, which changes from member to member.

MOREAU=path of the program; without it these tests are skipped. MOREAU_CAMPAIGN=1 asks every member at every step, stacks of springs too;
without it members at the small step are left out, which takes Python twice as long.
"""

import json
import os
import subprocess
import sys
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "engines"
FAMILY = json.loads((FOLDER / "family.json").read_text(encoding="utf-8"))["engines"]
MOREAU = os.environ.get("MOREAU")
CAMPAIGN = os.environ.get("MOREAU_CAMPAIGN") == "1"
STEPS = ("1/60", "1/240", "1/30")
#: the step of members that are asked in a campaign only
SMALL = "1/240"
ALL_STEPS = ("1/30", "1/60", "1/240", "1/1000")
#: program → checks that it is asked in a campaign only: ten boxes of springs take minutes in Python
DEAR = {"spring_damper.py": ("stack/",)}


def bad(member, steps):
    """Checks that fail or err, with what was said of them."""
    skipped = () if CAMPAIGN else DEAR.get(member["command"][0], ())
    skip = [word for check in ("solver/", "projection/", *skipped) for word in ("--skip", check)]
    command = [MOREAU, "gate", "--steps", ",".join(steps), "--time-limit", "900", *skip, "--", sys.executable, *member["command"]]
    run = subprocess.run(command, cwd=FOLDER, capture_output=True, text=True)
    return "" if run.returncode == 0 else run.stdout + run.stderr


@unittest.skipUnless(MOREAU, "needs MOREAU, the path of the program")
class Members(unittest.TestCase):
    def test_no_check_fails_a_correct_engine(self):
        asked = [(member, ALL_STEPS if CAMPAIGN else (STEPS[number % len(STEPS)],)) for number, member in enumerate(FAMILY)]
        asked = [(member, steps) for member, steps in asked if CAMPAIGN or steps != (SMALL,)]
        self.assertGreaterEqual(len(asked), 20)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            answers = list(pool.map(lambda one: bad(*one), asked))
        for (member, steps), told in zip(asked, answers):
            with self.subTest(member["name"], steps=steps):
                self.assertEqual(told, "", told)

    def test_every_step_is_seen(self):
        self.assertGreaterEqual(len(FAMILY), len(STEPS))


if __name__ == "__main__":
    unittest.main()
