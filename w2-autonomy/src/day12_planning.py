"""Day 12: finding a way, and how fast it may be run.

    make day12                      in the clone: sets all up, then runs this
    python src/day12_planning.py    in w2-autonomy/, once that is done

A way is a row per corner, (m, k), with straight edges between them. A world is an array
of discs (x, y, radius), or what has a method `edge_free(a, b)`. Samples are arguments:
no function draws. Metres, radians, seconds, N m.
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

SEED = 12  # of what your functions are given, and of the plane's worlds
TRIALS = 20  # random inputs of each small function
WORLDS = 25  # in the plane: as many are planned in
DISCS = 12  # in each of them
EDGE = 0.1  # longest edge of a tree in the plane; 0.01 needs ten times the samples
STEP = 0.6  # rad, longest edge of the arm's trees; 0.1 finds nothing in 160 samples
SEEDS = 60  # plans of the arm; 20 of 20 would be 84 % at least, no more
FORGOTTEN = 30  # plans by a checker that forgot the hand
COUNTS = (10, 20, 40, 80, 160)  # samples that a plan may use
PAIRS = 60  # of points that a shortcut tries to join
LOOKS = 40  # at each edge of a way that is found: once more, and densely
POINTS = 100  # steps of a path that is timed
LEG = 40  # steps of each leg of a way that is timed
TO = np.array([0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6])  # rad: Day 7's goal


def nearest(tree: np.ndarray, q: np.ndarray) -> int:
    """Return which row of the tree, (n, k), is nearest to q, (k,); the first of equals.

    nearest(((0, 0), (2, 0), (1, 1)), (1, 0)) -> 0
    """
    # region 12.1
    return int(np.argmin(np.sum((tree - q) ** 2, axis=1)))
    # endregion 12.1


def steer(q: np.ndarray, target: np.ndarray, step: float) -> np.ndarray:
    """Return the point, (k,), a step from q on the way to the target, (k,).

    Where that is no further away: a copy of the target, the same to the last bit.
    steer((0, 0), (3, 4), 1) -> (0.6, 0.8)
    """
    # region 12.1
    distance = np.linalg.norm(target - q)
    return target.copy() if distance <= step else q + step / distance * (target - q)
    # endregion 12.1


def segment_free_of_discs(a: np.ndarray, b: np.ndarray, discs: np.ndarray) -> bool:
    """Return whether the straight edge from a to b, (2,) each, touches no disc.

    discs, (m, 3), holds x, y and the radius of each; there may be none, and b may be a.
    segment_free_of_discs((0, 0), (2, 0), ((1, 1, 0.5),)) -> True
    """
    # region 12.2
    along = b - a
    to_centres = discs[:, :2] - a
    part = to_centres @ along / max(along @ along, 1e-300)  # of the edge, to the foot
    feet = np.clip(part, 0.0, 1.0)[:, None] * along
    return bool(np.all(np.linalg.norm(to_centres - feet, axis=1) > discs[:, 2]))
    # endregion 12.2


def edge_free(a: np.ndarray, b: np.ndarray, world) -> bool:
    """Return whether the straight edge from a to b is free: given, for every world."""
    own = getattr(world, "edge_free", None)
    return own(a, b) if own else segment_free_of_discs(a, b, world)


def extend(
    tree: np.ndarray, sample: np.ndarray, step: float, world
) -> tuple[int, np.ndarray, bool]:
    """Return how a tree, (n, k), grows towards a sample, (k,).

    From which row, to where, (k,), and whether the edge between the two is free.
    extend(((0, 0), (1, 0)), (1, 2), 0.5, ((1, 1, 0.5),)) -> (1, (1, 0.5), False)
    """
    # region 12.3
    i = nearest(tree, sample)
    q = steer(tree[i], sample, step)
    return i, q, edge_free(tree[i], q, world)
    # endregion 12.3


def rrt_connect(
    start: np.ndarray, goal: np.ndarray, world, samples: np.ndarray, step: float
) -> np.ndarray:
    """Return a way, (m, k), from start, (k,), to goal, (k,); (0, k) if there is none.

    Sample 0, 2, 4, ... grows the start's tree by one edge, 1, 3, ... the goal's. If
    that edge is free, the other tree then grows towards the new node, edge after edge,
    until one is not free, or it stands at that very node: there the way is found. After
    the last sample, (n, k) in all, there is none.
    With (0, 0), (2.5, 0), no disc, one sample (0, 2) and step 1:
    ((0, 0), (0, 1), (0.643, 0.7428), (1.5715, 0.3714), (2.5, 0)).
    """
    # region 12.4
    trees = [[start], [goal]]
    parents = [[0], [0]]

    def grow(side: int, target: np.ndarray) -> bool:
        i, q, free = extend(np.array(trees[side]), target, step, world)
        if free:
            trees[side].append(q)
            parents[side].append(i)
        return free

    def back(side: int) -> list:
        i = len(trees[side]) - 1
        way = [trees[side][i]]
        while i > 0:
            i = parents[side][i]
            way.append(trees[side][i])
        return way

    for k, sample in enumerate(samples):
        mine, other = k % 2, 1 - k % 2
        if not grow(mine, sample):
            continue
        new = trees[mine][-1]
        while grow(other, new):
            if np.array_equal(trees[other][-1], new):
                return np.array(back(0)[::-1] + back(1)[1:])
    return np.empty((0, len(start)))
    # endregion 12.4


def shortcut(path: np.ndarray, world, pairs: np.ndarray) -> np.ndarray:
    """Return a path, (m, k), without what straight free edges can leave out.

    A pair u, v of pairs, (p, 2), from 0 to below 1, names rows int(u m) and int(v m) of
    the path *as it is by then*. If they are more than one apart and the edge between
    them is free, what lies between them goes.
    With (0, 0), (0, 1), (1, 1), (2, 1), (2, 0), disc (1, 0, 0.5) and pairs (0.1, 0.9),
    (0, 0.5), (0.3, 0.99): ((0, 0), (1, 1), (2, 0)).
    """
    # region 12.5
    for pair in pairs:
        i, j = sorted(int(u * len(path)) for u in pair)
        if j - i > 1 and edge_free(path[i], path[j], world):
            path = np.concatenate([path[: i + 1], path[j:]])
    return path.copy()
    # endregion 12.5


def wilson_interval(successes: int, n: int) -> np.ndarray:
    """Return the least and the greatest share, (2,), that n trials make believable.

    95 %, with z = 1.96; without a trial every share is: (0, 1).
    wilson_interval(18, 60) -> (0.19898, 0.42509)
    """
    # region 12.6
    if n == 0:
        return np.array([0.0, 1.0])
    z = 1.96
    p = successes / n
    around = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
    return (p + z**2 / (2 * n) + np.array([-around, around])) / (1 + z**2 / n)
    # endregion 12.6


def path_dynamics(
    M: np.ndarray,
    dq_ds: np.ndarray,
    d2q_ds2: np.ndarray,
    coriolis: np.ndarray,
    gravity: np.ndarray,
) -> np.ndarray:
    """Return a, b and c of a path's point, (3, k): tau = a sdd + b sd^2 + c, N m.

    M is (k, k), dq_ds = dq/ds and d2q_ds2 = d2q/ds2, (k,); coriolis is that torque at
    qd = dq_ds. path_dynamics(((2,),), (3,), (1,), (5,), (7,)) -> ((6,), (7,), (7,))
    """
    # region 12.7
    return np.array([M @ dq_ds, M @ d2q_ds2 + coriolis, gravity])
    # endregion 12.7


def path_accel_bounds(
    a: np.ndarray, b: np.ndarray, c: np.ndarray, limits: np.ndarray, sd: float
) -> np.ndarray:
    """Return the least and the greatest sdd, (2,), that all torques allow at sd.

    a, b, c and limits, N m, are (k,). If none is allowed the least is above the
    greatest. A joint with a = 0 limits nothing; (inf, -inf) if it cannot hold.
    path_accel_bounds((1, 2), (0, 0), (0, 1), (4, 5), 0) -> (-3, 2)
    """
    # region 12.8
    rest = b * sd**2 + c
    moves = a != 0
    if np.any(np.abs(rest[~moves]) > limits[~moves]):
        return np.array([np.inf, -np.inf])
    ends = (np.array([-limits, limits]) - rest)[:, moves] / a[moves]
    low, high = np.sort(ends, axis=0)
    return np.array([low.max(initial=-np.inf), high.min(initial=np.inf)])
    # endregion 12.8


def time_optimal_profile(
    a: np.ndarray, b: np.ndarray, c: np.ndarray, limits: np.ndarray, sd2_max: np.ndarray
) -> np.ndarray:
    """Return sd^2, (N + 1,), of the fastest motion along a path, from rest to rest.

    a, b and c, (N + 1, k), are 12.7's at N + 1 even points; sd2_max, (N + 1,), is the
    most that the motors' speeds allow there. Zeros if gravity alone is above a limit.
    M 2, dq_ds 1, limit 8, N 4, sd2_max 9: (0, 2, 4, 2, 0); with gravity 4:
    (0, 1, 2, 3, 0).
    """
    # region 12.9
    if np.any(np.abs(c) > limits):
        return np.zeros(len(a))
    two_ds = 2.0 / (len(a) - 1)

    def reached(i: int, x: float, after: float) -> bool:
        low, high = path_accel_bounds(a[i], b[i], c[i], limits, np.sqrt(x))
        return low <= high and x + two_ds * low <= after and x + two_ds * high >= 0.0

    most = np.zeros(len(a))  # from which one can still stop at the end
    for i in range(len(a) - 2, -1, -1):
        good, bad = 0.0, sd2_max[i]
        if reached(i, bad, most[i + 1]):
            good = bad
        for _ in range(60 * (good < bad)):
            half = (good + bad) / 2.0
            good, bad = (half, bad) if reached(i, half, most[i + 1]) else (good, half)
        most[i] = good
    x = np.zeros(len(a))
    for i in range(len(a) - 1):
        high = path_accel_bounds(a[i], b[i], c[i], limits, np.sqrt(x[i]))[1]
        x[i + 1] = max(0.0, min(most[i + 1], x[i] + two_ds * high))
    return x
    # endregion 12.9


def plane_world(rng: np.random.Generator) -> tuple[np.ndarray, ...]:
    """Return start, goal and discs, (DISCS, 3), that keep off both."""
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
    """Return points all along a way, `looks` to an edge, (n, k)."""
    part = np.linspace(0.0, 1.0, looks)[None, :, None]
    return (way[:-1, None] + part * np.diff(way, axis=0)[:, None]).reshape(
        -1, way.shape[1]
    )


def gap_to_discs(points: np.ndarray, discs: np.ndarray) -> float:
    """Return the least distance of points, (n, 2), to any disc."""
    away = np.linalg.norm(points[:, None] - discs[:, :2], axis=2)
    return float(np.min(away - discs[:, 2]))


def apart(own, truth) -> float:
    """Return how far an answer is from the library's; inf if its shape is another."""
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
    """Return how far your function is from robo47's of that name, per input."""
    truth = getattr(library, name)
    return [apart(own(*some), truth(*some)) for some in given]


def given_to_plane(rng: np.random.Generator) -> dict[str, list[tuple]]:
    """Return what your functions of the plane are asked, by name."""
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

    Return how far your ways are from the library's, before and after the shortcut, and
    the least gap to a disc of each way that you found.
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
    """Plan as many times with the arm.

    Return how many of COUNTS' samples each plan needed, (seeds,), and the ways.
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
    """Return how near the whole arm comes to wall or roof on a way, m: densely."""
    model, data = wall.model, wall.data
    least = np.inf
    for q in dense(way, LOOKS):
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)  # fills geom_xpos and geom_xmat
        for arm, box in wall.pairs:  # of all links, whatever the checker forgot
            far = mujoco.mj_geomDistance(model, data, arm, box, 1.0, None)
            least = min(least, far)
    return least


def length(way: np.ndarray) -> float:
    """Return the length of a way, rad."""
    return np.linalg.norm(np.diff(way, axis=0), axis=1).sum()


def shorter(wall: Wall, ways: list[np.ndarray]) -> list[np.ndarray]:
    """Return the ways that were found, cut."""
    rng = np.random.default_rng(SEED)
    pairs = rng.uniform(0.0, 1.0, (len(ways), PAIRS, 2))
    return [shortcut(way, wall, some) for way, some in zip(ways, pairs, strict=True)
            if len(way)]  # fmt: skip


def share_of(needed: np.ndarray, n: int) -> tuple[int, np.ndarray]:
    """Return how many plans needed n samples at most, and 12.6's interval of that."""
    found = int(np.sum(needed <= n))
    return found, wilson_interval(found, len(needed))


def show_shares(needed: np.ndarray, short: np.ndarray) -> None:
    """Print how many plans so many samples found, and what share that may be."""
    print("  samples        whole arm               hand forgotten")
    for n in COUNTS:
        text = f"  {n:7}"
        for some in (needed, short):
            found, (low, high) = share_of(some, n)
            text += f"   {found:3} of {len(some)}  ({low:.3f}, {high:.3f})"
        print(text)


def show_ways(name: str, wall: Wall, ways: list, cut: list, least: np.ndarray) -> None:
    """Print how long ways are, and how many of them collide."""
    raw = np.median([length(way) for way in ways if len(way)])
    now = np.median([length(way) for way in cut])
    hit = int(np.sum(least <= 0.0))
    print(f"  {name:15}{raw:6.2f}{now:8.2f}{wall.looks / len(ways):8.0f}"
          f"{hit:6} of {len(cut)}{1000 * least.min():12.1f}")  # fmt: skip


def given_to_timing(rng: np.random.Generator) -> dict[str, list[tuple]]:
    """Return what your functions of timing are asked, by name: MuJoCo knows none."""
    some: dict[str, list[tuple]] = {}
    a, b, g = rng.normal(size=(3, TRIALS, 7))
    limits = rng.uniform(1.0, 4.0, (TRIALS, 7))
    a[:3, 2] = 0.0  # joint3 does not move; the third time it cannot hold
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
    two = np.ones((7, 2))  # of which none may go fast at the middle point
    steep = 20.0 * np.eye(7)[3][:, None] * [1.0, -1.0]
    some["time_optimal_profile"] += [(2 * two, steep, two, 8 * two[0], 9 * two[:, 0])]
    return some


def off_mujoco(arm, needed, rng: np.random.Generator) -> list[np.ndarray]:
    """Return how far a sdd + b sd^2 + g is from MuJoCo's on curved paths, N m."""
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
    """Return A, B, G and x_max of the straight path from start to end, n steps."""
    dq = end - start
    rows = []
    for s in np.linspace(0.0, 1.0, n + 1):
        now = arm.at(start + s * dq)
        gravity = now.gravity_torque
        rows.append(path_dynamics(now.M, dq, 0.0 * dq, now.bias(dq) - gravity, gravity))
    A, B, G = np.moveaxis(rows, 1, 0)
    with np.errstate(divide="ignore"):  # a joint that stands still limits no speed
        most = np.min(simulate.SPEED_LIMITS / np.abs(dq)) ** 2
    return A, B, G, np.full(n + 1, most)


def seconds(x: np.ndarray) -> float:
    """Return how long a path takes whose sd^2 at even points is x, (N + 1,)."""
    return library.travel_time(x)


def torque_share(needed, limits, start, end, x: np.ndarray, at: tuple) -> float:
    """Return the largest share of a torque's limit, by MuJoCo's inverse dynamics.

    `at` are the parts of each step that are looked at: at 0 is the point whose limits
    were asked for; at 0.5 and 1 nobody asked, and sdd is still the step's.
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
    """Return the seconds of one joint, M 2, limit 8, over 1 rad."""
    one = np.ones((POINTS + 1, 1))
    M = np.array([[2.0]])
    nothing = np.zeros(1)
    a, b, g = path_dynamics(M, np.ones(1), nothing, nothing, np.array([gravity]))
    x = fastest(a * one, b * one, g * one, np.array([8.0]), 99.0 * one[:, 0])
    return seconds(x)


def time_the_move(lab: Lab, arm, limits: np.ndarray) -> None:
    """Time one joint and Day 7's move with the library's 12.9, from your a, b and g."""
    alone = bang_bang(library.time_optimal_profile, 0.0)
    print(f"  the library's, one joint: {alone:.4f} s; against "
          f"gravity {bang_bang(library.time_optimal_profile, 4.0):.4f} s")  # fmt: skip
    lab.measured("one joint over 1 rad, s", alone)
    A, B, G, most = along(arm, panda.READY_Q, TO, POINTS)
    print(f"  Day 7's move as a quintic: {quintic((panda.READY_Q, TO)):.3f} s")
    times = []
    for share in (1.0, 0.5, 0.4, 0.39, 0.38):
        x = library.time_optimal_profile(A, B, G, share * limits, most)
        times.append(seconds(x))
        told = f"{times[-1]:.3f} s" if x.any() else "it cannot hold itself up"
        print(f"    the fastest, with {share:4.0%} of the torque: {told}")
    lab.measured("with half of the torque, s", times[1])


def judge_the_move(lab: Lab, arm, inverse, limits: np.ndarray) -> None:
    """Time Day 7's move with your 12.9, and ask MuJoCo for its torques."""
    start = panda.READY_Q
    A, B, G, most = along(arm, start, TO, POINTS)
    x = time_optimal_profile(A, B, G, limits, most)
    at = torque_share(inverse, limits, start, TO, x, (0.0,))
    lab.record("torque", at, metric="share", label="torque share at the points")
    at = torque_share(inverse, limits, start, TO, x, (0.5, 1.0))
    lab.record("torque", at, metric="share_between", label="torque share between them")
    lab.check("speed share", np.sqrt(np.max(x / most)), 1.0 + 1e-9)
    lab.check("sd at both ends", x[[0, -1]])
    print(f"  Day 7's move: {seconds(x):.3f} s")


def time_the_ways(arm, limits: np.ndarray, ways: list[np.ndarray]) -> None:
    """Time the legs of ways, at rest at each corner, beside Day 7's quintic."""
    for seed, way in enumerate(ways[:3]):
        legs = list(itertools.pairwise(way))
        fast = [along(arm, *leg, LEG) for leg in legs]
        times = [
            seconds(time_optimal_profile(*some[:3], limits, some[3])) for some in fast
        ]
        slow = [quintic(leg) for leg in legs]
        print(f"  over the wall, seed {seed}: {len(legs)} legs, {sum(times):.2f} s; "
              f"as quintics {sum(slow):.2f} s")  # fmt: skip


def quintic(leg: tuple[np.ndarray, np.ndarray]) -> float:
    """Return the seconds of Day 7's quintic within the speeds and 10 rad/s^2."""
    return quintic_duration(leg[1] - leg[0], simulate.SPEED_LIMITS, 10.0)


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    print(panda.describe("panda_nohand"))

    lab.step("1. A tree and a checker of edges, in the plane")
    given = given_to_plane(rng)
    yours = {"nearest": nearest, "steer": steer,
             "segment_free_of_discs": segment_free_of_discs,
             "extend": extend}  # fmt: skip
    for name, own in yours.items():
        lab.check(f"{name} - the library's", off_library(name, own, given[name]))

    if lab.failed:  # with a wrong step or checker a planner may grow for ever
        print("  Nothing is planned before these are right.")
        return lab.finish()

    lab.step(f"2. A way between {DISCS} discs")
    off_way, off_cut, gaps = plan_in_the_plane(rng)
    print(f"  ways in {len(gaps)} of {WORLDS} worlds")
    lab.record("plane_ways", off_way, label="rrt_connect - the library's", seed=SEED)
    lab.check("shortcut - the library's", off_cut)
    lab.check("how deep ways are in a disc", max(0.0, -min(gaps, default=np.inf)))

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
        lab.record("planned", low, metric=f"low_{n}", label=f"low end, {n} samples")
    cut, wrong_cut = shorter(wall, ways), shorter(blind, wrong)
    least = np.array([least_distance(wall, way) for way in cut])
    deep = np.array([least_distance(blind, way) for way in wrong_cut])
    print("                    raw     cut   looks   collide     least, mm")
    show_ways("whole arm", wall, ways, cut, least)
    show_ways("hand forgotten", blind, wrong, wrong_cut, deep)
    lab.record("clearance", 1000 * least, metric="least_mm", label="least distance, mm")
    lab.measured("low end for 60 of 60", share_of(needed, COUNTS[-1])[1][0])

    lab.step("4. What a path's torques allow")
    arm = panda.arm(wall.model)
    inverse = day12_mujoco.torque(wall.model)  # mujoco.mj_inverse, without damping
    _, limits = simulate.limits(wall.model)
    off = off_mujoco(arm, inverse, rng)
    lab.check("|a sdd + b sd^2 + g - MuJoCo's torque|, N m", off)
    off = off_library(
        "path_accel_bounds", path_accel_bounds, timing["path_accel_bounds"]
    )
    lab.check("path_accel_bounds - the library's", off)
    time_the_move(lab, arm, limits)

    lab.step("5. Side quest: as fast as the torques allow")
    with lab.side_quest():
        off = off_library(
            "time_optimal_profile", time_optimal_profile, timing["time_optimal_profile"]
        )
        lab.check("time_optimal_profile - the library's", off)
        lab.record("bang_bang", bang_bang(time_optimal_profile, 0.0) - 1.0,
                   metric="off_s",
                   label="one joint, off 2 sqrt(d / a) = 1 s")  # fmt: skip
        judge_the_move(lab, arm, inverse, limits)
        time_the_ways(arm, limits, cut)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
