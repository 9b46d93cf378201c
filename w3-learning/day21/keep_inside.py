"""21.2 `keep_inside(p, v, low, high, dt)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,), "m/s"), copies=False)


@row.inputs
def _(rng):
    low, high = np.array([-0.2, -0.3]), np.array([0.2, 0.3])
    for p, v, dt in (
        ((0.19, 0.1), (0.2, 0.1), 0.1),
        ((-0.18, -0.29), (-0.4, -0.3), 0.1),  # into a corner
        ((0.25, 0.1), (0.1, 0.1), 0.1),  # outside, and further out
        ((0.25, 0.1), (-0.2, 0.1), 0.1),  # outside, and back
        ((0.1, -0.34), (0.05, 0.2), 0.1),
        ((-0.26, 0.2), (-0.3, -0.1), 0.5),
        ((0.25, 0.0), (-9.0, 0.1), 0.1),  # through the whole box
        ((0.2, 0.3), (0.1, -0.1), 0.2),  # on the wall
        ((0.21, 0.1), (-0.3, 0.1), 0.1),  # outside, and inside after dt
        ((0.1, -0.31), (-0.2, 0.25), 0.2),
        ((0.1, 0.32), (0.05, 0.3), 0.1),  # the other entry, further out
        ((-0.1, -0.35), (0.1, 7.5), 0.1),  # and through the whole box
    ):
        yield np.array(p), np.array(v), low, high, dt
    low, high = np.array([-0.2, -0.3, -0.1]), np.array([0.2, 0.3, 0.4])
    yield np.array([0.1, 0.0, 0.38]), np.array([0.1, -0.1, 0.5]), low, high, 0.1
    yield np.array([0.0, 0.1, -0.08]), np.array([0.3, -0.1, -0.5]), low, high, 0.1
    for n in (1, 2, 2, 3, 3):
        yield inside(rng, n)


def inside(rng, n):
    """Return a position inside of a box, and a velocity that often leads out."""
    low, size = rng.numbers(-0.6, 0, n), rng.numbers(0.2, 0.7, n)
    p = low + size * rng.uniform(0.05, 0.95, n).round(2)
    dt = float(rng.numbers(0.05, 0.4))
    return p.round(4), rng.numbers(-2, 2, n), low, (low + size).round(4), dt


def is_out(p, v, low, high, dt):
    """Return whether the position is outside of the box."""
    return bool(np.any((p < low) | (p > high)))


row.cases(
    positions_inside_the_box=lambda *args: not is_out(*args),
    positions_outside_the_box=is_out,
)


@row.rare
def _(rng):
    for n in (1, 2, 3):
        p, v, low, high, dt = inside(rng, n)
        p[0] = high[0] + 0.05
        yield p, v, low, high, dt


@row.wrongs(
    hidden={
        "fixed-duration": "a tick of the lab is 0.1 s",
        "first-two": "the lab's boxes are in the plane",
        "symmetric": "the lab's boxes are symmetric",
    }
)
def _(p, v, low, high, dt):
    """stops-all: your code sets the whole velocity to 0 if one entry of the next
      position is outside the box. Limit each entry separately instead, so that the hand
      can slide along the wall
    stops-all 2: your code sets the whole velocity to 0 if one entry of the next
      position is outside the box. Limit each entry separately instead, so that the hand
      can slide along the wall
    shortened: your code multiplies the whole velocity by one factor. Limit each entry
      separately instead, so that the hand can slide along the wall
    axis-stops: your code sets an entry of the velocity to 0 if the next position would
      be outside. Reduce the entry instead, so that the next position is on the wall
    axis-stops 2: your code sets an entry of the velocity to 0 if the next position
      would be outside. Reduce the entry instead, so that the next position is on the
      wall
    jumps-back: your code moves the hand from outside the box to the wall in one step.
      Keep an entry of the velocity that leads back, and use 0 for an entry that leads
      further out
    dt-forgotten: your code uses the distances to the walls as bounds on the velocity.
      Divide each distance by `dt`
    only-if-outside: your code limits the velocity only if the position is already
      outside. Limit the velocity so that the next position, p + dt * v, does not leave
      the box
    only-if-outside 2: your code limits the velocity only if the position is already
      outside. Limit the velocity so that the next position, p + dt * v, does not leave
      the box
    may-not-return: your code sets an entry of the velocity to 0 if the position is
      outside along this axis. Keep an entry that leads back to the box
    position: your function returns the next position. Return the velocity instead
    position 2: your function returns the next position. Return the velocity instead
    no-position: your code omits the position from the bounds on the velocity. Subtract
      the position from each wall, because the bounds depend on the distances to the
      walls
    no-position 2: your code omits the position from the bounds on the velocity.
      Subtract the position from each wall, because the bounds depend on the distances
      to the walls
    fixed-duration: your code uses a fixed time step of 0.1 s. Use the argument `dt`
      instead
    through: your code does not limit an entry that leads back from outside. Limit this
      entry at the opposite wall, because otherwise the hand can pass through the whole
      box
    upper-only: your code limits the velocity only at the upper walls. Limit the
      velocity at the lower walls as well
    lower-only: your code limits the velocity only at the lower walls. Limit the
      velocity at the upper walls as well
    first-walls: your code uses the walls of the first entry for all entries. Use each
      entry's own walls instead
    first-two: your code limits only the first two entries. Limit all entries, because a
      position can have more than two entries
    symmetric: your code uses `-high` as the lower wall. Use `low` instead, because the
      box need not be symmetric
    min-and-max: your code keeps the lower bound on the velocity at or above 0, and the
      upper bound at or below 0. The lower bound should be at most 0, and the upper
      bound at least 0
    no-way-back: your code sets an entry that leads back from outside to 0, and keeps an
      entry that leads further out. Swap these two cases
    """
    after = p + dt * v
    there = np.clip(after, low, high)
    out = (p < low) | (p > high)
    down, up = (low - p) / dt, (high - p) / dt
    right = np.clip(v, np.minimum(down, 0), np.maximum(up, 0))
    worst = np.min(np.divide(right, v, out=np.ones_like(v), where=v != 0))
    leads_out = ((p > high) & (v > 0)) | ((p < low) & (v < 0))
    at_a_wall = ((p >= high) & (v > 0)) | ((p <= low) & (v < 0))
    outwards = np.where(p > high, np.maximum(v, 0), np.minimum(v, 0))
    return {
        "stops-all": v * np.all(right == v),
        "stops-all 2": v * np.all(there == after),
        "shortened": worst * v,
        "axis-stops": v * (right == v),
        "axis-stops 2": v * (there == after),
        "jumps-back": (there - p) / dt,
        "dt-forgotten": np.clip(v, np.minimum(low - p, 0), np.maximum(high - p, 0)),
        "only-if-outside": v * ~leads_out,
        "only-if-outside 2": v * ~at_a_wall,
        "may-not-return": right * ~out,
        "position": p + dt * right,
        "position 2": there,
        "no-position": np.clip(v, low / dt, high / dt),
        "no-position 2": np.clip(v, np.minimum(low / dt, 0), np.maximum(high / dt, 0)),
        "fixed-duration": np.clip(
            v, np.minimum((low - p) / 0.1, 0), np.maximum((high - p) / 0.1, 0)
        ),
        "through": np.where(out, v * ~leads_out, (there - p) / dt),
        "upper-only": np.minimum(v, np.maximum(up, 0)),
        "lower-only": np.maximum(v, np.minimum(down, 0)),
        "first-walls": np.clip(
            v, np.minimum((low[0] - p) / dt, 0), np.maximum((high[0] - p) / dt, 0)
        ),
        "first-two": np.append(right[:2], v[2:]),
        "symmetric": np.clip(v, np.minimum((-high - p) / dt, 0), np.maximum(up, 0)),
        "min-and-max": np.clip(v, np.maximum(down, 0), np.minimum(up, 0)),
        "no-way-back": np.where(out, outwards, right),
    }


@row.right  # The next position, clamped to a box that has grown to p.
def _(p, v, low, high, dt):
    after = np.clip(p + v * dt, np.minimum(low, p), np.maximum(high, p))
    return (after - p) / dt


@row.right  # Entry by entry.
def _(p, v, low, high, dt):
    out = v.copy()
    for i in range(len(v)):
        if v[i] > 0:
            out[i] = min(v[i], max(0, (high[i] - p[i]) / dt))
        else:
            out[i] = max(v[i], min(0, (low[i] - p[i]) / dt))
    return out


@row.spans
def _(rng):
    low, high = np.array([-0.5, -0.5]), np.array([0.5, 0.5])
    yield np.array([0.49999, 0.0]), np.array([0.2, 0.1]), low, high, 0.001
    yield np.array([0.3, -0.4]), np.array([0.2, -0.9]), low, high, 10.0
    yield np.array([5e-6, -3e-6]), np.array([2e-4, -4e-4]), low, high, 0.1


row.at_least_0(dt="a duration")
