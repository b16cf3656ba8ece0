"""The files that labels write beside their mesh, out of sight until all else has succeeded."""

import contextlib
import os
import tempfile

from .plugin import WRITTEN, LabelError


class Aside:
    """Folders for these files, each beside the place of its file. Use it in a with statement, which removes them."""

    def __init__(self, taken):
        """taken: files that none of them may replace, as the output and the drawings that are cut."""
        self._taken = {os.path.realpath(path) for path in taken}
        self._folders = contextlib.ExitStack()
        self._places = {}  # {path written: where it is to be}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._folders.close()

    def put(self, values):
        """A label's parameters with other names for its files; names that cannot be written stay, for the filter to say so.

        Raises LabelError when a file would replace another one of the same call.
        """
        return {name: self._waiting(name, value) if name in WRITTEN else value for name, value in values.items()}

    def _waiting(self, name, path):
        if not isinstance(path, (str, os.PathLike)) or not os.fspath(path).strip():
            return path
        place = os.path.realpath(path)  # of a link, what it names, so that the link stays
        if place in self._taken:
            raise LabelError(f"The {name} would be written over '{os.fspath(path)}'. Give it a name of its own.")
        self._taken.add(place)
        if os.path.exists(place) and not (os.path.isfile(place) and os.access(place, os.W_OK)):
            return path
        try:
            folder = tempfile.TemporaryDirectory(prefix=".textlabel-", dir=os.path.dirname(place))
        except OSError:
            return path
        waiting = os.path.join(self._folders.enter_context(folder), os.path.basename(place))
        self._places[waiting] = place
        return waiting

    def named(self, text):
        """A message with the places' names in it."""
        for waiting, place in self._places.items():
            text = text.replace(waiting, place)
        return text

    def move(self):
        """Put all files that were written in their places."""
        for waiting, place in self._places.items():
            try:
                os.replace(waiting, place)
            except OSError as error:
                raise LabelError(f"'{place}' cannot be written: {error.strerror}. Choose another folder.") from error
