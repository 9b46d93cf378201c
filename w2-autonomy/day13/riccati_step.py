"""13.3 `riccati_step(P, A, B, Q, R)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, Symmetric
from robo47.optimal import riccati_step

from .asked import steps

row = Row((Symmetric((None, None), called="P"), Matrix((None, None), called="K")))


@row.inputs
def _(rng):
    one = np.eye(2)
    A = np.array([[1.0, 1], [0, 1]])
    case = (one, A, np.array([[0.0], [1]]), one, np.eye(1))
    return [case, *steps(rng)]


@row.spans
def _(rng):
    P, A, B, Q, R = steps(rng)[-1]
    for size in (1e-6, 1e6):
        yield size * P, A, B, size * Q, size * R


@row.wrongs
def _(P, A, B, Q, R):
    """R-forgotten: your code omits R in the gain, so the input has no cost. Use R + B^T
      P B in the equation for K
    R-once: your code omits the cost of the input in the new P. Add K^T R K to `Q + (A -
      B K)^T P (A - B K)`
    u-counted-twice: your code counts the cost of the input twice. Add K^T R K once to
      `Q + (A - B K)^T P (A - B K)`, or not at all to `Q + A^T P (A - B K)`, which
      already contains this cost
    K-of-the-new-P: your code computes the gain from the new P. Use the argument P
      instead, which is the cost-to-go of the next state
    gain-sign: your code returns -K. Return K itself, because the minus sign is already
      in `u = -K x`
    A-P-AT: your code uses A P A^T, which propagates a covariance. Use A^T P A instead,
      which propagates a cost-to-go
    Q-for-P: your code computes the gain with Q instead of P. Use P, which is the
      cost-to-go of the next state
    Q-in-the-gain: your code computes the gain with P + Q instead of P. Omit Q, because
      the cost x . Q x of this step does not depend on u
    K-R-K-subtracted: your code subtracts K^T R K from Q + A^T P A. Subtract K^T (R +
      B^T P B) K instead, because the optimal input reduces the cost-to-go by this term
    motion-forgotten: your code omits the cost-to-go of the next state in the new P. Add
      the term `(A - B K)^T P (A - B K)`
    P-forgotten-and-R: your code returns `Q + (A - B K)^T (A - B K)` as the new P.
      Insert the old P between the last two factors, and add the cost of the input, K^T
      R K => both
    K-K-subtracted: your code subtracts K^T K from Q + A^T P A. Subtract K^T (R + B^T P
      B) K instead, because the optimal input reduces the cost-to-go by this term
    K-K-added: your code adds K^T K. Add K^T R K instead, which is the cost of the input
    P-not-updated: your code returns P unchanged. Return the cost-to-go matrix for the
      preceding time step
    P-halved: your code halves P. Omit the factor of 1/2, because the cost in this task
      has no such factor
    """
    F = B.T @ P @ A
    right, K = riccati_step(P, A, B, Q, R)
    closed = A - B @ K

    def by(gain):
        return Q + A.T @ P @ (A - B @ gain), gain

    return {
        "R-forgotten": by(np.linalg.pinv(B.T @ P @ B) @ F),
        "R-once": (Q + closed.T @ P @ closed, K),
        "u-counted-twice": (right + K.T @ R @ K, K),
        "K-of-the-new-P": (right, riccati_step(right, A, B, Q, R)[1]),
        "gain-sign": (right, -K),
        "A-P-AT": (Q + A @ P @ A.T - A @ P @ B @ K, K),
        "Q-for-P": by(np.linalg.solve(R + B.T @ Q @ B, B.T @ Q @ A)),
        "Q-in-the-gain": by(np.linalg.solve(R + B.T @ (P + Q) @ B, B.T @ (P + Q) @ A)),
        "K-R-K-subtracted": (Q + A.T @ P @ A - K.T @ R @ K, K),
        "motion-forgotten": (Q + K.T @ R @ K, K),
        "P-forgotten-and-R": (Q + closed.T @ closed, K),
        "K-K-subtracted": (Q + A.T @ P @ A - K.T @ K, K),
        "K-K-added": (Q + closed.T @ P @ closed + K.T @ K, K),
        "P-not-updated": (P.copy(), K),
        "P-halved": (right / 2, K),
    }


@row.wrong("answers-swapped", "your code swaps P and K. Return the new P first")
def _(P, A, B, Q, R):
    return riccati_step(P, A, B, Q, R)[::-1]


@row.right  # Joseph's form.
def _(P, A, B, Q, R):
    K = np.linalg.inv(R + B.T @ P @ B) @ B.T @ P @ A
    closed = A - B @ K
    return Q + K.T @ R @ K + closed.T @ P @ closed, K


@row.right  # Without the gain in P.
def _(P, A, B, Q, R):
    S = R + B.T @ P @ B
    F = B.T @ P @ A
    return Q + A.T @ P @ A - F.T @ np.linalg.inv(S) @ F, np.linalg.solve(S, F)


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # No eigenvalue of P is below 1e-3.
def _(P, A, B, Q, R):
    P, K = riccati_step(P, A, B, Q, R)
    w, V = np.linalg.eigh(P)
    return V @ np.diag(np.maximum(w, 1e-3)) @ V.T, K


row.spans(  # as small, or as large, as in the lab
    B=(lambda B: 0.03 * B,),
)
