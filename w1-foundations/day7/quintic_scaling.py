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
    """Return that sd and sdd are difference quotients: close, while s is exact."""
    if difference(case.S[:, 0], case.T[:, 0]).max() > 1e-14:
        return None
    off = difference(case.S, case.T).max()
    return Finding(
        "difference-quotient",
        f"Your s is exact, but sd or sdd is off by {off:.1e}, which is typical of a "
        "difference quotient. Differentiate the polynomial by hand.",
    )


def times(rng, n):
    """Return times and durations: before, during and after, then n drawn ones."""
    fixed = [(0.6, 2.0), (1.0, 2.0), (2.5, 2.0), (-0.4, 2.0), (0.5, 0.5), (0.9, 3.0)]
    T = rng.numbers(0.3, 4.0, n)
    t = rounded(T * rng.uniform(0.02, 0.98, n))
    return [*fixed, *zip(t.tolist(), T.tolist(), strict=True)]


row = Row(Vector((3,), names=("s", "sd", "sdd")), near_miss=by_quotients)
row.inputs(lambda rng: times(rng, 7))


def polynomial(coefficients, x, T):
    """Return a polynomial in x = t / T, and its derivatives with respect to t."""
    p = np.polynomial.Polynomial(coefficients)
    return np.array([p(x), p.deriv()(x) / T, p.deriv(2)(x) / T**2])


def jumps(t, T):
    """cubic: your code uses the cubic 3 x^2 - 2 x^3 with x = t / duration. The
      acceleration of the cubic jumps at both ends. Use the quintic instead, because its
      acceleration is 0 at both ends
    linear: your code uses s = t / duration, so the velocity jumps at both ends. Use the
      quintic instead, because its velocity and acceleration are 0 at both ends
    cosine: your code uses s = (1 - cos(pi x)) / 2 with x = t / duration. The
      acceleration of this function jumps at both ends. Use the quintic instead, because
      its acceleration is 0 at both ends
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
    """septic: your code uses the polynomial of degree 7, whose jerk is also 0 at both
      ends. Use the polynomial of degree 5 instead, because the task does not require a
      jerk of 0
    6-and-10-swapped: your code swaps the coefficients 6 and 10, so the velocity is not
      0 at the end. The coefficient of x^3 should be 10 and the coefficient of x^5
      should be 6, where x = t / duration
    sd-and-sdd-not-divided: your code returns the derivatives with respect to x = t /
      duration as sd and sdd. By the chain rule, divide sd by the duration and sdd by
      duration^2
    t-for-x: your code evaluates the polynomial and its derivatives at t, so the
      duration has no effect. Evaluate them at t / duration instead, clamped to [0, 1],
      and apply the chain rule to sd and sdd
    not-divided+not-clipped: your code returns the derivatives with respect to x = t /
      duration instead of t. Your code also evaluates the polynomial before the start
      and after the end, when the robot should be at rest
    end-not-clipped: your code handles t < 0 but not t > duration, so it evaluates the
      polynomial after the end. For t > duration, use s = 1 with zero velocity and
      acceleration, because the robot is at rest again
    never-clipped: your code also evaluates the polynomial before the start and after
      the end. Use s = 0 before the start and s = 1 after the end, both with zero
      velocity and acceleration
    start-not-clipped: your code handles t > duration but not t < 0, so it evaluates the
      polynomial before the start. For t < 0, use s = 0 with zero velocity and
      acceleration, because the robot is still at rest
    """
    x = np.clip(t / T, 0.0, 1.0)
    given = {
        "septic": ((0, 0, 0, 0, 35, -84, 70, -20), x, T),
        "6-and-10-swapped": ((0, 0, 0, 6, -15, 10), x, T),
        "sd-and-sdd-not-divided": (QUINTIC, x, 1.0),
        "t-for-x": (QUINTIC, t, 1.0),
        "not-divided+not-clipped": (QUINTIC, t / T, 1.0),
        "end-not-clipped": (QUINTIC, max(t / T, 0.0), T),
        "never-clipped": (QUINTIC, t / T, T),
        "start-not-clipped": (QUINTIC, min(t / T, 1.0), T),
    }
    return {slug: partial(polynomial, *some) for slug, some in given.items()}


@row.wrongs
def _(t, T):
    """sd-not-divided: your code returns the derivative with respect to x = t / duration
      as sd. By the chain rule, divide sd by the duration
    sdd-not-divided: your code returns the second derivative with respect to x = t /
      duration as sdd. By the chain rule, divide sdd by duration^2
    sdd-divided-once: your code divides sdd by the duration only once. Divide sdd by
      duration^2, because sdd is the second derivative with respect to t
    multiplied-by-T: your code multiplies sd by the duration and sdd by duration^2. By
      the chain rule, divide by these factors instead
    only-s-clipped: your code clamps s before the start and after the end, but not sd
      and sdd. Set both derivatives to 0 at these times, because the robot is at rest
    """
    right = quintic_scaling(t, T)
    return {
        "sd-not-divided": right * [1.0, T, 1.0],
        "sdd-not-divided": right * [1.0, 1.0, T**2],
        "sdd-divided-once": right * [1.0, 1.0, T],
        "multiplied-by-T": right * [1.0, T**2, T**4],
        "only-s-clipped": np.append(right[0], polynomial(QUINTIC, t / T, T)[1:]),
    }


@row.right  # Horner's scheme, with a case for each end.
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
    duration="a duration is not negative",
    t="before 0 the result is the one at 0",
)


row.spans(  # as small, or as large, as in the lab
    t=(0.004,),
)
