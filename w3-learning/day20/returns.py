"""20.2 `returns(reward, gamma, last)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Matrix, Row


def none_later(rng):
    """Yield rewards with a discount factor of 0."""
    for T in (2, 4):
        yield rng.numbers(-1, 2, T, 2), 0.0, rng.numbers(-2, 2, 2)


row = Row(
    Matrix((None, None)),
    held_out=[
        HeldOut(
            "gamma-of-0",
            "Your function is correct for gamma above 0. For a gamma of 0, the return "
            "of a step is its own reward. Does your code divide by a power of gamma?",
            none_later,
        ),
    ],
)


@row.inputs
def _(rng):
    yield np.array([[1.0], [2], [3]]), 0.5, np.array([4.0])
    for T, n, gamma in (
        (1, 2, 0.8),
        (3, 1, 1.0),
        (4, 3, 0.9),
        (2, 2, 0.3),
        (5, 2, 0.6),
    ):
        yield rng.numbers(-1, 2, T, n), gamma, rng.numbers(-2, 2, n)
    yield rng.numbers(-1, 2, 3, 2), 0.7, np.zeros(2)


row.cases(
    a_last_value_of_0=lambda reward, gamma, last: not last.any(),
    another_last_value=lambda reward, gamma, last: bool(last.any()),
)
row.cases(
    a_gamma_of_1=lambda reward, gamma, last: gamma == 1,
    a_gamma_below_1=lambda reward, gamma, last: gamma < 1,
)


def powers(reward, gamma, last, first=0):
    """Return the returns with the powers of gamma from `first` on, as sums."""
    rows = np.vstack([reward, last])
    T = len(reward)
    return np.array([gamma ** np.arange(first, T + 1 - t + first) @ rows[t:]
                     for t in range(T)])  # fmt: skip


@row.wrongs
def _(reward, gamma, last):
    """from-the-start: your code sums the rewards from the first step up to each step.
      The return of a step should contain only the reward of this step and the later
      rewards
    from-the-start 2: your code computes the return of a step from the return of the
      previous step. The return of a step contains the return of the next step, so begin
      at the last step
    from-the-start 3: your code sums the reward of each step and the earlier rewards.
      The return of a step should contain the later rewards instead
    first-step-left-out: your result in row 0 is the reward and not the return. Compute
      the return of the first step as well. A loop should include row 0
    first-step-left-out 2: your result in row 0 is 0. Compute the return of the first
      step as well. A loop should include row 0
    last-by-the-horizon: your code multiplies `last` by gamma^T in the return of each
      step. In the return of step t, multiply `last` by gamma^(T - t) instead
    last-forgotten: your code omits `last`, the value of the state after the last step.
      Add `last` with the factor gamma^(T - t) to the return of step t
    last-not-discounted: your code adds `last` to the last reward without the factor
      gamma. Multiply `last` by gamma, because `last` is the value of the state one step
      later
    discount-by-time: your code discounts each reward by its time since the start. In
      the return of step t, multiply the reward of step k by gamma^(k - t) instead
    own-reward-discounted: your code multiplies the reward of step t by gamma in the
      return of step t. Use the factor 1 for this reward, gamma for the next reward, and
      so on
    whole: your code assigns the return of the whole episode to every step. Omit the
      rewards before a step from the return of this step
    last-as-reward: your code replaces the last reward with `last`. Keep the last reward
      and add gamma times `last` to it
    """
    T = len(reward)
    g = gamma ** np.arange(T)[:, None]
    tail = np.zeros(reward.shape)
    tail[-1] = last
    flipped = powers(reward[::-1], gamma, 0 * last)[::-1]
    by_time = np.cumsum((g * reward)[::-1], axis=0)[::-1] + gamma**T * last
    right = powers(reward, gamma, last)
    return {
        "from-the-start": flipped,
        "from-the-start 2": powers(reward[::-1], gamma, last)[::-1],
        "from-the-start 3": flipped + right - powers(reward, gamma, 0 * last),
        "first-step-left-out": np.vstack([reward[:1], right[1:]]),
        "first-step-left-out 2": np.vstack([0 * reward[:1], right[1:]]),
        "last-by-the-horizon": powers(reward, gamma, 0 * last) + gamma**T * last,
        "last-forgotten": powers(reward, gamma, 0 * last),
        "last-not-discounted": powers(reward + tail, gamma, 0 * last),
        "discount-by-time": by_time,
        "own-reward-discounted": gamma * powers(reward, gamma, last / max(gamma, 1e-9)),
        "whole": np.broadcast_to(right[0], right.shape).copy(),
        "last-as-reward": powers(np.vstack([reward[:-1], last]), gamma, 0 * last),
    }


@row.right  # As sums with powers of gamma.
def _(reward, gamma, last):
    return powers(reward, gamma, last)


@row.right  # By a matrix of powers.
def _(reward, gamma, last):
    T = len(reward)
    k = np.arange(T)[None, :] - np.arange(T)[:, None]
    M = np.where(k >= 0, float(gamma) ** np.maximum(k, 0), 0)
    return M @ reward + np.outer(float(gamma) ** np.arange(T, 0, -1), last)


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        yield size * rng.numbers(-1, 1, 60, 2), 0.98, size * rng.numbers(-1, 1, 2)


row.at_least_0(gamma="a discount factor")
