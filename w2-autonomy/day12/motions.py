"""Motions that are timed in another way, and what is said of them."""

from collections.abc import Callable, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np

from labkit.judge import Case, Finding
from robo47 import planning
from robo47.checks import Array

from .options import NEAR, Asked, Option, calls, together


def path_accel_bounds(
    a: Array, b: Array, g: Array, limits: Array, sd: float
) -> tuple[float, float]:
    """Return what planning's does, unchecked: it is asked a hundred thousand times."""
    return planning._range(a, b * sd**2 + g, limits)


def timed(
    A: Array, B: Array, G: Array, limits: Array, x_max: Array, **how: Any
) -> Array:
    """Time a path in another way.

    Args:
        A, B, G, limits, x_max: as the function has them.
        how: what differs:
            two_ds: by which sdd is multiplied, from N.
            sd, forward_sd: from x to the value used as sd, backwards and forwards.
            start: sd^2 there; "K" is the most from which one can stop.
            last: whether the motion has to stop at its end.
            passes: "both", "back", "forward", "fall" forwards up to x_max, "smaller" of
                both.
            bisections: of each step backwards.
            pull: what of gravity, speed: a function of A, B, G, x -> (A, B, G).
            back_at, at: which end of a step its limits are read at, 0 or 1.
            most: the maximum x of each point, from x_max.
            ranges: path_accel_bounds.
            stands: from G and limits whether it holds nowhere.
            kept: the most of which end of a step its x is kept below, forwards.
            without: conditions of the pass backwards that are left out: "allowed",
                "after", "turning".
            swept: backwards by the least sdd at the next point, instead of bisection.
            out: what is done with the answer.
    """
    o = SimpleNamespace(**{**USUAL, **how})
    n = len(A) - 1
    if o.stands(G, limits):
        return o.out(np.zeros(n + 1))
    A, B, G = o.pull(A, B, G)
    top = np.array(o.most(x_max), dtype=float)
    K = _back(o, (A, B, G), limits, top) if o.passes != "forward" else top
    if o.passes == "back":
        return o.out(K)
    free = o.passes == "smaller"
    x = _forward(o, (A, B, G), limits, top if free else K, K)
    return o.out(np.minimum(x, K) if free else x)


def _back(o: Any, rows: tuple[Array, ...], limits: Array, top: Array) -> Array:
    """Return the most from which a motion can still stop at the end."""
    K = top.copy()
    n = len(K) - 1
    K[-1] = 0.0 if o.last else top[-1]
    two_ds = o.two_ds(n)

    def reached(i: int, x: float) -> bool:
        at = i + o.back_at
        low, high = o.ranges(*(row[at] for row in rows), limits, o.sd(x))
        return (
            ("allowed" in o.without or low <= high)
            and ("after" in o.without or x + two_ds * low <= K[i + 1])
            and ("turning" in o.without or x + two_ds * high >= 0)
        )

    for i in range(n - 1, -1, -1):
        if o.swept:
            at = i + 1
            low, _ = o.ranges(*(row[at] for row in rows), limits, o.sd(K[i + 1]))
            K[i] = max(0.0, min(top[i], K[i + 1] - two_ds * low))
            continue
        good, bad = 0.0, top[i]
        if reached(i, bad):
            good = bad
        for _ in range(o.bisections * (good < bad)):
            half = (good + bad) / 2
            good, bad = (half, bad) if reached(i, half) else (good, half)
        K[i] = good
    return K


def _forward(
    o: Any, rows: tuple[Array, ...], limits: Array, most: Array, K: Array
) -> Array:
    """Return sd^2 as fast as the torques allow, kept below `most`."""
    n = len(K) - 1
    x = np.full(n + 1, float(K[0] if o.start == "K" else o.start))
    sd = o.forward_sd or o.sd
    for i in range(n):
        ends = o.ranges(*(row[i + o.at] for row in rows), limits, sd(x[i]))
        u = o.two_ds(n) * ends[1]
        x[i + 1] = max(0.0, min(most[i + o.kept], x[i] + u))
    return x


USUAL: dict[str, Any] = {
    "two_ds": lambda n: 2 / n,
    "sd": np.sqrt,
    "forward_sd": None,
    "start": 0.0,
    "last": True,
    "passes": "both",
    "bisections": 60,
    "pull": lambda A, B, G: (A, B, G),
    "back_at": 0,
    "at": 0,
    "most": lambda x_max: x_max,
    "ranges": path_accel_bounds,
    "stands": lambda G, limits: np.any(np.abs(G) > limits),
    "kept": 1,
    "without": (),
    "swept": False,
    "out": lambda x: x,
}


def _same_limit(choose: Callable[[Array], float]) -> Any:
    """Return ranges in which all joints have one limit."""
    return lambda a, b, g, limits, sd: path_accel_bounds(
        a, b, g, np.full_like(limits, choose(limits)), sd
    )


OPTIONS = [
    *(Option(slug, says, {"two_ds": of}, alone="points" in slug)
      for slug, says, of in (
        ("ds-for-2-ds", "your code adds `ds * sdd` to sd^2 in each step. Add `2 * ds "
                        "* sdd` instead",
         lambda n: 1 / n),
        ("four-ds", "your code adds `4 * ds * sdd` to sd^2 in each step. Add `2 * ds "
                    "* sdd` instead",
         lambda n: 4 / n),
        ("half-ds", "your code adds `ds * sdd / 2` to sd^2 in each step. Add `2 * ds "
                    "* sdd` instead",
         lambda n: 0.5 / n),
        ("points-for-steps", "your code uses ds = 1 / (N + 1). Use ds = 1 / N, because "
                             "N + 1 points have N steps between them",
         lambda n: 2 / (n + 1)),
        ("points-for-steps", "your code uses ds = 1 / (N - 1). Use ds = 1 / N, because "
                             "N + 1 points have N steps between them",
         lambda n: 2 / max(n - 1, 1)),
        ("points-for-steps", "your code uses ds = 1 / (N + 2). Use ds = 1 / N, because "
                             "N + 1 points have N steps between them",
         lambda n: 2 / (n + 2)),
        ("ds-forgotten", "your code omits ds, or it uses ds = 1. Use ds = 1 / N "
                         "instead",
         lambda n: 2.0),
        ("ds-forgotten", "your code omits the factor of 2 ds, or this factor is 1. Use "
                         "2 ds with ds = 1 / N instead",
         lambda n: 1.0))),
    Option("sd-for-sd2", "your code uses sd^2 instead of sd for the bounds on sdd. "
                         "Pass sd to `path_accel_bounds`",
           {"sd": lambda x: x}),
    Option("sd-for-sd2", "in the forward pass, your code uses sd^2 instead of sd for "
                         "the bounds on sdd. Pass sd to `path_accel_bounds`",
           {"forward_sd": lambda x: x}),
    Option("sd-squared-twice", "your code uses sd^4 instead of sd for the bounds on "
                               "sdd. Pass sd to `path_accel_bounds`",
           {"sd": lambda x: x * x}, alone=True),
    Option("at-rest", "in both passes, your code uses sd = 0 for the bounds on sdd. "
                      "Pass the sd of the point to `path_accel_bounds`",
           {"sd": lambda x: 0.0 * x}, alone=True),
    Option("at-rest", "in the forward pass, your code uses sd = 0 for the bounds on "
                      "sdd. Pass the sd of the point to `path_accel_bounds`",
           {"forward_sd": lambda x: 0.0 * x}, alone=True),
    Option("start-not-at-rest", "your code starts the motion with the largest sd^2 "
                                "from which the arm can stop. Start it with sd^2 = 0 "
                                "instead",
           {"start": "K"}),
    Option("end-not-at-rest", "your motion need not be at rest at the end. Start the "
                              "backward pass with sd^2 = 0 instead of `sd2_max`",
           {"last": False}),
    *(Option(slug, says, {"passes": one}) for slug, says, one in (
        ("no-braking", "your motion need not stop at the end. Limit sd^2 by a "
                       "backward pass that begins with sd^2 = 0 at the last point",
         "forward"),
        ("backward-pass-only", "your code omits the forward pass, so the motion need "
                               "not start at rest. Add a forward pass that begins "
                               "with sd^2 = 0 at the first point", "back"),
        ("smaller-of-two-passes", "your code computes the two passes independently and "
                                  "takes the minimum. Limit sd^2 in the forward pass "
                                  "by the result of the backward pass instead",
         "smaller"))),
    *(Option("few-bisections", f"your bisection stops too early, after {n} halvings. "
                               "Use more iterations",
           {"bisections": n}, alone=True)
      for n in (1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 16, 20)),
    Option("bobrow", "in the backward pass, your code computes the smallest sdd at "
                     "the end of each step. Compute it at the first point of the step "
                     "instead",
           {"swept": True}),
    Option("limits-of-the-next-point", "your code computes the bounds on sdd at the "
                                       "end of each step in both passes. Compute them "
                                       "at the first point of the step instead",
           {"back_at": 1, "at": 1}),
    Option("limits-of-the-next-point", "in the backward pass, your code computes the "
                                       "bounds on sdd at the end of each step. "
                                       "Compute them at the first point of the step "
                                       "instead",
        {"back_at": 1}),
    Option("limits-of-the-next-point", "in the forward pass, your code computes the "
                                       "bounds on sdd at the end of each step. "
                                       "Compute them at the first point of the step "
                                       "instead",
        {"at": 1}),
    *(Option(slug, says, {"pull": of}, alone=True) for slug, says, of in (
        ("limits-of-the-first-point", "your code uses `a`, `b` and `c` of the first "
                                      "point in every step. Use the values of each "
                                      "point instead",
         lambda *rows: tuple(np.broadcast_to(x[0], x.shape) for x in rows)),
        ("limits-of-the-last-point", "your code uses `a`, `b` and `c` of the last "
                                     "point in every step. Use the values of each "
                                     "point instead",
         lambda *rows: tuple(np.broadcast_to(x[-1], x.shape) for x in rows)),
        ("gravity-forgotten", "your code omits gravity from the torques. Include the "
                              "term `c`",
         lambda A, B, G: (A, B, 0 * G)),
        ("gravity-of-the-first-point", "your code uses the gravity torque of the first "
                                       "point at every point. Use the gravity torque "
                                       "of each point instead",
         lambda A, B, G: (A, B, np.broadcast_to(G[0], G.shape))),
        ("gravity-sign", "your code reverses the sign of gravity. Use `c` itself",
         lambda A, B, G: (A, B, -G)),
        ("coriolis-forgotten", "your code omits `b * sd**2` from the torques. Include "
                               "this term",
         lambda A, B, G: (A, 0 * B, G)),
        ("coriolis-sign", "your code reverses the sign of `b`. Use `b` itself",
         lambda A, B, G: (A, -B, G)),
        ("B-and-G-exchanged", "your code swaps `b` and `c`. The term `b` belongs to "
                              "sd^2, and `c` is the gravity torque",
         lambda A, B, G: (A, G, B)),
        ("A-and-B-exchanged", "your code swaps `a` and `b`. The term `a` belongs to "
                              "sdd, and `b` belongs to sd^2",
         lambda A, B, G: (B, A, G)))),
    *(Option(slug, says, {"most": of}, alone=True) for slug, says, of in (
        ("no-speed-limit", "your code ignores `sd2_max`. Limit sd^2 to `sd2_max` in "
                           "both passes, because the joint velocities are limited",
         lambda x: np.full_like(x, 1e3)),
        ("x-max-of-the-next-point", "your code uses `sd2_max` of the next point. Use "
                                    "`sd2_max` of the same point instead",
         lambda x: np.append(x[1:], x[-1])),
        ("x-max-of-the-point-before", "your code uses `sd2_max` of the previous point. "
                                      "Use `sd2_max` of the same point instead",
         lambda x: np.append(x[0], x[:-1])),
        ("least-x-max", "your code uses the smallest entry of `sd2_max` at every "
                        "point. Use the entry of each point instead",
         lambda x: np.full_like(x, x.min())),
        ("x-max-of-the-first-point", "your code uses the first entry of `sd2_max` at "
                                     "every point. Use the entry of each point instead",
         lambda x: np.full_like(x, x[0])),
        ("x-max-squared", "your code squares `sd2_max`. Use `sd2_max` unchanged, "
                          "because its entries are already squares",
         lambda x: x**2),
        ("x-max-rooted", "your code takes the square root of `sd2_max`. Compare sd^2 "
                         "with `sd2_max` itself", np.sqrt))),
    *(Option(slug, says, {"stands": of}) for slug, says, of in (
        ("cannot-stand-goes", "your code can return a nonzero motion although gravity "
                              "alone exceeds a torque limit at some point. Return "
                              "zeros in this case, because the arm cannot hold still "
                              "at that point",
         lambda G, limits: False),
        ("all-points-too-heavy", "your code returns zeros only if gravity exceeds a "
                                 "torque limit at every point. Return zeros if gravity "
                                 "exceeds a limit at any point",
         lambda G, limits: np.all(np.abs(G) > limits)),
        ("first-point-alone", "your code compares gravity with the torque limits "
                              "only at the first point. Compare it at every point",
         lambda G, limits: np.any(np.abs(G[0]) > limits)),
        ("ends-alone", "your code compares gravity with the torque limits only at the "
                       "first and the last point. Compare it at every point",
         lambda G, limits: np.any(np.abs(G[[0, -1]]) > limits)),
        ("gravity-with-sign", "your code compares the signed gravity torque with the "
                              "torque limits. Compare its absolute value instead, "
                              "because the limits also apply to negative torques",
         lambda G, limits: np.any(limits < G)))),
    *(Option(f"without-{what}", f"your backward pass does not test whether {says}. Add "
                              "this test",
             {"without": (what,)}, alone=True) for what, says in (
        ("allowed", "any sdd is permitted at this speed (low <= high)"),
        ("after", "the motion can slow down to the maximum of the next point"),
        ("turning", "the largest sdd keeps sd^2 at 0 or above"))),
    Option("most-of-the-point-before", "in the forward pass, your code limits sd^2 at "
                                       "point i + 1 by the maximum at point i. Use "
                                       "the maximum at point i + 1 instead",
           {"kept": 0}),
    *(Option(slug, f"your code uses the {word} torque limit for every joint. Use each "
                   f"joint's own limit instead",
             {"ranges": _same_limit(choose)}, alone=True) for slug, word, choose in (
        ("smallest-limit", "smallest", np.min), ("largest-limit", "largest", np.max),
        ("first-limit", "first joint's", lambda x: x[0]))),
    Option("half-the-torque", "your code uses only half of each torque limit. Use the "
                              "whole limit",
           {"ranges": lambda a, b, g, limits, sd: path_accel_bounds(
               a, b, g, limits / 2, sd)}),
    Option("first-joint-only", "your code uses only the first joint. Use all joints, "
                               "because every joint can limit sdd",
           {"ranges": lambda a, b, g, limits, sd: path_accel_bounds(
               a[:1], b[:1], g[:1], limits[:1], sd)}),
    *(Option(slug, says, {"out": of}) for slug, says, of in (
        ("root", "your code returns sd. Return sd^2 instead", np.sqrt),
        ("squared", "your code returns sd^4. Return sd^2 instead", np.square),
        ("end-to-start", "your code returns the motion from the end to the start. "
                         "Reverse the motion",
         lambda x: x[::-1]),
        ("stopped-at-the-end", "your motion can stop abruptly at the last point. Start "
                               "the backward pass with 0 at this point",
         lambda x: np.append(x[:-1], 0.0)),
        ("mirrored", "your code takes the minimum of the motion and its mirror image. "
                     "Compute both passes instead, because the limits can differ in "
                     "the other direction",
         lambda x: np.minimum(x, x[::-1])))),
]  # fmt: skip


def of_a_motion(case: Case) -> Finding | None:
    """Say of a motion which limit it breaks first, or where it is too slow."""
    asked = calls(case)
    mine = [one.mine[0][: len(one.arguments[0])] for one in asked]
    if found := together(OPTIONS, timed, [one.arguments for one in asked], mine):
        return found
    for k, one in enumerate(asked, 1):
        heavy = (np.abs(one.arguments[2]) > one.arguments[3]).any()
        if heavy or not one.wrong() or not np.isfinite(one.mine[0]).all():
            continue
        if broken := _broken(one):
            slug, says = broken
            return Finding(slug, f"In call {k} of {len(asked)}, {says}")
    slow = _slow(asked)
    return Finding("slower-than-possible", slow) if slow else None


def _broken(one: Asked) -> tuple[str, str] | None:
    """Return the first limit that a motion breaks: its name and how, or None."""
    A, B, G, limits, x_max = one.arguments
    x = one.mine[0][: len(A)]
    n = len(A) - 1
    for end, i in (("begins", 0), ("ends", n)):
        if abs(x[i]) > NEAR:
            return f"{end}-in-motion", (
                f"your motion {end} with sd^2 = {x[i]:.3f}. It should be 0 at "
                "this point."
            )
    if (x < -NEAR).any():
        return "below-zero", f"sd^2 is below 0 at point {int(np.argmax(x < -NEAR))}."
    if (fast := x > x_max + NEAR).any():
        i = int(np.argmax(fast))
        says = f"sd^2 is {x[i]:.3f} at point {i}, but sd2_max is {x_max[i]:.3f}."
        return "faster-than-the-motors", says
    for i in range(n):
        u = (x[i + 1] - x[i]) * n / 2
        low, high = planning.path_accel_bounds(
            A[i], B[i], G[i], limits, np.sqrt(max(x[i], 0))
        )
        if not low - 1e-5 <= u <= high + 1e-5:
            says = f"sdd from point {i} to the next is {u:.3f}, but "
            allowed = f"the torques allow {low:.3f} to {high:.3f}"
            if low > high:
                allowed = "the torques allow no sdd at this speed"
            return "beyond-the-torques", f"{says}{allowed}."
    return None


def _slow(asked: Sequence[Asked]) -> str:
    """Return where a motion that keeps all limits is slower than the fastest, or ""."""
    for k, one in enumerate(asked, 1):
        mine, right = one.mine[0], one.right[0]
        if one.wrong() and np.isfinite(mine).all():
            i = int(np.argmax(right - mine))
            if right[i] > mine[i] + NEAR:
                return (
                    f"In call {k} of {len(asked)}, your motion is within all limits, "
                    f"but it is slower than possible. At point {i}, sd^2 is "
                    f"{mine[i]:.3f}, but {right[i]:.3f} is possible."
                )
    return ""
