"""Day 6 in the inspector: the tab Touch.

The student's own impedance controller holds the hand. Drag the handle to pull the hand,
push the elbow, or let the hand press on the table. The arm is simulated, with torques
from the student's functions at 100 Hz.
"""

from functools import cache, partial

import mujoco
import numpy as np

from labkit.inspector import words
from labkit.inspector.draw import joined
from labkit.inspector.instruments import three
from labkit.inspector.page import Page
from labkit.inspector.robot import Robot
from labkit.inspector.tab import PLAYS, Tab
from robo47 import control, jacobian, panda, scenes, simulate, task_space
from robo47.checks import Array
from robo47.rotation_log import small_pose_error

RATE, HZ = 100.0, 25.0  # of the controller, and of the picture
TURN, BACK = 30.0, 4.0  # N m/rad of the hand; N m s/rad of the elbow
HUGE = 1e4  # N m; with more the simulator reports an instability
PULL = 100.0  # N per metre that the handle is away
PRESS = 20.0  # N, on the table
MOST = 60.0  # N, where the bar of the table's force ends
LONG = 0.04  # metres of the ellipsoid's half axis per root of a kilogram
UNITS = {
    "task_inertia": "(kg, kg m or kg m2)", "critical_damping": "(N s/m or N m s/rad)",
    "nullspace_torque": "N m", "impedance_wrench": "(N or N m)",
    "impedance_torque": "N m",
}  # fmt: skip
AGAIN, LET_GO, READY = "start / stop", "let go", "press the table"


@cache
def _scene() -> mujoco.MjModel:
    return scenes.press_table()


dressed = partial(scenes.press_table, meshes=True)


class Touch(Tab):
    """Pull a soft hand and observe its displacement."""

    title = "Touch"
    wide = True
    camera = ((1.75, -1.3, 0.95), (0.5, 0.25, 0.42))

    def __init__(self, page: Page) -> None:
        """Make the sliders, the handle and the arm at its table; nothing runs yet."""
        super().__init__(page)
        self.robot = _scene()
        self.arm = panda.arm(_scene())
        self.force = np.zeros(3)
        self.at_elbow = 0.0
        self.k = 400.0
        self.hold = 10.0
        self.goal_q = page.q[:7].copy()
        self.data = simulate.start(self.robot, self.goal_q)
        self.Lambda: Array | None = None  # the student's, of the last torque
        self.weighed: tuple[Array, Array]  # where: J and M
        self.own = page.own(task_space, units=UNITS)
        page.buttons([AGAIN, LET_GO, READY], self.press)
        stiffness = "stiffness of the hand"
        page.slider(stiffness, 50, 2000, self.k, self.set_k, unit="N/m", step=50)
        unit = "N m/rad"
        hold = partial(setattr, self, "hold")
        page.slider("stiffness of the elbow", 0, 40, self.hold, hold, unit=unit, step=1)
        page.slider("push at the elbow", -30, 30, 0, self.set_elbow, unit="N", step=1)
        self.numbers = page.html()
        self.bars = page.bars(["table"], MOST, "N", "force on the table", "scale")
        self.loop = page.animate(lambda seconds: self.show(), HZ, work=self.step)
        self.drawn = Robot(page, self.robot, dressed)
        self.mass = page.draw.ellipsoid("purple")
        self.arrow = page.draw.arrows(np.zeros((1, 2, 3)), "red", 0.008)
        self.target = page.draw.target(page.pose("ee"), self.drag)
        page.legend({"your pull": "red", "inertia of the hand": "purple"})
        self.show()

    def set_k(self, k: float) -> None:
        """Choose the stiffness of the hand."""
        self.k = k
        self.show()

    def set_elbow(self, force: float) -> None:
        """Push at link4, along y."""
        self.at_elbow = force
        self.loop.start()

    def drag(self, T: Array) -> None:
        """Pull at the hand, towards the handle."""
        self.force = PULL * (T[:3, 3] - self.arm.at(self.goal_q).T_world_ee[:3, 3])
        self.loop.start()
        self.show()

    def press(self, name: str) -> None:
        """Start, stop, let go, or press on the table from just above it."""
        if name == AGAIN:
            self.loop.toggle()
            return
        self.force = np.zeros(3)
        if name == READY:
            q = self.page.q
            q[:7] = self.goal_q = _over_the_table()
            self.page.move(q)
            self.data = simulate.start(self.robot, self.goal_q)
            self.force[2] = -PRESS
        self.target.place(self.arm.at(self.goal_q).T_world_ee)
        self.loop.start()
        self.show()

    def on_move(self, q: Array) -> None:
        """Take the page's configuration as the wanted one."""
        self.goal_q = q[:7].copy()
        if not self.loop.running:
            self.data = simulate.start(self.robot, self.goal_q)
            now = self.arm.at(self.goal_q)
            self.page.job(lambda: self.weigh(now.J_site, now.M), lambda _: self.show())
        self.show()

    def begin(self) -> None:
        """Pull at the hand with 10 N along x."""
        self.data = simulate.start(self.robot, self.goal_q)
        self.force = np.array([0.1 * PULL, 0.0, 0.0])
        T = self.arm.at(self.goal_q).T_world_ee.copy()
        T[:3, 3] += self.force / PULL
        self.target.place(T)
        self.loop.stop()
        self.loop.start(PLAYS)

    def weigh(self, J: Array, M: Array) -> Array:
        """Return the student's Lambda, and keep it; it waits for them."""
        Lambda: Array = self.own.task_inertia(J, M)
        self.Lambda, self.weighed = Lambda, (J, M)
        return Lambda

    def lost(self) -> None:
        """Show no numbers and no mass, and the arm where it began."""
        self.Lambda = None
        if not self.loop.running:
            self.data = simulate.start(self.robot, self.goal_q)
            self.drawn.show(self.data.qpos)
            self.arrow.visible = False
        self.mass.ball.visible = False
        self.bars.clear()
        self.numbers.content = ""

    def step(self, seconds: float) -> None:
        """Simulate one picture's time; it waits for the student's torques."""
        simulate.run(
            self.robot, self.data, self.law(), 1.0 / HZ, rate=RATE, push=self.push
        )

    def law(self) -> simulate.Controller:
        """Return the student's soft hand, with the chosen stiffness."""
        T_goal = self.arm.at(self.goal_q).T_world_ee
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

    def show(self) -> None:
        """Draw the arm, its inertia and the pull, and show the prediction."""
        q = self.data.qpos[:7].copy()
        now = self.arm.at(q)
        goal = self.arm.at(self.goal_q).T_world_ee[:3, 3]
        hand = now.T_world_ee[:3, 3]
        self.drawn.show(self.data.qpos)
        self.arrow.visible = bool(self.force.any())
        if self.force.any():
            self.arrow.points = joined([hand, hand + self.force / PULL])
        felt = scenes.contact_force(self.robot, self.data, "tip", "table_top")
        self.bars.show([felt])
        predicted = 1000 * self.force / self.k
        moved = 1000 * (hand - goal)
        if self.Lambda is None:
            weighs = "Lambda of the hand is not known."
        else:
            mass = self.Lambda[3:, 3:]
            self.mass.show(mass, hand, LONG)
            kilograms = ", ".join(f"{m:.1f}" for m in np.diag(mass))
            truth = task_space.task_inertia(*self.weighed)[3:, 3:]
            ours = ", ".join(f"{m:.1f}" for m in np.diag(truth))
            weighs = f"Diagonal of your Lambda: {kilograms} kg along x, y, z"
            weighs += "." if kilograms == ours else f"; of the library's {ours}."
        self.numbers.content = words.line(
            f"t = {self.data.time:.1f} s. Pull ({_three(self.force)}) N; in the air "
            f"F / k = ({_three(predicted)}) mm, moved ({_three(moved)}) mm. {weighs} "
            f"Force on the table: {three(felt, MOST)} N.",
            "touch",
        )


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
