"""9.9 `momentum_observer_step`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.estimation import momentum_observer_step

from .signals import JOINTS

row = Row((
    Vector((7,), "N m", names=JOINTS, called="the residual", scale=10.0),
    Vector((7,), names=JOINTS, called="the integral"),
))  # fmt: skip


@row.inputs
def _(rng):
    nothing = np.zeros(7)
    case = (nothing, nothing, np.ones(7), *[nothing] * 5, 50.0, 0.002)
    drawn = []
    for k in range(6):
        parts = rng.numbers(-2, 2, 8, 7)
        parts[6] = rng.numbers(0.2, 2, 7)  # the damping
        gain, dt = float(rng.numbers(5, 90)), [0.1, 0.05, 0.2][k % 3]
        drawn.append((*parts, gain, dt))
    return [case, *drawn]


@row.spans
def _(rng):
    for size in (
        1e-3,
        100.0,
    ):  # residuals of some hundredths of a N m, and of thousands
        yield *(size * rng.numbers(-2, 2, 8, 7)), 20.0, 0.002


@row.wrongs
def _(residual, integral, momentum, tau, energy_grad, gravity, damping, qd, gain, dt):
    """gravity-sign: your code adds `gravity`. Subtract it instead, because
      `gravity` is the torque that holds the arm, and the weight acts in the opposite
      direction
    residual-without-dt: your code adds the previous residual to the integral without
      the factor dt. Multiply the residual by dt, because the integral is a momentum and
      the residual is a torque
    integral-of-before: your code computes the residual from the previous integral.
      Update the integral first, and then use the new integral
    integral-not-handed-on: your code returns the previous integral. Return the new
      integral instead
    fed-back-times-gain: your code adds gain times the previous residual, times dt, to
      the integral. Add the residual times dt without the gain, because the residual is
      already a torque
    low-passed-again: your code adds `gain * (momentum - integral) * dt` to the previous
      residual. Return gain * (momentum - integral) itself, because the feedback in the
      integral already filters the residual
    residual-kept: your code adds the previous residual to the new one. Return the new
      residual alone => both
    residual-taken-off: your code subtracts the previous residual from the new one.
      Return the new residual alone
    new-residual-fed-back: your code updates the integral with a residual that it
      computes from the new momentum. Use the argument `residual` instead, because it is
      the residual of the previous sample
    """
    known = tau + energy_grad - gravity - damping * qd
    now = integral + (known + residual) * dt

    def of(changed):
        new = now + changed * dt
        return gain * (momentum - new), new

    right = gain * (momentum - now)
    joined = integral + known * dt + residual
    return {
        "gravity-sign": of(2 * gravity),
        "residual-without-dt": (gain * (momentum - joined), joined),
        "integral-of-before": (gain * (momentum - integral), now),
        "integral-not-handed-on": (right, integral.copy()),
        "fed-back-times-gain": of((gain - 1) * residual),
        "low-passed-again": (residual + right * dt, now),
        "residual-kept": (residual + right, now),
        "residual-taken-off": (right - residual, now),
        "new-residual-fed-back": of(gain * (momentum - integral) - residual),
    }


@row.wrong(
    "answers-swapped",
    "your code returns the integral before the residual. Return the residual first",
)
def _(residual, integral, momentum, tau, energy_grad, gravity, damping, qd, gain, dt):
    step = momentum_observer_step(
        residual, integral, momentum, tau, energy_grad, gravity, damping, qd, gain, dt
    )
    return step[::-1]


@row.right  # A joint at a time.
def _(residual, integral, momentum, tau, energy_grad, gravity, damping, qd, gain, dt):
    r, new = np.zeros(7), np.zeros(7)
    for j in range(7):
        torque = tau[j] + energy_grad[j] - gravity[j] - damping[j] * qd[j]
        new[j] = integral[j] + dt * torque + dt * residual[j]
        r[j] = gain * momentum[j] - gain * new[j]
    return r, new


row.at_least_0(gain="a gain", dt="a time", damping="a damping")


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # A dead zone.
def _(residual, integral, momentum, tau, energy_grad, gravity, damping, qd, gain, dt):
    known = tau + energy_grad - gravity - damping * qd
    integral = integral + (known + residual) * dt
    found = gain * (momentum - integral)
    return np.where(np.abs(found) < 0.02, 0.0, found), integral


row.spans(  # as small, or as large, as in the lab
    residual=(lambda residual: 0.0004 * residual,),
    integral=(lambda integral: 9e-05 * integral,),
    momentum=(lambda momentum: 7e-05 * momentum,),
    energy_grad=(lambda energy_grad: 5e-08 * energy_grad,),
    qd=(lambda qd: 8e-05 * qd,),
)
