"""Planners that differ from the one asked for, and what is said of their ways."""

from itertools import count, pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np

from labkit.judge import Case, Finding
from robo47 import planning
from robo47.checks import Array

from .options import Option, together
from .ways import CLEAR, discs_of, gap, without_filling

# What a planner does where it does not differ; `planner` says what each is.
USUAL = {
    "turn": "sample",
    "approach": "connect",
    "mine": "step",
    "parent": "nearest",
    "joined": lambda a, b: a[::-1] + b[1:],
    "free": None,
    "first": "start",
    "used": lambda samples: samples,
    "stride": 1.0,
    "far": 1.0,
    "grows": "nearest",
    "blocked": "next",
    "meets": "equal",
    "tries": 0,
    "none": lambda start, goal: np.empty((0, len(start))),
}
LONGEST = 400  # edges that the other tree grows towards one node


class _Trees:
    """Two trees that grow, each node with its parent's index."""

    def __init__(self, how: Any, start: Array, goal: Array, world: Array) -> None:
        """Begin with both roots."""
        self.how, self.world = how, planning._world(world)
        self.nodes = [start], [goal]
        self.parents = [0], [0]

    def grow(self, side: int, target: Array, step: float) -> bool:
        """Add a node towards the target if its edge is free; return whether it was."""
        nodes = self.nodes[side]
        first = len(nodes) - 1 if self.how.grows == "newest" else 0
        i, q, free = planning._extend(np.array(nodes[first:]), target, step, self.world)
        if not (free if self.how.free is None else self.how.free):
            return False
        self.parents[side].append({
            "nearest": i + first, "newest": len(nodes) - 1, "root": 0,
        }[self.how.parent])  # fmt: skip
        nodes.append(q)
        return True

    def met(self, other: int, new: Array, sample: Array, step: float) -> bool:
        """Return whether the other tree's newest node is treated as the new one."""
        last = self.nodes[other][-1]
        if self.how.meets == "equal":
            return bool(np.array_equal(last, new))
        if self.how.meets == "sample":
            return bool(np.array_equal(last, sample))
        return bool(np.linalg.norm(last - new) <= step)

    def to_root(self, side: int) -> list[Array]:
        """Return the nodes from the newest to the root."""
        i = len(self.nodes[side]) - 1
        way = [self.nodes[side][i]]
        while i > 0:
            i = self.parents[side][i]
            way.append(self.nodes[side][i])
        return way


def planner(
    start: Array, goal: Array, world: Array, samples: Array, step: float, **how: Any
) -> Array:
    """Plan with two trees, in another way.

    Args:
        start, goal, world, samples, step: as rrt_connect has them.
        how: what differs from `USUAL`:
            turn: when the trees change: "sample" each time; "grew" only if it grew;
                "failed" only if not; "never"; "goal": the goal's tree is first; or
                whose turn it is, from k, the samples and both trees' nodes.
            approach: what the other tree does: "connect" edge after edge to the new
                node; "one" edge; "sample": edge after edge to the sample; "jump" in one
                edge; "root": to the root of the first tree.
            mine: what the first tree does: one "step", or "connect" until blocked.
            parent: "nearest", or "newest" of each node, or the "root".
            joined: how the way is made of both branches, each from the newest to its
                root.
            first: the branch that comes first: the "start"'s, or the one of the tree
                whose "turn" it is.
            free: True takes every edge for free.
            used: from the samples to those that are used.
            stride, far: by what the first tree's step, and the other's, is multiplied.
            grows: the "nearest" node, or the "newest".
            blocked: after a blocked sample the "next" one, "on" with the other tree and
                the newest node, "stop", or the "other" tree grows towards it.
            meets: "equal", or "near", within a step, or at the "sample".
            tries: edges that the other tree grows at most; 0 is no limit.
            none: from start and goal to what comes back without a way.
    """
    o = SimpleNamespace(**{**USUAL, **how})
    trees = _Trees(o, start, goal, world)
    one = int(o.turn == "goal")
    used = o.used(samples)
    for k, sample in enumerate(used):
        side = o.turn(k, used, trees.nodes) if callable(o.turn) else one
        grew = trees.grow(side, sample, step * o.stride)
        while grew and o.mine == "connect":
            if np.array_equal(trees.nodes[side][-1], sample):
                break
            if not trees.grow(side, sample, step * o.stride):
                break
        turns = {"sample": True, "goal": True, "grew": grew, "failed": not grew}
        if isinstance(o.turn, str) and turns.get(o.turn):
            one = 1 - one
        if not grew and o.blocked == "stop":
            break
        if not grew and o.blocked == "other":
            trees.grow(1 - side, sample, step)
        if (grew or o.blocked == "on") and _joins(o, trees, side, sample, step):
            first = side if o.first == "turn" else 0
            return np.array(o.joined(trees.to_root(first), trees.to_root(1 - first)))
    return o.none(start, goal)


def _joins(o: Any, trees: _Trees, side: int, sample: Array, step: float) -> bool:
    """Grow the other tree; return whether it comes to the new node."""
    other = 1 - side
    new = trees.nodes[side][-1]
    target = {"sample": sample, "root": trees.nodes[side][0]}.get(o.approach, new)
    most = 1 if o.approach == "one" else o.tries or LONGEST
    far = 99.0 if o.approach == "jump" else step * o.far
    for n in count(1):
        if not trees.grow(other, target, far):
            return False
        if trees.met(other, new, sample, step):
            return True
        if n >= most or np.array_equal(trees.nodes[other][-1], target):
            return False
    return False


def one_tree(
    start: Array, goal: Array, world: Array, samples: Array, step: float
) -> Array:
    """Grow the start's tree alone, towards the samples, and try the goal each time."""
    trees = _Trees(SimpleNamespace(**USUAL), start, goal, world)
    for sample in samples:
        if trees.grow(0, sample, step):
            new = trees.nodes[0][-1]
            near = np.linalg.norm(goal - new) <= step
            if near and planning.edge_free(new, goal, world):
                return np.array([*trees.to_root(0)[::-1], goal])
    return np.empty((0, len(start)))


OPTIONS = [
    Option("swap-when-it-grew", "your code extends the same tree again after a sample"
                                " whose edge is blocked. Alternate the two trees "
                                "after every sample",
           {"turn": "grew"}),
    Option("swap-when-it-failed", "your code extends the same tree again after a "
                                  "sample that adds a node. Alternate the two trees "
                                  "after every sample",
           {"turn": "failed"}),
    Option("trees-not-swapped", "your code extends the start's tree towards every "
                                "sample. Extend the goal's tree towards samples 1, 3, "
                                "5 and so on",
           {"turn": "never"}),
    Option("goal-first", "your code extends the goal's tree towards sample 0. Extend "
                         "the start's tree towards sample 0 instead", {"turn": "goal"}),
    Option("halves", "your code extends the start's tree towards the first half of "
                     "the samples and the goal's tree towards the second half. "
                     "Alternate after every sample",
           {"turn": lambda k, used, nodes: int(2 * k >= len(used))}),
    Option("two-in-turn", "your code extends the start's tree towards samples 0 and 1 "
                          "and the goal's tree towards samples 2 and 3. Alternate "
                          "after every sample",
           {"turn": lambda k, used, nodes: k // 2 % 2}),
    Option("one-of-three", "your code extends the goal's tree only towards every "
                           "third sample. Alternate after every sample",
           {"turn": lambda k, used, nodes: int(k % 3 == 2)}),
    Option("smaller-tree", "your code extends the smaller tree towards each sample. "
                           "Alternate after every sample",
           {"turn": lambda k, used, nodes: int(len(nodes[1]) < len(nodes[0]))}),
    Option("blocked-tries-the-other", "your code extends the other tree towards a "
                                      "blocked sample. Continue with the next sample "
                                      "instead",
           {"blocked": "other"}),
    *(Option("few-samples", f"your code uses only the first {n} samples. Use all "
                            "samples",
             {"used": lambda some, n=n: some[:n]}) for n in (5, 10, 20)),
    Option("connect-one-step", "your code adds only one edge to the other tree for "
                               "each sample. Add edges until an edge is blocked or "
                               "the new node is reached",
           {"approach": "one"}),
    Option("connect-to-the-sample", "your code extends the other tree towards the "
                                    "sample. Extend it towards the new node instead",
           {"approach": "sample"}),
    Option("joined-at-the-sample", "your code extends the other tree towards the "
                                   "sample and ends the search there. Extend it "
                                   "towards the new node of the first tree instead, "
                                   "and end the search at this node",
           {"approach": "sample", "meets": "sample"}),
    Option("connect-to-the-root", "your code extends the other tree towards the root "
                                  "of the first tree. Extend it towards the new node "
                                  "instead",
           {"approach": "root"}),
    Option("connect-in-one-jump", "your code connects the other tree by a single edge "
                                  "of any length. Add edges of at most one step "
                                  "instead",
           {"approach": "jump"}),
    *(Option("connect-few-edges", f"your code adds at most {n} edges to the other "
                                  f"tree for each sample. Add edges until an edge is "
                                  f"blocked or the new node is reached",
           {"tries": n})
      for n in (2, 3, 4, 5, 10)),
    Option("greedy-samples", "your code adds several edges towards the sample. Add "
                             "only one edge",
           {"mine": "connect"}),
    Option("parent-is-the-newest", "your code uses the previous node as the parent of "
                                   "each node. Use the index that `extend` returns",
           {"parent": "newest"}),
    Option("parent-is-the-root", "your code uses the root as the parent of each node. "
                                 "Use the index that `extend` returns",
{"parent": "root"}),
    Option("grows-from-the-newest", "your code extends each tree only from its newest "
                                    "node. Pass all nodes to `extend`, which finds the "
                                    "nearest node",
           {"grows": "newest"}),
    Option("not-checked", "your code adds a node even if its edge is not free. Add a "
                          "node only if the third result of `extend` is True",
           {"free": True}),
    Option("blocked-goes-on", "your code extends the other tree even after a blocked "
                              "sample. Continue with the next sample instead",
           {"blocked": "on"}),
    Option("blocked-ends", "your code stops at the first blocked sample. Continue with "
                           "the next sample", {"blocked": "stop"}),
    Option("near-enough", "your search ends when the other tree is within one step "
                          "of the new node. End it only when the other tree reaches "
                          "the new node",
           {"meets": "near"}),
    *(Option("stride", f"your code limits each edge to {x:g} steps. The correct limit "
                       f"is one step",
           {"stride": x, "far": x})
      for x in (0.5, 2.0)),
    *(Option("stride-of-the-other", f"your code limits the edges of the other tree to "
                                    f"{x:g} steps. The correct limit is one step",
             {"far": x}) for x in (0.5, 2.0)),
    *(Option("stride-of-the-first", f"your code limits the edges towards the samples "
                                    f"to {x:g} steps. The correct limit is one step",
             {"stride": x}) for x in (0.5, 2.0)),
    Option("every-other-sample", "your code uses only every second sample. Use all "
                                 "samples",
           {"used": lambda some: some[::2]}),
    Option("sample-twice", "your code extends both trees towards each sample. Extend "
                           "only one tree towards each sample",
           {"used": lambda some: np.repeat(some, 2, axis=0)}),
    Option("samples-backwards", "your code uses the samples in reverse order. Start "
                                "with sample 0 instead",
           {"used": lambda some: some[::-1]}),
    Option("first-sample-left-out", "your code skips the first sample. Use all samples",
           {"used": lambda some: some[1:]}),
    Option("last-sample-left-out", "your code skips the last sample. Use all samples",
           {"used": lambda some: some[:-1]}),
    Option("not-turned-round", "your path contains the start's branch in the order "
                               "from the newest node to the root. Reverse this branch",
           {"joined": lambda a, b: a + b[1:]}),
    Option("goal-branch-turned", "your code reverses the goal's branch. Keep its "
                                 "order, because it already runs from the meeting "
                                 "point to the goal",
           {"joined": lambda a, b: a[::-1] + b[::-1]}),
    Option("goal-branch-turned", "your code reverses the goal's branch and then omits "
                                 "its first node. Keep the order of this branch, "
                                 "which already runs from the meeting point to the "
                                 "goal",
           {"joined": lambda a, b: a[::-1] + b[::-1][1:]}),
    Option("goal-to-start", "your code returns the path from the goal to the start. "
                            "Reverse the path",
           {"joined": lambda a, b: b[::-1] + a[1:]}),
    Option("goal-to-start-on-its-turn", "your code returns the path from the goal to "
                                        "the start if a sample of the goal's tree "
                                        "completes it. Reverse the path in this case",
           {"first": "turn"}),
    Option("meeting-point-twice", "your path contains the meeting node of the two "
                                  "trees twice. Include this node once",
           {"joined": lambda a, b: a[::-1] + b}),
    Option("meeting-point-lost", "your path does not contain the meeting node of the "
                                 "two trees. Include this node once",
           {"joined": lambda a, b: [*a[:0:-1], *b[1:]]}),
    Option("root-lost", "your path does not contain the start. Include the start as "
                        "the first waypoint",
           {"joined": lambda a, b: a[::-1][1:] + b[1:]}),
    Option("both-roots-lost", "your path contains neither the start nor the goal. "
                              "Include both",
           {"joined": lambda a, b: a[::-1][1:] + b[1:-1]}),
    Option("goal-lost", "your path does not contain the goal. Include the goal as the "
                        "last waypoint",
           {"joined": lambda a, b: a[::-1] + b[1:-1]}),
    Option("none-is-the-start", "your code returns the start if there is no path. "
                                "Return an array without rows instead",
           {"none": lambda start, goal: np.array([start])}),
    Option("none-is-straight", "your code returns the start and the goal if there is "
                               "no path. Return an array without rows instead",
           {"none": lambda start, goal: np.array([start, goal])}),
]  # fmt: skip


def _lengths(way: Array) -> Array:
    return np.linalg.norm(np.diff(way, axis=0), axis=1)


def fault(way: Array, start: Array, goal: Array, world: Array, step: float) -> str:
    """Return why a result is no valid path, in words, or ""."""
    if not np.array_equal(way[0], start):
        return "does not begin at the start"
    if not np.array_equal(way[-1], goal):
        return "does not end at the goal"
    longest = _lengths(way).max(initial=0.0)
    if longest > step * (1 + 1e-9):
        return f"has an edge of length {longest:.3f}, but a step is {step:g}"
    for i, (a, b) in enumerate(pairwise(way)):
        if gap(a, b, discs_of(world)) < -CLEAR:
            return f"has an edge that is not free, from waypoint {i} to {i + 1}"
    return ""


def _made(*call: Any, **how: Any) -> Array:
    return without_filling(planner(*call, **how))


def _joining(
    start: Array, goal: Array, world: Array, samples: Array, step: float
) -> str:
    """Return after which sample the trees meet, in words."""
    for k in range(1, len(samples) + 1):
        if len(planning.rrt_connect(start, goal, world, samples[:k], step)):
            whose = ("start", "goal")[(k - 1) % 2]
            return (
                f"the trees meet after sample {k - 1}, which extends the {whose}'s tree"
            )
    return "the trees meet"


def of_a_planner(case: Case) -> Finding | None:
    """Say of answers which options make them, or whether they are ways at all."""
    arguments = list(zip(*case.arguments, strict=True))
    sizes = [len(start) for start, *_ in arguments]  # coordinates of a way point
    S, T = (
        [without_filling(way)[:, :k] for way, k in zip(ways, sizes, strict=True)]
        for ways in (case.S, case.T)
    )
    if found := together(OPTIONS, _made, arguments, S):
        return found
    for k, (way, right, (start, goal, world, _, step)) in enumerate(
        zip(S, T, arguments, strict=True)
    ):
        where = f"in call {k + 1} of {len(S)}"
        if not len(way) and len(right):
            how = _joining(*arguments[k])
            says = (
                f"Your code finds no path {where}, but with the specified planner "
                f"{how}."
            )
            return Finding("no-way", says)
        if len(way) and (why := fault(way, start, goal, world, step)):
            return Finding("no-valid-way", f"Your path is not valid {where}: it {why}.")
        if len(twice := np.flatnonzero(_lengths(way) == 0.0)):
            says = (
                f"Your waypoints {twice[0]} and {twice[0] + 1} are the same point "
                f"{where}. "
            )
            return Finding("point-twice", says + "Include it once.")
        if len(way) and not len(right):
            says = f"Your function finds a path {where}, but the specified planner "
            says += "finds none with these samples."
            return Finding("another-planner", says)
    for k, (way, right) in enumerate(zip(S, T, strict=True)):
        n = min(len(way), len(right))
        off = np.abs(way[:n] - right[:n]).max(axis=1, initial=0.0) > CLEAR
        if off.any() or len(way) != len(right):
            at = int(np.argmax(off)) if off.any() else n
            return Finding(
                "another-planner",
                "Your paths differ from the specified planner's. The first difference "
                f"is in call {k + 1} of {len(S)}, from waypoint {at} on, counted from "
                "0. Which tree does each sample grow, and towards which point does the "
                "other tree grow?",
            )
    return None
