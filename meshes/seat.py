"""seat.stl: the moulded shell of a chair, 1:5, after the paper's figure 11 (indented in front, protruding behind).

One open surface without thickness: a back that wraps round the sitter, a dished seat, a rolled front edge, rounded
corners. 94 x 115 x 104 mm, 8,052 triangles, one border. The label goes on the middle of the back, seen from the front.
Regenerate: python3 meshes/seat.py
"""

import math

import numpy as np

from solid import write_stl

ROWS, COLUMNS = 66, 61  # of cells: 2 x 66 x 61 = 8,052 triangles
LENGTH = 180.0  # of the middle line from the top of the back to the front edge


def smooth_step(x):
    x = np.clip(x, 0, 1)
    return x * x * x * (10 - 15 * x + 6 * x * x)


def middle_line(count=4000):
    """Points (y, z) of the middle line and the angle of its direction, by its length from 0 to 1; y is forwards."""
    s = np.linspace(0, 1, count + 1)
    angle = math.radians(74) * (smooth_step((s - 0.36) / 0.24) - 1)  # down the back, then into the seat
    angle += (
        math.radians(10) * np.sin(np.pi * np.clip(s / 0.40, 0, 1)) * np.cos(np.pi * np.clip(s / 0.40, 0, 1))
    )  # small of the back
    angle -= math.radians(48) * smooth_step((s - 0.80) / 0.22) + math.radians(4) * smooth_step(
        (s - 0.4) / 0.2
    )  # the front edge
    middle = (angle[1:] + angle[:-1]) / 2
    y, z = (np.concatenate([[0], np.cumsum(f(middle)) * LENGTH / count]) for f in (np.cos, np.sin))
    return s, y, z, angle


def surface(u, t):
    """Points of the shell for u across (-1 to 1) and t along (0 at the top of the back, 1 at the front edge)."""
    s, y, z, angle = middle_line()
    a = np.interp(t, s, angle)
    half = 41 + 6 * smooth_step((t - 0.15) / 0.5)
    lift = 13 * (1 - smooth_step((t - 0.25) / 0.35)) + 6.5 * smooth_step((t - 0.3) / 0.3) * (
        1 - smooth_step((t - 0.72) / 0.28)
    )
    lift = lift * (np.abs(u) ** 2.6)
    return np.stack([half * u, np.interp(t, s, y) - lift * np.sin(a), np.interp(t, s, z) + lift * np.cos(a)], axis=-1)


def rounded(u, v, power=4.5):
    """Map the square onto one with rounded corners: rays keep their direction, rings become superellipses outwards."""
    ring = np.maximum(np.abs(u), np.abs(v))
    reach = (np.abs(u) ** power + np.abs(v) ** power) ** (1 / power)
    shrink = np.where(reach > 0, ring / np.where(reach > 0, reach, 1), 1)
    blend = ring**2
    scale = 1 + blend * (shrink - 1)
    return u * scale, v * scale


if __name__ == "__main__":
    v, u = np.meshgrid(np.linspace(-1, 1, ROWS + 1), np.linspace(-1, 1, COLUMNS + 1), indexing="ij")
    u, v = rounded(u, v)
    points = surface(u, (v + 1) / 2).reshape(-1, 3)
    points -= [0, points[:, 1].mean(), points[:, 2].min()]
    index = np.arange((ROWS + 1) * (COLUMNS + 1)).reshape(ROWS + 1, COLUMNS + 1)
    a, b, c, d = index[:-1, :-1].ravel(), index[:-1, 1:].ravel(), index[1:, 1:].ravel(), index[1:, :-1].ravel()
    shorter = np.linalg.norm(points[a] - points[c], axis=1) <= np.linalg.norm(points[b] - points[d], axis=1)
    one = np.where(shorter[:, None], np.stack([a, b, c], 1), np.stack([a, b, d], 1))
    two = np.where(shorter[:, None], np.stack([a, c, d], 1), np.stack([b, c, d], 1))
    write_stl(__file__, points.astype(np.float32), np.concatenate([one, two]), closed=False)
