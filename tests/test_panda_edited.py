"""An edited Panda: no inertia is lost, and an arm holds all that acts or refuses."""

import mujoco
import numpy as np
import pytest

from robo47 import panda
from robo47.errors import Robo47Error

BOX = '<geom type="box" size=".02 .02 .05" mass="0.5"/>'
END = '<body name="attachment"'


def inside(text, more):
    """Return the file with more in the body `attachment`."""
    at = text.index(">", text.index(END))
    return f"{text[:at].rstrip('/')}>{more}" + (
        text[at + 1 :] if text[at - 1] != "/" else f"</body>{text[at + 1 :]}"
    )


def in_world(text, more):
    return text.replace("</worldbody>", f"{more}</worldbody>")


EDITS = {
    "a geom on a body without inertial": lambda text: inside(text, BOX),
    "a new body": lambda text: inside(text, f'<body name="new">{BOX}</body>'),
    "a frame": lambda text: inside(text, f'<frame pos="0 0 .1">{BOX}</frame>'),
    "a jointed body": lambda text: inside(
        text, f'<body name="spins"><joint name="spin" axis="0 0 1"/>{BOX}</body>'
    ),
    "a free body": lambda text: in_world(
        text, f'<body name="cube" pos="1 0 1"><freejoint/>{BOX}</body>'
    ),
    "an include": lambda text: inside(text, '<include file="tool.xml"/>'),
    "a default class": lambda text: inside(
        text.replace(
            "<default>",
            '<default><default class="tool"><geom type="sphere" size=".03" '
            'density="3000"/></default>',
            1,
        ),
        '<geom class="tool"/>',
    ),
    "a mesh": lambda text: (
        inside(text, '<geom type="mesh" mesh="hand_c" mass="1"/>')
        if "hand_c" in text
        else inside(text, '<geom type="mesh" mesh="link0_c" mass="1"/>')
    ),
    "inertiafromgeom": lambda text: text.replace(
        "<compiler ", '<compiler inertiafromgeom="true" ', 1
    ),
}


@pytest.fixture
def edited(tmp_path, monkeypatch, real_panda):
    """Return a function that makes an edit the robot's file."""
    from robo47.panda.files import panda_folder

    folder = panda_folder()

    def edit(change):
        import shutil

        there = tmp_path / folder.name
        shutil.copytree(folder, there)
        path = there / "panda_nohand.xml"
        text = path.read_text("utf-8")
        new = change(text)
        assert new != text
        path.write_text(new, "utf-8")
        (there / "tool.xml").write_text(f"<mujocoinclude>{BOX}</mujocoinclude>")
        monkeypatch.setenv("MENAGERIE_ROOT", str(tmp_path))

    return edit


@pytest.mark.parametrize("name", EDITS)
def test_both_models_of_an_edited_file_weigh_the_same(edited, name):
    edited(EDITS[name])
    light, whole = panda.load(), panda.load(meshes=True)
    assert light.nbody == whole.nbody
    for field in ("body_mass", "body_ipos", "body_iquat", "body_inertia", "body_pos"):
        a, b = getattr(light, field), getattr(whole, field)
        np.testing.assert_allclose(a, b, atol=1e-12, err_msg=field)
    assert whole.body_mass.sum() > 16.692
    assert not light.geom_contype.any()


@pytest.fixture
def coupled():
    """A Panda with a tendon over joints 5 and 6 that does nothing yet."""

    def edit(spec):
        tendon = spec.add_tendon(name="strap")
        tendon.wrap_joint("joint5", 1.0)
        tendon.wrap_joint("joint6", -1.0)

    return panda.load(edit=edit)


def torques(model, q, qd, qdd):
    """Return MuJoCo's torques for a motion, without constraints."""
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = q, qd
    mujoco.mj_forward(model, data)
    inertial = np.zeros(model.nv)
    mujoco.mj_mulM(model, data, inertial, qdd)
    return inertial + data.qfrc_bias - data.qfrc_passive


def agrees_or_is_refused(model):
    q, qd, qdd = np.random.default_rng(47).uniform(-0.5, 0.5, (3, 7)) + panda.READY_Q
    try:
        arm = panda.arm(model)
    except Robo47Error as error:
        return "refused" if "no field for" in str(error) else str(error)
    now = arm.at(q)
    found = now.M @ qdd + now.bias(qd) + arm.damping * qd
    np.testing.assert_allclose(found, torques(model, q, qd, qdd), atol=1e-8)
    return "agrees"


FIELDS = ("jnt_", "dof_", "body_", "tendon_", "qpos", "actuator_")


def numbers(it, starts):
    return [
        name
        for name in dir(it)
        if name.startswith(starts)
        and isinstance(value := getattr(it, name), np.ndarray)
        and value.dtype == np.float64
        and value.size
    ]


@pytest.mark.parametrize("name", [
    *numbers(panda.load(), FIELDS),
    "tendon_armature", "tendon_stiffness", "tendon_damping",
])  # fmt: skip
def test_whatever_number_of_a_model_changes_the_arm_agrees_or_refuses(coupled, name):
    if not hasattr(coupled, name):
        return
    values = getattr(coupled, name)
    values += 0.3
    if name.endswith(("quat", "axis")):
        values /= np.linalg.norm(values, axis=-1, keepdims=True)
    coupled.body_sameframe[:] = coupled.body_simple[:] = 0  # worked out of the old
    assert agrees_or_is_refused(coupled) in ("agrees", "refused")


REFUSED = {
    "stiffness": lambda m: m.jnt_stiffness.__setitem__(2, 3.0),
    "frictionloss": lambda m: m.dof_frictionloss.__setitem__(2, 3.0),
    "gravcomp": lambda m: m.body_gravcomp.__setitem__(6, 1.0),
    "armature of tendon 'strap'": lambda m: m.tendon_armature.__setitem__(0, 0.5),
    "stiffness of tendon 'strap'": lambda m: m.tendon_stiffness.__setitem__(0, 5.0),
    "fluid": lambda m: setattr(m.opt, "density", 1000.0),
}


@pytest.mark.parametrize("word", REFUSED)
def test_what_an_arm_has_no_field_for_is_refused_by_name(coupled, word):
    if "armature" in word and not hasattr(coupled, "tendon_armature"):
        return
    REFUSED[word](coupled)
    with pytest.raises(Robo47Error, match=word):
        panda.arm(coupled)


def test_an_equality_on_the_arm_is_refused_and_the_fingers_own_is_not():
    def edit(spec):
        one = spec.add_equality(name="locked", type=mujoco.mjtEq.mjEQ_JOINT)
        one.name1 = "joint3"
        one.objtype = mujoco.mjtObj.mjOBJ_JOINT

    with pytest.raises(Robo47Error, match="locked"):
        panda.arm(panda.load(edit=edit))
    panda.arm(panda.load("panda"))


@pytest.mark.parametrize("flag", ["GRAVITY", "DAMPER", "PASSIVE"])
def test_the_models_flags_are_honoured(coupled, flag):
    bit = getattr(mujoco.mjtDisableBit, f"mjDSBL_{flag}", None)
    if bit is not None:
        coupled.opt.disableflags |= int(bit)
    assert agrees_or_is_refused(coupled) == "agrees"
