"""Day 17: diffusion and flow matching, from Gaussian noise to a plan.

    make day17                       in the clone: sets all up, then runs this
    python src/day17_diffusion.py    in w3-learning/, once that is done

Rows are samples, (n, d). A schedule (T,) has the abar of each level, the fraction of
the signal's power that is left, from little noise to much. Steps 1 to 5 sample a
mixture of two Gaussians whose best denoiser is known exactly, so nothing is trained
before step 6.
"""

from functools import partial
from statistics import NormalDist

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import chunking, cli, cloning, diffusion, push
from robo47.lesson.lab import Lab
from robo47.policy import success_rate

SEED = 1  # of all random numbers
SAMPLES = 2000  # of the mixture, by each sampler
MEANS = np.array([[-1.0], [1.0]])  # of the two modes
SIGMA = 0.1  # standard deviation of each mode
WEIGHTS = np.array([0.3, 0.7])  # of the modes
ONE = (np.zeros((1, 1)), SIGMA, np.ones(1))  # a mixture of one mode
LEVELS = 100  # of the schedule for the mixture
STEPS = (5, 10, 20, 100)  # numbers of steps of the samplers
DEMOS = 100  # demonstrations at the dock
ACTIONS = 8  # of a plan, K
EXECUTED = 4  # actions of a plan before the next one is drawn, h
METHOD = "diffusion"  # or "flow"
PREDICTS_PLAN = True  # False: the network predicts the noise, or the velocity
PLAN_LEVELS = 50  # of the schedule for plans
DENOISING = 10  # steps from noise to a plan
UNITS = 96  # of each hidden layer
UPDATES = 2000  # steps of Adam
BATCH = 128  # rows of a step
RATE = 0.003  # step size at the first update; it falls to 0 as a cosine
STARTS_SEED = 1000  # of the starts that policies are tested on
TESTED = 200  # starts
SLOW = 0.045  # m/s sideways: slower than each demonstration at its start


def cosine_schedule(T: int) -> np.ndarray:
    """Return abar of the T levels of the cosine schedule, by increasing noise, (T,).

    Let f(t) = cos((t / T + 0.008) / 1.008 pi / 2)^2. Level t = 0, 1, ..., T - 1 removes
    the fraction beta = 1 - f(t + 1) / f(t) of the power that is left, but at most
    0.999. abar is the product of 1 - beta over this level and all levels before it.
    cosine_schedule(4) -> [0.847012, 0.493844, 0.144272, 0.000144]
    """
    # region 17.1
    t = np.arange(T + 1) / T  # the time at both ends of each level, from 0 to 1
    f = np.cos((t + 0.008) / 1.008 * np.pi / 2) ** 2  # f at the ends of the levels
    beta = np.minimum(1 - f[1:] / f[:-1], 0.999)  # the fraction that a level removes
    return np.cumprod(1 - beta)  # the remaining fraction after each level
    # endregion 17.1


def add_noise(x0: np.ndarray, noise: np.ndarray, abar: np.ndarray) -> np.ndarray:
    """Return noisy data, (n, d), with the fraction abar of the power from the data.

    x0 (n, d) are the data, noise (n, d) standard Gaussian numbers and abar (n,) the
    fraction of the data's power in each row, 0 to 1. The factors of data and noise are
    the roots of abar and 1 - abar. add_noise([[1]], [[0.5]], [0.36]) -> [[1.0]]
    """
    # region 17.2
    keep = np.sqrt(abar)[:, None]  # factor of each row's data
    lose = np.sqrt(1 - abar)[:, None]  # factor of each row's noise
    return keep * x0 + lose * noise  # the noisy data
    # endregion 17.2


def exact_noise(
    x: np.ndarray, abar: float, means: np.ndarray, sigma: float, weights: np.ndarray
) -> np.ndarray:
    """Return the conditional mean of the noise, given each row of noisy data, (n, d).

    The data are a mixture of Gaussians with means (k, d), weights (k,) and the standard
    deviation sigma of each mode in each direction. x (n, d) is sqrt(abar) data +
    sqrt(1 - abar) noise. The result must also be finite for rows far from all modes.
    exact_noise([[0.5]], 0.36, [[-1], [1]], 0.1, [0.5, 0.5]) -> [[0.297030]]
    """
    # region 17.3
    variance = abar * sigma**2 + 1 - abar  # the variance of each noisy mode
    off = x[:, None] - np.sqrt(abar) * means  # distances from the means; (n, k, d)
    power = -(off**2).sum(axis=2) / (2 * variance)  # exponent of each Gaussian; (n, k)
    power = power - power.max(axis=1, keepdims=True)  # exponents; the largest is 0
    prob = weights * np.exp(power)  # probability of each mode before the normalisation
    prob = prob / prob.sum(axis=1, keepdims=True)  # probability of each mode
    mean = (prob[:, :, None] * off).sum(axis=1)  # mean distance from the noisy means
    return np.sqrt(1 - abar) / variance * mean  # the mean of the noise
    # endregion 17.3


def ddim_step(x: np.ndarray, eps: np.ndarray, abar: float, prev: float) -> np.ndarray:
    """Return samples (n, d) after a deterministic step from the level abar to prev.

    x (n, d) are samples at the level abar, and eps (n, d) the noise in them: x =
    sqrt(abar) clean + sqrt(1 - abar) eps. Add the same noise to the clean samples
    at the level prev, which lies between abar and 1 (no noise).
    ddim_step([[1]], [[0.5]], 0.36, 0.64) -> [[1.1]]
    """
    # region 17.4
    clean = (x - np.sqrt(1 - abar) * eps) / np.sqrt(abar)  # the clean samples
    return np.sqrt(prev) * clean + np.sqrt(1 - prev) * eps  # samples at the level prev
    # endregion 17.4


def ddpm_step(
    x: np.ndarray, eps: np.ndarray, abar: float, prev: float, noise: np.ndarray
) -> np.ndarray:
    """Return samples (n, d) after a random step from the level abar to prev.

    x and eps (n, d) are as in `ddim_step`, with abar below 1, and noise (n, d) are
    standard Gaussian numbers. The result is a sample at the level prev, drawn from its
    distribution given x and the clean sample. This is a Gaussian distribution whose
    mean is a weighted sum of both. With the noise [[1]] the result below is 1.464828.
    ddpm_step([[1]], [[0.5]], 0.36, 0.64, [[0]]) -> [[0.96875]]
    """
    # region 17.5
    clean = (x - np.sqrt(1 - abar) * eps) / np.sqrt(abar)  # the clean samples
    alpha = abar / prev  # the remaining fraction of the power from prev to abar
    of_clean = np.sqrt(prev) * (1 - alpha) / (1 - abar)  # weight of the clean samples
    of_x = np.sqrt(alpha) * (1 - prev) / (1 - abar)  # weight of x
    variance = (1 - prev) * (1 - alpha) / (1 - abar)  # the variance at the level prev
    mean = of_clean * clean + of_x * x  # the mean at the level prev
    return mean + np.sqrt(variance) * noise  # the sample at the level prev
    # endregion 17.5


def timesteps(T: int, n: int) -> np.ndarray:
    """Return the n levels that a sampler uses, whole numbers from T - 1 to 0, (n,).

    They are equally spaced and then rounded to the nearest whole number. T is the
    number of levels of the schedule. If n is 1, the level is T - 1.
    timesteps(50, 10) -> [49, 44, 38, 33, 27, 22, 16, 11, 5, 0]
    """
    # region 17.6
    return np.rint(np.linspace(T - 1, 0, n)).astype(int)  # the rounded levels
    # endregion 17.6


def width_kept(abars: np.ndarray, sigma: float) -> float:
    """Return the fraction of a Gaussian's standard deviation that DDIM steps keep.

    The data have the standard deviation sigma. abars (k,) are the levels of the steps,
    by decreasing noise; the last step leads to abar = 1. At each level the vector
    (sigma sqrt(abar), sqrt(1 - abar)) has a direction in the plane. A step keeps the
    cosine of the angle between two successive directions; all steps keep the product.
    width_kept([0.36], 0.1) -> 0.07479
    """
    # region 17.7
    signal = sigma * np.sqrt(abars)  # the first component of each vector
    angle = np.arctan2(np.sqrt(1 - abars), signal)  # the angle of each vector
    turn = np.diff(np.append(angle, 0))  # the angle of each step
    return np.prod(np.cos(turn))  # the product of the cosines
    # endregion 17.7


def flow_pair(
    x0: np.ndarray, noise: np.ndarray, t: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the point at the time t between noise and data, and its velocity.

    Both are (n, d). The data are x0 (n, d), the noise is (n, d) and t (n,) the time of
    each row. The point moves from the noise at t = 0 to the data at t = 1 along a
    straight line, at a constant velocity. flow_pair([[2]], [[1]], [0.25]) -> ([[1.25]],
    [[1]])
    """
    # region 17.8
    t = t[:, None]  # the times as a column
    return (1 - t) * noise + t * x0, x0 - noise  # the point and its velocity
    # endregion 17.8


def exact_velocity(
    x: np.ndarray, t: float, means: np.ndarray, sigma: float, weights: np.ndarray
) -> np.ndarray:
    """Return the mean velocity of `flow_pair` at each row of x, (n, d).

    x (n, d) are points at the time t, and the data are the mixture of Gaussians of
    `exact_noise`, with means (k, d), weights (k,) and the standard deviation sigma. The
    result is the mean of data - noise, given x.
    exact_velocity([[0.5]], 0.5, [[-1], [1]], 0.1, [0.5, 0.5]) -> [[0.519613]]
    """
    # region 17.9
    variance = t**2 * sigma**2 + (1 - t) ** 2  # the variance of x in each mode
    off = x[:, None] - t * means  # distances from the modes' means; (n, k, d)
    power = -(off**2).sum(axis=2) / (2 * variance)  # exponent of each Gaussian; (n, k)
    power = power - power.max(axis=1, keepdims=True)  # exponents; the largest is 0
    prob = weights * np.exp(power)  # probability of each mode before the normalisation
    prob = prob / prob.sum(axis=1, keepdims=True)  # probability of each mode
    slope = (t * sigma**2 - (1 - t)) / variance  # ratio covariance / variance
    return (prob[:, :, None] * (means + slope * off)).sum(axis=1)  # the mean velocity
    # endregion 17.9


def ema(slow: np.ndarray, fast: np.ndarray, k: int) -> np.ndarray:
    """Return the exponential moving average of a network's parameters, (n,).

    slow (n,) is the average so far, fast (n,) are the new parameters, and k = 0, 1, ...
    counts the averages so far. The old average has the weight (1 + k) / (10 + k), but
    at most 0.995, and the new parameters have the remaining weight.
    ema([1], [2], 0) -> [1.9]
    """
    # region 17.10
    decay = min(0.995, (1 + k) / (10 + k))  # weight of the old average
    return decay * slow + (1 - decay) * fast  # the new average
    # endregion 17.10


def levels(T: int, steps: int) -> np.ndarray:
    """Return abar of the levels that a sampler uses, from the noisiest."""
    return cosine_schedule(T)[np.asarray(timesteps(T, steps), dtype=int)]


def ddim(x: np.ndarray, abars: np.ndarray, noise_of) -> np.ndarray:
    """Return samples from the starts x; noise_of(x, abar) returns the noise in x."""
    for abar, prev in zip(abars, [*abars[1:], 1.0], strict=True):
        x = ddim_step(x, noise_of(x, abar), abar, prev)
    return x


def ddpm(x: np.ndarray, abars: np.ndarray, noise_of, rng) -> np.ndarray:
    """Return samples from the starts x, with fresh noise in each step."""
    for abar, prev in zip(abars, [*abars[1:], 1.0], strict=True):
        noise = rng.normal(size=x.shape)
        x = ddpm_step(x, noise_of(x, abar), abar, prev, noise)
    return x


def flow(x: np.ndarray, steps: int, velocity_of) -> np.ndarray:
    """Return samples after Euler steps from t = 0 to 1."""
    for t in np.arange(steps) / steps:
        x = x + velocity_of(x, t) / steps
    return x


def by_integration(x: float, keep: float, lose: float) -> tuple[float, float]:
    """Return the means of data and noise, given x = keep data + lose noise."""
    data = np.linspace(-6, 6, 20_001)
    density = WEIGHTS @ np.exp(-0.5 * ((data - MEANS) / SIGMA) ** 2)
    noise = (x - keep * data) / lose
    posterior = density * np.exp(-0.5 * noise**2)
    posterior = posterior / np.sum(posterior)
    return posterior @ data, posterior @ noise


def check_noise(lab: Lab, rng: np.random.Generator) -> None:
    """Check the schedule and add_noise by their definitions."""
    abars = cosine_schedule(LEVELS)
    f = np.cos((np.arange(LEVELS + 1) / LEVELS + 0.008) / 1.008 * np.pi / 2) ** 2
    off = abars[:-1] - f[1:-1] / f[0]
    lab.check("|abar - f(t + 1) / f(0)| without the last", off)
    lab.check("last abar / previous abar - 0.001", abars[-1] / abars[-2] - 0.001)
    linear = diffusion.linear_schedule(LEVELS)
    print(f"  abar at the noisy end: cosine {abars[-1]:.1e}, linear {linear[-1]:.3f}")
    lab.measured("abar at the noisy end, linear schedule", linear[-1])
    x0, noise = rng.normal(size=(2, 5, 3))
    angle = np.arange(5) * np.pi / 8
    by_angle = np.cos(angle) * x0.T + np.sin(angle) * noise.T
    off = add_noise(x0, noise, np.cos(angle) ** 2) - by_angle.T
    lab.check("add_noise - by cosine and sine", off)


def check_denoiser(lab: Lab) -> None:
    """Compare the exact noise with an integral over all data."""
    off = []
    for abar in (0.1, 0.5, 0.9):
        for x in np.linspace(-2, 2, 9):
            eps = exact_noise(np.array([[x]]), abar, MEANS, SIGMA, WEIGHTS)[0, 0]
            off.append(eps - by_integration(x, np.sqrt(abar), np.sqrt(1 - abar))[1])
    lab.record("exact_noise", off, label="|exact_noise - by integration|")
    far = np.array([[50.0], [80.0]])
    both, one = (
        exact_noise(far, 0.9, MEANS[some:], SIGMA, WEIGHTS[some:]) for some in (0, 1)
    )
    lab.check("the same at 50 and 80 - by the mode at 1 alone", both - one)


def check_steps(lab: Lab, rng: np.random.Generator) -> None:
    """Check both steps on samples whose data and noise are known, and the levels."""
    x0, eps, fresh = rng.normal(size=(3, 4, 2))
    off = []
    bayes = []
    for abar, prev in ((0.2, 0.3), (0.5, 0.9), (0.6, 1.0)):
        x = np.sqrt(abar) * x0 + np.sqrt(1 - abar) * eps
        later = np.sqrt(prev) * x0 + np.sqrt(1 - prev) * eps
        off.append(ddim_step(x, eps, abar, prev) - later)
        # The product of two Gaussians: of x given the sample, and of the sample.
        gain = (1 - prev) / (1 - abar) * np.sqrt(abar / prev)
        mean = np.sqrt(prev) * x0 + gain * (x - np.sqrt(abar) * x0)
        variance = (1 - prev) * (1 - gain * np.sqrt(abar / prev))
        random = mean + np.sqrt(variance) * fresh
        bayes.append(ddpm_step(x, eps, abar, prev, fresh) - random)
    lab.check("ddim_step - by data and noise", off)
    lab.check("ddpm_step - by Bayes' rule", bayes)
    off = []
    for T, n in ((100, 7), (50, 10), (9, 9), (9, 1)):
        even = np.linspace(T - 1, 0, n)
        some = timesteps(T, n)
        off.append(np.maximum(np.abs(some - even) - 0.5, 0).max())
        off.append(np.abs(some - np.rint(some)).max())
    lab.check("timesteps: distance to equal spacing - 0.5", off)


HEADER = "                          right mode   width / sigma   beyond 4 sigma"


def described(x: np.ndarray) -> tuple[float, float, float]:
    """Return the fraction in the right mode, width / sigma, and the fraction far."""
    off = np.abs(x - MEANS.T).min(axis=1)  # from the nearest mode
    width = np.sqrt(np.mean(off**2)) / SIGMA
    return np.mean(x > 0), width, np.mean(off > 4 * SIGMA)


def table(name: str, x: np.ndarray) -> None:
    """Print one row of a table of samples."""
    right, width, far = described(x)
    print(f"  {name:24}{right:10.3f}{width:16.3f}{far:17.3f}")


def noise_of(x: np.ndarray, abar: float) -> np.ndarray:
    """Return the exact noise of the mixture."""
    return exact_noise(x, abar, MEANS, SIGMA, WEIGHTS)


def velocity_of(x: np.ndarray, t: float) -> np.ndarray:
    """Return the exact velocity of the mixture."""
    return exact_velocity(x, t, MEANS, SIGMA, WEIGHTS)


def quantiles(n: int) -> np.ndarray:
    """Return n quantiles of the normal distribution: starts without sampling error."""
    normal = NormalDist()
    return np.array([[normal.inv_cdf((i + 0.5) / n)] for i in range(n)])


def predicted_fraction(abar: float) -> float:
    """Return the fraction of Gaussian starts that end in the right mode, on paper."""
    deviation = np.sqrt(abar * SIGMA**2 + 1 - abar)
    noisy = [NormalDist(np.sqrt(abar) * mean, deviation) for [mean] in MEANS]
    low, high = -10.0, 10.0
    for _ in range(60):  # bisection: below x is as much noisy data as the left mode has
        x = (low + high) / 2
        below = WEIGHTS @ [one.cdf(x) for one in noisy]
        low, high = (x, high) if below < WEIGHTS[0] else (low, x)
    return 1 - NormalDist().cdf(x)


def sample_mixture(lab: Lab, rng: np.random.Generator) -> None:
    """Print the samples of each sampler from the same starts, and of both schedules."""
    start = quantiles(SAMPLES)
    print(HEADER)
    for steps in STEPS:
        x = ddim(start, levels(LEVELS, steps), noise_of)
        table(f"DDIM, {steps} steps", x)
    lab.record("right_mode", np.mean(x > 0) - WEIGHTS[1], metric="off",
               label="|fraction - 0.7|")  # fmt: skip
    table(
        f"DDPM, {LEVELS} steps",
        ddpm(start, cosine_schedule(LEVELS)[::-1], noise_of, rng),
    )
    linear = diffusion.linear_schedule(LEVELS)
    x = ddim(start, linear[::-1], noise_of)
    table("DDIM, 100 steps, linear", x)
    print(f"  linear: predicted {predicted_fraction(linear[-1]):.4f}, "
          f"measured {np.mean(x > 0):.4f}")  # fmt: skip


def euler_width(steps: int) -> float:
    """Return the fraction of a mode's width that Euler steps keep, the mean being 0."""
    t = np.arange(steps) / steps
    slope = (t * SIGMA**2 - (1 - t)) / (t**2 * SIGMA**2 + (1 - t) ** 2)
    return np.prod(1 + slope / steps) / SIGMA


def widths(sampler, paper) -> tuple[dict, np.ndarray]:
    """Print the width of one mode, by number of steps, and compare it with paper.

    Returns:
        The measured widths over sigma by number of steps, and their errors.
    """
    start = quantiles(SAMPLES)
    print("  steps       paper   measured")
    measured = {}
    for steps in (1, *STEPS):
        measured[steps] = np.std(sampler(start, steps)) / np.std(start) / SIGMA
        print(f"{steps:7}{paper(steps):12.3f}{measured[steps]:11.3f}")
    return measured, [measured[steps] - paper(steps) for steps in measured]


def ddim_widths(lab: Lab) -> None:
    """Compare the width after DDIM steps with your product of cosines."""
    measured, off = widths(
        lambda x, steps: ddim(
            x, levels(LEVELS, steps), lambda x, abar: exact_noise(x, abar, *ONE)
        ),
        lambda steps: width_kept(levels(LEVELS, steps), SIGMA),
    )
    lab.measured("width / sigma after 10 DDIM steps", measured[10])
    lab.record("width", off, metric="off", label="|measured - paper|")


def flow_widths(lab: Lab) -> None:
    """Compare the width after Euler steps with the product of their factors."""
    measured, off = widths(
        lambda x, steps: flow(x, steps, lambda x, t: exact_velocity(x, t, *ONE)),
        euler_width,
    )
    lab.measured("width / sigma after 10 Euler steps", measured[10])
    lab.check("|measured - paper|", off)


def check_flow(lab: Lab, rng: np.random.Generator) -> None:
    """Check flow_pair by its definition, and the exact velocity by an integral."""
    x0, noise = rng.normal(size=(2, 4, 3))
    t = np.array([0.0, 0.2, 0.7, 0.9])
    first, last = (flow_pair(x0, noise, np.full(4, end))[0] for end in (0.0, 1.0))
    lab.check("flow_pair at t = 0 and 1 - noise and data", [first - noise, last - x0])
    (early, velocity), (late, _) = (flow_pair(x0, noise, t + h) for h in (0, 0.1))
    lab.check("its velocity - the difference quotient", velocity - (late - early) / 0.1)
    off = []
    for t in (0.0, 0.3, 0.6, 0.9):
        for x in np.linspace(-2, 2, 9):
            data, eps = by_integration(x, t, 1 - t)
            velocity = exact_velocity(np.array([[x]]), t, MEANS, SIGMA, WEIGHTS)
            off.append(velocity[0, 0] - (data - eps))
    lab.record("exact_velocity", off, label="|exact_velocity - by integration|")
    far = np.array([[50.0], [80.0]])
    both, one = (
        exact_velocity(far, 0.9, MEANS[some:], SIGMA, WEIGHTS[some:]) for some in (0, 1)
    )
    lab.check("the same at 50 and 80 - by the mode at 1 alone", both - one)


def demonstrations() -> tuple[np.ndarray, np.ndarray]:
    """Return observations (n, 4) and plans (n, 16): the next actions, 0 at the end."""
    # mujoco.mj_step runs the demonstrator
    episodes = push.dock_demonstrations(DEMOS, SEED)
    seen, action, episode = episodes.rows()
    plans, _ = chunking.action_chunks(action, episode, ACTIONS)
    print(f"  {np.sum(episodes.home())} of {DEMOS} demonstrations end at home, "
          f"{np.sum(push.on_the_left(episodes))} of them on the left")  # fmt: skip
    return seen, plans.reshape(len(seen), -1)


def time_of(abar: np.ndarray) -> np.ndarray:
    """Return the angle with the cosine sqrt(abar), as a fraction of 90 degrees."""
    return np.arccos(np.sqrt(abar)) * 2 / np.pi


def noisy_plans(plans: np.ndarray, rng: np.random.Generator):
    """Return noisy plans, the time of each row, and the noise or the velocity."""
    noise = rng.normal(size=plans.shape)
    if METHOD == "flow":
        t = rng.uniform(size=len(plans))
        x, velocity = flow_pair(plans, noise, t)
        return x, t, velocity
    abar = rng.choice(cosine_schedule(PLAN_LEVELS), len(plans))
    return add_noise(plans, noise, abar), time_of(abar), noise


def inputs(z: np.ndarray, x: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Return the inputs of the network: observation, noisy plan and time, (n, 28)."""
    time = np.broadcast_to(time, len(x))
    return np.hstack([z, x, diffusion.time_features(time)])


class Planner:
    """A network that draws plans, with the scalers of observations and plans."""

    def __init__(self, net, seen: np.ndarray, plans: np.ndarray) -> None:
        """Store the six arrays of a network and two scalers."""
        self.net = net
        self.seen = seen
        self.plans = plans

    def draw(
        self, seen: np.ndarray, noise: np.ndarray, steps: int = DENOISING
    ) -> np.ndarray:
        """Return a plan for each observation, m/s, (n, 8, 2), from noise (n, 16)."""
        z = cloning.normalise(seen, self.seen)
        if METHOD == "flow":
            x = flow(noise, steps, lambda x, t: self.velocity(z, x, t))
        else:
            abars = levels(PLAN_LEVELS, steps)
            x = ddim(noise, abars, lambda x, abar: self.noise(z, x, abar))
        return cloning.denormalise(x, self.plans).reshape(-1, ACTIONS, 2)

    def noise(self, z: np.ndarray, x: np.ndarray, abar: float) -> np.ndarray:
        """Return the network's estimate of the noise in x."""
        out = cloning.mlp(inputs(z, x, time_of(abar)), *self.net)
        if not PREDICTS_PLAN:
            return out
        return (x - np.sqrt(abar) * out) / np.sqrt(1 - abar)

    def velocity(self, z: np.ndarray, x: np.ndarray, t: float) -> np.ndarray:
        """Return the network's estimate of the velocity at x."""
        out = cloning.mlp(inputs(z, x, t), *self.net)
        return (out - x) / (1 - t) if PREDICTS_PLAN else out


def batch(
    z: np.ndarray, x0: np.ndarray, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Return inputs and targets of the network for rows of observations and plans."""
    x, time, other = noisy_plans(x0, rng)
    return inputs(z, x, time), x0 if PREDICTS_PLAN else other


def train(lab: Lab, seen: np.ndarray, plans: np.ndarray) -> tuple[Planner, float]:
    """Return a planner after its training, and its loss on all rows with new noise."""
    scalers = cloning.fit_scaler(seen), cloning.fit_scaler(plans)
    z = cloning.normalise(seen, scalers[0])
    x0 = cloning.normalise(plans, scalers[1])
    rng = np.random.default_rng(SEED)

    def gradient(rows: np.ndarray, net) -> tuple[np.ndarray, ...]:
        given, target = batch(z[rows], x0[rows], rng)
        return cloning.mlp_gradient(given, target, *net)

    net = cloning.random_net(rng, 12 + x0.shape[1], UNITS, x0.shape[1])
    steps = cloning.batches(rng, len(z), BATCH, lab.training("the planner", UPDATES))
    rates = partial(cloning.cosine_rate, steps=UPDATES, rate=RATE)
    net = cloning.fit(net, gradient, steps, rates)
    given, target = batch(z, x0, rng)
    return Planner(net, *scalers), cloning.mse(cloning.mlp(given, *net), target)[0]


def episodes_of(planner: Planner, steps: int = DENOISING) -> push.Episodes:
    """Return the episodes of a planner from the starts of the test."""
    start = push.dock(TESTED, np.random.default_rng(STARTS_SEED))
    rng = np.random.default_rng(SEED)

    def plan(seen: np.ndarray) -> np.ndarray:
        return planner.draw(seen, rng.normal(size=(TESTED, 2 * ACTIONS)), steps)

    # mujoco.mj_step runs the policy
    return push.run(*push.scene(), start, chunking.chunked_policy(plan, EXECUTED))


def sideways(
    planner: Planner, rng: np.random.Generator, steps: int = DENOISING
) -> np.ndarray:
    """Return the lateral velocity of each start's first plan, m/s, a sign per side."""
    start = push.dock(TESTED, np.random.default_rng(STARTS_SEED))
    plans = planner.draw(start, rng.normal(size=(TESTED, 2 * ACTIONS)), steps)
    x, y = plans[:, :EXECUTED].mean(axis=1).T
    ahead = start[:, 2:] / np.linalg.norm(start[:, 2:], axis=1, keepdims=True)
    return ahead[:, 0] * y - ahead[:, 1] * x


def report(planner: Planner, steps: int) -> None:
    """Print the rounded number of pucks at home, and the first plans that hesitate."""
    home = episodes_of(planner, steps).home()
    n = 5 * round(np.sum(home) / 5)  # it may differ between machines
    _, low, high = success_rate(np.arange(TESTED) < n)
    between = np.abs(sideways(planner, np.random.default_rng(SEED), steps)) < SLOW
    print(f"{steps:7}    about {n:3} of {TESTED}, 95 %: {low:.2f} to {high:.2f}"
          f"{np.mean(between):13.1f}")  # fmt: skip


def draw_plans(lab: Lab) -> None:
    """Train a planner, test it, and compare two draws from each start."""
    planner, loss = train(lab, *demonstrations())
    print(f"  loss {loss:.3f}")
    print("  steps    pucks at home                        below 45 mm/s")
    for steps in (1, 3, DENOISING):
        report(planner, steps)
    rng = np.random.default_rng(SEED)
    one, two = (sideways(planner, rng) > 0 for _ in range(2))
    label = "fraction of starts with plans to both sides"
    lab.record(
        "two_draws", np.mean(one != two), metric="fraction", label=label, seed=SEED
    )


def check_average(lab: Lab, rng: np.random.Generator) -> None:
    """Compare your averages with weighted means, and with the width on paper."""
    numbers = rng.normal(size=(UPDATES, 500))
    slow = numbers[0]
    weights = np.ones(1)
    for k, fast in enumerate(numbers[1:]):
        slow = ema(slow, fast, k)
        decay = min(0.995, (1 + k) / (10 + k))
        weights = np.append(decay * weights, 1 - decay)
    lab.check("ema - by weighted means", slow - weights @ numbers)
    print(f"  width of the average: paper {np.sqrt(0.005 / 1.995):.3f}, "
          f"measured {np.std(slow):.3f}")  # fmt: skip


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    print(f"MuJoCo {mujoco.mj_versionString()}: from noise to samples")

    lab.step("1. A schedule, and data with noise")
    check_noise(lab, rng)

    lab.step("2. The exact noise of a mixture")
    check_denoiser(lab)

    lab.step("3. Sampling: 30 % left, 70 % right")
    check_steps(lab, rng)
    sample_mixture(lab, rng)

    lab.step("4. The width of one mode after DDIM steps")
    ddim_widths(lab)

    lab.step("5. Flow matching")
    check_flow(lab, rng)
    print(HEADER)
    for steps in STEPS:
        x = flow(quantiles(SAMPLES), steps, velocity_of)
        table(f"flow, {steps} Euler steps", x)
    flow_widths(lab)
    if lab.failed:
        print("\nNot trained, because a check above failed. ARGS=--try trains anyway.")
        return lab.finish()

    lab.step("6. A policy that draws plans")
    draw_plans(lab)

    lab.step("7. Side quest: the average of a network")
    with lab.side_quest():
        check_average(lab, rng)
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
