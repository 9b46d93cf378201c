"""Day 1 in the inspector: `compose_fk` as a ghost, and the tabs Chain and Order.

Chain multiplies the student's own `link_T` and `joint_T`, factor by factor. Order makes
T_extra of their `make_T` and `Rz`, and draws lines to where their
`translations_both_orders` puts both ends.
"""

import mujoco
import numpy as np

from labkit.base.exchange import Path
from labkit.inspector import common_tabs, words
from labkit.inspector.arm import AGREES, END, Step
from labkit.inspector.ghost import Ghost
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import se3
from robo47.checks import Array

# From the world outwards: each body, and the joint that moves it.
LINKS = (("link0", None), *((f"link{i}", f"joint{i}") for i in range(1, 8)))
# The kit's, under the names of the lab's functions.
LIBRARY = {
    "make_T": se3.make_T,
    "Rz": se3.Rz,
    "link_T": lambda pos, quat: se3.make_T(se3.quat_to_R(quat), pos),
    "joint_T": lambda q: se3.make_T(se3.Rz(q), np.zeros(3)),
    "translations_both_orders": lambda T, E: ((T @ E)[:3, 3], (E @ T)[:3, 3]),
}
ENTRY = "in one entry"
UNITS = {"make_T": ENTRY, "Rz": ENTRY, "link_T": ENTRY, "joint_T": ENTRY,
         "translations_both_orders": "m"}  # fmt: skip
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


class Chain(common_tabs.Chain):
    """The product of the student's own factors."""

    def __init__(self, page: Page) -> None:
        """Ask for every factor at every move."""
        self.own = page.own(LIBRARY, units=UNITS)
        super().__init__(page)

    def on_move(self, q: Array) -> None:
        """Ask for the factors in the arm's present configuration."""
        self.page.job(self.ask, lambda steps: self.show(steps, "yours"))

    def ask(self) -> list[Step]:
        """Return the chain's steps with the student's factors."""
        arm = self.page.arm
        *_, last = arm.chain.links
        right = arm.steps()
        calls = []
        for step in right:
            name = last.name.partition(":")[2] if step.link == END else step.link
            body = arm.model.body(name)
            fixed = ("link_T", body.pos.copy(), body.quat.copy())
            calls.append(("joint_T", step.q) if step.joint else fixed)
        steps = []
        T = np.eye(4)
        for step, given in zip(right, self.own.many(*calls), strict=True):
            end = step.link == END and not step.joint
            factor = given @ arm.chain.T_link_frame if end else given
            off = ~(np.abs(factor - step.factor) < AGREES)
            steps.append(step._replace(
                before=T, factor=factor, after=T @ factor, off=off
            ))  # fmt: skip
            T = T @ factor
        return steps

    def lost(self) -> None:
        """Show no factors, and no way through them."""
        self.product.content = ""
        self.page.host.scene.trace(())


class Order(Tab):
    """T_extra on either side: the tool moves, or the whole arm moves."""

    title = "Order"

    def __init__(self, page: Page) -> None:
        """Start as the lab does: 45 degrees about z, 0.1 m along x."""
        super().__init__(page)
        self.side = BOTH
        self.angle = np.pi / 4
        self.x = 0.1
        self.own = page.own(LIBRARY, units=UNITS)
        page.choice("T_extra", [BOTH, RIGHT, LEFT], self.sets("side"))
        page.slider("rotation about z", -np.pi, np.pi, self.angle, self.sets("angle"))
        page.slider("translation along x", -0.3, 0.3, self.x, self.sets("x"), unit="m")
        self.result = page.html()
        self.arm = page.draw.ghost("purple")
        self.right = page.draw.frame("T_world_ee @ T_extra")
        self.left = page.draw.frame("T_extra @ T_world_ee")
        self.lines = page.draw.lines(np.zeros((2, 2, 3)), "orange")
        page.light(END, {END})
        self.predicted = page.html()
        page.legend({
            "T_extra on the left moves the whole arm": "purple",
            "from the hand to the positions that your function returns": "orange",
        })  # fmt: skip

    def on_move(self, q: Array) -> None:
        """Ask for T_extra, and for where it takes the hand."""
        self.page.job(lambda: self.ask(self.page.pose(END)), self.show)

    def ask(self, T_world_ee: Array) -> tuple[Array, Array, tuple[Array, Array]]:
        """Return T_world_ee, the student's T_extra, and both ends by their formula."""
        R = self.own.Rz(self.angle)
        T_extra = self.own.make_T(R, np.array([self.x, 0.0, 0.0]))
        return (
            T_world_ee,
            T_extra,
            self.own.translations_both_orders(T_world_ee, T_extra),
        )

    def show(self, found: tuple[Array, Array, tuple[Array, Array]]) -> None:
        """Put T_extra on the right, and on the left of the whole arm."""
        T_world_ee, T_extra, (p_right, p_left) = found
        right, left = T_world_ee @ T_extra, T_extra @ T_world_ee
        self.right.place(right)
        self.left.place(left)
        self.right.show(self.side != LEFT, chosen=self.side == RIGHT)
        self.left.show(self.side != RIGHT, chosen=self.side == LEFT)
        poses = self.page.arm.by_mujoco
        moved = {name: T_extra @ poses[f"body:{name}"] for name in self.arm.bodies}
        self.arm.pose({} if self.side == RIGHT else moved)
        ends = {RIGHT: [p_right], LEFT: [p_left], BOTH: [p_right, p_left]}[self.side]
        both = [[T_world_ee[:3, 3], end] for end in ends]
        self.lines.points = np.array(both, np.float32)
        apart = float(np.linalg.norm(right[:3, 3] - left[:3, 3]))
        T, name = (left, "left") if self.side == LEFT else (right, "right")
        says = {
            RIGHT: "On the right: the tool moves along its own axes.",
            LEFT: "On the left: the whole arm rotates and moves (purple).",
            BOTH: f"The distance between the two positions is {apart:.4f} m.",
        }
        self.page.matrix(self.result, f"T_extra on the {name}", T)
        self.page.say(says[self.side])
        off = [
            np.linalg.norm(p_right - right[:3, 3]),
            np.linalg.norm(p_left - left[:3, 3]),
        ]
        told = " and ".join(f"{1000 * mm:.1f} mm" for mm in off)
        kind = "good" if max(off) < AGREES else "bad"
        text = f"errors of your translations_both_orders: {told}, right and left"
        self.predicted.content = words.line(text, "predicted", kind)

    def lost(self) -> None:
        """Show no T_extra."""
        self.result.content = self.predicted.content = ""
        self.page.say("")
        self.right.show(False, chosen=False)
        self.left.show(False, chosen=False)
        self.arm.pose({})
        self.lines.points = np.zeros((1, 2, 3), np.float32)


TABS = [common_tabs.Joints, Chain, Order]
