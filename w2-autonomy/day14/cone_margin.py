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
    """sign: your code negates the margin. A contact inside its friction cone should
      have a margin above 0
    pyramid: your code uses the largest absolute component of f_t as |f_t|. Use the
      Euclidean norm instead, because the cone is circular
    one-norm: your code uses the sum of the absolute components of f_t as |f_t|. Use the
      Euclidean norm instead, because the cone is circular
    force-length-for-press: your code uses the norm of the whole force as f_n. Use the
      component of the force along the normal instead
    force-length-for-press 2: your code uses the norm of the whole force as f_n. Use the
      component of the force along the normal instead
    one-length-for-all: your code takes a single norm over the tangential forces of all
      contacts. Take the norm of each contact's tangential force instead, with `axis=1`
    mu-is-an-angle: your code uses mu as the half-angle of the cone. Use mu itself,
      because the coefficient of friction is already the tangent of this angle
    normal-is-z 3: your code uses the z component of the force as f_n. Use the component
      along the contact's own normal instead
    normal-is-z: your code uses the normal (0, 0, 1) for every contact. Use each
      contact's own normal instead
    normal-is-z 2: your code uses the z component of the force as f_n. Use the component
      along the contact's own normal instead
    normal-is-z 4: your code uses the x and y components of the force as f_t. Subtract
      the component along the contact's own normal instead
    pull-counts: your code uses the absolute value of f_n for a contact that pulls. Keep
      the sign of f_n, because a finger cannot pull
    pull-limited: your code clamps a negative f_n to 0. Keep the sign of f_n, because a
      contact that pulls should have a margin below 0
    ratio: your code returns mu - |f_t| / f_n. Return mu f_n - |f_t| instead, because
      the margin is a force
    ratio 2: your code returns mu f_n / |f_t|. Return mu f_n - |f_t| instead, because
      the margin is a force
    ratio 3: your code returns |f_t| / (mu f_n). Return mu f_n - |f_t| instead, because
      the margin is a force
    mu-times-along: your code multiplies |f_t| by mu. Multiply f_n by mu instead
    normal-into-the-finger: your code negates f_n. A finger that presses should have a
      positive f_n, because the normal points out of the finger into the cube
    margin-of-the-first: your code returns the margin of the first contact for every
      contact. Return each contact's own margin
    over-the-cone: your code divides the margin by `sqrt(1 + mu^2)`, as for the distance
      to the surface of the cone. Return mu f_n - |f_t| itself
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
        "normal-is-z 4": mu * press - np.linalg.norm(force[:, :2], axis=1),
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
