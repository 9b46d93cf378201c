"""Day 3 in the inspector: the tab Jacobian; the tab Circle is in `circle.py`.

The columns of the student's own J stand as arrows at the hand, the library's as thin
lines; a column that differs is red. A target can be dragged, and the student's own
`solve_ik` puts a second arm there; a slider swings the elbow by their own
`nullspace_projection`.
"""

import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector import words
from labkit.inspector.arm import END
from robo47 import jacobian, panda, screws, se3
from robo47.checks import Array

from .circle import Circle

JOINTS = 7
NEAR_SINGULAR = 0.05  # the smallest singular value that is shown in red below
COLUMN, BALL = 0.35, 0.2  # metres drawn for 1 m/s per rad/s
SAME, SHORT = 1e-7, 0.01  # of a column; metres of an arrow that is not drawn
REACHED = 1e-3  # radians and metres together
RATE = "(rad/s or m/s per rad/s)"
PART, MOST = 20, 0.25  # steps of the elbow; radians that its slider goes at once


class Jacobian(ui.Declared):
    """The velocity of the hand for each joint, and a target for the hand."""

    title = "Jacobian"
    camera = ((1.5, -1.3, 0.95), (0.5, 0.22, 0.5))
    library = jacobian
    functions = {
        "space_jacobian": RATE, "site_jacobian": RATE, "manipulability": "",
        "nullspace_projection": "rad/s", "solve_ik": "rad",
    }  # fmt: skip
    free = ("solve_ik",)

    elbow = ui.slider("swing the elbow", -2.0, 2.0, 0.0, then="swing")
    dragged = ui.tick("drag a target", then="drag")
    numbers = ui.panel.html()
    bars = ui.panel.bars(
        [f"sigma {i}" for i in range(1, JOINTS)], 2.5, "",
        "singular values of J_site (rad/s and m/s per rad/s)", "scale",
    )  # fmt: skip
    columns = ui.yours.arrows(ui.NOWHERE, "purple", legend="column of J: v of the hand")
    wrong = ui.yours.arrows(ui.NOWHERE, "red", 0.008, legend="your column, wrong")
    truth = ui.scene.lines(ui.NOWHERE, "white", 1.5, legend="the library's column")
    names = ui.scene.labels([f"J{i + 1}" for i in range(JOINTS)])
    ball = ui.yours.ellipsoid(
        "grey", 0.25, legend="velocities for joint velocities of norm 1"
    )
    ghost = ui.yours.ghost("orange", legend="your solve_ik")
    target = ui.handle("follow")

    def prepare(self) -> None:
        model = self.page.model
        self.S, self.M = panda.screws(model), panda.home_pose(model)
        self.limits = model.jnt_range[:JOINTS]
        self.going = self.page.jobs_apart()  # to the target
        self.swinging = self.page.jobs_apart()
        self.swung = 0.0  # where the slider was
        self.target.handle.visible = False

    def on_move(self, q: Array) -> None:
        self.request()
        if self.dragged:
            self.follow(self.target.T)

    def ask(self, fns, at) -> tuple[Array, Array, float]:
        """Return the hand's position, J_site, and the manipulability."""
        q = at.q[:JOINTS]
        p = screws.fk_space(self.S, self.M, q)[:3, 3]
        J = fns.site_jacobian(fns.space_jacobian(self.S, q), p)
        return p, J, float(fns.manipulability(J))

    def show(self, yours, right) -> None:
        (p, J, _), (_, truth, _) = yours, right
        off = np.abs(J - truth).max(axis=0) > SAME
        arrows, self.truth.points = _arrows(p, J), _arrows(p, truth)
        long = np.linalg.norm(arrows[:, 1] - p, axis=1) > SHORT
        for drawn, some in ((self.columns, long & ~off), (self.wrong, long & off)):
            drawn.visible = bool(some.any())
            drawn.points = arrows[some] if some.any() else ui.NOWHERE
        self.names.show(arrows[:, 1] + 0.03 * (arrows[:, 1] - arrows[:, 0]))
        self.ball.show(J[3:] @ J[3:].T, p, BALL)
        sigma, best = (np.linalg.svd(x, compute_uv=False) for x in (J, truth))
        self.bars.show(sigma, best)

    def says(self, yours, right):
        _, J, w = yours
        least = np.linalg.svd(J, compute_uv=False)[-1]
        near = "; the arm is near a singularity" if least < NEAR_SINGULAR else ""
        yield (
            f"Smallest singular value {least:.3f}; manipulability {w:.3f}{near}.",
            "space_jacobian site_jacobian manipulability",
        )

    def drag(self) -> None:
        """Show the target where the hand is, or hide it."""
        self.target.place(self.page.pose(END))
        self.target.handle.visible = self.dragged
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
        metres, rad = se3.pose_distance(screws.fk_space(self.S, self.M, q), T_goal)
        out = bool(np.any((q < self.limits[:, 0]) | (q > self.limits[:, 1])))
        kind = "good" if np.hypot(metres, rad) < REACHED and not out else "bad"
        says = f"The hand is {1000 * metres:.2f} mm and {rad:.4f} rad from the target"
        says += "; a joint is beyond its limit." if out else "."
        self.numbers.content = words.line(says, "reached", kind)

    def swing(self) -> None:
        """Swing the elbow by the slider's motion; the hand should stay."""
        q, value = self.page.q, self.elbow
        self.swinging.want(lambda: self.swings(q, value), self.moved)

    def swings(self, q: Array, value: float) -> tuple[Array, float]:
        """Return the configuration after some null steps, and the hand's way in mm."""
        by = float(np.clip(value - self.swung, -MOST, MOST))
        self.swung = value
        before = screws.fk_space(self.S, self.M, q[:JOINTS])[:3, 3]
        for _ in range(PART):
            p = screws.fk_space(self.S, self.M, q[:JOINTS])[:3, 3]
            J = jacobian.site_jacobian(jacobian.space_jacobian(self.S, q[:JOINTS]), p)
            along = self.own.nullspace_projection(J, np.eye(JOINTS)[2])
            size = np.linalg.norm(along)
            if size > 1e-6:
                q[:JOINTS] += by / PART * along / size
        after = screws.fk_space(self.S, self.M, q[:JOINTS])[:3, 3]
        return q, 1000 * float(np.linalg.norm(after - before))

    def moved(self, found: tuple[Array, float]) -> None:
        """Move the arm, and say what the hand did meanwhile."""
        q, mm = found
        kind = "good" if mm < 2.0 else "bad"
        says = f"The elbow swings and the hand has moved by {mm:.2f} mm."
        self.numbers.content = words.line(says, "swung", kind)
        self.page.move(q)


def _arrows(p: Array, J: Array) -> Array:
    """Return the columns' velocities as arrows at p, (7, 2, 3)."""
    ends = p + COLUMN * J[3:].T
    return np.stack([np.broadcast_to(p, ends.shape), ends], axis=1)


TABS = [Jacobian, Circle]
