"""Kinds of answers that are counts, choices, paths, or what a camera sees."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from labkit.base.text import count
from labkit.judge.compare import difference
from labkit.judge.kinds import NEAR, TRUNCATED, Kind, Scalar, one_factor
from labkit.judge.matrix_kinds import Matrix
from labkit.judge.mistake import Finding, Mistake
from robo47.checks import Array

INVERTED = Mistake(
    "inverted",
    "True and False are swapped",
    lambda answer: 1.0 - answer,
    "the right one turned round",
)
ROWS_FIRST = Mistake(
    "row-first",
    "a pixel is (column, row), x before y; here the row comes first",
    lambda answer: answer[..., ::-1],
    "the right one with its two columns swapped",
)
UPSIDE_DOWN = Mistake(
    "upside-down",
    "the image stands on its head: row 0 is the top one",
    lambda image: image[:, ::-1],
    "the right one with its rows reversed",
)
MIRRORED = Mistake(
    "mirrored",
    "left and right are swapped",
    lambda image: image[:, :, ::-1],
    "the right one with its columns reversed",
)
BLUE_FIRST = Mistake(
    "blue-first",
    "the colours are (blue, green, red); here red comes first",
    lambda image: image[..., ::-1],
    "the right one with its colours reversed",
)


@dataclass(frozen=True)
class Count(Scalar):
    """How many: one whole number."""

    empty = False
    expected = "a whole number"

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        return ()

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        i = int(np.argmax(S != T))
        if np.any(np.round(S) != S):
            return Finding("not-whole", f"It is {S[i]:g}; {self.expected} is expected.")
        return Finding("miscounted", f"It is {S[i]:.0f} where {T[i]:.0f} is right.")


@dataclass(frozen=True)
class Mask(Kind):
    """True or False, one or many. `Mask((8,))`."""

    empty = False

    @property
    def expected(self) -> str:  # noqa: D102
        where = f", in shape {self.shape},".replace("None", "any")
        return f"True or False{where if self.shape else ''}"

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        return (INVERTED,)

    def apart(self, S: Array, T: Array) -> str:  # noqa: D102
        return f"{np.mean(S != T):.0%} of them"

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        if (odd := S[(S != 0) & (S != 1)]).size:
            says = f"It is {odd[0]:g}; {self.expected} is expected."
            return Finding("not-true-or-false", says)
        yes, no = int(np.sum((S == 1) & (T == 0))), int(np.sum((S == 0) & (T == 1)))
        parts = [f"True {count(yes, 'time')} where False is right"] * (yes > 0)
        parts += [f"False {count(no, 'time')} where True is right"] * (no > 0)
        slug = "both-ways" if yes and no else f"too-{'often' if yes else 'seldom'}-true"
        return Finding(slug, f"It is {', and '.join(parts)}.")


@dataclass(frozen=True)
class Waypoints(Matrix):
    """A path of any length, a row per way point. `Waypoints((None, 7), "rad")`."""

    shape: tuple[int | None, ...] = (None, 7)

    @property
    def expected(self) -> str:  # noqa: D102
        return f"a path, with a row of {self.shape[1]} numbers per way point"

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        off = np.abs(S - T) / self.scale > NEAR
        first = int(np.argmax(off.any(axis=(0, 2))))
        says = f"It is right before way point {first}, counted from 0, and wrong there"
        says = says if first else "It is wrong from its first way point on"
        return Finding("off", f"{says}: off by up to {self.apart(S, T)}.")


@dataclass(frozen=True)
class Pixels(Kind):
    """Where points are seen, (n, 2): x to the right, y down, in pixels."""

    shape: tuple[int | None, ...] = (None, 2)
    unit: str = "px"
    scale: float | Array = 100.0
    expected = "a pixel (x, y) per point"

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        return (ROWS_FIRST, TRUNCATED)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        there = (S != 0).any(axis=-1) | (T != 0).any(axis=-1)  # no filling up
        off = (S - T)[there]
        if (
            difference(off[:, None], np.broadcast_to(off[:1], (len(off), 1, 2))).max()
            < NEAR
        ):
            says = f"Every pixel is off by the same ({off[0, 0]:.3g}, {off[0, 1]:.3g})."
            return Finding("shifted", says)
        return one_factor(self, S, T) or super().what_is_wrong(S, T)


@dataclass(frozen=True)
class Image(Kind):
    """An image, (rows, columns) or (rows, columns, 3). `Image((48, 64), "m")`."""

    @property
    def expected(self) -> str:  # noqa: D102
        colours = " of three colours" if len(self.shape) == 3 else ""
        return f"an image of {self.shape[0]} rows and {self.shape[1]} columns{colours}"

    def why_shape(self, got: tuple[int, ...]) -> str:  # noqa: D102
        if got[:2] == self.shape[1::-1] != self.shape[:2]:
            return "rows come first, then columns"
        return super().why_shape(got)

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        colours = [BLUE_FIRST] * (len(self.shape) == 3)
        return (UPSIDE_DOWN, MIRRORED, *colours, TRUNCATED)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        if found := one_factor(self, S, T):
            return found
        wrong = (
            (np.abs(S - T) / self.scale > NEAR).reshape(*S.shape[:3], -1).any(axis=3)
        )
        rows, columns = (
            np.flatnonzero(wrong.any(axis=axis)) for axis in ((0, 2), (0, 1))
        )
        where = f"rows {rows[0]} to {rows[-1]}, columns {columns[0]} to {columns[-1]}"
        says = f"{wrong.mean():.2g} of the pixels are wrong ({where})"
        return Finding("pixels-off", f"{says}: off by up to {self.apart(S, T)}.")
