"""6.5 `set_point_for_force(force, k, surface)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

from .states import COUNT

row = Row(Scalar(unit="m"))


@row.inputs
def _(rng):
    drawn = zip(
        rng.numbers(5, 60, COUNT),
        rng.numbers(200, 2000, COUNT),
        rng.numbers(0.1, 0.8, COUNT),
        strict=True,
    )
    # A deep one, and a hand that hangs from a ceiling and pulls it down.
    asked = [(20.0, 400.0, 0.42), (60.0, 50.0, 0.3), (-8.0, 300.0, -0.2)]
    return [*asked, *(tuple(map(float, one)) for one in drawn)]


@row.wrongs
def _(force, k, surface):
    """millimetres: your code computes the depth in millimetres. All lengths should be
      in metres
    whole-metres: your depth is rounded down to whole metres, as by the operator `//`.
      The depth should not be rounded
    docstrings-numbers: your code always uses the stiffness 400, which is the value in
      the docstring. Use the argument `k` instead
    docstrings-numbers 2: your code always uses the surface height 0.42, which is the
      value in the docstring. Use the argument `surface` instead
    never-below-zero: your code replaces negative heights with 0. Return the height
      unchanged, because the commanded height can be negative
    newtons-as-weight: your depth is divided by 9.81, as if the force were converted to
      a mass. Use the force in newtons
    """
    return {
        "millimetres": surface - 1000.0 * force / k,
        "whole-metres": surface - force // k,
        "docstrings-numbers": surface - force / 400.0,
        "docstrings-numbers 2": 0.42 - force / k,
        "never-below-zero": max(surface - force / k, 0.0),
        "newtons-as-weight": surface - force / 9.81 / k,
    }


@row.right  # With NumPy, as an array of no axes.
def _(force, k, surface):
    return np.subtract(surface, np.divide(force, k))


row.at_least_0(k="a stiffness")


row.spans(  # as small, or as large, as in the lab
    force=(0.1,),
    surface=(
        0.04,
        10.0,
    ),
)
