"""The comparison, the tolerances, the files' text and the plan; no engine needed."""

import copy
import io
import json
import sys
import tarfile
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS), str(SCRIPTS / "engines")]

import _problem  # noqa: E402
from _scene import Recorder, solid_inertia, step_count  # noqa: E402
from reference import documents, packages  # noqa: E402
from reference.compare import check, comparable, numbers_by_kind, tolerances_of  # noqa: E402
from reference.plan import Job, all_jobs  # noqa: E402
from reference.problems import all_problems  # noqa: E402
from reference.scenes import all_scenes  # noqa: E402
from reference.tolerance import EPSILON, loose_kinds  # noqa: E402


def trajectory():
    contact = {"sample": 1, "bodies": ["ball", "ground"], "normal": [0.0, 0.0, 1.0],
               "impulse": [0.0, 0.0, 0.1]}
    sensitivity = {"bodies/position": [2.0, 1e-9], "contacts/impulse": [1.0, 1e-6]}
    return {"schema": "trajectory/1", "scene": {"name": "s"}, "times": [0.0, 0.1],
            "bodies": [{"name": "ball", "position": [[0.0, 0.0, 1.0], [0.0, 0.0, 0.9]]}],
            "contacts": [contact],
            "provenance": {"steps": 100, "sensitivity": sensitivity}}


class Comparison(unittest.TestCase):
    def setUp(self):
        self.stored = trajectory()
        self.fresh = copy.deepcopy(self.stored)
        del self.fresh["provenance"]["sensitivity"]
        self.allowed = tolerances_of(self.stored, comparable(self.stored))

    def messages(self):
        return check(self.stored, self.fresh)[0]

    def test_the_same_document_agrees_and_no_control_is_blind(self):
        self.assertEqual(check(self.stored, self.fresh), ([], []))

    def test_the_tolerance_is_the_documented_formula(self):
        expected = 8 * (2.0 * 100 * EPSILON + 1e-9) + 64 * EPSILON * 1.0
        self.assertAlmostEqual(self.allowed["bodies/position"], expected, delta=1e-24)

    def test_half_the_tolerance_agrees_and_ten_times_does_not(self):
        for factor, count in ((0.5, 0), (10.0, 1)):
            change = factor * self.allowed["bodies/position"]
            self.fresh["bodies"][0]["position"][1][2] = 0.9 + change
            self.assertEqual(len(self.messages()), count)

    def test_inputs_must_agree_exactly(self):
        self.fresh["times"][1] += 1e-15
        self.assertEqual(len(self.messages()), 1)

    def test_a_missing_number_a_missing_key_and_a_text_are_differences(self):
        for change in (lambda d: d["bodies"][0]["position"].pop(),
                       lambda d: d.pop("times"),
                       lambda d: d["scene"].update(name="t")):
            self.fresh = copy.deepcopy(self.stored)
            change(self.fresh)
            self.assertTrue(self.messages())

    def test_an_absent_contact_has_impulse_zero(self):
        self.fresh["contacts"] = []
        self.assertEqual(len(self.messages()), 1)
        self.stored["contacts"][0]["impulse"] = [0.0, 0.0, 1e-9]
        self.assertEqual(self.messages(), [])

    def test_nan_is_a_difference(self):
        self.fresh["bodies"][0]["position"][1][2] = float("nan")
        self.assertEqual(len(self.messages()), 1)

    def test_a_loose_tolerance_is_named(self):
        table = numbers_by_kind(comparable(self.stored))
        self.assertEqual(loose_kinds(table, self.allowed), [])
        self.stored["provenance"]["sensitivity"]["bodies/position"][1] = 1e-3
        allowed = tolerances_of(self.stored, comparable(self.stored))
        self.assertEqual(len(loose_kinds(table, allowed)), 1)


class Text(unittest.TestCase):
    def test_a_document_survives_writing_and_reading_exactly(self):
        document = {**trajectory(), "odd": [0.1 + 0.2, 5e-324, -0.0, [], {}, [[]]]}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "deep" / "file.json"
            documents.write(path, document)
            self.assertEqual(json.dumps(documents.read(path)), json.dumps(document))
            self.assertEqual([p.name for p in path.parent.iterdir()], ["file.json"])

    def test_nan_is_never_written_or_read(self):
        with self.assertRaises(ValueError):
            documents.render({"x": float("inf")})


class Recording(unittest.TestCase):
    def test_impulses_are_summed_over_the_sample_interval_and_ground_comes_second(self):
        scene = {"bodies": [{"name": "ball"}]}
        state = [([0.0] * 3, [1.0, 0.0, 0.0, 0.0], [0.0] * 3, [0.0] * 3)]
        recorder = Recorder(scene, {}, 0.1, 2)
        recorder.sample(0, state)
        recorder.contact("ground", "ball", [0, 0, -1], [0, 0, -1])
        recorder.contact("ball", "ground", [0, 0, 1], [1, 0, 2])
        self.assertTrue(recorder.due(2) and not recorder.due(3))
        recorder.sample(2, state)
        recorder.sample(4, state)
        self.assertEqual(recorder.trajectory["contacts"],
                         [{"sample": 1, "bodies": ["ball", "ground"], "normal": [0.0, 0.0, 1.0],
                           "impulse": [1.0, 0.0, 3.0]}])

    def test_steps_must_divide_the_duration(self):
        self.assertEqual(step_count({"duration": 1.0}, 2e-3), 500)
        with self.assertRaises(ValueError):
            step_count({"duration": 1.0}, 3e-3)

    def test_solid_inertia_of_a_cube(self):
        cube = {"mass": 3.0, "box": {"half_extents": [1.0, 1.0, 1.0]}}
        self.assertEqual(solid_inertia(cube), [2.0, 2.0, 2.0])


class Plan(unittest.TestCase):
    def test_paths_are_unique_and_scenes_exist(self):
        jobs = all_jobs()
        self.assertEqual(len({job.path for job in jobs}), len(jobs))
        scenes = {job.scene for job in jobs if isinstance(job, Job)}
        self.assertLessEqual(scenes, set(all_scenes()))

    def test_every_motion_ends_on_a_sample(self):
        for job in all_jobs():
            if isinstance(job, Job) and not (job.is_dump or job.contacts):
                steps = step_count(all_scenes()[job.scene], job.time_step)
                self.assertLessEqual(job.steps, steps, job.path)
                self.assertEqual(steps % (job.sample_every or 1), 0, job.path)

    def test_every_problem_is_one_that_the_adapters_read(self):
        for name, document in all_problems().items():
            problem = _problem.read(document)
            self.assertEqual(problem.name, name)
            self.assertGreater(min(problem.delassus[i][i] for i in range(problem.rows)), 0.0)


class Packages(unittest.TestCase):
    def test_lines_are_found_by_file_and_expression_and_lose_their_comment(self):
        text = b"a = 1;  // one\nb = 2;\n"
        with tempfile.TemporaryDirectory() as folder:
            archive = Path(folder) / "package.tar.gz"
            with tarfile.open(archive, "w:gz") as tar:
                for name in ("p/x.h", "p/y.h"):
                    member = tarfile.TarInfo(name)
                    member.size = len(text)
                    tar.addfile(member, io.BytesIO(text))
            names, texts = packages._archive(archive, {r"/x\.h$": r"a = "})
        self.assertEqual((names, list(texts)), (["p/x.h", "p/y.h"], ["p/x.h"]))
        found = packages._lines(texts, {r"/x\.h$": r"a = "})
        self.assertEqual(found, [{"file": "p/x.h", "text": "a = 1;"}])


if __name__ == "__main__":
    unittest.main()
