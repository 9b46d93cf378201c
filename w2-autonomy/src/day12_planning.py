"""Day 12: path planning, and the fastest motion along a path.

    make day12                      in the clone: sets all up, then runs this
    python src/day12_planning.py    in w2-autonomy/, once that is done

A path has a row per waypoint, (m, k), with straight edges between them. A world is an
array of discs (x, y, radius) or a collision checker with a method `edge_free(a, b)`.
Random samples are arguments: no function draws them. Metres, radians, seconds, N m.
"""

import itertools

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, simulate
from robo47 import planning as library
from robo47.lesson.lab import Lab
from robo47.trajectory import quintic_duration

import day12_mujoco
from day12_mujoco import GOAL, START, Wall

SEED = 12  # for the inputs of your functions and the worlds of the plane
TRIALS = 20  # random inputs of each small function
WORLDS = 25  # in the plane; the lab plans once in each
DISCS = 12  # in each of them
EDGE = 0.1  # longest edge of a tree in the plane; 0.01 needs ten times the samples
STEP = 0.6  # rad, longest edge of the arm's trees; 0.1 finds nothing in 160 samples
SEEDS = 60  # plans of the arm; 20 of 20 would have the lower bound 0.84 only
FORGOTTEN = 30  # plans with a collision checker that omits the hand
COUNTS = (10, 20, 40, 80, 160)  # samples that a plan may use
PAIRS = 60  # pairs of waypoints that a shortcut tries to connect
LOOKS = 40  # configurations of each edge at which a path is verified
POINTS = 100  # steps of a path whose time is computed
LEG = 40  # steps of each edge of a path whose time is computed
TO = np.array([0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6])  # rad: Day 7's goal


def nearest(tree: np.ndarray, q: np.ndarray) -> int:
    """Return the index of the node that is nearest to q, the first of equal ones.

    tree (n, k) has a node in each row and q (k,) is a configuration; the distance is
    Euclidean.
    nearest(((0, 0), (2, 0), (1, 1)), (1, 0)) -> 0
    """
    # region 12.1
    return int(np.argmin(np.sum((tree - q) ** 2, axis=1)))  # the first nearest node
    # endregion 12.1


def steer(q: np.ndarray, target: np.ndarray, step: float) -> np.ndarray:
    """Return the point (k,) at the distance `step` from q on the segment to the target.

    q and target are configurations (k,), and step is positive. If the target is not
    further away than a step, return a copy of the target with exactly its numbers.
    steer((0, 0), (3, 4), 1) -> (0.6, 0.8)
    """
    # region 12.1
    distance = np.linalg.norm(target - q)  # the length of the whole segment
    return (  # the target, or the point one step from q
        target.copy() if distance <= step else q + step / distance * (target - q)
    )
    # endregion 12.1


def segment_free_of_discs(a: np.ndarray, b: np.ndarray, discs: np.ndarray) -> bool:
    """Return whether the straight edge from a to b is collision-free.

    a and b are points (2,), and b may equal a. discs (m, 3) has the centre x, y and the
    radius of each disc; m may be 0. An edge that touches a disc is not collision-free.
    segment_free_of_discs((0, 0), (2, 0), ((1, 1, 0.5),)) -> True
    """
    # region 12.2
    along = b - a  # the edge as a vector
    to_centres = discs[:, :2] - a  # the vectors from a to the centres
    part = to_centres @ along / max(along @ along, 1e-300)  # parameter t on the line
    feet = np.clip(part, 0.0, 1.0)[:, None] * along  # nearest points, relative to a
    return bool(  # the test that every disc is further away than its radius
        np.all(np.linalg.norm(to_centres - feet, axis=1) > discs[:, 2])
    )
    # endregion 12.2


def edge_free(a: np.ndarray, b: np.ndarray, world) -> bool:
    """Return whether the straight edge from a to b is collision-free (given).

    a and b are configurations (k,). world is an array of discs (m, 3), or a collision
    checker with a method `edge_free(a, b)`.
    """
    own = getattr(world, "edge_free", None)
    return own(a, b) if own else segment_free_of_discs(a, b, world)


def extend(
    tree: np.ndarray, sample: np.ndarray, step: float, world
) -> tuple[int, np.ndarray, bool]:
    """Return how a tree grows by one edge towards a sample: (index, point, free).

    tree (n, k) has a node in each row, sample is (k,), an edge has at most the length
    step, and world is what `edge_free` takes. index is the row of the nearest node,
    point (k,) lies one step from it towards the sample, and free tells whether the edge
    between the two is collision-free. The tree itself does not change.
    extend(((0, 0), (1, 0)), (1, 2), 0.5, ((1, 1, 0.5),)) -> (1, (1, 0.5), False)
    """
    # region 12.3
    i = nearest(tree, sample)  # the nearest node
    q = steer(tree[i], sample, step)  # the new point
    return i, q, edge_free(tree[i], q, world)  # node, new point and result of the test
    # endregion 12.3


def rrt_connect(
    start: np.ndarray, goal: np.ndarray, world, samples: np.ndarray, step: float
) -> np.ndarray:
    """Return a collision-free path (m, k) from start to goal; (0, k) if none is found.

    start and goal are configurations (k,), samples (n, k) are used in their order, an
    edge has at most the length step, and world is what `edge_free` takes. The planner
    is RRT-Connect (Kuffner and LaValle, 2000):

        for each sample, number k = 0, 1, 2, ...:
            this tree is the start's if k is even, and the goal's if k is odd
            extend this tree towards the sample
            if the edge collides: continue with the next sample
            add the new node to this tree
            repeat:
                extend the other tree towards the new node
                if the edge collides: leave the loop
                add the node to the other tree
                if it equals the new node: return the path
        return an empty array

    The path contains the meeting point once. With (0, 0), (2.5, 0), no disc, one sample
    (0, 2) and step 1:
    ((0, 0), (0, 1), (0.643, 0.7428), (1.5715, 0.3714), (2.5, 0)).
    """
    # region 12.4
    trees = [[start], [goal]]  # the nodes of both trees
    parents = [[0], [0]]  # the index of each node's parent

    def grow(side: int, target: np.ndarray) -> bool:
        i, q, free = extend(np.array(trees[side]), target, step, world)  # a new edge
        if free:
            trees[side].append(q)
            parents[side].append(i)
        return free  # the result of the extension

    def back(side: int) -> list:
        i = len(trees[side]) - 1  # the newest node
        way = [trees[side][i]]  # its branch, down to the root
        while i > 0:
            i = parents[side][i]  # the index of the parent
            way.append(trees[side][i])
        return way  # the branch from the node to the root

    for k, sample in enumerate(samples):
        mine, other = k % 2, 1 - k % 2  # the growing tree and the other tree
        if not grow(mine, sample):
            continue
        new = trees[mine][-1]  # the node that the other tree grows towards
        while grow(other, new):
            if np.array_equal(trees[other][-1], new):  # the meeting of the trees
                return np.array(back(0)[::-1] + back(1)[1:])  # the joined branches
    return np.empty((0, len(start)))  # the empty path
    # endregion 12.4


def shortcut(path: np.ndarray, world, pairs: np.ndarray) -> np.ndarray:
    """Return the path (m', k) after shortcutting: unnecessary waypoints are removed.

    path is (m, k) and world is what `edge_free` takes. Each row (u, v) of pairs (p, 2),
    with numbers from 0 to below 1 in any order, names the rows int(u m) and int(v m) of
    the path, where m is its number of rows *at that moment*. If these rows are more
    than one apart and the edge between them is collision-free, remove all rows between
    them. The argument does not change.
    With (0, 0), (0, 1), (1, 1), (2, 1), (2, 0), disc (1, 0, 0.5) and pairs (0.1, 0.9),
    (0, 0.5), (0.3, 0.99): ((0, 0), (1, 1), (2, 0)).
    """
    # region 12.5
    for pair in pairs:
        i, j = sorted(int(u * len(path)) for u in pair)  # the rows of the current path
        if j - i > 1 and edge_free(path[i], path[j], world):
            path = np.concatenate([path[: i + 1], path[j:]])  # the shorter path
    return path.copy()  # the shorter path
    # endregion 12.5


def wilson_interval(successes: int, n: int) -> np.ndarray:
    """Return Wilson's 95 % confidence interval (2,) for a success rate: (lower, upper).

    successes is the number of successful trials of n. The ends are the roots p of
    (p - k / n)^2 = z^2 p (1 - p) / n with k = successes and z = 1.96 (Wilson, 1927).
    Without a trial, n = 0, the interval is (0, 1).
    wilson_interval(18, 60) -> (0.19898, 0.42509)
    """
    # region 12.6
    if n == 0:
        return np.array([0.0, 1.0])  # the interval for n = 0
    z = 1.96  # standard deviations that contain 95 % of a normal distribution
    p = successes / n  # the success rate
    around = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))  # the half-width
    return (  # both endpoints of the interval
        p + z**2 / (2 * n) + np.array([-around, around])
    ) / (1 + z**2 / n)
    # endregion 12.6


def path_dynamics(
    M: np.ndarray,
    dq_ds: np.ndarray,
    d2q_ds2: np.ndarray,
    coriolis: np.ndarray,
    gravity: np.ndarray,
) -> np.ndarray:
    """Return a, b and c (3, k) of tau = a sdd + b sd^2 + c at a point of a path, N m.

    M (k, k) is the mass matrix, dq_ds and d2q_ds2 (k,) are the path's derivatives dq/ds
    and d2q/ds2, coriolis (k,) is the Coriolis torque at the velocity dq_ds, and gravity
    (k,) the gravity torque. sd is the path speed ds/dt and sdd its derivative
    (*Modern Robotics*, section 9.4).
    path_dynamics(((2,),), (3,), (1,), (5,), (7,)) -> ((6,), (7,), (7,))
    """
    # region 12.7
    return np.array([
        M @ dq_ds,  # the coefficient of sdd
        M @ d2q_ds2 + coriolis,  # the coefficient of sd^2
        gravity,  # the constant term
    ])  # fmt: skip
    # endregion 12.7


def path_accel_bounds(
    a: np.ndarray, b: np.ndarray, c: np.ndarray, limits: np.ndarray, sd: float
) -> np.ndarray:
    """Return the lower and the upper bound (2,) of the path acceleration sdd, 1/s^2.

    Between them all torques a sdd + b sd^2 + c are within +-limits. a, b, c and limits
    (k,) are in N m, and sd is the path speed, 1/s. If no sdd is permitted, the lower
    bound is above the upper one. A joint with a = 0 bounds nothing, but if its torque
    b sd^2 + c exceeds its limit, return (inf, -inf).
    path_accel_bounds((1, 2), (0, 0), (0, 1), (4, 5), 0) -> (-3, 2)
    """
    # region 12.8
    rest = b * sd**2 + c  # the torque without path acceleration
    moves = a != 0  # the joints that bound the path acceleration
    if np.any(np.abs(rest[~moves]) > limits[~moves]):
        return np.array([np.inf, -np.inf])  # the empty interval
    ends = (np.array([-limits, limits]) - rest)[:, moves] / a[moves]  # both bounds
    low, high = np.sort(ends, axis=0)  # both bounds of each joint, in order
    return np.array([
        low.max(initial=-np.inf),  # the largest lower bound
        high.min(initial=np.inf),  # the smallest upper bound
    ])  # fmt: skip
    # endregion 12.8


def time_optimal_profile(
    a: np.ndarray, b: np.ndarray, c: np.ndarray, limits: np.ndarray, sd2_max: np.ndarray
) -> np.ndarray:
    """Return sd^2 (N + 1,) of the time-optimal motion along a path, from rest to rest.

    sd is the path speed ds/dt. a, b and c (N + 1, k) are the rows of `path_dynamics` at
    N + 1 equally spaced points, s = 0 to 1, and limits (k,) are the torque limits, N m.
    sd2_max (N + 1,) is the largest sd^2 that the joints' velocity limits permit, 1/s^2.
    Over a step of 1 / N, with the path acceleration that is permitted at its first
    point, sd^2 changes linearly (Pham and Pham, 2018). If c exceeds a limit at any
    point, return zeros.
    M 2, dq_ds 1, limit 8, N 4, sd2_max 9: (0, 2, 4, 2, 0); with gravity 4:
    (0, 1, 2, 3, 0).
    """
    # region 12.9
    if np.any(np.abs(c) > limits):
        return np.zeros(len(a))  # the motion at rest
    two_ds = 2.0 / (len(a) - 1)  # the growth of sd^2 in a step, per unit of sdd

    def reached(i: int, x: float, after: float) -> bool:
        low, high = path_accel_bounds(  # the permitted accelerations
            a[i], b[i], c[i], limits, np.sqrt(x)
        )
        return (  # the test that the next sd^2 can be permitted
            low <= high and x + two_ds * low <= after and x + two_ds * high >= 0.0
        )

    most = np.zeros(len(a))  # the largest sd^2 from which the arm can still stop
    for i in range(len(a) - 2, -1, -1):
        good, bad = 0.0, sd2_max[i]  # the endpoints of the bisection
        if reached(i, bad, most[i + 1]):
            good = bad  # the upper endpoint, which is permitted
        for _ in range(60 * (good < bad)):
            half = (good + bad) / 2.0  # the middle of the interval
            good, bad = (  # the half that contains the bound
                (half, bad) if reached(i, half, most[i + 1]) else (good, half)
            )
        most[i] = good  # the largest sd^2 at each point
    x = np.zeros(len(a))  # sd^2 of the motion
    for i in range(len(a) - 1):
        high = path_accel_bounds(  # the largest permitted acceleration
            a[i], b[i], c[i], limits, np.sqrt(x[i])
        )[1]
        x[i + 1] = max(0.0, min(most[i + 1], x[i] + two_ds * high))  # the next sd^2
    return x  # sd^2 of the motion
    # endregion 12.9


def plane_world(rng: np.random.Generator) -> tuple[np.ndarray, ...]:
    """Return start, goal and discs, (DISCS, 3), that are away from both."""
    start = np.array([-1.0, -1.0])
    goal = np.array([1.0, 1.0])
    discs = np.empty((0, 3))
    while len(discs) < DISCS:
        disc = np.append(rng.uniform(-1.0, 1.0, 2), rng.uniform(0.1, 0.3))
        ends = np.linalg.norm(np.array([start, goal]) - disc[:2], axis=1)
        if np.all(ends > disc[2] + EDGE):
            discs = np.vstack([discs, disc])
    return start, goal, discs


def dense(way: np.ndarray, looks: int) -> np.ndarray:
    """Return points all along a path, `looks` on each edge, (n, k)."""
    part = np.linspace(0.0, 1.0, looks)[None, :, None]
    return (way[:-1, None] + part * np.diff(way, axis=0)[:, None]).reshape(
        -1, way.shape[1]
    )


def gap_to_discs(points: np.ndarray, discs: np.ndarray) -> float:
    """Return the minimum distance of points, (n, 2), from any disc."""
    away = np.linalg.norm(points[:, None] - discs[:, :2], axis=2)
    return float(np.min(away - discs[:, 2]))


def apart(own, truth) -> float:
    """Return the largest error of an answer; inf if its shape is not the library's."""
    parts = zip(*((x if isinstance(x, tuple) else (x,)) for x in (own, truth)),
                strict=True)  # fmt: skip
    off = 0.0
    for mine, right in parts:
        mine, right = np.asarray(mine, float), np.asarray(right, float)
        if mine.shape != right.shape:
            return np.inf
        with np.errstate(invalid="ignore"):
            away = np.where(mine == right, 0.0, np.abs(mine - right))  # inf is inf
        off = max(off, np.nan_to_num(away, nan=np.inf).max(initial=0.0))
    return off


def off_library(name: str, own, given: list[tuple]) -> list[float]:
    """Return the error of your function against robo47's of that name, per input."""
    truth = getattr(library, name)
    return [apart(own(*some), truth(*some)) for some in given]


def given_to_plane(rng: np.random.Generator) -> dict[str, list[tuple]]:
    """Return the inputs of your functions of the plane, by name."""
    some: dict[str, list[tuple]] = {}
    tree = rng.normal(size=(12, 7))
    some["nearest"] = [(tree, q) for q in rng.normal(size=(TRIALS, 7))]
    some["nearest"] += [(np.repeat(tree, 2, axis=0), tree[5])]  # the first of two
    some["steer"] = [(tree[0], tree[0] + x, 2.5) for x in rng.normal(size=(TRIALS, 7))]
    discs = rng.uniform((-1, -1, 0.05), (1, 1, 0.2), (4, 3))
    ends = rng.uniform(-1.0, 1.0, (4 * TRIALS, 2, 2))
    some["segment_free_of_discs"] = [(a, b, discs) for a, b in ends]
    one = np.array([[0.0, 0.5, 0.5]])
    point = np.array([0.0, 0.6])
    away = np.array([0.0, 2.0])
    side = np.array([-1.0, 0.0]), np.array([1.0, 0.0])  # they touch it
    some["segment_free_of_discs"] += [
        (*side, one),
        (*side, one[:0]),
        (point, point, one),
        (away, away, one),
    ]
    nodes = rng.uniform(-1.0, 1.0, (8, 2))
    far = rng.uniform(-1.0, 1.0, (2 * TRIALS, 2))
    some["extend"] = [(nodes, sample, 0.3, discs) for sample in far]
    return some


def plan_in_the_plane(rng: np.random.Generator) -> tuple[list[float], ...]:
    """Plan in WORLDS worlds of discs.

    Return the errors of your paths against the library's, before and after
    shortcutting, and the minimum distance of each of your paths from a disc.
    """
    nothing = np.empty((0, 3))
    alone = np.zeros(2), np.array([2.5, 0.0]), nothing, np.array([[0.0, 2.0]]), 1.0
    off_way, off_cut, gaps = off_library("rrt_connect", rrt_connect, [alone]), [], []
    for _ in range(WORLDS):
        start, goal, discs = plane_world(rng)
        samples = rng.uniform(-1.2, 1.2, (150, 2))
        pairs = rng.uniform(0.0, 1.0, (PAIRS, 2))
        way = rrt_connect(start, goal, discs, samples, EDGE)
        truth = library.rrt_connect(start, goal, discs, samples, EDGE)
        off_way.append(apart(way, truth))
        if len(truth):
            cut = shortcut(truth, discs, pairs)
            off_cut.append(apart(cut, library.shortcut(truth, discs, pairs)))
        if len(way):
            joined = np.vstack([start, way, goal])
            gaps.append(gap_to_discs(dense(joined, LOOKS), discs))
    return off_way, off_cut, gaps


def plan_with(wall: Wall, seeds: int) -> tuple[np.ndarray, list[np.ndarray]]:
    """Plan with the arm, once for each seed.

    Return how many of COUNTS' samples each plan needed, (seeds,), and the paths.
    """
    needed, ways = [], []
    for seed in range(seeds):
        samples = day12_mujoco.samples(wall.model, COUNTS[-1], seed)
        for n in COUNTS:  # the samples are used in order
            way = rrt_connect(START, GOAL, wall, samples[:n], STEP)
            if len(way):
                break
        needed.append(n if len(way) else np.inf)
        ways.append(way)
    return np.array(needed), ways


def least_distance(wall: Wall, way: np.ndarray) -> float:
    """Return the minimum distance of the whole arm from wall and roof on a path, m."""
    model, data = wall.model, wall.data
    least = np.inf
    for q in dense(way, LOOKS):
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)  # fills geom_xpos and geom_xmat
        for arm, box in wall.pairs:  # all links, whatever the checker omits
            far = mujoco.mj_geomDistance(model, data, arm, box, 1.0, None)
            least = min(least, far)
    return least


def length(way: np.ndarray) -> float:
    """Return the length of a path, rad."""
    return np.linalg.norm(np.diff(way, axis=0), axis=1).sum()


def shorter(wall: Wall, ways: list[np.ndarray]) -> list[np.ndarray]:
    """Return the paths that were found, after shortcutting."""
    rng = np.random.default_rng(SEED)
    pairs = rng.uniform(0.0, 1.0, (len(ways), PAIRS, 2))
    return [shortcut(way, wall, some) for way, some in zip(ways, pairs, strict=True)
            if len(way)]  # fmt: skip


def share_of(needed: np.ndarray, n: int) -> tuple[int, np.ndarray]:
    """Return how many plans needed at most n samples, and its confidence interval."""
    found = int(np.sum(needed <= n))
    return found, wilson_interval(found, len(needed))


def show_shares(needed: np.ndarray, short: np.ndarray) -> None:
    """Print how many plans found a path, with the interval of the success rate."""
    print("  samples        whole arm               hand omitted")
    for n in COUNTS:
        text = f"  {n:7}"
        for some in (needed, short):
            found, (low, high) = share_of(some, n)
            text += f"   {found:3} of {len(some)}  ({low:.3f}, {high:.3f})"
        print(text)


def show_ways(name: str, wall: Wall, ways: list, cut: list, least: np.ndarray) -> None:
    """Print the lengths of paths, and how many of them collide."""
    raw = np.median([length(way) for way in ways if len(way)])
    now = np.median([length(way) for way in cut])
    hit = int(np.sum(least <= 0.0))
    print(f"  {name:15}{raw:6.2f}{now:10.2f}{wall.looks / len(ways):11.0f}"
          f"{hit:8} of {len(cut)}{1000 * least.min():15.1f}")  # fmt: skip


def given_to_timing(rng: np.random.Generator) -> dict[str, list[tuple]]:
    """Return the inputs of the functions that MuJoCo does not have, by name."""
    some: dict[str, list[tuple]] = {}
    a, b, g = rng.normal(size=(3, TRIALS, 7))
    limits = rng.uniform(1.0, 4.0, (TRIALS, 7))
    a[:3, 2] = 0.0  # joint 3 does not move; the third time it cannot hold
    g[:3, 2] = (0.5, -0.5, 9.0)
    sd = rng.uniform(0.3, 1.5, TRIALS)
    some["path_accel_bounds"] = list(zip(a, b, g, limits, sd, strict=True))
    some["wilson_interval"] = [(k, n) for n in (0, 1, 20, 60) for k in {0, n // 3, n}]
    A = 1.5 + np.cumsum(rng.normal(size=(21, 7)), axis=0) / 4.0
    B = np.cumsum(rng.normal(size=(21, 7)), axis=0) / 4.0
    G = rng.uniform(-1.0, 1.0, (21, 7))
    x_max = rng.uniform(0.3, 1.0, 21)
    heavy = G + 9.0 * np.eye(21, 7, -12)
    some["time_optimal_profile"] = [
        (A, B, some_g, limits[0], x_max) for some_g in (G, heavy)
    ]
    two = np.ones((7, 2))  # neither permits a high speed at the middle point
    steep = 20.0 * np.eye(7)[3][:, None] * [1.0, -1.0]
    some["time_optimal_profile"] += [(2 * two, steep, two, 8 * two[0], 9 * two[:, 0])]
    return some


def off_mujoco(arm, needed, rng: np.random.Generator) -> list[np.ndarray]:
    """Return the errors of a sdd + b sd^2 + c against MuJoCo on curved paths, N m."""
    off = []
    for q in panda.READY_Q + rng.uniform(-0.5, 0.5, (TRIALS, 7)):
        dq, ddq = rng.normal(size=(2, 7))
        sd, sdd = rng.uniform(0.5, 1.5, 2)
        now = arm.at(q)
        a, b, g = path_dynamics(
            now.M, dq, ddq, now.bias(dq) - now.gravity_torque, now.gravity_torque
        )
        tau = needed(q, dq * sd, dq * sdd + ddq * sd**2)  # mujoco.mj_inverse
        off.append(a * sdd + b * sd**2 + g - tau)
    return off


def along(arm, start: np.ndarray, end: np.ndarray, n: int) -> tuple[np.ndarray, ...]:
    """Return a, b, c and sd2_max of the straight path from start to end, n steps."""
    dq = end - start
    rows = []
    for s in np.linspace(0.0, 1.0, n + 1):
        now = arm.at(start + s * dq)
        gravity = now.gravity_torque
        rows.append(path_dynamics(now.M, dq, 0.0 * dq, now.bias(dq) - gravity, gravity))
    A, B, G = np.moveaxis(rows, 1, 0)
    with np.errstate(divide="ignore"):  # a joint at rest limits no speed
        most = np.min(simulate.SPEED_LIMITS / np.abs(dq)) ** 2
    return A, B, G, np.full(n + 1, most)


def seconds(x: np.ndarray) -> float:
    """Return the travel time of a path with sd^2 = x at equally spaced points, s."""
    return library.travel_time(x)


def torque_share(needed, limits, start, end, x: np.ndarray, at: tuple) -> float:
    """Return the largest torque divided by its limit, by MuJoCo's inverse dynamics.

    `at` are fractions of each step. At 0 the limits are imposed; at 0.5 and 1 they are
    not, and sdd is still the one of the step.
    """
    dq = end - start
    n = len(x) - 1
    sdd = np.diff(x) * n / 2.0
    largest = 0.0
    for i, part in itertools.product(range(n), at):
        sd = np.sqrt(x[i] + part * (x[i + 1] - x[i]))
        tau = needed(start + (i + part) / n * dq, dq * sd, dq * sdd[i])
        largest = max(largest, np.max(np.abs(tau) / limits))
    return largest


def bang_bang(fastest, gravity: float) -> float:
    """Return the travel time of one joint, M 2, limit 8, over 1 rad, s."""
    one = np.ones((POINTS + 1, 1))
    M = np.array([[2.0]])
    nothing = np.zeros(1)
    a, b, g = path_dynamics(M, np.ones(1), nothing, nothing, np.array([gravity]))
    x = fastest(a * one, b * one, g * one, np.array([8.0]), 99.0 * one[:, 0])
    return seconds(x)


def time_the_move(lab: Lab, arm, limits: np.ndarray) -> None:
    """Time one joint and Day 7's motion by the library's 12.9, from your a, b, c."""
    alone = bang_bang(library.time_optimal_profile, 0.0)
    print(f"  one joint over 1 rad: {alone:.4f} s; against gravity "
          f"{bang_bang(library.time_optimal_profile, 4.0):.4f} s")  # fmt: skip
    lab.measured("one joint over 1 rad, s", alone)
    A, B, G, most = along(arm, panda.READY_Q, TO, POINTS)
    print(f"  Day 7's motion as a quintic: {quintic((panda.READY_Q, TO)):.3f} s")
    times = []
    for share in (1.0, 0.5, 0.4, 0.39, 0.38):
        x = library.time_optimal_profile(A, B, G, share * limits, most)
        times.append(seconds(x))
        told = f"{times[-1]:.3f} s" if x.any() else "gravity exceeds a limit"
        print(f"    time-optimal, {share:4.0%} of the torque: {told}")
    lab.measured("Day 7's motion with half of the torque, s", times[1])


def judge_the_move(lab: Lab, arm, inverse, limits: np.ndarray) -> None:
    """Time Day 7's motion with your 12.9, and compute its torques with MuJoCo."""
    start = panda.READY_Q
    A, B, G, most = along(arm, start, TO, POINTS)
    x = time_optimal_profile(A, B, G, limits, most)
    at = torque_share(inverse, limits, start, TO, x, (0.0,))
    lab.record("torque", at, metric="share", label="torque / limit at the points")
    at = torque_share(inverse, limits, start, TO, x, (0.5, 1.0))
    lab.record(
        "torque", at, metric="share_between", label="torque / limit between them"
    )
    lab.check("velocity / limit", np.sqrt(np.max(x / most)), 1.0 + 1e-9)
    lab.check("sd^2 at both ends", x[[0, -1]])
    print(f"  Day 7's motion: {seconds(x):.3f} s")


def time_the_ways(arm, limits: np.ndarray, ways: list[np.ndarray]) -> None:
    """Time the edges of paths, at rest at each waypoint, and Day 7's quintics."""
    for seed, way in enumerate(ways[:3]):
        legs = list(itertools.pairwise(way))
        fast = [along(arm, *leg, LEG) for leg in legs]
        times = [
            seconds(time_optimal_profile(*some[:3], limits, some[3])) for some in fast
        ]
        slow = [quintic(leg) for leg in legs]
        print(f"  over the wall, seed {seed}: {len(legs)} edges, {sum(times):.2f} s; "
              f"as quintics {sum(slow):.2f} s")  # fmt: skip


def quintic(leg: tuple[np.ndarray, np.ndarray]) -> float:
    """Return the time of Day 7's quintic within the speeds and 10 rad/s^2, s."""
    return quintic_duration(leg[1] - leg[0], simulate.SPEED_LIMITS, 10.0)


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    print(panda.describe("panda_nohand"))

    lab.step("1. A tree and a collision checker, in the plane")
    given = given_to_plane(rng)
    yours = {"nearest": nearest, "steer": steer,
             "segment_free_of_discs": segment_free_of_discs,
             "extend": extend}  # fmt: skip
    for name, own in yours.items():
        lab.check(f"{name} - the library's", off_library(name, own, given[name]))

    if lab.failed:  # with a wrong step a planner may never return
        print("  The lab plans only when these are right.")
        return lab.finish()

    lab.step(f"2. A path between {DISCS} discs")
    off_way, off_cut, gaps = plan_in_the_plane(rng)
    print(f"  paths found in {len(gaps)} of {WORLDS} worlds")
    lab.record("plane_ways", off_way, label="rrt_connect - the library's", seed=SEED)
    lab.check("shortcut - the library's", off_cut)
    lab.check("penetration of a path into a disc", max(0.0, -min(gaps, default=np.inf)))

    lab.step(f"3. The arm: over a wall, under a roof ({SEEDS} seeds)")
    timing = given_to_timing(rng)
    off = off_library("wilson_interval", wilson_interval, timing["wilson_interval"])
    lab.check("wilson_interval - the library's", off)
    wall, blind = Wall(), Wall(forget=(7,))
    needed, ways = plan_with(wall, SEEDS)
    short, wrong = plan_with(blind, FORGOTTEN)
    show_shares(needed, short)
    for n in (40, COUNTS[-1]):
        low = share_of(needed, n)[1][0]
        lab.record("planned", low, metric=f"low_{n}", label=f"lower bound, {n} samples")
    cut, wrong_cut = shorter(wall, ways), shorter(blind, wrong)
    least = np.array([least_distance(wall, way) for way in cut])
    deep = np.array([least_distance(blind, way) for way in wrong_cut])
    print("                     length, rad   distance             min distance,")
    print("                    raw  shortcut    queries       collide             mm")
    show_ways("whole arm", wall, ways, cut, least)
    show_ways("hand omitted", blind, wrong, wrong_cut, deep)
    lab.record(
        "clearance", 1000 * least, metric="least_mm", label="minimum distance, mm"
    )
    lab.measured("lower bound for 60 of 60", share_of(needed, COUNTS[-1])[1][0])

    lab.step("4. The torques along a path")
    arm = panda.arm(wall.model)
    inverse = day12_mujoco.torque(wall.model)  # mujoco.mj_inverse, without damping
    _, limits = simulate.limits(wall.model)
    off = off_mujoco(arm, inverse, rng)
    lab.check("|a sdd + b sd^2 + c - MuJoCo's torque|, N m", off)
    off = off_library(
        "path_accel_bounds", path_accel_bounds, timing["path_accel_bounds"]
    )
    lab.check("path_accel_bounds - the library's", off)
    time_the_move(lab, arm, limits)

    lab.step("5. Side quest: time-optimal path parameterisation")
    with lab.side_quest():
        off = off_library(
            "time_optimal_profile", time_optimal_profile, timing["time_optimal_profile"]
        )
        lab.check("time_optimal_profile - the library's", off)
        lab.record("bang_bang", bang_bang(time_optimal_profile, 0.0) - 1.0,
                   metric="off_s",
                   label="one joint - 2 sqrt(d / a), s")  # fmt: skip
        judge_the_move(lab, arm, inverse, limits)
        time_the_ways(arm, limits, cut)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
