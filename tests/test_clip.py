"""Clips: soft moves, an arm of one's own in red, small enough for a page."""

import numpy as np
import pytest
from PIL import Image

from labkit.figures import client, clip
from labkit.figures.portrait import link_frames, with_fingers
from labkit.lesson.day import find_day
from robo47 import panda, se3
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit


def noise(count, size=(200, 160)):
    rng = np.random.default_rng(0)
    return [
        Image.fromarray(rng.integers(0, 255, (*size[::-1], 3), dtype=np.uint8))
        for _ in range(count)
    ]


def test_a_move_there_and_back_starts_where_it_ends_and_never_jumps():
    qs = clip.there_and_back(np.zeros(7), np.ones(7), 40)
    np.testing.assert_array_equal(qs[0], 0)
    np.testing.assert_allclose(qs[20], 1)
    steps = np.abs(np.diff(np.vstack([qs, qs[:1]]), axis=0))
    assert steps.max() < 0.08


@pytest.mark.parametrize("ending", ["gif", "webp"])
def test_a_clip_repeats_for_ever_and_has_all_its_frames(tmp_path, ending):
    path = tmp_path / f"arm.{ending}"
    size = clip.save_clip(noise(5), path, seconds=1.0)
    assert path.stat().st_size == size
    with Image.open(path) as made:
        assert made.n_frames == 5
        assert made.info["loop"] == 0


def test_a_clip_that_is_too_large_becomes_smaller_until_it_fits(tmp_path):
    path = tmp_path / "arm.gif"
    assert clip.save_clip(noise(4), path, largest=30_000) <= 30_000
    with Image.open(path) as made:
        assert made.size[0] < 200


def test_another_ending_is_refused(tmp_path):
    with pytest.raises(Robo47Error, match=r"arm\.mp4: a clip ends in \.gif or \.webp"):
        clip.save_clip(noise(1), tmp_path / "arm.mp4")


def test_another_arm_is_put_where_its_links_are_and_the_words_below(monkeypatch):
    scenes = []

    def draw(scene):
        scenes.append(scene)
        return np.zeros((*scene.size[::-1], 3), dtype=np.uint8)

    monkeypatch.setattr(client, "draw", draw)
    q = panda.READY_Q
    true = link_frames(with_fingers(q))
    wrong = {
        "link3": true["link3"] @ se3.make_T(se3.Rz(0.2), [0, 0, 0.1]),
        "ee": np.eye(4),
    }
    (picture,) = clip.drawn([(clip.arm_scene(q, wrong), ("off", False))])
    (ghost,) = scenes[0].ghosts  # there is no link `ee` to draw
    np.testing.assert_allclose(
        ghost.T_world_moved @ true["link3"], wrong["link3"], atol=1e-14
    )
    assert ghost.alone
    assert ghost.wrong
    assert picture.size[1] > clip.SIZE[1]
    assert np.asarray(picture)[clip.SIZE[1] :].min() < 200  # something is written


@pytest.mark.gl
def test_a_red_arm_is_really_drawn(gl):
    q = panda.READY_Q
    true = link_frames(with_fingers(q))
    aside = se3.make_T(np.eye(3), [0.0, 0.4, 0.0])
    moved = {f"link{i}": aside @ true[f"link{i}"] for i in range(8)}
    with_ghost, without = (
        np.asarray(
            clip.drawn([(clip.arm_scene(q, some), ("both", None))])[0], dtype=int
        )
        for some in (moved, {})
    )
    red = with_ghost[..., 0] - with_ghost[..., 1:].max(axis=-1) > 60
    assert red.sum() > 1000
    assert not (without[..., 0] - without[..., 1:].max(axis=-1) > 60).any()


def test_a_picks_clip_names_its_phases_and_a_small_cube_keeps_its_colour(tmp_path):
    from robo47 import capstone

    film = capstone.film(capstone.pick(capstone.library(), rate=50.0))
    rows = [int(np.searchsorted(film.t, t)) for t in (0.0, film.t[-1])]
    assert [clip.phase(film, row)[0] for row in rows] == [
        "reach, 0.0 s",
        f"rest, {film.t[-1]:.1f} s",
    ]
    grey = np.full((200, 300, 3), 128, dtype=np.uint8)
    grey[:, :, 1] = np.linspace(100, 160, 300)
    grey[90:96, 90:96] = 220, 90, 20
    path = tmp_path / "cube.gif"
    clip.save_clip([Image.fromarray(grey)] * 3, path)
    with Image.open(path) as made:
        red, _, blue = made.convert("RGB").getpixel((93, 93))
    assert red > 180
    assert blue < 60


@pytest.fixture
def editor():
    return find_day(1).module("editor")


def said(editor, *sentence):
    arm = Image.new("RGB", [editor.SHARP * n for n in editor.ARM])
    code = ("def f(q):", "    return -q")
    says = ("1.5 f WRONG", *sentence) if sentence else ()
    return editor.Page(code, arm, "make check TASK=1.5", says, mark="-q", cursor=12)


@pytest.mark.parametrize("name", ["WIDE", "TALL"])
def test_what_the_checker_says_in_a_clip_is_shown_whole_or_refused(editor, name):
    layout = getattr(editor, name)
    nothing = np.asarray(editor.draw(said(editor), layout)).astype(int)
    sentence = "It turns the wrong way. " * 8
    shown = np.asarray(editor.draw(said(editor, sentence), layout)).astype(int)
    changed = np.argwhere(np.abs(shown - nothing).max(axis=2) > 100)
    edge = editor.SHARP * editor.ARM[0]
    assert changed[:, 0].max() < shown.shape[0] - 10
    assert changed[:, 1].max() < edge - 10
    with pytest.raises(ValueError, match="are cut"):
        editor.draw(said(editor, sentence * 3), layout)


def test_frames_of_a_clip_are_seen_for_their_own_times_or_it_is_refused(tmp_path):
    frames = [
        clip.Frame(p, s, words)
        for p, s, words in zip(noise(2), (0.1, 2.0), ("", "A `b` is 2 Ω."), strict=True)
    ]
    says = clip.save_frames(frames, tmp_path / "a.webp")
    assert "200 x 160, 2.1 s" in says
    assert clip.words_of(tmp_path / "a.webp") == ("A `b` is 2 Ω.",)
    with Image.open(tmp_path / "a.webp") as made:
        made.load()
        assert made.n_frames == 2
    with pytest.raises(Robo47Error, match="over 1,000"):
        clip.save_frames(frames, tmp_path / "b.webp", largest=1000)


def times(clip):
    """Return how long each frame of an open clip is seen, in seconds."""
    for i in range(clip.n_frames):
        clip.seek(i)
        clip.load()
        yield clip.info["duration"] / 1000


def test_the_clip_of_a_mistake_is_the_labs_own_arm_and_the_checkers_own_words(
    editor, monkeypatch
):
    day = find_day(1)
    day.offered("clips")  # makes the lab importable
    clips = day.module("clips")
    true = link_frames(with_fingers(clips.Q))
    for name, T in clips.links(1.0).items():
        np.testing.assert_allclose(T, true[name], atol=1e-12)
    mirrored = link_frames(with_fingers(-clips.Q))
    for name, T in clips.links(-1.0).items():
        np.testing.assert_allclose(T, mirrored[name], atol=1e-12)
    assert clips.told(clips.RIGHT) == ("1.5 link_T, joint_T passed",)
    told = clips.told(clips.WRONG)
    assert "gives the same output as your code" in told[-1]
    arm = Image.new("RGB", [editor.SHARP * n for n in editor.ARM])
    monkeypatch.setattr(clips, "arm", lambda sign: arm)
    for layout in (editor.WIDE, editor.TALL):
        editor.draw(clips.page(clips.WRONG, -1.0, told), layout)  # no line is cut
    for name in day.offered("clips"):
        path = day.folder / "figures" / f"{name}.webp"
        assert path.stat().st_size < clip.LARGEST
        assert clip.words_of(path) == told[1:], "draw it again: make figures --clips"
        with Image.open(path) as made:
            assert made.n_frames > 30
            assert max(times(made)) >= clips.READ >= 6.0
