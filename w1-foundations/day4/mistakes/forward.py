"""Mistakes in task 4.8 `forward_dynamics`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.mistake import Mistake
from robo47.checks import Array


def _solved(M: Array, net: Array) -> Array:
    return np.linalg.solve(M, net[..., None])[..., 0]


def _accelerated(
    net: Callable[..., Array], by: Callable[[Array, Array], Array] = _solved
) -> Callable[..., Array]:
    """Return forward_dynamics with another net torque or another way to divide by M."""

    def redo(M: Array, bias: Array, damping: Array, qd: Array, tau: Array) -> Array:
        return by(M, net(bias, damping * qd, tau))

    return redo


def _net(bias: Array, friction: Array, tau: Array) -> Array:
    return tau - bias - friction


def _diagonal(M: Array, net: Array) -> Array:
    return net / np.diagonal(M, axis1=-2, axis2=-1)


def _product(M: Array, net: Array) -> Array:
    return (M @ net[..., None])[..., 0]


FORWARD = _accelerated(_net)
_MOST = np.array([87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0])  # N m, of the motors

FORWARD_DYNAMICS = [
    Mistake(slug, says, _accelerated(net), "the acceleration with that torque")
    for slug, says, net in (
        (
            "damping-forgotten",
            "the damping is missing: the joints' friction takes damping times qd",
            lambda bias, friction, tau: tau - bias,
        ),
        (
            "damping-sign",
            "the damping drives the joints; it has to brake them",
            lambda bias, friction, tau: tau - bias + friction,
        ),
        (
            "bias-forgotten",
            "the bias is missing: without a torque the arm would not fall",
            lambda bias, friction, tau: tau - friction,
        ),
        (
            "bias-sign",
            "the bias is added; the torque has to overcome it before anything moves",
            lambda bias, friction, tau: tau + bias - friction,
        ),
        (
            "both-signs",
            "bias and damping are added; both take from the motors' torque",
            lambda bias, friction, tau: tau + bias + friction,
        ),
        (
            "bias-and-damping-forgotten",
            "bias and damping are both missing",
            lambda bias, friction, tau: tau,
        ),
        (
            "damping-sign-lost",
            "the speed counts without its sign: on a joint that turns backwards the "
            "damping pulls backwards, too; it has to brake it",
            lambda bias, friction, tau: tau - bias - np.abs(friction),
        ),
        (
            "torque-clipped",
            "the torque tau is cut to what the motors can give; here it counts as it "
            "is given",
            lambda bias, friction, tau: np.clip(tau, -_MOST, _MOST) - bias - friction,
        ),
        (
            "torque-clipped",
            "the torque tau is cut to 87 N m, what joint1's motor can give; here it "
            "counts as it is given",
            lambda bias, friction, tau: np.clip(tau, -87.0, 87.0) - bias - friction,
        ),
        (
            "torque-forgotten",
            "the motors' torque is missing: this is how the arm falls",
            lambda bias, friction, tau: -bias - friction,
        ),
    )
] + [
    Mistake(
        "damping-without-speed",
        "the damping is taken off as it is; it is a torque only when it is multiplied "
        "by qd",
        lambda M, bias, damping, qd, tau: _solved(M, tau - bias - damping),
        "the acceleration with that torque",
    ),
    Mistake(
        "damping-as-one-number",
        "the product damping @ qd is one number, the sum over all joints; each joint "
        "has its own friction, damping * qd",
        lambda M, bias, damping, qd, tau: _solved(
            M, tau - bias - np.sum(damping * qd, axis=-1, keepdims=True)
        ),
        "the acceleration with that torque",
    ),
    Mistake(
        "armature-twice",
        "the armature is added to M, where it is already since task 4.3",
        lambda M, *given: FORWARD(M + 0.1 * np.eye(7), *given),
        "the acceleration with M + 0.1 on the diagonal",
    ),
    Mistake(
        "mass-of-the-step",
        "M + h damping is how the simulator takes a step of h = 2 ms; the acceleration "
        "now needs M alone",
        lambda M, bias, damping, *given: FORWARD(
            M + 0.002 * damping[..., None] * np.eye(7), bias, damping, *given
        ),
        "the acceleration with M + h damping",
    ),
    Mistake(
        "velocity-returned",
        "this is the velocity after a step of 2 ms, qd + h qdd; the acceleration qdd "
        "was asked for",
        lambda M, bias, damping, qd, tau: (
            qd + 0.002 * FORWARD(M, bias, damping, qd, tau)
        ),
        "qd + 0.002 qdd",
    ),
    Mistake(
        "multiplied-by-M",
        "the net torque is multiplied by M; M times the acceleration is what it equals",
        _accelerated(_net, _product),
        "M times the net torque",
    ),
    Mistake(
        "diagonal-only",
        "only the diagonal of M is used; a torque at one joint accelerates the others, "
        "too",
        _accelerated(_net, _diagonal),
        "the net torque divided by the diagonal",
    ),
    Mistake(
        "mass-forgotten",
        "this is the net torque; M is missing",
        _accelerated(_net, lambda M, net: net),
        "the net torque",
    ),
    Mistake(
        "divided-entry-by-entry",
        "1 / M turns over each entry; that is not the inverse of a matrix",
        _accelerated(_net, lambda M, net: _product(1.0 / M, net)),
        "the product with 1 / M",
    ),
    Mistake(
        "damping-not-divided",
        "the damping is taken off after M has been divided by; it is a torque, too",
        lambda M, bias, damping, qd, tau: _solved(M, tau - bias) - damping * qd,
        "the difference of the two",
    ),
    Mistake(
        "only-torque-divided",
        "only the motors' torque is divided by M; bias and damping are torques, too",
        lambda M, bias, damping, qd, tau: _solved(M, tau) - bias - damping * qd,
        "the difference of the two",
    ),
]
