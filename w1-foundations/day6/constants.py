"""Sensitivity of Day 6's numbers: each constant is doubled, measured and explained."""

from functools import cache

import numpy as np

from labkit.lesson.constants import Numbers, altered, between, same, times
from labkit.lesson.lab_module import complete_lab
from robo47 import panda, scenes, simulate

LAB = complete_lab(6)
DAY = LAB.day6_mujoco
READY = LAB.READY_Q
E = [0.17, -0.77, 0.35, 0.39, 0.25, 0.2]  # along which the guide lets the hand go

numbers = Numbers(
    LAB, DAY,
    metre="the unit of length, all lengths of the arm: × {}",
    masses="masses and inertias of the links: × {}",
    armature="armature: × {}",
    inertia="masses, inertias and armature: × {}",
    damping="damping of the joints: × {}",
    gravity="gravity: × {}",
    K="K: × {}",
    PUSH="PUSH: × {}",
    ELBOW="ELBOW, the posture gains: × {}",
    RATE="RATE: {} Hz",
    step="time step: {} s",
    wait="duration of the push: {} s",
    size="first error, along e: × {}",
    PRESS="PRESS: {} N",
    SINK="SINK, the approach velocity: {} m/s",
    solref="solref of the contact: {} s",
    seconds="after {} s",
    gains="gains of the servos: × {}",
    limits="limits of the motors: × {}",
    friction="friction of the contact: {}",
    OMEGA="OMEGA: {} rad/s",
    RADIUS="RADIUS: {} m",
    TURN="TURN, the time of a revolution: {} s",
)


@cache
def arm(*factors, **more):
    """Return the arm with other numbers in its file: the model, and what reads it."""
    model = altered(panda.load("panda_nohand", drive="torque"), *factors, **more)
    return model, panda.arm(model)


@numbers.add("Lambda at ready, along x", "{:.3f} kg",
    masses=between(1.8, 1.9, "about twice, because the rotors contribute an eighth"),
    armature=between(1.1, 1.2, "the eighth that the rotors contribute doubles"),
    metre=between(0.85, 0.95, "with twice the lever arm the apparent mass of a rotor is a quarter"),
    gravity=same("an inertia does not depend on gravity"),
    damping=same("the arm is at rest"))
def apparent(masses=1.0, armature=1.0, metre=1.0, gravity=1.0, damping=1.0):
    now = arm(metre, masses, armature, damping, gravity)[1].at(READY)
    return LAB.task_inertia(now.J_site, now.M)[3, 3]


@numbers.add("10 N along x move the hand by", "{:.3f} mm",
    PUSH=times(2.0, "x = F / K", within=0.001),
    K=times(0.5, "x = F / K", within=0.001),
    masses=times(1.0, "F / K contains no mass; a heavier arm is not yet quite at rest", within=0.001),
    gravity=same("gravity is compensated"),
    ELBOW=same("the elbow's torque is projected, so it does not move the hand"),
    step=same("the arm is at rest", to=0.001),
    wait=same("the arm is at rest"))
def pushed(masses=1.0, gravity=1.0, step=0.002, wait=3.0):
    model, known = arm(masses=masses, gravity=gravity, step=step)
    law = LAB.soft_hand(known, READY, stiffness=LAB.K)
    push = simulate.push_at(DAY.SITE, LAB.PUSH)
    start = simulate.start(model, READY)
    end = simulate.run(model, start, law, wait, rate=LAB.RATE, push=push).q[-1]
    return 1e3 * np.subtract(*(known.at(q).T_world_ee[0, 3] for q in (end, READY)))


@numbers.add("overshoot of the critically damped hand, released along e", "{:.1f} %",
    K=between(0.95, 1.05, "the ratios of the modes' rates stay the same; all rates grow by the factor √2"),
    size=between(0.9, 1.1, "nearly linear"),
    masses=between(1.1, 1.2, "the rotors contribute a smaller fraction of Lambda, so the modes change"),
    inertia=between(0.95, 1.05, "Lambda doubles, so only the time scale changes"),
    step=times(1.0, "the controller's period is the same", to=0.001))
def overshoot(size=1.0, masses=1.0, inertia=1.0, step=0.002):
    model, known = arm(1.0, masses * inertia, inertia, step=step)
    law = LAB.soft_hand(known, READY, stiffness=LAB.K)
    return -100 * DAY.released(model, law, E, 0.03 * size).min()


@cache
def pressed(stiffness, force, sink, rate, solref, friction=1.0):
    """Return the force of the soft arm at each time step, N."""
    stiffness = np.array(stiffness)
    depth = LAB.set_point_for_force(force, stiffness[5], scenes.TOUCH)

    def change(model):
        model.geom_solref[:, 0] = solref
        model.geom_condim[:] = 3 if friction else 1

    def soft_arm(known, q):
        to = lambda t: max(depth, scenes.TOUCH + 0.01 - sink * t)  # noqa: E731
        return LAB.soft_hand(known, q, to, stiffness)

    return DAY.press(soft_arm, change=change, rate=rate)


@numbers.add("the soft arm presses with", "{:.1f} N",
    PRESS=times(2.0, "depth times stiffness", within=0.005),
    K=same("with twice the stiffness the lab commands half the depth"),
    SINK=same("the arm is at rest"),
    solref=same("the tip sinks in by less than a thousandth of the spring's extension", to=0.01),
    RATE=same("the arm is at rest", to=250.0),
    friction=times(1.0, "friction acts sideways; the tip slides a little", to=0.0))
def soft(solref=0.02, friction=1.0):
    return pressed(tuple(LAB.K), LAB.PRESS, LAB.SINK, LAB.RATE, solref, friction)[-1]


@numbers.add("peak of this force", "{:.0f} N",
    SINK=between(1.3, 1.8, "an impact at twice the speed"),
    solref=between(1.8, 2.2, "the contact is twice as fast: half the time, twice the force", to=0.01),
    PRESS=between(0.95, 1.3, "the peak of the impact is the same; the 40 N are the steady force"),
    K=between(0.95, 1.3, "a stiffer hand follows its target faster: it arrives at 0.076 m/s instead of 0.068 m/s"))
def peak(solref=0.02):
    return pressed(tuple(LAB.K), LAB.PRESS, LAB.SINK, LAB.RATE, solref).max()


@numbers.add("the stiff arm presses with", "{:.0f} N",
    gains=times(1.0, "two motors are at their limits already", within=0.01),
    limits=between(1.3, 2.3, "two motors are at their limits"),
    friction=between(0.45, 0.6, "without friction the tip slides until it comes to rest", to=0.0),
    solref=times(1.0, "the motors determine the force, not the contact", to=0.01))
def stiff(gains=1.0, limits=1.0, friction=1.0, solref=0.02):
    def change(model):
        model.actuator_gainprm[:, 0] *= gains
        model.actuator_biasprm[:, 1] *= gains
        model.actuator_forcerange[:] *= limits
        model.geom_solref[:, 0] = solref
        model.geom_condim[:] = 3 if friction else 1

    return DAY.press(LAB.stiff_arm, drive="servo", seconds=3.0, change=change)[-1]


def circle(project, step=0.002):
    """Return how far off its circle the hand is, mm."""
    model, known = arm(step=step)
    return 1e3 * DAY.off_circle(model, LAB.circling(known, project), LAB.RADIUS, LAB.TURN).max()


@numbers.add("largest error on the circle with today's projector", "{:.3f} mm",
    OMEGA=between(0.4, 0.6, "the disturbance is the same, and the damping doubles"),
    RADIUS=between(0.2, 0.6, "half the velocity and half the acceleration (a radius of 0.24 m leaves the workspace)", to=0.06),
    TURN=between(0.1, 0.4, "half the velocity, a quarter of the acceleration"),
    ELBOW=between(0.9, 1.1, "the elbow's torque does not accelerate the hand"),
    step=between(0.4, 0.8, "the simulator's time step causes a large part of the error", to=0.001))
def on_circle(step=0.002):
    return circle(LAB.nullspace_torque, step)


@numbers.add("the same with Day 3's projector", "{:.3f} mm",
    OMEGA=between(0.3, 0.6, "stiffer feedback suppresses more of the disturbance"),
    ELBOW=between(0.9, 1.1, "hardly any torque is left after the projection"))
def with_day3():
    return circle(LAB.kinematic)
