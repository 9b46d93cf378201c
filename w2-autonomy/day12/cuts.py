"""Paths that are cut in another way than `shortcut`'s, and what is said of them."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np

from labkit.judge import Case, Finding
from robo47 import planning
from robo47.checks import Array
from robo47.planning import edge_free

from .options import NEAR, Option, calls, together
from .ways import without_filling

Check = Callable[[Array, Array, Array], bool]


def cut(
    path: Array,
    world: Array,
    pairs: Array,
    places: Callable[[Any, int], list[int]] | None = None,
    least: int = 1,
    check: Check = edge_free,
    join: Callable[[Array, int, int], Array] | None = None,
    fixed: str = "",
    ends: str = "never",
    order: Callable[[list[int]], list[int]] = sorted,
    used: Callable[[Array], Array] = lambda pairs: pairs,
    edge: Callable[[int, int], tuple[int, int]] = lambda i, j: (i, j),
) -> Array:
    """Cut in another way.

    Args:
        path, world, pairs: as the function has them.
        places: from a pair and the number of points to two rows.
        least: rows that are no further apart are left.
        check: whether an edge is free.
        join: from path, i and j to what is left.
        fixed: "" where places belong to the path by then; of its first length
            "clamped" to the last row, or "skipped" beyond it; "mask" of the first path,
            or "present" where both rows are still there.
        ends: "never" before the last pair; with the "cut" that is first; with the first
            pair that is "blocked", or does not cut.
        order: what is done with the two rows.
        used: from the pairs to those that are used.
        edge: from i and j to the rows between which the edge is checked.
    """
    places = places or (lambda pair, m: [int(u * m) for u in pair])
    join = join or (lambda path, i, j: np.vstack([path[: i + 1], path[j:]]))
    first, there = path, np.arange(len(path))  # which rows of the first one are left
    for pair in used(pairs):
        i, j = order(places(pair, len(first) if fixed else len(path)))
        if fixed in ("mask", "present"):
            done = j - i > least and check(first[i], first[j], world)
            done = done and (fixed == "mask" or {i, j} <= set(there.tolist()))
            if done:
                there = there[(there <= i) | (there >= j)]
                path = first[there]
            continue
        if fixed == "skipped" and max(i, j) >= len(path):
            continue
        i, j = (min(max(k, 0), len(path) - 1) for k in (i, j))
        a, b = (path[k] for k in edge(i, j))
        if done := j - i > least and check(a, b, world):
            path = join(path, i, j)
        if ends == ("cut" if done else "blocked"):
            break
    return path


def _ends_free(a: Array, b: Array, world: Array) -> bool:
    return edge_free(a, a, world) and edge_free(b, b, world)


def _middle_free(a: Array, b: Array, world: Array) -> bool:
    return edge_free((a + b) / 2, (a + b) / 2, world)


def _kept(first: int, last: int) -> Callable[[Array, int, int], Array]:
    """Return what keeps the path up to row i + first, and from row j + last on."""
    return lambda p, i, j: np.vstack([p[: i + 1 + first], p[j + last :]])


def _placed(how: Callable[[Any], int], more: int) -> Any:
    """Return places that are made of u (m + more) by another rounding."""
    return lambda pair, m: [how(u * (m + more)) for u in pair]


OPTIONS = [
    Option("not-sorted", "your code skips a pair if its first row is the later one. "
                         "Sort the two rows", {"order": list}),
    Option("not-checked", "your code removes points without testing the new edge. "
                          "Remove them only if this edge is free",
           {"check": lambda a, b, world: True}),
    Option("hit-for-free", "your code applies only shortcuts whose edge is blocked. "
                           "Apply a shortcut only if its edge is free",
           {"check": lambda a, b, world: not edge_free(a, b, world)}),
    Option("only-the-ends-checked", "your code tests only the endpoints of the new "
                                    "edge. Test the whole edge between rows i and j",
     {"check": _ends_free}),
    Option("middle-checked", "your code tests only the midpoint of the new edge. Test "
                             "the whole edge",
           {"check": _middle_free}),
    Option("next-edge-checked", "your code tests the edge from i to i + 1. Test the "
                                "edge from i to j", {"edge": lambda i, j: (i, i + 1)}),
    Option("edge-before-checked", "your code tests the edge from i to j - 1. Test the "
                                  "edge from i to j",
           {"edge": lambda i, j: (i, j - 1)}),
    Option("edge-before-checked", "your code tests the edge from j - 1 to j. Test the "
                                  "edge from i to j",
           {"edge": lambda i, j: (j - 1, j)}),
    Option("edge-of-the-start", "your code tests the edge from the start of the path "
                                "to j. Test the edge from i to j",
           {"edge": lambda i, j: (0, j)}),
    Option("edge-to-the-end", "your code tests the edge from i to the end of the path. "
                              "Test the edge from i to j",
           {"edge": lambda i, j: (i, -1)}),
    Option("end-to-end-checked", "your code tests the edge from the start to the end "
                                 "of the path. Test the edge from i to j",
           {"edge": lambda i, j: (0, -1)}),
    *(Option("indices-of-the-first-path", f"your code {does} instead",
             {"fixed": fixed})
      for fixed, does in (
        ("mask", "takes the two rows of each pair from the original path. Use the "
                 "rows of the current path"),
        ("clamped", "computes the indices from the number of rows of the original "
                    "path, but it applies them to the current path. Use the number of "
                    "rows of the current path"),
        ("skipped", "computes the indices from the number of rows of the original "
                    "path and applies them to the current path if these rows still "
                    "exist. Use the number of rows of the current path"),
        ("present", "takes the two rows of each pair from the original path if both "
                    "rows still exist. Use the rows of the current path"))),
    *(Option(slug, f"{says}. Use `int(u * m)` instead", {"places": _placed(how, more)})
      for slug, says, how, more in (
        ("rounded", "your code rounds `u * m` to the nearest integer", round, 0),
        ("rounded", "your code rounds `u * (m - 1)` to the nearest integer", round, -1),
        ("rounded-up", "your code rounds up `u * m`", lambda x: int(np.ceil(x)), 0),
        ("rounded-up", "your code rounds up `u * (m - 1)`",
         lambda x: int(np.ceil(x)), -1),
        ("of-m-minus-one", "your code multiplies u by `m - 1`", int, -1),
        ("of-m-plus-one", "your code multiplies u by `m + 1`", int, 1))),
    Option("end-never-named", "your code uses `int(u * (m - 1))` for both rows and "
                              "adds 1 to the later row. Use `int(u * m)` for both rows "
                              "instead",
           {"places": lambda pair, m: [
               int(min(pair) * (m - 1)), int(max(pair) * (m - 1)) + 1]}),
    Option("two-apart-left", "your code skips pairs of waypoints whose indices differ "
                             "by 2. Test these pairs too, because the waypoint "
                             "between them may be removable",
           {"least": 2}),
    Option("three-apart-left", "your code skips pairs of waypoints whose indices "
                               "differ by 2 or 3. Test these pairs too, because the "
                               "waypoints between them may be removable",
           {"least": 3}),
    Option("pairs-backwards", "your code uses the pairs in reverse order. Start with "
                              "the first pair instead",
           {"used": lambda pairs: pairs[::-1]}),
    Option("first-pair-left-out", "your code omits the first pair. Use all pairs",
           {"used": lambda pairs: pairs[1:]}),
    Option("last-pair-left-out", "your code omits the last pair. Use all pairs",
           {"used": lambda pairs: pairs[:-1]}),
    Option("first-pair-only", "your code uses only the first pair. Use all pairs",
           {"used": lambda pairs: pairs[:1]}),
    Option("pairs-twice", "your code uses all pairs twice. Use each pair once",
           {"used": lambda pairs: np.concatenate([pairs, pairs])}),
    Option("first-cut-only", "your code stops after the first shortcut. Try all pairs",
           {"ends": "cut"}),
    Option("ends-when-blocked", "your code stops at the first pair without a shortcut. "
                                "Try all pairs", {"ends": "blocked"}),
    Option("one-node-short", "your code also removes row j. Keep row j, because the "
                             "tested edge ends there",
         {"join": _kept(0, 1)}),
    Option("one-node-short", "your code also removes row i. Keep row i, because the "
                             "tested edge begins there",
         {"join": _kept(-1, 0)}),
    Option("both-ends-short", "your code also removes rows i and j. Keep both rows, "
                              "because they are the endpoints of the tested edge",
           {"join": _kept(-1, 1)}),
    Option("one-too-many", "your code keeps the row before j. Remove all rows between "
                           "i and j",
           {"join": _kept(0, -1)}),
    Option("one-too-many", "your code keeps the row after i. Remove all rows between i "
                           "and j",
           {"join": _kept(1, 0)}),
    Option("one-row-only", "your code removes only the row after i. Remove all rows "
                           "between i and j",
           {"join": lambda p, i, j: np.delete(p, i + 1, axis=0)}),
    Option("one-row-only", "your code removes only the row before j. Remove all rows "
                           "between i and j",
           {"join": lambda p, i, j: np.delete(p, j - 1, axis=0)}),
    Option("middle-put-in", "your code inserts the midpoint of the new edge. Add no "
                            "point",
           {"join": lambda p, i, j: np.vstack([p[: i + 1], (p[i] + p[j])[None] / 2,
                                               p[j:]])}),
    Option("ends-at-i", "your code returns only the path up to row i. Append the path "
                        "from row j on",
         {"join": lambda p, i, j: p[: i + 1]}),
    Option("begins-at-j", "your code returns only the path from row j on. Put the path "
                          "up to row i before it",
         {"join": lambda p, i, j: p[j:]}),
    Option("inside-kept", "your code keeps only rows i to j. Remove the rows between i "
                          "and j instead",
           {"join": lambda p, i, j: p[i : j + 1]}),
]  # fmt: skip


def _made(*call: Any, **how: Any) -> Array:
    return without_filling(cut(*call, **how))


def of_a_cut(case: Case) -> Finding | None:
    """Say which options give the paths, or what keeps one from being a cut."""
    asked = calls(case)
    mine = [without_filling(one.mine[0]) for one in asked]
    if found := together(OPTIONS, _made, [one.arguments for one in asked], mine):
        return found
    for k, one in enumerate(asked, 1):
        path, world, _ = one.arguments
        if not one.wrong_rows():
            continue
        where = f"in call {k} of {len(asked)}"
        if found := _no_cut(without_filling(one.mine[0]), path, world, where):
            return found
    return None


def _no_cut(mine: Array, path: Array, world: Array, where: str) -> Finding | None:
    """Return what keeps a path from being a cut of another, or None."""
    rows = [np.flatnonzero(np.abs(path - x).max(axis=1) < NEAR) for x in mine]
    if odd := [i for i, row in enumerate(rows) if not len(row)]:
        says = f"Point {odd[0]} of your result {where} is not a point of the path. "
        return Finding("not-its-points", f"{says}Shortcuts remove points and add none.")
    at = [int(row[0]) for row in rows]
    if not at or at[0] != 0:
        says = f"Your result does not begin with the path's first point {where}."
        return Finding("start-lost", says)
    if at[-1] != len(path) - 1:
        says = f"Your result does not end with the path's last point {where}."
        return Finding("end-lost", says)
    if any(j <= i for i, j in pairwise(at)):
        return Finding(
            "other-order", f"Some points are repeated or in the wrong order {where}."
        )
    for i, j in pairwise(at):
        if j > i + 1 and not planning.edge_free(path[i], path[j], world):
            says = f"Your code connects row {i} of the path with row {j} {where}. The "
            return Finding("cut-not-free", f"{says}edge between the two is not free.")
    return None
