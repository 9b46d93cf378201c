"""Day 10: a camera divides by depth; all else is Day 3 again.

    make day10                      in the clone: sets all up, then runs this
    python src/day10_camera.py      in w2-autonomy/, once that is done

Camera axes x right, y down, z forward. Pixel (0, 0) is the image's corner, (0.5, 0.5)
the middle of its first pixel. Twists (omega; v). Metres, radians, pixels.
"""

import kit  # noqa: F401 (goes on in the kit's own Python)
import mujoco
import numpy as np

from robo47 import camera as library
from robo47 import cli, eye, panda, se3
from robo47.lesson.lab import Lab
from robo47.rotation_log import log_pose, log_rotation
from robo47.screws import exp_screw, skew

import day10_mujoco

SEED = 10  # of where the cube stands, and of guesses
NOISE_SEED = 47  # of the noise alone
NOISE = 0.3  # px, of each corner that is found in a picture
TRIALS = 50  # cubes that are seen without noise
NOISY = 200  # fits with noise
NEAR = 0.8  # m, from the eye to the cube whose pose is fitted
HEIGHTS = (480, 240, 120)  # px, of the pictures it is fitted to; 4 : 3
TURN = 0.17  # rad that a guess is turned wrong
SLIDE = 0.05  # m that it stands beside
STEPS = 10  # of a fit
LOOKS = 8  # poses of the arm from which the eye on its hand looks
FREE = np.array([0.5, 0.05])  # rad about joint 7's axis and m along it: another eye
ABOVE = 0.006  # m above the table: lower points are the table's
STARTS = (-0.5, 0.0, 0.5)  # rad: yaws from which a cloud is fitted
ICP_STEPS = 20
DEMO = 4  # cubes that are found by their depth alone


def rms(x: np.ndarray) -> float:
    """Return the root of the mean square."""
    return np.sqrt(np.mean(np.square(x)))


def camera_matrix(fovy: float, width: float, height: float) -> np.ndarray:
    """Return K, (3, 3), of a camera that sees fovy rad from top to bottom.

    pi / 2 with 200 x 100 pixels: focal length 50, centre (100, 50).
    """
    # region 10.1
    f = height / 2 / np.tan(fovy / 2)
    return np.array([[f, 0, width / 2], [0, f, height / 2], [0, 0, 1]])
    # endregion 10.1


def project(K: np.ndarray, T_cam_world: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return the pixels, (n, 2), at which points of the world, (n, 3), are seen.

    With 10.1's K and T the identity (1, 0, 2) is seen at (125, 50).
    """
    # region 10.2
    p = points @ T_cam_world[:3, :3].T + T_cam_world[:3, 3]
    seen = p @ K.T  # (u z, v z, z)
    return seen[:, :2] / seen[:, 2:]
    # endregion 10.2


def back_project(
    K: np.ndarray, T_world_cam: np.ndarray, pixels: np.ndarray, depth: np.ndarray
) -> np.ndarray:
    """Return the points, (n, 3), seen at pixels, (n, 2); depth, (n,), is along z.

    With 10.1's K and T the identity (125, 50) at depth 2 is (1, 0, 2).
    """
    # region 10.3
    through = np.column_stack([pixels, np.ones(len(pixels))])
    p = depth[:, None] * np.linalg.solve(K, through.T).T
    return p @ T_world_cam[:3, :3].T + T_world_cam[:3, 3]
    # endregion 10.3


def projection_jacobian(K: np.ndarray, p_cam: np.ndarray) -> np.ndarray:
    """Return pixels per twist of what is seen, (n, 2, 6), at points p_cam, (n, 3).

    With 10.1's K at (0, 0, 2): v = (1, 0, 0) gives 25 px, omega = (0, 1, 0) gives 50.
    """
    # region 10.4
    f = K[0, 0]
    x, y, z = p_cam.T
    zero = np.zeros(len(p_cam))
    one = np.ones(len(p_cam))
    by_point = f / z * np.array([[one, zero, -x / z], [zero, one, -y / z]])
    by_point = np.moveaxis(by_point, 2, 0)  # (n, 2, 3)
    return np.concatenate([-by_point @ skew(p_cam), by_point], axis=2)
    # endregion 10.4


def kabsch(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """Return T, (4, 4), that takes the points A best to B, (n, 3) each.

    B = A + (1, 0, 0): a move by that.
    """
    # region 10.5
    a = A.mean(axis=0)
    b = B.mean(axis=0)
    U, _, Vt = np.linalg.svd((B - b).T @ (A - a))
    R = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt
    return se3.make_T(R, b - R @ a)
    # endregion 10.5


def moved(T: np.ndarray, xi: np.ndarray) -> np.ndarray:
    """Return exp([xi]) T, (4, 4), for a twist times time xi, (6,), of any length.

    xi = (0, 0, 0, 1, 0, 0) moves by a metre along x, (0, 0, 0, 0, 0, 0) not at all.
    """
    # region 10.6
    angle = np.linalg.norm(xi[:3])
    theta = angle if angle > 0 else np.linalg.norm(xi[3:])
    return exp_screw(xi / theta, theta) @ T if theta > 0 else T
    # endregion 10.6


def refine_pose(
    K: np.ndarray, T_guess: np.ndarray, points: np.ndarray, pixels: np.ndarray
) -> np.ndarray:
    """Return the pose, (4, 4), at which points, (n, 3), are seen at pixels, (n, 2).

    Ten steps from T_guess, which maps the thing's coordinates to the camera's. A guess
    that is right stays.
    """
    # region 10.6
    T = T_guess
    for _ in range(STEPS):
        p_cam = points @ T[:3, :3].T + T[:3, 3]
        J = projection_jacobian(K, p_cam).reshape(-1, 6)
        off = (pixels - project(K, T, points)).ravel()
        T = moved(T, np.linalg.lstsq(J, off, rcond=None)[0])
    return T
    # endregion 10.6


def pose_covariance(J: np.ndarray, sigma: float) -> np.ndarray:
    """Return the covariance, (6, 6), of a pose fitted to pixels with noise sigma.

    J, (n, 2, 6), is 10.4's at that pose. Three J that are the identity's halves, (3, 2,
    6), with sigma 2: four times the identity.
    """
    # region 10.7
    J = J.reshape(-1, 6)
    return sigma**2 * np.linalg.inv(J.T @ J)
    # endregion 10.7


def hand_eye(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """Return X, (4, 4), with A X = X B for the motions A and B, (k, 4, 4) each.

    B = A: the identity.
    """
    # region 10.8
    a = np.array([log_rotation(T[:3, :3]) for T in A])
    b = np.array([log_rotation(T[:3, :3]) for T in B])
    U, _, Vt = np.linalg.svd(a.T @ b)
    R = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt
    C = (A[:, :3, :3] - np.eye(3)).reshape(-1, 3)
    d = (B[:, :3, 3] @ R.T - A[:, :3, 3]).ravel()
    return se3.make_T(R, np.linalg.lstsq(C, d, rcond=None)[0])
    # endregion 10.8


def icp_step(T: np.ndarray, source: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Return a better T, (4, 4), of the points source, (n, 3), to target, (m, 3).

    Each, moved by T, is paired with the nearest of target. Of a cloud to itself: 1.
    """
    # region 10.9
    now = source @ T[:3, :3].T + T[:3, 3]
    away = np.linalg.norm(now[:, None] - target, axis=2)
    return kabsch(source, target[np.argmin(away, axis=1)])
    # endregion 10.9


def guesses(T: np.ndarray, n: int, rng: np.random.Generator) -> np.ndarray:
    """Return n poses beside T, turned by about TURN and SLIDE away, (n, 4, 4)."""
    size = np.repeat([TURN, SLIDE], 3) / np.sqrt(3)
    off = [library.moved(np.eye(4), xi) for xi in size * rng.normal(size=(n, 6))]
    turned = np.array(off)[:, :3, :3] @ T[:3, :3]
    return se3.make_T(turned, np.array(off)[:, :3, 3] + T[:3, 3])


def off_library(rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Return how far your fits are from robo47's, by function: MuJoCo knows no fits."""
    A = rng.normal(size=(9, 3))
    B = A + rng.normal(scale=0.1, size=A.shape)
    J = rng.normal(size=(8, 2, 6))
    T = guesses(np.eye(4), 1, rng)[0]
    flat = np.array([1.0, 1.0, 0.0])
    mirror = np.array([1.0, 1.0, -1.0])
    given = {
        "kabsch": [(A, B), (flat * A, flat * B), (A, mirror * A)],
        "moved": [(T, rng.normal(size=6)), (T, 2.0 * np.eye(6)[4]), (T, np.zeros(6))],
        "pose_covariance": [(J, NOISE)],
        "icp_step": [(T, A, B)],
    }
    own = {"kabsch": kabsch, "moved": moved, "pose_covariance": pose_covariance,
           "icp_step": icp_step}  # fmt: skip
    return {
        name: np.array([own[name](*one) - getattr(library, name)(*one) for one in some])
        for name, some in given.items()
    }


def same_cube(model, data, rng: np.random.Generator) -> tuple[list, list]:
    """Return how far corners are seen beside MuJoCo's, px, and fits beside the truth."""
    seen, poses = [], []
    for T_world_cube in day10_mujoco.cubes(TRIALS, SEED):
        day10_mujoco.place(model, data, T_world_cube)
        mujoco.mj_forward(model, data)  # fills sensordata: what camprojection sees
        K, T_world_cam = eye.camera(model, data, "eye")
        T_cam_world = se3.inverse(T_world_cam)
        corners = day10_mujoco.CORNERS @ T_world_cube[:3, :3].T + T_world_cube[:3, 3]
        truth = day10_mujoco.corners_seen(model, data)
        seen.append(project(K, T_cam_world, corners) - truth)
        T_cam_cube = T_cam_world @ T_world_cube
        guess = guesses(T_cam_cube, 1, rng)[0]
        fitted = refine_pose(K, guess, day10_mujoco.CORNERS, truth)
        poses.append(fitted - T_cam_cube)
    return seen, poses


def noisy_fits(K: np.ndarray, T: np.ndarray, rng) -> tuple[np.ndarray, ...]:
    """Return fits to noisy corners of a cube at T: their errors, and what is predicted.

    Twists away from T, (n, 6), places beside T's, m, (n, 3); sigma of both, as
    covariances (6, 6) and (3, 3).
    """
    exact = project(K, T, day10_mujoco.CORNERS)
    p_cam = day10_mujoco.CORNERS @ T[:3, :3].T + T[:3, 3]
    C = pose_covariance(projection_jacobian(K, p_cam), NOISE)
    to_place = np.hstack([-skew(T[:3, 3]), np.eye(3)])  # v + omega x p of the cube
    fits = [
        refine_pose(K, T, day10_mujoco.CORNERS, exact + noise)
        for noise in NOISE * rng.normal(size=(NOISY, 8, 2))
    ]
    twists = np.array([log_pose(fit @ se3.inverse(T)) for fit in fits])
    places = np.array([fit[:3, 3] - T[:3, 3] for fit in fits])
    return twists, places, C, to_place @ C @ to_place.T


def same_all_along(A: np.ndarray, B: np.ndarray, X: np.ndarray) -> float:
    """Return the residual |A X - X B|, the largest entry."""
    return np.abs(A @ X - X @ B).max()


def main() -> int:
    """Run the lab from top to bottom; return 0 when every check passed."""
    lab = Lab(__file__, __doc__)
    rng = np.random.default_rng(SEED)
    model, data = day10_mujoco.table()
    print(f"an eye of {day10_mujoco.WIDTH} x {day10_mujoco.HEIGHT} pixels, a table, "
          "and Day 7's cube")

    lab.step("1. Where a point is seen")
    seen, poses = same_cube(model, data, rng)
    K, T_world_cam = eye.camera(model, data, "eye")
    fovy = np.deg2rad(model.cam_fovy[0])
    own_K = camera_matrix(fovy, *model.cam_resolution[0])
    lab.check("|camera_matrix - MuJoCo's camera|, px", own_K - K)
    lab.record("project", seen, label="|project - MuJoCo's camprojection|, px",
               seed=SEED)  # fmt: skip
    return lab.finish()


if __name__ == "__main__":
    cli.run(main)
