"""A picture to share: the capstone, a week's numbers and a name, 1200 x 630 pixels.

It stands beside the page, which names it for whoever shows a link as a card.
"""

import datetime
import unicodedata
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from PIL import Image, ImageDraw, ImageFont

from labkit.figures import client, clip
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
        "functions": "functions, right and their own",
        "numbers": "numbers, run again",
    }
    rows = [(facts[key], words, _whole(facts[key])) for key, words in counted.items()]
    film = None
    if tried.capstone is not None and tried.result is not None:
        film = tried.capstone.film(tried.result)
        told = tried.capstone.told(tried.result)
        words = f"{tried.capstone.NAME}: {told.of}"
        alone = tried.yours == tried.total
        whose = "" if alone else f", by {tried.yours} of its {tried.total} functions"
        rows.append((told.number, words + whose, alone and not tried.result.failed))
    sheet = Image.new("RGB", SIZE, PAPER)
    if (picture := _arm(film)) is not None:
        seen = Image.new("L", ARM, 255)
        seen.paste(Image.linear_gradient("L").rotate(90).resize((FADES, ARM[1])))
        sheet.paste(picture, (SIZE[0] - ARM[0], 0), seen)
    pen = ImageDraw.Draw(sheet)
    _write(pen, 46, "robo47", 30, FAINT)
    _write(pen, 92, _known(facts["name"]), 58, INK)
    _write(pen, 168, facts["heading"], 32, FAINT)
    for i, (number, words, good) in enumerate(rows):
        _write(pen, 240 + 104 * i, number, 54, GOOD if good else INK)
        _write(pen, 304 + 104 * i, words, 26, FAINT)
    about = f"derived by hand, held against MuJoCo, run on {datetime.date.today()}"
    _write(pen, 578, about, 22, FAINT)
    return sheet


def _arm(film: Film | None) -> Image.Image | None:
    """Return the arm in the middle of its film, or at ready; None if nothing draws."""
    scene = Scene(with_fingers(panda.READY_Q), ARM, AT_READY, dark=True)
    if film is not None:
        begins = dict(film.phases)
        moment = begins[film.moments[len(film.moments) // 2]]
        row = min(int(film.t.searchsorted(moment + INTO)), len(film.t) - 1)
        scene = clip.scene_of(film, row, ARM, dark=True)
    try:
        return Image.fromarray(client.draw(scene))
    except Robo47Error:
        return None


def _whole(counted: str) -> bool:
    """Return whether it is "9 of 9"."""
    some, _, all_ = counted.partition(" of ")
    return some == all_


def _known(name: str) -> str:
    """Return a name in letters that the font has; "" if it lacks one of them."""
    font = _font(20)
    missing = bytes(font.getmask("\uffff"))

    def lacks(words: str) -> bool:
        return any(bytes(font.getmask(letter)) == missing for letter in words)

    if lacks(name):  # perhaps but for its accents
        parts = unicodedata.normalize("NFKD", name)
        name = "".join(c for c in parts if not unicodedata.combining(c))
    return "" if lacks(name) else name


def _write(
    pen: ImageDraw.ImageDraw, y: float, words: str, size: float, colour: Any
) -> None:
    """Write a line on its base line, smaller where it would be too wide."""
    wide = _font(size).getlength(words)
    font = _font(size * min(1.0, WIDTH / max(wide, 1.0)))
    pen.text((LEFT, y + size), words, colour, font, "ls")


def _font(size: float) -> Any:
    """Return matplotlib's font, which has most letters, or Pillow's, which has few."""
    if (found := find_spec("matplotlib")) and found.origin:
        fonts = Path(found.origin).parent / "mpl-data" / "fonts" / "ttf"
        if (file := fonts / "DejaVuSans.ttf").is_file():
            return ImageFont.truetype(file, size)
    return ImageFont.load_default(size)
