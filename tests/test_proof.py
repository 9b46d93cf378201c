"""A page to show: what is theirs, run again, and nothing from outside gets a say."""

import functools
import html
import subprocess
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from test_report import measured

pytest.importorskip("viser", reason="the extra view")

from labkit.base.exchange import Reply
from labkit.check import own_functions
from labkit.check.own_functions import counted
from labkit.commands import capstone as capstone_command
from labkit.commands import grade
from labkit.commands import proof as command
from labkit.figures import client
from labkit.grade.roster import Student
from labkit.lesson.day import days_of, find_day
from labkit.lesson.week import find_week
from labkit.lesson.writers import Writers, file_mark
from labkit.proof import card, facts, page
from labkit.proof.capstone import NO_CAPSTONE, Attempt, attempt
from labkit.report.series import Series
from labkit.sandbox.sandbox import Sandbox
from robo47 import capstone
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit

EVERY = frozenset().union(*capstone.USES.values())
EVIL = "<script>document.title='evil'</script>\"' onload=alert(1) {film}"


@pytest.fixture(scope="module")
def sandbox():
    with Sandbox() as it:
        yield it


def git(folder, *words):
    identity = ["-c", f"user.name={EVIL}", "-c", "user.email=a@example.org"]
    done = ["git", *identity, *words]
    subprocess.run(done, cwd=folder, check=True, capture_output=True)


def a_clone(folder, day=1, before="", after="", own="\n# mine\n"):
    """Write a lab of the kit's into a new folder as somebody's own, and commit it."""
    day = find_day(day)
    script = folder / day.files["script"]
    script.parent.mkdir(parents=True)
    text = day.source.read_text("utf-8")
    assert before in text
    text = text.replace(before, after) if before else text
    script.write_text(text + own, "utf-8")
    git(folder, "init", "--quiet")
    git(folder, "add", "-A")
    git(folder, "commit", "--quiet", "-m", EVIL)
    return folder


class Seen(HTMLParser):
    """The tags of a page, and its words."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.words, self.attributes = [], "", []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += [name for name, _ in attrs]

    def handle_data(self, data):
        self.words += data


def test_a_half_done_week_says_what_is_theirs_and_is_one_small_file(tmp_path):
    proof = command.found(find_week(1), a_clone(tmp_path / "of"))
    first, *rest = proof.days
    functions = [f for task in first.day.tasks for f in task.functions]
    assert sorted(first.own) == sorted(functions)
    assert not any(one.own for one in rest)
    for number in first.numbers:
        wanted = number.wanted
        assert wanted.passes(first.again[wanted.check, wanted.metric])
        assert number.status == "none"
    used = set(capstone.USES[1]) & set(functions)
    assert proof.attempt.counted == (len(used), len(EVERY))
    assert not proof.attempt.result.failed
    text = page.render(proof)
    assert len(text.encode()) < 3_000_000
    assert f"{len(functions)} of " in Seen(text).words
    assert "the kit's own do the rest" in Seen(text).words


def test_a_transposed_jacobian_is_not_theirs_and_its_numbers_are_not_run(
    tmp_path, sandbox
):
    wrong = "\n\n_right = space_jacobian\n\n\n"
    wrong += "def space_jacobian(*a):\n    return _right(*a).T\n"
    mark = '\n\nif __name__ == "__main__":'
    it = a_clone(tmp_path / "of", 3, mark, wrong + mark)
    (tmp_path / "files").mkdir()
    someone = Student("Ada", "of", it)
    found = facts.facts_of(find_day(3), someone, tmp_path / "files", sandbox)
    (task,) = (t for t in find_day(3).tasks if "space_jacobian" in t.functions)
    assert found.states[task.id] == "wrong"
    assert "space_jacobian" not in found.own
    assert found.again == {}


def test_a_whole_copy_of_the_kits_file_is_the_kits_and_not_theirs(tmp_path, sandbox):
    day = find_day(1)
    someone = Student("Ada", "of", a_clone(tmp_path / "of", own=""))
    file = someone.path / day.files["script"]
    for content in (file.read_bytes(), file.read_bytes().replace(b"\n", b"\r\n")):
        file.write_bytes(content)
        (tmp_path / "files").mkdir(exist_ok=True)
        found = facts.facts_of(day, someone, tmp_path / "files", sandbox)
        assert set(found.states.values()) == {"the kit's own file"}
        assert (found.own, found.again) == ([], {})


@pytest.mark.browser
@pytest.mark.parametrize("number", [1, 2, 3])
def test_its_tables_need_no_scrolling_on_a_phone(number, tmp_path, chromium):
    days = []
    for day in days_of(find_week(number)):
        numbers = [Series(day.number, one, Writers(own=set())) for one in day.metrics]
        again = {(m.check, m.metric): m.max or m.min or 0.0 for m in day.metrics}
        days.append(
            facts.RunDay(day, {task.id: "passed" for task in day.tasks}, numbers, again)
        )
    proof = page.Proof("Ada", True, "", days, NO_CAPSTONE)
    _, _, beyond, *_ = measured(chromium, tmp_path, page.render(proof), 390, "tr > *")
    assert beyond == "0"


def hostile():
    """Return a proof in which all that comes from outside wants to be a tag."""
    day = find_day(1)
    numbers = [Series(1, metric, Writers(own=set())) for metric in day.metrics]
    for number in numbers:
        mark = file_mark(b"another file")
        number.add({"value": 1e-15, "n_failures": 0, "notes": f"{EVIL}; {mark}"})
    states = {task.id: EVIL for task in day.tasks}
    one = facts.RunDay(day, states, numbers, {}, EVIL, EVIL)
    fresh = {"commit": EVIL, "wrong": 0, "missing": 2, "date": EVIL}
    return page.Proof(
        EVIL,
        False,
        EVIL,
        [one],
        Attempt(capstone, None, EVIL, frozenset({"make_T"})),
        fresh,
    )


def test_nothing_from_outside_becomes_a_tag():
    text = page.render(hostile(), "card.png")
    assert '<meta property="og:image" content="card.png">' in text
    assert f'content="{html.escape(EVIL)}: Week 1: foundations">' in text
    seen = Seen(text)
    assert "script" not in seen.tags
    assert not [name for name in seen.attributes if name.startswith("on")]
    for what in ("Whose functions", "a fresh clone", "What this does not prove"):
        assert what in seen.words
    assert seen.words.count("<script>") >= 7


@pytest.mark.parametrize("draws", [True, False])
def test_the_card_to_share_has_its_size_and_its_words_with_a_picture_or_without(
    monkeypatch, draws
):
    def draw(scene):
        if not draws:
            raise Robo47Error("nothing draws here")
        return np.full((*scene.size[::-1], 3), 200, dtype=np.uint8)

    monkeypatch.setattr(client, "draw", draw)
    result = capstone.pick(capstone.library())
    proof = replace(hostile(), attempt=Attempt(capstone, result, "", EVERY))
    drawn = np.asarray(card.draw(page.in_short(proof), proof.attempt)).astype(int)
    assert drawn.shape == (630, 1200, 3)
    assert (drawn[300:500, 1000] == 200).all() == draws
    green = (np.abs(drawn - card.GOOD).max(axis=2) < 10).any(axis=1)
    assert green[450:520].any()  # the pick's number; the functions are not all theirs
    assert not green[:420].any()
    partly = proof.attempt._replace(theirs=frozenset({"make_T"}))
    drawn = np.asarray(card.draw(page.in_short(proof), partly)).astype(int)
    assert not (np.abs(drawn - card.GOOD).max(axis=2) < 10).any()


@pytest.mark.parametrize("week", [1, 2, 3])
def test_the_page_the_card_and_the_capstone_count_a_perfect_students_functions_alike(
    monkeypatch, capsys, week
):
    """Also those that the sandbox cannot call: nobody could ever have 47 of 47."""
    it = own_functions.capstone_of(find_week(week))
    uses = it.USES
    mine = own_functions.Mine(None, {day: [*names] for day, names in uses.items()})
    monkeypatch.setattr(own_functions, "load", lambda week: mine)
    capstone_command.chosen(find_week(week), False)
    of = sum(map(len, uses.values()))
    says = f"{of} of the {of} functions that it calls are yours"
    assert says in " ".join(capsys.readouterr().out.split())
    every = frozenset().union(*uses.values())
    stayed = frozenset({"shortcut", "rrt_connect"} & every)
    tried = Attempt(it, None, "", every, stayed)
    assert str(tried.counted) == f"{of} of {of}"
    assert tried.counted.all
    one = sorted(every)[0]
    assert str(tried._replace(theirs=every - {one}).counted) == f"{of - 1} of {of}"


def test_a_page_without_a_name_is_headed_by_its_week_everywhere():
    proof = replace(hostile(), name="")
    text = page.render(proof, "card.png")
    assert "<title>Week 1: foundations</title>" in text
    assert '<meta property="og:title" content="Week 1: foundations">' in text
    assert "whom git does not know" not in text
    drawn = np.asarray(card.draw(page.in_short(proof), proof.attempt)).astype(int)
    big = (np.abs(drawn - card.INK).max(axis=2) < 10)[95:140, :600].any(axis=1)
    assert big.any()  # the week's heading stands in the name's place


@pytest.mark.parametrize(
    ("known", "keyboard", "typed", "name", "says"),
    [
        ("Ada", True, None, "", ""),
        ("", True, " Bo ", "Bo", "git does not know your name"),
        ("", True, "", "", "git does not know your name"),
        ("", False, None, "", "The page shows no name, because git has none"),
    ],
)
def test_a_name_that_git_does_not_know_is_asked_for_or_left_out(
    monkeypatch, capsys, known, keyboard, typed, name, says
):
    monkeypatch.setattr(command.git, "user_name", lambda clone: known)
    keys = SimpleNamespace(isatty=lambda: keyboard)
    monkeypatch.setattr(command.sys, "stdin", keys)
    monkeypatch.setattr("builtins.input", lambda question: typed)
    assert command.asked_name(Path()) == name
    out = capsys.readouterr().out
    assert out.startswith(says)
    assert bool(out) == bool(says)


def test_a_name_on_the_card_has_the_letters_of_its_font():
    assert card._printable("Ada Lovelace") == "Ada Lovelace"
    assert card._printable("Zoë") in ("Zoë", "Zoe")
    assert card._printable("\uffff") == ""


@functools.cache
def filmed():
    """Return a hostile page with a film that ends after half a second."""
    result = capstone.pick(capstone.library())._replace(seconds=0.5)
    return page.render(
        replace(hostile(), attempt=Attempt(capstone, result, "", frozenset({"make_T"})))
    )


def test_no_script_runs_but_the_players():
    first, second = filmed(), page.render(hostile())
    nonces = {t.partition("'nonce-")[2].partition("'")[0] for t in (first, second)}
    assert len(nonces - {""}) == 2  # nobody can know it before
    seen = Seen(first)
    assert seen.tags.count("iframe") == 1
    assert "script" not in seen.tags
    assert "unsafe-inline'; script-src 'nonce-" in first


@pytest.mark.browser
def test_the_pick_plays_on_the_page_and_the_evil_does_not(tmp_path, chromium):
    playwright = pytest.importorskip("playwright.sync_api")
    file = tmp_path / "proof.html"
    bad = "<script>document.title='evil'</script><p id=there>"
    text = filmed().replace("<section>", f"{bad}<section>", 1)
    file.write_text(text, "utf-8")  # as if escaping had failed
    with playwright.sync_playwright() as play:
        browser = play.chromium.launch(
            executable_path=chromium,
            args=["--use-gl=angle", "--use-angle=swiftshader", "--no-sandbox"],
        )
        tab = browser.new_page(viewport={"width": 390, "height": 844})
        tab.goto(file.as_uri())
        clock = tab.frame_locator("iframe").locator("input").first
        clock.wait_for(timeout=60_000)
        assert tab.locator("#there").count() == 1
        assert tab.title() != "evil"
        assert tab.evaluate("document.documentElement.scrollWidth") == 390
        browser.close()


def test_an_arm_that_stops_is_told_and_not_filmed():
    class Failing:
        def session(self, *_, **__):
            hangs = Reply(kind="stopped", error="it hangs")
            return SimpleNamespace(ask=lambda *_: [hangs], used=lambda: (0.0, 0.0))

    day = find_day(1)
    (task,) = (task for task in day.tasks if "make_T" in task.functions)
    known = facts.RunDay(day, {task.id: "passed"}, [])
    found = attempt(capstone, [known], [day.source.parent], Failing())
    says = "make_T did not return: it hangs"
    assert found == Attempt(capstone, None, says, frozenset({"make_T"}))


class World:
    """What answers questions itself: the sandbox cannot be sent it."""

    def free(self, q):
        return True


def test_a_whole_picture_travels_and_what_stays_here_is_called_the_kits(sandbox):
    """320 x 240 pixels are more numbers than a task's answer may have."""
    n = 320 * 240
    uses = {10: ("back_project",), 12: ("shortcut",)}

    def tried(fns, seed=None):
        cloud = fns.back_project(np.eye(3), np.eye(4), np.zeros((n, 2)), np.ones(n))
        fns.shortcut(np.zeros((2, 7)), World(), np.zeros((0, 2)))
        return cloud

    some = SimpleNamespace(
        USES=uses,
        library=SimpleNamespace,
        attempt=tried,
        film=lambda result: SimpleNamespace(qpos=result),
    )
    known = []
    for number in uses:
        day = find_day(number)
        own = {t.id: "passed" for t in day.tasks if {*t.functions} & {*uses[number]}}
        known.append(facts.RunDay(day, own, []))
    places = [one.day.source.parent for one in known]
    found = attempt(some, known, places, sandbox)
    assert found.stopped == ""
    assert found.result.shape == (n, 3)
    assert found.theirs == {"back_project", "shortcut"}
    assert found.stayed == {"shortcut"}
    # What passes is theirs on every face, and the page says openly what ran instead.
    assert found.counted == counted(uses, {10: {"back_project"}, 12: {"shortcut"}})
    assert str(found.counted) == "2 of 2"
    assert (
        "By the student, but not run here: shortcut." in Seen(page._stayed(found)).words
    )
    assert page._stayed(found._replace(stayed=frozenset())) == ""
    kits = page._by(uses, found).count("<td class=wide>–</td>")
    assert kits == 2  # none of the two is called the kit's


def test_a_class_gets_a_page_each_and_a_lost_folder_a_reason(tmp_path, capsys):
    # Nothing of hers moves the arm, which need not pick anything up then.
    broken = "".join(f"\n{name} = None" for name in capstone.USES[1])
    mark = '\n\nif __name__ == "__main__":'
    a_clone(tmp_path / "ada", 1, mark, broken + mark)
    class_ = [Student("Ada -x", "ada", tmp_path / "ada", file="ada")]
    class_.append(Student("Bob", "bob", tmp_path / "bob", file="bob"))
    grade.prove(class_, 1, tmp_path / "proof", 1)
    says, *without = capsys.readouterr().out.splitlines()
    assert says.startswith("pages to show: 1 in ")
    assert without[0].startswith("Bob: ")
    assert "nothing is begun" in " ".join(without)
    text = (tmp_path / "proof" / "ada.html").read_text("utf-8")
    assert "Ada -x, Week 1" in text
    words = Seen(text).words
    assert "a teacher's kit" in words
    assert "None of the functions that move the arm is the student's yet." in words
    assert not (tmp_path / "proof" / "bob.html").exists()


def test_a_place_that_cannot_be_written_is_told_before_the_work(run, tmp_path):
    place = tmp_path / "no" / "where.html"
    done = run("scripts/proof.py", "--of", tmp_path, "--out", place)
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert "--out" in done.stderr
