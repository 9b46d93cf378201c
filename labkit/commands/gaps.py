"""Find what a day's questions miss, and entries that the machine names by itself.

    make gaps DAY=3
    make gaps DAY=3 ARGS=--entries
    make gaps DAY=3 ARGS="--entries --function log_rotation"
    python3 scripts/gaps.py 3

With --entries the command judges each mistake of a function's file without the entry.
If the machine has a name for it, the command prints both sentences. "shown" means that
the machine's sentence shows the change: delete the entry if this says as much. "kind"
means that it only says what kind of change it is. A verdict is the one that a student
gets when all the entries that are printed are deleted.

Without --entries the command is a mutation test of the questions.
The command changes the body of each function, one change at a time: it doubles every
constant, reverses every comparison and moves its limit, omits every clip, abs, max and
min, clips the arguments and the answer or removes their signs, and rounds the answer to
float32. It asks the row's questions of each changed function, in this process, and
prints the changes that all questions accept. If a change is no mistake, give the reason
in the function's file: row.same("x < 1e-9 => x < 2e-09", "why"). The slips of a student
are another list, in `labkit/judge/operators.py`.
Exit code: 0 every change is detected, 1 some are not, 2 could not run.
"""

import ast
import inspect
import signal
import sys
import textwrap
import warnings
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from labkit.author.by_machine import told_by_machine
from labkit.base import cli
from labkit.base.exchange import Exchange, Reply
from labkit.judge.answers import gaps, own
from labkit.judge.ask import Asked, as_plain, asked_of, right_answers
from labkit.judge.mistake import Finding
from labkit.judge.operators import places
from labkit.judge.replies_read import not_accepted, read
from labkit.judge.row import Row, rows_of
from labkit.lesson.day import Day, day_numbers, find_day
from robo47.errors import Robo47Error

LEFT_OUT = ("clip", "abs", "max", "min", "maximum", "minimum")
PUT_IN = (
    "np.abs({0})",
    "np.maximum({0}, 0)",
    "np.clip({0}, -1, 1)",
    "{0}.astype(np.float32)",
)
_TURNED = {ast.Lt: ast.GtE, ast.LtE: ast.Gt, ast.Gt: ast.LtE, ast.GtE: ast.Lt}
SECONDS = 5  # the limit of one call; a slower call counts as detected
SEED = 47  # the seed of the sampled inputs


class Change(NamedTuple):
    """A body that differs in one place, until the next one is asked for."""

    says: str  # "x < 1e-9 => x < 2e-09"
    tree: ast.Module


def changes(source: str) -> Iterator[Change]:
    """Yield a function's changes, one at a time.

    Args:
        source: of the function, as it stands in a file.
    """
    tree = ast.parse(textwrap.dedent(source))
    function = tree.body[0]
    assert isinstance(function, ast.FunctionDef)
    statements = _statements(tree)
    for place in places(tree):
        around = statements[id(place.parent)]
        before = _line(around)
        for new in _instead(place.node):
            place.put(new)
            yield Change(f"{before} => {_line(around)}", tree)
            place.put(place.node)
    begins = bool(ast.get_docstring(function))
    for how in PUT_IN:
        for arg in function.args.args if "float32" not in how else []:
            line = f"{arg.arg} = {how.format(arg.arg)}"
            function.body.insert(begins, ast.parse(line).body[0])
            yield Change(f"first {line}", tree)
            del function.body[begins]
        for place in places(tree):
            if isinstance(place.parent, ast.Return) and _depends(place.node):
                text = how.format(f"({ast.unparse(place.node)})")
                new = ast.parse(text, mode="eval").body
                place.put(new)
                yield Change(f"return {text}", tree)
                place.put(place.node)


def _depends(node: ast.expr) -> bool:
    """Return whether an expression holds a name; np.zeros(3) is what it is."""
    names = {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}
    return bool(names - {"np"})


def _instead(node: ast.expr) -> Iterator[ast.expr]:
    """Yield what may stand in an expression's place."""
    value = getattr(node, "value", None)
    if isinstance(node, ast.Constant) and type(value) in (int, float):
        yield ast.Constant(2 * value if value else 1)
    elif isinstance(node, ast.Compare) and len(node.ops) == 1:
        if turned := _TURNED.get(type(node.ops[0])):
            yield ast.Compare(node.left, [turned()], node.comparators)
            end = node.comparators[0]
            by = ast.Add() if _is_0(end) else ast.Mult()
            for step in (1e-3, -1e-3) if _is_0(end) else (0.5, 10.0):
                limit = ast.BinOp(ast.Constant(step), by, end)
                yield ast.Compare(node.left, node.ops, [limit])
    elif isinstance(node, ast.Call) and node.args:
        name = getattr(node.func, "attr", getattr(node.func, "id", ""))
        if name in LEFT_OUT:
            method = isinstance(node.func, ast.Attribute) and not (
                isinstance(node.func.value, ast.Name) and node.func.value.id == "np"
            )
            whole = isinstance(node.func, ast.Attribute) and method
            yield node.func.value if whole else node.args[0]  # type: ignore[attr-defined]


def _is_0(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value == 0


def _statements(tree: ast.Module) -> dict[int, ast.AST]:
    """Return the smallest statement around each node, by the node's id."""
    found: dict[int, ast.AST] = {}
    # Outer nodes come first, so the smallest statement remains.
    for one in ast.walk(tree):
        if isinstance(one, ast.stmt):
            found |= {id(node): one for node in ast.walk(one)}
    return found


def _line(node: ast.AST) -> str:
    """Return a statement's first line, without what stands below it."""
    return ast.unparse(node).splitlines()[0]


def unnoticed(row: Row, function: str) -> Iterator[str]:
    """Yield the changes of a function's body in the lab that no question notices."""
    lab = row.lab
    body = getattr(lab, function)
    asked = asked_of("0.0", function, row.ask, SEED)
    drawn = len(row.ask.edges)
    asked = Asked(
        function, row.ask, asked.main, asked.fresh[:drawn], asked.held_out, []
    )
    for change in changes(inspect.getsource(body)):
        if _by_nature(asked, row, change.says):
            continue
        names = dict(vars(lab))
        try:
            code = compile(ast.fix_missing_locations(change.tree), "<changed>", "exec")
            exec(code, names)
        except Exception:
            continue
        if not _notices(asked, names[function]):
            yield change.says


def _by_nature(asked: Asked, row: Row, change: str) -> bool:
    """Return whether a change makes no difference by the nature of what it changes.

    So it is with the sign of what is never negative, which the row says, and with a
    clip at 1 of what no question makes larger: an axis, a rotation, a share.
    """
    what, _, how = change.partition(" = ")
    where = what.removeprefix("first ") if how else "answer"
    if "np.clip(" in change and change.startswith(("first ", "return ")):
        columns = list(zip(*(one.question.args for one in asked.main), strict=True))
        values = dict(zip(row.arguments, columns, strict=False))
        values["answer"] = right_answers(row.ask, asked.main) if row.ask.truth else ()
        some = [x for x in values.get(where, ()) if isinstance(x, float | np.ndarray)]
        largest = (np.max(np.abs(x), initial=0.0) for x in some)  # some hold nothing
        return bool(some) and all(x <= 1 + 1e-12 for x in largest)
    signs = ("np.abs(", "np.maximum(")
    return where in row.positive and (how or change[7:]).startswith(signs)


def _notices(asked: Asked, function: Callable[..., Any]) -> bool:
    """Return whether some question tells a function from the right one."""
    pairs = zip(asked.ask.held_out, asked.held_out, strict=True)
    held = [one for held, some in pairs if not held.mistaken for one in some]
    signal.signal(signal.SIGALRM, _stop)
    every = (*asked.main, *asked.fresh, *held)
    return any(_wrong(asked, one, function) for one in every)


def _stop(*_: Any) -> None:
    raise TimeoutError


def _wrong(asked: Asked, one: Exchange, function: Callable[..., Any]) -> bool:
    ask = asked.ask
    signal.alarm(SECONDS)
    try:
        with np.errstate(all="ignore"):
            value = function(*map(own, map(as_plain, one.question.args)))
    except Exception:  # it takes too long, too
        return True
    finally:
        signal.alarm(0)
    several = isinstance(value, tuple)
    one.reply = Reply(value=tuple(map(np.asarray, value)) if several else value)
    if not several and value is not None:
        one.reply = Reply(value=np.asarray(value))
    S = read([one], ask)
    if isinstance(S, Finding):
        return True
    if ask.accept:
        alone = Asked(asked.function, ask, [one], [], [], [])
        return any(True for _ in not_accepted(alone))
    return bool(gaps(ask.kinds, S, right_answers(ask, [one])).max() > ask.tolerance)


def of_day(day: Day) -> int:
    """Print what goes unnoticed of a day; return how many changes that are."""
    count = 0
    for function, row in rows_of(day).items():
        found = list(dict.fromkeys(unnoticed(row, function)))
        for change in found:
            if change not in row.unnoticed:
                count += 1
                print(f"day {day.number}, {function}: {change}")
        for change in set(row.unnoticed) - set(found):
            count += 1
            print(
                f"day {day.number}, {function}: noticed, take row.same away: {change}"
            )
    print(f"Day {day.number}: {count or 'no'} changes go unnoticed")
    return count


def print_entries(day: Day, only: str | None = None) -> None:
    """Print the entries of a day that the machine names, and its sentences.

    Args:
        day: whose functions' entries.
        only: the function; None for all.
    """
    rows = rows_of(day)
    if only and only not in rows:
        raise Robo47Error(f"Day {day.number} has no function {only}")
    totals = [0, 0, 0]
    for function, row in rows.items() if not only else [(only, rows[only])]:
        for one in told_by_machine(day, row):
            says = "shown" if one.shown else "kind"
            print(f"day {day.number}, {function}, {one.slug}: {says} ({one.source})")
            print(f"    entry:   {one.entry}\n    machine: {one.machine}", flush=True)
            totals[one.shown] += 1
        totals[2] += sum(not way.reached for way in row.named)
    kind, shown, every = totals
    print(f"Day {day.number}: the machine names {kind + shown} of {every} entries; "
          f"of {shown} it shows the change")  # fmt: skip


def main() -> int:
    """Run the command."""
    parser = cli.parser(__doc__)
    parser.add_argument("day", type=cli.day, nargs="?", help="default: all days")
    parser.add_argument(
        "--entries", action="store_true", help="entries that the machine names itself"
    )
    parser.add_argument("--function", help="with --entries: of this function alone")
    args = parser.parse_args()
    if args.entries:
        for number in [args.day] if args.day else day_numbers():
            print_entries(find_day(number), args.function)
        return 0
    if not hasattr(signal, "SIGALRM"):
        raise Robo47Error("make gaps needs Linux or macOS: it ends a loop by a signal")
    numbers = [args.day] if args.day else day_numbers()
    with warnings.catch_warnings(action="ignore"):
        found = [of_day(find_day(number)) for number in numbers]
    return 1 if any(found) else 0


if __name__ == "__main__":
    sys.exit(main())
