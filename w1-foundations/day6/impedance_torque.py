"""6.7 `impedance_torque`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from labkit.judge.argument_mistakes import HALVES_SWAPPED

from .states import J_CASE, TORQUE, model, some, states

row = Row(TORQUE)
row.of_argument("wrench", HALVES_SWAPPED)


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
    """damping-summed: damping @ qd adds seven products up, and every joint gets the
      sum; each joint has its own => the right one with damping @ qd
    bias-twice: bias is added twice => the right one with 2 bias
    bias-forgotten: bias is missing: the arm sags under its weight, decimetres at a soft
      hand => the right one without bias
    bias-sign: bias is taken away; your torques have to hold it, so it is added => the
      right one with -bias
    damping-forgotten: the joints' damping is not made up for => the right one without
      damping qd
    damping-sign: the joints' damping is taken away: the joints rub already, so your
      torques have to make up for it => the right one with -damping qd
    damping-without-qd: damping is added as it is; it is a torque only once it is times
      qd => the right one with damping for damping qd
    wrench-sign: the wrench has the wrong sign: the hand pulls where it should push =>
      the right one with -J^T F
    wrench-forgotten: the wrench is missing: the hand floats => the right one without
      J^T F
    pinv-for-transpose: pinv(J) takes the wrench to the joints; pushes go to torques
      with J^T, and the pseudo-inverse is for speeds => the right one with pinv(J)
    null-forgotten: tau_null is missing: nothing holds the elbow back
    null-sign: tau_null is taken away; it is a torque to add => the right one with
      -tau_null
    """
    push = J.T @ wrench
    rub = damping * qd
    rest = bias + rub + tau_null
    return {
        "damping-summed": push + bias + damping @ qd + tau_null,
        "bias-twice": push + bias + rest,
        "bias-forgotten": push + rub + tau_null,
        "bias-sign": push - bias + rub + tau_null,
        "damping-forgotten": push + bias + tau_null,
        "damping-sign": push + bias - rub + tau_null,
        "damping-without-qd": push + bias + damping + tau_null,
        "wrench-sign": rest - push,
        "wrench-forgotten": rest,
        "pinv-for-transpose": np.linalg.pinv(J) @ wrench + rest,
        "null-forgotten": push + bias + rub,
        "null-sign": push + bias + rub - tau_null,
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
