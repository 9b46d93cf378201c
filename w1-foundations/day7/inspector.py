"""Day 7 in the inspector: the tabs Plan and Pick.

Plan: the student's own trajectory from the arm's configuration to the lab's goal, and
its joint velocities compared with their limits. Pick: the capstone at its table, with
the student's own functions of today, or of all days.
"""

from functools import cache, partial
from types import SimpleNamespace

import mujoco
import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.draw import joined
from labkit.inspector.own import week
from robo47 import capstone, panda, scenes, simulate, trajectory
from robo47.capstone.phases import Result
from robo47.checks import Array

GOAL_Q = np.array([0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6])  # the lab's
QUINTIC, TRAPEZOID = "quintic", "trapezoid"
PICK, STOP = "pick it", "stop"
ARM = slice(0, 7)
LATE = 1e-9  # of the time
LEAST = 1e-3  # s, the shortest duration that is played
COUNT = 60  # times at which the student's functions are evaluated
TODAY, ALL = "of today", "of all days"
MOVE = "(rad, rad/s or rad/s2)"
ENTRY = "in one entry"
LIMITS = simulate.SPEED_LIMITS
TITLE = "joint velocities and their limits"


class Plan(ui.Declared):
    """The student's trajectory, and its joint velocities beside their limits."""

    title = "Plan"
    library = trajectory
    functions = {
        "quintic_duration": "s", "joint_trajectory": MOVE,
        "trapezoidal_profile": "(1, 1/s or 1/s2)",
    }  # fmt: skip

    kind = ui.choice("time scaling", [QUINTIC, TRAPEZOID])
    # The fraction of the limits that is allowed; over 1 exceeds them.
    hurry = ui.slider("fraction of the limits", 0.1, 1.5, 1.0, "")
    does = ui.buttons("play / stop", then="press")
    bars = ui.panel.bars(panda.ARM_JOINTS, LIMITS, "rad/s", TITLE)
    plot = ui.panel.plot([*panda.ARM_JOINTS, "limit"], y="velocity / limit", height=180)
    ghost = ui.yours.ghost("blue", legend="arm on your trajectory")
    way = ui.yours.curve(np.zeros((COUNT, 3)), "purple", 4.0, legend="path of its hand")

    def prepare(self) -> None:
        self.arm = panda.arm(self.page.model)
        self.T, self.q, self.qd = 1.0, *np.zeros((2, COUNT, 7))
        self.share = 0.0  # of the duration
        self.to_play = False
        self.time = self.page.slider(
            "fraction of the time", 0.0, 1.0, 0.0, self.go, unit=""
        )

    def press(self) -> None:
        """Play or stop."""
        self.loop.toggle()

    def go(self, share: float) -> None:
        """Show the arm after a fraction of the duration."""
        self.share = share
        i = round(share * (COUNT - 1))
        self.ghost.pose(self.page.links(self.q[i]))
        self.bars.show(self.qd[i])
        self.tell()

    def frame(self, seconds: float) -> bool:
        self.go(min(seconds / max(abs(self.T), LEAST), 1.0))
        self.time.value = self.share
        return self.share < 1.0

    def begin(self) -> None:
        """Play the trajectory as soon as it is computed."""
        self.loop.stop()
        self.to_play = True
        self.request()

    def ask(self, fns, at) -> tuple[float, Array, Array]:
        """Return the duration T, and q and qd, (COUNT, 7), of the motion."""
        q0 = at.q[ARM]
        dq = GOAL_Q - q0
        s = np.linspace(0.0, 1.0, COUNT)
        v, a = at.hurry * LIMITS, at.hurry * simulate.ACC_LIMITS
        if at.kind == QUINTIC:
            T = float(fns.quintic_duration(dq, v, a))
            plays = max(abs(T), LEAST)
            moves = np.array(fns.many(*(
                ("joint_trajectory", q0, GOAL_Q, float(t), plays) for t in s * plays
            )))  # fmt: skip
            return T, moves[:, 0], moves[:, 1]
        top, ramp = top_and_ramp(dq, at.hurry)
        T = 1.0 / top + ramp
        # A little late: the acceleration jumps at the start and at the end.
        late = np.clip(s, LATE, 1.0 + LATE) * T
        calls = [("trapezoidal_profile", float(t), 1.0, top, top / ramp) for t in late]
        part = np.array(fns.many(*calls))
        return T, q0 + dq * part[:, :1], dq * part[:, 1:2]

    def show(self, yours, _) -> None:
        self.T, self.q, self.qd = yours
        self.way.points = joined([self.arm.at(q).T_world_ee[:3, 3] for q in self.q])
        times = np.linspace(0.0, abs(self.T), COUNT)
        self.plot.show(times, [*(np.abs(self.qd) / LIMITS).T, np.ones(COUNT)])
        i = round(self.share * (COUNT - 1))
        self.ghost.pose(self.page.links(self.q[i]))
        self.bars.show(self.qd[i])
        if self.to_play and not self.emptied:
            self.to_play = False
            self.loop.start()

    def says(self, yours, _):
        T, _, qd = yours
        most = float((np.abs(qd) / LIMITS).max())
        says = f"t = {self.share * T:.2f} of {T:.3f} s; "
        says += f"at most {most:.0%} of a velocity limit"
        if T <= 0.0:
            says += "; the duration must be positive, so the motion is played in 1 ms"
        names = "quintic_duration joint_trajectory"
        names = names if self.kind == QUINTIC else "trapezoidal_profile"
        yield says, False if most > 1 + 1e-6 or T <= 0.0 else names

    def lost(self) -> None:
        self.loop.stop()
        super().lost()


def top_and_ramp(dq: Array, hurry: float) -> tuple[float, float]:
    """Return the highest velocity of s in the trapezoid, and a ramp's duration."""
    dq = np.maximum(np.abs(dq), 1e-9)
    v = float((hurry * LIMITS / dq).min())
    a = float((hurry * simulate.ACC_LIMITS / dq).min())
    top = min(v, float(np.sqrt(a)))
    return top, top / a


@cache
def _scene() -> mujoco.MjModel:
    return scenes.table_top(capstone.CUBE_XY, capstone.YAW)


dressed = partial(scenes.table_top, capstone.CUBE_XY, capstone.YAW, meshes=True)


class Pick(ui.Declared):
    """The capstone, at its table."""

    title = "Pick"
    camera = ((1.75, -1.15, 0.95), (0.55, 0.25, 0.35))
    library = trajectory
    functions = {
        "quintic_scaling": "", "quintic_duration": "s", "joint_trajectory": MOVE,
        "interpolate_pose": ENTRY, "grasp_pose": ENTRY, "combine_bodies": ENTRY,
        "max_cube_mass": "kg",
    }  # fmt: skip

    whose = ui.choice("your functions", [TODAY, ALL], then="stop")
    does = ui.buttons(PICK, STOP, then="press")
    bars = ui.panel.bars(panda.ARM_JOINTS, LIMITS, "rad/s", TITLE)
    robot = ui.panel.robot(_scene, dressed)

    def prepare(self) -> None:
        half, goal = scenes.CUBE_HALF, [*capstone.GOAL_XY, scenes.TABLE_HEIGHT]
        corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]) * half
        ring = np.column_stack([corners + goal[:2], np.full(5, goal[2] + 1e-3)])
        self.page.draw.curve(ring, "blue", 4.0)
        self.legend("the target of the cube", "blue")
        self.stand()

    def stand(self) -> None:
        """Show the start: nothing is picked yet."""
        self.done: Result | None = None
        self.now = 0.0
        self.robot.show(simulate.start(_scene(), panda.READY_Q).qpos)
        self.bars.clear()

    def begin(self) -> None:
        self.does = PICK
        self.press()

    def stop(self) -> None:
        """Stop the pick, and show the start."""
        self.loop.stop()
        self.stand()

    def press(self) -> None:
        """Start the pick, or stop it."""
        self.loop.stop()
        if self.does == PICK:
            self.stand()
            self.tell()
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
        self.stop()
        super().lost()

    def picked(self, found: tuple[Result, str]) -> None:
        """Replay it."""
        self.done, self.mine = found
        self.loop.start()

    def frame(self, seconds: float) -> bool:
        done = self.done
        if done is None:
            return False
        self.now = seconds
        i = min(int(np.searchsorted(done.t, seconds)), len(done.t) - 1)
        before = done.qpos[max(i - 1, 0), ARM]
        self.bars.show((done.qpos[i, ARM] - before) * capstone.RATE)
        self.robot.show(done.qpos[i])
        return i < len(done.t) - 1

    def says(self, *_):
        done = self.done
        if done is None:
            yield (
                "The simulation runs: some seconds, up to a minute with all days.",
                None,
            )
            return
        phase = [name for name, t in done.phases if t <= self.now][-1]
        yield f"t = {self.now:.1f} of {done.seconds:.1f} s: {phase}", None
        if self.now >= done.t[-1]:
            yield (
                f"The cube was placed {done.place_mm:.1f} mm from its target; the grip "
                f"can lift {done.heaviest:.2f} kg by max_cube_mass{self.mine}.",
                False if done.failed else " ".join(self.functions),
            )


TABS = [Plan, Pick]
