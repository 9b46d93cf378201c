"""Day 14: contact forces, force closure, and a first learned policy.

    make day14                      in the clone: sets all up, then runs this
    python src/day14_touch.py       in w2-autonomy/, once that is done

A contact's normal points out of the finger into the cube, and forces act on the cube.
Wrenches are (moment; force), expressed in the world frame. Metres, radians, newtons,
kilograms.
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
LIFTS = 6  # cubes whose contact forces are compared with MuJoCo's
POLICIES = 12  # samples of a generation
TRAINED_ON = 4  # cubes that each sample is tried on
ROUNDS = 6  # generations
ELITE = 3  # samples of a generation that determine the next one
TESTED = 60  # cubes that had no part in training
ROUGH = (0.9, 1.0)  # friction of the cubes of the training
SLIPPERY = (0.2, 0.5)  # friction of other cubes; all have 50 to 250 g
NOISE = np.array([0.002, 0.002, 0.03])  # m, m, rad: standard deviations of the camera
# The parameters theta of a policy: shift x, y and rotation of the hand relative to the
# cube, m, m, rad; height, m; opening, the commanded distance of each pad from the
# middle, m; lift, m.
LOW = np.array([-0.02, -0.02, -0.8, 0.0, -0.02, 0.0])
HIGH = np.array([0.02, 0.02, 0.8, 0.04, 0.04, 0.25])
START = np.array([0, 0, 0, 0.03, 0.02, 0.1])  # opening 0.02: a grip force of 0 N
SPREAD = np.array([0.01, 0.01, 0.3, 0.01, 0.01, 0.05])  # initial standard deviations
BY_HAND = np.array([0, 0, 0, 0.02, -0.02, 0.1])  # not learned: centred, with 8 N
NUMBERS = (
    "shift x, m",
    "shift y, m",
    "yaw, rad",
    "height, m",
    "opening, m",
    "lift, m",
)
TARGET = 0.05  # m, the height that earns a reward of 1
CAP = 0.3  # m: the hand cannot lift so far; a cube above it was thrown
HELD = 0.03  # m: a cube that is higher than this at the end was held
SHARE = 0.2  # of mu f_n: with a smaller margin the reflex closes the pads
CLOSE = 0.002  # m, the step of the reflex for each pad, every 10 ms
SLOW = 1.0  # s, the duration of the lift that measures the heaviest cube
EDGES = 8  # edges of a friction cone
G = 9.81  # m/s^2
GRASPS = {  # contact points on a cube, m; the normals point to its middle, or down
    "two, opposite": [(0, 0.02, 0), (0, -0.02, 0)],
    "four around": [(0.02, 0, 0), (-0.02, 0, 0), (0, 0.02, 0), (0, -0.02, 0)],
    "three on top": [(0.01, 0.01, 0.02), (-0.01, 0.01, 0.02), (0, -0.01, 0.02)],
}


def cone_margin(force: np.ndarray, normal: np.ndarray, mu: np.ndarray) -> np.ndarray:
    """Return each contact's friction cone margin mu f_n - |f_t|, N, (n,).

    force (n, 3), N, acts on the cube; normal (n, 3) are unit vectors out of the finger
    into the cube; mu (n,) are coefficients of friction. f_n is the component of the
    force along the normal, f_t the rest of the force. A margin below 0 is outside the
    cone (Coulomb's law). On the normal (0, 0, 1) with mu 0.6: (3, 4, 10) has 1, and (0,
    0, -1), a pull, has -0.6.
    """
    # region 14.1
    press = np.sum(force * normal, axis=1)  # normal force of each contact
    along = force - press[:, None] * normal  # tangential force
    return mu * press - np.linalg.norm(along, axis=1)  # the margin
    # endregion 14.1


def grip_reflex_step(
    finger_position: float,
    force: np.ndarray,
    normal: np.ndarray,
    mu: np.ndarray,
    fraction: float,
    step: float,
) -> float:
    """Return the next finger position, m: closed by a step if any contact nearly slips.

    finger_position, m, is the commanded distance of each pad from the middle. force,
    normal and mu are as in `cone_margin`. A contact nearly slips if its margin is below
    fraction times mu f_n; then subtract step, m, once. Otherwise the position does not
    change. The result is never below LOW[4], -0.02 m. One contact with force (3, 4, 10)
    on the normal (0, 0, 1) with mu 0.6 and step 0.002: from 0.01, fraction 0.2 gives
    0.008 and fraction 0.1 gives 0.01; from -0.019, fraction 0.2 gives -0.02.
    """
    # region 14.1
    margin = cone_margin(force, normal, mu)  # the margin of each contact, N
    most = mu * np.sum(force * normal, axis=1)  # the margin without tangential force
    if np.any(margin < fraction * most):
        return max(finger_position - step, LOW[4])  # the next position within the limit
    return finger_position  # the unchanged position
    # endregion 14.1


def grasp_matrix(points: np.ndarray, centre: np.ndarray) -> np.ndarray:
    """Return the grasp matrix G, (6, 3 n), which maps contact forces to one wrench.

    points (n, 3) are the contacts and centre (3,) is the reference point of the moment,
    m, in the world frame. G times the forces (f_1; f_2; ...) is (moment; force) about
    the centre; the three columns of a contact are adjacent. Points (0, 0.02, 0) and (0,
    -0.02, 0) about 0, both pushing 1 N up: (0, 0, 0, 0, 0, 2); one up and one down: a
    moment about x alone. (Murray, Li and Sastry, chapter 5.)
    """
    # region 14.2
    blocks = [  # the matrices of the contacts
        np.vstack([skew(p - centre), np.eye(3)])  # the moment above, the force below
        for p in points
    ]
    return np.hstack(blocks)  # the contacts side by side
    # endregion 14.2


def cone_edges(normal: np.ndarray, mu: float, k: int) -> np.ndarray:
    """Return the k edges of a friction pyramid, (k, 3): n + mu (cos t a + sin t b).

    normal n (3,) is a unit vector and mu the coefficient of friction. t = 2 pi i / k
    for i = 0 to k - 1. a is the unit vector along n x axis, where axis is the
    coordinate axis with the smallest |component| of n, the first of equals; b = n x a.
    Each edge has a normal force of 1. (0, 0, 1), 0.5, 4 -> (0, 0.5, 1), (-0.5, 0, 1),
    (0, -0.5, 1), (0.5, 0, 1)
    """
    # region 14.3
    axis = np.eye(3)[np.argmin(np.abs(normal))]  # coordinate axis furthest from n
    a = np.cross(normal, axis)  # a vector perpendicular to n
    a = a / np.linalg.norm(a)  # first tangent
    b = np.cross(normal, a)  # second tangent
    t = 2 * np.pi * np.arange(k)[:, None] / k  # angles of the edges
    return normal + mu * (np.cos(t) * a + np.sin(t) * b)  # the edges of the cone
    # endregion 14.3


def certifies_force_closure(W: np.ndarray, weights: np.ndarray) -> bool:
    """Return whether weights, (n,), are a certificate that the grasp has force closure.

    The columns of W (6, n) are the wrenches of all edges of all contacts. The weights
    are a certificate if three conditions hold: W has rank 6, that is, its smallest
    singular value is above 1e-9 of the largest; every weight is above 0; and W w = 0,
    that is, in each row |W w| is at most 1e-9 of the sum of its |W_ij w_j|. False
    proves nothing. (Lynch and Park, *Modern Robotics*, section 12.1.7.)
    """
    # region 14.4
    if np.linalg.matrix_rank(W, rtol=1e-9) < 6:
        return False  # the result without rank 6
    left = np.abs(W @ weights)  # the absolute entries of W w
    all_of_it = np.abs(W) @ np.abs(weights)  # the sum of |W_ij w_j| in each row
    return bool(  # the test of the weights and of W w
        np.all(weights > 0) and np.all(left <= 1e-9 * all_of_it)
    )
    # endregion 14.4


def observe(T_seen: np.ndarray, noise: np.ndarray) -> np.ndarray:
    """Return the policy's observation (x, y, yaw), (3,), of an upright cube.

    T_seen (4, 4) is the cube's pose in the world frame; noise (3,) is added to x, y and
    yaw, m, m, rad. Then the yaw, with its noise, is reduced modulo pi / 2 to [-pi / 4,
    pi / 4), because a cube looks the same after a quarter turn. Yaw 1 at (0.4, 0.1), no
    noise: (0.4, 0.1, -0.570796).
    """
    # region 14.5
    x, y = T_seen[:2, 3]  # position of the cube
    yaw = np.arctan2(T_seen[1, 0], T_seen[0, 0])  # yaw of the cube
    x, y, yaw = np.array([x, y, yaw]) + noise  # the measured position and yaw
    return np.array([
        x,
        y,
        (yaw + np.pi / 4) % (np.pi / 2) - np.pi / 4,  # the reduced yaw
    ])  # fmt: skip
    # endregion 14.5


def act(theta: np.ndarray, observation: np.ndarray) -> np.ndarray:
    """Return the policy's action (x, y, yaw, height, opening, lift), (6,).

    theta (6,) holds the policy's parameters in the order x shift, y shift (m), rotation
    (rad), height, opening, lift (m); clip it to LOW and HIGH first. observation (3,) is
    (x, y, yaw) from `observe`. The position of the hand is the cube's position plus the
    shift, which is expressed in the frame of the observed cube; its yaw is the cube's
    yaw plus the rotation. Height, opening and lift are returned as they are in theta.
    theta (0.01, 0, 0.1, 0.02, 0, 0.2) at (0.4, 0.1, pi / 6): (0.40866, 0.105, 0.623599,
    0.02, 0, 0.2).
    """
    # region 14.5
    theta = np.clip(theta, LOW, HIGH)  # the parameters within the hand's limits
    x, y, yaw = observation  # the position and the yaw of the cube
    shift = se3.Rz(yaw)[:2, :2] @ theta[:2]  # the shift in the world frame
    return np.array([
        x + shift[0],  # x of the hand
        y + shift[1],  # y of the hand
        yaw + theta[2],  # the yaw of the hand
        *theta[3:],
    ])  # fmt: skip
    # endregion 14.5


def reward(heights: np.ndarray, target: float, cap: float) -> np.ndarray:
    """Return the reward of each episode, (n,), from the cube's final height.

    heights (n,), m, belong to the cubes' bottoms at the end of each episode. The
    reward rises linearly from 0 on the floor, and below it, to 1 at the target, m, and
    above it. It is -1 if the height is not finite, or above the cap, m. (0.01, 0.05,
    0.2, 0.9, nan, -0.01) with 0.05 and 0.3: (0.2, 1, 1, -1, -1, 0).
    """
    # region 14.6
    worth = np.clip(heights, 0, target) / target  # the reward for the height, 0 to 1
    good = np.isfinite(heights) & (heights <= cap)  # the finite heights up to the cap
    return np.where(good, worth, -1.0)  # reward of each episode
    # endregion 14.6


def cem_step(
    mean: np.ndarray, std: np.ndarray, noise: np.ndarray, scores: np.ndarray, elite: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the next mean and std, (d,) each, of the cross-entropy method.

    mean and std (d,) describe the present Gaussian; its samples are mean + std noise
    with noise (n, d); scores (n,) are the samples' scores. The result is the mean and
    the standard deviation (divide by elite, not by elite - 1) of the elite samples with
    the highest scores. A NaN is worse than all other scores; of equal scores the first
    is better (Rubinstein 1999). cem_step([1, 0], [2, 1], [[0, 0], [1, 1], [-1, 2], [3,
    3]], [1, 5, 5, np.nan], 2) -> ([1, 1.5], [2, 0.5])
    """
    # region 14.7
    samples = mean + std * noise  # the samples, one policy per row
    best = np.argsort(-scores, kind="stable")[:elite]  # the elite, with NaN last
    return samples[best].mean(axis=0), samples[best].std(axis=0)  # mean and std
    # endregion 14.7


def success_rate(success: np.ndarray) -> np.ndarray:
    """Return the success rate and its 95 % interval: (rate, low, high), (3,).

    success (n,) holds True, or 1, for each trial that succeeded. The confidence
    interval is Day 12's `wilson_interval`. success_rate(np.ones(8)) -> (1, 0.675584, 1)
    """
    # region 14.8
    won = int(np.sum(success))  # number of successes
    return np.array([
        won / len(success),  # the success rate
        *wilson_interval(won, len(success)),  # the confidence interval
    ])  # fmt: skip
    # endregion 14.8


def paired_difference(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return the mean paired difference of two policies and its standard error, (2,).

    first and second (n,) are the successes on the same cubes, cube by cube; True is 1.
    The differences are first minus second. The standard error is their standard
    deviation (divide by n) over sqrt(n). (1, 1, 0, 1) and (1, 0, 0, 0): (0.5, 0.25).
    """
    # region 14.9
    apart = np.asarray(first, float) - np.asarray(second, float)  # the differences
    return np.array([
        apart.mean(),  # the mean difference
        apart.std() / np.sqrt(len(apart)),  # the standard error
    ])  # fmt: skip
    # endregion 14.9


def off_library(library, name: str, own, given: list[tuple]) -> np.ndarray:
    """Return the errors of your function against robo47's of the same name."""
    truth = getattr(library, name)
    off = []
    for some in given:
        yours = np.ravel(own(*some)).astype(float)
        off.append(yours - np.ravel(truth(*some)).astype(float))
    return np.concatenate(off)


def felt_while_lifting(model, data):
    """Yield the contacts of the pads and MuJoCo's own margins, every 10 ms."""
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
    """Return the cube's (I alpha; m a - m g) minus the wrench of the contacts, (6,).

    None while the floor touches the cube as well. data.qacc is MuJoCo's acceleration of
    the last step, and the forces are of the same step.
    """
    if day14_mujoco.on_the_floor(model, data):
        return None
    cube = data.body("cube")
    mass = model.body("cube").mass[0]
    inertia = model.body("cube").inertia[0]  # a cube has three equal ones
    qacc = data.joint("cube").qacc  # linear in the world frame, angular in the cube's
    turns = inertia * cube.xmat.reshape(3, 3) @ qacc[3:]
    moves = mass * (qacc[:3] - model.opt.gravity)
    G = grasp_matrix(felt.points, cube.xipos)
    return np.append(turns, moves) - G @ felt.force.ravel()


def heaviest(model, data, mu: float, squeeze: float) -> float:
    """Return the heaviest cube that a grip force (squeeze, N per pad) lifts, grams."""
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
    """Return the wrenches of all edges of a grasp's friction cones, (6, EDGES n)."""
    points = np.array(GRASPS[name])
    columns = []
    for point in points:
        normal = -point / np.linalg.norm(point)
        if name == "three on top":
            normal = np.array([0, 0, -1.0])
        columns.append(matrix(point[None], np.zeros(3)) @ edges(normal, mu, EDGES).T)
    return np.hstack(columns)


def resists(W: np.ndarray, wanted: np.ndarray) -> bool:
    """Return whether weights of at least 0 produce each of the wrenches wanted, (n, 6).

    MuJoCo's solver minimises |W w - wrench|^2 + 1e-8 |w|^2 over w >= 0, with moments
    divided by half the cube's width. It does not use the certificate's weights.
    """
    unit = np.repeat([day14_mujoco.HALF, 1.0], 3)  # of moments, and of forces
    scaled = W / unit[:, None]
    n = W.shape[1]
    H = scaled.T @ scaled + 1e-8 * np.eye(n)
    factor, free = np.zeros((n, n + 7)), np.zeros(n, np.int32)
    for wrench in wanted:
        w = np.zeros(n)
        bounds = np.zeros(n), np.full(n, 1e6)
        mujoco.mju_boxQP(w, factor, free, H, -scaled.T @ wrench, *bounds)  # fills w
        if np.abs(scaled @ w - wrench).max() > 1e-4 * np.abs(wrench).max():
            return False
    return True


def given_to_functions(rng: np.random.Generator) -> dict[str, list[tuple]]:
    """Return arguments for the functions that are compared with the library."""
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
    """Return grasps with weights: certificates, and some that are none."""
    right = (grasp.cone_edges, grasp.grasp_matrix)
    W, line, face = (wrenches(name, 0.5, *right) for name in
                     ("four around", "two, opposite", "three on top"))  # fmt: skip
    even = np.ones(W.shape[1])
    one = np.eye(len(even))
    ahead = W[:, :EDGES].mean(axis=1)  # between a cone's edges
    raised = W.copy()  # the first contact, by 10 mm: forces balance, moments do not
    raised[:3, :EDGES] += np.cross([0, 0, 0.01], W[3:, :EDGES].T).T
    nearly = line.copy()  # hardly any moment about the line
    nearly[1] = 1e-12 * np.tile([1, -1], EDGES)
    sums = W.sum(axis=0)
    mixed = even + 0.5 * (sums[6] * one[1] - sums[1] * one[6])  # the sum is 0
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
    """Return the final height of each cube, m, (n,); noise is the camera's."""
    heights = []
    for cube, one in zip(cubes, noise, strict=True):
        T = se3.make_T(se3.Rz(cube.yaw), (cube.x, cube.y, day14_mujoco.HALF))
        action = act(theta, observe(T, one))
        # mujoco.mj_step runs the episode
        heights.append(day14_mujoco.lift(model, data, cube, action, touch))
    return np.array(heights)


def learn(model, data, seed: int) -> np.ndarray:
    """Return the policy theta, (6,), after ROUNDS generations on rough cubes."""
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
    """Return the cubes of the test, and the camera's noise for each."""
    rng = np.random.default_rng(CUBES_SEED)
    cubes = day14_mujoco.cubes(TESTED, rng, mu)
    return cubes, NOISE * rng.normal(size=(TESTED, 3))


def held(heights: np.ndarray) -> np.ndarray:
    """Return which cubes were held, (n,): neither left behind nor thrown nor lost."""
    return (heights > HELD) & (heights <= CAP)


def about(n: int) -> str:
    """Return a number of cubes, rounded to 5: it may differ between machines."""
    return f"about {5 * round(n / 5)}"


def beside_the_cube(model, data, cube) -> np.ndarray:
    """Return the error of the hand's pose against your act, in the cube's frame.

    The first two entries are the error of the shift, the others those of the rotation
    matrix, up to quarter turns of the cube.
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
    """Return the grip force of a policy that is aligned with the cube, N per pad."""
    opening = np.clip(theta[4], LOW[4], HIGH[4])
    return day14_mujoco.SPRING * (day14_mujoco.HALF - opening)


def told(name: str, success: np.ndarray) -> np.ndarray:
    """Print the rounded number of held cubes; return rate and interval, (3,)."""
    rate = success_rate(success)
    print(f"  {name:27}{about(np.sum(success)):>9} of {len(success)}, "
          f"95 %: {rate[1]:.1f} to {rate[2]:.1f}")  # fmt: skip
    return rate


def needed(within: float) -> int:
    """Return how many cubes a rate of one half needs for this half-width."""
    low, high = 0, 10_000
    while high - low > 2:
        n = (low + high) // 4 * 2
        rate, least, most = success_rate(np.arange(n) < n // 2)
        low, high = (low, n) if max(rate - least, most - rate) <= within else (n, high)
    return high


def feeling(model, data, theta, cubes, noise) -> tuple[np.ndarray, np.ndarray]:
    """Return which cubes your reflex holds, (n,), and the grip forces, N, (n,)."""
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
    """Compare your functions with the library's of the same names."""
    for name, function in own.items():
        off = off_library(library, name, function, given[name])
        lab.check(f"|{name} - the library's|", off)


def try_grasps() -> list[float]:
    """Print which grasps your function certifies; return the differences to MuJoCo."""
    wanted = np.random.default_rng(SEED).normal(size=(20, 6))
    print("  grasp              mu   rank  certificate   wrenches made, weights >= 0")
    off = []
    for name in GRASPS:
        for mu in (0.0, 0.5):
            W = wrenches(name, mu)
            proof = certifies_force_closure(W, np.ones(W.shape[1]))
            made = resists(W, wanted)  # by MuJoCo's mju_boxQP
            print(f"  {name:14}{mu:7}{np.linalg.matrix_rank(W):7}"
                  f"{'yes' if proof else 'no':>13}   "
                  f"{'all 20' if made else 'not all'}")  # fmt: skip
            off.append(float(proof) - float(made))
    return off


def try_policy(lab: Lab, model, data, theta: np.ndarray) -> np.ndarray:
    """Test a policy on unseen cubes; return which slippery ones it held, (n,)."""
    rough = held(tried(model, data, theta, *unseen(ROUGH)))
    low = told(f"friction {ROUGH[0]} to {ROUGH[1]}", rough)[1]
    lab.record("unseen", low, metric="low_end", label="lower endpoint of the interval",
               seed=CUBES_SEED)  # fmt: skip
    cubes, noise = unseen(SLIPPERY)
    slippery = held(tried(model, data, theta, cubes, noise))
    told(f"friction {SLIPPERY[0]} to {SLIPPERY[1]}", slippery)
    limit = np.array([2 * cube.mu * squeezed(theta) / G for cube in cubes])
    heavy = np.array([cube.mass for cube in cubes]) > limit
    print(f"  too heavy by m > 2 mu F / g: {np.sum(heavy)} cubes; "
          f"{np.sum(heavy & ~slippery)} of them were dropped")  # fmt: skip
    lab.measured("fraction of slippery cubes held", np.mean(slippery))
    lab.measured("cubes for a rate of 0.5 to within 0.05", needed(0.05))
    return slippery


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model, data = day14_mujoco.hand()
    given = given_to_functions(np.random.default_rng(SEED))
    print(f"MuJoCo {mujoco.mj_versionString()}: two pads and a cube")

    lab.step("1. The friction cone and the grip reflex")
    off, left = [], []
    for felt, theirs in felt_while_lifting(model, data):
        off.extend(cone_margin(felt.force, felt.normal, felt.mu) - theirs)
        left.append(moved_by(model, data, felt))
    lab.record("cone", off, label="|margin - by mj_contactForce|, N", seed=SEED)
    same_as(lab, grasp, given, grip_reflex_step=grip_reflex_step)

    lab.step("2. The grasp matrix, and the heaviest cube")
    left = [one for one in left if one is not None]
    lab.record("grasp", left, metric="balance_n", seed=SEED,
               label="|G f - m (a - g) by MuJoCo|, N and N m")  # fmt: skip
    print("   mu   N per pad   2 mu F / g   measured, g")
    for mu, squeeze in ((0.3, 2), (0.2, 4), (0.5, 8)):
        grams = heaviest(model, data, mu, squeeze)
        print(f"  {mu}{squeeze:10}{2000 * mu * squeeze / G:13.0f}{grams:13.0f}")
        lab.measured(f"heaviest cube, mu {mu}, {squeeze} N per pad, g", grams)

    lab.step("3. Force closure")
    same_as(
        lab,
        grasp,
        given,
        cone_edges=cone_edges,
        certifies_force_closure=certifies_force_closure,
    )
    lab.check("certificate - all wrenches made, by mju_boxQP", try_grasps())

    lab.step("4. A policy with six parameters")
    same_as(lab, policy, given, observe=observe, act=act, reward=reward,
            cem_step=cem_step, success_rate=success_rate)  # fmt: skip
    off = [beside_the_cube(model, data, cube) for cube in unseen(ROUGH)[0][:LIFTS]]
    lab.record("policy", off, label="|act - where MuJoCo has the hand|",
               seed=CUBES_SEED)  # fmt: skip
    if lab.failed:
        print("\nNot trained, because a check above failed. ARGS=--try trains anyway.")
        return lab.finish()

    lab.step(f"5. The cross-entropy method, friction {ROUGH[0]} to {ROUGH[1]}")
    theta = learn(model, data, SEED)
    for name, first, last in zip(NUMBERS, START, theta, strict=True):
        print(f"  {name:12}{first:7.3f}  ->{last:z8.3f}")
    print(f"  grip force: about {squeezed(theta):.1f} N per pad")

    lab.step(f"6. {TESTED} cubes that had no part in training")
    slippery = try_policy(lab, model, data, theta)

    lab.step("7. The same policy with the grip reflex")
    cubes, noise = unseen(SLIPPERY)
    feels, newtons = feeling(model, data, theta, cubes, noise)
    told(f"friction {SLIPPERY[0]} to {SLIPPERY[1]}", feels)
    print(f"  median grip force at the end: about {np.median(newtons):.0f} N, of 8")

    lab.step("8. Side quest: a paired comparison")
    with lab.side_quest():
        same_as(lab, policy, given, paired_difference=paired_difference)
        apart, sigma = paired_difference(feels, slippery)
        lab.record("slippery_gain", np.round(apart - 1.96 * sigma, 1), metric="low_end",
                   label="gain of the reflex, lower endpoint", seed=SEED)  # fmt: skip
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
