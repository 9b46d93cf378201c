"""Day 2 in the inspector: the student's `fk_space` as a ghost, and the tab Screws.

The tab applies one exponential at a time, the last joint's first: e^[S] q moves all
that is outside its line, and the line itself has not moved yet. The lines come from
the student's own `joint_screws`, the matrix is their `exp_screw`, the purple arm their
`fk_space`. Beside it, their `dh_link` of the joint's row in Franka's DH table, and the
file's pos and quat of the same link.
"""

from typing import NamedTuple

import mujoco
import numpy as np

from labkit.inspector import words
from labkit.inspector.arm import END
from labkit.inspector.draw import joined
from labkit.inspector.ghost import Ghost
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import kinematics, panda, screws, se3
from robo47.checks import Array

from .arms import FRANKA
from .roulette import READINGS, distances

JOINTS = 7
FRAMES = (*(f"link{i}" for i in range(1, JOINTS + 1)), END)
BACK = "back"
NEXT = "next"
PLAY = "play / stop"
WHOLE = "all seven"
HALF, SECONDS = 0.22, 1.2  # metres of a drawn axis to either side; time of one motion
COLOURS = ["red", "orange", "purple", "blue", "white"]
SAME = 1e-7  # of a screw or an entry: what one calls the same
ENTRY = "in one entry"
UNITS = dict.fromkeys(
    ("exp_screw", "joint_screws", "fk_space", "dh_link", "dh_fk"), ENTRY
)


class Part(NamedTuple):
    """What the student's functions make of the arm, with some exponentials applied."""

    S: Array  # their screws, (7, 6)
    step: Array  # their exponential of the one at work, (4, 4)
    poses: dict[str, Array]  # of the links and the end, by their fk_space
    angle: float  # of the joint at work, as far as it is applied
    row: Array  # their dh_link of the joint's row at 0, (4, 4)
    flange: Array  # their dh_fk, T_world_flange, (4, 4)


def _at_zero(model: mujoco.MjModel) -> tuple[Array, Array, Array]:
    """Return the screws, M, and the links' poses at q = 0."""
    poses = kinematics.fk_all(model, np.zeros(model.nq))
    links = np.array([poses[f"body:link{i}"] for i in range(1, JOINTS + 1)])
    return panda.screws(model), panda.home_pose(model), links


def ask_fk_space(model: mujoco.MjModel, q: Array) -> list[tuple]:
    """Return fk_space's arguments for each link and for the end effector."""
    S, M, links = _at_zero(model)
    shorter = [(S[: k + 1], links[k], q[: k + 1]) for k in range(JOINTS)]
    return [*shorter, (S, M, q[:JOINTS])]


GHOST = Ghost(
    "fk_space", FRAMES, ask_fk_space, whole=lambda model, q: ask_fk_space(model, q)[-1]
)


class Screws(Tab):
    """The arm from q = 0 to q, one exponential at a time."""

    title = "Screws"
    wide = True  # a matrix of its own, and the roulette
    camera = ((2.5, -2.1, 1.2), (0.6, 0.33, 0.6))

    def __init__(self, page: Page) -> None:
        """Draw the seven lines; start with no exponential applied."""
        super().__init__(page)
        self.truth, self.M, self.links = _at_zero(page.model)
        self.S = self.truth
        self.done = 0.0
        self.own = page.own(screws, units=UNITS)
        page.buttons([BACK, NEXT, PLAY, WHOLE], self.press)
        self.loop = page.animate(self.play)
        self.numbers, self.matrix, self.table = page.html(), page.html(), page.html()
        page.tick("DH roulette: five readings of one table", self.spin)
        self.legend = page.html()
        self.ghost = page.draw.ghost("purple")
        ends = np.concatenate([self._ends(i) for i in range(JOINTS)])
        page.draw.lines(ends, "white", 1.5)
        self.axes = page.draw.arrows(ends, "grey")
        self.wrong = page.draw.arrows(ends, "red", 0.008)
        self.lit = page.draw.arrows(self._ends(0), "orange", 0.009)
        for i in range(JOINTS):
            page.draw.label(f"S{i + 1}", self._ends(i)[0, 1])
        points = np.zeros((len(FRANKA) + 1, 3))
        self.arms = [page.draw.curve(points, colour, 6.0) for colour in COLOURS]
        self.flange = page.draw.sphere(np.zeros(3), 0.03, "purple")
        self.spin(False)
        page.light(END, {END})
        page.legend({
            "your arm, after these exponentials": "purple",
            "the present screw": "orange", "your other screws": "grey",
            "your screws, wrong": "red", "the library's screws": "white",
        })  # fmt: skip

    def _ends(self, i: int) -> Array:
        """Return a screw's line, next to its link outwards along omega, (1, 2, 3)."""
        omega = self.S[i, :3]
        v = self.S[i, 3:]
        square = max(float(omega @ omega), SAME)
        p = np.cross(omega, v) / square  # the line's point nearest to the world
        p = p + omega * (omega @ (self.links[i, :3, 3] - p)) / square
        return np.array([[p - HALF * omega, p + HALF * omega]])

    def begin(self) -> None:
        """Play all seven."""
        self.loop.stop()
        self.loop.start()

    def press(self, name: str) -> None:
        """Apply one more exponential, take one back, or play them all."""
        if name == PLAY:
            self.loop.toggle()
            return
        self.loop.stop()
        on = np.floor(self.done) + 1
        back = np.ceil(self.done) - 1
        self.go({NEXT: on, BACK: back, WHOLE: JOINTS}[name])

    def play(self, seconds: float) -> bool:
        """Go on smoothly; return whether there is more."""
        self.go(seconds / SECONDS)
        return self.done < JOINTS

    def go(self, done: float) -> None:
        """Show a number of exponentials applied, counted from the last joint."""
        self.done = float(np.clip(done, 0.0, JOINTS))
        self.on_move(self.page.q)

    @property
    def at_work(self) -> int:
        """Which screw is being applied, from 0."""
        return JOINTS - max(int(np.ceil(self.done)), 1)

    def on_move(self, q: Array) -> None:
        """Ask for the arm with some exponentials applied, and for the last one."""
        done, i = self.done, self.at_work
        self.page.job(lambda: (q, done, self.ask(q, i, done)), self.answered)

    def ask(self, q: Array, i: int, done: float) -> Part:
        """Return what the student's functions make of it; it waits for them."""
        partly = q[:JOINTS] * np.clip(done - np.arange(JOINTS)[::-1], 0.0, 1.0)
        angle = float(partly[i])
        alpha, a, d = map(float, FRANKA[i])
        S, row, flange = self.own.many(
            ("joint_screws", self.links),
            ("dh_link", alpha, a, d, 0.0),
            ("dh_fk", FRANKA, q[:JOINTS]),
        )
        step, *poses = self.own.many(
            ("exp_screw", S[i], angle),
            *(
                ("fk_space", S[: k + 1], self.links[k], partly[: k + 1])
                for k in range(JOINTS)
            ),
            ("fk_space", S, self.M, partly),
        )
        named = dict(zip(FRAMES, poses, strict=True))
        return Part(S, step, named, angle, row, flange)

    def answered(self, asked: tuple[Array, float, Part]) -> None:
        """Show what came out."""
        q, done, part = asked
        self.S = part.S
        i = JOINTS - max(int(np.ceil(done)), 1)
        links = {name: T for name, T in part.poses.items() if name != END}
        self.ghost.pose({} if self.roulette else links)  # five arms are enough
        self._draw(i)
        self.numbers.content = words.line(
            f"S{i + 1} = ({_numbers(self.S[i, :3])}; {_numbers(self.S[i, 3:])}), "
            f"q{i + 1} = {part.angle:.4f} rad. e^[S{i + 1}] q{i + 1} moves everything "
            "distal to its axis.",
            "screw",
            "" if np.abs(self.S[i] - self.truth[i]).max() < SAME else "bad",
        )
        self.page.matrix(self.matrix, f"e^[S{i + 1}] q{i + 1}", part.step)
        self.table.content = self._row(i, part.row)
        self._roulette(q, part.flange)
        self._say(done, part.poses[END])

    def _draw(self, i: int) -> None:
        """Draw the student's screws, those that are wrong in red."""
        ends = np.concatenate([self._ends(k) for k in range(JOINTS)])
        off = np.abs(self.S - self.truth).max(axis=1) > SAME
        for drawn, some in ((self.axes, ~off), (self.wrong, off)):
            drawn.visible = bool(some.any())
            if some.any():
                drawn.points = ends[some].astype(np.float32)
        self.lit.points = ends[i : i + 1].astype(np.float32)

    def _say(self, done: float, hand: Array) -> None:
        names = [f"e^[S{i}]" for i in range(JOINTS - int(done) + 1, JOINTS + 1)]
        product = " ".join([*names, "M"])
        gap = np.linalg.norm(hand[:3, 3] - self.page.pose(END)[:3, 3])
        says = (
            f"Applied: {product}. Your hand is {1000 * gap:.0f} mm from its pose at q."
        )
        late = done == JOINTS and gap > 1e-6
        self.page.say(says, "good" if gap < 1e-6 else "bad" if late else "")

    def _row(self, i: int, row: Array) -> str:
        """Return Franka's row of a joint beside the file's link, as HTML."""
        alpha, a, d = FRANKA[i]
        body = self.page.model.body(f"link{i + 1}")
        in_the_file = se3.make_T(se3.quat_to_R(body.quat), body.pos)
        apart = np.abs(row - in_the_file).max()
        return words.line(
            f"Franka's row {i + 1}: alpha {np.degrees(alpha):.0f} deg, a {a:g} m, "
            f"d {d:g} m. The file's link{i + 1}: pos ({_numbers(body.pos)}), quat "
            f"({_numbers(body.quat)}). Your dh_link's pose differs by "
            f"{apart:.0e}.",
            "dh",
            "" if apart < SAME else "bad",
        )

    def lost(self) -> None:
        """Show no screws and no arm."""
        for drawn in (self.axes, self.wrong, self.lit, self.flange):
            drawn.visible = False
        self.ghost.pose({})
        for html in (self.numbers, self.matrix, self.table, self.legend):
            html.content = ""
        self.page.say("")

    def spin(self, shown: bool) -> None:
        """Show the five readings of the table, or hide them."""
        self.roulette = shown
        for arm in self.arms:
            arm.visible = shown
        self.legend.content = ""
        self.on_move(self.page.q)

    def _roulette(self, q: Array, flange: Array) -> None:
        self.lit.visible = True
        self.flange.visible = self.roulette
        if not self.roulette:
            return
        far = distances(FRANKA, q[None, :JOINTS])
        lines = []
        for arm, colour, name in zip(self.arms, COLOURS, READINGS, strict=True):
            p = READINGS[name](FRANKA, q[:JOINTS])[:, :3, 3]
            p = np.concatenate([p, np.repeat(p[-1:], len(FRANKA) + 1 - len(p), axis=0)])
            arm.points = joined(p)
            says = f"{colour}: {1000 * far[name][0]:.0f} mm, {name}"
            lines.append(words.line(says, f"reading-{colour}"))
        *_, right = READINGS.values()
        p = right(FRANKA, q[:JOINTS])[-1, :3, 3]
        self.flange.position = flange[:3, 3]
        off = float(np.linalg.norm(flange[:3, 3] - p))
        says = f"your dh_fk, the sphere: {1000 * off:.0f} mm"
        lines.append(words.line(says, "dh_fk", "good" if off < SAME else "bad"))
        self.legend.content = "".join(lines)


def _numbers(values: Array) -> str:
    return ", ".join(f"{x:z.4g}" for x in np.round(values, 6))


TABS = [Screws]
