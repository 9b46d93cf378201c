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
    """x-not-predicted: x is handed on as it was; a moment later it is F x => x, and the
      right P
    x-turned-round: x is multiplied from the left, as x F, or F is transposed: F x => x
      F
    x-twice: F x is added to x; F has its 1 already => x + F x
    no-transpose: P is F P F; the one on the right is transposed => F P F + Q
    transposed-on-the-left: P is F^T P F: the transpose stands on the right
    F-once: P is F P: an error e becomes F e, and e e^T becomes F e e^T F^T
    P-not-carried: P + Q: the covariance is not carried along by F
    Q-forgotten: Q is missing: the filter grows sure of itself, and no longer listens
    Q-subtracted: Q is subtracted; a moment makes nothing surer
    Q-carried-too: Q is carried along by F as well; it is what the moment has added at
      its end => F (P + Q) F^T
    entry-by-entry: F * P is made entry by entry; @ is the matrix product => with * for
      @
    """
    right = F @ P @ F.T + Q
    Ps = {
        "no-transpose": F @ P @ F + Q,
        "transposed-on-the-left": F.T @ P @ F + Q,
        "F-once": F @ P + Q,
        "P-not-carried": P + Q,
        "Q-forgotten": right - Q,
        "Q-subtracted": right - 2 * Q,
        "Q-carried-too": F @ (P + Q) @ F.T,
        "entry-by-entry": F * P * F.T + Q,
    }
    xs = {"x-not-predicted": x.copy(), "x-turned-round": x @ F, "x-twice": x + F @ x}
    return {s: (F @ x, P) for s, P in Ps.items()} | {
        s: (x, right) for s, x in xs.items()
    }


@row.right  # Entry by entry, with sums.
def _(x, P, F, Q):
    return np.einsum("ij,j->i", F, x), np.einsum("ij,jk,lk->il", F, P, F) + Q


row.spans(  # as small, or as large, as in the lab
    x=(lambda x: 8e-05 * x,),
    P=(lambda P: 7e-06 * P,),
    Q=(lambda Q: 5e-06 * Q,),
)
