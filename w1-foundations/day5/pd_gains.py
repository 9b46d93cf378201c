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
    """root-of-omega: your kd contains the square root of omega. In the formula 2 zeta
      sqrt(k), k is the stiffness, and omega equals sqrt(k)
    omega-in-turns: your code multiplies omega by 2 pi, but omega is already in rad/s
    """
    turns = 2.0 * np.pi * omega
    return {
        "omega-in-turns": np.array([turns**2, 2.0 * zeta * turns]),
        "root-of-omega": np.array([omega**2, 2.0 * zeta * np.sqrt(omega)]),
    }


@row.right  # A plain list.
def _(omega, zeta):
    return [omega * omega, 2 * omega * zeta]


row.at_least_0(omega="a frequency", zeta="a damping ratio", answer="gains")


row.spans(  # as small, or as large, as in the lab
    omega=(400.0,),
)
