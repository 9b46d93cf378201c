"""The capstone of Week 2: what each of its numbers hangs on, one cause at a time."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from conftest import ROOT
from robo47 import delivery, panda, scenes, shapes
from robo47.delivery import phases, scene
from robo47.delivery.path_planner import MARGIN
from robo47.errors import Robo47Error

FNS = delivery.library()
LIGHT = 0.08  # kg


def but(**changed):
    """Return the library's functions with some of them replaced."""
    return SimpleNamespace(**{**vars(FNS), **changed})


def cube(fns=FNS, mass=LIGHT, **options):
    """Return what came of one cube, which nobody pushes unless asked to."""
    return delivery.attempt(fns, mass=mass, **options)


@pytest.fixture(scope="module")
def right():
    """What `make capstone WEEK=2` does: 150 g, then a push."""
    return delivery.attempt(FNS)


def test_a_cube_of_150_g_is_seen_weighed_slowed_and_delivered(right):
    assert not right.failed
    assert right.seen_mm < 1.0
    assert abs(right.grams - 150.0) < 0.05
    assert right.speed == 0.3
    assert right.clearance_mm > 1e3 * MARGIN - 0.5
    assert right.residual < phases.SPEEDS[0] * 0.35
    assert right.place_mm < 2.0


def test_a_push_is_felt_one_or_two_samples_later(right):
    assert right.contact_link >= 4
    assert 0.0 < right.detection_ms < 25.0


def test_a_push_that_nobody_feels_or_that_is_felt_before_it_comes_is_none(right):
    for ms in (np.nan, -40.0):
        result = right._replace(detection_ms=ms)
        assert result.failed
        assert any("nothing is felt" in line for line in delivery.summary(result).after)
    assert not right._replace(detection_ms=np.nan, pushed=False).failed


@pytest.mark.kit
def test_what_the_week_predicts_on_paper_is_what_its_page_says(right):
    page = " ".join((ROOT / "w2-autonomy/README.md").read_text("utf-8").split())
    wt = phases.SCALE * 0.4
    scale = 80.0 * (1.0 - (1.0 - wt) * np.exp(-wt))
    assert f"and {scale:.1f} g after 0.4 s" in page
    assert f"= {LIGHT * 9.81 * 0.5:.2f} N m" in page
    closed = right.qpos[np.searchsorted(right.t, dict(right.phases)["lift"]), 7]
    grip = 50.0 * closed
    assert f"presses with {grip:.2f} N" in page
    told = round(grip, 2)  # a student calculates with the number on the page
    light, heavy = (2.0 * told / mass - 9.81 for mass in (LIGHT, 0.15))
    assert f"{light:.1f} m/s² for 80 g, {heavy:.1f} m/s² for" in page


@pytest.mark.kit
class TestTheScale:
    def test_reads_what_its_spring_says_after_a_time(self):
        # m (1 - (1 - w t) e^(-w t)): damping counts, so it reads too much at first.
        for seconds, t in ((0.4, 0.39), (0.3, 0.29)):
            wt = phases.SCALE * t
            paper = 80.0 * (1.0 - (1.0 - wt) * np.exp(-wt))
            assert abs(cube(weigh=seconds).grams - paper) < 2.0
        assert abs(cube(weigh=1.2).grams - 80.0) < 0.05

    def test_of_a_cube_that_is_counted_for_nothing_the_watch_is_told(self):
        result = cube(weigh=0.0)
        assert result.link == 2
        assert "link 2" in result.stopped

    def test_says_that_nothing_is_in_the_hand(self):
        result = cube(friction=0.4)
        assert abs(result.grams) < 1.0
        assert result.stopped == "there is nothing in the hand"

    def test_of_the_wrong_sign_is_asked_about_and_not_the_hand(self):
        def negative(*given):
            return -FNS.identify_payload(*given)

        result = cube(but(identify_payload=negative))
        assert (
            result.stopped == "it weighs -80 g: is identify_payload (task 8.8) right?"
        )

    def test_sees_twice_the_weight_where_g_is_halved(self):
        def halved(J_site, R_site, extra, g):
            return FNS.identify_payload(J_site, R_site, extra, 0.5 * g)

        assert abs(cube(but(identify_payload=halved)).grams - 160.0) < 0.1


@pytest.mark.kit
class TestTheSpeed:
    def test_is_chosen_by_the_weight(self, right):
        assert cube(mass=LIGHT).speed == 0.6
        assert right.speed < 0.6

    def test_of_80_g_loses_150_g(self):
        result = cube(mass=0.15, speed=0.6)
        assert result.stopped
        assert result.failed

    def test_is_none_where_the_grip_is_too_weak(self):
        weak = but(max_cube_mass=lambda *_: 0.02)
        assert "too heavy" in cube(weak).stopped


@pytest.mark.kit
class TestTheWay:
    def test_keeps_its_margin_by_mujocos_distances_as_well(self, right):
        def add(spec):
            shapes.World.of(boxes=scene.boxes()).add_to(spec)
            shapes.add_arm(spec, shapes.capsules_of(panda.load("panda")))

        model = panda.load("panda", edit=add)
        data = mujoco.MjData(model)
        arm = [model.geom(f"arm{i}").id for i in range(10)]
        world = [model.geom(f"world{i}").id for i in range(2)]
        began = dict(right.phases)
        moves = [
            (began["reach"], began["descend"]),
            (began["carry"], began["put down"]),
        ]
        least = np.inf
        for t, qpos in zip(right.t, right.qpos, strict=True):
            if not any(first < t <= last for first, last in moves):
                continue
            data.qpos[:] = qpos[:9]
            mujoco.mj_kinematics(model, data)
            for a in arm:
                for b in world:
                    d = mujoco.mj_geomDistance(model, data, a, b, 1.0, None)
                    least = min(least, d)
        assert abs(1e3 * least - right.clearance_mm) < 0.5

    @pytest.mark.parametrize("asked", [{"planned": False}, {"hand": False}])
    def test_hits_the_wall_without_a_plan_or_without_the_hand(self, asked):
        result = cube(**asked)
        assert result.clearance_mm < -10.0
        assert result.residual > 5.0
        assert result.stopped

    def test_is_straight_where_no_wall_is(self):
        result = cube(wall=False)
        assert not result.failed
        assert result.queries < 300

    def test_is_refused_in_words_where_the_planner_finds_none(self):
        nothing = but(rrt_connect=lambda *_: np.empty((0, 7)))
        with pytest.raises(Robo47Error, match=r"no way: rrt_connect \(task 12.4\)"):
            cube(nothing)

    def test_stops_a_next_check_that_does_not_get_on(self):
        stuck = but(conservative_advance=lambda s, *_: 0.0)
        cube(stuck, wall=False)  # it is pushed on a little at each look


@pytest.mark.kit
class TestTheEye:
    def test_is_needed_only_for_the_place(self):
        told = cube(known_pose=True)
        assert told.seen_mm == 0.0
        assert not told.failed

    def test_that_is_10_mm_beside_still_lifts_and_fails_all_the_same(self):
        result = cube(offset=0.01)
        assert result.seen_mm > 9.0
        assert not result.stopped
        assert result.failed

    def test_whose_angle_is_doubled_is_asked_about_and_not_the_place(self):
        def wide(fovy, *size):
            return FNS.camera_matrix(2.0 * fovy, *size)

        with pytest.raises(Robo47Error, match=r"inside table .* \(task 10.1\)"):
            cube(but(camera_matrix=wide))

    def test_says_where_it_sees_no_cube(self):
        def behind(K, T_world_cam, pixels, depths):
            return FNS.back_project(K, T_world_cam, pixels, -depths)

        with pytest.raises(Robo47Error, match=r"back_project \(task 10.3\)"):
            cube(but(back_project=behind))


@pytest.mark.kit
def test_without_the_energys_slope_the_residual_is_larger():
    flat = but(
        kinetic_energy_gradient=lambda *given: 0.0 * FNS.kinetic_energy_gradient(*given)
    )
    assert cube(flat).residual > 1.3 * cube().residual


@pytest.mark.kit
def test_random_cubes_arrive():
    failed = [seed for seed in range(6) if delivery.attempt(FNS, seed).failed]
    assert not failed


@pytest.mark.kit
def test_a_film_of_it_has_table_wall_eye_and_cube(right):
    film = delivery.film(right)
    assert len(film.blocks(film.qpos[0])) == 4
    assert set(film.moments) <= {name for name, _ in film.phases}
    assert film.model().nq == film.qpos.shape[1]
    assert film.blocks(film.qpos[0])[3].half[0] == scenes.CUBE_HALF
