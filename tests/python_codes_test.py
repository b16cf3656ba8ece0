"""Codes cut into real parts are read back: from the picture of the labelled part, by a reader that knows nothing of us."""

import sys
import unittest

from python_support import MESHES, SKIPPED, InFolder, read_stl, run_module, surface_faults

import textlabel

try:
    import zxingcpp
    from PIL import Image
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(SKIPPED)

GS1 = "[01]09506000134352[21]0042"
CODES = [  # choice, the reader's name of it, text, what is read
    ("Data Matrix", "DataMatrix", "https://example.com/p/0042", None),
    ("GS1 Data Matrix", "DataMatrix", GS1, "(01)09506000134352(21)0042"),
    ("QR Code", "QRCode", "https://example.com/p/0042\nGröße 7", None),
    ("Micro QR Code", "MicroQRCode", "PN-0042", None),
    ("Aztec Code", "Aztec", "https://example.com/p/0042", None),
    ("Code 128", "Code128", "PN-42", None),
]
PLACE = {"position": (0, -2, 2.5), "direction": (0, 0, -1), "size": 24}  # on the bracket's underside


def read_codes(picture):
    """(format, text) of all codes in a picture. Read in blue, where the colour of labels is dark and that of parts is not."""
    blue = Image.open(picture).convert("RGB").split()[2]
    return {(code.format.name, code.text) for code in zxingcpp.read_barcodes(blue)}


class Codes(InFolder):
    def check(self, kind, name, text, read, part="bracket.stl", **parameters):
        picture = self.folder / "picture.png"
        out = self.folder / "out.stl"
        report = textlabel.label(MESHES / part, text, out, code=kind, picture=picture, **{**PLACE, **parameters})
        self.assertEqual(surface_faults(read_stl(out)), [])
        self.assertIn((name, read or text), read_codes(picture))
        return report

    def test_each_is_read(self):
        for (kind, name, text, read), style in zip(CODES, 3 * ["Emboss", "Engrave"]):
            with self.subTest(f"{kind}, {style}"):
                size = 14 if kind == "Code 128" else 24
                report = self.check(kind, name, text, read, style=style, size=size)
                self.assertAlmostEqual(abs(report["depth"]), report["module"] / 2, places=9)

    def test_mirrored_is_for_stamps(self):
        picture = self.folder / "picture.png"
        textlabel.label(
            MESHES / "bracket.stl", "PN-0042", self.folder / "out.stl", code="QR Code", picture=picture, mirrored=True, **PLACE
        )
        Image.open(picture).transpose(Image.Transpose.FLIP_LEFT_RIGHT).save(picture)
        self.assertIn(("QRCode", "PN-0042"), read_codes(picture))

    def test_on_a_round(self):
        place = {"position": (0, -27, 0), "direction": (0, -1, 0), "up": (0, 0, 1), "size": 12}
        report = self.check("QR Code", "QRCode", "PN16-0042", None, part="valve.stl", style="Engrave", **place)
        self.assertGreater(report["stretch"], 1)

    def test_beside_its_text_in_series(self):
        also = ["--also", "{text}", "--at", "0,-2,2.5", "--direction", "0,0,-1", "--size", "24", "--code", "data matrix"]
        job = ["serial", MESHES / "bracket.stl", "--count", "3", "--text", "PN-{n:04}", "--output", self.folder / "out", "--quiet"]
        done = run_module(*job, "--size", "7", *also, "--set", f"picture={self.folder}/{{text}}.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        for number in (1, 2, 3):
            self.assertIn(("DataMatrix", f"PN-000{number}"), read_codes(self.folder / f"PN-000{number}.png"))
            self.assertEqual(surface_faults(read_stl(self.folder / "out" / f"bracket-PN-000{number}.stl")), [])

    def test_what_does_not_fit_is_refused(self):
        with self.assertRaisesRegex(textlabel.LabelError, "cannot be written as Micro QR Code .*choose another code"):
            textlabel.label(MESHES / "bracket.stl", 40 * "x", self.folder / "out.stl", code="Micro QR Code", **PLACE)
        self.assertFalse((self.folder / "out.stl").exists())


if __name__ == "__main__":
    unittest.main()
