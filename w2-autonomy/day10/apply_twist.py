"""10.6 `apply_twist(T, xi)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row, rounded
from labkit.judge.argument_mistakes import Change
from robo47.camera import apply_twist
from robo47.screws import skew

row = Row(Pose())


@row.inputs
def _(rng):
    T = rng.poses(10)
    xi = [*rng.numbers(-2, 2, 4, 6), rng.numbers(-0.2, 0.2, 6)]
    small = rounded(1e-3 * rng.normal(size=(2, 6)))
    slide = np.append(np.zeros(3), rng.numbers(-1, 1, 3))
    turn = np.append(rng.numbers(-1, 1, 3), np.zeros(3))
    far = np.append(
        [1e-4, -2e-4, 2e-4], rng.numbers(-1, 1, 3)
    )  # nearly a pure translation
    some = [*xi, *small, slide, turn, far]
    first = (np.eye(4), np.eye(6)[3])
    return [first, *zip(T, some, strict=True), (T[0], np.zeros(6))]


def angle_in(low, high):
    """Return the case of twists whose angle lies between two limits."""
    return lambda T, xi: low < float(np.linalg.norm(xi[:3])) <= high


row.cases({
    "twists without a rotation": lambda T, xi: not xi[:3].any(),
    "rotations by less than 0.02 rad": angle_in(0.0, 0.02),
    "rotations by 0.02 to 0.5 rad": angle_in(0.02, 0.5),
    "rotations by more than 0.5 rad": angle_in(0.5, np.inf),
})  # fmt: skip


@row.rare
def _(rng):
    ((T),) = rng.poses(1)
    way = rng.numbers(-1, 1, 6)
    for size in (1e-3, 0.01, 0.02, 0.2, 2.0):
        yield T, size * way
    yield T, np.append(np.zeros(3), way[3:])


def exp_of(xi):
    """Return exp([xi])."""
    return apply_twist(np.eye(4), xi)


@row.wrongs
def _(T, xi):
    """on-the-right: your code computes T exp([xi]). Compute exp([xi]) T instead,
      because the twist xi is expressed in the frame in which T is given
    apart: your code rotates R and adds v to t. Multiply T by the whole exponential
      instead, because a rotation about the origin also moves t
    first-order: your code returns T + [xi] T, which is a rigid transform only if omega
      is 0. Return exp([xi]) T instead
    t-not-turned: your code does not rotate t. Multiply T by the whole exponential
      instead, because a rotation about the origin also moves t
    v-as-translation: your code uses v as the translation of the exponential, which is
      correct only if omega is 0 or parallel to v. Use the translation of the matrix
      exponential instead
    length-lost: your code divides xi by the norm of omega, or by the norm of v if omega
      is 0. A rotation then has the angle 1 rad. The rotation angle should be the norm
      of omega
    slides-left-out: your code returns T unchanged if omega is 0. Translate T by v
      instead
    identity-where-still: your code returns the identity matrix for xi = 0. Return T
      instead
    turns-only: your result does not depend on v, the linear part of xi. Use the
      exponential of the whole twist
    slides-only: your result does not depend on omega, the angular part of xi. Use the
      exponential of the whole twist
    """
    E = exp_of(xi)
    W = np.zeros((4, 4))
    W[:3, :3] = skew(xi[:3])
    W[:3, 3] = xi[3:]
    apart = T.copy()
    apart[:3, :3] = E[:3, :3] @ T[:3, :3]
    beside = apart.copy()
    apart[:3, 3] = T[:3, 3] + xi[3:]
    beside[:3, 3] = T[:3, 3] + E[:3, 3]
    plain = E.copy()
    plain[:3, 3] = xi[3:]
    w = np.linalg.norm(xi[:3]) or np.linalg.norm(xi[3:]) or 1.0
    return {
        "on-the-right": T @ E,
        "apart": apart,
        "first-order": T + W @ T,
        "t-not-turned": beside,
        "v-as-translation": plain @ T,
        "length-lost": exp_of(xi / w) @ T,
        "slides-left-out": E @ T if xi[:3].any() else T,
        "identity-where-still": E @ T if xi.any() else E,
        "turns-only": exp_of(np.append(xi[:3], np.zeros(3))) @ T,
        "slides-only": exp_of(np.append(np.zeros(3), xi[3:])) @ T,
    }


row.of_argument(
    "xi",
    Change(
        "unit-screw",
        "your code divides xi by its norm. The rotation angle should be the norm of "
        "omega itself",
        lambda xi: xi / (np.linalg.norm(xi) or 1.0),
    ),
)


@row.right  # exp(xi) = exp(xi / 1024)^1024, with a series of 12 terms.
def _(T, xi):
    W = np.zeros((4, 4))
    W[:3, :3] = skew(xi[:3] / 1024)
    W[:3, 3] = xi[3:] / 1024
    E = term = np.eye(4)
    for k in range(1, 13):
        term = term @ W / k
        E = E + term
    for _ in range(10):
        E = E @ E
    return E @ T
