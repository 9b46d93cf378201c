"""12.3 `extend(tree, sample, step, world)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Index, Mask, Row, Vector
from robo47.planning import edge_free, extend, nearest, segment_free_of_discs, steer

from .ways import (
    ASKS,
    CLEAR,
    DISC,
    FLOOR,
    NONE,
    OWN,
    clear,
    discs,
    discs_of,
    second_best,
    usual,
)

row = Row(
    (
        Index(called="the nearest node"),
        Vector((2,), called="the new point"),
        Mask(called="whether it is free"),
    ),
    at_edge=lambda tree, sample, step, world: definite(tree, sample, step, world),
    slips=(ASKS,),
)


def definite(tree, sample, step, world):
    """Return whether rounding decides neither the node nor the edge."""
    i, q, _ = extend(tree, sample, step, world)
    tie = abs(np.linalg.norm(sample - tree[i]) - step) < CLEAR
    return second_best(tree, sample) > CLEAR and clear(tree[i], q, world) and not tie


def asked(rng, free, far, n=6):
    """Return a question whose edge is free, or not, to a sample far away, or near."""
    while True:
        tree, world = rng.numbers(-1, 1, n, 2), discs(rng, 3)
        step = (0.313, 0.627)[rng.integers(2)]
        sample = rng.numbers(-1.5, 1.5, 2)
        i, _, open_ = extend(tree, sample, step, world)
        away = np.linalg.norm(sample - tree[i])
        # Where a step ends in the open and the sample is hit, and the other way round.
        beyond = segment_free_of_discs(tree[i], sample, world) is not open_
        start = segment_free_of_discs(tree[i], tree[i], world)
        if not start or bool(away > step) is not far or open_ is not free:
            continue
        if (beyond or not far or rng.uniform(0, 1) < 0.03) and definite(
            tree, sample, step, world
        ):
            return tree, sample, step, world


def reached(tree, sample, step, world):
    """Return whether a sample lies within a step of the nearest node."""
    return float(np.linalg.norm(tree - sample, axis=1).min()) <= step


def free(tree, sample, step, world):
    """Return whether the new edge is free."""
    return extend(tree, sample, step, world)[2]


row.cases(
    edges_that_are_free=free,
    edges_that_are_not_free=lambda *call: not free(*call),
)
row.cases(
    samples_within_a_step=reached,
    samples_farther_than_a_step=lambda *call: not reached(*call),
)


@row.rare
def _(rng):
    for step in (0.3, 1.0, 3.0):
        tree, sample = rng.numbers(-1, 1, 6, 2), rng.numbers(-1.5, 1.5, 2)
        call = tree, sample, step, discs(rng, 2)
        if definite(*call):
            yield call


@row.inputs
def _(rng):
    yield np.array([[0.0, 0], [1, 0]]), np.array([1.0, 2]), 0.5, DISC
    yield np.array([[0.0, 0], [1, 0]]), np.array([1.0, 2]), 0.4, DISC
    yield np.array([[0.0, 0]]), np.array([0.0, 0.3]), 0.5, NONE
    yield np.array([[0.0, 0], [1, 0]]), np.array([1.0, 2]), 0.6, OWN
    yield np.array([[0.0, 0], [1, 0]]), np.array([1.0, 2]), 0.4, OWN
    yield np.array([[0.0, 0], [1, 0]]), np.array([1.0, -2]), 0.6, FLOOR
    yield np.array([[0.0, 0], [1, 0]]), np.array([3.0, 1]), 0.6, FLOOR
    yield np.array([[1.0, 1], [3, 0]]), np.array([1.0, 3]), 1.5, DISC  # out of a disc
    # Far beyond the second step.
    yield np.array([[0.0, 0]]), np.array([3.0, 0]), 0.5, np.array([[2.5, 0, 0.2]])
    # Between two free ends: a thin disc.
    thin = np.array([[0.25, 0, 0.02]])
    yield np.array([[2.0, 2], [0, 0]]), np.array([0.4, 0]), 0.5, thin
    yield np.array([[0.0, 0], [3, 0]]), np.array([1.0, 0]), 0.5, thin
    yield np.array([[0.0, 0]]), np.array([0.4, 0]), 0.5, thin  # no other node sees it
    yield np.array([[0.0, 0], [3, 0]]), np.array([3.0, 0]), 0.5, DISC  # a node itself
    kinds = [(True, True), (False, True), (True, False), (False, False)]
    rng = usual(rng)
    for free, far in kinds[:2] * 5 + kinds[2:] * 2:
        yield asked(rng, free, far)


def _of_the_free(tree, sample, step, world):
    """Grow the nearest of the nodes whose edge is free."""
    world = discs_of(world)
    order = np.argsort(np.sum((tree - sample) ** 2, axis=1), kind="stable")
    for i in map(int, order):
        q = steer(tree[i], sample, step)
        if segment_free_of_discs(tree[i], q, world):
            return i, q, True
    return extend(tree, sample, step, world)


def _part_of_the_way(node, i, q, world):
    """Halve the edge until it is free, or hardly there."""
    world = discs_of(world)
    while not segment_free_of_discs(node, q, world) and np.linalg.norm(q - node) > 1e-3:
        q = (q + node) / 2
    return i, q, segment_free_of_discs(node, q, world)


@row.wrongs
def _(tree, sample, step, world):
    """from-the-newest: it grows from the newest node; the nearest one grows
    from-the-root: it grows from the first node, the root; the nearest one grows
    sample-itself: the new point is the sample, however far: steer's step is missing
    sample-itself 2: the new point is the sample, and the edge to it is what is checked:
      steer's step is missing => with the sample for the new point
    point-only: only the new point is checked, not the edge that leads to it
    node-only: only the node is checked, not the edge that leads away from it
    always-free: no edge is checked: every one is free
    never-free: no edge is free
    edge-from-the-root: the edge from the root to the new point is checked; it starts at
      the nearest node
    edge-to-the-sample: the edge to the sample is checked; the tree only grows by a step
    edge-of-two-steps: the edge that is checked is two steps long; the tree grows by one
    edge-on-from-there: the edge from the new point to the sample is checked; the tree
      grows by the one before it
    hit-for-free: True and False are swapped: it says whether the edge is hit
    stays-where-blocked: where the edge is not free the node itself comes back; where it
      would have grown to is asked for
    index-of-the-new: the index is the one that the new point will have; it is that of
      the node it grows from
    away: it grows away from the sample: steer takes the node, then the sample
    from-the-sample: it is steered from the sample to the node; the tree grows from the
      node
    from-the-sample 2: it is steered from the sample to the node; the tree grows from
      the node => a step from the sample, and the edge from the node to there
    farthest: the farthest node grows; the nearest one does
    root-to-the-sample: the edge from the root to the sample is checked; it is the one
      from the nearest node to the new point
    standing-is-blocked: where the sample is a node itself the edge is called blocked;
      it has no length, and is free where the node is
    own-is-free: a world that has an edge_free of its own is not asked: all edges are
      free there => True there
    own-is-blocked: a world that has an edge_free of its own is not asked: no edge is
      free there => False there
    free-if-reached: it is free only where the sample is reached; a step towards it is
      an edge as well
    reached-is-free: where the sample is reached the edge is not checked
    ends-only: only the two ends of the edge are checked, not what lies between
    twice-a-step: it goes two steps
    half-a-step: it goes half a step
    unit-step: it goes 1 far; it is `step`
    added-twice: steer's point is added to the node: it is a place, and no way
    nearest-of-the-free: the nearest node of those whose edge is free grows; the nearest
      of all does, and whether its edge is free is told
    sample-where-blocked: where the edge is not free the sample itself comes back; where
      the tree would have grown to is asked for
    part-of-the-way: where the edge is not free it goes back towards the node until it
      is; a blocked edge adds nothing => halved until it is free
    """
    own = world is not discs_of(world)
    world = discs_of(world)
    i, q, free = extend(tree, sample, step, world)
    new, root = len(tree) - 1, tree[0]
    last = steer(tree[new], sample, step)
    first = steer(root, sample, step)
    back = steer(sample, tree[i], step)
    off = 2 * tree[i] - q
    far = int(np.argmax(np.sum((tree - sample) ** 2, axis=1)))
    at_far = steer(tree[far], sample, step)

    def check(a, b):
        return segment_free_of_discs(a, b, world)

    return {
        "from-the-newest": (new, last, check(tree[new], last)),
        "from-the-root": (0, first, check(root, first)),
        "sample-itself": (i, sample, free),
        "sample-itself 2": (i, sample, check(tree[i], sample)),
        "point-only": (i, q, check(q, q)),
        "node-only": (i, q, check(tree[i], tree[i])),
        "always-free": (i, q, True),
        "never-free": (i, q, False),
        "edge-from-the-root": (i, q, check(root, q)),
        "edge-to-the-sample": (i, q, check(tree[i], sample)),
        "edge-of-two-steps": (i, q, check(tree[i], 2 * q - tree[i])),
        "edge-on-from-there": (i, q, check(q, sample)),
        "hit-for-free": (i, q, not free),
        "stays-where-blocked": (i, q if free else tree[i], free),
        "index-of-the-new": (len(tree), q, free),
        "away": (i, off, check(tree[i], off)),
        "from-the-sample": (i, back, check(sample, back)),
        "from-the-sample 2": (i, back, check(tree[i], back)),
        "farthest": (far, at_far, check(tree[far], at_far)),
        "root-to-the-sample": (i, q, check(root, sample)),
        "standing-is-blocked": (i, q, free and not np.array_equal(q, tree[i])),
        "own-is-free": (i, q, free or own),
        "own-is-blocked": (i, q, free and not own),
        "free-if-reached": (i, q, free and np.array_equal(q, sample)),
        "reached-is-free": (i, q, free or np.array_equal(q, sample)),
        "ends-only": (i, q, check(tree[i], tree[i]) and check(q, q)),
        "twice-a-step": extend(tree, sample, 2 * step, world),
        "half-a-step": extend(tree, sample, step / 2, world),
        "unit-step": extend(tree, sample, 1.0, world),
        "added-twice": (i, tree[i] + q, check(tree[i], tree[i] + q)),
        "nearest-of-the-free": _of_the_free(tree, sample, step, world),
        "sample-where-blocked": (i, q if free else sample, free),
        "part-of-the-way": _part_of_the_way(tree[i], i, q, world),
    }


@row.right  # With the library's pieces, checked by hand.
def _(tree, sample, step, world):
    i = nearest(tree, sample)
    way = sample - tree[i]
    q = tree[i] + way * min(1.0, step / max(np.linalg.norm(way), 1e-12))
    return i, q, edge_free(q, tree[i], world)


row.at_least_0(step="a length")


row.spans(  # as small, or as large, as in the lab
    sample=(lambda sample: 0.01 * sample,),
    step=(0.1,),
)
