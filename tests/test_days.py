"""Every day of the course: manifest, starter, questions and documents."""

import re

import inprocess
import pytest
from catalogue import run_as_lab

from conftest import ROOT, days, kits_worksheet
from labkit.base import git
from labkit.handin.worksheet import split_sections
from labkit.judge.row import rows_of
from labkit.lesson.lab import predictions
from labkit.lesson.starter import find_regions, make_starter
from labkit.lesson.week import WORK, weeks
from labkit.sandbox.messages import library_of

DAYS = days()
each_day = pytest.mark.parametrize("day", DAYS, ids=lambda day: f"day{day.number}")


@each_day
@pytest.mark.kit
class TestManifest:
    def test_the_script_has_exactly_the_tasks_of_the_manifest(self, day):
        regions = find_regions(day.source.read_text("utf-8"), day.script)
        found = {(region.task, region.function) for region in regions}
        assert found == {(t.id, name) for t in day.tasks for name in t.functions}

    def test_every_function_has_a_row_of_questions(self, day):
        assert set(rows_of(day)) == {f for task in day.tasks for f in task.functions}

    def test_hints_are_two_or_three_of_a_size_to_read_and_ask(self, day):
        for task in day.tasks:
            assert len(task.hints) in (2, 3), task.id
            assert any("?" in hint for hint in task.hints), task.id
            for hint in task.hints:
                assert 20 <= len(hint.split()) <= 50, hint

    def test_hints_give_no_line_of_the_solution_away(self, day):
        lines = day.source.read_text("utf-8").splitlines()
        given = "\n".join(hint for task in day.tasks for hint in task.hints)
        for region in find_regions("\n".join(lines), day.script):
            for line in lines[region.start + 1 : region.end]:
                assert len(line.strip()) < 8 or line.strip() not in given

    def test_tasks_send_back_to_sections_that_the_lab_guide_has(self, day):
        guide = (day.folder / day.guide).read_text("utf-8")
        headings = set(re.findall(r"^#+ (.+)$", guide, re.MULTILINE))
        for task in day.tasks:
            section = task.read.partition(";")[0].removeprefix("Lab guide, ")
            assert section in headings, task.id

    def test_each_task_is_named_where_a_paragraph_leads_to_it(self, day):
        """By a mark, (4.2), or as "Task 4.2"; not by the example of a mark alone."""
        guide = (day.folder / day.guide).read_text("utf-8")
        prose = re.sub(r"```.*?```", "", guide, flags=re.DOTALL)
        prose = re.sub(r"(?m)^\|.*|(?:such as|after a paragraph,)\s+\(.+?\)", "", prose)
        id_ = rf"({day.number}\.\d+)"
        marks = set(re.findall(rf"\({id_}\)", prose))
        named = marks | set(re.findall(rf"\b[Tt]ask {id_}\b", prose))
        ids = {task.id for task in day.tasks}
        assert ids - named == set()
        assert marks - ids == set()

    def test_a_hole_in_the_numbers_of_tasks_is_explained(self, day):
        guide = " ".join((day.folder / day.guide).read_text("utf-8").split())
        numbers = [int(task.id.partition(".")[2]) for task in day.tasks]
        holes = set(range(1, max(numbers))) - set(numbers)
        for hole in holes:
            assert re.search(rf"no (\d+\.\d+ and no )?{day.number}\.{hole}\b", guide), (
                hole
            )

    def test_the_questions_have_folded_answers(self, day):
        guide = (day.folder / day.guide).read_text("utf-8")
        answers = guide.partition('## Answers to "Can you explain?"')[2]
        fold = answers.partition("</details>")[0]
        assert fold.count("<summary>") == 1
        numbers = re.findall(r"^(\d+)\. ", fold, re.MULTILINE)
        assert numbers == [str(i + 1) for i in range(day.questions)]
        assert "<details>" not in kits_worksheet(day)  # else it counts as an answer

    def test_the_worksheet_has_room_for_what_is_asked(self, day):
        sections = split_sections(kits_worksheet(day))
        assert {term.lower() for term in day.terms} <= sections.keys()
        drawings = [name for name in sections if name.startswith("drawing ")]
        assert len(drawings) == day.drawings
        # What `make check` reports needs no box to be ticked.
        assert "- [ ]" not in kits_worksheet(day)
        assert f"make check DAY={day.number}" in " ".join(kits_worksheet(day).split())
        questions = re.findall(r"^\d+\.", sections["can you explain?"], re.MULTILINE)
        assert len(questions) == day.questions

    def test_the_guide_explains_every_term_of_the_worksheet(self, day):
        """A term, or two that people confuse: "screw axis or twist"."""
        guide = (day.folder / day.guide).read_text("utf-8")
        words = {word.lower() for word in re.findall(r"\*\*(.+?)\*\*", guide)}
        words |= {word.removesuffix("s") for word in words}  # the plural defines, too
        asked = {word.lower() for term in day.terms for word in term.split(" or ")}
        assert asked <= words

    def test_the_guides_parts_take_the_minutes_that_the_day_is_planned_for(self, day):
        guide = (day.folder / day.guide).read_text("utf-8")
        table = guide.partition("| part | minutes |\n")[2].partition("\n\n")[0]
        parts = re.findall(r"\| (\d+) \|$", table, re.MULTILINE)
        assert not parts or sum(map(int, parts)) == day.minutes

    def test_the_lab_measures_what_the_worksheet_lets_predict(self, day):
        rows = predictions(kits_worksheet(day).replace("*(your prediction)*", "?"))
        lab = day.source.read_text("utf-8")
        assert rows
        assert set(re.findall(r'lab\.measured\(\s*"(.+?)"', lab)) <= set(rows)

    def test_the_library_of_earlier_days_holds_no_answer_of_this_one(self, day):
        assert not {f"robo47.{name}" for name in day.library} & set(library_of(day))


@each_day
class TestScript:
    def test_the_solution_passes_every_task(self, day):
        verdicts = inprocess.verdicts(day, day.source)
        assert {t: (v.status, v.message) for t, v in verdicts.items()} == {
            task.id: ("passed", "") for task in day.tasks
        }

    @pytest.mark.kit
    def test_the_starter_has_every_task_to_do(self, day, tmp_path):
        path = tmp_path / day.script
        text = make_starter(day.source.read_text("utf-8"), day.script, day.number)
        path.write_text(text, "utf-8")
        (tmp_path / "kit.py").write_text("")
        verdicts = inprocess.verdicts(day, path)
        assert {verdict.status for verdict in verdicts.values()} == {"todo"}

    def test_the_complete_lab_passes(self, day):
        assert run_as_lab(day) == 0

    @pytest.mark.kit
    def test_a_mistake_in_a_docstring_is_ours_so_each_task_has_one(self, day):
        text = day.source.read_text("utf-8")
        for task in day.tasks:
            for function in task.functions:
                assert re.search(rf'def {function}\((?:.|\n)*?:\n    """', text)


def code_of(path):
    """Return a module; a command without its help, whose examples name a day."""
    text = path.read_text("utf-8")
    return text.split('"""', 2)[-1] if path.parent.name == "commands" else text


@pytest.mark.kit
def test_the_machine_names_no_day():
    words = re.compile(r"\bday\d+\b|day\d+_|compose_fk|link4_to_world")
    named = [
        f"{path.relative_to(ROOT)}: {line.strip()}"
        for path in sorted((*ROOT.glob("robo47/**/*.py"), *ROOT.glob("labkit/**/*.py")))
        for line in code_of(path).splitlines()
        if words.search(line.replace("make day1", ""))  # the first command
    ]
    assert named == []


@pytest.mark.kit
@pytest.mark.parametrize("week", weeks(), ids=lambda week: week.folder.name)
def test_the_kit_holds_no_file_of_a_student(week):
    """A clone would begin with it, and `make start` would not write the starter."""
    try:
        place = f"{week.folder.name}/{WORK}"
        held = git.run("ls-files", "--", place, folder=ROOT, seconds=git.SECONDS)
    except git.GitError:
        pytest.skip("no git repository")
    assert held.stdout == ""
