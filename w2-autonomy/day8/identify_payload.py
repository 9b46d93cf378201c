"""8.8 `identify_payload(J_site, R_site, extra, g)`: questions and mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from labkit.judge.argument_mistakes import TRANSPOSED, Change
from robo47.screws import skew

from .states import DOWN, SWAP, alike, hands

row = Row(Vector((4,), names=("m", "m cx", "m cy", "m cz")), near=1e-6)
row.same(
    "return np.linalg.lstsq(rows.reshape(-1, 4), extra.ravel(), rcond=None)[0] => "
    "return np.linalg.lstsq(rows.reshape(-2, 4), extra.ravel(), rcond=None)[0]",
    "NumPy takes any negative number for the one that it works out",
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


def rows(J_site, R_site, g, moment=-1.0, order=slice(None)):
    """Return what m and m c cost, the moment with another sign, or another order."""
    W = np.zeros((len(R_site), 6, 4))
    W[:, 3:, 0] = g
    W[:, :3, 1:] = moment * skew(g) @ R_site
    return -np.swapaxes(J_site, 1, 2) @ W[:, order]


def solved(Y, extra, rcond=None):
    """Return m and m c."""
    return np.linalg.lstsq(Y.reshape(-1, 4), extra.reshape(-1), rcond=rcond)[0]


@row.wrongs
def _(J_site, R_site, extra, g):
    """load-drives: the sign is that of what the load does to the arm; the motors hold
      against it => the right one with +J^T
    moment-sign: the moment has the wrong sign: c x m g is -[g] m c, and its centre
      comes out on the other side => the right one with +[g] R
    force-first: the wrench is (force; moment); J has its angular rows first
    R-forgotten: R is not in it: m c is taken to stand in world axes all along
    holds-averaged: the holds are averaged before they are solved: seven rows are left
      of all, and what the poses tell apart is gone; stack them
    first-hold-only: only the first hold is used; one pose does not show all four
    R-of-the-first-hold: the first hold's R is used for all; each pose has its own
    R-of-the-last-hold: the last hold's R is used for all; each pose has its own
    last-hold-only: only the last hold is used: what the loop made of the others is
      overwritten; stack them
    last-hold-missing: the last hold does not count: the loop ends one too early
    first-hold-missing: the first hold does not count: the loop starts one too late
    extra-by-joint: extra is read joint by joint, and the rows are stacked hold by hold:
      each pair is of two different torques => the right one with extra
      in that order
    reshaped: J_site is reshaped to (k, 7, 6), which only counts the numbers off anew;
      the transpose swaps the last two axes => the right one with J
      reshaped
    wrenches-first: each hold's torques are turned into a wrench, and the wrenches are
      fitted; what the motors measured are torques, so stack their rows => the fit to
      wrenches
    cut-too-high: small singular values are left out: what holds that are much alike
      show of m c is left out with them => the right one, cut
    cut-too-high 2: small singular values are left out: what holds that are much alike
      show of m c is left out with them => the right one, cut
    cut-too-high 3: small singular values are left out: what holds that are much alike
      show of m c is left out with them => the right one, cut
    solutions-averaged: each hold is solved alone, and the mean taken; one pose does not
      show all four, so stack them
    g-turned-after-the-cross: R stands on the left of [g]: m c is turned into the world
      first, so [g] R => the right one with
      R [g]
    weight-for-mass: the first is the weight, in newtons; over m stands g, and not its
      direction alone
    centre-for-first-moment: the last three are c; asked for is m c, which is what is
      linear => m, then c
    """
    Y = rows(J_site, R_site, g)
    left = Y.copy()
    left[..., 1:] = np.swapaxes(J_site[:, :3], 1, 2) @ R_site @ skew(g)
    right = solved(Y, extra)
    as_wrenches = np.linalg.pinv(np.swapaxes(J_site, 1, 2))
    return {
        "load-drives": -right,
        "moment-sign": solved(rows(J_site, R_site, g, moment=1.0), extra),
        "force-first": solved(rows(J_site, R_site, g, order=SWAP), extra),
        "R-forgotten": solved(rows(J_site, 0 * R_site + np.eye(3), g), extra),
        "holds-averaged": solved(Y.mean(axis=0), extra.mean(axis=0)),
        "first-hold-only": solved(Y[0], extra[0]),
        "R-of-the-first-hold": solved(rows(J_site, 0 * R_site + R_site[0], g), extra),
        "R-of-the-last-hold": solved(rows(J_site, 0 * R_site + R_site[-1], g), extra),
        "last-hold-only": solved(Y[-1], extra[-1]),
        "last-hold-missing": solved(Y[:-1], extra[:-1]),
        "first-hold-missing": solved(Y[1:], extra[1:]),
        "extra-by-joint": solved(Y, extra.T),
        "reshaped": solved(
            rows(np.swapaxes(J_site.reshape(-1, 7, 6), 1, 2), R_site, g), extra
        ),
        "wrenches-first": solved(as_wrenches @ Y, as_wrenches @ extra[..., None]),
        "cut-too-high": solved(Y, extra, 0.3),
        "cut-too-high 2": solved(Y, extra, 0.1),
        "cut-too-high 3": solved(Y, extra, 0.01),
        "solutions-averaged": np.mean(
            [solved(one, tau) for one, tau in zip(Y, extra, strict=True)], axis=0
        ),
        "g-turned-after-the-cross": solved(left, extra),
        "weight-for-mass": right * [np.linalg.norm(g), 1.0, 1.0, 1.0],
        "centre-for-first-moment": np.append(right[0], right[1:] / right[0]),
    }


TYPED_IN = Change(
    "gravity-typed-in",
    "9.81 downwards is typed in; gravity is the argument g",
    lambda g: DOWN,
)
DOWNWARDS = Change(
    "gravity-always-down",
    "only the size of g is used, and it is taken to point down; an arm may hang on a "
    "wall",
    lambda g: np.array([0.0, 0.0, -np.linalg.norm(g)]),
)
row.of_argument("g", TYPED_IN, DOWNWARDS)
row.of_argument("R_site", TRANSPOSED.called("R-transposed"))


@row.right  # A hold at a time, with cross products; then the normal equations.
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
