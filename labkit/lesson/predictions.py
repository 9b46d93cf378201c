"""Predictions of a worksheet: what the student wrote before anything was run."""

import re

_OPEN = re.compile(r"\*\([^*]*\)\*|[._\s…-]*")  # the template's own words, or none


def predictions(worksheet: str) -> dict[str, str]:
    """Return {number: predicted} of the rows that have a prediction.

    A row is `| number | predicted | measured | why apart |`.
    """
    found = {}
    for line in worksheet.splitlines():
        cells = [cell.strip() for cell in line.strip().split("|")]
        if len(cells) == 6 and not _OPEN.fullmatch(cells[2]):  # "" at both ends
            found[cells[1].replace("`", "")] = cells[2]
    return found
