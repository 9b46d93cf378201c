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
    """Return (x, y) rotated by an angle."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * x - s * y, s * x + c * y])


@row.wrongs
def _(theta, observation):
    """world-axes: your code adds the shift in the world frame. Rotate the shift by the
      yaw of the cube first, because the shift is expressed in the frame of the cube
    turned-with-the-hand: your code rotates the shift by the yaw of the hand. Rotate the
      shift by the yaw of the cube, because the shift is expressed in the frame of the
      cube
    clipped-after: your code clamps the action instead of `theta`. Clamp `theta` before
      you use it
    clipped-below-only: your code clamps `theta` at `LOW`, but not at `HIGH`. Clamp
      `theta` at `HIGH` too
    clipped-above-only: your code clamps `theta` at `HIGH`, but not at `LOW`. Clamp
      `theta` at `LOW` too
    half-clipped: your code clamps only the last three entries of `theta`. Clamp all six
      entries
    shift-forgotten: your code omits the shift given by the first two entries of
      `theta`. Rotate this shift by the yaw of the cube, and add it to x and y
    x-shift-only: your code omits the second entry of `theta`, the shift along the y
      axis of the cube. Rotate both components of the shift by the yaw of the cube
    opening-and-height-swapped: your code swaps the height and the opening. Use the
      order (x, y, yaw, height, opening, lift)
    lift-from-the-floor: your code adds the height to the lift. Return the lift itself,
      because the lift does not depend on the height
    """
    t = np.clip(theta, LOW, HIGH)
    right = act(theta, observation)
    x, y, yaw = observation

    def done(p, shift):
        return np.array([*(np.array([x, y]) + shift), yaw + p[2], *p[3:]])

    def from_clipped(p):
        return done(p, turned(yaw, p[0], p[1]))

    half = np.append(theta[:3], t[3:])
    lifted = right.copy()
    lifted[5] += lifted[3]
    return {
        "world-axes": done(t, t[:2]),
        "turned-with-the-hand": done(t, turned(yaw + t[2], t[0], t[1])),
        "clipped-after": np.clip(from_clipped(theta), LOW, HIGH),
        "clipped-below-only": from_clipped(np.maximum(theta, LOW)),
        "clipped-above-only": from_clipped(np.minimum(theta, HIGH)),
        "half-clipped": from_clipped(half),
        "shift-forgotten": done(t, np.zeros(2)),
        "x-shift-only": done(t, turned(yaw, t[0], 0)),
        "opening-and-height-swapped": right[[0, 1, 2, 4, 3, 5]],
        "lift-from-the-floor": lifted,
    }


row.same(
    "shift = se3.Rz(yaw)[:2, :2] @ theta[:2] => "
    "shift = se3.Rz(yaw)[:4, :2] @ theta[:2]",
    "only its first two entries are used",
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
