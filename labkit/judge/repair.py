"""Which one change of a student's own text makes all of its answers right.

A mutant of a right body explains a function that is written like it. A function in
another style is changed itself: by the same operators, at the places of its own text.
What is said then has been tried, whatever the style is.
"""

import ast
import copy
from collections import defaultdict
from collections.abc import Sequence, Set
from dataclasses import replace
from itertools import chain, islice
from typing import NamedTuple, Protocol

import numpy as np

from labkit.base.exchange import Exchange, Question, Reply
from labkit.judge.answers import MATCHES, Parts
from labkit.judge.ask import Ask, Asked, right_answers
from labkit.judge.cases import NONE, RIGHT, drawn, verdict
from labkit.judge.mistake import Finding
from labkit.judge.mutant import FAR, Body, Mutant, is_alone
from labkit.judge.operators import Place, called
from labkit.judge.replies_read import read
from labkit.judge.sentence import LONG
from labkit.judge.statements import Block, Lines

MOST = 800  # changes that are tried
AT_ONCE = 50  # of them between two looks at the time
SECONDS = 0.4  # of the processor, after which no more are tried at one call
MORE = 3  # times that, after which none is tried at all
FEW = 6  # wrong answers that have to become right before the others are asked
CALL = 1.0  # second for a call, after which a change hangs
SCREENED = 24  # changes that are tried at all calls
FRESH = 60  # calls at which one is confirmed
LEAST = 3  # wrong answers that have to become right
STEPS = 2_000  # of a loop that a change may make endless
AT, CALLED = "_robo47_at", "_robo47_changed_"
# What makes up for a factor that is missing elsewhere: in `a / n`, another divisor.
TUNED = {"number", "name"}
# What may stand anywhere in a sum or a product: such a line is not the wrong one.
ANYWHERE = {"added", "scaled"}
# What may be wrong wherever a value is used, and not where a line takes it.
OF_A_VALUE = {"sign", "negated", "transpose", "inverse"}
TAKES = {"array", "asarray", "astype", "broadcast_to", "copy", "diag", "float",
         "reshape", "shape"}  # fmt: skip
LINES = 2  # that are named; of more than these it says little
# What is changed, by the kind of a change.
PARTS = {
    "sign": "the signs", "negated": "the signs", "order": "the order of the operands",
    "operation": "the operators", "name": "which variable is used",
    "index": "the indices", "bracket": "the brackets",
    "transpose": "the transposes", "inverse": "the inverses",
    "exchanged": "the order of the variables", "function": "which function is called",
    "condition": "the condition", "entries": "the order of the entries",
}  # fmt: skip
# Below the student's file; the changed functions have names of their own.
BELOW = """
_robo47_space = dict(globals())
try:
    exec({text!r}, _robo47_space)
except Exception:  # one of the changes is no Python
    pass
globals().update(_robo47_space.get("_robo47_changed", {{}}))
"""
CHOICE = """
_robo47_at = _robo47_steps = 0
def _robo47_step():
    global _robo47_steps
    _robo47_steps += 1
    if _robo47_steps > {most}:
        raise RuntimeError("a loop does not end")
    return True
def _robo47_change(k):
    def call(*args):
        global _robo47_at, _robo47_steps
        _robo47_at, _robo47_steps = k, 0
        return {function}(*args)
    call.__wrapped__ = {function}
    return call
_robo47_changed = {{
    "_robo47_changed_" + str(k): _robo47_change(k) for k in range({n} + 1)
}}
"""


class Changes(NamedTuple):
    """Changes of a student's text, and code that makes each when it is called."""

    mutants: list[Mutant]
    code: str

    def ask(self, k: int, question: Question) -> Question:
        """Return a question to the function with the k-th change."""
        return replace(question, function=f"{CALLED}{k}")


def changes_of(source: str, function: str, others: Set[str]) -> Changes | None:
    """Return the changes of a function and its helpers; None where it has no text.

    Args:
        source: the student's file.
        function: its name.
        others: functions that are judged themselves.
    """
    try:
        return _changes_of(_defined(source), function, others)
    except (
        SyntaxError,
        ValueError,
        OverflowError,
        RecursionError,
    ):  # no text, or none to be written
        return None


def _changes_of(
    defined: dict[str, ast.FunctionDef], function: str, others: Set[str]
) -> Changes | None:
    bodies = [Body(one, {}) for one in _reached(defined, function, others)]
    near = sorted(chain.from_iterable(b.near for b in bodies), key=lambda m: m.rank)
    far = chain.from_iterable(chain.from_iterable(b.far()) for b in bodies)
    some = list(islice(filter(_can_be_chosen, chain(near, far)), MOST))
    if not some:
        return None
    _put(some)
    for body in bodies:
        _limit(body.function)
    functions = [ast.fix_missing_locations(body.function) for body in bodies]
    text = "\n".join(map(ast.unparse, functions))
    text += CHOICE.format(function=function, n=len(some), most=STEPS)
    return Changes(some, BELOW.format(text=text))


def _defined(source: str) -> dict[str, ast.FunctionDef]:
    """Return the functions of a file by name; without those that are decorated."""
    some = [one for one in ast.parse(source).body if isinstance(one, ast.FunctionDef)]
    return {one.name: one for one in some if not one.decorator_list}


def _reached(
    defined: dict[str, ast.FunctionDef], function: str, others: Set[str]
) -> list[ast.FunctionDef]:
    """Return a function and those of its file that it uses."""
    found: dict[str, ast.FunctionDef] = {}
    left = [function]
    while left:
        name = left.pop()
        if name in found or name not in defined or (name in others and found):
            continue
        found[name] = defined[name]
        nodes = ast.walk(defined[name])
        left += [node.id for node in nodes if isinstance(node, ast.Name)]
    return list(found.values())


def _can_be_chosen(mutant: Mutant) -> bool:
    """Return whether a change may stand behind a condition: a target may not."""
    for at, new in mutant.edits:
        if isinstance(at, Block):
            if _leaves(new) > _leaves(at.before):
                return False
        elif isinstance(getattr(at.node, "ctx", None), ast.Store):
            return False
    return is_alone(mutant)


def _leaves(lines: Lines) -> int:
    """Return how often lines leave a loop that is not among them."""
    left, found = [*lines], 0
    while left:
        line = left.pop()
        found += isinstance(line, ast.Break | ast.Continue)
        if not isinstance(line, ast.For | ast.While):
            left += [x for x in ast.iter_child_nodes(line) if isinstance(x, ast.stmt)]
    return found


def _put(some: Sequence[Mutant]) -> None:
    """Write changes into their functions, each behind the number that chooses it.

    What stands in a place is copied first, as it has places itself.
    """
    places: dict[int, list[tuple[int, Place, ast.expr]]] = defaultdict(list)
    blocks: dict[int, list[tuple[int, Block, Lines]]] = defaultdict(list)
    for k, mutant in enumerate(some, 1):
        for at, new in mutant.edits:
            if isinstance(at, Block):
                blocks[id(at.lines)].append((k, at, new))
            else:
                text = ast.Name(f"({ast.unparse(new)})")
                places[id(at.node)].append((k, at, text))
    chosen = [(alike[0][1], _chosen_lines(alike)) for alike in blocks.values()]
    for each in places.values():
        each[0][1].put(_chosen(each))
    for block, lines in chosen:
        block.put(lines)


def _chosen(alike: Sequence[tuple[int, Place, ast.expr]]) -> ast.expr:
    """Return an expression that is the one of the number in `AT`."""
    *first, (_, place, whole) = alike
    for k, _, new in first:
        whole = ast.IfExp(_is([k]), new, whole)
    return ast.IfExp(_is([k for k, _, _ in alike]), whole, place.node)


def _chosen_lines(alike: Sequence[tuple[int, Block, Lines]]) -> Lines:
    """Return the lines of a block, of which a number in `AT` chooses other ones."""
    before = alike[0][1].before
    there = [(k, *_apart(before, new)) for k, _, new in alike]
    found: Lines = []
    for i in range(len(before) + 1):
        for k, begin, _, instead in there:
            if begin == i:
                found.append(ast.If(_is([k]), instead or [ast.Pass()], []))
        if i < len(before):
            without = [k for k, begin, end, _ in there if begin <= i < end]
            line = before[i]
            others = ast.UnaryOp(ast.Not(), _is(without))
            found.append(ast.If(others, [line], []) if without else line)
    return found


def _apart(before: Lines, new: Lines) -> tuple[int, int, Lines]:
    """Return which lines are replaced, from and to before, and a copy of the new."""
    n = min(len(before), len(new))
    begin = next((i for i in range(n) if before[i] is not new[i]), n)
    after = next(
        (i for i in range(n - begin) if before[-1 - i] is not new[-1 - i]), n - begin
    )
    instead = copy.deepcopy(new[begin : len(new) - after])
    return begin, len(before) - after, instead


def _is(numbers: Sequence[int]) -> ast.expr:
    """Return the condition that `AT` is one of some numbers."""
    at = ast.Name(AT, ast.Load())
    if len(numbers) == 1:  # the usual case
        return ast.Compare(at, [ast.Eq()], [ast.Constant(numbers[0])])
    some = ast.Set([ast.Constant(k) for k in numbers])
    return ast.Compare(at, [ast.In()], [some])


def _limit(function: ast.FunctionDef) -> None:
    """Have the loops of a function end that a change may keep going."""
    for node in ast.walk(function):
        if isinstance(node, ast.While):
            step = ast.Call(ast.Name("_robo47_step", ast.Load()), [], [])
            node.test = ast.BoolOp(ast.And(), [step, node.test])


class Asker(Protocol):
    """A student's file with all changes, which answers questions."""

    def ask(self, questions: Sequence[Question], seconds: float) -> Sequence[Reply]:
        """Return one reply per question, for which it has some seconds."""

    def used(self) -> tuple[float, float]:
        """Return for how many seconds it had a processor, and waited for one."""


def repaired(
    asked: Asked, source: str, changes: Changes, asker: Asker, named: bool = False
) -> str:
    """Return which line of a wrong function, changed once, makes it right; or "".

    Args:
        asked: what it was asked, with the replies.
        source: the student's file.
        changes: of the function.
        asker: has the file with the code of the changes.
        named: whether the mistake has a name, and only its place is not known.
    """
    known = [*asked.main, *asked.fresh]
    wrong = [one for one in known if verdict(asked.ask, one) not in (RIGHT, NONE)]
    if len(wrong) < LEAST:
        return ""
    trial = _Trial(asked.ask, changes, asker, asker.used()[0])
    calls = [one.question for one in known]
    holding = trial.screened(wrong[len(wrong) // 2])
    holding = trial.that_hold(holding, [one.question for one in wrong[:FEW]])
    holding = trial.that_hold(holding, calls)
    if not holding:
        return ""
    fresh = islice(drawn(asked.ask, [one.args for one in calls]), FRESH)
    more = [replace(calls[0], args=call) for call in fresh]
    if not asked.ask.accept:
        more += [one.question for held in asked.held_out for one in held]
    holding = trial.that_hold(holding, more)
    but = ANYWHERE if named else set()
    if all(_is_a_multiple(asked.ask, one) for one in wrong[:FEW]):
        but = but | TUNED
    mutants = [one for k in holding if (one := changes.mutants[k - 1]).kind not in but]
    return _told(mutants, source, len(calls) + len(more))


def mends(asked: Asked, changes: Changes, asker: Asker, line: int) -> bool:
    """Return whether a change in one line alone makes all answers right, or may.

    Args:
        asked: what the function was asked, with the replies.
        changes: of the function.
        asker: has the file with the code of the changes.
        line: its number in the student's file.
    """
    known = [*asked.main, *asked.fresh]
    wrong = [one for one in known if verdict(asked.ask, one) not in (RIGHT, NONE)]
    calls = [one.question for one in known]
    trial = _Trial(asked.ask, changes, asker, asker.used()[0])
    every = enumerate(changes.mutants, 1)
    there = [k for k, one in every if {span[0] for span in one.spans} == {line}]
    holding = trial.that_hold(there, [one.question for one in wrong[:1]])
    return any(trial.that_hold([k], calls) for k in holding) or trial.over(MORE)


class _Trial(NamedTuple):
    """Changes that are tried, within a limit of the processor's time."""

    row: Ask
    changes: Changes
    asker: Asker
    began: float  # s

    def over(self, times: float = 1.0) -> bool:
        """Return whether the time is over, or some times of it."""
        return self.asker.used()[0] - self.began > times * SECONDS

    def screened(self, wrong: Exchange) -> list[int]:
        """Return the numbers of changes that make one wrong answer right."""
        question, found = wrong.question, list[int]()
        right = right_answers(self.row, [wrong])
        (unchanged,) = self._ask([0], question)
        if _gives(self.row, question, unchanged, right):
            return found  # it is another function that was asked
        numbers = range(1, len(self.changes.mutants) + 1)
        for at in range(0, len(numbers), AT_ONCE):
            some = numbers[at : at + AT_ONCE]
            pairs = zip(some, self._ask(some, question), strict=False)
            found += [k for k, it in pairs if _gives(self.row, question, it, right)]
            if len(found) >= SCREENED or self.over():
                break
        return found[:SCREENED]

    def that_hold(self, some: Sequence[int], calls: Sequence[Question]) -> list[int]:
        """Return those of some changes that make every one of some answers right."""
        return [k for k in some if not self.over(MORE) and self._holds(k, calls)]

    def _holds(self, k: int, calls: Sequence[Question]) -> bool:
        came = self.asker.ask([self.changes.ask(k, one) for one in calls], CALL)
        pairs = zip(calls, came, strict=True)
        return all(_is_right(self.row, call, reply) for call, reply in pairs)

    def _ask(self, some: Sequence[int], question: Question) -> Sequence[Reply]:
        return self.asker.ask([self.changes.ask(k, question) for k in some], CALL)


def _gives(row: Ask, question: Question, reply: Reply, right: Parts) -> bool:
    """Return whether a reply is the right answer."""
    if reply.kind:
        return False
    S = read([Exchange(question, reply)], row)
    if isinstance(S, Finding):
        return False
    same = all(s.shape == t.shape for s, t in zip(S, right, strict=True))
    return same and float(row.gaps(S, right).max()) <= row.tolerance


def _is_a_multiple(row: Ask, wrong: Exchange) -> bool:
    """Return whether a wrong answer of several numbers is the right one times one."""
    S, right = read([wrong], row), right_answers(row, [wrong])
    if isinstance(S, Finding):
        return False
    mine, its = (np.concatenate([np.ravel(x) for x in some]) for some in (S, right))
    if (
        mine.shape != its.shape
        or np.count_nonzero(its) < 2
        or not np.isfinite(mine).all()
    ):
        return False
    factor = (mine @ its) / (its @ its)
    return bool(np.abs(mine - factor * its).max() <= MATCHES * np.abs(mine).max())


def _is_right(row: Ask, question: Question, reply: Reply) -> bool:
    return not reply.kind and verdict(row, Exchange(question, reply)) in (RIGHT, NONE)


def _told(mutants: Sequence[Mutant], source: str, calls: int) -> str:
    """Return where the changes are that make all answers right; "" if anywhere."""
    copies = _copies(source)
    mutants = [
        one
        for one in mutants
        if _is_in_one_line(one)
        and not (one.kind in OF_A_VALUE and one.spans[0][0] in copies)
    ]
    near = [mutant for mutant in mutants if mutant.rank < FAR]
    found = near or mutants
    found = sorted(found, key=lambda mutant: mutant.rank)
    numbers = list(dict.fromkeys(mutant.spans[0][0] for mutant in found))
    if not 1 <= len(numbers) <= LINES:
        return ""
    text = source.splitlines()
    lines = " or in ".join(_line(n, text[n - 1]) for n in numbers)
    says = f"One change in {lines} makes all {calls} results correct that were tried."
    kinds = {mutant.kind for mutant in near}
    what = PARTS.get(kinds.pop(), "") if len(kinds) == 1 else ""
    return f"{says} Check {what} there." if what else says


def _is_in_one_line(mutant: Mutant) -> bool:
    """Return whether all places of a change begin in the same line."""
    return len({span[0] for span in mutant.spans}) == 1


def _copies(source: str) -> set[int]:
    """Return the lines that only take a value, as `w = J[:3]` does.

    What is computed with it later is as likely to have the wrong sign.
    """
    lines = (one for one in ast.walk(ast.parse(source)) if isinstance(one, ast.Assign))
    return {
        line.lineno for line in lines if not any(map(_computes, ast.walk(line.value)))
    }


def _computes(node: ast.AST) -> bool:
    """Return whether an expression makes another value of what it takes."""
    if isinstance(node, ast.Call):
        return called(node) not in TAKES
    return isinstance(node, ast.BinOp | ast.UnaryOp | ast.Compare)


def _line(number: int, text: str) -> str:
    """Return a line by its number, and as it is written if that is short."""
    code = text.partition("  # ")[0].strip()
    whole = all(code.count(one) == code.count(two) for one, two in ("()", "[]"))
    short = whole and len(code) <= LONG
    return f"line {number}, `{code}`," if short else f"line {number}"
