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
    """undamped-limit: your code returns 2 / h. That is the stability limit of a spring
      without damping, and of a step that moves q with the old velocity. With critical
      damping and the new velocity, the limit is lower
    one-over-h: your code returns 1 / h. Return the omega at which the matrix of the
      step has an eigenvalue of -1
    larger-root: your result is the absolute value of the negative root of the quadratic
      equation for omega. Return the positive root instead
    nyquist: your code returns the Nyquist frequency pi / h, which is not a stability
      limit. Return the omega at which the step matrix has an eigenvalue of -1
    in-hertz: your code returns the limit in Hz. Return the limit in rad/s instead
    """
    return {
        "undamped-limit": 2.0 / h,
        "one-over-h": 1.0 / h,
        "larger-root": 2.0 * (np.sqrt(2.0) + 1.0) / h,
        "nyquist": np.pi / h,
        "in-hertz": (np.sqrt(2.0) - 1.0) / h / np.pi,
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


row.at_least_0(h="a time step", answer="a frequency")
