"""12.5 `shortcut(path, world, pairs)`: its questions and its mistakes."""

from functools import partial
from itertools import pairwise

import numpy as np

from labkit.judge import Row, Waypoints
from labkit.judge.worlds import Balls
from robo47.planning import edge_free, shortcut

from .cuts import cut, of_a_cut
from .ways import ASKS, FLOOR, NONE, Careful, discs, usual

row = Row(
    Waypoints((None, 2)),
    at_edge=lambda *call: False,
    unnamed=of_a_cut,
    slips=(ASKS,),
    each_case=100,
)


def blocked(path, world, pairs):
    """Return whether some pair names an edge that is not free."""
    free = len(shortcut(path, NONE, pairs))
    return len(shortcut(path, world, pairs)) > free


row.cases(
    calls_without_a_pair=lambda path, world, pairs: not len(pairs),
    calls_with_one_pair=lambda path, world, pairs: len(pairs) == 1,
    calls_with_several_pairs=lambda path, world, pairs: len(pairs) > 1,
)
row.cases(
    pairs_in_ascending_order=(
        lambda path, world, pairs: bool(np.all(pairs[:, 0] <= pairs[:, 1]))
    ),
    pairs_in_descending_order=(
        lambda path, world, pairs: bool(np.any(pairs[:, 0] > pairs[:, 1]))
    ),
)
row.cases(
    worlds_that_block_no_pair=lambda *call: not blocked(*call),
    worlds_that_block_a_pair=blocked,
)


@row.rare
def _(rng):
    rng = usual(rng)
    turn = np.cumsum(rng.uniform(-0.7, 0.7, 9))
    steps = 0.3 * np.column_stack([np.cos(turn), np.sin(turn)])
    path = np.round(np.cumsum(steps, axis=0) - [1.2, 0], 3)
    for n in (0, 1, 1, 5):
        pairs = rng.numbers(0, 0.999, n, 2)
        for world in (NONE, discs(rng, 3, 0.1, 0.3)):
            careful = Careful(world)
            for some in (pairs, np.sort(pairs, axis=1)):
                shortcut(path, careful, some)
                if careful.clear:
                    yield path, world, some


@row.inputs
def _(rng):
    path = np.array([[0.0, 0], [0, 1], [1, 1], [2, 1], [2, 0]])
    post = np.array([[1.0, 0, 0.5]])
    yield path, post, np.array([[0.1, 0.9], [0, 0.5], [0.3, 0.99]])
    yield path, post, np.empty((0, 2))
    yield path, Balls(post), np.array([[0.1, 0.9], [0, 0.5], [0.3, 0.99]])
    yield path * [1, -0.5] - [0, -0.1], FLOOR, np.array([[0.3, 0.7], [0.1, 0.5]])
    yield path, FLOOR, np.array([[0.1, 0.9], [0, 0.5], [0.3, 0.99]])
    yield path, NONE, np.array([[0.9, 0.1]])  # the other way round, and to the end
    yield path, NONE, np.array([[0.3, 0.35], [0.45, 0.79]])  # neighbours, and the same
    yield path[:2], NONE, np.array([[0.1, 0.9]])
    yield path[:3], NONE, np.array([[0.1, 0.9]])
    yield path, np.array([[1.0, 0.5, 0.9]]), np.array([[0.1, 0.9], [0, 0.5]])
    line = np.array(
        [[0.1, 0], [1, 0], [2, 1], [3, 0], [4, 0], [5, 1], [6, 0], [7, 0.0]]
    )
    # Cut, cut, neighbours, cut; and neighbours first.
    yield line, NONE, np.array([[0, 0.3], [0.5, 0.8], [0.1, 0.2], [0.99, 0.5]])
    yield line, NONE, np.array([[0.1, 0.2], [0.05, 0.3], [0.5, 0.75]])
    rng = usual(rng)
    for m, n, p in (
        (8, 3, 1),
        (9, 3, 4),
        (12, 4, 6),
        (15, 3, 12),
        (20, 4, 20),
        (11, 5, 8),
    ):
        while True:
            world = Careful(discs(rng, n, 0.1, 0.3))
            turn = np.cumsum(rng.uniform(-0.7, 0.7, m))
            steps = 0.3 * np.column_stack([np.cos(turn), np.sin(turn)])
            zigzag = np.round(np.cumsum(steps, axis=0) - [1.2, 0], 3)
            pairs = rng.numbers(0, 0.999, p, 2)
            found = shortcut(zigzag, world, pairs)
            if world.clear and len(found) < m and _blocked(zigzag, world.discs, pairs):
                break
        yield zigzag, world.discs, pairs


def _blocked(path, world, pairs):
    """Return whether a disc keeps one of several pairs from cutting."""
    free = len(shortcut(path, NONE, pairs))
    return len(pairs) == 1 or len(shortcut(path, world, pairs)) > free


@row.valid(
    "Your paths are valid and shorter, but the specified method makes different "
    "shortcuts."
)
def _(path, world, pairs, answer):
    at = [int(np.argmin(np.abs(path - x).max(axis=1))) for x in answer]
    if not np.array_equal(path[at], answer) or at[:1] + at[-1:] != [0, len(path) - 1]:
        return False
    ways = list(pairwise(at))
    cuts = [(i, j) for i, j in ways if j > i + 1]
    free = all(edge_free(path[i], path[j], world) for i, j in cuts)
    return free and bool(cuts) and all(i < j for i, j in ways)


@row.wrongs
def _(path, world, pairs):
    """not-checked: your code removes rows without testing the new edge. Remove the rows
      only if the new edge is free
    one-node-short: your code also removes row j. Keep row j, because the tested edge
      ends there
    one-node-short 2: your code also removes row i. Keep row i, because the tested edge
      begins there
    one-too-many: your code keeps the row before j. Remove all rows between i and j
    end-lost: your code removes the last row of the path with each shortcut. Keep the
      last row
    first-cut-only: your code stops after the first shortcut. Try all pairs
    indices-of-the-first-path: your code takes the two rows of each pair from the
      original path. Use the rows of the current path instead
    indices-of-the-first-path 2: your code computes the indices from the number of rows
      of the original path, but it applies them to the current path. Use the number of
      rows of the current path instead
    not-sorted: your code skips a pair if its first row is the later one. Sort the two
      rows instead
    rounded: your code rounds `u * m` to the nearest integer. Use `int(u * m)` instead,
      which rounds down
    rounded 2: your code rounds `u * (m - 1)` to the nearest integer. Use `int(u * m)`
      instead, which gives every row the same probability
    of-m-minus-one: your code multiplies u by `m - 1`. Use `int(u * m)` instead, which
      gives every row the same probability
    neighbours-too: your code also removes row i, even if the two rows are neighbours.
      Keep row i, and leave neighbouring rows unchanged
    two-apart-left: your code skips pairs of waypoints whose indices differ by 2. Test
      these pairs too, because the waypoint between them may be removable
    hit-for-free: your code applies only shortcuts whose edge is blocked. Apply a
      shortcut only if its edge is free
    unchanged: your code returns the original path. Apply each shortcut whose edge is
      free
    all-but-the-ends: your code returns only the start and the end of the path. Remove a
      row only if a shortcut with a free edge skips it
    only-the-ends-checked: your code tests only the endpoints of the new edge. Test the
      whole edge between rows i and j
    middle-checked: your code tests only the midpoint of the new edge. Test the whole
      edge
    reversed: your code reverses the path. Keep the order of the waypoints
    ends-at-i: your code returns only the path up to row i. Append the path from row j
      on
    """
    none = np.empty((0, 2))

    def later(*some, **how):
        return partial(cut, path, world, pairs, *some, **how)

    def early(p, i, j):
        return np.vstack([p[:i], p[j:]])

    def late(p, i, j):
        return np.vstack([p[: i + 1], p[j + 1 :]])

    def ends(a, b, world):
        return edge_free(a, a, world) and edge_free(b, b, world)

    def middle(a, b, world):
        return edge_free((a + b) / 2, (a + b) / 2, world)

    def hit(a, b, world):
        return not edge_free(a, b, world)

    def halved(pair, m):
        return [int(u * (m - 1)) for u in pair]

    return {
        "not-checked": shortcut(path, none[:, [0, 0, 0]], pairs),
        "one-node-short": later(join=late),
        "one-node-short 2": later(join=early),
        "one-too-many": later(join=lambda p, i, j: np.vstack([p[: i + 1], p[j - 1 :]])),
        "end-lost": later(join=lambda p, i, j: np.vstack([p[: i + 1], p[j:-1]])),
        "first-cut-only": later(ends="cut"),
        "indices-of-the-first-path": later(fixed="mask"),
        "indices-of-the-first-path 2": later(fixed="clamped"),
        "not-sorted": later(order=list),
        "rounded": later(lambda pair, m: [round(u * m) for u in pair]),
        "rounded 2": later(lambda pair, m: [round(u * (m - 1)) for u in pair]),
        "of-m-minus-one": later(halved),
        "neighbours-too": later(
            least=0, join=lambda p, i, j: np.vstack([p[:i], p[j:]])
        ),
        "two-apart-left": later(least=2),
        "hit-for-free": later(check=hit),
        "unchanged": path,
        "all-but-the-ends": path[[0, -1]],
        "only-the-ends-checked": later(check=ends),
        "middle-checked": later(check=middle),
        "reversed": shortcut(path, world, pairs)[::-1],
        "ends-at-i": later(join=lambda p, i, j: p[: i + 1]),
    }


@row.wrong("not-sorted+not-checked")
def _(path, world, pairs):
    return cut(path, world, pairs, order=list, check=lambda a, b, world: True)


@row.right  # A list, cut in place.
def _(path, world, pairs):
    points = list(path)
    for u, v in pairs:
        m = len(points)
        i, j = min(int(u * m), int(v * m)), max(int(u * m), int(v * m))
        if j > i + 1 and edge_free(points[i], points[j], world):
            del points[i + 1 : j]
    return np.array(points)


row.at_least_0(pairs="parts of a path")

row.same(
    "if j - i > 1 and edge_free(path[i], path[j], world): => "
    "if j - i > 0.5 * 1 and edge_free(path[i], path[j], world):",
    "between neighbours there is nothing to cut",
)
