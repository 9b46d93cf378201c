"""7.3 `joint_trajectory(q0, q1, t, duration)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from robo47.trajectory import joint_trajectory, quintic_scaling

from .quintic_scaling import times

JOINTS = tuple(f"joint{i}" for i in range(1, 8))

row = Row(Matrix((3, 7), rows=("q", "qd", "qdd"), columns=JOINTS))


@row.inputs
def _(rng):
    moments = times(rng, 6)
    q0, q1 = (rng.configurations(len(moments)) for _ in range(2))
    rows = [(a, b, *moment) for a, b, moment in zip(q0, q1, moments, strict=True)]
    # Beyond pi, which only joint6 reaches: a joint angle is not a direction.
    far = np.array([0.1, -0.4, 0.2, -1.8, 0.3, 3.7, 0.7])
    return [*rows[:6], (q0[0], far, 1.8, 2.0), (far, q1[0], 0.3, 2.0), *rows[6:]]


def wrapped(angles):
    """Return angles wrapped to [-pi, pi]."""
    return np.mod(angles + np.pi, 2 * np.pi) - np.pi


@row.wrongs
def _(q0, q1, t, T):
    """start-everywhere: your code also adds q0 to the velocity and the acceleration.
      Add q0 only to the position, because the derivatives of the constant q0 are 0
    goal-for-way: your code uses q1 as the displacement, so the motion ends at q0 + q1.
      Use q1 - q0 instead
    way-reversed: your displacement has the wrong sign, so the arm moves away from the
      goal. The displacement should be q1 - q0
    speed-forwards-only: in your result, every joint moves in the positive direction.
      Keep the sign of the displacement q1 - q0
    rates-without-way: your code returns sd and sdd as the velocity and the acceleration
      of every joint. Multiply both by the joint's displacement
    rates-of-the-goal: your velocity and acceleration are sd q1 and sdd q1. Multiply sd
      and sdd by the displacement q1 - q0 instead
    rates-divided-again: your velocity is divided by the duration once too often, and
      your acceleration by duration^2. The results sd and sdd of `quintic_scaling` are
      already derivatives with respect to t
    q-wrapped: your code wraps the angles to [-pi, pi]. Return the angles unchanged,
      because the angle of a joint with limits is not periodic. For example, joint6 can
      move to 3.75 rad
    way-wrapped: your code wraps the displacement to [-pi, pi]. Use the displacement
      unchanged, because a joint cannot rotate past its limits to take a shorter path
    """
    displacement = q1 - q0
    scaling = quintic_scaling(t, T)
    q, qd, qdd = joint_trajectory(q0, q1, t, T)
    _, sd, sdd = scaling
    alike = np.ones(7)
    start = q0 * [[1.0], [0.0], [0.0]]
    return {
        "start-everywhere": q0 + np.outer(scaling, displacement),
        "goal-for-way": start + np.outer(scaling, q1),
        "way-reversed": start - np.outer(scaling, displacement),
        "speed-forwards-only": start + np.outer(scaling, np.abs(displacement)),
        "rates-without-way": np.array([q, alike * sd, alike * sdd]),
        "rates-of-the-goal": np.array([q, q1 * sd, q1 * sdd]),
        "rates-divided-again": np.array([q, qd / T, qdd / T**2]),
        "q-wrapped": np.array([wrapped(q), qd, qdd]),
        "way-wrapped": start + np.outer(scaling, wrapped(displacement)),
    }


row.reached_by("quintic_scaling", "in the time scaling, ")


@row.right  # Three vectors in a tuple.
def _(q0, q1, t, T):
    s, sd, sdd = quintic_scaling(t, T)
    return (1 - s) * q0 + s * q1, (q1 - q0) * sd, (q1 - q0) * sdd


row.at_least_0(
    duration="a duration is not negative",
    t="before 0 the result is the one at 0",
)


row.spans(  # as small, or as large, as in the lab
    t=(0.007,),
)
