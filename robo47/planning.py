"""Finding a way: a random tree, a checker of edges, and how fast a path may be run.

A planner is a search with a checker: it knows of the world what the checker says of
an edge, and nothing else. How often it finds a way is a share, and a share has an
interval. A path becomes a motion when each torque's limit is divided by what it has to
move.
Conventions:

- A configuration is a row of k numbers: (x, y) in the plane, joint angles of an arm.
- A world is an array of discs (x, y, radius), or anything with a method
  `edge_free(a, b)` that says whether the straight edge from a to b is free.
- What is random is an argument: samples of a planner, pairs of a shortcut.
- A path q(s), s from 0 to 1, has dq_ds = dq/ds and d2q_ds2 = d2q/ds2; its
  speed sd is ds/dt, and sd2 = sd^2. Time is not in it.
- Radians, metres, seconds, N m.

Sources: Kuffner and LaValle, "RRT-Connect: an efficient approach to single-query path
planning" (2000); LaValle, *Planning Algorithms* (2006), section 5.5; Brown, Cai and
DasGupta, "Interval estimation for a binomial proportion" (2001); Lynch and Park,
*Modern Robotics*, section 9.4; Pham and Pham, "A new approach to time-optimal path
parameterization based on reachability analysis" (2018).
"""

import math
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array

Z_95 = 1.96  # a normal number lies within it 95 times in 100
BISECTIONS = 60  # halve an interval to the last bit of float64 and beyond


@runtime_checkable
class CollisionChecker(Protocol):
    """A world of one's own: it says whether a straight edge is free."""

    def edge_free(self, a: Array, b: Array) -> bool:
        """Return whether the edge from a to b is free."""
        ...


World = ArrayLike | CollisionChecker


def nearest(tree: ArrayLike, q: ArrayLike) -> int:
    """Return which node of the tree is nearest to q; the first of equals.

    Args:
        tree: nodes, (n, k).
        q: (k,).

    Returns:
        Its row, from 0.
    """
    tree = checks.array(tree, "tree", ("n", "k"))
    return _nearest(tree, checks.array(q, "q", (tree.shape[-1],)))


def steer(q: ArrayLike, target: ArrayLike, step: float) -> Array:
    """Return the point on the way from q to the target, no further than a step.

    Args:
        q: (k,).
        target: (k,).
        step: the length of a step, in the units of q, above 0.

    Returns:
        (k,): a copy of the target, to the last bit, where it is no further away.
    """
    q, target = checks.same_size(q=q, target=target)
    return _steer(q, target, float(checks.positive(step, "step")))


def segment_free_of_discs(a: ArrayLike, b: ArrayLike, discs: ArrayLike) -> bool:
    """Return whether the straight edge from a to b touches no disc.

    A disc's nearest point of the edge is the foot of its centre, or an end.

    Args:
        a: (2,).
        b: (2,); it may be a.
        discs: rows (x, y, radius), (m, 3), also none. Touching is not free.

    Returns:
        True or False.
    """
    a = checks.array(a, "a", (2,))
    b = checks.array(b, "b", (2,))
    return _disc_edge_free(a, b, _discs(discs))


def edge_free(a: ArrayLike, b: ArrayLike, world: World) -> bool:
    """Return whether the straight edge from a to b is free in this world.

    Args:
        a: (k,).
        b: (k,).
        world: discs (m, 3), or what has a method `edge_free(a, b)`.

    Returns:
        True or False.
    """
    a, b = checks.same_size(a=a, b=b)
    return _edge_free(a, b, _world(world))


def extend(
    tree: ArrayLike, sample: ArrayLike, step: float, world: World
) -> tuple[int, Array, bool]:
    """Return how a tree would grow towards a sample: from where, to where, and if free.

    Args:
        tree: nodes, (n, k).
        sample: (k,).
        step: of an edge at most, above 0.
        world: discs (m, 3), or what has a method `edge_free(a, b)`.

    Returns:
        The row of the nearest node; the point a step from it towards the sample, (k,);
        whether the edge between the two is free.
    """
    tree = checks.array(tree, "tree", ("n", "k"))
    sample = checks.array(sample, "sample", (tree.shape[-1],))
    step = float(checks.positive(step, "step"))
    return _extend(tree, sample, step, _world(world))


def rrt_connect(
    start: ArrayLike, goal: ArrayLike, world: World, samples: ArrayLike, step: float
) -> Array:
    """Return a way from start to goal, found by two trees (Kuffner, LaValle, 2000).

    Sample 0, 2, 4, ... grows the tree of the start, sample 1, 3, ... that of the goal,
    by one edge, if it is free. Then the other tree grows towards the new node, edge
    after edge, until one is not free or it stands at that very node: the way is found.

    Args:
        start: (k,).
        goal: (k,).
        world: discs (m, 3), or what has a method `edge_free(a, b)`.
        samples: drawn by the caller and used in order, (n, k).
        step: of an edge at most, above 0.

    Returns:
        The way from start to goal, (m, k); (0, k) if these samples find none.
    """
    start, goal = checks.same_size(start=start, goal=goal)
    samples = _rows(samples, "samples", start.size)
    step = float(checks.positive(step, "step"))
    world = _world(world)
    trees = ([start], [goal])
    parents: tuple[list[int], list[int]] = ([-1], [-1])
    for i, sample in enumerate(samples):
        grown, other = i % 2, 1 - i % 2
        if not _grow(trees[grown], parents[grown], sample, step, world):
            continue
        new = trees[grown][-1]
        while _grow(trees[other], parents[other], new, step, world):
            if np.array_equal(trees[other][-1], new):
                ways = [
                    _to_root(nodes, up)
                    for nodes, up in zip(trees, parents, strict=True)
                ]
                return np.array(ways[0][::-1] + ways[1][1:])
    return np.empty((0, start.size))


def shortcut(path: ArrayLike, world: World, pairs: ArrayLike) -> Array:
    """Return a path without the corners that a straight free edge can leave out.

    Each pair (u, v) names two points of the path as it is by then: rows int(u m) and
    int(v m) of its m. If they are more than one apart and the edge between them is
    free, what lies between them goes.

    Args:
        path: (m, k).
        world: discs (m, 3), or what has a method `edge_free(a, b)`.
        pairs: of numbers from 0 to below 1, in any order, (p, 2).

    Returns:
        The shorter path, with the same ends, (m', k).
    """
    path = checks.array(path, "path", ("m", "k"))
    world = _world(world)
    pairs = _rows(pairs, "pairs", 2)
    if not np.all((pairs >= 0.0) & (pairs < 1.0)):
        raise ValueError("pairs are from 0 to below 1: parts of the path's length")
    for pair in pairs:
        i, j = sorted((pair * len(path)).astype(int))
        if j - i > 1 and _edge_free(path[i], path[j], world):
            path = np.vstack([path[: i + 1], path[j:]])
    return path.copy()


def wilson_interval(successes: float, n: float) -> Array:
    """Return all shares that n trials make believable, at 95 % (Wilson, 1927).

    The roots p of (p - k/n)^2 = z^2 p (1 - p) / n, with z = 1.96.

    Args:
        successes: k of the n, from 0 to n.
        n: trials; with none every share is believable.

    Returns:
        The least and the greatest share, (2,).
    """
    n = float(checks.not_negative(n, "n"))
    k = float(checks.not_negative(successes, "successes"))
    if k > n:
        raise ValueError(f"{k:g} successes of {n:g} trials; there cannot be more")
    if n == 0.0:
        return np.array([0.0, 1.0])
    middle = k + Z_95**2 / 2.0
    around = Z_95 * math.sqrt(k * (n - k) / n + Z_95**2 / 4.0)
    return np.array([middle - around, middle + around]) / (n + Z_95**2)


def path_dynamics(
    M: ArrayLike,
    dq_ds: ArrayLike,
    d2q_ds2: ArrayLike,
    coriolis: ArrayLike,
    gravity: ArrayLike,
) -> Array:
    """Return what torque a point of a path asks for: tau = a sdd + b sd^2 + c.

    q(s) gives qd = dq_ds sd and qdd = dq_ds sdd + d2q_ds2 sd^2; Coriolis torques are
    quadratic in qd (MR section 9.4).

    Args:
        M: mass matrix at q(s), (k, k).
        dq_ds: dq/ds, rad, (k,).
        d2q_ds2: d2q/ds2, rad, (k,).
        coriolis: its torque at qd = dq_ds, N m, (k,).
        gravity: its torque, N m, (k,).

    Returns:
        Rows a, b and c, N m, (3, k).
    """
    dq_ds, d2q_ds2, coriolis, gravity = checks.same_size(
        dq_ds=dq_ds, d2q_ds2=d2q_ds2, coriolis=coriolis, gravity=gravity
    )
    M = checks.array(M, "M", (dq_ds.size, dq_ds.size))
    return np.array([M @ dq_ds, M @ d2q_ds2 + coriolis, gravity])


def path_accel_bounds(
    a: ArrayLike, b: ArrayLike, c: ArrayLike, limits: ArrayLike, sd: float
) -> Array:
    """Return the least and the greatest sdd that all torques allow at a speed sd.

    Args:
        a: N m per sdd, (k,).
        b: N m per sd^2, (k,).
        c: N m, (k,).
        limits: of each torque, both ways, N m, (k,), above 0.
        sd: ds/dt, 1/s.

    Returns:
        1/s^2, (2,). Where the first is above the second, none is allowed. A joint with
        a = 0 limits nothing; (inf, -inf) if it cannot hold its torque.
    """
    a, b, c, limits = checks.same_size(a=a, b=b, c=c, limits=limits)
    checks.positive(limits, "limits")
    speed = float(checks.array(sd, "sd", ()))
    return np.array(_range(a, b * speed**2 + c, limits))


def time_optimal_profile(
    a: ArrayLike, b: ArrayLike, c: ArrayLike, limits: ArrayLike, sd2_max: ArrayLike
) -> Array:
    """Return sd^2 of the fastest motion along a path, from rest to rest.

    Over a step ds = 1/N with sdd = u, sd^2 grows by 2 ds u. Backwards: the greatest
    sd^2 from which the next one can be reached. Forwards: as much as the joints give
    below it (Pham and Pham, 2018).

    Args:
        a: `path_dynamics`' a at N + 1 points, N m, (N + 1, k).
        b: its b, N m, (N + 1, k).
        c: its c, N m, (N + 1, k).
        limits: of each torque, both ways, N m, (k,), above 0.
        sd2_max: greatest sd^2 that the motors' speeds allow, 1/s^2, (N + 1,).

    Returns:
        sd^2, 1/s^2, (N + 1,); zeros where gravity alone is too much at some point.
    """
    a = checks.array(a, "a", ("n", "k"))
    b = checks.array(b, "b", a.shape)
    c = checks.array(c, "c", a.shape)
    limits = checks.positive(checks.array(limits, "limits", a.shape[1:]), "limits")
    top = checks.not_negative(checks.array(sd2_max, "sd2_max", a.shape[:1]), "sd2_max")
    if len(a) < 2 or np.any(np.abs(c) > limits):
        return np.zeros(len(a))
    two_ds = 2.0 / (len(a) - 1)
    most = np.zeros(len(a))
    for i in range(len(a) - 2, -1, -1):
        most[i] = _reaches_next(a[i], b[i], c[i], limits, top[i], most[i + 1], two_ds)
    x = np.zeros(len(a))
    for i in range(len(a) - 1):
        _, up = _range(a[i], b[i] * x[i] + c[i], limits)
        x[i + 1] = max(0.0, min(most[i + 1], x[i] + two_ds * up))
    return x


def travel_time(sd2: ArrayLike) -> float:
    """Return how long a path takes whose sd^2 at N + 1 even points is sd2.

    sdd is constant over a step, so its mean speed is that of its ends.

    Args:
        sd2: sd^2, 1/s^2, (N + 1,).

    Returns:
        s; infinity where it stands still.
    """
    sd = np.sqrt(checks.not_negative(checks.array(sd2, "sd2", ("n",)), "sd2"))
    ends = sd[1:] + sd[:-1]
    if np.any(ends == 0.0):
        return math.inf
    return float(np.sum(2.0 / (len(sd) - 1) / ends))


def _nearest(tree: Array, q: Array) -> int:
    return int(np.argmin(np.sum((tree - q) ** 2, axis=1)))


def _steer(q: Array, target: Array, step: float) -> Array:
    away = target - q
    distance = math.sqrt(away @ away)
    return target.copy() if distance <= step else q + step / distance * away


def _disc_edge_free(a: Array, b: Array, discs: Array) -> bool:
    along = b - a
    to_centres = discs[:, :2] - a
    squared = along @ along
    part = to_centres @ along / squared if squared > 0.0 else np.zeros(len(discs))
    foot = np.clip(part, 0.0, 1.0)[:, None] * along
    gaps = np.linalg.norm(to_centres - foot, axis=1)
    return bool(np.all(gaps > discs[:, 2]))


def _edge_free(a: Array, b: Array, world: Array | CollisionChecker) -> bool:
    if isinstance(world, np.ndarray):
        return _disc_edge_free(a, b, world)
    return bool(world.edge_free(a, b))


def _extend(
    tree: Array, sample: Array, step: float, world: Array | CollisionChecker
) -> tuple[int, Array, bool]:
    i = _nearest(tree, sample)
    q = _steer(tree[i], sample, step)
    return i, q, _edge_free(tree[i], q, world)


def _grow(
    nodes: list[Array],
    parents: list[int],
    target: Array,
    step: float,
    world: Array | CollisionChecker,
) -> bool:
    """Add a node towards the target if the edge is free; return whether it was."""
    i, q, free = _extend(np.array(nodes), target, step, world)
    if free:
        nodes.append(q)
        parents.append(i)
    return free


def _to_root(nodes: list[Array], parents: list[int]) -> list[Array]:
    """Return the nodes from the newest one to its tree's root."""
    i = len(nodes) - 1
    way = []
    while i >= 0:
        way.append(nodes[i])
        i = parents[i]
    return way


def _range(a: Array, rest: Array, limits: Array) -> tuple[float, float]:
    """Return the least and greatest u with |a u + rest| <= limits for every joint."""
    pulls = a != 0.0
    if np.any(np.abs(rest[~pulls]) > limits[~pulls]):
        return math.inf, -math.inf
    if not pulls.any():
        return -math.inf, math.inf
    middle = -rest[pulls] / a[pulls]
    around = limits[pulls] / np.abs(a[pulls])
    return float(np.max(middle - around)), float(np.min(middle + around))


def _reaches_next(
    a: Array, b: Array, g: Array, limits: Array, top: float, after: float, two_ds: float
) -> float:
    """Return the greatest x up to `top` from which 0 to `after` can be reached.

    All limits are straight lines in (x, sdd), so these x are an interval, and the arm
    can stand still: 0 is one of them.
    """

    def reached(x: float) -> bool:
        down, up = _range(a, b * x + g, limits)
        return down <= up and x + two_ds * down <= after and x + two_ds * up >= 0.0

    if reached(top):
        return top
    good, bad = 0.0, top
    for _ in range(BISECTIONS):
        half = (good + bad) / 2.0
        good, bad = (half, bad) if reached(half) else (good, half)
    return good


def _rows(value: ArrayLike, name: str, k: int) -> Array:
    """Return rows of k numbers, perhaps none, (n, k)."""
    rows = checks.array(value, name, ())
    if rows.size == 0:
        return np.empty((0, k))
    rows = checks.array(rows, name, (k,))
    if rows.ndim != 2:
        raise ValueError(f"{name} has shape {rows.shape}; expected (n, {k})")
    return rows


def _discs(value: ArrayLike) -> Array:
    discs = _rows(value, "discs", 3)
    checks.not_negative(discs[:, 2], "a disc's radius")
    return discs


def _world(world: World) -> Array | CollisionChecker:
    """Return a world of discs as an array, and any other as it is."""
    return world if isinstance(world, CollisionChecker) else _discs(world)
