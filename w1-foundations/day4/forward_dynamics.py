"""4.8 `forward_dynamics(M, bias, damping, qd, tau)`: its questions and its mistakes."""

from functools import partial

import numpy as np
from numpy.linalg import solve

from labkit.judge import Vector, draw
from labkit.judge.row import Row
from robo47.dynamics import forward_dynamics

from .states import JOINTS, states

row = Row(Vector((7,), "rad/s2", names=JOINTS))
wrong = partial(row.wrong, redone="the acceleration with that torque")
LIMITS = np.array([87.0] * 4 + [12.0] * 3)  # N m, of the motors
ABOVE = "the lab's torques are within the limits"


@row.inputs
def _(rng):
    """The Panda held up, let go; then in motion, with any torque.

    In half of the motions a load pulls as hard as the motors can, or harder: the bias
    holds it, and tau, so that no acceleration gets out of hand.
    """
    case, *moving = states(rng, 11)
    zero = np.zeros(7)
    still = (case.M, case.gravity_torque, np.ones(7), zero)
    qd = draw.numbers(rng, -2, 2, 10, 7)
    tau = draw.numbers(rng, -10, 10, 10, 7)
    load = draw.rounded(1.5 * LIMITS * rng.uniform(-1, 1, (10, 7)))
    load[:5] = 0.0
    damping = [np.ones(7)] * 5 + list(draw.numbers(rng, 0.1, 3, 5, 7))
    yield *still, case.gravity_torque
    yield *still, zero
    for now, D, v, t, w in zip(moving, damping, qd, tau, load):
        yield now.M, now.bias(v) + w, D, v, t + w


@wrong()
def damping_forgotten(M, bias, damping, qd, tau):
    """the damping is missing: the joints' friction takes damping times qd"""
    return solve(M, tau - bias)


@wrong("damping-sign", "the damping drives the joints; it has to brake them")
def _(M, bias, damping, qd, tau):
    return solve(M, tau - bias + damping * qd)


@wrong("bias-forgotten", "the bias is missing: without a torque the arm would not fall")
def _(M, bias, damping, qd, tau):
    return solve(M, tau - damping * qd)


@wrong()
def bias_sign(M, bias, damping, qd, tau):
    """the bias is added; the torque has to overcome it before anything moves"""
    return solve(M, tau + bias - damping * qd)


@wrong("both-signs", "bias and damping are added; both take from the motors' torque")
def _(M, bias, damping, qd, tau):
    return solve(M, tau + bias + damping * qd)


@wrong("bias-and-damping-forgotten", "bias and damping are both missing")
def _(M, bias, damping, qd, tau):
    return solve(M, tau)


@wrong()
def damping_sign_lost(M, bias, damping, qd, tau):
    """the speed counts without its sign: on a joint that turns backwards the damping
    pulls backwards, too; it has to brake it"""
    return solve(M, tau - bias - damping * abs(qd))


@wrong(hidden=ABOVE)
def torque_clipped(M, bias, damping, qd, tau):
    """the torque tau is cut to what the motors can give; here it counts as it is
    given"""
    return solve(M, np.clip(tau, -LIMITS, LIMITS) - bias - damping * qd)


@wrong(hidden=ABOVE)
def torque_clipped(M, bias, damping, qd, tau):
    """the torque tau is cut to 87 N m, what joint1's motor can give; here it counts as
    it is given"""
    return solve(M, np.clip(tau, -87, 87) - bias - damping * qd)


@wrong("torque-forgotten", "the motors' torque is missing: this is how the arm falls")
def _(M, bias, damping, qd, tau):
    return solve(M, -bias - damping * qd)


@wrong()
def damping_without_speed(M, bias, damping, qd, tau):
    """the damping is taken off as it is; it is a torque only when it is multiplied by
    qd"""
    return solve(M, tau - bias - damping)


@wrong()
def damping_as_one_number(M, bias, damping, qd, tau):
    """the product damping @ qd is one number, the sum over all joints; each joint has
    its own friction, damping * qd"""
    return solve(M, tau - bias - damping @ qd)


@row.wrong
def armature_twice(M, bias, damping, qd, tau):
    """the armature is added to M, where it is already since task 4.3 => the
    acceleration with M + 0.1 on the diagonal"""
    return solve(M + 0.1 * np.eye(7), tau - bias - damping * qd)


@row.wrong
def mass_of_the_step(M, bias, damping, qd, tau):
    """M + h damping is how the simulator takes a step of h = 2 ms; the acceleration now
    needs M alone => the acceleration with M + h damping"""
    return solve(M + 0.002 * np.diag(damping), tau - bias - damping * qd)


@row.wrong
def velocity_returned(M, bias, damping, qd, tau):
    """this is the velocity after a step of 2 ms, qd + h qdd; the acceleration qdd was
    asked for => qd + 0.002 qdd"""
    return qd + 0.002 * forward_dynamics(M, bias, damping, qd, tau)


@row.wrong
def multiplied_by_M(M, bias, damping, qd, tau):
    """the net torque is multiplied by M; M times the acceleration is what it equals =>
    M times the net torque"""
    return M @ (tau - bias - damping * qd)


@row.wrong
def diagonal_only(M, bias, damping, qd, tau):
    """only the diagonal of M is used; a torque at one joint accelerates the others, too
    => the net torque divided by the diagonal"""
    return (tau - bias - damping * qd) / np.diag(M)


@row.wrong
def mass_forgotten(M, bias, damping, qd, tau):
    """this is the net torque; M is missing => the net torque"""
    return tau - bias - damping * qd


@row.wrong
def divided_entry_by_entry(M, bias, damping, qd, tau):
    """1 / M turns over each entry; that is not the inverse of a matrix => the product
    with 1 / M"""
    return (1 / M) @ (tau - bias - damping * qd)


@row.wrong
def damping_not_divided(M, bias, damping, qd, tau):
    """the damping is taken off after M has been divided by; it is a torque, too => the
    difference of the two"""
    return solve(M, tau - bias) - damping * qd


@row.wrong
def only_torque_divided(M, bias, damping, qd, tau):
    """only the motors' torque is divided by M; bias and damping are torques, too => the
    difference of the two"""
    return solve(M, tau) - bias - damping * qd


@row.wrong("off", hidden="nothing is at rest there")  # What is still is taken to stay.
def _(M, bias, damping, qd, tau):
    return forward_dynamics(M, bias, damping, qd, tau) if qd.any() else np.zeros(7)
