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


NAMES = (
    "residual",
    "integral",
    "momentum",
    "tau",
    "energy_grad",
    "gravity",
    "damping",
    "qd",
)


@row.wrongs
def _(residual, integral, momentum, tau, energy_grad, gravity, damping, qd, gain, dt):
    """slope-sign: the slope is subtracted; it pushes the momentum along, as tau does
    slope-forgotten: the slope is missing: at rest it is 0, and nothing shows
    gravity-sign: gravity is added; `gravity` is what holds the arm, so the weight
      itself has a minus
    gravity-forgotten: gravity is missing
    tau-forgotten: tau is missing: then the motors count as somebody who pushes
    tau-sign: tau is subtracted
    damping-sign: damping is added; it brakes
    damping-forgotten: damping is missing
    damping-without-speed: damping is subtracted as it is; times qd it is a torque
    residual-not-fed-back: the residual is not fed back: a steady push is added up for
      ever
    residual-subtracted: the residual is subtracted from what is known; momentum moves
      by it, so it is added
    dt-forgotten: what is known is added without dt: a torque is no momentum
    residual-without-dt: the residual is added without dt
    sign-of-the-answer: the residual is integral - momentum: a push forwards then comes
      out backwards
    gain-forgotten: the gain is missing: momentum - integral is a momentum, not a torque
    gain-divided: it is divided by the gain
    gain-on-the-integral: the gain multiplies momentum only
    gain-times-dt: it is multiplied by dt as well
    integral-of-before: the residual is made with the integral of before: that is a
      sample late
    integral-not-kept: the integral begins anew at each step; what was known before is
      lost
    integral-not-handed-on: the integral that is returned is the old one
    integral-sign: what is known is taken off the integral; it is what moves momentum,
      so it is added
    damping-by-size: damping times the size of qd brakes; it is against the motion
    torques-without-dt: only the residual is multiplied by dt; all the torques are
    fed-back-times-gain: the gain multiplies the residual that is fed back, too; it is a
      torque already
    qd-for-damping: qd alone brakes; it is damping times qd
    low-passed-again: the residual is moved by gain (momentum - integral) dt; it is gain
      (momentum - integral) itself, and the integral does the rest
    residual-kept: the old residual is added to the new one
    residual-taken-off: the old residual is taken off the new one
    new-residual-fed-back: the residual that is fed back is made of momentum and the old
      integral; it is the one that is given
    p-added: momentum is added to the integral as well
    """
    brake = damping * qd
    known = tau + energy_grad - gravity - brake
    now = integral + (known + residual) * dt

    def of(changed):
        new = now + changed * dt
        return gain * (momentum - new), new

    def with_integral(new):
        return gain * (momentum - new), new

    return {
        "slope-sign": of(-2 * energy_grad),
        "slope-forgotten": of(-energy_grad),
        "gravity-sign": of(2 * gravity),
        "gravity-forgotten": of(gravity),
        "tau-forgotten": of(-tau),
        "tau-sign": of(-2 * tau),
        "damping-sign": of(2 * brake),
        "damping-forgotten": of(brake),
        "damping-without-speed": of(brake - damping),
        "residual-not-fed-back": of(-residual),
        "residual-subtracted": of(-2 * residual),
        "dt-forgotten": with_integral(integral + known + residual),
        "residual-without-dt": with_integral(integral + known * dt + residual),
        "sign-of-the-answer": (gain * (now - momentum), now),
        "gain-forgotten": (momentum - now, now),
        "gain-divided": ((momentum - now) / gain, now),
        "gain-on-the-integral": (gain * momentum - now, now),
        "gain-times-dt": (gain * (momentum - now) * dt, now),
        "integral-of-before": (gain * (momentum - integral), now),
        "integral-not-kept": with_integral((known + residual) * dt),
        "integral-not-handed-on": (gain * (momentum - now), integral.copy()),
        "integral-sign": with_integral(integral - (known + residual) * dt),
        "damping-by-size": of(brake - damping * np.abs(qd)),
        "torques-without-dt": with_integral(integral + known + residual * dt),
        "fed-back-times-gain": of((gain - 1) * residual),
        "qd-for-damping": of(brake - qd),
        "low-passed-again": (residual + gain * (momentum - now) * dt, now),
        "residual-taken-off": (gain * (momentum - now) - residual, now),
        "new-residual-fed-back": of(gain * (momentum - integral) - residual),
        "residual-kept": (residual + gain * (momentum - now), now),
        "p-added": with_integral(now + momentum),
    }


@row.wrong("answers-swapped", "the two answers are swapped: the residual comes first")
def _(residual, integral, momentum, tau, energy_grad, gravity, damping, qd, gain, dt):
    given = (
        residual,
        integral,
        momentum,
        tau,
        energy_grad,
        gravity,
        damping,
        qd,
        gain,
        dt,
    )
    return momentum_observer_step(*given)[::-1]


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
