"""Day 11 in the inspector: the tab Near.

A post is next to the arm, which is drawn as the lab's capsules. The student's own
functions compute the distance, the closest points and the gradient; the line and the
marks of the library are drawn next to theirs. `push` drives the pen at the post. A push
through the student's `velocity_damper` plays at once.
"""

from typing import NamedTuple

import numpy as np

from labkit.inspector import words
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import distance, panda, shapes
from robo47.checks import Array
from robo47.jacobian import dls_step, site_jacobian, space_jacobian

LAB = lab_of(find_day(11))  # its gain and margin
TOP = 0.9  # m, height of the post; it leans, so that no capsule is parallel to it
LEAN = 0.09  # m
FAST = 0.25  # m/s, of a push
HZ = 20.0
LASTS = 4.0  # s
FULL = 0.8  # m/rad, where a bar ends
PUSH, SLOWED, STOP = "push", "push with damper", "stop"
JOINTS = [f"joint{i}" for i in range(1, 8)]
UNITS = {"capsule_distance": "m", "closest_points_segments": "m",
         "distance_gradient": "m/rad",
         "velocity_damper": "rad/s"}  # fmt: skip
SMALL = 1e-5  # m and m/rad, a difference that is not visible on a screen


class Pair(NamedTuple):
    """The nearest capsule of the arm, its distance, closest points and gradient."""

    link: int
    far: float  # m
    points: Array  # on both axes: the arm's, the post's, (2, 3)
    slope: Array  # m/rad, (7,)


class Near(Tab):
    """The distance of the arm from a post, and its gradient."""

    title = "Near"
    wide = True

    def __init__(self, page: Page) -> None:
        """Draw arm and post, and compute the distance for the first time."""
        super().__init__(page)
        self.arm = shapes.Shape(page.model)
        self.screws = panda.screws(page.model)
        self.x = 500.0
        self.y = 150.0
        self.radius = 40.0
        self.how = STOP
        self.begun = page.q
        self.left = page.q  # where a push left the arm
        self.own = page.own(distance, units=UNITS)
        page.slider("post, x", 250, 700, self.x, self.sets("x"), unit="mm", step=5)
        page.slider("post, y", -400, 400, self.y, self.sets("y"), unit="mm", step=5)
        page.slider("radius", 10, 100, self.radius, self.sets("radius"), unit="mm",
                    step=5)  # fmt: skip
        page.buttons([PUSH, SLOWED, STOP], self.press)
        self.text = page.html()
        title = "gradient of the distance (marks: library)"
        self.bars = page.bars(JOINTS, FULL, "m/rad", title, "both")
        self.post = page.draw.lines(outline(*self.stands()), "orange", 2)
        self.capsules = page.draw.lines(np.zeros((1, 2, 3)), "grey", 1)
        self.right = page.draw.lines(np.zeros((1, 2, 3)), "green", 9)
        self.line = page.draw.lines(np.zeros((1, 2, 3)), "red", 4)
        page.legend({"yours: closest points": "red", "the library's": "green"})
        self.loop = page.animate(self.shown, HZ, work=self.step)
        self.went = self.look(page.q[:7])
        self.on_move(page.q)

    def begin(self) -> None:
        """Push by the student's `velocity_damper`, from where the last push began."""
        self.press(STOP)
        if np.array_equal(self.page.q, self.left):
            self.page.move(self.begun)
        self.begun = self.page.q
        self.press(SLOWED)

    def stands(self) -> tuple[Array, Array, float]:
        """Return the ends and the radius of the post, m."""
        at = np.array([self.x, self.y, 0.0]) / 1000
        return at, at + np.array([0.0, LEAN, TOP]), self.radius / 1000

    def on_move(self, q: Array) -> None:
        """Compute again: arm, post or file may have changed."""
        self.post.points = outline(*self.stands())
        self.draw_arm(q)
        if not self.loop.running:
            post = self.stands()
            self.page.job(lambda: (q, post, self.ask(q[:7], post)), self.answered)

    def draw_arm(self, q: Array) -> None:
        """Draw the arm's capsules where they are."""
        ends = self.arm.ends(q[:7])
        made = zip(ends, self.arm.radii, strict=True)
        self.capsules.points = np.vstack([outline(*some, r) for some, r in made])

    def answered(self, asked: tuple[Array, tuple, Pair]) -> None:
        """Show the result, unless arm or post has moved meanwhile."""
        q, post, pair = asked
        now = (*map(tuple, post[:2]), post[2])
        here = (*map(tuple, self.stands()[:2]), self.stands()[2])
        if now == here and np.array_equal(q, self.page.q):
            self.show(pair, self.look(q[:7]))

    def look(self, q: Array) -> Pair:
        """Return the nearest pair by the library."""
        b0, b1, r = self.stands()
        ends = self.arm.ends(q)
        far = [
            distance.capsule_distance(*some, ra, b0, b1, r)
            for some, ra in zip(ends, self.arm.radii, strict=True)
        ]
        k = int(np.argmin(far))
        p, o = distance.closest_points_segments(*ends[k], b0, b1)
        link = int(self.arm.links[k])
        J = space_jacobian(self.screws, q)
        slope = distance.distance_gradient(J, p, o, link)
        return Pair(link, far[k], np.stack([p, o]), slope)

    def ask(self, q: Array, post: tuple[Array, Array, float]) -> Pair:
        """Return the nearest pair by the student's functions."""
        b0, b1, r = post
        ends = self.arm.ends(q)
        radii = map(float, self.arm.radii)
        far = self.own.many(*(
            ("capsule_distance", *some, ra, b0, b1, r)
            for some, ra in zip(ends, radii, strict=True)
        ))  # fmt: skip
        k = int(np.argmin(far))
        points = self.own.closest_points_segments(*ends[k], b0, b1)
        link = int(self.arm.links[k])
        J = space_jacobian(self.screws, q)
        slope = self.own.distance_gradient(J, points[0], points[1], link)
        return Pair(link, float(far[k]), points, slope)

    def press(self, name: str) -> None:
        """Push, push with damper, or stop."""
        self.how = name
        self.loop.stop()
        if name != STOP:
            self.loop.start()

    def step(self, seconds: float) -> None:
        """Move the arm by one frame; wait for the student's functions."""
        q = self.page.q.copy()
        self.went = self.ask(q[:7], self.stands())
        b0, b1, _ = self.stands()
        tip = self.arm.ends(q[:7])[-1, 1]
        _, goal = distance.closest_points_segments(tip, tip, b0, b1)
        J = site_jacobian(space_jacobian(self.screws, q[:7]), tip)[3:]
        way = goal - tip
        v = FAST * way / max(float(np.linalg.norm(way)), 0.02)
        qd = dls_step(J, v, LAB.DAMPING)
        if self.how == SLOWED:
            d = self.went.far - LAB.MARGIN
            qd = self.own.velocity_damper(qd, self.went.slope, d, LAB.GAIN)
        low, high = self.page.model.jnt_range[:7].T
        q[:7] = np.clip(q[:7] + qd / HZ, low, high)
        self.next = q

    def shown(self, seconds: float) -> bool:
        """Show where the arm is now; end after a while."""
        q = self.page.q
        self.show(self.went, self.look(q[:7]))
        self.page.move(self.next)
        self.left = self.next
        return seconds < LASTS

    def show(self, yours: Pair, right: Pair) -> None:
        """Show both lines, both gradients, and whether yours equal the library's."""
        self.line.points = yours.points[None].astype(np.float32)
        self.right.points = right.points[None].astype(np.float32)
        self.bars.show(np.clip(yours.slope, -9.99, 9.99), right.slope)
        apart = abs(yours.far - right.far) < SMALL
        alike = bool(np.all(np.abs(yours.slope - right.slope) < SMALL))
        ours = f"library {1000 * right.far:.1f} mm, link {right.link}"
        mine = f"yours {1000 * yours.far:.1f} mm, link {yours.link}"
        touch = "; the shapes overlap" if right.far < 0 else ""
        self.text.content = "".join(
            words.line(text, key, kind)
            for text, key, kind in (
                (f"{mine}; {ours}{touch}", "far", "good" if apart else "bad"),
                (f"your gradient {'equals' if alike else 'differs from'} the library's",
                 "slope", "good" if alike else "bad"),
            )
        )  # fmt: skip

    def lost(self) -> None:
        """Show no numbers, and no line between points but the library's."""
        right = self.look(self.page.q[:7])
        self.right.points = right.points[None].astype(np.float32)
        self.text.content = ""
        self.bars.clear()
        self.line.points = np.zeros((1, 2, 3), np.float32)


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
    return np.vstack(made).astype(np.float32)


TABS = [Near]
