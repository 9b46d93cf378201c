"""Day 18 in the inspector: the tab Luck.

Two policies succeed with the probabilities of two sliders. The student's `sign_test`
compares them after every 10 starts. `gap_by_luck` computes how often luck alone makes
such a difference, and `paired_power` how often a test of so many starts reports one.
"""

from typing import NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from robo47 import evaluation
from robo47.checks import Array
from robo47.policy import success_rate

MOST = 200  # starts
EACH = 10  # starts between two tests
LEVEL = 0.05
WIDE = 0.006  # m between two starts in the scene


class Tested(NamedTuple):
    """Two policies on the same starts, and what the functions return."""

    first: Array  # successes, (n,)
    second: Array
    p: Array  # after every 10 starts
    luck: float
    power: float


def drawn(at) -> tuple[Array, Array]:
    """Return the successes of both policies on all starts, True and False."""
    rng = np.random.default_rng(round(at.seed))
    one, two = rng.random((2, MOST))
    return one < at.first, two < at.second


class Luck(ui.Declared):
    """Two policies, and the p-value of their difference while the starts go on."""

    title = "Luck"
    library = evaluation
    functions = {"sign_test": "", "gap_by_luck": "", "paired_power": ""}
    arm_hidden = True
    camera = ((0.0, -1.2, 0.9), (0.0, 0.0, 0.1))

    first = ui.slider("success rate of the first policy", 0.02, 0.98, 0.8, "")
    second = ui.slider("success rate of the second policy", 0.02, 0.98, 0.7, "")
    starts = ui.slider("starts", EACH, MOST, 100.0, "", EACH)
    seed = ui.slider("seed of the starts", 1, 50, 1.0, "", 1)
    bars = ui.panel.bars(
        ["luck alone", "power"], 1.0, "", "probabilities for so many starts", "both"
    )
    plot = ui.panel.plot(["p-value", "0.05"], x="starts", y="p-value", height=170)
    wins = ui.scene.lines(ui.NOWHERE, "green", legend="only the first succeeds")
    losses = ui.scene.lines(ui.NOWHERE, "red", legend="only the second succeeds")

    def ask(self, fns, at) -> Tested:
        first, second = drawn(at)
        n = round(at.starts)
        ends = range(EACH, n + 1, EACH)
        p = fns.many(*(("sign_test", first[:k], second[:k]) for k in ends))
        gap = abs(int(first[:n].sum()) - int(second[:n].sum()))
        rate = float((at.first + at.second) / 2)
        win = float(at.first * (1 - at.second))
        lose = float(at.second * (1 - at.first))
        luck, power = fns.many(
            ("gap_by_luck", rate, n, gap), ("paired_power", win, lose, n, LEVEL)
        )
        return Tested(first[:n], second[:n], np.array(p, float), luck, power)

    def show(self, yours: Tested, right: Tested) -> None:
        n = len(yours.first)
        self.bars.show([yours.luck, yours.power], [right.luck, right.power])
        ends = np.arange(EACH, n + 1, EACH)
        self.plot.show(ends, [yours.p, np.full(len(ends), LEVEL)])
        only = yours.first & ~yours.second
        self.wins.points = self.marks(only, 0.08)
        self.losses.points = self.marks(yours.second & ~yours.first, -0.08)

    @staticmethod
    def marks(some: Array, height: float) -> Array:
        """Return a line for each of some starts, (k, 2, 3)."""
        x = WIDE * (np.flatnonzero(some) - MOST / 2)
        ends = [np.column_stack([x, 0 * x, 0.1 + h + 0 * x]) for h in (0.0, height)]
        found = np.stack(ends, axis=1)
        return found if len(found) else np.asarray(ui.NOWHERE)

    def says(self, yours: Tested, right: Tested):
        for name, some in (("first", yours.first), ("second", yours.second)):
            rate, low, high = success_rate(some)
            yield f"{name}: {rate:.2f}, 95 %: {low:.2f} to {high:.2f}", None
        yield f"By your sign test p is {yours.p[-1]:.3f}.", "sign_test"
        looked = np.sum(yours.p <= LEVEL)
        yield f"In {looked} of {len(yours.p)} comparisons p was at most 0.05.", None
        yield (
            f"Two tests of one policy differ by so much in {100 * yours.luck:.0f} %.",
            "gap_by_luck",
        )
        yield f"The power is {100 * yours.power:.0f} %.", "paired_power"


TABS = [Luck]
