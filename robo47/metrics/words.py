"""Words that the log's messages share: how many of what, and which command."""

from pathlib import Path

from robo47.paths import ROOT

OWN_LOG = ROOT / "metrics" / "metrics.csv"


def count(number: int, thing: str) -> str:
    """Return "1 row", "2 rows", "1,000 rows"."""
    return f"{number:,} {thing}" if number == 1 else f"{number:,} {thing}s"


def command(option: str, log: Path) -> str:
    """Return what to type, in the kit's folder, to look after a log.

    Args:
        option: as `--repair`.
        log: named in the command unless it is the kit's own.
    """
    start = f"python3 scripts/log_metric.py {option}"
    path = log.absolute()
    if path == OWN_LOG:
        return start
    name = str(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path)
    return f'{start} --file "{name}"' if " " in name else f"{start} --file {name}"
