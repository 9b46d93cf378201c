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
    """normal-not-removed: |f_t| is the length of the whole force; what presses has to
      be taken out first => with |f| for |f_t|
    sign: the sign is the other one: a contact that holds has a margin above 0
    pyramid: |f_t| is its largest part; a cone has its length => with the largest of
      |f_t|'s parts
    one-norm: |f_t| is the sum of its parts' sizes; a cone has its length
    along-squared: |f_t| is squared: it is newtons squared => with f_t . f_t
    force-length-for-press: what presses is the length of the force; it is the part
      along the normal => with |f| for f_n
    force-length-for-press 2: what presses is the length of the force, in |f_t|, too; it
      is the part along the normal
    pull-counts 2: a pull counts as a press, in |f_t|, too; a finger that pulls lets go
    one-length-for-all: |f_t| is one number for all contacts; each has its own: say
      axis=1
    mu-is-an-angle: mu is taken for the cone's angle; it is its tangent already => with
      tan(mu) for mu
    added-along: what presses is added, not taken out, to find f_t => with f + f_n n
    normal-is-z 3: what presses is the force's z; it is the part along each contact's
      normal
    normal-is-z: the normal is taken for (0, 0, 1); each contact has its own
    normal-is-z 2: the normal is taken for (0, 0, 1); each contact has its own
    pull-counts: a pull counts as a press; a finger that pulls lets go => with |f_n|
    pull-limited: a pull counts as 0; its margin is mu f_n - |f_t|, below 0 => with f_n
      of 0 at least
    ratio: it is mu less the ratio of f_t and f_n; the margin is in newtons
    ratio 2: it is mu f_n over |f_t|; the margin is in newtons
    ratio 3: it is |f_t| over mu f_n; the margin is in newtons
    without-mu: it is f_n - |f_t|; friction allows mu times what presses
    mu-divides: it is f_n / mu - |f_t|; friction allows mu times what presses
    mu-times-along: mu stands before |f_t|, not before f_n => f_n - mu |f_t|
    normal-into-the-finger: the normal points into the finger, so every press is a pull
    margin-of-the-first: all have the first contact's margin; each has its own
    first-mu: the first contact's friction is used for all
    first-normal: the first contact's normal is used for all
    over-the-cone: it is the distance from the cone's surface, divided by sqrt(1 +
      mu^2); asked is mu f_n - |f_t|
    limited-at-0: a margin below 0 becomes 0; it says how far outside a force is
    what-presses: it is mu f_n alone: what friction could hold
    what-slips: it is |f_t| alone
    """
    press = np.sum(force * normal, axis=1)
    along = force - press[:, None] * normal
    f_t = np.linalg.norm(along, axis=1)
    size = np.linalg.norm(force, axis=1)
    right = mu * press - f_t
    first = np.sum(force * normal[0], axis=1)
    return {
        "normal-not-removed": mu * press - size,
        "sign": -right,
        "pyramid": mu * press - np.abs(along).max(axis=1),
        "one-norm": mu * press - np.abs(along).sum(axis=1),
        "along-squared": mu * press - f_t**2,
        "force-length-for-press": mu * size - f_t,
        "force-length-for-press 2": mu * size
        - np.linalg.norm(force - size[:, None] * normal, axis=1),
        "pull-counts 2": mu * np.abs(press)
        - np.linalg.norm(force - np.abs(press)[:, None] * normal, axis=1),
        "one-length-for-all": mu * press - np.linalg.norm(along),
        "mu-is-an-angle": np.tan(mu) * press - f_t,
        "added-along": mu * press
        - np.linalg.norm(force + press[:, None] * normal, axis=1),
        "normal-is-z 3": mu * force[:, 2]
        - np.linalg.norm(force - force[:, 2:] * normal, axis=1),
        "normal-is-z": mu * force[:, 2] - np.linalg.norm(force[:, :2], axis=1),
        "normal-is-z 2": mu * force[:, 2] - f_t,
        "pull-counts": mu * np.abs(press) - f_t,
        "pull-limited": mu * np.maximum(press, 0) - f_t,
        "ratio": lambda: mu - f_t / press,
        "ratio 2": lambda: mu * press / f_t,
        "ratio 3": lambda: f_t / (mu * press),
        "without-mu": press - f_t,
        "mu-divides": press / mu - f_t,
        "mu-times-along": press - mu * f_t,
        "normal-into-the-finger": -mu * press - f_t,
        "margin-of-the-first": np.full(len(mu), right[0]),
        "first-mu": mu[0] * press - f_t,
        "first-normal": mu * first
        - np.linalg.norm(force - first[:, None] * normal[0], axis=1),
        "over-the-cone": right / np.sqrt(1 + mu**2),
        "limited-at-0": np.maximum(right, 0),
        "what-presses": mu * press,
        "what-slips": f_t,
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
