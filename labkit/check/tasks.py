"""Checks a student's file: one result per task."""

import contextlib
import re
import secrets
import tokenize
from collections.abc import Sequence, Set
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from pathlib import Path

from labkit.base.deadline import Deadline
from labkit.base.exchange import Exchange, LoadError, Reply
from labkit.check.slow import too_slow
from labkit.judge.answers import Several, as_clause, capitalised
from labkit.judge.ask import Asked, asked_of, replies
from labkit.judge.cases import in_cases
from labkit.judge.guard import attempt, noting, quiet
from labkit.judge.judge import judge, unjudged
from labkit.judge.mistake import ADD_UP, Verdict
from labkit.judge.near_miss import WHY
from labkit.judge.repair import Changes, changes_of, mends, repaired
from labkit.judge.replies_read import no_answer, not_loaded, refusal
from labkit.judge.right_when import right_when
from labkit.judge.row import inside, row_of
from labkit.lesson.added_code import kits_functions, kits_own, old_names
from labkit.lesson.borrowed import borrowed_tasks
from labkit.lesson.day import Day, Task
from labkit.lesson.slips import arguments, renamed, twice, unfinished
from labkit.lesson.starter import function_lines
from labkit.lesson.untrusted_files import SCRIPT
from labkit.sandbox.messages import library_of, robots_of
from labkit.sandbox.sandbox import Sandbox, Session, deadline_of

# Changes of which the one back is a change as well, so that a quoted line is tried.
CHANGED_BACK = {
    f"slip-{kind}" for kind in ("name", "index", "sign", "negated", "order")
}
QUOTED = re.compile(
    r" The wrong line is line (\d+)(?:: `[^`]*`)?(?:, or one that uses `\w+`)?\."
)
FRESH_ONLY = ("looked-up", "some-inputs")  # found by inputs that a seed draws


@dataclass(frozen=True)
class TaskResult:
    """The result of a task."""

    task: Task  # the task, read from the manifest
    verdict: Verdict  # the verdict on the answers
    printed: str = ""  # the output of its functions, for --explain
    # Everything that the sandbox refused, also if the code went on without it.
    refused: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Nothing is left to do."""
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
    deadline: Deadline | None = None,
) -> list[TaskResult]:
    """Check the tasks of a day.

    Args:
        day: from the manifest.
        script: the student's file.
        sandbox: where to run it.
        only: one task's id; where it is wrong, what it needs is asked as well.
        seed: of the fresh inputs, for a grade that can be repeated; it must not be
            known to the student.
        deadline: of the submission, second looks included; None is a new one.

    Returns:
        One result per task, in the manifest's order.

    Raises:
        Robo47Error: there is no such file or task, or a row of questions is missing.
    """
    wanted = [day.task(only)] if only else list(day.tasks)
    if why := _not_utf8(script) if _is_script(script) else "":
        verdict = Verdict("todo", "does-not-load", why)
        return [TaskResult(task, verdict) for task in wanted]
    seed = secrets.randbits(32) if seed is None else seed
    check = _Check(day, script, sandbox, seed, deadline or deadline_of(day))
    try:
        results = check.ask(wanted)
        first = results[wanted[0].id].verdict  # one that waits, too, has a need
        if only and (first.follows or first.status not in ("passed", "todo")):
            results |= check.ask([day.task(id) for id in day.needs(wanted[0].id)])
    except LoadError as error:
        verdict = Verdict("todo", "does-not-load", not_loaded(script, error.reply))
        return [TaskResult(task, verdict, error.reply.printed) for task in wanted]
    results = {id: _following(one, day, results) for id, one in results.items()}
    for task in wanted:
        with contextlib.suppress(LoadError):  # a file that loads only now and then
            was = results[task.id]
            results[task.id] = attempt(check.second_look, task, results, otherwise=was)
    return [results[task.id] for task in wanted]


class _Check:
    """One check of a student's file."""

    def __init__(
        self, day: Day, script: Path, sandbox: Sandbox, seed: int, deadline: Deadline
    ) -> None:
        """Take what `check_tasks` takes."""
        self.day = day
        self.script = script
        self.sandbox = sandbox
        self.seed = seed
        self.deadline = deadline
        there = _is_script(script)
        self.source = script.read_text("utf-8", errors="replace") if there else ""
        self.borrowed = borrowed_tasks(day, self.source)
        self.renamed = old_names(day, self.source)
        self.added = self.renamed + kits_own(day, self.borrowed)
        self.asked: dict[str, list[Asked]] = {}  # the latest questions of each task

    def ask(
        self, tasks: Sequence[Task], added: str | None = None
    ) -> dict[str, TaskResult]:
        """Return a result per task, by id; `added` is code below the file.

        Raises:
            LoadError: the file does not load.
            Robo47Error: the day has no file of a function of the manifest.
        """
        for task in tasks:
            rows = [(name, row_of(self.day, name).ask) for name in task.functions]
            each = task.seconds / len(rows)
            asked = [asked_of(task.id, *row, self.seed, each) for row in rows]
            self.asked[task.id] = asked
        if tasks:
            self.sandbox.run(
                self.script,
                [e for task in tasks for e in _exchanges(self.asked[task.id])],
                library_of(self.day),
                {task.id: self.day.needs(task.id) for task in tasks},
                self.added if added is None else added,
                self.day.limits,
                self.deadline,
            )
        return {task.id: self._result(task) for task in tasks}

    def _result(self, task: Task) -> TaskResult:
        """Return a task's verdict, what its functions printed and what was refused."""
        if task in self.borrowed:
            says = "Borrowed from the kit; it counts when you write it yourself: "
            says += f"make start RESET={task.id}"
            return TaskResult(task, Verdict("todo", "borrowed", says))
        asked = self.asked[task.id]
        came = replies(_exchanges(asked))
        printed = next((reply.printed for reply in came if reply.printed), "")
        refused = tuple(dict.fromkeys(what for reply in came for what in reply.refused))
        verdict = _verdict_of(self.day, task, asked, self.source)
        return TaskResult(task, verdict, printed, refused)

    def second_look(self, task: Task, results: dict[str, TaskResult]) -> TaskResult:
        """Return a task's result with what further questions say of a wrong one.

        What builds on tasks that are not right is asked again with the kit's functions
        in their place: its fault is inherited, or its own.
        """
        result = results[task.id]
        added = self.added
        if result.verdict.follows and not self.deadline.over:
            needed = [self.day.task(id) for id in self.day.needs(task.id)]
            broken = [one for one in needed if not results[one.id].passed]
            if kits := kits_functions(self.day, broken):
                added = self.renamed + kits
                again = self.ask([task], added)[task.id]
                if again.passed:
                    follow = [o for o in broken if not results[o.id].verdict.follows]
                    return replace(result, verdict=_inherited(follow or broken))
                result = result if self.deadline.over else again
        verdict = result.verdict
        if verdict.call:
            typed = f'make check TASK={task.id} ARGS="--seed {self.seed}"'
            says = f"The same again: {typed}"
            verdict = replace(verdict, measured=(*verdict.measured, says))
            if verdict.mistake in FRESH_ONLY:
                verdict = replace(verdict, message=f"{verdict.message} {says}")
        if (verdict.wrong_calls or verdict.by_output) and not self.deadline.over:
            verdict = self._with_experiments(task, verdict, added)
        elif verdict.mistake in CHANGED_BACK and not self.deadline.over:
            verdict = self._with_its_line_tried(task, verdict, added)
        return replace(result, verdict=verdict)

    def _with_experiments(self, task: Task, verdict: Verdict, added: str) -> Verdict:
        """Return a verdict with the line that is wrong, or where the rest is right."""
        asked, changes = self._asked_and_changes(task, verdict)
        if verdict.mistake == "one-factor-off":
            changes = None  # any of its factors mends that
        line = says = ""
        with quiet():
            below = added + (changes.code if changes else "")
            with contextlib.closing(self._session(asked, below)) as session:
                if changes:
                    given = asked, self.source, changes, session
                    line = repaired(*given, named=verdict.by_output)
                hung = not session.alive
                if not line and not hung:
                    says = self._where_right(asked, verdict, session)
            if hung:  # in a change
                with contextlib.closing(self._session(asked, added)) as session:
                    says = self._where_right(asked, verdict, session)
        if line and ADD_UP in verdict.message:  # one change in place of two mistakes
            return replace(verdict, mistake="one-line", message=line)
        known = verdict.message.replace(WHY, "") if line else verdict.message
        return replace(verdict, message=f"{known} {line or says}".strip())

    def _asked_and_changes(
        self, task: Task, verdict: Verdict
    ) -> tuple[Asked, Changes | None]:
        """Return what a wrong function was asked, and the changes of its text."""
        all_asked = self.asked[task.id]
        asked = next(one for one in all_asked if one.function == verdict.function)
        judged = {name for one in self.day.tasks for name in one.functions}
        return asked, changes_of(self.source, asked.function, judged)

    def _with_its_line_tried(self, task: Task, verdict: Verdict, added: str) -> Verdict:
        """Return a verdict without the line that it quotes if no change there mends."""
        quoted = QUOTED.search(verdict.message)
        asked, changes = self._asked_and_changes(task, verdict)
        if quoted is None or changes is None:
            return verdict
        with (
            quiet(),
            contextlib.closing(self._session(asked, added + changes.code)) as session,
        ):
            tried = mends(asked, changes, session, int(quoted[1]))
            if tried or not session.alive:
                return verdict
        return replace(verdict, message=verdict.message.replace(quoted[0], ""))

    def _where_right(self, asked: Asked, verdict: Verdict, session: Session) -> str:
        """Return in which cases, or for which arguments, a function is right; or ""."""
        if verdict.by_output:
            return ""
        names = arguments(self.source, asked.function)
        return in_cases(asked, session.ask) or right_when(
            asked, verdict.wrong_calls, names, session.ask
        )

    def _session(self, asked: Asked, added: str) -> Session:
        """Return the student's file with some code below it, to be asked more."""
        return self.sandbox.session(
            self.script,
            robots_of([exchange.question for exchange in asked.main]),
            library_of(self.day),
            added,
            self.day.limits,
            brief=True,
            deadline=self.deadline,
        )


def _exchanges(asked: Sequence[Asked]) -> list[Exchange]:
    return [exchange for one in asked for exchange in one.exchanges]


def _inherited(broken: Sequence[Task]) -> Verdict:
    """Return the verdict on a task that only lacks those that it builds on."""
    *before, last = [task.id for task in broken]
    ids = f"tasks {', '.join(before)} and {last} are" if before else f"task {last} is"
    says = f"This task will be correct as soon as {ids} correct."
    return Verdict("todo", "inherited", says, follows=broken[0].id)


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


def _verdict_of(day: Day, task: Task, asked: Sequence[Asked], source: str) -> Verdict:
    """Return a task's verdict: of several functions that of the first wrong one."""
    verdict = Verdict("passed")
    for one in asked:
        verdict = replace(_guarded(day, task, one, source), function=one.function)
        if len(asked) > 1 and verdict.message and not verdict.follows:
            clause = as_clause(verdict.message)
            says = capitalised(inside(f"in `{one.function}`, ", clause))
            if verdict.status == "todo":
                says = f"{one.function}: {verdict.message}"
            verdict = replace(verdict, message=says)
        if verdict.status != "passed":
            break
    return verdict


def _guarded(day: Day, task: Task, asked: Asked, source: str) -> Verdict:
    """Return a function's verdict, also where the checker has none: that it failed."""
    with noting() as stopped:
        found = attempt(_of_function, day, task, asked, source)
        return found or unjudged(stopped)


def _of_function(day: Day, task: Task, asked: Asked, source: str) -> Verdict:
    function = asked.function
    unanswered = partial(_unanswered, day, task, asked, source)
    if early := unanswered([*asked.main, *asked.fresh]):
        return early
    verdict = judge(asked, source, arguments(source, function))
    came = replies(asked.exchanges)
    if verdict.mistake in {held.slug for held in asked.ask.held_out}:
        # A function that is stopped there made no such mistake.
        further = chain(*asked.held_out)
        stopped = [one for one in further if one.reply and one.reply.kind == "stopped"]
        verdict = unanswered(stopped) or verdict
    if verdict.mistake == "nothing-returned":
        says = unfinished(source, function)
        if not says and any(reply.printed for reply in came):
            ask = "Does it print the result instead of returning it?"
            says = f"{verdict.message} {ask}"
        verdict = replace(verdict, message=says or verdict.message)
    if verdict.status != "passed":
        refused = [what for reply in came for what in reply.refused]
        if refused:
            return refusal(refused[0], None)
        if says := twice(source, function):
            verdict = replace(verdict, message=f"{verdict.message} {says}")
    names = arguments(source, function)
    pairs = zip(names, asked.main[0].question.args, strict=False)
    tuples = {name for name, arg in pairs if isinstance(arg, Several)}
    return _changed_arguments(came, verdict, tuples)


def _unanswered(
    day: Day, task: Task, asked: Asked, source: str, exchanges: Sequence[Exchange]
) -> Verdict | None:
    """Return the verdict on the first of some questions that has no answer, or None."""
    function = asked.function
    for one, reply in zip(exchanges, replies(exchanges), strict=True):
        if reply.given:
            slow = too_slow(day, function, one.question.args, reply)
            return _with_slip(asked, slow, source)
        if early := no_answer(reply, function, task.id):
            if early.mistake == "unwritten" and (says := twice(source, function)):
                return Verdict("todo", "defined-twice", says)
            slip = early.mistake == "unwritten" and unfinished(source, function)
            if early.mistake == "missing" and (near := renamed(source, function)):
                return replace(early, message=near)
            return Verdict("todo", "raise-left-in", slip) if slip else early
    return None


def _with_slip(asked: Asked, verdict: Verdict, source: str) -> Verdict:
    """Return a verdict on an endless call, with what the row says of such loops."""
    if verdict.mistake != "stopped":
        return verdict
    code = "\n".join(function_lines(source, asked.function)[2])
    for slip in asked.ask.slips:
        if re.search(slip.error, "stopped") and re.search(slip.source, code):
            return replace(
                verdict, mistake=slip.slug, message=f"{verdict.message} {slip.says}"
            )
    return verdict


def _is_script(script: Path) -> bool:
    """Return whether a file is one that is read here; the sandbox refuses any other."""
    return script.is_file() and script.stat().st_size <= SCRIPT


def _not_utf8(script: Path) -> str:
    """Return one line on a file that Python cannot read as text, or ""."""
    try:
        with tokenize.open(script) as file:
            file.read()
    # A line such as "coding: rot13" causes a LookupError.
    except (SyntaxError, LookupError, UnicodeError):
        return f"{script.name} is not in UTF-8. Save it as UTF-8 in your editor."
    return ""


def _changed_arguments(
    came: Sequence[Reply],
    verdict: Verdict,
    tuples: Set[str] = frozenset(),
) -> Verdict:
    """Return the verdict with the arguments that the function left changed.

    Args:
        came: the function's replies.
        verdict: what is said of its answers.
        tuples: the names of the arguments that are tuples of arrays.
    """
    changed = [name for reply in came for name in reply.changed]
    if not changed or verdict.status == "todo":
        return verdict
    name = changed[0]
    copied = f"`{name} = {name}.copy()`"
    if name in tuples:
        copied = f"`{name} = tuple(one.copy() for one in {name})`"
    if verdict.mistake == "shares-its-argument":  # a copy at the end would not help
        says = f"Your code changes its argument `{name}` and returns it, so the array "
        says += f"of the caller changes too. Begin with a copy: {copied}."
        return replace(verdict, message=says)
    says = f"your code changes its argument `{name}`, which the caller still needs."
    says += f" Work on a copy: {copied}." if name.isidentifier() else ""
    if verdict.status != "passed":
        return replace(verdict, message=f"{verdict.message} In addition, {says}")
    says = f"The numbers are correct, but {says}"
    return Verdict("wrong", "argument-changed", says, verdict.measured)
