"""An experiment with a hunted script: its run, or one call of its functions.

What the run says of the suspicion is shown beside what was expected of it.
"""

import os
import re
import subprocess
import sys
import textwrap
from itertools import zip_longest
from typing import Any

from labkit.base import cli
from labkit.base.text import count
from labkit.hunt.case import Case

LEFT, RIGHT = 32, 42  # columns of what was expected and of what the run says
SHOWN = 6  # failing checks that are shown beside it
CALL = """
import importlib, sys
from pathlib import Path
script = Path(sys.argv[1])
sys.path.insert(0, str(script.parent))
import numpy as np
np.set_printoptions(linewidth=76, precision=6, suppress=True)
names = dict(vars(importlib.import_module(script.stem)))

def array(argument):
    # A list or tuple of numbers is the array that a lab would pass.
    if not isinstance(argument, (list, tuple)):
        return argument
    try:
        return np.asarray(argument, dtype=float)
    except (TypeError, ValueError):  # of something else than numbers
        return argument

def typed(function):
    return lambda *given, **named: function(
        *map(array, given), **{name: array(it) for name, it in named.items()}
    )

for name, it in list(names.items()):
    if getattr(it, "__module__", "") == script.stem and callable(it):
        names[name] = it if isinstance(it, type) else typed(it)
try:
    print(eval(sys.argv[2], names))
except Exception as error:
    sys.exit(f"it stops: {type(error).__name__}: {error}")
"""


def run(case: Case) -> list[str]:
    """Run the hunted script, count it, and return its lines."""
    case.runs += 1
    case.save()
    sys.stdout.flush()
    lines = []
    # u: a line is to be seen when it is printed
    command = [sys.executable, "-u", str(case.script)]
    how: dict[str, Any] = {"encoding": "utf-8", "errors": "replace"}
    own = {**os.environ, "PYTHONIOENCODING": "utf-8"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, env=own, **how) as process:
        for line in process.stdout or ():
            lines.append(line.rstrip("\n"))
            print(painted(lines[-1]), flush=True)
    if process.returncode not in (cli.EXIT_OK, cli.EXIT_FAILED):
        lines.append("  FAIL  it stops before its end")  # it said why itself
    return lines


def painted(line: str) -> str:
    """Return a line of a run with its verdict in its colour."""
    found = re.match(r"(\s*)(PASS|FAIL)(.*)", line)
    return f"{found[1]}{cli.verdict(found[2] == 'PASS')}{found[3]}" if found else line


def call(case: Case, text: str) -> int:
    """Make one call, such as "ad([0, 0, 1, 0, 0, 0])", and print what it returns.

    A list or a tuple of numbers is passed as an array, as the labs pass it.
    """
    sys.stdout.flush()
    command = [sys.executable, "-c", CALL, str(case.script), text]
    return subprocess.run(command, check=False).returncode


def side_by_side(expected: str, lines: list[str]) -> str:
    """Return what was expected beside what a run says, in 80 columns.

    Args:
        expected: in somebody's own words; "" is shown as "(nothing said)".
        lines: of the run.
    """
    found = [
        line.split(None, 1) for line in lines if line[:6].strip() in ("PASS", "FAIL")
    ]
    failing = [words[1] for words in found if words[0] == "FAIL"]
    says = []
    for check in failing[:SHOWN]:
        says += textwrap.wrap(f"FAIL  {check}", RIGHT, subsequent_indent="      ")
    if len(failing) > SHOWN:
        says.append(f"and {len(failing) - SHOWN} more FAIL")
    says.append(f"{count(len(found) - len(failing), 'check')} PASS")
    if not found:
        says = _rows(lines)
    hoped = textwrap.wrap(expected or "(nothing said)", LEFT)
    head = f"  {'you expected':{LEFT}}  the run says"
    rows = zip_longest(hoped, says, fillvalue="")
    return "\n".join([head, *(f"  {a:{LEFT}}  {b}".rstrip() for a, b in rows)])


def _rows(lines: list[str]) -> list[str]:
    """Return the rows of a capstone, below its head: numbers, or why it stopped."""
    text = " ".join(" ".join(lines).split())
    _, _, rows = text.partition("these functions")
    wrong, _, right = rows.rpartition("right ones")
    row = {"these functions": wrong, "right ones": right}
    return [
        line
        for name, says in row.items()
        for line in textwrap.wrap(f"{name}{says}", RIGHT, subsequent_indent="  ")
    ]
