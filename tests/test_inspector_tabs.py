"""Every tab shows the student's own: a sign in a function changes what one sees.

`SHOWN` is the table: which functions of the day's tasks stand behind what a tab shows.
The line that says in words how they compare with the library's does not count here.
"""

from functools import cache, partial

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra view")

from tabs_on_paper import Desk, same

from conftest import load_script
from labkit.base.exchange import Path
from labkit.inspector import declared, words
from labkit.inspector.arm import Arm
from labkit.inspector.common_tabs import Joints
from labkit.inspector.ghost import compare
from labkit.inspector.own import NoAnswerError
from labkit.inspector.tab import day_tabs
from labkit.lesson.day import day_numbers, find_day
from robo47 import panda

pytestmark = pytest.mark.kit


def tabs():
    """Return {(day, title): class} of all tabs that days bring."""
    return {
        (number, tab.title): tab
        for number in day_numbers()
        for tab in day_tabs(find_day(number)).tabs
        if tab is not Joints
    }


SHOWN = {name: " ".join(tab.functions) for name, tab in tabs().items()}


def values_of(control):
    """Return the values that a person gives a widget, one after the other."""
    first, *others = control.args
    if control.kind == "slider":
        return others[:1]  # its lower end
    if control.kind == "choice":
        return [*others[0], others[0][0]]
    return [True] if control.kind == "tick" else first


def uses(number, title):
    """Yield what a person does in a tab, one thing after the other."""
    kind, base = tabs()[number, title], declared.Declared
    for name, piece in kind.declared().items():
        if isinstance(piece, declared.Handle):
            yield partial(drag, name=name, then=piece.then)
        elif isinstance(piece, declared.Control):
            for value in values_of(piece):
                yield partial(give, name=name, then=piece.then, value=value)
    if kind.advance is base.advance and kind.frame is not base.frame:
        yield lambda tab: tab._frame(1e3)  # the end of what is replayed


def give(tab, name, then, value):
    """Give a widget a value."""
    tab.sets(name, then)(value)


def drag(tab, name, then):
    """Drag a handle by some centimetres."""
    T = np.array(getattr(tab, name).T)
    T[:3, 3] += [0.02, 0.05, -0.05]
    getattr(tab, then)(T)


PICTURES = 8  # of a loop that is played
BOTH = [
    (*tab, name)
    for tab, names in SHOWN.items()
    for name in names.split()
    if tab != (7, "Pick") or name not in SHOWN[7, "Plan"]  # a pick takes a second
]


def negative(value):
    """Return an answer with the sign of every number in it changed."""
    if isinstance(value, (tuple, list)):
        return type(value)(map(negative, value))
    return value if isinstance(value, (bool, str)) or value is None else -value


def negative_in_half(value, axis):
    """Return an answer with the sign of the first half of each array changed."""
    if isinstance(value, (tuple, list)):
        return type(value)(negative_in_half(one, axis) for one in value)
    if not isinstance(value, np.ndarray) or not value.ndim:
        return value
    half = np.arange(value.shape[axis]) < (value.shape[axis] + 1) // 2
    sign = np.where(half, -1, 1)
    return value * (sign[:, None] if axis == 0 and value.ndim > 1 else sign)


# Some answers mean the same with another sign in all of them: a covariance's factor,
# torques of limits that are equal to both sides. One of these is no such symmetry.
SIGNS = (
    negative, lambda value: negative_in_half(value, 0),
    lambda value: negative_in_half(value, -1),
)  # fmt: skip


@cache
def lab(number):
    """Return a day's complete lab, as {name: function}."""
    return vars(load_script(find_day(number).source))


def looked(number, title, functions, used=True, enough=lambda desk: False):
    """Return a tab of who wrote these functions, played, and used as a person does.

    `desk.stages` says how long its log was after each use; it ends once it is enough.
    """
    desk = Desk(number, tabs()[number, title], functions)
    desk.begin()
    desk.play(PICTURES)
    desk.opened = set(desk.asked)
    desk.stages = [len(desk.log)]
    for action in uses(number, title) if used else ():
        if enough(desk):
            break
        action(desk.tab)
        desk.settle()
        desk.play(PICTURES)
        desk.stages.append(len(desk.log))
    return desk


def turned(number, *functions, sign=negative):
    """Return functions of a day with a sign put in, {name: function}."""

    def of(name):
        return lambda *given: sign(lab(number)[name](*given))

    return {name: of(name) for name in functions}


def standing(desk):
    """Return what one sees at the end, {what was set: its value}."""
    now = dict(desk.log)
    hidden = tuple(
        name.removesuffix("visible").removesuffix("ball.")
        for name, value in now.items()
        if name.endswith(".visible") and not value
    )
    return {name: one for name, one in now.items() if not name.startswith(hidden)}


@cache
def right(number, title):
    """Return the tab of who has everything right."""
    return looked(number, title, lab(number))


def test_the_table_has_every_tab_that_a_day_brings():
    brought = {
        (number, tab.title)
        for number in day_numbers()
        for tab in day_tabs(find_day(number)).tabs
        if tab is not Joints
    }
    assert set(SHOWN) == brought


@pytest.mark.parametrize(("number", "title"), SHOWN)
def test_a_tab_asks_the_student_for_what_it_shows_and_finds_it_right(number, title):
    desk = right(number, title)
    tasks = {name for task in find_day(number).tasks for name in task.functions}
    assert desk.asked & tasks == set(SHOWN[number, title].split())
    says, kind = desk.whose
    assert (kind, desk.problem) == ("good", None), says
    assert "r47-bad" not in str(desk.log)


@pytest.mark.parametrize(("number", "title", "function"), BOTH)
def test_a_sign_in_a_function_changes_what_the_tab_shows(number, title, function):
    model = right(number, title)

    def seen(desk):
        k = len(desk.stages) - 1
        differs = not same(desk.log, model.log[: model.stages[k]])
        says, kind = desk.whose
        named = f"{function} by" in says or f"{function} (another" in says
        free = function in says.partition("at work: ")[2]  # the tab itself tells
        return differs and ((kind == "bad" and named) or free)

    for sign in SIGNS:
        wrong = {**lab(number), **turned(number, function, sign=sign)}
        desk = looked(number, title, wrong, enough=seen)
        if seen(desk):
            break
    assert seen(desk), desk.whose
    assert "r47-bad" in desk.page._whose.content or not desk.problem


def test_the_same_functions_show_the_same():
    for number, title in ((1, "Order"), (4, "Forces"), (9, "Feel"), (12, "Way")):
        again = looked(number, title, lab(number))
        assert same(again.log, right(number, title).log)


def test_a_pick_ends_with_how_far_off_the_cube_stands():
    shown = right(7, "Pick").seen
    assert "placed 0.9 mm from its target" in shown
    assert "carry" in str(right(7, "Pick").tab.done.phases)


def stops(*given):
    """Stop as a typing mistake does."""
    raise ZeroDivisionError


def no_number(*given):
    """Return what is no number."""
    return np.full(3, np.nan)


@pytest.mark.parametrize(
    ("number", "title"), [tab for tab in SHOWN if tab[1] != "Pick"]
)
def test_a_tab_without_answers_shows_no_green(number, title):
    desk = looked(number, title, lab(number), used=False)
    names = SHOWN[number, title].split()
    wrong = stops if number % 2 else no_number
    before = {**lab(number), **turned(number, *names)}
    other = looked(number, title, before, used=False)
    for one in (desk, other):
        one.save({**lab(number), **dict.fromkeys(names, wrong)})
        one.play(2)
    ends = standing(desk), standing(other)
    for name in set(ends[0]) & set(ends[1]):  # nothing is left of who was there before
        assert same(ends[0][name], ends[1][name]), name
    assert isinstance(desk.problem, NoAnswerError)
    assert "r47-good" not in desk.seen
    assert desk.whose[1] == "bad"
    desk.asked.clear()
    desk.save(lab(number))
    desk.play(PICTURES)
    assert desk.asked >= desk.opened  # a save has all asked again that opening asks
    assert desk.problem is None
    assert desk.whose[1] == "good"
    assert "r47-bad" not in desk.seen


@pytest.mark.parametrize(("number", "title"), SHOWN)
def test_what_is_not_written_yet_is_the_librarys_and_not_green(number, title):
    desk = looked(number, title, {}, used=False)
    says, kind = desk.whose
    assert (kind, desk.problem) == ("quiet", None)
    assert "the library's" in says
    assert "r47-good" not in desk.seen


def test_no_green_stands_while_a_first_answer_has_still_to_come():
    desk = looked(6, "Touch", lab(6), used=False)
    whose = desk.page._whose
    assert "r47-good" in whose.content
    desk.page.asking()
    desk.loops[0].due = True  # its first torques are being asked
    desk.page._ended(None)  # the job has what the hand weighs
    assert "r47-asking" in whose.content
    desk.loops[0].due = False
    desk.page._ended(None)
    assert "r47-good" in whose.content


@pytest.mark.parametrize("number", [1, 2])
def test_a_sign_in_the_chain_changes_the_tab_joints(number):
    arm = Arm(panda.load(), panda.END_FRAME["panda_nohand"])
    ghost = day_tabs(find_day(number)).ghost
    asked = [
        [list(one.pairs) if isinstance(one, Path) else one for one in given]
        for given in ghost.questions(arm.model, arm.q)
    ]
    shown = []
    for sign in (1, -1):
        poses = {
            name: sign * lab(number)[ghost.function](*args)
            for name, args in zip(ghost.frames, asked, strict=True)
        }
        seen = compare(ghost, poses, "", arm.poses_at(arm.q))
        shown.append((seen.sentence, words.proof(arm, "ee", seen, True)))
    (right, proof), (wrong, proof_wrong) = shown
    assert "agrees" in right
    assert "off by" in wrong
    assert proof != proof_wrong
    assert "r47-good" not in proof_wrong
