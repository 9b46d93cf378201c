"""What Day 5's functions are asked, and what a right answer is.

The truth comes from `robo47.control`, never from the lab script. The states are those
of a Panda in motion: M and bias are MuJoCo's, rounded, so that they can be typed.
"""

import numpy as np

from robo47 import control, panda, verify
from robo47.diagnose import Ask, Scalar, Vector, draw
from robo47.diagnose.mistake import each

from .mistakes import motors, pid, response, springs, torque

JOINTS = tuple(f"joint{i}" for i in range(1, 8))
TORQUE = Vector((7,), "Nm", scale=10.0, names=JOINTS)
TIMES = np.array([0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5])
LIMITS = np.array([87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0])
ONE = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])


def _seven(rng, low, high):
    return draw.numbers(rng, low, high, 7)


def _errors(rng):
    return _seven(rng, -0.3, 0.3), _seven(rng, -2, 2)


def _pd(rng):
    case = 0.1 * ONE, 0.0 * ONE, np.full(7, 100.0), np.full(7, 20.0)
    return [case, *(_drawn_pd(rng) for _ in range(9))]


def _drawn_pd(rng):
    return (*_errors(rng), _seven(rng, 50, 600), _seven(rng, 5, 50))


def _gains(rng):
    drawn = zip(draw.numbers(rng, 3, 60, 9), draw.numbers(rng, 0.2, 2, 9), strict=True)
    return [(20.0, 1.0), *((float(w), float(z)) for w, z in drawn)]


def _responses(rng):
    """Critical, under and over, in turn; the last two are drawn anew at each check."""
    zetas = [1.0, *draw.numbers(rng, 0.1, 0.9, 4), 1.0, *draw.numbers(rng, 1.1, 3, 4)]
    omegas = [10.0, *draw.numbers(rng, 4, 30, 9)]
    return [(TIMES, float(w), float(z)) for w, z in zip(omegas, zetas, strict=True)]


def _sags(rng):
    case = np.zeros(7), 10.0 * ONE, np.full(7, 100.0)
    goals = draw.configurations(rng, 9)
    return [case, *((q, _seven(rng, -40, 40), _seven(rng, 50, 600)) for q in goals)]


def _gravity(rng):
    return [(*case, _seven(rng, -40, 40)) for case in _pd(rng)]


def _states(rng):
    """Return states of a moving Panda; in the first it rests on its goal."""
    model = panda.load("panda_nohand")
    q = draw.configurations(rng, 10)
    qd = draw.numbers(rng, -2, 2, 10, 7)
    qd[0] = 0.0
    M = draw.rounded(verify.mujoco_mass_matrix(model, q))
    bias = draw.rounded(verify.mujoco_bias(model, q, qd))
    calls = []
    for i in range(10):
        wanted = (*_errors(rng), _seven(rng, -5, 5)) if i else (0.0 * ONE,) * 3
        omega = float(draw.numbers(rng, 5, 40))
        friction = _seven(rng, 0.5, 1.5)
        calls.append((M[i], bias[i], friction, qd[i], *wanted, omega**2, 1.8 * omega))
    return calls


def _integrals(rng):
    """Some integrals stay inside the clamp, some run into it, on both sides."""
    case = (ONE, 0.0 * ONE, 0.0 * ONE, 400.0, 40.0, 4000.0, 0.1, 1.0)
    calls = [case]
    for clamp in (0.05, 10.0, 0.2, 0.1, 10.0, 0.15, 0.02, 10.0, 0.1):
        kp, kd, ki = (float(x) for x in draw.numbers(rng, 1, 9, 3))
        dt = float(draw.numbers(rng, 0.002, 0.02))
        before = np.clip(_seven(rng, -0.2, 0.2), -clamp, clamp)
        calls.append((*_errors(rng), before, 50 * kp, 5 * kd, 500 * ki, dt, clamp))
    return calls


def _torques(rng):
    case = 100.0 * ONE, LIMITS
    rest = [(_seven(rng, -120, 120), LIMITS) for _ in range(5)]
    other = [(_seven(rng, -60, 60), _seven(rng, 10, 60)) for _ in range(4)]
    return [case, *rest, *other]


def _steps(rng):
    return [
        (float(h),) for h in (0.002, 0.001, 0.004, *draw.numbers(rng, 0.002, 0.05, 5))
    ]


def _servos(rng):
    kp = np.array([4500.0, 4500.0, 3500.0, 3500.0, 2000.0, 2000.0, 2000.0])
    calls = [(0.0 * ONE, draw.READY, 0.0 * ONE, kp, kp / 10)]
    for q in draw.configurations(rng, 9):
        tau, qd = _seven(rng, -40, 40), _seven(rng, -2, 2)
        calls.append((tau, q, qd, _seven(rng, 500, 4500), _seven(rng, 50, 450)))
    return calls


def _response(t, omega, zeta):
    return control.error_response(t, omega[:, None], zeta[:, None])


QUESTIONS = {
    "pd_torque": Ask(
        _pd, TORQUE, truth=control.pd_torque, mistakes=springs.PD, near=1e-5
    ),
    "gains": Ask(
        _gains,
        Vector((2,), scale=100.0, names=("kp", "kd")),
        truth=control.gains,
        mistakes=springs.GAINS,
        near=1e-5,
    ),
    "error_response": Ask(
        _responses,
        Vector((len(TIMES),)),
        truth=_response,
        mistakes=response.RESPONSE,
        unnamed=response.which_case,
        near=1e-5,
    ),
    "sag_step": Ask(
        _sags,
        Vector((7,), "rad", names=JOINTS),
        truth=control.sag_step,
        mistakes=springs.SAG,
        near=1e-5,
    ),
    "gravity_pd": Ask(
        _gravity,
        TORQUE,
        truth=control.gravity_pd,
        mistakes=springs.GRAVITY,
        near=1e-5,
    ),
    "computed_torque": Ask(
        _states,
        TORQUE,
        truth=each(control.computed_torque),
        mistakes=torque.TORQUE,
        near=1e-5,
    ),
    "pid_step": Ask(
        _integrals,
        (
            Vector(
                (7,), "rad/s2", scale=100.0, names=JOINTS, called="the acceleration"
            ),
            Vector((7,), "rad s", scale=0.1, names=JOINTS, called="the integral"),
        ),
        truth=each(control.pid_step),
        mistakes=pid.PID,
        near=1e-5,
    ),
    "saturate": Ask(
        _torques, TORQUE, truth=control.saturate, mistakes=motors.SATURATE, near=1e-5
    ),
    "fastest": Ask(
        _steps,
        Scalar(unit="rad/s", scale=100.0),
        truth=control.fastest,
        mistakes=motors.FASTEST,
        near=1e-5,
    ),
    "servo_ctrl": Ask(
        _servos,
        Vector((7,), "rad", names=JOINTS),
        truth=control.servo_ctrl,
        mistakes=motors.SERVO,
        near=1e-5,
    ),
}
