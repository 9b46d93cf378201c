"""Day 15 in the inspector: the tab Clone.

A network that the kit has trained pushes the puck home from a start that the sliders
choose. The student's `fit_scaler`, `normalise`, `mlp` and `denormalise` compute the
action for each observation of this run, and the pusher moves with their actions. The
panel shows the activations of both hidden layers, and how far the observations are from
the training data.
"""

from functools import cache
from typing import NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.draw import joined
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import cloning
from robo47.checks import Array

import day15_mujoco

LAB = lab_of(find_day(15))  # its seeds, its numbers of rows and units
POLICIES = (
    "the clone",
    "the copycat, told its own last action",
    "the copycat, told the demonstrator's",
)
PIXELS = 10  # of a unit's side
CIRCLE = np.linspace(0, 2 * np.pi, 40)
UP = 0.02  # m, the height of the puck, and of what is drawn of its path


class Trained(NamedTuple):
    """A network of the kit's, and the rows that it was trained on."""

    net: list[Array]
    inputs: Array
    actions: Array


class Seen(NamedTuple):
    """An episode: observations and actions, and the inputs of the network."""

    run: day15_mujoco.Episodes
    inputs: Array  # normalised, (steps, 4 or 6)

    @property
    def path(self) -> Array:
        """The path of the puck, m, (steps + 1, 3)."""
        return above(self.run.observation[0, :, 2:])


def above(points: Array) -> Array:
    """Return points of the plane as they are drawn: above the puck, (n, 3)."""
    return np.column_stack([points, np.full(len(points), 1.1 * UP)])


@cache
def trained(copycat: bool) -> Trained:
    """Train a network by the library's functions; a third of a second."""
    episodes = day15_mujoco.demonstrations(LAB.DEMOS, LAB.SEED)
    x, actions, episode = episodes.rows()
    if copycat:
        x = np.hstack([x, LAB.with_last(episode, actions)])
    inputs, target = (
        cloning.normalise(some, cloning.fit_scaler(some)) for some in (x, actions)
    )
    rng = np.random.default_rng(LAB.SEED)
    start = cloning.random_net(rng, x.shape[1], LAB.UNITS, 2)
    steps = cloning.batches(rng, len(x), LAB.BATCH, range(1, LAB.UPDATES + 1))
    net = cloning.fit(
        start,
        lambda rows, net: cloning.mlp_gradient(inputs[rows], target[rows], *net),
        steps,
        lambda k: cloning.cosine_rate(k, LAB.UPDATES, LAB.RATE),
    )
    return Trained(net, x, actions)


class Clone(ui.Played):
    """A network pushes, and shows how far it is from its data."""

    title = "Clone"
    library = cloning
    functions = {
        "fit_scaler": "", "normalise": "", "mlp": "", "denormalise": "m/s",
    }  # fmt: skip
    arm_hidden = True
    camera = ((0.16, -0.42, 0.6), (0.13, 0.08, 0.0))

    policy = ui.choice("policy", POLICIES)
    far = ui.slider("puck: distance from home", 0.1, 0.5, 0.25, "m")
    aside = ui.slider("pusher: angle from behind", -3.1, 3.1, 1.5)
    plot = ui.panel.plot(
        ["distance"], y="distance to the nearest training row", height=150
    )
    image = ui.panel.image(
        np.zeros((3 * PIXELS, PIXELS * LAB.UNITS, 3)), "both hidden layers"
    )
    key = ui.panel.key({"activation 1": "orange", "activation -1": "blue"})
    home = ui.scene.curve(
        np.column_stack(
            [
                day15_mujoco.HOME * np.cos(CIRCLE),
                day15_mujoco.HOME * np.sin(CIRCLE),
                0 * CIRCLE,
            ]
        ),
        "green",
        legend="home",
    )
    best = ui.scene.lines(ui.NOWHERE, "white", legend="the puck by the library")
    way = ui.yours.lines(ui.NOWHERE, "orange", 4.0, legend="the puck by your functions")
    puck = ui.yours.disc(day15_mujoco.PUCK, UP, "orange")
    pusher = ui.yours.disc(day15_mujoco.PUSHER, 3 * UP, "blue", legend="pusher")

    def ask(self, fns, at) -> Seen:
        rows = self.observed(at)
        kit = trained(at.policy != POLICIES[0])
        inputs, actions = fns.many(
            ("fit_scaler", kit.inputs), ("fit_scaler", kit.actions)
        )
        z = np.asarray(fns.normalise(rows, inputs), dtype=float)
        left = iter(np.asarray(fns.denormalise(fns.mlp(z, *kit.net), actions)))
        start = rows[:1, :4]
        run = day15_mujoco.run(*day15_mujoco.scene(), start, lambda _: next(left)[None])
        return Seen(run, z)

    def observed(self, at) -> Array:
        """Return the inputs of the network in a run by the library, (steps, 4 or 6)."""
        told = at.policy != POLICIES[0]
        kit = trained(told)
        clone = LAB.Clone(kit.net, *map(cloning.fit_scaler, (kit.inputs, kit.actions)))
        last = np.zeros((1, 2))
        rows = []

        def act(seen: Array) -> Array:
            nonlocal last
            rows.append(np.hstack([seen, last]) if told else seen)
            action = clone.act(rows[-1])
            last = np.clip(action, -day15_mujoco.FASTEST, day15_mujoco.FASTEST)
            if at.policy == POLICIES[2]:
                last = day15_mujoco.demonstrator(seen)
            return action

        puck = np.array([0.0, at.far])
        angle = np.pi / 2 + at.aside
        pusher = puck + 0.12 * np.array([np.cos(angle), np.sin(angle)])
        start = np.hstack([pusher, puck])[None]
        day15_mujoco.run(*day15_mujoco.scene(), start, act)
        return np.vstack(rows)

    def show(self, yours: Seen, right: Seen) -> None:
        self.seen = yours
        self.best.points = joined(right.path)
        self.way.points = joined(yours.path)
        known = trained(self.policy != POLICIES[0]).inputs
        scaler = cloning.fit_scaler(known)
        known = cloning.normalise(known, scaler)[::4]
        far = cloning.nearest_distance(known, yours.inputs)
        self.plot.show(day15_mujoco.TICK * np.arange(len(far)), [far])
        self.play()

    def frame(self, seconds: float) -> bool:
        one, k = self.seen.run.moment(seconds)
        self.pusher.position = np.array([*one[:2], 1.5 * UP])
        self.puck.position = np.array([*one[2:], UP / 2])
        self.image.image = self.activations(self.seen.inputs[k])
        return seconds < day15_mujoco.TICK * len(self.seen.inputs)

    def activations(self, z: Array) -> Array:
        """Return a picture of both hidden layers for an input, bytes."""
        W1, b1, W2, b2 = trained(self.policy != POLICIES[0]).net[:4]
        first = np.tanh(z @ W1 + b1)
        h = np.array([first, 0 * first, np.tanh(first @ W2 + b2)])
        colour = np.where(h[..., None] > 0, (230, 159, 0), (0, 114, 178))
        dots = (np.abs(h)[..., None] * colour).astype(np.uint8)
        return dots.repeat(PIXELS, axis=0).repeat(PIXELS, axis=1)

    def says(self, yours: Seen, right: Seen):
        end = yours.run.observation[0, -1, 2:]
        came = "ends at home" if yours.run.home()[0] else "does not end at home"
        off = 1e3 * np.linalg.norm(end)
        says = f"With your functions the puck {came}: it is {off:.0f} mm away."
        yield says, " ".join(self.functions)
        yield "The network was trained with the library's functions.", None


TABS = [Clone]
