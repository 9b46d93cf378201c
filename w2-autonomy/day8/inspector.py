"""Day 8 in the inspector: the tab Weigh.

A sphere is fixed to the hand of the lab's unknown robot, and the arm is held from both
sides. A scale and a table show the payload that the student's own functions identify,
with its sigma, next to the library's. The blue sphere is at their centre of mass.
"""

from typing import NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector import words
from labkit.inspector.canvas import Canvas
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import identification, panda
from robo47.checks import Array

import day8_mujoco

LAB = lab_of(find_day(8))  # its robot, poses, wait and tolerance
UNITS = "(kg or kg m)"
NO_MASS = 1e-9  # kg; a smaller mass has no centre
WAYS = ("one side", "a side each", "averaged")  # which holds are compared
WIDE, MARK = 0.25, "blue"  # the scale's half width, as a fraction of the mass


class Found(NamedTuple):
    """The payload that one comparison of holds gives."""

    load: Array  # m and m c, kg and kg m, (4,)
    sigma: Array  # of each, (4,)
    rank: int  # of the regressor, at most 4

    def centre(self) -> Array:
        """Return the centre of mass in the hand frame, m, (3,); NaN without a mass."""
        m = self.load[0] if abs(self.load[0]) > NO_MASS else np.nan
        return self.load[1:] / m

    def cells(self) -> list[str]:
        """Return mass and sigma, g, and the centre and its sigma, mm, as text."""
        m = max(abs(self.load[0]), NO_MASS)
        mass, sigma = (f"{1000 * x[0]:.1f}" for x in (self.load, self.sigma))
        centre = ", ".join(f"{1000 * x:z.0f}" for x in self.centre())
        return [mass, f"± {sigma}", centre, f"± {1000 * self.sigma[1:].max() / m:.1f}"]


class Weigh(ui.Declared):
    """A payload, its estimate and the standard deviation."""

    title = "Weigh"
    library = identification
    functions = {
        "identify_payload": UNITS, "predict_with_sigma": UNITS,
        "rank_and_condition": "",
    }  # fmt: skip

    grams = ui.slider("mass of the load", 50, 2000, 1000 * LAB.LOAD, "g", 50, "forget")
    below = ui.slider(
        "distance below the hand", 0, 200, 1000 * LAB.AT[2], "mm", 5, "forget"
    )
    does = ui.buttons("hold here", "five poses", "forget", then="press")
    scale = ui.panel.image(np.zeros((130, 384, 3)), "the mass, g; bars: two sigma")
    key = ui.panel.key({"true": "white", "yours": MARK, "the library's": "orange"})
    table = ui.panel.html()
    ball = ui.scene.sphere(
        np.zeros(3), day8_mujoco.RADIUS, "orange", 0.5, legend="the load"
    )
    centre = ui.yours.sphere(
        np.zeros(3), day8_mujoco.RADIUS / 2, "blue", legend="your centre of mass"
    )

    def prepare(self) -> None:
        model = panda.load("panda_nohand", drive="torque")
        self.arm = panda.arm(model)
        self.empty = day8_mujoco.changed(model, LAB.ROBOT_SEED)
        self.holding = (
            self.page.jobs_apart()
        )  # so that an estimate does not drop a hold
        self.at_hand = np.full(3, np.nan)  # the student's centre of mass, m
        self.forget()

    def com(self) -> Array:
        """Return the load's true centre of mass in the hand frame, m, (3,)."""
        return np.array([*LAB.AT[:2], self.below / 1000.0])

    def forget(self) -> None:
        """Drop all holds: the load has changed, or they are not wanted."""
        self.held: list[Array] = []  # q, torque with and without, from either side
        self._reference = None
        self.lost()
        self.place()
        self.table.content = words.line("No pose was held yet.", "weighed")

    def press(self) -> None:
        """Hold the arm where it is, or in the lab's five poses; or forget all holds."""
        if self.does != "hold here":  # the same holds twice would look like more data
            self.forget()
        if self.does != "forget":
            here = self.does == "hold here"
            self.hold([self.page.q[:7]] if here else list(LAB.POSES))

    def hold(self, poses: list[Array]) -> None:
        """Hold the arm in some poses, which takes some tenths of a second each."""
        before, mass, com = self.held, self.grams / 1000.0, self.com()

        def held() -> list[Array]:
            edit = day8_mujoco.load(mass, com)
            hung = panda.load("panda_nohand", drive="torque", edit=edit)
            full, made = day8_mujoco.changed(hung, LAB.ROBOT_SEED), []
            for pose in poses:
                _, empty = day8_mujoco.holds(self.empty, self.arm, [pose], LAB.WAIT)
                with_load = day8_mujoco.holds(full, self.arm, [pose], LAB.WAIT)
                made.append(np.array([*with_load, empty]))
            return made

        def keep(made: list[Array]) -> None:
            if self.held is before:  # nothing has been forgotten meanwhile
                self.held = [*before, *made]
                self.request()

        self.holding.want(held, keep)

    def begin(self) -> None:
        if not self.held:
            self.hold([self.page.q[:7]])

    def on_move(self, q: Array) -> None:
        self.place()
        self.request()

    def request(self) -> None:
        if self.held:
            super().request()

    def at(self):
        found = super().at()
        found.held = self.held
        return found

    def ask(self, fns, at) -> list[Found]:
        """Return the estimates from the holds, one for each way to compare them.

        A hold is q (rad), torque with the load and without (N m), (3, 2, 1, 7).
        """
        q, full, empty = np.concatenate(at.held, axis=2)  # (side, pose, joint) each
        ways = (
            (q[0], full[0] - empty[0]),
            (q[1], full[1] - empty[0]),
            (q.mean(axis=0), (full - empty).mean(axis=0)),
        )
        answers = iter(fns.many(*(call for way in ways for call in self.calls(*way))))
        found = []
        for load, (_, sigma), (rank, _) in zip(answers, answers, answers, strict=True):
            found.append(Found(np.asarray(load), np.asarray(sigma), int(rank)))
        return found

    def calls(self, at: Array, extra: Array) -> list[tuple[object, ...]]:
        """Return the calls for holds at q, rad, (k, 7), and their torques, N m."""
        J, R = day8_mujoco.hands(self.arm, at)
        g = self.arm.gravity
        rows = identification.load_regressor(J, R, g).reshape(-1, 4)
        return [
            ("identify_payload", J, R, extra, g),
            ("predict_with_sigma", rows, extra.ravel(), np.eye(4), LAB.RTOL),
            ("rank_and_condition", rows, LAB.RTOL),
        ]

    def show(self, yours: list[Found], right: list[Found]) -> None:
        rows, kind = [], self.kind_of(" ".join(self.functions))
        for name, mine, best in zip(WAYS, yours, right, strict=True):
            rows.append(([name, *mine.cells()], kind))
            if mine.cells() != best.cells():
                rows.append((["library", *best.cells()], "quiet"))
        head = ("compared", "mass, g", "sigma", "centre, mm", "sigma")
        self.table.content = words.table(head, rows)
        self.scale.image = self.drawn([] if self.emptied else yours, right)
        self.at_hand = yours[-1].centre()
        self.place()

    def drawn(self, yours: list[Found], right: list[Found]) -> Array:
        """Return a scale: the true mass, and each estimate with two sigma."""
        low, high = (1 - WIDE) * self.grams, (1 + WIDE) * self.grams
        edge = 0.32 * WIDE * self.grams
        canvas = Canvas((low - 3 * edge, 3.7), (high + edge, -0.2), (732, 240))
        for mass in np.linspace(low, high, 5):
            canvas.line([(mass, 0.0), (mass, 3.0)], "grey", 1)
            canvas.words(f"{mass:.0f}", (mass, 3.35), "grey", "mm", 22)
        canvas.line([(self.grams, 0.0), (self.grams, 3.0)], "white", 4)
        for row, name in enumerate(WAYS):
            at = (low - 2.8 * edge, row + 0.5)
            canvas.words(name, at, "white", "lm", 24)
        for shift, colour, some in ((0.15, "orange", right), (-0.15, MARK, yours)):
            for row, found in enumerate(some):
                mass, sigma = 1000 * found.load[0], 1000 * found.sigma[0]
                y = row + 0.5 + shift
                ends = np.clip([mass - 2 * sigma, mass, mass + 2 * sigma], low, high)
                canvas.line([(ends[0], y), (ends[2], y)], colour, 4)
                canvas.dots([(ends[1], y)], colour, 8)
                if ends[1] != mass:
                    at = "lm" if mass < low else "rm"
                    canvas.words(f"  {mass:.0f} g  ", (ends[1], y), colour, at, 20)
        return canvas.picture()

    def says(self, yours: list[Found], right: list[Found]):
        last = yours[-1]
        hidden = " (not the centre along gravity)" if last.rank < 4 else ""
        held = "1 pose was" if len(self.held) == 1 else f"{len(self.held)} poses were"
        yield (
            f"{held} held: {last.rank} of 4 parameters are identifiable{hidden}.",
            "rank_and_condition",
        )
        grams, sigma = 1000 * last.load[0], 1000 * last.sigma[0]
        truth = f"The true mass is {self.grams:.0f} g. You weigh {grams:.1f} g "
        of = "identify_payload predict_with_sigma"
        yield f"{truth}with a sigma of {sigma:.1f} g.", of

    def place(self) -> None:
        """Draw both spheres at the hand's present pose."""
        T = self.arm.at(self.page.q[:7]).T_world_ee
        self.ball.position = T[:3, 3] + T[:3, :3] @ self.com()
        there = bool(np.isfinite(self.at_hand).all()) and not self.emptied
        self.centre.visible = there
        if there:
            self.centre.position = T[:3, 3] + T[:3, :3] @ self.at_hand


TABS = [Weigh]
