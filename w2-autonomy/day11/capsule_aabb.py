"""11.6 `capsule_aabb(a0, a1, r)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, rounded

row = Row(
    Matrix((2, 3), "m", rows=("least", "greatest"), columns=("x", "y", "z")),
)


@row.inputs
def _(rng):
    case = (np.array([0.0, 1, 0]), np.array([1.0, 0, 0]), 0.5)
    drawn = [
        (*rng.numbers(-1, 1, 2, 3), float(rng.numbers(0.05, 0.4))) for _ in range(6)
    ]
    a = rng.numbers(-1, 1, 3)
    return [case, (a, a, 0.3), *drawn]


row.cases({
    "axes that run upwards in x, y and z": lambda a0, a1, r: bool(np.all(a0 < a1)),
    "axes that run downwards in x, y and z": lambda a0, a1, r: bool(np.all(a0 > a1)),
    "axes that run upwards in one coordinate and downwards in another": (
        lambda a0, a1, r: bool(np.any(a0 < a1) and np.any(a0 > a1))
    ),
    "axes of length 0": lambda a0, a1, r: not np.any(a1 - a0),
})  # fmt: skip
row.cases({
    "axes parallel to x, y or z": lambda a0, a1, r: np.count_nonzero(a1 - a0) == 1,
    "other axes": lambda a0, a1, r: np.count_nonzero(a1 - a0) > 1,
    "axes of length 0": lambda a0, a1, r: not np.any(a1 - a0),
})  # fmt: skip


@row.rare
def _(rng):
    a, way = rng.numbers(-1, 1, 3), rng.numbers(0.1, 1, 3)
    r = float(rng.numbers(0.05, 0.4))
    for sign in (1.0, -1.0, 0.0, np.eye(3)[int(rng.integers(3))]):
        yield a, rounded(a + sign * way), r


@row.wrongs
def _(a0, a1, r):
    """radius-forgotten: the radius is missing: this box holds the axis alone
    radius-on-one-side: the radius is added on one side only => the least corner without
    radius-on-one-side 2: the radius is taken off on one side only => the greatest
      corner without
    radius-inwards: the radius is taken inwards: the least corner lies r lower
    radius-added-to-both: the radius is added to both corners
    diameter: it is wider by the diameter on each side => with 2 r
    half-the-radius: it is wider by half the radius on each side
    flat-ends: the radius shrinks with the axis' direction, as of a cylinder with flat
      ends; a capsule ends in balls, as wide as r on every axis => with
      r sqrt(1 - d^2) on each axis, d the axis' direction
    corners-not-sorted: a0 and a1 are taken for the least and the greatest corner: each
      may be the lesser in one of x, y, z => a0 - r, a1 + r
    corners-of-all: one number serves all three: the least of x, y and z together
    swapped: the greatest corner comes first
    centre-and-half: these are its middle and half its sides
    corner-and-size: these are its least corner and its whole sides
    half-not-halved: the middle is right, and it is |a1 - a0| wider: half of that is
      half of a side => |a1 - a0| + r on either side of the middle
    longest-side: it is as wide as its longest side on every axis => a cube
    longest-side 2: it is wide by the axis' length on every axis => the length and r on
      either side of the middle
    around-one-end: only a0 counts: this is the box of a ball around it
    around-one-end 2: only a1 counts: this is the box of a ball around it
    along-the-axis: r is added along the axis alone; a ball at each end goes r beyond it
      on all axes => with r times the axis' direction
    whole-ends-sorted: one end, whole, is taken for the least corner: each of x, y, z
      has a lesser end of its own => the end with the lesser x
    whole-ends-sorted 2: one end, whole, is taken for the least corner: each of x, y, z
      has a lesser end of its own => the end nearer to the origin
    whole-ends-sorted 3: one end, whole, is taken for the least corner: each of x, y, z
      has a lesser end of its own => the end with the lesser sum
    cube-in-the-ball: r / sqrt(3) is added: that is the cube within the ball, which does
      not hold it
    radius-times: it is scaled by r; it is to be r wider => times 1 - r and 1 + r
    with-the-origin: the box holds the origin, too: least and greatest begin at 0
    size-of-places: the sizes of x, y and z are sorted; what is below 0 counts as above
      => with |a0| and |a1|
    as-a-ball: this is the box of a ball around the middle that holds the capsule
    """
    low = np.minimum(a0, a1)
    high = np.maximum(a0, a1)
    middle = (a0 + a1) / 2
    length = np.linalg.norm(a1 - a0)
    ball = length / 2 + r
    along = (a1 - a0) / length if length else np.zeros(3)
    disc = r * np.sqrt(1 - along**2)
    way = high - low

    def sorted_by(of):
        first, last = (a0, a1) if of(a0) <= of(a1) else (a1, a0)
        return np.array([first - r, last + r])

    def wide(half):
        return np.array([middle - half, middle + half])

    sizes = np.array([np.minimum(abs(a0), abs(a1)), np.maximum(abs(a0), abs(a1))])
    return {
        "half-not-halved": wide(way + r),
        "longest-side": wide(way.max() / 2 + r),
        "longest-side 2": wide(length + r),
        "around-one-end": np.array([a0 - r, a0 + r]),
        "around-one-end 2": np.array([a1 - r, a1 + r]),
        "along-the-axis": np.array([low - r * abs(along), high + r * abs(along)]),
        "whole-ends-sorted": sorted_by(lambda x: x[0]),
        "whole-ends-sorted 2": sorted_by(np.linalg.norm),
        "whole-ends-sorted 3": sorted_by(np.sum),
        "cube-in-the-ball": np.array([low - r / 3**0.5, high + r / 3**0.5]),
        "radius-times": np.array([low * (1 - r), high * (1 + r)]),
        "with-the-origin": np.array([np.minimum(low, 0) - r, np.maximum(high, 0) + r]),
        "size-of-places": sizes + np.array([[-r], [r]]),
        "radius-forgotten": np.array([low, high]),
        "radius-on-one-side": np.array([low, high + r]),
        "radius-on-one-side 2": np.array([low - r, high]),
        "radius-inwards": np.array([low + r, high - r]),
        "radius-added-to-both": np.array([low + r, high + r]),
        "diameter": np.array([low - 2 * r, high + 2 * r]),
        "half-the-radius": np.array([low - r / 2, high + r / 2]),
        "flat-ends": np.array([low - disc, high + disc]),
        "corners-not-sorted": np.array([a0 - r, a1 + r]),
        "corners-of-all": np.array(
            [np.full(3, low.min() - r), np.full(3, high.max() + r)]
        ),
        "swapped": np.array([high + r, low - r]),
        "centre-and-half": np.array([middle, (high - low) / 2 + r]),
        "corner-and-size": np.array([low - r, high - low + 2 * r]),
        "as-a-ball": np.array([middle - ball, middle + ball]),
    }


row.at_least_0(r="a radius")


@row.right  # By the middle and half the way.
def _(a0, a1, r):
    middle = (a0 + a1) / 2
    half = np.abs(a1 - a0) / 2 + r
    return np.array([middle - half, middle + half])


row.spans(  # as small, or as large, as in the lab
    r=(0.002,),
)
