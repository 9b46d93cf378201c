"""Mistakes in task 2.9: `dh_fk(table, q)`, a product of links.

`redo` takes tables (n, 8, 3) and q (n, 7).
"""

import numpy as np

from labkit.judge.chain import product
from labkit.judge.mistake import Mistake, lifted
from robo47.checks import Array

from .links import DH_LINK, link
from .moves import Function, factors, without

# Franka's published table: alpha, a, d.
FRANKA = np.array([
    [0.0, 0.0, 0.333],
    [-np.pi / 2, 0.0, 0.0],
    [np.pi / 2, 0.0, 0.316],
    [np.pi / 2, 0.0825, 0.0],
    [-np.pi / 2, -0.0825, 0.384],
    [np.pi / 2, 0.0, 0.0],
    [np.pi / 2, 0.088, 0.0],
    [0.0, 0.0, 0.107],
])  # fmt: skip


def rows(table: Array, theta: Array, step: Function = link) -> list[Array]:
    """Return the links of tables (n, m, 3) at theta (n, m), (n, 4, 4) each."""
    return factors(step, *np.moveaxis(table, -1, 0), theta)


def with_flange(q: Array) -> Array:
    """Return theta of all eight rows: the flange's is 0."""
    return np.concatenate([q, np.zeros((len(q), 1))], axis=1)


def dh(table: Array, q: Array, step: Function = link) -> Array:
    """Return the product of a table's rows, (n, 4, 4)."""
    return product(rows(table, with_flange(q)[:, : table.shape[1]], step), len(q))


def _rolled(table: Array, column: int, by: int) -> Array:
    out = table.copy()
    out[..., column] = np.roll(table[..., column], by, axis=1)
    return out


def _late(table: Array, q: Array) -> Array:
    """Return the product in which theta is one row late: 0 for the first."""
    return product(rows(table, np.roll(with_flange(q), 1, axis=1)), len(q))


def _early(table: Array, q: Array) -> Array:
    """Return the product in which theta is one row early."""
    return product(rows(table, np.roll(with_flange(q), -1, axis=1)), len(q))


def _last_angle_again(table: Array, q: Array) -> Array:
    theta = np.concatenate([q, q[:, -1:]], axis=1)
    return product(rows(table, theta), len(q))


DH_FK = [
    Mistake(
        "flange-missing",
        "the eighth row is missing: your pose is that of link7, not the flange's",
        lambda table, q: dh(table[:, :7], q),
        "the product of seven rows",
    ),
    Mistake(
        "flange-turned",
        "the eighth row is turned by the last joint's angle again; the flange does not "
        "turn",
        _last_angle_again,
        "the product with q[6] twice",
    ),
    Mistake(
        "flange-typed-in",
        "the eighth row is typed in as Franka's; with another table it is another one",
        lambda table, q: dh(table[:, :7], q) @ link(*FRANKA[7], np.zeros(1)),
        "the product with Franka's eighth row",
    ),
    Mistake(
        "table-not-used",
        "with Franka's table it is right, with another one it is wrong: the argument "
        "table is not used",
        lambda table, q: dh(np.broadcast_to(FRANKA, table.shape), q),
        "the product of Franka's own rows",
    ),
    Mistake(
        "theta-one-row-late",
        "theta is one row late: the first row is joint1's, and gets q[0]",
        _late,
        "the product with 0 first",
    ),
    Mistake(
        "theta-one-row-early",
        "theta is one row early: the first row is joint1's, and gets q[0]",
        _early,
        "the product with q[1] first",
    ),
    Mistake(
        "product-reversed",
        "the links stand in the reverse order: the one nearest to the base belongs on "
        "the left",
        lambda table, q: product(rows(table, with_flange(q))[::-1], len(q)),
        "the product in reverse",
    ),
    *(
        Mistake(
            "alpha-of-the-neighbour",
            "each row's alpha is its neighbour's: tables for the other convention have "
            "alpha one row earlier, this one does not",
            lambda table, q, by=by: dh(_rolled(table, 0, by), q),
            "the product with that column shifted",
        )
        for by in (1, -1)
    ),
    *(
        Mistake(
            "columns-mixed-up",
            f"the columns are read as ({', '.join(names)}); they are (alpha, a, d)",
            lambda table, q, order=order: dh(table[..., order], q),
            "the product with the columns read so",
        )
        for names, order in (
            (("a", "alpha", "d"), [1, 0, 2]),
            (("d", "a", "alpha"), [2, 1, 0]),
            (("alpha", "d", "a"), [0, 2, 1]),
            (("a", "d", "alpha"), [2, 0, 1]),
            (("d", "alpha", "a"), [1, 2, 0]),
        )
    ),
    Mistake(
        "joints-left-out",
        "no joint turns: whatever q is, your pose is the one at q = 0",
        lambda table, q: dh(table, np.zeros_like(q)),
        "the pose at q = 0",
    ),
    Mistake(
        "multiplied-by-entries",
        "the links are multiplied entry by entry, not as matrices",
        lambda table, q: np.prod(rows(table, with_flange(q)), axis=0),
        "the product by entries",
    ),
    Mistake(
        "last-link-only",
        "only the last row counts: what the others do is overwritten",
        lambda table, q: rows(table, with_flange(q))[-1],
        "the eighth link alone",
    ),
    *lifted(
        without(DH_LINK, "a-and-d-swapped", "theta-forgotten"),
        "in every row, ",
        lambda redo: lambda table, q: dh(table, q, redo),
    ),
]
