"""The student's picture: there, real, of a plausible size, and their own."""

import math
import struct
import zlib
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

from labkit.handin.handin import Handin, Item
from labkit.lesson.day import Day, days_of

SMALLEST = (320, 240)  # pixels: width and height
LARGEST = 20_000_000  # pixels in all
DARK = 16  # a picture whose brightest entry (of 255) is darker is black
FLAT = 3.0  # a picture whose spread (of 255) is smaller is flat
SAME = 0.5  # mean difference (of 255) of a picture that was only saved again
PORTRAIT = "robo47 portrait"  # a text in the file of a picture of the arm alone
_SIGNATURE = b"\x89PNG\r\n\x1a\n"
# MuJoCo reads PNG for its textures, so the kit needs no imaging package.
_TEXTURE = '<mujoco><asset><texture name="t" type="2d" file="f.png"/></asset></mujoco>'


class FlawError(Exception):
    """Not a picture that can be judged; its text says why."""


def check_figure(day: Day, handin: Handin) -> Item:
    """Check the day's figure.

    Args:
        day: from the kit's manifest.
        handin: what the student's folder holds.
    """
    name = day.files["figure"]
    data = handin.files.get(name)
    if data is None:
        says = f"Save your picture as {name}. {_command(day)}"
        return Item("figure", "todo", says)
    try:
        picture = read_png(data)
        _look(picture)
        if day.draw and PORTRAIT.encode() in data:
            says = "it shows the arm alone, and nothing that your functions do"
            raise FlawError(f"{says}. {_command(day)}")
        week = (day, *days_of(day.week))
        for kit in sorted({name for one in week for name in one.kit_figures}):
            if _is_copy(picture, day.folder / kit):
                raise FlawError(f"it is {kit} of the kit; make one of your own")
    except FlawError as error:
        return Item("figure", "wrong", f"{name}: {error}.")
    return Item("figure")


def _command(day: Day) -> str:
    """Return which command makes the picture."""
    if day.draw:
        return f"Drawn with your own functions: make figures DAY={day.number}"
    return f"One of the arm: make view DAY={day.number} ARGS=--screenshot"


def _look(picture: NDArray[np.uint8]) -> None:
    """Raise FlawError for a picture that shows nothing."""
    height, width = picture.shape[:2]
    if width < SMALLEST[0] or height < SMALLEST[1]:
        raise FlawError(
            f"it is {width}x{height} pixels; at least "
            f"{SMALLEST[0]}x{SMALLEST[1]} are required"
        )
    step = max(1, math.isqrt(width * height // 1_000_000))  # some pixels tell as much
    some = picture[::step, ::step]
    if some.max() < DARK:
        raise FlawError("it is black; call mj_forward before rendering")
    if some.std() < FLAT:
        raise FlawError("it is one colour from edge to edge, without an arm")


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
    # A small file can claim any size, so the size is tested first.
    if width * height > LARGEST:
        raise FlawError(f"it claims {width}x{height} pixels: too many")
    if not _inflates(data, width, height):
        raise FlawError("the PNG is cut off or damaged")
    try:
        model = mujoco.MjModel.from_xml_string(_TEXTURE, {"f.png": data})
    except ValueError:
        raise FlawError("the PNG is cut off or damaged") from None
    return model.tex_data.reshape(height, width, -1)


def _inflates(data: bytes, width: int, height: int) -> bool:
    """Return whether a PNG's data has no more bytes than its size asks for.

    Counted piece by piece: a megabyte may claim to be a gigabyte.
    """
    most = 8 * (width + 8) * (height + 8) + 16 * height  # 64 bits a pixel, interlaced
    unpack = zlib.decompressobj()
    at = 8
    try:
        while at + 8 <= len(data):
            size, kind = struct.unpack(">I4s", data[at : at + 8])
            piece = data[at + 8 : at + 8 + size] if kind == b"IDAT" else b""
            while piece and not unpack.eof:  # the time grows with what follows
                most -= len(unpack.decompress(piece, 1_000_000))
                piece = unpack.unconsumed_tail
                if most < 0:
                    return False
            at += size + 12
    except zlib.error:
        return False
    return True


def _is_copy(picture: NDArray[np.uint8], kits: Path) -> bool:
    """Return whether a picture is one of the kit's, though it was saved again."""
    if not kits.is_file():
        return False
    try:
        data = kits.read_bytes()
        if struct.unpack(">II", data[16:24]) != picture.shape[1::-1]:
            return False  # most are of another size: there is nothing to decode
        other = read_png(data)
    except (FlawError, struct.error):
        return False
    if other.shape != picture.shape:
        return False
    return float(np.abs(other.astype(np.int16) - picture).mean()) < SAME
