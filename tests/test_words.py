"""No text that a person reads uses a word in a sense that its readers do not know.

The words and the exceptions are in `words.toml`. Texts are Markdown, docstrings, the
help of commands, what labs print, the texts of a day.toml, and the sentences of the
mistakes, as they are loaded.
"""

import ast
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from fnmatch import fnmatch
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from conftest import ROOT
from labkit.judge.answer_mistakes import GENERAL, OF_A_ROTATION, of_a_pose
from labkit.judge.answers import as_clause, capitalised
from labkit.judge.row import rows_of
from labkit.lesson.day import Day, all_days

LISTED = tomllib.loads((Path(__file__).parent / "words.toml").read_text("utf-8"))
BANNED = {re.compile(word, re.I): use for word, use in LISTED["banned"].items()}
ANY = re.compile("|".join(f"(?:{word.pattern})" for word in BANNED), re.I)
CODE = re.compile(
    r"(?s)```.*?```|<!-- (?:run|table).*?<!-- end -->|`[^`]*`|\$\$.*?\$\$|\$[^$\n]*\$"
    r"|\]\([^)]*\)|<[^>]+>"
)
PRINTS = {"print", "step", "check", "record", "measured", "predict", "show", "help"}


class Text(NamedTuple):
    """What a person reads, and where it is."""

    path: str
    kind: str  # "markdown", "docstring", "printed", "manifest" or "mistake"
    line: int
    text: str


def faults(texts: Iterator[Text]) -> list[str]:
    """Return a line for each banned word, with the words to use."""
    found = []
    for path, kind, line, raw in texts:
        text = " ".join(raw.split())
        if ANY.search(text) and not excepted(path, kind):
            for word, use in BANNED.items():
                for hit in word.finditer(text):
                    near = text[max(0, hit.start() - 30) : hit.end() + 30]
                    where = f"{path}:{line}" if line else path
                    found.append(f"{where} ({kind}): ...{near}...: write {use}")
    return found


@cache
def excepted(path: str, kind: str) -> bool:
    """Return whether an exception of `words.toml` names a text."""
    return any(
        one.get("kind", kind) == kind
        and any(fnmatch(path, name + "*" * name.endswith("/")) for name in named(one))
        for one in LISTED["exceptions"]
    )


def named(exception: dict[str, str]) -> list[str]:
    """Return the patterns of an exception's path, "a{b,c}.py" as two."""
    before, mark, rest = exception["path"].partition("{")
    if not mark:
        return [before]
    names, _, after = rest.partition("}")
    return [before + name + after for name in names.split(",")]


def files(*ends: str) -> list[Path]:
    """Return the repository's files whose names end so; the student's are none."""
    command = ["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard"]
    listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    paths = [ROOT / name for name in listed.splitlines() if name.endswith(ends)]
    return [path for path in paths if path.is_file()]


def markdown(path: Path) -> Iterator[Text]:
    text = CODE.sub(" ", path.read_text("utf-8"))
    yield Text(name_of(path), "markdown", 0, text)


def python(path: Path) -> Iterator[Text]:
    """Return docstrings, and the text that is printed or is a command's help."""
    name = name_of(path)
    if all(excepted(name, kind) for kind in ("docstring", "printed")):
        return
    source = path.read_text("utf-8")
    if not ANY.search(" ".join(source.split())):  # in a hundredth of the time
        return
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            is_command = "labkit/commands/" in name and isinstance(node, ast.Module)
            kind = "printed" if is_command else "docstring"  # a command's is its help
            text = ast.get_docstring(node) or ""
            yield Text(name, kind, getattr(node, "lineno", 1), CODE.sub(" ", text))
        elif isinstance(node, ast.Call) and called(node) in PRINTS | {"add_argument"}:
            for one in ast.walk(node):
                if isinstance(one, ast.Constant) and isinstance(one.value, str):
                    yield Text(name, "printed", one.lineno, one.value)


def called(call: ast.Call) -> str:
    return getattr(call.func, "attr", getattr(call.func, "id", ""))


def manifest(path: Path) -> Iterator[Text]:
    def strings(value: Any) -> Iterator[str]:
        if isinstance(value, str):
            yield value
        elif isinstance(value, dict | list):
            for one in value.values() if isinstance(value, dict) else value:
                yield from strings(one)

    for text in strings(tomllib.loads(path.read_text("utf-8"))):
        yield Text(name_of(path), "manifest", 0, text)


def mistakes(day: Day) -> Iterator[Text]:
    """Return the sentences of a day's mistakes, from its loaded rows."""
    for function, row in rows_of(day).items():
        name = file_of(day, function)
        for way in row.ways if not excepted(name, "mistake") else ():
            yield Text(name, "mistake", 0, way.says)


def file_of(day: Day, function: str) -> str:
    return f"{day.folder.name}/day{day.number}/{function}.py"


def name_of(path: Path) -> str:
    return (path.relative_to(ROOT) if ROOT in path.parents else path).as_posix()


READ = {".md": markdown, ".py": python, ".toml": manifest}


@pytest.mark.kit
@pytest.mark.parametrize("end", [".md", ".py", "day.toml"])
def test_no_text_uses_a_banned_word(end):
    paths = [path for path in files(end) if "tests/" not in name_of(path)]
    read = READ[Path(f"x{end}").suffix if end != "day.toml" else ".toml"]
    assert faults(text for path in paths for text in read(path)) == []


@pytest.mark.kit
def test_no_sentence_of_a_mistake_uses_a_banned_word():
    days = [day for day in all_days() if not excepted(file_of(day, "any"), "mistake")]
    assert faults(text for day in days for text in mistakes(day)) == []


@pytest.mark.kit
def test_a_mistakes_sentence_is_about_the_students_code():
    """Without "your", "the ratio is in per cent" reads as what the task asks for."""
    says = {one.text for day in all_days() for one in mistakes(day) if one.text}
    says |= {one.says for one in (*GENERAL, *OF_A_ROTATION, *of_a_pose())}
    assert [text for text in sorted(says) if not re.search(r"\b[Yy]our\b", text)] == []


def test_each_kind_of_text_is_read(tmp_path):
    """An exception hides nothing of a file that it does not name."""
    word = "This hangs on\n    the sign."
    script = f'"""{word}"""\nprint("Once more.")\n'
    for name, text, kinds in (
        ("a.md", f"{word} `in vain`", ["markdown"]),
        ("a.py", script, ["docstring", "printed"]),
        ("day.toml", 'a = "A bell"\nb = [{c = ["In vain"]}]\n', ["manifest"] * 2),
    ):
        path = tmp_path / name
        path.write_text(text)
        found = faults(READ[path.suffix](path))
        assert [line.partition("(")[2].partition(")")[0] for line in found] == kinds


def test_the_sentences_of_mistakes_are_read_as_loaded(monkeypatch):
    monkeypatch.setattr(sys.modules[__name__], "excepted", lambda path, kind: False)
    texts = list(mistakes(all_days()[0]))
    assert len({text.path for text in texts}) > 5
    assert sum(bool(text.text) for text in texts) > 30


def test_each_exception_names_a_file_and_a_reason():
    known = [name_of(path) for path in files("")]
    for one in LISTED["exceptions"]:
        patterns = [name + "*" * name.endswith("/") for name in named(one)]
        assert all(any(fnmatch(path, name) for path in known) for name in patterns)
        assert len(one["why"]) > 20


def test_a_mistakes_sentence_can_go_on_after_a_place_and_a_symbol_stays_what_it_is():
    for day in all_days():
        for function, row in rows_of(day).items():
            for says in (way.says for way in row.ways):
                clause = as_clause(capitalised(says))
                assert clause == says, (
                    f"{function}: put the symbol in backticks: {says}"
                )
