"""How many modules of the kit a script loads, besides itself.

python tests/loaded.py scripts/report_metrics.py --day 1
"""

import runpy
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def loaded():
    files = {getattr(m, "__file__", None) or "/" for m in sys.modules.values()}
    paths = map(Path, files - {__file__, sys.argv[0]})
    return sum(ROOT in path.parents and ".venv" not in path.parts for path in paths)


if __name__ == "__main__":
    sys.argv[:] = [str(Path(sys.argv[1]).resolve()), *sys.argv[2:]]
    sys.path.insert(0, str(Path(sys.argv[0]).parent))
    try:
        runpy.run_path(sys.argv[0], run_name="__main__")
    finally:
        print(f"{loaded()} modules", file=sys.stderr)
