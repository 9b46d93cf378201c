"""In which of a row's cases a wrong function is right, and what is not printed."""

import numpy as np
import pytest
from toyrows import row_of

from labkit.base.exchange import Reply
from labkit.judge import Scalar, Vector
from labkit.judge.ask import asked_of
from labkit.judge.carried import carried
from labkit.judge.cases import RIGHT, WRONG, in_cases, sentence
from labkit.judge.merged import merged
from labkit.judge.resized import resized, sizes_by_axis
from labkit.judge.row import rows_of
from labkit.lesson.day import find_day
from robo47 import deploy, distance, planning, reward

pytestmark = pytest.mark.kit


def toy():
    """Return the row of a function that halves negative numbers alone."""
    row = row_of(
        Scalar(),
        lambda x: x / 2 if x < 0 else x,
        lambda rng: [(-1.0,), *((float(x),) for x in rng.numbers(-9, 9, 12))],
    )
    row.cases(negative_numbers=lambda x: x < 0, positive_numbers=lambda x: x > 0)
    return row


def told(row, function, known=None):
    """Return what the cases say of a function; `known` gets the further questions."""

    def reply(questions):
        if known is not None:
            known.extend(questions)
        return [Reply(value=function(*one.args)) for one in questions]

    asked = asked_of("1.1", "f", row.ask, seed=3)
    for one in asked.exchanges:
        one.reply = Reply(value=function(*one.question.args))
    return in_cases(asked, reply)


def test_right_and_wrong_cases_are_listed():
    says = "The result is correct for positive numbers. "
    says += "It is wrong in every test for negative numbers."
    assert told(toy(), lambda x: x) == says
    # Right too where x is above -1: not in every call of the case.
    some = told(toy(), lambda x: x / 2 if -1 < x < 0 else x)
    assert some == (
        "The result is correct for positive numbers. It is sometimes wrong for "
        "negative numbers."
    )


def test_one_counterexample_among_the_fresh_inputs_and_a_case_is_not_right():
    # What is always asked are three decimals; one of hundreds of numbers is over 8.8.
    says = told(toy(), lambda x: x / 3 if x < 0 or x > 8.8 else x)
    assert "correct" not in says


def test_fresh_inputs_are_drawn_only_while_a_case_may_be_right():
    known = []
    says = told(toy(), lambda x: x if abs(x) < 1 else 3 * x + 1, known)
    assert says == "Even for negative numbers, the result is sometimes wrong."
    assert known == []
    assert told(toy(), lambda x: 3 * x + 1, known) == ""
    told(toy(), lambda x: 3 * x if x < 0 or 5 < x < 5.2 else x, known)
    refuted = len(known)
    told(toy(), lambda x: x, known)
    assert 0 < refuted < (len(known) - refuted) / 2


@pytest.mark.parametrize("bad", [np.nan, np.inf, None])
def test_an_answer_that_is_missing_or_not_finite_is_wrong(bad):
    says = told(toy(), lambda x: x / 2 if x < 0 else (bad if x > 4 else x))
    assert says == (
        "The result is correct for negative numbers. It is sometimes wrong for "
        "positive numbers."
    )


def test_a_case_that_no_generator_draws_often_is_not_listed():
    row = toy()
    row.more["cases"] = ()
    row.cases(one=lambda x: x == -1, others=lambda x: x != -1)
    assert told(row, lambda x: x / 2 if x == -1 else -x) == ""
    row = toy()
    row.more["cases"] = ()
    row.cases(one=lambda x: x == -1, others=lambda x: x != -1)
    row.rare(lambda rng: [(-1.0,)])
    says = told(row, lambda x: -0.5 if x == -1 else 99.0)
    assert (
        says == "The result is correct for one. It is wrong in every test for others."
    )


def test_only_is_said_where_every_other_call_is_right():
    row = toy()
    row.more["cases"] = ()
    bands = {f"numbers from {i} to {i + 3}": (lambda x, i=i: i <= x < i + 3)
             for i in range(-9, 9, 3)}  # fmt: skip
    row.cases(bands)
    wrong = told(row, lambda x: 99.0 if 3 <= x < 6 else x / 2 if x < 0 else x)
    assert wrong == "The result is wrong only for numbers from 3 to 6."
    some = told(row, lambda x: 99.0 if 3 <= x < 4 else x / 2 if x < 0 else x)
    assert some == ("The result is sometimes wrong, but only for numbers from 3 to 6.")


def test_a_case_that_is_partly_wrong_is_told_after_one_that_is_wrong():
    row = toy()
    row.more["cases"] = ()
    row.cases({
        "negative numbers": lambda x: x < 0,
        "numbers from 0 to 3": lambda x: 0 <= x < 3,
        "numbers above 3": lambda x: x >= 3,
    })  # fmt: skip
    says = told(row, lambda x: x if x < 3 or x > 6 else 99.0)
    assert says == (
        "The result is correct for numbers from 0 to 3. It is wrong in every test for "
        "negative numbers, and sometimes wrong for numbers above 3."
    )


def test_adjacent_ranges_with_the_same_verdict_are_one():
    row = toy()
    row.more["cases"] = ()
    row.cases({
        "numbers below -3 m": lambda x: x < -3,
        "numbers from -3 to 0 m": lambda x: -3 <= x < 0,
        "numbers from 0 m to 3 m": lambda x: 0 <= x < 3,
        "numbers above 3 m": lambda x: x >= 3,
    })  # fmt: skip
    says = told(row, lambda x: x / 2 if x < 0 else 99.0)
    assert says == (
        "The result is correct for numbers below 0 m. "
        "It is wrong in every test for numbers above 0 m."
    )


@pytest.mark.parametrize(
    ("phrases", "one"),
    [
        (
            ["x below 0.02 rad", "x from 0.02 to 2 rad", "x from 2 to 3.12 rad"],
            ["x below 3.12 rad"],
        ),
        (["x from 2 to 3.12 rad", "x from 3.12 rad to pi"], ["x from 2 rad to pi"]),
        (["x from 1 to 2 rad", "x from 2 to 3 rad"], ["x from 1 to 3 rad"]),
        (["x from 1 to 2 m", "x above 2 m"], ["x above 1 m"]),
        (["x below 1", "x above 1"], ["x below 1", "x above 1"]),
        (["x below 1 m", "x from 2 to 3 m"], ["x below 1 m", "x from 2 to 3 m"]),
        (["x below 1", "y from 1 to 2"], ["x below 1", "y from 1 to 2"]),
        (["parallel segments", "x below 1"], ["parallel segments", "x below 1"]),
    ],
)
def test_only_ranges_that_meet_are_merged(phrases, one):
    assert merged(phrases) == one


def test_the_list_that_leaves_the_fewest_calls_open_is_told():
    row = toy()
    row.more["cases"] = ()
    row.cases(small_numbers=lambda x: abs(x) < 3, large_numbers=lambda x: abs(x) >= 3)
    row.cases(negative_numbers=lambda x: x < 0, positive_numbers=lambda x: x > 0)
    assert told(row, lambda x: x).startswith(
        "The result is correct for positive numbers."
    )


def test_a_case_is_right_only_if_it_is_right_at_other_sizes():
    row = row_of(
        Vector((None,)),
        lambda x, y: x * y.sum(),
        lambda rng: [
            (rng.numbers(0.5, 1, n), rng.numbers(0.5, 1, m))
            for n, m in ((1, 1), (3, 2), (2, 4), (1, 1), (4, 3))
        ],
    )
    row.cases(one_factor=lambda x, y: len(y) == 1, more=lambda x, y: len(y) > 1)
    row.rare(
        lambda rng: [(rng.numbers(0.5, 1, n), rng.numbers(0.5, 1, n)) for n in (1, 2)]
    )
    right = "The result is correct for one factor. It is wrong in every test for more."
    assert told(row, lambda x, y: x * y[0]) == right
    # With one factor, only one x is asked for; of several x, each is wrong.
    assert told(row, lambda x, y: x * y.sum() * len(x)) == ""


def test_only_axes_of_the_same_size_in_every_call_are_resized_together():
    calls = [(np.zeros((n, 3)), np.arange(n), np.zeros(m)) for n, m in ((2, 5), (4, 4))]
    assert list(sizes_by_axis(calls).values()) == [[(0, 0), (1, 0)], [(2, 0)]]
    some = list(resized(calls[:1], calls))
    assert [[len(x) for x in call] for call in some] == [[4, 4, 5], [2, 2, 4]]
    assert some[0][1].tolist() == [0, 0, 1, 1]


# What the hooks of Days 11 and 12 said of these was false.


def only_the_fastest(s, gap, dq, reach):
    """Let only the joint count that moves most, and forget s."""
    i = int(np.argmax(np.abs(dq)))
    speed = abs(dq[i]) * reach[i]
    if gap <= 0:
        return s
    return min(1.0, gap / speed) if speed else 1.0


def further(s, gap, dq, reach):
    """Go at least 0.05 further."""
    found = distance.conservative_advance(s, gap, dq, reach)
    return found if gap <= 0 else min(1.0, max(found, s + 0.05))


def first_reach(s, gap, dq, reach):
    """Give every joint the radius of the first one that moves."""
    moves = np.flatnonzero(dq)
    radii = np.full(7, reach[moves[0]] if len(moves) else 1.0)
    return distance.conservative_advance(s, gap, dq, radii)


def steep_only(qd, grad, gap, gain):
    """Leave velocities alone where the gradient is shorter than 0.1."""
    short = np.linalg.norm(grad) < 0.1
    return qd.copy() if short else distance.velocity_damper(qd, grad, gap, gain)


def shallow(p, half):
    """Return a depth that is 0.9 times what it is to be."""
    right = distance.box_sdf(p, half)
    return 0.9 * right if right < 0 else right


def long_edges(a, b, discs):
    """Take the squared length of an edge as at least 1."""
    along = b - a
    part = np.clip((discs[:, :2] - a) @ along / max(along @ along, 1.0), 0, 1)
    off = a + part[:, None] * along - discs[:, :2]
    return bool(np.all(np.linalg.norm(off, axis=1) > discs[:, 2]))


def coarse(a, b, discs):
    """Leave out discs with a radius below 0.05."""
    return planning.segment_free_of_discs(a, b, discs[discs[:, 2] >= 0.05])


def capped(a, b, c, limits, sd):
    """Clamp both bounds to +-10,000."""
    return np.clip(planning.path_accel_bounds(a, b, c, limits, sd), -1e4, 1e4)


NAMES = {
    only_the_fastest: "conservative_advance",
    further: "conservative_advance",
    first_reach: "conservative_advance",
    steep_only: "velocity_damper",
    shallow: "box_sdf",
    long_edges: "segment_free_of_discs",
    coarse: "segment_free_of_discs",
    capped: "path_accel_bounds",
}
OF_THE_REVIEW = [
    (11, only_the_fastest,
     "Correct: links that touch or overlap; motions of length 0. Wrong in every test: "
     "steps in which several joints move. Sometimes wrong: steps in which one joint "
     "moves; steps that reach the end of the motion."),
    (11, further, "ometimes wrong for steps that end before"),
    (11, first_reach, "Correct: steps with equal radii; links that touch"),
    (11, steep_only,
     "Correct: velocities that are allowed; gradients of 0. Sometimes wrong: "
     "velocities that are too fast, at a positive distance; velocities that are too "
     "fast, at a distance of 0 or less."),
    (11, shallow, "points beyond three faces. It is wrong in every test for points in"),
    (12, long_edges, "worlds without a disc. Sometimes wrong: edges that "),
    (12, coarse, "correct for edges that are free. It is sometimes wrong for edges"),
    (12, capped, "Even for paths on which "),
]  # fmt: skip


@pytest.mark.parametrize(
    ("day", "code", "says"), OF_THE_REVIEW, ids=lambda x: getattr(x, "__name__", "")
)
def test_of_the_review_is_told_what_is_true(day, code, says):
    name = NAMES[code]
    assert says in told(rows_of(find_day(day))[name], code)


def nearest_centre_alone(a, b, discs):
    """Return whether an edge misses the disc whose centre is nearest to its middle."""
    if not len(discs):
        return True
    away = np.linalg.norm(discs[:, :2] - (a + b) / 2, axis=1)
    return planning.segment_free_of_discs(a, b, discs[[np.argmin(away)]])


def test_a_case_that_is_right_with_a_short_list_alone_is_not_listed():
    """The row draws a touching edge with one disc; here another one is beside it."""
    row = rows_of(find_day(12))["segment_free_of_discs"]
    right = told(row, nearest_centre_alone).partition("Sometimes wrong")[0]
    assert "edges that touch a disc" not in right


def nearest_to_the_edge_alone(a, b, discs):
    """Return whether an edge misses the disc whose centre is nearest to the edge."""
    if not len(discs):
        return True
    along = b - a
    part = np.clip((discs[:, :2] - a) @ along / max(along @ along, 1e-300), 0, 1)
    away = np.linalg.norm(a + part[:, None] * along - discs[:, :2], axis=1)
    return planning.segment_free_of_discs(a, b, discs[[np.argmin(away)]])


def test_a_case_is_right_only_if_it_is_right_beside_what_made_other_calls_wrong():
    """An edge of length 0 lies in a large disc behind a nearer centre: 25 in 2,000."""
    row = rows_of(find_day(12))["segment_free_of_discs"]
    right = told(row, nearest_to_the_edge_alone).partition("ometimes wrong")[0]
    assert "edges of length 0" not in right


def test_a_call_takes_arguments_of_a_case_or_one_of_its_own_twice():
    case = [(n, n, np.full(2, n)) for n in (1.0, 2.0)]
    others = [(3.0, 4.0, np.full(m, 5.0)) for m in (1, 3)]
    some = [(x, y, *z) for x, y, z in carried(case, others, [*case, *others])]
    assert {(1.0, 1.0, 5.0), (4.0, 4.0, 5.0, 5.0, 5.0), (3.0, 1.0, 1.0, 1.0)} <= {*some}
    assert not {*some} & {(x, y, *z) for x, y, z in [*case, *others]}
    some = carried(case, [(3.0, 4.0, np.ones(2))], case)
    assert {len(z) for _, _, z in some} == {2}


def test_sizes_that_belong_together_are_carried_together():
    case = [(np.zeros((n, 3)), np.arange(n), 0.0) for n in (2, 3)]
    others = [(np.ones((n, 3)), np.arange(n), 1.0) for n in (4, 5)]
    for x, y, _ in carried(case, others, [*case, *others]):
        assert len(x) == len(y)


def test_a_call_is_resized_to_any_size_that_no_call_of_its_case_has():
    known = [(np.arange(float(n)), n) for n in (1, 2, 4, 5, 6, 7)]
    sizes = [len(x) for x, _ in resized(known[:2], known)]
    assert sizes == [4, 4, 5, 5, 7, 7]
    # Equal entries may make a wrong function right: not of a wrong case.
    sizes = [len(x) for x, _ in resized(known[1:4], known, twice=False)]
    assert sizes == [1, 1]


def test_another_call_is_carried_with_the_sizes_of_a_case():
    case, others = [(np.zeros(2),)], [(np.full(5, 3.0),)]
    some = list(carried(case, others, [*case, *others]))
    found = {tuple(x) for (x,) in some}
    assert (3.0, 3.0) in found
    assert found <= {(3.0, 3.0), (0.0, 3.0), (3.0, 0.0)}  # or entries of both


def test_a_vector_takes_entries_of_both_calls_unless_it_is_a_unit_vector():
    case, others = [(np.array([0.0, 2.0, 2.0]),)], [(np.array([-1.0, -1.0, -1.0]),)]
    found = {tuple(x) for (x,) in carried(case, others, [*case, *others])}
    assert (0.0, -1.0, 2.0) in found
    axes = [(row,) for row in np.eye(3)]
    found = [x for (x,) in carried(axes[:1], axes[1:], axes)]
    assert all(np.isclose(np.linalg.norm(x), 1.0) for x in found)


def negative_a_not_sorted(a, b, c, limits, sd):
    """Return the bounds of a path, those of a joint with a < 0 in the wrong order."""
    moves = a != 0  # the others are left out
    ends = (np.array([-limits, limits]) - b * sd**2 - c)[:, moves] / a[moves]
    return np.array([ends[0].max(initial=-np.inf), ends[1].min(initial=np.inf)])


def test_a_joint_that_stands_still_is_right_only_if_it_is_beside_any_other():
    """Its row drew such a joint beside joints with a above 0 alone."""
    row = rows_of(find_day(12))["path_accel_bounds"]
    right = told(row, negative_a_not_sorted).partition("ometimes wrong")[0]
    assert "joints with a = 0 within" not in right


def best_key_alone(queries, keys, values):
    """Return for each query the value of its best key."""
    return values[np.argmax(queries @ keys.T, axis=1)]


def one_softmax(queries, keys, values):
    """Return weighted values, with one softmax over all queries."""
    scores = queries @ keys.T / np.sqrt(keys.shape[1])
    weights = np.exp(scores - scores.max())
    return weights @ values / weights.sum()


def test_a_case_is_wrong_where_only_equal_entries_make_it_right():
    row = rows_of(find_day(16))["attention"]
    assert told(row, best_key_alone) == (
        "The result is correct for one key. It is wrong in every test for several keys."
    )
    assert "correct" not in told(row, one_softmax)  # of several queries


def long_lists(logp, old_logp, advantage, clip):
    """Return the loss, which is off by 1 for lists of five or more."""
    loss, gradient = reward.ppo_loss(logp, old_logp, advantage, clip)
    return loss + (len(logp) > 4), gradient


def test_a_case_whose_fresh_calls_are_all_short_is_not_right_for_that():
    row = rows_of(find_day(20))["ppo_loss"]
    assert "negative advantages" not in told(row, long_lists)


def test_only_is_not_said_where_a_call_contradicts_another_case():
    cases = {f"numbers of {i}": lambda call, i=i: call[0] == i for i in range(6)}
    old = [((i,), WRONG if i == 0 else RIGHT) for i in range(6) for _ in range(99)]
    assert "only for numbers of 0" in sentence(cases, old, old)[1]
    _, says = sentence(cases, old, old, {"numbers of 5"})
    assert "only" not in says
    assert "numbers of 5" not in says


def test_fresh_calls_are_those_of_every_line_of_a_row():
    """The first two larger strides of the row always have one size."""
    row = rows_of(find_day(19))["conv2d"]
    (code,) = [w.code for w in row.ways if w.slug == "counted-before-the-division"]
    assert told(row, code) == (
        "The result is correct for a stride of 1. "
        "It is sometimes wrong for a larger stride."
    )


def off_near_the_origin(obs, *others):
    """Return the next observation, which is off by 0.1 near the origin."""
    near = np.abs(obs).max() < 0.06
    return deploy.push_ahead(obs, *others) + 0.1 * near


def test_actions_without_a_contact_are_drawn_near_the_origin_too():
    row = rows_of(find_day(21))["push_ahead"]
    says = told(row, off_near_the_origin)
    assert "correct for actions without a contact" not in says
