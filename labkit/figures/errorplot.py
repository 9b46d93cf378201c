"""The distribution of an error, link by link, as hills above each other."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from labkit.figures import chart
from labkit.figures.chart import BLUE, INK, RED, RULE
from robo47.checks import Array

ROUNDING = 2.0**-53  # the largest error of rounding a number near 1 to float64
# One bar per power of two: a float64 near 1 has no finer steps than these.
EDGES = 2.0 ** np.arange(-56.0, -24.0)


@chart.picture(height=7.0)
def ridges(figure: Figure, errors: Mapping[str, Array], limit: float) -> None:
    """Draw a row of bars per frame, the first at the bottom.

    Args:
        figure: to draw on; `chart.picture` gives it.
        errors: {frame: largest entry of |T - T_mujoco| per configuration, (n,)}.
        limit: the error that is still accepted, drawn as a line.
    """
    axes = figure.subplots()
    for row, error in enumerate(errors.values()):
        _hill(axes, row, error)
    worst = max(float(error.max()) for error in errors.values())
    times = int(limit / worst)
    times -= times % 10 ** (len(str(times)) - 1)  # all but its first digit are 0
    _dress(axes, list(errors), len(next(iter(errors.values()))))
    _guide(axes, ROUNDING, "one rounding", ":")
    _guide(axes, limit, f"limit {limit:.0e}", "--")
    axes.text(
        3 * np.sqrt(20 * worst * limit), len(errors) / 2,
        f"the worst is\n{times:,} times\nsmaller than\nthe limit",
        ha="center", va="center", linespacing=1.5,
        bbox={"facecolor": "white", "edgecolor": "none"},
    )  # fmt: skip


def _hill(axes: Axes, row: int, error: Array) -> None:
    share = np.histogram(error, EDGES)[0] / len(error)
    axes.axhline(row, color=RULE, linewidth=1, zorder=0)
    axes.bar(EDGES[:-1], share, 0.94 * np.diff(EDGES), row, align="edge", color=BLUE)
    axes.plot([error.max()] * 2, [row, row + 0.42], color=RED, linewidth=4)
    words = f"worst {error.max():.1e}"
    if exact := (error == 0).mean():
        words += f" ({exact:.0%} are 0)" if exact > 0.005 else ""
    axes.text(1.7 * error.max(), row + 0.1, words, color=RED, fontsize=chart.SMALL)


def _guide(axes: Axes, x: float, words: str, style: str) -> None:
    top = axes.get_ylim()[1]
    axes.plot([x, x], [-1, top], color=INK, linestyle=style, linewidth=2, zorder=0)
    axes.text(x, top + 0.08, words, ha="center", fontsize=chart.SMALL)


def _dress(axes: Axes, names: list[str], n: int) -> None:
    axes.set_title(f"against MuJoCo at {n:,} configurations", pad=40)
    axes.set_xscale("log")
    axes.set_xlim(1e-17, 1e-7)
    axes.set_ylim(-0.15, len(names))
    axes.set_yticks(range(len(names)), names)
    axes.set_xlabel("largest entry of |T − T_mujoco|  (m, or no unit)")
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
