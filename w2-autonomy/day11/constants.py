"""The sensitivity of Day 11's numbers: each constant doubled, measured and explained.

The lab's own functions compute everything.
"""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.lab_module import complete_lab
from robo47 import panda, shapes
from robo47.jacobian import space_jacobian

LAB = complete_lab(11)
DAY = LAB.day11_mujoco
MODEL = panda.load("panda_nohand")
REACH = LAB.distal_radii(*shapes.Shape(MODEL, DAY.CAPSULES).lengths)

numbers = Numbers(
    LAB, DAY,
    points="inner samples: {}",
    WIRE="WIRE, the radius of the wire: {} m",
    turn="joint 1 rotates by: {} rad",
    PLACES="PLACES, positions of the wire: {}",
    SEED="SEED: {}",
    ASIDE="ASIDE: {} m",
    x="the x of the pen's end: × {}",
    bound="the distal radii: × {}",
    THIN="THIN, the radius of wire or post: {} m",
    NEAR="NEAR: {} m",
    ways="the length of the motions: × {}",
    GAIN="GAIN: {} /s",
    MARGIN="MARGIN: {} m",
    DT="DT: {} s",
    TIME="TIME: {} s",
    RUSH="RUSH: {} m/s",
    post="the post's radius: {} m",
)


@numbers.add("fraction of the positions at which 10 samples miss the wire", "{:.3f}",
    points=between(0.0, 0.25, "the gaps are 15 mm long, and the contact is 14 mm long", to=20),
    WIRE=between(0.6, 0.85, "the contact is 2 (5 + 4) = 18 mm long, in gaps of 28 mm"),
    turn=between(1.3, 1.65, "the gaps are twice as long: the formula gives 0.75 instead of 0.50"),
    SEED=between(0.8, 1.25, "200 other random positions", to=12),
    PLACES=between(0.8, 1.25, "twice as many random positions"))
def missed(points=10, turn=1.0):
    edges = [
        e._replace(q=e.q + (1.0 - turn) / 2 * e.dq, dq=turn * e.dq)
        for e in DAY.wires(LAB.PLACES, LAB.WIRE, LAB.SEED)
    ]
    return LAB.missed_by_points(edges, points) / LAB.PLACES


@numbers.add("gradient for joint 1, obstacle to the left of the pen", "{:.5f} m/rad",
    ASIDE=same("the normal is a unit vector at any distance"),
    x=times(2.0, "the velocity of a point is proportional to its distance from the axis"))
def slope(x=1.0):
    tip = DAY.pen(panda.READY_Q)[1] * [x, 1.0, 1.0]
    J = space_jacobian(panda.screws(MODEL), panda.READY_Q)
    return LAB.distance_gradient(J, tip, tip + LAB.ASIDE * np.eye(3)[1], 7)[0]


def whips(ways=1.0):
    """Return the lab's fast motions, scaled in length about the s of the contact."""
    edges = DAY.whips(LAB.WHIPS, LAB.THIN, LAB.SEED)
    s = np.linspace(0.0, 1.0, 801)
    found = []
    for e in edges:
        at = s[np.argmin(LAB.pen_from(e, s))] if ways != 1.0 else 0.0
        found.append(e._replace(q=e.q + at * (1.0 - ways) * e.dq, dq=ways * e.dq))
    return found


@numbers.add("motions in which 20 samples miss the wire", "{:.0f} of 60",
    points=between(0.4, 0.75, "the gaps are half as long", to=40),
    THIN=between(0.7, 0.98, "the contact is 14 mm long instead of 12 mm"),
    ways=between(0.5, 0.8, "the gaps are half as long", to=0.5),
    SEED=between(0.8, 1.25, "60 other random motions", to=1))
def by_points(points=20, ways=1.0):
    return LAB.missed_by_points(whips(ways), points)


@numbers.add("motions in which the bound misses the wire", "{:.0f} of 60",
    THIN=same("the bound does not depend on the size of the obstacle"),
    ways=same("the bound is proportional to the length of the motion", to=0.5),
    SEED=same("the bound holds for every motion", to=1),
    bound=same("a larger bound is also a bound, and needs more queries"))
def by_bound(ways=1.0, bound=1.0):
    return LAB.promises(whips(ways), bound * REACH)[0]


@numbers.add("distance queries of the bound, median", "{:.0f}",
    bound=between(1.8, 3.0, "the median step covers 0.35 of the remaining distance instead of 0.68"),
    NEAR=between(0.8, 1.0, "the loop stops a little earlier"),
    SEED=between(0.7, 1.4, "60 other random motions", to=1),
    THIN=between(0.8, 1.1, "the pen meets the wire a little earlier"))
def looks(bound=1.0):
    return np.median(LAB.promises(whips(), bound * REACH)[1])


@numbers.add("fraction of the distance left after 1 s straight at it", "{:.4f}",
    GAIN=times(7.4, "e^-2 instead of e^-4: the fraction is e² times as large", within=0.06, to=2.0),
    DT=between(0.85, 1.0, "0.92 ^ 50 is smaller than 0.96 ^ 100"),
    ASIDE=between(0.9, 1.1, "the decay is proportional to the distance", to=0.1),
    RUSH=between(0.9, 1.1, "the damper removes the whole excess velocity"))
def left():
    return LAB.left_of_it(LAB.velocity_damper, LAB.GAIN, LAB.DT)


@numbers.add("smallest distance to the post, with damper", "{:.1f} mm",
    MARGIN=times(2.0, "the damper keeps the margin", within=0.06),
    GAIN=between(0.94, 0.98, "the guarantee of 10 mm holds only in continuous time, but a step takes 10 ms"),
    TIME=between(0.9, 1.05, "the same path, slower"),
    post=between(-4.0, 1.0, "two capsules are close to the post, and only the nearest pair is filtered; with two pairs it is 10.5 mm"))
def round_it(post=LAB.POST[2]):
    return LAB.through((*LAB.POST[:2], post), LAB.velocity_damper)[0]
