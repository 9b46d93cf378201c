"""Mistakes in task 5.3 `error_response`: zeta decides between three formulas."""

from collections.abc import Callable

import numpy as np

from labkit.judge.mistake import Mistake
from robo47 import control
from robo47.checks import Array

from .where import masks


def _truth(t: Array, omega: Array, zeta: Array) -> Array:
    return control.error_response(t, omega[:, None], zeta[:, None])


def _only(case: int, wrong: Callable[..., Array]) -> Callable[..., Array]:
    """Return the right answers, but for one of the three cases, made by `wrong`."""

    def redo(t: Array, omega: Array, zeta: Array) -> Array:
        out = _truth(t, omega, zeta)
        some = masks(zeta)[case]
        out[some] = wrong(t[some], omega[some, None], zeta[some, None])
        return out

    return redo


def _everywhere(wrong: Callable[..., Array]) -> Callable[..., Array]:
    return lambda t, omega, zeta: wrong(t, omega[:, None], zeta[:, None])


def _swing(w: Array, z: Array) -> Array:
    return w * np.sqrt(1 - z**2)


def _rates(w: Array, z: Array) -> tuple[Array, Array]:
    spread = w * np.sqrt(z**2 - 1)
    return z * w - spread, z * w + spread


def _under(cos: float, sin: Callable[[Array, Array], Array]) -> Callable[..., Array]:
    """Return e^(-zeta w t) (cos of the damped swing + a factor times its sine)."""

    def wrong(t: Array, w: Array, z: Array) -> Array:
        wd = _swing(w, z)
        return np.exp(-z * w * t) * (cos * np.cos(wd * t) + sin(w, z) * np.sin(wd * t))

    return wrong


def _undamped(t: Array, w: Array, z: Array) -> Array:
    return np.exp(-z * w * t) * (np.cos(w * t) + z * np.sin(w * t))


def _wrong_decay(t: Array, w: Array, z: Array) -> Array:
    wd = _swing(w, z)
    return np.exp(-w * t) * (np.cos(wd * t) + z * w / wd * np.sin(wd * t))


def _root_forgotten(t: Array, w: Array, z: Array) -> Array:
    wd = w * (1 - z**2)
    return np.exp(-z * w * t) * (np.cos(wd * t) + z * w / wd * np.sin(wd * t))


def _slow_alone(t: Array, w: Array, z: Array) -> Array:
    return np.exp(-_rates(w, z)[0] * t)


def _mean_of_both(t: Array, w: Array, z: Array) -> Array:
    slow, fast = _rates(w, z)
    return (np.exp(-slow * t) + np.exp(-fast * t)) / 2


def _weights_swapped(t: Array, w: Array, z: Array) -> Array:
    slow, fast = _rates(w, z)
    return (fast * np.exp(-fast * t) - slow * np.exp(-slow * t)) / (fast - slow)


def _weights_summed(t: Array, w: Array, z: Array) -> Array:
    slow, fast = _rates(w, z)
    return (fast * np.exp(-slow * t) + slow * np.exp(-fast * t)) / (fast + slow)


def _critical(t: Array, w: Array, z: Array) -> Array:
    return (1 + w * t) * np.exp(-w * t)


def _near_one(t: Array, w: Array, z: Array) -> Array:
    return np.where(
        np.abs(z - 1) < 0.05, _critical(t, w, z), _truth(t, w[:, 0], z[:, 0])
    )


def _first_is_one(t: Array, w: Array, z: Array) -> Array:
    out = _truth(t, w[:, 0], z[:, 0])
    out[:, 0] = 1.0
    return out


RESPONSE = [
    Mistake(
        "one-formula-for-all",
        "zeta is not looked at: this is critical damping, every time",
        _everywhere(_critical),
    ),
    Mistake(
        "envelope-alone",
        "this is the envelope, e^(-zeta omega t); the error starts at rest, and this "
        "curve starts with a slope",
        _everywhere(lambda t, w, z: np.exp(-z * w * t)),
    ),
    Mistake(
        "envelope-of-omega",
        "this is e^(-omega t), whatever zeta is; the error starts at rest, and this "
        "curve starts with a slope",
        _everywhere(lambda t, w, z: np.exp(-w * t)),
    ),
    Mistake(
        "half-the-damping",
        "this is the curve of half the zeta: the equation has 2 zeta omega before ed",
        lambda t, w, z: _truth(t, w, z / 2),
    ),
    Mistake(
        "window-around-one",
        "zeta near 1 gets the formula of zeta = 1, which is right at 1 alone; only "
        "rounding, 1e-9 say, may count as 1",
        _everywhere(_near_one),
    ),
    Mistake(
        "time-from-the-first",
        "time is counted from the first of t; t = 0 is where the error was 1, whether "
        "it is in t or not",
        lambda t, w, z: _truth(t - t[:, :1], w, z),
    ),
    Mistake(
        "times-sorted",
        "the times are sorted first; entry i of the answer belongs to entry i of t",
        lambda t, w, z: _truth(np.sort(t, axis=1), w, z),
    ),
    Mistake(
        "first-entry-one",
        "the first entry is set to 1, whatever the first time is; only at t = 0 the "
        "error is 1",
        _everywhere(_first_is_one),
    ),
    Mistake(
        "output-in-place-of-error",
        "this rises from 0 to 1: it is what the joint does, and the error is the rest",
        lambda t, w, z: 1 - _truth(t, w, z),
    ),
    Mistake(
        "omega-in-turns",
        "omega is taken for turns per second and multiplied by 2 pi; it comes in rad/s",
        lambda t, w, z: _truth(t, 2 * np.pi * w, z),
    ),
    Mistake(
        "second-solution-forgotten",
        "for zeta = 1 the term omega t e^(-omega t) is missing: this curve does not "
        "start at rest",
        _only(0, lambda t, w, z: np.exp(-w * t)),
    ),
    Mistake(
        "second-solution-sign",
        "for zeta = 1 the term with omega t has the wrong sign: the error starts with "
        "a slope and becomes negative, which critical damping never does",
        _only(0, lambda t, w, z: (1 - w * t) * np.exp(-w * t)),
    ),
    Mistake(
        "second-solution-without-omega",
        "for zeta = 1 it is 1 + t in place of 1 + omega t: seconds are added to 1",
        _only(0, lambda t, w, z: (1 + t) * np.exp(-w * t)),
    ),
    Mistake(
        "undamped-frequency",
        "under zeta = 1 it swings with omega; damping makes it swing more slowly",
        _only(1, _undamped),
    ),
    Mistake(
        "sine-forgotten",
        "under zeta = 1 the sine is missing: this curve does not start at rest",
        _only(1, _under(1.0, lambda w, z: 0.0 * w)),
    ),
    Mistake(
        "sine-sign",
        "under zeta = 1 the sine has the wrong sign: this curve does not start at rest",
        _only(1, _under(1.0, lambda w, z: -z * w / _swing(w, z))),
    ),
    Mistake(
        "sine-unscaled",
        "under zeta = 1 the sine lacks its factor: this curve does not start at rest",
        _only(1, _under(1.0, lambda w, z: 1.0 + 0.0 * w)),
    ),
    Mistake(
        "sine-divided-by-omega",
        "under zeta = 1 the sine's factor is zeta; what divides is the damped "
        "frequency, not omega",
        _only(1, _under(1.0, lambda w, z: z)),
    ),
    Mistake(
        "decays-with-omega",
        "under zeta = 1 it decays with omega; the envelope falls with zeta omega",
        _only(1, _wrong_decay),
    ),
    Mistake(
        "root-forgotten",
        "under zeta = 1 the damped frequency lacks its square root",
        _only(1, _root_forgotten),
    ),
    Mistake(
        "slow-exponential-alone",
        "over zeta = 1 only the slow exponential is there: this curve does not start "
        "at rest",
        _only(2, _slow_alone),
    ),
    Mistake(
        "both-halves",
        "over zeta = 1 the two exponentials have equal weights: this curve does not "
        "start at rest",
        _only(2, _mean_of_both),
    ),
    Mistake(
        "weights-swapped",
        "over zeta = 1 each exponential has the weight of the other",
        _only(2, _weights_swapped),
    ),
    Mistake(
        "weights-summed",
        "over zeta = 1 the weights have the wrong sign between them: this curve does "
        "not start at rest",
        _only(2, _weights_summed),
    ),
    Mistake(
        "critical-above-one",
        "over zeta = 1 it is the curve of zeta = 1; more damping makes it slower",
        _only(2, _critical),
    ),
]
