"""Any MuJoCo scene in the Panda's place: in a question, on the page, in a picture."""

import numpy as np
import pytest

from labkit.base.exchange import Question
from labkit.commands.view import end_of
from labkit.inspector.arm import AGREES, Arm
from labkit.judge import Robot
from labkit.judge.ask import model_of
from robo47.errors import Robo47Error

ARM = """
<mujoco>
  <worldbody>
    <body name="upper"><joint name="a" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.05" rgba="0.8 0.3 0.2 1"/>
      <body name="lower" pos="0.5 0 0"><joint name="b" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.04"/>
        <site name="tip" pos="0.4 0 0"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "arm.xml"
    path.write_text(ARM)
    return path


def test_a_question_may_hold_it(ask, file):
    code = """
        def f(model):
            return model.body("lower").pos + model.nq
    """
    (reply,) = ask(code, Question("1.1", "f", (Robot(file),)))
    np.testing.assert_array_equal(reply.value, [2.5, 2.0, 2.0])


def test_a_file_that_is_none_is_named(tmp_path):
    (tmp_path / "broken.xml").write_text("<mujoco><wheel/></mujoco>")
    for name in ("broken.xml", "gone.xml"):
        with pytest.raises(Robo47Error, match=f"{name}: MuJoCo cannot load it"):
            model_of(tmp_path / name)


def test_the_page_moves_it_and_both_judges_agree(file):
    model = model_of(file)
    arm = Arm(model, end_of(model))
    assert list(arm.named_q) == ["home", "zero"]
    arm.move([0.0, np.pi / 2])
    np.testing.assert_allclose(arm.pose("ee")[:3, 3], [0.5, 0.0, -0.4], atol=1e-12)
    assert arm.difference("ee", arm.by_library["ee"]) < AGREES


@pytest.mark.gl
def test_a_picture_shows_it(gl, file):
    pytest.importorskip("PIL")
    from labkit.figures import client
    from labkit.figures.scene import Camera, Scene

    camera = Camera(lookat=(0.4, 0.0, 0.2), distance=2.0)
    picture = client.draw(
        Scene(np.array([-0.8, 0.9]), (320, 240), camera, robot=str(file))
    )
    red = (picture[..., 0] > 120) & (picture[..., 1] < 100)
    assert 300 < red.sum() < 10_000  # the upper arm alone
