"""20.4 `policy_gradient(score, advantage)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,)))


@row.inputs
def _(rng):
    yield np.array([[[1.0]], [[2.0]]]), np.array([[3.0], [1.0]])
    for T, n, d in ((1, 3, 2), (3, 1, 2), (2, 4, 3), (4, 2, 1), (3, 2, 4)):
        yield rng.numbers(-1, 1, T, n, d), rng.numbers(-1, 2, T, n)


row.cases(
    episodes_of_one_step=lambda score, advantage: len(score) == 1,
    episodes_of_several_steps=lambda score, advantage: len(score) > 1,
)
row.cases(
    a_single_episode=lambda score, advantage: advantage.shape[1] == 1,
    several_episodes=lambda score, advantage: advantage.shape[1] > 1,
)


@row.wrongs
def _(score, advantage):
    """mean-over-steps: your code also divides the estimate by the number of steps. Omit
      this division, because the gradient of the return is a sum over the steps
    summed-over-episodes: your code sums over the episodes. Divide the sum by the number
      of episodes, because the estimate is a mean over the episodes
    sums-multiplied: your code multiplies the sum of the scores by the sum of the
      advantages. Multiply each score by the advantage of its own step, and then sum the
      products
    first-advantage: your code uses the advantage of the first step for all steps.
      Multiply each score by the advantage of its own step instead
    sign: your estimate has the wrong sign. A step in the direction of the estimate
      should increase the return, so negate the estimate
    divided-by-steps: your code divides the sum by the number of steps. Divide the sum
      by the number of episodes instead
    means-multiplied: your code averages the scores and the advantages over the episodes
      before the multiplication. Multiply each score by its own advantage first, and
      then take the mean
    summed-to-go: your code adds the later advantages to the advantage of each step.
      Omit this addition, because an advantage already contains the later rewards
    pairs-mixed: your code pairs the scores with the advantages of other steps or
      episodes. Both arrays have the steps on the first axis and the episodes on the
      second axis
    normalised-inside: your code normalises the advantages. Omit this normalisation,
      because the caller chooses the baseline and the scale
    baseline-inside 2: your code subtracts the mean over the episodes from the
      advantages of each step. Omit this subtraction, because the caller chooses the
      baseline
    baseline-inside: your code subtracts the mean of the advantages. Omit this
      subtraction, because the caller chooses the baseline
    """
    T, n, d = score.shape
    right = np.einsum("tnd,tn->d", score, advantage) / n
    sums = score.sum(axis=0) * advantage.sum(axis=0)[:, None]
    centred = advantage - advantage.mean()

    def summed(some):
        return np.einsum("tnd,tn->d", score, some) / n

    return {
        "divided-by-steps": right * n / T,
        "means-multiplied": advantage.mean(axis=1) @ score.mean(axis=1),
        "summed-to-go": summed(np.cumsum(advantage[::-1], axis=0)[::-1]),
        "pairs-mixed": advantage.T.ravel() @ score.reshape(-1, d) / n,
        "normalised-inside": summed(centred / max(advantage.std(), 1e-8)),
        "mean-over-steps": right / T,
        "summed-over-episodes": right * n,
        "sums-multiplied": sums.mean(axis=0),
        "first-advantage": (score.sum(axis=0) * advantage[0][:, None]).mean(axis=0),
        "sign": -right,
        "baseline-inside 2": summed(advantage - advantage.mean(axis=1, keepdims=True)),
        "baseline-inside": summed(centred),
    }


@row.right  # Episode by episode.
def _(score, advantage):
    T, n, d = score.shape
    total = np.zeros(d)
    for i in range(n):
        total = total + sum(advantage[t, i] * score[t, i] for t in range(T))
    return total / n


@row.right  # As one matrix product.
def _(score, advantage):
    return advantage.ravel() @ score.reshape(-1, score.shape[2]) / score.shape[1]


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        yield size * rng.numbers(-1, 1, 30, 9, 2), rng.numbers(-300, 2, 30, 9)
