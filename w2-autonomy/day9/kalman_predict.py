"""9.4 `kalman_predict(x, P, F, Q)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Symmetric, Vector
from robo47.estimation import constant_velocity

from .signals import covariance

row = Row((Vector((2,), called="x"), Symmetric((2, 2), called="P")))


@row.inputs
def _(rng):
    drawn = []
    for k in range(7):
        F = rng.numbers(-2, 2, 2, 2)
        if k % 2:
            F = constant_velocity(float(rng.numbers(0.2, 2)), 1.0)[0]
        x = rng.numbers(-2, 2, 2)
        drawn.append((x, covariance(rng, 2), F, covariance(rng, 2)))
    return [(np.array([0.0, 1.0]), np.eye(2), *constant_velocity(1.0, 3.0)), *drawn]


@row.wrongs
def _(x, P, F, Q):
    """transposed-on-the-left: your code computes the new covariance as F^T P F + Q. Use
      F P F^T + Q instead, because the error e of the state becomes F e
    P-not-carried: your code computes the new covariance as P + Q. Use F P F^T + Q
      instead, because F also transforms the error of the state
    Q-carried-too: your code transforms both P and Q with F. Transform only P, and add Q
      afterwards, because Q already belongs to the new state
    entry-by-entry: in your result, F and P are multiplied entry by entry, as by `*`.
      Use the matrix product `@` instead
    """
    Ps = {
        "transposed-on-the-left": F.T @ P @ F + Q,
        "P-not-carried": P + Q,
        "Q-carried-too": F @ (P + Q) @ F.T,
        "entry-by-entry": F * P * F.T + Q,
    }
    return {s: (F @ x, P) for s, P in Ps.items()}


@row.right  # By np.einsum.
def _(x, P, F, Q):
    return np.einsum("ij,j->i", F, x), np.einsum("ij,jk,lk->il", F, P, F) + Q


row.spans(  # as small, or as large, as in the lab
    x=(lambda x: 8e-05 * x,),
    P=(lambda P: 7e-06 * P,),
    Q=(lambda Q: 5e-06 * Q,),
)
