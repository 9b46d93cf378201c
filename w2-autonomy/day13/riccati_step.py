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
    """R-forgotten: R is missing in the gain: torque is free => with K of R = 0
    R-once: R is in the gain only, and what u costs is missing in P; with the short form
      it would be in it => (A - B K)^T P (A - B K) + Q
    u-counted-twice: what u costs is added once more; the short form has it in it =>
      with K^T R K too
    K-of-the-new-P: the gain is made with the P that is returned; it belongs to the P
      that was given: what comes after this step => with K of the new P
    diagonal-of-R: of R only the diagonal is used => with R's diagonal
    diagonal-of-Q: of Q only the diagonal is used => with Q's diagonal
    diagonal-of-P: of P only the diagonal is used => with P's diagonal
    gain-sign: the gain has the other sign: u = -K x has the minus in it => the right P,
      and -K
    plus-BK: the arm is driven by +K x in P: it is A - B K => with A + B K
    A-not-transposed: A stands where A^T should in P => A P (A - B K)
    A-missing-in-K: the gain is B^T P without its A => (R + B^T P B)^-1 B^T P
    A-P-AT: A P A^T stands where A^T P A should: that is how a covariance goes on, and
      no cost => Q + A P A^T - A P B K
    Q-for-P: the gain is made with Q where P should stand => with K of Q
    Q-forgotten: Q is missing in P => P without Q
    Q-in-the-gain: Q is added to P in the gain; what this step costs does not depend on
      its u through Q => with P + Q in K
    no-control: P is what the arm costs that nobody holds => Q + A^T P A
    P-forgotten: A^T (A - B K): P is missing in it
    R-inverted: R's inverse is added in the gain => with R^-1
    K-R-K-subtracted: K^T R K is subtracted; it is K^T (R + B^T P B) K that is saved
      => Q + A^T P A - K^T R K
    motion-forgotten: what the next state costs is missing in P => Q + K^T R K
    P-forgotten-and-R: the next state's squares are added; it is P that they cost => Q +
      (A - B K)^T (A - B K)
    R-squared: R is squared in the gain => with R R
    K-K-subtracted: K^T K is subtracted; it is K^T (R + B^T P B) K that is saved
      => Q + A^T P A - K^T K
    K-K-added: K^T K is added for K^T R K: what u costs is R's => with K^T K
    K-halved: K is half as large => the right P, and K / 2
    P-not-updated: P is returned as it was
    P-added: the old P is added as well
    B-P-B-forgotten: the gain is divided by R alone => R^-1 B^T P A
    not-inverted: the gain is multiplied by R + B^T P B; it is divided => with * for /
    P-halved: P is half as large
    """
    S = R + B.T @ P @ B
    F = B.T @ P @ A
    right, K = riccati_step(P, A, B, Q, R)
    closed = A - B @ K

    def by(gain):
        return Q + A.T @ P @ (A - B @ gain), gain

    def diagonal(X):
        return np.diag(np.diag(X))

    def swapped():
        if Q.shape != R.shape:
            return right, K
        return riccati_step(P, A, B, R, Q)

    return {
        "R-forgotten": by(np.linalg.pinv(B.T @ P @ B) @ F),
        "R-once": (Q + closed.T @ P @ closed, K),
        "u-counted-twice": (right + K.T @ R @ K, K),
        "K-of-the-new-P": (right, riccati_step(right, A, B, Q, R)[1]),
        "diagonal-of-R": riccati_step(P, A, B, Q, diagonal(R)),
        "diagonal-of-Q": riccati_step(P, A, B, diagonal(Q), R),
        "diagonal-of-P": riccati_step(diagonal(P), A, B, Q, R),
        "gain-sign": (right, -K),
        "plus-BK": (Q + A.T @ P @ (A + B @ K), K),
        "A-not-transposed": (Q + A @ P @ closed, K),
        "A-missing-in-K": by(np.linalg.solve(S, B.T @ P)),
        "A-P-AT": (Q + A @ P @ A.T - A @ P @ B @ K, K),
        "Q-for-P": by(np.linalg.solve(R + B.T @ Q @ B, B.T @ Q @ A)),
        "Q-forgotten": (right - Q, K),
        "Q-in-the-gain": by(np.linalg.solve(R + B.T @ (P + Q) @ B, B.T @ (P + Q) @ A)),
        "no-control": (Q + A.T @ P @ A, K),
        "P-forgotten": (Q + A.T @ closed, K),
        "R-inverted": by(np.linalg.solve(np.linalg.inv(R) + B.T @ P @ B, F)),
        "K-R-K-subtracted": (Q + A.T @ P @ A - K.T @ R @ K, K),
        "motion-forgotten": (Q + K.T @ R @ K, K),
        "P-forgotten-and-R": (Q + closed.T @ closed, K),
        "R-squared": by(np.linalg.solve(R @ R + B.T @ P @ B, F)),
        "K-K-subtracted": (Q + A.T @ P @ A - K.T @ K, K),
        "K-K-added": (Q + closed.T @ P @ closed + K.T @ K, K),
        "K-halved": (right, K / 2),
        "P-not-updated": (P.copy(), K),
        "P-added": (P + right, K),
        "B-P-B-forgotten": by(np.linalg.solve(R, F)),
        "not-inverted": by(S @ F),
        "P-halved": (right / 2, K),
    }


@row.wrong("answers-swapped", "the two answers are swapped: P comes first")
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
