"""Run a student's functions in a process of their own and bring back plain arrays.

The process works on a temporary copy, in a clean environment, without the repository
on its import path, within limits of time and memory; `inside/` says what else it may
not do. Replies come on a private channel, each behind a secret made for that run. A
function that hangs or ends the interpreter costs its own task only: the rest is asked
again in a fresh process.
"""

import contextlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from robo47.checker.process import Process, closed_folders
from robo47.checker.replies import Question, Reply, pack


class Sandbox:
    """Processes for one student's file after the other; the next is always warm."""

    def __init__(self) -> None:
        """Start the first process, so that it loads while the caller prepares."""
        self._warm: Process | None = Process()

    def __enter__(self) -> "Sandbox":
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """End what is left."""
        if self._warm:
            self._warm.close()

    def run(
        self,
        script: Path,
        questions: Sequence[Question],
        models: Sequence[dict[str, Any]],
        facts: dict[str, Any],
        noted: Sequence[str] = (),
    ) -> list[Reply]:
        """Ask a student's file.

        Args:
            script: the file; the other `.py` files beside it may be imported by it.
            questions: what to call.
            models: as `model_copy.copy_model` makes them, by `Model.index`.
            facts: `model_copy.facts()`.
            noted: functions of NumPy whose use goes into `Reply.used`.

        Returns:
            One reply per question.

        Raises:
            LoadError: the file does not load.
            Robo47Error: there is no such file, or it is no script.
        """
        replies: dict[int, Reply] = {}
        base = {
            "models": list(models),
            "facts": facts,
            "noted": list(noted),
            "closed": closed_folders(),
        }
        while left := [i for i in range(len(questions)) if i not in replies]:
            process, self._warm = self._warm or Process(), None
            with contextlib.closing(process):
                copy = process.copy(script)
                calls = [pack(questions[i]) for i in left]
                request = {**base, "file": str(copy), "calls": calls}
                got, stopped = process.converse(request)
            replies.update({left[i]: reply for i, reply in got.items()})
            if stopped:
                culprit = questions[left[len(got)]].task
                for i in left:
                    if i not in replies and questions[i].task == culprit:
                        replies[i] = stopped
        return [replies[i] for i in range(len(questions))]
