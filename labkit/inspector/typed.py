"""Numbers as people type them: 0.5, pi/2, -3*pi/4, 90 deg, 90°, 1e-3."""

import ast
import math
import operator
import re
from collections.abc import Callable

LONGEST, MOST = 60, 2_000  # characters of a number, of a configuration
TURN = 2 * math.pi
_DEGREES = re.compile(r"\s*(deg|degrees?|°)\s*$", re.IGNORECASE)
_BINARY: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


def number(text: str) -> float:
    """Return the number that a text stands for.

    Args:
        text: a sum or product of numbers and pi; degrees with `deg` or ° behind it.

    Raises:
        ValueError: it stands for no finite number; the message is for the person.
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
    """Return the numbers of a configuration, radians and metres.

    Args:
        text: as one types it or as NumPy prints it: "[0, -pi/4, 0, -90 deg, 0, 2, 1]".
        count: how many there must be.

    Raises:
        ValueError: the message is for the person.
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
