"""No mistake has this name: which part is wrong, where, and by how much."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from robo47.checks import Array
from robo47.diagnose.compare import (
    CLOSE,
    PASSED,
    RIGID,
    apart,
    degrees,
    difference,
    matches,
    millimetres,
    say_degrees,
    say_mm,
)
from robo47.diagnose.form import Finding
from robo47.diagnose.matrices import split, transposed


def nothing_there(S: Array) -> Finding | None:
    """Return that all entries of all answers, (n, ...), are 0, if they are."""
    if S.any():
        return None
    return Finding(
        "all-zeros",
        "Every entry is 0, which is not even the identity: the array was made, but "
        "never filled (MuJoCo's own results look so before mj_forward).",
    )


def all_the_same(S: Array, T: Array) -> Finding | None:
    """Return that the answer does not depend on the input, if so.

    Args:
        S: the student's answers, (n, ...), finite.
        T: the right ones, which do.
    """
    if difference(S, np.broadcast_to(S[0], S.shape)).max() > PASSED:
        return None
    off = f"(Differs from the right answer by up to {apart(S, T)}.)"
    if S.shape[-1] == S.shape[-2] and np.array_equal(S[0], np.eye(S.shape[-1])):
        return Finding(
            "always-the-identity",
            f"It returns the identity, whatever it is given. {off}",
        )
    return Finding(
        "ignores-its-input",
        f"The answer is the same, whatever the input: it does not depend on it. {off}",
    )


def not_finite(S: Array, given: list[str]) -> Finding | None:
    """Return where NaN or infinity came out."""
    bad = np.logical_not(np.isfinite(S).reshape(len(S), -1).all(axis=1))
    if not bad.any():
        return None
    return Finding(
        "not-finite",
        f"NaN or infinity comes out for {bad.sum()} of {len(S)} inputs"
        f"{_first(bad, given, 'first for')}.",
    )


def what_is_wrong(S: Array, T: Array, given: list[str]) -> Finding:
    """Return the most useful true thing about answers that match no named mistake.

    Args:
        S: the student's answers, (n, 3, 3), (n, 4, 4) or (n, 2, 3), finite.
        T: the right ones.
        given: the inputs in words, one per answer.
    """
    by_shape = {(3, 3): _rotation, (4, 4): _pose, (2, 3): _two_points}
    finding = _few_entries(S, T) or by_shape[S.shape[1:]](S, T)
    return Finding(finding.slug, f"{finding.message}{_where(S, T, given)}")


def measured(S: Array, T: Array) -> tuple[str, ...]:
    """Return the numbers behind a verdict, a line each, for --explain.

    Args:
        S: the student's answers, (n, ...).
        T: the right ones.
    """
    gap = difference(S, T)
    lines = [
        f"largest difference of an entry: {gap.max():.2g} (call {np.argmax(gap) + 1} "
        f"of {len(gap)}; passes up to {PASSED:.0e})",
        f"calls that are right: {np.sum(gap <= PASSED)} of {len(gap)}",
    ]
    if S.shape[1:] == (2, 3):
        off = millimetres(S, T).max(axis=0)
        return *lines, f"first off by {say_mm(off[0])}, second by {say_mm(off[1])}"
    R, det = S[:, :3, :3], np.linalg.det(S[:, :3, :3])
    lines.append(
        f"R R^T - I: {_skew(R):.2g}; det R: {det.min():.4g} to {det.max():.4g}"
    )
    if not _skew(R) > RIGID:
        turned = degrees(R, T[:, :3, :3])
        lines.append(f"R off by {_range(turned, say_degrees)}")
    if S.shape[1:] == (4, 4):
        moved = millimetres(S[:, :3, 3], T[:, :3, 3])
        lines.append(f"t off by {_range(moved, say_mm)}; bottom row by {_below(S):.2g}")
    return tuple(lines)


def _range(values: Array, say: Callable[[float], str]) -> str:
    least, most = say(values.min()), say(values.max())
    return most if least == most else f"{least} to {most}"


def _skew(R: Array) -> float:
    """Return how far R, (n, 3, 3), is from orthonormal: the largest of R R^T - I."""
    return float(np.abs(R @ transposed(R) - np.eye(3)).max())


def _below(S: Array) -> float:
    return float(np.abs(S[:, 3] - [0.0, 0.0, 0.0, 1.0]).max())


def _few_entries(S: Array, T: Array) -> Finding | None:
    """Return which entries are wrong if they are one or two, or one row or column."""
    gap = np.abs(S - T)
    rows, columns = np.nonzero(gap.max(axis=0) > CLOSE)
    one_row, one_column = len(set(rows)) == 1, len(set(columns)) == 1
    t_or_below = (one_column and columns[0] == 3) or (one_row and rows[0] == 3)
    if S.shape[-2] != S.shape[-1] or (t_or_below and len(rows) > 1):
        return None  # two vectors, or a part that has a name of its own
    if len(rows) <= 2:
        where = " and ".join(f"[{i}, {j}]" for i, j in zip(rows, columns, strict=True))
    elif one_row or one_column:
        where = f"row {rows[0]}" if one_row else f"column {columns[0]}"
    else:
        return None
    return Finding(
        "few-entries-off",
        f"All entries are right but {where}, counted from 0: up to {gap.max():.2g} "
        "off. Look there for a wrong sign, letter or factor.",
    )


def _rotation(S: Array, T: Array) -> Finding:
    if (off := _skew(S)) > RIGID:
        det = np.linalg.det(S)
        worst = np.round(det[np.argmax(np.abs(det - 1.0))], 6) + 0.0  # no 7e-189
        return Finding(
            "not-orthonormal",
            "R is no rotation: its columns are not unit vectors at right angles. "
            f"(R R^T differs from I by {off:.2g}; det R is {worst:.3g}, not 1.)",
        )
    X = np.abs(transposed(T) @ S)
    if matches(X, np.broadcast_to(np.round(X[0]), X.shape)):
        return Finding(
            "axes-mixed-up",
            "R's columns are the right axes, but swapped or with the wrong sign. "
            f"(det R is {np.linalg.det(S[0]):.0f}.)",
        )
    if mirrored := np.sum(np.linalg.det(S) < 0.0):
        return Finding(
            "left-handed",
            f"R is a left-handed frame, a mirror image, for {mirrored} of {len(S)} "
            "inputs. (det R is -1.)",
        )
    off_by = degrees(S, T)
    if np.ptp(off_by) < 1e-3:
        return Finding(
            "rotation-off",
            f"R is a rotation, but {say_degrees(off_by.max())} off, the same amount "
            "every time.",
        )
    return Finding(
        "rotation-off",
        f"R is a rotation, but not the right one: up to {say_degrees(off_by.max())} "
        "off.",
    )


def _pose(S: Array, T: Array) -> Finding:
    (R, t), (R_true, t_true) = split(S), split(T)
    if _below(S) > CLOSE:
        row = S[np.argmax(np.abs(S[:, 3] - [0, 0, 0, 1]).max(axis=1)), 3]
        return Finding(
            "bottom-row",
            f"The bottom row is ({_numbers(row)}), not (0, 0, 0, 1), so this is no "
            "pose.",
        )
    R_right = difference(R, R_true).max() <= CLOSE
    t_off = say_mm(millimetres(t, t_true).max())
    if R_right:
        return Finding(
            "translation-off",
            f"R is right everywhere; the translation is not: up to {t_off} off.",
        )
    slug, message = _rotation(R, R_true)
    if t_off == "0":
        return Finding(slug, f"The translation is right. {message}")
    slug = "pose-off" if slug == "rotation-off" else slug
    return Finding(slug, f"{message} The translation is up to {t_off} off too.")


def _two_points(S: Array, T: Array) -> Finding:
    first, second = (say_mm(mm) for mm in millimetres(S, T).max(axis=0))
    if second == "0":
        return Finding(
            "first-off", f"The second is right; the first is up to {first} off."
        )
    if first == "0":
        return Finding(
            "second-off", f"The first is right; the second is up to {second} off."
        )
    return Finding(
        "both-off", f"Both are wrong: up to {first} off the first, {second} the second."
    )


def _where(S: Array, T: Array, given: list[str]) -> str:
    wrong = difference(S, T) > CLOSE
    if wrong.all():
        return ""
    return (
        f" It is right for {np.sum(~wrong)} of {len(S)} inputs"
        f"{_first(wrong, given, 'but not for')}."
    )


def _first(which: NDArray[np.bool_], given: list[str], word: str) -> str:
    words = given[int(np.argmax(which))]
    return f", {word} {words}" if words else ""


def _numbers(row: Array) -> str:
    return ", ".join(f"{x:.3g}" for x in row)
