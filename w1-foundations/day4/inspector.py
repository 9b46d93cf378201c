"""Day 4 in the inspector: the tab Forces.

The tab shows a sphere at each link's centre of mass, the student's gravity torques as
bars with marks at the correct values, and the student's mass matrix as coloured cells.
In a simulation the arm is let go, floats on the student's gravity torque, or is pushed.
With a wrong sign it falls.
"""

from functools import partial

import numpy as np

from labkit.inspector import words
from labkit.inspector.draw import joined
from labkit.inspector.page import Page
from labkit.inspector.tab import PLAYS, Tab
from robo47 import dynamics, panda, simulate
from robo47.checks import Array

JOINTS = 7
LET_GO = "let go"
FLOAT = "float"
PUSH = "push"
BACK = "back"
FORCE = np.array([0.0, 10.0, 0.0])  # newtons, in the world
PUSHED = 0.5  # seconds
HZ, RATE = 25.0, 100.0  # of the picture; of the controller
HUGE = 1e4  # N m; with more the simulator reports an instability
LENGTH = 0.02  # metres of an arrow per newton
SAME = 1e-6  # kg m2 of an entry of M
UNITS = {
    "gravity_torque": "N m", "mass_matrix": "kg m2",
    "link_inertias": "(kg, kg m or kg m2)",
}  # fmt: skip


class Forces(Tab):
    """The gravity torques, the mass matrix, and the motion of the arm if released."""

    title = "Forces"
    wide = True  # M needs the room of the matrices

    def __init__(self, page: Page) -> None:
        """Draw the centres of mass; nothing runs yet."""
        super().__init__(page)
        self.rig = panda.arm(page.model)
        self.weights = panda.inertias(page.model)
        entry = "panda_nohand" if page.model.nq == JOINTS else "panda"
        self.model = panda.load(entry, drive="torque")
        self.data = simulate.start(self.model, page.q[:JOINTS])
        self.share = 1.0
        self.force = 0 * FORCE
        self.falls = False
        self.begun = self.shown = page.q
        self.own = page.own(dynamics, units=UNITS)
        page.buttons([LET_GO, FLOAT, PUSH, BACK], self.press)
        set_share = partial(setattr, self, "share")
        page.slider(
            "fraction of your gravity_torque", 0.0, 1.2, 1.0, set_share, unit=""
        )
        self.clock = page.html()
        limits = simulate.limits(self.model)[1]
        title = "gravity_torque; a mark is the torque that holds the arm"
        self.bars = page.bars(panda.ARM_JOINTS, limits, "N m", title)
        self.cells = page.html()
        radii = 0.03 * np.cbrt(
            self.rig.masses
        )  # the volume is proportional to the mass
        self.balls = [page.draw.sphere(np.zeros(3), r, "orange") for r in radii]
        self.arrow = page.draw.arrows(np.zeros((1, 2, 3)), "red", 0.01)
        self.loop = page.animate(self.show_arm, HZ, work=self.advance)
        page.light("ee", {"ee"})
        page.legend({"centre of mass of a link; the volume shows the mass": "orange"})

    def press(self, name: str) -> None:
        """Start a simulation where the last one began, or go back there."""
        self.loop.stop()
        if not np.array_equal(self.page.q, self.shown):  # somebody moved it
            self.begun = self.page.q
        self.force = FORCE if name == PUSH else 0 * FORCE
        self.falls = name == LET_GO
        self.data = simulate.start(self.model, self.begun[:JOINTS])
        if name == BACK:
            self.show_arm(0.0)
        else:
            self.loop.start()

    def begin(self) -> None:
        """Float on the student's torque: a right one holds the arm, a wrong one not."""
        self.press(FLOAT)
        self.loop.lasts = PLAYS

    def advance(self, seconds: float) -> None:
        """Simulate until the next picture; it waits for the student's torques."""
        if not np.array_equal(self.page.q, self.shown):  # somebody moved a slider
            self.data = simulate.start(self.model, self.page.q[:JOINTS])
        data = self.data
        push = None
        if self.force.any() and seconds < PUSHED:
            wrench = np.append(np.zeros(3), self.force)
            push = simulate.push_at("attachment_site", wrench)
        steps = round(RATE / HZ)
        simulate.run(self.model, data, self.hold, steps / RATE, rate=RATE, push=push)

    def hold(self, t: float, q: Array, qd: Array) -> Array:
        """Return a fraction of the student's gravity torque, or none."""
        if self.falls:
            return np.zeros(JOINTS)
        wanted = self.share * self.own.gravity_torque(*self.pulled(q))
        return np.clip(wanted, -HUGE, HUGE)

    def pulled(self, q: Array) -> tuple[Array, ...]:
        """Return what gravity_torque is given at q."""
        now = self.rig.at(q)
        return now.J_space, self.rig.masses, now.coms_world, self.rig.gravity

    def show_arm(self, seconds: float) -> None:
        """Move the arm to where the simulation is."""
        self.shown = self.page.q
        self.shown[:JOINTS] = self.data.qpos[:JOINTS]
        self.page.move(self.shown)
        t = self.data.time
        speed = float(np.abs(self.data.qvel[:JOINTS]).max())
        says = f"t = {t:.1f} s; largest joint velocity {speed:.2f} rad/s"
        self.clock.content = words.line(says, "clock")

    def on_move(self, q: Array) -> None:
        """Show masses and the push; ask for torques and M."""
        now = self.rig.at(q[:JOINTS])
        for ball, com in zip(self.balls, now.coms_world, strict=True):
            ball.position = com
        pushing = self.loop.running and self.force.any() and self.data.time < PUSHED
        hand = now.T_world_ee[:3, 3]
        self.arrow.visible = bool(pushing)
        if pushing:
            self.arrow.points = joined([hand - LENGTH * self.force, hand])
        self.page.job(lambda: self.ask(q[:JOINTS]), self.show)

    def ask(self, q: Array) -> tuple[Array, Array, Array, Array]:
        """Return the student's torques, the needed ones, the student's M, the right."""
        now = self.rig.at(q)
        given = self.pulled(q)
        G = self.own.link_inertias(now.T_links, *self.weights)
        tau, M = self.own.many(
            ("gravity_torque", *given),
            ("mass_matrix", now.J_space, G, self.rig.armature),
        )
        return tau, now.gravity_torque, M, now.M

    def show(self, found: tuple[Array, Array, Array, Array]) -> None:
        """Show the torques beside those needed, and M."""
        tau, needed, M, right = found
        self.bars.show(tau, needed)
        self.cells.content = heat_map(M, np.abs(M - right) > SAME)
        heaviest = int(np.argmax(np.abs(needed)))
        self.page.say(
            f"Largest torque: {needed[heaviest]:.1f} N m at "
            f"{panda.ARM_JOINTS[heaviest]}. "
            f"Smallest eigenvalue of M: {np.linalg.eigvalsh((M + M.T) / 2).min():.3f} "
            "kg m2."
        )

    def lost(self) -> None:
        """Show no torques and no M, and the arm where it began."""
        if not self.loop.running:
            self.data = simulate.start(self.model, self.begun[:JOINTS])
            self.show_arm(0.0)
        self.page.say("")
        self.bars.clear()
        self.cells.content = self.clock.content = ""


def heat_map(M: Array, wrong: Array | None = None) -> str:
    """Return M, kg m2, (7, 7), as coloured cells: blue above 0, red below, as HTML.

    Wrong entries, (7, 7) of bool, are marked.
    """
    rows = []
    for row, off in zip(np.round(M, 2) + 0.0, wrong if wrong is not None else 0 * M):
        cells = ""
        for value, bad in zip(row, off, strict=True):
            shade = min(abs(value), 1.0) ** 0.5  # small entries can be seen, too
            colour = "28,100,242" if value > 0 else "224,49,49"
            mark = ";outline:1px solid var(--r47-bad)" if bad else ""
            cells += (
                f'<td style="background:rgba({colour},{0.7 * shade:.2f});'
                f'padding:2px 4px;text-align:right{mark}">{value:.2f}</td>'
            )
        rows.append(f"<tr>{cells}</tr>")
    table = (
        f'<table style="font:11px monospace;border-collapse:collapse">{"".join(rows)}'
    )
    return f'<div class="r47"><b>M, kg m2</b>{table}</table></div>'


TABS = [Forces]
