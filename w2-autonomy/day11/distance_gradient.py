"""11.5 `distance_gradient(J_space, p, o, link)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from labkit.judge.argument_mistakes import HALVES_SWAPPED
from robo47 import panda
from robo47.distance import distance_gradient
from robo47.jacobian import space_jacobian

JOINTS = tuple(f"joint{i}" for i in range(1, 8))
row = Row(
    Vector((7,), "m/rad", names=JOINTS),
    at_edge=lambda J_space, p, o, link: bool(np.linalg.norm(p - o) > 1e-3),
)
row.of_argument("J_space", HALVES_SWAPPED)


@row.inputs
def _(rng):
    first = np.zeros((6, 7))
    first[2, 0] = 1.0  # a joint at the origin, about z
    case = (first, np.array([1.0, 0, 0]), np.array([1.0, 1, 0]), 1)
    screws = panda.screws(panda.load("panda_nohand"))
    drawn = []
    for link, q in zip((7, 1, 4, 2, 6, 3, 7, 5), rng.configurations(8), strict=True):
        J = np.round(space_jacobian(screws, q), 6)
        p = rng.numbers(-0.6, 0.6, 3)
        o = np.round(p + rng.numbers(0.05, 0.4, 3) * rng.choice([-1.0, 1.0], 3), 3)
        drawn.append((J, p, o, link))
    return [case, *drawn]


row.cases({
    "Jacobians with omega = 0 in every column": (
        lambda J_space, p, o, link: not J_space[:3].any()
    ),
    "Jacobians with v = 0 in every column": (
        lambda J_space, p, o, link: not J_space[3:].any()
    ),
    "Jacobians with omega and v": (
        lambda J_space, p, o, link: bool(J_space[:3].any() and J_space[3:].any())
    ),
})  # fmt: skip
row.cases({
    "points p and o that are 1 m apart": (
        lambda J_space, p, o, link: abs(np.linalg.norm(p - o) - 1) < 1e-12
    ),
    "points p and o that are not 1 m apart": (
        lambda J_space, p, o, link: abs(np.linalg.norm(p - o) - 1) >= 1e-12
    ),
})  # fmt: skip
row.cases({
    "the last link": lambda J_space, p, o, link: link == 7,
    "links before the last one": lambda J_space, p, o, link: link < 7,
})  # fmt: skip


@row.rare
def _(rng):
    half = np.repeat([1.0, 0.0], 3)[:, None]
    for part in (half, 1 - half, 1.0):
        J = part * rng.numbers(-1, 1, 6, 7)
        p, link = rng.numbers(-0.6, 0.6, 3), int(rng.integers(1, 8))
        yield J, p, np.round(p + rng.numbers(0.05, 0.4, 3), 3), link
        yield J, p, p + np.eye(3)[int(rng.integers(3))], link
        yield J, p, np.round(p - rng.numbers(0.05, 0.4, 3), 3), 7


row.spans(
    o=(lambda o: o + 10.0,),
)


@row.spans
def _(rng):
    J = np.round(rng.numbers(-1, 1, 6, 7), 3)
    p = rng.numbers(-0.6, 0.6, 3)
    yield J, p, p + np.array([3e-4, -4e-4, 2e-4]), 6


@row.wrongs
def _(J_space, p, o, link):
    """towards-the-obstacle: your code negates the gradient. Use the unit vector along
      `p - o`, because the distance increases if p moves along `p - o`
    columns-behind-kept: your code also computes entries for the joints distal to the
      link. Set these entries to 0, because these joints do not move the link
    own-joint-left-out: your code sets the entry for the link's own joint to 0. Include
      this joint, because it also moves the link
    one-column-too-many: your code also computes an entry for joint `link + 1`. Set this
      entry to 0, because that joint does not move the link
    from-the-link-on: your code uses the link's own joint and the joints distal to it.
      Use joints 1 to `link` instead
    first-joint-left-out: your code sets the entry for joint 1 to 0. Include joint 1,
      because it moves every link
    own-joint-only: your code computes only the entry for the link's own joint. Include
      joints 1 to `link`, because all of them move the link
    columns-before-dropped: your code uses the joints distal to the link. Use joints 1
      to `link` instead
    rotation-forgotten: your gradient does not depend on omega. Add the term omega x p,
      because the velocity of p is v + omega x p
    rotation-only: your gradient omits v. Add this term, because the velocity of p is v
      + omega x p
    cross-the-other-way: your gradient contains omega x p with the wrong sign. Use omega
      x p and not p x omega, because the velocity of p is v + omega x p
    normal-not-unit: your gradient contains an extra factor, the distance. Divide `p -
      o` by its norm, because the direction should be a unit vector
    normal-squared: your gradient contains an extra factor, 1 divided by the distance.
      Divide `p - o` by its norm only once
    half: your code multiplies the gradient by 1/2. Omit this factor
    normal-of-p: your code uses the unit vector from the world origin to p. Use the unit
      vector from o to p instead
    normal-of-o: your code uses the unit vector from the world origin to o. Use the unit
      vector from o to p instead
    only-along-z: your code uses only the z component of the velocity of p. Project the
      velocity onto the unit vector along `p - o` instead
    not-projected: your code returns the speed of p for each joint. Return the component
      of the velocity along `p - o` instead
    size-only: your code returns the absolute value of each entry. Keep the signs,
      because an entry is negative if the distance decreases as the joint angle
      increases
    parts-added: your code divides `p - o` by the sum of its absolute components. Divide
      `p - o` by its norm instead
    largest-part: your code divides `p - o` by its largest absolute component. Divide `p
      - o` by its norm instead
    two-directions: your code normalises p and o separately. Normalise `p - o` instead
    parts-summed: your code adds the absolute values of the velocity components. Project
      the velocity onto the unit vector along `p - o` instead
    summed-up: your code returns cumulative sums over the joints. Return the derivative
      with respect to each joint angle separately
    one-place-early: your code places each entry one position too early. The first entry
      belongs to joint 1
    one-place-late: your code places each entry one position too late. The first entry
      belongs to joint 1
    backwards: your code uses the columns of `J_space` in reverse order. The first
      column belongs to joint 1
    backwards 2: your code returns the entries of the joints up to the link in reverse
      order. The first entry belongs to joint 1
    own-length: your code normalises the gradient. Return the gradient itself
    of-the-square: your code returns the gradient of the squared distance. Return the
      gradient of the distance itself
    """
    n = (p - o) / np.linalg.norm(p - o)
    w, v = J_space[:3].T, J_space[3:].T
    mask = np.arange(7) < link
    velocity = v + np.cross(w, p)
    right = velocity @ n * mask
    d = np.linalg.norm(p - o)
    alone = np.zeros(7)
    alone[link - 1] = right[link - 1]

    def to(x):
        return x / np.linalg.norm(x)

    return {
        "towards-the-obstacle": -right,
        "columns-behind-kept": velocity @ n,
        "own-joint-left-out": lambda: right * (np.arange(7) < link - 1),
        "one-column-too-many": lambda: velocity @ n * (np.arange(7) <= link),
        "first-joint-left-out": lambda: right * (np.arange(7) > 0),
        "from-the-link-on": lambda: velocity @ n * (np.arange(7) >= link - 1),
        "own-joint-only": alone,
        "columns-before-dropped": velocity @ n * ~mask,
        "rotation-forgotten": v @ n * mask,
        "rotation-only": lambda: np.cross(w, p) @ n * mask,
        "cross-the-other-way": lambda: (v - np.cross(w, p)) @ n * mask,
        "normal-not-unit": right * d,
        "normal-squared": right / d,
        "half": right / 2,
        "normal-of-p": lambda: velocity @ to(p) * mask,
        "normal-of-o": lambda: velocity @ to(o) * mask,
        "only-along-z": lambda: velocity[:, 2] * np.sign(n[2]) * mask,
        "not-projected": lambda: np.linalg.norm(velocity, axis=1) * mask,
        "size-only": lambda: np.abs(right),
        "parts-added": lambda: right * d / np.abs(p - o).sum(),
        "largest-part": lambda: right * d / np.abs(p - o).max(),
        "two-directions": lambda: velocity @ (to(p) - to(o)) * mask,
        "parts-summed": lambda: np.abs(velocity).sum(axis=1) * mask,
        "summed-up": lambda: np.cumsum(right) * mask,
        "one-place-early": lambda: np.roll(right, -1),
        "one-place-late": lambda: np.roll(right, 1),
        "backwards": (velocity @ n)[::-1] * mask,
        "backwards 2": lambda: np.append(right[:link][::-1], np.zeros(7 - link)),
        "own-length": lambda: to(right),
        "of-the-square": 2 * d * right,
    }


@row.right  # With the lever at o: p - o is along n, so it makes no difference.
def _(J_space, p, o, link):
    n = (p - o) / np.linalg.norm(p - o)
    S = np.block([[-np.array([[0, -o[2], o[1]], [o[2], 0, -o[0]], [-o[1], o[0], 0]]),
                   np.eye(3)]])  # fmt: skip
    slope = n @ S @ J_space
    slope[link:] = 0.0
    return slope


@row.right  # The moment of n about the origin, times omega.
def _(J_space, p, o, link):
    n = (p - o) / np.linalg.norm(p - o)
    return np.append(np.cross(p, n), n) @ J_space * (np.arange(1, 8) <= link)


row.at_least_0(link="a count")


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Nearer than 1 mm there is no slope.
def _(J_space, p, o, link):
    if np.linalg.norm(p - o) < 1e-3:
        return np.zeros(7)
    return distance_gradient(J_space, p, o, link)
