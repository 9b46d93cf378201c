"""Mutants: a right body with one place of it changed, compiled when it is asked for.

An author thinks of a named mistake; a machine makes a mutant: a sign is reversed, a
factor is left out, two lines are exchanged. Whether a wrong function has such a change
is found by comparing its answers with those of the mutant.
"""

import ast
import inspect
import textwrap
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain, combinations
from typing import Any

from labkit.judge import effort, limits, operators, statements
from labkit.judge.answers import content, own
from labkit.judge.operators import Place, places

SHORT = 44  # characters of a body that are shown, at most
FAR = 100  # rank of the far operators, after all near ones
KEPT = 8  # calls of a right function whose steps are remembered
TOGETHER = 40  # mutants of one place that are compiled together
CHOICE = "_choice_"  # the name that says which of them is called
Code = Callable[..., Any]
Edits = Sequence[tuple[Any, Any]]  # a `Place` or a `Block`, and what stands there
Span = tuple[int, int, int, int]  # line and column, and those of the end
# The kinds of change, those first that are made most often.
KINDS = [
    "sign", "order", "left-out", "operation", "sign-lost", "name", "index", "number",
    "factor", "negated", "bracket", "transpose", "inverse", "squared", "exchanged",
    "scaled", "function", "condition", "line", "clamp", "norm", "root", "unit",
    "rounded", "diagonal", "entries", "entry-zero", "entry-twice", "entry-some",
    "added",
]  # fmt: skip


@dataclass(frozen=True, eq=False)
class Mutant:
    """A body that differs in one place, or in all places of one kind."""

    kind: str  # one of `KINDS`
    body: "Body"
    rank: int  # how early it is tried; the ones that are made often come first
    # Where something else stands, and what.
    edits: Edits
    first: "Mutant | None" = None  # beside which it is made, as the second of two

    @property
    def code(self) -> Callable[..., Any] | None:
        """The changed function, compiled now; None where Python does not take it."""
        if self.first is None:
            with self.made():
                return self.body.compiled(self.edits)
        with self.first.made(), self.made():
            return self.body.compiled([*self.first.edits, *self.edits])

    @contextmanager
    def made(self) -> Iterator[None]:
        """Have the body changed for a while."""
        for place, new in self.edits:
            for node in new if isinstance(new, list) else [new]:
                _located(node, place.node)
            place.put(new)
        try:
            yield
        finally:
            for place, _ in reversed(self.edits):
                place.put(place.node if isinstance(place, Place) else place.before)

    @cached_property
    def spans(self) -> list[Span]:
        """The places in the text that are changed."""
        return [_span(_spot(place, self.kind)) for place, _ in self.edits]

    def overlaps(self, other: "Mutant") -> bool:
        """Return whether one change lies within the place of the other."""
        if self.body is not other.body:
            return True
        pairs = ((a, b) for a in self.spans for b in other.spans)
        return any(not (a[2:] <= b[:2] or b[2:] <= a[:2]) for a, b in pairs)

    def statement(self) -> ast.stmt | None:
        """Return the changed statement of the body, while it is made."""
        place, new = self.edits[0]
        if isinstance(place, statements.Block):
            fresh = [one for one in new if one not in place.before]
            return fresh[0] if len(fresh) == 1 else None
        for node in ast.walk(self.body.function):
            if isinstance(node, ast.stmt) and any(n is new for n in _own_parts(node)):
                return node
        return None

    def around(self, k: int = 0) -> list[ast.expr]:
        """Return the k-th changed expression and those around it, while it is made."""
        at, new = self.edits[k]
        found = [new] * isinstance(new, ast.expr)
        while found and at and isinstance(at.parent, ast.expr):
            found.append(at.parent)
            at = self.body.above.get(id(at.parent))
        return found

    @property
    def text(self) -> str:
        """How the first changed place reads, "theta + s"; "" where that is long."""
        if self.first:
            with self.first.made():
                return replace(self, first=None).text
        place, new = self.edits[0]
        with self.made():
            if isinstance(place, Place):
                return _shown(new, place, self.body.above)
            return statements.shown(new, place, 2 * SHORT)


@dataclass(frozen=True, eq=False)
class Body:
    """The body of a right function."""

    function: ast.FunctionDef  # changed for a while, and put back
    space: dict[str, Any]  # the names of its module
    own: bool = True  # whether it is the lab's
    name: str = ""  # of the function of the lab
    # What a line is, by its number, as the comment behind it says.
    glosses: Mapping[int, str] = field(default_factory=dict)
    steps: limits.Steps = field(default_factory=limits.Steps)
    traced: dict[Any, limits.Measured] = field(default_factory=dict)  # by call

    def __post_init__(self) -> None:
        """Take a namespace of its own; what decorates the function is left out."""
        self.function.decorator_list.clear()
        for one in (*self.function.args.args, *self.function.args.kwonlyargs):
            one.annotation = None
        self.function.returns = None
        guarded = {"np": limits.numpy(self.steps)} if "np" in self.space else {}
        self.space.update(guarded | {limits.STEP: self.steps})

    @cached_property
    def names(self) -> list[str]:
        """The names of the arguments and of what the body makes."""
        some = (n for n in ast.walk(self.function) if isinstance(n, ast.Name))
        made = [n.id for n in some if isinstance(n.ctx, ast.Store)]
        return list(dict.fromkeys([*self.arguments, *made]))

    def meaning(self, name: str) -> str:
        """Return what a variable is, as the gloss of the line that sets it says."""
        some = (n for n in ast.walk(self.function) if isinstance(n, ast.Assign))
        lines = (n.lineno for n in some if _sets(n, name))
        return next((self.glosses[n] for n in lines if n in self.glosses), "")

    @property
    def arguments(self) -> list[str]:
        """The names of the arguments."""
        return [one.arg for one in self.function.args.args]

    @cached_property
    def places(self) -> list[Place]:
        """Where the expressions stand that may be changed."""
        body = self.function.body[bool(ast.get_docstring(self.function)) :]
        assigned = [t for one in ast.walk(self.function) if isinstance(one, ast.Assign)
                    for t in one.targets]  # fmt: skip
        stored = {id(node) for target in assigned for node in ast.walk(target)}
        left = ("annotation", "ctx", "targets", "target")
        return [
            place
            for statement in body
            for place in places(statement)
            if place.field not in left
            and (isinstance(place.node, ast.Constant) or id(place.node) not in stored)
        ]

    @cached_property
    def above(self) -> dict[int, Place]:
        """Where each expression stands, by its id."""
        return {id(place.node): place for place in self.places}

    @cached_property
    def loops(self) -> list[Any]:
        """What may go on for long."""
        return limits.loops([self.function])

    def calibrate(self, call: Sequence[Any]) -> None:
        """Have the limits follow what the right function takes at a call.

        What the last calls took is kept.
        """
        key = tuple(map(content, call))
        if key not in self.traced and (code := self.compiled()):
            while len(self.traced) >= KEPT:
                del self.traced[next(iter(self.traced))]
            work = effort.work(self.function, self.space)
            self.steps.calibrate(lambda: code(*map(own, call)), work)
            self.traced[key] = self.steps.measured
        elif key in self.traced:
            self.steps.measured = self.traced[key]

    def compiled(self, edits: Edits = ()) -> Callable[..., Any] | None:
        """Return the function as it stands now, with a limit of its steps.

        Args:
            edits: that are made; their loops count their steps, too.
        """
        limited = limits.limited([*self.loops, *self._loops_of(edits)])
        try:
            exec(compile(ast.Module([self.function], []), "<mutant>", "exec"),
                 self.space)  # fmt: skip
        except (SyntaxError, ValueError, TypeError):
            return None
        finally:
            for undo in limited:
                undo()
        code = self.space[self.function.name]
        return self.steps.limiting(code) if self.loops else code

    def _loops_of(self, edits: Edits) -> list[Any]:
        """Return the loops that edits bring; an expression only has copied ones."""
        if not self.loops:
            return []
        some = [
            new if isinstance(new, list) else [new] * (id(at.node) in self._with_loops)
            for at, new in edits
        ]
        return limits.loops(chain.from_iterable(some))

    @cached_property
    def _with_loops(self) -> set[int]:
        """The ids of the expressions that hold a comprehension."""
        return {id(one.node) for one in self.places if limits.loops([one.node])}

    @cached_property
    def near(self) -> list[Mutant]:
        """What a hand may mistype in one place; the likeliest come first."""
        found = [*self._by(operators.near, 0), *self._of_lines(far=False)]
        return sorted(found, key=lambda one: one.rank)

    def closest(self) -> Iterator[tuple[Mutant, Code]]:
        """Yield the near mutants with their functions."""
        yield from self.ready(self.near)

    def further(self) -> Iterator[tuple[Mutant, Code]]:
        """Yield all other mutants with their functions."""
        yield from chain.from_iterable(map(self.ready, self.far()))

    def far(self) -> Iterator[list[Mutant]]:
        """Yield all mutants that are not near, those that are made together at once."""
        yield list(_everywhere(self.near))
        yield list(self._of_lines(far=True))
        for place in self.places:
            yield list(self._at(operators.far, place, FAR))

    def besides(self, first: Mutant) -> list[tuple[Mutant, Code]]:
        """Return the near mutants that have another change as well, elsewhere."""
        with first.made():
            changed = replace(self)
            some = [Mutant(o.kind, self, o.rank, o.edits, first) for o in changed.near]
            return self.ready([one for one in some if not one.overlaps(first)])

    def ready(self, some: Sequence[Mutant]) -> list[tuple[Mutant, Code]]:
        """Return mutants with their functions, those of one place compiled together."""
        there: dict[int, list[Mutant]] = defaultdict(list)
        for one in some:
            place, new = one.edits[0]
            if len(one.edits) == 1 and isinstance(place, Place) and _alone(place, new):
                there[id(place.node)].append(one)
        codes: dict[int, Code] = {}
        for alike in there.values():
            for at in range(0, len(alike), TOGETHER):
                codes |= self._together(alike[at : at + TOGETHER])
        found = ((one, codes.get(id(one)) or one.code) for one in some)
        return [(one, code) for one, code in found if code]

    def _together(self, some: Sequence[Mutant]) -> dict[int, Code]:
        """Return the functions of mutants of one place, by the mutants' ids."""
        place = some[0].edits[0][0]
        whole: Any = place.node
        for k, one in enumerate(some):
            new = one.edits[0][1]
            _located(new, place.node)
            chosen = ast.Compare(ast.Name(CHOICE, ast.Load()), [ast.Eq()],
                                 [ast.Constant(k)])  # fmt: skip
            whole = ast.IfExp(chosen, new, whole)
        with Mutant("", self, 0, [(place, whole)]).made():
            code = self.compiled([one.edits[0] for one in some])
        if code is None:  # one of them is no Python
            return {}
        return {id(one): self._chosen(code, k) for k, one in enumerate(some)}

    def _chosen(self, code: Code, k: int) -> Code:
        def call(*args: Any) -> Any:
            self.space[CHOICE] = k
            return code(*args)

        return call

    def _by(self, some: Any, later: int) -> Iterator[Mutant]:
        """Yield the mutants that a set of operators makes."""
        for place in self.places:
            yield from self._at(some, place, later)

    def _at(self, some: Any, place: Place, later: int) -> Iterator[Mutant]:
        """Yield those of one place."""
        filled = self._filled_by(place)
        names = [name for name in self.names if name != filled]
        for kind, new in some(place, names):
            yield self._mutant(self._kind(kind, place), place, new, later)

    def _filled_by(self, place: Place) -> str:
        """Return the list that a place is appended to, by its name; "" where none is.

        A list that holds itself is an array without an end.
        """
        around: Place | None = place
        while around:
            owner = getattr(getattr(around.parent, "func", None), "value", None)
            if isinstance(owner, ast.Name) and owner is not place.node:
                return owner.id
            around = self.above.get(id(around.parent))
        return ""

    def _of_lines(self, far: bool) -> Iterator[Mutant]:
        for block, new, is_far in statements.changes(self.function):
            if is_far == far:
                yield self._mutant("line", block, new, FAR * far)

    def _mutant(self, kind: str, place: Any, new: Any, later: int = 0) -> Mutant:
        return Mutant(kind, self, later + KINDS.index(kind), [(place, new)])

    def _kind(self, kind: str, place: Place) -> str:
        """Return the kind of a change: in a condition, what is changed hardly shows."""
        around: Place | None = place
        while around:
            if isinstance(around.node, ast.Compare) or around.field == "test":
                return "condition"
            around = self.above.get(id(around.parent))
        above = self.above.get(id(place.parent))
        return "index" if "slice" in (place.field, above and above.field) else kind


def _everywhere(mutants: Sequence[Mutant]) -> Iterator[Mutant]:
    """Yield the same change made at every place of its kind, in each line say."""
    alike: dict[tuple[str, ...], list[Mutant]] = defaultdict(list)
    for one in mutants:
        ((place, new),) = one.edits
        if one.rank < FAR and (what := _what(place.node)):
            alike[(one.kind, what, _how(new, place.node))].append(one)
    for some in alike.values():
        apart = not any(a.overlaps(b) for a, b in combinations(some, 2))
        if len(some) > 1 and apart:
            edits = [one.edits[0] for one in some]
            yield Mutant(some[0].kind, some[0].body, some[0].rank + 1, edits)


def _what(node: ast.AST) -> str:
    """Return what a place holds, without its operands; "" where that says little."""
    match node:
        case ast.Name():
            return node.id
        case ast.Constant():
            return repr(node.value)
        case ast.BinOp():
            return type(node.op).__name__
        case ast.Attribute():
            return f".{node.attr}"
        case ast.Call():
            return f"{operators.called(node)}()"
        case _:
            return ""


def _how(new: Any, node: ast.AST) -> str:
    """Return how an expression is made of the parts of another one."""
    children = list(ast.iter_child_nodes(node))
    below = chain.from_iterable(map(ast.iter_child_nodes, children))
    parts = [node, *children, *(one for one in below if isinstance(one, ast.expr))]
    if found := [k for k, part in enumerate(parts) if part is new]:
        return f"#{found[0]}"
    if not isinstance(new, ast.AST):
        return repr(new)
    some = (value for _, value in ast.iter_fields(new))
    lists = (value if isinstance(value, list) else [value] for value in some)
    inner = ",".join(_how(one, node) for each in lists for one in each)
    return f"{type(new).__name__}({inner})"


def _located(new: ast.AST, where: ast.AST) -> None:
    """Give what is new in a tree a place in the text."""
    if "lineno" in new._attributes:
        if hasattr(new, "lineno"):
            return
        ast.copy_location(new, where)
    for name in new._fields:
        value = getattr(new, name)
        for one in value if isinstance(value, list) else (value,):
            if isinstance(one, ast.AST):
                _located(one, where)


def _sets(line: ast.Assign, name: str) -> bool:
    target = line.targets[0]
    return isinstance(target, ast.Name) and target.id == name


def _own_parts(statement: ast.stmt) -> Iterator[ast.AST]:
    """Yield the expressions of a statement, without those of statements within it."""
    left: list[ast.AST] = [statement]
    while left:
        for node in ast.iter_child_nodes(left.pop()):
            if not isinstance(node, ast.stmt):
                yield node
                left.append(node)


def is_alone(mutant: Mutant) -> bool:
    """Return whether each change may stand wherever an expression may, or a line."""
    some = ((at, new) for at, new in mutant.edits if isinstance(at, Place))
    return all(_alone(place, new) for place, new in some)


def _alone(place: Place, new: ast.expr) -> bool:
    """Return whether an expression may stand wherever one may: a slice may not."""
    some = (place.node, new)
    inner = (n for one in some if isinstance(one, ast.Tuple) for n in one.elts)
    return not any(isinstance(n, ast.Slice | ast.Starred) for n in (*some, *inner))


def _spot(place: Place | statements.Block, kind: str) -> Any:
    """Return what a change is about: of a sum's sign the term behind it."""
    node = place.node
    return node.right if kind == "sign" and isinstance(node, ast.BinOp) else node


def _span(node: Any) -> Span:
    return node.lineno, node.col_offset, node.end_lineno or 0, node.end_col_offset or 0


def _shown(new: ast.expr, place: Place, above: dict[int, Place]) -> str:
    """Return the changed place with what stands around it, if that is short."""
    text = ast.unparse(new)
    around: Place | None = place
    while around and isinstance(around.parent, ast.expr):
        if len(wider := ast.unparse(around.parent)) > SHORT:
            break
        text = wider
        around = above.get(id(around.parent))
    dots = ast.Name("...", ast.Load())
    if len(text) > SHORT and isinstance(new, ast.BinOp):
        text = ast.unparse(ast.BinOp(dots, new.op, new.right))
    elif text.isidentifier() and isinstance(place.parent, ast.BinOp):
        pair = (new, dots) if place.field == "left" else (dots, new)
        text = ast.unparse(ast.BinOp(pair[0], place.parent.op, pair[1]))
    if isinstance(place.parent, ast.Assign):
        text = f"{ast.unparse(place.parent.targets[0])} = {text}"
    return text if len(text) <= SHORT else ""


def glosses(text: str) -> dict[int, str]:
    """Return the comments that stand behind code in a text, by their lines' numbers.

    A gloss on the first line of a statement belongs to all of its lines without one.
    """
    found = {}
    for number, line in enumerate(text.splitlines(), 1):
        code, _, comment = line.partition("  # ")
        if code.strip() and comment and not comment.startswith(("noqa", "fmt", "type")):
            found[number] = comment.strip().rstrip(".")
    for one in ast.walk(ast.parse(text)):
        if isinstance(one, _ONE_STEP) and (first := found.get(one.lineno)):
            lines = range(one.lineno, (one.end_lineno or one.lineno) + 1)
            found |= {n: found.get(n, first) for n in lines}
    return found


_ONE_STEP = (ast.Assign, ast.AugAssign, ast.Return)


def body_of(
    code: Callable[..., Any], name: str, commented: bool = False
) -> Body | None:
    """Return the body of a function of a module; None where it is none or no text.

    Args:
        code: the function.
        name: of the lab's function that it does the same as.
        commented: whether the comment behind a line states what the line is.
    """
    names = code.__code__.co_freevars if inspect.isfunction(code) else None
    if names is None:
        return None
    try:
        text = textwrap.dedent(inspect.getsource(code))
        tree = ast.parse(text).body[0]
    except (OSError, TypeError, SyntaxError):
        return None
    if not isinstance(tree, ast.FunctionDef):
        return None
    cells = (cell.cell_contents for cell in code.__closure__ or ())
    inner = dict(zip(names, cells, strict=True))
    says = glosses(text) if commented else {}
    space = {**code.__globals__, **inner}
    return Body(tree, space, own=False, name=name, glosses=says)
