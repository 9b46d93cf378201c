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
    **dict.fromkeys(
        ("time-from-the-first", "times-sorted", "first-entry-one"),
        "t there begins at 0, in order",
    ),
}


def starts_elsewhere(case: Case) -> Finding | None:
    """Say that some curve does not start at 1."""
    t = case.arguments[0]
    if np.abs(case.S[t == 0.0] - 1.0).max() < 1e-8:
        return None
    says = "At t = 0 the error is 1, and your answer is another number for some zeta."
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
    "times in another order, or from another start": (
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
    """one-formula-for-all: zeta is not looked at: this is critical damping, every time
    one-formula-for-all 2: zeta only stretches time: this is the formula of zeta = 1 for
      every zeta, and under 1 it does not swing
    envelope-alone: this is the envelope, e^(-zeta omega t); the error starts at rest,
      and this curve starts with a slope
    envelope-of-omega: this is e^(-omega t), whatever zeta is; the error starts at rest,
      and this curve starts with a slope
    half-the-damping: this is the curve of half the zeta: the equation has 2 zeta omega
      before ed
    output-in-place-of-error: this rises from 0 to 1: it is what the joint does, and the
      error is the rest
    omega-in-turns: omega is taken for turns per second and multiplied by 2 pi; it comes
      in rad/s
    """
    return {
        "one-formula-for-all": (1.0 + omega * t) * np.exp(-omega * t),
        "one-formula-for-all 2": (1 + zeta * omega * t) * np.exp(-zeta * omega * t),
        "envelope-alone": np.exp(-zeta * omega * t),
        "envelope-of-omega": np.exp(-omega * t),
        "half-the-damping": error_response(t, omega, zeta / 2.0),
        "output-in-place-of-error": 1.0 - error_response(t, omega, zeta),
        "omega-in-turns": error_response(t, 2.0 * np.pi * omega, zeta),
    }


@row.wrongs(hidden=HIDDEN)
def _(t, omega, zeta):
    """window-around-one: zeta near 1 gets the formula of zeta = 1, which is right at 1
      alone; only rounding, 1e-9 say, may count as 1
    time-from-the-first: time is counted from the first of t; t = 0 is where the error
      was 1, whether it is in t or not
    times-sorted: the times are sorted first; entry i of the answer belongs to entry i
      of t
    first-entry-one: the first entry is set to 1, whatever the first time is; only at
      t = 0 the error is 1
    """
    near = 1.0 if abs(zeta - 1.0) < 0.05 else zeta
    return {
        "window-around-one": error_response(t, omega, near),
        "time-from-the-first": error_response(t - t[0], omega, zeta),
        "times-sorted": error_response(np.sort(t), omega, zeta),
        "first-entry-one": np.append(1.0, error_response(t, omega, zeta)[1:]),
    }


def where(case, inside):
    """Take mistakes of one case; elsewhere the library answers.

    Args:
        case: says of a zeta whether it is one of the case.
        inside: a zeta that is, whose slugs are those of all.
    """

    def keep(curves):
        def law(t, omega, zeta):
            if case(zeta):
                return curves(t, omega, zeta)
            return dict.fromkeys(
                curves(t, omega, inside), error_response(t, omega, zeta)
            )

        law.__doc__ = curves.__doc__
        row.wrongs(law)

    return keep


@where(lambda zeta: zeta == 1.0, inside=1.0)
def _(t, omega, zeta):
    """second-solution-forgotten: for zeta = 1 the term omega t e^(-omega t) is missing:
      this curve does not start at rest
    second-solution-sign: for zeta = 1 the term with omega t has the wrong sign: the
      error starts with a slope and becomes negative, which critical damping never does
    second-solution-without-omega: for zeta = 1 it is 1 + t instead of 1 + omega t:
      seconds are added to 1
    """
    return {
        "second-solution-forgotten": np.exp(-omega * t),
        "second-solution-sign": (1.0 - omega * t) * np.exp(-omega * t),
        "second-solution-without-omega": (1.0 + t) * np.exp(-omega * t),
    }


@where(lambda zeta: zeta < 1.0, inside=0.5)
def _(t, omega, zeta):
    """undamped-frequency: under zeta = 1 it swings with omega; damping makes it swing
      more slowly
    sine-forgotten: under zeta = 1 the sine is missing: this curve does not start at
      rest
    sine-sign: under zeta = 1 the sine has the wrong sign: this curve does not start at
      rest
    sine-unscaled: under zeta = 1 the sine lacks its factor: this curve does not start
      at rest
    sine-divided-by-omega: under zeta = 1 the sine's factor is zeta; what divides is the
      damped frequency, not omega
    decays-with-omega: under zeta = 1 it decays with omega; the envelope falls with zeta
      omega
    root-forgotten: under zeta = 1 the damped frequency lacks its square root
    """
    rate = zeta * omega
    w = omega * np.sqrt(1 - zeta**2)
    w_2 = omega * (1 - zeta**2)
    cos_0, cos, cos_2 = (np.cos(one * t) for one in (omega, w, w_2))
    sin_0, sin, sin_2 = (np.sin(one * t) for one in (omega, w, w_2))
    envelope = np.exp(-rate * t)
    return {
        "undamped-frequency": envelope * (cos_0 + zeta * sin_0),
        "sine-forgotten": envelope * cos,
        "sine-sign": envelope * (cos - rate / w * sin),
        "sine-unscaled": envelope * (cos + sin),
        "sine-divided-by-omega": envelope * (cos + zeta * sin),
        "decays-with-omega": np.exp(-omega * t) * (cos + rate / w * sin),
        "root-forgotten": envelope * (cos_2 + rate / w_2 * sin_2),
    }


@where(lambda zeta: zeta > 1.0, inside=2.0)
def _(t, omega, zeta):
    """slow-exponential-alone: over zeta = 1 only the slow exponential is there: this
      curve does not start at rest
    both-halves: over zeta = 1 the two exponentials have equal weights: this curve does
      not start at rest
    weights-swapped: over zeta = 1 each exponential has the weight of the other
    weights-summed: over zeta = 1 the weights have the wrong sign between them: this
      curve does not start at rest
    critical-above-one: over zeta = 1 it is the curve of zeta = 1; more damping makes it
      slower
    """
    spread = omega * np.sqrt(zeta**2 - 1.0)
    a = zeta * omega - spread
    b = zeta * omega + spread
    slow, fast = np.exp(-a * t), np.exp(-b * t)
    return {
        "slow-exponential-alone": slow,
        "both-halves": (slow + fast) / 2.0,
        "weights-swapped": (b * fast - a * slow) / (b - a),
        "weights-summed": (b * slow + a * fast) / (b + a),
        "critical-above-one": (1.0 + omega * t) * np.exp(-omega * t),
    }


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
    row.same(f"return np.abs({decay})", "with zeta of 1 and more it never overshoots")
    row.same(f"return np.maximum({decay}, 0)", "with zeta of 1 and more it never does")
