"""What Day 12 asks about: discs in the plane, trees, ways; and planners that differ."""

from itertools import pairwise

import numpy as np

from labkit.judge import Finding, rounded
from labkit.judge.draw import Draw
from robo47 import planning

DISC = np.array([[1.0, 1, 0.5]])  # of the docstrings
NONE = np.empty((0, 3))
CLEAR = 1e-5  # nothing that is asked comes so near to a tie, or touches so nearly
LEFT = (np.array([-1.0, -0.9]), np.array([-0.9, -1.0]))
RIGHT = (np.array([1.1, 0.9]), np.array([0.9, 1.05]))


def usual(rng):
    """Return a generator that draws no edges, for what is drawn until it fits."""
    return Draw(int(rng.integers(2**31)))


def discs(rng, m, least=0.1, most=0.4):
    """Return m discs about the origin, (m, 3)."""
    return rounded(rng.uniform((-1, -1, least), (1, 1, most), (m, 3)))


def gap(a, b, some):
    """Return how far an edge is from the nearest disc; less than 0 in it."""
    along = b - a
    part = (some[:, :2] - a) @ along / max(along @ along, 1e-300)
    foot = a + np.clip(part, 0, 1)[:, None] * along
    return np.min(np.linalg.norm(some[:, :2] - foot, axis=1) - some[:, 2], initial=9)


def clear(a, b, some):
    """Return whether rounding cannot decide if the edge from a to b is free."""
    return all(abs(gap(a, b, one[None])) > CLEAR for one in some)


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
        """Return whether it is free, as the library says."""
        self.clear = self.clear and clear(a, b, self.discs)
        return planning.disc_edge_free(a, b, self.discs)


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
            ends = min(gap(x, x, world.discs) for x in (start, goal))
            way = planning.rrt_connect(start, goal, world, samples, step)
            straight = planning.disc_edge_free(start, goal, world.discs)
            if (
                ends > 0.05
                and world.clear
                and bool(len(way)) == wanted
                and not straight
            ):
                break
        found.append((start, goal, world.discs, samples, step))
    return found


def grown(nodes, parents, target, step, world, free=None):
    """Add a node towards the target if its edge is free; return whether it was."""
    i, q, open_ = planning.extend(np.array(nodes), target, step, world)
    if open_ if free is None else free:
        nodes.append(q)
        parents.append(i)
        return True
    return False


def to_root(nodes, parents):
    """Return the nodes from the newest to the root."""
    i = len(nodes) - 1
    way = [nodes[i]]
    while i > 0:
        i = parents[i]
        way.append(nodes[i])
    return way


def planner(start, goal, world, samples, step, turn="sample", approach="connect",
            mine="step", parent="nearest", joined=None, free=None):  # fmt: skip
    """Plan with two trees, in another way.

    Args:
        start, goal, world, samples, step: as rrt_connect has them.
        turn: when the trees change: "sample" each time; "grew" only if it grew;
            "failed" only if not; "never"; "goal": the goal's tree is first.
        approach: what the other tree does: "connect" edge after edge to the new node;
            "one" edge; "sample": edge after edge to the sample; "jump" in one edge.
        mine: what the first tree does: one "step", or "connect" until it is blocked.
        parent: "nearest", or "newest" of each node.
        joined: how the way is made of both branches, each from the newest to its root.
        free: True takes every edge for free.
    """
    joined = joined or (lambda a, b: a[::-1] + b[1:])
    trees, parents = ([start], [goal]), ([0], [0])
    one = int(turn == "goal")
    for sample in samples:
        side, other = one, 1 - one
        grew = grown(trees[side], parents[side], sample, step, world, free)
        while (
            grew and mine == "connect" and not np.array_equal(trees[side][-1], sample)
        ):
            if not grown(trees[side], parents[side], sample, step, world, free):
                break
        if turn in ("sample", "goal") or (turn == "grew" and grew):
            one = other
        if turn == "failed" and not grew:
            one = other
        if not grew:
            continue
        new = trees[side][-1]
        target = sample if approach == "sample" else new
        far = 99.0 if approach == "jump" else step
        while grown(trees[other], parents[other], target, far, world, free):
            if np.array_equal(trees[other][-1], new):
                if parent == "newest":
                    parents = tuple([0, *range(len(tree) - 1)] for tree in trees)
                a, b = (to_root(trees[k], parents[k]) for k in (0, 1))
                return np.array(joined(a, b))
            if approach == "one" or np.array_equal(trees[other][-1], target):
                break
    return np.empty((0, len(start)))


def one_tree(start, goal, world, samples, step):
    """Grow the start's tree alone, towards the samples, and try the goal each time."""
    nodes, parents = [start], [0]
    for sample in samples:
        if grown(nodes, parents, sample, step, world):
            new = nodes[-1]
            near = np.linalg.norm(goal - new) <= step
            if near and planning.edge_free(new, goal, world):
                return np.array([*to_root(nodes, parents)[::-1], goal])
    return np.empty((0, len(start)))


def fault(way, start, goal, world, step):
    """Return what keeps a way from being one, in words, or ""."""
    if not np.array_equal(way[0], start):
        return "does not begin at the start"
    if not np.array_equal(way[-1], goal):
        return "does not end at the goal"
    longest = np.linalg.norm(np.diff(way, axis=0), axis=1).max(initial=0.0)
    if longest > step * (1 + 1e-9):
        return f"has an edge of length {longest:.3f}, where a step is {step:g}"
    for i, (a, b) in enumerate(pairwise(way)):
        if gap(a, b, world) < -CLEAR:
            return f"has an edge that is not free, from way point {i} to {i + 1}"
    return ""


def of_a_planner(case):
    """Say of answers that no named planner gives whether they are ways at all."""
    S, T = (list(map(without_filling, x)) for x in (case.S, case.T))
    arguments = list(zip(*case.arguments, strict=True))
    for k, (way, right, (start, goal, world, _, step)) in enumerate(
        zip(S, T, arguments, strict=True)
    ):
        where = f"in call {k + 1} of {len(S)}"
        if not len(way) and len(right):
            return Finding("no-way", f"It finds no way {where}, where there is one.")
        if len(way) and (why := fault(way, start, goal, world, step)):
            return Finding("no-valid-way", f"It is no way {where}: it {why}.")
        if len(way) and not len(right):
            says = f"It finds a way {where}, where these samples find none: a valid one"
            return Finding("another-planner", f"{says}, and not the one asked for.")
    for k, (way, right) in enumerate(zip(S, T, strict=True)):
        n = min(len(way), len(right))
        off = np.abs(way[:n] - right[:n]).max(axis=1, initial=0.0) > CLEAR
        if off.any() or len(way) != len(right):
            at = int(np.argmax(off)) if off.any() else n
            return Finding(
                "another-planner",
                f"Yours is another planner: its ways are valid in all {len(S)} calls, "
                "and not the ones asked for. The first that differs does so "
                f"in call {k + 1}, from way point {at} on, counted from 0.",
            )
    return None


def without_filling(way):
    """Return a way without the rows of zeros that fill it up."""
    there = np.flatnonzero(way.any(axis=1))
    return way[: there[-1] + 1] if there.size else way[:0]
