"""The log: what goes in comes back, and nothing that is there is harmed."""

import contextlib
import csv
import errno
import os
import shutil
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from labkit.base.git import short_sha
from labkit.base.lock import warn_once
from labkit.log import COLUMNS, append_row, append_rows, logfile, read_rows
from labkit.log.logfile import restore
from labkit.log.rows import HEADER as LINE
from labkit.log.scan import scan
from robo47.errors import Robo47Error

ROW = {"date": "2026-09-01", "day": 1, "check": "fk", "metric": "err", "value": 1e-16}
OLD = "r,2026-09-01,1,fk,abc1234,0,home,manual,1,0,err,1e-16,note"
HEADER = LINE.encode()
BASH = shutil.which("bash")  # by its path: Windows would look in System32 first


@pytest.fixture
def log(tmp_path: Path) -> Path:
    return tmp_path / "metrics.csv"


def notes(path: Path) -> list:
    return [row["notes"] for row in read_rows(path)]


def test_the_columns_are_the_handouts_thirteen():
    assert ",".join(COLUMNS) == (
        "run_id,date,day,check,git_sha,seed,config,method,n_trials,n_failures,metric,"
        "value,notes"
    )


def test_a_row_reads_back_as_append_row_returned_it(log):
    row = append_row(log, **ROW, seed=7, notes="first", n_trials=1000, n_failures=0)
    assert read_rows(log) == [row]
    assert (row["value"], row["config"]) == (1e-16, "")
    assert append_row(log, **ROW, sync=True)["seed"] is None
    below = append_row(log, **ROW | {"value": -0.5})  # no formula
    assert read_rows(log)[2] == below
    top, *lines = log.read_bytes().split(b"\n")
    assert (top, len(lines), lines[-1]) == (HEADER, 4, b"")


def test_the_date_and_the_commit_are_filled_in(log):
    before = time.strftime("%Y-%m-%d")
    row = append_row(log, check="fk")
    assert before <= row["date"] <= time.strftime("%Y-%m-%d")
    assert row["git_sha"] == short_sha(Path(__file__).parent.parent)


OFTEN = settings(
    max_examples=150,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


@OFTEN
@given(
    text=st.text(st.characters(exclude_characters="\r\n\0", exclude_categories=["Cs"])),
    value=st.floats(allow_nan=False, allow_infinity=False),
    seed=st.integers(),
)
def test_every_text_and_number_reads_back_equal(tmp_path, text, value, seed):
    path = tmp_path / "metrics.csv"
    append_row(path, **ROW | {"value": value, "notes": text, "run_id": text}, seed=seed)
    last = read_rows(path)[-1]
    assert (last["notes"], last["run_id"]) == (text, text)
    assert (last["value"], last["seed"]) == (value, seed)


@OFTEN
@given(text=st.text(st.sampled_from("\r\n\0\ud800\udfff,\"'=+-@; a\t")))
def test_one_row_stays_one_line_whatever_is_in_it(tmp_path, text):
    path = tmp_path / "metrics.csv"
    path.unlink(missing_ok=True)
    append_row(path, **ROW, notes=text)
    assert path.read_bytes().count(b"\n") == 2
    expected = "".join(" " if c in "\r\n\0\ud800\udfff" else c for c in text)
    assert notes(path) == [expected]
    with open(path, encoding="utf-8", newline="") as file:
        assert len(list(csv.reader(file))) == 2


@pytest.mark.parametrize("text", ["=1+1", "+1", "-1", "@x", "'=1", "''-", "'quoted'"])
def test_no_cell_is_run_as_a_formula_by_a_spreadsheet(log, text):
    append_row(log, **ROW, notes=text)
    assert notes(log) == [text]
    with open(log, encoding="utf-8", newline="") as file:
        assert list(csv.reader(file))[1][-1][0] == "'"


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"vlaue": 1}, 'did you mean "value"?'),
        ({"zzzzz": 1}, "the fields: run_id, date"),
        ({"value": float("nan")}, '"value" is nan'),
        ({"value": "-inf"}, '"value" is -inf'),
        ({"config": float("inf")}, '"config" is inf'),
        ({"value": "abc"}, "\"value\" is 'abc', not a number"),
        ({"day": 1.5}, '"day" is 1.5, not a whole number'),
        ({"date": "1/9/2026"}, "not YYYY-MM-DD"),
        ({"date": "2026-02-30"}, "not YYYY-MM-DD"),
        ({"notes": "x" * 131_073}, "a cell holds 131,072"),
    ],
)
def test_a_wrong_field_is_refused_by_name_and_writes_nothing(log, fields, said):
    with pytest.raises(Robo47Error) as caught:
        append_row(log, **ROW | fields)
    assert said in str(caught.value)
    assert not log.exists()


def test_all_wrong_fields_are_named_at_once(log):
    with pytest.raises(Robo47Error) as caught:
        append_row(log, dya=1, day="x", seed=float("nan"), value="abc")
    for name in ("dya", "day", "seed", "value"):
        assert f'"{name}"' in str(caught.value)
    assert "\n" not in str(caught.value)


def test_several_rows_land_together_and_in_order(log):
    append_row(log, **ROW, notes="old")
    rows = append_rows([ROW | {"notes": "a"}, ROW | {"notes": "b"}], log, sync=True)
    assert read_rows(log)[1:] == rows
    assert notes(log) == ["old", "a", "b"]
    assert append_rows([], log.with_name("none.csv")) == []
    assert not log.with_name("none.csv").exists()


def test_one_wrong_row_among_several_is_named_and_none_is_written(log):
    with pytest.raises(Robo47Error, match='row 2: "day" is') as caught:
        append_rows([ROW, ROW | {"day": "x"}, ROW | {"value": "y"}], log)
    assert 'row 3: "value" is' in str(caught.value)
    assert not log.exists()


def test_of_several_refused_rows_all_are_kept_and_shown_and_come_back(log):
    log.write_text("something else\n")
    with pytest.raises(Robo47Error) as caught:
        append_rows([ROW | {"notes": "a"}, ROW | {"notes": "b"}], log)
    kept = Path(f"{log}.unsaved").read_text().splitlines()
    assert [text[-2:] for text in kept] == [",a", ",b"]
    assert all(f"  row: {text}\n" in str(caught.value) for text in kept)
    assert str(caught.value).endswith(f"--restore --file {log}")
    log.unlink()
    assert restore(log) == 2
    assert notes(log) == ["a", "b"]


def test_a_non_finite_value_is_recorded_when_asked_for(log):
    append_row(log, allow_nonfinite=True, **ROW | {"value": float("inf")})
    assert read_rows(log)[0]["value"] == float("inf")


@pytest.mark.skipif(BASH is None, reason="no bash on this machine")
@pytest.mark.parametrize("folder", [".", "w1-foundations"])
def test_the_handouts_echo_gives_a_row_that_reads_back_equal(tmp_path, folder):
    log = tmp_path / "metrics" / "metrics.csv"
    log.parent.mkdir()
    log.write_bytes(HEADER + b"\n")
    (tmp_path / "w1-foundations").mkdir()
    where = "metrics/metrics.csv" if folder == "." else "../metrics/metrics.csv"
    line = "day1_transforms,$(date +%F),1,fk_identity_check,abc1234,0,panda_home,manual"
    echo = f'ERR=2.2e-16; echo "{line},1,0,inv_err,$ERR,T @ T_inv" >> {where}'
    before = time.strftime("%Y-%m-%d")
    subprocess.run([BASH, "-c", echo], cwd=tmp_path / folder, check=True)
    row = read_rows(log)[0]
    assert before <= row["date"] <= time.strftime("%Y-%m-%d")
    expected = append_row(
        log,
        run_id="day1_transforms",
        date=row["date"],
        day=1,
        check="fk_identity_check",
        git_sha="abc1234",
        seed=0,
        config="panda_home",
        method="manual",
        n_trials=1,
        n_failures=0,
        metric="inv_err",
        value=2.2e-16,
        notes="T @ T_inv",
    )
    assert read_rows(log) == [expected, expected]
    first, second = log.read_bytes().splitlines()[1:]
    assert first == second


# What the file may look like before.


def test_a_last_line_without_its_end_keeps_its_text_and_is_told_of_once(log):
    log.write_text(f"{LINE}\n{OLD}", newline="")
    with pytest.raises(UserWarning, match="1e-16,note"):  # as where they are errors
        append_row(log, **ROW, notes="new")
    log.write_text(f"{LINE}\n{OLD}", newline="")
    with pytest.warns(UserWarning, match="1e-16,note") as told:
        append_row(log, **ROW, notes="new")
    assert len(told) == 1
    assert told[0].filename == __file__
    assert log.read_text().splitlines()[1] == OLD
    assert notes(log) == ["note", "new"]
    assert [line.problem for line in scan(log)] == [
        "it had no line end when the next row came, so it may be cut",
        "",
    ]


def test_an_open_quote_in_a_cut_line_swallows_nothing(log):
    cut = OLD.replace("note", '"said ""no"", th')
    log.write_text(f"{LINE}\n{cut}", newline="")
    with pytest.warns(UserWarning, match="no line end"):
        append_row(log, **ROW, notes="new")
    assert notes(log) == ['said "no", th', "new"]
    with open(log, newline="") as file:
        assert [row[-1] for row in csv.reader(file)][1:] == ['said "no", th', "new"]


def test_a_run_of_nul_bytes_after_a_power_cut_is_only_a_cut_line(log):
    log.write_bytes(HEADER + b"\n" + OLD.encode() + b"\n" + b"\0" * 40)
    with pytest.warns(UserWarning, match="no line end"):
        append_row(log, **ROW, notes="new")
    assert notes(log) == ["note", "new"]


@pytest.mark.parametrize(
    ("before", "end"),
    [
        (b"", b"\n"),
        (b"\xef\xbb\xbf" + HEADER + b"\n", b"\n"),
        (HEADER + b"\r\n" + OLD.encode() + b"\r\n", b"\r\n"),
    ],
    ids=["an empty file", "a BOM", "CRLF"],
)
def test_what_the_file_began_with_is_kept_and_continued(log, before, end):
    log.write_bytes(before)
    append_row(log, **ROW, notes="new")
    assert log.read_bytes().startswith(before or HEADER + b"\n")
    assert log.read_bytes().endswith(b",new" + end)
    assert notes(log)[-1] == "new"


SWAPPED = LINE.replace("run_id,date", "date,run_id")


@pytest.mark.parametrize(
    "content",
    [
        f"{LINE}\n{OLD}\n".encode("utf-16"),
        HEADER.replace(b",", b";") + b"\n",
        b"\n" + HEADER + b"\n",
        OLD.encode() + b"\n",
        HEADER.replace(b"seed", b"sed") + b"\n",
        HEADER + b",mood\n",
        SWAPPED.encode() + b"\n",
    ],
)
def test_another_first_line_is_refused_with_what_to_do(log, content):
    log.write_bytes(content)
    with pytest.raises(Robo47Error) as caught:
        append_row(log, **ROW, notes="kept")
    refusal, row, *_ = str(caught.value).splitlines()
    assert "line 1 is not the log's header. " in refusal
    assert refusal.endswith((LINE, "--convert"))
    assert "2026-09-01,1,fk," in row
    assert log.read_bytes() == content
    assert Path(f"{log}.unsaved").read_bytes().endswith(b",kept\n")
    with pytest.raises(Robo47Error) as caught:
        read_rows(log)
    assert str(caught.value) == refusal


def test_a_row_that_powershell_wrote_in_utf_16_costs_no_other_row(log):
    log.write_bytes(f"{LINE}\n{OLD}\n".encode() + f"{OLD}\r\n".encode("utf-16-le"))
    with pytest.warns(UserWarning, match="no line end"):
        append_row(log, **ROW, notes="new")
    assert [("NUL" in line.problem) for line in scan(log)] == [False, True, False]
    with pytest.warns(UserWarning, match="line 3: it has NUL bytes"):
        assert notes(log) == ["note", "new"]


# Where the row cannot go.


def refusal(path: Path) -> str:
    with pytest.raises(Robo47Error) as caught:
        append_row(path, **ROW, notes="precious")
    assert "err,1e-16,precious" in str(caught.value)
    return str(caught.value)


def test_a_folder_in_the_logs_place_or_a_missing_one_is_named(log):
    log.mkdir()
    assert "a folder is in the log's place" in refusal(log)
    assert "its folder does not exist" in refusal(log.parent / "nowhere" / "m.csv")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
@pytest.mark.skipif(os.name == "nt", reason="flock is POSIX")
@pytest.mark.parametrize("name", ["ENOLCK", "ENOTSUP", "ENOSYS", "EOPNOTSUPP"])
def test_where_the_file_system_has_no_locks_rows_are_recorded_and_that_is_said_once(
    log, monkeypatch, name
):
    import fcntl

    def flock(*_):
        raise OSError(getattr(errno, name), "No locks available")

    monkeypatch.setattr(fcntl, "flock", flock)
    warn_once.cache_clear()
    with pytest.warns(UserWarning, match="no locks"):
        append_row(log, day=1, check="c", metric="m", value=1)
    append_row(log, day=1, check="c", metric="m", value=2)  # warnings are errors here
    assert [row["value"] for row in read_rows(log)] == [1, 2]
    assert not Path(f"{log}.unsaved").exists()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_a_pipe_in_the_logs_place_is_refused_at_once(tmp_path):
    path = tmp_path / "metrics.csv"
    os.mkfifo(path)
    with pytest.raises(Robo47Error, match="not a regular file"):
        append_row(path, day=1, check="c", metric="m", value=1)
    with pytest.raises(Robo47Error, match="no regular file"):
        read_rows(path)


def test_a_device_is_refused_since_it_would_lose_the_row(log):
    log.symlink_to("/dev/full")
    assert "not a regular file" in refusal(log)
    log.unlink()
    log.symlink_to("/dev/null")
    assert "not a regular file" in refusal(log)


@pytest.mark.skipif(sys.platform == "win32", reason="no file-size limit on Windows")
@pytest.mark.parametrize("room", [0, 1, 50, 5000])
def test_a_row_that_only_fits_in_part_leaves_nothing_behind(log, room):
    append_row(log, **ROW)
    before = log.read_bytes()
    script = (
        "import resource, signal, sys; from labkit.log import append_row\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        f"limit = {len(before) + room}\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))\n"
        f"append_row(sys.argv[1], check='c', notes='x' * 8000)"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, str(log)], capture_output=True, text=True
    )
    assert "Robo47Error" in done.stderr
    assert "x" * 8000 in done.stderr
    assert log.read_bytes() == before


@contextlib.contextmanager
def mounted(folder: Path, options: str):
    """A small file system of its own; skips where this user may not mount."""
    if sys.platform != "linux" or os.geteuid() != 0:
        pytest.skip("needs root on Linux to mount a tmpfs")
    folder.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(folder)]
    if subprocess.run(command, capture_output=True).returncode:
        pytest.skip("this container may not mount")
    try:
        yield
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def test_a_full_disk_tears_no_row_and_keeps_the_text_in_the_error(tmp_path):
    folder = tmp_path / "small"
    with mounted(folder, "size=64k"):
        log = folder / "metrics.csv"
        written = 0
        refused = None
        while refused is None:
            try:
                append_row(log, **ROW, notes=f"{written} " + "y" * 3000)
                written += 1
            except Robo47Error as error:
                refused = str(error)
        assert "the disk is full" in refused
        assert "kept nowhere but here" in refused
        assert f",{written} yyy" in refused
        assert written > 10
        assert [n.split()[0] for n in notes(log)] == [str(i) for i in range(written)]


@pytest.mark.skipif(sys.platform == "win32", reason="a folder in use stays there")
def test_a_folder_that_is_gone_is_named_and_the_row_is_in_the_error(
    tmp_path, monkeypatch
):
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    with pytest.raises(Robo47Error, match="its folder does not exist") as refused:
        append_row("metrics.csv", **ROW, notes="mine")
    assert "mine\n  kept nowhere but here: copy it" in str(refused.value)


def test_a_read_only_disk_is_named(tmp_path):
    folder = tmp_path / "frozen"
    with mounted(folder, "size=64k"):
        append_row(folder / "metrics.csv", **ROW)
        subprocess.run(["mount", "-o", "remount,ro", str(folder)], check=True)
        assert "read-only" in refusal(folder / "metrics.csv")


def refusal_for_a_plain_user(path: Path) -> str:
    """As `refusal`, but never as root, who may write anything."""
    if not hasattr(os, "geteuid") or os.geteuid() != 0:
        return refusal(path)
    said, tell = os.pipe()
    with warnings.catch_warnings(action="ignore"):  # of pytest-xdist's threads
        child = os.fork()
    if child == 0:
        os.setuid(65534)
        try:
            os.write(tell, refusal(path).encode())
        finally:
            os._exit(0)
    os.close(tell)
    with open(said, encoding="utf-8") as file:
        text = file.read()
    os.waitpid(child, 0)
    return text


@pytest.mark.parametrize("what", ["file", "folder"])
def test_a_read_only_file_or_folder_is_named(what):
    with tempfile.TemporaryDirectory() as name:  # that the plain user may enter
        folder = Path(name)
        folder.chmod(0o777)
        log = folder / "metrics.csv"
        if what == "file" or os.name == "nt":  # Windows folders stay writable
            append_row(log, **ROW)
            log.chmod(0o444)
        else:
            folder.chmod(0o555)
        said = refusal_for_a_plain_user(log)
        folder.chmod(0o777)
        if log.exists():
            log.chmod(0o666)
            assert len(read_rows(log)) == 1
        assert "it is read-only" in said
        kept = what == "file" or os.name == "nt"
        assert Path(f"{log}.unsaved").exists() == kept
        assert ("kept nowhere but here" in said) == (not kept)


@pytest.mark.skipif(sys.platform == "win32", reason="an open file cannot be replaced")
@pytest.mark.parametrize("moment", ["before", "after"])
def test_a_file_replaced_in_mid_append_gets_the_row_too(log, monkeypatch, moment):
    append_row(log, **ROW, notes="old")
    write, moments = logfile._write, [moment]

    def replace_it(at):
        if at in moments:  # as git and many editors do it, once
            moments.remove(at)
            other = log.with_suffix(".new")
            other.write_bytes(log.read_bytes().splitlines(keepends=True)[0])
            other.replace(log)

    def interrupted(fd, data, sync):
        replace_it("before")
        start = write(fd, data, sync)
        replace_it("after")
        return start

    monkeypatch.setattr(logfile, "_write", interrupted)
    append_row(log, **ROW, notes="new")
    assert notes(log) == ["new"]


def test_half_a_line_from_a_writer_without_a_lock_does_not_swallow_the_row(
    log, monkeypatch
):
    append_row(log, **ROW, notes="old")
    write, done = logfile._write, []

    def interrupted(fd, data, sync):
        if not done:  # bash writes a long echo in two parts
            with open(log, "ab") as other:
                other.write(b"r,2026-09-01,1,half of a long echo")
            done.append(True)
        return write(fd, data, sync)

    monkeypatch.setattr(logfile, "_write", interrupted)
    append_rows([ROW | {"notes": "new"}, ROW | {"notes": "second"}], log)
    with pytest.warns(UserWarning, match="1 line could not be read"):
        assert sorted(notes(log)) == ["new", "old", "second"]


def test_an_echo_that_is_still_being_written_is_not_taken_for_a_cut_line(
    log, monkeypatch
):
    log.write_text(f"{LINE}\n{OLD[:20]}", newline="")

    def meanwhile(seconds):
        with open(log, "ab") as other:
            other.write(OLD[20:].encode() + b"\n")

    monkeypatch.setattr(logfile.time, "sleep", meanwhile)
    append_row(log, **ROW, notes="new")
    assert notes(log) == ["note", "new"]
    assert b"\n\n" not in log.read_bytes()


def test_a_file_that_is_replaced_without_end_is_given_up_with_the_row(log, monkeypatch):
    append_row(log, **ROW)
    monkeypatch.setattr(logfile, "_is_at", lambda fd, path: path.suffix == ".unsaved")
    assert "keeps being replaced" in refusal(log)


def test_a_sync_that_fails_takes_the_row_back(log, monkeypatch):
    append_row(log, **ROW)
    before = log.read_bytes()

    def broken(fd):
        raise OSError(errno.EIO, "Input/output error")

    monkeypatch.setattr(logfile, "_sync", broken)
    with pytest.raises(Robo47Error, match="Input/output error"):
        append_row(log, sync=True, **ROW)
    assert log.read_bytes() == before


# Reading.


def test_lines_that_cannot_be_read_are_counted_in_one_warning(log):
    log.write_text(f"{LINE}\ncut,2026\n{OLD}\nalso,cut\n{OLD},with,commas\n")
    with pytest.warns(UserWarning, match=r"3 lines .* line 2: 2 columns") as told:
        assert notes(log) == ["note"]
    assert len(told) == 1


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (OLD.replace(",1,0,err", ",1,err"), "12 columns where 13 belong"),
        (OLD + OLD, "two rows in one"),
        (OLD + ",more", "14 columns where 13 belong"),
        (OLD.replace("1e-16", "tiny"), "\"value\" is 'tiny', not a number"),
        (OLD.replace("2026-09-01", "1/9/26"), "not YYYY-MM-DD"),
        (OLD.replace("note", '"a"b"'), "quotes do not match"),
        (OLD.replace("note", '"open'), "quotes do not match"),
        (f'"{OLD}"', "1 column where 13 belong"),  # as cmd.exe's echo writes it
        (OLD.replace("note", "n\0ote"), "NUL"),
        (OLD.replace("note", "\udce9"), "not UTF-8"),  # é in Windows-1252
    ],
)
def test_a_line_that_holds_no_row_says_why_and_costs_no_other(log, line, said):
    whole = f"{LINE}\n{line}\n\n{OLD}\n"
    log.write_bytes(whole.encode("utf-8", "surrogateescape"))
    first, second = scan(log)
    assert said in first.problem
    assert first.row is None
    assert (first.number, second.number) == (2, 4)
    assert second.problem == ""


def test_a_log_that_is_not_there_says_what_makes_it(log):
    with pytest.raises(Robo47Error, match="does not exist"):
        read_rows(log)


# Git.


def git(folder: Path, *words: str) -> str:
    base = ["git", "-c", "user.name=t", "-c", "user.email=t@t", "-c", "gc.auto=0"]
    done = subprocess.run(
        [*base, *words], cwd=folder, capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


@pytest.fixture
def repo(tmp_path: Path) -> Path:
    folder = tmp_path / "clone"
    folder.mkdir()
    git(folder, "init", "-q", "-b", "main")
    shutil.copy(Path(__file__).parent.parent / ".gitattributes", folder)
    append_row(folder / "metrics.csv", **ROW, notes="base")
    git(folder, "add", "-A")
    git(folder, "commit", "-qm", "base")
    return folder


def test_two_branches_that_add_rows_merge_without_loss(repo):
    log = repo / "metrics.csv"
    for branch in ("left", "right"):
        git(repo, "checkout", "-qb", branch, "main")
        for i in range(20):
            append_row(log, **ROW, notes=f"{branch} {i}")
        git(repo, "commit", "-qam", branch)
    git(repo, "merge", "-q", "left", "-m", "both")
    everything = {f"{b} {i}" for b in ("left", "right") for i in range(20)}
    assert set(notes(log)) == everything | {"base"}
    assert len(notes(log)) == 41
    assert log.read_bytes().count(HEADER) == 1


def test_the_commit_is_found_as_git_itself_names_it(repo, tmp_path):
    head = git(repo, "rev-parse", "HEAD")[:7]
    assert short_sha(repo) == head
    git(repo, "pack-refs", "--all")
    assert short_sha(repo) == head
    git(repo, "worktree", "add", "-q", "-b", "side", str(tmp_path / "tree"))
    git(tmp_path / "tree", "commit", "-q", "--allow-empty", "-m", "side")
    assert short_sha(tmp_path / "tree") == git(repo, "rev-parse", "side")[:7] != head
    git(repo, "checkout", "-q", "--detach")
    assert short_sha(repo) == head


def test_outside_git_and_before_the_first_commit_there_is_no_commit(tmp_path):
    assert short_sha(tmp_path) == ""
    git(tmp_path, "init", "-q")
    assert short_sha(tmp_path) == ""


def test_importing_the_log_brings_in_no_numerical_library():
    script = (
        "import sys, labkit.log\n"
        "print({'numpy', 'mujoco', 'pandas', 'tqdm', 'PIL'} & set(sys.modules))"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True
    )
    assert done.stdout == "set()\n"
