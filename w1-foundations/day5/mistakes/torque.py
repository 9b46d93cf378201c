"""Mistakes in task 5.6 `computed_torque`: what M scales, and what not."""

from collections.abc import Callable

import numpy as np

from robo47.checks import Array
from robo47.diagnose.mistake import Mistake


def _made(
    *,
    inside: Callable[..., Array] | None = None,
    scaled: Callable[[Array, Array], Array] | None = None,
    bias: float = 1.0,
    friction: float = 1.0,
    outside: Callable[..., Array] | None = None,
) -> Callable[..., Array]:
    """Return computed torque with one part made differently."""

    def redo(M, b, damping, qd, e, ed, qdd_ref, kp, kd):
        parts = qd, e, ed, qdd_ref, kp[:, None], kd[:, None]
        acc = (inside or _acceleration)(*parts)
        force = (scaled or _times)(M, acc)
        extra = outside(*parts) if outside else 0.0
        return force + bias * b + friction * damping * qd + extra

    return redo


def _acceleration(qd, e, ed, qdd_ref, kp, kd):
    return qdd_ref + kd * ed + kp * e


def _times(M: Array, v: Array) -> Array:
    return (M @ v[..., None])[..., 0]


def _everything_scaled(M, b, damping, qd, e, ed, qdd_ref, kp, kd):
    acc = _acceleration(qd, e, ed, qdd_ref, kp[:, None], kd[:, None])
    return _times(M, acc + b + damping * qd)


def _friction_of_the_error(M, b, damping, qd, e, ed, qdd_ref, kp, kd):
    acc = _acceleration(qd, e, ed, qdd_ref, kp[:, None], kd[:, None])
    return _times(M, acc) + b + damping * ed


TORQUE = [
    Mistake(
        "gains-outside-M",
        "the gains stand outside the product with M. It tracks well, but heavy and "
        "light joints then answer differently, and errors do not decay as designed",
        _made(
            inside=lambda qd, e, ed, acc, kp, kd: acc,
            outside=lambda qd, e, ed, acc, kp, kd: kp * e + kd * ed,
        ),
    ),
    Mistake(
        "damping-forgotten",
        "the joints' friction is missing: bias does not hold it, MuJoCo counts it as a "
        "passive force",
        _made(friction=0.0),
    ),
    Mistake(
        "damping-sign",
        "the joints' friction has the wrong sign: the motor has to overcome it",
        _made(friction=-1.0),
    ),
    Mistake(
        "friction-of-the-error",
        "friction is multiplied by ed; the joint rubs with its measured velocity",
        _friction_of_the_error,
    ),
    Mistake(
        "bias-forgotten",
        "bias is missing: gravity and Coriolis forces are left to the springs",
        _made(bias=0.0),
    ),
    Mistake(
        "bias-sign",
        "bias has the wrong sign: it is what the motors must give",
        _made(bias=-1.0),
    ),
    Mistake("bias-twice", "bias is in it twice", _made(bias=2.0)),
    Mistake(
        "qdd-ref-forgotten",
        "the reference's own acceleration is missing: the springs must be stretched "
        "before the arm speeds up",
        _made(inside=lambda qd, e, ed, acc, kp, kd: kd * ed + kp * e),
    ),
    Mistake(
        "qdd-ref-sign",
        "the reference's acceleration has the wrong sign",
        _made(inside=lambda qd, e, ed, acc, kp, kd: kd * ed + kp * e - acc),
    ),
    Mistake(
        "springs-forgotten",
        "there are no springs in it: errors stay what they are",
        _made(inside=lambda qd, e, ed, acc, kp, kd: acc),
    ),
    Mistake(
        "damper-forgotten",
        "there is a spring and no damper: edd + kp e = 0 swings for ever",
        _made(inside=lambda qd, e, ed, acc, kp, kd: acc + kp * e),
    ),
    Mistake(
        "error-sign",
        "the spring pushes away from the goal",
        _made(inside=lambda qd, e, ed, acc, kp, kd: acc + kd * ed - kp * e),
    ),
    Mistake(
        "velocity-error-sign",
        "the damper drives the motion: ed enters with a plus",
        _made(inside=lambda qd, e, ed, acc, kp, kd: acc - kd * ed + kp * e),
    ),
    Mistake(
        "gains-swapped",
        "kp and kd are swapped",
        _made(inside=lambda qd, e, ed, acc, kp, kd: acc + kp * ed + kd * e),
    ),
    Mistake(
        "measured-velocity-damped",
        "the damper works on the measured velocity, minus kd qd, so it brakes the "
        "reference's own motion too; ed is what it has to work on",
        _made(inside=lambda qd, e, ed, acc, kp, kd: acc - kd * qd + kp * e),
    ),
    Mistake(
        "inverse-of-M",
        "the acceleration is divided by M; a torque is M times an acceleration",
        _made(scaled=lambda M, acc: np.linalg.solve(M, acc[..., None])[..., 0]),
    ),
    Mistake(
        "M-forgotten",
        "M is missing: an acceleration is added to torques",
        _made(scaled=lambda M, acc: acc),
    ),
    Mistake(
        "diagonal-of-M",
        "only the diagonal of M is used; a joint that speeds up pushes the others too",
        _made(scaled=lambda M, acc: np.diagonal(M, axis1=-2, axis2=-1) * acc),
    ),
    Mistake(
        "everything-through-M",
        "bias and friction go through M as well; they are torques already",
        _everything_scaled,
    ),
    Mistake(
        "reference-outside-M",
        "the reference's acceleration stands outside the product with M",
        _made(
            inside=lambda qd, e, ed, acc, kp, kd: kd * ed + kp * e,
            outside=lambda qd, e, ed, acc, kp, kd: acc,
        ),
    ),
    Mistake(
        "errors-in-degrees",
        "the errors are converted to degrees; everything else is in radians",
        _made(inside=lambda qd, e, ed, acc, kp, kd: acc + np.rad2deg(kp * e + kd * ed)),
    ),
]
