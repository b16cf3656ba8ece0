"""Several worker processes at once. One that dies takes only its own task along; another takes its place.

Every task is answered, unless stop() comes first: where the system has no room for as many processes, fewer do all.
"""

import contextlib
import json
import os
import pathlib
import queue
import subprocess
import sys
import tempfile
import threading


class Member:
    """One worker process, started when it gets its first task."""

    def __init__(self, held=()):
        self._process = None
        self._held = held

    def do(self, task):
        """The answer to a task: {"report", "sha256"} or {"reason"}. start() comes first."""
        try:
            self._process.stdin.write(json.dumps(task).encode() + b"\n")
            self._process.stdin.flush()
            line = self._process.stdout.readline()
        except OSError:
            line = b""
        return json.loads(line) if line.endswith(b"\n") else {"reason": self._bury()}

    def start(self):
        """Have a process. Raises OSError when the system has no room for one."""
        if self._process is not None:
            return
        package = pathlib.Path(__file__).resolve().parent
        paths = [str(package.parent), os.environ.get("PYTHONPATH")]
        with contextlib.ExitStack() as undo:
            self._log = undo.enter_context(tempfile.TemporaryFile())
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
            undo.pop_all()

    def _bury(self):
        """Why the process is gone."""
        status = self._end()
        self._log.seek(0)
        said = [line for line in self._log.read()[-4096:].decode(errors="replace").splitlines() if line.strip()]
        self._log.close()
        ending = f": {said[-1]}" if said else ""
        return f"The process that made it ended unexpectedly (status {status}){ending}. Try this row alone."

    def stop(self):
        """Let the process end after its task."""
        if self._process is not None:
            self._end()
            self._log.close()

    def _end(self):
        with contextlib.suppress(OSError):  # it died with a task on its way
            self._process.stdin.close()
        self._process.stdout.close()
        status = self._process.wait()
        self._process = None
        return status


class Crew:
    """Threads that hand out tasks, each to a process of its own."""

    def __init__(self, tasks, size, held=()):
        """tasks: [(key, task for worker.py)], begun in this order. held: descriptors that the processes keep open."""
        self._held = held
        self._open = queue.SimpleQueue()
        for item in tasks:
            self._open.put(item)
        self._unanswered = dict.fromkeys(key for key, _ in tasks)
        self._answers = queue.SimpleQueue()
        self._stopping = threading.Event()
        self._lack = "All of them ended"  # why no process is left
        self._running = 0
        for _ in range(min(size, len(tasks))):
            try:
                threading.Thread(target=self._work, daemon=True).start()
            except RuntimeError as error:  # "can't start new thread"
                self._lack = error
                break
            self._running += 1

    def _work(self):
        member = Member(self._held)
        try:
            while not self._stopping.is_set():
                item = self._open.get_nowait()
                try:
                    member.start()
                except Exception as error:
                    self._lack = error
                    self._open.put(item)  # for those who have a process
                    break
                self._answers.put((item[0], _done(member, item[1])))
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
                del self._unanswered[answer[0]]
                yield answer
        if not self._stopping.is_set():
            for key in self._unanswered:
                yield key, {"reason": f"There was no process for it: {self._lack}. Take fewer --jobs, or mend that."}

    def stop(self):
        """Begin no more tasks."""
        self._stopping.set()


def _done(member, task):
    """The answer to a task, whatever happens."""
    try:
        return member.do(task)
    except Exception as error:
        member.stop()  # what it says next may be about this task still
        return {"reason": f"Something unexpected happened: {error!r}. Try this row alone."}
