"""5.9 `max_stable_omega(h)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(Scalar(unit="rad/s", scale=100.0))


@row.inputs
def _(rng):
    for h in (0.002, 0.001, 0.004, *rng.numbers(0.002, 0.05, 5)):
        yield (float(h),)


@row.wrongs
def _(h):
    """undamped-limit: 2 / h is the limit of a spring without a damper; critical damping
      breaks earlier, because the damper acts a step late
    one-over-h: 1 / h is a rule of thumb; ask when the step's eigenvalue reaches -1
    larger-root: the quadratic equation has two roots, and the loop breaks at the
      smaller one
    nyquist: pi / h is how fast a signal may be to be seen at all, not to be controlled
    factor-two-forgotten: it is half as much as it should be
    in-hertz: this is in turns per second; asked is rad/s
    times-h: it grows with the time step; a longer step must allow less
    """
    return {
        "undamped-limit": 2.0 / h,
        "one-over-h": 1.0 / h,
        "larger-root": 2.0 * (np.sqrt(2.0) + 1.0) / h,
        "nyquist": np.pi / h,
        "factor-two-forgotten": (np.sqrt(2.0) - 1.0) / h,
        "in-hertz": (np.sqrt(2.0) - 1.0) / h / np.pi,
        "times-h": 2.0 * (np.sqrt(2.0) - 1.0) * h,
    }


@row.right  # By halving, on the eigenvalues.
def _(h):
    low, high = 0.1 / h, 1.9 / h
    for _ in range(100):
        w = (low + high) / 2
        step = [[1 - (h * w) ** 2, h - 2 * w * h * h], [-h * w * w, 1 - 2 * h * w]]
        stable = np.abs(np.linalg.eigvals(step)).max() < 1
        low, high = (w, high) if stable else (low, w)
    return low


@row.close("rounded-somewhere")  # Typed to six digits.
def _(h):
    return 0.828427 / h


row.at_least_0(h="a step of time", answer="a frequency")
