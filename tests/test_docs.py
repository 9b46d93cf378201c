"""Documents: outputs come from runs, numbers in sentences are recomputed."""

import contextlib
import functools
import importlib.util
import io
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import whole

from conftest import AUTHORS, ROOT, kits_worksheet, need
from labkit.base import processes
from labkit.base.text import blocks
from labkit.commands import capstone, constants, docs, week
from labkit.lesson.day import all_days, find_day
from robo47 import __version__, delivery

WEEK = ROOT / "w1-foundations"
DAY = find_day(1)
DOCUMENTS = [
    ROOT / "README.md",
    *sorted(ROOT.glob("w*-*/**/*.md")),
    *ROOT.glob("C*.md"),
]
DOCUMENTS += sorted((ROOT / "docs").glob("*.md"))
# The student's own are no business of a test.
DOCUMENTS = [
    path
    for path in DOCUMENTS
    if path not in [day.folder / day.worksheet for day in all_days()]
    and DAY.work.parent not in path.parents
]


def test_no_line_of_a_paragraph_becomes_a_list_item():
    """In Markdown a line that begins with "1." ends a paragraph and begins a list."""
    item = re.compile(r"\s*(?:[0-9]+[.)]|[-*+]) ")
    for path in DOCUMENTS:
        text = re.sub(r"```.*?```", "", path.read_text("utf-8"), flags=re.DOTALL)
        for block in re.split(r"\n\s*\n", text):
            first, *others = block.strip("\n").splitlines() or [""]
            if not item.match(first):
                broken = [line for line in others if re.match(r" {0,3}1[.)] ", line)]
                assert not broken, f"{path.name}: {broken[0]}"


def folder_of(path):
    """Return the week's folder of a document; "" of one that belongs to no week."""
    folder = path.relative_to(ROOT).parts[0]
    return folder if re.match(r"w\d+-", folder) else ""


def compared():
    """Return the documents whose outputs are compared: all, or in CI some of them."""
    every = docs.documents()
    if not os.environ.get("ROBO47_CI") or not whole.machine_is_recorded():
        return every
    new = {
        p for day in all_days() if whole.changed(day) for p in docs.documents_of(day)
    }
    others = [path for path in every if path not in new]
    return [*new, *whole.sample(others, "documents", whole.FILES_PART)]


def test_ci_compares_the_outputs_of_a_changed_day_and_a_fifth_of_the_others(
    monkeypatch,
):
    monkeypatch.setattr(whole, "changed", lambda day: day.number == 1)
    monkeypatch.setattr(whole, "machine_is_recorded", lambda: True)
    monkeypatch.delenv("ROBO47_CI", raising=False)
    assert compared() == docs.documents()
    monkeypatch.setenv("ROBO47_CI", "1")
    assert DAY.folder / DAY.guide in compared()
    assert len(compared()) < len(docs.documents()) / 3
    monkeypatch.setattr(whole, "machine_is_recorded", lambda: False)
    assert compared() == docs.documents()


@pytest.mark.kit
@pytest.mark.parametrize("folder", sorted({*map(folder_of, docs.documents())}))
def test_every_output_in_the_documents_is_what_the_command_prints_today(
    folder, monkeypatch, tmp_path, capsys
):
    """A lab runs once: for its own document and for the table of its week.

    What needs no process of its own runs in this one, and a delivery that two outputs
    show is made once.
    """
    need(shutil.which("make") is not None, "make")
    start = processes.run
    here = {
        "run_week.py": week.main,
        "constants.py": constants.main,
        "capstone.py": capstone.main,
    }
    deliver, made = delivery.deliver, {}

    def delivered(fns, *how):  # with the library's functions: --kit
        if (key := repr(how)) not in made:
            made[key] = deliver(fns, *how)
        return made[key]

    monkeypatch.setattr(delivery, "deliver", delivered)

    @functools.cache
    def lab(source):
        log = tmp_path / f"{source.stem}.csv"
        variables = {**os.environ, "ROBO47_METRICS": str(log)}
        done = start(
            [sys.executable, str(source)], env=variables, cwd=source.parents[1]
        )
        return done, log.read_bytes()

    def run(command, env, cwd=ROOT):
        script = cwd / command[1]
        if script.parent.name == "src":
            done, rows = lab(script)
            if "--no-log" not in command:
                Path(env["ROBO47_METRICS"]).write_bytes(rows)
            return done
        main = here.get(script.name)
        if main is None:
            return start(command, env=env, cwd=cwd)
        monkeypatch.setattr(sys, "argv", command[1:])
        said = contextlib.redirect_stderr(io.StringIO())
        with said as wrong, contextlib.redirect_stdout(io.StringIO()) as printed:
            code = main()
        texts = printed.getvalue(), wrong.getvalue()
        return subprocess.CompletedProcess(command, code, *texts)

    monkeypatch.setattr(processes, "run", run)
    monkeypatch.setenv("COLUMNS", "80")
    docs.output_of.cache_clear()
    own = [path for path in compared() if folder_of(path) == folder]
    drift = docs.renew(dict.fromkeys(own, False), check=True)
    assert drift == 0, capsys.readouterr().out


@pytest.mark.parametrize(
    ("printed", "same", "drifted"),
    [
        (
            "error 2.0e-15, 0.59 m",
            "error 9.1e-16, 0.59 m",
            ["error 9.1e-16, 0.60 m", "error 1e-3, 0.59 m", "errors 9e-16, 0.59 m"],
        ),
        ("error 0", "error 2.0e-15", ["error 0.0e+00"]),  # a lab prints no such zero
        ("error 1.1e-16", "error 2.0e-15", ["error 0.0e+00"]),
    ],
)
def test_a_drifted_output_is_found(monkeypatch, printed, same, drifted):
    monkeypatch.setattr(docs, "requested_output", lambda request: f"{printed}\n")
    block = "<!-- run: python x -->\n```text\n{}\n```\n<!-- end -->"
    assert docs.rebuilt(block.format(same))[1] == []
    for old in drifted:
        found = docs.rebuilt(block.format(old))
        assert found == (block.format(printed), ["python x"])


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda p: p.name)
def test_every_relative_link_leads_somewhere(path):
    text = path.read_text("utf-8")
    targets = re.findall(r"\]\((?!http|#)([^)#]+)", re.sub(r"`[^`]*`", "", text))
    targets += re.findall(r'src(?:set)?="(?!http)([^"]+)"', text)
    missing = [t for t in targets if not (path.parent / t).exists()]
    assert missing == []


def test_the_worksheet_asks_for_every_term_of_the_lab_guide():
    guide = (WEEK / "docs/day1-lab.md").read_text("utf-8")
    sheet = kits_worksheet(DAY)
    terms = re.findall(r"^- \*\*(.+?)\*\*: ", guide, re.MULTILINE)
    glossary = sheet.split("## Glossary")[1].split("\n## ")[0]
    assert len(terms) == 8
    assert re.findall(r"^### (.+)$", glossary, re.MULTILINE) == terms
    assert len(re.findall(r"^### Drawing \d", sheet, re.MULTILINE)) == 3
    questions = sheet.split("## Can you explain?")[1].split("\n## ")[0]
    assert len(re.findall(r"^\d\. ", questions, re.MULTILINE)) == 5


def test_the_readme_names_the_commands_that_ci_runs():
    readme = (ROOT / "README.md").read_text("utf-8")
    ci = (ROOT / ".ci/run").read_text("utf-8")
    for command in ("make day1", "make test"):
        assert command in readme
    assert "make test" in ci
    assert "make lint" in ci
    assert f"-m '{AUTHORS}'" in ci
    assert "- run: .ci/run\n" in (ROOT / ".github/workflows/ci.yml").read_text("utf-8")


def test_the_readme_says_how_many_days_stand():
    readme = (ROOT / "README.md").read_text("utf-8").split("\n<!-- days")[0]
    says = f"of which the first {len(all_days())} are written"
    assert says in " ".join(readme.split())
    assert [day.number for day in all_days()] == [*range(1, len(all_days()) + 1)]


def test_the_readme_has_one_path_one_list_of_commands_and_only_working_pages():
    readme = (ROOT / "README.md").read_text("utf-8")
    prose, commands = readme.partition("\n## Commands")[::2]
    assert (prose.count("<!-- run: make"), commands.count("<!-- run: make")) == (0, 1)
    path = re.findall(r"^\d\. .*?`make (\w+)`", prose, re.MULTILINE | re.DOTALL)
    assert path == ["start", "check", "hint", "run"]
    # The arm's page is a page on the built site alone.
    assert "site/arm.md" not in readme


def test_every_command_in_the_teachers_guide_exists(run):
    pages = (ROOT / "docs/teaching.md", ROOT / "docs/cluster.md")
    guide = "\n".join(page.read_text("utf-8") for page in pages)
    known = run("scripts/grade_class.py", "--help").stdout
    makefile = (ROOT / "Makefile").read_text("utf-8")
    code = re.findall(r"`[^`]+`|^ *(?:- run: )?make .*", guide, re.MULTILINE)
    targets = {name for text in code for name in re.findall(r"\bmake ([a-z]+)", text)}
    assert targets >= {"grade", "check", "start"}
    missing = [n for n in targets if not re.search(rf"^{n}%?:", makefile, re.M)]
    assert missing == []
    lines = [line for line in guide.splitlines() if "make grade" in line]
    named = {option for line in lines for option in re.findall(r"--[a-z]+", line)}
    assert named >= {"--pull", "--deadline", "--dask"}
    assert {option for option in named if option not in known} == set()


def formulas(path):
    """Return what stands between dollars in a document, without its code."""
    text = re.sub(r"```.*?```|`[^`]*`", "", path.read_text("utf-8"), flags=re.DOTALL)
    return re.findall(r"\$\$(.+?)\$\$|\$(.+?)\$", text, re.DOTALL)


@pytest.mark.parametrize("path", [p for p in DOCUMENTS if "$" in p.read_text("utf-8")],
                         ids=lambda p: p.name)  # fmt: skip
def test_formulas_are_in_a_dialect_that_github_and_the_site_read(path):
    """The site's reader takes \\tfrac12 for the fraction 12 over what follows."""
    found = [block or inline for block, inline in formulas(path)]
    for formula in found:
        assert not re.search(r"°|\\[td]?frac\s*\w", formula), formula
        assert formula.count("{") == formula.count("}"), formula
        # GitHub drops a backslash before a sign, and reads two at a line's end only.
        assert not re.search(r"\\[,;:!{}]|\\\\(?!\n)", formula), formula
    assert not [inline for _, inline in formulas(path) if "\n" in inline]
    if importlib.util.find_spec("docutils") is not None:  # make site brings it
        from docutils.utils.math.latex2mathml import tex2mathml

        assert all(tex2mathml(formula) for formula in found)


PAGES_OF_DAYS = [day.folder / name for day in all_days()
                 for name in (day.guide, day.worksheet) if name]  # fmt: skip
# A derivative in letters: qd, sdd, dq/ds, Jdot.
BARE = re.compile(r"(?<![\w/.=])(?:[qsexvV]dd?|d?M?d[A-Za-z]/d[a-z]|ddq|Jdot)(?!\w)")


def bare_derivatives(text):
    """Return derivatives that are in neither a formula nor code, nor in a picture."""
    code = r"```.*?```|`[^`]*`|!\[.*?\]\(.*?\)|\$\$.*?\$\$|\$[^$]+\$"
    return BARE.findall(re.sub(code, "", text, flags=re.DOTALL))


@pytest.mark.parametrize("path", [ROOT / "docs" / "notation.md", *PAGES_OF_DAYS],
                         ids=lambda p: p.name)  # fmt: skip
def test_a_derivative_has_its_dots_in_a_formula_and_its_letters_in_code(path):
    assert bare_derivatives(path.read_text("utf-8")) == []


def test_a_derivative_in_bare_letters_is_found():
    text = "The speed sd and dq/ds, `qd`, $\\dot q$, $q_d$; a bed, x/d.\n```\nsdd\n```"
    assert bare_derivatives(text) == ["sd", "dq/ds"]


def test_each_day_of_the_readme_is_a_captioned_picture():
    readme = (ROOT / "README.md").read_text("utf-8")
    rows = [line.split(" | ") for line in readme.splitlines() if line.startswith("| ")]
    cells = [cell.strip("| ") for row in rows for cell in row]
    for day in all_days():
        guide = f"{day.folder.name}/{day.guide}"
        small = f"{day.folder.name}/figures/day{day.number}_small.png"
        picture = f"[![A picture of day {day.number}]({small})]({guide})"
        at = cells.index(picture)
        says = day.see[0].upper() + day.see[1:]
        words = f"**[Day {day.number}: {day.title}]({guide})**<br>{says}"
        assert cells[at + 4] == words  # the row below, in the same column
        assert day.method
        assert day.result, f"day {day.number}: see = 'method: what the lab shows'"


def test_a_line_of_a_weeks_list_does_not_repeat_the_method_of_the_title():
    listed = docs.days_list("w3-learning", ROOT / "w3-learning")
    assert "](docs/day15-lab.md)**: a network that" in listed
    assert "](docs/day18-lab.md)**: DAgger: from" in listed  # not in its title
    assert "Behaviour cloning](docs/day15-lab.md)** |" in listed  # its picture's words
    assert "](docs/day18-lab.md)**<br>DAgger |" in listed


GUIDES = [day.folder / day.guide for day in all_days()]


@pytest.mark.parametrize("path", GUIDES, ids=lambda p: p.name)
def test_no_sentence_goes_on_with_what_the_site_takes_for_a_list(path):
    """A line that begins with "1. " or "- " within a paragraph becomes a list."""
    text = re.sub(r"```.*?```", "", path.read_text("utf-8"), flags=re.DOTALL)
    paragraphs = (part.splitlines() for part in text.split("\n\n"))
    prose = [lines for lines in paragraphs if lines and lines[0][:1].isalpha()]
    found = [ln for lines in prose for ln in lines if re.match(r"(1\.|[-+*]) ", ln)]
    assert prose
    assert found == []


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda p: p.name)
def test_every_picture_says_in_words_what_it_shows_and_no_output_is_empty(path):
    text = path.read_text("utf-8")
    assert not re.search(r"(?<!`)!\[.{0,4}\]\((?!.*jpg)", text)
    assert not re.search(r"<!-- run: .+ -->\n<!-- end -->", text)


def test_no_zero_in_an_output_has_a_sign():
    guides = [day.folder / day.guide for day in all_days()]
    outputs = [out for p in guides for out in blocks(p.read_text("utf-8"), "run")]
    assert len(outputs) > 8
    for output in outputs:
        assert not re.search(r"(?<![\w.])-0(\.0*)?(?![\d.e])", output)


def test_what_github_shows_says_what_the_kit_is():
    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    assert f"\nversion: {__version__}\n" in citation
    form = (ROOT / ".github/ISSUE_TEMPLATE/checker-misled-me.yml").read_text("utf-8")
    assert "make check TASK=1.4 ARGS=--json" in form


def test_the_containers_are_built_from_one_dockerfile():
    dockerfile = (ROOT / "Dockerfile").read_text("utf-8")
    text = (ROOT / ".devcontainer/devcontainer.json").read_text("utf-8")
    inside = json.loads(re.sub(r"^ *//.*\n", "", text, flags=re.MULTILINE))
    assert (ROOT / ".devcontainer" / inside["build"]["dockerfile"]).samefile(
        ROOT / "Dockerfile"
    )
    assert f" AS {inside['build']['target']}\n" in dockerfile
    assert (
        f"useradd --create-home --shell /bin/bash {inside['remoteUser']}" in dockerfile
    )
    view = (ROOT / "labkit/commands/view.py").read_text("utf-8")
    assert f'"--port", type=port, default={inside["forwardPorts"][0]}' in view
    assert "bubblewrap" in dockerfile
    assert "podman build -t robo47 .\n" in (ROOT / "docs/teaching.md").read_text(
        "utf-8"
    )
    commands = [dockerfile, inside["postCreateCommand"]]
    scripts = {s for text in commands for s in re.findall(r"scripts/\w+\.py", text)}
    assert scripts == {"scripts/setup_env.py", "scripts/fetch_menagerie.py"}
