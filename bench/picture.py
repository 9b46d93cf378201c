"""bench.png: the rivals as dots, and the two curves that should be flat or straight."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from labkit.figures import chart

OURS, OTHERS = chart.BLUE, chart.GREY


def draw(results: dict[str, Any], path: Path) -> None:
    """Draw "fk" and "growth" of what bench/results.json holds, as a PNG."""
    _panels(results).quantize(256, dither=0).save(path, optimize=True)


@chart.picture(height=8.5)
def _panels(figure: Figure, results: dict[str, Any]) -> None:
    above, below = figure.subfigures(2, 1, height_ratios=(1.3, 1))
    if "fk" in results:
        _rivals(above.subplots(), results["fk"]["rows"])
    count, joints = below.subplots(1, 2)
    growth = results["growth"]
    _curve(count, growth["by_count"], "configurations at once")
    count.set(title="flat from 1,000 on", xscale="log", yscale="log")
    count.set_ylabel("µs per configuration")
    _curve(joints, growth["by_joints"], "joints of the robot")
    joints.set_title("straight in the joints")
    joints.set_ylim(bottom=0)


def _rivals(axes: Axes, rows: dict[str, Any]) -> None:
    """Draw dots with their range: on a log axis, a bar's length would mean nothing."""
    ordered = sorted(rows.items(), key=lambda item: -item[1]["us"])
    for i, (name, row) in enumerate(ordered):
        ours = name.startswith("robo47")
        us = row["us"]
        colour = OURS if ours else OTHERS
        axes.plot([row["low"], row["high"]], [i, i], color=colour, alpha=0.5)
        axes.plot(us, i, "o" if ours else "D", color=colour)
        words = f"{us:.2f}" if us < 10 else f"{us:.0f}"
        place = {"xytext": (10, 0), "textcoords": "offset points"}
        at = (row["high"], i)
        axes.annotate(words, at, va="center", fontsize=chart.SMALL, **place)
    axes.set_yticks(range(len(ordered)), [name for name, _ in ordered])
    axes.grid(axis="y")
    axes.set(xscale="log", xlabel="µs per configuration")
    axes.set_title("forward kinematics of the Panda", loc="left")
    axes.set_xlim(right=12 * ordered[0][1]["us"])


def _curve(axes: Axes, points: dict[str, float], label: str) -> None:
    axes.plot([float(n) for n in points], list(points.values()), "o-", color=OURS)
    axes.set_xlabel(label)
    axes.grid()
