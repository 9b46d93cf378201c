"""The capstone of Week 3: what each of its numbers depends on, one cause at a time."""

from functools import lru_cache
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from robo47 import deploy, diffusion, push, pushing
from robo47.cloning import adam_step
from robo47.pushing import guard, learning, result, scene, task
from robo47.pushing.eye import Eye

FNS = pushing.library()
ONE = "diffusion, 1 denoising step"


def but(**changed):
    """Return the library's functions with some of them replaced."""
    return SimpleNamespace(**{**vars(FNS), **changed})


@pytest.fixture(scope="module")
def right():
    """What `make capstone WEEK=3` does."""
    return pushing.attempt(FNS)


@pytest.fixture
def quick(monkeypatch):
    """Training and guard that take no time: the policy is then a bad one."""
    monkeypatch.setattr(learning, "UPDATES", 20)
    monkeypatch.setattr(guard, "EPISODES", 2)
    monkeypatch.setattr(guard, "TICKS", 31)
    for module, name in ((learning, "_kept"), (pushing, "_kept_limit")):
        anew = lru_cache(4)(getattr(module, name).__wrapped__)
        monkeypatch.setattr(module, name, anew)


def test_a_puck_is_pushed_home_again_after_it_was_moved(right):
    assert not right.failed
    assert right.place_mm < task.HOME_MM
    assert right.seen_mm < 3.5
    assert right.lag_mm < 10.0
    assert right.new < right.limit
    begun = dict(right.phases)
    assert list(begun) == ["approach", "push", "moved aside", "push again", "home"]
    assert abs(right.time - (begun["home"] - begun["push"])) < 1e-9
    puck = [right.qpos[np.searchsorted(right.t, begun[name]), 9:]
            for name in ("moved aside", "push again")]  # fmt: skip
    way = puck[1] - puck[0]
    assert abs(np.linalg.norm(way) - guard.MOVED) < 0.005
    assert abs(way @ puck[0]) / np.linalg.norm(puck[0]) < 0.005  # at a right angle


def test_a_result_fails_by_each_of_its_numbers(right):
    for off in ({"place_mm": 10.1}, {"seen_mm": 4.1}, {"lag_mm": 15.1}):
        assert right._replace(**off).failed
    stopped = right._replace(stopped="what it sees is new")
    assert stopped.failed
    assert pushing.row("one", stopped).endswith("stops")
    assert any("it stopped" in line for line in pushing.summary(stopped).after)


def test_the_place_is_printed_in_whole_millimetres(right):
    line = pushing.row("one puck", right._replace(place_mm=4.4))
    assert line.split()[2] == "4"
    assert len(line) < 80


def test_the_side_is_that_of_the_plane(right):
    some = right.observed[None, : int(10 * task.ROUND_SECONDS)]
    episodes = push.Episodes(some, some[:, 1:, :2])
    assert push.on_the_left(episodes)[0] == right.left


def test_each_function_that_is_named_is_called_and_no_other(quick):
    called = set()

    def counting(name, function):
        def counted(*given, **more):
            called.add(name)
            return function(*given, **more)

        return counted

    spied = {name: counting(name, one) for name, one in vars(FNS).items()}
    pushing.attempt(SimpleNamespace(**spied))
    assert called == {name for some in pushing.USES.values() for name in some}


class TestTheEye:
    def at(self, xy, **how):
        model = scene.tray(xy)
        return Eye(FNS, model, **how).look(scene.start(model))

    def test_sees_the_puck_within_4_mm_and_without_its_blur_20_mm_off(self):
        rng = np.random.default_rng(3)
        off = {True: [], False: []}
        for xy in rng.uniform(-0.15, 0.15, (12, 2)):
            for blur, found in off.items():
                found.append(np.linalg.norm(self.at(xy, blur=blur) - xy))
        assert max(off[True]) < 0.0035
        assert max(off[False]) > 0.012

    def test_sees_it_whatever_the_arm_does(self, right):
        model = scene.tray(task.PUCK)
        data = scene.start(model)
        eye = Eye(FNS, model)
        before = eye.image(data)
        over = right.qpos[np.searchsorted(right.t, 3.0)].copy()
        over[9:] = data.qpos[9:]
        data.qpos[:] = over
        np.testing.assert_array_equal(eye.image(data), before)
        area = before.sum() * 0.0125**2
        assert abs(area / (np.pi * push.PUCK**2) - 1.0) < 0.1

    def test_that_stands_elsewhere_is_off_by_as_much(self):
        way = self.at(task.PUCK, offset=0.03) - self.at(task.PUCK)
        np.testing.assert_allclose(way, [0.03, 0.0], atol=1e-12)


class TestTheSpring:
    @pytest.mark.parametrize("direction", [(1.0, 0.0), (0.0, -1.0)])
    def test_trails_by_its_closed_form_unless_the_velocity_is_sent_forward(
        self, direction
    ):
        inertia = pushing.inertia(FNS, direction)
        paper = deploy.lag_behind(0.1, 600.0, inertia)
        without = pushing.lag(FNS, direction, 0.1, forward=False)
        assert abs(without / paper - 1.0) < 0.12
        assert abs(pushing.lag(FNS, direction, 0.1)) < 0.001

    def test_pushes_a_ball_whose_set_point_stays_in_its_box(self, right):
        assert (right.observed[:, :2] > task.LOW - 0.01).all()
        assert (right.observed[:, :2] < task.HIGH + 0.01).all()


class TestPlans:
    def test_are_drawn_for_where_things_will_be(self, quick):
        asked = []

        def ahead(obs, actions, *how):
            asked.append((np.array(obs), np.array(actions), how))
            return FNS.push_ahead(obs, actions, *how)

        pushing.attempt(but(push_ahead=ahead, alarm_at=lambda *_: -1), late=3)
        assert len(asked) == -(-guard.TICKS // learning.EXECUTED)
        assert all(actions.shape == (3, 2) for _, actions, _ in asked)
        assert asked[0][2] == (push.TICK, task.PARTS, push.R)
        assert not asked[0][1].any()  # no plan yet, so it stands still
        assert asked[1][1].any()

    @pytest.mark.kit
    def test_that_are_late_need_it(self):
        late = pushing.attempt(FNS, 2, late=3)
        blind = pushing.attempt(FNS, 2, late=3, ahead=False)
        assert late.home
        assert not blind.home

    def test_that_arrive_after_the_next_one_are_refused(self, quick):
        with pytest.raises(ValueError, match="late is 5; expected 0 to 4"):
            pushing.attempt(FNS, late=5)

    def test_are_the_same_for_the_same_functions_and_trained_once(self, right):
        first, again = pushing.policy(FNS), pushing.policy(pushing.library())
        assert first.net is again.net

    def test_are_trained_anew_for_another_function(self, quick):
        first = pushing.policy(FNS)
        still = pushing.policy(but(adam_step=lambda *given: given[:1] + given[2:4]))
        assert not np.array_equal(first.net[4], still.net[4])
        assert not still.net[4].any()  # the last layer begins at 0 and stays there

        def copy(*given):
            return adam_step(*given)

        same = pushing.policy(but(adam_step=copy))
        assert same.net is not first.net
        np.testing.assert_array_equal(same.net[4], first.net[4])


def test_the_worst_of_several_pucks_is_shown_and_how_many_are_home(right):
    away = right._replace(place_mm=30.0, time=np.nan, seen_mm=1.0)
    worst = result.worst([right, away])
    assert worst.failed
    assert worst.homes == (True, False)
    assert worst.places_mm == (right.place_mm, 30.0)
    assert worst.seen_mm == right.seen_mm
    line = pushing.row("two", worst)
    assert line.split()[1:3] == ["30", "-"]
    assert line.endswith("1 of 2")


class TestTheGuard:
    def test_stops_what_is_new_after_three_ticks(self, monkeypatch, right):
        monkeypatch.setattr(pushing, "_limit", lambda fns: 0.01)
        stopped = pushing.attempt(FNS)
        assert len(stopped.observed) == guard.IN_A_ROW
        assert stopped.stopped.startswith("its observation is new")
        assert stopped.failed

    def test_scores_an_observation_by_the_nearest_demonstrated_one(self, right):
        data = pushing.policy(FNS).data
        mean, std = data.scalers[0]
        far = data.seen[0] + [0.0, 0.0, 9.0, 0.0]
        apart = np.linalg.norm(data.seen[:: guard.EVERY] - far, axis=1).min()
        score = guard.novelty(FNS, (far * std + mean)[None])[0]
        assert abs(score - apart) < 1e-9

    def test_has_a_limit_that_few_other_runs_exceed(self, right):
        scores = pushing.guard_scores(FNS, 50, seed=501)
        assert np.mean(scores > right.limit) <= 0.1

    def test_moves_a_puck_across_its_way_home(self):
        seen = np.array([[0.0, 0.0, 0.0, 0.2], [0.1, 0.0, 0.3, 0.0]])
        moved = guard.moved_aside(seen, np.array([1.0, -1.0]))
        np.testing.assert_allclose(
            moved - seen, [[0, 0, -0.06, 0], [0, 0, 0, -0.06]], atol=1e-12
        )


@pytest.mark.kit
class TestTheAblations:
    def test_are_told_by_their_numbers(self, right):
        table = pushing.ablations(FNS)
        assert next(iter(table)) == "right"

        def done(name):
            fns, options = table[name]
            return pushing.attempt(fns, **{**options, "pucks": 1})

        assert done("puck's position given").seen_mm == 0.0
        assert done("no blur in the camera").seen_mm > 12.0
        assert done("no feedforward velocity").lag_mm > 25.0
        beside = done("camera 30 mm off")
        assert not beside.home
        assert beside.new < beside.limit  # a guard sees what is new, not what is wrong

    def test_put_no_noise_back(self, right):
        forgets, _ = pushing.ablations(FNS)["noise not put back"]
        x, eps = np.random.default_rng(0).normal(size=(2, 3, 4))
        clean = diffusion.ddim_step(x, eps, 0.36, 1.0)
        np.testing.assert_allclose(forgets.ddim_step(x, eps, 0.36, 0.64), 0.8 * clean)
        assert forgets.mlp is FNS.mlp

    def test_of_the_policy_are_told_by_the_league(self, right):
        rows = ["diffusion, 4 of 8 actions", ONE]
        names, success = pushing.league(FNS, rows)
        assert names == rows
        assert success.shape == (2, 100)
        best, one_step = success.sum(axis=1)
        assert best > one_step + 10


@pytest.mark.kit
def test_random_pucks_come_home_and_stand_where_they_may():
    far = np.linalg.norm([pushing.random_puck(seed) for seed in range(40)], axis=1)
    assert far.min() >= pushing.NEAREST
    assert far.max() <= pushing.FARTHEST
    assert not [seed for seed in range(3) if pushing.attempt(FNS, seed).failed]


def test_a_film_of_it_has_the_ball_at_the_tool_and_all_that_stands_around(right):
    film = pushing.film(right)
    assert film.moments == ("push", "moved aside", "push again", "home")
    assert film.qpos.shape[1] == scene.tray(task.PUCK).nq
    last = film.qpos[-1]
    kinds = [block.kind for block in film.blocks(last)]
    assert kinds == ["box", "cylinder", "box", "capsule", "sphere", "cylinder"]
    sphere, puck = (film.blocks(last)[i].T_world_box[:2, 3] for i in (4, 5))
    np.testing.assert_allclose(puck - scene.HOME, last[9:], atol=1e-12)
    assert np.linalg.norm(sphere - puck) > push.R - 0.002


@pytest.mark.gl
def test_a_round_block_is_drawn_round(gl):
    pytest.importorskip("PIL")
    from labkit.figures import client
    from labkit.figures.scene import NOBODY, Box, Camera, Scene

    camera = Camera(lookat=(0.0, 0.0, 1.0), distance=1.0)
    counts = []
    for kind in ("box", "sphere"):
        pose = np.eye(4)
        pose[2, 3] = 1.0
        box = Box(pose, (0.1, 0.1, 0.1), (1.0, 0.0, 0.0, 1.0), kind)
        picture = client.draw(
            Scene(np.empty(0), (120, 120), camera, boxes=(box,), robot=NOBODY)
        ).astype(int)
        red = picture[..., 0] - picture[..., 1:].max(axis=-1) > 40
        counts.append(red.sum())
    box, sphere = counts
    assert 0.4 * box < sphere < 0.85 * box


def test_the_scene_has_nothing_that_touches_but_ball_and_puck():
    model = scene.tray(task.PUCK)
    touches = {model.geom(i).name for i in range(model.ngeom)
               if model.geom_contype[i]}  # fmt: skip
    assert touches == {"sphere", "puck"}
    data = scene.start(model)
    mujoco.mj_kinematics(model, data)
    np.testing.assert_allclose(data.body("puck").xpos, scene.world(task.PUCK))
