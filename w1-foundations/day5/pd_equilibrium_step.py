"""5.4 `pd_equilibrium_step(q_goal, g_at_q, kp)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row

from .joints import ANGLE, ONE, one_gain, seven, wrapped


def sags_of_one_gain(rng):
    """Return goals and gravity's torques where kp is one number."""
    goals = rng.configurations(2)
    gains = zip(goals, (100.0, 87.5), strict=True)
    return [(q, seven(rng, -40, 40), kp) for q, kp in gains]


ONE_NUMBER = "kp is a single number, such as the lab's KP"
row = Row(ANGLE, held_out=[one_gain(sags_of_one_gain, "kp has 7 entries", ONE_NUMBER)])


@row.inputs
def _(rng):
    yield np.zeros(7), 10.0 * ONE, np.full(7, 100.0)
    goals = rng.configurations(9)
    far = goals[0] + 0.0
    far[5] = 3.5  # joint6 can go to 3.75
    soft = np.array([-9.0, 36.0, 4.0, -30.0, 2.0, -3.0, 1.0])  # one sags by over 0.5
    yield far, soft, np.full(7, 50.0)
    for q in goals:
        yield q, seven(rng, -40, 40), seven(rng, 50, 600)


@row.wrongs
def _(q_goal, g_at_q, kp):
    """sag-in-degrees: your code converts the steady-state error to degrees. Use
      radians, because the goal is in radians
    answer-wrapped: your code wraps the angle to [-pi, pi]. Return the angle unchanged,
      because q and q + 2 pi are different configurations of a joint with limits
    """
    return {
        "sag-in-degrees": q_goal - np.rad2deg(g_at_q / kp),
        "answer-wrapped": wrapped(q_goal - g_at_q / kp),
    }


@row.right  # On one fraction bar.
def _(q_goal, g_at_q, kp):
    return (kp * q_goal - g_at_q) / kp


row.at_least_0(kp="a gain")
