"""The delivery's phases, one after the other, and what is measured on the way.

What a joint move, a straight line and a grip are is the pick's
(`robo47.capstone.phases`); new are the way round the wall, the scale and the watch.

Units: metres, radians, seconds, kilograms, N m; poses `T_world_x` are (4, 4).
"""

from typing import Any, NamedTuple

import mujoco
import numpy as np

from robo47 import scenes, simulate, trajectory
from robo47.arm import GRAVITY
from robo47.capstone.arm import Law
from robo47.capstone.phases import CLOSED, HOVER, OPEN, Phase, Task
from robo47.checks import Array
from robo47.delivery.seeing import cube_seen
from robo47.delivery.watching import Watch
from robo47.delivery.ways import Ways
from robo47.errors import Robo47Error
from robo47.panda import READY_Q

WEIGH_SECONDS = 1.2  # the springs take so long to come to rest: see the guide
SPEEDS = (0.6, 0.5, 0.4, 0.3, 0.2)  # of the joints' limits; the first that may be, is
SPARE = 0.5  # the share of what the grip can lift that a cube may weigh
EMPTY = 0.010  # kg: what weighs less is no cube

PHASES = (
    Phase("reach", "joint", "cube", HOVER, OPEN),
    Phase("descend", "line", "cube", 0.0, OPEN),
    Phase("close", "hold", "cube", 0.0, CLOSED),
    Phase("lift", "line", "cube", HOVER, CLOSED),
    Phase("weigh", "weigh", "cube", HOVER, CLOSED),
    Phase("carry", "joint", "goal", HOVER, CLOSED),
    Phase("put down", "line", "goal", 0.0, CLOSED),
    Phase("open", "hold", "goal", 0.0, OPEN),
    Phase("leave", "line", "goal", HOVER, OPEN),
    Phase("go home", "joint", "", 0.0, OPEN),
    Phase("rest", "rest", "", 0.0, OPEN),
)


class Result(NamedTuple):
    """What came of it."""

    place_mm: float  # from the cube's centre to where it was to be, at the end
    seen_mm: float  # from where the eye saw it to where it stood
    grams: float  # what it weighed
    mass: float  # what it weighs, kg: nobody was told
    speed: float  # of the carry, as a fraction of the joints' limits
    clearance_mm: float  # least, of the way that was driven
    residual: float  # largest torque that nobody commanded, of any joint, N m
    link: int  # which link felt something over the threshold; 0: none did
    noticed_ms: float  # how long after the push, where there was one; else nan
    arrived: bool  # it went home by itself
    seconds: float  # how long the task took in the simulation
    looks: int  # how often the planners asked for a distance
    phases: list[tuple[str, float]]  # (name, when it began in seconds), in order
    t: Array  # time of each control instant, seconds, (N,)
    qpos: Array  # everything's configuration then, (N, nq): for pictures and replays

    @property
    def failed(self) -> bool:
        """Whether it is not delivered, or one of the graded numbers is wrong."""
        good = (
            self.arrived
            and self.place_mm < 10.0
            and abs(self.grams - 1e3 * self.mass) < 1.0
            and self.seen_mm < 3.0
            and self.clearance_mm > 0.0
            and self.link == 0
        )
        return not good


class Asked(NamedTuple):
    """What an attempt is asked to do otherwise, to see what it changes."""

    mass: float = scenes.CUBE_MASS  # of the cube, kg
    friction: float = scenes.FRICTION  # of cube and pads
    wall: bool = True
    told: bool = False  # where the cube stands, instead of looking
    noise: float = 0.0  # of the depths, m
    beside: float = 0.0  # m along x, added to where it was seen
    weigh: float = WEIGH_SECONDS  # s; 0: it is not weighed and counts as nothing
    speed: float = 0.0  # of the carry; 0: as the weight allows
    planned: bool = True  # False: straight from pose to pose
    hand: bool = True  # False: the planner forgets the hand
    push: float = 0.0  # N across the hand, in the middle of the carry


class Delivery(Task):
    """The model, the state of the world and what has been measured so far."""

    def __init__(self, fns: Any, model: mujoco.MjModel, goal_xy: Array, asked: Asked):
        """Put the arm at the ready and look at the table."""
        super().__init__(fns, model, goal_xy, SPEEDS[0], None)
        self.asked = asked
        self.stood = self.T_world_cube
        if not asked.told:
            noise = asked.noise
            self.T_world_cube = cube_seen(fns, model, self.data, noise=noise)
        self.T_world_cube[0, 3] += asked.beside
        self.seen = self.T_world_cube.copy()
        self.watch_on = Watch(fns, self.arm.damping, 1.0 / RATE)
        self.ways = Ways(fns, self.arm, wall=asked.wall, hand=asked.hand)
        self.mass = 0.0
        self.noticed = np.nan
        self.stopped = False
