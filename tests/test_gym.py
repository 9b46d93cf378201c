"""The scene of Week 3 as a Gymnasium environment."""

import numpy as np
import pytest

from robo47 import push

gymnasium = pytest.importorskip("gymnasium", reason="the extra gym")
MAKE = "robo47.gym:robo47/Push-v0"


def test_gymnasiums_own_checker_finds_nothing():
    from gymnasium.utils.env_checker import check_env

    check_env(gymnasium.make(MAKE, render_mode="rgb_array").unwrapped)


def test_the_demonstrator_succeeds_and_its_return_is_what_was_gained():
    env = gymnasium.make(MAKE)
    for seed in range(3):
        seen, info = env.reset(seed=seed)
        first, total, cut = np.linalg.norm(seen[2:]), 0.0, False
        steps = 0
        while not cut:
            action = push.demonstrator(seen[None])[0]
            seen, reward, ended, cut, info = env.step(action)
            total += reward
            steps += 1
            assert not ended
        assert steps == push.STEPS
        assert info["is_success"]
        assert total == pytest.approx(first - np.linalg.norm(seen[2:]))


def test_a_start_of_ones_own_runs_as_in_the_library():
    start = push.starts(1, np.random.default_rng(5))
    run = push.run(*push.scene(), start, push.demonstrator, 20)
    env = gymnasium.make(MAKE)
    seen, _ = env.reset(options={"start": start[0]})
    for k in range(20):
        seen, *_ = env.step(push.demonstrator(seen[None])[0])
        np.testing.assert_allclose(seen, run.observation[0, k + 1], atol=1e-9)


def test_a_picture_shows_both_bodies_and_home():
    env = gymnasium.make(MAKE, render_mode="rgb_array")
    env.reset(options={"start": np.array([0.2, 0.1, -0.1, -0.2])})
    picture = env.render()
    from robo47 import gym

    counts = {
        name: (picture == colour).all(axis=2).sum()
        for name, colour in gym.COLOURS.items()
    }
    each = (2 * gym.SEEN / gym.PIXELS) ** 2  # m^2 of a pixel
    for name, radius in (("home", push.HOME), ("puck", push.PUCK)):
        assert counts[name] == pytest.approx(np.pi * radius**2 / each, rel=0.15)
    y, x = np.nonzero((picture == gym.COLOURS["puck"]).all(axis=2))
    assert x.mean() < gym.PIXELS / 2 < y.mean()  # to the left, and below


def test_another_render_mode_is_refused():
    from robo47 import gym

    with pytest.raises(ValueError, match="expected 'rgb_array'"):
        gym.Push("human")
