"""A circle that the Panda's hand is to draw: its poses, and how near an arm can come.

The circle stands in the y-z plane, and the tool points down all the way: with a radius
of 0.36 m all of it is in reach; the top of one of 0.38 m is not. Metres, radians.
"""

import numpy as np

from robo47.checks import Array
from robo47.jacobian import solve_ik
from robo47.screws import fk_space

CENTRE = np.array([0.28, -0.06, 0.55])
LAP = 6.0  # seconds
# From here the elbow meets no joint limit on the way.
_START_Q = np.array([0.5, -1.3, 0.0, -2.4, -0.5, 1.7, 1.2])


def circle(
    arm: tuple[Array, Array], limits: Array, radius: float, times: Array
) -> tuple[Array, Array]:
    """Return where the hand should be, and joint angles at the first of these poses.

    Args:
        arm: screws, (7, 6), and home pose, (4, 4).
        limits: of the joints, (7, 2).
        radius: of the circle.
        times: in seconds, (n,); a lap takes LAP.

    Returns:
        Poses, (n, 4, 4), and q, (7,): the library's, so that all start alike.
    """
    phi = 2 * np.pi * np.asarray(times) / LAP
    T = np.tile(np.diag([-1.0, 1.0, -1.0, 1.0]), (len(phi), 1, 1))
    T[:, :3, 3] = CENTRE
    T[:, 1, 3] += radius * np.cos(phi)
    T[:, 2, 3] += radius * np.sin(phi)
    return T, solve_ik(*arm, T[0], _START_Q, limits)


def least_miss(arm: tuple[Array, Array], limits: Array, path: Array, q: Array) -> Array:
    """Return how far from each pose the hand must stay, mm, (n,): 0 within reach.

    Args:
        arm: screws, (7, 6), and home pose, (4, 4).
        limits: of the joints, (7, 2).
        path: poses, (n, 4, 4), each tried from hundreds of starts.
        q: the first of these, (7,).
    """
    best = fk_space(*arm, solve_ik(*arm, path, q, limits))
    return 1000 * np.linalg.norm(best[:, :3, 3] - path[:, :3, 3], axis=1)
