"""Kinds of answers that are matrices: Jacobians, mass matrices and others."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from labkit.judge.answer_mistakes import general
from labkit.judge.answers import difference, gap
from labkit.judge.kinds import NEAR, RIGHT, Kind, few_entries, one_factor
from labkit.judge.mistake import Finding, Mistake
from robo47.checks import Array


@dataclass(frozen=True)
class Matrix(Kind):
    """Any matrix. `Matrix((6, 6), rows=..., columns=...)`."""

    # What its rows are called, "omega x" and so on; else they are counted.
    rows: tuple[str, ...] = ()
    columns: tuple[str, ...] = ()  # likewise

    @property
    def expected(self) -> str:  # noqa: D102
        m, n = (n or "any" for n in self.shape)
        return f"a {m}x{n} matrix"

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        square = self.shape[0] == self.shape[1] is not None
        return general(*["transposed"] * square, *self.usual)

    def why_shape(self, got: tuple[int, ...]) -> str:  # noqa: D102
        if got == self.shape[::-1] != self.shape:
            return "rows and columns are swapped"
        return super().why_shape(got)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        return (
            few_entries(self, S, T)
            or one_factor(self, S, T)
            or Finding("off", f"It is off by up to {self.apart(S, T)}.")
        )


@dataclass(frozen=True)
class Jacobian(Matrix):
    """A Jacobian, (6, n): omega's rows above v's, one column per joint."""

    shape: tuple[int, ...] = (6, 7)

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        return general("rows-swapped", *self.usual)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        if found := one_factor(self, S, T):
            return found
        wrong = np.abs(S - T).max(axis=0) > RIGHT * self.scale
        bad = np.flatnonzero(wrong.any(axis=0))
        halves = np.flatnonzero(wrong.reshape(2, -1).any(axis=1))
        where = f" in its {('omega', 'v')[halves[0]]} rows" if len(halves) == 1 else ""
        if len(bad) == 1:
            says = f"Every column is right except joint {bad[0] + 1}'s"
        elif bad[0] > 0 and len(bad) == self.shape[1] - bad[0]:
            says = (
                f"The columns are right up to joint {bad[0]}, and wrong from there on"
            )
        else:
            says = "Half of it is right" if where else "It is not the right one"
        return Finding(
            "columns-off", f"{says}: off by up to {self.apart(S, T)}{where}."
        )


@dataclass(frozen=True)
class Symmetric(Matrix):
    """A symmetric matrix, such as a mass matrix. `Symmetric((7, 7), "kg m2")`."""

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        skew = float(np.abs(S - S.mT).max())
        if float(difference(S, S.mT, self.scale).max()) > NEAR:
            return Finding(
                "not-symmetric",
                f"It is not symmetric (by up to {skew:.3g}), and it has to be; it is "
                f"off by up to {self.apart(S, T)}.",
            )
        off = gap(S, T) / self.scale
        diagonal = np.eye(S.shape[-1], dtype=bool)
        if off[:, ~diagonal].max(initial=0.0) <= RIGHT:
            says = "Only the diagonal is wrong"
        elif off[:, diagonal].max() <= RIGHT:
            says = "The diagonal is right, the rest is not"
        else:
            return super().what_is_wrong(S, T)
        return Finding("part-off", f"{says}: off by up to {self.apart(S, T)}.")

    def measured(self, S: Array, T: Array) -> tuple[str, ...]:  # noqa: D102
        sym = 0.5 * (S + S.mT)
        least = np.linalg.eigvalsh(sym).min() if np.isfinite(S).all() else np.nan
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
        least = np.linalg.eigvalsh(S).min() if np.isfinite(S).all() else 0.0
        if one_factor(self, S, T) or least >= -NEAR * np.max(self.scale):
            return super().what_is_wrong(S, T)
        return Finding(
            "not-positive",
            f"It has a negative eigenvalue ({least:.3g}), so it is no covariance; off "
            f"by up to {self.apart(S, T)}.",
        )
