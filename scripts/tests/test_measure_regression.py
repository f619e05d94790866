"""The file of regression bounds: what it keeps of what the program prints, and that it reads back."""

import json
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

import measure_regression  # noqa: E402


class Shares(unittest.TestCase):
    def test_what_uses_no_bound_is_left_out_and_the_rest_keeps_its_order_and_three_digits(self):
        rows = [{"name": "b", "used": 0.123456}, {"name": "exact"}, {"name": "a", "used": 0.0}]
        self.assertEqual(measure_regression.shares(rows, lambda row: row["name"]), [["b", 0.123], ["a", 0.0]])

    def test_the_text_reads_back_as_what_was_written(self):
        value = {"schema": "regression/1", "provenance": {"commit": "0"}, "claims": {"S1.a": [["|φ|", 1e-9]]},
                 "systems": {"Moreau–Jean": [["exact: v", 0.5], ["exact: q", 0.25]]}}
        self.assertEqual(json.loads(measure_regression.text(value)), value)

    def test_the_stored_file_names_its_commit_and_command(self):
        stored = json.loads((ROOT / "references" / "regression.json").read_text(encoding="utf-8"))
        self.assertRegex(stored["provenance"]["commit"], "^[0-9a-f]{40}$")
        self.assertEqual(stored["provenance"]["command"], "python3 scripts/measure_regression.py")
        self.assertEqual(measure_regression.text(stored), (ROOT / "references" / "regression.json").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
