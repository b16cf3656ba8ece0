"""What the formats of mesh files hold, as this MeshLab reads and writes them: what they lack is refused, not lost."""

import os
import re
import zipfile
import zlib

import numpy as np

from .plugin import CHOICES, LabelError

# endings
WITH_DOUBLES = (".ply", ".obj", ".off")
WITH_SINGLES = (*WITH_DOUBLES, ".stl")  # at least: what a label is checked for
WITH_FACE_COLORS = (".ply", ".obj", ".off", ".stl")
WITHOUT_TEXTURES = (".stl", ".off")
LOSSY = (".ctm",)
POLYGON_STEP = 1e-7  # of an OBJ file with polygons, whose coordinates are written in single precision, too
SAVED_DIGITS = 6  # of the others: significant ones, or decimals (.3mf)

FLAT = CHOICES["style"].index("Flat")


def takes_textures(output):
    """Whether a mesh is saved there with its textures."""
    return _ending(output) not in WITHOUT_TEXTURES


def strictest(reports):
    """What all labels on a part together ask of its file, as a report that the functions below take."""
    return {
        "survives_float32": all(report["survives_float32"] for report in reports),
        "coordinate_step": min(report["coordinate_step"] for report in reports),
        "size": min(report["size"] for report in reports),
    }


def save_options(mesh, report, output):
    """Keywords for save_current_mesh().

    mesh: the labelled pymeshlab.Mesh. report: of its label, or strictest(). Polygons of more than three corners are written as
    such where nothing is lost by it: of an OFF file MeshLab turns them round, of an OBJ file it leaves textures and digits away.
    """
    options = {"save_textures": takes_textures(output)}
    if _ending(output) == ".off":
        options["save_polygonal"] = False
    if _ending(output) == ".obj":
        has_texture = mesh.has_wedge_tex_coord() or mesh.has_vertex_tex_coord()
        is_too_fine = not report["survives_float32"] or report["coordinate_step"] < POLYGON_STEP
        options["save_polygonal"] = not has_texture and not is_too_fine
    return options


def refuse_lost_color(values, output):
    """Raise LabelError for a flat label in a format without face colours. values: of the filter's parameters."""
    if values.get("style") == FLAT and _ending(output) not in WITH_FACE_COLORS:
        raise LabelError(
            f"'{output}' cannot be written: a flat label is a colour, which its format is saved without. "
            "Write a .ply, .obj or .off file, or choose another style."
        )


def refuse_lost_precision(mesh, report, output):
    """Raise LabelError for letters finer than what the format keeps apart: far from the origin, very small, or in few digits.

    mesh: the labelled pymeshlab.Mesh. report: of its label, or strictest().
    """
    ending = _ending(output)
    if not report["survives_float32"] and ending not in WITH_DOUBLES:
        raise LabelError(
            f"'{output}' cannot be written: its format has single precision, which would spoil letters so fine. "
            "Write a .ply, .obj or .off file, make the text larger and deeper, or move the part nearer to the origin."
        )
    if ending in WITH_SINGLES:
        return
    if ending == ".3mf":
        step, most = 10.0**-SAVED_DIGITS, 4 * report["coordinate_step"]
    else:
        corners = mesh.bounding_box()
        largest = max(np.abs(corners.min()).max(), np.abs(corners.max()).max())
        step, most = 10.0 ** (np.floor(np.log10(largest)) + 1 - SAVED_DIGITS), report["size"] / 400  # as curves are cut
    if ending in LOSSY or step > most:
        raise LabelError(
            f"'{output}' cannot be written: its format is saved with so few digits (steps of {step:g} here) that the label could be "
            "spoilt. Write a .ply, .obj, .off or .stl file."
        )


def refuse_other_unit(path):
    """Raise LabelError for a 3MF file in another unit than millimetres: its numbers are read as they are, and written as millimetres."""
    if _ending(path) != ".3mf":
        return
    try:
        with zipfile.ZipFile(path) as archive:
            models = [name for name in archive.namelist() if name.lower().endswith(".model")]
            heads = [archive.open(name).read(1 << 16) for name in models]
    except (OSError, EOFError, RuntimeError, zipfile.BadZipFile, zlib.error):
        return  # MeshLab says what is wrong with it
    for head in heads:
        unit = re.search(rb"<model\b[^>]*\bunit\s*=\s*[\"']([a-z]+)", head)
        if unit and unit[1] != b"millimeter":
            raise LabelError(
                f"The mesh '{path}' is in the unit {unit[1].decode()}, which would be lost. Export it in millimetres."
            )


def _ending(path):
    return os.path.splitext(os.fspath(path))[1].lower()
