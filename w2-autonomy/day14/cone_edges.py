"""14.3 `cone_edges(normal, mu, k)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .touched import UP


def apart(normal, mu, k):
    """Return whether a normal is a unit vector with one smallest component."""
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


def edges(n, mu, k, axis=None, *, a=None, t=None):
    """Return edges, where the axis, the tangent or the angles may be others."""
    axis = np.eye(3)[np.argmin(np.abs(n))] if axis is None else axis
    a = np.cross(n, axis) if a is None else a
    a = a / np.linalg.norm(a) if np.linalg.norm(a) > 0 else a
    b = np.cross(n, a)
    t = 2 * np.pi * np.arange(k) / k if t is None else t
    return n + mu * (np.cos(t)[:, None] * a + np.sin(t)[:, None] * b)


@row.wrongs
def _(normal, mu, k):
    """axis-x: your code always uses n x (1, 0, 0) for `a`. Instead of (1, 0, 0), use
      the coordinate axis along which n has the smallest absolute component, and the
      first such axis if there are several
    axis-z: your code always uses n x (0, 0, 1) for `a`. Instead of (0, 0, 1), use the
      coordinate axis along which n has the smallest absolute component, and the first
      such axis if there are several
    axis-z 2: your code always uses n x (0, 0, 1) for `a`. Instead of (0, 0, 1), use the
      coordinate axis along which n has the smallest absolute component, and the first
      such axis if there are several
    last-of-equals: your code uses the last coordinate axis if several components of n
      have the same smallest absolute value. Use the first of these axes instead
    largest-axis: your code uses the coordinate axis along which n has the largest
      absolute component. Use the axis with the smallest absolute component instead
    signed-least: your code uses the coordinate axis along which n has the smallest
      signed component. Compare the absolute values of the components instead
    axis-x-n: your edges are rotated by pi about the normal. The first edge should be n
      + mu a, where `a` is the unit vector along n x axis
    axis-itself: your edges are rotated by -pi/2 about the normal. The first edge should
      be n + mu a, where `a` is the unit vector along n x axis
    last-is-first: your code ends with t = 2 pi, so the last edge is equal to the first.
      End with `t = 2 pi (k - 1) / k` instead
    degrees: your code uses t in degrees. Use t = 2 pi i / k instead, because `np.cos`
      and `np.sin` expect radians
    from-one: your first edge is the edge for t = 2 pi / k. Begin with i = 0, for which
      t = 0
    mu-on-the-normal: your code multiplies the normal by mu. Multiply the tangential
      part by mu instead
    half-steps: your code shifts t by half the spacing between edges. Use t = 0 for the
      first edge
    length-1: your code normalises the edges. Omit this step, because the component of
      each edge along the normal should be 1
    mu-is-an-angle: your code uses mu as the half-angle of the cone. Use mu itself,
      because the coefficient of friction is already the tangent of this angle
    normal-left-in-mu: your code also multiplies the normal by mu. Multiply only the
      tangential part by mu
    in-columns: your code returns one edge in each column. Return one edge in each row
    """
    t = 2 * np.pi * np.arange(k) / k
    size = np.abs(normal)
    least = np.eye(3)[np.argmin(size)]
    last = np.eye(3)[2 - np.argmin(size[::-1])]
    a = np.cross(normal, least)
    right = edges(normal, mu, k)
    turned = edges(normal, mu, k, t=np.linspace(0, 2 * np.pi, k)) if k > 1 else right
    aside = right - normal
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
        "axis-x-n": edges(normal, mu, k, a=-a),
        "axis-itself": edges(normal, mu, k, a=least - normal @ least * normal),
        "last-is-first": turned,
        "degrees": edges(normal, mu, k, t=360 * np.arange(k) / k),
        "from-one": edges(normal, mu, k, t=2 * np.pi * np.arange(1, k + 1) / k),
        "mu-on-the-normal": lambda: (
            mu * normal + (aside / mu if mu else edges(normal, 1.0, k) - normal)
        ),
        "half-steps": edges(normal, mu, k, t=t + np.pi / k),
        "length-1": right / np.linalg.norm(right, axis=1)[:, None],
        "mu-is-an-angle": edges(normal, np.tan(mu), k),
        "normal-left-in-mu": mu * normal + aside,
        "in-columns": right.T,
    }


row.at_least_0(mu="friction", k="a number of edges")


@row.right  # Rotated about n by Rodrigues' formula.
def _(normal, mu, k):
    from robo47.screws import axis_angle

    a = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    a = a / np.linalg.norm(a)
    turns = [axis_angle(normal, 2 * np.pi * i / k) for i in range(k)]
    return np.array([normal + mu * R @ a for R in turns])
