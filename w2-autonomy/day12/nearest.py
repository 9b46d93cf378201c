"""12.1 `nearest(tree, q)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Index, Row
from robo47.planning import nearest

from .ways import CLEAR, second_best, usual

# Two nodes that are equally near, but for rounding, are nobody's question.
row = Row(
    Index(),
    at_edge=lambda tree, q: second_best(tree, q) > CLEAR,
)


@row.inputs
def _(rng):
    yield np.array([[0.0, 0], [2, 0], [1, 1]]), np.array([1.0, 0])
    corners = np.array([[1.0, 1], [-1, 1], [-1, -1], [1, -1]])
    yield corners, np.zeros(2)
    yield corners, np.array([-2.0, 0])
    yield np.array([[3.0, 4]]), np.zeros(2)
    for by in (4e-3, 4e-4):  # nearly as near
        yield np.array([[1 + by, 0], [0, 1 + by / 4]]), np.zeros(2)
    yield np.array([[0.0, 0], [1.3, 1.1], [3, 1]]), np.array([1.3, 1.1])  # itself
    yield np.array([[5.0, 0], [0, 0], [2, 0], [2, 0], [0, 0]]), np.array([1.0, 0])
    # The fourth is nearest, and each of its coordinates is further off than another's.
    yield np.array([[0.0, 9, 9], [9, 0, 9], [9, 9, 0], [2, 2, 2]]), np.zeros(3)
    # Near by way of half a turn, where these joints have their stops.
    yield np.array([[-2.8, 0], [0.5, 0.4]]), np.array([2.7, 0])
    three = np.array([[0.6, 0.1, 0.2], [2.6, -0.3, 0], [1, 0, 0.1]])
    yield three, np.array([-2.8, 0, 0])
    rng = usual(rng)
    for n, k in ((5, 2), (9, 2), (12, 2), (7, 3), (6, 7), (9, 7), (14, 7), (25, 7)) * 2:
        while True:
            tree, q = rng.numbers(-2, 2, n, k), rng.numbers(-2, 2, k)
            if second_best(tree, q) > CLEAR:
                break
        yield tree, q


def found(tree, q):
    """Return whether the nearest node is the root, the last node, or another one."""
    i = nearest(tree, q)
    return "root" if i == 0 else "last" if i == len(tree) - 1 else "other"


def far(tree, q):
    """Return how far the nearest node is away."""
    return float(np.linalg.norm(tree - q, axis=1).min())


row.cases(
    trees_whose_nearest_node_is_the_root=lambda tree, q: found(tree, q) == "root",
    trees_whose_nearest_node_is_the_last=lambda tree, q: found(tree, q) == "last",
    trees_whose_nearest_node_is_another=lambda tree, q: found(tree, q) == "other",
)
row.cases(
    trees_with_one_node_at_q=lambda tree, q: np.sum((tree == q).all(axis=1)) == 1,
    trees_with_a_nearest_node_within_a_distance_of_1=(
        lambda tree, q: 0 < far(tree, q) <= 1
    ),
    trees_with_a_nearest_node_farther_than_1=lambda tree, q: far(tree, q) > 1,
)
row.cases(
    points_with_two_coordinates=lambda tree, q: len(q) == 2,
    points_with_more_than_two_coordinates=lambda tree, q: len(q) > 2,
)


@row.rare
def _(rng):
    for k in (2, 7):
        tree, q = rng.numbers(-2, 2, 6, k), rng.numbers(-2, 2, k)
        for i in (0, 2, 5):
            for share in (0.0, 0.1, 1.0):
                near = tree.copy()
                near[i] = np.round(q + share * (tree[i] - q), 3)
                if second_best(near, q) > CLEAR:
                    yield near, q


def _others(tree, q, far):
    """Return further mistakes of the same table, from the distances."""
    n = len(tree)
    length = np.linalg.norm(tree, axis=1)
    nearer = [i for i in range(1, n) if far[i] < far[0]] or [0]
    before = [i for i in range(1, n) if far[i] < far[i - 1]] or [0]
    rest = int(np.argmin(far[1:])) if n > 1 else 0
    sizes = np.maximum(length * np.linalg.norm(q), 1e-12)
    return {
        "length-for-place": int(np.argmin(np.abs(length - np.linalg.norm(q)))),
        "angle": int(np.argmax(tree @ q / sizes)),
        "second-nearest": int(np.argsort(far, kind="stable")[min(1, n - 1)]),
        "least-not-kept": nearer[-1],
        "row-before": before[-1],
        "first-that-is-nearer": nearer[0],
        "rounded": int(np.argmin(np.round(far, 2))),
        "rounded 2": int(np.argmin(np.round(far, 3))),
        "root-left-out": rest + (n > 1),
        "root-left-out 2": rest,
        "last-left-out": int(np.argmin(far[: max(n - 1, 1)])),
        "over-all-numbers": int(np.argmin((tree - q) ** 2)),
        "sum-of-columns": int(np.argmin(np.sum((tree - q) ** 2, axis=0))),
        "itself-left-out": int(np.argmin(np.where(far > 0, far, np.inf))),
    }


@row.wrongs(hidden={"itself-left-out": "the lab asks for no node's own place"})
def _(tree, q):
    """farthest: your code returns the farthest node. Return the nearest node instead
    newest: your code always returns the last node of the tree. Return the node nearest
      to q instead
    one-coordinate: your code compares only the first coordinate. Use the distance in
      all coordinates
    one-coordinate 2: your code compares only the last coordinate. Use the distance in
      all coordinates
    signed-sum: your code adds the differences with their signs, so positive and
      negative differences can cancel. Add the squares of the differences instead
    signed-sum 2: your code compares the nodes by the square or the absolute value of
      the sum of the differences, so positive and negative differences can cancel.
      Square each difference before you add
    last-of-equals: your code returns the last of several equally near nodes. Return the
      first of them, as `np.argmin` does
    largest-coordinate: your code compares the nodes by their largest absolute
      coordinate difference. Use the Euclidean distance instead
    sum-of-sizes: your code compares the nodes by the sum of the absolute coordinate
      differences. Use the Euclidean distance instead
    wrapped: your code wraps the differences to [-pi, pi]. Omit this step, because q and
      q + 2 pi are different configurations of a joint with limits
    wrapped 2: your code takes the differences modulo 2 pi. Omit this step, because q
      and q + 2 pi are different configurations of a joint with limits
    weighted: your code gives the coordinates different weights. Use the same weight for
      all coordinates
    weighted 2: your code gives the coordinates different weights. Use the same weight
      for all coordinates
    from-the-origin: your code returns the node nearest to the origin. Return the node
      nearest to q instead
    q-added: your code adds q to the nodes. Subtract q from the nodes instead
    most-alike: your code compares the dot products of the nodes with q. Compare the
      distances instead, because a dot product also depends on the norm of the node
    place-of-the-distance: your code returns the rank of the root's distance among all
      distances. Return the index of the smallest distance instead
    counted-from-the-end: your code counts the index from the end of the tree. Count the
      index from the root, which is row 0
    smallest-coordinate: your code compares the nodes by their smallest absolute
      coordinate difference. Use the Euclidean distance instead
    two-coordinates: your code compares only the first two coordinates. Use the distance
      in all coordinates
    first-left-out: your code does not compare the first coordinate. Use the distance in
      all coordinates
    cubed: your code cubes the differences, so positive and negative terms can cancel.
      Square the differences instead
    length-for-place: your code compares the norms of the nodes with the norm of q.
      Compare the distances instead, because two points with the same norm can be far
      apart
    angle: your code selects the node at the smallest angle to q. Select the node at the
      smallest distance instead
    second-nearest: your code returns the second-nearest node. Return the nearest node
      instead
    least-not-kept: your code returns the last node that is nearer to q than the root
      is. Return the nearest of all nodes. In a loop, compare each distance with the
      smallest distance so far
    row-before: your code returns the last node that is nearer to q than the node before
      it. Return the nearest of all nodes. In a loop, compare each distance with the
      smallest distance so far
    first-that-is-nearer: your code returns the first node that is nearer to q than the
      root is. Return the nearest of all nodes
    rounded: your code rounds the distances or their squares before it compares them.
      Omit the rounding, because it can make two different distances equal
    rounded 2: your code rounds the distances or their squares before it compares them.
      Omit the rounding, because it can make two different distances equal
    root-left-out: your code skips the root (row 0). Include the root, because the root
      can be the nearest node
    root-left-out 2: your code skips the root (row 0) and counts the other rows from 0.
      Include the root, whose index is 0
    last-left-out: your code skips the last row. Include this row, because the last node
      can be the nearest
    over-all-numbers: your code selects the smallest of all squared differences. Sum the
      squares along axis 1 first, so that each row has one distance
    sum-of-columns: your code sums the squares along axis 0. Sum the squares along axis
      1 instead, because each row is a node
    itself-left-out: your code skips a node that equals q. Include this node, because
      its distance is 0
    largest-with-sign: your code compares the nodes by their largest signed coordinate
      difference. Use the Euclidean distance instead
    """
    away = tree - q
    far = np.sum(away**2, axis=1)
    n = len(tree)
    k = len(q)
    best = nearest(tree, q)

    def by(differences):
        return int(np.argmin(np.sum(differences**2, axis=1)))

    return {
        "farthest": int(np.argmax(far)),
        "newest": n - 1,
        "one-coordinate": int(np.argmin(np.abs(away[:, 0]))),
        "one-coordinate 2": int(np.argmin(np.abs(away[:, -1]))),
        "signed-sum": int(np.argmin(away.sum(axis=1))),
        "signed-sum 2": int(np.argmin(away.sum(axis=1) ** 2)),
        "last-of-equals": n - 1 - int(np.argmin(far[::-1])),
        "largest-coordinate": int(np.argmin(np.abs(away).max(axis=1))),
        "sum-of-sizes": int(np.argmin(np.abs(away).sum(axis=1))),
        "wrapped": by((away + np.pi) % (2 * np.pi) - np.pi),
        "wrapped 2": by(away % (2 * np.pi)),
        "weighted": by(away * np.linspace(1, 0.5, k)),
        "weighted 2": by(away / np.arange(1, k + 1)),
        "from-the-origin": int(np.argmin(np.sum(tree**2, axis=1))),
        "q-added": int(np.argmin(np.sum((tree + q) ** 2, axis=1))),
        "most-alike": int(np.argmax(tree @ q)),
        "place-of-the-distance": int(np.argsort(np.argsort(far))[0]),
        "counted-from-the-end": n - 1 - best,
        "smallest-coordinate": int(np.argmin(np.abs(away).min(axis=1))),
        "two-coordinates": by(away[:, :2]),
        "first-left-out": by(away[:, 1:]),
        "cubed": int(np.argmin(np.sum(away**3, axis=1))),
        "largest-with-sign": int(np.argmin(away.max(axis=1))),
        **_others(tree, q, np.sqrt(far)),
    }


@row.right  # By a loop over norms.
def _(tree, q):
    best = 0
    for i, node in enumerate(tree):
        if np.linalg.norm(node - q) < np.linalg.norm(tree[best] - q):
            best = i
    return best


@row.right  # Without differences.
def _(tree, q):
    return int(np.argmin(np.hypot.reduce(np.abs(tree - q), axis=1)))


row.at_least_0(answer="an index")


row.spans(  # as small, or as large, as in the lab
    q=(lambda q: 0.005 * q,),
)
