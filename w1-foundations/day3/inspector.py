"""Day 3 in the inspector: the tab Jacobian; the tab Circle is in `circle.py`.

The columns of J_site stand as arrows at the hand, the manipulability ellipsoid around
it, and the singular values as bars: the smallest turns red near a singularity. A target
can be dragged, and the arm follows by inverse kinematics; a slider swings the elbow
while the hand stands still.
"""

import numpy as np

from labkit.base.exchange import Reply
from labkit.inspector import words
from labkit.inspector.arm import END
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47 import jacobian, panda, screws, verify
from robo47.checks import Array

from .circle import Circle

JOINTS = 7
NEAR_SINGULAR = 0.05  # the smallest singular value that is shown in red below
COLUMN, BALL = 0.35, 0.2  # metres drawn for 1 m/s per rad/s
STEPS, CORRECTIONS = 8, 3  # damped steps per drag; corrections per move of the elbow
DAMPING, MOST = 0.02, 0.25  # of a step; radians that the elbow's slider goes at once


class Jacobian(Tab):
    """Where every joint takes the hand, and where the hand cannot go."""

    title = "Jacobian"
    wide = True

    def __init__(self, page: Page) -> None:
        """Draw the columns at the hand and a target where the hand is."""
        super().__init__(page)
        self.S, self.M = panda.screws(page.model), panda.home_pose(page.model)
        self.limits = page.model.jnt_range[:JOINTS]
        self.elbow = page.slider("elbow", -2.0, 2.0, 0.0, self.swing)
        self.at = 0.0  # where the slider was
        self.bars = page.bars(
            [f"sigma {i}" for i in range(1, 7)], 2.0, "", "singular values of J_site"
        )
        self.least, self.numbers, self.own = page.html(), page.html(), page.html()
        zeros = np.zeros((JOINTS, 2, 3))
        self.columns = page.draw.arrows(zeros, "orange")
        self.names = [page.draw.label(f"J{i + 1}", np.zeros(3)) for i in range(JOINTS)]
        self.ball = page.draw.ellipsoid("purple")
        page.tick("drag a target", self.drag)
        self.target = page.draw.target(page.pose(END), self.follow)
        self.target.handle.visible = False
        page.light(END, {END})
        self.on_move(page.q)

    def J_site(self, q: Array) -> Array:
        """Return the library's J_site of the hand's origin, (6, 7)."""
        p = screws.fk_space(self.S, self.M, q)[:3, 3]
        return jacobian.site_jacobian(jacobian.space_jacobian(self.S, q), p)

    def on_move(self, q: Array) -> None:
        """Show columns, ellipsoid and singular values of the configuration."""
        q = q[:JOINTS]
        T, J = screws.fk_space(self.S, self.M, q), self.J_site(q)
        p = T[:3, 3]
        ends = p + COLUMN * J[3:].T
        self.columns.points = np.stack(
            [np.broadcast_to(p, ends.shape), ends], axis=1
        ).astype(np.float32)
        for label, end in zip(self.names, ends, strict=True):
            label.position = end
        self.ball.show(J[3:] @ J[3:].T, p, BALL)
        sigma = np.linalg.svd(J, compute_uv=False)
        self.bars.show(sigma)
        kind = "bad" if sigma[-1] < NEAR_SINGULAR else "good"
        w = jacobian.manipulability(J)
        says = f"smallest singular value {sigma[-1]:.4f}; manipulability {w:.4f}"
        self.least.content = words.line(says, "sigma", kind)
        self._compare(q, J)

    def _compare(self, q: Array, J: Array) -> None:
        """Say how J q_dot compares with MuJoCo's, and ask for the student's."""
        whole = self.page.q
        whole[:JOINTS] = q
        if self.page.model.nq == JOINTS:
            off = np.abs(J - verify.mujoco_site_jacobian(self.page.model, whole)).max()
            says = f"robo47.jacobian differs from mj_jacSite by {off:.1e}"
            self.numbers.content = words.line(says, "mujoco")
        self.page.ask("space_jacobian", (self.S, q.copy()), self._students)

    def _students(self, reply: Reply) -> None:
        """Say how the student's space_jacobian compares with the library's."""
        value = reply.value
        if (
            reply.kind
            or not isinstance(value, np.ndarray)
            or value.shape != (6, JOINTS)
        ):
            says, kind = "YOUR space_jacobian: nothing to show yet", "quiet"
        else:
            right = jacobian.space_jacobian(self.S, self.page.q[:JOINTS])
            off = float(np.abs(value - right).max())
            says = f"YOUR space_jacobian differs from the library's by {off:.1e}"
            kind = "good" if off < 1e-8 else "bad"
        self.own.content = words.line(says, "own", kind)

    def drag(self, shown: bool) -> None:
        """Show the target where the hand is, or hide it."""
        self.target.place(self.page.pose(END))
        self.target.handle.visible = shown

    def follow(self, T_goal: Array) -> None:
        """Take some damped steps towards the target, within the limits."""
        q = self.page.q
        for _ in range(STEPS):
            q[:JOINTS] = self._corrected(q[:JOINTS], T_goal)
        left = jacobian.pose_error(screws.fk_space(self.S, self.M, q[:JOINTS]), T_goal)
        mm, rad = 1000 * np.linalg.norm(left[3:]), np.linalg.norm(left[:3])
        self.page.say(f"{mm:.1f} mm and {rad:.3f} rad short of the target")
        self.page.move(q)

    def swing(self, value: float) -> None:
        """Swing the elbow by what the slider has moved; the hand stays."""
        by, self.at = float(np.clip(value - self.at, -MOST, MOST)), value
        q = self.page.q
        T = screws.fk_space(self.S, self.M, q[:JOINTS])
        for _ in range(10):
            along = jacobian.null_step(self.J_site(q[:JOINTS]), np.eye(JOINTS)[2])
            size = np.linalg.norm(along)
            if size > 1e-6:
                q[:JOINTS] += 0.1 * by * along / size
        for _ in range(CORRECTIONS):
            q[:JOINTS] = self._corrected(q[:JOINTS], T)
        left = jacobian.pose_error(screws.fk_space(self.S, self.M, q[:JOINTS]), T)
        self.page.say(f"the hand has moved by {1000 * np.linalg.norm(left[3:]):.3f} mm")
        self.page.move(q)

    def _corrected(self, q: Array, T_goal: Array) -> Array:
        e = jacobian.pose_error(screws.fk_space(self.S, self.M, q), T_goal)
        damping = float(np.sqrt(e @ e / 2) + DAMPING * min(1.0, np.linalg.norm(e)))
        step = jacobian.dls_step(self.J_site(q), e, max(damping, 1e-6))
        return np.clip(q + step, *self.limits.T)


TABS = [Jacobian, Circle]
