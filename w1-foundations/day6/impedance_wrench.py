"""6.5 `impedance_wrench(e, V_err, K, D)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row

from .states import WRENCH, springs

row = Row(WRENCH)


row.inputs(springs)


@row.wrongs
def _(e, V_err, K, D):
    """diagonals: your result depends only on the diagonals of K and D. Use the whole
      matrices, because they can couple the six directions
    millimetres: in your result, the linear error is in millimetres. Use metres, because
      the linear stiffness in K is in N/m
    """
    return {
        "diagonals": np.diag(K) * e + np.diag(D) * V_err,
        "millimetres": K @ (e * [1, 1, 1, 1000, 1000, 1000]) + D @ V_err,
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
