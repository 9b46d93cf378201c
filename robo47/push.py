"""A round pusher brings a round puck home, in a plane: the scene of Week 3.

Both bodies are spheres at one height, so that seen from above they are discs whose
contact is exact. There is no gravity and no friction in the contact. The joints of the
puck have viscous damping, so it stops when it is not pushed and moves along the contact
normal. Home is the origin.

An observation is (pusher x, y, puck x, y), metres, (4,). An action is the velocity of
the pusher, m/s, (2,), clamped to FASTEST and held for one TICK. `robo47.gym` offers the
scene as a Gymnasium environment.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import mujoco
import numpy as np
from mujoco import rollout
from numpy.typing import NDArray

from robo47.checks import Array

PUSHER, PUCK = 0.015, 0.05  # m, radii
R = PUSHER + PUCK  # m between both centres while they touch
MASS = 0.1  # kg, of the puck
DAMPING = 5.0  # N s/m, of each of its joints: it stops within 20 ms
STEP = 0.01  # s, the simulation's time step
TICK = 0.1  # s, how long an action is held
STEPS = 60  # actions of an episode
FASTEST = 0.2  # m/s, of each component of an action
HOME = 0.02  # m: a puck that ends closer to the origin is at home
# The demonstrator.
PUSH = 0.1  # m/s, along the line from the puck to home
DOCK_PUSH = 0.08  # m/s, the same for a start at the dock
SLOW = 1.0  # 1/s: near home it pushes with this times the distance
STEER = 3.0  # 1/s, the gain K of its steering
ROUND = 0.15  # m/s, on its way around the puck
CLEAR = 0.02  # m between both bodies on this way
BEHIND, ASIDE = 0.3, 0.9  # rad: it pushes below the first, goes around above the second
XML = """
<mujoco model="push">
  <option timestep="{step}" gravity="0 0 0" integrator="implicitfast"/>
  <size memory="64K"/>
  <default>
    <joint type="slide"/>
    <geom type="sphere" condim="1" solref="{contact} 1"/>
  </default>
  <worldbody>
    <body name="pusher">
      <joint name="pusher x" axis="1 0 0"/>
      <joint name="pusher y" axis="0 1 0"/>
      <geom name="pusher" size="{pusher}" mass="1"/>
    </body>
    <body name="puck">
      <joint name="puck x" axis="1 0 0" damping="{damping}"/>
      <joint name="puck y" axis="0 1 0" damping="{damping}"/>
      <geom name="puck" size="{puck}" mass="{mass}"/>
    </body>
  </worldbody>
  <actuator>
    <velocity joint="pusher x" kv="2000"/>
    <velocity joint="pusher y" kv="2000"/>
  </actuator>
</mujoco>
"""

Policy = Callable[[Array], Array]  # observations (n, 4) to actions (n, 2)


class Episodes(NamedTuple):
    """What was observed and done in n episodes."""

    observation: Array  # before each action, and at the end, (n, steps + 1, 4)
    action: Array  # as executed, (n, steps, 2)

    def rows(self) -> tuple[Array, Array, Array]:
        """Return observations (rows, 4), actions (rows, 2), and episodes (rows,)."""
        n, steps = self.action.shape[:2]
        seen = self.observation[:, :-1].reshape(-1, 4)
        return seen, self.action.reshape(-1, 2), np.repeat(np.arange(n), steps)

    def home(self) -> Array:
        """Return which pucks end at home, (n,), True or False."""
        return np.linalg.norm(self.observation[:, -1, 2:], axis=1) < HOME

    def moment(self, seconds: float) -> tuple[Array, int]:
        """Return the first episode's observation at a time, (4,), and its step.

        The observation is interpolated linearly between two steps; after the end it
        is the last one.
        """
        steps = self.action.shape[1]
        at = min(seconds / TICK, steps)
        k = min(int(at), steps - 1)
        now, then = self.observation[0, k : k + 2]
        return now + (at - k) * (then - now), k


def scene(
    mass: float = MASS, damping: float = DAMPING, step: float = STEP
) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Return a pusher and a puck, whose centres touch at the start."""
    sizes = {"pusher": PUSHER, "puck": PUCK, "contact": 2 * step}
    xml = XML.format(mass=mass, damping=damping, step=step, **sizes)
    model = mujoco.MjModel.from_xml_string(xml)
    return model, mujoco.MjData(model)


def starts(n: int, rng: np.random.Generator) -> Array:
    """Return n random observations at the start, (n, 4).

    The puck is 150 to 300 mm from home, the pusher 80 to 200 mm from the puck and
    within 2 rad of the position behind it.
    """
    angle = rng.uniform(-np.pi, np.pi, n)
    puck = rng.uniform(0.15, 0.3, (n, 1)) * _unit(angle)
    angle = angle + rng.uniform(-2.0, 2.0, n)
    pusher = puck + rng.uniform(0.08, 0.2, (n, 1)) * _unit(angle)
    return np.hstack([pusher, puck])


def dock(n: int, rng: np.random.Generator) -> Array:
    """Return n random starts with the pusher at home, (n, 4).

    The puck is 140 to 220 mm away in any direction, so the pusher has to go around it,
    to the left or to the right.
    """
    puck = rng.uniform(0.14, 0.22, (n, 1)) * _unit(rng.uniform(-np.pi, np.pi, n))
    return np.hstack([np.zeros((n, 2)), puck])


def demonstrator(
    observation: Array,
    push: float = PUSH,
    steer: float = STEER,
    around: float = ROUND,
    side: Array | None = None,
) -> Array:
    """Return the demonstrator's action for each observation, (n, 2).

    It goes around the puck until it is behind it, seen from home. Then it pushes at
    `push` along the line to home and steers with the gain `steer`, 1/s.

    Args:
        observation: (n, 4).
        push, around: m/s.
        steer: lateral velocity over lateral distance from the line, 1/s.
        side: (n,), 1 to go around on the left (seen in the direction of home), -1 on
            the right; None: the shorter way.
    """
    puck, r = observation[:, 2:], observation[:, :2] - observation[:, 2:]
    away = np.linalg.norm(puck, axis=1)
    ahead = -puck / np.maximum(away, 1e-9)[:, None]  # unit vectors from puck to home
    left = _left(ahead)
    beside = np.sum(r * left, axis=1)  # m, lateral position of the pusher
    angle = np.arctan2(beside, -np.sum(r * ahead, axis=1))  # 0 if it is behind
    speed = np.minimum(push, SLOW * away)
    pushing = speed[:, None] * ahead - steer * beside[:, None] * left
    far = np.linalg.norm(r, axis=1)
    out = r / np.maximum(far, 1e-9)[:, None]
    turn = np.sign(angle)
    if side is not None:
        turn = np.where(np.abs(angle) > 2.0, side, turn)
    closer = STEER * (R + CLEAR - far)[:, None] * out
    going = _clamped(around * turn[:, None] * _left(out) + closer, around)
    blend = np.clip((np.abs(angle) - BEHIND) / (ASIDE - BEHIND), 0.0, 1.0)
    blend = (blend * blend * (3.0 - 2.0 * blend))[:, None]
    return _clamped((1.0 - blend) * pushing + blend * going, FASTEST)


def run(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    start: Array,
    policy: Policy,
    steps: int = STEPS,
) -> Episodes:
    """Run a policy from n starts, (n, 4), side by side.

    The policy is called once per step with the observations of all starts, (n, 4).
    """
    kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
    state = np.zeros((len(start), mujoco.mj_stateSize(model, kind)))
    state[:, 1:5] = start  # behind the time
    each = round(TICK / model.opt.timestep)
    seen, done = [state[:, 1:5]], []
    for _ in range(steps):
        action = np.clip(policy(seen[-1].copy()), -FASTEST, FASTEST)
        ctrl = np.repeat(action[:, None], each, axis=1)
        # mujoco.mj_step for each time step of each start
        states, _ = rollout.rollout(model, data, state, ctrl)
        state = states[:, -1].copy()
        seen.append(state[:, 1:5])
        done.append(action)
    return Episodes(np.stack(seen, axis=1), np.stack(done, axis=1))


def demonstrations(n: int, seed: int, **how: Any) -> Episodes:
    """Return n demonstrations from random starts; `how` is of `demonstrator`."""
    start = starts(n, np.random.default_rng(seed))
    return run(*scene(), start, lambda seen: demonstrator(seen, **how))


def dock_demonstrations(
    n: int, seed: int, coin: bool = True, wait: int = 0
) -> Episodes:
    """Return n demonstrations from random starts at the dock.

    Args:
        n, seed: number of episodes, and of the generator.
        coin: True if a coin decides for each episode whether the demonstrator goes
            around the puck on the left or on the right; False: always on the left.
        wait: steps for which it stands still first; an episode has as many more.
    """
    rng = np.random.default_rng(seed)
    start = dock(n, rng)
    side = rng.choice([-1.0, 1.0], n) if coin else np.ones(n)
    steps = iter(range(STEPS + wait))

    def act(seen: Array) -> Array:
        action = demonstrator(seen, push=DOCK_PUSH, side=side)
        return np.zeros_like(action) if next(steps) < wait else action

    return run(*scene(), start, act, STEPS + wait)


def on_the_left(episodes: Episodes) -> NDArray[np.bool_]:
    """Return in which episodes the pusher went around the puck on the left, (n,).

    The side is seen in the direction from the puck's first position to home, at the
    pusher's largest distance from this line.
    """
    puck = episodes.observation[:, 0, 2:]
    left = _left(-puck)[:, None]
    beside = np.sum((episodes.observation[..., :2] - puck[:, None]) * left, axis=2)
    most = np.argmax(np.abs(beside), axis=1)
    left_of_it: NDArray[np.bool_] = beside[np.arange(len(most)), most] > 0
    return left_of_it


def blind_push(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    beside: float,
    angle: float = np.pi / 3,
    speed: float = PUSH,
) -> float:
    """Return the path length of a straight push until the contact angle is reached, m.

    Args:
        model, data: of `scene`.
        beside: distance of the pusher's line from the puck's centre at the start, m.
        angle: contact angle at the end, radians.
        speed: of the pusher, m/s.
    """
    mujoco.mj_resetData(model, data)
    data.qpos[:2] = -np.sqrt(R**2 - beside**2), beside
    data.ctrl[:] = speed, 0.0
    way, phi = [data.qpos[0]], [np.arcsin(beside / R)]
    while phi[-1] < angle and data.time < 10.0:
        mujoco.mj_step(model, data)
        ahead, aside = data.qpos[2:] - data.qpos[:2]
        way.append(data.qpos[0])
        phi.append(np.arctan2(-aside, ahead))
    return float(np.interp(angle, phi, way) - way[0])


def _unit(angle: Array) -> Array:
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _left(v: Array) -> Array:
    """Return vectors rotated by 90 degrees to the left, (n, 2)."""
    return np.stack([-v[:, 1], v[:, 0]], axis=1)


def _clamped(v: Array, most: float) -> Array:
    """Return vectors with a norm of at most `most`, (n, 2)."""
    norm = np.linalg.norm(v, axis=1, keepdims=True)
    return v * np.minimum(1.0, most / np.maximum(norm, 1e-9))
