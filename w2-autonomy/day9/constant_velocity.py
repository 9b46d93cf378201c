"""9.4 `constant_velocity(dt, accel_psd)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, Symmetric
from robo47.estimation import constant_velocity

row = Row((Matrix((2, 2), called="F"), Symmetric((2, 2), called="Q")))


@row.inputs
def _(rng):
    dt, accel_psd = rng.numbers(0.2, 2, 6).tolist(), rng.numbers(0.5, 9, 6).tolist()
    return [(1.0, 3.0), *zip(dt, accel_psd, strict=True)]


def noise(a, b, c, accel_psd):
    """Return accel_psd [[a, b], [b, c]]."""
    return accel_psd * np.array([[a, b], [b, c]])


@row.wrongs
def _(dt, accel_psd):
    """F-without-dt: your code uses 1 instead of dt in F. Use dt, because the angle
      changes by dt times the velocity
    F-identity: your code uses the identity matrix as F. The upper right entry should be
      dt, because the angle changes by dt times the velocity
    Q-diagonal-only: your code uses a diagonal matrix as Q. The off-diagonal entries
      should be accel_psd dt^2 / 2, because a change in velocity during a time step also
      changes the angle
    Q-of-a-held-acceleration: your code uses the Q for an acceleration that is constant
      during a time step. Use dt^3 / 3, dt^2 / 2 and dt instead, because the
      acceleration is white noise
    Q-of-a-held-acceleration 2: your code uses the Q for an acceleration that is
      constant during a time step. Only the entry of the angle differs: use dt^3 / 3
      instead of dt^3 / 4, because the acceleration is white noise
    Q-is-q-1: your code uses accel_psd times the identity matrix as Q. Multiply
      accel_psd by [[dt^3 / 3, dt^2 / 2], [dt^2 / 2, dt]] instead
    Q-is-q-dt-1: your code uses accel_psd dt times the identity matrix as Q. Multiply
      accel_psd by [[dt^3 / 3, dt^2 / 2], [dt^2 / 2, dt]] instead, because the angle is
      the integral of the velocity
    Q-speed-only: your code fills only the entry of the velocity in Q. Fill the other
      three entries as well, because a change in velocity during a time step also
      changes the angle
    q-squared: your code squares accel_psd. Use accel_psd itself, because a power
      spectral density is already proportional to a variance
    off-diagonal-sign: your code negates the off-diagonal entries of Q. These entries
      should be positive, because an increase in velocity also increases the angle
    speed-first: your code swaps the entries of the angle and the velocity in Q. The
      angle should come first, because the state is (angle; velocity)
    """
    F, Q = constant_velocity(dt, accel_psd)
    a, b, c = dt**3 / 3, dt**2 / 2, dt
    Fs = {
        "F-without-dt": np.array([[1.0, 1.0], [0.0, 1.0]]),
        "F-identity": np.eye(2),
    }
    Qs = {
        "Q-diagonal-only": noise(a, 0.0, c, accel_psd),
        "Q-of-a-held-acceleration": noise(dt**4 / 4, dt**3 / 2, dt**2, accel_psd),
        "Q-of-a-held-acceleration 2": noise(dt**3 / 4, b, c, accel_psd),
        "Q-is-q-1": noise(1.0, 0.0, 1.0, accel_psd),
        "Q-is-q-dt-1": noise(c, 0.0, c, accel_psd),
        "Q-speed-only": noise(0.0, 0.0, c, accel_psd),
        "q-squared": accel_psd * Q,
        "off-diagonal-sign": noise(a, -b, c, accel_psd),
        "speed-first": noise(c, b, a, accel_psd),
    }
    return {s: (one, Q) for s, one in Fs.items()} | {
        s: (F, one) for s, one in Qs.items()
    }


@row.wrong(
    "answers-swapped",
    "your code returns Q before F. Return F first, then Q",
)
def _(dt, accel_psd):
    return constant_velocity(dt, accel_psd)[::-1]


@row.right  # Gauss quadrature, which is exact for a cubic.
def _(dt, accel_psd):
    nodes, weights = np.polynomial.legendre.leggauss(3)
    s = dt * (nodes + 1) / 2
    kick = np.array([s, np.ones(3)])
    return np.array([[1, dt], [0, 1]]), accel_psd * (dt / 2) * (weights * kick) @ kick.T


row.at_least_0(
    dt="a time", accel_psd="an intensity", answer="a sum of products of times"
)


row.spans(  # as small, or as large, as in the lab
    dt=(0.002,),
    accel_psd=(0.001,),
)
