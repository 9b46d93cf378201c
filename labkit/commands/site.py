"""Build the course as a site of static pages, in `_site/`.

    make site                            build it
    python3 scripts/build_site.py        the same
    python3 scripts/build_site.py --notebooks 1 8   run two days' notebooks
    python3 -m http.server -d _site      look at it: http://localhost:8000

It shows the repository's documents; a warning, or a link that leads nowhere, is
an error, and so is a notebook's cell that fails. The arm's page needs Node.js, and its
packages: npm ci --prefix site.
"""

import time
from pathlib import Path

from labkit.base import cli
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown


def main() -> int:
    """Build the site and say how large it is."""
    parser = cli.parser(__doc__)
    parser.add_argument("--out", type=Path, default=ROOT / "_site", metavar="FOLDER")
    parser.add_argument(
        "--notebooks", type=cli.day, nargs="*", metavar="DAY", help="default: all days"
    )
    options = parser.parse_args()
    try:
        from labkit.site.build import build
    except ModuleNotFoundError as missing:
        raise Robo47Error(
            f"the site needs {missing.name}, which is not installed yet: make site"
        ) from None
    begun = time.monotonic()
    build(options.out.resolve(), options.notebooks)
    files = [path for path in options.out.rglob("*") if path.is_file()]
    pages = sum(path.suffix == ".html" for path in files)
    size = sum(path.stat().st_size for path in files) / 1e6
    what = f"{pages} pages, {size:.1f} MB, {time.monotonic() - begun:.0f} s"
    print(f"{shown(options.out.resolve())}: {what}")
    return cli.EXIT_OK
