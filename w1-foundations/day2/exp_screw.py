"""2.4 `exp_screw(S, theta)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Pose, Row
from labkit.judge.answer_mistakes import of_a_pose
from labkit.judge.argument_mistakes import INTO_COS, RADIANS_TWICE, SMALL_LEFT_OUT
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
    "small-angle-ignored",
)


@row.inputs
def _(rng):
    """Return hinges, slides, and screws that turn and move along, with angles.

    Hinges through the origin and about x, y and z; angles beyond pi, and small ones.
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
    """twist-order: the halves are read as (v; omega); omega comes first
    hinge-at-the-origin-forgotten: right unless v is 0; with v = 0 it does not move at
      all, but such a screw turns about a line through the origin => the right one with
      I where v is 0
    turns-backwards: it moves the other way, by -theta => the motion by -theta
    theta-wrapped: right for theta from -pi to pi; theta is brought into that range, but
      what moves along the axis has no such period => the motion by that angle
    """
    motions = {
        "twist-order": (np.roll(S, 3), theta),
        "hinge-at-the-origin-forgotten": (S, theta if S[3:].any() else 0.0),
        "turns-backwards": (S, -theta),
        "theta-wrapped": (S, (theta + np.pi) % (2 * np.pi) - np.pi),
    }
    return {slug: partial(motion, *one) for slug, one in motions.items()}


row.of_argument("theta", INTO_COS, RADIANS_TWICE, *SMALL_LEFT_OUT)


@row.wrongs
def _(S, theta):
    """identity-for-theta: R is right, but the translation starts with I v, not with
      theta: at theta = 0 it moves already => the right one with I instead of theta I
    sine-for-theta: R is right, but the translation starts with sin v, not with theta v:
      along its axis a screw moves by theta v => the right one with sin I
    exp-coefficients-swapped: R is right, but in the translation the two factors have
      changed places => the right one with the two swapped
    as-in-the-rotation: R is right, but the translation uses R's own factors, sin and 1
      - cos; it needs their integrals => the right one with those factors
    travel-sign-of-K: R is right, but in the translation the term with K has the wrong
      sign => the right one with that sign
    travel-sign-of-KK: R is right, but in the translation the term with K K has the
      wrong sign => the right one with that sign
    travel-without-K: R is right, but in the translation the term with K is missing
    travel-without-KK: R is right, but in the translation the term with K K is missing
    travel-K-for-KK: R is right, but in the last term of the translation stands K, not K
      K => the right one with K there
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
    """R-times-v: R is right, but the translation is R v: a velocity has to be summed up
      on the way => the right one with R v
    R-times-theta-v: R is right, but the translation is theta R v: the direction of v
      turns on the way, it is not turned all the way from the start
    travel-on-a-line: R is right, but the translation is theta v, a straight line; a
      screw's path bends => the right one with theta v
    travel-is-v: R is right, but the translation is v itself, whatever theta is
    travel-turned: R is right, but the translation is turned by R once more => the right
      one with R t
    travel-over-theta: R is right, but in the translation theta is missing: the whole of
      it is divided by theta => the right one with t / theta
    moment-used-as-point: v is taken for a point on the axis; it is the velocity of the
      origin => the turn about the line through v
    pitch-forgotten: right for plain hinges and slides; a screw that turns and moves
      along its axis loses the part along it => the right one without that part
    pitch-without-theta: right for plain hinges and slides; what moves along the axis
      has to grow with theta => the right one with that part constant
    hinges-only: right for plain hinges; along the axis nothing moves, neither as it
      turns nor as it slides => the right one without that part
    sign-of-the-point: R is right, but the point on the axis has the wrong sign: it is
      omega x v, and (I - R) stands before it => the right one with that sign
    slide-forgotten: right where it turns; with omega = 0 it does not move at all, but
      it slides => the right one with I for slides
    slide-without-theta: right where it turns; with omega = 0 it slides by v, not by
      theta v => the right one with v for slides
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
    """np.exp works on each entry; the exponential of a matrix is a series of products
    => np.exp of [S] theta"""
    bracket = np.zeros((4, 4))
    bracket[:3, :3] = skew(S[:3])
    bracket[:3, 3] = S[3:]
    return np.exp(bracket * theta)


row.reached_by("skew", "in [omega], ", but=["made-unit"])  # its length is 1
row.reached_by("exp_rotation", "in the rotation, ", but=["small-angle-ignored"])
row.of_answer(of_a_pose(), but=["R-transposed", "inverse-returned"])  # the angle's sign


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
