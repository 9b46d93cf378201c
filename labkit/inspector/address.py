"""A configuration in the page's address: to reload it, go back to it, share it."""

import urllib.parse

import numpy as np

from robo47.checks import Array

FARTHEST = 100.0  # radians or metres; no address leads further


def write(q: Array, frame: str, tab: str) -> str:
    """Return the query behind the page's address; every digit of q, (nq,), is kept."""
    numbers = ",".join(f"{float(x)!r}".removesuffix(".0") for x in q)
    query = {"q": numbers, "frame": frame, "tab": tab}
    return "?" + urllib.parse.urlencode(query, safe=",")


def read(query: str, nq: int) -> tuple[Array | None, str, str]:
    """Return what an address says: a configuration or None, a frame, a tab.

    Args:
        query: "?q=...&frame=...&tab=..."; it may be anything.
        nq: how many numbers a configuration has.
    """
    given = urllib.parse.parse_qs(query.removeprefix("?"))
    frame, tab = (given.get(name, [""])[0] for name in ("frame", "tab"))
    try:
        q = np.array([float(x) for x in given.get("q", [""])[0].split(",")])
    except ValueError:
        return None, frame, tab
    if q.shape != (nq,) or not (np.abs(q) <= FARTHEST).all():
        return None, frame, tab
    return q, frame, tab
