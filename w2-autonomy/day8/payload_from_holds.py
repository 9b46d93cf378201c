"""8.8 `payload_from_holds(J_site, R_site, extra, g)`: questions and mistakes."""

import numpy as np

from labkit.judge import Vector
from labkit.judge.argument_mistakes import Change
from labkit.judge.row import Row
from robo47.identification import payload_from_holds
from robo47.screws import skew

from .states import DOWN, SWAP, hands

row = Row(Vector((4,), names=("m", "m cx", "m cy", "m cz")), near=1e-6)


@row.inputs
def _(rng):
    slide, extra = np.zeros((5, 6, 7)), np.zeros((5, 7))
    slide[:, 5, 0], extra[:, 0] = 1.0, 9.81
    return [(slide, np.array([np.eye(3)] * 5), extra, DOWN), *hands(rng)]


def solved(J_site, R_site, extra, g, sign=-1.0, moment=-1.0, order=None):
    """Return m and m c, with another sign of all, of the moment, or another order."""
    W = np.zeros((len(R_site), 6, 4))
    W[:, 3:, 0], W[:, :3, 1:] = g, moment * skew(g) @ R_site
    W = W if order is None else W[:, order]
    rows = sign * np.swapaxes(J_site, 1, 2) @ W
    return np.linalg.lstsq(rows.reshape(-1, 4), extra.reshape(-1), rcond=None)[0]


for slug, says, redone, other in (
    ("load-drives", "the sign is that of what the load does to the arm; the motors "
     "hold against it", "the right one with +J^T", {"sign": 1.0}),
    ("moment-sign", "the moment has the wrong sign: c x m g is -[g] m c, and its "
     "centre comes out on the other side", "with +[g] R", {"moment": 1.0}),
    ("force-first", "the wrench is (force; moment); J has its angular rows first",
     "the right one with its halves swapped", {"order": SWAP}),
):  # fmt: skip

    @row.wrong(slug, says, redone)
    def _(J_site, R_site, extra, g, other=other):
        return solved(J_site, R_site, extra, g, **other)


@row.wrongs
def _(J_site, R_site, extra, g):
    """R-forgotten: R is not in it: m c is taken to stand in world axes all along => the
      right one with R = I
    R-transposed: R is transposed: it takes the hand's axes to the world's => the right
      one with R^T
    """
    return {
        "R-forgotten": solved(J_site, np.array([np.eye(3)] * len(R_site)), extra, g),
        "R-transposed": solved(J_site, np.swapaxes(R_site, 1, 2), extra, g),
    }


@row.wrong
def holds_averaged(J_site, R_site, extra, g):
    """the holds are averaged before they are solved: seven rows are left of all, and
    what the poses tell apart is gone; stack them => the right one from the mean"""
    W = np.zeros((len(R_site), 6, 4))
    W[:, 3:, 0], W[:, :3, 1:] = g, -skew(g) @ R_site
    rows = (-np.swapaxes(J_site, 1, 2) @ W).mean(axis=0)
    return np.linalg.lstsq(rows, extra.mean(axis=0), rcond=None)[0]


@row.wrong
def first_hold_only(J_site, R_site, extra, g):
    """only the first hold is used; one pose does not show all four => the right one
    from the first"""
    return solved(J_site[:1], R_site[:1], extra[:1], g)


@row.wrong
def g_turned_after_the_cross(J_site, R_site, extra, g):
    """R stands on the left of [g]: m c is turned into the world first, so [g] R => with
    R [g]"""
    W = np.zeros((len(R_site), 6, 4))
    W[:, 3:, 0], W[:, :3, 1:] = g, -R_site @ skew(g)
    rows = -np.swapaxes(J_site, 1, 2) @ W
    return np.linalg.lstsq(rows.reshape(-1, 4), extra.reshape(-1), rcond=None)[0]


@row.wrong
def centre_for_first_moment(J_site, R_site, extra, g):
    """the last three are c; asked for is m c, which is what is linear => m, then c"""
    m, *h = payload_from_holds(J_site, R_site, extra, g)
    return np.append(m, np.array(h) / m)


row.of_argument(
    "g",
    Change(
        "gravity-typed-in",
        "9.81 downwards is typed in; gravity is the argument g",
        lambda g: DOWN,
        "what is found with that gravity",
    ),
)


@row.right  # A hold at a time, with cross products; then the normal equations.
def _(J_site, R_site, extra, g):
    A, b = np.zeros((4, 4)), np.zeros(4)
    for J, R, tau in zip(J_site, R_site, extra, strict=True):
        moments = [np.cross(axis, g) for axis in R.T]
        W = np.vstack([np.column_stack([np.zeros(3), *moments]), np.zeros((3, 4))])
        W[3:, 0] = g
        rows = -J.T @ W
        A, b = A + rows.T @ rows, b + rows.T @ tau
    return np.linalg.pinv(A, rcond=1e-12) @ b
