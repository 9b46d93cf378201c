"""A complete lab that runs and does not show itself: the scripts of a student edition.

Sealed is not secret: whoever wants to can open it, as they can read the library. It
keeps the answers from being met by chance, by a search or in an editor.
"""

import ast
import base64
import zlib
from typing import Any

MARK = "# sealed: "
_STUB = '''"""{first}

The kit's own answers, sealed: this runs them, and shows none.
Yours: make start DAY={day}
"""

import kit  # noqa: F401 (goes on in the kit's own Python)

from labkit.lesson import sealed

sealed.run(__file__, globals())
'''


def seal(text: str, day: int) -> str:
    """Return a script that runs a complete lab of a day."""
    first = (ast.get_docstring(ast.parse(text)) or "A lab.").splitlines()[0]
    packed = base64.b85encode(zlib.compress(text.encode(), 9)).decode()
    lines = [f"{MARK}{packed[i : i + 78]}" for i in range(0, len(packed), 78)]
    return _STUB.format(first=first, day=day) + "\n".join(lines) + "\n"


def is_sealed(text: str) -> bool:
    """Return whether a script is a sealed one."""
    return f"\n{MARK}" in text


def opened(text: str) -> str:
    """Return the complete lab of a script, which is itself where nothing is sealed."""
    if not is_sealed(text):
        return text
    lines = [ln.removeprefix(MARK) for ln in text.splitlines() if ln.startswith(MARK)]
    return zlib.decompress(base64.b85decode("".join(lines))).decode()


def run(file: str, names: dict[str, Any]) -> None:
    """Run a sealed lab instead of its script, given its `__file__` and `globals()`."""
    with open(file, encoding="utf-8") as script:
        text = opened(script.read())
    exec(compile(text.replace("\nimport kit ", "\n# ", 1), file, "exec"), names)
