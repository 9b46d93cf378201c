"""The sensitivity of Day 15's numbers: each constant doubled, measured, explained."""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.lab_module import complete_lab

LAB = complete_lab(15)
DAY = LAB.day15_mujoco

numbers = Numbers(
    LAB, DAY,
    beside="distance from the centre line: {} mm",
    MASS="mass of the puck: {} kg",
    DAMPING="damping of the puck: {} N s/m",
    PUSH="speed of the push: {} m/s",
    STEP="time step: {} s",
    sideways="sideways error: {} mm/s",
    STEER="gain of the steering: {} 1/s",
    FAR="distance from home: {} m",
    seconds="time until it is measured: {} s",
    UNITS="units of each hidden layer: {}",
    DEMOS="demonstrations: {}",
    SEED="seed: {}",
)


@numbers.add("path of a blind push to 60 degrees", "{:.0f} mm",
    beside=between(0.6, 0.7, "R ln(tan 30° / tan(phi / 2)): R ln 2 is 45 mm"),
    MASS=between(1.02, 1.04, "the delay adds speed · mass / damping to R"),
    DAMPING=between(0.98, 0.99, "the delay adds speed · mass / damping to R"),
    PUSH=between(1.02, 1.04, "the delay adds speed · mass / damping to R"),
    STEP=between(0.99, 1.01, "at 0.02 s the push still has 67 steps"))
def blind(beside=10.0):
    scene = DAY.scene(DAY.MASS, DAY.DAMPING, DAY.STEP)
    return 1e3 * DAY.blind_push(*scene, beside / 1e3, speed=DAY.PUSH)


@numbers.add("2 mm/s sideways, beside the line", "{:.2f} mm",
    sideways=times(2.0, "e / (K - v/R - v/D)"),
    STEER=between(0.3, 0.34, "e / (K - v/R - v/D)"),
    FAR=between(0.98, 1.0, "v/D is only 3 % of K - v/R"),
    seconds=between(1.0, 1.02, "D shrinks by 0.3 m"))
def drift(sideways=2.0, seconds=3.0):
    start = np.array([[LAB.FAR + LAB.R, 0.0, LAB.FAR, 0.0]])
    error = np.array([0.0, -1e-3 * sideways])
    run = DAY.run(
        *DAY.scene(),
        start,
        lambda seen: DAY.demonstrator(seen, steer=DAY.STEER) + error,
        round(seconds / DAY.TICK),
    )
    return 1e3 * LAB.beside_the_line(run.observation[0, -1])


def rows(demos, seed, **how):
    """Return observations, actions and episodes of demonstrations."""
    return DAY.demonstrations(demos, seed, **how).rows()


@numbers.add("loss before training", "{:.3f}",
    UNITS=same("the last layer is 0, so the output is the mean"),
    DEMOS=same("the variance of a normalised column is 1"),
    SEED=same("the variance of a normalised column is 1"))
def first():
    x, action, _ = rows(LAB.DEMOS, LAB.SEED)
    net = LAB.cloning.random_net(np.random.default_rng(LAB.SEED), 4, LAB.UNITS, 2)
    return LAB.Clone(net, LAB.fit_scaler(x), LAB.fit_scaler(action)).loss(x, action)


@numbers.add("loss of repeating the last action, on the training rows", "{:.3f}",
    DEMOS=between(0.8, 1.25, "more rows of the same kind"),
    SEED=between(0.8, 1.25, "other demonstrations of the same kind", to=2))
def repeats():
    _, action, episode = rows(LAB.DEMOS, LAB.SEED)
    z = LAB.normalise(action, LAB.fit_scaler(action))
    return LAB.persistence_loss(z, episode)
