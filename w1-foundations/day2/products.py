"""Mistakes in a product of exponentials, 2.6 and 2.8: in the product, in q or in M.

A mistake in one joint only is not listed here: `places` finds which one.
"""

from functools import partial, reduce

import numpy as np

from labkit.judge import Pose, Row
from labkit.judge.argument_mistakes import OF_ALL_JOINTS
from robo47 import se3

from . import places
from .exp_screw import NOT_OF_AN_ARM, motion


def space(screws, M, q):
    """Return e^[S1] q1 ... e^[S7] q7 M, whatever the screws are."""
    T = np.eye(4)
    for S, theta in zip(screws, q, strict=True):
        T = T @ motion(S, theta)
    return T @ M


def body(screws, M, q):
    """Return M e^[B1] q1 ... e^[B7] q7, whatever the screws are."""
    return M @ space(screws, np.eye(4), q)


# A joint's exponential by a wrong angle is the product at a wrong q.
ALIKE = ({"turns-backwards", "all-backwards"}, {"degrees-into-cos", "degrees"})
HIDDEN = {"pair-of-signs": "at q = 0 the Panda has no axis with an x"}


def product_row(fk, inputs):
    """Return the row of a product.

    Args:
        fk: the library's, which is slow for one arm and quick for many.
        inputs: generator of screws, M and q.
    """
    row = Row(
        Pose(wrong_way="maps world coordinates to end-effector coordinates"),
        truth=lambda S, M, q: fk(S[None], M, q[None])[0],
        alike=ALIKE,
        probe=places.alone(inputs),
        unnamed=places.unnamed,
        measured=places.measured,
    )
    row.inputs(inputs)
    return row


def with_M(form, T, M):
    """Return T M or M T, as the form, `space` or `body`, has it."""
    return T @ M if form is space else M @ T


def either_form(row, form):
    """Take the mistakes that both forms have: in the product, in q, M or one factor."""
    _in_the_product(row, form)
    row.of_argument("q", *OF_ALL_JOINTS)
    _in_M(row, form)
    row.reached_by(
        "exp_screw",
        "in every exponential, ",
        but=NOT_OF_AN_ARM,
        called={" of the rotation part in ": " of "},  # one place is enough
        hidden=HIDDEN,
    )


def _in_the_product(row, form):
    @row.wrongs
    def _(screws, M, q):
        """product-reversed: your code multiplies the exponentials in the reverse order.
          The exponential of the joint nearest to the base belongs on the left
        M-twice: your code multiplies by M on both sides of the exponentials. The
          product should contain M only once
        M-in-the-loop: your product contains M once per joint. The product should
          contain M only once
        multiplied-by-entries: your code multiplies the exponentials entry by entry. Use
          the matrix product instead
        multiplied-by-entries 2: your code multiplies the exponentials entry by entry.
          Use the matrix product instead
        """
        factors = [motion(S, theta) for S, theta in zip(screws, q, strict=True)]
        beside_M = [with_M(form, T, M) for T in factors]
        by_entries = np.prod(factors, axis=0)
        return {
            "product-reversed": lambda: form(screws[::-1], M, q[::-1]),
            "M-twice": lambda: M @ space(screws, M, q),
            "M-in-the-loop": reduce(np.matmul, beside_M),
            "multiplied-by-entries": with_M(form, by_entries, M),
            "multiplied-by-entries 2": with_M(form, np.eye(4) * by_entries, M),
        }

    @row.wrong
    def exponentials_summed(screws, M, q):
        """your result contains a single exponential of the sum of the twists. Multiply
        the exponentials instead, because e^(A + B) is in general not equal to e^A
        e^B"""
        V = q @ screws
        size = np.linalg.norm(V[:3]) or 1.0
        return with_M(form, motion(V / size, size), M)


def _in_M(row, form):
    @row.wrongs(hidden={"M-turned-back": "the Panda's M is symmetric"})
    def _(screws, M, q):
        """M-forgotten: your product omits M. The end-effector pose at q = 0 is M, so
          the product needs this factor
        M-inverted: your code inverts M. Use M itself, which maps end-effector
          coordinates to world coordinates
        M-twice: your product contains M twice. The product should contain M only once
        M-rotation-missing: your code uses only the translation of M. Multiply by the
          complete matrix M, which also contains a rotation
        M-turned-back: your code transposes the rotation matrix in M. Use M unchanged
        """
        used = {
            "M-forgotten": np.eye(4),
            "M-inverted": se3.inverse(M),
            "M-twice": M @ M,
            "M-rotation-missing": se3.make_T(np.eye(3), M[:3, 3]),
            "M-turned-back": se3.make_T(M[:3, :3].T, M[:3, 3]),
        }
        return {slug: partial(form, screws, x, q) for slug, x in used.items()}
