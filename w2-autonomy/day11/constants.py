"""What Day 11's numbers hang on: each constant turned by two, measured, explained.

Everything is computed by the lab's own functions; nothing has noise.
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
    points="inner points: {}",
    wire="WIRE, its radius: {} m",
    turn="joint 1 turns by: {} rad",
    places="PLACES of the wire: {}",
    seed="SEED: {}",
    aside="ASIDE: {} m",
    x="the pen's x: × {}",
    speed="dq: × {}",
    bound="reach: × {}",
    thin="THIN, the radius of wire or post: {} m",
    near="NEAR: {} m",
    ways="how long the ways are: × {}",
    gain="GAIN: {} /s",
    margin="MARGIN: {} m",
    dt="DT: {} s",
    time="TIME: {} s",
    rush="RUSH: {} m/s",
    post="the post's radius: {} m",
)


@numbers.add(
    "share of places at which 10 points miss the wire", "{:.3f}",
    points=between(0.0, 0.25, "gaps of 15 mm, a contact of 14", to=20),
    wire=between(0.6, 0.85, "the contact is 2 (5 + 4) = 18 mm of a gap of 28"),
    turn=between(1.3, 1.65, "twice the gap, the same contact: 0.50 becomes 0.75"),
    seed=between(0.8, 1.25, "other places of the same kind", to=12),
    places=between(0.8, 1.25, "more places of the same kind"),
)  # fmt: skip
def missed(points=10, wire=LAB.WIRE, turn=1.0, seed=LAB.SEED, places=LAB.PLACES):
    """Return it, of the pen that joint 1 turns past a wire."""
    edges = [
        e._replace(q=e.q + (1.0 - turn) / 2 * e.dq, dq=turn * e.dq)
        for e in DAY.wires(places, wire, seed)
    ]
    return LAB.missed_by_points(edges, points) / places


@numbers.add(
    "slope of joint 1, from something left of the pen", "{:.5f} m/rad",
    aside=same("the normal has length 1, however far the thing is"),
    x=times(2.0, "what joint 1 moves, moves by its distance from the axis"),
)  # fmt: skip
def slope(aside=LAB.ASIDE, x=1.0):
    """Return it, at READY."""
    tip = DAY.pen(panda.READY_Q)[1] * [x, 1.0, 1.0]
    J = space_jacobian(panda.screws(MODEL), panda.READY_Q)
    return LAB.distance_gradient(J, tip, tip + aside * np.eye(3)[1], 7)[0]


def whips(thin, seed, ways):
    """Return the lab's whips, each of another length about the place it crosses at."""
    edges = DAY.whips(LAB.WHIPS, thin, seed)
    s = np.linspace(0.0, 1.0, 801)
    found = []
    for e in edges:
        at = s[np.argmin(LAB.pen_from(e, s))] if ways != 1.0 else 0.0
        found.append(e._replace(q=e.q + at * (1.0 - ways) * e.dq, dq=ways * e.dq))
    return found


@numbers.add(
    "ways on which 20 points miss the wire", "{:.0f} of 60",
    points=between(0.4, 0.75, "half the gaps", to=40),
    thin=between(0.7, 0.98, "a contact of 14 mm for 12, of a gap of 50"),
    ways=between(0.5, 0.8, "gaps of 25 mm", to=0.5),
    seed=between(0.8, 1.25, "other ways of the same kind", to=1),
)  # fmt: skip
def by_points(points=20, thin=LAB.THIN, ways=1.0, seed=LAB.SEED):
    """Return how many."""
    return LAB.missed_by_points(whips(thin, seed, ways), points)


@numbers.add(
    "ways on which the bound misses the wire", "{:.0f} of 60",
    thin=same("it looks at distances, not at places"),
    ways=same("a longer way takes more looks", to=0.5),
    seed=same("other ways are no other case", to=1),
    bound=same("a larger bound is one as well: more looks"),
)  # fmt: skip
def by_bound(thin=LAB.THIN, ways=1.0, seed=LAB.SEED, bound=1.0):
    """Return how many."""
    return LAB.promises(whips(thin, seed, ways), bound * REACH)[0]


@numbers.add(
    "looks of the bound, in the middle", "{:.0f}",
    bound=between(1.8, 3.0, "near the wire a look takes half of what is left, where it "
                  "took nearly all"),
    near=between(0.8, 1.0, "it stops a little earlier, and each look nears it by a "
                 "good part of what is left"),
    seed=between(0.7, 1.4, "other ways of the same kind", to=1),
    thin=between(0.8, 1.1, "the wire is met a little earlier"),
)  # fmt: skip
def looks(bound=1.0, near=LAB.NEAR, seed=LAB.SEED, thin=LAB.THIN):
    """Return how many, the median of 60 ways."""
    with turned(LAB, NEAR=near):
        return np.median(LAB.promises(whips(thin, seed, 1.0), bound * REACH)[1])


@numbers.add(
    "left of the distance after 1 s straight at it", "{:.4f}",
    gain=times(7.4, "e^-2 for e^-4: e² times as much", within=0.06, to=2.0),
    dt=between(0.85, 1.0, "0.92 to the 50th is less than 0.96 to the 100th"),
    aside=between(0.9, 1.1, "the same share of half the distance", to=0.1),
    rush=between(0.9, 1.1, "what is too fast is taken off, however much it is"),
)  # fmt: skip
def left(gain=LAB.GAIN, dt=LAB.DT, aside=LAB.ASIDE, rush=LAB.RUSH):
    """Return which share."""
    with turned(LAB, ASIDE=aside, RUSH=rush):
        return LAB.left_of_it(LAB.velocity_damper, gain, dt)


@numbers.add(
    "least distance on the way round the post", "{:.0f} mm",
    margin=times(2.0, "it is the margin that is kept", within=0.06),
    gain=between(0.9, 1.0, "it comes nearer to the margin, and not beyond"),
    time=between(0.9, 1.05, "the same way, slower"),
    post=between(-4.0, 1.0, "a second capsule is near as well, and only the nearest "
                 "is kept"),
)  # fmt: skip
def round_it(margin=LAB.MARGIN, gain=LAB.GAIN, time=LAB.TIME, post=LAB.POST[2]):
    """Return it."""
    with turned(LAB, MARGIN=margin, GAIN=gain, TIME=time):
        return LAB.through((*LAB.POST[:2], post), LAB.velocity_damper)[0]
