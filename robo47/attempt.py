"""One attempt at a capstone: its summary and its film.

The capstone of a week is a module of `robo47`, named in week.toml, with

    NAME, THING, GOAL    "the pick"; the name of a random object, "cube"; the condition
                         of success, "placed within 10 mm"
    USES                 the functions that it calls, by the day that teaches them
    HEAD                 the head of the table

and five functions, with `ablations` as a sixth if a table of mistakes is useful:

    library()                 right functions, one attribute for every name in USES
    attempt(fns, seed=None)   one attempt: always the same task, or a random one
    row(name, result)         the line of a result in the table
    summary(result)           further sentences about it, a `Summary`
    film(result)              its motion, a `Film`
    ablations(fns)            {name: (functions, keyword arguments of `attempt`)}, with
                              MORAL, the line below their table

A caller reads only the attribute `failed` of a result.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import mujoco

from robo47.checks import Array


class Summary(NamedTuple):
    """Sentences and numbers about a result, besides its line of the table."""

    before: Sequence[str]  # lines above the table
    after: Sequence[str]  # lines below it
    number: str  # the one that counts, "0.9 mm"
    of: str  # the meaning of the number: "from the cube to its mark"
    came: str  # a sentence for a page: what came of it, and what is allowed
    way: str  # another: how it went
    # The measured quantities: (what, how much with its unit, what is allowed).
    figures: Sequence[tuple[str, str, str]] = ()


class Block(NamedTuple):
    """A box, or another solid, beside the robot."""

    T_world_box: Array  # the pose of its centre, (4, 4)
    half: tuple[float, float, float]  # half its edges, metres
    colour: tuple[float, float, float, float]  # red, green, blue, opacity, 0 to 1
    # "box", or "sphere", "cylinder" or "capsule"; the numbers of `half` are then those
    # of MuJoCo's geom of this type, as (radius, half of the length, unused).
    kind: str = "box"


class Film(NamedTuple):
    """The motion of an attempt."""

    seconds: float  # the duration of the attempt
    t: Array  # time of each instant, seconds, (N,)
    # Everything's configuration then, (N, nq); first the nine numbers of the Panda with
    # its hand.
    qpos: Array
    phases: Sequence[tuple[str, float]]  # (name, when it began in seconds), in order
    moments: Sequence[str]  # phases whose beginnings a picture shows
    blocks: Callable[[Array], Sequence[Block]]  # blocks of a configuration, (nq,)
    model: Callable[[], mujoco.MjModel]  # the scene with the robot's looks
    back: float = 1.2  # the camera's distance as a factor; 1 suits an arm at ready


def film_of(result: Any, **scene: Any) -> Film:
    """Return the film of a result.

    Args:
        result: has `seconds`, `t`, `qpos` and `phases`, as a `Film` has them.
        scene: the other fields of the film.
    """
    return Film(result.seconds, result.t, result.qpos, result.phases, **scene)
