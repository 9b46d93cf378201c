"""3.3 `log_rotation(R)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row, Vector
from robo47 import se3
from robo47.jacobian import log_rotation
from robo47.screws import exp_rotation

from . import angles
from .jacobians import OrNaN


class Numbers(OrNaN, Vector):
    """A vector, or NaN."""


def _half_turns(rng):
    """Return rotations by exactly pi; R is exactly symmetric."""
    axes = np.array([*np.eye(3), [0.6, -0.8, 0], [0, 0.6, 0.8], [0.8, 0, -0.6]])
    return [(2.0 * np.outer(n, n) - np.eye(3),) for n in axes]


HALF_TURN = HeldOut(
    "wrong-at-pi",
    "Your function is correct for angles clearly below pi, but not for exactly pi. At "
    "pi, R - R^T is 0 and determines neither the axis nor its sign. The docstring "
    "defines the sign.",
    _half_turns,
)
row = Row(
    Numbers((3,), "rad", names=("x", "y", "z")),
    unnamed=angles.where_the_angle_fails,
    near_miss=angles.where_the_digits_go,
    held_out=[HALF_TURN],
)


def between(low, high):
    """Return the case of rotations by an angle in a range."""
    return lambda R: low <= float(np.linalg.norm(log_rotation(R))) < high


row.cases({
    "angles below 0.02 rad": between(0.0, 0.02),
    "angles from 0.02 to 2 rad": between(0.02, 2.0),
    "angles from 2 to 3.12 rad": between(2.0, 3.12),
    "angles from 3.12 rad to just below pi": between(3.12, np.pi - 1e-9),
})  # fmt: skip


@row.rare
def _(rng):
    small, by_pi = 10.0 ** rng.uniform(-8, -1.8, 2)
    middle, large = rng.uniform(0.02, 2.0), rng.uniform(2.0, 3.12)
    turns = np.array([small, middle, large, np.pi - by_pi])
    yield from ((R,) for R in exp_rotation(rng.units(4), turns))


@row.inputs
def _(rng):
    """Yield angles from 0 to nearly pi, the docstring's first and random ones last.

    Near pi about x, y or z, all columns of R + R^T but one are empty, to the last
    digit. Which column a function reads shows only if all three axes are asked.
    """
    small = [1e-9, 1e-7, 1e-6, 5e-6, 1e-5, 9e-4, 0.3]
    by_pi = np.pi - np.array([1e-2, 1e-4, 1e-6, 1e-8])
    drawn = rng.uniform(0.2, 3.0, 5)
    first = [0.009, 0.049, 0.099]  # just below where people put a limit
    turns = np.array([*small, *by_pi, 2.0, *drawn, *first])
    R = exp_rotation(rng.units(len(turns)), turns)
    R = [*R[-3:], *R[:-3]]
    rounded = np.diag([1.0, 1.0, 1.0 + 2.0**-51])  # a trace of 3 and a last digit
    about = [nearly_half_a_turn(k) for k in range(3)]
    more = [nearly_half_a_turn(rng.integers(3), rng.integers(14, 40)) for _ in "ab"]
    chosen = [se3.Rz(np.pi / 2), np.eye(3), rounded, *about]
    return [(one,) for one in (*chosen, *R, *more)]


def nearly_half_a_turn(k, digits=40):
    """Return the rotation about x, y or z whose cosine is 2^-digits above -1."""
    c = -1.0 + 2.0**-digits
    i, j = (k + 1) % 3, (k + 2) % 3
    R = c * np.eye(3)
    R[k, k] = 1.0
    R[j, i] = np.sqrt(1.0 - c * c)
    R[i, j] = -R[j, i]
    return R


def vee(R):
    """Return the axis times twice the sine, from R - R^T."""
    return np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])


def cosine(R):
    """Return the cosine of the angle, from the trace."""
    return (np.trace(R) - 1) / 2


def parts(R):
    """Return the axis times the sine, the sine and the angle."""
    a = vee(R) / 2
    sine = np.linalg.norm(a)
    return a, sine, np.arctan2(sine, cosine(R))


def column(R, k=None):
    """Return the axis but for its sign, from column k of R + R^T, or the largest."""
    B = (R + R.T) / 2 - cosine(R) * np.eye(3)
    b = B[:, np.argmax(np.diag(B)) if k is None else k]
    return b / np.linalg.norm(b)


def signed(axis, a):
    """Return an axis with the sign that R - R^T tells."""
    return -axis if a @ axis < 0 else axis


def axis(R):
    """Return the axis, or 0 where there is none."""
    w = log_rotation(R)
    return w / (np.linalg.norm(w) or 1.0)


def roll_pitch_yaw(R):
    """Return the angles about x, y and z of R = Rz(yaw) Ry(pitch) Rx(roll)."""
    roll, yaw = np.arctan2(R[2, 1], R[2, 2]), np.arctan2(R[1, 0], R[0, 0])
    return np.array([roll, -np.arcsin(np.clip(R[2, 0], -1, 1)), yaw])


@row.wrongs
def _(R):
    """sine-for-angle: the norm of your vector is the sine of the angle. The norm should
      be the angle itself
    twice-the-sine: your vector consists of entries of R - R^T, so its norm is twice the
      sine of the angle. The norm should be the angle itself
    quaternion-vector-part: your vector is the vector part of the quaternion, whose norm
      is sin(angle / 2). The norm of your vector should be the angle
    twice-the-quaternion-part: your vector is twice the vector part of the quaternion,
      so its norm is 2 sin(angle / 2). The norm should be the angle
    axis-only: your vector is the unit vector along the axis. The norm of the vector
      should be the angle
    arcsine: your angle is the arcsine of the sine of the correct angle. This sine is
      the same for 100 degrees and 80 degrees. Use atan2 with the sine and the cosine of
      the angle instead
    half-the-angle: the norm of your vector is half the rotation angle. The norm should
      be the full rotation angle
    in-degrees: the norm of your vector is the angle in degrees. Use radians instead
    roll-pitch-yaw: your code returns roll, pitch and yaw, which are the angles of three
      successive rotations. Return the rotation vector of the single rotation R instead
    """
    q = se3.R_to_quat(R)
    a, sine, _ = parts(R)
    quaternion = -q[1:] if q[0] < 0 else q[1:]
    return {
        "sine-for-angle": a,
        "twice-the-sine": vee(R),
        "quaternion-vector-part": quaternion,
        "twice-the-quaternion-part": 2 * quaternion,
        "axis-only": axis(R),
        "arcsine": axis(R) * np.arcsin(min(sine, 1.0)),
        "half-the-angle": log_rotation(R) / 2,
        "in-degrees": np.rad2deg(log_rotation(R)),
        "roll-pitch-yaw": roll_pitch_yaw(R),
    }


@row.wrongs
def _(R):
    """half-the-trace-less-1: your code uses `trace / 2 - 1` as the cosine of the angle.
      The cosine should be `(trace - 1) / 2`
    half-the-trace-less-1 2: your code uses `trace / 2 - 1` as the cosine of the angle.
      The cosine should be `(trace - 1) / 2`
    half-the-trace-less-1 3: your code uses `trace / 2 - 1` as the cosine of the angle.
      The cosine should be `(trace - 1) / 2`
    """
    c = np.trace(R) / 2 - 1
    angle = np.arccos(c)
    return {
        "half-the-trace-less-1": axis(R) * np.arccos(np.clip(c, -1, 1)),
        "half-the-trace-less-1 2": axis(R) * angle,
        "half-the-trace-less-1 3": angle / (2 * np.sin(angle)) * vee(R),
    }


@row.wrongs(hidden={"arccosine-beyond-1": "its identity is exact"})
def _(R):
    """textbook-formula: your code multiplies R - R^T by theta / (2 sin(theta)). For the
      identity matrix, this factor is 0 / 0. For angles near pi, it amplifies the
      rounding errors. Treat both cases separately
    nan-at-0: your result for the identity matrix is NaN, as after a division by the
      sine of 0 or by a norm of 0. Return the zero vector for a rotation by 0
    arccosine-beyond-1: your result is NaN where rounding makes (trace - 1) / 2 larger
      than 1 or smaller than -1. Compute the angle with atan2 instead of the arccosine
    """
    angle = np.arccos(cosine(R))
    no_turn = cosine(R) > 0 and not vee(R).any()
    return {
        "textbook-formula": angle / (2 * np.sin(angle)) * vee(R),
        "nan-at-0": np.full(3, np.nan) if no_turn else log_rotation(R),
        "arccosine-beyond-1": axis(R) * angle,
    }


def from_column(R, k):
    """Return the right answer, but near pi from column k."""
    a, _, angle = parts(R)
    return angle * signed(column(R, k), a) if cosine(R) < -0.9 else log_rotation(R)


for k, (which, missing) in enumerate((("first", "x"), ("second", "y"), ("last", "z"))):
    row.wrong(
        "fixed-column",
        f"for angles near pi, your result is wrong if the axis has no {missing} "
        f"component, because the {which} column of the matrix axis axis^T is then 0. "
        "Use the column with the largest norm instead",
        hidden="its half turn is about y" if missing == "y" else "",
    )(lambda R, k=k: from_column(R, k))


# Right but for some angles: `angles` says which.


@row.wrong("wrong-near-pi")  # Most books' formula, cut off where it would end in NaN.
def _(R):
    angle = np.arccos(np.clip(cosine(R), -1, 1))
    if np.sin(angle) < 1e-12:
        return vee(R) / 2
    return vee(R) / 2 * angle / np.sin(angle)


@row.wrong("wrong-near-pi")  # atan2 gives the angle; the axis is divided by the sine.
def _(R):
    a, sine, angle = parts(R)
    return a * angle / max(sine, 1e-7)


def divided(R):
    """Return the axis times the angle by a division, which is noise near pi."""
    a, sine, angle = parts(R)
    return a * (angle / sine) if sine > 0 else a


@row.wrong("sign-near-pi")  # Near pi the sign is left as the column has it.
def _(R):
    return divided(R) if cosine(R) > -0.999 else parts(R)[2] * column(R)


@row.wrong("signs-near-pi")  # Near pi the root of the diagonal, which has no signs.
def _(R):
    roots = np.sqrt(np.clip((np.diag(R) + 1) / 2, 0, None))
    return divided(R) if cosine(R) > -0.999999 else parts(R)[2] * roots


@row.wrong("large-angles")  # From 154 degrees on the axis alone.
def _(R):
    return log_rotation(R) if cosine(R) > -0.9 else signed(column(R), vee(R))


@row.wrong("pi-for-the-angle")  # From 1e-4 below pi on.
def _(R):
    near = parts(R)[2] >= np.pi - 1e-4
    return np.pi * signed(column(R), vee(R)) if near else divided(R)


@row.wrong("sign-of-the-axis")  # An axis from the symmetric part, whatever its sign.
def _(R):
    a, sine, angle = parts(R)
    return a if sine < 1e-2 and angle < 1 else angle * column(R)


@row.wrong("angle-over-pi")  # Any sign of the axis, and the angle that goes with it.
def _(R):
    a, sine, angle = parts(R)
    if sine < 1e-2 and angle < 1:
        return a
    n = column(R)
    return (angle if sine < 1e-9 or a @ n > 0 else 2 * np.pi - angle) * n


@row.wrong("wrong-at-pi")  # The sign is not that of the docstring there.
def _(R):
    n = column(R) if vee(R) @ column(R) > 0 else -column(R)
    return divided(R) if cosine(R) > -0.9 else parts(R)[2] * n


@row.wrong("all-signs")  # R is transposed.
def _(R):
    return log_rotation(R.T)


@row.wrong
def two_arguments_exchanged(R):
    """your angle is pi minus the correct angle, so its cosine has the wrong sign. The
    cosine should be `(trace - 1) / 2`"""
    w = log_rotation(R)
    angle = np.linalg.norm(w)
    return (np.pi - angle) * w / angle if angle > 0 else w


@row.close("arccosine")  # Cut off at 1.
def _(R):
    a, sine, _ = parts(R)
    angle = np.arccos(np.clip(cosine(R), -1, 1))
    if cosine(R) > 0:
        return a * (angle / sine) if sine > 1e-12 else a
    return angle * signed(column(R), a)


for least in (1e-6, 1e-4):  # As a near-zero test has it.
    row.close("zero-for-small-angles")(
        lambda R, least=least: (parts(R)[2] >= least) * log_rotation(R)
    )


@row.close("rounded")  # To 6 decimals.
def _(R):
    return np.round(log_rotation(R), 6)


@row.right  # The axis is what R leaves alone: an eigenvector of its symmetric part.
def _(R):
    a, sine, angle = parts(R)
    if angle < 3:
        return a if sine == 0 else angle * a / sine
    n = np.linalg.eigh((R + R.T) / 2)[1][:, -1]
    if a @ n < 0 or (sine < 1e-15 and n[np.argmax(np.abs(n))] < 0):
        n = -n
    return angle * n


@row.right  # The unit quaternion, from the largest of its four squares.
def _(R):
    k = int(np.argmax([np.trace(R), *np.diag(R)]))
    q = np.array([1 + np.trace(R), *vee(R)])
    if k:
        i = k - 1
        j = k % 3
        m = (k + 1) % 3
        q[0] = R[m, j] - R[j, m]
        q[1 + i] = 1 + R[i, i] - R[j, j] - R[m, m]
        q[1 + j], q[1 + m] = R[i, j] + R[j, i], R[i, m] + R[m, i]
    q = q / np.linalg.norm(q) * (-1.0 if q[0] < 0 else 1.0)
    n = np.linalg.norm(q[1:])
    return 2 * np.arctan2(n, q[0]) * q[1:] / n if n > 0 else np.zeros(3)


EXACT = "both ways are exact to the last digits in between"
SINE = "return a * (angle / sine if sine > 0"
row.same("if cosine > -0.9: => if cosine > 0.5 * -0.9:", EXACT)
row.same(f"{SINE} else 1.0) => {SINE} else 2.0)", "there a is 0")
row.same(
    f"{SINE} else 1.0) => {SINE.replace('> 0', '> 0.001 + 0')} else 1.0)",
    "angle / sine differs from 1 by less than 1e-6 there, and a is 1e-3",
)
