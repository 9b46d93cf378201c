"""`make check` in the background: its verdicts on the student's tasks."""

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

LEAVE_SECONDS = 5.0  # a check takes one or two


@dataclass(frozen=True)
class TaskState:
    """How one task stands, as the checker says it."""

    id: str
    title: str
    status: str
    message: str
    mistake: str = ""


@dataclass(frozen=True)
class Standing:
    """How the day's tasks stand.

    Attributes:
        headline: one line about all of them.
        kind: "good", "bad" or "quiet".
        tasks: in the day's order; () where nothing is known.
    """

    headline: str
    kind: str = "quiet"
    tasks: tuple[TaskState, ...] = ()


def standing(tasks: Sequence[TaskState]) -> Standing:
    """Return the tasks with one line about all of them.

    Args:
        tasks: in the day's order.
    """
    if tasks and tasks[0].mistake == "does-not-load":  # one reason, for all of them
        says = f"make check: {tasks[0].message}"
        return Standing(says, "bad", tuple(replace(t, message="") for t in tasks))
    passed = sum(task.status == "passed" for task in tasks)
    says = f"make check: {passed} of {len(tasks)} tasks pass"
    if passed == len(tasks):
        return Standing(f"✓ {says}", "good", tuple(tasks))
    wrong = [t for t in tasks if t.status not in ("passed", "todo")]
    if not wrong:
        first = next(t for t in tasks if t.status != "passed")
        return Standing(
            f"{says}; next is {first.id} {first.title}", "quiet", tuple(tasks)
        )
    return Standing(f"✗ {says}. {wrong[0].id}: {wrong[0].message}", "bad", tuple(tasks))


class Checks:
    """Runs the checker in a thread; of several saves the last one counts."""

    def __init__(
        self,
        check: Callable[[], Sequence[TaskState]],
        deliver: Callable[[Standing], None],
    ) -> None:
        """Take the checker and who is told; no thread runs yet.

        Args:
            check: asks the checker; takes a second or two.
            deliver: is given how the tasks stand, on the thread.
        """
        self.check, self.deliver = check, deliver
        self.wanted = threading.Event()
        self.ended = False
        self.thread: threading.Thread | None = None

    def again(self) -> None:
        """Check as soon as the check that runs is done."""
        self.wanted.set()
        if self.thread is None:
            self.thread = threading.Thread(target=self._run, daemon=True, name="checks")
            self.thread.start()

    def close(self) -> None:
        """End it once the check that runs is done: Python must not end before."""
        self.ended = True
        self.wanted.set()
        if self.thread is not None:
            self.thread.join(LEAVE_SECONDS)

    def _run(self) -> None:
        while self.wanted.wait() and not self.ended:
            self.wanted.clear()
            try:
                found = standing(self.check())
            except Exception as error:  # the page goes on, whatever the file is like
                found = Standing(f"make check: {error}", "bad")
            if not self.wanted.is_set():
                self.deliver(found)
