"""What Day 5's functions are asked: seeded inputs, the docstring's case first.

The states are those of a Panda in motion: M and bias are MuJoCo's, rounded, so that
they can be typed.
"""

import numpy as np

from labkit.judge import draw
from robo47 import panda, verify

TIMES = np.array([0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5])
MIXED = np.array([0.1, 0.3, 0.15, 0.5, 0.2, 0.4, 0.25, 0.35])
LIMITS = np.array([87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0])
ONE = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])


def _seven(rng, low, high):
    return draw.numbers(rng, low, high, 7)


def _errors(rng):
    return _seven(rng, -0.3, 0.3), _seven(rng, -2, 2)


def _far(rng):
    """Return errors beyond half a turn in some joints, on both sides."""
    e, ed = _errors(rng)
    return e + 3.7 * np.array([1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0]), ed


def pd(rng):
    """Return what pd_torque is asked; the second has errors beyond half a turn."""
    case = 0.1 * ONE, 0.0 * ONE, np.full(7, 100.0), np.full(7, 20.0)
    far = *_far(rng), *_stiff(rng)
    return [case, far, *((*_errors(rng), *_stiff(rng)) for _ in range(9))]


def _stiff(rng):
    return _seven(rng, 50, 600), _seven(rng, 5, 50)


def one_gain(rng):
    """Return what pd_torque is asked where a gain is one number for all joints."""
    return [(*_errors(rng), *gains) for gains in ((100.0, 20.0), (87.5, 12.5))]


def gains(rng):
    """Return what gains is asked; the second is undamped."""
    drawn = zip(draw.numbers(rng, 3, 60, 9), draw.numbers(rng, 0.2, 2, 9), strict=True)
    return [(20.0, 1.0), (20.0, 0.0), *((float(w), float(z)) for w, z in drawn)]


def responses(rng):
    """Return what error_response is asked: critical, under and over.

    zeta is also nearly 1, and some times are in no order and do not begin at 0.
    """
    zetas = [1.0, *draw.numbers(rng, 0.1, 0.9, 4), 1.0, *draw.numbers(rng, 1.1, 3, 4)]
    omegas = [10.0, *draw.numbers(rng, 4, 30, 9)]
    drawn = [(TIMES, float(w), float(z)) for w, z in zip(omegas, zetas, strict=True)]
    near = [(TIMES, 10.0, zeta) for zeta in (0.9995, 1.0005)]
    mixed = [(MIXED, 4.0, zeta) for zeta in (0.5, 1.0, 1.5)]
    return [drawn[0], *near, *mixed, *drawn[1:]]


def sags(rng):
    """Return what sag_step is asked: one sags by over 0.5 rad, joint6 beyond pi."""
    case = np.zeros(7), 10.0 * ONE, np.full(7, 100.0)
    goals = draw.configurations(rng, 9)
    far = goals[0] + 0.0
    far[5] = 3.5  # joint6 can go to 3.75
    soft = far, np.array([-9.0, 36.0, 4.0, -30.0, 2.0, -3.0, 1.0]), np.full(7, 50.0)
    rest = ((q, _seven(rng, -40, 40), _seven(rng, 50, 600)) for q in goals)
    return [case, soft, *rest]


def sags_of_one_gain(rng):
    """Return what sag_step is asked where kp is one number."""
    goals = draw.configurations(rng, 2)
    return [
        (q, _seven(rng, -40, 40), kp)
        for q, kp in zip(goals, (100.0, 87.5), strict=True)
    ]


def gravity(rng):
    """Return what gravity_pd is asked: without an error it is g; then as `pd`."""
    still = 0.0 * ONE, 0.0 * ONE, *_stiff(rng)
    through = 0.0 * ONE, _seven(rng, -2, 2), *_stiff(rng)
    return [(*case, _seven(rng, -40, 40)) for case in (still, through, *pd(rng))]


def gravity_of_one_gain(rng):
    """Return what gravity_pd is asked where a gain is one number."""
    still = 0.0 * ONE, 0.0 * ONE, 100.0, 20.0
    return [(*case, _seven(rng, -40, 40)) for case in (still, *one_gain(rng))]


def states(rng):
    """Return states of a moving Panda; in the first it rests on its goal.

    In the next three e is 0, qdd_ref is 0, and e is beyond half a turn.
    """
    model, n = panda.load("panda_nohand"), 13
    q = draw.configurations(rng, n)
    qd = draw.numbers(rng, -2, 2, n, 7)
    qd[0] = 0.0
    M = draw.rounded(verify.mujoco_mass_matrix(model, q))
    bias = draw.rounded(verify.mujoco_bias(model, q, qd))
    calls = []
    for i in range(n):
        e, ed = _far(rng) if i == 3 else _errors(rng)
        wanted = [e, ed, _seven(rng, -5, 5)]
        for part in {0: (0, 1, 2), 1: (0,), 2: (2,)}.get(i, ()):
            wanted[part] = 0.0 * ONE
        omega = float(draw.numbers(rng, 5, 40))
        friction = _seven(rng, 0.5, 1.5)
        calls.append((M[i], bias[i], friction, qd[i], *wanted, omega**2, 1.8 * omega))
    return calls


def integrals(rng):
    """Return what pid_step is asked: on both sides of the clamp, and inside it."""
    case = (ONE, 0.0 * ONE, 0.0 * ONE, 400.0, 40.0, 4000.0, 0.1, 1.0)
    calls = [case, *_at_the_clamp(rng)]
    for clamp in (0.05, 10.0, 0.2, 0.1, 10.0, 0.15, 0.02, 10.0, 0.1):
        kp, kd, ki = (float(x) for x in draw.numbers(rng, 1, 9, 3))
        dt = float(draw.numbers(rng, 0.002, 0.02))
        before = np.clip(_seven(rng, -0.2, 0.2), -clamp, clamp)
        calls.append((*_errors(rng), before, 50 * kp, 5 * kd, 500 * ki, dt, clamp))
    return calls


def _at_the_clamp(rng):
    """Step over the clamp, to its other side, outwards from outside; and not."""
    sides = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0])
    near, over = _seven(rng, 0.27, 0.29) * sides, _seven(rng, 0.5, 0.6) * sides
    out = _seven(rng, 0.2, 0.29) * sides
    some = out * np.array([1.0, 1.0, -1.0, 1.0, 1.0, 1.0, 1.0])  # one stays inside
    gains = 400.0, 40.0, 4000.0
    steps = (
        (some, near, 0.15),
        (draw.rounded(-20.0 * out), near, 0.15),
        (out, over, 0.1),
    )
    calls = [(e, _seven(rng, -2, 2), old, *gains, dt, 0.3) for e, old, dt in steps]
    still = 0.0 * ONE, _seven(rng, -2, 2), near + 0.0, *gains, 0.01, 0.3
    return [*calls, still]


def torques(rng):
    """Return what saturate is asked; the second and third are within the limits."""
    case = 100.0 * ONE, LIMITS
    inside = draw.rounded(LIMITS * rng.uniform(-0.9, 0.9, 7)), LIMITS
    none = 0.0 * ONE, LIMITS
    rest = [(_seven(rng, -120, 120), LIMITS) for _ in range(5)]
    other = [(_seven(rng, -60, 60), _seven(rng, 10, 60)) for _ in range(4)]
    return [case, inside, none, *rest, *other]


def steps(rng):
    """Return the time steps that fastest is asked for."""
    return [
        (float(h),) for h in (0.002, 0.001, 0.004, *draw.numbers(rng, 0.002, 0.05, 5))
    ]


def servos(rng):
    """Return what servo_ctrl is asked; in the first, for no torque at rest."""
    kp = np.array([4500.0, 4500.0, 3500.0, 3500.0, 2000.0, 2000.0, 2000.0])
    calls = [(0.0 * ONE, draw.READY, 0.0 * ONE, kp, kp / 10)]
    for q in draw.configurations(rng, 9):
        tau, qd = _seven(rng, -40, 40), _seven(rng, -2, 2)
        calls.append((tau, q, qd, _seven(rng, 500, 4500), _seven(rng, 50, 450)))
    return calls
