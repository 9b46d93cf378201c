"""The tab that steps through the chain: one link, one product, one more frame lit."""

import asyncio
from collections.abc import Callable

import numpy as np
import viser

from robo47.checks import Array
from robo47.inspector import words
from robo47.inspector.arm import Arm

ALL = "all frames"
BACK, NEXT, PLAY = "back", "next", "play"
SECONDS_PER_STEP = 0.9


class Steps:
    """Which step of the chain is shown, and its three matrices."""

    def __init__(
        self, server: viser.ViserServer, arm: Arm, changed: Callable[[], None]
    ) -> None:
        """Build the tab's widgets in the container that is open.

        Args:
            server: whose panel.
            arm: read, never changed here.
            changed: called when another step was picked.
        """
        self.arm, self.changed = arm, changed
        self.links = [step.link for step in arm.steps()]
        self.playing: asyncio.Task[None] | None = None
        self.pick = server.gui.add_dropdown("Link", (ALL, *self.links))
        self.pick.on_update(self._picked)
        buttons = server.gui.add_button_group("Step", (BACK, NEXT, PLAY))
        buttons.on_click(self._pressed)
        self.product = server.gui.add_html("")
        self.update()

    @property
    def lit(self) -> list[str] | None:
        """The links reached so far, the present one last; None when not stepping."""
        if self.pick.value == ALL:
            return None
        return self.links[: self.links.index(self.pick.value) + 1]

    def origins(self) -> Array:
        """Return the origins of the frames lit so far, metres, (n, 3)."""
        steps = self.arm.steps()[: len(self.lit or [])]
        return np.array([step.T_world_link[:3, 3] for step in steps]).reshape(-1, 3)

    def update(self) -> None:
        """Show the picked link's product in the arm's present configuration."""
        if self.lit is None:
            self.product.content = words.line(
                "Pick a link, or press next: T_world_link is the product of the frame "
                "before it and one factor.",
                "step",
            )
            return
        k = len(self.lit) - 1
        this = self.arm.steps()[k]
        apart = self.arm.difference(this.link, this.T_world_link)
        self.product.content = words.step(this, k + 1, len(self.links), apart)

    async def _picked(self, _: object) -> None:
        self.changed()

    async def _pressed(self, event: viser.GuiEvent) -> None:
        if self.playing is not None:
            self.playing.cancel()
        if event.target.value == PLAY:
            self.playing = asyncio.create_task(self._play())
        else:
            self._go(+1 if event.target.value == NEXT else -1)

    def _go(self, by: int) -> None:
        options = (ALL, *self.links)
        at = options.index(self.pick.value) + by
        self._show(options[min(max(at, 0), len(options) - 1)])

    def _show(self, link: str) -> None:
        self.pick.value = link  # type: ignore[misc]  # tells _picked, too

    async def _play(self) -> None:
        for link in self.links:
            self._show(link)
            await asyncio.sleep(SECONDS_PER_STEP)
