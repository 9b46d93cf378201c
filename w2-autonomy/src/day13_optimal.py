"""Day 13: optimal control, and how to verify an optimum.

    make day13                       in the clone: sets all up, then runs this
    python src/day13_optimal.py      in w2-autonomy/, once that is done

The state is x = (q - q0, qd); u is added to the torque that holds the equilibrium q0.
Twists are (omega; v), expressed in the world frame; J_space is (6, 7). Radians, metres,
kilograms, newtons, seconds.
"""

import sys
from itertools import pairwise
from types import FrameType, SimpleNamespace

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, panda, simulate
from robo47 import optimal as library
from robo47.dynamics import gravity_torque
from robo47.jacobian import dls_step, pose_error
from robo47.lesson.lab import Lab
from robo47.verify import random_q

import day13_mujoco

READY_Q = panda.READY_Q  # the equilibrium, the handout's home_q, rad
SEED = 13  # for configurations, problems and costs; the same at every run
TRIALS = 20  # configurations at which the gravity stiffness is compared
MOST_PASSES = 1_000  # of the loop of task 13.5, which needs about one per entry
PASSES = SimpleNamespace(loop=None, sets=[])  # of the loop that runs now
BOXES = 40  # random quadratic programs
# In this problem Newton steps that are clamped without a line search alternate forever.
CIRCLING = (
    np.array([[23.0, 15, 21], [15, 14, 13], [21, 13, 23]]), np.array([9.0, -2, 6]),
    -np.ones(3), np.ones(3), np.array([0.0, 0, -1]),
)  # fmt: skip
Q_COST = np.repeat([100.0, 1.0], 7)  # per s: of rad^2, and of (rad/s)^2
R_COST = 0.01  # per s: of (N m)^2
STEPS = 1_500  # Riccati steps; 500 are enough for the gain, not for the cost
SECONDS = 6.0  # s, for which MuJoCo holds the arm
WAY = np.array([0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0])  # direction that folds the arm
SIZES = (0.001, 0.01, 0.1, 0.3)  # rad, distances of the start along WAY
JUDGED = 0.01  # rad, the distance at which the predicted cost is verified
RADIUS = 0.38  # m, of Day 3's circle; 0.36 would lie inside the workspace
DT = 0.02  # s, the time step along the circle
GAIN = 10.0  # 1/s, the feedback gain of the pose error
DAMPING = 0.005  # of the damped least-squares step; a tenth of Day 3's
SPEED = simulate.SPEED_LIMITS  # rad/s
# The goal of the motion, rad from ready, and the number of its steps of 10 ms.
TO = np.array([0.8, 0.5, -0.5, 0.6, 0.5, -0.5, 0.5])
MOTION = 60
ROUNDS = 3  # iterations of iLQR


def gravity_stiffness(
    J_space: np.ndarray, masses: np.ndarray, coms: np.ndarray, g: np.ndarray
) -> np.ndarray:
    """Return the gravity stiffness d(gravity torque)/dq, symmetric, (n, n), N m/rad.

    The gravity torque is Day 4's: the torque with which the motors hold the arm against
    its weight. J_space (6, n) is the space Jacobian, masses (n,) are in kg, coms (n, 3)
    are the links' centres of mass and g the gravity vector such as (0, 0, -9.81), all
    expressed in the world frame. Relative to the links distal to joint j, a rotation of
    joint j by d rotates gravity by -d about omega_j.
    One hinge about +y with 2 kg 1 m above it: -19.62; 1 m below: 19.62.
    """
    # region 13.1
    slope = np.zeros((len(masses), len(masses)))  # the gravity stiffness
    for j, omega in enumerate(J_space[:3].T):
        tau = gravity_torque(J_space, masses, coms, np.cross(g, omega))  # dtau/dq_j
        slope[j:, j] = tau[j:]  # lower triangle: the joints distal to j
        slope[j, j:] = tau[j:]  # upper triangle: the matrix is symmetric
    return slope  # the gravity stiffness
    # endregion 13.1


def linearise(
    M: np.ndarray, stiffness: np.ndarray, damping: np.ndarray, h: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return A (2 n, 2 n) and B (2 n, n) of one step x+ = A x + B u near equilibrium.

    The state is x = (q - q0, qd), with the positions first; q0 is the equilibrium, and
    u is the torque in addition to the torque that holds the arm there. M (n, n) is the
    mass matrix, kg m^2, stiffness (n, n) the gravity stiffness, N m/rad, damping (n,)
    the joints' damping, N m s/rad, which acts on the new velocity, and h the time step,
    s. The new velocity moves the joints (MuJoCo's `implicitfast`). One joint with M 1,
    stiffness 10, damping 1, h 0.1: A = [[10, 1], [-10, 10]] / 11, B = (0.1, 1) / 11.
    """
    # region 13.2
    now = np.eye(len(damping))  # coefficient of the old q in the new q
    inverse = np.linalg.inv(M + h * np.diag(damping))  # the inverse of M + h D
    by_q = -h * inverse @ stiffness  # coefficient of q in the new velocity
    by_v = inverse @ M  # coefficient of the old velocity in the new velocity
    by_u = h * inverse  # coefficient of u in the new velocity
    A = np.block([[now + h * by_q, h * by_v], [by_q, by_v]])  # the matrix A
    return A, np.vstack([h * by_u, by_u])  # A and B
    # endregion 13.2


def riccati_step(
    P: np.ndarray, A: np.ndarray, B: np.ndarray, Q: np.ndarray, R: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the cost-to-go P one step earlier (n, n) and the gain K (m, n), u = -K x.

    P (n, n) is the cost-to-go of the next state, x . P x; A (n, n) and B (n, m) are the
    linear system; a step costs x . Q x + u . R u with Q (n, n) and R (m, m) symmetric,
    R positive definite. This is the discrete Riccati recursion of LQR. With A = [[1,
    1], [0, 1]], B = (0; 1), and P, Q and R equal to the identity, the result is P =
    [[2, 1], [1, 2.5]], K = (0, 0.5).
    """
    # region 13.3
    K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)  # the optimal gain
    return Q + A.T @ P @ (A - B @ K), K  # the cost-to-go and the gain
    # endregion 13.3


def cost_to_go(P: np.ndarray, x: np.ndarray) -> float:
    """Return the cost-to-go x . P x, the predicted cost from the state x (n,) on.

    cost_to_go([[2, 1], [1, 2.5]], [1, 2]) -> 16
    """
    # region 13.3
    return x @ P @ x  # the cost-to-go
    # endregion 13.3


def kkt_residual(
    H: np.ndarray, f: np.ndarray, lo: np.ndarray, hi: np.ndarray, x: np.ndarray
) -> float:
    """Return the KKT residual of x for min x . H x / 2 + f . x with lo <= x <= hi.

    H (n, n) is symmetric and positive definite; f, lo, hi and x are (n,). Move x by
    minus the gradient, clamp it to the bounds, and take the largest absolute difference
    from x. The residual is 0 at the minimiser alone. It is not the distance to the
    minimiser. H = [[2, 1], [1, 2]], f = (-2, -10), bounds -1 to 1: 0 at (0.5, 1), 2 at
    (-1, 1), 1 at (0, 0).
    """
    # region 13.4
    there = np.clip(x - (H @ x + f), lo, hi)  # a clamped step against the gradient
    return np.abs(x - there).max()  # the largest difference
    # endregion 13.4


def note_pass(loop: FrameType, held: np.ndarray) -> None:
    """Note the active set of one pass of a loop; stop a loop that does not end.

    held (n,) is True for the entries of the active set.
    """
    if loop is not PASSES.loop:  # another call begins
        PASSES.loop, PASSES.sets = loop, []
    PASSES.sets.append("{" + ", ".join(map(str, np.flatnonzero(held))) + "}")
    if len(PASSES.sets) > MOST_PASSES:
        last = ", ".join(PASSES.sets[-6:])
        raise RuntimeError(
            f"the loop does not end: after {MOST_PASSES:,} passes its active sets are "
            f"{last}. Which entry should stay, or when should the loop end?"
        )


def first_limit(
    x: np.ndarray, step: np.ndarray, lo: np.ndarray, hi: np.ndarray
) -> tuple[np.ndarray, int | None]:
    """Return x + step and None, or the point at the first bound met and its index.

    x and step are (n,); lo and hi are the bounds.
    (0, 0) by (-2, 6) in the box -1 to 1: (-1/3, 1) and 1.
    """
    note_pass(sys._getframe(1), (step == 0) & ((x <= lo) | (x >= hi)))
    room = np.where(step > 0, hi - x, lo - x)
    share = np.divide(room, step, out=np.full_like(x, np.inf), where=step != 0)
    met = int(np.argmin(share))
    if share[met] >= 1:
        return x + step, None
    there = x + share[met] * step
    there[met] = hi[met] if step[met] > 0 else lo[met]  # no rounding beside it
    return there, met


def box_qp(
    H: np.ndarray, f: np.ndarray, lo: np.ndarray, hi: np.ndarray, x: np.ndarray
) -> np.ndarray:
    """Return the minimiser (n,) of x . H x / 2 + f . x with lo <= x <= hi.

    The last argument is the start, which may lie outside the bounds; H (n, n) is
    symmetric and positive definite. An active-set method (Nocedal and Wright, section
    16.5): minimise over the free entries, stop at the first bound, and release an entry
    that the gradient pulls away from its bound.
    `kkt_residual`'s case: (0.5, 1); without bounds it is (-2, 6).
    """
    # region 13.5
    x = np.clip(x, lo, hi)  # the start within the bounds
    held = lo == hi  # the active set: entries that are held at a bound
    for _ in range(100):
        free = ~held  # the entries that may move
        step = np.zeros(len(x))  # the step to the minimum over the free entries
        step[free] = np.linalg.solve(  # the Newton step of the free entries
            H[np.ix_(free, free)], -(H @ x + f)[free]
        )
        x, met = first_limit(x, step, lo, hi)  # the next point and the bound met
        if met is not None:
            held[met] = True  # the entry at the bound
            continue
        leaves = np.abs(x - np.clip(x - (H @ x + f), lo, hi))  # KKT residual by entry
        if leaves.max() < 1e-12:
            break
        held[np.argmax(leaves)] = False  # the released entry
    return x  # the minimiser
    # endregion 13.5


def qp_ik(
    J: np.ndarray, e: np.ndarray, weights: np.ndarray, damping: float,
    dq_lo: np.ndarray, dq_hi: np.ndarray,
) -> np.ndarray:  # fmt: skip
    """Return the inverse-kinematics step dq (7,), rad, that is optimal within bounds.

    It minimises (J dq - e) . W (J dq - e) + damping^2 |dq|^2 with dq_lo <= dq <= dq_hi.
    J (6, 7) is a Jacobian, e (6,) the pose error as a twist in the same frame, weights
    (6,) the diagonal of W. Start `box_qp` at 0. Joints 1 and 2 both move the hand along
    x, 3 along y; e is 1 and 0.5, damping 0.1, all weights 1: (0.4975, 0.4975, 0.4950),
    and (0.3, 0.6931, 0.4950) with joint 1 within 0.3.
    """
    # region 13.6
    H = J.T @ (weights[:, None] * J) + damping**2 * np.eye(J.shape[1])  # the Hessian
    return box_qp(  # the minimiser within the bounds
        H,
        -J.T @ (weights * e),  # the linear part of the cost
        dq_lo,
        dq_hi,
        np.zeros(J.shape[1]),
    )
    # endregion 13.6


def ilqr_backward(
    fx: np.ndarray, fu: np.ndarray, lx: np.ndarray, lu: np.ndarray, lxx: np.ndarray,
    luu: np.ndarray, lux: np.ndarray, Vx: np.ndarray, Vxx: np.ndarray, mu: float,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:  # fmt: skip
    """Return k (T, m), K (T, m, n), drop (2,) of iLQR's backward pass, du = k + K dx.

    fx (T, n, n) and fu (T, n, m) are the derivatives of the steps; lx (T, n) and lu (T,
    m) are the gradients, lxx (T, n, n), luu (T, m, m) and lux (T, m, n) the second
    derivatives of their costs. Vx (n,) and Vxx (n, n) are the gradient and the second
    derivative of the final cost. mu >= 0 is added to the diagonal of Quu wherever Quu
    appears. drop holds two sums over all steps: k . Qu, and k . Quu k / 2 (Tassa, Erez
    and Todorov 2012). Example with mu = 0: two steps x+ = x + u, each with the cost
    (x^2 + u^2) / 2, and the final cost x + x^2 / 2, all at x = u = 0. Then k is -0.2
    and -0.5, K is -0.6 and -0.5, and drop is (-0.6, 0.3).
    """
    # region 13.7
    T, n, m = fu.shape  # the numbers of steps, states and inputs
    k, K, drop = np.zeros((T, m)), np.zeros((T, m, n)), np.zeros(2)  # the results
    for t in reversed(range(T)):
        Qx = lx[t] + fx[t].T @ Vx  # the gradient in x
        Qu = lu[t] + fu[t].T @ Vx  # the gradient in u
        Qxx = lxx[t] + fx[t].T @ Vxx @ fx[t]  # second derivative in x
        Quu = luu[t] + fu[t].T @ Vxx @ fu[t] + mu * np.eye(m)  # second derivative in u
        Qux = lux[t] + fu[t].T @ Vxx @ fx[t]  # the mixed second derivative
        k[t] = -np.linalg.solve(Quu, Qu)  # open-loop change in the input
        K[t] = -np.linalg.solve(Quu, Qux)  # feedback gain
        drop += k[t] @ Qu, k[t] @ Quu @ k[t] / 2  # the linear and the quadratic part
        Vx = (  # the gradient of the cost-to-go
            Qx + K[t].T @ (Qu + Quu @ k[t]) + Qux.T @ k[t]
        )
        Vxx = Qxx + K[t].T @ (Qux + Quu @ K[t]) + Qux.T @ K[t]  # the cost-to-go Hessian
    return k, K, drop  # the results
    # endregion 13.7


def expected_reduction(dV: np.ndarray, alpha: float) -> float:
    """Return the expected reduction of the cost for the step alpha k.

    dV (2,) is `drop`, the third result of `ilqr_backward`; alpha is the fraction of k
    that is applied. The expected change of the cost is alpha dV[0] + alpha^2 dV[1]; the
    reduction is its negative, so it is positive if the cost is expected to fall.

    expected_reduction([-4, 2], 0.5) -> 1.5
    """
    # region 13.8
    return -(alpha * dV[0] + alpha**2 * dV[1])  # the expected reduction
    # endregion 13.8


def reduction_ratio(before: float, after: float, expected: float) -> float:
    """Return the reduction ratio: the measured reduction over the expected one.

    before and after are the costs before and after the step.

    reduction_ratio(5, 3.5, 2) -> 0.75
    """
    # region 13.8
    return (before - after) / expected  # the reduction ratio
    # endregion 13.8


def bound_multipliers(
    H: np.ndarray, f: np.ndarray, lo: np.ndarray, hi: np.ndarray, x: np.ndarray
) -> np.ndarray:
    """Return d(minimum cost) / d(bound) (n,) at the minimiser x; 0 for a free entry.

    The arguments are the same as in `kkt_residual`. The result is the Lagrange
    multiplier of the bound at which an entry is held: positive at a lower bound and
    negative at an upper one, because a wider box cannot increase the minimum cost.
    In the example of `kkt_residual`, where x is (0.5, 1): (0, -7.5).
    """
    # region 13.9
    slope = H @ x + f  # the gradient of the cost
    held = ((x <= lo) & (slope > 0)) | ((x >= hi) & (slope < 0))  # the held entries
    return np.where(held, slope, 0.0)  # the gradient at the held entries
    # endregion 13.9


def at_rest(model: mujoco.MjModel, q: np.ndarray, h: float) -> tuple[np.ndarray, ...]:
    """Return your gravity stiffness at q, and your A and B."""
    arm = panda.arm(model)
    now = arm.at(q)
    slope = gravity_stiffness(now.J_space, arm.masses, now.coms_world, arm.gravity)
    return slope, *linearise(now.M, slope, arm.damping, h)


def mujoco_gravity(model: mujoco.MjModel, q: np.ndarray) -> np.ndarray:
    """Return MuJoCo's gravity stiffness at q, (7, 7), by finite differences."""
    data = mujoco.MjData(model)

    def slope(h: float) -> np.ndarray:
        columns = []
        for step in h * np.eye(7):
            ends = []
            for data.qpos[:] in (q + step, q - step):
                mujoco.mj_forward(model, data)  # fills qfrc_bias
                ends.append(data.qfrc_bias.copy())
            columns.append((ends[0] - ends[1]) / (2 * h))
        return np.column_stack(columns)

    return (4 * slope(1e-3) - slope(2e-3)) / 3  # Richardson: the error is of order h^4


def mujoco_step(model: mujoco.MjModel, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return MuJoCo's own A and B at the equilibrium q."""
    data = day13_mujoco.at(model, q, np.zeros(14))
    A, B = np.zeros((14, 14)), np.zeros((14, 7))
    mujoco.mjd_transitionFD(model, data, 1e-6, True, A, B, None, None)  # fills A, B
    return A, B


def total(parts: tuple, inputs: np.ndarray, x: np.ndarray) -> float:
    """Return the cost of a motion from x in `ilqr_backward`'s quadratic model."""
    *steps, Vx, Vxx = parts
    cost = 0.0
    for fx, fu, lx, lu, lxx, luu, lux, u in zip(*steps, inputs, strict=True):
        cost += lx @ x + lu @ u + x @ lxx @ x / 2 + u @ luu @ u / 2 + u @ lux @ x
        x = fx @ x + fu @ u
    return cost + Vx @ x + x @ Vxx @ x / 2


def least(parts: tuple, x: np.ndarray) -> tuple[np.ndarray, float]:
    """Return the optimal inputs (T, m) from x on and their cost, by one solve."""
    shape = parts[3].shape

    def of(u: np.ndarray) -> float:
        return total(parts, u.reshape(shape), x)

    units = np.eye(shape[0] * shape[1])
    zero = of(0 * units[0])
    alone = np.array([of(one) for one in units])
    both = np.array([[of(one + other) for other in units] for one in units])
    second = (
        both - alone - alone[:, None] + zero
    )  # exact, because the cost is quadratic
    slope = alone - zero - np.diag(second) / 2
    best = np.linalg.solve(second, -slope).reshape(shape)
    return best, total(parts, best, x)


def definite(n: int, rng: np.random.Generator) -> np.ndarray:
    """Return a random symmetric positive definite matrix, (n, n)."""
    C = rng.normal(size=(n, n))
    return C @ C.T + np.eye(n)


def motion(T: int, n: int, m: int, rng: np.random.Generator) -> tuple:
    """Return random arguments of `ilqr_backward`, fx to Vxx, for T steps."""
    both = np.array([definite(n + m, rng) for _ in range(T)])
    return (
        rng.normal(size=(T, n, n)), rng.normal(size=(T, n, m)),
        rng.normal(size=(T, n)), rng.normal(size=(T, m)),
        both[:, :n, :n], both[:, n:, n:], both[:, n:, :n],
        rng.normal(size=n), definite(n, rng),
    )  # fmt: skip


def off_one_solve(parts: tuple, mu: float, x: np.ndarray) -> dict[str, float]:
    """Return the errors of your backward pass against one solve for all inputs."""
    fx, fu, lx, lu, lxx, luu, *rest = parts
    dear = (fx, fu, lx, lu, lxx, luu + mu * np.eye(luu.shape[1]), *rest)
    k, K, drop = ilqr_backward(*parts, mu)
    off = {"inputs": 0.0, "drop": 0.0, "ratio": 0.0}
    for alpha in (1.0, 0.5):
        now = 0 * x
        inputs = []
        for A, B, more, gain in zip(fx, fu, k, K, strict=True):
            inputs.append(alpha * more + gain @ now)
            now = A @ now + B @ inputs[-1]
        cost = total(dear, np.array(inputs), 0 * x)
        expected = expected_reduction(drop, alpha)
        off["drop"] = max(off["drop"], abs(cost + expected))
        for share in (1.0, 0.5, 2.0, -1.0):  # other expected reductions
            ratio = share * reduction_ratio(0.0, cost, share * expected)
            off["ratio"] = max(off["ratio"], abs(ratio - 1))
    best, _ = least(dear, x)
    now = x
    for A, B, more, gain, right in zip(fx, fu, k, K, best, strict=True):
        u = more + gain @ now
        off["inputs"] = max(off["inputs"], np.abs(u - right).max())
        now = A @ now + B @ u
    return off


def off_one_riccati(rng: np.random.Generator) -> tuple[float, float]:
    """Return the errors of cost-to-go and gain of three steps against one solve."""
    A, B, *_ = (one[0] for one in motion(1, 3, 2, rng))
    P, Q, R = definite(3, rng), definite(3, rng), definite(2, rng)
    many = [np.tile(one, (3, 1, 1)) for one in (A, B, 2 * Q, 2 * R, np.zeros((2, 3)))]
    none = np.zeros((3, 3)), np.zeros((3, 2))
    parts = (*many[:2], *none, *many[2:], np.zeros(3), 2 * P)
    for _ in range(3):
        P, K = riccati_step(P, A, B, Q, R)
    x = rng.normal(size=3)
    best, cost = least(parts, x)
    return abs(cost_to_go(P, x) - cost), np.abs(best[0] + K @ x).max()


def promise(A: np.ndarray, B: np.ndarray, h: float, r: float = R_COST) -> tuple:
    """Return P and K of the infinite horizon; Q_COST and r are costs per second."""
    Q, R = h * np.diag(Q_COST), h * r * np.eye(B.shape[1])
    P = Q
    for _ in range(STEPS):
        P, K = riccati_step(P, A, B, Q, R)
    return P, K


def paid(model: mujoco.MjModel, K: np.ndarray, x: np.ndarray) -> float:
    """Return the cost that MuJoCo measures for a start at x with u = -K x."""
    data = day13_mujoco.at(model, READY_Q, x)
    hold = data.ctrl.copy()
    h = model.opt.timestep
    cost = 0.0
    for _ in range(round(SECONDS / h)):
        x = np.append(data.qpos - READY_Q, data.qvel)
        u = -K @ x
        cost += h * (Q_COST @ x**2 + R_COST * u @ u)
        data.ctrl[:] = hold + u
        mujoco.mj_step(model, data)
    return cost


def kept(
    model: mujoco.MjModel, P: np.ndarray, K: np.ndarray, size: float
) -> np.ndarray:
    """Return measured over predicted cost for two opposite starts, (2,)."""
    x = size * np.append(WAY, np.zeros(7))
    return np.array([paid(model, K, one) / cost_to_go(P, one) for one in (x, -x)])


def boxes(n: int, rng: np.random.Generator) -> list[tuple[np.ndarray, ...]]:
    """Return n random quadratic programs: H, g, lo, hi and a start."""
    found = []
    for _ in range(n):
        lo = rng.uniform(-1, 0.5, 5)
        hi = lo + rng.choice([0.1, 0.3, 1.0, 9.0], 5)
        start = 3 * rng.normal(size=5)
        found.append((definite(5, rng), 5 * rng.normal(size=5), lo, hi, start))
    return found


def mujoco_box(
    H: np.ndarray, g: np.ndarray, lo: np.ndarray, hi: np.ndarray
) -> np.ndarray:
    """Return the minimiser that MuJoCo's solver finds, (n,)."""
    n = len(g)
    x, factor, free = np.zeros(n), np.zeros((n, n + 7)), np.zeros(n, np.int32)
    mujoco.mju_boxQP(x, factor, free, H, g, lo, hi)  # fills x
    return x


def mujoco_prices(
    H: np.ndarray, g: np.ndarray, lo: np.ndarray, hi: np.ndarray, x: np.ndarray
) -> np.ndarray:
    """Return d(minimum cost) / d(bound), (n,), by moving each bound that x lies at."""
    move = 1e-5

    def least_cost(low: np.ndarray, high: np.ndarray) -> float:
        best = mujoco_box(H, g, low, high)  # mujoco.mju_boxQP
        return best @ H @ best / 2 + g @ best

    prices = np.zeros(len(x))
    for i, step in enumerate(move * np.eye(len(x))):
        below, above = step * (x[i] == lo[i]), step * (x[i] == hi[i])
        there = least_cost(lo + below, hi + above)
        back = least_cost(lo - below, hi - above)
        prices[i] = (there - back) / (2 * move)
    return prices


def limits(model: mujoco.MjModel, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the bounds of a step, from the joints' velocity limits and ranges."""
    low, high = model.jnt_range.T
    return np.maximum(-SPEED * DT, low - q), np.minimum(SPEED * DT, high - q)


def draw_circle(model: mujoco.MjModel, step, radius: float = RADIUS) -> tuple:
    """Draw Day 3's circle with step(J, e, lo, hi) -> dq.

    Return the hand's position errors, mm, (n,), the joints' velocities as fractions of
    their limits, (n, 7), and the largest excess over a joint's range, rad.
    """
    arm = panda.arm(model)
    path, q = day13_mujoco.circle(model, radius, np.arange(0.0, day13_mujoco.LAP, DT))
    off, speeds, beyond = [], [], 0.0
    for T_now, T_next in pairwise(path):  # poses at intervals of DT
        now = arm.at(q)
        T = now.T_world_ee
        e = pose_error(T_now, T_next) + DT * GAIN * pose_error(T, T_now)
        dq = step(now.J_site, e, *limits(model, q))
        off.append(1000 * np.linalg.norm(T_now[:3, 3] - T[:3, 3]))
        speeds.append(np.abs(dq) / (SPEED * DT))
        q = q + dq
        low, high = model.jnt_range.T
        beyond = max(beyond, (low - q).max(), (q - high).max())
    return np.array(off), np.array(speeds), beyond


def best_step(turn: float = 1.0):
    """Return a step for `draw_circle`: your `qp_ik` with this orientation weight."""
    weights = np.repeat([turn, 1.0], 3)
    return lambda J, e, lo, hi: qp_ik(J, e, weights, DAMPING, lo, hi)


def reach(model: mujoco.MjModel, rounds: int = ROUNDS) -> list[tuple[float, ...]]:
    """Return cost, expected reduction and reduction ratio of each iteration of iLQR."""
    task = day13_mujoco.Reach(model, READY_Q, READY_Q + TO)
    u = np.zeros((MOTION, 7))
    x, u = task.rolled(u, np.zeros((MOTION + 1, 14)), u, np.zeros((MOTION, 7, 14)))
    found = [(task.cost(x, u), 0.0, 0.0)]
    for _ in range(rounds):
        k, K, drop = ilqr_backward(*task.expanded(x, u), 0.0)
        for alpha in 0.5 ** np.arange(10):
            there = task.rolled(u, x, alpha * k, K)
            expected = expected_reduction(drop, alpha)
            ratio = reduction_ratio(found[-1][0], task.cost(*there), expected)
            if ratio > 0.1:
                x, u = there
                break
        found.append((task.cost(x, u), expected, ratio))
    return found


def said(model: mujoco.MjModel, name: str, P: np.ndarray, K: np.ndarray, best: float):
    """Print a gain's measured cost over its own prediction and over the optimum."""
    x = JUDGED * np.append(WAY, np.zeros(7))
    both = (paid(model, K, x) + paid(model, K, -x)) / 2
    print(f"  {name:28}{both / cost_to_go(P, x):9.3f}{both / best:11.3f}")


def hold(lab: Lab, model: mujoco.MjModel) -> None:
    """Hold the arm at ready and compare measured with predicted costs."""
    h = model.opt.timestep
    slope, A, B = at_rest(model, READY_Q, h)
    P, K = promise(A, B, h)
    stiff = np.diag(K[:, :7])
    print(f"  stiffness of joints 1 and 2: {stiff[0]:.1f} and {stiff[1]:.1f} N m/rad")
    lab.measured("stiffness of joint 2, N m/rad", stiff[1])
    print("  measured / predicted    folded   stretched            mean")
    sides = {size: kept(model, P, K, size) for size in SIZES}
    for size, both in sides.items():
        print(f"  {1000 * size:5.0f} mrad {both[1]:18.4f}{both[0]:12.4f}"
              f"{np.mean(both):16.5f}")  # fmt: skip
    lab.measured("measured / predicted cost, stretched by 0.1 rad", sides[0.1][0])
    label = f"|mean of both starts - 1|, {1000 * JUDGED:.0f} mrad"
    mean = np.mean(sides[JUDGED]) - 1
    lab.record("promise_off", mean, metric="max_abs", label=label)
    x = JUDGED * np.append(WAY, np.zeros(7))
    best = cost_to_go(P, x)
    print("  gain                      cost / own prediction  / optimum")
    said(model, "K", P, K, best)
    none = linearise(panda.arm(model).at(READY_Q).M, 0 * slope, model.dof_damping, h)
    said(model, "K without gravity stiffness", *promise(*none, h), best)
    said(model, "K for ten times the R", *promise(A, B, h, 10 * R_COST), best)
    said(model, "K / 2", P, K / 2, best)


def circles(lab: Lab, model: mujoco.MjModel) -> None:
    """Draw the circle within limits: with clamped steps, and with `qp_ik`."""

    def clipped(J: np.ndarray, e: np.ndarray, lo: np.ndarray, hi: np.ndarray):
        return np.clip(dls_step(J, e, DAMPING), lo, hi)  # Day 3's

    print("                              max error,   velocity  excess over")
    print("                                      mm    / limit   range, rad")
    methods = {"Day 3's step, clamped": clipped, "qp_ik": best_step(),
               "qp_ik, orientation weight 0.1": best_step(0.1),
               "qp_ik, orientation weight 0.01": best_step(0.01)}  # fmt: skip
    for name, step in methods.items():
        off, share, beyond = draw_circle(model, step)
        print(f"  {name:31}{off.max():7.2f}{share.max():11.2f}{beyond:z13.3f}")
        if name == "qp_ik":
            lab.record(
                "circle_best", off, metric="max_mm", label="error on the circle, mm"
            )
            lab.record("circle_best", share, metric="speed_share",
                       label="largest velocity / limit")  # fmt: skip
            lab.measured("largest error on a circle of 0.38 m, mm", off.max())


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    model = day13_mujoco.arm()
    h = model.opt.timestep
    print(panda.describe("panda_nohand"))

    lab.step("1. The gravity stiffness, and one step of MuJoCo")
    poses = random_q(model, TRIALS, SEED)
    asked = [(model, READY_Q), *((model, q) for q in poses[1::2])]
    asked += [(day13_mujoco.on_a_wall(), q) for q in poses[::2]]
    off = [at_rest(one, q, h)[0] - mujoco_gravity(one, q) for one, q in asked]
    lab.check("|stiffness - differences of qfrc_bias|, N m/rad", off)
    off = []
    for one, q in [*asked[:3], *asked[-3:]]:
        ours = np.hstack(at_rest(one, q, h)[1:])
        off.append(ours - np.hstack(mujoco_step(one, q)))
    lab.record("linearise", off, label="|A, B - MuJoCo's mjd_transitionFD|", seed=SEED)

    lab.step("2. The measured and the predicted cost of holding the arm")
    off = np.max([off_one_riccati(rng) for _ in range(5)], axis=0)
    lab.check("cost-to-go of 3 steps - one solve for all inputs", off[0])
    lab.check("gain after 3 steps - the same solve", off[1])
    hold(lab, model)

    lab.step("3. A quadratic program with bounds")
    some = [CIRCLING, *boxes(BOXES, rng)]
    best = [box_qp(*one) for one in some]
    off = [
        np.abs(x - mujoco_box(*one[:4])).max()
        for x, one in zip(best, some, strict=True)
    ]
    lab.check("|box_qp - MuJoCo's mju_boxQP|", off)
    off = [kkt_residual(*one[:4], mujoco_box(*one[:4])) for one in some]
    lab.record("kkt", off, label="kkt_residual of MuJoCo's minimiser", seed=SEED)
    off = [kkt_residual(*one) - library.kkt_residual(*one) for one in some]
    lab.check("kkt_residual at other points - the library's", off)

    lab.step(f"4. A circle of {RADIUS} m within limits")
    off = []
    for q in poses:
        J = panda.arm(model).at(q).J_site
        e, weights = rng.normal(size=6), rng.uniform(0.2, 2.0, 6)
        low, high = rng.uniform(0.05, 0.5, (2, 7))
        # The same problem as a plain sum of squares with 7 more rows.
        rows = np.vstack([np.sqrt(weights)[:, None] * J, 0.1 * np.eye(7)])
        right = np.append(np.sqrt(weights) * e, np.zeros(7))
        truth = mujoco_box(rows.T @ rows, -rows.T @ right, -low, high)
        off.append(qp_ik(J, e, weights, 0.1, -low, high) - truth)
    lab.check("|qp_ik - mju_boxQP with 7 more rows|", off)
    circles(lab, model)

    lab.step("5. An optimal motion: iLQR")
    for mu in (0.0, 0.5):
        off = off_one_solve(motion(4, 3, 2, rng), mu, rng.normal(size=3))
        for name, one in off.items():
            lab.check(f"mu {mu}: {name} - one solve for all inputs", one)
    rounds = reach(model)
    print("  iteration   cost  expected reduction   ratio")
    for i, (cost, expected, ratio) in enumerate(rounds):
        print(f"  {i:5}{cost:11.4g}" + (f"{expected:20.4g}{ratio:8.2f}" if i else ""))
    fell = 1 - rounds[-1][0] / rounds[0][0]
    print(f"  the cost fell by {fell:.1%}")
    lab.record("ilqr", rounds[2][2] - 1, metric="second_ratio_off",
               label="|ratio of iteration 2 - 1|")  # fmt: skip

    lab.step("6. Side quest: the multipliers of the bounds")
    with lab.side_quest():
        off = []
        for H, g, lo, hi, _ in some[1:]:
            x = mujoco_box(H, g, lo, hi)
            off.append(
                bound_multipliers(H, g, lo, hi, x) - mujoco_prices(H, g, lo, hi, x)
            )
        lab.check("|multipliers - differences of mju_boxQP's cost|", off, 1e-6)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
