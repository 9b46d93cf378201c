"""Two mistakes at once, and one that is only a part of what is wrong."""

import inspect
import re
import textwrap
import types

import inprocess
import numpy as np
import pytest
from test_claims import right, told
from test_own_line import told as told_of_a_file

from labkit.judge import Count, Mask, Pose, Scalar, Vector, changes, pairs
from labkit.judge.answers import as_clause, say_number
from labkit.judge.matcher import Matcher
from labkit.judge.mistake import ADD_UP, Mistake
from labkit.lesson.day import find_day
from labkit.lesson.starter import function_lines
from robo47.screws import ad

pytestmark = pytest.mark.kit


def test_a_reversed_chain_and_a_factor_on_the_wrong_side_are_told_together():
    def fk_space(screws, M, q):
        T = M
        for S, theta in zip(screws[::-1], q[::-1], strict=True):
            T = T @ right(2, "exp_screw")(S, theta)
        return T

    says = told(2, "2.6", fk_space=fk_space)
    assert "in the reverse order" in says
    assert "multiplies by M on the left of the exponentials" in says


def test_two_answers_in_the_other_order_that_both_lack_a_term():
    def translations_both_orders(T_world_ee, T_extra):
        R, R_extra = T_world_ee[:3, :3], T_extra[:3, :3]
        return R_extra @ T_world_ee[:3, 3], R @ T_extra[:3, 3]

    says = told(1, "1.7", translations_both_orders=translations_both_orders)
    assert "omits the translation of the left factor" in says
    assert "swaps the two translations" in says


def test_one_mistake_that_gives_half_of_the_wrong_numbers_is_told_with_how_many():
    def truncated_svd_fit(Y, tau, rtol):
        U, s, Vt = np.linalg.svd(Y, full_matrices=False)
        kept = s > rtol * s[0]
        if kept[4:].any():
            return Vt[:4].T @ (U[:, :4].T @ tau / s[:4])
        return Vt[kept].T @ (U[:, kept].T @ tau * s[kept])

    says = told(8, "8.6", truncated_svd_fit=truncated_svd_fit)
    assert (
        "One mistake would explain the result in 23 of the 30 wrong calls: your" in says
    )
    assert "multiplies U^T tau by the singular values" in says
    assert "In the other 7 wrong calls, the reference solution with" in says


def test_one_call_at_a_limit_leaves_a_mistake_that_gives_all_others(student):
    """Of two that the row knows, the one that gives half of the calls is no better."""
    body = """
def closest_points_segments(a0, a1, b0, b1):
    found = [(p, o) for p in (a0, a1) for o in (b0, b1)]
    u, v, w = a1 - a0, b1 - b0, b0 - a0
    gram = np.array([[u @ u, -(u @ v)], [-(u @ v), v @ v]])
    if np.linalg.det(gram) > 1e-12 * gram[0, 0] * gram[1, 1]:
        s, t = np.linalg.solve(gram, [u @ w, -(v @ w)])
        if 0 <= s <= 1 and 0 <= t <= 1:
            found.append((a0 + s * u, b0 + t * v))
    return np.array(min(found, key=lambda two: np.linalg.norm(two[0] - two[1])))
"""
    says = told_of_a_file(11, "11.1", "closest_points_segments", student, body)
    assert "only the endpoints of the second segment" not in says


def test_a_mistake_that_gives_few_of_the_wrong_numbers_is_not_told():
    def manipulability(J):
        return np.linalg.svd(J, compute_uv=False)[:5].prod()

    assert "left out" not in told(3, "3.8", manipulability=manipulability)


def test_dry_friction_that_works_one_way_is_not_that_of_slow_joints():
    def actuator_regressor(qd, qdd):
        return np.hstack([np.diag(qdd), np.diag(qd), np.diag((qd > 0) * 1.0)])

    assert "slow joint" not in told(8, "8.4", actuator_regressor=actuator_regressor)


def test_a_mistake_that_would_show_where_all_is_right_is_no_part_of_it():
    def Rz(theta):
        c = np.cos(theta)
        s = np.sqrt(1 - c * c)
        return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])

    says = told(1, "1.2", Rz=Rz)
    assert "turns the wrong way" not in says
    assert "makes a negative value positive" in says
    assert "absolute" not in says


def test_each_wrong_result_of_several_has_its_own_mistake():
    def pid_step(e, ed, integral, kp, kd, ki, dt, clamp):
        integral = integral + e * dt
        return kp * e + kd * ed + np.clip(ki * integral, -clamp, clamp), integral

    says = told(5, "5.7", pid_step=pid_step)
    one = "one mistake would explain the acceleration: your code clamps ki times the"
    assert f"In `pid_step`, {one} integral" in says
    assert "returns the unclamped integral" in says


def test_an_argument_handed_back_is_not_one_of_two_mistakes():
    def inverse(T):
        found = right(1, "inverse")(T)
        found[:3] *= -1.0
        return found

    says = told(1, "1.3", inverse=inverse)
    assert "comes back" not in says
    assert "reverses one sign" in says


def test_of_a_pose_one_mistake_is_in_R_and_the_other_in_t():
    def link_T(pos, quat):
        return right(1, "make_T")(right(1, "quat_to_R")(quat).T, -pos)

    says = told(1, "1.5", link_T=link_T)
    assert "rotation matrix T[:3, :3] is transposed" in says
    assert "your translation has the wrong sign" in says


def test_blocks_of_columns_in_another_order_are_named_by_what_they_are():
    def actuator_regressor(qd, qdd):
        return np.hstack([np.diag(qd), np.diag(np.sign(qd)), np.diag(qdd)])

    says = told(8, "8.4", actuator_regressor=actuator_regressor)
    assert "in the order viscous friction, dry friction, the rotors" in says


def test_what_is_said_to_be_right_is_right_to_the_last_digit_that_counts():
    def exp_rotation(axis, theta):
        K = right(2, "skew")(axis)
        R = np.eye(3)
        term = np.eye(3)
        for n in range(1, 9):  # off by 4e-6 at a third of pi
            term = term @ K * theta / n
            R = R + term
        return R

    says = told(2, "2.2", exp_rotation=exp_rotation)
    assert "Your rotation matrix R is not valid" in says
    assert "between -pi / 3" not in says


def test_a_condition_that_no_cut_gives_is_told_nothing_of_a_cut():
    def rank_and_condition(Y, rtol):
        rank, condition = right(8, "rank_and_condition")(Y, rtol)
        return rank, condition**9 * 1e9

    says = told(8, "8.5", rank_and_condition=rank_and_condition)
    assert "rtol" not in says
    assert "values" not in says


def test_the_rank_of_what_is_hidden_is_not_a_cut():
    def rank_and_condition(Y, rtol):
        rank, condition = right(8, "rank_and_condition")(Y, rtol)
        return Y.shape[1] - rank, condition

    says = told(8, "8.5", rank_and_condition=rank_and_condition)
    assert "counts the singular values below rtol times" in says


def test_a_result_that_is_right_is_said_to_be():
    def rank_and_condition(Y, rtol):
        rank, _ = right(8, "rank_and_condition")(Y, rtol)
        s = np.linalg.svd(Y, compute_uv=False)
        return rank, s[0] / np.mean(s[:rank]) + np.log(s[0])

    says = told(8, "8.5", rank_and_condition=rank_and_condition)
    assert says.startswith("The rank is correct. The condition number ")


def test_two_arguments_exchanged_need_no_name():
    def arm_regressor(J_space, T_links, qd, qdd, g):
        return right(8, "arm_regressor")(J_space, T_links, qdd, qd, g)

    says = told(8, "8.3", arm_regressor=arm_regressor)
    assert "Your code acts as if `qd` and `qdd` were swapped." in says


def test_a_changed_argument_is_told_as_what_the_code_acts_as_if_it_were():
    kernels = np.ones((2, 3, 3))
    call = (np.arange(1.0, 5.0), np.arange(1.0, 5.0), np.eye(4), 2.0, 3, kernels)
    names = ["masses", "lengths", "T", "g", "n", "kernels"]
    made = [*changes.likely(call, names), *changes.others(call, names)]
    says = {one.says for one in made}
    assert "acts as if every entry of `masses` were the mean of all entries" in says
    assert "acts as if every row of `T` were the mean of all rows" in says
    assert "acts as if `masses` and `lengths` were swapped" in says
    three = "acts as if `masses`, `lengths` and `T` were each in reverse order"
    assert f"{three} along the first axis" in says
    assert "acts as if the rows of `T` were in reverse order" in says
    assert "acts as if `kernels` were in reverse order along its second axis" in says
    assert "acts as if `g` were rounded to 1 decimal" in says
    assert "acts as if `n` were larger by 1" in says
    assert all(re.match(r"acts as if .* (were|had) ", s) for s in says)
    assert not any("{" in one for one in says)


def test_two_entries_of_an_argument_exchanged_need_no_name():
    def quat_to_R(quat):
        return right(1, "quat_to_R")(quat[[0, 1, 3, 2]])

    says = told(1, "1.4", quat_to_R=quat_to_R)
    assert "Your code acts as if `quat[2]` and `quat[3]` were swapped. " in says


def test_of_two_mistakes_only_what_the_function_does_is_told():
    def reward(heights, target, cap):
        found = right(14, "reward")(heights, target, cap)
        below = np.isfinite(heights) & (heights < 0)
        return np.where(np.isnan(heights), 0.0, np.where(below, -1.0, found))

    says = told(14, "14.6", reward=reward)
    assert "Two mistakes together would explain your result. First, your code " in says
    assert " Second, it returns 0 for a height of NaN" in says
    assert "because the simulation failed" not in says


def test_two_halves_that_say_the_same_are_no_pair(tmp_path):
    def mass_matrix(J_space, G, armature):
        n = J_space.shape[1]
        M = np.diag(armature).astype(float)
        for i in range(n):
            for j in range(n):
                for link in range(min(i, j), n):
                    M[i, j] += J_space[:, i] @ G[link] @ J_space[:, j]
        return M

    day, script = find_day(4), tmp_path / "day4.py"
    lines = day.source.read_text().splitlines()
    start, end, _ = function_lines("\n".join(lines), "mass_matrix")
    own = textwrap.dedent(inspect.getsource(mass_matrix)).splitlines()
    script.write_text("\n".join([*lines[:start], *own, *lines[end:]]))
    instead = {"mass_matrix": mass_matrix}
    verdict = inprocess.verdicts(day, script, "4.3", instead=instead)["4.3"]
    assert verdict.status == "wrong"
    halves = re.findall(r"(?:First|Second), (.*?)\.", verdict.message)
    assert len(set(halves)) == len(halves), verdict.message


def test_a_half_turn_is_asked_before_an_answer_is_called_close():
    def log_rotation(R):
        angle = np.arccos(np.clip((np.trace(R) - 1) / 2, -1, 1))
        w = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
        size = np.linalg.norm(w)
        return w / 2 if size < 1e-9 else angle * w / size

    day = find_day(3)
    instead = {"log_rotation": log_rotation}
    verdict = inprocess.verdicts(day, day.source, "3.3", instead=instead)["3.3"]
    assert (verdict.status, verdict.mistake) == ("wrong", "wrong-at-pi")
    assert "not for exactly pi" in verdict.message
    assert "1e-08" in verdict.message


def test_a_matrix_that_is_transposed_in_some_calls_has_no_wrong_order():
    turn = right(1, "quat_to_R")

    def quat_to_R(quat):
        return turn(quat).T if quat[0] < 0 else turn(quat)

    says = told(1, "1.4", quat_to_R=quat_to_R)
    assert "wrong order" not in says
    assert "In every wrong call, your result is the correct result transposed." in says


def test_an_argument_before_a_default_is_told_by_its_name():
    def compose_fk(model, q, path=None):
        return right(1, "compose_fk")(model, np.cumsum(q))

    says = told(1, "1.6", compose_fk=compose_fk)
    assert "Your code acts as if `q` were replaced with its cumulative sum. " in says


def test_two_mistakes_at_once_are_made_in_the_reference_solution():
    one, both = (Mistake("some", "", lambda x: x, many) for many in (False, True))
    assert one.does("stops") == "the reference solution with this mistake stops"
    assert both.does("stops") == "the reference solution with both mistakes stops"


@pytest.mark.parametrize(
    ("off", "says"),
    [
        ("", "The same is so."),
        ("Largest error: 2 m.", "Largest error: 2 m. The same is so."),
    ],
)
def test_no_clause_is_empty_where_it_is_not_known_how_far_off_an_answer_is(off, says):
    some = types.SimpleNamespace(off=lambda: off)
    assert Matcher.with_error(some, "the same is so") == says


def test_a_name_that_the_row_finds_is_not_followed_by_a_slip():
    def truncated_svd_fit(Y, tau, rtol):
        U, s, Vt = np.linalg.svd(Y, full_matrices=False)
        x = np.zeros(Y.shape[1])
        for k in range(int(np.sum(s > rtol * s[0])) - 1):
            x += (U[:, k] @ tau) / s[k] * Vt[k]
        return x

    says = told(8, "8.6", truncated_svd_fit=truncated_svd_fit)
    assert says.startswith("Your code counts too few singular values in 14 of 14")
    assert "gives the same output" not in says


def test_mj_forward_is_named_only_where_a_function_takes_a_model():
    zeros = np.zeros((4, 4))
    says = told(1, "1.6", compose_fk=lambda model, q, path=None: zeros)
    assert "`mj_forward`" in says
    says = told(6, "6.6", critical_damping=lambda K, Lambda: np.zeros((6, 6)))
    assert "Did you create the array but never fill it?" in says
    assert "mj_forward" not in says


def test_a_result_in_another_unit_is_not_explained_by_an_argument():
    def max_cube_mass(grip, mu, acceleration):
        return 1000.0 * right(7, "max_cube_mass")(grip, mu, acceleration)

    says = told(7, "7.9", max_cube_mass=max_cube_mass)
    assert says.startswith("The result is 1000 times the correct value")
    assert "Is your result in another unit? The function should return kg." in says
    assert "grip" not in says.partition("max_cube_mass(")[0]


def test_a_large_number_has_no_exponent():
    numbers = [say_number(x) for x in (2296.3, 21437.0, 230000.0, 13.26, 0.00123)]
    assert numbers == ["2300", "21400", "2.3e+05", "13.3", "0.00123"]


def test_the_largest_error_counts_calls_and_names_two_units():
    yes, no = np.ones((6, 1)), np.zeros((6, 1))
    assert Mask().largest_error(yes[:, 0], no[:, 0]) == (
        "The result is wrong in all 6 calls."
    )
    T = np.tile(np.eye(4), (3, 1, 1))
    S = T.copy()
    S[:, :3, :3] = np.diag([1.0, -1.0, -1.0])
    S[:, :3, 3] = [1.5, 0.0, 0.0]
    assert Pose().largest_error(S, T) == "Largest errors: 1500 mm and 180.0 deg."
    assert Scalar(unit="kg").largest_error(T[:, 0, 0] + 1.0, T[:, 0, 0]) == (
        "Largest error: 1 kg."
    )
    mine, joints = np.array([0.0, 3.0, 8.0]), np.array([0.0, 2.0, 3.0])
    assert Count().largest_error(mine, joints) == "The result is wrong in 2 of 3 calls."
    assert Vector((2,), "m, rad").largest_error(T[:, 0, :2] + 1.5, T[:, 0, :2]) == (
        "Largest error: 1.5."
    )


def test_a_message_of_one_of_several_functions_goes_on_in_its_sentence():
    assert as_clause("The ratio is 2.") == "the ratio is 2."
    assert as_clause("A factor is missing.") == "a factor is missing."
    assert as_clause("A is transposed.") == "A is transposed."
    assert as_clause("R is transposed.") == "R is transposed."
    assert as_clause("NumPy stops.") == "NumPy stops."


def test_two_mistakes_leave_no_part_correct():
    said = "your rotation is correct, but your translation is -t"
    assert pairs._BUT.sub("", said) == "your translation is -t"


def test_a_changed_answer_is_told_as_what_the_code_returns():
    def quintic_coefficients(start, end, duration):
        return right(7, "quintic_coefficients")(start, end, duration)[::-1]

    says = told(7, "7.5", quintic_coefficients=quintic_coefficients)
    assert "Your code returns the correct result in reverse order. " in says


def test_errors_that_add_up_are_called_so():
    def impedance_torque(J_site, wrench, bias, damping, qd, tau_null):
        return bias - damping * qd + tau_null - J_site.T @ wrench

    says = told(6, "6.7", impedance_torque=impedance_torque)
    assert "Two mistakes together would explain your result. " in says
    assert says.endswith(f"{ADD_UP}.")


def test_factors_that_belong_together_are_called_so():
    def kinetic_energy_gradient(J_space, G, qd):
        V = np.cumsum(J_space * qd, axis=1).T
        own = [-(ad(J_space[:, i]) @ V[i]) @ G[i] @ V[i] for i in range(len(qd))]
        return 0.5 * np.array(own)

    says = told(9, "9.8", kinetic_energy_gradient=kinetic_energy_gradient)
    assert "Two mistakes together would explain your result. " in says
    assert says.endswith(f"{pairs.MULTIPLY}.")


def test_a_pair_that_cancels_in_a_right_entry_is_not_told():
    """The inverse has R^T, its transpose R, and R is right; -R t is what is left."""

    def make_T(R, t):
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = R, -R @ t
        return T

    says = told(1, "1.1", make_T=make_T)
    assert "wo mistakes" not in says
    assert "The rotation is correct in every call" in says


def test_a_change_of_a_wrong_answer_is_told_as_made_after_it():
    def inverse(T):
        return np.block([[T[:3, :3].T, T[:3, :3] @ T[:3, 3:]], [np.eye(4)[3:]]])

    says = told(1, "1.3", inverse=inverse)
    assert says.startswith("Two mistakes, made one after the other, would explain your")


def test_a_number_that_is_always_0_is_no_array():
    def quintic_duration(displacement, v_max, a_max):
        return 0.0

    says = told(7, "7.2", quintic_duration=quintic_duration)
    assert says == "Your result is 0 for every input."


def test_a_joint_that_is_left_out_is_counted_from_the_base():
    def fk_body(screws, M, q):
        T = np.array(M)
        for S, theta in zip(screws[:0:-1], q[:0:-1], strict=True):
            T = T @ right(2, "exp_screw")(S, theta)
        return T

    says = told(2, "2.8", fk_body=fk_body)
    assert "does not move the first joint. Second, it multiplies" in says
