"""What a search for a name costs: no hypothesis is asked more than it takes."""

import ast
import itertools
from functools import partial

import numpy as np
import pytest
from test_cases import told, toy

from labkit.judge import limits, pairs
from labkit.judge.answers import AtOnce
from labkit.judge.ask import Case, asked_of, right_answers, stacked
from labkit.judge.matcher import BRIEF, COSTLY, Matcher
from labkit.judge.mutant import Body
from labkit.judge.row import row_of
from labkit.lesson.day import find_day

pytestmark = pytest.mark.kit


def matcher_of(number, function):
    """Return the matcher of answers that are wrong in every call."""
    ask = row_of(find_day(number), function).ask
    exchanges = asked_of("1.1", function, ask, 1).main
    T = right_answers(ask, exchanges)
    S = tuple(t + 1.0 for t in T)
    return Matcher(Case(ask, stacked(exchanges), S[0], T[0], ()), S, T)


def lines_at(m, i):
    m.ask.bodies[0].calibrate(m.main.each[i])
    return m.ask.bodies[0].steps.lines


def test_a_long_function_is_screened_at_its_shortest_call_that_is_not_brief():
    m = matcher_of(12, "time_optimal_profile")
    last = int(m.wrong[-1])
    assert lines_at(m, last) > COSTLY
    assert BRIEF <= lines_at(m, m.i) < lines_at(m, last) / 3
    drawn = range(len(m.main) - m.ask.drawn, len(m.main))
    assert m.i in drawn
    assert m.order[:2] == [m.shortest, m.i]
    assert lines_at(m, m.shortest) < BRIEF
    assert all(lines_at(m, i) >= lines_at(m, m.i) for i in drawn
               if lines_at(m, i) >= BRIEF)  # fmt: skip
    short = matcher_of(12, "steer")
    assert short.i == short.shortest == short.order[0] == short.wrong[-1]


def test_a_changed_argument_costs_a_search_what_its_call_has_executed():
    m = matcher_of(12, "rrt_connect")
    usual = m.bodies[0].steps.lines
    *_, step = m.main.each[m.i]
    m.main.answer(partial(m.right), m.i)
    assert m.lines == usual
    m.main.answer(lambda *call: m.right(*call[:4], step / 20), m.i)
    assert m.lines > 2 * usual


def test_all_pairs_of_a_range_that_a_mutant_makes_fit_into_memory():
    text = "def f(n):\n    k = np.arange(n)\n    return np.abs(k[:, None] - k)\n"
    one = Body(ast.parse(text).body[0], {"np": np})
    one.calibrate([20])
    code = one.compiled()
    assert code(limits.LONG).size == limits.LONG**2
    with pytest.raises(limits.TooLongError):
        code(limits.LONG + 1)
    one.calibrate([60])  # of a right function that makes longer ones
    assert one.compiled()(1200).shape == (1200, 1200)


def test_how_long_an_array_may_be_follows_the_function_that_makes_it():
    text = "def f(n, m):\n    return np.zeros(n), np.arange(m)\n"
    one = Body(ast.parse(text).body[0], {"np": np})
    one.calibrate([50_000, 10])
    code = one.compiled()
    assert code(1_000_000, 1000)[0].size == 1_000_000
    with pytest.raises(limits.TooLongError):
        code(10, 1001)


def test_the_library_is_asked_once_for_a_single_call():
    asked = []

    def half(x):
        asked.append(x)
        return x / 2

    assert AtOnce(half).each([np.array([4.0])]) == [2.0]
    assert len(asked) == 1


@pytest.mark.parametrize("most", [60, 200])
def test_a_row_says_how_many_fresh_calls_of_a_case_are_tried(most):
    row, known = toy(), []
    row.more["each_case"] = most
    assert "is correct for positive numbers" in told(row, lambda x: x, known)
    least = min(sum(q.args[0] < 0 for q in known), sum(q.args[0] > 0 for q in known))
    assert most <= least < most + 20


def test_two_hypotheses_are_compared_up_to_the_first_call_that_differs():
    m = matcher_of(12, "steer")
    some = pairs._Pairs(m, m.i)
    asked = itertools.count()

    def one(i):
        next(asked)
        return tuple(t[i] for t in m.T)

    assert some._give_all(one, one)
    assert next(asked) == 2 * len(m.main)
    asked = itertools.count()
    assert not some._give_all(one, lambda i: tuple(t[i] + 1.0 for t in m.T))
    assert next(asked) == 1


def test_the_answers_of_a_named_mistake_are_worked_out_once_for_each_call():
    m = matcher_of(12, "steer")
    redo = m.ask.named[0].redo
    assert m.main.answer(redo, m.i) is m.main.answer(redo, m.i)
    assert m.main.answer(m.right, m.i) is not m.main.answer(m.right, m.i)


def test_pairs_that_may_add_up_are_those_whose_sum_or_product_does():
    m = matcher_of(2, "exp_screw")
    some = pairs._Pairs(m, m.i)
    keys, rows = some._rows
    assert len(keys) > 5
    its = np.concatenate([np.ravel(t[m.i]) for t in m.T])
    a, b = keys[1], keys[4]
    wanted = {
        pairs._sum: rows[1] + rows[4] - its,
        pairs._product: np.where(its, rows[1] * rows[4] / np.where(its, its, 1), 0),
    }
    for both, row in wanted.items():
        S = tuple(t.copy() for t in m.T)
        S[0][m.i] = row.reshape(S[0][m.i].shape)
        one = pairs._Pairs(Matcher(m.case, S, m.T), m.i)
        found = list(one._near_together())
        assert (a, b, both) in found
        assert len(found) < len(keys)


def test_a_function_made_with_a_mistake_before_it_is_asked_once_for_two_looks():
    m = matcher_of(2, "exp_screw")
    looks = [pairs._Pairs(m, i) for i in (m.i, m.i - 1)]
    first, again = ({x[:2] for x in one._that_combine()} for one in looks)
    assert first
    assert not first & again


def test_pairs_end_with_what_is_left_of_a_search():
    m = matcher_of(2, "exp_screw")
    one = pairs._Pairs(m, m.i)
    assert len(list(one._that_combine())) > 1
    m.known.clear()
    one.effort.left = 0
    asked = itertools.count()
    object.__setattr__(m, "holds", lambda code: next(asked) < 0)
    assert one.in_turn() is None
    assert next(asked) == 0
