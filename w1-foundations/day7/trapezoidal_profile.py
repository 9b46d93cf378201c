"""7.4 `trapezoidal_profile(t, L, v, a)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.trajectory import trapezoidal_profile


def between_ends(t, L, v, a):
    """Return whether no phase of the motion begins or ends at t."""
    _, ramp, T = timing(L, v, a)
    return min(abs(t - end) for end in (0.0, ramp, T - ramp, T)) > 1e-6


NAMES = ("the position", "the velocity", "the acceleration")
row = Row(
    Vector((3,), names=NAMES),
    at_edge=between_ends,
    conditions=[
        ("v^2 / a <= L", lambda t, L, v, a: v**2 / a <= L),
        ("v^2 / a > L", lambda t, L, v, a: v**2 / a > L),
    ],
)


@row.inputs
def _(rng):
    """Return all phases of a long motion and of a short one, then drawn motions.

    Between them are motions that are just too short and just long enough to reach v. No
    time is at the end of a phase, because the acceleration is not defined there.
    """
    long, short = (1.0, 0.5, 1.0), (0.1, 1.0, 2.0)
    fixed = [(t, *long) for t in (1.0, 0.3, 2.2, 3.0, -0.2, 4e-4, -4e-4)]
    fixed += [(t, *short) for t in (0.1, 0.3, 0.6)]
    fixed += [(0.6, L, 1.0, 2.0) for L in (0.48, 0.51, 0.7)]  # v^2 / a is 0.5
    sizes = rng.numbers(0.3, 2.0, 6, 3)
    drawn = np.column_stack([rng.numbers(0.1, 2.0, 6), sizes])
    return [*fixed, *map(tuple, drawn.tolist())]


def timing(L, v, a):
    """Return the highest velocity, the duration of a ramp, and the duration."""
    top = min(v, np.sqrt(L * a))
    return top, top / a, L / top + top / a


def profile(t, L, a, top, T):
    """Return position, velocity and acceleration for a given velocity and duration."""
    ramp = top / a
    left = T - t
    if t <= 0:
        return np.zeros(3)
    if t < ramp:
        return np.array([a * t**2 / 2, a * t, a])
    if t < T - ramp:
        return np.array([top * (t - ramp / 2), top, 0.0])
    if left <= 0:
        return np.array([L, 0.0, 0.0])
    return np.array([L - a * left**2 / 2, a * left, -a])


def to_top(t, L, a, top):
    """Return position, velocity and acceleration with another highest velocity."""
    return profile(t, L, a, top, L / top + top / a)


@row.wrongs
def _(t, L, v, a):
    """no-triangle: your code uses the maximum velocity v even if the distance L is too
      short to reach v. For L < v^2 / a, use a triangular profile, whose peak velocity
      is below v
    triangle-too-late: your code uses a triangular profile only for L < v^2 / (2 a),
      which is the distance that one ramp covers. Use a triangular profile for all L <
      v^2 / a, because the two ramps together cover the distance v^2 / a
    triangle-too-soon: your code uses a triangular profile for all L < 2 v^2 / a, so the
      velocity can exceed v. Use a triangular profile only for L < v^2 / a, because the
      two ramps together cover the distance v^2 / a
    triangle-too-high: for L < v^2 / a, the peak velocity of your profile is sqrt(2 L
      a). A triangle with this height and the slopes a and -a has the area 2 L. The area
      should be L, because the area under the velocity curve is the distance
    triangle-too-low: for L < v^2 / a, the peak velocity of your profile is sqrt(L a /
      2). A triangle with this height and the slopes a and -a has the area L / 2. The
      area should be L, because the area under the velocity curve is the distance
    triangle-not-a-root: for L < v^2 / a, the peak velocity of your profile is L a,
      which has the unit of a squared velocity. The peak velocity should be the square
      root of L a
    """
    peak = np.sqrt(L * a)
    short = v**2 > L * a  # L is too short to reach v
    tops = {
        "no-triangle": v,
        "triangle-too-late": peak if v**2 > 2 * L * a else v,
        "triangle-too-soon": peak if L * a < 2 * v**2 else v,
        "triangle-too-high": np.sqrt(2 * L * a) if short else v,
        "triangle-too-low": np.sqrt(L * a / 2) if short else v,
        "triangle-not-a-root": L * a if short else v,
    }
    return {slug: to_top(t, L, a, top) for slug, top in tops.items()}


@row.wrongs
def _(t, L, v, a):
    """ramps-way-forgotten: in your result, the constant-velocity phase starts at
      position 0. This phase should start at the position where the acceleration phase
      ends
    does-not-stop: your code continues the deceleration after the end, so the arm moves
      backwards. The arm should be at rest at position L instead
    does-not-wait: your code uses the formulas of the acceleration phase for t < 0.
      Before the start, the arm should be at rest at position 0
    does-not-wait-or-stop: your code accelerates before the start and decelerates after
      the end. The arm should be at rest before the start and after the end
    """
    top, ramp, T = timing(L, v, a)
    left = T - t
    right = trapezoidal_profile(t, L, v, a)
    up = np.array([a * t**2 / 2, a * t, a])
    down = np.array([L - a * left**2 / 2, a * left, -a])
    stops = down if left <= 0 else right
    cruises = ramp <= t < T - ramp
    return {
        "ramps-way-forgotten": right - [cruises * top * ramp / 2, 0.0, 0.0],
        "does-not-stop": stops,
        "does-not-wait": up if t <= 0 else right,
        "does-not-wait-or-stop": up if t <= 0 else stops,
    }


@row.right  # Three durations, added up piece by piece.
def _(t, L, v, a):
    v = min(v, np.sqrt(a * L))
    pieces = [(v / a, a), (L / v - v / a, 0.0), (v / a, -a)]
    s = 0.0
    sd = 0.0
    t = max(t, 0.0)
    for seconds, acc in pieces:
        h = min(t, seconds)
        s = s + sd * h + acc * h**2 / 2
        sd = sd + acc * h
        t = t - h
        if t <= 0:
            return np.array([s, sd, acc if h > 0 else 0.0])
    return np.array([L, 0.0, 0.0])


row.at_least_0(
    L="a distance is not negative",
    v="a limit is not negative",
    a="its sign is given by the phase",
    t="before 0 the result is the one at 0",
)
for move in ("a * t ** 2 / 2, a * t, a", "top * (t - ramp / 2), top, 0.0"):
    for sign in (
        f"np.abs((np.array([{move}])))",
        f"np.maximum((np.array([{move}])), 0)",
    ):
        row.same(
            f"return {sign}", "before the deceleration none of the three is negative"
        )


row.spans(  # as small, or as large, as in the lab
    t=(10.0,),
    L=(0.01,),
    v=(0.1,),
    a=(10.0,),
)
