"""One line that a visitor types on the arm's page, and what the checker says of it.

The page evaluates the line at the checker's own questions and compares with what each
mistake gives there. The sentences are the judge's: it is asked here about each mistake.
"""

from typing import Any

import numpy as np

from labkit.base.exchange import Exchange, Question
from labkit.judge.answers import MATCHES, parts
from labkit.judge.ask import stacked
from labkit.judge.row import row_of
from labkit.judge.sources import named as named_by
from labkit.lesson.day import find_day

DAY, FUNCTION = 1, "joint_T"
DECIMALS = 12  # digits of a number that a page compares within MATCHES
ROTATION = np.s_[:, :3, :3]  # the part that is typed; the rest is a joint's at rest


def table() -> dict[str, Any]:
    """Return what the page compares a line with.

    Returns:
        questions: the angles that are always asked, rad.
        within: how far apart numbers are the same.
        right: per angle the right rotation, nine numbers.
        named: per mistake of the rotation what the checker says, and its rotations.
    """
    row = row_of(find_day(DAY), FUNCTION)
    ask = row.ask
    asked = stacked([Exchange(Question("", "", call)) for call in ask.main])
    assert ask.truth is not None
    T = parts(ask.truth(*asked))
    named = dict[str, dict[str, Any]]()
    for mistake in ask.named:
        S = parts(mistake.redo(*asked))
        beside = np.array(S[0])
        beside[ROTATION] = T[0][ROTATION]
        if np.array_equal(S[0], T[0]) or not np.array_equal(beside, T[0]):
            continue  # no line of this one gives it
        found = named_by(ask, asked, S, T)
        if found and found.message not in named:
            named[found.message] = {"slug": found.slug, "values": _rotations(S[0])}
    return {
        "questions": asked[0].tolist(),
        "within": MATCHES,
        "right": _rotations(T[0]),
        "named": [{"says": says, **one} for says, one in named.items()],
    }


def _rotations(poses: np.ndarray) -> list[list[float]]:
    rounded = np.round(poses[ROTATION].reshape(len(poses), 9), DECIMALS) + 0.0
    return rounded.tolist()
