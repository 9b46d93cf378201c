"""What every test file shares: the robot, a clean environment, and honest skips."""

import io
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before NumPy: -n 2 on two cores
os.environ.pop("ROBO47_NOT_YET", None)  # of `make test`; here "not yet" is 1
os.environ["ROBO47_LOUD"] = "1"  # a search of the checker that stops fails a test

import re
import shutil
import subprocess
import sys
import textwrap
from contextlib import redirect_stdout
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest.mock import MagicMock, patch

import hypothesis
import mujoco
import numpy as np
import pytest
from restored import Restored

from labkit import log
from labkit.base.exchange import Exchange, Question, Reply
from labkit.check.tasks import check_tasks
from labkit.commands.new import worksheet_of
from labkit.figures import backends
from labkit.judge.ask import replies
from labkit.lesson.day import Day, all_days, find_day
from labkit.lesson.lab_module import load_lab as load_script  # noqa: F401 (days' tests)
from labkit.lesson.week import weeks
from labkit.sandbox.sandbox import USUAL, Sandbox
from robo47 import panda
from robo47.errors import Robo47Error
from robo47.panda import files

# No time is asserted: a busy machine is no failure. Draws are the same in every run: a
# student must not meet what nobody could have seen. CI draws more of them.
examples = 100 if os.environ.get("ROBO47_CI") else 30
hypothesis.settings.register_profile(
    "kit", deadline=None, max_examples=examples, derandomize=True
)
hypothesis.settings.load_profile("kit")

ROOT = Path(__file__).resolve().parent
AUTHORS = "(kit or browser or network) and not soak"  # as .ci/run asks
# Of a folder that is copied; what Python compiled is copied too, and holds there.
SKIPPED = shutil.ignore_patterns(
    *("*.pyc.*", "work", "submissions", "notebooks", "MUJOCO_LOG.TXT")
)


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave files unread that have no test with a mark that is asked for."""
    asked = config.option.markexpr
    if collection_path.suffix != ".py":
        return None
    text = collection_path.read_text("utf-8", "replace")  # a student's can be anything
    if "not kit" in asked:
        return "\npytestmark = pytest.mark.kit\n" in text or None
    if asked == AUTHORS:
        return not re.search(r"mark\.(kit|browser|network)\b", text) or None
    return None


def pytest_collection_modifyitems(
    config: pytest.Config, items: list[pytest.Item]
) -> None:
    """In CI, leave out most authors' tests of a day that has not changed."""
    if not os.environ.get("ROBO47_CI"):
        return
    import whole  # it is in tests/, which is no part of a student edition

    if left := whole.left_out(items):
        config.hook.pytest_deselected(items=left)
        items[:] = [one for one in items if one not in left]


def pytest_configure(config: pytest.Config) -> None:
    """In CI, note the tests that are skipped: they run when nothing is missing."""
    file = os.environ.get("ROBO47_SKIPPED")
    if file and not hasattr(config, "workerinput"):
        config.pluginmanager.register(Skipped(Path(file)))


class Skipped:
    """Write the tests, and files of tests, that a run skips to a file of arguments."""

    def __init__(self, file: Path) -> None:
        """Begin with none."""
        self.file, self.names = file, set[str]()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note a test."""
        if report.skipped:
            self.names.add(report.nodeid)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        """Note a file that is skipped as a whole."""
        if report.skipped:
            self.names.add(report.nodeid)

    def pytest_sessionfinish(self) -> None:
        """Write the names, one per line."""
        self.file.write_text("".join(f"{name}\n" for name in sorted(self.names)))


def need(available: bool, what: str) -> None:
    """Skip a test for want of something, or fail where CI was to install it."""
    if not available:
        if os.environ.get("ROBO47_CI"):
            pytest.fail(f"CI must provide {what}")
        pytest.skip(f"needs {what}", allow_module_level=True)


class Answers:
    """A student's file for a tab of the inspector: functions instead of a sandbox."""

    there, version, problem = True, 1, ""

    def __init__(self, functions):
        self.functions, self.day = functions, SimpleNamespace(tasks=())

    def saved(self):
        return False

    def ask(self, questions, version):
        return [
            Reply(self.functions[one.function](*one.args))
            if one.function in self.functions
            else Reply(kind="missing")
            for one in questions
        ]


def paper(model, q, functions=None):
    """Return a page that only listens, for a tab of the inspector.

    `own` asks {name: function}, or says that there is no file; a job is done at once.
    """
    from labkit.inspector.own import Own

    page = MagicMock(model=model, q=np.array(q, dtype=float))
    student = Answers(functions or {})
    student.there = functions is not None
    page.own.side_effect = lambda library, **how: Own(student, library, **how)
    page.job.side_effect = lambda work, done: done(work())
    page.jobs_apart.return_value.want.side_effect = page.job.side_effect
    for name in ("curve", "arrows", "lines", "label", "ghost"):
        getattr(page.draw, name).side_effect = lambda *_, **__: MagicMock()
    page.html.side_effect = lambda *text: MagicMock()
    page.animate.side_effect = lambda *_, **__: MagicMock(running=False)
    page.pose.return_value = panda.arm(model).at(page.q[:7]).T_world_ee.copy()
    return page


@pytest.fixture
def real_panda() -> Path:
    """Return the real Panda's folder."""
    folder = files.panda_folder()
    need(folder is not None, "the real Panda: python3 scripts/fetch_menagerie.py")
    assert folder is not None
    return folder


@pytest.fixture(scope="session")
def chromium() -> str:
    """Return a browser's program."""
    names = ("chromium", "chromium-browser", "google-chrome")
    found = next(filter(None, map(shutil.which, names)), None)
    need(found is not None, "Chromium (Debian, Ubuntu: sudo apt install chromium)")
    assert found is not None
    return found


@pytest.fixture
def twin(monkeypatch: pytest.MonkeyPatch) -> None:
    """Hide the Menagerie, so that `panda.load` falls back to the twin."""
    monkeypatch.setattr(files, "panda_folder", lambda: None)


@pytest.fixture(params=["real", "twin"])
def either_panda(request: pytest.FixtureRequest) -> mujoco.MjModel:
    """Return panda_nohand, once from the Menagerie and once from the twin."""
    request.getfixturevalue("real_panda" if request.param == "real" else "twin")
    return panda.load("panda_nohand")


def days() -> list[Day]:
    """Return the days to test: all, or those that an author asks for: "3" or "3,11"."""
    asked = os.environ.get("ROBO47_DAY")
    return [find_day(int(one)) for one in asked.split(",")] if asked else all_days()


def kit_folders() -> list[str]:
    """Return the names of the folders that a clone needs to run."""
    return ["robo47", "labkit", "scripts", "metrics", *(w.folder.name for w in weeks())]


def write_week(folder: Path, *days: int) -> None:
    """Write the manifest of a week with these days, as the folder's name has it."""
    number, _, name = folder.name[1:].partition("-")
    text = f'number = {number}\nname = "{name}"\ntitle = "t"\ndays = {[*days]}\n'
    (folder / "week.toml").write_text(text, "utf-8")


def environment_of(clone: Path) -> dict[str, str]:
    """Return this environment, with a clone's own `robo47` and this clone's robot."""
    robots = os.environ.get("MENAGERIE_ROOT") or str(ROOT / "mujoco_menagerie")
    paths = [str(clone), os.environ.get("PYTHONPATH", "")]
    own = {"PYTHONPATH": os.pathsep.join(filter(None, paths)), "COLUMNS": "80"}
    if Path(robots).is_dir():
        own["MENAGERIE_ROOT"] = robots
    return {**os.environ, **own}


def run_copy(copy: Path, *command: object, **environment: str) -> Any:
    """Run Python in a copy of the kit as its owner would; return the process, ended."""
    return subprocess.run(
        [sys.executable, *map(str, command)],
        cwd=copy,
        env={**environment_of(copy), **environment},
        capture_output=True,
        encoding="utf-8",
        timeout=300,
        check=False,
    )


def kits_worksheet(day) -> str:
    """Return a day's worksheet as the kit brings it, or skip: a student's own."""
    text = (day.folder / day.worksheet).read_text("utf-8")
    untouched = text.count("*(your words)*") == len(day.terms)
    need(untouched, "the worksheet as the kit brings it; here it is filled in")
    return text


def sentences(number: int) -> str:
    """Return a day's guide on one line, without outputs of runs and without stars."""
    day = find_day(number)
    guide = (day.folder / day.guide).read_text("utf-8")
    own = re.sub(r"<!-- run.*?<!-- end -->", "", guide, flags=re.S)
    return " ".join(own.replace("*", "").split())


def printed_by(lab, predicted: dict[str, str]) -> str:
    """Return what a lab prints, 80 columns wide at most, after these predictions."""
    with (
        patch("sys.argv", ["lab", "--no-log"]),
        patch("labkit.lesson.lab.predictions", lambda worksheet: predicted),
        redirect_stdout(io.StringIO()) as out,
    ):
        assert lab.main() == 0
    assert all(len(line) <= 80 for line in out.getvalue().splitlines())
    return out.getvalue()


def copy_kit(copy: Path) -> Path:
    """Return a new folder with a copy of the kit, and nothing done in it.

    A student's clone holds rows, a worksheet and pictures of their own: `make test`
    must pass on it as well.
    """
    copy.mkdir()
    for name in set(kit_folders()) - {"metrics"}:
        shutil.copytree(ROOT / name, copy / name, ignore=SKIPPED)
    (copy / "metrics").mkdir()
    shutil.copy(ROOT / "metrics" / "README.md", copy / "metrics")
    day = find_day(1, copy)
    (copy / "metrics" / "metrics.csv").write_text(",".join(log.COLUMNS) + "\n")
    (day.folder / day.figure).unlink(missing_ok=True)
    (day.folder / day.worksheet).write_text(worksheet_of(day), "utf-8")
    return copy


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Restored:
    """Return a copy of the kit for the tests of a file; `clone` puts it back."""
    return Restored(copy_kit(tmp_path_factory.mktemp("kit") / "clone"))


@pytest.fixture
def clone(copy: Restored) -> Path:
    """Return the copy of the kit as it was at first."""
    return copy.put_back()


def keep_first_day(clone: Path) -> Path:
    """Return a copy of the kit, now with its first day alone: it is run in seconds."""
    first, *others = weeks(clone)
    for week in others:
        shutil.rmtree(week.folder)
    for number in first.days[1:]:
        shutil.rmtree(first.folder / f"day{number}")
    write_week(first.folder, first.days[0])
    return clone


@pytest.fixture
def one_day(clone):
    """Return that copy with its first day alone."""
    return keep_first_day(clone)


@pytest.fixture
def run_in(clone):
    """Run a script of that copy as a student would, in a process of its own."""
    return partial(run_copy, clone)


@pytest.fixture
def gl() -> None:
    """Skip where no OpenGL backend draws pictures."""
    try:
        backends.rendering_environment()
    except Robo47Error as error:
        need(False, f"an OpenGL backend: {error}")


@pytest.fixture
def run():
    """Run a script of the kit as a person would, in a process of its own."""

    def run_script(
        script, *arguments, cwd=ROOT, stdin=None, timeout=120, **environment
    ):
        return subprocess.run(
            [sys.executable, str(ROOT / script), *map(str, arguments)],
            cwd=cwd,
            input=stdin,
            env={**os.environ, **{k: str(v) for k, v in environment.items()}},
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=timeout,
            check=False,
        )

    return run_script


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

    def run(code, *questions, library=None, needs=None, limits=USUAL):
        asked = [Exchange(one) for one in questions or [Question("1.1", "f", ())]]
        with Sandbox() as sandbox:
            sandbox.run(student(code), asked, library, needs, limits=limits)
        return replies(asked)

    return run


@pytest.fixture
def check(student):
    """Check a student's file; return {task: verdict}."""

    def run(code, only=None):
        with Sandbox() as sandbox:
            results = check_tasks(find_day(1), student(code), sandbox, only, seed=1)
        return {result.task.id: result.verdict for result in results}

    return run
