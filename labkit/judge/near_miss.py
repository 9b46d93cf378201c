"""Close but not equal: the method is right, and this is where the digits went.

S are the student's answers, (n, ...), T the right ones.
"""

from collections.abc import Sequence

import numpy as np

from labkit.base.exchange import Reply
from labkit.base.text import count
from labkit.judge.answers import difference, say_error
from labkit.judge.mistake import Finding
from robo47.checks import Array

SINGLE = 5e-6  # what products in float32 may leave at worst
SINGLE_INSIDE = 1e-6  # and what one float32 in a float64 file leaves
EXACT = 1e-7  # of an entry: it is the right one, but for its sign or place
ABOUT = 1e-2  # of its largest entry: an answer is about right
SMALL = 1e-6  # of the largest entry: one that is nearly 0 has no relative error
OFTEN = 4  # answers that a rule has to hold for
DISTINCT = 3  # numbers of an answer whose order says something
# How near answers are that are about right; the first is the stronger one.
EACH = " All relative errors are below 1 %."
LARGEST = " Every error is below 1 % of the largest entry."
WHY = " Is a constant rounded, or is a part of the formula only an approximation?"


def explain(S: Array, T: Array) -> Finding:
    """Return why answers agree with the right ones to some digits only."""
    if found := rounded(S, T):
        return found
    off = difference(S, T).max()
    inside = off < SINGLE_INSIDE
    # What rounding leaves has other digits on another processor; its size has not.
    size = 10.0 ** np.round(np.log10(max(off, 1e-16)))
    about = f"about {size:.0e}" if inside else f"{off:.1e}"
    why = (
        "Float32, a difference quotient, a small damping or a loop that stops too "
        "early can cause such an error."
        if inside
        else "Does your code use a rounded number such as 3.14 or a difference "
        "quotient, stop a search too early, or set a small value to 0?"
    )
    return Finding(
        "rounded-somewhere",
        f"The result is nearly correct. {say_error(about)} Rounding alone would cause "
        f"an error of about 1e-15. {why}",
    )


def single_precision(replies: Sequence[Reply], S: Sequence[Array]) -> bool:
    """Return whether all numbers came as float32, or are ones that float32 can hold."""
    if all(getattr(r.value, "dtype", None) == np.float32 for r in replies):
        return True
    return all(np.array_equal(part.astype(np.float32), part) for part in S)


def rounded(S: Array, T: Array) -> Finding | None:
    """Return to how many decimals the right answers are rounded, if they are."""
    for decimals in range(1, 8):
        if difference(S, np.round(T, decimals)).max() < 1e-12:
            return Finding(
                "rounded",
                f"Your result is rounded to {count(decimals, 'decimal')}. "
                f"{say_error(f'{difference(S, T).max():.0e}')} Round what you print, "
                "not what you return.",
            )
    return None


def about_right(S: Array, T: Array) -> bool:
    """Return whether all answers are less than a hundredth of their size off."""
    if S.shape != T.shape:
        return False
    size = np.abs(T.reshape(len(T), -1)).max(axis=1, initial=0.0)
    return bool((difference(S, T) <= ABOUT * size).all())


def _each_about_right(S: Array, T: Array) -> bool:
    """Return whether each entry, (n, m), is less than a hundredth of itself off."""
    least = SMALL * np.abs(T).max(axis=1, initial=0.0, keepdims=True)
    return bool((np.abs(S - T) <= ABOUT * np.maximum(np.abs(T), least)).all())


def in_common(S: Array, T: Array) -> str:
    """Return what all wrong answers of a function share with the right ones, or ""."""
    if S.shape != T.shape:
        return ""
    about, shape = about_right(S, T), S.shape
    S, T = (some.reshape(len(some), -1) for some in (S, T))
    tiny = EXACT * np.maximum(np.abs(T), np.abs(T).max(axis=1, keepdims=True) * EXACT)
    wrong = np.abs(S - T) > tiny
    if not wrong.any():
        return ""
    if (np.abs(np.abs(S) - np.abs(T)) <= tiny).all():
        return " Every entry has the correct absolute value, but some signs are wrong."
    if found := one_rule(S, T, wrong):
        return found
    if about:
        return (EACH if _each_about_right(S, T) else LARGEST) + WHY
    mixed = np.abs(np.sort(S, axis=1) - np.sort(T, axis=1)) <= tiny.max(
        1, keepdims=True
    )
    if mixed.all() and S.shape[1] > 1:
        return _in_another_order(S, T, wrong.any(axis=1), shape)
    return ""


def _in_another_order(S: Array, T: Array, wrong: Array, shape: Sequence[int]) -> str:
    """Return in which order the right numbers stand; "" of too few numbers.

    Args:
        S: the student's, (n, m), the right numbers in another order.
        T: the right ones.
        wrong: which calls are wrong, (n,).
        shape: that of S as it was returned.
    """
    if len(shape) == 3 and shape[1] == shape[2]:
        turned = np.swapaxes(T.reshape(shape), 1, 2).reshape(len(T), -1)
        near = EXACT * np.abs(T).max()
        if np.abs(S - turned)[wrong].max() <= near:
            return " In every wrong call, your result is the correct result transposed."
    if wrong.all():
        return " The numbers are correct, but their order is wrong."
    # Few numbers, such as those of a matrix of 0 and 1, are the right ones by chance.
    telling = [len(set(t.tolist())) >= DISTINCT for t in T[wrong]]
    if sum(telling) < 2 and len(shape) > 2:
        return ""
    return " In every wrong call, the numbers are correct, but their order is wrong."


def one_rule(S: Array, T: Array, wrong: Array) -> str:
    """Return by which one rule all answers come from the right ones, or "".

    Args:
        S: the student's, (n, m).
        T: the right ones.
        wrong: which entries are wrong.
    """
    if len(S) < OFTEN or not np.isfinite(S).all():
        return ""
    near = EXACT * max(1.0, float(np.abs(T).max()))
    off = S - T
    if np.abs(off - off[0]).max() <= near and np.ptp(T, axis=0).max() > near:
        return (
            " The error is the same in every call. Its largest entry is "
            f"{np.abs(off).max():.3g}. Is a constant term missing, or is there an "
            "additional one?"
        )
    limit = float(np.abs(S).max())
    cut = np.abs(S - np.clip(T, -limit, limit)).max() <= near
    if cut and wrong.any(axis=1).sum() >= 2:
        return f" Your result equals the correct result, clamped at {limit:.4g}."
    return _a_factor_each(S, T)


def _a_factor_each(S: Array, T: Array) -> str:
    """Return that each answer is the right one times a factor of its own, or ""."""
    large = np.abs(T) > EXACT * np.abs(T).max(axis=1, keepdims=True)
    telling = large.sum(axis=1) >= 2
    if telling.sum() < OFTEN:
        return ""
    size = np.sum(T * T, axis=1)
    factor = np.sum(S * T, axis=1) / np.where(size, size, 1.0)
    off = np.abs(S - factor[:, None] * T).max(axis=1)
    if (off > EXACT * np.abs(T).max(axis=1) * np.maximum(1.0, np.abs(factor))).any():
        return ""
    low, high = factor[telling].min(), factor[telling].max()
    if np.abs(factor).min() == 0.0 or np.isclose(low, high, rtol=1e-3):
        return ""
    return (
        " In each call, all entries are wrong by the same factor, but this factor "
        f"differs between calls ({low:.3g} to {high:.3g}). Look for a factor that "
        "depends on the input."
    )
