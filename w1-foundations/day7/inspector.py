"""Day 7 in the inspector: the tabs Plan and Pick.

Plan: the student's own trajectory from the arm's configuration to the lab's goal, and
its joint velocities compared with their limits. Pick: the capstone at its table, with
the student's own functions of today, or of all days.
"""

from functools import cache, partial
from types import SimpleNamespace

import mujoco
import numpy as np

from labkit.inspector import words
from labkit.inspector.draw import joined
from labkit.inspector.own import week
from labkit.inspector.page import Page
from labkit.inspector.robot import Robot
from labkit.inspector.tab import Tab
from robo47 import capstone, panda, scenes, simulate, trajectory
from robo47.capstone.phases import Result
from robo47.checks import Array

GOAL_Q = np.array([0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6])  # the lab's
QUINTIC, TRAPEZOID = "quintic", "trapezoid"
PLAY, PICK, STOP = "play / stop", "pick it", "stop"
ARM = slice(0, 7)
LATE = 1e-9  # of the time
LEAST = 1e-3  # s, the shortest duration that is played
COUNT = 60  # times at which the student's functions are evaluated
TODAY, ALL = "of today", "of all days"
UNITS = {"quintic_duration": "s", "joint_trajectory": "(rad, rad/s or rad/s2)",
         "trapezoidal_profile": "(1, 1/s or 1/s2)", "max_cube_mass": "kg",
         "grasp_pose": "in one entry", "interpolate_pose": "in one entry",
         "combine_bodies": "in one entry"}  # fmt: skip


class Plan(Tab):
    """The student's trajectory, and its joint velocities beside their limits."""

    title = "Plan"
    wide = True

    def __init__(self, page: Page) -> None:
        """Make the sliders, the bars and the moving arm; nothing moves yet."""
        super().__init__(page)
        self.kind = QUINTIC
        self.hurry = 1.0
        self.share = 0.0
        self.arm = panda.arm(page.model)
        self.T = 1.0
        self.q = self.qd = np.zeros((COUNT, 7))
        self.to_play = False
        self.own = page.own(trajectory, units=UNITS)
        page.choice("time scaling", [QUINTIC, TRAPEZOID], self.sets("kind"))
        # The fraction of the limits that is allowed; over 1 exceeds them.
        page.slider(
            "fraction of the limits", 0.1, 1.5, 1.0, self.sets("hurry"), unit=""
        )
        self.slider = page.slider(
            "fraction of the time", 0.0, 1.0, 0.0, self.go, unit=""
        )
        page.buttons([PLAY], lambda _: self.loop.toggle())
        self.numbers = page.html()
        limits = simulate.SPEED_LIMITS
        title = "joint velocities and their limits"
        self.bars = page.bars(panda.ARM_JOINTS, limits, "rad/s", title)
        curves = [*panda.ARM_JOINTS, "limit"]
        self.plot = page.plot(curves, y="velocity / limit", height=180)
        self.loop = page.animate(self.play)
        self.ghost = page.draw.ghost("blue")
        self.way = page.draw.curve(np.zeros((COUNT, 3)), "purple", 4.0)
        page.light("ee", {"ee"})
        page.legend({"arm on your trajectory": "blue", "path of its hand": "purple"})

    def go(self, share: float) -> None:
        """Show the arm after a fraction of the duration."""
        self.share = share
        self.show()

    def play(self, seconds: float) -> bool:
        """Go on in real time; return whether there is more."""
        self.share = min(seconds / max(abs(self.T), LEAST), 1.0)
        self.slider.value = self.share
        self.show()
        return self.share < 1.0

    def begin(self) -> None:
        """Play the trajectory as soon as it is computed."""
        self.loop.stop()
        self.to_play = True
        self.on_move(self.page.q)

    def on_move(self, q: Array) -> None:
        """Compute the trajectory from the present configuration."""
        self.page.job(lambda: self.plan(q[ARM]), self.planned)

    def plan(self, q0: Array) -> tuple[float, Array, Array]:
        """Return the student's duration T, and q and qd, (COUNT, 7), of the motion."""
        dq = GOAL_Q - q0
        s = np.linspace(0.0, 1.0, COUNT)
        v, a = self.hurry * simulate.SPEED_LIMITS, self.hurry * simulate.ACC_LIMITS
        if self.kind == QUINTIC:
            T = float(self.own.quintic_duration(dq, v, a))
            plays = max(abs(T), LEAST)
            calls = [
                ("joint_trajectory", q0, GOAL_Q, float(t), plays) for t in s * plays
            ]
            moves = np.array(self.own.many(*calls))
            return T, moves[:, 0], moves[:, 1]
        top, ramp = self._top(dq)
        T = 1.0 / top + ramp
        # A little late: the acceleration jumps at the start and at the end.
        late = np.clip(s, LATE, 1.0 + LATE) * T
        calls = [("trapezoidal_profile", float(t), 1.0, top, top / ramp) for t in late]
        part = np.array(self.own.many(*calls))
        return T, q0 + dq * part[:, :1], dq * part[:, 1:2]

    def _top(self, dq: Array) -> tuple[float, float]:
        """Return the highest velocity of s in the trapezoid, and a ramp's duration."""
        dq = np.maximum(np.abs(dq), 1e-9)
        v = float((self.hurry * simulate.SPEED_LIMITS / dq).min())
        a = float((self.hurry * simulate.ACC_LIMITS / dq).min())
        top = min(v, float(np.sqrt(a)))
        return top, top / a

    def planned(self, found: tuple[float, Array, Array]) -> None:
        """Show the whole trajectory."""
        self.T, self.q, self.qd = found
        p = np.array([self.arm.at(q).T_world_ee[:3, 3] for q in self.q])
        self.way.points = joined(p)
        parts = np.abs(self.qd) / simulate.SPEED_LIMITS
        times = np.linspace(0.0, abs(self.T), COUNT)
        self.plot.show(times, [*parts.T, np.ones(COUNT)])
        self.show()
        if self.to_play:
            self.to_play = False
            self.loop.start()

    def lost(self) -> None:
        """Show no trajectory."""
        self.loop.stop()
        self.ghost.pose({})
        self.way.points = joined(np.zeros((COUNT, 3)))
        self.bars.clear()
        self.plot.clear()
        self.numbers.content = ""

    def show(self) -> None:
        """Show the blue arm and its joint velocities at the chosen time."""
        i = round(self.share * (COUNT - 1))
        self.ghost.pose(self.page.links(self.q[i]))
        self.bars.show(self.qd[i])
        most = float((np.abs(self.qd) / simulate.SPEED_LIMITS).max())
        t = f"t = {self.share * self.T:.2f} of {self.T:.3f} s"
        says = f"{t}; at most {most:.0%} of a velocity limit"
        if self.T <= 0.0:
            says += "; the duration must be positive, so the motion is played in 1 ms"
        kind = "bad" if most > 1 + 1e-6 or self.T <= 0.0 else ""
        self.numbers.content = words.line(says, "plan", kind)


@cache
def _scene() -> mujoco.MjModel:
    return scenes.table_top(capstone.CUBE_XY, capstone.YAW)


dressed = partial(scenes.table_top, capstone.CUBE_XY, capstone.YAW, meshes=True)


class Pick(Tab):
    """The capstone, at its table."""

    title = "Pick"
    wide = True
    camera = ((1.75, -1.15, 0.95), (0.55, 0.25, 0.35))

    def __init__(self, page: Page) -> None:
        """Show the arm at the table; nothing moves yet."""
        super().__init__(page)
        self.own = page.own(trajectory, units=UNITS)
        self.whose = TODAY
        self.begun = 0.0
        self.done: Result | None = None
        page.choice("your functions", [TODAY, ALL], partial(setattr, self, "whose"))
        page.buttons([PICK, STOP], self.press)
        self.clock = page.html()
        limits = simulate.SPEED_LIMITS
        title = "joint velocities and their limits"
        self.bars = page.bars(panda.ARM_JOINTS, limits, "rad/s", title)
        self.loop = page.animate(self.replay)
        self.robot = Robot(page, _scene(), dressed)
        goal = [*capstone.GOAL_XY, scenes.TABLE_HEIGHT]
        half = scenes.CUBE_HALF
        corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]) * half
        ring = np.column_stack([corners + goal[:2], np.full(5, goal[2] + 1e-3)])
        page.draw.curve(ring, "blue", 4.0)
        page.legend({"the cube": "orange", "its target": "blue"})
        self.stand()

    def stand(self) -> None:
        """Show the start: nothing is picked yet."""
        self.robot.show(simulate.start(_scene(), panda.READY_Q).qpos)
        self.bars.clear()

    def begin(self) -> None:
        """Start the pick."""
        self.press(PICK)

    def press(self, name: str) -> None:
        """Start the pick, or stop it."""
        self.loop.stop()
        if name == PICK:
            says = "the simulation runs: some seconds, with all days up to a minute"
            self.clock.content = words.line(says, "clock", "quiet")
            self.page.say("")
            self.stand()
            self.page.job(self.pick, self.picked)

    def pick(self) -> tuple[Result, str]:
        """Return the pick by the student's functions, and how many are theirs."""
        fns = vars(capstone.library())
        if self.whose == TODAY:
            own = {name: getattr(self.own, name) for name in capstone.USES[7]}
            return capstone.pick(SimpleNamespace(**{**fns, **own})), ""
        with week(fns) as mine:
            done = capstone.pick(mine)
            return done, f"; {mine.yours} of {mine.total} functions are yours"

    def lost(self) -> None:
        """Nothing was picked."""
        self.loop.stop()
        self.stand()
        self.clock.content = ""

    def picked(self, found: tuple[Result, str]) -> None:
        """Replay it."""
        self.done, self.mine = found
        self.loop.start()

    def replay(self, seconds: float) -> bool:
        """Show the capstone in real time; return whether there is more."""
        done = self.done
        assert done is not None
        i = min(int(np.searchsorted(done.t, seconds)), len(done.t) - 1)
        phase = [name for name, t in done.phases if t <= seconds][-1]
        before = done.qpos[max(i - 1, 0), ARM]
        self.bars.show((done.qpos[i, ARM] - before) * capstone.RATE)
        self.robot.show(done.qpos[i])
        says = f"t = {seconds:.1f} of {done.seconds:.1f} s: {phase}"
        self.clock.content = words.line(says, "clock")
        if i < len(done.t) - 1:
            return True
        kind = "bad" if done.failed else "good"
        self.page.say(
            f"placed {done.place_mm:.1f} mm from its target; the grip can lift "
            f"{done.heaviest:.2f} kg by max_cube_mass{self.mine}", kind
        )  # fmt: skip
        return False


TABS = [Plan, Pick]
