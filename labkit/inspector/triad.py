"""A frame, drawn as three arrows; one of them may stand out, with letters on its axes.

x is orange-red, y teal, z blue: they stay apart where red and green do not. Metres.
"""

from typing import Literal

import numpy as np
import viser

from robo47 import se3
from robo47.checks import Array

AXES = np.array([(222, 70, 20), (0, 158, 115), (20, 100, 230)], dtype=np.uint8)
PLAIN, CHOSEN = 0.10, 0.17  # length of an axis
Anchor = Literal["bottom-left", "center-left", "center-right", "top-right"]


class Triad:
    """A frame with its name beside it."""

    def __init__(
        self,
        server: viser.ViserServer,
        path: str,
        text: str,
        anchor: Anchor = "bottom-left",
        letters: bool = False,
    ) -> None:
        """Draw it at the world's origin.

        Args:
            server: where to draw.
            path: its name in the scene tree.
            text: the label; "" for none.
            anchor: which side of the label touches the frame.
            letters: name the axes even while it does not stand out.
        """
        scene = server.scene
        self.always = letters
        self.frame = scene.add_frame(path, show_axes=False)
        self.arrows = scene.add_arrows(f"{path}/axes", _ends(PLAIN), AXES)
        self.letters = [
            scene.add_label(f"{path}/{name}", name, anchor="center-center",
                            font_screen_scale=0.75)
            for name in "xyz"
        ]  # fmt: skip
        if text:
            scene.add_label(f"{path}/name", text, anchor=anchor, font_screen_scale=0.75)
        self.state: tuple[bool, bool] | None = None
        self.show(visible=True, chosen=False)

    def place(self, T: Array) -> None:
        """Move it to a pose, (4, 4)."""
        place(self.frame, T)

    def show(self, visible: bool, chosen: bool) -> None:
        """Show or hide it; the chosen one is larger and has letters."""
        if self.state == (visible, chosen):
            return
        self.state = visible, chosen
        length = CHOSEN if chosen else PLAIN
        self.frame.visible = visible
        self.arrows.points = _ends(length)
        self.arrows.shaft_radius = 0.03 * length
        self.arrows.head_radius, self.arrows.head_length = 0.09 * length, 0.2 * length
        for axis, letter in zip(np.eye(3), self.letters, strict=True):
            letter.position = 1.12 * length * axis
            letter.visible = chosen or self.always


def _ends(length: float) -> "np.ndarray":
    points = np.zeros((3, 2, 3), dtype=np.float32)
    points[:, 1] = length * np.eye(3)
    return points


def place(node: viser.SceneNodeHandle, T: Array) -> None:
    """Put a node of the scene at a pose, (4, 4)."""
    node.wxyz, node.position = se3.R_to_quat(T[:3, :3]), T[:3, 3]
