"""Control as the answer to a question: what costs least, alone or within limits?

Three questions, and how an answer is checked without knowing how it was found:

- LQR, `x . P x`: the optimal cost-to-go near an equilibrium, without limits. The
  simulation's cost equals the prediction.
- A quadratic in a box, `x . H x / 2 + f . x` with lo <= x <= hi: a step of inverse
  kinematics whose joints have limits. `kkt_residual` is 0 at the best x and nowhere
  else.
- iLQR's backward pass: the first again, with slopes in it, along a motion.
  `reduction_ratio` holds what a step saved against what it should have saved.

Conventions: x = (q - q0, qd), so (2 n,); u is what is added to the torque that holds
q0. Twists (omega; v), world axes, J_space (6, n); gravity is the vector (0, 0, -9.81).
Radians, metres, kilograms, newtons, seconds; costs have the unit of their weights.

Sources: Anderson and Moore, *Optimal Control: Linear Quadratic Methods* (1990), chapter
2; Boyd and Vandenberghe, *Convex Optimization* (2004), sections 5.5 and 5.6; Nocedal
and Wright, *Numerical Optimization* (2006), section 16.5; Tassa, Erez and Todorov,
"Synthesis and stabilization of complex behaviors through online trajectory
optimization" (2012).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robo47 import checks
from robo47.checks import Array
from robo47.dynamics import gravity_torque

STEPS = 100  # of `box_qp`, at most; a box of seven takes about ten
ROUNDING = 1e-14  # of an entry's size: who leaves by less may stay


def gravity_stiffness(
    J_space: ArrayLike, masses: ArrayLike, coms: ArrayLike, g: ArrayLike
) -> Array:
    """Return how the torque of gravity changes when a joint turns.

    Joint j turns all that follows it; seen from there gravity turns back, and changes
    by g x omega_j. So for i >= j the entry is `gravity_torque` of joint i with that for
    g; as the second derivative of an energy the matrix is symmetric.

    Args:
        J_space: space Jacobian, (6, n).
        masses: kg, (n,).
        coms: centres of mass in the world, metres, (n, 3).
        g: gravity, m/s^2, (3,).

    Returns:
        d(gravity torque) / dq, N m/rad, (n, n).

    Raises:
        ValueError: wrong shape, a non-finite number, or g is one number.
    """
    J = checks.array(J_space, "J_space", (6, "n"))
    if np.ndim(g) == 0:
        raise ValueError(f"g is the number {g!r}; expected a vector: (0, 0, -9.81)")
    turned = np.cross(checks.array(g, "g", (3,)), J[:3].T)  # one per joint, (n, 3)
    columns = [gravity_torque(J, masses, coms, one) for one in turned]
    lower = np.tril(np.column_stack(columns))
    return lower + np.tril(lower, -1).T


def linearise(
    M: ArrayLike, stiffness: ArrayLike, damping: ArrayLike, h: float
) -> tuple[Array, Array]:
    """Return one time step of the simulator near an equilibrium, x+ = A x + B u.

    MuJoCo's integrator "implicitfast": the damping acts on the new speed, and the new
    speed moves the joints,

        (M + h D) v+ = M v + h (u - stiffness q)        q+ = q + h v+

    At rest M's own slope is multiplied by an acceleration of 0.

    Args:
        M: mass matrix with armature, kg m^2, (n, n).
        stiffness: d(gravity torque) / dq, N m/rad, (n, n).
        damping: of the joints, N m s/rad, (n,).
        h: time step, s.

    Returns:
        A, (2 n, 2 n), and B, (2 n, n), for x = (q - q0, qd).

    Raises:
        ValueError: wrong shape, a non-finite number, or a step that is not above 0.
    """
    damping = checks.array(damping, "damping", ("n",))
    n = len(damping)
    M = checks.array(M, "M", (n, n))
    stiffness = checks.array(stiffness, "stiffness", (n, n))
    step = float(checks.positive(h, "h"))
    implicit = M + step * np.diag(damping)
    # How the new speed depends on (q, v, u).
    q_v_u = np.linalg.solve(
        implicit, np.hstack([-step * stiffness, M, step * np.eye(n)])
    )
    now = np.hstack([np.eye(n), np.zeros((n, 2 * n))])
    both = np.vstack([now + step * q_v_u, q_v_u])
    return both[:, : 2 * n], both[:, 2 * n :]


def riccati_step(
    P: ArrayLike, A: ArrayLike, B: ArrayLike, Q: ArrayLike, R: ArrayLike
) -> tuple[Array, Array]:
    """Return the cost-to-go one time step earlier, and the optimal gain.

    If the rest costs x . P x, this step and the rest cost least with u = -K x (Anderson
    and Moore, section 2.4):

        K = (R + B^T P B)^-1 B^T P A        P = Q + A^T P (A - B K)

    Args:
        P: cost of what comes after, symmetric, (n, n).
        A, B: of the step x+ = A x + B u, (n, n) and (n, m).
        Q, R: cost of the step, x . Q x + u . R u, symmetric, (n, n) and (m, m).

    Returns:
        The new P, (n, n), and K, (m, n).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    B = checks.array(B, "B", ("n", "m"))
    n, m = B.shape
    P = checks.array(P, "P", (n, n))
    A = checks.array(A, "A", (n, n))
    Q = checks.array(Q, "Q", (n, n))
    R = checks.array(R, "R", (m, m))
    K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
    earlier = Q + A.T @ P @ (A - B @ K)
    P = 0.5 * (earlier + earlier.T)  # rounding would add up over many steps
    return P, K.astype(np.float64, copy=False)


def cost_to_go(P: ArrayLike, x: ArrayLike) -> float:
    """Return the cost-to-go of a start at x, predicted by P: x . P x.

    Args:
        P: from `riccati_step`, (n, n).
        x: state, (n,).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    x = checks.array(x, "x", ("n",))
    return float(x @ checks.array(P, "P", (len(x), len(x))) @ x)


def kkt_residual(
    H: ArrayLike, f: ArrayLike, lo: ArrayLike, hi: ArrayLike, x: ArrayLike
) -> float:
    """Return how much x violates the optimality conditions (KKT) of a QP in a box.

    x is pushed downhill by its slope H x + f and clipped: it comes back to x where it
    is best, and only there (Boyd and Vandenberghe, section 5.5.3, for a box).

    Args:
        H: symmetric and positive definite, (n, n).
        f: (n,).
        lo, hi: the box, (n,) each; equal where an entry is fixed.
        x: any point, (n,).

    Returns:
        The largest difference between x and where it comes back, 0 or more.

    Raises:
        ValueError: wrong shape, a non-finite number, or lo above hi.
    """
    A, b, low, high, at = _box(H, f, lo, hi, x)
    return float(np.abs(at - np.clip(at - (A @ at + b), low, high)).max())


def box_qp(
    H: ArrayLike, f: ArrayLike, lo: ArrayLike, hi: ArrayLike, x: ArrayLike
) -> Array:
    """Return the minimiser of x . H x / 2 + f . x in a box.

    The primal active-set method (Nocedal and Wright, section 16.5): go towards what is
    best for the free entries, and hold the first that meets its limit. Where none does,
    `kkt_residual`'s push says which of the held ones wants to leave; the end is where
    none does. Each set is left for one that costs less, so it ends.

    Args:
        H: symmetric and positive definite, (n, n).
        f: (n,).
        lo, hi: the box, (n,) each; equal where an entry is fixed.
        x: where to start, (n,); the answer is the same from anywhere.

    Returns:
        The best point, (n,).

    Raises:
        ValueError: wrong shape, a non-finite number, or lo above hi.
    """
    H, f, lo, hi, x = _box(H, f, lo, hi, x)
    x = np.clip(x, lo, hi)
    held = lo == hi
    for _ in range(STEPS):
        free = ~held
        step = np.zeros_like(x)
        step[free] = np.linalg.solve(H[np.ix_(free, free)], -(H @ x + f)[free])
        x, met = _until_a_limit(x, step, lo, hi)
        if met is not None:
            held[met] = True
            continue
        leaves = np.abs(x - np.clip(x - (H @ x + f), lo, hi))
        first = int(np.argmax(leaves))
        if not held[first] or leaves[first] <= ROUNDING * (1.0 + np.abs(x).max()):
            break
        held[first] = False
    return x


def qp_ik(
    J: ArrayLike, e: ArrayLike, weights: ArrayLike, damping: float, dq_lo: ArrayLike,
    dq_hi: ArrayLike,
) -> Array:  # fmt: skip
    """Return the step of inverse kinematics that is best within limits.

    The dq that makes (J dq - e) . W (J dq - e) + damping^2 |dq|^2 least: half of it is
    `box_qp`'s, with H = J^T W J + damping^2 and f = -J^T W e.

    Args:
        J: Jacobian, (6, n).
        e: what the hand should move by, (6,): a twist or a pose error, as J.
        weights: of the rows of J dq - e, (6,), none below 0: what each is worth.
        damping: above 0, so that the best dq is one.
        dq_lo, dq_hi: limits of dq, (n,) each.

    Returns:
        dq, (n,).

    Raises:
        ValueError: wrong shape, a non-finite number, a damping that is not above 0, a
            weight below 0, or dq_lo above dq_hi.
    """
    J = checks.array(J, "J", (6, "n"))
    e = checks.array(e, "e", (6,))
    weighted = J.T * checks.not_negative(
        checks.array(weights, "weights", (6,)), "weights"
    )
    damp = float(checks.positive(damping, "damping"))
    n = J.shape[1]
    H = weighted @ J + damp**2 * np.eye(n)
    return box_qp(H, -weighted @ e, dq_lo, dq_hi, np.zeros(n))


def ilqr_backward(
    fx: ArrayLike, fu: ArrayLike, lx: ArrayLike, lu: ArrayLike, lxx: ArrayLike,
    luu: ArrayLike, lux: ArrayLike, Vx: ArrayLike, Vxx: ArrayLike, mu: float,
) -> tuple[Array, Array, Array]:  # fmt: skip
    """Return how to change a motion's inputs so that it costs less: du = k + K dx.

    `riccati_step` with slopes, from the last step to the first. The cost of a step and
    all that follows is a quadratic in (dx, du); its least is at

        k = -Quu^-1 Qu        K = -Quu^-1 Qux        Quu = luu + fu^T Vxx fu + mu

    (Tassa, Erez and Todorov, 2012, equations 5 to 11, with mu in Quu throughout).

    Args:
        fx, fu: slopes of the steps, (T, n, n) and (T, n, m).
        lx, lu: slopes of their costs, (T, n) and (T, m).
        lxx, luu, lux: second ones, (T, n, n), (T, m, m) and (T, m, n).
        Vx, Vxx: slope and second slope of the cost of the end, (n,) and (n, n).
        mu: is added to Quu, 0 or more: smaller steps of u.

    Returns:
        k, (T, m); K, (T, m, n); and drop, (2,): what the cost changes by, to first and
        to second order in k. `expected_reduction` takes it.

    Raises:
        ValueError: wrong shape, a non-finite number, or mu below 0.
    """
    fu = checks.array(fu, "fu", ("T", "n", "m"))
    T, n, m = fu.shape
    fx = checks.array(fx, "fx", (T, n, n))
    lx, lu = checks.array(lx, "lx", (T, n)), checks.array(lu, "lu", (T, m))
    lxx, luu = checks.array(lxx, "lxx", (T, n, n)), checks.array(luu, "luu", (T, m, m))
    lux = checks.array(lux, "lux", (T, m, n))
    slope = checks.array(Vx, "Vx", (n,))  # of what the rest costs, in dx; and ...
    second = checks.array(Vxx, "Vxx", (n, n))  # ... its second one
    more = float(checks.not_negative(mu, "mu")) * np.eye(m)
    k, K, drop = np.empty((T, m)), np.empty((T, m, n)), np.zeros(2)
    for t in reversed(range(T)):
        Qx = lx[t] + fx[t].T @ slope
        Qu = lu[t] + fu[t].T @ slope
        Qxx = lxx[t] + fx[t].T @ second @ fx[t]
        Quu = luu[t] + fu[t].T @ second @ fu[t] + more
        Qux = lux[t] + fu[t].T @ second @ fx[t]
        best = -np.linalg.solve(Quu, np.column_stack([Qu, Qux]))
        k[t] = best[:, 0]
        K[t] = best[:, 1:]
        drop += k[t] @ Qu, 0.5 * k[t] @ Quu @ k[t]
        slope = Qx + Qux.T @ k[t]  # what K^T (Qu + Quu k) adds is 0
        second = Qxx + Qux.T @ K[t]
        second = 0.5 * (second + second.T)
    return k, K, drop


def expected_reduction(dV: ArrayLike, alpha: float) -> float:
    """Return what a step of length alpha should save.

    Args:
        dV: from `ilqr_backward`, (2,).
        alpha: the fraction of k that is taken, 0 to 1.

    Returns:
        -(alpha dV[0] + alpha^2 dV[1]), in the cost's unit.

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    first, second = checks.array(dV, "dV", (2,))
    share = float(checks.array(alpha, "alpha", ()))
    return float(-(share * first + share**2 * second))


def reduction_ratio(before: float, after: float, expected: float) -> float:
    """Return the ratio of a step's actual and expected reduction of the cost.

    Args:
        before, after: the cost without and with the step.
        expected: from `expected_reduction`, not 0.

    Returns:
        1 where the model is right; under 0 where the step did harm.

    Raises:
        ValueError: a non-finite number, or nothing was expected.
    """
    saved = checks.array(before, "before", ()) - checks.array(after, "after", ())
    promised = checks.array(expected, "expected", ())
    if promised == 0.0:
        raise ValueError("expected is 0: no step was promised, so there is no ratio")
    return float(saved / promised)


def bound_multipliers(
    H: ArrayLike, f: ArrayLike, lo: ArrayLike, hi: ArrayLike, x: ArrayLike
) -> Array:
    """Return the multipliers of the limits: d(minimum cost) / d(limit).

    Only the limit's own term of the cost moves with it (the envelope theorem; Boyd and
    Vandenberghe, section 5.6.3): the slope H x + f where a limit holds x back.

    Args:
        H, f, lo, hi: as in `box_qp`.
        x: the best point, (n,).

    Returns:
        d(minimum cost) / d(limit), (n,): above 0 at a lower limit, below 0 at an upper
        one, 0 where none holds.

    Raises:
        ValueError: wrong shape, a non-finite number, or lo above hi.
    """
    H, f, lo, hi, x = _box(H, f, lo, hi, x)
    slope = H @ x + f
    return np.where(_held(slope, lo, hi, x), slope, 0.0)


def _box(
    H: ArrayLike, g: ArrayLike, lo: ArrayLike, hi: ArrayLike, x: ArrayLike
) -> tuple[Array, Array, Array, Array, Array]:
    """Return a quadratic, its box and a point, checked."""
    g = checks.array(g, "g", ("n",))
    n = len(g)
    H = checks.array(H, "H", (n, n))
    lo = checks.array(lo, "lo", (n,))
    hi = checks.array(hi, "hi", (n,))
    if np.any(lo > hi):
        raise ValueError("lo is above hi: the box is empty")
    return H, g, lo, hi, checks.array(x, "x", (n,))


def _held(slope: Array, lo: Array, hi: Array, x: Array) -> NDArray[np.bool_]:
    """Return which entries stand at a limit and are pushed there."""
    return ((x <= lo) & (slope > 0.0)) | ((x >= hi) & (slope < 0.0))


def _until_a_limit(
    x: Array, step: Array, lo: Array, hi: Array
) -> tuple[Array, int | None]:
    """Return x after a step, or where it first meets a limit, and which entry does."""
    room = np.where(step > 0.0, hi - x, lo - x)
    share = np.divide(room, step, out=np.full_like(x, np.inf), where=step != 0.0)
    met = int(np.argmin(share))
    if share[met] >= 1.0:
        return np.clip(x + step, lo, hi), None
    there = x + share[met] * step
    there[met] = hi[met] if step[met] > 0.0 else lo[met]  # no rounding beside it
    return np.clip(there, lo, hi), met
