"""Every condition of a witness alone: each case breaks one of them and meets all others, so that a script without it would pass."""

import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent.parent), str(pathlib.Path(__file__).resolve().parent)]

import check_witnesses  # noqa: E402
from test_witnesses import JAMMING, PENDULUM, finding  # noqa: E402
from witnesses.decisions import DECISIONS  # noqa: E402
from witnesses.judgement import Wrong  # noqa: E402
from witnesses.verdicts import agrees, grade, verdict  # noqa: E402

ONES = [["1", "1"], ["1", "1"]]
NOTHING = [["0", "0"], ["0", "0"]]
RAY = {"matrix": [["0"]], "vector": ["-1"], "covering": ["1"], "point": ["0"], "direction": ["1"], "artificial": ["1", "0"]}
PLANE_RAY = {**RAY, "matrix": NOTHING, "vector": ["-1", "0"], "covering": ["1", "1"], "point": ["0", "0"], "direction": ["1", "0"]}
LINE = {"matrix": [["0"]], "vector": ["0"], "points": [["0"]], "family_points": [["0"]], "family_directions": [["1"]]}
BALL = {"scheme": "moreau-jean A", "data": ["1", "10", "1/2", "0", "-1", "1", "1/10"]}
MINIMUM = {"matrix": [["1"]], "vector": ["1"], "rows": [["1"]], "x": ["0"]}
SWING = {"method": "verlet", "terms": [["-1", "1", "0"]], "step": "1", "before": [["1", "0"]], "after": [["1/2", "-3/4"]]}
LAW = {"friction": "7/10", "answer": "holds"}

RIGHT = [("lcp-ray", RAY), ("all-solutions", LINE), ("ball-step", {**BALL, "answer": ["5/2", "1/20", "1/2"]}), ("cone-minimum", MINIMUM), ("motion-step", SWING)]

WRONG = {
    "linear-system": [{"matrix": ONES, "right_side": ["2", "2"], "x": ["1", "1"]}],
    "lcp-solution": [
        {"matrix": [["1"]], "vector": ["1"], "z": ["-1"]},
        {"matrix": [["1"]], "vector": ["-1"], "z": ["0"]},
        {"matrix": [["1"]], "vector": ["1"], "z": ["1"]},
        {"matrix": [], "vector": [], "z": []},
    ],
    "lcp-ray": [
        {**RAY, "vector": ["0"], "artificial": ["0", "0"]},
        {**RAY, "matrix": [["1"]], "artificial": ["1", "-1"]},
        {**PLANE_RAY, "vector": ["-1", "1"], "covering": ["1", "-1"]},
        {**RAY, "point": ["-1"]},
        {**RAY, "direction": ["-1"]},
        {**PLANE_RAY, "vector": ["-1", "-2"]},
        {**PLANE_RAY, "matrix": [["0", "0"], ["-1", "0"]]},
        {**PLANE_RAY, "point": ["0", "1"]},
        {**RAY, "matrix": [["1"]]},
        {**RAY, "vector": ["0"]},
    ],
    "all-solutions": [
        {"matrix": [["-1"]], "vector": ["1"], "points": [["0"], ["1"], ["1"]], "family_points": [], "family_directions": []},
        {**LINE, "family_points": [["0"], ["1"]], "family_directions": [["1"], ["1"]]},
        {**LINE, "family_points": [["0"], ["0"]], "family_directions": [["1"], ["0"]]},
        {**LINE, "family_points": [["0"], ["0"]], "family_directions": [["1"], ["-1"]]},
        {**LINE, "family_points": [["0"], ["0"]]},
        {**LINE, "matrix": [["1"]]},
        {"matrix": [["-1"]], "vector": ["1"], "points": [["0"], ["1"], ["2"]], "family_points": [], "family_directions": []},
    ],
    "copositive": [
        {"matrix": JAMMING, "answer": "fails", "x": ["1", "-1"]},
        {"matrix": PENDULUM, "answer": "fails", "x": ["1", "0"]},
        {"matrix": [], "answer": "holds"},
    ],
    "copositive-plus": [
        {"matrix": [["1", "-2"], ["-2", "1"]], "answer": "holds"},
        {"matrix": JAMMING, "answer": "negative", "x": ["1", "-1"]},
        {"matrix": PENDULUM, "answer": "negative", "x": ["1", "1"]},
        {"matrix": PENDULUM, "answer": "zero", "x": ["1", "0"]},
        {"matrix": [["1", "-1"], ["-1", "1"]], "answer": "zero", "x": ["1", "1"]},
        {"matrix": [], "answer": "holds"},
    ],
    "definiteness": [
        {"matrix": ONES, "answer": "definite"},
        {"matrix": [["1", "0", "0"], ["0", "-1", "0"], ["0", "0", "0"]], "answer": "semidefinite", "kernel": ["0", "0", "1"], "rank": [2]},
        {"matrix": ONES, "answer": "semidefinite", "kernel": ["0", "0"], "rank": [1]},
        {"matrix": ONES, "answer": "semidefinite", "kernel": ["1", "1"], "rank": [1]},
        {"matrix": ONES, "answer": "semidefinite", "kernel": ["1", "-1"], "rank": [2]},
        {"matrix": ONES, "answer": "semidefinite", "kernel": ["1", "-1"], "rank": [True]},
        {"matrix": PENDULUM, "answer": "indefinite", "x": ["1", "1"]},
        {"matrix": [], "answer": "definite"},
    ],
    "p-matrix": [{"matrix": [[str(int(i == j)) for j in range(13)] for i in range(13)], "answer": "holds"}, {"matrix": [], "answer": "holds"}],
    "nonnegative-solution": [
        {"matrix": [["1", "1"]], "right_side": ["0"], "answer": "point", "vector": ["1", "-1"]},
        {"matrix": [["1", "1"]], "right_side": ["3"], "answer": "point", "vector": ["1", "1"]},
        {"matrix": [["1"]], "right_side": ["1"], "answer": "farkas", "vector": ["1"]},
        {"matrix": [["-1"]], "right_side": ["0"], "answer": "farkas", "vector": ["1"]},
    ],
    "normal-cone": [{"gradient": ["1"], "constraint": "ajar", "velocity": ["1"], "member": ["0"], "answer": "holds"}],
    "coulomb": [
        {**LAW, "velocity": ["-1", "0"], "impulse": ["0", "0"]},
        {**LAW, "friction": "0", "velocity": ["0", "0"], "impulse": ["-1", "0"]},
        {**LAW, "velocity": ["1", "0"], "impulse": ["1", "0"]},
        {**LAW, "velocity": ["0", "1"], "impulse": ["1", "7/10"]},
        {**LAW, "velocity": ["0", "3/5", "4/5"], "impulse": ["1", "-14/25", "-21/50"]},
        {**LAW, "velocity": ["0", "1"], "impulse": ["1", "-1/2"]},
        {**LAW, "velocity": ["0", "0"], "impulse": ["1", "-4/5"]},
    ],
    "impedance": [{"data": ["9/10", "19/20", "1/1000", "1/2", "1/4000"], "power": [1_000_000_000], "value": "9/10"}],
    "delassus": [{"mass": [["2", "1"], ["0", "4"]], "jacobian": [["1", "0"], ["0", "1"]], "delassus": [["1/2", "-1/8"], ["0", "1/4"]]}],
    "ball-step": [
        {**BALL, "answer": ["0", "1/10", "1"]},
        {**BALL, "answer": ["5/2", "1/10", "1/2"]},
        {**BALL, "data": ["1", "10", "1/2", "1", "0", "1", "1/10"], "answer": ["1", "1", "0"]},
        {**BALL, "data": ["1", "10", "1/2", "0", "3", "1", "1/10"], "answer": ["-7/2", "-3/20", "-3/2"]},
        {**BALL, "answer": ["0", "-1/5", "-2"]},
        {**BALL, "answer": ["3", "1/10", "1"]},
    ],
    "motion-step": [{**SWING, "after": [["0", "-1/2"]]}, {**SWING, "after": [["1/2", "0"]]}],
    "cone-minimum": [
        {**MINIMUM, "x": ["-1"]},
        {**MINIMUM, "vector": ["-1"]},
        {**MINIMUM, "x": ["1"]},
        {**MINIMUM, "vector": ["-1"], "rows": [["1"], ["1"]], "x": ["1"]},
        {"matrix": [["0"]], "vector": ["0"], "rows": [["1"]], "x": ["0"]},
        {"matrix": [["1", "0"], ["0", "1"]], "vector": ["0", "-1"], "rows": [["1", "0"]], "x": ["0", "0"]},
    ],
}


class TestConditions(unittest.TestCase):
    """Conditions of witnesses, of findings and of the file."""

    def test_what_breaks_one_condition_is_refused(self):
        for kind, witness in RIGHT:
            DECISIONS[kind](witness)
        for kind, cases in WRONG.items():
            for witness in cases:
                with self.subTest(kind, witness=witness), self.assertRaises((Wrong, ValueError)):
                    DECISIONS[kind](witness)

    def test_a_tolerance_counts_where_a_number_is_rounded_and_each_relation_has_two_sides(self):
        self.assertFalse(agrees("1", "2", "equal", 5.0))
        for relation, right, wrong in (("equal", 1.5, 1.75), ("at-most", 1.5, 1.75), ("at-least", 0.5, 0.25)):
            self.assertTrue(agrees(right, 1.0, relation, 0.5), relation)
            self.assertFalse(agrees(wrong, 1.0, relation, 0.5), relation)
        self.assertTrue(agrees(0.25, 1.0, "at-most", 0.0) and agrees(1.75, 1.0, "at-least", 0.0))

    def test_what_is_refuted_only_elsewhere_needs_support_and_a_refuted_opinion_is_false(self):
        with self.assertRaises(Wrong):
            verdict([finding("2", "3", violated="c")])
        with self.assertRaises(Wrong):
            verdict([finding("2", "3", violated="c"), finding("1", violated="c")])
        self.assertEqual(verdict([finding("1", voice={"opinion": "taste"}), finding("2", "3")]), "FALSE AS STATED")
        self.assertEqual(verdict([finding("1", voice={"opinion": "taste"}), finding("2", "3", violated="c")]), "AMBIGUOUS")

    def test_exact_is_only_what_is_held_exactly(self):
        self.assertEqual(grade([finding("1")]), "exact")
        rounded = {"relation": "equal", "value": 1.0}
        for change in ({"expected": 1.0}, {"tolerance": 0.5}, {"stated": rounded}, {"found": 1.0}):
            self.assertEqual(grade([finding("1", **{key: value for key, value in change.items() if key != "found"}) | change]), "certified", change)

    def run_on(self, text: str) -> tuple[int, str]:
        """Exit code and output for a file with this text."""
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder) / "witnesses.json"
            place.write_text(text)
            out = io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
                return check_witnesses.main([str(place)]), out.getvalue()

    def test_a_file_that_another_reader_would_read_otherwise_is_refused(self):
        rank = {"kind": "rank", "matrix": [["1"]], "rank": [1]}
        claim = {"id": "S0.x", "verdict": "TRUE", "evidence": "exact", "failed": None, "findings": [finding("1")], "witnesses": [rank]}
        counts = {"claims": 1, "findings": 1, "witnesses": 1}
        document = {"schema": "witnesses/1", "counts": counts, "of": 1, "selected": None, "claims": [claim]}
        text = json.dumps(document)
        self.assertEqual(self.run_on(text)[0], 0)
        code, out = self.run_on(text.replace('"verdict": "TRUE"', '"verdict": "FALSE AS STATED", "verdict": "TRUE"'))
        self.assertEqual(code, 2, out)
        self.assertIn("verdict", out)
        for wrong in ({"counts": {**counts, "claims": True}}, {"counts": {**counts, "findings": 1.0}}):
            self.assertEqual(self.run_on(json.dumps({**document, **wrong}))[0], 2, wrong)
        for wrong in ({"id": ""}, {"findings": [finding("1", violated=0)]}, {"findings": [finding("1", violated="")]}):
            self.assertEqual(self.run_on(json.dumps({**document, "claims": [{**claim, **wrong}]}))[0], 2, wrong)

    def test_an_exact_claim_without_a_witness_is_wrong(self):
        claim = {"id": "S0.x", "verdict": "TRUE", "evidence": "exact", "failed": None, "findings": [finding("1")], "witnesses": []}
        counts = {"claims": 1, "findings": 1, "witnesses": 0}
        code, out = self.run_on(json.dumps({"schema": "witnesses/1", "counts": counts, "of": 1, "selected": None, "claims": [claim]}))
        self.assertEqual(code, 1)
        self.assertIn("S0.x: exact, and no witness", out)


if __name__ == "__main__":
    unittest.main()
