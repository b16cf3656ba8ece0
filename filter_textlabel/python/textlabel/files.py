"""How a mesh comes to its place together with its materials and textures, without harm to other files there.

A mesh is written to a folder of its own first. What else is in that folder then belongs to it, and moves along.
"""

import hashlib
import os
import pathlib
import shutil


class Clash(Exception):
    """What is to be written beside a file is there already, and different; the text says what to do."""


def sha256(path):
    """Of a file's bytes, as hexadecimal text."""
    with open(path, "rb") as file:
        digest = hashlib.sha256()
        while block := file.read(1 << 20):
            digest.update(block)
        return digest.hexdigest()


def font_file(font):
    """The file that a font names, behind which a face or axes may stand, as font.ttc#1; None for a family."""
    font = font.strip()
    while not os.path.isfile(font):
        cut = max(font.rfind(":"), font.rfind("#"))
        if cut < 0:
            return None
        font = font[:cut]
    return font


def refuse_clash(waiting, target, remedy):
    """Raise Clash when moving would change another file's texture. Materials have the file's name in theirs.

    waiting: the mesh in its own folder. target: where it is to be. remedy: the last sentence of the error.
    """
    for written, place in _beside(waiting, target):
        own = place.name.startswith(target.name + ".")
        if not own and place.exists() and not (place.is_file() and sha256(place) == sha256(written)):
            raise Clash(f"Its texture '{written.name}' would replace another one, '{place}'. {remedy}")


def move(waiting, target):
    """Move what belongs to a mesh first, so that the mesh itself says that all is there."""
    for written, place in [*_beside(waiting, target), (waiting, target)]:
        place.parent.mkdir(parents=True, exist_ok=True)
        os.replace(written, place)
    shutil.rmtree(waiting.parent, ignore_errors=True)


def leave_there(waiting, target, names):
    """Do not move those of the named files that the target's folder has: they stay as they are there."""
    for name in names:
        if (target.parent / name).is_file():
            (waiting.parent / name).unlink(missing_ok=True)


def _beside(waiting, target):
    """(path written, path to be) of the materials and textures of a mesh."""
    written = [path for path in waiting.parent.rglob("*") if path.is_file() and path != waiting]
    return [(path, target.parent / path.relative_to(waiting.parent)) for path in written]
