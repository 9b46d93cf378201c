"""A lab that is not in its place: the student and the teacher are told where it is."""

import os
import shutil
import subprocess

import pytest
from make_class import DAY, KIT, SOLVED, STARTER, WEEK

from conftest import run_copy
from labkit.grade import child
from labkit.grade.course import GradedStudent
from labkit.grade.package import collect
from labkit.grade.roster import Student
from labkit.handin.deliverables import check_deliverables
from labkit.handin.whereabouts import whereabouts
from labkit.lesson.day import find_day

pytestmark = pytest.mark.kit
SCRIPT = f"{WEEK}/work/{DAY.script}"
FUTURE = "2090-01-01T12:00:00+0000"
THEN = "2026-09-01T12:00:00+0000"
DEADLINE = 1_788_220_800 + 86_400  # a day later


def git(folder, *command, date=THEN):
    """Run git in a folder as a student."""
    dates = {"GIT_COMMITTER_DATE": date, "GIT_AUTHOR_DATE": date}
    name = (
        "-c",
        "user.name=A",
        "-c",
        "user.email=a@b",
        "-c",
        "init.defaultBranch=main",
    )
    done = subprocess.run(
        ["git", *name, *command],
        cwd=folder,
        env={**os.environ, **dates},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def put(folder, name, text=SOLVED):
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, "utf-8")


def save(folder, date=THEN):
    git(folder, "add", "-A")
    git(folder, "commit", "-qm", "work", date=date)


@pytest.fixture
def ana(tmp_path):
    """A student's repository with a first commit, without a lab."""
    folder = tmp_path / "ana"
    folder.mkdir()
    git(folder, "init", "-q")
    put(folder, "README.md", "the kit\n")
    put(folder, f"{WEEK}/src/{DAY.script}")  # the kit's own is nobody's work
    save(folder)
    return folder


def on_a_branch(clone):
    git(clone, "checkout", "-qb", "my-work")
    put(clone, SCRIPT)
    save(clone)
    git(clone, "checkout", "-q", "main")


def on_a_detached_head(clone):
    on_a_branch(clone)
    git(clone, "checkout", "-q", "--detach")


def as_a_notebook(clone):
    put(clone, f"{WEEK}/work/day1_mine.ipynb", "{}")
    save(clone)


def in_a_second_copy(clone):
    put(clone, f"robo47-copy/{SCRIPT}")
    put(clone, f"robo47-copy/{WEEK}/src/{DAY.script}")
    save(clone)


def in_a_submodule(clone):
    inside = clone / WEEK / "work"
    put(clone, SCRIPT)
    git(inside, "init", "-q")
    save(inside)
    save(clone)
    shutil.rmtree(inside)  # as a clone of it is
    inside.mkdir()


def ignored(clone):
    put(clone, ".gitignore", "*.log\nwork/\n")
    put(clone, SCRIPT)
    save(clone)
    (clone / SCRIPT).unlink()


def by_a_wrong_clock(clone):
    put(clone, SCRIPT)
    save(clone, FUTURE)


def without_a_commit(clone):
    shutil.rmtree(clone)
    clone.mkdir()
    git(clone, "init", "-q")


def deleted(clone):
    put(clone, SCRIPT)
    save(clone)
    (clone / SCRIPT).unlink()


SITUATIONS = {
    on_a_branch: "on the branch my-work, and this clone is at the branch main.",
    on_a_detached_head: "at a commit without a branch (a detached HEAD)",
    as_a_notebook: "There is a notebook: w1-foundations/work/day1_mine.ipynb.",
    in_a_second_copy: f"There is a file of that name: robo47-copy/{SCRIPT}.",
    in_a_submodule: "The folder w1-foundations/work is a git repository of its own",
    ignored: ".gitignore, line 2 keeps git from adding it.",
    by_a_wrong_clock: "dated 2090-01-01, which lies in the future",
    without_a_commit: "This repository has no commit yet",
    deleted: "Your last commit has it, the folder does not: git checkout -- ",
}


@pytest.mark.parametrize("situation", SITUATIONS, ids=lambda one: one.__name__)
def test_a_grade_says_where_the_work_is_and_never_that_it_was_not_started(
    ana, situation
):
    situation(ana)
    deadline = DEADLINE if situation is by_a_wrong_clock else None
    student = Student("Ana", ana.name, ana)
    found = child.grade(collect(student, DAY, deadline=deadline), DAY)
    assert f"{SCRIPT} is not there. " in found.error or situation is by_a_wrong_clock
    assert SITUATIONS[situation] in found.error
    assert "make start" not in found.error or situation is as_a_notebook
    assert GradedStudent(student, found).state == "elsewhere"
    assert not found.first_mistake


def test_who_has_begun_nothing_is_told_how_to_begin(ana):
    student = Student("Ana", ana.name, ana)
    found = child.grade(collect(student, DAY), DAY)
    assert found.error == f"{SCRIPT} is not there. Begin with: make start DAY=1"
    assert GradedStudent(student, found).state == "not started"
    assert whereabouts(DAY, ana.parent) == ""


def test_make_check_says_where_the_students_own_file_is(one_day):
    git(one_day, "init", "-q")
    save(one_day)
    on_a_branch(one_day)
    for script in ("check_day.py", "run_day.py"):
        done = run_copy(one_day, f"scripts/{script}", "1")
        assert done.returncode == 2
        assert f"{SCRIPT} is not there. It is on the branch my-work" in done.stderr
        assert done.stderr.count("\n") == 1


def test_a_file_that_git_ignores_is_told_with_the_line_that_does_it(one_day):
    put(one_day, ".gitignore", "*.log\n/w1-foundations/work\n")
    put(one_day, SCRIPT, STARTER)
    put(one_day, f"{WEEK}/work/kit.py", KIT)
    git(one_day, "init", "-q")
    save(one_day)
    day = find_day(1, one_day)
    says = check_deliverables(day, one_day)[-1].message
    assert f".gitignore, line 2 keeps git from adding {SCRIPT}." in says
    assert f"git add -f {SCRIPT}" in says
    git(one_day, "add", "-f", f"{WEEK}/work")
    git(one_day, "commit", "-qm", "forced")
    assert ".gitignore" not in check_deliverables(day, one_day)[-1].message


def test_folders_deep_in_each_other_are_not_looked_through(tmp_path):
    there = os.open(tmp_path, os.O_RDONLY)
    for _ in range(1500):  # longer than any path may be
        os.mkdir("d", dir_fd=there)
        below = os.open("d", os.O_RDONLY, dir_fd=there)
        os.close(there)
        there = below
    os.close(there)
    try:
        assert whereabouts(DAY, tmp_path) == ""
    finally:
        subprocess.run(["rm", "-rf", tmp_path / "d"], check=True)
