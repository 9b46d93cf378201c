"""A log with another first line: each cause by its name, and no column exchanged."""

import csv
import io

import pytest

from labkit.log.convert import convert
from labkit.log.rows import BOM, COLUMNS, HEADER
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
    if word == "column seed is missing":
        assert "would exchange them" in str(caught.value)


CELLS = [
    "",
    "2026-11-28",
    "1",
    "c",
    "",
    "47",
    "",
    "m",
    "1000",
    "0",
    "x",
    "2.5e-16",
    "a,b",
]
OWN = dict(zip(COLUMNS, CELLS, strict=True))


def as_csv(names, mark=",", quoting=csv.QUOTE_MINIMAL, **more):
    """Return a log of one row in another form."""
    row = {**OWN, **more}
    text = io.StringIO()
    writer = csv.writer(text, delimiter=mark, quoting=quoting, lineterminator="\n")
    writer.writerows([names, [row.get(name.lower(), "") for name in names]])
    return text.getvalue()


UPPER = [name.upper() for name in COLUMNS]
FORMS = {
    "semicolons with a decimal comma": as_csv(COLUMNS, ";", value="2,5e-16").encode(),
    "a line of Excel's": b"sep=;\n" + as_csv(COLUMNS, ";").encode(),
    "tabs": as_csv(COLUMNS, "\t").encode(),
    "quotes": as_csv(COLUMNS, quoting=csv.QUOTE_ALL).encode(),
    "capitals": as_csv(UPPER).encode(),
    "another order": as_csv(SWAPPED.split(",")).encode(),
    "a further column": as_csv([*COLUMNS, "mine"]).encode(),
    "UTF-16": as_csv(COLUMNS, "\t").encode("utf-16"),
    "CR alone": as_csv(COLUMNS).replace("\n", "\r").encode(),
    "two marks": BOM + BOM + as_csv(COLUMNS).encode(),
}


@pytest.mark.parametrize("form", FORMS)
def test_another_form_is_converted_and_the_old_file_is_kept(tmp_path, run, form):
    log = tmp_path / "metrics.csv"
    log.write_bytes(FORMS[form])
    with pytest.raises(Robo47Error, match="--convert"):
        list(scan(log))
    done = run("scripts/log_metric.py", "--convert", "--file", log)
    assert "1 row written" in done.stdout
    (row,) = [line.row for line in scan(log)]
    assert (row["n_trials"], row["n_failures"]) == (1000, 0)
    assert row["value"] == 2.5e-16
    assert row["notes"] == "a,b"
    (kept,) = tmp_path.glob("*before-convert*")
    assert kept.read_bytes() == FORMS[form]


@pytest.mark.parametrize(
    ("text", "word"),
    [
        (as_csv([name for name in COLUMNS if name != "seed"]), "seed is missing"),
        (as_csv([*COLUMNS, "seed"]), "seed stands twice"),
        (as_csv(COLUMNS, ";") + "1;2\n", "Line 3: it has 2 cells"),
        ("<<<<<<< HEAD\n" + as_csv(COLUMNS), "conflict marks"),
        (as_csv(COLUMNS, ";", seed="many"), "Line 2"),
    ],
)
def test_what_is_not_certain_is_not_converted(tmp_path, text, word):
    log = tmp_path / "metrics.csv"
    log.write_text(text, "utf-8")
    with pytest.raises(Robo47Error, match=word):
        convert(log)
    assert log.read_text("utf-8") == text
    assert list(tmp_path.iterdir()) == [log]
