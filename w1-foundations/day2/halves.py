"""Which half of a screw is wrong, omega or v, where no named mistake says more."""

import numpy as np

from labkit.judge import Case, Finding
from labkit.judge.answers import difference
from labkit.judge.matrix_kinds import few_entries
from robo47.checks import Array


def which_half(case: Case) -> Finding | None:
    """Return whether omega or v is wrong in a table of screws, (n, 7, 6)."""
    if found := few_entries(case.ask.kind, case.S, case.T):
        return found
    gap = np.abs(case.S - case.T)
    omega, v = (float(gap[..., half].max()) for half in (slice(3), slice(3, None)))
    if v <= case.ask.near:
        says = "Your v is correct in every screw, but at least one entry of omega is "
        return Finding("omega-off", f"{says}off by {omega:.3g}.{_right_for(case)}")
    if omega <= case.ask.near:
        says = "Your omega is correct in every screw, but at least one entry of v is "
        return Finding("v-off", f"{says}off by {v:.3g}.{_right_for(case)}")
    says = f"Your omega and v are both wrong. Their largest errors are {omega:.3g} and "
    return Finding("both-off", f"{says}{v:.3g}, respectively.{_right_for(case)}")


def turned_round(case: Case) -> Finding | None:
    """Return that some screws are negated and all others right, screws (n, 6)."""
    right = difference(case.S, case.T) <= case.ask.near
    negated = difference(case.S, -case.T) <= case.ask.near
    if right.all() or not (right | negated).all():
        return None
    given = case.given[int(np.argmin(right))]
    first = f", as for {given}" if 0 < len(given) <= 90 else ""
    return Finding(
        "axis-turned-round",
        f"Your omega and v are both negated in {np.sum(~right)} of {len(right)} calls"
        f"{first}. Does your code reverse the axis? Use the axis as it is given.",
    )


def _right_for(case: Case) -> str:
    wrong: Array = difference(case.S, case.T) > case.ask.near
    if wrong.all():
        return ""
    return f" The result is wrong in {np.sum(wrong)} of {len(wrong)} calls."
