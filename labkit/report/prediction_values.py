"""A worksheet's predictions as numbers, each with the measured value."""

import math
import re
from typing import NamedTuple

from labkit.handin.worksheet import split_sections
from labkit.lesson.predictions import predictions

_RUN = re.compile(r" \(run of \d\d:\d\d\)$")  # the end of a cell that a run wrote
LONGEST = 120  # characters of a cell in which a number is searched
_NUMBER = re.compile(
    r"(?<![\w.^/-])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\d.]*\d)"
)
_POWER = re.compile(r"(?:(?<=\d)\s*[x*·×]\s*|(?<![\d.]))10\s?(?:\^|\*\*)\s?(?=[-+]?\d)")
_THOUSANDS = re.compile(r"(?<![\d.,])[1-9]\d{0,2}(?:,\d{3})+(?![\d,])")
# A range, a fraction, a formula: no single number.
_SEVERAL = re.compile(r"\d\s*(?:[-–—/*^]|to|and|or|\.\.+)\s*[-+.]?\d|\bpi\b|π|sqrt|√")


class Prediction(NamedTuple):
    """A row of the table that has a prediction."""

    number: str  # the predicted quantity, with its unit
    predicted: str  # the student's own text
    measured: str  # the text of a run or of the student; "" if the cell is open


def compared(worksheet: str) -> list[Prediction]:
    """Return the rows of its predictions that have one, with what was measured."""
    found = list[Prediction]()
    for line in split_sections(worksheet).get("predictions", "").splitlines():
        for number, predicted in predictions(line).items():
            came = line.split("|")[3]
            # By the same rule this cell is open or written.
            measured = predictions(f"|{number}|{came}|||").get(number, "")
            found.append(Prediction(number, predicted, _RUN.sub("", measured)))
    return found


def value_of(text: str) -> float | None:
    """Return the number of "about 40 mm"; None where it is not exactly one.

    The commas of "1,000" separate thousands, that of "0,125" is a decimal comma;
    "50 %" is 0.5, and "3 * 10^-4" is 0.0003.
    """
    plain = text[:LONGEST].replace("−", "-")
    plain = _THOUSANDS.sub(lambda it: it[0].replace(",", ""), plain)
    plain = re.sub(r"(?<=\d),(?=\d)", ".", plain)
    plain = _POWER.sub(lambda it: "e" if it[0][0] != "1" else "1e", plain)
    found = list(_NUMBER.finditer(plain))
    if len(found) != 1 or _SEVERAL.search(plain):
        return None
    percent = plain[found[0].end() :].lstrip().startswith("%")
    value = float(found[0][0]) / (100 if percent else 1)
    return value if math.isfinite(value) else None
