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
    K=lambda P, H, S, R: P @ H.T @ np.linalg.inv(S),
    new_x=lambda x, K, y, z, H: x + K @ y,
    new_P=lambda P, K, S, H, R: P - K @ S @ K.T,
    nis=lambda y, S, known: y @ np.linalg.solve(S, y),
):  # fmt: skip
    """Return the update with another part."""
    y = of(z, H @ x)
    R = of_R(R)
    S = H @ P @ H.T + R
    gain = K(P, H, S, R)
    found = new_x(x, gain, y, z, H), new_P(P, gain, S, H, R)
    after = z - H @ found[0]
    return *found, nis(y, S, (P, H, R, after, found[1]))


def weighed(y, S):
    """Return y . S^-1 y."""
    return y @ np.linalg.solve(S, y)


def without(K, H):
    """Return I - K H."""
    return np.eye(len(K)) - K @ H


def after_it(P, H, R, after, new_P):
    """Return the S of the updated P."""
    return H @ new_P @ H.T + R


for slug, says, other in (
    ("surprise-sign",
     "your code uses the wrong sign for the innovation or the gain, so the update "
     "moves the state away from the reading. The new state should be x + K (z - H x)",
     {"of": lambda z, Hx: Hx - z}),
    ("R-rooted", "your code uses the square root of the absolute value of each entry "
                 "of R. Use R itself, because R is a covariance and not a standard "
                 "deviation",
     {"of_R": lambda R: np.sqrt(np.abs(R))}),
    ("divided-by-R",
     "your code computes the gain as P H^T R^-1 with the predicted P. Use S^-1 instead "
     "of R^-1, where S is the innovation covariance H P H^T + R",
     {"K": lambda P, H, S, R: P @ H.T @ np.linalg.inv(R)}),
    ("P-from-the-right",
     "your code computes the new covariance as P (I - K H), where I is the identity "
     "matrix. Use (I - K H) P instead",
                         {"new_P": lambda P, K, S, H, R: P @ without(K, H)}),
    ("P-I-minus-K-H",
     "your code computes the new covariance as I - K H, where I is the identity "
     "matrix. Use (I - K H) P instead",
     {"new_P": lambda P, K, S, H, R: without(K, H)}),
    ("P-minus-K-H",
     "your code computes the new covariance as P - K H. Subtract K H P, which is equal "
     "to K S K^T, instead",
     {"new_P": lambda P, K, S, H, R: P - K @ H}),
    ("P-joseph-short",
     "your code computes the new covariance as (I - K H) P (I - K H)^T, where I is the "
     "identity matrix. Add K R K^T, which is the other term of the Joseph form",
     {"new_P": lambda P, K, S, H, R: without(K, H) @ P @ without(K, H).T}),
    ("P-K-R-K-besides",
     "your new covariance is P - K S K^T + K R K^T. Omit K R K^T, because it belongs "
     "only to the Joseph form",
     {"new_P": lambda P, K, S, H, R: P - K @ S @ K.T + K @ R @ K.T}),
    ("x-only-where-read",
     "your code corrects only the measured entries of x. Correct all entries with K, "
     "because the other entries can be correlated with the measured ones",
     {"new_x": lambda x, K, y, z, H: np.where((H != 0.0).any(axis=0), x + K @ y, x)}),
    ("x-by-the-reading", "your code multiplies K by the reading z. Multiply K by the "
                         "innovation z - H x instead",
                         {"new_x": lambda x, K, y, z, H: x + K @ z}),
    ("nis-with-R",
     "your code computes the NIS with R^-1. Use S^-1 instead, because the innovation "
     "also contains the error of x",
     {"nis": lambda y, S, known: weighed(y, known[2])}),
    ("nis-without-R",
     "your code computes the NIS with (H P H^T)^-1. Use S^-1 instead, because the "
     "innovation also contains the measurement noise",
     {"nis": lambda y, S, known: weighed(y, known[1] @ known[0] @ known[1].T)}),
    ("nis-after", "your code computes the NIS from the residual z - H x with the "
                  "updated x. Use the innovation instead, which is z - H x with the "
                  "predicted x",
     {"nis": lambda y, S, known: weighed(known[3], S)}),
    ("nis-with-new-P",
     "for the NIS, your code computes S from the updated P. Compute S from the "
     "predicted P instead, because the innovation is computed before the update",
     {"nis": lambda y, S, known: weighed(y, after_it(*known))}),
    ("nis-all-after", "your code computes the NIS from the updated x and P. Use the "
                      "predicted x and P instead, because the innovation and S are "
                      "computed before the update",
     {"nis": lambda y, S, known: weighed(known[3], after_it(*known))}),
    ("nis-diagonal", "your code uses only the diagonal of S in the NIS. Use the whole "
                     "matrix S, because the entries of the innovation may be "
                     "correlated",
     {"nis": lambda y, S, known: y @ (y / np.diag(S))}),
    ("nis-per-number",
     "your code divides the NIS by m, the number of entries of z. Omit this division, "
     "because the expected value of the NIS should be m",
     {"nis": lambda y, S, known: weighed(y, S) / len(y)}),
):  # fmt: skip
    row.wrong(slug, says)(partial(updated, **other))


@row.wrongs
def _(x, P, z, H, R):
    """prior-P-in-the-gain: your code computes the gain as P H^T R^-1, which requires
      the updated P. With the predicted P, use S^-1 instead of R^-1
    R-in-the-information: your code uses R instead of R^-1 in the information form. Use
      R^-1, because the information of a reading is the inverse of its covariance
    """
    _, new_P, nis = updated(x, P, z, H, R)
    y = z - H @ x
    known = np.linalg.inv(np.linalg.inv(P) + H.T @ R @ H)
    return {
        "prior-P-in-the-gain": (x + P @ H.T @ np.linalg.inv(R) @ y, new_P, nis),
        "R-in-the-information": (x + known @ H.T @ R @ y, known, nis),
    }


@row.right  # (I - K H) P, with np.linalg.solve.
def _(x, P, z, H, R):
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    y = z - H @ x
    return x + K @ y, (np.eye(len(x)) - K @ H) @ P, y @ np.linalg.solve(S, y)


@row.right  # The Joseph form.
def _(x, P, z, H, R):
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    left = np.eye(len(x)) - K @ H
    y = z - H @ x
    return x + K @ y, left @ P @ left.T + K @ R @ K.T, y @ np.linalg.inv(S) @ y


@row.right  # The information form.
def _(x, P, z, H, R):
    known = np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H
    new = np.linalg.inv(known)
    y = z - H @ x
    S = H @ P @ H.T + R
    return x + new @ H.T @ np.linalg.inv(R) @ y, new, y @ np.linalg.inv(S) @ y


@row.wrong("not-at-every-size")  # A gate rejects readings with a NIS above 9 m.
def _(x, P, z, H, R):
    found = updated(x, P, z, H, R)
    return found if found[2] <= 9.0 * len(z) else (x.copy(), P.copy(), found[2])


row.spans(  # as small, or as large, as in the lab
    x=(lambda x: 6e-05 * x,),
    z=(lambda z: 7e-07 * z,),
)
