"""14.5 `act(theta, observation)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector, rounded
from robo47.policy import HIGH, LOW, act

NAMES = ("x", "y", "yaw", "height", "opening", "lift")
row = Row(Vector((6,), "m, rad", names=NAMES))


@row.inputs
def _(rng):
    yield np.array([0.01, 0, 0.1, 0.02, 0, 0.2]), np.array([0.4, 0.1, np.pi / 6])
    yield np.array([0.01, 0.005, 0.1, 0.02, 0.01, 0.2]), np.array([0.4, 0.1, 0.0])
    for beyond in (0.0, 0.0, 0.5, 0.5, 1.0, 1.0):
        size = (HIGH - LOW) * (1 + beyond)
        theta = (LOW + HIGH) / 2 + size * rng.uniform(-0.5, 0.5, 6)
        observation = np.append(rng.numbers(-0.4, 0.6, 2), rng.numbers(-0.78, 0.78))
        yield rounded(theta), observation
    yield rounded(2 * HIGH), rng.numbers(-0.5, 0.5, 3)
    yield rounded(LOW - 0.3), rng.numbers(-0.5, 0.5, 3)
    for observation in rng.numbers(-0.7, 0.7, 4, 3):
        yield rounded(rng.uniform(LOW - 0.1, HIGH + 0.1)), observation


def turned(angle, x, y):
    """Return (x, y) turned by an angle."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * x - s * y, s * x + c * y])


@row.wrongs
def _(theta, observation):
    """world-axes: the shift is in the world's axes; it is in the cube's, so it turns
      with the yaw that was seen => with x + dx, y + dy
    turned-back: the shift is turned the other way => with R^T for R
    turned-with-the-hand: the shift is turned by the hand's yaw, the turn included; it
      is in the axes of the cube => turned by yaw + turn
    not-clipped: theta is not clipped to LOW and HIGH
    clipped-after: the finished six numbers are clipped; theta is, before it is used
    clipped-below-only: theta is clipped to LOW alone
    clipped-above-only: theta is clipped to HIGH alone
    half-clipped: only the last three numbers are clipped
    clip-turned-round: HIGH is taken for the lower limit, and LOW for the upper
    turn-not-added: the hand's yaw is the cube's; theta's turn comes on top
    turn-alone: the hand's yaw is theta's turn; it comes on top of the cube's
    turn-taken-off: theta's turn is taken off; it comes on top
    shift-forgotten: there is no shift
    shift-alone: the hand goes to the shift; that is beside the cube
    shift-taken-off: the shift is taken off; it comes on top
    x-shift-only: y has no shift of its own
    opening-and-height-swapped: height and opening are swapped
    lift-from-the-floor: the lift has the height in it; they are two numbers
    """
    t = np.clip(theta, LOW, HIGH)
    right = act(theta, observation)
    x, y, yaw = observation

    def done(p, shift, angle=None):
        at = np.array([x, y]) + shift
        return np.array([*at, yaw + p[2] if angle is None else angle, *p[3:]])

    def from_clipped(p):
        return done(p, turned(yaw, p[0], p[1]))

    half = np.append(theta[:3], t[3:])
    shift = turned(yaw, t[0], t[1])
    lifted = right.copy()
    lifted[5] += lifted[3]
    alone = right.copy()
    alone[:2] = shift
    return {
        "world-axes": done(t, t[:2]),
        "turned-back": done(t, turned(-yaw, t[0], t[1])),
        "turned-with-the-hand": done(t, turned(yaw + t[2], t[0], t[1])),
        "not-clipped": from_clipped(theta),
        "clipped-after": np.clip(from_clipped(theta), LOW, HIGH),
        "clipped-below-only": from_clipped(np.maximum(theta, LOW)),
        "clipped-above-only": from_clipped(np.minimum(theta, HIGH)),
        "half-clipped": from_clipped(half),
        "clip-turned-round": from_clipped(np.clip(theta, HIGH, LOW)),
        "turn-not-added": done(t, shift, yaw),
        "turn-alone": done(t, shift, t[2]),
        "turn-taken-off": done(t, shift, yaw - t[2]),
        "shift-forgotten": done(t, np.zeros(2)),
        "shift-alone": alone,
        "shift-taken-off": done(t, -shift),
        "x-shift-only": done(t, turned(yaw, t[0], 0)),
        "opening-and-height-swapped": right[[0, 1, 2, 4, 3, 5]],
        "lift-from-the-floor": lifted,
    }


row.same(
    "shift = se3.Rz(yaw)[:2, :2] @ theta[:2] => "
    "shift = se3.Rz(yaw)[:4, :2] @ theta[:2]",
    "only its first two numbers are used",
)
row.same("first theta = np.clip(theta, -1, 1)", "LOW and HIGH are narrower")


@row.right  # By complex numbers.
def _(theta, observation):
    t = np.minimum(np.maximum(theta, LOW), HIGH)
    at = complex(*observation[:2]) + complex(t[0], t[1]) * np.exp(1j * observation[2])
    return np.array([at.real, at.imag, observation[2] + t[2], t[3], t[4], t[5]])


row.spans(  # as small, or as large, as in the lab
    observation=(lambda observation: 0.06 * observation,),
)
