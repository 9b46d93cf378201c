"""Every tab shows the student's own: a sign in a function changes what one sees.

`SHOWN` is the table: which functions of the day's tasks stand behind what a tab shows.
The line that says in words how they compare with the library's does not count here.
"""

import sys
from functools import cache
from unittest.mock import patch

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra view")

from tabs_on_paper import Desk, Paper, same

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

OLD = {
    (1, "Chain"): "link_T joint_T",
    (1, "Order"): "make_T Rz translations_both_orders",
    (2, "Screws"): "joint_screws exp_screw fk_space dh_link dh_fk",
    (3, "Jacobian"): "space_jacobian site_jacobian manipulability "
    "nullspace_projection solve_ik",
    (3, "Circle"): "pose_error dls_step",
    (4, "Forces"): "link_inertias mass_matrix gravity_torque",
    (5, "Control"): "pd_torque pd_gains error_response gravity_pd "
    "computed_torque pid_step saturate max_stable_omega",
    (6, "Touch"): "task_inertia nullspace_torque impedance_wrench critical_damping "
    "impedance_torque",
    (7, "Plan"): "quintic_duration joint_trajectory trapezoidal_profile",
    (7, "Pick"): "quintic_scaling quintic_duration joint_trajectory "
    "interpolate_pose grasp_pose "
    "combine_bodies max_cube_mass",
    (12, "Way"): "extend rrt_connect shortcut "
    "wilson_interval path_dynamics time_optimal_profile",
    (14, "Touch"): "cone_margin grip_reflex_step cone_edges observe act reward "
    "cem_step success_rate",
}
LAWS = ("with an integral (PID)", "gains outside M", "PD and gravity", "PD")
# What a person does in a tab, where it does not play all by itself.
DONE = {
    (1, "Chain"): [lambda tab: tab.press("next")] * 13,
    (2, "Screws"): [lambda tab: tab.spin(True)],
    (3, "Jacobian"): [
        lambda tab: tab.swing(0.1), lambda tab: tab.drag(True),
        lambda tab: tab.follow(tab.target.T),
    ],
    (5, "Control"): [
        lambda tab, law=law: (tab.choose(law), tab.press("0.1 rad off"))
        for law in LAWS
    ],
    (7, "Plan"): [lambda tab: tab.sets("kind")("trapezoid")],
    (7, "Pick"): [lambda tab: tab.done and tab.replay(99.0)],
    (14, "Touch"): [
        lambda tab: tab.sets("feels")(True), lambda tab: tab.press("one generation"),
        lambda tab: tab.press("test 20 cubes"),
    ],
}  # fmt: skip


def tabs():
    """Return {(day, title): class} of all tabs that days bring."""
    return {
        (number, tab.title): tab
        for number in day_numbers()
        for tab in day_tabs(find_day(number)).tabs
        if tab is not Joints
    }


SHOWN = OLD | {
    name: " ".join(tab.functions) for name, tab in tabs().items() if name not in OLD
}


def uses(number, title):
    """Yield what a person does in a tab, one thing after the other."""
    kind = tabs()[number, title]
    if not issubclass(kind, declared.Declared):
        yield from DONE.get((number, title), ())
        return
    for name, piece in kind.declared().items():
        then = getattr(piece, "then", "")
        if isinstance(piece, declared.Handle):
            yield lambda tab, name=name, then=then: drag(tab, name, then)
        elif isinstance(piece, declared.Control):
            values = {
                "slider": lambda given: [given[1]], "choice": lambda given: given[1],
                "tick": lambda given: [True], "buttons": lambda given: given[0],
            }[piece.kind](piece.args)  # fmt: skip
            for value in values:
                yield lambda tab, value=value, name=name, then=then: tab.sets(
                    name, then
                )(value)


def drag(tab, name, then):
    """Drag a handle by some centimetres."""
    T = np.array(getattr(tab, name).T)
    T[:3, 3] += [0.02, 0.05, -0.05]
    getattr(tab, then)(T)


PICTURES = 8  # of a loop that is played
SIGNS = {  # where a sign in front of everything is no mistake
    "path_dynamics": lambda rows: rows * [[1], [1], [-1]],
    "extend": lambda found: (found[0], found[1] * [-1, 1], found[2]),
    "projection_jacobian": lambda J: J * [-1, -1, -1, 1, 1, 1],
}
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


@cache
def lab(number):
    """Return a day's complete lab, as {name: function}."""
    return vars(load_script(find_day(number).source))


def kind_of(number, title):
    """Return a tab of a day."""
    return tabs()[number, title]


def looked(number, title, functions, used=True):
    """Return a tab of who wrote these functions, played, and used as a person does."""
    kind = kind_of(number, title)
    module = sys.modules[kind.__module__]
    drawn = lambda page, *_: Paper(page.host.log, "robot")  # noqa: E731
    with (
        patch.object(module, "Robot", drawn, create=True),
        patch.object(declared, "Robot", drawn),
    ):
        desk = Desk(number, kind, functions)
    desk.begin()
    desk.play(PICTURES)
    desk.opened = set(desk.asked)
    for action in uses(number, title) if used else ():
        action(desk.tab)
        desk.settle()
        desk.play(PICTURES)
    return desk


def turned(number, *functions):
    """Return functions of a day with a sign put in, {name: function}."""

    def of(name):
        return lambda *given: SIGNS.get(name, negative)(lab(number)[name](*given))

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
    desk = looked(number, title, {**lab(number), **turned(number, function)})
    assert not same(desk.log, right(number, title).log)
    assert "r47-bad" in desk.page._whose.content or not desk.problem
    says, kind = desk.whose
    free = f"{function}" in says.partition("at work: ")[2]  # the tab itself tells
    named = f"{function} by" in says or f"{function} (another" in says
    assert (kind == "bad" and named) or free, says


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
    quick = set(names) - {"extend"}  # a wrong one grows its trees for seconds
    before = {**lab(number), **turned(number, *quick)}
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
    if issubclass(tabs()[number, title], declared.Declared):
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
