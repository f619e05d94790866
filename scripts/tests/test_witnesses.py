"""Every kind of witness is accepted where it shows what it says, and refused with one planted mistake."""

import contextlib
import copy
import io
import json
import pathlib
import sys
import tempfile
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent.parent), str(pathlib.Path(__file__).resolve().parent)]

import check_witnesses  # noqa: E402
import witnesses_of_motions  # noqa: E402
from witnesses.decisions import DECISIONS  # noqa: E402
from witnesses.judgement import Wrong  # noqa: E402
from witnesses.verdicts import decide, grade, verdict  # noqa: E402

PENDULUM = [["2", "-1"], ["-1", "2"]]
JAMMING = [["0", "1"], ["1", "0"]]

RIGHT = {
    "linear-system": [
        {"matrix": PENDULUM, "right_side": ["1", "0"], "x": ["2/3", "1/3"]},
        {"matrix": [["1", "1"], ["1", "1"]], "right_side": ["1", "1"], "x": "singular"},
    ],
    "rank": [{"matrix": [["1", "2"], ["2", "4"]], "rank": [1]}],
    "lcp-solution": [{"matrix": PENDULUM, "vector": ["-1", "3"], "z": ["1/2", "0"]}],
    "lcp-ray": [{"matrix": [["0"]], "vector": ["-1"], "covering": ["1"], "point": ["0"], "direction": ["1"], "artificial": ["1", "0"]}],
    "all-solutions": [
        {"matrix": [["-1"]], "vector": ["1"], "points": [["0"], ["1"]], "family_points": [], "family_directions": []},
        {"matrix": [["0"]], "vector": ["0"], "points": [["0"]], "family_points": [["0"]], "family_directions": [["1"]]},
    ],
    "copositive": [{"matrix": [["1", "5"], ["5", "1"]], "answer": "holds"}, {"matrix": [["1", "-2"], ["-2", "1"]], "answer": "fails", "x": ["1", "1"]}],
    "copositive-plus": [
        {"matrix": PENDULUM, "answer": "holds"},
        {"matrix": [["1", "1"], ["1", "1/2"]], "answer": "holds"},
        {"matrix": JAMMING, "answer": "zero", "x": ["1", "0"]},
        {"matrix": [["1", "-2"], ["-2", "1"]], "answer": "negative", "x": ["1", "1"]},
    ],
    "definiteness": [
        {"matrix": PENDULUM, "answer": "definite"},
        {"matrix": [["1", "1"], ["1", "1"]], "answer": "semidefinite", "kernel": ["1", "-1"], "rank": [1]},
        {"matrix": JAMMING, "answer": "indefinite", "x": ["1", "-1"]},
    ],
    "p-matrix": [{"matrix": PENDULUM, "answer": "holds"}, {"matrix": [["1", "1"], ["1", "1"]], "answer": "fails", "indices": [0, 1], "value": "0"}],
    "nonnegative-solution": [
        {"matrix": [["2", "3"]], "right_side": ["6"], "answer": "point", "vector": ["3", "0"]},
        {"matrix": [["2", "3"]], "right_side": ["-1"], "answer": "farkas", "vector": ["-1"]},
    ],
    "response": [{"delassus": PENDULUM, "velocity": ["-1", "0"], "impulse": ["1/2", "1/2"], "after": ["-1/2", "1/2"]}],
    "ball-step": [
        {"scheme": "moreau-jean A", "data": ["1", "10", "1/2", "0", "-1", "1", "1/10"], "answer": ["5/2", "1/20", "1/2"]},
        {"scheme": "moreau-jean D", "data": ["1", "10", "1/2", "1", "0", "1", "1/10"], "answer": ["0", "9/10", "-1"]},
        {"scheme": "stewart-trinkle", "data": ["1", "10", "0", "1/20", "0", "1", "1/10"], "answer": ["1/2", "0", "-1/2"]},
    ],
    "powers": [
        {"matrix": [["0", "-1"], ["1", "0"]], "answer": "bounded"},
        {"matrix": [["1", "1"], ["0", "1"]], "answer": "grow-linearly"},
        {"matrix": [["1", "0"], ["0", "1"]], "answer": "bounded"},
        {"matrix": [["1/2", "5"], ["0", "0"]], "answer": "decay"},
        {"matrix": [["1/2", "-1/2"], ["1/2", "1/2"]], "answer": "decay"},
        {"matrix": [["0", "-5/4"], ["1", "0"]], "answer": "grow-exponentially"},
        {"matrix": [["-3/2", "0"], ["0", "1/2"]], "answer": "grow-exponentially"},
        {"matrix": [["1", "5"], ["0", "-1"]], "answer": "bounded"},
    ],
    "determinant": [{"matrix": PENDULUM, "value": "3"}],
    "symplectic-defect": [
        {"map": [["1", "0"], ["-2", "1"]], "mass": [["3"]], "defect": [["0", "0"], ["0", "0"]]},
        {"map": [["2", "0"], ["0", "1"]], "mass": [["3"]], "defect": [["0", "3"], ["-3", "0"]]},
    ],
    "quadratic-form": [{"matrix": JAMMING, "vector": ["1", "2"], "value": "4"}],
    "normal-cone": [
        {"gradient": ["1", "2"], "constraint": "closed", "velocity": ["2", "-1"], "member": ["-1/2", "-1"], "answer": "holds"},
        {"gradient": ["1", "2"], "constraint": "closed", "velocity": ["2", "-1"], "member": ["1/2", "1"], "answer": "fails"},
        {"gradient": ["1"], "constraint": "closed", "velocity": ["-1"], "member": ["0"], "answer": "fails"},
        {"gradient": ["1"], "constraint": "open", "velocity": ["-1"], "member": ["0"], "answer": "holds"},
        {"gradient": ["1"], "constraint": "closed", "velocity": ["1"], "member": ["-1"], "answer": "fails"},
    ],
    "impact-inclusion": [
        {"data": ["1", "1", "1/2", "-1"], "solutions": ["1/2"]},
        {"data": ["1", "1", "1/2", "1"], "solutions": ["1"]},
        {"data": ["1", "0", "1", "-1"], "solutions": []},
    ],
    "coulomb": [
        {"friction": "7/10", "velocity": ["0", "3/5", "4/5"], "impulse": ["1", "-21/50", "-14/25"], "answer": "holds"},
        {"friction": "7/10", "velocity": ["0", "3/5", "4/5"], "impulse": ["1", "21/50", "14/25"], "answer": "fails"},
        {"friction": "7/10", "velocity": ["0", "0"], "impulse": ["1", "-1/2"], "answer": "holds"},
        {"friction": "7/10", "velocity": ["1", "0"], "impulse": ["1", "0"], "answer": "fails"},
    ],
    "impedance": [
        {"data": ["9/10", "19/20", "1/1000", "1/2", "1/4000"], "power": [2], "value": "29/32"},
        {"data": ["9/10", "19/20", "1/1000", "1/2", "3/4000"], "power": [2], "value": "151/160"},
        {"data": ["0", "19/20", "0", "1/2", "1"], "power": [2], "value": "9501/20000"},
        {"data": ["0", "1", "1", "1/2", "0"], "power": [1], "value": "1/10000"},
    ],
    "delassus": [{"mass": [["2", "0"], ["0", "4"]], "jacobian": [["1", "0"], ["-1", "1"]], "delassus": [["1/2", "-1/2"], ["-1/2", "3/4"]]}],
    "stewart-trinkle": [
        {
            "delassus": [["2", "1"], ["1", "3"]],
            "velocity": ["-1", "4"],
            "friction": ["1/2"],
            "directions": [["1"], ["-1"]],
            "matrix": [["2", "1", "-1", "0"], ["1", "3", "-3", "1"], ["-1", "-3", "3", "1"], ["1/2", "-1", "-1", "0"]],
            "vector": ["-1", "4", "-4", "0"],
        }
    ],
    **witnesses_of_motions.RIGHT,
}


def mistakes(kind: str, witness: dict):
    """Copies of a witness with one answer changed."""
    for key, value in witness.items():
        if key in ("x", "z", "point", "direction", "kernel", "vector", "after", "answer") and isinstance(value, list):
            changed = copy.deepcopy(witness)
            changed[key][0] = "7" if witness.get("answer") == "farkas" else "-7"
            yield changed
    swaps = {"holds": "fails", "definite": "semidefinite", "semidefinite": "definite", "point": "farkas", "farkas": "point", "zero": "negative"}
    if "value" in witness:
        yield {**witness, "value": "1"}
    if isinstance(witness.get("answer"), str) and witness["answer"] in swaps:
        yield {"x": ["1", "0"], "indices": [0], "value": "1", "kernel": ["1", "0"], "rank": [1], **witness, "answer": swaps[witness["answer"]]}
    if "rank" in witness:
        yield {**witness, "rank": [witness["rank"][0] + 1]}
    if witness.get("answer") == "fails" and "x" not in witness and "indices" not in witness:
        yield {**witness, "answer": "holds"}
    if "solutions" in witness:
        yield {**witness, "solutions": [*witness["solutions"], "-7"]}
        yield {**witness, "solutions": []} if witness["solutions"] else {**witness, "solutions": ["0"]}
    for name in ("delassus", "jacobian") if "delassus" in witness else ():
        if name in witness:
            yield {**witness, name: [["7", *witness[name][0][1:]], *witness[name][1:]]}
    if "directions" in witness:
        yield {**witness, "matrix": [*witness["matrix"][:-1], ["0", *witness["matrix"][-1][1:]]]}
        yield {**witness, "friction": ["0"]}
    if "defect" in witness:
        yield {**witness, "defect": [["1", *witness["defect"][0][1:]], *witness["defect"][1:]]}
    for other in {"decay", "bounded", "grow-linearly", "grow-exponentially"} - {witness["answer"]} if isinstance(witness.get("answer"), str) and len(witness) == 2 else ():
        yield {**witness, "answer": other}
    if "points" in witness:
        yield {**witness, "points": witness["points"][1:]}
    for changes in witnesses_of_motions.MISTAKES.get(kind, []):
        yield {**witness, **changes}
    if witness.get("x") == "singular":
        yield {**witness, "matrix": PENDULUM}


class TestWitnesses(unittest.TestCase):
    """Right and wrong witnesses of every kind."""

    def test_every_kind_is_accepted_where_it_is_right_and_refused_with_a_mistake(self):
        self.assertEqual(RIGHT.keys(), DECISIONS.keys())
        for kind, witnesses in RIGHT.items():
            for witness in witnesses:
                with self.subTest(kind, witness=witness):
                    DECISIONS[kind](witness)
                    wrong = list(mistakes(kind, witness))
                    self.assertTrue(wrong, "no mistake is planted")
                    for changed in wrong:
                        with self.assertRaises((Wrong, ValueError), msg=str(changed)):
                            DECISIONS[kind](changed)

    def test_a_matrix_that_is_copositive_but_not_plus_is_no_plus(self):
        with self.assertRaises(Wrong):
            DECISIONS["copositive-plus"]({"matrix": JAMMING, "answer": "holds"})
        with self.assertRaises(Wrong):
            DECISIONS["copositive"]({"matrix": [["1", "-2"], ["-2", "1"]], "answer": "holds"})
        with self.assertRaises(Wrong):
            DECISIONS["p-matrix"]({"matrix": JAMMING, "answer": "holds"})


    def test_what_every_problem_has_and_what_is_of_another_size_shows_nothing(self):
        ray, pair = RIGHT["lcp-ray"][0], RIGHT["stewart-trinkle"][0]
        for kind, wrong in (
            ("lcp-ray", {**ray, "direction": ["0"], "artificial": ["9", "1"]}),
            ("lcp-ray", {**ray, "covering": ["0"]}),
            ("normal-cone", {**RIGHT["normal-cone"][3], "member": []}),
            ("symplectic-defect", {"map": [["5", "0"], ["0", "7"]], "mass": [["0"]], "defect": [["0", "0"], ["0", "0"]]}),
            ("stewart-trinkle", {**pair, "directions": [["1", "77"], ["-1", "99"]]}),
            ("impact-inclusion", {"data": ["-1", "1", "1/2", "1"], "solutions": ["1"]}),
            ("impedance", {**RIGHT["impedance"][0], "power": [0]}),
            ("rank", {"matrix": [["1"]], "rank": [True]}),
        ):
            with self.subTest(kind), self.assertRaises((Wrong, ValueError)):
                DECISIONS[kind](wrong)

    def test_what_only_looks_right_is_refused(self):
        for kind, wrong in witnesses_of_motions.WRONG:
            with self.subTest(kind, witness=wrong), self.assertRaises((Wrong, ValueError)):
                DECISIONS[kind](wrong)

    def test_solutions_that_are_left_out_are_missed(self):
        line = {"matrix": [["0"]], "vector": ["0"], "points": [["0"]], "family_points": [["0"]], "family_directions": [["1"]]}
        DECISIONS["all-solutions"](line)
        # two masses that share a load in any way: z₁ + z₂ = 1, from (1, 0) to (0, 1)
        load = {"matrix": [["1", "1"], ["1", "1"]], "vector": ["-1", "-1"], "points": [["0", "1"], ["1", "0"]]}
        DECISIONS["all-solutions"]({**load, "family_points": [["0", "1"]], "family_directions": [["1", "-1"]]})
        two_lines = {"matrix": [["0", "0"], ["0", "0"]], "vector": ["0", "1"], "points": [["0", "0"]]}
        DECISIONS["all-solutions"]({**two_lines, "family_points": [["0", "0"]], "family_directions": [["1", "0"]]})
        nowhere = {"family_points": [], "family_directions": []}
        for wrong in ({**line, **nowhere}, {**line, "family_directions": []}, {**load, **nowhere}, {**two_lines, **nowhere}, {**line, **nowhere, "points": []}):
            with self.assertRaises(Wrong, msg=str(wrong)):
                DECISIONS["all-solutions"](wrong)

    def test_what_is_no_matrix_no_fraction_and_no_answer_is_refused(self):
        square = [["1", "0"], ["0", "1"]]
        for kind, wrong in (
            ("p-matrix", {"matrix": square, "answer": "fails", "indices": [0, 0], "value": "0"}),
            ("p-matrix", {"matrix": square, "answer": "fails", "indices": [0, -2], "value": "0"}),
            ("p-matrix", {"matrix": [["1", "-9"]], "answer": "holds"}),
            ("p-matrix", {"matrix": square, "answer": "perhaps"}),
            ("copositive", {"matrix": square, "answer": "perhaps", "x": ["1", "1"]}),
            ("definiteness", {"matrix": square, "answer": "perhaps", "kernel": ["1", "0"], "rank": [1]}),
            ("nonnegative-solution", {"matrix": [], "right_side": [], "answer": "farkas", "vector": []}),
            ("nonnegative-solution", {"matrix": [["2", "3"]], "right_side": ["6"], "answer": "perhaps", "vector": ["3", "0"]}),
            ("linear-system", {"matrix": [], "right_side": [], "x": ["7"]}),
            ("linear-system", {"matrix": [["1", "1"]], "right_side": ["1"], "x": ["1", "0"]}),
            ("rank", {"matrix": [["1", "2"], ["2"]], "rank": [1]}),
            ("rank", {"matrix": [[1.0]], "rank": [1]}),
            ("lcp-solution", {"matrix": [["1"]], "vector": "0", "z": ["0"]}),
            ("ball-step", {"scheme": "moreau-jean A", "data": ["1", "10", "1/2", "0", "-1", "1", "-1/10"], "answer": ["5/2", "1/20", "1/2"]}),
        ):
            with self.subTest(kind, witness=wrong), self.assertRaises((Wrong, ValueError)):
                DECISIONS[kind](wrong)


def finding(found: str, stated: str | None = None, **more) -> dict:
    """A finding that holds."""
    said = None if stated is None else {"relation": "equal", "value": stated}
    base = {"name": "x", "found": found, "expected": found, "relation": "equal", "tolerance": 0.0, "stated": said, "violated": None, "voice": None, "origin": "computed", "context": False}
    return {**base, **more}


class TestVerdicts(unittest.TestCase):
    """The verdict from the findings."""

    def test_the_five_verdicts(self):
        self.assertEqual(verdict([finding("1"), finding("2", "3", context=True)]), "TRUE")
        self.assertEqual(verdict([finding("1"), finding("2", "3")]), "FALSE AS STATED")
        self.assertEqual(verdict([finding("1"), finding("2", "3", violated="c")]), "TRUE WITH CONDITIONS")
        passages = [finding("1", "1", voice={"passage": "a"}), finding("1", "2", voice={"passage": "b"})]
        self.assertEqual(verdict(passages), "INTERNALLY INCONSISTENT")
        self.assertEqual(verdict([finding("1", "1", voice={"reading": "a"}), finding("1", "2", voice={"reading": "b"})]), "AMBIGUOUS")
        self.assertEqual(verdict([finding("1", voice={"opinion": "taste"})]), "AMBIGUOUS")

    def test_a_recorded_verdict_that_differs_and_a_finding_that_fails_are_wrong(self):
        claim = {"failed": None, "findings": [finding("1", "2")], "verdict": "FALSE AS STATED", "evidence": "exact"}
        decide(claim)
        with self.assertRaises(Wrong):
            decide({**claim, "failed": "the check panicked"})
        with self.assertRaises(Wrong):
            decide({**claim, "verdict": "TRUE"})
        with self.assertRaises(Wrong):
            decide({**claim, "findings": [finding("1", expected="2")]})
        with self.assertRaises(Wrong):
            decide({**claim, "findings": [finding("1", context=True)]})


    def test_the_grade_is_that_of_the_weakest_finding_that_decides(self):
        exact, rounded = finding("1"), {**finding("1"), "found": 1.0}
        tried, looked = finding("1", origin="experiment"), finding("1", origin="look-up")
        self.assertEqual(grade([exact]), "exact")
        self.assertEqual(grade([exact, rounded]), "certified")
        self.assertEqual(grade([exact, {**rounded, "context": True}]), "exact")
        self.assertEqual(grade([rounded, tried]), "measured")
        self.assertEqual(grade([looked, tried]), "cited")
        self.assertEqual(grade([looked, finding("1", voice={"opinion": "taste"})]), "not-decidable")
        self.assertEqual(grade([exact, finding("1", voice={"opinion": "taste"}, context=True)]), "exact")
        for one, right in ((exact, "exact"), (rounded, "certified"), (tried, "measured"), (looked, "cited")):
            for told in ("exact", "certified", "measured", "cited", "not-decidable"):
                claim = {"failed": None, "findings": [one], "verdict": "TRUE", "evidence": told}
                with self.subTest(right=right, told=told):
                    if told == right:
                        decide(claim)
                    else:
                        with self.assertRaises(Wrong):
                            decide(claim)


CHANGES = (
    {"found": "abc"}, {"found": "1/0"}, {"relation": "near"}, {"found": float("nan")}, {"tolerance": "x"}, {"tolerance": float("inf")}, {"found": True},
    {"voice": {"reading": []}}, {"voice": {"nonsense": "a"}}, {"name": []}, {"stated": []}, {"stated": {}}, {"origin": "heaven"}, {"origin": None},
)


class TestCommand(unittest.TestCase):
    """The script as a command."""

    def run_on(self, text: str) -> tuple[int, str]:
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "w.json")
            file.write_text(text)
            out = io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
                return check_witnesses.main([str(file)]), out.getvalue()

    def test_exit_codes(self):
        claim = {"id": "S0.x", "verdict": "TRUE", "evidence": "exact", "failed": None, "findings": [finding("1")], "witnesses": [{"kind": "rank", **RIGHT["rank"][0]}]}
        counts = {"claims": 1, "findings": 1, "witnesses": 1}
        document = {"schema": "witnesses/1", "counts": counts, "of": 1, "selected": None, "claims": [claim]}
        self.assertEqual(self.run_on(json.dumps(document))[0], 0)
        claim["witnesses"][0]["rank"] = [2]
        code, out = self.run_on(json.dumps(document))
        self.assertEqual(code, 1)
        self.assertIn("S0.x: rank", out)
        claim["witnesses"][0]["kind"] = "unknown"
        self.assertEqual(self.run_on(json.dumps(document))[0], 1)
        for grade in ("gold", None, 3):
            self.assertEqual(self.run_on(json.dumps({**document, "claims": [{**claim, "evidence": grade}]}))[0], 2, grade)
        rounded = {**claim, "evidence": "exact", "findings": [{**finding("1"), "found": 1.0}], "witnesses": []}
        code, out = self.run_on(json.dumps({**document, "counts": {**counts, "witnesses": 0}, "claims": [rounded]}))
        self.assertEqual(code, 1)
        self.assertIn("give the grade certified, recorded is exact", out)
        for text in ("", "[]", "[" * 200_000, "{", "{}", json.dumps({**document, "schema": "witnesses/2"}), json.dumps({**document, "claims": [3]})):
            self.assertEqual(self.run_on(text)[0], 2, text)
        nothing = {"claims": 0, "findings": 0, "witnesses": 0}
        self.assertEqual(self.run_on(json.dumps({"schema": "witnesses/1", "counts": nothing, "of": 0, "selected": None, "claims": []}))[0], 1)

    def test_a_file_that_cannot_be_read_is_no_wrong_witness_and_no_traceback(self):
        counts = {"claims": 1, "findings": 1, "witnesses": 1}
        rank = {"kind": "rank", **RIGHT["rank"][0]}
        claim = {"id": "S0.x", "verdict": "TRUE", "evidence": "exact", "failed": None, "findings": [finding("1")], "witnesses": [rank]}
        unreadable = [{**finding("1"), **change} for change in CHANGES]
        unreadable.append({key: value for key, value in finding("1").items() if key != "tolerance"})
        claims = [None, [3], [{}], "claims", [{**claim, "witnesses": [3]}], [{**claim, "id": 3}], *([{**claim, "findings": [one]}] for one in unreadable)]
        for wrong in claims:
            code, out = self.run_on(json.dumps({"schema": "witnesses/1", "counts": counts, "of": 1, "selected": None, "claims": wrong}))
            self.assertEqual(code, 2, f"{wrong}: {out}")
        for witness in ({}, {"kind": "rank"}, {**rank, "matrix": [["1/0"]]}, {**rank, "matrix": 3}):
            document = {"schema": "witnesses/1", "counts": counts, "of": 1, "selected": None, "claims": [{**claim, "witnesses": [witness]}]}
            code, out = self.run_on(json.dumps(document))
            self.assertEqual(code, 1, f"{witness}: {out}")

    def test_a_part_is_not_taken_for_the_whole(self):
        claim = {"id": "S0.x", "verdict": "TRUE", "evidence": "exact", "failed": None, "findings": [finding("1")], "witnesses": [{"kind": "rank", **RIGHT["rank"][0]}]}
        counts = {"claims": 1, "findings": 1, "witnesses": 1}
        emptied, twice = {**claim, "witnesses": []}, {name: 2 * count for name, count in counts.items()}
        for claims, told in (([], counts), ([claim], twice), ([emptied], counts), ([claim, claim], twice)):
            code, out = self.run_on(json.dumps({"schema": "witnesses/1", "counts": told, "of": len(claims), "selected": None, "claims": claims}))
            self.assertEqual(code, 2, out)

    def test_a_selection_says_what_it_is_of(self):
        claim = {"id": "S4.x", "verdict": "TRUE", "evidence": "exact", "failed": None, "findings": [finding("1")], "witnesses": [{"kind": "rank", **RIGHT["rank"][0]}]}
        counts = {"claims": 1, "findings": 1, "witnesses": 1}
        chosen = {"group": "S4", "verdict": None, "severity": None, "kind": None}
        document = {"schema": "witnesses/1", "counts": counts, "of": 411, "selected": chosen, "claims": [claim]}
        code, out = self.run_on(json.dumps(document))
        self.assertEqual(code, 0, out)
        self.assertIn("a selection, group S4: 1 of 411 claims", out)
        nothing = dict.fromkeys(chosen)
        other = ({"selected": None}, {"of": 0}, {"of": "411"}, {"of": True}, {"selected": {"group": "S4"}}, {"selected": nothing}, {"selected": {**chosen, "kind": 3}})
        for change in (*other, {"selected": {**chosen, "group": "S"}}, {"selected": {**chosen, "verdict": "FALSE AS STATED"}}):
            code, out = self.run_on(json.dumps({**document, **change}))
            self.assertEqual(code, 2, f"{change}: {out}")
        for missing in ("of", "selected"):
            code, out = self.run_on(json.dumps({key: value for key, value in document.items() if key != missing}))
            self.assertEqual(code, 2)
            self.assertIn("moreau verify --export", out)

    def test_a_folder_an_empty_file_and_another_schema_are_told_with_the_cure(self):
        cases = (("", "it is empty"), ("{", "JSONDecodeError"), (json.dumps({"schema": "scene/1"}), "its schema is 'scene/1', not witnesses/1"))
        for text, told in cases:
            code, out = self.run_on(text)
            self.assertEqual(code, 2)
            self.assertIn(told, out)
            self.assertIn("; give a file that `moreau verify --export FILE` wrote", out)
        with tempfile.TemporaryDirectory() as folder:
            for place, told in ((folder, "it is a folder; give a file that `moreau verify --export FILE` wrote"), (f"{folder}/none.json", "No such file")):
                out = io.StringIO()
                with contextlib.redirect_stderr(out):
                    self.assertEqual(check_witnesses.main([place]), 2)
                self.assertIn(told, out.getvalue())
                self.assertEqual(out.getvalue().count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
