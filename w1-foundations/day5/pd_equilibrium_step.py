"""5.4 `pd_equilibrium_step(q_goal, g_at_q, kp)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from labkit.judge.argument_mistakes import FIRST_FOR_ALL

from .joints import ANGLE, ONE, one_gain, seven, wrapped


def sags_of_one_gain(rng):
    """Return goals and gravity's torques where kp is one number."""
    goals = rng.configurations(2)
    gains = zip(goals, (100.0, 87.5), strict=True)
    return [(q, seven(rng, -40, 40), kp) for q, kp in gains]


row = Row(ANGLE, held_out=[one_gain(sags_of_one_gain, "kp is", "KP is")])
row.of_argument("kp", FIRST_FOR_ALL.called("one-gain-for-all"))


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
    """sags-upwards: the arm rests above its goal; a spring that has to give +g is
      stretched, so the joint stays below
    times-stiffness: gravity is multiplied by the stiffness: a stiffer spring would sag
      more
    goal-forgotten: this is how far the arm sags; asked is where it then is
    sag-only: this is how far the arm sags; asked is where it then is
    stiffness-forgotten: gravity's torque is taken for an angle; stiffness turns one
      into the other
    does-not-sag: the goal comes back as it is; a spring gives torque only where there
      is an error
    sag-in-degrees: the sag is in degrees, the goal in radians
    goal-scaled-too: the goal is divided by the stiffness as well
    always-below: gravity's sign is lost: where g is negative, the joint rests above its
      goal
    stiffness-squared: gravity's torque is divided by kp twice: compare the units
    answer-wrapped: the angle is taken to within +-pi; these joints have stops, so a
      whole turn is not the same as none, and joint6 goes beyond pi
    """
    return {
        "sags-upwards": q_goal + g_at_q / kp,
        "times-stiffness": q_goal - g_at_q * kp,
        "goal-forgotten": -g_at_q / kp,
        "sag-only": g_at_q / kp,
        "stiffness-forgotten": q_goal - g_at_q,
        "does-not-sag": q_goal.copy(),
        "sag-in-degrees": q_goal - np.rad2deg(g_at_q / kp),
        "goal-scaled-too": (q_goal - g_at_q) / kp,
        "always-below": q_goal - np.abs(g_at_q) / kp,
        "stiffness-squared": q_goal - g_at_q / kp**2,
        "answer-wrapped": wrapped(q_goal - g_at_q / kp),
    }


@row.right  # On one fraction bar.
def _(q_goal, g_at_q, kp):
    return (kp * q_goal - g_at_q) / kp


row.at_least_0(kp="a gain")
