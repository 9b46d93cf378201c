"""Tables of documents for authors: kinds of answers, limits, a capstone.

A document asks for one between two comments, and `make docs` writes it:

    <!-- table: kinds -->
    <!-- end -->
"""

import dataclasses
from collections.abc import Callable, Iterator

import labkit.judge as judge
from labkit.author import hints
from labkit.check.lab_run import TRIALS
from labkit.handin import figure, handin
from labkit.judge import ask, draw
from labkit.judge.kinds import Kind
from labkit.lesson import day
from labkit.sandbox import sandbox
from labkit.sandbox.inside import wire
from robo47.paths import ROOT

EXAMPLES = (
    'Scalar(unit="J", scale=10.0)',
    'Vector((7,), "N m", scale=10.0, names=("joint1", "joint2"))',
    "Vector((None,))",
    'Matrix((3, 4), "m")',
    "Symmetric((6, 6))",
    "Covariance((3, 3))",
    'Jacobian((6, 7), columns=("joint1", "joint2"))',
    "Rotation()",
    "Pose()",
    "Twist()",
    "Wrench()",
    'Points((3, 3), names=("base", "elbow", "hand"))',
    'Pixels((None, 2), none="the point is behind the camera")',
    "Waypoints((None, 2))",
    'Count(called="the rank")',
    "Index()",
    'Word(words=("reached", "trapped"))',
    "Mask()",
    "Mask((8,))",
    '(Index(), Vector((2,), "m"), Mask(called="whether it is free"))',
)


def kinds() -> str:
    """Return a row for each kind: an example, what it expects, arguments of its own."""
    shared = {one.name for one in dataclasses.fields(Kind)}
    lines = ["| write | a student's answer is | its own arguments |", "|---|---|---|"]
    for example in EXAMPLES:
        made = eval(example, vars(judge))
        several = made if isinstance(made, tuple) else (made,)
        own = [
            f"`{one.name}`"
            for kind in several
            for one in dataclasses.fields(kind)
            if one.name not in shared and not isinstance(made, tuple)
        ]
        expected = "; ".join(kind.expected for kind in several)
        expected = f"a tuple: {expected}" if isinstance(made, tuple) else expected
        lines.append(f"| `{example}` | {expected} | {', '.join(own)} |")
    return "\n".join(lines) + "\n"


def limits() -> str:
    """Return a row for each limit, its value, and where it is set."""
    lines = ["| what | limit | asked for |", "|---|---|---|"]
    lines += [f"| {what} | {value} | {where} |" for what, value, where in _limits()]
    return "\n".join(lines) + "\n"


def _limits() -> Iterator[tuple[str, str, str]]:
    most = day.MOST
    task = {one.name: one.default for one in dataclasses.fields(day.Task)}
    yield from (
        (
            "seconds for all calls of a task",
            f"{task['seconds']:g}; a third of it for one",
            f"`seconds` of the task, to {most['seconds']:g}",
        ),
        (
            "seconds for a student's file, all tasks and second looks",
            f"{sandbox.RUN_SECONDS:g}, and the lab's",
            "–",
        ),
        ("memory, GB", f"{task['memory']:g}", f"`memory`, to {most['memory']:g}"),
        (
            "numbers in an answer",
            f"{task['numbers']:,}",
            f"`numbers`, to {most['numbers']:,}",
        ),
        ("numbers in a question", f"{wire.LARGEST:,}", "–"),
        ("results in an answer", f"{wire.PARTS}, tuples nested once", "–"),
        (
            "calls of a function in a check",
            "yours, and drawn ones; each twice",
            "`@row.inputs`",
        ),
        (
            "of those, sampled",
            f"{ask.CHEAP_FRESH} where all arguments have {ask.CHEAP} numbers at most, "
            f"else {ask.FRESH}; as many with edge values",
            "a cost: the task's `seconds`",
        ),
        ("decimals of what `rng.numbers` draws", f"{draw.DECIMALS}", "`rounded`"),
    )
    yield from _sizes()


def _sizes() -> Iterator[tuple[str, str, str]]:
    seconds = next(o for o in dataclasses.fields(day.Day) if o.name == "lab_seconds")
    low, high = hints.WORDS
    width, height = figure.SMALLEST
    yield from (
        (
            "seconds of a lab's run in a check",
            f"{seconds.default:g}",
            f"`[limits] lab_seconds`, to {day.MOST_LAB:g}",
        ),
        (
            "random inputs of a lab's step in a check",
            f"{TRIALS}",
            "the lab's own `TRIALS` and `LIBRARY_TRIALS` become that; call a number "
            "that must stay by another name",
        ),
        ("hints of a task", " or ".join(map(str, hints.HOW_MANY)), "day.toml"),
        (
            "words of a hint",
            f"{low} to {high}; one of them asks",
            "day.toml",
        ),
        ("a student's picture", f"{width} x {height} at least", "–"),
        ("a student's file", f"{handin.LIMITS['script'] // 1000} kB", "–"),
    )


def capstone() -> str:
    """Return a whole capstone, one that the kit's tests run."""
    (path,) = (ROOT / "tests").glob("*/pointing.py")
    text = path.read_text("utf-8")
    return f"```python\n{text.rstrip()}\n```\n"


TABLES: dict[str, Callable[[], str]] = {
    "kinds": kinds,
    "limits": limits,
    "capstone": capstone,
}
