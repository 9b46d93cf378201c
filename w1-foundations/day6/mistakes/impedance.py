"""Mistakes in task 6.7 `impedance_torque(J, wrench, bias, damping, qd, tau_null)`."""

import numpy as np

from . import named
from .inertias import SWAP

pinv = np.linalg.pinv

IMPEDANCE_TORQUE = [
    named(
        "bias-twice",
        "bias is added twice",
        lambda J, F, b, d, qd, n: J.T @ F + 2.0 * b + d * qd + n,
        "the right one with 2 bias",
    ),
    named(
        "bias-forgotten",
        "bias is missing: the arm sags under its weight, decimetres at a soft hand",
        lambda J, F, b, d, qd, n: J.T @ F + d * qd + n,
        "the right one without bias",
    ),
    named(
        "bias-sign",
        "bias is taken away; your torques have to hold it, so it is added",
        lambda J, F, b, d, qd, n: J.T @ F - b + d * qd + n,
        "the right one with -bias",
    ),
    named(
        "damping-forgotten",
        "the joints' damping is not made up for",
        lambda J, F, b, d, qd, n: J.T @ F + b + n,
        "the right one without damping qd",
    ),
    named(
        "damping-sign",
        "the joints' damping is taken away: the joints rub already, so your torques "
        "have to make up for it",
        lambda J, F, b, d, qd, n: J.T @ F + b - d * qd + n,
        "the right one with -damping qd",
    ),
    named(
        "damping-without-qd",
        "damping is added as it is; it is a torque only once it is times qd",
        lambda J, F, b, d, qd, n: J.T @ F + b + d + n,
        "the right one with damping for damping qd",
    ),
    named(
        "wrench-sign",
        "the wrench has the wrong sign: the hand pulls where it should push",
        lambda J, F, b, d, qd, n: -J.T @ F + b + d * qd + n,
        "the right one with -J^T F",
    ),
    named(
        "wrench-forgotten",
        "the wrench is missing: the hand floats",
        lambda J, F, b, d, qd, n: b + d * qd + n,
        "the right one without J^T F",
    ),
    named(
        "pinv-for-transpose",
        "pinv(J) takes the wrench to the joints; pushes go to torques with J^T, and "
        "the pseudo-inverse is for speeds",
        lambda J, F, b, d, qd, n: pinv(J) @ F + b + d * qd + n,
        "the right one with pinv(J)",
    ),
    named(
        "null-forgotten",
        "tau_null is missing: nothing holds the elbow back",
        lambda J, F, b, d, qd, n: J.T @ F + b + d * qd,
        "the right one without tau_null",
    ),
    named(
        "null-sign",
        "tau_null is taken away; it is a torque to add",
        lambda J, F, b, d, qd, n: J.T @ F + b + d * qd - n,
        "the right one with -tau_null",
    ),
    named(
        "halves-swapped",
        "the wrench is read as (force; moment); the moment comes first",
        lambda J, F, b, d, qd, n: J.T @ F[SWAP] + b + d * qd + n,
        "the right one with its halves swapped",
    ),
]
