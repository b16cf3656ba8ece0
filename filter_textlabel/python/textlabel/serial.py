"""Serial numbers: one labelled file for each row and part, as many processes as wanted, resumable at any moment."""

import csv
import dataclasses
import os
import signal
import sys

from .crew import Crew
from .files import Clash, font_file, sha256
from .manifest import Manifest
from .plugin import LabelError, check_path
from .progress import Progress
from .tasks import Problem, UsageError, serial_of

FAILED = "failed.csv"


@dataclasses.dataclass
class Outcome:
    """What a run has done."""

    made: int = 0
    kept: int = 0  # were there from an earlier run
    interrupted: bool = False
    problems: list = dataclasses.field(default_factory=list)
    rate: float = 0.0  # files per second


def run(tasks, problems, folder, jobs, overwrite=False, quiet=False):
    """Make all files that are not there yet.

    tasks, problems: of make_tasks(). folder: for the files, manifest.jsonl and, when rows failed, failed.csv.
    overwrite: replace files that were made otherwise or by others, instead of refusing to start.
    Returns an Outcome. Raises UsageError before anything is written when the folder's name or state forbids the run.
    """
    try:
        check_path(os.path.abspath(folder))
    except LabelError as error:
        raise UsageError(str(error)) from error
    manifest = _open_manifest(folder)
    outcome = Outcome(problems=list(problems))
    try:
        hashes = {part: sha256(part) for part in {task.part for task in tasks}}
        labels = [label for task in tasks for label in task.labels]
        fonts = {font: sha256(file) for font in {_font(label) for label in labels} if (file := font_file(font))}
        drawings = {drawing: sha256(drawing) for drawing in {_drawing(label) for label in labels} if drawing}
        entries = {task.file: _entry(task, hashes[task.part], fonts, drawings) for task in tasks}
        _refuse_used_serials(tasks, manifest)
        again, open_tasks = _sort_out(tasks, entries, manifest, overwrite)
        outcome.kept = len(tasks) - len(open_tasks)
        manifest.start(again)
        _work(open_tasks, entries, manifest, jobs, outcome, quiet)
        manifest.finish([task.file for task in tasks])
        _write_failed(outcome.problems, manifest.folder / FAILED)
    finally:
        manifest.close()
    return outcome


def _open_manifest(folder):
    try:
        return Manifest(folder)
    except BlockingIOError:
        raise UsageError(f"Another run is writing to {folder}. Wait for it, or take another folder.") from None
    except ValueError as error:
        raise UsageError(f"The folder {folder} cannot be resumed: {error}. Mend it or take another.") from None
    except OSError as error:
        raise UsageError(f"The folder {folder} cannot be written to: {error.strerror}.") from None


def _font(label):
    return label["settings"].get("font", "")


def _drawing(label):
    return label["settings"].get("drawing", "")


def _entry(task, part_hash, fonts, drawings):
    """The manifest's line of a task, but for what the run finds out. fonts, drawings: hashes of those that are files."""
    first, *also = [{**label, "font_sha256": fonts.get(_font(label))} for label in task.labels]
    for label in also:
        if _drawing(label):  # others are as in older manifests, which know no drawings
            label["drawing_sha256"] = drawings[_drawing(label)]
    entry = {"file": task.file, "part": task.part.name, "row": task.row, "part_sha256": part_hash, **first}
    return {**entry, "also": also} if also else entry


def _is_same(entry, other):
    font = other["font_sha256"]
    is_same_font = entry.get("font_sha256", font) == font  # older manifests do not have it
    return is_same_font and all(entry.get(name) == other.get(name) for name in ("text", "part_sha256", "settings", "also"))


def _refuse_used_serials(tasks, manifest):
    """A serial that an earlier run put on another file of the same part."""
    files = {task.file for task in tasks}
    used = {(e["part"], serial_of(e["text"])): e["file"] for e in manifest.entries.values() if e["file"] not in files}
    for task in tasks:
        other = used.get((task.part.name, serial_of(task.text)))
        if other:
            raise UsageError(
                f"The serial '{task.text}' of row {task.row} is on {task.part.name} already, as '{other}'. "
                "Nothing was started; take other serials or another folder."
            )


def _sort_out(tasks, entries, manifest, overwrite):
    """Files whose lines in the manifest are void, and the tasks that are still to be done."""
    again, open_tasks = [], []
    for task in tasks:
        before = manifest.entries.get(task.file)
        same = before is not None and _is_same(before, entries[task.file])
        if same and manifest.holds(before):
            continue
        foreign = before is None and (manifest.folder / task.file).exists()
        if (foreign or (before is not None and not same)) and not overwrite:
            why = "is not in the manifest" if foreign else "was made from another part, font, drawing, text or settings"
            raise UsageError(
                f"The file '{task.file}' is in the folder and {why}. "
                "Nothing was started; take another folder, or replace such files by --overwrite."
            )
        if before is not None:
            again.append(task.file)
        open_tasks.append(task)
    return again, open_tasks


def _work(tasks, entries, manifest, jobs, outcome, quiet):
    """Hand out the tasks part by part, so that each worker loads a part once; commit what comes back."""
    by_file = {task.file: task for task in sorted(tasks, key=lambda task: str(task.part))}
    crew = Crew([(file, _message(task, manifest)) for file, task in by_file.items()], jobs, manifest.lock)
    progress = Progress(len(tasks) + outcome.kept, outcome.kept, quiet)

    def stop(*_):
        if outcome.interrupted:
            raise KeyboardInterrupt
        outcome.interrupted = True
        crew.stop()
        print("\nfinishing what was begun; once more to stop at once", file=sys.stderr)

    before = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        for file, answer in crew.answers():
            progress.step(_take(answer, by_file[file], entries[file], manifest, outcome))
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    outcome.rate = progress.rate()
    progress.finish()


def _message(task, manifest):
    return {
        "part": os.path.abspath(task.part),
        "output": os.path.abspath(manifest.unfinished(task.file)),
        "labels": task.labels,
    }


def _take(answer, task, entry, manifest, outcome):
    """Whether the answer's file is there now."""
    reason = answer.get("reason")
    if "report" in answer:
        try:
            manifest.commit({**entry, **answer})
            outcome.made += 1
            return True
        except Clash as clash:
            reason = str(clash)
    outcome.problems.append(Problem(task.row, f"{task.part.name}, '{task.text}'", reason))
    return False


def _write_failed(problems, path):
    if not problems:
        path.unlink(missing_ok=True)
        return
    problems.sort(key=lambda problem: problem.row)
    with open(path, "w", encoding="utf-8", errors="backslashreplace", newline="") as file:
        table = csv.writer(file)
        table.writerow(["row", "what", "error"])
        table.writerows([problem.row, problem.what, problem.reason] for problem in problems)
