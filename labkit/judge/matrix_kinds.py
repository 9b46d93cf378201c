"""Kinds of answers that are matrices: Jacobians, mass matrices and others."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import permutations
from typing import Any

import numpy as np

from labkit.judge.answer_mistakes import general
from labkit.judge.answers import difference, gap, listed, say_error
from labkit.judge.kinds import NEAR, RIGHT, Kind, few_entries, one_factor
from labkit.judge.mistake import Finding, Mistake
from robo47.checks import Array

SWAPPED = "rows and columns are swapped"
COUNTED = ", counted from 0"
MOST_BLOCKS = 4  # of columns, up to which their other orders are tried


@dataclass(frozen=True)
class Matrix(Kind):
    """Any matrix. `Matrix((6, 6), rows=..., columns=...)`."""

    # What its rows are called, "omega x" and so on; else they are counted.
    rows: tuple[str, ...] = ()
    columns: tuple[str, ...] = ()  # likewise
    # Where the columns stand in blocks of one width: what each block is called.
    blocks: tuple[str, ...] = ()

    @property
    def expected(self) -> str:  # noqa: D102
        m, n = self.shape
        if m and n:
            return f"a {m}x{n} matrix"
        given = f"{m} rows" if m else f"{n} columns" if n else ""
        return "a matrix" + (f" with {given}" if given else "")

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        square = self.shape[0] == self.shape[1] is not None
        turned = "transposed" if square else "reshaped"
        found = general(*[turned] * (None not in self.shape), *self.usual)
        return [*found, *self._blocks_in_other_orders()]

    def _blocks_in_other_orders(self) -> Iterator[Mistake]:
        """Yield that the columns' blocks stand in another order, where they are few."""
        if not 1 < len(self.blocks) <= MOST_BLOCKS:
            return
        right = tuple(range(len(self.blocks)))
        for order in permutations(right):
            if order != right:
                names = ", ".join(self.blocks[i] for i in order)
                yield Mistake(
                    "blocks-in-another-order",
                    f"your blocks are in the order {names}. The correct order is "
                    f"{', '.join(self.blocks)}",
                    partial(_in_blocks, order=order),
                )

    def why_shape(self, got: tuple[int, ...]) -> str:  # noqa: D102
        if got == self.shape[::-1] != self.shape:
            return SWAPPED
        return super().why_shape(got)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        return (
            few_entries(self, S, T)
            or one_factor(self, S, T)
            or part_off(self, S, T)
            or part_empty(self, S, T)
            or Finding("off", say_error(self.apart(S, T)))
        )


def _in_blocks(answers: Array, order: Sequence[int]) -> Array:
    """Return answers, (n, rows, columns), with their blocks of columns in an order."""
    each = np.split(answers, len(order), axis=-1)
    return np.concatenate([each[i] for i in order], axis=-1)


def part_off(kind: Matrix, S: Array, T: Array) -> Finding | None:
    """Return which rows and columns hold all that is wrong, if others are right."""
    if None in kind.shape:
        return None
    wrong = (gap(S, T) / kind.scale > RIGHT).any(axis=0)
    parts = [_lines("row", kind.rows, wrong.any(axis=1)), _blocks(kind, wrong)]
    parts = [one for one in parts if one]
    if not parts:
        return None
    where = " of ".join(one.removesuffix(COUNTED) for one in parts)
    counted = COUNTED * any(one.endswith(COUNTED) for one in parts)
    says = f"All entries are correct except in {where}{counted}."
    off = say_error(kind.apart(S, T))
    alone = np.ndim(kind.scale) == 0
    if alone and (found := one_factor(kind, S[:, wrong], T[:, wrong])):
        off = found.message.replace("of the result", "of this part", 1)
    return Finding("part-off", f"{says} {off}")


def part_empty(kind: Matrix, S: Array, T: Array) -> Finding | None:
    """Return which part of a square matrix is 0 in every call, and should not be."""
    n, m = S.shape[1:]
    if n != m or len(S) < 2:
        return None
    wrong: Any = (gap(S, T) / kind.scale > RIGHT).any(axis=0)
    zero: Any = ~S.any(axis=0)
    for where, part in _parts(n):
        if zero[part].all() and wrong[part].all() and not (wrong & zero)[~part].any():
            says = f"{where} are 0 in every call. {say_error(kind.apart(S, T))}"
            return Finding("entries-empty", says)
    return None


def _parts(n: int) -> Iterator[tuple[str, Any]]:
    """Yield parts of a square matrix, in words and as a mask."""
    i = np.arange(n)
    above = i[:, None] < i
    yield "All entries off the diagonal", above | above.T
    yield "All entries above the diagonal", above
    yield "All entries below the diagonal", above.T
    if n % 2 == 0 and n > 2:
        right = np.kron([[0, 1], [0, 0]], np.ones((n // 2, n // 2))).astype(bool)
        yield "The upper right and the lower left blocks", right | right.T


def _blocks(kind: Matrix, wrong: Any) -> str:
    """Return which columns are wrong, in words, or "" where most are."""
    columns = wrong.any(axis=0)
    if not kind.blocks:
        return _lines("column", kind.columns, columns)
    each = columns.reshape(len(kind.blocks), -1)
    if 2 * each.any(axis=1).sum() <= len(each):
        names = [kind.blocks[i] for i in np.flatnonzero(each.any(axis=1))]
        return _of_names("column", names)
    within = _lines("column", kind.columns, each.any(axis=0))
    if within and not kind.columns:
        return f"{within.removesuffix(COUNTED)} of each block{COUNTED}"
    return within


def _lines(side: str, names: tuple[str, ...], wrong: Any) -> str:
    """Return rows or columns, in words, or "" where most of them are wrong."""
    at = np.flatnonzero(wrong)
    if not 0 < 3 * len(at) <= 2 * len(wrong):
        return ""
    first, last = int(at[0]), int(at[-1])
    if names and len(at) <= 4:
        called = [names[i].removeprefix(f"the {side} of ") for i in at]
        return _of_names(side, called)
    if len(at) == last - first + 1:
        counted = f"{first} to {last}" if last > first else str(first)
        return f"{side}{'s' * (last > first)} {counted}{COUNTED}"
    counted = listed(list(map(str, at)))
    return f"{side}s {counted}{COUNTED}" if len(at) <= 4 else ""


def _of_names(side: str, names: Sequence[str]) -> str:
    """Return rows or columns by their names: "the rows v_x and v_y"."""
    of = " of" * any(name.startswith("the ") for name in names)
    return f"the {side}{'s' * (len(names) > 1)}{of} {listed(names)}"


@dataclass(frozen=True)
class Jacobian(Matrix):
    """A Jacobian, (6, n): omega's rows above v's, one column per joint."""

    shape: tuple[int, ...] = (6, 7)

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        return general("rows-swapped", "reshaped", *self.usual)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        if found := one_factor(self, S, T):
            return found
        wrong = gap(S, T).max(axis=0) > RIGHT * self.scale
        bad = np.flatnonzero(wrong.any(axis=0))
        halves = np.flatnonzero(wrong.reshape(2, -1).any(axis=1))
        half = ("omega", "v")[halves[0]] if len(halves) == 1 else ""
        if len(bad) == 1:
            says = f"Every column is correct except the column of joint {bad[0] + 1}."
        elif bad[0] > 0 and len(bad) == self.shape[1] - bad[0]:
            says = f"The columns are correct up to joint {bad[0]}, but not all later"
            says += " columns."
        else:
            says = ""
        if half:
            says += f" Only the {half} rows are wrong."
        says += f" {say_error(self.apart(S, T))}"
        return Finding("columns-off", says.strip())


@dataclass(frozen=True)
class Symmetric(Matrix):
    """A symmetric matrix, such as a mass matrix. `Symmetric((7, 7), "kg m2")`."""

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        skew = float(np.abs(S - S.mT).max())
        if float(difference(S, S.mT, self.scale).max()) > NEAR:
            return Finding(
                "not-symmetric",
                "The result should be symmetric, but it differs from its transpose by "
                f"{skew:.3g}. {say_error(self.apart(S, T))}",
            )
        found = few_entries(self, S, T) or one_factor(self, S, T)
        if found := found or part_off(self, S, T):
            return found
        off = gap(S, T) / self.scale
        diagonal = np.eye(S.shape[-1], dtype=bool)
        if off[:, ~diagonal].max(initial=0.0) <= RIGHT:
            says = "Only the diagonal is wrong."
        elif off[:, diagonal].max() <= RIGHT:
            every = (off.max(axis=0) > RIGHT)[~diagonal].all()
            says = "Only the diagonal is correct."
            if not every:
                says = "The diagonal is correct, but other entries are not."
        else:
            return super().what_is_wrong(S, T)
        return Finding("part-off", f"{says} {say_error(self.apart(S, T))}")

    def measured(self, S: Array, T: Array) -> tuple[str, ...]:  # noqa: D102
        least = least_eigenvalue(0.5 * (S + S.mT))
        return (*super().measured(S, T), f"smallest eigenvalue {least:.3g}")


@dataclass(frozen=True)
class Covariance(Symmetric):
    """A covariance, compared up to what rounding leaves of its symmetry."""

    def plain(self, answer: Array) -> Array:  # noqa: D102
        skew = np.abs(answer - answer.T) / self.scale
        return 0.5 * (answer + answer.T) if (skew <= NEAR).all() else answer

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        blocks = ["blocks-swapped"] * (self.shape == (6, 6))
        return general("inverse", "sigma-for-variance", *blocks, *self.usual)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        least = least_eigenvalue(S)
        if one_factor(self, S, T) or not least < -NEAR * np.max(self.scale):
            return super().what_is_wrong(S, T)
        return Finding(
            "not-positive",
            f"The result has a negative eigenvalue ({least:.3g}), so it is not a "
            f"covariance. {say_error(self.apart(S, T))}",
        )


def least_eigenvalue(S: Array) -> float:
    """Return the smallest eigenvalue of symmetric matrices, NaN where there is none."""
    if not np.isfinite(S).all():
        return np.nan
    try:
        return float(np.linalg.eigvalsh(S).min())
    except np.linalg.LinAlgError:  # of entries near the largest number that there is
        return np.nan
