"""The phases of the pick, and the measurements during them.

Units: metres, radians, seconds, N m; poses `T_world_x` are (4, 4).
"""

from typing import Any, NamedTuple

import mujoco
import numpy as np

from robo47 import scenes, simulate, trajectory
from robo47.capstone.arm import STIFFNESS, Arm, Law
from robo47.checks import Array
from robo47.panda import READY_Q

# `make capstone` has the cube, its goal and its yaw here: metres and radians.
CUBE_XY = (0.5, 0.2)
GOAL_XY = (0.5, -0.2)
YAW = 0.5
HOVER = 0.12  # m over the cube, between joint moves and straight lines
LINE_SECONDS = 0.75  # duration of those 0.12 m: the hand peaks at 1.23 m/s2
GRIP_SECONDS = 0.4  # time to close or open the fingers
REST_SECONDS = 0.3  # time at the end, held by springs
PUT_DOWN = 1.0  # N, how hard the cube is pressed on the table before it is let go
OPEN, CLOSED = 255.0, 0.0  # ctrl of the hand's servo


class Phase(NamedTuple):
    """One step of the task: its name, how it moves, to where, with what fingers."""

    name: str
    kind: str  # "joint", "line", "hold" or "rest"
    over: str  # "cube", "goal" or "" for home
    above: float  # m
    fingers: float


PHASES = (
    Phase("reach", "joint", "cube", HOVER, OPEN),
    Phase("descend", "line", "cube", 0.0, OPEN),
    Phase("close", "hold", "cube", 0.0, CLOSED),
    Phase("lift", "line", "cube", HOVER, CLOSED),
    Phase("carry", "joint", "goal", HOVER, CLOSED),
    Phase("put down", "line", "goal", 0.0, CLOSED),
    Phase("open", "hold", "goal", 0.0, OPEN),
    Phase("leave", "line", "goal", HOVER, OPEN),
    Phase("go home", "joint", "", 0.0, OPEN),
    Phase("rest", "rest", "", 0.0, OPEN),
)


class Result(NamedTuple):
    """The result of a pick."""

    place_mm: float  # distance of the cube's centre from its goal, at the end
    joint_mrad: float  # worst error of any joint in the joint moves
    line_mm: float  # worst distance of the hand from its straight lines
    lift: float  # greatest height of the cube's centre, metres
    seconds: float  # the duration of the task in the simulation
    torque: float  # largest torque asked for, as a fraction of that motor's limit
    speed: float  # largest joint speed, as a fraction of that joint's limit
    manipulability: float  # smallest at the way points
    heaviest: float  # the cube that this grip can lift, predicted, kg
    phases: list[tuple[str, float]]  # (name, when it began in seconds), in order
    t: Array  # time of each control instant, seconds, (N,)
    qpos: Array  # everything's configuration then, (N, nq): for pictures and replays

    @property
    def failed(self) -> bool:
        """The cube was dropped or put down more than 10 mm off."""
        return self.place_mm > 10.0


class Task:
    """The model, the state of the world and what has been measured so far."""

    def __init__(
        self,
        fns: Any,
        model: mujoco.MjModel,
        goal_xy: Array,
        speed: float,
        watch: simulate.Watcher | None,
    ):
        """Put the arm at the ready; arguments as in `robo47.capstone.pick`."""
        self.fns = fns
        self.model = model
        self.speed = speed
        self.watch = watch
        self.push: simulate.Push | None = None  # the disturbance of the arm
        self.data = simulate.start(model, READY_Q)
        self.arm = Arm(fns, model)
        self.cube = int(model.jnt_qposadr[model.body("cube").jntadr[0]])
        self.goal = np.array([*goal_xy, scenes.TABLE_HEIGHT + scenes.CUBE_HALF])
        self.T_world_cube = self._cube()
        self.T_tcp_cube = np.eye(4)
        self.worst = dict.fromkeys(("joint", "line", "hold", "rest", "weigh"), 0.0)
        self.manipulability = np.inf
        self.heaviest = 0.0
        self.now = 0.0
        self.phases: list[tuple[str, float]] = []
        self.runs: list[simulate.Run] = []

    def run(self, phase: Phase, rate: float) -> None:
        """Do one phase, from where the arm is measured to be."""
        law, seconds = self._law(phase, self._q())
        seconds = np.ceil(seconds * rate) / rate  # a whole number of control periods

        def controller(t: float, q: Array, qd: Array) -> Array:
            tau = self.fns.saturate(law(t, q, qd), self.arm.tau_max)
            return np.append(tau, phase.fingers)

        self.phases.append((phase.name, self.now))
        world = (self.model, self.data)
        self.arm.worst = self.worst[phase.kind]
        run = simulate.run(
            *world, controller, seconds, rate=rate, push=self.push, watch=self._look
        )
        self.runs.append(run)
        self.worst[phase.kind] = self.arm.worst
        self.now += seconds
        if phase.name == "close":
            self._grasped()
        elif phase.name == "open":
            self.arm.release()

    def _law(self, phase: Phase, q: Array) -> tuple[Law, float]:
        """Return the control law of a phase and how long it takes."""
        T = self.arm.end(q)
        if phase.kind == "rest":
            return self.arm.rest(q), REST_SECONDS
        if phase.kind == "hold":
            return self.arm.line(T, T, GRIP_SECONDS, q), GRIP_SECONDS
        if phase.kind == "line":
            T1 = self._tool(phase)
            return self.arm.line(T, T1, LINE_SECONDS, q), LINE_SECONDS
        q1 = self._joint_goal(phase, q)
        seconds = self._seconds(q, q1, self.speed)
        return self.arm.move(q, q1, seconds), seconds

    def _joint_goal(self, phase: Phase, q: Array) -> Array:
        """Return the configuration at the end of a joint move from q, (7,)."""
        if not phase.over:
            return READY_Q.copy()
        goal, reach = self.arm.waypoint(self._tool(phase), q)
        self.manipulability = min(self.manipulability, reach)
        return goal

    def _seconds(self, q0: Array, q1: Array, speed: float) -> float:
        """Return the duration of a joint move at a fraction of the limits, seconds."""
        v = speed * simulate.SPEED_LIMITS
        a = speed * simulate.ACC_LIMITS
        return float(self.fns.quintic_duration(q1 - q0, v, a))

    def _tool(self, phase: Phase) -> Array:
        """Return where the tool has to be, T_world_tcp, (4, 4)."""
        fns = self.fns
        if phase.over == "cube":
            return fns.grasp_pose(self.T_world_cube, phase.above)
        T = fns.grasp_pose(fns.make_T(np.eye(3), self.goal), phase.above)
        T[:3, 3] -= T[:3, :3] @ self.T_tcp_cube[:3, 3]  # the cube, not the tool
        if phase.name == "put down":
            k = float(STIFFNESS[5])
            T[2, 3] = fns.set_point_for_force(PUT_DOWN, k, float(T[2, 3]))
        return T

    def _grasped(self) -> None:
        """Count the cube as part of the hand, and say what this grip can lift."""
        mass = float(self.model.body("cube").mass[0])
        self.T_tcp_cube = self._hold(mass, self._cube())
        lift = trajectory.PEAK_ACCELERATION * HOVER / LINE_SECONDS**2
        self.heaviest = self._can_lift(lift)

    def _hold(self, mass: float, T_world_cube: Array) -> Array:
        """Count a cube as part of the hand as it is now; return T_tcp_cube."""
        return self.arm.hold(mass, scenes.CUBE_HALF, T_world_cube, self._q())

    def _can_lift(self, acceleration: float) -> float:
        """Return the heaviest cube that this grip holds at an acceleration, kg."""
        model = self.model
        # A tendon over both fingers pulls with 100 N/m; each gets a half.
        opening = float(self.data.qpos[model.joint("finger_joint1").qposadr[0]])
        grip = 50.0 * max(opening, 0.0)
        mu = float(model.geom("cube").friction[0])
        return float(self.fns.max_cube_mass(grip, mu, acceleration))

    def _q(self) -> Array:
        """Return the measured configuration, (7,)."""
        return self.data.qpos[simulate.addresses(self.model)[0]].copy()

    def _cube(self) -> Array:
        """Return T_world_cube, (4, 4), from what a camera would see."""
        pose = self.data.qpos[self.cube : self.cube + 7]
        return self.fns.link_T(pose[:3].copy(), pose[3:].copy())

    def _look(self, model: mujoco.MjModel, data: mujoco.MjData) -> Array:
        if self.watch is not None:
            self.watch(model, data)
        return data.qpos.copy()

    def log(self) -> dict[str, Any]:
        """Return the log, and the cube's distance from its goal at the end.

        A joint move of several legs is one phase.
        """
        qpos = np.array([seen for run in self.runs for seen in run.seen])
        begins: dict[str, float] = {}
        for name, seconds in self.phases:
            begins.setdefault(name, seconds)
        off = qpos[-1, self.cube : self.cube + 3] - self.goal
        return {
            "place_mm": 1e3 * float(np.linalg.norm(off)),
            "seconds": self.now,
            "phases": list(begins.items()),
            "t": np.linspace(self.now / len(qpos), self.now, len(qpos)),
            "qpos": qpos,
        }

    def result(self) -> Result:
        """Return the log and its worst numbers."""
        log = self.log()
        tau = np.concatenate([run.tau for run in self.runs])
        qd = np.concatenate([run.qd for run in self.runs])
        return Result(
            **log,
            joint_mrad=1e3 * self.worst["joint"],
            line_mm=1e3 * self.worst["line"],
            lift=float(log["qpos"][:, self.cube + 2].max()),
            torque=float((np.abs(tau) / self.arm.tau_max).max()),
            speed=float((np.abs(qd) / simulate.SPEED_LIMITS).max()),
            manipulability=float(self.manipulability),
            heaviest=self.heaviest,
        )
