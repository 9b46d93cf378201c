"""10.5 `kabsch(source, target)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pose, Row, rounded
from robo47 import se3
from robo47.camera import kabsch

from .seen import clouds

row = Row(Pose())


@row.inputs
def _(rng):
    source = np.array([[0.0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]])
    found = clouds(rng)
    flat, turned = clouds(rng, 2)
    mirror = [
        (source, rounded(target * [1, 1, -1])) for source, target in clouds(rng, 2)
    ]
    return [
        (source, source + np.eye(3)[0]),
        *found,
        (flat[0] * [1, 1, 0], flat[1]),
        turned,
        *mirror,
    ]


def rigid(R, t):
    """Return a 4x4 matrix, also of what is no rotation."""
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = t
    return T


def proper(U, Vt):
    """Return the rotation that an svd leads to: the smallest direction turned round."""
    return U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt


def fitted(
    source, target, *, centre=lambda X: X.mean(axis=0), rotation=proper,
    scale=lambda s, source: 1.0, shift=lambda R, a, b: b - R @ a,
):  # fmt: skip
    """Return the motion with other parts: about which centre, by which R, moved how."""
    around = source - centre(source)
    U, s, Vt = np.linalg.svd((target - centre(target)).T @ around)
    R = scale(s * [1, 1, np.linalg.det(U @ Vt)], around) * rotation(U, Vt)
    return rigid(R, shift(R, source.mean(axis=0), target.mean(axis=0)))


def all_turned(U, Vt):
    """Return the rotation with every sign turned where it is a mirror image."""
    return U @ Vt * np.sign(np.linalg.det(U @ Vt))


for slug, says, redone, other in (
    ("mirror", "the sign of the determinant is not looked at: where noise or a "
     "mirrored cloud wants it, U V^T is a mirror image", "U V^T as it is",
     {"rotation": lambda U, Vt: U @ Vt}),
    ("mirror-turned-round", "the mirror is made a rotation by another sign for all of "
     "it; only the direction of the smallest singular value turns round",
     "with -R there", {"rotation": all_turned}),
    ("largest-turned-round", "the mirror is made a rotation by turning the direction "
     "of the largest singular value round; the smallest is the cheapest",
     "with diag(det, 1, 1)", {"rotation": lambda U, Vt: U @ np.diag(
         [np.linalg.det(U @ Vt), 1, 1]) @ Vt}),
    ("middle-turned-round", "the mirror is made a rotation by turning the direction of "
     "the middle singular value round; the smallest is the cheapest",
     "with diag(1, det, 1)", {"rotation": lambda U, Vt: U @ np.diag(
         [1, np.linalg.det(U @ Vt), 1]) @ Vt}),
    ("column-turned-round", "the mirror is made a rotation by turning the third column "
     "of V^T round; its rows are the directions", "with V^T's column",
     {"rotation": lambda U, Vt: U @ Vt @ np.diag([1, 1, np.linalg.det(U @ Vt)])}),
    ("row-of-U-turned-round", "the mirror is made a rotation by turning the third row "
     "of U round; its columns are the directions", "with U's row",
     {"rotation": lambda U, Vt: np.diag([1, 1, np.linalg.det(U @ Vt)]) @ U @ Vt}),
    ("always-turned-round", "the third direction is turned round every time; it is "
     "only where U V^T is a mirror image", "with diag(1, 1, -1)",
     {"rotation": lambda U, Vt: U @ np.diag([1, 1, -1]) @ Vt}),
    ("R-transposed", "the rotation is the other way round: it is U V^T of "
     "target^T source, not source^T target", "with R^T",
     {"rotation": lambda U, Vt: proper(U, Vt).T}),
    ("U-V", "numpy's svd returns V^T already", "with U V", {"rotation": lambda U, Vt:
     U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt.T}),
    ("not-centred", "the clouds are not moved to their centres before the svd",
     "with the points as they are", {"centre": lambda X: np.zeros(3)}),
    ("one-number-for-the-centre", "the centre is the mean of all numbers of a cloud; "
     "each coordinate has its own: axis=0", "with .mean() of all numbers",
     {"centre": lambda X: X.mean() + np.zeros(3)}),
    ("about-the-first", "the clouds are moved to their first points; their noise stays "
     "in, and the centres' does not", "with source[0] and target[0]",
     {"centre": lambda X: X[0]}),
    ("scaled", "R is multiplied by a scale; a motion changes no lengths",
     "with a scale", {"scale": lambda s, source: s.sum() / np.sum(source * source)}),
    ("t-without-R", "the translation is the difference of the centres; source's centre "
     "is turned first, so it is b - R a", "with b - a",
     {"shift": lambda R, a, b: b - a}),
    ("t-with-R-transposed", "the translation is b - R^T a; it is b - R a",
     "with b - R^T a", {"shift": lambda R, a, b: b - R.T @ a}),
    ("t-turned-too", "the translation is R (b - a); only a is turned: b - R a",
     "with R (b - a)", {"shift": lambda R, a, b: R @ (b - a)}),
    ("t-added", "the translation is b + R a; it is b - R a", "with b + R a",
     {"shift": lambda R, a, b: b + R @ a}),
    ("t-sign", "the translation is a - R b; it is b - R a", "with a - R b",
     {"shift": lambda R, a, b: a - R @ b}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(fitted, **other))


@row.wrongs
def _(source, target):
    """other-way: this is the motion from target to source => kabsch(target, source)
    t-of-the-first: the translation fits the first point alone; its noise stays in
      => with b_0 - R a_0
    first-for-centre: the first points are taken for the centres; their noise stays in
      => with source[0] and target[0] for a and b
    affine: this is the best 3x3 matrix, by lstsq, and no rotation => the affine fit
    """
    R = kabsch(source, target)[:3, :3]
    one = np.hstack([source, np.ones((len(source), 1))])
    M = np.linalg.lstsq(one, target, rcond=None)[0].T
    return {
        "other-way": kabsch(target, source),
        "first-for-centre": fitted(
            source,
            target,
            centre=lambda X: X[0],
            shift=lambda R, a, b: target[0] - R @ source[0],
        ),
        "t-of-the-first": rigid(R, target[0] - R @ source[0]),
        "affine": rigid(M[:, :3], M[:, 3]),
    }


@row.right  # Horn's quaternion.
def _(source, target):
    a = source.mean(axis=0)
    b = target.mean(axis=0)
    S = (source - a).T @ (target - b)
    z = np.array([S[1, 2] - S[2, 1], S[2, 0] - S[0, 2], S[0, 1] - S[1, 0]])
    N = np.block([
        [np.trace(S), z], [z[:, None], S + S.T - np.trace(S) * np.eye(3)]
    ])  # fmt: skip
    R = se3.quat_to_R(np.linalg.eigh(N)[1][:, -1])
    return rigid(R, b - R @ a)
