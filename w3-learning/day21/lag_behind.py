"""21.7 `lag_behind(v, stiffness, inertia)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar(unit="m"))


@row.inputs
def _(rng):
    yield 1, 1, 4
    yield 0.1, 600.0, 5.32
    yield -0.1, 600.0, 12.3
    yield 0.0, 600.0, 5.0
    for _ in range(6):
        yield (
            float(rng.numbers(-0.3, 0.3)),
            float(rng.numbers(50, 900)),
            float(rng.numbers(0.5, 15)),
        )


@row.wrongs
def _(v, stiffness, inertia):
    """half: your code uses the damping sqrt(K * Lambda), which is half of the critical
      damping. Use D = 2 * sqrt(K * Lambda) instead
    force: your function returns the force of the damper. Divide this force by the
      stiffness to obtain the extension of the spring
    feedforward: your function returns 0, which is the lag with feedforward velocity. In
      this task, the damper acts on the absolute velocity of the hand, so the spring
      balances the force of the damper
    energy: your code equates the kinetic energy of the hand with the energy of the
      spring. Equate the forces of the spring and the damper instead, because nothing
      accelerates in the steady state
    """
    return {
        "half": v * np.sqrt(inertia / stiffness),
        "force": 2 * v * np.sqrt(inertia * stiffness),
        "feedforward": 0 * v,
        "energy": abs(v) * np.sqrt(inertia / stiffness),
    }


@row.right  # By the natural frequency.
def _(v, stiffness, inertia):
    omega = np.sqrt(stiffness / inertia)
    return 2 * v / omega


@row.right  # Damper over spring.
def _(v, stiffness, inertia):
    D = 2 * np.sqrt(stiffness * inertia)
    return D * v / stiffness


row.spans(v=(1e-4, 2.0), stiffness=(1.0, 1e5), inertia=(1e-3, 100.0))
row.at_least_0(stiffness="a stiffness", inertia="an inertia")
