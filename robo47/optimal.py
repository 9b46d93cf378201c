"""Optimal control: LQR, box-constrained quadratic programs and iLQR's backward pass.

Each result can be verified without knowledge of the method that computed it:

- LQR gives the minimum cost x . P x of holding an equilibrium, without limits. A
  simulation measures the same cost.
- A box-constrained quadratic program (QP) minimises x . H x / 2 + f . x with lo <= x <=
  hi, for example a step of inverse kinematics within joint limits. Its `kkt_residual`
  is 0 at the minimiser only.
- iLQR's backward pass is the LQR recursion along a motion, with gradients of the cost.
  `reduction_ratio` compares the measured reduction of the cost with the expected one.

Conventions: the state is x = (q - q0, qd), (2 n,), and u is added to the torque that
holds the equilibrium q0. Twists are (omega; v), expressed in the world frame; J_space
is (6, n); gravity is the vector (0, 0, -9.81). Radians, metres, kilograms, newtons,
seconds; costs have the unit of their weights.

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

# The most steps of `box_qp`, and more for each entry; seven take about ten.
STEPS = 100, 10
# A KKT residual below this fraction of an entry's size is a rounding error.
ROUNDING = 1e-14


def gravity_stiffness(
    J_space: ArrayLike, masses: ArrayLike, coms: ArrayLike, g: ArrayLike
) -> Array:
    """Return the gravity stiffness, the derivative of the gravity torque in q.

    The gravity torque is the one that holds the arm against its weight. Rotating joint
    j rotates all links that are distal to it. Relative to these links, gravity rotates
    back and changes by g x omega_j per radian. For i >= j the entry is therefore
    `gravity_torque` of joint i with g x omega_j in place of g. The matrix is symmetric,
    because it is the second derivative of the potential energy.

    Args:
        J_space: space Jacobian, (6, n).
        masses: kg, (n,).
        coms: centres of mass in the world frame, metres, (n, 3).
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
    """Return A and B of one time step near an equilibrium, x+ = A x + B u.

    This is MuJoCo's integrator "implicitfast": the damping D acts on the new velocity,
    and the new velocity moves the joints,

        (M + h D) v+ = M v + h (u - stiffness q)        q+ = q + h v+

    The derivative of M has no effect at an equilibrium, because the acceleration that
    it multiplies is 0.

    Args:
        M: mass matrix with armature, kg m^2, (n, n).
        stiffness: d(gravity torque) / dq, N m/rad, (n, n).
        damping: of the joints, N m s/rad, (n,).
        h: time step, s.

    Returns:
        A, (2 n, 2 n), and B, (2 n, n), for x = (q - q0, qd), with the positions first,
        and u, the torque in addition to the torque that holds the arm at q0.

    Raises:
        ValueError: wrong shape, a non-finite number, or a step that is not above 0.
    """
    damping = checks.array(damping, "damping", ("n",))
    n = len(damping)
    M = checks.array(M, "M", (n, n))
    stiffness = checks.array(stiffness, "stiffness", (n, n))
    step = float(checks.positive(h, "h"))
    implicit = M + step * np.diag(damping)
    # The derivative of the new velocity by (q, v, u).
    q_v_u = np.linalg.solve(
        implicit, np.hstack([-step * stiffness, M, step * np.eye(n)])
    )
    now = np.hstack([np.eye(n), np.zeros((n, 2 * n))])
    both = np.vstack([now + step * q_v_u, q_v_u])
    return both[:, : 2 * n], both[:, 2 * n :]


def riccati_step(
    P: ArrayLike, A: ArrayLike, B: ArrayLike, Q: ArrayLike, R: ArrayLike
) -> tuple[Array, Array]:
    """Return the cost-to-go matrix one time step earlier, and the optimal gain.

    If the cost-to-go of the next state is x . P x, the input u = -K x minimises the sum
    of this step's cost and the cost-to-go (Anderson and Moore, section 2.4):

        K = (R + B^T P B)^-1 B^T P A        P = Q + A^T P (A - B K)

    Args:
        P: cost-to-go matrix of the next state, symmetric, (n, n).
        A, B: of the step x+ = A x + B u, (n, n) and (n, m).
        Q, R: cost of the step, x . Q x + u . R u, symmetric, (n, n) and (m, m).

    Returns:
        P of the current state, (n, n), and K, (m, n).

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
    """Return the cost-to-go x . P x: the predicted cost from the state x on.

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
    """Return the KKT residual of x for the minimum of x . H x / 2 + f . x in a box.

    Move x by minus the gradient H x + f and clamp it to the box. This point equals x at
    the minimiser only (Boyd and Vandenberghe, section 5.5.3, for a box). The residual
    is not the distance to the minimiser.

    Args:
        H: symmetric and positive definite, (n, n).
        f: (n,).
        lo, hi: lower and upper bounds, (n,) each; equal where an entry is fixed.
        x: any point, (n,).

    Returns:
        The largest absolute difference between x and the clamped point, 0 or more.

    Raises:
        ValueError: wrong shape, a non-finite number, or lo above hi.
    """
    A, b, low, high, at = _box(H, f, lo, hi, x)
    return float(np.abs(at - np.clip(at - (A @ at + b), low, high)).max())


def box_qp(
    H: ArrayLike, f: ArrayLike, lo: ArrayLike, hi: ArrayLike, x: ArrayLike
) -> Array:
    """Return the minimiser of x . H x / 2 + f . x with lo <= x <= hi.

    The primal active-set method (Nocedal and Wright, section 16.5): move towards the
    minimiser over the free entries, and hold the first entry that meets a bound. If no
    entry meets one, release the held entry with the largest `kkt_residual`; if this is
    0, x is the minimiser. The minimum cost over the free entries falls from one such
    point to the next, so no set of held entries returns.

    Args:
        H: symmetric and positive definite, (n, n).
        f: (n,).
        lo, hi: lower and upper bounds, (n,) each; equal where an entry is fixed.
        x: start, (n,), which may lie outside the bounds; the minimiser does not depend
            on it.

    Returns:
        The minimiser, (n,).

    Raises:
        ValueError: wrong shape, a non-finite number, lo above hi, or no minimiser after
            100 + 10 n iterations.
    """
    H, f, lo, hi, x = _box(H, f, lo, hi, x)
    x = np.clip(x, lo, hi)
    held = lo == hi
    most = STEPS[0] + STEPS[1] * len(x)
    for _ in range(most):
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
            return x
        held[first] = False
    raise ValueError(f"box_qp found no minimiser in {most} iterations: scale H and f")


def qp_ik(
    J: ArrayLike, e: ArrayLike, weights: ArrayLike, damping: float, dq_lo: ArrayLike,
    dq_hi: ArrayLike,
) -> Array:  # fmt: skip
    """Return the inverse-kinematics step that is optimal within bounds.

    It minimises (J dq - e) . W (J dq - e) + damping^2 |dq|^2. Half of this is the cost
    of `box_qp` with H = J^T W J + damping^2 1 and f = -J^T W e.

    Args:
        J: Jacobian, (6, n).
        e: wanted motion of the hand as a twist or a pose error, (6,), in the frame of
            the Jacobian.
        weights: diagonal of W, one weight for each row of J dq - e, (6,), not negative.
        damping: above 0, so that the minimiser is unique.
        dq_lo, dq_hi: lower and upper bounds of dq, (n,) each.

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
    """Return iLQR's backward pass: the changes k and gains K of the inputs, and dV.

    This is `riccati_step` with gradients, from the last step to the first. The cost of
    a step and all steps after it is a quadratic function of (dx, du), whose minimum
    over du = k + K dx is at

        k = -Quu^-1 Qu        K = -Quu^-1 Qux        Quu = luu + fu^T Vxx fu + mu E

    with the identity E (Tassa, Erez and Todorov, 2012, equations 5 to 11, with mu
    wherever Quu appears).

    Args:
        fx, fu: derivatives of the steps, (T, n, n) and (T, n, m).
        lx, lu: gradients of the steps' costs, (T, n) and (T, m).
        lxx, luu, lux: second derivatives, (T, n, n), (T, m, m) and (T, m, n).
        Vx, Vxx: gradient and second derivative of the final cost, (n,) and (n, n).
        mu: is added to the diagonal of Quu, 0 or more; a larger mu makes k smaller.

    Returns:
        k, (T, m); K, (T, m, n); and dV, (2,): the change of the cost to first and to
        second order in k. `expected_reduction` takes dV.

    Raises:
        ValueError: wrong shape, a non-finite number, or mu below 0.
    """
    fu = checks.array(fu, "fu", ("T", "n", "m"))
    T, n, m = fu.shape
    fx = checks.array(fx, "fx", (T, n, n))
    lx, lu = checks.array(lx, "lx", (T, n)), checks.array(lu, "lu", (T, m))
    lxx, luu = checks.array(lxx, "lxx", (T, n, n)), checks.array(luu, "luu", (T, m, m))
    lux = checks.array(lux, "lux", (T, m, n))
    slope = checks.array(Vx, "Vx", (n,))  # gradient of the cost-to-go, and ...
    second = checks.array(Vxx, "Vxx", (n, n))  # ... its second derivative
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
        slope = Qx + Qux.T @ k[t]  # the term K^T (Qu + Quu k) is 0
        second = Qxx + Qux.T @ K[t]
        second = 0.5 * (second + second.T)
    return k, K, drop


def expected_reduction(dV: ArrayLike, alpha: float) -> float:
    """Return the expected reduction of the cost for the step alpha k.

    Args:
        dV: from `ilqr_backward`, (2,).
        alpha: the fraction of k that is applied, 0 to 1.

    Returns:
        -(alpha dV[0] + alpha^2 dV[1]), in the unit of the cost; positive if the cost is
        expected to fall.

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    first, second = checks.array(dV, "dV", (2,))
    share = float(checks.array(alpha, "alpha", ()))
    return float(-(share * first + share**2 * second))


def reduction_ratio(before: float, after: float, expected: float) -> float:
    """Return the reduction ratio: the measured reduction over the expected one.

    Args:
        before, after: the cost before and after the step.
        expected: from `expected_reduction`, not 0.

    Returns:
        1 if the quadratic model is exact; negative if the step increased the cost.

    Raises:
        ValueError: a non-finite number, or an expected reduction of 0.
    """
    saved = checks.array(before, "before", ()) - checks.array(after, "after", ())
    wanted = checks.array(expected, "expected", ())
    if wanted == 0.0:
        raise ValueError("expected is 0, so there is no ratio: take another step")
    return float(saved / wanted)


def bound_multipliers(
    H: ArrayLike, f: ArrayLike, lo: ArrayLike, hi: ArrayLike, x: ArrayLike
) -> Array:
    """Return the Lagrange multipliers of the bounds: d(minimum cost) / d(bound).

    When a bound moves, only its own term of the cost changes (the envelope theorem;
    Boyd and Vandenberghe, section 5.6.3). The multiplier is therefore the gradient H x
    + f where a bound holds the entry.

    Args:
        H, f, lo, hi: as in `box_qp`.
        x: the minimiser, (n,).

    Returns:
        The multipliers, (n,): positive at a lower bound, negative at an upper bound, 0
        for a free entry.

    Raises:
        ValueError: wrong shape, a non-finite number, or lo above hi.
    """
    H, f, lo, hi, x = _box(H, f, lo, hi, x)
    slope = H @ x + f
    return np.where(_held(slope, lo, hi, x), slope, 0.0)


def _box(
    H: ArrayLike, g: ArrayLike, lo: ArrayLike, hi: ArrayLike, x: ArrayLike
) -> tuple[Array, Array, Array, Array, Array]:
    """Return a quadratic cost, its bounds and a point, checked."""
    g = checks.array(g, "g", ("n",))
    n = len(g)
    H = checks.array(H, "H", (n, n))
    lo = checks.array(lo, "lo", (n,))
    hi = checks.array(hi, "hi", (n,))
    if np.any(lo > hi):
        raise ValueError("lo is above hi: the box is empty")
    return H, g, lo, hi, checks.array(x, "x", (n,))


def _held(slope: Array, lo: Array, hi: Array, x: Array) -> NDArray[np.bool_]:
    """Return which entries are at a bound that the gradient presses them against."""
    return ((x <= lo) & (slope > 0.0)) | ((x >= hi) & (slope < 0.0))


def _until_a_limit(
    x: Array, step: Array, lo: Array, hi: Array
) -> tuple[Array, int | None]:
    """Return x after a step, or the first bound that it meets and its index."""
    room = np.where(step > 0.0, hi - x, lo - x)
    share = np.divide(room, step, out=np.full_like(x, np.inf), where=step != 0.0)
    met = int(np.argmin(share))
    if share[met] >= 1.0:
        return np.clip(x + step, lo, hi), None
    there = x + share[met] * step
    # The limit itself has no rounding error.
    there[met] = hi[met] if step[met] > 0.0 else lo[met]
    return np.clip(there, lo, hi), met
