"""bracket.stl: a pedestal bearing bracket, after the CAD part of the paper's figure 7 ("A43" protruding).

An arched upright with a bearing seat stands on a plate with four counterbored holes; ribs to both sides, a lubrication
boss on the arch. 110 x 64 x 82 mm, 8,220 triangles (the paper's part: 8,260). The label goes on the plate, before the
upright.
Regenerate: python3 meshes/bracket.py
"""

import math

from solid import *

AXIS = 52.0  # height of the bearing's axis above the table
FINE = math.radians(7.5)


def plate():
    body = sweep(Profile.rectangle(110, 64, 12, (0, -2), FINE), round_bottom(0, 0.8, 2) + round_top(8, 1.6, 4))
    hole = union(
        prism(Profile.circle(3.3, step=math.radians(10)), -1, 9),
        sweep(Profile.circle(5.5, step=math.radians(10)), [(0, 3.6), (0, 7.4), (1.2, 8.6)]),
    )
    # Relieved below, so that it stands on its rim.
    pocket = sweep(
        Profile.rectangle(66, 40, 8, (0, -2), FINE), [(0.5, -0.5), (-0.5, 0.5), (-0.5, 1.5)] + round_top(2.5, 1, 4)[1:]
    )
    return body - place(hole, (-42, -22), (42, -22), (-42, 22), (42, 22)) - pocket


def upright():
    """From y = -1 (front) to y = 17 (back)."""
    arch = Profile.polygon([(-26, 3, 2.5), (26, 3, 2.5), (26, AXIS + 26, 26), (-26, AXIS + 26, 26)], FINE)
    foot = sweep(Profile.rectangle(52, 18, 2.5, (0, 8), FINE), flare(8, 6, 6))
    return along_y(sweep(arch, round_bottom(-17, 2, 4) + round_top(1, 2, 4))) + foot


def ribs():
    right = Profile.polygon(
        [(16, 4, 1.5), (51, 4, 1.5), (51, 10.6, 1.6), (32, 15.5, 26), (19, 45, 1.5), (16, 45, 1.5)], FINE
    )
    rib = along_y(sweep(right, round_bottom(-11.2, 1.2, 3) + round_top(-4.8, 1.2, 3)))
    return rib + rib.mirror((1, 0, 0))


def seat():
    """The bearing's ring on the front, along the axis; the sweep's heights are -y."""
    ring = sweep(Profile.circle(21.5, step=FINE), flare(1, 2, 4, inside=0) + round_top(8, 1.2, 4))
    return along_y(ring).translate((0, 0, AXIS))


def bore():
    """What is drilled along the axis: hole, bearing seat from the front, circlip groove, holes for a cover behind."""
    through = sweep(Profile.circle(12, step=FINE), [(1.5, -17.5), (0, -16), (0, 9)])
    bearing = sweep(Profile.circle(15.5, step=FINE), [(0, -6), (0, 7.2), (1.6, 8.8)])
    groove = prism(Profile.circle(16.6, step=FINE), 4, 5.3)
    cover = sweep(Profile.circle(2, step=math.radians(15)), [(0.8, -17.4), (0, -16.6), (0, -8)])
    covers = union(
        *[cover.translate((18.5 * math.cos(a), 18.5 * math.sin(a), 0)) for a in np.radians([45, 135, 225, 315])]
    )
    return along_y(union(through, bearing, groove, covers)).translate((0, 0, AXIS))


def bracket():
    nipple = sweep(Profile.circle(6, (0, 8), step=FINE), [(0, 70)] + round_top(AXIS + 30, 1, 4))
    oil = sweep(Profile.circle(2.1, (0, 8), step=math.radians(15)), [(0, 60), (0, AXIS + 29.2), (1.2, AXIS + 30.4)])
    return union(plate(), upright(), ribs(), seat(), nipple) - bore() - oil


if __name__ == "__main__":
    write_stl(__file__, *triangles_of(bracket()))
