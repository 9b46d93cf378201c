"""The scene of Week 3 as a Gymnasium environment, for the tools of the field.

    import gymnasium
    import robo47.gym                        # registers it
    env = gymnasium.make("robo47/Push-v0")

An extra: `python3 scripts/setup_env.py gym` installs Gymnasium. Observations, actions
and starts are those of `robo47.push`. The reward of a step is the decrease of the
puck's distance from home, in metres, so that the return of an episode is the distance
gained. `info["is_success"]` says whether the puck is at home, and an episode has 60
steps.
"""

from typing import Any

import gymnasium
import mujoco
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from robo47 import push
from robo47.checks import Array

ID = "robo47/Push-v0"
FAR = 10.0  # m: no observation of an episode is as far from home
PIXELS = 128  # of a picture's side
SEEN = 0.4  # m from home to the edge of a picture
COLOURS = {"home": (205, 230, 210), "puck": (230, 159, 0), "pusher": (213, 94, 0)}


class Push(gymnasium.Env[Array, Array]):
    """A round pusher brings a round puck home."""

    metadata = {  # noqa: RUF012 (as Gymnasium declares it)
        "render_modes": ["rgb_array"],
        "render_fps": round(1 / push.TICK),
    }

    def __init__(self, render_mode: str | None = None) -> None:
        """Make the scene.

        Args:
            render_mode: "rgb_array" for pictures from above, (128, 128, 3) bytes.
        """
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode is {render_mode!r}; expected 'rgb_array'")
        self.render_mode = render_mode
        self.observation_space = spaces.Box(-FAR, FAR, (4,), np.float64)
        fastest = push.FASTEST
        self.action_space = spaces.Box(-fastest, fastest, (2,), np.float64)
        self._model, self._data = push.scene()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """Return the first observation, of a random start.

        Args:
            seed: of the random numbers.
            options: {"start": observation (4,)} for a start of your own.
        """
        super().reset(seed=seed)
        start = push.starts(1, self.np_random)[0]
        mujoco.mj_resetData(self._model, self._data)
        self._data.qpos[:] = (options or {}).get("start", start)
        mujoco.mj_forward(self._model, self._data)
        return self._observation(), self._info()

    def step(self, action: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """Hold an action, m/s, (2,), for one tick.

        Returns:
            The observation, the reward, False, False (the limit of time is set by
            `gymnasium.make`), and {"is_success": whether the puck is at home}.
        """
        before = self._distance()
        self._data.ctrl[:] = np.clip(action, -push.FASTEST, push.FASTEST)
        steps = round(push.TICK / self._model.opt.timestep)
        mujoco.mj_step(self._model, self._data, steps)
        gained = before - self._distance()
        return self._observation(), gained, False, False, self._info()

    def render(self) -> NDArray[np.uint8] | None:  # type: ignore[override]
        """Return the scene from above, or None without a render_mode."""
        if self.render_mode is None:
            return None
        line = np.linspace(-SEEN, SEEN, PIXELS)
        x, y = np.meshgrid(line, -line)
        picture = np.full((PIXELS, PIXELS, 3), 255, np.uint8)
        seen = self._observation()
        discs = {
            "home": (np.zeros(2), push.HOME), "puck": (seen[2:], push.PUCK),
            "pusher": (seen[:2], push.PUSHER),
        }  # fmt: skip
        for name, (centre, radius) in discs.items():
            inside = np.hypot(x - centre[0], y - centre[1]) < radius
            picture[inside] = COLOURS[name]
        return picture

    def _observation(self) -> Array:
        return np.array(self._data.qpos)

    def _distance(self) -> float:
        return float(np.linalg.norm(self._data.qpos[2:]))

    def _info(self) -> dict[str, Any]:
        return {"is_success": self._distance() < push.HOME}


gymnasium.register(ID, "robo47.gym:Push", max_episode_steps=push.STEPS)
