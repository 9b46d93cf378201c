"""The clip of Day 18: two equal policies, whose p-value is looked at all the time.

make figures DAY=18 ARGS=--clips    figures/day18_looks.webp
"""

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from labkit.figures import chart
from labkit.figures.chart import BLUE, GREY, INK, RED
from labkit.figures.clip import Frame
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

LAB = lab_of(find_day(18))
RATE = 0.7  # of both policies
TRIALS = 40
SEED = 3
ENDS = np.arange(10, 201, 10)
SECONDS = 0.35  # that a frame is seen


def p_values() -> np.ndarray:
    """Return the p-value of each trial after every 10 starts, (TRIALS, 20)."""
    rng = np.random.default_rng(SEED)
    found = []
    for _ in range(TRIALS):
        one, two = rng.random((2, LAB.TESTED)) < RATE
        found.append([LAB.sign_test(one[:n], two[:n]) for n in ENDS])
    return np.array(found)


def frames() -> Iterator[Frame]:
    """Yield the clip's frames and how long each is seen."""
    p = p_values()
    for k in range(1, len(ENDS) + 1):
        last = k == len(ENDS)
        yield Frame(_moment(p[:, :k])(), 2.0 if last else SECONDS)


def _moment(p: np.ndarray):
    """Return what draws all trials so far; those with p <= 0.05 at any time are red."""
    k = p.shape[1]
    alarm = (p <= 0.05).any(axis=1)

    @chart.picture(height=3.6, width=6.4)
    def looks(figure: Figure) -> None:
        axes = figure.subplots()
        for one, red in sorted(zip(p, alarm, strict=True), key=lambda some: some[1]):
            colour, wide = (RED, 2.0) if red else (BLUE, 0.8)
            axes.plot(ENDS[:k], one, color=colour, linewidth=wide)
        axes.axhline(0.05, color=INK, linewidth=1.5)
        axes.set(xlim=(0, 200), ylim=(0.0006, 1.3), yscale="log", xlabel="starts")
        axes.set_yticks(
            (0.001, 0.01, 0.05, 0.2, 1.0), ("0.001", "0.01", "0.05", "0.2", "1")
        )
        axes.minorticks_off()
        axes.set(ylabel="p-value")
        axes.set_title(f"{alarm.sum()} of {len(p)} equal pairs were below 0.05")
        axes.spines[:].set_color(GREY)

    return looks


CLIPS = {"looks": frames}
