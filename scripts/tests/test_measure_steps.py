"""The measurement of steps: scenes, verdicts, tables and exit status, with a stand-in for moreau."""

import contextlib
import io
import json
import math
import os
import stat
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(SCRIPTS))

import measure_steps  # noqa: E402
from steps.runs import failure, judge, tally, verdict  # noqa: E402
from steps.scenes import HALF, heavy_on_light, thrown_pile, tumbling_box  # noqa: E402
from steps.tables import refused, table  # noqa: E402

MOREAU = os.environ.get("MOREAU")
# Acts on the name of the scheme or solver, so that each way to go wrong can be planted.
STAND_IN = '''#!{python}
import json, os, signal, sys
words = sys.argv[1:]
if "--list" in words:
    print(json.dumps({{"schemes": ["moreau-jean", "chrono", "refuses", "panics", "busy", "dies"],
                      "solvers": ["auto", "pgs"]}}))
    sys.exit()
option = dict(zip(words[1::2], words[2::2]))
scheme, name = option["--scheme"], json.load(open(option["--scene"]))["name"]
if scheme == "refuses":
    print("error: " + name + ": moves in the plane", file=sys.stderr)
    sys.exit(2)
if scheme == "panics":
    print("thread 'main' panicked at src/a.rs:1:2:\\nindex out of bounds", file=sys.stderr)
    sys.exit(101)
while scheme == "busy":
    pass
rejected = int(option["--solver"] == "pgs" or name == os.environ.get("BAD_SCENE"))
change = float(os.environ.get("CHANGE", "-1"))
gain, height = float(os.environ.get("GAIN", "0")), float(os.environ.get("HEIGHT", "0.1"))
if "--out" in option:
    json.dump({{"bodies": [{{"position": [[0, 0, 0.1], [0, 0, height]]}}]}}, open(option["--out"], "w"))
quantities = {{"initial energy": 10.0, "energy change": change, "deepest penetration": 1e-4,
              "largest energy gain in a step": gain}}
print(json.dumps({{"quantities": [{{"name": k, "value": v}} for k, v in quantities.items()],
                  "steps": {{"rejected": rejected, "unconverged": 0, "worst": {{"relative": 1e-9}}}}}}))
sys.exit(rejected)
'''


def summary(gain, change, steps=None):
    value = {"initial energy": 10.0, "energy change": change, "deepest penetration": 0.0,
             "largest energy gain in a step": gain}
    document = {"quantities": [{"name": k, "value": v} for k, v in value.items()]}
    return json.dumps(document | ({"steps": steps} if steps else {}))


class Scenes(unittest.TestCase):
    def test_the_seed_alone_decides_the_scene(self):
        self.assertEqual(tumbling_box(7), tumbling_box(7))
        self.assertNotEqual(tumbling_box(7), tumbling_box(8))

    def test_a_box_is_thrown_above_the_floor_within_its_ranges(self):
        for seed in range(200):
            one = tumbling_box(seed)
            body = one["bodies"][0]
            extents, material = body["box"]["half_extents"], one["material"]
            self.assertGreaterEqual(body["position"][2], math.hypot(*extents))
            self.assertTrue(all(0.05 <= x <= 0.2 for x in extents))
            self.assertLessEqual(math.hypot(*body["angular_velocity"]), 10.0)
            self.assertAlmostEqual(math.hypot(*body["orientation"]), 1.0)
            self.assertTrue(0 <= material["friction"] <= 1)
            self.assertIn(material["restitution"], (0.2, 0.4, 0.6, 0.8))

    def test_a_pile_falls_body_above_body(self):
        self.assertEqual(thrown_pile(7), thrown_pile(7))
        for seed in range(50):
            heights = [body["position"][2] for body in thrown_pile(seed)["bodies"]]
            self.assertIn(len(heights), (5, 8))
            self.assertEqual(heights, sorted(heights))

    def test_the_heavy_box_stands_on_the_light_one_or_above_it(self):
        for lands, gap in ((False, 0.0), (True, 0.02)):
            light, heavy = heavy_on_light(1e5, lands)["bodies"]
            self.assertEqual((light["mass"], heavy["mass"]), (1.0, 1e5))
            self.assertAlmostEqual(heavy["position"][2] - light["position"][2] - 2 * HALF, gap)


class Verdicts(unittest.TestCase):
    def test_gain_and_end_are_relative_to_the_initial_energy(self):
        self.assertFalse(judge(0, summary(0.0099, -1), "", 1)["gained"])
        self.assertTrue(judge(0, summary(0.0101, -1), "", 1)["gained"])
        self.assertTrue(judge(0, summary(0, 1e-9), "", 1)["higher"])

    def test_what_is_not_finite_gained_and_ended_higher(self):
        run = judge(0, summary(None, None), "", 1)
        self.assertTrue(run["gained"] and run["higher"])

    def test_an_old_summary_reports_no_steps(self):
        self.assertIsNone(verdict(judge(0, summary(0, -1), "", 1)))
        self.assertIsNone(tally({1: judge(0, summary(0, -1), "", 1)})["rejected"])

    def test_rejected_steps_are_counted_with_their_seed_and_worst_residual(self):
        steps = {"rejected": 3, "unconverged": 0, "worst": {"relative": 0.5}}
        good = {"rejected": 0, "unconverged": 0, "worst": None}
        row = tally({1: judge(0, summary(0, -1, good), "", 1), 2: judge(1, summary(0, -1, steps), "", 2)})
        self.assertEqual((row["runs"], row["rejected"], row["residual"], row["seconds"]), (2, 1, 0.5, 3))
        self.assertEqual([run["seed"] for run in row["bad"]], [2])

    def test_every_way_to_fail_is_named(self):
        self.assertEqual(failure(-24, ""), "time limit")
        self.assertEqual(failure(101, "note\nthread 'main' panicked at a.rs:1:\nwhy\n"),
                         "panic: thread 'main' panicked at a.rs:1: why")
        self.assertEqual(failure(-11, "anything"), "signal 11")
        self.assertEqual(failure(2, "error: no\nmore"), "exit code 2: error: no")
        self.assertEqual(judge(1, "", "error: no answer", 1)["failed"], "exit code 1: error: no answer")

    def test_a_scheme_refuses_only_if_every_run_says_the_same(self):
        no = [judge(2, "", f"error: box-{k}: moves in the plane", 1) for k in range(2)]
        self.assertEqual(refused(tally(dict(enumerate(no)))), "moves in the plane")
        self.assertIsNone(refused(tally(dict(enumerate(no + [judge(0, summary(0, -1), "", 1)])))))


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.binary = self.folder / "moreau"
        self.binary.write_text(STAND_IN.format(python=sys.executable))
        self.binary.chmod(self.binary.stat().st_mode | stat.S_IXUSR)

    def run_main(self, *words, **environment):
        text, previous = io.StringIO(), dict(os.environ)
        os.environ.update(environment)
        try:
            with contextlib.redirect_stdout(text), contextlib.redirect_stderr(io.StringIO()):
                status = measure_steps.main(["--moreau", str(self.binary), "--boxes", "3", "--piles", "2", "--ratios", "1,1e5,1e6",
                                             "--schemes", "moreau-jean", "--solvers", "auto", *words])
        finally:
            os.environ.clear(), os.environ.update(previous)
        return status, text.getvalue()

    def test_nothing_wrong_is_exit_status_0(self):
        status, text = self.run_main("--json", str(self.folder / "out.json"))
        self.assertEqual(status, 0, text)
        document = json.loads((self.folder / "out.json").read_text())
        self.assertEqual(document["tumbling"][0]["after"]["runs"], 3)
        self.assertEqual(document["thrown_piles"][0]["after"]["runs"], 2)
        self.assertEqual(len(document["heavy_on_light"]), 6)

    def test_each_planted_mistake_is_exit_status_1_and_named_with_its_seed(self):
        for words, environment, reason in (
                ((), {"BAD_SCENE": "box-1"}, "moreau-jean auto seed 1: 1 steps rejected"),
                ((), {"BAD_SCENE": "pile-1"}, "pile, moreau-jean auto seed 1: 1 steps rejected"),
                ((), {"BAD_SCENE": "heavy-lands-1e+05"}, "heavy lands on light, ratio 1e+05, auto: 1 rejected"),
                ((), {"CHANGE": "0.1"}, "moreau-jean auto seed 2: ends 1.00e-02"),
                ((), {"HEIGHT": "0.08"}, "heavy rests on light, ratio 1e+00, auto: a box sinks to 0.08 m"),
                (("--schemes", "panics"), {}, "panics auto seed 0: panic: thread 'main' panicked at src/a.rs"),
                (("--schemes", "busy", "--limit", "1", "--boxes", "1"), {}, "busy auto seed 0: time limit")):
            status, text = self.run_main(*words, **environment)
            self.assertEqual(status, 1, reason)
            self.assertIn(f"wrong: {reason}", text)

    def test_what_is_no_shortcoming_is_exit_status_0(self):
        for words, environment in (
                ((), {"GAIN": "0.1"}), (("--solvers", "pgs"), {}), (("--schemes", "refuses"), {}),
                (("--schemes", "chrono", "--solvers", "none", "--piles", "0"), {"GAIN": "1", "CHANGE": "1"}),
                ((), {"BAD_SCENE": "heavy-lands-1e+06"})):
            if words[:1] == ("--solvers",):
                words += ("--schemes", "none")
            status, text = self.run_main(*words, **environment)
            self.assertEqual(status, 0, text)

    def test_two_binaries_stand_side_by_side(self):
        _, text = self.run_main("--before", str(self.binary), "--markdown", "--ratios", "none")
        self.assertIn("| scheme | solver | runs before | runs after | gained before |", text)
        self.assertIn("| moreau-jean | auto | 3 | 3 | 0 | 0 |", text)

    def test_an_earlier_measurement_stands_beside_a_new_one_of_the_same_scenes_only(self):
        stored = str(self.folder / "before.json")
        self.run_main("--json", stored, "--boxes", "2", CHANGE="1")
        _, text = self.run_main("--before", stored, "--boxes", "2", "--markdown", "--ratios", "1")
        self.assertIn("| moreau-jean | auto | 2 | 2 | 0 | 0 | 2 | 0 |", text)
        with self.assertRaises(SystemExit) as end:
            self.run_main("--before", stored, "--boxes", "3")
        self.assertEqual(end.exception.code, 2)

    def test_wrong_usage_is_exit_status_2(self):
        for words in (["--schemes", "chronos"], ["--solvers", "nets"], ["--moreau", "no/such"], ["--jobs", "0"],
                      ["--ratios", "x"], ["--ratios", "-1"]):
            with self.assertRaises(SystemExit) as end:
                self.run_main(*words)
            self.assertEqual(end.exception.code, 2, words)

    @unittest.skipUnless(MOREAU, "set MOREAU to the program")
    def test_the_program_answers_what_is_read(self):
        status, text = self.run_main("--moreau", MOREAU, "--boxes", "1", "--ratios", "1", "--schemes", "moreau-jean,chrono")
        self.assertEqual(status, 0, text)


class Tables(unittest.TestCase):
    def test_markdown_and_text_show_the_same_cells(self):
        rows = [["a", 1, None, 0.25]]
        self.assertIn("| a | 1 | – | 0.25 |", table("t", ("w", "x", "y", "z"), rows, True))
        self.assertIn("a  1  –  0.25", table("t", ("w", "x", "y", "z"), rows, False))


if __name__ == "__main__":
    unittest.main()
