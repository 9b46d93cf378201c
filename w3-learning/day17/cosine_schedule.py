"""17.1 `cosine_schedule(T)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((None,), called="the schedule"))


@row.inputs
def _(rng):
    for T in (4, 1, 2, 3, 7, 10, 20, 50, 100):
        yield (T,)
    yield (int(rng.integers(5, 40)),)


def of(f, T, most=0.999):
    """Return the schedule of a function f of the time from 0 to 1."""
    f = f(np.arange(T + 1) / T)
    return np.cumprod(1 - np.minimum(1 - f[1:] / f[:-1], most))


def angle(t):
    """Return the angle of the cosine at the time t, 0 to 1."""
    return (t + 0.008) / 1.008 * np.pi / 2


row.at_least_0(T="a number of levels", answer="fractions")


@row.wrongs
def _(T):
    """linear: your schedule is the linear one, with beta from 0.0001 to 0.02. It is
      made for 1000 levels, and with fewer levels much of the signal is left at the end
    no-square: your f is the cosine. It is the square of the cosine, because abar is a
      power
    no-offset: your f has no offset. Use t / T + 0.008, divided by 1.008
    no-cap: your last abar is 0, because beta is 1 there. Limit beta to 0.999, so that a
      sampler can divide by the root of abar
    from-level-0: your abar of level t is f(t) / f(0), so the first level has no noise.
      Level t ends at f(t + 1)
    from-level-0 2: your abar of level t is f(t), so the first level has nearly no
      noise. Level t ends at f(t + 1)
    betas: your result is beta, the fraction that each level removes. Return the product
      of 1 - beta over this level and all before it
    beta-of-the-start: your beta is the difference f(t) - f(t + 1). Level t removes a
      fraction of the power that is left, so divide the difference by f(t)
    betas-added: your code adds the fractions beta and subtracts the sum from 1. Each
      beta is a fraction of the power that is left, so multiply the numbers 1 - beta
    offset-outside: in your code, only the offset 0.008 is divided by 1.008. Divide the
      sum t / T + 0.008 by 1.008
    abar-limited: your code limits abar itself to at least 0.001. Limit beta to 0.999,
      and then multiply the numbers 1 - beta
    ratio-inverted: your ratio is f(t) / f(t + 1), which is above 1. Level t leads from
      f(t) to f(t + 1), so 1 - beta is f(t + 1) / f(t)
    always-at-limit: in your code, beta is 0.999 at every level. The limit should act
      only where 1 - f(t + 1) / f(t) is larger, which is at the last level
    """
    f = np.cos(angle(np.arange(T + 1) / T)) ** 2
    beta = np.minimum(1 - f[1:] / f[:-1], 0.999)
    return {
        "linear": np.cumprod(1 - np.linspace(1e-4, 0.02, T)),
        "no-square": of(lambda t: np.cos(angle(t)), T),
        "no-offset": of(lambda t: np.cos(t * np.pi / 2) ** 2, T),
        "no-cap": f[1:] / f[0],
        "from-level-0": f[:-1] / f[0],
        "from-level-0 2": f[:-1],
        "betas": beta,
        "beta-of-the-start": np.cumprod(1 - np.minimum(f[:-1] - f[1:], 0.999)),
        "betas-added": 1 - np.cumsum(beta),
        "offset-outside": of(lambda t: np.cos((t + 0.008 / 1.008) * np.pi / 2) ** 2, T),
        "abar-limited": np.maximum(f[1:] / f[0], 0.001),
        "ratio-inverted": np.cumprod(f[:-1] / f[1:]),
        "always-at-limit": 0.001 ** np.arange(1, T + 1),
    }


@row.right  # A loop over the levels.
def _(T):
    def f(t):
        return np.cos((t / T + 0.008) / 1.008 * np.pi / 2) ** 2

    left = 1.0
    found = []
    for t in range(T):
        left *= 1 - min(0.999, 1 - f(t + 1) / f(t))
        found.append(left)
    return np.array(found)


@row.right  # The product in closed form, except at the last level.
def _(T):
    f = (1 + np.cos((np.arange(T + 1) / T + 0.008) / 1.008 * np.pi)) / 2
    found = f[1:] / f[0]
    found[-1] = 0.001 * (found[-2] if T > 1 else 1)
    return found
