"""Day 10 in the inspector: the tab Eye.

The lab's camera points at the cube. Its picture shows the cube as MuJoCo's camera sees
it, the student's projected corners as red dots, and in blue the cube at the pose that
the student's own functions estimate from noisy pixels. The scene shows that pose too.
"""

from typing import NamedTuple

import mujoco
import numpy as np

from labkit.inspector import declared as ui
from labkit.inspector import words
from labkit.inspector.canvas import Canvas, inset
from labkit.inspector.meshes import place
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import camera, depth_camera, scenes, se3
from robo47.checks import Array
from robo47.screws import skew

import day10_mujoco

LAB = lab_of(find_day(10))  # its noise and seeds
GUESS = np.array([0.1, -0.08, 0.05, 0.02, -0.01, 0.03])  # twist to the initial pose
W, H = day10_mujoco.WIDTH, day10_mujoco.HEIGHT
FRAME = np.array([[0.0, 0], [W, 0], [W, H], [0, H]])  # corners of the picture, px
CORNERS = day10_mujoco.CORNERS
EDGES = [(i, j) for i in range(8) for j in range(i) if (i ^ j) in (1, 2, 4)]
# Faces by their corners, in a closed order, and the brightness of each.
FACES = {(4, 5, 7, 6): 0.85, (0, 1, 3, 2): 0.6, (2, 3, 7, 6): 0.7, (0, 1, 5, 4): 0.7,
         (1, 3, 7, 5): 1.0}  # fmt: skip
TABLE, CUBE = (96, 84, 72), np.array([240, 168, 20])
TABLE_HALF = np.array([*scenes.TABLE_HALF, 0.01])
TABLE_AT = se3.make_T(np.eye(3), (*scenes.TABLE_CENTRE, day10_mujoco.TABLE - 0.01))
AXES = ("right", "down", "depth")  # of the camera
NEAR = 26.0  # px around the cube in the magnified part
COLUMNS = ("mm", "your error", "your sigma", "library's", "its sigma")


class Seen(NamedTuple):
    """The camera's view of the cube, and the results of the functions."""

    T_world_cube: Array  # (4, 4)
    truth: Array  # MuJoCo's pixels of the corners, (8, 2)
    corners: Array  # by `project`, (8, 2)
    T_world_found: Array  # the cube by the fit, (4, 4)
    off: Array  # error of its position, in the camera frame, mm, (3,)
    sigma: Array  # by the covariance, mm, (3,)
    view: Array  # the frustum by K and `back_project`, (8, 2, 3)


class Eye(ui.Declared):
    """A camera's view of a cube, and the accuracy of the estimated pose."""

    title = "Eye"
    library = camera
    functions = {
        "camera_matrix": "px", "project": "px", "back_project": "m",
        "apply_twist": "in one entry", "refine_pose": "in one entry",
        "projection_jacobian": "(px per rad or m)", "pose_covariance": "(rad2 or m2)",
    }  # fmt: skip
    camera = ((1.9, -1.75, 1.25), (0.72, 0.3, 0.42))

    x = ui.slider("cube, x", 350, 600, 500.0, "mm", 5)
    y = ui.slider("cube, y", -250, 250, 60.0, "mm", 5)
    yaw = ui.slider("cube, yaw", -0.8, 0.8, 0.4)
    noise = ui.slider("pixel noise", 0.05, 2, LAB.NOISE, "px")
    image = ui.panel.image(
        np.zeros((H, W, 3)), "what the camera sees, and a magnified part"
    )
    key = ui.panel.key({
        "the cube": "orange", "your project": "red",
        "the cube at your estimated pose": "blue",
    })  # fmt: skip
    table = ui.panel.html()
    top = ui.scene.box(TABLE_HALF, TABLE)
    cube = ui.scene.box(np.full(3, scenes.CUBE_HALF), "orange", legend="the cube")
    found = ui.yours.box(
        np.full(3, 1.06 * scenes.CUBE_HALF), "blue", 0.7, legend="your estimated pose"
    )
    true_view = ui.scene.lines(
        ui.NOWHERE, "white", 1.5, legend="the library's camera view"
    )
    frustum = ui.yours.lines(ui.NOWHERE, "purple", legend="your camera's view")

    def prepare(self) -> None:
        place(self.top, TABLE_AT)
        self.model, self.data = day10_mujoco.table()
        mujoco.mj_forward(self.model, self.data)  # fills cam_xpos and cam_xmat
        self.K, self.T_world_cam = depth_camera.camera(self.model, self.data, "eye")

    def ask(self, fns, at) -> Seen:
        xyz = (at.x / 1000, at.y / 1000, day10_mujoco.CUBE_HEIGHT)
        T_world_cube = se3.make_T(se3.Rz(at.yaw), xyz)
        day10_mujoco.place(self.model, self.data, T_world_cube)
        mujoco.mj_forward(self.model, self.data)  # fills sensordata
        truth = day10_mujoco.corners_seen(self.model, self.data)
        T_cam_world = se3.inverse(self.T_world_cam)
        T = T_cam_world @ T_world_cube
        rng = np.random.default_rng(LAB.NOISE_SEED)
        pixels = truth + at.noise * rng.normal(size=truth.shape)
        fovy = float(np.deg2rad(self.model.camera("eye").fovy[0]))
        K, guess = fns.many(("camera_matrix", fovy, W, H), ("apply_twist", T, GUESS))
        corners, fit, J, far = fns.many(
            ("project", K, T_cam_world, moved(T_world_cube)),
            ("refine_pose", K, guess, CORNERS, pixels),
            ("projection_jacobian", K, moved(T)),
            ("back_project", K, self.T_world_cam, FRAME, np.full(4, 0.2)),
        )
        sigma = sigma_at(T, fns.pose_covariance(J, at.noise))
        found, off = self.T_world_cam @ fit, 1000 * (fit[:3, 3] - T[:3, 3])
        return Seen(T_world_cube, truth, corners, found, off, sigma, self.rays(far))

    def rays(self, far: Array) -> Array:
        """Return four rays to the picture's corners, and its edge, (8, 2, 3)."""
        here = np.tile(self.T_world_cam[:3, 3], (4, 1))
        edge = np.stack([far, np.roll(far, -1, axis=0)], axis=1)
        return np.vstack([np.stack([here, far], axis=1), edge])

    def show(self, yours: Seen, right: Seen) -> None:
        place(self.cube, right.T_world_cube)
        place(self.found, yours.T_world_found)
        self.frustum.points, self.true_view.points = yours.view, right.view
        self.image.image = self.picture(None if self.emptied else yours, right)
        rows = zip(AXES, yours.off, yours.sigma, right.off, right.sigma, strict=True)
        kind = self.kind_of(" ".join(self.functions))
        cells = [[name, *(f"{x:z,.1f}" for x in row)] for name, *row in rows]
        self.table.content = words.table(COLUMNS, [(row, kind) for row in cells])

    def picture(self, yours: Seen | None, right: Seen) -> Array:
        """Return what the camera sees, of bytes, (480, 640, 3), magnified in a part."""
        middle = right.truth.mean(axis=0)
        part = middle + np.array([[-NEAR, NEAR], [NEAR, -NEAR]])
        whole = self.drawn(Canvas((0, H), (W, 0), (2 * W, 2 * H)), yours, right)
        large = self.drawn(Canvas(*part, (200, 200)), yours, right)
        return inset(whole, large, (2 * H - 205, 5))

    def drawn(self, canvas: Canvas, yours: Seen | None, right: Seen) -> Array:
        """Draw the table, the cube as it is, and the student's on a canvas."""
        T_cam_world = se3.inverse(self.T_world_cam)

        def seen(points: Array) -> Array:
            return camera.project(self.K, T_cam_world, points)

        ring = np.array([(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]) * TABLE_HALF
        canvas.polygon(seen(ring + TABLE_AT[:3, 3]), TABLE)
        corners = moved(right.T_world_cube)
        away = {face: far_of(self.T_world_cam, corners[list(face)]) for face in FACES}
        for face in sorted(FACES, key=away.get, reverse=True):
            shade = tuple(map(int, FACES[face] * CUBE))
            canvas.polygon(right.truth[list(face)], shade)
        if yours is not None:
            found = moved(yours.T_world_found)
            if (found @ T_cam_world[2, :3] + T_cam_world[2, 3] > 0).all():
                for i, j in EDGES:
                    canvas.line(seen(found[[i, j]]), "blue", 2)
            canvas.dots(yours.corners, "red", 3.5)
        return canvas.picture()

    def says(self, yours: Seen, right: Seen):
        apart = np.abs(yours.corners - yours.truth).max()
        said = words.digits(apart, 2) if apart >= 0.01 else "less than 0.01"
        out = np.sum((yours.corners < 0) | (yours.corners > (W, H)), axis=1).astype(
            bool
        )
        lost = f"; {out.sum()} of 8 are outside the picture" if out.any() else ""
        of = "camera_matrix project"
        yield f"Largest error of your corners: {said} px{lost}.", of
        mm = words.digits(float(np.linalg.norm(yours.off)))
        noise = f"With {self.noise:.2f} px of noise your estimated cube is "
        of = "camera_matrix apply_twist refine_pose"
        yield f"{noise}{mm} mm from the cube.", of


def moved(T: Array) -> Array:
    """Return the cube's corners at a pose, (8, 3)."""
    return CORNERS @ T[:3, :3].T + T[:3, 3]


def far_of(T_world_cam: Array, points: Array) -> float:
    """Return the mean distance of points from the camera, m."""
    return float(np.linalg.norm(points.mean(axis=0) - T_world_cam[:3, 3]))


def sigma_at(T_cam_cube: Array, C: Array) -> Array:
    """Return the cube's sigma in the camera frame, mm, (3,), from a covariance."""
    at_cube = np.hstack([-skew(T_cam_cube[:3, 3]), np.eye(3)])
    spread = np.diag(at_cube @ C @ at_cube.T)
    return 1000 * np.sqrt(np.maximum(spread, 0.0))


TABS = [Eye]
