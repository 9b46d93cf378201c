"""Day 10: perspective projection, pose estimation and hand-eye calibration.

    make day10                      in the clone: sets all up, then runs this
    python src/day10_camera.py      in w2-autonomy/, once that is done

Camera frame: x right, y down, z forward. Pixel (0, 0) is the corner of the image and
(0.5, 0.5) the centre of its first pixel. Twists (omega; v). Metres, radians, pixels.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import camera as library
from robo47 import cli, depth_camera, panda, se3
from robo47.lesson.lab import Lab
from robo47.rotation_log import log_pose, log_rotation
from robo47.screws import adjoint, exp_screw, skew

import day10_mujoco

SEED = 10  # of where the cube stands, and of guesses
NOISE_SEED = 47  # of the noise alone
NOISE = 0.3  # px, of each corner that is found in a picture
TRIALS = 20  # cubes that are seen without noise
NOISY = 50  # fits with noise, at each height
CHI2_95 = 12.592  # of six numbers: 95 % of all twists are within
NEAR = 0.8  # m, from the eye to the cube whose pose is fitted
HEIGHTS = (480, 240, 120)  # px, of the pictures it is fitted to; 4 : 3
TURN = 0.17  # rad that a guess is turned wrong
SLIDE = 0.05  # m that it stands beside
STEPS = 10  # of a fit
LOOKS = 8  # poses of the arm from which the eye on its hand looks
JITTER = 0.001  # rad and m: noise of each look, per axis
FREE = np.array([0, 0, 0.5, 0, 0, 0.05])  # twist about joint 7's axis: another X
ABOVE = 0.006  # m above the table: lower points are the table's
STARTS = (-0.5, 0.0, 0.5)  # rad: yaws from which a cloud is fitted
ICP_STEPS = 15
DEMO = 3  # cubes that are found by their depth alone


def rms(x: np.ndarray) -> float:
    """Return the root of the mean square."""
    return np.sqrt(np.mean(np.square(x)))


def camera_matrix(fovy: float, width: float, height: float) -> np.ndarray:
    """Return the intrinsic matrix K, (3, 3), in pixels.

    fovy is the field of view from top to bottom in radians; width and height are the
    size of the image in pixels. The pixels are square, and the principal point is the
    centre of the image, where pixel (0, 0) is the corner (Szeliski, section 2.1.4).

    pi / 2 with 200 x 100 pixels: focal length 50, centre (100, 50).
    """
    # region 10.1
    f = height / 2 / np.tan(fovy / 2)  # the focal length in pixels
    return np.array([[f, 0, width / 2], [0, f, height / 2], [0, 0, 1]])  # the matrix K
    # endregion 10.1


def project(K: np.ndarray, T_cam_world: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return the pixels (u, v), (n, 2), to which a pinhole camera projects points.

    K is the intrinsic matrix, (3, 3). T_cam_world, (4, 4), maps the world frame to the
    camera frame. The points, (n, 3), are in the world frame, metres; their depths are
    above 0.

    With 10.1's K and T the identity (1, 0, 2) is seen at (125, 50).
    """
    # region 10.2
    p = points @ T_cam_world[:3, :3].T + T_cam_world[:3, 3]  # camera-frame points
    seen = p @ K.T  # the homogeneous pixels (u z, v z, z)
    return seen[:, :2] / seen[:, 2:]  # the pixels
    # endregion 10.2


def back_project(
    K: np.ndarray, T_world_cam: np.ndarray, pixels: np.ndarray, depth: np.ndarray
) -> np.ndarray:
    """Return the points, (n, 3), in the world frame, that a depth image contains.

    K is the intrinsic matrix, (3, 3), and T_world_cam, (4, 4), the pose of the camera
    in the world. The pixels (u, v), (n, 2), have the depth, (n,), in metres along the
    camera's z axis, not along the ray.

    With 10.1's K and T the identity (125, 50) at depth 2 is (1, 0, 2).
    """
    # region 10.3
    through = np.column_stack(  # the homogeneous pixels (u, v, 1)
        [pixels, np.ones(len(pixels))]
    )
    p = depth[:, None] * np.linalg.solve(K, through.T).T  # camera-frame points
    return p @ T_world_cam[:3, :3].T + T_world_cam[:3, 3]  # the world-frame points
    # endregion 10.3


def projection_jacobian(K: np.ndarray, p_cam: np.ndarray) -> np.ndarray:
    """Return the image Jacobian of each point, (n, 2, 6), in px/rad and px/m.

    It maps the twist (omega; v) of the object, expressed in the camera frame about the
    camera's origin, to the velocity of the pixel. K is the intrinsic matrix, (3, 3),
    with a focal length for each row; p_cam, (n, 3), are points in the camera frame, m.

    With 10.1's K at (0, 0, 2): v = (1, 0, 0) gives 25 px, omega = (0, 1, 0) gives 50.
    """
    # region 10.4
    fx, fy = K[0, 0], K[1, 1]  # the focal lengths
    x, y, z = p_cam.T  # the coordinates in the camera frame
    zero = np.zeros(len(p_cam))  # the zero entries
    one = np.ones(len(p_cam))  # the unit entries
    of_u, of_v = (
        fx * np.array([one, zero, -x / z]),  # the row for u before the division by z
        fy * np.array([zero, one, -y / z]),  # the row for v before the division by z
    )
    by_point = np.array([of_u, of_v]) / z  # the derivatives with respect to the point
    by_point = np.moveaxis(by_point, 2, 0)  # the derivatives of each point
    return np.concatenate([-by_point @ skew(p_cam), by_point], axis=2)  # the Jacobian
    # endregion 10.4


def kabsch(source: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Return the rigid motion T, (4, 4), with the least sum of |target - T source|^2.

    source and target are the same n points before and after the motion, metres, (n, 3)
    each. The rotation is never a reflection (Kabsch, 1976).

    target = source + (1, 0, 0): a move by that.
    """
    # region 10.5
    a = source.mean(axis=0)  # the centroid of the source
    b = target.mean(axis=0)  # the centroid of the target
    U, _, Vt = np.linalg.svd((target - b).T @ (source - a))  # the SVD
    R = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt  # the nearest rotation
    return se3.make_T(R, b - R @ a)  # the motion that maps a to b
    # endregion 10.5


def apply_twist(T: np.ndarray, xi: np.ndarray) -> np.ndarray:
    """Return exp([xi]) T, (4, 4): the pose T, (4, 4), moved by the twist xi.

    xi = (omega; v), (6,), in rad and m, has any norm, zero included. It is expressed in
    the frame in which T is given, about its origin.

    xi = (0, 0, 0, 1, 0, 0) moves by a metre along x, (0, 0, 0, 0, 0, 0) not at all.
    """
    # region 10.6
    angle = np.linalg.norm(xi[:3])  # the rotation angle
    theta = angle if angle > 0 else np.linalg.norm(xi[3:])  # the magnitude of the twist
    return exp_screw(xi / theta, theta) @ T if theta > 0 else T.copy()  # the pose
    # endregion 10.6


def refine_pose(
    K: np.ndarray, T_guess: np.ndarray, points: np.ndarray, pixels: np.ndarray
) -> np.ndarray:
    """Return the pose T_cam_object, (4, 4), that minimises the reprojection error.

    Ten Gauss-Newton steps from T_guess, (4, 4). K is the intrinsic matrix, (3, 3). The
    points, (n, 3), are in the object's frame, metres, and appear at the pixels, (n, 2).
    A guess that is right stays.
    """
    # region 10.6
    T = T_guess  # the current pose
    for _ in range(STEPS):
        p_cam = points @ T[:3, :3].T + T[:3, 3]  # the points in the camera frame
        J = projection_jacobian(K, p_cam).reshape(-1, 6)  # the Jacobian as a matrix
        off = (pixels - project(K, T, points)).ravel()  # the reprojection error
        T = apply_twist(T, np.linalg.lstsq(J, off, rcond=None)[0])  # the next pose
    return T  # the pose after the last step
    # endregion 10.6


def pose_covariance(J: np.ndarray, sigma: float) -> np.ndarray:
    """Return the covariance, (6, 6), of the twist of a pose fitted to noisy pixels.

    J, (n, 2, 6), is the image Jacobian of 10.4 at that pose. Each pixel coordinate has
    independent noise with the standard deviation sigma, px. If three blocks
    of J together are the 6 x 6 identity, and sigma is 2: four times the identity.
    """
    # region 10.7
    J = J.reshape(-1, 6)  # the Jacobian as a matrix
    return sigma**2 * np.linalg.inv(J.T @ J)  # the covariance of the twist
    # endregion 10.7


def hand_eye(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """Return X, (4, 4), with A X = X B for the motions A and B, (k, 4, 4) each.

    With noise no X fits all motions. Then R_X is the rotation nearest to the sum of
    a b^T, with the rotation vectors a of A and b of B, and t is the least-squares
    solution for this R_X. B = A: the identity.
    """
    # region 10.8
    a = np.array([log_rotation(T[:3, :3]) for T in A])  # the hand's rotation vectors
    b = np.array([log_rotation(T[:3, :3]) for T in B])  # the camera's rotation vectors
    U, _, Vt = np.linalg.svd(a.T @ b)  # the SVD of the sum of a b^T
    R = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt  # the nearest rotation
    C = (A[:, :3, :3] - np.eye(3)).reshape(-1, 3)  # the coefficients of t
    d = (B[:, :3, 3] @ R.T - A[:, :3, 3]).ravel()  # the right-hand side
    return se3.make_T(R, np.linalg.lstsq(C, d, rcond=None)[0])  # the pose X
    # endregion 10.8


def icp_step(T: np.ndarray, source: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Return the next T, (4, 4), of the iterative closest point algorithm (ICP).

    Each point of source, (n, 3), moved by T, is paired with the nearest point of
    target, (m, 3); the result is the best rigid motion from source to these pairs (Besl
    and McKay, 1992). Of a cloud to itself: 1.
    """
    # region 10.9
    now = source @ T[:3, :3].T + T[:3, 3]  # the source after the motion T
    away = np.sum((now[:, None] - target) ** 2, axis=2)  # the squared distances
    return kabsch(source, target[np.argmin(away, axis=1)])  # the motion of the best fit
    # endregion 10.9


def guesses(T: np.ndarray, n: int, rng: np.random.Generator) -> np.ndarray:
    """Return n poses, rotated from T by about TURN and moved by SLIDE, (n, 4, 4)."""
    size = np.repeat([TURN, SLIDE], 3) / np.sqrt(3)
    off = [library.apply_twist(np.eye(4), xi) for xi in size * rng.normal(size=(n, 6))]
    turned = np.array(off)[:, :3, :3] @ T[:3, :3]
    return se3.make_T(turned, np.array(off)[:, :3, 3] + T[:3, 3])


def jittered(T: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Return poses, (k, 4, 4), measured with noise: JITTER rad, JITTER m an axis."""
    xi = JITTER * rng.normal(size=(len(T), 6))
    return T @ np.array([library.apply_twist(np.eye(4), one) for one in xi])


def given_to_fits(rng: np.random.Generator) -> dict[str, list[tuple]]:
    """Return what your fits are asked, by function: MuJoCo knows no fits."""
    A = rng.normal(size=(9, 3))
    B = A + rng.normal(scale=0.1, size=A.shape)
    J = rng.normal(size=(8, 2, 6))
    T = guesses(np.eye(4), 1, rng)[0]
    hand = guesses(day10_mujoco.ON_HAND, 5, rng)  # motions, and the eye's, with noise
    seen = jittered(hand, rng)
    flat = np.array([1.0, 1.0, 0.0])
    mirror = np.array([1.0, 1.0, -1.0])
    return {
        "kabsch": [(A, B), (flat * A, flat * B), (A, mirror * A)],
        "apply_twist": [
            (T, rng.normal(size=6)),
            (T, 2.0 * np.eye(6)[4]),
            (T, np.zeros(6)),
        ],
        "pose_covariance": [(J, NOISE)],
        "hand_eye": [(hand, seen)],
        "icp_step": [(T, A, B)],
    }


def off_library(name: str, own, given: list[tuple]) -> np.ndarray:
    """Return how far your function is from robo47's of that name."""
    truth = getattr(library, name)
    return np.array([own(*some) - truth(*some) for some in given])


def looked_at(model, data, T_world_cube: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return where MuJoCo sees a cube's corners, px, (8, 2), and where they are, m."""
    day10_mujoco.place(model, data, T_world_cube)
    mujoco.mj_forward(model, data)  # fills sensordata: what camprojection sees
    corners = day10_mujoco.CORNERS @ T_world_cube[:3, :3].T + T_world_cube[:3, 3]
    return day10_mujoco.corners_seen(model, data), corners


def slopes(model, data, T_cam_cube: np.ndarray, T_world_cam: np.ndarray) -> np.ndarray:
    """Return what MuJoCo's pixels change per twist of the cube, (8, 2, 6).

    By central differences: about 1e-9 of an entry is lost.
    """
    h = 1e-6
    columns = []
    for xi in h * np.eye(6):
        there = T_world_cam @ library.apply_twist(T_cam_cube, xi)
        back = T_world_cam @ library.apply_twist(T_cam_cube, -xi)
        ahead, _ = looked_at(model, data, there)
        behind, _ = looked_at(model, data, back)
        columns.append((ahead - behind) / (2 * h))
    return np.stack(columns, axis=-1)


def fit_with_noise(height: int, T: np.ndarray, rng) -> tuple[np.ndarray, float]:
    """Fit a cube at T to noisy corners; print its error and its predicted error.

    Return which fits lie in their 95 % ellipse, (NOISY,), and mm off along the view.
    """
    K = camera_matrix(np.deg2rad(day10_mujoco.FOVY), height * 4 / 3, height)
    corners = day10_mujoco.CORNERS
    exact = project(K, T, corners)
    p_cam = corners @ T[:3, :3].T + T[:3, 3]
    C = pose_covariance(projection_jacobian(K, p_cam), NOISE)
    at_cube = np.hstack([-skew(T[:3, 3]), np.eye(3)])  # its velocity, omega x p + v
    sigma = 1000 * np.sqrt(np.diag(at_cube @ C @ at_cube.T))
    seen = exact + NOISE * rng.normal(size=(NOISY, *exact.shape))
    fits = np.array([refine_pose(K, T, corners, pixels) for pixels in seen])
    xi = np.array([log_pose(fit @ se3.inverse(T)) for fit in fits])
    inside = np.einsum("ni,ij,nj->n", xi, np.linalg.inv(C), xi) < CHI2_95
    off = 1000 * np.array([rms(x) for x in (fits[:, :3, 3] - T[:3, 3]).T])
    print(f"  {height:6}{sigma[0]:12.2f}{off[0]:10.2f}{sigma[2]:14.1f}{off[2]:10.1f}"
          f"{np.mean(inside):9.0%}")  # fmt: skip
    return inside, off[2]


def said(hands: np.ndarray, eyes: np.ndarray, X: np.ndarray) -> np.ndarray:
    """Return where the table's middle seems to be, (k, 3), if the eye sits at X.

    It stands still: what each look says of it is hand, X, and what the eye saw.
    """
    middle = np.append(day10_mujoco.TO, 1.0)
    return (hands @ X @ se3.inverse(eyes) @ middle)[:, :3]


def wanders(hands: np.ndarray, eyes: np.ndarray, X: np.ndarray) -> float:
    """Return by how much the table's middle seems to move between looks, mm."""
    points = said(hands, eyes, X)
    return 1000 * np.linalg.norm(points - points[0], axis=1).max()


def motions(looks) -> tuple[np.ndarray, np.ndarray]:
    """Return A and B, (k - 1, 4, 4): how hand and eye moved from the first look."""
    hands, eyes = (se3.inverse(T[0]) @ T[1:] for T in looks)
    return hands, eyes


def free(A: np.ndarray) -> int:
    """Return how many of X's six numbers the motions A, (k, 4, 4), leave open.

    A twist xi of X is not seen where A exp([xi]) = exp([xi]) A, that is Ad(A) xi = xi.
    """
    seen = (adjoint(A) - np.eye(6)).reshape(-1, 6)
    return 6 - np.linalg.matrix_rank(seen, tol=1e-9)


def judged(name: str, looks, fresh, X: np.ndarray, known: bool = True) -> None:
    """Print how good X looks at these looks, and how good it is."""
    A, B = motions(looks)
    residual = np.abs(A @ X - X @ B).max()
    turns = [log_rotation(T[:3, :3]) for T in A]
    second = np.linalg.svd(turns, compute_uv=False)[1]
    text = f"  {name:25}{second:6.2f}{free(A):6}{residual:10.0e}"
    if known:
        at = day10_mujoco.ON_HAND
        turned = np.degrees(np.linalg.norm(log_rotation(X[:3, :3] @ at[:3, :3].T)))
        beside = 1000 * np.linalg.norm(X[:3, 3] - at[:3, 3])
        text += f"{turned:7.2f}{beside:7.2f}{wanders(*looks, X):7.2f}"
        text += f"{wanders(*fresh, X):7.1f}"
    print(text)


def calibrate(rng: np.random.Generator) -> tuple[np.ndarray, int]:
    """Find where on the hand the eye sits, by all joints and by joint 7 alone.

    Return how far the first is from where MuJoCo's camera sits, (4, 4), and how many
    numbers the second leaves free.
    """
    model = day10_mujoco.handheld()
    away = rng.uniform(-0.5, 0.5, (2, LOOKS, 7))
    # mujoco.mj_forward fills site_xpos, site_xmat, cam_xpos and cam_xmat of each look.
    many = day10_mujoco.looks(model, panda.READY_Q + away[0])
    few = day10_mujoco.looks(model, panda.READY_Q + away[0] * np.eye(7)[6])
    fresh = day10_mujoco.looks(model, panda.READY_Q + away[1])
    noisy = (many[0], jittered(many[1], rng))
    another = library.apply_twist(day10_mujoco.ON_HAND, FREE)
    X = hand_eye(*motions(many))
    print("                            second  left                off     moves, mm")
    print(
        "  joints                      axis  free  residual   deg    mm   here  there"
    )
    judged("all joints", many, fresh, X)
    judged("all joints, 1 mrad, 1 mm", noisy, fresh, hand_eye(*motions(noisy)))
    # Which of many X this is only rounding decides, so it is not shown ...
    judged("joint 7 alone", few, fresh, hand_eye(*motions(few)), known=False)
    judged("joint 7 alone, another X", few, fresh, another)  # ... but one of them is.
    aside = 1000 * np.linalg.norm(said(*few, another)[0] - day10_mujoco.TO)
    print(f"  with the last X the table's middle is {aside:.0f} mm from its true place")
    return X - day10_mujoco.ON_HAND, free(motions(few)[0])


def found(cloud: np.ndarray) -> np.ndarray:
    """Return `T_world_cube` of the cube that a cloud of points, (n, 3), belongs to."""
    faces = day10_mujoco.faces()
    fits = []
    for yaw in STARTS:
        middle = np.append(cloud[:, :2].mean(axis=0), day10_mujoco.CUBE_HEIGHT)
        T = se3.inverse(se3.make_T(se3.Rz(yaw), middle))
        for _ in range(ICP_STEPS):
            T = icp_step(T, cloud, faces)
        now = cloud @ T[:3, :3].T + T[:3, 3]
        beside = np.linalg.norm(now[:, None] - faces, axis=2).min(axis=1)
        fits.append((rms(beside), T))
    _, best = min(fits, key=lambda fit: fit[0])
    return se3.inverse(best)


def depth_cloud(model, data, K: np.ndarray, T_world_cam: np.ndarray, half: float = 0):
    """Return the points that the eye sees, (n, 3), in the world.

    With `half` pixels added, both ways, they are where they are not.
    """
    mujoco.mj_forward(model, data)  # fills geom_xpos: what rays meet
    far = depth_camera.depth(
        model, data, "eye"
    ).ravel()  # mujoco.mj_multiRay, a ray a pixel
    hit = np.isfinite(far)
    pixels = depth_camera.pixel_centres(day10_mujoco.WIDTH, day10_mujoco.HEIGHT)
    return back_project(K, T_world_cam, pixels[hit] + half, far[hit])


def see_the_cube(model, data, K: np.ndarray, T_world_cam: np.ndarray) -> list[float]:
    """Find Day 7's cube by its depth image; return how far off each is, mm."""
    off = []
    for T_world_cube in day10_mujoco.cubes(DEMO, SEED + 1):
        day10_mujoco.place(model, data, T_world_cube)
        cloud = depth_cloud(model, data, K, T_world_cam)
        cloud = cloud[cloud[:, 2] > day10_mujoco.TABLE + ABOVE]
        beside = 1000 * np.linalg.norm((found(cloud) - T_world_cube)[:2, 3])
        mean = 1000 * np.linalg.norm(cloud.mean(axis=0)[:2] - T_world_cube[:2, 3])
        print(f"  {len(cloud)} points: {beside:.1f} mm from its true place; "
              f"their mean: {mean:.1f} mm")  # fmt: skip
        off.append(beside)
    return off


def off_mujoco(model, data, K: np.ndarray, T_world_cam, rng) -> dict[str, list]:
    """Return how far your slopes and fits are from what MuJoCo sees, by cube."""
    T_cam_world = se3.inverse(T_world_cam)
    off: dict[str, list] = {"J": [], "pose": []}
    for T_world_cube in day10_mujoco.cubes(TRIALS, SEED):
        T = T_cam_world @ T_world_cube
        p_cam = day10_mujoco.CORNERS @ T[:3, :3].T + T[:3, 3]
        truth = slopes(model, data, T, T_world_cam)
        off["J"].append(projection_jacobian(K, p_cam) - truth)
        pixels, _ = looked_at(model, data, T_world_cube)
        guess = guesses(T, 1, rng)[0]
        off["pose"].append(refine_pose(K, guess, day10_mujoco.CORNERS, pixels) - T)
    return off


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    model, data = day10_mujoco.table()
    mujoco.mj_forward(model, data)  # fills cam_xpos and cam_xmat
    K_file, T_world_cam = depth_camera.camera(model, data, "eye")
    print(panda.describe("panda_nohand"))

    lab.step("1. Projection: from a point to a pixel")
    K = camera_matrix(np.deg2rad(day10_mujoco.FOVY), *model.cam_resolution[0])
    lab.show("K", K, 3)
    lab.check("|K - intrinsic matrix of MuJoCo's camera|, px", K - K_file)
    off = []
    for T_world_cube in day10_mujoco.cubes(TRIALS, SEED):
        pixels, corners = looked_at(model, data, T_world_cube)
        off.append(project(K, se3.inverse(T_world_cam), corners) - pixels)
    lab.record("project", off, label="|project - MuJoCo's camprojection|, px",
               seed=SEED)  # fmt: skip

    lab.step("2. Back-projection: a depth image is a point cloud")
    day10_mujoco.place(model, data, day10_mujoco.ASIDE)
    cloud = depth_cloud(model, data, K, T_world_cam)
    flat = day10_mujoco.on_top(cloud)
    off = cloud[flat, 2] - day10_mujoco.TABLE
    lab.check("|height of the points - height of the table|, m", off)
    shifted = depth_cloud(model, data, K, T_world_cam, half=0.5)
    half = 1000 * rms(np.linalg.norm(shifted - cloud, axis=1)[flat])
    print(f"  {len(cloud)} points; half a pixel in u and v is {half:.1f} mm (RMS)")
    lab.measured("error from half a pixel in u and v, mm", half)

    lab.step("3. The image Jacobian, and poses from pixels")
    off = off_mujoco(model, data, K, T_world_cam, rng)
    share = np.array(off["J"]) / K[0, 0]  # differences lose 1e-10 of f, by rounding
    lab.check("|J - differences of MuJoCo's pixels| / f", share, 1e-6)
    lab.check("|refine_pose - MuJoCo's pose|", off["pose"])
    given = given_to_fits(rng)
    yours = {"kabsch": kabsch, "apply_twist": apply_twist,
             "pose_covariance": pose_covariance, "hand_eye": hand_eye}  # fmt: skip
    for name, own in yours.items():
        lab.check(f"{name} - the library's", off_library(name, own, given[name]))

    lab.step(f"4. The error of a pose in mm: {NOISE} px of noise, {NEAR} m away")
    print("            across the view      along the view")
    print("  height  predicted  measured     predicted  measured  inside")
    noise = np.random.default_rng(NOISE_SEED)
    T = se3.make_T(se3.Rz(0.3) @ se3.Rx(2.3), (0.05, 0.02, NEAR))
    noisy = {height: fit_with_noise(height, T, noise) for height in HEIGHTS}
    inside = np.mean([one for one, _ in noisy.values()])
    lab.record("pose", inside, metric="inside_95",
               label="fraction inside the 95 % ellipsoid", seed=NOISE_SEED)  # fmt: skip
    lab.measured("error along the view with 240 px, mm", noisy[day10_mujoco.HEIGHT][1])

    lab.step("5. Hand-eye calibration")
    off, unseen = calibrate(np.random.default_rng(SEED))
    lab.record("hand_eye", off, label="|hand_eye - pose of MuJoCo's camera|",
               seed=SEED)  # fmt: skip
    lab.measured("degrees of freedom of X that joint 7 leaves free", unseen)

    lab.step("6. Side quest: Day 7's cube, from a depth image alone")
    with lab.side_quest():
        off = off_library("icp_step", icp_step, given["icp_step"])
        lab.check("icp_step - the library's", off)
        off = see_the_cube(model, data, K, T_world_cam)
        lab.record(
            "cube_seen", off, label="position error of the cube, mm", seed=SEED + 1
        )
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
