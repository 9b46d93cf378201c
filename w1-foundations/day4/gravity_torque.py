"""4.4 `gravity_torque(J, masses, coms_world, g)`: its questions and its mistakes."""

import numpy as np

from labkit.judge.row import Row
from robo47.dynamics import gravity_torque
from robo47.screws import exp_screw, skew

from .gravity import other_gravity
from .states import DOWN, TORQUE, arm, hinge, pulls, states

row = Row(TORQUE)


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
    holds=lambda joint, link: joint <= link,
):
    """Return gravity_torque with other velocities of c, with other links held."""
    tau = np.zeros(7)
    for link, (m, c) in enumerate(zip(masses, coms_world)):
        tau -= m * g @ velocity(J, c) * [holds(joint, link) for joint in range(7)]
    return tau


@row.wrong
def gravity_sign(J, masses, coms_world, g):
    """the sign is wrong: this is the torque of gravity itself, and the motors have to
    balance it. The arm would fall twice as fast => its negative"""
    return -gravity_torque(J, masses, coms_world, g)


for slug, says, holds in (
    (
        "links-not-cut",
        "every joint holds every link; a joint holds those beyond it only",
        lambda joint, link: True,
    ),
    (
        "own-link-only",
        "each joint holds its own link only; it carries all beyond it, too",
        lambda joint, link: joint == link,
    ),
    (
        "own-link-left-out",
        "each joint leaves its own link out and holds those beyond it only",
        lambda joint, link: joint < link,
    ),
    (
        "link-before-too",
        "each joint also holds the link that it stands on",
        lambda joint, link: joint <= link + 1,
    ),
    (
        "links-on-the-wrong-side",
        "each joint holds the links between it and the base; they do not move with it",
        lambda joint, link: joint >= link,
    ),
):

    @row.wrong(slug, says, "the torque with those joints")
    def _(J, masses, coms_world, g, holds=holds):
        return torque(J, masses, coms_world, g, holds=holds)


@row.wrong
def velocity_of_the_origin(J, masses, coms_world, g):
    """the lower half of J is the velocity of the point at the world's origin; the
    weight acts at the centre of mass => the torque with v instead of v + omega x c"""
    return torque(J, masses, coms_world, g, velocity=lambda J, c: J[3:])


@row.wrong
def cross_product_sign(J, masses, coms_world, g):
    """the velocity of the centre of mass is v + omega x c; here it is v + c x omega =>
    the torque with v + c x omega"""
    return gravity_torque(J, masses, -coms_world, g)


@row.wrong
def v_left_out(J, masses, coms_world, g):
    """the velocity of the centre of mass is v + omega x c; here v is missing => the
    torque with omega x c alone"""
    return torque(J, masses, coms_world, g, velocity=lambda J, c: -skew(c) @ J[:3])


@row.wrong
def rows_swapped(J, masses, coms_world, g):
    """the rows of J are read as (v; omega); omega comes first => the torque with J's
    halves swapped"""
    return gravity_torque(J[[3, 4, 5, 0, 1, 2]], masses, coms_world, g)


@row.wrong
def omega_rows_for_v(J, masses, coms_world, g):
    """the upper half of J is used as the velocity; that is omega => the torque with
    omega for v"""
    return torque(J, masses, coms_world, g, velocity=lambda J, c: J[:3])


@row.wrong
def centre_not_weighted(J, masses, coms_world, g):
    """the mass beyond each joint sits at the plain mean of the links' centres; a heavy
    link counts for more => the torque with the mean of the centres"""
    tau = np.zeros(7)
    for i in range(7):
        c = coms_world[i:].mean(axis=0)
        tau[i] = -masses[i:].sum() * g @ (J[3:, i] + np.cross(J[:3, i], c))
    return tau


@row.wrong
def all_mass_at_the_last_centre(J, masses, coms_world, g):
    """all mass sits at the last link's centre; each link has one of its own => the
    torque with that centre for all"""
    return gravity_torque(J, masses, coms_world[[6] * 7], g)


@row.wrong
def signs_lost(J, masses, coms_world, g):
    """no torque is negative here: a motor has to pull the other way as well => the
    right torque without its signs"""
    return abs(gravity_torque(J, masses, coms_world, g))


@row.wrong
def mass_forgotten(J, masses, coms_world, g):
    """the masses are missing: every link counts as 1 kg => the torque with 1 kg each"""
    return gravity_torque(J, np.ones(7), coms_world, g)


row.of_argument("g", *other_gravity("the torque with that gravity"))


@row.close("rounded-somewhere")  # The slope of the potential energy, by differences.
def _(J, masses, coms_world, g):
    h, tau = 3e-4, np.zeros(7)
    for i in range(7):
        if J[:3, i].any():
            change = exp_screw(J[:, i], h) - exp_screw(J[:, i], -h)
            for m, c in list(zip(masses, coms_world))[i:]:
                tau[i] -= m * g @ (change @ np.append(c, 1.0))[:3] / (2 * h)
    return tau
