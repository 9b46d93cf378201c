"""Sensitivity of Day 6's numbers: each constant is doubled, measured and explained."""

from functools import cache

import mujoco
import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import panda, scenes

LAB = lab_of(find_day(6))
DAY = LAB.day6_mujoco
READY = LAB.READY_Q
E = [0.17, -0.77, 0.35, 0.39, 0.25, 0.2]  # along which the guide lets the hand go

numbers = Numbers(
    metre="the unit of length, all lengths of the arm: × {}",
    masses="masses and inertias of the links: × {}",
    armature="armature: × {}",
    inertia="masses, inertias and armature: × {}",
    damping="damping of the joints: × {}",
    gravity="gravity: × {}",
    k="K: × {}",
    push="PUSH: × {}",
    elbow="ELBOW, the posture gains: × {}",
    rate="RATE: {} Hz",
    step="time step: {} s",
    wait="duration of the push: {} s",
    size="first error, along e: × {}",
    force="PRESS: {} N",
    sink="SINK, the approach velocity: {} m/s",
    solref="solref of the contact: {} s",
    seconds="after {} s",
    gains="gains of the servos: × {}",
    limits="limits of the motors: × {}",
    friction="friction of the contact: {}",
    omega="OMEGA: {} rad/s",
    radius="RADIUS: {} m",
    turn="TURN, the time of a revolution: {} s",
)


@cache
def arm(metre=1.0, masses=1.0, armature=1.0, damping=1.0, gravity=1.0, step=0.002):
    """Return the arm with other numbers in its file: the model, and what reads it."""
    model = panda.load("panda_nohand", drive="torque")
    for lengths in (model.body_pos, model.body_ipos, model.site_pos):
        lengths[:] *= metre
    model.body_mass[:] *= masses
    model.body_inertia[:] *= masses * metre**2
    model.dof_armature[:] *= armature
    model.dof_damping[:] *= damping
    model.opt.gravity[:] *= gravity
    model.opt.timestep = step
    mujoco.mj_setConst(model, mujoco.MjData(model))
    return model, panda.arm(model)


@numbers.add(
    "Lambda at ready, along x", "{:.3f} kg",
    masses=between(1.8, 1.9, "about twice, because the rotors contribute an eighth"),
    armature=between(1.1, 1.2, "the eighth that the rotors contribute doubles"),
    metre=between(0.85, 0.95, "with twice the lever arm the apparent mass of a rotor "
                  "is a quarter"),
    gravity=same("an inertia does not depend on gravity"),
    damping=same("the arm is at rest"),
)  # fmt: skip
def apparent(masses=1.0, armature=1.0, metre=1.0, gravity=1.0, damping=1.0):
    """Return the entry."""
    now = arm(metre, masses, armature, damping, gravity)[1].at(READY)
    return LAB.task_inertia(now.J_site, now.M)[3, 3]


@numbers.add(
    "10 N along x move the hand by", "{:.3f} mm",
    push=times(2.0, "x = F / K", within=0.001),
    k=times(0.5, "x = F / K", within=0.001),
    masses=times(1.0, "F / K contains no mass; a heavier arm is not yet quite at rest",
                 within=0.001),
    gravity=same("gravity is compensated"),
    elbow=same("the elbow's torque is projected, so it does not move the hand"),
    step=same("the arm is at rest", to=0.001),
    wait=same("the arm is at rest"),
)  # fmt: skip
def pushed(push=1.0, k=1.0, masses=1.0, gravity=1.0, elbow=1.0, step=0.002,
           wait=3.0):  # fmt: skip
    """Return how far the hand gives way along x."""
    model, known = arm(masses=masses, gravity=gravity, step=step)
    with turned(LAB, ELBOW=tuple(elbow * np.array(LAB.ELBOW))):
        law = LAB.soft_hand(known, READY, stiffness=k * LAB.K)
        return 1e3 * rests(model, known, law, push * LAB.PUSH, wait)


def rests(model, known, law, wrench, wait):
    """Return where a push takes the hand along x, m."""
    push = LAB.simulate.push_at(DAY.SITE, wrench)
    run = LAB.simulate.run(model, LAB.simulate.start(model, READY), law, wait,
                           rate=LAB.RATE, push=push)  # fmt: skip
    ends = (known.at(q).T_world_ee[0, 3] for q in (run.q[-1], READY))
    return float(np.subtract(*ends))


@numbers.add(
    "overshoot of the critically damped hand, released along e", "{:.1f} %",
    k=between(0.95, 1.05, "the ratios of the modes' rates stay the same; all rates grow "
              "by the factor √2"),
    size=between(0.9, 1.1, "nearly linear"),
    masses=between(1.1, 1.2, "the rotors contribute a smaller fraction of Lambda, so "
                   "the modes change"),
    inertia=between(0.95, 1.05, "Lambda doubles, so only the time scale changes"),
    step=times(1.0, "the controller's period is the same", to=0.001),
)  # fmt: skip
def overshoot(k=1.0, size=1.0, masses=1.0, inertia=1.0, step=0.002):
    """Return how far beyond its target the hand goes, of the way."""
    both = {"masses": masses * inertia, "armature": inertia}
    model, known = arm(**both, step=step)
    law = LAB.soft_hand(known, READY, stiffness=k * LAB.K)
    return -100 * DAY.released(model, law, E, 0.03 * size).min()


@cache
def pressed(k, force, sink, rate, solref, friction):
    """Return the force of the soft arm at each time step, N."""
    stiffness = LAB.K.copy()
    stiffness[5] *= k
    depth = LAB.set_point_for_force(force, stiffness[5], scenes.TOUCH)

    def change(model):
        model.geom_solref[:, 0] = solref
        model.geom_condim[:] = 3 if friction else 1

    def soft_arm(known, q):
        to = lambda t: max(depth, scenes.TOUCH + 0.01 - sink * t)  # noqa: E731
        return LAB.soft_hand(known, q, to, stiffness)

    return DAY.press(soft_arm, change=change, rate=rate)


@numbers.add(
    "the soft arm presses with", "{:.1f} N",
    force=times(2.0, "depth times stiffness", within=0.005),
    k=same("with twice the stiffness the lab commands half the depth"),
    sink=same("the arm is at rest"),
    solref=same("the tip sinks in by less than a thousandth of the spring's extension",
                to=0.01),
    rate=same("the arm is at rest", to=250.0),
    friction=times(1.0, "friction acts sideways; the tip slides a little", to=0.0),
)  # fmt: skip
def soft(force=LAB.PRESS, k=1.0, sink=LAB.SINK, solref=0.02, rate=LAB.RATE,
         friction=1.0):  # fmt: skip
    """Return the force in the end."""
    return pressed(k, force, sink, rate, solref, friction)[-1]


@numbers.add(
    "peak of this force", "{:.0f} N",
    sink=between(1.3, 1.8, "an impact at twice the speed"),
    solref=between(1.8, 2.2, "the contact is twice as fast: half the time, twice the "
                   "force", to=0.01),
    force=between(0.95, 1.3, "the peak of the impact is the same; the 40 N are the "
                  "steady force"),
    k=between(0.95, 1.3, "a stiffer hand follows its target faster: it arrives at "
              "0.076 m/s instead of 0.068 m/s"),
)  # fmt: skip
def peak(sink=LAB.SINK, solref=0.02, force=LAB.PRESS, k=1.0):
    """Return the largest force."""
    return pressed(k, force, sink, LAB.RATE, solref, 1.0).max()


@numbers.add(
    "the stiff arm presses with", "{:.0f} N",
    gains=times(1.0, "two motors are at their limits already", within=0.01),
    limits=between(1.3, 2.3, "two motors are at their limits"),
    friction=between(0.45, 0.6, "without friction the tip slides until it comes to rest",
                     to=0.0),
    solref=times(1.0, "the motors determine the force, not the contact", to=0.01),
)  # fmt: skip
def stiff(gains=1.0, limits=1.0, friction=1.0, solref=0.02):
    """Return the force after three seconds."""

    def change(model):
        model.actuator_gainprm[:, 0] *= gains
        model.actuator_biasprm[:, 1] *= gains
        model.actuator_forcerange[:] *= limits
        model.geom_solref[:, 0] = solref
        model.geom_condim[:] = 3 if friction else 1

    return DAY.press(LAB.stiff_arm, drive="servo", seconds=3.0, change=change)[-1]


def circle(project, omega, radius, turn, elbow, step, damping):
    """Return how far off its circle the hand is, mm."""
    model, known = arm(step=step, damping=damping)
    names = {"OMEGA": omega, "RADIUS": radius, "TURN": turn}
    with turned(LAB, ELBOW=tuple(elbow * np.array(LAB.ELBOW)), **names):
        off = DAY.off_circle(model, LAB.circling(known, project), radius, turn)
    return 1e3 * off.max()


@numbers.add(
    "largest error on the circle with today's projector", "{:.3f} mm",
    omega=between(0.4, 0.6, "the disturbance is the same, and the damping doubles"),
    radius=between(0.2, 0.6, "half the velocity and half the acceleration (a radius "
                   "of 0.24 m leaves the workspace)", to=0.06),
    turn=between(0.1, 0.4, "half the velocity, a quarter of the acceleration"),
    elbow=between(0.9, 1.1, "the elbow's torque does not accelerate the hand"),
    step=between(0.4, 0.8, "the simulator's time step causes a large part of the "
                 "error", to=0.001),
)  # fmt: skip
def on_circle(omega=LAB.OMEGA, radius=LAB.RADIUS, turn=LAB.TURN, elbow=1.0, step=0.002):
    """Return how far off."""
    return circle(LAB.nullspace_torque, omega, radius, turn, elbow, step, 1.0)


@numbers.add(
    "the same with Day 3's projector", "{:.3f} mm",
    omega=between(0.3, 0.6, "stiffer feedback suppresses more of the disturbance"),
    elbow=between(0.9, 1.1, "hardly any torque is left after the projection"),
)  # fmt: skip
def with_day3(omega=LAB.OMEGA, elbow=1.0):
    """Return how far off."""
    return circle(LAB.kinematic, omega, LAB.RADIUS, LAB.TURN, elbow, 0.002, 1.0)
