"""4.6 `inverse_dynamics(J_space, G, qd, qdd, g)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row
from robo47.dynamics import ad, inverse_dynamics

from .gravity import OTHER_DIRECTION, OTHER_GRAVITY
from .states import TORQUE, motions

row = Row(TORQUE)
row.inputs(motions)


def lift(g):
    """Return the acceleration of a base that stands still on the ground."""
    return np.append(np.zeros(3), -g)


def passes(
    J,
    G,
    qd,
    qdd,
    base,
    V_before=1.0,
    A_before=1.0,
    turned=lambda ad_V, S, speed: ad_V @ S * speed,
    swing=lambda V, A, G, own: -ad(V).T @ G @ V,
    felt=lambda F, i: F[i:].sum(axis=0),
):
    """Return the torque by Newton and Euler's two passes, with other parts.

    Args:
        J, G, qd, qdd: as in `inverse_dynamics`.
        base: its acceleration, which all links share.
        V_before, A_before: what counts of the link before, 1 for all of it.
        turned: what the acceleration has for ad(V) S qd.
        swing: what the force has for -ad(V)^T G V; own is S qd.
        felt: the wrench that motor i feels, from F of all links.
    """
    V = np.zeros(6)
    A = np.zeros(6)
    F = []
    for i in range(7):
        own = J[:, i] * qd[i]
        V = V_before * V + own
        A = A_before * A + J[:, i] * qdd[i] + turned(ad(V), J[:, i], qd[i])
        F.append(G[i] @ (A + base) + swing(V, A + base, G[i], own))
    return np.array([J[:, i] @ felt(np.array(F), i) for i in range(7)])


@row.wrongs
def _(J, G, qd, qdd, g):
    """base-acceleration-sign: your gravity torque has the wrong sign. A base at rest
      under gravity is equivalent to a base with the acceleration `-g` and without
      gravity
    gravity-only: your result is only the gravity torque. Include the torques due to qd
      and qdd as well
    armature-added: your code adds the armature torque (0.1 qdd). Omit this torque,
      because this task models only the links
    damping-added: your code adds the damping torque (1.0 qd). Omit this torque, because
      this task models only the links
    armature-and-damping-added: your code adds the armature torque (0.1 qdd) and the
      damping torque (1.0 qd). Omit both torques, because this task models only the
      links
    """
    given = {
        "base-acceleration-sign": (qd, qdd, -g),
        "gravity-only": (0 * qd, 0 * qdd, g),
    }
    tau = inverse_dynamics(J, G, qd, qdd, g)
    return {
        **{slug: partial(inverse_dynamics, J, G, *one) for slug, one in given.items()},
        "armature-added": tau + 0.1 * qdd,
        "damping-added": tau + qd,
        "armature-and-damping-added": tau + 0.1 * qdd + qd,
    }


def walked(J, G, qd, qdd, g, others):
    """Return the torques, not yet made, by passes with other parts, {slug: parts}."""
    own = partial(passes, J, G, qd, qdd)
    return {slug: partial(own, **{"base": lift(g), **x}) for slug, x in others.items()}


@row.wrongs
def _(J, G, qd, qdd, g):
    """bracket-forgotten: your code omits the term ad(V) S qd from the acceleration.
      This term is needed because each screw S moves with its link and changes at the
      rate ad(V) S
    bracket-sign: your code subtracts the term ad(V) S qd from the acceleration. Add
      this term instead
    bracket-twice: your code adds ad(V) S qd twice to the acceleration. Add this term
      only once, because the derivative of S qd is S qdd + ad(V) S qd
    speed-squared: your code adds ad(V) S qd^2 to the acceleration. Add ad(V) S qd
      instead, because V already contributes the second factor of velocity
    bracket-not-transposed: your code uses -ad(V) G V in the wrench. Use -ad(V)^T G V
      instead, because wrenches transform with the transpose of ad(V)
    velocity-product-forgotten: your wrenches omit the term -ad(V)^T G V. Add this term
      to G A, because G changes when the link moves
    velocity-of-the-link-before: your term -ad(V)^T G V of each wrench contains the
      velocity of the previous link. Use the velocity of the link itself, which includes
      the motion of its own joint
    velocity-of-the-link-before 2: in your term -ad(V)^T G V of each wrench, the V on
      the right of G is the velocity of the previous link. Use the velocity of the link
      itself in both places, because it includes the motion of its own joint
    summed-from-the-base: for each joint, your code sums the wrenches on the links from
      the base up to that joint's link. Sum the wrenches from that joint's link to the
      tip instead, because the joint carries these links
    every-link-for-all: your code includes the wrenches on all seven links in every
      torque. Include only the wrenches on the links that the joint carries: its own
      link and the links after it
    moment-only: your code uses only the moments about the world's origin. Use all six
      components of the wrench, because a force also causes a torque about a joint axis
      that does not pass through the origin
    own-link-left-out: your code omits the wrench on the joint's own link from each
      torque. Include this wrench, because the joint also carries its own link
    accelerations-not-added: your code omits the acceleration of the previous link from
      each link's acceleration. Add this acceleration, because the earlier joints also
      move the link
    nothing-added-outwards: your V and A of each link contain only the motion of its own
      joint. Accumulate both along the arm
    gravity-at-every-link: your code adds gravity at the base and again at every link.
      Add gravity only at the base, because the recursion propagates this acceleration
      to every link
    bracket-not-transposed 2: your code uses ad(V) G V in the wrench. Use -ad(V)^T G V
      instead, because wrenches transform with the transpose of ad(V)
    gravity-at-every-link 2: your code adds gravity at every link instead of at the
      base. Add gravity only at the base, because the recursion propagates this
      acceleration to every link
    """
    up = lift(g)
    others = {
        "bracket-forgotten": {"turned": lambda X, S, speed: 0 * S},
        "bracket-sign": {"turned": lambda X, S, speed: -X @ S * speed},
        "bracket-twice": {"turned": lambda X, S, speed: 2 * X @ S * speed},
        "speed-squared": {"turned": lambda X, S, speed: X @ S * speed**2},
        "bracket-not-transposed": {"swing": lambda V, A, G, own: -ad(V) @ G @ V},
        "velocity-product-forgotten": {"swing": lambda V, A, G, own: 0 * V},
        "velocity-of-the-link-before": {
            "swing": lambda V, A, G, own: -ad(V - own).T @ G @ (V - own)
        },
        "velocity-of-the-link-before 2": {
            "swing": lambda V, A, G, own: -ad(V).T @ G @ (V - own)
        },
        "summed-from-the-base": {"felt": lambda F, i: F[: i + 1].sum(axis=0)},
        "every-link-for-all": {"felt": lambda F, i: F.sum(axis=0)},
        "moment-only": {"felt": lambda F, i: F[i:].sum(axis=0) * [1, 1, 1, 0, 0, 0]},
        "own-link-left-out": {"felt": lambda F, i: F[i + 1 :].sum(axis=0)},
        "accelerations-not-added": {"A_before": 0.0},
        "nothing-added-outwards": {"V_before": 0.0, "A_before": 0.0},
        "gravity-at-every-link": {"turned": lambda X, S, speed: X @ S * speed + up},
    }
    others |= {
        "bracket-not-transposed 2": {"swing": lambda V, A, G, own: ad(V) @ G @ V},
        "gravity-at-every-link 2": {
            "base": 0 * up,
            **others["gravity-at-every-link"],
        },
    }
    return walked(J, G, qd, qdd, g, others)


@row.right  # With vectors of three, without ad.
def _(J, G, qd, qdd, g):
    w, v, dw, dv = np.zeros(3), np.zeros(3), np.zeros(3), -g
    wrenches = []
    for S, Gi, x, a in zip(J.T, G, qd, qdd, strict=True):
        z, o = S[:3], S[3:]
        w = w + z * x  # angular velocity of the link
        v = v + o * x  # velocity of the link's point at the origin
        dw = dw + z * a + np.cross(w, z) * x  # angular acceleration
        dv = dv + o * a + (np.cross(v, z) + np.cross(w, o)) * x  # its linear half
        h = Gi @ np.append(w, v)  # momentum of the link
        moment = np.cross(w, h[:3]) + np.cross(v, h[3:])  # rate of the angular momentum
        force = np.cross(w, h[3:])  # rate of the linear momentum
        wrenches.append(Gi @ np.append(dw, dv) + np.append(moment, force))
    carried = np.cumsum(wrenches[::-1], axis=0)[::-1]  # wrenches of all later links
    return np.einsum("ai,ia->i", J, carried)


# In ad an identity cancels: what it adds to G A, it takes from the velocity product.
row.reached_by("ad", "in `ad`, ", but=["identity-added"])
row.of_argument("g", *OTHER_DIRECTION, *OTHER_GRAVITY)


@row.close("rounded")  # Printed and typed in again: six decimals.
def _(J, G, qd, qdd, g):
    return np.round(inverse_dynamics(J, G, qd, qdd, g), 6)
