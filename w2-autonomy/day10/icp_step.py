"""10.9 `icp_step(T, source, target)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row, rounded
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
    """Return the nearest unused target point of each point, (n,)."""
    away = away.copy()
    found = []
    for one in away:
        found.append(int(np.argmin(one)))
        away[:, found[-1]] = np.inf
    return found


@row.wrongs
def _(T, source, target):
    """step-alone: your code returns the motion that is fitted to the source points
      after T has moved them. Fit the motion to the original source points instead, or
      multiply T by the step from the left
    step-on-the-right: your code multiplies T by the step from the right. Multiply T
      from the left instead, because the step is applied after T
    step-twice: your code multiplies the fitted motion by T. Omit T, because the motion
      is fitted to the original source points and already includes T
    step-twice 2: your code multiplies the fitted motion by T. Omit T, because the
      motion is fitted to the original source points and already includes T
    by-sizes-added: your code chooses the nearest point by the sum of the absolute
      coordinate differences. Use the Euclidean distance instead
    nearer-half: your code uses only the closer half of the pairs for the fit. Use all
      pairs instead
    each-once: your code uses each target point at most once. Omit this restriction,
      because several source points may have the same nearest target point
    in-the-plane: your code uses only x and y to find the nearest point. Use all three
      coordinates instead
    pairs-of-the-target: your code pairs each target point with the nearest source
      point. Pair each source point with the nearest target point instead
    first-to-first: your code pairs the points by their indices. Pair each source point
      with the nearest target point instead
    T-unchanged: your code returns T itself. Return the motion that is fitted to the
      pairs of source and target points instead
    """
    now = source @ T[:3, :3].T + T[:3, 3]
    best = nearest(now, target)
    away = ((now[:, None] - target) ** 2).sum(axis=2)
    back = source[np.argmin(away, axis=0)]
    flat = ((now[:, None] - target)[..., :2] ** 2).sum(axis=2)
    sizes = np.abs(now[:, None] - target).sum(axis=2)
    least = away.min(axis=1)
    near = least < np.median(least)
    step = kabsch(now, best)
    right = kabsch(source, best)
    return {
        "step-alone": step,
        "step-on-the-right": T @ step,
        "step-twice": right @ T,
        "step-twice 2": T @ right,
        "by-sizes-added": kabsch(source, target[np.argmin(sizes, axis=1)]),
        "nearer-half": lambda: kabsch(source[near], best[near]),
        "each-once": kabsch(source, target[once_each(away)]),
        "in-the-plane": kabsch(source, target[np.argmin(flat, axis=1)]),
        "pairs-of-the-target": kabsch(back, target),
        "first-to-first": kabsch(source, target[: len(source)]),
        "T-unchanged": T,
    }


@row.right  # A loop, with the step on the left of T.
def _(T, source, target):
    now = np.array([T[:3, :3] @ p + T[:3, 3] for p in source])
    best = [min(target, key=lambda x, p=p: np.linalg.norm(x - p)) for p in now]
    return kabsch(now, np.array(best)) @ T
