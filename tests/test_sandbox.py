"""Student code that hangs, harms, forges or looks things up: none of it pays."""

import os
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest

from robo47 import verify
from robo47.checker import process, tasks, variant
from robo47.checker.inside import standins, wire
from robo47.checker.model_copy import copy_model, facts
from robo47.checker.replies import LoadError, Model, Question
from robo47.checker.sandbox import Sandbox
from robo47.paths import METRICS_CSV, ROOT
from robo47.week import find_day

DAY = find_day(1)
REFERENCE = DAY.source.read_text("utf-8")
LINUX = sys.platform.startswith("linux")


@pytest.fixture
def student(tmp_path):
    """Write a student's file and return its path."""

    def write(code, name="day1_transforms.py"):
        path = tmp_path / "work" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(textwrap.dedent(code), "utf-8")
        return path

    return write


@pytest.fixture
def ask(student):
    """Ask a student's file for `f()`, or for what is given."""

    def run(code, *questions):
        with Sandbox() as sandbox:
            models = [copy_model(model) for model in variant.models()]
            asked = questions or [Question("1.1", "f", ())]
            return sandbox.run(student(code), asked, models, facts())

    return run


@pytest.fixture
def check(student):
    """Check a student's file; return {task: verdict}."""

    def run(code, only=None):
        with Sandbox() as sandbox:
            results = tasks.check_tasks(DAY, student(code), sandbox, only)
        return {result.task.id: result.verdict for result in results}

    return run


def attack(line, after=""):
    """Return the reference solution with a line of mischief in its first function."""
    text = REFERENCE.replace(
        "    T = np.eye(4)\n", f"    {line}\n    T = np.eye(4)\n", 1
    )
    return after + text


class TestWhatComesBack:
    def test_is_what_the_function_returned_bit_for_bit(self, ask):
        (reply,) = ask("import numpy as np\ndef f(): return np.array([[0.1, -0.0]])")
        assert reply.value.dtype == np.float64
        assert reply.value.tobytes() == np.array([[0.1, -0.0]]).tobytes()

    @pytest.mark.parametrize("code", ["i8", "f4", "f2", "b1", "u1"])
    def test_keeps_its_number_type_for_the_judge_to_see(self, ask, code):
        (reply,) = ask(f"import numpy as np\ndef f(): return np.ones(3, '{code}')")
        assert reply.value.dtype == np.dtype(code)

    def test_may_be_a_tuple_a_list_a_number_or_nothing(self, ask):
        code = """
            import numpy as np
            def f(): return np.ones(3), np.zeros(3)
            def g(): return [[1.0, 2.0], [3.0, 4.0]]
            def h(): return 2.5
            def i(): pass
        """
        pair, rows, number, nothing = ask(
            code, *(Question("1.1", name, ()) for name in "fghi")
        )
        assert [part.tolist() for part in pair.value] == [[1, 1, 1], [0, 0, 0]]
        assert rows.value.tolist() == [[1, 2], [3, 4]]
        assert number.value == 2.5
        assert nothing.value is None
        assert not nothing.kind

    @pytest.mark.parametrize(
        ("value", "says"),
        [
            ("'PASSED'", "a str; expected a NumPy array"),
            ("np.array(['a'])", "dtype"),
            ("np.array([object()])", "dtype object"),
            ("np.ones(4, complex)", "dtype complex128"),
            ("np.ones(200_000)", "far too large"),
            ("[[1, 2], [3]]", "a list that is no array"),
        ],
    )
    def test_is_refused_where_it_is_no_plain_array(self, ask, value, says):
        (reply,) = ask(f"import numpy as np\ndef f(): return {value}")
        assert reply.kind == "unsendable"
        assert says in reply.error

    def test_names_the_line_of_the_students_own_file(self, ask):
        (reply,) = ask(
            "import numpy as np\ndef f():\n    return np.ones(3) @ np.eye(4)"
        )
        assert reply.kind == "ValueError"
        assert reply.line == 3

    def test_leaves_what_was_printed_aside(self, ask):
        (reply,) = ask("def f():\n    print('PASSED')\n    return 1.0")
        assert reply.printed == "PASSED\n"
        assert reply.value == 1

    def test_gets_fresh_arguments_at_every_call(self, ask):
        code = "def f(model, q):\n    model.body_pos[:] = 7\n    q += 1\n    return q"
        question = Question("1.6", "f", (Model(0), np.zeros(2)))
        first, second = ask(code, question, question)
        assert first.value.tolist() == second.value.tolist() == [1, 1]

    def test_may_use_a_module_of_the_students_beside_the_file(self, ask, student):
        student("def g(): return 3.0", "helpers.py")
        (reply,) = ask("import helpers\ndef f(): return helpers.g()")
        assert reply.value == 3


class TestAFileThatDoesNotLoad:
    @pytest.mark.parametrize(
        ("code", "kind", "line"),
        [
            ("def f()\n    return 1", "SyntaxError", 1),
            ("def f():\nreturn 1", "IndentationError", 2),
            ("import nothing_of_that_name", "ModuleNotFoundError", 1),
            ("x = 1\ny = 1 / 0", "ZeroDivisionError", 2),
            ("import sys\nsys.exit(0)", "SystemExit", 2),
            ("raise KeyboardInterrupt", "KeyboardInterrupt", 1),
        ],
    )
    def test_is_told_with_its_line(self, ask, code, kind, line):
        with pytest.raises(LoadError) as caught:
            ask(code)
        assert (caught.value.reply.kind, caught.value.reply.line) == (kind, line)

    @pytest.mark.parametrize(
        "code", ["import os\nos._exit(0)", "\0", "while True: pass"]
    )
    def test_is_told_without_a_line_where_there_is_none(self, ask, code, monkeypatch):
        monkeypatch.setattr(process, "LOAD_SECONDS", 1.0)
        with pytest.raises(LoadError) as caught:
            ask(code)
        assert caught.value.reply.error

    def test_fails_every_task_and_passes_none(self, check):
        verdicts = check("import sys\nsys.exit(0)\n" + REFERENCE)
        assert {verdict.mistake for verdict in verdicts.values()} == {"does-not-load"}


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
        monkeypatch.setattr(process, "CALL_SECONDS", 1.0)
        verdicts = check(attack("while True: pass"))
        assert verdicts["1.1"].mistake == "stopped"
        assert "loop" in verdicts["1.1"].message
        assert verdicts["1.4"].status == "passed"

    def test_that_waits_a_little_at_every_call_is_stopped_too(self, ask, monkeypatch):
        monkeypatch.setattr(process, "ALL_SECONDS", 1.0)
        questions = [Question("1.1", "f", ())] * 50
        started = time.monotonic()
        replies = ask("import time\ndef f(): time.sleep(0.2); return 1.0", *questions)
        assert replies[-1].kind == "stopped"
        assert time.monotonic() - started < 9

    @pytest.mark.parametrize(
        "code",
        [
            "import os\ndef f():\n    while True: os.fork()",
            "import subprocess, sys\ndef f(): subprocess.run([sys.executable])",
            "import os\ndef f(): os.system('echo PASSED')",
            "import multiprocessing as m\ndef f(): m.Process(target=f).start()",
        ],
    )
    def test_that_starts_processes_is_refused(self, ask, code):
        if "fork" in code and not hasattr(os, "fork"):
            pytest.skip("needs os.fork")
        (reply,) = ask(code)
        assert reply.kind == "RefusedError"
        assert reply.refused[0].startswith("start another")

    def test_that_wants_100_gb_at_once_gets_none(self, ask):
        (reply,) = ask("import numpy as np\ndef f(): return np.ones(100 * 2**27).sum()")
        assert reply.kind in ("MemoryError", "stopped")

    def test_that_fills_the_memory_bit_by_bit_is_ended(self, ask):
        code = "def f():\n    x = []\n    while True: x.append(bytearray(10**7))"
        (reply,) = ask(code)
        assert reply.kind in ("MemoryError", "stopped")

    def test_that_prints_passed_or_a_forged_reply_passes_nothing(self, check):
        forged = '{"at": 0, "value": {"array": {"dtype": "f8"}}}'
        line = f"print('PASSED'); print('{forged}', flush=True); return None"
        verdicts = check(attack(line))
        assert verdicts["1.1"].mistake == "nothing-returned"

    def test_that_writes_to_every_open_channel_is_found_out(self, check):
        code = (
            "import os\n    for fd in range(64):\n        try: os.write(fd, b'PASSED')"
        )
        code += "\n        except OSError: pass"
        assert check(attack(code))["1.1"].mistake == "stopped"

    def test_that_closes_the_channel_and_goes_on_is_found_out(self, ask, monkeypatch):
        monkeypatch.setattr(process, "CALL_SECONDS", 1.0)
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
        mischief = mischief.replace("HOME_Q =", f"{code}\nHOME_Q =", 1)
        assert check(mischief)["1.1"].status == "wrong"

    @pytest.mark.parametrize(
        "patch",
        [
            "np.allclose = np.array_equal = lambda *a, **k: True",
            "np.abs = lambda x: 0.0",
            "np.ndarray.__module__",
            "sys.modules['robo47.diagnose'] = sys.modules['robo47.checker'] = None",
            "import builtins; builtins.abs = builtins.max = lambda *a: 0.0",
        ],
    )
    def test_that_patches_numpy_or_the_checker_passes_nothing(self, check, patch):
        wrong = REFERENCE.replace("T[:3, 3] = t", "T[:3, 3] = -t", 1)
        wrong = wrong.replace("HOME_Q =", f"{patch}\nHOME_Q =", 1)
        assert check(wrong)["1.1"].status == "wrong"

    @pytest.mark.parametrize(
        "line",
        [
            f"return exec(open({str(DAY.source)!r}).read())",
            f"import shutil; shutil.copy({str(DAY.source)!r}, 'x.py')",
            f"import sys; sys.path.insert(0, {str(DAY.source.parent)!r}); "
            "del sys.modules['day1_transforms']; import day1_transforms",
        ],
    )
    def test_that_reads_the_reference_solution_is_refused(self, check, line):
        verdict = check(attack(line))["1.1"]
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
        code = REFERENCE.replace("    T_world_body = np.eye(4)\n", f"    {body}\n", 1)
        verdict = check(code, "1.6")["1.6"]
        assert verdict.mistake == "not-by-hand"
        assert names in verdict.message

    def test_that_digs_for_the_real_mujoco_is_refused(self, check):
        line = "import sys; del sys.modules['mujoco']; import mujoco"
        assert check(attack(line))["1.1"].mistake == "refused"

    @pytest.mark.parametrize(
        "code",
        [
            "import ctypes\ndef f(): return ctypes.CDLL(None)",
            "import socket\ndef f(): socket.create_connection(('127.0.0.1', 9))",
            "import gc\ndef f(): return gc.get_objects()",
            "import os\ndef f(): os.symlink('/', 'root')",
            "import os\ndef f(): os.chdir('/')",
        ],
    )
    def test_that_leaves_python_is_refused(self, ask, code):
        assert ask(code)[0].kind == "RefusedError"

    def test_that_writes_outside_its_folder_changes_nothing(self, ask, tmp_path):
        precious = tmp_path / "precious.txt"
        precious.write_text("mine")
        for action in (
            f"open({str(precious)!r}, 'w')",
            f"os.remove({str(precious)!r})",
            f"os.rename({str(precious)!r}, 'x')",
            f"os.open({str(precious)!r}, os.O_WRONLY | os.O_TRUNC)",
            f"os.truncate({str(precious)!r}, 0)",
        ):
            assert ask(f"import os\ndef f(): {action}")[0].kind == "RefusedError"
        assert precious.read_text() == "mine"

    def test_may_write_in_its_own_folder_which_is_gone_afterwards(self, ask):
        code = """
            import os
            import numpy as np
            def f():
                open("notes.txt", "w").write("x")
                return np.array(list(os.getcwd().encode()))
        """
        (reply,) = ask(code)
        folder = bytes(reply.value.tolist()).decode()
        assert "robo47-check-" in folder
        assert not os.path.exists(folder)

    def test_on_the_metrics_file_leaves_it_as_it_is(self, check):
        before = METRICS_CSV.read_bytes()
        verdict = check(attack(f"open({str(METRICS_CSV)!r}, 'w')"))["1.1"]
        assert verdict.mistake == "refused"
        assert METRICS_CSV.read_bytes() == before

    def test_with_a_conftest_beside_the_file_runs_none_of_it(self, check, student):
        mark = student("", "conftest.py").parent / "ran"
        student(f"open({str(mark)!r}, 'w'); print('PASSED')", "conftest.py")
        code = REFERENCE.replace("T[:3, 3] = t", "T[:3, 3] = -t", 1)
        assert check(code)["1.1"].status == "wrong"
        assert not mark.exists()

    def test_with_a_table_of_the_known_answers_is_found_at_fresh_angles(self, check):
        q = np.array([q for _, q in (c.args for c in tasks.diagnose.calls("1.6"))])
        T = verify.mujoco_poses(variant.models()[0], q)["site:attachment_site"]
        code = f"""
            import numpy as np
            from numpy import array
            Q, T = np.array({q.tolist()}), np.array({T.tolist()})
            def compose_fk(model, q): return T[np.abs(Q - q).sum(1).argmin()]
        """
        assert check(code, "1.6")["1.6"].mistake == "looked-up"

    @pytest.mark.skipif(not LINUX, reason="needs Linux's network namespaces")
    def test_has_no_network_below_python_either(self):
        code = (
            "import sys, socket; sys.path.insert(0, sys.argv[1]); import limits\n"
            "print(limits.leave_network(), *[n for _, n in socket.if_nameindex()])"
        )
        inside = str(ROOT / "robo47" / "checker" / "inside")
        command = [sys.executable, "-c", code, inside]
        said = subprocess.run(
            command, capture_output=True, text=True, check=True
        ).stdout
        if said.startswith("False"):
            pytest.skip("needs a system that lets users make namespaces")
        assert said.split() == ["True", "lo"]


def test_a_general_inverse_gives_the_right_numbers_but_not_the_task(check):
    code = REFERENCE.replace(
        "    R, t = T[:3, :3]", "    return np.linalg.inv(T)\n    R, t = T[:3, :3]", 1
    )
    verdict = check(code, "1.3")["1.3"]
    assert (verdict.status, verdict.mistake) == ("close", "general-inverse")
    assert "numpy.linalg.inv" in verdict.message


def test_typed_in_link_lengths_pass_with_a_note(check):
    code = REFERENCE.replace(
        "link_T(body.pos, body.quat)", "link_T(POS[name], body.quat)", 1
    )
    model = variant.models()[0]
    names = ["link0", *(f"link{i}" for i in range(1, 8)), "attachment"]
    typed = {name: model.body(name).pos.tolist() for name in names}
    verdict = check(code.replace("HOME_Q =", f"POS = {typed}\nHOME_Q =", 1), "1.6")[
        "1.6"
    ]
    assert verdict.status == "passed"
    assert "longer links" in verdict.message


def test_a_task_that_calls_an_unwritten_one_waits_for_it(check):
    gap = 'raise NotImplementedError("task 1.4: write quat_to_R")'
    start = "    w, x, y, z = quat"
    code = REFERENCE.replace(start, f"    {gap}\n{start}", 1)
    verdicts = check(code)
    assert verdicts["1.4"].status == verdicts["1.6"].status == "todo"
    assert "Waits for task 1.4" in verdicts["1.6"].message


def test_a_wrong_task_points_to_the_wrong_one_below_it(check):
    code = REFERENCE.replace("w, x, y, z = quat /", "x, y, z, w = quat /", 1)
    verdicts = check(code)
    assert verdicts["1.4"].status == verdicts["1.6"].status == "wrong"
    assert "Task 1.4" in verdicts["1.6"].message


def test_a_missing_function_is_told_with_the_way_to_get_it_back(check):
    verdict = check(REFERENCE.replace("def Rz(", "def rz("), "1.2")["1.2"]
    assert verdict.mistake == "missing"
    assert "make start RESET=1.2" in verdict.message


class TestTheStandInOfMjModel:
    """It reads like the real one, whichever way a student goes about it."""

    def pairs(self):
        real = variant.models()[0]
        data = copy_model(real)
        arrays = {n: wire.unpack_array(a) for n, a in data["arrays"].items()}
        return real, standins.MjModel(data, arrays)

    def test_has_every_size_and_array_of_the_real_one(self):
        real, ours = self.pairs()
        for name in dir(real):
            value = getattr(real, name)
            if isinstance(value, int | np.ndarray) and not name.startswith("_"):
                assert np.array_equal(value, getattr(ours, name), equal_nan=True), name

    @pytest.mark.parametrize(
        "kind", ["body", "joint", "jnt", "site", "actuator", "key"]
    )
    def test_gives_the_same_named_views(self, kind):
        real, ours = self.pairs()
        counts = {"body": real.nbody, "site": real.nsite, "actuator": real.nu}
        for i in range(counts.get(kind, real.nkey if kind == "key" else real.njnt)):
            want = getattr(real, kind)(i)
            for view in (getattr(ours, kind)(i), getattr(ours, kind)(want.name)):
                for name in (n for n in dir(want) if not n.startswith("_")):
                    a, b = getattr(want, name), getattr(view, name)
                    assert np.shape(a) == np.shape(b), name
                    assert np.array_equal(a, b), name

    def test_names_the_valid_ones_for_a_wrong_name(self):
        real, ours = self.pairs()
        for model in (real, ours):
            with pytest.raises(KeyError, match=r"Invalid name 'link9'.*'link7'"):
                model.body("link9")

    def test_says_what_it_lacks(self):
        with pytest.raises(AttributeError, match="copy of the model has no 'opt'"):
            _ = self.pairs()[1].opt

    def test_answers_mj_name2id_and_the_enums(self, ask):
        code = """
            import mujoco
            import numpy as np
            def f(model: mujoco.MjModel, data: mujoco.MjData | None = None):
                kind = mujoco.mjtObj.mjOBJ_BODY
                i = mujoco.mj_name2id(model, kind, "link4")
                assert mujoco.mj_id2name(model, kind, i) == "link4"
                assert mujoco.mj_name2id(model, kind, "nobody") == -1
                assert model.jnt_type[0] == mujoco.mjtJoint.mjJNT_HINGE
                return np.array(i)
        """
        (reply,) = ask(code, Question("1.6", "f", (Model(0),)))
        assert reply.value == variant.models()[0].body("link4").id
