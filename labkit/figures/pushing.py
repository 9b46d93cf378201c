"""Films of Week 3's scene from above: two runs side by side, with pusher and puck."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from labkit.figures import chart
from labkit.figures.chart import GREY, INK
from labkit.figures.clip import Frame
from robo47 import push

MM = 1000.0
EVERY = 2  # steps between two frames
SECONDS, AT_THE_END = 0.12, 1.2  # that a frame is seen


def film(
    starts: Iterable[int],
    titles: Sequence[str],
    draw: Callable[..., None],
    steps: int = push.STEPS,
    **look: Any,
) -> Iterator[Frame]:
    """Yield the frames of two runs side by side, and how long each is seen.

    Args:
        starts: those that are shown, one after the other.
        titles: of the two runs.
        draw: draw(axes, i, start=, k=) draws the run with the index i up to step k.
        steps: of a run.
        look: as in `_moment`.
    """
    for start in starts:
        for k in range(0, steps + 1, EVERY):
            one = partial(draw, start=start, k=k)
            seconds = AT_THE_END if k + EVERY > steps else SECONDS
            yield Frame(_moment(titles, one, k, **look)(), seconds)


def _moment(
    titles: Sequence[str],
    draw: Callable[[Axes, int], None],
    k: int,
    *,
    half: tuple[float, float] = (400.0, 380.0),
    home: str = "0.85",
) -> Callable[[], Any]:
    """Return what draws both runs at a step.

    Args:
        titles: of the two runs.
        draw: draws the run with an index into the axes.
        k: the step.
        half: the size of the part of the plane that is shown, mm from home.
        home: colour of the disc in which a puck is at home.
    """

    @chart.picture(height=3.4, width=6.4)
    def both(figure: Figure) -> None:
        for i, (axes, title) in enumerate(
            zip(figure.subplots(1, 2), titles, strict=True)
        ):
            axes.add_patch(Circle((0, 0), MM * push.HOME, color=home))
            draw(axes, i)
            axes.set(xlim=(-half[0], half[0]), ylim=(-half[1], half[1]))
            axes.set(aspect="equal", title=f"{title}, {k * push.TICK:.1f} s")
            axes.set(xticks=(), yticks=())
            axes.spines[:].set_color(GREY)

    return both


def bodies(axes: Axes, seen: np.ndarray, colour: str = "") -> None:
    """Draw puck and pusher, (x, y) of the pusher and of the puck in m.

    Args:
        axes: in mm.
        seen: an observation, (4,).
        colour: of the puck; without one, both are outlines.
    """
    width = 1.0 if colour else 1.2
    for at, r, ink in (
        (seen[2:], push.PUCK, colour or INK),
        (seen[:2], push.PUSHER, INK),
    ):
        x, y = MM * at
        axes.add_patch(
            Circle((x, y), MM * r, fill=bool(colour), color=ink, linewidth=width)
        )
