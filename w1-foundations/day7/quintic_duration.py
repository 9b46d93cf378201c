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
    "Right, but not where no joint moves: that takes 0 s, as the docstring says.",
    lambda rng: [(np.zeros(7), SPEED_LIMITS, ACC_LIMITS)],
)


def never_less(case: Case) -> Finding | None:
    """Return that only short durations are wrong, and all of them the same."""
    off = ~np.isclose(case.S, case.T, rtol=0.0, atol=1e-8)
    least = float(case.S[off].min())
    if off.all() or np.ptp(case.S[off]) > 1e-12:
        return None
    if case.T[off].max() > min(least, case.T[~off].min()):
        return None
    says = f"It is never less than {least:g} s; a short way takes less."
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
    """Return what each joint needs by its speed and by its acceleration."""
    delta_q = np.abs(delta_q)
    return np.array([speed * delta_q / v_max, np.sqrt(acceleration * delta_q / a_max)])


@row.wrongs
def _(delta_q, v_max, a_max):
    """peak-of-the-cubic: 1.5 is the cubic's peak speed; the quintic is faster half way,
      so this breaks the speed limit by a quarter => the duration with 1.5
    average-speed: the time delta_q / v would do for a move that is always at its top
      speed; this one starts and stops softly => the duration with delta_q / v
    peak-upside-down: the peak speed is 15/8 delta_q / duration; here it is turned into
      8/15
    peak-at-a-quarter: 5.625 is the acceleration at a quarter of the time; its peak is a
      little earlier, where its derivative is 0 => the duration with 5.625
    peak-acceleration: the peak acceleration is 10 / sqrt(3) times delta_q / duration^2;
      the root is lost => the duration with 10/3
    """
    peaks = {
        "peak-of-the-cubic": {"speed": 1.5},
        "average-speed": {"speed": 1.0},
        "peak-upside-down": {"speed": 8 / 15},
        "peak-at-a-quarter": {"acceleration": 5.625},
        "peak-acceleration": {"acceleration": 10 / 3},
    }
    return {
        slug: seconds(delta_q, v_max, a_max, **of).max() for slug, of in peaks.items()
    }


@row.wrongs
def _(delta_q, v_max, a_max):
    """peak-of-the-cubic: 1.5 and 6 are the cubic's peaks; the quintic has others
    limits-of-different-joints: the longest way is divided by the smallest limit of all;
      way and limit have to be those of one joint => max(delta_q) over min(a_max) for
      the acceleration
    both-added: the time for the speed and the time for the acceleration are added; one
      way keeps both limits if it takes the longer of the two => their sum
    shorter-of-two: it takes the shorter of the two durations, which breaks one of the
      limits; the longer one keeps both => the smaller of the two
    fastest-joint: it takes the joint that needs least; all the others break their
      limits => the smallest of the joints' durations
    one-length: the ways of all joints are put together as one length, |delta_q|; each
      joint has its own way and its own limits => the duration of |delta_q| with the
      lowest limits
    summed: the joints' durations are added up; they move at the same time
    mean: it takes the mean of the joints' durations; half of them break their limits
    longest-way: it takes the joint with the longest way; one with a lower limit may
      need more => the duration of the joint with the longest way
    one-limit-for-all: the first joint's limits are used for all; each joint has its own
    speed-only: only the speed limits count; a short move breaks the acceleration's
    acceleration-only: only the acceleration limits count; a long move breaks the
      speed's => the duration by acceleration
    root-forgotten: acceleration falls with the duration squared, so the duration is a
      square root
    added-up: the two durations are added; the longer one keeps both limits
    peak-of-the-cubic 2: 6 is the cubic's peak acceleration; the quintic's is where the
      derivative of its acceleration is 0 => the duration with 6
    shorter-of-two 2: each joint takes the shorter of its two durations; both limits
      count
    fastest-joint 2: it takes the joint that needs least, for the speed and for the
      acceleration; all the others break their limits => the larger of the two minima
    one-limit-for-all 2: the lowest limits are used for all; each joint has its own
    ways-signed: the ways' signs are still in it: the root of a negative one is NaN,
      which max passes over in silence => the duration with signed ways
    forwards-only: a joint that moves backwards counts as one that is ready before it
      starts: the way's sign is still in it => the duration with signed ways
    """
    each = seconds(delta_q, v_max, a_max)
    i = np.argmax(np.abs(delta_q))
    by_speed, by_acceleration = each
    longest = np.sqrt(PEAK_ACCELERATION * np.abs(delta_q[i]) / a_max.min())
    lowest = (v_max.min(), a_max.min())
    signed = 10 / np.sqrt(3) * delta_q / a_max
    return {
        "peak-of-the-cubic": seconds(delta_q, v_max, a_max, 1.5, 6.0).max(),
        "limits-of-different-joints": max(by_speed.max(), longest),
        "both-added": each.sum(axis=0).max(),
        "shorter-of-two": min(each.max(axis=1)),
        "fastest-joint": each.max(axis=0).min(),
        "one-length": seconds(np.linalg.norm(delta_q), *lowest).max(),
        "summed": each.max(axis=0).sum(),
        "mean": each.max(axis=0).mean(),
        "longest-way": each[:, i].max(),
        "one-limit-for-all": seconds(delta_q, v_max[0], a_max[0]).max(),
        "speed-only": by_speed.max(),
        "acceleration-only": by_acceleration.max(),
        "root-forgotten": max(by_speed.max(), (by_acceleration**2).max()),
        "added-up": each.max(axis=1).sum(),
        "peak-of-the-cubic 2": seconds(delta_q, v_max, a_max, acceleration=6.0).max(),
        "shorter-of-two 2": each.min(axis=0).max(),
        "fastest-joint 2": each.min(axis=1).max(),
        "one-limit-for-all 2": seconds(delta_q, *lowest).max(),
        "ways-signed": max((15 / 8 * delta_q / v_max).max(), np.sqrt(signed).max()),
        "forwards-only": max(
            (np.sign(delta_q) * by_speed).max(), by_acceleration.max()
        ),
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
    delta_q="its way counts, not its sign",
    v_max="a limit",
    a_max="a limit",
    answer="a time",
)
