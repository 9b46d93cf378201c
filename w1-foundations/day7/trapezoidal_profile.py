"""7.4 `trapezoidal_profile(t, L, v, a)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.trajectory import trapezoidal_profile


def between_ends(t, L, v, a):
    """Return whether t is a moment at which no piece ends."""
    _, ramp, T = timing(L, v, a)
    return min(abs(t - end) for end in (0.0, ramp, T - ramp, T)) > 1e-6


NAMES = ("the position", "the speed", "the acceleration")
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
    """Give all pieces of a long move and of a short one, then drawn ones.

    Between them, two moves just too short and just long enough to reach v. Never at
    the moment when a piece ends: what the acceleration is there is a matter of taste.
    """
    long, short = (1.0, 0.5, 1.0), (0.1, 1.0, 2.0)
    fixed = [(t, *long) for t in (1.0, 0.3, 2.2, 3.0, -0.2, 4e-4, -4e-4)]
    fixed += [(t, *short) for t in (0.1, 0.3, 0.6)]
    fixed += [(0.6, L, 1.0, 2.0) for L in (0.48, 0.51, 0.7)]  # v^2 / a is 0.5
    sizes = rng.numbers(0.3, 2.0, 6, 3)
    drawn = np.column_stack([rng.numbers(0.1, 2.0, 6), sizes])
    return [*fixed, *map(tuple, drawn.tolist())]


def timing(L, v, a):
    """Return the top speed, the time of a ramp, and the duration."""
    top = min(v, np.sqrt(L * a))
    return top, top / a, L / top + top / a


def profile(t, L, a, top, T):
    """Return position, speed and acceleration for any top speed and duration."""
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
    """Return position, speed and acceleration of another top speed."""
    return profile(t, L, a, top, L / top + top / a)


@row.wrongs
def _(t, L, v, a):
    """no-triangle: the top speed is always v; a short way ends before v is reached, so
      it overshoots => the trapezoid without its triangle
    always-a-triangle: it never cruises: the top speed is sqrt(L a) even where that is
      over v => the triangle
    triangle-too-late: it becomes a triangle only below L = v^2 / (2 a), which is one
      ramp's way; there are two ramps => the triangle below v^2 / (2 a)
    triangle-too-soon: it becomes a triangle already below L = 2 v^2 / a, and its top is
      over v then; the two ramps take v^2 / a in all => the triangle below 2 v^2 / a
    ramps-take-no-time: the duration is L / v, as if it were at v from the first moment;
      the ramps cost one ramp more => the profile with the duration L / v
    """
    top = timing(L, v, a)[0]
    return {
        "no-triangle": to_top(t, L, a, v),
        "always-a-triangle": to_top(t, L, a, np.sqrt(L * a)),
        "triangle-too-late": to_top(t, L, a, np.sqrt(L * a) if v**2 > 2 * L * a else v),
        "triangle-too-soon": to_top(t, L, a, np.sqrt(L * a) if L * a < 2 * v**2 else v),
        "ramps-take-no-time": profile(t, L, a, top, L / top),
    }


for lower in (
    lambda L, v, a, top: min(v, top),
    lambda L, v, a, top: top if v**2 > L * a else v,  # where the way is too short
):

    @row.wrongs
    def _(t, L, v, a, lower=lower):
        """triangle-too-high: half of the triangle is for braking, so its height is not
          sqrt(2 L a) => the triangle with sqrt(2 L a)
        triangle-too-low: the triangle's height is not sqrt(L a / 2): its area has to be
          L => the triangle with sqrt(L a / 2)
        triangle-not-a-root: the triangle's height is the root of L a; L a itself is the
          square of a speed => the triangle with L a
        """
        tops = {
            "triangle-too-high": np.sqrt(2 * L * a),
            "triangle-too-low": np.sqrt(L * a / 2),
            "triangle-not-a-root": L * a,
        }
        return {
            slug: to_top(t, L, a, lower(L, v, a, top)) for slug, top in tops.items()
        }


@row.wrongs
def _(t, L, v, a):
    """braking-overshoots: the last piece comes from beyond the end: what is left has to
      be taken off L => the profile with a plus in the last piece
    half-forgotten: the way of a ramp is a t^2 / 2, not a t^2 => the profile with a t^2
    ramps-way-forgotten: the cruise starts at 0; it has to start where the ramp ended
    ramp-at-full-speed: the cruise counts the ramp as if it had been at full speed all
      the time => the cruise with v t
    """
    top, ramp, T = timing(L, v, a)
    starts = 0 < t < ramp
    cruises = ramp <= t < T - ramp
    brakes = T - ramp <= t < T
    up = starts * a * t**2 / 2
    down = brakes * a * (T - t) ** 2 / 2
    behind = cruises * top * ramp / 2
    farther = {
        "braking-overshoots": 2 * down,
        "half-forgotten": up - down,
        "ramps-way-forgotten": -behind,
        "ramp-at-full-speed": behind,
    }
    right = trapezoidal_profile(t, L, v, a)
    return {slug: right + np.array([way, 0.0, 0.0]) for slug, way in farther.items()}


@row.wrongs
def _(t, L, v, a):
    """both-ramps-added: the duration is one ramp's time, v / a, too long: compared with
      full speed, each ramp costs only half of its own time => the profile with the
      duration L / v + 2 v / a
    braking-accelerates: while it slows down the acceleration is negative => the profile
      with +a at the end
    half-forgotten: in the first piece, the way of a ramp is a t^2 / 2, not a t^2
    does-not-stop: after the end it goes on with -a, backwards
    does-not-wait: before the start it is on the ramp already
    does-not-wait-or-stop: before the start and after the end the ramps go on
    order: the order is position, speed, acceleration; here it runs backwards
    """
    top, ramp, T = timing(L, v, a)
    left = T - t
    right = trapezoidal_profile(t, L, v, a)
    up = np.array([a * t**2 / 2, a * t, a])
    down = np.array([L - a * left**2 / 2, a * left, -a])
    stops = down if left <= 0 else right
    return {
        "both-ramps-added": profile(t, L, a, top, T + ramp),
        "braking-accelerates": np.append(right[:2], abs(right[2])),
        "half-forgotten": up * [2.0, 1.0, 1.0] if 0 < t < ramp else right,
        "does-not-stop": stops,
        "does-not-wait": up if t <= 0 else right,
        "does-not-wait-or-stop": up if t <= 0 else stops,
        "order": right[::-1],
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
    L="a length",
    v="a top speed",
    a="a size",
    t="before 0 it stands at its start, as at 0",
)
for move in ("a * t ** 2 / 2, a * t, a", "top * (t - ramp / 2), top, 0.0"):
    for sign in (
        f"np.abs((np.array([{move}])))",
        f"np.maximum((np.array([{move}])), 0)",
    ):
        row.same(f"return {sign}", "before the brake none of the three is negative")


row.spans(  # as small, or as large, as in the lab
    t=(10.0,),
    L=(0.01,),
    v=(0.1,),
    a=(10.0,),
)
