"""11.1 `closest_points_segments(a0, a1, b0, b1)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Points, Row
from robo47.distance import closest_points_segments

from . import pairs
from .bowl import bowl, cut, ends_only, lines, thrice

# Of what has more than one closest pair any is right: it is judged by being one.
row = Row(
    Points((2, 3), names=("first's point", "second's point")),
    at_edge=pairs.crosses,
    each_case=150,
    copies=False,  # an end itself is as good as a copy of it
    held_out=[
        HeldOut(
            "parallel-not-handled",
            "Your result is wrong for some parallel segments. For parallel segments, "
            "`a c - b b` is 0, so the formula for s gives 0 / 0. Start with any s in "
            "[0, 1] instead. Then compute and clamp t, and finally compute and clamp "
            "s.",
            lambda rng: pairs.arrays(pairs.PARALLEL),
        ),
        HeldOut(
            "side-by-side-not-handled",
            "Your result is wrong for parallel segments that lie side by side. Such "
            "segments have many closest pairs, so return any one of these pairs.",
            lambda rng: pairs.arrays(pairs.ALONGSIDE),
        ),
        HeldOut(
            "nearly-parallel",
            "Your result is wrong for segments that are half a degree from parallel. "
            "Such segments have a single closest pair. Does your code compare "
            "`a c - b b` with too large a fraction of `a c`?",
            lambda rng: pairs.arrays(pairs.NEARLY_PARALLEL),
        ),
        HeldOut(
            "point-not-handled",
            "Your result is wrong if the length of a segment is 0. For that segment, "
            "use any parameter in [0, 1] instead of 0 / 0. Clamp the parameter of the "
            "other segment.",
            lambda rng: pairs.arrays(pairs.POINTS),
        ),
        HeldOut(
            "size-absolute",
            "Your result is correct for segments of about 1 m, but not for segments "
            "of a few millimetres. Compare `a c - b b` with a fraction of `a c`, not "
            "with a constant, because the unit of `a c - b b` is m^4.",
            lambda rng: [
                tuple(0.002 * x for x in pairs.segments(rng, one))
                for one in ("inside", "an end", "inside", "an end")
            ],
            near=1e-7,
        ),
    ],
)

row.valid(pairs.closest)
row.cases(pairs.PLACES)
row.rare(pairs.seldom)


@row.inputs
def _(rng):
    case = ((-1, 0, 0), (1, 0, 0), (0, -1, 1), (0, 1, 1))
    ends = ((0, 0, 0), (1, 0, 0), (2, 1, 0), (1, 2, 0))
    hardly = ((-1, 0, 0), (1, 0, 0), (-1, -0.1, 1), (1, 0.15, 1))  # 7 degrees
    drawn = [pairs.segments(rng, one) for one in 6 * pairs.KINDS]
    return [*pairs.arrays([case, ends, hardly]), *drawn]


@row.wrongs
def _(a0, a1, b0, b1):
    """not-clamped: your code does not clamp s and t. Clamp s, then recompute and clamp
      t, and finally recompute and clamp s, because otherwise the points can lie outside
      the segments
    clamped-apart: your code clamps s and t independently. If one parameter is clamped,
      the optimal value of the other can change. Clamp s, then recompute and clamp t,
      and finally recompute and clamp s
    s-not-again: if t is clamped, your s may not be the optimal value for this t.
      Recompute s after t is clamped, because the optimal s depends on t
    s-not-again 2: if s is clamped, your t may not be the optimal value for this s.
      Recompute t after s is clamped, because the optimal t depends on s
    s-not-again 3: your t may not be the optimal value for your s. Recompute t after the
      last change of s, because the optimal t depends on s
    t-not-cut: your code does not clamp t. Clamp t to [0, 1], because otherwise the
      second point can lie outside its segment
    s-not-cut: your code does not clamp s. Clamp s to [0, 1], because otherwise the
      first point can lie outside its segment
    cut-below-only: your code clamps s and t at 0, but not at 1. Clamp both to [0, 1],
      because otherwise the points can lie beyond `a1` and `b1`
    cut-above-only: your code clamps s and t at 1, but not at 0. Clamp both to [0, 1],
      because otherwise the points can lie before `a0` and `b0`
    ends-only: your code assumes that one of the closest points is an endpoint of a
      segment. If s and t for the infinite lines both lie in [0, 1], use these values
      instead
    end-pairs: your code returns the closest pair of endpoints. Compute s and t instead,
      because the closest points can lie between the endpoints
    end-pairs 2: your code assumes that the closest point of the first segment is an
      endpoint. Compute s instead, because this point can lie between the endpoints
    w-sign: your code uses the vector between the start points with the wrong sign. In
      `s = (b e - c d) / (a c - b b)`, d is u . w and e is v . w with `w = a0 - b0`
    d-and-e-swapped: your code swaps the dot products of w with u and v. In `s = (b e -
      c d) / (a c - b b)`, d is u . w and e is v . w
    numerator-sign: your code negates s for the infinite lines. The correct value is `(b
      e - c d) / (a c - b b)` with `w = a0 - b0`
    b-sign: your code uses b = u . v with the wrong sign. At the minimum, `a s - b t + d
      = 0` and `b s - c t + e = 0`
    across-plus: your code divides by `a c + b b`. Divide by the determinant `a c - b b`
      instead
    across-of-lengths: your code divides by `a c`, which is correct only for
      perpendicular segments. Divide by `a c - b b` instead
    swapped-to-s: your code swaps s and t. The parameter s belongs to the first segment,
      and t to the second
    points-swapped: your code returns the point of the second segment first. Return the
      point of the first segment first
    middles: your code returns the midpoints of the segments. Compute s and t instead,
      because the closest points can be anywhere on the segments
    starts: your code returns the start points of the segments. Compute s and t instead,
      because the closest points can be anywhere on the segments
    same-share: your code sets t equal to s. Compute t separately, because each segment
      has its own parameter
    shares: your code returns only the displacements s u and t v from the start points.
      Add `a0` to s u and `b0` to t v
    beyond-the-ends: your code adds s u to `a1` and t v to `b1`. Add s u to `a0` and t v
      to `b0` instead
    t-from-the-end: your code subtracts t v from `b1`. Add t v to `b0` instead, because
      t is 0 at the start of the segment
    s-from-the-end: your code subtracts s u from `a1`. Add s u to `a0` instead, because
      s is 0 at the start of the segment
    unit-directions: your code treats each segment as 1 m long. If u and v are unit
      vectors, the upper limits of s and t should be the lengths of the segments and not
      1
    nearest-to-the-middle: your code returns the midpoint of the second segment and the
      point of the first segment that is nearest to this midpoint. Compute t as well,
      because the closest point can be anywhere on the second segment
    sampled: your code tests only some points of each segment. Compute s and t instead,
      because the closest points can lie between the tested points
    sampled 2: your code tests only some points of each segment. Compute s and t
      instead, because the closest points can lie between the tested points
    sampled 3: your code tests only some points of each segment. Compute s and t
      instead, because the closest points can lie between the tested points
    ends-where-cut: your code returns the closest pair of endpoints if the closest
      points of the lines are not both on the segments. Clamp s instead, then recompute
      and clamp t, and finally recompute and clamp s
    ends-where-cut 2: your code tests only the endpoints of the first segment if the
      closest points of the lines are not both on the segments. Test the endpoints of
      the second segment too
    ends-where-cut 3: your code tests only the endpoints of the second segment if the
      closest points of the lines are not both on the segments. Test the endpoints of
      the first segment too
    start-where-cut: your code sets s to 0 if the closest points of the lines are not
      both on the segments. Clamp s instead, then recompute and clamp t, and finally
      recompute and clamp s
    start-where-cut 2: your code sets s to 0 if s is outside [0, 1]. Clamp s instead, so
      that a value above 1 becomes 1
    start-where-cut 3: your code sets s to 0.5 if s is outside [0, 1]. Clamp s to [0, 1]
      instead
    start-where-cut 4: your code uses 0 for each of s and t that is outside [0, 1].
      Clamp both instead, so that a value above 1 becomes 1
    one-end-cut: your code recomputes s if t is below 0, but not if t is above 1.
      Recompute s in both cases
    one-end-cut 2: your code recomputes s if t is above 1, but not if t is below 0.
      Recompute s in both cases
    t-one-end-cut: your code clamps t at 1, but not at 0. Clamp t to [0, 1], because
      otherwise the second point can lie before `b0`
    t-one-end-cut 2: your code clamps t at 0, but not at 1. Clamp t to [0, 1], because
      otherwise the second point can lie beyond `b1`
    a-start-alone: your code returns the start point of the first segment and the point
      of the second segment that is nearest to this start point. Compute s as well,
      because the closest point can be anywhere on the first segment
    a-middle-alone: your code returns the midpoint of the first segment and the point of
      the second segment that is nearest to this midpoint. Compute s as well, because
      the closest point can be anywhere on the first segment
    farthest: your code selects the candidate pair with the largest distance. Select the
      pair with the smallest distance instead
    one-round: your code finds the point of the second segment nearest to `a0`, and then
      the point of the first segment nearest to that point. A single iteration does not
      always reach the minimum, so start with s for the infinite lines, clamped to [0,
      1]
    one-round 2: your code finds the point of the second segment nearest to the midpoint
      of the first, and then the point of the first segment nearest to that point. A
      single iteration does not always reach the minimum, so start with s for the
      infinite lines, clamped to [0, 1]
    difference: your code returns the difference between the two points in both rows.
      Return the points themselves instead
    """
    u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
    right = thrice(a, b, c, d, e)
    plain = lines(a, b, c, d, e)

    def at(s, t):
        return np.array([a0 + s * u, b0 + t * v])

    def other_w():
        *_, d2, e2 = bowl(a0, a1, b0, b1, b0 - a0)
        return at(*thrice(a, b, c, d2, e2))

    def through(across):
        return at(*thrice(a, b, c, d, e, (b * e - c * d) / across))

    def sampled(n):
        some = np.linspace(0, 1, n)
        p = a0 + some[:, None] * u
        o = b0 + some[:, None] * v
        far = np.linalg.norm(p[:, None] - o, axis=-1)
        i, j = np.unravel_index(np.argmin(far), far.shape)
        return np.array([p[i], o[j]])

    def with_cut(cut):
        t = cut((b * cut(plain[0]) + e) / c)
        return at(cut((b * t - d) / a), t)

    def units():
        x, y = u / np.sqrt(a), v / np.sqrt(c)
        w = a0 - b0
        s, t = thrice(1.0, x @ y, 1.0, x @ w, y @ w)
        return np.array([a0 + s * x, b0 + t * y])

    def one_round(s):
        t = cut((b * s + e) / c)
        return at(cut((b * t - d) / a), t)

    s1 = cut(plain[0])
    t1 = cut((b * s1 + e) / c)
    t2 = cut(plain[1])
    first_end = min((a0, a1), key=lambda p: np.linalg.norm(
        p - b0 - cut((p - b0) @ v / c) * v))  # fmt: skip
    pairs_of_ends = [np.array([p, o]) for p in (a0, a1) for o in (b0, b1)]
    middle = (b0 + b1) / 2
    p, o = at(*right)
    t_far = (b * s1 + e) / c
    s2 = cut((b * t2 - d) / a)
    inner = 0 <= plain[0] <= 1 and 0 <= plain[1] <= 1

    def else_of(some):
        if inner:
            return at(*plain)
        return min(some, key=lambda x: np.linalg.norm(x[0] - x[1]))

    def best_t(s):
        return at(s, cut((b * s + e) / c))

    def best_s(t):
        return at(cut((b * t - d) / a), t)

    def from_s(s):
        t = cut((b * s + e) / c)
        return at(cut((b * t - d) / a), t)

    firsts = [best_t(0.0), best_t(1.0)]
    seconds = [best_s(0.0), best_s(1.0)]
    t_cut = (b * (plain[0] if 0 <= plain[0] <= 1 else 0.0) + e) / c
    every = [*firsts, *seconds, at(s1, t2)]
    return {
        "ends-where-cut": lambda: else_of(pairs_of_ends),
        "ends-where-cut 2": lambda: else_of(firsts),
        "ends-where-cut 3": lambda: else_of(seconds),
        "start-where-cut": lambda: at(*plain) if inner else best_t(0.0),
        "start-where-cut 2": lambda: from_s(plain[0] if 0 <= plain[0] <= 1 else 0.0),
        "start-where-cut 3": lambda: from_s(plain[0] if 0 <= plain[0] <= 1 else 0.5),
        "start-where-cut 4": lambda: best_s(t_cut if 0 <= t_cut <= 1 else 0.0),
        "one-end-cut": lambda: best_s(0.0) if t_far < 0 else at(s1, t1),
        "one-end-cut 2": lambda: best_s(1.0) if t_far > 1 else at(s1, t1),
        "t-one-end-cut": lambda: best_s(min(t_far, 1.0)),
        "t-one-end-cut 2": lambda: best_s(max(t_far, 0.0)),
        "a-start-alone": firsts[0],
        "a-middle-alone": lambda: best_t(0.5),
        "farthest": lambda: max(every, key=lambda x: np.linalg.norm(x[0] - x[1])),
        "not-clamped": lambda: at(*plain),
        "clamped-apart": lambda: at(s1, t2),
        "s-not-again": lambda: at(s1, t1),
        "s-not-again 2": lambda: at(s2, t2),
        "s-not-again 3": lambda: at(cut((b * cut((b * s2 + e) / c) - d) / a), t2),
        "t-not-cut": lambda: at(cut((b * t_far - d) / a), t_far),
        "s-not-cut": lambda: at((b * cut((b * plain[0] + e) / c) - d) / a,
                        cut((b * plain[0] + e) / c)),
        "cut-below-only": lambda: with_cut(lambda x: max(x, 0.0)),
        "cut-above-only": lambda: with_cut(lambda x: min(x, 1.0)),
        "ends-only": lambda: ends_only(a0, a1, b0, b1),
        "end-pairs": lambda: (
            min(pairs_of_ends, key=lambda x: np.linalg.norm(x[0] - x[1]))
        ),
        "end-pairs 2": lambda: (
            np.array([first_end, b0 + cut((first_end - b0) @ v / c) * v])
        ),
        "w-sign": other_w,
        "d-and-e-swapped": lambda: at(*thrice(a, b, c, e, d)),
        "numerator-sign": lambda: at(*thrice(a, b, c, d, e, -plain[0])),
        "b-sign": lambda: at(*thrice(a, -b, c, d, e)),
        "across-plus": lambda: through(a * c + b * b),
        "across-of-lengths": lambda: through(a * c),
        "swapped-to-s": lambda: at(right[1], right[0]),
        "points-swapped": lambda: np.array([o, p]),
        "middles": lambda: np.array([(a0 + a1) / 2, middle]),
        "starts": lambda: np.array([a0, b0]),
        "same-share": lambda: at(right[0], right[0]),
        "shares": lambda: np.array([right[0] * u, right[1] * v]),
        "beyond-the-ends": lambda: np.array([p + u, o + v]),
        "t-from-the-end": lambda: np.array([p, b1 - right[1] * v]),
        "s-from-the-end": lambda: np.array([a1 - right[0] * u, o]),
        "unit-directions": units,
        "nearest-to-the-middle": lambda: np.array(
            [a0 + cut((middle - a0) @ u / a) * u, middle]),
        "sampled": lambda: sampled(11),
        "sampled 2": lambda: sampled(101),
        "sampled 3": lambda: sampled(21),
        "one-round": lambda: one_round(0.0),
        "one-round 2": lambda: one_round(0.5),
        "difference": lambda: np.array([p - o, p - o]),
    }  # fmt: skip


@row.wrong("parallel-not-handled")  # It divides all the same.
def _(a0, a1, b0, b1):
    u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
    with np.errstate(all="ignore"):
        s, t = thrice(a, b, c, d, e)
    return np.array([a0 + s * u, b0 + t * v])


@row.wrong("parallel-not-handled", hidden="their distance is right, side by side")
def _(a0, a1, b0, b1):  # Both begin at their starts there.
    u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
    if a * c - b * b <= 1e-12 * a * c:
        return np.array([a0, b0 + (cut(e / c) if c else 0.0) * v])
    s, t = thrice(a, b, c, d, e)
    return np.array([a0 + s * u, b0 + t * v])


@row.wrong("side-by-side-not-handled", hidden="a lab's links are hardly parallel")
def _(a0, a1, b0, b1):  # Public code: parallel ones have no pair where they overlap.
    u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
    if a > 0 and c > 0 and a * c - b * b <= 1e-12 * a * c:
        ends = sorted([float((x - a0) @ u / a) for x in (b0, b1)])
        if ends[1] > 0 and ends[0] < 1:
            return None, None
    s, t = thrice(a, b, c, d, e, *([0.0] if a * c - b * b <= 1e-12 * a * c else []))
    return np.array([a0 + s * u, b0 + t * v])


@row.wrong("point-not-handled")  # Parallel is asked for, a length of 0 is not.
def _(a0, a1, b0, b1):
    u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
    with np.errstate(all="ignore"):
        across = a * c - b * b
        start = 0.0 if across <= 1e-12 * a * c else (b * e - c * d) / across
        s, t = thrice(a, b, c, d, e, start)
    return np.array([a0 + s * u, b0 + t * v])


@row.wrong("size-absolute")
def _(a0, a1, b0, b1):  # 1e-6 metres to the fourth power.
    u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
    across = a * c - b * b
    s = cut((b * e - c * d) / across) if across > 1e-6 else 0.0
    t = cut((b * s + e) / c) if c else 0.0
    s = cut((b * t - d) / a) if a else 0.0
    return np.array([a0 + s * u, b0 + t * v])


def least_angle(share):
    """Return the way that takes for parallel what has less than this sin^2."""

    def code(a0, a1, b0, b1):
        u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
        across = a * c - b * b
        start = (b * e - c * d) / across if across > share * a * c else 0.0
        s = cut(start)
        t = cut((b * s + e) / c) if c else 0.0
        s = cut((b * t - d) / a) if a else 0.0
        return np.array([a0 + s * u, b0 + t * v])

    return code


ALIKE = (
    "your code treats segments at an angle of a few degrees as parallel. Use a much "
    "smaller limit, because such segments have a single closest pair"
)
SELDOM = "hardly a pair in a run is so nearly parallel"
row.wrong("nearly-parallel", hidden=SELDOM)(least_angle(1e-3))
for share in (0.02, 0.05, 0.1):
    what = f"a limit of {share:g} a c for a c - b b"
    row.wrong("nearly-parallel", ALIKE, hidden=SELDOM)(least_angle(share))


def rounds(n, start):
    """Return the way to find t and s in turn n times, from a start of s."""

    def code(a0, a1, b0, b1):
        u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
        s, t = start, 0.0
        for _ in range(n):
            t = cut((b * s + e) / c)
            s = cut((b * t - d) / a)
        return np.array([a0 + s * u, b0 + t * v])

    return code


FEW = (
    "your code computes t and s alternately, but it stops too early. Start with s for "
    "the infinite lines, clamped to [0, 1], because one iteration is then enough"
)
for n in (2, 3, 4, 5, 10):
    for start in (0.0, 0.5):
        row.wrong("few-rounds", FEW)(rounds(n, start))


@row.right  # The inner pair if it is one, else the nearest of four ends.
def _(a0, a1, b0, b1):
    u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
    if a * c - b * b > 1e-12 * a * c:
        s, t = lines(a, b, c, d, e)
        if 0 <= s <= 1 and 0 <= t <= 1:
            return np.array([a0 + s * u, b0 + t * v])
    found = []
    for p, x, way, first in (
        (a0, b0, v, True), (a1, b0, v, True), (b0, a0, u, False), (b1, a0, u, False)
    ):  # fmt: skip
        size = way @ way
        q = x + (cut((p - x) @ way / size) if size else 0.0) * way
        found.append(np.array([p, q] if first else [q, p]))
    return min(found, key=lambda pair: np.linalg.norm(pair[0] - pair[1]))


INNER = "s = np.clip((b * e - c * d) / across, 0, 1) if across > {} else {}"
GIVEN = INNER.format("1e-12 * a * c", "0.0")
for bound, start in (
    ("0.5 * (1e-12 * a * c)", "0.0"), ("10.0 * (1e-12 * a * c)", "0.0"),
    ("2e-12 * a * c", "0.0"), ("1e-12 * a * c", "1"),
):  # fmt: skip
    row.same(f"{GIVEN} => {INNER.format(bound, start)}", "parallel: any s will do")
for name, over in (("t", "(b * s + e) / c"), ("s", "(b * t - d) / a")):
    line = f"{name} = np.clip({over}, 0, 1) if {over[-1]} > 0 else "
    row.same(f"{line}0.0 => {line}1", "a point: any share is it")


@row.right  # By the four sides and the inside; an end comes back as it is.
def _(a0, a1, b0, b1):
    def nearest(x, start, end):
        along = end - start
        size = along @ along
        at = (x - start) @ along / size if size else 0.0
        return start if at <= 0 else end if at >= 1 else start + at * along

    some = [(x, nearest(x, b0, b1)) for x in (a0, a1)]
    some += [(nearest(x, a0, a1), x) for x in (b1, b0)]
    u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
    if (across := a * c - b * b) > 1e-12 * a * c:
        s, t = (b * e - c * d) / across, (a * e - b * d) / across
        if 0 < s < 1 and 0 < t < 1:
            some.append((a0 + s * u, b0 + t * v))
    return min(some, key=lambda pair: np.linalg.norm(pair[0] - pair[1]))


@row.right  # Side by side: the middle of what lies beside the other.
def _(a0, a1, b0, b1):
    u, v, a, b, c, d, e = bowl(a0, a1, b0, b1)
    if a > 0 and c > 0 and a * c - b * b <= 1e-12 * a * c:
        s = np.mean(np.clip([(x - a0) @ u / a for x in (b0, b1)], 0, 1))
        t = cut((b * s + e) / c)
        return np.array([a0 + cut((b * t - d) / a) * u, b0 + t * v])
    return np.array(closest_points_segments(a0, a1, b0, b1))
