"""The mended contact frames of Siconos; needs Siconos."""

import math
import sys
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS), str(SCRIPTS / "engines")]

# The folder holds an adapter with the name of the package it needs: look without it.
_here = sys.path.pop(1)
try:
    import numpy as np
    import siconos.kernel  # noqa: F401
except ImportError:
    np = None
sys.path.insert(1, _here)


def siconos_frame(normal):
    """The frame of Siconos 4.4.0 where z is the largest component of the normal."""
    first = np.array([0.0, -normal[2], normal[0]])
    first /= np.linalg.norm(first)
    return np.array([normal, first, np.cross(first, normal)])


def slopes():
    """Unit normals of slopes up to 50° in every direction, z their largest component."""
    for tilt in range(0, 51, 10):
        for turn in range(0, 360, 15):
            sine, a = math.sin(math.radians(tilt)), math.radians(turn)
            yield np.array([sine * math.cos(a), sine * math.sin(a), math.sqrt(1 - sine * sine)])


@unittest.skipIf(np is None, "Siconos is not installed")
class Mended(unittest.TestCase):
    def mended(self, normal):
        from _siconos_relations import _mend
        frame = siconos_frame(normal)
        return _mend(frame) @ frame

    def test_the_frame_is_orthonormal_with_the_same_normal(self):
        for normal in slopes():
            if normal[2] < max(abs(normal[0]), abs(normal[1])):
                continue
            frame = self.mended(normal)
            self.assertLess(np.abs(frame @ frame.T - np.eye(3)).max(), 1e-14)
            self.assertLess(np.abs(frame[0] - normal).max(), 1e-14)

    def test_rounding_of_the_normal_does_not_turn_it(self):
        for normal in slopes():
            nudged = normal + 1e-15 * np.array([1.0, -1.0, 0.0])
            self.assertLess(np.abs(self.mended(normal) - self.mended(nudged)).max(), 1e-13)
            nudged = normal - 1e-15 * np.array([1.0, -1.0, 0.0])
            self.assertLess(np.abs(self.mended(normal) - self.mended(nudged)).max(), 1e-13)


if __name__ == "__main__":
    unittest.main()
