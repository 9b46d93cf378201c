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
        return Finding("damped", f"{DAMPED} The number is {added:.2g}.")
    return None


DAMPED = (
    "A number is added to the diagonal of J M^-1 J^T, so a part of the torque "
    "accelerates the hand. Use the argument Lambda."
)
# One matrix with two readings: J^T pinv(J^T) is J^+ J.
row = Row(TORQUE, alike=[{"pinv-of-transpose", "kinematic-projector"}], unnamed=damped)


@row.inputs
def _(rng):
    case = (J_CASE, M_CASE, np.eye(6), np.ones(7))
    return [case, *((*model(now), some(rng, 10, 7)) for now in states(rng))]


@row.wrongs
def _(J, M, Lambda, tau):
    """another-projector: the result does not accelerate the hand either, but the
      subtracted torque is not J^T times a wrench. Use the wrench that Lambda gives => M
      n n^T M^-1 tau
    acceleration: the result is a joint acceleration that does not move the hand;
      multiply it by M to get a torque => M^-1 times the correct formula
    not-projected: tau is returned unchanged, so it also accelerates the hand => tau
    kinematic-projector: the projector I - J^+ J acts on joint velocities, not on
      torques: how a torque accelerates the hand depends on M. The arm still draws the
      circle, but the hand accelerates by metres per second squared => tau - J^+ J tau
    M-for-identity: tau is multiplied by M before the subtraction. The unit of M tau is
      kg m2 times N m, so it is not a torque => (M - J^T Lambda J M^-1) tau
    projector-transposed: the projector is transposed: M^-1 J^T Lambda J acts on joint
      accelerations. For torques M^-1 is on the right => tau - M^-1 J^T Lambda J tau
    the-other-part: the result is the part of tau that accelerates the hand; subtract it
      from tau => tau minus the correct formula
    position-only: only the linear acceleration of the hand is removed, so the hand
      rotates => the correct formula with the linear half alone
    pinv-for-transpose: pinv(J) maps the wrench to the joints; J^T maps wrenches to
      torques => the correct formula with pinv(J)
    pinv-of-transpose: the projector I - J^T pinv(J^T) acts on joint velocities, not on
      torques: how a torque accelerates the hand depends on M => tau - J^T pinv(J^T) tau
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
