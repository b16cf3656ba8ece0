"""For the tests in Python: the real PyMeshLab or a visible skip, STL files as welded meshes, and their faults."""

import base64
import collections
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile
import zlib

SOURCE = pathlib.Path(os.environ.get("TEXTLABEL_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[1]))
PLUGIN = os.environ.get("TEXTLABEL_PYMESHLAB_PLUGIN", "")
MESHES = SOURCE / "meshes"
PACKAGE = SOURCE / "filter_textlabel" / "python"
SKIPPED = 77

sys.path.insert(0, str(PACKAGE))
sys.dont_write_bytecode = True
try:
    import numpy as np
    import pymeshlab
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(SKIPPED)
if not os.path.exists(PLUGIN):
    print("skipped: TEXTLABEL_PYMESHLAB_PLUGIN names no plugin")
    sys.exit(SKIPPED)

Mesh = collections.namedtuple("Mesh", "points triangles")  # #V by 3 float32, #F by 3 indices


def read_stl(path):
    """A binary STL file with equal corners merged."""
    data = pathlib.Path(path).read_bytes()
    count = int.from_bytes(data[80:84], "little")
    assert len(data) == 84 + 50 * count, f"{path} has {len(data)} bytes for {count} triangles"
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    corners = np.frombuffer(data, record, count, 84)["corners"].reshape(-1, 3) + np.float32(0)  # -0 is 0
    points, index = np.unique(corners, axis=0, return_inverse=True)
    return Mesh(points, index.reshape(-1, 3))


def volume(mesh):
    """By the divergence theorem."""
    a, b, c = (mesh.points[mesh.triangles[:, k]].astype(float) for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def sides(mesh):
    """The sides of all triangles as numbers, and the same sides run along the other way."""
    t = mesh.triangles.astype(np.int64)
    start, end = t.ravel(), np.roll(t, -1, axis=1).ravel()
    return start * len(mesh.points) + end, end * len(mesh.points) + start


def surface_faults(mesh, borders=0):
    """What keeps a mesh from being an oriented manifold with so many border edges; [] when nothing does."""
    along, back = sides(mesh)
    faults = []
    if (mesh.triangles == np.roll(mesh.triangles, 1, axis=1)).any():
        faults.append("a triangle with two equal corners")
    if len(np.unique(along)) < len(along):
        faults.append("a side that two triangles run along in the same direction")
    open_sides = int((~np.isin(back, along)).sum())
    if open_sides != borders:
        faults.append(f"{open_sides} border edges instead of {borders}")
    return faults


def euler(mesh):
    """Vertices - edges + triangles."""
    along, back = sides(mesh)
    return len(mesh.points) - len(np.unique(np.minimum(along, back))) + len(mesh.triangles)


QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
BOX_TRIANGLES = [(a, b, c) for a, b, c, _ in QUADS] + [(a, c, d) for a, _, c, d in QUADS]


def box_points(x, y, z, start=(0, 0, 0)):
    """Corners of a box; BOX_TRIANGLES are its triangles."""
    return [tuple(map(sum, zip(start, (a, b, c)))) for c in (0, z) for b in (0, y) for a in (0, x)]


def write_textured_box(folder, texture="skin.png", shade=200):
    """box.obj, 60 x 40 x 10, in a new folder, its material, and the texture beside it: 2 x 2 pixels of one grey."""
    folder.mkdir(parents=True)
    x, y, z = 60, 40, 10
    points = box_points(x, y, z)
    lines = ["mtllib box.mtl"]
    lines += ["v {} {} {}".format(*point) for point in points]
    lines += [f"vt {a / x} {b / y}" for a, b, _ in points]
    lines += ["usemtl skin"]
    lines += ["f " + " ".join(f"{corner + 1}/{corner + 1}" for corner in triangle) for triangle in BOX_TRIANGLES]
    (folder / "box.obj").write_text("\n".join(lines) + "\n")
    (folder / "box.mtl").write_text(f"newmtl skin\nKd 1 1 1\nmap_Kd {texture}\n")
    path = folder / texture
    path.parent.mkdir(parents=True, exist_ok=True)
    pixels = zlib.compress(bytes([0, shade, shade] * 2))
    chunks = {b"IHDR": struct.pack(">IIBBBBB", 2, 2, 8, 0, 0, 0, 0), b"IDAT": pixels}
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for name, data in [*chunks.items(), (b"IEND", b"")]:
            file.write(struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)))
    return folder / "box.obj"


def write_gltf(path, objects):
    """One node for each object: its points and a matrix, column by column, as glTF has it."""
    data, views, accessors = b"", [], []
    for points, _ in objects:
        for array in (np.array(points, "<f4"), np.array(BOX_TRIANGLES, "<u2").ravel()):
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
            data += array.tobytes()
        view = len(views)
        low, high = np.min(points, axis=0).tolist(), np.max(points, axis=0).tolist()
        accessors += [
            {"bufferView": view - 2, "componentType": 5126, "count": 8, "type": "VEC3", "min": low, "max": high},
            {"bufferView": view - 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ]
    counted = list(enumerate(objects))
    content = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [i for i, _ in counted]}],
        "nodes": [{"mesh": i, "matrix": matrix} for i, (_, matrix) in counted],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 2 * i}, "indices": 2 * i + 1}]} for i, _ in counted],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [
            {"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}
        ],
    }
    path.write_text(json.dumps(content))


def write_3mf(path, objects, unit="millimeter"):
    """One item for each object: its points and a matrix as 3MF has it, 12 numbers."""
    namespace = "http://schemas.openxmlformats.org/package/2006"
    model = "http://schemas.microsoft.com/3dmanufacturing"
    triangles = "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*triangle) for triangle in BOX_TRIANGLES)
    resources = items = ""
    for number, (points, matrix) in enumerate(objects, 1):
        vertices = "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*point) for point in points)
        mesh = f"<mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh>"
        resources += f'<object id="{number}" type="model">{mesh}</object>'
        items += f'<item objectid="{number}" transform="{matrix}"/>'
    with zipfile.ZipFile(path, "w") as package:
        package.writestr(
            "[Content_Types].xml",
            f'<?xml version="1.0" encoding="UTF-8"?><Types xmlns="{namespace}/content-types">'
            '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
            '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>',
        )
        package.writestr(
            "_rels/.rels",
            f'<?xml version="1.0" encoding="UTF-8"?><Relationships xmlns="{namespace}/relationships">'
            f'<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="{model}/2013/01/3dmodel"/></Relationships>',
        )
        package.writestr(
            "3D/3dmodel.model",
            f'<?xml version="1.0" encoding="UTF-8"?><model unit="{unit}" xml:lang="en-US" '
            f'xmlns="{model}/core/2015/02"><resources>{resources}</resources><build>{items}</build></model>',
        )


def run_module(*arguments, **options):
    """python -m textlabel ARGUMENTS, to its end."""
    return subprocess.run(command(*arguments), env=environment(), capture_output=True, text=True, **options)


def command(*arguments):
    return [sys.executable, "-m", "textlabel", *map(str, arguments)]


def environment():
    return {**os.environ, "PYTHONPATH": str(PACKAGE), "PYTHONDONTWRITEBYTECODE": "1"}


class InFolder(unittest.TestCase):
    """Tests with a folder of their own, self.folder."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
