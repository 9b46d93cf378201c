"""11.3 `box_sdf(p, half_extents)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar, rounded

row = Row(Scalar(unit="m"))


@row.inputs
def _(rng):
    one = np.ones(3)
    worked = [((2.0, 0, 0), one), ((0.0, 0, 0), one), ((2.0, 2, 0), one),
              ((0.5, 0.2, 0), one)]  # fmt: skip
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
    """zero-inside: inside it is 0; there it is minus the way to the nearest face
    inside-positive: inside it is above 0; there it is to be below
    sign: its sign is the other one: outside is above 0
    largest-outside: outside only the face that is farthest beyond counts; beyond an
      edge or a corner it is the length of all => max(|p| - half_extents)
    sum-outside: outside the parts beyond the faces are added; they are the sides of a
      right angle
    inside-added-outside: what is below 0 counts outside as well: only what is beyond a
      face does => the norm of |p| - half_extents
    depth-added-outside: outside the largest of |p| - half_extents comes on top; it
      counts only inside, where it is below 0 => the length, and max(|p| - half_extents)
      without min(..., 0)
    inside-by-the-norm: inside it is minus the length of all three; it is the way to the
      nearest face alone
    farthest-face-inside: inside it is the way to the farthest face; the nearest one is
      the largest of |p| - half_extents => with min
    farthest-face-inside 2: what is added to the length is the way to the farthest face;
      it is the largest of |p| - half_extents, where that is below 0 => with min
    to-the-middle-inside: inside it is minus how far the middle is
    to-the-middle: this is how far the middle is: the box has no size
    box-as-a-ball: the box is taken for a ball => |p| less the length of half_extents
    box-as-a-ball 2: the box is taken for a ball => |p| less the largest half_extents
    box-as-a-ball 3: the box is taken for a ball => |p| less the smallest half_extents
    whole-sides: half_extents is halved again: it is half of the sides already => with
      half_extents / 2
    twice-the-sides: half_extents is doubled: the faces stand at plus and minus
      half_extents => with 2 half_extents
    abs-forgotten: a point on the side below 0 is not folded over: it is |p| -
      half_extents => with p - half_extents
    abs-forgotten-zero-inside: a point on the side below 0 is not folded over, and
      inside it is 0 => the norm of what of p - half_extents is above 0
    not-rooted: this is the square of the length outside
    nearest-corner: this is how far the nearest corner is; a face may be nearer
    largest-half: all sides are the largest => with half_extents.max()
    half-backwards: half_extents is read from its end: its first entry is x's
    last-half: all sides are the last => with half_extents[2]
    mean-half: all sides are the mean => with half_extents.mean()
    first-half: all sides are the first => with half_extents[0]
    in-the-plane: z is forgotten
    smallest-added: the least of |p| - half_extents is added, above 0 as well; it is the
      largest, where that is below 0 => the length, and min(|p| - half_extents)
    first-axis-added: what is added to the length is x's |p| - half_extents where that
      is below 0; it is the largest of all three
    largest-with-max: max(..., 0) stands for min(..., 0): outside the largest comes on
      top, and inside it is 0
    sum-inside: inside the three ways to the faces are added; the nearest is the way out
    mean-inside: inside it is the mean of the three ways; the nearest is the way out
    one-number-inside: inside it is -1 everywhere; it is the way to the nearest face
    least-half-inside: inside it is minus the least half_extents everywhere; that is
      right in the middle alone
    smallest-part-inside: inside it is minus the least of |p|; the faces are
      half_extents away
    upper-faces-inside: inside only the faces above 0 count: the others may be nearer =>
      minus the least of half_extents - p
    lengthwise: it is measured along the line to the middle; the nearest point of a face
      lies straight below => |p| (1 - 1 / max(|p| / half_extents))
    size-of-the-difference: |p - half_extents| is taken: it is |p| - half_extents
    cut-at-one: what is beyond a face is cut to 1 at most
    corner-or-face: beyond an edge, two faces, it is the length of both; this is the
      larger of them => the length beyond corners alone
    two-of-three: beyond a corner all three count; this is the length of the larger two
    first-two-only: beyond a face of z the length of x and y is left out => the largest
      there
    mean-square: the root of the mean square is taken; it is that of the sum
    smallest-taken-off: the least size of |p| - half_extents is taken off, outside as
      well
    edges-negative: beyond an edge or a corner its sign is the other one
    cut-at-both: this is p cut to the box, and its length => the norm of the nearest
      point
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
        "last-half": lambda: of(p, np.full(3, half_extents[2])),
        "mean-half": lambda: of(p, np.full(3, half_extents.mean())),
        "first-half": lambda: of(p, np.full(3, half_extents[0])),
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
