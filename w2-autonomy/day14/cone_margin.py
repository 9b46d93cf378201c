"""14.1 `cone_margin(force, normal, mu)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

from .touched import UP, contacts

row = Row(Vector((None,), "N", scale=10.0))


@row.inputs
def _(rng):
    case = np.array([[3.0, 4, 10], [0, 0, -1]])
    yield case, np.tile(UP, (2, 1)), np.array([0.6, 0.6])
    # normals up, and forces that press, slip, or do not press at all
    force = rng.numbers(-3, 3, 4, 3)
    force[:, 2] += 5
    yield force, np.tile(UP, (4, 1)), rng.numbers(0.3, 1, 4)
    yield contacts(rng, 3, pull=True)
    yield contacts(rng, 1)
    for n in (2, 4, 5, 8):
        yield contacts(rng, n)


@row.wrongs
def _(force, normal, mu):
    """sign: your code reverses the sign of the margin. A contact inside its friction
      cone has a margin above 0
    pyramid: your code uses the largest component of f_t as |f_t|. Use the Euclidean
      norm, because the cone is circular
    one-norm: your code uses the sum of the absolute components of f_t as |f_t|. Use the
      Euclidean norm, because the cone is circular
    force-length-for-press: your code uses the norm of the whole force as f_n. The
      normal force is the component along the normal
    force-length-for-press 2: your code uses the norm of the whole force as f_n. The
      normal force is the component along the normal
    one-length-for-all: your code takes a single norm over the tangential forces of all
      contacts. Take the norm of each contact's tangential force instead, with axis=1
    mu-is-an-angle: your code uses mu as the angle of the cone. The coefficient of
      friction is already the tangent of this angle, so use mu itself
    normal-is-z 3: your code uses the z component of the force as f_n. The normal force
      is the component along the contact's own normal
    normal-is-z: your code uses the normal (0, 0, 1) for every contact. Each contact has
      its own normal
    normal-is-z 2: your code uses the normal (0, 0, 1) for every contact. Each contact
      has its own normal
    pull-counts: your code uses the absolute value of f_n for a contact that pulls. A
      finger cannot pull, so keep the sign of f_n
    pull-limited: your code replaces a negative f_n by 0. Keep its sign, so that a
      contact that pulls has a margin below 0
    ratio: your result is mu - |f_t| / f_n. The margin should be a force: mu f_n - |f_t|
    ratio 2: your result is mu f_n / |f_t|. The margin should be a force: mu f_n - |f_t|
    ratio 3: your result is |f_t| / (mu f_n). The margin should be a force: mu f_n -
      |f_t|
    mu-times-along: your code multiplies |f_t| by mu. Multiply f_n by mu instead
    normal-into-the-finger: your f_n has the wrong sign. The normal points out of the
      finger, into the cube, so a finger that presses has a positive f_n
    margin-of-the-first: every contact in your result has the margin of the first. Each
      contact should have its own margin
    over-the-cone: your result is the distance from the surface of the cone. Do not
      divide the margin by sqrt(1 + mu^2)
    """
    press = np.sum(force * normal, axis=1)
    along = force - press[:, None] * normal
    f_t = np.linalg.norm(along, axis=1)
    size = np.linalg.norm(force, axis=1)
    right = mu * press - f_t
    return {
        "sign": -right,
        "pyramid": mu * press - np.abs(along).max(axis=1),
        "one-norm": mu * press - np.abs(along).sum(axis=1),
        "force-length-for-press": mu * size - f_t,
        "force-length-for-press 2": mu * size
        - np.linalg.norm(force - size[:, None] * normal, axis=1),
        "one-length-for-all": mu * press - np.linalg.norm(along),
        "mu-is-an-angle": np.tan(mu) * press - f_t,
        "normal-is-z 3": mu * force[:, 2]
        - np.linalg.norm(force - force[:, 2:] * normal, axis=1),
        "normal-is-z": mu * force[:, 2] - np.linalg.norm(force[:, :2], axis=1),
        "normal-is-z 2": mu * force[:, 2] - f_t,
        "pull-counts": mu * np.abs(press) - f_t,
        "pull-limited": mu * np.maximum(press, 0) - f_t,
        "ratio": lambda: mu - f_t / press,
        "ratio 2": lambda: mu * press / f_t,
        "ratio 3": lambda: f_t / (mu * press),
        "mu-times-along": press - mu * f_t,
        "normal-into-the-finger": -mu * press - f_t,
        "margin-of-the-first": np.full(len(mu), right[0]),
        "over-the-cone": right / np.sqrt(1 + mu**2),
    }


row.at_least_0(mu="friction")


@row.right  # |f_t| by Pythagoras, and a loop.
def _(force, normal, mu):
    found = []
    for f, n, m in zip(force, normal, mu, strict=True):
        press = f @ n
        found.append(m * press - np.sqrt(max(f @ f - press**2, 0.0)))
    return np.array(found)


@row.right  # |f_t| as the length of a cross product.
def _(force, normal, mu):
    press = np.einsum("ij,ij->i", force, normal)
    return mu * press - np.linalg.norm(np.cross(normal, force), axis=1)


row.spans(  # as small, or as large, as in the lab
    force=(
        lambda force: 0.003 * force,
        lambda force: 30 * force,
    ),
)
