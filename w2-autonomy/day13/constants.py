"""What Day 13's numbers hang on: each constant turned by two, measured, explained.

Everything is computed by the lab's own functions; nothing has noise.
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
    r="R_COST: {}",
    both="Q and R: × {}",
    speed="Q of a speed: {}",
    steps="STEPS: {}",
    g="gravity: × {}",
    size="how far it starts: {} rad",
    seconds="SECONDS: {}",
    mass="the links' masses and inertias: × {}",
    dt="DT: {} s",
    gain="GAIN: {} 1/s",
    damping="DAMPING: {}",
    turn="a turn weighs {}",
    lap="a lap takes {} s",
    limit="the joints' speed limits: × {}",
    way="TO, how far it reaches: × {}",
    motion="MOTION: {} steps",
    effort="EFFORT: {}",
    far="FAR: {}",
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
    q=between(1.28, 1.36, "30.5 + sqrt(30.5² + 20,000) is 175.2, 1.30 times as much"),
    r=between(0.75, 0.80, "30.5 + sqrt(30.5² + 5,000) is 107.5, 0.80 times as much"),
    both=same("twice the cost of everything has its least at the same place"),
    g=between(1.26, 1.33, "twice the slope: 61 + sqrt(61² + 10,000) is 178.1"),
    mass=between(1.22, 1.33, "the slope doubles, as with gravity; M itself drops out"),
    h=times(0.987, "the formula has no step, and the gap to it, 1.6, doubles"),
    speed=between(0.98, 1.0, "it brakes more, and springs hardly less"),
    steps=same("P no longer changes"),
)  # fmt: skip
def stiffness(
    q=LAB.Q_COST[0], r=LAB.R_COST, both=1.0, g=1.0, mass=1.0, h=0.002,
    speed=LAB.Q_COST[-1], steps=LAB.STEPS,
):  # fmt: skip
    """Return joint 2's gain of its own angle."""
    _, _, K = held(h, both * q, both * r, both * speed, steps, g, mass)
    return K[1, 1]


@numbers.add(
    "one side of the promise, folded, off by", "{:.2f} %",
    size=times(2.0, "the cubic term over the quadratic one: linear in the size",
               within=0.05),
    both=same("cost and promise both double"),
    seconds=same("it stands still long before"),
    steps=same("P no longer changes"),
    g=between(0.4, 0.6, "what is left is M, which changes with the pose, too", to=1e-3),
    h=between(0.9, 1.1, "the same motion, in longer steps"),
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
    "off the circle, best", "{:.2f} mm",
    turn=between(1.0, 1.01, "13.09 / (1 + a² / w): nearly nothing is tilted any more"),
    damping=between(0.99, 1.01, "the limits do what damping did"),
    dt=between(1.0, 1.05, "the goal goes on while the hand waits for the next step"),
    gain=between(0.98, 1.02, "what is out of reach is no nearer when wanted more"),
    lap=between(0.99, 1.01, "geometry has no speed"),
    limit=between(1.02, 1.15, "a step twice as long is no longer straight"),
)  # fmt: skip
def best(
    turn=1.0, damping=LAB.DAMPING, dt=LAB.DT, gain=LAB.GAIN, lap=DAY.LAP, limit=1.0
):
    """Return how far off the hand is at most."""
    with turned(LAB, DAMPING=damping):
        return circle(LAB.best_step(turn), dt, gain, lap, limit)


@numbers.add(
    "off the circle, clipped", "{:.0f} mm",
    damping=between(0.2, 0.9, "less is asked near the end of the reach, and less cut"),
    dt=between(1.1, 2.0, "a joint that is cut off is wrong for longer"),
    gain=between(1.1, 2.0, "more is asked, so more is cut"),
    lap=between(0.6, 0.95, "less is asked in a step"),
    limit=between(0.2, 0.95, "less is cut"),
)  # fmt: skip
def clipped(damping=LAB.DAMPING, dt=LAB.DT, gain=LAB.GAIN, lap=DAY.LAP, limit=1.0):
    """Return how far off the hand is at most."""

    def step(J, e, lo, hi):
        return np.clip(dls_step(J, e, damping), lo, hi)

    return circle(step, dt, gain, lap, limit)


@numbers.add(
    "the cost of the reach, after 3 rounds", "{:.3f}",
    way=between(3.5, 5.0, "cost is quadratic in the way, nearly"),
    motion=between(0.6, 0.8, "a quarter of the torque, but gravity is paid for longer"),
    effort=between(1.3, 2.0, "twice the price of torque, and a little less of it"),
    far=between(1.0, 1.1, "the end is reached nearly as it is"),
)  # fmt: skip
def reached(way=1.0, motion=LAB.MOTION, effort=DAY.EFFORT, far=DAY.FAR):
    """Return what it costs."""
    with (
        turned(LAB, TO=way * LAB.TO, MOTION=motion),
        turned(DAY, EFFORT=effort, FAR=far),
    ):
        return LAB.reach(DAY.arm())[-1][0]
