"""Add a row to the metrics log from the shell, or look after the log.

    python3 scripts/log_metric.py day=1 check=fk_identity_check metric=inv_err \\
        value=2.2e-16 notes="after the fix"
    python3 scripts/log_metric.py --check      every bad line, and why
    python3 scripts/log_metric.py --restore    rows that were refused, put back
    python3 scripts/log_metric.py --convert    a log in a spreadsheet's form,
                                               converted to the log's own

check=, metric= and value= are needed; date= and git_sha= are filled in. The
other fields: run_id day seed config method n_trials n_failures notes.
"""

import argparse
from pathlib import Path

from labkit.base import cli
from labkit.base.text import count
from labkit.log import append_row
from labkit.log.convert import convert
from labkit.log.logfile import command, restore, unsaved_rows
from labkit.log.rows import checked_row
from labkit.log.scan import Line, came_back, watched
from robo47.errors import Robo47Error
from robo47.paths import shown

NEEDED = ("check", "metric", "value")
EXAMPLE = "check=fk_identity_check metric=inv_err value=2.2e-16"


def main() -> int:
    """Do the one thing that the command line asks for."""
    args = parser().parse_args()
    if args.fields and (args.check or args.restore or args.convert):
        says = "give fields to add a row, or one of --check, --restore and --convert."
        raise Robo47Error(says)
    if args.check:
        return show_check(args.file)
    if args.restore:
        print(f"{count(restore(args.file), 'row')} put back into {shown(args.file)}")
        return cli.EXIT_OK
    if args.convert:
        rows, kept = convert(args.file)
        print(f"{count(rows, 'row')} written; the old file is {shown(kept)}")
        return cli.EXIT_OK
    fields = parse(args.fields, args.allow_nonfinite)
    row = append_row(
        args.file, sync=args.sync, allow_nonfinite=args.allow_nonfinite, **fields
    )
    says = f"{row['check']} {row['metric']} = {row['value']}"
    print(f"added to {shown(args.file)}: {says}")
    return cli.EXIT_OK


def parser() -> argparse.ArgumentParser:
    """Return the command line's description."""
    it = cli.parser(__doc__)
    it.add_argument("fields", nargs="*", metavar="FIELD=VALUE", help="one row's cells")
    does = it.add_mutually_exclusive_group()
    does.add_argument("--check", action="store_true", help="list every bad line")
    does.add_argument("--restore", action="store_true", help="add refused rows again")
    does.add_argument(
        "--convert", action="store_true", help="write another form of the log again"
    )
    cli.add_log(it)
    it.add_argument(
        "--sync",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="have the row on the disk before returning (default: yes)",
    )
    it.add_argument(
        "--allow-nonfinite", action="store_true", help="record NaN and infinity"
    )
    return it


def parse(given: list[str], allow_nonfinite: bool) -> dict[str, str]:
    """Return the fields of `name=value` words, or say all that is wrong with them."""
    fields: dict[str, str] = {}
    faults = []
    for word in given:
        name, equals, value = word.partition("=")
        if not equals:
            faults.append(f'"{word}" is not FIELD=VALUE')
        elif name in fields:
            faults.append(f'"{name}" is given twice')
        else:
            fields[name] = value
    missing = [name for name in NEEDED if not fields.get(name)]
    if missing:
        faults.append(f"a row needs {', '.join(missing)}")
    faults += checked_row(fields, allow_nonfinite)[1]
    if faults:
        raise Robo47Error(f"not recorded: {'; '.join(faults)}. Example: {EXAMPLE}")
    return fields


def show_check(path: Path) -> int:
    """Print what is wrong with the log; return 1 if anything is."""
    rows, bad = 0, 0
    back = came_back(path)
    notes = []
    for line in watched(path):
        rows += line.row is not None
        if line.problem:
            bad += 1
            print(f"line {line.number}: {line.problem}{end_of(line)}")
        elif line.text in back:
            notes.append(line)
    for line in notes:
        print(
            f"note, line {line.number}: a commit took this row out or edited it, and a"
            f" merge brought it back; remove it if it should go{end_of(line)}"
        )
    if bad:
        print("In an editor, correct or delete them. No other line is affected.")
    waiting = unsaved_rows(path)
    if waiting:
        waits = f"{count(waiting, 'refused row')} {'waits' if waiting == 1 else 'wait'}"
        print(f"{waits}. To add what waits: {command('--restore', path)}")
    print(f"{shown(path)}: {count(rows, 'row')}, {count(bad, 'problem')}")
    return cli.EXIT_FAILED if bad or waiting else cli.EXIT_OK


def end_of(line: Line) -> str:
    """Return a line's last characters, on a line of their own."""
    text = line.text if len(line.text) <= 66 else "..." + line.text[-63:]
    return f"\n    {text}"
