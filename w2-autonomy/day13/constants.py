"""The sensitivity of Day 13's numbers: each constant doubled, measured and explained.

The lab's own functions compute everything, and nothing is random.
"""

import numpy as np

from labkit.lesson.constants import Numbers, altered, between, same, times, turned
from labkit.lesson.lab_module import complete_lab
from robo47.jacobian import dls_step

LAB = complete_lab(13)
DAY = LAB.day13_mujoco

numbers = Numbers(
    LAB, DAY,
    h="time step: {} s",
    q="Q of an angle: {}",
    R_COST="R_COST, the weight of a torque: {}",
    both="Q and R: × {}",
    speed="Q of a velocity: {}",
    STEPS="STEPS, of the Riccati recursion: {}",
    g="gravity: × {}",
    JUDGED="distance of the start: {} rad",
    SECONDS="SECONDS, the simulated time: {}",
    mass="the links' masses and inertias: × {}",
    DT="DT, the time step: {} s",
    GAIN="GAIN, of the pose error: {} 1/s",
    DAMPING="DAMPING: {}",
    turn="orientation weight: {}",
    LAP="a lap takes {} s",
    SPEED="the joints' velocity limits: × {}",
    TO="TO, the distance of the goal: × {}",
    MOTION="MOTION: {} steps",
    EFFORT="EFFORT, the weight of the torques: {}",
    FAR="FAR, the weight of the distance to the goal: {}",
)


def held(h, q=LAB.Q_COST[0], speed=LAB.Q_COST[-1], both=1.0, g=1.0, mass=1.0):
    """Return a model, its P and its K."""
    model = altered(DAY.arm(), masses=mass, gravity=g, step=h)
    _, A, B = LAB.at_rest(model, LAB.READY_Q, h)
    with turned(LAB, Q_COST=both * np.repeat([q, speed], 7)):
        return model, *LAB.promise(A, B, h, both * LAB.R_COST)


@numbers.add("stiffness of joint 2", "{:.1f} N m/rad",
    q=between(1.28, 1.36, "the formula gives 30.5 + sqrt(30.5² + 20,000) = 175.2, 1.30 times as much"),
    R_COST=between(0.75, 0.80, "the formula gives 30.5 + sqrt(30.5² + 5,000) = 107.5, 0.80 times as much"),
    both=same("twice the cost has the same minimiser"),
    g=between(1.26, 1.33, "with twice the gravity stiffness the formula gives 61 + sqrt(61² + 10,000) = 178.1"),
    mass=between(1.22, 1.33, "the gravity stiffness doubles, as with gravity; the mass matrix has little effect"),
    h=times(0.987, "the formula assumes an infinitely small step; the difference from the formula, 1.6, doubles"),
    speed=between(0.98, 1.0, "the damping grows, and the stiffness hardly changes"),
    STEPS=same("P has converged"))
def stiffness(q=LAB.Q_COST[0], both=1.0, g=1.0, mass=1.0, h=0.002, speed=LAB.Q_COST[-1]):
    _, _, K = held(h, q, speed, both, g, mass)
    return K[1, 1]


@numbers.add("measured / predicted cost with one start, folded, off by", "{:.2f} %",
    JUDGED=times(2.0, "the cubic term divided by the quadratic one is linear in the distance", within=0.05),
    both=same("measured and predicted cost both double"),
    SECONDS=same("the arm is at rest long before that"),
    STEPS=same("P has converged"),
    g=between(0.4, 0.6, "the rest comes from the mass matrix, which also changes with the configuration", to=1e-3),
    h=between(0.9, 1.1, "the motion is the same, in longer steps"))
def other_side(both=1.0, g=1.0, h=0.002):
    model, P, K = held(h, both=both, g=g)
    with turned(LAB, Q_COST=both * LAB.Q_COST, R_COST=both * LAB.R_COST):
        return 100 * (LAB.kept(model, P, K, LAB.JUDGED)[1] - 1)


@numbers.add("largest error on the circle, qp_ik", "{:.2f} mm",
    turn=between(1.0, 1.01, "the formula 13.09 / (1 + a² / w) approaches 13.09: the tool hardly tilts any more"),
    DAMPING=between(0.99, 1.01, "the bounds of the QP limit the steps, so the damping is not needed for this"),
    DT=between(1.0, 1.05, "the goal moves on between two steps"),
    GAIN=between(0.98, 1.02, "a larger gain does not extend the workspace"),
    LAP=between(0.99, 1.01, "the geometry does not depend on the speed"),
    SPEED=between(1.02, 1.15, "the reason is not known"))
def best(turn=1.0):
    return LAB.draw_circle(DAY.arm(), LAB.best_step(turn))[0].max()


@numbers.add("largest error on the circle, clamped", "{:.0f} mm",
    DAMPING=between(0.2, 0.9, "the steps near the boundary of the workspace are shorter, so fewer are clamped"),
    DT=between(1.1, 2.0, "the error of a clamped step lasts longer"),
    GAIN=between(1.1, 2.0, "the steps are longer, so more of them are clamped"),
    LAP=between(0.6, 0.95, "the steps are shorter"),
    SPEED=between(0.2, 0.95, "fewer steps are clamped"))
def clipped():
    def step(J, e, lo, hi):
        return np.clip(dls_step(J, e, LAB.DAMPING), lo, hi)

    return LAB.draw_circle(DAY.arm(), step)[0].max()


@numbers.add("cost of the motion after 3 iterations", "{:.3f}",
    TO=between(3.5, 5.0, "the cost is nearly quadratic in the distance"),
    MOTION=between(0.6, 0.8, "the costs of the torque, of the velocities and of the final error all decrease, the cost of the velocities most"),
    EFFORT=between(1.3, 2.0, "the torque costs twice as much, and a little less of it is used"),
    FAR=between(1.0, 1.1, "the motion already ends near the goal"))
def reached():
    return LAB.reach(DAY.arm())[-1][0]
