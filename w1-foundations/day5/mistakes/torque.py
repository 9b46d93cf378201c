"""Mistakes in task 5.6 `computed_torque`: what M scales, and what not."""

from collections.abc import Callable

import numpy as np

from labkit.judge.mistake import Mistake
from robo47.checks import Array

from .springs import wrapped

ARMATURE = 0.1  # kg m2, of every joint of the Panda's model


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


def _bias_scaled(M, b, damping, qd, e, ed, qdd_ref, kp, kd):
    acc = _acceleration(qd, e, ed, qdd_ref, kp[:, None], kd[:, None])
    return _times(M, acc + b) + damping * qd


def _rubbing(velocity: Callable[[Array, Array], Array]) -> Callable[..., Array]:
    """Return computed torque whose friction is damping times another velocity."""

    def redo(M, b, damping, qd, e, ed, qdd_ref, kp, kd):
        acc = _acceleration(qd, e, ed, qdd_ref, kp[:, None], kd[:, None])
        return _times(M, acc) + b + damping * velocity(qd, ed)

    return redo


def _bias_alone_at_the_goal(M, b, damping, qd, e, ed, qdd_ref, kp, kd):
    right = _made()(M, b, damping, qd, e, ed, qdd_ref, kp, kd)
    return np.where(np.all(e == 0.0, axis=1, keepdims=True), b, right)


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
        _rubbing(lambda qd, ed: ed),
    ),
    Mistake(
        "friction-of-the-reference",
        "friction is multiplied by the reference's velocity, qd + ed; the joint rubs "
        "with its measured velocity",
        _rubbing(lambda qd, ed: qd + ed),
    ),
    Mistake(
        "friction-without-velocity",
        "damping is added as it is: it becomes a torque once it is multiplied by qd",
        _rubbing(lambda qd, ed: 1.0),
    ),
    Mistake(
        "friction-twice",
        "the joints' friction is in it twice; bias does not hold it, so once is enough",
        _made(friction=2.0),
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
        "both-signs",
        "kp e and kd ed both have the wrong sign: e and ed are the reference minus "
        "what is measured",
        _made(inside=lambda qd, e, ed, acc, kp, kd: acc - kd * ed - kp * e),
    ),
    Mistake(
        "error-wrapped",
        "e is taken to within +-pi; these joints have stops, so a whole turn is not "
        "the same as none",
        _made(inside=lambda qd, e, ed, acc, kp, kd: acc + kd * ed + kp * wrapped(e)),
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
        "bias-through-M",
        "bias goes through M as well; it is a torque already",
        _bias_scaled,
    ),
    Mistake(
        "armature-twice",
        "the armature, 0.1 kg m2, is added to M; M has it already",
        _made(scaled=lambda M, acc: _times(M, acc) + ARMATURE * acc),
    ),
    Mistake(
        "bias-alone-at-the-goal",
        "where e is 0 only bias comes back, but the arm may be moving there",
        _bias_alone_at_the_goal,
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
