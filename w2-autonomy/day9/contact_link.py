"""9.10 `contact_link(residual, threshold)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Count, Row

# A residual as large as its threshold may count or not.
row = Row(
    Count(),
    at_edge=lambda residual, threshold: bool((np.abs(residual) != threshold).all()),
)


@row.inputs
def _(rng):
    half = np.full(7, 0.5)
    case = (4.0 * np.eye(7)[3], half)
    drawn = []
    for last in (0, 1, 2, 3, 4, 5, 6, 7):
        threshold = rng.numbers(0.4, 3, 7)
        share = rng.numbers(-0.9, 0.9, 7)
        if last:
            share[last - 1] = [-1.6, 2.4][last % 2]
        if last > 2:
            share[last - 3] = -4.0
        drawn.append((threshold * share, threshold))
    # Several joints over their thresholds, of either sign: here all mistakes part.
    for _ in range(8):
        threshold = rng.numbers(0.4, 3, 7)
        drawn.append((threshold * rng.numbers(-2, 2, 7), threshold))
    return [case, (np.zeros(7), half), *drawn]


@row.spans
def _(rng):  # at the threshold, which is not over it
    one = np.full(7, 0.5)
    for sign in (1.0, -1.0):
        yield sign * one, one
        yield sign * np.array([0, 0.6, 0, 0.5, 0, 0, 0]), one


@row.wrongs
def _(residual, threshold):
    """first-joint: it is the first joint that feels it; the one that was pushed is at
      least as far out as the last that does
    from-zero: it is counted from 0; joint1 is 1, for 0 means that nobody was felt
    from-zero 2: it is counted from 0, and -1 where none feels it; joint1 is 1, and 0
      means that nobody was felt
    sign-lost: only a residual above the threshold counts; a push may turn a joint
      backwards, too => without the size
    negative-only: only a residual below minus the threshold counts; a push may turn a
      joint either way
    largest: it is the joint that feels it most; a long lever is no later link
    how-many: it is how many joints feel it
    below: it is the last joint that is under its threshold
    one-threshold: every joint is compared with the first one's threshold
    any: it is only whether one feels it, 0 or 1
    all-or-none: it is 7 as soon as one joint feels it
    first-of-none: it is 1 where none feels it; that is 0
    last-of-none: it is 7 where none feels it; that is 0
    from-the-tip: it is counted from the tip
    most-over: it is the joint that is furthest over its threshold; asked for is the
      last one
    most-times-over: it is the joint with the largest share of its threshold; asked for
      is the last one
    until-one-does-not: it stops at the first joint that does not feel it; a joint
      further out may
    largest-threshold: every joint is compared with the largest threshold
    smallest-threshold: every joint is compared with the smallest threshold
    one-too-many: it is one more where one feels it; joint1 is 1
    first-joint-or-1: it is the first joint that feels it, and 1 where none does, as
      np.argmax gives it; asked for is the last, and 0
    first-from-zero: it is the first joint, counted from 0; asked for is the last one,
      and joint1 is 1
    largest-of-none: it is the joint that feels it most, whether it is over or not
    largest-signed: it is the joint with the largest residual, signs and thresholds
      left out
    last-joint-decides: it is 7 if joint 7 feels it, else 0: a loop overwrites what it
      found
    last-joint-left-out: joint 7 is left out: the loop ends one too early
    sign-lost-first-or-1: only a residual above the threshold counts, and it is the
      first such joint, or 1 where none is; a push may turn a joint backwards, and asked
      for is the last
    squared: the square of a residual is compared with its threshold
    numbers-added: the numbers of all joints that feel it are added up; asked for is the
      last one
    sum-over: the sum of all sizes decides, and not each joint's own
    sign-lost-from-zero: only a residual above the threshold counts, and joints are
      counted from 0; a push may turn a joint backwards, and joint1 is 1
    sign-lost-first: only a residual above the threshold counts, and the first such
      joint; a push may turn a joint backwards, and asked for is the last
    sign-lost-how-many: it is how many joints are above their threshold; a push may turn
      a joint backwards, and asked for is the last
    """
    size = np.abs(residual)
    over = size > threshold
    up = residual > threshold

    def last(mask, none=0):
        return int(np.flatnonzero(mask)[-1]) + 1 if mask.any() else none

    n = last(over)
    return {
        "first-joint": int(np.argmax(over)) + 1 if over.any() else 0,
        "from-zero": n - 1 if n else 0,
        "from-zero 2": n - 1,
        "sign-lost": last(residual > threshold),
        "negative-only": last(residual < -threshold),
        "largest": int(np.argmax(size)) + 1 if n else 0,
        "how-many": int(over.sum()),
        "below": last(~over),
        "one-threshold": last(size > threshold[0]),
        "any": int(over.any()),
        "all-or-none": 7 * int(over.any()),
        "first-of-none": n or 1,
        "last-of-none": n or 7,
        "from-the-tip": 8 - n if n else 0,
        "most-over": int(np.argmax(size - threshold)) + 1 if n else 0,
        "most-times-over": int(np.argmax(size / threshold)) + 1 if n else 0,
        "until-one-does-not": int(np.argmin(np.append(over, False))),
        "largest-threshold": last(size > threshold.max()),
        "smallest-threshold": last(size > threshold.min()),
        "one-too-many": n + 1 if n else 0,
        "first-joint-or-1": int(np.argmax(over)) + 1,
        "first-from-zero": int(np.argmax(over)),
        "largest-of-none": int(np.argmax(size)) + 1,
        "largest-signed": int(np.argmax(residual)) + 1,
        "last-joint-decides": 7 * int(over[-1]),
        "last-joint-left-out": last(over[:-1]),
        "sign-lost-first-or-1": int(np.argmax(up)) + 1,
        "squared": last(residual**2 > threshold),
        "numbers-added": int(np.sum(np.flatnonzero(over) + 1)),
        "sum-over": last(size.sum() > threshold),
        "sign-lost-from-zero": max(last(residual > threshold) - 1, 0),
        "sign-lost-first": int(np.argmax(up)) + 1 if up.any() else 0,
        "sign-lost-how-many": int(up.sum()),
    }


@row.right  # A loop from the tip.
def _(residual, threshold):
    for joint in range(7, 0, -1):
        if not -threshold[joint - 1] <= residual[joint - 1] <= threshold[joint - 1]:
            return joint
    return 0


row.at_least_0(threshold="a limit", answer="a place")
row.same("first residual = np.abs(residual)", "it takes the size anyway")


@row.wrong("not-at-every-size", hidden="the numbers of the lab stay within its limits")
def _(residual, threshold):
    felt = np.flatnonzero(np.abs(residual) >= threshold)
    return int(felt[-1]) + 1 if len(felt) else 0


row.spans(  # as small, or as large, as in the lab
    residual=(lambda residual: 0.0001 * residual,),
)
