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
    "arms that do not move": in_phase("rest"),
    "steps that reach the end of the path": in_phase("end"),
}
row.cases({"steps that stay on the path": in_phase("step"), **ELSE})
row.cases({
    "steps in which joints move forwards only": signs(1),
    "steps in which joints move backwards only": signs(-1),
    "steps in which joints move in both directions": signs(1, -1),
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
    one = delta_q * (np.arange(7) == rng.integers(7)) * rng.choice([1.0, 0.005])
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
    """no-bound: the distance itself is taken for a share of the way: metres are not s
      => s + distance
    signs-kept: the joints' signs are kept, so turns cancel; the farthest point may move
      by the sum of their sizes => with delta_q for |delta_q|
    signs-kept 2: the sum is taken before the size, so turns cancel => |delta_q . radii|
    fastest-joint-only: only the joint that moves most counts; what all do adds up =>
      the largest |delta_q_i| radii_i
    fastest-joint-only 2: only the largest |delta_q| counts => largest |delta_q| x
      largest radius
    norm-of-dq: the length of delta_q times the largest radius is no bound: seven turns
      add up
    norm-of-products: the length of |delta_q| radii is taken, not the sum
    norm-of-products 2: the length of delta_q times that of radii is taken, not the sum
    first-reach: every joint is given the first one's radius
    largest-reach: every joint is given the largest radius: safe, and not the bound that
      is asked for
    mean-reach: every joint is given the mean radius
    reach-forgotten: the radius is missing: a turn is in radians => / sum |delta_q|
    dq-forgotten: how far each joint turns is missing => / sum radii
    of-what-is-left: delta_q is that of the whole way; it is taken for what is left
      after s => times 1 - s
    of-what-is-left 2: delta_q is taken times what is left after s; the bound is that of
      the whole way
    half-a-step: only half of the free way is gone
    twice-a-step: twice the free way is gone
    multiplied: the distance is multiplied by what may move; a fast arm has to be looked
      at sooner => distance times the sum
    s-forgotten: this is the step alone; s is to be added
    not-capped: it may go beyond the end of the way, which is 1
    standing-still: where nothing moves it divides by 0; the way's end is free: 1
    standing-still 2: where nothing moves it stays; the way's end is free: 1 => s there
    goes-back-inside: where it touches it goes back; s itself is asked for => s - |d| /
      speed
    goes-on-inside: where it touches it goes on; s itself is asked for => with |d|
    stops-inside: where it touches it goes to the end
    stops-inside 2: where it touches it is 0
    still-before-touching: that nothing moves is asked first; where it touches it is s,
      whether it moves or not => 1 there
    reach-backwards: the radii are counted from the tip: joint 1 has the last one's
    last-reach: every joint is given the last one's radius
    reaches-summed: the radii are added, and the turns; each turn has its own radius =>
      sum |delta_q| times sum radii
    reaches-summed 2: the largest turn is taken with all radii; each has its own
    reaches-summed 3: the length of delta_q is taken with all radii; each has its own
    one-direction: only joints that turn forwards count; others move it as well =>
      delta_q above 0
    one-left-out: the last joint is left out
    one-left-out 2: the first joint is left out
    turn-squared: |delta_q| is squared
    reach-squared: radius is squared
    chord: the chord of each turn is taken, 2 sin(delta_q / 2); a point goes along the
      arc
    mean-of-joints: it is the mean over the joints; what all do adds up
    step-capped: the step is cut to 1, and s + step may be beyond the end => s + min(1,
      step)
    step-capped 2: s is taken off the end and not added to the step => min(1 - s, step)
    max-for-min: max stands for min: it is always 1 or more
    shares-summed: the steps that each joint alone allows are added
    careful: a part of the free way is gone alone, for safety => 0.9
    careful 2: a part of the free way is gone alone, for safety => 0.95
    time: this is the number of steps, 1 / step
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
        "last-reach": by(turns.sum() * radii[-1]),
        "reaches-summed": by(turns.sum() * radii.sum()),
        "reaches-summed 2": by(turns.max() * radii.sum()),
        "reaches-summed 3": by(np.linalg.norm(delta_q) * radii.sum()),
        "one-direction": by(np.maximum(delta_q, 0) @ radii),
        "one-left-out": by(turns[:-1] @ radii[:-1]),
        "one-left-out 2": by(turns[1:] @ radii[1:]),
        "turn-squared": by(turns**2 @ radii),
        "reach-squared": by(turns @ radii**2),
        "chord": by(2 * np.abs(np.sin(delta_q / 2)) @ radii),
        "mean-of-joints": by(np.mean(turns * radii)),
        "step-capped": lambda: s if inside else 1.0 if still else
        s + min(1.0, distance / speed),
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
        "first-reach": by(np.abs(delta_q).sum() * radii[0]),
        "largest-reach": by(np.abs(delta_q).sum() * radii.max()),
        "mean-reach": by(np.abs(delta_q).sum() * radii.mean()),
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
    """far away, over half a metre, the rest of the way is taken for free; a long way
    can use up any distance => 1 where the distance is over 0.5"""
    if distance <= 0:
        return s
    speed = np.abs(delta_q) @ radii
    return 1.0 if distance > 0.5 or not speed else min(1.0, s + distance / speed)


row.same("first delta_q = np.abs(delta_q)", "it takes the size anyway")
STILL = "return min(1.0, s + distance / speed) if speed > {} else 1.0"
row.same(f"{STILL.format('0')} => {STILL.format('-0.001 + 0')}", "x / 0. is infinite")
row.same("first distance = np.maximum(distance, 0)", "0 is s as well")
row.at_least_0(s="a share", radii="a length", answer="a share")


@row.right  # By a loop.
def _(s, distance, delta_q, radii):
    if distance <= 0:
        return s
    most = 0.0
    for turn, far in zip(delta_q, radii, strict=True):
        most += abs(turn) * far
    left = 1.0 - s
    return 1.0 if most * left <= distance else s + distance / most
