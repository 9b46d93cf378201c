"""6.5 `set_point_for_force(force, k, surface)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Scalar, draw
from labkit.judge.row import Row

from .states import (
    COUNT,
)

row = Row(Scalar(unit="m"))


@row.inputs
def _(rng):
    drawn = zip(
        draw.numbers(rng, 5, 60, COUNT),
        draw.numbers(rng, 200, 2000, COUNT),
        draw.numbers(rng, 0.1, 0.8, COUNT),
        strict=True,
    )
    # A deep one, and a hand that hangs from a ceiling and pulls it down.
    asked = [(20.0, 400.0, 0.42), (60.0, 50.0, 0.3), (-8.0, 300.0, -0.2)]
    return [*asked, *(tuple(map(float, one)) for one in drawn)]


def _at(wrench, row, value):
    out = wrench.copy()
    out[row] = value
    return out


@row.wrong
def above_the_surface(force, k, surface):
    """the target is above the surface: the hand never touches it and presses with 0 =>
    surface + force / k"""
    return surface + force / k


@row.wrong
def force_times_k(force, k, surface):
    """force is multiplied by k; a stiffer spring needs less depth => surface - force
    k"""
    return surface - force * k


@row.wrong
def k_over_force(force, k, surface):
    """the fraction is upside down: N divided by N/m is m => surface - k / force"""
    return surface - k / force


@row.wrong
def depth_only(force, k, surface):
    """this is how deep below the surface; the height to command is asked for => force /
    k"""
    return force / k


@row.wrong
def depth_negative(force, k, surface):
    """the height of the surface is missing => -force / k"""
    return -force / k


@row.wrong
def millimetres(force, k, surface):
    """the depth is in millimetres; here everything is in metres => the right one with
    the depth in mm"""
    return surface - 1000.0 * force / k


@row.wrong
def half_a_spring(force, k, surface):
    """there is a 2 too many: force is k times depth, its half belongs to energy =>
    surface - 2 force / k"""
    return surface - 2.0 * force / k


@row.wrong
def surface_only(force, k, surface):
    """force and k are not used: at the surface itself the spring pulls with 0 N =>
    surface"""
    return surface


@row.wrong
def whole_metres(force, k, surface):
    """// leaves whole numbers only, here whole metres of depth; / divides => surface -
    force // k"""
    return surface - force // k


@row.wrong
def docstrings_numbers(force, k, surface):
    """k is 400, as in the docstring, whatever it is given => surface - force / 400"""
    return surface - force / 400.0


@row.wrong
def docstrings_numbers(force, k, surface):
    """the surface is at 0.42, as in the docstring, whatever it is given => 0.42 - force
    / k"""
    return 0.42 - force / k


@row.wrong
def half_a_depth(force, k, surface):
    """half of the depth is missing: force is k times depth, its half belongs to energy
    => surface - force / (2 k)"""
    return surface - 0.5 * force / k


@row.wrong
def never_below_zero(force, k, surface):
    """a height below 0 is not returned; a soft spring has to be pulled there, and only
    the hand presses, not the target => the right one, 0 at least"""
    return max(surface - force / k, 0.0)


@row.wrong
def newtons_as_weight(force, k, surface):
    """force is divided by 9.81, as if it were to be a mass; k takes newtons => surface
    - force / (9.81 k)"""
    return surface - force / 9.81 / k


@row.right  # With NumPy, as an array of no axes.
def _(force, k, surface):
    return np.subtract(surface, np.divide(force, k))
