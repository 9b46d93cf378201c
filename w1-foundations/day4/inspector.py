"""Day 4 in the inspector: the tab Forces.

The tab shows a sphere at each link's centre of mass, the student's gravity torques as
bars with marks at the correct values, and the student's mass matrix as coloured cells.
In a simulation the arm is let go, floats on the student's gravity torque, or is pushed.
With a wrong sign it falls.
"""

from functools import cache, partial

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.draw import joined
from robo47 import dynamics, panda, simulate
from robo47.checks import Array

JOINTS = 7
LET_GO, FLOAT, PUSH, BACK = "let go", "float", "push", "back"
FORCE = np.array([0.0, 10.0, 0.0])  # newtons, in the world
PUSHED = 0.5  # seconds
RATE = 100.0  # of the controller
HUGE = 1e4  # N m; with more the simulator reports an instability
LENGTH = 0.02  # metres of an arrow per newton
SAME = 1e-6  # kg m2 of an entry of M

bare = cache(partial(panda.load, "panda_nohand", drive="torque"))


class Forces(ui.Declared):
    """The gravity torques, the mass matrix, and the motion of the arm if released."""

    title = "Forces"
    library = dynamics
    functions = {
        "gravity_torque": "N m", "mass_matrix": "kg m2",
        "link_inertias": "(kg, kg m or kg m2)",
    }  # fmt: skip
    solid = False  # the masses are inside of the links
    hz = 25.0

    share = ui.slider("fraction of your gravity_torque", 0.0, 1.2, 1.0, "", then="keep")
    does = ui.buttons(LET_GO, FLOAT, PUSH, BACK, then="press")
    bars = ui.panel.bars(
        panda.ARM_JOINTS, simulate.limits(bare())[1], "N m",
        "gravity_torque; a mark is the torque that holds the arm",
    )  # fmt: skip
    cells = ui.panel.html()
    arrow = ui.scene.arrows(ui.NOWHERE, "red", 0.01, legend="the push")

    def prepare(self) -> None:
        self.rig = panda.arm(self.page.model)
        self.weights = panda.inertias(self.page.model)
        hand = self.page.model.nq > JOINTS
        self.model = panda.load("panda", drive="torque") if hand else bare()
        radii = 0.03 * np.cbrt(self.rig.masses)  # the volume shows the mass
        draw = self.page.draw
        self.balls = [draw.sphere(np.zeros(3), r, "orange", 0.95) for r in radii]
        self.data = simulate.start(self.model, self.page.q[:JOINTS])
        self.begun = self.moved = self.page.q
        self.legend("centre of mass of a link; the volume shows the mass", "orange")

    def keep(self) -> None:
        """Take the fraction from now on."""

    def press(self) -> None:
        """Start a simulation where the last one began, or go back there."""
        self.loop.stop()
        if not np.array_equal(self.page.q, self.moved):  # somebody moved it
            self.begun = self.page.q
        self.data = simulate.start(self.model, self.begun[:JOINTS])
        if self.does == BACK:
            self.frame()
        else:
            self.loop.start()

    def restart(self) -> None:
        """Float on the student's torque: a right one holds the arm, a wrong one not."""
        self.does = FLOAT
        self.press()
        self.loop.stop()

    def advance(self, seconds: float) -> None:
        if not np.array_equal(self.page.q, self.moved):  # somebody moved a slider
            self.data = simulate.start(self.model, self.page.q[:JOINTS])
        push = None
        if self.does == PUSH and seconds < PUSHED:
            wrench = np.append(np.zeros(3), FORCE)
            push = simulate.push_at("attachment_site", wrench)
        given = (self.model, self.data, self.hold, 1.0 / self.hz)
        simulate.run(*given, rate=RATE, push=push)

    def hold(self, t: float, q: Array, qd: Array) -> Array:
        """Return a fraction of the student's gravity torque, or none."""
        if self.does == LET_GO:
            return np.zeros(JOINTS)
        wanted = self.share * self.own.gravity_torque(*self.pulled(q))
        return np.clip(wanted, -HUGE, HUGE)

    def pulled(self, q: Array) -> tuple[Array, ...]:
        """Return what gravity_torque is given at q."""
        now = self.rig.at(q)
        return now.J_space, self.rig.masses, now.coms_world, self.rig.gravity

    def frame(self, seconds: float = 0.0) -> None:
        self.moved = self.page.q
        self.moved[:JOINTS] = self.data.qpos[:JOINTS]
        self.page.move(self.moved)

    def on_move(self, q: Array) -> None:
        now = self.rig.at(q[:JOINTS])
        for ball, com in zip(self.balls, now.coms_world, strict=True):
            ball.position = com
        pushing = self.loop.running and self.does == PUSH and self.data.time < PUSHED
        hand = now.T_world_ee[:3, 3]
        self.arrow.visible = bool(pushing)
        self.arrow.points = joined([hand - LENGTH * FORCE, hand])
        self.request()

    def ask(self, fns, at) -> tuple[Array, Array]:
        """Return the gravity torques and the mass matrix."""
        q = at.q[:JOINTS]
        now = self.rig.at(q)
        G = fns.link_inertias(now.T_links, *self.weights)
        return tuple(fns.many(
            ("gravity_torque", *self.pulled(q)),
            ("mass_matrix", now.J_space, G, self.rig.armature),
        ))  # fmt: skip

    def show(self, yours, right) -> None:
        self.bars.show(yours[0], right[0])
        self.cells.content = heat_map(yours[1], np.abs(yours[1] - right[1]) > SAME)

    def says(self, yours, right):
        speed = float(np.abs(self.data.qvel[:JOINTS]).max())
        drifts = "gravity_torque" if self.does == FLOAT and self.share == 1.0 else None
        time = f"t = {self.data.time:.1f} s; "
        yield f"{time}largest joint velocity {speed:.2f} rad/s", drifts
        most = int(np.argmax(np.abs(right[0])))
        name = panda.ARM_JOINTS[most]
        yield f"Largest torque: {right[0][most]:.1f} N m at {name}.", None
        M = (yours[1] + yours[1].T) / 2
        least = np.linalg.eigvalsh(M).min()
        of = "link_inertias mass_matrix"
        yield f"Smallest eigenvalue of your M: {least:.3f} kg m2.", of

    def lost(self) -> None:
        super().lost()
        if not self.loop.running:
            self.data = simulate.start(self.model, self.begun[:JOINTS])
            self.frame()


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
