"""Day 20: learning from reward, with an exact gradient beside every estimate.

    make day20                       in the clone: sets all up, then runs this
    python src/day20_reward.py       in w3-learning/, once that is done

Time comes first: the rewards of T steps in n episodes are an array (T, n). A policy
draws its action from a Gaussian whose mean depends on the state.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, cloning, reward
from robo47.lesson.lab import Lab
from robo47.optimal import riccati_step
from robo47.policy import success_rate

import day15_mujoco

SEED = 2  # of the demonstrations, the initial weights and all draws
# The cart of Day 13: a position and a velocity, pushed by a force.
A = np.array([[1.0, 0.1], [0.0, 1.0]])
B = np.array([[0.005], [0.1]])
Q = np.diag([1.0, 0.1])  # cost of the state
R = np.array([[0.1]])  # cost of the force
START = np.diag([1.0, 0.5])  # variances of the first state
GAIN = np.array([[1.0, 1.5]])  # of the policy whose gradient is estimated
STD = 0.5  # of its force
# One action of one step: its mean, the best action, and its std.
MU, TARGET, NOISE = 1.2, 0.5, 0.4
DRAWS = 40_000  # of this action
HORIZON = 30  # steps of an episode of the cart
BATCHES, EACH = 200, 100  # estimates of the gradient, and episodes of each
PIECES = 10  # of all episodes, each of which is one call of your functions
DESCENT, STEP_SIZE = 300, 0.1  # steps along the exact gradient, and their size
# The puck of Day 15.
DEMOS = 20  # demonstrations of the clone
UNITS = 32  # of each hidden layer
UPDATES, BATCH, RATE = 1000, 256, 0.003  # of the clone's training
EXPLORE = 0.4  # std of the policy, in standard deviations of the actions
WORTH = 10.0  # 1/m, the reward for each metre that the puck comes closer to home
ITERATIONS = 25  # of PPO
EPISODES = 128  # of each iteration
EPOCHS, PARTS = 4, 6  # passes over the data of an iteration, and batches of a pass
PPO_RATE, CLIP, GAMMA, LAM = 0.001, 0.2, 0.98, 0.95
SHUFFLED = False  # True: each action gets the advantage of another
STARTS_SEED = 1000  # of the starts that policies are tested on
TESTED = 200  # starts
TICK, TOUCH = day15_mujoco.TICK, day15_mujoco.R  # s and m


def log_prob(action: np.ndarray, mean: np.ndarray, log_std: np.ndarray) -> np.ndarray:
    """Return the logarithm of a Gaussian's density at each action, (n,).

    action and mean are (n, m). The m entries of an action are independent, and log_std
    (m,) has the logarithms of their standard deviations. The result is finite for an
    action far from its mean as well.
    log_prob([[1]], [[0]], [0.693147]) -> [-1.737086]
    """
    # region 20.1
    z = (action - mean) / np.exp(log_std)  # standardised distance from the mean
    each = -(z**2) / 2 - log_std - np.log(2 * np.pi) / 2  # log-density of each entry
    return each.sum(axis=1)  # the logarithm of the product
    # endregion 20.1


def log_prob_gradient(
    action: np.ndarray, mean: np.ndarray, log_std: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the gradients of `log_prob` with respect to mean and to log_std.

    `log_prob` has the same arguments. Each row of the results, (n, m) both, belongs to
    one action.
    log_prob_gradient([[1]], [[0]], [0.693147]) -> ([[0.25]], [[-0.75]])
    """
    # region 20.1
    std = np.exp(log_std)  # standard deviation of each entry
    z = (action - mean) / std  # standardised distance from the mean
    return z / std, z**2 - 1  # derivatives with respect to mean and log_std
    # endregion 20.1


def returns(reward: np.ndarray, gamma: float, last: np.ndarray) -> np.ndarray:
    """Return the discounted return from each step on, (T, n).

    reward is (T, n), and last (n,) is the value of the state after the last step. The
    discount factor gamma is from 0 to 1. Rewards 1, 2, 3 of one episode with gamma 0.5
    and last 4 have the returns 3.25, 4.5, 5.
    """
    # region 20.2
    out = np.zeros(reward.shape)  # the returns
    after = last  # return from the next step on
    for t in reversed(range(len(reward))):
        after = reward[t] + gamma * after  # return from the present step on
        out[t] = after  # the stored return
    return out
    # endregion 20.2


def gae(
    reward: np.ndarray,
    value: np.ndarray,
    next_value: np.ndarray,
    terminated: np.ndarray,
    ended: np.ndarray,
    gamma: float,
    lam: float,
) -> np.ndarray:
    """Return the generalized advantage estimate of each step, (T, n).

    All arrays are (T, n). value and next_value are the values of the states before and
    after each step. terminated is True where the state after the step is worth 0. ended
    is True at the last step of an episode, and always in the last row. At these steps,
    terminated is True for a true end and False for an episode that was cut off, and the
    next row belongs to another episode. Elsewhere next_value is the value of the next
    row. The factors gamma and lam are from 0 to 1. Rewards 1, 1 with the values 0.5,
    0.5, the next values 0.5, 2, and both factors 0.5 give 1.125, 1.5 if the second step
    is cut off, and 0.875, 0.5 if it terminates.
    """
    # region 20.3
    worth = np.where(terminated, 0, next_value)  # value of the state after the step
    delta = reward + gamma * worth - value  # temporal-difference errors
    out = np.zeros(reward.shape)  # the advantages
    after = np.zeros(reward.shape[1])  # advantage of the next step
    for t in reversed(range(len(reward))):
        kept = np.where(ended[t], 0, after)  # advantage of the next step, or 0
        after = delta[t] + gamma * lam * kept  # advantage of the present step
        out[t] = after  # the stored advantage
    return out
    # endregion 20.3


def policy_gradient(score: np.ndarray, advantage: np.ndarray) -> np.ndarray:
    """Return an estimate of the gradient of the expected return, (d,).

    score (T, n, d) has the gradient of each action's log-probability with respect to
    the d parameters, and advantage (T, n) the weight of each action. The estimate is a
    mean over the n episodes. One episode with the scores 1, 2 and the advantages 3, 1
    gives 5.
    """
    # region 20.4
    each = (score * advantage[:, :, None]).sum(axis=0)  # sum over each episode's steps
    return each.mean(axis=0)  # the mean over the episodes
    # endregion 20.4


def ppo_loss(
    logp: np.ndarray, old_logp: np.ndarray, advantage: np.ndarray, clip: float
) -> tuple[float, np.ndarray]:
    """Return PPO's clipped loss and its gradient with respect to logp, (n,).

    logp and old_logp (n,) are the log-probabilities of the actions by the present
    policy and by the policy that drew them; r = exp(logp - old_logp). The loss is minus
    the mean of min(r A, r' A), where A is the advantage, and r' is r clipped to the
    range from 1 - clip to 1 + clip. A ratio r that overflows should not give NaN.
    ppo_loss([0.405465, -0.693147], [0, 0], [1, -1], 0.2) -> (-0.2, [0, 0])
    """
    # region 20.5
    ratio = np.exp(np.minimum(logp - old_logp, 600))  # ratios; none overflows
    plain = ratio * advantage  # terms without clipping
    clipped = np.clip(ratio, 1 - clip, 1 + clip) * advantage  # terms with clipping
    loss = -np.mean(np.minimum(plain, clipped))  # the clipped loss
    return loss, np.where(plain <= clipped, -plain / len(ratio), 0)  # loss and gradient
    # endregion 20.5


def policy_cost(
    K: np.ndarray,
    std: float,
    A: np.ndarray,
    B: np.ndarray,
    Q: np.ndarray,
    R: np.ndarray,
    S: np.ndarray,
    T: int,
) -> float:
    """Return the expected cost of T steps with the policy u = -K x + std z.

    The entries of z are independent standard normal numbers. The system is x+ = A x + B
    u, and a step costs x^T Q x + u^T R u with symmetric Q and R. S is the matrix
    E[x x^T] at the start. With 1 for all matrices but K = 0.5, and T = 2, the cost is
    1.5625 for std 0 and 4.8125 for std 1.
    """
    # region 20.6
    M = A - B @ K  # the closed loop
    weight = Q + K.T @ R @ K  # cost matrix of the state and the mean input
    cost = T * std**2 * np.trace(R)  # cost of the noise itself
    X = S  # matrix E[x x^T]
    for _ in range(T):
        cost = cost + np.trace(weight @ X)  # the accumulated cost
        X = M @ X @ M.T + std**2 * B @ B.T  # matrix E[x x^T] after the step
    return cost
    # endregion 20.6


def policy_cost_gradient(
    K: np.ndarray,
    std: float,
    A: np.ndarray,
    B: np.ndarray,
    Q: np.ndarray,
    R: np.ndarray,
    S: np.ndarray,
    T: int,
) -> np.ndarray:
    """Return the gradient of `policy_cost` with respect to K, in its shape.

    `policy_cost` has the same arguments. With 1 for all matrices but K = 0.5, and
    T = 2, the gradient is 0 for std 0 and 1 for std 1.
    """
    # region 20.7
    M = A - B @ K  # the closed loop
    moments = [S]  # matrix E[x x^T] before each step
    for _ in range(T - 1):
        moments.append(M @ moments[-1] @ M.T + std**2 * B @ B.T)
    P = np.zeros(Q.shape)  # cost-to-go after the last step
    slope = np.zeros(K.shape)  # the initial gradient
    for X in reversed(moments):
        slope = slope + 2 * (R @ K - B.T @ P @ M) @ X  # accumulated gradient
        P = Q + K.T @ R @ K + M.T @ P @ M  # cost-to-go from the present step on
    return slope
    # endregion 20.7


def effective_samples(logp: np.ndarray, old_logp: np.ndarray) -> float:
    """Return how many samples the reweighted ones are worth, (sum w)^2 / sum w^2.

    The importance weights are w = exp(logp - old_logp). Neither a very large nor a very
    small weight should give NaN. Weights 3 and 1 are worth 1.6 samples.
    """
    # region 20.8
    exponent = logp - old_logp  # logarithms of the weights
    w = np.exp(exponent - exponent.max())  # scaled weights; the largest is 1
    return w.sum() ** 2 / np.sum(w**2)  # the effective number of samples
    # endregion 20.8


def shaped(reward: np.ndarray, potential: np.ndarray, gamma: float) -> np.ndarray:
    """Return rewards with potential-based shaping, (T, n).

    reward is (T, n). potential (T + 1, n) is the potential of the state before each
    step and after the last one. Rewards 1, 1 with the potentials 0, 2, 4 and gamma 0.5
    become 2, 1.
    """
    # region 20.9
    return reward + gamma * potential[1:] - potential[:-1]  # the shaped rewards
    # endregion 20.9


def check_gaussian(lab: Lab, rng: np.random.Generator) -> None:
    """Compare your log-probability with the density, its gradient with differences."""
    action, mean = rng.normal(size=(2, 5, 2))
    log_std = np.log([0.5, 1.7])
    std = np.exp(log_std)
    density = np.exp(-(((action - mean) / std) ** 2) / 2) / (std * np.sqrt(2 * np.pi))
    off = np.exp(log_prob(action, mean, log_std)) - density.prod(axis=1)
    lab.check("exp(log_prob) - the product of densities", off)
    of_mean, of_log_std = log_prob_gradient(action, mean, log_std)

    def total(mean, log_std):
        return np.sum(-(((action - mean) / np.exp(log_std)) ** 2) / 2 - log_std)

    by_mean, by_log_std = cloning.complex_step(total, [mean, log_std])
    off = [*np.ravel(of_mean - by_mean), *(of_log_std.sum(axis=0) - by_log_std)]
    lab.check("its gradient - by the complex step", off)


def check_advantages(lab: Lab, rng: np.random.Generator) -> None:
    """Compare returns and advantages with their definitions as sums."""
    T, gamma, lam = 6, 0.9, 0.7
    some, value, after = rng.normal(size=(3, T, 2))
    powers = gamma ** np.arange(T + 1)
    with_last = np.vstack([some, after[-1]])
    wanted = [powers[: T + 1 - t] @ with_last[t:] for t in range(T)]
    lab.check("returns - by their definition", returns(some, gamma, after[-1]) - wanted)
    ended = np.zeros((T, 2), dtype=bool)
    ended[[1, 3, -1, -1], [0, 1, 0, 1]] = True
    terminated = ended.copy()
    terminated[3, 1] = False  # cut off
    delta = some + gamma * np.where(terminated, 0, after) - value
    wanted = np.zeros((T, 2))
    for t, n in np.ndindex(T, 2):
        for k in range(t, T):
            wanted[t, n] += (gamma * lam) ** (k - t) * delta[k, n]
            if ended[k, n]:
                break
    found = gae(some, value, after, terminated, ended, gamma, lam)
    lab.check("gae - by its definition", found - wanted)
    score = rng.normal(size=(T, 2, 3))
    wanted = sum(score[t, n] * some[t, n] for t, n in np.ndindex(T, 2)) / 2
    lab.check(
        "policy_gradient - by its definition", policy_gradient(score, some) - wanted
    )


def check_loss(lab: Lab) -> None:
    """Compare PPO's loss with its definition on all four sides of the range."""
    ratio = np.array([1.5, 1.5, 0.5, 0.5, 1.1, 0.9])
    advantage = np.array([1.0, -1.0, 1.0, -1.0, 2.0, -3.0])
    kept = np.array([0, 1, 1, 0, 1, 1])  # 0: the clipped term is smaller
    terms = np.where(kept, ratio, [1.2, 0, 0, 0.8, 0, 0]) * advantage
    loss, slope = ppo_loss(np.log(ratio), np.zeros(6), advantage, 0.2)
    lab.check("ppo_loss - by cases", loss + terms.mean())
    lab.check("its gradient - by cases", slope + kept * ratio * advantage / 6)
    some = effective_samples(np.array([2000.0, 2000.0, -900.0]), np.zeros(3))
    lab.check("effective_samples: two equal weights", some - 2)


def exact(lab: Lab) -> np.ndarray:
    """Return the exact gradient of the return, (2,), after checking it."""
    rest = STD, A, B, Q, R, START, HORIZON
    slope = policy_cost_gradient(GAIN, *rest)
    by_steps = cloning.complex_step(cost_by_values, [GAIN])[0]
    cost = policy_cost(GAIN, *rest)
    lab.check("policy_cost - by the values", cost - cost_by_values(GAIN))
    print(f"  expected cost {cost:.4f}")
    print(f"  gradient of the return ({-slope[0, 0]:.3f}, {-slope[0, 1]:.3f})")
    lab.record(
        "exact", slope / by_steps - 1, label="|gradient / by the complex step - 1|"
    )
    return -slope[0]


def cost_by_values(K: np.ndarray):
    """Return the cost of the cart from the value of its start; K may be complex."""
    M = A - B @ K
    P, noise = np.zeros((2, 2)), 0.0
    for _ in range(HORIZON):
        noise = noise + STD**2 * np.trace(R + B.T @ P @ B)
        P = Q + K.T @ R @ K + M.T @ P @ M
    return noise + np.trace(P @ START)


def descend(lab: Lab) -> None:
    """Follow the exact gradient, and compare the end with Riccati's gain."""
    rest = STD, A, B, Q, R, START, HORIZON
    K = GAIN
    for _ in range(DESCENT):
        K = K - STEP_SIZE * policy_cost_gradient(K, *rest)
    P = Q
    for _ in range(10 * HORIZON):
        P, best = riccati_step(P, A, B, Q, R)
    for name, gain in ((f"after {DESCENT} steps", K), ("Riccati's gain", best)):
        print(f"  {name:16} ({gain[0, 0]:.3f}, {gain[0, 1]:.3f}), "
              f"cost {policy_cost(gain, *rest):.4f}")  # fmt: skip


class Cart:
    """Many episodes of the cart with the policy u = -GAIN x + STD z."""

    def __init__(self, rng: np.random.Generator, n: int) -> None:
        """Run n episodes, and compute scores and exact values."""
        x = rng.normal(size=(n, 2)) * np.sqrt(np.diag(START))
        self.x, means, forces, rewards = [x], [], [], []
        for _ in range(HORIZON):
            means.append(-x @ GAIN.T)
            u = means[-1] + STD * rng.normal(size=(n, 1))
            rewards.append(-np.sum(x @ Q * x, axis=1) - np.sum(u @ R * u, axis=1))
            x = x @ A.T + u @ B.T
            forces.append(u)
            self.x.append(x)
        self.reward = np.array(rewards)  # (T, n)
        slope = [
            log_prob_gradient(u, mean, np.log([STD]))[0]
            for u, mean in zip(forces, means, strict=True)
        ]
        self.score = -np.array(slope) * self.x[:-1]  # (T, n, 2), as the mean is -GAIN x
        self.value = self.values()

    def values(self) -> np.ndarray:
        """Return the exact value of each state, (T + 1, n)."""
        M = A - B @ GAIN
        P, noise = np.zeros((2, 2)), 0.0
        out = []
        for x in reversed(self.x):
            out.append(-np.sum(x @ P * x, axis=1) - noise)
            noise += STD**2 * np.trace(R + B.T @ P @ B)
            P = Q + GAIN.T @ R @ GAIN + M.T @ P @ M
        return np.array(out[::-1])

    def advantage(self, fraction: float, lam: float) -> np.ndarray:
        """Return the advantages with a fraction of the exact value function."""
        value = fraction * self.value
        end = np.zeros(self.reward.shape, dtype=bool)
        end[-1] = True
        return in_pieces(
            lambda got, now, after, end: gae(got, now, after, end, end, 1.0, lam),
            self.reward, value[:-1], value[1:], end,
        )  # fmt: skip

    def estimates(self, advantage: np.ndarray) -> np.ndarray:
        """Return the estimate of the gradient of each batch, (BATCHES, 2)."""
        pairs = zip(np.split(self.score, BATCHES, axis=1),
                    np.split(advantage, BATCHES, axis=1), strict=True)  # fmt: skip
        return np.array([policy_gradient(*pair) for pair in pairs])


def in_pieces(function, *arrays: np.ndarray) -> np.ndarray:
    """Return a function's result for some episodes at a time, (T, n)."""
    split = [np.array_split(one, PIECES, axis=1) for one in arrays]
    return np.hstack([function(*piece) for piece in zip(*split, strict=True)])


def weights_of(cart: Cart) -> dict[str, np.ndarray]:
    """Return the weights of the actions, (T, n), by the name of the estimator."""
    ahead = in_pieces(lambda got: returns(got, 1.0, 0 * got[0]), cart.reward)
    return {
        "whole return": np.broadcast_to(ahead[0], ahead.shape),
        "return to go": ahead,
        "exact value, lambda 1": cart.advantage(1.0, 1.0),
        "exact value, lambda 0.5": cart.advantage(1.0, 0.5),
        "exact value, lambda 0": cart.advantage(1.0, 0.0),
        "half the value, lambda 1": cart.advantage(0.5, 1.0),
        "half the value, lambda 0.5": cart.advantage(0.5, 0.5),
        "half the value, lambda 0": cart.advantage(0.5, 0.0),
    }


def one_step(lab: Lab, rng: np.random.Generator) -> None:
    """Compare the variance of one-step estimates with the formula, by baseline."""
    z = rng.normal(size=(DRAWS, 1))
    action, mean = MU + NOISE * z, np.full((DRAWS, 1), MU)
    score = log_prob_gradient(action, mean, np.log([NOISE]))[0]
    got = -((action[:, 0] - TARGET) ** 2)
    off = MU - TARGET
    mean_reward = -(off**2) - NOISE**2
    print("  baseline            predicted   measured variance")
    for name, b in (("none", 0.0), ("mean reward", mean_reward),
                    ("best", -(off**2) - 3 * NOISE**2)):  # fmt: skip
        each = score[:, 0] * (got - b)
        variance = np.var(each)
        print(f"  {name:18}{one_step_variance(off, b):11.2f}{variance:11.2f}")
        if name != "none":
            lab.measured(f"variance of one step, baseline: {name}", variance)


def one_step_variance(off: float, b: float) -> float:
    """Return the variance of (reward - b) z / std, for an action `off` its target."""
    c = -(off**2) - b
    s = NOISE**2
    return (c**2 + 12 * off**2 * s + 15 * s**2 - 6 * c * s) / s - 4 * off**2


def estimate(lab: Lab, truth: np.ndarray) -> None:
    """Compare estimates of one gradient: their mean, its error, their deviation."""
    cart = Cart(np.random.default_rng(SEED), BATCHES * EACH)
    print("                              mean          standard   std of")
    print("                                            errors off   one estimate")
    spread = {}
    for name, weight in weights_of(cart).items():
        some = cart.estimates(weight)
        mean, each = some.mean(axis=0), some.std(axis=0, ddof=1)
        off = np.max(np.abs(mean - truth) / each * np.sqrt(BATCHES))
        spread[name] = np.linalg.norm(each), off
        print(f"  {name:27} ({mean[0]:.2f}, {mean[1]:5.2f}) {off:9.1f} "
              f"{spread[name][0]:10.2f}")  # fmt: skip
    best, off = spread["exact value, lambda 1"]
    lab.record("estimate", off, label="standard errors off, with the exact value")
    lab.record("baseline", best / spread["return to go"][0],
               label="std with the exact value / of the return to go")  # fmt: skip
    lab.measured("half the value, lambda 0.5: first entry",
                 cart.estimates(cart.advantage(0.5, 0.5)).mean(axis=0)[0])  # fmt: skip


class Policy:
    """Two networks: the mean of an action, and the value of a state at a time."""

    def __init__(self, seen: np.ndarray, action: np.ndarray) -> None:
        """Store the scalers of demonstrations; `clone` and `ppo` set the networks."""
        self.inputs, self.actions = cloning.fit_scaler(seen), cloning.fit_scaler(action)
        rng = np.random.default_rng(SEED)
        self.actor = cloning.random_net(rng, 4, UNITS, 2)
        self.critic = cloning.random_net(rng, 5, UNITS, 1)
        self.log_std = np.log([EXPLORE, EXPLORE])

    def act(self, seen: np.ndarray) -> np.ndarray:
        """Return the mean action for each observation, m/s, (n, 2)."""
        x = cloning.normalise(seen, self.inputs)
        return cloning.denormalise(cloning.mlp(x, *self.actor), self.actions)

    def clock(self, seen: np.ndarray) -> np.ndarray:
        """Return the critic's inputs, (T, n, 5): observations and the time, -1 to 1."""
        time = np.linspace(-1, 1, day15_mujoco.STEPS + 1)[: len(seen), None, None]
        time = np.broadcast_to(time, (*seen.shape[:2], 1))
        return np.concatenate([cloning.normalise(seen, self.inputs), time], axis=2)


def clone(lab: Lab) -> Policy:
    """Return a policy that was cloned from demonstrations, as on Day 15."""
    # mujoco.mj_step runs the demonstrator
    seen, action, _ = day15_mujoco.demonstrations(DEMOS, SEED).rows()
    policy = Policy(seen, action)
    x = cloning.normalise(seen, policy.inputs)
    target = cloning.normalise(action, policy.actions)
    policy.actor = cloning.fit(
        policy.actor,
        lambda rows, net: cloning.mlp_gradient(x[rows], target[rows], *net),
        cloning.batches(np.random.default_rng(SEED), len(x), BATCH,
                        lab.training("the clone", UPDATES)),
        lambda k: cloning.cosine_rate(k, UPDATES, RATE),
    )  # fmt: skip
    return policy


def episodes(policy: Policy, rng: np.random.Generator):
    """Return observations (T + 1, n, 4), drawn actions and rewards, by the equation."""
    seen, drawn = [day15_mujoco.starts(EPISODES, rng)], []
    for _ in range(day15_mujoco.STEPS):
        mean = cloning.mlp(cloning.normalise(seen[-1], policy.inputs), *policy.actor)
        drawn.append(mean + np.exp(policy.log_std) * rng.normal(size=mean.shape))
        seen.append(moved(seen[-1], cloning.denormalise(drawn[-1], policy.actions)))
    seen = np.array(seen)
    far = np.linalg.norm(seen[:, :, 2:], axis=2)
    return seen, np.array(drawn), WORTH * (far[:-1] - far[1:])


def moved(seen: np.ndarray, action: np.ndarray) -> np.ndarray:
    """Return the observations after an action, by the equation of pushing."""
    action = np.clip(action, -day15_mujoco.FASTEST, day15_mujoco.FASTEST)
    return reward.push_by_equation(seen, action, TICK, TOUCH)


def rows_of(policy: Policy, rng: np.random.Generator):
    """Return one iteration's rows: inputs, actions, log-probabilities, advantages."""
    seen, drawn, got = episodes(policy, rng)
    inputs = policy.clock(seen)
    value = cloning.mlp(inputs, *policy.critic)[:, :, 0]
    end = np.zeros(got.shape, dtype=bool)
    end[-1] = True  # the critic receives the time, so the time limit is a true end
    advantage = gae(got, value[:-1], value[1:], end, end, GAMMA, LAM)
    target = (advantage + value[:-1]).reshape(-1, 1)
    x, drawn = inputs[:-1].reshape(-1, 5), drawn.reshape(-1, 2)
    logp = log_prob(drawn, cloning.mlp(x[:, :4], *policy.actor), policy.log_std)
    advantage = advantage.ravel()
    if SHUFFLED:
        advantage = rng.permutation(advantage)
    return x, drawn, logp, (advantage - advantage.mean()) / advantage.std(), target


def update(policy: Policy, rows) -> list[np.ndarray]:
    """Return the gradients of both networks on some rows."""
    x, drawn, old_logp, advantage, target = rows
    mean = cloning.mlp(x[:, :4], *policy.actor)
    logp = log_prob(drawn, mean, policy.log_std)
    by_logp = ppo_loss(logp, old_logp, advantage, CLIP)[1]
    by_mean = by_logp[:, None] * log_prob_gradient(drawn, mean, policy.log_std)[0]
    # mlp_gradient expects a target: its loss has the gradient 2 (mean - target) / size
    wanted = mean - by_mean * mean.size / 2
    return [*cloning.mlp_gradient(x[:, :4], wanted, *policy.actor),
            *cloning.mlp_gradient(x, target, *policy.critic)]  # fmt: skip


def ppo(lab: Lab, policy: Policy, after=lambda policy, rows: None) -> Policy:
    """Improve a policy by PPO; `after` is called after each iteration."""
    rng = np.random.default_rng(SEED)
    nets = [*policy.actor, *policy.critic]
    theta, step = cloning.flat(nets), 0
    m = v = np.zeros_like(theta)
    for _ in lab.training("by reward", ITERATIONS):
        rows = rows_of(policy, rng)
        for _ in range(EPOCHS):
            for some in np.array_split(rng.permutation(len(rows[0])), PARTS):
                grad = cloning.flat(update(policy, [one[some] for one in rows]))
                step += 1
                theta, m, v = cloning.adam_step(theta, grad, m, v, step, PPO_RATE)
                nets = cloning.shaped(theta, nets)
                policy.actor, policy.critic = nets[:6], nets[6:]
        after(policy, rows)
    return policy


def tested(policy, start: np.ndarray) -> tuple[day15_mujoco.Episodes, np.ndarray]:
    """Return the episodes in MuJoCo, and the last observations by the equation."""
    # mujoco.mj_step runs the policy
    run = day15_mujoco.run(*day15_mujoco.scene(), start, policy)
    seen = start
    for _ in range(day15_mujoco.STEPS):
        seen = moved(seen, policy(seen))
    return run, seen


def at_home(seen: np.ndarray) -> np.ndarray:
    """Return which pucks are at home, (n,)."""
    return np.linalg.norm(seen[:, 2:], axis=1) < day15_mujoco.HOME


def told(name: str, home: np.ndarray, equation: np.ndarray) -> None:
    """Print the rounded numbers of pucks at home, and Wilson's interval."""
    n, other = (5 * round(np.sum(some) / 5) for some in (home, equation))
    _, low, high = success_rate(np.arange(len(home)) < n)
    print(f"  {name:10} about {n:3} of {len(home)}, 95 %: {low:.2f} to {high:.2f}, "
          f"by the equation about {other:3}")  # fmt: skip


def improve(lab: Lab, start: np.ndarray) -> None:
    """Train a clone, improve it by its reward, and test both."""
    policy = clone(lab)
    run, last = tested(policy.act, start)
    before = run.home()
    told("the clone", before, at_home(last))
    fresh = []

    def data_left(policy: Policy, rows) -> None:
        x, drawn, old_logp, *_ = rows
        mean = cloning.mlp(x[:, :4], *policy.actor)
        logp = log_prob(drawn, mean, policy.log_std)
        beyond = np.abs(np.exp(logp - old_logp) - 1) > 0.2
        fresh.append((effective_samples(logp, old_logp) / len(x), np.mean(beyond)))

    ppo(lab, policy, data_left)
    run, last = tested(policy.act, start)
    told("improved", run.home(), at_home(last))
    left, beyond = np.mean(fresh, axis=0)
    print(f"  after an iteration the data are worth {100 * left:.0f} % of the samples,")
    print(f"  and {100 * beyond:.0f} % of the ratios are not within 0.8 and 1.2")
    lab.record("gained", np.sum(run.home()) - np.sum(before), metric="starts",
               label="pucks after minus before", seed=SEED)  # fmt: skip


def two_simulators(lab: Lab, start: np.ndarray) -> None:
    """Compare MuJoCo with the equation, with feedback and without."""
    run, last = tested(day15_mujoco.demonstrator, start)
    seen = start
    for action in run.action.transpose(1, 0, 2):
        seen = moved(seen, action)
    for name, end in (("with feedback", last), ("replayed", seen)):
        off = 1e3 * np.linalg.norm((end - run.observation[:, -1])[:, 2:], axis=1)
        print(f"  {name:14} pucks apart: {np.median(off):.1f} mm in the median, "
              f"{np.max(off):.1f} at most; home {np.sum(at_home(end))}")  # fmt: skip
        lab.measured(f"pucks apart, {name}, mm", np.median(off))


def check_shaping(lab: Lab, rng: np.random.Generator) -> None:
    """Check that shaping changes the returns by the potentials of both ends only."""
    some, potential = rng.normal(size=(9, 3)), rng.normal(size=(10, 3))
    none = np.zeros(3)
    change = returns(shaped(some, potential, GAMMA), GAMMA, none)[0]
    change = change - returns(some, GAMMA, none)[0]
    wanted = GAMMA**9 * potential[-1] - potential[0]
    lab.check("change of the return - by both ends", change - wanted)


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    print(f"MuJoCo {mujoco.mj_versionString()}: a pusher and a puck")

    lab.step("1. Log-probabilities, returns and advantages")
    check_gaussian(lab, rng)
    check_advantages(lab, rng)
    one_step(lab, rng)

    lab.step("2. The loss of PPO")
    check_loss(lab)

    lab.step("3. The exact gradient, and where it leads")
    truth = exact(lab)
    descend(lab)

    lab.step(f"4. {BATCHES} estimates of this gradient, of {EACH} episodes each")
    estimate(lab, truth)
    if lab.failed:
        print("\nNot trained, because a check above failed. ARGS=--try trains anyway.")
        return lab.finish()

    lab.step(f"5. From {DEMOS} demonstrations to a reward")
    start = day15_mujoco.starts(TESTED, np.random.default_rng(STARTS_SEED))
    improve(lab, start)

    lab.step("6. Two simulators")
    two_simulators(lab, start)

    lab.step("7. Side quest: shaped rewards")
    with lab.side_quest():
        check_shaping(lab, rng)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
