"""Cut texts into mesh files with PyMeshLab and the Text Label filter.

    import textlabel
    report = textlabel.label("bracket.stl", "A43", "labelled.stl", size=14, depth=1.5)

    part = textlabel.Part("bracket.stl")  # loaded once, labelled as often as wanted
    for number in range(1, 101):
        part.label(f"A{number:04}", f"out/A{number:04}.stl")

    textlabel.label("bracket.stl", "A43", "labelled.stl", also=[{"text": "A43", "code": "data matrix"}])  # and more on it
    textlabel.label("bracket.stl", None, "labelled.stl", drawing="logo.svg")  # a drawing instead of a text

Every keyword is a parameter of the filter: textlabel.defaults() has all of them. Reports are dictionaries of plain
values: triangles_added, label_area, volume_before, volume_after, anchor, normal, stretch, milliseconds and more; where
the part has at most 50,000 triangles, or a report is asked for, border_edges and genus (of an oriented manifold) too.
What cannot be done raises LabelError, whose text says what is wrong, where, and what to do; nothing has changed then.

`python -m textlabel --help` is the command line, with serial numbers on many parts.
"""

from .part import Part, label
from .plugin import FILTER, LabelError, defaults, load_plugin

__all__ = ["FILTER", "LabelError", "Part", "defaults", "label", "load_plugin"]
