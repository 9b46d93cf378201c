"""How the tasks of a day stand, as the card over the scene says it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from labkit.check.tasks import TaskResult
from labkit.judge.mistake import Verdict


@dataclass(frozen=True)
class Standing:
    """How the day's tasks stand."""

    sentence: str  # the verdict; "" where there is no file
    kind: str = "quiet"  # or "good" or "bad"
    # in the day's order; () before the first verdict
    tasks: tuple[TaskResult, ...] = ()
    title: str = "make check"  # the task and the function that the sentence is about
    count: str = ""  # such as "4 of 8 pass"


ASKING = Standing("asking your functions ...", "asking")


def standing(results: Sequence[TaskResult], task: str = "") -> Standing:
    """Return the tasks, in the day's order, and the first verdict to act on.

    Args:
        results: of all tasks.
        task: the id of the one that comes first while it is wrong.
    """
    first = results[0].verdict if results else Verdict("passed")
    if first.mistake == "does-not-load":  # one reason, for all of them
        todo = Verdict(first.status)
        bare = tuple(replace(result, verdict=todo) for result in results)
        return Standing(first.message, "bad", bare)
    tasks, passed = tuple(results), sum(result.passed for result in results)
    count = f"{passed} of {len(results)} pass"
    if passed == len(results):
        return Standing("All tasks pass.", "good", tasks, count=count)
    wrong = [r for r in results if r.verdict.status not in ("passed", "todo")]
    if not wrong:
        after = next(r for r in results if not r.passed)
        title = f"Next: {named(after)}"
        return Standing(after.task.title, "quiet", tasks, title, count)
    chosen = next((r for r in wrong if r.task.id == task), wrong[0])
    return Standing(chosen.verdict.message, "bad", tasks, named(chosen), count)


def named(result: TaskResult) -> str:
    """Return "5.1 pd_torque": the task and the function that was judged."""
    names = result.verdict.function or ", ".join(result.task.functions)
    return f"{result.task.id} {names}"
