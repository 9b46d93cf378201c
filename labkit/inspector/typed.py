"""A configuration as people type it, and in the page's address.

Numbers are 0.5, pi/2, -3*pi/4, 90 deg, 90°, 1e-3. By the address a person reloads a
configuration, goes back to it, shares it.
"""

import ast
import math
import operator
import re
import urllib.parse
from collections.abc import Callable

import numpy as np

from robo47.checks import Array

LONGEST, MOST = 60, 2_000  # characters of a number, of a configuration
TURN = 2 * math.pi
FARTHEST = 100.0  # radians or metres; no address leads further
_DEGREES = re.compile(r"\s*(deg|degrees?|°)\s*$", re.IGNORECASE)
_BINARY: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


def number(text: str) -> float:
    """Return what a sum or product of numbers and pi is; `deg` or ° may follow it.

    Raises:
        ValueError: it is no finite number; the message is for the person.
    """
    plain = text[: LONGEST + 1].replace("π", "pi").replace("−", "-")
    bare = _DEGREES.sub("", plain)
    try:
        if len(text) > LONGEST:
            raise ValueError
        value = _value(ast.parse(bare.strip(), mode="eval").body)
    except (ValueError, SyntaxError, ZeroDivisionError, OverflowError, RecursionError):
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f"“{text[:LONGEST]}” is no number; write 0.5, pi/2 or 90 deg")
    return value if bare == plain else math.radians(value)


def configuration(text: str, count: int) -> list[float]:
    """Return a configuration's numbers, as typed or as NumPy prints them.

    Raises:
        ValueError: they are not `count` numbers; the message is for the person.
    """
    plain = text[:MOST].strip().removeprefix("np.array(").strip()
    if plain.startswith("["):
        plain = plain[1:].rstrip("]), \n")
    numbers = [number(part) for part in plain.split(",")]
    if len(numbers) != count:
        raise ValueError(f"{len(numbers)} numbers; a configuration has {count}")
    if wild := [part for part in numbers if abs(part) > TURN]:
        raise ValueError(f"{wild[0]:g} rad is over a turn; for degrees write: 90 deg")
    return numbers


def _value(node: ast.expr) -> float:
    """Return the value of a parsed text; only what is listed here is understood."""
    if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
        return float(node.value)
    if isinstance(node, ast.Name) and node.id.lower() == "pi":
        return math.pi
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
        value = _value(node.operand)
        return -value if isinstance(node.op, ast.USub) else value
    if isinstance(node, ast.BinOp) and type(node.op) in _BINARY:
        return _BINARY[type(node.op)](_value(node.left), _value(node.right))
    raise ValueError


def write_address(q: Array, frame: str, tab: str) -> str:
    """Return the query behind the page's address; every digit of q, (nq,), is kept."""
    numbers = ",".join(f"{float(x)!r}".removesuffix(".0") for x in q)
    query = {"q": numbers, "frame": frame, "tab": tab}
    return "?" + urllib.parse.urlencode(query, safe=",")


def read_address(query: str, nq: int) -> tuple[Array | None, str, str]:
    """Return q or None, frame and tab of "?q=...&frame=...&tab=..." or of anything."""
    given = urllib.parse.parse_qs(query.removeprefix("?"))
    frame, tab = (given.get(name, [""])[0] for name in ("frame", "tab"))
    try:
        q = np.array([float(x) for x in given.get("q", [""])[0].split(",")])
    except ValueError:
        q = np.empty(0)
    there = q.shape == (nq,) and bool((np.abs(q) <= FARTHEST).all())
    return q if there else None, frame, tab
