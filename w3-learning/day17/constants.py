"""The sensitivity of Day 17's numbers: each constant doubled, measured, explained."""

import numpy as np

from labkit.lesson.constants import Numbers, between, same
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import diffusion

LAB = lab_of(find_day(17))

numbers = Numbers(
    levels="levels of the schedule: {}",
    last="last beta of the linear schedule: {}",
    sigma="standard deviation of a mode: {}",
    samples="samples: {}",
    steps="steps: {}",
)


def mixture(sigma):
    """Return the lab's two modes with another standard deviation."""
    return LAB.MEANS, sigma, LAB.WEIGHTS


@numbers.add(
    "fraction in the right mode, linear schedule", "{:.2f}",
    levels=between(1.05, 1.15, "less signal is left at the noisy end"),
    last=between(1.05, 1.15, "less signal is left at the noisy end"),
    sigma=same("the noisy modes widen only from 0.80 to 0.81"),
    samples=same("quantiles have no sampling error"),
)  # fmt: skip
def linear(levels=LAB.LEVELS, last=0.02, sigma=LAB.SIGMA, samples=LAB.SAMPLES // 2):
    """Return the fraction of the samples in the right mode."""
    abars = diffusion.linear_schedule(levels, last=last)[::-1]
    x = LAB.ddim(
        LAB.quantiles(samples), abars,
        lambda x, abar: LAB.exact_noise(x, abar, *mixture(sigma)),
    )  # fmt: skip
    return np.mean(x > 0)


@numbers.add(
    "width / sigma of one mode after DDIM steps", "{:.3f}",
    steps=between(1.2, 1.3, "each angle is about half as large"),
    sigma=between(1.05, 1.2, "the angles of the steps are more equal"),
    levels=between(0.9, 0.96, "level 0 has less noise, so the angle to it is larger"),
)  # fmt: skip
def ddim(steps=10, sigma=LAB.SIGMA, levels=LAB.LEVELS):
    """Return the product of the cosines."""
    return LAB.width_kept(LAB.levels(levels, steps), sigma)


@numbers.add(
    "width / sigma of one mode after Euler steps", "{:.3f}",
    steps=between(1.2, 1.35, "a step is half as long"),
    sigma=between(1.1, 1.3, "the slope of the velocity changes more slowly"),
)  # fmt: skip
def euler(steps=10, sigma=LAB.SIGMA):
    """Return the width after steps of one mode."""
    x = LAB.flow(
        np.ones((1, 1)), steps,
        lambda x, t: LAB.exact_velocity(x, t, np.zeros((1, 1)), sigma, np.ones(1)),
    )  # fmt: skip
    return x[0, 0] / sigma
