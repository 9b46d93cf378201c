"""Which branch is graded, and what a pull that was cut leaves behind."""

import os
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from make_class import DAY, DEADLINE, WEEK, commit, put

from labkit.base.git import SEEN
from labkit.grade import pull
from labkit.grade.package import collect
from labkit.grade.pull import pull_all
from labkit.grade.roster import Student

pytestmark = pytest.mark.kit
SCRIPT = f"{WEEK}/work/{DAY.script}"


def git(folder: Path, *arguments: str) -> str:
    who = ("-c", "user.name=A", "-c", "user.email=a@b", "-c", "gc.auto=0")
    command = ["git", *who, *arguments]
    return subprocess.check_output(command, cwd=folder, text=True).strip()


class Server:
    """A bare repository, a student who pushes into it, and the teacher's clone."""

    def __init__(self, place: Path) -> None:
        self.bare, self.own = place / "bare", place / "own"
        for folder in (self.bare, self.own, place / "class"):
            folder.mkdir()
        git(self.bare, "init", "-q", "--bare", "-b", "main")
        clone = place / "class" / "mia"
        self.student = Student("Mia", "mia", clone, url=self.bare.as_uri())
        self.when = DEADLINE

    def push(self, branch: str, text: str) -> None:
        """Push a script as the only commit of a branch."""
        shutil.rmtree(self.own)
        self.own.mkdir()
        put(self.own, {SCRIPT: text})
        self.when += 60
        commit(self.own, self.when)
        there = f"HEAD:refs/heads/{branch}"
        git(self.own, "push", "-qf", self.bare.as_uri(), there)

    def default(self, branch: str) -> None:
        """Name the default branch, as the server's settings do."""
        git(self.bare, "symbolic-ref", "HEAD", f"refs/heads/{branch}")

    def drop(self, branch: str) -> None:
        """Take a branch away."""
        git(self.bare, "update-ref", "-d", f"refs/heads/{branch}")

    def pull(self) -> tuple[str, str, str]:
        """Return what went wrong, the script that is graded and its branch."""
        ((_, problem),) = pull_all([self.student])
        if not self.student.path.exists():
            return problem, "", ""
        package = collect(self.student, DAY)
        text = package.handin.files.get(SCRIPT, b"").decode()
        return problem, text, package.branch


@pytest.fixture
def server(tmp_path):
    """Return one whose default branch, main, is not there yet."""
    return Server(tmp_path)


def test_a_branch_beside_the_graded_one_changes_no_grade(server):
    assert server.pull()[:2] == ("", "")
    server.push("master", "good = 1")
    assert server.pull() == ("", "good = 1", "master")  # the only one
    server.push("feature", "rubbish(")
    assert server.pull() == ("", "good = 1", "master")  # the one that was taken


def test_the_servers_default_branch_is_taken_by_its_name(server):
    server.push("main", "good = 1")
    server.push("attempt", "rubbish(")
    assert server.pull() == ("", "good = 1", "main")
    server.push("trunk", "good = 2")
    server.drop("main")
    server.default("trunk")
    assert server.pull() == ("", "good = 2", "trunk")
    assert git(server.student.path, "for-each-ref", SEEN)  # the old one's work, too


def test_a_branch_that_is_gone_is_not_pulled_and_nothing_is_guessed(server):
    server.push("main", "good = 1")
    assert server.pull() == ("", "good = 1", "main")
    server.push("attempt", "rubbish(")
    server.drop("main")
    problem, text, branch = server.pull()
    assert "the branch main is gone from the server" in problem
    assert "(attempt)" in problem
    assert (text, branch) == ("good = 1", "main")
    server.drop("attempt")
    assert "(it has none)" in server.pull()[0]
    server.push("main", "good = 3")
    assert server.pull() == ("", "good = 3", "main")


def test_of_several_branches_none_is_taken_where_the_server_names_none(server):
    server.push("a", "x = 1")
    server.push("b", "x = 2")
    problem, _, _ = server.pull()
    assert problem == "the server names none of its branches as the default (a, b)"
    server.default("b")
    assert server.pull() == ("", "x = 2", "b")


def test_a_branch_whose_name_is_a_folder_of_anothers_is_taken(server):
    server.push("main", "x = 1")
    server.pull()
    for before, after in (("main", "main/new"), ("main/new", "main")):
        server.drop(before)
        server.push(after, f"x = '{after}'")
        server.default(after)
        assert server.pull() == ("", f"x = '{after}'", after)


@pytest.mark.parametrize("name", ["HEAD", "ä-–", "a;b", "-x", "a" * 200])
def test_an_odd_name_of_a_branch_is_a_name(server, name):
    server.push(name, "x = 1")
    server.default(name)
    assert server.pull() == ("", "x = 1", name)
    server.push(name, "x = 2")
    assert server.pull() == ("", "x = 2", name)


def test_a_detached_head_means_the_branch_that_is_there(server):
    server.push("main", "x = 1")
    server.push("other", "x = 2")
    commit_ = git(server.bare, "rev-parse", "other")
    (server.bare / "HEAD").write_text(f"{commit_}\n")
    assert server.pull() == ("", "x = 2", "other")


def test_what_a_killed_git_left_in_our_clone_is_cleared_away(server):
    server.push("main", "x = 1")
    server.pull()
    folder = server.student.path / ".git"
    left = ["index.lock", "HEAD.lock", "packed-refs.lock", "refs/heads/main.lock"]
    left += ["shallow.lock", "objects/pack/tmp_pack_x", "objects/pack/tmp_idx_y"]
    for name in left:
        (folder / name).write_bytes(b"half")
    server.push("main", "x = 2")
    assert server.pull() == ("", "x = 2", "main")
    assert not any((folder / name).exists() for name in left)


def test_a_network_that_is_cut_leaves_the_last_work_and_a_reason(server):
    server.push("main", "x = 1")
    server.pull()
    server.bare.rename(server.bare.with_name("away"))
    problem, text, branch = server.pull()
    assert "does not appear to be a git repository" in problem
    assert (text, branch) == ("x = 1", "main")
    server.bare.with_name("away").rename(server.bare)
    server.push("main", "x = 2")
    assert server.pull() == ("", "x = 2", "main")


def test_an_index_that_was_cut_is_made_anew_and_keeps_nothing_old(server):
    server.push("main", "x = 1")
    server.pull()
    (server.student.path / "gone.py").write_text("of an older commit")
    (server.student.path / ".git" / "index").write_bytes(b"half")
    server.push("main", "x = 2")
    assert server.pull() == ("", "x = 2", "main")
    assert not (server.student.path / "gone.py").exists()


def test_the_teachers_own_name_for_a_server_keeps_nobody_out(
    server, tmp_path, monkeypatch
):
    (tmp_path / ".gitconfig").write_text("[clone]\n\tdefaultRemoteName = upstream\n")
    monkeypatch.setenv("HOME", str(tmp_path))
    server.push("main", "x = 1")
    assert server.pull() == ("", "x = 1", "main")


def test_an_address_at_which_git_would_wait_is_refused(server):
    server.student = replace(server.student, url="fd::3")
    assert server.pull()[0] == "fatal: transport 'fd' not allowed"


def fetch_runs(monkeypatch, folder, command):
    """Put a git on PATH that runs a shell command in place of a fetch."""
    real, shim = shutil.which("git"), folder / "bin" / "git"
    shim.parent.mkdir()
    shim.write_text(
        f'#!/bin/sh\ncase " $* " in *" fetch "*) {command};; esac\nexec {real} "$@"\n'
    )
    shim.chmod(0o755)
    monkeypatch.setenv("PATH", f"{shim.parent}:{os.environ['PATH']}")


@pytest.mark.skipif(os.name == "nt", reason="a shell script stands in for git")
def test_a_git_that_is_killed_while_it_fetches_costs_that_pull_alone(
    server, tmp_path, monkeypatch
):
    server.push("main", "x = 1")
    server.pull()
    server.push("main", "x = 2")
    with monkeypatch.context() as patched:
        fetch_runs(patched, tmp_path, "kill -9 $$")
        assert server.pull() == ("git was killed", "x = 1", "main")
    assert server.pull() == ("", "x = 2", "main")


@pytest.mark.skipif(os.name == "nt", reason="a shell script stands in for git")
def test_a_server_that_answers_nothing_is_left_in_time(server, tmp_path, monkeypatch):
    server.push("main", "x = 1")
    server.pull()
    fetch_runs(monkeypatch, tmp_path, "exec sleep 60")
    monkeypatch.setattr(pull, "SECONDS", 2)
    problem, text, _ = server.pull()
    assert "took more than" in problem
    assert text == "x = 1"
