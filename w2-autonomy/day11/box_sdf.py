"""11.3 `box_sdf(p, half_extents)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar, rounded

row = Row(Scalar(unit="m"))


@row.inputs
def _(rng):
    one = np.ones(3)
    worked = [((2.0, 0, 0), one), ((0.0, 0, 0), one), ((2.0, 2, 0), one),
              ((0.5, 0.2, 0), one), ((3.0, 0.5, 0), one),
              ((0.5, -2.5, 1.5), one)]  # fmt: skip
    drawn = []
    # Beyond how many faces: a face, an edge, a corner, none.
    for beyond in ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (0, 1, 1), (1, 0, 1),
                   (1, 1, 1), (1, 1, 1), (0, 0, 0), (0, 0, 0), (0, 0, 0)):  # fmt: skip
        half_extents = rng.numbers(0.3, 1.2, 3)
        inside = rng.uniform(0.1, 0.8, 3)
        outside = rng.uniform(1.3, 2.0, 3)
        sign = rng.choice([-1.0, 1.0], 3)
        sign[int(rng.integers(3))] = -1.0  # no corner where all are above 0
        drawn.append(
            (
                rounded(half_extents * sign * np.where(beyond, outside, inside)),
                half_extents,
            )
        )
    return [(np.array(p), half_extents) for p, half_extents in [*worked, *drawn]]


def beyond(n):
    """Return the case of points that lie beyond n faces of the box."""
    return lambda p, half_extents: int(np.sum(np.abs(p) > half_extents)) == n


row.cases(
    points_in_the_box=beyond(0),
    points_beyond_one_face=beyond(1),
    points_beyond_two_faces=beyond(2),
    points_beyond_three_faces=beyond(3),
)
row.cases(
    points_with_no_negative_coordinate=lambda p, half_extents: bool(np.all(p >= 0)),
    points_with_a_negative_coordinate=lambda p, half_extents: bool(np.any(p < 0)),
)
row.cases(
    cubes=lambda p, half_extents: np.ptp(half_extents) == 0,
    boxes_with_different_sides=lambda p, half_extents: np.ptp(half_extents) > 0,
)


@row.rare
def _(rng):
    for cube in (False, True):
        half_extents = rng.numbers(0.3, 1.2, 3)
        half_extents = np.full(3, half_extents[0]) if cube else half_extents
        for n in range(4):
            outside = rng.permutation(np.arange(3) < n)
            share = np.where(outside, rng.uniform(1.02, 3, 3), rng.uniform(0, 0.98, 3))
            p = rounded(half_extents * share)
            yield p, half_extents
            yield p * rng.choice([-1.0, 1.0], 3), half_extents


@row.wrongs
def _(p, half_extents):
    """zero-inside: inside the box, your code returns 0. Return minus the distance to
      the nearest face instead
    inside-positive: inside the box, your code returns a positive distance. The signed
      distance should be negative there
    sign: your code negates the signed distance. The signed distance should be positive
      outside the box
    largest-outside: outside the box, your code returns only the largest entry of
      `abs(p) - half_extents`. Return the norm of the positive entries instead
    sum-outside: outside the box, your code adds the positive entries of `abs(p) -
      half_extents`. Take their norm instead, because these entries are distances along
      perpendicular axes
    inside-added-outside: outside the box, your code includes the negative entries of
      `abs(p) - half_extents` in the norm. Clamp these entries at 0 first
    depth-added-outside: outside the box, your code adds the largest entry of `abs(p) -
      half_extents` to the norm. Add this entry only inside the box, where it is
      negative
    inside-by-the-norm: inside the box, your code returns minus the norm of
      `half_extents - abs(p)`. Return minus its smallest entry instead, which is the
      distance to the nearest face
    farthest-face-inside: inside the box, your code uses the smallest entry of `abs(p) -
      half_extents`. Use the largest entry instead, which belongs to the nearest face
    farthest-face-inside 2: your code adds the smallest entry of `abs(p) - half_extents`
      wherever this entry is negative. Add the largest entry instead, which belongs to
      the nearest face, and only inside the box
    to-the-middle-inside: inside the box, your code returns minus the distance to the
      centre. Return minus the distance to the nearest face instead
    to-the-middle: your code returns the distance to the centre of the box. Return the
      signed distance to its surface instead
    box-as-a-ball: your code treats the box as a sphere. Compare each coordinate with
      the half extent along its own axis
    box-as-a-ball 2: your code treats the box as a sphere. Compare each coordinate with
      the half extent along its own axis
    box-as-a-ball 3: your code treats the box as a sphere. Compare each coordinate with
      the half extent along its own axis
    whole-sides: your code halves `half_extents`. Use `half_extents` itself, because
      each entry is already half of a side
    twice-the-sides: your code doubles `half_extents`. Use `half_extents` itself,
      because the faces are at plus and minus `half_extents`
    abs-forgotten: your code ignores the faces on the negative side of the box. Use
      `abs(p) - half_extents`, because the box is symmetric about its centre
    abs-forgotten-zero-inside: your code ignores the faces on the negative side of the
      box, and it returns 0 inside the box. Use `abs(p) - half_extents`. Inside the box,
      return minus the distance to the nearest face => both
    not-rooted: outside the box, your code returns the squared distance. Take the square
      root
    nearest-corner: your code returns the distance to the nearest corner. Outside the
      box, return the norm of the positive entries of `abs(p) - half_extents` instead.
      Inside the box, return minus the distance to the nearest face
    largest-half: your code uses the largest half extent on every axis. Use the half
      extent of each axis instead
    half-backwards: your code uses `half_extents` in reverse order. The first entry
      belongs to x, the second to y and the third to z
    in-the-plane: your code omits the z coordinate. Use all three coordinates
    smallest-added: your code adds the smallest entry of `abs(p) - half_extents`, even
      if this entry is positive. Add the largest entry instead, but only if the largest
      entry is negative
    first-axis-added: your code adds the x entry of `abs(p) - half_extents` wherever
      this entry is negative. Add the largest of the three entries instead, and only
      inside the box
    largest-with-max: your code adds the largest entry of `abs(p) - half_extents`
      outside the box instead of inside. Add this entry only inside the box, where it is
      negative
    sum-inside: inside the box, your code returns minus the sum of the entries of
      `half_extents - abs(p)`. Return minus the smallest entry instead, which is the
      distance to the nearest face
    mean-inside: inside the box, your code returns minus the mean of the entries of
      `half_extents - abs(p)`. Return minus the smallest entry instead, which is the
      distance to the nearest face
    one-number-inside: inside the box, your code always returns -1. Return minus the
      distance to the nearest face instead
    least-half-inside: inside the box, your code always returns minus the smallest half
      extent. Return minus the distance to the nearest face instead, which depends on p
    smallest-part-inside: inside the box, your code returns minus the smallest entry of
      `abs(p)`. Return minus the smallest entry of `half_extents - abs(p)`, which is the
      distance to the nearest face
    upper-faces-inside: inside the box, your code uses only the faces on the positive
      side. Use `half_extents - abs(p)`, because the opposite face can be nearer
    lengthwise: your code measures the distance along the line from p to the centre. Use
      `abs(p) - half_extents` instead, because the shortest distance to a face is
      perpendicular to it
    size-of-the-difference: your code returns the distance from p to the corner at
      `half_extents`. Outside the box, return the norm of the positive entries of
      `abs(p) - half_extents` instead. Inside the box, return minus the distance to the
      nearest face
    cut-at-one: your code clamps the entries of `abs(p) - half_extents` at 1. Omit this
      clamp, because the distance can be larger than 1 m
    corner-or-face: if p lies beyond two faces, your code returns the larger of the two
      positive entries of `abs(p) - half_extents`. Return the norm of both entries
      instead
    two-of-three: if p lies beyond three faces, your code uses only the two largest
      entries of `abs(p) - half_extents`. Use all three entries
    first-two-only: your code returns only the largest entry of `abs(p) - half_extents`
      if the point lies beyond a z face. Return the norm of the positive entries instead
    mean-square: outside the box, your code returns the root of the mean of the squares.
      Return the root of their sum instead, because the distance is a norm
    smallest-taken-off: your code subtracts the smallest absolute value of the entries
      of `abs(p) - half_extents`, even outside the box. Subtract this value only inside
      the box
    edges-negative: your code returns a negative distance if p lies beyond two or three
      faces. The signed distance should be positive everywhere outside the box
    cut-at-both: your code clamps p to the box and returns the norm of the clamped
      point. Outside the box, return the distance from p to the clamped point instead.
      Inside the box, return minus the distance to the nearest face
    """
    beyond = np.abs(p) - half_extents
    out = np.maximum(beyond, 0.0)
    length = np.linalg.norm(out)
    inside = min(beyond.max(), 0.0)
    far = np.linalg.norm(p)

    def of(p, half_extents):
        beyond = np.abs(p) - half_extents
        return np.linalg.norm(np.maximum(beyond, 0.0)) + min(beyond.max(), 0.0)

    def unfolded():
        beyond = p - half_extents
        return np.linalg.norm(np.maximum(beyond, 0.0)) + min(beyond.max(), 0.0)

    outside = inside == 0
    return {
        "smallest-added": lambda: length + beyond.min(),
        "first-axis-added": lambda: length + min(beyond[0], 0.0),
        "largest-with-max": lambda: length + max(beyond.max(), 0.0),
        "sum-inside": lambda: length if outside else beyond.sum(),
        "mean-inside": lambda: length if outside else beyond.mean(),
        "one-number-inside": length if outside else -1.0,
        "least-half-inside": lambda: length if outside else -half_extents.min(),
        "smallest-part-inside": lambda: length if outside else -np.abs(p).min(),
        "upper-faces-inside": lambda: length if outside else -(half_extents - p).min(),
        "lengthwise": lambda: far * (1 - 1 / (np.abs(p) / half_extents).max()),
        "size-of-the-difference": lambda: np.linalg.norm(p - half_extents),
        "cut-at-one": lambda: np.linalg.norm(np.minimum(out, 1.0)) + inside,
        "corner-or-face": lambda: length if out.all() else beyond.max(),
        "two-of-three": lambda: np.linalg.norm(np.sort(out)[1:]) + inside,
        "first-two-only": lambda: (
            (beyond.max() if out[2] else length) if outside else inside
        ),
        "mean-square": lambda: length / np.sqrt(3) + inside,
        "smallest-taken-off": lambda: length - np.abs(beyond).min(),
        "edges-negative": lambda: -length if np.sum(out > 0) > 1 else length + inside,
        "zero-inside": length,
        "inside-positive": length - inside,
        "sign": -(length + inside),
        "largest-outside": lambda: beyond.max(),
        "sum-outside": lambda: out.sum() + inside,
        "inside-added-outside": lambda: (
            np.linalg.norm(beyond) if inside == 0 else inside
        ),
        "depth-added-outside": lambda: length + beyond.max(),
        "inside-by-the-norm": lambda: (
            length if inside == 0 else -np.linalg.norm(beyond)
        ),
        "farthest-face-inside": lambda: length if inside == 0 else beyond.min(),
        "farthest-face-inside 2": lambda: length + min(beyond.min(), 0.0),
        "to-the-middle-inside": length if inside == 0 else -far,
        "to-the-middle": far,
        "box-as-a-ball": lambda: far - np.linalg.norm(half_extents),
        "box-as-a-ball 2": lambda: far - half_extents.max(),
        "box-as-a-ball 3": lambda: far - half_extents.min(),
        "whole-sides": lambda: of(p, half_extents / 2),
        "twice-the-sides": lambda: of(p, 2 * half_extents),
        "abs-forgotten": unfolded,
        "abs-forgotten-zero-inside": lambda: np.linalg.norm(
            np.maximum(p - half_extents, 0.0)
        ),
        "not-rooted": length**2 + inside,
        "nearest-corner": lambda: np.linalg.norm(np.abs(p) - half_extents),
        "largest-half": lambda: of(p, np.full(3, half_extents.max())),
        "half-backwards": lambda: of(p, half_extents[::-1]),
        "in-the-plane": lambda: of(p[:2], half_extents[:2]),
        "cut-at-both": lambda: np.linalg.norm(np.clip(p, -half_extents, half_extents)),
    }


row.at_least_0(half_extents="half of a side")
row.same("first p = np.abs(p)", "it takes the size anyway")


@row.right  # By the nearest point; inside by the six ways out.
def _(p, half_extents):
    if np.all(np.abs(p) <= half_extents):
        return -min(min(half_extents - p), min(half_extents + p))
    return np.linalg.norm(p - np.clip(p, -half_extents, half_extents))


row.spans(  # as small, or as large, as in the lab
    p=(lambda p: 0.04 * p,),
)
