"""What Day 12 asks about: discs in the plane, trees, ways."""

import numpy as np

from labkit.judge import Slip, rounded
from labkit.judge.draw import Draw
from labkit.judge.worlds import Balls, HalfSpace
from robo47 import planning

DISC = np.array([[1.0, 1, 0.5]])  # of the docstrings
NONE = np.empty((0, 3))
OWN = Balls(DISC)  # the same, and one has to ask it
BALL = Balls([[1.0, 0.1, 0, 0.5]])
FLOOR = HalfSpace((0.0, 1.0), -0.2)  # below y = -0.2 nothing is free
ASKS = Slip(
    "'(Room|Yard|Shelf)'",
    "",
    "own-checker-not-asked",
    "A world can have its own method `edge_free(a, b)` instead of discs. Call the "
    "given function `edge_free(a, b, world)`, which handles both cases.",
)
HUGE = 1e6
CLEAR = 1e-5  # nothing that is asked comes so near to a tie, or touches so nearly
LEFT = (np.array([-1.0, -0.9]), np.array([-0.9, -1.0]))
RIGHT = (np.array([1.1, 0.9]), np.array([0.9, 1.05]))


def usual(rng):
    """Return a generator that draws no edges, for what is drawn until it fits."""
    return Draw(int(rng.integers(2**31)))


def discs(rng, m, least=0.1, most=0.4):
    """Return m discs about the origin, (m, 3)."""
    return rounded(rng.uniform((-1, -1, least), (1, 1, most), (m, 3)))


def discs_of(world):
    """Return the discs of a world, also of one that does not show them."""
    if isinstance(world, HalfSpace):  # a disc so large that its rim is flat here
        far = world.offset - HUGE
        return np.array([[*(far * world.normal), HUGE]])
    return world.rows if isinstance(world, Balls) else world


def gaps(a, b, some):
    """Return how far an edge is from each disc; less than 0 in it."""
    along = b - a
    part = (some[:, :-1] - a) @ along / max(along @ along, 1e-300)
    foot = a + np.minimum(np.maximum(part, 0), 1)[:, None] * along
    away = some[:, :-1] - foot
    return np.sqrt(np.sum(away * away, axis=1)) - some[:, -1]


def gap(a, b, some):
    """Return how far an edge is from the nearest disc."""
    return np.min(gaps(a, b, some), initial=9)


def clear(a, b, some):
    """Return whether rounding cannot decide if the edge from a to b is free."""
    return bool(np.all(np.abs(gaps(a, b, discs_of(some))) > CLEAR))


def second_best(tree, q):
    """Return by how much the second nearest node is further away than the nearest."""
    away = np.sort(np.linalg.norm(tree - q, axis=1))
    return away[1] - away[0] if len(away) > 1 else 9.0


class Careful:
    """A world that remembers whether an edge came too near to touching."""

    def __init__(self, some):
        """Take the discs."""
        self.discs = some
        self.clear = True

    def edge_free(self, a, b):
        """Return whether it is free; nothing is, after an edge that nearly touches."""
        away = gaps(a, b, self.discs)
        self.clear = self.clear and bool(np.all(np.abs(away) > CLEAR))
        return self.clear and bool(np.all(away > 0))


def ways_asked(rng):
    """Return calls of rrt_connect: worlds where it finds a way, late or never."""
    rng = usual(rng)
    found = []
    for m, n, step, wanted in (
        (3, 6, 0.37, True), (5, 30, 0.37, True), (7, 40, 0.23, True),
        (6, 40, 0.41, True), (9, 60, 0.31, True), (5, 8, 0.23, False),
    ):  # fmt: skip
        while True:
            start, goal = LEFT[rng.integers(2)], RIGHT[rng.integers(2)]
            world = Careful(discs(rng, m, 0.15, 0.4))
            samples = rng.numbers(-1.3, 1.3, n, 2)
            if planning.segment_free_of_discs(start, goal, world.discs):
                continue
            if min(gap(x, x, world.discs) for x in (start, goal)) <= 0.05:
                continue
            way = planning.rrt_connect(start, goal, world, samples, step)
            if world.clear and bool(len(way)) == wanted:
                break
        found.append((start, goal, world.discs, samples, step))
    return found


def without_filling(way):
    """Return a way without the rows of zeros that fill it up."""
    there = np.flatnonzero(way.any(axis=1))
    return way[: there[-1] + 1] if there.size else way[:0]
