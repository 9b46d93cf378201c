"""A log with another first line: each cause by its name, and no column exchanged."""

import pytest

from labkit.log.rows import COLUMNS, HEADER
from labkit.log.scan import scan
from robo47.errors import Robo47Error

SWAPPED = HEADER.replace("n_trials,n_failures", "n_failures,n_trials")
ROW = "," * 12
CASES = {
    "separated by ';'": HEADER.replace(",", ";").encode(),
    "separated by tabs": HEADER.replace(",", "\t").encode(),
    "quoted": ",".join(f'"{name}"' for name in COLUMNS).encode(),
    "capitals": HEADER.upper().encode(),
    "another order": SWAPPED.encode(),
    "more columns": f"{HEADER},,".encode(),
    "column seed is missing": HEADER.replace("seed,", "").encode(),
    "UTF-16": HEADER.encode("utf-16"),
    "NUL": b"\0" * 40,
    "CR alone": f"{HEADER}\r{ROW}\r".encode(),
    "LFS": b"version https://git-lfs.github.com/spec/v1\n",
    "conflict": f"<<<<<<< HEAD\n{HEADER}\n".encode(),
    "above the rows": f"{ROW}\n{ROW}\n".encode(),
}


@pytest.mark.parametrize("word", CASES)
def test_another_first_line_is_named(tmp_path, word):
    log = tmp_path / "log.csv"
    log.write_bytes(CASES[word] + (b"" if word == "CR alone" else b"\n"))
    with pytest.raises(Robo47Error, match=word) as caught:
        list(scan(log))
    if word in ("another order", "column seed is missing"):
        assert "would exchange them" in str(caught.value)
