"""Day 15: the numbers in the guide's sentences, and every reason in it."""

import contextlib
import io
import re
from functools import cache
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from robo47 import cloning

import day15_mujoco

SENTENCES = sentences(15)
lab = load_script(ROOT / "w3-learning/src/day15_cloning.py")
SILENT = SimpleNamespace(
    training=lambda title, steps: range(1, steps + 1), check=lambda *_: None
)


@cache
def data(seed=lab.SEED, demos=lab.DEMOS):
    """Return the rows of the training and those held out, of a seed."""
    silence = contextlib.redirect_stdout(io.StringIO())
    with patch.multiple(lab, SEED=seed, DEMOS=demos), silence:
        return lab.data_of(SILENT)


def trained(seed=lab.SEED, demos=lab.DEMOS, change=lambda x, action: (x, action)):
    """Return a clone and its loss on held-out rows."""
    (x, action, _), held = data(seed, demos)
    with patch.object(lab, "SEED", seed):
        clone = lab.train(SILENT, "", *change(x, action))
    return clone, clone.loss(*held[:2])


def home(clone):
    """Return how many pucks a clone brings home."""
    return np.sum(lab.tested(clone.act).home())


@cache
def copycat(seed=lab.SEED):
    """Return the copycat, and its inputs of the held-out rows."""
    (x, action, episode), (seen, done, of) = data(seed)
    with patch.object(lab, "SEED", seed):
        rows = np.hstack([x, lab.with_last(episode, action)])
        clone = lab.train(SILENT, "", rows, action)
    return clone, np.hstack([seen, lab.with_last(of, done)])


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    told = {"path of a blind push, 10 mm off the centre, mm": "130",
            "2 mm/s sideways, beside the line, mm": "1.4",
            "loss before training": "1"}  # fmt: skip
    return printed_by(lab, told)


# What a student's run tells in a second.


def test_the_cases_on_paper_are_what_the_functions_say():
    assert lab.contact_angle(0.1, 1.0, 1.0) == pytest.approx(0.270, abs=5e-4)
    assert "you should obtain 0.270 rad" in SENTENCES
    half = np.tan(np.arcsin(10 / 65) / 2)
    assert f"$\\tan(\\varphi_0 / 2)$ = {half:.4f}" in SENTENCES
    way = 65 * np.log(np.tan(np.pi / 6) / half)
    assert f"65 ln(tan 30° / 0.0774) = {way:.1f} mm" in SENTENCES
    assert 1e3 * lab.blind_distance(0.01) == pytest.approx(way)
    small = 65 * np.log(np.pi / 3 / np.arcsin(10 / 65))
    assert f"the path is {small:.1f} mm instead of {way:.1f} mm" in SENTENCES
    assert round(100 * (134.1 / small - 1)) == 8
    assert "grows from 3 % to 8 %" in SENTENCES
    h1 = np.tanh(1.0)
    h2 = np.tanh(h1)
    words = f"tanh(1) = {h1:.4f} and $H_2$ = tanh(0.7616) = {h2:.4f}"
    assert words in SENTENCES
    words = f"$2 \\cdot 0.6420$ = {2 * h2:.4f}, and the gradient of $W_3$ is 0.6420"
    assert words in SENTENCES
    assert f"times this value, {2 * h2 * h2:.4f}" in SENTENCES


def test_the_steering_on_paper():
    v, K, D, R = 0.1, 3.0, 2.4, 0.065
    words = f"2 / (3 - {v / R:.3f} - {v / D:.3f}) = {2 / (K - v / R - v / D):.3f} mm"
    assert words in SENTENCES
    assert f"it would be {2 / (K - v / R):.3f} mm" in SENTENCES
    assert f"{v / R + v / D:.2f} per second." in SENTENCES
    assert f"$v / R$ = {v / R:.2f} per second" in SENTENCES
    assert f"to {2 * (v / R + v / D):.1f} per second" in SENTENCES


def test_half_the_mass_halves_the_difference_to_paper():
    paths = [
        1e3 * day15_mujoco.blind_push(*day15_mujoco.scene(mass=mass), 0.01)
        for mass in (0.1, 0.05, 0.025)
    ]
    words = f"at 10 mm is {paths[1]:.1f} mm, and with a quarter {paths[2]:.1f} mm"
    assert words in SENTENCES
    off = np.array(paths) - 1e3 * lab.blind_distance(0.01)
    assert off[1] / off[0] == pytest.approx(0.5, abs=0.05)
    delay = day15_mujoco.MASS / day15_mujoco.DAMPING
    assert f"with a delay of {1e3 * delay:.0f} ms" in SENTENCES
    path = delay * day15_mujoco.PUSH
    words = f"moves {1e3 * path:.0f} mm, {100 * path / lab.R:.0f} % of R"
    assert words in SENTENCES


@pytest.mark.parametrize(("steer", "holds"), [(1.4, False), (1.8, True)])
def test_a_gain_below_the_limit_does_not_hold_the_puck(steer, holds):
    start = np.array([[lab.FAR + lab.R, 1e-4, lab.FAR, 0.0]])
    run = day15_mujoco.run(
        *day15_mujoco.scene(),
        start,
        lambda seen: day15_mujoco.demonstrator(seen, steer=steer),
        30,
    )
    first, last = (abs(lab.beside_the_line(run.observation[0, k])) for k in (1, -1))
    assert (last < first) == holds


def test_the_parameters_are_counted():
    net = cloning.random_net(np.random.default_rng(0), 4, lab.UNITS, 2)
    assert f"It has {cloning.flat(net).size} parameters" in SENTENCES


def test_the_first_step_without_correction_is_longer_by_what_the_guide_says():
    m = 0.1 * 3.0
    v = 0.001 * 9.0
    assert f"the first step is {m / np.sqrt(v):.1f} times as long" in SENTENCES
    theta, _, _ = lab.adam_step(*map(np.atleast_1d, (0.0, 3.0, 0.0, 0.0)), 1, 1.0)
    assert theta == pytest.approx([-1.0])


def test_a_trap_of_the_gradient_is_hidden_by_what_the_guide_says():
    rng = np.random.default_rng(0)
    square = [rng.normal(size=size) for size in ((4, 3), 3, (3, 3), 3, (3, 2), 2)]
    x = rng.normal(size=(5, 4))
    target = rng.normal(size=(5, 2))
    right = lab.mlp_gradient(x, target, *square)
    one_row = lab.mlp_gradient(x[:1], target[:1], *square)
    assert right[1].shape == one_row[1].shape == (3,)
    last = [*square[:4], 0 * square[4], square[5]]
    nothing = lab.mlp_gradient(x, target, *last)
    assert all(np.abs(one).max() == 0 for one in nothing[:4])
    assert "all gradients before the last layer are 0" in SENTENCES


def test_the_loss_is_complex_where_a_weight_is():
    net = [one.astype(complex) for one in
           cloning.random_net(np.random.default_rng(0), 4, 3, 2)]  # fmt: skip
    net[5] = net[5] + 1e-20j
    assert np.abs(lab.mlp(np.ones((1, 4)), *net).imag).max() == 1e-20


def test_repeating_the_last_action_never_moves():
    _, (_, done, of) = data()
    scaler = lab.fit_scaler(data()[0][1])
    loss = lab.persistence_loss(lab.normalise(done, scaler), of)
    assert f"the policy that only repeats has a loss of {loss:.3f}" in SENTENCES
    run = day15_mujoco.run(
        *day15_mujoco.scene(),
        day15_mujoco.starts(5, np.random.default_rng(0)),
        lambda seen: np.zeros((5, 2)),
    )
    assert np.abs(np.diff(run.observation, axis=1)).max() < 1e-9


def test_the_opening_is_what_the_lab_prints(printed):
    losses = re.findall(r"held out (\d\.\d+)", printed)
    assert "0.040 instead of 0.063" in SENTENCES
    assert np.array(losses, float) == pytest.approx([0.063, 0.040], abs=0.003)
    counts = [int(n) for n in re.findall(r"about +(\d+) of 200", printed)]
    assert counts == pytest.approx([185, 20, 200], abs=10)
    assert re.search(r"brings \W*about 185 of 200\W* pucks home", SENTENCES)


# What only an author can break.


@pytest.mark.kit
def test_the_copycat_repeats_and_knows_enough():
    clone, rows = copycat()
    _, (_, done, of) = data()
    slopes = []
    for j in (0, 1):
        moved = rows.copy()
        moved[:, 4 + j] += 1e-5
        slopes.append(np.mean((clone.act(moved) - clone.act(rows))[:, j]) / 1e-5)
    assert slopes == pytest.approx([0.80, 0.84], abs=0.02)
    assert "by 0.80 (x) and 0.84 (y)" in SENTENCES
    jump = np.abs(np.diff(done, axis=0, prepend=0)).max(axis=1) > 0.02
    jump |= np.diff(of, prepend=-1) != 0
    assert f"In {100 * (1 - jump.mean()):.0f} % of the held-out rows" in SENTENCES
    pred = lab.normalise(clone.act(rows), clone.actions)
    off = (pred - lab.normalise(done, clone.actions)) ** 2
    assert off[~jump].mean() == pytest.approx(0.012, abs=0.002)
    assert off[jump].mean() == pytest.approx(0.39, abs=0.03)
    assert "it is 0.39" in SENTENCES


@pytest.mark.kit
def test_repeating_has_half_of_the_clones_loss_on_the_same_rows():
    mimic, rows = copycat()
    _, (seen, done, of) = data()
    later = np.diff(of, prepend=-1) == 0  # rows with a last action
    loss = mimic.loss(rows[later], done[later])
    assert loss == pytest.approx(0.020, abs=0.002)
    clone = trained()[0].loss(seen[later], done[later])
    assert clone == pytest.approx(0.052, abs=0.004)
    assert "the copycat's loss is 0.020 and the clone's 0.052" in SENTENCES
    repeats = lab.persistence_loss(lab.normalise(done, mimic.actions), of)
    assert repeats / clone == pytest.approx(0.5, abs=0.05)


@pytest.mark.kit
@pytest.mark.parametrize(
    ("seed", "split", "honest"), [(1, 0.029, 0.063), (2, 0.025, 0.050)]
)
def test_a_split_by_rows_makes_the_loss_look_better(seed, split, honest):
    both = [np.concatenate(pair) for pair in zip(*data(seed), strict=True)]
    order = np.random.default_rng(0).permutation(len(both[0]))
    (x, action), (seen, done) = (
        [one[rows] for one in both[:2]] for rows in np.split(order, [60 * lab.DEMOS])
    )
    with patch.object(lab, "SEED", seed):
        clone = lab.train(SILENT, "", x, action)
    assert clone.loss(seen, done) == pytest.approx(split, abs=0.003)
    assert trained(seed)[1] == pytest.approx(honest, abs=0.004)
    assert "is about 0.03 instead of 0.063" in SENTENCES


@pytest.mark.kit
def test_only_the_first_check_of_the_data_shows_a_split_by_rows():
    def by_rows(episode, held_out):
        order = np.random.default_rng(0).permutation(len(episode))
        return order < np.isin(episode, held_out).sum()

    found = []
    check = SimpleNamespace(check=lambda label, off: found.append(np.abs(off).max()))
    silence = contextlib.redirect_stdout(io.StringIO())
    with patch.object(lab, "split_by_episode", by_rows), silence:
        train, _ = lab.data_of(check)
        lab.check_scaler(check, train[0])
    assert found[0] > 1
    assert max(found[1:]) < 1e-8
    assert "Only the first check of step 2 shows it" in SENTENCES


def squared(x, target, *net):
    """Return a gradient with the derivative of tanh squared."""
    first = np.tanh(x @ net[0] + net[1])
    second = np.tanh(first @ net[2] + net[3])
    d3 = lab.mse(second @ net[4] + net[5], target)[1]
    d2 = (d3 @ net[4].T) * (1 - second**2) ** 2
    d1 = (d2 @ net[2].T) * (1 - first**2) ** 2
    return (x.T @ d1, d1.sum(axis=0), first.T @ d2, d2.sum(axis=0),
            second.T @ d3, d3.sum(axis=0))  # fmt: skip


def of_means(x, target, *net):
    """Return a gradient whose biases have means over the rows."""
    grads = cloning.mlp_gradient(x, target, *net)
    return tuple(g / len(x) if g.ndim == 1 else g for g in grads)


def uncorrected(theta, grad, m, v, k, rate):
    """Return a step of Adam without its corrections."""
    m = 0.9 * m + 0.1 * grad
    v = 0.999 * v + 0.001 * grad**2
    return theta - rate * m / (np.sqrt(v) + 1e-8), m, v


@pytest.mark.kit
@pytest.mark.parametrize(
    ("change", "losses", "homes"),
    [
        ({}, (0.063, 0.050, 0.057), (185, 195, 195)),
        ({"mlp_gradient": of_means}, (0.063, 0.050, 0.057), (185, 195, 195)),
        ({"adam_step": uncorrected}, (0.048, 0.036, 0.047), (195, 200, 195)),
        ({"mlp_gradient": squared}, (0.060, 0.045, 0.050), (195, 200, 190)),
    ],
)
def test_a_good_policy_proves_no_gradient(change, losses, homes):
    row = f"{', '.join(f'{one:.3f}' for one in losses)} | about "
    assert row + ", ".join(map(str, homes)) in SENTENCES
    with patch.multiple(lab, **change) if change else contextlib.nullcontext():
        for seed in (1, 2):
            clone, loss = trained(seed)
            assert loss == pytest.approx(losses[seed - 1], abs=0.004)
            assert home(clone) == pytest.approx(homes[seed - 1], abs=8)


@pytest.mark.kit
@pytest.mark.parametrize(
    ("demos", "loss", "came"), [(10, 0.23, 80), (20, 0.09, 130), (80, 0.04, 200)]
)
def test_more_demonstrations_are_better(demos, loss, came):
    clone, held = trained(demos=demos)
    assert held == pytest.approx(loss, rel=0.15)
    assert home(clone) == pytest.approx(came, abs=10)
    assert re.search(rf"\| {demos} \| {loss:.2f}.* \| about {came},", SENTENCES)


def edited(tmp_path, old, new):
    """Return the lab with an edit that the guide describes."""
    source = (ROOT / "w3-learning/src/day15_cloning.py").read_text("utf-8")
    assert source.count(old) == 1
    file = tmp_path / "edited.py"
    file.write_text(source.replace(old, new), encoding="utf-8")
    return load_script(file)


def tried(changed, seed):
    """Return the held-out loss of an edited lab's clone, and the pucks at home."""
    (x, action, _), held = data(seed)
    with patch.object(changed, "SEED", seed):
        clone = changed.train(SILENT, "", x, action)
    return clone.loss(*held[:2]), np.sum(changed.tested(clone.act).home())


def with_line(tmp_path, line):
    """Return the lab with a line of the guide in `train`, below `rng = ...`."""
    assert f"`{line}`" in SENTENCES
    below = "    rng = np.random.default_rng(SEED)\n"
    net = "    net = cloning.random_net(rng,"
    return edited(tmp_path, below + net, f"{below}    {line}\n{net}")


@pytest.mark.kit
@pytest.mark.parametrize("seed", [1, 2])
def test_shuffled_actions_teach_nothing(tmp_path, seed):
    changed = with_line(tmp_path, "target = rng.permutation(target)")
    loss, came = tried(changed, seed)
    assert "stays near 1 (1.00 to 1.05 over three seeds)" in SENTENCES
    assert 0.995 < loss < 1.06
    assert came <= 2


@pytest.mark.kit
@pytest.mark.parametrize("seed", [1, 3])  # the fewest pucks, and the most
def test_late_actions_cost_a_few_pucks(tmp_path, seed):
    changed = with_line(tmp_path, "x, target = x[1:], target[:-1]")
    loss, came = tried(changed, seed)
    assert 0.07 < loss < 0.10
    words = re.search(r"About (\d+) to (\d+) pucks arrive", SENTENCES)
    assert came == pytest.approx(int(words[1 if seed == 1 else 2]), abs=5)


@pytest.mark.kit
@pytest.mark.parametrize("seed", [1, 2])
def test_a_clone_without_its_scale_is_clamped(tmp_path, seed):
    changed = edited(
        tmp_path,
        "return denormalise(mlp(normalise(x, self.inputs), *self.net), self.actions)",
        "return mlp(normalise(x, self.inputs), *self.net)",
    )
    words = re.search(r"About (\d+), (\d+) and (\d+) pucks arrive", SENTENCES)
    assert tried(changed, seed)[1] == pytest.approx(int(words[seed]), abs=5)
    scale = lab.fit_scaler(data()[0][1])[1]
    assert 1 / scale == pytest.approx([18, 18], abs=1.5)
    assert "about 18 times too large" in SENTENCES


@pytest.mark.kit
def test_runs_that_fail_are_far_from_the_data():
    clone, _ = trained()
    run = lab.tested(clone.act)
    known = lab.normalise(data()[0][0], clone.inputs)
    medians = []
    every = np.arange(lab.TESTED) % 4 == 0  # of the many that succeed
    for some in (~run.home(), run.home() & every):
        rows = run.observation[some][:, :-1:4].reshape(-1, 4)
        far = lab.nearest_distance(known, lab.normalise(rows, clone.inputs))
        medians.append(np.median(far))
    assert 5.5 < medians[0] / medians[1] < 8.0, medians
    assert "six to seven times as large" in SENTENCES


@pytest.mark.kit
def test_the_copycat_fails_for_every_seed():
    low, high = map(int, re.search(r"eight seeds it is (\d+) to (\d+)",
                                   SENTENCES).groups())  # fmt: skip
    for seed in (4, 6):
        clone, _ = trained(seed)
        gap = home(clone) - np.sum(lab.tested(lab.repeating(copycat(seed)[0])).home())
        assert low - 8 <= gap <= high + 8
