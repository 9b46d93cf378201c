"""A slip that nobody named: the lab's own body with one place of it changed.

It is claimed where that gives all of the student's numbers, fresh ones as well.
"""

from labkit.judge.answers import Parts, capitalised, worst_part
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from labkit.judge.miswritten import SAYS, Miswritten, reads
from labkit.judge.pairs import QUICK, answer_to, answers_to, exactly, nth, tried


def one_slip(case: Case, S: Parts, T: Parts) -> Finding | None:
    """Return which slip in the lab's own function gives the answers, or None."""
    ask = case.ask
    if any(kind.whole for kind in ask.kinds) or ask.seconds > QUICK:
        return None
    i = tried(ask, S, T)[0]
    mine = nth(S, i)
    for one in ask.miswritten:
        redo = ask.in_turn(one.code)
        if exactly(ask, answer_to(redo, case.arguments, i, T), mine):
            if gives_all(case, one, S):
                return _told(case, one, S, T)
    return None


def gives_all(case: Case, one: Miswritten, S: Parts) -> bool:
    """Return whether a slip gives all answers, those to the fresh questions too."""
    redo = case.ask.in_turn(one.code)
    if not exactly(case.ask, answers_to(redo, case.arguments), S):
        return False
    more = case.further
    return not more or exactly(case.ask, answers_to(redo, more.arguments), more.S)


def _told(case: Case, one: Miswritten, S: Parts, T: Parts) -> Finding:
    ask = case.ask
    k = worst_part(ask.kinds, S, T, ask.near)
    body = ask.body()
    assert body
    text = reads(body[0], one)
    how = f"the lab's own with `{text}`" if text else "the lab's own with that slip"
    off = f"Off by up to {ask.kinds[k].apart(S[k], T[k])}"
    says = f"{capitalised(SAYS[one.kind])}."
    return Finding(
        f"slip-{one.kind}", f"{says} ({off}; {how} gives your numbers exactly.)"
    )
