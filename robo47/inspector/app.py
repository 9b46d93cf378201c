"""The inspector as a whole: one arm, its scene and its panel, kept in step.

Every callback is a coroutine on the server's event loop, so changes come one after
the other, whichever browser they come from, and no lock is needed.
"""

import viser
from numpy.typing import ArrayLike

from robo47.inspector import words
from robo47.inspector.arm import END, Arm
from robo47.inspector.chain import Steps
from robo47.inspector.joints import Joints
from robo47.inspector.order import Order
from robo47.inspector.scene import ArmScene

TITLE = "robo47: SE(3) inspector"


class Inspector:
    """The page: what every connected browser sees."""

    def __init__(self, server: viser.ViserServer, arm: Arm, about: str) -> None:
        """Draw everything and wait for somebody to look.

        Args:
            server: already listening.
            arm: the one that every browser moves.
            about: the line that says which robot this is.
        """
        self.server, self.arm = server, arm
        gui = server.gui
        gui.set_panel_label(TITLE)
        self.scene = ArmScene(server, arm)
        gui.add_html(words.line(f"{about}; ee is {arm.chain.frame}", "about"))
        self.frame = gui.add_dropdown("Frame", tuple(arm.names))
        self.proof = gui.add_html("")
        self.limits = gui.add_html("")
        see_through = gui.add_checkbox("See-through", True)
        tabs = gui.add_tab_group()
        with tabs.add_tab("Joints"):
            self.joints = Joints(server, arm, self.move)
        with tabs.add_tab("Chain"):
            self.steps = Steps(server, arm, self.update)
        with tabs.add_tab("Order"):
            self.order = Order(server, arm, self.update)

        @self.frame.on_update
        async def _(_: object) -> None:
            self.update()

        @see_through.on_update
        async def _(_: object) -> None:
            self.scene.see_through(see_through.value)

        self.scene.see_through(see_through.value)
        self.update()

    def move(self, q: ArrayLike) -> None:
        """Move the arm, in every browser.

        Args:
            q: configuration, (nq,).
        """
        self.arm.move(q)
        self.update()

    def light(self) -> None:
        """Make the frame that the student is looking at stand out."""
        chosen: str | None = self.frame.value
        shown: list[str] | None = None
        if self.steps.lit:
            chosen, shown = self.steps.lit[-1], self.steps.lit
        elif self.order.side:
            chosen, shown = None, [END]  # its two products stand out instead
        self.scene.light(chosen, shown)
        self.scene.trace(self.steps.origins())

    def update(self) -> None:
        """Bring everything that is shown to the arm's present configuration."""
        with self.server.atomic():
            self.scene.update()
            self.light()
            self.proof.content = words.proof(self.arm, self.frame.value)
            self.limits.content = words.limits(self.arm)
            for part in (self.joints, self.steps, self.order):
                part.update()
