"""Day 4 in the inspector: the tab Forces.

A ball at each link's centre of mass, the torques that hold the arm as bars against the
motors' limits, M as coloured cells, and the arm in a real simulation: let go, floating
on gravity compensation, or floating and pushed.
"""

import mujoco
import numpy as np

from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import panda, simulate
from robo47.checks import Array

JOINTS = 7
NAMES = [f"joint{i}" for i in range(1, JOINTS + 1)]
LET_GO, FLOAT, PUSH, STOP = "let go", "float", "push", "stop"
FORCE, PUSHED = np.array([0.0, 10.0, 0.0]), 0.5  # newtons in the world; seconds
HZ, RATE = 30.0, 100.0  # of the picture; of the controller
LENGTH = 0.02  # metres of an arrow per newton


class Forces(Tab):
    """What holds the arm, what it weighs, and what it does when you let go."""

    title = "Forces"
    wide = True  # M needs the room of the matrices

    def __init__(self, page: Page) -> None:
        """Draw the centres of mass; nothing runs yet."""
        super().__init__(page)
        self.rig = panda.arm(page.model)
        entry = "panda_nohand" if page.model.nq == JOINTS else "panda"
        self.model = panda.load(entry, drive="torque")
        self.data = mujoco.MjData(self.model)
        self.share, self.falls, self.force = 1.0, False, 0 * FORCE
        self.shown = page.q
        page.buttons([LET_GO, FLOAT, PUSH, STOP], self.press)
        page.slider("share of gravity", 0.0, 1.2, 1.0, self.weigh, unit="of g")
        limits = simulate.limits(self.model)[1]
        self.bars = page.bars(NAMES, limits, "N m", "torque that holds the arm")
        self.cells = page.html()
        radii = 0.03 * np.cbrt(self.rig.masses)  # the volume says what a link weighs
        self.balls = [page.draw.sphere(np.zeros(3), r, "orange") for r in radii]
        self.arrow = page.draw.arrows(np.zeros((1, 2, 3)), "red", 0.01)
        self.loop = page.animate(self.advance, HZ)
        self.on_move(page.q)

    def weigh(self, share: float) -> None:
        """Hold the arm with that share of its weight."""
        self.share = share

    def press(self, name: str) -> None:
        """Start a simulation where the arm is, or stop it."""
        self.loop.stop()
        self.force = FORCE if name == PUSH else 0 * FORCE
        self.falls = name == LET_GO
        if name == STOP:
            self.on_move(self.page.q)
            return
        self.data = simulate.start(self.model, self.page.q[:JOINTS])
        self.shown = self.page.q
        self.loop.start()

    def advance(self, seconds: float) -> None:
        """Simulate until the next picture."""
        if not np.array_equal(self.page.q, self.shown):  # somebody moved a slider
            self.data = simulate.start(self.model, self.page.q[:JOINTS])
        push = None
        if seconds < PUSHED and self.force.any():
            push = self._push
        period = 1.0 / RATE
        until = self.data.time + 1.0 / HZ
        while self.data.time < until:
            simulate.run(self.model, self.data, self.hold, period, rate=RATE, push=push)
        self.shown = self.page.q
        self.shown[:JOINTS] = self.data.qpos[:JOINTS]
        self.page.move(self.shown)

    def hold(self, t: float, q: Array, qd: Array) -> Array:
        """Return the torque of a share of gravity, or none."""
        return (0.0 if self.falls else self.share) * self.rig.at(q).gravity_torque

    def _push(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        body = model.body("link7").id
        point = self.rig.at(data.qpos[:JOINTS]).T_world_ee[:3, 3]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_applyFT(
            model, data, self.force, np.zeros(3), point, body, data.qfrc_applied
        )

    def on_move(self, q: Array) -> None:
        """Show masses, torques and M where the arm is."""
        now = self.rig.at(q[:JOINTS])
        for ball, com in zip(self.balls, now.coms_world, strict=True):
            ball.position = com
        self.bars.show(np.round(now.gravity_torque, 2) + 0.0)
        self.cells.content = heat_map(now.M)
        pushing = self.loop.running and self.force.any() and self.data.time < PUSHED
        hand = now.T_world_ee[:3, 3]
        ends = np.array([[hand - LENGTH * self.force, hand]])
        self.arrow.points = ends.astype(np.float32)
        self.arrow.visible = bool(pushing)
        heaviest = int(np.argmax(np.abs(now.gravity_torque)))
        self.page.say(
            f"{NAMES[heaviest]} holds most: {now.gravity_torque[heaviest]:.2f} N m. "
            f"Least eigenvalue of M: {np.linalg.eigvalsh(now.M).min():.3f} kg m2."
        )


def heat_map(M: Array) -> str:
    """Return M as a table of coloured cells: blue above 0, red below, as HTML.

    Args:
        M: mass matrix, kg m2, (7, 7).
    """
    rows = []
    for row in np.round(M, 2) + 0.0:  # no -0.00
        cells = ""
        for value in row:
            shade = min(abs(value), 1.0) ** 0.5  # small entries can be seen, too
            colour = "28,100,242" if value > 0 else "224,49,49"
            cells += (
                f'<td style="background:rgba({colour},{0.7 * shade:.2f});'
                f'padding:2px 4px;text-align:right">{value:.2f}</td>'
            )
        rows.append(f"<tr>{cells}</tr>")
    table = "".join(rows)
    style = "font:11px monospace;border-collapse:collapse;margin-left:10px"
    title = '<b style="margin-left:10px">M, kg m2</b>'
    return f'<div>{title}<table style="{style}">{table}</table></div>'


TABS = [Forces]
