"""Learning from reward: policy gradients, advantages, PPO, and an exact gradient.

A policy draws its action from a Gaussian: independent entries with a mean that depends
on the state and standard deviations exp(log_std). Conventions:

- Time comes first: rewards of T steps in n episodes are (T, n).
- An episode *ends* at a row where `ended` is True: nothing that follows belongs to it.
  It is *terminated* where the state after the row is worth 0; an episode that was cut
  off has ended without being terminated.
- `value` is what a state is worth: its expected, discounted return.
- `policy_cost` and its gradient are of the linear policy u = -K x + std z on Day 13's
  linear system, so that an estimate of a gradient has an exact value beside it.

Sources: Williams, "Simple statistical gradient-following algorithms" (1992), REINFORCE;
Schulman and others, "High-dimensional continuous control using generalized advantage
estimation" (2016) and "Proximal policy optimization algorithms" (2017); Fazel and
others, "Global convergence of policy gradient methods for the linear quadratic
regulator" (2018); Ng, Harada and Russell, "Policy invariance under reward
transformations" (1999).
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array

PARTS = 5  # of an action, in `push_by_equation`


def log_prob(action: ArrayLike, mean: ArrayLike, log_std: ArrayLike) -> Array:
    """Return the logarithm of a Gaussian's density at each action, (n,).

    Args:
        action, mean: (n, m).
        log_std: logarithms of the standard deviations, (m,).

    Returns:
        (n,): the sum over the m independent entries.

    Raises:
        ValueError: shapes that do not match, or a number that is not finite.
    """
    z, log_std = _standardised(action, mean, log_std)
    half: Array = -0.5 * np.sum(z**2, axis=1)
    return half - np.sum(log_std) - 0.5 * z.shape[1] * np.log(2.0 * np.pi)


def log_prob_gradient(
    action: ArrayLike, mean: ArrayLike, log_std: ArrayLike
) -> tuple[Array, Array]:
    """Return the gradients of `log_prob` with respect to mean and log_std.

    Args:
        action, mean, log_std: of `log_prob`.

    Returns:
        z / std and z^2 - 1 with z = (action - mean) / std, (n, m) each.

    Raises:
        ValueError: as for `log_prob`.
    """
    z, log_std = _standardised(action, mean, log_std)
    return z / np.exp(log_std), z**2 - 1.0


def returns(reward: ArrayLike, gamma: float, last: ArrayLike) -> Array:
    """Return the discounted return from each step to the end.

    Args:
        reward: (T, n).
        gamma: discount factor, 0 to 1.
        last: value of the state after the last step, (n,).

    Returns:
        (T, n): reward[t] + gamma reward[t + 1] + ..., with last after the rewards.

    Raises:
        ValueError: a wrong shape, a number that is not finite, or gamma out of range.
    """
    reward = checks.array(reward, "reward", ("T", "n"))
    gamma = _factor(gamma, "gamma")
    running = checks.array(last, "last", reward.shape[1:])
    out = np.empty_like(reward)
    for t in reversed(range(len(reward))):
        running = reward[t] + gamma * running
        out[t] = running
    return out


def gae(
    reward: ArrayLike,
    value: ArrayLike,
    next_value: ArrayLike,
    terminated: ArrayLike,
    ended: ArrayLike,
    gamma: float,
    lam: float,
) -> Array:
    """Return the generalized advantage estimates of each step.

    The temporal-difference error is reward + gamma next_value - value, without
    next_value where the episode terminated. The advantage is this error plus
    gamma lam times the advantage of the next row, which is left out where the episode
    ended and after the last row.

    Args:
        reward, value, next_value: (T, n); the value of the state before the step and
            of the state that the step leads to.
        terminated: True (or 1) where the state after the step is worth 0, (T, n).
        ended: True (or 1) at the last step of an episode, (T, n).
        gamma: discount factor, 0 to 1.
        lam: 0 (one step, then the values) to 1 (rewards to the end of the episode).

    Returns:
        (T, n).

    Raises:
        ValueError: a wrong shape, a number that is not finite, a factor out of range,
            or a step that terminated without having ended.
    """
    reward = checks.array(reward, "reward", ("T", "n"))
    value = checks.array(value, "value", reward.shape)
    next_value = checks.array(next_value, "next_value", reward.shape)
    true_end = _flags(terminated, "terminated", reward)
    end = _flags(ended, "ended", reward)
    if np.any(true_end & ~end):
        raise ValueError("a step that is terminated must be ended as well")
    delta = reward + _factor(gamma, "gamma") * next_value * ~true_end - value
    factor = gamma * _factor(lam, "lam") * ~end
    out, running = np.empty_like(delta), np.zeros(delta.shape[1:])
    for t in reversed(range(len(delta))):
        running = delta[t] + factor[t] * running
        out[t] = running
    return out


def policy_gradient(score: ArrayLike, advantage: ArrayLike) -> Array:
    """Return the estimate of the gradient of the expected return, (d,).

    Args:
        score: gradient of each action's log-probability by the parameters, (T, n, d).
        advantage: weight of each action, (T, n).

    Returns:
        (d,): the mean over the n episodes of the sums over the T steps.

    Raises:
        ValueError: a wrong shape, or a number that is not finite.
    """
    score = checks.array(score, "score", ("T", "n", "d"))
    advantage = checks.array(advantage, "advantage", score.shape[:2])
    total: Array = np.einsum("tnd,tn->d", score, advantage)
    return total / score.shape[1]


def ppo_loss(
    logp: ArrayLike, old_logp: ArrayLike, advantage: ArrayLike, clip: float
) -> tuple[float, Array]:
    """Return PPO's clipped loss and its gradient with respect to logp.

    The loss is minus the mean of min(ratio A, clipped ratio A), where the ratio is
    exp(logp - old_logp), clipped to 1 - clip to 1 + clip, and A is the advantage.

    Args:
        logp: log-probability of each action by the current policy, (n,).
        old_logp: by the policy that drew the actions, (n,).
        advantage: (n,).
        clip: half the width of the range, above 0.

    Returns:
        (loss, gradient): the gradient is -ratio A / n, and 0 where the clipped term is
        the smaller one. Exponents are limited to 600, so that no
        ratio overflows.

    Raises:
        ValueError: a wrong shape, a number that is not finite, or clip not above 0.
    """
    old_logp, logp, advantage = checks.same_size(
        old_logp=old_logp, logp=logp, advantage=advantage
    )
    clip = float(checks.positive(clip, "clip"))
    ratio = np.exp(np.minimum(logp - old_logp, 600.0))  # times A it stays finite
    free = ratio * advantage
    clipped = np.clip(ratio, 1.0 - clip, 1.0 + clip) * advantage
    loss = -float(np.mean(np.minimum(free, clipped)))
    return loss, np.where(free <= clipped, -free / len(ratio), 0.0)


def policy_cost(
    K: ArrayLike,
    std: float,
    A: ArrayLike,
    B: ArrayLike,
    Q: ArrayLike,
    R: ArrayLike,
    S: ArrayLike,
    T: int,
) -> float:
    """Return the expected cost of T steps with the policy u = -K x + std z.

    The second moment X = E[x x^T] of the state begins with S and becomes
    M X M^T + std^2 B B^T with M = A - B K. Each step costs
    tr((Q + K^T R K) X) + std^2 tr R.

    Args:
        K: gain, (m, k); complex numbers pass through.
        std: standard deviation of the noise of each entry of u.
        A, B: of the step x+ = A x + B u, (k, k) and (k, m).
        Q, R: cost of a step, x . Q x + u . R u, symmetric, (k, k) and (m, m).
        S: second moment of the state at the start, (k, k).
        T: number of steps.

    Returns:
        The expected sum of the costs.

    Raises:
        ValueError: a wrong shape, or T below 1.
    """
    gain, width, a, b, q, r, moment = _problem(K, std, A, B, Q, R, S, T)
    M = a - b @ gain
    weight = q + gain.T @ r @ gain
    total = T * width**2 * np.trace(r)
    for _ in range(T):
        total = total + np.trace(weight @ moment)
        moment = M @ moment @ M.T + width**2 * b @ b.T
    cost: float = total.item()
    return cost


def policy_cost_gradient(
    K: ArrayLike,
    std: float,
    A: ArrayLike,
    B: ArrayLike,
    Q: ArrayLike,
    R: ArrayLike,
    S: ArrayLike,
    T: int,
) -> Array:
    """Return the gradient of `policy_cost` with respect to K, (m, k).

    With P_T = 0 and P_t = Q + K^T R K + M^T P_{t+1} M it is the sum over the steps of
    2 (R K - B^T P_{t+1} M) X_t (the adjoint of the recursion of X).

    Args:
        K, std, A, B, Q, R, S, T: of `policy_cost`.

    Returns:
        (m, k).

    Raises:
        ValueError: a wrong shape, or T below 1.
    """
    gain, width, a, b, q, r, moment = _problem(K, std, A, B, Q, R, S, T)
    M = a - b @ gain
    moments = [moment]
    for _ in range(T - 1):
        moments.append(M @ moments[-1] @ M.T + width**2 * b @ b.T)
    P, total = np.zeros_like(q), np.zeros_like(gain)
    for X in reversed(moments):
        total = total + 2.0 * (r @ gain - b.T @ P @ M) @ X
        P = q + gain.T @ r @ gain + M.T @ P @ M
    return total


def effective_samples(logp: ArrayLike, old_logp: ArrayLike) -> float:
    """Return the effective sample size of reweighted samples, (sum w)^2 / sum w^2.

    The importance weights are w = exp(logp - old_logp); the largest exponent is
    subtracted first, which changes nothing and cannot overflow.

    Args:
        logp, old_logp: log-probabilities by the new and by the old policy, (n,).

    Returns:
        1 (one sample has all the weight) to n (all weights are equal).

    Raises:
        ValueError: a wrong shape, or a number that is not finite.
    """
    logp, old_logp = checks.same_size(logp=logp, old_logp=old_logp)
    exponent = logp - old_logp
    w = np.exp(exponent - exponent.max())
    return float(w.sum() ** 2 / np.sum(w**2))


def shaped(reward: ArrayLike, potential: ArrayLike, gamma: float) -> Array:
    """Return rewards with potential-based shaping (Ng, Harada and Russell, 1999).

    Args:
        reward: (T, n).
        potential: of the state before each step, and after the last, (T + 1, n).
        gamma: discount factor, 0 to 1.

    Returns:
        reward + gamma potential after the step - potential before it, (T, n).

    Raises:
        ValueError: a wrong shape, a number that is not finite, or gamma out of range.
    """
    reward = checks.array(reward, "reward", ("T", "n"))
    steps, n = reward.shape
    potential = checks.array(potential, "potential", (steps + 1, n))
    return reward + _factor(gamma, "gamma") * potential[1:] - potential[:-1]


def push_by_equation(
    observation: Array, action: Array, tick: float, radii: float
) -> Array:
    """Return where pusher and puck are after an action, without a simulator.

    The push is quasi-static: in each of PARTS parts of the action the pusher moves,
    and a puck nearer than the sum of both radii is moved along the line of centres to
    this distance. Mass and damping play no part.

    Args:
        observation: pusher x, y, puck x, y, metres, (n, 4).
        action: velocity of the pusher, m/s, (n, 2).
        tick: duration of the action, seconds.
        radii: sum of both radii, metres.

    Returns:
        (n, 4).
    """
    pusher, puck = observation[:, :2], observation[:, 2:]
    for _ in range(PARTS):
        pusher = pusher + tick / PARTS * action
        apart = puck - pusher
        far = np.maximum(np.linalg.norm(apart, axis=1, keepdims=True), 1e-9)
        puck = pusher + apart * np.maximum(1.0, radii / far)
    return np.hstack([pusher, puck])


def _standardised(
    action: ArrayLike, mean: ArrayLike, log_std: ArrayLike
) -> tuple[Array, Array]:
    """Return z = (action - mean) / std, (n, m), and log_std."""
    action = checks.array(action, "action", ("n", "m"))
    mean = checks.array(mean, "mean", action.shape)
    log_std = checks.array(log_std, "log_std", action.shape[1:])
    return (action - mean) / np.exp(log_std), log_std


def _factor(value: float, name: str) -> float:
    """Return a factor after checking that it is within 0 and 1."""
    if not 0.0 <= value <= 1.0:
        raise ValueError(f"{name} is {value}; expected 0 to 1")
    return float(value)


def _flags(value: ArrayLike, name: str, like: Array) -> Any:
    """Return flags, True and False or 1 and 0, as booleans."""
    flags = np.asarray(value)
    if flags.shape != like.shape:
        raise ValueError(f"{name} has shape {flags.shape}; expected {like.shape}")
    if not np.isin(flags, (0, 1)).all():
        raise ValueError(f"{name} has an entry other than True and False")
    return flags.astype(bool)


def _problem(
    K: ArrayLike,
    std: float,
    A: ArrayLike,
    B: ArrayLike,
    Q: ArrayLike,
    R: ArrayLike,
    S: ArrayLike,
    T: int,
) -> Any:
    """Return the arguments of `policy_cost` but T, after checking their shapes."""
    B = checks.array(B, "B", ("k", "m"))
    k, m = B.shape
    A, Q = checks.array(A, "A", (k, k)), checks.array(Q, "Q", (k, k))
    R, S = checks.array(R, "R", (m, m)), checks.array(S, "S", (k, k))
    std = float(checks.not_negative(std, "std"))
    gain: Any = np.asarray(K)
    gain = gain if gain.dtype.kind == "c" else checks.array(gain, "K", (m, k))
    if gain.shape != (m, k):
        raise ValueError(f"K has shape {gain.shape}; expected ({m}, {k})")
    if T < 1:
        raise ValueError(f"T is {T}; expected at least 1")
    return gain, std, A, B, Q, R, S
