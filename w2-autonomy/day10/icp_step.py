"""10.9 `icp_step(T, source, target)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row, rounded
from labkit.judge.argument_mistakes import Change
from robo47 import se3
from robo47.camera import apply_twist, kabsch

row = Row(Pose())


@row.inputs
def _(rng):
    found = []
    for n, T in zip((20, 20, 12, 12, 30), rng.poses(5), strict=True):
        source = rng.numbers(-1, 1, n, 3)
        target = source @ T[:3, :3].T + T[:3, 3] + rng.normal(scale=0.05, size=(n, 3))
        more = np.vstack([target, rng.numbers(-1, 1, 8, 3)])
        guess = apply_twist(T, 0.15 * rng.normal(size=6))
        found.append((guess, source, rounded(rng.permutation(more))))
    cloud = rng.numbers(-1, 1, 10, 3)
    return [(np.eye(4), cloud, cloud), *found]


def nearest(points, target):
    """Return the nearest of target for each point."""
    away = ((points[:, None] - target) ** 2).sum(axis=2)
    return target[np.argmin(away, axis=1)]


def once_each(away):
    """Return the nearest that is still free for each point, in turn, (n,)."""
    away = away.copy()
    found = []
    for one in away:
        found.append(int(np.argmin(one)))
        away[:, found[-1]] = np.inf
    return found


@row.wrongs
def _(T, source, target):
    """guess-not-used: each point is paired where it stands; T moves it first
    step-alone: this is the step from where T has taken the points; asked for is the
      whole motion, from the source => kabsch of the moved points
    step-on-the-right: the step stands on T's right; it comes after T, so on its left =>
      T times the step
    step-twice: T is applied twice: the points that are fitted are the source's, so T is
      in the answer already => it times T
    step-twice 2: T is applied twice: the points that are fitted are the source's, so T
      is in the answer already => T times it
    by-sizes-added: the nearest is the one whose differences, without signs, add up to
      the least; near is the length of the difference => with sums of |x - y|
    nearer-half: only the nearer half of the pairs is fitted; all are
    each-once: a point of the target is taken once only; several of the source may share
      the nearest => with pairs that no other has
    farthest: each point is paired with the farthest
    in-the-plane: only x and y say which is nearest
    other-way: this is the motion from target to source
    pairs-of-the-target: each point of the target is paired with the nearest of the
      source; it is the source's points that are all used
    first-to-first: points are paired by their place in the list, not by the nearest
    T-unchanged: this is T itself
    """
    now = source @ T[:3, :3].T + T[:3, 3]
    best = nearest(now, target)
    away = ((now[:, None] - target) ** 2).sum(axis=2)
    back = source[np.argmin(away, axis=0)]
    beside = ((now[:, None] - target)[..., :2] ** 2).sum(axis=2)
    sizes = np.abs(now[:, None] - target).sum(axis=2)
    least = away.min(axis=1)
    near = least < np.median(least)
    step = kabsch(now, best)
    right = kabsch(source, best)
    return {
        "guess-not-used": kabsch(source, nearest(source, target)),
        "step-alone": step,
        "step-on-the-right": T @ step,
        "step-twice": right @ T,
        "step-twice 2": T @ right,
        "by-sizes-added": kabsch(source, target[np.argmin(sizes, axis=1)]),
        "nearer-half": lambda: kabsch(source[near], best[near]),
        "each-once": kabsch(source, target[once_each(away)]),
        "farthest": kabsch(source, target[np.argmax(away, axis=1)]),
        "in-the-plane": kabsch(source, target[np.argmin(beside, axis=1)]),
        "other-way": np.linalg.inv(right),
        "pairs-of-the-target": kabsch(back, target),
        "first-to-first": kabsch(source, target[: len(source)]),
        "T-unchanged": T,
    }


row.of_argument(
    "T",
    Change(
        "moved-by-the-inverse",
        "T's inverse moves the source; T takes source to target",
        se3.inverse,
        "the right one from T's inverse",
    ),
    Change(
        "R-transposed",
        "T's rotation is transposed before the points are paired: they stand in rows, "
        "so it is p R^T",
        lambda T: se3.make_T(T[:3, :3].T, T[:3, 3]),
        "with R^T",
    ),
    Change(
        "t-forgotten",
        "the points are turned by T, but not moved, before they are paired",
        lambda T: se3.make_T(T[:3, :3], np.zeros(3)),
        "without t",
    ),
    Change(
        "R-forgotten",
        "the points are moved by T, but not turned, before they are paired",
        lambda T: se3.make_T(np.eye(3), T[:3, 3]),
        "without R",
    ),
)


@row.right  # By a loop, and the step put before T.
def _(T, source, target):
    now = np.array([T[:3, :3] @ p + T[:3, 3] for p in source])
    best = [min(target, key=lambda x, p=p: np.linalg.norm(x - p)) for p in now]
    return kabsch(now, np.array(best)) @ T
