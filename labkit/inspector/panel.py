"""The part of the panel that every tab has: who agrees, the matrices, the tabs."""

from collections.abc import Mapping

import viser

from labkit.inspector import words
from labkit.inspector.arm import Arm
from labkit.inspector.checks import Standing
from labkit.inspector.ghost import Difference, Seen
from labkit.inspector.guard import TITLE

LAST = 1e15  # below whatever a tab adds


class Panel:
    """What stands above the open tab."""

    def __init__(self, gui: viser.GuiApi, arm: Arm, about: str) -> None:
        """Put the panel at the top of the page; what `about` says stands below all."""
        self.gui, self.arm = gui, arm
        self.no_file = ""
        gui.set_panel_label(TITLE)
        self.state = gui.add_html("")
        self.yours, self.tasks = gui.add_html(""), gui.add_html("")
        self.tabs = gui.add_html("")
        self.frame = gui.add_dropdown("Frame", tuple(arm.names))
        self.proof, self.limits = gui.add_html(""), gui.add_html("")
        self.legend = gui.add_html("", order=LAST)
        self.solid = gui.add_checkbox("solid arm", False, order=LAST + 1e9)
        said = words.line(about, "about", "quiet") if about else ""
        gui.add_html(said, order=LAST + 2e9)
        self.fixed = set(self._children())

    def _children(self) -> dict[str, viser.GuiHtmlHandle]:
        """Return what stands in the panel, whoever put it there."""
        return self.gui._container_handle_from_uuid["root"]._children  # type: ignore[return-value]

    def open(self, titles: list[str], chosen: str, wide: bool) -> None:
        """Remove what a tab put here; open another one, a wide one without proof."""
        for uuid, child in list(self._children().items()):
            if uuid not in self.fixed:
                child.remove()
        self.frame.visible, self.solid.visible = not wide, True
        self.tabs.content = words.tab_row(titles, chosen)

    def explain(self, colours: Mapping[str, tuple[int, int, int]]) -> None:
        """Say what the colours in the scene mean: {what is drawn: its colour}."""
        self.legend.content = words.legend(colours)

    def first(self) -> str:
        """Return what to show before viser does, as HTML."""
        some = (self.yours, self.tasks, self.proof, self.limits)
        return "".join(part.content for part in some)

    def show(
        self, seen: Seen | None, apart: Difference | None, standing: Standing
    ) -> None:
        """Show what the student's function said last, and how the tasks stand."""
        if apart is not None:
            text, kind = apart.sentence, apart.kind
        elif seen is None:
            text, kind = self.no_file, "quiet"
        else:  # a day without a ghost: only what keeps the file from being asked
            text, kind = seen.problem, "bad"
        self.yours.content = words.judged(text, "yours", kind)
        head = standing.headline
        self.tasks.content = words.line(head, "standing", standing.kind) if head else ""
        frame, wide = self.frame.value, not self.frame.visible
        view = None if seen is None or frame not in seen.poses else seen
        self.proof.content = "" if wide else words.proof(self.arm, frame, view)
        self.limits.content = words.limits(self.arm)
