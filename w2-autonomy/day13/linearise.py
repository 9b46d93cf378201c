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
    """slope-sign: gravity's slope has the wrong sign: what holds the arm grows by it,
      so it pulls with a minus => with -stiffness
    slope-forgotten: gravity's slope is missing: the torque that holds the arm is that
      of q0, and elsewhere it does not fit => with stiffness 0
    slope-not-divided: the slope is a torque, and here it is taken for an acceleration:
      M + h D divides it => with -h stiffness
    explicit-damping: the damping acts on the old speed; MuJoCo's implicitfast lets it
      act on the new one: it stands with M on the left => with M^-1 (M - h D)
    damping-forgotten: the damping is missing
    damping-without-h: the damping is added to M without h => with M + D
    damping-sign: the damping has the wrong sign: it would drive the arm => with M - h D
    damping-twice: the damping acts on both speeds => with (M + h D)^-1 (M - h D)
    damping-halved: half of the damping acts on either speed; here all of it acts on the
      new one
    mean-damping: all joints have the mean damping => with one damping for all
    damping-of-the-first: all joints have the first one's damping
    damping-squared: h D is taken twice: in M + h D, and once more in h
    position-first: the old speed moves the joints; in MuJoCo the new one does => q+ = q
      + h v
    half-h-squared: the joints move by h v + h^2 a / 2; in MuJoCo the new speed moves
      them for all of h => with the mean of both speeds
    velocity-kept: in the right half of A stands 1; the damping brakes: (M + h D)^-1 M
    velocity-kept 2: in the lower right of A stands 1; the damping brakes: (M + h D)^-1
      M
    M-for-inverse: M + h D multiplies; it divides => with M + h D for its inverse
    inverse-by-entry: each entry of M + h D is inverted by itself; it is the inverse of
      the matrix => with 1 / (M + h D)
    slope-from-the-right: the slope stands before (M + h D)^-1; matrices do not change
      places => with -h stiffness (M + h D)^-1
    M-from-the-right: M stands before (M + h D)^-1; matrices do not change places =>
      with M (M + h D)^-1
    position-kept: in the upper left of A stands 1: the slope moves the joints within
      the step, too
    B-upper-zero: u does not move the joints within the step; the new speed does
    h-forgotten-in-B: h is missing in B: a torque is no impulse => B without h
    h-forgotten-in-the-slope: h is missing before the slope
    continuous: these are the slopes of the accelerations, and no step of h => A and B
      of x' = A x + B u
    step-of-euler: that is x + h x', with the old speed in both => 1 + h A
    identity-missing: these are the changes: x itself is missing => A - 1
    halves-swapped: positions and velocities are swapped: x is (q - q0, qd)
    A-rows-swapped: in A the rows of q and of v are swapped: q comes first
    A-columns-swapped: in A the columns of q and of v are swapped: q comes first
    B-swapped: in B the rows of q and of v are swapped: q comes first
    A-transposed: A is transposed
    A-diagonal-M: M is taken for its diagonal
    exponential: these are the exact ones of the motion in continuous time; MuJoCo's
      step is not => with the exponential of h times the slopes
    exponential 2: these are the first terms of the exact ones of the motion in
      continuous time; MuJoCo's step is not => with 1 + h A + h^2 A^2 / 2
    slope-implicit: the slope acts on the new position; in MuJoCo it acts on the old one
      => with M + h D + h^2 stiffness
    damping-not-diagonal: damping is added to every row of M; it belongs on the diagonal
      => with M + h damping
    damping-not-divided: the damping is not divided by M, and acts on the old speed
      => with 1 - h D in the lower right
    B-not-divided: B is not divided by M + h D: u is a torque, and no acceleration
    B-halved-below: the lower half of B is halved; a torque acts for all of h
    B-without-damping: in B the damping is missing in the inverse => with M^-1 in B
    M-forgotten-in-A: in the right half of A M is missing: the old momentum is M v =>
      with (M + h D)^-1 alone
    h-twice-in-B: h is multiplied twice: (M + h D)^-1 h u is the change of the speed
    diagonal-of-the-slope: of the slope only the diagonal is used => with its diagonal
    slope-halved-above: in the upper left of A the slope is halved: the new speed moves
      the joints for all of h
    B-halved-above: the upper half of B is h^2 / 2; the new speed moves the joints for
      all of h
    upper-right-h: in the upper right of A stands h; the new speed is (M + h D)^-1 M v
    upper-without-h: in the upper half of A the new speed moves the joints without h
    upper-left-without-1: in the upper left of A the 1 is missing: q+ begins with q
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
    no_h = vq / h
    return {
        "slope-sign": stepped(M, -stiffness, damping, h),
        "slope-forgotten": stepped(M, 0 * stiffness, damping, h),
        "slope-not-divided": joined(
            one - h * h * stiffness, qv, -h * stiffness, vv, B[:n], B[n:]
        ),
        "explicit-damping": stepped(*given, implicit=0.0, explicit=1.0),
        "damping-forgotten": stepped(*given, implicit=0.0),
        "damping-without-h": stepped(*given, implicit=1 / h),
        "damping-sign": stepped(*given, implicit=-1.0),
        "damping-twice": stepped(*given, explicit=1.0),
        "damping-halved": stepped(*given, implicit=0.5, explicit=0.5),
        "mean-damping": stepped(M, stiffness, 0 * damping + damping.mean(), h),
        "damping-of-the-first": stepped(M, stiffness, 0 * damping + damping[0], h),
        "damping-squared": stepped(*given, implicit=h),
        "position-first": stepped(*given, old=True),
        "half-h-squared": v_mean,
        "velocity-kept": joined(qq, h * one, vq, one, B[:n], B[n:]),
        "velocity-kept 2": joined(qq, qv, vq, one, B[:n], B[n:]),
        "M-for-inverse": stepped(*given, inv=M + h * D),
        "inverse-by-entry": stepped(*given, inv=1 / (M + h * D)),
        "slope-from-the-right": joined(
            one - h * h * stiffness @ B[n:] / h,
            qv,
            -h * stiffness @ B[n:] / h,
            vv,
            B[:n],
            B[n:],
        ),
        "M-from-the-right": joined(qq, M @ B[n:], vq, M @ B[n:] / h, B[:n], B[n:]),
        "position-kept": joined(one, qv, vq, vv, B[:n], B[n:]),
        "B-upper-zero": joined(qq, qv, vq, vv, 0 * B[:n], B[n:]),
        "h-forgotten-in-B": (A, B / h),
        "h-forgotten-in-the-slope": joined(one + h * no_h, qv, no_h, vv, B[:n], B[n:]),
        "continuous": rate,
        "step-of-euler": (np.eye(2 * n) + h * rate[0], h * rate[1]),
        "identity-missing": (A - np.eye(2 * n), B),
        "halves-swapped": (A[np.ix_(flip, flip)], B[flip]),
        "A-rows-swapped": (A[flip], B),
        "A-columns-swapped": (A[:, flip], B),
        "B-swapped": (A, B[flip]),
        "A-transposed": (A.T, B),
        "A-diagonal-M": stepped(np.diag(np.diag(M)), stiffness, damping, h),
        "exponential": exact(*rate, h),
        "exponential 2": exact(*rate, h, terms=2),
        "slope-implicit": stepped(
            M, stiffness, damping, h, inv=np.linalg.inv(M + h * D + h * h * stiffness)
        ),
        "damping-not-diagonal": stepped(*given, inv=np.linalg.inv(M + h * damping)),
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
        "M-forgotten-in-A": joined(qq, B[n:], vq, B[n:] / h, B[:n], B[n:]),
        "h-twice-in-B": (A, h * B),
        "diagonal-of-the-slope": stepped(M, np.diag(np.diag(stiffness)), damping, h),
        "slope-halved-above": joined(one + h * vq / 2, qv, vq, vv, B[:n], B[n:]),
        "B-halved-above": (A, np.vstack([B[:n] / 2, B[n:]])),
        "upper-right-h": joined(qq, h * one, vq, vv, B[:n], B[n:]),
        "upper-without-h": joined(one + vq, vv, vq, vv, B[:n], B[n:]),
        "upper-left-without-1": joined(qq - one, qv, vq, vv, B[:n], B[n:]),
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
