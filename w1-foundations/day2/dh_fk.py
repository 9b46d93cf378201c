"""2.9 `dh_fk(table, q)`: its questions and its mistakes."""

from functools import reduce

import numpy as np

from labkit.judge import Pose, Row
from labkit.judge.argument_mistakes import LEFT_OUT
from robo47.screws import dh_fk, dh_link

from . import places
from .arms import FAR, FRANKA

row = Row(
    Pose(wrong_way="maps world coordinates to flange coordinates"),
    unnamed=places.unnamed_row,
    measured=places.measured,
)


@row.inputs
def _(rng):
    """Return Franka's table at q = 0 and elsewhere, then other robots' tables."""
    own = [(FRANKA, q) for q in (np.zeros(7), FAR, *rng.configurations(5))]
    others = rng.numbers(-1.5, 1.5, 4, 8, 3)
    return own + list(zip(others, rng.numbers(-2, 2, 4, 7), strict=True))


def links(table, theta):
    """Return the links of as many rows as there are angles, (n, 4, 4)."""
    return [dh_link(*one, x) for one, x in zip(table, theta, strict=False)]


def product(Ts):
    """Return the poses multiplied from left to right."""
    return reduce(np.matmul, Ts, np.eye(4))


ONE_TABLE = "the lab has one table"


@row.wrongs(hidden={"flange-typed-in": ONE_TABLE, "table-not-used": ONE_TABLE})
def _(table, q):
    """flange-missing: your code omits the eighth row of the table, so it returns the
      pose of link7 instead of the flange pose
    flange-turned: your code uses the last joint's angle for the eighth row. Use the
      angle 0 for this row, because the flange does not rotate relative to link7
    theta-one-row-late: your code uses each angle one row too late. The angle of the
      first row should be `q[0]`, because this row belongs to joint1
    theta-one-row-early: your code uses the angles one row too early. The angle of the
      first row should be `q[0]`, because this row belongs to joint1
    product-reversed: your code multiplies the matrices in the reverse order. The matrix
      of the link nearest to the base belongs on the left
    multiplied-by-entries: your code multiplies the link matrices entry by entry. Use
      the matrix product instead
    last-link-only: your result is only the matrix of the last row. Multiply the
      matrices of all rows
    flange-typed-in: your code always uses Franka's eighth row. Use the last row of the
      argument `table`
    table-not-used: your code does not use the argument `table`, so the result is
      correct only for Franka's table. Read all parameters from `table`
    """
    theta = [*q, 0.0]
    return {
        "flange-missing": lambda: product(links(table, q)),
        "flange-turned": lambda: product(links(table, [*q, q[-1]])),
        "theta-one-row-late": lambda: product(links(table, [0.0, *q])),
        "theta-one-row-early": lambda: product(links(table, [*q[1:], 0.0, q[0]])),
        "product-reversed": lambda: product(links(table, theta)[::-1]),
        "multiplied-by-entries": lambda: np.prod(links(table, theta), axis=0),
        "last-link-only": lambda: dh_link(*table[-1], 0.0),
        "flange-typed-in": lambda: product(links([*table[:7], FRANKA[7]], theta)),
        "table-not-used": lambda: dh_fk(FRANKA, q),
    }


row.of_argument("q", LEFT_OUT)


for by in (1, -1):
    row.wrong(
        "alpha-of-the-neighbour",
        "in each row, your code uses the alpha of a neighbouring row. Use the alpha of "
        "the same row, because the table already follows Craig's convention",
    )(lambda table, q, by=by: dh_fk(np.c_[np.roll(table[:, 0], by), table[:, 1:]], q))
for names, order in (
    ("a, alpha, d", [1, 0, 2]),
    ("d, a, alpha", [2, 1, 0]),
    ("alpha, d, a", [0, 2, 1]),
    ("a, d, alpha", [2, 0, 1]),
    ("d, alpha, a", [1, 2, 0]),
):
    row.wrong(
        "columns-mixed-up",
        f"your code reads the columns of the table as ({names}). The correct order "
        "is (alpha, a, d)",
    )(lambda table, q, order=order: dh_fk(table[:, order], q))
row.reached_by("dh_link", "in every row, ", but=["theta-forgotten"])


@row.wrong("a-sign")  # The minus of row 5 taken for a slip of the pen.
def _(table, q):
    sign = np.ones_like(table)
    sign[4, 1] = -1
    return product(links(sign * table, [*q, 0.0]))
