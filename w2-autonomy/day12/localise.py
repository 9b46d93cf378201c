"""Where answers are wrong that no named mistake gives: in which kinds of calls.

All that is said was tried: it is counted, over what is always asked and what is drawn.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import compress
from typing import Any, NamedTuple

import numpy as np

from labkit.judge import Case, Finding
from labkit.judge.ask import as_plain
from robo47 import planning
from robo47.checks import Array

from .ways import without_filling

NEAR = 1e-7  # two answers, or two lengths, that are the same but for rounding
OTHERS = 3  # calls of another kind, at least, where one kind is told
THIN = 0.012  # share of an edge that a thin disc covers, at most

Kinds = Mapping[str, str]  # by slug what follows "It is wrong only "


class Asked(NamedTuple):
    """One call: its arguments, the student's answer and the right one, in parts."""

    arguments: tuple[Any, ...]
    mine: tuple[Array, ...]
    right: tuple[Array, ...]

    def wrong(self, part: int = 0) -> bool:
        """Return whether a part of the answer is wrong."""
        with np.errstate(invalid="ignore"):
            off = np.abs(self.mine[part] - self.right[part])
        same = self.mine[part] == self.right[part]  # an infinity that is right
        return not bool(np.all((off <= NEAR) | same))

    def wrong_rows(self) -> bool:
        """Return whether an array of any number of rows is wrong."""
        a, b = (without_filling(x[0]) for x in (self.mine, self.right))
        return a.shape != b.shape or not np.allclose(a, b, rtol=0.0, atol=NEAR)


def calls(case: Case) -> list[Asked]:
    """Return all calls that have an answer, first those that are always asked."""
    found = list(_calls(case.arguments, case.S, case.T))
    if case.further:
        more = case.further
        found += _calls(more.arguments, more.S, more.T)
    return found


def _calls(arguments: Sequence[Any], S: Any, T: Any) -> Iterator[Asked]:
    mine, right = (x if isinstance(x, tuple) else (x,) for x in (S, T))
    n = len(mine[0])
    columns = [c if isinstance(c, np.ndarray) else [c] * n for c in arguments]
    for args, s, t in zip(
        zip(*columns, strict=True),
        zip(*mine, strict=True),
        zip(*right, strict=True),
        strict=True,
    ):
        yield Asked(tuple(map(as_plain, args)), s, t)


def only(
    said: Kinds,
    features: Sequence[Mapping[str, bool]],
    wrong: Sequence[bool],
    least: float = 1 / 3,
) -> Finding | None:
    """Return the narrowest kind of call that holds all wrong ones, or None.

    Args:
        said: of each kind how it is called, after "only"; the more telling first.
        features: of each call which kinds it is of.
        wrong: whether it was answered wrongly.
        least: share of the calls of a kind that are wrong, for it to be told.
    """
    bad = np.array(wrong, bool)
    best: tuple[float, int, str, int] | None = None
    for rank, slug in enumerate(said):
        of = np.array([one[slug] for one in features], bool)
        if not bad.any() or (bad & ~of).any() or (~of).sum() < OTHERS:
            continue
        if bad.sum() >= least * of.sum():
            found = (float(-bad.sum() / of.sum()), rank, slug, int(of.sum()))
            best = min(best, found) if best else found
    if best is None:
        return None
    _, _, slug, m = best
    k, n = int(bad.sum()), len(bad)
    return Finding(slug, f"It is wrong only {said[slug]}: in {k} of {m} such calls, "
                   f"and in none of the {n - m} others.")  # fmt: skip


def of_an_index(case: Case) -> Finding | None:
    """Say which rows `nearest` names instead of the nearest one."""
    asked = calls(case)
    some = [(*one.arguments[:2], int(one.mine[0]), int(one.right[0])) for one in asked]
    return another_row(some)


ROWS: Kinds = {
    "root-never": "where the root, row 0, is the nearest",
    "last-row-never": "where the last row is the nearest",
    "where-q-stands": "where q is a node itself, 0 away",
    "more-than-two": "where points have more than two coordinates",
    "only-far": "where the nearest node is further away than 1",
    "only-near": "where the nearest node is no further away than 1",
}


def another_row(some: Sequence[tuple[Array, Array, int, int]]) -> Finding | None:
    """Say which rows are named: from trees, points, the student's row and the right."""
    features = []
    for tree, q, _, its in some:
        far = float(np.linalg.norm(tree[its] - q))
        last = its == len(tree) - 1
        of = (its == 0, last, far < NEAR, len(q) > 2, far > 1, far <= 1)
        features.append(dict(zip(ROWS, of, strict=True)))
    wrong = [mine != its for _, _, mine, its in some]
    bad = [one for one, is_wrong in zip(some, wrong, strict=True) if is_wrong]
    if not bad:
        return None
    odd = [(mine, len(tree)) for tree, _, mine, _ in bad if not -1 < mine < len(tree)]
    if odd:
        says = f"It names row {odd[0][0]} of a tree of {odd[0][1]} rows, 0 to "
        return Finding("no-such-row", f"{says}{odd[0][1] - 1}.")
    gaps = [np.linalg.norm(tree[[mine, its]] - q, axis=1) for tree, q, mine, its in bad]
    worst = int(np.argmax([one - other for one, other in gaps]))
    says = (
        f" In one call it names row {bad[worst][2]}, {gaps[worst][0]:.3f} away, where "
        f"row {bad[worst][3]} is {gaps[worst][1]:.3f} away."
    )
    if found := only(ROWS, features, wrong):
        return Finding(found.slug, found.message + says)
    many = f"each of its {len(bad)} wrong answers"
    if len(bad) > 3 and all(mine > its for *_, mine, its in bad):
        how = f"The row comes after the nearest one in {many}: is the least distance "
        return Finding("later-row", f"{how}kept, and is each compared with it?{says}")
    if len(bad) > 3 and all(mine < its for *_, mine, its in bad):
        how = f"The row comes before the nearest one in {many}: is every row looked at?"
        return Finding("earlier-row", how + says)
    how = f"It is not the nearest row in {len(bad)} of {len(some)} calls."
    return Finding("not-the-nearest", how + says + " Print what you compare.")


STEERED: Kinds = {
    "at-the-target": "where the target is q itself",
    "near-targets": "where the target is no further away than a step; it ends there "
    "then, at a copy of the target",
    "far-in-space": "where the target is further away than a step, and there are more "
    "than two coordinates",
    "far-targets": "where the target is further away than a step",
    "more-than-two": "where points have more than two coordinates",
}


def of_a_step(case: Case) -> Finding | None:
    """Say for which targets `steer` is wrong, and whether it leaves the way."""
    asked = calls(case)
    steps = []
    for one in asked:
        q, target, step = one.arguments
        steps.append((q, target, step, one.mine[0][: len(q)], one.wrong()))
    return another_step(steps)


def another_step(
    steps: Sequence[tuple[Array, Array, float, Array, bool]],
) -> Finding | None:
    """Say it from q, target, step, where it went, and whether that is wrong."""
    features, how = [], []
    for q, target, step, end, is_wrong in steps:
        far = float(np.linalg.norm(target - q))
        many = len(q) > 2
        of = (far == 0.0, far <= step, far > step and many, far > step, many)
        features.append(dict(zip(STEERED, of, strict=True)))
        if is_wrong and far > 0.0:
            how.append(_gone(q, target, step, end, far))
    found = only(STEERED, features, [one[4] for one in steps], least=0.0)
    if not found and not how:
        return None
    beside = sum(not line for line, _ in how)
    says, slug = "", found.slug if found else "not-a-step"
    if how and not beside:
        says = f" It stays on the straight way, and in the first of them {how[0][1]}."
    elif how:
        first = next(text for line, text in how if not line)
        says = f" It leaves the straight way to the target in {beside} of them: once it"
        says += f" ends {first}."
        slug = slug if found and not slug.startswith("far") else "off-the-way"
    told = found.message if found else "It is wrong for near targets and for far ones."
    return Finding(slug, told + says)


def _gone(
    q: Array, target: Array, step: float, end: Array, far: float
) -> tuple[bool, str]:
    """Return whether an end is on the line to the target, and how far it is off."""
    unit = (target - q) / far
    along = float((end - q) @ unit)
    least = min(step, far)
    if np.linalg.norm(end - q - along * unit) < NEAR * max(1.0, abs(along)):
        return True, f"it goes {along + 0.0:.3f} far where {least:.3f} is right"
    off = np.linalg.norm(end - q - least * unit)
    return False, f"{off:.2g} away from where a step of {least:.3f} ends"


EDGES: Kinds = {
    "no-disc": "where there is no disc",
    "no-length": "where the edge is a point, b = a",
    "touching": "where the edge touches a disc; that counts as hit",
    "thin-discs": "where a disc covers less than a hundredth of the edge",
    "within-a-disc": "where the edge lies in one disc, both ends",
    "start-in-a-disc": "where the start a lies in a disc",
    "end-in-a-disc": "where the end b lies in a disc",
    "between-the-ends": "where a disc is cut through, and no end lies in one",
    "behind-the-start": "where the line, but not the edge, meets a disc behind a",
    "beyond-the-end": "where the line, but not the edge, meets a disc beyond b",
    "off-the-edge": "where the line, but not the edge, meets a disc, behind a or "
    "beyond b",
    "grazed-discs": "where a disc is cut near its rim alone",
    "beside-a-disc": "where the edge passes a disc nearer than twice its radius",
    "several-discs": "where there are several discs",
    "centre-off-the-edge": "where a disc is hit whose centre lies behind a or beyond b",
    "long-edges": "where the edge is longer than 1",
    "short-edges": "where the edge is no longer than 1",
    "free-edges": "where the edge is free",
    "hit-edges": "where the edge is hit",
}


def features_of(a: Array, b: Array, discs: Array) -> dict[str, bool]:
    """Return of which kinds of `EDGES` an edge among discs is."""
    along = b - a
    square = float(along @ along)
    length = np.sqrt(square)
    centres, r = discs[:, :2], discs[:, 2]
    part = (centres - a) @ along / (square or 1.0)
    feet = a + np.clip(part, 0, 1)[:, None] * along
    gap = np.linalg.norm(centres - feet, axis=1) - r
    off = np.linalg.norm(centres - a - part[:, None] * along, axis=1)
    ends = [np.linalg.norm(centres - end, axis=1) <= r for end in (a, b)]
    hit, line = gap <= NEAR, (off <= r) & (gap > NEAR) & (square > 0)
    with np.errstate(invalid="ignore"):
        chord = 2 * np.sqrt(np.maximum(r**2 - off**2, 0.0))
    behind, beyond = bool((line & (part < 0)).any()), bool((line & (part > 1)).any())
    some = bool(hit.any())
    held = bool(ends[0].any() or ends[1].any())
    near = (gap > NEAR) & (gap < r) & (part >= 0) & (part <= 1)
    found = (
        not len(discs), square == 0.0, bool((np.abs(gap) <= NEAR).any()),
        some and bool((chord < THIN * length)[hit].all()),
        bool((ends[0] & ends[1]).any()), bool(ends[0].any()), bool(ends[1].any()),
        some and not held, behind, beyond, behind or beyond,
        some and bool((off > 0.8 * r)[hit].all()), bool(near.any()), len(discs) > 1,
        bool((hit & ((part < 0) | (part > 1))).any()), length > 1.0, length <= 1.0,
        not some, some,
    )  # fmt: skip
    return dict(zip(EDGES, found, strict=True))


def of_an_edge(case: Case) -> Finding | None:
    """Say at which kinds of edges `segment_free_of_discs` is wrong, each by itself."""
    asked = calls(case)
    features = [features_of(*one.arguments) for one in asked]
    return wrong_edges(features, [(one.mine[0], one.right[0]) for one in asked])


def wrong_edges(
    features: Sequence[Mapping[str, bool]], truths: Sequence[tuple[Any, Any]]
) -> Finding | None:
    """Say it from the edges' kinds, and whether each is free: as told, and rightly."""
    found = []
    for free, word in ((True, "free"), (False, "hit")):
        wrong = [bool(s) is free and bool(t) is not free for s, t in truths]
        pairs = zip(features, truths, strict=True)
        of_kind = [(one, bad) for (one, (_, t)), bad in zip(pairs, wrong, strict=True)
                   if bool(t) is not free]  # fmt: skip
        if not any(wrong):
            continue
        kinds, bad = zip(*of_kind, strict=True)
        told = only(EDGES, kinds, bad) or _each(kinds, bad, free)
        right = "hit" if free else "free"
        found.append((told, f"Of edges that are {right} it calls some {word}. "))
    if not found:
        return None
    slug = "+".join(dict.fromkeys(told.slug for told, _ in found))
    return Finding(slug, " ".join(text + told.message for told, text in found))


HIT = (
    "between-the-ends",
    "start-in-a-disc",
    "end-in-a-disc",
    "no-length",
    "thin-discs",
)
FREE = ("off-the-edge", "beside-a-disc", "no-length", "no-disc")


def _each(
    features: Sequence[Mapping[str, bool]], wrong: Sequence[bool], free: bool
) -> Finding:
    """Return how many edges of some kinds are wrong: those that are hit, or free."""
    says = []
    for slug in HIT if free else FREE:
        of = [bad for one, bad in zip(features, wrong, strict=True) if one[slug]]
        if any(of):
            says.append(f"in {sum(of)} of {len(of)} {EDGES[slug].partition(';')[0]}")
    told = f", {', '.join(says)}" if says else ""
    what = "hit-called-free" if free else "free-called-hit"
    return Finding(what, f"It is wrong in {sum(wrong)} of {len(wrong)}{told}.")


def of_an_extension(case: Case) -> Finding | None:
    """Say what of `extend`'s three results is wrong, and where."""
    asked = calls(case)
    rows = []
    for one in asked:
        tree, sample = one.arguments[:2]
        rows.append((tree, sample, int(one.mine[0]), int(one.right[0])))
    blocked = [{"where-blocked": not one.right[2]} for one in asked]
    said = {"where-blocked": "where the edge is not free; row, point and truth value "
            "come back all the same"}  # fmt: skip
    for part, named in ((0, "The node"), (1, "The new point")):
        wrong = [one.wrong(part) for one in asked]
        if found := only(said, blocked, wrong):
            return Finding(f"another-{'node' if part == 0 else 'point'}-where-blocked",
                           f"{named}: {found.message}")  # fmt: skip
        if part == 0 and any(wrong) and not any(one.wrong(1) for one in asked):
            says = "The new point is right, and the index is not that of the node it "
            says += f"grows from, in {sum(wrong)} of {len(wrong)} calls."
            return Finding("index-of-another", says)
        if any(wrong):
            told = another_row(rows) if part == 0 else another_step(_grown(asked))
            return told and Finding(told.slug, f"{named}: {told.message}")
    return _of_its_edge(asked)


def _grown(asked: Sequence[Asked]) -> list[tuple[Array, Array, float, Array, bool]]:
    return [
        (one.arguments[0][int(one.right[0])], *one.arguments[1:3], one.mine[1],
         one.wrong(1))
        for one in asked
    ]  # fmt: skip


def _of_its_edge(asked: Sequence[Asked]) -> Finding | None:
    """Say for which edges the truth value is wrong, where node and point are right."""
    features = []
    for one in asked:
        tree, sample, step, world = one.arguments
        node, q = tree[int(one.right[0])], one.right[1]
        reached = bool(np.linalg.norm(sample - node) <= step)
        features.append({
            "where-reached": reached, "where-not-reached": not reached,
            "where-the-rest-is-hit": not planning.edge_free(q, sample, world),
        })  # fmt: skip
    said = {
        "where-reached": "where the sample is reached",
        "where-not-reached": "where the sample is further away than a step",
        "where-the-rest-is-hit": "where the way on from the new point to the sample is "
        "not free; the tree does not grow there",
    }
    wrong = [one.wrong(2) for one in asked]
    start = "Whether it is free: "
    if found := only(said, features, wrong):
        return Finding(found.slug, start + found.message)
    # Of a world that only answers questions, nobody knows where its obstacles are.
    shown = [isinstance(one.arguments[3], np.ndarray) for one in asked]
    if any(one.wrong(2) for one, seen in zip(asked, shown, strict=True) if not seen):
        return None
    among = list(compress(asked, shown))
    edges = []
    for one in among:
        tree, _, _, world = one.arguments
        edges.append(features_of(tree[int(one.right[0])], one.right[1], world))
    told = wrong_edges(edges, [(one.mine[2], one.right[2]) for one in among])
    return told and Finding(told.slug, start + told.message)
