"""Day 13's lab: what only this day must show."""

import re

import numpy as np

from conftest import load_script
from labkit.lesson.day import find_day

DAY = find_day(13)
GUIDE = (DAY.folder / DAY.guide).read_text("utf-8")

lab = load_script(DAY.source)


def test_the_guides_arm_ends_where_it_says():
    x, y = map(float, re.search(r"it ends at \((.+?) m, (.+?) m\)", GUIDE).groups())
    np.testing.assert_allclose(lab.reach(0.5, 1.0, 1.0, 0.5), [x, y], atol=5e-4)
