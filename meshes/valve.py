"""valve.stl: the body of a flanged ball valve, for the flat coloured label of the paper's figure 9.

A ball-shaped body between two pipe flanges, a bonnet with a stem on top. Everything is turned on two axes that cross in
the middle of the ball. 104 x 72 x 100 mm, 18,094 triangles. The label goes on the ball, which is curved both ways.
Regenerate: python3 meshes/valve.py
"""

import math

from solid import *

FINE = math.radians(5)
SMALL = math.radians(10)
BALL = 27.0
FLANGE = 36.0
LENGTH = 52.0  # from the middle to a flange's face


def meridian(neck, fillet, steps_ball, steps_fillet, start, dip=0.0):
    """Points (radius, height) along a ball from an angle (degrees from the equator), over a fillet, into a neck."""
    reach = neck + fillet
    height = math.sqrt((BALL + fillet) ** 2 - reach**2)
    touch = math.degrees(math.atan2(height, reach))
    ball = arc((0, 0), BALL, start, touch, steps_ball)
    bend = arc((reach, height), fillet, touch + 180, 180, steps_fillet)
    return ball[:-1] + [(r, z - dip) for r, z in bend]


def pipe():
    """The ball with its necks and flanges, one turned shape along x."""
    half = meridian(17, 9, 9, 7, 0)
    half += [(d + 17, z) for d, z in arc((3, LENGTH - 10 - 3), 3, 180, 90, 4)]  # the fillet behind the flange
    half += [(FLANGE - 1, LENGTH - 10), (FLANGE, LENGTH - 9), (FLANGE, LENGTH - 3), (FLANGE - 1, LENGTH - 2)]
    half += [(22, LENGTH - 2), (22, LENGTH - 0.6), (21.4, LENGTH)]  # the raised face with two sealing grooves
    half += [(r + d, LENGTH - (0.5 - abs(d))) for r in (19, 17) for d in (0.5, 0.0, -0.5)]
    other = [(r, -z) for r, z in half[:0:-1]]
    return along_x(revolve(other + half, FINE))


def bonnet():
    """Neck, flange, packing nut and stem on top of the ball."""
    foot = meridian(13, 6, 1, 6, 40, dip=0.3)[1:]
    side = [(foot[0][0], 15)] + foot + arc((15, 36), 2, 180, 90, 3)
    side += [(22, 38)] + arc((22, 39), 1, -90, 0, 3)[1:] + arc((22, 44), 1, 0, 90, 3)
    side += [(11, 45)] + arc((11, 47), 2, 270, 180, 4)[1:] + [(9, 52), (8, 53), (4.5, 53), (4.5, 57)]
    stem = sweep(Profile.rectangle(6, 6, 0.8, step=SMALL), [(0, 52), (0, 63.3), (-0.7, 64)])
    return revolve(side, FINE) + stem


def bolts():
    """Four hexagon heads on the bonnet's flange."""
    hexagon = Profile.polygon(
        [(3.9 * math.cos(a), 3.9 * math.sin(a), 0.3) for a in np.radians(range(0, 360, 60))], math.radians(30)
    )
    washer = sweep(Profile.circle(4.4, step=SMALL), [(0, 44), (0, 45.8), (-0.4, 46.2)])
    head = washer + sweep(hexagon, [(0, 46), (0, 48.4), (-0.25, 48.9)])
    return place(head, *[(17 * math.cos(a), 17 * math.sin(a)) for a in np.radians([45, 135, 225, 315])])


def drilled():
    """The bore and the bolt holes of both flanges, along x."""
    bore = revolve([(14, -LENGTH - 1), (12.5, -LENGTH + 0.5), (12.5, LENGTH - 0.5), (14, LENGTH + 1)], FINE)
    hole = union(prism(Profile.circle(3.6, step=SMALL), 40, 53), prism(Profile.circle(6, step=SMALL), 38, LENGTH - 9.4))
    holes = union(*[hole.translate((29 * math.cos(a), 29 * math.sin(a), 0)) for a in np.radians(range(45, 360, 90))])
    return along_x(bore + holes + holes.mirror((0, 0, 1)))


def valve():
    return union(pipe(), bonnet(), bolts()) - drilled()


if __name__ == "__main__":
    write_stl(__file__, *triangles_of(valve()))
