"""Short clips, drawn without a display: the arm with another beside it, or its pick.

    qs = there_and_back(q0, q1, 40)
    save_clip(drawn((arm_scene(q), ("there and back", None)) for q in qs), path)

GIF for what shows nothing else, WebP for a third of the size.
"""

import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from PIL import ExifTags, Image
from tqdm import tqdm

from labkit.figures import client
from labkit.figures.portrait import ghosts, link_frames, with_fingers
from labkit.figures.scene import Box, Camera, Scene
from labkit.figures.sheet import side_by_side, with_line
from robo47.attempt import Film
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.paths import shown

SIZE = (480, 420)  # pixels, of a clip
SECONDS = 5.0  # the duration of a clip
CAMERA = Camera(distance=2.3, lookat=(0.2, 0.0, 0.36))
LARGEST = 1_000_000  # bytes: what a page shows at once
PIXELS = 0.75  # each try that is too large is followed by one this much smaller
GOOD, BAD = (76, 194, 106), (255, 123, 114)
PICK_SIZE = (420, 340)
PICTURE_SIZE = (1200, 800)
FRAMES = 60
AT_THE_TABLE = Camera(
    lookat=(0.33, 0.0, 0.36),
    distance=2.3,
    azimuth=np.radians(215.0),
    elevation=np.radians(-18.0),
)
ARM = 9  # numbers of qpos: seven joints and two fingers; others follow
Caption = tuple[str, bool | None]  # words; whether they are good news, None for neither
Shot = tuple[Scene, Caption]


class Frame(NamedTuple):
    """A picture of a clip, how long it is seen, and the checker's words in it."""

    picture: Image.Image
    seconds: float
    words: str = ""


def there_and_back(start: Array, end: Array, count: int) -> Array:
    """Return a soft move from (nq,) to (nq,) and back without a jump, (count, nq)."""
    s = (1 - np.cos(2 * np.pi * np.arange(count) / count)) / 2
    return start + s[:, None] * (end - start)


def arm_scene(q: ArrayLike, other: Mapping[str, Array] | None = None) -> Scene:
    """Return the Panda at a configuration, (7,).

    Args:
        q: radians.
        other: {link: its pose in the world, (4, 4)} of another arm, drawn in red;
            link7 carries the hand along.
    """
    full = with_fingers(q)
    red = ghosts(link_frames(full), other or {}, wrong=True)
    return Scene(full, SIZE, CAMERA, red, fast=True)


def drawn(shots: Iterable[Shot]) -> list[Image.Image]:
    """Return one picture per scene, with its caption below."""
    pictures = []
    waits = tqdm(list(shots), "drawing", delay=1, leave=False, disable=None)
    for scene, (words, good) in waits:
        picture = Image.fromarray(client.draw(scene))
        colour = None if good is None else GOOD if good else BAD
        pictures.append(with_line(picture, words, colour, 15, 26, "mm"))
    return pictures


def save_clip(
    frames: Sequence[Image.Image],
    path: Path,
    seconds: float = SECONDS,
    largest: int = LARGEST,
) -> int:
    """Write a clip that repeats for ever, smaller and smaller until it fits.

    Args:
        frames: of one size.
        path: ends in .gif or .webp.
        seconds: that one round takes.
        largest: bytes.

    Returns:
        Its size, bytes.
    """
    kind = kind_of(path)
    each = round(1000 * seconds / len(frames))
    some = list(frames)
    while True:
        made = _encoded(some, kind, each)
        if len(made) <= largest:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(made)
            return len(made)
        width, height = (max(round(PIXELS**0.5 * n), 16) for n in some[0].size)
        lanczos = Image.Resampling.LANCZOS
        some = [frame.resize((width, height), lanczos) for frame in some]


def save_frames(frames: Iterable[Frame], path: Path, largest: int = LARGEST) -> str:
    """Write a clip of frames that are seen for different times; say so in a line.

    The file keeps the words that its frames show, so that `words_of` can read them.

    Raises:
        Robo47Error: it is larger than `largest` bytes, or no .gif or .webp.
    """
    kind = kind_of(path)
    pictures, seconds, words = zip(*frames, strict=True)
    said = "\n".join(dict.fromkeys(filter(None, words)))
    made = _encoded(pictures, kind, [round(1000 * s) for s in seconds], said)
    if len(made) > largest:
        raise Robo47Error(f"{path.name} has {len(made):,} bytes, over {largest:,}")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(made)
    width, height = pictures[0].size
    told = f"{width} x {height}, {sum(seconds):.1f} s, {len(made) / 1e3:.0f} kB"
    return f"{shown(path.absolute())}  {told}"


def words_of(path: Path) -> tuple[str, ...]:
    """Return the different words that the frames of a WebP clip show, in order."""
    with Image.open(path) as clip:
        said = clip.getexif().get(ExifTags.Base.ImageDescription, "")
    return tuple(said.encode().decode("unicode_escape").splitlines())


def kind_of(path: Path) -> str:
    """Return "gif" or "webp"; a Robo47Error refuses another ending."""
    kind = path.suffix.lower().lstrip(".")
    if kind not in ("gif", "webp"):
        raise Robo47Error(f"{path.name}: a clip ends in .gif or .webp")
    return kind


def _encoded(
    frames: Sequence[Image.Image], kind: str, each: int | list[int], words: str = ""
) -> bytes:
    """Return a clip's bytes; each frame, or all of them, by milliseconds."""
    about = Image.Exif()
    escaped = words.encode("unicode_escape").decode()  # the field is ASCII
    about[ExifTags.Base.ImageDescription] = escaped
    buffer = io.BytesIO()
    if kind == "gif":  # one palette, no dither: what stands still costs nothing; a
        # small cube keeps its colour
        most, none = Image.Quantize.MAXCOVERAGE, Image.Dither.NONE
        sheet = frames[len(frames) // 2].quantize(96, most, kmeans=4)
        frames = [frame.quantize(palette=sheet, dither=none) for frame in frames]
    first, *rest = frames
    first.save(
        buffer, kind.upper(), save_all=True, append_images=rest, duration=each, loop=0,
        **({"quality": 70, "method": 6, "exif": about} if kind == "webp" else {}),
    )  # fmt: skip
    return buffer.getvalue()


def film_clip(film: Film, path: Path) -> str:
    """Write a film of an attempt, .gif or .webp; return a line about it."""
    kind_of(path)
    rows = np.linspace(0, len(film.qpos) - 1, FRAMES).astype(int)
    shots = (
        (scene_of(film, row, PICK_SIZE, fast=True), phase(film, row)) for row in rows
    )
    size = save_clip(drawn(shots), path, seconds=film.seconds)
    return f"{shown(path.absolute())}  {size / 1e3:.0f} kB"


def film_picture(film: Film, path: Path) -> str:
    """Write a PNG: the film's moments side by side, named; say so in a line."""
    begins = dict(film.phases)
    rows = np.searchsorted(film.t, [begins[name] for name in film.moments])
    whole = [client.draw(scene_of(film, row, PICTURE_SIZE)) for row in rows]
    quarter = PICTURE_SIZE[0] // 4
    middles = [Image.fromarray(part[:, quarter:-quarter]) for part in whole]
    times = [f"{film.t[row]:.1f} s" for row in rows]
    sheet = side_by_side(*zip(middles, film.moments, times, strict=True))
    try:
        sheet.save(path, "PNG")
    except (OSError, ValueError) as error:
        raise Robo47Error(f"cannot write {shown(path.absolute())}: {error}") from None
    return f"{shown(path.absolute())}  {sheet.width} x {sheet.height}"


def phase(film: Film, row: int) -> Caption:
    """Return what the arm does at an instant, and when that is."""
    t = float(film.t[row])
    name = [name for name, begins in film.phases if begins <= t][-1]
    return f"{name}, {t:.1f} s", None


def scene_of(
    film: Film, row: int, size: tuple[int, int], *, fast: bool = False
) -> Scene:
    """Return the arm at an instant, and what stands around it.

    Args:
        film: of an attempt.
        row: of its instants.
        size, fast: as a scene has them.
    """
    qpos = film.qpos[row]
    boxes = tuple(Box(*block) for block in film.blocks(qpos))
    arm = qpos[:ARM]
    return Scene(arm, size, AT_THE_TABLE, fast=fast, boxes=boxes)
