"""8.8 `identify_payload(J_site, R_site, extra, g)`: questions and mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.screws import skew

from .states import DOWN, SWAP, alike, hands

row = Row(Vector((4,), names=("m", "m cx", "m cy", "m cz")), near=1e-6)
row.same(
    "return np.linalg.lstsq(rows.reshape(-1, 4), extra.ravel(), rcond=None)[0] => "
    "return np.linalg.lstsq(rows.reshape(-2, 4), extra.ravel(), rcond=None)[0]",
    "in a shape NumPy infers the size for any negative number",
)


@row.inputs
def _(rng):
    slide = np.zeros((5, 6, 7))
    extra = np.zeros((5, 7))
    slide[:, 5, 0], extra[:, 0] = 1.0, 9.81
    return [
        (slide, np.array([np.eye(3)] * 5), extra, DOWN),
        alike(rng),
        *hands(rng),
        *hands(rng, 4, 2),
    ]


def rows(J_site, R_site, g, order=slice(None)):
    """Return the regressor of m and m c, with the rows of the wrench in an order."""
    W = np.zeros((len(R_site), 6, 4))
    W[:, 3:, 0] = g
    W[:, :3, 1:] = -skew(g) @ R_site
    return -np.swapaxes(J_site, 1, 2) @ W[:, order]


def solved(Y, extra, rcond=None):
    """Return the least-squares solution, m and m c."""
    return np.linalg.lstsq(Y.reshape(-1, 4), extra.reshape(-1), rcond=rcond)[0]


@row.wrongs
def _(J_site, R_site, extra, g):
    """load-drives: your code returns the parameters with the wrong sign. The motors
      balance the payload, so `extra` is minus the torque that the weight of the payload
      causes
    force-first: your code uses wrenches in the order (force; moment). Put the moment
      first, because the first three rows of each matrix in J_site are angular
    holds-averaged: your code averages the equations of all poses before the fit, so
      only seven equations remain. Stack the rows of all poses instead
    first-hold-only: your code uses only the first pose. One pose does not determine all
      four parameters, so stack the rows of all poses instead
    last-hold-only: your code uses only the last pose. One pose does not determine all
      four parameters, so stack the rows of all poses instead
    extra-by-joint: in your result, the torques are ordered joint by joint, but the rows
      of the regressor are ordered pose by pose. Use the same order for both
    reshaped: your result uses each matrix of J_site reshaped to (7, 6), which is not
      its transpose. Use J^T instead
    wrenches-first: your result is a fit to wrenches that are computed from each pose's
      torques. Fit the torques themselves, because they are the measured quantities
    cut-too-high: your code omits small singular values. Keep these values, because they
      determine part of m c if the poses differ only slightly
    solutions-averaged: your result is the mean of the solutions for the individual
      poses. One pose does not determine all four parameters, so stack the rows of all
      poses
    weight-for-mass: your code returns the weight in newtons instead of the mass. Return
      the mass in kilograms, as from a fit whose column for m contains g itself and not
      only its direction
    centre-for-first-moment: your code returns the centre of mass c in the last three
      entries. Return the first moment m c instead, because the equations are linear in
      m c
    """
    Y = rows(J_site, R_site, g)
    right = solved(Y, extra)
    as_wrenches = np.linalg.pinv(np.swapaxes(J_site, 1, 2))
    return {
        "load-drives": -right,
        "force-first": solved(rows(J_site, R_site, g, order=SWAP), extra),
        "holds-averaged": solved(Y.mean(axis=0), extra.mean(axis=0)),
        "first-hold-only": solved(Y[0], extra[0]),
        "last-hold-only": solved(Y[-1], extra[-1]),
        "extra-by-joint": solved(Y, extra.T),
        "reshaped": solved(
            rows(np.swapaxes(J_site.reshape(-1, 7, 6), 1, 2), R_site, g), extra
        ),
        "wrenches-first": solved(as_wrenches @ Y, as_wrenches @ extra[..., None]),
        "cut-too-high": solved(Y, extra, 0.01),
        "solutions-averaged": np.mean(
            [solved(one, tau) for one, tau in zip(Y, extra, strict=True)], axis=0
        ),
        "weight-for-mass": right * [np.linalg.norm(g), 1.0, 1.0, 1.0],
        "centre-for-first-moment": np.append(right[0], right[1:] / right[0]),
    }


@row.wrongs
def _(J_site, R_site, extra, g):
    """g-not-turned-back: your moments contain R g instead of R^T g. Multiply g by R^T
      to express it in the hand frame, because R maps from the hand frame to the world
      frame
    moment-in-the-hand: your code expresses the moment in the hand frame. Multiply the
      moment by R, because J_site requires a moment in the world frame
    """

    def fitted(moments):
        rows = np.zeros((len(extra), 6, 4))
        rows[:, 3:, 0] = -g
        rows[:, :3, 1:] = moments
        lhs = np.einsum("kij,kil->kjl", J_site, rows).reshape(-1, 4)
        return np.linalg.lstsq(lhs, extra.ravel(), rcond=None)[0]

    return {
        "g-not-turned-back": fitted([R @ skew(R @ g) for R in R_site]),
        "moment-in-the-hand": fitted([skew(R.T @ g) for R in R_site]),
    }


@row.right  # Pose by pose, with cross products; then the normal equations.
def _(J_site, R_site, extra, g):
    A = np.zeros((4, 4))
    b = np.zeros(4)
    for J, R, tau in zip(J_site, R_site, extra, strict=True):
        moments = np.cross(R.T, g).T
        none = np.zeros((3, 1))
        rows = -J.T @ np.block([[none, moments], [g[:, None], 0 * R]])
        A, b = A + rows.T @ rows, b + rows.T @ tau
    return np.linalg.pinv(A, rcond=1e-12) @ b


row.spans(  # as small, or as large, as in the lab
    extra=(lambda extra: 0.1 * extra,),
)
