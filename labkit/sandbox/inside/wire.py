"""The encoding of values between the checker and the sandbox: JSON, never pickle.

Reading an array back runs no code, whatever the sender wrote: only a few number types,
a shape and as many bytes as those two call for. `pack_value` has the one list of what a
function may take and return, in the sandbox, in the lab's run and in the catalogue's
tests.
"""

import base64
import math
from typing import Any

import numpy as np

# A student's function may return these types. The list is wider than float64, since the
# judge has words for an array of integers or of 32-bit floats.
DTYPES = {"f2", "f4", "f8", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "b1", "c16"}
LARGEST, PARTS = 3_000_000, 100  # numbers in a question, results in an answer
DEEP = 2  # the depth to which tuples of unlike things may be nested
WHOLE = 2**63  # a number outside of 64 bits is refused
LONGEST = 1_000  # characters of a text


class UnsendableError(ValueError):
    """A value that does not travel; its text completes "it returned ..."."""


def pack_array(array: np.ndarray, most: int = LARGEST) -> dict[str, Any]:
    """Return an array as JSON; an UnsendableError where it is not plain numbers."""
    plain = np.array(array, copy=True, order="C", subok=False)
    if plain.dtype == np.longdouble:
        plain = plain.astype(np.float64)
    code = plain.dtype.str[1:]
    if code not in DTYPES:
        raise UnsendableError(f"an array of dtype {plain.dtype}; expected float64")
    if plain.size > most:
        raise UnsendableError(f"an array of shape {plain.shape}, far too large")
    data = plain.astype("<" + code).tobytes()
    return {
        "dtype": code,
        "shape": list(plain.shape),
        "data": base64.b64encode(data).decode("ascii"),
    }


def unpack_array(packed: Any, most: int = LARGEST) -> np.ndarray:
    """Return a writable array of what `pack_array` made; a ValueError of a forgery."""
    try:
        code = str(packed["dtype"])
        shape = [int(n) for n in packed["shape"]]
        data = base64.b64decode(packed["data"], validate=True)
    except (TypeError, KeyError, ValueError):
        raise ValueError("not a packed array") from None
    if code not in DTYPES or len(shape) > 8 or min(shape, default=0) < 0:
        raise ValueError(f"not a packed array: {code} {shape}")
    dtype = np.dtype("<" + code)
    size = math.prod(shape)
    if size > most or size * dtype.itemsize != len(data):
        raise ValueError(f"a packed array of {len(data)} bytes for shape {shape}")
    return np.frombuffer(data, dtype).reshape(shape).astype(dtype.newbyteorder("="))


def pack_value(value: Any, most: int = LARGEST, deep: int = DEEP) -> Any:
    """Return what a function takes or returns as JSON; it is read as it was sent.

    What travels: None, True and False, a whole number or a float (Python's or NumPy's),
    a text, an array of plain numbers; a tuple or a list of those, and of such tuples;
    a list of lists that is one array.

    Raises:
        UnsendableError: anything else; or more than so many numbers.
    """
    kind = type(value)
    if value is None:
        return None
    if kind is bool or kind is float or (kind is int and abs(value) < WHOLE):
        return {"number": value}
    if isinstance(value, np.ndarray):
        return {"array": pack_array(value, most)}
    plain = isinstance(value, np.generic) and value.dtype.kind != "c"
    if plain and value.dtype.str[1:] in DTYPES:
        return {"number": value.item(), "dtype": value.dtype.str[1:]}
    if isinstance(value, str):
        return {"text": str(value[:LONGEST])}
    if isinstance(value, (np.generic, float, int)):
        return {"array": pack_array(np.asarray(value), most)}
    if isinstance(value, tuple) and deep and len(value) <= PARTS:
        return {"tuple": _pack_parts(value, most, deep)}
    if isinstance(value, (tuple, list)):
        found = _pack_rows(value, most)
        if found is None and (not deep or len(value) > PARTS):
            raise UnsendableError(f"a {kind.__name__} that is no array of numbers")
        return found or {"list": _pack_parts(value, most, deep)}
    raise UnsendableError(f"a {kind.__name__}; expected a NumPy array")


def _pack_parts(value: Any, most: int, deep: int) -> list[Any]:
    packed = [pack_value(item, most, deep - 1) for item in value]
    if sum(map(_numbers_in, packed)) > most:
        raise UnsendableError(f"{len(value)} arrays, far too large together")
    return packed


def _pack_rows(value: Any, most: int) -> dict[str, Any] | None:
    """Return a list that is one array as JSON, with what its rows are; None if none."""
    name = "tuple" if isinstance(value, tuple) else "list"
    try:
        whole = np.array(value)
    except ValueError:  # rows of different lengths
        return None
    if whole.dtype.kind in "OUS":  # an array of None, of text or of objects
        return None
    levels = 0
    while isinstance(value, (tuple, list)):
        levels += 1
        value = value[0] if len(value) else None
    return {"rows": pack_array(whole, most), "levels": levels, "as": name}


def unpack_value(packed: Any, most: int = LARGEST, deep: int = DEEP) -> Any:
    """Return what `pack_value` was given; a ValueError where that made it not."""
    if packed is None:
        return None
    if isinstance(packed, dict):
        if "array" in packed:
            return unpack_array(packed["array"], most)
        if "number" in packed:
            return _number(packed)
        if "rows" in packed:
            return _rows(packed, most)
        if isinstance(text := packed.get("text"), str):
            return text[:LONGEST]
        form = tuple if "tuple" in packed else list
        parts = packed.get(form.__name__)
        if isinstance(parts, list) and len(parts) <= PARTS and deep:
            return form(unpack_value(part, most, deep - 1) for part in parts)
    raise ValueError("not a packed value")


def _number(packed: dict[str, Any]) -> Any:
    number, code = packed["number"], packed.get("dtype")
    if type(number) not in (bool, int, float) or code not in (None, *DTYPES):
        raise ValueError("not a packed number")
    if code:
        with np.errstate(all="ignore"):
            return np.dtype(code).type(number)
    if isinstance(number, int) and abs(number) >= WHOLE:
        raise ValueError("not a packed number")
    return number


def _rows(packed: dict[str, Any], most: int) -> Any:
    """Return an array as the lists that it was."""
    whole = unpack_array(packed["rows"], most)
    levels = packed.get("levels")
    if type(levels) is not int or not 0 < levels <= max(1, whole.ndim):
        raise ValueError("not packed rows")
    found = _lists(whole, levels)
    return tuple(found) if packed.get("as") == "tuple" else found


def _lists(whole: np.ndarray, levels: int) -> list[Any]:
    """Return an array as a list of lists, so many levels; below them are arrays."""
    if levels == whole.ndim:
        return whole.tolist()  # type: ignore[no-any-return]
    return list(whole) if levels == 1 else [_lists(one, levels - 1) for one in whole]


def _numbers_in(packed: Any) -> int:
    """Return how many numbers a packed value holds."""
    if packed is None:
        return 0
    if parts := packed.get("tuple") or packed.get("list"):
        return sum(map(_numbers_in, parts))
    whole = packed.get("array") or packed.get("rows")
    return math.prod(whole["shape"]) if whole else 1


def unpack_values(some: list[Any], most: int) -> list[Any]:
    """Return each value, or the ValueError that says why it is none.

    It ends at the first that only a forger writes.
    """
    found: list[Any] = []
    for packed in some:
        try:
            found.append(unpack_value(packed, most))
        except ValueError as error:
            found.append(error)
        except Exception:
            break
    return found
