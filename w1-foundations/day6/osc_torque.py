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
    """bias-sign: your code subtracts `bias`. Add `bias` instead, because the motors
      must supply this torque even at zero acceleration
    pinv-for-transpose: your result contains pinv(J) times the wrench. Use J^T instead,
      because J^T maps wrenches to torques
    site-bias-not-weighed: your wrench is Lambda acc - bias_acc. It should be Lambda
      (acc - bias_acc), because `bias_acc` is an acceleration
    acc-sign: in your result, the torque for `acc - bias_acc` has the wrong sign, as if
      it were computed from `bias_acc - acc` or subtracted from `bias`. Add the torque
      for `acc - bias_acc` to `bias`
    force-alone: your code applies only the force and omits the moment. Use all six
      columns of J^T, because the first three belong to the moment
    halves-swapped: your code uses accelerations in the order (linear; angular). The
      angular part should come first
    bias-at-the-hand: your result contains J^T J times `bias`. Add `bias` unchanged
      instead, because it is already a joint torque
    """
    own = acc - bias_acc
    push = J.T @ Lambda @ own
    return {
        "bias-sign": push - bias,
        "pinv-for-transpose": pinv(J) @ Lambda @ own + bias,
        "site-bias-not-weighed": J.T @ (Lambda @ acc - bias_acc) + bias,
        "acc-sign": bias - push,
        "force-alone": J[3:].T @ (Lambda @ own)[3:] + bias,
        "halves-swapped": J.T @ Lambda @ own[SWAP] + bias,
        "bias-at-the-hand": push + J.T @ J @ bias,
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
