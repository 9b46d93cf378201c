"""14.5 `observe(T_seen, noise)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47 import se3

QUARTER = np.pi / 2


def off_the_fold(T_seen, noise):
    """Return whether the yaw is not where the fold is."""
    yaw = np.arctan2(T_seen[1, 0], T_seen[0, 0]) + np.array([0, noise[2]])
    beside = np.abs((yaw + np.pi / 4 + 1) % QUARTER - 1) < 1e-6
    return not beside.any()


row = Row(Vector((3,), "m, rad", names=("x", "y", "yaw")), at_edge=off_the_fold)


def pose(yaw, x, y):
    """Return the pose of an upright cube."""
    return se3.make_T(se3.Rz(yaw), (x, y, 0.02))


@row.inputs
def _(rng):
    yield pose(1.0, 0.4, 0.1), np.zeros(3)
    yield pose(0.0, 0.4, 0.1), np.array([0, 0, np.pi / 4])  # at the fold itself
    # within the fold; over it by the noise alone; further round, both ways
    for yaw, turn in (
        (0.3, -0.05),
        (-0.5, 0.02),
        (0.77, 0.04),
        (-0.77, -0.03),
        (0.8, -0.05),
        (-2.4, 0.07),
        (2.4, -0.02),
        (3.1, 0.06),
    ):
        x, y = rng.numbers(-0.3, 0.6, 2)
        yield pose(yaw, x, y), np.append(rng.numbers(-0.01, 0.01, 2), turn)
    for yaw in rng.numbers(-3.1, 3.1, 8):
        x, y = rng.numbers(-0.3, 0.6, 2)
        yield pose(yaw, x, y), rng.numbers(-0.05, 0.05, 3)


def fold(yaw, period=QUARTER):
    """Return an angle folded about 0."""
    return (yaw + period / 2) % period - period / 2


@row.wrongs
def _(T_seen, noise):
    """not-folded: your code does not reduce the yaw. Reduce it modulo pi/2 to [-pi/4,
      pi/4), because a cube looks the same after a rotation by pi/2
    folded-to-0-to-90: your code reduces the yaw to [0, pi/2). Reduce it to [-pi/4,
      pi/4) instead
    folded-by-pi: your code reduces the yaw modulo pi. Reduce it modulo pi/2, because a
      cube already looks the same after a rotation by pi/2
    folded-by-pi-over-4: your code reduces the yaw modulo pi/4. Reduce it modulo pi/2,
      because pi/2 is the smallest rotation after which a cube looks the same
    folded-once: your code adds or subtracts pi/2 at most once. Use `%` or `np.mod`
      instead, because a single rotation by pi/2 is not enough for a yaw outside [-3
      pi/4, 3 pi/4)
    noise-after-the-fold: your code adds the noise after the reduction, so the yaw can
      leave [-pi/4, pi/4). Add the noise before the reduction
    fmod: your reduction rounds towards 0, as `np.fmod` does, so some results are below
      -pi/4. Use `%` or `np.mod` instead
    transposed: your code negates the yaw, as with the transposed rotation matrix. Use
      `np.arctan2(R[1, 0], R[0, 0])`
    arccosine: your code uses a yaw that is never negative, such as arccos(R[0, 0]). Use
      `np.arctan2(R[1, 0], R[0, 0])` instead
    arcsine: your code uses arcsin(R[1, 0]) as the yaw, which covers only [-pi/2, pi/2].
      Use `np.arctan2(R[1, 0], R[0, 0])` instead
    noise-in-the-cubes-axes: your code adds the noise along the axes of the cube. Add
      the noise along the x and y axes of the world frame instead
    x-and-y-swapped: your code swaps x and y. Return them in the order (x, y, yaw)
    yaw-first: your code returns the yaw first. Use the order (x, y, yaw)
    """
    at = T_seen[:2, 3]
    R = T_seen[:3, :3]
    yaw = np.arctan2(R[1, 0], R[0, 0])
    full = yaw + noise[2]

    def seen(angle, place=None):
        return np.append(at + noise[:2] if place is None else place, angle)

    once = full
    if once >= np.pi / 4:
        once = once - QUARTER
    elif once < -np.pi / 4:
        once = once + QUARTER
    right = seen(fold(full))
    return {
        "not-folded": seen(full),
        "folded-to-0-to-90": seen(full % QUARTER),
        "folded-by-pi": seen(fold(full, np.pi)),
        "folded-by-pi-over-4": seen(fold(full, np.pi / 4)),
        "folded-once": seen(once),
        "noise-after-the-fold": seen(fold(yaw) + noise[2]),
        "fmod": seen(np.fmod(full + np.pi / 4, QUARTER) - np.pi / 4),
        "transposed": seen(fold(-yaw + noise[2])),
        "arccosine": seen(fold(np.arccos(np.clip(R[0, 0], -1, 1)) + noise[2])),
        "arcsine": seen(fold(np.arcsin(np.clip(R[1, 0], -1, 1)) + noise[2])),
        "noise-in-the-cubes-axes": seen(fold(full), at + R[:2, :2] @ noise[:2]),
        "x-and-y-swapped": right[[1, 0, 2]],
        "yaw-first": right[[2, 0, 1]],
    }


@row.right  # arctan for arctan2: what it loses is a half turn, and the fold is by less.
def _(T_seen, noise):
    with np.errstate(divide="ignore"):
        yaw = np.arctan(T_seen[1, 0] / T_seen[0, 0]) + noise[2]
    while yaw >= np.pi / 4:
        yaw -= np.pi / 2
    while yaw < -np.pi / 4:
        yaw += np.pi / 2
    return np.array([T_seen[0, 3] + noise[0], T_seen[1, 3] + noise[1], yaw])


@row.wrong(hidden="no cube of the lab has a yaw of exactly pi/4")
def fold_at_the_other_end(T_seen, noise):
    """your code leaves a yaw of exactly pi/4 unchanged. Return -pi/4 instead, because
    the interval [-pi/4, pi/4) excludes pi/4"""
    yaw = np.arctan2(T_seen[1, 0], T_seen[0, 0]) + noise[2]
    return np.append(T_seen[:2, 3] + noise[:2], yaw - QUARTER * np.round(yaw / QUARTER))


row.spans(  # as small, or as large, as in the lab
    noise=(lambda noise: 0.03 * noise,),
)
