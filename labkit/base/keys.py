"""Single keys from a terminal, without Enter, on Linux, macOS and Windows.

    with Keys() as keys:
        keys.wait(0.3)      "h", or "" where none was pressed in time

Where there is no terminal (a pipe, a log) no key ever comes, and waiting still waits.
"""

import contextlib
import os
import select
import sys
import time
from collections.abc import Iterator
from typing import Any

LOOK = 0.05  # seconds between two looks, where the system cannot wait for a key


class Keys:
    """Keys as they are pressed, for as long as it is entered.

    Attributes:
        there: whether somebody can press any.
    """

    def __init__(self) -> None:
        """Find out whether there is a keyboard; nothing is changed yet."""
        self.there = sys.stdin is not None and sys.stdin.isatty()
        self._was: list[Any] | None = None

    def __enter__(self) -> "Keys":
        """Have keys come one by one; Ctrl-C still interrupts."""
        if self.there and os.name != "nt":
            import termios
            import tty

            try:
                self._was = termios.tcgetattr(sys.stdin)
                tty.setcbreak(sys.stdin.fileno())
            except termios.error:  # a terminal that takes no settings
                self.there = False
        return self

    def __exit__(self, *_: object) -> None:
        """Give the terminal back as it was."""
        if self._was is not None:
            import termios

            termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self._was)
            self._was = None

    @contextlib.contextmanager
    def away(self) -> Iterator[None]:
        """Give the terminal to another program for a while."""
        entered = self._was is not None
        self.__exit__()
        try:
            yield
        finally:
            if entered:
                self.__enter__()

    def wait(self, seconds: float) -> str:
        """Return the key pressed within some seconds, in small letters, or ""."""
        if not self.there:
            time.sleep(seconds)
            return ""
        if os.name == "nt":
            return self._windows(seconds)
        ready, _, _ = select.select([sys.stdin], [], [], seconds)
        if not ready:
            return ""
        pressed = os.read(sys.stdin.fileno(), 32).decode("utf-8", "replace")
        if not pressed:  # the terminal has gone
            self.there = False
        return pressed[:1].lower() if len(pressed) == 1 else ""  # arrows are several

    def _windows(self, seconds: float) -> str:
        import msvcrt

        until = time.monotonic() + seconds
        while time.monotonic() < until:
            if msvcrt.kbhit():  # type: ignore[attr-defined, unused-ignore]
                pressed = msvcrt.getwch()  # type: ignore[attr-defined, unused-ignore]
                if pressed == "\x03":
                    raise KeyboardInterrupt
                return pressed.lower() if pressed.isprintable() else ""
            time.sleep(LOOK)
        return ""
