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


@row.wrong(
    "torque-clipped",
    "your code clamps `tau` to the motors' torque limits. Use `tau` unchanged",
    hidden="the lab's torques are within the limits",
)
def _(M, bias, damping, qd, tau):
    return solve(M, np.clip(tau, -LIMITS, LIMITS) - bias - damping * qd)


@row.wrongs
def _(M, bias, damping, qd, tau):
    """both-signs: your code adds `bias` and the damping torque to `tau`. Subtract both
      from `tau` instead
    armature-twice: your code adds the armature to M. Use M unchanged, because M already
      contains the armature (task 4.3)
    mass-of-the-step: your code uses M + h damping, which is the matrix of the
      simulator's implicit step with h = 2 ms. Use M alone, because qdd is the
      acceleration at the present instant
    velocity-returned: your code returns qd + h qdd, which is the velocity after a step
      of h = 2 ms. Return qdd instead
    divided-entry-by-entry: your code takes the reciprocal of each entry of M (`1 / M`).
      Use the matrix inverse of M instead, or solve the linear system
    damping-not-divided: the damping torque in your result is not multiplied by M^-1.
      Subtract this torque from `tau` before the multiplication, because the result is
      an acceleration
    only-torque-divided: only `tau` is multiplied by M^-1 in your result. Subtract
      `bias` and the damping torque from `tau` first, because both are also torques
    """
    brake = damping * qd
    net = tau - bias - brake
    return {
        "both-signs": solve(M, tau + bias + brake),
        "armature-twice": solve(M + 0.1 * np.eye(7), net),
        "mass-of-the-step": solve(M + 0.002 * np.diag(damping), net),
        "velocity-returned": qd + 0.002 * solve(M, net),
        "divided-entry-by-entry": (1 / M) @ net,
        "damping-not-divided": solve(M, tau - bias) - brake,
        "only-torque-divided": solve(M, tau) - bias - brake,
    }


@row.wrong("off", hidden="nothing is at rest there")  # What is still is taken to stay.
def _(M, bias, damping, qd, tau):
    return forward_dynamics(M, bias, damping, qd, tau) if qd.any() else np.zeros(7)


@row.wrong
def half_solved(M, bias, damping, qd, tau):
    """your result is L^-1 (tau - bias - damping qd), where M equals L L^T. Solve the
    second triangular system, which contains L^T, as well"""
    return solve(np.linalg.cholesky(M), tau - bias - damping * qd)


@row.wrong
def one_factor_twice(M, bias, damping, qd, tau):
    """your result contains L^-1 L^-1 instead of M^-1. M equals L L^T, so the second
    triangular system should contain L^T"""
    L = np.linalg.cholesky(M)
    return solve(L, solve(L, tau - bias - damping * qd))


row.at_least_0(damping="damping removes energy")


row.spans(  # as small, or as large, as in the lab
    bias=(lambda bias: 0.02 * bias,),
)
