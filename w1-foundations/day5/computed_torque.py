"""5.6 `computed_torque(M, bias, damping, ...)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, rounded
from robo47 import panda, verify

from .joints import ONE, TORQUE, WRAPPED, errors, far, seven

ARMATURE = 0.1  # kg m2, of every joint of the Panda's model
N = 13

row = Row(TORQUE)


@row.inputs
def _(rng):
    """Give states of a moving Panda, MuJoCo's M and bias; first at rest on its goal.

    In the next three e is 0, qdd_ref is 0, and e is beyond half a turn.
    """
    model = panda.load("panda_nohand")
    q = rng.configurations(N)
    qd = rng.numbers(-2, 2, N, 7)
    qd[0] = 0.0
    M = rounded(verify.mujoco_mass_matrix(model, q))  # rounded, to be typed
    bias = rounded(verify.mujoco_bias(model, q, qd))
    for i in range(N):
        e, ed = far(rng) if i == 3 else errors(rng)
        wanted = [e, ed, seven(rng, -5, 5)]
        for part in {0: (0, 1, 2), 1: (0,), 2: (2,)}.get(i, ()):
            wanted[part] = 0.0 * ONE
        omega = float(rng.numbers(5, 40))
        friction = seven(rng, 0.5, 1.5)
        yield M[i], bias[i], friction, qd[i], *wanted, omega**2, 1.8 * omega


@row.wrongs
def _(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """gains-outside-M: the PD terms in your result are not multiplied by M. Multiply
      these terms by M too, because otherwise joints with different inertias respond
      differently
    damping-forgotten: your code omits the damping torque. Add `damping * qd`, because
      `bias` does not contain this torque
    friction-of-the-error: your code multiplies `damping` by ed. Multiply `damping` by
      the measured velocity qd instead
    friction-of-the-reference: your code multiplies `damping` by qd + ed, which is the
      velocity of the reference. Multiply `damping` by the measured velocity qd instead
    M-forgotten: your code omits M, so it adds an acceleration to torques. Multiply this
      acceleration by M first
    bias-forgotten: your code omits `bias`, so the PD terms must compensate for gravity
      and the Coriolis torque. Add `bias` to the torque
    bias-sign: your code subtracts `bias`. Add `bias` instead, because the motors must
      supply this torque even at zero acceleration
    everything-through-M: `bias` and the damping torque are multiplied by M in your
      result. Add both without this factor, because both are already torques
    reference-outside-M: qdd_ref is not multiplied by M in your result. Multiply qdd_ref
      by M too, because qdd_ref is an acceleration
    measured-velocity-damped: your code uses `-kd qd` as the derivative term, so the
      controller also brakes the desired motion. Use kd ed instead
    armature-twice: your code adds the armature (0.1 kg m2) to M. Use M unchanged,
      because M already contains the armature
    bias-alone-at-the-goal: your code returns only `bias` if e is 0. Use the same
      formula for every e, because the arm may still be moving
    """
    rub = damping * qd
    springs = kd * ed + kp * e
    acc = qdd_ref + springs
    push = M @ acc
    return {
        "gains-outside-M": M @ qdd_ref + springs + bias + rub,
        "damping-forgotten": push + bias,
        "friction-of-the-error": push + bias + damping * ed,
        "friction-of-the-reference": push + bias + damping * (qd + ed),
        "M-forgotten": acc + bias + rub,
        "bias-forgotten": push + rub,
        "bias-sign": push - bias + rub,
        "everything-through-M": M @ (acc + bias + rub),
        "reference-outside-M": M @ springs + qdd_ref + bias + rub,
        "measured-velocity-damped": M @ (qdd_ref - kd * qd + kp * e) + bias + rub,
        "armature-twice": push + ARMATURE * acc + bias + rub,
        "bias-alone-at-the-goal": push + bias + rub if np.any(e) else bias.copy(),
    }


row.of_argument("e", WRAPPED)


@row.right  # With einsum, each term through M.
def _(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    terms = [qdd_ref, kp * e, kd * ed]
    return np.einsum("ij,kj->i", M, terms) + bias + np.diag(damping) @ qd


@row.close("rounded-somewhere")  # M in single precision.
def _(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return (
        np.float64(np.float32(M)) @ (qdd_ref + kd * ed + kp * e) + bias + damping * qd
    )


row.at_least_0(damping="damping removes energy", kp="a gain", kd="a gain")


row.spans(  # as small, or as large, as in the lab
    bias=(lambda bias: 0.05 * bias,),
    qd=(lambda qd: 6e-08 * qd,),
    e=(lambda e: 4e-07 * e,),
    ed=(lambda ed: 7e-08 * ed,),
    qdd_ref=(lambda qdd_ref: 0.004 * qdd_ref,),
    kp=(200000.0,),
    kd=(900.0,),
)
