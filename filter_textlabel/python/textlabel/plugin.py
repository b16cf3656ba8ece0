"""The filter inside PyMeshLab: find its plugin, load it once, and know names, types and defaults of its parameters."""

import contextlib
import difflib
import operator
import os
import pathlib

import pymeshlab

FILTER = "apply_text_label"
VARIABLE = "TEXTLABEL_PYMESHLAB_PLUGIN"  # environment: the plugin's path

WRITTEN = ("report", "picture", "outline")  # parameters: files that a label writes beside its mesh

CHOICES = {  # of the filter, by number
    "style": ["Emboss", "Engrave", "Flat"],
    "placement": ["Current view", "Camera", "Point and direction", "Automatic"],
    "extrude_along": ["Viewpoint", "Label normal", "Surface normal"],
    "code": ["None", "Data Matrix", "GS1 Data Matrix", "QR Code", "Micro QR Code", "Aztec Code", "Code 128"],
    "align": ["Left", "Center", "Right"],
    "anchor": ["Baseline", "Middle", "Top"],
}


class LabelError(Exception):
    """A label that cannot be made, or not all be written. The text says what is wrong, where, and what to do."""


@contextlib.contextmanager
def naming(number, count, text, drawing=None):
    """Let a LabelError that comes up meanwhile say which of count labels it is about, where there are several.

    A label is called by its text, or by its drawing where it has none.
    """
    try:
        yield
    except LabelError as error:
        if count == 1:
            raise
        raise LabelError(f"Label {number} ('{text or drawing or ''}'): {error}") from error


def plugin_path():
    """Path of the plugin: what the environment says, else beside this package, else where build.sh leaves it."""
    if os.environ.get(VARIABLE):
        return pathlib.Path(os.environ[VARIABLE])
    package = pathlib.Path(__file__).resolve().parent
    folders = [package, package.parents[2] / "build" / "pymeshlab" / "filter_textlabel"]
    for folder in folders:
        for ending in ("so", "dylib", "dll"):
            for name in ("libfilter_textlabel", "filter_textlabel"):
                if (folder / f"{name}.{ending}").is_file():
                    return folder / f"{name}.{ending}"
    raise LabelError(
        f"The plugin was not found in {' or '.join(map(str, folders))}. "
        f"Build it by 'filter_textlabel/build.sh pymeshlab', or set {VARIABLE} to its path."
    )


def load_plugin(path=None):
    """Make the filter known to PyMeshLab, also as a method: ms.apply_text_label(text="A43").

    Does nothing when both are there already.
    path: the plugin's file; None: where plugin_path() finds it.
    Raises LabelError when the plugin is missing or made for another PyMeshLab.
    """
    if FILTER not in pymeshlab.filter_list():
        _load(pathlib.Path(path) if path is not None else plugin_path())
    if not hasattr(pymeshlab.MeshSet, FILTER):
        setattr(pymeshlab.MeshSet, FILTER, _method)


def _load(path):
    try:
        pymeshlab.load_plugin(str(path))
    except pymeshlab.PyMeshLabException as error:
        raise LabelError(
            f"PyMeshLab cannot load the plugin {path}: {error} Build it for the PyMeshLab that is installed: "
            "'filter_textlabel/build.sh pymeshlab'."
        ) from error


def run_filter(mesh_set, name, **values):
    """apply_filter(), for any filter, such that its failure is the end of it.

    PyMeshLab 2025.7 keeps the log of a MeshSet in which a filter failed as the place for what is said on the next file that
    is read, also when that MeshSet is gone by then, which ends Python. It is forgotten when any filter ends well.
    """
    try:
        return mesh_set.apply_filter(name, **values)
    except Exception:
        pymeshlab.MeshSet().apply_filter("create_cube")
        raise


def _method(self, **values):
    """The filter with these values, which go to apply_filter() as they are; see textlabel.defaults().

    PyMeshLab makes methods of its own filters only, when it is imported; MeshLab's "Copy PyMeshLab call to clipboard"
    counts on one for every filter.
    """
    return run_filter(self, FILTER, **values)


_method.__name__ = _method.__qualname__ = FILTER


_defaults = {}


def defaults():
    """All parameters of the filter: {name: value when it is not given}."""
    if not _defaults:
        load_plugin()
        mesh_set = pymeshlab.MeshSet()
        run_filter(mesh_set, "create_cube")
        _defaults.update(mesh_set.filter_parameter_values(FILTER))
    return dict(_defaults)


def near_names(name):
    """Parameters that a misspelt name may mean."""
    return difflib.get_close_matches(name, defaults(), n=3, cutoff=0.7)


def check_path(path):
    """Raise LabelError for a name that PyMeshLab cannot take: one that is not UTF-8, or holds a NUL."""
    name = os.fsdecode(path)
    try:
        is_good = b"\0" not in name.encode("utf-8")
    except UnicodeEncodeError:
        is_good = False
    if not is_good:
        raise LabelError(f"The name {name!r} cannot be used: MeshLab takes names in UTF-8, without NUL. Rename it.")


def check_name(name):
    """Raise LabelError when the filter has no such parameter."""
    if name not in defaults():
        near = near_names(name)
        hint = f"Did you mean {' or '.join(near)}?" if near else f"There are: {', '.join(defaults())}."
        raise LabelError(f"The filter has no parameter '{name}'. {hint}")


def check_value(name, value):
    """The value in the form that PyMeshLab takes.

    Raises LabelError when there is no such parameter or the value is of another type.
    """
    check_name(name)
    if name in CHOICES:
        return _choice(name, value)
    kind = _kind(defaults()[name])
    try:
        return _CONVERT[kind](value)
    except (TypeError, ValueError, OverflowError):
        raise LabelError(f"The parameter {name} takes {_TAKES[kind]}, not {value!r}.") from None


def check_values(values):
    """All values as PyMeshLab takes them, with what they imply: a position is meant to be used.

    Raises as check_value() and check_place().
    """
    checked = {name: check_value(name, value) for name, value in values.items()}
    check_place(checked)
    if "camera" in checked and not checked["camera"].strip() and "position" not in checked:
        raise LabelError("The camera's text is empty. Give that of a camera, or the position and direction of one.")
    if "camera" in checked:
        checked.setdefault("placement", CHOICES["placement"].index("Camera"))
    if "position" in checked or "direction" in checked:
        checked.setdefault("placement", CHOICES["placement"].index("Point and direction"))
    if "color" in checked:
        checked.setdefault("tint", True)
    return checked


def check_place(names):
    """Raise LabelError when parameters of these names say from where, but not where."""
    if "direction" in names and "position" not in names and "placement" not in names:
        raise LabelError(
            "A direction alone says no place. Give a position as well, a point of the surface, "
            "or leave the direction away: the place is chosen then."
        )


def check_text(text, drawing):
    """Raise LabelError for a text beside a drawing."""
    if text and drawing:
        raise LabelError(
            f"A drawing is cut instead of a text, and both '{drawing}' and '{text}' are there. "
            "Leave one of them away, and put it on as a label of its own."
        )


def parse_value(name, text):
    """The value that a text means, as written in a table or on the command line: 1.5; true; 0,0,1; ff8000; Engrave."""
    check_name(name)
    if name in CHOICES:
        return _choice(name, text)
    kind = _kind(defaults()[name])
    try:
        return _PARSE[kind](text)
    except (KeyError, ValueError):
        raise LabelError(f"The parameter {name} takes {_TAKES[kind]}, not '{text}'.") from None


# ---- one function for each kind of parameter


def _kind(default):
    if isinstance(default, (bool, str, float)):
        return type(default)
    return pymeshlab.Color if isinstance(default, pymeshlab.Color) else tuple


def _text(value):
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if not isinstance(value, str):
        raise TypeError
    value.encode("utf-8")  # half a surrogate pair is a ValueError
    return value


def _choice(name, value):
    """A choice's number, from itself, its name in any case, or a beginning that no other name has."""
    names = CHOICES[name]
    if isinstance(value, int) and not isinstance(value, bool) and 0 <= value < len(names):
        return value
    if isinstance(value, str) and value.strip():
        meant = [
            number
            for number, known in enumerate(names)
            if known.lower().startswith(value.strip().lower()) or value.strip() == str(number)
        ]
        if len(meant) == 1:
            return meant[0]
    raise LabelError(f"The parameter {name} takes one of {', '.join(names)}, not {value!r}.")


def _number(value):
    if isinstance(value, (bool, str)):
        raise TypeError
    return float(value)


def _truth(value):
    if not isinstance(value, bool):
        raise TypeError
    return value


def _point(value):
    if isinstance(value, str) or len(value) != 3:
        raise TypeError
    return [_number(part) for part in value]


def _color(value):
    if isinstance(value, pymeshlab.Color):
        return value
    if isinstance(value, str):
        return _parse_color(value)
    red, green, blue = map(operator.index, value)  # 0.5 is a TypeError: halves would be cut off
    if not all(0 <= part <= 255 for part in (red, green, blue)):
        raise ValueError
    return pymeshlab.Color(red, green, blue, 255)


def _parse_truth(text):
    return {"true": True, "1": True, "yes": True, "false": False, "0": False, "no": False}[text.strip().lower()]


def _parse_point(text):
    parts = [float(part) for part in text.split(",")]
    if len(parts) != 3:
        raise ValueError
    return parts


def _parse_color(text):
    digits = text.strip().removeprefix("#")
    if len(digits) != 6 or not digits.isalnum():
        raise ValueError
    return pymeshlab.Color(*(int(digits[i : i + 2], 16) for i in (0, 2, 4)), 255)


_TAKES = {
    str: "a text",
    float: "a number",
    bool: "true or false",
    tuple: "three numbers, as 0,0,1",
    pymeshlab.Color: "a colour, as ff8000 or (255, 128, 0)",
}
_CONVERT = {str: _text, float: _number, bool: _truth, tuple: _point, pymeshlab.Color: _color}
_PARSE = {str: str, float: float, bool: _parse_truth, tuple: _parse_point, pymeshlab.Color: _parse_color}
