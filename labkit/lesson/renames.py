"""A lab's text with the names that functions and arguments have now.

A name is renamed where Python finds the kit's function, or the argument, by it: in no
comment, no string, and not where a variable of the student's has the same name.
"""

import ast
import re
from collections.abc import Iterator, Mapping

from labkit.lesson.day import Day, all_days

Place = tuple[int, int]  # a line, from 1, and a column of it, in bytes
Edits = dict[Place, tuple[str, str]]  # the old and the new name at each place


def called_as_now(day: Day, text: str) -> str:
    """Return a lab's text in which functions of its day and of others are named as now.

    Args:
        day: whose lab it is, from the newer kit's manifest.
        text: a student's lab, or an older one of the kit's.
    """
    tree = _tree(text)
    if tree is None:  # it does not load yet: definitions and calls alone
        for old, new in _own(day).items():
            text = re.sub(rf"(?<![.\w]){old}(?=\()", new, text)
        return text
    edits: Edits = {}
    defined = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    for old, new in _own(day).items():
        if old in defined:
            edits.update(_global(tree, text, old, new))
    for old, module, new in _of_other_days(day):
        edits.update(_imported(tree, old, module, new))
    return _edited(text, edits)


def arguments_as_now(text: str, before: str, now: str) -> str:
    """Return a lab's text in which functions have their arguments named as now.

    Where a new name is taken in a function it keeps all of its old ones: the checker
    and the lab give arguments by position.

    Args:
        text: a student's lab, or the older one of the kit's that it began with.
        before: that older one.
        now: the kit's newer one.
    """
    tree = _tree(text)
    old, new = _arguments(before), _arguments(now)
    edits: Edits = {}
    for node in tree.body if tree else ():
        if not isinstance(node, ast.FunctionDef):
            continue
        pairs = zip(old.get(node.name, ()), new.get(node.name, ()), strict=False)
        own = {arg.arg for arg in node.args.args}
        renamed = {a: b for a, b in pairs if a != b and a in own}
        if not set(renamed.values()) & (_names(node) - set(renamed)):
            edits.update(_inside(node, renamed))
    return _edited(text, edits)


def _own(day: Day) -> dict[str, str]:
    return {old: new for task in day.tasks for old, new in task.renamed if old != new}


def _of_other_days(day: Day) -> Iterator[tuple[str, str, str]]:
    """Yield functions of other days: old name, a module that has it, new name."""
    for other in all_days():
        for old, new in _own(other).items() if other.number != day.number else ():
            yield from ((old, module, new) for module in other.library)


def _tree(text: str) -> ast.Module | None:
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _arguments(text: str) -> dict[str, list[str]]:
    """Return the arguments' names of a text's functions."""
    tree = _tree(text)
    body = tree.body if tree else []
    functions = (node for node in body if isinstance(node, ast.FunctionDef))
    return {node.name: [arg.arg for arg in node.args.args] for node in functions}


def _at(node: ast.Name | ast.arg | ast.alias) -> Place:
    return node.lineno, node.col_offset


def _names(node: ast.AST) -> set[str]:
    """Return the names of all variables and arguments in a piece of code."""
    found = {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}
    return found | {n.arg for n in ast.walk(node) if isinstance(n, ast.arg)}


def _bound(node: ast.AST) -> set[str]:
    """Return the names that a function binds itself."""
    inside = list(ast.walk(node))[1:]
    names = (n for n in inside if isinstance(n, ast.Name))
    stored = {n.id for n in names if isinstance(n.ctx, ast.Store)}
    stored |= {n.name for n in inside if isinstance(n, ast.FunctionDef)}
    return stored | {n.arg for n in inside if isinstance(n, ast.arg)}


def _free(tree: ast.AST, name: str) -> Iterator[ast.Name]:
    """Yield where a name means the module's, and not a function's own."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Name) and node.id == name:
            yield node
        own = isinstance(node, (ast.FunctionDef, ast.Lambda)) and name in _bound(node)
        if not own:
            yield from _free(node, name)


def _global(tree: ast.Module, text: str, old: str, new: str) -> Edits:
    """Return the edits of a function of the text's own."""
    edits = {_at(use): (old, new) for use in _free(tree, old)}
    lines = text.encode().splitlines()
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and node.name == old:
            at = lines[node.lineno - 1].index(old.encode(), node.col_offset + 3)
            edits[node.lineno, at] = (old, new)
    return edits


def _imported(tree: ast.Module, old: str, module: str, new: str) -> Edits:
    """Return the edits of a function that the text has from the library."""
    edits: Edits = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module == f"robo47.{module}":
            for alias in (alias for alias in node.names if alias.name == old):
                edits[_at(alias)] = (old, new)
                uses = _free(tree, old) if alias.asname is None else ()
                edits.update((_at(use), (old, new)) for use in uses)
        if not isinstance(node, ast.Attribute) or node.attr != old:
            continue
        if isinstance(node.value, ast.Name) and node.value.id == module:
            at = (node.end_col_offset or 0) - len(old)
            edits[node.end_lineno or 0, at] = (old, new)
    return edits


def _inside(node: ast.FunctionDef, renamed: Mapping[str, str]) -> Edits:
    """Return the edits of a function's arguments, in its head and its body."""
    edits: Edits = {}
    for n in ast.walk(node):
        if isinstance(n, ast.Name) and n.id in renamed:
            edits[_at(n)] = (n.id, renamed[n.id])
        if isinstance(n, ast.arg) and n.arg in renamed:
            edits[_at(n)] = (n.arg, renamed[n.arg])
    return edits


def _edited(text: str, edits: Edits) -> str:
    """Return a text after edits, where it has what each of them replaces."""
    lines = text.encode().splitlines(keepends=True)
    for (line, at), (old, new) in sorted(edits.items(), reverse=True):
        row = lines[line - 1]
        if row[at : at + len(old)] == old.encode():
            lines[line - 1] = row[:at] + new.encode() + row[at + len(old) :]
    return b"".join(lines).decode()
