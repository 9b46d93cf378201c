"""Slips that show in the text of a function."""

import pytest

from labkit.check.source import renamed, unfinished

DOC = '    """Return it."""\n'
GAP = '    raise NotImplementedError("task 1.2: write f")\n'


@pytest.mark.parametrize(
    ("body", "says"),
    [
        (GAP + "    return 1\n", "line 3"),
        ("    y = 1\n" + GAP + "    return y\n", "line 4"),
        ("    pass\n", "does nothing"),
    ],
)
def test_what_keeps_a_function_from_doing_anything_is_said(body, says):
    assert says in unfinished(f"def f():\n{DOC}{body}", "f")


@pytest.mark.parametrize("body", [GAP, "    return 1\n", "    print(1)\n"])
def test_a_plain_gap_or_code_without_a_slip_is_no_slip(body):
    assert unfinished(f"def f():\n{DOC}{body}", "f") == ""


def test_a_function_that_is_gone_or_does_not_parse_is_no_slip():
    assert unfinished("x = 1\n", "f") == ""
    assert unfinished("def f(:\n    pass\n", "f") == ""


def test_a_renamed_function_is_found_again():
    source = "x = 1\ndef rz(t):\n    return t\ndef exp_rotation(w):\n    return w\n"
    assert "but rz (line 2): did you mean Rz?" in renamed(source, "Rz")
    assert renamed(source, "log_rotation") == ""
