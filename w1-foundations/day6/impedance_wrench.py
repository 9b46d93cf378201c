"""6.5 `impedance_wrench(e, V_err, K, D)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from labkit.judge.argument_mistakes import TRANSPOSED

from .states import WRENCH, springs

row = Row(WRENCH)
row.of_argument("D", TRANSPOSED.called("D-transposed"))


row.inputs(springs)


@row.wrongs
def _(e, V_err, K, D):
    """spring-sign: the spring pushes the hand away: e points to the target, so pull
      along it => -K e + D V_err
    damper-sign: the damper drives the hand on: V_err is the target's twist minus the
      hand's, so it is added => K e - D V_err
    damper-forgotten: the damper is missing: the hand never comes to rest => K e
    spring-forgotten: the spring is missing: the hand stays wherever it is pushed => D
      V_err
    spring-and-damper-swapped: K and D have changed places => D e + K V_err
    diagonal-of-D: only the diagonal of D is used; the six directions are coupled => the
      right one with D's diagonal
    diagonal-of-D 2: only the diagonals of K and D are used; the six directions are
      coupled => the right one with their diagonals
    halves-swapped: the halves of the answer are (force; moment); the moment comes first
    millimetres: the error is put into millimetres; here everything is in metres => the
      right one with e in mm
    half-a-spring: the spring has a factor 1/2: that is its energy's, not its force's =>
      the right one with K e / 2
    diagonal-of-K: only the diagonal of K is used; a spring may couple its directions =>
      the right one with K's diagonal
    """
    return {
        "spring-sign": -K @ e + D @ V_err,
        "damper-sign": K @ e - D @ V_err,
        "damper-forgotten": K @ e,
        "spring-forgotten": D @ V_err,
        "spring-and-damper-swapped": D @ e + K @ V_err,
        "diagonal-of-D": K @ e + np.diag(D) * V_err,
        "diagonal-of-D 2": np.diag(K) * e + np.diag(D) * V_err,
        "halves-swapped": np.roll(K @ e + D @ V_err, 3),
        "millimetres": K @ (e * [1, 1, 1, 1000, 1000, 1000]) + D @ V_err,
        "half-a-spring": 0.5 * K @ e + D @ V_err,
        "diagonal-of-K": np.diag(K) * e + D @ V_err,
    }


@row.right  # From the left: K is symmetric.
def _(e, V_err, K, D):
    return e @ K + D @ V_err


@row.right  # Row by row, in plain Python.
def _(e, V_err, K, D):
    return [
        sum(k * x for k, x in zip(K[i], e)) + sum(d * x for d, x in zip(D[i], V_err))
        for i in range(6)
    ]


row.spans(  # as small, or as large, as in the lab
    e=(lambda e: 40 * e,),
    V_err=(
        lambda V_err: 4e-07 * V_err,
        lambda V_err: 20 * V_err,
    ),
    K=(lambda K: 0.006 * K,),
)
