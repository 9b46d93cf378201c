"""Between a learned policy and an arm: limits, late plans, a guard, a comparison.

A policy is learned in a plane and drives the hand of an arm. Conventions:

- Positions are in metres, velocities in m/s; an observation is (pusher x, y, puck x, y)
  as in `robo47.push`.
- A plan is one action per row, for consecutive ticks. The tick at which a plan is
  drawn is the tick of the observation that it is drawn from.
- A score measures how unusual an observation is: larger is more unusual.

Sources: Vovk, Gammerman and Shafer, "Algorithmic learning in a random world" (2005),
and Angelopoulos and Bates, "A gentle introduction to conformal prediction" (2021);
Black, Galliker and Levine, "Real-time execution of action chunking flow policies"
(2025), plans that arrive late; Holm (1979), see `robo47.evaluation`.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robo47 import checks, evaluation
from robo47.checks import Array

ROUNDING = 1e-9  # by which a product may be above a whole number


def clamp_speed(v: ArrayLike, limit: float) -> Array:
    """Return a velocity with a norm of at most `limit` and an unchanged direction.

    Args:
        v: velocity, (..., n); its last axis is the vector.
        limit: largest norm, in the unit of v, 0 or more.

    Returns:
        (..., n): v itself if its norm is not above the limit.

    Raises:
        ValueError: a number that is not finite, or a limit below 0.
    """
    v = checks.array(v, "v", ("n",))
    limit = float(checks.not_negative(limit, "limit"))
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    factor = np.ones_like(speed)
    np.divide(limit, speed, out=factor, where=speed > limit)
    return v * factor


def keep_inside(
    p: ArrayLike, v: ArrayLike, low: ArrayLike, high: ArrayLike, dt: float
) -> Array:
    """Return a velocity that does not leave an axis-aligned box within dt.

    Each entry is limited by itself, so motion along a wall goes on. At a position
    outside of the box, an entry that leads further out becomes 0, and an entry that
    leads back is kept: there is no jump to the wall.

    Args:
        p: position, (n,).
        v: velocity, (n,).
        low, high: smallest and largest position inside the box, (n,) each.
        dt: how long the velocity is held, seconds, above 0.

    Returns:
        (n,).

    Raises:
        ValueError: different shapes, a low above its high, or dt not above 0.
    """
    p, v, low, high = checks.same_size(p=p, v=v, low=low, high=high)
    dt = float(checks.positive(dt, "dt"))
    if np.any(low > high):
        raise ValueError("low is above high in the box; expected at most high")
    slowest = np.minimum((low - p) / dt, 0.0)
    fastest = np.maximum((high - p) / dt, 0.0)
    return np.clip(v, slowest, fastest)


def plan_entry(plan: ArrayLike, drawn: int, now: int) -> Array:
    """Return the action of a plan for the current tick, (m,).

    Args:
        plan: actions for the ticks drawn, drawn + 1, ..., (K, m).
        drawn: tick of the observation that the plan was drawn from.
        now: the current tick, not before `drawn`.

    Returns:
        The row now - drawn; the last row if the plan has run out.

    Raises:
        ValueError: no plan (K, m), or one that was drawn after `now`.
    """
    plan = checks.array(plan, "plan", ("K", "m"))
    if now < drawn:
        raise ValueError(f"the plan was drawn at tick {drawn}, after now = {now}")
    return plan[min(now - drawn, len(plan) - 1)].copy()


def push_ahead(
    obs: ArrayLike, actions: ArrayLike, dt: float, steps: int, reach: float
) -> Array:
    """Return the predicted observation after some actions, (4,).

    The push is quasi-static: the puck moves only if it is pushed, and along the line
    of centres (`robo47.cloning.contact_angle` is the limit of many steps).

    Args:
        obs: pusher x, y, puck x, y, metres, (4,).
        actions: velocities of the pusher in m/s, held for dt each, (k, 2); k may be 0.
        dt: seconds.
        steps: equal parts of each action, 1 or more. In each part the pusher moves,
            and then a puck nearer than `reach` is moved away from it to this distance.
        reach: distance of both centres in contact, metres.

    Returns:
        (4,).

    Raises:
        ValueError: a wrong shape, no step, or both centres at one point.
    """
    obs = checks.array(obs, "obs", (4,))
    actions = checks.array(actions, "actions", (2,))
    if actions.ndim != 2 or steps < 1:
        raise ValueError(
            f"actions has shape {actions.shape} and steps is {steps}; "
            "expected (k, 2) and at least 1"
        )
    pusher, puck = obs[:2], obs[2:]
    for action in np.repeat(actions, steps, axis=0):
        pusher = pusher + action * (dt / steps)
        apart = puck - pusher
        distance = np.linalg.norm(apart)
        if distance == 0.0:
            raise ValueError("pusher and puck have one centre: no direction of a push")
        if distance < reach:
            puck = pusher + apart * (reach / distance)
    return np.concatenate([pusher, puck])


def conformal_limit(scores: ArrayLike, share: float) -> float:
    """Return the limit that a new score exceeds with a probability of at most `share`.

    It holds for any distribution, if the new score and the n given scores are
    exchangeable (split conformal prediction).

    Args:
        scores: of n held-out cases, (n,); n may be 0.
        share: largest probability of a false alarm, 0 to 1.

    Returns:
        The k-th smallest score, k = ceil((n + 1) (1 - share)); infinity if k is above
        n, which happens with too few scores, and minus infinity for k = 0.

    Raises:
        ValueError: no vector, a score that is NaN, or share outside of 0 to 1.
    """
    scores = np.asarray(scores, dtype=np.float64)
    if scores.ndim != 1 or np.isnan(scores).any():
        raise ValueError("scores must be a vector without NaN")
    if not 0.0 <= share <= 1.0:
        raise ValueError(f"share is {share}; expected a number between 0 and 1")
    k = int(np.ceil((len(scores) + 1) * (1.0 - share) - ROUNDING))
    ranked = np.concatenate([[-np.inf], np.sort(scores), [np.inf]])
    return float(ranked[k])


def alarm_at(score: ArrayLike, limit: float, ticks: int) -> int:
    """Return the first tick at which a score has been too large for long enough.

    Args:
        score: at each tick, (T,); a NaN is treated as too large.
        limit: a score above it is too large.
        ticks: number of consecutive ticks, 1 or more; the returned tick is the last
            of them.

    Returns:
        The index of the tick, or -1 if there is none.

    Raises:
        ValueError: no vector, a limit that is NaN, or ticks below 1.
    """
    score = np.asarray(score, dtype=np.float64)
    if score.ndim != 1 or np.isnan(limit) or ticks < 1:
        raise ValueError(
            f"score has shape {score.shape}, limit is {limit} and ticks is {ticks}; "
            "expected a vector, a number and at least 1"
        )
    in_a_row = 0
    for tick, fine in enumerate(score <= limit):
        in_a_row = 0 if fine else in_a_row + 1
        if in_a_row == ticks:
            return tick
    return -1


def lag_behind(v: float, stiffness: float, inertia: float) -> float:
    """Return the steady-state lag of the hand behind a set point of constant velocity.

    A spring with a critical damper moves the hand to the set point, without feedforward
    velocity: the damper acts on the absolute velocity of the hand. In the steady state
    the spring balances the damper, K e = D v with D = 2 sqrt(K Lambda).

    Args:
        v: velocity of the set point, m/s.
        stiffness: K of the spring, N/m, above 0.
        inertia: Lambda in this direction, kg, 0 or more.

    Returns:
        2 v sqrt(Lambda / K), metres, with the sign of v.

    Raises:
        ValueError: a number that is not finite or is out of its range.
    """
    v = float(checks.array(v, "v", ()))
    stiffness = float(checks.positive(stiffness, "stiffness"))
    inertia = float(checks.not_negative(inertia, "inertia"))
    return 2.0 * v * float(np.sqrt(inertia / stiffness))


def compare_all(success: ArrayLike) -> tuple[Array, NDArray[np.bool_]]:
    """Compare the first of k policies with each other one on the same starts.

    Args:
        success: of each policy on each start, (k, n), True and False or 1 and 0.

    Returns:
        (p, different), (k - 1,) each: the p-values of `evaluation.sign_test` of row 0
        and row 1, 2, ..., and which of these differences `evaluation.holm` reports.

    Raises:
        ValueError: no matrix with a row, or an entry that is neither 0 nor 1.
    """
    success = np.asarray(success)
    if success.ndim != 2 or len(success) == 0:
        raise ValueError(f"success has shape {success.shape}; expected (k, n), k >= 1")
    p = np.array([evaluation.sign_test(success[0], one) for one in success[1:]])
    return p, evaluation.holm(p)
