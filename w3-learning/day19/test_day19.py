"""The numbers in the sentences of Day 19's guide, from its lab."""

import re

import numpy as np

from conftest import load_script
from labkit.lesson.day import find_day

DAY = find_day(19)
GUIDE = (DAY.folder / DAY.guide).read_text("utf-8")

lab = load_script(DAY.source)


def test_the_guides_arm_ends_at_the_position_that_the_guide_prints():
    x, y = map(float, re.search(r"end is at \((.+?) m, (.+?) m\)", GUIDE).groups())
    np.testing.assert_allclose(lab.reach(0.5, 1.0, 1.0, 0.5), [x, y], atol=5e-4)


def test_the_angle_of_joint_2_alone_is_wrong_by_what_the_guide_prints():
    off = lab.reach(0.5, 1.0, 1.0, 0.5) - lab.reach(0.5, 0.0, 1.0, 0.0)
    off -= lab.reach(0.0, 1.0, 0.0, 0.5)
    printed = float(re.search(r"\*\*(0\.\d+) m\*\*", GUIDE)[1])
    np.testing.assert_allclose(np.linalg.norm(off), printed, atol=5e-4)


def test_the_predicted_distance_is_the_one_in_the_fold():
    printed = float(re.search(r"cos q_2}\$ = (\S+) m", GUIDE)[1])
    far = np.linalg.norm(lab.reach(0.5, 2.5, 1.0, 0.5))
    np.testing.assert_allclose(far, printed, atol=5e-4)
