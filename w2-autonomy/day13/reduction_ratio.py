"""13.8 `reduction_ratio(before, after, expected)`: its questions and its mistakes."""

from labkit.judge import Row, Scalar

row = Row(Scalar())


@row.inputs
def _(rng):
    drawn = [tuple(map(float, rng.numbers(0.5, 5, 3))) for _ in range(6)]
    return [(5.0, 3.5, 2.0), (5.0, 0.5, 3.0), (2.0, 3.0, 4.0), *drawn]


row.spans(expected=(1e-5, 1e5), after=(lambda after: 1e6,))


@row.wrongs
def _(before, after, expected):
    """sign: your code negates the ratio. Use `before - after` as the measured reduction
    difference: your code subtracts the expected reduction from the measured one. Divide
      the measured reduction by the expected one instead
    after-over-before: your code returns after / before (the fraction of the cost that
      remains). Divide the measured reduction by the expected one instead
    percent: your code returns the ratio as a percentage, which is 100 times too large.
      Return the ratio itself
    less-1: your function subtracts 1 from the ratio. Return the ratio itself, which is
      1 if the cost falls as expected
    how-well-foretold: your code returns `1 - |measured - expected| / |expected|`.
      Return measured / expected instead, which is above 1 if the cost falls more than
      expected
    """
    saved = before - after
    ratio = saved / expected
    return {
        "sign": -ratio,
        "difference": saved - expected,
        "after-over-before": after / before,
        "percent": 100 * ratio,
        "less-1": ratio - 1,
        "how-well-foretold": 1 - abs(saved - expected) / abs(expected),
    }


row.at_least_0(before="a cost", after="a cost", expected="a saving")


@row.right  # As 1 minus a fraction.
def _(before, after, expected):
    return 1 - (expected - before + after) / expected


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # If no reduction is expected, the ratio is 1.
def _(before, after, expected):
    return (before - after) / expected if abs(expected) > 1e-3 else 1.0


row.spans(  # as small, or as large, as in the lab
    before=(1000.0,),
)
