"""The commands and counts that the log's messages name."""

from labkit.base.words import OWN_LOG, command, count
from robo47.paths import ROOT


def test_a_command_names_a_log_that_is_not_the_kits_own():
    start = "python3 scripts/log_metric.py --check"
    assert command("--check", OWN_LOG) == start
    assert command("--check", ROOT / "a.csv") == f"{start} --file a.csv"
    spaced = ROOT.parent / "my logs" / "a.csv"
    assert command("--check", spaced) == f'{start} --file "{spaced}"'


def test_a_count_agrees_with_its_noun():
    assert [count(n, "row") for n in (0, 1, 1000)] == ["0 rows", "1 row", "1,000 rows"]
