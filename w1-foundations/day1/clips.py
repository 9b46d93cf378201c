"""The clip of Day 1: a minus is typed, an arm folds away, the checker says which.

    make figures DAY=1 ARGS=--clips    figures/day1_mistake.webp, and for a phone

The red arm is the real one's shapes, where the lab's `compose_fk` with the wrong
`joint_T` has each link; the words are what `make check` prints of both files. Between
the ends the angles go from q to -q, so that one sees what moves where.
"""

import json
import sys
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest import mock

import day1_transforms as lab
import numpy as np
from PIL import Image

from labkit.base import processes
from labkit.figures import client, portrait
from labkit.figures.clip import Frame
from labkit.figures.scene import Camera, Scene
from labkit.lesson.day import find_day
from robo47 import panda
from robo47.errors import Robo47Error
from robo47.paths import ROOT

from . import editor

RIGHT, WRONG = "make_T(Rz(q), np.zeros(3))", "make_T(Rz(-q), np.zeros(3))"
TASK = "1.5"
# The arm bends to the front, so that with all signs turned it bends to the back.
Q = np.array([0.0, 0.5, 0.0, -1.4, 0.0, 1.9, 0.785])
CAMERA = Camera((0.02, 0.0, 0.56), 2.75, np.radians(108.0), np.radians(-12.0))
STEP = 0.05  # s, of a frame in which something moves
FOLD, BACK = 17, 12  # frames
READ = 6.0  # s: as long as the sentence takes to be read


def frames(layout: editor.Layout) -> Iterator[Frame]:
    """Yield the clip's frames and how long each is seen."""
    before = page(RIGHT, 1.0, told(RIGHT))
    yield Frame(editor.draw(before, layout), 0.4)
    for code, seconds in ((RIGHT, 0.2), (WRONG, 0.35)):
        yield Frame(editor.draw(page(code, 1.0, typing=True), layout), seconds)
    for sign in soft(1.0, -1.0, FOLD):
        yield Frame(editor.draw(page(WRONG, sign), layout), STEP)
    named = page(WRONG, -1.0, told(WRONG))
    yield Frame(editor.draw(named, layout), READ, named.says[-1])
    for code, seconds in ((WRONG, 0.15), (RIGHT, 0.2)):
        yield Frame(editor.draw(page(code, -1.0, typing=True), layout), seconds)
    for sign in soft(-1.0, 1.0, BACK):
        yield Frame(editor.draw(page(RIGHT, sign), layout), STEP)
    yield Frame(editor.draw(before, layout), 0.5)


def page(
    code: str, sign: float, says: Sequence[str] = (), *, typing: bool = False
) -> editor.Page:
    """Return a moment: the code, and the arm that it makes.

    Args:
        code: what joint_T returns.
        sign: every angle of the red arm, in parts of the right one's; at 1 it is gone.
        says: the checker's lines.
        typing: the cursor stands where the minus goes.
    """
    lines = ("def joint_T(q):", f"    return {code}")
    at = lines[1].index("q)") if typing else None
    return editor.Page(
        lines, arm(sign), f"make check TASK={TASK}", tuple(says),
        mark="-q" if code == WRONG else "", cursor=at,
    )  # fmt: skip


@cache
def arm(sign: float) -> Image.Image:
    """Return the Panda at Q, and in red where the lab puts each link with a sign."""
    full = portrait.with_fingers(Q)
    red = portrait.ghosts(portrait.link_frames(full), links(sign), wrong=True)
    width, height = (editor.SHARP * n for n in editor.ARM)
    return Image.fromarray(client.draw(Scene(full, (width, height), CAMERA, red)))


def links(sign: float) -> dict[str, np.ndarray]:
    """Return the pose of every link that the lab composes, joint_T taking sign * q."""
    model = panda.load("panda_nohand")

    def joint_T(q: float) -> np.ndarray:
        return lab.make_T(lab.Rz(sign * q), np.zeros(3))

    with mock.patch.object(lab, "joint_T", joint_T):
        return {
            body: lab.compose_fk(model, Q, lab.PATH[: i + 1])
            for i, (body, _) in enumerate(lab.PATH)
            if body in portrait.LINKS
        }


@cache
def told(code: str) -> tuple[str, ...]:
    """Return the verdict on a lab with this joint_T, and the checker's sentences.

    The call and the matrix that `make check` prints below them need more room than the
    clip has, so the sentences alone are shown, and those are whole.
    """
    source = find_day(1).source.read_text("utf-8")
    with TemporaryDirectory(prefix="robo47-clip-") as folder:
        file = Path(folder) / find_day(1).script
        file.write_text(source.replace(RIGHT, code), "utf-8")
        words = ["scripts/check_day.py", "1", "--task", TASK, "--file", str(file)]
        done = processes.run([sys.executable, *words, "--json"], cwd=ROOT)
    if not done.stdout:
        raise Robo47Error(f"the checker said nothing of {TASK}: {done.stderr[-300:]}")
    (entry,) = json.loads(done.stdout)["entries"]
    functions = ", ".join(find_day(1).task(TASK).functions)
    state = "passed" if entry["status"] == "passed" else entry["status"].upper()
    return (f"{TASK} {functions} {state}", *filter(None, [entry["message"]]))


def soft(start: float, end: float, count: int) -> list[float]:
    """Return numbers from behind one to another that begin and end slowly."""
    s = (1 - np.cos(np.pi * np.arange(1, count + 1) / count)) / 2
    return [float(x) for x in start + s * (end - start)]


CLIPS = {
    "mistake": lambda: frames(editor.WIDE),
    "mistake_tall": lambda: frames(editor.TALL),
}
