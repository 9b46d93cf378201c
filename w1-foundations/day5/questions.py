"""Day 5's functions: how each is asked, and what a right answer is.

The truth comes from `robo47.control`, never from the lab script.
"""

from labkit.judge import Ask, HeldOut, Scalar, Vector
from labkit.judge.mistake import each
from robo47 import control

from . import inputs
from .mistakes import gains, motors, pid, response, springs, torque, where

JOINTS = tuple(f"joint{i}" for i in range(1, 8))
TORQUE = Vector((7,), "Nm", scale=10.0, names=JOINTS)
BOTH = "kp and kd are", "KP and KD are"
STIFFNESS = "kp is", "KP is"


def _one_gain(inputs, truth, gains: str, lab: str) -> HeldOut:
    """Return the question whether a right function also takes one number as a gain."""
    says = (
        f"Right where {gains} 7 numbers, but it stops or is wrong where {gains} one "
        f"number, as {lab} in the lab. Which product of NumPy takes both kinds?"
    )
    return HeldOut("one-number-as-gain", says, inputs, truth=each(truth))


def _response(t, omega, zeta):
    return control.error_response(t, omega[:, None], zeta[:, None])


QUESTIONS = {
    "pd_torque": Ask(
        inputs.pd,
        TORQUE,
        truth=control.pd_torque,
        mistakes=springs.PD,
        held_out=[_one_gain(inputs.one_gain, control.pd_torque, *BOTH)],
        near=1e-5,
    ),
    "gains": Ask(
        inputs.gains,
        Vector((2,), scale=100.0, names=("kp", "kd")),
        truth=control.gains,
        mistakes=gains.GAINS,
        near=1e-5,
    ),
    "error_response": Ask(
        inputs.responses,
        Vector((len(inputs.TIMES),)),
        truth=_response,
        mistakes=response.RESPONSE,
        unnamed=where.which_case,
        near=1e-5,
    ),
    "sag_step": Ask(
        inputs.sags,
        Vector((7,), "rad", names=JOINTS),
        truth=control.sag_step,
        mistakes=springs.SAG,
        held_out=[_one_gain(inputs.sags_of_one_gain, control.sag_step, *STIFFNESS)],
        near=1e-5,
    ),
    "gravity_pd": Ask(
        inputs.gravity,
        TORQUE,
        truth=control.gravity_pd,
        mistakes=springs.GRAVITY,
        held_out=[_one_gain(inputs.gravity_of_one_gain, control.gravity_pd, *BOTH)],
        near=1e-5,
    ),
    "computed_torque": Ask(
        inputs.states,
        TORQUE,
        truth=each(control.computed_torque),
        mistakes=torque.TORQUE,
        near=1e-5,
    ),
    "pid_step": Ask(
        inputs.integrals,
        (
            Vector(
                (7,), "rad/s2", scale=100.0, names=JOINTS, called="the acceleration"
            ),
            Vector((7,), "rad s", scale=0.1, names=JOINTS, called="the integral"),
        ),
        truth=each(control.pid_step),
        mistakes=pid.PID,
        unnamed=where.which_answer,
        near=1e-5,
    ),
    "saturate": Ask(
        inputs.torques,
        TORQUE,
        truth=control.saturate,
        mistakes=motors.SATURATE,
        near=1e-5,
    ),
    "fastest": Ask(
        inputs.steps,
        Scalar(unit="rad/s", scale=100.0),
        truth=control.fastest,
        mistakes=motors.FASTEST,
        near=1e-5,
    ),
    "servo_ctrl": Ask(
        inputs.servos,
        Vector((7,), "rad", names=JOINTS),
        truth=control.servo_ctrl,
        mistakes=motors.SERVO,
        near=1e-5,
    ),
}
