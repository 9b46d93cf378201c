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
    """above-the-surface: the target is above the surface: the hand never touches it and
      presses with 0 => surface + force / k
    force-times-k: force is multiplied by k; a stiffer spring needs less depth =>
      surface - force k
    k-over-force: the fraction is upside down: N divided by N/m is m => surface - k /
      force
    depth-only: this is how deep below the surface; the height to command is asked for
      => force / k
    depth-negative: the height of the surface is missing => -force / k
    millimetres: the depth is in millimetres; here everything is in metres
    half-a-spring: there is a 2 too many: force is k times depth, its half belongs to
      energy => surface - 2 force / k
    surface-only: force and k are not used: at the surface itself the spring pulls with
      0 N => surface
    whole-metres: // leaves whole numbers only, here whole metres of depth; / divides =>
      surface - force // k
    docstrings-numbers: k is 400, as in the docstring, whatever it is given => surface -
      force / 400
    docstrings-numbers 2: the surface is at 0.42, as in the docstring, whatever it is
      given => 0.42 - force / k
    half-a-depth: half of the depth is missing: force is k times depth, its half belongs
      to energy => surface - force / (2 k)
    never-below-zero: a height below 0 is not returned; a soft spring has to be pulled
      there, and only the hand presses, not the target => the right one, 0 at least
    newtons-as-weight: force is divided by 9.81, as if it were to be a mass; k takes
      newtons => surface - force / (9.81 k)
    """
    return {
        "above-the-surface": surface + force / k,
        "force-times-k": surface - force * k,
        "k-over-force": surface - k / force,
        "depth-only": force / k,
        "depth-negative": -force / k,
        "millimetres": surface - 1000.0 * force / k,
        "half-a-spring": surface - 2.0 * force / k,
        "surface-only": surface,
        "whole-metres": surface - force // k,
        "docstrings-numbers": surface - force / 400.0,
        "docstrings-numbers 2": 0.42 - force / k,
        "half-a-depth": surface - 0.5 * force / k,
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
