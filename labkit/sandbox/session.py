"""A student's file that stays loaded, for a page that asks it many times a second."""

from collections.abc import Sequence

from labkit.judge.exchange import Question, Reply, stopped
from labkit.sandbox.messages import pack
from labkit.sandbox.process import EndedError, Process
from robo47.errors import FaultError

CALL_SECONDS = 3.0


class Session:
    """A student's loaded file that answers again and again, until it hangs."""

    def __init__(self, process: Process) -> None:
        """Take a process that has loaded the file."""
        self._process = process
        self._ended: Reply | None = None

    @property
    def alive(self) -> bool:
        """Whether it still answers; where not, open another session."""
        return self._ended is None

    def ask(
        self, questions: Sequence[Question], seconds: float = CALL_SECONDS
    ) -> list[Reply]:
        """Ask each question once.

        Args:
            questions: what to call.
            seconds: for one call. Whoever takes longer ends the session.

        Returns:
            One reply per question; "stopped" from where the session ended.
        """
        replies: list[Reply] = []
        if self._ended is None:
            self._process.ask(map(pack, questions))
        while len(replies) < len(questions) and self._ended is None:
            try:
                replies.append(self._process.next(seconds))
            except (EndedError, FaultError) as error:
                self._ended = stopped(str(error))
                self._process.close()
        missing = len(questions) - len(replies)
        return replies + [self._ended] * missing if self._ended else replies

    def close(self) -> None:
        """End it."""
        if self._ended is None:
            self._ended = Reply(error="the session was closed", kind="stopped")
            self._process.close()
