"""What Day 6's functions are asked, and what a right answer is.

The truth comes from `robo47.task_space` (tested against MuJoCo and by physics), never
from the lab script. Arrays and floats only: J and M are the Panda's, rounded, at
configurations away from singularities.
"""

from functools import cache

import numpy as np

from labkit.judge import Ask, Scalar, Symmetric, Twist, Vector, Wrench, draw
from robo47 import panda, task_space

from .mistakes.accelerations import SITE_BIAS
from .mistakes.impedance import IMPEDANCE_TORQUE
from .mistakes.inertias import TASK_INERTIA
from .mistakes.pushes import HYBRID_WRENCH, SET_POINT
from .mistakes.springs import CRITICAL_DAMPING, SPRING_WRENCH
from .mistakes.torques import NULL_TORQUE, OSC_TORQUE

NEAR = 1e-5  # further off is wrong, not only rounded
SIGMA = 0.1  # least singular value of J: nearer to a singularity digits are lost
COUNT = 9  # drawn calls of each function, after the docstring's case
JOINTS = tuple(f"joint{i}" for i in range(1, 8))
TORQUE = Vector((7,), "Nm", scale=10.0, names=JOINTS)
WRENCH = Wrench(scale=10.0)
J_CASE, M_CASE = np.eye(6, 7), np.eye(7)


class Acceleration(Twist):
    """Of the hand: angular, then linear."""

    halves = ("the angular half", "the linear half")


@cache
def _arm():
    return panda.arm(panda.load("panda_nohand"))


def _states(rng):
    """Return COUNT configurations of the Panda, each worked out by `robo47.arm`."""
    found = []
    while len(found) < COUNT:
        now = _arm().at(draw.configurations(rng, 1)[0])
        if np.linalg.svd(now.J_site, compute_uv=False)[-1] > SIGMA:
            found.append(now)
    return found


def _model(now):
    """Return J and M, rounded, and their Lambda: all three must fit together."""
    J, M = draw.rounded(now.J_site), draw.rounded(now.M)
    return J, M, task_space.task_inertia(J, M)


def _some(rng, reach, *shape):
    return draw.numbers(rng, -reach, reach, *shape)


def _task_inertia(rng):
    drawn = [_model(now)[:2] for now in _states(rng)]
    return [(J_CASE, 2.0 * M_CASE), *drawn]


def _site_bias(rng):
    spin = np.zeros((6, 7))
    spin[2, 0] = 1.0
    case = (spin, np.eye(7)[0], np.array([1.0, 0.0, 0.0]))
    drawn = [
        (now.J_space.copy(), _some(rng, 2, 7), _some(rng, 1, 3))  # screws, so as it is
        for now in _states(rng)
    ]
    return [case, *drawn]


def _osc_torque(rng):
    case = (J_CASE, np.eye(6), np.arange(7.0), np.ones(6), np.ones(6))
    drawn = []
    for now in _states(rng):
        J, _, Lambda = _model(now)
        drawn.append((J, Lambda, _some(rng, 20, 7), _some(rng, 2, 6), _some(rng, 3, 6)))
    J, Lambda, bias, drift, acc = drawn[0]
    asked = [
        (J, Lambda, bias, drift, np.zeros(6)),
        (J, Lambda, bias, drift, 30.0 * acc),  # more than the motors have
    ]
    return [case, *asked, *drawn]


def _null_torque(rng):
    case = (J_CASE, M_CASE, np.eye(6), np.ones(7))
    return [case, *((*_model(now), _some(rng, 10, 7)) for now in _states(rng))]


def _springs(rng):
    """Return errors, twists, stiffness and damping."""
    e, K = np.zeros(6), np.diag([30.0, 30.0, 30.0, 400.0, 400.0, 400.0])
    case = (np.array([0, 0, 0, 0, 0, 0.025]), np.zeros(6), K, np.eye(6))
    drawn = []
    for now in _states(rng):
        D = draw.rounded(task_space.critical_damping(np.diag(K), _model(now)[2]))
        e = np.append(_some(rng, 0.5, 3), _some(rng, 0.05, 3))
        stiffness = np.diag(draw.numbers(rng, 10, 500, 6))
        drawn.append((e, _some(rng, 0.5, 6), stiffness, D))
    e, V_err, K, D = drawn[0]
    near, far = (0.001 * e, 0.001 * V_err, K, D), (10.0 * e, V_err, K, D)
    return [case, near, far, *drawn]


def _damping(rng):
    drawn = [(draw.numbers(rng, 10, 500, 6), _model(now)[2]) for now in _states(rng)]
    K, Lambda = drawn[0]
    light, stiff = (K, 0.004 * Lambda), (20.0 * K, Lambda)
    return [(np.full(6, 4.0), np.eye(6)), light, stiff, *drawn]


def _impedance(rng):
    rest = np.zeros(7)
    case = (J_CASE, np.zeros(6), np.arange(7.0), np.ones(7), rest, rest)
    drawn = [
        (
            _model(now)[0],
            _some(rng, 20, 6),
            _some(rng, 20, 7),
            draw.numbers(rng, 0.5, 2, 7),
            _some(rng, 2, 7),
            _some(rng, 5, 7),
        )
        for now in _states(rng)
    ]
    J, F, bias, damping, qd, idle = drawn[0]
    parts = [
        (J, np.zeros(6), bias, damping, qd, idle),
        (J, F, bias, damping, rest, idle),
        (J, F, bias, damping, qd, rest),
    ]
    return [case, *parts, *drawn]


def _set_point(rng):
    drawn = zip(
        draw.numbers(rng, 5, 60, COUNT),
        draw.numbers(rng, 200, 2000, COUNT),
        draw.numbers(rng, 0.1, 0.8, COUNT),
        strict=True,
    )
    # A deep one, and a hand that hangs from a ceiling and pulls it down.
    asked = [(20.0, 400.0, 0.42), (60.0, 50.0, 0.3), (-8.0, 300.0, -0.2)]
    return [*asked, *(tuple(map(float, one)) for one in drawn)]


def _hybrid(rng):
    _, _, K, D = _springs(rng)[0]
    case = (np.zeros(6), np.zeros(6), K, D, 10.0)
    forces = draw.numbers(rng, 5, 40, COUNT)
    springs = _springs(rng)[-COUNT:]
    asked = [(*springs[0], 0.0), (*springs[1], -12.0)]
    drawn = zip(springs, forces, strict=True)
    return [case, *asked, *((*spring, float(force)) for spring, force in drawn)]


def _plain(inputs, kind, truth, mistakes) -> Ask:
    return Ask(inputs, kind, truth=truth, mistakes=mistakes, near=NEAR)


LAMBDA = Symmetric((6, 6))
DAMPING = Symmetric((6, 6), scale=10.0)
TWIN = task_space
QUESTIONS = {
    "task_inertia": _plain(_task_inertia, LAMBDA, TWIN.task_inertia, TASK_INERTIA),
    "site_bias": _plain(_site_bias, Acceleration(), TWIN.site_bias, SITE_BIAS),
    "osc_torque": _plain(_osc_torque, TORQUE, TWIN.osc_torque, OSC_TORQUE),
    "null_torque": _plain(_null_torque, TORQUE, TWIN.null_torque, NULL_TORQUE),
    "spring_wrench": _plain(_springs, WRENCH, TWIN.spring_wrench, SPRING_WRENCH),
    "critical_damping": _plain(
        _damping, DAMPING, TWIN.critical_damping, CRITICAL_DAMPING
    ),
    "impedance_torque": _plain(
        _impedance, TORQUE, TWIN.impedance_torque, IMPEDANCE_TORQUE
    ),
    "set_point_for_force": _plain(
        _set_point, Scalar(unit="m"), TWIN.set_point_for_force, SET_POINT
    ),
    "hybrid_wrench": _plain(_hybrid, WRENCH, TWIN.hybrid_wrench, HYBRID_WRENCH),
}

# One matrix with two readings: J^T pinv(J^T) is J^+ J.
ALIKE = {"null_torque": [{"pinv-of-transpose", "kinematic-projector"}]}
