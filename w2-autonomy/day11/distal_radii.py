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
    "arms whose farthest point is on a link between them": (
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
    """to-the-tip-only: your code bounds only the points of the last link. Take the
      maximum over all distal links, because a point on an earlier link can be farther
      from the joint
    own-link-only: your code uses only the joint's own link for the bound. Take the
      maximum over the distal links too, because the joint also moves these links
    next-only: your code uses the radius of the next link and ignores the links after
      it. Include these links too, because the joint also moves them
    from-the-base: your code measures the distances from the base. Measure the distances
      from joint i to its distal links instead, and take the maximum
    offset-one-late: for joint i, your code uses `link_lengths[i + 1]`. Use
      `link_lengths[i]` instead, the distance from link i to the next link
    offset-of-the-last: your code adds the last entry of `link_lengths`. Omit this
      entry, because no link follows the last link
    offset-of-the-last 2: your code includes a point at the distance of the last entry
      of `link_lengths` from the last link. Omit this entry, because no link follows the
      last link
    offset-to-its-own: your code adds the link length to the radius of the joint's own
      link. Add this length only for the links after the joint's own link
    far-forgotten: your code omits `link_radii`, so the bound contains only link
      lengths. Add the radius of each link to the distance to that link, and then take
      the maximum
    offsets-forgotten: your code omits `link_lengths`, so each bound is only a link
      radius. Add the lengths between the joint and each distal link before you take the
      maximum
    all-summed: your code adds the radii of all distal links. Add the radius of each
      link to the distance to that link instead, and then take the maximum
    largest-far: your code adds the largest link radius of the arm to the distance to
      the last link. Add the radius of each link to the distance to that link, and then
      take the maximum
    least: your code takes the minimum over the distal links. Take the maximum instead,
      because the bound must hold for every distal point
    not-in-a-row: your code adds the link length to the radius of the joint's own link.
      Add the link length to the bound of the next joint instead, and then take the
      maximum of this sum and the radius
    euclid: your code takes the square root of a sum of squared lengths. Add the lengths
      themselves instead, because their sum is the distance when the arm is fully
      stretched
    one-for-all: your code returns the largest bound for every joint. Each joint should
      have its own bound
    backwards: your code returns the bounds in reverse order. The first bound belongs to
      joint 1
    sum-from-the-base: your code sums the link lengths from the base to the end of the
      joint's own link. For each distal link, add its radius to the link lengths from
      the joint to this link instead, and then take the maximum
    far-of-its-own: your code adds the radius of the joint's own link to the sum of all
      distal link lengths. Add the radius of each link to the distance to that link, and
      then take the maximum
    far-of-its-own 2: your code adds the radius of the joint's own link to the sum of
      all distal link lengths, including the last entry of `link_lengths`. Add the
      radius of each link to the distance to that link, and then take the maximum
    forwards: your code uses the links between the base and the joint for the bound. Use
      the links distal to the joint instead, because the joint moves these links
    less-the-base: your code uses the farthest point of the whole arm for every joint.
      For each joint, use only the links that the joint moves
    less-the-base 2: your code measures the distance to the farthest distal point from
      the base. Measure this distance from the joint instead
    largest-far-behind: your code adds the largest distal radius to the distance to the
      last link. Add the radius of each link to the distance to that link, and then take
      the maximum
    largest-far-behind 2: your code adds the largest radius of the links after the
      joint's own link to the distance to the last link. Add the radius of each link to
      the distance to that link, and then take the maximum
    own-offset-repeated: your code uses the length of the joint's own link for every
      distal link. Use the length of each link instead
    offset-of-the-one-before: for joint i, your code uses `link_lengths[i - 1]`. Use
      `link_lengths[i]` instead, the distance from link i to the next link
    far-of-the-next: your code uses the radius of the next link as the radius of the
      joint's own link. Use the radius of the joint's own link
    own-left-out: your code omits the joint's own link. Include this link, because the
      farthest point can be on the joint's own link
    own-or-tip: your code uses only the joint's own link and the last link for the
      bound. Include all links between them, because a point on one of these links can
      be farther from the joint
    two-behind-only: your code uses only the joint's own link and the next two links for
      the bound. Include all distal links, because the joint moves all of them
    sum-not-largest: your code adds the link radius to the maximum of the link length
      and the next joint's bound. Add the link length to the next joint's bound first,
      and then take the maximum of this sum and the link radius
    largest-of-three: your bound is only the largest single radius or length of the
      distal links. Add the lengths between the joint and each link to the radius of
      that link before you take the maximum
    largest-far-next: your code adds the largest link radius to the link length. Add the
      bound of the next joint to the link length instead
    mean-not-largest: your code takes the mean over the distal links. Take the maximum
      instead, because the bound must hold for every distal point
    offsets-alone: your code takes the maximum of the link radius and the sum of the
      link lengths. Before you take the maximum, add the radius of each distal link to
      the distance to that link
    last-link-forgotten: your code treats the radius of the last link as 0. Use the last
      entry of `link_radii`
    last-link-forgotten 2: your code omits the last link. Include this link, because the
      farthest point of the arm can be on the last link
    offsets-to-the-end: your code adds the link lengths from the joint on, including the
      last entry, to the radius of the last link. Omit the last entry, and take the
      maximum over all distal links
    offset-too-early: your code adds `link_lengths[j]` to the radius of link j itself.
      Add this length only for the links after link j
    far-twice: your code adds the radius of the joint's own link to the bound. Take the
      maximum of this radius and the distances to points on the distal links instead
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
