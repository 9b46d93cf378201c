"""How values travel between the checker and the sandbox: plain JSON, never pickle.

Reading an array back runs no code, whatever the sender wrote: only a few number types,
a shape and as many bytes as those two call for.
"""

import base64
import math
from typing import Any

import numpy as np

# What a student's function may return. Wider than float64, since an array of integers
# or of 32-bit floats is a mistake (or none) that the judge has words for.
DTYPES = {"f2", "f4", "f8", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "b1"}
LARGEST, PARTS = 3_000_000, 100  # numbers in a question, arrays in an answer


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


def pack_value(value: Any, most: int = LARGEST) -> Any:
    """Return what a student's function returned as JSON.

    Raises:
        UnsendableError: not None, a number, an array, or a tuple or list of those; or
            more than so many numbers.
    """
    if value is None:
        return None
    if isinstance(value, (np.ndarray, np.generic, float, int)):
        return {"array": pack_array(np.asarray(value), most)}
    if isinstance(value, (tuple, list)) and value:
        plain = (np.ndarray, np.generic, float, int)
        arrays = any(isinstance(item, np.ndarray) for item in value)
        if arrays and all(isinstance(item, plain) for item in value):
            parts = [np.asarray(item) for item in value[:PARTS]]
            if sum(part.size for part in parts) > most:
                raise UnsendableError(f"{len(parts)} arrays, far too large together")
            return {"tuple": list(map(pack_array, parts))}
        try:
            return {"array": pack_array(np.array(value), most)}
        except ValueError:  # rows of different lengths
            raise UnsendableError(
                f"a {type(value).__name__} that is no array"
            ) from None
    raise UnsendableError(f"a {type(value).__name__}; expected a NumPy array")


def unpack_value(packed: Any, most: int = LARGEST) -> Any:
    """Return None, an array or a tuple of arrays; a ValueError where it is none."""
    if packed is None:
        return None
    if isinstance(packed, dict) and "array" in packed:
        return unpack_array(packed["array"], most)
    parts = packed.get("tuple") if isinstance(packed, dict) else None
    if isinstance(parts, list) and len(parts) <= PARTS:
        return tuple(unpack_array(part, most) for part in parts)
    raise ValueError("not a packed value")


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
