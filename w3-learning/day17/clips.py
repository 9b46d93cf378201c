"""The clip of Day 17: a policy that draws plans from noise, from one start at the dock.

make figures DAY=17 ARGS=--clips    figures/day17_plans.webp
"""

from collections.abc import Iterator

import day17_diffusion as lab
import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from labkit.figures import chart
from labkit.figures.chart import BLUE, INK, ORANGE, RED
from labkit.figures.clip import Frame
from labkit.lesson.day import find_day
from robo47 import cloning, push

PLANS = 40  # that are drawn; the first one is executed
REPLANS = 14
SLOWLY = 3  # replans whose steps are all shown; of the others every fifth
MM = 1000.0


def frames() -> Iterator[Frame]:
    """Yield the clip's frames: noise becomes plans, then four actions are executed."""
    figures = find_day(17).module("figures")
    planner = figures.planner()
    state = push.dock(lab.TESTED, np.random.default_rng(lab.STARTS_SEED))[figures.START]
    rng = np.random.default_rng(lab.SEED)
    for k in range(REPLANS):
        noise = rng.normal(size=(PLANS, 2 * lab.ACTIONS))
        stages = crystallising(planner, state, noise)
        for plans in stages if k < SLOWLY else stages[::5]:
            paths = figures.paths(plans, state)
            yield Frame(_moment(paths, state)(), 0.6 if plans is stages[-1] else 0.15)
        chosen = stages[-1][:1]
        policy = iter(np.moveaxis(chosen, 1, 0))
        run = push.run(
            *push.scene(), state[None], lambda _, policy=policy: next(policy),
            lab.EXECUTED,
        )  # fmt: skip
        for seen in run.observation[0, 1:]:
            yield Frame(_moment(paths[:1], seen)(), 0.1)
        state = run.observation[0, -1]


def crystallising(planner, state: np.ndarray, noise: np.ndarray) -> list[np.ndarray]:
    """Return the plans before and after each denoising step, m/s, (n, 8, 2) each."""
    z = cloning.normalise(np.tile(state, (len(noise), 1)), planner.seen)
    abars = lab.levels(lab.PLAN_LEVELS, lab.DENOISING)
    stages = [noise]
    for abar, prev in zip(abars, [*abars[1:], 1.0], strict=True):
        eps = planner.noise(z, stages[-1], abar)
        stages.append(lab.ddim_step(stages[-1], eps, abar, prev))
    plans = [cloning.denormalise(x, planner.plans) for x in stages]
    return [one.reshape(-1, lab.ACTIONS, 2) for one in plans]


def _moment(paths: np.ndarray, seen: np.ndarray):
    """Return what draws plans, pusher and puck from above."""

    @chart.picture(height=4.0, width=4.8)
    def scene(figure: Figure) -> None:
        axes = figure.subplots()
        axes.add_patch(Circle((0, 0), MM * push.HOME, color="0.85"))
        for path in paths:
            axes.plot(*path.T, color=BLUE, linewidth=1, alpha=0.5)
        axes.plot(*paths[0].T, ".-", color=RED, linewidth=1.5)
        axes.add_patch(Circle(MM * seen[2:], MM * push.PUCK, color=ORANGE))
        axes.add_patch(Circle(MM * seen[:2], MM * push.PUSHER, color=INK))
        axes.set(xlim=(-300, 300), ylim=(-250, 250), aspect="equal")
        axes.set(xticks=(), yticks=())

    return scene


CLIPS = {"plans": frames}
