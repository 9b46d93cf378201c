"""What goes into a diagnosis and what comes out: calls, answers and a verdict.

Nothing here computes, so that whoever runs the student's code can import it for free.
"""

from dataclasses import dataclass
from typing import Any

MODEL = "MODEL"  # placeholder argument: the runner passes the Panda's model

# Which functions of the student's file each task of Day 1 asks for.
TASK_FUNCTIONS: dict[str, tuple[str, ...]] = {
    "1.1": ("make_T",),
    "1.2": ("Rz",),
    "1.3": ("inverse",),
    "1.4": ("quat_to_R",),
    "1.5": ("link_T", "joint_T"),
    "1.6": ("compose_fk",),
    "1.7": ("predict_order",),
    "1.8": ("link4_to_world",),
}


@dataclass(frozen=True)
class Call:
    """One question to the student's file: a function's name and its arguments.

    Attributes:
        function: as in `TASK_FUNCTIONS`.
        args: float64 arrays, floats, or `MODEL`; copies, so a runner may hand them on.
    """

    function: str
    args: tuple[Any, ...]


@dataclass(frozen=True)
class Answer:
    """What came back from one call.

    Attributes:
        value: an array, a tuple of arrays, or None where nothing was returned.
        error: the exception and its line ("ZeroDivisionError: ... (line 31)"), or None.
    """

    value: Any
    error: str | None = None


@dataclass(frozen=True)
class Verdict:
    """What the answers to a task's calls show.

    Attributes:
        status: "passed"; "close": the method is right, the digits are not; "wrong";
            or "todo": not written yet.
        mistake: its name ("joint-before-link"), "" when passed.
        message: one or two sentences for the student, with the telling number; "" when
            passed and there is nothing to add.
        measured: lines for --explain.
    """

    status: str
    mistake: str
    message: str
    measured: tuple[str, ...] = ()
