"""The student's picture: there, real, of a plausible size, and their own."""

import struct
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

from robo47.checker.deliverables.item import Item, from_root
from robo47.lesson.day import Day

SMALLEST, LARGEST = (320, 240), 50_000_000  # pixels: width and height; in all
DARK, FLAT = 16, 3.0  # of 255: brightest entry of a black picture; spread of a flat one
SAME = 0.5  # of 255: mean difference to a picture that was only saved again
_SIGNATURE = b"\x89PNG\r\n\x1a\n"
# MuJoCo reads PNG for its textures, so the kit needs no imaging package.
_TEXTURE = '<mujoco><asset><texture name="t" type="2d" file="f.png"/></asset></mujoco>'


class FlawError(Exception):
    """Not a picture that can be judged; its text says why."""


def check_figure(day: Day, week: Path) -> Item:
    """Check the day's figure.

    Args:
        day: from the kit's manifest.
        week: the week's folder in the student's clone.
    """
    path = week / day.figure
    shown = from_root(path, week)
    if not path.is_file():
        return Item("figure", "todo", f"Save your picture of the arm as {shown}.")
    try:
        picture = read_png(path.read_bytes())
        height, width = picture.shape[:2]
        if width < SMALLEST[0] or height < SMALLEST[1]:
            raise FlawError(
                f"it is {width}x{height} pixels; at least "
                f"{SMALLEST[0]}x{SMALLEST[1]} are wanted"
            )
        if picture.max() < DARK:
            raise FlawError("it is black; call mj_forward before rendering")
        if picture.std() < FLAT:
            raise FlawError("it is one colour from edge to edge, without an arm")
        for name in day.kit_figures:
            if _is_copy(picture, path, day.folder / name):
                raise FlawError(f"it is {name} of the kit; make one of your own")
    except FlawError as error:
        return Item("figure", "wrong", f"{shown}: {error}.")
    except OSError as error:
        return Item("figure", "wrong", f"{shown} cannot be read: {error.strerror}.")
    return Item("figure")


def read_png(data: bytes) -> NDArray[np.uint8]:
    """Return the pixels of a PNG, (height, width, 3).

    Args:
        data: the file's content.

    Raises:
        FlawError: no PNG, a broken one, or one far too large.
    """
    if data[:3] == b"\xff\xd8\xff":
        raise FlawError("it is a JPEG under the name of a PNG; save it as PNG")
    if data[:8] != _SIGNATURE or len(data) < 33:
        raise FlawError("it is no PNG picture")
    width, height = struct.unpack(">II", data[16:24])
    if width * height > LARGEST:  # before decoding: a small file can claim any size
        raise FlawError(f"it claims {width}x{height} pixels: too many")
    try:
        model = mujoco.MjModel.from_xml_string(_TEXTURE, {"f.png": data})
    except ValueError:
        raise FlawError("the PNG is cut off or damaged") from None
    return model.tex_data.reshape(height, width, -1)


def _is_copy(picture: NDArray[np.uint8], path: Path, kits: Path) -> bool:
    if not kits.is_file() or kits.resolve() == path.resolve():
        return False
    try:
        other = read_png(kits.read_bytes())
    except FlawError:
        return False
    if other.shape != picture.shape:
        return False
    return float(np.abs(other.astype(np.int16) - picture).mean()) < SAME
