"""10.9 `icp_step(T, source, target)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row, rounded
from robo47.camera import kabsch, moved

row = Row(Pose())


@row.inputs
def _(rng):
    found = []
    for n, T in zip((20, 20, 12, 12, 30), rng.poses(5), strict=True):
        source = rng.numbers(-1, 1, n, 3)
        target = source @ T[:3, :3].T + T[:3, 3] + rng.normal(scale=0.05, size=(n, 3))
        more = np.vstack([target, rng.numbers(-1, 1, 8, 3)])
        guess = moved(T, 0.15 * rng.normal(size=6))
        found.append((guess, source, rounded(rng.permutation(more))))
    cloud = rng.numbers(-1, 1, 10, 3)
    return [(np.eye(4), cloud, cloud), *found]


def nearest(points, target):
    """Return the nearest of target for each point."""
    away = ((points[:, None] - target) ** 2).sum(axis=2)
    return target[np.argmin(away, axis=1)]


@row.wrongs
def _(T, source, target):
    """guess-not-used: each point is paired where it stands; T moves it first
    step-alone: this is the step from where T has taken the points; asked for is the
      whole motion, from the source => kabsch of the moved points
    step-twice: T is applied twice: the points that are fitted are the source's, so T is
      in the answer already => it times T
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
    step = kabsch(now, best)
    right = kabsch(source, best)
    return {
        "guess-not-used": kabsch(source, nearest(source, target)),
        "step-alone": step,
        "step-twice": right @ T,
        "other-way": np.linalg.inv(right),
        "pairs-of-the-target": kabsch(back, target),
        "first-to-first": kabsch(source, target[: len(source)]),
        "T-unchanged": T,
    }


@row.right  # By a loop, and the step put before T.
def _(T, source, target):
    now = np.array([T[:3, :3] @ p + T[:3, 3] for p in source])
    best = [min(target, key=lambda x, p=p: np.linalg.norm(x - p)) for p in now]
    return kabsch(now, np.array(best)) @ T
