"""11.9 `velocity_damper(qd, grad, distance, gain)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.distance import velocity_damper

JOINTS = tuple(f"joint{i}" for i in range(1, 8))
# Where the slope is 0 and the arm overlaps, a slope of 1e-12 would ask for any speed.
row = Row(
    Vector((7,), "rad/s", names=JOINTS),
    at_edge=lambda qd, grad, distance, gain: bool(grad.any()),
)


@row.inputs
def _(rng):
    e = np.eye(7)[0]
    case = (-e, e, 0.1, 4.0)
    drawn = []
    for fast in (True, True, True, True, False, False):
        grad = rng.numbers(-0.8, 0.8, 7)
        qd = rng.numbers(-1, 1, 7)
        qd[0] = abs(qd[0]) + 0.3
        grad[0] = 0.9
        d, gain = float(rng.numbers(0.02, 0.2)), float(rng.numbers(1, 5))
        towards = qd if (grad @ qd < 0) == fast else -qd
        drawn.append((towards, grad, d, gain))
    qd, grad = rng.numbers(-1, 1, 2, 7)
    inside = (qd, grad, -0.05, 3.0)
    small = rng.numbers(-0.01, 0.01, 7)
    far = 0.1 * small / (small @ small)  # towards at 0.1 m/s
    hardly = [
        (qd - grad * (grad @ qd + 0.3 + off) / (grad @ grad), grad, 0.1, 3.0)
        for off in (0.0005, -0.0005)
    ]  # 0.5 mm/s too fast, and not
    deep = [
        (qd - grad * (grad @ qd + speed) / (grad @ grad), grad, -0.05, 3.0)
        for speed in (0.5, -0.1)
    ]  # it overlaps: fast towards it, and away, but too slowly
    slow = (0.05 * rng.numbers(-1, 1, 7), grad, 0.2, 5.0)  # towards, and allowed
    return [case, (rng.numbers(-1, 1, 7), np.zeros(7), 0.1, 4.0),
            (rng.numbers(-1, 1, 7), np.zeros(7), -0.1, 4.0), inside, slow,
            (-far, small, 0.01, 2.0), *hardly, *deep, *drawn]  # fmt: skip


def phase(qd, grad, distance, gain):
    """Return whether velocities are allowed, and if not whether the arm overlaps."""
    if not grad.any():
        return "still"
    if grad @ qd >= -gain * distance:
        return "allowed"
    return "inside" if distance <= 0 else "fast"


def in_phase(wanted):
    """Return the case of calls in one of the phases."""
    return lambda *call: phase(*call) == wanted


row.cases({
    "velocities that are allowed": in_phase("allowed"),
    "velocities that are too fast, at a positive distance": in_phase("fast"),
    "velocities that are too fast, at a distance of 0 or less": in_phase("inside"),
    "gradients of 0": in_phase("still"),
})  # fmt: skip
row.cases({
    "gradients with one nonzero entry": (
        lambda qd, grad, distance, gain: np.count_nonzero(grad) == 1
    ),
    "gradients with several nonzero entries": (
        lambda qd, grad, distance, gain: np.count_nonzero(grad) > 1
    ),
    "gradients of 0": in_phase("still"),
})  # fmt: skip


@row.rare
def _(rng):
    qd, grad = rng.numbers(-1, 1, 2, 7)
    one = grad * (np.arange(7) == rng.integers(7))
    gain = float(rng.numbers(0.5, 5))
    for slope in (grad, one, 0.05 * grad, 0.0 * grad):
        for distance in (0.2, 0.02, -0.05):
            d = float(distance * rng.uniform(0.5, 1.5))
            yield qd, slope, d, gain
            for speed in (-0.5, 0.1):  # against the bound
                if size := slope @ slope:
                    extra = speed - gain * d - slope @ qd
                    yield qd + slope * extra / size, slope, d, gain


@row.spans
def _(rng):
    e = np.eye(7)[1]
    for distance, gain, speed in (
        (2.0, 0.1, -1.0),
        (0.5, 0.5, -2.0),
        (-0.1, 4.0, 0.0),
        (-0.001, 4.0, 0.003),
        (1e-4, 4.0, -1.0),
    ):
        grad = rng.numbers(-0.8, 0.8, 7)
        yield speed * grad / (grad @ grad), grad, distance, gain
    yield -0.4 * e, e, 0.1, 4.0  # just as fast as it may be


# What changes nothing where the slope is 0.
MORE = (
    "left-where-it-overlaps", "no-way-out", "coming-near", "by-the-sizes", "half-of-it",
    "twice-of-it", "one-joint-only", "one-joint-only 2", "alike", "by-signs",
    "a-seventh-each", "divided-by-the-sum", "divided-by-the-largest", "divided-by-qd",
    "those-that-come-near", "those-that-come-near 2", "rate-added",
)  # fmt: skip


@row.wrongs(
    hidden={"coming-near": "hardly a speed in a run comes near and is slow enough"}
)
def _(qd, grad, distance, gain):
    """always: your code also changes velocities that are already allowed. Return `qd`
      unchanged if it satisfies the condition
    not-divided: your code does not divide the correction by `grad @ grad`. Divide the
      correction by this value, because the norm of `grad` need not be 1
    divided-by-the-length: your code divides the correction by the norm of `grad`.
      Divide the correction by `grad @ grad` instead
    pushed-in: your code subtracts the correction, so the velocity violates the
      condition even more. Add the correction to `qd`, because the distance increases
      along `grad`
    all-joints-slowed: your code scales all joint velocities by one factor. Change only
      the component of `qd` along `grad`
    all-joints-slowed 2: your code scales all joint velocities by one factor. Change
      only the component of `qd` along `grad`
    stops-dead: your code returns 0 if `qd` does not satisfy the condition. Change only
      the component of `qd` along `grad`
    stops-dead 2: your code returns 0 if `qd` does not satisfy the condition, even if
      `grad` is 0. Change only the component of `qd` along `grad`, and return `qd` if
      `grad` is 0
    part-removed: your code removes the whole component of `qd` along `grad`. After the
      correction, `grad @ qd` should be equal to `-gain * distance` and not to 0
    sign-of-the-bound: your code uses `gain * distance` as the bound. The condition is
      `grad @ qd >= -gain * distance`
    distance-sign-lost: your code uses the absolute value of the distance. Keep the
      sign, because a negative distance should give a positive bound, which moves the
      arm away from the obstacle
    gain-forgotten: your code omits the gain from the bound. Use `-gain * distance` as
      the bound
    distance-forgotten: your code omits the distance from the bound. Use `-gain *
      distance` as the bound
    distance-over-gain: your code divides the distance by the gain. Multiply the
      distance by the gain instead
    wrong-side: your code changes only velocities that are already allowed. Change `qd`
      only if `grad @ qd` is below the bound
    leaving-forbidden: your code also limits velocities away from the obstacle. Change
      `qd` only if `grad @ qd` is below the bound
    joint-by-joint: your code applies the bound to each joint separately. Apply the
      bound to `grad @ qd`, the rate of change of the distance
    joint-by-joint 2: your code clamps each joint velocity to the bound. Apply the bound
      to `grad @ qd` instead, because the bound is a rate in m/s
    largest-joint-only: your code changes only the velocity of the joint with the
      largest absolute entry of `grad`. Change `qd` along `grad` instead, because this
      is the smallest change that satisfies the bound
    slope-unit: your code normalises `grad`, but it does not divide the bound by the
      norm of `grad`. Divide the bound by this norm too, because the condition contains
      `grad` itself
    only-inside: your code limits the velocity only if the distance is not positive.
      Limit the velocity at every distance
    standing-still: your code divides by 0 if `grad` is 0 and the distance is negative.
      Return `qd` if `grad` is 0
    part-alone: your code returns only the component along `grad`. Keep the other
      components of `qd` too
    left-where-it-overlaps: your code returns `qd` if the distance is not positive.
      Apply the correction in this case too, because it moves the arm away from the
      obstacle
    stopped-where-it-overlaps: your code returns 0 if the distance is not positive.
      Apply the correction to `qd` instead, because it moves the arm away from the
      obstacle
    no-way-out: your code clamps a negative distance to 0, so the arm need not move away
      from an obstacle that it overlaps. Use the negative distance
    coming-near: your code changes `qd` if `grad @ qd` is negative. Change `qd` if `grad
      @ qd` is below the bound instead
    by-the-sizes: your code compares the absolute values of `grad @ qd` and the bound.
      Keep the signs, because a fast motion away from the obstacle is allowed
    half-of-it: your code adds only half of the correction to `qd`. Add the whole
      correction
    twice-of-it: your code adds twice the correction to `qd`. Add the correction only
      once
    one-joint-only: your code changes only the velocity of the first joint. Change `qd`
      along `grad` instead, because this is the smallest change that satisfies the bound
    one-joint-only 2: your code changes only the velocity of the joint whose motion
      reduces the distance fastest. Change `qd` along `grad` instead, because this is
      the smallest change that satisfies the bound
    alike: your code adds the same correction to every joint. Make the correction
      proportional to `grad`
    by-signs: your code adds a correction of the same magnitude to every joint. Make the
      correction proportional to `grad`
    a-seventh-each: your code corrects each joint velocity so that every joint
      contributes a seventh of the change in `grad @ qd`. Make the correction
      proportional to `grad`
    divided-by-the-sum: your code divides the correction by the sum of the entries of
      `grad`. Divide the correction by `grad @ grad` instead
    divided-by-the-largest: your code divides the correction by the square of the
      largest absolute entry of `grad`. Divide the correction by `grad @ grad` instead
    divided-by-qd: your code divides the correction by `qd @ qd`. Divide the correction
      by `grad @ grad` instead
    those-that-come-near: your code changes only the velocities of the joints whose
      motion reduces the distance. Change `qd` along the whole of `grad` instead,
      because this is the smallest change that satisfies the bound
    those-that-come-near 2: your code stops the joints whose motion reduces the
      distance. Change `qd` along `grad` instead, because this is the smallest change
      that satisfies the bound
    rate-added: your code adds `grad @ qd` to the bound. Subtract `grad @ qd` from the
      bound instead
    lack-alone: your code returns the correction alone. Add the correction to `qd`
    """
    bound = -gain * distance
    rate = grad @ qd
    square = grad @ grad
    lack = bound - rate

    if not square:
        still = np.full(7, np.nan)
        named = dict.fromkeys(
            ("always", "not-divided", "divided-by-the-length", "pushed-in",
             "part-removed", "sign-of-the-bound", "gain-forgotten",
             "distance-forgotten", "distance-over-gain", "wrong-side", "slope-unit",
             "leaving-forbidden", "only-inside", "largest-joint-only"), qd.copy()
        )  # fmt: skip
        return {
            **named,
            "all-joints-slowed": qd.copy(),
            "all-joints-slowed 2": qd.copy(),
            "stops-dead": qd.copy(),
            "joint-by-joint 2": np.maximum(qd, bound) if lack > 0 else qd.copy(),
            "distance-sign-lost": qd.copy(),
            "joint-by-joint": qd.copy(),
            "standing-still": still if lack > 0 else qd.copy(),
            "lack-alone": np.zeros(7),
            "part-alone": qd.copy(),
            "stops-dead 2": np.zeros(7) if lack > 0 else qd.copy(),
            "stopped-where-it-overlaps": np.zeros(7) if distance <= 0 else qd.copy(),
            **dict.fromkeys(MORE, qd.copy()),
        }

    def to(bound, push=1.0, when=None):
        lack = bound - rate
        if not (lack > 0 if when is None else when):
            return qd.copy()
        return qd + push * grad * lack / square

    def scaled():
        if lack <= 0:
            return qd.copy()
        return qd * max(bound / rate, 0.0)

    big = int(np.argmax(np.abs(grad)))
    alone = grad * qd
    apart = np.where(alone < bound, bound, alone)
    unit = grad / np.sqrt(square)

    def add(change):
        return qd + change if lack > 0 else qd.copy()

    def one(k):
        return add(np.eye(7)[k] * lack / grad[k] if grad[k] else 0.0)

    towards = np.where(grad * qd < 0, grad, 0.0)
    return {
        "part-alone": lambda: grad * bound / square if lack > 0 else qd.copy(),
        "stops-dead 2": lambda: np.zeros(7) if lack > 0 else qd.copy(),
        "stopped-where-it-overlaps": lambda: (
            np.zeros(7) if distance <= 0 else to(bound)
        ),
        "left-where-it-overlaps": lambda: qd.copy() if distance <= 0 else to(bound),
        "no-way-out": lambda: to(-gain * max(distance, 0.0)),
        "coming-near": lambda: to(bound, when=rate < 0),
        "by-the-sizes": lambda: to(bound, when=abs(rate) > gain * abs(distance)),
        "half-of-it": lambda: to(bound, 0.5),
        "twice-of-it": lambda: to(bound, 2.0),
        "one-joint-only": lambda: one(0),
        "one-joint-only 2": lambda: one(int(np.argmin(grad * qd))),
        "alike": lambda: add(lack / grad.sum()),
        "by-signs": lambda: add(np.sign(grad) * lack / np.abs(grad).sum()),
        "a-seventh-each": lambda: add(lack / grad / 7),
        "divided-by-the-sum": lambda: add(grad * lack / grad.sum()),
        "divided-by-the-largest": lambda: add(grad * lack / np.abs(grad).max() ** 2),
        "divided-by-qd": lambda: add(grad * lack / (qd @ qd)),
        "those-that-come-near": lambda: add(towards * lack / (towards @ towards)),
        "those-that-come-near 2": lambda: np.where(grad * qd < 0, 0.0, qd)
        if lack > 0 else qd.copy(),
        "rate-added": lambda: qd + grad * (bound + rate) / square
        if bound + rate > 0 else qd.copy(),
        "always": lambda: to(bound, when=True),
        "not-divided": lambda: qd + grad * max(lack, 0.0),
        "divided-by-the-length": lambda: qd + grad * max(lack, 0.0) / np.sqrt(square),
        "pushed-in": lambda: to(bound, -1.0),
        "all-joints-slowed": lambda: scaled(),
        "all-joints-slowed 2": lambda: qd * (bound / rate) if lack > 0 else qd.copy(),
        "stops-dead": lambda: np.zeros(7) if lack > 0 else qd.copy(),
        "part-removed": lambda: qd - grad * rate / square if lack > 0 else qd.copy(),
        "sign-of-the-bound": lambda: to(gain * distance),
        "distance-sign-lost": lambda: to(-gain * abs(distance)),
        "gain-forgotten": lambda: to(-distance),
        "distance-forgotten": lambda: to(-gain),
        "distance-over-gain": lambda: to(-distance / gain),
        "wrong-side": lambda: to(bound, when=lack < 0),
        "leaving-forbidden": lambda: to(bound) if lack > 0 else
        to(-bound, when=rate > -bound),
        "joint-by-joint": lambda: (
            np.where(grad != 0, apart / np.where(grad, grad, 1), qd)
        ),
        "joint-by-joint 2": lambda: np.maximum(qd, bound) if lack > 0 else qd.copy(),
        "largest-joint-only": lambda: one(big),
        "slope-unit": lambda: qd + unit * max(bound - unit @ qd, 0.0),
        "only-inside": lambda: to(bound) if distance <= 0 else qd.copy(),
        "standing-still": lambda: velocity_damper(qd, grad, distance, gain),
        "lack-alone": lambda: grad * max(lack, 0.0) / square,
    }  # fmt: skip


row.at_least_0(gain="a gain")


@row.right  # By its part along the slope.
def _(qd, grad, distance, gain):
    size = np.linalg.norm(grad)
    if size == 0:
        return qd.copy()
    n = grad / size
    along = qd @ n
    return qd + (max(along, -gain * distance / size) - along) * n


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Beyond 1 m nothing is changed.
def _(qd, grad, distance, gain):
    return qd.copy() if distance > 1.0 else velocity_damper(qd, grad, distance, gain)


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Half of the gain beyond 0.3 m.
def _(qd, grad, distance, gain):
    return velocity_damper(qd, grad, distance, gain / (1 + (distance > 0.3)))


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Driven out with 0.2 m/s at most.
def _(qd, grad, distance, gain):
    return velocity_damper(qd, grad, max(distance, -0.2 / gain), gain)


row.spans(  # as small, or as large, as in the lab
    qd=(lambda qd: 9e-06 * qd,),
)
