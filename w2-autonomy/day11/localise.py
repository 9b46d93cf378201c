"""Where an answer of Day 11 that no named mistake gives is right, and where not.

What is said is true of all that was asked, whatever the mistake is.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from labkit.judge import Case, Finding
from robo47.checks import Array


class Seen(NamedTuple):
    """All that a function was asked, the fresh questions too."""

    calls: list[tuple[Any, ...]]  # their arguments
    S: list[Array]  # the student's answers
    T: list[Array]  # the right ones
    wrong: Array  # of each whether it is wrong, (n,)

    def some(self, which: Sequence[bool] | Array) -> "Seen":
        """Return a part of it."""
        at = np.flatnonzero(which)
        each = ([x[i] for i in at] for x in (self.calls, self.S, self.T))
        return Seen(*each, self.wrong[at])


def seen(case: Case) -> Seen:
    """Return all that was asked, of a function with one result."""
    calls = list(zip(*case.arguments, strict=True))
    S, T = list(case.S), list(case.T)
    gap = case.ask.gaps((case.S,), (case.T,))
    if more := case.further:
        calls += zip(*more.arguments, strict=True)
        S += list(more.S[0])
        T += list(more.T[0])
        gap = np.append(gap, case.ask.gaps(more.S, more.T))
    return Seen(calls, S, T, gap > case.ask.near)


class Group(NamedTuple):
    """Calls that are one kind, and what is told where they are wrong."""

    slug: str
    hint: str = ""


def listed(some: Sequence[str]) -> str:
    """Return "a", "a and b", "a, b and c"."""
    return " and ".join([", ".join(some[:-1]), some[-1]] if some[1:] else some)


class Sorted(NamedTuple):
    """A way to sort calls."""

    groups: Mapping[str, Group]  # by their names, the simplest first
    label: Callable[..., str]  # from a call's arguments to one of them, "" for none
    lead: str = ""  # what stands before the names ("where they are ")


def apart(all_: Seen, *ways: Sorted) -> Finding | None:
    """Return which groups are right and which not, sorted in the way that tells most.

    That is the one in which fewest calls stand in a group that is now right and now
    wrong; None where no group is right, or all are.
    """
    found = [one for way in ways if (one := _apart(all_, way))]
    return min(found, key=lambda one: one[0])[1] if found else None


def _apart(all_: Seen, way: Sorted) -> tuple[int, Finding] | None:
    groups, lead = way.groups, way.lead
    of = np.array([way.label(*call) for call in all_.calls])
    right = [g for g in groups if np.any(of == g) and not all_.wrong[of == g].any()]
    never = [g for g in groups if np.any(of == g) and all_.wrong[of == g].all()]
    mixed = [g for g in groups if all_.wrong[of == g].any() and g not in never]
    if not right or not never + mixed:
        return None
    parts = [f"right {lead}{listed(right)}"]
    parts += [f"wrong {lead}{listed(never)}"] if never else []
    parts += [f"now right, now wrong {lead}{listed(mixed)}"] if mixed else []
    first = next(group for name, group in groups.items() if name in never + mixed)
    says = f"It is {'; '.join(parts)}. {first.hint}".strip()
    return int(np.isin(of, mixed).sum()), Finding(first.slug, says)


def sizes(all_: Seen) -> str:
    """Return that wrong numbers are all too large, or too small, or ""."""
    bad = all_.some(all_.wrong)
    off = np.array([np.sum(s - t) for s, t in zip(bad.S, bad.T, strict=True)])
    if not np.isfinite(off).all() or not len(off):
        return ""
    if (off > 0).all():
        return " All wrong ones are too large."
    return " All wrong ones are too small." if (off < 0).all() else ""


def fitted(columns: Array, wanted: Array) -> Array | None:
    """Return the factors of columns, (n, m), that sum up to wanted, (n,); or None."""
    good = np.isfinite(columns).all(axis=1) & np.isfinite(wanted)
    if not good.all() or len(wanted) <= columns.shape[1]:
        return None
    found, _, rank, _ = np.linalg.lstsq(columns, wanted, rcond=None)
    if rank < columns.shape[1]:
        return None
    off = np.abs(columns @ found - wanted).max()
    return found if off < 1e-9 * max(1.0, np.abs(wanted).max()) else None


def number(x: float) -> str:
    """Return a factor as one says it: "0", "1", "-0.5", "0.577"."""
    return f"{round(float(x), 3) + 0.0:.3g}"
