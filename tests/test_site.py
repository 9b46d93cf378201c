"""The site: links hold, nothing comes from elsewhere, and the arm's page is right."""

import base64
import functools
import gzip
import html
import http.server
import json
import os
import re
import subprocess
import sys
import threading
from functools import cache
from importlib.util import find_spec

import mujoco
import numpy as np
import pytest
import whole
from judged import judged

from conftest import ROOT, need
from labkit.figures import backends
from labkit.lesson.day import all_days, days_of
from labkit.lesson.week import weeks
from robo47 import jacobian, kinematics, panda, screws, verify
from robo47.errors import Robo47Error

pytestmark = pytest.mark.kit

LOCK = ROOT / "site" / "package-lock.json"
WITHOUT_3D = ["--disable-gpu", "--disable-3d-apis"]


@cache
def with_notebook():
    """Return the days whose notebooks are run: other ones at each commit, or all.

    A notebook's cells are long runs of the lab, which its own tests check as well.
    """
    days = all_days()
    return days if os.environ.get("ROBO47_WHOLE") else whole.sample(days, "notebooks")


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Return the site, built as a person does: it ends with 0 without a warning."""
    need(find_spec("sphinx") is not None, "Sphinx: python3 scripts/setup_env.py site")
    for package in ("ipykernel", "ipywidgets", "jupytext", "nbclient"):
        need(find_spec(package) is not None, f"{package}: make notebook")
    need((ROOT / "site" / "node_modules").is_dir(), "npm ci --prefix site")
    try:
        backends.rendering_environment()  # the notebooks draw
    except Robo47Error as error:
        need(False, f"an OpenGL backend: {error}")
    out = tmp_path_factory.mktemp("site") / "_site"
    command = [sys.executable, ROOT / "scripts" / "build_site.py", "--out", out]
    command += ["--notebooks", *(str(day.number) for day in with_notebook())]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return out


@pytest.fixture(scope="module")
def served(site):
    """Return the site's address."""
    handler = functools.partial(Quiet, directory=str(site))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()
        thread.join()


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def launched(chromium):
    """Open browsers, one for all tests that give it the same arguments."""
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as play:
        launch = functools.partial(play.chromium.launch, executable_path=chromium)
        yield functools.cache(lambda *given: launch(args=[*given, "--no-sandbox"]))


@pytest.fixture
def browse(request, launched, served):
    """Open a page of the site; what goes wrong in it is kept."""
    drawing = ["--use-gl=angle", "--use-angle=swiftshader"]
    page = launched(*getattr(request, "param", drawing)).new_page()
    page.problems = []
    page.on("pageerror", lambda error: page.problems.append(str(error)))

    def abroad(request):
        if not request.url.startswith((served, "data:", "blob:")):
            page.problems.append(f"asks {request.url}")

    page.on("request", abroad)

    def go(path, width=1280, **more):
        page.set_viewport_size({"width": width, "height": 900})
        page.goto(f"{served}/{path}", **more)
        return page

    yield go
    page.close()


def test_a_page_with_a_lost_link_or_a_foreign_script_is_named(tmp_path):
    from labkit.site import links

    (tmp_path / "a.html").write_text(
        '<a href="b.html#here">1</a><a href="b.html#gone">2</a><a href="c.html">3</a>'
        '<script src="https://elsewhere.org/x.js"></script><a href="https://x.org">4</a>'
    )
    (tmp_path / "b.html").write_text('<p id="here">')
    assert links.faults(tmp_path) == [
        "a.html: b.html#gone: no anchor #gone",
        "a.html: c.html: no such file",
        "a.html: https://elsewhere.org/x.js: comes from another host",
    ]


def test_the_lock_file_pins_packages_and_names_no_registry():
    lock = json.loads(LOCK.read_text("utf-8"))
    packages = [one for name, one in lock["packages"].items() if name]
    assert packages
    assert all("integrity" in one and "resolved" not in one for one in packages)


def test_every_guide_worksheet_and_taught_module_has_a_page(site):
    for day in all_days():
        for name in (day.guide, day.worksheet, *day.library):
            found = [
                *site.rglob(f"{str(name).rpartition('/')[2].removesuffix('.md')}.html")
            ]
            assert found, f"day {day.number}: {name}"


def test_a_notebook_is_shown_run_and_linked_from_its_days_page(site):
    for day in with_notebook():
        name = f"{day.script.removesuffix('.py')}.html"
        guide = site / day.folder.name / day.guide.replace(".md", ".html")
        assert f'href="../notebooks/{name}"' in guide.read_text("utf-8")
        page = (guide.parent.parent / "notebooks" / name).read_text("utf-8")
        assert "All checks PASSED." in page
        assert "  FAIL  " not in page  # of a check; the prose has the word alone
        for task in day.tasks:
            assert f'<span class="nf">{task.functions[0]}<' in page
        extras = (day.own / "notebook.toml").read_text("utf-8")
        cells = len(re.findall("picture\\(|render_panda", extras))
        drawn = page.count('alt="What the cell above draws"')
        assert drawn == cells, f"day {day.number}: a cell stands before what it needs"


def test_a_notebooks_page_has_what_a_cell_printed_and_the_picture_it_drew(tmp_path):
    nbformat = pytest.importorskip("nbformat", reason="needs nbformat: make notebook")
    pytest.importorskip("nbclient", reason="needs nbclient: make notebook")
    from labkit.site import notebooks

    v4 = nbformat.v4
    progress = v4.new_output("stream", name="stderr", text="50 %")
    printed = v4.new_output("stream", name="stdout", text="\n  PASS\n")
    both = {"image/png": base64.b64encode(b"drawn").decode(), "text/plain": "<Image>"}
    drawn = v4.new_output("execute_result", both)
    sliders = {notebooks.WIDGET: {}, "text/plain": "HBox()"}
    moved = v4.new_output("execute_result", sliders)
    code = v4.new_code_cell("f(x)", outputs=[progress, printed, drawn, moved])
    ran = v4.new_notebook(cells=[v4.new_markdown_cell("# Day 9"), code])
    text = notebooks.page(ran, tmp_path / "day9.md", 9)
    order = ["# Day 9", "python\nf(x)\n", "  PASS\n", "(day9-1.png)", "DAY=9"]
    places = [text.index(part) for part in order]
    assert places == sorted(places)
    assert (tmp_path / "day9-1.png").read_bytes() == b"drawn"
    assert not any(part in text for part in ("50 %", "<Image>", "HBox"))


def test_a_cell_that_fails_is_named_with_its_day(monkeypatch):
    nbformat = pytest.importorskip("nbformat", reason="needs nbformat: make notebook")
    pytest.importorskip("nbclient", reason="needs nbclient: make notebook")
    pytest.importorskip("ipykernel", reason="needs ipykernel: make notebook")
    from labkit.lesson.day import find_day
    from labkit.site import notebooks

    v4 = nbformat.v4
    made = v4.new_notebook(cells=[v4.new_code_cell("1 / 0")])
    monkeypatch.setattr(notebooks, "build", lambda day, complete: nbformat.writes(made))
    with pytest.raises(Robo47Error, match=r"day 1: .*ZeroDivisionError: division"):
        notebooks.run(find_day(1))


def test_an_accented_letter_has_its_index_beside_it_and_its_dot_clear_of_it():
    pytest.importorskip("sphinx")
    pytest.importorskip("viser")
    from labkit.site.build import mathml

    assert mathml(r"\dot q_i").count("<msub><mover>") == 1
    assert "accent" not in mathml(r"\ddot q + \hat x")  # set into the letter at 1x
    assert mathml(r"a \sin q").count("<mspace") == 2  # "asin q" is another function
    assert "<mspace" not in mathml(r"\sin(q)")
    # An index is as low at a letter with a tail as at another one.
    assert '<mpadded depth="0em"><mi>q</mi>' in mathml("q_s")
    assert "mpadded" not in mathml("q + a_s")
    assert mathml("d = |q|").count('lspace="0em"') == 2


def test_an_equation_of_a_docstring_keeps_its_lines():
    pytest.importorskip("sphinx")
    pytest.importorskip("viser")
    from labkit.site.build import plain

    says = ["The |sum|:", "", "    a @ |b|  c", "    d = e", "", "- one", "  more", ""]
    lines = [*says, ":param q: what", "", "    it is"]
    plain(lines)
    kept = [".. code-block:: text", "", "    a @ |b|  c", "    d = e", "", "- one"]
    assert lines[:8] == [r"The \|sum\|:", "", *kept]
    assert lines[-3:] == [":param q: what", "", "    it is"]


def test_formulas_of_a_docstring_are_set_and_its_words_are_not():
    pytest.importorskip("sphinx")
    pytest.importorskip("viser")
    from labkit.site import equations
    from labkit.site.build import plain

    for text, wanted in {
        "Of R^T and -R^T t. A": "Of :math:`R^{T}` and :math:`-R^{T} t`. A",
        "It is a V_i of kg m^2.": r"It is a :math:`V_{i}` of kg m².",
        "[[I, m [c]], [m [c]^T, m 1]].": (
            r":math:`\begin{bmatrix}I & m [c] \\ m [c]^{T} & m 1\end{bmatrix}`."
        ),
        "tau = a sdd\nb sd^2 + c": r":math:`\tau  = a \ddot s b \dot s^{2} + c`",
        "M^-1 (Ad(T^-1) S)": r":math:`M^{-1} (\mathrm{Ad} (T^{-1}) S)`",
        ":param T_a: J_space, `R^T`, dM_ij/dq_k": None,
        "bias + foo (R^T + bar)": None,
    }.items():
        assert equations.inline(text) == (wanted or text)
    assert equations.equations(["    x+ = A |x|  y = 2"]) == [
        r"x^{+} = A |x| \qquad y = 2"
    ]
    for code in ("T = A @ B", "the error is = to what was read", "hinge  slide"):
        assert equations.equations([code]) is None
    lines = ["|x| of", "", "    V_i = |V_(i-1)|", "", "|R^T|"]
    plain(lines)
    assert lines == [
        r"\|x\| of", "", ".. math:: V_{i} = |V_{i-1}|", "", ":math:`|R^{T}|`"
    ]  # fmt: skip


def test_a_pages_boxes_have_labels_and_its_captions_a_level():
    from labkit.site import access

    box = '<input class="task-list-item-checkbox" type="checkbox">'
    made = access.page(f'<p class="caption" role="heading"></p><li><p>{box} a\nb</p>')
    assert 'role="heading" aria-level="2"' in made
    assert f"<label>{box} a\nb</label></p>" in made
    wide = '<img alt="b" src="../_images/a.webp">'
    narrow = '<source media="(max-width: 600px)" srcset="../_static/a_tall.webp">'
    chart = wide.replace("a.webp", "b.png")
    made = access.page(f"{wide}{chart}", ["a_tall.webp"], ["b.png"])
    assert made.startswith(f"<picture>{narrow}{wide}</picture><img loading")
    assert made.count('class="chart"') == 1
    formula = '<math xmlns="m"><mi>q</mi></math>'
    assert access.page(f"a {formula}. b") == f'a <span class="kept">{formula}.</span> b'
    block = formula.replace("xmlns", 'display="block" xmlns')
    assert access.page(f"{formula} b {block}.") == f"{formula} b {block}."


def test_a_command_is_told_in_a_sentence_whose_typed_parts_are_code():
    from labkit.site.pages import _sentence

    assert _sentence("is it so? TASK=9.3") == "Is it so? `TASK=9.3`."
    assert _sentence("a/b.html of it; ARGS=--x, --y") == (
        "`a/b.html` of it; `ARGS=--x`, `--y`."
    )
    assert _sentence("does it?") == "Does it?"
    assert _sentence("write it; WEEK=1: one week") == "Write it; `WEEK=1`: one week."


def test_all_commands_are_rows_of_two_tables(site):
    page = (site / "commands.html").read_text("utf-8")
    makefile = (ROOT / "Makefile").read_text("utf-8")
    verbs = re.findall(r"^([a-z]+)%?:.*?##", makefile, re.MULTILINE)
    assert len(verbs) > 30
    assert page.count("<table") == 2
    for verb in verbs:
        assert page.count(f'id="make-{verb}"') == 1, verb


def test_the_home_page_has_a_captioned_card_for_each_day(site):
    page = (site / "index.html").read_text("utf-8")
    cards = re.findall(
        r'<div class="card .*?(?=<div class="card |</section>)', page, re.S
    )
    assert len(cards) == len(all_days())
    for day, card in zip(all_days(), cards, strict=True):
        words = html.unescape(re.sub(r"<[^>]+>|\s+", " ", card)).replace("’", "'")
        words = " ".join(words.split())
        assert all([day.method, day.result]), f"day {day.number}: method: result"
        said = day.title, day.method[1:], day.result[1:]
        parts = [str(day.number), *(part.replace("- ", "-") for part in said)]
        places = [words.find(part) for part in parts]
        assert places == sorted(places), words
        assert places[0] == 0, words
        assert f"day{day.number}_small.png" in card
        assert f'{day.guide.replace(".md", ".html")}"' in card


def test_a_lessons_picture_is_a_chart_on_white_or_dark_itself():
    from PIL import Image

    from labkit.site import access

    dark = []
    for path in ROOT.glob("w*/figures/*.png"):
        grey = np.asarray(Image.open(path).convert("L"))
        assert access.on_white(path) == (np.median(grey) > 200), path.name
        dark += [] if access.on_white(path) else [path.name]
    assert {"day1_reference.png", "day7_pick.png", "week2_delivery.png"} <= {*dark}


def test_the_page_says_of_a_mistake_what_the_checker_says():
    pytest.importorskip("viser")
    from labkit.judge.row import row_of
    from labkit.lesson.day import find_day
    from labkit.site import typed

    table = typed.table()
    ask = row_of(find_day(1), "joint_T").ask
    assert table["questions"] == [call[0] for call in ask.main]
    assert len(table["named"]) > 15
    for one in table["named"]:
        poses = np.tile(np.eye(4), (len(ask.main), 1, 1))
        poses[:, :3, :3] = np.reshape(one["values"], (-1, 3, 3))
        found = judged(ask, list(poses))
        assert (found.mistake, found.message) == (one["slug"], one["says"])


def test_the_arms_small_meshes_are_where_the_robots_own_are(site):
    from labkit.site import meshes

    data = (site / "_static" / "panda.bin").read_bytes()
    size = int.from_bytes(data[:4], "little")
    head = json.loads(data[4 : 4 + size])
    at = 4 + size
    assert len(data) < meshes.LARGEST
    for seen, own in zip(head["shapes"], meshes.arm(), strict=True):
        corners = np.frombuffer(data, "<i2", 3 * seen["vertices"], at).reshape(-1, 3)
        at += 6 * (seen["vertices"] + seen["faces"])
        ends = head["step"] * np.array([corners.min(0), corners.max(0)])
        truth = [own.vertices.min(0), own.vertices.max(0)]
        assert seen["body"] == own.body
        assert np.abs(ends - truth).max() < 2e-3, own.body
        assert seen["faces"] < 0.5 * len(own.faces) + 200
    assert at == len(data)


DO = {
    "q": lambda v, q, i: q[i],
    "=": lambda v, q, x: x,
    "+": lambda v, q, a, b: v[a] + v[b],
    "-": lambda v, q, a, b: v[a] - v[b],
    "*": lambda v, q, a, b: v[a] * v[b],
    "sin": lambda v, q, a: np.sin(v[a]),
    "cos": lambda v, q, a: np.cos(v[a]),
}


def test_formulas_are_those_of_the_mistakes():
    from labkit.site import formulas

    table = formulas.tables()
    for q in random_q(5):
        values = []  # as arm.js does it
        for name, *of in table["lines"]:
            values.append(DO[name](values, q, *of))
        truth = ghosts_at(q)
        for mistake in table["mistakes"]:
            for name, entries in mistake["frames"].items():
                T = np.reshape([values[line] for line in entries], (3, 4))
                assert np.abs(T - truth[mistake["slug"]][name]).max() < 1e-12


def random_q(n):
    return verify.random_q(panda.load("panda_nohand"), n, seed=31)


def ghosts_at(q):
    """Return {slug: {frame: rows}} of the mistakes, made by the days' own code."""
    from labkit.site import formulas

    return {
        way.slug: {
            frame: np.asarray(way.code(*asked))[:3]
            for frame, asked in formulas.questions(day, q).items()
        }
        for day, _, way in formulas.chosen()
    }


@pytest.mark.browser
def test_the_arms_page_says_what_python_says(browse):
    for q in random_q(3):
        truth = ghosts_at(q)
        where = verify.mujoco_poses(panda.load("panda_nohand"), q[None])
        T_world_ee = where["site:attachment_site"][0][:3]
        angles = ",".join(map(repr, map(float, q)))
        page = browse(f"arm.html?{angles}#q={angles}", width=640)
        page.wait_for_function("window.arm?.mujoco", timeout=60_000)
        for slug, frames in truth.items():
            page.select_option("#mistake", slug)
            seen = page.evaluate("window.arm")
            assert seen["q"] == list(map(float, q))
            assert np.abs(np.ravel(T_world_ee) - seen["truth"]).max() < 1e-12
            assert seen["poses"].keys() == frames.keys()
            for name, T in frames.items():
                assert np.abs(np.ravel(T) - seen["poses"][name]).max() < 1e-12, slug
            metres = np.linalg.norm(frames["ee"][:, 3] - T_world_ee[:, 3])
            assert f"off by {1000 * metres:.0f} mm" in page.inner_text("#off")
            assert f"mistake={slug}" in page.url
    assert page.problems == []


@pytest.mark.browser
def test_a_slider_moves_the_arm_and_the_address_brings_it_back(browse):
    page = browse("arm.html", width=390)
    page.wait_for_function("window.arm", timeout=60_000)
    before = page.inner_text("#pose")
    page.click("#zero")
    limits = page.evaluate(
        "[...document.querySelectorAll('#sliders input')].map(s => s.max)"
    )
    assert page.evaluate("window.arm.q") == [min(0, float(x)) for x in limits]
    assert "-0.000000" not in page.inner_text("#pose")
    page.locator("#sliders input").nth(1).fill("0.5")
    assert page.inner_text("#pose") != before
    after = page.inner_text("#pose")
    page.reload()
    page.wait_for_function("window.arm && pose.innerText", timeout=60_000)
    assert page.inner_text("#pose") == after
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    assert page.problems == []


def typed_mistakes():
    """Return {slug: what the checker says} of the lines that the page can judge."""
    from labkit.site import typed

    return {one["slug"]: one["says"] for one in typed.table()["named"]}


@pytest.mark.browser
def test_a_typed_line_is_judged_and_never_run(browse):
    says = typed_mistakes()
    page = browse("arm.html#line=Rz(2*q)")
    page.wait_for_function("window.arm", timeout=60_000)
    assert page.inner_text("#says") == says["double-angle"]
    for line, told in {
        "Rz(-q)": says["turns-backwards"],
        "Rz(q).T": says["turns-backwards"],
        "return make_T(Rz(q / 2), np.zeros(3))": says["half-angle"],
        "[[sin(q), -cos(q), 0], [cos(q), sin(q), 0], [0, 0, 1]]": says[
            "sin-and-cos-swapped"
        ],
        "[[cos(q), -sin(q), 0], [sin(q), cos(q), 0], [0, 0, 1]]": "Right, at all",
        "Rz(q) @ Rz(0.5)": "None of the",
        "Rz(q": "Not read: a ) is missing",
        "alert(q)": 'Not read: "alert" is no name here',
        "constructor(q)": 'Not read: "constructor" is no name here',
        "<img src=x onerror=alert(1)>": "Not read:",
    }.items():
        page.fill("#line", line)
        assert page.inner_text("#says").startswith(told), line
    page.fill("#line", "Rz(q)")
    assert page.inner_text("#says") == ""
    assert page.url.count("line=") == 0
    assert page.problems == []


def live(day, model, q):
    """Return what the figure of a day's guide shows, by the library."""
    ee = "site:attachment_site"
    T = kinematics.fk_all(model, q)
    zero = kinematics.fk_all(model, np.zeros(7))
    S = screws.joint_screws([zero[f"body:link{i}"] for i in range(1, 8)])
    if day == 1:
        return T["body:link3"][:3].ravel()  # L0 L1 J(q1) ... L3, and no J(q3)
    if day == 2:
        return (screws.fk_space(S[3:], zero[ee], q[3:]))[:3].ravel()
    J = jacobian.space_jacobian(S, q)
    if day == 3:
        at_hand = jacobian.site_jacobian(J, T[ee][:3, 3])
        return np.linalg.svd(at_hand[3:], compute_uv=False)
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_forward(model, data)  # at rest qfrc_bias is gravity's torque
    return data.qfrc_bias


@pytest.mark.browser
@pytest.mark.parametrize("browse", [WITHOUT_3D], indirect=True)  # half the time
@pytest.mark.parametrize("day", [1, 2, 3, 4])
def test_a_live_figure_at_a_formula_shows_the_librarys_numbers(browse, day):
    page = browse(f"w1-foundations/docs/day{day}-lab.html")
    asked = "performance.getEntries().filter(e => e.name.includes('figures')).length"
    assert day in (2, 4) or page.evaluate(asked) == 0  # those two are near the top
    figure = page.locator("figure.live")
    figure.scroll_into_view_if_needed()
    page.wait_for_function("document.querySelector('.live').figure", timeout=60_000)
    q = np.array(panda.READY_Q)
    q[3] = -1.25
    figure.locator("label:has-text('q4') input").fill("-1.25")
    seen = page.evaluate("document.querySelector('.live').figure.value")
    model = panda.load("panda_nohand")
    assert np.abs(seen - live(day, model, q)).max() < 1e-6
    assert page.problems == []


KINDS = (
    "index.html",
    "README.html",
    "commands.html",
    "arm.html",
    "search.html?q=gimbal",
    "library/dynamics.html",
    "w1-foundations/docs/day1-lab.html",
    "w1-foundations/docs/day1.html",
    "_static/films/day1_order.html",
)


@pytest.mark.browser
def test_no_kind_of_page_has_a_part_that_cannot_be_named_or_reached(browse):
    axe = (ROOT / "site/node_modules/axe-core/axe.min.js").read_text("utf-8")
    grave = "v => ['serious', 'critical'].includes(v.impact)"
    for kind in KINDS:
        page = browse(kind, width=390)
        page.wait_for_function(READY.get(kind, "true"), timeout=60_000)
        page.evaluate(axe)
        found = page.evaluate(
            f"axe.run().then(r => r.violations.filter({grave})"
            ".map(v => [v.id, v.nodes[0].html]))"
        )
        assert found == [], kind


READY = {
    "index.html": "document.querySelector('.live').figure?.value",
    "arm.html": "window.arm",
    "search.html?q=gimbal": "document.querySelector('#search-results li a')",
    "_static/films/day1_order.html": "document.querySelector('[aria-label=speed]')",
}


@pytest.mark.browser
def test_the_home_page_is_small_and_leads_to_the_arm(browse, site, served):
    page = browse("index.html", wait_until="commit")
    page.wait_for_load_state("networkidle")
    asked = page.evaluate("performance.getEntries().map(entry => entry.name)")
    names = {each.split("?")[0] for each in asked if each.startswith(served)}
    files = [(site / name.removeprefix(f"{served}/")).read_bytes() for name in names]
    assert len(files) > 10
    assert sum(len(gzip.compress(file)) for file in files) < 500_000  # as it is sent
    page.wait_for_function("document.querySelector('.live').figure?.value")
    shown = "document.querySelector('.live').figure.value"
    wrong = page.evaluate(f"[{shown}.says, Boolean({shown}.drawn)]")
    assert wrong == [typed_mistakes()["turns-backwards"], True]
    assert page.inner_text(".live .verdict") == wrong[0]
    page.click(".live button:has-text('Rz(q)')")
    assert page.inner_text(".live .verdict").startswith("Right, at all")
    assert page.evaluate(f"{shown}.drawn") is None
    page.fill(".live .code input", "Rz(q")
    assert page.inner_text(".live .verdict").startswith("Not read: a ) is")
    link = page.get_by_text("Try it now, nothing to install")
    assert link.bounding_box()["y"] < 600
    link.click()
    page.wait_for_function("window.arm", timeout=60_000)
    assert page.problems == []


@pytest.mark.browser
@pytest.mark.parametrize("browse", [WITHOUT_3D], indirect=True)
def test_a_search_finds_what_a_student_types(browse):
    first = "document.querySelector('#search-results li a')"
    for words, leads in {
        "gimbal": "library/orientation.html",
        "make hint": "commands.html#make-hint",
    }.items():
        page = browse(f"search.html?q={words.replace(' ', '+')}")
        page.wait_for_function(first, timeout=60_000)
        assert leads in page.evaluate(f"{first}.href")


def test_films_are_small_and_linked_where_their_picture_stands(site):
    from labkit.site import build

    names = sorted(build.films())
    days = {int(re.match(r"day(\d+)_", name)[1]) for name in names}
    first = {day.number for week in weeks()[:2] for day in days_of(week)}
    assert days >= first
    pages = {path: path.read_text("utf-8") for path in site.glob("w*/docs/*-lab.html")}
    for name in names:
        film = site / "_static" / "films" / f"{name}.html"
        assert film.stat().st_size < build.LARGEST_FILM
        link = f'href="../../_static/films/{name}.html"'
        (page,) = [text for text in pages.values() if link in text]
        assert page.index(f"{name}.png") < page.index(link)


@pytest.mark.browser
def test_a_click_puts_the_film_in_its_pictures_place(browse):
    page = browse("w1-foundations/docs/day1-lab.html")
    assert page.locator("img[src*=day1_order]").count() == 1
    page.click("p.film a")
    page.wait_for_selector("img[src*=day1_order]", state="detached")
    clock = page.frame_locator("iframe.film").locator("input").first
    clock.wait_for(timeout=60_000)
    assert page.problems == []


@pytest.mark.browser
@pytest.mark.parametrize("browse", [WITHOUT_3D], indirect=True)
def test_without_webgl_pictures_and_numbers_stay(browse):
    page = browse("w1-foundations/docs/day1-lab.html")
    assert page.locator("img[src*=day1_order]").count() == 1
    assert page.locator("p.film").count() == 0
    page = browse("arm.html#mistake=turns-backwards")
    page.wait_for_function("window.arm", timeout=60_000)
    says = "document.querySelector('#stage').innerText.includes('no 3D')"
    page.wait_for_function(says, timeout=60_000)
    assert "off by" in page.inner_text("#off")
    page = browse("index.html")
    words = page.locator(".picture.none")
    words.wait_for(timeout=60_000)
    ink = words.evaluate("node => getComputedStyle(node).color.match(/\\d+/g)")
    assert min(map(int, ink)) > 200  # on the dark ground of the stage


@pytest.mark.browser
@pytest.mark.parametrize("browse", [WITHOUT_3D], indirect=True)  # half the time
@pytest.mark.parametrize("width", [390, pytest.param(1280, marks=pytest.mark.soak)])
def test_no_page_is_wider_than_the_screen(browse, site, width):
    pages = [p for p in site.rglob("*.html") if "films" not in p.parts]
    for path in sorted(pages):
        page = browse(path.relative_to(site).as_posix(), width, wait_until="load")
        wide = page.evaluate("document.documentElement.scrollWidth")
        assert wide <= width, path.relative_to(site)
    assert page.problems == []


@pytest.mark.browser
@pytest.mark.parametrize("browse", [WITHOUT_3D], indirect=True)
def test_on_a_phone_a_table_of_days_is_a_list_with_each_title_beside_its_picture(
    browse,
):
    placed = """selector => [...document.querySelectorAll(selector)].map(e => {
        const box = e.getBoundingClientRect();
        const day = (e.alt || e.innerText).match(/day (\\d+)/i)[1];
        return [box.top + box.height / 2, Number(day), box.left];
    })"""
    for folder in ("", *(f"{week.folder.name}/" for week in weeks())):
        page = browse(f"{folder}README.html", 390, wait_until="load")
        wide = "e => e.some(one => one.scrollWidth > one.clientWidth)"
        assert not page.eval_on_selector_all(".table-wrapper:has(th img)", wide)
        pictures = sorted(page.evaluate(placed, "table:has(th img) img"))
        titles = sorted(page.evaluate(placed, "table:has(th img) strong"))
        days = [day for _, day, _ in pictures]
        assert days == sorted(days) == [day for _, day, _ in titles] != []
        for (_, _, left), (_, _, right) in zip(pictures, titles, strict=True):
            assert left + 100 < right
