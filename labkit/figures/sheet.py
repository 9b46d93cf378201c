"""Several pictures on one sheet, each under its title."""

from typing import Any

from PIL import Image, ImageDraw, ImageFont

Colour = tuple[int, int, int]  # red, green, blue, of 255
PAPER, INK = (27, 31, 36), (240, 243, 246)
FAINT, RULE = (152, 163, 174), (61, 68, 77)
ON_WHITE = (90, 97, 104)  # a line below a chart
HEAD, TITLE, SMALL = 130, 44, 30  # pixels: the space above, and two sizes of text


def with_line(
    picture: Image.Image,
    words: str,
    colour: Colour | None = None,
    font: int = 22,
    band: int = 44,
    anchor: str = "rm",
) -> Image.Image:
    """Return a picture with a line of text in a band below it: "rm" right, "mm" middle.

    The text's size and the band's height are pixels. The band goes on with the
    picture's ground: a chart's is white, an arm's dark.
    """
    width, height = picture.size
    ground: Any = picture.convert("RGB").getpixel((0, 0))
    sheet = Image.new("RGB", (width, height + band), ground)
    sheet.paste(picture, (0, 0))
    place = (width - 16 if anchor == "rm" else width / 2, height + band / 2)
    style = ImageFont.load_default(font)
    colour = colour or (ON_WHITE if sum(ground) > 3 * 128 else FAINT)
    ImageDraw.Draw(sheet).text(place, words, colour, style, anchor)
    return sheet


def side_by_side(*panels: tuple[Image.Image, str, str]) -> Image.Image:
    """Return pictures of one size in a row, each with its title and a line below."""
    width, height = panels[0][0].size
    sheet = Image.new("RGB", (width * len(panels), height + HEAD), PAPER)
    pen = ImageDraw.Draw(sheet)
    for i, (picture, title, explanation) in enumerate(panels):
        sheet.paste(picture, (i * width, HEAD))
        middle = (i + 0.5) * width
        pen.text((middle, 48), title, INK, ImageFont.load_default(TITLE), "mm")
        pen.text((middle, 100), explanation, FAINT, ImageFont.load_default(SMALL), "mm")
        if i:
            pen.line([(i * width, 30), (i * width, sheet.height - 30)], RULE, 2)
    return sheet
