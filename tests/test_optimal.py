"""LQR, box QP and iLQR against MuJoCo's slopes, SciPy, and what can be enumerated."""

import itertools

import mujoco
import numpy as np
import pytest
import scipy.linalg
import scipy.optimize
from compare import assert_same
from hypothesis import given, settings
from hypothesis import strategies as st

from robo47 import optimal, panda, simulate
from robo47.verify import random_q

rng = np.random.default_rng(13)
model = panda.load("panda_nohand", drive="torque")
arm = panda.arm(model)
H2 = np.array([[2.0, 1.0], [1.0, 2.0]])
G2 = np.array([-2.0, -10.0])
ONE = np.ones(2)


@pytest.fixture(autouse=True)
def seeded():
    """Let every test draw the same, whichever ran before it."""
    global rng
    rng = np.random.default_rng(13)


def bias(q):
    """Return MuJoCo's torque of gravity at rest."""
    return simulate.start(model, q).qfrc_bias.copy()


def slope_at(q):
    """Return our slope of gravity at q."""
    now = arm.at(q)
    given = now.J_space, arm.masses, now.coms_world, arm.gravity
    return optimal.gravity_stiffness(*given)


def definite(n, low=0.1):
    """Return a symmetric matrix with eigenvalues from low to about n + 3."""
    C = rng.normal(size=(n, n))
    return C @ C.T + low * np.eye(n)


def box(n):
    """Return a quadratic and a box whose sides may have length 0."""
    lo = rng.uniform(-1, 0.5, n)
    hi = lo + rng.choice([0.0, 0.2, 1.0, 5.0], n)
    return definite(n), 3 * rng.normal(size=n), lo, hi


def test_a_box_of_150_entries_is_solved_and_no_wrong_point_is_returned(monkeypatch):
    n = 150
    H, f, ends = definite(n), 30 * rng.normal(size=n), np.ones(n)
    x = optimal.box_qp(H, f, -ends, ends, np.zeros(n))
    assert optimal.kkt_residual(H, f, -ends, ends, x) < 1e-9
    monkeypatch.setattr(optimal, "STEPS", (3, 0))
    with pytest.raises(ValueError, match="no minimiser in 3 iterations"):
        optimal.box_qp(H, f, -ends, ends, np.zeros(n))


def cost(H, g, x):
    """Return what is made least."""
    return 0.5 * x @ H @ x + g @ x


def enumerated(H, g, lo, hi):
    """Return the best point of all 3^n sets of limits that may hold."""
    best = None
    for where in itertools.product((-1, 0, 1), repeat=len(g)):
        where = np.array(where)
        x = np.where(where < 0, lo, hi)
        free = where == 0
        x[free] = np.linalg.solve(
            H[np.ix_(free, free)], -(g + H[:, ~free] @ x[~free])[free]
        )
        inside = (x >= lo - 1e-12).all() and (x <= hi + 1e-12).all()
        if inside and (best is None or cost(H, g, x) < cost(H, g, best)):
            best = x
    return best


def scipy_box(A, b, lo, hi):
    """Return SciPy's least squares in a box; its other method, bvls, may miss it."""
    return scipy.optimize.lsq_linear(A, b, (lo, hi), tol=1e-15, max_iter=500).x


def motion(T=4, n=3, m=2):
    """Return fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx of a motion with costs."""
    both = np.array([definite(n + m, 0.5) for _ in range(T)])
    fx, fu = rng.normal(size=(T, n, n)), rng.normal(size=(T, n, m))
    slopes = rng.normal(size=(T, n)), rng.normal(size=(T, m))
    second = both[:, :n, :n], both[:, n:, n:], both[:, n:, :n]
    return fx, fu, *slopes, *second, rng.normal(size=n), definite(n)


def dense(fx, fu, lx, lu, lxx, luu, lux, Vx, Vxx, x0):
    """Return the cost's second and first slopes in all inputs, from x0 on, and it."""
    T, n, m = fu.shape
    X = np.zeros((n, T * m))  # x as what x0 and all inputs make of it: X u + x
    x = x0
    H, g, c = np.zeros((T * m, T * m)), np.zeros(T * m), 0.0
    for t in range(T):
        U = np.zeros((m, T * m))
        U[:, t * m : (t + 1) * m] = np.eye(m)
        H += X.T @ lxx[t] @ X + U.T @ luu[t] @ U + U.T @ lux[t] @ X + X.T @ lux[t].T @ U
        g += X.T @ (lxx[t] @ x + lx[t]) + U.T @ (lux[t] @ x + lu[t])
        c += 0.5 * x @ lxx[t] @ x + lx[t] @ x
        X = fx[t] @ X + fu[t] @ U
        x = fx[t] @ x
    return H + X.T @ Vxx @ X, g + X.T @ (Vxx @ x + Vx), c + 0.5 * x @ Vxx @ x + Vx @ x


def test_gravitys_slope_is_that_of_mujocos_torque():
    h = 1e-3
    for q in random_q(model, 20, 13):
        slope = slope_at(q)
        assert_same(slope, slope.T, 1e-11)
        for j, step in enumerate(h * np.eye(7)):  # Richardson's: h^4 is left
            wide = (bias(q + 2 * step) - bias(q - 2 * step)) / (4 * h)
            narrow = (bias(q + step) - bias(q - step)) / (2 * h)
            assert_same(slope[:, j], (4 * narrow - wide) / 3, 1e-9)


def test_one_hinge_falls_up_or_down_as_its_weight_stands():
    J = np.array([[0.0, 1, 0, 0, 0, 0]]).T
    g = (0.0, 0.0, -9.81)
    for at, known in (((0, 0, 1), -19.62), ((0, 0, -1), 19.62), ((1, 0, 0), 0.0)):
        assert_same(optimal.gravity_stiffness(J, [2], [at], g), [[known]], 1e-13)
    J = np.array([[0.0, 1, 0, 0, 0, 0], [0, 1, 0, -1, 0, 0]]).T
    both = optimal.gravity_stiffness(J, [0, 1], [[0, 0, 0], [0, 0, 2]], g)
    assert_same(both, -9.81 * np.array([[2, 1], [1, 1]]), 1e-13)


def test_a_step_near_rest_is_mujocos():
    for q in [panda.READY_Q, *random_q(model, 5, 13)]:
        data = simulate.start(model, q)
        data.ctrl[:] = data.qfrc_bias
        A, B = np.zeros((14, 14)), np.zeros((14, 7))
        mujoco.mjd_transitionFD(model, data, 1e-6, True, A, B, None, None)
        h = model.opt.timestep
        ours = optimal.linearise(arm.at(q).M, slope_at(q), arm.damping, h)
        assert_same(ours[0], A, 1e-8)
        assert_same(ours[1], B, 1e-7 * np.abs(B).max())


def test_by_hand_one_step_of_one_joint():
    A, B = optimal.linearise([[1.0]], [[10.0]], [1.0], 0.1)
    assert_same(A, [[10 / 11, 1 / 11], [-10 / 11, 10 / 11]], 1e-15)
    assert_same(B, [[0.1 / 11], [1 / 11]], 1e-15)


def test_riccati_ends_at_scipys_and_holds_the_arm():
    now = arm.at(panda.READY_Q)
    h = model.opt.timestep
    A, B = optimal.linearise(now.M, slope_at(panda.READY_Q), arm.damping, h)
    Q, R = np.diag([100.0] * 7 + [1.0] * 7), 0.01 * np.eye(7)
    P = Q
    for _ in range(1_500):
        P, K = optimal.riccati_step(P, A, B, Q, R)
    known = scipy.linalg.solve_discrete_are(A, B, Q, R)
    assert_same(P, known, 1e-9 * np.abs(known).max())
    assert np.abs(np.linalg.eigvals(A - B @ K)).max() < 1


def test_the_golden_ratio_is_what_one_of_everything_costs():
    one = np.eye(1)
    P = one
    for _ in range(60):
        P, K = optimal.riccati_step(P, one, one, one, one)
    golden = (1 + np.sqrt(5)) / 2
    assert_same(P, [[golden]], 1e-14)
    assert_same(K, [[golden - 1]], 1e-14)
    A, B = np.array([[1.0, 1], [0, 1]]), np.array([[0.0], [1]])
    P, K = optimal.riccati_step(np.eye(2), A, B, np.eye(2), np.eye(1))
    assert_same(P, [[2, 1], [1, 2.5]], 1e-15)
    assert_same(K, [[0, 0.5]], 1e-15)
    assert optimal.cost_to_go(P, [1, 2]) == pytest.approx(16)


@given(st.integers(1, 5), st.integers(0, 2**32 - 1))
@settings(max_examples=60, deadline=None)
def test_the_best_of_a_box_is_the_best_of_all_sets_of_limits(n, seed):
    global rng
    rng = np.random.default_rng(seed)
    H, g, lo, hi = box(n)
    known = enumerated(H, g, lo, hi)
    found = optimal.box_qp(H, g, lo, hi, 3 * rng.normal(size=n))
    assert_same(found, known, 1e-10)
    assert optimal.kkt_residual(H, g, lo, hi, found) < 1e-12
    assert optimal.kkt_residual(H, g, lo, hi, found + 0.1) > 1e-3


def test_the_box_is_scipys_from_any_start():
    for _ in range(60):
        H, g, lo, hi = box(7)
        hi = hi + 1e-3  # lsq_linear wants a box that is open
        C = np.linalg.cholesky(H).T
        known = scipy_box(C, -np.linalg.solve(C.T, g), lo, hi)
        one, other = (
            optimal.box_qp(H, g, lo, hi, start) for start in 3 * rng.normal(size=(2, 7))
        )
        assert_same(one, known, 1e-8)
        assert_same(one, other, 1e-12)


def test_where_steps_of_whole_length_go_in_circles_halved_ones_arrive():
    H = np.array([[23.0, 15, 21], [15, 14, 13], [21, 13, 23]])
    found = optimal.box_qp(H, [9, -2, 6], -np.ones(3), np.ones(3), [0, 0, -1])
    assert_same(found, [-1, 1, 2 / 23], 1e-14)
    for _ in range(300):
        C = rng.integers(-3, 4, (4, 4)).astype(float)
        H = C @ C.T + np.eye(4)
        g = rng.integers(-9, 10, 4).astype(float)
        start = rng.integers(-1, 2, 4).astype(float)
        found = optimal.box_qp(H, g, -np.ones(4), np.ones(4), start)
        assert optimal.kkt_residual(H, g, -np.ones(4), np.ones(4), found) < 1e-12


def test_by_hand_the_clipped_optimum_is_not_the_best():
    best = optimal.box_qp(H2, G2, -ONE, ONE, np.zeros(2))
    assert_same(best, [0.5, 1], 1e-15)
    assert_same(np.linalg.solve(H2, -G2), [-2, 6], 1e-14)
    residual = [
        optimal.kkt_residual(H2, G2, -ONE, ONE, x) for x in ([0.5, 1], [-1, 1], [0, 0])
    ]
    assert_same(residual, [0, 2, 1], 1e-15)
    assert_same(optimal.bound_multipliers(H2, G2, -ONE, ONE, best), [0, -7.5], 1e-15)


def test_prices_are_the_slopes_of_the_least_cost():
    held = 0
    for _ in range(40):
        H, g, lo, hi = box(4)
        hi = hi + 0.1
        x = optimal.box_qp(H, g, lo, hi, np.zeros(4))
        prices = optimal.bound_multipliers(H, g, lo, hi, x)
        margin = np.minimum(np.abs(x - lo), np.abs(x - hi))
        if np.any((margin > 0) & (margin < 1e-3)) or np.any(
            (margin == 0) & (np.abs(prices) < 1e-3)
        ):
            continue  # a limit that begins to hold, or ceases to
        h = 1e-5
        for j, side in enumerate(h * np.eye(4)):
            costs = []
            for move in (side, -side):
                low = lo + move * (x[j] == lo[j])
                high = hi + move * (x[j] == hi[j])
                there = optimal.box_qp(H, g, low, high, x)
                costs.append(cost(H, g, there))
            known = (costs[0] - costs[1]) / (2 * h)
            assert_same(prices[j], known, 1e-7)
            held += prices[j] != 0
    assert held > 20


def test_the_step_with_limits_is_best_and_without_them_day_3s():
    J = np.zeros((6, 7))
    J[3, 0] = J[3, 1] = J[4, 2] = 1
    e = np.array([0, 0, 0, 1, 0.5, 0])
    wide = 10 * np.ones(7)
    free = optimal.qp_ik(J, e, np.ones(6), 0.1, -wide, wide)
    assert_same(free[:3], [1 / 2.01, 1 / 2.01, 0.5 / 1.01], 1e-14)
    wide[0] = 0.3
    tight = optimal.qp_ik(J, e, np.ones(6), 0.1, -wide, wide)
    assert_same(tight, [0.3, 0.7 / 1.01, 0.5 / 1.01, 0, 0, 0, 0], 1e-14)
    for q in random_q(model, 50, 13):
        J = arm.at(q).J_space
        e, weights = rng.normal(size=6), rng.uniform(0.1, 2, 6)
        rows = np.vstack([np.sqrt(weights)[:, None] * J, 0.02 * np.eye(7)])
        right = np.append(np.sqrt(weights) * e, np.zeros(7))
        limits = rng.uniform(0.05, 0.5, 7)
        known = scipy_box(rows, right, -limits, limits)
        found = optimal.qp_ik(J, e, weights, 0.02, -limits, limits)
        assert_same(found, known, 1e-8)


def test_the_backward_pass_is_one_dense_solve_of_the_whole_horizon():
    for _ in range(10):
        parts = motion()
        T, _, m = parts[1].shape
        k, K, drop = optimal.ilqr_backward(*parts, 0.0)
        H, g, _ = dense(*parts, np.zeros(3))
        best = np.linalg.solve(H, -g)
        x, inputs = np.zeros(3), []
        for t in range(T):
            inputs.append(k[t] + K[t] @ x)
            x = parts[0][t] @ x + parts[1][t] @ inputs[-1]
        scale = np.abs(best).max()
        assert_same(np.ravel(inputs), best, 1e-10 * scale)
        saved = -cost(H, g, best)
        assert optimal.expected_reduction(drop, 1.0) == pytest.approx(saved, rel=1e-9)
        for alpha in (0.5, 0.25):
            x, there = np.zeros(3), []
            for t in range(T):
                there.append(alpha * k[t] + K[t] @ x)
                x = parts[0][t] @ x + parts[1][t] @ there[-1]
            promised = optimal.expected_reduction(drop, alpha)
            assert -cost(H, g, np.ravel(there)) == pytest.approx(promised, rel=1e-8)
            after = cost(H, g, np.ravel(there))
            assert optimal.reduction_ratio(0.0, after, promised) == pytest.approx(1)
        assert k.shape == (T, m)


def test_without_slopes_the_backward_pass_is_riccatis():
    n, m, T = 3, 2, 5
    A, B = rng.normal(size=(n, n)), rng.normal(size=(n, m))
    Q, R = definite(n), definite(m)
    zero = np.zeros((T, n)), np.zeros((T, m))
    many = [np.tile(one, (T, 1, 1)) for one in (A, B, Q, R, np.zeros((m, n)))]
    k, K, drop = optimal.ilqr_backward(*many[:2], *zero, *many[2:], np.zeros(n), Q, 0)
    P = Q
    for t in reversed(range(T)):
        P, gain = optimal.riccati_step(P, A, B, Q, R)
        assert_same(K[t], -gain, 1e-12)
    assert_same(k, np.zeros((T, m)), 1e-15)
    assert_same(drop, np.zeros(2), 1e-15)


def test_mu_shortens_the_steps_and_is_in_the_cost_that_is_handed_back():
    """Two steps of x + u: the last one by hand, the first with what it leaves."""
    one, zero = np.ones((2, 1, 1)), np.zeros((2, 1))
    at = np.array([[0.0], [0.0]])
    k, K, drop = optimal.ilqr_backward(one, one, at, zero, one, one, 0 * one,
                                       [1], [[1]], 0)  # fmt: skip
    assert_same(k[:, 0], [-0.2, -0.5], 1e-15)
    assert_same(K[:, 0, 0], [-0.6, -0.5], 1e-15)
    assert_same(drop, [-0.6, 0.3], 1e-15)
    k, K, drop = optimal.ilqr_backward(one, one, at, zero, one, one, 0 * one,
                                       [1], [[1]], 2)  # fmt: skip
    assert_same([k[1, 0], K[1, 0, 0]], [-0.25, -0.25], 1e-15)
    Vx, Vxx = 1 - 0.25, 1 + 1 - 0.25  # of the long form, too
    quu = 1 + Vxx + 2
    assert_same([k[0, 0], K[0, 0, 0]], [-Vx / quu, -Vxx / quu], 1e-15)
    assert_same(drop, [-0.25 - Vx**2 / quu, 0.125 + 0.5 * Vx**2 / quu], 1e-15)


def test_a_step_should_save_alpha_and_alpha_squared():
    assert optimal.expected_reduction([-4, 2], 1) == 2
    assert optimal.expected_reduction([-4, 2], 0.5) == 1.5
    assert optimal.reduction_ratio(5, 3.5, 2) == 0.75


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: optimal.gravity_stiffness(
            np.eye(6), np.ones(6), np.ones((6, 3)), 9.81),
         "g is the number 9.81"),
        (lambda: optimal.linearise(np.eye(2), np.eye(2), ONE, 0), "h is 0"),
        (lambda: optimal.riccati_step(H2, H2, np.eye(3), H2, H2), "P has shape"),
        (lambda: optimal.cost_to_go(np.eye(3), ONE), "P has shape"),
        (lambda: optimal.box_qp(H2, G2, ONE, -ONE, ONE), "the box is empty"),
        (lambda: optimal.qp_ik(np.ones((6, 2)), np.ones(6), -np.ones(6), 1, -ONE, ONE),
         "must not be below 0"),
        (lambda: optimal.qp_ik(np.ones((6, 2)), np.ones(6), np.ones(6), 0, -ONE, ONE),
         "damping is 0"),
        (lambda: optimal.reduction_ratio(1, 1, 0), "expected is 0"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_said_in_one_line(call, told):
    with pytest.raises(ValueError, match=told):
        call()
