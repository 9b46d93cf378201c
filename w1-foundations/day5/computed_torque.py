"""5.6 `computed_torque(M, bias, damping, ...)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import draw
from labkit.judge.row import Row
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
    q = draw.configurations(rng, N)
    qd = draw.numbers(rng, -2, 2, N, 7)
    qd[0] = 0.0
    M = draw.rounded(verify.mujoco_mass_matrix(model, q))  # rounded, to be typed
    bias = draw.rounded(verify.mujoco_bias(model, q, qd))
    for i in range(N):
        e, ed = far(rng) if i == 3 else errors(rng)
        wanted = [e, ed, seven(rng, -5, 5)]
        for part in {0: (0, 1, 2), 1: (0,), 2: (2,)}.get(i, ()):
            wanted[part] = 0.0 * ONE
        omega = float(draw.numbers(rng, 5, 40))
        friction = seven(rng, 0.5, 1.5)
        yield M[i], bias[i], friction, qd[i], *wanted, omega**2, 1.8 * omega


@row.wrong
def gains_outside_M(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the gains stand outside the product with M. It tracks well, but heavy and light
    joints then answer differently, and errors do not decay as designed"""
    return M @ qdd_ref + kp * e + kd * ed + bias + damping * qd


@row.wrong
def damping_forgotten(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the joints' friction is missing: bias does not hold it, MuJoCo counts it as a
    passive force"""
    return M @ (qdd_ref + kd * ed + kp * e) + bias


@row.wrong
def damping_sign(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the joints' friction has the wrong sign: the motor has to overcome it"""
    return M @ (qdd_ref + kd * ed + kp * e) + bias - damping * qd


@row.wrong
def friction_of_the_error(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """friction is multiplied by ed; the joint rubs with its measured velocity"""
    return M @ (qdd_ref + kd * ed + kp * e) + bias + damping * ed


@row.wrong
def friction_of_the_reference(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """friction is multiplied by the reference's velocity, qd + ed; the joint rubs with
    its measured velocity"""
    return M @ (qdd_ref + kd * ed + kp * e) + bias + damping * (qd + ed)


@row.wrong
def friction_without_velocity(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """damping is added as it is: it becomes a torque once it is multiplied by qd"""
    return M @ (qdd_ref + kd * ed + kp * e) + bias + damping


@row.wrong
def friction_twice(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the joints' friction is in it twice; bias does not hold it, so once is enough"""
    return M @ (qdd_ref + kd * ed + kp * e) + bias + 2.0 * damping * qd


@row.wrong
def bias_forgotten(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """bias is missing: gravity and Coriolis forces are left to the springs"""
    return M @ (qdd_ref + kd * ed + kp * e) + damping * qd


@row.wrong
def bias_sign(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """bias has the wrong sign: it is what the motors must give"""
    return M @ (qdd_ref + kd * ed + kp * e) - bias + damping * qd


@row.wrong
def bias_twice(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """bias is in it twice"""
    return M @ (qdd_ref + kd * ed + kp * e) + 2.0 * bias + damping * qd


@row.wrong
def qdd_ref_forgotten(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the reference's own acceleration is missing: the springs must be stretched before
    the arm speeds up"""
    return M @ (kd * ed + kp * e) + bias + damping * qd


@row.wrong
def qdd_ref_sign(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the reference's acceleration has the wrong sign"""
    return M @ (kd * ed + kp * e - qdd_ref) + bias + damping * qd


@row.wrong
def springs_forgotten(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """there are no springs in it: errors stay what they are"""
    return M @ qdd_ref + bias + damping * qd


@row.wrong
def damper_forgotten(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """there is a spring and no damper: edd + kp e = 0 swings for ever"""
    return M @ (qdd_ref + kp * e) + bias + damping * qd


@row.wrong
def error_sign(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the spring pushes away from the goal"""
    return M @ (qdd_ref + kd * ed - kp * e) + bias + damping * qd


@row.wrong
def velocity_error_sign(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the damper drives the motion: ed enters with a plus"""
    return M @ (qdd_ref - kd * ed + kp * e) + bias + damping * qd


@row.wrong
def both_signs(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """kp e and kd ed both have the wrong sign: e and ed are the reference minus what is
    measured"""
    return M @ (qdd_ref - kd * ed - kp * e) + bias + damping * qd


row.of_argument("e", WRAPPED)


@row.wrong
def gains_swapped(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """kp and kd are swapped"""
    return M @ (qdd_ref + kp * ed + kd * e) + bias + damping * qd


@row.wrong
def measured_velocity_damped(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the damper works on the measured velocity, minus kd qd, so it brakes the
    reference's own motion too; ed is what it has to work on"""
    return M @ (qdd_ref - kd * qd + kp * e) + bias + damping * qd


@row.wrong
def inverse_of_M(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the acceleration is divided by M; a torque is M times an acceleration"""
    return np.linalg.solve(M, qdd_ref + kd * ed + kp * e) + bias + damping * qd


@row.wrong
def M_forgotten(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """M is missing: an acceleration is added to torques"""
    return qdd_ref + kd * ed + kp * e + bias + damping * qd


@row.wrong
def diagonal_of_M(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """only the diagonal of M is used; a joint that speeds up pushes the others too"""
    return np.diag(M) * (qdd_ref + kd * ed + kp * e) + bias + damping * qd


@row.wrong
def everything_through_M(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """bias and friction go through M as well; they are torques already"""
    return M @ (qdd_ref + kd * ed + kp * e + bias + damping * qd)


@row.wrong
def bias_through_M(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """bias goes through M as well; it is a torque already"""
    return M @ (qdd_ref + kd * ed + kp * e + bias) + damping * qd


@row.wrong
def armature_twice(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the armature, 0.1 kg m2, is added to M; M has it already"""
    M = M + ARMATURE * np.eye(7)
    return M @ (qdd_ref + kd * ed + kp * e) + bias + damping * qd


@row.wrong
def bias_alone_at_the_goal(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """where e is 0 only bias comes back, but the arm may be moving there"""
    if np.all(e == 0.0):
        return bias.copy()
    return M @ (qdd_ref + kd * ed + kp * e) + bias + damping * qd


@row.wrong
def reference_outside_M(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the reference's acceleration stands outside the product with M"""
    return M @ (kd * ed + kp * e) + qdd_ref + bias + damping * qd


@row.wrong
def errors_in_degrees(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    """the errors are converted to degrees; everything else is in radians"""
    return M @ (qdd_ref + np.rad2deg(kp * e + kd * ed)) + bias + damping * qd


@row.right  # With einsum, each term through M.
def _(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    terms = [qdd_ref, kp * e, kd * ed]
    return np.einsum("ij,kj->i", M, terms) + bias + np.diag(damping) @ qd


@row.close("rounded-somewhere")  # M in single precision.
def _(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return (
        np.float64(np.float32(M)) @ (qdd_ref + kd * ed + kp * e) + bias + damping * qd
    )
