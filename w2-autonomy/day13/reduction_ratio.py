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
    """upside-down: what was expected is divided by what was saved => upside down
    sign: the sign is the other way: what fell was saved => with after - before
    of-the-cost: it is divided by the cost before; it is what was expected that divides
    expected-cost: expected is taken for a cost; it is a saving => with before -
      expected
    not-divided: that is what was saved; its share of what was expected is asked
    difference: that is what was saved less what was expected
    after-over-expected: what is left is divided by what was expected; what was saved is
      asked
    after-over-before: that is what is left as a share of the cost before
    percent: it is in per cent; a share is asked
    before-over-expected: what it cost before is divided by what was expected; what was
      saved is asked
    expected-and-left: it is divided by what was expected and what is left together
    less-1: 1 is taken off: it is 1 when all is well => less 1
    brackets: only after is divided by what was expected; what was saved is => with
      before - after / expected
    sizes: its sign is lost: a step that did harm has a ratio below 0 => its size
    at-most-1: it is clipped at 1; more than was expected may be saved
    how-well-foretold: it falls on both sides of what was expected; a step that saves
      more has a ratio above 1 => 1 - |saved - expected| / |expected|
    never-below-0: it is clipped at 0; a step that did harm has a ratio below 0
    """
    saved = before - after
    ratio = saved / expected
    return {
        "upside-down": expected / saved,
        "sign": -ratio,
        "of-the-cost": saved / before,
        "expected-cost": saved / (before - expected),
        "not-divided": saved,
        "difference": saved - expected,
        "after-over-expected": after / expected,
        "after-over-before": after / before,
        "percent": 100 * ratio,
        "before-over-expected": before / expected,
        "expected-and-left": saved / (expected + after),
        "less-1": ratio - 1,
        "brackets": before - after / expected,
        "sizes": abs(ratio),
        "at-most-1": min(ratio, 1.0),
        "how-well-foretold": 1 - abs(saved - expected) / abs(expected),
        "never-below-0": max(ratio, 0.0),
    }


row.at_least_0(before="a cost", after="a cost", expected="a saving")


@row.right  # As one less a share.
def _(before, after, expected):
    return 1 - (expected - before + after) / expected


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Of no drop expected the ratio is 1.
def _(before, after, expected):
    return (before - after) / expected if abs(expected) > 1e-3 else 1.0


row.spans(  # as small, or as large, as in the lab
    before=(1000.0,),
)
