"""The kit for students: it runs, it checks, and it shows no answers."""

import subprocess

import pytest

from conftest import ROOT, need, run_copy
from labkit.lesson.day import all_days, find_day
from labkit.lesson.lab_module import read_script
from labkit.lesson.sealed import is_sealed, opened, seal
from labkit.lesson.starter import find_regions, make_starter

DAY = find_day(1)
WEEK = DAY.folder.name


@pytest.fixture(scope="module")
def edition(tmp_path_factory):
    need((ROOT / ".git").exists(), "the kit as a git repository")
    out = tmp_path_factory.mktemp("edition") / "students"
    done = run_copy(ROOT, "scripts/edition.py", out)
    assert done.returncode == 0, done.stderr
    return out


def test_a_sealed_lab_opens_to_what_it_was():
    text = read_script(DAY.source)
    sealed = seal(text, 1)
    assert is_sealed(sealed)
    assert not is_sealed(text)
    assert opened(sealed) == text == opened(text)
    for region in find_regions(text, "x"):
        body = text.splitlines()[region.start + 1 : region.end]
        assert not any(line.strip() in sealed for line in body if len(line) > 20)


@pytest.mark.kit
class TestTheEdition:
    def test_holds_no_solution_no_catalogue_no_notebook_and_no_history(self, edition):
        names = [p.relative_to(edition).as_posix() for p in edition.rglob("*")]
        for word in ("submissions", "tests/", "notebooks/", "bench/", "test_day"):
            assert not [n for n in names if word in n and "/.git/" not in f"/{n}"]
        for day in all_days():
            script = edition / day.source.relative_to(ROOT)
            assert is_sealed(script.read_text("utf-8"))
        log = subprocess.run(
            ["git", "log", "--format=%s"], cwd=edition, capture_output=True, text=True
        )
        assert len(log.stdout.splitlines()) == 1
        assert "hold" in (edition / "EDITION.md").read_text("utf-8")

    def test_runs_the_kits_lab_and_every_check_passes(self, edition):
        done = run_copy(edition, f"{WEEK}/src/{DAY.script}", "--no-log")
        assert done.returncode == 0, done.stderr
        assert "All checks PASSED." in done.stdout

    def test_gives_the_same_starter_and_tells_mistakes_and_passing_work(self, edition):
        text = read_script(DAY.source)
        assert run_copy(edition, "scripts/start_day.py", 1).returncode == 0
        work = edition / WEEK / "work" / DAY.script
        begun = work.read_text("utf-8")
        assert begun.splitlines()[2:] == make_starter(text, "x", 1).splitlines()[2:]
        work.write_text(text.replace("-s, 0.0], [s, c", "s, 0.0], [-s, c"), "utf-8")
        done = run_copy(edition, "scripts/check_day.py", 1)
        assert "your code rotates in the wrong direction" in " ".join(
            done.stdout.lower().split()
        )
        work.write_text(text, "utf-8")
        done = run_copy(edition, "scripts/check_day.py", "--task", "1.2")
        assert done.returncode == 0
        hint = run_copy(edition, "scripts/hint.py", "1.2").stdout
        assert "does not show the kit's own" in hint
        assert "NotImplementedError" not in hint
        work.unlink()

    def test_names_no_command_that_it_has_not(self, edition):
        targets = (edition / "Makefile").read_text("utf-8")
        for command in ("test", "grade", "bench", "site", "edition"):
            assert f"\n{command}:" not in targets
            assert f"make {command}\n" not in (edition / "README.md").read_text("utf-8")

    def test_its_readme_is_about_what_it_has(self, edition):
        readme = (edition / "README.md").read_text("utf-8")
        assert "[EDITION.md](EDITION.md) lists what is left out." in readme
        for gone in ("CONTRIBUTING", "make test", "own tests", "](docs/", "bench/"):
            assert gone not in readme, gone
        assert "as a demonstration, and logs its numbers" in readme  # what stays

    def test_is_written_over_an_older_one_alone(self, edition, tmp_path):
        (tmp_path / "thesis.txt").write_text("mine")
        done = run_copy(ROOT, "scripts/edition.py", tmp_path)
        assert (done.returncode, "is no edition" in done.stderr) == (2, True)
        assert run_copy(ROOT, "scripts/edition.py", ROOT / "x").returncode == 2
        assert run_copy(ROOT, "scripts/edition.py", edition).returncode == 0
