"""10.8 `hand_eye(A, B)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row
from robo47 import se3
from robo47.camera import hand_eye
from robo47.rotation_log import log_rotation

from .kabsch import rigid
from .seen import motions


def two_axes(A, B):
    """Return whether motions turn about two axes, none by nearly half a turn."""
    a = log_rotation(A[:, :3, :3])
    b = log_rotation(B[:, :3, :3])
    least = min(np.linalg.svd(x, compute_uv=False)[1] for x in (a, b))
    most = max(np.linalg.norm(x, axis=1).max() for x in (a, b))
    return bool(least > 0.1 and most < np.pi - 0.1)


row = Row(Pose(), at_edge=two_axes)


@row.inputs
def _(rng):
    # Turns of 1 rad about x, y and z: half turns, as edges are, have two axes each.
    turns_1 = np.array([se3.Rx(1.0), se3.Ry(1.0), se3.Rz(1.0)])
    A = se3.make_T(turns_1, rng.numbers(-1, 1, 3, 3))
    return [(A, A), *motions(rng)]


def turns(A, B, centred=False, mirror=False):
    """Return the rotation between two fans of rotation vectors."""
    a = log_rotation(A[:, :3, :3])
    b = log_rotation(B[:, :3, :3])
    if centred:
        a = a - a.mean(axis=0)
        b = b - b.mean(axis=0)
    U, _, Vt = np.linalg.svd(a.T @ b)
    return U @ (np.eye(3) if mirror else np.diag([1, 1, np.linalg.det(U @ Vt)])) @ Vt


def solved(A, B, R, minus=1.0, sign=1.0, turned=True):
    """Return where the camera sits, with R, by the stacked translations."""
    C = (A[:, :3, :3] - minus * np.eye(3)).reshape(-1, 3)
    t = B[:, :3, 3] @ R.T if turned else B[:, :3, 3]
    d = sign * (t - A[:, :3, 3]).ravel()
    return rigid(R, np.linalg.lstsq(C, d, rcond=None)[0])


@row.wrongs
def _(A, B):
    """other-way: this is the hand seen from the camera, X's inverse => hand_eye(B, A)
    R-transposed: the rotation is the other way round: a = R b, so it comes from the sum
      of a b^T => with R^T in both steps
    centred: the rotation vectors are moved to their mean; they turn about the origin,
      and nothing else moves them => kabsch on them
    one-not-taken-off: 1 is missing in (R_A - 1) t; t stands on both sides => with R_A t
    d-sign: the right side has the wrong sign: it is R t_B - t_A => with -d
    R-forgotten-in-d: t_B is not turned by X's rotation before t_A is taken off
    t-left-out: the translation is 0: only the rotation is solved
    t-of-the-mean: each motion is solved alone, and the mean taken; one motion does not
      show the slide along its axis, so stack them => with the mean of pinv (R_A - 1) d
    first-motion-only: only the first motion is used for t; one does not show it all
    positions-for-rotations: the rotation is that between the translations of A and B;
      it is the one between their rotation vectors
    """
    R = turns(A, B)
    right = solved(A, B, R)
    alone = [solved(A[k : k + 1], B[k : k + 1], R)[:3, 3] for k in range(len(A))]
    U, _, Vt = np.linalg.svd(A[:, :3, 3].T @ B[:, :3, 3])
    places = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt
    return {
        "other-way": hand_eye(B, A),
        "R-transposed": solved(A, B, R.T),
        "centred": solved(A, B, turns(A, B, centred=True)),
        "one-not-taken-off": solved(A, B, R, minus=0.0),
        "d-sign": solved(A, B, R, sign=-1.0),
        "R-forgotten-in-d": solved(A, B, R, turned=False),
        "t-left-out": rigid(R, 0 * right[:3, 3]),
        "t-of-the-mean": rigid(R, np.mean(alone, axis=0)),
        "first-motion-only": rigid(R, alone[0]),
        "positions-for-rotations": solved(A, B, places),
    }


row.same(
    "C = (A[:, :3, :3] - np.eye(3)).reshape(-1, 3) => "
    "C = (A[:, :3, :3] - np.eye(3)).reshape(-2, 3)",
    "NumPy takes any size below 0 for what is left",
)


@row.right  # By the polar factor, and normal equations.
def _(A, B):
    M = sum(
        np.outer(log_rotation(a[:3, :3]), log_rotation(b[:3, :3]))
        for a, b in zip(A, B, strict=True)
    )
    w, V = np.linalg.eigh(M.T @ M)
    w = np.sqrt(np.maximum(w, 0)) * [np.sign(np.linalg.det(M)), 1, 1]
    R = M @ V @ np.diag(1 / w) @ V.T
    C = np.vstack([a[:3, :3] - np.eye(3) for a in A])
    d = np.concatenate([R @ b[:3, 3] - a[:3, 3] for a, b in zip(A, B, strict=True)])
    return rigid(R, np.linalg.solve(C.T @ C, C.T @ d))
