"""2.4 `exp_screw(S, theta)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pose, Row
from labkit.judge.answer_mistakes import of_a_pose
from robo47.screws import skew

from .exp_rotation import formula, rodrigues

row = Row(Pose())

I = np.eye(3)  # noqa: E741
MOTIONS = (
    ((0, 0, 1, 0, -1, 0), np.pi / 2),
    ((0, 0, 1, 0, 0, 0), 1.1),
    ((0, 1, 0, -0.333, 0, 0), -0.8),
    ((1, 0, 0, 0, 0, 0.2), 2.3),
    ((0, 0, 0, 0.6, 0, 0.8), 4.0),
    ((0, 0.6, 0.8, 0.3, -0.2, 0.5), 4.0),
    ((0, 0.6, -0.8, 0.1, 0.5, 0.4), 1e-4),
    ((0.6, 0, 0.8, -0.2, 0.4, 0.7), -5e-3),
    ((0, 0.6, 0.8, 0.3, -0.2, 0.5), 3e-7),
)
# What does not show in an arm of plain hinges, or is a mistake in its angles there.
NOT_OF_AN_ARM = (
    "pitch-forgotten",
    "hinges-only",
    "pitch-without-theta",
    "slide-forgotten",
    "slide-without-theta",
    "sign-of-the-point",
    "hinge-at-the-origin-forgotten",
    "theta-wrapped",
)


@row.inputs
def _(rng):
    """Return rotations, translations and screws with a pitch, with their angles.

    Some axes pass through the origin; some angles are small or beyond pi.
    """
    drawn = np.hstack([rng.units(8), rng.numbers(-1, 1, 8, 3)])
    drawn[[0, 3], :3] = 0.0
    angles = rng.numbers(-3, 3, 8)
    yield from ((np.array(S, dtype=float), theta) for S, theta in MOTIONS)
    yield from ((S, float(theta)) for S, theta in zip(drawn, angles, strict=True))


def motion(S, theta):
    """Return the right pose, whatever S is: the lab tries (v; omega) on purpose."""
    return travelled(S, theta, theta, 1 - np.cos(theta), theta - np.sin(theta))


def moved(S, theta, t):
    """Return the pose of the right rotation, whatever S is, and another translation."""
    T = np.eye(4)
    T[:3, :3] = rodrigues(S[:3], theta)
    T[:3, 3] = t
    return T


def travelled(S, theta, one, first, second):
    """Return the pose whose translation is (one I + first K + second K K) v."""
    return moved(S, theta, formula(S[:3], one, first, second) @ S[3:])


@row.wrongs(hidden={"theta-wrapped": "the lab's angles are between -pi and pi"})
def _(S, theta):
    """twist-order: your code reads the screw as (v; omega). The order in this course is
      (omega; v)
    hinge-at-the-origin-forgotten: your code returns the identity matrix for a screw
      with v = 0. Such a screw represents a rotation about a line through the origin
    turns-backwards: your code computes the motion for -theta, which has the opposite
      direction. The correct motion is for theta itself
    theta-wrapped: your motion belongs to theta wrapped to [-pi, pi]. Use theta
      unchanged, because the translation along the axis is not periodic
    """
    motions = {
        "twist-order": (np.roll(S, 3), theta),
        "hinge-at-the-origin-forgotten": (S, theta if S[3:].any() else 0.0),
        "turns-backwards": (S, -theta),
        "theta-wrapped": (S, (theta + np.pi) % (2 * np.pi) - np.pi),
    }
    return {slug: partial(motion, *one) for slug, one in motions.items()}


@row.wrongs
def _(S, theta):
    """identity-for-theta: your rotation is correct, but your translation contains v
      instead of theta v. The translation should be 0 at theta = 0
    sine-for-theta: your rotation is correct, but your translation contains sin(theta) v
      instead of theta v. The term theta v is the integral of v from 0 to theta
    exp-coefficients-swapped: your rotation is correct, but the coefficients of K and
      K^2 are swapped in your translation
    as-in-the-rotation: your rotation is correct, but your translation uses sin(theta)
      and 1 - cos(theta), which are the coefficients of the rotation. Use the integrals
      of these two coefficients from 0 to theta
    travel-sign-of-K: your rotation is correct, but the K term of your translation has
      the wrong sign
    travel-sign-of-KK: your rotation is correct, but the K^2 term of your translation
      has the wrong sign
    travel-without-K: your rotation is correct, but your code omits the K term of the
      translation
    travel-without-KK: your rotation is correct, but your code omits the K^2 term of the
      translation
    travel-K-for-KK: your rotation is correct, but the last term of your translation
      contains K instead of K^2
    """
    c, s = np.cos(theta), np.sin(theta)
    factors = {
        "identity-for-theta": (1, 1 - c, theta - s),
        "sine-for-theta": (s, 1 - c, theta - s),
        "exp-coefficients-swapped": (theta, theta - s, 1 - c),
        "as-in-the-rotation": (theta, s, 1 - c),
        "travel-sign-of-K": (theta, c - 1, theta - s),
        "travel-sign-of-KK": (theta, 1 - c, s - theta),
        "travel-without-K": (theta, 0, theta - s),
        "travel-without-KK": (theta, 1 - c, 0),
        "travel-K-for-KK": (theta, 1 - c + theta - s, 0),
    }
    return {
        slug: partial(travelled, S, theta, *three) for slug, three in factors.items()
    }


@row.wrongs
def _(S, theta):
    """R-times-v: your rotation is correct, but your translation is R v. The translation
      should be the integral of the rotated v from 0 to theta
    R-times-theta-v: your rotation is correct, but your translation is theta R v. The
      translation should be the integral of the rotated v, because v rotates during the
      motion
    travel-on-a-line: your rotation is correct, but your translation is theta v, which
      is in general wrong if omega is not 0. The translation should be the integral of
      the rotated v from 0 to theta
    travel-is-v: your rotation is correct, but your translation is v for every theta.
      The translation should be 0 at theta = 0
    travel-turned: your rotation is correct, but your translation is the correct
      translation multiplied by R. The translation should not contain this factor
    travel-over-theta: your rotation is correct, but your translation is the correct
      translation divided by theta. For a small theta, the translation should be nearly
      theta v
    moment-used-as-point: your translation is v - R v, as if v were a point on the axis.
      The vector v is a velocity. The point on the axis nearest to the origin is omega x
      v
    pitch-forgotten: your code omits the translation along the axis if omega is not 0.
      This translation is needed for a screw with a nonzero pitch
    pitch-without-theta: your code multiplies the translation along the axis by theta
      only if omega is 0. Always multiply this translation by theta
    hinges-only: your code omits the translation along the axis for every screw. This
      translation is 0 for a pure rotation, but not in general
    sign-of-the-point: your rotation is correct, but the part of your translation
      perpendicular to the axis has the wrong sign. The point on the axis nearest to the
      origin is omega x v
    slide-forgotten: your translation is 0 for a screw with omega = 0. Such a screw
      represents a pure translation, so the translation should be theta v
    slide-without-theta: your translation is v for a screw with omega = 0. The
      translation should be theta v
    """
    omega = S[:3]
    v = S[3:]
    R = rodrigues(omega, theta)
    t = motion(S, theta)[:3, 3]
    turns = omega.any()
    round_it = (I - R) @ np.cross(omega, v)
    along = omega @ v * omega
    travel = {
        "R-times-v": R @ v,
        "R-times-theta-v": R @ v * theta,
        "travel-on-a-line": theta * v,
        "travel-is-v": v,
        "travel-turned": R @ t,
        "travel-over-theta": t / (theta or 1.0),
        "moment-used-as-point": v - R @ v,
        "pitch-forgotten": round_it if turns else t,
        "hinges-only": round_it,
        "pitch-without-theta": round_it + along if turns else t,
        "sign-of-the-point": theta * along - round_it if turns else t,
        "slide-forgotten": t if turns else np.zeros(3),
        "slide-without-theta": t if turns else v,
    }
    return {slug: partial(moved, S, theta, t) for slug, t in travel.items()}


@row.wrong
def exp_by_entries(S, theta):
    """your matrix is the exponential of each entry, as `np.exp` returns it. Use the
    matrix exponential instead, which is a series of matrix powers"""
    bracket = np.zeros((4, 4))
    bracket[:3, :3] = skew(S[:3])
    bracket[:3, 3] = S[3:]
    return np.exp(bracket * theta)


row.reached_by(
    "skew",
    "in the skew-symmetric matrix [omega], ",
    called={"w_": "omega_", " w ": " omega "},
)
row.reached_by("exp_rotation", "in the rotation part, ")
row.of_answer(of_a_pose(), but=["R-transposed", "inverse-returned"])  # the angle's sign


@row.right  # The closed form in [S], (4, 4): its cube is minus itself, but for a slide.
def _(S, theta):
    X = np.zeros((4, 4))
    X[:3, :3] = skew(S[:3])
    X[:3, 3] = S[3:]
    if not S[:3].any():
        return np.eye(4) + theta * X  # the pose of a slide
    first = theta * X  # the term with [S]
    second = (1 - np.cos(theta)) * X @ X  # the term with the square of [S]
    third = (theta - np.sin(theta)) * X @ X @ X  # the term with the cube of [S]
    return np.eye(4) + first + second + third


@row.close("float32")  # float32 throughout.
def _(S, theta):
    S = S.astype(np.float32)
    theta = np.float32(theta)
    K = skew(S[:3]).astype(np.float32)
    c = np.cos(theta)
    s = np.sin(theta)
    one = np.eye(3, dtype=np.float32)
    T = np.eye(4, dtype=np.float32)
    T[:3, :3] = one + s * K + (1 - c) * K @ K
    T[:3, 3] = (theta * one + (1 - c) * K + (theta - s) * K @ K) @ S[3:]
    return T


@row.close("rounded-somewhere")  # Public code: below a millionth there is no motion.
def _(S, theta):
    return motion(S, theta if abs(theta) >= 1e-6 else 0.0)


@row.close("rounded-somewhere")  # The velocity summed up in small steps.
def _(S, theta):
    n = 2000
    angles = (np.arange(n) + 0.5) * theta / n
    turned = formula(S[:3], n, np.sin(angles).sum(), (1 - np.cos(angles)).sum())
    return moved(S, theta, turned @ S[3:] * theta / n)


@row.wrong("pose-off")  # omega = 0 is asked of its z alone.
def _(S, theta):
    return motion(S if S[2] else S * [0, 0, 0, 1, 1, 1], theta)


@row.wrong("not-finite")  # omega is scaled to length 1: a slide has none.
def _(S, theta):
    return motion(S, theta) if S[:3].any() else np.full((4, 4), np.nan)


row.spans(  # as small, or as large, as in the lab
    theta=(200.0,),
)
