"""Contact forces, friction cones and force closure.

Conventions:

- A contact's normal is a unit vector out of the finger into the object; forces act *on
the object*. Both are expressed in the world frame. - Friction is Coulomb's: a contact
does not slip as long as |f_t| <= mu f_n. These forces form a cone about the normal;
`cone_edges` replaces it by a pyramid of k edges, which lies inside the cone. - Wrenches
are (moment; force), with the moment about a point of the object. - Metres, newtons,
float64. Contacts broadcast; a grasp is one set of contacts.

Sources: Lynch and Park, *Modern Robotics* (2017), sections 12.1.7 and 12.2; Murray, Li
and Sastry, *A Mathematical Introduction to Robotic Manipulation* (1994), chapter 5.
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.policy import LOW
from robo47.screws import skew

FINGER_POSITION = 4  # index in theta: the distance of each pad from the middle
RANK = 1e-9  # smallest singular value of a full rank, relative to the largest
BALANCE = 1e-9  # largest sum that is treated as 0, relative to the sum of its terms


def cone_margin(force: ArrayLike, normal: ArrayLike, mu: ArrayLike) -> Array:
    """Return each contact's friction cone margin, mu f_n - |f_t| (Coulomb's law).

    Args:
        force: on the object, newtons, (..., 3).
        normal: unit vectors out of the finger, (..., 3).
        mu: coefficients of friction, at least 0, (...).

    Returns:
        Margins in newtons, (...): negative outside the cone, so for every pull.

    Raises:
        ValueError: a wrong shape or number, or a normal that is no unit vector.
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
    """Return the next finger position: closed by a step if any contact nearly slips.

    A contact nearly slips if its margin is below a fraction of mu f_n, its margin
    without tangential force.

    Args:
        finger_position: commanded distance of each pad from the middle, metres.
        force, normal, mu: of all contacts, as in `cone_margin`, (n, 3), (n, 3), (n,);
            without a contact the position does not change.
        fraction: of mu f_n, 0 to 1.
        step: metres, above 0.

    Returns:
        The next finger position, metres; never below the limit in `policy.LOW`.

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
    """Return the grasp matrix G, which maps the contact forces to one wrench.

    Args:
        points: contact points, metres, (n, 3).
        centre: reference point c of the moment, metres, (3,).

    Returns:
        G, (6, 3 n): the blocks [[p - c]; 1] of the contacts, side by side.

    Raises:
        ValueError: a wrong shape.
    """
    points = checks.array(points, "points", ("n", 3))
    arms = skew(points - checks.array(centre, "centre", (3,)))
    blocks = np.concatenate([arms, np.broadcast_to(np.eye(3), arms.shape)], axis=1)
    return np.hstack(list(blocks))


def cone_edges(normal: ArrayLike, mu: float, k: int) -> Array:
    """Return the k edges of a friction pyramid, which lies inside the friction cone.

    The edges are n + mu (cos t a + sin t b) with t = 2 pi i / k. Here a is the unit
    vector along n x axis, where axis is the coordinate axis with the smallest
    |component| of n (the first of equals), and b = n x a.

    Args:
        normal: unit vector n, (3,).
        mu: coefficient of friction, at least 0.
        k: number of edges, at least 1.

    Returns:
        (k, 3): each edge has a normal force of 1, so its norm is above 1 if mu is.

    Raises:
        ValueError: a wrong shape or number, or a normal that is no unit vector.
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
    """Return whether the weights are a certificate of force closure.

    They are if W has rank 6 and W w = 0 with every weight above 0. Then W (y + s w) =
    W y for any s, so every wrench is a sum of columns with weights of at least 0
    (Modern Robotics, section 12.1.7). False proves nothing: other weights may be a
    certificate.

    Args:
        W: wrenches of all edges of all contacts, in columns, (6, n).
        weights: of the columns, (n,).

    Returns:
        True or False; the unit of force, or the scale of the weights, has no effect.

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
