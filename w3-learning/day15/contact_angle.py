"""15.1 `contact_angle(phi, distance, R)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar(unit="rad"))


@row.inputs
def _(rng):
    yield 0.1, 0.065, 0.065
    yield 0.1, 0.0, 0.065
    for side in (1, -1, 1, -1, 1, -1):
        phi = rng.numbers(0.02, 1.4)
        distance = rng.numbers(0, 0.2)
        R = rng.numbers(0.03, 0.12)
        yield float(side * phi), float(distance), float(R)
    yield 2.6, 0.04, 0.08


row.cases(
    pushes_of_distance_0=lambda phi, distance, R: distance == 0,
    pushes_over_a_distance=lambda phi, distance, R: distance > 0,
)
row.cases(
    positive_angles=lambda phi, distance, R: phi > 0,
    negative_angles=lambda phi, distance, R: phi < 0,
)


@row.wrongs
def _(phi, distance, R):
    """small-angle: your code returns phi * exp(distance / R), which is accurate only
      for small angles. Integrate d(phi)/ds = sin(phi) / R without replacing sin(phi) by
      phi
    one-step: your code computes phi + distance * sin(phi) / R, as if the rate sin(phi)
      / R were constant. This rate changes along the path, so integrate it
    whole-angle: your code multiplies tan(phi) by exp(distance / R). Multiply tan(phi /
      2) by this factor instead, because tan(phi / 2) grows exponentially along the path
    linear-growth: your code multiplies tan(phi / 2) by 1 + distance / R. The rate of
      change of tan(phi / 2) is proportional to tan(phi / 2), so use the factor
      exp(distance / R) instead
    sine-grows: your code multiplies sin(phi) by exp(distance / R), which is accurate
      only for small angles. Multiply tan(phi / 2) by this factor instead
    sine-grows 2: your code multiplies sin(phi) by exp(distance / R), which is accurate
      only for small angles. Multiply tan(phi / 2) by this factor instead
    """
    grown = np.sin(phi) * np.exp(distance / R)
    return {
        "small-angle": phi * np.exp(distance / R),
        "one-step": phi + distance * np.sin(phi) / R,
        "whole-angle": np.arctan(np.tan(phi) * np.exp(distance / R)),
        "linear-growth": 2 * np.arctan(np.tan(phi / 2) * (1 + distance / R)),
        "sine-grows": np.arcsin(grown),
        "sine-grows 2": np.arcsin(np.clip(grown, -1, 1)),
    }


@row.right  # With the half-angle in terms of tanh.
def _(phi, distance, R):
    if abs(np.sin(phi)) < 1e-300:
        return phi
    way = np.log(np.abs(np.tan(phi / 2))) + distance / R
    return np.sign(phi) * np.arccos(-np.tanh(way))


@row.right  # A start, and where the exponential ends.
def _(phi, distance, R):
    t = np.exp(distance / R) * np.sin(phi / 2)
    return 2 * np.arctan2(t, np.cos(phi / 2))


row.spans(
    phi=(0.0, 1e-4, 3.0),
    distance=(1e-6, 1.0),
    R=(0.01,),
)
