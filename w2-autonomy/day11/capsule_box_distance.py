"""11.4 `capsule_box_distance`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Finding, Row, Scalar
from robo47.distance import box_sdf, capsule_box_distance, closest_points_segments

from . import pairs


def above(case):
    """Say so where no answer is too small: the axis' nearest point was not found."""
    more = case.S - case.T
    if case.further:
        more = np.append(more, case.further.S[0] - case.further.T[0])
    if not (more.min() >= -1e-9 and more.max() <= 0.2) or (more > 1e-9).all():
        return None
    return Finding(
        "not-the-least",
        "No result is too small, but some are too large, by up to "
        f"{1000 * more.max():.3g} mm. This happens if your code does not find the "
        "nearest point of the axis. Does it test only some points, or does the search "
        "stop too early?",
    )


def shares(a0, a1, r, T, half_extents):
    """Return how far an axis is from a box at 41 of its points, end to end."""
    start, end = ((x - T[:3, 3]) @ T[:3, :3] for x in (a0, a1))
    points = start + np.linspace(0, 1, 41)[:, None] * (end - start)
    return np.array([box_sdf(p, half_extents) for p in points])


def place(wanted):
    """Return the case of capsules whose axis comes nearest at some place."""

    def of(*call):
        far = shares(*call)
        if far.min() < 0:
            return wanted == "inside"
        at_end = int(far.argmin()) in (0, len(far) - 1)
        return wanted == ("end" if at_end else "between")

    return of


def rotated(a0, a1, r, T, half_extents):
    """Return whether the box is rotated."""
    return not np.allclose(T[:3, :3], np.eye(3))


# Ten sections and less leave some 1e-4: near in method.
row = Row(Scalar(unit="m"), near=1e-3, unnamed=above, before_slips=False, each_case=100)
row.cases({
    "boxes at the origin that are not rotated": (
        lambda *call: not rotated(*call) and not call[3][:3, 3].any()
    ),
    "translated boxes that are not rotated": (
        lambda *call: not rotated(*call) and bool(call[3][:3, 3].any())
    ),
    "rotated boxes": rotated,
})  # fmt: skip
row.cases({
    "axes whose nearest point lies between the endpoints": place("between"),
    "axes whose nearest point is an endpoint": place("end"),
    "axes that enter the box": place("inside"),
})  # fmt: skip


@row.rare
def _(rng):
    for T in (np.eye(4), pairs.moved(rng), pairs.turned(rng)):
        half_extents = rng.numbers(0.2, 0.6, 3)
        a0, a1 = rng.numbers(-1.5, 1.5, 2, 3)
        for start, way in ((a0, a1 - a0), (a0 + np.sign(a0), a0)):
            ends = [np.round(T[:3, :3] @ x + T[:3, 3], 4) for x in (start, start + way)]
            yield *ends, float(rng.numbers(0.05, 0.2)), T, half_extents


@row.inputs
def _(rng):
    one = np.ones(3)
    case = (np.array([-2.0, 0, 2]), np.array([2.0, 0, 2]), 0.1, np.eye(4), one)
    there = np.eye(4)
    there[0, 3] = 2.0
    aside = (np.array([0.0, 0, 3]), np.array([4.0, 0, 3]), 0.5, there,
             np.array([1.0, 0.5, 1]))  # fmt: skip
    drawn = []
    for T, deep in (
        (np.eye(4), False), (pairs.moved(rng), False), (pairs.turned(rng), True),
        (pairs.turned(rng), False), (pairs.turned(rng), False),
    ):  # fmt: skip
        half_extents = rng.numbers(0.2, 0.6, 3)
        a0, a1 = pairs.around(rng, half_extents, T, deep)
        drawn.append((a0, a1, float(rng.numbers(0.05, 0.2)), T, half_extents))
    T = pairs.turned(rng)
    half_extents = rng.numbers(0.2, 0.6, 3)
    for _ in range(50):  # an end of it is the nearest
        a0, a1 = rng.numbers(2.5, 3, 3), rng.numbers(4, 5, 3)
        if min(np.linalg.norm(x - T[:3, 3]) for x in (a0, a1)) > half_extents.sum():
            break
    drawn.append((a0, a1, 0.1, T, half_extents))
    drawn.append((a1, a0, 0.1, T, half_extents))
    ball = (case[1], case[1], 0.2, case[3], one)  # an axis of no length
    return [case, aside, ball, *drawn]


def along(a0, a1, half_extents, shares, R=None, t=None):
    """Return 11.3 at shares of a segment, in axes R^T (x - t)."""
    R = np.eye(3) if R is None else R
    t = np.zeros(3) if t is None else t
    return np.array(
        [box_sdf(R.T @ (a0 + s * (a1 - a0) - t), half_extents) for s in shares]
    )


def golden(f, n, keep=0.618, wrong=False):
    """Return what is left of 0..1 after n sections."""
    low, high = 0.0, 1.0
    for _ in range(n):
        left, right = high - keep * (high - low), low + keep * (high - low)
        if (f(left) < f(right)) != wrong:
            high = right
        else:
            low = left
    return low, high


@row.wrongs
def _(a0, a1, r, T_world_box, half_extents):
    """ends-only: your code tests only the endpoints of the axis. Minimise `box_sdf`
      along the axis, because the nearest point can lie between the endpoints
    one-end-only: your code always returns the distance at the endpoint `a1`. Does it
      test no other point, or does your search always keep the upper part of the
      interval?
    one-end-only 2: your code always returns the distance at the endpoint `a0`. Does it
      test no other point, or does your search always keep the lower part of the
      interval?
    middle-only: your code tests only the midpoint of the axis. Minimise `box_sdf` along
      the axis, because the nearest point can be anywhere on the axis
    five-points: your code tests only some points of the axis. Minimise `box_sdf` along
      the axis, because the nearest point can lie between the tested points
    five-points 2: your code tests only some points of the axis. Minimise `box_sdf`
      along the axis, because the nearest point can lie between the tested points
    three-points: your code tests only the endpoints and the midpoint of the axis.
      Minimise `box_sdf` along the axis, because the nearest point can lie between these
      points
    eleven-points: your code tests only some points of the axis. Minimise `box_sdf`
      along the axis, because the nearest point can lie between the tested points
    eleven-points 2: your code tests only some points of the axis. Minimise `box_sdf`
      along the axis, because the nearest point can lie between the tested points
    nearest-to-the-centre: your code uses the point of the axis nearest to the centre of
      the box. Minimise `box_sdf` along the axis, because another point can be nearer to
      a face
    world-axes: your code subtracts the position of the box from the endpoints, but it
      does not rotate the results. Use `R^T (x - t)` to express each endpoint x in the
      box frame
    turned-the-other-way: your code rotates `x - t` by R. Rotate this vector by R^T
      instead, which maps from the world frame to the box frame
    pose-not-inverted: your code applies `T_world_box`, which maps from the box frame to
      the world frame. Apply the inverse of `T_world_box` instead
    place-forgotten: your code rotates the endpoints but does not translate them.
      Subtract the position of the box before the rotation
    turned-then-moved: your code computes `R^T x - t` for points x of the axis. Use
      `R^T (x - t)` instead, because the position t of the box is expressed in the world
      frame
    t-added: your code adds the position of the box to the endpoints. Subtract the
      position instead, as in `R^T (x - t)`
    radius-forgotten: your code omits the radius, so the result is the distance from the
      axis to the box. Subtract r
    radius-added: your code adds the radius. Subtract the radius instead
    radius-to-the-box: your code enlarges the box by the radius, but the enlarged box
      still has sharp corners. Subtract the radius from the distance instead
    radius-to-the-box 2: your code enlarges the box by the radius, but the enlarged box
      still has sharp corners. Subtract the radius from the distance instead
    way-not-turned: your axis starts at the correct point in the box frame, but its
      direction is expressed in the world frame. Multiply `a1 - a0` by R^T
    wrong-half-kept: your code searches for the maximum of `box_sdf` along the axis.
      Search for the minimum instead: keep the part of the interval with the smaller
      value
    wrong-half-kept 2: your code returns the distance at the farthest point of the axis.
      Find the minimum of `box_sdf` along the axis. In a search, keep the part of the
      interval with the smaller value
    bounding-sphere: your code treats the box as a sphere. Compare each coordinate with
      the half extent along its own axis
    ends-left-out: your code tests only some points of the axis, and neither endpoint.
      Minimise `box_sdf` along the whole axis, because the nearest point can be an
      endpoint or lie between the tested points
    never-negative: your code returns 0 for shapes that overlap. The signed distance
      should be negative for such shapes
    sign: your code negates the signed distance. The signed distance should be positive
      for shapes that do not overlap
    outside-only: if the axis enters the box, your code uses 0 as the distance from the
      axis to the box. Keep the negative value of `box_sdf`, and then subtract r
    as-a-line: your code extends the axis beyond its endpoints. Keep the parameter s in
      [0, 1], because the axis is a segment
    way-moved: your code also subtracts the position of the box from the direction of
      the axis. Omit this subtraction, because a direction is rotated but not translated
    way-moved 2: your code uses the vector from the centre of the box to `a1` as the
      direction of the axis. Use `a1 - a0` instead
    way-of-length-1: your code treats the axis as 1 m long. The search should end at
      `a1`: with a unit vector as the direction, s ends at the length of the axis and
      not at 1
    not-into-the-box: your code leaves the endpoints in the world frame. Use `R^T (x -
      t)` to express each endpoint x in the box frame
    radius-off-the-box: your code shrinks the box by the radius. Subtract the radius
      from the distance instead
    size-of-the-depth: if the axis enters the box, your code uses a positive distance
      from the axis to the box. Keep the negative value of `box_sdf`
    size-of-the-distance: your code takes the absolute value of the distance. The signed
      distance should be negative for shapes that overlap
    radius-off-the-box 2: your code shrinks the box by the radius. Subtract the radius
      from the distance instead
    largest-half: your code uses the largest half extent on every axis. Use the half
      extent of each axis instead
    largest-half 2: your code uses the largest half extent on every axis. Use the half
      extent of each axis instead
    sides-exchanged: your code swaps the x and y entries of `half_extents`. The first
      entry belongs to x
    sides-exchanged 2: your code swaps the x and y entries of `half_extents`. The first
      entry belongs to x
    box-around-it: your code uses the axis-aligned bounding box of the rotated box.
      Express the endpoints in the box frame and use the box itself instead
    half-turned: your code rotates `half_extents`, although its entries are lengths and
      not components of a vector. Express the endpoints of the axis in the box frame
      instead
    mean-along: your code returns the mean of the distances along the axis. Return the
      smallest distance instead
    edges-only: your code computes the distance to the edges of the box. Use `box_sdf`,
      because a face can be nearer and the axis can enter the box
    faces-only: your code tests only the endpoints and the points where the axis crosses
      the plane of a face. Minimise `box_sdf` along the axis, because another point can
      be nearer
    point-to-box-in-turn: your code alternates between the nearest point of the box and
      the nearest point of the axis, but it stops too early. Minimise `box_sdf` along
      the axis instead
    one-section: your search makes only one step, which leaves 0.618 of the axis. Repeat
      the step until the interval is short enough
    radius-times-the-length: your code multiplies the radius by the length of the axis.
      Subtract r itself
    share-returned: your code returns the parameter s of the nearest point. Return the
      distance at this point instead
    five-sections: your search stops too early. Make more steps, because each step still
      leaves 0.618 of the interval
    five-sections 2: your search stops too early. Make more steps, because each step
      still leaves 0.618 of the interval
    """
    R = T_world_box[:3, :3]
    t = T_world_box[:3, 3]
    d = capsule_box_distance(a0, a1, 0.0, T_world_box, half_extents)

    def least(R, t, half_extents=half_extents, a0=a0, a1=a1):
        T = np.eye(4)
        T[:3, :3] = R
        T[:3, 3] = t
        return capsule_box_distance(a0, a1, 0.0, T, half_extents) - r

    def shares(*some):
        return along(a0, a1, half_extents, some, R, t).min() - r

    def at(s):
        return along(a0, a1, half_extents, [s], R, t)[0]

    way = a1 - a0
    to_middle = float(np.clip((t - a0) @ way / (way @ way), 0, 1))
    farthest = max(at(0.0), at(1.0))

    def sections(n):
        return at(np.mean(golden(at, n))) - r

    p, q = R.T @ (a0 - t), R.T @ (a1 - t)

    def from_to(start, end, half_extents=half_extents):
        return capsule_box_distance(start, end, 0.0, np.eye(4), half_extents) - r

    def nearest_with(other):
        return along(p, q, other, golden(at, 60)).min()

    def edges():
        found = []
        for i in range(3):
            for x, y in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
                start = half_extents * np.insert([x, y], i, -1.0)
                end = half_extents * np.insert([x, y], i, 1.0)
                found.append(np.linalg.norm(np.subtract(
                    *closest_points_segments(p, q, start, end))))  # fmt: skip
        return min(found) - r

    def crossed():
        some = [0.0, 1.0]
        for i in range(3):
            for side in (-half_extents[i], half_extents[i]):
                share = (side - p[i]) / (q[i] - p[i]) if q[i] != p[i] else 0.0
                some += [share] if 0 < share < 1 else []
        return along(p, q, half_extents, some).min() - r

    def in_turn():
        s = 0.5
        for _ in range(5):
            inside = np.clip(p + s * (q - p), -half_extents, half_extents)
            s = np.clip((inside - p) @ (q - p) / ((q - p) @ (q - p)), 0, 1)
        return box_sdf(p + s * (q - p), half_extents) - r

    far = np.linalg.norm(a0 + to_middle * way - t)
    return {
        "way-moved": lambda: from_to(p, p + R.T @ (way - t)),
        "way-moved 2": lambda: from_to(p, p + q),
        "way-of-length-1": lambda: from_to(p, p + R.T @ way / np.linalg.norm(way)),
        "not-into-the-box": lambda: from_to(a0, a1),
        "radius-off-the-box": lambda: from_to(p, q, half_extents - r) + r,
        "size-of-the-depth": abs(d) - r,
        "size-of-the-distance": abs(d - r),
        "largest-half": lambda: from_to(p, q, np.full(3, half_extents.max())),
        "sides-exchanged": lambda: from_to(p, q, half_extents[[1, 0, 2]]),
        "box-around-it": lambda: from_to(a0 - t, a1 - t, np.abs(R) @ half_extents),
        "half-turned": lambda: from_to(a0 - t, a1 - t, R @ half_extents),
        "mean-along": lambda: (
            along(p, q, half_extents, np.linspace(0, 1, 101)).mean() - r
        ),
        "edges-only": edges,
        "faces-only": crossed,
        "point-to-box-in-turn": in_turn,
        "radius-times-the-length": d - r * np.linalg.norm(way),
        "radius-off-the-box 2": lambda: nearest_with(half_extents - r),
        "largest-half 2": lambda: nearest_with(np.full(3, half_extents.max())) - r,
        "sides-exchanged 2": lambda: nearest_with(half_extents[[1, 0, 2]]) - r,
        "one-section": lambda: min(at(x) for x in golden(at, 1)) - r,
        "share-returned": lambda: golden(at, 60)[0],
        "ends-only": shares(0.0, 1.0),
        "one-end-only": shares(1.0),
        "one-end-only 2": shares(0.0),
        "middle-only": shares(0.5),
        "five-points": shares(0.0, 0.25, 0.5, 0.75, 1.0),
        "five-points 2": shares(0.25, 0.5, 0.75),
        "three-points": shares(0.0, 0.5, 1.0),
        "eleven-points": lambda: shares(*np.linspace(0, 1, 11)),
        "eleven-points 2": lambda: shares(*np.linspace(0, 1, 21)),
        "nearest-to-the-centre": lambda: at(to_middle) - r,
        "world-axes": lambda: least(np.eye(3), t),
        "turned-the-other-way": lambda: least(R.T, t),
        "pose-not-inverted": lambda: least(R.T, -R.T @ t),
        "place-forgotten": lambda: least(R, np.zeros(3)),
        "turned-then-moved": lambda: least(R, R @ t),
        "t-added": lambda: least(R, -t),
        "radius-forgotten": d,
        "radius-added": d + r,
        "radius-to-the-box": lambda: least(R, t, half_extents + r) + r,
        "radius-to-the-box 2": lambda: along(
            a0, a1, half_extents + r, golden(at, 60), R, t
        ).min(),
        "way-not-turned": lambda: least(
            np.eye(3), np.zeros(3), half_extents, R.T @ (a0 - t), R.T @ (a0 - t) + way
        ),
        "wrong-half-kept": lambda: at(golden(at, 60, wrong=True)[0]) - r,
        "wrong-half-kept 2": farthest - r,
        "bounding-sphere": far - np.linalg.norm(half_extents) - r,
        "ends-left-out": lambda: shares(*np.linspace(0.05, 0.95, 19)),
        "never-negative": max(0.0, d - r),
        "sign": r - d,
        "outside-only": max(0.0, d) - r,
        "as-a-line": lambda: least(R, t, half_extents, a0 - 10 * way, a1 + 10 * way),
        "five-sections": lambda: sections(5),
        "five-sections 2": lambda: sections(8),
    }


row.at_least_0(r="a radius", half_extents="half of a side")
row.same("for _ in range(60): => for _ in range(120):", "more are right as well")


@row.right  # By thirds.
def _(a0, a1, r, T_world_box, half_extents):
    T = np.linalg.inv(T_world_box)
    a, b = (T[:3, :3] @ x + T[:3, 3] for x in (a0, a1))

    def at(s):
        return box_sdf(a + s * (b - a), half_extents)

    low, high = 0.0, 1.0
    for _ in range(90):
        left, right = low + (high - low) / 3, high - (high - low) / 3
        if at(left) <= at(right):
            high = right
        else:
            low = left
    return at((low + high) / 2) - r


@row.close("rounded-somewhere")
def _(a0, a1, r, T_world_box, half_extents):  # Twenty sections.
    R, t = T_world_box[:3, :3], T_world_box[:3, 3]
    some = golden(lambda s: along(a0, a1, half_extents, [s], R, t)[0], 20)
    return along(a0, a1, half_extents, some, R, t).min() - r


row.spans(  # as small, or as large, as in the lab
    a0=(lambda a0: 0.04 * a0,),
    r=(0.005,),
)
