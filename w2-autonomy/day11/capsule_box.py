"""11.4 `capsule_box(a0, a1, r, T_world_box, half)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Finding, Row, Scalar
from robo47.distance import box_sdf, capsule_box

from . import pairs, where_boxes


def above(case):
    """Say so where no answer is too small: the axis' nearest point was not found."""
    more = case.S - case.T
    if more.min() < -1e-9 or more.max() > 0.2 or (more > 1e-9).all():
        return where_boxes.capsule(case)
    return Finding(
        "not-the-least",
        f"No answer is too small, some are up to {1000 * more.max():.3g} mm too large: "
        "the nearest point of the axis is not found yet. Are only some points asked, "
        "or is 0.618 taken too few times?",
    )


# Ten sections and less leave some 1e-4: near in method.
row = Row(Scalar(unit="m"), near=1e-3, unnamed=above, before_slips=False)


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
        half = rng.numbers(0.2, 0.6, 3)
        a0, a1 = pairs.around(rng, half, T, deep)
        drawn.append((a0, a1, float(rng.numbers(0.05, 0.2)), T, half))
    T = pairs.turned(rng)
    half = rng.numbers(0.2, 0.6, 3)
    for _ in range(50):  # an end of it is the nearest
        a0, a1 = rng.numbers(2.5, 3, 3), rng.numbers(4, 5, 3)
        if min(np.linalg.norm(x - T[:3, 3]) for x in (a0, a1)) > half.sum():
            break
    drawn.append((a0, a1, 0.1, T, half))
    drawn.append((a1, a0, 0.1, T, half))
    return [case, aside, *drawn]


def along(a0, a1, half, shares, R=None, t=None):
    """Return 11.3 at shares of a segment, in axes R^T (x - t)."""
    R = np.eye(3) if R is None else R
    t = np.zeros(3) if t is None else t
    return np.array([box_sdf(R.T @ (a0 + s * (a1 - a0) - t), half) for s in shares])


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
def _(a0, a1, r, T_world_box, half):
    """ends-only: only the ends of the axis are asked; its nearest point may lie between
      them
    middle-only: only the middle of the axis is asked
    three-points: only both ends and the middle are asked; the nearest point may lie
      between them
    eleven-points: only some points of the axis are asked, as by linspace; the nearest
      one lies between them => the least of 11
    eleven-points 2: only some points of the axis are asked, as by linspace; the nearest
      one lies between them => the least of 21
    nearest-to-the-centre: the axis' point nearest to the box's middle is asked; another
      one may be nearer to a face
    world-axes: the box is not turned: both ends are moved into its place alone => R = 1
    turned-the-other-way: the ends are turned the other way: into the box's axes it is
      R^T (x - t) => with R
    pose-not-inverted: T_world_box is used as it is: it takes the box's points to the
      world, and the other way is wanted => R x + t
    place-forgotten: the ends are turned and not moved: they are counted from the box's
      middle => R^T x
    turned-then-moved: t is taken off after turning: R^T (x - t) is not R^T x - t
    t-added: t is added; from the box's middle the ends are x - t => R^T (x + t)
    radius-forgotten: the radius is missing: this is how far its axis is
    radius-added: the radius is added; it comes nearer by it => + r
    diameter: twice the radius is taken off => - 2 r
    radius-to-the-box: the box is grown by the radius; its edges and corners are round,
      then => with half + r
    radius-to-the-box 2: the box is grown by the radius; its edges and corners are
      round, then => with half + r at the right place
    way-not-turned: the start is taken into the box's axes, and the way along the axis
      is not => with a1 - a0 as it is
    wrong-half-kept: the wrong part is kept: this finds the farthest point of the axis
    wrong-half-kept 2: the wrong part is kept: this finds the farthest point of the axis
      => the largest of both ends
    bounding-sphere: the box is taken for a ball => with the length of half
    ends-left-out: no end of the axis is asked, and the valley is cut to its inner part
    whole-sides: half is halved again: it is half of the sides already
    twice-the-sides: half is doubled: the faces stand at plus and minus half
    never-negative: what overlaps is 0 apart here; it is to be below 0 => with max(0, d)
    sign: its sign is the other one: apart is above 0
    outside-only: the axis counts as outside: inside it is below 0 => 0 there, less r
    as-a-line: the axis is not cut at its ends: this is the least on a far longer one
    five-sections: a few sections are too few: each leaves 0.618 of the axis => after 5
    five-sections 2: a few sections are too few: each leaves 0.618 of the axis => after
      8
    """
    R = T_world_box[:3, :3]
    t = T_world_box[:3, 3]
    d = capsule_box(a0, a1, 0.0, T_world_box, half)

    def least(R, t, half=half, a0=a0, a1=a1):
        T = np.eye(4)
        T[:3, :3] = R
        T[:3, 3] = t
        return capsule_box(a0, a1, 0.0, T, half) - r

    def shares(*some):
        return along(a0, a1, half, some, R, t).min() - r

    def at(s):
        return along(a0, a1, half, [s], R, t)[0]

    way = a1 - a0
    to_middle = float(np.clip((t - a0) @ way / (way @ way), 0, 1))
    farthest = max(at(0.0), at(1.0))

    def sections(n):
        return at(np.mean(golden(at, n))) - r

    far = np.linalg.norm(a0 + to_middle * way - t)
    return {
        "ends-only": shares(0.0, 1.0),
        "middle-only": shares(0.5),
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
        "diameter": d - 2 * r,
        "radius-to-the-box": lambda: least(R, t, half + r) + r,
        "radius-to-the-box 2": lambda: along(
            a0, a1, half + r, golden(at, 60), R, t
        ).min(),
        "way-not-turned": lambda: least(
            np.eye(3), np.zeros(3), half, R.T @ (a0 - t), R.T @ (a0 - t) + way
        ),
        "wrong-half-kept": lambda: at(golden(at, 60, wrong=True)[0]) - r,
        "wrong-half-kept 2": farthest - r,
        "bounding-sphere": far - np.linalg.norm(half) - r,
        "ends-left-out": lambda: shares(*np.linspace(0.05, 0.95, 19)),
        "whole-sides": lambda: least(R, t, half / 2),
        "twice-the-sides": lambda: least(R, t, 2 * half),
        "never-negative": max(0.0, d - r),
        "sign": r - d,
        "outside-only": max(0.0, d) - r,
        "as-a-line": lambda: least(R, t, half, a0 - 10 * way, a1 + 10 * way),
        "five-sections": lambda: sections(5),
        "five-sections 2": lambda: sections(8),
    }


row.at_least_0(r="a radius", half="half of a side")
row.same("for _ in range(60): => for _ in range(120):", "more are right as well")


@row.right  # By thirds.
def _(a0, a1, r, T_world_box, half):
    T = np.linalg.inv(T_world_box)
    a, b = (T[:3, :3] @ x + T[:3, 3] for x in (a0, a1))

    def at(s):
        return box_sdf(a + s * (b - a), half)

    low, high = 0.0, 1.0
    for _ in range(90):
        left, right = low + (high - low) / 3, high - (high - low) / 3
        if at(left) <= at(right):
            high = right
        else:
            low = left
    return at((low + high) / 2) - r


@row.close("rounded-somewhere")
def _(a0, a1, r, T_world_box, half):  # Twenty sections.
    R, t = T_world_box[:3, :3], T_world_box[:3, 3]
    return along(a0, a1, half, golden(
        lambda s: along(a0, a1, half, [s], R, t)[0], 20), R, t).min() - r  # fmt: skip
