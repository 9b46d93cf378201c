"""The tab with the verdict on every task, in the words of `make check`."""

from labkit.inspector import words
from labkit.inspector.checks import Standing
from labkit.inspector.page import Page
from labkit.inspector.tab import Tab

MARKS = {"passed": ("✓", "good"), "todo": ("·", "quiet"), "close": ("~", "bad")}


class Tasks(Tab):
    """Pass, or the named mistake, for each task of the day."""

    title = "Tasks"

    def __init__(self, page: Page) -> None:
        """Show what is known so far."""
        super().__init__(page)
        self.list = page.html()
        self.show(page.host.standing)

    def show(self, standing: Standing) -> None:
        """Show the verdicts.

        Args:
            standing: of every task.
        """
        parts = []  # the line about all of them stands on top of the panel
        for result in standing.tasks:
            task, verdict = result.task, result.verdict
            mark, kind = MARKS.get(verdict.status, ("✗", "bad"))
            text = f"{mark} {task.id} {task.title}"
            parts.append(words.line(text, f"task-{task.id}", kind))
            if verdict.message:
                parts.append(words.line(verdict.message, f"why-{task.id}", "quiet"))
        self.list.content = "".join(parts)
