"""The secret robot, its motions and how it is held."""

import numpy as np
from compare import assert_same

from robo47 import panda, simulate, verify

import day8_mujoco

AT = np.array([0.02, -0.03, 0.06])


model = panda.load("panda_nohand", drive="torque")
hung = panda.load("panda_nohand", drive="torque", edit=day8_mujoco.load(0.5, AT))


def test_a_seed_makes_one_robot_and_leaves_the_file_alone():
    before = model.body_mass.copy()
    one, again, other = (day8_mujoco.changed(model, seed) for seed in (1, 1, 2))
    assert_same(one.body_mass, again.body_mass, 0.0)
    assert np.abs(one.body_mass - other.body_mass).max() > 0.01
    assert_same(model.body_mass, before, 0.0)
    share = one.body_mass[before > 0] / before[before > 0]
    assert 0.0 < np.abs(share - 1.0).max() <= day8_mujoco.MASS


def test_the_motions_are_their_own_derivatives_and_keep_the_limits():
    (low, high), dt = simulate.limits(model)[0].T, 5e-4
    for q, qd, qdd in (
        day8_mujoco.excitation(model, 5, 20_000),
        day8_mujoco.swing(20_000),
    ):
        assert_same((q[2:] - q[:-2]) / (2 * dt), qd[1:-1], 1e-5)
        assert_same((qd[2:] - qd[:-2]) / (2 * dt), qdd[1:-1], 1e-4)
        assert ((q > low) & (q < high)).all()
        assert (np.abs(qd) < simulate.SPEED_LIMITS).all()


def test_dry_friction_has_the_sign_of_qd_and_a_bit_of_qdd():
    robot, motion = day8_mujoco.changed(model, 3), day8_mujoco.anywhere(model, 3, 100)
    slow = motion._replace(qd=motion.qd / 40.0)
    free = verify.mujoco_inverse_dynamics(day8_mujoco.without_friction(robot), *slow)
    rub = verify.mujoco_inverse_dynamics(robot, *slow) - free
    b = 2.0 / (0.95 * 0.02)  # 1/s, of MuJoCo's default solimp and solref
    full = np.abs(slow.qd + slow.qdd / b) > 0.01  # near 0 it is a ramp
    sign = np.sign(slow.qd + slow.qdd / b)
    assert_same((rub / robot.dof_frictionloss)[full], sign[full], 1e-9)
    assert (sign != np.sign(slow.qd)).mean() > 0.2


def test_a_hold_without_friction_ends_where_it_should_and_shows_the_load():
    arm, q = panda.arm(model), panda.READY_Q[None]
    at, torque = day8_mujoco.holds(model, arm, q, 2.0)
    assert_same(at[:, 0], [panda.READY_Q] * 2, 1e-6)
    assert_same(torque, np.zeros((2, 1, 7)), 1e-3)
    at, torque = (each[0] for each in day8_mujoco.holds(hung, arm, q, 2.0))
    extra = verify.mujoco_bias(hung, at, 0 * at) - verify.mujoco_bias(model, at, 0 * at)
    assert_same(torque, extra, 1e-4)


def test_an_arm_floats_on_what_it_really_weighs():
    arm, still = panda.arm(model), lambda now: now.gravity_torque
    load = np.append(0.5, 0.5 * AT)
    assert abs(day8_mujoco.rises(hung, arm, still, load)) < 1e-12
    assert day8_mujoco.rises(hung, arm, still, 0 * load) < -0.4
    assert day8_mujoco.rises(hung, arm, still, 1.2 * load) > 0.05
