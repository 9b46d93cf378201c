"""What this machine does wrong is nobody's grade; what a student does is their own."""

import contextlib
import errno
import itertools
import os
import signal
import subprocess
import sys
import time
import zlib
from pathlib import Path
from queue import SimpleQueue

import pytest
from make_class import DAY, SOLVED, WEEK, commit, script
from test_walls import are_gone, standing

from conftest import ROOT, need
from labkit.base import git, processes
from labkit.base.exchange import Question
from labkit.grade import child, classroom, engine
from labkit.grade.engine import Grader, grade_package
from labkit.grade.journal import Journal
from labkit.grade.package import Package, collect, fingerprint
from labkit.grade.roster import Student
from labkit.handin import handin
from labkit.handin.deliverables import check_deliverables
from labkit.lesson import untrusted_files
from labkit.sandbox import process, sandbox
from labkit.sandbox.process import Process
from labkit.sandbox.sandbox import Sandbox
from robo47.errors import FaultError, Robo47Error

pytestmark = pytest.mark.kit
LINUX = sys.platform.startswith("linux")
linux = pytest.mark.skipif(not LINUX, reason="needs Linux's /proc")
FINE = "def f(): return 47.0"
SCRIPT = f"{WEEK}/work/{DAY.script}"


@pytest.fixture
def kill(monkeypatch):
    """Have the first so many sandboxes killed from outside, as the kernel does it."""
    count, load = itertools.count(), Process.load
    monkeypatch.setattr(processes, "oom_kills", lambda: 0)  # a neighbour's are not ours

    def first(times, when="loaded", how=signal.SIGKILL):
        def and_die(self, request):
            if when == "loaded":
                load(self, request)
            if next(count) < times:
                os.kill(processes._family(self.process.pid)[-1], how)
            if when == "loading":
                load(self, request)

        monkeypatch.setattr(Process, "load", and_die)

    return first


@pytest.fixture
def no_memory(monkeypatch):
    """Have Linux say at every look that it killed for want of memory."""
    monkeypatch.setattr(processes, "oom_kills", itertools.count().__next__)


def _no_process(*_):
    raise FaultError("this machine starts no process")


@linux
class TestASandboxThatIsKilled:
    @pytest.mark.parametrize("name", ["bubblewrap", "landlock", "none"])
    def test_once_is_tried_again_and_nobody_notices(self, ask, kill, name):
        kill(1)
        with standing(name):
            (reply,) = ask(FINE)
        assert (reply.value, reply.again, reply.error) == (47, 47, "")

    @pytest.mark.parametrize("name", ["bubblewrap", "landlock", "none"])
    def test_every_time_is_the_students_doing(self, ask, kill, name):
        kill(2)
        with standing(name):
            (reply,) = ask(FINE)
        assert reply.kind == "stopped"
        assert "it ended Python" in reply.error

    def test_and_costs_the_task_that_does_it_alone(self, check):
        mischief = "import os; os._exit(137)"  # as bubblewrap tells of a kill
        solved = SOLVED.replace(
            "    T = np.eye(4)", f"    {mischief}\n    T = np.eye(4)", 1
        )
        verdicts = check(solved)
        assert verdicts["1.1"].mistake == "stopped"
        assert verdicts["1.2"].status == "passed"

    def test_before_it_saw_the_file_is_a_fault(self, ask, kill):
        kill(9, when="loading")
        with pytest.raises(FaultError, match="this machine starts no process"):
            ask(FINE)

    @pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
    def test_for_want_of_memory_is_a_fault(self, ask, kill, no_memory, how):
        kill(2, how=how)
        with standing("landlock"), pytest.raises(FaultError) as caught:
            ask(FINE)
        assert "this machine ran out of memory" in str(caught.value)
        assert str(caught.value).endswith("close other programs, try again")

    def test_for_want_of_memory_that_it_took_itself_is_not(
        self, ask, kill, no_memory, monkeypatch
    ):
        kill(2)
        monkeypatch.setattr(process, "MODEST", 0.03)
        greedy = "import time, numpy as np\nX = np.ones(10**7)\ntime.sleep(0.6)\n"
        (reply,) = ask(greedy + FINE)
        assert reply.kind == "stopped"
        assert reply.error == "it used more memory than this machine has"

    def test_ends_a_session_with_a_word(self, student, kill, no_memory):
        kill(1)
        with Sandbox() as box:
            session = box.session(student(FINE))
            (reply,) = session.ask([Question("", "f", ())])
        assert reply.kind == "stopped"
        assert "ran out of memory" in reply.error

    def test_in_a_grade_is_a_fault_too(self, kill, no_memory):
        kill(2)
        with pytest.raises(FaultError, match="ran out of memory"):
            child.grade(solved(), DAY)

    def test_is_told_from_one_that_ends_itself(self):
        codes = (-signal.SIGSEGV, 0, 1, 3, 139)
        for code, killed in [(-9, True), (137, True), *((c, False) for c in codes)]:
            ended = subprocess.Popen([sys.executable, "-c", ""])
            ended.wait()
            ended.returncode = code
            assert processes.was_killed(ended) is killed

    def test_is_counted_by_the_kernel(self):
        assert processes.oom_kills() >= 0
        words = Path("/proc/vmstat").read_text().split()
        assert "oom_kill" in words


def solved() -> Package:
    """Return a right submission."""
    files = {name: text.encode() for name, text in script(SOLVED).items()}
    return Package(1, fingerprint(1), handin.Handin(files))


class TestAMachineThatStartsNoProcess:
    ERRORS = (
        BlockingIOError(errno.EAGAIN, "Resource temporarily unavailable"),
        OSError(errno.ENOMEM, "Cannot allocate memory"),
        OSError(errno.EMFILE, "Too many open files"),
        RuntimeError("can't start new thread"),
        MemoryError(),
    )

    @pytest.mark.parametrize("error", ERRORS, ids=lambda e: type(e).__name__)
    def test_is_at_fault(self, ask, error, monkeypatch):
        def fails(*_):
            raise error

        monkeypatch.setattr(process, "_start", fails)
        with pytest.raises(FaultError, match="this machine starts no process"):
            ask(FINE)

    def test_leaves_no_half_of_one_behind(self, monkeypatch):
        process._starter.submit(int).result()  # its own thread is there
        started = []
        start, threads = process._start, iter((None, RuntimeError("no thread")))

        def fails(self):
            if error := next(threads):
                raise error

        monkeypatch.setattr(
            process, "_start", lambda *a: started.append(start(*a)) or started[0]
        )
        monkeypatch.setattr("threading.Thread.start", fails)
        with pytest.raises(FaultError, match="no thread"):
            Process()
        assert started[0].poll() is not None

    def test_keeps_the_session_where_only_the_spare_fails(self, student, monkeypatch):
        with Sandbox() as box:
            one = Process()
            monkeypatch.setattr(box, "_take", lambda _: one)
            monkeypatch.setattr(sandbox, "Process", _no_process)
            session = box.session(student(FINE))
            assert session.ask([Question("", "f", ())])[0].value == 47
        assert one.process.poll() is not None

    def test_says_so_in_one_line_of_make_check(self, tmp_path):
        code = (
            "import runpy, sys, errno\n"
            f"sys.path.insert(0, {str(ROOT / 'scripts')!r})\n"
            "from labkit.sandbox import process\n"
            "def fails(*_): raise OSError(errno.EAGAIN, 'no more processes')\n"
            "process._start = fails\n"
            f"sys.argv = ['check', '1', '--file', {str(DAY.source)!r}]\n"
            f"runpy.run_path({str(ROOT / 'scripts/check_day.py')!r}, "
            "run_name='__main__')\n"
        )
        done = subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, check=False
        )
        assert done.returncode == 2
        assert done.stderr.startswith("error: this machine starts no process for the")
        assert "no more processes" in done.stderr
        assert done.stderr.count("\n") == 1
        assert done.stdout == ""

    @linux
    def test_leaves_the_grade_to_the_next_run(self):
        import resource

        grader, files = Grader(), resource.RLIMIT_NOFILE
        try:
            hard = resource.prlimit(grader.process.pid, files)[1]
            assert grader.grade(solved())["tasks"][0]["status"] == "passed"
            resource.prlimit(grader.process.pid, files, (8, hard))
            with pytest.raises(FaultError, match="Too many open files"):
                grader.grade(solved())
            resource.prlimit(grader.process.pid, files, (hard, hard))
            assert grader.grade(solved())["tasks"][0]["status"] == "passed"
        finally:
            grader.close()

    def test_fails_nobody_where_no_grader_starts(self, monkeypatch):
        for error in self.ERRORS:

            def fails(*_, error=error, **__):
                raise error

            monkeypatch.setattr("labkit.grade.engine.Grader", fails)
            monkeypatch.setattr("labkit.grade.engine._idle", SimpleQueue())
            with pytest.raises(FaultError):
                grade_package(solved())

    def test_is_noted_and_not_kept(self, tmp_path, monkeypatch):
        def fails(*_):
            raise MemoryError

        monkeypatch.setattr(classroom, "collect", fails)
        journal = Journal(tmp_path / "j", DAY)
        room = classroom.Classroom([Student("A", "a", tmp_path)], DAY, journal)
        with engine.local(1) as here:
            course = room.grade(here, tmp_path)
        journal.close()
        assert (course.class_[0].fault, course.graded_now) == (True, 0)
        assert "this machine failed (MemoryError)" in course.class_[0].error
        assert (tmp_path / "j").read_text().count("\n") == 1  # its head


class TestTime:
    SLOW = "import time\ndef f():\n    time.sleep(0.7)\n    return 47.0"

    @pytest.fixture
    def short(self, monkeypatch):
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 0.3)

    @linux
    def test_of_waiting_for_a_processor_is_not_the_students(
        self, ask, short, monkeypatch
    ):
        waits = itertools.count(0.5, 0.5)
        monkeypatch.setattr(processes, "scheduled", lambda _: (0.1, next(waits)))
        assert ask(self.SLOW)[0].value == 47

    @linux
    def test_of_waiting_is_no_tasks_either(self, ask, monkeypatch):
        monkeypatch.setattr(sandbox, "TASK_SECONDS", 0.4)
        monkeypatch.setattr(
            processes, "scheduled", lambda _: (0.1, time.monotonic() - 5)
        )
        questions = [Question("1.1", "f", ())] * 3
        code = self.SLOW.replace("0.7", "0.25")
        assert [reply.value for reply in ask(code, *questions)] == [47] * 3

    @linux
    def test_of_waiting_long_ago_is_over(self, student, monkeypatch):
        monkeypatch.setattr(processes, "scheduled", lambda _: (0.1, 50.0))
        with Sandbox() as box:
            session = box.session(student("def f():\n    while True: 0"))
            (reply,) = session.ask([Question("", "f", ())], 0.3)
            assert reply.error == process.ENDLESS
            assert session._process.waited < 1

    def test_is_up_where_nothing_else_ran(self, ask, short, monkeypatch):
        monkeypatch.setattr(processes, "scheduled", lambda _: (0.1, 0.0))
        assert ask(self.SLOW)[0].kind == "stopped"

    @linux
    def test_is_what_linux_counts(self):
        start = "import time; print(flush=True); end = time.monotonic() + 60\n"
        busy = start + "while time.monotonic() < end: 0"
        for code, works in ((busy, True), (start + "time.sleep(60)", False)):
            with subprocess.Popen(
                [sys.executable, "-c", code], stdout=subprocess.PIPE
            ) as one:
                one.stdout.readline()
                before = sum(processes.scheduled(one))
                time.sleep(0.6)
                used = sum(processes.scheduled(one)) - before
                one.kill()
            assert (used > 0.3) is works

    def test_is_limited_for_all_tasks_together(self, ask, monkeypatch):
        """Each call and task keeps its limit, and still it would take minutes."""
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 0.5)
        monkeypatch.setattr(sandbox, "TASK_SECONDS", 1.0)
        monkeypatch.setattr(sandbox, "RUN_SECONDS", 2.0)
        code = "import time\ndef f():\n    time.sleep(0.3)\n    return 47.0"
        questions = [Question(f"1.{i}", "f", ()) for i in range(40)]
        started = time.monotonic()
        replies = ask(code, *questions)
        assert time.monotonic() - started < 20
        assert len(replies) == 40
        assert replies[-1].error == sandbox.TOO_LONG


def sandboxes_of(pid):
    """Return the processes that a grader, whichever its thread, has for a sandbox."""
    found = []
    for file in Path(f"/proc/{pid}/task").glob("*/children"):
        for one in file.read_text().split():
            with contextlib.suppress(FileNotFoundError, ProcessLookupError):
                if b"inside" in Path(f"/proc/{one}/cmdline").read_bytes():
                    found += processes._family(int(one))
    return found


class TestAGrader:
    @linux
    def test_ends_amid_a_package_when_its_coordinator_is_killed(self):
        loops = SOLVED.replace("    T = np.eye(4)", "    while True: pass", 1)
        code = (
            "import sys\n"
            "from labkit.grade.engine import Grader\n"
            "from labkit.grade.package import Package, fingerprint\n"
            "from labkit.handin.handin import Handin\n"
            "one = Grader()\n"
            "print(one.process.pid, one.folder, flush=True)\n"
            f"files = {{{SCRIPT!r}: sys.stdin.buffer.read()}}\n"
            "one.grade(Package(1, fingerprint(1), Handin(files)))\n"
        )
        command = [sys.executable, "-c", code]
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        with subprocess.Popen(command, cwd=ROOT, **pipes) as coordinator:
            pid, folder = coordinator.stdout.readline().decode().split()
            coordinator.stdin.write(loops.encode())
            coordinator.stdin.close()
            family = []
            deadline = time.monotonic() + 60
            while not family and time.monotonic() < deadline:
                family = sandboxes_of(pid)
                time.sleep(0.01)
            coordinator.kill()
        assert family
        assert are_gone([int(pid), *family], 5)  # a call alone has 3 s, the package 100
        assert not Path(folder).exists()

    @linux
    def test_keeps_to_the_wall_that_was_promised(self):
        with standing("landlock"):
            grader = Grader()
        deadline = time.monotonic() + 60
        try:
            environ = b""  # as it is until the process is the new program's
            while not environ and time.monotonic() < deadline:
                environ = Path(f"/proc/{grader.process.pid}/environ").read_bytes()
            assert b"ROBO47_WALL=landlock" in environ.split(b"\0")
        finally:
            grader.close()

    def test_grades_nothing_behind_another_one(self, monkeypatch):
        monkeypatch.setenv("ROBO47_WALL", "landlock")
        monkeypatch.setattr(process, "_landlock_works", lambda: False)
        process.wall.cache_clear()
        with pytest.raises(FaultError, match="landlock, which does not work here"):
            child.grade(solved(), DAY)
        process.wall.cache_clear()


class TestGit:
    """A repository that takes too much is the student's, a slow machine is not."""

    @pytest.fixture
    def fake(self, tmp_path, monkeypatch):
        commit(tmp_path, 1_788_000_000)
        monkeypatch.setattr(git, "SECONDS", 1.5)

        def put(line):
            program = tmp_path / "bin" / "git"
            program.parent.mkdir(exist_ok=True)
            program.write_text(f"#!/bin/sh\n{line}\n")
            program.chmod(0o755)
            monkeypatch.setenv("PATH", f"{program.parent}:{os.environ['PATH']}")

        return put

    @linux
    @pytest.mark.parametrize("line", ["while :; do :; done", "sleep 60"])
    def test_that_works_or_waits_without_an_end_reads_nothing(
        self, tmp_path, fake, line
    ):
        fake(line)
        assert not git.read_history(tmp_path, [SCRIPT]).readable

    @linux
    def test_that_is_stopped_leaves_no_process_behind(self, tmp_path, fake):
        fake(f"sleep 600 & echo $! > {tmp_path}/pid; wait")
        assert not git.read_history(tmp_path, [SCRIPT]).readable
        assert are_gone([int((tmp_path / "pid").read_text())], 20)

    @linux
    @pytest.mark.parametrize("line", ["sleep 60", "kill -9 $$"])
    def test_that_waits_for_a_processor_or_is_killed_is_the_machines(
        self, tmp_path, fake, line, monkeypatch
    ):
        monkeypatch.setattr(git, "SECONDS", 0.3)
        monkeypatch.setattr(processes, "scheduled", lambda _: (0.01, 0.2))
        fake(line)
        with pytest.raises(git.GitError):
            git.read_history(tmp_path, [SCRIPT])

    def test_takes_no_memory_for_what_a_small_file_claims(self, tmp_path):
        commit(tmp_path, 1_788_000_000)
        assert git.read_history(tmp_path, [SCRIPT]).readable
        size = 300_000_000
        pack = zlib.compressobj(1)
        bomb = pack.compress(b"tree %d\0" % size)
        bomb += b"".join(pack.compress(bytes(10**7)) for _ in range(30)) + pack.flush()
        assert len(bomb) < 3_000_000
        tree = tmp_path / ".git" / "objects" / "aa" / ("a" * 38)
        tree.parent.mkdir(exist_ok=True)
        tree.write_bytes(bomb)
        who = b"A <a@b> 1788000000 +0000"
        text = b"tree " + b"a" * 40 + b"\nauthor " + who + b"\ncommitter " + who
        made = subprocess.run(
            ["git", "hash-object", "-t", "commit", "-w", "--stdin", "--literally"],
            input=text + b"\n\nx\n",
            capture_output=True,
            cwd=tmp_path,
            check=True,
        )
        (tmp_path / ".git" / "HEAD").write_bytes(made.stdout)
        assert not git.read_history(tmp_path, [SCRIPT]).readable


@pytest.mark.parametrize("number", [errno.EIO, errno.ENOMEM])
def test_a_disk_that_fails_is_no_file_of_the_students(tmp_path, monkeypatch, number):
    (tmp_path / WEEK / "work").mkdir(parents=True)
    (tmp_path / SCRIPT).write_text(FINE)
    real = os.stat

    def fails(path, **how):
        if os.path.basename(path) == DAY.script and "dir_fd" in how:
            raise OSError(number, os.strerror(number))
        return real(path, **how)

    monkeypatch.setattr(os, "stat", fails)
    with pytest.raises(OSError, match=os.strerror(number)):
        handin.read_handin(DAY, tmp_path)
    with pytest.raises(FaultError, match=f"{os.strerror(number)}. Nothing was judged"):
        check_deliverables(DAY, tmp_path)


def test_a_name_that_no_file_can_have_is_no_fault(tmp_path):
    assert handin.read(tmp_path, "x" * 5000, 9) is None
    need(hasattr(os, "symlink"), "links")
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    with pytest.raises(handin.UnreadError, match="behind a link"):
        handin.read(tmp_path, "loop/x", 9)


@pytest.mark.skipif(os.name == "nt", reason="Windows asks for rights to link")
@pytest.mark.parametrize("which", ["folder", "file", "pipe"])
def test_what_is_swapped_while_it_is_read_leads_nowhere(tmp_path, monkeypatch, which):
    """The other's file is put in place after each look, as a racing student would."""
    for who in ("mine", "other"):
        (tmp_path / who / "w" / "work").mkdir(parents=True)
        (tmp_path / who / "w" / "work" / "x.py").write_text(who)
    part = tmp_path / "mine" / "w" / ("work" if which == "folder" else "work/x.py")
    real = os.stat

    def looked(path, **how):
        found = real(path, **how)
        if path == part.name and not part.is_symlink():
            part.rename(tmp_path / "away")
            if which == "pipe":
                os.mkfifo(part)
            else:
                part.symlink_to(
                    tmp_path / "other" / part.relative_to(tmp_path / "mine")
                )
        return found

    monkeypatch.setattr(os, "stat", looked)
    try:
        found = untrusted_files.read(tmp_path / "mine", "w/work/x.py", 100)
    except untrusted_files.UnreadError as error:
        found = str(error)
    assert found in (None, untrusted_files.BEHIND_A_LINK, "is no file")


def test_a_link_is_said_to_be_one_wherever_it_leads(tmp_path):
    need(hasattr(os, "symlink"), "links")
    (tmp_path / "a").symlink_to("x" * 300)  # to ask what is there is an error
    student = Student("A", "a", tmp_path / "a", problem="the folder is a link")
    assert collect(student, DAY).problem == student.problem


def test_a_number_that_no_seed_can_be_is_an_odd_line(tmp_path):
    odd = '{"kind": "robo47 grading", "days": [%d], "reference": 1, "seed": Infinity}'
    (tmp_path / "j").write_text(odd % DAY.number)
    with contextlib.closing(Journal(tmp_path / "j", DAY)) as journal:
        assert journal.odd == 1


def test_a_fault_is_an_error_that_a_person_reads():
    assert issubclass(FaultError, Robo47Error)
