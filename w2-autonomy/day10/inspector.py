"""Day 10 in the inspector: the tab Eye.

The lab's camera points at the cube. Its depth image shows MuJoCo's corners as white
squares and the student's projected corners in red. Below it is the error of the pose
that the student's own functions estimate from noisy pixels; the scene shows that pose
in blue.
"""

from typing import NamedTuple

import mujoco
import numpy as np

from labkit.inspector import words
from labkit.inspector.instruments import as_bytes
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import camera, depth_camera, scenes, se3
from robo47.checks import Array
from robo47.screws import skew

import day10_mujoco

LAB = lab_of(find_day(10))  # its noise and seeds
UNITS = {
    **dict.fromkeys(("camera_matrix", "project"), "px"), "back_project": "m",
    **dict.fromkeys(("apply_twist", "refine_pose"), "in one entry"),
    "projection_jacobian": "(px per rad or m)", "pose_covariance": "(rad2 or m2)",
}  # fmt: skip
GUESS = np.array([0.1, -0.08, 0.05, 0.02, -0.01, 0.03])  # twist to the initial pose
LARGER = 2  # pixels of the page for each pixel of the camera
EDGES = [(i, j) for i in range(8) for j in range(i) if (i ^ j) in (1, 2, 4)]
WHITE, RED = (255, 255, 255), (230, 60, 40)
SMALL = 0.01  # px, a difference that a screen cannot show


class Seen(NamedTuple):
    """The camera's view of the cube, and the results of the student's functions."""

    depth: Array  # m, (240, 320)
    truth: Array  # MuJoCo's pixels of the corners, (8, 2)
    theirs: Array  # the student's, (8, 2)
    T_world_found: Array  # the cube by the student's fit, (4, 4)
    off: Array  # error of its position, in the camera frame, mm, (3,)
    sigma: Array  # by the student's covariance, mm, (3,)
    right: tuple[Array, Array]  # error and sigma by the library
    view: Array  # the frustum by the student's K and back_project, (8, 2, 3)


class Eye(Tab):
    """A camera's view of a cube, and the accuracy of the estimated pose."""

    title = "Eye"
    wide = True

    def __init__(self, page: Page) -> None:
        """Draw camera, table and cube, and estimate the pose once."""
        super().__init__(page)
        self.model, self.data = day10_mujoco.table()
        mujoco.mj_forward(self.model, self.data)  # fills cam_xpos and cam_xmat
        self.K, self.T_world_cam = depth_camera.camera(self.model, self.data, "eye")
        self.x = 500.0
        self.y = 60.0
        self.yaw = 0.4
        self.noise = LAB.NOISE
        self.seen: Seen | None = None  # what is shown
        self.own = page.own(camera, units=UNITS)
        page.slider("cube, x", 350, 600, self.x, self.sets("x"), unit="mm", step=5)
        page.slider("cube, y", -250, 250, self.y, self.sets("y"), unit="mm", step=5)
        page.slider("cube, yaw", -0.8, 0.8, self.yaw, self.sets("yaw"))
        page.slider("pixel noise", 0.05, 2, self.noise, self.sets("noise"), unit="px")
        blank = np.zeros((day10_mujoco.HEIGHT, day10_mujoco.WIDTH))
        title = "depth image; corners by MuJoCo white, by your functions red"
        self.image = page.image(blank, title)
        self.text = page.html()
        frame = self.view(camera.back_project(*self.asked_view(self.K)))
        page.draw.lines(frame, "black", 1.5)
        self.frustum = page.draw.lines(frame, "purple")
        page.draw.curve(table_edge(), "grey")
        self.cube = page.draw.lines(np.zeros((12, 2, 3)), "orange")
        self.found = page.draw.lines(np.zeros((12, 2, 3)), "blue", 4)
        page.legend({
            "the cube": "orange", "your estimated pose": "blue",
            "your camera's view": "purple", "the library's view": "black",
        })  # fmt: skip
        self.on_move(page.q)

    def on_move(self, q: Array) -> None:
        """Estimate again, because the cube was moved or the file may differ."""
        T_world_cube = self.place()
        self.cube.points = edges(T_world_cube)
        noise = self.noise
        self.page.job(
            lambda: (T_world_cube, noise, self.ask(T_world_cube, noise)), self.answered
        )

    def place(self) -> Array:
        """Return the pose of the cube that the sliders define, `T_world_cube`."""
        at = (self.x / 1000, self.y / 1000, day10_mujoco.CUBE_HEIGHT)
        return se3.make_T(se3.Rz(self.yaw), at)

    def answered(self, asked: tuple[Array, float, Seen]) -> None:
        """Show the result, unless the cube has been moved in the meantime."""
        T_world_cube, noise, seen = asked
        if noise == self.noise and np.array_equal(T_world_cube, self.place()):
            self.show(seen)

    def ask(self, T_world_cube: Array, noise: float) -> Seen:
        """Return the camera's view, and the results of the student's functions."""
        day10_mujoco.place(self.model, self.data, T_world_cube)
        mujoco.mj_forward(self.model, self.data)  # fills sensordata and geom_xpos
        truth = day10_mujoco.corners_seen(self.model, self.data)
        T_cam_world = se3.inverse(self.T_world_cam)
        T = T_cam_world @ T_world_cube
        corners = day10_mujoco.CORNERS
        p_cam = corners @ T[:3, :3].T + T[:3, 3]
        rng = np.random.default_rng(LAB.NOISE_SEED)
        pixels = truth + noise * rng.normal(size=truth.shape)
        in_world = corners @ T_world_cube[:3, :3].T + T_world_cube[:3, 3]
        fovy = float(np.deg2rad(self.model.camera("eye").fovy[0]))
        K, guess = self.own.many(
            ("camera_matrix", fovy, day10_mujoco.WIDTH, day10_mujoco.HEIGHT),
            ("apply_twist", T, GUESS),
        )
        theirs, fit, J, far = self.own.many(
            ("project", K, T_cam_world, in_world),
            ("refine_pose", K, guess, corners, pixels),
            ("projection_jacobian", K, p_cam),
            ("back_project", *self.asked_view(K)),
        )
        C = self.own.pose_covariance(J, noise)
        best = camera.refine_pose(self.K, camera.apply_twist(T, GUESS), corners, pixels)
        right = camera.projection_jacobian(self.K, p_cam)
        C_right = camera.pose_covariance(right, noise)
        return Seen(
            depth_camera.depth(self.model, self.data, "eye"),
            truth,
            theirs,
            self.T_world_cam @ fit,
            1000 * (fit[:3, 3] - T[:3, 3]),
            sigma_at(T, C),
            (1000 * (best[:3, 3] - T[:3, 3]), sigma_at(T, C_right)),
            self.view(far),
        )

    def show(self, seen: Seen) -> None:
        """Show the image, both sets of corners, and the error of the estimate."""
        self.seen = seen
        self.image.image = as_bytes(picture(seen))
        self.found.points = edges(seen.T_world_found)
        self.frustum.points = seen.view
        apart = np.abs(seen.theirs - seen.truth).max()
        across, _, along = fits(seen.off, seen.sigma, *seen.right)
        kind = "good" if apart < SMALL else "bad"
        said = words.digits(apart, 2) if apart >= SMALL else f"less than {SMALL:g}"
        self.text.content = "".join(
            words.line(text, key, kind)
            for text, key, kind in (
                (f"largest error of your corners: {said} px", "corners", kind),
                (f"your pose with {self.noise:.2f} px of noise:", "fit", ""),
                (f"across the view: {across}", "across", ""),
                (f"along the view: {along}", "along", ""),
            )
        )

    def lost(self) -> None:
        """Show no numbers and no estimated cube."""
        self.text.content = ""
        if self.seen is not None:  # MuJoCo's corners alone
            bare = self.seen._replace(theirs=np.zeros((0, 2)))
            self.image.image = as_bytes(picture(bare))
        self.found.points = np.zeros((12, 2, 3), np.float32)
        self.frustum.points = np.zeros((8, 2, 3), np.float32)

    def asked_view(self, K: Array) -> tuple[Array, ...]:
        """Return the arguments of back_project for the image's corners at 0.2 m."""
        width = float(day10_mujoco.WIDTH)
        height = float(day10_mujoco.HEIGHT)
        frame = np.array([[0, 0], [width, 0], [width, height], [0, height]])
        return K, self.T_world_cam, frame, np.full(4, 0.2)

    def view(self, far: Array) -> Array:
        """Return four rays to those points, and the image's edge, (8, 2, 3)."""
        here = np.tile(self.T_world_cam[:3, 3], (4, 1))
        rays = np.stack([here, far], axis=1)
        edge = np.stack([far, np.roll(far, -1, axis=0)], axis=1)
        return np.vstack([rays, edge]).astype(np.float32)


def sigma_at(T_cam_cube: Array, C: Array) -> Array:
    """Return the cube's sigma in the camera frame, mm, (3,), from a covariance."""
    at_cube = np.hstack([-skew(T_cam_cube[:3, 3]), np.eye(3)])
    spread = np.diag(at_cube @ C @ at_cube.T)
    return 1000 * np.sqrt(np.maximum(spread, 0.0))


def fits(off: Array, sigma: Array, off_right: Array, sigma_right: Array) -> list[str]:
    """Return a sentence per axis on the errors of the student and the library, mm."""
    rows = zip(np.abs(off), sigma, np.abs(off_right), sigma_right, strict=True)
    return [
        f"error {x:.1f} mm, sigma {s:.1f}; library {x_right:.1f}, sigma {s_right:.1f}"
        for x, s, x_right, s_right in rows
    ]


def edges(T_world_cube: Array) -> Array:
    """Return a cube's twelve edges, (12, 2, 3)."""
    corners = day10_mujoco.CORNERS @ T_world_cube[:3, :3].T + T_world_cube[:3, 3]
    return np.array([[corners[i], corners[j]] for i, j in EDGES], np.float32)


def table_edge() -> Array:
    """Return the table's outline, a closed curve of points, (5, 3)."""
    around = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)])
    xy = np.array(scenes.TABLE_CENTRE) + np.array(scenes.TABLE_HALF) * around
    return np.column_stack([xy, np.full(5, day10_mujoco.TABLE)])


def picture(seen: Seen) -> Array:
    """Return the depth image with both sets of corners, of bytes, (480, 640, 3)."""
    near = seen.depth[np.isfinite(seen.depth)]
    least, most = near.min(), near.max()
    known = np.where(np.isfinite(seen.depth), seen.depth, most + 0.3 * (most - least))
    grey = as_bytes(-known)  # near is bright, no surface black
    large = np.repeat(np.repeat(grey, LARGER, axis=0), LARGER, axis=1) // 2
    for pixels, colour, half in ((seen.truth, WHITE, 4), (seen.theirs, RED, 2)):
        for u, v in np.round(LARGER * np.nan_to_num(pixels)).astype(int):
            rows = slice(max(v - half, 0), max(v + half + 1, 0))
            columns = slice(max(u - half, 0), max(u + half + 1, 0))
            large[rows, columns] = colour
    return large


TABS = [Eye]
