"""Day 12 in the inspector: the tab Way.

In the plane: discs, both trees as the student's own `extend` grows them, sample by
sample, the path of their `rrt_connect` over the library's, and their path after their
`shortcut`. The tab counts how many of twenty other sets of samples find a path, and
shows the confidence interval of their `wilson_interval`. In the scene: a path over the
lab's wall, played with the timing of their `path_dynamics` and `time_optimal_profile`.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from labkit.inspector import words
from labkit.inspector.instruments import as_bytes
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
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
PIXELS = 480
LEG = 20  # steps of each leg that is timed
HZ = 30.0
BLUE, ORANGE, RED = (0, 114, 178), (230, 159, 0), (213, 60, 20)
GREEN = (0, 190, 140)
WHITE, GREY, GROUND = (255, 255, 255), (120, 126, 132), (28, 30, 34)
OVER = "over the wall"
VALID = "valid, by another planner"
UNITS = {"path_dynamics": "N m", "time_optimal_profile": "1/s2"}


class Seen(NamedTuple):
    """The results of the student's functions in a world."""

    discs: Array
    edges: tuple[list, list]  # of the start's tree and of the goal's: pairs of points
    way: Array  # theirs
    cut: tuple[Array, Array]  # after their shortcut, and the library's
    truth: Array  # the library's
    found: int  # of DRAWS, by theirs
    interval: Array  # theirs, (2,)
    valid: bool = False  # whether their path is valid, whichever planner found it


class Way(Tab):
    """Two trees, their path, and the confidence interval of a success rate."""

    title = "Way"
    wide = True

    def __init__(self, page: Page) -> None:
        """Draw the wall, plan over it, and compute for the first time."""
        super().__init__(page)
        self.n = 40.0
        self.world = 2.0
        self.x = 0.0
        self.y = 0.0
        self.bare: Seen | None = None  # the world, and the library's way, alone
        self.timing = page.jobs_apart()  # what is timed is no reason to drop a plan
        self.own = page.own(planning, any_rows={"rrt_connect", "shortcut"}, units=UNITS)
        page.slider("samples", 0, MOST, self.n, self.sets("n"), unit="", step=1)
        page.slider("world", 0, 20, self.world, self.sets("world"), unit="", step=1)
        page.slider("a disc, x", -1, 1, self.x, self.sets("x"), unit="", step=0.05)
        page.slider("a disc, y", -1, 1, self.y, self.sets("y"), unit="", step=0.05)
        blank = np.zeros((PIXELS, PIXELS, 3), np.uint8)
        title = (
            "your trees: start's blue, goal's orange; path: yours red, after "
            "shortcutting green, library's white"
        )
        self.image = page.image(blank, title)
        self.text = page.html()
        title = (
            f"success rate of {DRAWS} sets of samples: "
            "your wilson_interval, marks the library's"
        )
        self.bars = page.bars(["lower", "upper"], 1.0, "", title, "up")
        page.buttons([OVER], self.press)
        self.timed = page.html()
        self.draw_scene()
        self.loop = page.animate(self.step, HZ)
        self.on_move(page.q)

    def draw_scene(self) -> None:
        """Draw wall and roof, and the arm at the waypoints of a path over the wall."""
        self.wall = day12_mujoco.Wall()
        for box in self.wall.boxes:
            self.page.draw.lines(box_edges(*box), "grey")
        self.cut = over_the_wall(self.wall)
        for q in self.cut:
            self.page.draw.ghost("purple", 0.25).pose(self.page.links(q))
        self.runner = self.page.draw.ghost("orange", 0.8)
        told = {
            "waypoints of the library's path": "purple",
            "with your timing": "orange",
        }
        self.page.legend(told)
        self.at: Array = np.zeros(1)
        self.q: Array = self.cut[:1]

    def on_move(self, q: Array) -> None:
        """Compute again: the world has changed, or the file may have."""
        asked = self.chosen()
        self.page.job(lambda: (asked, self.ask(*asked)), self.answered)

    def begin(self) -> None:
        """Time the path over the wall, and play it."""
        self.press(OVER)

    def chosen(self) -> tuple[float, ...]:
        """Return the values of the sliders."""
        return self.n, self.world, self.x, self.y

    def answered(self, result: tuple[tuple[float, ...], Seen]) -> None:
        """Show the result, unless a slider has been moved meanwhile."""
        asked, seen = result
        if asked == self.chosen():
            self.show(seen)

    def ask(self, n: float, world: float, x: float, y: float) -> Seen:
        """Return the results of the student's functions in a world; it waits."""
        rng = np.random.default_rng(int(world))
        start, goal, discs = LAB.plane_world(rng)
        discs = np.vstack([discs[:6], [x, y, 0.25]])
        draws = rng.uniform(-1.2, 1.2, (DRAWS + 1, MOST, 2))[:, : int(n)]
        truth = planning.rrt_connect(start, goal, discs, draws[0], EDGE)
        none = np.zeros((0, 2))
        self.bare = Seen(discs, ([], []), none, (none, none), truth, 0, np.zeros(2))
        calls = [("rrt_connect", start, goal, discs, one, EDGE) for one in draws]
        way, *others = self.own.many(*calls)
        found = sum(len(one) > 0 for one in others)
        return Seen(
            discs,
            self.trees(start, goal, discs, draws[0]),
            way,
            self.cut_of(way, discs),
            truth,
            found,
            self.own.wilson_interval(found, DRAWS),
            bool(len(way)) and not PLANNERS.fault(way, start, goal, discs, EDGE),
        )

    def cut_of(self, way: Array, discs: Array) -> tuple[Array, Array]:
        """Return a path after the student's shortcut, and after the library's."""
        if not len(way):
            return way, way
        pairs = np.random.default_rng(LAB.SEED).uniform(0.0, 1.0, (LAB.PAIRS, 2))
        yours = self.own.shortcut(way, discs, pairs)
        return yours, planning.shortcut(way, discs, pairs)

    def trees(self, start: Array, goal: Array, discs: Array, samples: Array) -> tuple:
        """Return the edges of two trees that grow by the student's `extend`."""
        nodes = [start], [goal]
        edges: tuple[list, list] = [], []

        def grow(side: int, target: Array) -> bool:
            i, q, free = self.own.extend(np.array(nodes[side]), target, EDGE, discs)
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

    def show(self, seen: Seen) -> None:
        """Show the plane, both paths, and the confidence interval."""
        self.image.image = as_bytes(picture(seen))
        low, high = seen.interval
        self.bars.show(seen.interval, planning.wilson_interval(seen.found, DRAWS))
        told, kind = compared(seen.way, seen.truth, valid=seen.valid)
        cut, kind_cut = compared(*seen.cut, "your shortcut")
        other = VALID if seen.valid else "another path"
        self.own.tell("rrt_connect", other if kind in ("bad", "quiet") else "")
        self.own.tell("shortcut", "another path" if kind_cut == "bad" else "")
        a, b = (len(edges) + 1 for edges in seen.edges)
        share = f"{seen.found} of {DRAWS} sets find a path: {low:.2f} to {high:.2f}"
        self.text.content = "".join(
            words.line(text, key, kind)
            for text, key, kind in (
                (f"your trees: {a} and {b} nodes", "trees", ""),
                (told, "way", kind),
                (cut if len(seen.way) else "", "cut", kind_cut),
                (share, "share", ""),
            )
        )

    def press(self, name: str) -> None:
        """Time the path over the wall with the student's functions, and play it."""
        self.timing.want(self.time_it, self.play)

    def time_it(self) -> tuple[Array, Array, float]:
        """Return times, configurations, and the library's seconds; it waits."""
        arm = panda.arm(self.wall.model)
        _, limits = simulate.limits(self.wall.model)
        times, q, truth = [np.zeros(1)], [self.cut[:1]], 0.0
        for leg in pairwise(self.cut):
            *path, most = self.along(arm, *leg)
            x = self.own.time_optimal_profile(*path, limits, most)
            sd = np.sqrt(np.maximum(x, 0.0))
            mean = np.maximum(
                sd[1:] + sd[:-1], 1e-3
            )  # a motion at rest takes very long
            times.append(times[-1][-1] + np.cumsum(2.0 / LEG / mean))
            s = np.linspace(0.0, 1.0, LEG + 1)[1:, None]
            q.append(leg[0] + s * (leg[1] - leg[0]))
            right = LAB.along(arm, *leg, LEG)
            best = planning.time_optimal_profile(*right[:3], limits, right[3])
            truth += planning.travel_time(best)
        return np.concatenate(times), np.vstack(q), truth

    def along(self, arm, start: Array, end: Array) -> tuple[Array, ...]:
        """Return a, b, c of an edge by the student's `path_dynamics`, and sd2_max."""
        dq = end - start
        calls = []
        for s in np.linspace(0.0, 1.0, LEG + 1):
            now = arm.at(start + s * dq)
            coriolis = now.bias(dq) - now.gravity_torque
            calls.append(
                ("path_dynamics", now.M, dq, 0.0 * dq, coriolis, now.gravity_torque)
            )
        A, B, G = np.moveaxis(np.array(self.own.many(*calls)), 1, 0)
        with np.errstate(divide="ignore"):
            most = np.min(simulate.SPEED_LIMITS / np.abs(dq)) ** 2
        return A, B, G, np.full(LEG + 1, most)

    def play(self, timed: tuple[Array, Array, float]) -> None:
        """Play the timed path once."""
        self.at, self.q, truth = timed
        off = abs(self.at[-1] - truth) > 1e-6
        says = f"over the wall: yours {self.at[-1]:.2f} s, the library's {truth:.2f} s"
        self.timed.content = words.line(says, "over", "bad" if off else "good")
        self.loop.stop()
        self.loop.start()

    def step(self, seconds: float) -> bool:
        """Show the arm at a time; return whether it goes on."""
        q = [np.interp(seconds, self.at, one) for one in self.q.T]
        self.runner.pose(self.page.links(np.array(q)))
        return seconds < self.at[-1]

    def lost(self) -> None:
        """Show no numbers, no trees, and no arm on the path."""
        self.loop.stop()
        self.runner.pose({})
        self.text.content = ""
        self.timed.content = ""
        self.bars.clear()
        if self.bare is not None:
            self.image.image = as_bytes(picture(self.bare))


def over_the_wall(wall: day12_mujoco.Wall) -> Array:
    """Return the library's path for the lab's first seed, after shortcutting."""
    samples = day12_mujoco.samples(wall.model, LAB.COUNTS[-1], 0)
    ends = day12_mujoco.START, day12_mujoco.GOAL
    way = planning.rrt_connect(*ends, wall, samples, LAB.STEP)
    pairs = np.random.default_rng(LAB.SEED).uniform(0.0, 1.0, (LAB.PAIRS, 2))
    return planning.shortcut(way, wall, pairs)


def compared(
    way: Array, truth: Array, name: str = "your path", valid: bool = False
) -> tuple[str, str]:
    """Return how a path compares with the library's, in words, and the kind of line."""
    if not len(way) and not len(truth):
        return "no path yet, as by the library", ""
    if way.shape == truth.shape and np.abs(way - truth).max() < 1e-7:
        return f"{name} equals the library's: {len(way)} waypoints", "good"
    if not len(way):
        return f"you find no path; the library's has {len(truth)} waypoints", "bad"
    kind = "quiet" if valid else "bad"
    says = f"{name} is {VALID}: it" if valid else name
    if not len(truth):
        return f"{says} has {len(way)} waypoints; the library finds none", kind
    n = min(len(way), len(truth))
    off = np.abs(way[:n] - truth[:n]).max(axis=1) > 1e-7
    at = int(np.argmax(off)) if off.any() else n
    return f"{says} differs from waypoint {at} on, counted from 0", kind


def picture(seen: Seen) -> Array:
    """Return the plane as an image of bytes, (PIXELS, PIXELS, 3), y upwards."""
    image = np.empty((PIXELS, PIXELS, 3), np.uint8)
    image[:] = GROUND
    line = np.linspace(-SIDE, SIDE, PIXELS)
    for x, y, r in seen.discs:
        inside = np.hypot(line[None, :] - x, -line[:, None] - y) <= r
        image[inside] = GREY
    for edges, colour in zip(seen.edges, (BLUE, ORANGE), strict=True):
        for edge in edges:
            stroke(image, np.array(edge), colour, 1)
    stroke(image, seen.truth, WHITE, 3)
    stroke(image, seen.way, RED, 1)
    stroke(image, seen.cut[0], GREEN, 1)
    return image


def stroke(image: Array, points: Array, colour: tuple[int, ...], half: int) -> None:
    """Draw a line through points, (m, 2), 2 half + 1 pixels wide."""
    for a, b in pairwise(points):
        dots = a + np.linspace(0.0, 1.0, PIXELS)[:, None] * (b - a)
        dots = np.nan_to_num(dots, nan=9.0)
        column = np.round((dots[:, 0] + SIDE) / (2 * SIDE) * (PIXELS - 1))
        row = np.round((SIDE - dots[:, 1]) / (2 * SIDE) * (PIXELS - 1))
        for across in range(-half, half + 1):
            for down in range(-half, half + 1):
                u = (column + across).astype(int)
                v = (row + down).astype(int)
                there = (u >= 0) & (u < PIXELS) & (v >= 0) & (v < PIXELS)
                image[v[there], u[there]] = colour


def box_edges(T_world_box: Array, half: Array) -> Array:
    """Return the twelve edges of a box, (12, 2, 3)."""
    corners = np.array(np.meshgrid(*[(-1, 1)] * 3)).reshape(3, -1).T * half
    corners = corners @ T_world_box[:3, :3].T + T_world_box[:3, 3]
    pairs = [(i, j) for i in range(8) for j in range(i)
             if np.sum(np.abs(corners[i] - corners[j]) > 1e-9) == 1]  # fmt: skip
    return np.array([[corners[i], corners[j]] for i, j in pairs], np.float32)


TABS = [Way]
