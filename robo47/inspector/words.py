"""Numbers as HTML for the panel: aligned, in one type width, readable without colour.

A matrix's columns take the colours of the triad: x red, y green, z blue, origin black.
"""

from html import escape

import numpy as np

from robo47.checks import Array
from robo47.inspector.arm import AGREES, Arm, Step, TwoOrders

_COLUMN_COLOURS = ("#c62828", "#2e7d32", "#1565c0", "inherit")
_GREEN, _RED = "#2e7d32", "#c62828"


def matrix(name: str, T: Array, key: str) -> str:
    """Return a pose as an aligned block under its name.

    Args:
        name: such as "T_world_ee".
        T: (4, 4).
        key: unique in the page, for who looks a matrix up there.
    """
    rows = "\n".join(
        "".join(
            f'<span style="color:{colour}">{entry:10.6f}</span>'
            for entry, colour in zip(row, _COLUMN_COLOURS, strict=True)
        )
        for row in np.round(T, 6) + 0.0  # + 0.0: no "-0.0"
    )
    return (
        f'<div style="margin:6px 10px 0;font-size:12px"><b>{escape(name)}</b></div>'
        f'<pre data-matrix="{escape(key)}" style="margin:0 10px;font-size:11.5px;'
        f'line-height:1.3;font-family:monospace">{rows}</pre>'
    )


def line(text: str, key: str, colour: str = "inherit") -> str:
    """Return one line of text."""
    return (
        f'<div data-line="{escape(key)}" style="margin:4px 10px;font-size:12px;'
        f'line-height:1.4;color:{colour}">{escape(text)}</div>'
    )


def verdict(difference: float) -> str:
    """Return the largest difference, in green where it is small enough."""
    if difference < AGREES:
        text = f"largest difference {difference:.1e}: they agree (under {AGREES:.0e})"
        return line(text, "difference", _GREEN)
    text = f"largest difference {difference:.1e}: THEY DIFFER (limit {AGREES:.0e})"
    return line(text, "difference", _RED)


def proof(arm: Arm, name: str) -> str:
    """Return one frame's pose from MuJoCo and by hand, and how far they differ.

    Args:
        arm: in its present configuration.
        name: short name of the frame.
    """
    full = arm.names[name]
    parts = [
        matrix(f"T_world_{name}, MuJoCo", arm.by_mujoco[full], "mujoco"),
        matrix(f"T_world_{name}, by hand", arm.by_hand[full], "by-hand"),
        verdict(arm.difference(name)),
    ]
    return "".join(parts)


def limits(arm: Arm) -> str:
    """Return a warning where the configuration is out of limits, else nothing."""
    broken = arm.out_of_limits()
    if not broken:
        return ""
    text = "OUT OF LIMITS: " + "; ".join(broken) + ". The real arm cannot go there."
    return line(text, "limits", _RED)


def step(this: Step, number: int, of: int, difference: float) -> str:
    """Return one link's product: the three matrices, and whether MuJoCo agrees.

    Args:
        this: the step.
        number: its place in the chain, from 1.
        of: how many there are.
        difference: between the product and MuJoCo's pose.
    """
    whole, before = f"T_world_{this.link}", f"T_world_{this.previous}"
    factor = f"T_{this.previous}_{this.link}"
    parts = [
        line(f"step {number} of {of}: {whole} = {before} @ {factor}", "step"),
        matrix(before, this.T_world_previous, "before"),
        matrix(f"@ {factor}", this.T_previous_link, "factor"),
        matrix(f"= {whole}", this.T_world_link, "product"),
        verdict(difference),
    ]
    return "".join(parts)


def two_orders(orders: TwoOrders, T_extra: Array, chosen: str) -> str:
    """Return T_extra, the chosen product, and how far apart both products end.

    Args:
        orders: both products.
        T_extra: (4, 4).
        chosen: "right" or "left".
    """
    if chosen == "right":
        name, T = "T_world_ee @ T_extra", orders.right
        says = "On the right: the tool moves along its own axes."
    else:
        name, T = "T_extra @ T_world_ee", orders.left
        says = "On the left: the whole arm is turned and moved in the world."
    parts = [
        matrix("T_extra", T_extra, "extra"),
        matrix(name, T, "order"),
        line(says, "says"),
        line(f"the two ends are {orders.metres:.4f} m apart", "apart"),
    ]
    return "".join(parts)
