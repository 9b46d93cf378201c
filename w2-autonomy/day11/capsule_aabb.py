"""11.6 `capsule_aabb(a0, a1, r)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, rounded

row = Row(
    Matrix((2, 3), "m", rows=("lower", "upper"), columns=("x", "y", "z")),
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
    "axes along which x, y and z all increase": lambda a0, a1, r: bool(np.all(a0 < a1)),
    "axes along which x, y and z all decrease": lambda a0, a1, r: bool(np.all(a0 > a1)),
    "axes along which one coordinate increases and another decreases": (
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
    """radius-forgotten: your code omits the radius, so the box contains only the axis.
      Subtract the radius from the lower corner and add it to the upper corner
    radius-on-one-side: your code does not subtract the radius from the lower corner.
      Subtract the radius, because the capsule extends by the radius on every side
    radius-on-one-side 2: your code does not add the radius to the upper corner. Add the
      radius, because the capsule extends by the radius on every side
    radius-inwards: your code adds the radius to the lower corner and subtracts the
      radius from the upper corner. Subtract the radius from the lower corner, and add
      it to the upper corner
    radius-added-to-both: your code adds the radius to both corners. Subtract the radius
      from the lower corner instead
    flat-ends: your code computes the box of a cylinder with flat ends. A capsule has
      hemispherical ends, so add the whole radius along every axis
    corners-not-sorted: your code uses `a0` and `a1` as the lower and the upper corner.
      Take the minimum and the maximum of each coordinate
    corners-of-all: your code takes one minimum and one maximum over x, y and z
      together. Take the minimum and the maximum of each coordinate separately
    swapped: your code returns the upper corner first. Return the lower corner first
    centre-and-half: your code returns the centre and the half extents. Return the lower
      and the upper corner instead
    corner-and-size: your code returns the lower corner and the side lengths. Return the
      lower and the upper corner instead
    half-not-halved: your code uses `abs(a1 - a0)` as the half extents of the axis. Use
      `abs(a1 - a0) / 2` instead
    longest-side: your code uses the longest side along every axis, so the box is a
      cube. Use the extent along each axis instead
    longest-side 2: your code uses r plus the length of the axis as every half extent.
      Use `r + abs(a1 - a0) / 2` for each coordinate instead
    around-one-end: your code uses only `a0`, so the result is the box of a sphere
      around `a0`. Use `a1` as well
    around-one-end 2: your code uses only `a1`, so the result is the box of a sphere
      around `a1`. Use `a0` as well
    along-the-axis: your code adds the radius only along the direction of the axis. Add
      the radius along x, y and z, because the capsule contains a sphere at each end
    whole-ends-sorted: your code uses one endpoint for the lower corner and the other
      endpoint for the upper corner. Take the minimum and the maximum of each coordinate
      separately
    whole-ends-sorted 2: your code uses one endpoint for the lower corner and the other
      endpoint for the upper corner. Take the minimum and the maximum of each coordinate
      separately
    whole-ends-sorted 3: your code uses one endpoint for the lower corner and the other
      endpoint for the upper corner. Take the minimum and the maximum of each coordinate
      separately
    cube-in-the-ball: your code adds `r / sqrt(3)`, which gives the cube inscribed in
      the sphere at each end. Add `r` instead, because the box must contain both spheres
    radius-times: your code multiplies the corners by `1 - r` and `1 + r`. Subtract and
      add `r` instead
    with-the-origin: your code returns a box that always contains the origin. Use only
      the coordinates of `a0` and `a1`. If your code updates a minimum and a maximum,
      initialise them with `a0`
    size-of-places: your code takes the minimum and the maximum of the absolute
      coordinates. Use the coordinates with their signs
    as-a-ball: your code computes the box of a sphere around the whole capsule. Use the
      minimum and the maximum of each coordinate, because the box should be as small as
      possible
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
