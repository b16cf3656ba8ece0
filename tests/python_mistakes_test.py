"""A Python user's mistakes: each is an exception that says what to do, the mesh stays as it was, and Python goes on."""

import os
import shutil
import subprocess
import sys
import unittest

from python_support import MESHES, PLUGIN, InFolder, Mesh, environment, np, pymeshlab, surface_faults

import textlabel

PLACE = {
    "placement": "Point and direction",
    "position": [0, -20, 8],
    "direction": [0, 0, 1],
    "size": 10.0,
    "depth": 1.0,
}

# What is wrong, keywords, words of the message (PyMeshLab's own where the filter is never reached)
RAW = [
    ("text is a number", {"text": 7}, ["cast"]),
    ("size is a text", {"text": "A", "size": "big"}, ["cast"]),
    ("position is a text", {"text": "A", "position": "here"}, ["convert"]),
    ("position is plane", {"text": "A", "position": [1, 2]}, ["position", "3 elements"]),
    ("unknown parameter", {"text": "A", "sise": 3.0}, ["sise"]),
    ("unknown style", {"text": "A", "style": "Carve"}, ["Carve", "Emboss"]),
    ("style out of range", {"text": "A", "style": 9}, ["9"]),
    ("half a character", {"text": "A\ud800"}, ["cast"]),
    ("missing font", {"text": "A", "font": "/no/such/font.ttf"}, ["/no/such/font.ttf", "fc-list"]),
    ("unknown family", {"text": "A", "font": "No Such Family"}, ["No Such Family", "fc-list"]),
    ("off the part", {"text": "A", **PLACE, "position": [1000, 0, 0]}, ["Move the position"]),
    ("over the edge", {"text": "A", **PLACE, "size": 100.0}, ["A", "near", "smaller"]),
    ("too deep", {"text": "A", **PLACE, "style": "Engrave", "depth": 20.0}, ["depth", "room"]),
    ("direction zero", {"text": "A", **PLACE, "direction": [0, 0, 0]}, ["direction is zero"]),
    ("negative size", {"text": "A", "size": -3.0}, ["size is -3", "above 0"]),
    ("size not a number", {"text": "A", "size": float("nan")}, ["nan", "finite"]),
    ("depth infinite", {"text": "A", **PLACE, "depth": float("inf")}, ["inf", "finite"]),
    ("empty text", {"text": ""}, ["text", "visible"]),
    ("no window", {"text": "A", "placement": "Current view"}, ["window", "Automatic"]),
    ("camera that is none", {"text": "A", "placement": "Camera", "camera": "x"}, ["camera", "XML"]),
    ("report into nowhere", {"text": "A", "report": "/no/such/folder/x.json"}, ["/no/such/folder/x.json", "written"]),
    ("missing letter", {"text": "\u6f22"}, ["\u6f22"]),
]

CHECKED = [
    ("text is a number", 7, {}, ["text", "7"]),
    ("size is a text", "A", {"size": "big"}, ["size", "a number", "'big'"]),
    ("truth is a number", "A", {"mirrored": 1}, ["mirrored", "true or false"]),
    ("position is plane", "A", {"position": [1, 2]}, ["position", "three numbers"]),
    ("colour is a name", "A", {"color": "red"}, ["color", "ff8000"]),
    ("colour of fractions", "A", {"color": (1.0, 0.5, 0)}, ["color", "(255, 128, 0)", "(1.0, 0.5, 0)"]),
    ("colour out of range", "A", {"color": (300, 0, 0)}, ["color", "(300, 0, 0)"]),
    ("colour below zero", "A", {"color": (0, -1, 0)}, ["color", "(0, -1, 0)"]),
    ("colour of two numbers", "A", {"color": (0, 1)}, ["color", "(0, 1)"]),
    ("direction alone", "A", {"direction": [0, 0, 1]}, ["direction alone", "position"]),
    ("direction and camera", "A", {"direction": [0, 0, 1], "camera": "x"}, ["direction alone", "position"]),
    ("camera without text", "A", {"camera": " \n"}, ["camera", "empty"]),
    ("beginning of two styles", "A", {"style": "e"}, ["style", "Emboss, Engrave"]),
    ("unknown parameter", "A", {"sise": 3}, ["sise", "Did you mean size"]),
    ("unknown style", "A", {"style": "carve"}, ["style", "Engrave", "carve"]),
    ("half a character", "A\ud800", {}, ["text"]),
]

AFTER_A_FAILURE = """
import sys, pymeshlab, textlabel
textlabel.load_plugin()
part, other, mesh_set = sys.argv[1], pymeshlab.MeshSet(), pymeshlab.MeshSet()
mesh_set.load_new_mesh(part)
try:
    {}
except Exception:
    print("refused")
del mesh_set
other.load_new_mesh(part)
print("read")
"""


def snapshot(meshes):
    mesh = meshes.current_mesh()
    arrays = (mesh.vertex_matrix(), mesh.face_matrix(), mesh.face_selection_array(), mesh.vertex_normal_matrix())
    return [array.tobytes() for array in arrays] + [mesh.has_face_color()]


class Mistakes(InFolder):
    def setUp(self):
        super().setUp()
        self.meshes = pymeshlab.MeshSet()
        self.meshes.load_new_mesh(str(MESHES / "bracket.stl"))

    def check_usable(self):
        before = self.meshes.current_mesh().face_number()
        report = self.meshes.apply_text_label(text="A43", **PLACE)
        self.assertEqual(self.meshes.current_mesh().face_number(), before + report["triangles_added"])
        self.assertEqual((report["border_edges"], report["genus"]), (0, 6))

    def test_of_the_filter_s_user(self):
        untouched = snapshot(self.meshes)
        for name, keywords, words in RAW:
            with self.subTest(name):
                with self.assertRaises(Exception) as caught:
                    self.meshes.apply_text_label(**keywords)
                for word in words:
                    self.assertIn(word, str(caught.exception))
                self.assertEqual(snapshot(self.meshes), untouched)
        self.check_usable()

    def test_of_the_module_s_user(self):
        untouched = snapshot(self.meshes)
        for name, text, keywords, words in CHECKED:
            with self.subTest(name):
                with self.assertRaises(textlabel.LabelError) as caught:
                    textlabel.label(self.meshes, text, **keywords)
                for word in words:
                    self.assertIn(word, str(caught.exception))
                self.assertEqual(snapshot(self.meshes), untouched)
        self.check_usable()

    def test_a_colour_may_be_three_numbers(self):
        for color in ((0, 87, 255), np.array([0, 87, 255], np.uint8), "0057ff", "#0057FF"):
            with self.subTest(color):
                self.meshes.apply_filter("generate_copy_of_current_mesh")
                textlabel.label(self.meshes, "A43", color=color, **PLACE)
                colors = (self.meshes.current_mesh().face_color_matrix()[:, :3] * 255).round().astype(int).tolist()
                self.assertIn([0, 87, 255], colors)
                self.meshes.delete_current_mesh()

    def test_called_twice(self):
        first = textlabel.label(self.meshes, "A43", **PLACE)
        labelled = snapshot(self.meshes)
        # The same place now has letters on it: the label is cut into them, or refused, and never half of it.
        try:
            second = textlabel.label(self.meshes, "A43", **PLACE)
            self.assertGreater(second["volume_after"], first["volume_after"])
            self.assertEqual((second["border_edges"], second["genus"]), (0, 6))
        except textlabel.LabelError as error:
            self.assertIn("near", str(error))
            self.assertEqual(snapshot(self.meshes), labelled)
        mesh = self.meshes.current_mesh()
        points, faces = np.unique(mesh.vertex_matrix(), axis=0, return_inverse=True)
        self.assertEqual(surface_faults(Mesh(points, faces.reshape(-1)[mesh.face_matrix()])), [])

    def test_a_file_is_read_after_the_mesh_set_of_a_failure_is_gone(self):
        method, on_a_set, on_a_file = (
            "mesh_set.apply_text_label(text='')",
            "textlabel.label(mesh_set, '')",
            "textlabel.label(part, '', 'x.stl')",
        )
        for failing in (method, on_a_set, on_a_file):
            with self.subTest(failing):
                ended = subprocess.run(
                    [sys.executable, "-c", AFTER_A_FAILURE.format(failing), MESHES / "bracket.stl"],
                    env={**environment(), "MALLOC_PERTURB_": "165"},  # what is freed is overwritten
                    cwd=self.folder,
                    capture_output=True,
                    text=True,
                )
                self.assertEqual((ended.stdout, ended.stderr, ended.returncode), ("refused\nread\n", "", 0))

    def test_loaded_twice(self):
        with self.assertRaises(pymeshlab.PyMeshLabException):
            pymeshlab.load_plugin(PLUGIN)
        textlabel.load_plugin()  # the module knows that it is there
        textlabel.load_plugin(PLUGIN)
        self.check_usable()

    def test_no_mesh(self):
        with self.assertRaises(textlabel.LabelError):
            textlabel.label(pymeshlab.MeshSet(), "A")
        self.check_usable()

    def test_points_without_faces(self):
        self.meshes.add_mesh(pymeshlab.Mesh(np.eye(3)))
        with self.assertRaises(textlabel.LabelError) as caught:
            textlabel.label(self.meshes, "A")
        self.assertIn("no faces", str(caught.exception))
        self.meshes.set_current_mesh(0)
        self.check_usable()

    def test_files(self):
        with self.assertRaises(textlabel.LabelError) as caught:
            textlabel.label(self.folder / "missing.stl", "A", self.folder / "out.stl")
        self.assertIn("missing.stl", str(caught.exception))
        for output in ("out.nothing", "no/folder/out.stl", "noending"):
            with self.subTest(output), self.assertRaises(textlabel.LabelError) as caught:
                textlabel.label(MESHES / "bracket.stl", "A", self.folder / output)
            self.assertIn(output, str(caught.exception))
        (self.folder / "broken.stl").write_bytes(b"solid nothing")
        with self.assertRaises(textlabel.LabelError):
            textlabel.label(self.folder / "broken.stl", "A", self.folder / "out.stl")
        self.assertEqual(os.listdir(self.folder), ["broken.stl"])
        with self.assertRaises(textlabel.LabelError):
            textlabel.label(MESHES / "bracket.stl", "A")

    def test_a_picture_that_does_not_fit_on_the_disk(self):
        import resource

        picture = self.folder / "picture.png"
        faces = self.meshes.current_mesh().face_number()
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
        try:
            with self.assertRaises(textlabel.LabelError) as caught:
                textlabel.label(self.meshes, "A43", picture=str(picture), **PLACE)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
        for words in ("was made, but not all was written", "picture.png", "has room"):
            self.assertIn(words, str(caught.exception))
        self.assertGreater(self.meshes.current_mesh().face_number(), faces)
        self.assertEqual(os.listdir(self.folder), [])
        self.check_usable()

    def test_relative_names_after_a_file_that_cannot_be_read(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        (self.folder / "below").mkdir()
        (self.folder / "below" / "broken.stl").write_bytes(b"solid nothing")
        shutil.copy(MESHES / "bracket.stl", "part.stl")
        with self.assertRaises(textlabel.LabelError):
            textlabel.label("below/broken.stl", "A", "out.stl")
        self.assertEqual(os.getcwd(), os.path.realpath(self.folder))
        textlabel.label("part.stl", "A", "below/out.stl")
        self.assertEqual(sorted(os.listdir("below")), ["broken.stl", "out.stl"])
        (self.folder / "removed").mkdir()
        os.chdir("removed")
        (self.folder / "removed").rmdir()
        textlabel.label(self.folder / "part.stl", "A", self.folder / "out.stl")

    def test_plugin_that_is_none(self):
        other = self.folder / "libother.so"
        other.write_bytes(b"no plugin")
        made_for_meshlab = os.environ.get("TEXTLABEL_PLUGIN")  # the same filter, as MeshLab 2020.09 takes it
        for path in filter(None, (str(other), str(self.folder / "missing.so"), made_for_meshlab)):
            with self.subTest(path), self.assertRaises(pymeshlab.PyMeshLabException):
                pymeshlab.load_plugin(path)
        self.check_usable()

    def test_every_choice_is_known_to_the_filter(self):
        for name, choices in textlabel.plugin.CHOICES.items():
            for number, choice in enumerate(choices):
                with self.subTest(f"{name}={choice}"):
                    self.assertEqual(textlabel.plugin.parse_value(name, choice.lower()), number)
                    try:
                        self.meshes.apply_text_label(text="", **{name: choice})
                    except Exception as error:
                        self.assertNotIn("Enum", str(error))
            with self.assertRaises(Exception) as caught:
                self.meshes.apply_text_label(text="", **{name: len(choices) + 1})
            self.assertIn("Enum", str(caught.exception))


if __name__ == "__main__":
    textlabel.load_plugin()
    unittest.main(verbosity=2)
