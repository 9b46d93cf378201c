"""5.1 `pd_torque(e, ed, kp, kd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row

from .joints import TORQUE, WRAPPED, one_gain, springs, springs_of_one_gain

row = Row(TORQUE, held_out=[one_gain(springs_of_one_gain)])
row.inputs(springs)


@row.wrongs
def _(e, ed, kp, kd):
    """one-gain-for-all: your code uses the gains of the first joint for all joints. Use
      each joint's own gains
    summed-over-joints: your code gives each joint the sum over all joints, like the dot
      product `kp @ e`. Multiply entry by entry, because each joint has its own torque
    mean-gains: your code uses the mean of the gains for all joints. Use each joint's
      own gains
    """
    return {
        "one-gain-for-all": lambda: kp[0] * e + kd[0] * ed,
        "summed-over-joints": lambda: np.full(7, kp @ e + kd @ ed),
        "mean-gains": np.mean(kp) * e + np.mean(kd) * ed,
    }


row.of_argument("e", WRAPPED)


@row.right  # Gains as matrices.
def _(e, ed, kp, kd):
    return np.diag(np.broadcast_to(kp, 7)) @ e + np.diag(np.broadcast_to(kd, 7)) @ ed


@row.close("rounded")  # To 5 decimals.
def _(e, ed, kp, kd):
    return np.round(kp * e + kd * ed, 5)


row.at_least_0(kp="a gain", kd="a gain")


row.spans(  # as small, or as large, as in the lab
    e=(lambda e: 4e-07 * e,),
    ed=(lambda ed: 6e-08 * ed,),
    kp=(lambda kp: 300 * kp,),
    kd=(lambda kd: 30 * kd,),
)
