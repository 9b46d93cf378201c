"""9.10 `contact_link(residual, threshold)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Count, Row

# A residual that equals its threshold may be over it or not.
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
    # Several joints over their thresholds, of either sign: all mistakes differ.
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
    """first-joint: your function returns the first joint over its threshold. Return the
      last such joint instead, because a contact can also cause torques at the joints
      between the base and the touched link
    first-joint 2: your function returns the first joint over its threshold, or 1 if
      there is none. Return the last such joint instead, or 0 if there is none
    first-joint 3: your function returns the first joint over its threshold, counted
      from 0. Return the last such joint instead, counted from 1 => both
    from-zero: your code counts the joints from 0. Count the joints from 1 instead,
      because 0 means no contact
    from-zero 2: your code counts the joints from 0 and returns -1 if there is no
      contact. Count the joints from 1, and return 0 if there is no contact
    negative-only: your code detects only residuals below minus the threshold. Compare
      the absolute values with the thresholds, because a contact torque may have either
      sign
    sign-lost-first: your code compares only positive residuals with the thresholds and
      returns the first joint above its threshold. Compare the absolute values, and
      return the last such joint => both
    sign-lost-first 2: your code compares only positive residuals with the thresholds
      and returns the first joint above its threshold, or 1 if there is none. Compare
      the absolute values, and return the last such joint => both
    sign-lost-from-zero: your code compares only positive residuals with the thresholds
      and counts the joints from 0. Compare the absolute values, and count from 1 =>
      both
    largest: your function returns the joint with the largest absolute residual. Return
      the last joint over its threshold instead, because a joint far from the contact
      can have the largest torque
    largest 2: your function returns the joint with the largest absolute residual, even
      if this residual is below its threshold. Return the last joint over its threshold
      instead
    largest 3: your function returns the joint with the largest signed residual and
      ignores the thresholds. Return the last joint over its threshold instead
    most-over: your function returns the joint that exceeds its threshold by the largest
      amount. Return the last joint over its threshold instead
    most-over 2: your function returns the joint that exceeds its threshold by the
      largest factor. Return the last joint over its threshold instead
    how-many: your function counts the joints over their thresholds. Return the number
      of the last such joint instead
    how-many 2: your function counts the joints whose signed residual is above the
      threshold. Return the number of the last joint whose absolute residual is above
      its threshold
    any: your function returns 1 if any joint is over its threshold, and otherwise 0.
      Return the number of the last such joint instead
    all-or-none: your function returns 7 if any joint is over its threshold, and
      otherwise 0. Return the number of the last such joint instead
    last-of-none: your function returns 7 if no joint is over its threshold. Return 0
      instead
    from-the-tip: your code counts the joints from the tip. Count the joints from the
      base instead, where joint1 has the number 1
    until-one-does-not: your code ignores all joints after the first joint under its
      threshold. Test all joints, because a later joint may be over its threshold
    largest-threshold: your code compares every joint with the largest threshold.
      Compare each joint with its own threshold instead
    smallest-threshold: your code compares every joint with the smallest threshold.
      Compare each joint with its own threshold instead
    last-joint-decides: your function returns 7 if joint 7 is over its threshold, and
      otherwise 0. Return the number of the last joint over its threshold instead,
      whichever joint it is
    last-joint-left-out: your code omits joint 7. Test all seven joints, because a
      contact at the hand can be visible only there
    numbers-added: your function returns the sum of the numbers of all joints over their
      thresholds. Return only the number of the last such joint
    sum-over: your code compares the sum of all absolute residuals with the thresholds.
      Compare the absolute residual of each joint with its own threshold
    """
    size = np.abs(residual)
    over = size > threshold
    up = residual > threshold

    def last(mask):
        return int(np.flatnonzero(mask)[-1]) + 1 if mask.any() else 0

    def first(mask):
        return int(np.argmax(mask)) + 1

    n = last(over)
    return {
        "first-joint": first(over) if n else 0,
        "first-joint 2": first(over),
        "first-joint 3": first(over) - 1,
        "from-zero": n - 1 if n else 0,
        "from-zero 2": n - 1,
        "negative-only": last(residual < -threshold),
        "sign-lost-first": first(up) if up.any() else 0,
        "sign-lost-first 2": first(up),
        "sign-lost-from-zero": max(last(up) - 1, 0),
        "largest": first(size) if n else 0,
        "largest 2": first(size),
        "largest 3": first(residual),
        "most-over": first(size - threshold) if n else 0,
        "most-over 2": first(size / threshold) if n else 0,
        "how-many": int(over.sum()),
        "how-many 2": int(up.sum()),
        "any": int(over.any()),
        "all-or-none": 7 * int(over.any()),
        "last-of-none": n or 7,
        "from-the-tip": 8 - n if n else 0,
        "until-one-does-not": int(np.argmin(np.append(over, False))),
        "largest-threshold": last(size > threshold.max()),
        "smallest-threshold": last(size > threshold.min()),
        "last-joint-decides": 7 * int(over[-1]),
        "last-joint-left-out": last(over[:-1]),
        "numbers-added": int(np.sum(np.flatnonzero(over) + 1)),
        "sum-over": last(size.sum() > threshold),
    }


@row.right  # A loop from the tip.
def _(residual, threshold):
    for joint in range(7, 0, -1):
        if not -threshold[joint - 1] <= residual[joint - 1] <= threshold[joint - 1]:
            return joint
    return 0


row.at_least_0(threshold="a limit", answer="a count")
row.same(
    "first residual = np.abs(residual)", "the function takes the absolute value anyway"
)


@row.wrong("not-at-every-size", hidden="the numbers of the lab stay within its limits")
def _(residual, threshold):
    felt = np.flatnonzero(np.abs(residual) >= threshold)
    return int(felt[-1]) + 1 if len(felt) else 0


row.spans(  # as small, or as large, as in the lab
    residual=(lambda residual: 0.0001 * residual,),
)
