"""What a day asks of MuJoCo is found beside its complete lab, and nowhere else."""

import subprocess
import sys

import pytest

from conftest import ROOT
from labkit.lesson.day_mujoco import BesideTheLab, modules

NAMES = list(modules())


def test_it_is_found_by_every_python_that_reads_a_lab():
    assert "day4_mujoco" in NAMES
    import day4_mujoco  # the tests' own Python is one of them

    assert day4_mujoco.__file__ == str(ROOT / "w1-foundations/src/day4_mujoco.py")


@pytest.mark.parametrize("name", ["day4_dynamics", "day4_mujoco.x", "day04_mujoco"])
def test_no_other_file_in_src_is(name):
    assert BesideTheLab().find_spec(name) is None


def test_a_students_own_file_of_that_name_does_not_take_its_place(tmp_path):
    (tmp_path / "day4_mujoco.py").write_text("print('my own oracle')\n")
    lab = tmp_path / "day4_dynamics.py"
    text = "import sys\nsys.path.append({!r})\nimport kit\nimport day4_mujoco as m\n"
    lab.write_text(text.format(str(ROOT / "scripts")) + "print(m.__file__)\n")
    run = subprocess.run([sys.executable, str(lab)], capture_output=True, text=True)
    assert run.stdout.strip() == str(modules()["day4_mujoco"]), run.stderr


def test_behind_the_wall_it_can_be_named_and_not_asked(ask, student):
    student("def motions(): return 'my own oracle'", "day4_mujoco.py")
    named = "import day4_mujoco\ndef f(at: day4_mujoco.Motions = None): return 47.0"
    (reply,) = ask(named)
    assert reply.value == 47.0
    (reply,) = ask("import day4_mujoco\ndef f(): return day4_mujoco.motions()")
    assert "call day4_mujoco.motions" in reply.error
