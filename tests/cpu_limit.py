"""A limit of the processor's time, for calls that may never end."""

import contextlib
import signal
from collections.abc import Iterator


@contextlib.contextmanager
def ended_late(seconds: float) -> Iterator[None]:
    """End a call that takes too long, as the sandbox does: a wrong loop may be endless.

    Not by `sys.settrace`: CPython 3.11 sometimes never returns from a traced call that
    raised.

    Args:
        seconds: of this process on the processor. The signal comes again after each
            such time, in case the call catches its exception.

    Raises:
        TimeoutError: it has.
    """

    def end(*_: object) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGVTALRM, end)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
