"""7.1 `quintic_scaling(t, duration)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Vector, rounded
from labkit.judge.answers import difference
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.trajectory import quintic_scaling

QUINTIC = (0, 0, 0, 10, -15, 6)


def by_quotients(case: Case) -> Finding | None:
    """Return that sd and sdd are close where s is exact: a quotient leaves that."""
    if difference(case.S[:, 0], case.T[:, 0]).max() > 1e-14:
        return None
    off = difference(case.S, case.T).max()
    return Finding(
        "difference-quotient",
        f"s is exact, but sd or sdd is off by {off:.1e}, as a difference quotient "
        "leaves it. The derivative of a polynomial is a polynomial: write it down.",
    )


def times(rng, n):
    """Return times and durations: before, on the way, after, then n drawn ones."""
    fixed = [(0.6, 2.0), (1.0, 2.0), (2.5, 2.0), (-0.4, 2.0), (0.5, 0.5), (0.9, 3.0)]
    T = rng.numbers(0.3, 4.0, n)
    t = rounded(T * rng.uniform(0.02, 0.98, n))
    return [*fixed, *zip(t.tolist(), T.tolist(), strict=True)]


row = Row(Vector((3,), names=("s", "sd", "sdd")), near_miss=by_quotients)
row.inputs(lambda rng: times(rng, 7))


def polynomial(factors, x, T):
    """Return a polynomial in x = t / T, and its derivatives with respect to t."""
    p = np.polynomial.Polynomial(factors)
    return np.array([p(x), p.deriv()(x) / T, p.deriv(2)(x) / T**2])


def jumps(t, T):
    """cubic: this is the cubic, 3 x^2 - 2 x^3; its acceleration jumps at both ends =>
      the cubic
    linear: s grows at one rate, so the speed jumps at both ends => s = x
    cosine: this is the raised cosine; its acceleration jumps at both ends => the raised
      cosine
    """
    x = np.clip(t / T, 0.0, 1.0)
    a = np.pi * x
    k = np.pi / T
    cosine = [1 - np.cos(a), k * np.sin(a), k**2 * np.cos(a)]
    return {
        "cubic": polynomial((0, 0, 3, -2), x, T),
        "linear": np.array([x, 1.0 / T, 0.0]),
        "cosine": np.array(cosine) / 2,
    }


def jumps_to_rest(t, T):
    """Return the same, with sd and sdd 0 at both ends."""
    rest = [1.0, 0.0 < t < T, 0.0 < t < T]
    return {slug: answer * rest for slug, answer in jumps(t, T).items()}


jumps_to_rest.__doc__ = jumps.__doc__
row.wrongs(jumps)
row.wrongs(jumps_to_rest)


@row.wrongs
def _(t, T):
    """septic: this is the polynomial of degree 7, which has no jerk at the ends either;
      the task is the quintic => the polynomial of degree 7
    6-and-10-swapped: the factors 6 and 10 are swapped: s ends at 1, but still moving =>
      the quintic with 6 and 10 swapped
    sign-of-15: the factor 15 has the wrong sign: at its end s is 31 => the quintic with
      +15
    sd-and-sdd-not-divided: each of sd and sdd is the derivative with respect to x = t /
      duration; with respect to t, each derivative divides by the duration once more
    t-for-x: the time itself stands where t / duration belongs, so the duration does not
      count => the quintic of t
    not-clipped: after the end (and before the start) the polynomial goes on: at 1.25
      times the duration s is 1.22 => the quintic without its ends
    not-divided+not-clipped: two things at once: sd and sdd are not divided by the
      duration and its square, and after the end, and before the start, the polynomial
      goes on
    end-not-clipped: it waits for the start, but after the end the polynomial goes on
    start-not-clipped: it stops at the end, but before the start the polynomial is there
      already => the quintic without its start
    backwards: it runs from 1 to 0: the remaining time stands where the time belongs =>
      the quintic of 1 - t / duration
    """
    x = np.clip(t / T, 0.0, 1.0)
    given = {
        "septic": ((0, 0, 0, 0, 35, -84, 70, -20), x, T),
        "6-and-10-swapped": ((0, 0, 0, 6, -15, 10), x, T),
        "sign-of-15": ((0, 0, 0, 10, 15, 6), x, T),
        "sd-and-sdd-not-divided": (QUINTIC, x, 1.0),
        "t-for-x": (QUINTIC, t, 1.0),
        "not-clipped": (QUINTIC, t / T, T),
        "not-divided+not-clipped": (QUINTIC, t / T, 1.0),
        "end-not-clipped": (QUINTIC, max(t / T, 0.0), T),
        "start-not-clipped": (QUINTIC, min(t / T, 1.0), T),
        "backwards": (QUINTIC, 1.0 - x, T),
    }
    return {slug: partial(polynomial, *some) for slug, some in given.items()}


@row.wrongs
def _(t, T):
    """sd-not-divided: the entry sd is the derivative with respect to x = t / duration;
      with respect to t, each derivative divides by the duration once more => sd without
      1/duration
    sdd-not-divided: the entry sdd is the derivative with respect to x = t / duration;
      with respect to t, each derivative divides by the duration once more => sdd
      without 1/duration^2
    sdd-divided-once: the entry sdd is divided by the duration once; it is a second
      derivative => sdd with 1/duration
    multiplied-by-T: the derivatives are multiplied by the duration, where the chain
      rule divides => the answer with the duration and its square as factors
    t-for-x: the time itself, clipped to 0..1, stands where t / duration belongs => the
      quintic of t
    only-s-clipped: s stops at the end, but sd and sdd go on: it says that it moves and
      stands => the answer without the ends of sd and sdd
    order: the order is s, sd, sdd; here the derivatives are swapped
    t-for-x 2: the time itself stands where t / duration belongs => the quintic of t
    order 2: the order is s, sd, sdd; here it runs backwards => the order sdd, sd, s
    """
    right = quintic_scaling(t, T)
    return {
        "sd-not-divided": right * [1.0, T, 1.0],
        "sdd-not-divided": right * [1.0, 1.0, T**2],
        "sdd-divided-once": right * [1.0, 1.0, T],
        "multiplied-by-T": right * [1.0, T**2, T**4],
        "t-for-x": lambda: polynomial(QUINTIC, np.clip(t, 0.0, 1.0), 1.0),
        "only-s-clipped": lambda: np.append(
            right[0], polynomial(QUINTIC, t / T, T)[1:]
        ),
        "order": right[[0, 2, 1]],
        "t-for-x 2": polynomial(QUINTIC, np.clip(t, 0.0, 1.0), T),
        "order 2": right[::-1],
    }


@row.right  # Horner's scheme, and the time stopped by hand.
def _(t, T):
    if t <= 0:
        return np.array([0.0, 0.0, 0.0])
    if t >= T:
        return np.array([1.0, 0.0, 0.0])
    x = t / T
    s = x * x * x * (10 + x * (-15 + x * 6))
    sd = x * x * (30 + x * (-60 + x * 30)) / T
    return np.array([s, sd, x * (60 + x * (-180 + x * 120)) / (T * T)])


@row.close("rounded-somewhere")  # In single precision.
def _(t, T):
    x = np.float32(np.clip(t / T, 0, 1))
    s = 10 * x**3 - 15 * x**4 + 6 * x**5
    sd = 30 * x**2 * (1 - x) ** 2 / T
    sdd = (60 * x - 180 * x**2 + 120 * x**3) / T**2
    return np.array([s, sd, sdd], dtype=np.float32)


@row.close("difference-quotient")  # Central differences for the derivatives.
def _(t, T):
    s = np.polynomial.Polynomial(QUINTIC)
    h = 1e-4
    x = np.clip(t / T, 0, 1)
    sd = (s(x + h) - s(x - h)) / (2 * h * T)
    return np.array([s(x), sd, (s(x + h) - 2 * s(x) + s(x - h)) / (h * T) ** 2])


row.at_least_0(
    duration="how long the move takes",
    t="before 0 it stands at its start, as at 0",
)


row.spans(  # as small, or as large, as in the lab
    t=(0.004,),
)
