"""The report: every number right, every text harmless, good on a phone."""

import dataclasses
import html
import re
import subprocess
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from xml.etree import ElementTree

import pytest

from conftest import ROOT, need
from labkit.base import html as pages
from labkit.check import memory
from labkit.check.memory import Entry
from labkit.commands import report as report_command
from labkit.lesson.day import Day, all_days, find_day
from labkit.lesson.metric import Metric
from labkit.log.rows import HEADER as LINE
from labkit.log.rows import checked_row, encode
from labkit.log.scan import scan
from labkit.report import overview, page, plot
from labkit.report.series import Report, Series, collect, series_of
from labkit.report.week_facts import OwnDay

pytestmark = pytest.mark.kit

LIMIT = Metric("fk", "err", max=1e-8)
EVIL = "<script>document.title='owned'</script><img src=x onerror=alert(1)>"


def line(**fields: object) -> str:
    base = {"date": "2026-09-01", "day": 1, "check": "fk", "metric": "err"}
    return encode(checked_row(base | {"git_sha": "abc1234"} | fields, True)[0])


@pytest.fixture
def log(tmp_path: Path) -> Path:
    return tmp_path / "metrics.csv"


def report_on(log: Path, *lines: str, **filters) -> Report:
    log.write_text("\n".join([LINE, *lines]) + "\n", encoding="utf-8")
    return collect(scan(log), [Series(1, LIMIT)], **filters)


@pytest.fixture
def run(run):
    """Run the command."""
    return partial(run, "scripts/report_metrics.py", COLUMNS="80")


def of_values(metric: str, *values: float, limit: Metric | None = None) -> Series:
    """Return a series of these values."""
    series = Series(1, limit or Metric("c", metric))
    series.rows = [
        checked_row({"value": v, "git_sha": "abc1234"}, False)[0] for v in values
    ]
    return series


def drawn(series: Series, tag: str) -> list:
    """Return the plot's shapes of one kind, back to front."""
    return ElementTree.fromstring(plot.draw(series)).findall(tag)


def test_the_log_that_the_kit_is_committed_with_shows_nobodys_work(run, log, tmp_path):
    """Where a student has committed rows, the kit's own log is not to be had."""

    def git(*arguments: str) -> str:
        command = ["git", "-C", ROOT, *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout

    committed = (ROOT / "metrics" / "metrics.csv").read_text("utf-8")
    if (ROOT / ".git").exists():  # else an export, which nobody has worked in
        need(not git("ls-files", "w*/work"), "a clone without a student's commits")
        committed = git("show", "HEAD:metrics/metrics.csv")
    log.write_text(committed, "utf-8")
    assert log.read_text("utf-8") == LINE + "\n"
    done = run("--out", tmp_path, ROBO47_METRICS=log)
    assert "\n0 rows; checks: 0 passing, 0 failing" in done.stdout
    assert "hunts" not in done.stdout
    assert "Nothing recorded yet" in (tmp_path / "report.html").read_text("utf-8")


def test_latest_best_runs_and_status_are_right(log):
    report = report_on(log, *(line(value=v) for v in (1e-3, 1e-12, 1e-9)))
    (series,) = report.series
    assert [row["value"] for row in series.rows] == [1e-3, 1e-12, 1e-9]
    assert (series.best, series.status, report.rows) == (1e-12, "pass", 3)


@pytest.mark.parametrize(
    ("value", "status"),
    [(0.9e-8, "pass"), (1e-8, "fail"), (float("nan"), "fail"), (None, "fail")],
)
def test_a_value_passes_under_its_threshold(log, value, status):
    assert report_on(log, line(value=value)).series[0].status == status


def test_a_minimum_is_a_threshold_too():
    series = of_values("rate", 0.95, 0.5, limit=Metric("c", "rate", min=0.9))
    assert (series.best, series.status) == (0.95, "fail")
    assert series.bounds == [(">", 0.9)]


def test_the_best_run_is_one_that_passes(log):
    lines = line(value=1e-12), line(value=1e-15, n_failures=7)
    (series,) = report_on(log, *lines).series
    assert (series.best, series.status) == (1e-12, "fail")
    (series,) = report_on(log, lines[1]).series
    assert series.best == 1e-15  # where none does


def test_a_run_that_is_no_number_is_drawn_as_the_failure_it_is(log):
    (series,) = report_on(log, line(value=1e-9), line(value=float("nan"))).series
    *_, halo, last = drawn(series, "circle")
    assert (last.get("fill"), last.get("stroke")) == ("var(--card)", "var(--fail)")
    assert [halo.get(a) for a in ("cx", "cy")] == [last.get(a) for a in ("cx", "cy")]
    assert last.find("title").text.startswith("nan")


def test_a_number_within_its_limit_fails_if_its_trials_did(log):
    report = report_on(log, line(value=1e-12, n_trials=10, n_failures=4))
    assert report.series[0].status == "fail"
    assert "failed in 4 of 10 trials" in page.render(report, "")


def test_the_threshold_of_one_day_is_not_anothers_and_days_can_be_jumped_to(log):
    report = report_on(log, line(value=1), line(value=1, day=2))
    assert [s.status for s in report.series] == ["fail", "open"]
    text = page.render(report, "")
    assert '<a class="fail" href="#1">Day 1</a>' in text
    assert '<section id="2">' in text


def test_a_number_is_told_in_words_with_its_unit_and_by_its_names(log):
    log.write_text("\n".join([LINE, line(value=0.25)]) + "\n", encoding="utf-8")
    wanted = Metric("fk", "err", max=1.0, says="hand off <its place>", unit="mm")
    text = page.render(collect(scan(log), [Series(1, wanted)]), "")
    assert "<h3>hand off &lt;its place&gt;</h3>" in text
    assert '<span class="muted">fk, err</span>' in text
    assert ">0.25 mm</dd>" in text


def test_every_number_of_the_course_has_a_sentence():
    asked = [metric for day in all_days() for metric in day.metrics]
    assert not [metric for metric in asked if not 10 < len(metric.says) < 60]


def test_what_fails_comes_first_in_its_day(log):
    lines = [line(value=1, check="a"), line(value=1, check="fk")]
    assert [s.wanted.check for s in report_on(log, *lines).series] == ["fk", "a"]


def test_what_the_manifest_asks_for_is_shown_before_it_is_run(log):
    (series,) = report_on(log).series
    assert (series.wanted.check, series.status) == ("fk", "none")
    assert "not run yet" in page.render(report_on(log), "")


def test_rows_that_a_merge_left_out_of_order_are_sorted_by_date(log):
    lines = [line(date=f"2026-09-0{day}", value=day) for day in (2, 1)]
    report = report_on(log, *lines)
    assert [row["value"] for row in report.series[0].rows] == [1, 2]


def test_the_filters_keep_what_they_name(log):
    lines = [
        line(value=1, date="2026-09-01"),
        line(value=2, date="2026-09-05"),
        line(value=3, day=2, check="ik", date="2026-09-05"),
    ]

    def kept(**filters) -> list:
        report = report_on(log, *lines, **filters)
        return [row["value"] for series in report.series for row in series.rows]

    assert kept() == [1, 2, 3]
    assert kept(since="2026-09-05") == [2, 3]
    assert kept(day=2) == [3]
    assert kept(check="fk") == [1, 2]


def test_lines_that_cannot_be_read_are_listed_not_hidden(log):
    bad = ["cut,2026", line(value=1, notes="x") + ",with <b>commas</b>"]
    text = page.render(report_on(log, *bad), "")
    assert "Lines to look at (2)" in text
    assert "cut,2026" in text
    assert "with &lt;b&gt;commas&lt;/b&gt;" in text


def test_text_from_the_log_is_shown_as_text(log):
    fields = dict.fromkeys(("check", "metric", "notes", "config", "method"), EVIL)
    report = report_on(log, line(value=1, git_sha=EVIL, **fields), EVIL)
    text = page.render(report, EVIL)
    assert "<script" not in text
    assert "<img" not in text
    assert html.escape(EVIL) in text


def test_the_page_asks_for_nothing_from_outside(log):
    text = page.render(report_on(log, line(value=1)), "")
    assert not re.search(r"https?:|src=|href=|url\(|@import|<script|<link", text)


@pytest.mark.parametrize(
    ("metric", "values", "is_log"),
    [
        ("inv_err", (1e-16, 1e-15), True),
        ("residual", (1.0, 1e-9), True),
        ("rate", (0.5, 0.9), False),
        ("err", (-1, 1), False),
        ("err", (0, 0), False),
    ],
)
def test_errors_get_a_log_axis_and_rates_a_linear_one(metric, values, is_log):
    assert of_values(metric, *values).is_log == is_log


@pytest.mark.parametrize(
    "values",
    [
        [0.0],
        [0.0, 1e-16],
        [1e-320, 1.7e308],
        [-1.7e308, 1.7e308],
        [5.0, 5.0],
        [1.0, 1.0000000000000002],
        [-3.0, 0.0, 4.0],
        [1e-16] * 1000 + [1e-3],
    ],
)
@pytest.mark.parametrize("metric", ["err", "rate"])
def test_every_series_of_numbers_can_be_drawn_inside_the_plot(values, metric):
    series = of_values(metric, *values, limit=Metric("c", metric, max=1e-8))
    lines, dots = drawn(series, "polyline"), drawn(series, "circle")
    points = [p.split(",") for line in lines for p in line.get("points").split()]
    points += [(dot.get("cx"), dot.get("cy")) for dot in dots]
    assert all(
        0 <= float(x) <= plot.WIDTH and 0 <= float(y) <= plot.HEIGHT for x, y in points
    )
    shapes = len(lines) + len(dots) + len(drawn(series, "text"))
    assert plot.MOST + 20 > shapes > 2


def test_a_long_series_keeps_its_extremes_and_its_latest_run():
    values = [1e-15] * 5000
    values[1234], values[4321], values[-1] = 0.5, 1e-30, 2e-15
    tips = [d.findtext("title") for d in drawn(of_values("err", *values), "circle")]
    for value in (0.5, 1e-30):
        assert any(tip.startswith(repr(value)) for tip in tips)
    assert tips[-1].startswith("2e-15")


@pytest.mark.parametrize(
    ("limit", "value", "decades"),
    [
        ({"max": 1e-8}, 1e-11, 3),
        ({"max": 1e-8}, 1e-7, -1),
        ({"max": 20.0}, 0.0, overview.MOST),
        ({"min": 0.1}, 10.0, 2),
        ({"min": 0.1, "max": 1000.0}, 10.0, 2),  # the nearer limit counts
        ({"max": 0.0}, -1.0, None),
        ({"max": 1.0}, float("nan"), None),
        ({"max": 1.0}, None, None),
        ({}, 1.0, None),
    ],
)
def test_a_margin_is_the_factor_between_number_and_limit_in_decades(
    limit, value, decades
):
    series = of_values("m", limit=Metric("c", "m", **limit))
    found = overview.margin(series, value)
    assert found == (decades if decades is None else pytest.approx(decades))


def test_a_bar_begins_at_the_limit_and_goes_left_where_a_number_fails():
    limit = Metric("c", "m", max=1e-3, says="largest error <m>")
    good, bad = (of_values("m", value, limit=limit) for value in (1e-6, 1e-1))
    bars = [overview.Bar(one, one.latest, one.status) for one in (good, bad)]
    picture = re.search("<svg.*</svg>", overview.margins(bars))[0]
    (line,) = [p for p in ElementTree.fromstring(picture).iter("path")
               if p.get("stroke") == "var(--limit)"]  # fmt: skip
    at_limit = float(re.match(r"M([\d.]+)", line.get("d"))[1])
    first, second = ElementTree.fromstring(picture).iter("rect")
    assert float(first.get("x")) == pytest.approx(at_limit)
    right = float(second.get("x")) + float(second.get("width"))
    assert right == pytest.approx(at_limit)
    assert "largest error <m>" in first.find("title").text
    assert "1 of 2 numbers are inside their limits." in picture
    assert overview.margins([overview.Bar(of_values("m", 1.0), 1.0, "open")]) == ""


def test_a_day_has_a_square_a_task_and_a_dot_an_attempt(tmp_path):
    day = dataclasses.replace(find_day(1), folder=tmp_path)
    (tmp_path / "work").mkdir()
    ids = [task.id for task in day.tasks]
    states = {ids[0]: "passed", ids[1]: "wrong"}
    own = OwnDay(day, states, [], hints=3)
    entries = [Entry(ids[0], "wrong", "x", EVIL), Entry(ids[0], "passed", "")]
    assert overview.days_table([own], entries) == ""  # it is not begun
    day.work.write_text("")
    table = overview.days_table([own], entries)
    squares, attempts = (
        re.findall(r'<i class="(\w*)"', part) for part in table.split("class=attempts")
    )
    assert squares == ["pass", "fail", *[""] * (len(ids) - 2)]
    assert attempts == ["fail", "pass"]
    assert "<td class=hints>3</td>" in table
    assert "<script" not in table


def test_plots_are_folded_unless_a_number_fails(log):
    good = page.render(report_on(log, line(value=1e-9)), "")
    bad = page.render(report_on(log, line(value=1)), "")
    assert "<details><summary>Every run of 1 number</summary>" in good
    assert "<details open><summary>Every run of 1 number</summary>" in bad


def test_each_point_names_its_commit(log):
    lines = [line(value=1e-9, git_sha=sha) for sha in ("1111111", "222")]
    text = page.render(report_on(log, *lines), "")
    assert all(f"commit {sha}" in text for sha in ("1111111", "222"))


def test_thresholds_are_the_manifests():
    limits = {one.key: one.bounds for one in series_of(find_day(1), [])}
    assert limits[1, "fk_identity_check", "inv_err"] == [("<", 1e-10)]
    assert limits[1, "fk_by_hand", "max_abs_err"] == [("<", 1e-8)]


def test_a_row_without_its_day_is_of_the_only_day_that_asks_for_it(log):
    lines = [line(value=1, day=None), line(value=1, day=None, check="x")]
    assert [one.day for one in report_on(log, *lines).series] == [1, None]


def test_the_command_writes_a_small_page_of_a_hundred_thousand_rows(log, run):
    rows = [line(value=1e-9 / (i + 1), notes=f"run, {i}") for i in range(1000)]
    log.write_text("\n".join([LINE, *rows * 100, "cut"]) + "\n")
    done = run("--file", log)
    assert done.returncode == 0
    assert "100,000 rows" in done.stdout
    assert "1 line needs a look" in done.stdout
    text = (log.parent / "report.html").read_text("utf-8")
    assert "fk" in text
    assert len(text) < 300_000


def test_an_empty_log_gives_a_page_that_says_what_to_do(log, run):
    log.write_text(LINE + "\n")
    done = run("--file", log, "--check", "nothing")
    assert done.returncode == 0
    assert "make run" in (log.parent / "report.html").read_text("utf-8")


def test_a_mistake_is_told_without_a_traceback_and_help_fits_80_columns(run):
    assert run("--file", "nowhere.csv").returncode == 2
    assert run("--since", "soon").returncode == 2
    assert max(len(text) for text in run("--help").stdout.splitlines()) <= 80


# In a real browser.


def dom(chromium: str, folder: Path, text: str) -> str:
    """Return the page as Chromium has it after loading and running it."""
    (folder / "page.html").write_text(text, "utf-8")
    flags = "--headless --no-sandbox --disable-gpu --no-first-run"
    flags += " --disable-background-networking --disable-dev-shm-usage --dump-dom"
    done = subprocess.run(
        [
            chromium,
            *flags.split(),
            f"--user-data-dir={folder / 'profile'}",
            (folder / "page.html").as_uri(),
        ],
        capture_output=True,
        encoding="utf-8",
        timeout=120,
    )
    return done.stdout


PARTS = ".card, .tile, h3, dl, svg"  # what stays inside of the window
MEASURE = """<body><iframe id=f style="width:{width}px;height:900px" srcdoc="{page}">
</iframe><script>onload = () => {{
  const d = document.getElementById('f').contentDocument;
  const wide = [...d.querySelectorAll('.card, .tile, h3, dl, svg')]
    .filter(e => e.getBoundingClientRect().right > {width} + 1).length;
  document.title = [d.title, d.documentElement.scrollWidth, wide,
    d.querySelectorAll('circle').length, d.querySelectorAll('.note').length,
    d.querySelectorAll('script, img').length].join(' ');
}}</script>"""


def measured(
    chromium: str, folder: Path, text: str, width: int, parts: str = PARTS
) -> list[str]:
    """Return a page's title and what MEASURE counts in it, in a window of a width."""
    harness = MEASURE.replace(PARTS, parts)
    harness = harness.format(width=width, page=html.escape(text))
    found = re.search(r"<title>(.*?)</title>", dom(chromium, folder, harness))
    assert found is not None
    return found[1].rsplit(maxsplit=5)


@pytest.mark.browser
@pytest.mark.parametrize("width", [390, 1280])
def test_the_page_fits_and_runs_nothing_in_a_real_browser(
    log, tmp_path, chromium, width
):
    lines = [line(value=v, notes=EVIL) for v in (1e-3, 1e-12, 0)]
    lines.append(line(value=1, day=2, check="a_very_long_name" * 5, metric="m" * 90))
    text = page.render(report_on(log, *lines, EVIL), EVIL)
    found = measured(chromium, tmp_path, text, width)
    title, scroll_width, too_wide, dots, note_cells, made = found
    assert title == "robo47 metrics"
    assert int(scroll_width) <= width
    assert (too_wide, made) == ("0", "0")
    assert (dots, note_cells) == ("6", "6")


@pytest.mark.browser
def test_the_days_need_no_scrolling_on_a_phone(chromium, tmp_path):
    day = dataclasses.replace(find_day(9), folder=tmp_path)
    (tmp_path / "work").mkdir()
    day.work.write_text("")
    states = {task.id: "passed" for task in day.tasks}
    tried = [Entry(task.id, "passed", "") for task in day.tasks] * 6
    table = overview.days_table([OwnDay(day, states, [], hints=3)], tried)
    text = pages.page("robo47", "", table, style=overview.STYLE)
    _, _, beyond, *_ = measured(chromium, tmp_path, text, 390, "tr > *")
    assert beyond == "0"


@pytest.mark.browser
def test_the_labels_of_the_margins_are_whole_on_a_phone(chromium, tmp_path):
    limit = Metric("c", "m", max=1e-3)
    bar = overview.Bar(of_values("m", 1e-6, limit=limit), 1e-6, "pass")
    bars = [bar._replace(series=dataclasses.replace(bar.series, day=47))]
    text = pages.page("robo47", "", overview.margins(bars), style=overview.STYLE)
    outside = """[...d.querySelectorAll('svg text')].filter(e =>
      e.getBoundingClientRect().left <
      e.closest('svg').getBoundingClientRect().left).length"""
    harness = MEASURE.replace("d.documentElement.scrollWidth", outside)
    harness = harness.format(width=390, page=html.escape(text))
    found = re.search(r"<title>robo47 (\d+)", dom(chromium, tmp_path, harness))
    assert found is not None
    assert found[1] == "0"


def test_several_days_without_a_check_are_told_in_one_line(capsys, monkeypatch):
    states = {1: {}, 2: {"2.1": "passed"}, 3: {}, 4: {"4.1": "wrong"}, 5: {}}
    days = [
        dataclasses.replace(find_day(i), tasks=find_day(i).tasks[:1]) for i in states
    ]
    here = SimpleNamespace(is_file=lambda: True)
    monkeypatch.setattr(Day, "work", here)
    monkeypatch.setattr(memory, "task_states", lambda day: states[day.number])
    report_command.tell(Report([]), days)
    assert capsys.readouterr().out.splitlines() == [
        "days 1, 3 and 5: Not checked in this version: make check DAY=1, and so on.",
        "day 4: The last check: 0 of 1 tasks pass; 4.1 wrong.",
    ]


def test_a_counter_of_nothing_is_left_out_but_for_what_passes(log):
    text = page.render(report_on(log, line(value=1.0)), "")
    labels = re.findall(r'<span class="muted">([a-z ]+)</span></div>', text)
    assert "passing" in labels  # the first counter says 0
    assert "lines to look at" not in labels
    assert re.findall(r'class="tile"><b class="\w*">(\d+)', text).count("0") <= 1
