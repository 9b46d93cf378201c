"""4.4 `gravity_torque(J_space, masses, coms_world, g)`: questions, mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row
from labkit.judge.argument_mistakes import HALVES_SWAPPED
from robo47.dynamics import gravity_torque
from robo47.screws import exp_screw, skew

from .gravity import OTHER_GRAVITY
from .states import DOWN, TORQUE, arm, hinge, pulls, states

row = Row(TORQUE)
BEYOND = np.tri(7)  # which joints (columns) carry which link


@row.inputs
def _(rng):
    J, _, masses, coms = hinge([0.0, 1.0, 0.0], 1.0)
    given = zip(states(rng), pulls(rng))
    at = [(now.J_space, arm().masses, now.coms_world, g) for now, g in given]
    return [(J, masses, coms, DOWN), *at]


def torque(
    J,
    masses,
    coms_world,
    g,
    velocity=lambda J, c: J[3:] - skew(c) @ J[:3],
    held=BEYOND,
):
    """Return gravity_torque with other velocities of c, other links held by joints."""
    pulls = [m * g @ velocity(J, c) for m, c in zip(masses, coms_world)]
    return -np.sum(held * np.array(pulls), axis=0)


@row.wrongs
def _(J, masses, coms_world, g):
    """gravity-sign: your code returns the torque that gravity exerts. Return the
      negative of this torque, which is the motor torque that balances gravity
    velocity-of-the-origin: your torques contain v from J_space, which is the velocity
      of the body-fixed point at the world origin. Use the velocity of each centre of
      mass instead, because the weight of a link acts at its centre of mass
    omega-rows-for-v: your torques contain omega from J_space. Use the velocity of each
      centre of mass c instead, which is v + omega x c
    """
    given = masses, coms_world, g
    tau = gravity_torque(J, *given)
    own = partial(torque, J, *given)
    return {
        "gravity-sign": -tau,
        "velocity-of-the-origin": own(lambda J, c: J[3:]),
        "omega-rows-for-v": own(lambda J, c: J[:3]),
    }


@row.wrongs
def _(J, masses, coms_world, g):
    """links-not-cut: your code includes all links in the torque of every joint. Include
      only the links that the joint carries: its own link and the links after it
    own-link-only: your code includes only the joint's own link in each torque. Include
      all later links as well, because the joint also carries these links
    own-link-left-out: your code omits the joint's own link from each torque. Include
      this link, because the joint also carries its own link
    link-before-too: your code also includes the link before the joint in each torque.
      Omit this link, because it does not move with the joint
    links-on-the-wrong-side: your code includes the links from the base to the joint's
      own link in each torque. Include the joint's own link and the links after it
      instead
    """
    joint = np.arange(7)
    link = np.arange(7)[:, None]
    held = {
        "links-not-cut": joint <= 6,
        "own-link-only": joint == link,
        "own-link-left-out": joint < link,
        "link-before-too": joint <= link + 1,
        "links-on-the-wrong-side": joint >= link,
    }
    return {
        slug: torque(J, masses, coms_world, g, held=one) for slug, one in held.items()
    }


@row.wrong
def centre_not_weighted(J, masses, coms_world, g):
    """your code uses the unweighted mean of the centres of mass of the links that each
    joint carries. Weight each centre of mass by the mass of its link"""
    tau = np.zeros(7)
    for i in range(7):
        c = coms_world[i:].mean(axis=0)
        tau[i] = -masses[i:].sum() * g @ (J[3:, i] + np.cross(J[:3, i], c))
    return tau


row.of_argument("J_space", HALVES_SWAPPED.called("rows-swapped"))
row.of_argument("g", *OTHER_GRAVITY)


@row.close("rounded-somewhere")  # The slope of the potential energy, by differences.
def _(J, masses, coms_world, g):
    h = 3e-4
    tau = np.zeros(7)
    for i in range(7):
        if J[:3, i].any():
            change = exp_screw(J[:, i], h) - exp_screw(J[:, i], -h)
            for m, c in list(zip(masses, coms_world))[i:]:
                tau[i] -= m * g @ (change @ np.append(c, 1.0))[:3] / (2 * h)
    return tau


row.at_least_0(masses="a mass")
row.same(
    "first J_space = np.clip(J_space, -1, 1)", "the Panda's links are within a metre"
)
row.same("first coms_world = np.clip(coms_world, -1, 1)", "so are their centres")
