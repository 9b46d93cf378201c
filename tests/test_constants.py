"""Each constant by two: what moves otherwise than a list says is told by name."""

import re
import shutil
from functools import partial
from types import SimpleNamespace

import pytest

from conftest import ROOT, SKIPPED, kit_folders, run_copy
from labkit.base.text import blocks
from labkit.lesson.constants import (
    TABLE_OF,
    Numbers,
    between,
    faults,
    numbers_of,
    same,
    table,
    times,
)
from labkit.lesson.day import all_days
from robo47.errors import Robo47Error

WORDS = {"wait": "it waits {} s", "noise": "a noise of {} N m", "law": "by {}"}


def listed(form="{:.1f} g", **effects):
    """Return what is measured of a number: 400, and 500 times wait times noise."""
    numbers = Numbers(**WORDS)

    def grams(wait=2.0, noise=0.1, law="Euler"):
        return (400.0 + 500.0 * wait * noise) * (-1.0 if law == "RK4" else 1.0)

    all_of_them = {
        "wait": times(1.2, "it creeps", within=0.001),
        "noise": times(1.2, "it is read once", within=0.001),
        "law": same("nothing moves", to="Verlet"),
    }
    numbers.add("what it weighs", form, **all_of_them | effects)(grams)
    return list(numbers.measured())


def test_a_table_says_what_was_turned_what_came_of_it_and_why():
    assert table(listed()).splitlines()[2:] == [
        "| what it weighs: **500.0 g** | it waits 2 → 4 s "
        "| 600.0 g, × 1.2 | it creeps |",
        "|  | a noise of 0.1 → 0.2 N m | 600.0 g, × 1.2 | it is read once |",
        "|  | by Euler → Verlet | the same | nothing moves |",
    ]
    assert list(faults(listed())) == []


@pytest.mark.parametrize(
    ("effects", "says"),
    [
        ({"wait": same("it rests")}, "it stays, since it rests"),
        ({"noise": times(2.0, "it is all noise")}, "× 2, since it is all noise"),
        ({"wait": between(1.5, 2.0, "longer")}, "× 1.5 to × 2, since longer"),
        ({"law": between(1.1, 2.0, "worse", to="RK4")}, "× 1.1 to × 2, since worse"),
        ({"law": times(-2.0, "turned", to="RK4")}, "× -2, since turned"),
    ],
)
def test_what_moves_otherwise_than_the_list_says_is_told_by_name(effects, says):
    (told,) = faults(listed(**effects))
    assert told.startswith("'what it weighs' is 500.0 g, and ")
    assert told.endswith(f"the list says {says}")


@pytest.mark.parametrize(
    "effect", [times(-1.0, "turned", to="RK4"), between(-2, -0.5, "turned", to="RK4")]
)
def test_a_number_may_turn_its_sign(effect):
    assert list(faults(listed(law=effect))) == []


def test_a_number_that_is_0_is_no_multiple_of_itself():
    numbers = Numbers(wait="it waits {} s")
    numbers.add("off", "{:.1f} mm", wait=times(2.0, "so"))(lambda wait=1.0: 0.0)
    (told,) = faults(numbers.measured())
    assert "is 0.0 mm, and 0.0 mm with it waits 1 → 2 s; the list says × 2" in told


def test_a_constant_that_the_function_takes_and_nobody_explains_is_refused():
    numbers = Numbers(**WORDS)
    with pytest.raises(Robo47Error, match="no effect of noise"):
        numbers.add("it", "{}", wait=same("so"))(lambda wait=1.0, noise=2.0: 1.0)
    with pytest.raises(Robo47Error, match="no words of reach"):
        numbers.add("it", "{}", reach=same("so"))(lambda reach=1.0: 1.0)
    with pytest.raises(Robo47Error, match="nothing of it is called noise"):
        numbers.add("it", "{}", wait=same(""), noise=same(""))(lambda wait=1.0: 1.0)


def test_a_constant_in_capitals_is_changed_in_the_modules_that_share_it():
    """A tuple is multiplied; an equal name of another module is another constant."""
    lab = SimpleNamespace(KP=100.0, ELBOW=(10.0, 4.0), DT=0.5)
    mujoco_part = SimpleNamespace(KP=lab.KP, DT=0.25)
    numbers = Numbers(lab, mujoco_part, KP="KP: {}", ELBOW="ELBOW: × {}", DT="DT: {}")
    numbers.add("sum", "{:.2f}",
        KP=times(2.0, "both terms double", within=0.01), ELBOW=same("it is not used"),
        DT=same("the lab's is not used"),
    )(lambda: lab.KP + mujoco_part.KP + mujoco_part.DT)  # fmt: skip
    numbers.add("elbow", "{:.0f}", ELBOW=times(2.0, "so"))(lambda: sum(lab.ELBOW))
    assert list(faults(numbers.measured())) == []
    assert "| elbow: **14** | ELBOW: × 1 → 2 | 28, × 2 |" in table(numbers.measured())
    assert (lab.KP, lab.ELBOW, lab.DT) == (100.0, (10.0, 4.0), 0.5)


def test_a_cached_helper_is_computed_once_for_each_change():
    lab, calls = SimpleNamespace(KP=100.0, KD=10.0), []
    numbers = Numbers(lab, KP="KP: {}", KD="KD: {}")

    @numbers.cached
    def run(factor):
        calls.append(lab.KP)
        return factor * lab.KP

    for name in ("first", "second"):
        numbers.add(name, "{}", KP=times(2.0, "so"), KD=same("so"))(lambda: run(3.0))
    assert list(faults(numbers.measured())) == []
    assert calls == [100.0, 200.0, 100.0]


def test_what_nothing_moves_and_what_is_rounding_are_said_so():
    numbers = Numbers(wait="it waits {} s")
    numbers.add("legs", "{:.0f}", wait=same("it has four"))(lambda wait=1.0: 4)
    numbers.add("off", "{:.0e}", wait=same("by hand"))(lambda wait=1.0: wait * 1e-15)
    text = table(numbers.measured())
    assert (
        "| legs: **4** (depends on none of these) | it waits 1 → 2 s | the same" in text
    )
    assert "| off: **rounding** (depends on none of these) |" in text
    drawn = between(0.5, 2.0, "another draw", to=48.0)
    numbers = Numbers(wait="seed {}")
    numbers.add("mean", "{:.0f}", wait=drawn)(lambda wait=47.0: wait)
    assert "| mean: **47** | seed 47 → 48 | 48 |" in table(numbers.measured())


@pytest.mark.parametrize("day", all_days(), ids=lambda day: f"day{day.number}")
def test_every_day_has_a_list_and_its_guide_shows_it(day):
    numbers = numbers_of(day)
    guide = (day.folder / day.guide).read_text("utf-8")
    assert f"<!-- run: {TABLE_OF.format(day.number)} -->" in guide
    shown = [block for block in blocks(guide, "run") if block.startswith("| number |")]
    assert len(shown) == 1
    for number in numbers.all:
        assert f"| {number.name}: **".replace("|", r"\|")[1:] in shown[0]
    assert re.search(r"<summary>(The table|Sensitivity of each.+)</summary>", guide)


@pytest.fixture(scope="module")
def kit(tmp_path_factory):
    """Return a copy of the kit with the toy day in it."""
    copy = tmp_path_factory.mktemp("kit") / "clone"
    for name in (*kit_folders(), "tests"):
        shutil.copytree(ROOT / name, copy / name, ignore=SKIPPED, dirs_exist_ok=True)
    shutil.copytree(ROOT / "tests" / "toyday" / "w9-toy", copy / "w9-toy")
    shutil.copy(ROOT / "README.md", copy / "README.md")
    return copy


@pytest.fixture
def run(kit):
    return partial(run_copy, kit)


@pytest.mark.kit
def test_the_toys_table_is_inserted_as_a_table_and_then_held(kit, run):
    assert run("scripts/build_docs.py", "--day", "46").returncode == 0
    guide = (kit / "w9-toy" / "docs" / "day46-lab.md").read_text("utf-8")
    lines = blocks(guide, "run")[0].splitlines()
    assert lines[:2] == ["| number | constant | then | why |", "|---|---|---|---|"]
    assert "the factors stand in the order ab → ba | -2.0 m^2, × -1 |" in guide
    held = run("scripts/build_docs.py", "--day", "46", "--check")
    assert held.returncode == 0, held.stdout
    assert run("scripts/constants.py", "46", "--check").stdout == ""


@pytest.mark.kit
@pytest.mark.parametrize(
    ("file", "old", "new", "says"),
    [
        ("day46/constants.py", "times(4.0, ", "times(2.0, ", "the list says × 2"),
        ("src/day46_toy.py", "np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)",
         "b[1] * np.pi / 4",
         "second vector's y is 2 → 4; the list says it stays"),
        ("docs/day46-lab.md", "is 1.5708 rad", "is 1.57 rad", "does not print it"),
    ],
)  # fmt: skip
def test_what_is_no_longer_so_is_told(kit, run, file, old, new, says):
    path = kit / "w9-toy" / file
    before = path.read_text("utf-8")
    assert old in before
    path.write_text(before.replace(old, new), "utf-8")
    done = run("scripts/constants.py", "46", "--check")
    path.write_text(before, "utf-8")
    assert done.returncode == 1
    assert says in done.stdout
    assert done.stdout.startswith("Day 46: '")
