"""What has been made, one JSON object for each file, and how a file is committed so that no interruption can lose it.

A file is written to a folder of its own first (in .unfinished), with the materials and textures that belong to it. Then
its line goes to the manifest, then all are moved to their places. Wherever that is cut off, the next run sees it:
without a line the file is made again; with a line it is looked for in both places and known by its hash.
"""

import json
import os
import pathlib
import shutil
import time

from . import files
from .files import sha256

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None

NAME = "manifest.jsonl"
UNFINISHED = ".unfinished"
PATIENCE = 5.0  # seconds
TEXTS = ("file", "part", "text", "sha256")  # of each line


class Manifest:
    """The manifest of one output folder. One run at a time holds it."""

    def __init__(self, folder):
        """Raises BlockingIOError while another run holds the folder, ValueError when the manifest is none of ours."""
        self.folder = pathlib.Path(folder)
        self.path = self.folder / NAME
        self.folder.mkdir(parents=True, exist_ok=True)
        self.lock = _lock(self.folder)  # descriptors; who writes into the folder holds them, workers too
        self.entries = self._read()
        self._file = None

    def _read(self):
        """{file: entry}. A last line that was cut off is left out."""
        entries = {}
        if not self.path.exists():
            return entries
        lines = self.path.read_bytes().split(b"\n")
        for number, line in enumerate(lines, 1):
            try:
                entry = json.loads(line)
                if not all(isinstance(entry[name], str) for name in TEXTS):
                    raise TypeError
                entries[entry["file"]] = entry
            except (ValueError, TypeError, KeyError):
                if number < len(lines):
                    raise ValueError(f"line {number} of {self.path} is no line of a manifest") from None
        return entries

    def unfinished(self, file):
        """Where a file is written before it is committed: in a folder that nothing else is written to."""
        return self.folder / UNFINISHED / file / pathlib.PurePath(file).name

    def holds(self, entry):
        """Whether the file of an entry is there, unchanged. Finishes the commit when that was interrupted."""
        path, waiting = self.folder / entry["file"], self.unfinished(entry["file"])
        if path.is_file() and sha256(path) == entry["sha256"]:
            return True
        if waiting.is_file() and sha256(waiting) == entry["sha256"]:
            self._move(entry["file"])
            return True
        return False

    def start(self, again):
        """Open for appending; the entries of the files in again are forgotten, and what is half-made is removed."""
        for file in again:
            self.entries.pop(file, None)
        for file, entry in self.entries.items():  # of other rows, too: what has its line is no longer half-made
            if self.unfinished(file).is_file():
                self.holds(entry)
        shutil.rmtree(self.folder / UNFINISHED, ignore_errors=True)
        self.rewrite()
        self._file = open(self.path, "ab", buffering=0)

    def rewrite(self, order=()):
        """Write all entries anew, in the given order of files (others first); as a whole or not at all."""
        place = {file: index for index, file in enumerate(order)}
        self.entries = dict(sorted(self.entries.items(), key=lambda item: place.get(item[0], -1)))
        fresh = self.unfinished(NAME)
        fresh.parent.mkdir(parents=True, exist_ok=True)
        with open(fresh, "wb") as file:
            for entry in self.entries.values():
                file.write(_line(entry))
            file.flush()
            os.fsync(file.fileno())
        os.replace(fresh, self.path)

    def commit(self, entry):
        """Take a finished file over: its line first, then its place. Raises Clash, and takes nothing over then."""
        files.refuse_clash(
            self.unfinished(entry["file"]),
            self.folder / entry["file"],
            "Give each part a folder by --name '{part}/{text}', or take another output folder.",
        )
        self._file.write(_line(entry))
        os.fsync(self._file.fileno())
        self._move(entry["file"])
        self.entries[entry["file"]] = entry

    def _move(self, file):
        files.move(self.unfinished(file), self.folder / file)

    def finish(self, order):
        """Sort the manifest by order and leave the folder tidy."""
        self.rewrite(order)
        shutil.rmtree(self.folder / UNFINISHED, ignore_errors=True)

    def close(self):
        """Let other runs in."""
        if self._file:
            self._file.close()
        for descriptor in self.lock:
            os.close(descriptor)


def _lock(folder):
    """Wait a moment for the workers of a run that was killed. Raises BlockingIOError while the folder is another's."""
    if not fcntl:
        return ()
    descriptor = os.open(folder, os.O_RDONLY)
    last = time.monotonic() + PATIENCE
    while True:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return (descriptor,)
        except BlockingIOError:
            if time.monotonic() > last:
                os.close(descriptor)
                raise
            time.sleep(0.1)


def _line(entry):
    return json.dumps(entry, ensure_ascii=False, separators=(",", ":")).encode("utf-8") + b"\n"
