"""Mistakes in tasks 4.8 `forward_dynamics` and 4.9 `energy`."""

from collections.abc import Callable

import numpy as np

from robo47.checks import Array
from robo47.diagnose.mistake import Mistake

from .gravity import OTHER_GRAVITY


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
        "only-torque-divided",
        "only the motors' torque is divided by M; bias and damping are torques, too",
        lambda M, bias, damping, qd, tau: _solved(M, tau) - bias - damping * qd,
        "the difference of the two",
    ),
]


def _moving(M: Array, qd: Array) -> Array:
    return 0.5 * np.sum(qd * _product(M, qd), axis=-1)


def _lifted(masses: Array, coms: Array, g: Array) -> Array:
    return -np.einsum("nl,nla,na->n", masses, coms, g)


def _both(
    kinetic: Callable[..., Array] = _moving, potential: Callable[..., Array] = _lifted
) -> Callable[..., Array]:
    def redo(M: Array, qd: Array, masses: Array, coms: Array, g: Array) -> Array:
        return np.stack([kinetic(M, qd), potential(masses, coms, g)], axis=-1)

    return redo


def _total_mass(m: Array, coms: Array, g: Array) -> Array:
    return -m.sum(-1) * np.einsum("nla,na->n", coms, g)


ENERGY = [
    Mistake(
        "half-forgotten",
        "the kinetic energy has no 1/2",
        _both(lambda M, qd: 2 * _moving(M, qd)),
        "the answer with twice as much",
    ),
    Mistake(
        "potential-sign",
        "the potential energy has the wrong sign: g points down, and what is lifted "
        "gains",
        _both(potential=lambda *given: -_lifted(*given)),
        "the answer with that sign",
    ),
    Mistake(
        "diagonal-only",
        "the kinetic energy takes only the diagonal of M; the joints share their links",
        _both(lambda M, qd: _moving(M * np.eye(M.shape[-1]), qd)),
        "the answer with the diagonal",
    ),
    Mistake(
        "speed-squared-too-early",
        "qd is squared before M is applied; qd stands on both sides of M",
        _both(lambda M, qd: 0.5 * _product(M, qd**2).sum(-1)),
        "the answer with M qd^2",
    ),
    Mistake(
        "mass-matrix-forgotten",
        "the kinetic energy takes no mass: M is missing",
        _both(lambda M, qd: 0.5 * (qd**2).sum(-1)),
        "the answer with qd.qd / 2",
    ),
    Mistake(
        "masses-forgotten",
        "the potential energy takes no masses",
        _both(potential=lambda m, c, g: _lifted(np.ones_like(m), c, g)),
        "the answer with 1 kg each",
    ),
    Mistake(
        "every-mass-everywhere",
        "every link's centre is multiplied by the whole arm's mass",
        _both(potential=_total_mass),
        "the answer with the total mass",
    ),
    Mistake(
        "order-swapped",
        "potential energy comes first; kinetic was asked for first",
        lambda *given: _both()(*given)[:, ::-1],
        "the two swapped",
    ),
    *(
        Mistake(
            slug,
            says,
            _both(potential=lambda m, c, g, pull=pull: _lifted(m, c, pull(g))),
            "the answer with that gravity",
        )
        for slug, says, pull in OTHER_GRAVITY
    ),
]
