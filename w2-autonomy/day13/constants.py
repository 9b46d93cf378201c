"""The sensitivity of Day 13's numbers: each constant doubled, measured and explained.

The lab's own functions compute everything, and nothing is random.
"""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47.jacobian import dls_step

LAB = lab_of(find_day(13))
DAY = LAB.day13_mujoco

numbers = Numbers(
    h="time step: {} s",
    q="Q of an angle: {}",
    r="R_COST, the weight of a torque: {}",
    both="Q and R: × {}",
    speed="Q of a velocity: {}",
    steps="STEPS, of the Riccati recursion: {}",
    g="gravity: × {}",
    size="distance of the start: {} rad",
    seconds="SECONDS, the simulated time: {}",
    mass="the links' masses and inertias: × {}",
    dt="DT, the time step: {} s",
    gain="GAIN, of the pose error: {} 1/s",
    damping="DAMPING: {}",
    turn="orientation weight: {}",
    lap="a lap takes {} s",
    limit="the joints' velocity limits: × {}",
    way="TO, the distance of the goal: × {}",
    motion="MOTION: {} steps",
    effort="EFFORT, the weight of the torques: {}",
    far="FAR, the weight of the distance to the goal: {}",
)


def model_of(h, g=1.0, mass=1.0):
    """Return the Panda with another time step, gravity and weight."""
    model = DAY.arm()
    model.opt.timestep = h
    model.opt.gravity[:] *= g
    model.body_mass[:] *= mass
    model.body_inertia[:] *= mass
    return model


def held(h, q, r, speed, steps, g=1.0, mass=1.0):
    """Return a model, its P and its K."""
    model = model_of(h, g, mass)
    _, A, B = LAB.at_rest(model, LAB.READY_Q, h)
    with turned(LAB, Q_COST=np.repeat([q, speed], 7), STEPS=steps):
        return model, *LAB.promise(A, B, h, r)


@numbers.add(
    "stiffness of joint 2", "{:.1f} N m/rad",
    q=between(1.28, 1.36, "the formula gives 30.5 + sqrt(30.5² + 20,000) = 175.2, 1.30 times as much"),
    r=between(0.75, 0.80, "the formula gives 30.5 + sqrt(30.5² + 5,000) = 107.5, 0.80 times as much"),
    both=same("twice the cost has the same minimiser"),
    g=between(1.26, 1.33, "with twice the gravity stiffness the formula gives 61 + sqrt(61² + 10,000) = 178.1"),
    mass=between(1.22, 1.33, "the gravity stiffness doubles, as with gravity; the mass matrix has little effect"),
    h=times(0.987, "the formula assumes an infinitely small step; the difference from the formula, 1.6, doubles"),
    speed=between(0.98, 1.0, "the damping grows, and the stiffness hardly changes"),
    steps=same("P has converged"),
)  # fmt: skip
def stiffness(
    q=LAB.Q_COST[0], r=LAB.R_COST, both=1.0, g=1.0, mass=1.0, h=0.002,
    speed=LAB.Q_COST[-1], steps=LAB.STEPS,
):  # fmt: skip
    """Return joint 2's gain of its own angle."""
    _, _, K = held(h, both * q, both * r, both * speed, steps, g, mass)
    return K[1, 1]


@numbers.add(
    "measured / predicted cost with one start, folded, off by", "{:.2f} %",
    size=times(2.0, "the cubic term divided by the quadratic one is linear in the distance",
               within=0.05),
    both=same("measured and predicted cost both double"),
    seconds=same("the arm is at rest long before that"),
    steps=same("P has converged"),
    g=between(0.4, 0.6, "the rest comes from the mass matrix, which also changes with the configuration", to=1e-3),
    h=between(0.9, 1.1, "the motion is the same, in longer steps"),
)  # fmt: skip
def other_side(
    size=LAB.JUDGED, both=1.0, seconds=LAB.SECONDS, steps=LAB.STEPS, g=1.0, h=0.002
):
    """Return how far cost over promise is from 1 on one side."""
    q, speed, r = both * LAB.Q_COST[0], both * LAB.Q_COST[-1], both * LAB.R_COST
    model, P, K = held(h, q, r, speed, steps, g)
    costs = {"Q_COST": both * LAB.Q_COST, "R_COST": r}
    with turned(LAB, SECONDS=seconds, **costs):
        return 100 * (LAB.kept(model, P, K, size)[1] - 1)


def circle(step, dt, gain, lap, limit):
    """Return how far off the circle a way to step is at most, mm."""
    with (
        turned(LAB, DT=dt, GAIN=gain, SPEED=limit * LAB.SPEED),
        turned(DAY, LAP=lap),
    ):
        return LAB.draw_circle(DAY.arm(), step)[0].max()


@numbers.add(
    "largest error on the circle, qp_ik", "{:.2f} mm",
    turn=between(1.0, 1.01, "the formula 13.09 / (1 + a² / w) approaches 13.09: the tool hardly tilts any more"),
    damping=between(0.99, 1.01, "the bounds of the QP limit the steps, so the damping is not needed for this"),
    dt=between(1.0, 1.05, "the goal moves on between two steps"),
    gain=between(0.98, 1.02, "a larger gain does not extend the workspace"),
    lap=between(0.99, 1.01, "the geometry does not depend on the speed"),
    limit=between(1.02, 1.15, "the reason is not known"),
)  # fmt: skip
def best(
    turn=1.0, damping=LAB.DAMPING, dt=LAB.DT, gain=LAB.GAIN, lap=DAY.LAP, limit=1.0
):
    """Return how far off the hand is at most."""
    with turned(LAB, DAMPING=damping):
        return circle(LAB.best_step(turn), dt, gain, lap, limit)


@numbers.add(
    "largest error on the circle, clamped", "{:.0f} mm",
    damping=between(0.2, 0.9, "the steps near the boundary of the workspace are shorter, so fewer are clamped"),
    dt=between(1.1, 2.0, "the error of a clamped step lasts longer"),
    gain=between(1.1, 2.0, "the steps are longer, so more of them are clamped"),
    lap=between(0.6, 0.95, "the steps are shorter"),
    limit=between(0.2, 0.95, "fewer steps are clamped"),
)  # fmt: skip
def clipped(damping=LAB.DAMPING, dt=LAB.DT, gain=LAB.GAIN, lap=DAY.LAP, limit=1.0):
    """Return how far off the hand is at most."""

    def step(J, e, lo, hi):
        return np.clip(dls_step(J, e, damping), lo, hi)

    return circle(step, dt, gain, lap, limit)


@numbers.add(
    "cost of the motion after 3 iterations", "{:.3f}",
    way=between(3.5, 5.0, "the cost is nearly quadratic in the distance"),
    motion=between(0.6, 0.8, "the costs of the torque, of the velocities and of the final error all decrease, the cost of the velocities most"),
    effort=between(1.3, 2.0, "the torque costs twice as much, and a little less of it is used"),
    far=between(1.0, 1.1, "the motion already ends near the goal"),
)  # fmt: skip
def reached(way=1.0, motion=LAB.MOTION, effort=DAY.EFFORT, far=DAY.FAR):
    """Return what it costs."""
    with (
        turned(LAB, TO=way * LAB.TO, MOTION=motion),
        turned(DAY, EFFORT=effort, FAR=far),
    ):
        return LAB.reach(DAY.arm())[-1][0]
