"""The tab with a slider per joint, and the configurations that have a name."""

import math
import secrets
from collections.abc import Callable

import mujoco

from labkit.inspector import controls, words
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47.checks import Array

RANDOM, UNDO = "random", "undo"
# "home" is two things in this course; the text under the buttons says which is which.
ABOUT = (
    "ready is READY_Q of the labs, home the model's own key. Arrow keys move a joint "
    "by 0.01 rad, with Shift by 0.1, with Alt by 0.001. Type pi/2 or 90 deg."
)


class Joints(Tab):
    """Sliders and buttons that move the arm."""

    title = "Joints"

    def __init__(self, page: Page) -> None:
        """Make a slider for every joint, and the buttons."""
        super().__init__(page)
        page.buttons([*page.arm.named_q, RANDOM, UNDO], self.go_to)
        self.sliders = [
            page.slider(
                joint, *page.arm.limits(joint), float(page.q[i]), self.mover(i),
                unit=self.unit(joint),
            )
            for i, joint in enumerate(page.arm.joints)
        ]  # fmt: skip
        self.exact = page.html()

    def unit(self, joint: str) -> str:
        """Return the unit of a joint's number."""
        slides = self.page.model.joint(joint).type[0] == mujoco.mjtJoint.mjJNT_SLIDE
        return "m" if slides else "rad"

    def mover(self, i: int) -> Callable[[float], None]:
        """Return what sets one number of the configuration and leaves the others."""

        def set_joint(value: float) -> None:
            q = self.page.q
            q[i] = value
            self.page.move(q)

        return set_joint

    def go_to(self, name: str) -> None:
        """Take the arm to a configuration with a name, or anywhere."""
        if name == UNDO:
            self.page.undo()
        elif name == RANDOM:
            self.page.move(self.page.arm.random_q(secrets.randbits(32)))
        else:
            self.page.move(self.page.arm.named_q[name])

    def on_move(self, q: Array) -> None:
        """Set every slider, and the line that says q with all its digits."""
        for slider, value in zip(self.sliders, q, strict=True):
            slider.set(float(value))
        numbers = ", ".join(f"{x:.10g}" for x in q)
        degrees = ", ".join(
            f"{math.degrees(x):.4g}°" if self.unit(joint) == "rad" else f"{x:.4g} m"
            for joint, x in zip(self.page.arm.joints, q, strict=True)
        )
        T = self.page.pose("ee")
        self.exact.content = (
            words.line(f"q = [{numbers}]", "q")
            + words.line(degrees, "degrees", "quiet")
            + '<div class="r47-row">'
            + controls.copy_button("copy q as NumPy", words.numpy_q(q))
            + controls.copy_button("copy T_world_ee", words.numpy_T(T))
            + "</div>"
            + words.line(ABOUT, "about-buttons", "quiet")
        )
