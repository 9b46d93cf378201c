"""A grasp policy with six parameters, its reward, and the cross-entropy method.

theta = (shift x, shift y, rotation, height, opening, lift), (6,): the pose of the hand
relative to a cube, expressed in the *cube's* frame; the height of the grasp; the
commanded distance of each pad from the middle (below the cube's half width the pads
press); the height of the lift. Conventions:

- Random quantities are arguments: a camera's noise, a search's samples.
- A policy is tested on cubes that had no part in training, with an interval.
- Metres, radians, float64.

Sources: Rubinstein, "The cross-entropy method for combinatorial and continuous
optimization" (1999); Brown, Cai and DasGupta, "Interval estimation for a binomial
proportion" (2001).
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.planning import wilson_interval

# The limits of the hand, to which theta is clamped.
LOW = np.array([-0.02, -0.02, -0.8, 0.0, -0.02, 0.0])
HIGH = np.array([0.02, 0.02, 0.8, 0.04, 0.04, 0.25])
LOW.setflags(write=False)
HIGH.setflags(write=False)


def observe(T_seen: ArrayLike, noise: ArrayLike) -> Array:
    """Return the policy's observation of an upright cube: position and yaw.

    A rotation by 90 degrees does not change a cube, so its yaw, with the noise added,
    is reduced modulo pi / 2 to [-pi / 4, pi / 4).

    Args:
        T_seen: the cube's pose in the world frame, upright, (4, 4).
        noise: added to x, y, yaw: metres, metres, radians, (3,).

    Returns:
        (x, y, yaw), (3,).

    Raises:
        ValueError: a wrong shape, or not a pose.
    """
    T = checks.pose(checks.array(T_seen, "T_seen", (4, 4)), "T_seen")
    noise = checks.array(noise, "noise", (3,))
    yaw = np.arctan2(T[1, 0], T[0, 0]) + noise[2]
    quarter = 0.5 * np.pi
    folded = (yaw + 0.5 * quarter) % quarter - 0.5 * quarter
    return np.array([*(T[:2, 3] + noise[:2]), folded])


def act(theta: ArrayLike, observation: ArrayLike) -> Array:
    """Return the policy's action: x, y, yaw, height, opening, lift.

    Args:
        theta: the policy's parameters, (6,): x shift and y shift, metres, rotation,
            radians, height, opening and lift, metres; clamped to `LOW` and `HIGH`
            first. The shift and the rotation are relative to the observed cube.
        observation: (x, y, yaw) from `observe`, (3,).

    Returns:
        (6,): position and yaw of the hand in the world frame, then the last three
        parameters of theta.

    Raises:
        ValueError: a wrong shape.
    """
    dx, dy, turn, *rest = np.clip(checks.array(theta, "theta", (6,)), LOW, HIGH)
    x, y, yaw = checks.array(observation, "observation", (3,))
    c = np.cos(yaw)
    s = np.sin(yaw)
    return np.array([x + c * dx - s * dy, y + s * dx + c * dy, yaw + turn, *rest])


def reward(heights: ArrayLike, target: float, cap: float) -> Array:
    """Return the reward of each episode: 1 if the cube was lifted to the target.

    Args:
        heights: final heights, metres, (n,); NaN if the simulation diverged.
        target: metres, above 0; a greater height has the same reward.
        cap: metres; a cube above it was thrown.

    Returns:
        (n,): 0 to 1, linear in the height; -1 if the cube was thrown or lost.

    Raises:
        ValueError: heights that are no vector, or a target that is not above 0.
    """
    h = np.asarray(heights, dtype=np.float64)
    if h.ndim != 1:
        raise ValueError(f"heights has shape {h.shape}; expected (n,)")
    target = float(checks.positive(target, "target"))
    lost = ~np.isfinite(h) | (h > cap)
    return np.where(lost, -1.0, np.clip(h, 0.0, target) / target)


def cem_step(
    mean: ArrayLike, std: ArrayLike, noise: ArrayLike, scores: ArrayLike, elite: int
) -> tuple[Array, Array]:
    """Return the next mean and std of the cross-entropy method (Rubinstein, 1999).

    Args:
        mean, std: of the present Gaussian, one entry per parameter, (d,).
        noise: the samples are mean + std noise, (n, d).
        scores: of the samples, (n,); a NaN is worse than all other scores, and of
            equal scores the first is better.
        elite: number of samples that are kept, 1 to n.

    Returns:
        (mean, std), (d,) each: mean and standard deviation of the elite, the latter
        divided by their number.

    Raises:
        ValueError: a wrong shape or number.
    """
    mean = checks.array(mean, "mean", ("d",))
    std = checks.array(std, "std", mean.shape)
    noise = checks.array(noise, "noise", ("n", len(mean)))
    worth = np.asarray(scores, dtype=np.float64)
    if worth.shape != noise.shape[:1]:
        raise ValueError(f"scores has shape {worth.shape}; expected {noise.shape[:1]}")
    if not 1 <= elite <= len(worth):
        raise ValueError(f"elite is {elite}; expected 1 to {len(worth)}")
    best = np.argsort(-worth, kind="stable")[:elite]  # NaN sorts last
    kept = mean + std * noise[best]
    return kept.mean(axis=0), kept.std(axis=0)


def success_rate(success: ArrayLike) -> Array:
    """Return the success rate and its 95 % confidence interval (Wilson's).

    Args:
        success: True or 1 for each trial that succeeded, (n,).

    Returns:
        (rate, low, high), (3,).

    Raises:
        ValueError: no vector, or an entry that is neither 0 nor 1.
    """
    won = checks.array(success, "success", ("n",))
    if won.ndim != 1 or not np.isin(won, (0.0, 1.0)).all():
        raise ValueError("success must be a vector of True and False")
    return np.array([won.mean(), *wilson_interval(int(won.sum()), len(won))])


def paired_difference(first: ArrayLike, second: ArrayLike) -> Array:
    """Return the mean paired difference of two policies and its standard error.

    Args:
        first, second: success or reward of each, on the same cubes, (n,) each.

    Returns:
        (mean, standard error), (2,), of first minus second; the standard error is the
        standard deviation (divided by n) over sqrt(n).

    Raises:
        ValueError: wrong shapes.
    """
    one, two = checks.same_size(first=first, second=second)
    apart = one - two
    return np.array([apart.mean(), apart.std() / np.sqrt(len(apart))])
