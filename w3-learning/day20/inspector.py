"""Day 20 in the inspector: the tab Reward.

Thirty estimates of one gradient are points of the scene: the first entry along x, the
second along y. The exact gradient is a small sphere. Two sliders change lambda and
the value function. The student's `gae` and `policy_gradient` compute the estimates, and
`policy_cost_gradient` the sphere.
"""

from functools import cache
from typing import NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import reward
from robo47.checks import Array

LAB = lab_of(find_day(20))
SOME, EACH = 30, 100  # estimates, and episodes of each
METRE = 0.04  # m in the scene for each unit of the gradient
TRUTH = (LAB.STD, LAB.A, LAB.B, LAB.Q, LAB.R, LAB.START, LAB.HORIZON)


class Cloud(NamedTuple):
    """Estimates of the gradient of the return, and what they should be."""

    estimates: Array  # (SOME, 2)
    exact: Array  # (2,)


@cache
def cart():
    """Return the episodes of the cart."""
    return LAB.Cart(np.random.default_rng(LAB.SEED), SOME * EACH)


class Reward(ui.Declared):
    """A cloud of estimates, and the exact gradient."""

    title = "Reward"
    library = reward
    functions = {"gae": "", "policy_gradient": "", "policy_cost_gradient": ""}
    arm_hidden = True
    camera = ((0.0, -0.5, 2.0), (0.2, 0.0, 0.0))

    lam = ui.slider("lambda", 0.0, 1.0, 1.0, "")
    share = ui.slider("value function: fraction of the exact one", 0.0, 1.0, 1.0, "")
    bars = ui.panel.bars(
        ["first entry", "second entry"], 10.0, "", "mean of the estimates", "both"
    )
    cloud = ui.scene.lines(ui.NOWHERE, "green", legend="one estimate each")
    exact = ui.scene.sphere(np.zeros(3), 0.02, "orange", legend="the exact gradient")

    def ask(self, fns, at) -> Cloud:
        some = cart()
        value = at.share * some.value
        end = np.zeros(some.reward.shape, dtype=bool)
        end[-1] = True
        advantage = np.asarray(
            fns.gae(some.reward, value[:-1], value[1:], end, end, 1.0, at.lam)
        )
        pairs = zip(
            np.split(some.score, SOME, axis=1),
            np.split(advantage, SOME, axis=1),
            strict=True,
        )
        found = fns.many(*(("policy_gradient", *pair) for pair in pairs))
        slope = np.asarray(fns.policy_cost_gradient(LAB.GAIN, *TRUTH))
        return Cloud(np.array(found, float), -slope[0])

    def show(self, yours: Cloud, right: Cloud) -> None:
        self.bars.show(yours.estimates.mean(axis=0), right.estimates.mean(axis=0))
        at = METRE * np.column_stack([yours.estimates, np.zeros(SOME)])
        up = np.array([0.0, 0.0, 0.02])
        self.cloud.points = np.stack([at - up, at + up], axis=1)
        self.exact.position = METRE * np.append(yours.exact, 0.0)

    def says(self, yours: Cloud, right: Cloud):
        mean, each = yours.estimates.mean(axis=0), yours.estimates.std(axis=0, ddof=1)
        yield (
            f"Mean estimate ({mean[0]:.2f}, {mean[1]:.2f}), exact gradient "
            f"({yours.exact[0]:.2f}, {yours.exact[1]:.2f})",
            "policy_gradient policy_cost_gradient",
        )
        yield f"std of one estimate: {np.linalg.norm(each):.2f}", "gae"


TABS = [Reward]
