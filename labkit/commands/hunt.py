"""Find the bug: a correct lab with one mistake, in work/hunt/.

    make hunt DAY=4               begin a hunt, or continue the last one
    make hunt DAY=4 LEVEL=2       one of the week; you see only the capstone
    make hunt DAY=4 LEVEL=3       two functions of the day are wrong
    make hunt DAY=4 SEED=7        the same mistake for a whole class
    make hunt ARGS=--run          run the hunted lab
    make hunt ARGS="--call 'ad([0, 0, 1, 0, 0, 0])'"
    make hunt ARGS="--suspect mass_matrix --expect 'M is not symmetric'"
    make hunt ARGS=--judge        test your suspicion and your repair
    make hunt ARGS=--give-up      show the mistake

The functions of the hunted script are sealed. Call them, print their results, and
compare these with a calculation by hand or with MuJoCo. State the symptom that you
expect if your suspicion is right, and then test it. Write the suspected function again
in its place; --judge checks the function that you wrote.
Exit code: 0 found or nothing to judge, 1 not yet, 2 it could not run.
"""

import argparse
import contextlib
import secrets
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from labkit import log
from labkit.base import cli
from labkit.base.text import count
from labkit.check import memory
from labkit.hunt import case as cases
from labkit.hunt import experiment, tally
from labkit.hunt.case import Case
from labkit.hunt.mistakes import LEVELS
from labkit.hunt.script import closed_capstone, closed_lab, closed_names, kit_beside
from labkit.lesson.day import Day, chosen_day
from labkit.lesson.starter import require_kits
from robo47.errors import Robo47Error
from robo47.paths import shown

if TYPE_CHECKING:
    from labkit.hunt.verdict import Repair

HOW = "Type a call, such as ad([0, 0, 1, 0, 0, 0]); Enter alone runs the whole script."
SUSPECT = "Which function do you suspect? "
EXPECT = "What do you expect to see if this is the fault? "
DO = """
  make hunt ARGS=--run       run the script and see the symptoms
  make hunt                  name the function that you suspect, then test it
  make hunt ARGS=--judge     check the function after you have written it again
  make hunt ARGS=--give-up   show the mistake
  make hunt ARGS=--help      explain all options"""


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = cli.parser(__doc__)
    add = parser.add_argument
    add("day", type=cli.day, nargs="?", help="default: the one worked on last")
    add("--level", type=int, choices=sorted(LEVELS), help="default: 1")
    add("--seed", type=int, metavar="N", help="which mistake; default: any")
    add("--anew", action="store_true", help="begin another hunt")
    add("--run", action="store_true", help="run the hunted script")
    add("--call", metavar="CALL", help="call one of its functions")
    add("--suspect", metavar="FUNCTION", help="which one you suspect")
    add("--expect", metavar="TEXT", default="", help="to see, if it is that one")
    add("--judge", action="store_true", help="look at your repair")
    add("--give-up", action="store_true", help="say which one it was")
    add("--write-seen", action="store_true", help=argparse.SUPPRESS)
    return parser.parse_args()


def draw(day: Day, options: argparse.Namespace) -> Case:
    """Draw a mistake; of one's own, none that the checker has named already."""
    require_kits(day)
    given = options.seed is not None
    known = [] if given else sorted({m.mistake for m in memory.journal()} - {""})
    seed = options.seed if given else secrets.randbelow(1_000_000)
    return cases.draw(day, options.level or 1, seed, known)


def begin(case: Case) -> None:
    """Write the hunted script of a hunt that begins."""
    day = case.of_day
    folder = cases.folder_of(day)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "kit.py").write_text(kit_beside(day), "utf-8")
    if case.level == 2:
        days = cases.days_hunted(day, case.level)
        text = closed_capstone(day, days, case.script.stem)
    else:
        text = closed_lab(day)
    _keep(case.script)
    case.script.write_text(text, "utf-8")
    case.save()


def _keep(script: Path) -> None:
    """Keep what somebody wrote in an earlier hunt beside the new one."""
    if script.is_file():
        script.replace(script.with_suffix(".before.txt"))


def leave(day: Day) -> None:
    """Note that a hunt of this week that is not over makes room for another."""
    with contextlib.suppress(Robo47Error):  # a broken file: nothing is known of it
        case = cases.read(cases.folder_of(day))
        if case and not case.ended and case.runs + case.checks:
            end(case, tally.LEFT)
            level = f" LEVEL={case.level}" if case.level != 1 else ""
            again = f"make hunt DAY={case.day}{level} SEED={case.seed}"
            print(f"Left: the hunt of day {case.day}. To hunt again: {again}\n")


def end(case: Case, how: str, innocent: tuple[str, ...] = ()) -> None:
    """Keep that a hunt is over, and write its row."""
    case.ended = how
    row = tally.row_of(case, innocent)
    case.save()
    log.append_rows([row])


def tell(case: Case) -> None:
    """Say how a hunt stands, and what one can do."""
    head = f"Day {case.day}, level {case.level}: {LEVELS[case.level]}. Seed {case.seed}"
    print(cli.wrapped(head, "  "))
    print(f"  {shown(case.script)}")
    done = f"{count(case.runs, 'run')}, {count(case.checks, 'check')} so far"
    print(f"  {done}")
    for function, expected in case.suspected:
        words = f"  suspected: {function}; expected: {expected or '-'}"
        print(cli.wrapped(words, "    "))
    print(DO)


def rewritten(case: Case, function: str) -> list[str]:
    """Return the functions that are written anew; refuse a name of none.

    Raises:
        Robo47Error: the hunted script has no such function.
    """
    days = cases.days_hunted(case.of_day, case.level)
    shut, written = closed_names(case.script, days)
    if function not in shut + written:
        names = ", ".join(shut + written)
        raise Robo47Error(f"{function!r} is no function of this hunt: {names}")
    return written


def suspect(case: Case, function: str, expected: str) -> None:
    """Keep a suspicion and what it lets one expect; run, and show both side by side.

    Raises:
        Robo47Error: the hunted script has no such function.
    """
    written = function in rewritten(case, function)
    case.suspected.append([function, expected])
    lines = experiment.run(case)
    print(f"\nYou suspect {function}.")
    print(experiment.side_by_side(expected, lines))
    where = f"write {function} anew in {shown(case.script)}, and: "
    where = "it is written anew already: " if written else where
    print(cli.wrapped(f"\nDoes it fit? Then {where}make hunt ARGS=--judge"))


def ask(case: Case) -> int:
    """Ask for the suspected function and for what it would show, then run."""
    tell(case)
    print(f"\n{HOW}")
    try:
        function = suspected(case)
        if not function:
            experiment.run(case)
            return cli.EXIT_OK
        expected = answer_to(EXPECT)
    except EOFError:
        print()
        return cli.EXIT_OK
    suspect(case, function, expected)
    return cli.EXIT_OK


def suspected(case: Case) -> str:
    """Return the function that is named at last, "" for none; calls are made meanwhile.

    A name that the script does not have is answered, and the question is asked again.
    """
    while function := answer_to(SUSPECT):
        if "(" in function:
            experiment.call(case, function)
            continue
        try:
            rewritten(case, function)
        except Robo47Error as error:
            print(cli.wrapped(str(error)))
        else:
            break
    return function


def answer_to(question: str) -> str:
    """Return what somebody answers, without what a terminal adds."""
    return "".join(c for c in input(question) if c.isprintable()).strip()


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
        print(cli.wrapped(f"{one.function}: {verdict_sentence(one)}"))
    if not is_found(case, repaired):
        case.save()
        missing = len(case.mistakes) - sum(one.guilty for one in repaired)
        left = f"{count(missing, 'function')} left to find; " if missing > 0 else ""
        return cli.conclude(False, f"{left}{count(case.runs, 'run')} so far")
    reveal(case)
    if not case.named:
        print("You never said whom you suspect: next time, first say what you expect.")
    end(case, tally.FOUND, tuple(r.function for r in repaired if not r.guilty))
    asked = f"{count(case.runs, 'run')} and {count(case.checks, 'check')}"
    return conclude(True, f"found in {asked}")


def verdict_sentence(one: "Repair") -> str:
    """Return what is said of a function that was written anew."""
    if not one.guilty:
        return "not it; it was right as it was."
    if one.verdict.status == "passed":
        return "that is it, and yours is right."
    return f"that is it, but yours is not right yet. {one.verdict.message}"


def reveal(case: Case) -> None:
    """Say what the mistake was."""
    print()
    for one in case.mistakes:
        says = one.says or "its numbers say it"
        print(cli.wrapped(f"The mistake in {one.function}, {one.slug}: {says}."))


def conclude(passed: bool, says: str) -> int:
    """Say how it ended, and how all hunts of the log did."""
    done = cli.conclude(passed, says)
    print(f"All your hunts: {tally.tally(log.read_rows())}. Another: make hunt")
    return done


def give_up(case: Case) -> int:
    """Say which one it was, and keep that it was not repaired."""
    reveal(case)
    end(case, tally.NAMED if case.named else tally.GAVE_UP)
    how = "named, not repaired" if case.named else "not found"
    return conclude(False, f"{how}; {count(case.runs, 'run')}")


def going_on(options: argparse.Namespace) -> Case | None:
    """Return the hunt that a command line means; None where one is to begin."""
    if options.anew:
        return None
    given = options.day is not None
    case = cases.read(cases.folder_of(chosen_day(options.day))) if given else None
    case = case if given else cases.latest()
    if case is None or case.ended:
        return None
    asked = (options.day, options.level, options.seed)
    now = (case.day, case.level, case.seed)
    same = all(a in (None, b) for a, b in zip(asked, now, strict=True))
    return case if same else None


def go_on(case: Case, options: argparse.Namespace) -> int:
    """Do what is asked of a hunt that has begun."""
    if not case.script.is_file():
        raise Robo47Error(f"{shown(case.script)} is gone: make hunt ARGS=--anew")
    if options.call:
        return cli.EXIT_FAILED if experiment.call(case, options.call) else cli.EXIT_OK
    if options.run:
        experiment.run(case)
    elif options.suspect:
        suspect(case, options.suspect, options.expect)
    elif options.judge:
        return judge(case)
    elif options.give_up:
        return give_up(case)
    elif sys.stdin is not None and sys.stdin.isatty():
        return ask(case)
    else:
        tell(case)
    return cli.EXIT_OK


def write_seen(day: Day) -> int:
    """Write down which mistakes a week's capstone shows; for authors, in minutes."""
    from labkit.hunt.capstone_trials import write_all

    print(write_all(day, print))
    return cli.EXIT_OK


def main() -> int:
    """Begin a hunt, or go on with one."""
    options = parse()
    if options.write_seen:
        return write_seen(chosen_day(options.day))
    if case := going_on(options):
        return go_on(case, options)
    doing = (options.run, options.call, options.suspect, options.judge, options.give_up)
    if any(doing):
        raise Robo47Error("no such hunt is begun: make hunt DAY=4 begins one")
    day = chosen_day(options.day)
    new = draw(day, options)
    leave(day)
    begin(new)
    tell(new)
    return cli.EXIT_OK
