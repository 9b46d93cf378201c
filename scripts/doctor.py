"""Findings about this machine; the code is labkit/commands/doctor.py."""

# Old Pythons read this first: no f-strings and no annotations.
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OWN = os.path.join(ROOT, ".venv", "bin", "python")
if sys.version_info < (3, 8):  # labkit cannot be read by it
    if os.path.exists(OWN):
        os.execv(OWN, [OWN] + sys.argv)
    print("todo  Python    {}.{}, no .venv".format(*sys.version_info[:2]))
    print("                -> The kit needs 3.11 or newer: install it, then")
    print("                   make day1 PYTHON=python3.13")
    sys.exit(int(os.environ.get("ROBO47_NOT_YET", 1)))
sys.path.insert(0, ROOT)  # bare Pythons too
from labkit.base import shell

shell.leave(ROOT)
from labkit.base import cli
from labkit.commands import doctor

cli.run(doctor.main)
