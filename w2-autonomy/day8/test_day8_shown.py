"""Day 8: what a chain of hinges shows of its bodies, and what no torque can."""

from unittest.mock import patch

import mujoco
import numpy as np
import pytest

from conftest import ROOT, load_script, sentences
from labkit.judge.row import rows_of
from labkit.lesson.day import find_day
from robo47 import identification, panda

import day8_mujoco

DAY = find_day(8)
GUIDE = (ROOT / "w2-autonomy/docs/day8-lab.md").read_text("utf-8")
SENTENCES = sentences(8)
lab = load_script(ROOT / "w2-autonomy/src/day8_identification.py")
model = panda.load("panda_nohand", drive="torque")
arm = panda.arm(model)


def test_one_hinge_feels_three_of_ten():
    A = [[0, a, 0, a, 0, 9.81] for a in (-1, 1, 2)]
    row = identification.link_regressor([0, 2.0, 0, 0, 0, 0], A)[:, 1]
    assert np.flatnonzero(np.abs(row).max(axis=0)).tolist() == [1, 3, 5]
    assert "$m c_x$, $m c_z$ and $I_{yy}$" in SENTENCES


@pytest.mark.parametrize(("axes", "rank"), [("zzz", 1 + 2 + 3 + 3), ("zyx", 1 + 7 + 7)])
def test_seven_of_ten_show_only_where_a_parent_turns_about_another_axis(axes, rank):
    spec = mujoco.MjSpec()
    spec.option.gravity = [0.0, -9.81, 0.0] if axes == "zzz" else [0.0, 0.0, -9.81]
    body = spec.worldbody
    for axis in axes:
        body = body.add_body(pos=[0.3, 0.1 if axes == "zyx" else 0.0, 0.0])
        body.add_joint(axis=np.eye(3)["xyz".index(axis)])
        body.mass = 1.0
        body.explicitinertial = True
        body.inertia = [0.1, 0.1, 0.1]
    model = spec.compile()
    data = mujoco.MjData(model)
    rng = np.random.default_rng(8)
    rows = []
    for _ in range(30):
        data.qpos[:] = rng.uniform(-3, 3, 3)
        mujoco.mj_forward(model, data)  # fills xpos, xmat, xaxis and xanchor
        T = np.tile(np.eye(4), (3, 1, 1))
        T[:, :3, :3] = data.xmat[1:].reshape(3, 3, 3)
        T[:, :3, 3] = data.xpos[1:]
        J = np.vstack([data.xaxis.T, np.cross(data.xanchor, data.xaxis).T])
        qd, qdd = rng.normal(size=(2, 3))
        g = model.opt.gravity
        rows.append(identification.arm_regressor(J, T, qd, qdd, g))
    shown = np.linalg.matrix_rank(np.vstack(rows), tol=1e-9)
    assert shown == rank


def chain(axes, offsets, gravity=(0.0, 0.0, -9.81)):
    """Return a chain of hinges by their axes, with a body of 1 kg on each."""
    spec = mujoco.MjSpec()
    spec.option.gravity = gravity
    body = spec.worldbody
    for axis, offset in zip(axes, offsets, strict=True):
        body = body.add_body(pos=offset)
        body.add_joint(axis=axis)
        body.mass = 1.0
        body.explicitinertial = True
        body.inertia = [0.1, 0.1, 0.1]
    return spec.compile()


def shown_by(chained, rotors=()):
    """Return how many numbers of each link a chain shows, from the first link on.

    The last of them is with the rotors of those joints as well.
    """
    data = mujoco.MjData(chained)
    rng = np.random.default_rng(8)
    n = chained.njnt
    rows = []
    for _ in range(60):
        data.qpos[:] = rng.uniform(-3, 3, n)
        mujoco.mj_forward(chained, data)  # fills xpos, xmat, xaxis and xanchor
        T = np.tile(np.eye(4), (n, 1, 1))
        T[:, :3, :3] = data.xmat[1:].reshape(n, 3, 3)
        T[:, :3, 3] = data.xpos[1:]
        J = np.vstack([data.xaxis.T, np.cross(data.xanchor, data.xaxis).T])
        qd, qdd = rng.normal(size=(2, n))
        g = chained.opt.gravity
        links = identification.arm_regressor(J, T, qd, qdd, g)
        rows.append(np.hstack([links, np.diag(qdd)[:, list(rotors)]]))
    Y = np.vstack(rows)
    widths = [*range(10, 10 * n + 1, 10), Y.shape[1]]
    return [int(np.linalg.matrix_rank(Y[:, :p], tol=1e-9)) for p in widths]


def test_a_scara_shows_three_numbers_for_each_hinge_after_the_first():
    upright = [[0.0, 0.0, 1.0]] * 3
    scara = chain(upright, [[0.0, 0.0, 0.3], [0.3, 0.0, 0.0], [0.3, 0.0, 0.0]])
    assert shown_by(scara)[:3] == [1, 1 + 3, 1 + 3 + 3]
    assert "(a planar arm)" in SENTENCES


@pytest.mark.parametrize(("degrees", "more"), [(90, 0), (80, 1)])
def test_a_rotor_hides_where_its_link_turns_about_that_axis_by_its_joint_alone(
    degrees, more
):
    tip = np.radians(degrees)
    axes = [[0.0, 0.0, 1.0], [np.sin(tip), 0.0, np.cos(tip)]]
    *_, links, both = shown_by(chain(axes, [[0, 0, 0.3], [0, 0, 0.3]]), (0, 1))
    assert both - links == more
    assert "an earlier joint can also rotate the link about this axis" in SENTENCES
    assert "and the axis of joint 2 is perpendicular to it" in SENTENCES


def test_a_unit_vector_divided_by_its_mass_is_nan_in_nine_of_ten_columns():
    right = lab.spatial_inertia_from_params

    def divides(phi):
        m = phi[0]
        c = phi[1:4] / m
        return right(np.hstack([m, m * c, phi[4:]]))

    V, A = np.random.default_rng(8).normal(size=(2, 6))
    with (
        patch.object(lab, "spatial_inertia_from_params", divides),
        np.errstate(divide="ignore", invalid="ignore"),
    ):
        columns = lab.link_regressor(V, A)
    spoilt = ~np.isfinite(columns).all(axis=0)
    assert spoilt.tolist() == [False] + [True] * 9
    words = "Code that divides by $m$ returns NaN in nine of the ten columns"
    assert words in SENTENCES


def costs(ways, motion):
    """Return the largest wrong torque of each arm_regressor at some states, N m."""
    phi = day8_mujoco.numbers(arm)[:70]
    most = dict.fromkeys(ways, 0.0)
    for q, qd, qdd in zip(*motion, strict=True):
        now = arm.at(q)
        given = now.J_space, now.T_links, qd, qdd, arm.gravity
        right = identification.arm_regressor(*given)
        for slug, code in ways.items():
            off = np.abs((code(*given) - right) @ phi).max()
            most[slug] = max(most[slug], off)
    return most


MISTAKES = {  # the guide's words for six mistakes of the catalogue
    "$T$ instead of its inverse in $X$": "pose-not-inverted",
    "$F_{link}$ only rotated, its moment not moved to the world origin": (
        "wrench-not-carried-back"
    ),
    "row of each link's own joint left out": "cut-early",
    r"$\mathrm{ad}(V) S \dot q$ left out of the acceleration": "bracket-forgotten",
    r"$\mathrm{ad}(V)$ not transposed (8.2)": "ad-not-transposed",
    "sign of $I_{xy}$, $I_{xz}$ and $I_{yz}$ reversed (8.1)": "products-negative",
}


@pytest.mark.kit
def test_what_mistakes_cost_in_motion_and_at_rest():
    still = np.zeros((1, 7))
    at_rest = day8_mujoco.Motion(panda.READY_Q[None], still, still)
    ways = {way.slug: way.code for way in rows_of(DAY)["arm_regressor"].named}
    moving = costs(ways, day8_mujoco.anywhere(model, lab.ROBOT_SEED, 20))
    rest = costs(ways, at_rest)
    cost = {slug: [moving[slug], rest[slug]] for slug in ways}
    rows = dict.fromkeys(MISTAKES)
    for line in GUIDE.splitlines():
        first, *written = line.strip("| ").split(" | ")
        rows |= {first: written} if first in rows else {}
    for first, slug in MISTAKES.items():
        for value, words in zip(cost[slug], rows[first], strict=True):
            assert f"{value:.{len(words.partition('.')[2])}f}" == words
    unseen = sum(rest < 1e-9 < moving for moving, rest in cost.values())
    assert 0.25 < unseen / len(cost) < 0.35
    assert "For about 30 % of the mistakes" in SENTENCES


def test_mujoco_refuses_what_no_body_can_have():
    body = (
        '<mujoco><worldbody><body><inertial pos="0 0 0" mass="1" diaginertia="{}"/>'
        "</body></worldbody></mujoco>"
    )
    mujoco.MjModel.from_xml_string(body.format("1 1 2"))
    with pytest.raises(ValueError, match="inertia"):
        mujoco.MjModel.from_xml_string(body.format("1 1 3"))
