"""11.2 `capsule_distance(a0, a1, ra, b0, b1, rb)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar
from robo47.distance import capsule_distance, closest_points_segments

from . import pairs

row = Row(Scalar(unit="m"), each_case=150)


@row.inputs
def _(rng):
    case = (np.array([-1.0, 0, 0]), np.array([1.0, 0, 0]), 0.25,
            np.array([0.0, -1, 1]), np.array([0.0, 1, 1]), 0.5)  # fmt: skip
    beside = [
        (a0, a1, 0.25, b0, b1, 0.5)
        for a0, a1, b0, b1 in pairs.arrays([*pairs.ALONGSIDE, *pairs.POINTS[:3]])
    ]
    deep = []
    for _ in range(3):  # across each other, and so near that they overlap
        a0, a1, b0, b1 = pairs.segments(rng, "inside")
        p, o = closest_points_segments(a0, a1, b0, b1)
        shift = np.round(0.9 * (p - o), 3)
        ra, rb = pairs.radii(rng)
        deep.append((a0, a1, ra, b0 + shift, b1 + shift, rb))
    drawn = []
    for one in 2 * pairs.KINDS:
        a0, a1, b0, b1 = pairs.segments(rng, one)
        ra, rb = pairs.radii(rng)
        drawn.append((a0, a1, ra, b0, b1, rb))
    x, y = np.eye(3)[:2]
    crossing = (-x, x, 0.2, -y, y, 0.3)  # the axes meet
    return [case, crossing, *beside, *deep, *drawn]


def overlap(a0, a1, ra, b0, b1, rb):
    """Return whether two capsules overlap."""
    return capsule_distance(a0, a1, ra, b0, b1, rb) < 0


row.cases(
    capsules_that_overlap=overlap,
    capsules_that_do_not_overlap=lambda *call: not overlap(*call),
)
row.cases(
    {
        says.replace("segments", "axes"): (
            lambda a0, a1, ra, b0, b1, rb, holds=holds: holds(a0, a1, b0, b1)
        )
        for says, holds in pairs.PLACES.items()
    }
)


@row.rare
def _(rng):
    for a0, a1, b0, b1 in pairs.seldom(rng):
        ra, rb = pairs.radii(rng)
        yield a0, a1, ra, b0, b1, rb
        yield a0, a1, ra + 1.0, b0, b1, rb + 1.0


row.spans(
    b0=(lambda b0: b0 + 5.0,),
    ra=(1e-4, 2.0),
)


@row.spans
def _(rng):
    a0, a1, b0, b1 = pairs.segments(rng, "inside")
    far = np.array([5.0, 0, 0])
    yield a0, a1, 0.05, b0 + far, b1 + far, 0.1


@row.wrongs
def _(a0, a1, ra, b0, b1, rb):
    """radii-added: your code adds the radii to the distance between the axes. Subtract
      both radii
    radii-forgotten: your code omits the radii. Subtract both radii from the distance
      between the axes
    one-radius: your code subtracts only the radius of the first capsule. Subtract both
      radii
    one-radius 2: your code subtracts only the radius of the second capsule. Subtract
      both radii
    as-diameters: your code subtracts half of each radius. Subtract `ra` and `rb`
      themselves, because they are radii and not diameters
    twice-the-radii: your code subtracts each radius twice. Subtract each radius only
      once
    radii-differ: your code subtracts the difference between the radii. Subtract the sum
      of the radii instead
    radii-differ 2: your code subtracts the difference between the radii. Subtract the
      sum of the radii instead
    larger-radius: your code subtracts only the larger radius. Subtract both radii
    radii-multiplied: your code subtracts the product of the radii. Subtract the sum of
      the radii instead
    never-negative: your code returns 0 for capsules that overlap. The signed distance
      should be negative for such capsules
    sign-lost: your code takes the absolute value of the distance. The signed distance
      should be negative for capsules that overlap
    squared: your code omits the square root, so it uses the squared distance between
      the axes. Take the square root before you subtract the radii
    squared 2: your code subtracts the square of the sum of the radii from the squared
      distance between the axes. Subtract the radii from the distance itself
    sign: your code negates the signed distance. The signed distance should be positive
      for capsules that do not overlap
    of-middles: your code uses the midpoints of the axes as the closest points. Use the
      closest points from task 11.1, because they can be anywhere on the axes
    of-starts: your code uses the start points of the axes as the closest points. Use
      the closest points from task 11.1, because they can be anywhere on the axes
    of-end-pairs: your code uses the closest pair of endpoints as the closest points.
      Use the closest points from task 11.1, because they can lie between the endpoints
    largest-part: your code uses the largest absolute component of the vector between
      the closest points as their distance. Use the norm of this vector instead
    sum-of-parts: your code uses the sum of the absolute components of the vector
      between the closest points as their distance. Use the norm of this vector instead
    in-the-plane 2: your code omits the x component of the vector between the closest
      points. Use all three components
    in-the-plane 3: your code omits the y component of the vector between the closest
      points. Use all three components
    product-of-radii: your code subtracts the square root of the product of the radii.
      Subtract the sum of the radii instead
    squares-of-radii: your code subtracts the squares of the radii. Subtract the radii
      themselves instead
    over-the-radii: your result is the signed distance divided by the sum of the radii.
      Omit this division, because the distance should be in metres
    ends-and-middles: your code tests only the endpoints and the midpoints of both axes.
      Use the closest points from task 11.1, because they can be anywhere on the axes
    same-share: your code uses the same parameter for both axes. Use the closest points
      from task 11.1, because each of them has its own parameter
    twice-the-larger: your code subtracts the larger radius twice. Subtract the radius
      of each capsule once
    radii-as-sides: your code subtracts `sqrt(ra**2 + rb**2)`. Subtract `ra + rb`
      instead, because the two radii lie on the same line
    root-of-squares: your code returns `sqrt(d**2 - (ra + rb)**2)`, where d is the
      distance between the axes, or 0 for capsules that overlap. Return `d - (ra + rb)`
      instead
    root-of-squares 2: your code uses the square root of the absolute value of `d**2 -
      (ra + rb)**2`, where d is the distance between the axes. Return `d - (ra + rb)`
      instead
    least-part: your code uses the smallest absolute component of the vector between the
      closest points as their distance. Use the norm of this vector instead
    parts-with-signs: your code adds the components of the vector between the closest
      points with their signs. Use the norm of this vector instead
    parts-with-signs 2: your code adds the components of the vector between the closest
      points with their signs. Use the norm of this vector instead
    mean-square: your distance between the closest points is the root of the mean of the
      squares. Use the root of their sum instead, because the distance is a norm
    lengths-differ: your code uses the difference between the norms of the two closest
      points as their distance. Use the norm of their difference instead
    cut-once: your code subtracts `ra`, clamps the result at 0 and then subtracts `rb`.
      Omit the clamp, because the signed distance can be negative
    one-number-inside: your code always returns -1 for capsules that overlap. Return the
      distance between the axes minus both radii
    one-number-inside 2: your code returns minus the smaller radius for capsules that
      overlap. Return the distance between the axes minus both radii
    axes-inside: your code returns minus the distance between the axes for capsules that
      overlap. Return the distance between the axes minus both radii
    ends-only: your code assumes that one of the closest points is an endpoint of an
      axis. Use the closest points from task 11.1, because both can lie between the
      endpoints
    ends-only 2: your code tests only the endpoints of the first axis. Use the closest
      points from task 11.1, because the closest point of the first axis can lie between
      its endpoints
    ends-only 3: your code tests only the endpoints of the second axis. Use the closest
      points from task 11.1, because the closest point of the second axis can lie
      between its endpoints
    sampled: your code tests only some points of each axis. Use the closest points from
      task 11.1, because they can lie between the tested points
    sampled 2: your code tests only some points of each axis. Use the closest points
      from task 11.1, because they can lie between the tested points
    sampled 3: your code tests only some points of each axis. Use the closest points
      from task 11.1, because they can lie between the tested points
    sampled 4: your code tests only some points of each axis. Use the closest points
      from task 11.1, because they can lie between the tested points
    lines: your code treats the axes as infinite lines. Use the closest points from task
      11.1, because the axes are segments
    grown-axes: your code extends each axis by its capsule's radius at both ends. Omit
      this extension, because subtracting the radii already accounts for the round ends
    starts-and-ends: your code uses the segments from `a0` to `b0` and from `a1` to
      `b1`. Use the axes instead, which run from `a0` to `a1` and from `b0` to `b1`
    in-the-plane: your code omits the z component of the vector between the closest
      points. Use all three components
    """
    p, o = closest_points_segments(a0, a1, b0, b1)
    axes = np.linalg.norm(p - o)
    d = axes - ra - rb
    ends = min(np.linalg.norm(x - y) for x in (a0, a1) for y in (b0, b1))
    square = axes**2 - (ra + rb) ** 2
    way = p - o

    def to(q, start, end):
        u = end - start
        share = np.clip((q - start) @ u / (u @ u), 0, 1) if u.any() else 0.0
        return np.linalg.norm(q - start - share * u)

    firsts = min(to(a0, b0, b1), to(a1, b0, b1))
    seconds = min(to(b0, a0, a1), to(b1, a0, a1))

    def grown(start, end, r):
        size = np.linalg.norm(end - start)
        return r * (end - start) / size if size else np.zeros(3)

    def longer():
        u, v = grown(a0, a1, ra), grown(b0, b1, rb)
        x, y = closest_points_segments(a0 - u, a1 + u, b0 - v, b1 + v)
        return np.linalg.norm(x - y) - ra - rb

    def sampled(n):
        some = np.linspace(0, 1, n)[:, None]
        each = (a0 + some * (a1 - a0))[:, None] - (b0 + some * (b1 - b0))
        return np.linalg.norm(each, axis=2).min() - ra - rb

    def lines():
        u = a1 - a0
        n = np.cross(u, b1 - b0)
        if n.any():
            return abs((b0 - a0) @ n) / np.linalg.norm(n) - ra - rb
        return np.linalg.norm(np.cross(b0 - a0, u)) / np.linalg.norm(u) - ra - rb

    def across():
        x, y = closest_points_segments(a0, b0, a1, b1)
        return np.linalg.norm(x - y) - ra - rb

    return {
        "in-the-plane 2": lambda: np.linalg.norm(way[1:]) - ra - rb,
        "in-the-plane 3": lambda: np.linalg.norm(way[::2]) - ra - rb,
        "product-of-radii": lambda: axes - np.sqrt(ra * rb),
        "squares-of-radii": axes - ra**2 - rb**2,
        "over-the-radii": axes / (ra + rb) - 1 if ra + rb else np.inf,
        "ends-and-middles": lambda: (
            min(
                np.linalg.norm(x - y)
                for x in (a0, (a0 + a1) / 2, a1)
                for y in (b0, (b0 + b1) / 2, b1)
            )
            - ra
            - rb
        ),
        "same-share": lambda: to(np.zeros(3), a0 - b0, a1 - b1) - ra - rb,
        "twice-the-larger": lambda: axes - 2 * max(ra, rb),
        "radii-as-sides": lambda: axes - np.hypot(ra, rb),
        "root-of-squares": lambda: np.sqrt(max(square, 0.0)),
        "root-of-squares 2": lambda: np.sign(square) * np.sqrt(abs(square)),
        "least-part": lambda: np.abs(way).min() - ra - rb,
        "parts-with-signs": lambda: way.sum() - ra - rb,
        "parts-with-signs 2": lambda: abs(way.sum()) - ra - rb,
        "mean-square": lambda: axes / np.sqrt(3) - ra - rb,
        "lengths-differ": lambda: abs(np.linalg.norm(p) - np.linalg.norm(o)) - ra - rb,
        "cut-once": lambda: max(axes - ra, 0.0) - rb,
        "one-number-inside": -1.0 if d < 0 else d,
        "one-number-inside 2": lambda: -min(ra, rb) if d < 0 else d,
        "axes-inside": -axes if d < 0 else d,
        "ends-only": lambda: min(firsts, seconds) - ra - rb,
        "ends-only 2": firsts - ra - rb,
        "ends-only 3": seconds - ra - rb,
        "sampled": lambda: sampled(11),
        "sampled 2": lambda: sampled(21),
        "sampled 3": lambda: sampled(51),
        "sampled 4": lambda: sampled(101),
        "lines": lines,
        "grown-axes": longer,
        "starts-and-ends": across,
        "radii-added": axes + ra + rb,
        "radii-forgotten": axes,
        "one-radius": axes - ra,
        "one-radius 2": axes - rb,
        "as-diameters": axes - ra / 2 - rb / 2,
        "twice-the-radii": axes - 2 * ra - 2 * rb,
        "radii-differ": axes - (ra - rb),
        "radii-differ 2": lambda: axes - abs(ra - rb),
        "larger-radius": lambda: axes - max(ra, rb),
        "radii-multiplied": axes - ra * rb,
        "never-negative": lambda: max(0.0, d),
        "sign-lost": lambda: abs(d),
        "squared": axes**2 - ra - rb,
        "squared 2": axes**2 - (ra + rb) ** 2,
        "sign": -d,
        "of-middles": lambda: np.linalg.norm((a0 + a1 - b0 - b1) / 2) - ra - rb,
        "of-starts": lambda: np.linalg.norm(a0 - b0) - ra - rb,
        "of-end-pairs": ends - ra - rb,
        "largest-part": lambda: np.abs(p - o).max() - ra - rb,
        "sum-of-parts": lambda: np.abs(p - o).sum() - ra - rb,
        "in-the-plane": lambda: np.linalg.norm((p - o)[:2]) - ra - rb,
    }


row.at_least_0(ra="a radius", rb="a radius")


@row.right  # By the nearest of the four ends and the pair inside.
def _(a0, a1, ra, b0, b1, rb):
    u = a1 - a0
    v = b1 - b0
    n = np.cross(u, v)
    found = []
    if n @ n > 1e-12 * (u @ u) * (v @ v):
        s, t, k = np.linalg.solve(np.column_stack([u, -v, n]), b0 - a0)
        if 0 <= s <= 1 and 0 <= t <= 1:
            found.append(abs(k) * np.linalg.norm(n))
    for p, x, way in ((a0, b0, v), (a1, b0, v), (b0, a0, u), (b1, a0, u)):
        size = way @ way
        share = np.clip((p - x) @ way / size, 0, 1) if size else 0.0
        found.append(np.linalg.norm(p - x - share * way))
    return min(found) - ra - rb


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Over 2.5 m by balls around both.
def _(a0, a1, ra, b0, b1, rb):
    apart = np.linalg.norm((a0 + a1 - b0 - b1) / 2)
    apart -= (np.linalg.norm(a1 - a0) + np.linalg.norm(b1 - b0)) / 2
    if apart > 2.5:
        return apart - ra - rb
    return (
        np.linalg.norm(np.subtract(*closest_points_segments(a0, a1, b0, b1))) - ra - rb
    )


row.spans(  # as small, or as large, as in the lab
    rb=(0.001,),
)
