"""A picture to share: the capstone, a week's numbers and a name, 1200 x 630 pixels.

It stands beside the page, which names it for whoever shows a link as a card.
"""

import datetime
import unicodedata
from collections.abc import Mapping
from typing import Any

from PIL import Image, ImageDraw

from labkit.figures import client, clip, fonts
from labkit.figures.portrait import with_fingers
from labkit.figures.scene import Camera, Scene
from labkit.proof.capstone import Attempt
from labkit.proof.sharing import SIZE
from robo47 import panda
from robo47.attempt import Film
from robo47.errors import Robo47Error

ARM = (640, 630)  # pixels, at its right
FADES = 160  # pixels, of the arm's picture into the paper
LEFT, WIDTH = 60, 520  # pixels: the words' place
LEAST = 33  # pixels of the smallest letters: 11 where a feed shows the card 400 wide
PAPER, INK, FAINT, GOOD = (27, 31, 36), (240, 243, 246), (152, 163, 174), (76, 194, 106)
AT_READY = Camera((0.2, 0.0, 0.42), 2.4)
INTO = 0.25  # s into a film's moment, where something has begun to move


def draw(facts: Mapping[str, Any], tried: Attempt) -> Image.Image:
    """Return the card of a page.

    Args:
        facts: what the door says of it, `labkit.proof.page.in_short`.
        tried: what came of the capstone.
    """
    counted = {
        "functions": "student functions, correct",
        "numbers": "numbers, computed again",
    }
    rows = [(facts[key], words, _whole(facts[key])) for key, words in counted.items()]
    film = None
    if tried.capstone is not None and tried.result is not None:
        film = tried.capstone.film(tried.result)
        told = tried.capstone.summary(tried.result)
        alone = tried.counted.all
        whose = "" if alone else f", with {tried.counted} functions of the student"
        rows.append((told.number, told.of + whose, alone and not tried.result.failed))
    sheet = Image.new("RGB", SIZE, PAPER)
    if (picture := _arm(film)) is not None:
        seen = Image.new("L", ARM, 255)
        seen.paste(Image.linear_gradient("L").rotate(90).resize((FADES, ARM[1])))
        sheet.paste(picture, (SIZE[0] - ARM[0], 0), seen)
    pen = ImageDraw.Draw(sheet)
    _write(pen, 34, f"robo47, run on {datetime.date.today()}", LEAST, FAINT, 1)
    name = _printable(facts["name"])
    _write(pen, 78, name or facts["heading"], 58, INK, 1)
    _write(pen, 148, facts["heading"] if name else "", 36, FAINT, 1)
    for i, (number, words, good) in enumerate(rows):
        _write(pen, 214 + 106 * i, number, 54, GOOD if good else INK, 1)
        _write(pen, 274 + 106 * i, words, LEAST, FAINT, 3)
    return sheet


def _arm(film: Film | None) -> Image.Image | None:
    """Return the arm in the middle of its film, or at ready; None if nothing draws."""
    scene = Scene(with_fingers(panda.READY_Q), ARM, AT_READY)
    if film is not None:
        begins = dict(film.phases)
        moment = begins[film.moments[len(film.moments) // 2]]
        row = min(int(film.t.searchsorted(moment + INTO)), len(film.t) - 1)
        scene = clip.scene_of(film, row, ARM)
    try:
        return Image.fromarray(client.draw(scene))
    except Robo47Error:
        return None


def _whole(counted: str) -> bool:
    """Return whether it is "9 of 9"."""
    some, _, all_ = counted.partition(" of ")
    return some == all_


def _printable(name: str) -> str:
    """Return a name in letters that the font has; "" if it lacks one of them."""
    font = fonts.font(20)
    missing = bytes(font.getmask("\uffff"))

    def lacks(words: str) -> bool:
        return any(bytes(font.getmask(letter)) == missing for letter in words)

    if lacks(name):  # perhaps but for its accents
        parts = unicodedata.normalize("NFKD", name)
        name = "".join(c for c in parts if not unicodedata.combining(c))
    return "" if lacks(name) else name


def _write(
    pen: ImageDraw.ImageDraw, y: float, words: str, size: float, colour: Any, most: int
) -> None:
    """Write words on base lines, smaller where they would be too wide.

    Args:
        pen: of the card.
        y: of the top, pixels.
        words: what to write.
        size: of the letters, pixels; at least LEAST are drawn.
        colour: of the letters.
        most: lines; what does not fit is left out, and "…" says so.
    """
    wide = max(fonts.font(size).getlength(words), 1.0)
    size = max(LEAST, size * min(1.0, most * WIDTH / wide))
    font = fonts.font(size)
    for i, line in enumerate(_lines(words, font, most)):
        pen.text((LEFT, y + (1 + 1.18 * i) * size), line, colour, font, "ls")


def _lines(words: str, font: Any, most: int) -> list[str]:
    """Return words as lines that are no wider than WIDTH, at most so many."""
    lines: list[str] = []
    for word in words.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if not lines or (len(lines) < most and font.getlength(longer) > WIDTH):
            lines.append(word)
        else:
            lines[-1] = longer
    for i, line in enumerate(lines):
        while font.getlength(lines[i]) > WIDTH:
            line = line[:-1]
            lines[i] = f"{line}…"
    return lines
