"""16.9 `attention(q, k, v)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Matrix, Row


def long_queries(rng):
    """Yield queries whose products with the keys exceed what exp can represent."""
    q, k, v = asked(rng, 3, 4, 2, 2)
    yield 3e3 * np.sign(q), 3.0 * k, v


row = Row(
    Matrix((None, None)),
    held_out=[
        HeldOut(
            "overflows",
            "Your function is correct for small products, but it returns NaN for large "
            "products. The exponentials of a row overflow, or all of them are 0. "
            "Subtract the largest entry of each row before you call exp. This "
            "subtraction does not change the weights.",
            long_queries,
        )
    ],
)


def asked(rng, n, m, d, e):
    """Return queries, keys and values."""
    sizes = (n, d), (m, d), (m, e)
    return tuple(rng.numbers(-2, 2, *size) for size in sizes)


@row.inputs
def _(rng):
    yield np.array([[1.0, 0]]), np.eye(2), np.array([[1.0], [0]])
    for n, m, d, e in ((1, 1, 2, 2), (3, 4, 2, 1), (2, 3, 4, 2), (3, 3, 3, 3)):
        yield asked(rng, n, m, d, e)
    n, m = (int(a) for a in rng.integers(2, 5, 2))
    yield asked(rng, n, m, 3, 2)


row.cases(
    one_key=lambda q, k, v: len(k) == 1,
    several_keys=lambda q, k, v: len(k) > 1,
)


@row.wrongs
def _(q, k, v):
    """wrong-axis: your softmax normalises over the queries. Normalise over the keys
      instead, so that the weights of each query sum to 1
    one-softmax: your softmax normalises the weights of all queries together. Normalise
      each row separately, so that the weights of each query sum to 1
    no-softmax: your code uses the scaled products of queries and keys as weights. Apply
      the softmax to each row of these products first
    best-only: your function returns the value of the key with the largest product.
      Return the weighted mean of all values instead, with the weights of the softmax
    no-exp: your code divides the products of queries and keys by their sum. Apply exp
      to each scaled product before this division
    base-2: your code uses powers of 2 in the softmax. Use exp of the scaled products
      instead
    sigmoid: your code applies the sigmoid to the scaled products and divides each
      result by the sum of its row. Apply exp instead of the sigmoid
    cosines: your code divides queries and keys by their norms. Omit this division, and
      divide their dot products by sqrt(d) only
    cosines 2: your code divides queries and keys by their norms. Omit this division,
      and divide their dot products by sqrt(d) only
    scaled-after: your code divides the mean of the values by sqrt(d). Divide the
      products of queries and keys by sqrt(d) instead, before the softmax
    causal: your code restricts query i to keys 0 to i, as in causal attention. Use all
      keys for each query instead
    """
    d = q.shape[1]
    raw = q @ k.T

    norms = np.linalg.norm(q, axis=1)[:, None] * np.linalg.norm(k, axis=1)
    cosine = raw / norms
    sigmoid = 1 / (1 + np.exp(-raw / np.sqrt(d)))
    seen = np.arange(len(k)) <= np.arange(len(q))[:, None]

    def soft(logits, axis=1):
        w = np.exp(logits - logits.max())
        return (w / w.sum(axis=axis, keepdims=True)) @ v

    return {
        "wrong-axis": soft(raw / np.sqrt(d), axis=0),
        "one-softmax": soft(raw / np.sqrt(d), axis=None),
        "no-softmax": raw / np.sqrt(d) @ v,
        "best-only": v[np.argmax(raw, axis=1)],
        "no-exp": raw / raw.sum(axis=1, keepdims=True) @ v,
        "base-2": soft(raw / np.sqrt(d) * np.log(2)),
        "sigmoid": sigmoid / sigmoid.sum(axis=1, keepdims=True) @ v,
        "cosines": soft(cosine),
        "cosines 2": soft(cosine / np.sqrt(d)),
        "scaled-after": soft(raw) / np.sqrt(d),
        "causal": soft(np.where(seen, raw / np.sqrt(d), -np.inf)),
    }


@row.right  # Row by row.
def _(q, k, v):
    rows = []
    for one in q:
        logits = np.array([one @ key for key in k]) / np.sqrt(len(one))
        weights = np.exp(logits - max(logits))
        rows.append(sum(w * value for w, value in zip(weights / weights.sum(), v)))
    return np.array(rows)


@row.right  # By differences of the products, without a largest entry.
def _(q, k, v):
    logits = np.einsum("id,jd->ij", q, k) / q.shape[1] ** 0.5
    with np.errstate(over="ignore"):
        apart = np.exp(logits[:, None, :] - logits[:, :, None])  # of j to i
    return (1 / apart.sum(axis=2)) @ v


@row.spans
def _(rng):
    q, k, v = asked(rng, 4, 5, 3, 2)
    for size in (1e-3, 20.0):
        yield size * q, k, size * v
    yield 1e4 * q, k, v
