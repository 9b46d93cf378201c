"""Every file in the catalogue is told what it must be, on the Panda and on its twin."""

import numpy as np
import pytest
from submissions.catalogue import FOLDER, submissions, verdict_of

from robo47 import menagerie, panda
from robo47.diagnose import arm, cases, judging, truth

CACHES = (
    arm.model,
    arm.whole,
    cases.configurations,
    truth.right_answers,
    judging.mistakes_of,
)


def forget():
    for cache in CACHES:
        cache.cache_clear()


@pytest.fixture(scope="module", params=["panda", "twin"])
def model(request):
    """The robot, with everything that was worked out for another one forgotten."""
    with pytest.MonkeyPatch.context() as patch:
        if request.param == "twin":
            patch.setattr(menagerie, "panda_folder", lambda: None)
        forget()
        yield panda.load("panda_nohand")
    forget()


@pytest.mark.parametrize("submission", submissions("wrong"), ids=lambda s: s.name)
def test_a_wrong_file_is_told_its_own_mistake(submission, model):
    verdict = verdict_of(submission, model)
    assert verdict.status in ("wrong", "todo")
    assert verdict.mistake == submission.expected
    assert verdict.message.endswith((".", ")"))


@pytest.mark.parametrize("submission", submissions("close"), ids=lambda s: s.name)
def test_a_close_file_is_told_where_its_digits_went(submission, model):
    verdict = verdict_of(submission, model)
    assert (verdict.status, verdict.mistake) == ("close", submission.expected)


@pytest.mark.parametrize("submission", submissions("right"), ids=lambda s: s.name)
def test_an_unusual_right_file_passes(submission, model):
    assert submission.expected == "passed"
    verdict = verdict_of(submission, model)
    assert (verdict.status, verdict.mistake) == ("passed", "")


def test_the_catalogue_is_as_large_as_promised():
    assert len(list((FOLDER / "wrong").glob("*.py"))) >= 45
    assert len(list((FOLDER / "right").glob("*.py"))) >= 14


def test_the_catalogue_holds_mistakes_that_no_tutorial_configuration_shows(model):
    """Zero and home fool: there R is a half turn, equal to its own transpose."""
    fooled = {"zero": set(), "home": set()}
    for s in submissions("wrong"):
        if s.task == "1.6":
            measured = "".join(verdict_of(s, model).measured)
            fooled["zero"] |= {s.path.stem} if "at q = 0 by 0," in measured else set()
            fooled["home"] |= {s.path.stem} if "at home by 0," in measured else set()
    assert {"fk_joint_before_link", "fk_transposed", "fk_degrees"} <= fooled["zero"]
    assert {"fk_home_only"} <= fooled["home"]
    assert len(fooled["zero"]) >= 7


def test_no_message_is_longer_than_a_student_reads(model):
    for s in submissions("wrong", "close"):
        message = verdict_of(s, model).message
        assert 20 < len(message) < 420, message
        assert np.char.count(message, "\n") == 0
