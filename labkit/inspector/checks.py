"""`make check` in the background: its verdicts on the student's tasks."""

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from labkit.check.tasks import TaskResult
from labkit.judge.mistake import Verdict

LEAVE_SECONDS = 5.0  # a check takes one or two


@dataclass(frozen=True)
class Standing:
    """How the day's tasks stand."""

    headline: str  # about all of them
    kind: str = "quiet"  # or "good" or "bad"
    tasks: tuple[TaskResult, ...] = ()  # in the day's order; () while nothing is known


def standing(results: Sequence[TaskResult]) -> Standing:
    """Return the tasks, in the day's order, with one line about all of them."""
    first = results[0].verdict if results else Verdict("passed")
    if first.mistake == "does-not-load":  # one reason, for all of them
        todo = Verdict(first.status)
        bare = tuple(replace(result, verdict=todo) for result in results)
        return Standing(f"make check: {first.message}", "bad", bare)
    passed = sum(result.passed for result in results)
    says = f"make check: {passed} of {len(results)} tasks pass"
    if passed == len(results):
        return Standing(f"✓ {says}", "good", tuple(results))
    wrong = [r for r in results if r.verdict.status not in ("passed", "todo")]
    if not wrong:
        after = next(r.task for r in results if not r.passed)
        says = f"{says}; next is {after.id} {after.title}"
        return Standing(says, "quiet", tuple(results))
    why = f"{wrong[0].task.id}: {wrong[0].verdict.message}"
    return Standing(f"✗ {says}. {why}", "bad", tuple(results))


class Checks:
    """Runs the checker in a thread; of several saves the last one counts."""

    def __init__(
        self,
        check: Callable[[], Sequence[TaskResult]],
        deliver: Callable[[Standing], None],
    ) -> None:
        """Take the checker and who is told, on the thread; nothing is checked yet."""
        self.check, self.deliver = check, deliver
        self.wanted = threading.Event()
        self.ended = False
        self.thread = threading.Thread(target=self._run, daemon=True, name="checks")
        self.thread.start()

    def again(self) -> None:
        """Check as soon as the check that runs is done."""
        self.wanted.set()

    def close(self) -> None:
        """End it once the check that runs is done: Python must not end before."""
        self.ended = True
        self.wanted.set()
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
