"""Camera models, and poses estimated from pixels, point clouds and motions.

Conventions:

- Camera axes: x right, y *down*, z forward, along the view. (MuJoCo's own camera looks
  along -z with y up; `robo47.depth_camera` turns it.)
- Pixels (u, v), (..., 2): u to the right, v down. (0, 0) is the image's corner, so
  that (0.5, 0.5) is the middle of its first pixel. OpenCV's (0, 0) is that middle.
- Depth is measured along z, not along the ray.
- Twists are (omega; v), in the camera's axes about its origin.
- Metres, radians, float64. Poses broadcast; a fit takes one cloud of points.

Sources: Hartley and Zisserman, *Multiple View Geometry* (2004), section 6.1; Arun,
Huang and Blostein, "Least-squares fitting of two 3-D point sets" (1987); Park and
Martin, "Robot sensor calibration" (1994); Besl and McKay, "A method for registration of
3-D shapes" (1992).
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3
from robo47.checks import Array
from robo47.jacobian import SINGULAR
from robo47.rotation_log import log_rotation
from robo47.screws import exp_screw, skew

# Gauss-Newton steps of `refine_pose`: with exact pixels each step doubles the correct
# digits; a residual of 0.3 px makes the convergence linear, by 1.8 digits a step.
STEPS = 10


def camera_matrix(fovy: float, width: float, height: float) -> Array:
    """Return the intrinsic matrix K: K p is the pixel (u, v, 1) of p times its depth.

    The pixels are square: f = (height / 2) / tan(fovy / 2) for both axes. The principal
    point is the centre of the image (Hartley and Zisserman, eq. 6.4).

    Args:
        fovy: field of view from the upper to the lower edge, radians, in (0, pi).
        width, height: of the image, pixels.

    Returns:
        [[f, 0, width / 2], [0, f, height / 2], [0, 0, 1]], (3, 3), pixels.

    Raises:
        ValueError: an angle or a size that no camera has.
    """
    angle = float(checks.positive(fovy, "fovy"))
    if angle >= np.pi:
        raise ValueError(f"fovy is {angle:g}; it must be below pi, in radians")
    w = float(checks.positive(width, "width"))
    h = float(checks.positive(height, "height"))
    f = 0.5 * h / np.tan(0.5 * angle)
    return np.array([[f, 0.0, 0.5 * w], [0.0, f, 0.5 * h], [0.0, 0.0, 1.0]])


def project(K: ArrayLike, T_cam_world: ArrayLike, points: ArrayLike) -> Array:
    """Return the pixels of points: the perspective projection of a pinhole camera.

    Args:
        K: camera matrix, pixels, (3, 3).
        T_cam_world: maps the world frame to the camera frame, (4, 4).
        points: in the world frame, metres, (n, 3).

    Returns:
        Pixels (u, v), (n, 2).

    Raises:
        ValueError: a wrong shape, not a pose, or a point that is not in front of the
            camera.
    """
    K = checks.array(K, "K", (3, 3))
    p = _moved_points(checks.pose(T_cam_world, "T_cam_world"), points, "points")
    if np.any(p[:, 2] <= 0.0):
        raise ValueError("a point is behind the camera: its depth is not above 0")
    return (p / p[:, 2:]) @ K[:2].T


def back_project(
    K: ArrayLike, T_world_cam: ArrayLike, pixels: ArrayLike, depth: ArrayLike
) -> Array:
    """Return the point cloud of pixels with known depth (back-projection).

    Args:
        K: camera matrix, pixels, (3, 3).
        T_world_cam: pose of the camera in the world, (4, 4).
        pixels: (u, v), (n, 2).
        depth: along the camera's z axis, not along the ray, metres, (n,).

    Returns:
        Points in the world, metres, (n, 3).

    Raises:
        ValueError: a wrong shape, or not a pose.
    """
    K = checks.array(K, "K", (3, 3))
    pixels = checks.array(pixels, "pixels", ("n", 2))
    depth = checks.array(depth, "depth", (len(pixels),))
    seen = np.column_stack([pixels, np.ones(len(pixels))])
    p_cam = depth[:, None] * np.linalg.solve(K, seen.T).T
    return _moved_points(checks.pose(T_world_cam, "T_world_cam"), p_cam, "depth")


def projection_jacobian(K: ArrayLike, p_cam: ArrayLike) -> Array:
    """Return the image Jacobian (interaction matrix) of points that move with a twist.

    It is d(pixel)/dp, with the rows fx / z (1, 0, -x / z) and fy / z (0, 1, -y / z),
    times [-[p], 1], because dp = omega x p + v.

    Args:
        K: camera matrix, pixels, (3, 3).
        p_cam: points in the camera frame, metres, (n, 3), with z above 0.

    Returns:
        (n, 2, 6): pixels per radian, pixels per metre.

    Raises:
        ValueError: a wrong shape, or a point that is not in front of the camera.
    """
    K = checks.array(K, "K", (3, 3))
    p = checks.array(p_cam, "p_cam", ("n", 3))
    checks.positive(p[:, 2], "the depth of p_cam")
    z = p[:, 2, None, None]
    by_point = (K[:2] - (p @ K[:2].T / p[:, 2:])[:, :, None] * [0.0, 0.0, 1.0]) / z
    by_twist = np.concatenate(
        [-skew(p), np.broadcast_to(np.eye(3), (len(p), 3, 3))], axis=-1
    )
    return by_point @ by_twist


def kabsch(source: ArrayLike, target: ArrayLike) -> Array:
    """Return the rigid motion that best maps one point cloud to another (Kabsch).

    With the centroids a and b subtracted, the rotation R is the one that maximises
    trace(R^T target^T source) (Arun, Huang, Blostein, 1987). The translation is then
    b - R a.

    Args:
        source, target: the same n points before and after, metres, (n, 3); not all on
            one line.

    Returns:
        T, (4, 4): never a mirror image, whatever the noise.

    Raises:
        ValueError: a wrong shape.
    """
    source = checks.array(source, "source", ("n", 3))
    target = checks.array(target, "target", (len(source), 3))
    a = source.mean(axis=0)
    b = target.mean(axis=0)
    R = _nearest_rotation((target - b).T @ (source - a))
    return se3.make_T(R, b - R @ a)


def apply_twist(T: ArrayLike, xi: ArrayLike) -> Array:
    """Return exp([xi]) T: a pose after a motion with a twist, multiplied from the left.

    Args:
        T: pose, (..., 4, 4).
        xi: twist times time, (omega; v), of any norm including 0, about the origin of
            the frame in which T is expressed, (..., 6).

    Returns:
        Pose, (..., 4, 4).

    Raises:
        ValueError: a wrong shape, or not a pose.
    """
    T = checks.pose(T, "T")
    xi = checks.array(xi, "xi", (6,))
    angle = np.linalg.norm(xi[..., :3], axis=-1, keepdims=True)
    way = np.linalg.norm(xi[..., 3:], axis=-1, keepdims=True)
    theta = np.where(angle > 0.0, angle, way)  # a slide turns by nothing
    S = np.divide(xi, theta, out=np.zeros_like(xi), where=theta > 0.0)
    return exp_screw(S, theta[..., 0]) @ T


def refine_pose(
    K: ArrayLike, T_guess: ArrayLike, points: ArrayLike, pixels: ArrayLike
) -> Array:
    """Return the pose that minimises the reprojection error: ten Gauss-Newton steps.

    Each step solves J xi = measured - predicted by least squares and multiplies the
    pose by exp([xi]) from the left, since J is about twists in the camera frame.

    Args:
        K: camera matrix, pixels, (3, 3).
        T_guess: initial `T_cam_object`, (4, 4), within about 17 degrees and 50 mm.
        points: of the object in its own frame, metres, (n, 3), three at least.
        pixels: their measured pixels, (n, 2).

    Returns:
        `T_cam_object`, (4, 4).

    Raises:
        ValueError: a wrong shape, not a pose, or a step that moves a point behind the
            camera because the initial pose is too far away.
    """
    K = checks.array(K, "K", (3, 3))
    T = checks.pose(T_guess, "T_guess")
    points = checks.array(points, "points", ("n", 3))
    pixels = checks.array(pixels, "pixels", (len(points), 2))
    for _ in range(STEPS):
        off = pixels - project(K, T, points)
        J = projection_jacobian(K, _moved_points(T, points, "points"))
        xi = np.linalg.lstsq(J.reshape(-1, 6), off.ravel(), rcond=None)[0]
        T = apply_twist(T, xi)
    return T


def pose_covariance(J: ArrayLike, sigma: float) -> Array:
    """Return the covariance of a fitted pose: sigma^2 (J^T J)^-1.

    Args:
        J: from `projection_jacobian` at the fitted pose, (n, 2, 6).
        sigma: standard deviation of each pixel coordinate, pixels, above 0.

    Returns:
        Covariance of the twist (omega; v) about the *camera's* origin, (6, 6): rad^2
        above, m^2 below. That of a point p of the object is [-[p], 1] C [-[p], 1]^T.

    Raises:
        ValueError: a wrong shape, or pixels that do not determine the pose.
    """
    J = checks.array(J, "J", ("n", 2, 6)).reshape(-1, 6)
    noise = checks.positive(sigma, "sigma")
    _, s, Vt = np.linalg.svd(J, full_matrices=False)
    if len(s) < 6 or s[-1] <= SINGULAR * s[0]:
        raise ValueError("J^T J is singular: these pixels do not tell a pose")
    half = noise * Vt.T / s  # J^T J itself would square what is small
    return half @ half.T


def hand_eye(A: ArrayLike, B: ArrayLike) -> Array:
    """Return the hand-eye calibration: X of A X = X B for all pairs.

    With noise no X satisfies all pairs, and each method returns another X. This one
    computes the rotation R_X first: a_i = R_X b_i for the rotation vectors of each
    pair, so R_X is the rotation nearest to the sum of a_i b_i^T. Then t is the
    least-squares solution of (R_A - 1) t = R_X t_B - t_A for all pairs together (Park,
    Martin, 1994).

    Args:
        A: motions of the hand, `T_hand0_hand1`, (k, 4, 4), about axes in at least two
            different directions: parallel axes do not determine X.
        B: the camera's for the same, `T_cam0_cam1`, (k, 4, 4).

    Returns:
        `T_hand_cam`, (4, 4).

    Raises:
        ValueError: a wrong shape, or not poses.
    """
    A = checks.pose(checks.array(A, "A", ("k", 4, 4)), "A")
    B = checks.pose(checks.array(B, "B", (len(A), 4, 4)), "B")
    R = _nearest_rotation(log_rotation(A[:, :3, :3]).T @ log_rotation(B[:, :3, :3]))
    C = (A[:, :3, :3] - np.eye(3)).reshape(-1, 3)
    d = (B[:, :3, 3] @ R.T - A[:, :3, 3]).ravel()
    return se3.make_T(R, np.linalg.lstsq(C, d, rcond=None)[0])


def icp_step(T: ArrayLike, source: ArrayLike, target: ArrayLike) -> Array:
    """Return the next motion of the iterative closest point algorithm (ICP).

    Each point of the source, moved by T, is paired with the nearest point of the
    target; the result is the best rigid motion for these pairs (Besl, McKay, 1992).

    Args:
        T: the motion so far, source to target, (4, 4).
        source: metres, (n, 3).
        target: metres, (m, 3).

    Returns:
        The next motion, (4, 4).

    Raises:
        ValueError: a wrong shape, or not a pose.
    """
    source = checks.array(source, "source", ("n", 3))
    target = checks.array(target, "target", ("m", 3))
    now = _moved_points(checks.pose(T, "T"), source, "source")
    away = np.sum((now[:, None] - target) ** 2, axis=-1)
    return kabsch(source, target[np.argmin(away, axis=1)])


def _nearest_rotation(H: Array) -> Array:
    """Return the rotation R that makes trace(R^T H) largest, det +1."""
    U, _, Vt = np.linalg.svd(H)
    U[:, -1] *= np.sign(np.linalg.det(U) * np.linalg.det(Vt))
    return U @ Vt


def _moved_points(T: Array, points: ArrayLike, name: str) -> Array:
    return checks.array(points, name, ("n", 3)) @ T[:3, :3].T + T[:3, 3]
