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
    """gravity-sign: your code subtracts `g_at_q`. Add `g_at_q` instead, because the
      motors must supply this torque to hold the arm
    gravity-through-the-gain: your code multiplies the gravity torque by kp. Add the
      gravity torque to the PD torque unchanged, because gains apply only to errors
    gravity-at-the-goal-only: your code returns only the gravity torque if e is 0, and
      only the PD torque otherwise. Always return the sum of both torques
    gravity-at-rest-only: your code adds the gravity torque only for joints whose ed is
      0. Always add this torque, because gravity also acts on a moving arm
    nothing-at-the-goal: your code returns 0 if e is 0. Use the same formula for every
      e, because the motors must support the weight of the arm even at the goal
    """
    springs = kp * e + kd * ed
    away = np.any(e)
    return {
        "gravity-sign": springs - g_at_q,
        "gravity-through-the-gain": kp * (e + g_at_q) + kd * ed,
        "gravity-at-the-goal-only": springs if away else g_at_q.copy(),
        "gravity-at-rest-only": springs + g_at_q * (ed == 0.0),
        "nothing-at-the-goal": springs + g_at_q if away else np.zeros(7),
    }


row.reached_by("pd_torque", "in the PD torque, ")


@row.right  # Gravity as an offset of the goal.
def _(e, ed, kp, kd, g_at_q):
    return kp * (e + g_at_q / kp) + kd * ed


row.at_least_0(kp="a gain", kd="a gain")


row.spans(  # as small, or as large, as in the lab
    e=(lambda e: 9e-05 * e,),
    ed=(lambda ed: 0.006 * ed,),
)
