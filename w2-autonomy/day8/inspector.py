"""Day 8 in the inspector: the tab Weigh.

Hang a ball on the hand of the lab's secret robot and let it be held, from both sides.
What `robo47.identification` finds stands there with its sigma; the blue ball is where.
"""

import numpy as np

from labkit.inspector import words
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import identification, panda
from robo47.checks import Array

import day8_mujoco

SEED = 47
RTOL = 1e-9
WAIT = 2.0  # s
HERE, FIVE, FORGET = "hold here", "five poses", "forget"


class Weigh(Tab):
    """What the arm weighs: a load, its estimate, and how sure that is."""

    title = "Weigh"
    wide = True

    def __init__(self, page: Page) -> None:
        """Draw the load; nothing is held yet."""
        super().__init__(page)
        model = panda.load("panda_nohand", drive="torque")
        self.arm = panda.arm(model)
        self.empty = day8_mujoco.changed(model, SEED)
        self.mass = 0.5
        self.com = np.array([0.02, -0.03, 0.06])
        self.held: list[Array] = []  # q, torque with and without, from either side
        page.html(words.line("Weighed by robo47.identification.", "library"))
        page.slider("load", 50, 2000, 500, self.hang, unit="g", step=50)
        page.slider("below the hand", 0, 200, 60, self.lower, unit="mm", step=5)
        page.buttons([HERE, FIVE, FORGET], self.press)
        self.table = page.html()
        self.ball = page.draw.sphere(np.zeros(3), day8_mujoco.RADIUS, "orange", 0.5)
        self.found = page.draw.sphere(np.zeros(3), day8_mujoco.RADIUS / 2, "blue")
        page.light("ee", {"ee"})
        self.show()

    def hang(self, grams: float) -> None:
        """Hang another load on the hand, which was never held."""
        self.mass = grams / 1000.0
        self.press(FORGET)

    def lower(self, mm: float) -> None:
        """Hang it lower, or higher."""
        self.com[2] = mm / 1000.0
        self.press(FORGET)

    def press(self, name: str) -> None:
        """Hold the arm where it is, or in five poses near by; or forget all holds."""
        poses = [self.page.q[:7]] if name == HERE else []
        if name == FIVE:
            beside = np.random.default_rng(SEED).uniform(-0.5, 0.5, (5, 7))
            poses = list(panda.READY_Q + beside)
        if name != HERE:  # the same holds again would only look like more
            self.held = []
        edit = day8_mujoco.load(self.mass, self.com)
        hung = panda.load("panda_nohand", drive="torque", edit=edit)
        full = day8_mujoco.changed(hung, SEED)
        for pose in poses:
            _, empty = day8_mujoco.holds(self.empty, self.arm, [pose], WAIT)
            held = day8_mujoco.holds(full, self.arm, [pose], WAIT)
            self.held.append(np.array([*held, empty]))
        self.show()

    def on_move(self, q: Array) -> None:
        """Move both balls with the hand."""
        self.show()

    def weighed(self) -> dict[str, tuple[Array, Array]]:
        """Return (m, m c) and its sigma, (4,) each, by how the holds are compared."""
        q, full, empty = np.concatenate(self.held, axis=2)  # (side, pose, joint) each
        ways = {
            "from one side": (q[0], full[0] - empty[0]),
            "one from either side": (q[1], full[1] - empty[0]),
            "both, averaged": (q.mean(axis=0), (full - empty).mean(axis=0)),
        }
        found = {}
        for name, (at, extra) in ways.items():
            J, R = day8_mujoco.hands(self.arm, at)
            rows = identification.load_regressor(J, R, self.arm.gravity).reshape(-1, 4)
            given = rows, extra.ravel(), np.eye(4), RTOL
            found[name] = identification.predict_with_sigma(*given)
            self.rank, _ = identification.identifiable(rows, RTOL)
        return found

    def show(self) -> None:
        """Draw both balls and say what was found."""
        T = self.arm.at(self.page.q[:7]).T_world_ee
        self.ball.position = T[:3, 3] + T[:3, :3] @ self.com
        self.found.visible = bool(self.held)
        if not self.held:
            self.table.content = words.line("Not held yet.", "weighed")
            return
        lines = []
        for name, (load, sigma) in self.weighed().items():
            c, off = 1000 * load[1:] / load[0], 1000 * sigma[1:] / load[0]
            centre = ", ".join(f"{x:z.1f}" for x in c)
            lines.append(
                f"{name}: {1000 * load[0]:.1f} g, sigma {1000 * sigma[0]:.1f}; centre "
                f"{centre} mm, sigma {off.max():.1f}"
            )
            self.found.position = T[:3, 3] + T[:3, :3] @ c / 1000.0
        poses = f"{len(self.held)} held, {self.rank} of 4 numbers show"
        hidden = ": the centre along gravity does not" if self.rank < 4 else ""
        text = [f"{poses}{hidden}; hung are {1000 * self.mass:.0f} g.", *lines]
        self.table.content = "".join(
            words.line(line, "weighed" if k else "shown") for k, line in enumerate(text)
        )


TABS = [Weigh]
