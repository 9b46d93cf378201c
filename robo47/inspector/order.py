"""The tab that shows that order matters: T_extra on the right, or on the left."""

import math
from collections.abc import Callable

import viser

from robo47.inspector import words
from robo47.inspector.arm import END, Arm, extra
from robo47.inspector.scene import TwoOrdersScene

SIDES = {
    "off": None,
    "right: T_world_ee @ T_extra": "right",
    "left: T_extra @ T_world_ee": "left",
}


class Order:
    """T_extra, the side it is on, and both results."""

    def __init__(
        self, server: viser.ViserServer, arm: Arm, changed: Callable[[], None]
    ) -> None:
        """Build the tab's widgets in the container that is open.

        Args:
            server: whose panel and scene.
            arm: read, never changed here.
            changed: called when T_extra or its side changed.
        """
        self.arm, self.scene = arm, TwoOrdersScene(server)
        gui = server.gui
        self.choice = gui.add_dropdown("T_extra", tuple(SIDES))
        self.angle = gui.add_slider("turn z (rad)", -3.1416, 3.1416, 1e-4, 0.7854)
        self.x = gui.add_slider("move x (m)", -0.3, 0.3, 1e-3, 0.1)
        self.result = gui.add_html("")

        async def on_update(_: object) -> None:
            if math.isfinite(self.angle.value) and math.isfinite(self.x.value):
                changed()

        for widget in (self.choice, self.angle, self.x):
            widget.on_update(on_update)
        self.update()

    @property
    def side(self) -> str | None:
        """The side that T_extra is on: "right", "left", or None for neither."""
        return SIDES[self.choice.value]

    def update(self) -> None:
        """Compute both products for the arm's present configuration and show them."""
        self.scene.show(self.side)
        if self.side is None:
            self.result.content = words.line(
                "Multiply T_world_ee by one more pose, on either side: the same two "
                "factors end in two places.",
                "says",
            )
            return
        angle, x = self.angle.value, self.x.value
        both = self.arm.both_orders(angle, x)
        T_world_ee = self.arm.by_hand[self.arm.names[END]]
        self.scene.update(T_world_ee, both.right, both.left)
        self.result.content = words.two_orders(both, extra(angle, x), self.side)
