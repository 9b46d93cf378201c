"""Measure how Day 2's numbers depend on their constants, and explain each change."""

import numpy as np

from labkit.lesson.constants import Numbers, altered, between, same, times
from labkit.lesson.lab_module import complete_lab
from robo47 import panda, se3, verify

from .roulette import distances

LAB = complete_lab(2)

numbers = Numbers(
    metre="the unit of length, every pos in the file: × {}",
    seed="SEED: {}",
    n="random configurations: {}",
    times_v="the factor of the right v: {}",
    raised="the base is raised by {} m",
    q="joint angles of the screws: {} times READY_Q",
    tilt="the tool is tilted by {} rad",
    about_z="the tool is rotated about its z axis by {} rad",
    flange="d of Franka's eighth row: {} m",
)


def parts(metre=1.0, raised=0.0, q=0.0):
    """Return the screws and the home pose, by hand."""
    model = altered(panda.load("panda_nohand"), metre)
    model.body_pos[1, 2] += raised  # of link0, on the world
    seen = LAB.mujoco_sees(model, q * LAB.READY_Q[None])
    return LAB.joint_screws(seen.T_links[0]), seen.T_ee[0]


def random_q(n, seed):
    """Return the configurations of the guide's last column."""
    return verify.random_q(panda.load("panda_nohand"), n, seed)


def apart(wrong, right, q, fk=LAB.fk_space):
    """Return how far off the hand is with wrong screws or M, mm, median over q."""
    off = [fk(*wrong, x)[:3, 3] - LAB.fk_space(*right, x)[:3, 3] for x in q]
    return 1000 * np.median(np.linalg.norm(off, axis=1))


@numbers.add("third number of v of joint4's screw", "{:.4f} m",
    metre=times(2.0, "v is -omega x point, a length per radian"),
    raised=same("the axis is horizontal: only its height above the origin changes", to=0.333))
def joint4(metre=1.0, raised=0.0):
    return parts(metre, raised)[0][3, 5]


@numbers.add("first number of v of joint4's screw", "{:.4f} m",
    metre=times(2.0, "v is -omega x point, a length per radian"),
    raised=times(0.982 / 0.649, "v is the velocity of the point at the origin, 0.982 m below the axis", to=0.333))
def joint4_first(metre=1.0, raised=0.0):
    return parts(metre, raised)[0][3, 3]


@numbers.add("position error at random q with v forgotten", "{:.1f} mm",
    metre=times(2.0, "the error is a length"),
    times_v=times(2.0, "the position is linear in v: the wrong sign doubles the error", to=-1.0),
    seed=between(0.7, 1.4, "the median of twenty other configurations", to=48),
    n=between(0.7, 1.4, "the median of twice as many configurations"))
def forgotten(metre=1.0, times_v=0.0, seed=LAB.SEED, n=20):
    screws, M = parts(metre)
    wrong = screws * np.repeat([1.0, times_v], 3)
    return apart((wrong, M), (screws, M), random_q(n, seed))


@numbers.add("position error at random q with (v; omega)", "{:.1f} mm",
    metre=between(2.2, 8.0, "the error more than doubles, because v, a length per radian, takes the place of omega"),
    seed=between(0.7, 1.4, "the median of twenty other configurations", to=48))
def halves(metre=1.0, seed=LAB.SEED):
    screws, M = parts(metre)
    wrong = np.roll(screws, 3, axis=1)
    return apart((wrong, M), (screws, M), random_q(20, seed))


@numbers.add("position error with M of the ready pose", "{:.1f} mm",
    metre=times(2.0, "the error is a length"),
    seed=same("M is on the right: the error rotates with the arm and keeps its norm", to=48),
    n=same("the error is the same at every q"))
def wrong_M(metre=1.0, seed=LAB.SEED, n=20):
    screws, M = parts(metre)
    M_ready = LAB.fk_space(screws, M, LAB.READY_Q)
    return apart((screws, M_ready), (screws, M), random_q(n, seed))


@numbers.add("position error with Ad(M) instead of Ad(inverse of M)", "{:.0f} mm",
    metre=times(2.0, "only v is wrong, and v is a length per radian"),
    seed=between(0.5, 2.0, "the median of twenty other configurations", to=48),
    tilt=between(4.0, 6.0, "M's rotation is not symmetric then, so omega is wrong too", to=0.3),
    about_z=between(0.4, 1.6, "M's rotation stays symmetric, so omega is right; v changes", to=0.3))
def wrong_adjoint(metre=1.0, seed=LAB.SEED, tilt=0.0, about_z=0.0):
    screws, M = parts(metre)
    turn = LAB.exp_rotation(np.eye(3)[0], tilt) @ LAB.exp_rotation(
        np.eye(3)[2], about_z
    )
    M = M @ se3.make_T(turn, np.zeros(3))
    B = screws @ LAB.adjoint(M).T
    return apart((B, M), (screws, M), random_q(20, seed), LAB.fk_body)


def reading(name, metre, seed, n=20, flange=0.107):
    """Return how far off a reading of Franka's table is, median, mm."""
    table = LAB.FRANKA_DH.copy()
    table[7, 2] = flange
    table[:, 1:] *= metre
    return 1000 * np.median(distances(table, random_q(n, seed))[name])


@numbers.add("error of the flange with the other convention's formula", "{:.0f} mm",
    metre=times(2.0, "the error is a length"),
    seed=between(0.7, 1.4, "the median of twenty other configurations", to=48),
    n=between(0.7, 1.4, "the median of twice as many configurations"))
def convention(metre=1.0, seed=47, n=20):
    return reading("the other convention's formula", metre, seed, n)


@numbers.add("error of the flange without the eighth row", "{:.0f} mm",
    metre=times(2.0, "the error is a length"),
    seed=same("the missing row is a constant translation of the flange", to=48),
    n=same("the error is the same at every q"),
    flange=times(2.0, "the error is the d of this row"))
def without_flange(metre=1.0, seed=47, n=20, flange=0.107):
    return reading("without the eighth row", metre, seed, n, flange)


@numbers.add("rank of the seven screws of q = 0", "{:.0f}",
    metre=same("the rank does not depend on the unit of length"),
    raised=same("the seven lines are the same, relative to another origin", to=0.333),
    q=between(1.2, 1.2, "in the ready configuration the axes of joints 1, 3 and 5 differ", to=1.0))
def rank(metre=1.0, raised=0.0, q=0.0):
    return np.linalg.matrix_rank(parts(metre, raised, q)[0], tol=1e-9)
