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
    "Your result is correct except for rounding. If the target is within a step, "
    "q + (target - q) can differ from the target. Return a copy of the target, because "
    "two trees are connected only at equal nodes.",
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
    """overshoots: your code takes a full step even if the target is less than one step
      away. Stop at the target
    no-limit: your code returns the target even if it is more than one step away. Limit
      the displacement to one step
    fraction: your code multiplies the displacement by `step`. The distance from q
      should be `step`, or the distance to the target if this is smaller
    fraction-at-most-all: your code multiplies the displacement by the smaller of `step`
      and 1. The distance from q should be `step`, or the distance to the target if this
      is smaller
    not-unit: if the target is more than one step away, your code multiplies the
      displacement by `step`. Divide the displacement by its norm first, because `step`
      is a length and not a fraction
    squared: your code divides the displacement by its squared norm. Divide the
      displacement by its norm instead
    from-the-target: your code subtracts the step from the target. Add the step to q
      instead
    from-the-target 2: your code adds the step to the target. Add the step to q instead
    direction-only: your code returns the product of `step` and the unit vector towards
      the target. Return the target if it is within one step, and q plus this product
      otherwise
    direction-only 2: your code returns the displacement from q to the new point. Add
      this displacement to q
    away: your code moves away from the target. The direction to the target is `target -
      q`
    away 2: if the target is more than one step away, your code moves away from it. The
      direction to the target is `target - q`
    stays-when-near: your code returns q if the target is within one step. Return the
      target instead
    always-q: your code always returns q. Move from q towards the target by at most one
      step
    largest-coordinate: your code uses the largest absolute coordinate difference as the
      distance. Use the Euclidean norm instead
    largest-coordinate 2: your code clamps each coordinate of the displacement to one
      step. Limit the norm of the displacement instead
    sum-of-sizes: your code uses the sum of the absolute coordinate differences as the
      distance. Use the Euclidean norm instead
    unit-step: your code adds a displacement of norm 1 to q. Use the argument `step` as
      the norm instead
    half-a-step: your code moves at most half a step. Use the whole step
    limit-the-other-way: your code returns the target if it is more than one step away,
      and it takes a full step otherwise. Swap the two cases
    from-the-origin: your code starts the step at the origin. Start the step at q
      instead
    square-compared: your code compares the squared distance with `step`. Compare the
      distance itself instead
    two-coordinates: your code uses only the first two coordinates for the distance. Use
      all coordinates
    root-of-the-mean: your code uses the root of the mean of the squares as the
      distance. Use the root of their sum instead, because the distance is a norm
    length-of-the-target: your code divides the displacement by the norm of the target.
      Divide it by the norm of `target - q` instead
    direction-from-the-origin: your code uses the direction from the origin to the
      target. Use the direction from q to the target instead
    stops-half-way: if the target is within one step, your code moves only halfway to
      it. Return the target instead
    step-on-each-coordinate: if the target is more than one step away, your code changes
      each coordinate by a full step. Use a displacement whose norm is one step instead
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
    """if the target equals q, the distance is 0 and your code computes 0 / 0 (NaN).
    Return q"""
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


@row.wrong("not-the-target", hidden="on some processors its trees join, too")
def _(q, target, step):
    way = target - q
    far = np.linalg.norm(way)
    return q + way / far * min(step, far) if far else np.array(target)


row.at_least_0(step="a length")


row.spans(  # as small, or as large, as in the lab
    q=(lambda q: 0.006 * q,),
)
