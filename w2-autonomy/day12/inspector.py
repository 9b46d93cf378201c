"""Day 12 in the inspector: the tab Way.

In the plane: discs, both trees as the student's own `extend` grows them, sample by
sample, the path of their `rrt_connect` over the library's, and their path after their
`shortcut`. The tab counts how many of twenty other sets of samples find a path, and
shows the confidence interval of their `wilson_interval`. In the scene an arm moves over
the lab's wall, with the timing of their `path_dynamics` and `time_optimal_profile`.
"""

from functools import cache, partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.canvas import Canvas
from labkit.inspector.draw import joined
from labkit.inspector.meshes import place
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import panda, planning, simulate
from robo47.checks import Array

import day12_mujoco

LAB = lab_of(find_day(12))  # its worlds, steps and seeds
PLANNERS = find_day(12).module("planners")
EDGE = 0.2  # longest edge of these trees: fewer edges than the lab's are visible
MOST = 100  # samples
DRAWS = 20  # sets of samples
SIDE = 1.3  # from the middle of the picture to its edge
LEG = 20  # steps of each leg that is timed
VALID = "valid, by another planner"
SAME = 1e-7

bare = cache(partial(panda.load, "panda_nohand"))
dressed = partial(panda.load, "panda_nohand", meshes=True)


class Seen(NamedTuple):
    """The results of the functions in a world."""

    discs: Array
    edges: tuple[list, list]  # of the start's tree and of the goal's: pairs of points
    way: Array
    cut: Array  # after their shortcut
    best: Array  # after the library's
    found: int  # of DRAWS
    interval: Array  # (2,)
    valid: bool  # whether the path is valid, whichever planner found it


class Way(ui.Declared):
    """Two trees, their path, and the confidence interval of a success rate."""

    title = "Way"
    library = planning
    functions = {
        "extend": "", "rrt_connect": "", "shortcut": "", "wilson_interval": "",
        "path_dynamics": "N m", "time_optimal_profile": "1/s2",
    }  # fmt: skip
    any_rows = ("rrt_connect", "shortcut")
    camera = ((2.1, -1.5, 1.15), (0.5, 0.3, 0.35))

    n = ui.slider("samples", 0, MOST, 40.0, "", 1)
    world = ui.slider("world", 0, 20, 2.0, "", 1)
    x = ui.slider("disc, x", -1, 1, 0.0, "", 0.05)
    y = ui.slider("disc, y", -1, 1, 0.0, "", 0.05)
    does = ui.buttons("over the wall", then="begin")
    image = ui.panel.image(np.zeros((480, 480, 3)), "the plane")
    key = ui.panel.key({
        "your tree from the start": "blue", "from the goal": "orange",
        "your path": "red", "after your shortcut": "green",
        "the library's path": "white",
    })  # fmt: skip
    bars = ui.panel.bars(
        ["lower", "upper"], 1.0, "",
        "success rate: your wilson_interval (marks: the library's)", "up",
    )  # fmt: skip
    drawn = ui.panel.robot(bare, dressed)
    path = ui.scene.lines(ui.NOWHERE, "purple", 4, legend="path of the hand")

    def prepare(self) -> None:
        self.wall = day12_mujoco.Wall()
        for (T, half), opacity in zip(self.wall.boxes, (None, 0.2), strict=True):
            place(self.page.draw.box(half, "grey", opacity), T)
        self.timing = self.page.jobs_apart()  # it is no reason to drop a plan
        self.legs = over_the_wall(self.wall)
        self.q, self.times, self.best = self.legs[:1], np.zeros(1), 0.0
        self.arm = panda.arm(self.wall.model)
        every = [a + s * (b - a) for a, b in pairwise(self.legs) for s in LINE]
        self.path.points = joined([self.arm.at(q).T_world_ee[:3, 3] for q in every])
        self.drawn.show(self.legs[0])

    def begin(self) -> None:
        self.timing.want(self.time_it, self.play)

    def ask(self, fns, at) -> Seen:
        rng = np.random.default_rng(int(at.world))
        start, goal, discs = LAB.plane_world(rng)
        discs = np.vstack([discs[:6], [at.x, at.y, 0.25]])
        draws = rng.uniform(-1.2, 1.2, (DRAWS + 1, MOST, 2))[:, : int(at.n)]
        calls = [("rrt_connect", start, goal, discs, one, EDGE) for one in draws]
        way, *others = fns.many(*calls)
        found = sum(len(one) > 0 for one in others)
        pairs = np.random.default_rng(LAB.SEED).uniform(0.0, 1.0, (LAB.PAIRS, 2))
        cut = best = way
        if len(way):
            cut = fns.shortcut(way, discs, pairs)
            best = planning.shortcut(way, discs, pairs)
        valid = bool(len(way)) and not PLANNERS.fault(way, start, goal, discs, EDGE)
        edges = trees(fns, start, goal, discs, draws[0])
        interval = fns.wilson_interval(found, DRAWS)
        return Seen(discs, edges, way, cut, best, found, interval, valid)

    def show(self, yours: Seen, right: Seen) -> None:
        self.image.image = picture(None if self.emptied else yours, right)
        truth = planning.wilson_interval(yours.found, DRAWS)
        self.bars.show(yours.interval, truth)

    def says(self, yours: Seen, right: Seen):
        way, differs = compared(yours.way, right.way, "Your path", yours.valid)
        cut, cut_differs = compared(yours.cut, yours.best, "Your shortened path")
        other = VALID if yours.valid else "another path"
        self.own.tell("rrt_connect", other if differs else "")
        self.own.tell("shortcut", "another path" if cut_differs else "")
        a, b = (len(edges) + 1 for edges in yours.edges)
        yield f"Your trees have {a} and {b} nodes.", "extend"
        yield way, None if differs and yours.valid else "rrt_connect"
        if len(yours.way):
            yield cut, "shortcut"
        low, high = yours.interval
        sets = f"{yours.found} of {DRAWS} sets of samples find a path: "
        yield f"{sets}{low:z.2f} to {high:z.2f}.", "wilson_interval"
        if self.best:
            yield (
                f"Over the wall: {self.times[-1]:.2f} s with your timing, "
                f"{self.best:.2f} s with the library's.",
                "path_dynamics time_optimal_profile",
            )

    def time_it(self) -> tuple[Array, Array, float]:
        """Return times, configurations, and the library's seconds; it waits."""
        times, q, truth = [np.zeros(1)], [self.legs[:1]], 0.0
        _, limits = simulate.limits(self.wall.model)
        for start, end in pairwise(self.legs):
            *path, most = self.along(start, end)
            x = self.own.time_optimal_profile(*path, limits, most)
            sd = np.sqrt(np.maximum(x, 0.0))
            mean = np.maximum(sd[1:] + sd[:-1], 1e-3)  # one at rest takes very long
            times.append(times[-1][-1] + np.cumsum(2.0 / LEG / mean))
            q.append(start + LINE[1:, None] * (end - start))
            right = LAB.along(self.arm, start, end, LEG)
            best = planning.time_optimal_profile(*right[:3], limits, right[3])
            truth += planning.travel_time(best)
        return np.concatenate(times), np.vstack(q), truth

    def along(self, start: Array, end: Array) -> tuple[Array, ...]:
        """Return a, b, c of an edge by the student's `path_dynamics`, and sd2_max."""
        dq, calls = end - start, []
        for s in LINE:
            now = self.arm.at(start + s * dq)
            coriolis = now.bias(dq) - now.gravity_torque
            known = now.M, dq, 0.0 * dq, coriolis, now.gravity_torque
            calls.append(("path_dynamics", *known))
        A, B, G = np.moveaxis(np.array(self.own.many(*calls)), 1, 0)
        with np.errstate(divide="ignore"):
            most = np.min(simulate.SPEED_LIMITS / np.abs(dq)) ** 2
        return A, B, G, np.full(LEG + 1, most)

    def play(self, timed: tuple[Array, Array, float]) -> None:
        """Play the timed path once."""
        self.times, self.q, self.best = timed
        self.loop.stop()
        self.loop.start()

    def frame(self, seconds: float) -> bool:
        self.drawn.show([np.interp(seconds, self.times, one) for one in self.q.T])
        return seconds < self.times[-1]

    def lost(self) -> None:
        super().lost()
        self.loop.stop()
        self.best = 0.0
        self.drawn.show(self.legs[0])


LINE = np.linspace(0.0, 1.0, LEG + 1)


def trees(fns, start: Array, goal: Array, discs: Array, samples: Array) -> tuple:
    """Return the edges of two trees that grow by `extend`."""
    nodes = [start], [goal]
    edges: tuple[list, list] = [], []

    def grow(side: int, target: Array) -> bool:
        i, q, free = fns.extend(np.array(nodes[side]), target, EDGE, discs)
        if free:
            i = int(np.clip(i, 0, len(nodes[side]) - 1))  # a wrong one draws, too
            edges[side].append((nodes[side][i], q))
            nodes[side].append(q)
        return bool(free)

    for k, sample in enumerate(samples):
        one, other = k % 2, 1 - k % 2
        if not grow(one, sample):
            continue
        new = nodes[one][-1]
        for _ in range(MOST):  # a wrong one may never arrive
            if not grow(other, new):
                break
            if np.array_equal(nodes[other][-1], new):
                return edges
    return edges


def over_the_wall(wall: day12_mujoco.Wall) -> Array:
    """Return the library's path for the lab's first seed, after shortcutting."""
    samples = day12_mujoco.samples(wall.model, LAB.COUNTS[-1], 0)
    ends = day12_mujoco.START, day12_mujoco.GOAL
    way = planning.rrt_connect(*ends, wall, samples, LAB.STEP)
    pairs = np.random.default_rng(LAB.SEED).uniform(0.0, 1.0, (LAB.PAIRS, 2))
    return planning.shortcut(way, wall, pairs)


def compared(
    way: Array, truth: Array, name: str, valid: bool = False
) -> tuple[str, bool]:
    """Return how a path compares with the library's, and whether it differs."""
    if not len(way) and not len(truth):
        return "There is no path with these samples, as by the library.", False
    if way.shape == truth.shape and np.abs(way - truth).max() < SAME:
        return f"{name} equals the library's: {len(way)} waypoints.", False
    if not len(way):
        return f"You find no path; the library's has {len(truth)} waypoints.", True
    says = f"{name} is {VALID}: it" if valid else name
    if not len(truth):
        return f"{says} has {len(way)} waypoints; the library finds none.", True
    n = min(len(way), len(truth))
    off = np.abs(way[:n] - truth[:n]).max(axis=1) > SAME
    at = int(np.argmax(off)) if off.any() else n
    return f"{says} differs from the library's from waypoint {at} on.", True


def picture(yours: Seen | None, right: Seen) -> Array:
    """Return the plane with the discs, the trees and the paths."""
    canvas = Canvas((-SIDE, -SIDE), (SIDE, SIDE), (480, 480))
    for x, y, r in right.discs:
        canvas.disc((x, y), r, (92, 100, 110))
    canvas.line(right.way, "white", 6)
    if yours is not None:
        for edges, colour in zip(yours.edges, ("blue", "orange"), strict=True):
            for edge in edges:
                canvas.line(edge, colour, 1.5)
        canvas.line(yours.way, "red", 2)
        canvas.line(yours.cut, "green", 2.5)
    for end in (right.way[:1], right.way[-1:]):
        canvas.dots(end, "white", 5)
    return canvas.picture()


TABS = [Way]
