"""Many writers at once, and writers that are killed: no row lost, none torn.

The full sizes of the course's promise are behind the `soak` marker: `make soak`.
"""

import os
import shutil
import signal
import subprocess
import sys
import time
import warnings
from collections import Counter
from pathlib import Path

import pytest

from labkit.base import lock
from labkit.log import append_row, read_rows
from labkit.log.logfile import locked
from labkit.log.rows import HEADER as LINE
from labkit.log.scan import scan
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit

PAD = 110  # the rest of a row

# Each waits for the start, so that all run at once; each says what was accepted.
WRITER = """
import os, sys, time
from labkit.log import append_row
log, me, count, size, gate = sys.argv[1:]
while not os.path.exists(gate):
    time.sleep(0.001)
for i in range(int(count)):
    text = f"{me}:{i}:" + me[-1] * int(size) + ",end"
    append_row(log, run_id=me, date="2026-09-01", check="load", git_sha="abc1234",
               day=1, metric="err", value=i, notes=text)
"""
ECHOER = """
log=$1; count=$2; gate=$3
while [ ! -e "$gate" ]; do sleep 0.01; done
for ((i = 0; i < count; i++)); do
  echo "echo,2026-09-01,1,load,abc1234,0,c,m,1,0,err,$i,from a shell" >> "$log"
done
"""


def wait(processes: list[subprocess.Popen]) -> None:
    for process in processes:
        assert process.wait(timeout=600) == 0


def run_writers(folder: Path, writers: int, rows: int, size: int, echoes: int) -> Path:
    """Run the writers, and a shell beside them, on one log; return the log."""
    log, gate = folder / "metrics.csv", folder / "gate"
    if echoes:  # an echo writes no header, so the log is there from the start
        log.write_text(LINE + "\n", newline="")
    running = [
        subprocess.Popen(
            [sys.executable, "-c", WRITER, log, f"w{me}", str(rows), str(size), gate]
        )
        for me in range(writers)
    ]
    if echoes:
        words = ["bash", "-c", ECHOER, "-", log, str(echoes), gate]
        running.append(subprocess.Popen(words))
    gate.touch()
    start = time.perf_counter()
    wait(running)
    print(
        f"\n  {writers} x {rows} rows of {size + PAD} B, {echoes} echoes:"
        f" {time.perf_counter() - start:.1f} s"
    )
    return log


def judge(log: Path, writers: int, rows: int, size: int, echoes: int) -> None:
    """Every row is there, once, whole, under one header."""
    assert log.read_bytes().count(LINE.encode()) == 1
    lines = list(scan(log))
    assert [line for line in lines if line.problem] == []
    found: Counter = Counter()
    for line in lines:
        assert line.row is not None
        me, i = str(line.row["run_id"]), int(line.row["value"])
        found[me, i] += 1
        if me != "echo":
            assert line.row["notes"] == f"{me}:{i}:" + me[-1] * size + ",end"
    expected = {(f"w{me}", i) for me in range(writers) for i in range(rows)}
    expected |= {("echo", i) for i in range(echoes)}
    assert set(found) == expected
    assert set(found.values()) == {1}


@pytest.mark.parametrize(("size", "rows"), [(90, 60), (4_900, 20), (70_000, 5)])
def test_no_row_is_lost_or_torn_by_many_writers(tmp_path, size, rows):
    judge(run_writers(tmp_path, 8, rows, size, 0), 8, rows, size, 0)


@pytest.mark.skipif(not shutil.which("bash"), reason="no bash on this machine")
@pytest.mark.skipif(sys.platform == "win32", reason="no atomic append on Windows")
def test_no_row_is_lost_beside_a_shell_that_echoes(tmp_path):
    judge(run_writers(tmp_path, 4, 100, 4_900, 300), 4, 100, 4_900, 300)


@pytest.mark.soak
@pytest.mark.parametrize("echoes", [0, 2_000])
@pytest.mark.parametrize("size", [90, 4_900, 70_000])
def test_fifty_writers_of_400_rows(tmp_path, size, echoes):
    judge(run_writers(tmp_path, 50, 400, size, echoes), 50, 400, size, echoes)


@pytest.mark.parametrize(
    ("starts", "writers"), [(3, 6), pytest.param(60, 8, marks=pytest.mark.soak)]
)
def test_writers_that_start_together_write_one_header(tmp_path, starts, writers):
    for i in range(starts):
        folder = tmp_path / str(i)
        folder.mkdir()
        judge(run_writers(folder, writers, 1, 90, 0), writers, 1, 90, 0)


# Killed in mid-write: what the call returned for is told through a pipe.
VICTIM = """
import os, sys
from labkit.log import append_row
log, start = sys.argv[1], int(sys.argv[2])
for i in range(start, start + 1_000_000):
    append_row(log, run_id="v", date="2026-09-01", check="kill", git_sha="abc1234",
               day=1, metric="err", value=i, notes=f"{i}:" + "k" * 69_000 + ",end")
    os.write(1, b"%d\\n" % i)
"""


def kill_writers(log: Path, times: int) -> tuple[int, int]:
    """Kill a writer `times` times; return how many rows returned, and were cut."""
    returned, cut, start = set(), 0, 0
    for round_ in range(times):
        victim = subprocess.Popen(
            [sys.executable, "-W", "ignore", "-c", VICTIM, log, str(start)],
            stdout=subprocess.PIPE,
        )
        assert victim.stdout is not None
        first = victim.stdout.readline()
        time.sleep(0.0003 * (round_ % 40))
        victim.send_signal(signal.SIGKILL)
        told = first + victim.stdout.read()
        victim.wait()
        victim.stdout.close()
        returned |= {int(i) for i in told.split()}
        start = max(returned) + 2  # one more may be whole but not told
        cut += log.read_bytes()[-1:] != b"\n"
    judge_killed(log, returned, times)
    return len(returned), cut


def judge_killed(log: Path, returned: set[int], kills: int) -> None:
    """Every row that returned is whole; each kill cost at most one other."""
    whole, others = set(), 0
    for line in scan(log):
        i = None if line.row is None else int(line.row["value"] or 0)
        if line.row and line.row["notes"] == f"{i}:" + "k" * 69_000 + ",end":
            whole.add(i)
        else:
            others += 1
    assert returned <= whole
    assert len(whole - returned) + others <= kills


@pytest.mark.skipif(sys.platform == "win32", reason="there is no kill -9 on Windows")
@pytest.mark.parametrize(
    "times", [8, pytest.param(200, marks=[pytest.mark.soak])], ids=["short", "full"]
)
def test_kill_9_costs_at_most_the_row_being_written(tmp_path, times):
    log = tmp_path / "metrics.csv"
    returned, cut = kill_writers(log, times)
    print(f"\n  {times} kills: {returned} rows returned, all whole; {cut} cut")
    assert append_after(log)[-1] == "after"


@pytest.mark.skipif(sys.platform == "win32", reason="there is no kill -9 on Windows")
def test_a_row_cut_at_any_byte_costs_no_other_row(tmp_path):
    log = tmp_path / "metrics.csv"
    for note in ("first", 'say "cut", she said'):
        append_row(log, date="2026-09-01", check="c", metric="m", value=1, notes=note)
    whole = log.read_bytes()
    start = whole.rindex(b"\n", 0, -1) + 1
    for end in range(start + 1, len(whole)):
        log.write_bytes(whole[:end])
        notes = append_after(log)
        assert (notes[0], notes[-1]) == ("first", "after")
        assert log.read_bytes().startswith(whole[:end])


def append_after(log: Path) -> list:
    """Append a row whatever is warned of; return the notes that can be read."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        append_row(log, check="c", metric="m", value=2, notes="after")
        return [row["notes"] for row in read_rows(log)]


@pytest.mark.skipif(sys.platform == "win32", reason="stopping needs signals")
def test_a_lock_is_released_by_the_death_of_its_holder(tmp_path):
    log = tmp_path / "metrics.csv"
    append_row(log, check="c")
    hold = "import os, sys, time; from pathlib import Path\n"
    hold += "from labkit.log.logfile import locked\n"
    hold += "with locked(Path(sys.argv[1])): os.write(1, b'held\\n'); time.sleep(600)"
    holder = subprocess.Popen([sys.executable, "-c", hold, log], stdout=subprocess.PIPE)
    assert holder.stdout is not None
    assert holder.stdout.readline() == b"held\n"
    os.kill(holder.pid, signal.SIGKILL)
    holder.wait()
    holder.stdout.close()
    append_row(log, check="c")
    assert len(read_rows(log)) == 2


def test_a_lock_that_is_never_given_back_is_an_error_with_the_row(
    tmp_path, monkeypatch
):
    log = tmp_path / "metrics.csv"
    append_row(log, check="c")
    monkeypatch.setattr(lock, "PATIENCE_S", 0.05)
    with locked(log), pytest.raises(Robo47Error, match="has held it") as caught:
        append_row(log, check="c", notes="precious")
    assert "precious" in str(caught.value)


def test_a_log_that_a_file_server_has_leased_is_waited_for(tmp_path, monkeypatch):
    log = tmp_path / "metrics.csv"
    append_row(log, check="c")
    really = os.open

    def leased(path, flags, *rest):
        if flags & getattr(os, "O_NONBLOCK", 0):
            raise BlockingIOError(11, "Resource temporarily unavailable")
        return really(path, flags, *rest)

    monkeypatch.setattr(os, "open", leased)
    append_row(log, check="d")
    monkeypatch.undo()
    assert [row["check"] for row in read_rows(log)] == ["c", "d"]
