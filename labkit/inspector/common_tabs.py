"""The tabs that every day has: Joints, Chain and Tasks."""

import math
import secrets
from types import SimpleNamespace
from typing import Any

import mujoco
import numpy as np
import viser

from labkit.inspector import typed, words
from labkit.inspector.arm import Step
from labkit.inspector.declared import Declared, buttons, panel
from labkit.inspector.page import Page
from labkit.inspector.standing import Standing
from labkit.inspector.tab import Tab
from robo47.checks import Array

RANDOM, UNDO = "random", "undo"
BACK, NEXT, PLAY = "back", "next", "play / stop"
SECONDS_PER_STEP = 0.9
MARKS = {"passed": ("✓", "good"), "todo": ("·", "quiet"), "close": ("~", "bad")}
# "home" is two things in this course; the text under the buttons says which is which.
ABOUT = (
    "ready is READY_Q of the labs, home the model's own key. In q you can type pi/2 "
    "or 90 deg, and paste an array. Click a link to see its axis."
)


def joint_slider(page: Page, i: int, unit: str) -> viser.GuiSliderHandle[float]:
    """Add a slider that moves the i-th joint."""

    def move(value: float) -> None:
        q = page.q
        q[i] = value
        page.move(q)

    low, high = page.model.jnt_range[i]
    return page.slider(page.arm.joints[i], low, high, page.q[i], move, unit=unit)


class Joints(Tab):
    """Sliders and buttons that move the arm."""

    title = "Joints"

    def __init__(self, page: Page) -> None:
        super().__init__(page)
        self.buttons = page.buttons([*page.arm.named_q, RANDOM, UNDO], self.go_to)
        slides = page.model.jnt_type == mujoco.mjtJoint.mjJNT_SLIDE
        self.units = ["m" if slide else "" for slide in slides]
        self.sliders = [joint_slider(page, i, u) for i, u in enumerate(self.units)]
        self.box = page.gui.add_text("q", "")
        page.host.listen(self.box, self.type)
        self.exact = page.html()

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
            text = ", ".join(f"{x:z.10g}" for x in q)
            self.box.value = text  # type: ignore[misc]
            self.page.say("")
        degrees = ", ".join(
            f"{x:z.4g} m" if unit else f"{math.degrees(x):z.4g}°"
            for unit, x in zip(self.units, q, strict=True)
        )
        self.exact.content = (
            words.line(degrees, "degrees", "quiet")
            + '<div class="r47-row">'
            + words.copy_button("copy q as NumPy", q)
            + words.copy_button("copy T_world_ee", self.page.pose("ee"))
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


class Chain(Declared):
    """The chain's product, one factor at a time, one more frame lit."""

    title = "Chain"
    hz = 1 / SECONDS_PER_STEP
    does = buttons(BACK, NEXT, PLAY, then="press")
    product = panel.html()

    def prepare(self) -> None:
        """Begin at the first joint, with a slider for each."""
        steps = self.page.arm.steps()
        self.step = next(i for i, step in enumerate(steps) if step.joint)
        joints = self.page.arm.joints
        places = [joints.index(step.joint) for step in steps if step.joint]
        self.sliders = {i: joint_slider(self.page, i, "rad") for i in places}

    def begin(self) -> None:
        """Nothing plays by itself."""

    def press(self) -> None:
        """Go one factor back or on, or play them all."""
        if self.does == PLAY:
            self.loop.toggle()
        else:
            self.loop.stop()
            self.go(self.step + (1 if self.does == NEXT else -1))

    def frame(self, seconds: float) -> bool:
        """Show the next factor; return whether there is one more."""
        self.go(round(seconds / SECONDS_PER_STEP))
        return self.step < len(self.page.arm.steps()) - 1

    def go(self, step: int) -> None:
        """Show a factor by its place in the product."""
        self.step = min(max(step, 0), len(self.page.arm.steps()) - 1)
        self.request()

    def ask(self, fns: Any, at: SimpleNamespace) -> list[Step]:
        """Return the factors in the arm's configuration."""
        return self.page.arm.steps()

    def show(self, yours: list[Step], right: list[Step]) -> None:
        """Show the factor, and draw the way to it."""
        this = yours[self.step]
        done = yours[: self.step + 1]
        whole = len(done) == len(yours) or yours[self.step + 1].link != this.link
        says = says_of(this, self.step + 1, len(yours), whole)
        if whole:  # every factor of this link is in: MuJoCo has that pose, too
            apart = self.page.arm.difference(this.link, this.after)
            theirs = bool(self.functions) and self.kind_of(" ".join(self.functions))
            says += words.verdict(apart, "yours" if theirs else "the library")
        self.product.content = says
        for i, slider in self.sliders.items():
            slider.visible = self.page.arm.joints[i] == this.joint
            slider.value = float(self.page.arm.q[i])  # type: ignore[misc]
        self.page.light(this.link, {step.link for step in done})
        self.page.host.scene.trace([step.after[:3, 3] for step in done])

    def lost(self) -> None:
        """Show no factors, and no way through them."""
        super().lost()
        self.page.host.scene.trace(())


def says_of(this: Step, number: int, of: int, whole: bool) -> str:
    """Return a factor of the chain with its matrices; the whole link's is its last."""
    if this.joint:
        about = f"{this.joint} at q = {this.q:.4f} rad; marked is what q moves"
    else:
        about = f"pos and quat of {this.link} in the file, the same for every q"
    product = f"T_world_{this.link}" + ("" if whole else " with its joint still at 0")
    marked, mark = this.moves, "moves"
    if this.off is not None and this.off.any():
        about, marked, mark = (
            "marked is what the library's has otherwise",
            this.off,
            "off",
        )
    return (
        words.line(f"factor {number} of {of}, {this.name}: {about}", "step")
        + words.matrix("so far", this.before, "before")
        + words.matrix(f"@ {this.name}", this.factor, "factor", marked, mark)
        + words.matrix(f"= {product}", this.after, "product")
    )


class Tasks(Tab):
    """Pass, or the named mistake, for each task of the day, as `make check` says it."""

    title = "Tasks"

    def __init__(self, page: Page) -> None:
        super().__init__(page)
        self.list = page.html()
        self.judged(page.host.standing)

    def judged(self, standing: Standing) -> None:
        """Show the verdicts; the line about all of them stands on top of the panel."""
        self.list.content = listed(standing)


def listed(standing: Standing) -> str:
    """Return a line per task with its verdict, as HTML."""
    parts = []
    for result in standing.tasks:
        task, verdict = result.task, result.verdict
        mark, kind = MARKS.get(verdict.status, ("✗", "bad"))
        text = f"{mark} {task.id} {task.title}"
        parts.append(words.line(text, f"task-{task.id}", kind))
        if verdict.message:
            parts.append(words.line(verdict.message, f"why-{task.id}", "quiet"))
    return "".join(parts)
