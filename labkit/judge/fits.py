"""How many questions fit into a task's time, by what a call of the reference costs.

A task of a call that takes two seconds is asked a few good questions, not forty.
"""

import math
import time
from collections.abc import Callable, Sequence
from typing import Any

from labkit.base import processes

SLOWER = 3.0  # times as long as the reference may take who is right
ROUNDS = 2  # each question is asked twice
QUICK = 0.01  # seconds; a call that takes less is not timed again
FEWEST = 2  # inputs drawn anew, at least: else answers could be looked up
TIMES = 3

Calls = Sequence[tuple[Any, ...]]


def at_work() -> float:
    """Return the time in seconds, without what was waited for a processor, on Linux."""
    return time.perf_counter() - processes.waited()


def measured(call: Callable[[], object], clock: Callable[[], float] = at_work) -> float:
    """Return how many seconds a call takes here, as a power of 2: two runs agree."""
    times: list[float] = []
    while not times or (len(times) < TIMES and min(times) > QUICK):
        started = clock()
        call()
        times.append(clock() - started)
    return 2.0 ** math.ceil(math.log2(max(min(times), 1e-9)))


def fitting(
    main: Calls, edges: Calls, drawn: Calls, cost: float, seconds: float
) -> Calls:
    """Return the edge values and drawn inputs that fit beside the main questions.

    Args:
        main, edges, drawn: arguments of calls.
        cost: of one, in seconds.
        seconds: of all calls to the function.
    """
    most = int(seconds / (ROUNDS * SLOWER * cost)) - len(main) if cost else math.inf
    if most >= len(edges) + len(drawn):
        return [*edges, *drawn]
    most = max(int(most), FEWEST)
    some = drawn[: max(FEWEST, most - min(len(edges), most // 2))]
    return [*edges[: most - len(some)], *some]


def too_long(main: Calls, cost: float, seconds: float) -> str:
    """Return that even the main questions do not fit, with the remedy, or ""."""
    least = len(main) + FEWEST
    needed = least * ROUNDS * SLOWER * cost
    if needed <= seconds:
        return ""
    return (
        f"a call takes {cost:.2g} s here; {len(main)} in @row.inputs and {FEWEST} "
        f"drawn anew, each asked twice, take who is {SLOWER:.0f} times as slow "
        f"{needed:.3g} s, and there are {seconds:.3g}. Ask fewer or smaller ones, or "
        "give the task more `seconds` in day.toml"
    )
