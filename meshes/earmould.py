"""earmould.stl: the shell of a hearing aid for one ear, after the paper's figure 10 (protruding on curvature).

An organic closed surface: bowl, helix lock and bent canal, melted into each other, with a vent drilled through (genus
1). 28 x 28 x 28 mm, 10,502 triangles (the paper's part: 10,503). It is the zero level of a function, meshed by
Manifold, relaxed on the surface and thinned by MeshLab. The label goes on the outer face, which is curved everywhere.
Regenerate: python3 meshes/earmould.py (takes a minute or two)
"""

import numpy as np
import pymeshlab
from manifold3d import Manifold

from solid import triangles_of, write_stl

EDGE = 0.66  # of the level-set grid
TARGET = 10503  # triangles
BOUNDS = (-20, -18, -28, 20, 22, 12)


def smooth_min(a, b, width):
    h = np.maximum(width - np.abs(a - b), 0) / width
    return np.minimum(a, b) - h * h * width / 4


def capsule(p, a, b, ra, rb):
    """Distance to a rod from a to b, its radius growing evenly from ra to rb."""
    a, b = np.array(a, float), np.array(b, float)
    t = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    return np.linalg.norm(p - a - t[..., None] * (b - a), axis=-1) - (ra + (rb - ra) * t)


def ellipsoid(p, center, radii):
    q = (p - np.array(center)) / np.array(radii)
    k = np.linalg.norm(q, axis=-1)
    return (k - 1) * min(radii) * 0.7 + 0.3 * (k - 1) * max(radii)


def shape(p):
    """Negative inside, millimetres near the surface; p is #P by 3."""
    bowl = ellipsoid(p, (0, 0, 0), (13.5, 10.5, 6.5))
    lock = capsule(p, (7, 5, -0.5), (10.5, 14, -2.5), 4.2, 2.3)
    heel = capsule(p, (-6, -5, -1), (-10, -6, -1.5), 5.5, 4.5)
    canal = smooth_min(
        capsule(p, (-5, -2, -2), (-5.5, -1, -11), 6.5, 5), capsule(p, (-5.5, -1, -11), (-3, 2.5, -20), 5, 4.4), 1
    )
    body = smooth_min(smooth_min(bowl, lock, 4), smooth_min(heel, canal, 4), 5)
    face = np.linalg.norm(p - np.array([1.5, 1, -27]), axis=-1) - 31.5
    body = -smooth_min(-body, -face, 3)
    vent = np.minimum(
        capsule(p, (-9.5, -4.5, 9), (-6, -2, -9), 1.7, 1.7), capsule(p, (-6, -2, -9), (-1.2, 5, -27), 1.7, 1.5)
    )
    return -smooth_min(-body, vent, 3)


def gradient(p, h=1e-4):
    return np.stack([(shape(p + h * e) - shape(p - h * e)) / (2 * h) for e in np.eye(3)], axis=-1)


def relax(points, faces, rounds=30):
    """Move the vertices along the surface towards the middle of their neighbours, then back onto it."""
    a = np.concatenate([faces[:, 0], faces[:, 1], faces[:, 2]])
    b = np.concatenate([faces[:, 1], faces[:, 2], faces[:, 0]])
    valence = np.bincount(a, minlength=len(points))[:, None]
    for _ in range(rounds):
        mean = np.stack([np.bincount(a, points[b, k], len(points)) for k in range(3)], axis=-1) / valence
        normal = gradient(points)
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        move = 0.5 * (mean - points)
        points = points + move - (move * normal).sum(1)[:, None] * normal
        for _ in range(3):
            g = gradient(points)
            points = points - (shape(points) / (g * g).sum(1))[:, None] * g
    return points


def decimate(points, faces):
    """MeshLab's quadric edge collapse: coarse where the surface is even, fine at the vent's rims."""
    layers = pymeshlab.MeshSet(verbose=False)
    layers.add_mesh(pymeshlab.Mesh(points, faces))
    layers.meshing_decimation_quadric_edge_collapse(
        targetfacenum=TARGET,
        qualitythr=1.0,
        preservetopology=True,
        preservenormal=True,
        optimalplacement=True,
        planarquadric=True,
        planarweight=0.001,
    )
    return layers.current_mesh().vertex_matrix(), layers.current_mesh().face_matrix()


if __name__ == "__main__":
    level = Manifold.level_set(lambda x, y, z: -float(shape(np.array([[x, y, z]]))[0]), BOUNDS, EDGE)
    vertices, triangles = triangles_of(level)
    vertices, triangles = decimate(relax(vertices.astype(float), triangles), triangles)
    write_stl(__file__, vertices.astype(np.float32), triangles)
