"""The five parts by PyMeshLab and by meshlabserver: the same triangles, and numbers that the saved files bear out.

The same triangles also by the calls that MeshLab's dialog copies to the clipboard.
"""

import csv
import os
import shutil
import subprocess
import unittest
import unittest.mock

from python_support import MESHES, PLUGIN, SOURCE, InFolder, euler, np, pymeshlab, read_stl, surface_faults, volume

import textlabel

# Calls as MeshLab 2025.07 copies them, and their values by hand: choices by name, points as lists.
COPIED = [
    ("ms.apply_text_label(text = 'B7')", {"text": "B7"}),
    (
        "ms.apply_text_label(text = 'B7', size = 6.500000, style = 1, placement = 2, "
        "position = numpy.array([0.000000, -20.000000, 8.000000]))",
        {
            "text": "B7",
            "size": 6.5,
            "style": "Engrave",
            "placement": "Point and direction",
            "position": [0, -20, 8],
        },
    ),
    (
        "ms.apply_text_label(text = 'B7', size = 6.500000, placement = 2, "
        "position = numpy.array([0.000000, -20.000000, 8.000000]), up = numpy.array([-1.000000, 2.000000, 0.000000]), "
        "align = 0, mirrored = True, language = 'de', tint = True, color = pymeshlab.Color(0, 87, 184, 255))",
        {
            "text": "B7",
            "size": 6.5,
            "placement": "Point and direction",
            "position": [0, -20, 8],
            "up": [-1, 2, 0],
            "align": "Left",
            "mirrored": True,
            "language": "de",
            "tint": True,
            "color": pymeshlab.Color(0, 87, 184, 255),
        },
    ),
]


def rows():
    """Lines of parts.tsv as dictionaries."""
    with open(MESHES / "parts.tsv", encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    return list(csv.DictReader(lines, delimiter="\t"))


def numbers(text):
    return [float(part) for part in text.split(",")]


def by_pymeshlab(row, output):
    keywords = {
        "style": row["style"],
        "size": float(row["size"]),
        "position": numbers(row["position"]),
        "direction": numbers(row["direction"]),
        "up": numbers(row["up"]),
        "extrude_along": row["along"],
    }
    if row["style"] != "flat":
        keywords["depth"] = float(row["depth"])
    return textlabel.label(MESHES / row["file"], row["text"], output, **keywords)


def by_meshlabserver(row, output):
    command = [SOURCE / "filter_textlabel" / "label.sh", MESHES / row["file"], output, row["text"]]
    options = {"--at": "position", "--along": "along"}
    options.update({f"--{name}": name for name in ("direction", "up", "style", "size")})
    for option, column in options.items():
        command += [option, row[column]]
    if row["style"] != "flat":
        command += ["--depth", row["depth"]]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def match(mesh, other, within):
    """Index of the nearest vertex of other for each vertex of mesh, and the largest distance on any axis.

    Looks at vertices whose x is within a distance only; -1 and infinity when there are none.
    """
    nearest, largest = np.full(len(mesh.points), -1), 0.0
    points, others = mesh.points.astype(float), other.points.astype(float)  # sorted by x, as read_stl leaves them
    starts = np.searchsorted(others[:, 0], points[:, 0] - within)
    ends = np.searchsorted(others[:, 0], points[:, 0] + within, "right")
    for i, (point, start, end) in enumerate(zip(points, starts, ends)):
        distances = np.abs(others[start:end] - point).max(axis=1)
        if len(distances):
            nearest[i] = start + distances.argmin()
        largest = max(largest, distances.min(initial=np.inf))
    return nearest, largest


def triangle_set(triangles):
    """Triangles with their smallest corner first, orientation kept."""
    first = triangles.argmin(axis=1)
    turned = [np.roll(t, -k) for t, k in zip(triangles, first)]
    return set(map(tuple, np.array(turned).tolist()))


class Parts(InFolder):
    def check_report(self, row, report, mesh):
        before = read_stl(MESHES / row["file"])
        borders = report["border_edges"]
        self.assertEqual(surface_faults(mesh, borders), [])
        self.assertEqual(borders > 0, row["borders"] != "0")
        self.assertEqual(len(mesh.triangles) - len(before.triangles), report["triangles_added"])
        self.assertEqual(euler(mesh), euler(before))
        self.assertEqual(euler(mesh), 2 - 2 * report["genus"] - int(row["borders"]))
        if not borders:
            grown = volume(mesh) - volume(before)
            rounding = 1e-6 * volume(before)
            self.assertAlmostEqual(report["volume_before"], volume(before), delta=rounding)
            self.assertAlmostEqual(report["volume_after"] - report["volume_before"], grown, delta=rounding)
            sign = {"emboss": 1, "engrave": -1, "flat": 0}[row["style"]]
            self.assertEqual(np.sign(np.round(grown, 2)), sign)

    def test_same_as_meshlabserver(self):
        served = bool(os.environ.get("TEXTLABEL_PLUGIN")) and bool(shutil.which("meshlabserver"))
        for row in rows():
            with self.subTest(row["file"]):
                ours, theirs = self.folder / "python.stl", self.folder / "server.stl"
                report = by_pymeshlab(row, ours)
                mesh = read_stl(ours)
                self.check_report(row, report, mesh)
                if not served:
                    continue
                by_meshlabserver(row, theirs)
                other = read_stl(theirs)
                rounding = 2 * float(np.spacing(np.abs(other.points).max()))
                to_other, distance = match(mesh, other, rounding)
                self.assertEqual(len(set(to_other)), len(mesh.points))
                self.assertEqual(len(mesh.points), len(other.points))
                self.assertLessEqual(distance, rounding)
                self.assertEqual(triangle_set(to_other[mesh.triangles]), triangle_set(other.triangles))
                print(f"{row['file']}: {len(mesh.triangles)} triangles, the same; coordinates within {distance:.2g}")
        if not served:
            self.skipTest("no meshlabserver, or TEXTLABEL_PLUGIN is not set")

    def test_text_alone_is_enough(self):
        for row in rows():
            with self.subTest(row["file"]):
                meshes = pymeshlab.MeshSet()
                meshes.load_new_mesh(str(MESHES / row["file"]))
                before = meshes.current_mesh().face_number()
                report = meshes.apply_filter(textlabel.FILTER, text="A43")
                self.assertEqual(meshes.current_mesh().face_number() - before, report["triangles_added"])
                self.assertGreater(report["volume_after"], report["volume_before"])
                self.assertAlmostEqual(float(np.linalg.norm(report["normal"])), 1, places=12)

    def test_flat_label_on_a_plane_has_the_outline_s_area(self):
        row = rows()[0]
        part = textlabel.Part(MESHES / row["file"])
        place = {"position": (0, -20, 8), "direction": (0, 0, 1), "up": (0, 1, 0), "size": 14}
        flat = part.label("A43", self.folder / "flat.ply", style="flat", **place)
        raised = part.label("A43", self.folder / "raised.stl", style="emboss", depth=1.5, **place)
        self.assertAlmostEqual(flat["volume_after"], flat["volume_before"], delta=1e-6)
        # A prism over the same outline.
        self.assertAlmostEqual(raised["volume_after"] - raised["volume_before"], 1.5 * flat["label_area"], delta=1e-3)
        colored = pymeshlab.MeshSet()
        colored.load_new_mesh(str(self.folder / "flat.ply"))
        mesh = colored.current_mesh()
        painted = (mesh.face_color_matrix()[:, :3] * 255).round().astype(int).tolist()
        corners = mesh.vertex_matrix()[mesh.face_matrix()]
        areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
        inside = np.array([color == [230, 60, 20] for color in painted])
        self.assertAlmostEqual(float(areas[inside].sum()), flat["label_area"], delta=1e-3)


class CopiedCalls(unittest.TestCase):
    def bracket(self):
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(MESHES / "bracket.stl"))
        return meshes, meshes.current_mesh().face_number()

    def test_same_as_apply_filter(self):
        for call, values in COPIED:
            with self.subTest(call):
                (ours, before), (theirs, _) = self.bracket(), self.bracket()
                report = eval(call, {"ms": ours, "numpy": np, "pymeshlab": pymeshlab})
                expected = theirs.apply_filter(textlabel.FILTER, **values)
                mesh, other = ours.current_mesh(), theirs.current_mesh()
                self.assertEqual(mesh.face_number(), before + report["triangles_added"])
                np.testing.assert_array_equal(mesh.vertex_matrix(), other.vertex_matrix())
                np.testing.assert_array_equal(mesh.face_matrix(), other.face_matrix())
                self.assertEqual(mesh.has_face_color(), other.has_face_color())
                if mesh.has_face_color():
                    np.testing.assert_array_equal(mesh.face_color_matrix(), other.face_color_matrix())
                for name in report.keys() - {"milliseconds"}:
                    np.testing.assert_array_equal(report[name], expected[name], name)
                self.assertEqual(report.keys(), expected.keys())
                # On a plane, all three: a prism over the letters.
                grown = report["volume_after"] - report["volume_before"]
                self.assertAlmostEqual(grown, report["depth"] * report["label_area"], delta=1e-3)
                self.assertEqual(report["depth"] < 0, values.get("style") == "Engrave")

    def test_method_is_bound_once(self):
        with unittest.mock.patch.object(pymeshlab.MeshSet, textlabel.FILTER):
            delattr(pymeshlab.MeshSet, textlabel.FILTER)  # as after pymeshlab.load_plugin alone
            self.assertFalse(hasattr(pymeshlab.MeshSet, textlabel.FILTER))
            textlabel.load_plugin()
            method = getattr(pymeshlab.MeshSet, textlabel.FILTER)
            for path in (None, PLUGIN):
                textlabel.load_plugin(path)
                self.assertIs(getattr(pymeshlab.MeshSet, textlabel.FILTER), method)
            self.assertEqual(pymeshlab.filter_list().count(textlabel.FILTER), 1)

    def test_method_of_pymeshlab_is_left_alone(self):
        with unittest.mock.patch.object(pymeshlab.MeshSet, textlabel.FILTER) as theirs:
            textlabel.load_plugin()
            self.assertIs(getattr(pymeshlab.MeshSet, textlabel.FILTER), theirs)


if __name__ == "__main__":
    textlabel.load_plugin()
    unittest.main(verbosity=2)
