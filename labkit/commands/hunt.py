"""Find the bug: a right lab with one mistake put in, in work/hunt/.

    make hunt DAY=4               begin; with a hunt begun: go on with it
    make hunt DAY=4 LEVEL=2       one of the week; only its capstone is seen
    make hunt DAY=4 LEVEL=3       two functions of the day are wrong
    make hunt DAY=4 SEED=7        the same mistake for a whole class
    make hunt ARGS=--run          run the hunted lab
    make hunt ARGS="--suspect mass_matrix --expect 'M is not symmetric'"
    make hunt ARGS=--judge        is it the function, and does your repair pass?
    make hunt ARGS=--give-up      which one it was

The functions of the hunted script are closed: call them, print, compare with paper or
with MuJoCo. Say what you expect of the run if your suspicion is right, then look. Whom
you suspect you write anew in its place; --judge looks at what you wrote.
Exit code: 0 found or nothing to judge, 1 not yet, 2 it could not run.
"""

import argparse
import secrets
import subprocess
import sys
from pathlib import Path

from labkit import log
from labkit.base import cli
from labkit.base.text import count
from labkit.check import memory
from labkit.hunt import case as cases
from labkit.hunt.case import Case
from labkit.hunt.quarry import LEVELS
from labkit.hunt.script import closed_capstone, closed_lab, kit_beside
from labkit.lesson.day import Day, chosen_day, days_of
from labkit.lesson.starter import require_kits
from robo47.errors import Robo47Error
from robo47.paths import shown

CHECK = "hunt"  # of its row in the log


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = cli.parser(__doc__)
    add = parser.add_argument
    add("day", type=cli.day, nargs="?", help="default: the one worked on last")
    add("--level", type=int, choices=sorted(LEVELS), help="default: 1")
    add("--seed", type=int, metavar="N", help="which mistake; default: any")
    add("--anew", action="store_true", help="begin another hunt")
    add("--run", action="store_true", help="run the hunted script")
    add("--suspect", metavar="FUNCTION", help="which one you suspect")
    add("--expect", metavar="TEXT", default="", help="of the run, if it is that one")
    add("--judge", action="store_true", help="look at your repair")
    add("--give-up", action="store_true", help="say which one it was")
    return parser.parse_args()


def begin(day: Day, options: argparse.Namespace) -> Case:
    """Draw a mistake and write the hunted script."""
    require_kits(day)
    level = options.level or 1
    given = options.seed is not None
    known = [] if given else sorted({m.mistake for m in memory.journal()} - {""})
    seed = options.seed if given else secrets.randbelow(1_000_000)
    case = Case(day.number, level, seed, known)
    case.quarries  # noqa: B018 (says now if there is nothing to draw)
    folder = cases.folder_of(day)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "kit.py").write_text(kit_beside(day), "utf-8")
    if level == 2:
        days = [other for other in days_of(day.week) if other.number <= day.number]
        text = closed_capstone(day, days, case.script.stem)
    else:
        text = closed_lab(day)
    _keep(case.script)
    case.script.write_text(text, "utf-8")
    case.save()
    return case


def _keep(script: Path) -> None:
    """Keep what somebody wrote in an earlier hunt beside the new one."""
    if script.is_file():
        script.replace(script.with_suffix(".before.txt"))


def tell(case: Case) -> None:
    """Say how a hunt stands, and what one can do."""
    print(f"Day {case.day}, level {case.level}: {LEVELS[case.level]}. Seed {case.seed}")
    print(f"  {shown(case.script)}")
    done = f"{count(case.runs, 'run')}, {count(case.checks, 'check')} so far"
    print(f"  {done}")
    for function, expected in case.suspected:
        print(
            cli.wrapped(f"  suspected: {function}; expected: {expected or '-'}", "    ")
        )
    print()
    print("  make hunt ARGS=--run       its run, the symptoms")
    print("  make hunt                  say whom you suspect, then look")
    print("  make hunt ARGS=--judge     once you wrote that function anew")


def run(case: Case) -> None:
    """Run the hunted script and count it."""
    case.runs += 1
    case.save()
    sys.stdout.flush()
    subprocess.run([sys.executable, str(case.script)], check=False)


def suspect(case: Case, function: str, expected: str) -> None:
    """Keep a suspicion and what it lets one expect; run, and show both.

    Raises:
        Robo47Error: the hunted script has no such function.
    """
    names = _names(case)
    if function not in names:
        raise Robo47Error(
            f"{function!r} is no function of this hunt: {', '.join(names)}"
        )
    case.suspected.append([function, expected])
    run(case)
    print(cli.wrapped(f"\nYou suspect {function}."))
    if expected:
        print(cli.wrapped(f"You expected: {expected}"))
    print(cli.wrapped(
        f"Does it fit? Then write {function} anew in {shown(case.script)}, and:"
        " make hunt ARGS=--judge"
    ))  # fmt: skip


def _names(case: Case) -> list[str]:
    from labkit.hunt.script import MARK
    from labkit.lesson.starter import function_lines

    text = case.script.read_text("utf-8-sig", errors="replace")
    asked = [line.split("(")[0][4:] for line in text.splitlines() if line[:4] == "def "]
    days = days_of(case.of_day.week)
    known = {n for day in days for task in day.tasks for n in task.functions}
    shut = [n for n in asked if MARK in "\n".join(function_lines(text, n)[2])]
    return [n for n in asked if n in known or n in shut]


def ask(case: Case) -> int:
    """Ask whom one suspects and what one expects, then run."""
    tell(case)
    print()
    try:
        function = input("Which function do you suspect? (Enter: run only) ").strip()
        if not function:
            run(case)
            return cli.EXIT_OK
        expected = input("What do you expect of the run, if it is that one? ").strip()
    except EOFError:
        return cli.EXIT_OK
    suspect(case, function, expected)
    return cli.EXIT_OK


def judge(case: Case) -> int:
    """Look at what was written anew."""
    from labkit.hunt.verdict import is_found, repairs

    with cli.busy("checking your repair"):
        repaired = repairs(case)
    if not repaired:
        raise Robo47Error(
            f"nothing is written anew in {shown(case.script)}: put your own lines in"
            " the place of the closed function that you suspect"
        )
    case.checks += 1
    for one in repaired:
        if not one.guilty:
            print(cli.wrapped(f"{one.function}: not it; it was right as it was."))
        elif one.verdict.status == "passed":
            print(cli.wrapped(f"{one.function}: that is it, and yours is right."))
        else:
            says = f"{one.function}: that is it, but yours is not right yet. "
            print(cli.wrapped(says + one.verdict.message))
    case.found = is_found(case, repaired)
    case.save()
    if not case.found:
        missing = len(case.quarries) - sum(one.guilty for one in repaired)
        left = f"{count(missing, 'function')} left to find; " if missing > 0 else ""
        return cli.conclude(False, f"{left}{count(case.runs, 'run')} so far")
    print()
    for quarry in case.quarries:
        print(
            cli.wrapped(f"The mistake, {quarry.slug}: {quarry.says or 'see --help'}.")
        )
    write_row(case)
    asked = f"{count(case.runs, 'run')} and {count(case.checks, 'check')}"
    return cli.conclude(True, f"found in {asked}")


def write_row(case: Case) -> None:
    """Write the hunt into the log."""
    wrong = [function for function, _ in case.suspected]
    guilty = {one.function for one in case.quarries}
    row = {
        "run_id": f"hunt_day{case.day}",
        "day": case.day,
        "check": CHECK,
        "seed": case.seed,
        "method": f"level {case.level}",
        "n_trials": case.checks,
        "n_failures": sum(function not in guilty for function in wrong),
        "metric": "runs",
        "value": float(case.runs),
        "notes": f"found {' and '.join(sorted(guilty))}",
    }
    log.append_rows([row])


def give_up(case: Case) -> int:
    """Say which one it was; nothing is logged."""
    for one in case.quarries:
        print(
            cli.wrapped(f"{one.function}, {one.slug}: {one.says or 'no words for it'}.")
        )
    case.found = True
    case.save()
    print("Another one: make hunt")
    return cli.EXIT_FAILED


def main() -> int:
    """Begin a hunt, or go on with one."""
    options = parse()
    day = chosen_day(options.day)
    case = cases.read(cases.folder_of(day)) if not options.anew else None
    asked = options.seed is not None or options.level or options.anew
    other = case is not None and options.day is not None and case.day != options.day
    if case is None or case.found or asked or other:
        if options.run or options.judge or options.suspect or options.give_up:
            raise Robo47Error("no hunt is begun: make hunt DAY=4")
        tell(begin(day, options))
        return cli.EXIT_OK
    if options.run:
        run(case)
        return cli.EXIT_OK
    if options.suspect:
        suspect(case, options.suspect, options.expect)
        return cli.EXIT_OK
    if options.judge:
        return judge(case)
    if options.give_up:
        return give_up(case)
    if sys.stdin.isatty():
        return ask(case)
    tell(case)
    return cli.EXIT_OK
