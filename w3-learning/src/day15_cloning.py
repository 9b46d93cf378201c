"""Day 15: behaviour cloning, from demonstrations to a policy.

    make day15                       in the clone: sets all up, then runs this
    python src/day15_cloning.py      in w3-learning/, once that is done

Rows of data are pairs of an observation (pusher x, y, puck x, y), m, and an action, the
velocity of the pusher, m/s. A network is six arrays: W1, b1, W2, b2, W3, b3. Losses are
computed on normalised actions, so the mean action has the loss 1.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import cli, cloning
from robo47.lesson.lab import Lab
from robo47.policy import success_rate

import day15_mujoco

SEED = 1  # of the demonstrations, the initial weights and the batches
DEMOS = 40  # episodes of the training
HELD_OUT = 20  # further episodes that have no part in it
STARTS_SEED = 1000  # of the starts that policies are tested on
TESTED = 200  # starts
UNITS = 48  # of each hidden layer
UPDATES = 1000  # steps of Adam
BATCH = 256  # rows of a step
RATE = 0.003  # step size at the first update; it falls to 0 as a cosine
BESIDE = (0.001, 0.005, 0.01, 0.02)  # m from the centre line, of a blind push
SIDEWAYS = 0.002  # m/s, the constant error of a policy
FAR = 2.4  # m from home, where this error is measured
R = day15_mujoco.R  # m, sum of both radii


def contact_angle(phi: float, distance: float, R: float) -> float:
    """Return the contact angle, rad, after a straight push of a disc without friction.

    phi is the angle between the push and the contact normal at the start, rad, between
    -pi and pi; distance is the path length of the pusher, m, and R the sum of both
    radii, m. The pusher slides around the puck: R d(phi)/ds = sin(phi).
    contact_angle(0.1, 0.065, 0.065) -> 0.270395
    """
    # region 15.1
    half = np.tan(phi / 2)  # the tangent of half the angle at the start
    grown = half * np.exp(distance / R)  # the tangent of half the angle at the end
    return 2 * np.arctan(grown)  # the contact angle
    # endregion 15.1


def split_by_episode(episode: np.ndarray, held_out: np.ndarray) -> np.ndarray:
    """Return a mask, (n,): True for each row of the episodes that are held out.

    episode (n,) has the number of each row's episode, and held_out (k,) the numbers
    of the episodes that are held out. Episodes (4, 4, 0, 0, 2) and held_out (2, 4):
    (True, True, False, False, True).
    """
    # region 15.2
    return np.isin(episode, held_out)  # the mask of the held-out rows
    # endregion 15.2


def fit_scaler(x: np.ndarray) -> np.ndarray:
    """Return the means of the columns and their standard deviations, (2, d).

    x (n, d) are rows of data. Divide by n, not by n - 1. A column whose entries are all
    equal gets the standard deviation 1 instead of 0.
    fit_scaler([[1, 4], [3, 4]]) -> [[2, 4], [1, 1]]
    """
    # region 15.3
    constant = (x == x[0]).all(axis=0)  # columns whose entries are all equal
    spread = np.where(constant, 1, x.std(axis=0))  # standard deviations
    return np.array([x.mean(axis=0), spread])  # means and standard deviations
    # endregion 15.3


def normalise(x: np.ndarray, scaler: np.ndarray) -> np.ndarray:
    """Return x (n, d) with the mean subtracted, divided by the standard deviation.

    scaler (2, d) is from `fit_scaler`, usually for other rows. normalise([[5, 4]], [[2,
    4], [1, 1]]) -> [[3, 0]]
    """
    # region 15.3
    return (x - scaler[0]) / scaler[1]  # the normalised rows
    # endregion 15.3


def denormalise(z: np.ndarray, scaler: np.ndarray) -> np.ndarray:
    """Return the rows x (n, d) whose normalised form is z (n, d): undo `normalise`.

    scaler (2, d) is from `fit_scaler`. denormalise([[3, 0]], [[2, 4], [1, 1]]) -> [[5,
    4]]
    """
    # region 15.3
    return z * scaler[1] + scaler[0]  # the rows in their units
    # endregion 15.3


def mlp(
    x: np.ndarray,
    W1: np.ndarray,
    b1: np.ndarray,
    W2: np.ndarray,
    b2: np.ndarray,
    W3: np.ndarray,
    b3: np.ndarray,
) -> np.ndarray:
    """Return the outputs of a network with two hidden layers of tanh units, (n, m).

    x (n, a) has one sample per row, so a layer computes x W + b. The weights are W1 (a,
    h), W2 (h, g), W3 (g, m), the biases b1 (h,), b2 (g,), b3 (m,). Complex arrays are
    accepted. For the row (1, 2), identity matrices W1 and W2, b1 = b2 = 0, ones in W3
    and b3 = 0.5, the output is 1.888083.
    """
    # region 15.4
    first = np.tanh(x @ W1 + b1)  # outputs of the first layer
    second = np.tanh(first @ W2 + b2)  # outputs of the second layer
    return second @ W3 + b3  # outputs of the linear layer
    # endregion 15.4


def mse(pred: np.ndarray, target: np.ndarray) -> tuple[float, np.ndarray]:
    """Return the mean squared error and its gradient with respect to pred, (n, m).

    pred and target are (n, m); the mean is over all n m entries.
    mse([[1, 2]], [[0, 0]]) -> (2.5, [[1, 2]])
    """
    # region 15.5
    error = pred - target  # error of each entry
    return np.mean(error**2), 2 * error / error.size  # the loss and its gradient
    # endregion 15.5


def mlp_gradient(
    x: np.ndarray,
    target: np.ndarray,
    W1: np.ndarray,
    b1: np.ndarray,
    W2: np.ndarray,
    b2: np.ndarray,
    W3: np.ndarray,
    b3: np.ndarray,
) -> tuple[np.ndarray, ...]:
    """Return the six arrays of the gradient of the loss, by backpropagation.

    The loss is the mean squared error of mlp(x, ...) for the target. x (n, a) and
    target (n, m) are rows; the weights are as in `mlp`. The result has the derivatives
    with respect to W1, b1, W2, b2, W3, b3, in the shapes of these arrays. All weights
    1, biases 0, x 1 and target 0 give 0.316986, 0.316986, 0.574832, 0.754774, 0.824366
    and 1.284030.
    """
    # region 15.6
    first = np.tanh(x @ W1 + b1)  # outputs of the first layer
    second = np.tanh(first @ W2 + b2)  # outputs of the second layer
    d3 = mse(second @ W3 + b3, target)[1]  # the gradient with respect to the output
    d2 = (d3 @ W3.T) * (1 - second**2)  # the gradient at the input of the second tanh
    d1 = (d2 @ W2.T) * (1 - first**2)  # the gradient at the input of the first tanh
    return (
        x.T @ d1,  # the gradient with respect to W1
        d1.sum(axis=0),  # the gradient with respect to b1
        first.T @ d2,  # the gradient with respect to W2
        d2.sum(axis=0),  # the gradient with respect to b2
        second.T @ d3,  # the gradient with respect to W3
        d3.sum(axis=0),  # the gradient with respect to b3
    )
    # endregion 15.6


def adam_step(
    theta: np.ndarray,
    grad: np.ndarray,
    m: np.ndarray,
    v: np.ndarray,
    k: int,
    rate: float,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return theta, m and v, (n,) each, after one step of Adam (Kingma and Ba, 2015).

    theta (n,) are the parameters and grad (n,) the gradient of the loss. m and v (n,)
    are the running averages of the gradient and of its square, with the decay rates 0.9
    and 0.999. k = 1, 2, ... is the number of this step. For the update only, each
    average is divided by the factor that corrects for its start at 0: the returned m
    and v are not divided. Add 1e-8 to the root.
    adam_step([1], [3], [0], [0], 1, 0.01) -> ([0.99], [0.3], [0.009])
    """
    # region 15.7
    m = 0.9 * m + 0.1 * grad  # average of the gradient
    v = 0.999 * v + 0.001 * grad**2  # average of the squared gradient
    mean = m / (1 - 0.9**k)  # corrected average of the gradient
    square = v / (1 - 0.999**k)  # corrected average of the squared gradient
    return theta - rate * mean / (np.sqrt(square) + 1e-8), m, v  # new parameters
    # endregion 15.7


def persistence_loss(action: np.ndarray, episode: np.ndarray) -> float:
    """Return the loss of the policy that repeats the last action.

    action (n, m) has the actions in the order of time, and episode (n,) the number of
    each row's episode. The loss is the mean squared difference between an action and
    the last action, over all columns and over all rows that have a last action.
    persistence_loss([[0], [1], [5], [5.5]], [0, 0, 1, 1]) -> 0.625
    """
    # region 15.8
    change = action[1:] - action[:-1]  # the change from each row to the next
    same = episode[1:] == episode[:-1]  # the pairs within an episode
    return np.mean(change[same] ** 2)  # the mean squared change
    # endregion 15.8


def nearest_distance(known: np.ndarray, asked: np.ndarray) -> np.ndarray:
    """Return the distance (m,) from each row of asked to the nearest row of known.

    known is (n, d) and asked (m, d); the distances are Euclidean.
    nearest_distance([[0, 0], [3, 4]], [[0, 1]]) -> [1]
    """
    # region 15.9
    squares = [  # the squared distance to the nearest known row
        ((known - one) ** 2).sum(axis=1).min() for one in asked
    ]
    return np.sqrt(np.array(squares))  # the distances
    # endregion 15.9


class Clone:
    """A network with the scalers of its inputs and of its actions."""

    def __init__(self, net, inputs: np.ndarray, actions: np.ndarray) -> None:
        """Store the six arrays of a network and two scalers."""
        self.net = net
        self.inputs = inputs
        self.actions = actions

    def act(self, x: np.ndarray) -> np.ndarray:
        """Return the action for each row of inputs, m/s, (n, 2)."""
        return denormalise(mlp(normalise(x, self.inputs), *self.net), self.actions)

    def loss(self, x: np.ndarray, action: np.ndarray) -> float:
        """Return the mean squared error of the normalised actions."""
        pred = mlp(normalise(x, self.inputs), *self.net)
        return mse(pred, normalise(action, self.actions))[0]


def blind_distance(beside: float, angle: float = np.pi / 3) -> float:
    """Return the path length, m, after which your contact_angle reaches an angle."""
    low, high = 0.0, 1.0
    for _ in range(50):  # bisection
        middle = (low + high) / 2
        reached = contact_angle(np.arcsin(beside / R), middle, R) > angle
        low, high = (low, middle) if reached else (middle, high)
    return high


def blind_pushes(lab: Lab, model, data) -> None:
    """Compare your distances with those in MuJoCo."""
    print("  beside the line   predicted    measured, mm")
    off = []
    for beside in BESIDE:
        predicted = blind_distance(beside)
        # mujoco.mj_step pushes until the angle is 60 degrees
        measured = day15_mujoco.blind_push(model, data, beside)
        print(f"{1e3 * beside:14.0f} mm{1e3 * predicted:12.1f}{1e3 * measured:12.1f}")
        off.append(measured / predicted - 1)
        if beside == 0.01:
            lab.measured("path of a blind push, 10 mm off the centre, mm",
                         1e3 * measured)  # fmt: skip
    lab.record("slip", off, label="|measured / predicted - 1|")


def beside_the_line(seen: np.ndarray) -> float:
    """Return how far the pusher is to the left of the line from the puck to home, m."""
    puck = seen[2:]
    r = seen[:2] - puck
    ahead = -puck / np.linalg.norm(puck)
    return ahead[0] * r[1] - ahead[1] * r[0]


def drift(lab: Lab, model, data) -> None:
    """Compare the lateral distance that a sideways error causes with the prediction."""
    slip = np.log(contact_angle(1e-4, R, R) / 1e-4) / R  # 1/m
    gain = day15_mujoco.STEER - day15_mujoco.PUSH * (slip + 1 / FAR)
    start = np.array([[FAR + R, 0.0, FAR, 0.0]])  # behind the puck; left is -y
    error = np.array([0.0, -SIDEWAYS])
    run = day15_mujoco.run(
        model, data, start, lambda seen: day15_mujoco.demonstrator(seen) + error, 30
    )
    measured = beside_the_line(run.observation[0, -1])
    predicted = SIDEWAYS / gain
    print(f"  2 mm/s sideways: predicted {1e3 * predicted:.3f} mm, "
          f"measured {1e3 * measured:.3f} mm")  # fmt: skip
    lab.measured("2 mm/s sideways, beside the line, mm", 1e3 * measured)
    lab.record("drift", measured / predicted - 1, label="|measured / predicted - 1|")


def data_of(lab: Lab):
    """Return the demonstrations for the training, and the held-out demonstrations.

    Each is (observation (n, 4), action (n, 2), episode (n,)).
    """
    # mujoco.mj_step runs the demonstrator
    episodes = day15_mujoco.demonstrations(DEMOS + HELD_OUT, SEED)
    rows = episodes.rows()
    held = split_by_episode(rows[2], np.arange(DEMOS, DEMOS + HELD_OUT))
    train, other = [[one[some] for one in rows] for some in (~held, held)]
    shared = np.intersect1d(train[2], other[2])
    print(
        f"  {np.sum(episodes.home())} of {DEMOS + HELD_OUT} demonstrations end at home"
    )
    print(f"  {len(train[2])} rows for training, {len(other[2])} held out")
    sizes = np.array([len(train[2]) / DEMOS, len(other[2]) / HELD_OUT])
    lab.check("episodes in both, and rows of each", [len(shared), *sizes - 60])
    return train, other


def check_scaler(lab: Lab, rows: np.ndarray) -> None:
    """Check the mean and std of normalised columns, and that denormalise inverts."""
    scaler = fit_scaler(rows)
    z = normalise(rows, scaler)
    lab.check("mean and std - 1 of each column", [z.mean(axis=0), z.std(axis=0) - 1])
    lab.check("|denormalise(normalise(x)) - x|", denormalise(z, scaler) - rows)
    lone = fit_scaler(np.full((3, 1), 4.0))
    lab.check("a constant column: 4 and 1", lone[:, 0] - [4, 1])


def check_gradient(lab: Lab, rng: np.random.Generator) -> None:
    """Compare your gradients with the complex step."""
    sizes = ((4, 5), (5,), (5, 3), (3,), (3, 2), (2,))
    net = [rng.normal(size=size) for size in sizes]
    x = rng.normal(size=(6, 4))
    target = rng.normal(size=(6, 2))
    off = []
    grads = mlp_gradient(x, target, *net)
    for i, (array, grad) in enumerate(zip(net, grads, strict=True)):
        for at in np.ndindex(array.shape):
            moved = list(net)
            moved[i] = array.astype(complex)
            moved[i][at] += 1e-20j
            loss = np.mean((mlp(x, *moved) - target) ** 2)
            off.append(grad[at] - loss.imag / 1e-20)
    lab.record("gradient", off, label="|mlp_gradient - by the complex step|")
    pred = mlp(x, *net)
    loss, slope = mse(pred, target)
    lab.check("mse - by its definition", loss - np.sum((pred - target) ** 2) / 12)
    lab.check("its gradient - by its definition", slope - (pred - target) / 6)


def check_adam(lab: Lab, rng: np.random.Generator) -> None:
    """Compare ten steps of yours with weighted means of all gradients so far."""
    theta = m = v = np.zeros(3)
    sizes = np.array([1.0, 1e-4, 1e3])
    grads = rng.normal(size=(10, 3)) * sizes
    off = []
    for k, grad in enumerate(grads, 1):
        before = theta
        theta, m, v = adam_step(theta, grad, m, v, k, 0.01)
        mean, square = (
            np.average(grads[:k] ** power, axis=0, weights=decay ** np.arange(k)[::-1])
            for power, decay in ((1, 0.9), (2, 0.999))
        )
        off.append(theta - before + 0.01 * mean / (np.sqrt(square) + 1e-8))
    lab.check("adam_step - by weighted means of all gradients", off)


def train(lab: Lab, title: str, x: np.ndarray, action: np.ndarray) -> Clone:
    """Return a clone that was trained on rows of inputs and actions."""
    inputs = fit_scaler(x)
    actions = fit_scaler(action)
    x = normalise(x, inputs)
    target = normalise(action, actions)
    rng = np.random.default_rng(SEED)
    net = cloning.random_net(rng, x.shape[1], UNITS, target.shape[1])
    theta = cloning.flat(net)
    m = v = np.zeros_like(theta)
    for k in lab.training(title, UPDATES):
        rows = rng.integers(0, len(x), BATCH)
        grad = mlp_gradient(x[rows], target[rows], *cloning.shaped(theta, net))
        rate = cloning.cosine_rate(k, UPDATES, RATE)
        theta, m, v = adam_step(theta, cloning.flat(grad), m, v, k, rate)
    return Clone(cloning.shaped(theta, net), inputs, actions)


def first_loss(lab: Lab, x: np.ndarray, action: np.ndarray) -> None:
    """Check the loss before training: the output is 0, the mean of the targets."""
    net = cloning.random_net(np.random.default_rng(SEED), 4, UNITS, 2)
    loss = Clone(net, fit_scaler(x), fit_scaler(action)).loss(x, action)
    print(f"  loss before training: {loss:.3f}")
    lab.measured("loss before training", loss)
    lab.record("first_loss", loss - 1, metric="off", label="|loss - 1|")


def with_last(episodes_of: np.ndarray, action: np.ndarray) -> np.ndarray:
    """Return the last action of each row, (n, 2); 0 in the first row of an episode."""
    last = np.vstack([np.zeros((1, 2)), action[:-1]])
    last[np.append(True, np.diff(episodes_of) != 0)] = 0
    return last


def tested(policy) -> day15_mujoco.Episodes:
    """Return the episodes of a policy from the starts of the test."""
    start = day15_mujoco.starts(TESTED, np.random.default_rng(STARTS_SEED))
    # mujoco.mj_step runs the policy
    return day15_mujoco.run(*day15_mujoco.scene(), start, policy)


def repeating(clone: Clone, truth: bool = False):
    """Return the policy of a clone that gets the last action as an input.

    The last action is its own, or with truth=True the demonstrator's.
    """
    last = np.zeros((TESTED, 2))

    def act(seen: np.ndarray) -> np.ndarray:
        nonlocal last
        action = clone.act(np.hstack([seen, last]))
        last = np.clip(action, -day15_mujoco.FASTEST, day15_mujoco.FASTEST)
        if truth:
            last = day15_mujoco.demonstrator(seen)
        return action

    return act


def told(name: str, home: np.ndarray) -> None:
    """Print the rounded number of pucks at home, and Wilson's interval."""
    n = 5 * round(np.sum(home) / 5)  # it may differ between machines
    _, low, high = success_rate(np.arange(len(home)) < n)
    print(f"  {name:25} about {n:3} of {len(home)}, 95 %: {low:.2f} to {high:.2f}")


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    model, data = day15_mujoco.scene()
    rng = np.random.default_rng(SEED)
    print(f"MuJoCo {mujoco.mj_versionString()}: a pusher and a puck")

    lab.step("1. Pushing without looking, and with a small error")
    blind_pushes(lab, model, data)
    drift(lab, model, data)

    lab.step(f"2. The data: {DEMOS} demonstrations, and {HELD_OUT} held out")
    (x, action, episode), (x_held, action_held, episode_held) = data_of(lab)
    check_scaler(lab, x)

    lab.step("3. The network, its loss and its gradient")
    check_gradient(lab, rng)
    first_loss(lab, x, action)
    check_adam(lab, rng)
    if lab.failed:
        print("\nNot trained, because a check above failed. ARGS=--try trains anyway.")
        return lab.finish()

    lab.step("4. Behaviour cloning")
    clone = train(lab, "the clone", x, action)
    held = clone.loss(x_held, action_held)
    print(f"  loss {clone.loss(x, action):.3f}, held out {held:.3f}")
    run = tested(clone.act)
    told("the clone", run.home())

    lab.step("5. The same, and it is also told its last action")
    x2, x2_held = (
        np.hstack([a, with_last(e, b)])
        for a, b, e in ((x, action, episode), (x_held, action_held, episode_held))
    )
    copycat = train(lab, "the copycat", x2, action)
    print(f"  loss {copycat.loss(x2, action):.3f}, "
          f"held out {copycat.loss(x2_held, action_held):.3f}")  # fmt: skip
    own = tested(repeating(copycat)).home()
    told("told its own last action", own)
    told("told the demonstrator's", tested(repeating(copycat, truth=True)).home())
    z = normalise(action_held, copycat.actions)
    repeats = persistence_loss(z, episode_held)
    print(f"  loss of repeating the last action: {repeats:.3f}")
    inner = np.diff(episode_held, prepend=-1) == 0  # rows with a last action
    change = (z - with_last(episode_held, z))[inner]
    lab.check("persistence_loss - by the last actions", repeats - np.mean(change**2))
    lab.record("copycat_gap", np.sum(run.home()) - np.sum(own), metric="starts",
               label="pucks of the clone minus the copycat's", seed=SEED)  # fmt: skip

    lab.step("6. Side quest: how far from the data")
    with lab.side_quest():
        known = normalise(x, clone.inputs)
        visited = normalise(run.observation[:, 30], clone.inputs)
        far = nearest_distance(known, visited)
        off = far - cloning.nearest_distance(known, visited)
        lab.check("|nearest_distance - the library's|", off)
        print(f"  after 3 s: {np.median(far):.3f}, the median of {TESTED} runs")
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
