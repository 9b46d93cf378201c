"""The policies of the push: a diffusion policy, and regressions to compare it with.

All learn from the same demonstrations in the plane of `robo47.push`, with functions of
Days 15 to 17. A policy is trained once for the functions that train it and is then
kept.

Metres, seconds; `robo47.push` defines the observations (n, 4) and actions (n, 2).
"""

from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache, partial
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
from tqdm import tqdm

from robo47 import cloning, diffusion, push
from robo47.checks import Array

SEED = 1  # of demonstrations, initial weights and batches
DEMOS = 200  # demonstrations, each from another start
ACTIONS = 8  # of a plan, K
EXECUTED = 4  # actions of a plan before the next one is drawn, h
LEVELS = 50  # of the noise schedule
DENOISING = 20  # steps from noise to a plan
UNITS = 96  # of both hidden layers
BATCH = 128  # rows of a step
RATE = 0.008  # step size at the first update; it falls to 0 as a cosine
UPDATES = 5000  # steps of Adam, of the diffusion policy
REGRESSION_UPDATES = 1500  # the same of a regression; more do not improve it

# The functions that train a policy and draw plans, and what they belong to.
TRAINS = (
    "fit_scaler", "normalise", "denormalise", "mlp", "mse", "adam_step",
    "action_chunks", "masked_l1", "backprop",
    "cosine_schedule", "add_noise", "ema",
)  # fmt: skip


class Data(NamedTuple):
    """Rows of demonstrations: normalised observations and plans, and their scalers."""

    seen: Array  # normalised observations, (n, 4)
    plans: Array  # normalised plans, (n, K m)
    mask: Array  # 1 for an entry of a plan that exists, else 0, (n, K)
    scalers: tuple[Array, Array]  # of observations and of plans, for `normalise`


class Policy(NamedTuple):
    """A network with the data that it was trained on."""

    fns: Any
    data: Data
    net: list[Array]
    diffuses: bool  # False: a regression, which needs no noise

    def draw(
        self, seen: Array, noise: Array, steps: int = DENOISING, fns: Any = None
    ) -> Array:
        """Return a plan for each observation, m/s, (n, K, 2).

        Args:
            seen: observations, (n, 4).
            noise: standard Gaussian numbers, (n, 2 K); a regression ignores them.
            steps: of denoising.
            fns: the functions that draw; by default those that trained the network.
        """
        fns = fns or self.fns
        z = fns.normalise(seen, self.data.scalers[0])
        if self.diffuses:
            x = _denoised(fns, self.net, z, noise, steps)
        else:
            x = fns.mlp(z, *self.net)
        plans = np.asarray(fns.denormalise(x, self.data.scalers[1]))
        return plans.reshape(len(seen), -1, 2)


def policy(fns: Any) -> Policy:
    """Return the diffusion policy of some functions; it is trained once and kept.

    Args:
        fns: has an attribute for every name in TRAINS, and those of Day 17.
    """
    return _kept("diffusion", *_those(fns))._replace(fns=fns)


def regression(fns: Any, absolute: bool, actions: int) -> Policy:
    """Return a policy that predicts plans by regression, trained once and kept.

    Args:
        fns: has an attribute for every name in TRAINS.
        absolute: True for the mean absolute error, False for the squared one.
        actions: of a plan, K.
    """
    kind = "absolute" if absolute else "squared"
    return _kept((kind, actions), *_those(fns))._replace(fns=fns)


def _those(fns: Any) -> list[Any]:
    return [getattr(fns, name) for name in TRAINS]


@lru_cache(16)
def _kept(kind: Any, *functions: Callable[..., Any]) -> Policy:
    """Return a trained policy; it is kept by the functions that trained it."""
    fns = SimpleNamespace(**dict(zip(TRAINS, functions, strict=True)))
    if kind == "diffusion":
        return _diffusion(fns)
    loss, actions = kind
    data = demonstrations(fns, actions)
    slope = partial(_absolute if loss == "absolute" else _squared, fns)

    def batch(rows: Array, rng: np.random.Generator) -> tuple[Array, Array, Array]:
        return data.seen[rows], data.plans[rows], data.mask[rows]

    net = _trained(
        fns, f"regression, {loss} error", batch, slope, data, 4, REGRESSION_UPDATES
    )
    return Policy(fns, data, net, False)


def _diffusion(fns: Any) -> Policy:
    """Train a network to recover plans from noisy ones."""
    data = demonstrations(fns, ACTIONS)
    abars = fns.cosine_schedule(LEVELS)

    def batch(rows: Array, rng: np.random.Generator) -> tuple[Array, Array, Array]:
        plans = data.plans[rows]
        abar = rng.choice(abars, len(rows))
        x = fns.add_noise(plans, rng.normal(size=plans.shape), abar)
        return _inputs(data.seen[rows], x, abar), plans, data.mask[rows]

    slope = partial(_squared, fns)
    width = 12 + data.plans.shape[1]
    net = _trained(fns, "the policy", batch, slope, data, width, UPDATES)
    return Policy(fns, data, net, True)


def demonstrations(fns: Any, actions: int) -> Data:
    """Return the rows of the demonstrations as a policy is trained on them."""
    seen, action, episode = push.dock_demonstrations(DEMOS, SEED).rows()
    plans, mask = fns.action_chunks(action, episode, actions)
    plans = np.asarray(plans).reshape(len(seen), -1)
    scalers = fns.fit_scaler(seen), fns.fit_scaler(plans)
    z, x0 = fns.normalise(seen, scalers[0]), fns.normalise(plans, scalers[1])
    return Data(z, x0, mask, scalers)


def _trained(
    fns: Any,
    title: str,
    batch: Callable[..., tuple[Array, Array, Array]],
    slope: Callable[[Array, Array, Array], Array],
    data: Data,
    width: int,
    updates: int,
) -> list[Array]:
    """Return the moving average of a network over its training.

    Args:
        fns: the functions.
        title: of the progress bar.
        batch: given rows and a generator, inputs (n, width), targets and their mask.
        slope: given predictions, targets and mask, the gradient of the loss.
        data: of the demonstrations.
        width: number of inputs.
        updates: steps of Adam.
    """
    rng = np.random.default_rng(SEED)
    first = cloning.random_net(rng, width, UNITS, data.plans.shape[1])
    slow = cloning.flat(first)

    def gradient(rows: Array, net: list[Array]) -> Iterable[Array]:
        x, target, mask = batch(rows, rng)
        d = slope(fns.mlp(x, *net), target, mask)
        return fns.backprop(x, d, *net)[:6]

    def adam(*given: Any) -> Any:
        nonlocal slow
        theta, m, v = fns.adam_step(*given)
        slow = fns.ema(slow, theta, given[4] - 1)
        return theta, m, v

    steps = cloning.batches(rng, len(data.seen), BATCH, _shown(title, updates))
    rates = partial(cloning.cosine_rate, steps=updates, rate=RATE)
    cloning.fit(first, gradient, steps, rates, adam)
    return cloning.shaped(slow, first)


def _shown(title: str, updates: int) -> Iterator[int]:
    """Yield the numbers of a training's steps, from 1, and show a bar meanwhile."""
    bar = tqdm(range(1, updates + 1), f"training {title}", leave=False, disable=None)
    yield from bar


def _squared(fns: Any, pred: Array, target: Array, mask: Array) -> Array:
    """Return the gradient of the mean squared error; missing entries are 0, at rest."""
    return np.asarray(fns.mse(pred, target)[1])


def _absolute(fns: Any, pred: Array, target: Array, mask: Array) -> Array:
    """Return the gradient of the mean absolute error of the entries that exist."""
    shape = (*mask.shape, -1)
    return np.asarray(
        fns.masked_l1(pred.reshape(shape), target.reshape(shape), mask)[1]
    ).reshape(pred.shape)


def _inputs(z: Array, x: Array, abar: Any) -> Array:
    """Return the network's inputs: observation, noisy plan, level, (n, 12 + K m)."""
    time = np.arccos(np.sqrt(np.clip(abar, 0.0, 1.0))) * 2.0 / np.pi
    time = np.broadcast_to(time, len(x))
    return np.hstack([z, x, diffusion.time_features(time)])


def _denoised(fns: Any, net: list[Array], z: Array, x: Array, steps: int) -> Array:
    """Return normalised plans after steps of denoising."""
    abars = np.asarray(fns.cosine_schedule(LEVELS))
    abars = abars[np.asarray(fns.timesteps(LEVELS, steps), dtype=int)]
    for abar, prev in zip(abars, [*abars[1:], 1.0], strict=True):
        plans = fns.mlp(_inputs(z, x, abar), *net)
        eps = (x - np.sqrt(abar) * plans) / np.sqrt(1.0 - abar)
        x = fns.ddim_step(x, eps, float(abar), float(prev))
    return x
