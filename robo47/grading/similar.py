"""Whose submissions are alike: a hint of where to look, never a verdict.

A submission becomes the set of its runs of LENGTH tokens, with names of the student's
own made equal, so that renaming hides nothing. What the starter gives, and what much of
the class writes (there are few ways to type a rotation about z), counts for nobody; the
rest is compared. After Schleimer, Wilkerson and Aiken, "Winnowing", SIGMOD 2003.
"""

import builtins
import keyword
import re
import zlib
from array import array
from collections import Counter, defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

LENGTH = 8  # tokens in a run
FEWEST = 24  # runs of one's own: less is too little to compare
COMMON = 0.1  # of the class: a run that more of them have is nobody's
FEW = 4  # but one that so few have is kept, in a class of any size
ALIKE = 0.6  # share of the smaller submission's runs

_TOKEN = re.compile(
    r"(?P<comment>#[^\n]*)"
    r"|(?P<text>\"\"\".*?\"\"\"|'''.*?'''|\"[^\"\n]*\"|'[^'\n]*')"
    r"|(?P<name>\.?[^\W\d]\w*)"
    r"|(?P<other>\d[\w.]*|\S)",
    re.DOTALL,
)
_KEPT = frozenset(keyword.kwlist) | frozenset(dir(builtins))


@dataclass(frozen=True)
class Pair:
    """Two submissions to look at.

    Attributes:
        first, second: their keys.
        share: of the smaller one's runs that the other has too, 0 to 1.
        runs: how many that are.
    """

    first: str
    second: str
    share: float
    runs: int


def runs_of(source: bytes, starter: str) -> "array[int]":
    """Return the hashes of a script's runs of tokens, without the starter's.

    Args:
        source: the script, whatever it holds.
        starter: what the student was given.
    """
    names = frozenset(re.findall(r"\w+", starter))
    own = _hashes(tokens(source.decode("utf-8", "replace"), names))
    return array("L", sorted(own - _hashes(tokens(starter, names))))


def tokens(text: str, names: frozenset[str]) -> list[str]:
    """Return a script's tokens: no comments, texts and own names made equal.

    Args:
        text: Python, or anything else.
        names: that are kept as they are; so are keywords, builtins and attributes.
    """
    found = []
    for match in _TOKEN.finditer(text):
        token = match[0]
        if match.lastgroup == "comment":
            continue
        if match.lastgroup == "text":
            token = "''"
        elif match.lastgroup == "name" and token[0] != "." and token not in _KEPT:
            token = token if token in names else "n"
        found.append(token)
    return found


def similar_pairs(runs: Mapping[str, "array[int]"]) -> list[Pair]:
    """Return the pairs worth a look, the most similar first.

    Args:
        runs: of each submission, as `runs_of` gives them.
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
    pairs = []
    for (first, second), number in shared.items():
        share = number / min(len(rare[first]), len(rare[second]))
        if share >= ALIKE:
            pairs.append(Pair(first, second, share, number))
    return sorted(pairs, key=lambda p: (-p.share, -p.runs, p.first, p.second))


def _hashes(found: list[str]) -> set[int]:
    """Return a hash per run; the same in every process, unlike Python's own."""
    return {
        zlib.crc32("\0".join(found[i : i + LENGTH]).encode("utf-8", "replace"))
        for i in range(len(found) - LENGTH + 1)
    }
