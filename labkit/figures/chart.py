"""The one style of every drawn picture: colours, units, a font that a phone can show.

    @chart.picture(height=6.0)
    def push(figure):
        axes = figure.subplots()
        axes.plot(force, moved, color=chart.BLUE)

    push()    # a PIL image, 1200 pixels wide

The colours are those of Okabe and Ito, which colour-blind readers tell apart; draw no
two lines that differ by colour alone. 390 pixels of a phone show FONT 10 pixels high.
On a dark page the site turns white into black and keeps hues (site/style.css), so a map
of colours has one hue.
"""

import io
from collections.abc import Callable
from functools import wraps
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure  # not pyplot, which may look for a display
from PIL import Image

BLUE = "#0072B2"
ORANGE = "#E69F00"
GREEN = "#009E73"
RED = "#D55E00"
PURPLE, SKY = "#CC79A7", "#56B4E9"
INK, GREY, RULE = "#212529", "#868e96", "#dee2e6"
WIDTH = 8.0  # inches
DPI = 150  # a picture is 1200 pixels wide
FONT, SMALL = 16.0, 13.5  # points: of nearly all text, and the smallest
STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": FONT,
    "axes.titlesize": FONT,
    "legend.fontsize": SMALL,
    "xtick.labelsize": SMALL,
    "ytick.labelsize": SMALL,
    "axes.labelcolor": INK,
    "text.color": INK,
    "axes.edgecolor": INK,
    "axes.linewidth": 1.2,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "grid.color": RULE,
    "lines.linewidth": 2.5,
    "lines.markersize": 8.0,
    "legend.frameon": False,
    "figure.constrained_layout.use": True,
    "figure.constrained_layout.h_pad": 0.1,  # a title is the lower axes', not a label's
}

Draw = Callable[..., None]  # it takes a Figure and the picture's data


def image_of(figure: Figure) -> Image.Image:
    """Return a figure as an image."""
    file = io.BytesIO()
    figure.savefig(file, format="png")
    return Image.open(file).convert("RGB")


def picture(
    height: float, width: float = WIDTH
) -> Callable[[Draw], Callable[..., Image.Image]]:
    """Return a decorator: what draws on a figure becomes what returns an image.

    Args:
        height: inches.
        width: inches; twice WIDTH is for a screen only.
    """

    def decorate(draw: Draw) -> Callable[..., Image.Image]:
        @wraps(draw)
        def drawn(*args: Any, **more: Any) -> Image.Image:
            with matplotlib.rc_context(STYLE):
                figure = Figure(figsize=(width, height), dpi=DPI)
                draw(figure, *args, **more)
                return image_of(figure)

        return drawn

    return decorate


def arrow(axes: Axes, start: Any, tip: Any, colour: str, width: float = 2.5) -> None:
    """Draw an arrow between two points of the axes, (2,) each."""
    style = {"arrowstyle": "-|>,head_width=0.3,head_length=0.6", "color": colour}
    axes.annotate(
        "", tip, start, arrowprops={**style, "lw": width, "shrinkA": 0, "shrinkB": 0}
    )


def blank(axes: Axes) -> None:
    """Take the frame of the axes away and keep their two scales equal: a drawing."""
    axes.set_aspect("equal")
    axes.set_axis_off()
