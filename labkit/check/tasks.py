"""From a student's file to one result per task."""

import contextlib
import secrets
import tokenize
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from labkit.base.exchange import Exchange, LoadError, Reply
from labkit.judge.ask import Asked, make_round, replies
from labkit.judge.judge import judge
from labkit.judge.mistake import Verdict
from labkit.judge.problems import no_answer, not_loaded, refusal
from labkit.judge.right_when import right_when
from labkit.judge.row import row_of
from labkit.lesson.day import Day, Task
from labkit.lesson.script import (
    arguments,
    borrowed_tasks,
    kits_functions,
    kits_own,
    old_names,
    renamed,
    unfinished,
)
from labkit.sandbox.messages import library_of, robots_of
from labkit.sandbox.sandbox import Sandbox

FRESH_ONLY = ("looked-up", "some-inputs")  # found by inputs that a seed draws


@dataclass(frozen=True)
class TaskResult:
    """How a task stands."""

    task: Task  # as in the manifest
    verdict: Verdict  # what the answers show
    printed: str = ""  # what its functions printed, for --explain
    # What the sandbox refused, also where the code went on without.
    refused: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether nothing is left to do."""
        return self.verdict.status == "passed"


def required_pass(results: list[TaskResult]) -> bool:
    """Return whether all tasks pass that are no side quest."""
    return all(result.passed for result in results if not result.task.optional)


def check_tasks(
    day: Day,
    script: Path,
    sandbox: Sandbox,
    only: str | None = None,
    seed: int | None = None,
) -> list[TaskResult]:
    """Check the tasks of a day.

    Args:
        day: from the manifest.
        script: the student's file.
        sandbox: where to run it.
        only: one task's id; where it is wrong, what it needs is asked as well.
        seed: of the fresh inputs, for a grade that can be repeated; it must not be
            known to the student.

    Returns:
        One result per task, in the manifest's order.

    Raises:
        Robo47Error: there is no such file or task, or a row of questions is missing.
    """
    wanted = [day.task(only)] if only else list(day.tasks)
    if why := _not_utf8(script) if script.is_file() else "":
        verdict = Verdict("todo", "does-not-load", why)
        return [TaskResult(task, verdict) for task in wanted]
    seed = secrets.randbits(32) if seed is None else seed
    check = _Check(day, script, sandbox, seed)
    try:
        results = check.first_look(wanted)
        if only:
            results |= check.below(results[wanted[0].id])
    except LoadError as error:
        verdict = Verdict("todo", "does-not-load", not_loaded(script, error.reply))
        return [TaskResult(task, verdict, error.reply.printed) for task in wanted]
    for task in wanted:
        with contextlib.suppress(LoadError):  # a file that loads only now and then
            results[task.id] = check.second_look(task, results)
    return [results[task.id] for task in wanted]


class _Check:
    """One check of a student's file."""

    def __init__(self, day: Day, script: Path, sandbox: Sandbox, seed: int) -> None:
        """Take what `check_tasks` takes."""
        self.day, self.script, self.sandbox, self.seed = day, script, sandbox, seed
        there = script.is_file()  # the sandbox refuses what is none
        self.source = script.read_text("utf-8", errors="replace") if there else ""
        self.borrowed = borrowed_tasks(day, self.source)
        self.renamed = old_names(day, self.source)
        self.added = self.renamed + kits_own(day, self.borrowed)

    def first_look(self, tasks: Sequence[Task]) -> dict[str, TaskResult]:
        """Return a result per task, by id.

        Raises:
            LoadError: the file does not load.
        """
        rounds = self._ask(tasks, self.added)
        results: dict[str, TaskResult] = {}
        for task in tasks:
            if task in self.borrowed:
                results[task.id] = TaskResult(task, _borrowed(task))
                continue
            found = self._result(task, rounds[task.id])
            results[task.id] = _following(found, self.day, results)
        return results

    def below(self, found: TaskResult) -> dict[str, TaskResult]:
        """Return results of the tasks that a wrong one builds on, and its own anew.

        Raises:
            LoadError: the file does not load any more.
        """
        needs = [self.day.task(need) for need in self.day.needs(found.task.id)]
        if not needs or found.verdict.status in ("passed", "todo"):
            return {}
        known = self.first_look(needs)
        return {**known, found.task.id: _following(found, self.day, known)}

    def second_look(self, task: Task, results: dict[str, TaskResult]) -> TaskResult:
        """Return a task's result with what further questions say of a wrong one.

        What builds on tasks that are not right is asked again with the kit's functions
        in their place: its fault is inherited, or its own.
        """
        result, added = results[task.id], self.added
        if result.verdict.follows:
            needed = [self.day.task(id) for id in self.day.needs(task.id)]
            broken = [one for one in needed if not results[one.id].passed]
            if kits := kits_functions(self.day, broken):
                added = self.renamed + kits
                again = self._result(task, self._ask([task], added)[task.id])
                if again.passed:
                    roots = [
                        one for one in broken if not results[one.id].verdict.follows
                    ]
                    return replace(result, verdict=_inherited(roots or broken))
                result = again
        if result.verdict.call:
            verdict = self._with_command(task, result.verdict)
            result = replace(result, verdict=verdict)
        if len(result.verdict.wrong_calls) < 3:
            return result
        return replace(result, verdict=self._with_experiments(task, result, added))

    def _with_command(self, task: Task, verdict: Verdict) -> Verdict:
        """Return a verdict with the command that gives it again on any machine."""
        says = f'The same again: make check TASK={task.id} ARGS="--seed {self.seed}"'
        verdict = replace(verdict, measured=(*verdict.measured, says))
        if verdict.mistake in FRESH_ONLY:
            verdict = replace(verdict, message=f"{verdict.message} {says}")
        return verdict

    def _with_experiments(self, task: Task, result: TaskResult, added: str) -> Verdict:
        """Return a verdict with the arguments that, neutral, make the answer right."""
        verdict = result.verdict
        rounds = rounds_of(self.day, [task], self.seed)[task.id]
        asked = next(one for one in rounds if one.function == verdict.function)
        robots = robots_of([exchange.question for exchange in asked.main])
        session = self.sandbox.session(
            self.script,
            robots,
            library_of(self.day),
            added,
            self.day.limits,
            brief=True,
        )
        with contextlib.closing(session):
            names = arguments(self.source, asked.function)
            says = right_when(asked, verdict.wrong_calls, names, session.ask)
        return replace(verdict, message=f"{verdict.message} {says}".strip())

    def _ask(self, tasks: Sequence[Task], added: str) -> dict[str, list[Asked]]:
        """Return the questions to some tasks' functions with their replies."""
        rounds = rounds_of(self.day, tasks, self.seed)
        self.sandbox.run(
            self.script,
            [exchange for some in rounds.values() for exchange in _exchanges(some)],
            library_of(self.day),
            {task.id: set(self.day.needs(task.id)) for task in tasks},
            added,
            self.day.limits,
        )
        return rounds

    def _result(self, task: Task, asked: Sequence[Asked]) -> TaskResult:
        """Return a task's verdict, what its functions printed and what was refused."""
        came = replies(_exchanges(asked))
        printed = next((reply.printed for reply in came if reply.printed), "")
        refused = tuple(dict.fromkeys(what for reply in came for what in reply.refused))
        return TaskResult(task, _verdict_of(task, asked, self.source), printed, refused)


def _inherited(broken: Sequence[Task]) -> Verdict:
    """Return the verdict on a task that only lacks those that it builds on."""
    *before, last = [task.id for task in broken]
    ids = f"{', '.join(before)} and {last} are" if before else f"{last} is"
    says = f"Right as soon as {ids}."
    return Verdict("todo", "inherited", says, follows=broken[0].id)


def _borrowed(task: Task) -> Verdict:
    """Return the verdict on a task whose function is the kit's."""
    says = "Borrowed from the kit; it counts when you write it yourself: "
    return Verdict("todo", "borrowed", f"{says}make start RESET={task.id}")


def _exchanges(asked: Sequence[Asked]) -> list[Exchange]:
    return [exchange for one in asked for exchange in one.exchanges]


def rounds_of(day: Day, tasks: Sequence[Task], seed: int) -> dict[str, list[Asked]]:
    """Return the questions to every function of some tasks, by task.

    Raises:
        Robo47Error: the day has no file of a function of the manifest.
    """
    return {
        task.id: [
            make_round(task.id, f, row_of(day, f).ask, seed) for f in task.functions
        ]
        for task in tasks
    }


def _following(
    found: TaskResult, day: Day, results: dict[str, TaskResult]
) -> TaskResult:
    """Return a result with the first task below it that has to be right first."""
    verdict = found.verdict
    if verdict.status in ("passed", "todo") or verdict.mistake == "missing":
        return found
    for need in day.needs(found.task.id):
        if need in results and not results[need].passed:
            return replace(found, verdict=replace(verdict, follows=need))
    return found


def _verdict_of(task: Task, asked: Sequence[Asked], source: str) -> Verdict:
    """Return a task's verdict: of several functions that of the first wrong one."""
    verdict = Verdict("passed")
    for one in asked:
        verdict = replace(_of_function(task, one, source), function=one.function)
        if len(asked) > 1 and verdict.message and not verdict.follows:
            verdict = replace(verdict, message=f"{one.function}: {verdict.message}")
        if verdict.status != "passed":
            break
    return verdict


def _of_function(task: Task, asked: Asked, source: str) -> Verdict:
    function = asked.function
    for reply in replies([*asked.main, *asked.fresh]):
        if early := no_answer(reply, function, task.id):
            slip = early.mistake == "unwritten" and unfinished(source, function)
            if early.mistake == "missing" and (near := renamed(source, function)):
                return replace(early, message=near)
            return Verdict("todo", "raise-left-in", slip) if slip else early
    verdict = judge(asked, source, arguments(source, function))
    came = replies(asked.exchanges)
    if verdict.mistake == "nothing-returned":
        verdict = _nothing_returned(function, came, source, verdict)
    if verdict.status != "passed":
        refused = [what for reply in came for what in reply.refused]
        if refused:
            return refusal(refused[0], None)
    return _changed_arguments(function, came, verdict)


def _not_utf8(script: Path) -> str:
    """Return one line on a file that Python cannot read as text, or ""."""
    try:
        with tokenize.open(script) as file:
            file.read()
    except (SyntaxError, LookupError, UnicodeError):  # of "coding: rot13"
        return f"{script.name} is not in UTF-8. Save it as UTF-8 in your editor."
    return ""


def _nothing_returned(
    function: str, came: Sequence[Reply], source: str, verdict: Verdict
) -> Verdict:
    if slip := unfinished(source, function):
        return replace(verdict, message=slip)
    if any(reply.printed for reply in came):
        says = f"{verdict.message} Does it print the result instead of returning it?"
        return replace(verdict, message=says)
    return verdict


def _changed_arguments(
    function: str, came: Sequence[Reply], verdict: Verdict
) -> Verdict:
    """Return the verdict with the arguments that the function left changed."""
    changed = [name for reply in came for name in reply.changed]
    if not changed or verdict.status == "todo":
        return verdict
    name = changed[0]
    if verdict.mistake == "shares-its-argument":  # a copy at the end would not help
        says = f"{function} works in its argument {name} itself and returns it, so its "
        says += f"caller's numbers change. Begin with a copy: {name} = {name}.copy()"
        return replace(verdict, message=f"{says}.")
    says = f"{function} changed its argument {name}, which its caller still needs"
    says += f"; work on a copy: {name} = {name}.copy()" if name.isidentifier() else ""
    if verdict.status != "passed":
        return replace(verdict, message=f"{verdict.message} Besides, {says}.")
    says = f"The numbers are right, but {says}."
    return Verdict("wrong", "argument-changed", says, verdict.measured)
