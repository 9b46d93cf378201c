"""The sensitivity of Day 10's numbers: each constant doubled, measured and explained.

The lab's own functions compute everything, without noise.
"""

import mujoco
import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import depth_camera, panda, se3
from robo47.screws import skew

LAB = lab_of(find_day(10))
DAY = LAB.day10_mujoco
DISTANCE = float(np.linalg.norm(DAY.AT - DAY.TO))

numbers = Numbers(
    half="error in u and in v: {} px",
    fovy="field of view: {}°",
    size="width and height of the image in pixels: × {}",
    distance="distance from the camera to the middle of the table: × {}",
    z="NEAR: {} m",
    noise="NOISE: {} px",
    wide="the cube's width: × {}",
    joint_6="joint 6 rotates by up to {}°",
    looks="LOOKS: {}",
    seed="SEED of the poses: {}",
    reach="rotations of joint 7: × {}",
    turn="rotation of the other X: {} rad",
    slide="translation of the other X: {} m",
    above="ABOVE the table: {} m",
    overhead="horizontal offset of the camera: × {}",
)


def seen(fovy, size, distance, overhead=1.0):
    """Return the table seen from further off, by other pixels: model, data, K, pose."""
    way = (DAY.AT - DAY.TO) * [overhead, overhead, 1.0]
    at = DAY.TO + distance * DISTANCE * way / np.linalg.norm(way)
    wide, high = round(size * DAY.WIDTH), round(size * DAY.HEIGHT)
    with turned(DAY, AT=at, FOVY=fovy, WIDTH=wide, HEIGHT=high):
        model, data = DAY.table()
    mujoco.mj_forward(model, data)  # fills cam_xpos and cam_xmat
    return model, data, *depth_camera.camera(model, data, "eye")


@numbers.add(
    "error from half a pixel in u and v, at the middle of the table", "{:.2f} mm",
    half=times(2.0, "the error is linear in the pixel error"),
    fovy=times(2.414, "f = height / 2 / tan(fovy / 2): tan 45° is 2.414 tan 22.5°"),
    size=times(0.5, "twice the pixels in the same field of view: f doubles"),
    distance=times(2.0, "one pixel covers z / f"),
)  # fmt: skip
def half_pixel(half=0.5, fovy=DAY.FOVY, size=1.0, distance=1.0):
    """Return how far a point moves for so many pixels."""
    _, _, K, T = seen(fovy, size, distance)
    pixels = K[:2, 2] + np.array([[0.0, 0.0], [half, half]])
    here, there = LAB.back_project(K, T, pixels, np.full(2, distance * DISTANCE))
    return 1000 * np.linalg.norm(there - here)


@numbers.add(
    "standard deviation along the view, 240 px", "{:.1f} mm",
    z=times(4.0, "one pixel in width corresponds to z² / (f w)"),
    noise=times(2.0, "the covariance is proportional to the square of the noise"),
    wide=times(0.5, "one pixel in width corresponds to z² / (f w)"),
    size=times(0.5, "f doubles"),
)  # fmt: skip
def along(z=LAB.NEAR, noise=LAB.NOISE, wide=1.0, size=1.0):
    """Return the sigma of the cube's depth."""
    T, corners, K = held(z, wide, size)
    J = LAB.projection_jacobian(K, corners @ T[:3, :3].T + T[:3, 3])
    C = LAB.pose_covariance(J, noise)
    at_cube = np.hstack([-skew(T[:3, 3]), np.eye(3)])
    return 1000 * np.sqrt((at_cube @ C @ at_cube.T)[2, 2])


def held(z, wide, size):
    """Return step 4's cube at a depth, its corners, and K."""
    way = np.array([0.05, 0.02, 0.8]) / 0.8
    T = se3.make_T(se3.Rz(0.3) @ se3.Rx(2.3), z * way)
    K = LAB.camera_matrix(np.deg2rad(DAY.FOVY), size * DAY.WIDTH, size * DAY.HEIGHT)
    return T, wide * DAY.CORNERS, K


def looked(joint_6, looks, seed, reach):
    """Return looks by joint 7, and by joint 6 a little."""
    away = np.random.default_rng(seed).uniform(-0.5, 0.5, (looks, 7))
    q = reach * away * np.eye(7)[6]
    q[:, 5] = np.radians(joint_6) * np.linspace(-1, 1, looks)
    return DAY.looks(DAY.handheld(), panda.READY_Q + q)


@numbers.add(
    "degrees of freedom of X that joint 7 leaves free", "{:.0f}",
    joint_6=times(0.0, "any rotation about a second direction determines X", to=1.0),
    looks=same("more rotations about the same axis add no information"),
    seed=same("the choice of the angles does not matter", to=11),
    reach=same("the size of the rotations does not matter"),
)  # fmt: skip
def left_free(joint_6=0.0, looks=LAB.LOOKS, seed=LAB.SEED, reach=1.0):
    """Return how many."""
    return LAB.free(LAB.motions(looked(joint_6, looks, seed, reach))[0])


@numbers.add(
    "error of the table's position, with another X of residual 0", "{:.0f} mm",
    turn=between(1.6, 2.0, "the chord at 193 mm from the axis is 2 · 193 sin(angle / 2)"),
    slide=between(1.0, 1.3, "the additional 50 mm are perpendicular to the chord"),
    looks=same("the computed target is at the same position in every picture"),
    seed=same("the choice of the angles does not matter", to=11),
    reach=same("the size of the rotations does not matter"),
)  # fmt: skip
def aside(turn=LAB.FREE[2], slide=LAB.FREE[5], looks=LAB.LOOKS, seed=LAB.SEED, reach=1):
    """Return how far the table's middle seems to be from where it is."""
    some = looked(0.0, looks, seed, reach)
    X = LAB.apply_twist(DAY.ON_HAND, np.array([0, 0, turn, 0, 0, slide]))
    return 1000 * np.linalg.norm(LAB.said(*some, X)[0] - DAY.TO)


@numbers.add(
    "error of the mean of the cube's points", "{:.1f} mm",
    overhead=between(0.0, 0.05, "from straight above the camera sees only the top",
                     to=0.001),
    size=between(0.8, 1.25, "more points on the same faces"),
    above=between(0.8, 1.0, "fewer points of the visible sides"),
    distance=between(0.8, 1.25, "fewer points of the same faces"),
)  # fmt: skip
def mean_off(overhead=1.0, size=1.0, above=LAB.ABOVE, distance=1.0):
    """Return how far, in the plane of the table."""
    model, data, K, T = seen(DAY.FOVY, size, distance, overhead)
    T_world_cube = se3.make_T(se3.Rz(0.3), (*DAY.TO[:2], DAY.CUBE_HEIGHT))
    DAY.place(model, data, T_world_cube)
    with turned(DAY, WIDTH=round(size * DAY.WIDTH), HEIGHT=round(size * DAY.HEIGHT)):
        cloud = LAB.depth_cloud(model, data, K, T)
    cloud = cloud[cloud[:, 2] > DAY.TABLE + above]
    return 1000 * np.linalg.norm(cloud.mean(axis=0)[:2] - DAY.TO[:2])
