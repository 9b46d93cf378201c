"""4.6 `inverse_dynamics(J_space, G, qd, qdd, g)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row
from robo47.dynamics import ad, inverse_dynamics

from .gravity import OTHER_GRAVITY
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


@row.wrongs(redone="the torque so")
def _(J, G, qd, qdd, g):
    """base-acceleration-sign: the base accelerates the wrong way: to stand still on the
      ground feels like a lift that starts upwards, against g
    gravity-forgotten: gravity is missing: the acceleration starts at 0 at the base
    gravity-twice: gravity counts twice: it is in A from the base on, so the wrench
      needs no weight
    speed-sign-lost: the speeds qd are taken without their signs: which way a joint
      turns counts when another one turns as well
    speed-and-acceleration-swapped: qd and qdd have changed places
    acceleration-ignored: qdd is not used: this is the bias alone
    speed-ignored: qd is not used: Coriolis and centrifugal forces are missing
    gravity-only: neither qd nor qdd is used: this is the torque that holds the arm
    negative: the sign is wrong: this is what the arm does to the motors
    armature-added: the armature's 0.1 qdd is in it; the task is about the links alone
    damping-added: the damping's 1.0 qd is in it; the task is about the links alone
    armature-and-damping-added: armature and damping are in it, 0.1 qdd and 1.0 qd; the
      task is about the links alone
    """
    given = {
        "base-acceleration-sign": (qd, qdd, -g),
        "gravity-forgotten": (qd, qdd, 0 * g),
        "gravity-twice": (qd, qdd, 2 * g),
        "speed-sign-lost": (abs(qd), qdd, g),
        "speed-and-acceleration-swapped": (qdd, qd, g),
        "acceleration-ignored": (qd, 0 * qdd, g),
        "speed-ignored": (0 * qd, qdd, g),
        "gravity-only": (0 * qd, 0 * qdd, g),
    }
    tau = inverse_dynamics(J, G, qd, qdd, g)
    return {
        **{slug: partial(inverse_dynamics, J, G, *one) for slug, one in given.items()},
        "negative": -tau,
        "armature-added": tau + 0.1 * qdd,
        "damping-added": tau + qd,
        "armature-and-damping-added": tau + 0.1 * qdd + qd,
    }


def walked(J, G, qd, qdd, g, others):
    """Return the torques, not yet made, by passes with other parts, {slug: parts}."""
    own = partial(passes, J, G, qd, qdd)
    return {slug: partial(own, **{"base": lift(g), **x}) for slug, x in others.items()}


@row.wrongs(redone="the torque so")
def _(J, G, qd, qdd, g):
    """bracket-forgotten: the acceleration lacks ad(V) S qd: a joint that is carried
      round changes its direction
    bracket-sign: in the acceleration ad(V) S qd has the wrong sign
    bracket-twice: in the acceleration ad(V) S qd stands twice; it needs no 2, since the
      force brings the other half of Coriolis
    bracket-without-speed: the acceleration has ad(V) S without qd: a joint at rest
      would change it, too
    speed-squared: the acceleration has ad(V) S qd^2; one of the two speeds is in V
      already
    bracket-not-transposed: the force has ad instead of its transpose: a wrench changes
      the other way from a twist
    velocity-product-sign: the velocity product, ad(V)^T G V, is added to the force; it
      is taken off
    acceleration-in-the-velocity-product: the velocity product has G A; what the motion
      of the link changes is its momentum, G V
    velocity-product-forgotten: the force is G A alone: that the inertia itself moves is
      missing
    velocity-of-the-link-before: the force uses V before the link's own joint has been
      added
    not-summed-back: each motor feels its own link only; it carries all links beyond it,
      too
    summed-from-the-base: the forces are summed from the base to the tip; a motor feels
      what is beyond it, so the sum starts at the tip
    every-link-for-all: each motor feels all seven links; it carries its own and those
      beyond it only
    moment-only: each motor feels the moments about the world's origin alone; where its
      axis does not go through that point, the force counts, too: all six numbers of S
    own-link-left-out: each motor feels the links beyond its own, but not its own
    velocities-not-added: the velocity of a link is that of its own joint alone; the
      joints before move it, too
    accelerations-not-added: the acceleration of a link is that of its own joint alone;
      the joints before move it, too
    nothing-added-outwards: V and A start anew at every link; along the arm they add up
    gravity-as-omega: the base's acceleration stands in the angular half; a twist is
      (omega; v)
    gravity-at-every-link: gravity is added at the base and again at every link; the sum
      carries it from the base to all
    bracket-not-transposed 2: the force has ad instead of minus its transpose: a wrench
      changes the other way from a twist
    gravity-at-every-link 2: gravity is added again at every link; the sum carries it
      from the base to all
    accelerations-not-added 2: A is set anew at every link, so what the joints before
      gave, and gravity, are lost; it adds up, as V does
    """
    up = lift(g)
    others = {
        "bracket-forgotten": {"turned": lambda X, S, speed: 0 * S},
        "bracket-sign": {"turned": lambda X, S, speed: -X @ S * speed},
        "bracket-twice": {"turned": lambda X, S, speed: 2 * X @ S * speed},
        "bracket-without-speed": {"turned": lambda X, S, speed: X @ S},
        "speed-squared": {"turned": lambda X, S, speed: X @ S * speed**2},
        "bracket-not-transposed": {"swing": lambda V, A, G, own: -ad(V) @ G @ V},
        "velocity-product-sign": {"swing": lambda V, A, G, own: ad(V).T @ G @ V},
        "acceleration-in-the-velocity-product": {
            "swing": lambda V, A, G, own: -ad(V).T @ G @ A
        },
        "velocity-product-forgotten": {"swing": lambda V, A, G, own: 0 * V},
        "velocity-of-the-link-before": {
            "swing": lambda V, A, G, own: -ad(V - own).T @ G @ (V - own)
        },
        "not-summed-back": {"felt": lambda F, i: F[i]},
        "summed-from-the-base": {"felt": lambda F, i: F[: i + 1].sum(axis=0)},
        "every-link-for-all": {"felt": lambda F, i: F.sum(axis=0)},
        "moment-only": {"felt": lambda F, i: F[i:].sum(axis=0) * [1, 1, 1, 0, 0, 0]},
        "own-link-left-out": {"felt": lambda F, i: F[i + 1 :].sum(axis=0)},
        "velocities-not-added": {"V_before": 0.0},
        "accelerations-not-added": {"A_before": 0.0},
        "nothing-added-outwards": {"V_before": 0.0, "A_before": 0.0},
        "gravity-as-omega": {"base": np.roll(up, 3)},
        "gravity-at-every-link": {"turned": lambda X, S, speed: X @ S * speed + up},
    }
    others |= {
        "bracket-not-transposed 2": {"swing": lambda V, A, G, own: ad(V) @ G @ V},
        "gravity-at-every-link 2": {
            "base": 0 * up,
            **others["gravity-at-every-link"],
        },
        "accelerations-not-added 2": {"base": 0.0, "A_before": 0.0},
    }
    return walked(J, G, qd, qdd, g, others)


# In ad an identity cancels: what it adds to G A, it takes from the velocity product.
row.reached_by("ad", "in ad, ", but=["identity-added"])
row.of_argument("g", *OTHER_GRAVITY)


@row.close("rounded")  # Printed and typed in again: six decimals.
def _(J, G, qd, qdd, g):
    return np.round(inverse_dynamics(J, G, qd, qdd, g), 6)
