"""Plagiarism hints: submissions that are alike, as places to look, never a verdict.

A submission becomes the set of its runs of LENGTH tokens, with names made
equal, so that renaming hides nothing. What the starter gives, and what much of
the class writes (there are few ways to type a rotation about z), counts for nobody; the
rest is compared. After Schleimer, Wilkerson and Aiken, "Winnowing", SIGMOD 2003.
The kit's own solution is looked for function by function, so that what else a file
holds hides nothing; and a task that passes while its function stands nowhere is told.

Nothing here parses a submission as Python: a text can end the parser.
"""

import builtins
import keyword
import re
import unicodedata
import zlib
from array import array
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TypeAlias

LENGTH = 8  # tokens in a run
FEWEST = 24  # runs of one's own: less is too little to compare
COMMON = 0.1  # share of the class: a run that more students have is common
FEW = 4  # a run that at most so many have is kept in a class of any size
ALIKE = 0.6  # share of the smaller submission's runs
KITS = 0.8  # share of one's own runs that are in the kit's; right answers have a third

DATA = 600  # characters of text constants of one's own: an honest file has fewer
LONG_NUMBER = 100  # digits: a number of more is data
_READS_DOCSTRINGS = ("__doc__", "getdoc", "__file__", "getsource")

Runs: TypeAlias = "array[int]"  # hashes, as `runs_of` gives them
_TOKEN = re.compile(
    r"(?P<comment>#[^\n]*)"
    r"|(?P<text>\"\"\"(?:\\.|[^\\])*?(?:\"\"\"|\\?\Z)"
    r"|'''(?:\\.|[^\\])*?(?:'''|\\?\Z)"
    r"|\"(?:\\.|[^\"\\\n])*\"?|'(?:\\.|[^'\\\n])*'?)"  # a text without an end, too
    r"|(?P<name>\.?[^\W\d]\w*)"
    r"|(?P<other>\d[\w.]*|\S)",
    re.DOTALL,
)
_PADDING = (";", "pass")  # may stand anywhere and does nothing
# These names run a text as code, or lead to such a name; some are given as texts.
_RUNS_TEXT = {"exec", "eval", "compile", "builtins", "importlib", "runpy", "codeop"}
_RUNS_TEXT |= {"InteractiveInterpreter", "InteractiveConsole", "ForwardRef"}
_RUNS_TEXT |= {"marshal", "pickle", "FunctionType", "CodeType"}
_LEADS = {"import", "builtins", "self", "globals", "dict", "code", "subclasses"}
_LEADS |= {"reduce", "loader"}
_RUNS_TEXT |= {f"__{name}__" for name in _LEADS}
_KEPT = frozenset(keyword.kwlist) | frozenset(dir(builtins))


@dataclass(frozen=True)
class Group:
    """Submissions to look at side by side; each is like at least one of the others."""

    keys: tuple[str, ...]  # the students' keys, sorted
    # The fraction of the smaller one's runs that the other has too, in the most similar
    # two.
    share: float
    with_kit: bool = False  # one of them is the kit's own solution, which has no key


def runs_of(source: bytes, starter: str) -> Runs:
    """Return the hashes of a script's runs of tokens, without the starter's.

    Args:
        source: the script, whatever it holds.
        starter: what the student was given.
    """
    own = _hashes(tokens(source.decode("utf-8", "replace")))
    return array("L", sorted(own - _hashes(tokens(starter))))


def tokens(text: str) -> list[str]:
    """Return a script's tokens: no comments, and all texts and all names made equal.

    Args:
        text: Python, or anything else. Keywords, builtins and attributes stay.
    """
    found = []
    for match in _TOKEN.finditer(text):
        token = match[0]
        if match.lastgroup == "comment" or token in _PADDING:
            continue
        if match.lastgroup == "text":
            token = "''"
        elif match.lastgroup == "name" and token[0] != "." and token not in _KEPT:
            token = "n"
        found.append(token)
    return found


def functions_of(text: str) -> dict[str, str]:
    """Return a script's functions at the left margin, by name, as texts.

    Args:
        text: Python, or anything else. What stands in a text of its own is none.
    """
    found: dict[str, str] = {}
    begun = list(_margin(text))
    ends = [*(at for at, _ in begun[1:]), len(text)]
    for (at, words), end in zip(begun, ends, strict=False):
        if words[:1] == ["def"] or words[1:3] == ["=", "lambda"]:
            name = "".join(words[1:2] if words[0] == "def" else words[:1])
            found[name] = found.get(name, "") + text[at:end]
        elif words[:1] in (["from"], ["import"]):  # may take a function's place
            taken = [match[0] for match in _TOKEN.finditer(text, at, end)]
            found = (
                {} if "*" in taken else {n: found[n] for n in found if n not in taken}
            )
        elif words[1:2] == ["="]:
            found.pop(words[0], None)
    return found


def _margin(text: str) -> Iterator[tuple[int, list[str]]]:
    """Yield where something begins at the left margin, and its first three tokens."""
    at, words = -1, list[str]()
    for match in _TOKEN.finditer(text):
        if match.lastgroup == "comment":
            continue
        at_margin = text[match.start() - 1 : match.start()] in ("\n", "\r", "")
        if at_margin and match[0] not in ")]}":
            if at >= 0:
                yield at, words
            at, words = match.start(), []
        if len(words) < 3:
            words.append(unicodedata.normalize("NFKC", match[0]))
    if at >= 0:
        yield at, words


def hidden(
    texts: Sequence[str], names: Sequence[tuple[str, ...]], starter: str = ""
) -> list[str]:
    """Return what a submission's text does not show, in words.

    Args:
        texts: of its files.
        names: of each function that passes, and what it may be called as well.
        starter: what the student was given; its text constants are nobody's.
    """
    there = {name for text in texts for name in functions_of(text)}
    found = [f"no function {some[0]}" for some in names if there.isdisjoint(some)]
    words = [match[0] for text in texts for match in _TOKEN.finditer(text)]
    words += [word for text in texts for word in re.findall(r"__\w+?__", text)]
    plain = {unicodedata.normalize("NFKC", word).lstrip(".") for word in words}
    runs = sorted(_RUNS_TEXT & plain) if names else []
    found += [f"a text can run as code: {word}" for word in runs]
    given = set(constants(starter))
    own = {word for text in texts for word in constants(text)} - given
    size = sum(map(len, own)) if names else 0
    if size > DATA:
        found.append(f"{size:,} characters of text constants that are no docstrings")
    return found


def constants(text: str) -> list[str]:
    """Return a script's text constants and long numbers, without its docstrings.

    A docstring is a text on a line of its own, first in a file or after a colon that
    stands in no bracket. It counts as a constant where the script reads docstrings.
    """
    found, before, depth = list[str](), "", 0
    reads = any(word in text for word in _READS_DOCSTRINGS)
    for match in _TOKEN.finditer(text):
        if match.lastgroup == "comment":
            continue
        is_text = match.lastgroup == "text"
        line = text.rfind("\n", 0, match.start()) + 1
        begins_line = is_text and not text[line : match.start()].strip()
        may_be = begins_line and before in ("", ":") and depth == 0
        is_docstring = is_text and may_be and not reads
        is_long = match.lastgroup == "other" and len(match[0]) > LONG_NUMBER
        if (is_text and not is_docstring) or is_long:
            found.append(match[0])
        before = match[0]
        depth += (before in ("(", "[", "{")) - (before in (")", "]", "}"))
    return found


def like_the_kit(
    runs: Mapping[str, Sequence[Runs]],
    kit: Runs,
    functions: Sequence[Runs] = (),
) -> list[Group]:
    """Return whose files have what the kit's own solution has, the most alike first.

    However many copy it, so not by what much of the class writes.

    Args:
        runs: of each of a submission's files.
        kit: of the solution, and of the library that has it.
        functions: of each function of the solution: what else a file has, beside
            those that stand in it, is not looked at.
    """
    solution = set(kit)
    parts = [set(one) for one in functions]
    whole = max(1, sum(map(len, parts)))
    groups = []
    for key, files in runs.items():
        shares = [
            len(solution.intersection(own)) / len(own)
            for own in files
            if len(own) >= FEWEST
        ]
        share = max(shares, default=0.0)
        everything = set[int]().union(*files)
        by_parts = sum(len(part & everything) for part in parts) / whole
        if share >= KITS or by_parts >= ALIKE:
            groups.append(Group((key,), max(share, by_parts), with_kit=True))
    return sorted(groups, key=lambda g: (-g.share, g.keys))


def similar_groups(runs: Mapping[str, Runs]) -> list[Group]:
    """Return the submissions worth a look, the most similar first.

    Args:
        runs: of each submission.
    """
    count = Counter(run for own in runs.values() for run in own)
    most = max(FEW, int(COMMON * len(runs)))
    rare = {
        key: [run for run in own if count[run] <= most] for key, own in runs.items()
    }
    owners: dict[int, list[str]] = defaultdict(list)
    for key, own in rare.items():
        if len(own) >= FEWEST:
            for run in own:
                owners[run].append(key)
    shared = Counter(
        pair for keys in owners.values() for pair in combinations(sorted(keys), 2)
    )
    group_of: dict[str, dict[str, float]] = {}  # each one's group, with the shares
    for (first, second), number in shared.items():
        share = number / min(len(rare[first]), len(rare[second]))
        if share >= ALIKE:
            merged = group_of.get(first, {}) | group_of.get(second, {})
            for key in (first, second):
                merged[key] = max(share, merged.get(key, 0.0))
            group_of |= dict.fromkeys(merged, merged)
    whole = {id(group): group for group in group_of.values()}.values()
    groups = [Group(tuple(sorted(g)), max(g.values())) for g in whole]
    return sorted(groups, key=lambda g: (-g.share, -len(g.keys), g.keys))


def _hashes(found: list[str]) -> set[int]:
    """Return a hash per run; the same in every process, unlike Python's own."""
    return {
        zlib.crc32("\0".join(found[i : i + LENGTH]).encode("utf-8", "replace"))
        for i in range(len(found) - LENGTH + 1)
    }
