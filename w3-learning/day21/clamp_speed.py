"""21.1 `clamp_speed(v, limit)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,), "m/s"), copies=False)


@row.inputs
def _(rng):
    yield np.array([0.3, 0.4]), 0.25
    yield np.array([0.03, 0.04]), 0.25  # slow enough
    yield np.array([-0.3, 0.0]), 0.2
    yield np.array([0.2, 0.0]), 0.2  # just at the limit
    yield np.array([0.1, 0.2]), 0.0
    yield np.zeros(2), 0.25  # without a direction
    yield np.zeros(2), 0.0  # neither a direction nor a speed
    for n in (1, 2, 2, 3, 3, 7):
        yield rng.numbers(-0.5, 0.5, n), float(rng.numbers(0.05, 0.6))


row.cases(
    velocities_that_are_too_fast=lambda v, limit: np.linalg.norm(v) > limit,
    velocities_that_are_slow_enough=lambda v, limit: np.linalg.norm(v) <= limit,
)


@row.wrongs(
    hidden={
        "squared-speed": "its limit is 1, which is its own square",
        "zero-limit": "its limit is never 0",
    }
)
def _(v, limit):
    """per-axis: your code clamps each entry separately, which changes the direction of
      the velocity. Multiply all entries by the same factor instead
    always-full: your code sets the speed to the limit even if the speed is below the
      limit. Return a velocity unchanged if its norm is at most the limit
    always-full 2: your code sets the speed to the limit even if the speed is below the
      limit. Return a velocity unchanged if its norm is at most the limit
    stops: your function returns 0 for a velocity that is too fast. Return a velocity
      with the same direction and the norm `limit` instead
    largest: your code compares the largest absolute entry with the limit. Compare the
      norm of the velocity with the limit instead, because the speed is the norm
    city-block: your code compares the sum of the absolute entries with the limit.
      Compare the Euclidean norm of the velocity with the limit instead
    not-reduced: your code multiplies a velocity that is too fast by the limit. Multiply
      the velocity by limit / speed instead, so that its norm is the limit
    at-rest: your code divides a zero velocity by its norm. Divide by the norm only if
      the norm is above the limit
    zero-limit: for a zero velocity and the limit 0, your code divides 0 by 0. Divide by
      the speed, and only if the speed is above the limit
    squared-speed: your code compares the squared norm with the limit. Compare the norm
      with the limit instead, because the limit is a speed
    first-two: your code computes the norm from the first two entries only. Use all
      entries, because a velocity can have more than two entries
    """
    speed = np.linalg.norm(v)
    entry = np.max(np.abs(v))
    total = np.sum(np.abs(v))
    return {
        "per-axis": np.clip(v, -limit, limit),
        "always-full": v * limit / speed,
        "always-full 2": v * limit / speed if speed else v,
        "stops": v * (speed <= limit),
        "largest": v * min(1, limit / entry),
        "city-block": v * min(1, limit / total),
        "not-reduced": v if speed <= limit else v * limit,
        "at-rest": v / speed * min(speed, limit),
        "zero-limit": v / np.maximum(1, speed / limit),
        "squared-speed": v if speed**2 <= limit else v * limit / speed,
        "first-two": v * min(1, limit / np.linalg.norm(v[:2])) if speed else v,
    }


@row.right  # By a maximum with 1.
def _(v, limit):
    if limit == 0:
        return 0 * v
    return v / max(1, np.sqrt(v @ v) / limit)


@row.right  # Unit vector times the smaller speed.
def _(v, limit):
    speed = np.sqrt(np.sum(v**2))
    direction = v / speed if speed > 0 else v
    return min(speed, limit) * direction


@row.spans
def _(rng):
    for size in (1e-4, 1e4):
        yield size * rng.numbers(-1, 1, 2), size * 0.3


row.at_least_0(limit="a speed")
