"""6.7 `impedance_torque`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row

from .states import J_CASE, TORQUE, model, some, states

row = Row(TORQUE)


@row.inputs
def _(rng):
    rest = np.zeros(7)
    case = (J_CASE, np.zeros(6), np.arange(7.0), np.ones(7), rest, rest)
    drawn = [
        (model(now)[0], some(rng, 20, 6), some(rng, 20, 7),
         rng.numbers(0.5, 2, 7), some(rng, 2, 7), some(rng, 5, 7))
        for now in states(rng)
    ]  # fmt: skip
    J, F, bias, damping, qd, idle = drawn[0]
    parts = [
        (J, np.zeros(6), bias, damping, qd, idle),
        (J, F, bias, damping, rest, idle),
        (J, F, bias, damping, qd, rest),
    ]
    return [case, *parts, *drawn]


@row.wrongs
def _(J, wrench, bias, damping, qd, tau_null):
    """damping-summed: your result adds the sum of all damping torques to every joint.
      Multiply `damping` and `qd` entry by entry instead
    bias-sign: your code subtracts `bias`. Add `bias` instead, because the motors must
      supply this torque even at zero acceleration
    damping-sign: your code subtracts `damping * qd`. Add `damping * qd` instead,
      because damping opposes the motion and the motors must compensate for it
    bias-six-times: your result contains `bias` six times, for example once for each of
      the six rows of J. Add `bias` only once
    pinv-for-transpose: your result contains pinv(J) times the wrench. Use J^T instead,
      because J^T maps wrenches to torques
    """
    push = J.T @ wrench
    rub = damping * qd
    rest = bias + rub + tau_null
    return {
        "damping-summed": push + bias + damping @ qd + tau_null,
        "bias-six-times": push + 6 * bias + rub + tau_null,
        "bias-sign": push - bias + rub + tau_null,
        "damping-sign": push + bias - rub + tau_null,
        "pinv-for-transpose": np.linalg.pinv(J) @ wrench + rest,
    }


@row.right  # Joint by joint.
def _(J, wrench, bias, damping, qd, tau_null):
    rest = zip(J.T, bias, damping, qd, tau_null)
    return np.array([S @ wrench + b + d * v + tau for S, b, d, v, tau in rest])


row.at_least_0(damping="a damping")


row.spans(  # as small, or as large, as in the lab
    wrench=(lambda wrench: 0.02 * wrench,),
    qd=(lambda qd: 1e-06 * qd,),
    tau_null=(lambda tau_null: 2e-08 * tau_null,),
)
