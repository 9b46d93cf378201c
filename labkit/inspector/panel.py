"""The part of the panel that every tab has: who agrees, the matrices, the tabs."""

import viser

from labkit.inspector import controls, words
from labkit.inspector.arm import Arm
from labkit.inspector.checks import Standing
from labkit.inspector.controls import Controls
from labkit.inspector.ghost import Difference, Seen

TITLE = "robo47 inspector"
LAST = 1e15  # below whatever a tab adds


class Panel:
    """What stands above the open tab."""

    def __init__(self, gui: viser.GuiApi, arm: Arm, about: str, made: Controls) -> None:
        """Put the panel at the top of the page.

        Args:
            gui: the page's sidebar.
            arm: what the numbers are of.
            about: which robot this is.
            made: the page's controls.
        """
        self.gui, self.arm, self.controls = gui, arm, made
        self.no_file = ""
        gui.set_panel_label(TITLE)
        self.state = gui.add_html("")
        self.yours, self.tasks = gui.add_html(""), gui.add_html("")
        gui.add_html(
            '<div class="r47-row">'
            + controls.choice("frame", "Frame", arm.names)
            + controls.tick("solid", "solid arm")
            + "</div>"
        )
        self.proof, self.limits = gui.add_html(""), gui.add_html("")
        self.tabs = gui.add_html("")
        last = words.line(f"{about}; ee is {arm.chain.frame}", "about", "quiet")
        gui.add_html(last, order=LAST)
        self.fixed = set(self._children())

    def _children(self) -> dict[str, viser.GuiHtmlHandle]:
        """Return what stands in the panel, whoever put it there."""
        return self.gui._container_handle_from_uuid["root"]._children  # type: ignore[return-value]

    def open(self, titles: list[str], chosen: str) -> None:
        """Remove what a tab put into the panel, and mark another tab as open.

        Args:
            titles: of all the tabs.
            chosen: the one that is about to be built.
        """
        for uuid, child in list(self._children().items()):
            if uuid not in self.fixed:
                child.remove()
        self.tabs.content = controls.tab_row(titles, chosen)

    def show(
        self,
        frame: str,
        seen: Seen | None,
        apart: Difference | None,
        standing: Standing,
        wide: bool,
    ) -> None:
        """Show the present numbers.

        Args:
            frame: short name of the one to show.
            seen: what the student's function said last, or None.
            apart: how that differs from MuJoCo.
            standing: how the tasks stand.
            wide: leave the two matrices out; the tab needs the room.
        """
        if apart is not None:
            kind = "good" if apart.good else "bad"
            text = f"{'✓' if apart.good else '✗'} {apart.sentence}"
        elif seen is None:
            kind, text = "quiet", self.no_file
        else:  # a day without a ghost: only what keeps the file from being asked
            kind, text = "bad", f"✗ {seen.problem}" if seen.problem else ""
        self.yours.content = words.said(text, "yours", kind) if text else ""
        head = standing.headline
        self.tasks.content = words.line(head, "standing", standing.kind) if head else ""
        view = None if seen is None or frame not in seen.poses else seen
        self.proof.content = "" if wide else words.proof(self.arm, frame, view)
        self.limits.content = words.limits(self.arm)
