"""What the toy's numbers hang on: all that a list of constants can say."""

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.lab_module import complete_lab

LAB = complete_lab(46)
numbers = Numbers(
    LAB,
    metre="lengths in a unit of 1 m: {} times as large",
    y="the second vector's y is {}",
    SEED="the draw is number {}",
    order="the factors stand in the order {}",
)


@numbers.add("angle between (1, 0, 0) and (0, 2, 0)", "{:.4f} rad",
    metre=same("an angle has no length in it"),
    y=same("a longer vector has the same direction"))
def angle(metre=1.0, y=2.0):
    return LAB.angle_between(metre * np.array([1.0, 0, 0]), np.array([0, y, 0]))


@numbers.add("z of their cross product", "{:.1f} m^2",
    metre=times(4.0, "an area has two lengths in it"),
    y=times(2.0, "the product is linear in each factor"),
    order=times(-1.0, "b x a is -(a x b)", to="ba"))
def product(metre=1.0, y=2.0, order="ab"):
    vectors = {"a": metre * np.array([1.0, 0, 0]), "b": metre * np.array([0, y, 0])}
    return LAB.cross(*(vectors[name] for name in order))[2]


@numbers.add("mean angle of 100 random pairs", "{:.1f} rad",
    SEED=between(0.8, 1.25, "another hundred pairs", to=47))
def drawn():
    pairs = np.random.default_rng(LAB.SEED).normal(size=(100, 2, 3))
    return np.mean([LAB.angle_between(a, b) for a, b in pairs])


@numbers.add("|a . (a x b)|", "{:.1e} m^3",
    SEED=same("a x b is perpendicular to a, up to rounding", to=47))
def off():
    a, b = np.random.default_rng(LAB.SEED).normal(size=(2, 3))
    return abs(a @ LAB.cross(a, b)) + 1e-20
