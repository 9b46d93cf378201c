"""20.7 `policy_cost_gradient(K, std, A, B, Q, R, S, T)`: questions and mistakes."""

import numpy as np

from labkit.judge import Matrix, Row
from robo47 import optimal

from .carts import cart, moments, of_sizes, problem, problems, shared_noise

row = Row(Matrix((None, None)), near=1e-3)  # a difference quotient is near


@row.inputs
def _(rng):
    yield from problems(rng)


row.cases(
    a_policy_without_noise=lambda K, std, A, B, Q, R, S, T: std == 0,
    a_policy_with_noise=lambda K, std, A, B, Q, R, S, T: std > 0,
)
row.cases(
    one_step=lambda K, std, A, B, Q, R, S, T: T == 1,
    several_steps=lambda K, std, A, B, Q, R, S, T: T > 1,
)
row.cases(
    a_single_input=lambda K, std, A, B, Q, R, S, T: len(K) == 1,
    several_inputs=lambda K, std, A, B, Q, R, S, T: len(K) > 1,
)


def costs_to_go(K, A, B, Q, R, T, last=None, by=None):
    """Return P from before the first step to after the last: P_0, ..., P_T = 0.

    P_T may be another matrix `last`, and `by` may replace M^T in the recursion.
    """
    M = A - B @ K
    left = M.T if by is None else by
    out = [np.zeros(Q.shape) if last is None else last]
    for _ in range(T):
        out.append(Q + K.T @ R @ K + left @ out[-1] @ left.T)
    return out[::-1]


@row.wrongs(hidden={"noise-shared": "the cart has a single input"})
def _(K, std, A, B, Q, R, S, T):
    """P-one-late: your code uses the cost-to-go matrix P of the state before the step.
      Use the matrix of the state after the step, because the input of a step affects
      later costs only through the next state
    two-forgotten: your code omits the factor 2. Multiply the gradient by 2, because the
      cost of each step is quadratic in the input
    moments-forgotten: your code omits E[x x^T]. The gain multiplies the state, so
      multiply the contribution of each step by E[x x^T] of this step
    future-forgotten: your gradient contains only the term R K of the input cost.
      Include the derivative of the cost-to-go after the step, because the input also
      changes the next state
    noise-forgotten: your code omits the noise in E[x x^T]. Add std^2 B B^T to E[x x^T]
      in each step, as in `policy_cost`
    start-only: your code uses S as E[x x^T] in every step. Compute E[x x^T] for each
      step instead, because this matrix is S only at the start
    noise-shared: in E[x x^T], your code uses the same noise for all inputs. Add std^2 B
      B^T instead, because the entries of z are independent
    X-one-late: your code uses E[x x^T] after each step. Use E[x x^T] before the step
      instead, because the input -K x contains the state x before the step
    orders-mixed: your code pairs the first E[x x^T] with the last cost-to-go matrix P.
      E[x x^T] is computed forwards and P backwards, so store one of the two sequences
    sign-of-B: your code adds B^T P M to R K. Subtract B^T P M instead, because M = A -
      B K contains -B K
    first-step-only: your code returns only the contribution of the first step. The gain
      acts in each of the T steps, so add the contributions of all steps
    P-transposed: your code updates P with M P M^T, where M = A - B K. The cost of the
      next state M x is x^T M^T P M x, so use M^T P M instead
    cost-after-the-last-step: your code uses Q as the cost-to-go matrix P after the last
      step. Begin with P = 0, because no cost follows the last step
    optimal-P: your code computes P with the optimal gain from the Riccati recursion.
      Use P = Q + K^T R K + M^T P M instead, which holds for the given gain K
    return-sign: your gradient has the wrong sign. Return the gradient of the cost,
      which is minus the gradient of the return
    effort-forgotten: your code omits K^T R K, the cost of the mean input, from the
      cost-to-go matrix P. Add K^T R K to Q when you compute P
    """
    M = A - B @ K
    P = costs_to_go(K, A, B, Q, R, T)
    X = moments(K, std, A, B, S, T)[:-1]
    quiet = moments(K, std, A, B, S, T, noise=False)[:-1]
    free = costs_to_go(K, A, B, Q, 0 * R, T)

    def total(P, X):
        return sum(2 * (R @ K - B.T @ p @ M) @ x for p, x in zip(P, X, strict=True))

    def with_optimal_P():
        best = [np.zeros(Q.shape)]
        for _ in range(T):
            best.append(optimal.riccati_step(best[-1], A, B, Q, R)[0])
        return total(best[-2::-1], X)

    right = total(P[1:], X)
    X_after = moments(K, std, A, B, S, T)[1:]
    ends = costs_to_go(K, A, B, Q, R, T, last=Q)
    none = [np.zeros(Q.shape)] * T
    return {
        "P-one-late": total(P[:-1], X),
        "noise-shared": total(P[1:], shared_noise(K, std, A, B, S, T)),
        "X-one-late": total(P[1:], X_after),
        "orders-mixed": total(P[:0:-1], X),
        "sign-of-B": sum(2 * (R @ K + B.T @ p @ M) @ x
                         for p, x in zip(P[1:], X, strict=True)),
        "first-step-only": total(P[1:2], X[:1]),
        "P-transposed": total(costs_to_go(K, A, B, Q, R, T, by=M)[1:], X),
        "cost-after-the-last-step": total(ends[1:], X),
        "optimal-P": with_optimal_P,
        "two-forgotten": right / 2,
        "moments-forgotten": total(P[1:], [np.eye(len(S))] * T),
        "future-forgotten": total(none, X),
        "noise-forgotten": total(P[1:], quiet),
        "start-only": total(P[1:], [S] * T),
        "return-sign": -right,
        "effort-forgotten": total(free[1:], X),
    }  # fmt: skip


def cost(K, std, A, B, Q, R, S, T):
    """Return the part of the cost that depends on K."""
    X = moments(K, std, A, B, S, T)[:-1]
    return sum(np.trace((Q + K.T @ R @ K) @ one) for one in X)


@row.right  # By the complex step through the cost.
def _(K, std, A, B, Q, R, S, T):
    slope = np.zeros(K.shape)
    for at in np.ndindex(K.shape):
        some = K.astype(complex)
        some[at] += 1e-30j
        slope[at] = cost(some, std, A, B, Q, R, S, T).imag / 1e-30
    return slope


@row.right  # By the derivative of E[x x^T], entry by entry.
def _(K, std, A, B, Q, R, S, T):
    M, weight = A - B @ K, Q + K.T @ R @ K
    slope = np.zeros(K.shape)
    for at in np.ndindex(K.shape):
        dK = np.zeros(K.shape)
        dK[at] = 1.0
        X, dX = S, np.zeros(S.shape)
        for _ in range(T):
            slope[at] += np.trace(weight @ dX) + 2 * np.trace(K.T @ R @ dK @ X)
            half = -B @ dK @ X @ M.T
            dX = M @ dX @ M.T + half + half.T
            X = M @ X @ M.T + std**2 * B @ B.T
    return slope


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        yield of_sizes(size)(rng)
    yield problem(rng, 2, 1, 0.5, 30)
    yield cart(rng)


row.at_least_0(std="a standard deviation", T="a number")
