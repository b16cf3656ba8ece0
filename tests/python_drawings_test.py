"""Drawings cut instead of texts: as large as they are asked for, beside texts and in series, and never written over."""

import hashlib
import json
import unittest

from python_support import MESHES, InFolder, euler, pymeshlab, read_stl, run_module, surface_faults, volume

import textlabel

BRACKET = MESHES / "bracket.stl"
TOP = {"position": (0, -20, 8), "size": 7, "depth": 1}
BELOW = {"position": (0, -2, 2.5), "direction": (0, 0, -1), "size": 14, "depth": 0.5, "style": "Engrave"}
ON_TOP = ["--at", "0,-20,8", "--size", "7", "--depth", "1"]
FROM_BELOW = ["--at", "0,-2,2.5", "--direction", "0,0,-1", "--size", "14", "--depth", "0.5", "--style", "engrave"]


def frame(hole):
    """A drawing twice as wide as high, with a hole of so many tenths of its width."""
    outside, inside = "M0 0h40v20h-40z", f"M10 5h{4 * hole}v10h-{4 * hole}z"
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 20"><path fill-rule="evenodd" d="{outside} {inside}"/></svg>'


def ink(hole, size):
    """The area of that drawing."""
    return (800 - 40 * hole) / 20**2 * size**2


class WithLogo(InFolder):
    def setUp(self):
        super().setUp()
        self.logo = self.folder / "logo.svg"
        self.logo.write_text(frame(5))

    def written(self):
        return sorted(path.name for path in self.folder.iterdir())


class Drawings(WithLogo):
    def label(self, text, *also, **changes):
        return textlabel.label(BRACKET, text, self.folder / "out.stl", also, **{**TOP, **changes})

    def refused(self, pattern, text, *also, **changes):
        with self.subTest(pattern):
            with self.assertRaisesRegex(textlabel.LabelError, pattern):
                self.label(text, *also, **changes)
            self.assertEqual(self.written(), ["logo.svg"])
            self.assertEqual(self.logo.read_text(), frame(5))

    def check(self, added):
        """The file is a mesh as sound as the part, with so much more volume."""
        part, mesh = read_stl(BRACKET), read_stl(self.folder / "out.stl")
        self.assertEqual(surface_faults(mesh), [])
        self.assertEqual(euler(mesh), euler(part))
        self.assertAlmostEqual(volume(mesh) - volume(part), added, delta=0.01)

    def test_instead_of_a_text(self):
        for text, drawing in (("", str(self.logo)), (None, self.logo)):
            with self.subTest(text=text):
                report = self.label(text, drawing=drawing)
                self.assertAlmostEqual(report["label_area"], ink(5, 7), places=6)
                self.check(ink(5, 7))

    def test_as_wide_as_asked_for(self):
        report = self.label("", drawing=self.logo, fit_width=10)
        self.assertAlmostEqual(report["label_area"], ink(5, 10 / 2), places=6)

    def test_beside_a_text(self):
        report = self.label("A43", {"drawing": self.logo, **BELOW})
        self.assertAlmostEqual(report["also"][0]["label_area"], ink(5, 14), places=6)
        self.check(report["label_area"] - ink(5, 14) / 2)
        report = self.label(None, {"text": "7", **BELOW}, drawing=self.logo)
        self.check(ink(5, 7) - report["also"][0]["label_area"] / 2)

    def test_on_a_mesh_set(self):
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(BRACKET))
        with self.assertRaisesRegex(textlabel.LabelError, "^A drawing is cut instead of a text"):
            textlabel.label(meshes, "A43", drawing=self.logo, **TOP)
        self.assertAlmostEqual(textlabel.label(meshes, None, drawing=self.logo, **TOP)["label_area"], ink(5, 7), places=6)

    def test_an_empty_one_is_none(self):
        self.label("A43", drawing="")
        with_it = (self.folder / "out.stl").read_bytes()
        self.label("A43")
        self.assertEqual((self.folder / "out.stl").read_bytes(), with_it)

    def test_mistakes(self):
        logo, none = str(self.logo), str(self.folder / "none.svg")
        self.refused(f"^A drawing is cut instead of a text, and both '{logo}' and 'A43' are there", "A43", drawing=logo)
        self.refused("^Label 2 .'7'.: A drawing is cut instead of a text", "A43", {"text": "7", "drawing": logo, **BELOW})
        self.refused(f"^Label 2 .'{none}'.: .*{none}", "A43", {"drawing": none, **BELOW})
        self.refused(f"^Label 2 .'{logo}'.: .*Move the position", "A43", {"drawing": logo, **BELOW, "position": (500, 0, 0)})
        self.refused("^Label 1 .'A43'.: .*Move the position", "A43", {"drawing": logo, **BELOW}, position=(500, 0, 0))
        self.refused("^Label 2 .'5'.: The parameter drawing takes a text, not 5", "A43", {"drawing": 5})
        self.refused("NUL", "", drawing="a\0b")
        self.refused("code", "", drawing=logo, code="QR Code")
        self.refused("list of dictionaries with a text or a drawing each", "A43", {"drawing": ""})
        self.refused("list of dictionaries with a text or a drawing each", "A43", {"drawing": logo, 5: 3})
        self.refused("takes a text, not None", None)

    def test_is_not_written_over(self):
        over = "outline would be written over '.*logo.svg'"
        self.refused(f"^The {over}", "", drawing=self.logo, outline=self.logo)
        self.refused(f"^Label 1 .'A43'.: The {over}", "A43", {"drawing": self.logo, **BELOW}, outline=self.logo)
        with self.subTest("a link"):
            link = self.folder / "link.svg"
            link.symlink_to(self.logo)
            with self.assertRaisesRegex(textlabel.LabelError, over):
                self.label("", drawing=link, outline=self.logo)
            self.assertEqual(self.logo.read_text(), frame(5))


class Commands(WithLogo):
    def run_it(self, *arguments, status=0):
        done = run_module(*arguments, cwd=self.folder)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done.stdout if status == 0 and arguments[0] == "label" else done.stderr

    def entries(self):
        return [json.loads(line) for line in (self.folder / "out" / "manifest.jsonl").read_text().splitlines()]

    def test_label(self):
        textlabel.label(BRACKET, "", self.folder / "same.stl", drawing=self.logo, **TOP)
        for number, arguments in enumerate(
            [
                ["label", BRACKET, "{}", "--drawing", "logo.svg", *ON_TOP],
                ["label", "--drawing=logo.svg", BRACKET, *ON_TOP, "{}"],
                ["label", BRACKET, "{}", "", *ON_TOP, "--set", "drawing=logo.svg"],
                ["label", *ON_TOP, "--drawing", "none.svg", "--set", "drawing=logo.svg", "--", BRACKET, "{}"],
            ]
        ):
            with self.subTest(arguments):
                self.run_it(*(word if word != "{}" else f"{number}.stl" for word in arguments))
                self.assertEqual((self.folder / f"{number}.stl").read_bytes(), (self.folder / "same.stl").read_bytes())

    def test_a_text_stands_where_it_did(self):
        textlabel.label(BRACKET, "-7", self.folder / "same.stl", **TOP)
        for number, arguments in enumerate(
            [
                ["{}", "-7", *ON_TOP],
                ["{}", *ON_TOP, "-7"],
                [*ON_TOP[:2], "{}", *ON_TOP[2:], "--", "-7"],
                ["{}", "-7", *ON_TOP, "--drawing", "logo.svg", "--drawing", ""],
            ]
        ):
            with self.subTest(arguments):
                self.run_it("label", BRACKET, *(word if word != "{}" else f"{number}.stl" for word in arguments))
                self.assertEqual((self.folder / f"{number}.stl").read_bytes(), (self.folder / "same.stl").read_bytes())

    def test_also(self):
        textlabel.label(BRACKET, "A43", self.folder / "same.stl", [{"drawing": self.logo, **BELOW}], **TOP)
        for also in (["--also", "", "--drawing", "logo.svg"], ["--also=", "--set", "drawing=logo.svg"]):
            with self.subTest(also):
                said = self.run_it("label", BRACKET, "out.stl", "A43", *ON_TOP, *also, *FROM_BELOW)
                self.assertAlmostEqual(json.loads(said)["also"][0]["label_area"], ink(5, 14), places=6)
                self.assertEqual((self.folder / "out.stl").read_bytes(), (self.folder / "same.stl").read_bytes())

    def test_label_refused(self):
        for arguments, status, word in [
            ([], 2, "The text is missing"),
            (["--drawing", ""], 2, "The text is missing"),
            (["--drawing", "logo.svg", "--set", "drawing="], 2, "The text is missing"),
            (["--also", "", "--drawing", "logo.svg"], 2, "The text is missing"),  # of the first one
            (["A43", "--drawing", "logo.svg"], 2, "both 'logo.svg' and 'A43' are there"),
            (["A43", "B", "--drawing", "logo.svg"], 2, "unrecognized arguments: B"),
            (["A43", "--also", "7", "--drawing", "logo.svg"], 2, "Label 2 ('7'): A drawing is cut instead of a text"),
            (["A43", "--also", ""], 2, "--also needs the text"),
            (["A43", "--also", "", "--drawing", ""], 2, "--also needs the text"),
            (["A43", "--drawing", "logo.svg", "--also", ""], 2, "--also needs the text"),
            (["A43", "--also", "--drawing", "logo.svg"], 2, "--also needs the text"),
            (["A43", "--also", "", "--drawing", "logo.svg", "--size", "big"], 2, "Label 2 ('logo.svg'): The parameter size"),
            (["--drawing", "none.svg"], 1, "none.svg"),
            (["--drawing", "logo.svg", "--outline", "./logo.svg"], 1, "written over './logo.svg'"),
        ]:
            with self.subTest(arguments):
                self.assertIn(word, self.run_it("label", BRACKET, "out.stl", *ON_TOP, *arguments, status=status))
        self.assertEqual(self.written(), ["logo.svg"])
        self.assertEqual(self.logo.read_text(), frame(5))

    def test_series(self):
        (self.folder / "logos" / "north").mkdir(parents=True)
        holes = {"a": 2, "north/b": 4}
        for name, hole in holes.items():
            (self.folder / "logos" / f"{name}.svg").write_text(frame(hole))
        (self.folder / "t.csv").write_text("text,customer\nA1,a\nA2,north/b\nA3,none\nA4,\n")
        arguments = ["serial", BRACKET, "--csv", "t.csv", *ON_TOP, "--output", "out", "--quiet"]
        arguments += ["--also", "", "--drawing", "logos/{customer}.svg", *FROM_BELOW]
        said = self.run_it(*arguments, status=1)
        self.assertIn("2 made", said)
        self.assertIn("row 3 (bracket.stl, 'A3'): Label 2 ('logos/none.svg'): There is no drawing 'logos/none.svg'. Check", said)
        self.assertIn("row 4 (bracket.stl, 'A4'): Label 2 (''): No drawing is named in this row.", said)
        self.assertIn("'logos/{customer}.svg'", said)
        self.assertNotIn("nothing uses", said)
        for entry, (name, hole) in zip(self.entries(), holes.items(), strict=True):
            more = entry["also"][0]
            self.assertEqual((more["text"], more["settings"]["drawing"]), ("", f"logos/{name}.svg"))
            self.assertEqual(more["drawing_sha256"], hashlib.sha256(frame(hole).encode()).hexdigest())
            self.assertAlmostEqual(entry["report"]["also"][0]["label_area"], ink(hole, 14), places=6)
            self.assertEqual(surface_faults(read_stl(self.folder / "out" / entry["file"])), [])
        self.assertIn("0 made at 0.0/s, 2 were there, 2 failed", self.run_it(*arguments, status=1))
        (self.folder / "logos" / "a.svg").write_text(frame(3))
        said = self.run_it(*arguments, status=2)
        self.assertIn("'bracket-A1.stl'", said)
        self.assertIn("was made from another part, font, drawing, text or settings", said)
        said = self.run_it(*arguments, "--overwrite", status=1)
        self.assertRegex(said, "1 made at .*, 1 were there, 2 failed")
        self.assertAlmostEqual(self.entries()[0]["report"]["also"][0]["label_area"], ink(3, 14), places=6)

    def test_labels_without_one_are_as_in_older_manifests(self):
        self.run_it("serial", BRACKET, "--count", "1", *ON_TOP, "--output", "out", "--quiet", "--also", "7", *FROM_BELOW)
        (entry,) = self.entries()
        self.assertNotIn("drawing_sha256", entry)
        self.assertEqual(sorted(entry["also"][0]), ["font_sha256", "settings", "text"])

    def test_series_refused(self):
        (self.folder / "t.csv").write_text("text,drawing\nA1,logo.svg\nA2,\n")
        count, table = (["serial", BRACKET, *source, "--output", "out"] for source in (["--count", "2"], ["--csv", "t.csv"]))
        for arguments, word in [
            ([*count, "--drawing", "logo.svg"], "--drawing logo.svg: a drawing holds no serial"),
            ([*count, "--set", "drawing={n}.svg"], "--drawing {n}.svg: a drawing holds no serial"),
            (table, "a column 'drawing', but a drawing holds no serial"),
            ([*table, "--also", "", "--drawing", "{drawing}"], '--also "" --drawing {logo}'),
            ([*count, "--also", "{n}", "--drawing", "logo.svg"], "Label 2 ('{n}'): A drawing is cut instead of a text"),
            ([*count, "--also", "", "--drawing", "{x}.svg"], "wants {x}"),
            ([*count, "--also", "", "--drawing", "logo.svg", "--direction", "0,0,1"], "Label 2 ('logo.svg'): A direction alone"),
            ([*count, "--also", ""], "--also needs the text"),
        ]:
            with self.subTest(arguments):
                self.assertIn(word, self.run_it(*arguments, status=2))
        self.assertEqual(self.written(), ["logo.svg", "t.csv"])


if __name__ == "__main__":
    textlabel.load_plugin()
    unittest.main()
