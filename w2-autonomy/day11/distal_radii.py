"""11.7 `reaches(offsets, far)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.distance import reaches

from . import where_arm

row = Row(Vector((None,), "m"), unnamed=where_arm.lengths, before_slips=False)


@row.inputs
def _(rng):
    case = (np.array([1.0, 1, 0]), np.full(3, 0.5))
    drawn = [(rng.numbers(0.05, 0.5, 7), rng.numbers(0.05, 0.4, 7)) for _ in range(3)]
    long = rng.numbers(0.05, 0.3, 7)
    long[3] = 2.0  # the middle link is longer than all behind it
    longer = rng.numbers(0.05, 0.3, 7)
    longer[1] = 3.0
    return [case, (rng.numbers(0.05, 0.3, 7), long), (rng.numbers(0.1, 0.3, 7), longer),
            *drawn]  # fmt: skip


@row.wrongs
def _(offsets, far):
    """to-the-tip-only: only the last link counts; one before it may have a point that
      is farther => all offsets, and far of the last
    own-link-only: only the joint's own link counts; what is behind it is carried along
      => far
    next-only: it ends at the next link => the larger of far and offset + far of the
      next
    from-the-base: it is how far from the base each link is; it is how far from joint i
      what is behind it is => offsets before it + far
    offset-one-late: the offset is the next joint's: offsets[i] is from link i to the
      next => with offsets[i + 1]
    offset-of-the-last: the last link's offset is added; nothing is behind it => +
      offsets of the last
    offset-of-the-last 2: the last link's offset counts as one more point; nothing is
      behind it => the larger of far and offset for the last
    offset-to-its-own: the offset is added to the joint's own far, too; it leads to the
      next joint => offset + the larger of far and the reach behind
    far-forgotten: only the offsets are added: the links have a size of their own
    offsets-forgotten: the offsets are missing: this is the largest far behind it
    all-summed: the far of all links behind it is added up; only one point is the
      farthest => offsets and all far
    largest-far: the largest far of all stands at the end of the offsets; it belongs to
      its own link
    least: it is the least; a bound is the largest
    not-in-a-row: what is behind the next link is forgotten: its reach is meant, not its
      far
    euclid: lengths are added as the sides of a right angle; stretched out they are in a
      row => root of the squares
    one-for-all: it is the largest of all for every joint
    backwards: it is from the tip to the base
    sum-from-the-base: offsets are summed from the base to the joint, and far is added
    far-of-its-own: the offsets end at the last link, and the far is the joint's own
      link's => offsets behind it + its own far
    far-of-its-own 2: the offsets end at the last link, and the far is the joint's own
      link's => all offsets behind it + its own far
    forwards: it goes from the base outwards: what is behind a joint is on the other
      side => the larger of far and the offset before + the reach before
    less-the-base: the farthest point of the whole arm is measured from each joint; what
      is before a joint is not behind it => the largest of all, less the offsets before
    less-the-base 2: the farthest point behind it is measured from the base => with the
      offsets before it
    largest-far-behind: the largest far behind it stands at the last link; it belongs to
      its own link => all offsets, and the largest far
    largest-far-behind 2: the largest far behind the next joint stands at the last link;
      it belongs to its own link
    own-offset-repeated: the joint's own offset is added once for each link; each link
      has its own => with offsets[i] for all
    offset-of-the-one-before: the offset is the previous joint's: offsets[i] is from
      link i to the next => with offsets[i - 1]
    far-of-the-next: far is the next link's, its own is forgotten => the larger of far
      of the next and offset + reach of the next
    own-left-out: its own link is left out: what is farthest may be on it
    own-or-tip: only its own link and the last one count; one between may be farther
    two-behind-only: only the next two links count
    sum-not-largest: far is added to the larger of offset and reach; the larger is to be
      taken of far, and of both others together
    largest-of-three: the largest of far, offset and the next one's reach is taken; the
      last two are added
    largest-far-next: the largest far is added to the offset; each link has its own =>
      the larger of far and offset + largest far
    mean-not-largest: it is the mean over the links behind it; a bound is the largest
    offsets-alone: the larger of far and all offsets behind it is taken
    last-link-forgotten: the last link's far is 0
    last-link-forgotten 2: the last link is not looked at => without far of the last
    offsets-to-the-end: all offsets behind it, the last one's too, and far of the last
    offset-too-early: the offset after a link is added before its far => offsets[i] to
      offsets[j] + far[j]
    far-twice: its own far and that of the farthest are added
    """
    n = len(far)
    right = reaches(offsets, far)

    def behind(i, j):
        return offsets[i:j].sum()

    last = offsets.copy()
    late = np.append(offsets[1:], 0.0)

    def with_last():
        return np.array([max(last[i:n].sum() + far[-1],
                             *(behind(i, j) + far[j] for j in range(i, n)))
                         for i in range(n)])  # fmt: skip

    def with_end():
        reach = np.append(far, 0.0)
        for i in range(n - 1, -1, -1):
            reach[i] = max(far[i], offsets[i] + reach[i + 1])
        return reach[:-1]

    def to_its_own():
        reach = far.copy()
        for i in range(n - 2, -1, -1):
            reach[i] = offsets[i] + max(far[i], reach[i + 1])
        return reach

    def of(what):
        return np.array([what(i) for i in range(n)])

    def least():
        reach = far.copy()
        for i in range(n - 2, -1, -1):
            reach[i] = min(far[i], offsets[i] + reach[i + 1])
        return reach

    def forwards():
        reach = far.copy()
        for i in range(1, n):
            reach[i] = max(far[i], offsets[i - 1] + reach[i - 1])
        return reach

    def euclid():
        reach = far.copy()
        for i in range(n - 2, -1, -1):
            reach[i] = max(far[i], np.hypot(offsets[i], reach[i + 1]))
        return reach

    base = np.append(0.0, np.cumsum(offsets[:-1]))

    def largest(what, last=n):
        return of(lambda i: max([what(i, j) for j in range(i, last)], default=far[i]))

    def turn_by_turn(what, end=far[-1]):
        reach = np.append(far[:-1], end)
        for i in range(n - 2, -1, -1):
            reach[i] = what(i, reach[i + 1])
        return reach

    return {
        "less-the-base": lambda: (base + far).max() - base,
        "less-the-base 2": lambda: of(lambda i: (base + far)[i:].max()),
        "largest-far-behind": lambda: of(lambda i: behind(i, n - 1) + far[i:].max()),
        "largest-far-behind 2": lambda: of(
            lambda i: max(far[i], behind(i, n - 1) + far[i + 1 :].max(initial=0.0))
        ),
        "own-offset-repeated": lambda: (
            largest(lambda i, j: (j - i) * offsets[i] + far[j])
        ),
        "offset-of-the-one-before": lambda: turn_by_turn(
            lambda i, next_: max(far[i], offsets[i - 1] + next_)
        ),
        "far-of-the-next": lambda: turn_by_turn(
            lambda i, next_: max(far[i + 1], offsets[i] + next_)
        ),
        "own-left-out": lambda: of(
            lambda i: max([behind(i, j) + far[j] for j in range(i + 1, n)], default=0)
        ),
        "own-or-tip": lambda: of(lambda i: max(far[i], behind(i, n - 1) + far[-1])),
        "two-behind-only": lambda: of(
            lambda i: max(behind(i, j) + far[j] for j in range(i, min(i + 3, n)))
        ),
        "sum-not-largest": lambda: turn_by_turn(
            lambda i, next_: far[i] + max(offsets[i], next_)
        ),
        "largest-of-three": lambda: turn_by_turn(
            lambda i, next_: max(far[i], offsets[i], next_)
        ),
        "largest-far-next": lambda: of(
            lambda i: max(far[i], offsets[i] + far.max()) if i < n - 1 else far[i]
        ),
        "mean-not-largest": lambda: of(
            lambda i: np.mean([behind(i, j) + far[j] for j in range(i, n)])
        ),
        "offsets-alone": lambda: of(lambda i: max(far[i], offsets[i:].sum())),
        "last-link-forgotten": lambda: turn_by_turn(
            lambda i, next_: max(far[i], offsets[i] + next_), 0.0
        ),
        "last-link-forgotten 2": lambda: (
            largest(lambda i, j: behind(i, j) + far[j], n - 1)
        ),
        "offsets-to-the-end": lambda: of(lambda i: offsets[i:].sum() + far[-1]),
        "offset-too-early": lambda: (
            largest(lambda i, j: offsets[i : j + 1].sum() + far[j])
        ),
        "to-the-tip-only": lambda: of(lambda i: behind(i, n - 1) + far[-1]),
        "own-link-only": lambda: far.copy(),
        "next-only": lambda: of(lambda i: max(far[i], offsets[i] + far[i + 1])
                        if i < n - 1 else far[i]),
        "from-the-base": lambda: of(lambda i: behind(0, i) + far[i]),
        "offset-one-late": lambda: reaches(late, far),
        "offset-of-the-last": with_last,
        "offset-of-the-last 2": with_end,
        "offset-to-its-own": to_its_own,
        "far-forgotten": lambda: of(lambda i: behind(i, n - 1)),
        "offsets-forgotten": lambda: of(lambda i: far[i:].max()),
        "all-summed": lambda: of(lambda i: behind(i, n - 1) + far[i:].sum()),
        "largest-far": lambda: of(lambda i: behind(i, n - 1) + far.max()),
        "least": least,
        "not-in-a-row": lambda: (
            of(lambda i: far[i] + (offsets[i] if i < n - 1 else 0.0))
        ),
        "euclid": euclid,
        "one-for-all": lambda: np.full(n, right.max()),
        "backwards": lambda: right[::-1].copy(),
        "sum-from-the-base": lambda: of(lambda i: behind(0, i + 1) + far[i]),
        "far-of-its-own": lambda: of(lambda i: behind(i, n - 1) + far[i]),
        "far-of-its-own 2": lambda: of(lambda i: offsets[i:].sum() + far[i]),
        "forwards": forwards,
        "far-twice": lambda: of(lambda i: far[i] + right[i]),
    }  # fmt: skip


row.at_least_0(offsets="a length", far="a length", answer="a length")


@row.right  # By the definition: the largest over all links behind.
def _(offsets, far):
    n = len(far)
    return np.array(
        [max(offsets[i:j].sum() + far[j] for j in range(i, n)) for i in range(n)]
    )
