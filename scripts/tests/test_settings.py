"""Settings in force, descriptions, and material values; no engine needed."""

import math
import sys
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS), str(SCRIPTS / "engines")]

from _protocol import Unsupported  # noqa: E402
from _scene import multiplied_values, pair_values, record, rotation_to_normal, smallest_values  # noqa: E402
from _settings import (contact_model, in_force, options_of,  # noqa: E402
                       require_declared_restitution)

PARAMETERS = {"stiffness": (1e5, "N/m"), "solref": ([0.02, 1.0], ["s", "1"])}
OPTIONS = {"iterations": 50, "solver": ("newton", "cg"), "warm": True}


def values(options=None, declared=None, fixed=()):
    request = {"options": options}
    if declared is not None:
        request["scene"] = {"engines": {"e": declared}}
    return in_force("e", PARAMETERS, OPTIONS, request, fixed)


class Settings(unittest.TestCase):
    def test_the_first_choice_is_the_default(self):
        self.assertEqual(values(), {"stiffness": 1e5, "solref": [0.02, 1.0], "iterations": 50,
                                    "solver": "newton", "warm": True})

    def test_the_request_overrides_the_scene_and_the_scene_the_defaults(self):
        self.assertEqual(values({"stiffness": 3}, {"stiffness": 2, "iterations": 7})["stiffness"], 3)
        self.assertEqual(values({"stiffness": 3}, {"iterations": 7})["iterations"], 7)

    def test_a_request_leaves_the_defaults_alone(self):
        values({"solref": [1, 2]})
        self.assertEqual(values()["solref"], [0.02, 1.0])

    def test_unknown_names_and_wrong_kinds_are_errors(self):
        for wrong in ({"typo": 1}, {"stiffness": "big"}, {"stiffness": math.inf},
                      {"stiffness": True}, {"iterations": 1.5}, {"warm": 1}, {"solref": [1]},
                      {"solref": 1}, {"solver": "lemke"}, {"solver": ["cg"]}):
            with self.assertRaises(ValueError, msg=wrong):
                values(wrong)

    def test_a_whole_number_may_come_as_a_float(self):
        self.assertIs(type(values({"iterations": 7.0})["iterations"]), int)

    def test_a_fixed_setting_accepts_its_own_value_only(self):
        self.assertEqual(values({"stiffness": 1e5}, fixed=("stiffness",))["stiffness"], 1e5)
        with self.assertRaisesRegex(Unsupported, "fixed"):
            values({"stiffness": 2e5}, fixed=("stiffness",))

    def test_a_description_has_the_values_in_force_with_their_units(self):
        chosen = values({"solref": [-5, -1], "solver": "cg"})
        model = contact_model("compliant", "law", PARAMETERS, chosen)
        self.assertEqual(model["parameters"]["solref"], {"value": [-5, -1], "unit": ["s", "1"]})
        self.assertEqual(options_of(OPTIONS, chosen),
                         {"iterations": 50, "solver": "cg", "warm": True})

    def test_restitution_needs_declared_parameters(self):
        scene = {"material": {"friction": 0, "restitution": 0.5}}
        with self.assertRaises(Unsupported):
            require_declared_restitution("e", scene)
        require_declared_restitution("e", {**scene, "engines": {"e": {"k": 2}}})
        require_declared_restitution("e", {"material": {"friction": 0, "restitution": 0}})


def scene(names, ground=True, pairs=()):
    return {"ground": {"normal": [0, 0, 1], "offset": 0} if ground else None,
            "bodies": [{"name": name} for name in names],
            "material": {"friction": 0.3, "restitution": 0.5, "pairs": list(pairs)}}


class Material(unittest.TestCase):
    def test_an_override_changes_its_pair_in_either_order(self):
        override = {"bodies": ["b", "ground"], "friction": 0.7}
        self.assertEqual(pair_values(scene("ab", pairs=[override]), "friction"),
                         {("ground", "a"): 0.3, ("ground", "b"): 0.7, ("a", "b"): 0.3})

    def test_factors_of_a_single_pair_multiply_exactly(self):
        self.assertEqual(multiplied_values(scene("a"), "restitution"), {"ground": 1.0, "a": 0.5})
        self.assertEqual(multiplied_values(scene("ab", ground=False), "friction"),
                         {"a": 1.0, "b": 0.3})

    def test_factors_of_equal_pairs_multiply_to_one_rounding(self):
        factors = multiplied_values(scene("abc"), "friction")
        for a, b in pair_values(scene("abc"), "friction"):
            self.assertAlmostEqual(factors[a] * factors[b], 0.3, delta=1e-16)

    def test_different_pairs_are_refused(self):
        override = {"bodies": ["b", "ground"], "friction": 0.7}
        with self.assertRaises(Unsupported):
            multiplied_values(scene("ab", pairs=[override]), "friction")
        multiplied_values(scene("ab", pairs=[override]), "restitution")

    def test_the_smaller_of_two_values_gives_one_sticky_pair_or_one_slippery_body(self):
        sticky = [{"bodies": ["a", "ground"], "friction": 0.7}]
        slippery = [{"bodies": ["a", other], "friction": 0.1} for other in ("ground", "b")]
        for overrides in (sticky, slippery):
            chosen = scene("ab", pairs=overrides)
            values = smallest_values(chosen, "friction")
            for (a, b), value in pair_values(chosen, "friction").items():
                self.assertEqual(min(values[a], values[b]), value)

    def test_pairs_that_no_minimum_gives_are_refused(self):
        pairs = [{"bodies": ["a", "b"], "friction": 0.1}]
        with self.assertRaises(Unsupported):
            smallest_values(scene("ab", pairs=pairs), "friction")

    def test_a_lonely_body_has_no_pair(self):
        for values in (multiplied_values, smallest_values):
            self.assertEqual(values(scene("a", ground=False), "friction"), {"a": 0.0})


class Ground(unittest.TestCase):
    def test_the_rotation_takes_up_to_the_normal(self):
        for normal in ([0, 0, 1], [0.6, 0, 0.8], [0, -1, 0], [0, 0, -1], [0.48, 0.6, -0.64]):
            w, x, y, z = rotation_to_normal(normal)
            up = [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]
            for one, other in zip(up, normal):
                self.assertAlmostEqual(one, other, delta=1e-15)


class Falling:
    """One body whose height is minus the number of steps, with one unit impulse per step."""

    def __init__(self):
        self.steps = 0

    def states(self):
        yield [0, 0, -self.steps], [1, 0, 0, 0], [0, 0, -1], [0, 0, 0]

    def step(self):
        self.steps += 1
        yield "a", "ground", [0, 0, 1], [0, 0, 1]


class Recording(unittest.TestCase):
    def test_the_samples_of_a_world_carry_the_impulses_of_their_steps(self):
        for step in (1 / 60, 1 / 120, 1 / 240, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4):
            for count in (1, 6, 999):
                request = {"scene": {**scene("a"), "duration": count * step}, "time_step": step,
                           "sample_every": 1}
                trajectory = record(request, {}, Falling())
                self.assertEqual(len(trajectory["times"]), count + 1)
                self.assertEqual([c["sample"] for c in trajectory["contacts"]],
                                 list(range(1, count + 1)))


if __name__ == "__main__":
    unittest.main()
