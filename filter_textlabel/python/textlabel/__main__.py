"""The command line: python -m textlabel label | serial."""

import argparse
import json
import os
import pathlib
import re
import sys

from . import serial, tasks
from .part import label
from .plugin import LabelError, check_name, check_place, check_text, naming, parse_value
from .tasks import UsageError
from .template import Template, TemplateError

EPILOG = """\
label    python -m textlabel label bracket.stl labelled.stl A43 --size 14 --depth 1.5

serial   One labelled file for each row of a table (CSV), or for each number, and each part:

           python -m textlabel serial bracket.stl --csv serials.csv --output out
           python -m textlabel serial bracket.stl housing.stl --count 1000 --output out

--also   Another label on each part. What follows it, up to the next --also, says where and how it is:

           python -m textlabel label bracket.stl labelled.stl A43 --at 0,-20,8 --also "PN 4711" --code "data matrix"
           python -m textlabel label bracket.stl labelled.stl A43 --at 0,-20,8 --also "" --drawing logo.svg

exit     0 all labelled; 1 refused, or some rows failed; 2 wrong usage, nothing was started; 130 interrupted"""

SERIAL = """\
Make one labelled file for each row and part.

The table has a header line. Its columns: text (the serial), part (a mesh file, beside the table or one of PART; without
it every PART is labelled), any parameter of the filter (size, depth, position, ...: it counts for the serial's label in
its row), and others for the templates. Templates hold fields in braces: {part} (name of the mesh without ending), {n}
(number of the row, as {n:04}), {text}, any column; braces themselves are {{ and }}. The texts of further labels (--also)
are templates, and so are the values that options give, as --size {size}; one whose fields are all empty is left out. In
names of files that are written, a field's slashes become _. A further label may be a drawing: --also "" --drawing
"logos/{customer}.svg".

The folder gets the files, the materials and textures that belong to them, and manifest.jsonl, one JSON object for each
file: file, text, sha256, the part, its sha256 and those of font files and drawings, settings, further labels and report.
Run the same command again after an interruption: what is there and whole is kept. Serials that stand twice are refused
before anything starts; rows that fail do not stop the others and are listed at the end and in failed.csv."""

SHOWN = 20  # failed rows on the terminal
NO_TEXT = (
    "--also needs the text of the further label, or \"\" before the --drawing that is cut instead. "
    "One that begins with -- is written --also=--text."
)
MOST_NUMBERS = 100_000  # in one run: its rows are checked before anything starts, which takes seconds

# flag, parameter, help
FLAGS = [
    ("--at", "position", "X,Y,Z: at this point of the surface (default: the largest flat region that holds the text)"),
    ("--direction", "direction", "X,Y,Z: with --at, from the surface towards the viewer (default 0,0,1)"),
    ("--up", "up", "X,Y,Z: where the top of the letters points"),
    ("--rotate", "rotation", "degrees, counter-clockwise"),
    ("--style", "style", "emboss, engrave or flat"),
    ("--size", "size", "height of a capital letter, mesh units"),
    ("--depth", "depth", "mesh units"),
    ("--along", "extrude_along", "viewpoint, label or surface"),
    ("--font", "font", "family or font file"),
    ("--code", "code", "a code instead of letters: data matrix, gs1 data matrix, qr code, micro qr code, aztec code, code 128"),
    ("--drawing", "drawing", "FILE.svg: a drawing instead of text, as a logo; --size is its height; the text is left out"),
    ("--tolerance", "tolerance", "largest distance between the font's curves and what is cut, mesh units"),
    ("--color", "color", "RRGGBB, of the letters' faces"),
    ("--report", "report", "FILE.json: the report of the run"),
    ("--picture", "picture", "FILE.png: a picture of the result"),
    ("--outline", "outline", "FILE.svg: the flat label"),
]


def _parser():
    parser = argparse.ArgumentParser(
        prog="textlabel",
        description="Cut texts into mesh files.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="label | serial")
    # no abbreviations: one behind --also would count for the label before it
    one = commands.add_parser("label", help="label one part and print the report (JSON)", allow_abbrev=False)
    one.add_argument("input", help="mesh file")
    one.add_argument("output", help="mesh file to write")
    one.add_argument("text", nargs="?", help="the text; \\n breaks a line; left out with --drawing")
    _add_label(one)
    many = commands.add_parser(
        "serial",
        help="serial numbers on one or many parts",
        description=SERIAL,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    many.add_argument("parts", nargs="*", metavar="PART", help="mesh file")
    source = many.add_mutually_exclusive_group(required=True)
    source.add_argument("--csv", metavar="FILE", help="the table of serials")
    source.add_argument("--count", type=int, metavar="N", help="no table: so many numbers")
    many.add_argument("--first", type=int, default=1, metavar="N", help="the first number {n} (default 1)")
    many.add_argument("--text", metavar="TEMPLATE", help="texts (default: column text; with --count {part}-{n:04})")
    many.add_argument(
        "--name", metavar="TEMPLATE", help="files, without ending (default {part}-{text}; with --count and no --text {text})"
    )
    many.add_argument("--format", default="", metavar="ENDING", help="stl, ply, obj or off (default: as the part)")
    many.add_argument("--output", required=True, metavar="FOLDER", help="for files and manifest; made when missing")
    many.add_argument(
        "--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="processes (default: all CPUs)"
    )
    many.add_argument("--overwrite", action="store_true", help="replace files that were made otherwise, or by others")
    many.add_argument("--quiet", action="store_true", help="no progress bar")
    _add_label(many)
    return parser


def _add_parameters(parser):
    group = parser.add_argument_group("label")
    for flag, name, text in FLAGS:
        group.add_argument(flag, dest=f"set_{name}", metavar=name.upper(), help=text)
    group.add_argument(
        "--wrap", dest="set_wrap", action="store_const", const="true", help="with --at or a camera: round the part, as on a bottle or a ring"
    )
    group.add_argument("--camera", metavar="FILE", help="in the centre of this view: what MeshLab's \"Copy camera settings to clipboard\" gives")
    group.add_argument("--offset", metavar="U,V", help="shift to the right and upwards, mesh units")
    group.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="any parameter of the filter")


def _add_label(parser):
    """For the help: _parse() takes all labels out before."""
    _add_parameters(parser)
    parser.add_argument(
        "--also",
        metavar="TEXT",
        help="a further label on the part, as often as wanted; the options that follow and describe a label are its own",
    )


def _parse(arguments):
    """The command, and in its `also` the further labels: namespaces with a text and parameters."""
    own, *further = _split(_join_negative(arguments))
    parser = argparse.ArgumentParser(prog="textlabel ...", add_help=False, allow_abbrev=False)
    _add_parameters(parser)
    # The first label's options are taken out as well: argparse finds a text that may be missing in one piece with the files only.
    first, own = parser.parse_known_args(own)
    also = []
    for text, *options in further:
        label, rest = parser.parse_known_args(options)
        label.text = text
        if not text.strip() and not _drawing(label):
            raise UsageError(NO_TEXT)
        also.append(label)
        own += rest  # options of the command may stand anywhere
    parsed = _parser().parse_args(own)
    vars(parsed).update(vars(first), also=also)
    return parsed


def _split(arguments):
    """The arguments before the first --also, and of each the text and the arguments after it."""
    parts = [[]]
    words = iter(arguments)
    for word in words:
        if word == "--":
            parts[-1] += [word, *words]
        elif word == "--also" or word.startswith("--also="):
            text = word.removeprefix("--also=") if "=" in word else next(words, "")
            if "=" not in word and text.startswith("--"):
                raise UsageError(NO_TEXT)
            parts.append([text])
        else:
            parts[-1].append(word)
    return parts


def _drawing(arguments):
    """The drawing that the options of a label give; empty: none."""
    assignments = [assignment.partition("=") for assignment in arguments.set]
    return [arguments.set_drawing or "", *(text for name, _, text in assignments if name == "drawing")][-1]


def _settings(arguments, is_template):
    """Parameters of the filter as texts. is_template: those with a brace are not yet values."""
    settings = {name: getattr(arguments, f"set_{name}") for name in [*(name for _, name, _ in FLAGS), "wrap"]}
    settings = {name: text for name, text in settings.items() if text is not None}
    if arguments.camera is not None:
        settings["camera"] = _text_of(arguments.camera)
    if arguments.offset is not None:
        settings["offset_u"], comma, settings["offset_v"] = arguments.offset.partition(",")
        if not comma:
            raise UsageError(f"--offset {arguments.offset}: write U,V.")
    for assignment in arguments.set:
        name, equals, text = assignment.partition("=")
        if not equals:
            raise UsageError(f"--set {assignment}: write NAME=VALUE.")
        if name == "text":
            raise UsageError(
                f"--set {assignment}: a text is given as TEXT to label, to serial by --text or the table, to both by --also TEXT."
            )
        settings[name] = text
    for name, text in settings.items():
        if is_template and "{" in text:
            check_name(name)
        else:
            parse_value(name, text)
    return settings


def _text_of(path):
    try:
        return pathlib.Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"--camera {path}: the file cannot be read as text: {error}") from error


def _of_each(arguments, work):
    """What work gives for the arguments of each label."""
    labels = [arguments, *arguments.also]
    made = []
    for number, each in enumerate(labels, 1):
        try:
            with naming(number, len(labels), each.text, _drawing(each)):
                check_text(each.text, _drawing(each))
                made.append(work(each))
        except LabelError as error:
            raise UsageError(str(error)) from None
    return made


def _values(arguments):
    """Text and parameters of a label."""
    values = {name: parse_value(name, text) for name, text in _settings(arguments, is_template=False).items()}
    check_place(values)
    return {**values, "text": arguments.text}


def _template(arguments):
    """A label in all rows."""
    settings = {name: Template(text) for name, text in _settings(arguments, is_template=True).items()}
    return tasks.Label(Template(arguments.text), settings)


def _label(arguments):
    if arguments.text is None and not _drawing(arguments):
        raise UsageError("The text is missing. Write it behind the output, or give a drawing instead, by --drawing FILE.svg.")
    first, *also = _of_each(arguments, _values)
    print(json.dumps(label(arguments.input, first.pop("text"), arguments.output, also, **first), indent=1))
    return 0


def _serial(arguments):
    if arguments.jobs < 1 or (arguments.count is not None and arguments.count < 1):
        raise UsageError("--jobs and --count take numbers from 1.")
    if arguments.count is not None and arguments.count > MOST_NUMBERS:
        raise UsageError(f"--count {arguments.count}: at most {MOST_NUMBERS} in one run. Make the next ones by --first in another run.")
    if _drawing(arguments):
        raise UsageError(
            f"--drawing {_drawing(arguments)}: a drawing holds no serial. "
            "Put it on as a further label, --also \"\" --drawing FILE.svg, behind the options of the serial."
        )
    name = arguments.name or ("{part}-{text}" if arguments.csv or arguments.text else "{text}")
    arguments.text = arguments.text or ("{text}" if arguments.csv else "{part}-{n:04}")
    plan = tasks.Plan(
        parts=[pathlib.Path(part) for part in arguments.parts],
        labels=_of_each(arguments, _template),
        name=Template(name),
        ending=arguments.format.lstrip("."),
    )
    missing = [str(part) for part in plan.parts if not part.is_file()]
    if missing:
        raise UsageError(f"There is no mesh {', '.join(missing)}. Check the name.")
    if arguments.csv:
        rows = tasks.read_table(arguments.csv, arguments.first)
        unused = tasks.check_columns(rows, plan)
        if unused:
            print(f"textlabel: columns that nothing uses: {', '.join(unused)}", file=sys.stderr)
    else:
        rows = tasks.number_rows(arguments.first, arguments.count)
    todo, problems = tasks.make_tasks(rows, plan, pathlib.Path(arguments.csv or ".").parent)
    outcome = serial.run(todo, problems, arguments.output, arguments.jobs, arguments.overwrite, arguments.quiet)
    return _conclude(outcome, len(todo), arguments.output)


def _conclude(outcome, total, folder):
    for problem in outcome.problems[:SHOWN]:
        print(f"textlabel: row {problem.row} ({problem.what}): {problem.reason}", file=sys.stderr)
    if len(outcome.problems) > SHOWN:
        print(f"textlabel: and {len(outcome.problems) - SHOWN} more, see {serial.FAILED} there", file=sys.stderr)
    kept = f", {outcome.kept} were there" if outcome.kept else ""
    failed = f", {len(outcome.problems)} failed" if outcome.problems else ""
    print(f"textlabel: {outcome.made} made at {outcome.rate:.1f}/s{kept}{failed}: {folder}", file=sys.stderr)
    if outcome.interrupted and outcome.made + outcome.kept < total:
        print("textlabel: interrupted; the same command again makes the rest", file=sys.stderr)
        return 130
    return 1 if outcome.problems else 0


def _join_negative(arguments):
    """-1,0,0 after a flag is its value; argparse would take it for a flag."""
    joined = []
    for argument in arguments:
        if joined and joined[-1] in {"--offset", *(flag for flag, _, _ in FLAGS)} and re.match(r"-[\d.]", argument):
            joined[-1] += "=" + argument
        else:
            joined.append(argument)
    return joined


def main(arguments=None):
    """Run the command line; returns the exit status."""
    if sys.stderr is None:  # of a service; the next file that is opened would be taken for it
        sys.stderr = open(os.devnull, "w", encoding="utf-8")
    try:
        parsed = _parse(sys.argv[1:] if arguments is None else arguments)
        return _label(parsed) if parsed.command == "label" else _serial(parsed)
    except LabelError as error:
        print(f"textlabel: {error}", file=sys.stderr)
        return 1
    except (UsageError, TemplateError) as error:
        print(f"textlabel: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"textlabel: {error}. When that is mended, the same command again makes the rest.", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("textlabel: stopped; the same command again makes the rest", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
