"""Mistakes in tasks 2.6 `fk_space` and 2.8 `fk_body`: a product of exponentials.

`redo` takes screws (n, 7, 6), M (n, 4, 4) and q (n, 7). A mistake in one joint only is
not listed here: `places` finds which one.
"""

from functools import reduce

import numpy as np

from labkit.judge.chain import product
from labkit.judge.matrices import pose, rigid_inverse, split, transposed
from labkit.judge.mistake import Mistake, lifted
from robo47.checks import Array

from .angles import in_the_angles
from .frames import adjoint
from .motions import OF_THE_FORMULA
from .moves import Function, factors, motion


def space(S: Array, M: Array, q: Array, step: Function = motion) -> Array:
    """Return e^[S1] q1 ... e^[S7] q7 M."""
    return product([*factors(step, S, q), M], len(q))


def body(B: Array, M: Array, q: Array, step: Function = motion) -> Array:
    """Return M e^[B1] q1 ... e^[B7] q7."""
    return product([M, *factors(step, B, q)], len(q))


def _summed(S: Array, q: Array) -> Array:
    """Return the exponential of the sum of all twists."""
    V = np.einsum("nij,ni->nj", S, q)
    size = np.linalg.norm(V[:, :3], axis=1)
    size = np.where(size > 0, size, 1.0)
    return motion(V / size[:, None], size)


def _by_entries(
    S: Array, M: Array, q: Array, before: bool, start: Array | float = 1.0
) -> Array:
    """Return the product by entries, and M before or after it."""
    X = reduce(np.multiply, factors(motion, S, q), start)
    return M @ X if before else X @ M


def _with_M_each(S: Array, M: Array, q: Array, before: bool) -> Array:
    """Return the product with M before or after each exponential."""
    steps = [M @ X if before else X @ M for X in factors(motion, S, q)]
    return product(steps, len(q))


def _only_added(S: Array, M: Array, q: Array) -> Array:
    """Return the product without M, moved by M's translation."""
    R, t = split(space(S, np.eye(4), q))
    return pose(R, t + split(M)[1])


def _shared(fk: Function, at_zero: str) -> list[Mistake]:
    """Return what can go wrong in either form."""
    return [
        Mistake(
            "product-reversed",
            "the exponentials stand in the reverse order: the joint nearest to the "
            "base belongs on the left",
            lambda S, M, q: fk(S[:, ::-1], M, q[:, ::-1]),
            "the product in reverse",
        ),
        *in_the_angles(fk, at_zero),
        Mistake(
            "M-forgotten",
            "M is missing: the motions are right, but they have to act on where the "
            "hand is at q = 0",
            lambda S, M, q: fk(S, np.eye(4), q),
            "the product without M",
        ),
        Mistake(
            "M-inverted",
            "M is inverted; it maps hand coordinates to the world as it is",
            lambda S, M, q: fk(S, rigid_inverse(M), q),
            "the product with the inverse of M",
        ),
        Mistake(
            "M-turned-back",
            "M's rotation is transposed",
            lambda S, M, q: fk(S, pose(transposed(split(M)[0]), split(M)[1]), q),
            "the product with that M",
        ),
        Mistake(
            "M-twice",
            "M stands on both sides of the exponentials",
            lambda S, M, q: M @ fk(S, np.eye(4), q) @ M,
            "the product with M twice",
        ),
        Mistake(
            "M-twice",
            "M is there twice, side by side",
            lambda S, M, q: fk(S, M @ M, q),
            "the product with M M for M",
        ),
        Mistake(
            "M-in-the-loop",
            "M is in the loop, beside every exponential: at q = 0 your pose is M seven "
            "times, not M",
            lambda S, M, q: _with_M_each(S, M, q, fk is body),
            "that product",
        ),
        Mistake(
            "M-rotation-missing",
            "M's rotation is missing; only its translation is there",
            lambda S, M, q: fk(S, pose(np.eye(3), split(M)[1]), q),
            "the product without it",
        ),
        Mistake(
            "exponentials-summed",
            "the twists are added up and exponentiated together; e^A e^B is e^(A + B) "
            "only where the order does not matter",
            lambda S, M, q: (
                fk(0.0 * S, M, q) @ _summed(S, q) if fk is body else _summed(S, q) @ M
            ),
            "the exponential of the sum",
        ),
        Mistake(
            "multiplied-by-entries",
            "the exponentials are multiplied entry by entry, not as matrices",
            lambda S, M, q: _by_entries(S, M, q, fk is body),
            "the product by entries",
        ),
        Mistake(
            "multiplied-by-entries",
            "the exponentials are multiplied entry by entry, not as matrices",
            lambda S, M, q: _by_entries(S, M, q, fk is body, np.eye(4)),
            "the product by entries, from the identity on",
        ),
        Mistake(
            "last-joint-missing",
            "the last joint does not count: the loop ends one too early",
            lambda S, M, q: fk(S[:, :-1], M, q[:, :-1]),
            "the product without it",
        ),
        Mistake(
            "first-joint-missing",
            "the first joint does not count: the loop starts one too late",
            lambda S, M, q: fk(S[:, 1:], M, q[:, 1:]),
            "the product without it",
        ),
        Mistake(
            "first-joint-only",
            "only the first joint counts (does return stand inside the loop?)",
            lambda S, M, q: fk(S[:, :1], M, q[:, :1]),
            "the product with joint1 alone",
        ),
        Mistake(
            "last-joint-only",
            "only the last joint counts: what the others do is overwritten",
            lambda S, M, q: fk(S[:, -1:], M, q[:, -1:]),
            "the product with joint7 alone",
        ),
    ]


def _carried_along(S: Array, M: Array, q: Array) -> Array:
    """Return the product in which each screw is moved by what is there so far."""
    T = np.broadcast_to(np.eye(4), (len(q), 4, 4))
    for k in range(q.shape[1]):
        T = T @ T @ motion(S[:, k], q[:, k]) @ rigid_inverse(T)
    return T @ M


FK_SPACE = [
    Mistake(
        "M-first",
        "M stands on the left of the exponentials; the screws are told in the world, "
        "so their motions act on M from the left",
        body,
        "the product with M first",
    ),
    *_shared(space, "M, the one at q = 0"),
    Mistake(
        "M-only-added",
        "M's translation is added and its rotation is missing; the pose has to be "
        "multiplied by all of M",
        _only_added,
        "the product with t of M added",
    ),
    Mistake(
        "screws-moved-along",
        "each screw is carried along by the joints before it; the product does that "
        "already, so the screws of q = 0 are all it needs",
        _carried_along,
        "that product",
    ),
    Mistake(
        "space-screws-in-body-form",
        "the screws are taken to the hand's frame, but the product is still that of "
        "the world's",
        lambda S, M, q: space(S @ transposed(adjoint(rigid_inverse(M))), M, q),
        "that product",
    ),
    *lifted(
        OF_THE_FORMULA,
        "in every exponential, ",
        lambda redo: lambda S, M, q: space(S, M, q, redo),
    ),
]

FK_BODY = [
    Mistake(
        "M-last",
        "M stands on the right of the exponentials (or the screws are converted, and "
        "they are the hand's already); motions told in the hand's frame follow M",
        space,
        "the product with M last",
    ),
    Mistake(
        "motions-on-the-left",
        "each new exponential is put on the left of what is there; these screws are "
        "told in the hand's frame, so it goes on the right",
        lambda B, M, q: space(B[:, ::-1], M, q[:, ::-1]),
        "the product so put together",
    ),
    *_shared(body, "M, the one at q = 0"),
    *lifted(
        OF_THE_FORMULA,
        "in every exponential, ",
        lambda redo: lambda B, M, q: body(B, M, q, redo),
    ),
]
