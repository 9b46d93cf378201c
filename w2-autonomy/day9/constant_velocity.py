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
    """F-transposed: F has dt below the diagonal: then the angle changes the speed
    F-without-dt: F has 1 in the place of dt, which is right for samples of one second
    F-identity: F is the identity: the angle does not move with its speed
    F-backwards: F has -dt: it says where the angle was
    speed-lost: F has 0 for the speed's own entry: the speed is forgotten at each step
    Q-diagonal-only: Q has nothing off its diagonal: but the kick that changes the speed
      has moved the angle as well
    Q-of-a-held-acceleration: Q is that of an acceleration held over dt, (dt^4 / 4,
      dt^3 / 2; dt^2); white noise has dt^3 / 3, dt^2 / 2 and dt
    Q-is-q-1: Q is accel_psd times the identity; it is not for one second, and the angle
      is less unsure than the speed
    Q-is-q-dt-1: Q is accel_psd dt times the identity: nothing kicks the angle itself
    Q-speed-only: Q has only the speed's entry, accel_psd dt: over dt a kick moves the
      angle, too
    q-squared: accel_psd is squared; it is an intensity, a variance per second, already
    q-forgotten: Q has no accel_psd: that is the noise of intensity 1
    not-a-third: the angle's entry is dt^3; the sum of (dt - s)^2 is a third of that
    a-half-for-a-third: the angle's entry is dt^3 / 2; the sum of (dt - s)^2 is a third
    off-diagonal-not-halved: off the diagonal stands dt^2; the sum of dt - s is half of
      it
    off-diagonal-sign: off the diagonal stands -dt^2 / 2: a kick forwards moves the
      angle forwards
    speed-first: Q has the speed first; x is (angle; speed)
    sigma-for-variance: the entries of Q are rooted; Q is a covariance
    """
    F, Q = constant_velocity(dt, accel_psd)
    a, b, c = dt**3 / 3, dt**2 / 2, dt
    Fs = {
        "F-transposed": F.T,
        "F-without-dt": np.array([[1.0, 1.0], [0.0, 1.0]]),
        "F-identity": np.eye(2),
        "F-backwards": np.array([[1.0, -dt], [0.0, 1.0]]),
        "speed-lost": np.array([[1.0, dt], [0.0, 0.0]]),
    }
    Qs = {
        "Q-diagonal-only": noise(a, 0.0, c, accel_psd),
        "Q-of-a-held-acceleration": noise(dt**4 / 4, dt**3 / 2, dt**2, accel_psd),
        "Q-is-q-1": noise(1.0, 0.0, 1.0, accel_psd),
        "Q-is-q-dt-1": noise(c, 0.0, c, accel_psd),
        "Q-speed-only": noise(0.0, 0.0, c, accel_psd),
        "q-squared": accel_psd * Q,
        "q-forgotten": Q / accel_psd,
        "not-a-third": noise(3 * a, b, c, accel_psd),
        "a-half-for-a-third": noise(1.5 * a, b, c, accel_psd),
        "off-diagonal-not-halved": noise(a, 2 * b, c, accel_psd),
        "off-diagonal-sign": noise(a, -b, c, accel_psd),
        "speed-first": noise(c, b, a, accel_psd),
        "sigma-for-variance": np.sqrt(Q),
    }
    return {s: (one, Q) for s, one in Fs.items()} | {
        s: (F, one) for s, one in Qs.items()
    }


@row.wrong("answers-swapped", "the two answers are swapped: F comes first, then Q")
def _(dt, accel_psd):
    return constant_velocity(dt, accel_psd)[::-1]


@row.right  # The sum over a thousand short steps, which is exact for a cubic by Gauss.
def _(dt, accel_psd):
    nodes, weights = np.polynomial.legendre.leggauss(3)
    s = dt * (nodes + 1) / 2
    kick = np.array([s, np.ones(3)])
    return np.array([[1, dt], [0, 1]]), accel_psd * (dt / 2) * (weights * kick) @ kick.T


row.at_least_0(dt="a time", accel_psd="an intensity", answer="made of times")


row.spans(  # as small, or as large, as in the lab
    dt=(0.002,),
    accel_psd=(0.001,),
)
