"""Files that are more than one plain mesh: several objects, matrices, textures; and what is there when a save fails."""

import collections
import contextlib
import os
import shutil
import unittest

from python_support import (
    BOX_TRIANGLES,
    MESHES,
    QUADS,
    InFolder,
    Mesh,
    box_points,
    np,
    pymeshlab,
    read_stl,
    run_module,
    surface_faults,
    volume,
    write_3mf,
    write_gltf,
    write_textured_box,
)

import textlabel
from textlabel.part import _unite_layers

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

    def test_a_mesh_set_with_a_matrix(self):
        for mirrored in (1, -1):
            meshes = pymeshlab.MeshSet()
            meshes.add_mesh(pymeshlab.Mesh(np.array(box_points(40, 30, 10), float), BOX_TRIANGLES))
            matrix = np.diag([2.0 * mirrored, 2, 2, 1])
            meshes.apply_filter("set_matrix", transformmatrix=matrix, freeze=False)
            out = self.folder / "out.stl"
            report = textlabel.label(meshes, "H", out, position=(40 * mirrored, 30, 20), **PLACE)
            mesh = read_stl(out)
            low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
            np.testing.assert_allclose([low, high], [(min(0, 80 * mirrored), 0, 0), (max(0, 80 * mirrored), 60, 21)], atol=1e-4)
            self.assertAlmostEqual(volume(mesh), 96000 + report["label_area"], delta=1)
            self.assertEqual(len(meshes), 1)  # and that one as it was, but for the label
            np.testing.assert_array_equal(meshes.current_mesh().transform_matrix(), matrix)
            self.assertAlmostEqual(meshes.current_mesh().vertex_matrix()[:, 0].max(), 40)

    def test_inches(self):
        write_3mf(self.folder / "inch.3mf", [(box_points(4, 3, 1), "1 0 0 0 1 0 0 0 1 0 0 0")], unit="inch")
        with self.assertRaisesRegex(textlabel.LabelError, "unit inch.*millimetres"):
            textlabel.label(self.folder / "inch.3mf", "A4", self.folder / "out.stl")
        broken = bytearray((self.folder / "inch.3mf").read_bytes())
        for i in range(40, len(broken) // 2, 3):
            broken[i] ^= 0x55
        for data in (broken, broken[:100], b""):
            (self.folder / "broken.3mf").write_bytes(data)
            with self.assertRaisesRegex(textlabel.LabelError, "cannot be read"):
                textlabel.label(self.folder / "broken.3mf", "A4", self.folder / "out.stl")

    def test_a_part_keeps_the_colours_of_its_vertices(self):
        meshes = pymeshlab.MeshSet()
        green = np.tile([0.0, 1, 0, 1], (8, 1))
        meshes.add_mesh(pymeshlab.Mesh(np.array(box_points(40, 30, 10), float), BOX_TRIANGLES, v_color_matrix=green))
        textlabel.label(meshes, "H", style="Flat", color="0000ff")
        colors = {tuple(color) for color in meshes.current_mesh().face_color_matrix()}
        self.assertEqual(colors, {(0, 1, 0, 1), (0, 0, 1, 1)})

    def test_an_object_without_colours_beside_one_that_has_some(self):
        meshes = pymeshlab.MeshSet()
        red = np.tile([1.0, 0, 0, 1], (12, 1))
        points = np.array(box_points(2, 2, 2), float)
        meshes.add_mesh(pymeshlab.Mesh(points, BOX_TRIANGLES, f_color_matrix=red))
        meshes.load_new_mesh(str(MESHES / "bracket.stl"))
        count = meshes.current_mesh().face_number()
        _unite_layers(meshes)
        colors = meshes.current_mesh().face_color_matrix()
        self.assertEqual(len(meshes), 1)
        np.testing.assert_array_equal(colors, np.vstack([red, np.ones((count, 4))]))


class Saves(InFolder):
    def contents(self):
        return {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}

    def refused(self, part, output, *words):
        """The folder is as it was before, file by file; also without a file or folder of ours."""
        before = self.contents()
        with self.assertRaises(textlabel.LabelError) as caught:
            textlabel.label(part, "A4", self.folder / output)
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertNotIn(".textlabel-", str(caught.exception))
        self.assertEqual(self.contents(), before)

    @contextlib.contextmanager
    def full_disk(self):
        import resource

        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
        try:
            yield
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)

    def test_a_disk_that_is_full(self):
        for ending in ("stl", "ply", "obj", "off"):
            with self.subTest(ending), self.full_disk():
                self.refused(MESHES / "bracket.stl", f"new.{ending}", f"new.{ending}", "has room")
                (self.folder / f"old.{ending}").write_text("an earlier one")
                self.refused(MESHES / "bracket.stl", f"old.{ending}", "has room")
        textlabel.label(MESHES / "bracket.stl", "A4", self.folder / "old.stl")
        self.assertEqual(surface_faults(read_stl(self.folder / "old.stl")), [])
        self.assertEqual([path for path in self.folder.iterdir() if path.is_dir()], [])

    def test_a_file_beside_the_part(self):
        for ending in ("stl", "ply", "obj"):
            with self.subTest(ending):
                own = self.folder / f"own.{ending}"
                meshes = pymeshlab.MeshSet()
                meshes.load_new_mesh(str(MESHES / "bracket.stl"))
                meshes.save_current_mesh(str(own))
                part = textlabel.Part(own)
                for number in (1, 2):  # the part is still there for the next one
                    beside = self.folder / f"beside-{number}.{ending}"
                    report = part.label(f"A{number}", beside)
                    self.assertGreater(report["triangles_added"], 0)
                    labelled = pymeshlab.MeshSet()
                    labelled.load_new_mesh(str(beside))
                    before = meshes.current_mesh().face_number()
                    self.assertEqual(labelled.current_mesh().face_number(), before + report["triangles_added"])

    def test_letters_that_only_double_precision_carries(self):
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(np.array(box_points(60, 40, 20), float) + 5e6, BOX_TRIANGLES))
        far = self.folder / "far.ply"
        meshes.save_current_mesh(str(far))
        for ending in ("stl", "3mf"):
            self.refused(far, f"new.{ending}", "single precision", ".ply")
        for ending in ("ply", "obj", "off"):
            report = textlabel.label(far, "A4", self.folder / f"new.{ending}", depth=1)
            self.assertFalse(report["survives_float32"])
            back = pymeshlab.MeshSet()
            back.load_new_mesh(str(self.folder / f"new.{ending}"))
            mesh = back.current_mesh()
            inside = volume(Mesh(mesh.vertex_matrix() - 5e6, mesh.face_matrix()))
            self.assertAlmostEqual(inside, 48000 + report["label_area"], delta=0.01)
        self.assertTrue(textlabel.label(MESHES / "bracket.stl", "A4", self.folder / "near.stl")["survives_float32"])

    def test_names_that_meshlab_cannot_take(self):
        latin = os.fsdecode(b"caf\xe9")
        (self.folder / latin).mkdir()
        shutil.copy(MESHES / "bracket.stl", self.folder / latin / "part.stl")
        for part, output in (
            (self.folder / latin / "part.stl", self.folder / "out.stl"),
            (MESHES / "bracket.stl", self.folder / latin / "out.stl"),
            (MESHES / "bracket.stl", self.folder / "o\0ut.stl"),
        ):
            with self.subTest(output), self.assertRaisesRegex(textlabel.LabelError, "UTF-8.* Rename it"):
                textlabel.label(part, "A4", output)
        shutil.copy(MESHES / "bracket.stl", self.folder)
        parts = (self.folder / latin / "part.stl", self.folder / "bracket.stl")
        done = run_module("serial", *parts, "--count", "1", "--output", self.folder / "serials")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "UTF-8.* Rename it")
        self.assertEqual(sorted(os.listdir(self.folder / "serials")), ["bracket-0001.stl", "failed.csv", "manifest.jsonl"])
        done = run_module("serial", parts[1], "--count", "1", "--output", self.folder / latin / "serials")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "UTF-8.* Rename it")
        self.assertEqual(os.listdir(self.folder / latin), ["part.stl"])

    def test_formats_that_hold_less(self):
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(np.array(box_points(60, 40, 20), float) * 1e-5, BOX_TRIANGLES))
        tiny = self.folder / "tiny.ply"
        meshes.save_current_mesh(str(tiny))
        for name in ("tiny.3mf", "tiny.dxf"):  # six decimals
            self.refused(tiny, name, "finer than the coordinates", "more digits", ".stl")
        for name in ("bracket.ctm", "bracket.u3d", "bracket.nxs"):
            self.refused(MESHES / "bracket.stl", name, "compresses or simplifies", ".stl")
        self.refused(MESHES / "bracket.stl", "bracket.xyz", "points only", ".stl")
        textlabel.label(tiny, "A4", self.folder / "tiny.stl")
        textlabel.label(MESHES / "bracket.stl", "A4", self.folder / "bracket.3mf")
        with self.assertRaisesRegex(textlabel.LabelError, "a flat label is a colour"):
            textlabel.label(MESHES / "bracket.stl", "A4", self.folder / "flat.3mf", style="Flat")
        self.assertFalse((self.folder / "flat.3mf").exists())

    def test_files_of_six_digits_are_valid(self):
        """As read back: beside the origin six digits are steps of 0.01, between which letters made for single precision fall."""
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(np.array(box_points(40, 20, 5), float) + 985, BOX_TRIANGLES))
        part = self.folder / "part.ply"
        meshes.save_current_mesh(str(part))
        for ending in ("wrl", "x3d", "dae"):
            with self.assertRaisesRegex(textlabel.LabelError, "finer than .*more digits"):
                place = {"position": (1025, 995, 987.5), "direction": (1, 0, 0)}
                textlabel.label(part, "A@3", self.folder / f"flat.{ending}", size=3, depth=0.004, **place)
            for values in ({"size": 5, "depth": 1}, {"size": 3, "style": "Engrave"}, {"size": 4, "direction": (0.3, 0.2, 1)}):
                with self.subTest(ending=ending, **values):
                    out = self.folder / f"out.{ending}"
                    report = textlabel.label(part, "A@3", out, position=(1005, 995, 990), **values)
                    self.assertEqual(report["coordinate_step"], 0.01)
                    back = pymeshlab.MeshSet()
                    back.load_new_mesh(str(out))
                    mesh = back.current_mesh()
                    points, index = np.unique(mesh.vertex_matrix(), axis=0, return_inverse=True)
                    mesh = Mesh(points, index.reshape(-1)[mesh.face_matrix()])
                    self.assertEqual(surface_faults(mesh), [])
                    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
                    self.assertGreater((np.cross(b - a, c - a) ** 2).sum(axis=1).min(), 0)
                    added = report["volume_after"] - report["volume_before"]
                    self.assertAlmostEqual(volume(Mesh(mesh.points - 985, mesh.triangles)) - 4000, added, delta=0.02 * abs(added))

    def test_numbers_are_those_that_were_written(self):
        report = textlabel.label(MESHES / "bracket.stl", "A4", self.folder / "out.stl", size=9.1, depth=0.3)
        self.assertEqual((report["size"], report["depth"]), (9.1, 0.3))

    def test_a_box_of_quads(self):
        """Only the one under the letters becomes triangles; in formats without quads, all of them do."""
        part = self.write_quads("quads.obj", box_points(40, 30, 10))
        for style, sign in (("Emboss", 1), ("Engrave", -1), ("Flat", 0)):
            for ending in ("obj", "off", "ply", "stl"):
                out = self.folder / f"{style}.{ending}"
                report = textlabel.label(part, "A4", out, style=style, position=(20, 15, 10), **PLACE)
                self.assertAlmostEqual(self.volume_of(out), 12000 + sign * report["label_area"], delta=0.01)
            corners = self.corners_of(self.folder / f"{style}.obj")
            self.assertEqual(corners, {4: 5, 3: 2 + report["triangles_added"]})

    def test_quads_that_would_lose_something(self):
        """MeshLab writes polygons without textures, and in single precision with seven decimals."""
        part = write_textured_box(self.folder / "part")
        lines = [line for line in part.read_text().splitlines() if not line.startswith("f ")]
        lines += ["f " + " ".join(f"{corner + 1}/{corner + 1}" for corner in quad) for quad in QUADS]
        part.write_text("\n".join(lines) + "\n")
        textlabel.label(part, "A4", self.folder / "textured.obj")
        self.assertIn("map_Kd skin.png", (self.folder / "textured.obj.mtl").read_text())
        tiny = self.write_quads("tiny.obj", np.array(box_points(40, 30, 10)) * 1e-5)
        far = self.write_quads("far.obj", np.array(box_points(40, 30, 10)) + 4e6)
        for part, scale, origin in ((tiny, 1e-5, 0), (far, 1, 4e6)):
            out = self.folder / f"labelled-{part.name}"
            report = textlabel.label(part, "A4", out, depth=0.1 * scale)
            added = report["label_area"] * 0.1 * scale
            self.assertAlmostEqual(self.volume_of(out, origin), 12000 * scale**3 + added, delta=0.02 * added)

    def write_quads(self, name, points):
        lines = ["v {:.12g} {:.12g} {:.12g}".format(*point) for point in points]
        lines += ["f " + " ".join(str(corner + 1) for corner in quad) for quad in QUADS]
        (self.folder / name).write_text("\n".join(lines) + "\n")
        return self.folder / name

    def volume_of(self, path, origin=0):
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(path))
        mesh = meshes.current_mesh()
        return volume(Mesh(mesh.vertex_matrix() - origin, mesh.face_matrix()))

    def corners_of(self, path):
        """How many faces of an OBJ file have so many corners."""
        return collections.Counter(len(line.split()) - 1 for line in path.read_text().splitlines() if line.startswith("f "))

    def test_a_pipe_is_not_replaced(self):
        os.mkfifo(self.folder / "fifo")
        os.mkfifo(self.folder / "pipe.stl")
        with self.assertRaisesRegex(textlabel.LabelError, "a pipe"):
            textlabel.label(MESHES / "bracket.stl", "A4", self.folder / "pipe.stl")
        self.assertTrue((self.folder / "pipe.stl").is_fifo())
        for name in ("report", "outline"):
            with self.assertRaisesRegex(textlabel.LabelError, "written"):
                textlabel.label(MESHES / "bracket.stl", "A4", self.folder / "out.stl", **{name: self.folder / "fifo"})
        self.assertTrue((self.folder / "fifo").is_fifo())
        self.assertFalse((self.folder / "out.stl").exists())

    def test_a_link_stays(self):
        (self.folder / "far").mkdir()
        (self.folder / "out.stl").symlink_to(self.folder / "far" / "real.stl")
        textlabel.label(MESHES / "bracket.stl", "A4", self.folder / "out.stl")
        self.assertTrue((self.folder / "out.stl").is_symlink())
        self.assertEqual(surface_faults(read_stl(self.folder / "far" / "real.stl")), [])

    def test_textures_come_along(self):
        part = write_textured_box(self.folder / "part", "pictures/skin.png")
        (self.folder / "out").mkdir()
        for name in ("a.obj", "b.obj"):  # the second one shares the texture
            textlabel.label(part, "A4", self.folder / "out" / name)
        names = sorted(str(path.relative_to(self.folder / "out")) for path in (self.folder / "out").rglob("*.*"))
        self.assertEqual(names, ["a.obj", "a.obj.mtl", "b.obj", "b.obj.mtl", "pictures/skin.png"])
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(self.folder / "out" / "a.obj"))
        self.assertEqual(list(meshes.current_mesh().textures()), ["pictures/skin.png"])

    def test_a_texture_of_another_part_is_kept(self):
        light, dark = (write_textured_box(self.folder / name, shade=shade) for name, shade in (("l", 220), ("d", 40)))
        textlabel.label(light, "A4", self.folder / "light.obj")
        self.refused(dark, "dark.obj", "skin.png", "would replace another one", "Choose another folder")
        self.refused(dark, "light.obj", "skin.png", "would replace another one", "Choose another folder")
        textlabel.label(dark, "A4", self.folder / "dark.stl")  # has no textures

    def test_a_texture_of_the_part_itself_is_left_alone(self):
        part = write_textured_box(self.folder / "part")
        texture = (part.parent / "skin.png").read_bytes()
        textlabel.label(part, "A4", part.parent / "labelled.obj")
        self.assertEqual((part.parent / "skin.png").read_bytes(), texture)
        names = sorted(path.name for path in part.parent.iterdir())
        self.assertEqual(names, ["box.mtl", "box.obj", "labelled.obj", "labelled.obj.mtl", "skin.png"])

    def test_a_texture_outside_the_folder(self):
        part = write_textured_box(self.folder / "part", "../skin.png")
        self.refused(part, "part/out.obj", "'../skin.png'", "Put it beside the mesh")
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(part))
        self.refused(meshes, "part/out.obj", "'../skin.png'", "Put it beside the mesh")
        self.assertEqual(meshes.current_mesh().face_number(), 12)
        textlabel.label(part, "A4", self.folder / "out.stl")

    def test_a_texture_that_cannot_be_read(self):
        missing = write_textured_box(self.folder / "missing")
        (missing.parent / "skin.png").unlink()
        blank = write_textured_box(self.folder / "blank", "my skin.png")
        jpeg = write_textured_box(self.folder / "jpeg", "skin.jpg")
        (jpeg.parent / "skin.jpg").write_bytes(bytes.fromhex("ffd8ffe000104a46494600010100000100010000ffd9"))
        for part in (missing, blank, jpeg):
            with self.subTest(part.parent.name):
                for ending in ("obj", "ply"):
                    self.refused(part, f"out.{ending}", str(part), "cannot be read", "beside the mesh as PNG")
                textlabel.label(part, "A4", self.folder / f"{part.parent.name}.stl")  # has no textures
        done = run_module("serial", missing, "--count", "1", "--output", "out", "--quiet", cwd=self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("beside the mesh as PNG", done.stderr)

    def test_a_texture_that_is_called_as_meshlab_s_own(self):
        part = write_textured_box(self.folder / "part", "dummy.png")
        (self.folder / "out").mkdir()
        textlabel.label(part, "A4", self.folder / "out" / "box.obj")
        self.assertTrue((self.folder / "out" / "dummy.png").is_file())


if __name__ == "__main__":
    textlabel.load_plugin()
    unittest.main(verbosity=2)
