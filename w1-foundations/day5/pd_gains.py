"""5.2 `pd_gains(omega, zeta)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((2,), scale=100.0, names=("kp", "kd")))


@row.inputs
def _(rng):
    yield 20.0, 1.0
    yield 20.0, 0.0  # undamped
    omega, zeta = rng.numbers(3, 60, 9), rng.numbers(0.2, 2, 9)
    yield from zip(omega.tolist(), zeta.tolist(), strict=True)


@row.wrongs
def _(omega, zeta):
    """two-forgotten: kd is zeta omega; the standard form has a factor of its own before
      them, and without it the joint is damped half as much as you asked
    kp-is-omega: kp is omega, not its square: compare the units, kp is in 1/s2
    kd-is-omega: kd is omega whatever zeta is, which is right for zeta = 0.5 alone. It
      tracks well and overshoots by a sixth
    zeta-ignored: kd does not depend on zeta: it is right for critical damping alone
    swapped: kp and kd are swapped
    root-of-omega: kd has the square root of omega in it, as if omega were kp already
    kd-with-omega-squared: kd has omega squared in it: compare the units, kd is in 1/s
    omega-in-turns: omega is taken for turns per second and multiplied by 2 pi; it comes
      in rad/s
    zeta-squared-in-kp: kp has zeta in it; damping changes kd alone
    """
    turns = 2.0 * np.pi * omega
    return {
        "omega-in-turns": np.array([turns**2, 2.0 * zeta * turns]),
        "two-forgotten": np.array([omega**2, zeta * omega]),
        "kp-is-omega": np.array([omega, 2.0 * zeta * omega]),
        "kd-is-omega": np.array([omega**2, omega]),
        "zeta-ignored": np.array([omega**2, 2.0 * omega]),
        "swapped": np.array([2.0 * zeta * omega, omega**2]),
        "root-of-omega": np.array([omega**2, 2.0 * zeta * np.sqrt(omega)]),
        "kd-with-omega-squared": np.array([omega**2, 2.0 * zeta * omega**2]),
        "zeta-squared-in-kp": np.array([(zeta * omega) ** 2, 2.0 * zeta * omega]),
    }


@row.right  # A plain list.
def _(omega, zeta):
    return [omega * omega, 2 * omega * zeta]


row.at_least_0(omega="a frequency", zeta="a damping ratio", answer="gains")


row.spans(  # as small, or as large, as in the lab
    omega=(400.0,),
)
