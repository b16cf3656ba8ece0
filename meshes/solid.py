"""What the parts of this folder are made with: profiles of lines and arcs, sweeps of them, and a checked STL writer.

Units are millimetres. Booleans are Manifold's (manifold3d); everything else is here. Install with
    pip install -r meshes/requirements.txt
and regenerate a part with
    python3 meshes/bracket.py
which writes meshes/bracket.stl. The same versions on the same kind of machine write the same bytes.
"""

import math
import os

import numpy as np
from manifold3d import Manifold, Mesh64, OpType, triangulate

STEP = math.radians(7.5)  # a full circle has 48 segments unless a part says otherwise


class Profile:
    """A closed plane path of lines and tangent arcs, counter-clockwise.

    It can be offset without changing its number of points: each corner is an arc whose radius grows or shrinks.
    """

    def __init__(self, arcs):
        """arcs: (center x, center y, radius, +1 convex or -1 concave, angles of the outward normal)"""
        self.arcs = []
        for k, (x, y, r, side, angles) in enumerate(arcs):
            nx, ny, nr, nside, nangles = arcs[(k + 1) % len(arcs)]
            end = np.array([x + side * r * math.cos(angles[-1]), y + side * r * math.sin(angles[-1])])
            start = np.array([nx + nside * nr * math.cos(nangles[0]), ny + nside * nr * math.sin(nangles[0])])
            assert (
                len(arcs) == 1 or (start - end) @ (-math.sin(nangles[0]), math.cos(nangles[0])) > -1e-9
            ), "arcs overlap"
            joined = len(arcs) > 1 and np.linalg.norm(end - start) < 1e-9  # two arcs without a line between them
            self.arcs.append((x, y, r, side, angles[:-1] if joined else angles))

    @staticmethod
    def polygon(corners, step=STEP):
        """Corners (x, y, radius), counter-clockwise; radius > 0."""
        arcs = []
        for i, (x, y, r) in enumerate(corners):
            p = np.array([x, y])
            a, b = np.array(corners[i - 1][:2]), np.array(corners[(i + 1) % len(corners)][:2])
            u, v = (p - a) / np.linalg.norm(p - a), (b - p) / np.linalg.norm(b - p)
            turn = math.atan2(u[0] * v[1] - u[1] * v[0], u @ v)
            side = 1 if turn > 0 else -1
            start = math.atan2(-u[0], u[1])  # direction of the outward normal before the corner
            tangent = r * math.tan(abs(turn) / 2)
            center = p - u * tangent - side * r * np.array([math.cos(start), math.sin(start)])
            n = max(1, round(abs(turn) / step))
            arcs.append((*center, r, side, [start + turn * k / n for k in range(n + 1)]))
        return Profile(arcs)

    @staticmethod
    def rectangle(width, depth, radius, center=(0, 0), step=STEP):
        w, d, (x, y) = width / 2, depth / 2, center
        return Profile.polygon([(x + i * w, y + j * d, radius) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))], step)

    @staticmethod
    def circle(radius, center=(0, 0), step=STEP):
        n = 4 * round(math.pi / 2 / step)
        return Profile([(*center, radius, 1, [2 * math.pi * k / n for k in range(n)])])

    @staticmethod
    def slot(length, width, center=(0, 0), angle=0, step=STEP):
        """A slot with round ends; length over all."""
        h, n = (length - width) / 2, max(2, round(math.pi / step))
        ends = []
        for sign, base in ((1, angle - math.pi / 2), (-1, angle + math.pi / 2)):
            c = (center[0] + sign * h * math.cos(angle), center[1] + sign * h * math.sin(angle))
            ends.append((*c, width / 2, 1, [base + math.pi * k / n for k in range(n + 1)]))
        return Profile(ends)

    def points(self, offset=0.0):
        """#P by 2, moved outwards by offset."""
        rows = []
        for x, y, r, side, angles in self.arcs:
            radius = r + side * offset
            assert radius > 0, f"offset {offset} closes an arc of radius {r}"
            rows += [(x + side * radius * math.cos(a), y + side * radius * math.sin(a)) for a in angles]
        return np.array(rows)


def arc(center, radius, start, end, steps):
    """Points (offset, height) on an arc of a sweep's side, angles in degrees."""
    angles = np.radians(np.linspace(start, end, steps + 1))
    return [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a)) for a in angles]


def round_top(height, radius, steps):
    """The end of a sweep's side: a convex fillet up to the height."""
    return arc((-radius, height - radius), radius, 0, 90, steps)


def round_bottom(height, radius, steps):
    return arc((-radius, height + radius), radius, -90, 0, steps)


def flare(height, radius, steps, inside=0.05, sink=1.0):
    """The foot of a sweep's side: a concave fillet onto a plane at the height.

    It ends a little inside the side that it fills, so that the surfaces cross instead of touching, and goes on below
    the plane.
    """
    foot = [(d - inside, z) for d, z in arc((radius, height + radius), radius, 270, 180, steps)]
    return [(foot[0][0], height - sink)] + foot


def sweep(profile, side):
    """The solid whose section at each height is the profile, offset: side = [(offset, height), ...], from below."""
    rings = [np.column_stack([profile.points(d), np.full(sum(len(a[4]) for a in profile.arcs), z)]) for d, z in side]
    n = len(rings[0])
    vertices = np.vstack(rings)
    faces = []
    for k in range(len(rings) - 1):
        for i in range(n):
            a, b = k * n + i, k * n + (i + 1) % n
            faces += [(a, b, b + n), (a, b + n, a + n)]
    last = n * (len(rings) - 1)
    faces += [(a, c, b) for a, b, c in triangulate([rings[0][:, :2]])]
    faces += [(a + last, b + last, c + last) for a, b, c in triangulate([rings[-1][:, :2]])]
    return solid(vertices, faces)


def prism(profile, bottom, top):
    return sweep(profile, [(0, bottom), (0, top)])


def revolve(side, step=STEP):
    """The solid of revolution about z: side = [(radius, height), ...], closed along the axis, from below."""
    axis = Profile.circle(1.0, step=step)
    return sweep(axis, [(r - 1.0, z) for r, z in side])


def solid(vertices, faces):
    mesh = Mesh64(np.asarray(vertices, np.float64), np.asarray(faces, np.uint64))
    result = Manifold(mesh)
    assert not result.is_empty() and result.volume() > 0, result.status()
    return result


def along_y(m):
    """Turn a sweep along z into one along y: x stays, the profile's y becomes z, the sweep runs towards -y."""
    return m.rotate((90, 0, 0))


def along_x(m):
    """Turn a sweep along z into one along x: the profile's x becomes y, its y becomes z."""
    return m.rotate((90, 0, 90))


def union(*parts):
    return Manifold.batch_boolean(list(parts), OpType.Add)


def place(m, *points):
    """Copies of a solid, moved to the points, as one."""
    return union(*[m.translate(p if len(p) == 3 else (*p, 0)) for p in points])


def triangles_of(m):
    """Vertices #V by 3 as an STL file holds them (float32, equal ones merged) and faces #F by 3."""
    mesh = m.to_mesh64()
    points, index = np.unique(np.asarray(mesh.vert_properties)[:, :3].astype(np.float32), axis=0, return_inverse=True)
    return points, index.reshape(-1)[np.asarray(mesh.tri_verts, np.int64)]


def check(points, faces, closed=True):
    """Refuse a mesh that is no oriented manifold or has slivers; returns the height of the thinnest triangle, ulps."""
    corners = points[faces].astype(np.float64)
    edges = np.roll(corners, -1, 1) - corners
    area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    thinnest = (area / np.linalg.norm(edges, axis=2).max(1)).min() / np.spacing(np.abs(points).max())
    assert thinnest > 4, f"a triangle only {thinnest:.2f} ulps high"
    half = np.vstack([faces[:, [k, (k + 1) % 3]] for k in range(3)])
    code = half[:, 0] * len(points) + half[:, 1]
    assert len(np.unique(code)) == len(code), "an edge that two faces run through in the same direction"
    assert not closed or np.array_equal(np.sort(code), np.sort(half[:, 1] * len(points) + half[:, 0])), "an open edge"
    return thinnest


def write_stl(source, points, faces, closed=True):
    """Write NAME.stl beside the source NAME.py, after checking what a reader of the file will see."""
    thinnest = check(points, faces, closed)
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(np.float64)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    rows = np.zeros(len(faces), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    rows["normal"], rows["corners"] = normals, corners
    name = os.path.splitext(os.path.basename(source))[0]
    with open(os.path.splitext(os.path.abspath(source))[0] + ".stl", "wb") as file:
        file.write(
            f"TextLabel {name}, millimetres".encode().ljust(80) + len(faces).to_bytes(4, "little") + rows.tobytes()
        )
    volume = (
        np.einsum("ij,ij->i", corners[:, 0].astype(float), np.cross(corners[:, 1].astype(float), corners[:, 2])).sum()
        / 6
    )
    print(
        f"{name}: {len(faces)} triangles, {len(points)} vertices, volume {volume:.3f}, size {np.ptp(points, axis=0)}, "
        f"thinnest triangle {thinnest:.0f} ulps"
    )
