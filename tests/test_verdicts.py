"""What the checker sees beyond the numbers, and how tasks stand to each other."""

from robo47.checker import variant
from robo47.week import find_day

REFERENCE = find_day(1).source.read_text("utf-8")


def test_a_general_inverse_gives_the_right_numbers_but_not_the_task(check):
    code = REFERENCE.replace(
        "    R, t = T[:3, :3]", "    return np.linalg.inv(T)\n    R, t = T[:3, :3]", 1
    )
    verdict = check(code, "1.3")["1.3"]
    assert (verdict.status, verdict.mistake) == ("close", "general-inverse")
    assert "numpy.linalg.inv" in verdict.message


def test_typed_in_link_lengths_pass_with_a_note(check):
    code = REFERENCE.replace(
        "link_T(body.pos, body.quat)", "link_T(POS[name], body.quat)", 1
    )
    model = variant.models()[0]
    names = ["link0", *(f"link{i}" for i in range(1, 8)), "attachment"]
    typed = {name: model.body(name).pos.tolist() for name in names}
    verdict = check(code.replace("HOME_Q =", f"POS = {typed}\nHOME_Q =", 1), "1.6")[
        "1.6"
    ]
    assert verdict.status == "passed"
    assert "longer links" in verdict.message


def test_a_task_that_calls_an_unwritten_one_waits_for_it(check):
    gap = 'raise NotImplementedError("task 1.4: write quat_to_R")'
    start = "    w, x, y, z = quat"
    code = REFERENCE.replace(start, f"    {gap}\n{start}", 1)
    verdicts = check(code)
    assert verdicts["1.4"].status == verdicts["1.6"].status == "todo"
    assert "Waits for task 1.4" in verdicts["1.6"].message


def test_a_wrong_task_points_to_the_wrong_one_below_it(check):
    code = REFERENCE.replace("w, x, y, z = quat /", "x, y, z, w = quat /", 1)
    verdicts = check(code)
    assert verdicts["1.4"].status == verdicts["1.6"].status == "wrong"
    assert "Task 1.4" in verdicts["1.6"].message


def test_a_missing_function_is_told_with_the_way_to_get_it_back(check):
    verdict = check(REFERENCE.replace("def Rz(", "def rz("), "1.2")["1.2"]
    assert verdict.mistake == "missing"
    assert "make start RESET=1.2" in verdict.message
