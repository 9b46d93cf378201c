"""What each wall keeps student code from, once that code has switched the guard off."""

import contextlib
import os
import shutil
import socket
import subprocess
import sys
import textwrap
import time

import mujoco
import pytest

from conftest import need
from labkit.base import processes
from labkit.base.exchange import Exchange, Question
from labkit.sandbox import process
from labkit.sandbox.sandbox import Sandbox
from robo47.errors import Robo47Error
from robo47.paths import ROOT

pytestmark = pytest.mark.kit
LINUX = sys.platform.startswith("linux")
WALLS = ["bubblewrap", "landlock"]
each = pytest.mark.parametrize("name", WALLS)
SITE = os.path.dirname(os.path.dirname(mujoco.__file__))
# Walks up to the checker's own frame and empties the guard: four lines, no trick.
DISARM = """
import sys
import os
def disarm():
    frame = sys._getframe()
    while "watch" not in frame.f_locals:
        frame = frame.f_back
    watch = frame.f_locals["watch"]
    watch._check_path = lambda *a: None
    type(watch)._check.__globals__["_REFUSED"].clear()
    type(watch)._check.__globals__["_CHANGES"].clear()
disarm()
def libc(name, *args):
    import ctypes
    call = ctypes.CDLL(None, use_errno=True)[name]
    if call(*args) < 0:
        raise OSError(ctypes.get_errno(), name)
"""


@contextlib.contextmanager
def standing(name):
    """Put up a wall by name."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROBO47_WALL", name)
        process.wall.cache_clear()
        try:
            found = process.wall()
        except Robo47Error:
            need(False, f"the wall {name}")
        yield found
    process.wall.cache_clear()


ATTACKS = {
    "inherit a descriptor": """
        import stat
        for fd in range(64):
            try:
                mode = os.fstat(fd).st_mode
            except OSError:
                continue
            if not (stat.S_ISFIFO(mode) or stat.S_ISCHR(mode)):
                break
        else:
            raise OSError('none but its pipes')""",
    "read a file of the system": "open('/etc/hostname').read()",
    "read the reference solution": "open({reference!r}).read()",
    "read a file of the kit": "open({kit!r}).read()",
    "list the kit": "os.listdir({root!r})",
    "write a file": "open({new!r}, 'w')",
    "write into memory that looks like a file": """
        os.write(os.memfd_create('x'), b'x')""",
    "write where it stands": "open('was-here', 'w').write('x')",
    "write to shared memory": """
        import _posixshmem
        os.ftruncate(_posixshmem.shm_open('/r47', os.O_CREAT | os.O_RDWR, 0o600), 9)""",
    "take System V memory": "libc('shmget', 0, 4096, 0o1600)",
    "make a pipe with a name": "os.mkfifo({new!r})",
    "change who may read a file": "os.chmod({victim!r}, 0o777)",
    "change a file's times": "os.utime({victim!r}, (0, 0))",
    "cut a file": "os.truncate({victim!r}, 0)",
    "remove a file": "os.remove({victim!r})",
    "signal a process": "os.kill({other}, 0)",
    "signal everybody": "os.kill(-1, 0)",
    "signal a process by a handle": """
        import signal
        signal.pidfd_send_signal(os.pidfd_open({other}), 0)""",
    "signal a process by a pipe": """
        import fcntl
        r, w = os.pipe()
        fcntl.fcntl(r, fcntl.F_SETOWN, {other})
        assert fcntl.fcntl(r, fcntl.F_GETOWN) == {other}
        fcntl.fcntl(r, 10, 23)  # F_SETSIG, SIGURG""",
    "limit a process": """
        import resource
        resource.prlimit({other}, resource.RLIMIT_CORE, (0, 0))""",
    "slow a process down": "os.setpriority(os.PRIO_PROCESS, {other}, 19)",
    "read a process's environment": "open('/proc/{other}/environ').read()",
    "read a process's memory": "open('/proc/{other}/mem', 'rb')",
    "trace a process": "libc('ptrace', 16, {other}, 0, 0)",
    "start a program": "os.posix_spawn('/bin/sh', ['sh', '-c', 'true'], {{}})",
    "become another program": "os.execv({python!r}, ['python', '-c', 'pass'])",
    "fork": "os._exit(0) if os.fork() == 0 else None",
    "start a process below Python": """
        import _posixsubprocess as p
        r, w = os.pipe()
        p.fork_exec([b'x'], [{python!r}.encode()], True, (w,), None, None, -1, -1, -1,
            -1, -1, -1, r, w, False, False, -1, None, None, None, -1, None, True)""",
    "start a thread": """
        import threading
        threading.Thread(target=print).start()""",
    "connect to a socket with a path": """
        import socket
        socket.socket(socket.AF_UNIX).connect({unix!r})""",
    "connect to a socket without one": """
        import socket
        socket.socket(socket.AF_UNIX).connect({abstract!r})""",
    "connect to a port": """
        import socket
        socket.create_connection(('127.0.0.1', {port}))""",
    "look up a name": "__import__('socket').getaddrinfo('localhost', 80)",
    "find the real mujoco": """
        sys.path.append({site!r})
        for name in [n for n in sys.modules if n.startswith('mujoco')]:
            del sys.modules[name]
        sys.meta_path[:] = [m for m in sys.meta_path if isinstance(m, type)]
        import mujoco
        mujoco.mj_forward""",
    "find the real kit": """
        import importlib.util
        spec = importlib.util.spec_from_file_location('dyn', {kit!r})
        spec.loader.exec_module(importlib.util.module_from_spec(spec))""",
    "make a world of its own": "libc('unshare', 0x10000000)",
    "be another user": "os.setuid(1)",
    "be in no group": "os.setgroups([])",
    "hang the terminal up": "libc('vhangup')",
    "lock memory": "libc('mlockall', 1)",
    "mount something": "libc('mount', b'none', {folder!r}.encode(), b'tmpfs', 0, 0)",
    "use the other way to the kernel": "libc('syscall', 425, 8, 0)",
    "use the terminal": "open('/dev/tty', 'w')",
    "read a disk": "open('/dev/vda', 'rb')",
    "become another program by a handle": """
        import ctypes
        handle = os.open({python!r}, os.O_PATH)
        words = (ctypes.c_char_p * 4)(b'python', b'-c', b'pass', None)
        libc('syscall', 322, handle, b'', words, None, 0x1000)""",
    "handle page faults by itself": "libc('syscall', 323, 1)",
    "write to its memory as a file": "open('/proc/self/mem', 'r+b')",
    "signal the checker": """
        import signal
        signal.pidfd_send_signal(os.pidfd_open(os.getppid()), 0)""",
    "take the checker's descriptors": """
        libc('syscall', 438, os.pidfd_open(os.getppid()), 0, 0)""",
    "hand descriptors on": "__import__('socket').socketpair()",
    "keep a file in memory": "open('/dev/shm/robo47-test', 'w')",
    "keep a key in the kernel": "libc('syscall', 250, 0, -3, 1)",
    "keep a message in the kernel": "libc('syscall', 240, b'r47', 0o102, 0o600, 0)",
    "take a semaphore": "libc('semget', 0, 1, 0o1600)",
    "watch a folder": """
        fd = libc('inotify_init1', 0)
        libc('inotify_add_watch', fd or 0, {folder!r}.encode(), 4095)""",
    "make everybody wait at a file": """
        import fcntl
        import numpy
        held = os.open(numpy.__file__, os.O_RDONLY)
        fcntl.fcntl(held, 1024, 0)  # F_SETLEASE, F_RDLCK: now no one may write
        fcntl.fcntl(held, 1024, 2)""",
    "change a file's flags": """
        import ctypes, numpy
        fd, flags = os.open(numpy.__file__, os.O_RDONLY), ctypes.c_int()
        asked = ((0x80086601, 0), (0x40086602, 0x40))  # FS_IOC_GET, SETFLAGS: no dump
        for command, more in asked:
            flags.value |= more
            libc('ioctl', fd, ctypes.c_ulong(command), ctypes.byref(flags))""",
    "lock a file": """
        import fcntl
        import numpy
        fcntl.flock(os.open(numpy.__file__, os.O_RDONLY), fcntl.LOCK_SH)""",
    "take the system's slots": """
        import ctypes, platform
        number = 206 if platform.machine() == 'x86_64' else 0  # io_setup
        libc('syscall', number, 60_000, ctypes.byref(ctypes.c_ulong()))""",
    "take the kernel's timers": """
        import ctypes, platform
        number = 222 if platform.machine() == 'x86_64' else 107
        libc('syscall', number, 1, None, ctypes.byref(ctypes.c_int()))""",
    "outlive the checker": "libc('prctl', 1, 0, 0, 0, 0)",
    "raise its limits": """
        import resource
        resource.setrlimit(resource.RLIMIT_NPROC, (99, 99))""",
    "use system calls of 32 bits": """
        import platform
        if platform.machine() != 'x86_64': raise OSError('no such calls')
        libc('syscall', 0x40000000 + 41, 1, 1, 0)""",
    "leave code beside NumPy": """
        import numpy
        open(os.path.join(os.path.dirname(numpy.__file__), 'x.pth'), 'w')""",
    "move to another folder and back out": """
        fd = os.open('/', os.O_RDONLY)
        os.fchdir(fd)
        open(os.path.join({root!r}.lstrip('/'), 'README.md'))""",
}


@pytest.fixture(scope="module")
def places(tmp_path_factory):
    """Fill in what the attacks aim at; none would do harm if it got through."""
    folder = tmp_path_factory.mktemp("places")
    (folder / "victim.txt").write_text("mine")
    sleep = [sys.executable, "-c", "import time; time.sleep(3600)"]
    with contextlib.ExitStack() as stack:
        other = stack.enter_context(subprocess.Popen(sleep))
        stack.callback(other.kill)
        listening = [socket.socket(socket.AF_UNIX) for _ in range(2)]
        listening.append(socket.socket())
        path, name = str(folder / "s"), f"\0robo47-{os.getpid()}"
        for one, at in zip(listening, (path, name, ("127.0.0.1", 0)), strict=True):
            stack.enter_context(one).bind(at)
            one.listen()
        yield {
            "reference": str(ROOT / "w1-foundations/src/day1_transforms.py"),
            "kit": str(ROOT / "robo47" / "se3.py"),
            "root": str(ROOT),
            "site": SITE,
            "victim": str(folder / "victim.txt"),
            "other": other.pid,
            "new": str(folder / "new"),
            "folder": str(folder),
            "python": os.path.realpath(sys.executable),
            "unix": path,
            "abstract": name,
            "port": listening[2].getsockname()[1],
        }


@pytest.fixture(scope="module", params=WALLS)
def attacked(request, places, tmp_path_factory):
    """Run every attack behind a wall; return {attack: reply}."""
    script = tmp_path_factory.mktemp("attacks") / "attacks.py"
    names = {what: f"attack_{i}" for i, what in enumerate(ATTACKS)}
    code = DISARM
    for what, name in names.items():
        body = textwrap.dedent(ATTACKS[what].format(**places)).strip()
        code += f"def {name}():\n{textwrap.indent(body, '    ')}\n    return 47.0\n"
    script.write_text(code)
    replies = {}
    with standing(request.param), Sandbox() as box:
        session = box.session(script)
        for what, name in names.items():
            if not session.alive:
                session = box.session(script)
            (replies[what],) = session.ask([Question("", name, ())])
    return replies


@pytest.mark.skipif(not LINUX, reason="needs Linux: elsewhere there is no wall")
class TestAWall:
    @pytest.mark.parametrize("what", ATTACKS)
    def test_keeps_student_code_from(self, attacked, what):
        reply = attacked[what]
        assert reply.kind in (
            *("PermissionError", "FileNotFoundError", "OSError", "gaierror"),
            *("ModuleNotFoundError", "RuntimeError", "ValueError"),
        ), reply

    def test_leaves_every_target_as_it_was(self, attacked, places):
        with open(places["victim"]) as victim:
            assert victim.read() == "mine"
            status = os.fstat(victim.fileno())
        assert status.st_mode & 0o777 == 0o644
        assert status.st_mtime > 0
        assert not os.path.exists(places["new"])
        own = os.getpriority(os.PRIO_PROCESS, 0)
        assert os.getpriority(os.PRIO_PROCESS, places["other"]) == own

    @each
    def test_goes_down_with_the_checker(self, name, tmp_path):
        script = tmp_path / "sleeps.py"
        undone = "    try: libc('prctl', 1, 0, 0, 0, 0)\n    except OSError: 0\n"
        script.write_text(
            f"{DISARM}\nimport time\ndef f():\n{undone}    time.sleep(600)"
        )
        code = (
            "import sys, pathlib\n"
            "from labkit.sandbox.sandbox import *\n"
            "box = Sandbox()\n"
            "process = box.session(pathlib.Path(sys.argv[1]))._process\n"
            "process.ask([{'function': name, 'args': []} for name in ('none', 'f')])\n"
            "process.next(60)  # so it sleeps by now, and reads no more\n"
            "print(process.process.pid, flush=True)\n"
            "process.next(600)\n"
        )
        with standing(name):
            checker = subprocess.Popen(
                [sys.executable, "-c", code, str(script)],
                stdout=subprocess.PIPE,
                cwd=ROOT,
            )
        with checker:
            pid = int(checker.stdout.readline())
            family = processes._family(pid)
            checker.kill()
        assert are_gone(family, 20)

    def test_filters_calls_where_the_kernel_has_no_landlock(self, monkeypatch, student):
        code = f"{DISARM}def f(): {ATTACKS['hand descriptors on']}"
        script = student(code)
        inside = shutil.copytree(process.INSIDE, script.parent / "inside")
        with (inside / "landlock.py").open("a") as landlock:
            landlock.write("def fence(readable): return False\n")
        monkeypatch.setattr(process, "INSIDE", inside)
        with standing("bubblewrap"), Sandbox() as box:
            (reply,) = box.session(script).ask([Question("", "f", ())])
        assert reply.kind == "PermissionError"

    @each
    def test_hides_no_memory_from_the_watch(self, name, tmp_path):
        script = tmp_path / "large.py"
        script.write_text("import numpy as np\nX = np.ones(25_000_000)\ndef f(): 0")
        with standing(name), Sandbox() as box:
            session = box.session(script)
            session.ask([Question("", "f", ())])
            assert processes.resident_bytes(session._process.process) > 200_000_000

    @each
    def test_lets_a_task_use_all_of_python_and_numpy(self, name, tmp_path):
        script = tmp_path / "late.py"
        script.write_text(
            "def f():\n"
            "    import decimal, fractions, random, sqlite3, zoneinfo, ctypes, uuid\n"
            "    import numpy.random, numpy.fft, numpy.polynomial, numpy.testing\n"
            "    return numpy.random.default_rng(0).normal(size=(30, 30)) @ "
            "numpy.linalg.inv(numpy.eye(30) * 2)\n"
        )
        with standing(name), Sandbox() as box:
            box.run(script, [asked := Exchange(Question("", "f", ()))])
        assert asked.reply.error == ""
        assert asked.reply.value.shape == (30, 30)


def are_gone(pids, seconds):
    """Return whether no process lives any more (a zombie does not), after a while."""

    def lives(pid):
        try:
            with open(f"/proc/{pid}/stat") as stat:
                return stat.read().rsplit(")", 1)[1].split()[0] != "Z"
        except OSError:
            return False

    deadline = time.monotonic() + seconds
    while (left := any(map(lives, pids))) and time.monotonic() < deadline:
        time.sleep(0.05)
    return not left


class TestTheNameOfTheWall:
    @pytest.fixture(autouse=True)
    def looked_for_anew(self):
        process.wall.cache_clear()
        yield
        process.wall.cache_clear()

    def test_is_the_first_that_works(self, monkeypatch):
        monkeypatch.delenv("ROBO47_WALL", raising=False)
        for works, found in (
            ((True, True), "bubblewrap"),
            ((False, True), "landlock"),
            ((False, False), "none"),
        ):
            monkeypatch.setattr(process, "_bubblewrap_works", lambda w=works: w[0])
            monkeypatch.setattr(process, "_landlock_works", lambda w=works: w[1])
            process.wall.cache_clear()
            assert process.wall().name == found
        assert "with your rights" in process.wall().says

    def test_says_when_it_was_asked_for(self):
        with standing("none") as found:
            assert "ROBO47_WALL asks for it" in found.says

    @pytest.mark.parametrize("name", ["granite", "landlock"])
    def test_is_an_error_where_there_is_no_such_wall(self, name, monkeypatch):
        monkeypatch.setenv("ROBO47_WALL", name)
        monkeypatch.setattr(process, "_landlock_works", lambda: False)
        with pytest.raises(Robo47Error, match=name):
            process.wall()

    def test_does_not_pass_for_one_that_did_not_close(self, monkeypatch, student):
        need(LINUX, "Linux")
        with standing("none"), Sandbox() as box:
            warm = box._warm
            monkeypatch.setattr(warm, "wall", process.Wall("landlock", ""))
            with pytest.raises(Robo47Error, match="did not close"):
                box.run(student("def f(): 0"), [Exchange(Question("", "f", ()))])
            warm.close()
