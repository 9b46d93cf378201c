"""Frames of a clip in which a line is typed, an arm answers, and the checker speaks.

    page = Page(("def f(q):", "    return -q"), picture, "make check TASK=1.2")
    draw(page, WIDE)    # a PIL image: code and words on the left, the arm on the right

Dark, like an editor: a picture that looks right on a light page and on a dark one.
"""

import textwrap
from dataclasses import dataclass
from typing import NamedTuple

from PIL import Image, ImageDraw

from labkit.figures import fonts
from labkit.figures.sheet import Colour

SHARP = 2  # pixels of the picture for one of the page
ARM = (452, 360)  # pixels of the page
COLUMNS = 38  # letters of a line
FONT, LINE, EDGE = 18, 25, 18  # pixels: letters, from line to line, and the margin
PAPER, PANEL = (27, 31, 36), (36, 41, 47)
INK, FAINT, CURSOR = (230, 234, 238), (152, 163, 174), (120, 170, 245)
GOOD, BAD, MARK = (76, 194, 106), (255, 123, 114), (122, 72, 0)
WORD = {"passed": GOOD, "WRONG": BAD}


class Layout(NamedTuple):
    """Where the parts stand, in pixels of the page."""

    size: tuple[int, int]
    code: tuple[int, int, int, int]  # left, top, right, bottom
    arm: tuple[int, int]
    says: tuple[int, int]


WIDE = Layout((900, 360), (0, 0, 448, 86), (448, 0), (EDGE, 106))
TALL = Layout((452, 700), (0, 0, 452, 86), (0, 86), (EDGE, 460))


@dataclass(frozen=True)
class Page:
    """What is to be seen at one moment."""

    code: tuple[str, ...]  # lines
    arm: Image.Image  # SHARP times ARM
    command: str  # what was typed to hear the checker
    says: tuple[str, ...] = ()  # its lines: the verdict, then a sentence
    mark: str = ""  # letters of the last line of code that stand out
    cursor: int | None = None  # in front of which letter of that line


def draw(page: Page, layout: Layout) -> Image.Image:
    """Return the picture of a moment.

    Raises:
        ValueError: the checker says more than there is room for.
    """
    width, height = (SHARP * n for n in layout.size)
    sheet = Image.new("RGB", (width, height), PAPER)
    pen = ImageDraw.Draw(sheet)
    pen.rectangle([SHARP * n for n in layout.code], PANEL)
    sheet.paste(page.arm, (SHARP * layout.arm[0], SHARP * layout.arm[1]))
    _code(pen, page, layout.code)
    x, y = layout.says
    _write(pen, x, y, f"$ {page.command}", FAINT)
    lines = _lines(page.says)
    if y + (len(lines) + 1) * LINE > layout.size[1]:
        raise ValueError(f"{len(lines)} lines of the checker's are cut")
    for i, (words, colour) in enumerate(lines):
        _write(pen, x, y + (i + 1) * LINE, words, colour)
    return sheet


def _code(pen: ImageDraw.ImageDraw, page: Page, box: tuple[int, ...]) -> None:
    """Write the code, what stands out of its last line, and the cursor."""
    x, top = box[0] + EDGE, box[1] + EDGE
    y = top + LINE * (len(page.code) - 1)
    step = fonts.font(SHARP * FONT, "Mono").getlength("x") / SHARP
    last = page.code[-1]
    if page.mark:
        start = x + step * last.index(page.mark)
        end = start + step * len(page.mark)
        corners = [start - 1, y - 2, end + 1, y + LINE - 3]
        pen.rectangle([SHARP * n for n in corners], MARK)
    for i, line in enumerate(page.code):
        _write(pen, x, top + i * LINE, line, INK)
    if page.cursor is not None:
        at = x + step * page.cursor
        corners = [at - 1, y - 2, at + 1, y + LINE - 3]
        pen.rectangle([SHARP * n for n in corners], CURSOR)


def _lines(says: tuple[str, ...]) -> list[tuple[str, Colour]]:
    """Return lines with their colours: the verdict's own, and the sentence's."""
    if not says:
        return []
    verdict, *sentence = says
    *rest, last = verdict.split()
    lines = [(f"{' '.join(rest)}  {last}", WORD.get(last, INK))]
    words = " ".join(sentence).replace(" / ", "\u00a0/\u00a0")  # no line ends there
    wrapped = textwrap.wrap(words, COLUMNS)
    return lines + [(line, INK) for line in wrapped]


def _write(
    pen: ImageDraw.ImageDraw, x: float, y: float, words: str, colour: Colour
) -> None:
    pen.text((SHARP * x, SHARP * y), words, colour, fonts.font(SHARP * FONT, "Mono"))
