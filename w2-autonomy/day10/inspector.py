"""Day 10 in the inspector: the tab Eye.

The lab's camera looks at the cube. Its depth image has MuJoCo's corners as white
squares and the student's projected ones in red; below stands the pose that the
student's own functions find from pixels with noise, and in the scene it is blue.
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
from robo47 import camera, eye, scenes, se3
from robo47.checks import Array
from robo47.screws import skew

import day10_mujoco

LAB = lab_of(find_day(10))  # its noise and seeds
GUESS = np.array([0.1, -0.08, 0.05, 0.02, -0.01, 0.03])  # what a fit begins beside
LARGER = 2  # pixels of the page for one of the camera's
EDGES = [(i, j) for i in range(8) for j in range(i) if (i ^ j) in (1, 2, 4)]
WHITE, RED = (255, 255, 255), (230, 60, 40)
SMALL = 0.01  # px: what one calls the same on a screen


class Seen(NamedTuple):
    """What the camera sees of the cube, and what the student's functions make of it."""

    depth: Array  # m, (240, 320)
    truth: Array  # MuJoCo's pixels of the corners, (8, 2)
    theirs: Array  # the student's, (8, 2)
    T_world_found: Array  # the cube by the student's fit, (4, 4)
    off: Array  # of its place, in the camera's axes, mm, (3,)
    sigma: Array  # that the student's covariance says, mm, (3,)


class Eye(Tab):
    """What a camera sees, and how sure it is of it."""

    title = "Eye"
    wide = True

    def __init__(self, page: Page) -> None:
        """Draw camera, table and cube, and ask for the first time."""
        super().__init__(page)
        self.model, self.data = day10_mujoco.table()
        mujoco.mj_forward(self.model, self.data)  # fills cam_xpos and cam_xmat
        self.K, self.T_world_cam = eye.camera(self.model, self.data, "eye")
        self.x = 500.0
        self.y = 60.0
        self.yaw = 0.4
        self.noise = LAB.NOISE
        self.own = page.own(camera)
        page.slider("cube, x", 350, 600, self.x, self.sets("x"), unit="mm", step=5)
        page.slider("cube, y", -250, 250, self.y, self.sets("y"), unit="mm", step=5)
        page.slider("turned", -0.8, 0.8, self.yaw, self.sets("yaw"))
        page.slider("noise", 0.05, 2, self.noise, self.sets("noise"), unit="px")
        blank = np.zeros((day10_mujoco.HEIGHT, day10_mujoco.WIDTH))
        self.image = page.image(blank, "depth; white: MuJoCo's corners, red: yours")
        self.text = page.html()
        page.draw.lines(self.view(), "grey")
        page.draw.curve(table_edge(), "grey")
        self.cube = page.draw.lines(np.zeros((12, 2, 3)), "orange")
        self.found = page.draw.lines(np.zeros((12, 2, 3)), "blue", 4)
        self.on_move(page.q)

    def on_move(self, q: Array) -> None:
        """Ask again: the cube was moved, or the file may be another."""
        T_world_cube = self.place()
        self.cube.points = edges(T_world_cube)
        noise = self.noise
        self.page.job(
            lambda: (T_world_cube, noise, self.ask(T_world_cube, noise)), self.answered
        )

    def place(self) -> Array:
        """Return where the sliders put the cube, `T_world_cube`."""
        at = (self.x / 1000, self.y / 1000, day10_mujoco.CUBE_HEIGHT)
        return se3.make_T(se3.Rz(self.yaw), at)

    def answered(self, asked: tuple[Array, float, Seen]) -> None:
        """Show what came out, unless the cube has been moved meanwhile."""
        T_world_cube, noise, seen = asked
        if noise == self.noise and np.array_equal(T_world_cube, self.place()):
            self.show(seen)

    def ask(self, T_world_cube: Array, noise: float) -> Seen:
        """Return what the camera sees, and what the student's functions say of it."""
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
        theirs, fit, J = self.own.many(
            ("project", self.K, T_cam_world, in_world),
            ("refine_pose", self.K, camera.moved(T, GUESS), corners, pixels),
            ("projection_jacobian", self.K, p_cam),
        )
        C = self.own.pose_covariance(J, noise)
        at_cube = np.hstack([-skew(T[:3, 3]), np.eye(3)])
        spread = np.diag(at_cube @ C @ at_cube.T)
        return Seen(
            eye.depth(self.model, self.data, "eye"),
            truth,
            theirs,
            self.T_world_cam @ fit,
            1000 * (fit[:3, 3] - T[:3, 3]),
            1000 * np.sqrt(np.maximum(spread, 0.0)),
        )

    def show(self, seen: Seen) -> None:
        """Show the picture, both clouds of corners, and how far the fit is off."""
        self.image.image = as_bytes(picture(seen))
        self.found.points = edges(seen.T_world_found)
        apart = np.abs(seen.theirs - seen.truth).max()
        across, _, along = np.abs(seen.off)
        sure_across, _, sure = seen.sigma
        kind = "good" if apart < SMALL else "bad"
        said = f"{apart:.2g}" if apart >= SMALL else f"less than {SMALL:g}"
        self.text.content = "".join(
            words.line(text, key, kind)
            for text, key, kind in (
                (f"your corners: {said} px from MuJoCo's", "corners", kind),
                (f"your fit, with {self.noise:.2f} px of noise:", "fit", ""),
                (f"across {across:.1f} mm off, sigma {sure_across:.1f}", "across", ""),
                (f"along the view {along:.1f} mm off, sigma {sure:.1f}", "along", ""),
            )
        )

    def lost(self) -> None:
        """Show no numbers, and no cube where they would put it."""
        self.text.content = ""
        self.found.points = np.zeros((12, 2, 3), np.float32)

    def view(self) -> Array:
        """Return the camera's frustum: four rays and the picture's edge, (8, 2, 3)."""
        width = float(day10_mujoco.WIDTH)
        height = float(day10_mujoco.HEIGHT)
        frame = np.array([[0, 0], [width, 0], [width, height], [0, height]])
        far = camera.back_project(self.K, self.T_world_cam, frame, np.full(4, 0.2))
        here = np.tile(self.T_world_cam[:3, 3], (4, 1))
        rays = np.stack([here, far], axis=1)
        return np.vstack([rays, np.stack([far, np.roll(far, -1, axis=0)], axis=1)])


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
    grey = as_bytes(-known)  # near is bright, and where no ray meets a thing is black
    large = np.repeat(np.repeat(grey, LARGER, axis=0), LARGER, axis=1) // 2
    for pixels, colour, half in ((seen.truth, WHITE, 4), (seen.theirs, RED, 2)):
        for u, v in np.round(LARGER * np.nan_to_num(pixels)).astype(int):
            rows = slice(max(v - half, 0), max(v + half + 1, 0))
            columns = slice(max(u - half, 0), max(u + half + 1, 0))
            large[rows, columns] = colour
    return large


TABS = [Eye]
