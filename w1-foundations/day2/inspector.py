"""Day 2 in the inspector: the student's `fk_space` as a ghost, and the tab Screws.

The tab applies one exponential at a time, the last joint's first: e^[S] q moves all
that is outside its line, and the line itself has not moved yet. Beside it, the joint's
row of Franka's DH table and the file's pos and quat of the same link.
"""

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
COLOURS = ["red", "orange", "purple", "blue", "black"]


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
        self.S, _, self.links = _at_zero(page.model)
        self.done, self.share = 0.0, 1.0
        page.buttons([BACK, NEXT, PLAY, WHOLE], self.press)
        self.loop = page.animate(self.play)
        self.numbers, self.matrix, self.table = page.html(), page.html(), page.html()
        page.tick("DH roulette: five readings of one table", self.spin)
        self.legend = page.html()
        self.ghost = page.draw.ghost("purple")
        self.axes = [page.draw.arrows(self._ends(i), "grey") for i in range(JOINTS)]
        self.lit = page.draw.arrows(self._ends(0), "orange", 0.009)
        for i in range(JOINTS):
            page.draw.label(f"S{i + 1}", self._ends(i)[0, 1])
        points = np.zeros((len(FRANKA) + 1, 3))
        self.arms = [page.draw.curve(points, colour, 6.0) for colour in COLOURS]
        self.spin(False)
        page.light(END, {END})
        page.legend({
            "the arm, as far as it is applied": "purple", "the screw at work": "orange",
            "the others": "grey",
        })  # fmt: skip

    def _ends(self, i: int) -> Array:
        """Return a joint's line, from its link outwards along omega, (1, 2, 3)."""
        p = self.links[i, :3, 3]
        omega = self.S[i, :3]
        return np.array([[p - HALF * omega, p + HALF * omega]])

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

    def on_move(self, q: Array) -> None:
        """Show the arm with some exponentials applied, and the last one's numbers."""
        applied = np.clip(self.done - np.arange(JOINTS)[::-1], 0.0, 1.0)
        partly = q.copy()
        partly[:JOINTS] *= applied
        poses = kinematics.fk_all(self.page.model, partly)
        bodies = [name for name in poses if name.startswith("body:")]
        if self.roulette:  # five arms are enough
            bodies = []
        self.ghost.pose({name.removeprefix("body:"): poses[name] for name in bodies})
        i = JOINTS - max(int(np.ceil(self.done)), 1)
        self.lit.points = self._ends(i).astype(np.float32)
        angle = float(partly[i])
        step = screws.exp_screw(self.S[i], angle)
        self.numbers.content = words.line(
            f"S{i + 1} = ({_numbers(self.S[i, :3])}; {_numbers(self.S[i, 3:])}), "
            f"q{i + 1} = {angle:.4f} rad. e^[S{i + 1}] q{i + 1} moves everything "
            "outside its line.",
            "screw",
        )
        self.page.matrix(self.matrix, f"e^[S{i + 1}] q{i + 1}", step)
        self.table.content = self._row(i)
        self._roulette(q)
        self._say(poses)

    def _say(self, poses: dict[str, Array]) -> None:
        names = [f"e^[S{i}]" for i in range(JOINTS - int(self.done) + 1, JOINTS + 1)]
        product = " ".join([*names, "M"])
        frame = self.page.arm.names[END]
        gap = np.linalg.norm(poses[frame][:3, 3] - self.page.pose(END)[:3, 3])
        says = f"Applied: {product}. The hand is {1000 * gap:.0f} mm short of q."
        self.page.say(says, "good" if gap < 1e-6 else "")

    def _row(self, i: int) -> str:
        """Return Franka's row of a joint beside the file's link, as HTML."""
        alpha, a, d = FRANKA[i]
        body = self.page.model.body(f"link{i + 1}")
        in_the_file = se3.make_T(se3.quat_to_R(body.quat), body.pos)
        apart = np.abs(screws.dh_link(alpha, a, d, 0.0) - in_the_file).max()
        return words.line(
            f"Franka's row {i + 1}: alpha {np.degrees(alpha):.0f} deg, a {a:g} m, "
            f"d {d:g} m. The file's link{i + 1}: pos ({_numbers(body.pos)}), quat "
            f"({_numbers(body.quat)}). As poses they differ by {apart:.0e}.",
            "dh",
        )

    def spin(self, shown: bool) -> None:
        """Show the five readings of the table, or hide them."""
        self.roulette = shown
        for arm in self.arms:
            arm.visible = shown
        self.legend.content = ""
        self.on_move(self.page.q)

    def _roulette(self, q: Array) -> None:
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
        self.legend.content = "".join(lines)


def _numbers(values: Array) -> str:
    return ", ".join(f"{x:z.4g}" for x in np.round(values, 6))


TABS = [Screws]
