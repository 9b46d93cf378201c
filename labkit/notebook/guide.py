"""A day's guide as blocks, with the places of its tasks and of the lab's steps.

A block is what stands between two blank lines; a fold, a fenced text and a printed
output of the lab are one block each.
"""

import posixpath
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from labkit.lesson.day import Day, Task

_HEADING = re.compile(r"(#+) (.+)")
_STEP = re.compile(r"<!-- run: python src/(\S+) --no-log \| step (\d+) -->")
# A fold that contains one output and nothing else: in a notebook, the run is its cell.
_FOLDED = re.compile(
    r"<details>\n<summary>.*</summary>\s+(<!-- run: (?:(?!<!-- end).)*<!-- end -->)"
    r"\s+</details>$",
    re.DOTALL,
)
_OUTPUT = re.compile(r"<!-- run: .*? -->\n?(.*?)\n?<!-- end -->", re.DOTALL)
_LINK = re.compile(r"(\]\(|<img src=\")(?!https?:|#|mailto:)([^)\"]+)")
# A command in a terminal, and what does the same in a cell.
_END = r"(?!\s+(?:ARGS|TASK|DAY)=)(?=[`\s.<]|$)"
_TYPED = (
    (re.compile(r"make\s+run(?:\s+DAY=\d+)?\s+ARGS=--reveal"), "run(reveal=True)"),
    (re.compile(r"make\s+run(?:\s+DAY=\d+)?\s+ARGS=--try"), "run(NAME=value)"),
    (re.compile(r"make\s+view(?:\s+DAY=\d+)?\s+ARGS=--screenshot"), "figure()"),
    (re.compile(rf"make (check|hint)(?: DAY=\d+)? TASK=([\d.]+\d){_END}"), r'\1("\2")'),
    (re.compile(rf"make (check|run)(?: DAY=\d+)?{_END}"), r"\1()"),
    (re.compile(rf"make figures(?: DAY=\d+)?{_END}"), "figure()"),
    (re.compile(rf"make start DAY=(\d+){_END}"), r"begin(\1)"),
)
_CALL = re.compile(r"\w+\(|#|\s*$")  # a line of Python, among those of a terminal
# A block that goes over blank lines: how it begins, and the line that ends it.
_LONG = (
    (re.compile(r"<details>"), re.compile(r"</details>")),
    (re.compile(r"<!-- run: "), re.compile(r"<!-- end -->")),
    (re.compile(r"```"), re.compile(r"```\s*$")),
    (re.compile(r"<picture>"), re.compile(r"</picture>")),
)


@dataclass(frozen=True)
class Block:
    """One block of a guide."""

    text: str  # Markdown
    section: str  # the heading above it, or its own; "" above the first one
    step: int = 0  # the step of the lab whose output it is; 0 if it is none
    heading: int = 0  # the level of a heading; 0 if it is none


def blocks_of(guide: str) -> list[Block]:
    """Return the blocks of a guide, in order."""
    found: list[Block] = []
    section = ""
    for text in _split(guide):
        text = folded[1] if (folded := _FOLDED.match(text)) else text
        heading = _HEADING.match(text)
        level = len(heading[1]) if heading else 0
        section = heading[2].strip() if heading and level > 1 else section
        step = _STEP.match(text)
        found.append(Block(text, section, int(step[2]) if step else 0, level))
    return found


def _split(guide: str) -> Iterator[str]:
    """Yield the texts of the blocks."""
    lines: list[str] = []
    end: re.Pattern[str] | None = None
    for line in [*guide.splitlines(), ""]:
        if end is None and not lines:
            end = next((e for begin, e in _LONG if begin.match(line)), None)
            closed = end is not None and begins_and_ends(line, end)
            end = None if closed else end
        elif end is not None and end.match(line):
            end = None
        if line.strip() or end is not None:
            lines.append(line)
        elif lines:
            yield "\n".join(lines)
            lines = []


def begins_and_ends(line: str, end: re.Pattern[str]) -> bool:
    """Return whether a line that begins a long block ends it as well."""
    return bool(end.search(line, 3)) and not line.startswith("```")


def place_of(task: Task, blocks: Sequence[Block]) -> int:
    """Return the index of the block that a task's cells follow.

    It is the paragraph that sets the task; where the guide only mentions it, the last
    text of the section to read before the lab runs.
    """
    set_here = (rf"\*\*Tasks? {re.escape(task.id)}\b", rf"TASK={re.escape(task.id)}\b")
    for pattern in set_here:
        for i, block in enumerate(blocks):
            if re.search(pattern, block.text) and not block.text.startswith("|"):
                return i  # a table of problems also names tasks
    title = task.read.removeprefix("Lab guide, ").partition(";")[0].strip()
    inside = [i for i, block in enumerate(blocks) if block.section == title]
    inside = inside or [len(blocks) - 1]
    before = [i for i in inside if not any(blocks[j].step for j in inside if j <= i)]
    told = [i for i in before if f"({task.id})" in blocks[i].text]
    return (told or before or inside)[-1]


def asks_all(block: Block) -> bool:
    """Return whether a block asks for all predictions of the day, before any step."""
    words = " ".join(block.text.split())
    return "first column of" in words and "*Predictions*" in words


def plain(block: Block) -> str:
    """Return a block without the marks of its outputs, which only the kit reads."""
    text = with_notebook_commands(_OUTPUT.sub(r"\1", block.text))
    return _cell_of(text) if text.startswith("```sh\n") else text


def _cell_of(fence: str) -> str:
    """Return a fenced text for a terminal as the text of a cell that does the same.

    A text with a program that waits in its own window stays one for a terminal.
    """
    if re.search(r"make view|^\.venv", fence, re.MULTILINE):
        return fence
    lines = fence.splitlines()[1:-1]
    typed_lines = [ln if _CALL.match(ln) else f"!{ln}" for ln in lines]
    language = "text" if any(ln[:1] == "!" for ln in typed_lines) else "python"
    return "\n".join([f"```{language}", *typed_lines, "```"])


def with_notebook_commands(text: str) -> str:
    """Return a text with the commands that one types in a notebook."""
    for shell, cell in _TYPED:
        text = shell.sub(cell, text)
    return text


def linked(text: str, base: str) -> str:
    """Return Markdown whose relative links begin at an address, or at a folder."""

    def lead(at: re.Match[str]) -> str:
        there = base + at[2]
        return at[1] + (there if "://" in base else posixpath.normpath(there))

    return _LINK.sub(lead, text)


def guide_of(day: Day) -> str:
    """Return the text of a day's guide."""
    return (day.folder / day.guide).read_text("utf-8")
