"""One arm at one configuration: all quantities of a control loop, computed together.

`robo47.dynamics` has the same formulas in readable form and for many configurations at
once. A control loop needs them for one configuration, thousands of times, and fast:

    now = arm.at(q)
    tau = now.M @ qdd + now.bias(qd) + arm.damping * qd

Conventions as in `robo47.dynamics`: (omega; v), the world frame about the world's
origin, SI units; M contains the armature. This is pure NumPy; `robo47.panda.arm(model)`
reads an arm from a model.
"""

import dataclasses
import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.fast.arm_state import ArmState, Constants, as_one
from robo47.gravity import GRAVITY as GRAVITY


@dataclass(frozen=True, eq=False)
class Arm:
    """A chain of n links, described at q = 0.

    Attributes:
        screws: space screws of the joints at q = 0, (omega; v), (n, 6).
        M_home: `T_world_ee` at q = 0, (4, 4); `tool` changes it.
        T_zero: `T_world_link` of each link at q = 0, (n, 4, 4).
        masses: of the links, kg, (n,).
        coms: centres of mass in the link frames, metres, (n, 3).
        inertias: about the centres of mass, in the link frames, kg m^2, (n, 3, 3).
        armature: of the joints, kg m^2, (n,).
        damping: of the joints, N m s/rad, (n,).
        gravity: m/s^2, (3,).
    """

    screws: Array
    M_home: Array
    T_zero: Array
    masses: Array
    coms: Array
    inertias: Array
    armature: Array
    damping: Array
    gravity: Array = dataclasses.field(default_factory=GRAVITY.copy)

    def __post_init__(self) -> None:
        """Check the shapes."""
        n = len(self.screws)
        for name, shape in {
            "screws": (n, 6), "M_home": (4, 4), "T_zero": (n, 4, 4), "masses": (n,),
            "coms": (n, 3), "inertias": (n, 3, 3), "gravity": (3,),
        }.items():  # fmt: skip
            object.__setattr__(
                self, name, checks.array(getattr(self, name), name, shape)
            )
        for name in ("armature", "damping"):
            value = checks.array(getattr(self, name), name, ())
            object.__setattr__(self, name, np.broadcast_to(value, (n,)))
        checks.screws(self.screws, "screws")

    @cached_property
    def constants(self) -> Constants:
        """The quantities that do not depend on q, computed once."""
        return Constants(self)

    def at(self, q: ArrayLike) -> ArmState:
        """Return the arm at a configuration; each quantity is computed on first access.

        Args:
            q: configuration, rad, (n,).

        Raises:
            ValueError: wrong shape or a non-finite number.
        """
        q = np.asarray(q, dtype=np.float64)
        if q.shape != self.masses.shape:
            raise ValueError(f"q has shape {q.shape}; expected {self.masses.shape}")
        if not math.isfinite(q.dot(q)):
            checks.array(q, "q", q.shape)
        return ArmState(self.constants, q)

    def tool(self, T_ee_tool: ArrayLike) -> "Arm":
        """Return the same arm with another end-effector frame.

        Args:
            T_ee_tool: pose of the new frame relative to the present one, (4, 4).
        """
        M_home = self.M_home @ checks.pose(T_ee_tool, "T_ee_tool")
        return dataclasses.replace(self, M_home=M_home)

    def carrying(self, mass: float, com: ArrayLike, inertia: ArrayLike) -> "Arm":
        """Return the same arm with a body, such as a hand, fixed to its last link.

        Args:
            mass: kg.
            com: centre of mass in the last link's frame, metres, (3,).
            inertia: about that centre, in the last link's frame, kg m^2, (3, 3).
        """
        own = self.masses, self.coms, self.inertias
        masses, coms, inertias = (of_links.copy() for of_links in own)
        masses[-1], coms[-1], inertias[-1] = as_one(
            np.stack([masses[-1], checks.array(mass, "mass", ())]),
            np.stack([coms[-1], checks.array(com, "com", (3,))]),
            np.stack([inertias[-1], checks.array(inertia, "inertia", (3, 3))]),
        )
        return dataclasses.replace(self, masses=masses, coms=coms, inertias=inertias)
