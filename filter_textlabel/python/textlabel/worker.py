"""A process that labels: tasks come in as lines of JSON, answers go out as lines of JSON.

The part that was labelled last stays loaded. Start: python -m textlabel.worker (crew.py does it).
"""

import json
import os
import sys

from . import plugin
from .files import sha256
from .part import Part


class _Bench:
    """The part at hand."""

    def __init__(self):
        self._part = None

    def make(self, task):
        """Label one task's part; the answer, as it is sent."""
        try:
            if self._part is None or self._part.path != task["part"]:
                self._part = Part(task["part"])
            first, *also = map(_values, task["labels"])
            os.makedirs(os.path.dirname(task["output"]), exist_ok=True)
            report = self._part.label(first.pop("text"), task["output"], also, **first)
            return {"report": report, "sha256": sha256(task["output"])}
        except plugin.LabelError as error:
            return {"reason": str(error)}


def _values(label):
    """Text and parameters of a label."""
    values = {name: plugin.parse_value(name, text) for name, text in label["settings"].items()}
    return {**values, "text": label["text"]}


def main():
    """Serve until the input ends."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # what MeshLab prints is no answer
    bench = _Bench()
    for line in sys.stdin.buffer:
        try:
            answer = bench.make(json.loads(line))
        except Exception as error:
            bench = _Bench()
            answer = {
                "reason": f"Something unexpected happened: {error!r}. Other rows are not affected; "
                "try this one alone, by python -m textlabel label."
            }
        answers.write(json.dumps(answer) + "\n")
        answers.flush()


if __name__ == "__main__":
    main()
