"""Day 21: onto the arm, with limits, late plans, a guard and a fair comparison.

    make day21                       in the clone: sets all up, then runs this
    python src/day21_deploy.py       in w3-learning/, once that is done

An observation is (pusher x, y, puck x, y), metres, (4,). A plan (K, 2) has one velocity
for each tick of 0.1 s, m/s. On the arm, the pusher is the ball in the hand.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, cloning, evaluation
from robo47.lesson.lab import Lab

import day15_mujoco

SEED = 21  # of all draws


def clamp_speed(v: np.ndarray, limit: float) -> np.ndarray:
    """Return a velocity whose norm is at most limit, and whose direction is v's, (n,).

    A velocity v (n,) that is not too fast stays as it is. v may be 0, and limit may be
    0. clamp_speed([0.3, 0.4], 0.25) -> [0.15, 0.2]
    """
    # region 21.1
    speed = np.linalg.norm(v)  # norm of the velocity
    if speed <= limit:
        return v  # slow enough
    return v * (limit / speed)  # as fast as allowed, in the same direction
    # endregion 21.1


def keep_inside(
    p: np.ndarray, v: np.ndarray, low: np.ndarray, high: np.ndarray, dt: float
) -> np.ndarray:
    """Return a velocity, (n,), that does not leave a box during dt.

    p (n,) is the position and v (n,) the wanted velocity, held for dt. The box is from
    low (n,) to high (n,). Each entry is limited by itself, and only as far as
    necessary: with p inside, the next position is p + dt v, clamped to the box. If an
    entry of p is outside, its velocity becomes 0 if it leads further out, and stays as
    it is if it leads back. It never leads through the box to the other side.
    keep_inside([0.19, 0.1], [0.2, 0.1], [-0.2, -0.3], [0.2, 0.3], 0.1) -> [0.1, 0.1]
    """
    # region 21.2
    slowest = np.minimum((low - p) / dt, 0)  # 0 for an entry that is below the box
    fastest = np.maximum((high - p) / dt, 0)  # 0 for an entry that is above the box
    return np.clip(v, slowest, fastest)  # each entry limited by itself
    # endregion 21.2


def plan_entry(plan: np.ndarray, drawn: int, now: int) -> np.ndarray:
    """Return the action of a plan for the present tick, (m,).

    plan (K, m) was drawn from what was observed at the tick drawn. Its rows are the
    actions for the ticks drawn, drawn + 1, and so on. now is the present tick, drawn or
    later. If the plan has run out, return its last row.
    plan_entry([[1], [2], [3], [4], [5]], 12, 15) -> [4]
    """
    # region 21.3
    row = min(now - drawn, len(plan) - 1)  # the last row if the plan has run out
    return plan[row]
    # endregion 21.3


def push_ahead(
    obs: np.ndarray, actions: np.ndarray, dt: float, steps: int, reach: float
) -> np.ndarray:
    """Return the predicted observation after some actions, (4,).

    obs is (pusher x, y, puck x, y). Each row of actions (k, 2) is a velocity of the
    pusher, held for dt; k may be 0. Divide each action into steps equal parts. In each
    part the pusher moves first. Then, if the puck is nearer than reach, it is moved
    away from the pusher, along the line of centres, to the distance reach. The pusher
    is not affected by the puck.
    push_ahead([0, 0, 0.06, 0], [[0.1, 0]], 0.1, 5, 0.065) -> [0.01, 0, 0.075, 0]
    """
    # region 21.4
    pusher, puck = obs[:2], obs[2:]
    for action in actions:
        for _ in range(steps):
            pusher = pusher + action * dt / steps  # the pusher moves
            apart = puck - pusher  # from the pusher to the puck
            distance = np.linalg.norm(apart)  # of both centres
            if distance < reach:
                puck = pusher + apart * reach / distance  # the puck is moved
    return np.concatenate([pusher, puck])  # the observation at the end
    # endregion 21.4


def conformal_limit(scores: np.ndarray, share: float) -> float:
    """Return the limit that a new score exceeds with a probability of at most share.

    scores (n,) were computed from data that the policy was not trained on; n may be 0.
    The limit is the k-th smallest score, k = ceil((n + 1) (1 - share)). If k is above
    n, the limit is infinity. share is at least 0 and below 1.
    conformal_limit([3, 1, 2], 0.5) -> 2
    """
    # region 21.5
    n = len(scores)  # number of scores
    k = int(np.ceil((n + 1) * (1 - share)))  # rank of the limit, from 1
    return np.sort(scores)[k - 1] if k <= n else np.inf
    # endregion 21.5


def alarm_at(score: np.ndarray, limit: float, ticks: int) -> int:
    """Return the first tick at which the score was above limit for ticks in a row.

    score (T,) has one entry for each tick, from tick 0. The tick that is returned is
    the last of these ticks in a row. A NaN is treated as above the limit. If there is
    no such tick, return -1. alarm_at([0.1, 0.9, 0.2, 0.9, 0.9, 0.9], 0.5, 3) -> 5
    """
    # region 21.6
    above = 0  # ticks in a row
    for tick in range(len(score)):
        above = 0 if score[tick] <= limit else above + 1  # a NaN is not <= limit
        if above == ticks:
            return tick  # long enough in a row
    return -1
    # endregion 21.6


def lag_behind(v: float, stiffness: float, inertia: float) -> float:
    """Return how far a spring trails its set point, which moves at v, in metres.

    The spring has the stiffness K, N/m, and moves the inertia Lambda, kg. Its damper is
    critical, D = 2 sqrt(K Lambda), and acts on the absolute velocity. All has settled.
    lag_behind(1, 1, 4) -> 4
    """
    # region 21.7
    return 2 * v * np.sqrt(inertia / stiffness)  # the spring balances the damper
    # endregion 21.7


def compare_all(success: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compare the first of k policies with each of the others: (p, different).

    success (k, n) is True where a policy succeeds on a start; k is at least 2. p is
    (k - 1,): the p-value of the sign test (task 18.4) of the first row and each other
    row. different is (k - 1,), True where Holm's method (task 18.8) finds a difference
    among these k - 1 comparisons. If only the first policy succeeds, on 9 starts, p is
    0.00390625.
    """
    # region 21.8
    p = np.array(  # the first policy and each other one
        [evaluation.sign_test(success[0], other) for other in success[1:]]
    )
    return p, evaluation.holm(p)  # the p-values, and which of them are significant
    # endregion 21.8
