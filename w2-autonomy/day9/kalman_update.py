"""9.5 `kalman_update(x, P, z, H, R)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar, Symmetric, Vector
from robo47.estimation import kalman_update

from .signals import believed

row = Row((
    Vector((None,), called="x"),
    Symmetric((None, None), called="P"),
    Scalar(called="the NIS"),
))  # fmt: skip


@row.inputs
def _(rng):
    P = np.array([[2.0, 1.0], [1.0, 2.0]])
    case = (np.zeros(2), P, np.array([3.0]), np.array([[1.0, 0.0]]), np.eye(1))
    return [case, *believed(rng)]


def updated(x, P, y, H, S, R, K=None, nis=None):
    """Return the update with other parts."""
    right = P @ H.T @ np.linalg.inv(S)
    K = right if K is None else K
    nis = y @ np.linalg.solve(S, y) if nis is None else nis
    return x + K @ y, P - K @ S @ K.T, nis


@row.wrongs
def _(x, P, z, H, R):
    """surprise-sign: the surprise is H x - z: the state moves away from the reading =>
      the right one with -y
    R-forgotten: S lacks R: the reading is taken for exact => with S = H P H^T
    only-R: S is R alone: what is not known of the state is left out => with S = R
    R-rooted: R is rooted: it is a variance already => with sqrt(R)
    R-squared: R is squared: it is a variance already => with R R
    R-subtracted: R is subtracted in S; the reading's noise adds to what is not known =>
      with S = H P H^T - R
    R-inverted: R's inverse is added: that belongs to the information form => with R^-1
    S-not-inverted: K lacks S^-1: it is P H^T => with K = P H^T
    S-multiplied: K is P H^T S; it is divided by S => with K = P H^T S
    divided-by-R: K is P H^T R^-1, which is right with the new P only => with R for S in
      K
    P-not-updated: P is handed on as it was: a reading makes surer
    P-added: K S K^T is added; a reading makes surer => P + K S K^T
    P-from-the-right: P (I - K H): the factor stands on the left, (I - K H) P
    P-with-R: K R K^T is subtracted; it is K S K^T
    P-without-S: K K^T is subtracted; S stands between => P - K K^T
    P-I-minus-K-H: it is I - K H; P is what it is multiplied with
    P-minus-K-H: K H is subtracted; it is K H P, which is K S K^T
    P-joseph-short: it is (I - K H) P (I - K H)^T; Joseph's form has K R K^T besides
    x-not-updated: x is handed on as it was
    x-only-where-read: only entries of x that are read are corrected; the others go
      along with them by P => x, with the others as they were
    x-replaced: x is K y alone; it is what is added to x => K y
    x-by-the-reading: K is multiplied with z, not with z - H x => x + K z
    nis-with-R: the NIS is weighed by R: what was not known of the state is expected as
      well => with R for S in the NIS
    nis-without-R: the NIS is weighed by H P H^T: the reading's noise is expected as
      well
    nis-rooted: the NIS is rooted: the mean of that is not m
    nis-not-weighed: the NIS is y . y: it is divided by S, and has no unit
    nis-after: the NIS is that of what is left after the update; it is that of the
      surprise => with z - H x of the new x
    nis-with-new-P: the NIS is weighed by the S of the new P; the surprise came before
      it => with H P H^T + R of the new P
    nis-diagonal: the NIS takes the diagonal of S alone; surprises may go together
    nis-per-number: the NIS is divided by m; its mean is m, not 1
    nis-multiplied: the NIS is y . S y; it is divided by S
    """
    y = z - H @ x
    S = H @ P @ H.T + R
    right = kalman_update(x, P, z, H, R)
    new_x, new_P, nis = right
    inverse = np.linalg.inv(S)
    K = P @ H.T @ inverse
    left = np.eye(len(x)) - K @ H
    read = (H != 0.0).any(axis=0)
    after = z - H @ new_x

    def with_S(S):
        return lambda: updated(x, P, y, H, S, R)

    def with_K(K):
        return updated(x, P, y, H, S, R, K)

    Ps = {
        "P-not-updated": P.copy(),
        "P-added": P + K @ S @ K.T,
        "P-from-the-right": P @ left,
        "P-with-R": P - K @ R @ K.T,
        "P-without-S": P - K @ K.T,
        "P-I-minus-K-H": left,
        "P-minus-K-H": P - K @ H,
        "P-joseph-short": left @ P @ left.T,
    }
    xs = {
        "surprise-sign": x - K @ y,
        "x-not-updated": x.copy(),
        "x-only-where-read": np.where(read, new_x, x),
        "x-replaced": K @ y,
        "x-by-the-reading": x + K @ z,
    }
    nises = {
        "nis-with-R": y @ np.linalg.solve(R, y),
        "nis-without-R": lambda: (new_x, new_P, y @ np.linalg.solve(H @ P @ H.T, y)),
        "nis-rooted": np.sqrt(nis),
        "nis-not-weighed": y @ y,
        "nis-after": after @ inverse @ after,
        "nis-with-new-P": y @ np.linalg.solve(H @ new_P @ H.T + R, y),
        "nis-diagonal": y @ (y / np.diag(S)),
        "nis-per-number": nis / len(z),
        "nis-multiplied": y @ S @ y,
    }
    table = {
        "R-forgotten": with_S(H @ P @ H.T),
        "only-R": with_S(R),
        "R-rooted": with_S(S - R + np.sqrt(np.abs(R))),
        "R-squared": with_S(S - R + R @ R),
        "R-subtracted": with_S(S - 2 * R),
        "R-inverted": with_S(S - R + np.linalg.inv(R)),
        "S-not-inverted": with_K(P @ H.T),
        "S-multiplied": with_K(P @ H.T @ S),
        "divided-by-R": with_K(P @ H.T @ np.linalg.inv(R)),
    }
    table |= {s: (new_x, one, nis) for s, one in Ps.items()}
    table |= {s: (one, new_P, nis) for s, one in xs.items()}
    table |= {
        s: one if callable(one) else (new_x, new_P, one) for s, one in nises.items()
    }
    return table


@row.right  # (I - K H) P, with a solve.
def _(x, P, z, H, R):
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    y = z - H @ x
    return x + K @ y, (np.eye(len(x)) - K @ H) @ P, y @ np.linalg.solve(S, y)


@row.right  # Joseph's form.
def _(x, P, z, H, R):
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    left = np.eye(len(x)) - K @ H
    y = z - H @ x
    return x + K @ y, left @ P @ left.T + K @ R @ K.T, y @ np.linalg.inv(S) @ y


@row.right  # What is known adds up: the information form.
def _(x, P, z, H, R):
    known = np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H
    new = np.linalg.inv(known)
    y = z - H @ x
    S = H @ P @ H.T + R
    return x + new @ H.T @ np.linalg.inv(R) @ y, new, y @ np.linalg.inv(S) @ y
