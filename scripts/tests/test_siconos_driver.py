"""What the C++ program for Siconos is asked, and how its answer is read; no engine needed."""

import sys
import unittest
from pathlib import Path
from unittest import mock

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS)]

from reference import siconos_driver  # noqa: E402
from reference.siconos import _by_driver, make, runs  # noqa: E402

CHAIN = next(request for path, request in runs().items() if "chain__schatzman-paoli" in path)


class Driver(unittest.TestCase):
    def test_a_run_is_one_line_per_quantity_and_the_first_step_is_the_start_s(self):
        lines = list(siconos_driver._lines(CHAIN))
        self.assertEqual(lines[1], f"3 2 0.5 0.01 {CHAIN['steps'] - 1}")
        self.assertEqual(lines[5], "-1.0 1.0 0.0 0.0 -1.0 1.0")
        self.assertEqual([len(line.split()) for line in lines], [1, 5, 3, 9, 3, 6, 2, 2, 3, 3])

    def test_multipliers_become_impulses(self):
        answer = siconos_driver._answer(CHAIN, "1 2 3 4 5 6 0.5 0\n")
        self.assertEqual(answer["positions"], [CHAIN["start"]["position"], [1.0, 2.0, 3.0]])
        self.assertEqual(answer["impulses"], [[50.0, 0.0]])

    def test_without_a_compiler_its_runs_are_not_run_and_never_passed(self):
        reply = {"version": "x", "answers": [{}] * sum(not _by_driver(run) for run in runs().values())}
        with (mock.patch("reference.siconos._ask", return_value=reply),
              mock.patch("reference.siconos._lsodar_tolerances", return_value={}),
              mock.patch("shutil.which", return_value=None)):
            made, not_run, version = make(SCRIPTS)
        self.assertEqual(set(not_run), {path for path, run in runs().items() if _by_driver(run)})
        self.assertFalse(set(not_run) & set(made))
        self.assertEqual(version, "x")
        self.assertIn("g++", next(iter(not_run.values())))


if __name__ == "__main__":
    unittest.main()
