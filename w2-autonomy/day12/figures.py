"""The picture of Day 12, made with the lab's own functions; drawn by `make figures`.

way     both trees in the plane and their path; the speed and torques along a path
hand    two plans over the wall, with the hand omitted and with the whole arm
"""

from typing import NamedTuple

import day12_planning as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from PIL import Image

from labkit.figures import cards, chart, sheet
from labkit.figures.chart import BLUE, GREEN, GREY, INK, ORANGE, PURPLE, RED, SKY
from labkit.figures.scene import Box, Camera
from robo47 import panda, shapes, simulate
from robo47 import planning as library

import day12_mujoco

SEED = 2  # of the picture's world
SAMPLES = 150


class Seen(NamedTuple):
    """A world of discs that keeps each edge that it tested, and the result."""

    discs: np.ndarray
    edges: list

    def edge_free(self, a: np.ndarray, b: np.ndarray) -> bool:
        """Return the result of the lab's collision checker."""
        free = lab.segment_free_of_discs(a, b, self.discs)
        self.edges.append((np.array(a), np.array(b), bool(free)))
        return free


@chart.picture(height=6.4)
def way(figure: Figure) -> None:
    """Draw two trees and their path; speed and torques of Day 7's motion."""
    plane, right = figure.subfigures(1, 2, width_ratios=(1.15, 1.0))
    speed, torques = right.subplots(2, 1, sharex=True)
    _plane(plane.subplots())
    arm = panda.arm(day12_mujoco.Wall().model)
    _, limits = simulate.limits(day12_mujoco.Wall().model)
    _motion(speed, torques, lab.along(arm, panda.READY_Q, lab.TO, lab.POINTS), limits)


def _plane(axes: Axes) -> None:
    """Draw discs, both trees as the lab's planner grew them, and the path."""
    rng = np.random.default_rng(SEED)
    start, goal, discs = lab.plane_world(rng)
    samples = rng.uniform(-1.2, 1.2, (SAMPLES, 2))
    seen = Seen(discs, [])
    found = lab.rrt_connect(start, goal, seen, samples, lab.EDGE)
    for x, y, r in discs:
        axes.add_patch(Circle((x, y), r, color="#ced4da"))
    for root, colour, name in ((start, BLUE, "start's tree"),
                               (goal, ORANGE, "goal's tree")):  # fmt: skip
        label = name
        for a, b in _of_tree(root, seen.edges):
            axes.plot(*np.array([a, b]).T, color=colour, linewidth=1.1, label=label)
            label = None
    if len(found):
        axes.plot(*found.T, color=INK, linewidth=2.5, label="path")
        pairs = rng.uniform(0.0, 1.0, (lab.PAIRS, 2))
        cut = lab.shortcut(found, discs, pairs)
        axes.plot(*cut.T, "--", color=RED, label="after shortcutting")
    axes.plot(*start, "o", color=BLUE)
    axes.plot(*goal, "s", color=ORANGE)
    axes.set(aspect="equal", xlim=(-1.35, 1.35), ylim=(-1.35, 1.35))
    axes.set(title="RRT-Connect", xlabel="x", ylabel="y")
    axes.set_xticks([-1, 0, 1])
    axes.set_yticks([-1, 0, 1])
    axes.legend(loc="upper center", bbox_to_anchor=(0.45, -0.2), ncols=2)


def _of_tree(root: np.ndarray, edges: list) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return the collision-free edges of the tree with this root."""
    there = {root.tobytes()}
    kept = []
    for a, b, free in edges:
        if free and a.tobytes() in there:
            there.add(b.tobytes())
            kept.append((a, b))
    return kept


def _motion(speed: Axes, torques: Axes, path: tuple, limits: np.ndarray) -> None:
    """Draw sd^2 with all and half of the torque, and the torques of the second."""
    A, B, G, most = path
    s = np.linspace(0.0, 1.0, len(most))
    x, whose = _fastest(A, B, G, limits, most)
    half, _ = _fastest(A, B, G, 0.5 * limits, most)
    speed.plot(s, most, "--", color=GREY, label="velocity limit")
    speed.plot(s, x, ":", color=RED, label="all of the torque")
    speed.plot(s, half, color=INK, label="half of the torque")
    speed.set(ylabel=r"$\dot{s}^2$, 1/s²", ylim=(0, 1.9 * most.max()), title=whose)
    speed.legend(loc="upper left")
    u = np.diff(half) * (len(half) - 1) / 2.0
    tau = A[:-1] * u[:, None] + B[:-1] * half[:-1, None] + G[:-1]
    share = np.abs(tau) / (0.5 * limits)
    at_limit = share.max(axis=0) > 0.99
    rest = torques.plot(s[:-1], share[:, ~at_limit], color=GREY, linewidth=1.5)
    rest[0].set_label("other joints")
    colours = (ORANGE, BLUE, GREEN, RED, PURPLE, SKY, INK)
    for i, colour in zip(np.flatnonzero(at_limit), colours, strict=False):
        torques.plot(s[:-1], share[:, i], color=colour, label=f"joint {i + 1}")
    torques.axhline(1.0, color=INK, linewidth=1.0)
    torques.set(xlabel="path parameter s", ylabel="|torque| / half the limit")
    torques.set(ylim=(0, 1.9))
    torques.legend(loc="upper left")
    torques.grid()
    speed.grid()


def _fastest(*given: np.ndarray) -> tuple[np.ndarray, str]:
    """Return the lab's time-optimal motion, or the library's, and a title."""
    try:
        return lab.time_optimal_profile(*given), "Day 7's motion"
    except NotImplementedError:  # the side quest
        return library.time_optimal_profile(*given), "The library's motion"


def small() -> Image.Image:
    """Return the arm on its path over the wall."""
    wall = day12_mujoco.Wall()
    samples = day12_mujoco.samples(wall.model, lab.COUNTS[-1], SEED)
    start, goal = day12_mujoco.START, day12_mujoco.GOAL
    found = lab.rrt_connect(start, goal, wall, samples, lab.STEP)
    arm = panda.arm(wall.model)
    hand = np.array([arm.at(q).T_world_ee[:3, 3] for q in found])
    above = found[np.argmax(hand[:, 2])]
    (T_world_wall, half), _ = wall.boxes
    boxes = [Box(T_world_wall, half, cards.WOOD), *cards.line(hand, cards.SKY, 0.012)]
    camera = Camera((0.3, 0.0, 0.42), 2.4, np.radians(150.0), np.radians(-16.0))
    return cards.arm(above, camera, boxes)


def planned(forget: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray, float]:
    """Return a shortened path as configurations, the worst one and its distance, m.

    The collision checker of the plan omits some links. Of all plans of the lab with the
    hand omitted it is the one with the deepest collision; with the whole arm the first.
    """
    wall = day12_mujoco.Wall(forget)
    plans = lab.FORGOTTEN if forget else 1
    paths = lab.shorter(wall, lab.plan_with(wall, plans)[1])
    path = min(paths, key=lambda one: lab.least_distance(wall, one))
    along = lab.dense(path, lab.LOOKS)
    far = [wall.apart(q, wall.pairs) for q in along]
    return along, along[int(np.argmin(far))], min(far)


def pen(q: np.ndarray) -> np.ndarray:
    """Return the ends of the pen at configurations (..., 7): (..., 2, 3)."""
    return shapes.Shape(panda.load("panda_nohand"), [shapes.PEN]).ends(q)[..., 0, :, :]


def hand() -> Image.Image:
    """Return the worst pose of two plans, with the hand omitted and without."""
    (T_world_wall, half), _ = day12_mujoco.Wall().boxes
    wood = (*cards.WOOD[:3], 0.45)  # so that the pen is seen inside it
    camera = Camera((0.42, 0.0, 0.38), 2.1, np.radians(150.0), np.radians(-20.0))
    panels = []
    for forget, name, colour in (
        ((7,), "Hand omitted", cards.RED), ((), "Whole arm", cards.SKY)
    ):  # fmt: skip
        along, worst, far = planned(forget)
        boxes = [
            Box(T_world_wall, half, wood),
            *cards.line(pen(along)[::8, 1], colour, 0.006),
            cards.rod(*pen(worst), colour, 0.01),
        ]
        says = "inside the wall" if far < 0 else "from the wall or the roof"
        told = f"{1000 * abs(far):.0f} mm {says}"
        panels.append((cards.bare(worst, camera, boxes), name, told))
    return sheet.side_by_side(*panels)


FIGURES = {"way": way, "hand": hand}
SMALL = (small, "60 of 60")  # of a table of days, and its number
