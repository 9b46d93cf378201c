"""6.2 `bias_acceleration(J_space, qd, p)`: its questions and its mistakes."""

from collections.abc import Callable
from functools import partial

import numpy as np

from labkit.judge import Row
from robo47.checks import Array
from robo47.screws import ad, adjoint, exp_screw

from .states import Acceleration, some, states

row = Row(Acceleration())


@row.inputs
def _(rng):
    spin = np.zeros((6, 7))
    spin[2, 0] = 1.0
    case = (spin, np.eye(7)[0], np.array([1.0, 0.0, 0.0]))
    drawn = [
        (now.J_space.copy(), some(rng, 2, 7), some(rng, 1, 3))  # screws, so as it is
        for now in states(rng)
    ]
    return [case, *drawn]


FORWARDS = np.kron([[1, 1], [0, 1]], np.ones((3, 3)))  # without the lower left block


def bias(
    J: Array,
    qd: Array,
    p: Array,
    *,
    rate: Callable[[Array, Array], Array] = lambda V, S: ad(V) @ S,
    own: Array | None = None,
    turn: float = 1.0,
    centre: float = 1.0,
    move: float = 1.0,
) -> Array:
    """Return the hand's bias; the right one unless told otherwise."""
    V = np.cumsum((J * qd).T, axis=0)
    parts = (J * (qd if own is None else own)).T
    A = sum(rate(v, s) for v, s in zip(V, parts, strict=True))
    omega = V[-1, :3]
    alpha = A[:3]
    velocity = move * V[-1, 3:] + centre * np.cross(omega, p)
    linear = A[3:] + turn * np.cross(alpha, p) + np.cross(omega, velocity)
    return np.append(alpha, linear)


@row.wrongs
def _(J_space, qd, p):
    """of-the-origin: this is the twist's rate about the world's origin, the sum of
      ad(V) S qd; the acceleration of the point p is another thing: the linear half is
      to be converted => the sum alone
    no-centripetal: the part omega x (velocity of p) is missing: a point on a circle
      accelerates towards its centre though the speed is steady
    no-alpha-cross-p: the angular acceleration is not converted to the point: alpha x p
      is missing => the right one without it
    velocity-of-origin: omega is crossed with v, the velocity of the point at the
      world's origin; p itself moves at v + omega x p => the right one with v there
    v-forgotten: the velocity of p is taken to be omega x p alone; v belongs to it
    coriolis-twice: omega x v counts twice: ad(V) S has it already, and 2 omega x v
      belongs to accelerations measured in the moving frame => the right one with
      another omega x v
    centripetal-twice: omega x (velocity of p) counts twice, as in Coriolis' 2 omega x
      v; that belongs to velocities seen in the moving frame => the right one with it
      twice
    ad-swapped: V and S have changed places, or the twists are summed from the tip:
      ad(S) V is minus ad(V) S, and a joint is carried by those before it
    ad-transposed: ad(V) is transposed: that one is for wrenches, screws take it as it
      is => the right one with ad(V)^T
    ad-half: ad(V) lacks its lower left block [v] => the right one without it
    twist-of-the-hand: every joint is taken to ride on the hand; joint i rides on link
      i, which only the joints up to it move; ad(V) V is 0, so nothing is left of the
      sum => the right one without the sum of ad(V) S qd
    qd-once: the screws are not multiplied by their own joint's speed: the sum is of
      ad(V) S, and qd is missing => the right one without that qd
    """
    changed = {
        "of-the-origin": {"turn": 0.0, "centre": 0.0, "move": 0.0},
        "no-centripetal": {"centre": 0.0, "move": 0.0},
        "no-alpha-cross-p": {"turn": 0.0},
        "velocity-of-origin": {"centre": 0.0},
        "v-forgotten": {"move": 0.0},
        "coriolis-twice": {"move": 2.0},
        "centripetal-twice": {"centre": 2.0, "move": 2.0},
        "ad-swapped": {"rate": lambda V, S: ad(S) @ V},
        "ad-transposed": {"rate": lambda V, S: ad(V).T @ S},
        "ad-half": {"rate": lambda V, S: (FORWARDS * ad(V)) @ S},
        "twist-of-the-hand": {"rate": lambda V, S: 0.0 * S},
        "qd-once": {"own": np.ones(7)},
    }
    return {slug: partial(bias, J_space, qd, p, **how) for slug, how in changed.items()}


@row.wrongs
def _(J_space, qd, p):
    """p-sign: the cross products with p have their factors swapped: p x omega is minus
      omega x p => the right one with -p
    last-joint-left-out: the last joint is left out: range(6) ends with joint6
    negative: every sign is wrong: this is what has to be taken away from acc, not the
      acceleration itself => minus the right one
    """
    return {
        "p-sign": bias(J_space, qd, -p),
        "last-joint-left-out": bias(J_space[:, :6], qd[:6], p),
        "negative": -bias(J_space, qd, p),
    }


@row.right  # Every pair of joints, as Christoffel did.
def _(J_space, qd, p):
    A = np.zeros(6)
    for j in range(7):
        for i in range(j):
            A += ad(J_space[:, i]) @ J_space[:, j] * qd[i] * qd[j]
    V = J_space @ qd
    v = V[3:] + np.cross(V[:3], p)
    return np.append(A[:3], A[3:] + np.cross(A[:3], p) + np.cross(V[:3], v))


@row.right  # Screws first moved to the point, then summed.
def _(J_space, qd, p):
    move = np.eye(6)
    x, y, z = p
    move[3:, :3] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
    S = (move @ J_space * qd).T
    V = np.cumsum(S, axis=0)
    A = sum(ad(Vi) @ Si for Vi, Si in zip(V, S))
    A[3:] += np.cross(V[-1, :3], V[-1, 3:])
    return A


@row.close("rounded-somewhere")  # By a difference quotient of the moving screws.
def _(J_space, qd, p):
    h = 1e-7
    T = np.eye(4)
    moved = []
    for S, speed in zip(J_space.T, qd):
        moved.append(adjoint(T) @ S)
        T = T @ exp_screw(S, speed * h)
    rate = (np.array(moved).T - J_space) @ qd / h
    V = J_space @ qd
    v = V[3:] + np.cross(V[:3], p)
    return np.append(rate[:3], rate[3:] + np.cross(rate[:3], p) + np.cross(V[:3], v))


row.spans(  # as small, or as large, as in the lab
    qd=(lambda qd: 4e-05 * qd,),
)
