"""Day 6 in the inspector: the tab Touch.

The arm stands where the hand is wanted. A blue one beside it is simulated as it is held
there by a spring: drag the handle to pull at its hand, pull at its elbow, put a table
under it. All of it is the library's, `robo47.task_space`; the tab says so.
"""

from functools import cache

import mujoco
import numpy as np

from labkit.inspector import words
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import (
    contact,
    control,
    jacobian,
    kinematics,
    panda,
    scenes,
    simulate,
    task_space,
)
from robo47.checks import Array

RATE, HZ = 100.0, 50.0  # of the controller, and of the picture
TURN, BACK = 30.0, 4.0  # Nm/rad of the hand; Nm s/rad of the elbow
PULL = 100.0  # N per metre that the handle is away
LONG = 0.04  # metres of the ellipsoid's half axis per root of a kilogram
AGAIN, LET_GO, READY = "start / stop", "let go", "to the table"


@cache
def _scene() -> mujoco.MjModel:
    return scenes.press_table()


class Touch(Tab):
    """Pull at a soft hand, and see how it gives way."""

    title = "Touch"
    wide = True

    def __init__(self, page: Page) -> None:
        """Make the sliders, the handle and the blue arm; nothing runs yet."""
        super().__init__(page)
        self.robot, self.arm = _scene(), panda.arm(_scene())
        self.force, self.at_elbow, self.k, self.hold = np.zeros(3), 0.0, 400.0, 10.0
        self.goal_q = page.q[:7].copy()
        self.data = simulate.start(self.robot, self.goal_q)
        page.html(words.line("The blue arm is held by robo47.task_space.", "library"))
        page.slider("spring", 50, 2000, self.k, self.set_k, unit="N/m", step=50)
        page.slider("elbow held", 0, 40, self.hold, self.set_hold, unit="Nm/rad")
        page.slider("push at the elbow", -30, 30, 0, self.set_elbow, unit="N", step=1)
        page.buttons([AGAIN, LET_GO, READY], self.press)
        self.numbers = page.html()
        self.bars = page.bars(["table"], 60.0, "N", "contact force")
        self.loop = page.animate(self.step, HZ)
        self.ghost = page.draw.ghost("blue")
        self.mass = page.draw.ellipsoid("purple")
        self.arrow = page.draw.arrow(np.zeros(3), np.full(3, 1e-3), "red", 0.008)
        self.target = page.draw.target(page.pose("ee"), self.drag)
        page.light("ee", {"ee"})
        self.show()

    def set_k(self, k: float) -> None:
        """Choose the stiffness of the hand."""
        self.k = k
        self.show()

    def set_hold(self, hold: float) -> None:
        """Choose how firmly the elbow is held."""
        self.hold = hold

    def set_elbow(self, force: float) -> None:
        """Push at link4, along y."""
        self.at_elbow = force

    def drag(self, T: Array) -> None:
        """Pull at the hand, towards the handle."""
        self.force = PULL * (T[:3, 3] - self.arm.at(self.goal_q).T_world_ee[:3, 3])
        self.show()

    def press(self, name: str) -> None:
        """Start, stop, let go, or stand over the table with 50 mm to go below it."""
        if name == AGAIN:
            if self.loop.running:
                self.loop.stop()
            else:
                self.loop.start()
            return
        self.force = np.zeros(3)
        if name == READY:
            q = self.page.q
            q[:7] = self.goal_q = _over_the_table()
            self.page.move(q)
            self.data = simulate.start(self.robot, self.goal_q)
            self.force[2] = -20.0
        self.target.place(self.arm.at(self.goal_q).T_world_ee)
        self.show()

    def on_move(self, q: Array) -> None:
        """Take the arm's configuration as the wanted one."""
        self.goal_q = q[:7].copy()
        if not self.loop.running:
            self.data = simulate.start(self.robot, self.goal_q)
        self.show()

    def step(self, seconds: float) -> None:
        """Go on for one picture."""
        law = self.law()
        simulate.run(self.robot, self.data, law, 1.0 / HZ, rate=RATE, push=self.push)
        self.show()

    def law(self) -> simulate.Controller:
        """Return the library's soft hand, with the chosen stiffness."""
        T_goal = self.arm.at(self.goal_q).T_world_ee
        K = np.array([TURN] * 3 + [self.k] * 3)

        def torque(t: float, q: Array, qd: Array) -> Array:
            now = self.arm.at(q)
            J = now.J_site
            Lambda = task_space.task_inertia(J, now.M)
            D = task_space.critical_damping(K, Lambda)
            e = contact.pose_error(now.T_world_ee, T_goal)
            F = task_space.spring_wrench(e, -J @ qd, np.diag(K), D)
            back = control.pd_torque(self.goal_q - q, -qd, self.hold, BACK)
            idle = task_space.null_torque(J, now.M, Lambda, back)
            bias, rub = now.bias(qd), self.arm.damping
            return task_space.impedance_torque(J, F, bias, rub, qd, idle)

        return torque

    def push(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Apply the pull at the hand and the push at the elbow, for one step."""
        simulate.push_at("attachment_site", [0, 0, 0, *self.force])(model, data)
        link4 = model.body("link4").id
        F, none = np.array([0.0, self.at_elbow, 0.0]), np.zeros(3)
        point = data.xpos[link4]
        mujoco.mj_applyFT(model, data, F, none, point, link4, data.qfrc_applied)

    def show(self) -> None:
        """Draw the blue arm, its mass and the pull, and say what was predicted."""
        q = self.data.qpos[:7].copy()
        now, goal = self.arm.at(q), self.arm.at(self.goal_q).T_world_ee[:3, 3]
        hand = now.T_world_ee[:3, 3]
        poses = kinematics.fk_all(self.robot, q)
        self.ghost.pose({
            name.removeprefix("body:"): T
            for name, T in poses.items()
            if name.startswith("body:link")
        })  # fmt: skip
        mass = task_space.task_inertia(now.J_site, now.M)[3:, 3:]
        self.mass.show(mass, hand, LONG)
        end = hand + np.where(self.force, self.force, 1e-4) / PULL
        self.arrow.points = np.array([[hand, end]], dtype=np.float32)
        felt = scenes.contact_force(self.robot, self.data, "tip", "table_top")
        self.bars.show([felt])
        predicted, moved = 1000 * self.force / self.k, 1000 * (hand - goal)
        kilograms = ", ".join(f"{m:.1f}" for m in np.diag(mass))
        self.numbers.content = words.line(
            f"pull ({_three(self.force)}) N; in the air F / k = ({_three(predicted)}) "
            f"mm, moved ({_three(moved)}) mm. The hand weighs {kilograms} kg along "
            f"x, y, z. The table feels {felt:.1f} N.",
            "touch",
        )


@cache
def _over_the_table() -> Array:
    arm, model = panda.arm(_scene()), _scene()
    T = arm.at(panda.READY_Q).T_world_ee.copy()
    T[:3, 3] = *scenes.PRESS_XY, scenes.TOUCH + 0.001
    ranges, _ = simulate.limits(model)
    return jacobian.solve_ik(arm.screws, arm.M_home, T, panda.READY_Q, ranges)


def _three(v: Array) -> str:
    return ", ".join(f"{x:.1f}" for x in np.round(v, 1) + 0.0)


TABS = [Touch]
