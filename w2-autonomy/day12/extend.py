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
    each_case=100,
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
        if reached(tree, sample, step, world) is far:
            continue
        i, _, open_ = extend(tree, sample, step, world)
        if open_ is not free or not segment_free_of_discs(tree[i], tree[i], world):
            continue
        # An edge that is free is mostly one beyond which a disc hides the sample.
        if (
            not (far and free)
            or not segment_free_of_discs(tree[i], sample, world)
            or rng.uniform(0, 1) < 0.03
        ) and definite(tree, sample, step, world):
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
    """from-the-newest: your code extends the tree from its newest node. Extend the tree
      from the node nearest to the sample instead
    from-the-root: your code extends the tree from its root. Extend the tree from the
      node nearest to the sample instead
    sample-itself: your code returns the sample itself as the new point. Use `steer` to
      limit the edge to one step
    sample-itself 2: your code returns the sample itself as the new point, and it tests
      the whole edge to the sample. Use `steer` to limit the edge to one step
    point-only: your code tests only the new point. Test the whole edge to the new point
    node-only: your code tests only the nearest node. Test the whole edge from this node
      to the new point
    always-free: your code reports every edge as free. Test the edge from the nearest
      node to the new point
    never-free: your code reports every edge as blocked. Test the edge from the nearest
      node to the new point
    edge-from-the-root: your code tests the edge from the root to the new point. Test
      the edge from the nearest node to the new point instead
    edge-to-the-sample: your code tests the edge to the sample. Test only the edge to
      the new point
    edge-of-two-steps: your code tests an edge that is twice as long as the edge to the
      new point. Test only the edge to the new point
    edge-on-from-there: your code tests the edge from the new point to the sample. Test
      the edge from the nearest node to the new point instead
    hit-for-free: your code negates the third result. Return True if the edge is free
    stays-where-blocked: your code returns the nearest node if the edge is not free.
      Return the new point even in this case
    index-of-the-new: your code returns the index of the new node. Return the index of
      the nearest node instead
    away: your code extends the tree away from the sample. Move from the nearest node in
      the direction `sample - node`
    from-the-sample: your code steers from the sample to the nearest node, and it tests
      the edge from the sample. Steer from the nearest node to the sample instead, and
      test the edge from this node
    from-the-sample 2: your code steers from the sample to the nearest node. Steer from
      this node to the sample instead
    farthest: your code extends the tree from the node farthest from the sample. Extend
      the tree from the nearest node instead
    largest-difference: your code selects the nearest node by the largest coordinate
      difference. Use the Euclidean distance instead
    largest-difference 2: your code uses the largest coordinate difference to find the
      nearest node and its distance. Use the Euclidean distance instead
    sum-of-differences: your code selects the nearest node by the sum of the absolute
      coordinate differences. Use the Euclidean distance instead
    squared-for-plain: your code divides the step by the squared distance to the sample.
      Divide the step by the distance instead
    root-to-the-sample: your code tests the edge from the root to the sample. Test the
      edge from the nearest node to the new point instead
    standing-is-blocked: if the sample equals a node, your code reports the edge as
      blocked. Report the edge as free if the node is collision-free
    own-is-free: if the world has its own method `edge_free`, your code reports every
      edge as free. Call this method to test the edge
    own-is-blocked: if the world has its own method `edge_free`, your code reports every
      edge as blocked. Call this method to test the edge
    free-if-reached: your code reports an edge as free only if the step reaches the
      sample. Return the result of the edge test even if the step does not reach the
      sample
    reached-is-free: your code does not test the edge if the step reaches the sample.
      Test every edge
    ends-only: your code tests only the endpoints of the edge. Test the points between
      them too
    twice-a-step: your code returns a point up to two steps from the nearest node. Limit
      this distance to one step
    half-a-step: your code moves at most half a step from the nearest node. Use the
      whole step
    unit-step: your code moves a distance of at most 1 from the nearest node. Use the
      argument `step` as the limit instead
    added-twice: your code adds the result of `steer` to the node. Return the result
      itself, because `steer` returns a point and not a displacement
    nearest-of-the-free: your code selects the nearest node among the nodes whose edge
      is free. Select the nearest of all nodes instead, and report whether its edge is
      free
    sample-where-blocked: your code returns the sample if the edge is not free. Return
      the new point even in this case
    part-of-the-way: your code shortens the edge until it is free. Leave the new point
      unchanged, and return False if any part of the edge is blocked
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

    apart = np.abs(tree - sample)
    square = float(np.sum((sample - tree[i]) ** 2))

    def check(a, b):
        return segment_free_of_discs(a, b, world)

    def grown(k, q):
        return k, q, check(tree[k], q)

    def towards(k, length):
        part = min(1.0, step / length) if length else 1.0
        return grown(k, sample if part == 1.0 else tree[k] + part * (sample - tree[k]))

    widest = apart.max(axis=1)
    at_most = int(np.argmin(widest)), float(widest.min())

    def from_node(k):
        return grown(k, steer(tree[k], sample, step))

    return {
        "largest-difference": from_node(int(np.argmin(widest))),
        "largest-difference 2": towards(*at_most),
        "sum-of-differences": from_node(int(np.argmin(apart.sum(axis=1)))),
        "squared-for-plain": towards(i, square),
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
