"""The loop: from a save to its verdict and to the next task, with keys and without."""

import os
import select
import subprocess
import sys
import time
from contextlib import closing, contextmanager
from types import SimpleNamespace

import pytest
from test_check_day import solve

from conftest import environment_of
from labkit.base.keys import Keys
from labkit.check import once
from labkit.check.slow import StoppedEarly
from labkit.commands import watch
from labkit.lesson.day import find_day

pytestmark = pytest.mark.kit

WATCH = "scripts/watch_day.py"


@pytest.fixture
def day(clone, run_in):
    day = find_day(1, clone)
    assert run_in("scripts/start_day.py", 1).returncode == 0
    return day


def command(*arguments):
    return [sys.executable, "-u", WATCH, *map(str, arguments)]


def until(watcher, words, said):
    """Read lines until one has these words; return it."""
    for line in watcher.stdout:
        said.append(line)
        if words in line:
            return line
    pytest.fail(f"never said {words!r}: {''.join(said)}")


class TestTheLoop:
    def test_goes_on_to_the_next_task_when_one_passes(self, day, clone):
        said = []
        with subprocess.Popen(
            command(1),
            cwd=clone,
            env=environment_of(clone),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            text=True,
        ) as watcher:
            until(watcher, "watching; Ctrl-C ends it", said)
            assert any("Next: 1.1" in line for line in said)
            time.sleep(0.01)  # a file system that stamps coarsely
            solve(day, day.work, "make_T")
            until(watcher, "watching; Ctrl-C ends it", said)
            watcher.terminate()
        text = "".join(said)
        assert "make_T" in text.partition("Next: 1.1")[2]
        assert "1.1  make_T" in text
        assert "passed" in text
        second = day.tasks[1]
        assert f"Next: {second.id}  {second.title}" in text
        assert f"day1_transforms.py:{_line(day, second.functions[0])}" in text
        assert all(len(line) <= 81 for line in said)

    def test_ends_a_days_code_with_its_success_and_what_is_left_in_one_line(
        self, day, clone
    ):
        """The best second of the day was told as twenty lines of debts."""
        solve(day, day.work, *(f for task in day.tasks for f in task.functions))
        said = []
        with subprocess.Popen(
            command(1),
            cwd=clone,
            env=environment_of(clone),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            text=True,
        ) as watcher:
            until(watcher, "watching", said)
            watcher.terminate()
        text = "".join(said)
        asked = [task for task in day.tasks if not task.optional]
        n = len(asked)
        right = f"Day 1: all your functions are right. {n} of {n} tasks pass.\n"
        _, right, rest = text.partition(right)
        assert right
        assert f"[####################] {n} of {n} tasks" in rest
        assert "make view DAY=1" in rest
        (left,) = (ln for ln in rest.splitlines() if ln.startswith("Left to hand in: "))
        assert "figure" in left
        assert "to do" not in rest
        assert len(rest.splitlines()) < 15
        assert "asking the others" not in text  # all were asked by then
        assert all(len(line) <= 81 for line in said)

    def test_of_a_day_that_is_not_begun_says_how_to_begin(self, run_in):
        done = run_in(WATCH, 2)
        assert done.returncode == 2
        assert "make start DAY=2" in done.stderr


@contextmanager
def on_a_terminal(clone):
    """Watch on a terminal; yield its other end, and end with the key q."""
    import pty

    main, other = pty.openpty()
    with subprocess.Popen(
        command(1),
        cwd=clone,
        env=environment_of(clone) | {"TERM": "dumb"},
        stdin=other,
        stdout=other,
        stderr=other,
        close_fds=True,
    ) as watcher:
        os.close(other)
        try:
            yield main
        except BaseException:
            watcher.kill()  # else the end of the block waits for it
            raise
        os.write(main, b"q")
        assert watcher.wait(timeout=30) == 1
    os.close(main)


@pytest.mark.skipif(os.name == "nt", reason="a terminal of this kind is POSIX's")
class TestKeys:
    def test_are_heeded_on_a_terminal(self, day, clone):
        with on_a_terminal(clone) as terminal:
            _read_until(terminal, "q quit")
            os.write(terminal, b"l")
            assert "1.4  quat_to_R" in _read_until(terminal, "1.8")
            os.write(terminal, b"h")
            assert "hint 1 of" in _read_until(terminal, "Re-read")
            _read_until(terminal, "q quit")

    def test_the_line_that_says_others_are_asked_is_taken_back(self, day, clone):
        with on_a_terminal(clone) as terminal:
            said = _read_until(terminal, "q quit")
        asking = "asking the others again ..."
        assert said.count(asking) == 1
        after = said.partition(asking)[2]
        assert after.startswith(f"\r{' ' * len(asking)}\r")

    def test_never_come_where_there_is_no_terminal(self, monkeypatch):
        with open(os.devnull) as nothing:
            monkeypatch.setattr(sys, "stdin", nothing)
            with Keys() as keys:
                assert not keys.there
                assert keys.wait(0.01) == ""


@pytest.mark.parametrize(("key", "saved"), [("l", False), ("", True)])
def test_a_key_or_a_save_ends_the_run_of_the_lab(monkeypatch, capsys, key, saved):
    """Neither was answered for a minute after the last task had passed."""
    day = find_day(1)

    def check(day, script, task, seed, stop):
        assert stop()
        raise StoppedEarly

    monkeypatch.setattr(once, "check_once", check)
    keys = SimpleNamespace(there=True, wait=lambda _: key)
    with closing(watch.Loop(day, None, day.source)) as loop:
        loop.seen = {} if saved else watch.stamps(day, day.source)
        assert not watch._whole_day(loop, keys)
        assert (loop.key, loop.open()) == (key, [])
    says = "The lab's run was ended early. To run it: make check DAY=1 (c)"
    assert says in capsys.readouterr().out


def _line(day, function):
    lines = day.work.read_text("utf-8").splitlines()
    at = [i for i, line in enumerate(lines) if line.startswith(f"def {function}(")]
    return at[0] + 1


def _read_until(terminal, words):
    said = ""
    limit = time.monotonic() + 60
    while words not in said and time.monotonic() < limit:
        if select.select([terminal], [], [], 0.2)[0]:
            said += os.read(terminal, 4096).decode("utf-8", "replace")
    assert words in said
    return said
