"""12.2 `segment_free_of_discs(a, b, discs)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Mask, Row
from labkit.judge.answers import once
from robo47.planning import segment_free_of_discs

from .ways import DISC, NONE, clear, discs, usual

# An edge that touches, but for rounding, is nobody's question.
row = Row(Mask(), at_edge=clear, each_case=150)


def typed(rng, kind):
    """Return a, b and discs of one kind of question, clear of touching."""
    while True:
        some = discs(rng, 3)
        x, y, r = some[rng.integers(3)]
        turn = rng.uniform(0, 2 * np.pi)
        along = np.array([np.cos(turn), np.sin(turn)])
        across = np.array([-along[1], along[0]])
        at, off, ends = {
            "through": (0.0, 0.5, (-1.2, 1.0)),
            "grazed": (0.0, 0.93, (-1.2, 1.0)),
            "beside": (0.0, 1.1, (-1.0, 1.2)),
            "behind": (0.0, 0.4, (-1.5, -0.6)),
            "before": (0.0, 0.4, (0.6, 1.5)),
            "begins": (0.0, 0.3, (0.0, 1.5)),
            "ends": (0.0, 0.3, (-1.5, 0.0)),
            "within": (0.0, 0.2, (-0.1, 0.1)),
        }[kind]
        side = 1 if rng.uniform(0, 1) < 0.5 else -1
        middle = np.array([x, y]) + at + side * off * r * across
        a, b = (np.round(middle + end * along, 3) for end in ends)
        alone = some[(some[:, 0] == x) & (some[:, 1] == y)]
        hit = kind not in ("beside", "behind", "before")
        told = segment_free_of_discs(a, b, some), segment_free_of_discs(a, b, alone)
        if told == (not hit, not hit) and clear(a, b, some):
            return a, b, some


@once  # each of the cases asks it
def seen(a, b, discs):
    """Return what an edge is, by the first of these that it is."""
    if not len(discs):
        return "no disc"
    square = (b - a) @ (b - a) or 1.0
    part = np.clip((discs[:, :2] - a) @ (b - a) / square, 0, 1)
    foot = a + part[:, None] * (b - a)
    gaps = np.linalg.norm(discs[:, :2] - foot, axis=1) - discs[:, 2]
    if abs(gaps.min()) < 1e-9:
        return "touches"
    if not np.any(b - a):
        return "point"
    away = np.linalg.norm(np.array([a, b])[:, None] - discs[:, :2], axis=2)
    if gaps.min() < 0:
        return "end" if np.any(away <= discs[:, 2]) else "between"
    near = np.any(gaps < discs[:, 2])
    return "near" if near else "far"


def edges(*kinds):
    """Return the case of edges of these kinds."""
    return lambda *call: seen(*call) in kinds


row.cases({
    "edges that start or end in a disc": edges("end"),
    "edges that cross a disc between their endpoints": edges("between"),
    "edges that touch a disc": edges("touches"),
    "free edges near a disc": edges("near"),
    "free edges far from every disc": edges("far"),
    "edges of length 0 that touch no disc": edges("point"),
    "worlds without a disc": edges("no disc"),
})  # fmt: skip
row.cases({
    "edges that are free": lambda *call: segment_free_of_discs(*call),
    "edges that are not free": lambda *call: not segment_free_of_discs(*call),
})  # fmt: skip
row.cases({
    "worlds with one disc": lambda a, b, discs: len(discs) == 1,
    "worlds with several discs": lambda a, b, discs: len(discs) > 1,
    "worlds without a disc": lambda a, b, discs: not len(discs),
})  # fmt: skip


@row.rare
def _(rng):
    for kind in ("through", "grazed", "beside", "behind", "begins", "ends", "within"):
        a, b, some = typed(usual(rng), kind)
        yield a, b, some
        share = float(rng.choice([0.1, 0.3, 8.0]))  # the same world in another size
        yield share * a, share * b, share * some
    yield a, a.copy(), some
    yield a, b, NONE
    size = float(rng.choice([8.0, 1.0, 1 / 8, 1 / 64]))  # it touches exactly
    x, y, r = size * (rng.integers(-4, 5, 3) / 4.0 + [0, 0, 1.5])
    start, end = np.array([[x - 2, y + r], [x + 2, y + r]])
    yield start, end, np.array([[x, y, r]])
    yield np.array([x, y + r]), np.array([x, y + r]), np.array([[x, y, r]])
    yield a, b + 4.0, discs(rng, 1)


@row.inputs
def _(rng):
    yield np.zeros(2), np.array([2.0, 0]), DISC
    yield np.array([0.0, 0.6]), np.array([2.0, 0.6]), DISC
    yield np.array([0.0, 1]), np.array([0.4, 1]), DISC
    yield np.array([0.0, 1.5]), np.array([2.0, 1.5]), DISC  # it touches
    yield np.array([1.0, 0]), np.array([1.0, 0.5]), DISC  # its end touches
    yield np.array([0.5, 1]), np.array([0.0, 1]), DISC  # its start touches
    yield np.array([0.0, 1]), np.array([2.0, 1]), NONE
    yield np.array([1.0, 1.25]), np.array([1.0, 1.25]), DISC
    yield np.array([1.0, 2]), np.array([1.0, 2]), DISC
    yield np.array([0.0, 0]), np.array([2.0, 0]), np.array([[1, 0.1, 0.01]])
    yield np.array([0.0, 0]), np.array([2.0, 0]), np.array([[1, 0.001, 0.01]])
    # Between the points of whoever looks at a thousand of them.
    yield np.array([0.0, 0]), np.array([2.0, 0]), np.array([[0.713, 0.0002, 0.0003]])
    yield np.array([0.0, 0]), np.array([9.0, 0]), np.array([[2, 1.5, 2.0]])  # large
    yield np.array([0.0, 0]), np.array([9.0, 0]), np.array([[2, 2.5, 2.0]])
    yield np.array([0.0, 0]), np.array([1.1, 0]), np.array([[0.5, 0, 0.2]])
    for x in (-3.0, 4.0):  # on the line, far off the edge
        yield np.zeros(2), np.array([1.0, 0]), np.array([[x, 0, 0.5]])
    two = np.array([[5.0, 5, 1], [1, 0, 0.5]])
    yield np.array([0.0, 0]), np.array([2.0, 0]), two
    yield np.array([0.0, 0]), np.array([2.0, 0]), two[::-1]
    # The nearest centre is that of a small disc; a large one behind it is hit.
    yield np.array([0.0, 0]), np.array([2.0, 0]), np.array([[1, 0.5, 0.1], [1, -1, 2]])
    kinds = ("beside", "through", "behind", "grazed", "before", "begins", "beside",
             "ends", "behind", "within", "before", "grazed")  # fmt: skip
    rng = usual(rng)
    for kind in (*kinds, *kinds):
        yield typed(rng, kind)


@row.spans
def _(rng):  # by a hair
    for hair in (5e-5, -5e-5):
        yield np.array([0.0, 1.5 + hair]), np.array([2.0, 1.5 + hair]), DISC
        yield np.array([1.0, 0.0]), np.array([1.0, 0.5 - hair]), DISC


def looked(a, b, some, cut=lambda x: np.clip(x, 0, 1), by=None, far=lambda x, r: x > r):
    """Return whether an edge is free, made in another way.

    Args:
        a, b, some: as the function has them.
        cut: what is done to the foot's share of the edge.
        by: what it is divided by; the edge's square.
        far: whether distances, and radii, are free.
    """
    along = b - a
    by = along @ along if by is None else by
    with np.errstate(all="ignore"):
        part = (some[:, :2] - a) @ along / by
    part = np.where(np.isnan(part), 0.0, part) if by == 0 else part
    foot = a + cut(part)[:, None] * along
    return bool(np.all(far(np.linalg.norm(some[:, :2] - foot, axis=1), some[:, 2])))


def at_points(a, b, some, parts):
    """Return whether some points of an edge are outside all discs."""
    points = a + np.array(parts)[:, None] * (b - a)
    away = np.linalg.norm(points[:, None] - some[:, :2], axis=2)
    return bool(np.all(away > some[:, 2]))


def _others(a, b, discs, part, away):
    """Return further mistakes of the same table, from shares and distances."""
    along, r = b - a, discs[:, 2]
    length = np.linalg.norm(along)
    unit = along / (length or 1.0)
    to = discs[:, :2] - a
    run = to @ unit
    off = np.linalg.norm(to - run[:, None] * unit, axis=1)
    meets = off <= r
    half = np.sqrt(np.maximum(r**2 - off**2, 0.0))
    first = meets & (run - half >= 0) & (run - half <= length)
    free = bool(np.all(away > r))
    low, high = np.minimum(a, b), np.maximum(a, b)
    boxes = (discs[:, :2] + r[:, None] >= low) & (discs[:, :2] - r[:, None] <= high)
    beyond = np.where(part > 1, np.linalg.norm(to, axis=1), away)
    between = (part > 0) & (part < 1)

    def at(places, way):
        return bool(np.all(np.linalg.norm(to - places[:, None] * way, axis=1) > r))

    shifted = discs[:, :2] - np.clip(part, 0, 1)[:, None] * along
    return {
        "foot-without-a": bool(np.all(np.linalg.norm(shifted, axis=1) > r)),
        "cut-to-one": at(np.clip(run, 0, 1), unit),
        "length-for-share": at(np.clip(run, 0, length), along),
        "distance-to-the-start": bool(np.all(beyond > r)),
        "first-crossing-only": not np.any(first) if length else free,
        "some-crossing": not np.any(meets) if length else False,
        "boxes-overlap": not np.any(boxes.all(axis=1)),
        "x-and-y-exchanged": segment_free_of_discs(a, b, discs[:, [1, 0, 2]]),
        "no-disc-is-hit": free and len(discs) > 0,
        "touching-between": bool(np.all((away > r) | (between & (away >= r)))),
        "points-only 7": at_points(a, b, discs, np.linspace(0, 1, 1000)),
        "points-only 8": at_points(a, b, discs, np.arange(0, 1, 0.1)),
        "points-only 9": at_points(a, b, discs, np.linspace(0, 1, 100)),
        "points-only 10": at_points(a, b, discs, np.linspace(0, 1, 50)),
    }


@row.wrongs(
    hidden={
        "points-only 5": "no disc of the lab is so thin",
        "points-only 7": "no disc of the lab is so thin",
        "points-only 9": "no disc of the lab is so thin",
        "no-disc-is-hit": "the lab has no world without discs",
        "touching-between": "no edge of the lab touches",
    }
)
def _(a, b, discs):
    """line-for-segment: your code treats the edge as an infinite line, so a disc beyond
      an endpoint can block the edge. Only points with a parameter from 0 to 1 lie on
      the edge
    only-one-end-cut: your code extends the edge beyond `a` without limit. Points with a
      parameter below 0 do not lie on the edge
    only-one-end-cut 2: your code extends the edge beyond `b` without limit. Points with
      a parameter above 1 do not lie on the edge
    ends-only: your code tests only the endpoints of the edge. Test the whole edge,
      because it can cross a disc between its endpoints
    new-end-only: your code tests only the endpoint `b`. Test the whole edge
    start-only: your code tests only the endpoint `a`. Test the whole edge
    middle-only: your code tests only the midpoint of the edge. Test the whole edge
    points-only: your code tests only some points of the edge. Use the point of the edge
      nearest to each centre instead, because a small disc can lie between two tested
      points
    points-only 2: your code tests only some points of the edge. Use the point of the
      edge nearest to each centre instead, because a small disc can lie between two
      tested points
    points-only 3: your code tests only some points of the edge. Use the point of the
      edge nearest to each centre instead, because a small disc can lie between two
      tested points
    points-only 4: your code tests only some points of the edge. Use the point of the
      edge nearest to each centre instead, because a small disc can lie between two
      tested points
    points-only 5: your code can miss discs that cover only a small part of the edge.
      Compute the point of the edge nearest to each centre exactly
    points-only 6: your code can miss discs that cover only a small part of the edge.
      Compute the point of the edge nearest to each centre exactly
    inside-is-free: your code tests only whether the edge crosses the boundary of a
      disc. Report an edge inside a disc as blocked too, because the whole disc is an
      obstacle
    inside-is-free 2: your code tests only whether the edge crosses the boundary of a
      disc. Report an edge or a point inside a disc as blocked too, because the whole
      disc is an obstacle
    inner-only: your code skips a disc if the nearest point of the infinite line lies
      beyond an endpoint of the edge. Use the distance from the centre to this endpoint,
      because the endpoint can lie in the disc
    inner-only 2: for an edge of nonzero length, your code skips a disc if the nearest
      point of the infinite line lies beyond an endpoint. Use the distance from the
      centre to this endpoint, because the endpoint can lie in the disc
    first-disc-only: your code tests only the first disc. Test every disc, because the
      edge must miss all of them
    last-disc-only: your code tests only the last disc. Test every disc. In a loop, keep
      the results of the earlier discs
    nearest-centre: your code tests only the disc whose centre is nearest to the edge.
      Test every disc, because a disc farther away can be larger
    all-must-hit: your code reports the edge as free as soon as it misses one disc.
      Report it as free only if it misses every disc
    all-must-hit 2: your code reports the edge as free if it misses at least one disc,
      and as blocked if there are no discs. Report the edge as free if it misses every
      disc or if there are no discs
    squared-for-plain: your code compares the squared distance with the radius. Compare
      it with the squared radius instead
    plain-for-squared: your code compares the distance with the squared radius. Compare
      it with the radius instead
    diameter: your code compares the distance with twice the radius. Compare it with the
      radius itself, which is the third entry of the disc's row
    half-the-radius: your code compares the distance with half of the radius. Compare it
      with the radius itself, which is the third entry of the disc's row
    radius-forgotten: your code omits the radius, so it treats the discs as points.
      Compare the distance with the radius
    not-divided: your code does not divide the parameter of the nearest point by the
      squared length of the edge. Divide it, so that the parameter is 1 at `b`
    divided-by-the-length: your code divides the parameter of the nearest point by the
      length of the edge. Divide it by the squared length instead
    touching-is-free: your code reports an edge that touches a disc as free. Report such
      an edge as blocked
    from-the-origin: your code projects the centre onto the edge without first
      subtracting `a`. Subtract `a` from the centre, because the edge begins at `a`
    other-way: your code measures the parameter from one endpoint of the edge, but it
      applies the parameter from the other endpoint. Use the same endpoint in both steps
    box: your code compares each coordinate difference with the radius separately. Use
      the Euclidean distance instead
    foot-without-a: your code computes the nearest point relative to `a`, but it does
      not add `a`. Add `a` before you subtract this point from the centre
    cut-to-one: your code clamps the distance along the edge to [0, 1]. Clamp it to the
      range from 0 to the length of the edge instead
    length-for-share: your code multiplies the distance along the edge by `b - a`.
      Multiply this distance by the unit vector of the edge instead
    distance-to-the-start: for a disc beyond `b`, your code uses the distance to `a`.
      Use the distance to `b` instead, because `b` is the nearest point of the edge
    first-crossing-only: your code tests only the first intersection of the line with
      the boundary of the disc. Test whether `a` lies in the disc too, because an edge
      that starts in the disc does not contain this intersection
    some-crossing: your code tests whether the infinite line meets the disc. Use the
      nearest point of the edge instead, because both intersections can lie beyond an
      endpoint
    boxes-overlap: your code tests whether the bounding boxes of the edge and the disc
      overlap. Use the distance instead, because the boxes can overlap even if the edge
      misses the disc
    x-and-y-exchanged: your code swaps the x and y coordinates of the centres. Each disc
      is (x, y, radius)
    no-disc-is-hit: your code reports the edge as blocked if there are no discs. Report
      the edge as free in this case
    touching-between: if an edge touches a disc between its endpoints, your code reports
      the edge as free. Report such an edge as blocked
    points-only 7: your code can miss discs that cover only a small part of the edge.
      Compute the point of the edge nearest to each centre exactly
    points-only 8: your code tests only some points of the edge. Use the point of the
      edge nearest to each centre instead, because a small disc can lie between two
      tested points
    points-only 9: your code can miss discs that cover only a small part of the edge.
      Compute the point of the edge nearest to each centre exactly
    points-only 10: your code can miss discs that cover only a small part of the edge.
      Compute the point of the edge nearest to each centre exactly
    """
    along = b - a
    square = along @ along
    point = square == 0.0
    length = np.sqrt(square)
    with np.errstate(all="ignore"):
        part = (discs[:, :2] - a) @ along / (square or 1.0)
    inside = (part > 0) & (part < 1)
    raw = discs[:, :2] @ along / (square or 1.0)
    foot = a + np.clip(part, 0, 1)[:, None] * along
    away = np.linalg.norm(discs[:, :2] - foot, axis=1)
    origin = a + np.clip(raw, 0, 1)[:, None] * along
    back = b + np.clip(part, 0, 1)[:, None] * (a - b)
    r = discs[:, 2]
    many = len(discs) > 0
    ends = [np.linalg.norm(discs[:, :2] - x, axis=1) < r for x in (a, b)]
    held = ends[0] & ends[1]
    return {
        "line-for-segment": looked(a, b, discs, cut=lambda x: x),
        "only-one-end-cut": looked(a, b, discs, cut=lambda x: np.minimum(x, 1)),
        "only-one-end-cut 2": looked(a, b, discs, cut=lambda x: np.maximum(x, 0)),
        "ends-only": at_points(a, b, discs, [0, 1]),
        "new-end-only": at_points(a, b, discs, [1]),
        "start-only": at_points(a, b, discs, [0]),
        "middle-only": at_points(a, b, discs, [0.5]),
        "points-only": at_points(a, b, discs, np.linspace(0, 1, 10)),
        "points-only 2": at_points(a, b, discs, np.linspace(0, 1, 5)),
        "points-only 3": at_points(a, b, discs, np.linspace(0, 1, 20)),
        "points-only 4": at_points(a, b, discs, np.linspace(0, 1, 11)),
        "points-only 5": at_points(a, b, discs, np.linspace(0, 1, 101)),
        "points-only 6": at_points(a, b, discs, np.linspace(0, 1, 200)),
        "inside-is-free": bool(np.all((away > r) | (held & (not point)))),
        "inside-is-free 2": bool(np.all((away > r) | held)),
        "inner-only": bool(np.all((away > r) | ~inside)),
        "inner-only 2": bool(
            np.all((away > r) | ~(point | ((part >= 0) & (part <= 1))))
        ),
        "first-disc-only": segment_free_of_discs(a, b, discs[:1]),
        "last-disc-only": segment_free_of_discs(a, b, discs[-1:]),
        "nearest-centre": bool(many == 0 or np.all((away > r)[np.argmin(away)])),
        "all-must-hit": bool(np.any(away > r)) or not many,
        "all-must-hit 2": bool(np.any(away > r)),
        "squared-for-plain": bool(np.all(away**2 > r)),
        "plain-for-squared": bool(np.all(away > r**2)),
        "diameter": bool(np.all(away > 2 * r)),
        "half-the-radius": bool(np.all(away > r / 2)),
        "radius-forgotten": bool(np.all(away > 0)),
        "not-divided": looked(a, b, discs, by=1.0),
        "divided-by-the-length": looked(a, b, discs, by=length if not point else 1.0),
        "touching-is-free": bool(np.all(away >= r)),
        "from-the-origin": bool(
            np.all(np.linalg.norm(discs[:, :2] - origin, axis=1) > r)
        ),
        "other-way": bool(np.all(np.linalg.norm(discs[:, :2] - back, axis=1) > r)),
        "box": bool(np.all(np.abs(discs[:, :2] - foot).max(axis=1) > r)),
        **_others(a, b, discs, part, away),
    }


@row.wrong(hidden="the lab has no edge of no length")
def divided_by_nothing(a, b, discs):
    """if there are discs, your code reports every edge of length 0 as blocked. Treat
    such an edge as a point. If its parameter is 0 / 0 = NaN, each comparison with the
    distance is False"""
    along = b - a
    with np.errstate(all="ignore"):
        part = (discs[:, :2] - a) @ along / (along @ along)
    foot = a + np.clip(part, 0, 1)[:, None] * along
    return bool(np.all(np.linalg.norm(discs[:, :2] - foot, axis=1) > discs[:, 2]))


@row.wrong("divided-by-nothing")
def _(a, b, discs):
    """your code always reports an edge of length 0 as free. Treat such an edge as a
    point. If its parameter is 0 / 0 = NaN, each comparison with the distance is
    False"""
    along = b - a
    with np.errstate(all="ignore"):
        part = (discs[:, :2] - a) @ along / (along @ along)
    foot = a + np.clip(part, 0, 1)[:, None] * along
    return not np.any(np.linalg.norm(discs[:, :2] - foot, axis=1) <= discs[:, 2])


@row.wrong
def touching_and_no_length(a, b, discs):
    """your code reports an edge that touches a disc as free, and it always reports an
    edge of length 0 as free. Report a touching edge as blocked, and treat an edge of
    length 0 as a point"""
    along = b - a
    with np.errstate(all="ignore"):
        part = (discs[:, :2] - a) @ along / (along @ along)
    foot = a + np.clip(part, 0, 1)[:, None] * along
    return not np.any(np.linalg.norm(discs[:, :2] - foot, axis=1) < discs[:, 2])


@row.wrong("too-seldom-true")
def _(a, b, discs):
    along = b - a
    share = (discs[:, :2] - a) @ along / max(along @ along, 1e-300)
    cut = np.clip(share, -0.3, 1.3)
    foot = a + np.where(np.abs(share - 0.5) < 0.5, share, cut)[:, None] * along
    return bool(np.all(np.linalg.norm(discs[:, :2] - foot, axis=1) > discs[:, 2]))


@row.right  # Disc by disc, by three cases.
def _(a, b, discs):
    length = np.linalg.norm(b - a)
    for x, y, r in discs:
        centre = np.array([x, y])
        part = (centre - a) @ (b - a)
        if length == 0 or part <= 0:
            near = np.linalg.norm(centre - a)
        elif part >= length**2:
            near = np.linalg.norm(centre - b)
        else:
            (u, v), (w, z) = b - a, centre - a
            near = abs(u * z - v * w) / length
        if near <= r:
            return False
    return True


@row.right  # Squares, compared with squares.
def _(a, b, discs):
    d = b - a
    t = np.clip((discs[:, :2] - a) @ d / max(d @ d, 1e-12), 0, 1)
    off = discs[:, :2] - a - t[:, None] * d
    return not ((off**2).sum(axis=1) <= discs[:, 2] ** 2).any()


row.same(
    "part = to_centres @ along / max(along @ along, 1e-300) => "
    "part = to_centres @ along / max(along @ along, 2e-300)",
    "it only keeps 0 / 0 away",
)
row.at_least_0(answer="a truth value")


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # A margin of 1 mm.
def _(a, b, some):
    return segment_free_of_discs(a, b, some + np.array([0, 0, 1e-3]))


row.spans(  # as small, or as large, as in the lab
    a=(lambda a: 0.007 * a,),
    b=(lambda b: 0.02 * b,),
)
