"""Mistakes in task 7.2 `quintic_duration(dq, v_max, a_max)`, (n, 7) each."""

from collections.abc import Callable

import numpy as np

from labkit.judge.ask import Case, HeldOut
from labkit.judge.mistake import Finding, Mistake
from robo47.checks import Array
from robo47.simulate import ACC_LIMITS, SPEED_LIMITS


def _by(
    speed: float = 15 / 8, acceleration: float = 10 / np.sqrt(3)
) -> Callable[[Array, Array, Array], tuple[Array, Array]]:
    def both(dq: Array, v: Array, a: Array) -> tuple[Array, Array]:
        dq = np.abs(dq)
        return speed * dq / v, np.sqrt(acceleration * dq / a)

    return both


def _worst(**peaks: float) -> Callable[..., Array]:
    def redo(dq: Array, v: Array, a: Array) -> Array:
        return np.maximum(*_by(**peaks)(dq, v, a)).max(axis=1)

    return redo


def _root_forgotten(dq: Array, v: Array, a: Array) -> Array:
    by_speed, by_acceleration = _by()(dq, v, a)
    return np.maximum(by_speed, by_acceleration**2).max(axis=1)


def _total(dq: Array, v: Array, a: Array) -> Array:
    by_speed, by_acceleration = _by()(dq, v, a)
    return by_speed.max(axis=1) + by_acceleration.max(axis=1)


def _longest_way(dq: Array, v: Array, a: Array) -> Array:
    i, rows = np.abs(dq).argmax(axis=1), np.arange(len(dq))
    return np.maximum(*_by()(dq, v, a))[rows, i]


def _forwards_only(dq: Array, v: Array, a: Array) -> Array:
    by_speed, by_acceleration = _by()(dq, v, a)
    return np.maximum(np.sign(dq) * by_speed, by_acceleration).max(axis=1)


def _roots_of_signed(dq: Array, v: Array, a: Array) -> Array:
    by_speed = (15 / 8 * dq / v).max(axis=1)
    root = np.sqrt(np.maximum(10 / np.sqrt(3) * dq / a, 0.0)).max(axis=1)
    whole = (dq >= 0.0).all(axis=1)  # else it is NaN, which max(x, NaN) passes over
    return np.where(whole, np.maximum(by_speed, root), by_speed)


def _shorter(dq: Array, v: Array, a: Array) -> Array:
    by_speed, by_acceleration = _by()(dq, v, a)
    return np.minimum(by_speed.max(axis=1), by_acceleration.max(axis=1))


def _fastest_by_each(dq: Array, v: Array, a: Array) -> Array:
    by_speed, by_acceleration = _by()(dq, v, a)
    return np.maximum(by_speed.min(axis=1), by_acceleration.min(axis=1))


def _one_length(dq: Array, v: Array, a: Array) -> Array:
    length = np.linalg.norm(dq, axis=1)[:, None]
    return _worst()(length, v.min(axis=1)[:, None], a.min(axis=1)[:, None])


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


NO_WAY = HeldOut(
    "no-way",
    "Right, but not where no joint moves: that takes 0 s, as the docstring says.",
    lambda rng: [(np.zeros(7), SPEED_LIMITS, ACC_LIMITS)],
)


def _of_all(choose: Callable[[Array], Array]) -> Callable[..., Array]:
    return lambda dq, v, a: _worst()(dq, choose(v)[:, None], choose(a)[:, None])


DURATION = [
    Mistake(
        "peak-of-the-cubic",
        "1.5 is the cubic's peak speed; the quintic is faster half way, so this breaks "
        "the speed limit by a quarter",
        _worst(speed=1.5),
        "the duration with 1.5",
    ),
    Mistake(
        "peak-of-the-cubic",
        "1.5 and 6 are the cubic's peaks; the quintic has others",
        _worst(speed=1.5, acceleration=6.0),
        "the cubic's duration",
    ),
    Mistake(
        "peak-of-the-cubic",
        "6 is the cubic's peak acceleration; the quintic's is where the derivative of "
        "its acceleration is 0",
        _worst(acceleration=6.0),
        "the duration with 6",
    ),
    Mistake(
        "peak-at-a-quarter",
        "5.625 is the acceleration at a quarter of the time; its peak is a little "
        "earlier, where its derivative is 0",
        _worst(acceleration=5.625),
        "the duration with 5.625",
    ),
    Mistake(
        "shorter-of-two",
        "it takes the shorter of the two durations, which breaks one of the limits; "
        "the longer one keeps both",
        _shorter,
        "the smaller of the two",
    ),
    Mistake(
        "average-speed",
        "the time dq / v would do for a move that is always at its top speed; this one "
        "starts and stops softly",
        _worst(speed=1.0),
        "the duration with dq / v",
    ),
    Mistake(
        "peak-upside-down",
        "the peak speed is 15/8 dq / T; here it is turned into 8/15",
        _worst(speed=8 / 15),
        "the duration with 8/15",
    ),
    Mistake(
        "peak-acceleration",
        "the peak acceleration is 10 / sqrt(3) times dq / T^2; the root is lost",
        _worst(acceleration=10 / 3),
        "the duration with 10/3",
    ),
    Mistake(
        "fastest-joint",
        "it takes the joint that needs least; all the others break their limits",
        lambda dq, v, a: np.maximum(*_by()(dq, v, a)).min(axis=1),
        "the smallest of the joints' durations",
    ),
    Mistake(
        "fastest-joint",
        "it takes the joint that needs least, for the speed and for the acceleration; "
        "all the others break their limits",
        _fastest_by_each,
        "the larger of the two minima",
    ),
    Mistake(
        "one-length",
        "the ways of all joints are put together as one length, |dq|; each joint has "
        "its own way and its own limits",
        _one_length,
        "the duration of |dq| with the lowest limits",
    ),
    Mistake(
        "summed",
        "the joints' durations are added up; they move at the same time",
        lambda dq, v, a: np.maximum(*_by()(dq, v, a)).sum(axis=1),
        "the sum over the joints",
    ),
    Mistake(
        "mean",
        "it takes the mean of the joints' durations; half of them break their limits",
        lambda dq, v, a: np.maximum(*_by()(dq, v, a)).mean(axis=1),
        "the mean over the joints",
    ),
    Mistake(
        "longest-way",
        "it takes the joint with the longest way; one with a lower limit may need more",
        _longest_way,
        "the duration of the joint with the longest way",
    ),
    Mistake(
        "one-limit-for-all",
        "the first joint's limits are used for all; each joint has its own",
        _of_all(lambda limit: limit[:, 0]),
        "the duration with joint1's limits",
    ),
    Mistake(
        "one-limit-for-all",
        "the lowest limits are used for all; each joint has its own",
        _of_all(lambda limit: limit.min(axis=1)),
        "the duration with the lowest limits",
    ),
    Mistake(
        "speed-only",
        "only the speed limits count; a short move breaks the acceleration's",
        lambda dq, v, a: _by()(dq, v, a)[0].max(axis=1),
        "the duration by speed",
    ),
    Mistake(
        "acceleration-only",
        "only the acceleration limits count; a long move breaks the speed's",
        lambda dq, v, a: _by()(dq, v, a)[1].max(axis=1),
        "the duration by acceleration",
    ),
    Mistake(
        "root-forgotten",
        "acceleration falls with T squared, so T is a square root",
        _root_forgotten,
        "the duration without the root",
    ),
    Mistake(
        "added-up",
        "the two durations are added; the longer one keeps both limits",
        _total,
        "the sum of the two",
    ),
    Mistake(
        "shorter-of-two",
        "each joint takes the shorter of its two durations; both limits count",
        lambda dq, v, a: np.minimum(*_by()(dq, v, a)).max(axis=1),
        "the shorter of the two",
    ),
    Mistake(
        "forwards-only",
        "a joint that moves backwards counts as one that is ready before it starts: "
        "the way's sign is still in it",
        _forwards_only,
        "the duration with signed ways",
    ),
    Mistake(
        "ways-signed",
        "the ways' signs are still in it: the root of a negative one is NaN, which max "
        "passes over in silence",
        _roots_of_signed,
        "the duration with signed ways",
    ),
]
