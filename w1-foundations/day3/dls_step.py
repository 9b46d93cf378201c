"""3.5 `dls_step(J, e, damping)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Vector, draw
from labkit.judge.row import Row
from robo47.jacobian import dls_step

from .jacobians import JOINTS, UNIT, near_singular, site_jacobians

I6 = np.eye(6)
pinv, solve = np.linalg.pinv, np.linalg.solve


def _without_damping(rng):
    J = site_jacobians(draw.configurations(rng, 3))
    e = draw.numbers(rng, -1, 1, 3, 6)
    return [(J[i], e[i], 0.0) for i in range(3)]


AT_NO_DAMPING = HeldOut(
    "zero-without-damping",
    "Right, but with damping 0 it returns zeros. There the formula is the plain "
    "pseudo-inverse's step, which step 6 of the lab takes.",
    _without_damping,
    mistaken=lambda J, e, damping: np.zeros(7),
)
row = Row(Vector((7,), "rad", names=JOINTS), held_out=[AT_NO_DAMPING])


@row.inputs
def _(rng):
    e = draw.numbers(rng, -0.5, 0.5, 9, 6)
    damping = [0.05, 0.02, 0.1, 0.3, 0.5, 2.0, 0.01, 0.0002, 0.7]
    first = (UNIT, np.arange(1.0, 7.0) / 10, 1.0)
    return [first, *zip(near_singular(rng), e, damping, strict=True)]


@row.wrong
def relative_damping(J, e, damping):
    """the damping is multiplied by J's largest singular value; it is a number of its
    own, in the units of J => the right one with damping ||J||"""
    return dls_step(J, e, damping * np.linalg.norm(J, 2))


def weighted(J, e, weight):
    """Return the step with a weight for each singular value."""
    U, s, Vt = np.linalg.svd(J, full_matrices=False)
    return Vt.T @ (weight(s) * (U.T @ e))


@row.wrong
def damping_not_squared(J, e, damping):
    """the damping is not squared => the step with damping I"""
    return J.T @ solve(J @ J.T + damping * I6, e)


@row.wrong
def damping_dropped(J, e, damping):
    """there is no damping in it: this is the plain pseudo-inverse, which is huge near a
    singularity => the step of the pseudo-inverse"""
    return pinv(J) @ e


@row.wrong
def damping_doubled(J, e, damping):
    """the damping is multiplied by 2, not by itself => the step with 2 damping I"""
    return J.T @ solve(J @ J.T + damping * 2 * I6, e)


@row.wrong
def damping_halved(J, e, damping):
    """half of the squared damping is added, not all of it => the step with half of
    it"""
    return J.T @ solve(J @ J.T + damping**2 / 2 * I6, e)


@row.wrong
def damping_everywhere(J, e, damping):
    """damping^2 is added to every entry of J J^T; it belongs on the diagonal only =>
    the step with damping^2 in every entry"""
    return J.T @ solve(J @ J.T + damping**2, e)


@row.wrong
def transpose_only(J, e, damping):
    """this is J^T e: the inverse is missing, so the step has the wrong length and
    direction => J^T e"""
    return J.T @ e


@row.wrong
def identity_scaled(J, e, damping):
    """this is J^T e over damping^2: J J^T is left out => J^T e / damping^2"""
    return J.T @ e / damping**2


@row.wrong
def pseudo_inverse_scaled(J, e, damping):
    """the plain step is divided by 1 + damping^2; damping changes the directions near a
    singularity most => the plain step over 1 + damping^2"""
    return pinv(J) @ e / (1 + damping**2)


@row.wrong
def damping_squared_twice(J, e, damping):
    """the damping is squared twice: its fourth power is added => the step with
    damping^4 I"""
    return J.T @ solve(J @ J.T + damping**4 * I6, e)


@row.wrong
def damping_fixed(J, e, damping):
    """the damping is 0.05 whatever the argument says => the step with damping 0.05"""
    return J.T @ solve(J @ J.T + 0.05**2 * I6, e)


@row.wrong
def damping_added_to_the_values(J, e, damping):
    """the damping is added to each singular value s, 1 / (s + damping); the formula
    makes s / (s^2 + damping^2) of it => the step with 1 / (s + damping)"""
    return weighted(J, e, lambda s: 1 / (s + damping))


@row.wrong
def singular_value_missing(J, e, damping):
    """the weights are 1 / (s^2 + damping^2) for the singular values s: J^T in front
    puts one more s above => the step with 1 / (s^2 + damping^2)"""
    return weighted(J, e, lambda s: 1 / (s**2 + damping**2))


@row.wrong("zero-without-damping", hidden="step 6 checks nothing")
def _(J, e, damping):
    return dls_step(J, e, damping) if damping else np.zeros(7)


@row.wrong("raises")  # Minus: with J = [I 0] and damping 1 nothing is left to invert.
def _(J, e, damping):
    return J.T @ solve(J @ J.T - damping**2 * I6, e)
