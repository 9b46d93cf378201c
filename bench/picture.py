"""bench.png: the rivals as bars, and the two curves that should be flat or straight."""

from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt

OURS, OTHERS = "#0a7d5a", "#9aa5b1"


def draw(results: dict[str, Any], path: Path) -> None:
    """Draw the results.

    Args:
        results: what bench/results.json holds; "fk" and "growth" are drawn.
        path: the PNG to write.
    """
    plt.rcParams.update({"font.size": 11, "axes.spines.top": False})
    plt.rcParams["axes.spines.right"] = False
    figure, (bars, count, joints) = plt.subplots(
        1, 3, figsize=(15, 4.6), width_ratios=(1.5, 1, 1), layout="constrained"
    )
    if "fk" in results:
        _bars(bars, results["fk"]["rows"])
    growth = results["growth"]
    _curve(count, growth["by_count"], "configurations at once", log=True)
    count.set_title("flat from a thousand on")
    count.set_ylabel("µs per configuration")
    _curve(joints, growth["by_joints"], "joints of the robot", log=False)
    joints.set_title("straight in the joints")
    joints.set_ylim(bottom=0)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _bars(axes: plt.Axes, rows: dict[str, Any]) -> None:
    ordered = sorted(rows.items(), key=lambda item: -item[1]["us"])
    names = [name for name, _ in ordered]
    us = [row["us"] for _, row in ordered]
    colours = [OURS if name.startswith("robo47") else OTHERS for name in names]
    axes.barh(names, us, color=colours)
    axes.set_xscale("log")
    axes.set_xlabel("µs per configuration (log)")
    axes.set_title("the Panda's forward kinematics")
    for i, value in enumerate(us):
        axes.annotate(
            f" {value:.2f}" if value < 10 else f" {value:.0f}", (value, i), va="center"
        )
    axes.set_xlim(right=max(us) * 4)


def _curve(axes: plt.Axes, points: dict[str, float], label: str, *, log: bool) -> None:
    x = [float(n) for n in points]
    axes.plot(x, list(points.values()), "o-", color=OURS)
    if log:
        axes.set_xscale("log")
        axes.set_yscale("log")
    axes.set_xlabel(label)
    axes.grid(alpha=0.3)
