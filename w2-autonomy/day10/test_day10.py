"""Day 10: the numbers in the guide's sentences, and every reason in it."""

import re
import textwrap
from unittest.mock import patch

import mujoco
import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from robo47 import camera, depth_camera, panda, se3
from robo47.rotation_log import log_rotation
from robo47.screws import skew

import day10_mujoco

SENTENCES = sentences(10)
lab = load_script(ROOT / "w2-autonomy/src/day10_camera.py")
model, data = day10_mujoco.table()
mujoco.mj_forward(model, data)
K, T_world_cam = depth_camera.camera(model, data, "eye")
T_cam_world = se3.inverse(T_world_cam)
CORNERS = day10_mujoco.CORNERS
F = K[0, 0]


def held(z=lab.NEAR, wide=1.0):
    """Return the lab's cube of step 4 at a depth, and its corners."""
    way = np.array([0.05, 0.02, lab.NEAR]) / lab.NEAR
    return se3.make_T(se3.Rz(0.3) @ se3.Rx(2.3), z * way), wide * CORNERS


def in_camera(T, points):
    """Return points in the camera's axes."""
    return points @ T[:3, :3].T + T[:3, 3]


def sigmas(T, corners, slopes=camera.projection_jacobian):
    """Return sigma of the cube's place, mm, (3,), and of the twist's v, mm, (3,)."""
    C = camera.pose_covariance(slopes(K, in_camera(T, corners)), lab.NOISE)
    at_cube = np.hstack([-skew(T[:3, 3]), np.eye(3)])
    both = (np.diag(at_cube @ C @ at_cube.T), np.diag(C)[3:])
    return tuple(1000 * np.sqrt(one) for one in both)


def one_z_too_few(K, p):
    """Return J with 1 / z for 1 / z^2 in its third column."""
    x, y, z = p.T
    zero = 0 * z
    rows = F / z * np.array([[1 + zero, zero, -x], [zero, 1 + zero, -y]])
    by_point = np.moveaxis(rows, 2, 0)
    return np.concatenate([-by_point @ skew(p), by_point], axis=2)


def fitted(
    T,
    points,
    pixels,
    *,
    slopes=camera.projection_jacobian,
    move=camera.apply_twist,
    n=10,
):
    """Return a fit by other slopes or steps; also behind the camera."""
    for _ in range(n):
        p = in_camera(T, points)
        off = pixels - (p @ K.T)[:, :2] / p[:, 2:]
        J = slopes(K, p).reshape(-1, 6)
        T = move(T, np.linalg.lstsq(J, off.ravel(), rcond=None)[0])
    return T


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    told = {"error from half a pixel in u and v, mm": "2.3",
            "error along the view with 240 px, mm": "8",
            "degrees of freedom of X that joint 7 leaves free": "2"}  # fmt: skip
    return printed_by(lab, told)


@pytest.fixture(scope="module")
def looks():
    """Return the lab's looks by all joints, by joint 7 alone, and the fresh ones."""
    away = np.random.default_rng(lab.SEED).uniform(-0.5, 0.5, (2, lab.LOOKS, 7))
    arm = day10_mujoco.handheld()
    seven = away[0] * np.eye(7)[6]
    all_of = [away[0], seven, away[1]]
    return [day10_mujoco.looks(arm, panda.READY_Q + q) for q in all_of]


def test_three_predictions_of_the_worksheet_stand_beside_what_is_measured(printed):
    sheet = (ROOT / "w2-autonomy/docs/day10.md").read_text("utf-8")
    for yours, found in (("2.3", "2.3"), ("8", "8.9"), ("2", "2")):
        row = rf"you predicted {yours}, measured ([\d.]+):\s+([^\n]+)"
        measured, name = re.search(row, printed).groups()
        assert round(float(measured), len(found) - 2 if "." in found else 0) == float(
            found
        )
        assert f"| {name}" in sheet


def test_what_the_opening_promises_is_what_the_lab_prints(printed):
    off = [float(x) for x in re.findall(r"points: ([\d.]+) mm from", printed)]
    mean = re.findall(r"their mean: ([\d.]+) mm", printed)
    assert f"cube to {max(off)} mm, without any information" in SENTENCES
    assert f"measures on the cube is wrong by {max(mean)} mm" in SENTENCES
    aside = re.search(r"middle is (\d+) mm from", printed)[1]
    assert f"the target is {aside} mm from its true position" in SENTENCES
    alone = re.search(r"joint 7 alone +0\.00 +2 +(\S+)\n", printed)[1]
    assert float(alone) < 1e-15


def test_k_is_a_triangle_and_the_docstrings_point_is_at_125():
    known = camera.camera_matrix(np.pi / 2, 200, 100)
    assert np.allclose(known, [[50, 0, 100], [0, 50, 50], [0, 0, 1]])
    found = camera.project(known, np.eye(4), [[1.0, 0, 2]])[0]
    assert found == pytest.approx([125, 50])
    J = camera.projection_jacobian(known, [[0.0, 0, 2]])[0]
    assert J[:, 3] == pytest.approx([25, 0])
    assert J[:, 1] == pytest.approx([50, 0])
    assert J[:, 5] == pytest.approx(0)  # in the middle depth does not show
    assert f"f = {F:.0f} px" in SENTENCES


def test_half_a_pixel_is_z_over_f_and_grows_with_the_distance(printed):
    far = np.linalg.norm(day10_mujoco.TO - day10_mujoco.AT)
    assert f"hangs {far:.3f} m from the middle" in SENTENCES
    words = f"z / f = 955 / 290 = {1000 * far / F:.1f} mm, so the error is 2.33 mm"
    assert words in SENTENCES
    assert "half a pixel in u and v is 2.3 mm (RMS)" in printed
    for z in (far, 2 * far):
        pixels = np.array([[160.0, 120.0], [160.5, 120.5]])
        a, b = camera.back_project(K, T_world_cam, pixels, np.full(2, z))
        assert np.linalg.norm(b - a) == pytest.approx(z / F * np.sqrt(0.5))


def test_what_each_mistake_of_step_1_looks_like_over_the_image():
    places = day10_mujoco.cubes(lab.TRIALS, lab.SEED)
    points = np.concatenate([in_camera(T_cam_world @ T, CORNERS) for T in places])
    right = camera.project(K, np.eye(4), points)
    centre = K[:2, 2]
    from_middle = right - centre
    half = r"principal point \(width - 1\) / 2, \(height - 1\) / 2, as in OpenCV"
    swapped = "the two coordinates of the principal point swapped"
    wrong = {
        half: right - 0.5,
        swapped: from_middle + centre[::-1],
        "no principal point": from_middle,
        "f from the width": from_middle * 320 / 240 + centre,
        "y upwards instead of downwards": from_middle * [1, -1] + centre,
    }
    for name, pixels in wrong.items():
        off = np.linalg.norm(pixels - right, axis=1)
        cells = re.search(rf"\| {name} \| ([\d.]+) \| ([\d.]+) \|", SENTENCES).groups()
        for cell, value in zip(cells, (off.min(), off.max()), strict=True):
            digits = len(cell.partition(".")[2])
            assert f"{value:.{digits}f}" == cell
    assert f"0.707 / f = {np.degrees(np.sqrt(0.5) / F):.2f} degrees" in SENTENCES
    growing = np.linalg.norm(wrong["f from the width"] - right, axis=1)
    away = np.linalg.norm(from_middle, axis=1)
    assert growing == pytest.approx(away / 3)  # zero in the middle, growing outwards


def test_range_for_depth_is_right_in_the_middle_and_there_alone():
    day10_mujoco.place(model, data, day10_mujoco.ASIDE)
    mujoco.mj_forward(model, data)
    depth = depth_camera.depth(model, data, "eye").ravel()
    hit = np.isfinite(depth)
    pixels = depth_camera.pixel_centres(day10_mujoco.WIDTH, day10_mujoco.HEIGHT)[hit]
    assert depth.size == 76_800
    through = np.column_stack([pixels, np.ones(len(pixels))])
    length = np.linalg.norm(np.linalg.solve(K, through.T), axis=0)
    off = 1000 * depth[hit] * (length - 1)  # range is depth times that length
    away = np.linalg.norm(pixels - K[:2, 2], axis=1)
    assert f"the error is only {off[np.argmin(away)]:.3f} mm at the centre" in SENTENCES
    at_150 = off[np.abs(away - 150) < 5].mean()
    assert f"At 150 px from the centre the error is {at_150:.0f} mm" in SENTENCES


def test_right_exponential_never_arrives_and_one_z_too_few_does_at_the_table():
    rng = np.random.default_rng(lab.SEED)
    left, right, few, off, depths = [], [], [], [], []
    for T_world_cube in day10_mujoco.cubes(50, lab.SEED):
        T = T_cam_world @ T_world_cube
        pixels = camera.project(K, T, CORNERS)
        guess = lab.guesses(T, 1, rng)[0]
        p = in_camera(T, CORNERS)
        off.append(one_z_too_few(K, p) - camera.projection_jacobian(K, p))
        left.append(fitted(guess, CORNERS, pixels) - T)
        few.append(fitted(guess, CORNERS, pixels, slopes=one_z_too_few) - T)
        depths.append(T[2, 3])
        with np.errstate(all="ignore"):
            try:
                body = fitted(
                    guess,
                    CORNERS,
                    pixels,
                    move=lambda T, xi: T @ camera.apply_twist(np.eye(4), xi),
                )
            except (ValueError, np.linalg.LinAlgError):
                body = np.full((4, 4), np.inf)
        right.append(body - T)
    worst = [np.abs(one).max(axis=(1, 2)) for one in (left, right, few)]
    assert [np.sum(one < 1e-8) for one in worst] == [50, 0, 50]
    assert "none of 50 fits converges" in SENTENCES
    assert "50 of 50 fits still converge" in SENTENCES
    assert worst[0].max() < 1e-14
    assert f"by up to {np.abs(off).max():.0f} px" in SENTENCES
    most = f"{worst[2].max():.0e}".replace("e-0", "e-")
    assert f"with errors of {most} instead of" in SENTENCES
    assert f"are {min(depths):.2f} to {max(depths):.2f} m from the camera" in SENTENCES


def depth_error_factor(z, slopes):
    """Return by which factor one step multiplies a small error of the depth."""
    T = se3.make_T(se3.Rz(0.3) @ se3.Rx(2.3), (0.05, 0.02, z))
    guess = T.copy()
    guess[2, 3] += 1e-5
    off = fitted(guess, CORNERS, camera.project(K, T, CORNERS), slopes=slopes, n=1) - T
    return off[2, 3] / 1e-5


def test_one_z_too_few_multiplies_the_depth_error_by_one_less_one_over_z():
    measured = {z: depth_error_factor(z, one_z_too_few) for z in (0.4, 0.8, 1.0, 2.0)}
    for z, factor in measured.items():
        assert factor == pytest.approx(1 - 1 / z, abs=0.02)
        assert abs(depth_error_factor(z, camera.projection_jacobian)) < 1e-2
    near, lab_s, one, far = (f"{measured[z]:.2f}" for z in measured)
    one = one.removeprefix("-")  # -0.002
    assert f"are {lab_s} at 0.8 m, {one} at 1 m, {far} at 2 m and {near}" in SENTENCES
    assert abs(depth_error_factor(0.45, one_z_too_few)) > 1
    assert abs(depth_error_factor(0.55, one_z_too_few)) < 1


def arrivals(z, slopes=one_z_too_few):
    """Return how many of 50 fits end within 1e-8 and 1 mm, by draw, (12, 2)."""
    T = se3.make_T(se3.Rz(0.3) @ se3.Rx(2.3), (0.05, 0.02, z))
    pixels = camera.project(K, T, CORNERS)
    found = []
    for seed in range(12):
        off = []
        for guess in lab.guesses(T, 50, np.random.default_rng(seed)):
            try:
                off.append(np.abs(fitted(guess, CORNERS, pixels, slopes=slopes) - T))
            except (ValueError, np.linalg.LinAlgError):  # it ran away to infinity
                off.append(np.full((4, 4), np.inf))
        worst = np.nan_to_num(np.array(off), nan=np.inf).max(axis=(1, 2))
        found.append([np.sum(worst < limit) for limit in (1e-8, 1e-3)])
    return np.array(found)


@pytest.mark.kit
@pytest.mark.parametrize("z", [0.4, 0.5, 0.8, 1.0, 2.0])
def test_how_many_fits_with_one_z_too_few_arrive_depends_on_the_distance(z):
    with np.errstate(all="ignore"):
        counts = arrivals(z)
    cells = []
    for least, most in zip(counts.min(axis=0), counts.max(axis=0), strict=True):
        cells.append(f"{least}" if least == most else f"{least} to {most}")
    assert f"| {z} | {cells[0]} of 50 | {cells[1]} of 50 |" in SENTENCES
    if z >= 0.8:
        assert (arrivals(z, camera.projection_jacobian)[:, 0] == 50).all()


@pytest.mark.kit
def test_the_lines_of_the_exercise_print_its_table(capsys):
    guide = (ROOT / "w2-autonomy/docs/day10-lab.md").read_text("utf-8")
    lines = re.search(r"```python\n(    for z in .*?)```", guide, re.DOTALL)[1]
    names = {**vars(lab), "K": K, "rng": np.random.default_rng(10)}
    with (
        patch.object(lab, "projection_jacobian", one_z_too_few),
        np.errstate(all="ignore"),
    ):
        exec(textwrap.dedent(lines), names)
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert [row[0] for row in rows] == ["0.4", "0.5", "0.8", "1.0", "2.0"]
    assert [row[1] for row in rows[3:]] == ["50", "0"]
    assert [row[2] for row in rows[2:]] == ["50", "50", "50"]


def digits_per_step(noise):
    """Return the median of the digits that steps 4 and 5 gain, of twelve draws."""
    T, corners = held()
    gained = []
    for seed in range(12):
        rng = np.random.default_rng(seed)
        guess = lab.guesses(T, 1, rng)[0]
        exact = camera.project(K, T, corners)
        pixels = exact + noise * rng.normal(size=exact.shape)
        limit = fitted(T, corners, pixels, n=40)
        fits = [fitted(guess, corners, pixels, n=n) - limit for n in (3, 4, 5)]
        gained += [*-np.diff(np.log10([np.abs(fit).max() for fit in fits]))]
    return np.median(gained)


def test_gauss_newton_doubles_its_digits_without_noise_alone():
    few, many = digits_per_step(0.3), digits_per_step(2.0)
    words = f"adds only {few:.1f} digits, and with 2 px it adds {many:.1f} digit"
    assert words in SENTENCES
    T, corners = held()
    pixels = camera.project(K, T, corners)
    for guess in lab.guesses(T, 12, np.random.default_rng(lab.SEED)):
        off = [np.abs(fitted(guess, corners, pixels, n=n) - T).max() for n in (1, 2, 3)]
        assert off[2] < 20 * off[1] ** 2 + 1e-13  # quadratic: twice the digits


def test_a_pose_absorbs_half_a_pixel_of_the_principal_point():
    T, corners = held()
    pixels = camera.project(K, T, corners) + 0.5
    fit = fitted(T, corners, pixels, n=30)
    left = lab.rms(np.linalg.norm(camera.project(K, fit, corners) - pixels, axis=1))
    left /= np.sqrt(2)  # per coordinate
    turned = np.degrees(np.linalg.norm(log_rotation(fit[:3, :3] @ T[:3, :3].T)))
    assert f"is rotated by {turned:.2f}° from the true one" in SENTENCES
    assert (
        f"pixel errors have a root mean square (RMS) of only {left:.4f} px" in SENTENCES
    )
    assert "in every pixel, the principal point is probably wrong" in SENTENCES


def by_joints(joints, seed=lab.SEED):
    """Return motions of hand and camera when only some joints turn, from 1 on."""
    away = np.random.default_rng(seed).uniform(-0.5, 0.5, (lab.LOOKS, 7))
    turning = np.isin(np.arange(1, 8), joints)
    arm = day10_mujoco.handheld()
    return lab.motions(day10_mujoco.looks(arm, panda.READY_Q + away * turning))


def singular_values(A):
    """Return the singular values of the rotation vectors, (3,)."""
    return np.linalg.svd([log_rotation(T[:3, :3]) for T in A], compute_uv=False)


@pytest.mark.parametrize("joints", [(2, 4), (1, 7)])
def test_parallel_axes_leave_one_number_free_and_a_residual_with_exact_data(joints):
    worst = []
    for seed in range(10, 22):
        A, B = by_joints(joints, seed)
        assert lab.free(A) == 1
        assert singular_values(A)[1] < 1e-9
        at = day10_mujoco.ON_HAND
        assert np.abs(A @ at - at @ B).max() < 1e-14  # the data are exact
        X = camera.hand_eye(A, B)
        worst.append(np.abs(A @ X - X @ B).max())
    assert 0.01 < np.median(worst) < 1
    assert "a residual of the order of 0.1 with exact data" in SENTENCES
    assert "leave only one degree of freedom undetermined" in SENTENCES


def test_axes_lie_in_one_plane_only_if_each_motion_turns_one_joint():
    both = singular_values(by_joints((6, 7))[0])
    assert both[2] > 0.01
    apart = np.concatenate([by_joints((6,))[0], by_joints((7,))[0]])
    assert singular_values(apart)[2] < 1e-9


def test_108_mm_follow_from_the_distance_to_the_axis():
    hands, _ = day10_mujoco.looks(day10_mujoco.handheld(), panda.READY_Q[None])
    middle = se3.inverse(hands[0]) @ np.append(day10_mujoco.TO, 1.0)
    far = 1000 * np.hypot(*middle[:2])
    chord = 2 * far * np.sin(lab.FREE[2] / 2)
    assert f"is {far:.0f} mm from the axis of joint 7" in SENTENCES
    assert rf"\sin 0.25 = {chord:.1f}$ mm" in SENTENCES
    assert round(np.hypot(chord, 1000 * lab.FREE[5])) == 108


def test_the_trace_s_bound_for_reflections_is_that_of_the_smallest_singular_value():
    rng = np.random.default_rng(lab.SEED)
    for _ in range(200):
        s = np.sort(rng.uniform(0, 2, 3))[::-1]
        Q = -se3.quat_to_R(rng.normal(size=4))  # determinant -1
        assert np.trace(Q * s) <= s[0] + s[1] - s[2] + 1e-12


@pytest.mark.kit
def test_with_noise_the_wrong_jacobian_fits_as_well_and_its_covariance_is_wrong():
    T, corners = held()
    exact = camera.project(K, T, corners)
    rng = np.random.default_rng(lab.NOISE_SEED)
    both = []
    for pixels in exact + lab.NOISE * rng.normal(size=(100, 8, 2)):
        right = fitted(T, corners, pixels)
        wrong = fitted(T, corners, pixels, slopes=one_z_too_few, n=30)
        both.append([right[2, 3] - T[2, 3], wrong[2, 3] - T[2, 3]])
    right, wrong = 1000 * np.sqrt(np.mean(np.square(both), axis=0))
    assert right == pytest.approx(wrong, rel=0.02)
    told = sigmas(T, corners, one_z_too_few)[0][2]
    words = f"predicts {told:.1f} mm instead of {sigmas(T, corners)[0][2]:.1f} mm"
    assert words in SENTENCES
    assert f"along the optical axis is {right:.1f} mm with both" in SENTENCES


def test_the_ellipse_along_the_view_grows_with_z_squared_over_f_w():
    near = sigmas(*held())
    far = sigmas(*held(2 * lab.NEAR))
    large = sigmas(*held(wide=2.0))
    assert f"At 1.6 m the standard deviation is {far[0][2]:.1f} mm" in SENTENCES
    assert far[0][2] / near[0][2] == pytest.approx(4, rel=0.01)
    assert f"For the cube of 80 mm it is {large[0][2]:.1f}" in SENTENCES
    assert near[0][2] / large[0][2] == pytest.approx(2, rel=0.01)
    assert 2 < far[0][0] / near[0][0] < 4
    across, _, along = near[0]
    assert f"is {across:.1f} mm across the optical axis and {along:.1f} mm" in SENTENCES
    words = f"obtain {near[1][0]:.1f} mm instead of {near[0][0]:.1f} mm across"
    assert words in SENTENCES
    width = 1000 * lab.NEAR**2 / F / 0.04
    assert f"= {width:.0f} mm along" in SENTENCES
    assert f"z / f = {1000 * lab.NEAR / F:.1f} mm across it" in SENTENCES
    assert f"f w / z = {F * 0.04 / lab.NEAR:.1f} px" in SENTENCES


@pytest.mark.kit
def test_far_away_fewer_fits_lie_inside_because_the_noise_is_not_small(capsys):
    T, _ = held(2 * lab.NEAR)
    T[:2, 3] /= 2  # where NEAR alone puts it
    inside = {}
    for noise in (lab.NOISE, lab.NOISE / 10):
        rng = np.random.default_rng(lab.NOISE_SEED)
        with patch.object(lab, "NOISE", noise):
            inside[noise] = [lab.fit_with_noise(n, T, rng)[0] for n in lab.HEIGHTS]
    _, middle, small = (f"{np.mean(one):.0%}" for one in inside[lab.NOISE])
    words = f"{middle} for an image height of 240 px, and to {small} for 120"
    words = words.replace("%", " %")
    assert words in SENTENCES
    _, *back = (f"{np.mean(one):.0%}" for one in inside[lab.NOISE / 10])
    assert back == ["94%", "94%"]
    assert f"cube is only {F / 2 * 0.04 / T[2, 3]:.1f} px wide" in SENTENCES
    capsys.readouterr()


def test_joint_7_alone_leaves_two_numbers_free_and_the_residual_knows_nothing(looks):
    many, seven, fresh = looks
    assert [lab.free(lab.motions(one)[0]) for one in (many, seven)] == [0, 2]
    A, B = lab.motions(seven)
    for turn, slide in ((0.5, 0.0), (0.0, 0.05), (0.5, 0.05), (1.0, 0.05)):
        xi = np.array([0, 0, turn, 0, 0, slide])
        X = camera.apply_twist(day10_mujoco.ON_HAND, xi)
        assert np.abs(A @ X - X @ B).max() < 2e-15
        assert lab.wanders(*seven, X) < 1e-9
        assert lab.wanders(*fresh, X) > 30
    for axis in np.delete(np.eye(6), [2, 5], axis=0):  # no other twist is free
        X = camera.apply_twist(day10_mujoco.ON_HAND, 0.05 * axis)
        assert np.abs(A @ X - X @ B).max() > 1e-3


def test_the_target_that_stands_still_stands_beside_its_place(looks, printed):
    _, seven, fresh = looks
    X = camera.apply_twist(day10_mujoco.ON_HAND, lab.FREE)
    assert lab.wanders(*seven, X) < 1e-9
    assert f"it moves by {lab.wanders(*fresh, X):.0f} mm" in SENTENCES
    beside = 1000 * np.linalg.norm(lab.said(*seven, X) - day10_mujoco.TO, axis=1)
    assert np.ptp(beside) < 1e-9
    assert f"It is {beside[0]:.0f} mm from its true position" in SENTENCES
    assert "it is wrong by 29° and 59 mm" in SENTENCES
    row = re.search(r"another X +0\.00 +2 +\S+ +([\d.]+) +([\d.]+)", printed).groups()
    assert [round(float(x)) for x in row] == [29, 59]


def test_a_little_of_joint_6_frees_nothing_and_is_not_enough_with_noise(looks):
    away = np.random.default_rng(lab.SEED).uniform(-0.5, 0.5, (2, lab.LOOKS, 7))
    arm = day10_mujoco.handheld()
    typical, residual = [], []
    for degrees in (1, 5, 20):
        q = away[0] * np.eye(7)[6]
        q[:, 5] = np.radians(degrees) * np.linspace(-1, 1, lab.LOOKS)
        some = day10_mujoco.looks(arm, panda.READY_Q + q)
        A, B = lab.motions(some)
        assert lab.free(A) == 0
        exact = camera.hand_eye(A, B)
        assert 1000 * np.abs(exact - day10_mujoco.ON_HAND).max() < 1e-9
        rng = np.random.default_rng(lab.NOISE_SEED)
        off = []
        for _ in range(20):
            A, B = lab.motions((some[0], lab.jittered(some[1], rng)))
            X = camera.hand_eye(A, B)
            off.append(1000 * np.linalg.norm((X - day10_mujoco.ON_HAND)[:3, 3]))
            residual.append(np.abs(A @ X - X @ B).max())
        typical.append(np.median(off))
    one, five, twenty = typical
    assert f"typically about {one:.0f} mm and" in SENTENCES
    assert f"With 5 degrees it is {five:.0f} mm" in SENTENCES
    assert f"with 20 degrees {twenty:.1f} mm" in SENTENCES
    assert 2e-3 < np.median(residual) < 4e-3


def test_the_mean_of_the_points_is_off_because_far_sides_are_not_seen():
    T = se3.make_T(se3.Rz(0.3), (0.5, 0.0, day10_mujoco.CUBE_HEIGHT))
    off = []
    for at in (day10_mujoco.AT, (0.5001, 0.0, 1.15)):
        with patch.object(day10_mujoco, "AT", np.array(at)):
            m, d = day10_mujoco.table()
        day10_mujoco.place(m, d, T)
        mujoco.mj_forward(m, d)
        cloud = lab.depth_cloud(m, d, *depth_camera.camera(m, d, "eye"))
        cloud = cloud[cloud[:, 2] > day10_mujoco.TABLE + lab.ABOVE]
        off.append(1000 * np.linalg.norm(cloud.mean(axis=0)[:2] - T[:2, 3]))
    assert f"the mean of its points is wrong by {off[0]:.1f} mm" in SENTENCES
    assert off[1] < 0.1


@pytest.mark.kit
def test_three_yaws_are_needed_since_the_nearest_points_find_the_next_hollow():
    worst = []
    for starts in (lab.STARTS, (0.0,)):
        off = []
        with patch.object(lab, "STARTS", starts):
            for T_world_cube in day10_mujoco.cubes(20, lab.SEED + 1):
                day10_mujoco.place(model, data, T_world_cube)
                cloud = lab.depth_cloud(model, data, K, T_world_cam)
                cloud = cloud[cloud[:, 2] > day10_mujoco.TABLE + lab.ABOVE]
                R = T_world_cube[:3, :3].T @ lab.found(cloud)[:3, :3]
                yaw = np.degrees(np.arctan2(R[1, 0], R[0, 0]))
                off.append(abs((yaw + 45) % 90 - 45))  # a cube has four of them
        worst.append(max(off))
    three, one = worst
    words = (
        f"is {one:.0f} degrees with one initial yaw angle, "
        f"and {three:.0f} degrees with three"
    )
    assert words in SENTENCES


def mirrored(second: float) -> float:
    """Return in which share of calibrations U V^T is a mirror image.

    Args:
        second: how far the axes stand out of one plane: 0 for two joints.
    """
    rng = np.random.default_rng(3)
    found = []

    def measured(T):
        noise = 1e-3 * rng.normal(size=(len(T), 6))
        return T @ np.array([camera.apply_twist(np.eye(4), xi) for xi in noise])

    for _ in range(100):
        turns = rng.normal(size=(8, 6)) * [1, 1, second, 0, 0, 0]
        A = np.array([camera.apply_twist(np.eye(4), xi) for xi in turns])
        X = se3.make_T(se3.quat_to_R(rng.normal(size=4)), np.zeros(3))
        pair = measured(A), measured(se3.inverse(X) @ A @ X)
        a, b = (log_rotation(some[:, :3, :3]) for some in pair)
        found.append(np.linalg.det(a.T @ b) < 0)
    return float(np.mean(found))


@pytest.mark.kit
def test_axes_in_one_plane_are_as_likely_a_mirror_as_not_and_others_are_none():
    assert "is then a reflection in half of all cases" in SENTENCES
    assert 0.4 < mirrored(0.0) < 0.6
    assert mirrored(1.0) == 0.0


def test_the_lab_s_slopes_have_a_focal_length_of_their_own_for_each_row():
    K = np.array([[300.0, 0, 10], [0, 250, 20], [0, 0, 1]])
    rows = [[1.5, 303, 15, 150, 0, -15], [-250.625, -1.25, 25, 0, 125, 6.25]]
    for slopes in (camera.projection_jacobian, lab.projection_jacobian):
        off = slopes(K, np.array([[0.2, -0.1, 2.0]]))[0] - rows
        assert np.abs(off).max() < 1e-12
