"""The tab that multiplies the chain: one factor at a time, one more frame lit."""

from collections.abc import Callable

import numpy as np

from labkit.inspector import words
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab
from robo47.checks import Array

BACK, NEXT, PLAY = "back", "next", "play / stop"
SECONDS_PER_STEP = 0.9


class Chain(Tab):
    """Which factor of the chain is shown, and its three matrices."""

    title = "Chain"
    wide = True  # three matrices of its own

    def __init__(self, page: Page) -> None:
        """Start at the first joint."""
        super().__init__(page)
        steps = page.arm.steps()
        self.at = next(i for i, step in enumerate(steps) if step.joint)
        self.buttons = page.buttons([BACK, NEXT, PLAY], self.press)
        self.playing = page.animate(self.play, 1 / SECONDS_PER_STEP)
        self.product = page.html()
        self.sliders = {
            step.joint: page.slider(
                step.joint, *page.arm.limits(step.joint), step.q, self.mover(step.joint)
            )
            for step in steps
            if step.joint
        }

    def mover(self, joint: str) -> Callable[[float], None]:
        """Return what sets one joint and leaves the others."""
        adr = int(self.page.model.joint(joint).qposadr[0])

        def set_joint(value: float) -> None:
            q = self.page.q
            q[adr] = value
            self.page.move(q)

        return set_joint

    def press(self, name: str) -> None:
        """Go one factor back or on, or play them all."""
        if name != PLAY:
            self.playing.stop()
            self.go(self.at + (1 if name == NEXT else -1))
        elif self.playing.running:
            self.playing.stop()
        else:
            self.playing.start()

    def play(self, seconds: float) -> bool:
        """Show the next factor; return whether there is one more."""
        self.go(round(seconds / SECONDS_PER_STEP))
        return self.at < len(self.page.arm.steps()) - 1

    def go(self, at: int) -> None:
        """Show a factor by its place in the product."""
        self.at = min(max(at, 0), len(self.page.arm.steps()) - 1)
        self.on_move(self.page.q)

    def on_move(self, q: Array) -> None:
        """Show the factor in the arm's present configuration."""
        steps = self.page.arm.steps()
        this = steps[self.at]
        whole = self.at + 1 == len(steps) or steps[self.at + 1].link != this.link
        says = words.step(this, self.at + 1, len(steps), whole)
        if whole:  # every factor of this link is in: MuJoCo has that pose, too
            says += words.verdict(self.page.arm.difference(this.link, this.after))
        self.product.content = says
        for joint, slider in self.sliders.items():
            slider.visible = joint == this.joint
            value = float(q[self.page.model.joint(joint).qposadr[0]])
            slider.value = value  # type: ignore[misc]
        done = steps[: self.at + 1]
        self.page.light(this.link, {step.link for step in done})
        self.page.host.scene.trace(np.array([step.after[:3, 3] for step in done]))
