"""The push on the arm: an approach, then ticks of looking, drawing and moving.

Metres, radians, seconds, N m; positions of sphere and puck are relative to home, (2,).
"""

from typing import Any, NamedTuple

import mujoco
import numpy as np

from robo47 import push, simulate
from robo47.checks import Array
from robo47.panda import READY_Q
from robo47.pushing import guard, learning, scene
from robo47.pushing.arm import PushingArm
from robo47.pushing.eye import Eye

PUCK = (-0.10, 0.11)  # m, of the puck of `make capstone`
SPEED = 0.4  # of the approach, as a fraction of the joints' limits
RATE = 100.0  # Hz, of the controller

FASTEST = 0.2  # m/s, of the set point
# m, of the set point; beyond this x the elbow is straight, and the arm stops following
LOW, HIGH = np.array([-0.27, -0.27]), np.array([0.24, 0.27])
ROUND_SECONDS = 2.5  # s, in which the sphere goes around the puck
PARTS = 5  # of a tick, when it looks ahead
ASIDE_TICKS = 3  # in which the puck is moved, at a right angle to its path home

HOME_MM = 10.0  # mm: a puck closer to home than this is at home


class Options(NamedTuple):
    """Changes of an attempt, to see their effects."""

    mass: float = push.MASS  # of the puck, kg
    damping: float = push.DAMPING  # of the puck, N s/m
    known_puck: bool = False  # the puck's position is given instead of seen
    offset: float = 0.0  # m along x, added to where the puck was seen
    blur: bool = True  # False: the eye keeps every fourth pixel without a blur
    denoising: int = learning.DENOISING  # steps from noise to a plan
    executed: int = learning.EXECUTED  # actions of a plan before the next one
    late: int = 1  # ticks from a look to the plan that was drawn from it
    ahead: bool = True  # a late plan is drawn for where things will be
    forward: bool = True  # the spring's damper is given the set point's velocity
    moved: bool = True  # the simulation moves the puck aside once
    draw: int = 0  # seed of the draws


class Push:
    """The model, the state of the world and what has been measured so far."""

    def __init__(self, fns: Any, puck: Array, limit: float, options: Options):
        """Put the arm at the ready.

        Args:
            fns: has an attribute for every name in `robo47.pushing.USES`.
            puck: where the puck stands, (2,).
            limit: of the guard's scores.
            options: changes of the usual attempt.

        Raises:
            ValueError: a plan that arrives after the next one was drawn.
        """
        if not 0 <= options.late <= options.executed:
            raise ValueError(
                f"late is {options.late}; expected 0 to {options.executed}, the number"
                " of actions of a plan that are executed"
            )
        self.fns, self.options = fns, options
        self.model = scene.tray(puck, mass=options.mass, damping=options.damping)
        self.data = scene.start(self.model)
        self.arm = PushingArm(fns, self.model, options.forward)
        self.eye = Eye(fns, self.model, blur=options.blur, offset=options.offset)
        self.guard = guard.Guard(fns, limit)
        self.policy = learning.policy(fns)
        self.rng = np.random.default_rng(options.draw)
        self.address = scene.puck_address(self.model)
        self.set_point = np.zeros(2)
        self.plan, self.drawn = np.zeros((1, 2)), 0
        self.coming: list[tuple[int, Array]] = []  # plans, with the tick of each
        self.seen_off: list[float] = []  # errors of the eye, m
        self.observed: list[Array] = []  # observations, (4,)
        self.stopped = ""
        self.phases: list[tuple[str, float]] = []
        self.runs: list[simulate.Run] = []
        self.now = 0.0

    def approach(self) -> None:
        """Move the sphere to home along a joint trajectory."""
        q0 = self.joints()
        q1, _ = self.arm.waypoint(self.arm.pose_at(np.zeros(2)), READY_Q)
        v, a = (SPEED * most for most in (simulate.SPEED_LIMITS, simulate.ACC_LIMITS))
        T = float(self.fns.quintic_duration(q1 - q0, v, a))
        self.phases.append(("approach", self.now))
        self._run(self.arm.move(q0, q1, T), np.ceil(T * RATE) / RATE)
        self.posture = self.joints()
        self.set_point = self.sphere()
        self.arm.worst = 0.0

    def push(self) -> None:
        """Push the puck home, tick by tick."""
        self.began = self.now
        self.phases.append(("push", self.now))
        for tick in range(guard.TICKS):
            seen = self._look()
            if self.guard.alarm(seen):
                score = self.guard.scores[-1]
                self.stopped = f"its observation is new, with a score of {score:.2f}"
                break
            if tick % self.options.executed == 0:
                self._draw(seen, tick)
            self._move(self._action(tick), self._aside(tick))

    def _look(self) -> Array:
        """Return the observation: where sphere and puck are, (4,)."""
        truth = self.puck()
        found = truth if self.options.known_puck else self.eye.look(self.data)
        self.seen_off.append(float(np.linalg.norm(found - truth)))
        self.observed.append(np.append(self.sphere(), found))
        return self.observed[-1]

    def _draw(self, seen: Array, tick: int) -> None:
        """Draw a plan, which arrives late; what is done until then is known."""
        late = self.options.late
        if self.options.ahead:
            known = np.array([self._entry(tick + i) for i in range(late)])
            known = known.reshape(late, 2)
            seen = self.fns.push_ahead(seen, known, push.TICK, PARTS, push.R)
        noise = self.rng.normal(size=(1, 2 * learning.ACTIONS))
        steps = self.options.denoising
        plan = self.policy.draw(np.asarray(seen)[None], noise, steps, self.fns)[0]
        self.coming.append((tick + late, plan))

    def _entry(self, tick: int) -> Array:
        """Return the action of the present plan for a tick, (2,)."""
        return np.asarray(self.fns.plan_entry(self.plan, self.drawn, tick))

    def _action(self, tick: int) -> Array:
        """Return the velocity of the set point in a tick, (2,)."""
        if self.coming and self.coming[0][0] <= tick:
            self.drawn, self.plan = self.coming.pop(0)
        v = self.fns.clamp_speed(self._entry(tick), FASTEST)
        return np.asarray(self.fns.keep_inside(self.set_point, v, LOW, HIGH, push.TICK))

    def _aside(self, tick: int) -> Array:
        """Return the velocity of the puck while it is moved aside in a tick, (2,)."""
        since = tick - guard.BEFORE
        if not (self.options.moved and 0 <= since < ASIDE_TICKS):
            if self.phases[-1][0] == "moved aside":
                self.phases.append(("push again", self.now))
            return np.zeros(2)
        if since == 0:
            self.phases.append(("moved aside", self.now))
            x, y = self.puck()
            across = np.array([-y, x]) / max(np.hypot(x, y), 1e-9)
            away = np.sign((self.puck() - self.sphere()) @ across) or 1.0
            self.across = away * across
        return guard.MOVED / (ASIDE_TICKS * push.TICK) * self.across

    def _move(self, v: Array, aside: Array) -> None:
        """Move the set point for a tick, and the puck at the velocity `aside`."""
        start = self.set_point

        def set_point(t: float) -> tuple[Array, Array]:
            return start + t * v, v

        def held(model: mujoco.MjModel, data: mujoco.MjData) -> None:
            at = slice(self.address, self.address + 2)
            data.qpos[at] += aside * model.opt.timestep

        self._run(
            self.arm.follow(set_point, self.posture),
            push.TICK,
            held if aside.any() else None,
        )
        self.set_point = start + push.TICK * v

    def _run(self, law: Any, seconds: float, aside: Any = None) -> None:
        def controller(t: float, q: Array, qd: Array) -> Array:
            tau = self.fns.saturate(law(t, q, qd), self.arm.tau_max)
            return np.append(tau, 0.0)

        world = (self.model, self.data)
        watch = {"push": aside, "watch": lambda _, data: data.qpos.copy()}
        self.runs.append(simulate.run(*world, controller, seconds, rate=RATE, **watch))
        self.now += seconds

    def joints(self) -> Array:
        """Return the measured configuration, (7,)."""
        return self.data.qpos[simulate.addresses(self.model)[0]].copy()

    def sphere(self) -> Array:
        """Return the position of the sphere from the measured configuration, (2,)."""
        return self.arm.sphere(self.joints())

    def puck(self) -> Array:
        """Return the true position of the puck, (2,)."""
        return self.data.qpos[self.address : self.address + 2].copy()
