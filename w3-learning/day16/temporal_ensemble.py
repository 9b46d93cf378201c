"""16.8 `temporal_ensemble(plans, decay)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,)))


@row.inputs
def _(rng):
    yield np.array([[[0.0], [1], [2]], [[3], [4], [5]]]), float(np.log(2))
    for k, K, m, decay in (
        (1, 3, 2, 0.5),  # one plan
        (2, 2, 1, 0.3),
        (3, 5, 2, 0.7),
        (3, 3, 1, 0.0),
        (4, 6, 2, -0.4),
        (2, 5, 3, 1.2),
    ):
        yield rng.numbers(-1, 1, k, K, m), decay
    k = int(rng.integers(2, 5))
    yield rng.numbers(-1, 1, k, k + 3, 2), float(rng.numbers(-1, 1))


row.cases(
    one_plan=lambda plans, decay: len(plans) == 1,
    several_plans=lambda plans, decay: len(plans) > 1,
)
row.cases(
    equal_weights=lambda plans, decay: decay == 0,
    weights_that_differ=lambda plans, decay: decay != 0,
)
row.cases(
    as_many_plans_as_entries=lambda plans, decay: len(plans) == plans.shape[1],
    fewer_plans_than_entries=lambda plans, decay: len(plans) < plans.shape[1],
)


@row.wrongs
def _(plans, decay):
    """newest-first: your code assigns the weight exp(0) to the newest plan. Assign this
      weight to the oldest plan (plan 0) instead
    first-entries: your code averages the first entries of all plans. The first entry of
      an older plan was for an earlier step, so use the entry for the current step of
      each plan instead
    same-entry: your code uses entry i of plan i, as if plan 0 were the newest. Use
      entry `k - 1 - i` instead, because plan i was made `k - 1 - i` steps ago
    last-entries: your code averages the last entries of all plans. Use entry `k - 1 -
      i` of plan i instead, which is the entry for the current step
    counted-from-the-end: your code uses entry `K - 1 - i` of plan i. Use entry `k - 1 -
      i` instead, because plan i was made `k - 1 - i` steps ago
    one-entry-late: your code uses entry `k - i` of plan i. Use entry `k - 1 - i`
      instead, because plan i was made `k - 1 - i` steps ago
    moving-average: your code computes an exponential moving average of the actions. The
      weight of plan i should be exp(-decay * i), divided by the sum of these
      exponentials over all plans
    moving-average 2: your code computes an exponential moving average of the actions.
      The weight of plan i should be exp(-decay * i), divided by the sum of these
      exponentials over all plans
    all-entries: your code averages all entries of each plan. Use only the entry for the
      current step, which is entry `k - 1 - i` of plan i
    divided-by-k: your code divides the weighted sum by the number of plans. Divide this
      sum by the sum of the weights instead
    equal-weights: your code gives all plans the same weight. Make the weight of plan i
      proportional to exp(-decay * i)
    newest-only: your function returns the action of the newest plan. Return the
      weighted mean of the actions of all plans for the current step instead
    oldest-only: your function returns the action of the oldest plan. Return the
      weighted mean of the actions of all plans for the current step instead
    median: your function returns the median of the plans' actions for the current step.
      Return the weighted mean of these actions instead
    powers-of-the-decay: your code uses `decay**i` as the weight of plan i. Use
      `exp(-decay * i)` instead
    """
    k, K, _ = plans.shape
    i = np.arange(k)
    weight = np.exp(-decay * i)
    now = plans[i, k - 1 - i]

    def mean(weight, of):
        return weight @ of / weight.sum()

    def running(new):
        mean = now[0]
        for action in now[1:]:
            mean = (1 - new) * mean + new * action
        return mean

    return {
        "newest-first": mean(weight[::-1], now),
        "first-entries": mean(weight, plans[:, 0]),
        "same-entry": mean(weight, plans[i, i]),
        "last-entries": mean(weight, plans[:, -1]),
        "counted-from-the-end": mean(weight, plans[i, K - 1 - i]),
        "one-entry-late": mean(weight, plans[i, np.minimum(k - i, K - 1)]),
        "moving-average": running(np.exp(-decay)),
        "moving-average 2": running(1 - np.exp(-decay)),
        "all-entries": mean(weight, plans.mean(axis=1)),
        "divided-by-k": weight @ now / k,
        "equal-weights": now.mean(axis=0),
        "newest-only": now[-1],
        "oldest-only": now[0],
        "median": np.median(now, axis=0),
        "powers-of-the-decay": lambda: mean(decay**i, now),
    }


@row.right  # Plan by plan, from the newest to the oldest.
def _(plans, decay):
    total, weights = 0.0, 0.0
    for age in range(len(plans)):
        weight = np.exp(decay * age)
        total = total + weight * plans[len(plans) - 1 - age, age]
        weights += weight
    return total / weights


@row.right  # The weights as a running product, the entries as a diagonal.
def _(plans, decay):
    k = len(plans)
    now = np.diagonal(plans[:, :k][:, ::-1], axis1=0, axis2=1)
    weights = np.cumprod(np.append(1.0, np.full(k - 1, np.exp(-decay))))
    return now @ (weights / weights.sum())


@row.right  # NumPy's weighted mean.
def _(plans, decay):
    now = [plan[-1 - i] for i, plan in enumerate(plans[:, : len(plans)])]
    return np.average(now, axis=0, weights=np.exp(-decay * np.arange(len(plans))))


@row.spans
def _(rng):
    plans = rng.numbers(-1, 1, 8, 8, 3)
    for size, decay in ((1e-3, 0.01), (1e3, -1.0), (1.0, 3.0)):
        yield size * plans, decay
    yield rng.numbers(-1, 1, 2, 12, 2), 0.3
