"""Several pictures on one sheet, each under its title."""

from PIL import Image, ImageDraw, ImageFont

Colour = tuple[int, int, int]  # red, green, blue, of 255
INK, FAINT, RULE = (33, 37, 41), (90, 97, 104), (206, 212, 218)
HEAD, TITLE, SMALL = 130, 44, 30  # pixels: the space above, and two sizes of text


def with_line(
    picture: Image.Image,
    words: str,
    colour: Colour = FAINT,
    font: int = 22,
    band: int = 44,
    anchor: str = "rm",
) -> Image.Image:
    """Return a picture with a line of text in a band below it: "rm" right, "mm" middle.

    The text's size and the band's height are pixels.
    """
    width, height = picture.size
    sheet = Image.new("RGB", (width, height + band), "white")
    sheet.paste(picture, (0, 0))
    place = (width - 16 if anchor == "rm" else width / 2, height + band / 2)
    style = ImageFont.load_default(font)
    ImageDraw.Draw(sheet).text(place, words, colour, style, anchor)
    return sheet


def side_by_side(*panels: tuple[Image.Image, str, str]) -> Image.Image:
    """Return pictures of one size in a row, each with its title and a line below."""
    width, height = panels[0][0].size
    sheet = Image.new("RGB", (width * len(panels), height + HEAD), "white")
    pen = ImageDraw.Draw(sheet)
    for i, (picture, title, explanation) in enumerate(panels):
        sheet.paste(picture, (i * width, HEAD))
        middle = (i + 0.5) * width
        pen.text((middle, 48), title, INK, ImageFont.load_default(TITLE), "mm")
        pen.text((middle, 100), explanation, FAINT, ImageFont.load_default(SMALL), "mm")
        if i:
            pen.line([(i * width, 30), (i * width, sheet.height - 30)], RULE, 2)
    return sheet
