"""5.2 `gains(omega, zeta)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Vector, draw
from labkit.judge.row import Row

row = Row(Vector((2,), scale=100.0, names=("kp", "kd")))


@row.inputs
def _(rng):
    yield 20.0, 1.0
    yield 20.0, 0.0  # undamped
    omega, zeta = draw.numbers(rng, 3, 60, 9), draw.numbers(rng, 0.2, 2, 9)
    yield from zip(omega.tolist(), zeta.tolist(), strict=True)


@row.wrong
def two_forgotten(omega, zeta):
    """kd is zeta omega; the standard form has a factor of its own before them, and
    without it the joint is damped half as much as you asked"""
    return np.array([omega**2, zeta * omega])


@row.wrong
def kp_is_omega(omega, zeta):
    """kp is omega, not its square: compare the units, kp is in 1/s2"""
    return np.array([omega, 2.0 * zeta * omega])


@row.wrong
def kd_is_omega(omega, zeta):
    """kd is omega whatever zeta is, which is right for zeta = 0.5 alone. It tracks well
    and overshoots by a sixth"""
    return np.array([omega**2, omega])


@row.wrong
def zeta_ignored(omega, zeta):
    """kd does not depend on zeta: it is right for critical damping alone"""
    return np.array([omega**2, 2.0 * omega])


@row.wrong
def swapped(omega, zeta):
    """kp and kd are swapped"""
    return np.array([2.0 * zeta * omega, omega**2])


@row.wrong
def root_of_omega(omega, zeta):
    """kd has the square root of omega in it, as if omega were kp already"""
    return np.array([omega**2, 2.0 * zeta * np.sqrt(omega)])


@row.wrong
def kd_with_omega_squared(omega, zeta):
    """kd has omega squared in it: compare the units, kd is in 1/s"""
    return np.array([omega**2, 2.0 * zeta * omega**2])


@row.wrong
def zeta_squared_in_kp(omega, zeta):
    """kp has zeta in it; damping changes kd alone"""
    return np.array([(zeta * omega) ** 2, 2.0 * zeta * omega])


@row.wrong
def omega_in_turns(omega, zeta):
    """omega is taken for turns per second and multiplied by 2 pi; it comes in rad/s"""
    omega = 2.0 * np.pi * omega
    return np.array([omega**2, 2.0 * zeta * omega])


@row.right  # From the two roots of the polynomial.
def _(omega, zeta):
    root = np.sqrt(complex(zeta**2 - 1))
    a, b = omega * (-zeta + root), omega * (-zeta - root)
    return np.array([(a * b).real, -(a + b).real])


@row.right  # A plain list.
def _(omega, zeta):
    return [omega * omega, 2 * omega * zeta]
