"""Day 2 in the inspector: the student's `fk_space` as a ghost, and the tab Screws.

The tab applies one exponential at a time, the last joint's first: e^[S] q moves all
that is outside its line, and the line itself has not moved yet. The lines come from
the student's own `joint_screws`, the matrix is their `exp_screw`, the purple arm their
`fk_space`. Beside it, their `dh_link` of the joint's row in Franka's DH table, and the
file's pos and quat of the same link.
"""

from typing import Any, NamedTuple

import mujoco
import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector.arm import END
from labkit.inspector.draw import joined
from labkit.inspector.ghost import Ghost
from robo47 import kinematics, panda, screws, se3
from robo47.checks import Array

from .arms import FRANKA
from .roulette import READINGS, distances

JOINTS = 7
FRAMES = (*(f"link{i}" for i in range(1, JOINTS + 1)), END)
BACK, NEXT, PLAY, WHOLE = "back", "next", "play / stop", "all seven"
HALF, SECONDS = 0.22, 1.2  # metres of a drawn axis to either side; time of one motion
COLOURS = ["red", "orange", "purple", "blue", "white"]
SAME = 1e-7  # of a screw or an entry: what one calls the same
ENTRY = "in one entry"


class Part(NamedTuple):
    """What the functions make of the arm, with some exponentials applied."""

    at: Any  # what was asked: q, `done` exponentials, the screw `i` at work
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


class Screws(ui.Declared):
    """The arm from q = 0 to q, one exponential at a time."""

    title = "Screws"
    camera = ((2.5, -2.1, 1.2), (0.6, 0.33, 0.6))
    library = screws
    functions = dict.fromkeys(
        ("exp_screw", "joint_screws", "fk_space", "dh_link", "dh_fk"), ENTRY
    )

    roulette = ui.tick("DH roulette: five readings of one table", then="spin")
    does = ui.buttons(BACK, NEXT, PLAY, WHOLE, then="press")
    matrix = ui.panel.html()
    arm = ui.yours.ghost("purple", legend="your arm, after these exponentials")
    lit = ui.yours.arrows(ui.NOWHERE, "orange", 0.009, legend="the present screw")
    axes = ui.yours.arrows(ui.NOWHERE, "grey", legend="your other screws")
    wrong = ui.yours.arrows(ui.NOWHERE, "red", 0.008, legend="your screws, wrong")
    right_axes = ui.scene.lines(ui.NOWHERE, "white", 1.5, legend="the library's screws")
    flange = ui.yours.sphere(np.zeros(3), 0.03, "purple")

    def prepare(self) -> None:
        self.truth, self.M, self.links = _at_zero(self.page.model)
        self.done = 0.0  # exponentials applied, counted from the last joint
        ends = np.concatenate([self.ends(S, i) for i, S in enumerate(self.truth)])
        self.right_axes.points = ends
        for i, (end, _) in enumerate(ends):
            self.page.draw.label(f"S{i + 1}", end)
        points = np.zeros((len(FRANKA) + 1, 3))
        self.arms = [self.page.draw.curve(points, colour, 6.0) for colour in COLOURS]
        self.show_readings()

    def ends(self, S: Array, i: int) -> Array:
        """Return a screw's line, next to its link outwards along omega, (1, 2, 3)."""
        omega, v = S[:3], S[3:]
        square = max(float(omega @ omega), SAME)
        p = np.cross(omega, v) / square  # the line's point nearest to the world
        p = p + omega * (omega @ (self.links[i, :3, 3] - p)) / square
        return np.array([[p - HALF * omega, p + HALF * omega]])

    def press(self) -> None:
        """Apply one more exponential, take one back, or play them all."""
        if self.does == PLAY:
            self.loop.toggle()
            return
        self.loop.stop()
        on, back = np.floor(self.done) + 1, np.ceil(self.done) - 1
        self.go({NEXT: on, BACK: back, WHOLE: JOINTS}[self.does])

    def begin(self) -> None:
        self.loop.stop()
        self.loop.start()

    def frame(self, seconds: float) -> bool:
        self.go(seconds / SECONDS)
        return self.done < JOINTS

    def go(self, done: float) -> None:
        """Show a number of exponentials applied, counted from the last joint."""
        self.done = float(np.clip(done, 0.0, JOINTS))
        self.request()

    def at(self):
        found = super().at()
        found.done = self.done
        found.i = JOINTS - max(int(np.ceil(self.done)), 1)  # the screw at work
        return found

    def ask(self, fns, at) -> Part:
        q, i = at.q[:JOINTS], at.i
        partly = q * np.clip(at.done - np.arange(JOINTS)[::-1], 0.0, 1.0)
        angle = float(partly[i])
        alpha, a, d = map(float, FRANKA[i])
        S, row, flange = fns.many(
            ("joint_screws", self.links),
            ("dh_link", alpha, a, d, 0.0),
            ("dh_fk", FRANKA, q),
        )
        shorter = (
            ("fk_space", S[: k + 1], self.links[k], partly[: k + 1])
            for k in range(JOINTS)
        )
        step, *poses = fns.many(
            ("exp_screw", S[i], angle), *shorter, ("fk_space", S, self.M, partly)
        )
        named = dict(zip(FRAMES, poses, strict=True))
        return Part(at, S, step, named, angle, row, flange)

    def show(self, yours: Part, right: Part) -> None:
        links = {name: T for name, T in yours.poses.items() if name != END}
        self.arm.pose({} if self.roulette else links)  # five arms are enough
        ends = np.concatenate([self.ends(S, k) for k, S in enumerate(yours.S)])
        off = np.abs(yours.S - self.truth).max(axis=1) > SAME
        for drawn, some in ((self.axes, ~off), (self.wrong, off)):
            drawn.visible = bool(some.any())
            drawn.points = ends[some] if some.any() else ui.NOWHERE
        i = yours.at.i
        self.lit.points = ends[i : i + 1]
        self.page.matrix(self.matrix, f"e^[S{i + 1}] q{i + 1}", yours.step)
        self.flange.position = yours.flange[:3, 3]
        self.show_readings()

    def says(self, yours: Part, right: Part):
        i, done = yours.at.i, yours.at.done
        S = f"S{i + 1} = ({_numbers(yours.S[i, :3])}; {_numbers(yours.S[i, 3:])})"
        moves = f"e^[S{i + 1}] q{i + 1} moves everything distal to its axis."
        yield f"{S}, q{i + 1} = {yours.angle:.4f} rad. {moves}", "joint_screws"
        names = [f"e^[S{k}]" for k in range(JOINTS - int(done) + 1, JOINTS + 1)]
        gap = np.linalg.norm(yours.poses[END][:3, 3] - self.page.pose(END)[:3, 3])
        yield (
            f"Applied: {' '.join([*names, 'M'])}. Your hand is {1000 * gap:.0f} mm "
            "from its pose at q.",
            "exp_screw fk_space" if done == JOINTS else None,
        )
        alpha, a, d = FRANKA[i]
        body = self.page.model.body(f"link{i + 1}")
        pose = se3.make_T(se3.quat_to_R(body.quat), body.pos)
        yield (
            f"Franka's row {i + 1}: alpha {np.degrees(alpha):.0f} deg, a {a:g} m, d "
            f"{d:g} m. The file's link{i + 1}: pos ({_numbers(body.pos)}), quat "
            f"({_numbers(body.quat)}). Your dh_link's pose differs by "
            f"{np.abs(yours.row - pose).max():.0e}.",
            "dh_link",
        )
        if self.roulette:
            yield from self.readings(yours, right)

    def readings(self, yours: Part, right: Part):
        """Say how far the flange is by five readings of the table, and by dh_fk."""
        far = distances(FRANKA, yours.at.q[None, :JOINTS])
        for colour, name in zip(COLOURS, READINGS, strict=True):
            yield f"{colour}: {1000 * far[name][0]:.0f} mm, {name}", None
        off = float(np.linalg.norm((yours.flange - right.flange)[:3, 3]))
        yield f"your dh_fk, the sphere: {1000 * off:.0f} mm", "dh_fk"

    def spin(self) -> None:
        """Show the five readings of the table, or hide them."""
        self.request()

    def show_readings(self) -> None:
        """Draw the arm by each reading of the table, where they are shown."""
        self.flange.visible = self.roulette and not self.emptied
        q = self.page.q[:JOINTS]
        for arm, name in zip(self.arms, READINGS, strict=True):
            arm.visible = self.roulette
            p = READINGS[name](FRANKA, q)[:, :3, 3]
            last = np.repeat(p[-1:], len(FRANKA) + 1 - len(p), axis=0)
            arm.points = joined(np.concatenate([p, last]))


def _numbers(values: Array) -> str:
    return ", ".join(f"{x:z.4g}" for x in np.round(values, 6))


TABS = [Screws]
