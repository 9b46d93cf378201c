"""The sensitivity of Day 10's numbers: each constant doubled, measured and explained.

The lab's own functions compute everything, without noise.
"""

import mujoco
import numpy as np

from labkit.lesson.constants import Numbers, between, same, times, turned
from labkit.lesson.lab_module import complete_lab
from robo47 import depth_camera, panda, se3
from robo47.screws import skew

LAB = complete_lab(10)
DAY = LAB.day10_mujoco
DISTANCE = float(np.linalg.norm(DAY.AT - DAY.TO))

numbers = Numbers(
    LAB, DAY,
    half="error in u and in v: {} px",
    FOVY="field of view: {}°",
    size="width and height of the image in pixels: × {}",
    distance="distance from the camera to the middle of the table: × {}",
    NEAR="NEAR: {} m",
    NOISE="NOISE: {} px",
    wide="the cube's width: × {}",
    joint_6="joint 6 rotates by up to {}°",
    LOOKS="LOOKS: {}",
    SEED="SEED of the poses: {}",
    reach="rotations of joint 7: × {}",
    turn="rotation of the other X: {} rad",
    slide="translation of the other X: {} m",
    ABOVE="ABOVE the table: {} m",
    overhead="horizontal offset of the camera: × {}",
)


def seen(size, distance, overhead=1.0):
    """Return the table seen from further off, by other pixels: model, data, K, pose."""
    way = (DAY.AT - DAY.TO) * [overhead, overhead, 1.0]
    at = DAY.TO + distance * DISTANCE * way / np.linalg.norm(way)
    wide, high = round(size * DAY.WIDTH), round(size * DAY.HEIGHT)
    with turned(DAY, AT=at, WIDTH=wide, HEIGHT=high):
        model, data = DAY.table()
    mujoco.mj_forward(model, data)  # fills cam_xpos and cam_xmat
    return model, data, *depth_camera.camera(model, data, "eye")


@numbers.add("error from half a pixel in u and v, at the middle of the table", "{:.2f} mm",
    half=times(2.0, "the error is linear in the pixel error"),
    FOVY=times(2.414, "f = height / 2 / tan(fovy / 2): tan 45° is 2.414 tan 22.5°"),
    size=times(0.5, "twice the pixels in the same field of view: f doubles"),
    distance=times(2.0, "one pixel covers z / f"))
def half_pixel(half=0.5, size=1.0, distance=1.0):
    _, _, K, T = seen(size, distance)
    pixels = K[:2, 2] + np.array([[0.0, 0.0], [half, half]])
    here, there = LAB.back_project(K, T, pixels, np.full(2, distance * DISTANCE))
    return 1000 * np.linalg.norm(there - here)


@numbers.add("standard deviation along the view, 240 px", "{:.1f} mm",
    NEAR=times(4.0, "one pixel in width corresponds to z² / (f w)"),
    NOISE=times(2.0, "the covariance is proportional to the square of the noise"),
    wide=times(0.5, "one pixel in width corresponds to z² / (f w)"),
    size=times(0.5, "f doubles"))
def along(wide=1.0, size=1.0):
    T, corners, K = held(wide, size)
    J = LAB.projection_jacobian(K, corners @ T[:3, :3].T + T[:3, 3])
    C = LAB.pose_covariance(J, LAB.NOISE)
    at_cube = np.hstack([-skew(T[:3, 3]), np.eye(3)])
    return 1000 * np.sqrt((at_cube @ C @ at_cube.T)[2, 2])


def held(wide, size):
    """Return step 4's cube, its corners, and K."""
    way = np.array([0.05, 0.02, 0.8]) / 0.8
    T = se3.make_T(se3.Rz(0.3) @ se3.Rx(2.3), LAB.NEAR * way)
    K = LAB.camera_matrix(np.deg2rad(DAY.FOVY), size * DAY.WIDTH, size * DAY.HEIGHT)
    return T, wide * DAY.CORNERS, K


def looked(joint_6, reach):
    """Return looks by joint 7, and by joint 6 a little."""
    away = np.random.default_rng(LAB.SEED).uniform(-0.5, 0.5, (LAB.LOOKS, 7))
    q = reach * away * np.eye(7)[6]
    q[:, 5] = np.radians(joint_6) * np.linspace(-1, 1, LAB.LOOKS)
    return DAY.looks(DAY.handheld(), panda.READY_Q + q)


@numbers.add("degrees of freedom of X that joint 7 leaves free", "{:.0f}",
    joint_6=times(0.0, "any rotation about a second direction determines X", to=1.0),
    LOOKS=same("more rotations about the same axis add no information"),
    SEED=same("the choice of the angles does not matter", to=11),
    reach=same("the size of the rotations does not matter"))
def left_free(joint_6=0.0, reach=1.0):
    return LAB.free(LAB.motions(looked(joint_6, reach))[0])


@numbers.add("error of the table's position, with another X of residual 0", "{:.0f} mm",
    turn=between(1.6, 2.0, "the chord at 193 mm from the axis is 2 · 193 sin(angle / 2)"),
    slide=between(1.0, 1.3, "the additional 50 mm are perpendicular to the chord"),
    LOOKS=same("the computed target is at the same position in every picture"),
    SEED=same("the choice of the angles does not matter", to=11),
    reach=same("the size of the rotations does not matter"))
def aside(turn=LAB.FREE[2], slide=LAB.FREE[5], reach=1):
    some = looked(0.0, reach)
    X = LAB.apply_twist(DAY.ON_HAND, np.array([0, 0, turn, 0, 0, slide]))
    return 1000 * np.linalg.norm(LAB.said(*some, X)[0] - DAY.TO)


@numbers.add("error of the mean of the cube's points", "{:.1f} mm",
    overhead=between(0.0, 0.05, "from straight above the camera sees only the top", to=0.001),
    size=between(0.8, 1.25, "more points on the same faces"),
    ABOVE=between(0.8, 1.0, "fewer points of the visible sides"),
    distance=between(0.8, 1.25, "fewer points of the same faces"))
def mean_off(overhead=1.0, size=1.0, distance=1.0):
    model, data, K, T = seen(size, distance, overhead)
    T_world_cube = se3.make_T(se3.Rz(0.3), (*DAY.TO[:2], DAY.CUBE_HEIGHT))
    DAY.place(model, data, T_world_cube)
    with turned(DAY, WIDTH=round(size * DAY.WIDTH), HEIGHT=round(size * DAY.HEIGHT)):
        cloud = LAB.depth_cloud(model, data, K, T)
    cloud = cloud[cloud[:, 2] > DAY.TABLE + LAB.ABOVE]
    return 1000 * np.linalg.norm(cloud.mean(axis=0)[:2] - DAY.TO[:2])
