"""Cones, grasps and reflexes against MuJoCo's contact forces and SciPy's nnls."""

import mujoco
import numpy as np
import pytest
import scipy.optimize
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st

from robo47 import grasp, policy

rng = np.random.default_rng(14)
SLOPE = """
<mujoco>
  <option cone="elliptic" impratio="10"/>
  <worldbody>
    <geom type="plane" size="1 1 .1" euler="20 0 0" friction="{mu}" condim="3"/>
    <body pos="0 0 .02" euler="20 0 0">
      <freejoint/>
      <geom name="box" type="box" size=".02 .02 .02" mass=".1" friction="{mu}"
            condim="3" solref=".004 1"/>
    </body>
  </worldbody>
</mujoco>
"""
ANY = st.floats(-3, 3)
SEEDS = st.integers(0, 2**32 - 1)


def unit(v):
    """Return v with length 1."""
    return v / np.linalg.norm(v)


def felt(mu):
    """Return forces on a box on a slope of 20 degrees, normals, and MuJoCo's own."""
    model = mujoco.MjModel.from_xml_string(SLOPE.format(mu=mu))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 100)
    forces, normals, theirs = [], [], []
    wrench = np.zeros(6)
    for i, contact in enumerate(data.contact):
        mujoco.mj_contactForce(model, data, i, wrench)  # in the contact's axes
        axes = contact.frame.reshape(3, 3)
        forces.append(axes.T @ wrench[:3])  # on geom2, the box
        normals.append(axes[0])
        theirs.append(mu * wrench[0] - np.hypot(*wrench[1:3]))
    assert len(forces) == 4
    return np.array(forces), np.array(normals), np.array(theirs)


def opposite(mu, k=8, places=((0, 0.02, 0), (0, -0.02, 0))):
    """Return the wrenches of all edges of contacts that push towards the middle."""
    return np.hstack([pushes(p, unit(-np.array(p)), mu, k) for p in places])


def pushes(point, normal, mu, k=8):
    """Return the wrenches of the edges of one contact, (6, k)."""
    G = grasp.grasp_matrix([point], np.zeros(3))
    return G @ grasp.cone_edges(np.array(normal, float), mu, k).T


def weights(W):
    """Return SciPy's positive weights whose sum is nearest to nothing."""
    more, _ = scipy.optimize.nnls(W, -W.sum(axis=1))
    return 1.0 + more


@pytest.mark.parametrize("mu", [0.2, 0.6])
def test_the_margin_is_mujocos_in_contact_axes_and_0_where_a_box_slides(mu):
    forces, normals, theirs = felt(mu)
    ours = grasp.cone_margin(forces, normals, np.full(len(forces), mu))
    assert_same(ours, theirs, 1e-15)
    assert (np.abs(ours) < 1e-3).all() == (mu < np.tan(np.radians(20)))


def test_the_worked_cases_of_the_margin_and_of_a_pull():
    one = grasp.cone_margin([[3, 4, 10], [0, 0, -1]], [[0, 0, 1]] * 2, [0.6, 0.6])
    assert_same(one, [1.0, -0.6], 1e-14)


@given(SEEDS)
def test_a_force_on_an_edge_has_no_margin_and_presses_with_1(seed):
    draw = np.random.default_rng(seed)
    n = unit(draw.normal(size=3))
    edges = grasp.cone_edges(n, 0.7, 7)
    assert_same(edges @ n, np.ones(7), 1e-14)
    assert_same(grasp.cone_margin(edges, [n] * 7, [0.7] * 7), np.zeros(7), 1e-14)
    inside = draw.uniform(0.1, 1, 7) @ edges
    assert grasp.cone_margin(inside, n, 0.7) > 0


def test_edges_begin_at_n_x_the_axis_least_along_n_the_first_of_equals():
    edges = grasp.cone_edges([0, 0, 1], 0.5, 4)
    assert_same(edges, [[0, 0.5, 1], [-0.5, 0, 1], [0, -0.5, 1], [0.5, 0, 1]], 1e-15)
    n = unit(np.array([0.71, 0, 0.71]))
    assert_same(grasp.cone_edges(n, 1.0, 1)[0], n + np.cross(n, [0, 1, 0]), 1e-15)


@given(SEEDS)
def test_the_grasp_matrix_gives_the_sum_of_p_x_f_and_of_f(seed):
    draw = np.random.default_rng(seed)
    p, f = draw.normal(size=(2, 5, 3))
    c = draw.normal(size=3)
    wrench = grasp.grasp_matrix(p, c) @ f.ravel()
    assert_same(wrench[:3], np.cross(p - c, f).sum(axis=0), 1e-13)
    assert_same(wrench[3:], f.sum(axis=0), 1e-13)


def test_two_that_push_up_lift_and_one_up_one_down_turn():
    G = grasp.grasp_matrix([[0, 0.02, 0], [0, -0.02, 0]], np.zeros(3))
    assert_same(G @ [0, 0, 1, 0, 0, 1], [0, 0, 0, 0, 0, 2], 1e-15)
    assert_same(G @ [0, 0, 1, 0, 0, -1], [0.04, 0, 0, 0, 0, 0], 1e-15)


AROUND = [(0.02, 0, 0), (-0.02, 0, 0), (0, 0.02, 0), (0, -0.02, 0)]


@pytest.mark.parametrize(
    ("places", "mu", "rank", "held"),
    [
        (AROUND[2:], 0.0, 1, False),
        (AROUND[2:], 0.5, 5, False),  # it turns about the line between the two
        (AROUND, 0.0, 2, False),
        (AROUND, 0.3, 6, True),
        (AROUND, 1.2, 6, True),
        ([(0.02, 0, 0), (-0.01, 0.0173, 0), (-0.01, -0.0173, 0)], 0.5, 6, True),
    ],
)
def test_what_closes_is_what_has_full_rank_and_nnls_finds_weights_for(
    places, mu, rank, held
):
    W = opposite(mu, places=places)
    s = np.linalg.svd(W, compute_uv=False)
    assert np.sum(s > 1e-9 * s[0]) == rank
    assert grasp.certifies_force_closure(W, weights(W)) is held


def test_three_on_one_face_have_full_rank_and_no_balance_at_any_friction():
    for mu in (0.3, 0.5, 1.2):
        places = [(0.01, 0.01, 0), (-0.01, 0.01, 0), (0, -0.01, 0)]
        W = np.hstack([pushes(p, (0, 0, 1), mu) for p in places])
        assert np.linalg.matrix_rank(W) == 6
        assert np.linalg.norm(W @ weights(W)) > 1
        assert not grasp.certifies_force_closure(W, weights(W))


@given(SEEDS, st.sampled_from([1e-4, 1.0, 1e5]))
def test_what_closes_resists_any_wrench_in_any_unit(seed, unit_of_force):
    W = unit_of_force * opposite(0.5, places=AROUND)
    assert grasp.certifies_force_closure(W, np.ones(W.shape[1]))
    assert grasp.certifies_force_closure(W, 1e3 * np.ones(W.shape[1]))
    asked = np.random.default_rng(seed).normal(size=6)
    asked[:3] *= 0.02  # of a cube's half width
    _, left = scipy.optimize.nnls(W, unit_of_force * asked)
    assert left < 1e-9 * unit_of_force


def test_a_weight_of_0_or_below_proves_nothing():
    W = opposite(0.5, places=AROUND)
    w = np.ones(W.shape[1])
    null = np.linalg.svd(W)[2][-1]
    assert grasp.certifies_force_closure(W, w + 0.5 * null / np.abs(null).max())
    least = np.argmin(null)
    at_0 = w - w[least] / null[least] * null
    at_0[least] = 0.0  # and no rounding of it
    assert not grasp.certifies_force_closure(W, at_0)
    assert not grasp.certifies_force_closure(W, -w)


def test_a_reflex_closes_by_one_step_where_any_contact_nearly_slips():
    nearly = [[3, 4, 10]], [[0, 0, 1]], [0.6]
    assert grasp.grip_reflex_step(0.01, *nearly, 0.2, 0.002) == pytest.approx(0.008)
    assert grasp.grip_reflex_step(0.01, *nearly, 0.1, 0.002) == 0.01
    assert grasp.grip_reflex_step(-0.019, *nearly, 0.2, 0.002) == policy.LOW[4]
    none = np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0)
    assert grasp.grip_reflex_step(0.01, *none, 0.2, 0.002) == 0.01
    safe = [[0, 0, 9], [3, 4, 10]], [[0, 0, 1]] * 2, [0.6, 0.6]
    assert grasp.grip_reflex_step(0.01, *safe, 0.2, 0.002) == pytest.approx(0.008)


@given(ANY, st.floats(0.01, 1.0), st.sampled_from([0.01, 1.0, 100.0]))
def test_a_reflex_does_the_same_in_any_unit_of_force(along, share, size):
    forces = np.array([[along, 0.0, 2.0]])
    given_ = [[0.0, 0.0, 1.0]], [0.5]
    if abs(1.0 - abs(along) - share) > 1e-6:
        one = grasp.grip_reflex_step(0.01, forces, *given_, share, 0.002)
        assert one == grasp.grip_reflex_step(0.01, size * forces, *given_, share, 0.002)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: grasp.cone_margin([1, 2], [0, 0, 1], 0.5), "force has shape"),
        (lambda: grasp.cone_margin([1, 2, 3], [0, 0, 2], 0.5), "normal has length 2"),
        (lambda: grasp.cone_margin([1, 2, 3], [0, 0, 1], -0.5), "mu is -0.5"),
        (lambda: grasp.cone_edges([0, 0, 1], 0.5, 0), "k is 0"),
        (lambda: grasp.grasp_matrix([1, 2, 3], [0, 0, 0]), "points has shape"),
        (
            lambda: grasp.certifies_force_closure(np.eye(6), np.ones(5)),
            "weights has shape",
        ),
    ],
)
def test_what_is_no_contact_is_refused_by_name(call, says):
    with pytest.raises(ValueError, match=says):
        call()
