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
    """gains-outside-M: the gains stand outside the product with M. It tracks well, but
      heavy and light joints then answer differently, and errors do not decay as
      designed
    damping-forgotten: the joints' friction is missing: bias does not hold it, MuJoCo
      counts it as a passive force
    damping-sign: the joints' friction has the wrong sign: the motor has to overcome it
    friction-of-the-error: friction is multiplied by ed; the joint rubs with its
      measured velocity
    friction-of-the-reference: friction is multiplied by the reference's velocity, qd +
      ed; the joint rubs with its measured velocity
    friction-without-velocity: damping is added as it is: it becomes a torque once it is
      multiplied by qd
    friction-twice: the joints' friction is in it twice; bias does not hold it, so once
      is enough
    bias-forgotten: bias is missing: gravity and Coriolis forces are left to the springs
    bias-sign: bias has the wrong sign: it is what the motors must give
    bias-twice: bias is in it twice
    everything-through-M: bias and friction go through M as well; they are torques
      already
    bias-through-M: bias goes through M as well; it is a torque already
    reference-outside-M: the reference's acceleration stands outside the product with M
    bias-alone-at-the-goal: where e is 0 only bias comes back, but the arm may be moving
      there
    """
    rub = damping * qd
    springs = kd * ed + kp * e
    acc = qdd_ref + springs
    push = M @ acc
    return {
        "gains-outside-M": M @ qdd_ref + springs + bias + rub,
        "damping-forgotten": push + bias,
        "damping-sign": push + bias - rub,
        "friction-of-the-error": push + bias + damping * ed,
        "friction-of-the-reference": push + bias + damping * (qd + ed),
        "friction-without-velocity": push + bias + damping,
        "friction-twice": push + bias + 2.0 * rub,
        "bias-forgotten": push + rub,
        "bias-sign": push - bias + rub,
        "bias-twice": push + 2.0 * bias + rub,
        "everything-through-M": M @ (acc + bias + rub),
        "bias-through-M": M @ (acc + bias) + rub,
        "reference-outside-M": M @ springs + qdd_ref + bias + rub,
        "bias-alone-at-the-goal": push + bias + rub if np.any(e) else bias.copy(),
    }


@row.wrongs
def _(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """qdd-ref-forgotten: the reference's own acceleration is missing: the springs must
      be stretched before the arm speeds up
    qdd-ref-sign: the reference's acceleration has the wrong sign
    springs-forgotten: there are no springs in it: errors stay what they are
    damper-forgotten: there is a spring and no damper: edd + kp e = 0 swings for ever
    error-sign: the spring pushes away from the goal
    velocity-error-sign: the damper drives the motion: ed enters with a plus
    both-signs: kp e and kd ed both have the wrong sign: e and ed are the reference
      minus what is measured
    gains-swapped: kp and kd are swapped
    measured-velocity-damped: the damper works on the measured velocity, minus kd qd, so
      it brakes the reference's own motion too; ed is what it has to work on
    errors-in-degrees: the errors are converted to degrees; everything else is in
      radians
    """
    acc = {
        "qdd-ref-forgotten": kd * ed + kp * e,
        "qdd-ref-sign": kd * ed + kp * e - qdd_ref,
        "springs-forgotten": qdd_ref,
        "damper-forgotten": qdd_ref + kp * e,
        "error-sign": qdd_ref + kd * ed - kp * e,
        "velocity-error-sign": qdd_ref - kd * ed + kp * e,
        "both-signs": qdd_ref - kd * ed - kp * e,
        "gains-swapped": qdd_ref + kp * ed + kd * e,
        "measured-velocity-damped": qdd_ref - kd * qd + kp * e,
        "errors-in-degrees": qdd_ref + np.rad2deg(kp * e + kd * ed),
    }
    return {slug: M @ some + bias + damping * qd for slug, some in acc.items()}


@row.wrongs
def _(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """inverse-of-M: the acceleration is divided by M; a torque is M times an
      acceleration
    M-forgotten: M is missing: an acceleration is added to torques
    diagonal-of-M: only the diagonal of M is used; a joint that speeds up pushes the
      others too
    armature-twice: the armature, 0.1 kg m2, is added to M; M has it already
    """
    acc = qdd_ref + kd * ed + kp * e
    push = {
        "inverse-of-M": np.linalg.solve(M, acc),
        "M-forgotten": acc,
        "diagonal-of-M": np.diag(M) * acc,
        "armature-twice": M @ acc + ARMATURE * acc,
    }
    return {slug: some + bias + damping * qd for slug, some in push.items()}


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


row.at_least_0(damping="it takes energy away", kp="a gain", kd="a gain")


row.spans(  # as small, or as large, as in the lab
    bias=(lambda bias: 0.05 * bias,),
    qd=(lambda qd: 6e-08 * qd,),
    e=(lambda e: 4e-07 * e,),
    ed=(lambda ed: 7e-08 * ed,),
    qdd_ref=(lambda qdd_ref: 0.004 * qdd_ref,),
    kp=(200000.0,),
    kd=(900.0,),
)
