"""The sensitivity of Day 15's numbers: each constant doubled, measured, explained."""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

LAB = lab_of(find_day(15))
DAY = LAB.day15_mujoco

numbers = Numbers(
    beside="distance from the centre line: {} mm",
    mass="mass of the puck: {} kg",
    damping="damping of the puck: {} N s/m",
    speed="speed of the push: {} m/s",
    step="time step: {} s",
    sideways="sideways error: {} mm/s",
    steer="gain of the steering: {} 1/s",
    far="distance from home: {} m",
    seconds="time until it is measured: {} s",
    units="units of each hidden layer: {}",
    demos="demonstrations: {}",
    seed="seed: {}",
)


@numbers.add(
    "path of a blind push to 60 degrees", "{:.0f} mm",
    beside=between(0.6, 0.7, "R ln(tan 30° / tan(phi / 2)): R ln 2 is 45 mm"),
    mass=between(1.02, 1.04, "the puck runs on by speed · mass / damping"),
    damping=between(0.98, 0.99, "the puck runs on by speed · mass / damping"),
    speed=between(1.02, 1.04, "the puck runs on by speed · mass / damping"),
    step=between(0.99, 1.01, "shorter than the puck's 20 ms"),
)  # fmt: skip
def blind(
    beside=10.0, mass=DAY.MASS, damping=DAY.DAMPING, speed=DAY.PUSH, step=DAY.STEP
):
    """Return the path length of the pusher, mm."""
    scene = DAY.scene(mass, damping, step)
    return 1e3 * DAY.blind_push(*scene, beside / 1e3, speed=speed)


@numbers.add(
    "2 mm/s sideways, beside the line", "{:.2f} mm",
    sideways=times(2.0, "e / (K - v/R - v/D)"),
    steer=between(0.3, 0.34, "e / (K - v/R - v/D)"),
    far=between(0.98, 1.0, "v/D is only 3 % of K - v/R"),
    seconds=between(1.0, 1.02, "D shrinks by 0.3 m"),
)  # fmt: skip
def drift(sideways=2.0, steer=DAY.STEER, far=LAB.FAR, seconds=3.0):
    """Return how far the pusher rests beside the line, mm."""
    start = np.array([[far + LAB.R, 0.0, far, 0.0]])
    error = np.array([0.0, -1e-3 * sideways])
    run = DAY.run(
        *DAY.scene(),
        start,
        lambda seen: DAY.demonstrator(seen, steer=steer) + error,
        round(seconds / DAY.TICK),
    )
    return 1e3 * LAB.beside_the_line(run.observation[0, -1])


def rows(demos, seed, **how):
    """Return observations, actions and episodes of demonstrations."""
    return DAY.demonstrations(demos, seed, **how).rows()


@numbers.add(
    "loss before training", "{:.3f}",
    units=same("the last layer is 0, so the output is the mean"),
    demos=same("the variance of a normalised column is 1"),
    seed=same("the variance of a normalised column is 1"),
)  # fmt: skip
def first(units=LAB.UNITS, demos=LAB.DEMOS, seed=LAB.SEED):
    """Return the loss of a network whose last layer is 0."""
    x, action, _ = rows(demos, seed)
    net = LAB.cloning.random_net(np.random.default_rng(seed), 4, units, 2)
    return LAB.Clone(net, LAB.fit_scaler(x), LAB.fit_scaler(action)).loss(x, action)


@numbers.add(
    "loss of repeating the last action, on the training rows", "{:.3f}",
    demos=between(0.8, 1.25, "more rows of the same kind"),
    seed=between(0.8, 1.25, "other demonstrations of the same kind", to=2),
)  # fmt: skip
def repeats(demos=LAB.DEMOS, seed=LAB.SEED):
    """Return the loss of the policy that repeats the last action."""
    _, action, episode = rows(demos, seed)
    z = LAB.normalise(action, LAB.fit_scaler(action))
    return LAB.persistence_loss(z, episode)
