"""A bar that tells how far a long run is; on a terminal it moves, in a log it is a line now and then."""

import sys
import time

BAR = 30  # characters
REDRAW, LOG = 0.1, 10.0  # seconds


class Progress:
    """Counts from what was there already to a total."""

    def __init__(self, total, already=0, quiet=False, stream=None):
        self._stream = stream or sys.stderr
        self._moves = self._stream.isatty()
        self._quiet = quiet
        self._total, self._already = total, already
        self.done = self.failed = 0
        self._start = time.monotonic()
        self._next = self._start + (0 if self._moves else LOG)
        self._show()

    def step(self, succeeded):
        """One more task has ended."""
        self.done += succeeded
        self.failed += not succeeded
        self._show()

    def finish(self):
        """The last line stays."""
        self._next = 0
        self._show("\n")

    def rate(self):
        """Files per second."""
        return self.done / max(time.monotonic() - self._start, 1e-9)

    def _show(self, ending=""):
        now = time.monotonic()
        if self._quiet or now < self._next:
            return
        self._next = now + (REDRAW if self._moves else LOG)
        if self._moves:
            self._stream.write(f"\r\033[K{self._line()}{ending}")
        else:
            self._stream.write(f"{self._line()}\n")
        self._stream.flush()

    def _line(self):
        ended = self._already + self.done + self.failed
        share = ended / self._total if self._total else 1
        full = int(share * BAR)
        parts = [f"[{'#' * full}{'-' * (BAR - full)}] {ended}/{self._total}", f"{share:4.0%}"]
        if self.done:
            parts.append(f"{self.rate():.1f}/s")
        if self.done and ended < self._total:
            left = round((self._total - ended) / self.rate())
            parts.append(f"{left // 60}:{left % 60:02} left")
        if self.failed:
            parts.append(f"{self.failed} failed")
        return "  ".join(parts)
