"""Day 1 in the inspector: `compose_fk` as a ghost, and the tabs Chain and Order.

Chain multiplies the student's own `link_T` and `joint_T`, factor by factor. Order makes
T_extra of their `make_T` and `Rz`, and draws lines to where their
`translations_both_orders` puts both ends.
"""

import mujoco
import numpy as np

from labkit.base.exchange import Path
from labkit.inspector import common_tabs
from labkit.inspector import declared as ui
from labkit.inspector.arm import AGREES, END, Step
from labkit.inspector.ghost import Ghost
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

    library = LIBRARY
    functions = {"link_T": ENTRY, "joint_T": ENTRY}

    def ask(self, fns, at) -> list[Step]:
        """Return the chain's steps with the factors of `link_T` and `joint_T`."""
        arm, right = self.page.arm, super().ask(fns, at)
        calls = []
        for step in right:
            last = arm.chain.links[-1].name.partition(":")[2]
            body = arm.model.body(last if step.link == END else step.link)
            fixed = ("link_T", body.pos.copy(), body.quat.copy())
            calls.append(("joint_T", step.q) if step.joint else fixed)
        steps, T = [], np.eye(4)
        for step, given in zip(right, fns.many(*calls), strict=True):
            end = step.link == END and not step.joint
            factor = given @ arm.chain.T_link_frame if end else given
            off = ~(np.abs(factor - step.factor) < AGREES)
            made = {"before": T, "factor": factor, "after": T @ factor, "off": off}
            steps.append(step._replace(**made))
            T = T @ factor
        return steps


class Order(ui.Declared):
    """T_extra on either side: the tool moves, or the whole arm moves."""

    title = "Order"
    wide = False  # the two matrices above stay
    library = LIBRARY
    functions = {"make_T": ENTRY, "Rz": ENTRY, "translations_both_orders": "m"}

    side = ui.choice("T_extra", [BOTH, RIGHT, LEFT])
    angle = ui.slider("rotation about z", -np.pi, np.pi, np.pi / 4)
    x = ui.slider("translation along x", -0.3, 0.3, 0.1, "m")
    result = ui.panel.html()
    arm = ui.yours.ghost("purple", legend="T_extra on the left moves the whole arm")
    at_right = ui.yours.frame("T_world_ee @ T_extra")
    at_left = ui.yours.frame("T_extra @ T_world_ee")
    lines = ui.yours.lines(
        ui.NOWHERE, "orange",
        legend="from the hand to the positions that your function returns",
    )  # fmt: skip

    def ask(self, fns, at):
        """Return T_world_ee, T_extra, and both ends by `translations_both_orders`."""
        T_world_ee = self.page.arm.poses_at(at.q)[END]
        T_extra = fns.make_T(fns.Rz(at.angle), np.array([at.x, 0.0, 0.0]))
        return T_world_ee, T_extra, fns.translations_both_orders(T_world_ee, T_extra)

    def show(self, yours, _) -> None:
        T_world_ee, T_extra, ends = yours
        right, left = T_world_ee @ T_extra, T_extra @ T_world_ee
        self.at_right.place(right)
        self.at_left.place(left)
        self.at_right.show(self.side != LEFT, chosen=self.side == RIGHT)
        self.at_left.show(self.side != RIGHT, chosen=self.side == LEFT)
        links = self.page.links(self.page.q)
        moved = {name: T_extra @ T for name, T in links.items()}
        self.arm.pose({} if self.side == RIGHT else moved)
        some = {RIGHT: ends[:1], LEFT: ends[1:], BOTH: ends}[self.side]
        self.lines.points = np.array([[T_world_ee[:3, 3], end] for end in some])
        name, T = ("left", left) if self.side == LEFT else ("right", right)
        self.page.matrix(self.result, f"T_extra on the {name}", T)

    def says(self, yours, _):
        T_world_ee, T_extra, ends = yours
        both = (T_world_ee @ T_extra)[:3, 3], (T_extra @ T_world_ee)[:3, 3]
        apart = float(np.linalg.norm(both[0] - both[1]))
        yield (
            {
                RIGHT: "On the right: the tool moves along its own axes.",
                LEFT: "On the left: the whole arm rotates and moves (purple).",
                BOTH: f"The distance between the two positions is {apart:.4f} m.",
            }[self.side],
            None,
        )
        off = [1000 * np.linalg.norm(p - q) for p, q in zip(ends, both, strict=True)]
        told = " and ".join(f"{mm:.1f} mm" for mm in off)
        yield (
            f"Errors of your translations_both_orders: {told}, right and left.",
            "make_T Rz translations_both_orders",
        )


TABS = [common_tabs.Joints, Chain, Order]
