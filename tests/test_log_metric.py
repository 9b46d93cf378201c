"""scripts/log_metric.py, run as a person runs it."""

import subprocess
from functools import partial
from pathlib import Path

import pytest

from labkit.log import append_row, read_rows
from labkit.log.logfile import OWN_LOG, command
from labkit.log.rows import HEADER as LINE
from robo47.paths import ROOT

pytestmark = pytest.mark.kit

SCRIPT = "scripts/log_metric.py"
OLD = "r,2026-09-01,1,fk,abc1234,0,home,manual,1,0,err,1e-16,note"
FIELDS = ("check=fk", "metric=err", "value=1e-16")


@pytest.fixture
def log(tmp_path: Path) -> Path:
    return tmp_path / "metrics.csv"


@pytest.fixture
def run(run, log):
    """Run the script on this log."""
    return partial(run, SCRIPT, "--file", log, COLUMNS="80")


def test_a_row_is_added_from_the_shell(log, run):
    done = run("day=1", *FIELDS, "notes=a, b", "date=2026-09-01")
    assert done.returncode == 0
    assert "fk err = 1e-16" in done.stdout
    (row,) = read_rows(log)
    assert (row["day"], row["value"], row["notes"]) == (1, 1e-16, "a, b")
    words = ("--no-sync", "--allow-nonfinite", "check=fk", "metric=err", "value=nan")
    assert run(*words).returncode == 0
    assert log.read_text().endswith(",nan,\n")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([], "a row needs check, metric, value. Example: check="),
        (["check=fk"], "a row needs metric, value"),
        ([*FIELDS, "vlaue=1"], 'did you mean "value"?'),
        ([*FIELDS, "path=1"], 'there is no field "path"'),
        ([*FIELDS, "hello"], '"hello" is not FIELD=VALUE'),
        ([*FIELDS, "check=x"], '"check" is given twice'),
        (["check=fk", "metric=err", "value=nan"], "--allow-nonfinite"),
        (["day=x", "value=abc"], "a row needs check, metric; \"day\" is 'x', not a"),
        (["day=x", "value=abc"], "\"value\" is 'abc', not a number"),
        (["--check", *FIELDS], "or one of"),
    ],
)
def test_a_mistake_is_one_line_and_exit_code_2(log, words, said, run):
    done = run(*words)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert said in done.stderr
    assert not log.exists()


def test_a_warning_is_one_plain_line(log, run):
    log.write_text(f"{LINE}\n{OLD}", newline="")
    done = run(*FIELDS)
    assert done.returncode == 0
    assert done.stderr.startswith("warning: ")
    assert done.stderr.count("\n") == 1


def test_help_teaches_and_fits_80_columns(log, run):
    done = run("--help")
    assert "notes=" in done.stdout
    assert max(len(line) for line in done.stdout.splitlines()) <= 80


def test_check_is_content_with_a_good_log(log, run):
    append_row(log, check="fk")
    done = run("--check")
    assert (done.returncode, done.stderr) == (0, "")
    assert "1 row, 0 problems" in done.stdout


def test_check_lists_every_bad_line_with_its_number_and_reason(log, run):
    log.write_text(f"{LINE}\n{OLD}\ncut,2026\n{OLD},more\n{OLD}", newline="")
    done = run("--check")
    assert done.returncode == 1
    assert "line 3: 2 columns where 13 belong" in done.stdout
    assert "line 4: 14 columns where 13 belong" in done.stdout
    assert "line 5: it has no line end" in done.stdout
    assert "In an editor, correct or delete them." in done.stdout
    assert "2 rows, 3 problems" in done.stdout


def test_a_log_that_cannot_be_read_is_told_in_one_line(log, run):
    def told():
        done = run("--check")
        assert (done.returncode, done.stderr.count("\n")) == (2, 1)
        return done.stderr

    assert "does not exist" in told()
    log.mkdir()
    assert "cannot be read" in told()
    log.rmdir()
    log.write_text(f"{LINE}\n{OLD}\n".replace(",", ";"))
    assert "line 1 is not the log's header" in told()


def test_refused_rows_are_offered_and_put_back_by_the_command_that_is_named(log, run):
    command = f"python3 scripts/log_metric.py --restore --file {log}\n"
    for i, waiting in enumerate(("1 refused row waits", "2 refused rows wait")):
        log.write_text("something else\n")
        refused = run("check=fk", "metric=err", f"value={i}")
        assert refused.returncode == 2
        assert refused.stderr.endswith(f"to add it later:\n  {command}")
        log.write_text(LINE + "\n")
        assert waiting in run("--check").stdout
    log.write_text("something else\n")
    still = run("--restore")
    assert still.returncode == 2
    assert "the rows are still in" in still.stderr
    log.write_text(LINE + "\n")
    done = run("--restore")
    assert (done.returncode, "2 rows put back" in done.stdout) == (0, True)
    assert [row["value"] for row in read_rows(log)] == [0, 1]
    assert "0 rows put back" in run("--restore").stdout
    assert run("--check").returncode == 0


def git(folder: Path, *words: str) -> None:
    base = ["git", "-c", "user.name=t", "-c", "user.email=t@t"]
    subprocess.run([*base, *words], cwd=folder, capture_output=True, check=True)


def test_check_names_rows_that_a_union_merge_brought_back(log, run):
    folder = log.parent
    git(folder, "init", "-q", "-b", "main")
    (folder / ".gitattributes").write_text("metrics.csv merge=union\n")
    edited, deleted = OLD.replace("note", "first"), OLD.replace("note", "second")
    log.write_text(f"{LINE}\n{OLD}\n{edited}\n{deleted}\n", newline="")
    git(folder, "add", "-A")
    git(folder, "commit", "-qm", "base")
    git(folder, "checkout", "-qb", "side")
    better = edited.replace("first", "better")
    log.write_text(f"{LINE}\n{OLD}\n{better}\n", newline="")
    git(folder, "commit", "-qam", "edit one, delete one")
    git(folder, "checkout", "-q", "main")
    with log.open("a", newline="") as file:
        file.write(OLD.replace("note", "third") + "\n")
    git(folder, "commit", "-qam", "add")
    git(folder, "merge", "-q", "side", "-m", "both")
    brought_back = [line for line in (edited, deleted) if line in log.read_text()]
    assert brought_back
    done = run("--check")
    assert done.returncode == 0
    assert done.stdout.count("note, line") == len(brought_back)
    for line in brought_back:
        assert line[-40:] in done.stdout


def test_a_command_names_a_log_that_is_not_the_kits_own():
    start = "python3 scripts/log_metric.py --check"
    assert command("--check", OWN_LOG) == start
    assert command("--check", ROOT / "a.csv") == f"{start} --file a.csv"
    spaced = ROOT.parent / "my logs" / "a.csv"
    assert command("--check", spaced) == f'{start} --file "{spaced}"'
