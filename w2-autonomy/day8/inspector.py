"""Day 8 in the inspector: the tab Weigh.

A sphere is fixed to the hand of the lab's unknown robot, and the arm is held from both
sides. The tab shows the payload that the student's own functions identify, with its
sigma, above the library's result. The blue sphere is at the student's centre of mass.
"""

from typing import NamedTuple

import numpy as np

from labkit.inspector import words
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import identification, panda
from robo47.checks import Array

import day8_mujoco

LAB = lab_of(find_day(8))  # its robot, poses, wait and tolerance
HERE, FIVE, FORGET = "hold here", "five poses", "forget"
UNITS = {"identify_payload": "(kg or kg m)", "predict_with_sigma": "(kg or kg m)"}
NO_MASS = 1e-9  # kg; a smaller mass has no centre


class Found(NamedTuple):
    """The payload that one comparison of holds gives."""

    load: Array  # m and m c, kg and kg m, (4,)
    sigma: Array  # of each, (4,)
    rank: int  # of the regressor, at most 4

    def centre(self) -> Array:
        """Return the centre of mass in the hand frame, m, (3,); NaN without a mass."""
        m = self.load[0] if abs(self.load[0]) > NO_MASS else np.nan
        return self.load[1:] / m

    def says(self) -> str:
        """Return it in words."""
        grams, sigma = 1000 * self.load[0], 1000 * self.sigma[0]
        centre = ", ".join(f"{1000 * x:z.1f}" for x in self.centre())
        m = max(abs(self.load[0]), NO_MASS)
        return (
            f"{grams:.1f} g, sigma {sigma:.1f} g; centre {centre} mm, "
            f"sigma {1000 * self.sigma[1:].max() / m:.1f} mm"
        )


class Weighed(NamedTuple):
    """The student's results and the library's, by the sides that are compared."""

    own: dict[str, Found]
    library: dict[str, Found]


class Weigh(Tab):
    """A payload, its estimate and the standard deviation."""

    title = "Weigh"
    wide = True

    def __init__(self, page: Page) -> None:
        """Draw the load; nothing is held yet."""
        super().__init__(page)
        model = panda.load("panda_nohand", drive="torque")
        self.arm = panda.arm(model)
        self.empty = day8_mujoco.changed(model, LAB.ROBOT_SEED)
        self.mass = LAB.LOAD
        self.com = LAB.AT.copy()
        self.held: list[Array] = []  # q, torque with and without, from either side
        self.centre: Array | None = None
        self.own = page.own(identification, units=UNITS)
        self.holding = page.jobs_apart()  # so that an estimate does not drop a hold
        grams = round(1000 * self.mass)
        page.slider("mass of the load", 50, 2000, grams, self.hang, unit="g", step=50)
        below = round(1000 * self.com[2])
        page.slider(
            "distance below the hand", 0, 200, below, self.lower, unit="mm", step=5
        )
        page.buttons([HERE, FIVE, FORGET], self.press)
        self.table = page.html()
        self.ball = page.draw.sphere(np.zeros(3), day8_mujoco.RADIUS, "orange", 0.5)
        self.found = page.draw.sphere(np.zeros(3), day8_mujoco.RADIUS / 2, "blue")
        page.light("ee", {"ee"})
        self.weigh()

    def hang(self, grams: float) -> None:
        """Change the load; all holds of the old one are dropped."""
        self.mass = grams / 1000.0
        self.press(FORGET)

    def lower(self, mm: float) -> None:
        """Move the load down or up."""
        self.com[2] = mm / 1000.0
        self.press(FORGET)

    def press(self, name: str) -> None:
        """Hold the arm where it is, or in the lab's five poses; or forget all holds."""
        poses = [self.page.q[:7]] if name == HERE else []
        if name == FIVE:
            poses = list(LAB.POSES)
        if name != HERE:  # the same holds twice would look like more data
            self.held = []
        before, mass, com = self.held, self.mass, self.com.copy()
        if not poses:
            self.weigh()
            return

        def keep(made: list[Array]) -> None:
            if self.held is before:  # nothing has been forgotten meanwhile
                self.held = [*before, *made]
            self.weigh()

        self.holding.want(lambda: self.hold(poses, mass, com), keep)

    def hold(self, poses: list[Array], mass: float, com: Array) -> list[Array]:
        """Return the holds of a load, see `ask`; this takes some tenths of a second."""
        edit = day8_mujoco.load(mass, com)
        hung = panda.load("panda_nohand", drive="torque", edit=edit)
        full = day8_mujoco.changed(hung, LAB.ROBOT_SEED)
        made = []
        for pose in poses:
            _, empty = day8_mujoco.holds(self.empty, self.arm, [pose], LAB.WAIT)
            held = day8_mujoco.holds(full, self.arm, [pose], LAB.WAIT)
            made.append(np.array([*held, empty]))
        return made

    def begin(self) -> None:
        """Hold the arm where it is, unless it was held before."""
        if not self.held:
            self.press(HERE)

    def on_move(self, q: Array) -> None:
        """Move both spheres with the hand; estimate again, as the file may differ."""
        self.place()
        self.weigh()

    def weigh(self) -> None:
        """Estimate the load from the holds, or show that there are none."""
        held = self.held
        if held:
            self.page.job(lambda: (held, self.ask(held)), self.answered)
        else:
            self.lost()
            self.table.content = words.line("No pose was held yet.", "weighed")

    def answered(self, asked: tuple[list[Array], Weighed]) -> None:
        """Show the estimate, unless its holds have been dropped in the meantime."""
        held, weighed = asked
        if held is self.held:
            self.show(weighed)

    def ask(self, held: list[Array]) -> Weighed:
        """Return the student's estimates from these holds, and the library's.

        A hold is q (rad), torque with the load and without (N m), (3, 2, 1, 7).
        """
        q, full, empty = np.concatenate(held, axis=2)  # (side, pose, joint) each
        ways = {
            "from one side": (q[0], full[0] - empty[0]),
            "one from either side": (q[1], full[1] - empty[0]),
            "both, averaged": (q.mean(axis=0), (full - empty).mean(axis=0)),
        }
        calls = [call for way in ways.values() for call in self.calls(*way)]
        own = self.own.many(*calls)
        library = [getattr(identification, name)(*given) for name, *given in calls]
        return Weighed(by_way(ways, own), by_way(ways, library))

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

    def show(self, weighed: Weighed) -> None:
        """Show the student's estimates above the library's, and draw the sphere."""
        *_, last = weighed.own.values()
        hidden = " (not the centre along gravity)" if last.rank < 4 else ""
        text = [
            f"Poses held: {len(self.held)}. {last.rank} of 4 parameters are "
            f"identifiable{hidden}. True mass: {1000 * self.mass:.0f} g."
        ]
        for name, found in weighed.own.items():
            text.append(f"{name}: {found.says()}")
            text.append(f"the library's: {weighed.library[name].says()}")
        kinds = ["", *["", "quiet"] * len(weighed.own)]
        self.table.content = "".join(
            words.line(line, "weighed" if k else "shown", kind)
            for k, (line, kind) in enumerate(zip(text, kinds, strict=True))
        )
        centre = last.centre()
        self.centre = centre if np.isfinite(centre).all() else None
        self.place()

    def place(self) -> None:
        """Draw both spheres at the hand's present pose."""
        T = self.arm.at(self.page.q[:7]).T_world_ee
        self.ball.position = T[:3, 3] + T[:3, :3] @ self.com
        self.found.visible = self.centre is not None
        if self.centre is not None:
            self.found.position = T[:3, 3] + T[:3, :3] @ self.centre

    def lost(self) -> None:
        """Show no numbers and no blue sphere."""
        self.table.content = ""
        self.centre = None
        self.place()


def by_way(ways: dict[str, tuple[Array, Array]], answers: list) -> dict[str, Found]:
    """Return the estimate of each comparison, from the three results of `calls`."""
    found = {}
    for k, name in enumerate(ways):
        load, (_, sigma), (rank, _) = answers[3 * k : 3 * k + 3]
        found[name] = Found(np.asarray(load), np.asarray(sigma), int(rank))
    return found


TABS = [Weigh]
