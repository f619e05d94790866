"""The comparison of Siconos's stored steps; no engine needed."""

import copy
import sys
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS)]

from reference.documents import read  # noqa: E402
from reference.siconos import EPSILON, FACTS, check, differences, runs  # noqa: E402

REFERENCES = SCRIPTS.parent / "references"


class Stored(unittest.TestCase):
    def test_every_planned_run_is_stored_and_no_other(self):
        stored = {f"siconos/{path.name}" for path in (REFERENCES / "siconos").glob("*")}
        self.assertEqual(stored, set(runs()))
        for path, request in runs().items():
            document = read(REFERENCES / path)
            self.assertEqual({key: document[key] for key in request}, request)
            self.assertEqual(len(document["positions"]), request["steps"] + 1)

    def test_rounding_passes_and_ten_times_the_tolerance_does_not(self):
        stored = read(REFERENCES / next(iter(runs())))
        self.assertEqual(check(stored, stored), [])
        moved = copy.deepcopy(stored)
        moved["velocities"][7][0] += 30 * EPSILON
        self.assertEqual(differences(stored, moved), [])
        moved["velocities"][7][0] += 640 * 8 * EPSILON * max(1.0, abs(moved["velocities"][7][0]))
        self.assertEqual(len(differences(stored, moved)), 1)

    def test_another_fact_is_a_difference(self):
        stored = read(REFERENCES / FACTS)
        self.assertEqual(check(stored, stored), [])
        self.assertEqual(check(stored, {**stored, "headers": stored["headers"][1:]}),
                         ["headers: differs"])


if __name__ == "__main__":
    unittest.main()
