"""Labels round a part, from Python and from its command line: how wide they are, and what cannot be done."""

import json
import math
import unittest

from python_support import MESHES, InFolder, euler, np, read_stl, run_module, surface_faults, volume

import textlabel

VALVE = MESHES / "valve.stl"
# The rim of the bonnet: round z, radius 23, between 40 and 44.
RIM = {"position": (0, -23, 41.5), "direction": (0, -1, 0), "size": 3, "depth": 0.5, "wrap": True}
TEXT = "DN 25 PN 16 1.4408 SN 0042"


class Wrap(InFolder):
    def label(self, text=TEXT, **changes):
        self.output = self.folder / "out.stl"
        return textlabel.label(VALVE, text, self.output, **{**RIM, **changes})

    def refused(self, *words, **changes):
        with self.assertRaises(textlabel.LabelError) as caught:
            self.label(**changes)
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_letters_lie_on_a_cylinder(self):
        part = read_stl(VALVE)
        for style, radius in [("Emboss", 23.5), ("Engrave", 22.5), ("Flat", 23)]:
            with self.subTest(style):
                report = self.label(style=style)
                mesh = read_stl(self.output)
                self.assertEqual(surface_faults(mesh), [])
                self.assertEqual(euler(mesh), euler(part))
                self.assertAlmostEqual(report["wrap_radius"], 23, places=3)
                self.assertEqual(list(report["wrap_axis"]), [0, 0, 1])
                self.assertAlmostEqual(report["least_stretch"], 1, places=2)
                self.assertGreater(report["surface_area"], 0.9 * report["label_area"])
                self.assertGreater(min(report["thinnest_stroke"], report["narrowest_gap"]), 0.1)
                height = {"Emboss": 0.5, "Engrave": -0.5, "Flat": 0}[style]
                # a ring of this height: a label's area times the mean of the radii, over the radius
                expected = report["label_area"] * height * (23 + height / 2) / 23
                self.assertAlmostEqual(volume(mesh) - volume(part), expected, delta=0.01 * abs(expected) + 1e-3)
                new = mesh.points[~np.isin(mesh.points.view("f4,f4,f4"), part.points.view("f4,f4,f4")).ravel()]
                across = np.hypot(new[:, 0], new[:, 1])
                self.assertAlmostEqual(float(across.max()), max(radius, 23), places=3)
                self.assertGreater(float(across.min()), min(radius, 23) * math.cos(math.radians(2.5)) - 1e-3)
                angles = np.degrees(np.arctan2(new[:, 0], -new[:, 1]))
                self.assertLess(float(angles.min()), -70)  # further round than any view shows
                self.assertGreater(float(angles.max()), 70)

    def test_a_radius_that_is_given_means_it(self):
        for wrap in (True, False):
            report = self.label(wrap_radius=23, up=(0, 0, 1), wrap=wrap)
            self.assertEqual(report["wrap_radius"], 23)

    def test_mistakes(self):
        self.refused("way round", text=TEXT + TEXT + TEXT)
        self.refused("turns away", text="A", size=8)
        self.refused("reach the axis", text="1", depth=23, style="Engrave")
        with self.assertRaises(textlabel.LabelError) as caught:
            textlabel.label(VALVE, "A", self.folder / "a.stl", wrap=True)
        self.assertIn("needs a place", str(caught.exception))
        with self.assertRaises(textlabel.LabelError) as caught:
            textlabel.label(MESHES / "bracket.stl", "A43", self.folder / "a.stl", wrap=True, position=(0, -20, 8))
        self.assertIn("no axis", str(caught.exception))

    def test_command_line(self):
        at = ["--at", "0,-23,41.5", "--direction", "0,-1,0", "--size", "2", "--depth", "0.3"]
        output = self.folder / "out.stl"
        run = run_module("label", str(VALVE), str(output), "DN 25", "--wrap", *at, "--also", "PN 16", *at[:1], "0,23,41.5", "--direction",
                         "0,1,0", *at[4:], "--wrap")
        self.assertEqual(run.returncode, 0, run.stderr)
        report = json.loads(run.stdout)
        for each in [report, *report["also"]]:
            self.assertAlmostEqual(each["wrap_radius"], 23, places=3)
        self.assertEqual(surface_faults(read_stl(output)), [])


if __name__ == "__main__":
    unittest.main()
