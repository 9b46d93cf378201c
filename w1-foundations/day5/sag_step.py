"""5.4 `sag_step(q_goal, g_at_q, kp)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import draw
from labkit.judge.row import Row

from .joints import ANGLE, ONE, one_gain, seven, wrapped


def sags_of_one_gain(rng):
    """Return goals and gravity's torques where kp is one number."""
    goals = draw.configurations(rng, 2)
    gains = zip(goals, (100.0, 87.5), strict=True)
    return [(q, seven(rng, -40, 40), kp) for q, kp in gains]


row = Row(ANGLE, held_out=[one_gain(sags_of_one_gain, "kp is", "KP is")])


@row.inputs
def _(rng):
    yield np.zeros(7), 10.0 * ONE, np.full(7, 100.0)
    goals = draw.configurations(rng, 9)
    far = goals[0] + 0.0
    far[5] = 3.5  # joint6 can go to 3.75
    soft = np.array([-9.0, 36.0, 4.0, -30.0, 2.0, -3.0, 1.0])  # one sags by over 0.5
    yield far, soft, np.full(7, 50.0)
    for q in goals:
        yield q, seven(rng, -40, 40), seven(rng, 50, 600)


@row.wrong
def sags_upwards(q_goal, g_at_q, kp):
    """the arm rests above its goal; a spring that has to give +g is stretched, so the
    joint stays below"""
    return q_goal + g_at_q / kp


@row.wrong
def times_stiffness(q_goal, g_at_q, kp):
    """gravity is multiplied by the stiffness: a stiffer spring would sag more"""
    return q_goal - g_at_q * kp


@row.wrong
def goal_forgotten(q_goal, g_at_q, kp):
    """this is how far the arm sags; asked is where it then is"""
    return -g_at_q / kp


@row.wrong
def sag_only(q_goal, g_at_q, kp):
    """this is how far the arm sags; asked is where it then is"""
    return g_at_q / kp


@row.wrong
def stiffness_forgotten(q_goal, g_at_q, kp):
    """gravity's torque is taken for an angle; stiffness turns one into the other"""
    return q_goal - g_at_q


@row.wrong
def one_gain_for_all(q_goal, g_at_q, kp):
    """all joints get the first joint's stiffness; each has its own here"""
    return q_goal - g_at_q / kp[0]


@row.wrong
def does_not_sag(q_goal, g_at_q, kp):
    """the goal comes back as it is; a spring gives torque only where there is an
    error"""
    return q_goal.copy()


@row.wrong
def sag_in_degrees(q_goal, g_at_q, kp):
    """the sag is in degrees, the goal in radians"""
    return q_goal - np.rad2deg(g_at_q / kp)


@row.wrong
def goal_scaled_too(q_goal, g_at_q, kp):
    """the goal is divided by the stiffness as well"""
    return (q_goal - g_at_q) / kp


@row.wrong
def always_below(q_goal, g_at_q, kp):
    """gravity's sign is lost: where g is negative, the joint rests above its goal"""
    return q_goal - np.abs(g_at_q) / kp


@row.wrong
def stiffness_squared(q_goal, g_at_q, kp):
    """gravity's torque is divided by kp twice: compare the units"""
    return q_goal - g_at_q / kp**2


@row.wrong
def answer_wrapped(q_goal, g_at_q, kp):
    """the angle is taken to within +-pi; these joints have stops, so a whole turn is
    not the same as none, and joint6 goes beyond pi"""
    return wrapped(q_goal - g_at_q / kp)


@row.right  # On one fraction bar.
def _(q_goal, g_at_q, kp):
    return (kp * q_goal - g_at_q) / kp
