"""The pusher and the puck of Week 3."""

import numpy as np

from robo47 import push


def test_a_moment_lies_between_two_steps_and_the_last_one_stays():
    seen = np.arange(12.0).reshape(1, 3, 4)
    episodes = push.Episodes(seen, np.zeros((1, 2, 2)))
    for ticks, row, step in ((0.0, 0.0, 0), (0.5, 0.5, 0), (1.25, 1.25, 1)):
        at, k = episodes.moment(ticks * push.TICK)
        np.testing.assert_allclose(at, seen[0, 0] + 4 * row, rtol=1e-12)
        assert k == step
    at, k = episodes.moment(9.0)
    assert at.tolist() == seen[0, -1].tolist()
    assert k == 1
