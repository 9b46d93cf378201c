"""7.2 `quintic_duration(delta_q, v_max, a_max)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row, Scalar
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.simulate import ACC_LIMITS, SPEED_LIMITS
from robo47.trajectory import PEAK_ACCELERATION, PEAK_SPEED

NO_LIMIT = 1e9  # rad/s2, in the docstring's case
NO_WAY = HeldOut(
    "no-way",
    "Your function is correct except when no joint moves. The duration should then be "
    "0 s.",
    lambda rng: [(np.zeros(7), SPEED_LIMITS, ACC_LIMITS)],
)


def never_less(case: Case) -> Finding | None:
    """Return that all short durations are the same, and all longer ones right."""
    off = ~np.isclose(case.S, case.T, rtol=0.0, atol=1e-8)
    least = float(case.S[off].min())
    if off.all() or np.ptp(case.S[off]) > 1e-12:
        return None
    if case.T[off].max() > min(least, case.T[~off].min()):
        return None
    says = (
        f"Your code returns {least:g} s for a short motion that needs less time. Does "
        "your code have a lower bound for the duration?"
    )
    return Finding("never-less", says)


row = Row(Scalar(unit="s"), unnamed=never_less, held_out=[NO_WAY])


@row.inputs
def _(rng):
    one = np.array([1.0, 0, 0, 0, 0, 0, 0])
    yield one, np.full(7, 1.875), np.full(7, NO_LIMIT)
    ways = rng.numbers(-2, 2, 3, 7)
    for way in (*ways, 0.1 * ways[0], 1e-5 * ways[0]):
        yield way, SPEED_LIMITS, ACC_LIMITS
    yield from zip(
        rng.numbers(-2, 2, 6, 7),
        rng.numbers(0.5, 3, 6, 7),
        rng.numbers(2, 20, 6, 7),
        strict=True,
    )


def seconds(delta_q, v_max, a_max, speed=PEAK_SPEED, acceleration=PEAK_ACCELERATION):
    """Return the duration of each joint for its velocity and for its acceleration."""
    delta_q = np.abs(delta_q)
    return np.array([speed * delta_q / v_max, np.sqrt(acceleration * delta_q / a_max)])


@row.wrongs
def _(delta_q, v_max, a_max):
    """least-of-all: your code returns the shortest duration among all joints and
      limits. Return the longest duration instead, because any shorter duration
      violates a limit
    added-up: your code returns the sum of the durations for all joints and limits.
      Return the longest duration instead, because this duration already satisfies all
      limits
    """
    each = seconds(delta_q, v_max, a_max)
    return {"least-of-all": each.min(), "added-up": each.sum()}


@row.wrongs
def _(delta_q, v_max, a_max):
    """peak-of-the-cubic: your result uses 1.5 as the maximum velocity of the scaling,
      as for the cubic. Use the maximum velocity of the quintic instead. This maximum
      occurs at half the duration
    peak-of-the-cubic 2: your result uses 6 as the maximum acceleration of the scaling,
      as for the cubic. Use the maximum acceleration of the quintic instead. This
      maximum occurs where the derivative of the acceleration is 0
    peak-of-the-cubic 3: your result uses 1.5 and 6 as the maximum velocity and
      acceleration of the scaling, as for the cubic. Use the two maxima of the quintic
      instead
    peak-at-a-quarter: your result uses 5.625 as the maximum acceleration of the
      scaling, which is the acceleration at a quarter of the duration. The maximum
      occurs where the derivative of the acceleration is 0
    """
    peaks = {
        "peak-of-the-cubic": {"speed": 1.5},
        "peak-of-the-cubic 2": {"acceleration": 6.0},
        "peak-of-the-cubic 3": {"speed": 1.5, "acceleration": 6.0},
        "peak-at-a-quarter": {"acceleration": 5.625},
    }
    return {
        slug: seconds(delta_q, v_max, a_max, **of).max() for slug, of in peaks.items()
    }


@row.wrongs
def _(delta_q, v_max, a_max):
    """limits-of-different-joints: your code combines the largest displacement with the
      lowest acceleration limit, even if they belong to different joints. Combine each
      displacement with the limit of the same joint
    both-added: your code adds the duration for the velocity limit to the duration for
      the acceleration limit. Use the longer of the two instead, because it already
      satisfies both limits
    both-added 2: your code adds the duration for the velocity limit to the duration for
      the acceleration limit. Use the longer of the two instead, because it already
      satisfies both limits
    shorter-of-two: your code returns the shorter of the durations for the velocity
      limits and the acceleration limits. Return the longer duration instead, because it
      satisfies both kinds of limit
    shorter-of-two 2: for each joint, your code uses the shorter of the durations for
      the velocity limit and the acceleration limit. Use the longer duration instead,
      because it satisfies both limits
    fastest-joint: your code returns the shortest duration of all joints, so joints that
      need more time violate their limits. Return the longest duration instead
    fastest-joint 2: for each kind of limit, your code uses the shortest duration of all
      joints. Use the longest duration instead, because every joint should stay within
      its limits
    one-length: your code uses the norm of delta_q and the lowest limits for all joints.
      Use each joint's own displacement and limits instead
    summed: your code adds up the durations of the joints. Return the longest duration
      instead, because the joints move at the same time
    mean: your code returns the mean of the joints' durations, so the slower joints
      violate their limits. Return the longest duration instead
    longest-way: your code uses only the joint with the largest displacement. Use the
      longest duration of all joints, because a joint with lower limits may need more
      time
    one-limit-for-all: your code uses the limits of the first joint for all joints. Use
      each joint's own limits instead
    one-limit-for-all 2: your code uses the lowest limits for all joints. Use each
      joint's own limits instead
    speed-only: your code uses only the velocity limits, so a short motion can exceed
      the acceleration limits. Use both kinds of limit
    acceleration-only: your code uses only the acceleration limits, so a long motion can
      exceed the velocity limits. Use both kinds of limit
    """
    each = seconds(delta_q, v_max, a_max)
    i = np.argmax(np.abs(delta_q))
    by_speed, by_acceleration = each
    longest = np.sqrt(PEAK_ACCELERATION * np.abs(delta_q[i]) / a_max.min())
    lowest = (v_max.min(), a_max.min())
    return {
        "limits-of-different-joints": max(by_speed.max(), longest),
        "both-added": each.sum(axis=0).max(),
        "both-added 2": each.max(axis=1).sum(),
        "shorter-of-two": min(each.max(axis=1)),
        "shorter-of-two 2": each.min(axis=0).max(),
        "fastest-joint": each.max(axis=0).min(),
        "fastest-joint 2": each.min(axis=1).max(),
        "one-length": seconds(np.linalg.norm(delta_q), *lowest).max(),
        "summed": each.max(axis=0).sum(),
        "mean": each.max(axis=0).mean(),
        "longest-way": each[:, i].max(),
        "one-limit-for-all": seconds(delta_q, v_max[0], a_max[0]).max(),
        "one-limit-for-all 2": seconds(delta_q, *lowest).max(),
        "speed-only": by_speed.max(),
        "acceleration-only": by_acceleration.max(),
    }


@row.right  # Joint by joint.
def _(delta_q, v_max, a_max):
    longest = 0.0
    for way, v, a in zip(np.abs(delta_q), v_max, a_max, strict=True):
        longest = max(longest, 15 * way / (8 * v), (10 * way / (a * 3**0.5)) ** 0.5)
    return longest


@row.close("rounded-somewhere")  # 5.7735 for 10 / sqrt(3).
def _(delta_q, v_max, a_max):
    return seconds(delta_q, v_max, a_max, acceleration=5.77350).max()


row.at_least_0(
    delta_q="only its absolute value is used",
    v_max="a limit is not negative",
    a_max="a limit is not negative",
    answer="a duration is not negative",
)
