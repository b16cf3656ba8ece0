"""Tables and templates of serial numbers: what they become, and what is refused before anything is made."""

import csv
import json
import os
import shutil
import subprocess
import sys
import unittest

from python_support import MESHES, SOURCE, InFolder, environment, np, pymeshlab, run_module, write_textured_box

import textlabel
from textlabel import tasks
from textlabel.template import Template, TemplateError, file_part

BRACKET = MESHES / "bracket.stl"
PLACE = ["--at", "0,-20,8", "--size", "7", "--depth", "1"]


class Templates(unittest.TestCase):
    def test_fields(self):
        values = {"part": "bracket", "n": 7, "order": "0042", "text": "Ä"}
        for template, filled in {
            "{part}-{n:04}": "bracket-0007",
            "{n}": "7",
            "{order}": "0042",
            "{order:06}": "000042",  # a number, though a table has texts
            "{order:>6}|{text:<3}|": "  0042|Ä  |",
            "{{{n}}}": "{7}",
            "plain": "plain",
        }.items():
            self.assertEqual(Template(template).fill(values), filled)

    def test_refused(self):
        for template in ("{", "}", "{part", "{part.__class__}", "{n[0]}", "{}", "{n!x}"):
            with self.subTest(template), self.assertRaises(TemplateError):
                Template(template).fill({"part": "bracket", "n": 1})
        with self.assertRaises(TemplateError) as caught:
            Template("{serial}").check({"text", "n"})
        self.assertIn("{serial}", str(caught.exception))
        self.assertIn("n, text", str(caught.exception))
        for template, value in {"{n:q}": 1, "{n:05}": "12b"}.items():
            with self.subTest(template), self.assertRaises(TemplateError):
                Template(template).fill({"n": value})

    def test_file_names(self):
        for text, name in {
            "A/43": "A_43",
            "a b\nc": "a_b_c",
            "..": "_",
            'x:"y"?': "x_y_",
            "Ä漢": "Ä漢",
            "": "_",
        }.items():
            self.assertEqual(file_part(text), name)


class Tables(InFolder):
    def read(self, text, encoding="utf-8"):
        path = self.folder / "table.csv"
        path.write_bytes(text.encode(encoding))
        return tasks.read_table(path, 1)

    def plan(self, **changes):
        settings = {name: Template(text) for name, text in changes.pop("settings", {}).items()}
        plan = {"parts": [BRACKET], "name": Template("{part}-{text}"), "ending": ""}
        return tasks.Plan(labels=[tasks.Label(Template("{text}"), settings)], **{**plan, **changes})

    def test_dialects(self):
        expected = [(1, {"n": 1, "text": "A1", "size": "5"}), (2, {"n": 2, "text": "Ä,2", "size": "6.5"})]
        self.assertEqual(self.read('text,size\nA1,5\n"Ä,2",6.5\n'), expected)
        self.assertEqual(self.read("text;size\r\nA1;5\r\nÄ,2;6.5\r\n\r\n"), expected)
        self.assertEqual(self.read("\ufefftext\tsize\nA1\t5\nÄ,2\t6.5"), expected)

    def test_lines_inside_a_cell(self):
        self.assertEqual(self.read('text\n"A\nB"\n'), [(1, {"n": 1, "text": "A\nB"})])

    def test_blank_rows_keep_the_numbers_of_the_others(self):
        self.assertEqual([row for row, _ in self.read("text,size\nA,1\n,\nB,2\n")], [1, 3])

    def test_no_table(self):
        for text, encoding in [
            ("", "utf-8"),
            ("text,size\n", "utf-8"),
            ("text,size\n,\n\n", "utf-8"),
            ("text,text\nA,B\n", "utf-8"),
            ("text\nÄ\n", "latin-1"),
            ('text\n"A\n', "utf-8"),
        ]:
            with self.subTest(text), self.assertRaises(tasks.UsageError):
                self.read(text, encoding)
        with self.assertRaises(tasks.UsageError):
            tasks.read_table(self.folder / "missing.csv", 1)

    def test_rows_times_parts(self):
        housing = MESHES / "housing.stl"
        rows = self.read("text,part\nA1,\nA2,housing\nA3,bracket.stl\n")
        made, problems = tasks.make_tasks(rows, self.plan(parts=[BRACKET, housing]), self.folder)
        self.assertEqual(problems, [])
        self.assertEqual(
            [(task.row, task.file) for task in made],
            [(1, "bracket-A1.stl"), (1, "housing-A1.stl"), (2, "housing-A2.stl"), (3, "bracket-A3.stl")],
        )

    def test_part_beside_the_table(self):
        shutil.copy(BRACKET, self.folder / "mine.stl")
        made, _ = tasks.make_tasks(self.read("text,part\nA1,mine.stl\n"), self.plan(parts=[]), self.folder)
        self.assertEqual(made[0].part, self.folder / "mine.stl")

    def test_settings_of_a_row_over_those_of_the_job(self):
        rows = self.read("text,size,depth\nA1,5,\nA2,,2\n")
        made, _ = tasks.make_tasks(rows, self.plan(settings={"size": "7", "style": "engrave"}), self.folder)
        self.assertEqual(made[0].labels, [{"text": "A1", "settings": {"size": "5", "style": "engrave"}}])
        self.assertEqual(made[1].labels[0]["settings"], {"size": "7", "style": "engrave", "depth": "2"})

    def test_bad_rows_do_not_stop_the_others(self):
        rows = self.read(
            "text,size,part,order,direction\nA1,x,,1,\n,5,,2,\nA3,5,none.stl,3,\nA4\nA5,5,,4,\nA6,5,,4b,\nA7,,,7,,8\n"
            'A8,,,8,"0,0,1"\n'
        )
        made, problems = tasks.make_tasks(rows, self.plan(name=Template("{order:03}")), self.folder)
        self.assertEqual([(task.row, task.file) for task in made], [(5, "004.stl")])
        words = {1: "size", 2: "empty", 3: "none.stl", 4: "1 cells", 6: "4b", 7: "6 cells", 8: "direction alone"}
        self.assertEqual([problem.row for problem in problems], list(words))
        for problem in problems:
            self.assertIn(words[problem.row], problem.reason)

    def test_texts_that_are_too_long_for_a_file_name(self):
        long = {2: "A" * 300, 3: "\u6f22" * 80, 4: "A" * 229}  # bytes: 300, 240 and 229, and bracket-.stl
        rows = self.read("text\nA1\n" + "".join(f"{text}\n" for text in long.values()) + "A" * 228 + "\n")
        made, problems = tasks.make_tasks(rows, self.plan(), self.folder)
        self.assertEqual([task.row for task in made], [1, 5])
        self.assertEqual([problem.row for problem in problems], list(long))
        for problem in problems:
            self.assertIn("--name '{part}-{n}'", problem.reason)
        remedy, problems = tasks.make_tasks(rows, self.plan(name=Template("{part}-{n}")), self.folder)
        self.assertEqual((len(remedy), problems), (5, []))

    def test_serials_that_stand_twice(self):
        for text in ("A1\nA2\nA1\n", "A1\nA1 \n", "e\u0301\n\u00e9\n"):  # the same to the eye
            with self.subTest(text), self.assertRaises(tasks.UsageError) as caught:
                tasks.make_tasks(self.read("text\n" + text), self.plan(name=Template("{n}")), self.folder)
            self.assertIn("twice", str(caught.exception))
        rows = self.read("text\nA1\nA2\n")  # on two parts each may have its A1
        self.assertEqual(
            len(tasks.make_tasks(rows, self.plan(parts=[BRACKET, MESHES / "seat.stl"]), self.folder)[0]), 4
        )

    def test_files_that_would_be_written_twice(self):
        for name, text in {"{part}": "A1\nA2\n", "{text}": "A/1\nA:1\n", "x-{text}": "a1\nA1\n"}.items():
            with self.subTest(name), self.assertRaises(tasks.UsageError) as caught:
                tasks.make_tasks(self.read("text\n" + text), self.plan(name=Template(name)), self.folder)
            self.assertIn("same file", str(caught.exception))
            self.assertIn("{n:04}", str(caught.exception))
        parts = [self.folder / name / "bracket.stl" for name in "ab"]  # no field of a name tells them apart
        for part in parts:
            part.parent.mkdir()
            shutil.copy(BRACKET, part)
        with self.assertRaises(tasks.UsageError) as caught:
            tasks.make_tasks(self.read("text\nA1\n"), self.plan(parts=parts), self.folder)
        self.assertIn("different names", str(caught.exception))
        rows = self.read("text,picture\nA1,a.png\nA2,b.png\n")
        self.assertEqual(len(tasks.make_tasks(rows, self.plan(), self.folder)[0]), 2)
        with self.assertRaises(tasks.UsageError) as caught:
            tasks.make_tasks(rows, self.plan(settings={"report": "r.json"}), self.folder)
        self.assertIn("same report, 'r.json'", str(caught.exception))

    def test_names_that_leave_the_folder(self):
        for name in ("../{text}", "/tmp/{text}", "a//{text}", ".{text}", "a/../{text}"):
            with self.subTest(name), self.assertRaises(tasks.UsageError):
                tasks.make_tasks(self.read("text\nA1\n"), self.plan(name=Template(name)), self.folder)
        made, _ = tasks.make_tasks(self.read("text\n../A1\n"), self.plan(name=Template("{part}/{text}")), self.folder)
        self.assertEqual(made[0].file, "bracket/_A1.stl")

    def test_columns(self):
        rows = self.read("text,order,customer\nA1,1,x\n")
        self.assertEqual(tasks.check_columns(rows, self.plan(name=Template("{order}"))), ["customer"])
        with self.assertRaises(tasks.UsageError) as caught:
            tasks.check_columns(self.read("text,sise\nA1,1\n"), self.plan())
        self.assertIn("size", str(caught.exception))
        for rows, plan in [
            (self.read("serial\nA1\n"), self.plan()),
            (self.read("text\nA1\n"), self.plan(parts=[])),
        ]:
            with self.assertRaises(tasks.UsageError):
                tasks.make_tasks(rows, plan, self.folder)


class CommandLine(InFolder):
    def run_serial(self, *arguments, status=0):
        done = run_module("serial", *arguments, "--output", self.folder / "out", "--quiet", cwd=self.folder)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done.stderr

    def made(self):
        return sorted(str(path.relative_to(self.folder / "out")) for path in (self.folder / "out").rglob("*.*"))

    def test_numbers_on_two_parts(self):
        self.run_serial(BRACKET, MESHES / "valve.stl", "--count", "2", "--first", "9")
        names = ["bracket-0009.stl", "bracket-0010.stl", "valve-0009.stl", "valve-0010.stl"]
        self.assertEqual(self.made(), sorted([*names, "manifest.jsonl"]))
        lines = (self.folder / "out" / "manifest.jsonl").read_text().splitlines()
        self.assertEqual({json.loads(line)["text"] for line in lines}, {name.removesuffix(".stl") for name in names})

    def test_without_stderr(self):
        command = [sys.executable, "-m", "textlabel", "serial", str(BRACKET), "--count", "2", "--output", str(self.folder / "out")]
        closed = ["sh", "-c", 'exec "$@" 2>&-', "sh"]
        done = subprocess.run([*closed, *command], env=environment(), stdout=subprocess.PIPE, check=False)
        self.assertEqual((done.returncode, done.stdout), (0, b""))
        self.assertEqual(self.made(), ["bracket-0001.stl", "bracket-0002.stl", "manifest.jsonl"])

    def test_lines_that_are_none_of_a_manifest(self):
        self.run_serial(BRACKET, "--count", "1")
        manifest = self.folder / "out" / "manifest.jsonl"
        good = manifest.read_text()
        for line in ("[]", '{"file": "z.stl"}', '{"file": 5, "part": "p", "text": "t", "sha256": ""}', '{"file": "z.stl", "part": "p", "text": 7, "sha256": ""}'):
            manifest.write_text(f"{good}{line}\n")
            said = self.run_serial(BRACKET, "--count", "2", status=2)
            self.assertIn("line 2 of", said)
            self.assertIn("cannot be resumed", said)

    def test_bad_rows_are_reported_at_the_end(self):
        (self.folder / "t.csv").write_text("text,size\nA1,7\nA2,500\nA3,x\nA4,7\n")
        said = self.run_serial(BRACKET, "--csv", "t.csv", *PLACE, "--name", "{part}/{text}", status=1)
        self.assertIn("row 2 (bracket.stl, 'A2')", said)
        self.assertIn("row 3 (bracket.stl, 'A3')", said)
        self.assertIn("2 made", said)
        self.assertEqual(self.made(), ["bracket/A1.stl", "bracket/A4.stl", "failed.csv", "manifest.jsonl"])
        with open(self.folder / "out" / "failed.csv", encoding="utf-8", newline="") as file:
            self.assertEqual([row["row"] for row in csv.DictReader(file)], ["2", "3"])

    def test_a_text_too_long_for_a_file_name_does_not_stop_the_others(self):
        (self.folder / "t.csv").write_text("text\nA1\n" + "A" * 300 + "\nA3\n")
        said = self.run_serial(BRACKET, "--csv", "t.csv", *PLACE, status=1)
        self.assertIn("file name that is too long", said)
        self.assertIn("2 made", said)
        self.assertEqual(self.made(), ["bracket-A1.stl", "bracket-A3.stl", "failed.csv", "manifest.jsonl"])

    def test_what_is_refused_before_anything_starts(self):
        (self.folder / "twice.csv").write_text("text\nA1\nA2\nA1\n")
        (self.folder / "empty.csv").write_text("text\n")
        for arguments, word in [
            ([BRACKET, "--csv", "twice.csv"], "twice"),
            ([BRACKET, "--csv", "missing.csv"], "missing.csv"),
            (["missing.stl", "--count", "2"], "missing.stl"),
            ([BRACKET, "--count", "0"], "--count"),
            ([BRACKET, "--count", "100000000"], "at most 100000"),
            ([BRACKET, "--count", "2", "--jobs", "0"], "--jobs"),
            ([BRACKET, "--count", "2", "--text", "{part"], "{part"),
            ([BRACKET, "--count", "2", "--text", "{serial}"], "{serial}"),
            ([BRACKET, "--count", "2", "--set", "sise=4"], "size"),
            ([BRACKET, "--count", "2", "--size", "big"], "size"),
            ([BRACKET, "--count", "2", "--set", "size"], "NAME=VALUE"),
            ([BRACKET, "--count", "2", "--set", "text=B"], "--set text=B"),
            ([BRACKET, "--count", "2", "--direction", "0,0,1"], "direction alone"),
            ([BRACKET, "--csv", "empty.csv"], "no rows"),
            ([BRACKET, "--csv", "twice.csv", "--count", "2"], "not allowed"),
            ([BRACKET], "required"),
        ]:
            with self.subTest(word):
                self.assertIn(word, self.run_serial(*arguments, status=2))
        self.assertFalse((self.folder / "out").exists())

    def test_what_a_folder_holds_is_not_replaced(self):
        out = self.folder / "out"
        self.run_serial(BRACKET, "--count", "2", *PLACE)
        before = {path: path.read_bytes() for path in out.iterdir()}
        self.assertIn("other", self.run_serial(BRACKET, "--count", "2", *PLACE[:-1], "1.5", status=2))
        self.assertIn("already", self.run_serial(BRACKET, "--count", "2", *PLACE, "--name", "x-{text}", status=2))
        (out / "bracket-0003.stl").write_text("mine")
        self.assertIn("bracket-0003.stl", self.run_serial(BRACKET, "--count", "3", *PLACE, status=2))
        self.assertEqual((out / "bracket-0003.stl").read_text(), "mine")
        for path, content in before.items():
            self.assertEqual(path.read_bytes(), content)
        self.run_serial(BRACKET, "--count", "3", *PLACE[:-1], "1.5", "--overwrite")
        lines = (out / "manifest.jsonl").read_text().splitlines()
        self.assertEqual([json.loads(line)["report"]["depth"] for line in lines], [1.5] * 3)

    def test_a_font_file_that_has_changed(self):
        fonts = SOURCE / "filter_textlabel" / "fonts"
        font = self.folder / "font.ttf"
        shutil.copy(fonts / "DejaVuSans-Bold.ttf", font)
        arguments = [BRACKET, "--count", "2", *PLACE, "--font", "font.ttf#0"]
        self.run_serial(*arguments)
        self.assertIn("2 were there", self.run_serial(*arguments))
        font.write_bytes(font.read_bytes() + b"\0")  # a byte that no table holds
        self.assertIn("another part, font", self.run_serial(*arguments, status=2))
        self.assertIn("2 made", self.run_serial(*arguments, "--overwrite"))
        manifest = self.folder / "out" / "manifest.jsonl"  # as it was before fonts were in it
        lines = [json.loads(line) for line in manifest.read_text().splitlines()]
        manifest.write_text("".join(json.dumps({k: v for k, v in line.items() if k != "font_sha256"}) + "\n" for line in lines))
        self.assertIn("2 were there", self.run_serial(*arguments))

    def test_one_run_at_a_time(self):
        import fcntl

        (self.folder / "out").mkdir()
        descriptor = os.open(self.folder / "out", os.O_RDONLY)
        self.addCleanup(os.close, descriptor)
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        self.assertIn("Another run", self.run_serial(BRACKET, "--count", "1", *PLACE, status=2))

    def test_color_and_materials_beside_an_obj(self):
        self.run_serial(BRACKET, "--count", "2", *PLACE, "--format", "obj", "--color", "0057b8")
        self.assertEqual(
            self.made(),
            ["bracket-0001.obj", "bracket-0001.obj.mtl", "bracket-0002.obj", "bracket-0002.obj.mtl", "manifest.jsonl"],
        )
        self.assertIn("mtllib ./bracket-0002.obj.mtl", (self.folder / "out" / "bracket-0002.obj").read_text())

    def check_textured(self, file, shade):
        """The labelled box shows its texture: all pixels have the shade."""
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(self.folder / "out" / file))
        mesh = meshes.current_mesh()
        self.assertGreater(mesh.face_number(), 12)
        self.assertTrue(mesh.has_wedge_tex_coord())
        self.assertEqual(mesh.texture_number(), 1)
        meshes.apply_filter("compute_color_from_texture_per_vertex")
        colors = np.unique((mesh.vertex_color_matrix()[:, 0] * 255).round())
        self.assertEqual(colors.tolist(), [shade])

    def test_textured_part(self):
        for ending in ("obj", "ply"):
            for texture in ("skin.png", "pictures/skin.png"):
                with self.subTest(ending=ending, texture=texture):
                    shutil.rmtree(self.folder / "out", ignore_errors=True)
                    shutil.rmtree(self.folder / "part", ignore_errors=True)
                    box = write_textured_box(self.folder / "part", texture, shade=201)
                    self.run_serial(box, "--count", "12", "--jobs", "2", "--format", ending)
                    files = [f"box-{number:04}.{ending}" for number in range(1, 13)]
                    materials = [f"{file}.mtl" for file in files] if ending == "obj" else []
                    self.assertEqual(self.made(), sorted([*files, *materials, "manifest.jsonl", texture]))
                    shutil.rmtree(self.folder / "part")
                    for file in (files[0], files[-1]):
                        self.check_textured(file, 201)
                    self.assertFalse((self.folder / "out" / ".unfinished").exists())

    def test_formats_without_textures_leave_none(self):
        box = write_textured_box(self.folder / "part")
        for ending in ("stl", "off"):
            self.run_serial(box, "--count", "1", "--format", ending)
            self.assertEqual(self.made(), [f"box-0001.{ending}", "manifest.jsonl"])
            shutil.rmtree(self.folder / "out")

    def test_textures_of_the_same_name(self):
        boxes = [write_textured_box(self.folder / name, shade=shade) for name, shade in (("light", 220), ("dark", 40))]
        boxes = [box.rename(box.with_name(f"{box.parent.name}.obj")) for box in boxes]
        said = self.run_serial(*boxes, "--count", "2", "--jobs", "1", status=1)
        self.assertIn("2 made", said)
        self.assertEqual(said.count("'skin.png' would replace another one"), 2)
        for number in (1, 2):
            self.check_textured(f"dark-000{number}.obj", 40)
        shutil.rmtree(self.folder / "out")
        self.run_serial(*boxes, "--count", "2", "--name", "{part}/{text}")
        self.check_textured("dark/dark-0001.obj", 40)
        self.check_textured("light/light-0001.obj", 220)
        # Their materials are a file's own, and made again with it.
        self.run_serial(*boxes, "--count", "2", "--name", "{part}/{text}", "--color", "0057b8", "--overwrite")
        self.check_textured("light/light-0001.obj", 220)

    def test_texture_outside_the_part_s_folder(self):
        box = write_textured_box(self.folder / "part", "../skin.png")
        said = self.run_serial(box, "--count", "2", status=1)
        self.assertIn("'../skin.png'", said)
        self.assertEqual(self.made(), ["failed.csv", "manifest.jsonl"])

    def test_label(self):
        done = run_module(
            "label", BRACKET, self.folder / "x.stl", "A43", "--at", "-2,-20,8", "--size", "5", "--up", "0,1,0"
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["anchor"], [-2, -20, 8])
        done = run_module("label", BRACKET, self.folder / "y.stl", "A43", "--at", "500,0,0")
        self.assertEqual(done.returncode, 1)
        self.assertIn("Move the position", done.stderr)
        self.assertFalse((self.folder / "y.stl").exists())
        for arguments, word in (
            (["--direction", "0,0,1"], "direction alone"),
            (["--set", "text=B"], "--set text=B"),
            (["--offset", "3"], "write U,V"),
            (["--camera", "missing.xml"], "missing.xml"),
        ):
            done = run_module("label", BRACKET, self.folder / "y.stl", "A43", *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(word, done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_the_options_of_label_sh(self):
        camera = self.folder / "camera.xml"
        camera.write_text(
            '<!DOCTYPE ViewState><project><VCGCamera TranslationVector="2 20 -108 1" LensDistortion="0 0" '
            'ViewportPx="800 600" PixelSizeMm="0.0369161 0.0369161" CenterPx="400 300" FocalMm="19.1807" CameraType="0" '
            'BinaryData="0" RotationMatrix="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 "/></project>'
        )
        written = {name: self.folder / f"x.{ending}" for name, ending in (("report", "json"), ("picture", "png"), ("outline", "svg"))}
        files = [word for name, path in written.items() for word in (f"--{name}", path)]
        for where, expected in ((["--at", "1,-21,8"], [-2, -20, 8]), (["--camera", camera], [-5, -19, 8])):
            done = run_module(
                "label", BRACKET, self.folder / "x.stl", "A", *where, "--offset", "-3,1", "--size", "5", "--tolerance", "0.02", *files
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            for a, b in zip(json.loads(written["report"].read_text())["anchor"], expected):
                self.assertAlmostEqual(a, b, delta=1e-3)
            for path in written.values():
                self.assertGreater(path.stat().st_size, 100)
                path.unlink()


if __name__ == "__main__":
    textlabel.load_plugin()
    unittest.main(verbosity=2)
