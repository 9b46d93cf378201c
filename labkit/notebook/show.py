"""The answers of a notebook's cell, as text and as HTML.

Every answer follows Jupyter's protocol, so it is readable in JupyterLab, Colab and VS
Code, in a dark theme (no colour of text or ground is set) and in a plain terminal.
"""

import html
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labkit.check.report import Report, as_text, state_of
from labkit.check.tasks import TaskResult
from labkit.notebook.guide import with_notebook_commands
from robo47.checks import Array

_MARK = {"passed": "✓", "to do": "·"}  # every other state has ✗
_CELL = "style='text-align:left;vertical-align:top;padding:.2em .8em'"


class Message:
    """Sentences and, optionally, more HTML."""

    def __init__(self, lines: Sequence[str], more: str = "") -> None:
        """Keep what to say.

        Args:
            lines: paragraphs.
            more: HTML below them.
        """
        self.lines = list(lines)
        self.more = more

    def __repr__(self) -> str:
        """Return the paragraphs."""
        return with_notebook_commands("\n".join(self.lines))

    def _repr_html_(self) -> str:
        style = "style='white-space:pre-line'"  # a line of text stays one
        said = (html.escape(line) for line in self.lines if line.strip())
        paragraphs = "".join(f"<p {style}>{line}</p>" for line in said)
        return f"<div>{with_notebook_commands(paragraphs)}{self.more}</div>"


class CheckResult:
    """The verdict of a check."""

    def __init__(
        self, report: Report, told: Sequence[str], hint: Callable[[str], Any]
    ) -> None:
        """Keep what to show.

        Args:
            report: of one check.
            told: sentences that come before it.
            hint: returns the next hint for a task.
        """
        self.report = report
        self.told = list(told)
        self.hint = hint

    def __repr__(self) -> str:
        """Return the report as `make check` prints it."""
        return with_notebook_commands("\n".join([*self.told, as_text(self.report)]))

    def _repr_html_(self) -> str:
        """Return a row per task: its state, and what is wrong with it."""
        report = self.report
        said = [*self.told, *([report.problem] if report.problem else [])]
        rows = [_row(*state_of(report, one), _matrices(one)) for one in report.tasks]
        if not report.left:
            rows += [_row(i.name, i.status, [i.message]) for i in report.items]
        table = f"<table>{''.join(rows)}</table>"
        last = f"{report.done} of {report.total} done. Next: {report.next_step()}"
        return with_notebook_commands(
            Message(said)._repr_html_() + table + Message([last])._repr_html_()
        )

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        """Return both forms."""
        return {"text/plain": repr(self), "text/html": self._repr_html_()}

    def _ipython_display_(self) -> None:
        """Show both forms, with a button for a hint where the notebook has buttons."""
        from IPython.display import display

        display(self._repr_mimebundle_(), raw=True)
        left = [one.task.id for one in self.report.left if not self.report.problem]
        with suppress(ImportError):
            if left:
                display(_button(left[0], self.hint))


def _button(task: str, hint: Callable[[str], Any]) -> Any:
    """Return a button that shows the next hint for a task below it."""
    import ipywidgets
    from IPython.display import display

    button = ipywidgets.Button(description=f"Hint for {task}")
    below = ipywidgets.Output()

    def pressed(_: Any) -> None:
        with below:
            display(hint(task))

    button.on_click(pressed)
    return ipywidgets.VBox([button, below])


def _matrices(result: TaskResult) -> str:
    """Return the matrix of the failing call, its wrong entries marked, as HTML."""
    compared = result.verdict.compared
    if compared is None:
        return ""
    right = np.zeros_like(compared.wrong)
    mine = _matrix("returned", compared.returned, compared.wrong)
    return f"<div>{mine}{_matrix('expected', compared.expected, right)}</div>"


def _matrix(name: str, values: Array, marked: NDArray[np.bool_]) -> str:
    """Return a matrix as a table with its name above it, and some entries framed."""
    rows = ""
    for row, off in zip(values, marked, strict=True):
        style = ("", "outline:2px solid crimson;font-weight:bold;")
        cells = (
            f"<td style='{style[int(w)]}text-align:right'>{x + 0.0:.4g}</td>"
            for x, w in zip(row, off, strict=True)
        )
        rows += f"<tr>{''.join(cells)}</tr>"
    return (
        "<table style='display:inline-table;margin:.4em 1.5em .4em 0'>"
        f"<caption style='text-align:left'>{name}</caption>{rows}</table>"
    )


def _row(name: str, state: str, lines: Sequence[str], more: str = "") -> str:
    """Return a row of the table of tasks; `more` is HTML below its lines."""
    mark = _MARK.get(state, "✗")
    paragraphs = "".join(f"<div>{html.escape(line)}</div>" for line in lines if line)
    return (
        f"<tr><td {_CELL}>{mark}</td><td {_CELL}><b>{html.escape(name)}</b></td>"
        f"<td {_CELL}>{html.escape(state)}</td>"
        f"<td {_CELL}>{paragraphs}{more}</td></tr>"
    )
