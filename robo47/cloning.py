"""Behaviour cloning: a small neural network, its gradient, Adam, and held-out data.

A policy is learned by regression from demonstrations. Rows of data are (observation,
action) pairs, and `episode` holds the number of the episode of each row. Conventions:

- A network is six arrays: W1 (a, h), b1 (h,), W2 (h, h), b2 (h,), W3 (h, m), b3 (m,).
  Rows are samples, so a layer is x W + b. Two layers of tanh, then a linear one.
- Random quantities are arguments: initial weights, the rows of a batch.
- Complex and not finite numbers pass through `mlp`, `normalise` and `mse`, so that
  `mlp_gradient` can be compared with the complex step.
- Metres, radians, float64.

Sources: Rumelhart, Hinton and Williams, "Learning representations by back-propagating
errors" (1986); Kingma and Ba, "Adam: a method for stochastic optimization" (2015);
Pomerleau, "ALVINN" (1989); Squire and Trapp, "Using complex variables to estimate
derivatives of real functions" (1998), the complex step.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robo47 import checks
from robo47.checks import Array

Net = Sequence[Array]  # W1, b1, W2, b2, W3, b3
BETAS = (0.9, 0.999)  # of Adam: decay rates of both averages
EPS = 1e-8


def contact_angle(phi: ArrayLike, distance: ArrayLike, R: ArrayLike) -> Array:
    """Return the contact angle after a straight push of a disc without friction.

    A round pusher moves along a straight line and pushes a round body that stops as
    soon as it is not pushed (quasi-static, isotropic damping). The contact has no
    friction, so the body moves along the contact normal and the pusher slides around
    it: d(phi)/ds = sin(phi) / R.

    Args:
        phi: angle between the direction of the push and the contact normal (from
            pusher to body) at the start, radians, within (-pi, pi).
        distance: path length of the pusher, metres.
        R: sum of both radii, metres, above 0.

    Returns:
        The angle at the end, radians; arguments broadcast.

    Raises:
        ValueError: a number that is not finite, or R not above 0.
    """
    phi = checks.array(phi, "phi", ())
    distance = checks.array(distance, "distance", ())
    R = checks.positive(R, "R")
    return 2.0 * np.arctan(np.tan(0.5 * phi) * np.exp(distance / R))


def split_by_episode(episode: ArrayLike, held_out: ArrayLike) -> NDArray[np.bool_]:
    """Return the mask of the rows that are held out: those of whole episodes.

    Args:
        episode: number of each row's episode, (n,).
        held_out: numbers of the episodes that are held out, (k,); a number without
            rows has no effect.

    Returns:
        (n,): True for each row of a held-out episode.

    Raises:
        ValueError: no vectors.
    """
    return np.isin(_vector(episode, "episode"), _vector(held_out, "held_out"))


def fit_scaler(x: ArrayLike) -> Array:
    """Return mean and standard deviation of each column, for `normalise`.

    Args:
        x: rows of data, (n, d).

    Returns:
        (2, d): the means, then the standard deviations (divided by n). A column whose
        entries are all equal has a standard deviation of 1.

    Raises:
        ValueError: no matrix, or one without rows.
    """
    x = _matrix(x, "x")
    if len(x) == 0:
        raise ValueError("x has no rows, so it has no mean")
    constant = (x == x[0]).all(axis=0)  # its std may differ from 0 by rounding
    return np.stack([x.mean(axis=0), np.where(constant, 1.0, x.std(axis=0))])


def normalise(x: ArrayLike, scaler: ArrayLike) -> Array:
    """Return each column minus its mean, divided by its standard deviation.

    Args:
        x: (..., d).
        scaler: of `fit_scaler`, (2, d).

    Returns:
        (..., d).

    Raises:
        ValueError: a wrong shape.
    """
    x, scaler = _scaled(x, scaler)
    return (x - scaler[0]) / scaler[1]


def denormalise(z: ArrayLike, scaler: ArrayLike) -> Array:
    """Return the inverse of `normalise`: each column times its std, plus its mean.

    Args:
        z: (..., d).
        scaler: of `fit_scaler`, (2, d).

    Returns:
        (..., d).

    Raises:
        ValueError: a wrong shape.
    """
    z, scaler = _scaled(z, scaler)
    return z * scaler[1] + scaler[0]


def mlp(
    x: ArrayLike,
    W1: ArrayLike,
    b1: ArrayLike,
    W2: ArrayLike,
    b2: ArrayLike,
    W3: ArrayLike,
    b3: ArrayLike,
) -> Array:
    """Return the outputs of a multilayer perceptron: tanh, tanh, linear.

    Args:
        x: inputs, (..., a); complex numbers and NaN pass through.
        W1, b1, W2, b2, W3, b3: (a, h), (h,), (h, g), (g,), (g, m), (m,).

    Returns:
        (..., m).

    Raises:
        ValueError: shapes that do not match.
    """
    return layers(x, W1, b1, W2, b2, W3, b3)[-1]


def mse(pred: ArrayLike, target: ArrayLike) -> tuple[float, Array]:
    """Return the mean squared error and its gradient with respect to the prediction.

    Args:
        pred, target: (n, m); the mean is over all n m entries.

    Returns:
        (loss, gradient): a number, and 2 (pred - target) / (n m), (n, m).

    Raises:
        ValueError: two shapes, or no rows.
    """
    pred = _matrix(pred, "pred")
    target = _matrix(target, "target")
    if pred.shape != target.shape or pred.size == 0:
        raise ValueError(
            f"pred has shape {pred.shape} and target {target.shape}; "
            "expected the same (n, m), not empty"
        )
    error = pred - target
    loss: Any = np.mean(error**2)
    loss = loss if np.iscomplexobj(loss) else float(loss)
    return loss, 2.0 * error / error.size


def mlp_gradient(
    x: ArrayLike,
    target: ArrayLike,
    W1: ArrayLike,
    b1: ArrayLike,
    W2: ArrayLike,
    b2: ArrayLike,
    W3: ArrayLike,
    b3: ArrayLike,
) -> tuple[Array, Array, Array, Array, Array, Array]:
    """Return the gradient of the loss `mse(mlp(x, ...), target)` (backpropagation).

    Args:
        x: inputs, (n, a).
        target: (n, m).
        W1, b1, W2, b2, W3, b3: the network, as for `mlp`.

    Returns:
        The derivatives with respect to W1, b1, W2, b2, W3, b3, in their shapes.

    Raises:
        ValueError: shapes that do not match.
    """
    x = _matrix(x, "x")
    first, second, pred = layers(x, W1, b1, W2, b2, W3, b3)
    W2 = _numbers(W2)
    W3 = _numbers(W3)
    d3 = mse(pred, target)[1]
    d2 = (d3 @ W3.T) * (1.0 - second**2)
    d1 = (d2 @ W2.T) * (1.0 - first**2)
    return (
        x.T @ d1, d1.sum(axis=0),
        first.T @ d2, d2.sum(axis=0),
        second.T @ d3, d3.sum(axis=0),
    )  # fmt: skip


def adam_step(
    theta: ArrayLike, grad: ArrayLike, m: ArrayLike, v: ArrayLike, k: int, rate: float
) -> tuple[Array, Array, Array]:
    """Return parameters and both averages after one step of Adam (Kingma and Ba, 2015).

    The decay rates are 0.9 and 0.999, both averages are corrected for their start at
    0, and eps = 1e-8 is added outside the square root.

    Args:
        theta: parameters, any shape.
        grad: gradient of the loss, the same shape.
        m, v: averages of the gradient and of its square, the same shape; 0 at first.
        k: number of this step, 1 for the first.
        rate: step size (learning rate).

    Returns:
        (theta, m, v) after the step, new arrays.

    Raises:
        ValueError: different shapes, or k below 1.
    """
    theta = np.asarray(theta, dtype=np.float64)
    grad = np.asarray(grad, dtype=np.float64)
    m = np.asarray(m, dtype=np.float64)
    v = np.asarray(v, dtype=np.float64)
    if not theta.shape == grad.shape == m.shape == v.shape:
        shapes = ", ".join(str(one.shape) for one in (theta, grad, m, v))
        raise ValueError(f"theta, grad, m, v have the shapes {shapes}; expected one")
    if k < 1:
        raise ValueError(f"k is {k}; the first step has k = 1")
    m = BETAS[0] * m + (1.0 - BETAS[0]) * grad
    v = BETAS[1] * v + (1.0 - BETAS[1]) * grad**2
    mean = m / (1.0 - BETAS[0] ** k)
    square = v / (1.0 - BETAS[1] ** k)
    return theta - rate * mean / (np.sqrt(square) + EPS), m, v


def persistence_loss(action: ArrayLike, episode: ArrayLike) -> float:
    """Return the loss of the policy that repeats the last action.

    Args:
        action: actions row by row, (n, m); the rows of an episode are adjacent.
        episode: number of each row's episode, (n,). A change of the number begins a
            new episode, also if the number occurred before.

    Returns:
        The mean squared change of the action from one row to the next, over all
        columns and over all pairs of adjacent rows of one episode.

    Raises:
        ValueError: a wrong shape, or no two adjacent rows of one episode.
    """
    action = _matrix(action, "action")
    episode = _vector(episode, "episode")
    if len(episode) != len(action):
        raise ValueError(f"episode has {len(episode)} entries; expected {len(action)}")
    same = episode[1:] == episode[:-1]
    if not same.any():
        raise ValueError("no episode has two adjacent rows, so no action is repeated")
    return float(np.mean(np.diff(action, axis=0)[same] ** 2))


def nearest_distance(known: ArrayLike, asked: ArrayLike) -> Array:
    """Return the distance from each row of `asked` to the nearest row of `known`.

    Args:
        known: (n, d), at least one row.
        asked: (m, d).

    Returns:
        Euclidean distances, (m,).

    Raises:
        ValueError: a wrong shape, or no known row.
    """
    known = _matrix(known, "known")
    asked = _matrix(asked, "asked")
    if len(known) == 0 or known.shape[1] != asked.shape[1]:
        raise ValueError(
            f"known has shape {known.shape} and asked {asked.shape}; "
            "expected (n, d) with n of at least 1, and (m, d)"
        )
    least = [np.min(np.sum((known - one) ** 2, axis=1)) for one in asked]
    return np.sqrt(np.array(least))


def layers(x: ArrayLike, *arrays: ArrayLike) -> tuple[Array, Array, Array]:
    """Return the outputs of the three layers of a network; the last are `mlp`'s.

    Args:
        x: inputs, (..., a).
        arrays: W1, b1, W2, b2, W3, b3, as for `mlp`.

    Returns:
        (..., h), (..., g) and (..., m).

    Raises:
        ValueError: shapes that do not match.
    """
    x, (W1, b1, W2, b2, W3, b3) = _net(x, arrays)
    first = np.tanh(x @ W1 + b1)
    second = np.tanh(first @ W2 + b2)
    return first, second, second @ W3 + b3


def random_net(rng: np.random.Generator, a: int, h: int, m: int) -> list[Array]:
    """Return the six arrays of a network whose output is 0 for every input.

    Args:
        rng: generator of the initial weights.
        a, h, m: numbers of inputs, of units in both hidden layers, and of outputs.

    Returns:
        W1 and W2 with Gaussian entries of variance 1 / inputs of the layer; W3 and
        the biases are 0.
    """
    W1 = rng.normal(size=(a, h)) / np.sqrt(a)
    W2 = rng.normal(size=(h, h)) / np.sqrt(h)
    return [W1, np.zeros(h), W2, np.zeros(h), np.zeros((h, m)), np.zeros(m)]


def flat(arrays: Iterable[ArrayLike]) -> Array:
    """Return all numbers of some arrays as one vector, for `adam_step`."""
    return np.concatenate([np.ravel(one) for one in arrays])


def shaped(theta: ArrayLike, like: Iterable[Array]) -> list[Array]:
    """Return a vector as arrays in the shapes of others: the inverse of `flat`."""
    like = list(like)
    theta = np.asarray(theta)
    ends = np.cumsum([one.size for one in like])
    if theta.shape != (ends[-1],):
        raise ValueError(f"theta has shape {theta.shape}; expected ({ends[-1]},)")
    parts = np.split(theta, ends[:-1])
    return [part.reshape(one.shape) for part, one in zip(parts, like, strict=True)]


def cosine_rate(k: int, steps: int, rate: float) -> float:
    """Return the step size of step k = 1 to steps: from rate down to 0, as a cosine."""
    return float(0.5 * rate * (1.0 + np.cos(np.pi * (k - 1) / steps)))


def fit(
    net: Iterable[Array],
    gradient: Callable[[Any, list[Array]], Iterable[ArrayLike]],
    steps: Iterable[tuple[int, Any]],
    rate: Callable[[int], float],
    adam: Callable[..., Any] = adam_step,
) -> list[Array]:
    """Return a network after steps of Adam.

    Args:
        net: the initial arrays, of any number and shape.
        gradient: given the rows of a batch and the arrays, the gradient of the loss
            in their shapes.
        steps: pairs of the step's number, 1 for the first, and its batch.
        rate: given the step's number, its step size; see `cosine_rate`.
        adam: `adam_step`, or a function of the same arguments and results.

    Returns:
        The arrays after the last step.
    """
    like = [np.asarray(one, dtype=np.float64) for one in net]
    theta = flat(like)
    m, v = np.zeros_like(theta), np.zeros_like(theta)
    for k, batch in steps:
        grad = flat(gradient(batch, shaped(theta, like)))
        theta, m, v = adam(theta, grad, m, v, k, rate(k))
    return shaped(theta, like)


def batches(
    rng: np.random.Generator, n: int, size: int, steps: Iterable[int]
) -> Iterator[tuple[int, NDArray[np.int64]]]:
    """Yield each step's number and the indices of its batch, drawn with replacement.

    Args:
        rng: generator of the rows.
        n: number of rows of data.
        size: rows of a batch.
        steps: numbers of the steps; `Lab.training` counts and shows them.
    """
    for k in steps:
        yield k, rng.integers(0, n, size)


def complex_step(
    function: Callable[..., Any], arrays: Sequence[ArrayLike], step: float = 1e-20
) -> list[Array]:
    """Return the derivatives of a real function by the complex step.

    The function is called once per entry, with i times the step added to this entry.
    The imaginary part of the result, divided by the step, is the derivative; nothing
    is subtracted, so it is exact to rounding (Squire and Trapp, 1998).

    Args:
        function: of these arrays; returns one number and passes complex numbers
            through.
        arrays: where the derivatives are taken.
        step: small enough that its square vanishes beside 1.

    Returns:
        One array of derivatives per argument, in its shape.
    """
    given = [np.asarray(one, dtype=np.float64) for one in arrays]
    found = [np.zeros_like(one) for one in given]
    for i, one in enumerate(given):
        for at in np.ndindex(one.shape):
            moved = one.astype(complex)
            moved[at] += 1j * step
            value = function(*given[:i], moved, *given[i + 1 :])
            found[i][at] = np.imag(value) / step
    return found


def _net(x: ArrayLike, arrays: Sequence[ArrayLike]) -> tuple[Array, list[Array]]:
    """Return inputs and arrays of a network after checking that their shapes match."""
    x = _numbers(x)
    net = [_numbers(one) for one in arrays]
    size = x.shape[-1] if x.ndim else None
    for i in (0, 2, 4):
        W, b = net[i], net[i + 1]
        if W.ndim != 2 or W.shape[0] != size or b.shape != W.shape[1:]:
            raise ValueError(
                f"W{i // 2 + 1} has shape {W.shape} and b{i // 2 + 1} {b.shape} "
                f"for {size} inputs; expected ({size}, n) and (n,)"
            )
        size = W.shape[1]
    return x, net


def _scaled(x: ArrayLike, scaler: ArrayLike) -> tuple[Array, Array]:
    """Return data and a scaler after checking that their columns match."""
    x = _numbers(x)
    scaler = _numbers(scaler)
    if x.ndim == 0 or scaler.shape != (2, x.shape[-1]):
        raise ValueError(
            f"the data have shape {x.shape} and the scaler {scaler.shape}; "
            "expected (..., d) and (2, d)"
        )
    return x, scaler


def _numbers(value: ArrayLike) -> Array:
    """Return an array of float64, or of complex numbers; nothing has to be finite."""
    array: Any = np.asarray(value)
    return array if array.dtype.kind == "c" else array.astype(np.float64)  # type: ignore[no-any-return]


def _matrix(value: ArrayLike, name: str) -> Array:
    """Return a matrix; nothing in it has to be finite."""
    array = _numbers(value)
    if array.ndim != 2:
        raise ValueError(f"{name} has shape {array.shape}; expected (rows, columns)")
    return array


def _vector(value: ArrayLike, name: str) -> NDArray[Any]:
    """Return a vector of any type."""
    array = np.asarray(value)
    if array.ndim != 1:
        raise ValueError(f"{name} has shape {array.shape}; expected a vector")
    return array
