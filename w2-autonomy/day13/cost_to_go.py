"""13.3 `cost_to_go(P, x)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

from .asked import definite

row = Row(Scalar())


@row.inputs
def _(rng):
    P = np.array([[2.0, 1], [1, 2.5]])
    drawn = [(definite(rng, n), rng.numbers(-2, 2, n)) for n in (2, 3, 5, 2, 4, 3)]
    return [(P, np.array([1.0, 2.0])), *drawn]


@row.wrongs
def _(P, x):
    """half: your code returns half of the cost-to-go. Omit the factor of 1/2, because
      the cost in this task has no such factor
    length-of-P-x: your code returns the norm of P x. Return x . P x instead
    summed: your code sums the entries of P x. Multiply each entry by the corresponding
      entry of x before you sum them
    P-rooted: your code uses the square roots of the entries of P. Use P itself
    P-by-squares: your code multiplies P by the squares of the entries of x. Use x . P x
      instead, which also contains products of two different entries of x
    trace: your code multiplies the trace of P by x . x. Return x . P x instead
    """
    right = x @ P @ x
    return {
        "half": right / 2,
        "length-of-P-x": np.linalg.norm(P @ x),
        "summed": np.sum(P @ x),
        "P-rooted": x @ np.sqrt(np.abs(P)) @ x,
        "P-by-squares": np.sum(P @ x**2),
        "trace": np.trace(P) * (x @ x),
    }


row.at_least_0(answer="a sum of squares")


@row.right  # Entry by entry.
def _(P, x):
    return sum(P[i, j] * a * b for i, a in enumerate(x) for j, b in enumerate(x))


row.spans(  # as small, or as large, as in the lab
    P=(lambda P: 30 * P,),
    x=(lambda x: 0.0006 * x,),
)
