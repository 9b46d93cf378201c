"""The pictures of the lessons: committed, drawn again, and the command for it."""

import os
import re
import sys

import numpy as np
import pytest
from pictures import count, differing

from conftest import ROOT
from robo47 import panda
from robo47.errors import Robo47Error

if not os.environ.get("ROBO47_CI"):
    pytest.importorskip("PIL", reason="needs Pillow: make figures")
    pytest.importorskip("matplotlib", reason="needs matplotlib: make figures")
from PIL import Image

from labkit.commands import figures as command
from labkit.figures import cards, client, overlay, portrait, sheet
from labkit.figures.lessons import lesson_figures
from labkit.lesson.day import Day, all_days, find_day

pytestmark = pytest.mark.kit

FOLDER = ROOT / "w1-foundations" / "figures"
SIZES = {"reference": (1200, 800), "order": (1600, 810), "fk_error": (1200, 1050)}


@pytest.fixture(scope="module", autouse=True)
def ended():
    """End the process that draws."""
    yield
    client.close()


@pytest.mark.parametrize("name", SIZES)
def test_the_committed_pictures_are_there(name):
    path = FOLDER / f"day1_{name}.png"
    picture = Image.open(path).convert("RGB")
    assert picture.size == SIZES[name]
    assert path.stat().st_size < 300_000
    if name != "fk_error":
        assert all(
            count(picture, colour) > 500 for colour in (overlay.X, overlay.Y, overlay.Z)
        )


@pytest.mark.parametrize("day", all_days(), ids="day{0.number}".format)
def test_a_days_small_picture_is_dark_and_its_number_stands_in_the_days_line(day):
    lesson_figures(day.number)  # makes the lab importable
    _, number = day.module("figures").SMALL
    assert number in day.see
    path = day.folder / "figures" / f"day{day.number}_small.png"
    kept = Image.open(path).convert("RGB")
    assert kept.size == cards.TINY
    assert 10 < np.median(np.asarray(kept)) < 60
    assert np.asarray(kept).std() > 15  # and shows something


@pytest.mark.parametrize("day", all_days(), ids="day{0.number}".format)
def test_a_film_has_a_still_picture_in_the_guide_that_is_no_copy_to_hand_in(day):
    pytest.importorskip("viser", reason="needs viser: make view")
    films, pictures = day.offered("films"), lesson_figures(day.number)
    guide = (day.folder / day.guide).read_text("utf-8")
    for name in films:
        assert name in pictures
        path = day.folder / "figures" / f"{name}.png"
        assert f"](../figures/{name}.png)" in guide
        assert f"figures/{name}.png" in day.kit_figures
        assert path.stat().st_size < 100_000


NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
TOLD = {8: "floats", 9: "pushed", 11: "strobe", 12: "hand", 13: "circles"}


@pytest.mark.meshes
@pytest.mark.usefixtures("real_panda")
@pytest.mark.parametrize("number", TOLD)
def test_the_numbers_that_a_guide_tells_of_a_picture_are_those_on_it(
    number, monkeypatch
):
    day = find_day(number)
    name = f"day{number}_{TOLD[number]}"
    draw = lesson_figures(number)[name]
    words = []
    monkeypatch.setattr(client, "draw", lambda scene: np.zeros((9, 9, 3), np.uint8))
    monkeypatch.setattr(sheet, "side_by_side", lambda *panels: words.extend(panels))
    draw()
    told = {x for _, *texts in words for x in NUMBER.findall(" ".join(texts))}
    guide = (day.folder / day.guide).read_text("utf-8")
    says = re.search(rf"!\[([^\]]*)\]\(../figures/{name}\.png\)", guide)[1]
    assert NUMBER.findall(says)
    assert set(NUMBER.findall(says)) <= told


def test_a_long_number_on_a_small_picture_is_not_cut():
    black = Image.new("RGB", cards.SIZE)
    for number in ("7", "39 of 60", "12,345 of 67,890"):
        drawn = np.asarray(cards.card(black, number))
        edges = (drawn[:, -2:], drawn[:, :2], drawn[-2:], drawn[:2])
        assert max(edge.max() for edge in edges) < 90
        assert drawn.max() > 200


@pytest.mark.gl
@pytest.mark.meshes
@pytest.mark.usefixtures("gl", "real_panda")
def test_the_committed_pictures_can_be_drawn_again(monkeypatch, tmp_path):
    names = [*(f"day1_{name}" for name in SIZES), "day1_small"]
    monkeypatch.setattr(sys, "argv", ["", *names, "--out", str(tmp_path)])
    assert command.main() == 0
    for name, size in SIZES.items():
        fresh = Image.open(tmp_path / f"day1_{name}.png").convert("RGB")
        kept = Image.open(FOLDER / f"day1_{name}.png").convert("RGB")
        assert fresh.size == size
        # Drivers and fonts round differently; another arm or label would not.
        assert differing(fresh, kept) < 0.02
    fresh, kept = (Image.open(p / "day1_small.png") for p in (tmp_path, FOLDER))
    assert differing(fresh.convert("RGB"), kept.convert("RGB")) < 0.02


@pytest.mark.gl
@pytest.mark.meshes
@pytest.mark.usefixtures("gl", "real_panda")
def test_words_over_an_arm_stand_where_the_committed_pictures_have_them(
    monkeypatch, tmp_path
):
    names = ["day2_screws", "day2_dh_roulette"]
    monkeypatch.setattr(sys, "argv", ["", *names, "--out", str(tmp_path)])
    assert command.main() == 0
    for name in names:
        fresh = Image.open(tmp_path / f"{name}.png").convert("RGB")
        kept = Image.open(FOLDER / f"{name}.png").convert("RGB")
        assert differing(fresh, kept) < 0.02


@pytest.mark.gl
@pytest.mark.usefixtures("gl")
def test_the_pictures_of_the_order_show_the_labs_numbers(monkeypatch, capsys):
    draw = lesson_figures(1)["day1_order"]
    from day1_transforms import READY_Q, compose_fk, main

    seen = {}

    def note(scene, frames):
        seen.update(frames)
        return Image.new("RGB", scene.size)

    monkeypatch.setattr(portrait, "draw", note)
    draw()
    monkeypatch.setattr(sys, "argv", ["day1_transforms.py", "--no-log"])
    assert main() == 0
    lab = capsys.readouterr().out
    T_world_ee = compose_fk(panda.load("panda_nohand"), READY_Q)
    np.testing.assert_allclose(seen["T_world_ee"], T_world_ee)
    for name in ("T_world_ee @ T_extra", "T_extra @ T_world_ee"):
        printed = lab.split(f"  {name}: ")[1].split("\n")[1].split()
        np.testing.assert_allclose(seen[name][:3, 3], np.float64(printed), atol=1e-6)


@pytest.mark.parametrize("choice", ["nonsense", "disable"])
def test_without_a_backend_the_command_says_so_in_one_line(run, choice):
    done = run("scripts/make_figures.py", MUJOCO_GL=choice)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert f"MUJOCO_GL={choice}" in done.stderr


@pytest.mark.gl
@pytest.mark.usefixtures("gl")
@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("mona_lisa", "day 1 has: day1_reference, day1_order, day1_fk_error"),
        ("day1_reference", "choose a folder with --out"),
    ],
)
def test_another_name_or_a_folder_that_cannot_be_written_to_is_told(
    monkeypatch, tmp_path, name, says
):
    (tmp_path / "file").write_text("")
    monkeypatch.setattr(portrait, "draw", lambda scene, _: Image.new("RGB", scene.size))
    out = str(tmp_path / "file")
    monkeypatch.setattr(sys, "argv", ["", name, "--day", "1", "--out", out])
    with pytest.raises(Robo47Error, match=says):
        command.main()


def test_a_day_without_pictures_has_none(monkeypatch):
    monkeypatch.setattr(Day, "has", lambda day, name: False)
    assert lesson_figures(1) == {}
