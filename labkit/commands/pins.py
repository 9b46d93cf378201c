"""Write the versions of constraints.txt into pyproject.toml, where uv reads them.

    python3 scripts/make_pins.py     after each change of constraints.txt

`pip` takes a file of constraints and `uv sync` does not: it resolves again on each
machine, held to the versions that stand in pyproject.toml. The lock that it makes names
the package index of that machine, so git ignores it.
"""

import re

from labkit.base import cli
from labkit.base.store import replace
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

CONSTRAINTS, PROJECT = ROOT / "constraints.txt", ROOT / "pyproject.toml"
LIST = re.compile(r"(?<=^constraint-dependencies = \[\n).*?(?=^\]$)", re.M | re.S)


def pins(constraints: str) -> list[str]:
    """Return the requirements of a file of constraints, without its comments.

    Args:
        constraints: its text.

    Returns:
        "name==version", or "name==version; marker" with single quotes, in its order,
        each once.
    """
    lines = (line.partition("#")[0].strip() for line in constraints.splitlines())
    spaced = (re.sub(r"\s*;\s*", "; ", line) for line in lines if line)
    return list(dict.fromkeys(line.replace('"', "'") for line in spaced))


def with_pins(project: str, constraints: str) -> str:
    """Return the text of pyproject.toml with the versions of constraints.txt.

    Args:
        project: the text of pyproject.toml.
        constraints: the text of constraints.txt.

    Raises:
        Robo47Error: the list that is replaced is not there.
    """
    listed = "".join(f'    "{pin}",\n' for pin in pins(constraints))
    text, found = LIST.subn(lambda _: listed, project)
    if found != 1:
        raise Robo47Error(
            f"{shown(PROJECT)} has {found} lists `constraint-dependencies = [`; one"
            " is needed, under [tool.uv]: write it, then run this again."
        )
    return text


def main() -> int:
    """Write them, and say how many there are."""
    cli.parser(__doc__).parse_args()
    constraints = CONSTRAINTS.read_text("utf-8")
    replace(PROJECT, with_pins(PROJECT.read_text("utf-8"), constraints).encode())
    print(f"{shown(PROJECT)}: {len(pins(constraints))} versions, for uv")
    return cli.EXIT_OK
