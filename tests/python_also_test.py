"""Several labels on a part: all of them or none, each where and how it is asked for, in series too."""

import json
import unittest

from python_support import MESHES, InFolder, euler, pymeshlab, read_stl, run_module, surface_faults, volume

import textlabel
from textlabel import tasks
from textlabel.template import Template

BRACKET = MESHES / "bracket.stl"
TOP = {"position": (0, -20, 8), "size": 7, "depth": 1}
BELOW = {"position": (0, -2, 2.5), "direction": (0, 0, -1), "size": 14, "depth": 0.5, "style": "Engrave"}
ON_TOP = ["--at", "0,-20,8", "--size", "7", "--depth", "1"]
FROM_BELOW = ["--at", "0,-2,2.5", "--direction", "0,0,-1", "--size", "14", "--depth", "0.5", "--style", "engrave"]


class Also(InFolder):
    def label(self, *also, output="out.stl", **changes):
        return textlabel.label(BRACKET, "A43", self.folder / output, also, **{**TOP, **changes})

    def refused(self, *words, also, **changes):
        with self.assertRaises(textlabel.LabelError) as caught:
            self.label(*also, **changes)
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_each_is_there(self):
        report = self.label({"text": "7", **BELOW}, {"text": "B", **BELOW, "position": (20, -2, 2.5)})
        self.assertEqual([more["anchor"][0] for more in report["also"]], [0, 20])
        part, mesh = read_stl(BRACKET), read_stl(self.folder / "out.stl")
        self.assertEqual(surface_faults(mesh), [])
        self.assertEqual(euler(mesh), euler(part))
        areas = [more["label_area"] for more in report["also"]]  # all on planes
        self.assertGreater(min(areas), 1)
        self.assertAlmostEqual(volume(mesh) - volume(part), report["label_area"] - sum(areas) / 2, delta=0.01)
        self.assertAlmostEqual(report["also"][0]["volume_before"], report["volume_after"], places=6)

    def test_the_same_as_one_after_the_other(self):
        self.label({"text": "7", **BELOW}, output="both.stl")
        self.label(output="first.stl")
        textlabel.label(self.folder / "first.stl", "7", self.folder / "second.stl", **BELOW)
        both, second = read_stl(self.folder / "both.stl"), read_stl(self.folder / "second.stl")
        self.assertEqual(len(both.triangles), len(second.triangles))
        self.assertEqual(both.points.tolist(), second.points.tolist())

    def test_one_of_a_loaded_part_leaves_none_on_the_next(self):
        part = textlabel.Part(BRACKET)
        part.label("A43", self.folder / "a.stl", [{"text": "7", **BELOW}], **TOP)
        report = part.label("A43", self.folder / "b.stl", **TOP)
        self.assertNotIn("also", report)
        self.label(output="alone.stl")
        self.assertEqual((self.folder / "b.stl").read_bytes(), (self.folder / "alone.stl").read_bytes())

    def test_all_or_none(self):
        first = {"picture": self.folder / "picture.png", "report": self.folder / "report.json"}
        for words, further in [
            ("Move the position", {"position": (500, 0, 0)}),
            ("'/no/such/r.json' .report. cannot be written", {"report": "/no/such/r.json"}),
            ("the name of a .png file", {"picture": self.folder / "x.gif"}),
            ("cannot be written", {"outline": self.folder / "a.svg" / "b.svg"}),
            ("report takes a text", {"report": 5}),
            ("The report would be written over .*report.json", {"report": self.folder / "report.json"}),
            ("The outline would be written over .*out.stl", {"outline": self.folder / "out.stl"}),
            ("The report would be written over .*bracket.stl", {"report": BRACKET}),
        ]:
            with self.subTest(words):
                with self.assertRaisesRegex(textlabel.LabelError, f"^Label 2 \\('7'\\): .*({words})"):
                    self.label({"text": "7", **BELOW, **further}, **first)
                self.assertEqual(list(self.folder.iterdir()), [])
        self.refused("Label 1 ('A43'): ", "Move the position", also=[{"text": "7", **BELOW}], position=(500, 0, 0), **first)
        self.refused("would be written over", also=[], report=BRACKET)
        self.refused("compresses or simplifies", also=[{"text": "7", **BELOW}], output="x.ctm", **first)
        self.label({"text": "7", **BELOW, "outline": self.folder / "outline.svg"}, **first)
        self.assertEqual(len(list(self.folder.iterdir())), 4)
        self.assertEqual(json.loads((self.folder / "report.json").read_text())["text"], "A43")

    def test_links_stay_links(self):
        (self.folder / "link.json").symlink_to(self.folder / "named.json")
        self.label({"text": "7", **BELOW, "report": self.folder / "link.json"})
        self.assertTrue((self.folder / "link.json").is_symlink())
        self.assertEqual(json.loads((self.folder / "named.json").read_text())["text"], "7")

    def test_the_file_holds_what_each_needs(self):
        with self.assertRaisesRegex(textlabel.LabelError, "Label 2 .*a flat label is a colour"):
            self.label({"text": "7", **BELOW, "style": "Flat"}, output="x.dae")
        self.label({"text": "7", **BELOW, "style": "Flat", "color": (0, 0, 255)}, output="x.ply")
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(self.folder / "x.ply"))
        colors = {tuple(color) for color in (meshes.current_mesh().face_color_matrix()[:, :3] * 255).round().astype(int)}
        self.assertIn((0, 0, 255), colors)

    def test_mistakes(self):
        for also in ("7", {"text": "7"}, [{"size": 3}], ["7"], [{"text": "7", 5: 3}], None):
            with self.subTest(also), self.assertRaisesRegex(textlabel.LabelError, "list of dictionaries with a text"):
                textlabel.label(BRACKET, "A43", self.folder / "out.stl", also, **TOP)
        self.refused("Label 2 ('7'): ", "Did you mean size", also=[{"text": "7", "sise": 3}])
        self.refused("text takes a text", also=[{"text": 7}])
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(BRACKET))
        with self.assertRaisesRegex(textlabel.LabelError, "one label at a time"):
            textlabel.label(meshes, "A43", also=[{"text": "7"}])
        with self.assertRaisesRegex(textlabel.LabelError, "list of dictionaries"):
            textlabel.label(meshes, "A43", also=None)
        self.assertEqual(meshes.current_mesh().face_number(), len(read_stl(BRACKET).triangles))


class Commands(InFolder):
    def run_it(self, *arguments, status=0):
        done = run_module(*arguments, cwd=self.folder)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done.stdout if status == 0 and arguments[0] == "label" else done.stderr

    def entries(self):
        return [json.loads(line) for line in (self.folder / "out" / "manifest.jsonl").read_text().splitlines()]

    def test_label(self):
        said = self.run_it("label", BRACKET, "out.stl", "A43", *ON_TOP, "--also", "-7", *FROM_BELOW, "--also=B", "--size", "5")
        report = json.loads(said)
        self.assertEqual([more["anchor"] for more in report["also"]][0], [0, -2, 2.5])
        self.assertEqual([report["size"], *(more["size"] for more in report["also"])], [7, 14, 5])
        textlabel.label(
            BRACKET, "A43", self.folder / "same.stl", [{"text": "-7", **BELOW}, {"text": "B", "size": 5}], **TOP
        )
        self.assertEqual((self.folder / "out.stl").read_bytes(), (self.folder / "same.stl").read_bytes())

    def test_label_refused(self):
        for arguments, word in [
            (["--also"], "--also needs the text"),
            (["--also", "7", "--sise", "4"], "--sise"),
            (["--also", "7", "--siz", "4"], "--siz"),  # would count for the label before
            (["--als", "7"], "--als"),
            (["--also", "--size", "5"], "--also needs the text"),
            (["--also", "--size=5"], "--also=--text"),
            (["--also="], "--also needs the text"),
            (["--also", "7", "--size", "big"], "Label 2 ('7'): The parameter size takes a number"),
            (["--also", "7", "--set", "text=B"], "--set text=B"),
            (["--also", "7", "--direction", "0,0,1"], "Label 2 ('7'): A direction alone"),
        ]:
            with self.subTest(arguments):
                self.assertIn(word, self.run_it("label", BRACKET, "out.stl", "A43", *ON_TOP, *arguments, status=2))
        self.assertIn("('{n}')", self.run_it("label", BRACKET, "out.stl", "A", "--also", "{n}", "--at", "500,0,0", status=1))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_series(self):
        (self.folder / "t.csv").write_text("text,order,high,size\nA1,7,6,7\nA2,8,5,6\nA3,9,140,6\n")
        arguments = ["serial", BRACKET, "--csv", "t.csv", *ON_TOP, "--set", "report=r-{order}.json"]
        # options of the command may stand behind a label
        arguments += ["--also", "{text}/{order:03}", *FROM_BELOW, "--size", "{high}", "--quiet", "--output", "out"]
        said = self.run_it(*arguments, status=1)
        self.assertIn("2 made", said)
        self.assertIn("row 3 (bracket.stl, 'A3'): Label 2 ('A3/009'): ", said)
        self.assertNotIn("nothing uses", said)
        entries = self.entries()
        self.assertEqual([entry["also"][0]["text"] for entry in entries], ["A1/007", "A2/008"])
        self.assertEqual([entry["report"]["size"] for entry in entries], [7, 6])
        self.assertEqual([entry["report"]["also"][0]["size"] for entry in entries], [6, 5])
        self.assertEqual(sorted(path.name for path in self.folder.glob("r-*")), ["r-7.json", "r-8.json"])
        for entry in entries:
            self.assertEqual(surface_faults(read_stl(self.folder / "out" / entry["file"])), [])
        self.assertIn("0 made at 0.0/s, 2 were there, 1 failed", self.run_it(*arguments, status=1))
        changed = [str(argument).replace("{text}/", "{text}-") for argument in arguments]
        self.assertIn("was made from another part, font, drawing, text or settings", self.run_it(*changed, status=2))

    def test_series_refused(self):
        start = ["serial", BRACKET, "--count", "2", "--output", "out"]
        for arguments, word in [
            (["--also", "{serial}"], "wants {serial}"),
            (["--also", "{"], "cannot be read"),
            (["--also", "7", "--at", "{x},0,0"], "wants {x}"),
            (["--size", "{x}"], "wants {x}"),
            (["--set", "sise={n}"], "Did you mean size"),
            (["--also", "7", "--direction", "0,0,1"], "direction alone"),
            (["--set", "report=r.json", "--also", "7"], "'{part}-{n}'"),
            (["--also", " "], "--also needs the text"),
            (["--text", "a}b"], "{{ and }} for braces"),
        ]:
            with self.subTest(arguments):
                self.assertIn(word, self.run_it(*start, *arguments, status=2))
        parts = ["serial", BRACKET, MESHES / "seat.stl", *start[2:]]
        said = self.run_it(*parts, "--set", "report=./{n}.json", "--also", "7", status=2)
        self.assertIn("bracket.stl' and '", said)
        self.assertEqual(list(self.folder.iterdir()), [])
        said = self.run_it(*start, "--also", "7", "--size", "{text}", status=1)
        self.assertEqual(said.count("Label 2 ('7'): The parameter size takes a number, not 'bracket-000"), 2)
        said = self.run_it(*start, *ON_TOP, "--set", "report={n}.json", "--also", "7", "--set", "report=./{n}.json", status=1)
        self.assertEqual(said.count("Label 2 ('7'): The report would be written over"), 2)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["out"])

    def test_empty_cells(self):
        (self.folder / "t.csv").write_text("text,note,high,r\nA1,,,\nA2,7,6,\nA3,7,,x\n")
        arguments = ["serial", BRACKET, "--csv", "t.csv", *ON_TOP, "--output", "out", "--set", "report={r}"]
        said = self.run_it(*arguments, "--also", "{note}", *FROM_BELOW, "--size", "{high}", status=1)
        self.assertIn("row 1 (bracket.stl, 'A1'): Label 2 (''): The text is empty in this row. Fill in what it is made of: '{note}'.", said)
        self.assertIn("2 made", said)  # the size is left to the filter
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["out", "t.csv", "x"])


class Fields(unittest.TestCase):
    def plan(self, **settings):
        serial = tasks.Label(Template("{text}"), {name: Template(value) for name, value in settings.items()})
        further = tasks.Label(Template("{text}"), {"font": Template("{face}")})
        return tasks.Plan(parts=[BRACKET], labels=[serial, further], name=Template("{n}"), ending="")

    def test_a_text_makes_no_folder(self):
        rows = [(1, {"n": 1, "text": "a/b", "face": "x/y.ttf"})]
        (task,), problems = tasks.make_tasks(rows, self.plan(picture="out/{text}.png", font="{text}"), BRACKET.parent)
        self.assertEqual(problems, [])
        settings = [label["settings"] for label in task.labels]
        self.assertEqual(settings, [{"picture": "out/a_b.png", "font": "a/b"}, {"font": "x/y.ttf"}])

    def test_columns_that_a_label_uses(self):
        rows = [(1, {"n": 1, "text": "A", "face": "x", "place": "y", "customer": "z"})]
        self.assertEqual(tasks.check_columns(rows, self.plan(position="{place}")), ["customer"])


if __name__ == "__main__":
    textlabel.load_plugin()
    unittest.main()
