"""housing.stl: the cover of a gear pump, after the CAD part of the paper's figure 8 ("top" indented).

A thin-walled casing with a rounded rim on a flange with six lugs; on top a filler neck with gussets, vents on both
flanks, a pipe port and a cable gland at the ends; inside, screw posts and a grid of ribs; below, a groove for the seal.
154 x 110 x 58 mm, 27,958 triangles (the paper's part: 27,800). The label goes on the flat of the top, beside the neck.
Regenerate: python3 meshes/housing.py
"""

import math

from solid import *

FINE = math.radians(4.5)
SMALL = math.radians(9)  # for screws
WALL = 3.0
TOP = 40.0
NECK = (33, 0)


def flange_outline():
    def lug(x, y, dx, dy, half=9.0, rise=9.0):
        """Corners of a lug at (x, y); the outline runs along (dx, dy), outwards is to its right."""
        ox, oy = dy, -dx
        at = lambda along, out, r: (x + along * dx + out * ox, y + along * dy + out * oy, r)
        return [at(-half - 5, 0, 6), at(-half, rise, half - 1.2), at(half, rise, half - 1.2), at(half + 5, 0, 6)]

    return Profile.polygon(
        [
            *lug(-32, -46, 1, 0),
            *lug(32, -46, 1, 0),
            (68, -46, 18),
            *lug(68, 0, 0, 1),
            (68, 46, 18),
            *lug(32, 46, -1, 0),
            *lug(-32, 46, -1, 0),
            (-68, 46, 18),
            *lug(-68, 0, 0, -1),
            (-68, -46, 18),
        ],
        math.radians(7.5),
    )


def body():
    """What is filled with metal before the cavity is taken out."""
    flange = sweep(flange_outline(), round_bottom(0, 0.8, 2) + round_top(6, 1.2, 4))
    walls = sweep(Profile.rectangle(120, 76, 18, step=FINE), flare(6, 3.5, 6, inside=0) + round_top(TOP, 7, 12))
    return union(flange, walls)


def cavity():
    inner = Profile.rectangle(120 - 2 * WALL, 76 - 2 * WALL, 18 - WALL, step=FINE)
    return sweep(inner, [(0, -1)] + round_top(TOP - WALL, 5, 8))


def neck():
    """The filler neck with its gussets."""
    pipe = sweep(
        Profile.circle(13, NECK, step=FINE),
        flare(TOP, 2.5, 5, inside=0) + [(0, TOP + 11), (2, TOP + 13), (2, TOP + 16.8), (0.8, TOP + 18)],
    )
    gusset = Profile.polygon(
        [(8, TOP - 2, 1.5), (22.5, TOP - 2, 1.5), (22.5, TOP + 1.6, 1.5), (14.5, TOP + 9.5, 12), (8, TOP + 9.5, 1.5)],
        SMALL,
    )
    blade = along_y(sweep(gusset, round_bottom(-1.2, 0.7, 3) + round_top(1.2, 0.7, 3)))
    blades = union(*[blade.rotate((0, 0, a)) for a in (0, 60, 120, 180, 240, 300)]).translate((*NECK, 0))
    return pipe + blades


def neck_bore():
    return sweep(
        Profile.circle(9, NECK, step=FINE),
        [(0, TOP - 8), (0, TOP + 8), (1.5, TOP + 9.5), (1.5, TOP + 17), (3, TOP + 18.5)],
    )


def ports():
    """A pipe port to the right and a cable gland to the left."""
    pipe = along_x(
        sweep(Profile.circle(13, (0, 21), step=FINE), [(0, 50)] + flare(60, 2, 4, inside=0)[1:] + round_top(66, 1, 3))
    )
    gland = along_x(
        sweep(Profile.circle(9, (0, 21), step=FINE), [(0, 50)] + flare(60, 2, 4, inside=0)[1:] + round_top(68, 1, 3))
    )
    return pipe + gland.mirror((1, 0, 0))


def port_bores():
    screw = sweep(Profile.circle(1.3, step=SMALL), [(0, 58), (0, 65.5), (0.7, 66.2)])
    screws = union(
        *[screw.translate((10.3 * math.cos(a), 21 + 10.3 * math.sin(a), 0)) for a in np.radians([45, 135, 225, 315])]
    )
    pipe = along_x(union(sweep(Profile.circle(7.4, (0, 21), step=FINE), [(0, 40), (0, 65), (1.2, 66.2)]), screws))
    gland = along_x(sweep(Profile.circle(5, (0, 21), step=FINE), [(0, 40), (0, 66.5), (1.8, 68.3)]))
    return pipe + gland.mirror((1, 0, 0))


def vents():
    """Upright slots with broken edges through both flanks; they look along y."""
    slot = Profile.slot(17, 4, (0, 20.5), math.pi / 2, step=math.radians(9))
    cut = along_y(sweep(slot, [(0, 33), (0, 37.4), (0.8, 38.2)]))
    row = place(cut, *[(x, 0) for x in range(-36, 37, 8)])
    return row + row.mirror((0, 1, 0))


def inside():
    """Screw posts and ribs under the top."""
    post = sweep(Profile.circle(4.5, step=SMALL), [(0, 8), (0, TOP - 1)])
    posts = place(post, (-50, -28), (50, -28), (-50, 28), (50, 28))
    long_rib = prism(Profile.rectangle(116, 2.2, 0.6, step=SMALL), TOP - 9, TOP - 1)
    cross_rib = prism(Profile.rectangle(2.2, 72, 0.6, step=SMALL), TOP - 7, TOP - 1)
    return union(posts, place(long_rib, (0, -14), (0, 14)), place(cross_rib, (-40, 0), (-20, 0), (0, 0)))


def screws():
    """Bolt holes of the lugs, screw holes of the posts."""
    bolt = union(
        prism(Profile.circle(3.3, step=SMALL), -1, 7), sweep(Profile.circle(6.2, step=SMALL), [(0, 5.2), (0, 7)])
    )
    screw = sweep(Profile.circle(1.6, step=SMALL), [(0.7, 7.3), (0, 8.7), (0, 28)])
    lugs = place(bolt, (-32, -48), (32, -48), (-32, 48), (32, 48), (-70, 0), (70, 0))
    return lugs + place(screw, (-50, -28), (50, -28), (-50, 28), (50, 28))


def groove():
    outer, inner = (Profile.rectangle(125 + w, 81 + w, 19 + w / 2, step=FINE) for w in (2.4, -2.4))
    return prism(outer, -1, 1.6) - prism(inner, -2, 2)


def housing():
    shell = body() - cavity() + (inside() ^ body()) + neck() + ports()
    return shell - (neck_bore() + port_bores() + vents() + screws() + groove())


if __name__ == "__main__":
    write_stl(__file__, *triangles_of(housing()))
