"""Day 6 in the inspector: the tab Touch.

The student's own impedance controller holds the hand. Drag the handle to pull the hand,
push the elbow, or let the hand press on the table. The arm is simulated, with torques
from the student's functions at 100 Hz.
"""

from functools import cache, partial

import mujoco
import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.draw import joined
from robo47 import control, jacobian, panda, scenes, simulate, task_space
from robo47.checks import Array
from robo47.rotation_log import small_pose_error

RATE = 100.0  # of the controller
TURN, BACK = 30.0, 4.0  # N m/rad of the hand; N m s/rad of the elbow
HUGE = 1e4  # N m; with more the simulator reports an instability
PULL = 100.0  # N per metre that the handle is away
PRESS = 20.0  # N, on the table
MOST = 60.0  # N, where the bar of the table's force ends
LONG = 0.04  # metres of the ellipsoid's half axis per root of a kilogram
AGAIN, LET_GO, READY = "start / stop", "let go", "press the table"


@cache
def _scene() -> mujoco.MjModel:
    return scenes.press_table()


dressed = partial(scenes.press_table, meshes=True)


class Touch(ui.Declared):
    """Pull a soft hand and observe its displacement."""

    title = "Touch"
    camera = ((1.75, -1.3, 0.95), (0.5, 0.25, 0.42))
    library = task_space
    functions = {
        "task_inertia": "(kg, kg m or kg m2)",
        "critical_damping": "(N s/m or N m s/rad)", "nullspace_torque": "N m",
        "impedance_wrench": "(N or N m)", "impedance_torque": "N m",
    }  # fmt: skip
    hz = 25.0

    k = ui.slider("stiffness of the hand", 50, 2000, 400.0, "N/m", 50, then="frame")
    hold = ui.slider("stiffness of the elbow", 0, 40, 10.0, "N m/rad", 1, then="frame")
    at_elbow = ui.slider("push at the elbow", -30, 30, 0.0, "N", 1, then="go_on")
    does = ui.buttons(AGAIN, LET_GO, READY, then="press")
    bars = ui.panel.bars(["table"], MOST, "N", "force on the table", "scale")
    drawn = ui.panel.robot(_scene, dressed)
    mass = ui.yours.ellipsoid("purple", legend="inertia of the hand")
    arrow = ui.scene.arrows(ui.NOWHERE, "red", 0.008, legend="your pull")
    target = ui.handle("drag")

    def prepare(self) -> None:
        self.arm = panda.arm(_scene())
        self.weighed: tuple[Array, Array] | None = None  # Lambda, the library's
        self.rest(self.page.q[:7])

    def rest(self, q: Array) -> None:
        """Put the arm at rest at q, (7,), which is its goal, without a pull."""
        self.goal_q = q.copy()
        self.force = np.zeros(3)
        self.data = simulate.start(_scene(), self.goal_q)

    def goal(self) -> Array:
        """Return the pose that the hand is held at, (4, 4)."""
        return self.arm.at(self.goal_q).T_world_ee.copy()

    def go_on(self) -> None:
        """Simulate from here on."""
        self.loop.start()

    def drag(self, T: Array) -> None:
        """Pull at the hand, towards the handle."""
        self.force = PULL * (T[:3, 3] - self.goal()[:3, 3])
        self.loop.start()

    def press(self) -> None:
        """Start, stop, let go, or press on the table from just above it."""
        if self.does == AGAIN:
            self.loop.toggle()
            return
        self.force = np.zeros(3)
        if self.does == READY:
            q = self.page.q
            q[:7] = _over_the_table()
            self.page.move(q)
            self.rest(q[:7])
            self.force[2] = -PRESS
        self.target.place(self.goal())
        self.loop.start()

    def restart(self) -> None:
        """Pull with a tenth of PULL along x."""
        self.rest(self.goal_q)
        self.force[0] = 0.1 * PULL
        T = self.goal()
        T[:3, 3] += self.force / PULL
        self.target.place(T)

    def on_move(self, q: Array) -> None:
        self.goal_q = q[:7].copy()
        if not self.loop.running:
            self.data = simulate.start(_scene(), self.goal_q)
            now = self.arm.at(self.goal_q)
            self.page.job(
                lambda: self.weigh(now.J_site, now.M), lambda _: self._frame(0.0)
            )

    def weigh(self, J: Array, M: Array) -> Array:
        """Return the student's Lambda, and keep it beside the library's; it waits."""
        Lambda: Array = self.own.task_inertia(J, M)
        self.weighed = Lambda, task_space.task_inertia(J, M)
        return Lambda

    def lost(self) -> None:
        super().lost()
        self.weighed = None
        if not self.loop.running:
            self.rest(self.goal_q)
            self.drawn.show(self.data.qpos)
            self.arrow.visible = False

    def advance(self, seconds: float) -> None:
        given = (_scene(), self.data, self.law(), 1.0 / self.hz)
        simulate.run(*given, rate=RATE, push=self.push)

    def law(self) -> simulate.Controller:
        """Return the student's soft hand, with the chosen stiffness."""
        T_goal = self.goal()
        K = np.array([TURN] * 3 + [self.k] * 3)
        own = self.own

        def torque(t: float, q: Array, qd: Array) -> Array:
            now = self.arm.at(q)
            J, M = now.J_site, now.M
            Lambda = self.weigh(J, M)
            e = small_pose_error(now.T_world_ee, T_goal)
            back = control.pd_torque(self.goal_q - q, -qd, self.hold, BACK)
            D, idle = own.many(
                ("critical_damping", K, Lambda),
                ("nullspace_torque", J, M, Lambda, back),
            )
            F = own.impedance_wrench(e, -J @ qd, np.diag(K), D)
            bias = now.bias(qd)
            rub = self.arm.damping
            wanted = own.impedance_torque(J, F, bias, rub, qd, idle)
            return np.clip(wanted, -HUGE, HUGE)

        return torque

    def push(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Apply the pull at the hand and the push at the elbow, for one step."""
        simulate.push_at("attachment_site", [0, 0, 0, *self.force])(model, data)
        link4 = model.body("link4").id
        F = np.array([0.0, self.at_elbow, 0.0])
        none = np.zeros(3)
        point = data.xpos[link4]
        mujoco.mj_applyFT(model, data, F, none, point, link4, data.qfrc_applied)

    def frame(self, seconds: float = 0.0) -> None:
        now = self.arm.at(self.data.qpos[:7].copy())
        hand = now.T_world_ee[:3, 3]
        self.drawn.show(self.data.qpos)
        self.arrow.visible = bool(self.force.any())
        self.arrow.points = joined([hand, hand + self.force / PULL])
        self.bars.show([self.felt()])
        self.mass.visible = self.weighed is not None
        if self.weighed is not None:
            self.mass.show(self.weighed[0][3:, 3:], hand, LONG)

    def felt(self) -> float:
        """Return the force of the pen on the table, N."""
        return scenes.contact_force(_scene(), self.data, "tip", "table_top")

    def says(self, *_):
        hand = self.arm.at(self.data.qpos[:7].copy()).T_world_ee[:3, 3]
        moved = 1000 * (hand - self.goal()[:3, 3])
        F = f"t = {self.data.time:.1f} s. Pull ({_three(self.force)}) N; in the air "
        predicted = f"F / k = ({_three(1000 * self.force / self.k)}) mm"
        laws = "critical_damping nullspace_torque impedance_wrench impedance_torque"
        yield f"{F}{predicted}, moved ({_three(moved)}) mm.", laws
        if self.weighed is not None:
            mine, ours = (
                ", ".join(f"{m:.1f}" for m in np.diag(x)[3:]) for x in self.weighed
            )
            says = f"Diagonal of your Lambda: {mine} kg along x, y, z"
            says += "." if mine == ours else f"; of the library's {ours} kg."
            yield says, "task_inertia"


@cache
def _over_the_table() -> Array:
    arm = panda.arm(_scene())
    model = _scene()
    T = arm.at(panda.READY_Q).T_world_ee.copy()
    T[:3, 3] = *scenes.PRESS_XY, scenes.TOUCH + 0.001
    ranges, _ = simulate.limits(model)
    return jacobian.solve_ik(arm.screws, arm.M_home, T, panda.READY_Q, ranges)


def _three(v: Array) -> str:
    return ", ".join(f"{x:z.1f}" for x in v)


TABS = [Touch]
