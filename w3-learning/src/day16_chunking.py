"""Day 16: action chunks, a latent variable, and temporal ensembling.

    make day16                       in the clone: sets all up, then runs this
    python src/day16_chunking.py     in w3-learning/, once that is done

A network predicts an action chunk: the next K velocities of the pusher, m/s. Every
episode starts at the dock, where the pusher has to go around the puck. Losses are
computed on normalised actions. A network is six arrays, as on Day 15.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import chunking, cli, cloning
from robo47.lesson.lab import Lab
from robo47.policy import success_rate

import day15_mujoco

SEED = 1  # of the demonstrations, the initial weights and the batches
DEMOS = 100  # episodes of each training
WAIT = 8  # steps of the pause before the demonstrator moves
PAUSE_K = 12  # entries of a chunk of the policies that learn the pause
K = 8  # entries of a chunk of the policy with a latent variable
H = 4  # of these, executed before it plans again
STARTS_SEED = 1000  # of the starts that policies are tested on, and of their z
TESTED = 100  # starts
UNITS = 64  # of each hidden layer
UPDATES = 1000  # steps of Adam
BATCH = 256  # rows of a step
RATE = 0.003  # step size at the first update; it falls to 0 as a cosine
BETA = 0.1  # weight of the KL divergence
DECAY = 0.01  # of the weights of temporal ensembling, as in ACT
NOISE = 0.002  # m, standard deviation of each coordinate that is observed


def action_chunks(
    action: np.ndarray, episode: np.ndarray, K: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the action chunk of each row, (n, K, m), and a mask, (n, K).

    action (n, m) has the actions in the order of time, and episode (n,) the number of
    each row's episode. The rows of an episode are adjacent, and its number may occur
    again in a later episode. Entry j of chunk i is the action of row i + j, and its
    mask is 1. If the episode of row i ends before row i + j, both are 0.
    action_chunks([[1], [2], [3]], [0, 0, 0], 2) -> ([[[1], [2]], [[2], [3]], [[3],
    [0]]], [[1, 1], [1, 1], [1, 0]])
    """
    # region 16.1
    first = np.append(True, episode[1:] != episode[:-1])  # rows that begin an episode
    number = np.cumsum(first)  # the episodes, counted in the order of time
    row = np.arange(len(action))[:, None] + np.arange(K)  # the row of each entry
    known = np.minimum(row, len(action) - 1)  # the row of each entry within the data
    same = number[known] == number[:, None]  # entries of the same episode
    mask = 1.0 * (same & (row < len(action)))  # mask; 1 for the entries that exist
    return action[known] * mask[:, :, None], mask  # the chunks and the mask
    # endregion 16.1


def masked_l1(
    pred: np.ndarray, target: np.ndarray, mask: np.ndarray
) -> tuple[float, np.ndarray]:
    """Return the mean absolute error of the entries that exist, and its gradient.

    pred and target are chunks (n, K, m), and mask (n, K) is 1 for an entry that exists
    and 0 otherwise. The loss is the sum of the absolute errors of the existing
    entries, divided by m times the sum of the mask. The gradient (n, K, m) is with
    respect to pred; the derivative of |e| at 0 is 0.
    masked_l1([[[1], [9]], [[3], [0]]], [[[0], [0]], [[0], [0]]], [[1, 0], [1, 1]]) ->
    (1.333333, [[[0.333333], [0]], [[0.333333], [0]]])
    """
    # region 16.2
    entries = pred.shape[2] * mask.sum()  # number of existing errors
    weight = mask[:, :, None] / entries  # weight of each error
    error = pred - target  # error of each entry
    return np.sum(weight * np.abs(error)), weight * np.sign(error)  # loss and gradient
    # endregion 16.2


def backprop(
    x: np.ndarray,
    d: np.ndarray,
    W1: np.ndarray,
    b1: np.ndarray,
    W2: np.ndarray,
    b2: np.ndarray,
    W3: np.ndarray,
    b3: np.ndarray,
) -> tuple[np.ndarray, ...]:
    """Return the gradients of W1, b1, W2, b2, W3, b3 and of x, in their shapes.

    The network is `mlp` of Day 15: tanh, tanh, linear. x (n, a) has one sample per
    row, and d (n, m) is the gradient of any loss with respect to the outputs. For
    one unit per layer, weights 1, biases 0, x 0 and d 1, the gradients are 0, 1, 0, 1,
    0, 1 and 1. With the weights 2, 3 and 1 the gradient of x is 6.
    """
    # region 16.3
    first = np.tanh(x @ W1 + b1)  # outputs of the first layer
    second = np.tanh(first @ W2 + b2)  # outputs of the second layer
    d2 = (d @ W3.T) * (1 - second**2)  # the gradient before the second tanh
    d1 = (d2 @ W2.T) * (1 - first**2)  # the gradient before the first tanh
    return (
        x.T @ d1,  # the gradient of W1
        d1.sum(axis=0),  # the gradient of b1
        first.T @ d2,  # the gradient of W2
        d2.sum(axis=0),  # the gradient of b2
        second.T @ d,  # the gradient of W3
        d.sum(axis=0),  # the gradient of b3
        d1 @ W1.T,  # the gradient of x
    )
    # endregion 16.3


def started_share(wait: int, K: int) -> np.ndarray:
    """Return the fraction (K,) of the rows in which each entry is at full speed.

    During a pause of `wait` steps the observation does not change, so wait + 1 rows
    have the same input. In these rows 0, 1, ..., wait steps remain until the motion
    starts. Entry j, counted from 0, is at full speed if at most j steps remain.
    started_share(1, 3) -> [0.5, 1, 1]
    """
    # region 16.4
    rows = np.arange(1, K + 1)  # number of rows that have started by each entry
    return np.minimum(1, rows / (wait + 1))  # the fractions
    # endregion 16.4


def reparameterise(mu: np.ndarray, logvar: np.ndarray, noise: np.ndarray) -> np.ndarray:
    """Return samples (n, z) of Gaussians with the means mu (n, z).

    logvar (n, z) has the logarithms of the variances, and noise (n, z) samples of the
    standard normal distribution.
    reparameterise([[1]], [[log(4)]], [[0.5]]) -> [[2]]
    """
    # region 16.5
    std = np.exp(logvar / 2)  # the standard deviations
    return mu + std * noise  # the samples
    # endregion 16.5


def kl_to_prior(mu: np.ndarray, logvar: np.ndarray) -> np.ndarray:
    """Return the KL divergence (n, z) of each Gaussian from N(0, 1), in nats.

    mu (n, z) has the means and logvar (n, z) the logarithms of the variances.
    kl_to_prior([[1, 0]], [[0, log(4)]]) -> [[0.5, 0.806853]]
    """
    # region 16.6
    return (np.exp(logvar) + mu**2 - 1 - logvar) / 2  # the divergences
    # endregion 16.6


def encoder_gradient(
    dz: np.ndarray, mu: np.ndarray, logvar: np.ndarray, noise: np.ndarray, beta: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return the gradients with respect to mu and logvar, (n, z) each.

    dz (n, z) is the gradient of the decoder's loss with respect to the samples of
    `reparameterise`, whose arguments mu, logvar and noise are (n, z). The whole loss
    is the decoder's loss plus beta times the KL divergence of `kl_to_prior`, summed
    over the columns and averaged over the n rows.
    encoder_gradient([[2]], [[1]], [[0]], [[0.5]], 0.1) -> ([[2.1]], [[0.5]])
    """
    # region 16.7
    each = beta / len(mu)  # weight of the divergence of a row
    std = np.exp(logvar / 2)  # the standard deviations
    dmu = dz + each * mu  # the gradient of mu
    dlogvar = dz * noise * std / 2 + each * (std**2 - 1) / 2  # the gradient of logvar
    return dmu, dlogvar  # both gradients
    # endregion 16.7


def temporal_ensemble(plans: np.ndarray, decay: float) -> np.ndarray:
    """Return the weighted mean (m,) of several plans' actions for this step.

    plans (k, K, m) are the chunks of the last k steps, k <= K, the oldest first. Plan
    i was made k - 1 - i steps ago, and its first entry was for that step. The weight
    of plan i is proportional to exp(-decay i), and the weights add up to 1.
    temporal_ensemble([[[0], [1], [2]], [[3], [4], [5]]], log(2)) -> [1.666667]
    """
    # region 16.8
    k = len(plans)  # number of plans
    now = np.array([plans[i, k - 1 - i] for i in range(k)])  # the present entries
    weight = np.exp(-decay * np.arange(k))  # unnormalised weights
    return weight @ now / weight.sum()  # the weighted mean
    # endregion 16.8


def ensemble_noise(k: int, decay: float) -> float:
    """Return the standard deviation of the weighted mean of k independent errors.

    Each error has the standard deviation 1, and the weights are as in
    `temporal_ensemble`.
    ensemble_noise(2, log(2)) -> 0.745356
    """
    # region 16.8
    weight = np.exp(-decay * np.arange(k))  # unnormalised weights
    return np.sqrt(np.sum(weight**2)) / weight.sum()  # standard deviation of the mean
    # endregion 16.8


def attention(q: np.ndarray, k: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return scaled dot-product attention (n, e), softmax(q k^T / sqrt(d)) v.

    The queries are q (n, d), the keys k (m, d) and the values v (m, e). The softmax of
    a row is exp of its entries, divided by their sum. Subtract the largest entry of
    each row before exp, so that nothing overflows.
    attention([[1, 0]], [[1, 0], [0, 1]], [[1], [0]]) -> [[0.669762]]
    """
    # region 16.9
    logits = q @ k.T / np.sqrt(q.shape[1])  # the scaled products
    weight = np.exp(logits - logits.max(axis=1, keepdims=True))  # unnormalised weights
    return weight @ v / weight.sum(axis=1, keepdims=True)  # means of the values
    # endregion 16.9


class Data:
    """Demonstrations as normalised rows: observations, chunks, masks and scalers."""

    def __init__(self, episodes: day15_mujoco.Episodes, K: int) -> None:
        """Normalise the rows and cut their chunks of K actions."""
        x, action, episode = episodes.rows()
        self.first = np.diff(episode, prepend=-1) != 0  # rows at the dock
        self.inputs = cloning.fit_scaler(x)
        self.actions = cloning.fit_scaler(action)
        self.x = cloning.normalise(x, self.inputs)
        z = cloning.normalise(action, self.actions)
        self.targets, self.mask = action_chunks(z, episode, K)

    def plan(self, inputs: np.ndarray, net) -> np.ndarray:
        """Return a network's chunks in m/s, (n, K, 2)."""
        out = cloning.mlp(inputs, *net).reshape(len(inputs), -1, 2)
        return cloning.denormalise(out, self.actions)


def masked_l2(pred: np.ndarray, target: np.ndarray, mask: np.ndarray):
    """Return the mean squared error of the entries that exist, and its gradient."""
    error = (pred - target) * mask[:, :, None]
    entries = pred.shape[2] * mask.sum()
    return np.sum(error**2) / entries, 2 * error / entries


def fitted(lab: Lab, title: str, data: Data, net, gradient, rng):
    """Return a network after UPDATES steps of Adam."""
    steps = cloning.batches(rng, len(data.x), BATCH, lab.training(title, UPDATES))
    return cloning.fit(
        net, gradient, steps, lambda k: cloning.cosine_rate(k, UPDATES, RATE)
    )


def train_chunks(lab: Lab, title: str, data: Data, loss):
    """Return a network that predicts chunks from observations."""
    rng = np.random.default_rng(SEED)

    def gradient(rows, net):
        x, target = data.x[rows], data.targets[rows]
        pred = cloning.mlp(x, *net).reshape(target.shape)
        d = loss(pred, target, data.mask[rows])[1]
        return backprop(x, d.reshape(len(x), -1), *net)[:6]

    outputs = data.targets[0].size
    return fitted(
        lab, title, data, cloning.random_net(rng, 4, UNITS, outputs), gradient, rng
    )


class Latent:
    """An encoder and a decoder with one latent variable z (a CVAE)."""

    def __init__(self, lab: Lab, data: Data) -> None:
        """Train both networks together."""
        self.data = data
        rng = np.random.default_rng(SEED)
        outputs = data.targets[0].size
        encoder = cloning.random_net(rng, 4 + outputs, UNITS, 2)
        decoder = cloning.random_net(rng, 5, UNITS, outputs)

        def gradient(rows, both):
            return self.gradient(rows, both, rng.normal(size=(len(rows), 1)))

        title = "encoder and decoder"
        both = fitted(lab, title, data, [*encoder, *decoder], gradient, rng)
        self.encoder, self.decoder = both[:6], both[6:]

    def gradient(self, rows: np.ndarray, both, noise: np.ndarray):
        """Return the gradient of the loss with respect to the twelve arrays."""
        encoder, decoder = both[:6], both[6:]
        x, target = self.data.x[rows], self.data.targets[rows]
        seen = np.hstack([x, target.reshape(len(x), -1)])
        mu, logvar = np.hsplit(cloning.mlp(seen, *encoder), 2)
        inner = np.hstack([x, reparameterise(mu, logvar, noise)])
        pred = cloning.mlp(inner, *decoder).reshape(target.shape)
        d = masked_l1(pred, target, self.data.mask[rows])[1]
        *of_decoder, dx = backprop(inner, d.reshape(len(x), -1), *decoder)
        both = encoder_gradient(dx[:, 4:], mu, logvar, noise, BETA)
        *of_encoder, _ = backprop(seen, np.hstack(both), *encoder)
        return [*of_encoder, *of_decoder]

    def encode(self) -> tuple[np.ndarray, np.ndarray]:
        """Return mean and logarithm of the variance of z for each row, (n, 1) each."""
        chunks = self.data.targets.reshape(len(self.data.x), -1)
        seen = np.hstack([self.data.x, chunks])
        return tuple(np.hsplit(cloning.mlp(seen, *self.encoder), 2))

    def plan(self, seen: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return chunks for observations and values of z (n, 1), m/s, (n, K, 2)."""
        x = cloning.normalise(seen, self.data.inputs)
        return self.data.plan(np.hstack([x, z]), self.decoder)

    def with_z(self):
        """Return the plan of the test: each run draws its z once and keeps it."""
        z = np.random.default_rng(STARTS_SEED).normal(size=(TESTED, 1))
        return lambda seen: self.plan(seen, z)


def starts_of_test() -> np.ndarray:
    """Return the starts of the test, (n, 4)."""
    return day15_mujoco.dock(TESTED, np.random.default_rng(STARTS_SEED))


def episodes_of(policy, wait: int = 0) -> day15_mujoco.Episodes:
    """Return the episodes of a policy from the starts of the test."""
    # mujoco.mj_step runs the policy
    return day15_mujoco.run(
        *day15_mujoco.scene(), starts_of_test(), policy, day15_mujoco.STEPS + wait
    )


def report(name: str, home: np.ndarray) -> None:
    """Print the rounded number of pucks at home, and Wilson's interval."""
    n = 5 * round(np.sum(home) / 5)  # it may differ between machines
    _, low, high = success_rate(np.arange(len(home)) < n)
    print(f"  {name:33} about {n:3} of {len(home)}, 95 %: {low:.2f} to {high:.2f}")


def check_chunks(lab: Lab, rng: np.random.Generator) -> None:
    """Compare chunks with the definition, and the loss with its own."""
    episode = np.array([3, 3, 3, 3, 3, 7, 3, 3])  # a number that comes again
    action = rng.normal(size=(8, 2))
    targets, mask = action_chunks(action, episode, 3)
    last = np.array([4, 4, 4, 4, 4, 5, 7, 7])  # the last row of each row's episode
    off = [targets[0] - action[:3], targets[3] - [action[3], action[4], [0, 0]],
           targets[5] - [action[5], [0, 0], [0, 0]]]  # fmt: skip
    lab.check("three chunks - by hand", off)
    counted = mask.sum(axis=1) - np.minimum(3, last - np.arange(8) + 1)
    lab.check("entries that exist - by counting", counted)
    pred = targets + rng.choice([-1, 1], targets.shape) * rng.uniform(1, 2, (8, 3, 2))
    loss, slope = masked_l1(pred, targets, mask)
    there = np.abs(pred - targets)[mask == 1]
    lab.check("masked_l1 - by its definition", loss - there.mean())
    off = []
    for at in np.ndindex(pred.shape):
        near = [masked_l1(pred + e * unit(at, pred.shape), targets, mask)[0]
                for e in (0.5, -0.5)]  # fmt: skip
        off.append(slope[at] - (near[0] - near[1]))
    lab.check("its gradient - by central differences", off)
    lab.check("and at an error of 0", masked_l1(targets, targets, mask)[1])
    moves = np.repeat([0.0, 1.0], [3, 5])[:, None]  # after a pause of 3 steps
    chunks, _ = action_chunks(moves, np.zeros(8), 5)
    off = started_share(3, 5) - chunks[:4, :, 0].mean(axis=0)
    lab.check("started_share - by counting", off)


def unit(at: tuple[int, ...], shape: tuple[int, ...]) -> np.ndarray:
    """Return zeros with a 1 at one index."""
    one = np.zeros(shape)
    one[at] = 1
    return one


def check_backprop(lab: Lab, rng: np.random.Generator) -> None:
    """Compare your gradients with the complex step."""
    sizes = ((4, 5), (5,), (5, 3), (3,), (3, 2), (2,), (6, 4))
    *net, x = (rng.normal(size=size) for size in sizes)
    weight = rng.normal(size=(6, 2))

    def loss(*arrays):
        *net, x = arrays
        return np.sum(weight * cloning.mlp(x, *net) ** 3)

    d = 3 * weight * cloning.mlp(x, *net) ** 2
    by_step = cloning.complex_step(loss, [*net, x])
    off = [a - b for a, b in zip(backprop(x, d, *net), by_step, strict=True)]
    lab.record("backprop", cloning.flat(off), label="|backprop - by the complex step|")


def speeds(data: Data, net, episodes: day15_mujoco.Episodes) -> np.ndarray:
    """Return the speed of each entry at the dock, as a fraction of full speed, (K,)."""
    full = episodes.action[:, WAIT, None]  # the demonstrators' first motion
    plans = data.plan(data.x[data.first], net)
    along = np.sum(plans * full, axis=2) / np.sum(full**2, axis=2)
    return along.mean(axis=0)


def pause(lab: Lab) -> None:
    """Clone demonstrations with a pause, with the squared and the absolute error."""
    # mujoco.mj_step runs the demonstrator
    episodes = day15_mujoco.dock_demonstrations(DEMOS, SEED, coin=False, wait=WAIT)
    data = Data(episodes, PAUSE_K)
    print(f"  {100 * (1 - data.mask.mean()):.0f} % of the entries are padding")
    share = started_share(WAIT, PAUSE_K)
    nets = {
        "squared": train_chunks(lab, "with the squared error", data, masked_l2),
        "absolute": train_chunks(lab, "with the absolute error", data, masked_l1),
    }
    paper = {"squared": share, "absolute": 1.0 * (share > 0.5)}
    print("  speed of each entry, as a fraction of full speed:")
    for name, net in nets.items():
        found = speeds(data, net, episodes)
        for kind, row in (("predicted", paper[name]), ("measured", found)):
            print(
                f"    {name:9}{kind:10}" + "".join(f"{s:6.2f}" for s in row[: WAIT + 1])
            )
        if name == "squared":
            off = np.round(found - share, 2)
            lab.measured("squared error: speed of the third entry", found[2])
            lab.record("started", off, label="squared error: largest difference")
    for name, net in nets.items():

        def plan(seen, net=net):
            return data.plan(cloning.normalise(seen, data.inputs), net)

        for h in (1, 2, 4):
            run = episodes_of(chunking.chunked_policy(plan, h), WAIT)
            report(f"{name} error, {h} executed", run.home())


def check_latent(lab: Lab, rng: np.random.Generator) -> None:
    """Compare the divergence with its integral, the gradient with the complex step."""
    mu, logvar, noise, weight = rng.normal(size=(4, 5, 2))
    z = reparameterise(mu, logvar, noise)
    lab.check("log((z - mu) / noise) - logvar / 2",
              np.log((z - mu) / noise) - logvar / 2)  # fmt: skip
    std = np.exp(0.5 * logvar[..., None])
    x = mu[..., None] + std * np.linspace(-12, 12, 4001)
    log_q = -0.5 * ((x - mu[..., None]) / std) ** 2 - np.log(std)
    density = np.exp(log_q) / np.sqrt(2 * np.pi)
    integral = np.trapezoid(density * (log_q + x**2 / 2), x)
    lab.check("kl_to_prior - by its integral", kl_to_prior(mu, logvar) - integral)

    def loss(mu, logvar):
        z = chunking.reparameterise(mu, logvar, noise)
        divergence = chunking.kl_to_prior(mu, logvar).sum(axis=1)
        return np.sum(weight * z**2) + BETA * np.mean(divergence)

    dz = 2 * weight * chunking.reparameterise(mu, logvar, noise)
    mine = encoder_gradient(dz, mu, logvar, noise, BETA)
    by_step = cloning.complex_step(loss, [mu, logvar])
    off = [a - b for a, b in zip(mine, by_step, strict=True)]
    lab.record("encoder", off, label="|encoder_gradient - by the complex step|")


def sides(latent: Latent, z: float) -> np.ndarray:
    """Return whether the first action is to the left, for the starts of the test."""
    seen = starts_of_test()
    first = latent.plan(seen, np.full((TESTED, 1), z))[:, 0]
    puck = seen[:, 2:]
    return puck[:, 1] * first[:, 0] > puck[:, 0] * first[:, 1]


def coin(lab: Lab) -> Latent:
    """Train encoder and decoder, and compare the divergence with ln 2."""
    # mujoco.mj_step runs the demonstrator
    episodes = day15_mujoco.dock_demonstrations(DEMOS, SEED)
    left = np.sum(day15_mujoco.on_the_left(episodes))
    print(f"  {np.sum(episodes.home())} of {DEMOS} demonstrations end at home, "
          f"{left} go around on the left")  # fmt: skip
    latent = Latent(lab, Data(episodes, K))
    mu, logvar = latent.encode()
    kl = kl_to_prior(mu, logvar)[:, 0]
    first = latent.data.first
    print(f"  KL divergence: {kl[first].mean():.2f} nats at the dock, "
          f"{kl[~first].mean():.2f} elsewhere; ln 2 is {np.log(2):.3f}")  # fmt: skip
    lab.measured("KL divergence at the dock, nats", kl[first].mean())
    lab.record("dock_kl", np.round(kl[first].mean(), 1), seed=SEED,
               label="KL divergence at the dock, nats")  # fmt: skip
    lab.record("else_kl", np.round(kl[~first].mean(), 1), seed=SEED,
               label="KL divergence elsewhere, nats")  # fmt: skip
    second = np.mean(mu[first] ** 2 + np.exp(logvar[first]))
    print(f"  mean of mu^2 + variance at the dock: {second:.1f}")
    differ = np.mean(sides(latent, -1.5) != sides(latent, 1.5))
    print(f"  z = -1.5 and 1.5 start on different sides: {100 * differ:.0f} %")
    run = episodes_of(chunking.chunked_policy(latent.with_z(), H))
    report(f"z drawn once per run, {H} executed", run.home())
    print(f"  about {5 * round(day15_mujoco.on_the_left(run).sum() / 5)} "
          "of them go around on the left")  # fmt: skip
    return latent


def check_ensemble(lab: Lab, rng: np.random.Generator) -> None:
    """Compare the weighted mean and its noise with what they must be."""
    path = rng.normal(size=(9, 2))
    plans = np.stack([path[i : i + 5] for i in range(4)])  # all plan the same path
    off = temporal_ensemble(plans, 0.3) - path[3]
    lab.check("plans that agree: their action", off)
    plans[0] += 1
    moved = temporal_ensemble(plans, np.log(2)) - path[3]
    lab.check("the oldest has 8/15 of the weight", moved - 8 / 15)
    lab.check("ensemble_noise of equal weights", ensemble_noise(9, 0.0) - 1 / 3)
    ones = np.eye(5)[:, :, None, None] * np.ones((5, 1))  # one plan is 1, the others 0
    weights = [temporal_ensemble(plans, 0.2) for plans in ones]
    off = ensemble_noise(5, 0.2) - np.linalg.norm(weights)
    lab.check("ensemble_noise - by the weights", off)


def noise_left(latent: Latent, rng: np.random.Generator) -> float:
    """Return what the mean of K plans leaves of the noise of a single plan.

    A new noise is added to each observation of runs without noise.
    """
    plan = latent.with_z()
    seen = episodes_of(chunking.chunked_policy(plan, H)).observation
    errors = []
    for k in range(day15_mujoco.STEPS):
        noisy = seen[:, k] + NOISE * rng.normal(size=(TESTED, 4))
        errors.append((plan(noisy) - plan(seen[:, k])).transpose(1, 0, 2))
    flat = np.array(errors).reshape(len(errors), K, -1)
    mean = [temporal_ensemble(flat[k - K : k], DECAY) for k in range(K, len(flat))]
    return np.std(mean) / np.std(flat[:, 0])


def ensembles(lab: Lab, latent: Latent, rng: np.random.Generator) -> None:
    """Measure the noise that is left, and the runs of two decays."""
    left = noise_left(latent, rng)
    print(f"  noise left by the mean of {K} plans: "
          f"{ensemble_noise(K, DECAY):.3f} if all errors are alike")  # fmt: skip
    lab.measured("noise left by the mean of 8 plans", left)
    lab.record("calm", np.round(left, 2), label="measured with a noise of 2 mm")
    policy = chunking.chunked_policy(latent.with_z(), 1)
    report("no ensembling, 1 executed", episodes_of(policy).home())
    for decay in (DECAY, -1.0):
        policy = chunking.ensembled_policy(latent.with_z(), K, decay, temporal_ensemble)
        report(f"ensembling, decay {decay:g}", episodes_of(policy).home())


def untrained(lab: Lab) -> bool:
    """Return whether a check has failed, so that nothing more is trained."""
    if lab.failed:
        print("\nNot trained, because a check above failed. ARGS=--try trains anyway.")
    return bool(lab.failed)


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    print(f"MuJoCo {mujoco.mj_versionString()}: a pusher that starts at the dock")

    lab.step("1. Chunks of actions, and their loss")
    check_chunks(lab, rng)

    lab.step("2. Backpropagation to the input")
    check_backprop(lab, rng)

    if untrained(lab):
        return lab.finish()

    lab.step(f"3. A pause of {WAIT} steps")
    pause(lab)

    lab.step("4. A latent variable, before the training")
    check_latent(lab, rng)
    check_ensemble(lab, rng)
    if untrained(lab):
        return lab.finish()

    lab.step("5. A coin, and the latent variable")
    latent = coin(lab)

    lab.step("6. Temporal ensembling")
    ensembles(lab, latent, rng)

    lab.step("7. Side quest: attention")
    with lab.side_quest():
        q, k, v = (rng.normal(size=size) for size in ((4, 3), (5, 3), (5, 2)))
        off = attention(q, k, v) - chunking.attention(q, k, v)
        lab.check("|attention - the library's|", off)
        far = attention(1e4 * q, k, v) - v[np.argmax(q @ k.T, axis=1)]
        lab.check("of long queries: the value of the best key", far)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
