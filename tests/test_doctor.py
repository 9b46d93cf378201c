"""The doctor: it answers on any machine, and says nothing of who asks."""

import getpass
import json
import subprocess
import sys
from pathlib import Path

import pytest

from labkit.setup import doctor
from robo47.paths import ROOT

pytestmark = pytest.mark.kit


@pytest.fixture
def answers(monkeypatch):
    """Let the doctor's probes answer what is given: {probe: (value, why)}."""

    def use(given):
        monkeypatch.setattr(
            doctor, "probe", lambda _, code, gl=False: given.get(code, (None, "?"))
        )

    return use


def test_it_has_a_line_on_everything_and_no_traceback(run):
    done = run("scripts/doctor.py", "--json")
    lines = json.loads(done.stdout)
    about = [line["about"] for line in lines]
    assert about == [
        "kit",
        "Python",
        "platform",
        "MuJoCo",
        "robot",
        "lessons",
        "wall",
        "pictures",
        "display",
        "disk",
        "git",
    ]
    assert done.returncode == any(line["status"] == "todo" for line in lines)
    assert not done.stderr


def test_its_text_fits_80_columns_and_holds_no_home_or_user(run):
    said = run("scripts/doctor.py").stdout
    assert max(map(len, said.splitlines())) <= 80
    assert str(Path.home()) + "/" not in said
    assert str(ROOT) not in said


def test_it_runs_on_a_bare_python(clone):
    command = [sys.executable, "-I", "-S", str(clone / "scripts" / "doctor.py")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "Set up: make day1" in done.stdout
    assert "Traceback" not in done.stdout + done.stderr


def test_a_reader_that_leaves_early_gets_no_traceback():
    with subprocess.Popen(
        [sys.executable, str(ROOT / "scripts" / "doctor.py")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        process.stdout.close()
        assert process.stderr.read() == b""


def test_a_broken_environment_is_told_with_its_repair(clone):
    python = clone / doctor.VENV_PYTHON.relative_to(ROOT)
    python.parent.mkdir(parents=True)
    python.write_text("gone")
    command = [sys.executable, str(clone / "scripts" / "doctor.py")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ".venv does not start: make setup" in done.stdout
    assert "Traceback" not in done.stdout + done.stderr


def test_the_broken_upgrade_to_mujoco_4_is_told_with_its_repair(answers):
    why = "ModuleNotFoundError: No module named 'mujoco._structs'"
    versions = {"mujoco": "4.0.0", "mujoco-core": "4.0.0", "numpy": "2.4.6"}
    answers({doctor.MUJOCO_PROBE: (None, why), doctor.VERSIONS_PROBE: (versions, "")})
    line = doctor.check_mujoco(sys.executable)
    assert line.status == "todo"
    assert "--force-reinstall --no-deps mujoco mujoco-core" in line.remedy


def test_a_missing_numpy_is_not_taken_for_the_broken_upgrade(answers):
    why = "ModuleNotFoundError: No module named 'numpy'"
    installed = {"mujoco": "4.0.0", "mujoco-core": "4.0.0"}
    answers({doctor.MUJOCO_PROBE: (None, why), doctor.VERSIONS_PROBE: (installed, "")})
    assert doctor.check_mujoco(sys.executable).remedy == "make setup"


def test_a_missing_mujoco_is_told_with_the_set_up(answers):
    answers({doctor.VERSIONS_PROBE: ({"numpy": "2.0"}, "")})
    assert doctor.check_mujoco("python").remedy == "make setup"


def test_an_old_python_is_told(answers):
    answers({doctor.PYTHON_PROBE: ("3.9.2", "")})
    assert "3.11 or newer" in doctor.check_python("python3").remedy


def test_a_robot_that_was_changed_is_told(answers):
    found = {"source": "s", "commit": None, "content": "c", "files": 3}
    found |= {"changed": ["link1.stl: changed"], "missing": [], "folder": "here"}
    answers({doctor.ROBOT_PROBE: (found, "")})
    line = doctor.check_robot("python")
    assert (line.status, "link1.stl" in line.found) == ("todo", True)
    assert line.remedy.startswith("Delete here, then: ")


def test_the_back_ends_that_draw_are_named(answers):
    answers({doctor.GL_PROBE: ({"egl": "renders", "osmesa": "no library"}, "")})
    assert doctor.check_gl("python").found == "drawn with egl"
    answers({doctor.GL_PROBE: ({"egl": "no library"}, "")})
    assert doctor.check_gl("python").status == "todo"


def test_a_mujoco_gl_that_does_not_draw_is_told_with_its_cure(answers, monkeypatch):
    monkeypatch.setenv("MUJOCO_GL", "nonsense")
    answers({doctor.GL_PROBE: ({"nonsense": "invalid value"}, "")})
    line = doctor.check_gl("python")
    assert (line.status, "MUJOCO_GL=nonsense" in line.found) == ("todo", True)
    assert line.remedy == "Unset it: unset MUJOCO_GL"


def test_a_wrong_mujoco_gl_is_no_fault_of_mujocos(monkeypatch):
    monkeypatch.setenv("MUJOCO_GL", "nonsense")
    assert doctor.check_mujoco(sys.executable).status == "good"


def test_a_lab_script_that_is_not_the_kits_is_told(answers):
    found = {"days": 1, "others": ["w1-foundations/src/day1_transforms.py"]}
    answers({doctor.LESSONS_PROBE: (found, "")})
    line = doctor.check_lessons("python")
    assert (line.status, "not the kit's" in line.found) == ("todo", True)
    assert line.remedy.endswith("git checkout -- w1-foundations/src/day1_transforms.py")


def test_a_check_that_fails_itself_is_one_line_of_the_findings(monkeypatch):
    monkeypatch.setattr(doctor, "check_disk", lambda: 1 / 0)
    lines = doctor.examine()
    assert len(lines) == 11
    assert "ZeroDivisionError" in lines[9].found


@pytest.mark.parametrize(
    "text",
    [
        f"{ROOT}/.venv is broken",
        f"{Path.home()}/x: no",
        "No such file: '/home/ada/kit/x.py'",
        "/Users/ada/kit",
        "C:\\Users\\ada\\kit",
    ],
)
def test_paths_say_nothing_of_who_asks(text):
    said = doctor.discreet(text)
    assert "ada" not in said
    assert str(ROOT) not in said
    assert f"/{getpass.getuser()}/" not in said
