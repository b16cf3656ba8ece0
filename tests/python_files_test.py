"""Files that are more than one plain mesh: several objects, matrices, textures; and what is there when a save fails."""

import unittest

from python_support import (
    InFolder,
    box_points,
    np,
    read_stl,
    run_module,
    surface_faults,
    volume,
    write_3mf,
    write_gltf,
)

import textlabel

IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
PLACE = {"size": 7, "depth": 1, "direction": (0, 0, 1)}


class Layers(InFolder):
    def check(self, part, extent, solid, place):
        """The label's volume is all that the file has more than the objects, and every object is where it was."""
        out = self.folder / "out.stl"
        report = textlabel.label(part, "A4", out, position=place, **PLACE)
        mesh = read_stl(out)
        self.assertEqual(surface_faults(mesh), [])
        self.assertAlmostEqual(report["volume_before"], solid, delta=1e-4 * solid)
        self.assertAlmostEqual(volume(mesh), solid + report["label_area"], delta=1e-4 * solid)
        self.assertGreater(report["label_area"], 1)
        low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
        np.testing.assert_allclose([low, high], [extent[0], np.add(extent[1], (0, 0, 1))], atol=1e-3)

    def test_two_objects(self):
        boxes = [(box_points(40, 30, 10), IDENTITY), (box_points(20, 20, 10, (50, 0, 0)), IDENTITY)]
        write_gltf(self.folder / "two.gltf", boxes)
        matrix = "1 0 0 0 1 0 0 0 1 0 0 0"
        write_3mf(self.folder / "two.3mf", [(points, matrix) for points, _ in boxes])
        for name in ("two.gltf", "two.3mf"):
            with self.subTest(name):
                self.check(self.folder / name, ((0, 0, 0), (70, 30, 10)), 16000, (20, 15, 10))

    def test_two_objects_in_series(self):
        write_gltf(self.folder / "two.gltf", [(box_points(40, 30, 10, (x, 0, 0)), IDENTITY) for x in (0, 50)])
        done = run_module(
            *("serial", "two.gltf", "--count", "1", "--text", "A4", "--format", "stl", "--output", "out", "--quiet"),
            cwd=self.folder,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(volume(read_stl(self.folder / "out" / "two-A4.stl")), 24000)

    def test_matrices(self):
        inch = [25.4, 0, 0, 0, 0, 25.4, 0, 0, 0, 0, 25.4, 0, 100, 0, 0, 1]
        mirror = [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
        box = box_points(2, 1, 0.5)
        write_gltf(self.folder / "inch.gltf", [(box, inch)])
        write_gltf(self.folder / "mirror.gltf", [(box, inch), (box_points(40, 30, 10), mirror)])
        one = 25.4**3
        self.check(self.folder / "inch.gltf", ((100, 0, 0), (150.8, 25.4, 12.7)), one, (125, 12, 12.7))
        self.check(self.folder / "mirror.gltf", ((-40, 0, 0), (150.8, 30, 12.7)), one + 12000, (125, 12, 12.7))


if __name__ == "__main__":
    textlabel.load_plugin()
    unittest.main(verbosity=2)
