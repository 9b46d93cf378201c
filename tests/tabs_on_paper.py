"""A tab without a server: all that it says and draws, in the order in which it came.

The page is the inspector's own; under it stands paper instead of viser. Jobs are done
at once, loops are played by `play`. What is asked of the student functions answer.
"""

import re
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import numpy as np

from conftest import Answers
from labkit.base.exchange import Reply
from labkit.inspector import page as page_module
from labkit.inspector.arm import Arm
from labkit.inspector.standing import Standing
from labkit.lesson.day import find_day
from robo47 import panda

WHOSE = 'data-line="whose"'  # says in words that they differ; the tab itself is to show
KINDS = re.compile(r"\br47-(good|bad)\b")  # so does the colour of a line
SEEN = 1e-4  # of a metre or of any other number: what one sees in a picture


class Paper:
    """Anything of viser's: it keeps what is set on it and what it is called with."""

    def __init__(self, log: list, name: str) -> None:
        vars(self).update(log=log, name=name)

    def __setattr__(self, name: str, value: Any) -> None:
        if WHOSE not in str(value):
            self.log.append((f"{self.name}.{name}", value))
        vars(self)[name] = value

    def __getattr__(self, name: str) -> Any:
        if name == "_impl":
            return SimpleNamespace(uuid="000000")
        if name in ("position", "wxyz", "handle", "ball", "bodies", "value"):
            vars(self)[name] = {
                "position": np.zeros(3), "wxyz": np.eye(4)[0], "bodies": {},
                "value": "",
            }.get(name, Paper(self.log, f"{self.name}.{name}"))  # fmt: skip
            return vars(self)[name]
        return lambda *args, **named: self.called(name, args, named)

    def called(self, name: str, args: tuple, named: dict) -> "Paper":
        """Keep a call, and return what came of it."""
        self.log.append((f"{self.name}.{name}", (args, tuple(named.items()))))
        return Paper(self.log, f"{self.name}.{name}() {len(self.log)}")


class Target(Paper):
    """A pose to drag, which stays where it is put."""

    T = np.eye(4)

    def place(self, T: Any) -> None:
        """Put it there."""
        vars(self)["T"] = np.array(T)


class Sketch(Paper):
    """The scene, on paper."""

    def target(self, T: Any, on_drag: Any) -> Target:
        """Return a handle that nobody drags."""
        made = Target(self.log, "target")
        made.place(T)
        return made


class Loop:
    """An animation that stands until it is played."""

    def __init__(self, step: Any, hz: float, changed: Any, work: Any) -> None:
        self.step, self.hz, self.changed, self.work = step, hz, changed, work
        self.running, self.slow, self.lasts, self.due = False, 1.0, np.inf, False

    def start(self, *_: float) -> None:
        """Have `play` play it."""
        self.running = True

    def stop(self) -> None:
        """Let it stand."""
        self.running = False

    def toggle(self) -> None:
        """Start or stop."""
        self.running = not self.running


class Now:
    """Jobs that are done at once; those of one moment not before it is over."""

    def __init__(self, ended: Any) -> None:
        self.ended = ended
        self.waits = self.due = False  # for the end of the moment; what it may say
        self.next: tuple[Any, Any] | None = None

    def want(self, work: Any, done: Any) -> None:
        """Do it, unless another one comes before that."""
        self.next = work, done
        if not self.waits:
            self.go()

    def go(self) -> None:
        """Do the newest."""
        self.waits = False
        if self.next is None:
            return
        (work, done), self.next = self.next, None
        try:
            done(work())
        except Exception as error:
            self.ended(error)
        else:
            self.ended(None)

    def stop(self) -> None:
        """There is nothing to stop."""


class Desk:
    """One open tab, and who asks for what."""

    def __init__(self, number: int, kind: Any, functions: dict[str, Any]) -> None:
        """Open a tab of a day for who wrote these functions."""
        self.log: list[tuple[str, Any]] = []
        self.asked: set[str] = set()
        self.opened: set[str] = set()  # what opening it asks
        self.arm = Arm(panda.load(), panda.END_FRAME["panda_nohand"])
        self.q = self.arm.q.copy()
        self.student = Answers(functions)
        self.student.day = find_day(number)
        self.student.ask = self.ask
        self.server, self.scene = Paper(self.log, "server"), Paper(self.log, "scene")
        vars(self.server)["gui"] = Paper(self.log, "gui")
        self.solid, self.legend = Paper(self.log, "solid"), Paper(self.log, "legend")
        self.simple, self.standing = True, Standing("")
        self.loops: list[Loop] = []
        self.queues: list[Now] = []
        self.problem: Exception | None = None  # what stopped a job or a loop
        self.lost = 0  # how long the log was when no answer came last
        self.tab: Any = None
        made = {"Animation": self.loop, "Jobs": self.jobs, "Robot": self.robot}
        with patch.multiple(page_module, **made):
            self.page = page_module.Page(self, Sketch(self.log, "draw"))
            self.tab = kind(self.page)
        self.tab.on_move(self.q)
        self.settle()

    def ask(self, questions: Any, version: int) -> list[Reply]:
        """Ask the functions; one that stops is told as the sandbox tells it."""
        self.asked |= {one.function for one in questions}
        replies = []
        for one in questions:
            if one.function not in self.student.functions:
                replies += [Reply(kind="missing")]
                continue
            try:
                replies += [Reply(self.student.functions[one.function](*one.args))]
            except Exception as error:
                replies += [Reply(kind=type(error).__name__, error=str(error))]
        return replies

    def loop(self, *given: Any) -> Loop:
        """Make an animation."""
        self.loops.append(Loop(*given))
        return self.loops[-1]

    def robot(self, *_: Any) -> Paper:
        """Draw a robot."""
        return Paper(self.log, "robot")

    def jobs(self, ended: Any) -> Now:
        """Make a queue, which keeps what stopped a job."""

        def told(error: Exception | None) -> None:
            self.problem = error or self.problem
            ended(error)

        self.queues.append(Now(told))
        return self.queues[-1]

    def listen(self, widget: Any, then: Any) -> Any:
        """Return a widget that nobody changes."""
        vars(widget)["then"] = then
        return widget

    def move(self, q: Any) -> None:
        """Move the arm, later."""
        self.q = np.array(q, dtype=float)

    def schedule(self) -> None:
        """Everything is brought up to date by `settle`."""

    def lose(self) -> None:
        """Tell the tab that there is no answer."""
        if self.tab is not None:
            self.tab.lost()
        self.lost = len(self.log)

    def settle(self) -> None:
        """Have the arm be where it was moved to."""
        while not np.array_equal(self.q, self.arm.q):
            self.arm.move(self.q)
            self.tab.on_move(self.q.copy())

    def play(self, frames: int) -> None:
        """Play what runs, so many pictures of it."""
        for loop in self.loops:
            for k in range(frames):
                if not loop.running:
                    break
                try:
                    if loop.work:
                        loop.work(k / loop.hz)
                    loop.running = loop.step(k / loop.hz) is not False
                except Exception as error:
                    loop.running = False
                    self.problem = error
                    loop.changed(error)
                self.settle()

    def save(self, functions: dict[str, Any]) -> None:
        """Have the file be another one, and the tab look at it."""
        self.student.functions = functions
        self.student.version += 1
        self.problem = None
        self.page.asking()
        self.begin()

    def begin(self) -> None:
        """Do at one moment what the page does when it was opened, and at a save."""
        for queue in self.queues:
            queue.waits = True
        self.tab.on_move(self.q)
        self.tab.begin()
        for queue in self.queues:
            queue.go()

    @property
    def seen(self) -> str:
        """What stands in the panel now."""
        return "".join(str(v) for k, v in dict(self.log).items() if "content" in k)

    @property
    def whose(self) -> tuple[str, str]:
        """What the line about the student's functions says, and its kind."""
        return self.page._own.says()


def same(one: Any, other: Any) -> bool:
    """Return whether two things that were shown are the same to the eye."""
    if isinstance(one, (tuple, list)):
        alike = isinstance(other, (tuple, list)) and len(one) == len(other)
        return alike and all(map(same, one, other))
    if isinstance(one, dict):
        return list(one) == list(other) and same([*one.values()], [*other.values()])
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        a, b = np.asarray(one), np.asarray(other)
        return a.shape == b.shape and np.allclose(a, b, 0.0, SEEN, equal_nan=True)
    if isinstance(one, str) and isinstance(other, str):
        return KINDS.sub("", one) == KINDS.sub("", other)
    if callable(one) or isinstance(one, Paper) or type(one).__module__ != "builtins":
        return True
    return one == other
