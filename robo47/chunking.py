"""Action chunks, a latent variable, and temporal ensembling.

A policy predicts the next K actions at once, an action chunk, (K, m). An encoder sees
observation and chunk and returns a Gaussian over a latent variable z, by its mean and
the logarithm of its variance; a decoder predicts the chunk from observation and z (a
conditional variational autoencoder, CVAE). Conventions:

- A chunk begins with the action of its own row; a mask marks the entries that exist.
- Random quantities are arguments: the noise of `reparameterise` is standard normal.
- A divergence is in nats; the prior of z is a standard normal distribution.
- Several plans are given in the order in which they were made, the oldest first.
- Metres, seconds, float64.

Sources: Zhao and others, "Learning fine-grained bimanual manipulation with low-cost
hardware" (2023), ACT; Kingma and Welling, "Auto-encoding variational Bayes" (2014);
Vaswani and others, "Attention is all you need" (2017).
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.cloning import layers

Plan = Callable[[Array], Array]  # observations (n, 4) to chunks (n, K, m)


def action_chunks(action: ArrayLike, episode: ArrayLike, K: int) -> tuple[Array, Array]:
    """Return each row's action with the next K - 1 actions of its episode, and a mask.

    Args:
        action: actions row by row, (n, m); the rows of an episode are adjacent.
        episode: number of each row's episode, (n,). A change of the number begins a
            new episode, also if the number occurred before.
        K: entries of a chunk, at least 1; it may exceed the length of an episode.

    Returns:
        (targets, mask), (n, K, m) and (n, K): the mask is 1 for an entry that exists.
        Behind the end of the episode the target and the mask are 0.

    Raises:
        ValueError: a wrong shape, or K below 1.
    """
    action = checks.array(action, "action", ("n", "m"))
    episode = np.asarray(episode)
    if action.ndim != 2 or episode.shape != action.shape[:1]:
        raise ValueError(
            f"action has shape {action.shape} and episode {episode.shape}; "
            "expected (n, m) and (n,)"
        )
    if K < 1:
        raise ValueError(f"K is {K}; a chunk has at least 1 entry")
    n = len(action)
    new = np.append(True, episode[1:] != episode[:-1])
    number = np.cumsum(new)  # 1, 2, ... in the order of time
    rows = np.arange(n)[:, None] + np.arange(K)
    inside = np.minimum(rows, n - 1)
    mask = (rows < n) & (number[inside] == number[:, None])
    return np.where(mask[..., None], action[inside], 0.0), mask.astype(np.float64)


def masked_l1(
    pred: ArrayLike, target: ArrayLike, mask: ArrayLike
) -> tuple[float, Array]:
    """Return the mean absolute error of the entries that exist, and its gradient.

    Args:
        pred, target: chunks, (n, K, m).
        mask: 1 or True for an entry that exists, else 0, (n, K).

    Returns:
        (loss, gradient): the sum of the absolute errors of the existing entries, over
        m times the sum of the mask, and its derivatives with respect to pred,
        (n, K, m). The derivative of |e| at e = 0 is 0.

    Raises:
        ValueError: a wrong shape, or a mask of zeros.
    """
    pred = checks.array(pred, "pred", ("n", "K", "m"))
    target = checks.array(target, "target", pred.shape)
    mask = checks.array(mask, "mask", pred.shape[:2])
    entries = pred.shape[2] * np.sum(mask)
    if entries == 0:
        raise ValueError("the mask is 0 everywhere, so no entry has an error")
    weight = mask[..., None] / entries
    error = pred - target
    return float(np.sum(weight * np.abs(error))), weight * np.sign(error)


def reparameterise(mu: ArrayLike, logvar: ArrayLike, noise: ArrayLike) -> Array:
    """Return a sample of a Gaussian: mean plus standard deviation times noise.

    Args:
        mu: means, (n, z).
        logvar: logarithms of the variances, (n, z).
        noise: standard normal, (n, z).

    Returns:
        (n, z); infinite where the variance overflows.
    """
    mu, logvar, noise = _numbers(mu, logvar, noise)
    with np.errstate(over="ignore"):
        return mu + np.exp(0.5 * logvar) * noise


def kl_to_prior(mu: ArrayLike, logvar: ArrayLike) -> Array:
    """Return the Kullback-Leibler divergence from a standard normal distribution.

    Args:
        mu: means of the Gaussians, (n, z).
        logvar: logarithms of their variances, (n, z).

    Returns:
        KL(N(mu, exp(logvar)) || N(0, 1)) of each entry, nats, (n, z): at least 0;
        infinite where the variance overflows.
    """
    mu, logvar = _numbers(mu, logvar)
    with np.errstate(over="ignore"):
        return 0.5 * (np.exp(logvar) + mu**2 - 1.0 - logvar)


def encoder_gradient(
    dz: ArrayLike, mu: ArrayLike, logvar: ArrayLike, noise: ArrayLike, beta: float
) -> tuple[Array, Array]:
    """Return the gradient of a CVAE's loss with respect to the encoder's outputs.

    The loss is a loss of z = mu + exp(logvar / 2) noise, plus beta times the KL
    divergence of `kl_to_prior`, summed over the columns and averaged over the rows.

    Args:
        dz: gradient of the first part with respect to z, (n, z).
        mu, logvar, noise: as for `reparameterise`, (n, z).
        beta: weight of the divergence.

    Returns:
        (dmu, dlogvar), (n, z) each.

    Raises:
        ValueError: different shapes.
    """
    dz, mu, logvar, noise = _numbers(dz, mu, logvar, noise)
    if not dz.shape == mu.shape == logvar.shape == noise.shape or dz.ndim != 2:
        shapes = ", ".join(str(one.shape) for one in (dz, mu, logvar, noise))
        raise ValueError(f"dz, mu, logvar, noise have shapes {shapes}; expected (n, z)")
    each = beta / len(dz)
    with np.errstate(over="ignore"):
        spread = 0.5 * noise * np.exp(0.5 * logvar)
        return (
            dz + each * mu,
            dz * spread + 0.5 * each * (np.exp(logvar) - 1.0),
        )


def backprop(
    x: ArrayLike,
    d: ArrayLike,
    W1: ArrayLike,
    b1: ArrayLike,
    W2: ArrayLike,
    b2: ArrayLike,
    W3: ArrayLike,
    b3: ArrayLike,
) -> tuple[Array, Array, Array, Array, Array, Array, Array]:
    """Return the gradients of a network's arrays and of its input.

    Args:
        x: inputs, (n, a).
        d: gradient of any loss with respect to the outputs, (n, m).
        W1, b1, W2, b2, W3, b3: the network, as for `cloning.mlp`.

    Returns:
        The derivatives with respect to W1, b1, W2, b2, W3, b3 and x, in their shapes.

    Raises:
        ValueError: shapes that do not match.
    """
    x, W1, W2, W3 = _numbers(x, W1, W2, W3)
    first, second, pred = layers(x, W1, b1, W2, b2, W3, b3)
    d3 = np.asarray(d, dtype=np.float64)
    if d3.shape != pred.shape or x.ndim != 2:
        raise ValueError(f"d has shape {d3.shape}; the outputs have {pred.shape}")
    d2 = (d3 @ W3.T) * (1.0 - second**2)
    d1 = (d2 @ W2.T) * (1.0 - first**2)
    return (
        x.T @ d1, d1.sum(axis=0),
        first.T @ d2, d2.sum(axis=0),
        second.T @ d3, d3.sum(axis=0),
        d1 @ W1.T,
    )  # fmt: skip


def temporal_ensemble(plans: ArrayLike, decay: float) -> Array:
    """Return the weighted mean of what several plans predict for this moment.

    Plan i of k was made k - 1 - i steps ago, so its entry k - 1 - i is for now. Its
    weight is proportional to exp(-decay i), so a positive decay favours the oldest
    plan (as in ACT).

    Args:
        plans: chunks in the order of time, the oldest first, (k, K, m), k at most K.
        decay: per plan.

    Returns:
        (m,).

    Raises:
        ValueError: a wrong shape, or more plans than a chunk has entries.
    """
    plans = checks.array(plans, "plans", ("k", "K", "m"))
    k, K = plans.shape[:2]
    if k > K:
        raise ValueError(
            f"there are {k} plans of {K} entries; the oldest is over: give at most {K}"
        )
    now = plans[np.arange(k), np.arange(k)[::-1]]
    return _weights(k, decay) @ now


def started_share(wait: int, K: int) -> Array:
    """Return the fraction of chunks that have started by each entry, after a pause.

    A pause of w steps gives w + 1 rows with the same observation: 0 to w steps are
    still to wait, equally often.

    Args:
        wait: steps of the pause, at least 0.
        K: entries of a chunk, at least 1.

    Returns:
        min(1, (j + 1) / (wait + 1)) for j = 0 to K - 1, (K,).

    Raises:
        ValueError: a negative wait, or K below 1.
    """
    if wait < 0 or K < 1:
        raise ValueError(f"wait is {wait} and K {K}; expected at least 0 and 1")
    return np.minimum(1.0, np.arange(1, K + 1) / (wait + 1))


def ensemble_noise(k: int, decay: float) -> float:
    """Return what a weighted mean of k plans leaves of their independent errors.

    Args:
        k: number of plans, at least 1.
        decay: of the weights, as for `temporal_ensemble`.

    Returns:
        The standard deviation of the mean, for errors of standard deviation 1.

    Raises:
        ValueError: k below 1.
    """
    if k < 1:
        raise ValueError(f"k is {k}; expected at least 1 plan")
    return float(np.linalg.norm(_weights(k, decay)))


def attention(q: ArrayLike, k: ArrayLike, v: ArrayLike) -> Array:
    """Return scaled dot-product attention: softmax(q k^T / sqrt(d)) v.

    Args:
        q: queries, (n, d).
        k: keys, (m, d).
        v: values, (m, e).

    Returns:
        For each query the mean of the values, weighted by the softmax of the scaled
        products with the keys, (n, e).

    Raises:
        ValueError: shapes that do not match.
    """
    q = checks.array(q, "q", ("n", "d"))
    k = checks.array(k, "k", ("m", q.shape[-1]))
    v = checks.array(v, "v", (k.shape[-2], "e"))
    logits = q @ k.T / np.sqrt(q.shape[-1])
    weights = np.exp(logits - logits.max(axis=1, keepdims=True))
    return (weights / weights.sum(axis=1, keepdims=True)) @ v


def chunked_policy(plan: Plan, h: int) -> Callable[[Array], Array]:
    """Return the policy that executes h entries of each plan before it plans again.

    Args:
        plan: given observations (n, 4), one chunk per row, (n, K, m).
        h: at least 1 and at most K.

    Returns:
        A policy for one run: given observations (n, 4), actions (n, m).
    """
    step, now = 0, np.empty(0)

    def act(seen: Array) -> Array:
        nonlocal step, now
        if step % h == 0:
            now = plan(seen)
        step += 1
        return now[:, (step - 1) % h]

    return act


def ensembled_policy(
    plan: Plan,
    K: int,
    decay: float,
    mean: Callable[[Array, float], Any] = temporal_ensemble,
) -> Callable[[Array], Array]:
    """Return the policy that plans at every step and averages the last K plans.

    Args:
        plan: given observations (n, 4), one chunk per row, (n, K, m).
        K: entries of a chunk.
        decay: of the weights.
        mean: `temporal_ensemble`, or a function of the same arguments and result.

    Returns:
        A policy for one run: given observations (n, 4), actions (n, m).
    """
    plans: list[Array] = []

    def act(seen: Array) -> Array:
        now = plan(seen)
        n, _, m = now.shape
        plans.append(now.transpose(1, 0, 2).reshape(K, n * m))  # all rows side by side
        del plans[:-K]
        return np.asarray(mean(np.stack(plans), decay)).reshape(n, m)

    return act


def _weights(k: int, decay: float) -> Array:
    """Return exp(-decay i), i = 0 to k - 1, divided by their sum."""
    logits = -decay * np.arange(k)
    weights = np.exp(logits - logits.max())
    return np.asarray(weights / weights.sum())


def _numbers(*values: ArrayLike) -> list[Array]:
    """Return arrays of float64, or of complex numbers; nothing has to be finite."""
    arrays: list[Any] = [np.asarray(one) for one in values]
    return [one if one.dtype.kind == "c" else one.astype(np.float64) for one in arrays]
