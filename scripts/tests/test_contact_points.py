"""Contact points of the simple shapes against geometry done by hand; no engine needed."""

import math
import random
import sys
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS / "engines")]

import _contact_points as contact  # noqa: E402

UPRIGHT = contact.rotation([1.0, 0.0, 0.0, 0.0])
GROUND = ([0.0, 0.0, 1.0], 0.0)
CUBE = [0.5, 0.5, 0.5]


def about(axis, angle):
    half = math.sin(angle / 2)
    return contact.rotation([math.cos(angle / 2), *(half * c for c in axis)])


class Points(unittest.TestCase):
    def near(self, found, exact, tolerance=1e-12):
        for a, b in zip(found, exact):
            self.assertAlmostEqual(a, b, delta=tolerance)

    def only(self, points):
        self.assertEqual(len(points), 1)
        return points[0]

    def test_a_rotation_takes_x_to_y_by_a_quarter_turn_about_z(self):
        turn = about([0, 0, 1], math.pi / 2)
        self.near([row[0] for row in turn], [0, 1, 0])

    def test_a_sphere_touches_the_ground_below_its_centre(self):
        gap, point, normal = self.only(contact.sphere_ground((0.5, [1, 2, 0.75], UPRIGHT), GROUND))
        self.near([gap, *point, *normal], [0.25, 1, 2, 0.25, 0, 0, 1])

    def test_a_box_touches_the_ground_with_corners(self):
        gaps = [p[0] for p in contact.box_ground((CUBE, [0, 0, 0.75], UPRIGHT), GROUND)]
        self.near(sorted(gaps), [0.25] * 4 + [1.25] * 4)
        tilted = (CUBE, [0, 0, 1], about([1, 0, 0], math.pi / 4))
        gaps = sorted(p[0] for p in contact.box_ground(tilted, GROUND))
        self.near(gaps[:3], [1 - math.sqrt(0.5)] * 2 + [1])

    def test_spheres_touch_on_the_line_of_centres(self):
        gap, point, normal = self.only(contact.sphere_sphere((1, [0, 3, 4], UPRIGHT),
                                                             (2, [0, 0, 0], UPRIGHT)))
        self.near([gap, *point, *normal], [2, 0, 2.4, 3.2, 0, 0.6, 0.8])

    def test_a_sphere_touches_the_nearest_face_edge_or_corner_of_a_box(self):
        def touch(x):
            return self.only(contact.sphere_box((0.25, x, UPRIGHT), (CUBE, [0, 0, 0], UPRIGHT)))
        self.near([touch([0, 0, 1])[0], *touch([0, 0, 1])[2]], [0.25, 0, 0, 1])
        self.near([touch([0, 0.8, 0.9])[0], *touch([0, 0.8, 0.9])[2]], [0.25, 0, 0.6, 0.8])
        self.near([touch([1, 1, 1])[0]], [math.sqrt(0.75) - 0.25])
        self.near([touch([0.4, 0, 0])[0], *touch([0.4, 0, 0])[2]], [-0.35, 1, 0, 0])

    def test_a_capsule_touches_the_ground_below_its_half_balls(self):
        tilted = ((0.25, 0.5), [1, 2, 1], about([1, 0, 0], math.pi / 6))
        (low, point, _), (high, _, _) = sorted(contact.capsule_ground(tilted, GROUND))
        reach = 0.5 * math.cos(math.pi / 6)
        self.near([low, high], [0.75 - reach, 0.75 + reach])
        # z turns to (0, -sin, cos): the lower ball is on the side of +y
        self.near(point, [1, 2 + 0.5 * math.sin(math.pi / 6), 0.75 - reach])

    def test_a_cylinder_stands_on_four_points_of_its_rim_and_lies_on_two(self):
        def gaps(turn, height):
            points = contact.cylinder_ground(((0.25, 0.5), [0, 0, height], turn), GROUND)
            return sorted(gap for gap, _, _ in points)
        self.near(gaps(UPRIGHT, 0.5), [0] * 4 + [1] * 4)
        self.near(gaps(about([1, 0, 0], math.pi / 2), 0.25), [0] * 2 + [0.25] * 4 + [0.5] * 2)

    def test_a_cylinder_s_lowest_point_is_that_of_its_support_function(self):
        rng = random.Random(7)
        for _ in range(50):
            axis, angle = [rng.gauss(0, 1) for _ in range(3)], rng.uniform(0, math.pi)
            length = math.hypot(*axis)
            turn = about([c / length for c in axis], angle)
            down = abs(turn[2][2])
            lowest = 2 - 0.5 * down - 0.25 * math.sqrt(max(0.0, 1 - down * down))
            points = contact.cylinder_ground(((0.25, 0.5), [1, 2, 2], turn), GROUND)
            self.near([min(gap for gap, _, _ in points)], [lowest])

    def test_a_sphere_touches_a_capsule_at_its_side_or_its_end(self):
        capsule = ((0.5, 1.0), [0, 0, 0], UPRIGHT)
        side = self.only(contact.sphere_capsule((0.25, [1, 0, 0.5], UPRIGHT), capsule))
        self.near([side[0], *side[2]], [0.25, 1, 0, 0])
        end = self.only(contact.sphere_capsule((0.25, [0.6, 0, 1.8], UPRIGHT), capsule))
        self.near([end[0], *end[2]], [0.25, 0.6, 0, 0.8])

    def test_capsules_touch_where_their_axes_are_next_to_each_other(self):
        rng = random.Random(11)

        def point(capsule, place):
            (_, half), x, turn = capsule
            return [x[i] + place * half * turn[i][2] for i in range(3)]

        for _ in range(40):
            pair = []
            for size in ((0.25, 0.5), (0.125, 1.0)):
                axis = [rng.gauss(0, 1) for _ in range(3)]
                length = math.hypot(*axis)
                pair.append((size, [rng.uniform(-1, 1) for _ in range(3)],
                             about([c / length for c in axis], rng.uniform(0, math.pi))))
            gap = self.only(contact.capsule_capsule(*pair))[0]
            places = [k / 40 for k in range(-40, 41)]
            nearest = min(math.dist(point(pair[0], a), point(pair[1], b))
                          for a in places for b in places) - 0.375
            self.assertLessEqual(gap, nearest + 1e-12)
            self.assertGreater(gap, nearest - 0.025)  # the ways between the places of the search

    def test_parallel_capsules_touch_at_the_ends_of_their_overlap(self):
        pair = [((0.25, 0.5), [1.0, 0, 0.75], UPRIGHT), ((0.25, 0.5), [0, 0, 0], UPRIGHT)]
        for (one, other), side in ((pair, 1), (pair[::-1], -1)):
            points = contact.capsule_capsule(one, other)
            self.near(sorted(p[1][2] for p in points), [0.25, 0.5])
            for gap, _, normal in points:
                self.near([gap, *normal], [0.5, side, 0, 0])

    def test_a_sphere_touches_a_cylinder_at_its_side_its_face_or_its_rim(self):
        cylinder = ((0.5, 1.0), [0, 0, 0], UPRIGHT)

        def touch(x):
            gap, _, normal = self.only(contact.sphere_cylinder((0.25, x, UPRIGHT), cylinder))
            return [gap, *normal]
        self.near(touch([0, 1, 0.5]), [0.25, 0, 1, 0])
        self.near(touch([0.1, 0, -1.5]), [0.25, 0, 0, -1])
        self.near(touch([0.5 + 0.3, 0, 1 + 0.4]), [0.25, 0.6, 0, 0.8])
        self.near(touch([0.4, 0, 0]), [-0.35, 1, 0, 0])
        self.near(touch([0.1, 0, 0.9]), [-0.35, 0, 0, 1])

    def test_stacked_boxes_touch_at_four_corners_with_the_normal_to_the_first(self):
        lower, upper = (CUBE, [0, 0, 0], UPRIGHT), (CUBE, [0, 0, 1.125], UPRIGHT)
        for pair, sign in (((upper, lower), 1), ((lower, upper), -1)):
            points = contact.box_box(*pair)
            self.assertEqual(len(points), 4)
            for gap, point, normal in points:
                self.near([gap, abs(point[0]), abs(point[1])], [0.125, 0.5, 0.5])
                self.near(normal, [0, 0, sign])

    def test_rounding_noise_makes_no_more_corners(self):
        noisy = about([0, 0, 1], 1e-12)
        self.assertEqual(len(contact.box_box((CUBE, [1e-13, 0, 1], noisy),
                                             (CUBE, [0, 0, 0], UPRIGHT))), 4)

    def test_a_turned_box_on_a_box_touches_at_an_octagon(self):
        points = contact.box_box((CUBE, [0, 0, 1], about([0, 0, 1], math.pi / 4)),
                                 (CUBE, [0, 0, 0], UPRIGHT))
        self.assertEqual(len(points), 8)
        for _, point, _ in points:  # every corner lies on the boundary of both squares
            self.assertAlmostEqual(max(abs(point[0]), abs(point[1])), 0.5, delta=1e-8)

    def test_boxes_side_by_side_have_no_point_beyond_their_faces(self):
        self.assertEqual(contact.box_box((CUBE, [2, 0, 0.99], UPRIGHT),
                                         (CUBE, [0, 0, 0], UPRIGHT))[0][2], [1, 0, 0])
        self.assertEqual(contact.box_box((CUBE, [1.2, 1.3, 0], UPRIGHT),
                                         (CUBE, [0, 0, 0], UPRIGHT)), [])

    def test_crossed_edges_touch_at_one_point(self):
        lower = (CUBE, [0, 0, 0], about([1, 0, 0], math.pi / 4))
        upper = (CUBE, [0.1, 0.2, 2.0], about([0, 1, 0], math.pi / 4))
        gap, point, normal = self.only(contact.box_box(upper, lower))
        self.near([gap, *normal], [2 - math.sqrt(2), 0, 0, 1])
        self.near(point, [0.1, 0, 2 - math.sqrt(0.5)])

    def test_which_box_is_first_only_turns_the_normal(self):
        generator = random.Random(7)
        for _ in range(200):
            boxes = []
            for _ in range(2):
                q = [generator.gauss(0, 1) for _ in range(4)]
                length = math.hypot(*q)
                boxes.append(([generator.uniform(0.1, 1) for _ in range(3)],
                              [generator.uniform(-1.5, 1.5) for _ in range(3)],
                              contact.rotation([c / length for c in q])))
            points, swapped = contact.box_box(*boxes), contact.box_box(*reversed(boxes))
            self.assertEqual(len(points), len(swapped))
            for (gap, _, normal), (other_gap, _, other_normal) in zip(points, swapped):
                self.near([gap, *normal], [other_gap, *(-c for c in other_normal)], 1e-9)


if __name__ == "__main__":
    unittest.main()
