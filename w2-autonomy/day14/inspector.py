"""Day 14 in the inspector: the tab Touch.

Two fingers lift a cube, with a constant opening and with the student's
`grip_reflex_step`. Their `cone_edges` and `cone_margin` compute the cones and the
smallest margin over time. Below, their `act`, `reward` and `cem_step` learn a policy,
generation by generation, and the cubes that it holds appear over friction and mass.
"""

from functools import cache, partial
from typing import NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector import words
from labkit.inspector.canvas import Canvas
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import grasp, panda, policy, se3
from robo47.checks import Array

import day14_mujoco

LAB = lab_of(find_day(14))  # its seeds, its start, what is held
TRIED = 20
ENTRY = "in one entry"
EDGES = 12  # of a cone that is drawn
LONG = 0.008  # m of an arrow, for 1 N
SLOWER = 3.0  # times slower than real time
SHOWN = ("with your grip_reflex_step", "with a constant opening")
FULL = np.maximum(np.abs(LAB.LOW), np.abs(LAB.HIGH))
NORMALS = np.array([[0, -1.0, 0], [0, 1.0, 0]])  # of the pads, into the cube
DOWNWARDS = np.diag([-1.0, 1.0, -1.0])  # the hand's axes in the world
_, Y, Z = np.eye(3)
PAD, FINGER = (0.0055, 0.0445), 0.0584  # m: a pad on its finger, a finger on the hand

bare = cache(partial(panda.load, "panda"))
dressed = partial(panda.load, "panda", meshes=True)


class Moment(NamedTuple):
    """The state of an episode 10 ms long."""

    t: float  # s
    cube: Array  # T_world_cube, (4, 4)
    pads: Array  # m, (2, 3), of their middles
    felt: day14_mujoco.Felt


class Lifted(NamedTuple):
    """An episode, and the results of the student's functions for it."""

    moments: list[Moment]
    margins: list[float]  # the smallest of each moment with a contact, N
    truth: list[float]  # by the library
    height: float  # m, at the end
    newtons: float  # per pad, at the end

    @property
    def held(self) -> bool:
        """Whether the cube is in the air at the end."""
        return bool(LAB.HELD < self.height <= LAB.CAP)

    def says(self) -> str:
        """Return how it ended."""
        said = "held" if self.held else "not held"
        grip = f"grip force {self.newtons:.1f} N per pad"
        return f"the cube is {said}, at {1000 * self.height:z.0f} mm ({grip})."

    def felt(self) -> list[Moment]:
        """Return the moments in which the pads touch the cube."""
        return [one for one in self.moments if len(one.felt.mu)]


class Seen(NamedTuple):
    """Both episodes of a cube, and the cones."""

    runs: dict[str, Lifted]  # by SHOWN
    edges: Array  # of both cones, (2 * EDGES, 3)


class Touch(ui.Declared):
    """What fingers feel, and what a policy of six numbers has learned."""

    title = "Touch"
    library = {**vars(grasp), **vars(policy)}
    functions = {
        "cone_margin": "N", "cone_edges": "", "grip_reflex_step": "m", "observe": ENTRY,
        "act": ENTRY, "reward": "", "cem_step": ENTRY, "success_rate": "",
    }  # fmt: skip
    camera = ((0.62, -0.26, 0.27), (0.0, 0.12, 0.04))

    mu = ui.slider("friction", 0.1, 1, 0.3, "", 0.05)
    grams = ui.slider("mass", 20, 300, 220.0, "g", 10)
    squeeze = ui.slider("grip force", 0.5, 8, 3.0, "N", 0.5)
    run = ui.choice("the fingers close", SHOWN)
    does = ui.buttons(
        "lift again", "one generation", "test 20 cubes", "start over", then="press"
    )
    plot = ui.panel.plot(
        ["the library", "yours, with your reflex", "yours, constant opening"],
        y="smallest margin, N", height=150, below=1,
    )  # fmt: skip
    bars = ui.panel.bars(
        [name.partition(",")[0] for name in LAB.NUMBERS], np.ones(6), "",
        "policy, relative to its limits (marks: one standard deviation more)", "both",
    )  # fmt: skip
    learned = ui.panel.html()
    image = ui.panel.image(np.zeros((240, 360, 3)), "the tested cubes")
    key = ui.panel.key({"held": "blue", "dropped": "red", "limit": "white"})
    hand = ui.panel.robot(bare, dressed)
    box = ui.scene.box(np.full(3, day14_mujoco.HALF), "orange", 0.75, legend="the cube")
    cones = ui.yours.lines(ui.NOWHERE, "green", 2, legend="your friction cone")
    arrows = ui.scene.arrows(ui.NOWHERE, "red", 0.0015, legend="force on the cube")

    def prepare(self) -> None:
        self.model, self.data = day14_mujoco.hand()
        self.learning = self.page.jobs_apart()
        self.start_over()

    # One cube

    def ask(self, fns, at) -> Seen:
        def reflex(opening: float, felt: day14_mujoco.Felt) -> float:
            if not len(felt.mu):
                return opening
            return float(fns.grip_reflex_step(opening, *felt[1:], LAB.SHARE, LAB.CLOSE))

        some = zip(SHOWN, (reflex, None), strict=True)
        runs = {name: self.lifted_one(fns, at, touch) for name, touch in some}
        cones = [("cone_edges", normal, at.mu, EDGES) for normal in NORMALS]
        return Seen(runs, np.vstack(fns.many(*cones)))

    def lifted_one(self, fns, at, touch) -> Lifted:
        """Return an episode, and what the functions compute for each moment."""
        cube = day14_mujoco.Cube(0.0, 0.0, 0.0, at.grams / 1000, at.mu)
        opening = day14_mujoco.HALF - at.squeeze / day14_mujoco.SPRING
        action = np.array([0, 0, 0, 0.02, opening, 0.1])
        moments, last = [], opening
        for told in day14_mujoco.episode(self.model, self.data, cube, action, touch):
            moments.append(self.moment())
            last = told
        felt = [one.felt for one in moments if len(one.felt.mu)]
        asked = [(one.force, one.normal, one.mu) for one in felt]
        yours = fns.many(*(("cone_margin", *given) for given in asked))
        return Lifted(
            moments,
            [float(np.min(one)) for one in yours],
            [float(np.min(grasp.cone_margin(*given))) for given in asked],
            day14_mujoco.height(self.data),
            day14_mujoco.SPRING * (day14_mujoco.HALF - last),
        )

    def moment(self) -> Moment:
        """Return the state of the simulation now."""
        pads = [self.data.geom(name).xpos.copy() for name in ("left", "right")]
        body = self.data.body("cube")
        T = se3.make_T(body.xmat.reshape(3, 3), body.xpos)
        felt = day14_mujoco.felt(self.model, self.data)
        return Moment(self.data.time, T, np.array(pads), felt)

    def show(self, yours: Seen, right: Seen) -> None:
        self.seen = yours
        best = right.runs[SHOWN[0]]
        curves = [(best.felt(), best.truth)]
        curves += [(one.felt(), one.margins) for one in yours.runs.values()]
        at = sorted({one.t for felt, _ in curves for one in felt})
        ys = [
            np.interp(at, [one.t for one in felt], m, np.nan, np.nan)
            if felt else np.full(len(at), np.nan)
            for felt, m in curves
        ]  # fmt: skip
        if at:
            self.plot.show(at, ys)
        self.frame(SLOWER * (day14_mujoco.CLOSED + 0.03))
        self.loop.stop()
        if not self.emptied:
            self.loop.start()

    def begin(self) -> None:
        """Lift again once the answers are there; `show` plays them."""

    def frame(self, seconds: float) -> bool:
        moments = self.seen.runs[self.run].moments
        i = min(int(seconds / SLOWER / 0.01), len(moments) - 1)
        now = moments[i]
        middle = se3.make_T(DOWNWARDS, now.pads.mean(axis=0) + (PAD[1] + FINGER) * Z)
        turned = (DOWNWARDS, DOWNWARDS @ se3.Rz(np.pi))
        fingers = [
            se3.make_T(R, pad - side * PAD[0] * Y + PAD[1] * Z)
            for R, pad, side in zip(turned, now.pads, (1, -1), strict=True)
        ]
        self.hand.pose(
            {"hand": middle, "left_finger": fingers[0], "right_finger": fingers[1]}
        )
        self.box.position = now.cube[:3, 3]
        self.box.wxyz = se3.R_to_quat(now.cube[:3, :3])
        self.draw_forces(now)
        return i < len(moments) - 1

    def draw_forces(self, now: Moment) -> None:
        """Draw each pad's force on the cube, and the student's cone of that size."""
        arrows, cones = np.zeros((2, 2, 3)), np.zeros((2, EDGES, 2, 3))
        for k, side in enumerate((1, -1)):
            some = side * (now.felt.points[:, 1] - now.cube[1, 3]) > 0
            if not some.any():  # it has left that pad
                continue
            at = now.felt.points[some].mean(axis=0)
            force = now.felt.force[some].sum(axis=0)
            arrows[k] = at, at + LONG * force
            press = max(-side * force[1], 0.0)
            cones[k, :, 0] = at
            edges = self.seen.edges[k * EDGES : (k + 1) * EDGES]
            cones[k, :, 1] = at + LONG * press * edges
        self.arrows.points, self.cones.points = arrows, cones.reshape(-1, 2, 3)

    def says(self, yours: Seen, right: Seen):
        reflex, constant = (yours.runs[name] for name in SHOWN)
        yield f"With a constant opening {constant.says()}", None
        yield f"With your grip_reflex_step {reflex.says()}", "grip_reflex_step"
        needs = self.grams / 1000 * LAB.G / 2 / self.mu
        yield f"To hold the cube at rest, a pad needs {needs:.1f} N.", None
        one = yours.runs[self.run]
        late = [k for k, m in enumerate(one.felt()) if m.t > day14_mujoco.CLOSED]
        mine, best = (
            min((some[k] for k in late), default=np.nan)
            for some in (one.margins, one.truth)
        )
        says = f"Your smallest margin with closed pads is {mine:z.2f} N; "
        yield f"{says}by the library {best:z.2f} N.", "cone_margin"

    # Six numbers

    def press(self) -> None:
        """Lift again, learn one generation, test some cubes, or start over."""
        if self.does == "lift again":
            self.request()
        elif self.does == "start over":
            self.start_over()
        else:
            once = self.does == "one generation"
            work = self.learn_round if once else self.try_cubes
            self.learning.want(work, lambda _: self.show_policy())

    def start_over(self) -> None:
        """Forget the policy and all tests."""
        self.rng = np.random.default_rng(LAB.SEED)
        self.fresh = np.random.default_rng(LAB.CUBES_SEED)
        self.mean, self.std, self.rounds = LAB.START, LAB.SPREAD, 0
        self.tries: list[tuple[day14_mujoco.Cube, bool]] = []
        self.rate = np.zeros(3)
        self.show_policy()

    def lifted(self, thetas, cubes, noise) -> Array:
        """Return how high each policy lifts each cube, by the student's act, m."""
        T = [se3.make_T(se3.Rz(one.yaw), (one.x, one.y, 0.02)) for one in cubes]
        looks = [("observe", *some) for some in zip(T, noise, strict=True)]
        seen = self.own.many(*looks)
        actions = self.own.many(*(("act", th, one) for th in thetas for one in seen))
        model, data = day14_mujoco.hand()  # its own: a cube may be lifted meanwhile
        both = zip(actions, list(cubes) * len(thetas), strict=True)
        heights = [
            day14_mujoco.lift(model, data, cube, np.asarray(action))
            for action, cube in both
        ]
        return np.reshape(heights, (len(thetas), len(cubes)))

    def learn_round(self) -> None:
        """Try POLICIES policies, and go on with the best of them, as in the lab."""
        noise = self.rng.normal(size=(LAB.POLICIES, 6))
        cubes = day14_mujoco.cubes(LAB.TRAINED_ON, self.rng, LAB.ROUGH)
        seen = LAB.NOISE * self.rng.normal(size=(LAB.TRAINED_ON, 3))
        heights = self.lifted(self.mean + self.std * noise, cubes, seen)
        worth = self.own.many(*(("reward", h, LAB.TARGET, LAB.CAP) for h in heights))
        step = (self.mean, self.std, noise, np.mean(worth, axis=1), LAB.ELITE)
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
        """Show the six numbers and the tested cubes."""
        theta = np.clip(self.mean, LAB.LOW, LAB.HIGH)
        self.bars.show(theta / FULL, np.minimum((theta + self.std) / FULL, 1.0))
        grip = f"grip force {LAB.squeezed(theta):.1f} N per pad"
        says = f"Generation {self.rounds}: {grip}."
        if self.tries:
            held, (rate, low, high) = sum(good for _, good in self.tries), self.rate
            says += f" It holds {held} of {len(self.tries)} cubes; your success_rate "
            says += f"is {rate:.2f}, between {low:z.2f} and {high:z.2f}."
        self.learned.content = words.line(says, "learned")
        self.image.image = self.tested()

    def tested(self) -> Array:
        """Return the picture of all tests, and which cubes the grip force can hold."""
        canvas = Canvas((-0.02, -55), (1.03, 310), (720, 480))
        for mu in (0.2, 0.4, 0.6, 0.8, 1.0):
            canvas.line([(mu, 0), (mu, 300)], (60, 66, 74), 1)
            canvas.words(f"{mu}", (mu, -14), "grey", "mm", 20)
        for grams in (0, 100, 200, 300):
            canvas.line([(0.1, grams), (1.0, grams)], (60, 66, 74), 1)
            canvas.words(f"{grams} g", (0.085, grams), "grey", "rm", 20)
        canvas.words("friction", (0.55, -38), "grey", "mm", 20)
        mu = np.linspace(0.1, 1.0, 50)
        most = 2000 * mu * LAB.squeezed(self.mean) / LAB.G
        inside = most <= 300
        canvas.line(np.column_stack([mu, most])[inside], "white", 3)
        for cube, good in self.tries:
            at = [(cube.mu, 1000 * cube.mass)]
            canvas.dots(at, "blue" if good else "red", 7)
        return canvas.picture()


TABS = [Touch]
