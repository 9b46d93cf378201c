"""A clip of the arm and of the student's own, drawn headless as the figures are."""

from pathlib import Path

import numpy as np

from labkit.base.exchange import LoadError
from labkit.figures import clip
from labkit.inspector.arm import Arm
from labkit.inspector.ghost import Difference, Ghost, Seen, compare
from labkit.inspector.student import poses_of, source_of
from labkit.inspector.tab import day_tabs
from labkit.judge.problems import not_loaded
from labkit.lesson.day import Day
from labkit.sandbox.sandbox import Sandbox
from robo47 import panda
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.paths import shown

ENTRY, FRAMES = "panda_nohand", 40
# Where the arm goes and back.
REACH_Q = np.array([0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6])


def film(path: Path, day: Day, file: Path | None = None) -> int:
    """Write a clip; the arm of the student's code is red wherever it differs.

    Args:
        path: ends in .gif or .webp.
        day: whose function draws the second arm.
        file: the student's; the one in work/ unless given. Without it the arm is alone.

    Returns:
        Its size, bytes.

    Raises:
        Robo47Error: nothing draws here, or another ending.
    """
    clip.kind_of(path)
    script = file or day.work
    if file and not file.is_file():
        raise Robo47Error(f"{file} is not there")
    ghost = day_tabs(day).ghost
    qs = clip.there_and_back(panda.READY_Q, REACH_Q, FRAMES)
    alone = f"MuJoCo's arm; {shown(script)} is not there"
    if ghost is None:
        alone = f"MuJoCo's arm; day {day.number} has no other. Live: make view"
    shots: list[clip.Shot] = [(clip.arm_scene(q), (alone, None)) for q in qs]
    if ghost is not None and script.is_file():
        for i, one in enumerate(_differences(ghost, day, script, qs)):
            words = one.sentence.rstrip(".")
            shots[i] = clip.arm_scene(qs[i], one.drawn), (words, one.good)
    return clip.save_clip(clip.drawn(shots), path)


def _differences(ghost: Ghost, day: Day, script: Path, qs: Array) -> list[Difference]:
    """Return how the student's arm differs at each configuration."""
    arm = Arm(panda.load(ENTRY), panda.END_FRAME[ENTRY])
    found = []
    with Sandbox() as sandbox:
        source = source_of(day, arm.model, sandbox)
        try:
            asker = source.open(script)
        except LoadError as error:
            raise Robo47Error(not_loaded(script, error.reply)) from None
        for q in qs:
            poses, problem = poses_of(asker.ask, source, ghost, arm.model, q)
            found.append(compare(ghost, Seen(q, poses, problem), arm.poses_at(q)))
            if not asker.alive:
                raise Robo47Error(problem)
    return found
