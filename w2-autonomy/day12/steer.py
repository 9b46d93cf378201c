"""12.1 `steer(q, target, step)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row, Vector
from robo47.planning import steer


def from_afar(rng):
    """Return targets within a step, so far that rounding q + way shows at once."""
    far = 1e14  # a number so large is good to 1/64 alone
    for k in (2, 7, 7):
        q = target = rng.numbers(-2, 2, k)
        q = np.where(np.arange(k) == 0, far, q)
        target = np.where(np.arange(k) == 0, 0.3, target)
        yield q, target, 2 * far


NOT_THE_TARGET = HeldOut(
    "not-the-target",
    "Right but for the last bit: where the target is within a step, q plus the whole "
    "way is rounded, and may miss the target (where q is 1e14 by much). Return a copy "
    "of the target then: trees join where two nodes are equal.",
    from_afar,
)
row = Row(Vector((None,)), held_out=[NOT_THE_TARGET])


@row.inputs
def _(rng):
    yield np.zeros(2), np.array([3.0, 4]), 1.0
    yield np.zeros(2), np.array([0.3, 0.4]), 1.0
    yield np.array([1.0, 2]), np.array([1.0, 2]), 0.5
    yield np.array([1.0, 2]), np.array([1.0, -2]), 0.5
    # The square of the distance is less than a step, and is more.
    yield np.array([0.4, 0.1]), np.array([0.76, 0.58]), 0.5
    yield np.array([0.4, 0.1]), np.array([-0.68, 1.54]), 2.0
    yield np.array([0.2, 0.1, -0.3]), np.array([0.25, 0.1, -0.3]), 0.5
    for k, step in ((2, 0.437), (2, 0.137), (3, 0.611), (7, 0.613), (7, 1.237)):
        yield rng.numbers(-2, 2, k), rng.numbers(-2, 2, k), step  # far, nearly always
    for k, step in ((2, 0.713), (2, 2.131), (7, 0.613), (7, 3.217)):
        q = rng.numbers(-2, 2, k)
        near = rng.numbers(-0.2, 0.2, k)  # 0.53 at most
        yield q, np.round(q + near, 3), step


def away(q, target):
    """Return how far a target is away."""
    return float(np.linalg.norm(target - q))


row.cases(
    targets_at_q_itself=lambda q, target, step: away(q, target) == 0,
    targets_within_a_step=lambda q, target, step: 0 < away(q, target) <= step,
    targets_farther_than_a_step=lambda q, target, step: away(q, target) > step,
)
row.cases(
    targets_that_differ_in_one_coordinate=(
        lambda q, target, step: np.count_nonzero(target - q) == 1
    ),
    targets_that_differ_in_several_coordinates=(
        lambda q, target, step: np.count_nonzero(target - q) > 1
    ),
    targets_at_q_itself=lambda q, target, step: away(q, target) == 0,
)


@row.rare
def _(rng):
    for k in (2, 7):
        q, way = rng.numbers(-2, 2, 2, k)
        one = way * (np.arange(k) == rng.integers(k))
        for along in (way, one, 0.0 * way):
            target = np.round(q + along, 3)
            for share in (0.2, 0.8, 1.3):
                yield q, target, float(share * away(q, target) or share)


@row.wrongs
def _(q, target, step):
    """overshoots: it goes a whole step even where the target is nearer, and past it; it
      ends at the target then => a whole step each time
    no-limit: it goes to the target, however far: the step limits nothing => the target
    fraction: it goes the share `step` of the way; a step is a length => q + step
      (target - q)
    fraction-at-most-all: it goes the share `step` of the way, at most all of it; a step
      is a length
    not-unit: far targets are not divided by their distance => q + step (target - q)
      where the target is far
    squared: it divides by the square of the distance; its root makes a direction of
      length 1
    from-the-target: a step is taken back from the target; it starts at q
    from-the-target 2: a step is added to the target, and goes past it; it starts at q
    direction-only: q is missing: this is the step, and not where it ends
    direction-only 2: q is missing: this is the step, or the whole way where it is
      shorter
    away: it goes away from the target: q - target is the other way round
    away 2: where the target is far it goes a step away from it
    stays-when-near: where the target is no further than a step it does not move; it
      ends at the target then
    always-q: it never moves
    largest-coordinate: the distance is taken for the largest difference in one
      coordinate; it is the root of the sum of squares
    largest-coordinate 2: each coordinate is cut to a step; the whole way is to be no
      longer than one
    sum-of-sizes: the distance is taken for the sum of the differences' sizes; it is the
      root of the sum of squares
    unit-step: it goes 1 far; it is `step` => with step 1
    half-a-step: it goes half a step
    limit-the-other-way: where the target is far it jumps to it, and where it is near it
      goes a whole step: the two cases are swapped
    from-the-origin: it goes from the origin, not from q
    square-compared: the square of the distance is compared with the step; its root is
      the distance
    two-coordinates: the distance is that of the first two coordinates; all of them
      count
    root-of-the-mean: the distance is the root of the mean of squares; it is that of
      their sum
    length-of-the-target: it divides by the target's distance from the origin; it is
      that from q
    direction-from-the-origin: the direction is that of the target from the origin; it
      is that from q
    stops-half-way: where the target is near it goes half of the way; it ends at the
      target then
    step-on-each-coordinate: where the target is far each coordinate goes a whole step;
      the whole way is to be a step long
    """
    way = target - q
    far = np.linalg.norm(way)
    unit = way / far if far else np.zeros_like(way)
    size = np.abs(way).max() or 1.0
    total = np.abs(way).sum() or 1.0
    near = far <= step
    part = min(1.0, step / far) if far else 0.0
    two = np.linalg.norm(way[:2])
    mean = far / np.sqrt(len(way))
    size_of = max(np.linalg.norm(target), 1e-12)
    return {
        "overshoots": q + step * unit,
        "no-limit": target,
        "fraction": q + step * way,
        "fraction-at-most-all": q + min(step, 1.0) * way,
        "not-unit": target if near else q + step * way,
        "squared": target if near else q + step * unit / far,
        "from-the-target": target if near else target - step * unit,
        "from-the-target 2": target if near else target + step * unit,
        "direction-only": step * unit,
        "direction-only 2": part * way,
        "away": q - part * way,
        "away 2": target if near else q - step * unit,
        "stays-when-near": q if near else q + step * unit,
        "always-q": q,
        "largest-coordinate": q + min(1.0, step / size) * way,
        "largest-coordinate 2": q + np.clip(way, -step, step),
        "sum-of-sizes": q + min(1.0, step / total) * way,
        "unit-step": target if far <= 1.0 else q + unit,
        "half-a-step": target if far <= step / 2 else q + step / 2 * unit,
        "limit-the-other-way": q + step * unit if near else target,
        "from-the-origin": steer(np.zeros_like(q), target, step),
        "square-compared": target if far**2 <= step else q + step * unit,
        "two-coordinates": target if two <= step else q + step / two * way,
        "root-of-the-mean": target if mean <= step else q + step / mean * way,
        "length-of-the-target": target if near else q + step / size_of * way,
        "direction-from-the-origin": target if near else q + step / size_of * target,
        "stops-half-way": q + way / 2 if near else q + step * unit,
        "step-on-each-coordinate": target if near else q + step * np.sign(way),
    }


@row.wrong(hidden="the lab never steers to where a tree stands")
def divided_by_nothing(q, target, step):
    """where the target is q itself the distance is 0, and 0 / 0 is NaN: there is
    nothing to go, so it stays => without that case"""
    way = target - q
    with np.errstate(all="ignore"):
        return q + min(step, np.linalg.norm(way)) * (way / np.linalg.norm(way))


@row.right  # By the share of the way.
def _(q, target, step):
    far = np.sqrt(np.sum((target - q) ** 2))
    return np.array(target) if far <= step else q + (target - q) * (step / far)


@row.right  # By a loop over the coordinates.
def _(q, target, step):
    far = np.linalg.norm(q - target)
    if far > step:
        return np.array([a + step * (b - a) / far for a, b in zip(q, target)])
    return np.array([float(b) for b in target])


@row.wrong("not-the-target", hidden="its trees join all the same")
def _(q, target, step):
    far = np.linalg.norm(q - target)
    return q + (target - q) * min(1.0, step / max(far, 1e-12))


@row.wrong("not-the-target")
def _(q, target, step):
    way = target - q
    far = np.linalg.norm(way)
    return q + way / far * min(step, far) if far else np.array(target)


row.at_least_0(step="a length")


row.spans(  # as small, or as large, as in the lab
    q=(lambda q: 0.006 * q,),
)
