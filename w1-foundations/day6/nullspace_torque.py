"""6.4 `nullspace_torque(J_site, M, Lambda, tau)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding

from .states import J_CASE, M_CASE, TORQUE, model, some, states

pinv, solve = np.linalg.pinv, np.linalg.solve


def damped(case: Case) -> Finding | None:
    """Say how much damping a Lambda of one's own has that stands for the given one."""
    J, M, Lambda, tau = case.arguments
    a = (J @ solve(M, tau[..., None]))[..., 0]
    push = (pinv(np.swapaxes(J, 1, 2)) @ (tau - case.S)[..., None])[..., 0]
    left = a - solve(Lambda, push[..., None])[..., 0]  # of a damped one: c times push
    added = np.sum(left * push) / max(np.sum(push * push), 1e-12)
    if added > 1e-8 and np.abs(left - added * push).max() < 0.01 * np.abs(left).max():
        return Finding("damped", f"{DAMPED} Here it is {added:.2g}.")
    return None


DAMPED = (
    "Something is added to the diagonal of J M^-1 J^T for Lambda's own "
    "inverse: the hand then feels a part of the torque. Lambda is given; use it."
)
# One matrix with two readings: J^T pinv(J^T) is J^+ J.
row = Row(TORQUE, alike=[{"pinv-of-transpose", "kinematic-projector"}], unnamed=damped)


@row.inputs
def _(rng):
    case = (J_CASE, M_CASE, np.eye(6), np.ones(7))
    return [case, *((*model(now), some(rng, 10, 7)) for now in states(rng))]


@row.wrongs
def _(J, M, Lambda, tau):
    """another-projector: it does not accelerate the hand either, but what you took away
      is no push at the hand: that would be J^T times a wrench, whose size Lambda
      knows => M n n^T M^-1 tau
    acceleration: this is an acceleration of the joints that the hand does not feel; M
      makes a torque of it => M^-1 times the right one
    not-projected: tau is returned as it is: all of it reaches the hand => tau
    kinematic-projector: I - J^+ J keeps speeds from the hand, not torques: how a torque
      accelerates the hand depends on the masses, so M is needed. It still draws the
      circle, and yet the hand is accelerated by metres per second squared => tau - J^+
      J tau
    M-for-identity: M stands where the identity belongs: M tau is no torque (its unit is
      kg m2 times N m), so nothing can be taken away from it => (M - J^T Lambda J M^-1)
      tau
    projector-transposed: the projector is transposed: M^-1 J^T Lambda J is for joint
      accelerations; for torques M^-1 is on the other side => tau - M^-1 J^T Lambda J
      tau
    the-other-part: this is what is to be taken away: the part that the hand feels =>
      tau minus the right one
    added: the part that the hand feels is added, so it feels it twice
    negative: every sign is wrong: tau is taken away from the part that the hand feels
    M-left-out: M is missing: J tau is no acceleration of the hand, tau has to become
      one of the joints first => tau - J^T Lambda J tau
    M-not-inverted: M multiplies tau; torques become accelerations through M^-1
    Lambda-left-out: Lambda is missing: the hand's acceleration is used as if it were a
      push => the right one with Lambda = I
    Lambda-inverted: Lambda is inverted => the right one with Lambda^-1
    pinv-for-transpose: pinv(J) takes the push back to the joints; pushes go to torques
      with J^T => the right one with pinv(J)
    pinv-of-transpose: J^T and its pseudo-inverse stand in the order of a projector of
      pushes: I - J^T pinv(J^T) keeps speeds from the hand, not torques => tau - J^T
      pinv(J^T) tau
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
        "added": tau + felt,
        "negative": felt - tau,
        "M-left-out": tau - J.T @ Lambda @ J @ tau,
        "M-not-inverted": tau - J.T @ Lambda @ J @ M @ tau,
        "Lambda-left-out": tau - J.T @ a,
        "Lambda-inverted": tau - J.T @ solve(Lambda, a),
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
