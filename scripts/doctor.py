"""What this machine has and lacks for the labs, line by line, and what to do about it.

    make doctor                       or, without make:
    python3 scripts/doctor.py
    python3 scripts/doctor.py --json  for tools

Paste the output when you ask for help: it holds no home folder and no user name.
Exit code: 0 when all is well, 1 when a line says what to do.
"""

from __future__ import annotations

import argparse
import json
import sys
import textwrap
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))  # bare Pythons too

from robo47.doctor import Line, examine


def as_text(line: Line) -> str:
    """Return a finding in 80 columns, what to do on a line of its own."""
    label = f"{line.status:5} {line.about:9} "
    text = textwrap.fill(label + line.found, 79, subsequent_indent=" " * len(label))
    return text + (f"\n{'':16}-> {line.remedy}" if line.remedy else "")


def main() -> int:
    """Print the findings."""
    about, usage = (__doc__ or "").split("\n", 1)
    parser = argparse.ArgumentParser(
        description=about,
        epilog=usage,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--json", action="store_true", help="print JSON")
    options = parser.parse_args()
    lines = examine()
    if options.json:
        print(json.dumps([line._asdict() for line in lines], indent=1))
    else:
        for line in lines:
            print(as_text(line))
    return 1 if any(line.status == "todo" for line in lines) else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BrokenPipeError:  # `... | head` closed early
        sys.stdout = None
