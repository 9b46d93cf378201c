"""3.5 `dls_step(J_site, e, damping)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row, Vector
from robo47.jacobian import dls_step

from .jacobians import JOINTS, UNIT, near_singular, site_jacobians

I6 = np.eye(6)
pinv, solve = np.linalg.pinv, np.linalg.solve


def _without_damping(rng):
    J = site_jacobians(rng.configurations(3))
    e = rng.numbers(-1, 1, 3, 6)
    return [(J[i], e[i], 0.0) for i in range(3)]


AT_NO_DAMPING = HeldOut(
    "zero-without-damping",
    "Your function is correct if `damping` is positive, but it returns zeros if "
    "`damping` is 0. Without damping, the damped least-squares step is the "
    "pseudo-inverse step. Step 6 of the lab uses a damping of 0.",
    _without_damping,
    mistaken=lambda J, e, damping: np.zeros(7),
)
row = Row(Vector((7,), "rad", names=JOINTS), held_out=[AT_NO_DAMPING])


@row.inputs
def _(rng):
    e = rng.numbers(-0.5, 0.5, 9, 6)
    damping = [0.05, 0.02, 0.1, 0.3, 0.5, 2.0, 0.01, 0.0002, 0.7]
    first = (UNIT, np.arange(1.0, 7.0) / 10, 1.0)
    return [first, *zip(near_singular(rng), e, damping, strict=True)]


@row.wrongs
def _(J, e, damping):
    """relative-damping: your code multiplies `damping` by the largest singular value of
      J. Use `damping` unchanged, because the step minimises |J dq - e|^2 + damping^2
      |dq|^2
    damping-dropped: your result is the pseudo-inverse step, which can be very large
      near a singularity. With damping, the step minimises |J dq - e|^2 + damping^2
      |dq|^2
    damping-everywhere: your code adds damping^2 to every entry of J J^T. Add damping^2
      only to the diagonal of J J^T
    transpose-only: your code returns the gradient step J^T e. The damped least-squares
      step also contains the inverse of J J^T + damping^2 I
    pseudo-inverse-scaled: your code divides the pseudo-inverse step by 1 + damping^2,
      which scales all directions equally. Damping should mainly reduce the step along
      the directions with small singular values
    damping-fixed: your code always uses a damping of 0.05. Use the argument `damping`
      instead
    damping-added-to-the-values: for each singular value s, your code uses the factor 1
      / (s + damping). Use the factor s / (s^2 + damping^2) instead
    singular-value-missing 2: for each singular value s above 0, your code uses the
      factor 1 / (s^2 + damping^2). Multiply this factor by s, because J^T contributes a
      factor of s
    damping-added-to-the-values 2: for each singular value s, your code uses the factor
      1 / (s + damping^2). Use the factor s / (s^2 + damping^2) instead
    damping-as-a-cut: your step omits the directions whose singular value is at most
      `damping` times the largest one, as the pseudo-inverse with `damping` as `rcond`
      does. Damping should reduce the step along these directions instead of omitting
      them
    damping-as-a-cut 2: your step omits the directions whose singular value is at most
      `damping`. Damping should reduce the step along these directions instead of
      omitting them
    singular-value-missing: for each singular value s, your code uses the factor 1 /
      (s^2 + damping^2). Multiply this factor by s, because J^T contributes a factor of
      s
    """
    U, s, Vt = np.linalg.svd(J, full_matrices=False)
    along = U.T @ e  # the singular directions of the hand

    def with_added(A):
        return J.T @ solve(J @ J.T + A, e)

    return {
        "relative-damping": dls_step(J, e, damping * s[0]),
        "damping-dropped": pinv(J) @ e,
        "damping-everywhere": with_added(damping**2),
        "transpose-only": J.T @ e,
        "pseudo-inverse-scaled": pinv(J) @ e / (1 + damping**2),
        "damping-fixed": with_added(0.05**2 * I6),
        "damping-added-to-the-values": Vt.T @ (along / (s + damping)),
        "damping-added-to-the-values 2": Vt.T @ (along / (s + damping**2)),
        "damping-as-a-cut": pinv(J, damping) @ e,
        "damping-as-a-cut 2": Vt.T @ np.where(s > damping, along / s, 0.0),
        "singular-value-missing": Vt.T @ (along / (s**2 + damping**2)),
        "singular-value-missing 2": Vt.T @ (along / (s**2 + damping**2) * (s > 1e-12)),
    }


@row.wrong("zero-without-damping", hidden="step 6 checks nothing")
def _(J, e, damping):
    return dls_step(J, e, damping) if damping else np.zeros(7)


# With J = [I 0] and damping 1 a minus leaves nothing to invert.
@row.wrong("slip-sign")
def _(J, e, damping):
    return J.T @ solve(J @ J.T - damping**2 * I6, e)


row.at_least_0(damping="it enters as a square")


row.spans(  # as small, or as large, as in the lab
    e=(
        lambda e: 2e-07 * e,
        lambda e: 6 * e,
    ),
)


@row.right  # By the singular values.
def _(J, e, damping):
    U, s, Vt = np.linalg.svd(J, full_matrices=False)
    along = U.T @ e  # e along the singular directions of the hand
    square = s**2 + damping**2  # squares of the singular values, damped
    gain = np.divide(s, square, out=np.zeros(6), where=square > 1e-24)
    return Vt.T @ (gain * along)  # the sum over the singular directions
