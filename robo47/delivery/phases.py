"""The phases of the delivery, and the measurements during them.

`robo47.capstone.phases` defines joint moves, straight lines and grips. The path around
the wall, the weighing and the contact monitor are new.

Units: metres, radians, seconds, kilograms, N m; poses `T_world_x` are (4, 4).
"""

from itertools import pairwise
from typing import Any, NamedTuple

import mujoco
import numpy as np

from robo47 import scenes, simulate
from robo47.arm import GRAVITY
from robo47.capstone.arm import Law
from robo47.capstone.phases import CLOSED, HOVER, Phase, Task
from robo47.capstone.phases import PHASES as PICK
from robo47.checks import Array
from robo47.delivery.contact_monitor import ContactMonitor
from robo47.delivery.path_planner import PathPlanner
from robo47.delivery.perception import cube_seen
from robo47.panda import READY_Q

RATE = 100.0  # Hz, of controller and watch

SCALE = 11.0  # rad/s, of the spring that weighs
WEIGH_SECONDS = 1.2  # the springs take so long to come to rest: see the guide
# shares of the joints' limits; the first feasible one is taken
SPEEDS = (0.6, 0.5, 0.4, 0.3, 0.2)
INSTANTS = 41  # instants of a move at which its acceleration is checked
PUSH_AFTER = 0.5  # s after the carry began
EMPTY = 0.010  # kg: what weighs less is no cube

LIFTED = 1 + [phase.name for phase in PICK].index("lift")
WEIGH = Phase("weigh", "weigh", "cube", HOVER, CLOSED)
PHASES = (*PICK[:LIFTED], WEIGH, *PICK[LIFTED:])


class Options(NamedTuple):
    """Changes of an attempt, to see their effects."""

    mass: float = scenes.CUBE_MASS  # mass of the cube, kg
    friction: float = scenes.FRICTION  # coefficient of friction between cube and pads
    wall: bool = True
    known_pose: bool = False  # the cube's place is given instead of perceived
    noise: float = 0.0  # standard deviation of the depths, m
    offset: float = 0.0  # m along x, added to where it was seen
    weigh: float = WEIGH_SECONDS  # s; 0: it is not weighed and counts as nothing
    speed: float = 0.0  # share of the limits while carrying; 0: as the weight allows
    planned: bool = True  # False: straight from pose to pose
    hand: bool = True  # False: the planner forgets the hand
    push: float = 0.0  # N, down on the hand, in the carry


class Delivery(Task):
    """The model, the state of the world and what has been measured so far."""

    def __init__(
        self, fns: Any, model: mujoco.MjModel, goal_xy: Array, options: Options
    ):
        """Put the arm at the ready and look at the table."""
        super().__init__(fns, model, goal_xy, SPEEDS[0], None)
        self.options = options
        self.true_pose = self.T_world_cube
        if not options.known_pose:
            self.T_world_cube = cube_seen(fns, model, self.data, noise=options.noise)
        self.T_world_cube[0, 3] += options.offset
        self.perceived = self.T_world_cube.copy()
        self.planner = PathPlanner(fns, model, wall=options.wall, hand=options.hand)
        self.monitor = ContactMonitor(fns, self.arm.damping, 1.0 / RATE)
        self.measured_mass = 0.0
        self.carry_speed = 0.0  # the speed of the carry, as a fraction of the limits
        self.driven: list[Array] = []  # configurations of the joint moves
        self.pushed_at = self.detected_at = np.nan  # seconds of the simulation
        self.corner = READY_Q  # the end of the present leg of a joint move
        self.stopped = ""  # why it did not go on

    def run(self, phase: Phase, rate: float = RATE) -> None:
        """Do one phase, from where the arm is measured to be."""
        if self.stopped:
            return
        if phase.kind == "joint":
            self._go(phase, rate)
        elif phase.kind != "weigh":
            super().run(phase, rate)
        elif self.options.weigh:
            super().run(phase, rate)
            self._weigh()

    def _go(self, phase: Phase, rate: float) -> None:
        """Plan a joint move and drive it."""
        q = self._q()
        goal = self._joint_goal(phase, q)
        planned = self.options.planned
        path = self.planner.find(q, goal) if planned else np.array([q, goal])
        self.speed = SPEEDS[0]
        if phase.name == "carry":
            self.carry_speed = self.speed = self._slow_enough(path)
            if self.stopped:
                return
            self._disturb()
        for self.corner in path[1:]:
            super().run(phase, rate)
            self.driven.append(self.runs[-1].q)
            if self.stopped:
                return
        self.push = None

    def _law(self, phase: Phase, q: Array) -> tuple[Law, float]:
        """Return the control law of a phase, or of one leg of it, and its seconds."""
        if phase.kind == "weigh":
            return self._scale(q), self.options.weigh
        if phase.kind != "joint":
            return super()._law(phase, q)
        seconds = self._seconds(q, self.corner, self.speed)
        law = self.arm.move(q, self.corner, seconds)
        return (self._watched(law) if phase.name == "carry" else law), seconds

    def _scale(self, q0: Array) -> Law:
        """Return a critically damped spring about q0: what it lacks is the load."""
        kp, kd = (float(k) for k in self.fns.pd_gains(SCALE, 1.0))
        still = np.zeros(7)

        def torque(t: float, q: Array, qd: Array) -> Array:
            now = self.arm.at(q, qd)
            known = now.M, now.bias, self.arm.damping, qd
            return self.fns.computed_torque(*known, q0 - q, -qd, still, kp, kd)

        return torque

    def _watched(self, law: Law) -> Law:
        """Return a law that holds the arm still after an unknown contact."""
        self.monitor.reset()

        def torque(t: float, q: Array, qd: Array) -> Array:
            now = self.arm.at(q, qd)
            if not self.stopped and self.monitor.update(now.M, qd):
                self.detected_at = float(self.data.time)
                link = self.monitor.link
                self.stopped = f"link {link} felt what nobody commanded"
                self.hold_still = self.arm.rest(q)
            tau = self.hold_still(t, q, qd) if self.stopped else law(t, q, qd)
            tau = self.fns.saturate(tau, self.arm.tau_max)
            gradient = self.fns.kinetic_energy_gradient(now.J_space, now.G, qd)
            self.monitor.commanded(tau, gradient, self.arm.gravity(q), qd)
            return tau

        return torque

    def _grasped(self) -> None:
        """Count the cube at its perceived pose; its mass is unknown yet."""
        self.T_tcp_cube = self.fns.inverse(self.arm.end(self._q())) @ self.perceived

    def _weigh(self) -> None:
        """Identify the payload, and count it as part of the hand."""
        fns = self.fns
        q = self.runs[-1].q[-2]  # the configuration of the last commanded torque
        now = self.arm.at(q, np.zeros(7))
        J_site = fns.site_jacobian(now.J_space, now.T[:3, 3])
        extra = self.runs[-1].tau[-1] - self.arm.gravity(q)
        holds = J_site[None], now.T[None, :3, :3], extra[None]
        self.measured_mass = float(fns.identify_payload(*holds, GRAVITY)[0])
        if not self.measured_mass >= -EMPTY:  # NaN, too
            grams = f"{1e3 * self.measured_mass:.0f} g"
            self.stopped = f"it weighs {grams}: is identify_payload (task 8.8) right?"
        elif self.measured_mass < EMPTY:
            self.stopped = "there is nothing in the hand"
        else:
            self._hold(self.measured_mass, now.T @ self.T_tcp_cube)

    def _slow_enough(self, path: Array) -> float:
        """Return the first of the speeds at which this grip holds what was weighed.

        The hand's acceleration is taken to be upwards, where it costs the most.
        """
        if self.options.speed:
            return self.options.speed
        for speed in SPEEDS:
            if self._can_lift(self._acceleration(path, speed)) >= self.measured_mass:
                return speed
        self.stopped = f"{1e3 * self.measured_mass:.0f} g are too heavy for this grip"
        return 0.0

    def _acceleration(self, path: Array, speed: float) -> float:
        """Return the hand's largest acceleration along a path, m/s2."""
        most = 0.0
        for q0, q1 in pairwise(path):
            T = self._seconds(q0, q1, speed)
            t = np.linspace(0.0, T, INSTANTS)
            q = [self.fns.joint_trajectory(q0, q1, now, T)[0] for now in t]
            at = np.array([self.arm.end(one)[:3, 3] for one in q])
            change = np.diff(at, 2, axis=0) / (t[1] - t[0]) ** 2
            most = max(most, float(np.linalg.norm(change, axis=1).max()))
        return most

    def _disturb(self) -> None:
        """Push the hand a little later, if the options say so."""
        if not self.options.push:
            return
        self.pushed_at = float(self.data.time) + PUSH_AFTER
        push = simulate.push_at("tcp", [0.0, 0.0, 0.0, 0.0, 0.0, -self.options.push])

        def later(model: mujoco.MjModel, data: mujoco.MjData) -> None:
            if data.time >= self.pushed_at:
                push(model, data)

        self.push = later
