"""14.1 `grip_reflex_step`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar
from robo47.grasp import cone_margin
from robo47.policy import HIGH, LOW

from .touched import UP, contacts


def apart(finger_position, force, normal, mu, fraction, step):
    """Return whether no margin is exactly at its limit, nor the position at LOW[4]."""
    units = np.abs(np.linalg.norm(normal, axis=1) - 1) < 1e-9
    if not (units.all() and np.isfinite(force).all() and np.any(force)):
        return False
    press = np.sum(force * normal, axis=1)
    margin = cone_margin(force, normal, mu)
    on_the_line = np.abs(margin - fraction * mu * press) < 1e-6 * np.abs(force).max()
    return not on_the_line.any() and finger_position > LOW[4]


row = Row(Scalar(unit="m", scale=0.01), at_edge=apart)


def near(rng, n, fraction, by, size=1.0):
    """Return n contacts; the smallest margin is fraction + `by` of its mu f_n."""
    normal = rng.units(n)
    mu = rng.numbers(0.3, 1.4, n)
    press = size * rng.numbers(2, 6, n)
    left = np.full(n, fraction + 0.3)
    left[rng.integers(n)] = fraction + by
    aside = np.cross(normal, rng.units(n))
    aside = aside / np.maximum(np.linalg.norm(aside, axis=1), 1e-9)[:, None]
    along = (1 - left) * mu * press
    return press[:, None] * normal + along[:, None] * aside, normal, mu


@row.inputs
def _(rng):
    case = np.array([[3.0, 4, 10]]), UP[None], np.array([0.6])
    yield 0.01, *case, 0.2, 0.002
    yield 0.01, *case, 0.1, 0.002
    yield -0.019, *case, 0.2, 0.002
    pull = np.array([[0.0, 0, 5], [0, 0, -1]]), np.tile(UP, (2, 1)), np.array([0.6] * 2)
    yield 0.01, *pull, 0.2, 0.002
    exactly = (
        np.array([[2.0, 0, 8]]),
        UP[None],
        np.array([0.5]),
    )  # half of mu f_n is left
    yield 0.01, *exactly, 0.5, 0.002
    still = np.array([[0.0, 0, 5], [0.1, 0, 4]]), np.tile(UP, (2, 1)), np.full(2, 0.6)
    yield 0.012, *still, 0.3, 0.003
    yield -0.018, *still, 0.3, 0.003
    for fraction, by, size in (
        (0.2, -0.05, 1.0),
        (0.2, 0.05, 1.0),
        (0.3, -0.05, 0.01),
        (0.3, 0.05, 0.01),
        (0.3, -0.02, 100.0),
        (0.3, 0.02, 100.0),
        (0.6, -0.05, 1.0),
        (0.6, 0.05, 1.0),
        (0.05, -0.5, 1.0),
        (0.05, 0.05, 100.0),
        (0.4, -0.02, 1.0),
        (0.4, 0.02, 1.0),
    ):
        finger_position = float(rng.numbers(-0.01, 0.02))
        yield finger_position, *near(rng, 4, fraction, by, size), fraction, 0.002
    for n in (2, 4, 6, 3, 5, 3):
        finger_position = float(rng.numbers(-0.015, 0.02))
        if n in (3, 4):
            finger_position = float(rng.numbers(-0.019, -0.018))
        yield finger_position, *contacts(rng, n), float(rng.numbers(0.1, 0.5)), 0.003


@row.wrongs(
    hidden={
        "at-the-line": "no margin of the lab is exactly at the limit",
        "share-of-f_t": "near the limit, |f_t| is nearly mu f_n",
    }
)
def _(finger_position, force, normal, mu, fraction, step):
    """all-must-slip: your code closes the pads only if all contacts nearly slip. Close
      the pads if at least one contact nearly slips
    at-the-line: your code also closes the pads if a margin is equal to `fraction * mu *
      f_n`. Close the pads only if a margin is below this value
    one-minus-the-share: your code closes the pads if the margin is below `(1 -
      fraction) * mu * f_n`, which means that |f_t| is above `fraction * mu * f_n`.
      Compare the margin with `fraction * mu * f_n` instead
    high-for-low: if a contact nearly slips, your code returns at least `HIGH[4]`, so
      the pads open. Use `LOW[4]` as the limit instead
    smaller-for-larger: your code returns the smaller of the new position and `LOW[4]`.
      Return the larger of the two instead
    always: your code closes the pads in every call. Close the pads only if a contact
      nearly slips
    share-in-newtons: your code compares the margin with `fraction`. Compare the margin
      with `fraction * mu * f_n` instead, because the margin is in newtons
    share-of-the-force: your code compares the margin with `fraction` times the norm of
      the force. Compare the margin with `fraction * mu * f_n` instead
    share-of-the-force 2: your code uses the norm of the force as f_n in `fraction * mu
      * f_n`. Use the component of the force along the normal instead
    share-of-f_n: your code compares the margin with `fraction * f_n`. Compare it with
      `fraction * mu * f_n` instead, because mu f_n is the largest possible margin
    share-of-f_t: your code compares the margin with `fraction * |f_t|`. Compare it with
      `fraction * mu * f_n` instead
    stopped-at-0: your code clamps the finger position at 0. Clamp it at `LOW[4]`
      instead
    stopped-too-early: your code omits a step that would go beyond `LOW[4]`. End this
      step at `LOW[4]` instead
    outside-only: your code closes the pads only if a margin is below 0, where the
      contact already slips. Close the pads if a margin is below `fraction * mu * f_n`
    the-other-way: your code closes the pads if a margin is above `fraction * mu * f_n`.
      Close the pads if a margin is below this value
    closes-to-the-limit: your code moves the pads to their closed limit in a single
      call. Subtract only one `step` from the finger position in each call
    a-step-a-contact: your code subtracts one step for each contact that nearly slips.
      Subtract only one step in each call
    sum-of-margins: your code compares the sum of the margins with `fraction`. Compare
      each margin with its own `fraction * mu * f_n` instead
    mean-of-margins: your code compares the mean of the margins with the mean of
      `fraction * mu * f_n`. Compare each margin with its own `fraction * mu * f_n`
      instead
    """
    margin = cone_margin(force, normal, mu)
    press = np.sum(force * normal, axis=1)
    slips = margin < fraction * mu * press

    def closed(when):
        return max(finger_position - step, LOW[4]) if when else finger_position

    return {
        "all-must-slip": closed(slips.all()),
        "at-the-line": closed(np.any(margin <= fraction * mu * press)),
        "one-minus-the-share": closed(np.any(margin < (1 - fraction) * mu * press)),
        "high-for-low": max(finger_position - step, HIGH[4])
        if slips.any()
        else finger_position,
        "smaller-for-larger": min(finger_position - step, LOW[4])
        if slips.any()
        else finger_position,
        "always": closed(True),
        "share-in-newtons": closed(np.any(margin < fraction)),
        "share-of-the-force": closed(
            np.any(margin < fraction * np.linalg.norm(force, axis=1))
        ),
        "share-of-the-force 2": closed(
            np.any(margin < fraction * mu * np.linalg.norm(force, axis=1))
        ),
        "share-of-f_n": closed(np.any(margin < fraction * press)),
        "share-of-f_t": closed(np.any(margin < fraction * (mu * press - margin))),
        "stopped-at-0": max(finger_position - step, 0.0)
        if slips.any()
        else finger_position,
        "stopped-too-early": closed(slips.any() and finger_position - step >= LOW[4]),
        "outside-only": closed(np.any(margin < 0)),
        "the-other-way": closed(np.any(margin > fraction * mu * press)),
        "closes-to-the-limit": LOW[4] if slips.any() else finger_position,
        "a-step-a-contact": max(finger_position - slips.sum() * step, LOW[4]),
        "sum-of-margins": closed(margin.sum() < fraction),
        "mean-of-margins": closed(margin.mean() < fraction * np.mean(mu * press)),
    }


row.at_least_0(mu="friction", fraction="a fraction", step="a step is")


@row.right  # The tangential force over mu f_n, contact by contact.
def _(finger_position, force, normal, mu, fraction, step):
    for f, n, m in zip(force, normal, mu, strict=True):
        press = f @ n
        if np.linalg.norm(f - press * n) > (1 - fraction) * m * press:
            return float(np.clip(finger_position - step, -0.02, None))
    return finger_position


row.spans(  # as small, or as large, as in the lab
    finger_position=(2e-05,),
)
