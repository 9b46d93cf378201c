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
    """linear: your function returns the linear schedule, with beta from 0.0001 to 0.02.
      Use the cosine schedule instead. With few levels, the linear schedule keeps much
      of the data's power even at the noisiest level
    no-square: your code uses the cosine as f. Use the square of the cosine instead,
      because f is proportional to the data's remaining power
    no-offset: your code omits the offset in f. Replace t / T by (t / T + 0.008) / 1.008
    no-cap: your code does not limit beta, so abar is about 0 at the noisiest level.
      Limit beta to at most 0.999, because a sampler divides by the square root of abar
    from-level-0: your code computes abar at level t as f(t) / f(0), so level 0 has no
      noise. Multiply the factors 1 - beta for levels 0 to t instead, including level t,
      because this level adds noise too
    from-level-0 2: your code uses f(t) as abar at level t, so level 0 has almost no
      noise. Multiply the factors 1 - beta for levels 0 to t instead, including level t,
      because this level adds noise too
    betas: your function returns beta, the fraction of the power that each level
      removes. Return the product of the factors 1 - beta of levels 0 to t instead
    beta-of-the-start: your code computes beta as f(t) - f(t + 1). Divide this
      difference by f(t), because beta is the fraction of the remaining power that level
      t removes
    betas-added: your code adds the values of beta and subtracts their sum from 1.
      Multiply the factors 1 - beta instead, because each level removes the fraction
      beta of the remaining power
    offset-outside: your code divides only the offset 0.008 by 1.008. Divide the whole
      sum t / T + 0.008 by 1.008 instead
    abar-limited: your code limits abar to at least 0.001. Limit beta to at most 0.999
      instead, and then multiply the factors 1 - beta
    ratio-inverted: your code uses f(t) / f(t + 1) as 1 - beta, so this factor is above
      1. Use f(t + 1) / f(t) instead, because the data's power falls from f(t) to f(t +
      1) at level t
    always-at-limit: your code sets beta to 0.999 at every level. Use the smaller of
      0.999 and 1 - f(t + 1) / f(t) instead
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
