"""The student's functions of all days, each day's file in a sandbox process of its own.

As `robo47.mine`, which loads the files into the process that asks: here nothing of the
student's leaves the sandbox. What `make check` does not pass is the library's.
"""

import contextlib
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from types import SimpleNamespace
from typing import Any

from labkit.base.exchange import LoadError, Question
from labkit.check.own_functions import statuses
from labkit.inspector.own import NoAnswerError
from labkit.lesson.day import all_days
from labkit.sandbox.library import library_of
from labkit.sandbox.sandbox import Sandbox, Session


@contextlib.contextmanager
def week(library: Mapping[str, Callable[..., Any]]) -> Iterator[SimpleNamespace]:
    """Yield functions by name, the student's where they pass; `yours` counts them.

    Args:
        library: the functions that are wanted, by name.
    """
    fns = SimpleNamespace(**library)
    fns.yours, fns.total = 0, len(library)
    with Sandbox() as sandbox:
        for day in all_days():
            why = statuses(day)
            passed = [
                name
                for task in day.tasks
                for name in task.functions
                if why[task.id] == "passed" and name in library
            ]
            if not passed:
                continue
            with contextlib.suppress(LoadError):
                session = sandbox.session(day.work, [], library_of(day))
                own = {name: partial(_ask, session, name) for name in passed}
                vars(fns).update(own)
                fns.yours += len(own)
        yield fns


def _ask(session: Session, name: str, *args: Any) -> Any:
    """Return what a function returns.

    Raises:
        NoAnswerError: it returned nothing.
    """
    (reply,) = session.ask([Question("view", name, args)])
    if reply.kind:
        raise NoAnswerError(f"YOUR {name}: {reply.kind} {reply.error}")
    return reply.value
