"""9.5 `kalman_update(x, P, z, H, R)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Scalar, Symmetric, Vector

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


row.spans(
    z=(lambda z: z + 20.0,),  # a NIS of 10 and more
    P=(lambda P: 1e-6 * P, lambda P: 1e3 * P),
    R=(lambda R: 1e-6 * R, lambda R: 1e3 * R),
)


def updated(
    x, P, z, H, R, *, of=lambda z, Hx: z - Hx, of_R=lambda R: R,
    S=lambda P, H, R: H @ P @ H.T + R, K=lambda P, H, S, R: P @ H.T @ np.linalg.inv(S),
    new_x=lambda x, K, y, z, H: x + K @ y,
    new_P=lambda P, K, S, H, R: P - K @ S @ K.T,
    nis=lambda y, S, known: y @ np.linalg.solve(S, y),
):  # fmt: skip
    """Return the update with other parts."""
    y = of(z, H @ x)
    R = of_R(R)
    own = S(P, H, R)
    gain = K(P, H, own, R)
    found = new_x(x, gain, y, z, H), new_P(P, gain, own, H, R)
    after = z - H @ found[0]
    return *found, nis(y, own, (P, H, R, after, found[1]))


def weighed(y, S):
    """Return y . S^-1 y."""
    return y @ np.linalg.solve(S, y)


def without(K, H):
    """Return I - K H."""
    return np.eye(len(K)) - K @ H


def after_it(P, H, R, after, new_P):
    """Return the S of the new P."""
    return H @ new_P @ H.T + R


for slug, says, redone, other in (
    ("surprise-sign", "the surprise is H x - z: the state moves away from the reading",
     "the right one with -y", {"of": lambda z, Hx: Hx - z}),
    ("R-forgotten", "S lacks R: the reading is taken for exact", "with S = H P H^T",
     {"S": lambda P, H, R: H @ P @ H.T}),
    ("only-R", "S is R alone: what is not known of the state is left out", "with S = R",
     {"S": lambda P, H, R: R}),
    ("R-rooted", "R is rooted: it is a variance already", "with sqrt(R)",
     {"of_R": lambda R: np.sqrt(np.abs(R))}),
    ("R-squared", "R is squared: it is a variance already", "with R R",
     {"of_R": lambda R: R @ R}),
    ("R-subtracted", "R is subtracted in S; the reading's noise adds to what is not "
     "known", "with S = H P H^T - R", {"S": lambda P, H, R: H @ P @ H.T - R}),
    ("R-diagonal", "only R's diagonal is in S; readings may be wrong together",
     "with R's diagonal", {"of_R": lambda R: np.diag(np.diag(R))}),
    ("P-left-out", "S is H H^T + R; P stands between", "with S = H H^T + R",
     {"S": lambda P, H, R: H @ H.T + R}),
    ("R-inverted", "R's inverse is added: that belongs to the information form",
     "with R^-1", {"of_R": np.linalg.inv}),
    ("S-not-inverted", "K lacks S^-1: it is P H^T", "with K = P H^T",
     {"K": lambda P, H, S, R: P @ H.T}),
    ("S-multiplied", "K is P H^T S; it is divided by S", "with K = P H^T S",
     {"K": lambda P, H, S, R: P @ H.T @ S}),
    ("K-without-P", "K is H^T S^-1; P stands before it: what was not known is what is "
     "corrected", "with K = H^T S^-1",
     {"K": lambda P, H, S, R: H.T @ np.linalg.inv(S)}),
    ("divided-by-R", "K is P H^T R^-1, which is right with the new P only",
     "with R for S in K", {"K": lambda P, H, S, R: P @ H.T @ np.linalg.inv(R)}),
    ("P-not-updated", "P is handed on as it was: a reading makes surer", "P itself",
     {"new_P": lambda P, K, S, H, R: P.copy()}),
    ("P-added", "K S K^T is added; a reading makes surer", "P + K S K^T",
     {"new_P": lambda P, K, S, H, R: P + K @ S @ K.T}),
    ("P-from-the-right", "P (I - K H): the factor stands on the left, (I - K H) P",
     "P (I - K H)", {"new_P": lambda P, K, S, H, R: P @ without(K, H)}),
    ("P-with-R", "K R K^T is subtracted; it is K S K^T", "P - K R K^T",
     {"new_P": lambda P, K, S, H, R: P - K @ R @ K.T}),
    ("P-without-S", "K K^T is subtracted; S stands between", "P - K K^T",
     {"new_P": lambda P, K, S, H, R: P - K @ K.T}),
    ("P-I-minus-K-H", "it is I - K H; P is what it is multiplied with", "I - K H",
     {"new_P": lambda P, K, S, H, R: without(K, H)}),
    ("P-minus-K-H", "K H is subtracted; it is K H P, which is K S K^T", "P - K H",
     {"new_P": lambda P, K, S, H, R: P - K @ H}),
    ("P-joseph-short", "it is (I - K H) P (I - K H)^T; Joseph's form has K R K^T "
     "besides", "without K R K^T",
     {"new_P": lambda P, K, S, H, R: without(K, H) @ P @ without(K, H).T}),
    ("P-K-R-K-besides", "K R K^T is added besides; that belongs to Joseph's form, "
     "(I - K H) P (I - K H)^T + K R K^T", "P - K S K^T + K R K^T",
     {"new_P": lambda P, K, S, H, R: P - K @ S @ K.T + K @ R @ K.T}),
    ("x-not-updated", "x is handed on as it was", "x itself",
     {"new_x": lambda x, K, y, z, H: x.copy()}),
    ("x-only-where-read", "only entries of x that are read are corrected; the others "
     "go along with them by P", "x, with the others as they were",
     {"new_x": lambda x, K, y, z, H: np.where((H != 0.0).any(axis=0), x + K @ y, x)}),
    ("x-replaced", "x is K y alone; it is what is added to x", "K y",
     {"new_x": lambda x, K, y, z, H: K @ y}),
    ("x-by-the-reading", "K is multiplied with z, not with z - H x", "x + K z",
     {"new_x": lambda x, K, y, z, H: x + K @ z}),
    ("nis-with-R", "the NIS is weighed by R: what was not known of the state is "
     "expected as well", "with R for S in the NIS",
     {"nis": lambda y, S, known: weighed(y, known[2])}),
    ("nis-without-R", "the NIS is weighed by H P H^T: the reading's noise is expected "
     "as well", "with H P H^T",
     {"nis": lambda y, S, known: weighed(y, known[1] @ known[0] @ known[1].T)}),
    ("nis-rooted", "the NIS is rooted: the mean of that is not m", "its root",
     {"nis": lambda y, S, known: np.sqrt(weighed(y, S))}),
    ("nis-not-weighed", "the NIS is y . y: it is divided by S, and has no unit",
     "y . y", {"nis": lambda y, S, known: y @ y}),
    ("nis-after", "the NIS is that of what is left after the update; it is that of the "
     "surprise", "with z - H x of the new x",
     {"nis": lambda y, S, known: weighed(known[3], S)}),
    ("nis-with-new-P", "the NIS is weighed by the S of the new P; the surprise came "
     "before it", "with H P H^T + R of the new P",
     {"nis": lambda y, S, known: weighed(y, after_it(*known))}),
    ("nis-all-after", "the NIS is made of the new x and the new P; it is that of the "
     "surprise, which came before both", "with the new x and P",
     {"nis": lambda y, S, known: weighed(known[3], after_it(*known))}),
    ("nis-diagonal", "the NIS takes the diagonal of S alone; surprises may go together",
     "with S's diagonal", {"nis": lambda y, S, known: y @ (y / np.diag(S))}),
    ("nis-per-number", "the NIS is divided by m; its mean is m, not 1", "divided by m",
     {"nis": lambda y, S, known: weighed(y, S) / len(y)}),
    ("nis-halved", "the NIS is halved: half of it stands in a normal number's exponent",
     "its half", {"nis": lambda y, S, known: weighed(y, S) / 2}),
    ("nis-multiplied", "the NIS is y . S y; it is divided by S", "y . S y",
     {"nis": lambda y, S, known: y @ S @ y}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(updated, **other))


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


@row.wrong(
    "not-at-every-size"
)  # A gate: a reading with a NIS over 9 a number is not used.
def _(x, P, z, H, R):
    found = updated(x, P, z, H, R)
    return found if found[2] <= 9.0 * len(z) else (x.copy(), P.copy(), found[2])


row.spans(  # as small, or as large, as in the lab
    x=(lambda x: 6e-05 * x,),
    z=(lambda z: 7e-07 * z,),
)
