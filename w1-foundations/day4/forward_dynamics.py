"""4.8 `forward_dynamics(M, bias, damping, qd, tau)`: its questions and its mistakes."""

import numpy as np
from numpy.linalg import solve

from labkit.judge import Row, Vector, rounded
from robo47.dynamics import forward_dynamics

from .states import JOINTS, states

row = Row(Vector((7,), "rad/s2", names=JOINTS))
LIMITS = np.array([87.0] * 4 + [12.0] * 3)  # N m, of the motors


@row.inputs
def _(rng):
    """The Panda held up, let go; then in motion, with any torque.

    In half of the motions a load pulls as hard as the motors can, or harder: the bias
    holds it, and tau, so that no acceleration gets out of hand.
    """
    case, *moving = states(rng, 11)
    zero = np.zeros(7)
    still = (case.M, case.gravity_torque, np.ones(7), zero)
    qd = rng.numbers(-2, 2, 10, 7)
    tau = rng.numbers(-10, 10, 10, 7)
    load = rounded(1.5 * LIMITS * rng.uniform(-1, 1, (10, 7)))
    load[:5] = 0.0
    damping = [np.ones(7)] * 5 + list(rng.numbers(0.1, 3, 5, 7))
    yield *still, case.gravity_torque
    yield *still, zero
    for now, D, v, t, w in zip(moving, damping, qd, tau, load):
        yield now.M, now.bias(v) + w, D, v, t + w


@row.wrongs(redone="the acceleration with that torque")
def _(M, bias, damping, qd, tau):
    """damping-forgotten: the damping is missing: the joints' friction takes damping
      times qd
    damping-sign: the damping drives the joints; it has to brake them
    bias-forgotten: the bias is missing: without a torque the arm would not fall
    bias-sign: the bias is added; the torque has to overcome it before anything moves
    both-signs: bias and damping are added; both take from the motors' torque
    bias-and-damping-forgotten: bias and damping are both missing
    damping-sign-lost: the speed counts without its sign: on a joint that turns
      backwards the damping pulls backwards, too; it has to brake it
    torque-forgotten: the motors' torque is missing: this is how the arm falls
    damping-without-speed: the damping is taken off as it is; it is a torque only when
      it is multiplied by qd
    damping-as-one-number: the product damping @ qd is one number, the sum over all
      joints; each joint has its own friction, damping * qd
    """
    brake = damping * qd
    torques = {
        "damping-forgotten": tau - bias,
        "damping-sign": tau - bias + brake,
        "bias-forgotten": tau - brake,
        "bias-sign": tau + bias - brake,
        "both-signs": tau + bias + brake,
        "bias-and-damping-forgotten": tau,
        "damping-sign-lost": tau - bias - abs(brake),
        "torque-forgotten": -bias - brake,
        "damping-without-speed": tau - bias - damping,
        "damping-as-one-number": tau - bias - damping @ qd,
    }
    return {slug: solve(M, net) for slug, net in torques.items()}


for most, what in (
    (LIMITS, "what the motors can give"),
    (87.0, "87 N m, what joint1's motor can give"),
):

    @row.wrong(
        "torque-clipped",
        f"the torque tau is cut to {what}; here it counts as it is given",
        "the acceleration with that torque",
        "the lab's torques are within the limits",
    )
    def _(M, bias, damping, qd, tau, most=most):
        return solve(M, np.clip(tau, -most, most) - bias - damping * qd)


@row.wrongs
def _(M, bias, damping, qd, tau):
    """armature-twice: the armature is added to M, where it is already since task 4.3 =>
      the acceleration with M + 0.1 on the diagonal
    mass-of-the-step: M + h damping is how the simulator takes a step of h = 2 ms; the
      acceleration now needs M alone => the acceleration with M + h damping
    velocity-returned: this is the velocity after a step of 2 ms, qd + h qdd; the
      acceleration qdd was asked for => qd + 0.002 qdd
    multiplied-by-M: the net torque is multiplied by M; M times the acceleration is what
      it equals => M times the net torque
    diagonal-only: only the diagonal of M is used; a torque at one joint accelerates the
      others, too => the net torque divided by the diagonal
    mass-forgotten: this is the net torque; M is missing => the net torque
    divided-entry-by-entry: 1 / M turns over each entry; that is not the inverse of a
      matrix => the product with 1 / M
    damping-not-divided: the damping is taken off after M has been divided by; it is a
      torque, too => the difference of the two
    only-torque-divided: only the motors' torque is divided by M; bias and damping are
      torques, too => the difference of the two
    """
    brake = damping * qd
    net = tau - bias - brake
    return {
        "armature-twice": solve(M + 0.1 * np.eye(7), net),
        "mass-of-the-step": solve(M + 0.002 * np.diag(damping), net),
        "velocity-returned": qd + 0.002 * solve(M, net),
        "multiplied-by-M": M @ net,
        "diagonal-only": net / np.diag(M),
        "mass-forgotten": net,
        "divided-entry-by-entry": (1 / M) @ net,
        "damping-not-divided": solve(M, tau - bias) - brake,
        "only-torque-divided": solve(M, tau) - bias - brake,
    }


@row.wrong("off", hidden="nothing is at rest there")  # What is still is taken to stay.
def _(M, bias, damping, qd, tau):
    return forward_dynamics(M, bias, damping, qd, tau) if qd.any() else np.zeros(7)


row.at_least_0(damping="it takes energy away")


row.spans(  # as small, or as large, as in the lab
    bias=(lambda bias: 0.02 * bias,),
)
