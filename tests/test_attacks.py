"""Student code that hangs, harms, forges or looks things up: none of it pays.

What each wall keeps out once the guard is switched off is in test_walls.py.
"""

import importlib.util
import os
import py_compile
import re
import textwrap
import time
import tracemalloc

import pytest

from labkit.base import git
from labkit.base.exchange import Question
from labkit.check.tasks import check_tasks
from labkit.grade import pull
from labkit.lesson.added_code import kits_own
from labkit.lesson.borrowed import with_borrowed
from labkit.lesson.day import Limits, all_days, find_day
from labkit.lesson.starter import make_starter
from labkit.lesson.untrusted_files import SCRIPT
from labkit.sandbox import process, sandbox
from labkit.sandbox.messages import library_of
from robo47.errors import Robo47Error
from robo47.paths import METRICS_CSV, ROOT

pytestmark = pytest.mark.kit
UNCHECKED = py_compile.PycInvalidationMode.UNCHECKED_HASH
DAY = find_day(1)
REFERENCE = DAY.source.read_text("utf-8")
DEF = re.compile(r"(?:\W*exec\(\W)?def (\w+)")


def attack(line, after=""):
    """Return the reference solution with a line of mischief in its first function."""
    text = REFERENCE.replace("    T = np.eye(4)", f"    {line}\n    T = np.eye(4)", 1)
    return after + text


# How a helper file may look for a module m of the kit: returns what it found.
HELPERS_WAYS = (
    "import importlib; return importlib.import_module('robo47.' + m)",
    "return __import__('robo47.' + m, fromlist=['x'])",
    "__import__('robo47.' + m); return sys.modules['robo47.' + m]",
    "return next(v for k, v in list(sys.modules.items()) if k.split('.')[-1] == m)",
    """
    import importlib.util as u
    spec = u.spec_from_file_location('x', KIT + '/robo47/' + m + '.py')
    found = u.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found""",
    "sys.path.insert(0, KIT + '/robo47'); return __import__(m)",
    """
    import robo47
    robo47.__path__ = [KIT + '/robo47']
    sys.modules.pop('robo47.' + m, None)
    return __import__('robo47.' + m, fromlist=['x'])""",
    """
    kept = sys.meta_path[:]
    sys.meta_path[:] = [f for f in kept if isinstance(f, type)]
    sys.path.append(KIT)
    lost = {n: sys.modules.pop(n) for n in list(sys.modules) if n[:6] == 'robo47'}
    try:
        return __import__('robo47.' + m, fromlist=['x'])
    finally:
        sys.meta_path[:] = kept
        sys.path.pop()
        sys.modules.update(lost)""",
    """
    import types
    for finder in sys.meta_path:
        if 'robo47.' + m in getattr(finder, '_sources', {}):
            found = types.ModuleType(m)
            exec(finder._sources['robo47.' + m][0], vars(found))
            return found""",
    """
    import pkgutil, types
    found = types.ModuleType(m)
    exec(pkgutil.get_data('robo47', m + '.py'), vars(found))
    return found""",
    """
    import inspect, types
    found = types.ModuleType(m)
    exec(inspect.getsource(__import__('robo47.' + m, fromlist=['x'])), vars(found))
    return found""",
    """
    import linecache, types
    found = types.ModuleType(m)
    exec(''.join(linecache.getlines(KIT + '/robo47/' + m + '.py')), vars(found))
    return found""",
    """
    import types
    frame, found = sys._getframe(), types.ModuleType(m)
    while 'request' not in frame.f_locals:
        frame = frame.f_back
    exec(frame.f_locals['request']['library']['robo47.' + m], vars(found))
    return found""",
    "import runpy, types; return types.SimpleNamespace(**runpy.run_path("
    "KIT + '/robo47/' + m + '.py'))",
)


class TestAnAttack:
    def test_is_the_reference_solution_with_mischief_in_it(self, check):
        statuses = {verdict.status for verdict in check(attack("pass")).values()}
        assert statuses == {"passed"}

    @pytest.mark.parametrize(
        "line",
        [
            "import os; os._exit(0)",
            "import sys; sys.exit(0)",
            "raise SystemExit(0)",
            "import os; os.kill(os.getpid(), 9)",
        ],
    )
    def test_that_ends_python_passes_nothing_that_it_touches(self, check, line):
        verdicts = check(attack(line))
        assert verdicts["1.1"].status == "wrong"
        assert verdicts["1.2"].status == "passed"

    def test_that_loops_forever_costs_its_own_tasks_only(self, check, monkeypatch):
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 0.5)
        verdicts = check(attack("while True: pass"))
        assert verdicts["1.1"].mistake == "stopped"
        assert "loop" in verdicts["1.1"].message
        assert verdicts["1.4"].status == "passed"

    def test_that_waits_a_little_at_every_call_is_stopped_too(self, ask, monkeypatch):
        monkeypatch.setattr(sandbox, "TASK_SECONDS", 1.0)
        questions = [Question("1.1", "f", ())] * 50
        replies = ask("import time\ndef f(): time.sleep(0.2); return 1.0", *questions)
        assert replies[-1].kind == "stopped"
        assert replies[0].value == 1

    def test_that_starts_processes_or_leaves_python_is_refused(self, ask):
        ways = {
            "subprocess.run([sys.executable])": "start another",
            "os.system('echo PASSED')": "start another",
            "multiprocessing.Process(target=print).start()": "start another",
            "ctypes.CDLL(None)": "call into a foreign",
            "socket.create_connection(('127.0.0.1', 9))": "use the network",
            "gc.get_objects()": "search the interpreter's",
            "os.symlink('/', 'root')": "write to",
        }
        if hasattr(os, "fork"):
            ways["os.fork()"] = "start another"
        modules = "ctypes, gc, multiprocessing, os, socket, subprocess, sys"
        code = [f"def f{i}(): import {modules}; {w}\n" for i, w in enumerate(ways)]
        asked = [Question("1.1", f"f{i}", ()) for i in range(len(ways))]
        replies = ask("".join(code), *asked)
        assert {reply.kind for reply in replies} == {"RefusedError"}
        for reply, refused in zip(replies, ways.values(), strict=True):
            assert reply.refused[0].startswith(refused)

    @pytest.mark.parametrize(
        "code",
        [
            "import numpy as np\ndef f(): return np.ones(100 * 2**27).sum()",
            "def f():\n    x = []\n    while True: x.append(bytearray(10**7))",
        ],
    )
    def test_that_takes_the_memory_at_once_or_bit_by_bit_is_ended(self, ask, code):
        assert ask(code)[0].kind in ("MemoryError", "stopped")

    def test_that_prints_passed_or_a_forged_reply_passes_nothing(self, check):
        forged = '{"at": 0, "value": {"array": {"dtype": "f8"}}}'
        line = f"print('PASSED'); print('{forged}', flush=True); return None"
        verdict = check(attack(line), "1.1")["1.1"]
        assert verdict.mistake == "nothing-returned"

    def test_that_writes_to_every_open_channel_is_found_out(self, check):
        code = (
            "import os\n    for fd in range(64):\n        try: os.write(fd, b'PASSED')"
        )
        code += "\n        except OSError: pass"
        assert check(attack(code), "1.1")["1.1"].mistake == "stopped"

    def test_that_closes_the_channel_and_goes_on_is_found_out(self, ask, monkeypatch):
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 0.3)
        (reply,) = ask(
            "import os\ndef f():\n    os.closerange(0, 64)\n    while True: 0"
        )
        assert reply.kind == "stopped"

    @pytest.mark.parametrize(
        "code",
        [
            "class E:\n    def __eq__(self, other): return True\n",
            "class E:\n    def __array__(self, *a, **k): return np.eye(4)\n",
            "class E(float):\n    def __eq__(self, other): return True\n",
            "class E(np.ndarray):\n"
            "    def __new__(c): return np.zeros((4, 4)).view(c)\n"
            "    def __eq__(self, other): return np.ones((4, 4), bool)\n"
            "    def __array__(self, *a, **k): return np.eye(4)\n",
        ],
    )
    def test_with_an_object_that_equals_everything_passes_nothing(self, check, code):
        mischief = REFERENCE.replace("    return T\n", "    return E()\n", 1)
        mischief = mischief.replace("READY_Q =", f"{code}\nREADY_Q =", 1)
        assert check(mischief, "1.1")["1.1"].status == "wrong"

    @pytest.mark.parametrize(
        "patch",
        [
            "np.allclose = np.array_equal = lambda *a, **k: True",
            "np.abs = lambda x: 0.0",
            "np.ndarray.__module__",
            "import sys; sys.modules['labkit.check'] = sys.modules['numpy'] = None",
            "import builtins; builtins.abs = builtins.max = lambda *a: 0.0",
        ],
    )
    def test_that_patches_numpy_or_the_checker_passes_nothing(self, check, patch):
        wrong = REFERENCE.replace("T[:3, 3] = t", "T[:3, 3] = -t", 1)
        wrong = wrong.replace("READY_Q =", f"{patch}\nREADY_Q =", 1)
        assert check(wrong, "1.1")["1.1"].status == "wrong"

    def test_that_hides_a_complaint_hides_no_wrong_number(self, check):
        """What the sandbox says of itself is advice; numbers are judged outside."""
        hide = "import sys\n    it = sys._getframe()\n"
        hide += "    while '_differs' not in it.f_globals: it = it.f_back\n"
        hide += "    it.f_globals['_differs'] = lambda *a: False\n    t += 1"
        hidden = attack(hide).replace("T[:3, 3] = t", "T[:3, 3] = t - 1", 1)
        assert check(hidden, "1.1")["1.1"].status == "passed"
        wrong = attack(hide).replace("T[:3, 3] = t", "T[:3, 3] = -t", 1)
        assert check(wrong, "1.1")["1.1"].status == "wrong"

    @pytest.mark.parametrize(
        "line",
        [
            f"return exec(open({str(DAY.source)!r}).read())",
            f"import shutil; shutil.copy({str(DAY.source)!r}, 'x.py')",
        ],
    )
    def test_that_reads_the_reference_solution_is_refused(self, check, line):
        verdict = check(attack(line), "1.1")["1.1"]
        assert verdict.mistake == "refused"
        assert "day1_transforms.py" in verdict.message or "src" in verdict.message
        assert str(ROOT) not in verdict.message

    @pytest.mark.parametrize(
        ("body", "names"),
        [
            ("mujoco.mj_kinematics(model, mujoco.MjData(model))", "mujoco.MjData"),
            ("mujoco.mj_forward(model, None)", "mujoco.mj_forward"),
            ("mujoco.mju_quat2Mat(np.zeros(9), q)", "mujoco.mju_quat2Mat"),
            ("from robo47 import kinematics as k; k.fk(0, q)", "robo47.kinematics.fk"),
            ("from robo47.se3 import make_T as m; m(0, q)", "robo47.se3.make_T"),
            ("verify.mujoco_poses(model, q)", "robo47.verify.mujoco_poses"),
        ],
    )
    def test_that_calls_for_the_answer_is_refused_by_name(self, check, body, names):
        code = REFERENCE.replace("    T_world_body = np.eye(4)", f"    {body}", 1)
        verdict = check(code, "1.6")["1.6"]
        assert verdict.mistake == "not-by-hand"
        assert names in verdict.message

    def test_that_digs_for_the_real_mujoco_meets_the_fake_again(self, check):
        line = "import sys; del sys.modules['mujoco']; import mujoco"
        line += "; mujoco.mj_forward(None, None)"
        assert check(attack(line), "1.1")["1.1"].mistake == "not-by-hand"

    def test_by_a_helper_file_finds_no_library_of_its_day_or_a_later_one(
        self, ask, student
    ):
        days = [day for day in all_days() if day.number > 1]
        names = [name for day in (DAY, *days) for name in day.library]
        assert {"se3", "trajectory"} <= set(names)
        library = library_of(days[1])  # day 3 may import what days 1 and 2 brought
        names = [name for name in names if f"robo47.{name}" not in library]
        code = "".join(
            f"def way{i}(m):\n{textwrap.indent(textwrap.dedent(way), '    ')}\n"
            for i, way in enumerate(HELPERS_WAYS)
        )
        helper = f"import sys\nKIT = {str(ROOT)!r}\n{code}"
        student(helper, "helper.py")
        script = f"""
            import helper
            NAMES = {names!r}
            def f(way, name):
                import types
                try:
                    found = vars(getattr(helper, f"way{{way}}")(NAMES[name]))
                except (Exception, SystemExit):
                    return 0.0
                real = (types.FunctionType, types.BuiltinFunctionType)
                return float(any(isinstance(v, real) for v in found.values()))
        """
        asked = [
            Question("", "f", (way, name))
            for way in range(len(HELPERS_WAYS))
            for name in range(len(names))
        ]
        replies = ask(script, *asked, library=library)
        through = [
            (HELPERS_WAYS[q.args[0]], names[q.args[1]])
            for q, reply in zip(asked, replies, strict=True)
            if reply.error or reply.value != 0
        ]
        assert through == []

    @pytest.mark.parametrize("links", [False, True])
    def test_by_a_link_beside_the_file_is_no_file_of_ones_own(
        self, ask, student, links
    ):
        own = student("", "day1_transforms.py").parent
        text = (ROOT / "robo47" / "se3.py").read_text("utf-8")
        if links:
            (own / "mine.py").symlink_to(ROOT / "robo47" / "se3.py")
        else:
            (own / "mine.py").write_text(text)  # a copy runs: a grade shows it
        code = "def f():\n    import mine\n    return 47.0"
        library = library_of(find_day(2))
        assert ask(code, library=library)[0].kind == (
            "ModuleNotFoundError" if links else ""
        )

    def test_with_code_that_python_would_run_unasked_runs_none_of_it(
        self, ask, student
    ):
        own = student("", "sitecustomize.py").parent
        mark = own / "ran"
        evil = f"open({str(mark)!r}, 'w').close()"
        for name in ("sitecustomize.py", "usercustomize.py", "conftest.py"):
            (own / name).write_text(evil)
        (own / "evil.pth").write_text(f"import os; {evil}")
        (own / "__pycache__").mkdir()
        source = own / "elsewhere.txt"
        source.write_text("def g(): return 13.0")
        cached = importlib.util.cache_from_source(str(own / "helper.py"))
        py_compile.compile(str(source), cached, invalidation_mode=UNCHECKED)
        student("def g(): return 47.0", "helper.py")
        (reply,) = ask("import helper\ndef f(): return helper.g()")
        assert reply.value == 47
        assert not mark.exists()

    def test_that_writes_outside_its_folder_changes_nothing(self, ask, tmp_path):
        precious = tmp_path / "precious.txt"
        precious.write_text("mine")
        actions = (
            f"open({str(precious)!r}, 'w')",
            f"os.remove({str(precious)!r})",
            f"os.rename({str(precious)!r}, 'x')",
            f"os.open({str(precious)!r}, os.O_WRONLY | os.O_TRUNC)",
            f"os.truncate({str(precious)!r}, 0)",
        )
        code = [f"def f{i}(): {action}\n" for i, action in enumerate(actions)]
        asked = [Question("1.1", f"f{i}", ()) for i in range(len(actions))]
        replies = ask("import os\n" + "".join(code), *asked)
        assert [reply.kind for reply in replies] == ["RefusedError"] * len(actions)
        assert precious.read_text() == "mine"

    def test_on_the_metrics_file_leaves_it_as_it_is(self, check):
        before = METRICS_CSV.read_bytes()
        verdict = check(attack(f"open({str(METRICS_CSV)!r}, 'w')"), "1.1")["1.1"]
        assert verdict.mistake == "refused"
        assert METRICS_CSV.read_bytes() == before


class TestHugeNumbers:
    """Finite, and no linear algebra survives them."""

    @pytest.mark.parametrize(
        ("number", "name"),
        [(4, "mass_matrix"), (6, "task_inertia"), (6, "critical_damping")],
    )
    @pytest.mark.parametrize("size", ["1e308", "-1e200", "1e40"])
    def test_are_named_and_stop_nobody(self, student, number, name, size):
        day = find_day(number)
        wraps = f"def {name}(*a, it={name}): return np.full(np.shape(it(*a)), {size})"
        code = day.source.read_text("utf-8").replace(
            'if __name__ == "__main__":', f'{wraps}\n\nif __name__ == "__main__":'
        )
        (task,) = (t for t in day.tasks if name in t.functions)
        with sandbox.Sandbox() as box:
            (found,) = check_tasks(day, student(code, day.script), box, task.id, seed=1)
        assert found.verdict.mistake == "huge-numbers"
        says = f"It returns numbers as large as {abs(float(size)):.0e}, "
        says += "far larger"
        assert says in found.verdict.message

    @pytest.mark.parametrize("coding", ["rot13", "hex", "undefined", "klingon"])
    def test_and_codings_that_no_text_has_are_said_in_a_line(self, check, coding):
        verdicts = check(f"# coding: {coding}\n{REFERENCE}")
        assert {verdict.mistake for verdict in verdicts.values()} == {"does-not-load"}


class TestAFile:
    """What takes long to read is refused unread, or read once."""

    @pytest.mark.parametrize("more", ["def f(): 0\n", "(lambda: 0)\n", "f() < 1\n"])
    def test_of_thousands_of_definitions_is_too_large(self, student, more):
        script = student(more * 20_000)
        with sandbox.Sandbox() as box, pytest.raises(Robo47Error, match="100 kB"):
            check_tasks(DAY, script, box)

    @pytest.mark.parametrize("deep", ["-" * 1_400 + "1", "[" * 90 + "]" * 90])
    def test_that_goes_deep_is_not_followed(self, check, deep):
        starter = make_starter(REFERENCE, "starter", 1)
        gap = 'raise NotImplementedError("task 1.1: write make_T")'
        assert gap in starter
        code = starter.replace(gap, f"raise NotImplementedError({deep})")
        assert check(code, "1.1")["1.1"].mistake == "unwritten"

    def test_is_compiled_once(self, ask):
        (reply,) = ask("""
            import sys
            def f(): return 10.0 * len(sys.seen) + len(set(map(id, sys.seen)))
            sys.seen = [*getattr(sys, "seen", []), f.__code__]
        """)
        assert (reply.value, reply.again) == (11, 21)

    def test_that_prints_without_end_is_not_asked_on_and_on(self, ask):
        code = """
            n = 0
            def f():
                global n
                n += 1
                try:
                    print("x" * 3_000_000)
                except RuntimeError:
                    return 1.0
            def g(): return float(n)
        """
        *asked, last = [*[Question("1.1", "f", ())] * 3, Question("1.2", "g", ())]
        *flood, count = ask(code, *asked, last)
        assert {(one.kind, one.error) for one in flood} == {
            ("RuntimeError", "it prints more than 2 MB in a call")
        }
        assert count.value == 1


class TestABorrowedFunction:
    """The kit's own stands in the file of whoever borrows it, and nothing beside it."""

    def borrowed(self, others):
        starter = make_starter(REFERENCE, "starter", 1)
        return with_borrowed(starter, REFERENCE, ["make_T"]) + "".join(
            f"\ndef {name}(*a): return {others.format(name=name)}(*a)\n"
            for task in DAY.tasks[1:]
            for name in task.functions
        )

    @pytest.mark.parametrize(
        "others",
        [
            "_kits[{name!r}]",
            "make_T.__globals__['_kits'][{name!r}]",
            "__import__('sys')._getframe(1).f_globals['{name}_kits']",
        ],
    )
    def test_hands_out_no_other(self, check, others):
        verdicts = check(self.borrowed(others))
        assert verdicts["1.1"].mistake == "borrowed"
        assert {"passed"}.isdisjoint(verdict.status for verdict in verdicts.values())

    def test_works_for_what_builds_on_it(self, check):
        verdicts = check(with_borrowed(REFERENCE, REFERENCE, ["make_T", "link_T"]))
        found = {id: verdict.status for id, verdict in verdicts.items()}
        assert [id for id, status in found.items() if status != "passed"] == [
            "1.1",
            "1.5",
        ]

    def test_brings_no_line_of_another_task(self):
        for day in all_days():
            for task in day.tasks:
                lines = kits_own(day, [task]).replace("\\n", "\n").splitlines()
                brought = [found[1] for ln in lines if (found := DEF.match(ln))]
                assert sorted(brought) == sorted(task.functions)


class TestAForgedMessage:
    """Code that finds the channel and its secret can say anything about itself."""

    FIND = """
        import json
        import os
        import sys
        import time
        ONE = '{"dtype": "i1", "shape": [1], "data": "AA=="}'
        def find():
            frame = sys._getframe()
            while "channel" not in frame.f_locals:
                frame = frame.f_back
            return frame.f_locals["channel"], frame.f_locals["request"]["secret"]
        def send(text, times=1):
            out, secret = find()
            out.write((secret + text + "\\n").encode("ascii", "surrogatepass") * times)
            out.flush()
    """

    @pytest.mark.parametrize(
        "body",
        [
            "send('[1]')",
            "send('{')",
            "send('not json')",
            "send(json.dumps({'loaded': True}))",
            "send(json.dumps({'ready': True}))",
            "send(json.dumps({'at': 7}))",
            "send(json.dumps({'at': 'load'}))",
            "send('[' * 200_000)",
            "send('{\"at\": 0, \"value\": ' + '[' * 9000 + ']' * 9000 + '}')",
            'send(\'{"at": 0, "value": {"array": {"dtype": "f8", \''
            '\'"shape": [1e400], "data": ""}}}\')',
            'send(\'{"at": 0, "value": {"array": {"dtype": [], '
            '"shape": {}, "data": 5}}}\')',
            "send('{\"at\": 0, \"line\": 1' + '0' * 5000 + '}')",
            "find()[0].write(b'x' * 30_000_000); find()[0].flush()",
            'send(\'{"at": 0, "value": {"tuple": [\' + \', \'.join([ONE] * 200) + '
            "']}}')",
            "send('{\"at\": 0, \"x\": [' + '[], ' * 1_000_000 + '0]}')",
            "send('{\"at\": 0}', times=100_000)",
            "send(json.dumps({'loaded': True}), times=100_000)",
            "find()[0].close(); time.sleep(60)",
            "os.closerange(0, 64); time.sleep(60)",
        ],
    )
    def test_costs_its_own_task_whatever_it_is(self, ask, body, monkeypatch):
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 2.0)
        code = f"{self.FIND}\n        def f(): {body}\n        def g(): return 47.0"
        odd, fine = ask(code, Question("1.1", "f", ()), Question("1.2", "g", ()))
        assert odd.kind in ("stopped", "unsendable", "")
        assert odd.value is None
        # Where the first is taken for an answer, the real one is one message too many.
        assert fine.kind == "stopped" or fine.value == fine.again == 47

    def test_of_any_size_is_no_more_than_so_much_for_all_questions(self, ask):
        """Replies wait unread until there is room, and all together are bounded."""
        code = "import numpy as np\ndef f(): return np.ones(100_000)"
        replies = ask(code, *[Question("1.1", "f", ())] * 60)
        assert replies[-1].error == "its answers are far too large, all together"
        assert process.MOST_WAITING * process.LONGEST_LINE < 50_000_000

    def test_of_many_small_parts_is_not_taken_apart(self, ask):
        many = "send('{\"at\": 0, \"x\": [' + '[], ' * 400_000 + '0]}')"
        tracemalloc.start()
        (reply,) = ask(f"{self.FIND}\n        def f(): {many}")
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert reply.kind == "stopped"
        assert peak < 15_000_000  # its parts alone: 26 MB

    def test_while_the_file_is_loaded_does_not_make_the_checker_wait(self, ask):
        code = (
            self.FIND
            + """
        while True:
            send(json.dumps({"loaded": True}))
            time.sleep(0.2)
        """
        )
        (reply,) = ask(code)
        assert reply.kind == "stopped"

    def test_of_any_text_arrives_cut_and_harmless(self, ask):
        code = """
            class Odd(Exception):
                def __str__(self): return TEXT
            Odd.__name__ = "x" * 1_000_000
            TEXT = "\\x1b]0;OWNED\\x07\\ud800\\u202e\\r\\n  1.1  make_T   passed"
            TEXT += "y" * 10**6
            def f():
                print(TEXT)
                raise Odd
            def g(): open("/" + "x" * 1_000_000)
        """
        odd, long = ask(code, Question("1.1", "f", ()), Question("1.2", "g", ()))
        for text in (odd.error, odd.kind, *long.refused, long.error):
            assert text.isprintable()
            assert len(text) < 600
        assert odd.error.startswith("]0;OWNED ?")
        assert all(line.isprintable() for line in odd.printed.splitlines())
        assert len(odd.printed) < 10_000

    def test_flood_between_two_rounds_is_bounded(self, student, monkeypatch):

        code = (
            self.FIND
            + """
        def f():
            import atexit
            return 1.0
        def g():
            send("{}", times=1_000_000)
        """
        )
        with sandbox.Sandbox() as box:
            session = box.session(student(code))
            session._process.ask([{"function": "g", "args": []}])
            time.sleep(0.5)
            assert session._process._in.qsize() <= process.MOST_WAITING
            (reply,) = session.ask([Question("", "f", ())])
            assert reply.kind == "stopped"


def test_the_teachers_guide_tells_the_limits_that_hold():
    guide = " ".join((ROOT / "docs" / "teaching.md").read_text("utf-8").split())
    for says in (
        f"{sandbox.RUN_SECONDS:.0f} s of one processor and "
        f"{DAY.lab_seconds:.0f} s of its lab",
        f"{Limits().memory:.0f} GB of memory",
        f"{process.MOST_BYTES // 10**6} MB of replies",
        f"{git.SECONDS:.0f} s of git's",
        f"{pull.SECONDS} s and {git.LARGEST_GIT // 10**9} GB of disk",
        f"of which {git.LARGEST_TREE // 10**6} MB stay",
        f"more than {SCRIPT // 1000} kB is not read",
    ):
        assert says in guide
