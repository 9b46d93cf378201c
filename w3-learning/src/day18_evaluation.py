"""Day 18: data, and whether a difference between two policies is luck.

    make day18                       in the clone: sets all up, then runs this
    python src/day18_evaluation.py   in w3-learning/, once that is done

Rows of data are (observation, action, episode), as on Day 15. A start is one initial
position of pusher and puck; the success of a policy is True or False for each start.
"""

from math import comb

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import chunking, cli, cloning
from robo47.lesson.lab import Lab
from robo47.policy import success_rate

import day15_mujoco

SEED = 1  # of the demonstrations, the initial weights and the batches
EACH = 10  # demonstrations, or runs of the policy, of a round
ROUNDS = 3  # the first has demonstrations only
DRIVES = 60  # actions of each episode that the policy drives; 60 are all of them
WITH_LAST = False  # True: the policy also observes its last action, as the copycat
STARTS_SEED = 1000  # of the starts that policies are tested on
TESTED = 200  # starts
UNITS = 48  # of each hidden layer
UPDATES = 1000  # steps of Adam
BATCH = 256  # rows of a step
RATE = 0.003  # step size at the first update; it falls to 0 as a cosine
WAIT = 120  # actions during which a dawdling demonstrator stands still
DAWDLERS = 20  # demonstrations; half of them stand still first
GAINS = (3.0, 1.0, 0.0)  # 1/s, of the steering, in the test of the error growth
SIDEWAYS = 0.001  # m/s, the constant error of a policy
FAR = 24.0  # m from home
STEPS = 24  # actions until the error is measured
DRAWS = 4000  # of the tests by simulation
LUCK_SEED = 18  # of these draws
R = day15_mujoco.R  # m, sum of both radii


def binomial_pmf(n: int, p: float) -> np.ndarray:
    """Return the probabilities of 0, 1, ..., n successes in n trials, (n + 1,).

    p is the probability of a success in each trial.
    """
    return np.array([comb(n, k) * p**k * (1 - p) ** (n - k) for k in range(n + 1)])


def error_after(a: float, step: float, T: int) -> float:
    """Return the error after T steps, if each step multiplies it by a and adds step.

    The error begins at 0. T is a whole number, and a may be 1. error_after(1.1, 0.1,
    10) -> 1.593742; error_after(1, 0.1, 10) -> 1.0
    """
    # region 18.1
    if a == 1:
        return step * T  # the sum of T equal terms
    return step * (a**T - 1) / (a - 1)  # the sum of the geometric series
    # endregion 18.1


def aggregate(first: tuple, second: tuple) -> tuple[np.ndarray, ...]:
    """Return two data sets as one: (observation, action, episode).

    Each argument has observations (n, d), actions (n, m) and the episode number (n,) of
    each row; n differs. The rows of second follow the rows of first, and its episodes,
    which begin at 0, are numbered from the largest number in first plus 1.
    Episodes (0, 3) and (0, 1) become (0, 3, 4, 5).
    """
    # region 18.2
    seen = np.vstack([first[0], second[0]])  # observations of both data sets
    done = np.vstack([first[1], second[1]])  # actions of both data sets
    free = first[2].max() + 1  # the first number that no episode has
    return seen, done, np.append(first[2], free + second[2])  # rows of both data sets
    # endregion 18.2


def episode_weights(episode: np.ndarray) -> np.ndarray:
    """Return a weight for each row, (n,), so that each episode has the same influence.

    episode (n,) has the number of each row's episode. The weights of an episode are
    equal, their sum is the same for all episodes, and the mean of all weights is 1.
    episode_weights([0, 0, 0, 1]) -> [0.666667, 0.666667, 0.666667, 2]
    """
    # region 18.3
    _, of, length = np.unique(  # each row's episode and the length of each episode
        episode, return_inverse=True, return_counts=True
    )
    return len(episode) / (len(length) * length[of])  # weights; their mean is 1
    # endregion 18.3


def weighted_mse(
    pred: np.ndarray, target: np.ndarray, weight: np.ndarray
) -> tuple[float, np.ndarray]:
    """Return the weighted mean squared error and its gradient with respect to pred.

    pred and target are (n, m), and weight (n,) has one weight for each row, none of
    them negative. The loss is the weighted mean over the rows of each row's mean
    squared error. It does not change if all weights are multiplied by a constant.
    weighted_mse([[1], [2]], [[0], [0]], [1, 3]) -> (3.25, [[0.5], [3]])
    """
    # region 18.3
    error = pred - target  # error of each entry
    part = weight[:, None] / (weight.sum() * error.shape[1])  # normalised weights
    return np.sum(part * error**2), 2 * part * error  # the loss, and its gradient
    # endregion 18.3


def sign_test(first: np.ndarray, second: np.ndarray) -> float:
    """Return the p-value of the exact, two-sided sign test of two policies.

    first and second (n,) are True where the policy succeeds, on the same starts. Use
    the starts on which only one of them succeeds. The p-value is the probability of a
    split of these starts that is at least as uneven as the one observed, if each of
    them is decided by a fair coin. It is 1 if there is no such start. If only the first
    succeeds on 6 starts and only the second on 1, it is 0.125.
    """
    # region 18.4
    wins = int(np.sum(first & ~second))  # starts on which only the first succeeds
    losses = int(np.sum(second & ~first))  # starts on which only the second succeeds
    pmf = binomial_pmf(wins + losses, 0.5)  # probabilities of the wins of fair coins
    tail = np.sum(pmf[: min(wins, losses) + 1])  # probability of the smaller tail
    return min(1.0, 2 * tail)  # the p-value; both tails contain an even split
    # endregion 18.4


def gap_by_luck(p: float, n: int, gap: int) -> float:
    """Return the probability that two tests of one policy differ by at least a gap.

    Each test has n independent starts, and the policy succeeds on each with the
    probability p. gap is a whole number of successes, not a rate. The difference may
    have either sign. gap_by_luck(0.5, 2, 1) -> 0.625
    """
    # region 18.5
    pmf = binomial_pmf(n, p)  # probabilities of the successes of one test
    k = np.arange(n + 1)  # the possible numbers
    far = np.abs(k[:, None] - k) >= gap  # the pairs with a gap that is large enough
    return np.sum(np.outer(pmf, pmf)[far])  # sum of the probabilities of the pairs
    # endregion 18.5


def paired_power(win: float, lose: float, n: int, level: float) -> float:
    """Return the power: the probability that the sign test reports a difference.

    On each of n starts only the first policy succeeds with the probability win, and
    only the second with the probability lose. The test reports a difference if its
    p-value is at most level. If win and lose are 0, its p-value is always 1.
    paired_power(0.22, 0.06, 100, 0.05) -> 0.840455
    """
    # region 18.6
    differ = win + lose  # probability that exactly one policy succeeds
    first = win / differ if differ > 0 else 0.0  # win probability if policies differ
    power = 0.0  # the initial power
    for d, chance in enumerate(binomial_pmf(n, differ)):
        k = np.arange(d + 1)  # the possible numbers of wins
        few = np.cumsum(binomial_pmf(d, 0.5))  # probability of at most k wins
        p = np.minimum(1, 2 * few[np.minimum(k, d - k)])  # the p-values
        found = binomial_pmf(d, first)[p <= level]  # probabilities of reported wins
        power += chance * np.sum(found)  # power, with d starts that differ
    return power
    # endregion 18.6


def best_of(p: float, n: int, k: int) -> float:
    """Return the expected success rate of the best of k equally good policies.

    Each policy succeeds with the probability p, on each of n starts of its own. The
    best is the policy with the most successes. best_of(0.75, 20, 6) -> 0.866660
    """
    # region 18.7
    below = np.cumsum(binomial_pmf(n, p))[:n]  # probabilities of 0 to s successes
    return np.sum(1 - below**k) / n  # the expected largest number, as a rate
    # endregion 18.7


def holm(p: np.ndarray) -> np.ndarray:
    """Return which of m differences are significant by Holm's method, (m,) bool.

    p (m,) has the p-values. Compare them in ascending order: the smallest with 0.05 /
    m, the next with 0.05 / (m - 1), and so on. Stop at the first that is larger than
    its limit. holm([0.01, 0.04, 0.03]) -> [True, False, False]
    """
    # region 18.8
    order = np.argsort(p, kind="stable")  # indices in ascending order of p
    limits = 0.05 / np.arange(len(p), 0, -1)  # limits, from 0.05 / m to 0.05
    found = np.zeros(len(p), dtype=bool)  # mask of significant differences; none so far
    found[order] = np.logical_and.accumulate(
        p[order] <= limits
    )  # sorted mask; True before the first failure
    return found
    # endregion 18.8


class Policy:
    """A network with the scalers of its inputs and of its actions."""

    def __init__(self, net, inputs: np.ndarray, actions: np.ndarray) -> None:
        """Store the six arrays of a network and two scalers."""
        self.net = net
        self.inputs = inputs
        self.actions = actions

    def act(self, x: np.ndarray) -> np.ndarray:
        """Return the action for each row of inputs, m/s, (n, 2)."""
        z = cloning.mlp(cloning.normalise(x, self.inputs), *self.net)
        return cloning.denormalise(z, self.actions)

    def driver(self, n: int):
        """Return the policy of n runs, side by side, as `run` calls it."""
        last = np.zeros((n, 2))

        def act(seen: np.ndarray) -> np.ndarray:
            nonlocal last
            if len(self.inputs[0]) == 4:
                return self.act(seen)
            action = self.act(np.hstack([seen, last]))
            last = np.clip(action, -day15_mujoco.FASTEST, day15_mujoco.FASTEST)
            return action

        return act


def growth(K: float) -> tuple[float, float]:
    """Return the factor a and the added error, m, of one action with the gain K."""
    slip = day15_mujoco.PUSH / R  # 1/s, the growth without steering
    grown = np.exp(slip * day15_mujoco.TICK)
    moved = (grown - 1) / slip  # m per m/s of sideways velocity
    return grown - K * moved, moved * SIDEWAYS


def measured_error(K: float, steps: int = STEPS, mass: float = day15_mujoco.MASS):
    """Return how far the pusher is from the line after some actions, m."""
    start = np.array([[FAR + R + 5e-4, 0.0, FAR, 0.0]])  # behind the puck; left is -y
    error = np.array([0.0, -SIDEWAYS])
    # mujoco.mj_step runs the demonstrator with a constant sideways error
    run = day15_mujoco.run(
        *day15_mujoco.scene(mass=mass), start,
        lambda seen: day15_mujoco.demonstrator(seen, steer=K) + error, steps,
    )  # fmt: skip
    pusher, puck = np.split(run.observation[0, -1], 2)
    ahead = -puck / np.linalg.norm(puck)
    return ahead[0] * (pusher - puck)[1] - ahead[1] * (pusher - puck)[0]


def check_growth(lab: Lab) -> None:
    """Compare your error with a loop."""
    off = []
    for a in (0.5, 1.0, 1.2):
        e = 0.0
        for T in range(8):
            off.append(error_after(a, 0.1, T) - e)
            e = a * e + 0.1
    lab.check("error_after - by a loop", off)


def growths(lab: Lab) -> None:
    """Compare the lateral error with the prediction, for three gains."""
    print("  gain, 1/s      a   predicted   measured, mm")
    errors = {}
    for K in GAINS:
        a, step = growth(K)
        predicted = error_after(a, step, STEPS)
        measured = measured_error(K)
        print(f"  {K:9.0f} {a:6.3f} {1e3 * predicted:11.2f} {1e3 * measured:10.2f}")
        errors[K] = predicted, measured
    lab.measured("lateral error with the gain 1, mm", 1e3 * errors[1.0][1])
    off = errors[3.0][1] / errors[3.0][0] - 1
    lab.record("growth", off, label="|measured / predicted - 1| with the gain 3")


def check_data(lab: Lab, rng: np.random.Generator) -> None:
    """Check that no row and no episode is lost, and the weights of episodes."""
    of = np.array([5, 0, 5, 2, 2, 5, 2, 2])
    first = rng.normal(size=(8, 4)), rng.normal(size=(8, 2)), of
    second = rng.normal(size=(3, 4)), rng.normal(size=(3, 2)), np.array([7, 7, 9])
    seen, done, both = aggregate(first, second)
    lab.check("observations of both", seen - np.vstack([first[0], second[0]]))
    lab.check("actions of both", done - np.vstack([first[1], second[1]]))
    lab.check("episodes of both", both - np.append(of, [13, 13, 15]))
    weight = episode_weights(of)
    totals = np.bincount(of, weight)[[0, 2, 5]]
    off = [*(totals - 8 / 3), weight.mean() - 1]
    lab.check("total weight of each episode, and the mean", off)


def check_loss(lab: Lab, rng: np.random.Generator) -> None:
    """Compare your weighted loss with its definition, its gradient with differences."""
    pred, target = rng.normal(size=(2, 5, 3))
    weight = rng.uniform(0, 2, 5)
    loss, slope = weighted_mse(pred, target, weight)
    each = np.mean((pred - target) ** 2, axis=1)
    lab.check(
        "weighted_mse - by its definition", loss - np.average(each, weights=weight)
    )
    off = []
    for at in np.ndindex(pred.shape):
        moved = pred.astype(complex)
        moved[at] += 1e-20j
        change = np.average(np.mean((moved - target) ** 2, axis=1), weights=weight)
        off.append(slope[at] - change.imag / 1e-20)
    lab.check("its gradient - by the complex step", off)


def check_tests(lab: Lab) -> None:
    """Compare your tests with all outcomes of a few starts."""
    n = 12
    coins = (np.arange(2**n)[:, None] >> np.arange(n)) & 1  # all outcomes of n coins
    wins = coins.sum(axis=1)
    alike = [True, True, False]  # on three more starts both succeed, or both fail
    off = []
    for k in range(n + 1):
        first = np.arange(n) < k
        uneven = np.abs(wins - n / 2) >= abs(k - n / 2)
        p = sign_test(np.append(first, alike), np.append(~first, alike))
        off.append(p - np.mean(uneven))
    lab.record("sign_test", off, label="|sign_test - by all outcomes of 12 coins|")
    p = 0.3
    some = coins[: 2**10, :10]  # all outcomes of 2 tests with 5 starts
    chance = np.prod(np.where(some, p, 1 - p), axis=1)
    one, two = some[:, :5].sum(axis=1), some[:, 5:].sum(axis=1)
    far = np.sum(chance[np.abs(one - two) >= 2])
    lab.check("gap_by_luck - by all outcomes", gap_by_luck(p, 5, 2) - far)
    best = np.sum(chance * np.maximum(one, two)) / 5
    lab.check("best_of - by all outcomes", best_of(p, 5, 2) - best)
    lab.check("paired_power - by all outcomes", power_off(0.5, 0.2, 6))


def power_off(win: float, lose: float, n: int) -> float:
    """Return your power minus the sum over all 3^n outcomes of n starts."""
    each = np.array([win, lose, 1 - win - lose])
    found = 0.0
    for outcome in np.ndindex(*[3] * n):
        some = np.array(outcome)
        if sign_test(some == 0, some == 1) <= 0.0625:
            found += np.prod(each[some])
    return paired_power(win, lose, n, 0.0625) - found


def observed(run) -> np.ndarray:
    """Return the inputs of the network for each row of episodes, (n, 4) or (n, 6)."""
    seen, done, of = run.rows()
    last = np.vstack([np.zeros((1, 2)), done[:-1]])
    last[np.append(True, np.diff(of) != 0)] = 0  # a first row has no last action
    return np.hstack([seen, last]) if WITH_LAST else seen


def collect(start: np.ndarray, policy: Policy | None, actions: int):
    """Return rows of episodes in which the policy drives so many actions.

    After them the demonstrator drives. The action of each row is the demonstrator's.
    """
    drives = policy.driver(len(start)) if policy else day15_mujoco.demonstrator
    k = 0

    def act(seen: np.ndarray) -> np.ndarray:
        nonlocal k
        k += 1
        return drives(seen) if k <= actions else day15_mujoco.demonstrator(seen)

    # mujoco.mj_step runs the policy or the demonstrator
    run = day15_mujoco.run(*day15_mujoco.scene(), start, act)
    seen, _, of = run.rows()
    return observed(run), day15_mujoco.demonstrator(seen), of


def train(lab: Lab, title: str, rows, weight: np.ndarray | None = None) -> Policy:
    """Return a policy that is trained on rows, each with its weight."""
    x, action, _ = rows
    weight = np.ones(len(x)) if weight is None else weight
    inputs, actions = cloning.fit_scaler(x), cloning.fit_scaler(action)
    x, target = cloning.normalise(x, inputs), cloning.normalise(action, actions)
    rng = np.random.default_rng(SEED)
    net = cloning.random_net(rng, x.shape[1], UNITS, target.shape[1])

    def gradient(some, net):
        pred = cloning.mlp(x[some], *net)
        slope = weighted_mse(pred, target[some], weight[some])[1]
        return chunking.backprop(x[some], slope, *net)[:6]

    steps = cloning.batches(rng, len(x), BATCH, lab.training(title, UPDATES))
    net = cloning.fit(
        net, gradient, steps, lambda k: cloning.cosine_rate(k, UPDATES, RATE)
    )
    return Policy(net, inputs, actions)


def learned(lab: Lab, actions: int) -> Policy:
    """Return the policy after all rounds; in each the last policy drives some actions.

    With all actions this is DAgger. With none, each round has fresh demonstrations.
    """
    start = day15_mujoco.starts(EACH * ROUNDS, np.random.default_rng(SEED))
    policy, rows = None, None
    for k, some in enumerate(np.split(start, ROUNDS)):
        new = collect(some, policy, actions)
        rows = new if rows is None else aggregate(rows, new)
        if actions or k == ROUNDS - 1:  # demonstrations need no policy on the way
            policy = train(lab, f"round {k + 1}", rows)
    return policy


def outcomes(policy: Policy, n: int = TESTED) -> np.ndarray:
    """Return the success of a policy on the starts of the test, (n,)."""
    start = day15_mujoco.starts(n, np.random.default_rng(STARTS_SEED))
    # mujoco.mj_step runs the policy
    return day15_mujoco.run(*day15_mujoco.scene(), start, policy.driver(n)).home()


def told(name: str, home: np.ndarray) -> None:
    """Print the rounded number of pucks at home, and Wilson's interval."""
    n = 5 * round(np.sum(home) / 5)  # it may differ between machines
    _, low, high = success_rate(np.arange(len(home)) < n)
    print(f"  {name:25} about {n:3} of {len(home)}, 95 %: {low:.2f} to {high:.2f}")


def compare(lab: Lab) -> tuple[np.ndarray, np.ndarray]:
    """Train and test on fresh demonstrations and with DAgger; return both successes."""
    fresh = outcomes(learned(lab, 0))
    own = outcomes(learned(lab, DRIVES))
    told("fresh demonstrations", fresh)
    told("DAgger", own)
    print(f"  only one of them succeeds on about {5 * round(np.sum(fresh ^ own) / 5)}")
    p = sign_test(fresh, own)
    print(f"  sign test: p = {p:.0e}")
    return fresh, own


def dawdling() -> tuple:
    """Return rows of demonstrations, half of which stand still at first."""
    start = day15_mujoco.starts(DAWDLERS, np.random.default_rng(SEED))
    seen, action, episode = collect(start, None, 0)
    slow = start[: DAWDLERS // 2]
    still = np.repeat(slow, WAIT, axis=0)
    return (
        np.vstack([still, seen]),
        np.vstack([np.zeros((len(still), 2)), action]),
        np.append(np.repeat(np.arange(len(slow)), WAIT), episode),
    )


def hesitation(lab: Lab) -> list[np.ndarray]:
    """Compare equal rows, equal episodes, and no standing still; return successes."""
    rows = dawdling()
    n = WAIT * (DAWDLERS // 2)
    found = []
    for title, some, weight in (
        ("equal weights of rows", rows, None),
        ("equal weights of episodes", rows, episode_weights(rows[2])),
        ("without standing still", tuple(one[n:] for one in rows), None),
    ):
        found.append(outcomes(train(lab, title, some, weight), TESTED // 2))
        told(title, found[-1])
    return found


def luck(lab: Lab, fresh: np.ndarray, own: np.ndarray) -> None:
    """Compare your probabilities with draws from the starts that were run."""
    rng = np.random.default_rng(LUCK_SEED)
    rate = np.mean(own)
    print(f"  one policy ({rate:.2f}), tested twice on 50 starts: 5 or more apart")
    twice = own[rng.integers(0, TESTED, (DRAWS, 2, 50))].sum(axis=2)
    apart = np.mean(np.abs(twice[:, 0] - twice[:, 1]) >= 5)
    said(lab, "two tests that are 5 or more apart", gap_by_luck(rate, 50, 5), apart)
    lab.record("aa", apart - gap_by_luck(rate, 50, 5), label="|measured - predicted|")

    win, lose = np.mean(fresh & ~own), np.mean(own & ~fresh)
    print(f"  both policies on 50 starts ({win:.2f} and {lose:.2f}): p at most 0.05")
    power = paired_power(win, lose, 50, 0.05)
    found = []
    for some in rng.integers(0, TESTED, (DRAWS // 4, 50)):
        found.append(sign_test(fresh[some], own[some]) <= 0.05)
    print(f"    predicted {power:.2f}, measured {np.mean(found):.2f}")
    lab.record("power", np.mean(found) - power, label="|measured - predicted|")

    print("  six tests of one policy on 20 starts each: the best of them")
    best = own[rng.integers(0, TESTED, (DRAWS, 6, 20))].mean(axis=2).max(axis=1)
    said(lab, "the best of six tests", best_of(rate, 20, 6), np.mean(best))

    alarms = looks(rng, rate, DRAWS // 10)
    print("  two equal policies, compared after every 10 starts up to 200:")
    print(f"    p is at most 0.05 at least once in {100 * alarms:.0f} % of the trials")


def said(lab: Lab, name: str, predicted: float, measured: float) -> None:
    """Print a prediction of yours beside what was measured."""
    print(f"    predicted {predicted:.2f}, measured {measured:.2f}")
    lab.measured(name, measured)


def looks(rng: np.random.Generator, rate: float, trials: int) -> float:
    """Return how often one of 20 comparisons of two equal policies has p <= 0.05."""
    found = 0
    ends = range(10, TESTED + 1, 10)
    for _ in range(trials):
        first, second = rng.random((2, TESTED)) < rate
        found += any(sign_test(first[:n], second[:n]) <= 0.05 for n in ends)
    return found / trials


def all_pairs(lab: Lab, rng: np.random.Generator) -> None:
    """Compare each two of five equal policies, by p alone and by Holm's method."""
    pairs = [(i, j) for j in range(5) for i in range(j)]
    trials = DRAWS // 20
    low, kept, off = 0, 0, []
    for _ in range(trials):
        some = rng.random((5, 100)) < 0.7
        p = np.array([sign_test(some[i], some[j]) for i, j in pairs])
        found = holm(p)
        low += np.any(p <= 0.05)
        kept += np.any(found)
        order = np.argsort(p)
        adjusted = np.maximum.accumulate(p[order] * np.arange(len(p), 0, -1))
        off.append(found[order] ^ (adjusted <= 0.05))
    print(f"  five equal policies, {len(pairs)} pairs, 100 starts:")
    print(f"    a p-value of at most 0.05 in {100 * low / trials:.0f} % of the trials,")
    print(f"    a significant one by Holm's method in {100 * kept / trials:.0f} %")
    lab.check("holm - by adjusted p-values", off)
    stops = holm(np.array([0.03, 0.001, 0.02, 0.04])).astype(int)
    lab.check("a list that stops early", stops - [0, 1, 0, 0])
    every = holm(np.array([0.01, 0.04, 0.02])).astype(int)
    lab.check("a list that does not stop", every - [1, 1, 1])


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    print(f"MuJoCo {mujoco.mj_versionString()}: a pusher and a puck")

    lab.step("1. How an error grows")
    check_growth(lab)
    growths(lab)

    lab.step("2. Two data sets, and weights")
    check_data(lab, rng)
    check_loss(lab, rng)

    lab.step("3. Tests of success rates")
    check_tests(lab)
    if lab.failed:
        print("\nNot trained, because a check above failed. ARGS=--try trains anyway.")
        return lab.finish()

    lab.step(f"4. {EACH * ROUNDS} episodes: fresh demonstrations, and DAgger")
    fresh, own = compare(lab)

    lab.step(f"5. {DAWDLERS} demonstrations, and half of them stand still first")
    hesitation(lab)

    lab.step("6. Luck")
    luck(lab, fresh, own)

    lab.step("7. Side quest: many comparisons")
    with lab.side_quest():
        all_pairs(lab, rng)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
