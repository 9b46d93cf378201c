"""10.8 `hand_eye(A, B)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pose, Row
from robo47 import screws, se3
from robo47.camera import apply_twist, hand_eye
from robo47.rotation_log import log_rotation

from .kabsch import all_turned, proper, rigid
from .seen import motions


def two_axes(A, B):
    """Return whether motions have two axes, and no angle is nearly pi."""
    a = log_rotation(A[:, :3, :3])
    b = log_rotation(B[:, :3, :3])
    least = min(np.linalg.svd(x, compute_uv=False)[1] for x in (a, b))
    most = max(np.linalg.norm(x, axis=1).max() for x in (a, b))
    return bool(least > 0.1 and most < np.pi - 0.1)


row = Row(Pose(), at_edge=two_axes)


@row.inputs
def _(rng):
    # By 1 rad about x, y and z: a rotation by pi, as an edge is, has two axes.
    turns_1 = np.array([se3.Rx(1.0), se3.Ry(1.0), se3.Rz(1.0)])
    A = se3.make_T(turns_1, rng.numbers(-1, 1, 3, 3))
    exact = motions(rng, 3, noise=0.0)
    return [(A, A), *motions(rng), *flat_fans(rng), *exact]


@row.spans
def _(rng):  # two of the motions rotate by less than 0.2 rad
    for A, B in motions(rng, 2):
        small = np.array([_turned(0.1, way, 0.3) for way in (0.2, 1.9)])
        there = se3.inverse(hand_eye(A, B))
        more = there @ small @ se3.inverse(there) @ _turned(0.005, 0.7, 0.5)
        yield np.concatenate([A, small]), np.concatenate([B, more])


@row.valid(
    "Your result is correct for six exact motions, but for noisy motions it differs "
    "from the result of the specified method. Use the rotation nearest to the sum of "
    "a b^T, as in kabsch, and then the least-squares t for this rotation."
)
def _(A, B, X):
    return np.abs(A @ X - X @ B).max() < 1e-8


def flat_fans(rng, n=4, k=4):
    """Return motions about axes in a plane, as two joints give them.

    They determine X. Measured, the hand's axes point slightly out of the plane upwards
    and the camera's downwards, so U V^T is a reflection.
    """
    found = []
    for X in rng.poses(n):
        across = se3.inverse(X)
        turns = [0.4, 0.9, -0.7, 1.2][:k]
        ways = [0.0, 1.6, 0.7, 2.4][:k]
        hand = np.array([_turned(s, w, 0.1) for s, w in zip(turns, ways, strict=True)])
        eye = np.array([_turned(s, w, -0.1) for s, w in zip(turns, ways, strict=True)])
        tip = se3.make_T(np.eye(3), rng.numbers(-1, 1, 3))
        A, B = (tip @ some @ se3.inverse(tip) for some in (hand, eye))
        found.append((A, across @ B @ X))
    return found


def _turned(angle, way, out):
    """Return a rotation about an axis with z = out."""
    axis = np.array([np.cos(way), np.sin(way), out])
    return apply_twist(np.eye(4), np.append(angle * axis, np.zeros(3)))


def turns(A, B, *, centred=False, unit=False, rotation=proper):
    """Return the rotation between the rotation vectors of A and B."""
    a = log_rotation(A[:, :3, :3])
    b = log_rotation(B[:, :3, :3])
    if unit:
        a = a / np.linalg.norm(a, axis=1)[:, None]
        b = b / np.linalg.norm(b, axis=1)[:, None]
    if centred:
        a = a - a.mean(axis=0)
        b = b - b.mean(axis=0)
    U, _, Vt = np.linalg.svd(a.T @ b)
    return rotation(U, Vt)


def between_places(A, B):
    """Return the rotation between the translations."""
    U, _, Vt = np.linalg.svd(A[:, :3, 3].T @ B[:, :3, 3])
    return proper(U, Vt)


def solved(
    A, B, *, turn=turns, turned=lambda R, t: t @ R.T, some=slice(None)
):  # fmt: skip
    """Return X with another rotation or right side, or of some motions only."""
    R = turn(A, B)
    C = (A[some, :3, :3] - np.eye(3)).reshape(-1, 3)
    right = (turned(R, B[some, :3, 3]) - A[some, :3, 3]).ravel()
    return rigid(R, np.linalg.lstsq(C, right, rcond=None)[0])


for slug, says, other in (
    ("mirror",
     "your R is a reflection if the determinant of U V^T is -1, where U S V^T is the "
     "SVD of the sum of a b^T. In this case, negate the singular vector in U that "
     "belongs to the smallest singular value",
     {"turn": partial(turns, rotation=lambda U, Vt: U @ Vt)}),
    ("mirror-turned-round",
     "if U V^T is a reflection, your R is -U V^T, where U S V^T is the SVD of the sum "
     "of a b^T. Negate only the singular vector in U that belongs to the smallest "
     "singular value",
     {"turn": partial(turns, rotation=all_turned)}),
    ("R-transposed",
     "your code returns the transposed rotation. R should be U D V^T for the SVD of "
     "the sum of a b^T, where D = diag(1, 1, det U V^T), because R maps the camera's "
     "rotation vectors b to the hand's rotation vectors a",
     {"turn": lambda A, B: turns(A, B).T}),
    ("centred",
     "your code subtracts the means of the rotation vectors. Use the rotation vectors "
     "themselves, because the model a = R b has no translation",
     {"turn": partial(turns, centred=True)}),
    ("axes-alone", "your code normalises the rotation vectors. Keep their norms, "
                   "because the axes of small rotations are less accurate and should "
                   "get less weight", {"turn": partial(turns, unit=True)}),
    ("positions-for-rotations",
     "your code fits the rotation to the translations of A and B. Fit the rotation to "
     "the rotation vectors of A and B instead",
     {"turn": between_places}),
    ("R-transposed-in-d",
     "your code rotates t_B by R^T. Use R instead, which maps the camera frame to the "
     "hand frame",
     {"turned": lambda R, t: t @ R}),
    ("first-motion-only",
     "your code solves for t from the first motion only. A single motion does not "
     "determine t along the rotation axis of that motion, so use the equations of "
     "all motions",
     {"some": slice(1)}),
    ("last-motion-only",
     "your code solves for t from the last motion only. A single motion does not "
     "determine t along the rotation axis of that motion, so use the equations of "
     "all motions",
     {"some": slice(-1, None)}),
):  # fmt: skip
    why = "only the axes about joint 7 are in one plane in the lab"
    hidden = why if slug.startswith("mirror") else ""
    row.wrong(slug, says, hidden=hidden)(partial(solved, **other))


@row.wrongs
def _(A, B):
    """t-of-the-mean: your t is the mean of the solutions for the individual motions. A
      single motion does not determine t along the rotation axis of that motion, so
      solve the equations of all motions together
    centred-the-other-way: your code subtracts the means of the rotation vectors and
      fits the rotation from a to b. Fit the rotation from b to a without subtracting
      the means, because a = R b has no translation
    t-as-if-alike: your code uses the mean of `t_A - R t_B` as t. Solve `(R_A - I) t = R
      t_B - t_A` for all motions by least squares instead, where I is the identity
      matrix
    t-as-if-alike 2: your code uses the mean of `R t_B - t_A` as t. Solve `(R_A - I) t =
      R t_B - t_A` for all motions by least squares instead, where I is the identity
      matrix
    """
    R = hand_eye(A, B)[:3, :3]
    alone = [
        solved(A[k : k + 1], B[k : k + 1], turn=lambda A, B: R)[:3, 3]
        for k in range(len(A))
    ]
    alike = np.mean(A[:, :3, 3] - B[:, :3, 3] @ R.T, axis=0)
    return {
        "t-of-the-mean": rigid(R, np.mean(alone, axis=0)),
        "centred-the-other-way": solved(
            A, B, turn=lambda A, B: turns(B, A, centred=True)
        ),
        "t-as-if-alike": rigid(R, alike),
        "t-as-if-alike 2": rigid(R, -alike),
    }


row.same(
    "C = (A[:, :3, :3] - np.eye(3)).reshape(-1, 3) => "
    "C = (A[:, :3, :3] - np.eye(3)).reshape(-2, 3)",
    "NumPy infers any negative size",
)


@row.right  # By the polar factor and the normal equations.
def _(A, B):
    M = sum(
        np.outer(log_rotation(a[:3, :3]), log_rotation(b[:3, :3]))
        for a, b in zip(A, B, strict=True)
    )
    w, V = np.linalg.eigh(M.T @ M)
    w = np.sqrt(np.maximum(w, 0)) * [np.sign(np.linalg.det(M)), 1, 1]
    R = M @ V @ np.diag(1 / w) @ V.T
    left = np.zeros((3, 3))
    right = np.zeros(3)
    for a, b in zip(A, B, strict=True):
        C = a[:3, :3] - np.eye(3)
        left = left + C.T @ C
        right = right + C.T @ (R @ b[:3, 3] - a[:3, 3])
    return rigid(R, np.linalg.solve(left, right))


@row.wrong("another-method")  # Tsai, Lenz, 1989: 2 tan(angle / 2) along each axis.
def _(A, B):
    def halved(T):
        r = log_rotation(T[:, :3, :3])
        angle = np.linalg.norm(r, axis=1, keepdims=True)
        return 2.0 * np.sin(angle / 2.0) * r / angle

    a, b = halved(A), halved(B)
    S = np.vstack([screws.skew(x) for x in a + b])
    x, *_ = np.linalg.lstsq(S, (b - a).ravel(), rcond=None)
    p = 2.0 * x / np.sqrt(1.0 + x @ x)
    R = (1.0 - p @ p / 2.0) * np.eye(3)
    R += (np.outer(p, p) + np.sqrt(4.0 - p @ p) * screws.skew(p)) / 2.0
    return solved(A, B, turn=lambda A, B: R)


@row.wrong(
    "another-method"
)  # Andreff, 1999: both parts at once, by Kronecker products.
def _(A, B):
    rows, right = [], []
    for a, b in zip(A, B, strict=True):
        of_R = np.kron(np.eye(3), a[:3, :3]) - np.kron(b[:3, :3].T, np.eye(3))
        of_t = np.kron(b[:3, 3], np.eye(3)), np.eye(3) - a[:3, :3]
        rows += [np.hstack([of_R, np.zeros((9, 3))]), np.hstack(of_t)]
        right += [np.zeros(9), a[:3, 3]]
    found, *_ = np.linalg.lstsq(np.vstack(rows), np.concatenate(right), rcond=None)
    U, _, Vt = np.linalg.svd(found[:9].reshape(3, 3).T)
    return rigid(proper(U, Vt), found[9:])


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Motions under 0.2 rad are left out.
def _(A, B):
    angles = np.linalg.norm(log_rotation(A[:, :3, :3]), axis=1)
    return hand_eye(A[angles > 0.2], B[angles > 0.2])
