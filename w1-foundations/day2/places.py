"""Where in a product: the one joint or row that is wrong, and how it shows at q = 0."""

from collections.abc import Callable, Iterable, Sequence
from itertools import combinations

import numpy as np

from labkit.judge import Case, Draw, Finding, Pose
from labkit.judge.answers import InTurn, capitalised, difference, matches, rigid
from labkit.judge.chain import Factor, one_place, product
from labkit.judge.row import inside, row_of
from labkit.lesson.day import find_day
from robo47.checks import Array
from robo47.screws import dh_link, exp_screw

from .exp_screw import NOT_OF_AN_ARM

Found = Iterable[tuple[Finding, Array]]
ALONE = 0.7  # radians: each joint is asked for on its own, both ways


def unnamed(case: Case) -> Finding | None:
    """Return which exponential is wrong, in either form of the product."""
    if not rigid(case.S):
        return None
    S, M, q = case.arguments
    steps = [_exponential(S, q, k) for k in range(q.shape[1])]
    fixed = Factor("M", M, False)
    in_space = bool(matches(case.T, product([s.T for s in steps], len(q)) @ M))
    chain = [*steps, fixed] if in_space else [fixed, *steps]
    Ts = [s.T for s in steps]
    return (
        one_place(case.S, case.T, chain)
        or _two_swapped(case.S, Ts, M, in_space)
        or _one_at_a_time(case)
    )


def _two_swapped(S: Array, Ts: list[Array], M: Array, in_space: bool) -> Finding | None:
    """Return which two exponentials are in the wrong order, if that is all."""
    for i, k in combinations(range(len(Ts)), 2):
        order = list(range(len(Ts)))
        order[i], order[k] = k, i
        moved = product([Ts[j] for j in order], len(S))
        if matches(S, moved @ M if in_space else M @ moved):
            says = f"The exponentials of joint{i + 1} and joint{k + 1} are swapped in "
            return Finding(
                "pose-off", f"{says}your product. Use the order of the joints."
            )
    return None


def unnamed_row(case: Case) -> Finding | None:
    """Return which row of the table is wrong."""
    if not rigid(case.S):
        return None
    table, q = case.arguments
    theta = np.concatenate([q, np.zeros((len(q), 1))], axis=1)  # the flange's is 0
    chain = [_row(table, theta, k) for k in range(table.shape[1])]
    return one_place(case.S, case.T, chain)


def mistake_of(
    small: str, but: Sequence[str], X: Array, *columns: Array
) -> Finding | None:
    """Return the mistake of a small function that makes what stands in one place.

    Args:
        small: its name.
        but: slugs that make no difference here.
        X: what stands there, (n, 4, 4).
        columns: the small function's arguments at every question, (n, ...) each.
    """
    for way in row_of(find_day(2), small).named:
        again = InTurn(way.code)
        try:
            if (
                way.slug not in but
                and matches(X[-1], again.nth(-1, columns))  # a quick look first
                and matches(X, again(*columns))
            ):
                return Finding(way.slug, way.says)
        except (ValueError, np.linalg.LinAlgError):  # it has no answer to these
            continue
    return None


def alone(first: Callable, n: int = 7) -> Callable:
    """Return inputs of a probe: each joint alone, of the first question, both ways."""

    def inputs(rng: Draw) -> list[tuple]:
        *arm, _ = first(rng)[0]
        return [(*arm, q) for q in ALONE * np.vstack([np.eye(n), -np.eye(n)])]

    return inputs


def measured(case: Case) -> tuple[str, ...]:
    """Return how far off poses are at q = 0 and elsewhere: the thread of the day."""
    zero, other = (
        Pose().apart(case.S[i], case.T[i]) for i in (slice(1), slice(1, None))
    )
    return (f"error at q = 0: {zero}; elsewhere: up to {other}",)


def _exponential(S: Array, q: Array, k: int) -> Factor:
    name = f"joint{k + 1}"

    def candidates() -> Found:
        never = (
            f"Your product omits the exponential of {name}, so this joint has no effect"
        )
        yield Finding("joint-skipped", never), np.eye(4)[None]
        twice = f"Your product contains the exponential of {name} twice"
        yield Finding("joint-twice", twice), exp_screw(S[:, k], 2.0 * q[:, k])
        for j in set(range(q.shape[1])) - {k}:
            says = f"Your code moves {name} by the angle of joint{j + 1}"
            yield Finding("joint-fed-another", says), exp_screw(S[:, k], q[:, j])
            says = f"Your code moves {name} along the screw of joint{j + 1}"
            yield Finding("screw-of-another", says), exp_screw(S[:, j], q[:, k])

    def unnamed(X: Array) -> Finding | None:
        if found := mistake_of("exp_screw", NOT_OF_AN_ARM, X, S[:, k], q[:, k]):
            says = inside("in this exponential, ", found.message)
            where = f"A mistake in the exponential of {name} alone would explain your "
            return Finding(found.slug, f"{where}result. {capitalised(says)}")
        omega = S[:, k, :3]
        vee = X[:, [2, 0, 1], [1, 2, 0]] - X[:, [1, 2, 0], [2, 0, 1]]
        sine = 0.5 * np.sum(omega * vee, axis=1)
        cosine = 0.5 * (np.trace(X[:, :3, :3], axis1=1, axis2=2) - 1.0)
        if not matches(X, exp_screw(S[:, k], np.arctan2(sine, cosine))):
            return None
        says = f"Your code moves {name} along the correct screw, but by the wrong angle"
        return Finding("joint-angle-off", says)

    return Factor(name, exp_screw(S[:, k], q[:, k]), False, candidates, unnamed)


def _row(table: Array, theta: Array, k: int) -> Factor:
    columns = np.moveaxis(table[:, k], -1, 0)
    name = f"row {k + 1}"

    def candidates() -> Found:
        missing = f"Your product omits {name} of the table"
        yield Finding("row-skipped", missing), np.eye(4)[None]
        for j in set(range(theta.shape[1])) - {k}:
            angle = f"of row {j + 1}" if j < theta.shape[1] - 1 else "0"  # the flange
            says = f"Your code uses the angle {angle} for {name} of the table"
            yield Finding("row-fed-another", says), dh_link(*columns, theta[:, j])

    def unnamed(X: Array) -> Finding | None:
        if found := mistake_of("dh_link", (), X, *columns, theta[:, k]):
            says = f"A mistake in {name} of the table alone would explain your result. "
            says += f"In this row, {found.message}"
            return Finding(found.slug, says)
        return None

    return Factor(name, dh_link(*columns, theta[:, k]), False, candidates, unnamed)


def _one_at_a_time(case: Case) -> Finding | None:
    """Return for which joints the pose is wrong when they move on their own."""
    wrong = []
    for (S, M, q), answer in case.probes:
        if not isinstance(answer, np.ndarray) or answer.shape != (4, 4):
            return None
        right = case.ask.truth(S[None], M[None], q[None])
        off = difference(answer[None], right)[0] > case.ask.near
        wrong.append((int(np.argmax(np.abs(q))), q.sum() < 0.0, bool(off)))
    off = [(k, negative) for k, negative, is_off in wrong if is_off]
    if len(off) == len(wrong):
        return None
    if not off:
        where = (
            f"If only one joint moves, by {ALONE} or -{ALONE} rad, your pose is "
            "correct. Does the error occur only if several joints move, or also for "
            "larger angles of one joint?"
        )
    else:
        where = f"If only one joint moves, by {ALONE} or -{ALONE} rad, your pose is "
        where += "wrong for "
        where += f"{_these(off)}."
    found = Pose().what_is_wrong(case.S, case.T)
    return Finding(found.slug, f"{found.message} {where}")


def _these(off: list[tuple[int, bool]]) -> str:
    """Return the joints in words, and the sign if one sign alone is wrong."""
    *names, last = (f"joint{k + 1}" for k in sorted({k for k, _ in off}))
    joints = f"{', '.join(names)} and {last}" if names else last
    signs = {negative for _, negative in off}
    if len(signs) == 2:
        return joints
    return f"{'negative' if signs == {True} else 'positive'} angles of {joints}"
