"""12.4 `rrt_connect(start, goal, world, samples, step)`: its questions and mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Row, Slip, Waypoints
from labkit.judge.answers import once
from robo47.planning import extend, rrt_connect

from .planners import fault, of_a_planner, one_tree, planner
from .ways import ASKS, BALL, FLOOR, NONE, usual, ways_asked

row = Row(
    Waypoints((None, None)),
    unnamed=of_a_planner,
    at_edge=lambda *call: False,  # trees on a grid are full of ties
    each_case=50,  # a planner takes long, and its calls too
    slips=(
        ASKS,
        Slip(
            "^stopped",
            r"\bwhile\b|\bfor\b",
            "stopped",
            "A loop does not end. If the other tree grows towards the *sample*, it "
            "may reach the sample and then add free edges of length 0 without ever "
            "reaching the *new node*. Grow it towards the new node, compare its last "
            "node with the new node, and leave the loop if an edge is not free. When "
            "you follow the parents to the root, stop at the root: no other node may "
            "be its own parent.",
        ),
    ),
)


@once  # two cases ask it of each call
def connected(*call):
    """Return whether the planner that is asked for finds a path."""
    return bool(len(rrt_connect(*call)))


row.cases(
    samples_that_lead_to_a_path=connected,
    samples_that_lead_to_no_path=lambda *call: not connected(*call),
)
row.cases(
    worlds_without_an_obstacle=lambda *call: np.size(call[2]) == 0,
    worlds_with_obstacles=lambda *call: np.size(call[2]) > 0,
)


@row.rare
def _(rng):
    samples = usual(rng).numbers(-1.3, 1.3, 12, 2)
    step = float(rng.numbers(0.3, 0.6))
    for n in (0, 2, 12):
        yield np.array([-1.0, -0.9]), np.array([1.1, 0.9]), NONE, samples[:n], step


@row.inputs
def _(rng):
    start, goal = np.zeros(2), np.array([2.5, 0])
    yield start, goal, NONE, np.array([[0.0, 2]]), 1.0
    yield start, goal, NONE, np.empty((0, 2)), 1.0
    # Sample 0 is blocked; sample 1 grows the goal's tree all the same.
    caged = np.array([[0.0, 0.5, 0.3]])
    yield start, goal, caged, np.array([[0.0, 2], [2.5, 2]]), 1.0
    # Free is what sample 0 adds, and the other tree is blocked; sample 1 is the goal's.
    post = np.array([[1.3, 0, 0.4]])
    yield (
        start,
        goal,
        post,
        np.array([[-0.5, 0.3], [2.8, 0.7], [0.9, 1.7], [2, 2]]),
        0.7,
    )
    # Over a ball in space, and nowhere.
    up = np.array([[0.2, 1, 1], [1, 1, 0.3], [2, 1.3, 0]])
    yield np.zeros(3), np.array([2.5, 0, 0]), BALL, up, 0.7
    yield np.zeros(3), np.array([2.5, 0, 0]), BALL, up[:0], 0.7
    # Along a floor: samples below it are blocked.
    low = np.array([[0.5, -1], [2, -0.9], [0.6, 0.8], [2.2, 1.3]])
    yield start, goal, FLOOR, low, 0.7
    # The other tree comes by many edges.
    yield start, goal, NONE, np.array([[0.0, 2]]), 0.1
    around = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    ring = np.column_stack([2.5 + np.cos(around), np.sin(around), np.full(12, 0.4)])
    yield start, goal, np.round(ring, 3), rng.numbers(-1, 4, 16, 2), 0.83
    # All of it below and left of the origin.
    yield -start, -goal, post * [-1, 1, 1], np.array([[0.5, -0.3], [-2.8, -0.7],
        [-0.9, -1.7], [-2, -2]]), 0.7  # fmt: skip
    yield from ways_asked(rng)


@row.spans
def _(rng):
    ends = np.zeros(2), np.array([2.5, 0])
    yield *ends, NONE, np.array([[0.0, 2]]), 0.01  # a tree of 250 nodes
    yield *ends, NONE, np.array([[0.0, 2]]), 100.0
    yield *ends, NONE, np.array([[5e-4, 0.0]]), 1.0  # a sample that is nearly there


@row.valid("Your paths are valid, but they do not come from the specified planner.")
def _(start, goal, world, samples, step, path):
    if not len(path):
        return None  # another planner may need other samples
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    return steps.all() and not fault(path, start, goal, world, step)


@row.wrongs
def _(start, goal, world, samples, step):
    """swap-when-it-grew: your code extends the same tree again after a sample whose
      edge is blocked. Alternate the two trees after every sample
    swap-when-it-failed: your code extends the same tree again after a sample that adds
      a node. Alternate the two trees after every sample
    trees-not-swapped: your code extends the start's tree towards every sample. Extend
      the goal's tree towards samples 1, 3, 5 and so on
    goal-first: your code extends the goal's tree towards sample 0. Extend the start's
      tree towards sample 0 instead
    connect-one-step: your code adds only one edge to the other tree for each sample.
      Add edges until an edge is blocked or the new node is reached
    connect-to-the-sample: your code extends the other tree towards the sample. Extend
      it towards the new node instead
    greedy-samples: your code adds several edges towards the sample. Add only one edge
    one-tree: your code extends only the start's tree, and it tests the edge to the goal
      from each new node within one step of the goal. Extend a second tree from the goal
    connect-in-one-jump: your code connects the other tree by a single edge of any
      length. Add edges of at most one step instead
    parent-is-the-newest: your path contains every node of both trees. Store the index
      that `extend` returns as the parent of each new node
    not-turned-round: your path contains the start's branch in the order from the newest
      node to the root. Reverse this branch
    goal-to-start: your code returns the path from the goal to the start. Reverse the
      path
    half-the-path: your code returns only the start's branch. Append the goal's branch
    half-the-path 2: your code returns only the goal's branch. Put the start's branch
      before the goal's branch
    not-checked: your code adds a node even if its edge is not free. Add a node only if
      the third result of `extend` is True
    meeting-point-twice: your path contains the meeting node of the two trees twice.
      Include this node once
    meeting-point-lost: your path does not contain the meeting node of the two trees.
      Include this node once
    goal-lost: your path does not contain the goal. Include the goal as the last
      waypoint
    start-lost: your path does not contain the start. Include the start as the first
      waypoint
    ends-only: your path contains only the start and the goal. Include the nodes of both
      branches
    first-sample-left-out: your code skips the first sample. Use all samples
    last-sample-left-out: your code skips the last sample. Use all samples
    straight-tried-first: your code tests the edge from the start to the goal before the
      first sample. Omit this test, because the planner should find no path without
      samples
    """
    given = (start, goal, world, samples, step)
    right = rrt_connect(*given)
    there = len(right) > 0
    none = right[:0]
    straight = len(rrt_connect(start, goal, world, np.array([start]), 99.0)) > 0
    return {
        "swap-when-it-grew": partial(planner, *given, turn="grew"),
        "swap-when-it-failed": partial(planner, *given, turn="failed"),
        "trees-not-swapped": partial(planner, *given, turn="never"),
        "goal-first": partial(planner, *given, turn="goal"),
        "connect-one-step": partial(planner, *given, approach="one"),
        "connect-to-the-sample": partial(planner, *given, approach="sample"),
        "greedy-samples": partial(planner, *given, mine="connect"),
        "one-tree": partial(one_tree, *given),
        "connect-in-one-jump": partial(planner, *given, approach="jump"),
        "parent-is-the-newest": partial(planner, *given, parent="newest"),
        "not-turned-round": partial(planner, *given, joined=lambda a, b: a + b[1:]),
        "goal-to-start": right[::-1],
        "half-the-path": partial(planner, *given, joined=lambda a, b: a[::-1]),
        "half-the-path 2": partial(planner, *given, joined=lambda a, b: b),
        "not-checked": partial(planner, *given, free=True),
        "meeting-point-twice": partial(
            planner, *given, joined=lambda a, b: a[::-1] + b
        ),
        "meeting-point-lost": partial(
            planner, *given, joined=lambda a, b: [*a[:0:-1], *b[1:]]
        ),
        "goal-lost": right[:-1],
        "start-lost": right[1:],
        "ends-only": np.array([start, goal]) if there else none,
        "first-sample-left-out": partial(
            rrt_connect, start, goal, world, samples[1:], step
        ),
        "last-sample-left-out": partial(
            rrt_connect, start, goal, world, samples[:-1], step
        ),
        "straight-tried-first": np.array([start, goal]) if straight else right,
    }


@row.wrong("two-in-turn")
def _(start, goal, world, samples, step):
    return planner(
        start, goal, world, samples, step, turn=lambda k, used, nodes: k // 2 % 2
    )


@row.wrong("no-way")
def _(start, goal, world, samples, step):
    some = np.vstack([samples[::3], samples[1::3]])
    return rrt_connect(start, goal, world, some, step)


@row.right  # A branch is kept with each node, and the trees change places.
def _(start, goal, world, samples, step):
    one = {"nodes": [start], "ways": [[start]]}
    two = {"nodes": [goal], "ways": [[goal]]}
    first = True

    def add(tree, target):
        i, q, free = extend(np.array(tree["nodes"]), target, step, world)
        if not free:
            return None
        tree["nodes"].append(q)
        tree["ways"].append([*tree["ways"][i], q])
        return q

    for sample in samples:
        new = add(one, sample)
        if new is not None:
            while (q := add(two, new)) is not None:
                if np.all(q == new):
                    a, b = one["ways"][-1], two["ways"][-1]
                    way = a[:-1] + b[::-1]
                    return np.array(way if first else way[::-1])
        one, two, first = two, one, not first
    return np.zeros((0, len(start)))


row.at_least_0(step="a length")

row.same("while i > 0: => while i > 0.001 + 0:", "i is a whole number")
for change in ("[[1], [0]]", "[[0], [1]]"):
    row.same(f"parents = [[0], [0]] => parents = {change}", "a root's is never read")
row.same(
    "mine, other = (k % 2, 1 - k % 2) => mine, other = (k % 2, 1 - k % 4)",
    "-1 and -2 count from the end of two: they are 1 and 0",
)
for what in ("np.empty((0, len(start)))", "free"):
    for how in ("np.abs(({}))", "np.maximum(({}), 0)", "np.clip(({}), -1, 1)"):
        row.same(f"return {how.format(what)}", "nothing, or a truth value")
row.same("return (np.empty((0, len(start)))).astype(np.float32)", "it is empty")


@row.wrong("another-planner")  # RRT of one tree with goal bias, as tutorials have it.
def _(start, goal, world, samples, step):
    nodes, parents = [start], [0]
    for k in range(200):
        target = goal if k % 5 == 4 or not len(samples) else samples[k % len(samples)]
        i, q, free = extend(np.array(nodes), target, step, world)
        if not free or any(np.array_equal(q, node) for node in nodes):
            continue
        nodes.append(q)
        parents.append(i)
        if np.array_equal(q, goal):
            break
    else:
        return np.empty((0, len(start)))
    at = [len(nodes) - 1]
    while at[-1]:
        at.append(parents[at[-1]])
    return np.array([nodes[i] for i in at[::-1]])


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # At most 60 nodes in a tree.
def _(start, goal, world, samples, step):
    found = rrt_connect(start, goal, world, samples, step)
    return found[: 0 if len(found) > 60 else None]


@row.wrong("not-at-every-size", hidden="the numbers of the lab stay within its limits")
def _(start, goal, world, samples, step):
    return planner(start, goal, world, samples, step, tries=50)


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Passed over: nearer than 1e-3 to a node.
def _(start, goal, world, samples, step):
    away = np.minimum(*(np.linalg.norm(samples - x, axis=1) for x in (start, goal)))
    return rrt_connect(start, goal, world, samples[away > 1e-3], step)
