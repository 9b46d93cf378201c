# task 12.4: stopped (not in a run: the lab would not end)
# The other tree grows towards the sample, until it is equal to it.
import numpy as np


def nearest(tree, q):
    return int(np.argmin(np.sum((tree - q) ** 2, axis=1)))


def steer(q, target, step):
    far = np.linalg.norm(target - q)
    return target.copy() if far <= step else q + step / far * (target - q)


def free(a, b, discs):
    d = b - a
    t = np.clip((discs[:, :2] - a) @ d / max(d @ d, 1e-12), 0, 1)
    away = np.linalg.norm(discs[:, :2] - a - t[:, None] * d, axis=1)
    return bool(np.all(away > discs[:, 2]))


def rrt_connect(start, goal, world, samples, step):
    trees, parents = [[start], [goal]], [[0], [0]]
    for k, sample in enumerate(samples):
        one, other = k % 2, 1 - k % 2
        new = None
        for side in (one, other):
            while new is None or not np.array_equal(trees[side][-1], sample):
                i = nearest(np.array(trees[side]), sample)
                new = steer(trees[side][i], sample, step)
                if free(trees[side][i], new, world):
                    trees[side].append(new)
                    parents[side].append(i)
                    if side == one:
                        break
    return np.array([start, goal])
