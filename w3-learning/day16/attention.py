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
            "Your function is right for small products, but the result is NaN for "
            "large ones. exp overflows, or it is 0 for a whole row. Subtract the "
            "largest entry of each row before exp: the weights do not change.",
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
    """wrong-axis: your weights add up to 1 over the queries. The weights of each query
      add up to 1 over the keys
    one-softmax: in your code, all weights together add up to 1. The weights of each
      query add up to 1
    no-softmax: in your code, the products themselves are the weights. Apply the softmax
      to each row
    best-only: your function returns the value of the best key. Attention is a weighted
      mean of all values
    no-exp: in your code, the products are divided by their sum. The softmax takes exp
      of the products first
    base-2: in your code, the weights are powers of 2. The softmax takes exp of the
      products
    sigmoid: your weights are sigmoids of the products, divided by their sum. The
      softmax takes exp of the products
    cosines: in your code, queries and keys are divided by their norms. Use the scalar
      product itself, divided by sqrt(d)
    cosines 2: in your code, queries and keys are divided by their norms. Use the scalar
      product itself, divided by sqrt(d)
    scaled-after: in your code, the mean of the values is divided by sqrt(d). Divide the
      products by it, before the softmax
    causal: in your code, query i uses the keys up to i only. In this task each query
      uses all keys
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
