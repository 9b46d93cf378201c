"""13.2 `linearise(M, stiffness, damping, h)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .asked import definite, symmetric

row = Row((Matrix((None, None), called="A"), Matrix((None, None), called="B")))


@row.inputs
def _(rng):
    drawn = []
    for k in range(7):
        n = [2, 3, 7][k % 3]
        stiffness = symmetric(rng, n, 10)
        h = [0.1, 0.05, 0.2, 0.01][k % 4]
        drawn.append((definite(rng, n), stiffness, rng.numbers(0.2, 3, n), h))
    one = np.ones((1, 1))
    return [(one, 10 * one, np.array([1.0]), 0.1), *drawn]


def stepped(
    M, stiffness, damping, h, *, implicit=1.0, explicit=0.0, old=False, inv=None
):
    """Return A and B with the damping on either speed, and either speed in q+."""
    n = len(damping)
    D = np.diag(damping)
    inverse = np.linalg.inv(M + implicit * h * D) if inv is None else inv
    by_q = -h * inverse @ stiffness
    by_v = inverse @ (M - explicit * h * D)
    by_u = h * inverse
    one = np.eye(n)
    if old:
        return joined(one, h * one, by_q, by_v, 0 * by_u, by_u)
    return joined(one + h * by_q, h * by_v, by_q, by_v, h * by_u, by_u)


def joined(qq, qv, vq, vv, qu, vu):
    """Return A and B of their blocks."""
    return np.block([[qq, qv], [vq, vv]]), np.vstack([qu, vu])


def exact(A, B, h, terms=59):
    """Return the exponential's A and B of a step, by its series."""
    n, m = B.shape
    both = np.zeros((n + m, n + m))
    both[:n] = np.hstack([A, B])
    term = total = np.eye(n + m)
    for k in range(1, terms + 1):
        term = term @ (h * both) / k
        total = total + term
    return total[:n, :n], total[:n, n:]


@row.wrongs
def _(M, stiffness, damping, h):
    """slope-not-divided: your code uses the gravity stiffness as an acceleration per
      radian. Multiply it by (M + h D)^-1, because the stiffness is a torque per radian
    explicit-damping: your code applies the damping to the old velocity. Add h D to M
      instead, because MuJoCo's `implicitfast` applies the damping to the new velocity
    damping-twice: your code uses `(M + h D)^-1 (M - h D)`, which applies the damping to
      both the old and the new velocity. Use `(M + h D)^-1 M` instead, which applies the
      damping only to the new velocity
    damping-halved: your code applies half of the damping to the old velocity and half
      to the new one. Apply the whole damping to the new velocity
    position-first: your code moves the joints with the old velocity. Use h times the
      new velocity, because MuJoCo updates the velocity first
    half-h-squared: your code moves the joints by h v + h^2 a / 2. Use h times the new
      velocity instead, because MuJoCo updates the velocity first
    velocity-kept: your code omits the damping in the right half of A. The old velocity
      v should contribute (M + h D)^-1 M v to the new velocity
    velocity-kept 2: your code uses the identity matrix as the lower right block of A.
      Use (M + h D)^-1 M instead, because the damping reduces the velocity
    inverse-by-entry: your code inverts each entry of M + h D separately. Use the matrix
      inverse instead
    position-kept: your code uses the identity matrix as the upper left block of A.
      Subtract h^2 (M + h D)^-1 times the stiffness from this block, because gravity
      changes the new velocity, which moves the joints
    B-upper-zero: your code sets the upper half of B to 0. Use h times the lower half,
      because the new velocity moves the joints within the same step
    continuous: your code returns A and B of the continuous-time system x' = A x + B u.
      Return the matrices of one time step, x+ = A x + B u
    step-of-euler: your code returns A and B of the explicit Euler step x + h x'. Return
      the matrices of MuJoCo's semi-implicit step, in which the new velocity moves the
      joints
    identity-missing: your A gives only the change in the state. Add the identity
      matrix, because the new state is x plus this change
    halves-swapped: your code puts the velocities before the positions in the state. Use
      the order `(q - q0, qd)`
    A-rows-swapped: your code swaps the upper and the lower half of A. Put the rows of
      the positions first
    A-columns-swapped: your code swaps the left and the right half of A. Put the columns
      of the positions first
    B-swapped: your code swaps the upper and the lower half of B. Put the rows of the
      positions first
    exponential: your code computes the exact A and B with the matrix exponential.
      Return the matrices of MuJoCo's semi-implicit step instead
    exponential 2: your code computes A and B with the first terms of the matrix
      exponential. Return the matrices of MuJoCo's semi-implicit step instead
    slope-implicit: your code applies the gravity stiffness to the new position. Invert
      only M + h D, because MuJoCo computes the gravity torque at the old position
    damping-not-divided: your code does not divide the damping by the mass, and it
      applies the damping to the old velocity. Use (M + h D)^-1 M for the old velocity
      and (M + h D)^-1 in the other terms, so that the damping acts on the new velocity
      => both
    B-not-divided: your code omits the factor (M + h D)^-1 in B. Multiply by this
      factor, because the input is a torque and not an acceleration
    B-halved-below: your code multiplies the lower half of B by 1/2. Omit this factor,
      because the torque acts for the whole step
    B-without-damping: your code uses M^-1 in B, which omits the damping. Use (M + h
      D)^-1 instead
    slope-halved-above: your code halves the stiffness in the upper left block of A.
      Omit the factor of 1/2, because the new velocity moves the joints for the whole
      step
    B-halved-above: your code multiplies the upper half of B by 1/2. Omit this factor,
      because the new velocity moves the joints for the whole step
    upper-right-h: your code uses h times the identity matrix as the upper right block
      of A. Use h (M + h D)^-1 M instead, because the new velocity moves the joints
    upper-without-h: your code omits h in the upper half of A. Multiply the terms of the
      new velocity by h in this half, because the joints move by h times the new
      velocity
    """
    n = len(damping)
    one = np.eye(n)
    D = np.diag(damping)
    given = M, stiffness, damping, h
    A, B = stepped(*given)
    qq, qv, vq, vv = A[:n, :n], A[:n, n:], A[n:, :n], A[n:, n:]
    flip = np.roll(np.arange(2 * n), n)
    M_inv = np.linalg.inv(M)
    rate = joined(0 * one, one, -M_inv @ stiffness, -M_inv @ D, 0 * one, M_inv)
    v_mean = joined(one + h * vq / 2, h * (one + vv) / 2, vq, vv, h * B[n:] / 2, B[n:])
    return {
        "slope-not-divided": joined(
            one - h * h * stiffness, qv, -h * stiffness, vv, B[:n], B[n:]
        ),
        "explicit-damping": stepped(*given, implicit=0.0, explicit=1.0),
        "damping-twice": stepped(*given, explicit=1.0),
        "damping-halved": stepped(*given, implicit=0.5, explicit=0.5),
        "position-first": stepped(*given, old=True),
        "half-h-squared": v_mean,
        "velocity-kept": joined(qq, h * one, vq, one, B[:n], B[n:]),
        "velocity-kept 2": joined(qq, qv, vq, one, B[:n], B[n:]),
        "inverse-by-entry": stepped(*given, inv=1 / (M + h * D)),
        "position-kept": joined(one, qv, vq, vv, B[:n], B[n:]),
        "B-upper-zero": joined(qq, qv, vq, vv, 0 * B[:n], B[n:]),
        "continuous": rate,
        "step-of-euler": (np.eye(2 * n) + h * rate[0], h * rate[1]),
        "identity-missing": (A - np.eye(2 * n), B),
        "halves-swapped": (A[np.ix_(flip, flip)], B[flip]),
        "A-rows-swapped": (A[flip], B),
        "A-columns-swapped": (A[:, flip], B),
        "B-swapped": (A, B[flip]),
        "exponential": exact(*rate, h),
        "exponential 2": exact(*rate, h, terms=2),
        "slope-implicit": stepped(
            M, stiffness, damping, h, inv=np.linalg.inv(M + h * D + h * h * stiffness)
        ),
        "damping-not-divided": joined(
            one - h * h * M_inv @ stiffness,
            h * (one - h * D),
            -h * M_inv @ stiffness,
            one - h * D,
            h * h * M_inv,
            h * M_inv,
        ),
        "B-not-divided": (A, np.vstack([h * h * one, h * one])),
        "B-halved-below": (A, np.vstack([B[:n], B[n:] / 2])),
        "B-without-damping": (A, np.vstack([h * h * M_inv, h * M_inv])),
        "slope-halved-above": joined(one + h * vq / 2, qv, vq, vv, B[:n], B[n:]),
        "B-halved-above": (A, np.vstack([B[:n] / 2, B[n:]])),
        "upper-right-h": joined(qq, h * one, vq, vv, B[:n], B[n:]),
        "upper-without-h": joined(one + vq, vv, vq, vv, B[:n], B[n:]),
    }


row.at_least_0(damping="a damping", h="a time")


@row.right  # Column by column: what one step makes of each unit state and input.
def _(M, stiffness, damping, h):
    n = len(damping)

    def step(q, v, u):
        v = np.linalg.solve(M + h * np.diag(damping), M @ v - h * stiffness @ q + h * u)
        return np.concatenate([q + h * v, v])

    zero = np.zeros(n)
    one = np.eye(n)
    by_q = [step(e, zero, zero) for e in one]
    by_v = [step(zero, e, zero) for e in one]
    by_u = [step(zero, zero, e) for e in one]
    return np.column_stack([*by_q, *by_v]), np.column_stack(by_u)


row.spans(  # as small, or as large, as in the lab
    stiffness=(lambda stiffness: 5 * stiffness,),
    h=(0.002,),
)
