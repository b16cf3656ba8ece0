"""One part, loaded once and labelled as often as wanted."""

import contextlib
import os
import pathlib
import shutil
import tempfile

import numpy as np
import pymeshlab

from . import files, formats
from .aside import Aside
from .plugin import FILTER, LabelError, check_path, check_text, check_value, check_values, load_plugin, naming, run_filter

NO_TEXTURE = "dummy.png"  # what MeshLab calls the picture in place of a texture that it cannot load
WITH_TEXTURES_INSIDE = (".glb", ".gltf", ".3mf")  # endings: a file of a texture's name need not be that texture


def label(mesh, text, output=None, also=(), **parameters):
    """Label one part with a text, or with several. With a drawing, as drawing="logo.svg", the text is "" or None.

    mesh: a mesh file; or a pymeshlab.MeshSet, whose current mesh is labelled in place.
    output: the file to write; None for a MeshSet that is to be worked on further.
    also: further labels on the part of a file, put there one after the other: [{"text": "4711", "code": "qr code"}].
    parameters: of the filter, see defaults(). A position without a placement means "Point and direction", a camera
    "Camera"; a colour, as "ff8000" or (255, 128, 0), means that raised letters get it too.
    Returns the report; with further labels theirs are in it, as "also". Raises LabelError; a MeshSet is then as it was, and
    no file is written. Only where a report, picture, outline or the output of a MeshSet could not be written, which the text
    says, it is labelled.
    """
    first, *_ = _labels(text, also, parameters)
    if isinstance(mesh, pymeshlab.MeshSet):
        if also:
            raise LabelError("A MeshSet takes one label at a time. Label it once for each text.")
        output = _resolved(output)
        if output is not None:
            formats.refuse_lossy(output)
            if formats.takes_textures(output):
                _refuse_far_textures(mesh, "the mesh")
        report = _apply(mesh, first, output)
        if output is not None:
            formats.refuse_lost_precision(report, output)
            _save_in_place(mesh, output, report)
        return report
    if output is None:
        raise LabelError("Labelling a file needs an output: the file to write.")
    return Part(mesh).label(text, output, also, **parameters)


class Part:
    """A mesh file in memory. Each label is cut into a copy of it, so no label sees an earlier one."""

    def __init__(self, path):
        """All objects of the file are one mesh, each where and as large as the file has it.

        Raises LabelError when the file cannot be read as a mesh with faces."""
        load_plugin()
        self.path = os.fspath(path)
        check_path(self.path)
        formats.refuse_other_unit(self.path)
        self._folder = os.path.dirname(os.path.abspath(self.path))
        self._set = pymeshlab.MeshSet()
        try:
            with _working_folder_kept():
                self._set.load_new_mesh(self.path)
            _unite_layers(self._set)
        except pymeshlab.PyMeshLabException as error:
            raise LabelError(f"The mesh '{self.path}' cannot be read: {_one_line(error)}") from error
        self._original = self._set.current_mesh_id()

    def textures(self):
        """Names of the part's textures, as its file has them."""
        return list(self._set.mesh(self._original).textures())

    def label(self, text, output, also=(), **parameters):
        """Write the part with the text cut into it to the file output; see label()."""
        labels = _labels(text, also, parameters)
        drawings = [values["drawing"] for values in labels if values.get("drawing")]
        output = _resolved(output)
        formats.refuse_lossy(output)
        self._set.set_current_mesh(self._original)
        if formats.takes_textures(output):
            self._refuse_lost_textures()
            _refuse_far_textures(self._set, f"the mesh '{self.path}'")
        untouched = self._textures_beside(output)
        run_filter(self._set, "generate_copy_of_current_mesh")
        try:
            with Aside(taken=[self.path, output, *drawings]) as aside:
                reports = _apply_all(self._set, labels, output, aside)
                strictest = formats.strictest(reports)
                formats.refuse_lost_precision(strictest, output)
                _save(self._set, output, strictest, untouched)
                aside.move()
        finally:
            self._set.delete_current_mesh()
            self._set.clear_filter_script()  # it would grow with each label
        return {**reports[0], "also": reports[1:]} if also else reports[0]

    def _refuse_lost_textures(self):
        """MeshLab takes a picture of its own for a texture that it cannot load, and would save that one."""
        if NO_TEXTURE in self.textures() and not os.path.isfile(os.path.join(self._folder, NO_TEXTURE)):
            raise LabelError(
                f"A texture of '{self.path}' cannot be read (missing, a blank in its name, or a format such as JPEG "
                "that this MeshLab can't read). Put it beside the mesh as PNG, "
                "or write a file without textures, .stl or .off."
            )

    def _is_beside(self, output):
        folder = os.path.dirname(output)
        return os.path.isdir(folder) and os.path.samefile(folder, self._folder)

    def _textures_beside(self, output):
        """The part's own textures that a file beside the part can name as they are, and must not change."""
        if self.path.lower().endswith(WITH_TEXTURES_INSIDE) or not self._is_beside(output):
            return []
        return self.textures()


def _unite_layers(mesh_set):
    """Make the layers of a file one, in the file's coordinates: only one is labelled, and saved without its matrix."""
    for layer in mesh_set:
        mesh_set.set_current_mesh(layer.id())
        _freeze_matrix(mesh_set)
    colored = [layer.has_face_color() for layer in mesh_set]
    for layer, has_colors in zip(mesh_set, colored):
        if any(colored) and not has_colors:  # merged as it is, its faces would have any colours
            mesh_set.set_current_mesh(layer.id())
            _color_faces(mesh_set)
    if len(mesh_set) > 1:
        run_filter(
            mesh_set,
            "generate_by_merging_visible_meshes",
            mergevisible=True,
            deletelayer=True,
            mergevertices=False,
            alsounreferenced=True,
        )


def _has_matrix(mesh_set):
    return not np.array_equal(mesh_set.current_mesh().transform_matrix(), np.eye(4))


def _freeze_matrix(mesh_set):
    """Put the current mesh where its matrix shows it: files are written without it."""
    if not _has_matrix(mesh_set):
        return
    mirrors = np.linalg.det(mesh_set.current_mesh().transform_matrix()) < 0
    run_filter(mesh_set, "apply_matrix_freeze")
    if mirrors:  # a mirror image is inside out
        run_filter(mesh_set, "meshing_invert_face_orientation", forceflip=True)


def _save_in_place(mesh_set, output, report):
    """Write the caller's current mesh as its matrix shows it, and leave it as it is."""
    if not _has_matrix(mesh_set):
        _save(mesh_set, output, report)
        return
    original = mesh_set.current_mesh_id()
    run_filter(mesh_set, "generate_copy_of_current_mesh")
    try:
        _freeze_matrix(mesh_set)
        _save(mesh_set, output, report)
    finally:
        mesh_set.delete_current_mesh()
        mesh_set.set_current_mesh(original)


def _color_faces(mesh_set):
    """Give the current mesh's faces the colours of their vertices, or white when it has none at all."""
    if mesh_set.current_mesh().has_vertex_color():
        run_filter(mesh_set, "compute_color_transfer_vertex_to_face")
    else:
        run_filter(mesh_set, "compute_color_by_function_per_face", r="255", g="255", b="255", a="255")


def _labels(text, also, parameters):
    """The parameters of all labels, the text among them. Raises LabelError when also holds no further labels."""
    _check_also(also)
    labels = [{**parameters, "text": text}, *also]
    for number, values in enumerate(labels, 1):
        text, drawing = values.get("text"), values.get("drawing")
        if not drawing:
            continue
        with naming(number, len(labels), text, drawing):
            check_text(text, drawing)
            drawing = check_value("drawing", drawing)
            check_path(drawing)
        labels[number - 1] = {**values, "text": "", "drawing": drawing}
    return labels


def _check_also(also):
    """Raise LabelError when these are no further labels."""
    is_list = isinstance(also, (list, tuple)) and all(isinstance(values, dict) for values in also)
    if not is_list or not all(_is_label(values) for values in also):
        raise LabelError(
            "Further labels are a list of dictionaries with a text or a drawing each, as [{'text': '4711', 'size': 8}]."
        )


def _is_label(values):
    return all(isinstance(name, str) for name in values) and ("text" in values or bool(values.get("drawing")))


def _apply_all(mesh_set, labels, output, aside):
    """Cut labels into the current mesh, one after the other; their reports. Their files are put aside."""
    reports = []
    for number, values in enumerate(labels, 1):
        with naming(number, len(labels), values["text"], values.get("drawing")):
            try:
                reports.append(_apply(mesh_set, aside.put(values), output))
            except LabelError as error:
                raise LabelError(aside.named(str(error))) from error
    return reports


def _apply(mesh_set, values, output):
    """Cut a label into the current mesh. values: of the filter's parameters, the text among them. Returns the report."""
    load_plugin()
    if output is not None:
        values = {"file_digits": formats.file_digits(output), **values}
    values = check_values(values)
    if output is not None:
        formats.refuse_lost_color(values, output)
    try:
        report = run_filter(mesh_set, FILTER, **values)
    except Exception as error:  # PyMeshLab has several kinds, without a common base
        raise LabelError(_reason(error)) from error
    return {name: _plain(value) for name, value in report.items()}


@contextlib.contextmanager
def _working_folder_kept():
    """MeshLab goes to the folder of a file that it reads, and stays there when the file cannot be read."""
    try:
        folder = os.getcwd()
    except FileNotFoundError:  # it was removed
        folder = None
    try:
        yield
    finally:
        if folder is not None:
            os.chdir(folder)


def _refuse_far_textures(mesh_set, name):
    """A texture is written where the mesh says, seen from the mesh; that must be within the output's folder."""
    for texture in mesh_set.current_mesh().textures() if len(mesh_set) else ():
        path = pathlib.PurePath(texture)
        if path.is_absolute() or ".." in path.parts:
            raise LabelError(
                f"The texture '{texture}' of {name} is outside the mesh's folder. "
                "Put it beside the mesh, and so in the file that names it."
            )


def _resolved(output):
    """The path of the file to write: of a link, what it names, so that the link stays. None stays None."""
    if output is None:
        return None
    check_path(output)
    path = os.path.realpath(output)
    check_path(path)  # the folder's name, too
    return path


def _save(mesh_set, output, report, untouched=()):
    """Write the current mesh, as a whole or not at all.

    report: of its label, or strictest(). untouched: textures that stay as they are when they are there.
    """
    target = pathlib.Path(output)
    folder = None
    if os.path.exists(target) and not os.path.isfile(target):
        raise LabelError(f"'{output}' cannot be written: it is a folder, a pipe or a device. Give a file name.")
    try:
        folder = pathlib.Path(tempfile.mkdtemp(prefix=".textlabel-", dir=target.parent))
        waiting = folder / target.name
        mesh_set.save_current_mesh(str(waiting), **formats.save_options(mesh_set.current_mesh(), report, output))
        files.leave_there(waiting, target, untouched)
        files.refuse_clash(waiting, target, "Choose another folder.")
        files.move(waiting, target)
    except files.Clash as clash:
        raise LabelError(f"'{output}' cannot be written: {clash}") from clash
    except (OSError, pymeshlab.PyMeshLabException) as error:
        reason = _one_line(error).replace(f"{folder}{os.sep}", f"{target.parent}{os.sep}")
        raise LabelError(
            f"'{output}' cannot be written: {reason} "
            "Choose a folder that exists and has room, and a name that ends in .stl, .ply, .obj or .off."
        ) from error
    finally:
        if folder is not None:
            shutil.rmtree(folder, ignore_errors=True)


def _one_line(error):
    return " ".join(str(error).split())


def _reason(error):
    """The filter's own sentences, without what PyMeshLab puts before them."""
    return _one_line(error).split("Details: ", 1)[-1]


def _plain(value):
    return [float(part) for part in value] if hasattr(value, "__len__") else value
