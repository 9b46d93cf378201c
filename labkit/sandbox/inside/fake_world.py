"""Worlds that answer questions and show no numbers, since they have none.

A world stays with the checker. What a function gets in its place sends each question
there and waits for the answer, so nothing in this process leads to a number of it.
"""

from collections import deque
from collections.abc import Callable, Iterator
from typing import Any, BinaryIO

import wire

POINTS = "edge_free(a, b) takes two points of this world, (k,) each"
NAMES = ("Room", "Yard", "Shelf")  # a class of its own for every question in turn


class Questions:
    """The lines from the checker: questions in order, and answers about a world."""

    def __init__(self, asked: BinaryIO, loads: Callable[..., Any]) -> None:
        """Take where the lines come from, and what reads one."""
        self._asked, self._loads = asked, loads
        self._waiting: deque[Any] = deque()  # questions that came before an answer

    def __iter__(self) -> Iterator[Any]:
        """Return the questions one after the other, until the lines end."""
        while True:
            if not self._waiting:
                if not (line := self._asked.readline()):
                    return
                self._waiting.append(self._loads(line))
            yield self._waiting.popleft()

    def answer(self) -> Any:
        """Return the next answer about a world; questions before it have to wait."""
        while line := self._asked.readline():
            told = self._loads(line)
            if "free" in told:
                return told["free"]
            self._waiting.append(told)
        raise EOFError("the checker has ended")


def stand_in(number: int, send: Callable[..., None], questions: Questions) -> Any:
    """Return what stands for the checker's world of that number.

    Args:
        number: the place of the world among those that the checker keeps.
        send: writes a message to the checker.
        questions: brings the answer.
    """

    def edge_free(world: Any, a: Any, b: Any) -> bool:
        """Return whether the straight edge from a to b, (k,) each, is free."""
        try:
            ends = wire.pack_value(a), wire.pack_value(b)
        except wire.UnsendableError:
            raise TypeError(POINTS) from None
        send(asks=[number, *ends])
        if (told := questions.answer()) is None:
            raise ValueError(POINTS)
        return bool(told)

    def seen(world: Any) -> str:
        return "a world with its own edge_free(a, b)"

    methods = {"edge_free": edge_free, "__repr__": seen, "__slots__": ()}
    return type(NAMES[number % len(NAMES)], (), methods)()
