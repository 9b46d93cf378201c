"""Measure the speed of the library next to other tools for the same problems.

    make bench                               everything, some minutes
    python3 scripts/bench.py fk lab          only these parts
    python3 scripts/bench.py --table         the last results, nothing is run

Parts: fk (kinematics), ik (its inverse), dynamics (mass matrix, torques, Jacobian, one
configuration), lab (the whole script), growth, metrics (a row of the log), tests (`make
test`), checker (save to verdict), first-minute (a fresh clone; needs the network). All
tools take turns in one run. The results are ratios, because seconds differ from machine
to machine. The command writes bench/results.json and bench/bench.png.
"""

import datetime
import importlib
import json
import platform
import sys
from collections.abc import Iterable
from importlib import metadata
from typing import Any

from bench.table import render
from labkit.base import cli
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

RESULTS = ROOT / "bench" / "results.json"
PICTURE = ROOT / "bench" / "bench.png"
RIVALS = ("roboticstoolbox-python", "modern-robotics", "mink")
PARTS = (
    "fk", "ik", "dynamics", "lab", "growth", "metrics", "tests", "checker",
    "first-minute",
)  # fmt: skip
VERSIONS = ("mujoco", "numpy", "pin", *RIVALS)


def machine() -> dict[str, Any]:
    """Return what the numbers were measured on and with."""
    found = {it.metadata["Name"]: it.version for it in metadata.distributions()}
    return {
        "date": datetime.date.today().isoformat(),
        "machine": f"{platform.system()} {platform.machine()}, {cpu()}",
        "python": platform.python_version(),
        **{name: found.get(name, "not installed") for name in VERSIONS},
    }


def cpu() -> str:
    """Return the processor's name, where the system tells it."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            names = [line.split(":", 1)[1] for line in file if line.startswith("model")]
        return next(name.strip() for name in names if not name.strip().isdigit())
    except (OSError, StopIteration):
        return platform.processor() or "unknown processor"


def measure(parts: Iterable[str], results: dict[str, Any]) -> dict[str, str]:
    """Run parts, write each result when it is there, and go on where one fails.

    Args:
        parts: names of PARTS.
        results: what is known so far; it gets what is measured.

    Returns:
        {part: why it failed}.
    """
    failed = {}
    for part in parts:
        print(f"bench: {part} ...", file=sys.stderr, flush=True)
        module = f"bench.bench_{part.replace('-', '_')}"
        try:
            results[part] = importlib.import_module(module).run()
        except Exception as error:  # whatever a rival raises
            kind = "" if isinstance(error, Robo47Error) else type(error).__name__ + ": "
            failed[part] = kind + " ".join(str(error).split())
            continue
        RESULTS.write_text(json.dumps(results, indent=1) + "\n", "utf-8")
    return failed


def main() -> int:
    """Run the parts that are asked for and keep the results of the others."""
    parser = cli.parser(__doc__)
    parser.add_argument("parts", nargs="*", metavar="PART", help="default: all of them")
    parser.add_argument("--table", action="store_true", help="print the last results")
    options = parser.parse_args()
    unknown = set(options.parts) - set(PARTS)
    if unknown:
        raise Robo47Error(
            f"no part {', '.join(sorted(unknown))}; there are {', '.join(PARTS)}"
        )
    results = json.loads(RESULTS.read_text("utf-8")) if RESULTS.exists() else {}
    if options.table:
        if not results:
            raise Robo47Error(f"no {shown(RESULTS)} yet; run make bench first")
        print(render(results))
        return cli.EXIT_OK
    results["about"] = machine()
    failed = measure(options.parts or PARTS, results)
    if "growth" in results:
        from bench.picture import draw

        draw(results, PICTURE)
    print(render(results, failed))
    for part, why in failed.items():
        has = "has its last result" if part in results else "has no result"
        cli.complain(f"bench: {part} failed, and {has}: {why}")
    return cli.EXIT_FAILED if failed else cli.EXIT_OK
