"""Day 16 in the inspector: the tab Plans.

The decoder that the kit has trained plans eight actions in each step. The student's
`reparameterise` computes z from the sliders, and the student's `temporal_ensemble`
averages the last plans. The beads in front of the pusher are the newest plan; older
plans are paler.
"""

from functools import cache
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.draw import joined
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import chunking
from robo47.checks import Array

import day15_mujoco

LAB = lab_of(find_day(16))  # its seeds, its numbers of rows and units
CIRCLE = np.linspace(0, 2 * np.pi, 40)
RING = np.column_stack([np.cos(CIRCLE), np.sin(CIRCLE), 0 * CIRCLE])
UP = 0.02  # m, the height of the puck; the plans are drawn above it
OLD = 3  # older plans that are drawn


class Seen(NamedTuple):
    """An episode, its value of z, and the path of the plan made in each step."""

    run: day15_mujoco.Episodes
    z: float
    plans: Array  # m, (steps, K, 2)


def above(points: Array) -> Array:
    """Return points of the plane above the puck, (n, 3)."""
    return np.column_stack([points, np.full(len(points), 1.1 * UP)])


@cache
def latent() -> Any:
    """Train encoder and decoder by the library's functions; two seconds."""
    silent = SimpleNamespace(training=lambda title, steps: range(1, steps + 1))
    episodes = day15_mujoco.dock_demonstrations(LAB.DEMOS, LAB.SEED)
    return LAB.Latent(silent, LAB.Data(episodes, LAB.K))


class Plans(ui.Played):
    """A chunk as beads, which z swings from one side of the puck to the other."""

    title = "Plans"
    library = chunking
    functions = {"reparameterise": "", "temporal_ensemble": "m/s"}
    arm_hidden = True
    camera = ((0.0, -0.45, 0.6), (0.0, 0.0, 0.0))

    mu = ui.slider("mu", -2.0, 2.0, 1.2, "")
    logvar = ui.slider("logvar", -4.0, 1.0, -1.0, "")
    noise = ui.slider("noise", -2.0, 2.0, 0.6, "")
    averaged = ui.slider("plans averaged", 1, LAB.K, 4, "", step=1)
    decay = ui.slider("decay", -1.0, 1.0, 0.3, "")
    angle = ui.slider("puck: direction", -3.1, 3.1, -1.57)
    home = ui.scene.curve(day15_mujoco.HOME * RING, "green", legend="home")
    best = ui.scene.lines(ui.NOWHERE, "white", legend="the pusher by the library")
    old = ui.yours.lines(ui.NOWHERE, "blue", legend="older plans")
    beads = ui.yours.lines(ui.NOWHERE, "purple", legend="the newest plan")
    puck = ui.yours.disc(day15_mujoco.PUCK, UP, "orange", 0.6, legend="puck")
    pusher = ui.yours.disc(day15_mujoco.PUSHER, 3 * UP, "grey", legend="pusher")

    def ask(self, fns, at) -> Seen:
        given = (np.array([[one]]) for one in (at.mu, at.logvar, at.noise))
        z = np.asarray(fns.reparameterise(*given), dtype=float).reshape(1, 1)
        plans, start = self.planned(at, z)
        k = int(at.averaged)
        some = [plans[max(0, i + 1 - k) : i + 1] for i in range(len(plans))]
        actions = fns.many(*(("temporal_ensemble", stack, at.decay) for stack in some))
        left = iter(np.asarray(actions, dtype=float))
        run = day15_mujoco.run(*day15_mujoco.scene(), start, lambda _: next(left)[None])
        here = run.observation[0, :-1, None, :2]
        return Seen(run, z[0, 0], here + np.cumsum(plans, axis=1) * day15_mujoco.TICK)

    def planned(self, at, z: Array) -> tuple[Array, Array]:
        """Return the plans of a run by the library, (steps, K, 2), and its start."""
        plans: list[Array] = []

        def act(seen: Array) -> Array:
            plans.append(latent().plan(seen, z)[0])
            recent = np.array(plans[-int(at.averaged) :])
            return chunking.temporal_ensemble(recent, at.decay)[None]

        puck = 0.18 * np.array([np.cos(at.angle), np.sin(at.angle)])
        start = np.array([[0.0, 0.0, *puck]])
        day15_mujoco.run(*day15_mujoco.scene(), start, act)
        return np.array(plans), start

    def show(self, yours: Seen, right: Seen) -> None:
        self.seen = yours
        self.best.points = joined(above(right.run.observation[0, :, :2]))
        self.play()

    def frame(self, seconds: float) -> bool:
        one, k = self.seen.run.moment(seconds)
        self.pusher.position = np.array([*one[:2], 1.5 * UP])
        self.puck.position = np.array([*one[2:], UP / 2])
        self.beads.points = joined(above(self.seen.plans[k]))
        older = [
            joined(above(self.seen.plans[i])) for i in range(max(0, k - OLD), max(k, 1))
        ]
        self.old.points = np.concatenate(older)
        return seconds < day15_mujoco.TICK * len(self.seen.plans)

    def says(self, yours: Seen, right: Seen):
        yield f"Your z is {yours.z:.2f}.", "reparameterise"
        came = "ends at home" if yours.run.home()[0] else "does not end at home"
        side = "left" if day15_mujoco.on_the_left(yours.run)[0] else "right"
        says = f"The pusher goes around on the {side}, and the puck {came}."
        yield says, "reparameterise temporal_ensemble"
        yield "The decoder was trained with the library's functions.", None


TABS = [Plans]
