"""What the formats of mesh files hold, as this MeshLab reads and writes them: what they lack is refused, not lost."""

import os
import re
import zipfile
import zlib

from .plugin import CHOICES, LabelError

# endings
WITH_DOUBLES = (".ply", ".obj", ".off")
WITH_SINGLES = (*WITH_DOUBLES, ".stl")  # at least: what a label is checked for
WITH_FACE_COLORS = (".ply", ".obj", ".off", ".stl")
WITHOUT_TEXTURES = (".stl", ".off")
LOSSY = (".ctm", ".u3d", ".nxs")
WITHOUT_FACES = (".xyz",)
WITH_DECIMALS = (".3mf", ".dxf", ".idtf")
SIX_DECIMALS, SIX_DIGITS = -6, 6  # of these and of other formats: the filter's file_digits
POLYGON_STEP = 1e-7  # of an OBJ file with polygons, whose coordinates are written in single precision, too

FLAT = CHOICES["style"].index("Flat")


def takes_textures(output):
    """Whether a mesh is saved there with its textures."""
    return _ending(output) not in WITHOUT_TEXTURES


def file_digits(output):
    """The filter's parameter of that name for labels on a part that is saved there."""
    if _ending(output) in WITH_SINGLES:
        return 0
    return SIX_DECIMALS if _ending(output) in WITH_DECIMALS else SIX_DIGITS


def refuse_lossy(output):
    """Raise LabelError for a format that compresses or simplifies meshes, or has no faces."""
    if _ending(output) in WITHOUT_FACES:
        raise LabelError(f"'{output}' cannot be written: its format holds points only. Write a .ply, .obj, .off or .stl file.")
    if _ending(output) in LOSSY:
        raise LabelError(
            f"'{output}' cannot be written: its format compresses or simplifies meshes, which could spoil the label. "
            "Write a .ply, .obj, .off or .stl file."
        )


def strictest(reports):
    """What all labels on a part together ask of its file, as a report that the functions below take."""
    return {
        "survives_float32": all(report["survives_float32"] for report in reports),
        "coordinate_step": min(report["coordinate_step"] for report in reports),
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


def refuse_lost_precision(report, output):
    """Raise LabelError for letters that single precision does not keep apart, in a format that has no more.

    report: of a label, or strictest().
    """
    if not report["survives_float32"] and _ending(output) not in WITH_DOUBLES:
        raise LabelError(
            f"'{output}' cannot be written: its format has single precision, which would spoil letters so fine. "
            "Write a .ply, .obj or .off file, make the text larger and deeper, or move the part nearer to the origin."
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
