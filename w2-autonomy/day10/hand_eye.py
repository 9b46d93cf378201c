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
    exact = motions(rng, 3, noise=0.0)
    return [(A, A), *motions(rng), *flat_fans(rng), *exact]


@row.spans
def _(rng):  # two of the motions turn by less than 0.2 rad
    for A, B in motions(rng, 2):
        small = np.array([_turned(0.1, way, 0.3) for way in (0.2, 1.9)])
        there = se3.inverse(hand_eye(A, B))
        more = there @ small @ se3.inverse(there) @ _turned(0.005, 0.7, 0.5)
        yield np.concatenate([A, small]), np.concatenate([B, more])


@row.valid(
    "Valid for exact motions. With noise no X fits all of them, and another method "
    "gives another X: asked is the rotation from the rotation vectors, nearest to the "
    "sum of a b^T as in kabsch, then t by least squares with this rotation."
)
def _(A, B, X):
    return np.abs(A @ X - X @ B).max() < 1e-8


def flat_fans(rng, n=4, k=4):
    """Return motions about axes in a plane, as two joints give them.

    They are enough for X. Measured, they stand out of the plane by a little, the
    hand's up and the camera's down: then U V^T is a mirror image.
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
    """Return a turn about an axis in the plane of x and y, but for `out`."""
    axis = np.array([np.cos(way), np.sin(way), out])
    return apply_twist(np.eye(4), np.append(angle * axis, np.zeros(3)))


def turns(A, B, *, centred=False, unit=False, rotation=proper):
    """Return the rotation between two fans of rotation vectors."""
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
    A, B, *, turn=turns, of=lambda A, B: A, minus=1.0, turned=lambda R, t: t @ R.T,
    d=lambda b, a: b - a, some=slice(None),
):  # fmt: skip
    """Return X with other parts: by which R, which C, which d, of which motions."""
    R = turn(A, B)
    C = (of(A, B)[some, :3, :3] - minus * np.eye(3)).reshape(-1, 3)
    right = d(turned(R, B[some, :3, 3]), A[some, :3, 3]).ravel()
    return rigid(R, np.linalg.lstsq(C, right, rcond=None)[0])


for slug, says, redone, other in (
    ("mirror", "the sign of the determinant is not looked at: of axes in one plane U "
     "V^T may be a mirror image", "U V^T as it is",
     {"turn": partial(turns, rotation=lambda U, Vt: U @ Vt)}),
    ("mirror-turned-round", "the mirror is made a rotation by another sign for all of "
     "it; only the direction of the smallest singular value turns round",
     "with -R there", {"turn": partial(turns, rotation=all_turned)}),
    ("R-transposed", "the rotation is the other way round: a = R b, so it comes from "
     "the sum of a b^T", "with R^T in both steps",
     {"turn": lambda A, B: turns(A, B).T}),
    ("centred", "the rotation vectors are moved to their mean; they turn about the "
     "origin, and nothing else moves them", "kabsch on them",
     {"turn": partial(turns, centred=True)}),
    ("axes-alone", "each rotation vector is made of length 1: small turns, whose axes "
     "are known worst, then count as much as large ones", "with axes of length 1",
     {"turn": partial(turns, unit=True)}),
    ("positions-for-rotations", "the rotation is that between the translations of A "
     "and B; it is the one between their rotation vectors", "with it",
     {"turn": between_places}),
    ("one-not-taken-off", "1 is missing in (R_A - 1) t; t stands on both sides",
     "with R_A t", {"minus": 0.0}),
    ("one-added", "it is (R_A + 1) t; 1 is taken off", "with (R_A + 1) t",
     {"minus": -1.0}),
    ("R_B-for-R_A", "the matrix is R_B - 1; it is R_A - 1, since t is in the hand's "
     "axes", "with R_B - 1", {"of": lambda A, B: B}),
    ("d-sign", "the right side has the wrong sign: it is R t_B - t_A", "with -d",
     {"d": lambda b, a: a - b}),
    ("d-added", "the right side is R t_B + t_A; it is R t_B - t_A", "with R t_B + t_A",
     {"d": lambda b, a: b + a}),
    ("R-forgotten-in-d", "t_B is not turned by X's rotation before t_A is taken off",
     "with t_B - t_A", {"turned": lambda R, t: t}),
    ("R-transposed-in-d", "t_B is turned the other way, by R^T; R is right, and turns "
     "what the camera says to the hand's axes", "with R^T t_B - t_A",
     {"turned": lambda R, t: t @ R}),
    ("first-motion-only", "only the first motion is used for t; one does not show it "
     "all", "with the first", {"some": slice(1)}),
    ("last-motion-only", "only the last motion is used for t; one does not show it all",
     "with the last", {"some": slice(-1, None)}),
):  # fmt: skip
    why = "no axes of the lab lie in one plane, but those about joint 7"
    hidden = why if slug.startswith("mirror") else ""
    row.wrong(slug, says, redone, hidden)(partial(solved, **other))


@row.wrongs
def _(A, B):
    """other-way: this is the hand seen from the camera, X's inverse => hand_eye(B, A)
    t-left-out: the translation is 0: only the rotation is solved
    t-of-the-mean: each motion is solved alone, and the mean taken; one motion does not
      show the slide along its axis, so stack them => with the mean of pinv (R_A - 1) d
    centred-the-other-way: the rotation vectors are moved to their mean and turned the
      other way round; they turn about the origin, and a = R b => kabsch(a, b)
    halved: the translation is half of what it is
    t-as-if-alike: the translation is the mean of t_A - R t_B, as if the hand did not
      turn; it is (R_A - 1) t that this is => the mean of t_A - R t_B
    t-as-if-alike 2: the translation is the mean of R t_B - t_A, as if the hand did not
      turn; it is (R_A - 1) t that this is => the mean of R t_B - t_A
    """
    right = hand_eye(A, B)
    R = right[:3, :3]
    alone = [
        solved(A[k : k + 1], B[k : k + 1], turn=lambda A, B: R)[:3, 3]
        for k in range(len(A))
    ]
    alike = np.mean(A[:, :3, 3] - B[:, :3, 3] @ R.T, axis=0)
    return {
        "other-way": hand_eye(B, A),
        "t-left-out": rigid(R, 0 * right[:3, 3]),
        "t-of-the-mean": rigid(R, np.mean(alone, axis=0)),
        "centred-the-other-way": solved(
            A, B, turn=lambda A, B: turns(B, A, centred=True)
        ),
        "halved": rigid(R, right[:3, 3] / 2),
        "t-as-if-alike": rigid(R, alike),
        "t-as-if-alike 2": rigid(R, -alike),
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
