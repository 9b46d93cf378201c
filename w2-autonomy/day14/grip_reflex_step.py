"""14.1 `grip_reflex_step`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar
from robo47.grasp import cone_margin
from robo47.policy import HIGH, LOW

from .touched import UP, contacts


def apart(finger_position, force, normal, mu, fraction, step):
    """Return whether no contact is on the line, nor the opening on its limit."""
    units = np.abs(np.linalg.norm(normal, axis=1) - 1) < 1e-9
    if not (units.all() and np.isfinite(force).all() and np.any(force)):
        return False
    press = np.sum(force * normal, axis=1)
    margin = cone_margin(force, normal, mu)
    on_the_line = np.abs(margin - fraction * mu * press) < 1e-6 * np.abs(force).max()
    return not on_the_line.any() and finger_position > LOW[4]


row = Row(Scalar(unit="m", scale=0.01), at_edge=apart)


def near(rng, n, fraction, by, size=1.0):
    """Return n contacts, the one that slips most `by` beside the line, of its press."""
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
    exactly = np.array([[2.0, 0, 8]]), UP[None], np.array([0.5])  # half is left
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


@row.wrongs
def _(finger_position, force, normal, mu, fraction, step):
    """opens: it opens by a step; a cube that nearly slips has to be squeezed more
    opens-again: where nothing slips it opens by a step; the opening stays as it is then
    all-must-slip: it closes only when all contacts nearly slip; one is enough
    at-the-line: a margin that is as large as its fraction closes, too; only a smaller
      one does
    one-minus-the-share: the margin is compared with 1 - fraction of mu f_n; fraction is
      what is to be left
    high-for-low: it stops at HIGH[4], so it opens; the limit is LOW[4]
    smaller-for-larger: it takes the smaller of the two, so that it ends at LOW[4] or
      beyond => with min for max
    always: it closes every time, slipping or not
    never: it never closes
    share-without-mu: the margin is compared with a fraction of f_n; asked is one of mu
      f_n
    share-in-newtons: the margin is compared with the fraction itself, in newtons; asked
      is a fraction of mu f_n
    share-of-the-force: the margin is compared with a fraction of the force's length
    not-stopped: it closes beyond LOW[4]; the hand can close no further
    stopped-at-0: it stops at 0; the pads can be told as little as LOW[4]
    stopped-too-early: a step that would go beyond LOW[4] is not made at all; it ends at
      LOW[4]
    outside-only: it closes only where the margin is below 0: then it slips already
    the-other-way: it closes where the margin is large
    closes-to-the-limit: it closes at once as far as it can; by one step each time
    only-the-step: it returns the step alone, not the opening after it
    in-proportion: it closes by a part of the opening; a step is in metres
    a-step-a-contact: it closes by a step for each contact that slips; by one in all
    sum-of-margins: all margins are added up; one that nearly slips is enough
    mean-of-margins: the mean margin is compared with the mean of mu f_n; one that
      nearly slips is enough
    first-contact: it looks at the first contact alone
    last-contact: it looks at the last contact alone
    """
    margin = cone_margin(force, normal, mu)
    press = np.sum(force * normal, axis=1)
    slips = margin < fraction * mu * press

    def closed(when, to=None):
        return max(finger_position - step, LOW[4]) if when else finger_position

    return {
        "opens": finger_position + step if slips.any() else finger_position,
        "opens-again": closed(True) if slips.any() else finger_position + step,
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
        "never": finger_position,
        "share-without-mu": closed(np.any(margin < fraction * press)),
        "share-in-newtons": closed(np.any(margin < fraction)),
        "share-of-the-force": closed(
            np.any(margin < fraction * np.linalg.norm(force, axis=1))
        ),
        "not-stopped": finger_position - step if slips.any() else finger_position,
        "stopped-at-0": max(finger_position - step, 0.0)
        if slips.any()
        else finger_position,
        "stopped-too-early": closed(slips.any() and finger_position - step >= LOW[4]),
        "outside-only": closed(np.any(margin < 0)),
        "the-other-way": closed(np.any(margin > fraction * mu * press)),
        "closes-to-the-limit": LOW[4] if slips.any() else finger_position,
        "only-the-step": step if slips.any() else finger_position,
        "in-proportion": finger_position * (1 - step)
        if slips.any()
        else finger_position,
        "a-step-a-contact": max(finger_position - slips.sum() * step, LOW[4]),
        "sum-of-margins": closed(margin.sum() < fraction),
        "mean-of-margins": closed(margin.mean() < fraction * np.mean(mu * press)),
        "first-contact": closed(slips[0]),
        "last-contact": closed(slips[-1]),
    }


row.at_least_0(mu="friction", fraction="a fraction", step="a step is")


@row.right  # The ratio of what pulls and what could be held, contact by contact.
def _(finger_position, force, normal, mu, fraction, step):
    for f, n, m in zip(force, normal, mu, strict=True):
        press = f @ n
        if np.linalg.norm(f - press * n) > (1 - fraction) * m * press:
            return float(np.clip(finger_position - step, -0.02, None))
    return finger_position


row.spans(  # as small, or as large, as in the lab
    finger_position=(2e-05,),
)
