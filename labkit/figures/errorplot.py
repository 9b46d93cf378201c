"""The distribution of an error, link by link, as hills above each other."""

import io
from collections.abc import Mapping

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure  # not pyplot, which may look for a display
from PIL import Image

from robo47.checks import Array

BLUE, RED, INK, RULE = "#1c64f2", "#e03131", "#212529", "#dee2e6"
ROUNDING = 2.0**-53  # the largest error of rounding a number near 1 to float64
# One bar per power of two: a float64 near 1 has no finer steps than these.
EDGES = 2.0 ** np.arange(-56.0, -24.0)


def ridges(errors: Mapping[str, Array], limit: float) -> Image.Image:
    """Return the picture: a row of bars per frame, the first at the bottom.

    Args:
        errors: {frame: largest entry of |T - T_mujoco| per configuration, (n,)}.
        limit: the error that is still accepted, drawn as a line.
    """
    figure = Figure(figsize=(12, 8), dpi=100, layout="constrained")
    with matplotlib.rc_context({"font.size": 19, "axes.linewidth": 1.2}):
        axes = figure.subplots()
        for row, error in enumerate(errors.values()):
            _hill(axes, row, error)
        worst = max(float(error.max()) for error in errors.values())
        _dress(axes, list(errors), len(next(iter(errors.values()))))
        _guide(axes, ROUNDING, "one rounding of a float64", ":")
        _guide(axes, limit, f"limit {limit:.0e}", "--")
        axes.text(
            np.sqrt(20 * worst * limit), len(errors) / 2,
            f"the worst is\n{_leading(limit / worst):,} times\nsmaller than the limit",
            ha="center", va="center", color=INK, fontsize=22, linespacing=1.5,
            bbox={"facecolor": "white", "edgecolor": "none"},
        )  # fmt: skip
    return _to_image(figure)


def _hill(axes: Axes, row: int, error: Array) -> None:
    share = np.histogram(error, EDGES)[0] / len(error)
    axes.axhline(row, color=RULE, linewidth=1, zorder=0)
    axes.bar(EDGES[:-1], share, 0.94 * np.diff(EDGES), row, align="edge", color=BLUE)
    axes.plot([error.max()] * 2, [row, row + 0.42], color=RED, linewidth=4)
    words = f"worst {error.max():.1e}"
    if exact := (error == 0).mean():
        words += f"  ({exact:.0%} exactly 0)" if exact > 0.005 else ""
    axes.text(1.7 * error.max(), row + 0.1, words, color=RED, fontsize=17)


def _guide(axes: Axes, x: float, words: str, style: str) -> None:
    top = axes.get_ylim()[1]
    axes.plot([x, x], [-1, top], color=INK, linestyle=style, linewidth=2, zorder=0)
    axes.text(x, top + 0.08, words, ha="center", color=INK, fontsize=17)


def _dress(axes: Axes, names: list[str], n: int) -> None:
    axes.set_title(f"robo47.kinematics against MuJoCo: {n:,} configurations", pad=44)
    axes.set_xscale("log")
    axes.set_xlim(1e-17, 1e-7)
    axes.set_ylim(-0.15, len(names))
    axes.set_yticks(range(len(names)), names)
    axes.set_xlabel("largest entry of |T − T_mujoco|  (m, or no unit)")
    axes.tick_params(axis="y", length=0)
    axes.spines[["top", "right", "left"]].set_visible(False)


def _leading(number: float) -> int:
    """Return a number with all but its first digit 0."""
    unit = 10 ** int(np.log10(number))
    return int(number // unit) * unit


def _to_image(figure: Figure) -> Image.Image:
    file = io.BytesIO()
    figure.savefig(file, format="png")
    return Image.open(file).convert("RGB")
