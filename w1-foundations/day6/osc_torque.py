"""6.3 `osc_torque(J, Lambda, bias, site_bias, acc)`: its questions and its mistakes."""

import numpy as np

from labkit.judge.row import Row
from robo47.checks import Array

from .states import (
    J_CASE,
    SWAP,
    TORQUE,
    model,
    some,
    states,
)

pinv, solve = np.linalg.pinv, np.linalg.solve

row = Row(TORQUE)


@row.inputs
def _(rng):
    case = (J_CASE, np.eye(6), np.arange(7.0), np.ones(6), np.ones(6))
    drawn = []
    for now in states(rng):
        J, _, Lambda = model(now)
        drawn.append((J, Lambda, some(rng, 20, 7), some(rng, 2, 6), some(rng, 3, 6)))
    J, Lambda, bias, drift, acc = drawn[0]
    asked = [
        (J, Lambda, bias, drift, np.zeros(6)),
        (J, Lambda, bias, drift, 30.0 * acc),  # more than the motors have
    ]
    return [case, *asked, *drawn]


def _elbow(J: Array) -> Array:
    """Return the joint speeds, of length 1, that leave the hand at rest."""
    return np.linalg.svd(J)[2][-1]


@row.wrong
def site_bias_forgotten(J, Lambda, bias, site_bias, acc):
    """site_bias is not taken away: the hand would accelerate by acc and by that too =>
    J^T Lambda acc + bias"""
    return J.T @ Lambda @ acc + bias


@row.wrong
def site_bias_added(J, Lambda, bias, site_bias, acc):
    """site_bias is added to acc; the hand has it already, so it is taken away => the
    right one with acc + site_bias"""
    return J.T @ Lambda @ (acc + site_bias) + bias


@row.wrong
def bias_forgotten(J, Lambda, bias, site_bias, acc):
    """bias is missing: the arm falls under its weight, and what speed does to it is not
    made up for => the right one without bias"""
    return J.T @ Lambda @ (acc - site_bias)


@row.wrong
def bias_sign(J, Lambda, bias, site_bias, acc):
    """bias is taken away; your torques have to hold it, so it is added => the right one
    with -bias"""
    return J.T @ Lambda @ (acc - site_bias) - bias


@row.wrong
def Lambda_left_out(J, Lambda, bias, site_bias, acc):
    """Lambda is missing: an acceleration is used as if it were a push => the right one
    with Lambda = I"""
    return J.T @ (acc - site_bias) + bias


@row.wrong
def Lambda_inverted(J, Lambda, bias, site_bias, acc):
    """Lambda is inverted: a heavy hand would get a small push => the right one with
    Lambda^-1"""
    return J.T @ solve(Lambda, acc - site_bias) + bias


@row.wrong
def Lambda_by_entries(J, Lambda, bias, site_bias, acc):
    """only the diagonal of Lambda is used; the six directions are coupled => the right
    one with Lambda's diagonal"""
    return J.T @ (np.diag(Lambda) * (acc - site_bias)) + bias


@row.wrong
def pinv_for_transpose(J, Lambda, bias, site_bias, acc):
    """pinv(J) takes the push to the joints; pushes go to torques with J^T, and the
    pseudo-inverse is for speeds => the right one with pinv(J)"""
    return pinv(J) @ Lambda @ (acc - site_bias) + bias


@row.wrong
def site_bias_not_weighed(J, Lambda, bias, site_bias, acc):
    """site_bias is taken away after Lambda: it is an acceleration, so it has to be
    taken from acc first => J^T (Lambda acc - site_bias) + bias"""
    return J.T @ (Lambda @ acc - site_bias) + bias


@row.wrong
def acc_sign(J, Lambda, bias, site_bias, acc):
    """the wanted acceleration is taken away from site_bias: the hand is pushed the
    other way, further and further from where it should be => the right one with
    site_bias - acc"""
    return J.T @ Lambda @ (site_bias - acc) + bias


@row.wrong
def bias_at_the_hand(J, Lambda, bias, site_bias, acc):
    """bias is subtracted within the brackets, at the hand; it is a torque of joints =>
    J^T (Lambda (acc - site_bias) + J bias)"""
    return J.T @ (Lambda @ (acc - site_bias) + J @ bias)


@row.wrong
def halves_swapped(J, Lambda, bias, site_bias, acc):
    """the accelerations are put in the order (linear; angular); the angular three come
    first => the right one with its halves swapped"""
    return J.T @ Lambda @ (acc - site_bias)[SWAP] + bias


@row.wrong
def gravity_twice(J, Lambda, bias, site_bias, acc):
    """bias is added twice => the right one with 2 bias"""
    return J.T @ Lambda @ (acc - site_bias) + 2.0 * bias


@row.right  # With einsum, and bias first.
def _(J, Lambda, bias, site_bias, acc):
    F = np.einsum("ij,j->i", Lambda, acc - site_bias)
    return bias + np.einsum("ij,i->j", J, F)
