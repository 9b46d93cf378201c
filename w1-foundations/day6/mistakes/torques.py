"""Mistakes in tasks 6.3 `osc_torque` and 6.4 `null_torque`."""

import numpy as np

from robo47.checks import Array

from . import named
from .inertias import SWAP

pinv, solve = np.linalg.pinv, np.linalg.solve


def _elbow(J: Array) -> Array:
    """Return the joint speeds, of length 1, that leave the hand at rest."""
    return np.linalg.svd(J)[2][-1]


OSC_TORQUE = [
    named(
        "site-bias-forgotten",
        "site_bias is not taken away: the hand would accelerate by acc and by that too",
        lambda J, L, b, s, a: J.T @ L @ a + b,
        "J^T Lambda acc + bias",
    ),
    named(
        "site-bias-added",
        "site_bias is added to acc; the hand has it already, so it is taken away",
        lambda J, L, b, s, a: J.T @ L @ (a + s) + b,
        "the right one with acc + site_bias",
    ),
    named(
        "bias-forgotten",
        "bias is missing: the arm falls under its weight, and what speed does to it is "
        "not made up for",
        lambda J, L, b, s, a: J.T @ L @ (a - s),
        "the right one without bias",
    ),
    named(
        "bias-sign",
        "bias is taken away; your torques have to hold it, so it is added",
        lambda J, L, b, s, a: J.T @ L @ (a - s) - b,
        "the right one with -bias",
    ),
    named(
        "Lambda-left-out",
        "Lambda is missing: an acceleration is used as if it were a push",
        lambda J, L, b, s, a: J.T @ (a - s) + b,
        "the right one with Lambda = I",
    ),
    named(
        "Lambda-inverted",
        "Lambda is inverted: a heavy hand would get a small push",
        lambda J, L, b, s, a: J.T @ solve(L, a - s) + b,
        "the right one with Lambda^-1",
    ),
    named(
        "Lambda-by-entries",
        "only the diagonal of Lambda is used; the six directions are coupled",
        lambda J, L, b, s, a: J.T @ (np.diag(L) * (a - s)) + b,
        "the right one with Lambda's diagonal",
    ),
    named(
        "pinv-for-transpose",
        "pinv(J) takes the push to the joints; pushes go to torques with J^T, and the "
        "pseudo-inverse is for speeds",
        lambda J, L, b, s, a: pinv(J) @ L @ (a - s) + b,
        "the right one with pinv(J)",
    ),
    named(
        "site-bias-not-weighed",
        "site_bias is taken away after Lambda: it is an acceleration, so it has to be "
        "taken from acc first",
        lambda J, L, b, s, a: J.T @ (L @ a - s) + b,
        "J^T (Lambda acc - site_bias) + bias",
    ),
    named(
        "acc-sign",
        "the wanted acceleration is taken away from site_bias: the hand is pushed the "
        "other way, further and further from where it should be",
        lambda J, L, b, s, a: J.T @ L @ (s - a) + b,
        "the right one with site_bias - acc",
    ),
    named(
        "bias-at-the-hand",
        "bias is subtracted within the brackets, at the hand; it is a torque of joints",
        lambda J, L, b, s, a: J.T @ (L @ (a - s) + J @ b),
        "J^T (Lambda (acc - site_bias) + J bias)",
    ),
    named(
        "halves-swapped",
        "the accelerations are put in the order (linear; angular); the angular three "
        "come first",
        lambda J, L, b, s, a: J.T @ L @ (a - s)[SWAP] + b,
        "the right one with its halves swapped",
    ),
    named(
        "gravity-twice",
        "bias is added twice",
        lambda J, L, b, s, a: J.T @ L @ (a - s) + 2.0 * b,
        "the right one with 2 bias",
    ),
]

NULL_TORQUE = [
    named(
        "another-projector",
        "it does not accelerate the hand either, but what you took away is no push at "
        "the hand: that would be J^T times a wrench, whose size Lambda knows",
        lambda J, M, L, t: M @ _elbow(J) * (_elbow(J) @ solve(M, t)),
        "M n n^T M^-1 tau",
    ),
    named(
        "acceleration",
        "this is an acceleration of the joints that the hand does not feel; M makes a "
        "torque of it",
        lambda J, M, L, t: solve(M, t - J.T @ L @ J @ solve(M, t)),
        "M^-1 times the right one",
    ),
    named(
        "not-projected",
        "tau is returned as it is: all of it reaches the hand",
        lambda J, M, L, t: t,
        "tau",
    ),
    named(
        "kinematic-projector",
        "I - J^+ J keeps speeds from the hand, not torques: how a torque accelerates "
        "the hand depends on the masses, so M is needed. It still draws the circle, "
        "and yet the hand is accelerated by metres per second squared",
        lambda J, M, L, t: t - pinv(J) @ (J @ t),
        "tau - J^+ J tau",
    ),
    named(
        "M-for-identity",
        "M stands where the identity belongs: M tau is no torque (its unit is kg m2 "
        "times Nm), so nothing can be taken away from it",
        lambda J, M, L, t: M @ t - J.T @ L @ J @ solve(M, t),
        "(M - J^T Lambda J M^-1) tau",
    ),
    named(
        "projector-transposed",
        "the projector is transposed: M^-1 J^T Lambda J is for joint accelerations; "
        "for torques M^-1 is on the other side",
        lambda J, M, L, t: t - solve(M, J.T @ L @ J @ t),
        "tau - M^-1 J^T Lambda J tau",
    ),
    named(
        "the-other-part",
        "this is what is to be taken away: the part that the hand feels",
        lambda J, M, L, t: J.T @ L @ J @ solve(M, t),
        "tau minus the right one",
    ),
    named(
        "added",
        "the part that the hand feels is added, so it feels it twice",
        lambda J, M, L, t: t + J.T @ L @ J @ solve(M, t),
        "the right one with a plus",
    ),
    named(
        "negative",
        "every sign is wrong: tau is taken away from the part that the hand feels",
        lambda J, M, L, t: J.T @ L @ J @ solve(M, t) - t,
        "minus the right one",
    ),
    named(
        "M-left-out",
        "M is missing: J tau is no acceleration of the hand, tau has to become one of "
        "the joints first",
        lambda J, M, L, t: t - J.T @ L @ J @ t,
        "tau - J^T Lambda J tau",
    ),
    named(
        "M-not-inverted",
        "M multiplies tau; torques become accelerations through M^-1",
        lambda J, M, L, t: t - J.T @ L @ J @ M @ t,
        "the right one with M for M^-1",
    ),
    named(
        "Lambda-left-out",
        "Lambda is missing: the hand's acceleration is used as if it were a push",
        lambda J, M, L, t: t - J.T @ J @ solve(M, t),
        "the right one with Lambda = I",
    ),
    named(
        "Lambda-inverted",
        "Lambda is inverted",
        lambda J, M, L, t: t - J.T @ solve(L, J @ solve(M, t)),
        "the right one with Lambda^-1",
    ),
    named(
        "pinv-for-transpose",
        "pinv(J) takes the push back to the joints; pushes go to torques with J^T",
        lambda J, M, L, t: t - pinv(J) @ L @ J @ solve(M, t),
        "the right one with pinv(J)",
    ),
    named(
        "pinv-of-transpose",
        "J^T and its pseudo-inverse stand in the order of a projector of pushes: "
        "I - J^T pinv(J^T) keeps speeds from the hand, not torques",
        lambda J, M, L, t: t - J.T @ pinv(J.T) @ t,
        "tau - J^T pinv(J^T) tau",
    ),
]
