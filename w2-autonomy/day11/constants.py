"""The sensitivity of Day 11's numbers: each constant doubled, measured and explained.

The lab's own functions compute everything.
"""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import panda, shapes
from robo47.jacobian import space_jacobian

LAB = lab_of(find_day(11))
DAY = LAB.day11_mujoco
MODEL = panda.load("panda_nohand")
REACH = LAB.distal_radii(*shapes.Shape(MODEL, DAY.CAPSULES).lengths)

numbers = Numbers(
    points="inner samples: {}",
    wire="WIRE, the radius of the wire: {} m",
    turn="joint 1 rotates by: {} rad",
    places="PLACES, positions of the wire: {}",
    seed="SEED: {}",
    aside="ASIDE: {} m",
    x="the x of the pen's end: × {}",
    bound="the distal radii: × {}",
    thin="THIN, the radius of wire or post: {} m",
    near="NEAR: {} m",
    ways="the length of the motions: × {}",
    gain="GAIN: {} /s",
    margin="MARGIN: {} m",
    dt="DT: {} s",
    time="TIME: {} s",
    rush="RUSH: {} m/s",
    post="the post's radius: {} m",
)


@numbers.add(
    "fraction of the positions at which 10 samples miss the wire", "{:.3f}",
    points=between(0.0, 0.25, "the gaps are 15 mm long, and the contact is 14 mm long", to=20),
    wire=between(0.6, 0.85, "the contact is 2 (5 + 4) = 18 mm long, in gaps of 28 mm"),
    turn=between(1.3, 1.65, "the gaps are twice as long: the formula gives 0.75 instead of 0.50"),
    seed=between(0.8, 1.25, "200 other random positions", to=12),
    places=between(0.8, 1.25, "twice as many random positions"),
)  # fmt: skip
def missed(points=10, wire=LAB.WIRE, turn=1.0, seed=LAB.SEED, places=LAB.PLACES):
    """Return the fraction for the pen that joint 1 moves past a wire."""
    edges = [
        e._replace(q=e.q + (1.0 - turn) / 2 * e.dq, dq=turn * e.dq)
        for e in DAY.wires(places, wire, seed)
    ]
    return LAB.missed_by_points(edges, points) / places


@numbers.add(
    "gradient for joint 1, obstacle to the left of the pen", "{:.5f} m/rad",
    aside=same("the normal is a unit vector at any distance"),
    x=times(2.0, "the velocity of a point is proportional to its distance from the "
            "axis"),
)  # fmt: skip
def slope(aside=LAB.ASIDE, x=1.0):
    """Return the entry in the ready configuration."""
    tip = DAY.pen(panda.READY_Q)[1] * [x, 1.0, 1.0]
    J = space_jacobian(panda.screws(MODEL), panda.READY_Q)
    return LAB.distance_gradient(J, tip, tip + aside * np.eye(3)[1], 7)[0]


def whips(thin, seed, ways):
    """Return the lab's fast motions, scaled in length about the s of the contact."""
    edges = DAY.whips(LAB.WHIPS, thin, seed)
    s = np.linspace(0.0, 1.0, 801)
    found = []
    for e in edges:
        at = s[np.argmin(LAB.pen_from(e, s))] if ways != 1.0 else 0.0
        found.append(e._replace(q=e.q + at * (1.0 - ways) * e.dq, dq=ways * e.dq))
    return found


@numbers.add(
    "motions in which 20 samples miss the wire", "{:.0f} of 60",
    points=between(0.4, 0.75, "the gaps are half as long", to=40),
    thin=between(0.7, 0.98, "the contact is 14 mm long instead of 12 mm"),
    ways=between(0.5, 0.8, "the gaps are half as long", to=0.5),
    seed=between(0.8, 1.25, "60 other random motions", to=1),
)  # fmt: skip
def by_points(points=20, thin=LAB.THIN, ways=1.0, seed=LAB.SEED):
    """Return the number of motions."""
    return LAB.missed_by_points(whips(thin, seed, ways), points)


@numbers.add(
    "motions in which the bound misses the wire", "{:.0f} of 60",
    thin=same("the bound does not depend on the size of the obstacle"),
    ways=same("the bound is proportional to the length of the motion", to=0.5),
    seed=same("the bound holds for every motion", to=1),
    bound=same("a larger bound is also a bound, and needs more queries"),
)  # fmt: skip
def by_bound(thin=LAB.THIN, ways=1.0, seed=LAB.SEED, bound=1.0):
    """Return the number of motions."""
    return LAB.promises(whips(thin, seed, ways), bound * REACH)[0]


@numbers.add(
    "distance queries of the bound, median", "{:.0f}",
    bound=between(1.8, 3.0, "the median step covers 0.35 of the remaining "
                  "distance instead of 0.68"),
    near=between(0.8, 1.0, "the loop stops a little earlier"),
    seed=between(0.7, 1.4, "60 other random motions", to=1),
    thin=between(0.8, 1.1, "the pen meets the wire a little earlier"),
)  # fmt: skip
def looks(bound=1.0, near=LAB.NEAR, seed=LAB.SEED, thin=LAB.THIN):
    """Return the median over 60 motions."""
    with turned(LAB, NEAR=near):
        return np.median(LAB.promises(whips(thin, seed, 1.0), bound * REACH)[1])


@numbers.add(
    "fraction of the distance left after 1 s straight at it", "{:.4f}",
    gain=times(7.4, "e^-2 instead of e^-4: the fraction is e² times as large", within=0.06,
               to=2.0),
    dt=between(0.85, 1.0, "0.92 ^ 50 is smaller than 0.96 ^ 100"),
    aside=between(0.9, 1.1, "the decay is proportional to the distance", to=0.1),
    rush=between(0.9, 1.1, "the damper removes the whole excess velocity"),
)  # fmt: skip
def left(gain=LAB.GAIN, dt=LAB.DT, aside=LAB.ASIDE, rush=LAB.RUSH):
    """Return the fraction."""
    with turned(LAB, ASIDE=aside, RUSH=rush):
        return LAB.left_of_it(LAB.velocity_damper, gain, dt)


@numbers.add(
    "smallest distance to the post, with damper", "{:.1f} mm",
    margin=times(2.0, "the damper keeps the margin", within=0.06),
    gain=between(0.94, 0.98, "the guarantee of 10 mm holds only in continuous time, but a "
                 "step takes 10 ms"),
    time=between(0.9, 1.05, "the same path, slower"),
    post=between(-4.0, 1.0, "two capsules are close to the post, and only the nearest "
                 "pair is filtered; with two pairs it is 10.5 mm"),
)  # fmt: skip
def round_it(margin=LAB.MARGIN, gain=LAB.GAIN, time=LAB.TIME, post=LAB.POST[2]):
    """Return the smallest distance."""
    with turned(LAB, MARGIN=margin, GAIN=gain, TIME=time):
        return LAB.through((*LAB.POST[:2], post), LAB.velocity_damper)[0]
