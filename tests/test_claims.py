"""A sentence about all inputs is said only where it holds at inputs not asked."""

import re

import inprocess
import numpy as np
import pytest

from labkit.base.exchange import Reply
from labkit.judge import judge, near_miss
from labkit.judge.ask import asked_of
from labkit.judge.row import row_of
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of, read_script

pytestmark = pytest.mark.kit


def told(number, task, **instead):
    """Return what a wrong function of a day is told; the others are the lab's."""
    day = find_day(number)
    verdict = inprocess.verdicts(day, day.source, task, instead=instead)[task]
    assert verdict.status in ("wrong", "close")
    return verdict.message


def right(number, name):
    return getattr(lab_of(find_day(number)), name)


def test_a_lost_sign_is_not_right_whenever_one_entry_is_not_0():
    def impedance_wrench(e, V_err, K, D):
        return K @ np.abs(e) + D @ V_err

    assert "only one entry" not in told(6, "6.5", impedance_wrench=impedance_wrench)


def test_a_clipped_step_is_not_right_whenever_damping_is_1():
    def dls_step(J, e, damping):
        return np.clip(right(3, "dls_step")(J, e, damping), -0.5, 0.5)

    says = told(3, "3.5", dls_step=dls_step)
    assert "whenever" not in says


def test_a_rounded_quaternion_is_not_right_whenever_one_entry_is_not_0():
    def quat_to_R(quat):
        return right(1, "quat_to_R")(np.round(quat, 2))

    assert "whenever" not in told(1, "1.4", quat_to_R=quat_to_R)


def test_a_constant_that_is_a_little_off_is_no_wrong_sign():
    def dls_step(J, e, damping):
        if damping < 1e-2:
            return np.linalg.pinv(J) @ e
        return right(3, "dls_step")(J, e, damping)

    assert "sign" not in told(3, "3.5", dls_step=dls_step)


def test_what_comes_near_in_all_columns_is_not_right_up_to_one():
    def space_jacobian(screws, q):
        def turned(q):
            return right(2, "fk_space")(screws, np.eye(4), q)

        T = turned(q)
        J = np.zeros((6, 7))
        for i, step in enumerate(1e-4 * np.eye(7)):
            W = (turned(q + step) - T) / 1e-4 @ np.linalg.inv(T)
            J[:, i] = [W[2, 1], W[0, 2], W[1, 0], *W[:3, 3]]
        return J

    says = told(3, "3.1", space_jacobian=space_jacobian)
    assert "right up to" not in says
    # Entries that should be 0 have no relative error that is small.
    assert "Every error is below 1 % of the largest entry." in says
    assert "relative" not in says


@pytest.mark.parametrize(
    ("error", "says"),
    [
        (np.array([0.5, -0.005, 0.0]), "All relative errors are below 1 %."),
        (np.array([0.5, -0.05, 0.0]), "Every error is below 1 % of the largest entry."),
        (np.array([0.5, 0.0, 1e-4]), "Every error is below 1 % of the largest entry."),
        (np.array([5.0, 0.0, 0.0]), ""),
    ],
)
def test_an_error_is_relative_only_where_each_entry_is_compared_with_itself(
    error, says
):
    T = np.array([[100.0, -1.0, 1e-5], [200.0, 3.0, 2e-5], [90.0, 2.0, -1e-5]])
    S = T + error * np.array([[1.0], [1.9], [0.7]])
    assert near_miss.in_common(S, T).strip().startswith(says)
    assert says or not near_miss.in_common(S, T)


def test_of_the_other_answers_those_that_are_wrong_are_counted():
    def make_T(R, t):
        if t[0] == 1:
            raise ValueError(t)
        T = right(1, "make_T")(R, t)
        T[2, 3] += 0.3 * (t[2] > 0)
        return T

    says = told(1, "1.1", make_T=make_T)
    also = r"The result is also wrong in \d+ of the other \d+ calls\."
    assert re.search(also, says)


def test_a_range_is_said_where_an_angle_has_one():
    def Rz(theta):
        return right(1, "Rz")(theta % np.pi)

    says = told(1, "1.2", Rz=Rz)
    assert "whenever `theta`" not in says
    assert "The result is correct for `0 <= theta < pi`." in says


def test_a_small_angle_s_own_formula_never_passes_by_chance():
    def Rz(theta):
        c, s = np.cos(theta), np.sin(theta)
        c = 1.0 if abs(theta) < 0.1 else c
        return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])

    day = find_day(1)
    for seed in range(3):
        verdict = inprocess.verdicts(day, day.source, "1.2", seed, {"Rz": Rz})["1.2"]
        assert verdict.status == "wrong"


def test_a_joint_wrapped_to_pi_leaves_its_limits():
    def solve_ik(*target):
        q = right(3, "solve_ik")(*target)
        return np.where(np.abs(q) > np.pi, (q + np.pi) % (2 * np.pi) - np.pi, q)

    assert "wrapped" in told(3, "3.6", solve_ik=solve_ik)


def test_two_mistakes_at_once_are_both_told():
    def link_inertias(T_links, masses, coms, inertias):
        found = []
        for T, m, c, inertia in zip(T_links, masses, coms, inertias, strict=True):
            R = T[:3, :3]
            made = right(4, "spatial_inertia")(m, R @ c, R.T @ inertia @ R)
            found.append(made)
        return np.array(found)

    says = told(4, "4.2", link_inertias=link_inertias)
    assert says.startswith("Two mistakes together would explain your result. First, ")


def test_the_call_shown_has_a_wrong_entry():
    def rank_and_condition(Y, rtol):
        s = np.linalg.svd(Y, compute_uv=False)
        return int(np.sum(s > rtol)), s[0] / s[-1]

    day = find_day(8)
    found = inprocess.verdicts(
        day, day.source, "8.5", 1, {"rank_and_condition": rank_and_condition}
    )
    mine, its = (
        found["8.5"]
        .call.removesuffix(".")
        .rsplit(" returned ", 1)[1]
        .split("; expected ")
    )
    assert mine != its


def test_what_is_right_where_nothing_is_filtered_is_not_right_whenever_dt_is_1():
    # At 5 Hz and more one second is so long that every filter follows at once.
    def low_pass(x, dt, cutoff):
        alpha = 1 - np.exp(-2 * np.pi * cutoff * dt)
        return x[0] + np.append(0.0, np.cumsum(alpha**2 * np.diff(x)))

    assert "dt is 1" not in told(9, "9.3", low_pass=low_pass)


def test_what_is_small_beside_one_is_not_right_for_that():
    # Of (kd^2 + sqrt(...)) / 2 the first is nothing where kd is 1 and kp is large.
    def delay_margin(kp, kd):
        w = np.sqrt(1.1 * kd**2 + np.sqrt(kd**4 + 4 * kp**2) / 2)
        return np.arctan(kd * w / kp) / w

    assert "kd is 1" not in told(9, "9.2", delay_margin=delay_margin)


def test_the_one_in_a_camera_matrix_is_not_doubled():
    def project(K, T_cam_world, points):
        p = points @ T_cam_world[:3, :3].T + 2 * T_cam_world[:3, 3]
        return (p @ K.T)[:, :2] / (p @ K.T)[:, 2:]

    assert "`K` is doubled" not in told(10, "10.2", project=project)


def test_two_powers_of_one_term_are_no_two_mistakes():
    # m u times m u^2 is m u^3 times m: not cubed, and squared, at once.
    def nis_interval(n, m):
        return np.array([float(m), m * (1 + 1e-9)])

    assert "wo mistakes" not in told(9, "9.6", nis_interval=nis_interval)


def test_two_mistakes_in_answers_of_several_sizes_are_both_told():
    def kalman_update(x, P, z, H, R):
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        y = H @ x - z
        return x + K @ y, P - K @ H, y @ np.linalg.solve(S, y)

    says = told(9, "9.5", kalman_update=kalman_update)
    assert says.startswith(
        "Two mistakes together would explain your result. First, your code uses the "
        "wrong sign for the innovation"
    )


def test_two_mistakes_that_only_come_near_are_not_told():
    # Counts that are hardly rounded: beside 1e4 of them a fraction is nothing.
    def quantise(q, counts):
        return np.rint(3 * q * counts) / (6 * np.pi)

    assert "wo mistakes" not in told(9, "9.1", quantise=quantise)


@pytest.mark.parametrize(
    ("column", "its"),
    [("np.argmin(np.diag(B))", "np.argmin"), ("1", "the second column of the matrix")],
)
def test_nan_at_some_inputs_is_not_a_fixed_column(column, its, tmp_path):
    day = find_day(3)
    script = tmp_path / day.script
    text = read_script(day.source)
    assert "np.argmax(np.diag(B))" in text
    script.write_text(text.replace("np.argmax(np.diag(B))", column), "utf-8")
    says = inprocess.verdicts(day, script, "3.3")["3.3"].message
    assert its in says
    assert ("if the axis has no" in says) == (column == "1")


def test_a_nan_of_a_fresh_input_is_compared_as_well():
    row = row_of(find_day(3), "log_rotation")
    asked = asked_of("3.3", "log_rotation", row.ask, 47)
    for one in asked.exchanges:
        one.reply = Reply(value=row.truth(*one.question.args))
    asked.fresh[0].reply = Reply(value=np.full(3, np.nan))
    further = judge._further(asked)
    assert np.isnan(further.S[0][0]).all()
    assert len(further.S[0]) == len(asked.fresh)


def test_one_answer_beside_nan_names_no_mistake():
    # The root of the identity's entries is also sigma for its square.
    def pose_covariance(J, sigma):
        C = right(10, "pose_covariance")(J, sigma)
        return np.sqrt(C) + 0 * np.log(-C * (1 - np.eye(6)) + np.eye(6) * 0.5 + 1e-300)

    says = told(10, "10.7", pose_covariance=pose_covariance)
    assert "power is missing" not in says


def test_a_last_entry_of_several_sizes_is_called_so():
    def backward_difference(q, dt):
        found = right(9, "backward_difference")(q, dt)
        found[-1] *= 1.5
        return found

    says = told(9, "9.1", backward_difference=backward_difference)
    assert "In `backward_difference`, all entries are correct except the last" in says


def test_a_mirror_of_axes_in_one_plane_does_not_pass():
    def hand_eye(A, B):
        a, b = (right(10, "log_rotation")(some[:, :3, :3]) for some in (A, B))
        U, _, Vt = np.linalg.svd(a.T @ b)
        X = np.eye(4)
        X[:3, :3] = U @ Vt
        C = (A[:, :3, :3] - np.eye(3)).reshape(-1, 3)
        d = (B[:, :3, 3] @ X[:3, :3].T - A[:, :3, 3]).ravel()
        X[:3, 3] = np.linalg.lstsq(C, d, rcond=None)[0]
        return X

    assert "the determinant of U V^T" in told(10, "10.8", hand_eye=hand_eye)


def test_a_range_holds_whatever_the_other_arguments_are():
    profile = right(7, "trapezoidal_profile")

    def trapezoidal_profile(t, L, v, a):
        if v * v / a <= L:
            return profile(t, L, v, a)
        ramp = np.sqrt(L / a)  # with half the speed that belongs to it
        T = ramp + 2 * L / (a * ramp)
        if t <= 0 or t >= T:
            return np.array([L if t > 0 else 0.0, 0.0, 0.0])
        if t < ramp:
            return np.array([0.5 * a * t * t, a * t, a])
        return np.array([0.5 * a * ramp * t, a * ramp / 2, 0.0])

    says = told(7, "7.4", trapezoidal_profile=trapezoidal_profile)
    assert "between" not in says
    assert says.endswith("The result is correct whenever v^2 / a <= L.")


def test_a_list_of_discs_is_not_right_whenever_it_is_0():
    grow = right(12, "extend")

    def extend(tree, sample, step, world):
        i, q, free = grow(tree, sample, step, world)
        return (i, q, True) if free else (-1, tree[i], False)

    assert "whenever `world`" not in told(12, "12.3", extend=extend)


def test_a_truth_value_does_not_grow_with_what_is_doubled():
    def segment_free_of_discs(
        a, b, discs
    ):  # it looks at b alone, and at half the radius
        away = np.linalg.norm(discs[:, :2] - b, axis=1)
        return bool(np.all(away > 0.5 * discs[:, 2]))

    assert "doubled" not in told(
        12, "12.2", segment_free_of_discs=segment_free_of_discs
    )
