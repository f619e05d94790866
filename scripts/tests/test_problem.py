"""Reading contact problems and writing solutions; no engine needed."""

import copy
import sys
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS / "engines")]

import _problem  # noqa: E402

BLOCK = {"schema": "contact-problem/1", "name": "block", "dimension": 2, "law": "coulomb",
         "friction": [0.5], "free_velocity": [-0.25, 0.5], "shift": [0.125, 0],
         "delassus": {"shape": [2, 2], "rows": [[1, 0.25], [0.25, 3]]},
         "compliance": {"coordinates": "contact", "diagonal": [0.5, 0]}}


def changed(**fields):
    return {**copy.deepcopy(BLOCK), **fields}


class Reading(unittest.TestCase):
    def refused(self, document, words):
        with self.assertRaisesRegex(ValueError, words):
            _problem.read(document)

    def test_shift_and_compliance_go_to_the_law_and_not_to_the_velocity(self):
        problem = _problem.read(BLOCK)
        self.assertEqual(problem.stiff_operator(), [[1.5, 0.25], [0.25, 3.0]])
        self.assertEqual(problem.law_free_velocity(), [-0.125, 0.5])
        self.assertEqual(problem.velocity([1.0, -1.0]), [0.5, -2.25])
        self.assertEqual(problem.delassus, [[1.0, 0.25], [0.25, 3.0]])

    def test_shift_and_compliance_may_be_absent(self):
        document = changed(shift=None)
        del document["compliance"]
        problem = _problem.read(document)
        self.assertEqual(problem.law_free_velocity(), [-0.25, 0.5])
        self.assertEqual(problem.stiff_operator(), problem.delassus)

    def test_triplets_are_the_same_matrix_as_rows(self):
        triplets = {"row": [0, 0, 1, 1], "column": [0, 1, 0, 1], "value": [1, 0.25, 0.25, 3]}
        sparse = changed(delassus={"shape": [2, 2], "triplets": triplets})
        self.assertEqual(_problem.read(sparse).delassus, _problem.read(BLOCK).delassus)
        triplets["column"][3] = 0
        self.refused(sparse, "delassus.triplets.*twice")
        triplets["column"][3] = 2
        self.refused(sparse, "delassus.triplets.*outside")

    def test_mass_and_jacobian_make_the_operator(self):
        document = changed(mass={"shape": [2, 2], "rows": [[2, 0], [0, 4]]},
                           jacobian={"shape": [2, 2], "rows": [[1, 0], [-1, 1]]})
        self.refused(document, "delassus: must be given alone")
        del document["delassus"]
        operator = _problem.read(document).delassus
        for row, exact in zip(operator, [[0.5, -0.5], [-0.5, 0.75]]):
            for entry, value in zip(row, exact):
                self.assertAlmostEqual(entry, value, delta=1e-15)
        document["mass"]["rows"][0][0] = -2
        self.refused(document, "mass: is not positive definite")
        document["mass"]["rows"][0] = [2, 1]
        self.refused(document, "mass: is not symmetric")

    def test_a_full_mass_matrix_is_inverted(self):
        # M⁻¹ of [[2, 1], [1, 2]] is [[2, −1], [−1, 2]]/3
        operator = _problem.delassus([[2.0, 1.0], [1.0, 2.0]], [[1.0, 0.0], [1.0, 1.0]])
        for row, exact in zip(operator, [[2 / 3, 1 / 3], [1 / 3, 2 / 3]]):
            for entry, value in zip(row, exact):
                self.assertAlmostEqual(entry, value, delta=1e-15)

    def test_every_mistake_is_named(self):
        self.refused(changed(schema="contact-problem/2"), "schema")
        self.refused(changed(colour="red"), "colour")
        self.refused(changed(dimension=4), "dimension")
        self.refused(changed(law="culomb"), "law")
        self.refused(changed(directions=4), "directions")
        self.refused(changed(law="polyhedral-coulomb"), "directions")
        self.refused(changed(friction=[-0.5]), "friction")
        self.refused(changed(free_velocity=[0.0]), "free_velocity.*size 1")
        self.refused(changed(free_velocity=[0.0, float("nan")]), "free_velocity.*nan")
        self.refused(changed(free_velocity=[0.0, "1"]), "free_velocity")
        self.refused(changed(dimension=1, friction=[0.5, 0.0]), "friction.*no tangential row")
        self.refused(changed(delassus={"shape": [3, 3], "rows": []}), "delassus.*shape")
        self.refused(changed(delassus={"shape": [2, 2], "rows": [[1, 0]]}), "delassus.rows")
        self.refused(changed(delassus={"shape": [2, 2]}), "delassus.*none")
        self.refused(changed(compliance={"coordinates": "body", "diagonal": []}), "coordinates")
        self.refused(changed(compliance={"coordinates": "contact", "diagonal": [1]}), "diagonal")


class Writing(unittest.TestCase):
    def test_a_solution_carries_its_own_velocity(self):
        self.assertEqual(
            _problem.read(BLOCK).solution([1.0, -1.0], "by hand", 3),
            {"schema": "solution/1", "problem": "block", "impulse": [1.0, -1.0],
             "velocity": [0.5, -2.25], "solver": "by hand", "iterations": 3})


if __name__ == "__main__":
    unittest.main()
