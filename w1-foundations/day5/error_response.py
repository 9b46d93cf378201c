"""5.3 `error_response(t, omega, zeta)`: its questions and its mistakes.

Where a mistake is in one of the three cases alone, the library answers the others.
"""

import numpy as np

from labkit.judge import Row, Vector
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.control import error_response

TIMES = np.array([0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5])
MIXED = np.array([0.1, 0.3, 0.15, 0.5, 0.2, 0.4, 0.25, 0.35])
HIDDEN = {  # why a lab's run cannot show it
    "window-around-one": "no zeta there is so near to 1",
    **dict.fromkeys(("time-from-the-first", "first-entry-one"), "t there begins at 0"),
}


def starts_elsewhere(case: Case) -> Finding | None:
    """Say that some curve does not start at 1."""
    t = case.arguments[0]
    if np.abs(case.S[t == 0.0] - 1.0).max() < 1e-8:
        return None
    says = "For some zeta, your error at t = 0 is not 1. The error should be 1 at "
    says += "t = 0 for every zeta."
    return Finding("does-not-start-at-one", says)


row = Row(Vector((len(TIMES),)), unnamed=starts_elsewhere)
row.cases({
    "zeta below 1": lambda t, omega, zeta: zeta < 1.0,
    "zeta equal to 1": lambda t, omega, zeta: zeta == 1.0,
    "zeta above 1": lambda t, omega, zeta: zeta > 1.0,
})  # fmt: skip
row.cases({
    "zeta within 0.01 of 1, but not equal to 1": (
        lambda t, omega, zeta: 0.0 < abs(zeta - 1.0) < 0.01
    ),
    "zeta equal to 1": lambda t, omega, zeta: zeta == 1.0,
    "other values of zeta": lambda t, omega, zeta: abs(zeta - 1.0) >= 0.01,
})  # fmt: skip
row.cases({
    "times that begin at 0 and increase": (
        lambda t, omega, zeta: t[0] == 0.0 and bool(np.all(np.diff(t) > 0.0))
    ),
    "times that do not begin at 0 or do not increase": (
        lambda t, omega, zeta: t[0] != 0.0 or bool(np.any(np.diff(t) <= 0.0))
    ),
})  # fmt: skip


@row.rare
def _(rng):
    t = rng.numbers(0.0, 0.6, len(TIMES))
    below, above, near = rng.uniform(0.1, 0.95), rng.uniform(1.05, 3), 1 + rng.normal()
    for zeta in (1.0, below, above, 1.0 + 0.005 * np.tanh(near)):
        for times in (t, np.append(0.0, 0.001 + np.sort(t)[1:])):
            yield times, float(rng.numbers(4, 30)), float(zeta)


@row.inputs
def _(rng):
    zetas = [1.0, *rng.numbers(0.1, 0.9, 4), 1.0, *rng.numbers(1.1, 3, 4)]
    omegas = [10.0, *rng.numbers(4, 30, 9)]
    drawn = [(TIMES, float(w), float(z)) for w, z in zip(omegas, zetas, strict=True)]
    near = [(TIMES, 10.0, zeta) for zeta in (0.9995, 1.0005, 0.0)]
    mixed = [(MIXED, 4.0, zeta) for zeta in (0.5, 1.0, 1.5)]
    return [drawn[0], *near, *mixed, *drawn[1:]]


@row.wrongs
def _(t, omega, zeta):
    """one-formula-for-all: your code uses the formula for zeta = 1 for every zeta, with
      zeta omega instead of omega. For zeta below 1, the error should oscillate. For
      zeta above 1, the error should be a sum of two exponentials
    envelope-alone: your code returns only the envelope e^(-zeta omega t). The
      derivative of the error should be 0 at t = 0, but the derivative of the envelope
      is `-zeta omega`
    envelope-of-omega: your code returns e^(-omega t) for every zeta. The derivative of
      the error should be 0 at t = 0, but the derivative of this curve is `-omega`
    half-the-damping: your code uses half the damping ratio. In the error equation, the
      coefficient of the first derivative is 2 zeta omega
    output-in-place-of-error: your code returns the step response, which rises from 0 to
      1. Return the error instead, which is 1 minus the step response
    omega-in-turns: your code multiplies omega by 2 pi. Use omega unchanged, because it
      is already in rad/s
    """
    return {
        "one-formula-for-all": (1 + zeta * omega * t) * np.exp(-zeta * omega * t),
        "envelope-alone": np.exp(-zeta * omega * t),
        "envelope-of-omega": np.exp(-omega * t),
        "half-the-damping": error_response(t, omega, zeta / 2.0),
        "output-in-place-of-error": 1.0 - error_response(t, omega, zeta),
        "omega-in-turns": error_response(t, 2.0 * np.pi * omega, zeta),
    }


@row.wrongs(hidden=HIDDEN)
def _(t, omega, zeta):
    """window-around-one: your code also uses the formula for zeta = 1 for values of
      zeta near 1, where this formula is not accurate. Use the formula only if zeta
      equals 1 up to rounding, for example within 1e-9
    time-from-the-first: your code measures time from `t[0]`. The error should be 1 at t
      = 0, even if the array t does not contain 0
    first-entry-one: your code always sets the first entry to 1. The array t does not
      always begin at 0, so compute this entry as well
    """
    near = 1.0 if abs(zeta - 1.0) < 0.05 else zeta
    return {
        "window-around-one": error_response(t, omega, near),
        "time-from-the-first": error_response(t - t[0], omega, zeta),
        "first-entry-one": np.append(1.0, error_response(t, omega, zeta)[1:]),
    }


@row.wrongs
def _(t, omega, zeta):
    """slow-exponential-alone: your code uses only the slow exponential for zeta above
      1. Use both exponentials, so that the derivative of the error is 0 at t = 0
    both-halves: for zeta above 1, your error is the mean of the two exponentials, so it
      omits the sinh term. Choose the two weights so that the derivative of the error is
      0 at t = 0
    weights-swapped: for zeta above 1, your weights of the two exponentials are swapped,
      or your sinh term has the wrong sign. The slow exponential should have the larger
      weight
    weights-summed: for zeta above 1, the derivative of your error at t = 0 is not 0. If
      your formula contains two exponentials, replace the plus sign with a minus sign in
      both the numerator and the denominator. If your formula contains cosh and sinh,
      use the reciprocal of the factor of sinh
    critical-above-one: your code returns the curve for zeta = 1 for every zeta above 1.
      The error should decay more slowly for a larger zeta
    """
    above = zeta if zeta > 1.0 else 2.0  # below, the library answers
    half_gap = omega * np.sqrt(above**2 - 1.0)
    a = above * omega - half_gap
    b = above * omega + half_gap
    slow, fast = np.exp(-a * t), np.exp(-b * t)
    curves = {
        "slow-exponential-alone": slow,
        "both-halves": (slow + fast) / 2.0,
        "weights-swapped": (b * fast - a * slow) / (b - a),
        "weights-summed": (b * slow + a * fast) / (b + a),
        "critical-above-one": (1.0 + omega * t) * np.exp(-omega * t),
    }
    if zeta > 1.0:
        return curves
    return dict.fromkeys(curves, error_response(t, omega, zeta))


@row.right  # One complex formula for under and over.
def _(t, omega, zeta):
    if zeta == 1:
        return (1 + omega * t) / np.exp(omega * t)
    s = omega * (-zeta + np.array([1, -1]) * np.sqrt(complex(zeta**2 - 1)))
    return ((s[0] * np.exp(s[1] * t) - s[1] * np.exp(s[0] * t)) / (s[0] - s[1])).real


@row.right  # The eigenvalues of the 2x2 system; at zeta = 1 the limit.
def _(t, omega, zeta):
    if zeta == 1:
        return np.exp(-omega * t) * (1 + omega * t)
    A = np.array([[0, 1], [-(omega**2), -2 * zeta * omega]])
    w, V = np.linalg.eig(A.astype(complex))
    c = np.linalg.solve(V, [1, 0])
    return np.real([(V @ (c * np.exp(w * x)))[0] for x in t])


@row.close("rounded-somewhere")  # zeta = 1 by a zeta nearly 1.
def _(t, omega, zeta):
    z = zeta + 1e-6 if zeta == 1 else zeta
    s = omega * (-z + np.array([1, -1]) * np.sqrt(complex(z**2 - 1)))
    return ((s[0] * np.exp(s[1] * t) - s[1] * np.exp(s[0] * t)) / (s[0] - s[1])).real


row.at_least_0(t="time since the start", omega="a frequency", zeta="a damping ratio")
for decay in (
    "((fast * np.exp(-slow * t) - slow * np.exp(-fast * t)) / (fast - slow))",
    "((1.0 + rate * t) * np.exp(-rate * t))",
):
    row.same(
        f"return np.abs({decay})", "for zeta of at least 1 the error is never negative"
    )
    row.same(
        f"return np.maximum({decay}, 0)", "for zeta of at least 1 it is never negative"
    )
