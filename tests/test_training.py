"""The steps of a training: counted, and shown as a bar on a terminal alone."""

import io

from labkit.lesson.training import training


class Terminal(io.StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self):
        return True


def test_the_steps_are_counted_from_1_and_a_file_sees_nothing():
    stream = io.StringIO()
    assert list(training("it", 4, stream)) == [1, 2, 3, 4]
    assert stream.getvalue() == ""


def test_a_terminal_shows_a_bar_that_is_gone_at_the_end(monkeypatch):
    clock = iter(range(100))
    monkeypatch.setattr("labkit.lesson.training.time.monotonic", lambda: next(clock))
    stream = Terminal()
    assert sum(training("the clone", 4, stream)) == 10
    shown = stream.getvalue().split("\r")
    assert "training the clone [" in shown[1]
    assert shown[1].endswith("  0 %")
    assert "50 %" in shown[3]
    assert shown[3].count("#") == 15
    assert shown[-2:] == ["\x1b[2K", ""] or shown[-2].endswith("\x1b[2K")


def test_the_bar_is_gone_also_where_a_training_stops():
    stream = Terminal()
    steps = training("it", 4, stream)
    next(steps)
    steps.close()
    assert stream.getvalue().endswith("\x1b[2K\r")
