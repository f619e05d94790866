"""The collection's problems and exact answers, without a program; with one and with h5py, FCLIB files that `moreau` writes."""

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS)]

from generate_problems import MOST_CONTACTS  # noqa: E402
from problems import boxes, exact, small, steps  # noqa: E402
from problems.mechanism import Points, Space  # noqa: E402
from problems.posed import Posed  # noqa: E402
from problems.records import Contradiction, _better, _check, _several, _uniqueness, _with_answers, apart, text  # noqa: E402

ROOT = SCRIPTS.parent
STORED = ROOT / "references" / "problems"


def point(velocity, friction, law="coulomb"):
    """A point of 1 kg in the plane at one contact."""
    world = Points(2)
    world.touch(world.body([1, 1], velocity), [0.0, 1.0], friction)
    return world.problem("point", law)


class Exact(unittest.TestCase):
    def test_a_sliding_point_has_the_impulse_of_the_closed_form(self):
        # H = (0 1; 1 0): arrives at 1 m/s, slides at 2 m/s, μ = 1/2
        answers = exact.all_solutions(point([2, -1], 0.5))
        self.assertEqual(answers.impulses, [(Fraction(1), Fraction(-1, 2))])
        self.assertEqual((answers.undecided, answers.patterns), (0, 4))

    def test_a_rod_of_painleve_has_three_velocities_and_a_wrong_sign_of_friction_another_number(self):
        posed = {one.name: one for one in small.all_problems()}
        self.assertEqual(len(exact.all_solutions(posed["painleve-leaves"].document).velocities), 3)
        self.assertEqual(len(exact.all_solutions(posed["painleve-regular"].document).velocities), 1)
        turned = json.loads(text(posed["painleve-leaves"].document))
        turned["free_velocity"][1] *= -1
        self.assertEqual(len(exact.all_solutions(turned).velocities), 1)

    def test_what_has_no_solution_has_none_and_smooth_it_has(self):
        for one in small.all_problems():
            if one.no_solution:
                answers = exact.all_solutions(one.document)
                self.assertEqual((answers.velocities, answers.undecided), ([], 0), one.name)
        jammed = next(one for one in small.all_problems() if one.name == "wedge-jammed").document
        self.assertEqual(len(exact.all_solutions({**jammed, "friction": [0, 0]}).velocities), 1)

    def test_redundant_supports_have_one_velocity_and_no_pattern_is_left(self):
        beam = next(one for one in boxes.all_problems() if one.name == "beam-3-rest").document
        answers = exact.all_solutions(beam)
        self.assertEqual((len(answers.velocities), answers.undecided), (1, 0))
        self.assertTrue(all(u == 0 for u in answers.velocities[0]))

    def test_contacts_in_space_and_many_contacts_are_not_enumerated(self):
        world = Space()
        world.touch(world.ball(1, 1, [0] * 6), None, [0, 0, -1], None, [0.0, 0.0, 1.0], 0.5)
        self.assertIsNone(exact.all_solutions(world.problem("ball")))


class Contradictions(unittest.TestCase):
    def posed(self, **more):
        return Posed("single", "a point", point([2, -1], 0.5), **more)

    def answer(self, velocity):
        return {"velocity": velocity, "by": "pgs", "agreement": []}

    def test_a_false_velocity_is_noticed_and_the_right_one_passes(self):
        answers = exact.all_solutions(self.posed().document)
        right = {"answers": [self.answer([0.0, 1.5])], "solvers": []}
        _check(self.posed(), answers, right)
        self.assertIn("fractions", right["answers"][0]["agreement"][0]["by"])
        with self.assertRaises(Contradiction):
            _check(self.posed(), answers, {"answers": [self.answer([0.0, 1.4])], "solvers": []})

    def test_an_accepted_answer_of_an_unsolvable_problem_is_noticed(self):
        posed = self.posed(no_solution="it is said to have none")
        with self.assertRaises(Contradiction):
            _check(posed, None, {"answers": [], "solvers": [{"solver": "pgs", "ended": "solved"}]})
        with self.assertRaises(Contradiction):
            _check(posed, exact.all_solutions(posed.document), {"answers": [], "solvers": []})

    def test_a_closed_form_that_is_not_accepted_is_noticed(self):
        with self.assertRaises(Contradiction):
            _check(self.posed(closed=[1, 0], closed_by="a guess"), None, {"answers": [self.answer([0.0, 2.0])], "solvers": []})

    def test_answers_are_several_velocities_where_their_proved_radii_are_smaller_than_the_distances_between_them(self):
        def answer(velocity, radius):
            return {"velocity": velocity, "forward": {"reason": "none"} if radius is None else {"velocity": radius}}
        far = [answer([0.0, 0.0], 0.1), answer([0.0, 1.0], 0.1), answer([1.0, 0.0], 0.1)]
        self.assertEqual(apart(far), 3)
        # planted: enclosures that meet, a radius that is not proved, an answer that stands twice
        for spoilt, count in ((answer([0.0, 0.0], 1.0), 2), (answer([0.0, 0.0], 0.5), 2), (answer([0.0, 0.0], None), 2), (far[1], 2)):
            self.assertEqual(apart([spoilt, *far[1:]]), count, spoilt)
        self.assertEqual(apart([]), 0)
        posed = Posed("", "", {"name": "two"})
        unknown = {"velocity": "unknown", "reason": "not proved"}
        told = _several(unknown, 3, posed)
        self.assertEqual((told["velocity"], told["reason"].split(":")[0], "count" in told), ("several", "at least 3 velocities", False))
        self.assertEqual([_several(unknown, count, posed) for count in (0, 1)], [unknown, unknown])
        known = {"velocity": "several", "count": 3, "reason": "fractions"}
        self.assertEqual(_several(known, 3, posed), known)
        for other, count in ((known, 4), ({"velocity": "unique", "count": 1, "reason": "a theorem"}, 2), ({"velocity": "none", "reason": "fractions"}, 2)):
            with self.assertRaises(Contradiction):
                _several(other, count, posed)

    def test_what_certify_proves_is_told_with_its_own_reason_and_a_continuum_is_not_unique(self):
        posed, unknown = Posed("", "", {"name": "a problem"}), {"velocity": "unknown", "reason": "not proved"}

        def told(unique="unknown", **more):
            return _better(unknown, {"unique": unique, "reason": "of unique", **more}, posed)

        def every(velocities, continuum=False):
            return {"patterns": 16, "velocities": velocities, "continuum": continuum}
        self.assertEqual(told(), unknown)
        self.assertEqual(told("solution"), {"velocity": "unique", "reason": "moreau certify --prove: of unique", "count": 1})
        one, three = told(all=every(1)), told(all=every(3))
        self.assertEqual((one["velocity"], one["count"], three["velocity"], three["count"]), ("unique", 1, "several", 3))
        self.assertTrue(one["reason"].endswith("all 16 patterns were tried, and the solutions have exactly 1 velocity"), one)
        # met at one vertex, and not alone; the ends without all of them say the same
        for endless in (told(all=every(1, True)), told(continuum=[{}, {}])):
            self.assertEqual(endless, {"velocity": "several", "reason": "moreau certify --prove: the velocities are a continuum"})
        self.assertNotIn("count", told(several={"at_least": 2}))

    def test_one_velocity_without_an_answer_is_one_at_most(self):
        unique = {"velocity": "unique", "count": 1, "reason": "a theorem"}
        self.assertEqual(_with_answers(unique, [{}]), unique)
        self.assertEqual(_with_answers(unique, []), {"velocity": "at-most-one", "reason": "a theorem"})
        none = {"velocity": "none", "reason": "fractions"}
        self.assertEqual(_with_answers(none, []), none)

    def test_two_answers_alone_prove_no_two_velocities(self):
        posed = self.posed()
        self.assertEqual(_uniqueness(posed, None, [1, 2])["velocity"], "unique")  # one contact, not coupled
        oblique = json.loads(text(posed.document))
        oblique["jacobian"]["triplets"] = {"row": [0, 0, 1], "column": [0, 1, 0], "value": [0.5, 1, 1]}
        self.assertEqual(_uniqueness(Posed("single", "", oblique), None, [1, 2])["velocity"], "unknown")


class Stored(unittest.TestCase):
    def test_the_posed_problems_are_the_stored_ones(self):
        for module in (small, boxes, steps):
            for posed in (one for one in module.all_problems() if one.contacts <= MOST_CONTACTS):
                file = STORED / f"{posed.name}.json"
                self.assertTrue(file.exists() and file.read_text(encoding="utf-8") == text(posed.document), posed.name)

    def test_every_record_has_the_hash_of_its_problem(self):
        import hashlib
        for file in sorted(STORED.glob("*.json")):
            record = json.loads((STORED / "answers" / file.name).read_text(encoding="utf-8"))
            self.assertEqual(record["sha256"], hashlib.sha256(file.read_bytes()).hexdigest(), file.name)


@unittest.skipUnless(os.environ.get("MOREAU"), "set MOREAU to the program: it writes the files that are read back")
@unittest.skipUnless(importlib.util.find_spec("h5py"), "h5py is not installed: pip install h5py in the environment of these tests")
class Fclib(unittest.TestCase):
    def test_written_files_are_read_back_by_h5py_with_their_solution_and_guess(self):
        import h5py
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([os.environ["MOREAU"], "problems", "export", "--all", folder, "--to", "fclib"], check=True, capture_output=True)
            files = sorted(Path(folder).glob("*.hdf5"))
            self.assertGreater(len(files), 20)
            for path in files:
                problem = json.loads((STORED / f"{path.stem}.json").read_text(encoding="utf-8"))
                record = json.loads((STORED / "answers" / f"{path.stem}.json").read_text(encoding="utf-8"))
                with h5py.File(path) as file:
                    local = file["fclib_local"]
                    rows = problem["dimension"] * len(problem["friction"])
                    self.assertEqual(list(local["vectors/q"][()]), problem["free_velocity"], path.stem)
                    self.assertEqual(list(local["vectors/mu"][()]), problem["friction"])
                    self.assertEqual((int(local["spacedim"][()][0]), int(local["W/m"][()][0])), (problem["dimension"], rows))
                    self.assertEqual(len(local["W/x"]), int(local["W/p"][()][-1]))
                    if record["answers"]:
                        self.assertEqual(list(file["solution/r"][()]), record["answers"][0]["impulse"])
                    self.assertEqual(len(file["guesses/1/r"]), rows)

    def test_a_stored_r_of_zero_is_refused(self):
        import h5py
        with tempfile.TemporaryDirectory() as folder:
            moreau = os.environ["MOREAU"]
            subprocess.run([moreau, "problems", "export", "single-slide", folder, "--to", "fclib"], check=True, capture_output=True)
            path = Path(folder) / "single-slide.hdf5"
            self.assertEqual(subprocess.run([moreau, "certify", path], capture_output=True, check=False).returncode, 0)
            with h5py.File(path, "r+") as file:
                file["solution/u"][...] = file["fclib_local/vectors/q"][()]
                file["solution/r"][...] = 0.0
            self.assertEqual(subprocess.run([moreau, "certify", path], capture_output=True, check=False).returncode, 1)


if __name__ == "__main__":
    unittest.main()
