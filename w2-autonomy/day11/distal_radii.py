"""11.7 `distal_radii(link_lengths, link_radii)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.distance import distal_radii

row = Row(Vector((None,), "m"))


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


def farthest(link_lengths, link_radii):
    """Return on which link, seen from the first joint, the farthest point lies."""
    before = np.append(0.0, np.cumsum(link_lengths)[:-1])
    return int(np.argmax(before + link_radii))


row.cases({
    "arms whose farthest point is on the first link": (
        lambda *call: farthest(*call) == 0
    ),
    "arms whose farthest point is on a link between": (
        lambda *call: 0 < farthest(*call) < len(call[0]) - 1
    ),
    "arms whose farthest point is on the last link": (
        lambda *call: farthest(*call) == len(call[0]) - 1
    ),
})  # fmt: skip
row.cases({
    "links with equal radii": lambda link_lengths, link_radii: np.ptp(link_radii) == 0,
    "links with different radii": (
        lambda link_lengths, link_radii: np.ptp(link_radii) > 0
    ),
})  # fmt: skip


@row.rare
def _(rng):
    for n in (3, 7):
        link_lengths, link_radii = rng.numbers(0.05, 0.5, 2, n)
        yield link_lengths, link_radii
        yield link_lengths, np.full(n, link_radii[0])
        for at in (0, int(rng.integers(1, n - 1)), n - 1):
            yield link_lengths, link_radii + 4.0 * (np.arange(n) == at)


@row.wrongs
def _(link_lengths, link_radii):
    """to-the-tip-only: only the last link counts; one before it may have a point that
      is farther => all link lengths, and link radius of the last
    own-link-only: only the joint's own link counts; what is behind it is carried along
      => link radius
    next-only: it ends at the next link => the larger of link radius and link length +
      link radius of the next
    from-the-base: it is how far from the base each link is; it is how far from joint i
      what is behind it is => link lengths before it + link radius
    offset-one-late: the link length is the next joint's: link_lengths[i] is from link i
      to the next => with link_lengths[i + 1]
    offset-of-the-last: the last link's link length is added; nothing is behind it => +
      link lengths of the last
    offset-of-the-last 2: the last link's link length counts as one more point; nothing
      is behind it => the larger of link radius and link length for the last
    offset-to-its-own: the link length is added to the joint's own link radius, too; it
      leads to the next joint => link length + the larger of link radius and the radius
      behind
    far-forgotten: only the link lengths are added: the links have a size of their own
    offsets-forgotten: the link lengths are missing: this is the largest link radius
      behind it
    all-summed: the link radius of all links behind it is added up; only one point is
      the farthest => link lengths and all link radii
    largest-far: the largest link radius of all stands at the end of the link lengths;
      it belongs to its own link
    least: it is the least; a bound is the largest
    not-in-a-row: what is behind the next link is forgotten: its radius is meant, not
      its link radius
    euclid: lengths are added as the sides of a right angle; stretched out they are in a
      row => root of the squares
    one-for-all: it is the largest of all for every joint
    backwards: it is from the tip to the base
    sum-from-the-base: link lengths are summed from the base to the joint, and link
      radius is added
    far-of-its-own: the link lengths end at the last link, and the link radius is the
      joint's own link's => link lengths behind it + its own link radius
    far-of-its-own 2: the link lengths end at the last link, and the link radius is the
      joint's own link's => all link lengths behind it + its own link radius
    forwards: it goes from the base outwards: what is behind a joint is on the other
      side => the larger of link radius and the link length before + the radius before
    less-the-base: the farthest point of the whole arm is measured from each joint; what
      is before a joint is not behind it => the largest of all, less the link lengths
      before
    less-the-base 2: the farthest point behind it is measured from the base => with the
      link lengths before it
    largest-far-behind: the largest link radius behind it stands at the last link; it
      belongs to its own link => all link lengths, and the largest link radius
    largest-far-behind 2: the largest link radius behind the next joint stands at the
      last link; it belongs to its own link
    own-offset-repeated: the joint's own link length is added once for each link; each
      link has its own => with link_lengths[i] for all
    offset-of-the-one-before: the link length is the previous joint's: link_lengths[i]
      is from link i to the next => with link_lengths[i - 1]
    far-of-the-next: link radius is the next link's, its own is forgotten => the larger
      of link radius of the next and link length + radius of the next
    own-left-out: its own link is left out: what is farthest may be on it
    own-or-tip: only its own link and the last one count; one between may be farther
    two-behind-only: only the next two links count
    sum-not-largest: link radius is added to the larger of link length and radius; the
      larger is to be taken of link radius, and of both others together
    largest-of-three: the largest of link radius, link length and the next one's radius
      is taken; the last two are added
    largest-far-next: the largest link radius is added to the link length; each link has
      its own => the larger of link radius and link length + largest link radius
    mean-not-largest: it is the mean over the links behind it; a bound is the largest
    offsets-alone: the larger of link radius and all link lengths behind it is taken
    last-link-forgotten: the last link's link radius is 0
    last-link-forgotten 2: the last link is not looked at => without link radius of the
      last
    offsets-to-the-end: all link lengths behind it, the last one's too, and link radius
      of the last
    offset-too-early: the link length after a link is added before its link radius =>
      link_lengths[i] to link_lengths[j] + link_radii[j]
    far-twice: its own link radius and that of the farthest are added
    """
    n = len(link_radii)
    right = distal_radii(link_lengths, link_radii)

    def behind(i, j):
        return link_lengths[i:j].sum()

    last = link_lengths.copy()
    late = np.append(link_lengths[1:], 0.0)

    def tip(i):
        return link_radii[i:].max(initial=0.0)

    def with_last():
        return np.array([max(last[i:n].sum() + link_radii[-1],
                             *(behind(i, j) + link_radii[j] for j in range(i, n)))
                         for i in range(n)])  # fmt: skip

    def with_end():
        reach = np.append(link_radii, 0.0)
        for i in range(n - 1, -1, -1):
            reach[i] = max(link_radii[i], link_lengths[i] + reach[i + 1])
        return reach[:-1]

    def to_its_own():
        reach = link_radii.copy()
        for i in range(n - 2, -1, -1):
            reach[i] = link_lengths[i] + max(link_radii[i], reach[i + 1])
        return reach

    def of(what):
        return np.array([what(i) for i in range(n)])

    def least():
        reach = link_radii.copy()
        for i in range(n - 2, -1, -1):
            reach[i] = min(link_radii[i], link_lengths[i] + reach[i + 1])
        return reach

    def forwards():
        reach = link_radii.copy()
        for i in range(1, n):
            reach[i] = max(link_radii[i], link_lengths[i - 1] + reach[i - 1])
        return reach

    def euclid():
        reach = link_radii.copy()
        for i in range(n - 2, -1, -1):
            reach[i] = max(link_radii[i], np.hypot(link_lengths[i], reach[i + 1]))
        return reach

    base = np.append(0.0, np.cumsum(link_lengths[:-1]))

    def largest(what, last=n):
        return of(
            lambda i: max([what(i, j) for j in range(i, last)], default=link_radii[i])
        )

    def turn_by_turn(what, end=link_radii[-1]):
        reach = np.append(link_radii[:-1], end)
        for i in range(n - 2, -1, -1):
            reach[i] = what(i, reach[i + 1])
        return reach

    return {
        "less-the-base": lambda: (base + link_radii).max() - base,
        "less-the-base 2": lambda: of(lambda i: (base + link_radii)[i:].max()),
        "largest-far-behind": lambda: of(lambda i: behind(i, n - 1) + tip(i)),
        "largest-far-behind 2": lambda: of(
            lambda i: max(link_radii[i], behind(i, n - 1) + tip(i + 1))
        ),
        "own-offset-repeated": lambda: (
            largest(lambda i, j: (j - i) * link_lengths[i] + link_radii[j])
        ),
        "offset-of-the-one-before": lambda: turn_by_turn(
            lambda i, next_: max(link_radii[i], link_lengths[i - 1] + next_)
        ),
        "far-of-the-next": lambda: turn_by_turn(
            lambda i, next_: max(link_radii[i + 1], link_lengths[i] + next_)
        ),
        "own-left-out": lambda: largest(
            lambda i, j: 0.0 if j == i else behind(i, j) + link_radii[j]
        ),
        "own-or-tip": lambda: of(
            lambda i: max(link_radii[i], behind(i, n - 1) + link_radii[-1])
        ),
        "two-behind-only": lambda: of(
            lambda i: max(
                behind(i, j) + link_radii[j] for j in range(i, min(i + 3, n))
            )
        ),
        "sum-not-largest": lambda: turn_by_turn(
            lambda i, next_: link_radii[i] + max(link_lengths[i], next_)
        ),
        "largest-of-three": lambda: turn_by_turn(
            lambda i, next_: max(link_radii[i], link_lengths[i], next_)
        ),
        "largest-far-next": lambda: of(
            lambda i: max(link_radii[i], link_lengths[i] + link_radii.max())
            if i < n - 1 else link_radii[i]
        ),
        "mean-not-largest": lambda: of(
            lambda i: np.mean([behind(i, j) + link_radii[j] for j in range(i, n)])
        ),
        "offsets-alone": lambda: of(
            lambda i: max(link_radii[i], link_lengths[i:].sum())
        ),
        "last-link-forgotten": lambda: turn_by_turn(
            lambda i, next_: max(link_radii[i], link_lengths[i] + next_), 0.0
        ),
        "last-link-forgotten 2": lambda: (
            largest(lambda i, j: behind(i, j) + link_radii[j], n - 1)
        ),
        "offsets-to-the-end": lambda: of(
            lambda i: link_lengths[i:].sum() + link_radii[-1]
        ),
        "offset-too-early": lambda: (
            largest(lambda i, j: link_lengths[i : j + 1].sum() + link_radii[j])
        ),
        "to-the-tip-only": lambda: of(lambda i: behind(i, n - 1) + link_radii[-1]),
        "own-link-only": lambda: link_radii.copy(),
        "next-only": lambda: of(
            lambda i: max(link_radii[i], link_lengths[i] + link_radii[i + 1])
            if i < n - 1 else link_radii[i]
        ),
        "from-the-base": lambda: of(lambda i: behind(0, i) + link_radii[i]),
        "offset-one-late": lambda: distal_radii(late, link_radii),
        "offset-of-the-last": with_last,
        "offset-of-the-last 2": with_end,
        "offset-to-its-own": to_its_own,
        "far-forgotten": lambda: of(lambda i: behind(i, n - 1)),
        "offsets-forgotten": lambda: of(lambda i: link_radii[i:].max()),
        "all-summed": lambda: of(lambda i: behind(i, n - 1) + link_radii[i:].sum()),
        "largest-far": lambda: of(lambda i: behind(i, n - 1) + link_radii.max()),
        "least": least,
        "not-in-a-row": lambda: (
            of(lambda i: link_radii[i] + (link_lengths[i] if i < n - 1 else 0.0))
        ),
        "euclid": euclid,
        "one-for-all": lambda: np.full(n, right.max()),
        "backwards": lambda: right[::-1].copy(),
        "sum-from-the-base": lambda: of(lambda i: behind(0, i + 1) + link_radii[i]),
        "far-of-its-own": lambda: of(lambda i: behind(i, n - 1) + link_radii[i]),
        "far-of-its-own 2": lambda: of(
            lambda i: link_lengths[i:].sum() + link_radii[i]
        ),
        "forwards": forwards,
        "far-twice": lambda: of(lambda i: link_radii[i] + right[i]),
    }  # fmt: skip


row.at_least_0(link_lengths="a length", link_radii="a length", answer="a length")


@row.right  # By the definition: the largest over all links behind.
def _(link_lengths, link_radii):
    n = len(link_radii)
    return np.array(
        [
            max(link_lengths[i:j].sum() + link_radii[j] for j in range(i, n))
            for i in range(n)
        ]
    )
