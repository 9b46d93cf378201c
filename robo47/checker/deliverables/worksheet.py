"""The student's worksheet: definitions in their own words, drawings, checklist."""

import re
from pathlib import Path

from robo47.checker.deliverables.item import Item, from_root
from robo47.lesson.day import Day

FEWEST_WORDS = 8  # of a definition
SHINGLE = 5  # words in a row that count as taken over
TAKEN_OVER = 0.5  # share of a definition's shingles that may stand in the lab guide
DRAWN_LINES = 3  # of a drawing made of text
FEWEST_ANSWER_WORDS = 4  # "Its own: multiply right." answers a question

_HEADING = re.compile(r"(#{1,6})\s+(.*?)\s*#*$")
_FENCE = re.compile(r"\s*(```|~~~)")
_IMAGE = re.compile(r"!\[[^\]]*\]\(\s*<?([^)>\s]+)[^)]*\)|<img[^>]+src=[\"']([^\"']+)")
_QUESTION = re.compile(r"\s{0,3}\d+[.)]\s+\S")
_BOX = re.compile(r"\s*[-*+]\s+\[([ xX])\]\s*(.*)")
# A template's own words: quoted or italic instructions, and lines to write on.
_PROMPT = re.compile(r"\s*(>.*|_[^_]+_|\*[^*]+\*|[._\s…]*|TODO.*)$")


def check_worksheet(day: Day, week: Path) -> list[Item]:
    """Check the day's worksheet: definitions, drawings and checklist.

    Args:
        day: from the kit's manifest.
        week: the week's folder in the student's clone.
    """
    path = week / day.worksheet
    names = ("definitions", "drawings", "checklist")
    try:
        text = path.read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        missing = isinstance(error, FileNotFoundError)
        why = "is not there" if missing else "cannot be read as text in UTF-8"
        says = f"{from_root(path, week)} {why}."
        return [Item(name, "todo" if missing else "wrong", says) for name in names]
    sections = split_sections(re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL))
    try:
        guide = (day.folder / day.guide).read_text("utf-8")
    except OSError:
        guide = ""
    where = from_root(path, week)
    return [
        _in_words(sections, day, guide, where),
        _drawings(sections, day, path.parent, where),
        _checklist(sections, where),
    ]


def split_sections(text: str) -> dict[str, str]:
    """Return {heading in lower case: the text below it, with its subsections}.

    Args:
        text: Markdown. A `#` inside a fenced block is no heading.
    """
    sections: dict[str, list[str]] = {}
    open_now: list[tuple[int, str]] = []
    fenced = False
    for line in text.splitlines():
        if _FENCE.match(line):
            fenced = not fenced
        heading = None if fenced else _HEADING.match(line)
        if heading:
            level, name = len(heading[1]), heading[2].strip(" *_`").lower()
            open_now = [(depth, other) for depth, other in open_now if depth < level]
            open_now.append((level, name))
            sections.setdefault(name, [])
        else:
            for _, name in open_now:
                sections[name].append(line)
    return {name: "\n".join(lines) for name, lines in sections.items()}


def image_names(text: str) -> list[str]:
    """Return the addresses of the images in a Markdown text, as they stand there."""
    return [first or second for first, second in _IMAGE.findall(text)]


def _in_words(sections: dict[str, str], day: Day, guide: str, where: str) -> Item:
    """Check what is written: the definitions, and then the answers."""
    item = _definitions(sections, day.terms, guide, where)
    open_ones = _unanswered(sections.get("can you explain?", ""), day.questions)
    if not (open_ones and item.passed):
        return item
    numbers = ", ".join(map(str, open_ones))
    says = f"All {len(day.terms)} are there. Can you explain? {numbers}: "
    return Item("definitions", "todo", f"{says}answer below each question, in {where}.")


def _unanswered(section: str, number: int) -> list[int]:
    """Return the numbers of the questions without an answer in words.

    A question ends with the last question mark of its first paragraph; what comes
    after it is the answer.
    """
    found: list[list[str]] = []
    for line in section.splitlines():
        if _QUESTION.match(line):
            found.append([])
        if found:
            found[-1].append("" if _PROMPT.match(line) else line)
    answered = []
    for lines in found:
        first, _, rest = "\n".join(lines).partition("\n\n")
        answer = first.rpartition("?")[2] if "?" in first else ""
        answered.append(len(_words(f"{answer} {rest}")) >= FEWEST_ANSWER_WORDS)
    answered += [False] * (number - len(answered))
    return [i for i, done in enumerate(answered[:number], start=1) if not done]


def _definitions(
    sections: dict[str, str], terms: tuple[str, ...], guide: str, where: str
) -> Item:
    """Check that each term is defined, in a sentence, and not in the guide's words."""
    given = _shingles(_words(guide))
    empty, short, taken = [], [], []
    for term in terms:
        lines = sections.get(term.lower(), "").splitlines()
        words = _words(" ".join(ln for ln in lines if not _PROMPT.match(ln)))
        own = _shingles(words)
        if not words:
            empty.append(term)
        elif len(words) < FEWEST_WORDS:
            short.append(term)
        elif own and len(own & given) > TAKEN_OVER * len(own):
            taken.append(term)
    if not (empty or short or taken):
        return Item("definitions")
    done = len(terms) - len(empty) - len(short) - len(taken)
    says = [f"{done} of {len(terms)} in {where}."]
    if empty:
        says.append(f"Still empty: {', '.join(empty)}.")
    if short:
        says.append(f"Say it in a sentence ({FEWEST_WORDS} words): {', '.join(short)}.")
    if taken:
        says.append(f"The guide's words, not yours: {', '.join(taken)}.")
    untouched = len(empty) == len(terms)
    return Item("definitions", "todo" if untouched else "wrong", " ".join(says))


def _drawings(sections: dict[str, str], day: Day, folder: Path, where: str) -> Item:
    """Check that each drawing is an image of the student's, or drawn as text."""
    number = day.drawings
    missing: list[str] = []
    broken: list[str] = []
    kits: list[str] = []
    pictures = [day.folder / name for name in day.kit_figures]
    for index in range(1, number + 1):
        start = f"drawing {index}"
        text = next(
            (
                body
                for name, body in sections.items()
                if re.match(rf"{start}\b", name)  # "Drawing 1: the hand's frame"
            ),
            "",
        )
        images = image_names(text)
        there = [name for name in images if _is_image(name, folder)]
        own = [name for name in there if not _is_one_of(pictures, name, folder)]
        if own or _is_drawn(text):
            continue
        (kits if there else broken if images else missing).append(str(index))
    if not (missing or broken or kits):
        return Item("drawings")
    done = number - len(missing) - len(broken) - len(kits)
    says = [f"{done} of {number} in {where}."]
    if missing:
        says.append(
            f"Drawing {', '.join(missing)}: add ![](photo.jpg), or draw it as text, "
            f"of {DRAWN_LINES} lines or more, between two lines of ```."
        )
    if broken:
        says.append(f"Drawing {', '.join(broken)}: its image file is not there.")
    if kits:
        says.append(f"Drawing {', '.join(kits)}: the kit's picture; draw your own.")
    untouched = len(missing) == number
    return Item("drawings", "todo" if untouched else "wrong", " ".join(says))


def _checklist(sections: dict[str, str], where: str) -> Item:
    """Check that every box is ticked."""
    boxes = [
        (box[1] != " ", box[2])
        for line in sections.get("checklist", "").splitlines()
        if (box := _BOX.match(line))
    ]
    if not boxes:
        return Item("checklist", "wrong", f"{where} has no checklist: put it back.")
    left = [text for ticked, text in boxes if not ticked]
    if not left:
        return Item("checklist")
    says = f"{len(boxes) - len(left)} of {len(boxes)} ticked in {where}."
    return Item("checklist", "todo", f"{says} Next: {left[0]}")


def _is_image(name: str, folder: Path) -> bool:
    """Return whether an image's address leads to a file with something in it."""
    if re.match(r"https?:|data:image/", name):
        return True
    try:
        return (folder / name.replace("%20", " ")).stat().st_size > 0
    except (OSError, ValueError):
        return False


def _is_one_of(pictures: list[Path], name: str, folder: Path) -> bool:
    """Return whether an image is one of the kit's, even under another name."""
    try:
        data = (folder / name.replace("%20", " ")).read_bytes()
    except (OSError, ValueError):
        return False
    return any(path.is_file() and path.read_bytes() == data for path in pictures)


def _is_drawn(text: str) -> bool:
    """Return whether a fenced block holds a drawing made of characters."""
    fenced, lines = False, 0
    for line in text.splitlines():
        if _FENCE.match(line):
            fenced = not fenced
        elif fenced and line.strip():
            lines += 1
    return lines >= DRAWN_LINES


def _words(text: str) -> list[str]:
    return re.findall(r"[^\W_]+", text.lower())


def _shingles(words: list[str]) -> set[tuple[str, ...]]:
    return {tuple(words[i : i + SHINGLE]) for i in range(len(words) - SHINGLE + 1)}
