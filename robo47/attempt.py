"""One attempt at a capstone: what is said of it, and what it looked like.

A week's capstone is a module of `robo47`, named in week.toml, with

    NAME, THING, GOAL    "the pick"; what a random one is called, "cube"; when an
                         attempt has not failed, "placed within 10 mm"
    USES                 the functions that it calls, by the day that teaches them
    HEAD                 the head of the table

and five functions, with `ablations` as a sixth where mistakes are worth a table:

    library()                 right functions, one attribute for every name in USES
    attempt(fns, seed=None)   do it: always the same task, or a random one
    row(name, result)         a result's line of the table
    summary(result)           what else is said of it, a `Summary`
    film(result)              what it looked like, a `Film`
    ablations(fns)            {name: (functions, keyword arguments of `attempt`)}, with
                              MORAL, the line below their table

Of a result, a caller reads only `failed`.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import mujoco

from robo47.checks import Array


class Summary(NamedTuple):
    """What is said of a result, besides its line of the table."""

    before: Sequence[str]  # lines above the table
    after: Sequence[str]  # lines below it
    number: str  # the one that counts, "0.9 mm"
    of: str  # what that is, "from the cube to its mark"
    came: str  # a sentence for a page: what came of it, and what is allowed
    way: str  # another: how it went
    # What it measured: (what, how much with its unit, what is allowed).
    figures: Sequence[tuple[str, str, str]] = ()


class Block(NamedTuple):
    """A box that stands beside the robot."""

    T_world_box: Array  # the pose of its centre, (4, 4)
    half: tuple[float, float, float]  # half its edges, metres
    colour: tuple[float, float, float, float]  # red, green, blue, opacity, 0 to 1


class Film(NamedTuple):
    """What an attempt looked like."""

    seconds: float  # how long it took
    t: Array  # time of each instant, seconds, (N,)
    # Everything's configuration then, (N, nq); first the nine numbers of the Panda with
    # its hand.
    qpos: Array
    phases: Sequence[tuple[str, float]]  # (name, when it began in seconds), in order
    moments: Sequence[str]  # phases whose beginnings a picture shows
    blocks: Callable[[Array], Sequence[Block]]  # from a configuration, (nq,)
    model: Callable[[], mujoco.MjModel]  # the scene with the robot's looks
    back: float  # how far back a camera stands: 1 suits an arm at ready
