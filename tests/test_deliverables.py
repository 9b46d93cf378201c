"""What a day hands in: each item passes when it is done, and says what to do if not."""

import hashlib
import os
import re
import shutil
import struct
import subprocess
import time
import zlib
from dataclasses import replace

import numpy as np
import pytest

from conftest import write_week
from labkit import log as metrics
from labkit.commands.new import worksheet_of
from labkit.handin.deliverables import check_deliverables, item_names
from labkit.handin.figure import PORTRAIT, FlawError, check_figure, read_png
from labkit.handin.handin import Handin, read_handin
from labkit.handin.worksheet import check_worksheet, split_sections
from labkit.lesson.day import find_day

pytestmark = pytest.mark.kit

RNG = np.random.default_rng(47)
PICTURE = RNG.integers(0, 256, (300, 400, 3), np.uint8)
GUIDE = "A frame is an origin with three axes that are fixed to a body of the robot.\n"


def chunk(kind, data):
    """Return a part of a PNG."""
    body = kind + data
    return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))


def png(pixels):
    """Return a PNG of an array, (height, width, 3)."""
    height, width = pixels.shape[:2]
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    parts = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows))
    return b"\x89PNG\r\n\x1a\n" + parts + chunk(b"IEND", b"")


ANSWER = "Its own x, so on the right."


def worksheet(terms, *, drawings=3, definition=None, answer=ANSWER):
    own = "My own words say what {} means to me when the arm moves."
    lines = ["# Day 1", "## Glossary"]
    for term in terms:
        lines += [f"### {term}", (definition or own).format(term), ""]
    lines += ["## Drawings"]
    for i in range(drawings):
        lines += [f"### Drawing {i + 1}: a frame", "```", " z", " |", " +-- x", "```"]
    lines += ["## Can you explain?"]
    for i in range(1, 6):
        mine = f"{answer} ({i})" if answer == ANSWER else answer
        lines += [f"{i}. It moves along x. Whose x? Which side?", "", f"   {mine}"]
    return "\n".join(lines)


def fresh_clone(copy):
    """Write Day 1 alone, with nothing done in it: the rest takes seconds."""
    kit = find_day(1)
    week = copy / kit.folder.name
    for pattern in ("day1/day.toml", "src/*.py", "docs/day1*.md", "figures/day1*.png"):
        for path in kit.folder.glob(pattern):
            place = week / path.relative_to(kit.folder)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, place)
    write_week(week, 1)
    (copy / "metrics").mkdir()
    (copy / "metrics" / "metrics.csv").write_text(",".join(metrics.COLUMNS) + "\n")
    (week / kit.figure).unlink(missing_ok=True)
    (week / kit.worksheet).write_text(worksheet_of(kit), "utf-8")


@pytest.fixture(scope="module")
def handed_in(tmp_path_factory):
    """Return a clone in which everything of Day 1 is handed in, made once."""
    clone = tmp_path_factory.mktemp("handed-in")
    fresh_clone(clone)
    day = find_day(1, clone)
    week = day.folder
    (week / "figures").mkdir(exist_ok=True)
    (week / "work").mkdir()
    day.work.write_text("x = 1\n")
    (week / day.figure).write_bytes(png(PICTURE))
    (week / day.worksheet).write_text(worksheet(day.terms), "utf-8")
    (week / day.guide).write_text(GUIDE, "utf-8")
    log_again(day, clone, f"20,000 poses, file {file_hash(day.work)}")
    git(clone, "init", "-q", "--template=")
    commit(clone, "Day 1")
    return clone


@pytest.fixture
def clone(tmp_path, handed_in):
    """Return a copy of it."""
    return shutil.copytree(handed_in, tmp_path / "clone")


@pytest.fixture
def day(clone):
    """Day 1 of the copy."""
    return find_day(1, clone)


def file_hash(path):
    """Return what the lab adds to the notes of its rows; written out, as an oracle."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:8]


def git(clone, *command):
    who = ["-c", "user.name=A", "-c", "user.email=a@example.org"]
    subprocess.run(["git", "-C", str(clone), *who, *command], check=True)


def commit(clone, message):
    git(clone, "add", "-A")
    git(clone, "commit", "-qm", message)


def log_again(day, clone, notes, **more):
    """Empty the log and write the day's rows with these notes."""
    log = clone / "metrics" / "metrics.csv"
    log.write_text(",".join(metrics.COLUMNS) + "\n")
    for row in day.metrics:
        fields = {"check": row.check, "metric": row.metric, "value": 1e-15, **more}
        metrics.append_row(log, day=1, notes=notes, **fields)


@pytest.fixture
def items(day, clone):
    """Check again and return {name: item}."""
    return lambda: {item.name: item for item in check_deliverables(day, clone)}


@pytest.fixture(scope="module")
def sheet(handed_in):
    """Check a worksheet alone, and return {name: item}."""
    day = find_day(1, handed_in)

    def check(text):
        name = day.files["worksheet"]
        handin = Handin({name: text.encode()})
        return {item.name: item for item in check_worksheet(day, handin)}

    return check


TERMS = find_day(1).terms


def test_a_day_that_is_handed_in_passes_and_no_file_is_changed(items, clone):
    before = {p: p.read_bytes() for p in clone.rglob("*") if p.is_file()}
    names = ["figure", "definitions", "drawings", "metrics", "commit"]
    assert list(items()) == names
    assert all(item.passed and not item.message for item in items().values())
    assert before == {p: p.read_bytes() for p in clone.rglob("*") if p.is_file()}


def test_a_fresh_copy_has_everything_to_do(tmp_path):
    fresh_clone(tmp_path)
    found = check_deliverables(find_day(1, tmp_path), tmp_path)
    assert not any(item.passed for item in found)
    assert all(item.message for item in found)


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "no PNG"),
        (b"\xff\xd8\xff\xe0" + b"x" * 99, "JPEG under the name of a PNG"),
        (png(PICTURE)[:500], "cut off or damaged"),
        (png(PICTURE[:50]), "400x50 pixels; at least 320x240"),
        (png(PICTURE * 0), "black; call mj_forward"),
        (png(PICTURE * 0 + 200), "one colour"),
        (png(PICTURE)[:16] + b"\x7f" * 8 + png(PICTURE)[24:], "too many"),
    ],
)
def test_a_picture_that_is_none_is_told_why(items, day, data, says):
    (day.folder / day.figure).write_bytes(data)
    item = items()["figure"]
    assert item.status == "wrong"
    assert says in item.message


def test_the_kits_own_picture_does_not_count_even_saved_anew(items, day):
    (day.folder / day.kit_figures[0]).write_bytes(png(PICTURE))
    nearly = png(np.clip(PICTURE.astype(int) + 1, 0, 255).astype(np.uint8) // 2 * 2)
    assert nearly != png(PICTURE)
    (day.folder / day.figure).write_bytes(png(PICTURE))
    assert "make one of your own" in items()["figure"].message


def test_a_portrait_is_the_picture_of_the_first_day_alone(day, clone):
    data, text = png(PICTURE), chunk(b"tEXt", f"{PORTRAIT}\0ready".encode())
    (day.folder / day.figure).write_bytes(data[:33] + text + data[33:])
    handin = read_handin(day, clone)
    assert check_figure(day, handin).passed
    refused = check_figure(replace(day, draw="order"), handin)
    assert refused.status == "wrong"
    assert "make figures DAY=1" in refused.message


def test_the_picture_of_another_day_does_not_count(day, clone):
    other = find_day(1).folder / "figures" / "day1_reference.png"
    (day.folder / day.figure).write_bytes(other.read_bytes())
    handin, alone = read_handin(day, clone), replace(day, kit_figures=())
    assert "day1_reference.png of the kit" in check_figure(alone, handin).message


def test_a_png_reads_back_as_its_pixels():
    assert np.array_equal(read_png(png(PICTURE)), PICTURE)
    with pytest.raises(FlawError, match="no PNG"):
        read_png(b"GIF89a")


@pytest.mark.parametrize(
    ("definition", "says"),
    [
        ("", "Still empty: pose"),
        ("> say it in your own words, in one or two sentences please", "Still empty"),
        ("_(in your own words, and in a sentence or two of your own)_", "Still empty"),
        ("*(your words)*", "Still empty"),
        ("bla " * 9, "Write a whole sentence (at least 8 words): pose"),
        ("<!-- a sentence that explains what this is to a friend -->", "Still empty"),
        ("TODO write this when the lab is done and I know", "Still empty"),
        ("Where it is.", "Write a whole sentence (at least 8 words): pose"),
        (GUIDE, "Copied from the guide: pose"),
    ],
)
def test_a_definition_has_to_be_a_sentence_of_ones_own(sheet, definition, says):
    item = sheet(worksheet(TERMS, definition=definition or " "))["definitions"]
    assert not item.passed
    assert says in item.message


@pytest.mark.parametrize(
    "words",
    [
        "*where the hand is and how it is turned, all in one, {}*",
        "位姿是一个刚体的位置和姿态在同一个坐标系 {}",
    ],
)
def test_words_between_asterisks_or_without_spaces_are_words(sheet, words):
    assert sheet(worksheet(TERMS, definition=words))["definitions"].passed


def test_one_missing_definition_is_named(sheet):
    message = sheet(worksheet(TERMS[:-1]))["definitions"].message
    assert message.startswith("7 of 8")
    assert f"Still empty: {TERMS[-1]}." in message


@pytest.mark.parametrize(
    ("answer", "open_ones"),
    [(ANSWER, ""), ("*(your answer)*", "1, 2, 3, 4, 5"), ("Yes.", "1, 2, 3, 4, 5")],
)
def test_the_questions_want_an_answer_in_words(sheet, answer, open_ones):
    item = sheet(worksheet(TERMS, answer=answer))["definitions"]
    assert item.passed == (not open_ones)
    assert open_ones in item.message


PASTED = "The same sentence"
SENTENCE = "It depends on the frame in which one looks at it."  # eleven words


def table(*reasons):
    rows = [f"| number {i} | 1 | 2 | {why} |" for i, why in enumerate(reasons)]
    return "\n## Predictions\n" + "\n".join(rows)


@pytest.mark.parametrize(
    ("answer", "definition"),
    [
        (SENTENCE, None),
        ("I do not know yet.", None),  # five times, though it is short
        (ANSWER, SENTENCE),
        (SENTENCE.upper().replace(" ", "  "), SENTENCE),
    ],
)
def test_one_sentence_pasted_everywhere_is_not_a_worksheet(sheet, answer, definition):
    text = worksheet(TERMS, answer=answer, definition=definition)
    item = sheet(text)["definitions"]
    assert item.status == "wrong"
    assert item.message.startswith(PASTED)


@pytest.mark.parametrize(
    ("reasons", "passes"),
    [
        (["rounding"] * 3, True),  # short and true
        (["yes", "yes", "0"], True),
        (["I forgot the armature"] * 3, True),
        (["I left the armature of the motors out here"] * 2, True),
        (["I left the armature of the motors out here"] * 3, False),
        ([SENTENCE, "none", "none"], True),  # an answer may be a reason, too
    ],
)
def test_a_short_true_answer_may_stand_there_often(sheet, reasons, passes):
    text = worksheet(TERMS).replace(f"{ANSWER} (1)", SENTENCE) + table(*reasons)
    item = sheet(text)["definitions"]
    assert item.passed == passes, item.message


def test_two_answers_alike_are_pasted_where_they_are_long(sheet):
    text = worksheet(TERMS)
    for i in (1, 2):
        text = text.replace(f"{ANSWER} ({i})", SENTENCE)
    assert PASTED in sheet(text)["definitions"].message
    short = worksheet(TERMS)
    for i in (1, 2):
        short = short.replace(f"{ANSWER} ({i})", "On the right of it.")
    assert sheet(short)["definitions"].passed


@pytest.mark.parametrize("blank", ["\n\n   ", "\n   ", " "])
def test_an_answer_may_stand_anywhere_after_its_question(sheet, blank):
    text = worksheet(TERMS, answer="*(your answer)*")
    text = text.replace("Which side?", f"Which side?{blank}{ANSWER}", 2)
    says = "Can you explain? 3, 4, 5: answer below each question"
    assert says in sheet(text)["definitions"].message


@pytest.mark.parametrize(
    ("cells", "blank"),
    [
        ("*(your prediction)* | *(your number)* | *(your reason)*", "3 cells"),
        ("19 mm | | TODO", "2 cells"),
        ("19 mm | 20.1 | it also bends", None),
    ],
)
def test_a_prediction_that_nobody_made_is_asked_for(sheet, cells, blank):
    table = f"| number | predicted | measured | why |\n|---|---|\n| sag | {cells} |"
    item = sheet(f"{worksheet(TERMS)}\n## Predictions\n\n{table}\n")["definitions"]
    assert item.passed == (blank is None)
    assert f"Predictions: {blank} still to fill in" in item.message or item.passed


def test_all_open_parts_of_a_worksheet_are_listed_at_once(sheet):
    table = "| number | predicted |\n|---|---|\n| sag | TODO |"
    end = f"\n## Predictions\n\n{table}\n"
    open_answers = worksheet(TERMS, answer="*(your answer)*") + end
    item = sheet(open_answers)["definitions"]
    explain, cells, there = item.message.splitlines()
    assert explain.startswith("Can you explain? 1, 2, 3, 4, 5: answer below each")
    assert cells == "Predictions: 1 cell still to fill in."
    assert there == "All definitions are there."
    assert item.upcoming == 'answers to "Can you explain?"'
    empty = worksheet(TERMS, answer="*(your answer)*", definition=" ") + end
    item = sheet(empty)["definitions"]
    assert item.status == "todo"
    assert item.message.startswith("0 of 8")
    assert len(item.message.splitlines()) == 3
    assert not item.upcoming


@pytest.mark.parametrize(
    ("drawings", "third", "says"),
    [
        (2, "```\n z\n |\n```", "of 3 lines or more"),
        (2, "![x](day1.md)", "Drawing 3: its image file is not there"),
        (1, "", "Drawing 2, 3: add"),
        (0, "", "0 of 3"),
    ],
)
def test_a_drawing_of_too_few_lines_is_none(sheet, drawings, third, says):
    text = worksheet(TERMS, drawings=drawings)
    item = sheet(f"{text}\n### Drawing 3\n{third}\n")["drawings"]
    assert says in item.message
    assert item.status == ("wrong" if drawings else "todo")


@pytest.mark.parametrize(
    "address",
    [
        "sketch.jpg",
        "day1.md",
        "errata.md",
        "https://example.org/a.png",
        "data:image/png;base64,AAAA",
        "/etc/hostname.png",
        "../../../outside.png",
        "..\\..\\..\\outside.png",
        "C:/outside.png",
    ],
)
def test_a_drawing_may_be_a_picture_of_ones_own_that_is_there(
    items, day, clone, address
):
    path = day.folder / day.worksheet
    (clone.parent / "outside.png").write_bytes(b"png")
    (path.parent / "errata.md").write_text("text")
    text = worksheet(day.terms, drawings=2)
    path.write_text(f"{text}\n### Drawing 3\n![x]({address})\n", "utf-8")
    assert "Drawing 3: its image file is not there" in items()["drawings"].message
    (path.parent / "sketch.jpg").write_bytes(b"jpeg")
    assert items()["drawings"].passed == (address == "sketch.jpg")


def test_the_kits_own_pictures_are_nobodys_drawing(items, day):
    path = day.folder / day.worksheet
    copy = path.parent / "mine.png"
    copy.write_bytes((day.folder / day.kit_figures[0]).read_bytes())
    for name in (*(f"../{name}" for name in day.kit_figures), copy.name):
        text = f"{worksheet(day.terms, drawings=2)}\n### Drawing 3\n![mine]({name})\n"
        path.write_text(text, "utf-8")
        assert "Drawing 3: the kit's picture" in items()["drawings"].message


def test_every_picture_of_the_lab_guide_is_known_as_the_kits_own():
    day = find_day(1)
    guide = (day.folder / day.guide).read_text("utf-8")
    shown = set(re.findall(r"\(\.\./(figures/\w+\.png)\)", guide))
    assert shown
    assert shown <= set(day.kit_figures)


def test_the_checklist_of_an_older_worksheet_is_no_matter(sheet):
    older = f"{worksheet(TERMS)}\n\n## Checklist\n\n- [ ] I committed everything\n"
    assert all(item.passed for item in sheet(older).values())
    assert list(sheet(older)) == ["definitions", "drawings"]


def test_a_worksheet_that_is_gone_no_text_or_of_megabytes_is_told(items, day):
    path = day.folder / day.worksheet
    path.write_text("x" * 300_000)
    assert "at most 200 kB is looked at" in items()["drawings"].message
    path.write_bytes(b"\xff\xfe\x00")
    assert "UTF-8" in items()["drawings"].message
    path.unlink()
    assert items()["definitions"].status == "todo"


HOSTILE = ["<!--", "![", "![](", "<img ", " ", "- [", "- [ x", "#", "# #", "1. ?"]


@pytest.mark.parametrize("piece", [*HOSTILE, "_x", "*("])
@pytest.mark.parametrize("end", ["", "\n"])
def test_a_worksheet_of_anything_is_read(sheet, piece, end):
    text = (piece * (1800 // len(piece)) + "x" + end) * 110
    found = sheet(f"## Drawings\n{text}"[:199_999])
    assert not found["definitions"].passed


def test_sections_know_their_level_and_what_is_code():
    text = "# A\n1\n## B\n2\n```\n# no heading\n```\n## C ##\n3\n# D\n4"
    sections = split_sections(text)
    assert list(sections) == ["a", "b", "c", "d"]
    assert sections["a"].splitlines()[0] == "1"
    assert "# no heading" in sections["b"]
    assert sections["c"] == "3"


@pytest.mark.parametrize(
    ("value", "says"),
    [("0.5", "must be under 1e-10"), ("-1e-16", "never negative"), ("nan", "number")],
)
def test_a_number_that_cannot_be_right_is_told(items, clone, value, says):
    log = clone / "metrics" / "metrics.csv"
    row = log.read_text().splitlines()[1].replace("1e-15", value)
    assert value in row
    log.write_text(log.read_text() + row + "\n")
    item = items()["metrics"]
    assert item.status == "wrong"
    assert says in item.message


def test_a_missing_or_unreadable_log_is_told_with_what_to_do(items, clone):
    log = clone / "metrics" / "metrics.csv"
    log.write_text(log.read_text().splitlines()[0] + "\n")
    assert "No row yet for fk_identity_check (inv_err)" in items()["metrics"].message
    assert "make run DAY=1" in items()["metrics"].message
    log.write_text("this,is,another,table\n")
    assert items()["metrics"].status == "wrong"
    log.unlink()
    assert items()["metrics"].status == "todo"


def test_rows_count_only_if_the_students_file_wrote_them_as_it_is(items, day, clone):
    day.work.write_text("x = 3\n")
    assert "Your file has changed since it logged" in items()["metrics"].message
    log_again(day, clone, f"file {file_hash(day.work)}")
    assert items()["metrics"].passed
    day.work.write_bytes(b"x = 3\r\n")  # as git writes it on Windows
    assert items()["metrics"].passed
    log_again(day, clone, f"file {file_hash(day.source)}")
    assert (
        "The rows in the log come from the kit's own run" in items()["metrics"].message
    )
    log_again(day, clone, f"file {file_hash(day.work)} and more")
    assert "do not show that your file wrote them" in items()["metrics"].message
    assert "make run DAY=1" in items()["metrics"].message


def test_a_row_of_the_kits_after_the_students_changes_nothing(items, day, clone):
    log, notes = clone / "metrics" / "metrics.csv", f"file {file_hash(day.source)}"
    for row in day.metrics:
        fields = {"check": row.check, "metric": row.metric, "notes": notes}
        metrics.append_row(log, day=1, value=1.0, **fields)
    assert items()["metrics"].passed


def test_a_row_with_failed_trials_is_no_success(items, day, clone):
    notes = f"file {file_hash(day.work)}"
    log_again(day, clone, notes, n_trials=10, n_failures=3)
    assert "failed in 3 of 10 trials" in items()["metrics"].message
    assert items()["metrics"].status == "wrong"


def test_rows_count_only_once_the_tasks_pass(day, clone):
    before, after = (
        {item.name: item for item in check_deliverables(day, clone, tasks_pass=done)}
        for done in (False, True)
    )
    assert before["metrics"].status == "todo"
    assert "rows count once your tasks pass" in before["metrics"].message
    assert after["metrics"].passed


def test_what_is_not_committed_is_named_with_the_command(items, day, clone):
    day.work.write_text("x = 2\n")
    message = items()["commit"].message
    assert "w1-foundations/work/day1_transforms.py" in message
    assert 'git commit -m "Day 1"' in message
    git(clone, "commit", "-qam", "again")
    assert items()["commit"].passed
    git(clone, "rm", "-q", "--cached", "metrics/metrics.csv")
    git(clone, "commit", "-qm", "the log is gone")
    assert "metrics/metrics.csv" in items()["commit"].message


def test_a_folder_without_git_is_told(items, clone):
    (clone / ".git").rename(clone / "nothing")
    assert "git init" in items()["commit"].message


def test_what_the_script_imports_has_to_be_committed_too(items, day, clone):
    day.work.write_text("import numpy\nfrom helpers import skew\n")
    (day.work.parent / "helpers.py").write_text("def skew(v):\n    import deeper\n")
    (day.work.parent / "deeper.py").write_text("")
    (day.work.parent / "scratch.py").write_text("")
    git(clone, "add", str(day.work))
    git(clone, "commit", "-qm", "the script alone")
    message = items()["commit"].message
    assert "work/helpers.py" in message
    assert "work/deeper.py" in message
    assert "scratch" not in message
    commit(clone, "all of it")
    assert items()["commit"].passed


def test_a_drawing_that_is_not_committed_is_named(items, day, clone):
    path = day.folder / day.worksheet
    path.write_text(worksheet(day.terms, drawings=2) + "\n### Drawing 3\n![](s.jpg)\n")
    (path.parent / "s.jpg").write_bytes(b"jpeg")
    git(clone, "commit", "-qam", "the worksheet alone")
    assert "w1-foundations/docs/s.jpg" in items()["commit"].message


def test_a_clone_of_the_commit_gets_the_same_result_as_the_folder(items, day, clone):
    day.work.write_text("import helpers\n")
    (day.work.parent / "helpers.py").write_text("")
    log_again(day, clone, f"file {file_hash(day.work)}")
    commit(clone, "Day 1")
    here = items()
    assert all(item.passed for item in here.values())
    other = clone.parent / "other"
    subprocess.run(["git", "clone", "-q", str(clone), str(other)], check=True)
    there = check_deliverables(find_day(1, other), other)
    assert {item.name: item for item in there} == here


def test_what_is_not_there_is_not_called_uncommitted(items, day):
    (day.folder / day.figure).unlink()
    message = items()["commit"].message
    assert f"Not there yet: {day.folder.name}/{day.figure}." in message
    assert "Not committed" not in message
    assert "--screenshot" in items()["figure"].message


def test_without_git_on_the_machine_that_is_said(items, monkeypatch):
    monkeypatch.setenv("PATH", "")
    item = items()["commit"]
    assert (item.status, item.passed) == ("todo", False)
    assert "install git" in item.message


def test_a_picture_of_many_pieces_after_its_end_is_read_at_once():
    data, pieces = png(PICTURE), chunk(b"IDAT", b"x" * 20) * 250_000
    began = time.process_time()
    with pytest.raises(FlawError, match="cut off or damaged"):
        read_png(data[:-12] + pieces + data[-12:])
    assert time.process_time() - began < 5  # it took 40 s, more with every piece


def test_a_picture_that_inflates_without_end_is_refused(items, day):
    data, flood = png(PICTURE), chunk(b"IDAT", zlib.compress(b"\0" * 30_000_000))
    (day.folder / day.figure).write_bytes(data[:33] + flood + data[-12:])
    assert "cut off or damaged" in items()["figure"].message


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_a_pipe_in_the_place_of_a_file_does_not_stop_the_check(items, day, clone):
    for path in (clone / "metrics" / "metrics.csv", day.folder / day.figure):
        path.unlink()
        os.mkfifo(path)
    assert "is no file" in items()["metrics"].message
    assert "is no file" in items()["figure"].message


def test_a_day_hands_in_what_its_manifest_names_and_no_more(day, clone):
    bare = replace(day, figure="", worksheet="", metrics=())
    assert [item.name for item in check_deliverables(bare, clone)] == ["commit"]
    assert item_names(bare) == ["commit"]
    assert item_names(day) == [item.name for item in check_deliverables(day, clone)]
    words = replace(day, terms=(), questions=0, drawings=0)
    assert item_names(words) == ["figure", "metrics", "commit"]
