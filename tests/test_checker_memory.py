"""The checker's memory: what changed, and which mistakes were left behind."""

from types import SimpleNamespace

from labkit.base import store
from labkit.check import memory
from labkit.judge import Verdict


def results(**tasks):
    return [
        SimpleNamespace(
            task=SimpleNamespace(id=name.replace("_", ".")[1:]),
            verdict=Verdict(*state),
        )
        for name, state in tasks.items()
    ]


def test_only_what_changed_is_noted(tmp_path):
    for state in (("wrong", "a"), ("wrong", "a"), ("passed", "")):
        memory.note(results(t1_1=state, t1_2=("todo", "unwritten")), tmp_path)
    found = [(entry.task, entry.status) for entry in memory.journal(tmp_path)]
    assert found == [("1.1", "wrong"), ("1.2", "todo"), ("1.1", "passed")]


def test_mistakes_are_met_once_and_left_behind_when_the_task_passes(tmp_path):
    for state in (("wrong", "a"), ("wrong", "b"), ("wrong", "a"), ("passed", "")):
        memory.note(results(t1_1=state, t1_2=("close", "c")), tmp_path)
    memory.note(results(t1_3=("wrong", "missing")), tmp_path)
    met = memory.mistakes_met(memory.journal(tmp_path), {"1.1": "passed"})
    assert [one[:3] for one in met] == [
        ("1.1", "a", "left behind"),
        ("1.2", "c", "not checked since"),
        ("1.1", "b", "left behind"),
    ]


def test_still_there_is_what_the_last_check_of_the_file_as_it_is_found(tmp_path):
    for slug in ("a", "b"):
        says = f"It is {slug}. Mend it."
        memory.note(results(t1_1=("wrong", slug, says)), tmp_path)
    met = memory.mistakes_met(memory.journal(tmp_path), {"1.1": "wrong"})
    assert met == [
        ("1.1", "a", "not right yet", "It is a."),
        ("1.1", "b", "still there", "It is b."),
    ]


def test_what_follows_from_another_task_is_no_mistake_of_its_own(tmp_path):
    first, then = ("wrong", "a"), ("wrong", "b", "its words", (), "1.1")
    memory.note(results(t1_1=first, t1_2=then), tmp_path)
    (met,) = memory.mistakes_met(memory.journal(tmp_path), {"1.1": "wrong"})
    assert met[:3] == ("1.1", "a", "still there")


def test_a_torn_or_odd_journal_loses_its_odd_lines_alone(tmp_path):
    memory.note(results(t1_1=("wrong", "a")), tmp_path)
    with store.path_of(memory.JOURNAL, tmp_path).open("ab") as file:
        file.write(b'[1, "1.2"\n{"x": 1}\n\xff\xfe\nnull\n')
    memory.note(results(t1_1=("passed", "")), tmp_path)
    assert [entry.status for entry in memory.journal(tmp_path)] == ["wrong", "passed"]


def test_a_line_of_an_older_kit_began_with_the_time(tmp_path):
    store.add_lines(memory.JOURNAL, ['[1790000000.5, "1.1", "wrong", "a"]'], tmp_path)
    assert memory.journal(tmp_path) == [memory.Entry("1.1", "wrong", "a")]


def test_a_folder_that_cannot_be_written_costs_the_memory_alone(tmp_path):
    (tmp_path / ".robo47").write_text("a file in the way")
    memory.note(results(t1_1=("wrong", "a")), tmp_path)
    assert memory.journal(tmp_path) == []


def test_what_was_said_of_a_mistake_is_a_sentence_and_not_the_results_name():
    assert memory.first_sentence("sigma: Off by 2. Look again.") == "sigma: Off by 2."
    assert (
        memory.first_sentence("It is wrong. (Off by 3.)") == "It is wrong. (Off by 3.)"
    )
    assert memory.first_sentence("It is wrong. Off by 3.") == "It is wrong."
