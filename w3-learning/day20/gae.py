"""20.3 `gae(reward, value, next_value, terminated, ended, gamma, lam)`."""

import numpy as np

from labkit.judge import Matrix, Row

row = Row(Matrix((None, None)))


def ends(T, n, true=(), cut=()):
    """Return both flags, (T, n): true ends, and ends that are cut off, at (t, n)."""
    terminated, ended = np.zeros((2, T, n), dtype=bool)
    for at in true:
        terminated[at] = ended[at] = True
    for at in cut:
        ended[at] = True
    return terminated, ended


def episodes(rng, T, n, gamma, lam, **how):
    """Return the arguments of some episodes."""
    terminated, ended = ends(T, n, **how)
    reward, value, after = rng.numbers(-1, 2, 3, T, n)
    after[:-1] = np.where(ended[:-1], after[:-1], value[1:])
    return reward, value, after, terminated, ended, gamma, lam


@row.inputs
def _(rng):
    ones = np.ones((2, 1))
    values = 0.5 * ones, np.array([[0.5], [2]])
    yield ones, *values, *ends(2, 1, cut=[(1, 0)]), 0.5, 0.5
    yield ones, *values, *ends(2, 1, true=[(1, 0)]), 0.5, 0.5
    yield episodes(rng, 5, 2, 0.9, 0.8, true=[(1, 0), (4, 1)], cut=[(4, 0), (2, 1)])
    last = [(3, 0), (3, 1)]
    yield episodes(rng, 4, 3, 0.8, 0.5, true=[(1, 0), (3, 2)], cut=[(1, 2), *last])
    yield episodes(rng, 1, 2, 0.7, 0.6, true=[(0, 1)], cut=[(0, 0)])
    yield episodes(rng, 4, 2, 0.6, 0.9, cut=last)
    yield episodes(rng, 4, 2, 1.0, 0.7, true=[(2, 0)], cut=[(1, 1), *last])
    yield episodes(rng, 4, 2, 0.9, 1.0, true=[(1, 1), *last], cut=[(2, 0)])
    yield episodes(rng, 4, 2, 0.9, 0.0, true=[(1, 1)], cut=[(2, 0), *last])


row.cases(
    episodes_that_terminate=lambda r, v, w, terminated, ended, g, lam: bool(
        ended.any() and not (ended & ~terminated).any()
    ),
    episodes_that_are_cut_off=lambda r, v, w, terminated, ended, g, lam: bool(
        ended.any() and not terminated.any()
    ),
)
row.cases({
    "columns of one episode": lambda r, v, w, terminated, ended, g, lam: (
        not ended[:-1].any()
    ),
    "columns of several episodes": lambda r, v, w, terminated, ended, g, lam: bool(
        ended[:-1].any()
    ),
})  # fmt: skip
row.cases(
    a_lambda_of_1=lambda r, v, w, terminated, ended, g, lam: lam == 1,
    a_lambda_below_1=lambda r, v, w, terminated, ended, g, lam: lam < 1,
)


@row.rare
def _(rng):
    last = [(3, 0), (3, 1)]
    yield episodes(rng, 4, 2, 0.8, 0.7, true=[(1, 0), (2, 1), *last])
    yield episodes(rng, 4, 2, 0.8, 0.7, cut=[(1, 0), (2, 1), *last])
    yield episodes(rng, 4, 2, 0.8, 0.7, cut=last)
    yield episodes(rng, 4, 2, 0.8, 0.7, true=last)
    yield episodes(rng, 4, 2, 0.8, 1.0, true=[(1, 0), *last], cut=[(2, 1)])


def backwards(delta, factor):
    """Return the sums delta[t] + factor[t] times the next one."""
    out, after = np.zeros(delta.shape), np.zeros(delta.shape[1])
    for t in reversed(range(len(delta))):
        after = delta[t] + factor[t] * after
        out[t] = after
    return out


@row.wrongs
def _(reward, value, next_value, terminated, ended, gamma, lam):
    """cut-off-is-terminated: your code replaces `next_value` by 0 at the end of each
      episode. Keep `next_value` where an episode was cut off, because the episode would
      have continued
    runs-through-ends: your code continues the sum into the row after an end, which
      belongs to another episode. Omit the advantage of the next row where `ended` is
      True
    runs-through-cut-offs: your code stops the sum only where `terminated` is True. Stop
      the sum wherever `ended` is True, because the row after a cut-off also belongs to
      another episode
    end-one-late: your code uses the flag `ended` of the next row. Omit the advantage of
      row t + 1 where `ended` is True in row t
    never-terminated: your code uses `next_value` even where `terminated` is True. Use 0
      instead, because the value of a terminal state is 0
    next-rows-value: your code uses the value of the next row instead of `next_value`.
      Use `next_value`, because the row after an end belongs to another episode
    lambda-forgotten: your code omits lam, so the result is the advantage for lam = 1.
      Multiply the advantage of the next row by gamma * lam
    gamma-not-in-the-sum: your code multiplies the advantage of the next row by lam
      only. Multiply this advantage by gamma * lam instead
    stopped-for-all: your code stops the sums of all columns when an episode ends in one
      column. Apply the flag of each column only to that column
    error-left-out: your code sets the temporal-difference error to 0 in the last step
      of an episode. Keep this error, because the last step also has a reward and a
      value
    reward-at-the-end: your code uses the reward as the temporal-difference error of a
      step that terminates. Subtract the value of the state before this step from the
      reward
    weights-below-1: your code weights the n-step returns with (1 - lam) * lam^k up to
      the end of the episode. These weights do not sum to 1, so give the remaining
      weight to the last n-step return
    reversed: your code returns the rows from the last step to the first. The first row
      of the result should belong to the first step
    normalised: your code normalises the advantages. Omit this normalisation, because an
      advantage plus its value is the target of the value function
    value-one-early: your code subtracts the value of the previous row. Subtract the
      value in the same row instead, because that value belongs to the state before this
      step
    one-step-only: your code omits the temporal-difference errors of the later steps.
      Add gamma * lam times the advantage of the next row
    targets-returned: your function returns the advantage plus the value, which is the
      target of the value function. Return the advantage alone
    """
    worth = np.where(terminated, 0, next_value)
    delta = reward + gamma * worth - value
    on = gamma * lam * ~ended
    late = np.vstack([ended[1:], np.zeros((1, ended.shape[1]), bool)])
    rows = np.where(terminated, 0, np.vstack([value[1:], next_value[-1:]]))
    right = backwards(delta, on)
    always = gamma * lam * np.ones(delta.shape)

    def with_worth(some):
        return backwards(reward + gamma * some - value, on)

    def with_error(some):
        return backwards(some, on)

    any_end = np.broadcast_to(ended.any(axis=1, keepdims=True), ended.shape)
    # The last n-step return, and its weight lam^(n - 1).
    full = backwards(delta, gamma * ~ended) + value
    left = backwards(1.0 * ended, lam * ~ended)
    return {
        "stopped-for-all": backwards(delta, gamma * lam * ~any_end),
        "error-left-out": with_error(delta * ~ended),
        "reward-at-the-end": with_error(np.where(terminated, reward, delta)),
        "weights-below-1": right - lam * left * full,
        "reversed": right[::-1],
        "normalised": (right - right.mean()) / max(right.std(), 1e-8),
        "value-one-early": with_error(
            delta + value - np.vstack([value[:1], value[:-1]])
        ),
        "one-step-only": delta,
        "cut-off-is-terminated": with_worth(np.where(ended, 0, next_value)),
        "runs-through-ends": backwards(delta, always),
        "runs-through-cut-offs": backwards(delta, gamma * lam * ~terminated),
        "end-one-late": backwards(delta, gamma * lam * ~late),
        "never-terminated": with_worth(next_value),
        "next-rows-value": with_worth(rows),
        "lambda-forgotten": backwards(delta, gamma * ~ended),
        "gamma-not-in-the-sum": backwards(delta, lam * ~ended),
        "targets-returned": right + value,
    }


@row.right  # As a double sum that stops at ends.
def _(reward, value, next_value, terminated, ended, gamma, lam):
    T, n = reward.shape
    out = np.zeros((T, n))
    for t in range(T):
        for i in range(n):
            for k in range(t, T):
                worth = 0.0 if terminated[k, i] else next_value[k, i]
                delta = reward[k, i] + gamma * worth - value[k, i]
                out[t, i] += (gamma * lam) ** (k - t) * delta
                if ended[k, i]:
                    break
    return out


@row.right  # By the lambda-return, minus the value.
def _(reward, value, next_value, terminated, ended, gamma, lam):
    worth = next_value * (1 - terminated)
    out = np.zeros(reward.shape)
    after = np.zeros(reward.shape[1])
    for t in range(len(reward) - 1, -1, -1):
        after = np.where(ended[t], worth[t], (1 - lam) * worth[t] + lam * after)
        after = reward[t] + gamma * after
        out[t] = after
    return out - value


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        end = {"true": [(59, 0)], "cut": [(59, 1), (30, 0)]}
        reward, value, after, *rest = episodes(rng, 60, 2, 0.98, 0.95, **end)
        yield size * reward, size * value, size * after, *rest


row.at_least_0(
    terminated="True or False", ended="True or False", gamma="a factor", lam="a factor"
)
