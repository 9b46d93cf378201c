"""7.3 `joint_trajectory(q0, q1, t, duration)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from robo47.trajectory import quintic_scaling

from .quintic_scaling import times

JOINTS = tuple(f"joint{i}" for i in range(1, 8))

row = Row(Matrix((3, 7), rows=("q", "qd", "qdd"), columns=JOINTS))


@row.inputs
def _(rng):
    moments = times(rng, 6)
    q0, q1 = (rng.configurations(len(moments)) for _ in range(2))
    rows = [(a, b, *moment) for a, b, moment in zip(q0, q1, moments, strict=True)]
    # Past pi, where only joint6 goes: a joint's angle is no direction.
    far = np.array([0.1, -0.4, 0.2, -1.8, 0.3, 3.7, 0.7])
    return [*rows[:6], (q0[0], far, 1.8, 2.0), (far, q1[0], 0.3, 2.0), *rows[6:]]


def wrapped(angles):
    """Return angles within half a turn of 0."""
    return np.mod(angles + np.pi, 2 * np.pi) - np.pi


@row.wrongs
def _(q0, q1, t, T):
    """start-everywhere: the start q0 is added to the speed and the acceleration too; it
      does not move => the answer with q0 in every row
    start-forgotten: the way is there, but not where it starts: q0 is missing
    goal-for-way: the goal q1 stands where the way from q0 to q1 belongs: it ends at q0
      + q1 => the answer with q1 for the way
    way-reversed: the way points from q1 to q0: it moves away from the goal
    backwards: it goes from q1 to q0 => the move the other way
    speed-forwards-only: the way has lost its sign: every joint goes forwards => the
      answer with |q1 - q0|
    rates-without-way: the speed and the acceleration are those of s; each joint's way
      is missing => the answer with sd and sdd for every joint
    rates-of-the-goal: in the speed and the acceleration, q1 stands where the way q1 -
      q0 belongs => the answer with q1 sd and q1 sdd
    rates-divided-again: the speed and the acceleration are divided by the duration
      again; sd and sdd are derivatives with respect to t already => the answer with sd
      / duration and sdd / duration^2
    q-wrapped: the angles are wrapped into +-pi; a joint's angle is no direction, and
      joint6 goes up to 3.75 rad => the answer with q wrapped
    way-wrapped: the way is wrapped into +-pi, the shorter way round; a joint cannot go
      through its ends => the answer with the way wrapped
    """
    way = q1 - q0
    scaling = quintic_scaling(t, T)
    s, sd, sdd = scaling
    alike = np.ones(7)
    q = q0 + way * s
    qd = way * sd
    qdd = way * sdd
    at_rest = q0 * [[1.0], [0.0], [0.0]]
    return {
        "start-everywhere": q0 + np.outer(scaling, way),
        "start-forgotten": np.outer(scaling, way),
        "goal-for-way": at_rest + np.outer(scaling, q1),
        "way-reversed": at_rest - np.outer(scaling, way),
        "backwards": np.array([q1 - way * s, -qd, -qdd]),
        "speed-forwards-only": at_rest + np.outer(scaling, np.abs(way)),
        "rates-without-way": np.array([q, alike * sd, alike * sdd]),
        "rates-of-the-goal": np.array([q, q1 * sd, q1 * sdd]),
        "rates-divided-again": np.array([q, qd / T, qdd / T**2]),
        "q-wrapped": np.array([wrapped(q), qd, qdd]),
        "way-wrapped": at_rest + np.outer(scaling, wrapped(way)),
    }


row.reached_by("quintic_scaling", "in the scaling, ")


@row.right  # Three vectors in a tuple.
def _(q0, q1, t, T):
    s, sd, sdd = quintic_scaling(t, T)
    return (1 - s) * q0 + s * q1, (q1 - q0) * sd, (q1 - q0) * sdd


row.at_least_0(
    duration="how long the move takes",
    t="before 0 it stands at its start, as at 0",
)


row.spans(  # as small, or as large, as in the lab
    t=(0.007,),
)
