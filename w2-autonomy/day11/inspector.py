"""Day 11 in the inspector: the tab Near.

A post is next to the arm, which is drawn as the lab's capsules. The student's own
functions compute the distance, the closest points and the gradient; the line and the
marks of the library are drawn next to theirs. `push` drives the pen at the post. A push
through the student's `velocity_damper` plays at once.
"""

from typing import NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import distance, panda, shapes
from robo47.checks import Array
from robo47.jacobian import dls_step, site_jacobian, space_jacobian

LAB = lab_of(find_day(11))  # its gain and margin
TOP = 0.9  # m, height of the post; it leans, so that no capsule is parallel to it
LEAN = 0.09  # m
FAST = 0.25  # m/s, of a push
SLOWED = "push with damper"
FULL = 0.8  # m/rad, where a bar ends


class Pair(NamedTuple):
    """The nearest capsule of the arm, its distance, closest points and gradient."""

    link: int
    far: float  # m
    points: Array  # on both axes: the arm's, the post's, (2, 3)
    slope: Array  # m/rad, (7,)


class Near(ui.Declared):
    """The distance of the arm from a post, and its gradient."""

    title = "Near"
    library = distance
    functions = {
        "capsule_distance": "m", "closest_points_segments": "m",
        "distance_gradient": "m/rad", "velocity_damper": "rad/s",
    }  # fmt: skip
    hz, plays = 20.0, 4.0

    x = ui.slider("post, x", 250, 700, 500.0, "mm", 5)
    y = ui.slider("post, y", -400, 400, 150.0, "mm", 5)
    radius = ui.slider("radius", 10, 100, 40.0, "mm", 5)
    how = ui.buttons("push", SLOWED, "stop", then="press")
    bars = ui.panel.bars(
        panda.ARM_JOINTS, FULL, "m/rad", "gradient of the distance (marks: library)"
    )
    post = ui.scene.lines(ui.NOWHERE, "orange", 2)
    capsules = ui.scene.lines(ui.NOWHERE, "grey", 1)
    theirs = ui.scene.lines(
        ui.NOWHERE, "green", 9, legend="the library's closest points"
    )
    line = ui.yours.lines(ui.NOWHERE, "red", 4, legend="yours")

    def prepare(self) -> None:
        """Load the arm's capsules."""
        self.arm = shapes.Shape(self.page.model)
        self.screws = panda.screws(self.page.model)
        self.begun = self.left = self.page.q  # where a push began, and left the arm

    def press(self) -> None:
        """Start or stop a push."""
        self.loop.stop()
        if self.how != "stop":
            self.loop.start(self.plays)

    def restart(self) -> None:
        """Push through the damper, from where the last push began."""
        if np.array_equal(self.page.q, self.left):
            self.page.move(self.begun)
        self.begun = self.page.q
        self.how = SLOWED

    def on_move(self, q: Array) -> None:
        """Draw arm and post, and ask, unless a push does that."""
        self.post.points = outline(*post_of(self))
        ends = zip(self.arm.ends(q[:7]), self.arm.radii, strict=True)
        self.capsules.points = np.vstack([outline(*some, r) for some, r in ends])
        if not self.loop.running:
            self.request()

    def ask(self, fns, at) -> Pair:
        """Return the nearest capsule, its closest points and the gradient."""
        b0, b1, r = post_of(at)
        ends = self.arm.ends(at.q[:7])
        far = fns.many(*(
            ("capsule_distance", *some, float(ra), b0, b1, r)
            for some, ra in zip(ends, self.arm.radii, strict=True)
        ))  # fmt: skip
        k = int(np.argmin(far))
        points = fns.closest_points_segments(*ends[k], b0, b1)
        link = int(self.arm.links[k])
        J = space_jacobian(self.screws, at.q[:7])
        slope = fns.distance_gradient(J, points[0], points[1], link)
        return Pair(link, float(far[k]), np.asarray(points), slope)

    def advance(self, seconds: float) -> None:
        """Move the arm towards the post for the time of one picture."""
        at = self.at()
        self.pairs = at, mine, _ = self.both(at)
        q = at.q.copy()
        tip = self.arm.ends(q[:7])[-1, 1]
        _, goal = distance.closest_points_segments(tip, tip, *post_of(at)[:2])
        J = site_jacobian(space_jacobian(self.screws, q[:7]), tip)[3:]
        way = goal - tip
        v = FAST * way / max(float(np.linalg.norm(way)), 0.02)
        qd = dls_step(J, v, LAB.DAMPING)
        if self.how == SLOWED:
            d = mine.far - LAB.MARGIN
            qd = self.own.velocity_damper(qd, mine.slope, d, LAB.GAIN)
        low, high = self.page.model.jnt_range[:7].T
        q[:7] = np.clip(q[:7] + qd / self.hz, low, high)
        self.next = q

    def frame(self, seconds: float) -> None:
        """Show where the arm is now."""
        self.answered(self.pairs)
        self.page.move(self.next)
        self.left = self.next

    def show(self, yours: Pair, right: Pair) -> None:
        """Show both lines and both gradients."""
        self.line.points, self.theirs.points = yours.points[None], right.points[None]
        self.bars.show(np.clip(yours.slope, -9.99, 9.99), right.slope)

    def says(self, yours: Pair, right: Pair):
        """Compare the distance and the gradient with the library's."""
        touch = "; the shapes overlap" if right.far < 0 else ""
        yield (
            f"Your distance is {1000 * yours.far:.1f} mm, at link {yours.link}; "
            f"the library's is {1000 * right.far:.1f} mm, at link {right.link}{touch}.",
            "capsule_distance",
        )
        wrong = self.kind_of("closest_points_segments distance_gradient") == "bad"
        yield (
            f"Your gradient {'differs from' if wrong else 'equals'} the library's.",
            "closest_points_segments distance_gradient",
        )


def post_of(at) -> tuple[Array, Array, float]:
    """Return the ends and the radius of the post, m."""
    foot = np.array([at.x, at.y, 0.0]) / 1000
    return foot, foot + np.array([0.0, LEAN, TOP]), at.radius / 1000


def outline(a: Array, b: Array, radius: float, n: int = 12) -> Array:
    """Return a capsule's outline as line segments, (m, 2, 3): sides, rings, caps."""
    way = b - a
    z = way / np.linalg.norm(way) if way.any() else np.eye(3)[2]
    x = np.cross(np.eye(3)[np.argmin(np.abs(z))], z)
    x = x / np.linalg.norm(x)
    y = np.cross(z, x)
    turn = np.linspace(0.0, 2 * np.pi, n + 1)[:, None]
    ring = radius * (np.cos(turn) * x + np.sin(turn) * y)
    made = [np.stack([a + ring[:-1], b + ring[:-1]], axis=1)]
    for end, out in ((a, -z), (b, z)):
        made.append(np.stack([end + ring[:-1], end + ring[1:]], axis=1))
        bow = np.linspace(0.0, np.pi, 9)[:, None]
        for side in (x, y):
            arc = end + radius * (np.cos(bow) * side + np.sin(bow) * out)
            made.append(np.stack([arc[:-1], arc[1:]], axis=1))
    return np.vstack(made)


TABS = [Near]
