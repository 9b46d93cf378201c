"""Sampling-based path planning, and the time-optimal motion along a path.

RRT-Connect with shortcutting, the confidence interval of a success rate, the torques
along a path, and time-optimal path parameterisation (TOPP). A planner knows the world
only through its collision checker, so verify its paths with an independent check.
Conventions:

- A configuration is a row of k numbers: (x, y) in the plane, joint angles of an arm.
- An edge is a straight segment between two configurations.
- A world is an array of discs (x, y, radius), or a collision checker: any object with a
  method `edge_free(a, b)` that returns whether the edge from a to b is collision-free.
- Random numbers are arguments: the samples of a planner, the pairs of a shortcut.
- A path q(s), s from 0 to 1, has the derivatives dq_ds = dq/ds and d2q_ds2 = d2q/ds2.
  The path speed sd is ds/dt, sdd is its time derivative, and sd2 = sd^2.
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

Z_95 = 1.96  # standard deviations that contain 95 % of a normal distribution
BISECTIONS = 60  # halve an interval to the last bit of float64 and beyond


@runtime_checkable
class CollisionChecker(Protocol):
    """A world that tests edges by its own method."""

    def edge_free(self, a: Array, b: Array) -> bool:
        """Return whether the edge from a to b is collision-free."""
        ...


World = ArrayLike | CollisionChecker


def nearest(tree: ArrayLike, q: ArrayLike) -> int:
    """Return the index of the node that is nearest to q, the first of equal ones.

    Args:
        tree: nodes, (n, k).
        q: configuration, (k,).

    Returns:
        The row of the node, from 0. The distance is Euclidean.
    """
    tree = checks.array(tree, "tree", ("n", "k"))
    return _nearest(tree, checks.array(q, "q", (tree.shape[-1],)))


def steer(q: ArrayLike, target: ArrayLike, step: float) -> Array:
    """Return the point at the distance `step` from q on the segment to the target.

    Args:
        q: configuration, (k,).
        target: configuration, (k,).
        step: length of the step in the units of q, above 0.

    Returns:
        (k,). If the target is not further away than a step, this is a copy of the
        target with exactly its numbers.
    """
    q, target = checks.same_size(q=q, target=target)
    return _steer(q, target, float(checks.positive(step, "step")))


def segment_free_of_discs(a: ArrayLike, b: ArrayLike, discs: ArrayLike) -> bool:
    """Return whether the straight edge from a to b is collision-free.

    The point of the edge that is nearest to a centre is the foot of the perpendicular,
    clamped to the edge.

    Args:
        a: (2,).
        b: (2,); it may equal a.
        discs: rows (x, y, radius), (m, 3); m may be 0.

    Returns:
        True or False. An edge that touches a disc is not collision-free.
    """
    a = checks.array(a, "a", (2,))
    b = checks.array(b, "b", (2,))
    return _disc_edge_free(a, b, _discs(discs))


def edge_free(a: ArrayLike, b: ArrayLike, world: World) -> bool:
    """Return whether the straight edge from a to b is collision-free in this world.

    Args:
        a: configuration, (k,).
        b: configuration, (k,).
        world: discs (m, 3), or a collision checker with a method `edge_free(a, b)`.

    Returns:
        True or False.
    """
    a, b = checks.same_size(a=a, b=b)
    return _edge_free(a, b, _world(world))


def extend(
    tree: ArrayLike, sample: ArrayLike, step: float, world: World
) -> tuple[int, Array, bool]:
    """Return the extension of a tree towards a sample: (index, point, free).

    Args:
        tree: nodes, (n, k).
        sample: configuration, (k,).
        step: largest length of an edge, above 0.
        world: discs (m, 3), or a collision checker with a method `edge_free(a, b)`.

    Returns:
        The row of the nearest node; the point one step from it towards the sample,
        (k,); whether the edge between the two is collision-free.
    """
    tree = checks.array(tree, "tree", ("n", "k"))
    sample = checks.array(sample, "sample", (tree.shape[-1],))
    step = float(checks.positive(step, "step"))
    return _extend(tree, sample, step, _world(world))


def rrt_connect(
    start: ArrayLike, goal: ArrayLike, world: World, samples: ArrayLike, step: float
) -> Array:
    """Return a path from start to goal by RRT-Connect (Kuffner and LaValle, 2000).

    The samples 0, 2, 4, ... grow the start's tree by one edge each, the samples 1, 3,
    ... the goal's tree. If the edge is collision-free, the other tree grows towards the
    new node, edge after edge, until an edge collides or the two trees meet at that
    node. Then the path is found.

    Args:
        start: configuration, (k,).
        goal: configuration, (k,).
        world: discs (m, 3), or a collision checker with a method `edge_free(a, b)`.
        samples: configurations, used in their order, (n, k).
        step: largest length of an edge, above 0.

    Returns:
        The path from start to goal, (m, k); (0, k) if these samples find none.
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
    """Return the path after shortcutting: unnecessary waypoints are removed.

    Each pair (u, v) names the rows int(u m) and int(v m) of the path, where m is its
    number of rows at that moment. If these rows are more than one apart and the edge
    between them is collision-free, all rows between them are removed.

    Args:
        path: waypoints, (m, k).
        world: discs (m, 3), or a collision checker with a method `edge_free(a, b)`.
        pairs: numbers from 0 to below 1, in any order, (p, 2).

    Returns:
        The shorter path with the same ends, (m', k).
    """
    path = checks.array(path, "path", ("m", "k"))
    world = _world(world)
    pairs = _rows(pairs, "pairs", 2)
    if not np.all((pairs >= 0.0) & (pairs < 1.0)):
        raise ValueError(
            "pairs must be from 0 to below 1: fractions of the path's rows"
        )
    for pair in pairs:
        i, j = sorted((pair * len(path)).astype(int))
        if j - i > 1 and _edge_free(path[i], path[j], world):
            path = np.vstack([path[: i + 1], path[j:]])
    return path.copy()


def wilson_interval(successes: float, n: float) -> Array:
    """Return Wilson's 95 % confidence interval for a success rate (Wilson, 1927).

    The ends are the roots p of (p - k/n)^2 = z^2 p (1 - p) / n, with z = 1.96.

    Args:
        successes: number k of successful trials, from 0 to n.
        n: number of trials; without a trial the interval is (0, 1).

    Returns:
        The lower and the upper endpoint, (2,).
    """
    n = float(checks.not_negative(n, "n"))
    k = float(checks.not_negative(successes, "successes"))
    if k > n:
        raise ValueError(f"successes is {k:g} of {n:g} trials; expected 0 to {n:g}")
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
    """Return a, b and c of the torques along a path: tau = a sdd + b sd^2 + c.

    q(s) gives qd = dq_ds sd and qdd = dq_ds sdd + d2q_ds2 sd^2, and the Coriolis torque
    is quadratic in qd (MR section 9.4).

    Args:
        M: mass matrix at q(s), kg m^2, (k, k).
        dq_ds: dq/ds, rad, (k,).
        d2q_ds2: d2q/ds2, rad, (k,).
        coriolis: Coriolis torque at qd = dq_ds, N m, (k,).
        gravity: gravity torque, N m, (k,).

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
    """Return the lower and the upper bound of the path acceleration sdd at a speed sd.

    Between them all torques a sdd + b sd^2 + c are within their limits.

    Args:
        a: `path_dynamics`' a at one point, N m, (k,).
        b: its b, N m, (k,).
        c: its c, the gravity torque, N m, (k,).
        limits: torque limits, the same in both directions, N m, (k,), above 0.
        sd: path speed ds/dt, 1/s.

    Returns:
        1/s^2, (2,). If the lower bound is above the upper one, no sdd is permitted. A
        joint with a = 0 bounds nothing; (inf, -inf) if its torque exceeds its limit.
    """
    a, b, c, limits = checks.same_size(a=a, b=b, c=c, limits=limits)
    checks.positive(limits, "limits")
    speed = float(checks.array(sd, "sd", ()))
    return np.array(_range(a, b * speed**2 + c, limits))


def time_optimal_profile(
    a: ArrayLike, b: ArrayLike, c: ArrayLike, limits: ArrayLike, sd2_max: ArrayLike
) -> Array:
    """Return sd^2 of the time-optimal motion along a path, from rest to rest.

    Over a step ds = 1/N with sdd = u, sd^2 grows by 2 ds u. The backward pass computes
    the largest sd^2 from which the motion can still stop at the end, the forward pass
    the largest sd^2 below it that the torques permit (Pham and Pham, 2018).

    Args:
        a: `path_dynamics`' a at N + 1 points, N m, (N + 1, k).
        b: its b, N m, (N + 1, k).
        c: its c, N m, (N + 1, k).
        limits: torque limits, the same in both directions, N m, (k,), above 0.
        sd2_max: largest sd^2 that the velocity limits permit, 1/s^2, (N + 1,).

    Returns:
        sd^2, 1/s^2, (N + 1,); zeros if gravity alone exceeds a limit at any point.
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
    """Return the travel time of a path with sd^2 = sd2 at equally spaced points.

    sdd is constant over a step, so the mean speed of a step is the mean of the speeds
    at its ends.

    Args:
        sd2: sd^2 at N + 1 points, 1/s^2, (N + 1,).

    Returns:
        s; infinity if the motion rests over a whole step.
    """
    sd = np.sqrt(checks.not_negative(checks.array(sd2, "sd2", ("n",)), "sd2"))
    ends = sd[1:] + sd[:-1]
    if np.any(ends == 0.0):
        return math.inf
    return float(np.sum(2.0 / (len(sd) - 1) / ends))


def _nearest(tree: Array, q: Array) -> int:
    away = tree - q
    return int((away * away).sum(axis=1).argmin())


def _steer(q: Array, target: Array, step: float) -> Array:
    away = target - q
    distance = math.sqrt(away @ away)
    return target.copy() if distance <= step else q + step / distance * away


def _disc_edge_free(a: Array, b: Array, discs: Array) -> bool:
    along = b - a
    to_centres = discs[:, :2] - a
    squared = along @ along
    part = to_centres @ along / squared if squared > 0.0 else np.zeros(len(discs))
    foot = np.minimum(np.maximum(part, 0.0), 1.0)[:, None] * along
    away = to_centres - foot
    return bool(np.all(np.sqrt(np.sum(away * away, axis=1)) > discs[:, 2]))


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
    """Add a node towards the target if the edge is collision-free; return whether."""
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
    """Return the bounds of u with |a u + rest| <= limits for every joint."""
    low, high = -math.inf, math.inf
    for pull, other, limit in zip(
        a.tolist(), rest.tolist(), limits.tolist(), strict=True
    ):  # for seven joints, plain numbers take a fifth of the time of arrays
        if pull == 0.0:
            if abs(other) > limit:
                return math.inf, -math.inf
            continue
        middle, around = -other / pull, limit / abs(pull)
        low, high = max(low, middle - around), min(high, middle + around)
    return low, high


def _reaches_next(
    a: Array, b: Array, g: Array, limits: Array, top: float, after: float, two_ds: float
) -> float:
    """Return the largest sd^2 = x up to `top` from which 0 to `after` can be reached.

    All limits are linear in (x, sdd), so these x form an interval. It contains 0,
    because the arm can stand still.
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
    if isinstance(world, np.ndarray):  # a protocol takes its time to say no
        return _discs(world)
    return world if isinstance(world, CollisionChecker) else _discs(world)
