"""Day 14: what a finger feels, what a grasp resists, and what a policy has learned.

    make day14                      in the clone: sets all up, then runs this
    python src/day14_touch.py       in w2-autonomy/, once that is done

A contact's normal points out of the finger into the cube, forces act on the cube.
Wrenches (moment; force). Metres, radians, newtons, kilograms; world axes.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, grasp, policy, se3
from robo47.lesson.lab import Lab
from robo47.planning import wilson_interval
from robo47.screws import skew

import day14_mujoco

SEED = 7  # of learning: cubes, samples, noise
CUBES_SEED = 13  # of the cubes that a policy is tested on
LIFTS = 6  # cubes whose contacts are felt
POLICIES = 12  # that are tried in a round of learning
TRAINED_ON = 4  # cubes that each of them is tried on
ROUNDS = 6
ELITE = 3  # of the policies of a round: the next ones are like these
TESTED = 60  # cubes that the policy has never seen
ROUGH = (0.9, 1.0)  # friction of the cubes that it learns with
SLIPPERY = (0.2, 0.5)  # and of others; all have 50 to 250 g
NOISE = np.array([0.002, 0.002, 0.03])  # m, m, rad: of the camera
# A policy is six numbers: shift x, y and turn beside the cube, m, m, rad; height, m;
# opening, how far each pad is told to be from the middle, m; lift, m.
LOW = np.array([-0.02, -0.02, -0.8, 0.0, -0.02, 0.0])
HIGH = np.array([0.02, 0.02, 0.8, 0.04, 0.04, 0.25])
START = np.array([0, 0, 0, 0.03, 0.02, 0.1])  # the pads only just touch the cube
SPREAD = np.array([0.01, 0.01, 0.3, 0.01, 0.01, 0.05])
BY_HAND = np.array([0, 0, 0, 0.02, -0.02, 0.1])  # in the middle, with 8 N
NUMBERS = (
    "shift x, m",
    "shift y, m",
    "turn, rad",
    "height, m",
    "opening, m",
    "lift, m",
)
TARGET = 0.05  # m: lifted so far is worth 1
CAP = 0.3  # m: no hand lifts so far; it was thrown
HELD = 0.03  # m: a cube that is so high at the end was held
SHARE = 0.2  # of mu f_n: a smaller margin nearly slips
CLOSE = 0.002  # m that the reflex closes each pad by, every 10 ms
SLOW = 1.0  # s in which a cube is lifted that is only just held
EDGES = 8  # of a cone
G = 9.81  # m/s^2
GRASPS = {  # where points touch a cube, m; all push towards its middle, or down
    "two, opposite": [(0, 0.02, 0), (0, -0.02, 0)],
    "four around": [(0.02, 0, 0), (-0.02, 0, 0), (0, 0.02, 0), (0, -0.02, 0)],
    "three on top": [(0.01, 0.01, 0.02), (-0.01, 0.01, 0.02), (0, -0.01, 0.02)],
}


def cone_margin(force: np.ndarray, normal: np.ndarray, mu: np.ndarray) -> np.ndarray:
    """Return how far contacts are from slipping, N, (n,): mu f_n - |f_t|.

    force and normal, (n, 3) each, mu, (n,). On the normal (0, 0, 1) with mu 0.6:
    (3, 4, 10) has 1, and (0, 0, -1), a pull, has -0.6.
    """
    # region 14.1
    press = np.sum(force * normal, axis=1)
    along = force - press[:, None] * normal
    return mu * press - np.linalg.norm(along, axis=1)
    # endregion 14.1


def grip_reflex_step(
    finger_position: float,
    force: np.ndarray,
    normal: np.ndarray,
    mu: np.ndarray,
    fraction: float,
    step: float,
) -> float:
    """Return the next opening, m: a step less where any contact nearly slips.

    Nearly: its margin is below fraction times mu f_n. Never less than LOW's.
    Force (3, 4, 10) of 10, opening 0.01, step 0.002: fraction 0.2 gives 0.008,
    fraction 0.1 gives 0.01; from -0.019 with 0.2 it is -0.02.
    """
    # region 14.1
    margin = cone_margin(force, normal, mu)
    most = mu * np.sum(force * normal, axis=1)
    if np.any(margin < fraction * most):
        return max(finger_position - step, LOW[4])
    return finger_position
    # endregion 14.1


def grasp_matrix(points: np.ndarray, centre: np.ndarray) -> np.ndarray:
    """Return G, (6, 3 n): times the forces at points, (n, 3), it is their wrench.

    (moment; force) about the centre, (3,); the columns of a point stand together.
    Points (0, 0.02, 0) and (0, -0.02, 0) about 0, both pushing 1 N up: (0, 0, 0, 0, 0,
    2); one up and one down: a moment about x alone.
    """
    # region 14.2
    blocks = [np.vstack([skew(p - centre), np.eye(3)]) for p in points]
    return np.hstack(blocks)
    # endregion 14.2


def cone_edges(normal: np.ndarray, mu: float, k: int) -> np.ndarray:
    """Return k edges of a friction cone, (k, 3): n + mu (cos t a + sin t b).

    t = 2 pi i / k; a = n x axis, of length 1, for the axis least along n, the first of
    equals; b = n x a. (0, 0, 1), 0.5, 4 -> (0, 0.5, 1), (-0.5, 0, 1), (0, -0.5, 1),
    (0.5, 0, 1)
    """
    # region 14.3
    axis = np.eye(3)[np.argmin(np.abs(normal))]
    a = np.cross(normal, axis)
    a = a / np.linalg.norm(a)
    b = np.cross(normal, a)
    t = 2 * np.pi * np.arange(k)[:, None] / k
    return normal + mu * (np.cos(t) * a + np.sin(t) * b)
    # endregion 14.3


def certifies_force_closure(W: np.ndarray, weights: np.ndarray) -> bool:
    """Return whether weights, (n,), prove that the grasp W, (6, n), resists all.

    W has rank 6: its smallest singular value is above 1e-9 of the largest. Every weight
    is above 0. And they balance: in each row |W w| is at most 1e-9 of the sum of its
    |W_ij w_j|.
    """
    # region 14.4
    if np.linalg.matrix_rank(W, rtol=1e-9) < 6:
        return False
    left = np.abs(W @ weights)
    all_of_it = np.abs(W) @ np.abs(weights)
    return bool(np.all(weights > 0) and np.all(left <= 1e-9 * all_of_it))
    # endregion 14.4


def observe(T_seen: np.ndarray, noise: np.ndarray) -> np.ndarray:
    """Return (x, y, yaw), (3,), of an upright cube at T_seen, (4, 4), with noise, (3,).

    Then the yaw, noise and all, is folded into [-pi / 4, pi / 4): a cube looks the same
    four times a turn. Yaw 1 at (0.4, 0.1), no noise: (0.4, 0.1, -0.570796).
    """
    # region 14.5
    x, y = T_seen[:2, 3]
    yaw = np.arctan2(T_seen[1, 0], T_seen[0, 0])
    x, y, yaw = np.array([x, y, yaw]) + noise
    return np.array([x, y, (yaw + np.pi / 4) % (np.pi / 2) - np.pi / 4])
    # endregion 14.5


def act(theta: np.ndarray, observation: np.ndarray) -> np.ndarray:
    """Return (x, y, yaw, height, opening, lift), (6,): what the hand is to do.

    theta, (6,), is clipped to LOW and HIGH first; its shift is in the axes of the cube
    as it was seen, (3,). theta (0.01, 0, 0.1, 0.02, 0, 0.2) at (0.4, 0.1, pi / 6):
    (0.40866, 0.105, 0.623599, 0.02, 0, 0.2).
    """
    # region 14.5
    theta = np.clip(theta, LOW, HIGH)
    x, y, yaw = observation
    shift = se3.Rz(yaw)[:2, :2] @ theta[:2]
    return np.array([x + shift[0], y + shift[1], yaw + theta[2], *theta[3:]])
    # endregion 14.5


def reward(heights: np.ndarray, target: float, cap: float) -> np.ndarray:
    """Return what episodes that ended at heights, (n,), are worth, (n,).

    From 0 on the floor, and below it, to 1 at the target, and above it. But -1 if the
    height is no finite number, or above the cap. (0.01, 0.05, 0.2, 0.9, nan, -0.01)
    with 0.05 and 0.3: (0.2, 1, 1, -1, -1, 0).
    """
    # region 14.6
    worth = np.clip(heights, 0, target) / target
    good = np.isfinite(heights) & (heights <= cap)
    return np.where(good, worth, -1.0)
    # endregion 14.6


def cem_step(
    mean: np.ndarray, std: np.ndarray, noise: np.ndarray, scores: np.ndarray, elite: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return mean and std, (d,) each, of the elite best of the samples, over elite.

    The samples are mean + std noise, noise (n, d), scores (n,): a NaN is worse than all
    others, of equals the first is better. cem_step([1, 0], [2, 1], [[0, 0], [1, 1],
    [-1, 2], [3, 3]], [1, 5, 5, np.nan], 2) -> ([1, 1.5], [2, 0.5])
    """
    # region 14.7
    samples = mean + std * noise
    best = np.argsort(-scores, kind="stable")[:elite]  # a NaN goes last
    return samples[best].mean(axis=0), samples[best].std(axis=0)
    # endregion 14.7


def success_rate(success: np.ndarray) -> np.ndarray:
    """Return the rate of True in success, (n,), and its 95 % interval: (3,).

    The interval is Day 12's wilson_interval.
    success_rate(np.ones(8)) -> (1, 0.675584, 1)
    """
    # region 14.8
    won = int(np.sum(success))
    return np.array([won / len(success), *wilson_interval(won, len(success))])
    # endregion 14.8


def paired_difference(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return by how much first, (n,), is better than second on the same cubes: (2,).

    The mean of the differences, and its sigma: their standard deviation, over n, over
    sqrt(n). True counts as 1. (1, 1, 0, 1) and (1, 0, 0, 0): (0.5, 0.25).
    """
    # region 14.9
    apart = np.asarray(first, float) - np.asarray(second, float)
    return np.array([apart.mean(), apart.std() / np.sqrt(len(apart))])
    # endregion 14.9


def off_library(library, name: str, own, given: list[tuple]) -> np.ndarray:
    """Return how far your function is from robo47's of that name, answer by answer."""
    truth = getattr(library, name)
    off = []
    for some in given:
        yours = np.ravel(own(*some)).astype(float)
        off.append(yours - np.ravel(truth(*some)).astype(float))
    return np.concatenate(off)


def felt_while_lifting(model, data):
    """Yield what the pads feel, and what MuJoCo has in its own axes, every 10 ms."""
    rng = np.random.default_rng(SEED)
    wrench = np.zeros(6)
    for cube in day14_mujoco.cubes(LIFTS, rng, (0.3, 1.0)):
        action = policy.act(BY_HAND, (cube.x + 0.002, cube.y, cube.yaw))
        for _ in day14_mujoco.episode(model, data, cube, action):
            theirs = []
            for i in day14_mujoco.at_pads(model, data):
                mujoco.mj_contactForce(model, data, i, wrench)  # normal first
                mu = data.contact[i].friction[0]
                theirs.append(mu * wrench[0] - np.hypot(wrench[1], wrench[2]))
            if theirs:
                yield day14_mujoco.felt(model, data), theirs


def moved_by(model, data, felt) -> np.ndarray | None:
    """Return m a - m g and I alpha of the cube less the wrench of your forces, (6,).

    None while the floor pushes, too. data.qacc is MuJoCo's, of the last step, as the
    forces are.
    """
    if day14_mujoco.on_the_floor(model, data):
        return None
    cube = data.body("cube")
    mass = model.body("cube").mass[0]
    inertia = model.body("cube").inertia[0]  # a cube has three equal ones
    qacc = data.joint("cube").qacc  # linear in the world's axes, angular in the cube's
    turns = inertia * cube.xmat.reshape(3, 3) @ qacc[3:]
    moves = mass * (qacc[:3] - model.opt.gravity)
    G = grasp_matrix(felt.points, cube.xipos)
    return np.append(turns, moves) - G @ felt.force.ravel()


def heaviest(model, data, mu: float, squeeze: float) -> float:
    """Return the heaviest cube that is held by so many newtons per pad, grams."""
    opening = day14_mujoco.HALF - squeeze / day14_mujoco.SPRING
    action = np.array([0, 0, 0, 0.02, opening, TARGET])
    low, high = 1, round(3000 * mu * squeeze / G)
    while high - low > 1:
        grams = (low + high) // 2
        cube = day14_mujoco.Cube(0, 0, 0, grams / 1000, mu)
        # mujoco.mj_step runs the episode
        if day14_mujoco.lift(model, data, cube, action, rise=SLOW) > HELD:
            low = grams
        else:
            high = grams
    return low


def wrenches(name: str, mu: float, edges=cone_edges, matrix=grasp_matrix) -> np.ndarray:
    """Return what the edges of a grasp's cones do to the cube, (6, EDGES n)."""
    points = np.array(GRASPS[name])
    columns = []
    for point in points:
        normal = -point / np.linalg.norm(point)
        if name == "three on top":
            normal = np.array([0, 0, -1.0])
        columns.append(matrix(point[None], np.zeros(3)) @ edges(normal, mu, EDGES).T)
    return np.hstack(columns)


def resists(W: np.ndarray, wanted: np.ndarray) -> bool:
    """Return whether pushing alone makes each of the wrenches wanted, (n, 6).

    Some weights of either sign, and then as much of the even ones, which do nothing,
    as makes all of them positive.
    """
    for wrench in wanted:
        some = np.linalg.lstsq(W, wrench, rcond=None)[0]
        pushing = some - min(some.min(), 0)
        if np.abs(W @ pushing - wrench).max() > 1e-9 * np.abs(wrench).max():
            return False
    return True


def given_to_functions(rng: np.random.Generator) -> dict[str, list[tuple]]:
    """Return what your functions are asked where MuJoCo knows no answer."""
    normal = rng.normal(size=(4, 3))
    normal = normal / np.linalg.norm(normal, axis=1)[:, None]
    force = 3 * normal + 0.5 * rng.normal(size=(4, 3))
    mu = np.full(4, 0.6)
    noise = NOISE * rng.normal(size=(12, 3)) + [0, 0, 0.2]
    yaws = np.linspace(-3, 3, 12)
    poses = [se3.make_T(se3.Rz(yaw), (0.4, -0.1, 0.02)) for yaw in yaws]
    thetas = START + 3 * SPREAD * rng.normal(size=(12, 6))
    seen = [policy.observe(*some) for some in zip(poses, noise, strict=True)]
    heights = np.array([0.01, 0.2, 0.9, np.nan, -0.5, np.inf, -np.inf, 0.3])
    samples = rng.normal(size=(9, 6))
    scores = np.array([0.2, 1, np.nan, 0.5, 1, -1, 1, np.nan, 0.5])
    return {
        "grip_reflex_step": [
            (opening, size * force, normal, mu, share, CLOSE)
            for share in (0.1, 0.3, 0.5, 0.6, 0.7, 0.9)
            for size in (0.01, 1.0, 100.0)
            for opening in (0.01, -0.019)
        ],
        "cone_edges": [
            *zip(normal, (0.2, 0.5, 0.9, 1.3), (3, 4, 6, 8), strict=True),
            (np.array([0, 0, 1.0]), 0.5, 4),
        ],
        "certifies_force_closure": proofs(),
        "observe": list(zip(poses, noise, strict=True)),
        "act": list(zip(thetas, seen, strict=True)),
        "reward": [(heights, TARGET, CAP), (heights, 0.1, 0.15)],
        "cem_step": [(START, SPREAD, samples, scores, n) for n in (2, 4, 5)],
        "success_rate": [(np.arange(n) < k,) for k, n in ((8, 8), (97, 100), (0, 60))],
        "paired_difference": [
            (np.arange(100) < 80, np.arange(100) % 4 < 1),
            (np.arange(100) < 20, np.arange(100) % 9 < 7),
        ],
    }


def proofs() -> list[tuple[np.ndarray, np.ndarray]]:
    """Return grasps and weights that prove something, and some that do not."""
    right = (grasp.cone_edges, grasp.grasp_matrix)
    W, line, face = (wrenches(name, 0.5, *right) for name in
                     ("four around", "two, opposite", "three on top"))  # fmt: skip
    even = np.ones(W.shape[1])
    one = np.eye(len(even))
    ahead = W[:, :EDGES].mean(axis=1)  # between a cone's edges
    raised = W.copy()  # its first contact, by 10 mm: forces balance, moments do not
    raised[:3, :EDGES] += np.cross([0, 0, 0.01], W[3:, :EDGES].T).T
    nearly = line.copy()  # it hardly turns about the line
    nearly[1] = 1e-12 * np.tile([1, -1], EDGES)
    sums = W.sum(axis=0)
    mixed = even + 0.5 * (sums[6] * one[1] - sums[1] * one[6])  # adds up to nothing
    two = even[: line.shape[1]]
    top = even[: face.shape[1]]
    alike = np.repeat([1.0, 1, 2], EDGES)  # moments balance, forces do not
    sizes = [(1e-11, 1), (1e-4, 1), (1, 1), (1, 1e3), (1e5, 1), (1e5, 1e3)]
    proved = [(unit * W, size * even) for unit, size in sizes]
    left = [(unit * W, even - 1e-5 * one[0]) for unit in (1e-4, 1, 1e5)]
    low = [(line, two), (1e9 * line, two), (nearly, two), (face, top), (face, alike)]
    wrong = [(W, -even), (W, 0 * even), (W, even - one[0]), (W, mixed), (raised, even)]
    beside = [(np.column_stack([W, ahead]), np.append(even, 0))]
    return proved + left + low + wrong + beside


def tried(model, data, theta, cubes, noise, touch=None) -> np.ndarray:
    """Return how high a policy lifts each cube, m, (n,); noise is the camera's."""
    heights = []
    for cube, one in zip(cubes, noise, strict=True):
        T = se3.make_T(se3.Rz(cube.yaw), (cube.x, cube.y, day14_mujoco.HALF))
        action = act(theta, observe(T, one))
        # mujoco.mj_step runs the episode
        heights.append(day14_mujoco.lift(model, data, cube, action, touch))
    return np.array(heights)


def learn(model, data, seed: int) -> np.ndarray:
    """Return the policy, (6,), that ROUNDS rounds on rough cubes end with."""
    rng = np.random.default_rng(seed)
    mean = START
    std = SPREAD
    for _ in range(ROUNDS):
        noise = rng.normal(size=(POLICIES, 6))
        cubes = day14_mujoco.cubes(TRAINED_ON, rng, ROUGH)
        seen = NOISE * rng.normal(size=(TRAINED_ON, 3))
        scores = []
        for one in noise:
            heights = tried(model, data, mean + std * one, cubes, seen)
            scores.append(np.mean(reward(heights, TARGET, CAP)))
        mean, std = cem_step(mean, std, noise, np.array(scores), ELITE)
    return mean


def unseen(mu: tuple[float, float]) -> tuple[list, np.ndarray]:
    """Return cubes that no policy was trained on, and the camera's noise for each."""
    rng = np.random.default_rng(CUBES_SEED)
    cubes = day14_mujoco.cubes(TESTED, rng, mu)
    return cubes, NOISE * rng.normal(size=(TESTED, 3))


def held(heights: np.ndarray) -> np.ndarray:
    """Return which cubes were held, (n,): neither left behind nor thrown or lost."""
    return (heights > HELD) & (heights <= CAP)


def about(n: int) -> str:
    """Return a number of cubes as it may be said: the last one is luck."""
    return f"about {5 * round(n / 5)}"


def beside_the_cube(model, data, cube) -> np.ndarray:
    """Return how far the hand is from where your act sends it, seen from the cube.

    Its shift is asked, in the cube's axes, and its turn's sine and cosine, four times
    over: a cube looks the same after a quarter.
    """
    T = se3.make_T(se3.Rz(cube.yaw), (cube.x, cube.y, day14_mujoco.HALF))
    seen = observe(T, np.zeros(3))
    theta = np.array([0.012, -0.005, 0.3, 0.02, 0.0, 0.1])
    day14_mujoco.start(model, data, cube, act(theta, seen))
    mujoco.mj_forward(model, data)  # fills xpos and xmat
    R = data.body("cube").xmat.reshape(3, 3)
    quarters = np.round((cube.yaw - seen[2]) / (np.pi / 2))
    R = R @ se3.Rz(-quarters * np.pi / 2)  # the side that looks ahead
    hand = data.body("hand")
    shift = R.T @ (hand.xpos - data.body("cube").xpos)
    turned = R.T @ hand.xmat.reshape(3, 3)
    return np.append(shift[:2] - theta[:2], (turned - se3.Rz(theta[2])).ravel())


def squeezed(theta: np.ndarray) -> float:
    """Return with how many newtons a policy presses, per pad."""
    opening = np.clip(theta[4], LOW[4], HIGH[4])
    return day14_mujoco.SPRING * (day14_mujoco.HALF - opening)


def told(name: str, success: np.ndarray) -> np.ndarray:
    """Print about how many cubes were held; return the rate and its interval, (3,)."""
    rate = success_rate(success)
    print(f"  {name:27}{about(np.sum(success)):>9} of {len(success)}, "
          f"95 %: {rate[1]:.1f} to {rate[2]:.1f}")  # fmt: skip
    return rate


def needed(within: float) -> int:
    """Return how many cubes say a rate of a half to so much, either way."""
    low, high = 0, 10_000
    while high - low > 2:
        n = (low + high) // 4 * 2
        rate, least, most = success_rate(np.arange(n) < n // 2)
        low, high = (low, n) if max(rate - least, most - rate) <= within else (n, high)
    return high


def feeling(model, data, theta, cubes, noise) -> tuple[np.ndarray, np.ndarray]:
    """Return which cubes your grip_reflex_step holds, (n,), and the forces, N, (n,)."""
    newtons = [squeezed(theta)]

    def touch(opening: float, felt: day14_mujoco.Felt) -> float:
        opening = grip_reflex_step(
            opening, felt.force, felt.normal, felt.mu, SHARE, CLOSE
        )
        newtons.append(day14_mujoco.SPRING * (day14_mujoco.HALF - opening))
        return opening

    heights, ends = [], []
    for cube, one in zip(cubes, noise, strict=True):
        heights.extend(tried(model, data, theta, [cube], [one], touch))
        ends.append(newtons[-1])
    return held(np.array(heights)), np.array(ends)


def same_as(lab: Lab, library, given: dict[str, list[tuple]], **own) -> None:
    """Check your functions against robo47's of the same names."""
    for name, function in own.items():
        off = off_library(library, name, function, given[name])
        lab.check(f"|{name} - the library's|", off)


def try_grasps() -> list[float]:
    """Print what your certifies_force_closure proves; return where wrenches differ."""
    wanted = np.random.default_rng(SEED).normal(size=(20, 6))
    print("  grasp              mu   rank   closes   20 wrenches, by pushing alone")
    off = []
    for name in GRASPS:
        for mu in (0.0, 0.5):
            W = wrenches(name, mu)
            proof = certifies_force_closure(W, np.ones(W.shape[1]))
            made = resists(W, wanted)  # np.linalg.lstsq, and what does nothing
            print(f"  {name:14}{mu:7}{np.linalg.matrix_rank(W):7}"
                  f"{'yes' if proof else 'no':>9}   "
                  f"{'all are made' if made else 'some are not'}")  # fmt: skip
            off.append(float(proof) - float(made))
    return off


def try_policy(lab: Lab, model, data, theta: np.ndarray) -> np.ndarray:
    """Try a policy on unseen cubes; return which slippery ones it held, (n,)."""
    rough = held(tried(model, data, theta, *unseen(ROUGH)))
    low = told("of the same kind", rough)[1]
    lab.record("unseen", low, metric="low_end", label="the rate's lower end",
               seed=CUBES_SEED)  # fmt: skip
    cubes, noise = unseen(SLIPPERY)
    slippery = held(tried(model, data, theta, cubes, noise))
    told(f"friction {SLIPPERY[0]} to {SLIPPERY[1]}", slippery)
    limit = np.array([2 * cube.mu * squeezed(theta) / G for cube in cubes])
    heavy = np.array([cube.mass for cube in cubes]) > limit
    print(f"  m > 2 mu F / g, from theta alone: {np.sum(heavy)} of these will drop; "
          f"{np.sum(heavy & ~slippery)} of them did")  # fmt: skip
    lab.measured("share of slippery cubes that are held", np.mean(slippery))
    lab.measured("cubes for a rate to 0.05 either way", needed(0.05))
    return slippery


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model, data = day14_mujoco.hand()
    given = given_to_functions(np.random.default_rng(SEED))
    print(f"MuJoCo {mujoco.mj_versionString()}: two pads and a cube")

    lab.step("1. What a finger feels")
    off, left = [], []
    for felt, theirs in felt_while_lifting(model, data):
        off.extend(cone_margin(felt.force, felt.normal, felt.mu) - theirs)
        left.append(moved_by(model, data, felt))
    lab.record("cone", off, label="|margin - by mj_contactForce|, N", seed=SEED)
    same_as(lab, grasp, given, grip_reflex_step=grip_reflex_step)

    lab.step("2. What fingers do together")
    left = [one for one in left if one is not None]
    lab.record("grasp", left, metric="balance_n", seed=SEED,
               label="|G f - m (a - g) by MuJoCo|, N and N m")  # fmt: skip
    print("   mu   N per pad   2 mu F / g   measured, g")
    for mu, squeeze in ((0.3, 2), (0.2, 4), (0.5, 8)):
        grams = heaviest(model, data, mu, squeeze)
        print(f"  {mu}{squeeze:10}{2000 * mu * squeeze / G:13.0f}{grams:13.0f}")
        lab.measured(f"the heaviest cube, mu {mu}, {squeeze} N, g", grams)

    lab.step("3. Is this a proof?")
    same_as(
        lab,
        grasp,
        given,
        cone_edges=cone_edges,
        certifies_force_closure=certifies_force_closure,
    )
    lab.check("certifies_force_closure - whether all wrenches are made", try_grasps())

    lab.step("4. Six numbers")
    same_as(lab, policy, given, observe=observe, act=act, reward=reward,
            cem_step=cem_step, success_rate=success_rate)  # fmt: skip
    off = [beside_the_cube(model, data, cube) for cube in unseen(ROUGH)[0][:LIFTS]]
    lab.record("policy", off, label="|act - where MuJoCo has the hand|",
               seed=CUBES_SEED)  # fmt: skip
    if lab.failed:
        print("\nNot learned: first what failed above. With ARGS=--try it learns.")
        return lab.finish()

    lab.step(f"5. Learning, with friction {ROUGH[0]} to {ROUGH[1]}")
    theta = learn(model, data, SEED)
    for name, first, last in zip(NUMBERS, START, theta, strict=True):
        print(f"  {name:12}{first:7.3f}  ->{last:z8.3f}")
    print(f"  it presses with about {squeezed(theta):.1f} N per pad")

    lab.step(f"6. {TESTED} cubes that it has never seen")
    slippery = try_policy(lab, model, data, theta)

    lab.step("7. The same policy, with fingers that feel")
    cubes, noise = unseen(SLIPPERY)
    feels, newtons = feeling(model, data, theta, cubes, noise)
    told(f"friction {SLIPPERY[0]} to {SLIPPERY[1]}", feels)
    print(f"  at the end they press with about {np.median(newtons):.0f} N, of 8")

    lab.step("8. Side quest: which of the two is better")
    with lab.side_quest():
        same_as(lab, policy, given, paired_difference=paired_difference)
        apart, sigma = paired_difference(feels, slippery)
        lab.record("slippery_gain", np.round(apart - 1.96 * sigma, 1), metric="low_end",
                   label="what feeling gains, at least", seed=SEED)  # fmt: skip
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
