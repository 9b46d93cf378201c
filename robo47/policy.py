"""A policy of six numbers, what it is worth, and how it learns.

theta = (shift x, shift y, turn, height, opening, lift), (6,): where the hand goes
beside a cube, in the *cube's* axes, how high it grasps, how far each finger is told to
close (less than the cube's half width: it presses), how far it lifts. Conventions:

- What is random is an argument: a camera's noise, a search's samples.
- A policy is judged by cubes that it has not been trained on, with an interval.
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

# What the hand can do: a theta beyond it is clipped.
LOW = np.array([-0.02, -0.02, -0.8, 0.0, -0.02, 0.0])
HIGH = np.array([0.02, 0.02, 0.8, 0.04, 0.04, 0.25])
LOW.setflags(write=False)
HIGH.setflags(write=False)


def observe(T_seen: ArrayLike, noise: ArrayLike) -> Array:
    """Return what a policy is told of a cube: where it is, and how it is turned.

    A cube looks the same four times a turn, so its yaw, with the noise in it, is folded
    into [-pi / 4, pi / 4).

    Args:
        T_seen: the cube's pose, upright, (4, 4).
        noise: of x, y, yaw: metres, metres, radians, (3,).

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
    """Return what the hand is to do: x, y, yaw, height, opening, lift.

    Args:
        theta: the policy, (6,); clipped to `LOW` and `HIGH` first.
        observation: from `observe`, (3,): the shift is in the axes of the cube as it
            was seen.

    Returns:
        (6,): hand's place and turn in the world, then theta's last three numbers.

    Raises:
        ValueError: a wrong shape.
    """
    dx, dy, turn, *rest = np.clip(checks.array(theta, "theta", (6,)), LOW, HIGH)
    x, y, yaw = checks.array(observation, "observation", (3,))
    c = np.cos(yaw)
    s = np.sin(yaw)
    return np.array([x + c * dx - s * dy, y + s * dx + c * dy, yaw + turn, *rest])


def reward(heights: ArrayLike, target: float, cap: float) -> Array:
    """Return what episodes are worth: 1 where a cube was lifted to the target.

    Args:
        heights: at the end of each, metres, (n,); NaN where the simulation was lost.
        target: metres, above 0: more is worth no more.
        cap: metres: what is higher was thrown.

    Returns:
        (n,): 0 to 1; -1 for what was thrown or lost.

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
    """Return the next bell of policies: that of the best of this one's samples.

    Args:
        mean, std: of each number, (d,).
        noise: from which the samples mean + std noise were made, (n, d).
        scores: of the samples, (n,); a NaN is worse than all others, of equals the
            first is better.
        elite: how many are kept, 1 to n.

    Returns:
        (mean, std), (d,) each: those of the elite (Rubinstein, 1999), over its number.

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
    """Return a rate and its 95 % interval (Wilson's).

    Args:
        success: True or 1 where it was one, (n,).

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
    """Return by how much the first is better than the second, on the same cubes.

    Args:
        first, second: success or worth of each, cube by cube, (n,) each.

    Returns:
        (mean, sigma), (2,): the mean of the differences, and how sure it is, their
        standard deviation (over n) divided by sqrt(n).

    Raises:
        ValueError: wrong shapes.
    """
    one, two = checks.same_size(first=first, second=second)
    apart = one - two
    return np.array([apart.mean(), apart.std() / np.sqrt(len(apart))])
