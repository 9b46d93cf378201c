"""A clip of the arm and of the student's own, drawn headless as the figures are."""

from pathlib import Path

import numpy as np

from labkit.figures import clip
from labkit.inspector.arm import Arm
from labkit.inspector.student import AGAIN, Student
from labkit.inspector.tab import day_tabs
from labkit.lesson.day import Day
from labkit.sandbox.sandbox import CALL_SECONDS, Sandbox
from robo47 import panda
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
        arm = Arm(panda.load(ENTRY), panda.END_FRAME[ENTRY])
        with Sandbox() as sandbox:
            student = Student(day, arm, ghost, sandbox, script, CALL_SECONDS)
            student.look()
            for i, q in enumerate(qs):
                seen = student.see(q)
                if student.problem:
                    raise Robo47Error(student.problem.removesuffix(AGAIN))
                words = seen.sentence.rstrip(".")
                shots[i] = clip.arm_scene(q, seen.drawn), (words, seen.kind == "good")
    return clip.save_clip(clip.drawn(shots), path)
