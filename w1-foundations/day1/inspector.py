"""Day 1 in the inspector: the student's `compose_fk` as a ghost, and the tab Order."""

import mujoco
import numpy as np

from labkit.base.exchange import Path
from labkit.inspector.arm import END
from labkit.inspector.ghost import Ghost
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import se3
from robo47.checks import Array

# From the world outwards: each body, and the joint that turns it.
LINKS = (("link0", None), *((f"link{i}", f"joint{i}") for i in range(1, 8)))
BOTH, RIGHT, LEFT = "both", "right: T_world_ee @ T_extra", "left: T_extra @ T_world_ee"


def ask_compose_fk(model: mujoco.MjModel, q: Array) -> list[tuple]:
    """Return the arguments of compose_fk(model, q, PATH[:k]) for every frame."""
    bodies = {model.body(i).name for i in range(model.nbody)}
    end = "attachment" if "attachment" in bodies else "hand"  # panda.xml has no site
    path = (*LINKS, (end, None))
    return [(model, q, Path(path[:k])) for k in range(1, len(path) + 1)]


GHOST = Ghost(
    "compose_fk",
    frames=(*(f"link{i}" for i in range(8)), END),
    questions=ask_compose_fk,
    whole=lambda model, q: (model, q),  # a chain of one's own may take no path
)


class Order(Tab):
    """T_extra on either side: the tool steps, or the whole arm is moved."""

    title = "Order"

    def __init__(self, page: Page) -> None:
        """Start as the lab does: 45 degrees about z, 0.1 m along x."""
        super().__init__(page)
        self.side = BOTH
        self.angle = np.pi / 4
        self.x = 0.1
        page.choice("T_extra", [BOTH, RIGHT, LEFT], self.sets("side"))
        page.slider("turn about z", -np.pi, np.pi, self.angle, self.sets("angle"))
        page.slider("move along x", -0.3, 0.3, self.x, self.sets("x"), unit="m")
        self.result = page.html()
        self.arm = page.draw.ghost("purple")
        self.right = page.draw.frame("T_world_ee @ T_extra")
        self.left = page.draw.frame("T_extra @ T_world_ee")
        self.lines = page.draw.lines(np.zeros((2, 2, 3)), "orange")
        page.light(END, {END})
        page.legend({"T_extra on the left moves the whole arm": "purple"})

    def on_move(self, q: Array) -> None:
        """Put T_extra on the right, and on the left of the whole arm."""
        T_world_ee = self.page.pose(END)
        T_extra = se3.make_T(se3.Rz(self.angle), [self.x, 0.0, 0.0])
        right, left = T_world_ee @ T_extra, T_extra @ T_world_ee
        self.right.place(right)
        self.left.place(left)
        self.right.show(self.side != LEFT, chosen=self.side == RIGHT)
        self.left.show(self.side != RIGHT, chosen=self.side == LEFT)
        poses = self.page.arm.by_mujoco
        moved = {name: T_extra @ poses[f"body:{name}"] for name in self.arm.bodies}
        self.arm.pose({} if self.side == RIGHT else moved)
        ends = {RIGHT: [right], LEFT: [left], BOTH: [right, left]}[self.side]
        both = [[T_world_ee[:3, 3], T[:3, 3]] for T in ends]
        self.lines.points = np.array(both, np.float32)
        apart = float(np.linalg.norm(right[:3, 3] - left[:3, 3]))
        T, name = (left, "left") if self.side == LEFT else (right, "right")
        says = {
            RIGHT: "On the right: the tool steps along its own axes.",
            LEFT: "On the left: the whole arm is turned and moved (purple).",
            BOTH: f"The same two factors end {apart:.4f} m apart.",
        }
        self.page.matrix(self.result, f"T_extra on the {name}", T)
        self.page.say(says[self.side])


TABS = [Order]
