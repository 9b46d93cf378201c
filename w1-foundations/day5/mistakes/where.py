"""Where an answer that no named mistake gives is wrong: tasks 5.3 and 5.7."""

import numpy as np

from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.checks import Array

CASES = ("zeta = 1", "zeta under 1", "zeta over 1")
NAMES = ("acceleration", "integral")


def masks(zeta: Array) -> tuple[Array, ...]:
    """Return which questions are of which of the CASES."""
    return zeta == 1.0, zeta < 1.0, zeta > 1.0


def which_case(case: Case) -> Finding | None:
    """Say for which zeta or times the curve is wrong, and whether it starts at 1."""
    t, _, zeta = case.arguments
    right = np.abs(case.S - case.T).max(axis=1) < 1e-8
    usual = (t[:, 0] == 0.0) & (np.diff(t, axis=1) > 0.0).all(axis=1)
    if right[usual].all():
        says = "Right where t begins at 0 and grows, wrong for other times: entry i of "
        return Finding("times-wrong", f"{says}the answer belongs to entry i of t.")
    wrong = [
        name
        for name, some in zip(CASES, masks(zeta), strict=True)
        if not right[some & usual].all()
    ]
    if len(wrong) == len(CASES):
        if np.abs(case.S[t == 0.0] - 1.0).max() < 1e-8:
            return None
        says = "At t = 0 the error is 1; here it is not, for some zeta."
        return Finding("does-not-start-at-one", says)
    says = f"Wrong for {' and for '.join(wrong)}, right otherwise."
    return Finding("one-case-wrong", says)


def which_answer(case: Case) -> Finding:
    """Say which of the two answers is wrong, how far, and for how many inputs."""
    parts = list(zip(case.ask.kinds, case.S, case.T, strict=True))
    off = np.array([np.abs(S - T).max(axis=1) / kind.scale for kind, S, T in parts])
    wrong = off > case.ask.near
    bad = [bool(some.any()) for some in wrong]
    at = 0 if bad == [True, False] else 1  # where both are wrong: the integral first
    kind, S, T = parts[at]
    says = (
        f"{kind.called[0].upper()}{kind.called[1:]}: {kind.what_is_wrong(S, T).message}"
    )
    rest = "The integral that comes back is right, the acceleration is not."
    if bad == [False, True]:
        rest = "The acceleration is right, the integral that comes back is not."
    if all(bad):
        rest = "Both answers are wrong; look at the integral first."
    count = int(np.sum(~wrong.any(axis=0)))
    where = f" Right for {count} of {len(S)} inputs." if count else ""
    return Finding(f"{NAMES[at]}-wrong", f"{rest} {says}{where}")
