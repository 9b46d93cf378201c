"""The sensitivity of Day 4's numbers: each constant doubled, measured, explained."""

import numpy as np

from labkit.lesson.constants import Numbers, altered, between, same, times
from labkit.lesson.lab_module import complete_lab
from robo47 import panda, simulate

LAB = complete_lab(4)
DAY = LAB.day4_mujoco
READY = LAB.READY_Q

numbers = Numbers(
    LAB, DAY,
    metre="the unit of length, all lengths of the arm: × {}",
    masses="masses and inertias of the links: × {}",
    armature="armature: × {}",
    damping="damping: × {}",
    gravity="gravity: × {}",
    tipped="the base is tipped to the side by {} rad",
    SEED="SEED: {}",
    FASTEST="FASTEST: {} rad/s",
    HARDEST="HARDEST: {} rad/s²",
    speed="every joint's speed: {} rad/s",
    difference="step of the differences: {} rad",
    step="time step: {} s",
    missing="missing fraction of gravity_torque: {}",
    seconds="after {} s",
    push="PUSH: {} N",
    RATE="RATE: {} Hz",
)


def arm(*factors, **more):
    """Return the arm with other numbers in its file: the model, and what reads it."""
    model = altered(panda.load("panda_nohand", drive="torque"), *factors, **more)
    return model, panda.arm(model)


def inertias(known, now):
    """Return every link's 6x6 inertia, by the lab's own functions."""
    links = known.masses, known.coms, known.inertias
    return LAB.link_inertias(now.T_links, *links)


def held(known, q=READY):
    """Return the torques that hold the arm."""
    now = known.at(q)
    given = now.J_space, known.masses, now.coms_world, known.gravity
    return LAB.gravity_torque(*given)


@numbers.add("M of joint 2 at ready", "{:.3f} kg m²",
    masses=times((1.545 - 0.1) / 1.545 + 1.0, "doubled, except for the rotor's 0.1"),
    armature=times(1.645 / 1.545, "the rotor adds another 0.1"),
    metre=times((4 * 1.445 + 0.1) / 1.545, "four times, except for the rotor's 0.1"),
    damping=same("M multiplies the acceleration, and damping multiplies the velocity"),
    gravity=same("M contains the masses, but not their weight"))
def mass(masses=1.0, armature=1.0, metre=1.0, damping=1.0, gravity=1.0):
    _, known = arm(metre, masses, armature, damping, gravity)
    now = known.at(READY)
    return LAB.mass_matrix(now.J_space, inertias(known, now), known.armature)[1, 1]


@numbers.add("error of M with m [c] of the wrong sign", "{:.3f} kg m²",
    masses=times(2.0, "a difference of two mass matrices, linear in the masses"),
    metre=times(4.0, "an inertia has the unit kg m²"),
    armature=same("both arms have the same rotors"),
    SEED=between(0.8, 1.25, "the maximum is taken over 100 other configurations", to=48))
def wrong_sign(masses=1.0, metre=1.0, armature=1.0):
    model, known = arm(metre, masses, armature)
    flip = np.diag([1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
    off = []
    for q in DAY.motions(model, LAB.TRIALS, LAB.SEED, 1.0, 1.0).q:
        now = known.at(q)
        G = inertias(known, now)
        both = [LAB.mass_matrix(now.J_space, x, known.armature)
                for x in (G, flip @ G @ flip)]  # fmt: skip
        off.append(np.abs(both[0] - both[1]).max())
    return max(off)


@numbers.add("gravity_torque of joint 4 at ready", "{:.3f} N m",
    gravity=times(2.0, "m g times the lever arms"),
    masses=times(2.0, "m g times the lever arms"),
    metre=times(2.0, "m g times the lever arms"),
    armature=same("the weight of a rotor is included in its link"),
    damping=same("the arm is at rest"))
def weight(gravity=1.0, masses=1.0, metre=1.0, armature=1.0, damping=1.0):
    return held(arm(metre, masses, armature, damping, gravity)[1])[3]


@numbers.add("torque of joint 1 if the base is tipped by 0.1 rad", "{:.1f} N m",
    tipped=times(2.0, "sin 0.2 instead of sin 0.1"),
    gravity=times(2.0, "m g times the lever arms"))
def tipped(tipped=0.1, gravity=1.0):
    model, _ = arm(gravity=gravity)
    size = np.linalg.norm(model.opt.gravity)
    model.opt.gravity[:] = -size * np.array([0.0, np.sin(tipped), np.cos(tipped)])
    return abs(held(panda.arm(model))[0])


@numbers.add("error of the torque without armature and damping", "{:.2f} N m",
    armature=between(1.1, 1.5, "0.1 `qdd` contributes up to 1 N m"),
    damping=between(1.5, 1.9, "1.0 `qd` contributes up to 2 N m"),
    FASTEST=between(1.5, 1.9, "1.0 `qd` contributes up to 2 N m"),
    HARDEST=between(1.1, 1.5, "0.1 `qdd` contributes up to 1 N m"),
    masses=same("the error does not contain the links' torque"),
    gravity=same("the error does not contain the links' torque"))
def forgotten(armature=1.0, damping=1.0, masses=1.0, gravity=1.0):
    model, known = arm(1.0, masses, armature, damping, gravity)
    now = DAY.motions(model, LAB.TRIALS, LAB.SEED, LAB.FASTEST, LAB.HARDEST)
    own = []
    for q, qd, qdd in zip(now.q, now.qd, now.qdd, strict=True):
        at = known.at(q)
        given = at.J_space, inertias(known, at), qd, qdd, known.gravity
        own.append(LAB.inverse_dynamics(*given))
    return np.abs(own - LAB.mujoco_inverse(model, now)).max()


@numbers.add("symmetric part of Mdot - 2 C, of the second C", "{:.2f} kg m²/s",
    speed=times(2.0, "both matrices are linear in the velocities"),
    metre=times(4.0, "the rate of an inertia has the unit kg m²/s"),
    masses=times(2.0, "M is linear in the masses"),
    armature=same("a rotor's inertia does not change with q"),
    difference=same("the differences are accurate to ten digits"))
def not_skew(speed=1.0, metre=1.0, masses=1.0, armature=1.0, difference=1e-5):
    _, known = arm(metre, masses, armature)
    qd = speed * np.ones(7)
    ways = difference * np.eye(7)
    dM = np.array([known.at(READY + s).M - known.at(READY - s).M for s in ways])
    dM /= 2 * difference
    Mdot = np.tensordot(qd, dM, 1)
    S = Mdot - 2 * (Mdot - dM @ qd / 2)
    return abs(S + S.T).max() / 2


@numbers.add("error of the next velocity with M alone", "{:.3f} rad/s",
    step=times(4.0, "the change of velocity in a step is of order h, and the effect of damping on this change is of order h²", within=0.1),
    damping=between(1.8, 2.4, "M alone omits h D"))
def with_M_alone(step=0.002, damping=1.0):
    model, _ = arm(damping=damping, step=step)
    now = DAY.motions(model, LAB.TRIALS, LAB.SEED, LAB.FASTEST, LAB.HARDEST)
    fraction = np.random.default_rng(LAB.TRIALS).uniform(-0.5, 0.5, now.q.shape)
    tau = fraction * simulate.limits(model)[1]
    qdd, after = LAB.mujoco_forward(model, now, tau)
    return np.abs(now.qd + step * qdd - after).max()


def displacement(missing, seconds, gravity=1.0, damping=1.0, step=0.002):
    """Return the hand's displacement with a fraction of gravity_torque, mm."""
    model, known = arm(gravity=gravity, damping=damping, step=step)
    path = LAB.let_go(model, known, 1.0 - missing, (seconds, 0 * LAB.PUSH))
    return 1000 * np.linalg.norm(path[-1])


@numbers.add("displacement of the hand with 99 % of gravity_torque in 2 s", "{:.0f} mm",
    missing=between(1.8, 2.3, "the missing torque is twice as large"),
    seconds=between(2.0, 5.0, "the hand is still accelerating", to=4.0),
    gravity=between(1.8, 2.3, "the missing torque is 1 % of twice the weight"),
    damping=between(0.5, 0.8, "damping slows the hand down"),
    RATE=times(1.0, "the motion is so slow that 20 ms of constant torque do not matter"),
    step=times(1.0, "the motion is so slow that either step is accurate", to=0.001))
def sinks(missing=0.01, seconds=2.0, gravity=1.0, damping=1.0, step=0.002):
    return displacement(missing, seconds, gravity, damping, step)


@numbers.add("displacement of the hand with 0 % in 0.5 s", "{:.0f} mm",
    gravity=between(0.95, 1.05, "it falls faster, and the joints reach the same limits"),
    damping=between(0.95, 1.05, "it falls more slowly, and the joints reach the same limits"),
    step=times(1.0, "only the impact at a joint limit depends on the step", to=0.001, within=0.03))
def falls(gravity=1.0, damping=1.0, step=0.002):
    return displacement(1.0, 0.5, gravity, damping, step=step)


@numbers.add("speed of the hand 4.5 s after the push", "{:.3f} m/s",
    damping=between(3.5, 5.0, "a smaller fraction of the speed is lost in every second", to=0.5),
    push=between(1.5, 3.0, "the initial speed is about twice as large"),
    seconds=between(0.05, 0.5, "damping removes a fraction of the speed in every second"),
    gravity=between(0.5, 0.8, "gravity is compensated 20 ms too late, which also slows the hand"),
    masses=between(1.5, 6.0, "the initial speed is lower, but it decays more slowly"),
    RATE=between(1.05, 1.25, "gravity is compensated 10 ms too late, instead of 20"),
    step=times(1.0, "a free glide is accurate at either step", within=0.05, to=0.001))
def glides(damping=1.0, push=10.0, seconds=4.5, gravity=1.0, masses=1.0, step=0.002):
    model, known = arm(1.0, masses, 1.0, damping, gravity, step)
    force = np.array([0.0, push, 0.0])
    path = LAB.let_go(model, known, 1.0, (0.5, force), (seconds, 0 * force))
    return np.linalg.norm(path[-1] - path[-2]) * LAB.RATE
