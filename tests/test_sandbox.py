"""What comes back from a student's file, and what that file may import."""

import contextlib
import sys
import threading

import numpy as np
import pytest

from labkit.base.exchange import Exchange, LoadError, Path, Question
from labkit.judge import Robot
from labkit.judge.worlds import Balls
from labkit.lesson.day import Limits
from labkit.sandbox import messages, process, sandbox
from robo47.errors import Robo47Error
from robo47.paths import ROOT

MAIN = "def main():\n    panda.load()\n\n\n"
GUARD = 'if __name__ == "__main__":\n    cli.run(main)\n'
LIBRARY = {
    f"robo47.{name}": (ROOT / "robo47" / f"{name}.py").read_text("utf-8")
    for name in ("se3", "checks", "was")
}


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
        assert rows.value == [[1, 2], [3, 4]]
        assert number.value == 2.5
        assert nothing.value is None
        assert not nothing.kind

    @pytest.mark.parametrize(
        ("value", "says"),
        [
            ("{'PASSED': 1}", "a dict; expected a NumPy array"),
            ("10**30", "an array of dtype object"),
            ("(((1.0, {}), 2.0), 3.0)", "a tuple that is no array of numbers"),
            ("(np.ones(60_000), np.ones(60_000))", "far too large together"),
            ("np.array(['a'])", "dtype"),
            ("np.array([object()])", "dtype object"),
            ("np.ones(4, complex)", "dtype complex128"),
            ("np.ones(200_000)", "far too large"),
            ("[[[[1, 2], [3]]]]", "a list that is no array of numbers"),
            ("[[1, 2], [3]] * 60", "a list that is no array of numbers"),
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

    def test_leaves_aside_what_the_file_prints_as_it_loads(self, ask):
        (reply,) = ask("print('PASSED', flush=True)\ndef f(): return 1.0")
        assert (reply.value, reply.again) == (1, 1)

    def test_gets_fresh_arguments_at_every_call(self, ask):
        code = "def f(model, q):\n    model.body_pos[:] = 7\n    q += 1\n    return q"
        question = Question("1.6", "f", (Robot(), np.zeros(2)))
        first, second = ask(code, question, question)
        assert first.value.tolist() == second.value.tolist() == [1, 1]


@pytest.mark.kit
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


@pytest.mark.kit
class TestASecondAsking:
    def test_comes_long_after_the_first_and_is_kept_beside_it(self, ask):
        code = """
            calls = []
            def f(n):
                calls.append(n)
                return 100.0 * len(calls) + n
        """
        questions = [Question("1.1", "f", (n,)) for n in (1, 2, 3)]
        replies = ask(code, *questions)
        assert [reply.value for reply in replies] == [101, 202, 303]
        # In reverse order, of the file loaded anew.
        assert [reply.again for reply in replies] == [301, 202, 103]

    def test_waits_for_a_file_that_loads_longer_than_a_call_may_take(
        self, ask, monkeypatch
    ):
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 0.3)
        code = "import time\ntime.sleep(0.6)\ndef f(n): return n"
        (reply,) = ask(code, Question("1.1", "f", (1.0,)))
        assert (reply.value, reply.again, reply.kind) == (1, 1, "")

    def test_of_a_file_that_loads_once_alone_says_so(self, ask, monkeypatch):
        monkeypatch.setattr(sandbox, "LOAD_SECONDS", 0.3)
        code = """
            import sys
            while hasattr(sys, "seen"): pass
            sys.seen = True
            def f(n): return n
        """
        (reply,) = ask(code, Question("1.1", "f", (1.0,)))
        assert reply.kind == "stopped"
        assert "loaded once more: it does not end" in reply.error

    def test_that_goes_wrong_alone_says_how(self, ask):
        code = """
            import numpy as np
            NUMBERS = np.ones(3)
            seen = set()
            def f(n):
                if n == 2 and seen: return 1.0
                if n == 1 and seen: raise ValueError("again")
                seen.add(n)
                return 1.0
        """
        first, second = ask(code, *(Question("1.1", "f", (n,)) for n in (1, 2)))
        assert (first.kind, first.again_error) == ("", "ValueError: again")
        assert second.again_error == ""

    @pytest.mark.parametrize(
        ("body", "shares"),
        [
            ("return ZERO", ("another answer",)),
            ("return ZERO[:2]", ("another answer",)),
            ("return ROWS", ("another answer",)),
            ("return x", ("x",)),
            ("return x[1:]", ("x",)),
            ("return np.ones(3), x.T", ("x",)),
            ("return model.body_pos", ("model",)),
            ("return x.copy()", ()),
            ("return x.tolist()", ()),
            ("return ZERO + 0", ()),
            ("return 0.0", ()),
        ],
    )
    def test_tells_whose_memory_an_answer_is(self, ask, body, shares):
        code = f"""
            import numpy as np
            ZERO, ROWS = np.zeros(3), [[1.0, 2.0]]
            def f(model, x): {body}
        """
        question = Question("1.1", "f", (Robot(), np.ones(3)))
        for reply in ask(code, question, question):
            assert reply.shares == shares


@pytest.mark.kit
class TestALoop:
    def test_costs_one_limit_and_what_builds_on_it_waits(self, ask, monkeypatch):
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 1.0)
        started = []
        real = sandbox.Process
        monkeypatch.setattr(
            sandbox, "Process", lambda *_: started.append(real()) or started[-1]
        )
        code = """
            def loop(n):
                while n: pass
                return 0.0
            def fine(): return 47.0
        """
        questions = [
            Question("1.1", "fine", ()),
            *(Question("1.2", "loop", (n,)) for n in (0, 1, 1)),
            Question("1.3", "fine", ()),
            Question("1.4", "fine", ()),
            Question("1.5", "fine", ()),
        ]
        replies = ask(code, *questions, needs={"1.3": ["1.2"], "1.4": ["1.2", "1.3"]})
        kinds = [reply.kind for reply in replies]
        assert kinds == ["", "", "stopped", "stopped", "waits", "waits", ""]
        assert [replies[i].again for i in (0, 6)] == [47, 47]
        assert len(started) == 2

    def test_only_at_the_second_asking_is_found_too(self, ask, monkeypatch):
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 1.0)
        code = """
            seen = []
            def f(n):
                while n == 1 and seen: pass
                seen.append(n)
                return 1.0
            def g(): return 2.0
        """
        questions = [*(Question("1.1", "f", (n,)) for n in (1, 2))]
        one, two, other = ask(code, *questions, Question("1.2", "g", ()))
        assert (one.kind, two.kind, other.kind) == ("stopped", "", "")


@pytest.mark.kit
class TestWhatATaskMayTake:
    IMAGE = """
        import numpy as np
        def f(image):
            return image[:, ::-1]
        """

    def test_an_image_goes_there_and_back_where_the_task_says_so(self, ask):
        image = np.arange(480 * 640 * 3, dtype=np.uint8).reshape(480, 640, 3)
        question = Question("1.1", "f", (image,))
        (reply,) = ask(self.IMAGE, question, limits=Limits(numbers=921_600))
        assert reply.value.dtype == np.uint8
        assert (reply.value == image[:, ::-1]).all()
        (reply,) = ask(self.IMAGE, question)
        assert (reply.kind, "far too large" in reply.error) == ("unsendable", True)

    def test_a_week_may_bring_a_pinned_package(self, ask):
        scipy = pytest.importorskip("scipy")
        code = """
            import numpy as np
            from scipy.optimize import nnls
            def f():
                return nnls(np.eye(2), np.array([1.0, -1.0]))[0]
        """
        extras = (f"scipy=={scipy.__version__}",)
        (reply,) = ask(code, limits=Limits(extras=extras))
        np.testing.assert_array_equal(reply.value, [1.0, 0.0])
        (reply,) = ask(code)  # nobody asked for it
        assert reply.refused == ("call scipy.optimize.nnls",)

    def test_another_version_of_it_is_told_with_the_remedy(self, ask):
        for extra in ("numpy==0.1", "nothing-like-it==1.0"):
            with pytest.raises(Robo47Error, match=f"pip install {extra}"):
                ask("def f(): return 1.0", limits=Limits(extras=(extra,)))

    def test_a_question_that_is_too_large_is_told_to_its_author(self, ask):
        question = Question("1.1", "f", (np.zeros((2000, 2000)),))
        with pytest.raises(
            Robo47Error, match="a question to f holds an array of shape"
        ):
            ask(self.IMAGE, question)

    def test_a_task_may_ask_for_time_and_memory(self, ask, monkeypatch):
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 0.3)
        monkeypatch.setattr(sandbox, "TASK_SECONDS", 0.9)
        code = """
            import time
            import numpy as np
            def slow(x):
                time.sleep(0.5)
                return x
            def large(x):
                return np.empty(2_200_000_000, np.int8)[:1].size * x
        """
        slow, large = (Question("1.1", name, (1.0,)) for name in ("slow", "large"))
        assert ask(code, slow)[0].kind == "stopped"
        assert ask(code, slow, limits=Limits({"1.1": 6.0}))[0].value == 1.0
        (reply,) = ask(code, large, limits=Limits({"1.1": 30.0}))
        if sys.platform.startswith("linux"):  # others count what is filled
            assert reply.kind in ("_ArrayMemoryError", "MemoryError")
        (reply,) = ask(code, large, limits=Limits({"1.1": 30.0}, memory=3.0))
        assert reply.value == 1.0


class TestWhatItMayImport:
    @pytest.mark.parametrize("name", ["answers", "limits", "wire"])
    def test_is_a_file_beside_it_with_a_name_of_the_checkers(self, ask, student, name):
        student("def own(): return 47.0", f"{name}.py")
        (reply,) = ask(f"from {name} import own\ndef f(): return own()")
        assert reply.value == 47

    @pytest.mark.parametrize(
        "line",
        [
            "from robo47.se3 import make_T",
            "from robo47 import se3; make_T = se3.make_T",
            "import robo47.se3 as s; make_T = s.make_T",
            "import robo47; make_T = robo47.se3.make_T",
            "import importlib as i; make_T = i.import_module('robo47.se3').make_T",
        ],
    )
    def test_is_the_kits_library_of_earlier_days(self, ask, line):
        code = (
            f"import numpy as np\n{line}\ndef f(): return make_T(np.eye(3), [1, 2, 3])"
        )
        (reply,) = ask(code, library=LIBRARY)
        assert reply.value[:3, 3].tolist() == [1, 2, 3]

    @pytest.mark.parametrize(
        "line",
        [
            "from robo47.kinematics import chain_to as f",
            "from robo47 import kinematics; f = kinematics.chain_to",
            "from importlib import import_module as i; "
            "f = i('robo47.kinematics').chain_to",
            "import sys, robo47.kinematics as k; f = sys.modules[k.__name__].chain_to",
        ],
    )
    def test_is_nothing_of_the_day_itself_or_later(self, ask, line):
        (reply,) = ask(line, library=LIBRARY)
        assert reply.refused == ("call robo47.kinematics.chain_to",)

    def test_is_nothing_at_all_where_no_library_is_sent(self, ask):
        (reply,) = ask("from robo47.se3 import make_T as f")
        assert reply.refused == ("call robo47.se3.make_T",)

    def test_may_be_named_at_the_top_whatever_it_is(self, ask):
        code = """
            import kit
            import mujoco
            import mujoco.viewer
            import numpy as np
            from robo47 import cli, panda, verify
            from robo47.errors import Robo47Error
            from labkit.figures.scene import Camera
            from labkit.lesson.lab import Lab
            END = panda.END_FRAME["panda_nohand"]
            LIMITS = verify.LIMITS["x"][0] * 2 + np.ones(3) * verify.REACH
            NAMES = [name for name in verify.NAMES]
            class Mine(verify.Worst): pass
            def draw(camera: Camera | None = None, d: mujoco.MjData | None = None): ...
            def f(): return len(END)
        """
        (reply,) = ask(code)
        assert (reply.error, reply.value) == ("", len("site:attachment_site"))

    @pytest.mark.parametrize(
        ("line", "refused"),
        [
            ("mujoco.MjModel.from_xml_path('x.xml')", "mujoco.MjModel.from_xml_path"),
            ("mujoco.MjData(panda.load())", "mujoco.MjData"),
            ("mujoco.mj_loadXML('x.xml')", "mujoco.mj_loadXML"),
            ("mujoco.viewer.launch()", "mujoco.viewer.launch"),
            ("float(verify.LIMIT)", "use robo47.verify.LIMIT"),
            ("panda.load('panda')", "load 'panda', which the checker has no copy of"),
            ("panda.load(edit=print)", "call robo47.panda.load with edit"),
        ],
    )
    def test_refuses_by_name_what_is_used_while_loading(self, ask, line, refused):
        code = f"import mujoco\nfrom robo47 import panda, verify\nX = {line}"
        with pytest.raises(LoadError) as caught:
            ask(code)
        assert caught.value.reply.kind == "RefusedError"
        assert refused in caught.value.reply.refused[0]
        assert caught.value.reply.line == 3

    def test_does_not_take_one_panda_for_the_other(self, ask):
        code = "from robo47 import panda\ndef f(hand): return panda.load('panda').nq"
        (reply,) = ask(code, Question("", "f", (Robot("panda"),)))
        assert reply.value == 9

    @pytest.mark.parametrize(
        ("code", "sent"),
        [
            ("x = 1", 0),
            ("from robo47 import panda\nX = panda.READY_Q", 0),
            (f"from robo47 import panda\n{MAIN}{GUARD}", 0),
            (f"from robo47 import panda\n{MAIN}main()", 1),
            (f"from robo47 import panda\n{MAIN}def f():\n  main()\n{GUARD}", 1),
            ("from robo47 import panda\ndef f():\n  return panda.load()", 1),
            ("from robo47.panda import load as get\nX = get()", 1),
        ],
    )
    def test_is_sent_the_panda_only_where_a_task_may_load_it(self, student, code, sent):
        script = student(code)
        assert len(messages.request(script, [], None)["models"]) == sent
        (copy,) = messages.request(script, [Robot()], None)["models"]
        assert copy["entry"] == "panda_nohand"

    def test_is_no_module_that_does_not_exist(self, ask):
        with pytest.raises(LoadError, match=r"named 'robo47\.nothing'"):
            ask("import robo47.nothing")

    def test_takes_a_path_as_a_list_of_pairs(self, ask):
        code = "def f(path): return len(path), path == [('a', None), ('b', 'j')]"
        path = Path((("a", None), ("b", "j")))
        (reply,) = ask(code, Question("1.6", "f", (path,)))
        assert reply.value == (2, True)

    def test_takes_a_world_that_can_only_be_asked(self, ask):
        code = "def f(world, a, b): return world.edge_free(a, b), str(world)"
        thin = Balls([[1.0, 0, 0.2], [0, 5, 1]])
        ends = np.zeros(2), np.array([2.0, 0])
        for b, free in ((ends[1], False), (ends[1][::-1], True)):
            (reply,) = ask(code, Question("1.6", "f", (thin, ends[0], b)))
            assert reply.value == (free, "a world with its own edge_free(a, b)")
            assert reply.changed == ()

    @pytest.mark.parametrize(
        ("ends", "kind"),
        [
            ("a[:1], a[:1]", "ValueError"),
            ("a, b[:1]", "ValueError"),
            ("np.zeros((1000, 1, 2)), np.zeros((1000, 1, 2))", "ValueError"),
            ("'a', 'b'", "ValueError"),
            ("None, None", "ValueError"),
            ("object(), b", "TypeError"),
        ],
    )
    def test_a_question_that_no_world_has_is_the_functions_mistake(
        self, ask, ends, kind
    ):
        code = f"def f(world, a, b): return world.edge_free({ends})"
        thin = Balls([[1.0, 0, 0.2]])
        code = "import numpy as np\n" + code
        (reply,) = ask(code, Question("1.6", "f", (thin, np.zeros(2), np.ones(2))))
        assert (reply.kind, reply.line) == (kind, 2)
        assert "takes two points of this world" in reply.error

    @pytest.mark.parametrize(
        "look",
        [
            "[getattr(world, name) for name in dir(world)]",
            "getattr(world, 'rows', None)",
            "vars(world) if hasattr(world, '__dict__') else None",
            "[vars(one) for one in type(world).__mro__]",
            "[getattr(world, one) for one in type(world).__slots__]",
            "gc.get_objects()",
            "gc.get_referents(world, type(world), type(world).edge_free)",
            "gc.get_referrers(world, type(world))",
            "[one.cell_contents for one in type(world).edge_free.__closure__]",
            "type(world).edge_free.__globals__",
            "world.__reduce_ex__(2)",
            "copy.deepcopy(world)",
            "list(frames(sys._getframe()))",
            "while_it_is_asked(world)",
            "traced(world)",
            "[vars(one) for one in list(sys.modules.values()) if one]",
            "[one.f_locals for one in sys._current_frames().values()]",
            "str(world), repr(world), format(world)",
        ],
    )
    def test_a_world_shows_no_number_wherever_one_looks(self, ask, look):
        code = f"""
            import collections, copy, gc, sys
            import numpy as np

            RADIUS = 5678

            def frames(frame):
                while frame:
                    yield dict(frame.f_locals), frame.f_globals
                    frame = frame.f_back

            def while_it_is_asked(world):
                class Spy(list):
                    seen = []
                    def __len__(self):
                        Spy.seen += frames(sys._getframe())
                        return 2
                try:
                    world.edge_free(Spy([0.0, 0.0]), np.ones(2))
                except Exception as error:
                    Spy.seen += frames(error.__traceback__.tb_frame)
                return Spy.seen

            def traced(world):
                seen = []
                sys.setprofile(lambda frame, *_: seen.extend(frames(frame)))
                try:
                    world.edge_free(np.zeros(2), np.ones(2))
                finally:
                    sys.setprofile(None)
                return seen

            def within(some, depth, known):
                if depth < 0 or id(some) in known:
                    return False
                known[id(some)] = some
                if isinstance(some, (float, np.floating, np.ndarray)):
                    array = np.asarray(some)
                    near = array.dtype.kind == "f" and np.abs(array * 1e4 - RADIUS)
                    return bool(np.any(near < 1e-6)) if near is not False else False
                if isinstance(some, (str, bytes)):
                    return "balls" in str(some[:2000])
                if isinstance(some, dict):
                    some = [*some.keys(), *some.values()]
                if isinstance(some, (list, tuple, set, collections.deque)):
                    return any(within(one, depth - 1, known) for one in list(some))
                inner = getattr(some, "__dict__", None)
                return inner is not None and within(dict(inner), depth - 1, known)

            def f(world):
                try:
                    found = {look}
                except Exception as error:
                    found = error
                return within(found, 5, {{}})

            def it_would_be_found(world):
                keeps = type("Keeps", (), {{}})()
                keeps.rows = np.array([[1.0, 0.0, 0.5678]])
                return within([keeps], 5, {{}})
        """
        world = Balls([[1.0, 0.0, 0.5678]])
        some = [Question("1.6", name, (world,)) for name in ("f", "it_would_be_found")]
        reply, control = ask(code, *some)
        assert (reply.value, reply.error) == (False, "")
        assert control.value is True

    def test_a_world_has_another_class_in_the_next_question(self, ask):
        worlds = [Balls([[1.0, 0, 0.2]]) for _ in range(3)]
        some = [Question("1.6", "f", (world,)) for world in worlds]
        told = ask("def f(world): return type(world).__name__", *some)
        assert len({reply.value for reply in told}) == 3

    def test_whoever_asks_a_world_without_end_is_stopped(self, ask, monkeypatch):
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 0.5)
        code = """
            import numpy as np
            def f(world):
                while True: world.edge_free(np.zeros(2), np.ones(2))
            def g(): return 1
        """
        asked = (
            Question("1.6", "f", (Balls([[1.0, 0, 0.2]]),)),
            Question("1.7", "g", ()),
        )
        hangs, other = ask(code, *asked)
        assert (hangs.kind, hangs.error) == ("stopped", process.ENDLESS)
        assert other.value == 1

    @pytest.mark.parametrize("asked", ["[99, 0, 0]", "[]", "7", "[0, {}, []]"])
    def test_a_forged_question_about_a_world_ends_the_process(self, ask, asked):
        code = f"""
            def f(world):
                for cell in type(world).edge_free.__closure__:
                    if callable(cell.cell_contents):
                        cell.cell_contents(asks={asked})
        """
        (reply,) = ask(code, Question("1.6", "f", (Balls([[1.0, 0, 0.2]]),)))
        assert reply.kind == "stopped"


@pytest.mark.kit
class TestASession:
    CODE = """
        import numpy as np
        calls = 0
        def f(x):
            global calls
            calls += 1
            return x + calls
        def fails(): raise ValueError("no")
        def loop():
            while True: pass
    """

    def test_answers_round_after_round(self, student):
        with sandbox.Sandbox() as box:
            session = box.session(student(self.CODE))
            for n in range(1, 200):
                (reply,) = session.ask([Question("", "f", (1.0,))])
                assert reply.value == n + 1
            replies = session.ask(
                [Question("", "fails", ()), Question("", "f", (np.ones(2),))]
            )
            assert replies[0].error == "no"
            assert replies[1].value.tolist() == [201, 201]

    def test_ends_with_a_loop_and_another_can_be_opened(self, student):
        with sandbox.Sandbox() as box:
            script = student(self.CODE)
            session = box.session(script)
            questions = [Question("", name, args) for name, args in (("f", (1,)),)]
            questions += [Question("", "loop", ())] * 2
            kinds = [reply.kind for reply in session.ask(questions, seconds=0.5)]
            assert kinds == ["", "stopped", "stopped"]
            assert not session.alive
            assert session.ask(questions)[0].kind == "stopped"
            other = box.session(script)
            assert other.ask(questions[:1])[0].value == 2

    def test_that_loops_ends_when_another_thread_halts_it(self, student):
        with sandbox.Sandbox() as box:
            session = box.session(student(self.CODE))
            session.ask([Question("", "f", (1,))])
            halts = threading.Timer(0.2, session.halt)
            halts.start()
            (reply,) = session.ask([Question("", "loop", ())], seconds=600)
            halts.join()
            assert (reply.kind, session.alive) == ("stopped", False)

    def test_says_why_the_file_does_not_load(self, student):
        with sandbox.Sandbox() as box, pytest.raises(LoadError, match="division"):
            box.session(student("1 / 0"))

    def test_that_is_brief_asks_the_process_that_has_the_file(
        self, student, monkeypatch
    ):
        """Anew, with more robots and more code, and never with less of the kit's."""
        code = """
            import sys
            from robo47 import panda
            sys.loads = getattr(sys, "loads", 0) + 1  # in one process they add up
            calls = 0
            def f(*robots):
                global calls
                calls += 1
                return float(1000 * panda.load("panda").nq + 10 * sys.loads + calls)
        """
        started, begin = [], process.Process.__init__
        monkeypatch.setattr(
            process.Process,
            "__init__",
            lambda self, *a: (started.append(self), begin(self, *a))[1],
        )
        script, hand = student(code), Robot("panda")
        asked = Exchange(Question("1.6", "f", (Robot(), hand)))
        more = "\n\ndef g(robot): return float(robot.nq)\n"
        with sandbox.Sandbox() as box:
            box.run(script, [asked])
            assert asked.reply.value == asked.reply.again - 10 == 9011
            for added, name, expected in (("", "f", 9031), (more, "g", 9)):
                with contextlib.closing(
                    box.session(script, [hand], added=added, brief=True)
                ) as session:
                    (reply,) = session.ask([Question("", name, (hand,))])
                assert reply.value == expected
            assert len(started) == 1
            box.run(script, [once := Exchange(Question("1.6", "g", (hand,)))])
            assert once.reply.kind == "missing"
            assert len(started) == 2

    def test_that_is_brief_lets_the_file_load_the_robots_that_it_brings(self, student):
        code = "from robo47 import panda\ndef f(): return panda.load('panda').nq"
        script, asked = student(code), Question("", "f", ())
        with sandbox.Sandbox() as box:
            box.run(script, [before := Exchange(asked)])
            session = box.session(script, [Robot("panda")], brief=True)
            (reply,) = session.ask([asked])
        assert "no copy of" in before.reply.error
        assert reply.value == 9

    def test_of_a_file_that_hangs_when_loaded_once_more_costs_its_time_once(
        self, student, monkeypatch
    ):
        monkeypatch.setattr(sandbox, "LOAD_SECONDS", 0.5)
        code = """
            import sys
            sys.loads = getattr(sys, "loads", 0) + 1
            while sys.loads > 2: pass
            def f(): return 1.0
        """
        waited, again = [], sandbox.Sandbox._again
        monkeypatch.setattr(
            sandbox.Sandbox,
            "_again",
            lambda box, told: (waited.append(box._kept), again(box, told))[1],
        )
        with sandbox.Sandbox() as box:
            for _ in range(4):
                asked = Exchange(Question("1.1", "f", ()))
                box.run(student(code), [asked])
                assert asked.reply.value == asked.reply.again == 1
        assert len(waited) - waited.count(None) == 1

    def test_that_ended_is_not_asked_again(self, student):
        with sandbox.Sandbox() as box:
            script = student(self.CODE)
            box.run(script, [Exchange(Question("1.1", "f", (1.0,)))])
            session = box.session(script, brief=True)
            assert session.ask([Question("", "loop", ())], 0.3)[0].kind == "stopped"
            session.close()
            other = box.session(script, brief=True)
            assert other.ask([Question("", "f", (1.0,))])[0].value == 2

    def test_ends_with_its_sandbox(self, student):
        with sandbox.Sandbox() as box:
            session = box.session(student(self.CODE))
        assert session.ask([Question("", "f", (1,))])[0].kind == "stopped"
        assert session._process.process.returncode is not None
