"""Day 14 in the inspector: the tab Touch.

Two pads lift a cube. The student's `cone_edges` and `cone_margin` compute the cones and
the smallest margin over time, and their `grip_reflex_step` may close the pads.
Below, their `act`, `reward` and `cem_step` learn a policy, generation by generation.
The cubes that it holds appear as dots over friction and mass.
"""

from typing import NamedTuple

import numpy as np

from labkit.inspector import words
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import grasp, policy, se3
from robo47.checks import Array

import day14_mujoco

LAB = lab_of(find_day(14))  # its seeds, its start, what is held
AGAIN, ROUND, TRY, NEW = "lift again", "one generation", "test 20 cubes", "start over"
TRIED = 20
ENTRY = "in one entry"
UNITS = {"cone_margin": "N", "grip_reflex_step": "m", "observe": ENTRY, "act": ENTRY,
         "cem_step": ENTRY}  # fmt: skip
ROUND_CONE = 12  # edges of a cone that is drawn
LONG = 0.008  # m of an arrow, for 1 N
SIZE = (240, 360)  # px of the dots' picture
FRICTION, GRAMS = (0.1, 1.0), (0.0, 300.0)  # its ends
BLUE, RED, BLACK, PAPER = (0, 114, 178), (213, 94, 0), (33, 37, 41), (250, 250, 250)
PLACES = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
EDGES = [(i, j) for i in range(8) for j in range(i) if (i ^ j) in (1, 2, 4)]
FULL = np.maximum(np.abs(LAB.LOW), np.abs(LAB.HIGH))


class Moment(NamedTuple):
    """What an episode was like 10 ms long."""

    t: float  # s
    cube: Array  # m, (3,), of its middle
    pads: Array  # m, (2, 3), of their middles
    felt: day14_mujoco.Felt


class Lifted(NamedTuple):
    """An episode, and what the student's functions say of it."""

    asked: tuple[float, float, float, bool]  # what the sliders said
    moments: list[Moment]
    shown: int  # which of them is drawn
    yours: list[Array]  # margins, of each moment with a contact, N
    right: list[Array]  # those of the library
    edges: Array  # of both cones, (2 * ROUND_CONE, 3)
    height: float  # m, at the end
    newtons: float  # per pad, at the end


class Touch(Tab):
    """What fingers feel, and what a policy of six numbers has learned."""

    title = "Touch"
    wide = True
    camera = ((0.34, -0.14, 0.16), (0.0, 0.075, 0.05))

    def __init__(self, page: Page) -> None:
        """Lift the first cube, and forget what was learned."""
        super().__init__(page)
        page.hide_arm()
        self.model, self.data = day14_mujoco.hand()
        self.mu = 0.3
        self.grams = 220.0
        self.squeeze = 3.0
        self.feels = False
        self.own = page.own({**vars(grasp), **vars(policy)}, units=UNITS)
        page.slider("friction", 0.1, 1, self.mu, self.sets("mu"), unit="", step=0.05)
        page.slider("mass", 20, 300, self.grams, self.sets("grams"), unit="g", step=10)
        page.slider("grip force", 0.5, 8, self.squeeze, self.sets("squeeze"), unit="N",
                    step=0.5)  # fmt: skip
        page.tick("use your grip_reflex_step", self.sets("feels"))
        self.text = page.html()
        curves = ["yours", "the library's"]
        self.plot = page.plot(curves, y="smallest margin, N", height=130)
        page.buttons([AGAIN, ROUND, TRY, NEW], self.press)
        self.bars = page.bars(
            [name.partition(",")[0] for name in LAB.NUMBERS], np.ones(6), "",
            "theta, relative to its limit; marks: one std more", "both",
        )  # fmt: skip
        self.learned = page.html()
        self.image = page.image(self.dots([]), "friction to the right, mass upwards")
        page.draw.lines(floor(), "grey")
        self.box = page.draw.lines(np.zeros((12, 2, 3)), "orange", 3)
        self.pads = page.draw.lines(np.zeros((24, 2, 3)), "white", 3)
        self.cones = page.draw.lines(np.zeros((2 * ROUND_CONE, 2, 3)), "green", 2)
        self.arrows = page.draw.arrows(np.zeros((2, 2, 3)), "red", 0.0015)
        page.legend({"force on the cube": "red", "your cone": "green"})
        self.start_over()
        self.on_move(page.q)

    # One cube

    def on_move(self, q: Array) -> None:
        """Lift it again: a slider was moved, or the file may be another."""
        asked = (self.mu, self.grams, self.squeeze, self.feels)
        self.page.job(lambda: self.lift(*asked), self.show)

    def lift(self, mu: float, grams: float, squeeze: float, feels: bool) -> Lifted:
        """Return an episode, and what the student's functions say of each moment."""
        cube = day14_mujoco.Cube(0.0, 0.0, 0.0, grams / 1000, mu)
        opening = day14_mujoco.HALF - squeeze / day14_mujoco.SPRING
        action = np.array([0, 0, 0, 0.02, opening, 0.1])
        last = opening

        def touch(opening: float, felt: day14_mujoco.Felt) -> float:
            nonlocal last
            if len(felt.mu):
                told = (*felt[1:], LAB.SHARE, LAB.CLOSE)
                last = float(self.own.grip_reflex_step(opening, *told))
            return last

        given = (self.model, self.data, cube, action, touch if feels else None)
        moments = [self.moment() for _ in day14_mujoco.episode(*given)]
        felt = [one.felt for one in moments if len(one.felt.mu)]
        calls = [("cone_margin", one.force, one.normal, one.mu) for one in felt]
        right = [grasp.cone_margin(one.force, one.normal, one.mu) for one in felt]
        shown = round((day14_mujoco.CLOSED + 0.03) / 0.01)
        normals = np.array([[0, -1.0, 0], [0, 1.0, 0]])  # of the pads, into the cube
        cones = [("cone_edges", normal, mu, ROUND_CONE) for normal in normals]
        *yours, left, other = self.own.many(*calls, *cones)
        return Lifted(
            (mu, grams, squeeze, feels),
            moments,
            shown,
            [np.asarray(one) for one in yours],
            right,
            np.vstack([left, other]),
            day14_mujoco.height(self.data),
            day14_mujoco.SPRING * (day14_mujoco.HALF - last),
        )

    def moment(self) -> Moment:
        """Return what is so now."""
        pads = [self.data.geom(name).xpos.copy() for name in ("left", "right")]
        cube = self.data.body("cube").xpos.copy()
        felt = day14_mujoco.felt(self.model, self.data)
        return Moment(self.data.time, cube, np.array(pads), felt)

    def show(self, lifted: Lifted) -> None:
        """Show the moment when it rises, and how it went."""
        if lifted.asked != (self.mu, self.grams, self.squeeze, self.feels):
            return  # the sliders have been moved meanwhile
        times = [one.t for one in lifted.moments if len(one.felt.mu)]
        least = [[np.min(one) for one in some] for some in (lifted.yours, lifted.right)]
        if times:
            self.plot.show(times, least)
        now = lifted.moments[lifted.shown]
        self.box.points = boxed(now.cube, np.full(3, day14_mujoco.HALF))
        half = np.array(day14_mujoco.PAD_HALF)
        self.pads.points = np.vstack([boxed(pad, half) for pad in now.pads])
        self.draw_forces(now, lifted.edges)
        held = LAB.HELD < lifted.height <= LAB.CAP
        said = "held" if held else "not held"
        off = np.abs(np.subtract(*least)).max(initial=0.0)
        good = off < 1e-6
        lines = [
            (f"finally the cube is {said} at {1000 * lifted.height:z.0f} mm", "held",
             ""),
            (f"grip force {lifted.newtons:.1f} N per pad; "
             f"at rest it needs {weight(lifted):.1f} N", "press", ""),
            (f"your smallest margin, while closed: {late(times, least[0]):z.2f} N; "
             f"by the library {late(times, least[1]):z.2f} N", "margin",
             "good" if good else "bad"),
        ]  # fmt: skip
        self.text.content = "".join(words.line(*one) for one in lines)

    def draw_forces(self, now: Moment, edges: Array) -> None:
        """Draw each pad's force on the cube, and the student's cone of that size."""
        arrows = np.zeros((2, 2, 3))
        cones = np.zeros((2, ROUND_CONE, 2, 3))
        for k, side in enumerate((1, -1)):
            some = side * (now.felt.points[:, 1] - now.cube[1]) > 0
            if not some.any():  # it has left that pad
                continue
            at = now.felt.points[some].mean(axis=0)
            force = now.felt.force[some].sum(axis=0)
            arrows[k] = at, at + LONG * force
            press = max(-side * force[1], 0.0)
            cone = edges[k * ROUND_CONE : (k + 1) * ROUND_CONE]
            cones[k, :, 0] = at
            cones[k, :, 1] = at + LONG * press * cone
        self.arrows.points = arrows.astype(np.float32)
        self.cones.points = cones.reshape(-1, 2, 3).astype(np.float32)

    # Six numbers

    def press(self, name: str) -> None:
        """Lift again, learn one generation, test some cubes, or start over."""
        if name == AGAIN:
            self.on_move(self.page.q)
        elif name == NEW:
            self.start_over()
        else:
            work = self.learn_round if name == ROUND else self.try_cubes
            self.page.job(work, lambda _: self.show_policy())

    def start_over(self) -> None:
        """Forget what was learned, and all tries."""
        self.rng = np.random.default_rng(LAB.SEED)
        self.fresh = np.random.default_rng(LAB.CUBES_SEED)
        self.mean = LAB.START
        self.std = LAB.SPREAD
        self.rounds = 0
        self.tries: list[tuple[day14_mujoco.Cube, bool]] = []
        self.show_policy()

    def lifted(self, thetas, cubes, noise) -> Array:
        """Return how high each policy lifts each cube, by the student's act, m."""
        T = [se3.make_T(se3.Rz(one.yaw), (one.x, one.y, 0.02)) for one in cubes]
        looks = [("observe", *some) for some in zip(T, noise, strict=True)]
        seen = self.own.many(*looks)
        acts = [("act", theta, one) for theta in thetas for one in seen]
        actions = self.own.many(*acts)
        both = zip(actions, list(cubes) * len(thetas), strict=True)
        heights = [
            day14_mujoco.lift(self.model, self.data, cube, np.asarray(action))
            for action, cube in both
        ]
        return np.reshape(heights, (len(thetas), len(cubes)))

    def learn_round(self) -> None:
        """Try POLICIES policies, and go on with the best of them, as in the lab."""
        noise = self.rng.normal(size=(LAB.POLICIES, 6))
        cubes = day14_mujoco.cubes(LAB.TRAINED_ON, self.rng, LAB.ROUGH)
        seen = LAB.NOISE * self.rng.normal(size=(LAB.TRAINED_ON, 3))
        heights = self.lifted(self.mean + self.std * noise, cubes, seen)
        worth = self.own.many(*[("reward", h, LAB.TARGET, LAB.CAP) for h in heights])
        scores = np.mean(worth, axis=1)
        step = (self.mean, self.std, noise, scores, LAB.ELITE)
        self.mean, self.std = self.own.cem_step(*step)
        self.rounds += 1

    def try_cubes(self) -> None:
        """Let the policy lift cubes of any friction that it has not seen."""
        cubes = day14_mujoco.cubes(TRIED, self.fresh, (0.2, 1.0))
        noise = LAB.NOISE * self.fresh.normal(size=(TRIED, 3))
        held = LAB.held(self.lifted(self.mean[None], cubes, noise)[0])
        self.tries += list(zip(cubes, map(bool, held), strict=True))
        self.rate = self.own.success_rate(np.array([good for _, good in self.tries]))

    def show_policy(self) -> None:
        """Show the six numbers and all dots."""
        theta = np.clip(self.mean, LAB.LOW, LAB.HIGH)
        self.bars.show(theta / FULL, np.minimum((theta + self.std) / FULL, 1.0))
        held = sum(good for _, good in self.tries)
        says = (
            f"generation {self.rounds}: grip force {LAB.squeezed(theta):.1f} N per pad"
        )
        if self.tries:
            rate, low, high = self.rate
            says += f"; held {held} of {len(self.tries)}, your success_rate: "
            says += f"{rate:.2f}, {low:.2f} to {high:.2f}"
        self.learned.content = words.line(says, "learned")
        self.image.image = self.dots(self.tries)

    def dots(self, tries) -> Array:
        """Return the picture of all tries and theta's line, of bytes, (h, w, 3)."""
        picture = np.full((*SIZE, 3), PAPER, np.uint8)
        newtons = LAB.squeezed(getattr(self, "mean", LAB.START))
        for mu in np.linspace(*FRICTION, 4 * SIZE[1]):
            stamp(picture, mu, 2000 * mu * newtons / LAB.G, BLACK, 0)
        for cube, good in tries:
            stamp(picture, cube.mu, 1000 * cube.mass, BLUE if good else RED, 2)
        return picture

    def lost(self) -> None:
        """Show no numbers, and no force of theirs."""
        self.text.content = ""
        self.plot.clear()
        self.cones.points = np.zeros((2 * ROUND_CONE, 2, 3), np.float32)


def stamp(picture: Array, mu: float, grams: float, colour, half: int) -> None:
    """Draw a square of pixels at a friction and a mass, if it is in the picture."""
    row = SIZE[0] * (1 - (grams - GRAMS[0]) / (GRAMS[1] - GRAMS[0]))
    column = SIZE[1] * (mu - FRICTION[0]) / (FRICTION[1] - FRICTION[0])
    if 0 <= row < SIZE[0] and 0 <= column < SIZE[1]:
        r, c = int(row), int(column)
        picture[max(r - half, 0) : r + half + 1, max(c - half, 0) : c + half + 1] = (
            colour
        )


def weight(lifted: Lifted) -> float:
    """Return with how many newtons per pad a cube can just be held still."""
    mu, grams, *_ = lifted.asked
    return grams / 1000 * LAB.G / 2 / mu


def late(times, least) -> float:
    """Return the least margin from when the pads are closed; NaN where none is."""
    after = [m for t, m in zip(times, least, strict=True) if t > day14_mujoco.CLOSED]
    return float(min(after, default=np.nan))


def boxed(middle: Array, half: Array) -> Array:
    """Return the twelve edges of a box that stands upright, (12, 2, 3)."""
    corners = middle + half * PLACES
    return np.array([[corners[i], corners[j]] for i, j in EDGES], np.float32)


def floor() -> Array:
    """Return lines on the floor, a square of 0.2 m, (10, 2, 3)."""
    ends = np.array([-0.1, 0.1])
    along = [np.column_stack([ends, [k, k], [0, 0]]) for k in np.linspace(-0.1, 0.1, 5)]
    return np.array(along + [one[:, [1, 0, 2]] for one in along], np.float32)


TABS = [Touch]
