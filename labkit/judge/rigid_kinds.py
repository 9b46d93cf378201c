"""Kinds of answers that are rotations or poses."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from labkit.judge.answer_mistakes import OF_A_ROTATION, of_a_pose
from labkit.judge.answers import (
    RIGID,
    degrees,
    difference,
    in_calls,
    matches,
    millimetres,
    rigid,
    say_degrees,
    say_error,
    say_mm,
    say_range,
)
from labkit.judge.kinds import NEAR, RIGHT, Kind, few_entries
from labkit.judge.matrices import split
from labkit.judge.mistake import Finding, Mistake
from robo47.checks import Array

NOT_THIS = "Your rotation matrix is valid, but it is not the correct one."


@dataclass(frozen=True)
class Rotation(Kind):
    """A rotation matrix, (3, 3)."""

    shape: tuple[int, ...] = (3, 3)
    expected = "a 3x3 matrix"
    misfits: ClassVar = {
        (2, 2): "a rotation in space also has a row and a column for z",
        (4, 4): "return only the rotation",
    }

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        return OF_A_ROTATION

    def apart(self, S: Array, T: Array) -> str:  # noqa: D102
        found = say_degrees(degrees(S, T)) if rigid(S) and rigid(T) else "0"
        return super().apart(S, T) if found == "0" else found

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        return few_entries(self, S, T) or rotation_wrong(S, T)

    def measured(self, S: Array, T: Array) -> tuple[str, ...]:  # noqa: D102
        det = np.linalg.det(S)
        lines = [
            f"R R^T - I: {_skew(S):.2g}; det R: {det.min():.4g} to {det.max():.4g}"
        ]
        if not _skew(S) > RIGID:
            lines.append(f"R off by {say_range(degrees(S, T), say_degrees)}")
        return tuple(lines)


@dataclass(frozen=True)
class Pose(Kind):
    """A rigid transform, (4, 4)."""

    shape: tuple[int, ...] = (4, 4)
    # What its rotation does when it is transposed.
    wrong_way: str = "rotates in the opposite direction"
    expected = "a 4x4 matrix"
    misfits: ClassVar = {
        (3, 4): "the bottom row (0, 0, 0, 1) is missing",
        (3, 3): "your array is only the rotation",
    }

    def general(self) -> Sequence[Mistake]:  # noqa: D102
        return of_a_pose(self.wrong_way)

    def apart(self, S: Array, T: Array) -> str:  # noqa: D102
        if not (rigid(S) and rigid(T)):
            return super().apart(S, T)
        (R_S, t_S), (R_T, t_T) = split(S), split(T)
        parts = say_mm(millimetres(t_S, t_T)), say_degrees(degrees(R_S, R_T))
        found = " and ".join(p for p in parts if p != "0")
        return found or super().apart(S, T)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        if found := few_entries(self, S, T, 3):
            return found
        (R, t), (R_true, t_true) = split(S), split(T)
        if (off := _bottom(S)).max() > NEAR:
            row = ", ".join(f"{x:z.3g}" for x in S[np.argmax(off), 3])
            says = (
                f"The bottom row is ({row}), not (0, 0, 0, 1), so the matrix is not a "
            )
            return Finding("bottom-row", f"{says}pose.")
        t_off = say_mm(millimetres(t, t_true))
        if difference(R, R_true).max() <= RIGHT and t_off != "0":
            says = "The rotation is correct in every call, but the translation is not."
            return Finding("translation-off", f"{says} {say_error(t_off)}")
        slug, message = rotation_wrong(R, R_true)
        if t_off == "0":
            return Finding(slug, f"The translation is correct. {message}")
        if slug == "rotation-off":
            slug, message = "pose-off", NOT_THIS
        error = say_error(self.apart(S, T))
        return Finding(slug, f"{message} The translation is wrong, too. {error}")

    def measured(self, S: Array, T: Array) -> tuple[str, ...]:  # noqa: D102
        (R, t), (R_T, t_T) = split(S), split(T)
        moved = say_range(millimetres(t, t_T), say_mm)
        return (
            *Rotation().measured(R, R_T),
            f"t off by {moved}; bottom row by {_bottom(S).max():.2g}",
        )


def rotation_wrong(S: Array, T: Array) -> Finding:
    """Return what is wrong with rotations, (n, 3, 3)."""
    if (off := _skew(S)) > RIGID:
        far = np.abs(S @ S.mT - np.eye(3)).max(axis=(1, 2))
        worst = f"{np.round(np.linalg.det(S[np.argmax(far)]), 6):z.3g}"
        size = "" if worst == "1" else f"; det R is {worst}, not 1"
        return Finding(
            "not-orthonormal",
            "Your rotation matrix R is not valid, because its columns are not "
            "orthonormal. "
            f"(R R^T differs from the identity matrix by {off:.2g}{size}.)",
        )
    X = np.abs(T.mT @ S)
    if matches(X, np.broadcast_to(np.round(X[0]), X.shape)):
        return Finding(
            "axes-mixed-up",
            "The columns of your rotation matrix R are the correct axes, but swapped "
            f"or with a wrong sign. (det R is {np.linalg.det(S[0]):z.0f}.)",
        )
    if mirrored := np.sum(np.linalg.det(S) < 0.0):
        return Finding(
            "left-handed",
            "Your rotation matrix R is a reflection (det R = -1) "
            f"{in_calls(int(mirrored), len(S))}.",
        )
    off_by = degrees(S, T)
    angle = say_degrees(off_by)
    says = f"Your rotation matrix is valid, but it is wrong by {angle} in every call."
    if np.ptp(off_by) >= 1e-3:
        says = f"{NOT_THIS} {say_error(angle)}"
    return Finding("rotation-off", says)


def _skew(R: Array) -> float:
    """Return how far R, (n, 3, 3), is from orthonormal: the largest of R R^T - I."""
    return float(np.abs(R @ R.mT - np.eye(3)).max())


def _bottom(S: Array) -> Array:
    """Return how far each bottom row of S, (n, 4, 4), is from that of a pose, (n,)."""
    return np.abs(S[:, 3] - [0.0, 0.0, 0.0, 1.0]).max(axis=1)
