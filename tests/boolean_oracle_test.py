"""Labels on planar faces beside those of a mesh boolean (Manifold): the volume in which the two differ.

boolean_cases labels boxes and gridded plates, lying and turned, in doubles. Here the same letters become prisms, and the Manifold
library joins them to the part, or takes them from it. What is in one result and not in the other must be less than a millionth of
the label."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77
PROGRAM = pathlib.Path(os.environ.get("TEXTLABEL_BUILD_DIR", ".")) / "boolean_cases"
MOST = 1e-6  # of the label's volume
try:
    import manifold3d
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(SKIPPED)
if not PROGRAM.exists():
    print(f"skipped: no {PROGRAM}")
    sys.exit(SKIPPED)


class Case:
    """A file of boolean_cases."""

    def __init__(self, path):
        self.contours = []
        lines = iter(path.read_text().splitlines())
        for line in lines:
            word, *values = line.split()
            if word == "contour":
                self.contours.append(table(lines, int(values[0]), float))
            elif word in ("part", "labelled"):
                points = table(lines, int(values[0]), float)
                setattr(self, word, solid(points, table(lines, int(values[1]), np.uint64)))
            else:
                setattr(self, word, np.array(values, float))
        self.height = self.height[0]

    def area(self):
        """Of the letters, by the shoelace formula: holes count negative."""
        return sum(np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1)) for p in self.contours) / 2

    def volume(self):
        return self.area() * abs(self.height)

    def prisms(self, low, high, shift=0):
        """The letters between two heights over the label plane, shifted to the right."""
        flat = np.vstack(self.contours) + [shift, 0]
        caps = np.array(manifold3d.triangulate(self.contours, 0), int)
        origin, axes = self.frame[:3], self.frame[3:].reshape(3, 3)
        points = np.vstack([np.column_stack([flat, np.full(len(flat), z)]) @ axes + origin for z in (low, high)])
        walls, first = [], 0
        for contour in self.contours:
            a = np.arange(first, first + len(contour))
            b = np.roll(a, -1)
            walls += [np.column_stack([a, b, b + len(flat)]), np.column_stack([a, b + len(flat), a + len(flat)])]
            first += len(contour)
        return solid(points, np.vstack([caps[:, ::-1], caps + len(flat), *walls]))

    def by_boolean(self, shift=0):
        reach = abs(self.height)  # the prisms go into the part, or stand out of it
        if self.height > 0:
            return self.part + self.prisms(-reach, self.height, shift)
        return self.part - self.prisms(self.height, reach, shift)


def table(lines, count, kind):
    return np.array([next(lines).split() for _ in range(count)]).astype(kind)


def solid(points, triangles):
    mesh = manifold3d.Mesh64(np.ascontiguousarray(points), np.ascontiguousarray(triangles.astype(np.uint64)))
    result = manifold3d.Manifold(mesh)
    assert result.status() == manifold3d.Error.NoError, result.status()
    return result


def difference(a, b):
    """Volume of what is in one solid and not in the other. Of the ways to have it, this one is told right by Manifold where the
    two coincide but for rounding; its a - b may then lack whole pieces, and even have a negative volume."""
    return a.volume() + b.volume() - 2 * (a ^ b).volume()


class Boolean(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, folder], check=True)
            cls.cases = {file.stem: Case(file) for file in sorted(pathlib.Path(folder).glob("*.txt"))}

    def test_labels_are_those_of_a_boolean(self):
        self.assertGreater(len(self.cases), 30)
        worst = 0
        for name, case in self.cases.items():
            with self.subTest(name):
                peer = case.by_boolean()
                self.assertAlmostEqual(abs(peer.volume() - case.part.volume()) / case.volume(), 1, delta=1e-9)
                differs = abs(difference(case.labelled, peer)) / case.volume()
                worst = max(worst, differs)
                self.assertLess(differs, MOST)
        print(f"{len(self.cases)} labels; the one that differs most does so by {worst:.1e} of its volume")

    def test_a_shift_is_seen(self):
        """Shifted by d, a letter of area A and height h differs by d h times twice its extent in v, summed over the contours."""
        shift = 1e-4
        for name, case in self.cases.items():
            with self.subTest(name):
                rises = sum(np.abs(np.roll(p[:, 1], -1) - p[:, 1]).sum() for p in case.contours)
                expected = shift * abs(case.height) * rises
                self.assertAlmostEqual(difference(case.labelled, case.by_boolean(shift)) / expected, 1, delta=0.01)
                self.assertGreater(expected / case.volume(), 10 * MOST)


if __name__ == "__main__":
    unittest.main(verbosity=2)
