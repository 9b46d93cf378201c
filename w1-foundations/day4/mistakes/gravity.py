"""Mistakes in task 4.4 `gravity_torque(J, masses, coms_world, g)`."""

from collections.abc import Callable

import numpy as np

from labkit.judge.mistake import Mistake
from robo47.checks import Array
from robo47.screws import skew

from .mass import BEFORE, cut

DOWN = np.array([0.0, 0.0, -9.81])


def _at_com(J: Array, C: Array) -> Array:
    """Return the velocity of each centre per joint, (n, links, 3, joints)."""
    return J[:, None, 3:] - C @ J[:, None, :3]


def _torque(
    kept: Array = BEFORE,
    velocity: Callable[..., Array] = _at_com,
    pull: Callable[[Array], Array] = lambda g: g,
    mass: Callable[[Array], Array] = lambda m: m,
) -> Callable[..., Array]:
    """Return gravity_torque with other parts."""

    def redo(J: Array, masses: Array, coms: Array, g: Array) -> Array:
        moves = velocity(J, skew(coms)) * kept
        return -np.einsum("nl,nlaj,na->nj", mass(masses), moves, pull(g))

    return redo


def _at_the_mean(J: Array, masses: Array, coms: Array, g: Array) -> Array:
    """Return the torque of all mass beyond each joint at the mean of its centres."""
    beyond = cut(lambda joint, link: link >= joint)[:, 0]  # (link, joint)
    c = np.einsum("lj,nla->nja", beyond, coms) / beyond.sum(0)[:, None]
    moves = np.swapaxes(J[:, 3:], 1, 2) + np.cross(np.swapaxes(J[:, :3], 1, 2), c)
    return -(masses @ beyond) * np.einsum("nja,na->nj", moves, g)


def _at_the_tip(J: Array, masses: Array, coms: Array, g: Array) -> Array:
    return _torque()(J, masses, np.broadcast_to(coms[:, -1:], coms.shape), g)


def constant(z: float) -> Callable[[Array], Array]:
    """Return a gravity that does not look at what it is given."""
    return lambda g: np.broadcast_to([0.0, 0.0, z], g.shape)


def _down_only(g: Array) -> Array:
    return g * [0.0, 0.0, 1.0]


def _length_down(g: Array) -> Array:
    return np.linalg.norm(g, axis=-1, keepdims=True) * [0.0, 0.0, -1.0]


# Another gravity than the one that is given, for each function that takes it.
OTHER_GRAVITY: list[tuple[str, str, Callable[[Array], Array]]] = [
    (
        "gravity-typed-in",
        "9.81 downwards is typed in; gravity is the argument g, and the robot may hang "
        "on a wall",
        constant(-9.81),
    ),
    (
        "gravity-typed-in",
        "9.81 is typed in, and with the wrong sign; gravity is the argument g",
        constant(9.81),
    ),
    (
        "gravity-rounded",
        "9.8 is typed in for 9.81, and g is not looked at",
        constant(-9.8),
    ),
    (
        "gravity-rounded",
        "9.80665 is typed in, and g is not looked at",
        constant(-9.80665),
    ),
    (
        "only-z-of-gravity",
        "only the z of g counts; it is a vector, and need not point down",
        _down_only,
    ),
    (
        "length-of-gravity",
        "only the length of g counts, always downwards; g says where down is",
        _length_down,
    ),
]

GRAVITY_TORQUE = [
    Mistake(
        "gravity-sign",
        "the sign is wrong: this is the torque of gravity itself, and the motors have "
        "to balance it. The arm would fall twice as fast",
        _torque(pull=lambda g: -g),
        "its negative",
    ),
    *(
        Mistake(slug, says, _torque(kept), "the torque with those joints")
        for slug, says, kept in (
            (
                "links-not-cut",
                "every joint holds every link; a joint holds those beyond it only",
                cut(lambda joint, link: True),
            ),
            (
                "own-link-only",
                "each joint holds its own link only; it carries all beyond it, too",
                cut(lambda joint, link: joint == link),
            ),
            (
                "own-link-left-out",
                "each joint leaves its own link out and holds those beyond it only",
                cut(lambda joint, link: joint < link),
            ),
            (
                "link-before-too",
                "each joint also holds the link that it stands on",
                cut(lambda joint, link: joint <= link + 1),
            ),
            (
                "links-on-the-wrong-side",
                "each joint holds the links between it and the base; they do not move "
                "with it",
                cut(lambda joint, link: joint >= link),
            ),
        )
    ),
    Mistake(
        "velocity-of-the-origin",
        "the lower half of J is the velocity of the point at the world's origin; the "
        "weight acts at the centre of mass",
        _torque(velocity=lambda J, C: J[:, None, 3:] - 0 * C @ J[:, None, :3]),
        "the torque with v in place of v + omega x c",
    ),
    Mistake(
        "cross-product-sign",
        "the velocity of the centre of mass is v + omega x c; here it is v + c x omega",
        _torque(velocity=lambda J, C: J[:, None, 3:] + C @ J[:, None, :3]),
        "the torque with v + c x omega",
    ),
    Mistake(
        "v-left-out",
        "the velocity of the centre of mass is v + omega x c; here v is missing",
        _torque(velocity=lambda J, C: -C @ J[:, None, :3]),
        "the torque with omega x c alone",
    ),
    Mistake(
        "rows-swapped",
        "the rows of J are read as (v; omega); omega comes first",
        _torque(velocity=lambda J, C: J[:, None, :3] - C @ J[:, None, 3:]),
        "the torque with J's halves swapped",
    ),
    Mistake(
        "omega-rows-for-v",
        "the upper half of J is used as the velocity; that is omega",
        _torque(velocity=lambda J, C: J[:, None, :3] + 0 * C @ J[:, None, 3:]),
        "the torque with omega for v",
    ),
    Mistake(
        "centre-not-weighted",
        "the mass beyond each joint sits at the plain mean of the links' centres; a "
        "heavy link counts for more",
        _at_the_mean,
        "the torque with the mean of the centres",
    ),
    Mistake(
        "all-mass-at-the-last-centre",
        "all mass sits at the last link's centre; each link has one of its own",
        _at_the_tip,
        "the torque with that centre for all",
    ),
    Mistake(
        "signs-lost",
        "no torque is negative here: a motor has to pull the other way as well",
        lambda *given: np.abs(_torque()(*given)),
        "the right torque without its signs",
    ),
    Mistake(
        "mass-forgotten",
        "the masses are missing: every link counts as 1 kg",
        _torque(mass=np.ones_like),
        "the torque with 1 kg each",
    ),
    *(
        Mistake(slug, says, _torque(pull=pull), "the torque with that gravity")
        for slug, says, pull in OTHER_GRAVITY
    ),
]
