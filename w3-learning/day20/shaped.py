"""20.9 `shaped(reward, potential, gamma)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row(Matrix((None, None)))


@row.inputs
def _(rng):
    yield np.ones((2, 1)), np.array([[0.0], [2], [4]]), 0.5
    for T, n, gamma in ((1, 2, 0.8), (3, 1, 1.0), (4, 3, 0.9), (2, 2, 0.0)):
        yield rng.numbers(-1, 2, T, n), rng.numbers(-2, 2, T + 1, n), gamma


row.cases(
    a_gamma_of_1=lambda reward, potential, gamma: gamma == 1,
    a_gamma_below_1=lambda reward, potential, gamma: gamma < 1,
)


@row.wrongs
def _(reward, potential, gamma):
    """gamma-forgotten: your code adds the difference of the potentials without gamma.
      Multiply the potential after the step by gamma, so that the discounted return
      depends only on the first and the last potential
    sign: your code subtracts the shaping term. Add this term instead, so that moving to
      a higher potential increases the reward
    gamma-on-the-wrong-one: your code multiplies the potential before the step by gamma.
      Multiply the potential after the step by gamma instead, because this potential is
      one step later
    potential-only: your code adds only the potential after the step. Subtract the
      potential before the step as well, so that intermediate potentials cancel in the
      discounted return
    discounted-twice: your code multiplies the added reward by gamma^t. Omit this
      factor, because the return already discounts each reward
    gamma-on-both: your code multiplies both potentials by gamma. Multiply only the
      potential after the step by gamma, because only this potential is one step later
    """
    before, after = potential[:-1], potential[1:]
    powers = gamma ** np.arange(len(reward))[:, None]
    return {
        "gamma-forgotten": reward + after - before,
        "sign": reward - gamma * after + before,
        "gamma-on-the-wrong-one": reward + after - gamma * before,
        "potential-only": reward + gamma * after,
        "discounted-twice": reward + powers * (gamma * after - before),
        "gamma-on-both": reward + gamma * (after - before),
    }


@row.right  # Step by step.
def _(reward, potential, gamma):
    out = reward.copy()
    for t in range(len(reward)):
        out[t] = out[t] - potential[t] + gamma * potential[t + 1]
    return out


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        yield size * rng.numbers(-1, 1, 9, 2), size * rng.numbers(-1, 1, 10, 2), 0.98


row.at_least_0(gamma="a discount factor")
