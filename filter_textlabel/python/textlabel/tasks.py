"""What is to be made: the rows of a table, or numbers, times the parts; checked before anything is started."""

import csv
import dataclasses
import os
import pathlib
import unicodedata

from . import plugin
from .template import Template, TemplateError, file_part

OWN_COLUMNS = ("part", "text", "n")
LONGEST_NAME = 240  # bytes; most file systems take 255, and .mtl is put behind it


class UsageError(Exception):
    """The job cannot be started as it is asked for; the text says what to change."""


@dataclasses.dataclass
class Task:
    """One file to make."""

    row: int  # of the table, the first one after the header being 1; without a table the number n
    part: pathlib.Path
    file: str  # below the output folder, with slashes
    labels: list  # [{"text": ..., "settings": {parameter: text}}]; the first one is the serial

    @property
    def text(self):
        """The serial."""
        return self.labels[0]["text"]

    def written(self):
        """(parameter, path) of all files that are written beside the mesh."""
        settings = [label["settings"] for label in self.labels]
        return [(name, each[name]) for each in settings for name in plugin.WRITTEN if each.get(name)]


def serial_of(text):
    """The same for texts that look the same on a part."""
    return unicodedata.normalize("NFC", " ".join(text.split()))


@dataclasses.dataclass
class Problem:
    """A row that gives no file."""

    row: int
    what: str  # part and text, as far as known
    reason: str


@dataclasses.dataclass
class Label:
    """A label in all rows."""

    text: Template
    settings: dict  # {parameter: Template}

    @property
    def drawing(self):
        """The template of the drawing that is cut instead of the text; empty: none."""
        return self.settings["drawing"].text if "drawing" in self.settings else ""


@dataclasses.dataclass
class Plan:
    """How rows become tasks."""

    parts: list  # paths given for all rows
    labels: list  # the first one is the serial; columns of the table may be its settings, too
    name: Template  # of the file, without ending
    ending: str  # of the files; empty: the part's own


def number_rows(first, count):
    """Rows without a table: n alone."""
    return [(n, {"n": n}) for n in range(first, first + count)]


def read_table(path, first):
    """Rows of a CSV file (UTF-8, comma, semicolon or tab, a header line): [(row number, {column: text})].

    n counts the rows from first. Raises UsageError when the file is no such table.
    """
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            header = file.readline()
            file.seek(0)
            delimiter = max(",;\t", key=header.count)
            rows = list(csv.reader(file, delimiter=delimiter, strict=True))
    except OSError as error:
        raise UsageError(f"The table {path} cannot be read: {error.strerror}. Check its name.") from None
    except UnicodeDecodeError as error:
        raise UsageError(f"The table {path} is not UTF-8 (byte {error.start}). Save it as CSV in UTF-8.") from None
    except csv.Error as error:
        raise UsageError(f"The table {path} cannot be read: {error}. Save it as CSV anew.") from None
    columns = [name.strip() for name in rows[0]] if rows else []
    if not any(columns) or len(set(columns)) < len(columns):
        raise UsageError(f"The table {path} needs a first line with a different name for each column, as text,part.")
    filled = [
        (index, {"n": first + index - 1, **_cells(columns, cells)})
        for index, cells in enumerate(rows[1:], 1)
        if any(cell.strip() for cell in cells)
    ]
    if not filled:
        raise UsageError(f"The table {path} has no rows below its header. Write a serial number into each.")
    return filled


def _cells(columns, cells):
    named = dict(zip(columns, cells))
    if len(cells) != len(columns):
        named[None] = (
            f"The row has {len(cells)} cells where the header has {len(columns)}. "
            "Mend it; a cell that holds the separator stands in double quotes."
        )
    return named


def check_columns(rows, plan):
    """Names of the columns that nothing uses. Raises UsageError when one looks like a misspelt parameter."""
    columns = [name for name in (rows[0][1] if rows else {}) if isinstance(name, str)]
    templates = [plan.name, *(each for label in plan.labels for each in (label.text, *label.settings.values()))]
    used = {*OWN_COLUMNS, *(field for template in templates for field in template.fields)}
    unused = [name for name in columns if name not in used and name not in plugin.defaults()]
    for name in unused:
        near = plugin.near_names(name)
        if near:
            raise UsageError(f"The table has a column '{name}'. Did you mean the parameter {near[0]}? Rename it.")
    return unused


def make_tasks(rows, plan, table_folder):
    """Tasks for all rows, in order of the rows, and the problems of the rows that cannot be used.

    Raises UsageError when a template cannot be filled in, or serials or file names are not all different.
    """
    _check_fields(rows, plan)
    tasks, problems = [], []
    for row, values in rows:
        for part in _parts(values, plan, table_folder):
            try:
                tasks.append(_task(row, part, values, plan))
            except (plugin.LabelError, TemplateError) as error:
                problems.append(Problem(row, f"{part.name}, '{values.get('text', '')}'", str(error)))
    _refuse_duplicates(tasks)
    return tasks, problems


def _check_fields(rows, plan):
    """What no row could do without."""
    columns = {name for _, values in rows for name in values if name is not None}
    if not plan.parts and "part" not in columns:
        raise UsageError("No part is given: name mesh files on the command line, or in a column 'part'.")
    serial, *further = plan.labels
    if "text" in serial.text.fields and "text" not in columns:
        raise UsageError("The table has no column 'text': add one, or make the texts by --text TEMPLATE.")
    if "drawing" in columns:  # it would count for the serial
        raise UsageError(
            "The table has a column 'drawing', but a drawing holds no serial. "
            "Rename the column, as 'logo', and put the drawing on as a further label: --also \"\" --drawing {logo}."
        )
    serial.text.check(columns | {"part"})
    others = [plan.name, *serial.settings.values()]
    for template in [*others, *(each for label in further for each in (label.text, *label.settings.values()))]:
        template.check(columns | {"part", "text"})
    for number, label in enumerate(plan.labels, 1):
        if "direction" not in label.settings:
            continue
        try:
            with plugin.naming(number, len(plan.labels), label.text.text, label.drawing):
                plugin.check_place({*label.settings, *(columns if label is serial else ())})
        except plugin.LabelError as error:
            raise UsageError(str(error)) from None


def _parts(values, plan, table_folder):
    """The parts of a row: the one that it names, among those given or beside the table; else all that are given."""
    name = (values.get("part") or "").strip()
    if not name:
        return plan.parts or [table_folder]  # which is no mesh
    return [part for part in plan.parts if name in (part.name, part.stem, str(part))] or [table_folder / name]


def _task(row, part, values, plan):
    if None in values:
        raise plugin.LabelError(values[None])
    if not part.is_file():
        raise plugin.LabelError(f"There is no mesh '{part}'. Check its name.")
    plugin.check_path(os.path.abspath(part))
    fields = {**values, "part": part.stem}
    fields["text"] = plan.labels[0].text.fill(fields)
    labels = []
    for number, label in enumerate(plan.labels, 1):
        text = fields["text"] if number == 1 else label.text.fill(fields)
        settings = _filled(label.settings, fields)
        if number == 1:
            settings.update({name: fields[name] for name in plugin.defaults() if name != "text" and fields.get(name)})
        with plugin.naming(number, len(plan.labels), text, settings.get("drawing")):
            _check(label, text, settings)
        labels.append({"text": text, "settings": settings})
    return Task(row, part, _file_name(part, fields, plan), labels)


def _check(label, text, settings):
    if label.drawing:
        _check_drawing(label, settings.get("drawing"))
    elif not text.strip():
        raise plugin.LabelError(f"The text is empty in this row. Fill in what it is made of: '{label.text.text}'.")
    plugin.check_value("text", text)
    for name, value in settings.items():
        plugin.parse_value(name, value)
    plugin.check_place(settings)


def _check_drawing(label, drawing):
    if not drawing:
        raise plugin.LabelError(f"No drawing is named in this row. Fill in what its name is made of: '{label.drawing}'.")
    if not os.path.isfile(drawing):
        raise plugin.LabelError(f"There is no drawing '{drawing}'. Check its name.")


def _filled(settings, fields):
    """The settings of a row, but for those made of empty fields only. What is put into the name of a file to write has no slashes."""
    safe, filled = _safe(fields), {}
    for name, template in settings.items():
        if not template.fields or any(str(fields[field]).strip() for field in template.fields):
            filled[name] = template.fill(safe if name in plugin.WRITTEN else fields)
    return filled


def _safe(fields):
    """The fields as parts of file names."""
    return {name: file_part(value) if isinstance(value, str) else value for name, value in fields.items()}


def _file_name(part, fields, plan):
    name = plan.name.fill(_safe(fields))
    steps = name.split("/")
    if "\\" in name or any(step == "" or step.startswith(".") for step in steps):
        raise UsageError(f"The file name '{name}' would leave the output folder or be hidden. Change --name.")
    file = f"{name}.{plan.ending or part.suffix.lstrip('.') or 'stl'}"
    if any(len(os.fsencode(step)) > LONGEST_NAME for step in file.split("/")):
        raise plugin.LabelError(
            "The text makes a file name that is too long. Shorten it, or name the files by --name '{part}-{n}'."
        )
    return file


def _refuse_duplicates(tasks):
    serials, files, written = {}, {}, {}
    for task in tasks:
        key = (os.path.realpath(task.part), serial_of(task.text))
        if key in serials:
            raise UsageError(
                f"The serial '{task.text}' stands twice for {task.part.name}: "
                f"in rows {serials[key].row} and {task.row}. "
                "Nothing was started; make the serials unique; of several labels, the first one is the serial."
            )
        serials[key] = task
        for name, path in task.written():
            other = written.setdefault(os.path.realpath(path), task)
            if other is not task:
                who = f"Rows {other.row} and {task.row}"
                if other.row == task.row:
                    who = f"The parts '{other.part}' and '{task.part}'"
                raise UsageError(
                    f"{who} would write the same {name}, '{path}'. "
                    f"Nothing was started; give each its own, by fields as '{{part}}-{{n}}' or in a column '{name}'."
                )
        other = files.setdefault(task.file.casefold(), task)  # some file systems do not tell A from a
        if other is not task and other.row == task.row:
            raise UsageError(
                f"The parts '{other.part}' and '{task.part}' would be written to the same file '{task.file}'. "
                "Nothing was started; give them different names, or label them one after the other into folders of their own."
            )
        if other is not task:
            raise UsageError(
                f"Rows {other.row} and {task.row} would write the same file '{task.file}'. "
                "Nothing was started; use more fields in --name, as '{part}-{n:04}', the number of the row."
            )
