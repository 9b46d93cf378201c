"""10.5 `kabsch(A, B)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row, rounded
from robo47 import se3
from robo47.camera import kabsch

from .seen import clouds

row = Row(Pose())


@row.inputs
def _(rng):
    A = np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]])
    found = clouds(rng)
    flat, turned = clouds(rng, 2)
    mirror = [(A, rounded(B * [1, 1, -1])) for A, B in clouds(rng, 2)]
    return [
        (A, A + np.eye(3)[0]),
        *found,
        (flat[0] * [1, 1, 0], flat[1]),
        turned,
        *mirror,
    ]


def turned(A, B, d=None, about=True):
    """Return U, Vt and the centres; without det where d is None."""
    a = A.mean(axis=0) * about
    b = B.mean(axis=0) * about
    U, _, Vt = np.linalg.svd((B - b).T @ (A - a))
    return U, Vt, A.mean(axis=0), B.mean(axis=0)


def rigid(R, t):
    """Return a 4x4 matrix, also of what is no rotation."""
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = t
    return T


@row.wrongs
def _(A, B):
    """mirror: the sign of the determinant is not looked at: where noise or a mirrored
      cloud wants it, U V^T is a mirror image => U V^T as it is
    mirror-turned-round: the mirror is made a rotation by another sign for all of it;
      only the direction of the smallest singular value turns round => with -R there
    other-way: this is the motion from B to A => kabsch(B, A)
    R-transposed: the rotation is the other way round: it comes from B^T A, not A^T B =>
      with R^T
    U-V: numpy's svd returns V^T already => with U V
    t-without-R: the translation is the difference of the centres; A's centre is turned
      first, so it is b - R a => with b - a
    t-sign: the translation is a - R b; it is b - R a
    t-of-the-first: the translation fits the first point alone; its noise stays in
      => with b_0 - R a_0
    not-centred: the clouds are not moved to their centres before the svd
    affine: this is the best 3x3 matrix, by lstsq, and no rotation => the affine fit
    """
    U, Vt, a, b = turned(A, B)
    flip = np.diag([1, 1, np.linalg.det(U @ Vt)])
    R = U @ flip @ Vt
    U0, Vt0, _, _ = turned(A, B, about=False)
    raw = U0 @ np.diag([1, 1, np.linalg.det(U0 @ Vt0)]) @ Vt0
    one = np.hstack([A, np.ones((len(A), 1))])
    M = np.linalg.lstsq(one, B, rcond=None)[0].T
    bare = U @ Vt
    round_ = bare * np.sign(np.linalg.det(bare))
    return {
        "mirror": rigid(bare, b - bare @ a),
        "mirror-turned-round": rigid(round_, b - round_ @ a),
        "other-way": kabsch(B, A),
        "R-transposed": rigid(R.T, b - R.T @ a),
        "U-V": rigid(U @ flip @ Vt.T, b - U @ flip @ Vt.T @ a),
        "t-without-R": rigid(R, b - a),
        "t-sign": rigid(R, a - R @ b),
        "t-of-the-first": rigid(R, B[0] - R @ A[0]),
        "not-centred": rigid(raw, b - raw @ a),
        "affine": rigid(M[:, :3], M[:, 3]),
    }


@row.right  # Horn's quaternion.
def _(A, B):
    a = A.mean(axis=0)
    b = B.mean(axis=0)
    S = (A - a).T @ (B - b)
    z = np.array([S[1, 2] - S[2, 1], S[2, 0] - S[0, 2], S[0, 1] - S[1, 0]])
    N = np.block([
        [np.trace(S), z], [z[:, None], S + S.T - np.trace(S) * np.eye(3)]
    ])  # fmt: skip
    R = se3.quat_to_R(np.linalg.eigh(N)[1][:, -1])
    return rigid(R, b - R @ a)
