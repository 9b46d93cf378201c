"""6.4 `nullspace_torque(J_site, M, Lambda, tau)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding

from .states import J_CASE, M_CASE, TORQUE, model, some, states

pinv, solve = np.linalg.pinv, np.linalg.solve


def damped(case: Case) -> Finding | None:
    """Return what was added to the inverse of a Lambda that replaces the given one."""
    J, M, Lambda, tau = case.arguments
    a = (J @ solve(M, tau[..., None]))[..., 0]
    push = (pinv(np.swapaxes(J, 1, 2)) @ (tau - case.S)[..., None])[..., 0]
    left = a - solve(Lambda, push[..., None])[..., 0]  # of a damped one: c times push
    added = np.sum(left * push) / max(np.sum(push * push), 1e-12)
    if added > 1e-8 and np.abs(left - added * push).max() < 0.01 * np.abs(left).max():
        return Finding("damped", f"{DAMPED} The added number is {added:.2g}.")
    return None


DAMPED = (
    "In your result, a number is added to the diagonal of J M^-1 J^T before the "
    "inversion, so part of the torque still accelerates the hand. Use the argument "
    "Lambda."
)
# One matrix with two readings: J^T pinv(J^T) is J^+ J.
row = Row(TORQUE, alike=[{"pinv-of-transpose", "kinematic-projector"}], unnamed=damped)


@row.inputs
def _(rng):
    case = (J_CASE, M_CASE, np.eye(6), np.ones(7))
    return [case, *((*model(now), some(rng, 10, 7)) for now in states(rng))]


@row.wrongs
def _(J, M, Lambda, tau):
    """another-projector: your result does not accelerate the hand, but it is the wrong
      projection of `tau`. Subtract J^T times a wrench from `tau`, and compute this
      wrench with Lambda
    acceleration: your result is the joint acceleration that the correct torque causes.
      Multiply this acceleration by M to obtain the torque
    not-projected: your code returns `tau` unchanged, so your result also accelerates
      the hand. Subtract the part of `tau` that accelerates the hand
    kinematic-projector: your result is (I - J^+ J) tau, but I - J^+ J is the projector
      for joint velocities. Use the projector for torques instead, which also depends on
      M
    M-for-identity: your result is M tau minus the part of `tau` that accelerates the
      hand. Subtract this part from `tau` itself, because M tau is not a torque
    projector-transposed: your result is tau - M^-1 J^T Lambda J tau. Subtract J^T
      Lambda J M^-1 tau from `tau` instead, because J M^-1 tau is the hand acceleration
      that `tau` causes
    the-other-part: your result is the part of `tau` that accelerates the hand. Subtract
      this part from `tau`
    position-only: your result subtracts only J[3:]^T Lambda[3:, 3:] a, where a is the
      linear acceleration of the hand, so the hand still accelerates. Use all six rows
      of J and the whole matrix Lambda, because the six directions are coupled
    pinv-for-transpose: your result subtracts pinv(J) times the wrench from `tau`.
      Subtract J^T times the wrench instead, because J^T maps wrenches to torques
    pinv-of-transpose: your result is (I - J^T pinv(J^T)) tau, but I - J^T pinv(J^T) is
      the projector for joint velocities. Use the projector for torques instead, which
      also depends on M
    """
    acc = solve(M, tau)
    a = J @ acc
    elbow = np.linalg.svd(J)[2][-1]  # joint speeds that leave the hand at rest
    felt = J.T @ Lambda @ a
    return {
        "another-projector": M @ elbow * (elbow @ acc),
        "acceleration": solve(M, tau - felt),
        "not-projected": tau,
        "kinematic-projector": tau - pinv(J) @ (J @ tau),
        "M-for-identity": M @ tau - felt,
        "projector-transposed": tau - solve(M, J.T @ Lambda @ J @ tau),
        "the-other-part": felt,
        "position-only": tau - J[3:].T @ (Lambda[3:, 3:] @ a[3:]),
        "pinv-for-transpose": tau - pinv(J) @ Lambda @ a,
        "pinv-of-transpose": tau - J.T @ pinv(J.T) @ tau,
    }


@row.right  # By the accelerations of a constrained arm.
def _(J, M, Lambda, tau):
    free = np.linalg.solve(M, tau)
    F = np.linalg.solve(J @ np.linalg.solve(M, J.T), J @ free)
    return M @ (free - np.linalg.solve(M, J.T @ F))


row.spans(  # as small, or as large, as in the lab
    tau=(lambda tau: 3e-05 * tau,),
)
