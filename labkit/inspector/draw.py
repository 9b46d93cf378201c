"""Drawings in the scene; those of a tab go when the tab is left.

Points are in the world, metres. A colour is a name of `COLOURS` or (r, g, b), 0 to 255.
What is returned is viser's handle: `visible`, `position`, `points`, ... can be set, and
the scene follows.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import viser
from numpy.typing import ArrayLike, NDArray

from labkit.inspector.meshes import NUMBERS, Skin, place
from labkit.inspector.shapes import LARGER, Shape
from robo47 import se3
from robo47.checks import Array

ROOT = "/tab"
FARTHEST = 10.0  # metres; nobody drags a target further away
APART = 0.07  # metres between two labels
LETTER = 1.12  # the place of an axis' letter, in lengths of the axis
PLAIN, CHOSEN = 0.10, 0.17  # metres of an axis
# A frame's axes from end to end, a metre long.
AXES = np.stack([np.zeros((3, 3)), np.eye(3)], axis=1).astype(np.float32)
# Told apart by lightness as well as by hue (Okabe and Ito, 2008).
COLOURS = {
    "x": (228, 84, 34),
    "y": (0, 170, 124),
    "z": (58, 128, 240),
    "orange": (240, 168, 20),
    "red": (232, 64, 58),
    "blue": (70, 145, 235),
    "green": (0, 178, 132),
    "purple": (188, 84, 212),
    "grey": (150, 158, 168),
    "white": (236, 239, 243),
}
Points = NDArray[np.float32]
Colour = str | tuple[int, int, int]
Anchor = Literal["bottom-left", "center-left", "top-right"]


class Sketch:
    """Draws for one tab, or for all of them."""

    def __init__(
        self, server: viser.ViserServer, coarse: Sequence[Shape] = (), root: str = ROOT
    ) -> None:
        """Begin with the arm's simple meshes, for ghosts."""
        self.server, self.coarse = server, coarse
        self.ghosts: list[Skin] = []
        # All that is drawn hangs from it.
        self.root = server.scene.add_frame(root, show_axes=False)

    def clear(self) -> None:
        """Remove everything that was drawn here."""
        self.root.remove()

    def part(self) -> "Sketch":
        """Return a sketch that goes with this one, or is cleared before."""
        return Sketch(self.server, self.coarse, self.path())

    def path(self) -> str:
        """Return a name in the scene tree for one more node of this tab."""
        return f"{self.root.name}/{next(NUMBERS)}"

    def arrows(
        self, points: ArrayLike, colour: Colour = "blue", radius: float = 0.006
    ) -> viser.ArrowsHandle:
        """Draw arrows from start to end, (n, 2, 3); the radius is the shafts'."""
        return self.server.scene.add_arrows(
            self.path(), np.asarray(points, dtype=np.float32), rgb(colour),
            shaft_radius=radius, head_radius=2.4 * radius, head_length=6 * radius,
        )  # fmt: skip

    def lines(
        self, points: ArrayLike, colour: Colour = "white", width: float = 2.5
    ) -> viser.LineSegmentsHandle:
        """Draw line segments by their ends, (n, 2, 3); the width is in pixels."""
        return self.server.scene.add_line_segments(
            self.path(), np.asarray(points, dtype=np.float32), rgb(colour),
            thickness=width, thickness_units="screen",
        )  # fmt: skip

    def curve(
        self, points: ArrayLike, colour: Colour = "white", width: float = 2.5
    ) -> viser.LineSegmentsHandle:
        """Draw a line through points, (n, 3); see `lines` and `joined`."""
        return self.lines(joined(points), colour, width)

    def sphere(
        self, at: ArrayLike, radius: float, colour: Colour = "grey", opacity: float = 1
    ) -> viser.IcosphereHandle:
        """Draw a ball around a point, (3,), with a radius in metres."""
        return self.server.scene.add_icosphere(
            self.path(), radius, rgb(colour), opacity=opacity,
            position=np.asarray(at, dtype=np.float64),
        )  # fmt: skip

    def disc(
        self,
        radius: float,
        height: float,
        colour: Colour = "grey",
        opacity: float | None = None,
    ) -> viser.CylinderHandle:
        """Draw an upright cylinder, metres; setting `position` moves its middle."""
        return self.server.scene.add_cylinder(
            self.path(),
            radius,
            height,
            rgb(colour),
            radial_segments=48,
            opacity=opacity,
        )

    def box(
        self, half: ArrayLike, colour: Colour = "grey", opacity: float | None = None
    ) -> viser.BoxHandle:
        """Draw a solid box by its half sides, metres, (3,); `place` moves it."""
        x, y, z = (2.0 * float(side) for side in np.asarray(half))
        return self.server.scene.add_box(
            self.path(), rgb(colour), (x, y, z), opacity=opacity
        )

    def ellipsoid(self, colour: Colour = "purple", opacity: float = 0.4) -> "Ellipsoid":
        """Draw an ellipsoid; `show(matrix, at, scale)` gives it its shape."""
        ball = self.sphere(np.zeros(3), 1.0, colour, opacity)
        ball.visible = False
        return Ellipsoid(ball)

    def frame(self, name: str, T: Array | None = None) -> "Triad":
        """Draw a frame, named unless "", at a pose, (4, 4).

        `place(T)` moves it, `show(...)` hides it.
        """
        triad = Triad(self.server, self.path(), name)
        triad.place(np.eye(4) if T is None else T)
        return triad

    def label(self, text: str, at: ArrayLike) -> viser.LabelHandle:
        """Write at a point, (3,); setting `position` or `text` changes it."""
        return self.server.scene.add_label(
            self.path(), text, position=np.asarray(at, dtype=np.float64),
            font_screen_scale=0.8,
        )  # fmt: skip

    def labels(self, texts: Sequence[str]) -> "Labels":
        """Write several texts; `show(points)` puts them there, (n, 3)."""
        return Labels([self.label(text, np.zeros(3)) for text in texts], texts)

    def ghost(self, colour: Colour = "blue", opacity: float = 0.4) -> Skin:
        """Draw another arm; `pose({body: T_world_body})` puts its links somewhere."""
        by = LARGER * (len(self.ghosts) + 1)
        skin = Skin(self.server, self.path(), rgb(colour), opacity, by)
        skin.put_on(self.coarse)
        self.ghosts.append(skin)
        return skin

    def dress(self, coarse: Sequence[Shape]) -> None:
        """Put the arm's simple meshes on the ghosts that were drawn before them."""
        self.coarse = coarse
        for skin in self.ghosts:
            skin.put_on(coarse)

    def target(self, T: Array, on_drag: Callable[[Array], None]) -> "Target":
        """Draw a handle at T, (4, 4), that the mouse drags; `on_drag` is given it."""
        handle = self.server.scene.add_transform_controls(
            self.path(), scale=0.18, depth_test=False
        )
        target = Target(handle)
        target.place(T)

        @handle.on_update
        async def _(event: viser.TransformControlsEvent) -> None:
            position, wxyz = np.array(handle.position), np.array(handle.wxyz)
            near = np.abs([*position, *wxyz]).max() < FARTHEST  # false for NaN as well
            if near and np.linalg.norm(wxyz) > 0.5:
                on_drag(target.T)

        return target


@dataclass
class Labels:
    """Texts in the scene; those that would cover each other become one."""

    handles: Sequence[viser.LabelHandle]
    texts: Sequence[str]

    def show(self, points: ArrayLike) -> None:
        """Put them at points, (n, 3)."""
        first: dict[int, str] = {}
        at = np.asarray(points, dtype=np.float64)
        for i, text in enumerate(self.texts):
            near = (k for k in first if np.linalg.norm(at[k] - at[i]) < APART)
            key = next(near, i)
            first[key] = f"{first[key]} {text}" if key in first else text
        for i, handle in enumerate(self.handles):
            handle.visible = i in first
            handle.text = first.get(i, "")
            handle.position = at[i]


@dataclass
class Ellipsoid:
    """The points p with p^T A^-1 p = 1, around a point."""

    ball: viser.IcosphereHandle  # a ball of radius 1, which is scaled

    @property
    def visible(self) -> bool:
        """Whether it is drawn."""
        return self.ball.visible

    @visible.setter
    def visible(self, shown: bool) -> None:
        self.ball.visible = shown

    def show(self, A: ArrayLike, at: ArrayLike, scale: float = 1.0) -> None:
        """Give it its shape.

        Args:
            A: symmetric, not negative, (3, 3): J J^T, or the inverse of an inertia.
            at: its middle, metres, (3,).
            scale: metres per unit of the half axes, which are sqrt(eigenvalues).
        """
        squares, axes = np.linalg.eigh(np.asarray(A, dtype=np.float64))
        axes[:, 2] *= np.sign(np.linalg.det(axes))  # a rotation, not a reflection
        half = scale * np.sqrt(np.maximum(squares, 0.0))
        x, y, z = (float(max(h, 1e-4)) for h in half)
        self.ball.scale = (x, y, z)
        place(self.ball, se3.make_T(axes, at))
        self.ball.visible = True


@dataclass
class Target:
    """A pose that the mouse moves."""

    handle: viser.TransformControlsHandle

    @property
    def T(self) -> Array:
        """Where it is, (4, 4)."""
        R = se3.quat_to_R(np.array(self.handle.wxyz))
        return se3.make_T(R, np.array(self.handle.position))

    def place(self, T: Array) -> None:
        """Put it somewhere, (4, 4)."""
        place(self.handle, T)


class Triad:
    """A frame as three arrows; one of them may stand out, with letters on its axes."""

    def __init__(
        self,
        server: viser.ViserServer,
        path: str,
        text: str,
        anchor: Anchor = "bottom-left",
        letters: bool = False,
    ) -> None:
        """Draw it at the world's origin, under a name in the scene tree.

        The label is a text or "", with its anchor at the frame; letters name the axes
        even while it does not stand out.
        """
        scene = server.scene
        self.always = letters
        self.frame = scene.add_frame(path, show_axes=False)
        colours = np.array([COLOURS[axis] for axis in "xyz"], dtype=np.uint8)
        self.arrows = scene.add_arrows(f"{path}/axes", PLAIN * AXES, colours)
        small: dict[str, Any] = {"font_screen_scale": 0.75}
        self.letters = [
            scene.add_label(f"{path}/{name}", name, anchor="center-center", **small)
            for name in "xyz"
        ]
        self.text = (
            scene.add_label(f"{path}/name", text, anchor=anchor, **small)
            if text
            else None
        )
        self.taken = [False] * 4  # places of the name and the letters that are taken
        self.state: tuple[bool, bool] | None = None
        self.show(visible=True, chosen=False)

    def place(self, T: Array) -> None:
        """Move it to a pose, (4, 4)."""
        place(self.frame, T)

    @property
    def visible(self) -> bool:
        """Whether it is drawn."""
        return self.frame.visible

    @visible.setter
    def visible(self, shown: bool) -> None:
        self.show(shown, self.state is not None and self.state[1])

    def labels_at(self, T: Array) -> Array:
        """Return where its name and its letters are with the frame at T, (4, 3)."""
        length = CHOSEN if self.state and self.state[1] else PLAIN
        return T[:3, 3] + LETTER * length * np.vstack([np.zeros(3), T[:3, :3].T])

    def clear(self, taken: Array, T: Array) -> None:
        """Take away what would stand on labels at points, (n, 3), with it at T."""
        apart = np.linalg.norm(self.labels_at(T)[:, None] - taken, axis=2)
        self.taken = [bool(near) for near in (apart < APART).any(axis=1)]
        self._write()

    def _write(self) -> None:
        """Show the name, and letters where it has them: few of all frames do."""
        letters = self.always or (self.state is not None and self.state[1])
        if self.text is not None:
            self.text.visible = letters and not self.taken[0]
        for letter, taken in zip(self.letters, self.taken[1:], strict=True):
            letter.visible = letters and not taken

    def show(self, visible: bool, chosen: bool) -> None:
        """Show or hide it; the chosen one is larger and has letters."""
        if self.state == (visible, chosen):
            return
        self.state = visible, chosen
        length = CHOSEN if chosen else PLAIN
        self.frame.visible = visible
        self.arrows.points = length * AXES
        self.arrows.shaft_radius = 0.03 * length
        self.arrows.head_radius, self.arrows.head_length = 0.09 * length, 0.2 * length
        for axis, letter in zip(np.eye(3), self.letters, strict=True):
            letter.position = LETTER * length * axis
        self._write()


def joined(points: ArrayLike) -> Points:
    """Return the segments of a line through points, (n, 3), as `lines` takes them."""
    p = np.asarray(points, dtype=np.float32)
    return np.stack([p[:-1], p[1:]], axis=1)


def rgb(colour: Colour) -> tuple[int, int, int]:
    """Return a colour's numbers; ValueError where none has that name."""
    if not isinstance(colour, str):
        return colour
    if colour not in COLOURS:
        raise ValueError(f"no colour {colour!r}; there are {', '.join(COLOURS)}")
    return COLOURS[colour]
