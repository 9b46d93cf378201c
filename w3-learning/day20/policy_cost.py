"""20.6 `policy_cost(K, std, A, B, Q, R, S, T)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

from .carts import cart, moments, of_sizes, problem, problems, shared_noise

row = Row(Scalar())


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


@row.wrongs(hidden={"noise-shared": "the cart has a single input"})
def _(K, std, A, B, Q, R, S, T):
    """noise-not-propagated: your code omits the effect of the noise on the state. Add
      std^2 B B^T to E[x x^T] in each step, or std^2 tr(B^T P B) to the cost, where P is
      the cost-to-go matrix of the next state
    noise-costs-nothing: your code omits the cost of the noise in the input. Add std^2
      tr(R) to the cost in each step
    control-free: your code omits K^T R K, the cost of the mean input. Use Q + K^T R K
      instead of Q for the cost of each step
    one-step-more: your code adds the cost of the state after the last step as well. Add
      only the costs of the T states before the steps
    without-the-start: your code begins the sum with the state after the first step.
      Begin with the state at the start, whose matrix E[x x^T] is S
    sign-of-K: your code uses A + B K as the closed-loop matrix. Use A - B K instead,
      because the mean input is u = -K x
    noise-once: your code adds the cost of the noise in the input only once. Add std^2
      tr(R) in each of the T steps
    transposed: your code uses M^T X M for X = E[x x^T], or M P M^T for a cost-to-go
      matrix P, where M = A - B K. Use M X M^T or M^T P M instead, because the mean of
      the next state is M x
    noise-shared: in E[x x^T], your code uses the same noise for all inputs. Add std^2 B
      B^T instead, because the entries of z are independent
    last-state-added: your code adds the cost x^T Q x of the state after the last step.
      Add only the costs of the T states before the steps
    traces-multiplied: your code multiplies the trace of Q + K^T R K by the trace of E[x
      x^T]. Use the trace of the matrix product instead
    P-one-late: your code computes the cost of the noise with the cost-to-go matrix of
      the state before the step. Use the matrix of the state after the step, because the
      noise in a step changes only that state
    std-not-squared: your code uses std instead of the variance std^2. Use std^2 B B^T
      in E[x x^T] and std^2 tr(R) in the cost of each step
    """
    weight = Q + K.T @ R @ K
    X = moments(K, std, A, B, S, T)
    own = std**2 * np.trace(R)

    def total(weight, X, noise=T * own):
        return noise + sum(np.trace(weight @ one) for one in X)

    root = max(std, 0.0) ** 0.5
    quiet = moments(K, std, A, B, S, T, noise=False)
    other = moments(-K, std, A, B, S, T)
    M = A - B @ K
    turned = [S]
    for _ in range(T - 1):
        turned.append(M.T @ turned[-1] @ M + std**2 * B @ B.T)
    late, to_go = 0.0, np.zeros(Q.shape)
    for _ in range(T):
        to_go = weight + M.T @ to_go @ M
        late = late + own + std**2 * np.trace(B.T @ to_go @ B)
    traces = [np.trace(weight) * np.trace(one) for one in X[:-1]]
    return {
        "noise-shared": total(weight, shared_noise(K, std, A, B, S, T)),
        "last-state-added": total(weight, X[:-1]) + np.trace(Q @ X[-1]),
        "traces-multiplied": T * own + sum(traces),
        "P-one-late": np.trace(to_go @ S) + late,
        "noise-not-propagated": total(weight, quiet[:-1]),
        "noise-costs-nothing": total(weight, X[:-1], 0),
        "control-free": total(Q, X[:-1]),
        "one-step-more": total(weight, X),
        "without-the-start": total(weight, X[1:]),
        "sign-of-K": total(weight, other[:-1]),
        "noise-once": total(weight, X[:-1], own),
        "transposed": total(weight, turned),
        "std-not-squared": total(
            weight, moments(K, root, A, B, S, T)[:-1], T * std * np.trace(R)),
    }  # fmt: skip


@row.right  # By the cost-to-go, from the last step to the first.
def _(K, std, A, B, Q, R, S, T):
    M = A - B @ K
    P, cost = np.zeros(Q.shape), 0.0
    for _ in range(T):
        cost = cost + std**2 * np.trace(R + B.T @ P @ B)
        P = Q + K.T @ R @ K + M.T @ P @ M
    return cost + np.sum(P * S)


@row.right  # With E[u u^T] of each step.
def _(K, std, A, B, Q, R, S, T):
    cost, X = 0.0, S
    for _ in range(T):
        U = K @ X @ K.T + std**2 * np.eye(len(R))
        cost = cost + np.trace(Q @ X) + np.trace(R @ U)
        X = A @ X @ A.T - A @ X @ K.T @ B.T - B @ K @ X @ A.T + B @ U @ B.T
    return cost


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        yield of_sizes(size)(rng)
    yield problem(rng, 2, 1, 0.5, 30)
    yield cart(rng)


row.at_least_0(std="a standard deviation", T="a number", answer="a cost")
