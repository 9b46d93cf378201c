"""The tab with a slider per joint, and the configurations that have a name."""

import math
import secrets
from collections.abc import Callable

import mujoco
import numpy as np

from labkit.inspector import typed, words
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47.checks import Array

RANDOM, UNDO = "random", "undo"
# "home" is two things in this course; the text under the buttons says which is which.
ABOUT = (
    "ready is READY_Q of the labs, home the model's own key. In q you can type pi/2 "
    "or 90 deg, and paste an array. Click a link to see its axis."
)


class Joints(Tab):
    """Sliders and buttons that move the arm."""

    title = "Joints"

    def __init__(self, page: Page) -> None:
        """Make a slider for every joint, the buttons, and a box for all of q."""
        super().__init__(page)
        self.buttons = page.buttons([*page.arm.named_q, RANDOM, UNDO], self.go_to)
        self.sliders = [
            page.slider(
                joint, *page.arm.limits(joint), float(page.q[i]), self.mover(i),
                unit="m" if self.slides(joint) else "",
            )
            for i, joint in enumerate(page.arm.joints)
        ]  # fmt: skip
        self.box = page.gui.add_text("q", "")
        page.listen(self.box, self.type)
        self.exact = page.html()

    def slides(self, joint: str) -> bool:
        """Return whether a joint's number is in metres."""
        return self.page.model.joint(joint).type[0] == mujoco.mjtJoint.mjJNT_SLIDE

    def mover(self, i: int) -> Callable[[float], None]:
        """Return what sets one number of the configuration and leaves the others."""

        def set_joint(value: float) -> None:
            q = self.page.q
            q[i] = value
            self.page.move(q)

        return set_joint

    def type(self, text: str) -> None:
        """Take the arm where the box says, once that is a configuration."""
        try:
            self.page.move(typed.configuration(text, self.page.model.nq))
            self.page.say("")
        except ValueError as error:
            self.page.say(str(error), "bad")

    def go_to(self, name: str) -> None:
        """Take the arm to a configuration with a name, or anywhere."""
        if name == UNDO:
            self.page.host.undo()
        elif name == RANDOM:
            self.page.move(self.page.arm.random_q(secrets.randbits(32)))
        else:
            self.page.move(self.page.arm.named_q[name])

    def on_move(self, q: Array) -> None:
        """Set every slider, and the box that says q with all its digits."""
        for slider, value in zip(self.sliders, q, strict=True):
            slider.value = float(value)  # type: ignore[misc]
        if not self._says(q):  # nothing is taken from under somebody's hand
            text = ", ".join(f"{x:.10g}" for x in q)
            self.box.value = text  # type: ignore[misc]
            self.page.say("")
        degrees = ", ".join(
            f"{x:.4g} m" if self.slides(joint) else f"{math.degrees(x):.4g}°"
            for joint, x in zip(self.page.arm.joints, q, strict=True)
        )
        self.exact.content = (
            words.line(degrees, "degrees", "quiet")
            + '<div class="r47-row">'
            + words.copy_button("copy q as NumPy", words.numpy_q(q))
            + words.copy_button("copy T_world_ee", words.numpy_T(self.page.pose("ee")))
            + "</div>"
            + words.line(ABOUT, "about-buttons", "quiet")
        )

    def _says(self, q: Array) -> bool:
        """Return whether the box says this already, in whatever words."""
        try:
            said = typed.configuration(self.box.value, len(q))
        except ValueError:
            return False
        return np.allclose(said, q, rtol=0.0, atol=1e-9)
