"""What comes back from a student's file, and what a file that does not load is told."""

import numpy as np
import pytest

from robo47.checker import process
from robo47.checker.replies import LoadError, Model, Question
from robo47.lesson.day import find_day

REFERENCE = find_day(1).source.read_text("utf-8")


class TestWhatComesBack:
    def test_is_what_the_function_returned_bit_for_bit(self, ask):
        (reply,) = ask("import numpy as np\ndef f(): return np.array([[0.1, -0.0]])")
        assert reply.value.dtype == np.float64
        assert reply.value.tobytes() == np.array([[0.1, -0.0]]).tobytes()

    @pytest.mark.parametrize("code", ["i8", "f4", "f2", "b1", "u1"])
    def test_keeps_its_number_type_for_the_judge_to_see(self, ask, code):
        (reply,) = ask(f"import numpy as np\ndef f(): return np.ones(3, '{code}')")
        assert reply.value.dtype == np.dtype(code)

    def test_may_be_a_tuple_a_list_a_number_or_nothing(self, ask):
        code = """
            import numpy as np
            def f(): return np.ones(3), np.zeros(3)
            def g(): return [[1.0, 2.0], [3.0, 4.0]]
            def h(): return 2.5
            def i(): pass
        """
        pair, rows, number, nothing = ask(
            code, *(Question("1.1", name, ()) for name in "fghi")
        )
        assert [part.tolist() for part in pair.value] == [[1, 1, 1], [0, 0, 0]]
        assert rows.value.tolist() == [[1, 2], [3, 4]]
        assert number.value == 2.5
        assert nothing.value is None
        assert not nothing.kind

    @pytest.mark.parametrize(
        ("value", "says"),
        [
            ("'PASSED'", "a str; expected a NumPy array"),
            ("np.array(['a'])", "dtype"),
            ("np.array([object()])", "dtype object"),
            ("np.ones(4, complex)", "dtype complex128"),
            ("np.ones(200_000)", "far too large"),
            ("[[1, 2], [3]]", "a list that is no array"),
        ],
    )
    def test_is_refused_where_it_is_no_plain_array(self, ask, value, says):
        (reply,) = ask(f"import numpy as np\ndef f(): return {value}")
        assert reply.kind == "unsendable"
        assert says in reply.error

    def test_names_the_line_of_the_students_own_file(self, ask):
        (reply,) = ask(
            "import numpy as np\ndef f():\n    return np.ones(3) @ np.eye(4)"
        )
        assert reply.kind == "ValueError"
        assert reply.line == 3

    def test_leaves_what_was_printed_aside(self, ask):
        (reply,) = ask("def f():\n    print('PASSED')\n    return 1.0")
        assert reply.printed == "PASSED"
        assert reply.value == 1

    def test_gets_fresh_arguments_at_every_call(self, ask):
        code = "def f(model, q):\n    model.body_pos[:] = 7\n    q += 1\n    return q"
        question = Question("1.6", "f", (Model(0), np.zeros(2)))
        first, second = ask(code, question, question)
        assert first.value.tolist() == second.value.tolist() == [1, 1]

    def test_may_use_a_module_of_the_students_beside_the_file(self, ask, student):
        student("def g(): return 3.0", "helpers.py")
        (reply,) = ask("import helpers\ndef f(): return helpers.g()")
        assert reply.value == 3


class TestAFileThatDoesNotLoad:
    @pytest.mark.parametrize(
        ("code", "kind", "line"),
        [
            ("def f()\n    return 1", "SyntaxError", 1),
            ("def f():\nreturn 1", "IndentationError", 2),
            ("import nothing_of_that_name", "ModuleNotFoundError", 1),
            ("x = 1\ny = 1 / 0", "ZeroDivisionError", 2),
            ("import sys\nsys.exit(0)", "SystemExit", 2),
            ("raise KeyboardInterrupt", "KeyboardInterrupt", 1),
        ],
    )
    def test_is_told_with_its_line(self, ask, code, kind, line):
        with pytest.raises(LoadError) as caught:
            ask(code)
        assert (caught.value.reply.kind, caught.value.reply.line) == (kind, line)

    @pytest.mark.parametrize(
        "code", ["import os\nos._exit(0)", "\0", "while True: pass"]
    )
    def test_is_told_without_a_line_where_there_is_none(self, ask, code, monkeypatch):
        monkeypatch.setattr(process, "LOAD_SECONDS", 1.0)
        with pytest.raises(LoadError) as caught:
            ask(code)
        assert caught.value.reply.error

    def test_fails_every_task_and_passes_none(self, check):
        verdicts = check("import sys\nsys.exit(0)\n" + REFERENCE)
        assert {verdict.mistake for verdict in verdicts.values()} == {"does-not-load"}
