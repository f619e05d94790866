"""The comparison of Siconos's stored steps; no engine needed."""

import copy
import sys
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS)]

from reference.documents import read  # noqa: E402
from reference.siconos import EPSILON, check, differences, runs  # noqa: E402

REFERENCES = SCRIPTS.parent / "references"


class Stored(unittest.TestCase):
    def test_every_planned_run_is_stored_and_no_other(self):
        stored = {f"siconos/{path.name}" for path in (REFERENCES / "siconos").glob("*")}
        self.assertEqual(stored, set(runs()))
        for path, request in runs().items():
            document = read(REFERENCES / path)
            self.assertEqual({key: document[key] for key in request}, request)
            rows = request["steps"] + 1 if "steps" in request else len(document["times"])
            self.assertEqual({len(document[key]) for key in ("positions", "velocities")}, {rows})

    def test_rounding_passes_and_ten_times_the_tolerance_does_not(self):
        stored = read(REFERENCES / next(iter(runs())))
        self.assertEqual(check(stored, stored), [])
        moved = copy.deepcopy(stored)
        moved["velocities"][7][0] += 30 * EPSILON
        self.assertEqual(differences(stored, moved), [])
        moved["velocities"][7][0] += 640 * 8 * EPSILON * max(1.0, abs(moved["velocities"][7][0]))
        self.assertEqual(len(differences(stored, moved)), 1)

    def test_the_instant_of_an_impact_may_differ_by_the_error_of_the_gap_over_the_speed(self):
        stored = read(REFERENCES / "siconos/ball__event-driven__h0.1.json")
        self.assertEqual(check(stored, stored), [])
        late = max(i for i, impact in enumerate(stored["impacts"]) if impact and abs(stored["velocities"][i][0]) > 1e-3)
        moved = copy.deepcopy(stored)
        moved["times"][late] += 64 * EPSILON * late / abs(stored["velocities"][late][0])
        self.assertEqual(differences(stored, moved), [])
        moved["times"][late] += 640 * EPSILON * (late + 1) * (1 + 1 / abs(stored["velocities"][late][0]))
        self.assertEqual(len(differences(stored, moved)), 1)


if __name__ == "__main__":
    unittest.main()
