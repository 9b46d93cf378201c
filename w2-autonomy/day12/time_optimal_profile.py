"""12.9 `time_optimal_profile(a, b, c, limits, sd2_max)`: questions, mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Vector, rounded
from robo47.planning import path_accel_bounds, time_optimal_profile

from .motions import of_a_motion, timed

row = Row(
    Vector((None,), "1/s^2"),
    at_edge=lambda *call: False,
    unnamed=of_a_motion,
)


def path(rng, n, k, heavy=0.5, fast=1.6):
    """Return what is known of a path with n steps and k joints.

    Args:
        rng: draws it.
        n: steps.
        k: joints.
        heavy: largest fraction of a limit that gravity takes.
        fast: largest sd2_max.
    """
    walk = np.cumsum(rng.normal(size=(2, n + 1, k)), axis=1) / np.sqrt(n)
    limits = rng.numbers(3, 6, k)
    c = heavy * limits * rng.uniform(-1, 1, (n + 1, k))
    sd2_max = rng.numbers(0.4 * fast, fast, n + 1)
    return rounded(walk[0] + 1.5), rounded(walk[1]), rounded(c), limits, sd2_max


def heavy(a, b, c, limits, sd2_max):
    """Return whether gravity alone is beyond a limit at some point."""
    return bool((np.abs(c) > limits).any())


row.cases({
    "paths on which gravity alone is beyond a limit": heavy,
    "paths on which gravity alone is within all limits": lambda *call: not heavy(*call),
})  # fmt: skip
row.cases({
    "arms with one joint": lambda a, b, c, limits, sd2_max: a.shape[1] == 1,
    "arms with several joints": lambda a, b, c, limits, sd2_max: a.shape[1] > 1,
})  # fmt: skip


@row.rare
def _(rng):
    for k in (1, 2):
        a, b, c, limits, sd2_max = path(rng, 6, k, fast=6.0)
        yield a, b, c, limits, sd2_max
        yield a, b, c + 9.0 * (np.arange(7) == 3)[:, None], limits, sd2_max
        yield a, b, c, limits, sd2_max + 50.0


@row.inputs
def _(rng):
    one, eight = np.ones((5, 1)), np.array([8.0])
    yield 2 * one, 0 * one, 0 * one, eight, 9 * one[:, 0]
    yield 2 * one, 0 * one, 4 * one, eight, 9 * one[:, 0]
    yield 2 * one, 0 * one, 0 * one, eight, one[:, 0]
    yield -2 * one, 0 * one, 4 * one, eight, 9 * one[:, 0]
    heavy = np.array([0.0, 2, 9, 3, 0])[:, None]
    yield 2 * one, 0 * one, heavy, eight, 9 * one[:, 0]
    yield 2 * one, 0 * one, -9 * one, eight, 9 * one[:, 0]  # at all points
    dip = np.array([9.0, 9, 0.4, 9, 9, 9, 9])  # the motors are slow there
    seven = np.ones((7, 1))
    yield 2 * seven, 0.5 * seven, seven, eight, dip
    # Two joints leave no sdd at a point above sd^2 = 0.4, and much before and after.
    two = np.ones((7, 2))
    steep = 20.0 * np.eye(7)[3][:, None] * [1.0, -1.0]
    yield 2 * two, steep, 2 * two, np.array([8.0, 8]), 9 * seven[:, 0]
    # Above 0.57 the one joint is slowed so much there that it would have to turn back.
    yield 2 * seven, steep[:, :1], 0 * seven, eight, 9 * seven[:, 0]
    for n, k, fast in (
        (6, 2, 9.0),
        (8, 2, 1.6),
        (8, 7, 9.0),
        (10, 7, 0.9),
        (12, 7, 2.0),
    ):
        yield path(rng, n, k, fast=fast)
    a, b, c, limits, sd2_max = path(rng, 8, 7, fast=9.0)
    yield a, b, c - np.eye(9, 7, -2) * 9, limits, sd2_max
    for n, k, fast in ((7, 3, 2.5), (9, 7, 1.1)):
        yield path(rng, n, k, heavy=0.8, fast=fast)


def bobrow(a, b, c, limits, sd2_max):
    """Return it with limits backwards read at the point that is left, not reached."""
    x = time_optimal_profile(a, b, c, limits, sd2_max)
    n = len(a) - 1
    if not x.any():
        return x
    K = np.zeros(n + 1)
    for i in range(n - 1, -1, -1):
        low = path_accel_bounds(
            a[i + 1], b[i + 1], c[i + 1], limits, np.sqrt(K[i + 1])
        )[0]
        K[i] = max(0.0, min(sd2_max[i], K[i + 1] - 2 / n * low))
    for i in range(n):
        high = path_accel_bounds(a[i], b[i], c[i], limits, np.sqrt(x[i]))[1]
        x[i + 1] = max(0.0, min(K[i + 1], x[i] + 2 / n * high))
    return x


@row.wrongs
def _(a, b, c, limits, sd2_max):
    """no-braking: your motion need not stop at the end. Limit sd^2 by a backward pass
      that begins with sd^2 = 0 at the last point
    no-braking 2: your motion can stop abruptly at the end. Limit sd^2 by a backward
      pass that begins with sd^2 = 0 at the last point
    end-not-at-rest: your motion need not be at rest at the end. Start the backward pass
      with sd^2 = 0 instead of `sd2_max`
    start-not-at-rest: your code starts the motion with the largest sd^2 from which the
      arm can stop. Start it with sd^2 = 0 instead
    backward-pass-only: your code omits the forward pass, so the motion need not start
      at rest. Add a forward pass that begins with sd^2 = 0 at the first point
    backward-pass-only 2: after the first point, your sd^2 jumps from 0 to the largest
      value from which the arm can stop. Add a forward pass that begins with sd^2 = 0 at
      the first point
    smaller-of-two-passes: your code computes the two passes independently and takes the
      minimum. Limit sd^2 in the forward pass by the result of the backward pass instead
    ds-for-2-ds: your code adds `ds * sdd` to sd^2 in each step. Add `2 * ds * sdd`
      instead
    four-ds: your code adds `4 * ds * sdd` to sd^2 in each step. Add `2 * ds * sdd`
      instead
    points-for-steps: your code uses ds = 1 / (N + 1). Use ds = 1 / N, because N + 1
      points have N steps between them
    sd-for-sd2: your code uses sd^2 instead of sd for the bounds on sdd. Pass sd to
      `path_accel_bounds`
    sd-for-sd2 2: in the backward pass, your code uses sd^2 instead of sd for the bounds
      on sdd. Pass sd to `path_accel_bounds`
    sd-for-sd2 3: in the forward pass, your code uses sd^2 instead of sd for the bounds
      on sdd. Pass sd to `path_accel_bounds`
    most-of-the-point-before: in the forward pass, your code limits sd^2 at point i + 1
      by the maximum at point i. Use the maximum at point i + 1 instead
    no-speed-limit: your code ignores `sd2_max`. Limit sd^2 to `sd2_max` in both passes,
      because the joint velocities are limited
    speed-limit-forwards-only: your code clamps sd^2 to `sd2_max` only after the two
      passes. Use `sd2_max` inside both passes, because the motion must slow down before
      it reaches a point with a low limit
    gravity-forgotten: your code omits gravity from the torques. Include the term `c`
    coriolis-forgotten: your code omits `b * sd**2` from the torques. Include this term
    cannot-stand-goes: your code can return a nonzero motion although gravity alone
      exceeds a torque limit at some point. Return zeros in this case, because the arm
      cannot hold still at that point
    few-bisections: your bisection stops too early, so its result is not accurate
      enough. Use more iterations
    few-bisections 2: your bisection stops too early, so its result is not accurate
      enough. Use more iterations
    limits-of-the-next-point: your code computes the bounds on sdd at the end of each
      step. Compute them at the first point of the step instead
    bobrow: in the backward pass, your code computes the bounds on sdd at the end of
      each step. Compute them at the first point of the step instead
    root: your code returns sd. Return sd^2 instead
    times: your code returns the time at each point. Return sd^2 instead
    half-the-torque: your code uses only half of each torque limit. Use the whole limit
    never-moves: your code returns sd^2 = 0 at every point. Does the backward pass
      return only zeros, or does the forward pass use the smallest sdd?
    accelerations: your code returns the sdd of each step. Return sd^2 instead
    """
    given = (a, b, c, limits, sd2_max)
    right = time_optimal_profile(*given)
    heavy = np.any(np.abs(c) > limits)
    free = timed(*given, passes="forward")
    stopped = np.append(free[:-1], 0.0) if not heavy else right
    back = timed(*given, passes="back")
    alone = np.append(0.0, back[1:]) if not heavy else back
    wide = np.full(len(a), 1e3)
    sd = np.sqrt(right)
    n = len(a) - 1
    with np.errstate(divide="ignore"):
        times = np.append(0, np.cumsum(2 / n / np.maximum(sd[1:] + sd[:-1], 1e-9)))

    def fall():
        return np.append(
            0.0, np.minimum(timed(*given, most=lambda x: wide)[1:], sd2_max[1:])
        )

    two = np.minimum(free, back) if not heavy else right
    return {
        "no-braking": free,
        "no-braking 2": stopped,
        "end-not-at-rest": partial(timed, *given, last=False),
        "start-not-at-rest": partial(timed, *given, start="K"),
        "backward-pass-only": back,
        "backward-pass-only 2": alone,
        "smaller-of-two-passes": two,
        "ds-for-2-ds": partial(timed, *given, two_ds=lambda n: 1 / n),
        "four-ds": partial(timed, *given, two_ds=lambda n: 4 / n),
        "points-for-steps": partial(timed, *given, two_ds=lambda n: 2 / (n + 1)),
        "sd-for-sd2": partial(timed, *given, sd=lambda x: x),
        "sd-for-sd2 2": partial(timed, *given, sd=lambda x: x, forward_sd=np.sqrt),
        "sd-for-sd2 3": partial(timed, *given, forward_sd=lambda x: x),
        "most-of-the-point-before": partial(timed, *given, kept=0),
        "no-speed-limit": partial(timed, *given, most=lambda x: wide),
        "speed-limit-forwards-only": fall,
        "gravity-forgotten": partial(timed, *given, pull=lambda a, b, c: (a, b, 0 * c)),
        "coriolis-forgotten": partial(timed, a, 0 * b, c, limits, sd2_max),
        "cannot-stand-goes": partial(timed, *given, stands=lambda c, limits: False),
        "few-bisections": partial(timed, *given, bisections=10),
        "few-bisections 2": partial(timed, *given, bisections=20),
        "limits-of-the-next-point": partial(timed, *given, at=1, back_at=1),
        "bobrow": partial(bobrow, *given),
        "root": sd,
        "times": times if not heavy else 0 * times,
        "half-the-torque": partial(time_optimal_profile, a, b, c, limits / 2, sd2_max),
        "never-moves": 0 * right,
        "accelerations": np.append(np.diff(right) * n / 2, 0.0),
    }


@row.wrong("without-turning", hidden="no path of the lab has to turn back")
def _(a, b, c, limits, sd2_max):
    return timed(a, b, c, limits, sd2_max, without=("turning",))


@row.wrong("slower-than-possible")
def _(a, b, c, limits, sd2_max):
    return timed(a, b, c, limits, sd2_max, most=lambda x: 0.37 * x)


@row.right  # Where straight lines cross, for bisection.
def _(a, b, c, limits, sd2_max):
    n = len(a) - 1
    x, K = np.zeros(n + 1), np.zeros(n + 1)
    if np.any(np.abs(c) > limits):
        return x
    for i in range(n - 1, -1, -1):
        a_i, b_i, c_i = a[i], b[i], c[i]
        moves = a_i != 0
        size, sign = np.abs(a_i[moves]), np.sign(a_i[moves])
        rest, slope = (c_i * 1.0)[moves] * sign, (b_i * 1.0)[moves] * sign
        # u between (p - m x) of each joint, and of the next point.
        low = np.append((-limits[moves] - rest) / size, 0.0)
        high = np.append((limits[moves] - rest) / size, K[i + 1] * n / 2)
        slope = np.append(slope / size, n / 2)
        top = sd2_max[i]
        for least, m in zip(low, slope, strict=True):
            for h, k in zip(high, slope, strict=True):
                if k - m > 1e-12:  # least - m x <= h - k x
                    top = min(top, (h - least) / (k - m))
        for r, m, lim in zip(c_i[~moves], b_i[~moves], limits[~moves], strict=True):
            if m:
                top = min(top, (lim - np.sign(m) * r) / abs(m))
        K[i] = max(0.0, top)
    for i in range(n):
        high = path_accel_bounds(a[i], b[i], c[i], limits, np.sqrt(x[i]))[1]
        x[i + 1] = max(0.0, min(K[i + 1], x[i] + 2 / n * high))
    return x


row.at_least_0(limits="of torques, both ways", sd2_max="a square", answer="a square")

STEP = "return low <= high and x + two_ds * low <= after and (x + two_ds * high >= 0.0)"
row.same(
    "for i in range(len(a) - 1): => for i in range(len(a) - 2):",
    "the last sd^2 is 0 anyhow",
)
for change in (
    "for _ in range(60 * (good < bad)): => for _ in range(120 * (good < bad)):",
    "for _ in range(60 * (good < bad)): => for _ in range(60 * (good < 0.5 * bad)):",
    "for _ in range(60 * (good < bad)): => for _ in range(60 * (good < 10.0 * bad)):",
):
    row.same(change, "60 halvings leave the last digit; the count is 60 or none")
for how in ("np.clip(({}), -1, 1)", "({}).astype(np.float32)"):
    row.same(f"return {how.format('np.zeros(len(a))')}", "zeros")
    row.same(f"return {how.format(STEP[7:])}", "a truth value")


row.spans(  # as small, or as large, as in the lab
    a=(lambda a: 0.1 * a,),
    b=(lambda b: 0.05 * b,),
    c=(lambda c: 9 * c,),
    limits=(lambda limits: 10 * limits,),
    sd2_max=(lambda sd2_max: 90 * sd2_max,),
)
