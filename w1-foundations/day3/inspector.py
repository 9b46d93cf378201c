"""Day 3 in the inspector: the tab Jacobian; the tab Circle is in `circle.py`.

The columns of the student's own J stand as arrows at the hand, the library's as thin
lines; a column that differs is red. A target can be dragged, and the student's own
`solve_ik` puts a second arm there; a slider swings the elbow by their own
`nullspace_projection`.
"""

import numpy as np

from labkit.inspector import words
from labkit.inspector.arm import END
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import jacobian, panda, screws, se3
from robo47.checks import Array

from .circle import Circle

JOINTS = 7
NEAR_SINGULAR = 0.05  # the smallest singular value that is shown in red below
COLUMN, BALL = 0.35, 0.2  # metres drawn for 1 m/s per rad/s
SAME, SHORT = 1e-7, 0.01  # of a column; metres of an arrow that is not drawn
REACHED = 1e-3  # radians and metres together
UNITS = {
    **dict.fromkeys(("space_jacobian", "site_jacobian"), "(rad/s or m/s per rad/s)"),
    "nullspace_projection": "rad/s",
}
PART, MOST = 20, 0.25  # steps of the elbow; radians that its slider goes at once


class Jacobian(Tab):
    """The velocity of the hand for each joint, and a target for the hand."""

    title = "Jacobian"
    wide = True
    camera = ((1.5, -1.3, 0.95), (0.5, 0.22, 0.5))

    def __init__(self, page: Page) -> None:
        """Draw the columns at the hand and a target where the hand is."""
        super().__init__(page)
        self.S, self.M = panda.screws(page.model), panda.home_pose(page.model)
        self.limits = page.model.jnt_range[:JOINTS]
        self.own = page.own(jacobian, free=("solve_ik",), units=UNITS)
        self.going = page.jobs_apart()  # to the target
        self.elbow = page.slider("swing the elbow", -2.0, 2.0, 0.0, self.swing)
        self.at = 0.0  # where the slider was
        page.tick("drag a target", self.drag)
        self.numbers = page.html()
        names = [f"sigma {i}" for i in range(1, JOINTS)]
        title = "singular values of J_site (rad/s and m/s per rad/s)"
        self.bars = page.bars(names, 2.5, "", title, "scale")
        self.least = page.html()
        zeros = np.zeros((JOINTS, 2, 3))
        self.truth = page.draw.lines(zeros, "white", 1.5)
        self.columns = page.draw.arrows(zeros, "purple")
        self.wrong = page.draw.arrows(zeros, "red", 0.008)
        self.library = zeros
        self.names = page.draw.labels([f"J{i + 1}" for i in range(JOINTS)])
        self.ball = page.draw.ellipsoid("grey", 0.25)
        self.ghost = page.draw.ghost("orange")
        self.target = page.draw.target(page.pose(END), self.follow)
        self.target.handle.visible = self.shown = False
        page.light(END, {END})
        page.legend({
            "column of J: v of the hand": "purple", "your column, wrong": "red",
            "the library's column": "white",
            "velocities for joint velocities of norm 1": "grey",
            "your solve_ik": "orange",
        })  # fmt: skip

    def on_move(self, q: Array) -> None:
        """Ask for the columns in the configuration, and go to the target."""
        self.page.job(lambda: self.ask(q[:JOINTS]), self.show)
        if self.shown:
            self.follow(self.target.T)

    def ask(self, q: Array) -> tuple[Array, Array, Array, float]:
        """Return the hand's place, the student's J_site, the library's, and w."""
        p = screws.fk_space(self.S, self.M, q)[:3, 3]
        J = self.own.site_jacobian(self.own.space_jacobian(self.S, q), p)
        return p, J, self.J_site(q), float(self.own.manipulability(J))

    def J_site(self, q: Array) -> Array:
        """Return the library's J_site of the hand's origin, (6, 7)."""
        p = screws.fk_space(self.S, self.M, q)[:3, 3]
        return jacobian.site_jacobian(jacobian.space_jacobian(self.S, q), p)

    def show(self, found: tuple[Array, Array, Array, float]) -> None:
        """Show columns, ellipsoid and singular values."""
        p, J, right, w = found
        off = np.abs(J - right).max(axis=0) > SAME
        arrows = _arrows(p, J)
        long = np.linalg.norm(arrows[:, 1] - p, axis=1) > SHORT
        for drawn, some in ((self.columns, long & ~off), (self.wrong, long & off)):
            drawn.visible = bool(some.any())
            if some.any():
                drawn.points = arrows[some]
        self.library = _arrows(p, right)
        self.truth.points = self.library
        self.names.show(_beyond(arrows))
        self.ball.show(J[3:] @ J[3:].T, p, BALL)
        sigma = np.linalg.svd(J, compute_uv=False)
        self.bars.show(sigma, np.linalg.svd(right, compute_uv=False))
        says = f"smallest singular value {sigma[-1]:.3f}; manipulability {w:.3f}"
        kind = "bad" if sigma[-1] < NEAR_SINGULAR else ""
        if off.any() or abs(w - jacobian.manipulability(J)) > SAME:
            says, kind = f"your J or manipulability is wrong: {says}", "bad"
        self.least.content = words.line(says, "sigma", kind)

    def lost(self) -> None:
        """Show no columns but the library's, and no second arm."""
        self.names.show(_beyond(self.library))
        self.columns.visible = self.wrong.visible = self.ball.ball.visible = False
        self.bars.clear()
        self.least.content = self.numbers.content = ""
        self.ghost.pose({})

    def drag(self, shown: bool) -> None:
        """Show the target where the hand is, or hide it."""
        self.target.place(self.page.pose(END))
        self.target.handle.visible = self.shown = shown
        self.ghost.pose({})
        self.numbers.content = ""

    def follow(self, T_goal: Array) -> None:
        """Have the student's own solve_ik take the second arm to the target."""
        q0 = np.clip(self.page.q[:JOINTS], *self.limits.T)
        self.going.want(
            lambda: self.own.solve_ik(self.S, self.M, T_goal, q0, self.limits),
            lambda q: self.stand(q, T_goal),
        )

    def stand(self, q: Array, T_goal: Array) -> None:
        """Draw the second arm at q, (7,), and say how far its hand is off."""
        self.ghost.pose(self.page.links(q))
        hand = screws.fk_space(self.S, self.M, q)
        metres, rad = se3.pose_distance(hand, T_goal)
        out = bool(np.any((q < self.limits[:, 0]) | (q > self.limits[:, 1])))
        kind = "good" if np.hypot(metres, rad) < REACHED and not out else "bad"
        says = f"the hand is {1000 * metres:.2f} mm and {rad:.4f} rad from the target"
        says += "; a joint is beyond its limit" if out else ""
        self.numbers.content = words.line(says, "reached", kind)

    def swing(self, value: float) -> None:
        """Swing the elbow by what the slider has moved; the hand should stay."""
        self.page.job(lambda: self.swung(self.page.q, value), self.moved)

    def swung(self, q: Array, value: float) -> tuple[Array, float]:
        """Return the configuration after some null steps, and the hand's way in mm."""
        by = float(np.clip(value - self.at, -MOST, MOST))
        self.at = value
        before = screws.fk_space(self.S, self.M, q[:JOINTS])[:3, 3]
        for _ in range(PART):
            along = self.own.nullspace_projection(
                self.J_site(q[:JOINTS]), np.eye(JOINTS)[2]
            )
            size = np.linalg.norm(along)
            if size > 1e-6:
                q[:JOINTS] += by / PART * along / size
        after = screws.fk_space(self.S, self.M, q[:JOINTS])[:3, 3]
        return q, 1000 * float(np.linalg.norm(after - before))

    def moved(self, found: tuple[Array, float]) -> None:
        """Move the arm, and say what the hand did meanwhile."""
        q, mm = found
        kind = "good" if mm < 2.0 else "bad"
        says = f"the elbow swings and the hand has moved by {mm:.2f} mm"
        self.numbers.content = words.line(says, "swung", kind)
        self.page.move(q)


def _arrows(p: Array, J: Array) -> Array:
    """Return the columns' velocities as arrows at p, (7, 2, 3)."""
    ends = p + COLUMN * J[3:].T
    return np.stack([np.broadcast_to(p, ends.shape), ends], axis=1).astype(np.float32)


def _beyond(arrows: Array) -> Array:
    """Return where their names stand, (7, 3)."""
    return arrows[:, 1] + 0.03 * (arrows[:, 1] - arrows[:, 0])


TABS = [Jacobian, Circle]
