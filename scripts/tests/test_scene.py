"""Reading scenes and recording trajectories; no engine needed."""

import math
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


class Declared(unittest.TestCase):
    def scene(self, **body):
        shape = {} if {"box", "capsule", "cylinder"} & set(body) else {"sphere": {"radius": 1.0}}
        return {"bodies": [{"name": "one", "position": [0, 0, 0], **shape, **body}]}

    def test_what_is_declared_is_taken(self):
        _scene.require_declared({"name": "toy"}, self.scene(mass=1.0))
        _scene.require_declared({"name": "toy", "bodies": ["free", "static"]}, self.scene(static=True))
        _scene.require_declared({"name": "toy", "shapes": ["capsule"]},
                                self.scene(mass=1.0, capsule={"radius": 1.0, "half_height": 1.0}))

    def test_what_is_not_declared_is_unsupported_by_name(self):
        for body, word in (({"static": True}, "static"), ({"prescribed": {"velocity": [1, 0, 0]}}, "prescribed"),
                           ({"mass": 1.0, "cylinder": {"radius": 1.0, "half_height": 1.0}}, "cylinder"),
                           ({"mass": 1.0, "helix": {}}, "helix")):
            with self.assertRaisesRegex(Unsupported, word):
                _scene.require_declared({"name": "toy"}, self.scene(**body))

    def test_a_prescribed_body_starts_with_its_velocity(self):
        body = self.scene(prescribed={"velocity": [1, 2, 3]})["bodies"][0]
        self.assertEqual(_scene.initial_state(body)[2:], ([1, 2, 3], [0.0] * 3))

    def test_a_prescribed_body_is_where_its_velocities_take_it(self):
        # a quarter turn about z in half a second of π rad/s takes a body that was turned about x
        half = math.sqrt(0.5)
        body = {"name": "b", "position": [1, 2, 3], "orientation": [half, half, 0, 0],
                "prescribed": {"velocity": [2, 0, -1], "angular_velocity": [0, 0, math.pi]}}
        position, orientation, linear, angular = _scene.prescribed_state(body, 0.5)
        self.assertEqual((position, linear, angular), ([2, 2, 2.5], [2, 0, -1], [0, 0, math.pi]))
        for found, exact in zip(orientation, [0.5, 0.5, 0.5, 0.5]):
            self.assertAlmostEqual(found, exact, delta=1e-15)

    def test_a_static_body_stays(self):
        body = {"name": "b", "position": [1, 2, 3], "static": True}
        self.assertEqual(_scene.prescribed_state(body, 7.0),
                         ([1, 2, 3], [1, 0, 0, 0], [0] * 3, [0] * 3))

    def test_a_long_capsule_has_nearly_the_moments_of_a_cylinder_and_a_short_one_those_of_a_ball(self):
        def moments(shape, half_height):
            return _scene.solid_inertia({"mass": 1.0, shape: {"radius": 1.0, "half_height": half_height}})

        for found, expected in zip(moments("capsule", 1e-9), (0.4, 0.4, 0.4)):
            self.assertAlmostEqual(found, expected, 6)
        self.assertAlmostEqual(moments("capsule", 1e6)[2], moments("cylinder", 1e6)[2], 6)


if __name__ == "__main__":
    unittest.main()
