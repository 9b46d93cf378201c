"""The sandbox's fake of MjModel."""

import copy

import numpy as np
import pytest

from labkit.base.exchange import Question
from labkit.judge import Robot
from labkit.sandbox.inside import fake_model, wire
from labkit.sandbox.messages import copy_model
from robo47 import panda

pytestmark = pytest.mark.kit


class TestTheFakeMjModel:
    """It reads like the real one, whichever way a student goes about it."""

    def pairs(self):
        real = panda.load("panda_nohand")
        data = copy_model(real)
        arrays = {n: wire.unpack_array(a) for n, a in data["arrays"].items()}
        return real, fake_model.MjModel(data, arrays)

    def test_has_every_size_and_array_of_the_real_one(self):
        real, ours = self.pairs()
        for name in dir(real):
            value = getattr(real, name)
            if isinstance(value, int | np.ndarray) and not name.startswith("_"):
                assert np.array_equal(value, getattr(ours, name), equal_nan=True), name

    @pytest.mark.parametrize(
        "kind", ["body", "joint", "jnt", "site", "actuator", "key"]
    )
    def test_gives_the_same_named_views(self, kind):
        real, ours = self.pairs()
        counts = {"body": real.nbody, "site": real.nsite, "actuator": real.nu}
        for i in range(counts.get(kind, real.nkey if kind == "key" else real.njnt)):
            want = getattr(real, kind)(i)
            for view in (getattr(ours, kind)(i), getattr(ours, kind)(want.name)):
                for name in (n for n in dir(want) if not n.startswith("_")):
                    a, b = getattr(want, name), getattr(view, name)
                    assert np.shape(a) == np.shape(b), name
                    assert np.array_equal(a, b), name

    def test_names_the_valid_ones_for_a_wrong_name(self):
        real, ours = self.pairs()
        for model in (real, ours):
            with pytest.raises(KeyError, match=r"Invalid name 'link9'.*'link7'"):
                model.body("link9")

    def test_can_be_copied(self):
        _, ours = self.pairs()
        assert copy.copy(ours.body("link1")).name == "link1"

    def test_says_what_it_lacks(self):
        with pytest.raises(AttributeError, match="copy of the model has no 'opt'"):
            _ = self.pairs()[1].opt

    def test_answers_mj_name2id_and_the_enums(self, ask):
        code = """
            import mujoco
            import numpy as np
            def f(model: mujoco.MjModel, data: mujoco.MjData | None = None):
                kind = mujoco.mjtObj.mjOBJ_BODY
                i = mujoco.mj_name2id(model, kind, "link4")
                assert mujoco.mj_id2name(model, kind, i) == "link4"
                assert mujoco.mj_name2id(model, kind, "nobody") == -1
                assert model.jnt_type[0] == mujoco.mjtJoint.mjJNT_HINGE
                return np.array(i)
        """
        (reply,) = ask(code, Question("1.6", "f", (Robot(),)))
        assert reply.value == panda.load("panda_nohand").body("link4").id
