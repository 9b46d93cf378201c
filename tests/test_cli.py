"""How every command helps, paints, complains and ends."""

import errno
import io

import pytest

from labkit.base import cli
from robo47.errors import Robo47Error


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture(autouse=True)
def plain(monkeypatch):
    for name in ("NO_COLOR", "TERM", "COLUMNS"):
        monkeypatch.delenv(name, raising=False)


def end(main):
    with pytest.raises(SystemExit) as caught:
        cli.run(main)
    return caught.value.code


def fail(error):
    def main():
        raise error

    return main


def test_help_keeps_commands_and_wraps_sentences():
    about = (
        "Do it.\n\n    make it      the command\n\n" + "A long sentence. " * 9 + "\n"
    )
    text = cli.parser(about).format_help()
    assert "    make it      the command\n" in text
    assert max(map(len, text.splitlines())) <= 80
    assert cli.parser(None).format_help()


@pytest.mark.parametrize(
    ("name", "value", "painted"),
    [(None, "", True), ("NO_COLOR", "1", False), ("TERM", "dumb", False)],
)
def test_colour_is_for_terminals_that_want_it(monkeypatch, name, value, painted):
    if name:
        monkeypatch.setenv(name, value)
    assert ("\x1b" in cli.paint("PASS", "good", Terminal())) == painted
    assert cli.paint("PASS", "good", io.StringIO()) == "PASS"


def test_an_error_is_wrapped_for_people_and_one_line_for_programs(monkeypatch, capsys):
    long = "what is wrong and what to do next " * 5
    assert end(fail(Robo47Error(long))) == 2
    assert capsys.readouterr().err == f"error: {long}\n"
    terminal = Terminal()
    monkeypatch.setattr("sys.stderr", terminal)
    end(fail(Robo47Error(long)))
    assert max(map(len, terminal.getvalue().splitlines())) < 80
    assert terminal.getvalue().split() == f"error: {long}".split()


@pytest.mark.parametrize(
    ("error", "code", "says"),
    [
        (NotImplementedError("task 1.1: write make_T"), 1, "to do: task 1.1"),
        (PermissionError(errno.EACCES, "Not yours", "/x"), 2, "error: /x: Not yours"),
        (OSError(errno.ENOSPC, "Disk full"), 2, "error: the output: Disk full"),
        (KeyboardInterrupt(), 130, "stopped"),
    ],
)
def test_what_a_user_can_meet_ends_in_a_line(capsys, monkeypatch, error, code, says):
    monkeypatch.setattr(cli, "print_nowhere", lambda: None)
    assert end(fail(error)) == code
    assert says in capsys.readouterr().err


def test_a_mistake_of_ours_is_not_hidden():
    with pytest.raises(OSError, match="stale"):
        cli.run(fail(OSError(errno.ESTALE, "stale handle", "/x")))
