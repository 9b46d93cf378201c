"""A clip of the arm and of the student's own, drawn headless as the figures are."""

from pathlib import Path

import numpy as np

from labkit.figures.clip import Caption, arm_clip, kind_of, save_clip, there_and_back
from labkit.inspector.arm import Arm
from labkit.inspector.ghost import Seen
from labkit.inspector.student import AGAIN, Student
from labkit.inspector.tab import day_tabs
from labkit.lesson.day import Day
from labkit.sandbox.sandbox import CALL_SECONDS, Sandbox
from robo47 import panda
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.paths import shown

ENTRY, FRAMES = "panda_nohand", 40
REACH_Q = np.array(
    [0.9, 0.3, -0.4, -1.6, 0.5, 2.2, -0.6]
)  # where the arm goes and back


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
    kind_of(path)
    arm = Arm(panda.load(ENTRY), panda.END_FRAME[ENTRY])
    script = file or day.work
    if file and not file.is_file():
        raise Robo47Error(f"{file} is not there")
    ghost = day_tabs(day).ghost
    qs = there_and_back(panda.READY_Q, REACH_Q, FRAMES)
    said: dict[bytes, Seen] = {}
    alone = f"MuJoCo's arm; {shown(script)} is not there" if ghost else ""
    if ghost is None:
        alone = f"MuJoCo's arm; day {day.number} has no other. Live: make view"
    if ghost is not None and script.is_file():
        with Sandbox() as sandbox:
            student = Student(day, arm, ghost, sandbox, script, CALL_SECONDS)
            student.look()
            for q in qs:
                said[q.tobytes()] = student.see(q)
                if student.problem:
                    raise Robo47Error(student.problem.removesuffix(AGAIN))

    def ghost_of(q: Array) -> dict[str, Array]:
        return dict(said[q.tobytes()].drawn) if said else {}

    def caption_of(q: Array) -> Caption:
        if not said:
            return alone, None
        seen = said[q.tobytes()]
        return seen.sentence.rstrip("."), seen.kind == "good"

    return save_clip(arm_clip(qs, ghost_of, caption_of), path)
