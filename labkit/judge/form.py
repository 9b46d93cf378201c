"""How a student's function is written, beside a right one: in its form, or in another.

A mutant of a right function says "a term is missing". Of a student's function in
another form, which gives the same numbers, that sentence may be about nothing that it
has. Two forms are compared by what they are made of, without names: operators, called
functions, loops and conditions.
"""

import ast
from collections import Counter
from collections.abc import Sequence

from labkit.judge.mutant import Mutant
from labkit.judge.operators import called

LIKE = 0.5  # share of two functions' parts that they have in common, to be of one form
Parts = Counter[str]
BLOCKS = (ast.For, ast.While, ast.If, ast.IfExp, ast.comprehension, ast.Subscript)


def parts_of(function: ast.FunctionDef) -> Parts:
    """Return what the body of a function is made of."""
    body = function.body[bool(ast.get_docstring(function)) :]
    nodes = (node for line in body for node in ast.walk(line))
    return Counter(part for node in nodes for part in _parts(node))


def _parts(node: ast.AST) -> list[str]:
    """Return what one expression or statement adds, without what is inside it."""
    match node:
        case ast.BinOp() | ast.UnaryOp() | ast.AugAssign():
            return [type(node.op).__name__]
        case ast.Compare():
            return [type(op).__name__ for op in node.ops]
        case ast.Call():
            return [f"{called(node)}()"]
        case ast.Attribute(attr="T" | "mT"):
            return [".T"]
        case _:
            return [type(node).__name__] * isinstance(node, BLOCKS)


def is_of_its_form(
    own: ast.FunctionDef, mutant: Mutant, others: Sequence[ast.FunctionDef]
) -> bool:
    """Return whether a student's function has, or visibly lacks, what a mutant changes.

    It does where no right function is more like it than the mutant's, or half of their
    parts are the same. In another form it does where the change brings the parts of the
    right function nearer to those of the student's: a division less, say.

    Args:
        own: the student's function.
        mutant: a change of a right function.
        others: all right functions.
    """
    mine, right = parts_of(own), parts_of(mutant.body.function)
    most = max((_alike(mine, parts_of(one)) for one in others), default=0.0)
    if _alike(mine, right) >= min(LIKE, most):
        return True
    with mutant.made():
        changed = parts_of(mutant.body.function)
    return _stands(mutant.text, own) or _apart(mine, changed) < _apart(mine, right)


def is_like(own: ast.FunctionDef, right: ast.FunctionDef) -> bool:
    """Return whether half of the parts of two functions are the same."""
    return _alike(parts_of(own), parts_of(right)) >= LIKE


def _stands(text: str, own: ast.FunctionDef) -> bool:
    """Return whether a changed expression, and no mere name, stands in a function."""
    return bool(text) and not text.isidentifier() and text in ast.unparse(own)


def _alike(one: Parts, other: Parts) -> float:
    """Return which share of the parts of two functions both have."""
    every = (one | other).total()
    return (one & other).total() / every if every else 1.0


def _apart(one: Parts, other: Parts) -> int:
    """Return how many parts only one of two functions has."""
    return (one - other).total() + (other - one).total()
