import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # also under -P
import kit

sys.path[0] = kit.ROOT  # in scripts/, this file would hide the package of its name

from bench.command import main  # noqa: E402
from labkit.base import cli  # noqa: E402

cli.run(main)
