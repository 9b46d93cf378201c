"""6.3 `osc_torque(J_site, Lambda, bias, bias_acc, acc)`: questions, mistakes."""

import numpy as np

from labkit.judge import Row

from .states import J_CASE, SWAP, TORQUE, model, some, states

pinv, solve = np.linalg.pinv, np.linalg.solve

row = Row(TORQUE)


@row.inputs
def _(rng):
    case = (J_CASE, np.eye(6), np.arange(7.0), np.ones(6), np.ones(6))
    drawn = []
    for now in states(rng):
        J, _, Lambda = model(now)
        drawn.append((J, Lambda, some(rng, 20, 7), some(rng, 2, 6), some(rng, 3, 6)))
    J, Lambda, bias, bias_acc, acc = drawn[0]
    asked = [
        (J, Lambda, bias, bias_acc, np.zeros(6)),
        (J, Lambda, bias, bias_acc, 30.0 * acc),  # more than the motors have
    ]
    return [case, *asked, *drawn]


@row.wrongs
def _(J, Lambda, bias, bias_acc, acc):
    """site-bias-forgotten: bias_acc is not taken away: the hand would accelerate by
      acc and by that too => J^T Lambda acc + bias
    site-bias-added: bias_acc is added to acc; the hand has it already, so it is taken
      away => the right one with acc + bias_acc
    bias-forgotten: bias is missing: the arm falls under its weight, and what speed does
      to it is not made up for => the right one without bias
    bias-sign: bias is taken away; your torques have to hold it, so it is added => the
      right one with -bias
    Lambda-left-out: Lambda is missing: an acceleration is used as if it were a push
    Lambda-inverted: Lambda is inverted: a heavy hand would get a small push => the
      right one with Lambda^-1
    Lambda-by-entries: only the diagonal of Lambda is used; the six directions are
      coupled => the right one with Lambda's diagonal
    pinv-for-transpose: pinv(J) takes the push to the joints; pushes go to torques with
      J^T, and the pseudo-inverse is for speeds => the right one with pinv(J)
    site-bias-not-weighed: bias_acc is taken away after Lambda: it is an acceleration,
      so it has to be taken from acc first => J^T (Lambda acc - bias_acc) + bias
    acc-sign: the wanted acceleration is taken away from bias_acc: the hand is pushed
      the other way, further and further from where it should be => the right one with
      bias_acc - acc
    bias-at-the-hand: bias is subtracted within the brackets, at the hand; it is a
      torque of joints => J^T (Lambda (acc - bias_acc) + J bias)
    halves-swapped: the accelerations are put in the order (linear; angular); the
      angular three come first => the right one with its halves swapped
    gravity-twice: bias is added twice => the right one with 2 bias
    """
    own = acc - bias_acc
    push = J.T @ Lambda @ own
    return {
        "site-bias-forgotten": J.T @ Lambda @ acc + bias,
        "site-bias-added": J.T @ Lambda @ (acc + bias_acc) + bias,
        "bias-forgotten": push,
        "bias-sign": push - bias,
        "Lambda-left-out": J.T @ own + bias,
        "Lambda-inverted": J.T @ solve(Lambda, own) + bias,
        "Lambda-by-entries": J.T @ (np.diag(Lambda) * own) + bias,
        "pinv-for-transpose": pinv(J) @ Lambda @ own + bias,
        "site-bias-not-weighed": J.T @ (Lambda @ acc - bias_acc) + bias,
        "acc-sign": bias - push,
        "bias-at-the-hand": push + J.T @ J @ bias,
        "halves-swapped": J.T @ Lambda @ own[SWAP] + bias,
        "gravity-twice": push + 2.0 * bias,
    }


@row.right  # With einsum, and bias first.
def _(J, Lambda, bias, bias_acc, acc):
    F = np.einsum("ij,j->i", Lambda, acc - bias_acc)
    return bias + np.einsum("ij,i->j", J, F)


row.spans(  # as small, or as large, as in the lab
    Lambda=(lambda Lambda: 3 * Lambda,),
    bias_acc=(lambda bias_acc: 1e-07 * bias_acc,),
    acc=(lambda acc: 0.003 * acc,),
)
