"""Day 7 in the inspector: the tab Plan.

A blue arm goes along a trajectory from where the arm stands to the lab's goal; the bars
are its joint speeds against their limits. "Pick it" plays the capstone, cube and all.
All of it is the library's, `robo47.trajectory`; the tab says so.
"""

import threading

import numpy as np

from labkit.inspector import words
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import capstone, kinematics, panda, scenes, simulate, trajectory
from robo47.capstone.phases import Result
from robo47.checks import Array

GOAL_Q = np.array([0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6])  # the lab's
JOINTS = [f"joint{i}" for i in range(1, 8)]
QUINTIC, TRAPEZOID = "quintic", "trapezoid"
PLAY, PICK = "play / stop", "pick it"
ORANGE = (242, 140, 38)
ARM, CUBE = slice(0, 7), slice(9, 16)  # in the capstone's qpos


class Plan(Tab):
    """When is the arm where, and how fast may it be?"""

    title = "Plan"
    wide = True

    def __init__(self, page: Page) -> None:
        """Make the sliders, the bars and the blue arm; nothing moves yet."""
        super().__init__(page)
        self.kind, self.hurry, self.share = QUINTIC, 1.0, 0.0
        self.done: Result | None = None
        self.began: float | None = None
        self.arm = panda.arm(page.model)
        page.html(words.line("The blue arm is moved by robo47.trajectory.", "library"))
        page.choice("time scaling", [QUINTIC, TRAPEZOID], self.choose)
        page.slider("of the limits", 0.1, 1.5, 1.0, self.set_hurry, unit="")
        self.slider = page.slider("done", 0.0, 1.0, 0.0, self.go, unit="of T")
        page.buttons([PLAY, PICK], self.press)
        self.numbers = page.html()
        limits = simulate.SPEED_LIMITS
        self.bars = page.bars(JOINTS, limits, "rad/s", "joint speeds and limits")
        self.loop = page.animate(self.play)
        self.picking = page.animate(self.replay)
        self.ghost = page.draw.ghost("blue")
        self.way = page.draw.curve(self._way(page.q), "purple", 4.0)
        edge = 2.0 * scenes.CUBE_HALF
        self.cube = page.scene.add_box(
            page.draw.path(), color=ORANGE, dimensions=(edge, edge, edge), visible=False
        )

    def choose(self, kind: str) -> None:
        """Take another time scaling."""
        self.kind = kind
        self.show()

    def set_hurry(self, hurry: float) -> None:
        """Choose the share of the limits that is used up; over 1 breaks them."""
        self.hurry = hurry
        self.show()

    def go(self, share: float) -> None:
        """Show the arm when a share of the time is over."""
        self.share = share
        self.show()

    def press(self, name: str) -> None:
        """Play the move, stop it, or have the cube picked."""
        running = self.loop.running or self.picking.running
        self.loop.stop()
        self.picking.stop()
        if name == PICK:
            self.page.say("computing the capstone, a second or two", "")
            if self.done is None:
                threading.Thread(target=self._compute, daemon=True).start()
            self.began = None
            self.picking.start()
        elif not running:
            self.loop.start()

    def _compute(self) -> None:
        self.done = capstone.pick(capstone.library())

    def play(self, seconds: float) -> bool:
        """Go on in real time; return whether there is more."""
        self.share = min(seconds / self.duration(), 1.0)
        self.slider.set(self.share)
        self.show()
        return self.share < 1.0

    def replay(self, seconds: float) -> bool:
        """Show the capstone as soon as it is computed; return whether there is more."""
        if self.done is None:
            return True
        self.began = seconds if self.began is None else self.began
        now = seconds - self.began
        i = min(int(np.searchsorted(self.done.t, now)), len(self.done.t) - 1)
        phase = [name for name, t in self.done.phases if t <= now][-1]
        before = self.done.qpos[max(i - 1, 0), ARM]
        speed = (self.done.qpos[i, ARM] - before) * capstone.RATE
        self._draw(self.done.qpos[i, ARM], speed)
        pose = self.done.qpos[i, CUBE]
        self.cube.position, self.cube.wxyz = tuple(pose[:3]), tuple(pose[3:])
        self.cube.visible = True
        self.numbers.content = words.line(f"{phase}, {now:.1f} s", "plan")
        if i < len(self.done.t) - 1:
            return True
        self.page.say(f"placed {self.done.place_mm:.1f} mm from its goal", "good")
        return False

    def on_move(self, q: Array) -> None:
        """Start from where the arm is now."""
        ends = self._way(q)
        self.way.points = np.stack([ends[:-1], ends[1:]], axis=1).astype(np.float32)
        if not self.picking.running:
            self.show()

    def duration(self) -> float:
        """Return the time of the whole move, seconds."""
        dq = GOAL_Q - self.page.q[ARM]
        v, a = self.hurry * simulate.SPEED_LIMITS, self.hurry * simulate.ACC_LIMITS
        if self.kind == QUINTIC:
            return max(float(trajectory.quintic_duration(dq, v, a)), 1e-3)
        top, ramp = self._top(dq)
        return 1.0 / top + ramp

    def _top(self, dq: Array) -> tuple[float, float]:
        """Return the trapezoid's top speed of s and how long its ramp takes."""
        dq = np.maximum(np.abs(dq), 1e-9)
        v = float((self.hurry * simulate.SPEED_LIMITS / dq).min())
        a = float((self.hurry * simulate.ACC_LIMITS / dq).min())
        top = min(v, float(np.sqrt(a)))
        return top, top / a

    def at(self, share: float) -> tuple[Array, Array]:
        """Return q and qd, (7,) each, when a share of the time is over."""
        q0 = self.page.q[ARM]
        T = self.duration()
        if self.kind == QUINTIC:
            q, qd, _ = trajectory.joint_move(q0, GOAL_Q, share * T, T)
            return q, qd
        top, ramp = self._top(GOAL_Q - q0)
        s, sd, _ = trajectory.trapezoid(share * T, 1.0, top, top / ramp)
        return q0 + (GOAL_Q - q0) * s, (GOAL_Q - q0) * sd

    def show(self) -> None:
        """Show the blue arm and its speeds at the chosen moment."""
        q, qd = self.at(self.share)
        self._draw(q, qd)
        T = self.duration()
        share = float((np.abs(qd) / simulate.SPEED_LIMITS).max())
        text = f"t = {self.share * T:.3f} of {T:.3f} s; {share:.0%} of a speed limit"
        self.numbers.content = words.line(text, "plan")

    def _draw(self, q: Array, qd: Array) -> None:
        full = self.page.q.copy()
        full[ARM] = q
        poses = kinematics.fk_all(self.page.model, full)
        bodies = [name for name in poses if name.startswith("body:")]
        self.ghost.pose({name.removeprefix("body:"): poses[name] for name in bodies})
        self.bars.show(qd)

    def _way(self, q: Array) -> Array:
        """Return where the end goes, (n, 3): an arc, for joints that go straight."""
        s = np.linspace(0.0, 1.0, 40)[:, None]
        poses = [self.arm.at(x).T_world_ee for x in q[ARM] + (GOAL_Q - q[ARM]) * s]
        return np.array(poses)[:, :3, 3]


TABS = [Plan]
