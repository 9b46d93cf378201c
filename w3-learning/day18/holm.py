"""18.8 `holm(p)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Mask, Row

row = Row(Mask((None,)))


@row.inputs
def _(rng):
    yield (np.array([0.01, 0.04, 0.03]),)
    yield (np.array([0.05]),)
    yield (np.array([0.03, 0.001, 0.02, 0.04]),)
    yield (np.array([0.026, 0.024]),)
    yield (np.array([0.2, 0.01, 0.6]),)
    yield (np.array([0.04, 0.045, 0.03, 0.012]),)  # the first fails, later ones do not
    yield (np.array([0.01, 0.02, 0.04]),)
    yield (np.array([0.009, 0.001, 0.3, 0.012, 0.02]),)
    yield (np.array([0.0169, 0.5, 0.6]),)  # above 0.05 / 3
    for n in (2, 3, 3, 4, 4, 5, 6, 6, 8):
        yield (rng.numbers(0.001, 0.2, n) ** 1.5,)


@row.spans
def _(rng):
    yield (np.array([1e-9, 1.0, 1e-30]),)


@row.wrongs(
    hidden={
        "sidak": "the lab's p-values are not near these limits",
        "not-equal": "no p-value of the lab is equal to its limit",
    }
)
def _(p):
    """uncorrected: your code compares each of the m p-values with 0.05. The probability
      of a false positive grows with m, so use the limits 0.05 / m, 0.05 / (m - 1), and
      so on
    bonferroni: your code compares each p-value with Bonferroni's limit 0.05 / m. Use
      this limit only for the smallest p-value. Use 0.05 / (m - 1) for the next p-value,
      and so on
    no-stop: your code continues after a p-value that is larger than its limit. Stop at
      this p-value, because no larger p-value is significant either
    hochberg: your code starts with the largest p-value (Hochberg's method). Start with
      the smallest p-value, and stop at the first p-value that is larger than its limit
    sorted: your code returns the mask in the order of the sorted p-values. Entry i of
      the result should refer to p-value i of the argument, so undo the sorting
    benjamini-hochberg: your code uses the method of Benjamini and Hochberg, whose
      limits are 0.05 / m, 0.10 / m, and so on. Use Holm's limits instead (0.05 / m,
      0.05 / (m - 1), and so on)
    not-equal: your code requires each p-value to be smaller than its limit. Accept
      equality too, because a p-value that is equal to its limit is significant
    one-later: your code starts with the limit 0.05 / (m - 1). Compare the smallest
      p-value with 0.05 / m, the next p-value with 0.05 / (m - 1), and so on
    unsorted: your code compares the p-values in the order of the argument. Sort the
      p-values first, and start with the smallest
    first-larger: your code also marks the first p-value that is larger than its limit
      as significant. Stop before this p-value, because a p-value above its limit is not
      significant
    wrong-positions: your code undoes the sorting in the wrong direction. Write entry i
      of the sorted mask to position `order[i]` of the result, where `order` is
      `np.argsort(p)`
    wrong-positions 2: your code undoes the sorting in the wrong direction. Write entry
      i of the sorted mask to position `order[i]` of the result, where `order` is
      `np.argsort(p)`
    limits-reversed: your code uses the limits in reverse order, so it compares the
      smallest p-value with 0.05. Compare the smallest p-value with 0.05 / m, and the
      largest with 0.05
    sidak: your code uses Sidak's limits, which begin with 1 - 0.95^(1 / m) and require
      independent tests. Use Holm's limits instead (0.05 / m, 0.05 / (m - 1), and so on)
    indices: your function returns the indices of the significant differences. Return a
      Boolean mask with one entry for each p-value instead
    negated: your mask is True for the differences that are not significant. Return True
      for the significant differences instead
    """
    m = len(p)
    order = np.argsort(p, kind="stable")
    limits = 0.05 / np.arange(m, 0, -1)
    passes = p[order] <= limits
    stop = np.logical_and.accumulate(passes)
    last = np.max(np.flatnonzero(passes), initial=-1)
    slow = np.max(
        np.flatnonzero(p[order] <= 0.05 * np.arange(1, m + 1) / m), initial=-1
    )

    def back(some):
        found = np.zeros(m, dtype=bool)
        found[order] = some
        return found

    def falls(limits):
        return np.logical_and.accumulate(p[order] <= limits)

    right = back(stop)
    return {
        "uncorrected": p <= 0.05,
        "bonferroni": p <= 0.05 / m,
        "no-stop": back(passes),
        "hochberg": back(np.arange(m) <= last),
        "sorted": stop,
        "benjamini-hochberg": back(np.arange(m) <= slow),
        "not-equal": back(np.logical_and.accumulate(p[order] < limits)),
        "one-later": back(falls(np.append(limits[1:], 0.05))),
        "unsorted": np.logical_and.accumulate(p <= limits),
        "first-larger": back(np.append(True, stop[:-1])),
        "wrong-positions": stop[order],
        "wrong-positions 2": stop[np.argsort(p)],  # equal p-values in another order
        "limits-reversed": back(falls(0.05 / np.arange(1, m + 1))),
        "sidak": back(falls(1 - 0.95 ** (1 / np.arange(m, 0, -1)))),
        "indices": np.flatnonzero(right),
        "negated": ~right,
    }


@row.right  # By adjusted p-values.
def _(p):
    order = np.argsort(p)
    adjusted = np.maximum.accumulate(p[order] * np.arange(len(p), 0, -1))
    found = np.empty(len(p), dtype=bool)
    found[order] = adjusted <= 0.05
    return found


@row.right  # A loop that stops.
def _(p):
    found = np.zeros(len(p), dtype=bool)
    left = len(p)  # comparisons that are left
    for i in np.argsort(p):
        if p[i] > 0.05 / left:
            break
        found[i] = True
        left -= 1
    return found


row.at_least_0(p="probabilities", answer="True or False")
row.same("return (found).astype(np.float32)", "True and False stay what they are")
