"""Serial numbers by the thousand: killed in the middle and resumed, no part lost or made twice, the manifest right.

TEXTLABEL_SERIALS says how many (default 60; the full run is 1000).
"""

import contextlib
import csv
import functools
import io
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest
import unittest.mock

from python_support import (
    MESHES,
    InFolder,
    command,
    environment,
    euler,
    pymeshlab,
    read_stl,
    run_module,
    surface_faults,
    volume,
)

import textlabel
from textlabel import crew
from textlabel.__main__ import main
from textlabel.manifest import sha256

MANY = 150  # some seconds of work: enough to be met in the middle of it
COUNT = int(os.environ.get("TEXTLABEL_SERIALS", "60"))
PLACE = ["--at", "0,-20,8", "--direction", "0,0,1", "--up", "0,1,0", "--size", "7", "--depth", "1"]
BRACKET = MESHES / "bracket.stl"
PATIENCE = 300  # seconds


def serials(count):
    return [f"SN-{number:05}" for number in range(1, count + 1)]


def write_table(path, header, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(header)
        table.writerows(rows)


def entries(folder):
    return [json.loads(line) for line in (folder / "manifest.jsonl").read_text(encoding="utf-8").splitlines()]


def files(folder):
    return sorted(path.name for path in folder.iterdir() if path.suffix == ".stl")


def wait_for(condition, process):
    """Until the condition holds; fails when the process ends before, or it takes too long."""
    last = time.monotonic() + PATIENCE
    while not condition():
        assert process.poll() is None, "the run ended before it could be interrupted"
        assert time.monotonic() < last, "the run did not come so far"
        time.sleep(0.002)


def children(pid):
    """Ids of the processes that a process has started."""
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            parent = stat.read_text(errors="replace").rsplit(")", 1)[1].split()[1]
        except OSError:
            continue  # it has just ended
        if parent == str(pid):
            found.append(int(stat.parent.name))
    return found


class Numbers(InFolder):
    def setUp(self):
        super().setUp()
        self.table, self.output = self.folder / "serials.csv", self.folder / "out"
        self.arguments = ["serial", BRACKET, "--csv", self.table, "--output", self.output, *PLACE]

    def start(self, *more):
        process = subprocess.Popen(
            command(*self.arguments, *more),
            env=environment(),
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def check_files(self, texts):
        """One valid, distinct file for each text, and a manifest that says so in the table's order."""
        listed = entries(self.output)
        self.assertEqual([entry["text"] for entry in listed], texts)
        self.assertEqual([entry["row"] for entry in listed], list(range(1, len(texts) + 1)))
        self.assertEqual(sorted(entry["file"] for entry in listed), files(self.output))
        self.assertEqual(len({entry["sha256"] for entry in listed}), len(texts))
        self.assertFalse((self.output / ".unfinished").exists())
        part = read_stl(BRACKET)
        for entry in listed:
            path = self.output / entry["file"]
            self.assertEqual(sha256(path), entry["sha256"])
            self.assertEqual(entry["part_sha256"], sha256(BRACKET))
            mesh = read_stl(path)
            self.assertEqual(surface_faults(mesh), [], entry["file"])
            self.assertEqual(euler(mesh), euler(part))
            report = entry["report"]
            self.assertEqual(len(mesh.triangles), len(part.triangles) + report["triangles_added"])
            # On a plane a label is a prism, 1 mm high.
            self.assertAlmostEqual(volume(mesh) - volume(part), report["label_area"], delta=0.01)

    def test_killed_in_the_middle_and_resumed(self):
        texts = serials(COUNT)
        write_table(self.table, ["text"], [[text] for text in texts])
        begun = time.monotonic()
        process = self.start("--jobs", "2")
        wait_for(lambda: len(files(self.output)) >= COUNT // 2 if self.output.is_dir() else False, process)
        process.send_signal(signal.SIGKILL)
        process.wait()
        seconds = time.monotonic() - begun
        there = {name: (self.output / name).stat() for name in files(self.output)}
        self.assertLess(len(there), COUNT)
        begun = time.monotonic()
        done = run_module(*self.arguments, "--jobs", "2")
        seconds += time.monotonic() - begun
        self.assertEqual(done.returncode, 0, done.stderr)
        kept = int(re.search(r"(\d+) were there", done.stderr).group(1))
        # What was killed between its line and its place is put there, not made again.
        self.assertGreaterEqual(kept, len(there))
        self.assertLessEqual(kept, len(there) + 1)
        for name, stat in there.items():
            now = (self.output / name).stat()
            self.assertEqual((now.st_ino, now.st_mtime_ns), (stat.st_ino, stat.st_mtime_ns))
        self.check_files(texts)
        print(
            f"\n{COUNT} serial numbers in {seconds:.1f} s with the start twice: {COUNT / seconds:.1f}/s by 2 processes"
        )
        print(f"  last run: {done.stderr.strip().splitlines()[-1]}")
        self.compare_with_loading_and_saving()

    def compare_with_loading_and_saving(self, count=50):
        """Time of one process: label on a loaded part, label with loading, loading and saving alone."""
        place = {"position": (0, -20, 8), "direction": (0, 0, 1), "up": (0, 1, 0), "size": 7, "depth": 1}
        output = str(self.folder / "timed.stl")
        part = textlabel.Part(BRACKET)

        def load_and_save():
            meshes = pymeshlab.MeshSet()
            meshes.load_new_mesh(str(BRACKET))
            meshes.save_current_mesh(output)

        works = {
            "load, save": load_and_save,
            "load, label, save": lambda: textlabel.label(BRACKET, "SN-00001", output, **place),
            "label, save (part loaded)": lambda: part.label("SN-00001", output, **place),
        }
        seconds = dict.fromkeys(works, 0.0)
        for turn in range(count + 1):  # in turn, so that a noisy machine hits all alike; the first one warms up
            for name, work in works.items():
                begun = time.process_time()
                work()
                seconds[name] += (time.process_time() - begun) * (turn > 0)
        for name, sum_of_all in seconds.items():
            print(f"  {name}: {1000 * sum_of_all / count:.1f} ms of CPU, one process")
        self.assertLess(seconds["label, save (part loaded)"], seconds["load, label, save"], "loading once saves nothing")

    def test_same_file_as_labelled_alone(self):
        write_table(self.table, ["text"], [[text] for text in serials(5)])
        self.assertEqual(run_module(*self.arguments, "--jobs", "1").returncode, 0)
        alone = self.folder / "alone.stl"
        for text in reversed(serials(5)):
            done = run_module("label", BRACKET, alone, text, *PLACE)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(alone.read_bytes(), (self.output / f"bracket-{text}.stl").read_bytes())

    def test_interrupted_at_the_terminal(self):
        texts = serials(MANY)
        write_table(self.table, ["text"], [[text] for text in texts])
        process = self.start("--jobs", "2")
        wait_for(lambda: self.output.is_dir() and len(files(self.output)) >= 5, process)
        os.killpg(process.pid, signal.SIGINT)
        said = process.stderr.read()
        self.assertEqual(process.wait(), 130, said)
        self.assertIn("same command again", said)
        self.assertNotIn("Traceback", said)
        self.assertEqual(sorted(entry["file"] for entry in entries(self.output)), files(self.output))
        self.assertLess(len(files(self.output)), MANY)
        self.assertEqual(run_module(*self.arguments).returncode, 0)
        self.check_files(texts)

    @unittest.skipUnless(os.path.isdir("/proc/self"), "needs /proc to find the workers")
    def test_a_worker_that_dies_takes_one_row_along(self):
        texts = serials(MANY)
        write_table(self.table, ["text"], [[text] for text in texts])
        process = self.start("--jobs", "2")
        wait_for(lambda: self.output.is_dir() and len(files(self.output)) >= 5, process)
        os.kill(children(process.pid)[0], signal.SIGKILL)
        said = process.stderr.read()
        self.assertEqual(process.wait(), 1, said)
        self.assertIn("ended unexpectedly (status -9)", said)
        self.assertEqual(len(files(self.output)), MANY - 1)
        self.assertTrue((self.output / "failed.csv").exists())
        self.assertEqual(run_module(*self.arguments).returncode, 0)
        self.assertFalse((self.output / "failed.csv").exists())
        self.check_files(texts)

    def test_no_room_for_so_many_processes(self):
        import resource

        texts = serials(MANY)
        write_table(self.table, ["text"], [[text] for text in texts])
        _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        few = functools.partial(resource.setrlimit, resource.RLIMIT_NOFILE, (64, hard))
        done = run_module(*self.arguments, "--jobs", "40", preexec_fn=few)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        self.check_files(texts)

    def test_no_room_for_any_process(self):
        write_table(self.table, ["text"], [[text] for text in serials(3)])
        for what in ("subprocess.Popen", "tempfile.TemporaryFile", "threading.Thread.start"):
            lack = RuntimeError("no room") if "Thread" in what else OSError(24, "no room")
            with self.subTest(what), unittest.mock.patch(f"textlabel.crew.{what}", side_effect=lack):
                said = io.StringIO()
                with contextlib.redirect_stderr(said):
                    status = main([*map(str, self.arguments), "--jobs", "2", "--quiet"])
                self.assertEqual(status, 1, said.getvalue())
                self.assertIn("0 made", said.getvalue())
                self.assertEqual(said.getvalue().count("no room. Take fewer --jobs"), 3)

    @unittest.skipUnless(os.path.isdir("/proc/self"), "needs /proc to find the process")
    def test_a_process_that_ends_before_its_task(self):
        member = crew.Member()
        with unittest.mock.patch("textlabel.crew.sys.executable", shutil.which("false")):
            member.start()
        os.waitid(os.P_PID, children(os.getpid())[0], os.WEXITED | os.WNOWAIT)
        self.assertIn("ended unexpectedly (status 1)", member.do({})["reason"])

    def test_a_process_that_answers_nonsense(self):
        speaker = self.folder / "speaker"
        speaker.write_text("#!/bin/sh\nread task; echo nonsense; cat >/dev/null\n")
        speaker.chmod(0o755)
        with unittest.mock.patch("textlabel.crew.sys.executable", str(speaker)):
            answers = dict(crew.Crew([(key, {}) for key in range(3)], 1).answers())
        self.assertEqual(sorted(answers), list(range(3)))
        for answer in answers.values():
            self.assertIn("unexpected", answer["reason"])

    def test_files_and_manifest_that_came_to_harm(self):
        texts = serials(6)
        write_table(self.table, ["text"], [[text] for text in texts])
        self.assertEqual(run_module(*self.arguments).returncode, 0)
        names = files(self.output)
        whole = (self.output / names[0]).read_bytes()
        (self.output / names[0]).unlink()
        (self.output / names[1]).write_bytes(whole[:1000])
        manifest = self.output / "manifest.jsonl"
        manifest.write_bytes(manifest.read_bytes()[:-40])  # power lost while the last line was written
        (self.output / names[5]).unlink()
        done = run_module(*self.arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("3 made", done.stderr)
        self.assertIn("3 were there", done.stderr)
        self.assertEqual((self.output / names[0]).read_bytes(), whole)
        self.check_files(texts)
        manifest.write_text("nonsense\n" + manifest.read_text())
        done = run_module(*self.arguments)
        self.assertEqual(done.returncode, 2)
        self.assertIn("line 1", done.stderr)

    def test_line_written_but_file_not_moved(self):
        texts = serials(3)
        write_table(self.table, ["text"], [[text] for text in texts])
        self.assertEqual(run_module(*self.arguments).returncode, 0)
        name = files(self.output)[1]
        self.put_back(name)
        done = run_module(*self.arguments)
        self.assertIn("0 made", done.stderr)
        self.check_files(texts)

    def put_back(self, name):
        """As a run leaves it that is killed between a file's line and its move."""
        waiting = self.output / ".unfinished" / name
        waiting.mkdir(parents=True)
        (self.output / name).rename(waiting / name)

    def test_line_written_but_file_not_moved_and_then_other_rows(self):
        texts = serials(4)
        write_table(self.table, ["text"], [[text] for text in texts[:2]])
        self.assertEqual(run_module(*self.arguments).returncode, 0)
        self.put_back("bracket-SN-00001.stl")
        write_table(self.table, ["text"], [[text] for text in texts[2:]])
        self.assertEqual(run_module(*self.arguments).returncode, 0)
        self.assertEqual(len(files(self.output)), 4)
        write_table(self.table, ["text"], [[text] for text in texts])
        done = run_module(*self.arguments)
        self.assertIn("0 made", done.stderr)
        self.assertEqual([entry["file"] for entry in entries(self.output)], files(self.output))


if __name__ == "__main__":
    textlabel.load_plugin()
    unittest.main(verbosity=2)
