"""Student code that hangs, harms, forges or looks things up: none of it pays."""

import os
import subprocess
import sys
import time

import numpy as np
import pytest

from robo47 import verify
from robo47.checker import process, tasks, variant
from robo47.checker.replies import Question
from robo47.lesson.day import find_day
from robo47.paths import METRICS_CSV, ROOT

DAY = find_day(1)
REFERENCE = DAY.source.read_text("utf-8")
LINUX = sys.platform.startswith("linux")


def attack(line, after=""):
    """Return the reference solution with a line of mischief in its first function."""
    text = REFERENCE.replace(
        "    T = np.eye(4)\n", f"    {line}\n    T = np.eye(4)\n", 1
    )
    return after + text


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

    @pytest.mark.skipif(not LINUX, reason="needs Linux's Landlock")
    def test_below_pythons_audit_hooks_meets_the_kernel(self, tmp_path):
        precious = tmp_path / "precious.txt"
        precious.write_text("mine")
        code = """
import os, sys
sys.path.insert(0, sys.argv[1])
import landlock
os.makedirs(sys.argv[2] + "/own")
print(landlock.fence(sys.argv[2] + "/own", sys.path[1:]))
open(sys.argv[2] + "/own/x", "w").write("x")
for action in (
    lambda: open(sys.argv[2] + "/precious.txt"),
    lambda: open(sys.argv[2] + "/precious.txt", "w"),
    lambda: os.remove(sys.argv[2] + "/precious.txt"),
    lambda: os.truncate(sys.argv[2] + "/precious.txt", 0),
    lambda: os.execv("/bin/sh", ["sh", "-c", "echo PASSED"]),
):
    try: action()
    except PermissionError: print("no")
"""
        inside = str(ROOT / "robo47" / "checker" / "inside")
        command = [sys.executable, "-c", code, inside, str(tmp_path)]
        said = subprocess.run(
            command, capture_output=True, text=True, check=True
        ).stdout
        if said.startswith("False"):
            pytest.skip("needs a kernel with Landlock")
        assert said.split() == ["True", *["no"] * 5]
        assert precious.read_text() == "mine"

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
