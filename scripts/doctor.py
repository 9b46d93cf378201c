"""What this machine has and lacks for the labs, line by line, and what to do about it.

    make doctor                       or, without make:
    python3 scripts/doctor.py
    python3 scripts/doctor.py --json  for tools

Paste the output when you ask for help: it holds no home folder and no user name.
Exit code: 0 when all is well, 1 when a line says what to do.
"""

# Old Pythons read this first: no f-strings and no annotations.
import json
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OWN = os.path.join(ROOT, ".venv", "bin", "python")
if sys.version_info < (3, 8):  # labkit.setup.doctor cannot be read by it
    if os.path.exists(OWN):
        os.execv(OWN, [OWN] + sys.argv)
    print("todo  Python    {}.{}, no .venv".format(*sys.version_info[:2]))
    print("                -> The kit needs 3.11 or newer: install it, then")
    print("                   make day1 PYTHON=python3.13")
    sys.exit(1)
sys.path.insert(0, ROOT)  # bare Pythons too

from labkit.base import cli
from labkit.setup.doctor import examine

MOODS = {"good": "good", "note": "note", "todo": "bad"}


def as_text(line):
    """Return a finding in 80 columns, what to do on lines of its own."""
    label = "{:5} {:9} ".format(line.status, line.about)
    text = cli.wrapped(label + line.found, " " * len(label))
    text = cli.paint(text[:5], MOODS[line.status]) + text[5:]
    if line.remedy:
        text += "\n" + cli.wrapped(" " * 16 + "-> " + line.remedy, " " * 19)
    return text


def main():
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
    return 1 if any(line.status == "todo" for line in lines) else 0


if __name__ == "__main__":
    try:
        code = main()
        sys.stdout.flush()
    except BrokenPipeError:  # `... | head` closed early
        cli.print_nowhere()
        code = 0
    sys.exit(code)
