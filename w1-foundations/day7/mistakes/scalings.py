"""Mistakes in task 7.1 `quintic_scaling(t, T)`, from (n,) to (n, 3)."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from labkit.judge.ask import Case
from labkit.judge.compare import difference
from labkit.judge.mistake import Finding, Mistake
from robo47.checks import Array

QUINTIC = (0.0, 0.0, 0.0, 10.0, -15.0, 6.0)
Time = Callable[[Array, Array], Array]


def clipped(t: Array, T: Array) -> Array:
    """Return the part of the time that is over, 0 to 1."""
    return np.clip(t / T, 0.0, 1.0)


def polynomial(
    coefficients: Sequence[float] = QUINTIC,
    x: Time = clipped,
    powers: tuple[int, int, int] = (0, 1, 2),
) -> Callable[[Array, Array], Array]:
    """Return the scaling of a polynomial in x, divided by these powers of T."""
    p = np.polynomial.Polynomial(coefficients)

    def redo(t: Array, T: Array) -> Array:
        parts = [
            f(x(t, T)) / T**k
            for f, k in zip((p, p.deriv(), p.deriv(2)), powers, strict=True)
        ]
        return np.stack(parts, axis=-1)

    return redo


def _cosine(t: Array, T: Array) -> Array:
    a = np.pi * clipped(t, T)
    parts = [
        (1 - np.cos(a)) / 2,
        np.pi * np.sin(a) / (2 * T),
        np.pi**2 * np.cos(a) / (2 * T**2),
    ]
    return np.stack(parts, axis=-1)


def _only_s_clipped(t: Array, T: Array) -> Array:
    free = polynomial(x=lambda t, T: t / T)(t, T)
    return np.concatenate([polynomial()(t, T)[:, :1], free[:, 1:]], axis=1)


def _at_rest(scaling: Callable[[Array, Array], Array]) -> Callable[..., Array]:
    """Return a scaling with speed and acceleration 0 at its ends and beyond."""

    def redo(t: Array, T: Array) -> Array:
        rows = scaling(t, T)
        rows[(t <= 0) | (t >= T), 1:] = 0.0
        return rows

    return redo


def by_quotients(case: Case) -> Finding | None:
    """Return that sd and sdd are close where s is exact: a quotient leaves that."""
    if difference(case.S[:, 0], case.T[:, 0]).max() > 1e-14:
        return None
    off = difference(case.S, case.T).max()
    return Finding(
        "difference-quotient",
        f"s is exact, but sd or sdd is off by {off:.1e}, as a difference quotient "
        "leaves it. The derivative of a polynomial is a polynomial: write it down.",
    )


_NOT_DIVIDED = (
    "{} is the derivative with respect to x = t / T; with respect to t, each "
    "derivative divides by T once more"
)

_JUMPS = [
    Mistake(
        "cubic",
        "this is the cubic, 3 x^2 - 2 x^3; its acceleration jumps at both ends",
        polynomial((0.0, 0.0, 3.0, -2.0)),
        "the cubic",
    ),
    Mistake(
        "linear",
        "s grows at one rate, so the speed jumps at both ends",
        polynomial((0.0, 1.0)),
        "s = x",
    ),
    Mistake(
        "cosine",
        "this is the raised cosine; its acceleration jumps at both ends",
        _cosine,
        "the raised cosine",
    ),
]

SCALING = [
    *_JUMPS,
    *(replace(m, redo=_at_rest(m.redo)) for m in _JUMPS),
    Mistake(
        "septic",
        "this is the polynomial of degree 7, which has no jerk at the ends either; the "
        "task is the quintic",
        polynomial((0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0)),
        "the polynomial of degree 7",
    ),
    Mistake(
        "6-and-10-swapped",
        "the factors 6 and 10 are swapped: s ends at 1, but still moving",
        polynomial((0.0, 0.0, 0.0, 6.0, -15.0, 10.0)),
        "the quintic with 6 and 10 swapped",
    ),
    Mistake(
        "sign-of-15",
        "the factor 15 has the wrong sign: s(T) is 31",
        polynomial((0.0, 0.0, 0.0, 10.0, 15.0, 6.0)),
        "the quintic with +15",
    ),
    Mistake(
        "sd-and-sdd-not-divided",
        _NOT_DIVIDED.format("each of sd and sdd"),
        polynomial(powers=(0, 0, 0)),
        "the answer with derivatives with respect to x",
    ),
    Mistake(
        "sd-not-divided",
        _NOT_DIVIDED.format("the entry sd"),
        polynomial(powers=(0, 0, 2)),
        "sd without 1/T",
    ),
    Mistake(
        "sdd-not-divided",
        _NOT_DIVIDED.format("the entry sdd"),
        polynomial(powers=(0, 1, 0)),
        "sdd without 1/T^2",
    ),
    Mistake(
        "sdd-divided-once",
        "the entry sdd is divided by T once; it is a second derivative",
        polynomial(powers=(0, 1, 1)),
        "sdd with 1/T",
    ),
    Mistake(
        "multiplied-by-T",
        "the derivatives are multiplied by T, where the chain rule divides",
        polynomial(powers=(0, -1, -2)),
        "the answer with T and T^2 as factors",
    ),
    Mistake(
        "t-for-x",
        "the time itself stands where t / T belongs, so T does not count",
        polynomial(x=lambda t, T: t, powers=(0, 0, 0)),
        "the quintic of t",
    ),
    Mistake(
        "t-for-x",
        "the time itself, clipped to 0..1, stands where t / T belongs",
        polynomial(x=lambda t, T: np.clip(t, 0.0, 1.0), powers=(0, 0, 0)),
        "the quintic of t",
    ),
    Mistake(
        "t-for-x",
        "the time itself stands where t / T belongs",
        polynomial(x=lambda t, T: np.clip(t, 0.0, 1.0)),
        "the quintic of t",
    ),
    Mistake(
        "not-clipped",
        "after the end (and before the start) the polynomial goes on: at 1.25 T s is "
        "1.22",
        polynomial(x=lambda t, T: t / T),
        "the quintic without its ends",
    ),
    Mistake(
        "end-not-clipped",
        "it waits for the start, but after the end the polynomial goes on",
        polynomial(x=lambda t, T: np.maximum(t / T, 0.0)),
        "the quintic without its end",
    ),
    Mistake(
        "start-not-clipped",
        "it stops at the end, but before the start the polynomial is there already",
        polynomial(x=lambda t, T: np.minimum(t / T, 1.0)),
        "the quintic without its start",
    ),
    Mistake(
        "only-s-clipped",
        "s stops at the end, but sd and sdd go on: it says that it moves and stands",
        _only_s_clipped,
        "the answer without the ends of sd and sdd",
    ),
    Mistake(
        "backwards",
        "it runs from 1 to 0: the remaining time stands where the time belongs",
        polynomial(x=lambda t, T: 1.0 - clipped(t, T)),
        "the quintic of 1 - t / T",
    ),
    Mistake(
        "order",
        "the order is s, sd, sdd; here the derivatives are swapped",
        lambda t, T: polynomial()(t, T)[:, [0, 2, 1]],
        "the order s, sdd, sd",
    ),
    Mistake(
        "order",
        "the order is s, sd, sdd; here it runs backwards",
        lambda t, T: polynomial()(t, T)[:, ::-1],
        "the order sdd, sd, s",
    ),
]
