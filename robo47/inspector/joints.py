"""The tab with a slider per joint, and the configurations that have a name."""

import math
import secrets
from collections.abc import Callable

import mujoco
import viser
from numpy.typing import ArrayLike

from robo47.inspector import words
from robo47.inspector.arm import Arm

STEP = 1e-4  # the Panda's limits have four decimals, so every value on the way too
RANDOM = "random"


class Joints:
    """Sliders and buttons that move the arm."""

    def __init__(
        self, server: viser.ViserServer, arm: Arm, move: Callable[[ArrayLike], None]
    ) -> None:
        """Build the tab's widgets in the container that is open.

        Args:
            server: whose panel.
            arm: read, never changed here.
            move: called with a new configuration, (nq,).
        """
        self.arm, self.move = arm, move
        buttons = server.gui.add_button_group("Go to", (*arm.named_q, RANDOM))
        buttons.on_click(self._go_to)
        self.sliders = [self._slider(server, i) for i in range(len(arm.joints))]
        self.exact = server.gui.add_html("")
        self.update()

    def update(self) -> None:
        """Set every slider to the arm's present configuration."""
        for slider, q in zip(self.sliders, self.arm.q, strict=True):
            slider.value = float(q)  # type: ignore[misc]
        numbers = ", ".join(f"{q:.5g}" for q in self.arm.q)
        self.exact.content = words.line(f"q = [{numbers}]", "q")

    def _slider(
        self, server: viser.ViserServer, i: int
    ) -> viser.GuiSliderHandle[float]:
        joint = self.arm.joints[i]
        low, high = self.arm.limits(joint)
        kind = self.arm.model.joint(joint).type[0]
        unit = " (m)" if kind == mujoco.mjtJoint.mjJNT_SLIDE else ""
        start = min(max(float(self.arm.q[i]), low), high)
        slider = server.gui.add_slider(f"{joint}{unit}", low, high, STEP, start)

        @slider.on_update
        async def _(_: object) -> None:
            # Also called when the program sets it; then there is nothing to do.
            if slider.value != self.arm.q[i] and math.isfinite(slider.value):
                q = self.arm.q.copy()
                q[i] = slider.value
                self.move(q)

        return slider

    async def _go_to(self, event: viser.GuiEvent) -> None:
        name = event.target.value
        if name == RANDOM:
            self.move(self.arm.random_q(secrets.randbits(32)))
        else:
            self.move(self.arm.named_q[name])
