"""What this machine has and lacks for the labs, line by line, and what to do about it.

    make doctor                       or, without make:
    python3 scripts/doctor.py
    python3 scripts/doctor.py --json  for tools

Paste the output when you ask for help: it holds no home folder and no user name.
Exit code: 0 when all is well, 1 when a line says what to do.
"""

from __future__ import annotations  # it runs on old Pythons too

import json

from labkit.base import cli
from labkit.setup.doctor import Line, examine

MOODS = {"good": "good", "note": "note", "todo": "bad"}


def as_text(line: Line) -> str:
    """Return a finding in 80 columns, what to do on lines of its own."""
    label = f"{line.status:5} {line.about:9} "
    text = cli.wrapped(label + line.found, " " * len(label))
    text = cli.paint(text[:5], MOODS[line.status]) + text[5:]
    if line.remedy:
        text += "\n" + cli.wrapped(" " * 16 + "-> " + line.remedy, " " * 19)
    return text


def main() -> int:
    """Print the findings."""
    parser = cli.parser(__doc__)
    parser.add_argument("--json", action="store_true", help="print JSON")
    options = parser.parse_args()
    lines = examine()
    if options.json:
        print(json.dumps([line._asdict() for line in lines], indent=1))
    else:
        for line in lines:
            print(as_text(line))
    todo = any(line.status == "todo" for line in lines)
    return cli.EXIT_FAILED if todo else cli.EXIT_OK
