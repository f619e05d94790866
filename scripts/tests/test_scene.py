"""Reading scenes and recording trajectories; no engine needed."""

import sys
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS / "engines")]

import _scene  # noqa: E402
from _protocol import Unsupported  # noqa: E402


def scene(*pairs, bodies=("a", "b")):
    return {"ground": {"normal": [0, 0, 1], "offset": 0}, "duration": 0.5,
            "bodies": [{"name": name} for name in bodies],
            "material": {"friction": 0.5, "restitution": 0.25, "pairs": list(pairs)}}


class Mixing(unittest.TestCase):
    def test_the_common_value_of_all_pairs_is_kept_as_it_is(self):
        self.assertEqual(_scene.common_value(scene(), "friction"), 0.5)
        self.assertEqual(_scene.common_value(scene(), "restitution"), 0.25)

    def test_the_only_pair_may_have_its_own_value(self):
        own = {"bodies": ["ground", "a"], "friction": 0.1}
        self.assertEqual(_scene.common_value(scene(own, bodies=("a",)), "friction"), 0.1)

    def test_an_own_value_equal_to_the_others_is_no_difference(self):
        own = {"bodies": ["b", "a"], "friction": 0.5}
        self.assertEqual(_scene.common_value(scene(own), "friction"), 0.5)

    def test_pairs_with_different_values_are_unsupported(self):
        own = {"bodies": ["a", "b"], "friction": 0.1}
        with self.assertRaisesRegex(Unsupported, "0.1, 0.5"):
            _scene.common_value(scene(own), "friction")
        self.assertEqual(_scene.common_value(scene(own), "restitution"), 0.25)

    def test_a_lone_body_without_ground_touches_nothing(self):
        alone = scene(bodies=("a",)) | {"ground": None}
        self.assertEqual(_scene.common_value(alone, "friction"), 0.0)


class Steps(unittest.TestCase):
    def test_a_step_that_divides_the_duration_is_counted(self):
        self.assertEqual(_scene.step_count(scene(), 0.1), 5)
        self.assertEqual(_scene.step_count(scene(), 1 / 60), 30)

    def test_other_steps_are_errors(self):
        for time_step in (0.3, 1.5, 0.0, -0.1):
            with self.assertRaises(ValueError):
                _scene.step_count(scene(), time_step)

    def test_samples_are_a_whole_number_of_steps_apart(self):
        for count in (0, -1, 1.5, "2"):
            with self.assertRaisesRegex(ValueError, "sample_every"):
                _scene.Recorder(scene(), {}, 0.1, count)


if __name__ == "__main__":
    unittest.main()
