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
    """of-the-origin: your result is only the sum of ad(V) S qd. The linear part of this
      sum belongs to the world origin, so convert it to the point p
    no-centripetal: your result omits the term omega x (velocity of p). This term is
      needed because a point on a circle accelerates towards the centre even at constant
      speed
    no-alpha-cross-p: your result omits the term alpha x p. This term is needed because
      the linear part of the sum of ad(V) S qd belongs to the world origin and not to p
    velocity-of-origin: your result contains omega x v but not omega x (omega x p),
      where v is the velocity of the body-fixed point that coincides with the world
      origin. Use the velocity of the point p instead, which is v + omega x p
    v-forgotten: your result contains omega x (omega x p) but not omega x v. The
      velocity of p is v + omega x p, where v is the velocity of the body-fixed point
      that coincides with the world origin
    coriolis-twice: your result contains omega x v twice. Add this term only once,
      because the factor 2 belongs to the Coriolis acceleration in a rotating frame
    centripetal-twice: your result contains omega x (velocity of p) twice. Add this term
      only once, because the factor 2 belongs to the Coriolis acceleration in a rotating
      frame
    p-sign: in your result, the terms with p have the wrong sign, as with p x alpha and
      p x omega. These terms should be alpha x p and omega x (omega x p), because
      swapping the factors reverses the sign
    ad-swapped: in your result, the sum of ad(V) S qd has the wrong sign, as if V and S
      were swapped in ad(V) S or the twists were summed from the tip instead of the base
    ad-transposed: your result contains ad(V)^T S, but ad(V)^T transforms wrenches. Use
      ad(V) S, because ad(V) transforms screws
    ad-half: your result omits the term v x omega2 from the linear part of ad(V) S,
      where S = (omega2; v2). In matrix form, this term is the lower left block [v] of
      ad(V)
    twist-of-the-hand: in your result, the sum of ad(V) S qd is 0, as if it were omitted
      or computed with the twist of the hand for every joint. For joint i, the sum
      should contain the twist of link i, which depends only on joints 1 to i
    qd-once: your result contains the sum of ad(V) S, without the factor qd. Sum ad(V) S
      qd instead, because the twist of joint i is its screw times its velocity
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
    found = {
        slug: partial(bias, J_space, qd, p, **how) for slug, how in changed.items()
    }
    return {"p-sign": bias(J_space, qd, -p), **found}


@row.right  # With vectors of three, without ad.
def _(J_space, qd, p):
    w, v, dw, dv = np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
    for S, speed in zip(J_space.T, qd):
        z, o = S[:3] * speed, S[3:] * speed
        dw = dw + np.cross(w, z)  # angular acceleration
        dv = dv + np.cross(v, z) + np.cross(w, o)  # sum of the linear halves of ad(V) S
        w = w + z  # angular velocity of the link
        v = v + o  # velocity of the link's point at the origin
    at_p = v + np.cross(w, p)  # velocity of p
    linear = dv + np.cross(dw, p) + np.cross(w, at_p)  # linear acceleration of p
    return np.append(dw, linear)


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
