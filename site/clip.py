"""README's clip: a sign is edited and saved, the ghost folds, the mistake is named.

    .venv/bin/python site/clip.py       docs/inspector.gif, from the inspector itself

Needs the extras view, browser and figures, and Chromium. The picture and the words are
the page's own; they are set below each other, so that they can be read on a phone.
"""

import base64
import io
import shutil
import sys
import tempfile
from html import escape
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, sync_playwright

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))
from inspection import Served  # noqa: E402 (the tests' own way to start it)

RIGHT, WRONG = "make_T(Rz(q), np.zeros(3))", "make_T(Rz(-q), np.zeros(3))"
ARM = {"x": 30, "y": 140, "width": 460, "height": 340}  # of the page, 900 x 640
STYLE = """body { margin: 0; width: 600px; font: 21px/1.35 "DejaVu Sans", sans-serif;
  background: #fff; color: #1b1f24; } img { display: block; width: 100%; }
pre { margin: 0; padding: 14px 18px; background: #1b1f24; color: #e6eaee;
  font: 22px/1.45 "DejaVu Sans Mono", monospace; } b { background: #8a5a00; }
small { float: right; color: #98a3ae; } section { padding: 9px 18px;
  height: 92px; overflow: hidden; }
.bad { color: #a5201a; } .good { color: #00664b; }"""


def main() -> None:
    """Play it on the page, and put the pictures together."""
    source = (ROOT / "w1-foundations" / "src" / "day1_transforms.py").read_text("utf-8")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as play:
        work = Path(folder) / "day1_transforms.py"
        work.write_text(source, "utf-8")
        browser = play.chromium.launch(
            executable_path=shutil.which("chromium"),
            args=["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader"],
        )
        served = Served("1", "--web", work=work)
        try:
            frames = played(browser, served.url, work, source)
        finally:
            served.close()
        browser.close()
    pictures, seconds = zip(*frames, strict=True)
    sheets = [one.quantize(128, dither=Image.Dither.NONE) for one in pictures]
    out = ROOT / "docs" / "inspector.gif"
    sheets[0].save(
        out, save_all=True, append_images=sheets[1:], loop=0,
        duration=[round(1000 * s) for s in seconds],
    )  # fmt: skip
    print(f"{out.name}: {out.stat().st_size / 1e3:.0f} kB, {sum(seconds):.1f} s")


def played(browser, url: str, work: Path, source: str) -> list:
    """Return the frames and how long each is seen."""
    page = browser.new_page(
        viewport={"width": 900, "height": 640}, device_scale_factor=1.4
    )
    sheet = browser.new_page(viewport={"width": 600, "height": 100})
    page.goto(url)
    says = awaited(page, "8 of 8")
    if page.get_by_text("Software WebGL").count():  # of a machine without a GPU
        page.locator("button.mantine-CloseButton-root").first.click()
        page.wait_for_timeout(1000)
    arm = page.screenshot(clip=ARM)
    frames = [(shown(sheet, RIGHT, "", arm, says), 1.0)]
    frames.append((shown(sheet, WRONG, "", arm, says), 0.7))
    work.write_text(source.replace(RIGHT, WRONG), "utf-8")
    off = awaited(page, "is off by")[:1]
    page.wait_for_timeout(3000)  # the ghost is drawn
    folded = page.screenshot(clip=ARM)
    frames.append((shown(sheet, WRONG, "saved", folded, off), 1.3))
    named = awaited(page, "make check:", but="8 of 8")
    frames.append((shown(sheet, WRONG, "saved", folded, named[1:]), 1.8))
    frames.append((shown(sheet, RIGHT, "", folded, named[1:]), 0.5))
    work.write_text(source, "utf-8")
    says = awaited(page, "8 of 8")
    page.wait_for_timeout(3000)
    arm = page.screenshot(clip=ARM)
    return [*frames, (shown(sheet, RIGHT, "saved", arm, says), 1.0)]


def awaited(page: Page, words: str, but: str = "no such words") -> list[str]:
    """Return the page's lines on compose_fk and on make check, once they say so."""
    for _ in range(240):
        text = page.inner_text("body").splitlines()
        lines = [
            x.strip() for x in text if "YOUR compose_fk" in x or "make check:" in x
        ]
        if any(words in x for x in lines) and not any(but in x for x in lines):
            return lines
        page.wait_for_timeout(250)
    raise SystemExit(f"the page never said {words!r}: {lines}")


def shown(
    sheet: Page, code: str, state: str, arm: bytes, lines: list[str]
) -> Image.Image:
    """Return a frame: the code, the arm, the page's words below each other."""
    marked = escape(code).replace("-q", "<b>-q</b>")
    words = "".join(
        f'<div class="{"good" if line.startswith("✓") else "bad"}">{escape(line)}</div>'
        for line in lines
    )
    picture = base64.b64encode(arm).decode()
    sheet.set_content(
        f"<style>{STYLE}</style><pre>def joint_T(q):<small>{state}</small>\n"
        f"    return {marked}</pre><img src='data:image/png;base64,{picture}'>"
        f"<section>{words}</section>"
    )
    return Image.open(io.BytesIO(sheet.screenshot(full_page=True))).convert("RGB")


if __name__ == "__main__":
    main()
