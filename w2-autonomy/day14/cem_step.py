"""14.7 `cem_step(mean, std, noise, scores, elite)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.policy import cem_step

row = Row((Vector((None,), called="the mean"), Vector((None,), called="the std")))


@row.inputs
def _(rng):
    noise = np.array([[0.0, 0], [1, 1], [-1, 2], [3, 3]])
    one, two = np.array([1.0, 0]), np.array([2.0, 1])
    yield one, two, noise, np.array([1, 5, 5, np.nan]), 2
    for n, d, elite, kind in (
        (6, 2, 2, "finite"),
        (8, 3, 3, "finite"),
        (8, 3, 1, "finite"),
        (8, 2, 3, "nan"),
        (10, 3, 4, "nan"),
        (9, 2, 2, "equal"),
        (9, 3, 3, "equal"),
        (12, 6, 3, "all"),
        (12, 4, 4, "all"),
    ):
        scores = rng.numbers(-1, 1, n)
        if kind in ("nan", "all"):
            scores[rng.choice(n, 2, replace=False)] = np.nan
        if kind in ("equal", "all"):
            best = rng.choice(np.flatnonzero(np.isfinite(scores)), elite + 2, False)
            scores[best] = 1.0
        yield (
            rng.numbers(-1, 1, d),
            rng.numbers(0.2, 2, d),
            rng.numbers(-2, 2, n, d),
            scores,
            elite,
        )


@row.spans
def _(rng):
    mean, std, noise = (
        rng.numbers(-1, 1, 3),
        rng.numbers(0.2, 2, 3),
        rng.numbers(-2, 2, 5, 3),
    )
    yield mean, std, noise, np.array([1.0, np.inf, 2.0, np.nan, -np.inf]), 2
    yield mean, std, noise, np.array([np.nan, -np.inf, 2.0, np.nan, 1.0]), 3
    yield mean, 1e-6 * std, noise, 1e-9 * np.arange(5), 2


def of_best(samples, best):
    """Return mean and standard deviation of some samples."""
    return samples[best].mean(axis=0), samples[best].std(axis=0)


@row.wrongs(hidden={"nan-is-zero": "no NaN of the lab has a score below 0 beside it"})
def _(mean, std, noise, scores, elite):
    """nan-first: your code prefers samples whose score is NaN. NaN should be worse than
      all other scores
    nan-first 2: your code reverses the ascending order of the scores, so NaN comes
      first. Use `np.argsort(-scores, kind='stable')`, which puts NaN last and keeps the
      order of equal scores
    nan-first 3: your code prefers samples whose score is NaN, and it reverses the order
      of equal scores. Use `np.argsort(-scores, kind='stable')`, which puts NaN last and
      keeps the order of equal scores
    ties-last-first: among samples with equal scores, your code prefers the last ones.
      Prefer the first ones instead
    std-kept: your code returns `std` unchanged. Return the standard deviation of the
      elite
    n-minus-one: your code divides by `elite - 1` in the standard deviation. Divide by
      `elite` instead
    about-the-old-mean: your code takes the standard deviation about the old mean. Take
      the standard deviation about the mean of the elite instead
    one-spread-for-all: your code returns the same standard deviation for all
      parameters. Compute one for each parameter, with `axis=0`
    best-left-out: your code omits the best sample and begins the elite with the
      second-best one. Include the best sample
    nan-is-zero: your code treats NaN as a score of 0. Treat NaN as worse than all other
      scores
    elite-one-less: your code uses one elite sample too few. Use the best `elite`
      samples
    weighted: your code weights the elite samples by their rank. Give all elite samples
      the same weight
    weighted 2: your code weights the elite samples by their scores. Give all elite
      samples the same weight
    weighted 3: your code weights the elite samples by their scores in the mean. Give
      all elite samples the same weight
    median: your code returns the median of the elite. Return the mean of the elite
      instead
    halves-swapped: your code swaps the mean and the standard deviation. Return the mean
      first
    """
    samples = mean + std * noise
    n = len(scores)
    order = np.argsort(-scores, kind="stable")
    best = order[:elite]
    right = cem_step(mean, std, noise, scores, elite)
    filled = np.where(np.isnan(scores), -np.inf, scores)
    nan_first = np.argsort(scores, kind="stable")[::-1][:elite]
    nan_best = np.argsort(np.where(np.isnan(scores), -np.inf, -scores), kind="stable")
    lasts = np.lexsort((-np.arange(n), -filled))[:elite]
    rank = np.arange(elite, 0, -1.0)[:, None]
    by_score = filled[best][:, None]

    def weighed(w):
        middle = (w * samples[best]).sum(axis=0) / w.sum()
        away = (w * (samples[best] - middle) ** 2).sum(axis=0) / w.sum()
        return middle, np.sqrt(np.abs(away))

    about = np.sqrt(np.mean((samples[best] - mean) ** 2, axis=0))
    return {
        "nan-first": of_best(samples, nan_best[:elite]),
        "nan-first 2": of_best(samples, np.argsort(scores)[::-1][:elite]),
        "ties-last-first": of_best(samples, lasts),
        "nan-first 3": of_best(samples, nan_first),
        "std-kept": (right[0], std),
        "n-minus-one": lambda: (
            right[0],
            samples[best].std(axis=0, ddof=1)
            if elite > 1
            else np.full(len(mean), np.nan),
        ),
        "about-the-old-mean": (right[0], about),
        "one-spread-for-all": (right[0], np.full(len(mean), samples[best].std())),
        "best-left-out": of_best(samples, order[1 : elite + 1]),
        "nan-is-zero": of_best(
            samples, np.argsort(-np.nan_to_num(scores), kind="stable")[:elite]
        ),
        "elite-one-less": lambda: of_best(samples, order[: max(elite - 1, 1)]),
        "weighted": weighed(rank),
        "weighted 2": lambda: weighed(by_score),
        "weighted 3": lambda: (weighed(np.nan_to_num(by_score) + 1e-9)[0], right[1]),
        "median": (np.median(samples[best], axis=0), right[1]),
        "halves-swapped": right[::-1],
    }


row.at_least_0(std="a standard deviation", elite="a number of samples")


@row.right  # Best first by a list sort, which keeps the order of equals.
def _(mean, std, noise, scores, elite):
    order = sorted(range(len(scores)), key=lambda i: (np.isnan(scores[i]), -scores[i]))
    kept = np.array([mean + std * noise[i] for i in order[:elite]])
    middle = kept.sum(axis=0) / elite
    return middle, np.sqrt(((kept - middle) ** 2).sum(axis=0) / elite)


@row.right  # A NaN made the smallest number.
def _(mean, std, noise, scores, elite):
    worth = np.nan_to_num(scores, nan=-np.inf)
    best = np.argsort(-worth, kind="stable")[:elite]
    return mean + std * noise[best].mean(axis=0), std * noise[best].std(axis=0)


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # An infinite score counts as NaN.
def _(mean, std, noise, scores, elite):
    samples = mean + std * noise
    score = np.where(np.isfinite(scores), scores, np.nan)
    return of_best(samples, np.argsort(-score, kind="stable")[:elite])


row.spans(  # as small, or as large, as in the lab
    mean=(lambda mean: 0.1 * mean,),
)
