"""Day 17 in the inspector: the tab Denoising.

A network that the kit has trained draws plans for a start that a slider chooses. The
student's `cosine_schedule`, `timesteps` and `ddim_step` turn noise into these plans,
and the page shows them after each step.
"""

import contextlib
import io
from functools import cache
from typing import NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.draw import joined
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import cloning, diffusion, push
from robo47.checks import Array

LAB = lab_of(find_day(17))
PLANS = 30
UP = 0.02  # m, the height of the puck; the plans are drawn above it
SECONDS = 0.3  # that a step is seen
AWAY = 0.18  # m from the pusher to the puck


class Silent:
    """A lab that only counts the steps of a training."""

    @staticmethod
    def training(title: str, steps: int) -> range:
        """Return the numbers of the steps."""
        return range(1, steps + 1)


class Drawn(NamedTuple):
    """Plans before and after each step, and the level of each step."""

    stages: Array  # m/s, (steps + 1, n, 8, 2)
    abars: Array  # (steps,)

    @property
    def paths(self) -> Array:
        """Positions of the pusher, m, (steps + 1, n, 9, 3)."""
        moved = push.TICK * np.cumsum(self.stages, axis=2)
        flat = np.concatenate([np.zeros_like(moved[:, :, :1]), moved], axis=2)
        return np.concatenate([flat, np.full((*flat.shape[:3], 1), 1.1 * UP)], axis=3)

    @property
    def left(self) -> int:
        """How many plans go to the left of the puck, seen from the pusher."""
        ends = self.paths[-1, :, LAB.EXECUTED]
        return int(np.sum(ends[:, 0] < 0))


@cache
def planner() -> LAB.Planner:
    """Train the network by the library's functions; two seconds."""
    with contextlib.redirect_stdout(io.StringIO()):
        return LAB.train(Silent(), *LAB.demonstrations())[0]


def noise_in(z: Array, x: Array, abar: float) -> Array:
    """Return the noise that the kit's network finds in x."""
    return planner().noise(z, x, abar)


class Denoising(ui.Played):
    """Noise becomes plans to both sides of a puck."""

    title = "Denoising"
    library = diffusion
    functions = {"cosine_schedule": "", "timesteps": "", "ddim_step": ""}
    arm_hidden = True
    camera = ((0.0, -0.4, 0.5), (0.0, 0.1, 0.0))

    steps = ui.slider("steps", 1, 50, 10, "", step=1)
    angle = ui.slider("direction of the puck", -0.6, 0.6, 0.0)
    seed = ui.slider("seed of the noise", 0, 20, 0, "", step=1)
    plot = ui.panel.plot(["abar"], y="abar of each step", height=150)
    puck = ui.scene.disc(push.PUCK, UP, "orange", 0.6, legend="puck")
    pusher = ui.scene.disc(push.PUSHER, 3 * UP, "grey", legend="pusher")
    best = ui.scene.lines(ui.NOWHERE, "white", legend="plans by the library")
    plans = ui.yours.lines(ui.NOWHERE, "blue", legend="plans by your functions")

    def ask(self, fns, at) -> Drawn:
        steps = round(at.steps)
        abars = np.asarray(fns.cosine_schedule(LAB.PLAN_LEVELS), dtype=float)
        levels = np.asarray(fns.timesteps(LAB.PLAN_LEVELS, steps), dtype=int)
        abars = abars[levels]
        seen = np.tile([0.0, 0.0, *self.where(at)], (PLANS, 1))
        z = cloning.normalise(seen, planner().seen)
        rng = np.random.default_rng(round(at.seed))
        stages = [rng.normal(size=(PLANS, 2 * LAB.ACTIONS))]
        for abar, prev in zip(abars, [*abars[1:], 1.0], strict=True):
            x = stages[-1]
            x = fns.ddim_step(x, noise_in(z, x, abar), float(abar), float(prev))
            stages.append(np.asarray(x, dtype=float))
        plans = [cloning.denormalise(x, planner().plans) for x in stages]
        stages = np.array(plans).reshape(len(plans), PLANS, LAB.ACTIONS, 2)
        return Drawn(stages, abars)

    def where(self, at) -> Array:
        """Return the position of the puck, m, (2,)."""
        return AWAY * np.array([np.sin(at.angle), np.cos(at.angle)])

    def show(self, yours: Drawn, right: Drawn) -> None:
        self.drawn = yours
        self.puck.position = np.array([*self.where(self), UP / 2])
        self.pusher.position = np.array([0.0, 0.0, 1.5 * UP])
        self.best.points = segments(right.paths[-1])
        self.plot.show(np.arange(len(yours.abars)), [yours.abars])
        self.play()

    def frame(self, seconds: float) -> bool:
        last = len(self.drawn.stages) - 1
        at = min(int(seconds / SECONDS), last)
        self.plans.points = segments(self.drawn.paths[at])
        return at < last

    def says(self, yours: Drawn, right: Drawn):
        left = f"{yours.left} of {PLANS} plans go to the left by your functions, "
        yield f"{left}{right.left} by the library.", " ".join(self.functions)
        yield "The network was trained with the library's functions.", None


def segments(paths: Array) -> Array:
    """Return the segments of several paths, (k, 2, 3)."""
    return np.concatenate([joined(path) for path in paths])


TABS = [Denoising]
