"""Several worker processes at once. One that dies takes only its own task along; another takes its place."""

import json
import os
import pathlib
import queue
import subprocess
import sys
import tempfile
import threading


class _Member:
    """One worker process, started when it gets its first task."""

    def __init__(self, held):
        self._process = None
        self._held = held

    def do(self, task):
        """The answer to a task: {"report", "sha256"} or {"reason"}."""
        if self._process is None:
            self._start()
        try:
            self._process.stdin.write(json.dumps(task).encode() + b"\n")
            self._process.stdin.flush()
            line = self._process.stdout.readline()
        except OSError:
            line = b""
        return json.loads(line) if line.endswith(b"\n") else {"reason": self._bury()}

    def _start(self):
        package = pathlib.Path(__file__).resolve().parent
        paths = [str(package.parent), os.environ.get("PYTHONPATH")]
        self._log = tempfile.TemporaryFile()
        self._process = subprocess.Popen(
            [sys.executable, "-m", f"{package.name}.worker"],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._log,
            pass_fds=self._held,
            start_new_session=True,  # an interrupt at the terminal is for us: we decide what is still finished
            creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),  # the same on Windows
        )

    def _bury(self):
        """Why the process is gone."""
        self.stop()
        self._log.seek(0)
        said = [line for line in self._log.read()[-4096:].decode(errors="replace").splitlines() if line.strip()]
        self._log.close()
        ending = f": {said[-1]}" if said else ""
        return f"The process that made it ended unexpectedly (status {self._status}){ending}. Try this row alone."

    def stop(self):
        """Let the process end after its task."""
        if self._process is not None:
            self._process.stdin.close()
            self._process.stdout.close()
            self._status = self._process.wait()
            self._process = None


class Crew:
    """Threads that hand out tasks, each to a process of its own."""

    def __init__(self, tasks, size, held=()):
        """tasks: [(key, task for worker.py)], begun in this order. held: descriptors that the processes keep open."""
        self._held = held
        self._open = queue.SimpleQueue()
        for item in tasks:
            self._open.put(item)
        self._answers = queue.SimpleQueue()
        self._stopping = threading.Event()
        self._running = min(size, len(tasks))
        for _ in range(self._running):
            threading.Thread(target=self._work, daemon=True).start()

    def _work(self):
        member = _Member(self._held)
        try:
            while not self._stopping.is_set():
                key, task = self._open.get_nowait()
                self._answers.put((key, member.do(task)))
        except queue.Empty:
            pass
        finally:
            self._answers.put(None)
            member.stop()

    def answers(self):
        """(key, answer) as they come; ends when all is done, or all that was begun after stop()."""
        while self._running:
            answer = self._answers.get()
            if answer is None:
                self._running -= 1
            else:
                yield answer

    def stop(self):
        """Begin no more tasks."""
        self._stopping.set()
