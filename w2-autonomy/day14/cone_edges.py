"""14.3 `cone_edges(normal, mu, k)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .touched import UP


def apart(normal, mu, k):
    """Return whether a normal has length 1, and its least axis is sure."""
    size = np.sort(np.abs(normal))
    tie = size[1] - size[0] < 1e-6 and size[1] > 1e-12
    return bool(abs(np.linalg.norm(normal) - 1) < 1e-9 and not tie and mu >= 0)


row = Row(Matrix((None, 3), scale=1.0), at_edge=apart)


@row.inputs
def _(rng):
    yield UP, 0.5, 4
    yield -np.eye(3)[1], 0.4, 6
    yield np.eye(3)[0], 0.7, 5
    yield np.array([0.6, 0, 0.8]), 0.3, 3
    yield np.array([0.8, 0.6, 0.0]), 1.1, 8
    for n, mu, k in zip(
        rng.units(8), rng.numbers(0.2, 1.3, 8), (3, 4, 5, 6, 8, 1, 2, 7), strict=True
    ):
        yield n, float(mu), k


def edges(n, mu, k, axis=None, *, a=None, b=None, t=None):
    """Return edges, where one thing may be another."""
    axis = np.eye(3)[np.argmin(np.abs(n))] if axis is None else axis
    a = np.cross(n, axis) if a is None else a
    a = a / np.linalg.norm(a) if np.linalg.norm(a) > 0 else a
    b = np.cross(n, a) if b is None else b
    t = 2 * np.pi * np.arange(k) / k if t is None else t
    return n + mu * (np.cos(t)[:, None] * a + np.sin(t)[:, None] * b)


@row.wrongs
def _(normal, mu, k):
    """axis-x: a is always n x (1, 0, 0); take the axis that is least along n, the first
      of equals
    axis-z: a is always n x (0, 0, 1); take the axis that is least along n, the first of
      equals
    axis-z 2: a is always n x (0, 0, 1); take the axis that is least along n, the first
      of equals
    last-of-equals: of axes that are equally little along n it takes the last; the first
      was asked for
    largest-axis: it takes the axis that is most along n; the least was asked for
    signed-least: it takes the axis whose entry of n is the least, sign and all; the
      size counts
    not-unit: a is not divided by its length, so the edges lie on an ellipse
    axis-x-n: a is axis x n; n x axis was asked for, so the edges begin opposite
    axis-itself: for a it takes the part of the axis across n; n x axis was asked for,
      so the edges begin a quarter of a turn away
    other-way-round: it goes round the other way: b is n x a
    last-is-first: the last edge is the first again: t goes from 0 to 2 pi with both
      ends => with t = 2 pi i / (k - 1)
    degrees: the turn is 360, but sine and cosine take radians, 2 pi
    from-one: the edges are counted from 1; the first, i = 0, is at a
    mu-on-the-normal: mu stands before n, not before what goes round it => mu n + (cos t
      a + sin t b)
    half-steps: the edges begin half a step on: t = 2 pi i / k
    length-1: the edges have length 1; they press with 1, so they are longer => divided
      by their length
    mu-is-an-angle: mu is taken for the cone's angle; it is the tangent => with tan(mu)
    sine-and-cosine-swapped: cosine and sine are swapped; a goes with the cosine
    normal-left-out: the normal is missing: these are the friction forces alone
    normal-left-in-mu: n is multiplied by mu as well
    mu-forgotten: mu is missing: the edges are those for mu = 1
    half-a-turn: the edges go round half a turn alone; t = 2 pi i / k
    in-columns: each edge is a column; each is a row
    """
    t = 2 * np.pi * np.arange(k) / k
    size = np.abs(normal)
    least = np.eye(3)[np.argmin(size)]
    last = np.eye(3)[2 - np.argmin(size[::-1])]
    a = np.cross(normal, least)
    b = np.cross(normal, a / np.linalg.norm(a))
    right = edges(normal, mu, k)
    turned = edges(normal, mu, k, t=np.linspace(0, 2 * np.pi, k)) if k > 1 else right
    aside = right - normal
    ellipse = normal + mu * (
        np.cos(t)[:, None] * a + np.sin(t)[:, None] * np.cross(normal, a)
    )
    return {
        "axis-x": edges(normal, mu, k, np.eye(3)[0]),
        "axis-z": edges(normal, mu, k, np.eye(3)[2]),
        "axis-z 2": lambda: (
            edges(normal, mu, k, np.eye(3)[2])
            if size[2] < 1
            else np.full((k, 3), np.nan)
        ),
        "last-of-equals": edges(normal, mu, k, last),
        "largest-axis": edges(normal, mu, k, np.eye(3)[np.argmax(size)]),
        "signed-least": edges(normal, mu, k, np.eye(3)[np.argmin(normal)]),
        "not-unit": ellipse,
        "axis-x-n": edges(normal, mu, k, a=-a),
        "axis-itself": edges(normal, mu, k, a=least - normal @ least * normal),
        "other-way-round": edges(normal, mu, k, b=-b),
        "last-is-first": turned,
        "degrees": edges(normal, mu, k, t=360 * np.arange(k) / k),
        "from-one": edges(normal, mu, k, t=2 * np.pi * np.arange(1, k + 1) / k),
        "mu-on-the-normal": lambda: (
            mu * normal + (aside / mu if mu else edges(normal, 1.0, k) - normal)
        ),
        "half-steps": edges(normal, mu, k, t=t + np.pi / k),
        "length-1": right / np.linalg.norm(right, axis=1)[:, None],
        "mu-is-an-angle": edges(normal, np.tan(mu), k),
        "sine-and-cosine-swapped": edges(normal, mu, k, t=np.pi / 2 - t),
        "normal-left-out": aside,
        "normal-left-in-mu": mu * normal + aside,
        "mu-forgotten": edges(normal, 1.0, k),
        "half-a-turn": edges(normal, mu, k, t=t / 2),
        "in-columns": right.T,
    }


row.at_least_0(mu="friction", k="a number of edges")


@row.right  # Turned about n by Rodrigues' formula.
def _(normal, mu, k):
    from robo47.screws import axis_angle

    a = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    a = a / np.linalg.norm(a)
    turns = [axis_angle(normal, 2 * np.pi * i / k) for i in range(k)]
    return np.array([normal + mu * R @ a for R in turns])
