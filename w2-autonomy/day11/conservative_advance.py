"""11.8 `conservative_advance(s, distance, delta_q, radii)`: questions, mistakes."""

import numpy as np

from labkit.judge import Row, Scalar

row = Row(
    Scalar(),
    at_edge=lambda s, distance, delta_q, radii: distance != 0 or bool(np.any(delta_q)),
)


@row.inputs
def _(rng):
    half = np.full(7, 0.5)
    case = (0.25, 0.1, np.ones(7), half)
    drawn = []
    for deep in (0.1, 0.2, 0.05, 0.3, 0.15, 0.25):
        delta_q = rng.numbers(-1, 1, 7)
        radii = rng.numbers(0.2, 1.2, 7)
        drawn.append((float(rng.numbers(0, 0.6)), float(deep * rng.numbers(0.5, 1)),
                      delta_q, radii))  # fmt: skip
    one = np.zeros(7)
    one[2] = -1.5
    return [
        case, (0.4, 0.2, one, rng.numbers(0.2, 1.2, 7)), (0.95, 0.5, half, half),
        (0.3, 0.1, np.zeros(7), half), (0.3, -0.05, half, half), (0.6, 0.0, half, half),
        (0.0, 3.0, half, half), (0.5, 0.0005, half, half), (0.5, -0.0005, half, half),
        (0.3, -0.05, np.zeros(7), half), (0.4, 0.0, np.zeros(7), half),
        (0.1, 0.02, np.full(7, -0.05), half), (0.3, 0.0001, 0.0002 * half, half),
        (0.1, 0.7, half, half), (0.2, 1.1, 0.9 * np.ones(7), half),  # far, and not free
        (0.3, 2.5, half, half),  # far beyond the end, from within the motion
        *drawn,
    ]  # fmt: skip


def phase(s, distance, delta_q, radii):
    """Return what a check finds: contact, rest, the end of the path, or a step."""
    bound = float(np.abs(delta_q) @ radii)
    if distance <= 0:
        return "contact"
    if bound == 0:
        return "rest"
    return "end" if s + distance / bound >= 1 else "step"


def in_phase(wanted):
    """Return the case of checks that find one of the phases."""
    return lambda *call: phase(*call) == wanted


def signs(*wanted):
    """Return the case of steps in which joints move in these directions."""

    def of(s, distance, delta_q, radii):
        free = phase(s, distance, delta_q, radii) == "step"
        return free and set(np.sign(delta_q[delta_q != 0])) == set(wanted)

    return of


ELSE = {
    "links that touch or overlap": in_phase("contact"),
    "motions of length 0": in_phase("rest"),
    "steps that reach the end of the motion": in_phase("end"),
}
row.cases({"steps that end before the end of the motion": in_phase("step"), **ELSE})
row.cases({
    "steps with positive entries of delta_q only": signs(1),
    "steps with negative entries of delta_q only": signs(-1),
    "steps with entries of delta_q of both signs": signs(1, -1),
    **ELSE,
})  # fmt: skip
row.cases({
    "steps in which one joint moves": (
        lambda *call: phase(*call) == "step" and np.count_nonzero(call[2]) == 1
    ),
    "steps in which several joints move": (
        lambda *call: phase(*call) == "step" and np.count_nonzero(call[2]) > 1
    ),
    **ELSE,
})  # fmt: skip
row.cases({
    "steps with equal radii": (
        lambda *call: phase(*call) == "step" and np.ptp(call[3]) == 0
    ),
    "steps with different radii": (
        lambda *call: phase(*call) == "step" and np.ptp(call[3]) > 0
    ),
    **ELSE,
})  # fmt: skip


@row.rare
def _(rng):
    radii = rng.numbers(0.2, 1.2, 7)
    delta_q = rng.numbers(0.01, 1, 7)
    small = delta_q * rng.choice([1.0, 0.01, 1e-3], 7)
    alone = np.arange(7) == rng.integers(7)
    one = delta_q * alone * rng.choice([4.0, 1.0, 0.005])  # also far beyond a metre
    for turn in (delta_q, -delta_q, delta_q * rng.choice([-1.0, 1.0], 7), small, -small,
                 one, -one, 1e-3 * delta_q, 0.0 * delta_q):  # fmt: skip
        s, share = rng.numbers(0, 0.9, 2)
        for each in (radii, np.full(7, radii[0])):
            bound = float(np.abs(turn) @ each)
            left = (1 - s) * bound
            for distance in (0.999 * share * left, left * (1.1 + 3 * share), 1e-5):
                yield float(s), float(distance or 0.1), turn, each
            yield float(s), float(-0.3 * share), turn, each


@row.wrongs(
    hidden={"still-before-touching": "in a run nothing is still where it touches"}
)
def _(s, distance, delta_q, radii):
    """no-bound: your code adds the distance in metres to s. First divide the distance
      by the bound on the motion per unit of s
    signs-kept: your code keeps the signs of `delta_q` in the sum, so opposite rotations
      cancel. Take the absolute value of each entry first
    signs-kept 2: your code takes the absolute value of the whole sum, so opposite
      rotations cancel. Take the absolute value of each entry of `delta_q` first
    fastest-joint-only: your code uses only the largest product `abs(delta_q[i]) *
      radii[i]`. Add the products of all joints, because the motions of all joints add
      up
    fastest-joint-only 2: your code multiplies the largest `abs(delta_q[i])` by the
      largest radius. Add `abs(delta_q[i]) * radii[i]` over all joints, because their
      motions add up
    norm-of-dq: your code multiplies the norm of `delta_q` by the largest radius, but
      the motion can exceed this product. Add `abs(delta_q[i]) * radii[i]` over all
      joints instead
    norm-of-products: your code takes the norm of the products `abs(delta_q[i]) *
      radii[i]`. Take the sum of the products instead
    norm-of-products 2: your code multiplies the norm of `delta_q` by the norm of
      `radii`. Add the products `abs(delta_q[i]) * radii[i]` instead
    largest-reach: your code uses the largest radius for every joint, so its steps can
      be shorter than necessary. Use the radius of each joint
    reach-forgotten: your code omits `radii`. Multiply each `abs(delta_q[i])` by
      `radii[i]`, because the product bounds the motion in metres
    dq-forgotten: your code omits `delta_q` in the bound. The bound should grow with
      `delta_q`, because a larger joint displacement moves the arm farther
    of-what-is-left: your step contains an extra factor `1 - s`. Omit this factor,
      because `delta_q` is the displacement of the whole motion, from s = 0 to s = 1
    of-what-is-left 2: your step contains an extra factor `1 / (1 - s)`. Use the whole
      `delta_q` for the bound, because the step is a fraction of the whole motion, from
      s = 0 to s = 1
    half-a-step: your code takes only half of the step that the bound allows. Use the
      whole step
    twice-a-step: your code takes twice the step that the bound allows, so the arm can
      hit the obstacle. Divide the distance by the bound itself
    multiplied: your code multiplies the distance by the bound. Divide the distance by
      the bound instead, because a faster motion needs a shorter step
    s-forgotten: your code returns the step alone. Return s plus the step
    not-capped: your code can return a value above 1. Clamp the result at 1, because the
      motion ends at s = 1
    standing-still: your code divides by 0 if no joint moves. Return 1, because the rest
      of the motion is collision-free
    standing-still 2: your code returns s if no joint moves. Return 1, because the rest
      of the motion is collision-free
    goes-back-inside: your code does not test for contact, so a negative distance gives
      a negative step. Return s itself if the distance is 0 or negative
    goes-on-inside: your code can return a value above s if the arm is already in
      contact. Return s itself
    stops-inside: your code returns 1 if the arm is already in contact. Return s itself
    stops-inside 2: your code returns 0 if the arm is already in contact. Return s
      itself
    still-before-touching: if no joint moves, your code returns 1 even if the arm is in
      contact. Return s if the arm is in contact, because the motion is not
      collision-free
    reach-backwards: your code uses `radii` in reverse order. The first radius belongs
      to joint 1
    reaches-summed: your code multiplies the sum of `abs(delta_q)` by the sum of the
      radii. Multiply each `abs(delta_q[i])` by its own radius, and then add the
      products
    reaches-summed 2: your code multiplies the largest `abs(delta_q[i])` by the sum of
      the radii. Multiply each `abs(delta_q[i])` by its own radius, and then add the
      products
    reaches-summed 3: your code multiplies the norm of `delta_q` by the sum of the
      radii. Multiply each `abs(delta_q[i])` by its own radius, and then add the
      products
    one-direction: your code treats negative entries of `delta_q` as 0. Take absolute
      values instead, because rotations in both directions move the arm
    one-left-out: your code omits the last joint from the sum. Add the products of all
      joints
    one-left-out 2: your code omits the first joint from the sum. Add the products of
      all joints
    chord: your code uses the chord `2 * sin(delta_q / 2)`. Use `abs(delta_q)` instead,
      because a point moves along the arc, which is longer than the chord
    mean-of-joints: your code uses the mean of the products over the joints as the
      bound. Use the sum instead, because the motions of all joints add up
    step-capped: your code clamps the step at 1. Clamp the sum of s and the step
      instead, because this sum can exceed 1
    limit-of-the-whole: your code returns 1 if the distance is at least the bound on the
      whole motion. Multiply this bound by `1 - s`, because only this fraction of the
      motion remains
    step-capped 2: your code returns the smaller of `1 - s` and the step. Return the
      smaller of 1 and s + step instead
    max-for-min: your code returns the larger of 1 and s + step. Return the smaller of
      the two, because the motion ends at s = 1
    shares-summed: your code adds the steps that each joint alone would allow. Add the
      products `abs(delta_q[i]) * radii[i]` first, and then divide the distance by this
      sum
    careful: your code uses only a fraction of the step that the bound allows. Use the
      whole step
    careful 2: your code uses only a fraction of the step that the bound allows. Use the
      whole step
    time: your code returns the bound divided by the distance. The step is the distance
      divided by the bound. Return s plus this step, clamped at 1, and return s itself
      in contact
    """
    speed = np.abs(delta_q) @ radii
    inside = distance <= 0
    still = not np.any(delta_q)

    def gone(step):
        if inside:
            return s
        return 1.0 if still else min(1.0, s + step)

    def by(speed):
        return lambda: gone(distance / speed if speed > 0 else np.inf)

    def plain():
        return min(1.0, s + distance / speed) if speed else 1.0

    turns = np.abs(delta_q)

    def each():
        moving = turns * radii > 0
        return gone(np.sum(distance / (turns * radii)[moving]))

    return {
        "still-before-touching": 1.0 if still else s if inside else plain(),
        "reach-backwards": by(turns @ radii[::-1]),
        "reaches-summed": by(turns.sum() * radii.sum()),
        "reaches-summed 2": by(turns.max() * radii.sum()),
        "reaches-summed 3": by(np.linalg.norm(delta_q) * radii.sum()),
        "one-direction": by(np.maximum(delta_q, 0) @ radii),
        "one-left-out": by(turns[:-1] @ radii[:-1]),
        "one-left-out 2": by(turns[1:] @ radii[1:]),
        "chord": by(2 * np.abs(np.sin(delta_q / 2)) @ radii),
        "mean-of-joints": by(np.mean(turns * radii)),
        "step-capped": lambda: s if inside else 1.0 if still else
        s + min(1.0, distance / speed),
        "limit-of-the-whole": lambda: s if inside else 1.0 if still else
        1.0 if distance >= speed else s + distance / speed,
        "step-capped 2": lambda: s if inside else 1.0 if still else
        min(1.0 - s, distance / speed),
        "max-for-min": lambda: s if inside else 1.0 if still else
        max(1.0, s + distance / speed),
        "shares-summed": each,
        "careful": lambda: gone(0.9 * distance / speed),
        "careful 2": lambda: gone(0.95 * distance / speed),
        "no-bound": s if inside else min(1.0, s + distance),
        "signs-kept": by(delta_q @ radii),
        "signs-kept 2": by(abs(delta_q @ radii)),
        "fastest-joint-only": by((np.abs(delta_q) * radii).max()),
        "fastest-joint-only 2": by(np.abs(delta_q).max() * radii.max()),
        "norm-of-dq": by(np.linalg.norm(delta_q) * radii.max()),
        "norm-of-products": by(np.linalg.norm(delta_q * radii)),
        "norm-of-products 2": by(np.linalg.norm(delta_q) * np.linalg.norm(radii)),
        "largest-reach": by(np.abs(delta_q).sum() * radii.max()),
        "reach-forgotten": by(np.abs(delta_q).sum()),
        "dq-forgotten": by(radii.sum()),
        "of-what-is-left": lambda: gone(distance / speed * (1 - s)),
        "of-what-is-left 2": lambda: gone(distance / speed / (1 - s)),
        "half-a-step": lambda: gone(distance / speed / 2),
        "twice-a-step": lambda: gone(2 * distance / speed),
        "multiplied": lambda: gone(distance * speed),
        "s-forgotten": lambda: s if inside else
        1.0 if still else min(1.0, distance / speed),
        "not-capped": lambda: s if inside else 1.0 if still else s + distance / speed,
        "standing-still": lambda: s if inside else min(1.0, s + distance / speed)
        if speed else np.nan,
        "standing-still 2": lambda: s if still else gone(distance / speed),
        "goes-back-inside": plain,
        "goes-on-inside": lambda: min(1.0, s + abs(distance) / speed) if speed else 1.0,
        "stops-inside": lambda: 1.0 if inside else gone(distance / speed),
        "stops-inside 2": lambda: 0.0 if inside else gone(distance / speed),
        "time": lambda: speed / distance if distance else np.inf,
    }  # fmt: skip


@row.wrong
def far_is_free(s, distance, delta_q, radii):
    """if the distance is large, your code returns 1 without the bound. Use the bound,
    because a long motion can exceed any distance"""
    if distance <= 0:
        return s
    speed = np.abs(delta_q) @ radii
    return 1.0 if distance > 0.5 or not speed else min(1.0, s + distance / speed)


row.same("first delta_q = np.abs(delta_q)", "it takes the size anyway")
STILL = "return min(1.0, s + distance / speed) if speed > {} else 1.0"
row.same(f"{STILL.format('0')} => {STILL.format('-0.001 + 0')}", "x / 0. is infinite")
row.same("first distance = np.maximum(distance, 0)", "0 is s as well")
row.at_least_0(s="a fraction", radii="a length", answer="a fraction")


@row.right  # By a loop.
def _(s, distance, delta_q, radii):
    if distance <= 0:
        return s
    most = 0.0
    for turn, far in zip(delta_q, radii, strict=True):
        most += abs(turn) * far
    left = 1.0 - s
    return 1.0 if most * left <= distance else s + distance / most
