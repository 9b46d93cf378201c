"""A mistake that has a name: what to say, and the same mistake made on purpose."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

from robo47.checks import Array


@dataclass(frozen=True)
class Mistake:
    """One way to be wrong. It is claimed only where redoing it gives the answer.

    Attributes:
        slug: its name, "chain-reversed".
        says: for the student: a clause without capital and full stop, so that it can
            follow "In the links' factors, ".
        redo: the function with the mistake in it. It takes all calls' arguments
            stacked, one array (n, ...) per argument, and returns (n, ...).
        redone: what to call that answer, as in "it differs from its transpose by 0".
    """

    slug: str
    says: str
    redo: Callable[..., Array]
    redone: str = "ours with this mistake"


def lifted(
    mistakes: Iterable[Mistake],
    where: str,
    into: Callable[[Callable[..., Array]], Callable[..., Array]],
) -> list[Mistake]:
    """Return the mistakes of a small function as mistakes of one that uses it.

    Args:
        mistakes: of the small function.
        where: what to say first, such as "in the links' factors, ".
        into: takes the mistaken small function, returns the larger one made with it.
    """
    return [replace(m, says=f"{where}{m.says}", redo=into(m.redo)) for m in mistakes]


def applied(mistakes: Iterable[Mistake], right: Callable[..., Array]) -> list[Mistake]:
    """Return mistakes made with a finished answer as those of the function itself.

    Args:
        mistakes: whose `redo` takes the right answer.
        right: the function, from its arguments to the right answer.
    """

    def after(redo: Callable[..., Array]) -> Callable[..., Any]:
        return lambda *args: redo(right(*args))

    return [replace(m, redo=after(m.redo)) for m in mistakes]
