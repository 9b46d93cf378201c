"""5.4 `gravity_pd(e, ed, kp, kd, g_at_q)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row

from .joints import ONE, TORQUE, one_gain, seven, springs, springs_of_one_gain, stiff


def gravity_of_one_gain(rng):
    """Return errors, gains that are one number, and gravity's torques."""
    still = 0.0 * ONE, 0.0 * ONE, 100.0, 20.0
    return [(*case, seven(rng, -40, 40)) for case in (still, *springs_of_one_gain(rng))]


row = Row(TORQUE, held_out=[one_gain(gravity_of_one_gain)])


@row.inputs
def _(rng):
    still = 0.0 * ONE, 0.0 * ONE, *stiff(rng)
    through = 0.0 * ONE, seven(rng, -2, 2), *stiff(rng)
    cases = [still, through, *springs(rng)]
    return [(*case, seven(rng, -40, 40)) for case in cases]


@row.wrongs
def _(e, ed, kp, kd, g_at_q):
    """gravity-forgotten: gravity's torque is not in it: these springs sag like those of
      5.1
    gravity-sign: gravity's torque has the wrong sign: g is what the motors must give to
      hold the arm, and this pushes the arm down
    gravity-twice: gravity's torque is in it twice
    gravity-through-the-gain: gravity's torque goes through kp; it is a torque already
    springs-forgotten: only gravity's torque is there: the arm floats and goes nowhere
    gravity-through-both-gains: gravity's torque is multiplied by the whole of it;
      torques add
    gravity-at-the-goal-only: at the goal only gravity's torque is there, and elsewhere
      only the springs'; the arm has its weight everywhere, and its springs too
    gravity-at-rest-only: gravity's torque is there only where ed is 0; a moving arm has
      its weight too
    nothing-at-the-goal: where e is 0, no torque comes back: the arm has its weight at
      the goal too
    """
    springs = kp * e + kd * ed
    away = np.any(e)
    return {
        "gravity-forgotten": springs,
        "gravity-sign": springs - g_at_q,
        "gravity-twice": springs + 2.0 * g_at_q,
        "gravity-through-the-gain": kp * (e + g_at_q) + kd * ed,
        "springs-forgotten": g_at_q.copy(),
        "gravity-through-both-gains": springs * g_at_q,
        "gravity-at-the-goal-only": springs if away else g_at_q.copy(),
        "gravity-at-rest-only": springs + g_at_q * (ed == 0.0),
        "nothing-at-the-goal": springs + g_at_q if away else np.zeros(7),
    }


row.reached_by("pd_torque", "gravity is right; in the springs, ")


@row.right  # The spring is told to go higher.
def _(e, ed, kp, kd, g_at_q):
    return kp * (e + g_at_q / kp) + kd * ed


row.at_least_0(kp="a gain", kd="a gain")


row.spans(  # as small, or as large, as in the lab
    e=(lambda e: 9e-05 * e,),
    ed=(lambda ed: 0.006 * ed,),
)
