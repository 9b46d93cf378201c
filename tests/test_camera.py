"""The camera against MuJoCo's own sensor and rays, SciPy, differences and noise."""

import mujoco
import numpy as np
import pytest
import scipy.linalg
import scipy.optimize
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from robo47 import camera, depth_camera, se3
from robo47.errors import Robo47Error
from robo47.rotation_log import log_pose
from robo47.screws import adjoint, skew

rng = np.random.default_rng(10)
K = camera.camera_matrix(np.pi / 2, 200, 100)
SCENE = """
<mujoco>
  <worldbody>
    <geom name="table" type="box" size=".6 .6 .02" pos=".5 0 .18"/>
    <camera name="eye" pos="1.15 .1 .9" xyaxes="0.1 1 0 -.7 .07 .7" fovy="45"
            resolution="320 240"/>
    <body name="cube" mocap="true"><site name="corner" pos=".02 .02 .02"/></body>
  </worldbody>
  <sensor><camprojection name="seen" site="corner" camera="eye"/></sensor>
</mujoco>
"""


@pytest.fixture(autouse=True)
def seeded():
    """Let every test draw the same, whichever ran before it."""
    global rng
    rng = np.random.default_rng(10)


@pytest.fixture(scope="module")
def scene():
    """Return a model with a camera, and its state."""
    model = mujoco.MjModel.from_xml_string(SCENE)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def poses(n, angle=0.5, way=0.3):
    """Return n random poses, (n, 4, 4)."""
    turns = Rotation.from_rotvec(rng.normal(scale=angle, size=(n, 3)))
    return se3.make_T(turns.as_matrix(), rng.normal(scale=way, size=(n, 3)))


def before_the_camera(n):
    """Return n points in the camera's axes, (n, 3)."""
    return rng.uniform((-0.4, -0.3, 0.5), (0.4, 0.3, 1.5), (n, 3))


def exp_of(xi):
    """Return SciPy's exponential of a twist (omega; v) as a 4x4 matrix."""
    A = np.zeros((4, 4))
    A[:3, :3] = skew(xi[:3])
    A[:3, 3] = xi[3:]
    return scipy.linalg.expm(A)


def test_a_point_is_seen_where_mujocos_camprojection_sensor_sees_it(scene):
    model, data = scene
    for _ in range(50):
        data.mocap_pos[0] = rng.uniform((0.3, -0.3, 0.2), (0.7, 0.3, 0.4))
        mujoco.mj_forward(model, data)
        K, T_world_cam = depth_camera.camera(model, data, "eye")
        p = data.site("corner").xpos[None]
        seen = camera.project(K, se3.inverse(T_world_cam), p)
        assert_same(seen[0], data.sensor("seen").data, 1e-10)


def test_the_depth_image_of_a_table_is_a_cloud_in_its_plane(scene):
    model, data = scene
    K, T_world_cam = depth_camera.camera(model, data, "eye")
    image = depth_camera.depth(model, data, "eye")
    assert image.shape == (240, 320)
    near = np.isfinite(image).ravel()
    pixels = depth_camera.pixel_centres(320, 240)[near]
    cloud = camera.back_project(K, T_world_cam, pixels, image.ravel()[near])
    assert near.mean() > 0.5
    top = cloud[cloud[:, 2] > 0.1999]  # its edge shows the sides, too
    assert len(top) > 0.9 * len(cloud)
    assert_same(top[:, 2], np.full(len(top), 0.2), 1e-14)
    seen = camera.project(K, se3.inverse(T_world_cam), cloud)
    assert_same(seen, pixels, 1e-10)


def test_where_there_is_nothing_the_depth_is_infinite():
    hidden = mujoco.MjModel.from_xml_string(SCENE.replace("1.15 .1 .9", "1.15 .1 -9"))
    data = mujoco.MjData(hidden)
    mujoco.mj_forward(hidden, data)
    assert np.isinf(depth_camera.depth(hidden, data, "eye")).all()


def test_a_camera_that_is_not_there_is_named_with_those_that_are(scene):
    with pytest.raises(Robo47Error, match=r"no camera 'nose'; it has \['eye'\]"):
        depth_camera.camera(*scene, "nose")


def test_the_matrix_of_a_right_angle_has_half_the_height_as_focal_length():
    assert_same(K, [[50, 0, 100], [0, 50, 50], [0, 0, 1]], 1e-13)
    assert_same(camera.project(K, np.eye(4), [[1, 0, 2]]), [[125, 50]], 1e-13)
    back = camera.back_project(K, np.eye(4), [[125, 50]], [2])
    assert_same(back, [[1, 0, 2]], 1e-15)


def test_a_pixel_moves_as_the_jacobian_says():
    p = before_the_camera(30)
    J = camera.projection_jacobian(K, p)
    h = 1e-6
    for k, xi in enumerate(h * np.eye(6)):
        there = camera.project(K, exp_of(xi), p)
        back = camera.project(K, exp_of(-xi), p)
        assert_same(J[:, :, k], (there - back) / (2 * h), 1e-6)
    assert_same(J[0] @ np.eye(6)[3], 50 / p[0, 2] * np.array([1.0, 0.0]), 1e-12)


@pytest.mark.parametrize("flat", [False, True])
def test_two_clouds_that_match_give_scipys_rotation_with_noise_or_without(flat):
    for T in poses(20, angle=2):
        A = rng.normal(size=(12, 3)) * [1, 1, 0 if flat else 1]
        B = A @ T[:3, :3].T + T[:3, 3]
        assert_same(camera.kabsch(A, B), T, 1e-13)
        B = B + rng.normal(scale=0.05, size=B.shape)
        ours = camera.kabsch(A, B)
        theirs, _ = Rotation.align_vectors(B - B.mean(0), A - A.mean(0))
        assert_same(ours[:3, :3], theirs.as_matrix(), 1e-12)
        assert_same(ours[:3, 3], B.mean(0) - ours[:3, :3] @ A.mean(0), 1e-14)


def test_a_mirrored_cloud_still_gives_a_rotation():
    A = rng.normal(size=(9, 3))
    T = camera.kabsch(A, A * [1, 1, -1])
    theirs, _ = Rotation.align_vectors((A - A.mean(0)) * [1, 1, -1], A - A.mean(0))
    assert_same(T[:3, :3], theirs.as_matrix(), 1e-12)
    assert np.linalg.det(T[:3, :3]) > 0


@given(st.lists(st.floats(-3, 3), min_size=6, max_size=6))
def test_a_pose_moves_by_scipys_exponential_of_the_twist(xi):
    T = poses(1)[0]
    assert_same(camera.apply_twist(T, xi), exp_of(np.array(xi)) @ T, 1e-12)


@pytest.mark.parametrize("size", [0.0, 1e-200, 1e-9, 1e-3])
def test_a_pose_moves_by_a_small_twist_too(size):
    xi = size * rng.normal(size=(2, 6))
    xi[1, :3] = 0  # a slide
    moved = camera.apply_twist(np.eye(4), xi)
    for ours, one in zip(moved, xi, strict=True):
        assert_same(ours, exp_of(one), 1e-15)


def test_a_pose_is_found_from_its_pixels_from_17_degrees_and_50_mm_away():
    corners = 0.02 * np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T
    eye_K = camera.camera_matrix(np.deg2rad(45), 320, 240)
    for T in poses(50):
        T[:3, 3] = (*rng.uniform(-0.15, 0.15, 2), rng.uniform(0.6, 1.0))
        pixels = camera.project(eye_K, T, corners)
        xi = np.append(rng.normal(scale=0.17, size=3), rng.normal(scale=0.03, size=3))
        away = camera.apply_twist(se3.make_T(np.eye(3), T[:3, 3]), xi)
        guess = se3.make_T(away[:3, :3] @ T[:3, :3], T[:3, 3] + xi[3:])
        assert_same(camera.refine_pose(eye_K, guess, corners, pixels), T, 1e-10)


def test_with_noise_the_pose_is_scipys_least_squares_one():
    p = before_the_camera(8)
    pixels = camera.project(K, np.eye(4), p) + rng.normal(scale=0.3, size=(8, 2))

    def off(xi):
        return (camera.project(K, exp_of(xi), p) - pixels).ravel()

    best = scipy.optimize.least_squares(off, np.zeros(6), xtol=1e-15, ftol=1e-15)
    ours = camera.refine_pose(K, np.eye(4), p, pixels)
    assert_same(ours, exp_of(best.x), 1e-6)


def test_the_covariance_is_how_fitted_poses_scatter():
    p = before_the_camera(12)
    J = camera.projection_jacobian(K, p)
    C = camera.pose_covariance(J, 0.01)
    noise = rng.normal(scale=0.01, size=(400, 12, 2))
    exact = camera.project(K, np.eye(4), p)
    fitted = [camera.refine_pose(K, np.eye(4), p, exact + e) for e in noise]
    xi = log_pose(np.array(fitted))
    surprise = np.einsum("ni,ij,nj->n", xi, np.linalg.inv(C), xi)
    assert abs(surprise.mean() - 6) < 0.7  # 6 +- 0.17 for 400 of chi2 with 6
    assert_same(camera.pose_covariance(J, 0.02), 4 * C, 1e-15)


def test_a_pose_that_too_few_pixels_tell_is_refused():
    J = camera.projection_jacobian(K, [[0, 0, 1]])
    with pytest.raises(ValueError, match="do not tell a pose"):
        camera.pose_covariance(J, 1.0)


def test_the_cameras_place_on_the_hand_is_found_from_motions_about_two_axes():
    X, A = poses(1, 2)[0], poses(8, 1)
    B = se3.inverse(X) @ A @ X
    assert_same(camera.hand_eye(A, B), X, 1e-12)


def test_motions_about_one_axis_fit_more_than_one_place_of_the_camera():
    X = poses(1, 2)[0]
    A = se3.make_T(se3.Rz(rng.uniform(-2, 2, 8)), np.zeros(3))
    B = se3.inverse(X) @ A @ X
    other = se3.make_T(se3.Rz(0.7), (0, 0, 0.05)) @ X  # turned and moved along the axis
    assert_same(A @ other, other @ B, 1e-14)
    assert np.abs(other - X).max() > 0.04


def test_the_step_of_icp_is_kabsch_on_the_nearest_points():
    target = rng.normal(size=(60, 3))
    T = poses(1, 0.02, 0.02)[0]
    source = (target[:40] - T[:3, 3]) @ T[:3, :3]
    found = np.eye(4)
    for _ in range(20):
        found = camera.icp_step(found, source, target)
    assert_same(found, T, 1e-12)


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: camera.camera_matrix(4, 2, 2), "fovy is 4; it must be below pi"),
        (lambda: camera.camera_matrix(1, 0, 2), "width is 0; it must be above 0"),
        (lambda: camera.project(K, np.eye(4), [[0, 0, -1]]), "behind the camera"),
        (lambda: camera.project(K, np.eye(3), [[0, 0, 1]]), "T_cam_world has shape"),
        (lambda: camera.back_project(K, np.eye(4), [[1, 2]], [1, 2]), "depth has"),
        (lambda: camera.projection_jacobian(K, [[0, 0, 0]]), "depth of p_cam is 0"),
        (lambda: camera.kabsch(np.eye(3), np.eye(4)[:, :3]), "target has shape"),
        (lambda: camera.hand_eye(np.eye(4), np.eye(4)), "A has shape"),
    ],
)
def test_what_cannot_be_is_said_in_one_line(call, told):
    with pytest.raises(ValueError, match=told):
        call()


def test_moving_the_camera_is_moving_the_world_the_other_way():
    p, xi = before_the_camera(10), rng.normal(scale=1e-7, size=6)
    T = poses(1, 0.1, 0.05)[0]
    T[2, 3] = 1.0
    seen = camera.project(K, camera.apply_twist(T, xi), p)
    body = adjoint(se3.inverse(T)) @ xi  # the same motion, in the object's axes
    assert_same(seen, camera.project(K, T @ exp_of(body), p), 1e-9)
