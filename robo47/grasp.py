"""What a finger feels, and what a grasp can resist.

Conventions:

- A contact's normal, of length 1, points out of the finger into the thing that is
  held; forces act *on the thing*. Both in world axes.
- Friction is Coulomb's: a contact holds while |f_t| <= mu f_n. That is a cone about the
  normal; `cone_edges` cuts it to a pyramid of k edges.
- Wrenches are (moment; force), the moment about a point of the thing.
- Metres, newtons, float64. Contacts broadcast; a grasp is one set of contacts.

Sources: Lynch and Park, *Modern Robotics* (2017), sections 12.1.3 and 12.2; Murray, Li
and Sastry, *A Mathematical Introduction to Robotic Manipulation* (1994), chapter 5.
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.policy import LOW
from robo47.screws import skew

FINGER_POSITION = 4  # of a policy's six numbers: how far each pad is from the middle
RANK = 1e-9  # a singular value counts above this times the largest
BALANCE = 1e-9  # what may be left of a sum that is 0, of the sum of its sizes


def cone_margin(force: ArrayLike, normal: ArrayLike, mu: ArrayLike) -> Array:
    """Return how far contacts are from slipping: mu f_n - |f_t| (Coulomb).

    Args:
        force: on the thing, newtons, (..., 3).
        normal: out of the finger, of length 1, (..., 3).
        mu: friction, at least 0, (...).

    Returns:
        Newtons, (...): negative outside the cone; a pull is outside.

    Raises:
        ValueError: a wrong shape or number, or a normal that has another length.
    """
    f = checks.array(force, "force", (3,))
    n = checks.unit_vector(normal, "normal")
    press = np.sum(f * n, axis=-1)
    along = np.linalg.norm(f - press[..., None] * n, axis=-1)
    return checks.not_negative(mu, "mu") * press - along


def grip_reflex_step(
    finger_position: float,
    force: ArrayLike,
    normal: ArrayLike,
    mu: ArrayLike,
    fraction: float,
    step: float,
) -> float:
    """Return the next opening: closed by a step where a contact nearly slips.

    Nearly: its margin is below a share of what it has when nothing pulls at it, mu f_n.

    Args:
        finger_position: that the fingers are told now, metres.
        force, normal, mu: of all contacts, as in `cone_margin`, (n, 3), (n, 3), (n,);
            none, and the opening stays.
        fraction: of mu f_n that is to be left, 0 to 1.
        step: metres, above 0.

    Returns:
        The opening, metres; never closed beyond `policy.LOW`'s.

    Raises:
        ValueError: as `cone_margin`.
    """
    margin = cone_margin(force, normal, mu)
    press = np.sum(np.multiply(force, normal), axis=-1)
    if not np.any(margin < fraction * np.asarray(mu) * press):
        return float(finger_position)
    return float(
        max(finger_position - checks.positive(step, "step"), LOW[FINGER_POSITION])
    )


def grasp_matrix(points: ArrayLike, centre: ArrayLike) -> Array:
    """Return what forces at points do to a thing: G times all forces is a wrench.

    Args:
        points: where the contacts are, metres, (n, 3).
        centre: about which moments are taken, metres, (3,).

    Returns:
        G, (6, 3 n): [[p - c]; 1] for each point, one after the other.

    Raises:
        ValueError: a wrong shape.
    """
    points = checks.array(points, "points", ("n", 3))
    arms = skew(points - checks.array(centre, "centre", (3,)))
    blocks = np.concatenate([arms, np.broadcast_to(np.eye(3), arms.shape)], axis=1)
    return np.hstack(list(blocks))


def cone_edges(normal: ArrayLike, mu: float, k: int) -> Array:
    """Return k edges of a friction cone, so that their positive sums are inside it.

    n + mu (cos t a + sin t b), t = 2 pi i / k, with a = n x axis of length 1, for the
    axis least along n (the first of equals), and b = n x a.

    Args:
        normal: of length 1, (3,).
        mu: friction, at least 0.
        k: number of edges, at least 1.

    Returns:
        (k, 3): each presses with 1, so it is longer than 1 where mu is above 0.

    Raises:
        ValueError: a wrong shape or number, or a normal that has another length.
    """
    n = checks.unit_vector(checks.array(normal, "normal", (3,)), "normal")
    if k < 1:
        raise ValueError(f"k is {k}; a cone has at least one edge")
    a = np.cross(n, np.eye(3)[np.argmin(np.abs(n))])
    a = checks.unit(a, "normal")
    b = np.cross(n, a)
    t = 2.0 * np.pi * np.arange(k)[:, None] / k
    return n + checks.not_negative(mu, "mu") * (np.cos(t) * a + np.sin(t) * b)


def certifies_force_closure(W: ArrayLike, weights: ArrayLike) -> bool:
    """Return whether weights prove that a grasp resists every wrench.

    They do where W has rank 6 and W w = 0 with every weight above 0: then each column
    can be undone by the others, and any wrench is a sum of columns with weights of one
    sign (Modern Robotics, 12.1.7). Not to find such weights proves nothing.

    Args:
        W: wrenches of all edges of all contacts, in columns, (6, n).
        weights: of the columns, (n,).

    Returns:
        True or False; the same in any unit of force or length that serves all columns.

    Raises:
        ValueError: a wrong shape.
    """
    W = checks.array(W, "W", (6, "n"))
    w = checks.array(weights, "weights", W.shape[1:])
    s = np.linalg.svd(W, compute_uv=False)
    full = len(s) == 6 and s[-1] > RANK * s[0]
    left = np.abs(W @ w)
    balanced = np.all(left <= BALANCE * (np.abs(W) @ np.abs(w)))
    return bool(full and balanced and np.all(w > 0.0))
