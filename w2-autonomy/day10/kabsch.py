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
    mirror = [
        (source, rounded(target * [1, 1, -1])) for source, target in clouds(rng, 2)
    ]
    return [
        (source, source + np.eye(3)[0]),
        *found,
        *clouds(rng, 2),
        *mirror,
    ]


@row.spans  # In a plane the third direction of an SVD may have either sign.
def _(rng):
    ((source, target),) = clouds(rng, 1)
    yield source * [1, 1, 0], target


def rigid(R, t):
    """Return a 4x4 matrix, also if R is no rotation."""
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = t
    return T


def proper(U, Vt):
    """Return the nearest rotation, from an SVD."""
    return U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt


def fitted(
    source, target, *, centre=lambda X: X.mean(axis=0), rotation=proper,
    scale=lambda s, source: 1.0, shift=lambda R, a, b: b - R @ a,
):  # fmt: skip
    """Return the motion with another centre, rotation, scale or translation."""
    around = source - centre(source)
    U, s, Vt = np.linalg.svd((target - centre(target)).T @ around)
    R = scale(s * [1, 1, np.linalg.det(U @ Vt)], around) * rotation(U, Vt)
    return rigid(R, shift(R, source.mean(axis=0), target.mean(axis=0)))


def all_turned(U, Vt):
    """Return U V^T, negated where it is a reflection."""
    return U @ Vt * np.sign(np.linalg.det(U @ Vt))


for slug, says, other in (
    ("mirror",
     "your R is a reflection if the determinant of U V^T is -1, where U S V^T is the "
     "SVD of target^T source with both clouds centred. In this case, negate the "
     "singular vector in U that belongs to the smallest singular value",
               {"rotation": lambda U, Vt: U @ Vt}),
    ("mirror-turned-round",
     "if U V^T is a reflection, your R is -U V^T, where U S V^T is the SVD of target^T "
     "source with both clouds centred. Negate only the singular vector in U that "
     "belongs to the smallest singular value",
     {"rotation": all_turned}),
    ("largest-turned-round",
     "if U V^T is a reflection, your R has the singular vector of the largest singular "
     "value negated. Negate the singular vector of the smallest singular value "
     "instead, because this choice increases the sum of squared distances least",
     {"rotation": lambda U, Vt: U @ np.diag(
         [np.linalg.det(U @ Vt), 1, 1]) @ Vt}),
    ("column-turned-round",
     "if U V^T is a reflection, your R is U V^T with its third column negated. Negate "
     "the third row of V^T before the product instead, because the singular vectors "
     "are the rows of V^T",
     {"rotation": lambda U, Vt: U @ Vt @ np.diag([1, 1, np.linalg.det(U @ Vt)])}),
    ("always-turned-round",
     "your R always has the third singular vector negated. Negate this vector only if "
     "U V^T is a reflection",
     {"rotation": lambda U, Vt: U @ np.diag([1, 1, -1]) @ Vt}),
    ("R-transposed",
     "your code returns the transposed rotation, which maps the target to the source. "
     "R should be U D V^T for the SVD of target^T source with both clouds centred, "
     "where D = diag(1, 1, det U V^T)",
     {"rotation": lambda U, Vt: proper(U, Vt).T}),
    ("worst-fit",
     "your code returns the rotation with the largest sum of squared distances, not "
     "the smallest. Either a sign is wrong, or your eigenvector belongs to the "
     "smallest eigenvalue",
     {"rotation": lambda U, Vt: proper(-U, Vt)}),
    ("not-centred",
     "your rotation is fitted to points without their centroids subtracted. Subtract "
     "the centroids first, because otherwise the translation affects the fitted "
     "rotation",
     {"centre": lambda X: np.zeros(3)}),
    ("one-number-for-the-centre",
     "your code uses the mean of all coordinates, a single number, as the centroid. "
     "Compute one mean for each coordinate instead",
     {"centre": lambda X: X.mean() + np.zeros(3)}),
    ("about-the-first",
     "your rotation is fitted to the offsets from the first point of each cloud. Use "
     "the offsets from the centroids instead, because otherwise the noise of the first "
     "pair affects the whole fit",
     {"centre": lambda X: X[0]}),
    ("scaled",
     "your R contains a scale factor. Return a pure rotation instead, because a rigid "
     "motion preserves distances",
     {"scale": lambda s, source: s.sum() / np.sum(source * source)}),
    ("t-turned-too",
     "your code uses the translation R (b - a), where a and b are the centroids of "
     "source and target. Use b - R a instead",
     {"shift": lambda R, a, b: R @ (b - a)}),
):  # fmt: skip
    row.wrong(slug, says)(partial(fitted, **other))


@row.wrongs
def _(source, target):
    """t-of-the-first: your code computes the translation from the first pair of points.
      Use the centroids of all points instead
    first-for-centre: your code uses the first point of each cloud instead of the
      centroid. Use the centroids, because otherwise the noise of the first pair affects
      the whole fit
    affine: your function fits an affine map by least squares. Fit a rotation and a
      translation instead, because the linear part of an affine map need not be a
      rotation
    """
    R = kabsch(source, target)[:3, :3]
    one = np.hstack([source, np.ones((len(source), 1))])
    M = np.linalg.lstsq(one, target, rcond=None)[0].T
    return {
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
